//! What comes into an impact: the bodies have to be where they touch, move alike where they are joined and approach where they
//! collide; and the motion that earlier stages hand on gets symbols.

use crate::story::UNDETERMINED;
use std::collections::BTreeMap;

use num_traits::Signed;

use crate::algebra::Sign;
use crate::answer::calc::{Seen, essential, is_zero, sign, tidy};
use crate::dimension::{self, Dimension};
use crate::domain::{Domain, Domains};
use crate::expr::{Expr, Node, Symbol, dot, minus};
use crate::formula::write_plain;
use crate::scene::{Body, OneSided, Parameter, Scene, Stage, touch};
use crate::story::{Part, Refused, State};

/// Most nodes of a motion that is put in as it stands; a longer one goes by the name that a question gives it.
const LONG: usize = 16;

/// Most nodes of the factors beside such a name.
const SHORT: usize = 8;

/// A particle is touched where it is, but by what slides on it in some stage: a plank of no given size is below that wherever it is.
pub(super) fn touches(
    course: &[Stage],
    stage: &Stage,
    scene: &Scene,
    one_sided: &[OneSided],
    before: &State,
) -> Result<(), Refused> {
    let joints = scene.acting();
    let joints = joints.map(|one| (one.name, one.bodies, one.at, None));
    let supports = one_sided
        .iter()
        .map(|o| (&o.name, o.bodies, &o.at, Some(o)));
    let bears = |bodies: [usize; 2]| course.iter().any(|s| s.kind.bears(bodies));
    for (name, bodies, at, one_sided) in joints.chain(supports) {
        for (b, body) in bodies.map(|b| (b, &scene.bodies[b])) {
            if !body.is_particle() || bears(bodies) {
                continue;
            }
            let gap = one_sided.map_or_else(|| minus(at, &body.center), |o| o.gap(&body.center));
            if let Some(why) = before.why_open(&gap) {
                let is_open = |b: &usize| before.why_open(&before.center[*b]).is_some();
                let lost = bodies.into_iter().find(is_open);
                let lost = &lost.map_or(body, |b| &scene.bodies[b]).name;
                let why =
                    format!("where `{lost}` is, and whether `{name}` touches it, is open: {why}");
                let hint = unsaid(&why, lost);
                return Err(Refused::new(&stage.name, why, hint));
            }
            if gap
                .iter()
                .any(|c| is_zero(c, &scene.domains) == Some(false))
            {
                let [x, y] = center(scene, body);
                let mut others = bodies.iter().map(|o| &scene.bodies[*o]);
                let other = others.find(|o| o.is_particle() && o.center == *at);
                let (why, hint) = match other {
                    Some(other) => (
                        format!(
                            "`{}` and `{}` do not meet at `{name}`: by then they are at ({}) and ({x}, {y})",
                            other.name,
                            body.name,
                            center(scene, other).join(", ")
                        ),
                        "end the motion before where they meet, or give what waits its `center` there".into(),
                    ),
                    None => (
                        format!(
                            "`{name}` is not where the particle `{}` is by then: at ({x}, {y})",
                            body.name
                        ),
                        format!("\"at\": \"{}\" is always where it is", body.name),
                    ),
                };
                let hint = waits(scene, b, before).unwrap_or(hint);
                return Err(Refused::new(&stage.name, why, hint));
            }
        }
    }
    pulls(stage, scene, one_sided)?;
    let Some(off) = touch::misplaced(scene).into_iter().next() else {
        return Ok(());
    };
    let body = &scene.bodies[off.body];
    let [x, y] = center(scene, body);
    let why = format!(
        "{}; the center of `{}` is at ({x}, {y}) by then",
        off.words, body.name
    );
    let hint = waits(scene, off.body, before).unwrap_or(off.hint);
    Err(Refused::new(&stage.name, why, hint))
}

/// What would close a place that is open: what is known after an impact that does not determine the motion, or another end.
fn unsaid(why: &str, body: &str) -> String {
    match why.ends_with(UNDETERMINED) {
        true => format!(
            "say in that impact what is known of it just after, along x and along y, as in \"after\": [{{\"velocity\": \"{body}\", \"along\": \"y\", \"is\": 0}}]"
        ),
        false => "end the motion before after a time or at a place that has a closed form".into(),
    }
}

