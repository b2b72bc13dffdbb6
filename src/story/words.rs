//! Sentences about stages, made from what was found of them: what happens, which forces have impulses, what is open.

use super::motion::angular;
use super::{Case, StageTold, change, line};
use crate::algebra::Sign;
use crate::answer::calc::{Seen, is_zero, sign, tidy};
use crate::derive;
use crate::expr::{Expr, Symbol, cross, dot};
use crate::formula::{Sentence, listed, sentence};
use crate::scene::{
    BlowImpulse, Contact, ContactLaw, Fall, FallEnd, OneSided, Scene, Slide, SlideEnd, Stage,
    StageKind, Turn, Until,
};

/// Which supports act in an outcome.
pub(super) fn active(case: &Case) -> String {
    let names: Vec<String> = case.active.iter().map(|n| format!("`{n}`")).collect();
    let acts = match names.as_slice() {
        [] if !case.rubs.is_empty() => return case.rubs.replace('`', ""),
        [] => String::from("no support or string acts"),
        [one] => format!("{one} acts"),
        several => format!("{} act", listed(several)),
    };
    match case.rubs.as_str() {
        "" => acts,
        rubs => format!("{acts} and {rubs}"),
    }
}

/// What each support and string does in an outcome: it pushes or pulls, or comes free or goes slack, or neither; or how a
/// contact rubs.
fn acting(one_sided: &[OneSided], case: &Case) -> String {
    let mut does: Vec<([&str; 2], Vec<String>)> = Vec::new();
    for o in one_sided {
        let verbs = match (case.active.contains(&o.name), o.is_string) {
            (true, true) => ["pulls", "pull"],
            (true, false) => ["pushes", "push"],
            (false, true) if case.idle.contains(&o.name) => ["stays taut", "stay taut"],
            (false, false) if case.idle.contains(&o.name) => ["only touches", "only touch"],
            (false, true) => ["goes slack", "go slack"],
            (false, false) => ["comes free", "come free"],
        };
        let string = if o.is_string { "the string " } else { "" };
        let name = format!("{string}`{}`", o.name);
        match does.iter_mut().find(|(v, _)| *v == verbs) {
            Some((_, names)) => names.push(name),
            None => does.push((verbs, vec![name])),
        }
    }
    let each = does.into_iter().map(|([one, more], names)| {
        let verb = if names.len() == 1 { one } else { more };
        format!("{} {verb}", listed(&names))
    });
    let mut all: Vec<String> = each.collect();
    if !case.rubs.is_empty() {
        all.push(case.rubs.clone());
    }
    all.join(", ")
}

/// Which outcomes lead through an outcome of a stage to what follows it.
pub(super) fn leading(stages: &[StageTold], parent: usize, case: usize) -> String {
    let several = line(stages, (parent, case)).filter(|(i, _)| stages[*i].cases.len() > 1);
    let mut parts: Vec<_> = several.map(|(i, k)| called(&stages[i].cases, k)).collect();
    parts.reverse();
    parts.join("; ")
}

/// What acts in one of several outcomes, with its number where that is the same in another.
fn called(cases: &[Case], k: usize) -> String {
    let words = active(&cases[k]);
    let others = cases.iter().filter(|case| active(case) == words);
    match others.count() {
        1 => words,
        _ => format!("{words}, case {}", k + 1),
    }
}

impl Case {
    /// What must hold for it: `a ≥ h and b ≥ 0`, of a coefficient of friction as the bounds of it.
    pub fn holds_where(&self) -> Sentence {
        let all: Vec<&Expr> = self.conditions.iter().map(|(_, e)| e).collect();
        let bounds: Vec<_> = all.iter().map(|e| self.bound(e)).collect();
        if let [Some(one), Some(other)] = bounds.as_slice()
            && one.is_least != other.is_least
        {
            let (low, high) = match one.is_least {
                true => (one, other),
                false => (other, one),
            };
            return sentence!("{} ≤ {} ≤ {}", &low.at, &low.of, &high.at);
        }
        let each = all.into_iter().zip(bounds);
        let each = each.map(|(e, bound)| match bound {
            Some(b) if b.is_least => sentence!("{} ≥ {}", &b.of, &b.at),
            Some(b) => sentence!("{} ≤ {}", &b.of, &b.at),
            None => Sentence::not_negative(e),
        });
        Sentence::join(each, " and ")
    }

