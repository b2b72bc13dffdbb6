//! Stages as written become stages of a scene: each gets its own [`Scene`] with the bodies where they are when it begins.
//!
//! In: the records of [`crate::scene::stage_file`]. Out: the stages of the scene, or faults. Where bodies are after another stage is
//! found out by [`crate::story`] and by [`crate::numeric`], each for itself; here symbols stand for it.

mod earlier;
mod fields;
mod hinged;
mod kind;
mod seen;
mod slide;

pub use earlier::without_case;
pub(super) use hinged::spread;

use crate::scene::meanwhile::{self, home};
use std::collections::{BTreeMap, HashMap};
use std::iter::successors;

use crate::expr::{Expr, Symbol, Vector, minus};
use crate::scene::body_file::VelocityFile;
use crate::scene::check::check;
use crate::scene::claim::{Claim, Claimed};
use crate::scene::contact_file::{ContactFile, LawName};
use crate::scene::fault::{Fault, Span};
use crate::scene::file::SceneFile;
use crate::scene::formulas::{Quantity, Symbols};
use crate::scene::questions::About;
use crate::scene::record::{Map, Pair, Text};
use crate::scene::record::{entries, keys};
use crate::scene::resolver::Place;
use crate::scene::resolver::Resolver;
use crate::scene::stage::{During, OneSided, Stage, StageKind};
use crate::scene::stage_file::{EndName, StageFile, StartFile, stage_named};
use crate::scene::{Body, Scene, Shape, geometry, joined, questions};

/// Most stages a scene may have.
pub(super) const STAGES: usize = 40;

/// A file whose only stage is an impact, written as a scene of one impact: the same scene. `None` where it says more than
/// such a scene can, or something that is to be refused.
pub(super) fn lone(file: &SceneFile) -> Option<SceneFile> {
    let [stage] = file.stages.as_deref()? else {
        return None;
    };
    let impact = stage.impact.as_ref()?;
    let others = [
        stage.turn.is_some(),
        stage.slide.is_some(),
        stage.fall.is_some(),
        stage.wind.is_some(),
        stage.linkage.is_some(),
        stage.start.is_some(),
        stage.from.as_ref().is_some_and(|f| f.text != "start"),
        impact.supports.is_some() || impact.strings.is_some() || impact.supposing.is_some(),
        file.hinges.is_some() || file.contacts.is_some(),
        file.blows.is_some() || file.after.is_some(),
        file.assumptions.is_some(),
        // Nothing that collides is to be refused.
        impact.hinges.is_none() && impact.contacts.is_none() && impact.blows.is_none(),
    ];
    if others.contains(&true) {
        return None;
    }
    let mut out = file.clone();
    out.stages = None;
    out.hinges = impact.hinges.clone();
    out.contacts = impact.contacts.clone();
    out.blows = impact.blows.clone();
    out.after = impact.after.clone();
    let forces = file.forces.iter().chain(&impact.forces);
    out.forces = Some(forces.flatten().cloned().collect());
    for (_, q) in out.questions.iter_mut().flat_map(|m| &mut m.0) {
        let Some(q) = q else { continue };
        let elsewhere = q.at.as_ref().is_some_and(|at| at.text != stage.name.text);
        if elsewhere || questions::asks(q, About::Stage) {
            return None;
        }
        q.at = None;
    }
    Some(out)
}

