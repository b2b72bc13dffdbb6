//! What a scene would answer if a belief were true, and which beliefs give exactly the student's formula.
//!
//! The altered scene is solved in doubles at a few points; only what agrees there is held against exact fractions. So
//! hundreds of beliefs, and pairs of them, cost less than one derivation.

mod formula;
mod others;
mod outcome;
mod story;

use super::Diagnosis;
use super::belief::{BELIEFS, Belief, Slip};
use crate::equality::identical;
use crate::expr::{Expr, Point, Rational, effort};
use crate::numeric;
use crate::scene::{Ask, Scene};
use others::other_quantities;
pub(super) use outcome::doubles;
use outcome::{fractions, has_no_value};
pub use story::Story;

/// Points at which every belief is tried.
const POINTS: u64 = 4;
/// Steps that working out one belief with symbols may take, or telling two wrong answers to be one: with a slip in it a
/// flight may end at roots in roots, which nobody writes down.
const MOST_STEPS: u64 = 500_000;
/// Pairs of beliefs are searched while there are no more of them than this.
const PAIRS: usize = 6_000;
/// Beliefs and quantities named at most.
pub(super) const NAMED: usize = 4;
/// What is said of an answer that is right but for its sign.
const OPPOSITE: &str = ", with the opposite sign";
/// Pairs of beliefs named at most.
const PAIRS_NAMED: usize = 3;

/// What the student wrote: one expression, or two components.
pub struct Written<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// What is asked.
    pub ask: &'a Ask,
    /// The component asked for, of a vector.
    pub component: Option<usize>,
    /// The answer: one expression, or two components.
    pub values: Vec<Expr>,
    /// For an answer in numbers: how far each may be off, the scene's values being given.
    pub rounding: Option<f64>,
}

impl<'a> Written<'a> {
    /// The same of something else that is asked.
    fn of<'b>(&self, ask: &'b Ask, component: Option<usize>, values: Vec<Expr>) -> Written<'b>
    where
        'a: 'b,
    {
        Written {
            scene: self.scene,
            ask,
            component,
            values,
            rounding: self.rounding,
        }
    }
}

struct Trials {
    points: Vec<Point<f64>>,
    exact: Vec<Point<Rational>>,
    targets: Vec<Vec<f64>>,
    rounding: Option<f64>,
}

/// Highest chance that a wrong answer meets one of the hypotheses by coincidence, for it to be explained at all.
const COINCIDENCE: f64 = 0.02;
/// Simple factors a wrong answer may carry: the fractions of whole numbers up to 40, near enough.
const FACTORS: f64 = 1_000.0;

/// What explains an answer: the belief that gives exactly it; then the quantities it would be right for, and other beliefs. Where a number, or
/// a factor times the right answer, would meet one of so many hypotheses by coincidence, nothing is said.
pub fn explain(written: &Written, whole: bool) -> (Vec<Diagnosis>, Vec<Diagnosis>) {
    let Some(trials) = trials(written) else {
        return (Vec::new(), Vec::new());
    };
    // A right number of which the unit is missing needs no belief.
    if trials.fits(written, &Slip::none(written.scene)) {
        return (Vec::new(), Vec::new());
    }
    let quantities = others::quantities(written);
    let evidence = trials.evidence(written, &quantities);
    if evidence.is_some_and(|chance| chance > COINCIDENCE) {
        return (Vec::new(), Vec::new());
    }
    let mut found = if whole {
        beliefs(written, &trials, evidence.is_none())
    } else {
        Vec::new()
    };
    // One belief comes first; others that explain the answer as well stand behind, but for a number or a lone factor: what
    // several slips make alike is evidence of one at most.
    let mut rest: Vec<Diagnosis> = found.drain(found.len().min(1)..).collect();
    if evidence.is_some() {
        rest.clear();
    }
    // What is right but for its sign is no other quantity, though a body beside it may have that velocity.
    let mut later = match right_but_for_sign(written, &trials) {
        true => Vec::new(),
        false => other_quantities(written, &trials, quantities),
    };
    later.extend(rest);
    (found, later)
}