    /// `e ≥ 0` as a bound on the coefficient of friction, where it is one on the whole domain.
    fn bound(&self, e: &Expr) -> Option<Bound> {
        let mut laws = self.scene.decided().map(|(_, decided)| &decided.law);
        let of = laws.find_map(|law| law.mu.as_symbol().cloned())?;
        let slope = tidy(&e.derivative(&of), &self.scene.domains).ok()?;
        let is_least = match sign(&slope, &self.scene.domains) {
            Seen::Proved(Sign::Positive) => true,
            Seen::Proved(Sign::Negative) => false,
            _ => return None,
        };
        let at = -(e.put(&of, &Expr::zero()) / &slope);
        let at = tidy(&at, &self.scene.domains).ok()?;
        let free = !slope.symbols().contains(&of) && !at.symbols().contains(&of);
        free.then_some(Bound { of, is_least, at })
    }
}

/// A coefficient of friction is at least this, or at most.
struct Bound {
    of: Symbol,
    is_least: bool,
    at: Expr,
}

/// What happens in a stage.
pub(super) fn stage(told: &StageTold) -> Vec<Sentence> {
    let stage = &told.placed;
    let scene = &stage.scene;
    let mut out: Vec<Sentence> = Vec::new();
    match &stage.kind {
        StageKind::Impact { one_sided, .. } => {
            if told.cases.first().is_some_and(nothing_collides) {
                out.push("nothing collides: the bodies do not approach where they touch".into());
            }
            for case in &told.cases {
                let mut all: Vec<Sentence> = Vec::new();
                let several = told.cases.len() > 1 || !one_sided.is_empty();
                if several {
                    all.push(acting(one_sided, case).into());
                }
                let changes = in_one(change::words(told, case));
                all.extend(changes.into_iter().map(Sentence::from));
                if all.is_empty() {
                    let what = match scene.moving().count() {
                        1 => "which way it moves depends on the values",
                        _ => "which way the bodies move depends on the values",
                    };
                    all.push(what.into());
                }
                // Of several, an outcome is one sentence, with the condition that it hangs on.
                if several && !case.conditions.is_empty() && !all.is_empty() {
                    let does = Sentence::join(all, "; ");
                    out.push(sentence!("where {}: {}", case.holds_where(), does));
                } else {
                    out.extend(all);
                }
            }
        }
        StageKind::Turn(turn) => out.push(turning(stage, told, turn)),
        StageKind::Slide(slide) => out.push(sliding(stage, told, slide)),
        StageKind::Fall(fall) => out = falling(told, fall),
        StageKind::Linkage(linkage) => {
            let name = |(b, _): &(usize, _)| format!("`{}`", scene.bodies[*b].name);
            let names: Vec<String> = linkage.places.iter().map(name).collect();
            let verb = match names.len() {
                1 => "moves",
                _ => "move together",
            };
            let lead = format!("{} {verb}", listed(&names));
            let coordinate = Expr::symbol(&linkage.coordinate);
            let [from, to] = &linkage.ends;
            let is_angle =
                |p: &crate::scene::Parameter| p.name == linkage.coordinate && p.unit == "rad";
            let angle = match scene.parameters.iter().any(is_angle) {
                true => "the angle ",
                false => "",
            };
            out.push(match *from == coordinate {
                true => sentence!("{} from {}{} to {}", lead, angle, from, to),
                false => sentence!("{}: {} goes from {} to {}", lead, &coordinate, from, to),
            });
        }
        StageKind::Wind(wind) => {
            let (free, name) = (" of it is free; `", &scene.bodies[wind.body].name);
            out.push(sentence!(
                "the rope winds up until {}{}{}` keeps its speed",
                &wind.to,
                free,
                name
            ));
        }
    }
    if let (Some(during), Some(first)) = (&stage.during, out.first_mut()) {
        *first = sentence!("during `{}`, {}", &during.name, &*first);
    }
    out
}