/// Reads the stages and the questions about them into the scene.
pub(super) fn resolve(base: &mut Resolver<'_>, scene: &mut Scene) {
    let file = base.file;
    let Some(stages) = &file.stages else { return };
    if stages.is_empty() || stages.len() > STAGES {
        let message = format!(
            "a story has 1 to {STAGES} stages, and this has {}",
            stages.len()
        );
        base.faults.push(Fault::new(file.span, message));
        return;
    }
    let first = |names: Vec<&Text>| names.first().map(|name| name.span);
    let misplaced = [
        ("hinges", first(keys(file.hinges.as_ref()))),
        ("contacts", first(keys(file.contacts.as_ref()))),
        ("blows", first(keys(file.blows.as_ref()))),
        ("after", file.after.iter().flatten().next().map(|k| k.span)),
    ];
    for (what, first) in misplaced {
        if let Some(first) = first {
            let message = format!("`{what}` of a scene with stages belongs to an impact");
            let hint = match what {
                "hinges" => {
                    "above the stages stand hinges on a fixed body, whose bodies never fall or slide; of a body that is let go, a `turn` says its point by \"about\", and hinges belong into the impacts they hold in"
                }
                _ => "\"stages\": [{\"name\": \"impact\", \"impact\": {\"contacts\": …}}]",
            };
            base.report(first, message, hint);
        }
    }
    let readings = file.assumptions.iter().flatten();
    scene.readings = readings.map(|t| t.text.clone()).collect();
    let homes = homes(base, stages);
    let mut composed: Vec<SceneFile> = (0..stages.len())
        .map(|i| composed(file, &stages[i], i, &homes))
        .collect();
    let names = earlier::names(file);
    let mut with_names = base.symbols.extended(&[]);
    for (name, dimension) in &names {
        with_names.add_as(name, dimension.clone());
    }
    let plain = std::mem::replace(&mut base.symbols, with_names);
    let domains = scene.domains.clone();
    earlier::live(file, &mut scene.domains);
    // One that does not read keeps its place, since the others name their predecessors by number.
    let mut read: Vec<Option<Stage>> = Vec::new();
    for (i, stage) in stages.iter().enumerate() {
        let Some((from, during)) = predecessor(base, stages, i) else {
            read.push(None);
            continue;
        };
        let symbols = std::mem::replace(&mut base.symbols, Symbols::new(Default::default()));
        let left_at = left_at(&read, from);
        held_on(&mut composed[i], scene, (&read, from));
        let during = during.map(|first| (first, stages[first].name.text.as_str()));
        let begins = (from, during, &left_at);
        let (one, symbols, faults) = one(&composed[i], stage, begins, scene, symbols);
        base.symbols = symbols;
        base.faults.extend(faults);
        read.push(one);
    }
    let with_names = std::mem::replace(&mut base.symbols, plain);
    base.symbols.absorb(&with_names);
    scene.domains = domains;
    let Some(read) = read.into_iter().collect() else {
        return;
    };
    scene.stages = read;
    let mut axles = Vec::new();
    for stage in &scene.stages {
        if let StageKind::Slide(slide) = &stage.kind {
            axles.extend(slide.pulleys());
        }
    }
    for stage in &mut scene.stages {
        stage.scene.axles = axles.clone();
    }
    scene.axles = axles;
    for (i, stage) in stages.iter().enumerate() {
        if let Some(slide) = &stage.slide {
            seen::from_above(base, scene, i, slide.span.opening());
        }
    }
    name_pivots(scene);
    begin(scene);
    joined::keep(scene);
    joined::note(scene);
    meanwhile::tell_apart(base, scene, stages);
    for (stage, written) in scene.stages.iter().zip(stages) {
        if let Some(slide) = &written.slide {
            slide::loaded_wheel(base, stage, slide.span.opening());
        }
    }
    if base.faults.is_empty() {
        questions::of_stages(base, scene, &homes);
    }
    if base.faults.is_empty() {
        earlier::take(base, scene, stages, &names);
    }
}

/// A story that begins with a linkage begins with the bodies and points where the first value of its coordinate puts them.
fn begin(scene: &mut Scene) {
    let Some(Stage {
        kind: StageKind::Linkage(linkage),
        ..
    }) = scene.stages.first()
    else {
        return;
    };
    let linkage = linkage.clone();
    let mut put = |e: &mut Expr| *e = linkage.at(e, &linkage.ends[0]);
    let starts = scene.stages.iter_mut().filter(|s| s.from.is_none());
    let starts = starts.map(|s| (&mut s.scene.bodies, &mut s.scene.points));
    for (bodies, points) in starts.chain([(&mut scene.bodies, &mut scene.points)]) {
        for body in bodies {
            body.place_mut(&mut put);
            body.velocity.iter_mut().for_each(&mut put);
            put(&mut body.spin);
        }
        points.iter_mut().flat_map(|p| &mut p.at).for_each(&mut put);
    }
}

