//! Walking along one symbol: where formulas change sign, found in doubles, and zeros proved between two numbers.

use super::refute::sign_at;
use crate::domain::{Coordinate, Domain, Sample};
use crate::expr::number::from_f64;
use crate::expr::{Expr, Point, Symbol, effort};
use crate::interval::dyadic::Dyadic;
use crate::interval::{Enclosure, Interval, Outcome, evaluate};

/// Steps of a search between two numbers.
const STEPS: u32 = 60;

/// Numbers of a domain in ascending order, dense near its ends and, where it has none, near zero.
fn grid(domain: &Domain) -> Vec<f64> {
    let [low, high] = domain.bounds();
    let far = (-20..=32).map(|k| 10f64.powf(f64::from(k) / 4.0));
    let mut out: Vec<f64> = match (low, high) {
        (Some(low), Some(high)) => {
            let inside = (1..48).map(|k| low + (high - low) * f64::from(k) / 48.0);
            let near = [1e-6, 1e-3, 0.999, 0.999_999].map(|s| low + (high - low) * s);
            inside.chain(near).collect()
        }
        (Some(low), None) => far.map(|x| low + x).collect(),
        (None, Some(high)) => far.map(|x| high - x).collect(),
        (None, None) => far.flat_map(|x| [x, -x]).chain([0.0]).collect(),
    };
    for limit in domain.ends() {
        if !limit.open {
            out.push(limit.approximate());
        }
    }
    out.sort_by(f64::total_cmp);
    out
}

/// Where a formula changes sign or vanishes along a symbol, roughly, in ascending order.
pub(super) fn rough_zeros(f: &Expr, name: &Symbol, at: &Point<f64>, domain: &Domain) -> Vec<f64> {
    let mut point = at.clone();
    let mut value = |x: f64| {
        point.values.insert(name.clone(), x);
        f.evaluate(&point).filter(|v| v.is_finite())
    };
    let mut known: Vec<(f64, f64)> = Vec::new();
    let mut out = Vec::new();
    for x in grid(domain) {
        let Some(v) = value(x) else {
            known.clear();
            continue;
        };
        match known.last() {
            _ if v == 0.0 => out.push(x),
            Some((before, w)) if *w != 0.0 && (*w < 0.0) != (v < 0.0) => {
                out.extend(bisected(&mut value, *before, x, v > 0.0));
            }
            _ => {}
        }
        // A dip towards zero among three numbers may reach it twice.
        if let [.., (a, p), (_, q)] = known.as_slice()
            && q.abs() < p.abs().min(v.abs())
            && [*p, v].iter().all(|w| (*w > 0.0) == (*q > 0.0))
            && let Some(beyond) = beyond_zero(&mut value, [*a, x], q.signum())
        {
            out.extend(bisected(&mut value, *a, beyond, *q < 0.0));
            out.extend(bisected(&mut value, beyond, x, *q > 0.0));
        }
        known.push((x, v));
    }
    out.sort_by(f64::total_cmp);
    out.dedup();
    out
}

/// Where a formula is least along a symbol: least of some numbers, and then between the neighbours of that one.
pub(super) fn lowest(f: &Expr, name: &Symbol, at: &Point<f64>, domain: &Domain) -> Option<f64> {
    let mut point = at.clone();
    let mut value = |x: f64| {
        point.values.insert(name.clone(), x);
        f.evaluate(&point).filter(|v| v.is_finite())
    };
    let grid = grid(domain);
    let values = grid.iter().map(|x| value(*x)).collect::<Vec<_>>();
    let values = values.iter().enumerate();
    let known = values.filter_map(|(k, v)| Some((k, (*v)?)));
    let (k, _) = known.min_by(|(_, v), (_, w)| v.total_cmp(w))?;
    let (mut low, mut high) = (
        grid[k.saturating_sub(1)],
        *grid.get(k + 1).unwrap_or(&grid[k]),
    );
    let mut least = grid[k];
    for _ in 0..2 * STEPS {
        let third = (high - low) / 3.0;
        let (left, right) = (low + third, high - third);
        let (Some(l), Some(r)) = (value(left), value(right)) else {
            break;
        };
        match l < r {
            true => high = right,
            false => low = left,
        }
        least = 0.5 * (low + high);
    }
    Some(least)
}