/// Whether nothing approaches what it touches in an impact, and nothing is struck or set free.
fn nothing_collides(case: &Case) -> bool {
    let scene = &case.scene;
    let rests = |contact: &Contact| {
        let gap = contact.relative_velocity(scene);
        let gap = match &contact.normal {
            Some(normal) if contact.law != ContactLaw::Sticking => vec![dot(&gap, normal)],
            _ => gap.to_vec(),
        };
        let mut parts = gap.iter().map(|e| is_zero(e, &scene.domains));
        contact.law != ContactLaw::None && parts.all(|zero| zero == Some(true))
    };
    let is_quiet = scene.blows.is_empty() && scene.after.is_empty() && !scene.gains_energy;
    is_quiet && !scene.contacts.is_empty() && scene.contacts.iter().all(rests)
}

/// Short clauses as one sentence; those that have parts themselves stay apart.
fn in_one(clauses: Vec<String>) -> Vec<String> {
    let any = |part: &str| clauses.iter().any(|c| c.contains(part));
    match clauses.as_slice() {
        _ if any(",") => clauses,
        [one, two] if any(" and ") => vec![format!("{one}, and {two}")],
        [_, _, ..] if !any(" and ") => vec![listed(&clauses)],
        _ => clauses,
    }
}

/// A fall or a flight: how far or how long, and who falls along.
fn falling(told: &StageTold, fall: &Fall) -> Vec<Sentence> {
    let scene = &told.placed.scene;
    let name = &scene.bodies[fall.body].name;
    let falls = goes_down(told, fall.body);
    // Without a weight it may slide on ice as well.
    let flies = match fall.gravity {
        Some(_) => "flies freely",
        None => "moves freely",
    };
    let mut out = vec![match (&fall.until, &fall.gravity) {
        (FallEnd::Drop(h), Some(_)) if fall.rising => {
            sentence!("`{}` rises freely through {}", name, measured(&-h, "m"))
        }
        (FallEnd::Drop(h), Some(_)) if h.is_zero() => {
            sentence!(
                "`{}` flies freely back to the height at which this flight begins",
                name
            )
        }
        (FallEnd::Drop(h), Some(_)) => match counted(h, [" lower", " higher"]) {
            (_, " lower") if falls => {
                sentence!("`{}` falls freely through {}", name, measured(h, "m"))
            }
            (down, " lower") => flown(name, flies, (down, " lower")),
            (up, _) => {
                sentence!(
                    "`{}` flies freely until it comes down to a place {} higher",
                    name,
                    measured(&up, "m")
                )
            }
        },
        (FallEnd::Top, _) => sentence!("`{}` flies freely up to its highest point", name),
        (FallEnd::Time(t), Some(_)) if falls => {
            sentence!("`{}` falls freely for {}", name, measured(t, "s"))
        }
        (FallEnd::Time(t), _) => {
            sentence!("`{}` {} for {}", name, flies, measured(t, "s"))
        }
        (FallEnd::Turned(by), _) => {
            sentence!("`{}` {} until it has turned through {}", name, flies, by)
        }
        (FallEnd::Range(s), _) => {
            flown(name, flies, counted(s, [" further right", " further left"]))
        }
        (FallEnd::Drop(h), None) => flown(name, flies, counted(h, [" lower", " higher"])),
    }];
    for cluster in &told.clusters {
        let names = cluster
            .bodies
            .iter()
            .map(|b| format!("`{}`", scene.bodies[*b].name));
        out.push(sentence!(
            "{} turn as one about their common center of mass; nothing has a moment about it, so their spin does not change",
            listed(&names.collect::<Vec<_>>())
        ));
    }
    let is_stuck = |b: &usize| {
        told.clusters
            .iter()
            .any(|cluster| cluster.bodies.contains(b))
    };
    for b in fall.with.iter().filter(|b| !is_stuck(b)) {
        let other = &scene.bodies[*b].name;
        let verb = match fall.gravity.is_some() && goes_down(told, *b) {
            true => "falls",
            false if fall.gravity.is_some() => "flies",
            false => "moves",
        };
        out.push(sentence!("`{}` meanwhile {} freely as well", other, verb));
    }
    for b in fall.bodies() {
        if !is_stuck(&b) && is_zero(&told.after.spin[b], &scene.domains) == Some(false) {
            out.push(sentence!(
                "the spin of `{}` does not change, since nothing has a moment about its center of mass",
                &scene.bodies[b].name
            ));
        }
    }
    out
}