/// A wrong answer that a belief leads to.
#[derive(Clone, Debug)]
pub struct Believed {
    /// The belief, in the words that a grade has for it.
    pub diagnosis: Diagnosis,
    /// The answer: one expression, or two components.
    pub values: Vec<Expr>,
}

/// The wrong answers that single beliefs lead to, each in closed form and once: of beliefs with one answer the first is
/// named. `asked` holds the right answer.
pub fn answers(asked: &Written) -> Vec<Believed> {
    let mut known = vec![asked.values.clone()];
    let mut out = Vec::new();
    for belief in BELIEFS {
        for slip in (belief.slips)(asked.scene) {
            let solved = || formula::formulas(asked, &slip).filter(|_| !effort::spent());
            let Some(values) = effort::within(MOST_STEPS, solved) else {
                continue;
            };
            let is_known = |other: &Vec<Expr>| {
                let mut pairs = values.iter().zip(other);
                other.len() == values.len() && pairs.all(|(a, b)| is_same(asked, a, b))
            };
            if known.iter().any(is_known) {
                continue;
            }
            known.push(values.clone());
            out.push(Believed {
                diagnosis: words(belief, &slip, false),
                values,
            });
        }
    }
    out
}

/// Whether two closed forms are proved to be one function.
fn is_same(asked: &Written, a: &Expr, b: &Expr) -> bool {
    effort::within(MOST_STEPS, || identical(a, b, &asked.scene.domains))
}

/// The beliefs that give exactly the written answer, single ones before pairs where these are evidence.
fn beliefs(written: &Written, trials: &Trials, paired: bool) -> Vec<Diagnosis> {
    // What is right, and wrong only in its unit or form, comes from no belief.
    let truth = Slip::none(written.scene);
    if trials.fits(written, &truth) {
        return Vec::new();
    }
    let mut found: Vec<Diagnosis> = Vec::new();
    let mut slips: Vec<(&Belief, Slip)> = Vec::new();
    for belief in BELIEFS {
        let mut named = false;
        for slip in (belief.slips)(written.scene) {
            if !named && trials.fits(written, &slip) {
                found.push(words(belief, &slip, written.rounding.is_some()));
                named = true;
            }
            slips.push((belief, slip));
        }
    }
    // What follows from very many beliefs tells none of them.
    if found.len() > NAMED {
        return Vec::new();
    }
    if found.is_empty() {
        found = opposite(written, trials, &slips);
    }
    if found.is_empty()
        && paired
        && written.rounding.is_none()
        && slips.len() * slips.len() / 2 <= PAIRS * 4
    {
        found = pairs(written, trials, &slips);
    }
    found
}

/// What is written, with the other sign.
fn turned<'a>(written: &'a Written) -> Written<'a> {
    let values = written.values.iter().map(|v| -v).collect();
    written.of(written.ask, written.component, values)
}

fn right_but_for_sign(written: &Written, trials: &Trials) -> bool {
    let truth = Slip::none(written.scene);
    trials.times(-1.0).fits(&turned(written), &truth)
}

/// The belief whose answer is the written one with the other sign.
fn opposite(written: &Written, trials: &Trials, slips: &[(&Belief, Slip)]) -> Vec<Diagnosis> {
    // What is right but for its sign needs no belief beside it.
    if right_but_for_sign(written, trials) {
        return Vec::new();
    }
    let (turned, mirrored) = (turned(written), trials.times(-1.0));
    let hit = slips.iter().find(|(_, slip)| mirrored.fits(&turned, slip));
    hit.map(|(belief, slip)| {
        let mut d = words(belief, slip, written.rounding.is_some());
        d.message.push_str(OPPOSITE);
        d.hint = format!("{} Check the sign too.", d.hint);
        vec![d]
    })
    .unwrap_or_default()
}

pub(super) fn words(belief: &Belief, slip: &Slip, rounded: bool) -> Diagnosis {
    let place = match slip.place.as_str() {
        "" => String::new(),
        place => format!(" ({place})"),
    };
    let how = match rounded {
        true => "what comes out, rounded,",
        false => "exactly what comes out",
    };
    let message = format!("{how} when {}{place}", belief.belief);
    Diagnosis::new(belief.code, message, belief.hint)
}