/// Gives the fixed points of rotations that the file puts at coordinates the name of a hinge, contact or point that is there, or
/// a letter that is free.
fn name_pivots(scene: &mut Scene) {
    let joints = scene.stages.iter().flat_map(places_of_joints);
    let points = scene.points.iter().map(|p| (&p.name, &p.at));
    let mut known: Vec<(String, Vector)> = (joints.chain(points))
        .map(|(name, at)| (name.clone(), at.clone()))
        .collect();
    let bodies = scene.bodies.iter().map(|b| &b.name);
    let taken: Vec<&String> = known.iter().map(|(name, _)| name).chain(bodies).collect();
    let letters = ["O", "P", "Q", "S", "Z"].map(String::from);
    let mut free: Vec<String> = letters
        .into_iter()
        .filter(|l| !taken.contains(&l))
        .collect();
    for i in 0..scene.stages.len() {
        let caught = caught(&scene.stages, i);
        let StageKind::Turn(turn) = &mut scene.stages[i].kind else {
            continue;
        };
        if !turn.about_name.is_empty() {
            continue;
        }
        let there = known.iter().find(|(_, at)| *at == turn.about);
        turn.about_name = match there.map(|(name, _)| name).or(caught.as_ref()) {
            Some(name) => name.clone(),
            None if free.is_empty() => String::from("pivot"),
            None => free.remove(0),
        };
        known.push((turn.about_name.clone(), turn.about.clone()));
    }
}

fn places_of_joints(stage: &Stage) -> impl Iterator<Item = (&String, &Vector)> {
    let hinges = stage.scene.hinges.iter().map(|h| (&h.name, &h.at));
    hinges.chain(stage.scene.contacts.iter().map(|c| (&c.name, &c.at)))
}

/// The joint of an impact about which the bodies turn from there on: in an impact they stay where they are.
fn caught(stages: &[Stage], i: usize) -> Option<String> {
    let StageKind::Turn(turn) = &stages[i].kind else {
        return None;
    };
    let before = successors(stages[i].from, |j| stages[*j].from).map(|j| &stages[j]);
    let mut impacts = before.take_while(|s| matches!(s.kind, StageKind::Impact { .. }));
    impacts.find_map(|impact| {
        let bodies = impact.scene.bodies.iter();
        let places = bodies.map(|b| [&b.center[0], &b.center[1], &b.angle]);
        let now = stages[i].places.iter().flatten().cloned();
        let then = places.flatten().cloned();
        let map: BTreeMap<Symbol, Expr> = now.zip(then).collect();
        let about = turn.about.each_ref().map(|c| c.substitute(&map));
        let mut joints = places_of_joints(impact);
        joints.find_map(|(name, at)| (*at == about).then(|| name.clone()))
    })
}

/// The stage each question about motion belongs to, by index of question.
fn homes(base: &mut Resolver<'_>, stages: &[StageFile]) -> HashMap<usize, usize> {
    let mut out = HashMap::new();
    for (k, (_, q)) in base.file.questions.iter().flat_map(|m| &m.0).enumerate() {
        let Some(q) = q else { continue };
        if questions::asks(q, About::Motion)
            && let Some(place) = q.when.filter(|w| *w == EndName::Start).map(|_| q.span)
        {
            let message = "what moves when a stage begins moves so when the one before ends";
            let hint = "ask it `at` the stage before, without `when`";
            base.report(place, message, hint);
            continue;
        }
        let only = q.impulse.as_ref().filter(|_| q.at.is_none());
        let only = only.and_then(|place| only_impact_at(stages, &place.text));
        if questions::asks(q, About::Motion)
            && let Some(i) = only.or_else(|| stage_named(&mut base.faults, stages, q.at.as_ref()))
        {
            let i = home(stages, i, q);
            out.insert(k, i);
        }
    }
    out
}

/// The impact that has a contact, hinge, blow, support or string of this name, if only one has.
fn only_impact_at(stages: &[StageFile], place: &str) -> Option<usize> {
    let has = |stage: &StageFile| {
        stage.impact.as_ref().is_some_and(|impact| {
            let mut all = impact
                .places()
                .into_iter()
                .chain(keys(impact.blows.as_ref()));
            all.any(|name| name.text == place)
        })
    };
    let mut found = (0..stages.len()).filter(|i| has(&stages[*i]));
    let first = found.next()?;
    found.next().is_none().then_some(first)
}

/// The stage before, `None` for the start, and the motion during which the stage happens.
type Before = (Option<usize>, Option<usize>);