/// A motion along a line: what moves, on what, and how far.
fn sliding(stage: &Stage, told: &StageTold, slide: &Slide) -> Sentence {
    let name = |b: &usize| format!("`{}`", stage.scene.bodies[*b].name);
    let names: Vec<String> = slide.company().iter().map(name).collect();
    let one = names.len() == 1;
    let is_round = one && !slide.level && stage.scene.bodies[slide.body].shape.radius().is_some();
    let slips = told.work.iter().any(|(what, _)| *what == "friction");
    let grips = is_round && !slips && told.way.is_some() && !slide.is_smooth();
    let how = match (grips, &slide.friction, one) {
        (true, Some(_), _) => " rolls without slipping",
        _ if slide.rolling => " rolls without slipping",
        (_, Some(_), true) if is_round && slide.is_smooth() => {
            " slides on a smooth surface, which leaves its spin as it is,"
        }
        (_, Some(_), true) if slide.is_smooth() => " slides on a smooth surface",
        (_, Some(_), false) if slide.is_smooth() => " slide together on a smooth surface",
        (_, Some(_), true) if is_round => " slips on a rough surface, which changes its spin,",
        (_, Some(_), true) if slide.level => " slides on a rough level surface",
        (_, Some(_), false) if slide.level => " slide together on a rough level surface",
        (_, Some(_), true) => " slides on a rough surface",
        (_, Some(_), false) => " slide together on a rough surface",
        (_, None, true) => " moves",
        (_, None, false) => " move",
    };
    let free = slide.friction.is_none() && !grips && !slide.rolling;
    let way = towards(slide).filter(|_| free);
    let lead = listed(&names);
    if let Some(on) = &slide.on {
        let below: Vec<String> = on.company().iter().map(name).collect();
        let verb = match one {
            true if is_round => "slips",
            true => "slides",
            false => "slide",
        };
        let goes = match (on.is_belt(&stage.scene), &on.friction) {
            (true, _) => "keeps its velocity",
            (_, Some(_)) => "moves on a rough floor",
            (_, None) => "moves on a smooth floor",
        };
        let below = listed(&below);
        if told.time.as_ref().is_some_and(Expr::is_zero) {
            return sentence!("{} and {} move together already", lead, below);
        }
        let lead = format!("{lead} {verb} on {below}, which {goes},");
        return match &slide.until {
            SlideEnd::Distance(s) => {
                sentence!("{} over the distance {} along it", lead, measured(s, "m"))
            }
            SlideEnd::Time(t) => sentence!("{} for {}", lead, measured(t, "s")),
            SlideEnd::Rolls => sentence!("{} until it rolls", lead),
            _ => sentence!("{} until both move together", lead),
        };
    }
    if told.time.as_ref().is_some_and(Expr::is_zero) {
        return match (&slide.until, one) {
            (SlideEnd::Rolls, _) => sentence!("{} rolls already", lead),
            (SlideEnd::Distance(_), _) => sentence!("{} covers no distance here", lead),
            (_, true) => sentence!("{} is at rest already", lead),
            (_, false) => sentence!("{} are at rest already", lead),
        };
    }
    let lead = match free {
        true => {
            let together = if one { "" } else { " together" };
            lead + how + way.unwrap_or(" along a straight line") + together
        }
        false => lead + how,
    };
    let strings = slide.strings.iter().map(|s| {
        let list = |all: &[usize]| listed(&all.iter().map(name).collect::<Vec<_>>());
        let rough = s.friction.as_ref().map_or("", |_| " on a rough surface");
        let under = |p| (format!(" and under {}", name(&p)), ", half as fast");
        let (under, half) = s.under.map(under).unwrap_or_default();
        let (over, to) = (list(&s.over), list(&s.to));
        format!(", and the string over {over}{under} takes {to} along{rough}{half}")
    });
    let strings = strings.collect::<String>();
    let lead = match slide.spring.as_ref().map(|spring| &spring.relaxed) {
        None => lead.into(),
        Some(relaxed) if relaxed.is_zero() => sentence!("{}, pressing a spring,", lead),
        Some(relaxed) => match sign(relaxed, &stage.scene.domains) {
            Seen::Proved(Sign::Positive) => {
                let pressed = measured(relaxed, "m");
                sentence!("{}, on a spring pressed by {} at first,", lead, pressed)
            }
            _ => sentence!("{}, on a spring,", lead),
        },
    };
    match &slide.until {
        SlideEnd::Distance(s) if way.is_some() => {
            sentence!("{} by {}{}", lead, measured(s, "m"), strings)
        }
        SlideEnd::Distance(s) => {
            sentence!("{} over the distance {}{}", lead, measured(s, "m"), strings)
        }
        SlideEnd::Time(t) => sentence!("{} for {}{}", lead, measured(t, "s"), strings),
        SlideEnd::Stops if one => sentence!("{} until it stops{}", lead, strings),
        SlideEnd::Stops => sentence!("{} until they stop{}", lead, strings),
        SlideEnd::Rolls | SlideEnd::Together => sentence!("{} until it rolls{}", lead, strings),
    }
}

