//! What a parameter is, where the file does not say it: that of which it is the one number, such as the mass of a body.

use super::motion::{FallEnd, SlideEnd, Until};
use super::stage::{Stage, StageKind};
use super::{Ask, BlowImpulse, Body, ContactLaw, KnownQuantity, Parameter, Scene, Shape};
use num_traits::{One, Signed};

use crate::dimension::Dimension;
use crate::expr::{Expr, Node, Symbol, Vector, minus};
use crate::formula::{Relation, unicode_name};

/// What a number is, with `{}` where a body or a point stands, and of which.
type Use<'s> = (&'static str, Option<&'s str>, Expr);

/// What an angle of a velocity is, from the x axis or from the y axis.
const TO: [&str; 2] = [
    "angle between the x axis and the first velocity of {}",
    "angle between the y axis and the first velocity of {}",
];
/// The same for what turns about a point.
const FROM: [&str; 2] = [
    "angle at first between the horizontal and the line from that point to {}",
    "angle at first between the vertical and the line from that point to {}",
];
/// What the components of a velocity are: to the right, to the left, up, down.
const ALONG: [&str; 4] = [
    "velocity of {} to the right at first",
    "velocity of {} to the left at first",
    "upward velocity of {} at first",
    "downward velocity of {} at first",
];

/// What an angle of the line is along which a body slides.
const SLOPE: [&str; 2] = [
    "angle between the x axis and the way of {}",
    "angle between the y axis and the way of {}",
];
/// What an angle of a normal is: what is touched lies across it.
const NORMAL: [&str; 2] = [
    "angle between the x axis and the normal of the contact",
    "inclination of the surface that is struck",
];

/// Where a body is, seen from the origin.
const PLACED: [&str; 4] = [
    "distance of {} to the right of the origin at first",
    "distance of {} to the left of the origin at first",
    "height of {} above the origin at first",
    "depth of {} below the origin at first",
];

/// How far a body is from the origin, and the angle of the line to it, from the x axis or from the y axis.
const AWAY: [&str; 3] = [
    "distance of {} from the origin at first",
    "angle at first between the x axis and the line from the origin to {}",
    "angle at first between the y axis and the line from the origin to {}",
];
/// The same for the impulse of a string.
const STRING: [&str; 2] = [
    "angle between the x axis and the string",
    "angle between the y axis and the string",
];

/// The same of a point.
const POINT: [&str; 4] = [
    "distance of {} to the right of the origin",
    "distance of {} to the left of the origin",
    "height of {} above the origin",
    "depth of {} below the origin",
];

/// Gives words to the parameters that have none and stand alone for a number of a body, a contact or a motion.
pub(super) fn infer(scene: &mut Scene) {
    let meanings: Vec<(usize, String)> = {
        let uses = uses(scene);
        let all = scene.parameters.iter().enumerate();
        // A statement says what its letters are.
        let is_said = |name| is_introduced(scene, name) || is_told_before(scene, name);
        let unsaid = all.filter(|(_, p)| p.meaning.is_empty() && !is_said(&p.name));
        let all = unsaid.filter_map(|(i, p)| Some((i, words(scene, &uses, &p.name)?)));
        told_apart(scene, all.collect())
    };
    for (i, meaning) in meanings {
        for stage in &mut scene.stages {
            let name = &scene.parameters[i].name;
            let own = stage.scene.parameters.iter_mut();
            let mut own = own.filter(|p| p.name == *name);
            if let Some(own) = own.next() {
                own.meaning.clone_from(&meaning);
            }
        }
        scene.parameters[i].meaning = meaning;
    }
}