/// That a body which moves has taken no part so far, and is met where the scene has it.
fn waits(scene: &Scene, b: usize, before: &State) -> Option<String> {
    let body = &scene.bodies[b];
    let rests = |c: &Expr| is_zero(c, &scene.domains) == Some(true);
    let waits = before.part[b] == Part::Waits && !body.velocity.iter().all(rests);
    waits.then(|| {
        format!(
            "`{}` has taken no part before and comes in where the scene has it: give its `center` at that time, or a stage in which it moves, \"during\" the one before",
            body.name
        )
    })
}

/// A string between two particles pulls the second to the first.
fn pulls(stage: &Stage, scene: &Scene, one_sided: &[OneSided]) -> Result<(), Refused> {
    for string in one_sided.iter().filter(|o| o.is_string) {
        let [first, second] = string.bodies.map(|b| &scene.bodies[b]);
        let held = |b: &usize| scene.hinges.iter().any(|h| h.bodies.contains(b));
        let mut loose = string.bodies.iter().filter(|b| !held(b));
        if let Some(pulley) = loose.find(|b| scene.bodies[**b].is_light_pulley()) {
            let name = &scene.bodies[*pulley].name;
            let why = format!(
                "nothing holds the pulley `{name}` against the string `{}`",
                string.name
            );
            let hint = "hinge it to a fixed body in this impact: \"hinges\": {\"O\": {\"bodies\": [\"ceiling\", \"pulley\"], \"at\": …}}";
            return Err(Refused::new(&stage.name, why, hint));
        }
        if !first.is_particle() || !second.is_particle() {
            continue;
        }
        let toward = dot(&string.normal, &minus(&first.center, &second.center));
        if sign(&toward, &scene.domains).is_negative() {
            let why = format!(
                "the string `{}` is said to pull `{}` away from `{}`, at its other end",
                string.name, second.name, first.name
            );
            let hint = "turn `normal` round: it points from the second body along the string";
            return Err(Refused::new(&stage.name, why, hint));
        }
    }
    Ok(())
}

/// Where a body is by then, to be read.
fn center(scene: &Scene, body: &Body) -> [String; 2] {
    body.center.each_ref().map(|c| {
        let tidy = tidy(c, &scene.domains).unwrap_or_else(|_| c.clone());
        write_plain(&tidy)
    })
}

/// Bodies joined by a hinge must move alike there before.
pub(super) fn hinges_fit(stage: &Stage, scene: &Scene, before: &State) -> Result<(), Refused> {
    for hinge in &scene.hinges {
        let [a, b] = hinge.bodies.map(|b| scene.bodies[b].velocity_at(&hinge.at));
        for gap in minus(&a, &b) {
            if let Some(why) = before.why_open([&gap]) {
                let why = format!(
                    "whether the bodies move alike at the hinge `{}` is open: {why}",
                    hinge.name
                );
                let hint = no_hinge(scene, &hinge.bodies);
                return Err(Refused::new(&stage.name, why, hint));
            }
            if is_zero(&gap, &scene.domains) == Some(false) {
                let [first, second] = hinge.bodies.map(|b| &scene.bodies[b].name);
                let why = format!(
                    "with the motion handed on, `{first}` and `{second}` move differently at the hinge `{}`",
                    hinge.name
                );
                let hint = no_hinge(scene, &hinge.bodies);
                return Err(Refused::new(&stage.name, why, hint));
            }
        }
    }
    Ok(())
}

/// What to do about a hinge whose bodies do not move alike when an impact begins.
fn no_hinge(scene: &Scene, bodies: &[usize; 2]) -> &'static str {
    let is_struck = |b: &usize| {
        let mut contacts = scene.contacts.iter().flat_map(|c| &c.bodies);
        contacts.any(|struck| struck == b) || scene.blows.iter().any(|blow| blow.body == *b)
    };
    let mut moving = bodies.iter().filter(|b| !scene.bodies[**b].is_fixed());
    match moving.any(is_struck) {
        true => "what is caught in the impact is a contact with the law sticking, not a hinge",
        false => {
            "a hinge at the top of the scene belongs to every impact: put this one into the \"hinges\" of the impact that needs it"
        }
    }
}

