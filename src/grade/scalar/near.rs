//! Formulas within a share of others: proved on an interval in enclosures, and refuted at points.

use crate::domain::{Domain, Domains, Limit, Sample};
use crate::equality::{Counterexample, Value};
use crate::expr::{Expr, Point, Rational, Symbol, effort, only};
use crate::interval::{Big, Certified, Interval, Outcome, evaluate};

/// Parts of an interval that are looked at for one sign.
const PARTS: usize = 200;

/// Derivatives that are looked at where something vanishes at an end.
const DERIVATIVES: usize = 4;

/// Points at which a formula is looked for that is further off than it may be.
const POINTS: usize = 60;

/// Whether an answer in one symbol lies within a share of the expected value wherever the symbol may be.
pub(super) fn is_within(
    expected: &Expr,
    answer: &Expr,
    share: &Rational,
    domains: &Domains,
) -> bool {
    let mut names = expected.symbols();
    names.extend(answer.symbols());
    let Some(name) = only(names.into_iter().filter(|name| &**name != "pi")) else {
        return false;
    };
    let Domain { low, high } = domains.of(&[expected, answer]).of_symbol(&name);
    let (Some(low), Some(high)) = (low, high) else {
        return false;
    };
    let (width, off) = (Expr::from(share.clone()) * expected, answer - expected);
    // The expected value may be of one sign below zero and of the other above.
    let zero = Limit::number(Rational::default(), false);
    let parts = match low.approximate() < 0.0 && high.approximate() > 0.0 {
        true => vec![[low, zero.clone()], [zero, high]],
        false => vec![[low, high]],
    };
    parts.iter().all(|ends| {
        let allowed = [width.clone(), -&width];
        allowed.iter().any(|width| {
            let rests = [width + &off, width - &off];
            rests.iter().all(|rest| is_not_negative(rest, &name, ends))
        })
    })
}

/// Whether a formula is proved not to be negative between two ends: part by part, and where it vanishes at an end by the first
/// derivative that does not.
fn is_not_negative(e: &Expr, name: &Symbol, ends: &[Limit; 2]) -> bool {
    let mut derivatives = vec![e.clone()];
    for k in 0..DERIVATIVES {
        derivatives.push(derivatives[k].derivative(name));
    }
    // How many of these vanish at each end, from the formula itself on.
    let vanishing = ends.each_ref().map(|end| {
        let vanish = |e: &&Expr| e.put(name, &end.expr()).is_zero();
        derivatives.iter().take_while(vanish).count()
    });
    // A double beyond the end, where the end is none itself.
    let beyond = |end: &Limit, by: f64| {
        let x = end.approximate();
        x + by * x.abs()
    };
    let [low, high] = [beyond(&ends[0], -1e-15), beyond(&ends[1], 1e-15)];
    let enclosed = |e: &Expr, [low, high]: [f64; 2]| {
        let place = Outcome::Value(Interval { low, high });
        let point = Point {
            values: [(name.clone(), place)].into_iter().collect(),
            ..Point::default()
        };
        evaluate(e, &point).value()
    };
    let above_zero = |e: &Expr, place: [f64; 2], sign: f64| {
        enclosed(e, place).is_some_and(|found| match sign < 0.0 {
            true => found.high <= 0.0,
            false => found.low >= 0.0,
        })
    };
    // What it is at the lower end, less the most by which it may fall from there on; a little more than doubles round away.
    let stays = |[a, b]: [f64; 2]| {
        let (Some(at), Some(slope)) = (enclosed(e, [a, a]), enclosed(&derivatives[1], [a, b]))
        else {
            return false;
        };
        at.low >= -slope.low.min(0.0) * (b - a) * (1.0 + 1e-12)
    };
    let mut left = vec![[low, high]];
    for _ in 0..PARTS {
        let Some([a, b]) = left.pop() else {
            return true;
        };
        let near = [a == low, b == high];
        let grows = |at: usize| {
            let order = vanishing[at];
            // Below an end at which it vanishes each odd derivative has the opposite sign.
            let sign = if at == 1 && order % 2 == 1 { -1.0 } else { 1.0 };
            near[at]
                && order > 0
                && derivatives
                    .get(order)
                    .is_some_and(|d| above_zero(d, [a, b], sign))
        };
        if above_zero(e, [a, b], 1.0) || grows(0) || grows(1) || stays([a, b]) {
            continue;
        }
        if effort::spent() {
            return false;
        }
        let middle = a + (b - a) / 2.0;
        left.extend([[a, middle], [middle, b]]);
    }
    left.is_empty()
}

/// The point at which two values differ, or another where that one is within a share of the expected value; nothing where no
/// point was found at which the answer is further off.
pub(super) fn outside(
    expected: &Expr,
    answer: &Expr,
    share: &Rational,
    at: Counterexample,
    domains: &Domains,
) -> Option<Counterexample> {
    let off = (answer - expected).powi(2);
    let allowed = Expr::from(share * share) * expected.powi(2);
    let room = allowed - off;
    let is_outside = |sample: &Sample| match evaluate::<Big<200>>(&room, &sample.point(true)) {
        Outcome::Value(left) => left.below_zero(),
        _ => false,
    };
    // Where one of the two has no value there is no share.
    if at.left == Value::None || at.right == Value::None || is_outside(&at.at) {
        return Some(at);
    }
    let value = |e: &Expr, at: &Sample| match evaluate::<Big<200>>(e, &at.point(true)) {
        Outcome::Value(value) => Some(Value::Within(value.0)),
        _ => None,
    };
    let samples = domains.points(&[expected, answer], POINTS).into_iter();
    let mut found = samples.filter(is_outside).filter_map(|at| {
        let (left, right) = (value(expected, &at)?, value(answer, &at)?);
        Some(Counterexample {
            at,
            left,
            right,
            confirmed: false,
        })
    });
    found.next()
}
