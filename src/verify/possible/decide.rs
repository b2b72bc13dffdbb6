//! Where in the domain an expression is not negative, and at the given values.
//!
//! In: expressions, domains, and a scene with values. Out: verdicts, with the condition where there is one. Signs are proved
//! by normal forms; points of both signs show that a condition holds on a part only; what neither decides stays undecided.

use num_traits::Signed;

use super::{Condition, Verdict};
use crate::algebra::{self, Sign};
use crate::answer::calc::{
    constant, essential, has_both_signs, has_both_signs_near, soon_has_both_signs,
};
use crate::derive::Derivation;
use crate::domain::{Domains, roles, samples_until};
use crate::expr::{Expr, Point, Rational, Scalar, Symbol, effort};
use crate::interval::{Interval, Outcome, evaluate};
use crate::laws::{self, Unknown};
use crate::numeric::{self, Motion};
use crate::scene::outline::Need;
use crate::scene::{ContactLaw, Scene};

/// Largest expression whose sign is looked at, in nodes; longer ones take seconds in normal form.
const LARGEST: usize = 3000;

/// Points tried for both signs.
const POINTS: usize = 24;

/// A verdict with its condition.
#[derive(Clone, Debug)]
pub(super) struct Decided {
    pub verdict: Verdict,
    pub essential: Option<Expr>,
}

/// Not known.
pub(super) const UNDECIDED: Decided = Decided {
    verdict: Verdict::Undecided,
    essential: None,
};

fn plain(verdict: Verdict) -> Decided {
    Decided {
        verdict,
        essential: None,
    }
}

/// The sign on the whole domain, where it is proved.
pub(super) fn sign(e: &Expr, domains: &Domains) -> Option<Sign> {
    if let Some(value) = e.as_number() {
        return Some(match () {
            () if value.is_positive() => Sign::Positive,
            () if value.is_negative() => Sign::Negative,
            () => Sign::Zero,
        });
    }
    let may_have_one = e.size() <= LARGEST && !soon_has_both_signs(e, domains);
    may_have_one.then(|| proved(e, domains)).flatten()
}

fn proved(e: &Expr, domains: &Domains) -> Option<Sign> {
    algebra::sign(e, domains).or_else(|| constant(e))
}

/// Where an expression is not negative.
pub(super) fn decide(e: &Expr, domains: &Domains) -> Decided {
    as_like(e, None, domains)
}

/// The same. What holds on a part only, and by theory just where `like` does, is put like that where no point shows otherwise.
pub(super) fn as_like(e: &Expr, like: Option<&Decided>, domains: &Domains) -> Decided {
    let on_a_part = || {
        let agrees = |other: &&Decided| {
            let other = other.essential.as_ref();
            other.is_some_and(|other| signs_agree(e, other, domains))
        };
        let like = like.filter(agrees).cloned();
        like.unwrap_or_else(|| where_it_is(e, domains))
    };
    let sign = match e.as_number() {
        Some(_) => sign(e, domains),
        None if e.size() > LARGEST => None,
        None if soon_has_both_signs(e, domains) => return on_a_part(),
        None => proved(e, domains),
    };
    match sign {
        Some(s) if s.is_not_negative() => plain(Verdict::Everywhere),
        Some(Sign::Negative) => plain(Verdict::Nowhere),
        // What is zero at an end of the domain at most is no case.
        Some(Sign::NotPositive) if proved(e, &domains.inside()) == Some(Sign::Negative) => {
            plain(Verdict::Nowhere)
        }
        Some(_) => on_a_part(),
        None if e.size() <= LARGEST && is_met_both_ways(e, domains) => on_a_part(),
        None => UNDECIDED,
    }
}

/// Whether points of both signs are found. Of angles, what fails far out alone follows from other conditions of friction as a
/// rule, and cannot be shown to: there it stays undecided.
fn is_met_both_ways(e: &Expr, domains: &Domains) -> bool {
    match roles(&[e]).symbols.values().any(|role| role.turns) {
        true => has_both_signs_near(e, domains),
        false => has_both_signs(e, domains),
    }
}

fn where_it_is(e: &Expr, domains: &Domains) -> Decided {
    Decided {
        verdict: Verdict::Where,
        essential: Some(essential(e, domains)),
    }
}

/// The same for something that must hold.
pub(super) fn need(need: &Need, domains: &Domains) -> Decided {
    match need {
        Need::NotNegative(e) => decide(e, domains),
        Need::Zero(e) => match sign(e, domains) {
            Some(Sign::Zero) => plain(Verdict::Everywhere),
            Some(Sign::Positive | Sign::Negative) => plain(Verdict::Nowhere),
            _ => where_it_is(e, domains),
        },
    }
}

/// Whether one expression is nowhere below zero where the other is above it, and the reverse, at the points tried.
fn signs_agree(a: &Expr, b: &Expr, domains: &Domains) -> bool {
    if effort::spent() {
        return false;
    }
    let roles = roles(&[a, b]);
    let (domains, _) = domains.completed(&roles);
    let (mut compared, mut apart) = (0, false);
    samples_until(&roles, &domains, POINTS, |sample| {
        let point = sample.point(roles.radians);
        let [x, y] = [a, b].map(|e| evaluate::<Interval>(e, &point));
        if let (Outcome::Value(x), Outcome::Value(y)) = (x, y) {
            compared += 1;
            apart = x.high < 0.0 && y.low > 0.0 || x.low > 0.0 && y.high < 0.0;
        }
        apart
    });
    compared > 0 && !apart
}