/// What a stage goes on from.
fn predecessor(base: &mut Resolver<'_>, stages: &[StageFile], i: usize) -> Option<Before> {
    let stage = &stages[i];
    let name = stage.name.text.trim();
    if name.is_empty() || name.chars().any(char::is_control) {
        let message = "a stage has a name that can be read";
        let hint = "such as \"fall\" or \"swing back\"";
        return base.refuse(stage.name.span, message, hint);
    }
    if stages[..i].iter().any(|s| s.name.text == stage.name.text) || stage.name.text == "start" {
        let message = format!("the name `{}` is taken", stage.name.text);
        let hint = "every stage has a name of its own, and `start` is where the story begins";
        return base.refuse(stage.name.span, message, hint);
    }
    let mut earlier = |field: &str, name: &Text| {
        let found = stages[..i].iter().position(|s| s.name.text == name.text);
        if found.is_none() {
            let message = format!("no stage `{}` comes before this one", name.text);
            let hint = match field {
                "during" => String::from("`during` names an earlier motion"),
                _ => format!("`{field}` names an earlier stage, or \"start\""),
            };
            base.report(name.span, message, hint);
        }
        found
    };
    match (&stage.from, &stage.during) {
        (None, None) => Some((i.checked_sub(1), None)),
        (Some(name), None) if name.text == "start" => Some((None, None)),
        (Some(name), None) => Some((Some(earlier("from", name)?), None)),
        (Some(from), Some(_)) => {
            let message = "a stage `during` another begins where that begins";
            base.refuse(from.span, message, "leave out `from`")
        }
        (None, Some(name)) => {
            let named = earlier("during", name)?;
            let first = meanwhile::first(stages, named);
            if stages[first].impact.is_some() {
                let message = format!("`{}` is an impact, which takes no time", name.text);
                return base.refuse(name.span, message, "`during` names an earlier motion");
            }
            // Each is told after the others that happen at the same time.
            let last = (first..i)
                .rev()
                .find(|j| meanwhile::first(stages, *j) == first);
            Some((last, Some(first)))
        }
    }
}

/// The file of a stage taken by itself: all bodies, the impact's contacts, the questions about its end.
fn composed(
    file: &SceneFile,
    stage: &StageFile,
    i: usize,
    homes: &HashMap<usize, usize>,
) -> SceneFile {
    let mut out = file.clone();
    out.stages = None;
    out.assumptions = None;
    let impact = stage.impact.clone();
    let part = impact.as_ref();
    out.hinges = part.and_then(|p| p.hinges.clone());
    // Supports and strings stand behind the contacts, so that questions can name them; the stage takes them out again.
    let one_sided = part
        .iter()
        .flat_map(|p| [&p.supports, &p.strings])
        .flatten()
        .flat_map(|m| m.0.iter());
    let one_sided = one_sided.map(|(name, entry)| {
        let entry = entry.as_ref().map(|e| ContactFile {
            at: e.at.clone(),
            normal: Some(e.normal.clone()),
            ..ContactFile::between(e.span, e.bodies.clone())
        });
        (name.clone(), entry)
    });
    let contacts = part
        .iter()
        .flat_map(|p| &p.contacts)
        .flat_map(|m| m.0.iter().cloned());
    out.contacts = Some(Map(contacts.chain(one_sided).collect(), Span::default()));
    out.blows = part.and_then(|p| p.blows.clone());
    out.after = part.and_then(|p| p.after.clone());
    let forces = file
        .forces
        .iter()
        .flatten()
        .chain(part.iter().flat_map(|p| p.forces.iter().flatten()));
    out.forces = Some(forces.cloned().collect());
    let all = file
        .questions
        .iter()
        .flat_map(|m| m.0.iter().cloned())
        .enumerate();
    let own = all.filter(|(k, _)| homes.get(k) == Some(&i));
    let own = own.map(|(_, q)| q).collect();
    out.questions = Some(Map(own, Span::default()));
    out
}