/// Two beliefs at a time: the second is applied to the scene of the first. Several pairs that explain the answer equally
/// well are all named, unless they are too many to mean anything.
fn pairs(written: &Written, trials: &Trials, slips: &[(&Belief, Slip)]) -> Vec<Diagnosis> {
    let mut tried = 0;
    let mut found: Vec<Diagnosis> = Vec::new();
    let mut named: Vec<[&str; 2]> = Vec::new();
    for (i, (first, slip)) in slips.iter().enumerate() {
        // A change of the equations is combined as it is; one of the scene carries the second along.
        for second in BELIEFS.iter().filter(|b| b.code > first.code) {
            if slip.change.is_some() {
                continue;
            }
            for other in (second.slips)(&slip.scene) {
                tried += 1;
                if tried > PAIRS {
                    return found;
                }
                let pair = [first.code, second.code];
                if !has_inertia(&other, trials) {
                    continue;
                }
                if !named.contains(&pair) && trials.fits(written, &other) {
                    named.push(pair);
                    if found.len() == PAIRS_NAMED {
                        return Vec::new();
                    }
                    let mut d = words(first, &slips[i].1, false);
                    d.code = "TWO_BELIEFS";
                    d.message = format!(
                        "{} and, with it, {} ({})",
                        d.message, second.belief, other.place
                    );
                    d.hint = format!("two things to look at: {} And: {}", first.hint, second.hint);
                    found.push(d);
                }
            }
        }
    }
    found
}

/// Whether no moment of inertia is negative: two slips that make one so are an equation with another sign, and no beliefs.
fn has_inertia(slip: &Slip, trials: &Trials) -> bool {
    let Some(point) = trials.points.first() else {
        return true;
    };
    let mut bodies = slip.scene.bodies.iter();
    bodies.all(|b| b.inertia.evaluate(point).is_none_or(|i: f64| i >= 0.0))
}

fn trials(written: &Written) -> Option<Trials> {
    let mut needed = numeric::needed(written.scene);
    written.values.iter().for_each(|e| needed.add(e));
    let (points, exact) = match written.rounding {
        Some(_) => (vec![written.scene.all_given()?], Vec::new()),
        None => {
            // Where the right answer has no value nothing is told by others.
            let truth = Slip::none(written.scene);
            let exact: Vec<_> = (11..11 + 3 * POINTS)
                .map(|seed| numeric::random_point(&needed, &written.scene.domains, seed))
                .filter(|point| doubles(written, &truth, &numeric::rounded(point)).is_some())
                .take(POINTS as usize)
                .collect();
            (exact.iter().map(numeric::rounded).collect(), exact)
        }
    };
    let mut trials = Trials {
        points: Vec::new(),
        exact,
        targets: Vec::new(),
        rounding: written.rounding,
    };
    for point in points {
        let values: Option<Vec<f64>> = written.values.iter().map(|e| e.evaluate(&point)).collect();
        if let Some(values) = values.filter(|v| v.iter().all(|x| x.is_finite())) {
            trials.points.push(point);
            trials.targets.push(values);
        }
    }
    let enough = if written.rounding.is_some() { 1 } else { 2 };
    (trials.points.len() >= enough).then_some(trials)
}

impl Trials {
    /// The same points, all targets times a number.
    fn times(&self, k: f64) -> Trials {
        Trials {
            points: self.points.clone(),
            exact: self.exact.clone(),
            targets: self
                .targets
                .iter()
                .map(|t| t.iter().map(|v| v * k).collect())
                .collect(),
            rounding: self.rounding,
        }
    }