/// Lets a condition that follows from a shorter one be that one: v² − u² ≥ 0 and e (v − u) ≥ 0 follow from v − u ≥ 0.
pub(super) fn without_consequences(conditions: &mut [Condition], domains: &Domains) {
    let known = conditions.iter().filter(|c| !c.is_equation);
    let mut known: Vec<Expr> = known.filter_map(|c| c.essential.clone()).collect();
    known.sort_by_key(Expr::size);
    known.dedup();
    for condition in conditions.iter_mut().filter(|c| !c.is_equation) {
        let Some(e) = &condition.essential else {
            continue;
        };
        let shorter = known.iter().filter(|k| k.size() < e.size());
        let follows = |k: &&Expr| sign(&(e / *k), domains).is_some_and(Sign::is_not_negative);
        if let Some(cause) = shorter.into_iter().find(follows) {
            condition.essential = Some(cause.clone());
        }
    }
}

/// The given values with the independent solution at them.
pub(super) struct Values {
    exact: Option<Point<Rational>>,
    close: Option<Point<Outcome<Interval>>>,
}

/// How far a speed or impulse in doubles may be off, against the largest of its kind: the square root of what a double
/// resolves, as for an ill-conditioned system.
const SLACK: f64 = 1e-8;

impl Values {
    /// The values of the scene, where it gives all it needs and its equations have a solution there.
    pub fn of(scene: &Scene, derivation: &Derivation) -> Values {
        let exact = numeric::exact_values(scene).ok().and_then(|point| {
            let found = numeric::solved(scene, &point, numeric::solve_exact).ok()?;
            let same = |_, x: &Rational| x.clone();
            Some(with_motion(scene, derivation, point, &found.motion, same))
        });
        if exact.is_some() {
            return Values { exact, close: None };
        }
        let close = numeric::values(scene).ok().and_then(|point| {
            let found = numeric::solved(scene, &point, numeric::solve_f64).ok()?;
            let numeric::Solved { given, motion, .. } = found;
            let [speed, impulse] = sizes(&given, &motion);
            let around = |unknown: Unknown, x: &f64| {
                let size = if unknown.is_impulse() { impulse } else { speed };
                let slack = SLACK * size.max(x.abs());
                Outcome::Value(Interval {
                    low: x - slack,
                    high: x + slack,
                })
            };
            Some(with_motion(
                scene,
                derivation,
                scene.given(),
                &motion,
                around,
            ))
        });
        Values { exact: None, close }
    }

    /// Whether every symbol of an expression has a value.
    pub fn knows(&self, e: &Expr) -> bool {
        let has = |names: &dyn Fn(&Symbol) -> bool| e.symbols().iter().all(names);
        match (&self.exact, &self.close) {
            (Some(p), _) => has(&|s| p.values.contains_key(s) || p.directions.contains_key(s)),
            (None, Some(p)) => has(&|s| p.values.contains_key(s)),
            (None, None) => false,
        }
    }

    /// Whether an expression in parameters and unknowns is not negative; in doubles, whether it is not below zero for sure.
    pub fn not_negative(&self, e: &Expr) -> Option<bool> {
        if let Some(point) = &self.exact {
            return e.evaluate(point).map(|v| !v.is_negative());
        }
        match evaluate::<Interval>(e, self.close.as_ref()?) {
            Outcome::Value(v) => Some(v.high >= 0.0),
            _ => None,
        }
    }
}

/// The largest speed [m/s] and impulse [N s]. An impulse of rounding only, beside the momentum of the bodies, is none.
fn sizes(given: &numeric::Given<f64>, motion: &Motion<f64>) -> [f64; 2] {
    let largest = |all: &[[f64; 2]]| all.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    let before: Vec<[f64; 2]> = given.bodies.iter().map(|b| b.velocity).collect();
    let speed = largest(&motion.velocity).max(largest(&before));
    let mass = given.bodies.iter().fold(0.0_f64, |m, b| m.max(b.mass));
    [speed, largest(&motion.contact).max(SLACK * mass * speed)]
}

/// A point with the values of the unknowns that the equations determine, under their symbols.
fn with_motion<T, U: Scalar>(
    scene: &Scene,
    derivation: &Derivation,
    mut point: Point<U>,
    motion: &Motion<T>,
    value: impl Fn(Unknown, &T) -> U,
) -> Point<U> {
    for unknown in laws::unknowns(scene) {
        if !derivation.counting.is_unique(unknown) {
            continue;
        }
        let value = |x: &T| value(unknown, x);
        let found = match unknown {
            Unknown::Velocity(b, axis) => value(&motion.velocity[b][axis]),
            Unknown::Spin(b) => value(&motion.spin[b]),
            Unknown::Contact(c, axis) => value(&motion.contact[c][axis]),
            Unknown::Hinge(h, axis) => value(&motion.hinge[h][axis]),
            // The judge writes these impulses along their normals, unit vectors.
            Unknown::Normal(c) => {
                match along_normal(scene, &point, c, &motion.contact[c], &value) {
                    Some(size) => size,
                    None => continue,
                }
            }
            Unknown::Blow(_) => continue,
        };
        let name = derivation.names.plain(unknown).into();
        point.values.insert(name, found);
    }
    point
}

/// The size of a frictionless contact's impulse along its normal.
fn along_normal<T, U: Scalar>(
    scene: &Scene,
    point: &Point<U>,
    c: usize,
    impulse: &[T; 2],
    value: &impl Fn(&T) -> U,
) -> Option<U> {
    let contact = &scene.contacts[c];
    let (ContactLaw::Frictionless { .. }, Some(n)) = (&contact.law, &contact.normal) else {
        return None;
    };
    let n = [n[0].evaluate(point)?, n[1].evaluate(point)?];
    let [x, y] = impulse.each_ref().map(value);
    Some(x.times(&n[0]).plus(&y.times(&n[1])))
}