/// Repeats in an impact the contacts of earlier ones whose impulse is asked of it, where what stuck there still sticks.
fn held_on(
    file: &mut SceneFile,
    scene: &mut Scene,
    (read, from): (&[Option<Stage>], Option<usize>),
) {
    let hinges = keys(file.hinges.as_ref());
    let here = [
        keys(file.contacts.as_ref()),
        hinges,
        keys(file.blows.as_ref()),
    ]
    .concat();
    let asked = entries(file.questions.as_ref());
    let asked = asked.filter_map(|(_, q)| q.impulse.clone());
    let mut missing: Vec<Text> = asked.collect();
    missing.retain(|name| here.iter().all(|here| here.text != name.text));
    let stages: Option<Vec<Stage>> = read.iter().cloned().collect();
    let (Some(stages), false, Some(contacts)) = (stages, missing.is_empty(), &mut file.contacts)
    else {
        return;
    };
    let mut before = Scene {
        bodies: scene.bodies.clone(),
        stages,
        ..Scene::default()
    };
    joined::keep(&mut before);
    for name in missing {
        let Some(bodies) = joined::sticking_at(&before, from, &name.text) else {
            continue;
        };
        joined::stays(scene, &bodies);
        let bodies = bodies.map(|text| Text {
            text,
            ..name.clone()
        });
        let is_said = contacts.0.iter().any(|(other, entry)| {
            let pair = entry.as_ref().map(|contact| &contact.bodies.items);
            let names =
                |pair: &[Text; 2]| bodies.iter().all(|b| pair.iter().any(|p| p.text == b.text));
            other.text == name.text || pair.is_some_and(names)
        });
        if !is_said {
            let pair = Pair {
                span: name.span,
                items: bodies,
            };
            let contact = ContactFile {
                law: Some(LawName::Sticking),
                ..ContactFile::between(name.span, pair)
            };
            // Before the supports and strings, which stand last.
            contacts.0.insert(0, (name, Some(contact)));
        }
    }
}

/// Symbols for where the bodies are when a stage begins; no parameter has a blank in its name.
fn places(scene: &SceneFile, stage: &str) -> Vec<[Symbol; 3]> {
    let names = scene.bodies.0.iter().map(|(name, _)| &name.text);
    names
        .map(|body| {
            ["x", "y", "angle"]
                .map(|what| Symbol::from(format!("{what} of {body} when {stage} begins").as_str()))
        })
        .collect()
}

/// What a stage goes on from, the motion during which it happens with its name, and the coordinates that linkages have left.
type Begins<'a> = (
    Option<usize>,
    Option<(usize, &'a str)>,
    &'a BTreeMap<Symbol, Expr>,
);

/// Reads one stage.
fn one(
    file: &SceneFile,
    stage: &StageFile,
    (from, during, left_at): Begins<'_>,
    whole: &Scene,
    symbols: Symbols,
) -> (Option<Stage>, Symbols, Vec<Fault>) {
    let mut r = Resolver::new(file, symbols, Vec::new(), Vec::new());
    let mut scene = Scene {
        title: whole.title.clone(),
        source: whole.source.clone(),
        parameters: whole.parameters.clone(),
        domains: whole.domains.clone(),
        gains_energy: whole.gains_energy,
        ..Scene::default()
    };
    let places = from.map_or_else(Vec::new, |_| places(file, &stage.name.text));
    let mut from_file = Vec::new();
    for (b, [x, y, _]) in places.iter().enumerate() {
        // First from the file, so that a composite finds its parts.
        from_file.push(r.center(b));
        r.body_places[b] = Place::Done(Some([Expr::symbol(x), Expr::symbol(y)]));
    }
    r.point_places.fill(Place::Untouched);
    if stage.impact.is_some() && !left_at.is_empty() {
        for i in 0..r.point_places.len() {
            let at = r.point(i);
            let at = at.map(|at| at.map(|e| e.substitute(left_at)));
            r.point_places[i] = Place::Done(at);
        }
    }
    r.fill(&mut scene);
    scene.figure = whole.figure.clone();
    let file_places = in_file(&scene, &from_file);
    for (b, (body, [_, _, angle])) in scene.bodies.iter_mut().zip(&places).enumerate() {
        let turned = Expr::symbol(angle);
        if let (Shape::Composite { parts }, Some(center)) = (&mut body.shape, &from_file[b]) {
            let by = &turned - &body.angle;
            move_parts(parts, [center, &body.center], &by);
        }
        body.angle = turned;
    }
    let starts = starts(&mut r, &scene, stage, from);
    let during = during.map(|(index, first)| During {
        stage: index,
        // No parameter has a blank in its name.
        time: Symbol::from(format!("time of {first}").as_str()),
        name: first.into(),
    });
    let lasts = during.as_ref().map(|d| Expr::symbol(&d.time));
    let kind = kind::kind(&mut r, &mut scene, stage, &file_places, lasts.as_ref());
    if let Some(StageKind::Impact { one_sided, .. }) = &kind {
        let strings: Vec<&OneSided> = one_sided.iter().filter(|o| o.is_string).collect();
        tie(&mut scene, &strings, &mut r.claims);
    }
    // Motion before an impact, and places after another stage, are known only when the stages before it are worked out;
    // they are checked then.
    r.claims.retain(|c| match &c.claim {
        Claim::Approach(_) | Claim::Hinge(_) | Claim::Rests(_) => false,
        Claim::AtParticle { .. } | Claim::Placed(_) => places.is_empty(),
        _ => true,
    });
    let Resolver {
        symbols,
        mut faults,
        claims,
        ..
    } = r;
    if faults.is_empty() {
        faults.extend(check(&mut scene, &claims));
    }
    if kind.is_none() && faults.is_empty() {
        // Never silently: without this stage the scene would be another one.
        faults.push(Fault::new(stage.name.span, "this stage could not be read"));
    }
    let read = kind.map(|kind| Stage {
        name: stage.name.text.clone(),
        from,
        during,
        apart: Vec::new(),
        start: starts,
        kind,
        places,
        earlier: Vec::new(),
        scene,
    });
    (read, symbols, faults)
}