/// The direction of a motion along an axis; none seen from above, where none is up.
fn towards(slide: &Slide) -> Option<&'static str> {
    let [x, y] = slide.along.each_ref().map(|e| [e.is_one(), (-e).is_one()]);
    let ways = [" to the right", " to the left", " up", " down"];
    let mut all = [x, y].concat().into_iter().zip(ways);
    let way = all.find(|(is, _)| *is).map(|(_, way)| way);
    way.filter(|_| !slide.level)
}

/// Whether a body is known not to rise at the beginning.
fn goes_down(told: &StageTold, body: usize) -> bool {
    match sign(&told.before.velocity[body][1], &told.placed.scene.domains) {
        Seen::Proved(sign) => matches!(sign, Sign::Zero | Sign::Negative | Sign::NotPositive),
        _ => false,
    }
}

/// A formula, or a number with its unit.
fn measured(e: &Expr, unit: &str) -> Sentence {
    match e.is_constant() && !e.is_zero() {
        true => sentence!("{} {}", e, unit),
        false => e.into(),
    }
}

/// A flight that ends at a place so far away.
fn flown(name: &str, flies: &'static str, (far, way): (Expr, &'static str)) -> Sentence {
    let far = measured(&far, "m");
    sentence!("`{}` {} until it is {}{}", name, flies, far, way)
}

