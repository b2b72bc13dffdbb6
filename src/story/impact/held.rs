//! What held bodies in the motion before an impact holds them in it as well, whether or not the impact speaks of it.
//!
//! In: an impact, told, and the stages before it. Out: the same where the motion just after keeps to strings, joints and
//! surfaces of that motion, with the conditions under which it does; refused where it does not, since their impulses are missing. A
//! body may let go of what it has turned about, which is said.

use crate::answer::calc::{Seen, essential, is_zero, sign, tidy};
use crate::expr::{Expr, Vector, cross, dot, minus};
use crate::formula::{Sentence, sentence};
use crate::scene::{Linkage, Slide, Stage, StageKind, Strung, Turn};
use crate::story::{Refused, StageTold, State, line};

/// Parts of the velocities of bodies whose sum must not be below zero just after.
struct Held {
    parts: Vec<(usize, Vector)>,
    /// What is held, such as "the string from `a` to `b`".
    what: String,
    /// What it does not do, and is kept from doing: "get longer", "getting longer".
    does: [String; 2],
    /// What to do where it is not so.
    hint: &'static str,
}

impl Held {
    fn excess(&self, state: &State) -> Expr {
        let parts = self.parts.iter();
        Expr::sum(parts.map(|(b, along)| dot(&state.velocity[*b], along)))
    }
}

const STRING: &str = "say that it is there: \"strings\" of the impact, over a pulley one from the pulley to each end";
const SURFACE: &str = "say that it is there: \"supports\" of the impact";
const JOINT: &str = "say what joins them: \"hinges\" of the impact; where one rests on the other, as on a wedge, \"supports\", and a particle has its `center` where they touch";

/// Holds the motion just after an impact against what held the bodies just before.
pub(in crate::story) fn stays_held(
    stage: &Stage,
    stages: &[StageTold],
    branch: Option<(usize, usize)>,
    mut told: StageTold,
) -> Result<StageTold, Refused> {
    if told.cases.is_empty() {
        return Ok(told);
    }
    let mut between: Vec<&State> = Vec::new();
    let mut moved: Vec<usize> = Vec::new();
    let mut apart: Vec<[usize; 2]> = Vec::new();
    for (i, k) in branch.into_iter().flat_map(|at| line(stages, at)) {
        if let Some(case) = stages[i].cases.get(k) {
            between.push(&case.after);
            apart.extend(moves_apart(&stages[i].placed, &case.after));
            continue;
        }
        let kind = &stages[i].placed.kind;
        let last: Vec<usize> = kind.moved();
        let is_last = |b: &usize| last.contains(b) && !moved.contains(b);
        if let StageKind::Turn(turn) = kind
            && is_last(&turn.body)
        {
            leaves_pivot(stage, turn, &mut told);
        }
        if let StageKind::Linkage(linkage) = kind
            && last.iter().all(is_last)
        {
            keeps_joints(stage, linkage, &told, &apart)?;
        }
        let mut held = holding(kind, &stages[i].placed, &told.before);
        held.retain(|held| held.parts.iter().all(|(b, _)| is_last(b)));
        // What has let go since lets go on.
        let is_none = |e: &Expr| is_zero(e, &stage.scene.domains) == Some(true);
        held.retain(|held| between.iter().all(|state| is_none(&held.excess(state))));
        for held in held {
            keeps(stage, &held, &mut told)?;
        }
        moved.extend(last);
    }
    Ok(told)
}

fn keeps(stage: &Stage, held: &Held, told: &mut StageTold) -> Result<(), Refused> {
    let alone = told.cases.len() == 1;
    for case in &mut told.cases {
        let excess = held.excess(&case.after);
        if case.after.why_open([&excess]).is_some() {
            continue;
        }
        let stop = |stop| Refused::stop(&stage.name, stop);
        let excess = tidy(&excess, &stage.scene.domains).map_err(stop)?;
        let known = case.conditions.iter();
        let domains = known.fold(stage.scene.domains.clone(), |all, (_, e)| {
            all.given(e, false)
        });
        match sign(&excess, &domains) {
            Seen::Proved(s) if s.is_not_negative() => {}
            seen if seen.is_negative() => {
                let [_, doing] = &held.does;
                let why = format!(
                    "nothing is said here of what keeps {} from {doing}",
                    held.what
                );
                return Err(Refused::new(&stage.name, why, held.hint));
            }
            _ => {
                let need = essential(&excess, &domains);
                if need.is_zero() {
                    continue;
                }
                let words = format!("{} does not {}", held.what, held.does[0]);
                if alone {
                    let needed = Sentence::not_negative(&need);
                    told.assumptions
                        .push(sentence!("{}, so that {}", needed, &words));
                }
                case.conditions.push((words, need));
            }
        }
    }
    Ok(())
}