/// Meanings, those that are the same with where each holds: `coefficient of restitution at K`.
fn told_apart(scene: &Scene, all: Vec<(usize, String)>) -> Vec<(usize, String)> {
    let place = |i: usize| {
        let name = &scene.parameters[i].name;
        let is_it = |e: &Expr| e.as_symbol() == Some(name);
        let of_law = |law: &ContactLaw| match law {
            ContactLaw::Frictionless { restitution } => is_it(restitution),
            ContactLaw::Friction(law) => is_it(&law.restitution) || is_it(&law.mu),
            _ => false,
        };
        let stages = scene.stages.iter().map(|stage| &stage.scene);
        let mut contacts = [scene].into_iter().chain(stages).flat_map(|s| &s.contacts);
        if let Some(contact) = contacts.find(|c| of_law(&c.law)) {
            return Some(format!(" at {}", contact.name));
        }
        let uses_it = |stage: &&Stage| {
            let mut found = false;
            let mut look = |e: &mut Expr| found |= is_it(e);
            stage.kind.clone().formulas_mut(&mut look);
            found
        };
        let mut motions = scene.stages.iter();
        Some(format!(" in “{}”", motions.find(uses_it)?.name))
    };
    let same = |words: &str| all.iter().filter(|(_, other)| other == words).count() > 1;
    let apart = |(i, words): &(usize, String)| match same(words).then(|| place(*i)).flatten() {
        Some(place) => (*i, format!("{words}{place}")),
        None => (*i, words.clone()),
    };
    all.iter().map(apart).collect()
}

/// Whether a statement introduces a symbol, by its name or its Greek letter: `of length l`. Behind a sign or another symbol it
/// is part of a formula, which says nothing of it: `−m g`.
fn is_introduced(scene: &Scene, name: &Symbol) -> bool {
    let is_symbol = |word: &str| {
        let mut all = scene.parameters.iter().map(|p| &p.name);
        all.any(|p| word == p.as_ref() || word == unicode_name(p))
    };
    let letter = unicode_name(name);
    let text = scene.statement.as_str();
    let is_inner = |c: char| c.is_alphanumeric() || c == '_';
    let mut before = 0;
    for word in text.split_inclusive(|c| !is_inner(c)) {
        let (lead, at) = (
            text[..before].trim_end(),
            word.trim_end_matches(|c| !is_inner(c)),
        );
        before += word.len();
        if at != name.as_ref() && at != letter {
            continue;
        }
        let last = lead.rsplit(|c| !is_inner(c)).next().unwrap_or("");
        if !lead.ends_with(['−', '-', '+', '=', '*', '/', '·', '√', '^']) && !is_symbol(last) {
            return true;
        }
    }
    false
}

/// Whether the page of a lone impact writes out the motion just before, of which a symbol is a component.
fn is_told_before(scene: &Scene, name: &Symbol) -> bool {
    // A length stands in it through the turning of a body, which says nothing of it.
    let is_length = |p: &Parameter| p.dimension == Dimension::new(0, 1, 0);
    if scene.parameter(name).is_some_and(is_length) {
        return false;
    }
    let moves = |body: &Body| {
        let is_part = body.velocity.iter().any(|e| e.mentions(name));
        let is_spin = body.spin.mentions(name);
        match scene.statement.is_empty() {
            true => is_part && polar(&body.velocity).is_none(),
            false => is_part || is_spin,
        }
    };
    scene.stages.is_empty() && scene.bodies.iter().any(moves)
}

