//! Values of one symbol inside its domain, from simple to complicated, in an order that never changes.

use std::sync::LazyLock;

use num_traits::{One, Signed, Zero};

use super::{Domain, Limit};
use crate::expr::number::{from_f64, product, same, sum, to_f64};
use crate::expr::{Int, Rational, ratio};

/// The value of one symbol at a sample point.
#[derive(Clone, Eq, Debug)]
pub enum Coordinate {
    /// The symbol has this value.
    Number(Rational),
    /// The symbol has this multiple of π as its value.
    Pi(Rational),
    /// The symbol is an angle φ = `divisor`·(ψ + 2π·`turns`), ψ in (−π, π] with (cos ψ, sin ψ) = `unit`.
    Direction {
        /// N in φ/N.
        divisor: u32,
        /// Cosine and sine of φ/N.
        unit: [Rational; 2],
        /// Full turns added to φ/N.
        turns: i32,
    },
}

impl PartialEq for Coordinate {
    fn eq(&self, other: &Coordinate) -> bool {
        use Coordinate::{Direction, Number, Pi};
        match (self, other) {
            (Number(x), Number(y)) | (Pi(x), Pi(y)) => same(x, y),
            (
                Direction {
                    divisor,
                    unit: [cos, sin],
                    turns,
                },
                Direction {
                    divisor: n,
                    unit: [c, s],
                    turns: k,
                },
            ) => divisor == n && turns == k && same(cos, c) && same(sin, s),
            _ => false,
        }
    }
}

impl Coordinate {
    /// The value of the symbol, rounded.
    pub fn double(&self) -> f64 {
        match self {
            Coordinate::Number(value) => to_f64(value),
            Coordinate::Pi(value) => to_f64(value) * std::f64::consts::PI,
            Coordinate::Direction {
                divisor,
                unit: [c, s],
                turns,
            } => {
                let turn = 2.0 * std::f64::consts::PI * f64::from(*turns);
                f64::from(*divisor) * (to_f64(s).atan2(to_f64(c)) + turn)
            }
        }
    }

    /// The coordinate in words: `v = 1`, `theta with cos(theta) = 3/5`.
    pub fn words(&self, symbol: &str) -> String {
        match self {
            Coordinate::Number(value) => format!("{symbol} = {value}"),
            Coordinate::Pi(value) => format!("{symbol} = {value}*pi"),
            Coordinate::Direction {
                divisor,
                unit,
                turns,
            } => {
                let [cos, sin] = self.direction().unwrap_or_else(|| unit.clone());
                let quarter = *divisor == 1 && *turns == 0 && !sin.is_negative();
                // A cosine fixes an angle between 0 and π; elsewhere the sine is told too.
                let phi = f64::from(*divisor) * to_f64(&unit[1]).atan2(to_f64(&unit[0]));
                if quarter || (*turns == 0 && (0.0..=std::f64::consts::PI).contains(&phi)) {
                    format!("{symbol} with cos({symbol}) = {cos}")
                } else {
                    format!("{symbol} with cos({symbol}) = {cos}, sin({symbol}) = {sin}")
                }
            }
        }
    }

    /// Cosine and sine of the angle itself, where it is given by a direction.
    pub fn direction(&self) -> Option<[Rational; 2]> {
        let Coordinate::Direction {
            divisor,
            unit: [c, s],
            ..
        } = self
        else {
            return None;
        };
        let mut total = [Rational::one(), Rational::zero()];
        for _ in 0..*divisor {
            let [x, y] = &total;
            total = [x * c - y * s, x * s + y * c];
        }
        Some(total)
    }
}

/// Magnitudes tried in this order; a person can check a counterexample made of them.
const ABOVE: [i64; 26] = [
    1, 2, 1, 3, 1, 3, 2, 4, 1, 3, 4, 5, 1, 2, 3, 4, 5, 7, 1, 1, 9, 10, 1, 99, 100, 1000,
];
const BELOW: [i64; 26] = [
    1, 1, 2, 1, 3, 2, 3, 1, 4, 4, 3, 1, 5, 5, 5, 5, 2, 1, 7, 10, 10, 1, 100, 100, 1, 1,
];

/// Up to `count` numbers of a domain, simplest first, its ends last.
pub(super) fn numbers(domain: &Domain, count: usize) -> Vec<Coordinate> {
    let mut inside = Vec::new();
    let mut ends = Vec::new();
    let low = domain.low.as_ref();
    let signs: &[i64] = match low.is_some_and(|l| !l.value.is_negative()) {
        true => &[1],
        false => &[1, -1],
    };
    let closed = domain.ends().any(|l| !l.open);
    for (n, d) in ABOVE.into_iter().zip(BELOW) {
        for sign in signs {
            let value = Rational::new_raw(Int::from(sign * n), Int::from(d));
            if domain.contains(&value) {
                if closed && domain.is_end(&value) {
                    ends.push(value)
                } else {
                    inside.push(value)
                }
            }
        }
        if inside.len() >= count {
            break;
        }
    }
    let mut k = 0;
    while inside.len() < count.min(6) && k < 12 {
        // A narrow interval: the simplest fractions of its parts.
        if let Some(value) = part(domain, k).filter(|v| domain.contains(v) && !inside.contains(v)) {
            inside.push(value);
        }
        k += 1;
    }
    let zero = Rational::zero();
    if domain.contains(&zero) && inside.len() < 24 {
        ends.push(zero);
    }
    inside.truncate(count);
    if inside.len() < count {
        inside.extend(ends);
    }
    let mut out: Vec<Coordinate> = inside.into_iter().map(Coordinate::Number).collect();
    if let (true, Some(low), Some(high)) = (out.is_empty(), &domain.low, &domain.high)
        && low == high
        && !low.open
    {
        out.push(match low.of_pi {
            true => Coordinate::Pi(low.value.clone()),
            false => Coordinate::Number(low.value.clone()),
        });
    }
    out
}