/// Bodies that part before they touch do not collide. Gives what must be ≥ 0 for them to approach, where that is not sure.
pub(super) fn approach(
    stage: &Stage,
    scene: &Scene,
    before: &State,
) -> Result<Vec<(String, Expr)>, Refused> {
    let mut conditions = Vec::new();
    for contact in &scene.contacts {
        let is_light = |b: &usize| scene.bodies[*b].is_light_pulley();
        let Some(normal) = &contact.normal else {
            continue;
        };
        if contact.bodies.iter().any(is_light) {
            continue;
        }
        let opening = dot(&contact.relative_velocity(scene), normal);
        if before.why_open([&opening]).is_some() {
            continue;
        }
        let seen = sign(&opening, &scene.domains);
        if let Seen::Proved(Sign::Positive | Sign::NotNegative) = seen {
            let [first, second] = contact.bodies.map(|b| &scene.bodies[b].name);
            let why = format!(
                "with the motion handed on, `{first}` and `{second}` move apart at `{}`: there is no collision",
                contact.name
            );
            let hint = "look at the stage before, and at `normal`, which points out of the first body into the second";
            return Err(Refused::new(&stage.name, why, hint));
        }
        if !matches!(
            seen,
            Seen::Proved(Sign::Negative | Sign::NotPositive | Sign::Zero)
        ) {
            let words = format!("the bodies approach at `{}`", contact.name);
            conditions.push((words, essential(&-&opening, &scene.domains)));
        }
    }
    Ok(conditions)
}

/// Whether a root of symbols occurs; roots of numbers are as good as fractions.
fn has_root(e: &Expr) -> bool {
    e.parts().any(|part| match part.node() {
        Node::Power(base, exponent) => {
            exponent.as_number().is_none_or(|k| !k.is_integer()) && !base.symbols().is_empty()
        }
        _ => false,
    })
}

fn is_definite(seen: Seen) -> bool {
    matches!(seen, Seen::Proved(Sign::Positive | Sign::Negative))
}

/// The factors without a root, and the others; a number stays with the root, beside which it tells how fast something is, but for
/// its sign.
fn split(e: &Expr) -> (Expr, Expr) {
    let Node::Product(factors) = e.node() else {
        return (Expr::one(), e.clone());
    };
    let (roots, others): (Vec<&Expr>, Vec<&Expr>) = factors.iter().partition(|f| has_root(f));
    let product = |all: Vec<&Expr>| Expr::product(all.into_iter().cloned());
    let (number, others) = product(others).split_number();
    let sign = Expr::from(if number.is_negative() { -1 } else { 1 });
    (sign * others, Expr::from(number.abs()) * product(roots))
}

/// How many times another value a value is, without roots; nothing where that divides by what may vanish.
fn multiple(e: &Expr, value: &Expr, domains: &Domains) -> Option<Expr> {
    let ratio = tidy(&(e / value), domains).ok()?;
    // What may vanish and stays below the line divides nothing.
    let has_pole = ratio.parts().any(|part| match part.node() {
        Node::Power(base, k) => k.is_negative() && !is_definite(sign(base, domains)),
        _ => false,
    });
    (!has_root(&ratio) && !ratio.is_zero() && !has_pole).then_some(ratio)
}

/// The bodies on which an impulse acts.
fn acted_on(scene: &Scene) -> Vec<usize> {
    scene.acting().flat_map(|one| one.bodies).collect()
}

/// The question by whose name all motion that is handed on to an impact is told, each part in few symbols, where its value is
/// long.
fn named_once<'n>(scene: &Scene, named: &'n [(Symbol, Expr)]) -> Option<&'n (Symbol, Expr)> {
    let bodies = acted_on(scene);
    let bodies = bodies.iter().map(|b| &scene.bodies[*b]);
    let parts = bodies.flat_map(|body| body.velocity.iter().chain([&body.spin]));
    let parts: Vec<&Expr> = parts.filter(|e| !e.is_zero()).collect();
    let is_short = |e: &&Expr, value: &Expr| {
        multiple(e, value, &scene.domains).is_some_and(|ratio| ratio.size() <= SHORT)
    };
    let mut long = named.iter().filter(|(_, value)| value.size() > LONG);
    long.find(|(_, value)| !parts.is_empty() && parts.iter().all(|e| is_short(e, value)))
}