    /// The chance that an answer of this kind meets a hypothesis by coincidence; `None` for a formula that is no multiple
    /// of the right one: such a thing is not met by chance.
    fn evidence(&self, written: &Written, quantities: &[(Ask, String)]) -> Option<f64> {
        let plain = Slip::none(written.scene);
        let slips = BELIEFS.iter().flat_map(|b| (b.slips)(written.scene));
        let mut outcomes: Vec<Vec<Vec<f64>>> = Vec::new();
        let at = |written: &Written, slip: &Slip| -> Option<Vec<Vec<f64>>> {
            let values = self.points.iter().map(|p| doubles(written, slip, p));
            values.collect()
        };
        let truth = at(written, &plain)?;
        let ratio = |values: &[Vec<f64>]| -> Option<f64> {
            let mut ratios = values.iter().zip(&truth).flat_map(|(v, t)| {
                let pairs = v.iter().zip(t);
                pairs
                    .filter(|(v, t)| v.abs() + t.abs() > 1e-12)
                    .map(|(v, t)| v / t)
                    .collect::<Vec<f64>>()
            });
            let first = ratios.next().filter(|r| r.is_finite())?;
            ratios
                .all(|r| (r - first).abs() <= 1e-9 * first.abs())
                .then_some(first)
        };
        if self.rounding.is_none() {
            ratio(&self.targets)?;
        }
        outcomes.extend(slips.filter_map(|slip| at(written, &slip)));
        for (ask, _) in quantities {
            for component in [None, Some(0), Some(1)] {
                let other = written.of(ask, component, written.values.clone());
                outcomes.extend(at(&other, &plain));
            }
        }
        Some(match self.rounding {
            Some(room) => {
                let size = self.targets[0].iter().fold(0.0f64, |m, v| m.max(v.abs()));
                let values = outcomes.iter().flatten().filter_map(|v| v.first());
                in_decade(size, values.map(|v| v.abs()), room)
            }
            None => {
                let ratios = outcomes.iter().filter_map(|values| ratio(values));
                distinct(ratios.map(f64::abs)) as f64 / FACTORS
            }
        })
    }

    fn fits(&self, written: &Written, slip: &Slip) -> bool {
        let mut defined = 0;
        for (point, target) in self.points.iter().zip(&self.targets) {
            let Some(values) = doubles(written, slip, point) else {
                continue;
            };
            defined += 1;
            if values.len() != target.len()
                || !values.iter().zip(target).all(|(a, b)| self.close(*a, *b))
            {
                return false;
            }
        }
        if defined == 0 || (self.rounding.is_none() && defined < 2) {
            return false;
        }
        // Exact fractions tell what doubles cannot, where there are no roots.
        for point in self.exact.iter().take(2) {
            let target: Option<Vec<Rational>> =
                written.values.iter().map(|e| bounded(e, point)).collect();
            match (target, fractions(written, slip, point)) {
                (Some(target), Some(values)) if target != values => return false,
                // What is 0/0 comes out as something by rounding alone.
                (Some(_), None) if has_no_value(written, slip, point) => return false,
                _ => {}
            }
        }
        true
    }

    fn close(&self, a: f64, b: f64) -> bool {
        let room = self
            .rounding
            .unwrap_or(1e-9 * a.abs().max(b.abs()).max(1e-12));
        (a - b).abs() <= room
    }
}

/// How many numbers differ by more than rounding.
fn distinct(values: impl Iterator<Item = f64>) -> usize {
    let mut found: Vec<f64> = Vec::new();
    for value in values {
        let known = |d: &f64| (d - value).abs() <= 1e-6 * value.abs();
        if !found.iter().any(known) {
            found.push(value);
        }
    }
    found.len()
}

/// The chance that a number of as many digits in the same decade meets one of some values within half a unit of its last digit.
fn in_decade(size: f64, values: impl Iterator<Item = f64>, room: f64) -> f64 {
    let decade = 10f64.powf(size.log10().floor());
    let same = values.filter(|v| (decade..10.0 * decade).contains(v));
    distinct(same) as f64 * 2.0 * room / (9.0 * decade)
}

/// A value in fractions, where no power is so high that it would be long.
fn bounded(e: &Expr, point: &Point<Rational>) -> Option<Rational> {
    (!e.has_high_power()).then(|| e.evaluate(point)).flatten()
}
