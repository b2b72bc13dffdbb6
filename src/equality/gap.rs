//! Two formulas proved equal wherever both have values: do they have them at the same points?
//!
//! What one divides by and the other does not is told where it may be zero; where only one has values on a whole part of
//! the domain, such as √(d − g)² beside d − g, the part is told with a point of it.

use super::refute::Tally;
use super::{Assumption, Condition, Counterexample, Equality, Ground, How, Value, critical};
use crate::algebra::{Field, Sign};
use crate::domain::{Domains, Sample};
use crate::expr::{Expr, Function, Node};

/// The verdict for a proved identity, with what is known of points where only one side has a value.
pub(super) fn same(
    (a, b): (&Expr, &Expr),
    domains: &Domains,
    mut assumptions: Vec<Assumption>,
    ground: Ground,
    tally: &Tally,
) -> Equality {
    let region = |(at, ..): &&(Sample, Value, Value)| forbidden(a, b, at);
    let how = match tally.apart.iter().find(region) {
        // A sign that was only seen has to be told first.
        Some((at, left, right)) if assumptions.iter().all(|a| !is_seen(a)) => How::OnBranch {
            condition: Condition::BothDefined,
            elsewhere: Counterexample::confirmed(at, left.clone(), right.clone()),
        },
        _ => {
            let poles = poles(a, b, domains);
            match tally.apart.first() {
                Some((at, ..)) if poles.is_empty() => {
                    assumptions.push(Assumption::NotAt(at.clone()));
                }
                _ => assumptions.extend(poles.into_iter().map(Assumption::NotZero)),
            }
            How::Identity {
                ground,
                assumptions,
            }
        }
    };
    Equality::Same { how }
}

fn is_seen(assumption: &Assumption) -> bool {
    matches!(assumption, Assumption::NotNegative(_))
}

/// Whether a root or logarithm of something negative forbids a value at a point, so that it does so around it as well.
fn forbidden(a: &Expr, b: &Expr, at: &Sample) -> bool {
    let point = at.doubles();
    let negative = |e: &Expr| e.evaluate(&point).is_some_and(|v| v < 0.0);
    let arguments = critical::arguments(&[a, b]);
    arguments.iter().any(|(e, needed)| *needed && negative(e))
}

/// What one of the two divides by and the other does not, where it may be zero on the domain.
pub(crate) fn poles(a: &Expr, b: &Expr, domains: &Domains) -> Vec<Expr> {
    let (mut left, mut right) = (divisors(a, domains), divisors(b, domains));
    let both: Vec<Expr> = left.iter().filter(|e| right.contains(e)).cloned().collect();
    left.retain(|e| !both.contains(e));
    right.retain(|e| !both.contains(e));
    if left.is_empty() && right.is_empty() {
        return Vec::new();
    }
    let whole = |rest: &[Expr]| Expr::product(both.iter().chain(rest).cloned());
    let (left, right) = (whole(&left), whole(&right));
    let split = || {
        let (field, x, y) = Field::pair(domains, &left, &right).ok()?;
        let parts = field.split_zeros(&x, &y).ok()?;
        Some((field, parts))
    };
    let Some((field, [only_left, _, only_right])) = split() else {
        return Vec::new();
    };
    let all = only_left.iter().chain(&only_right);
    let weak = all.filter(|x| !field.sign(x).is_some_and(Sign::is_strict));
    weak.map(|x| field.expr(x)).collect()
}

/// What a formula divides by, positive symbols left out.
pub(crate) fn divisors(e: &Expr, domains: &Domains) -> Vec<Expr> {
    let mut out: Vec<Expr> = Vec::new();
    for part in e.parts() {
        let base = match part.node() {
            Node::Power(base, _) if part.divides_by().is_some() => above(base),
            Node::Call(Function::Tan, x) => x.cos(),
            _ => continue,
        };
        let positive = base.as_symbol().is_some_and(|name| {
            let low = domains.symbols.get(name).and_then(|d| d.low.as_ref());
            low.is_some_and(|l| l.open && !num_traits::Signed::is_negative(&l.value))
        });
        if !positive && base.as_number().is_none() && !out.contains(&base) {
            out.push(base);
        }
    }
    out
}

/// What stands above the bar of a fraction: the rest is zero nowhere, `1/x` as little as x^(−2).
fn above(e: &Expr) -> Expr {
    let [above, _] = e.above_and_below();
    Expr::product(above)
}