/// What strings and surfaces of a motion ask of velocities at its end.
fn holding(kind: &StageKind, placed: &Stage, end: &State) -> Vec<Held> {
    let name = |b: usize| &placed.scene.bodies[b].name;
    let taut = |body: usize, around: &Vector, at: &str| Held {
        parts: vec![(body, minus(around, &end.center[body]))],
        what: format!("`{}`", name(body)),
        does: ["get", "getting"].map(|get| format!("{get} farther from {at}")),
        hint: STRING,
    };
    match kind {
        StageKind::Turn(turn) if placed.scene.bodies[turn.body].is_particle() => {
            vec![taut(
                turn.body,
                &turn.about,
                &format!("`{}`", turn.about_name),
            )]
        }
        StageKind::Wind(wind) => vec![taut(wind.body, &wind.around, "the pole")],
        StageKind::Slide(slide) => {
            let strings = slide.strings.iter();
            let strings = strings.filter_map(|string| strung(slide, string, placed, end));
            strings.chain(surfaces(slide, placed)).collect()
        }
        _ => Vec::new(),
    }
}

/// That a string of a slide does not get longer; nothing where it is not seen on which side of its pulley a body is.
fn strung(slide: &Slide, string: &Strung, placed: &Stage, end: &State) -> Option<Held> {
    let to = *string.to.first()?;
    let ratio = string.ratio();
    let place = |pulley: Option<&usize>, other: usize| &end.center[*pulley.unwrap_or(&other)];
    let first = minus(place(string.over.first(), to), &end.center[slide.body]);
    let last = minus(place(string.over.last(), slide.body), &end.center[to]);
    let sides = [
        (dot(&slide.along, &first), true),
        (dot(&string.along, &last), false),
    ];
    let toward = sides.into_iter().find_map(|(side, is_first)| {
        let toward = sign(&side, &placed.scene.domains).side()?;
        Some(toward == is_first)
    })?;
    let way = Expr::from(if toward { 1 } else { -1 });
    let back = -(&way / &ratio.powi(2));
    let [a, b] = [slide.body, to].map(|b| &placed.scene.bodies[b].name);
    Some(Held {
        parts: vec![
            (slide.body, slide.along.each_ref().map(|c| &way * c)),
            (to, string.along.each_ref().map(|c| &back * c)),
        ],
        what: format!("the string from `{a}` to `{b}`"),
        does: ["get", "getting"].map(|get| format!("{get} longer")),
        hint: STRING,
    })
}

/// That bodies do not move into the surface that they slid on.
fn surfaces(slide: &Slide, placed: &Stage) -> Vec<Held> {
    if slide.gravity.is_none() || slide.level {
        return Vec::new();
    }
    let [x, y] = &slide.along;
    let out = [-(x * y), x * x];
    let into = |b: usize, parts: Vec<(usize, Vector)>, surface: &str| Held {
        parts,
        what: format!("`{}`", placed.scene.bodies[b].name),
        does: ["move", "moving"].map(|moves| format!("{moves} into {surface}")),
        hint: SURFACE,
    };
    let above = |b: usize| into(b, vec![(b, out.clone())], "the surface that it slid on");
    match &slide.on {
        None => vec![above(slide.body)],
        Some(on) => {
            let below = &placed.scene.bodies[on.body];
            let back = out.each_ref().map(|c| -c);
            let both = vec![(slide.body, out.clone()), (on.body, back)];
            let rider = into(slide.body, both, &format!("`{}`", below.name));
            let floor = (!below.is_fixed()).then(|| above(on.body));
            std::iter::once(rider).chain(floor).collect()
        }
    }
}