/// Where the file puts the bodies: centers, as far as they were found from the file alone, and angles.
fn in_file(scene: &Scene, centers: &[Option<Vector>]) -> Vec<[Expr; 3]> {
    let bodies = scene.bodies.iter().enumerate();
    bodies
        .map(|(b, body)| {
            let given = centers.get(b).cloned().flatten();
            let [x, y] = given.unwrap_or_else(|| body.center.clone());
            [x, y, body.angle.clone()]
        })
        .collect()
}

/// Strings are drawn, and a particle hangs on one at the distance that the string spans.
fn tie(scene: &mut Scene, strings: &[&OneSided], claims: &mut [Claimed]) {
    for string in strings {
        if scene.figure.string(&string.name).is_none() {
            scene.figure.strings.push((string.name.clone(), None));
        }
    }
    for claimed in claims {
        if let Claim::AtParticle { offset, at, body } = &mut claimed.claim
            && let Some(string) = strings.iter().find(|o| o.name == *at)
        {
            *offset = string.gap(&scene.bodies[*body].center);
        }
    }
}

/// The values at which linkages on the way to a stage have left their coordinates: an impact finds the points that the file
/// gives by a coordinate where its last value puts them.
fn left_at(stages: &[Option<Stage>], from: Option<usize>) -> BTreeMap<Symbol, Expr> {
    let mut out = BTreeMap::new();
    let mut before = from;
    while let Some(Some(stage)) = before.and_then(|i| stages.get(i)) {
        if let StageKind::Linkage(linkage) = &stage.kind {
            let [_, end] = &linkage.ends;
            out.entry(linkage.coordinate.clone())
                .or_insert_with(|| end.clone());
        }
        before = stage.from;
    }
    out
}

/// Carries the parts of a composite along with its center, turned by an angle about it.
fn move_parts(parts: &mut [Body], [from, to]: [&Vector; 2], by: &Expr) {
    let [cos, sin] = [by.cos(), by.sin()];
    for part in parts {
        let [x, y] = minus(&part.center, from);
        part.center = [
            &to[0] + &(&(&x * &cos) - &(&y * &sin)),
            &to[1] + &(&(&x * &sin) + &(&y * &cos)),
        ];
        part.angle = &part.angle + by;
    }
}

/// Bodies that start otherwise.
fn starts(
    r: &mut Resolver<'_>,
    scene: &Scene,
    stage: &StageFile,
    from: Option<usize>,
) -> Vec<(usize, Option<Vector>, Option<Expr>)> {
    let Some(map) = &stage.start else {
        return Vec::new();
    };
    if from.is_some() {
        let message = "a stage that follows another takes over its motion";
        let hint = "`start` belongs to a stage with \"from\": \"start\"";
        r.report(map.1.opening(), message, hint);
        return Vec::new();
    }
    let mut out = Vec::new();
    for (name, entry) in entries(Some(map)) {
        let StartFile { velocity, spin, .. } = entry;
        let Some(b) = r.moving(name) else { continue };
        let spin = spin.as_ref().and_then(|w| r.read(w, Quantity::SPIN));
        let turning = spin.clone().unwrap_or_else(|| scene.bodies[b].spin.clone());
        let velocity = match velocity {
            None => None,
            Some(VelocityFile::Components(v)) => r.vector(v, Quantity::VELOCITY),
            Some(VelocityFile::About(a)) => r
                .position(&a.about)
                .map(|p| geometry::turned(&turning, &minus(&scene.bodies[b].center, &p))),
        };
        out.push((b, velocity, spin));
    }
    out
}