/// What a parameter is, by its first use: `mass of the rod`, `mass of each of body a and body b`.
fn words(scene: &Scene, uses: &[Use<'_>], name: &Symbol) -> Option<String> {
    let called = |body: &str| called(scene, body);
    let is_it = |e: &Expr| e.as_symbol() == Some(name) || (-e).as_symbol() == Some(name);
    let mut mine = uses.iter().filter(|(.., e)| is_it(e)).peekable();
    // A rod of the length 2 ℓ; that says more than where its center is.
    let is_size = |what: &&str| !PLACED.contains(what) && !POINT.contains(what);
    let multiple = |k: Expr| {
        let is_multiple = |e: &Expr| is_it(&(&k * e));
        let mut all = uses.iter();
        let (what, body, _) = all.find(|(_, body, e)| body.is_some() && is_multiple(e))?;
        Some(what.replace("{}", &called((*body)?)))
    };
    if !mine.peek().is_some_and(|(what, ..)| is_size(what))
        && let Some(size) = multiple(Expr::ratio(1, 2))
    {
        return Some(format!("half the {size}"));
    }
    let Some((what, first, _)) = mine.next() else {
        return Some(format!("twice the {}", multiple(Expr::from(2))?));
    };
    let mut bodies: Vec<String> = first.iter().map(|body| called(body)).collect();
    for (_, body, _) in mine.filter(|(also, ..)| also == what) {
        let body = body.map(called);
        bodies.extend(body.filter(|body| !bodies.contains(body)));
    }
    let moving = scene.moving().count();
    if moving > 2 && bodies.len() == moving && !POINT.contains(what) {
        return Some(what.replace("{}", "each body"));
    }
    let last = bodies.pop();
    let of = match (bodies.is_empty(), last) {
        (false, Some(last)) => format!("each of {} and {last}", bodies.join(", ")),
        (_, last) => last.unwrap_or_default(),
    };
    Some(what.replace("{}", &of))
}

/// What a sentence calls a body of the scene, or a part of one.
fn called(scene: &Scene, body: &str) -> String {
    let is_it = |b: &&Body| b.name == body;
    if let Some(found) = scene.bodies.iter().find(is_it) {
        return found.called();
    }
    let mut parts = scene.bodies.iter().flat_map(|b| match &b.shape {
        Shape::Composite { parts } => parts.as_slice(),
        _ => Default::default(),
    });
    let part = parts.find(is_it).map(Body::called);
    let stages = scene.stages.iter().map(|stage| &stage.scene);
    let contacts = [scene].into_iter().chain(stages).flat_map(|s| &s.contacts);
    let points = scene.points.iter().map(|p| &p.name);
    let mut places = points.chain(contacts.map(|c| &c.name));
    let part = part.or_else(|| places.find(|name| *name == body).cloned());
    let part = part.unwrap_or_else(|| format!("the {}", body.replace('_', " ")));
    match part.strip_prefix("body ") {
        Some(letter) => format!("part {letter}"),
        None => part,
    }
}

/// Every number that the scene names alone.
fn uses(scene: &Scene) -> Vec<Use<'_>> {
    let mut out = Vec::new();
    for body in &scene.bodies {
        of_body(body, &mut out);
    }
    let stages = scene.stages.iter().map(|stage| &stage.scene);
    for at in [scene].into_iter().chain(stages) {
        of_impact(at, &mut out);
    }
    for (i, stage) in scene.stages.iter().enumerate() {
        let gravity = stage.kind.gravity();
        out.extend(gravity.map(|g| ("acceleration of gravity", None, g.clone())));
        of_motion(scene, i, &mut out);
    }
    of_wishes(scene, &mut out);
    // Where nothing else is told by a letter, it says where a body or a point is.
    let turns = |stage: &Stage| match &stage.kind {
        StageKind::Turn(turn) => turn.about.iter().all(Expr::is_zero),
        _ => false,
    };
    let turns = scene.stages.iter().any(turns);
    let bodies = scene.bodies.iter();
    for body in bodies.filter(|b| !matches!(b.shape, Shape::Fixed)) {
        if turns && let Some((size, None)) = polar(&body.center) {
            let what = "distance of {} from the pivot at first";
            out.push((what, Some(&body.name), size.clone()));
        }
        placed(&body.name, &body.center, &PLACED, &mut out);
        if let Some((size, Some((axis, angle)))) = polar(&body.center) {
            out.push((AWAY[0], Some(&body.name), size.clone()));
            out.push((AWAY[1 + axis], Some(&body.name), angle.clone()));
        }
    }
    for point in &scene.points {
        placed(&point.name, &point.at, &POINT, &mut out);
    }
    for stage in &scene.stages {
        for contact in &stage.scene.contacts {
            placed(&contact.name, &contact.at, &POINT, &mut out);
        }
    }
    out
}

/// The coordinates of a place, the height first: of a letter that stands for both it says more.
fn placed<'s>(name: &'s str, at: &'s Vector, words: &[&'static str; 4], out: &mut Vec<Use<'s>>) {
    for (e, words) in at.iter().zip(words.chunks(2)).rev() {
        let what = words[usize::from(e.is_negative())];
        out.push((what, Some(name), e.clone()));
    }
}

fn of_body<'s>(body: &'s Body, out: &mut Vec<Use<'s>>) {
    let mut push = |what, e: &Expr| out.push((what, Some(body.name.as_str()), e.clone()));
    if !matches!(body.shape, Shape::Fixed) {
        push("mass of {}", &body.mass);
    }
    if body.inertia_given {
        push("moment of inertia of {}", &body.inertia);
    }
    match &body.shape {
        Shape::Rod { length } => push("length of {}", length),
        Shape::Disk { radius } | Shape::Ring { radius } | Shape::Sphere { radius } => {
            push("radius of {}", radius);
        }
        Shape::Rectangle { width, height } => {
            push("width of {}", width);
            push("height of {}", height);
        }
        _ => {}
    }
    if let Some((speed, angle)) = polar(&body.velocity) {
        push("speed of {} at first", speed);
        if let Some((axis, angle)) = angle {
            push(TO[axis], angle);
        }
    } else {
        for (e, words) in body.velocity.iter().zip(ALONG.chunks(2)) {
            push(words[usize::from(e.is_negative())], e);
        }
    }
    push(
        match body.spin.as_symbol() {
            Some(_) => "angular velocity of {} at first",
            None => "angular velocity of {} at first, clockwise",
        },
        &body.spin,
    );
    push("angle between the x axis and that of {}", &body.angle);
    if let Shape::Composite { parts } = &body.shape {
        parts.iter().for_each(|part| of_body(part, out));
    }
}