/// Replaces what an earlier stage hands on by symbols where it holds roots: the impact is then a matter of fractions, proved
/// and tried at exact points for any motion handed on, and the roots are put in afterwards. A speed or spin that a question
/// names keeps that name, and stands for what is long as well. Gives what the symbols stand for.
pub(super) fn hand_on(scene: &mut Scene, named: &[(Symbol, Expr)]) -> BTreeMap<Symbol, Expr> {
    let mut handed: Vec<(Symbol, Expr)> = Vec::new();
    let mut domains = scene.domains.clone();
    let original = scene.domains.clone();
    let parameters = scene.parameters.clone();
    let asked = scene.questions.clone();
    let is_taken = |n: &Symbol| {
        parameters.iter().any(|p| p.name == *n) || asked.iter().any(|q| *q.name == **n)
    };
    let once = named_once(scene, named);
    let acted_on = acted_on(scene);
    let mut replace = |e: &mut Expr, is_spin: bool, is_acted_on: bool| {
        let by_name = once.filter(|_| is_acted_on && !e.is_zero());
        if !has_root(e) && by_name.is_none() {
            return;
        }
        let ratio = |e: &Expr, value: &Expr| multiple(e, value, &original);
        for (name, value) in &handed {
            if let Some(ratio) = ratio(e, value) {
                *e = &ratio * &Expr::symbol(name);
                return;
            }
        }
        // The latest of those of which it is the simplest multiple.
        let names = named.iter().rev().chain(by_name);
        let all = names.filter_map(|(name, value)| Some((name, value, ratio(e, value)?)));
        let of_question = all.min_by_key(|(.., ratio)| ratio.size());
        let (name, value, factor) = match of_question {
            Some((name, value, ratio)) => (name.clone(), value.clone(), ratio),
            None => {
                let letter = if is_spin { "omega" } else { "v" };
                let further = (2..1000).map(|k| format!("{letter}_in{k}"));
                let name = std::iter::once(format!("{letter}_in"))
                    .chain(further)
                    .map(|name| Symbol::from(name.as_str()))
                    .find(|n| !domains.symbols.contains_key(n) && !is_taken(n))
                    .unwrap_or_else(|| Symbol::from("handed"));
                // What is left beside a plain factor is still a velocity or a spin.
                let parted = Some(split(e)).filter(|_| !is_definite(sign(e, &original)));
                let parted = parted.filter(|(factor, _)| is_plain(factor, &parameters));
                let (factor, root) = parted.unwrap_or_else(|| (Expr::one(), e.clone()));
                if sign(&root, &original).is_negative() {
                    (name, -root, -factor)
                } else {
                    (name, root, factor)
                }
            }
        };
        let sign = sign(&value, &original);
        // What a question asks may be negative, such as the velocity of something that falls.
        let domain = match sign {
            Seen::Proved(Sign::Positive) => Domain::positive(),
            Seen::Proved(Sign::Negative) => Domain::negative(),
            _ => Domain::real(),
        };
        domains.symbols.insert(name.clone(), domain);
        *e = &factor * &Expr::symbol(&name);
        handed.push((name, value));
    };
    for (b, body) in scene.bodies.iter_mut().enumerate() {
        let is_acted_on = acted_on.contains(&b);
        replace(&mut body.spin, true, is_acted_on);
        let velocity = body.velocity.iter_mut();
        velocity.for_each(|v| replace(v, false, is_acted_on));
    }
    scene.domains = domains;
    for (name, value) in &handed {
        let dimension = dimension_of(value, &scene.parameters).unwrap_or_else(Dimension::none);
        scene.parameters.push(Parameter {
            name: name.clone(),
            latex: None,
            unit: dimension.si(),
            dimension,
            value: None,
            meaning: String::from("handed on by the stage before"),
        });
    }
    handed.into_iter().collect()
}

/// The dimension of something made of parameters.
fn dimension_of(e: &Expr, parameters: &[Parameter]) -> Option<Dimension> {
    let of = |p: &str| {
        let known = parameters.iter().find(|q| *q.name == *p)?;
        Some(known.dimension.clone())
    };
    dimension::of(e, &of).ok().flatten()
}

/// Whether a factor has no dimension.
fn is_plain(factor: &Expr, parameters: &[Parameter]) -> bool {
    dimension_of(factor, parameters).is_none_or(|dimension| dimension.is_none())
}