/// Says of a body that turned about a point of it, which an impact does not speak of, that it lets go where it moves there.
fn leaves_pivot(stage: &Stage, turn: &Turn, told: &mut StageTold) {
    let body = &stage.scene.bodies[turn.body];
    let domains = &stage.scene.domains;
    let is_pivot = |at: &Vector| {
        let gap = minus(at, &turn.about);
        gap.iter().all(|c| is_zero(c, domains) == Some(true))
    };
    let StageKind::Impact { one_sided, .. } = &stage.kind else {
        return;
    };
    let joints = stage.scene.touching().map(|one| (one.bodies, one.at));
    let mut said = joints.chain(one_sided.iter().map(|o| (o.bodies, &o.at)));
    let is_said = said.any(|(bodies, at)| bodies.contains(&turn.body) && is_pivot(at));
    let moves = |after: &State| {
        let there = velocity_at(stage, after, turn.body, &turn.about);
        after.why_open(&there).is_none() && there.iter().any(|c| is_zero(c, domains) == Some(false))
    };
    if !body.is_particle() && !is_said && told.cases.iter().any(|case| moves(&case.after)) {
        let words = "nothing holds `{}` at `{}` in `{}`";
        let names = [&body.name, &turn.about_name, &stage.name].map(Sentence::from);
        told.assumptions.push(Sentence::filled(words, names));
    }
}

/// Velocity of the point of a body at a place; a particle has no other.
fn velocity_at(stage: &Stage, state: &State, body: usize, at: &Vector) -> Vector {
    if stage.scene.bodies[body].is_particle() {
        return state.velocity[body].clone();
    }
    let arm = minus(at, &state.center[body]);
    let [x, y] = &state.velocity[body];
    let w = &state.spin[body];
    [x - &(w * &arm[1]), y + &(w * &arm[0])]
}

/// The pairs of bodies that move apart just after an impact where one rests on the other.
fn moves_apart(stage: &Stage, after: &State) -> Vec<[usize; 2]> {
    let StageKind::Impact { one_sided, .. } = &stage.kind else {
        return Vec::new();
    };
    let supports = one_sided.iter().filter(|one| !one.is_string);
    let parts = supports.filter(|one| {
        let [first, second] = one.bodies.map(|b| velocity_at(stage, after, b, &one.at));
        let opening = dot(&minus(&second, &first), &one.normal);
        after.why_open([&opening]).is_none() && sign(&opening, &stage.scene.domains).is_positive()
    });
    parts.map(|one| one.bodies).collect()
}

/// Bodies of a linkage that have not come apart since move on in the same proportions where an impact says nothing of what
/// joins them.
fn keeps_joints(
    stage: &Stage,
    linkage: &Linkage,
    told: &StageTold,
    apart: &[[usize; 2]],
) -> Result<(), Refused> {
    let bodies: Vec<usize> = linkage.places.iter().map(|(b, _)| *b).collect();
    // What guides a single body may only push, as a floor does.
    let is_joint = |pair: &[usize; 2]| pair.iter().all(|b| bodies.contains(b));
    let StageKind::Impact { one_sided, .. } = &stage.kind else {
        return Ok(());
    };
    let hinges = stage.scene.hinges.iter().map(|h| &h.bodies);
    let mut said = hinges.chain(one_sided.iter().map(|o| &o.bodies));
    if bodies.len() == 1 || said.any(is_joint) || apart.iter().any(is_joint) {
        return Ok(());
    }
    let parts = |state: &State| -> Vec<Expr> {
        let each = bodies.iter().map(|b| {
            let [x, y] = state.velocity[*b].clone();
            [x, y, state.spin[*b].clone()]
        });
        each.flatten().collect()
    };
    let before = parts(&told.before);
    for case in &told.cases {
        let after = parts(&case.after);
        if case.after.why_open(&after).is_some() {
            continue;
        }
        for (i, j) in (0..before.len()).flat_map(|j| (0..j).map(move |i| (i, j))) {
            let turned = cross(
                &[before[i].clone(), before[j].clone()],
                &[after[i].clone(), after[j].clone()],
            );
            if is_zero(&turned, &stage.scene.domains) == Some(false) {
                let why =
                    "nothing is said here of the joints that held the bodies in the motion before";
                return Err(Refused::new(&stage.name, why, JOINT));
            }
        }
    }
    Ok(())
}