/// The size of a vector along an axis, or at an angle to one, v cosθ and v sinθ of either sign, with that axis and angle.
fn polar([x, y]: &Vector) -> Option<(&Expr, Option<(usize, &Expr)>)> {
    if x.is_zero() || y.is_zero() {
        let along = if y.is_zero() { x } else { y };
        return symbol_in(along).map(|size| (size, None));
    }
    let parts = |e: &Expr| -> Vec<Expr> {
        let is_sign = |f: &Expr| f.as_number().is_some_and(|k| k.abs().is_one());
        let factors = e.factors().iter();
        factors.filter(|f| !is_sign(f)).cloned().collect()
    };
    let size = x.factors().iter().find(|f| f.as_symbol().is_some())?;
    let is = |e: &Expr, of: Expr| {
        let parts = parts(e);
        parts.len() == 2 && parts.contains(size) && parts.contains(&of)
    };
    turned(x, y, is).map(|at| (size, Some(at)))
}

/// The angle of a unit vector, (cosθ, sinθ) or (sinθ, cosθ) of either signs, with the axis that it is counted from.
fn inclination([x, y]: &Vector) -> Option<(usize, &Expr)> {
    turned(x, y, |e, of| *e == of || *e == -of)
}

/// The axis and the angle to it of two components that are made of its cosine and its sine.
fn turned<'e>(
    x: &'e Expr,
    y: &Expr,
    is: impl Fn(&Expr, Expr) -> bool,
) -> Option<(usize, &'e Expr)> {
    x.factors().iter().find_map(|f| {
        let Node::Call(_, angle) = f.node() else {
            return None;
        };
        let from_x = is(x, angle.cos()) && is(y, angle.sin());
        let from_y = is(x, angle.sin()) && is(y, angle.cos());
        (from_x || from_y).then_some((usize::from(!from_x), angle))
    })
}

/// The one name of `v` and of `−v`.
fn symbol_in(e: &Expr) -> Option<&Expr> {
    let factors = e.factors();
    let is_alone = e.symbols().len() == 1 && factors.len() <= 2;
    factors
        .iter()
        .find(|f| f.as_symbol().is_some())
        .filter(|name| is_alone && (e == *name || *e == -*name))
}

fn of_impact<'s>(scene: &'s Scene, out: &mut Vec<Use<'s>>) {
    for contact in &scene.contacts {
        match &contact.law {
            ContactLaw::Frictionless { restitution } => {
                out.push(("coefficient of restitution", None, restitution.clone()));
            }
            ContactLaw::Friction(law) => {
                out.push(("coefficient of restitution", None, law.restitution.clone()));
                out.push(("coefficient of friction", None, law.mu.clone()));
            }
            _ => {}
        }
        let normal = contact.normal.iter().filter_map(inclination);
        out.extend(normal.map(|(axis, angle)| (NORMAL[axis], None, angle.clone())));
    }
    for blow in &scene.blows {
        if let BlowImpulse::Given(impulse) = &blow.impulse
            && let Some((size, _)) = polar(impulse)
        {
            out.push(("impulse of the blow", None, size.clone()));
        }
    }
    for known in &scene.after {
        let what = match known.what {
            KnownQuantity::Velocity { to: None, .. } => {
                "component of the velocity of {} just after"
            }
            KnownQuantity::Spin => "angular velocity of {} just after",
            KnownQuantity::Velocity { .. } => "component of the relative velocity of {} just after",
        };
        let name = scene.bodies[known.body].name.as_str();
        // Of −u only the author knows what u is.
        if known.value.as_symbol().is_some() {
            out.push((what, Some(name), known.value.clone()));
        }
    }
}