type Value<'a> = &'a mut dyn FnMut(f64) -> Option<f64>;

/// Where a function changes sign between two numbers.
fn bisected(value: Value, mut a: f64, mut b: f64, rising: bool) -> Option<f64> {
    for _ in 0..STEPS {
        let middle = 0.5 * (a + b);
        match value(middle)? {
            0.0 => return Some(middle),
            v if (v > 0.0) == rising => b = middle,
            _ => a = middle,
        }
    }
    Some(0.5 * (a + b))
}

/// A number at which a function has the other sign, if its least size between two numbers is beyond zero.
fn beyond_zero(value: Value, [mut low, mut high]: [f64; 2], side: f64) -> Option<f64> {
    for _ in 0..STEPS {
        let third = (high - low) / 3.0;
        let (left, right) = (low + third, high - third);
        let (l, r) = (value(left)? * side, value(right)? * side);
        if l < 0.0 || r < 0.0 {
            return Some(if l < 0.0 { left } else { right });
        }
        match l < r {
            true => high = right,
            false => low = left,
        }
    }
    None
}

/// A zero of `f` along a symbol, between two numbers of the domain, at which `g` does not vanish: `f` has a value
/// everywhere between and opposite signs at the ends, and `g` has one sign there, where `own` has values. With those of `g`.
pub(crate) fn zero_apart(
    f: &Expr,
    [g, own]: [&Expr; 2],
    name: &Symbol,
    at: &Sample,
    domain: &Domain,
) -> Option<[Enclosure; 2]> {
    if effort::spent() {
        return None;
    }
    let here = |low: f64, high: f64| {
        let mut point = at.point::<Interval>(true);
        point.directions.remove(name);
        let value = Outcome::Value(Interval::new(low, high));
        point.values.insert(name.clone(), value);
        point
    };
    let inside = |x: f64| from_f64(x).is_some_and(|x| domain.contains(&x));
    let apart = |low: f64, high: f64| {
        let values = [g, own].map(|e| evaluate::<Interval>(e, &here(low, high)));
        match values {
            [Outcome::Value(v), Outcome::Value(_)] if v.low > 0.0 || v.high < 0.0 => Some(v),
            _ => None,
        }
    };
    let roots = rough_zeros(f, name, &at.doubles(), domain);
    roots.into_iter().find_map(|root| {
        // A zero that is a double is one for certain if the value there is exactly zero.
        if inside(root) {
            let mut exact = at.clone();
            let number = Coordinate::Number(from_f64(root)?);
            exact.coordinates.insert(name.clone(), number);
            if sign_at(f, &exact) == Some(0)
                && let Some(other) = apart(root, root)
            {
                return Some([exactly(root, root)?, exactly(other.low, other.high)?]);
            }
        }
        [1e-14, 1e-11, 1e-8, 1e-5].into_iter().find_map(|share| {
            let step = share * root.abs().max(1e-6);
            let (low, high) = (root - step, root + step);
            if !inside(low) || !inside(high) {
                return None;
            }
            let sign = |x: f64| match evaluate::<Interval>(f, &here(x, x)) {
                Outcome::Value(v) if v.low > 0.0 => Some(true),
                Outcome::Value(v) if v.high < 0.0 => Some(false),
                _ => None,
            };
            let continuous = matches!(evaluate(f, &here(low, high)), Outcome::Value(_));
            let crosses = matches!((sign(low), sign(high)), (Some(a), Some(b)) if a != b);
            let other = (continuous && crosses)
                .then(|| apart(low, high))
                .flatten()?;
            Some([exactly(low, high)?, exactly(other.low, other.high)?])
        })
    })
}

fn exactly(low: f64, high: f64) -> Option<Enclosure> {
    Some(Enclosure::new(
        Dyadic::from_f64(low)?,
        Dyadic::from_f64(high)?,
    ))
}