/// The simplest fraction in a part of a bounded domain: the whole, halves, quarters, eighths.
fn part(domain: &Domain, k: usize) -> Option<Rational> {
    let [Some(low), Some(high)] = domain.bounds() else {
        return None;
    };
    let (pieces, piece) = match k {
        0 => (1, 0),
        1 | 2 => (2, k - 1),
        3..=6 => (4, k - 3),
        _ => (8, k - 7),
    };
    let step = (high - low) / pieces as f64;
    let end = |k: usize| from_f64(low + step * k as f64);
    let (from, to) = (end(piece)?, end(piece + 1)?);
    (from < to).then(|| simplest(&from, &to, 64)).flatten()
}

/// The fraction with the smallest denominator strictly between two others (Stern and Brocot).
fn simplest(low: &Rational, high: &Rational, depth: u32) -> Option<Rational> {
    let whole = low.floor();
    let next = &whole + Rational::one();
    if next < *high {
        return Some(next);
    }
    if depth == 0 {
        return None;
    }
    let rest = low - &whole;
    let (top, bottom) = (high - &whole, rest);
    if bottom.is_zero() {
        // Between 0 and `top` ≤ 1: one over the first integer above 1/top.
        return Some(&whole + (top.recip().floor() + Rational::one()).recip());
    }
    Some(whole + simplest(&top.recip(), &bottom.recip(), depth - 1)?.recip())
}

/// A number of the domain with two-digit parts.
pub(super) fn random_number(domain: &Domain, random: &mut Lcg) -> Option<Rational> {
    let part = 1 + (random.next() % 96) as i64;
    let scale = 1 + (random.next() % 12) as i64;
    let step = || ratio(part * scale, 97);
    let end = |l: &Limit| match l.of_pi {
        true => from_f64(l.approximate()),
        false => Some(l.value.clone()),
    };
    let short = |x: Rational| {
        let parts = product(&x, &ratio(1009, 1)).round().to_integer();
        Rational::new(parts, Int::from(1009))
    };
    Some(match (&domain.low, &domain.high) {
        (Some(l), Some(h)) => {
            let (l, h) = (end(l)?, end(h)?);
            short(sum(
                &l,
                &product(&sum(&h, &l, true), &ratio(part, 97)),
                false,
            ))
        }
        (Some(l), None) if l.value.is_zero() => step(),
        (Some(l), None) => sum(&end(l)?, &step(), false),
        (None, Some(h)) => sum(&end(h)?, &step(), true),
        (None, None) => ratio((2 * part - 97) * scale, 97),
    })
}

/// Halved tangents t of the first quadrant's rational directions ((1 − t²)/(1 + t²), 2t/(1 + t²)), simplest first.
const RISES: [i64; 20] = [1, 1, 2, 1, 3, 1, 3, 1, 3, 2, 5, 1, 4, 2, 1, 1, 9, 1, 1, 1];
const RUNS: [i64; 20] = [
    2, 3, 3, 5, 5, 4, 4, 7, 7, 5, 7, 9, 5, 7, 10, 20, 11, 40, 100, 400,
];

/// Rational points of the whole circle, simplest first: four per tangent, then the four ends of the axes.
pub(super) static CIRCLE: LazyLock<Vec<[Rational; 2]>> = LazyLock::new(|| {
    let slanted = RISES.into_iter().zip(RUNS).flat_map(|(n, d)| {
        let (c, s, h) = (d * d - n * n, 2 * n * d, d * d + n * n);
        [(c, s, h), (-c, s, h), (c, -s, h), (-c, -s, h)]
    });
    let axes = [(1, 0, 1), (0, 1, 1), (-1, 0, 1), (0, -1, 1)];
    let all = slanted.chain(axes);
    all.map(|(c, s, h)| [ratio(c, h), ratio(s, h)]).collect()
});

/// Directions of φ/N that put φ inside the domain. Directions nearer than 10⁻⁹ to an end are left out, far more than
/// floating-point arctangents err by.
pub(super) fn directions(domain: &Domain, divisor: u32, count: usize) -> Vec<Coordinate> {
    const MARGIN: f64 = 1e-9;
    let [low, high] = domain.bounds();
    let low = low.unwrap_or(f64::NEG_INFINITY);
    let high = high.unwrap_or(f64::INFINITY);
    let n = f64::from(divisor);
    let mut out = Vec::new();
    for unit in CIRCLE.iter() {
        let psi = to_f64(&unit[1]).atan2(to_f64(&unit[0]));
        for turns in [0, 1, -1] {
            let phi = n * (psi + 2.0 * std::f64::consts::PI * f64::from(turns));
            if low + MARGIN < phi && phi < high - MARGIN {
                out.push(Coordinate::Direction {
                    divisor,
                    unit: unit.clone(),
                    turns,
                });
                break;
            }
        }
        if out.len() >= count {
            return out;
        }
    }
    if out.is_empty() {
        // Too narrow for the list, or a single angle: plain values.
        return numbers(domain, count);
    }
    out
}

/// A linear congruential generator (Knuth's MMIX constants): the same points on every machine.
pub(super) struct Lcg(pub u64);

impl Lcg {
    pub fn next(&mut self) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }
}