/// A distance without the minus sign it may begin with, and the word for its direction.
fn counted(e: &Expr, [plus, minus]: [&'static str; 2]) -> (Expr, &'static str) {
    match crate::formula::write_plain(e).starts_with('-') {
        true => (-e, minus),
        false => (e.clone(), plus),
    }
}

/// A rotation: which bodies turn, about what, in which sense, and whether weight or a moment makes them faster or slower.
fn turning(stage: &Stage, told: &StageTold, turn: &Turn) -> Sentence {
    let domains = &stage.scene.domains;
    let name = |b: usize| format!("`{}`", stage.scene.bodies[b].name);
    let carried = carried(told, turn);
    let names: Vec<String> = carried.iter().map(|b| name(*b)).collect();
    let (before, after) = (&told.before.spin[turn.body], &told.after.spin[turn.body]);
    let sense = match super::motion::sense(stage, before, turn) {
        Ok((1, None)) => " counterclockwise",
        Ok((-1, None)) => " clockwise",
        _ => "",
    };
    let same = is_zero(&(before - after), domains) == Some(true);
    let from_rest = is_zero(before, domains) == Some(true);
    let gain = Expr::sum(told.work.iter().map(|(_, w)| w.clone()));
    let hangs = carried.iter().all(|b| stage.scene.bodies[*b].is_particle());
    let is_one = names.len() == 1;
    let turns = match hangs && turn.gravity.is_some() {
        true if is_one => "swings",
        true => "swing together",
        false if is_one => "turns",
        false => "turn as one body",
    };
    let rate = match change::way(&gain, domains, &[]) {
        _ if matches!(turn.until, Until::Stops) && is_one => ", and comes to rest",
        _ if matches!(turn.until, Until::Stops) => ", and come to rest",
        _ if same => " at a steady rate",
        _ if from_rest => ", from rest",
        None => "",
        Some(gains) => match (gains, is_one, one_way(told, turn, gains)) {
            (true, true, true) => ", and gains speed",
            (true, false, true) => ", and gain speed",
            (false, true, true) => ", and slows down",
            (false, false, true) => ", and slow down",
            (true, true, false) => ", and is faster at the end",
            (true, false, false) => ", and are faster at the end",
            (false, true, false) => ", and is slower at the end",
            (false, false, false) => ", and are slower at the end",
        },
    };
    let turns = format!(" {turns}{sense} about `{}`", turn.about_name);
    sentence!("{}{}{}", listed(&names), turns, rate)
}

/// The bodies that a rotation moves: a particle at the fixed point stays where it is.
pub(crate) fn carried(told: &StageTold, turn: &Turn) -> Vec<usize> {
    let scene = &told.placed.scene;
    let is_carried =
        |b: &usize| !scene.bodies[*b].is_particle() || told.before.center[*b] != turn.about;
    turn.bodies().into_iter().filter(is_carried).collect()
}

/// Whether what turns only gains speed, or only loses it: no more than half a turn, with moments of one sense at both ends.
fn one_way(told: &StageTold, turn: &Turn, gains: bool) -> bool {
    let stage = &told.placed;
    if turn.gravity.is_none() {
        return true;
    }
    let spin = &told.before.spin[turn.body];
    let Ok((way, _)) = super::motion::sense(stage, spin, turn) else {
        return false;
    };
    let [first, last] = super::motion::arms(stage, turn, spin);
    let half = &Expr::from(way) * &cross(&first, &last);
    let grows = Expr::from(if gains { way } else { -way });
    let rates = [false, true].map(|end| &grows * &angular(told, turn, way, end));
    let mut all = [half].into_iter().chain(rates);
    all.all(|e| sign(&e, &stage.scene.domains).is_not_negative())
}

/// Which forces have an impulse, and why; which have none.
pub(super) fn impulsive(told: &StageTold) -> Vec<Sentence> {
    let stage = &told.placed;
    let StageKind::Impact { one_sided, .. } = &stage.kind else {
        return vec![sentence!(
            "`{}` is a motion: nothing jumps, and no force has an impulse",
            &stage.name
        )];
    };
    let scene = &stage.scene;
    let mut out: Vec<Sentence> = Vec::new();
    for blow in &scene.blows {
        let size = match &blow.impulse {
            BlowImpulse::Given([x, y]) => sentence!(" ({}, {})", x, y),
            BlowImpulse::Along(_) => Sentence::default(),
        };
        out.push(sentence!(
            "`{}` is a blow: its impulse{} is given, however briefly it lasts",
            &blow.name,
            size
        ));
    }
    for c in &scene.contacts {
        out.push(sentence!("`{}` is impulsive: the bodies are stiff there, and only a force that grows without bound as the time shrinks can change a velocity at once", &c.name));
    }
    for h in &scene.hinges {
        out.push(sentence!("`{}` is impulsive: the joint cannot give way, and answers with whatever impulse keeps it together", &h.name));
    }
    for o in one_sided {
        let verb = if o.is_string { "pull" } else { "push" };
        let cases = told.cases.iter().map(|case| {
            let value = case.value(&super::impact::acting(&o.name));
            let size = value.map_or_else(|| "none".into(), |v| Sentence::from(&v));
            match case.conditions.is_empty() {
                true => size,
                false => sentence!("{} where {}", size, case.holds_where()),
            }
        });
        out.push(sentence!("`{}` can only {}, and is stiff, so it is impulsive where it is needed: its impulse is {}", &o.name, verb, Sentence::join(cases, ", and ")));
    }
    for f in &scene.forces {
        out.push(sentence!("`{}` on `{}` is finite: its impulse is at most its largest size times the duration of the contact, and vanishes with it", &f.name, &scene.bodies[f.body].name));
    }
    out
}

/// What the balances alone leave open, and what would close them.
pub(super) fn missing(told: &StageTold) -> Vec<Sentence> {
    let stage = &told.placed;
    let mut bare: Scene = stage.scene.clone();
    for (b, body) in bare.bodies.iter_mut().enumerate() {
        body.velocity = told.before.velocity[b].clone();
        body.spin = told.before.spin[b].clone();
    }
    let mut out: Vec<Sentence> = Vec::new();
    let mut used: Vec<Sentence> = Vec::new();
    for c in &mut bare.contacts {
        used.push(match &c.law {
            ContactLaw::Sticking => sentence!("at `{}` the bodies stick", &c.name),
            ContactLaw::Frictionless { restitution } => {
                let law = "` there is no friction, the normal is the one given, and the coefficient of restitution is ";
                sentence!("at `{}{}{}", &c.name, law, restitution)
            }
            ContactLaw::None | ContactLaw::Friction(_) | ContactLaw::Decided(_) => {
                sentence!("nothing is supposed at `{}`", &c.name)
            }
        });
        c.law = ContactLaw::None;
        c.normal = None;
    }
    if let StageKind::Impact { one_sided, .. } = &stage.kind {
        for case in &told.cases {
            for o in one_sided {
                let does = match (case.active.contains(&o.name), o.is_string) {
                    (true, true) => "is taut, cannot stretch, and does not rebound",
                    (true, false) => "pushes and does not rebound",
                    (false, true) if case.idle.contains(&o.name) => "stays taut and has no impulse",
                    (false, true) => "goes slack and has no impulse",
                    (false, false) => "is left and has no impulse",
                };
                used.push(sentence!("`{}` {}", &o.name, does));
            }
        }
    }
    let counting = match derive::count(&bare) {
        Ok(counting) => counting,
        Err(stop) => {
            out.push(sentence!("not counted: {}", stop.to_string()));
            return out;
        }
    };
    let (rank, unknowns) = (counting.rank, counting.unknowns);
    let words = format!(
        "the balances of `{}` alone are {rank} independent equations for {unknowns} unknowns: {} too few",
        stage.name,
        unknowns.saturating_sub(rank)
    );
    out.push(words.into());
    let closing = counting.closing_laws.iter();
    out.extend(
        closing.map(|law| sentence!("what would close them: {}", law.replacen(':', ",", 1))),
    );
    out.extend(used.into_iter().map(|u| sentence!("supposed here: {}", u)));
    out
}