/// What is sought so that an answer becomes a parameter, which plays no part before: `"solve": "v", "holds": "phi = theta"`.
fn of_wishes<'s>(scene: &'s Scene, out: &mut Vec<Use<'s>>) {
    for question in &scene.questions {
        let Ask::Condition {
            left,
            relation: Relation::Equal,
            right,
            ..
        } = &question.ask
        else {
            continue;
        };
        for (answer, wished) in [(left, right), (right, left)] {
            let name = answer.as_symbol();
            let of = name.and_then(|name| scene.question(name));
            let Some(of) = of else { continue };
            let (what, body) = match &of.ask {
                Ask::Angle { body, .. } => ("angle through which {} is to turn", Some(*body)),
                Ask::Velocity { body, .. } => ("velocity that {} is to have", Some(*body)),
                Ask::Spin { body, .. } => ("angular velocity that {} is to have", Some(*body)),
                Ask::Distance => {
                    let stage = of.stage.map(|i| &scene.stages[i]);
                    let moved = stage.and_then(|stage| stage.kind.moved().first().copied());
                    ("distance that {} is to go", moved)
                }
                Ask::Time => ("time that it is to take", None),
                _ => continue,
            };
            let body = body.map(|b| scene.bodies[b].name.as_str());
            out.push((what, body, wished.clone()));
        }
    }
}

fn of_motion<'s>(scene: &'s Scene, stage: usize, out: &mut Vec<Use<'s>>) {
    let mut push = |what, body: Option<usize>, e: &Expr| {
        out.push((what, body.map(|b| scene.bodies[b].name.as_str()), e.clone()));
    };
    match &scene.stages[stage].kind {
        StageKind::Turn(turn) => {
            let body = Some(turn.body);
            match &turn.until {
                Until::By(angle) => push("angle through which {} turns", body, angle),
                Until::For(time) => push("time for which {} turns", body, time),
                _ => {}
            }
            if let Some(moment) = &turn.torque {
                push("moment on {}", body, moment);
            }
            let arm = minus(&scene.bodies[turn.body].center, &turn.about);
            let stays =
                |stage: &Stage| !matches!(stage.kind, StageKind::Fall(_) | StageKind::Slide(_));
            if scene.stages[..stage].iter().all(stays)
                && let Some((size, angle)) = polar(&arm)
            {
                let about = "distance of {} from the point about which it turns";
                push(about, body, size);
                if let Some((axis, angle)) = angle {
                    push(FROM[axis], body, angle);
                }
            }
        }
        StageKind::Slide(slide) => {
            let body = Some(slide.body);
            if let Some(mu) = &slide.friction {
                push("coefficient of sliding friction", None, mu);
            }
            if let Some(spring) = &slide.spring {
                push("stiffness of the spring", None, &spring.stiffness);
            }
            if let Some((axis, angle)) = inclination(&slide.along) {
                push(SLOPE[axis], body, angle);
            }
            if let Some(force) = &slide.force {
                push("force along the line", None, force);
            }
            match &slide.until {
                SlideEnd::Distance(way) => push("distance that {} goes", body, way),
                SlideEnd::Time(time) => push("time for which {} moves", body, time),
                _ => {}
            }
        }
        StageKind::Linkage(linkage) => {
            let coordinate = scene.parameter(&linkage.coordinate);
            let what = match coordinate.is_some_and(|p| p.dimension.is_none()) {
                true => "angle at which the motion ends",
                false => "place at which the motion ends",
            };
            push(what, None, &linkage.ends[1]);
        }
        StageKind::Impact { one_sided, .. } => {
            for string in one_sided.iter().filter(|o| o.is_string) {
                if let Some((axis, angle)) = inclination(&string.normal) {
                    push(STRING[axis], None, angle);
                }
            }
        }
        StageKind::Fall(fall) => {
            let body = Some(fall.body);
            match &fall.until {
                FallEnd::Drop(height) => {
                    let what = if fall.rising || height.as_symbol().is_none() {
                        "height of the rise of {}"
                    } else {
                        "height of the fall of {}"
                    };
                    push(what, body, height);
                }
                FallEnd::Range(range) => push("horizontal distance that {} flies", body, range),
                FallEnd::Time(time) => push("time for which {} flies", body, time),
                _ => {}
            }
        }
        _ => {}
    }
}
