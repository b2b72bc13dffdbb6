//! Elementary functions of enclosures by argument reduction and Taylor series, every remainder bounded.
//!
//! All arithmetic below is interval arithmetic, so rounding needs no analysis of its own; the only error added by hand is
//! the remainder of each series, bounded where the series is cut. `sin` and `cos` are evaluated at the middle and widened by
//! half the width (their slope is at most 1); the monotone functions are evaluated at both ends.

use std::sync::OnceLock;

use num_bigint::BigInt;
use num_traits::{One, ToPrimitive, Zero};

use super::dyadic::{Dyadic, Round};
use super::{Enclosure, Outcome};
use crate::expr::{Function, effort};
use Outcome::{Undefined, Unknown, Value};

/// Bits to which the constants are kept; working precisions beyond it get no more accurate.
const CONSTANT_BITS: u32 = 4096 + 256;

/// Steps of a function beside those of its digits.
const SERIES: u64 = 500;

/// Arguments of sin, cos and exp beyond 2^`LARGEST` are not reduced.
const LARGEST: i64 = 128;

/// π = 16 atan(1/5) − 4 atan(1/239) (Machin 1706).
pub(super) fn pi(bits: u32) -> Enclosure {
    static PI: OnceLock<Enclosure> = OnceLock::new();
    let full = PI.get_or_init(|| {
        let w = CONSTANT_BITS + 16;
        inverse_series(5, w, true)
            .scale(4)
            .sub(&inverse_series(239, w, true).scale(2), w)
    });
    full.rounded(bits)
}

/// ln 2 = 18 artanh(1/26) − 2 artanh(1/4801) + 8 artanh(1/8749).
fn ln_two(bits: u32) -> Enclosure {
    static LN2: OnceLock<Enclosure> = OnceLock::new();
    let full = LN2.get_or_init(|| {
        let w = CONSTANT_BITS + 16;
        let [a, b, c] = [26, 4801, 8749].map(|n| inverse_series(n, w, false));
        let nine = Enclosure::point(Dyadic::from_int(9));
        a.mul(&nine, w)
            .scale(1)
            .sub(&b.scale(1), w)
            .add(&c.scale(3), w)
    });
    full.rounded(bits)
}

/// atan(1/n) (alternating) or artanh(1/n): Σ (±1)^k / ((2k+1) n^(2k+1)) in fixed point with `w` bits.
fn inverse_series(n: u64, w: u32, alternating: bool) -> Enclosure {
    let mut power: BigInt = (BigInt::one() << w) / n;
    let mut total = BigInt::zero();
    let mut terms = 0u64;
    while !power.is_zero() {
        let term = &power / (2 * terms + 1);
        if alternating && terms % 2 == 1 {
            total -= term
        } else {
            total += term
        }
        power /= n * n;
        terms += 1;
    }
    // Each power is at most 2 units too small (the error shrinks by n² ≥ 25 per step and grows by 1), each term so by at
    // most 3; the terms left out sum to less than 2 units.
    around(total, BigInt::from(3 * terms + 2), w)
}

/// A number in fixed point with `w` bits, known up to an error.
fn around(total: BigInt, error: BigInt, w: u32) -> Enclosure {
    let end = |m: BigInt| Dyadic::new(m, -i64::from(w));
    Enclosure::new(end(&total - &error), end(total + error))
}

/// How often an argument is halved, or its root drawn, before a series: a part of the root of the bits where these are many.
fn halvings(bits: u32, part: i64, few: i64) -> i64 {
    match bits > 400 {
        true => i64::from(bits.isqrt()) / part,
        false => few,
    }
}

/// A function of an enclosure.
pub(super) fn call(x: &Enclosure, function: Function, bits: u32) -> Outcome<Enclosure> {
    let w = bits + 32;
    if !effort::take(SERIES + 8 * u64::from(bits)) {
        return Unknown;
    }
    match function {
        Function::Abs => Value(x.abs()),
        Function::Sin => Value(sin_cos(x, bits)[0].clone()),
        Function::Cos => Value(sin_cos(x, bits)[1].clone()),
        Function::Tan => {
            let [sin, cos] = sin_cos(x, w);
            quotient(&sin, &cos, bits)
        }
        Function::Asin => asin(x, bits),
        Function::Acos => asin(x, w).then(|a| Value(pi(w).scale(-1).sub(a, bits))),
        Function::Atan => Value(atan(x, bits)),
        Function::Exp => exp(x, bits),
        Function::Ln => ln(x, bits),
        Function::Sinh | Function::Cosh | Function::Tanh => hyperbolic(x, function, bits),
    }
}

fn quotient(a: &Enclosure, b: &Enclosure, bits: u32) -> Outcome<Enclosure> {
    match b.recip(bits + 8) {
        Some(inverse) => Value(a.mul(&inverse, bits)),
        None => Unknown,
    }
}

/// The hull of an increasing function at both ends.
fn monotone(x: &Enclosure, f: impl Fn(&Dyadic) -> Enclosure) -> Enclosure {
    let low = f(&x.low);
    if x.is_exact() {
        return low;
    }
    Enclosure::new(low.low, f(&x.high).high)
}

/// [sin x, cos x].
fn sin_cos(x: &Enclosure, bits: u32) -> [Enclosure; 2] {
    let anything = Enclosure::new(Dyadic::from_int(-1), Dyadic::from_int(1));
    if x.top() > LARGEST || x.width(64).top() > 2 {
        return [anything.clone(), anything];
    }
    // |x| < 2^128: the reduction loses at most that many bits.
    let w = bits + 40 + x.top().max(0) as u32;
    let middle = x.low.add(&x.high, w, Round::Down).scale(-1);
    let point = Enclosure::point(middle.clone());
    let quarter = pi(w).scale(-1);
    // Any integer k is right; the nearest keeps the rest small.
    let k = match middle.top() {
        top if top < 0 => BigInt::zero(),
        top if top < 40 => {
            BigInt::from((middle.to_f64(Round::Down) / std::f64::consts::FRAC_PI_2).round() as i64)
        }
        _ => match quarter.recip(w) {
            Some(inverse) => nearest(&point.mul(&inverse, w).low),
            None => BigInt::zero(),
        },
    };
    let turns = Enclosure::point(Dyadic::new(k.clone(), 0));
    let rest = point.sub(&turns.mul(&quarter, w), w);
    let [sin, cos] = sin_cos_small(&rest, w);
    let four: BigInt = ((k % 4) + 4) % 4;
    let [sin, cos] = match four.to_u8() {
        Some(1) => [cos, sin.neg()],
        Some(2) => [sin.neg(), cos.neg()],
        Some(3) => [cos.neg(), sin],
        _ => [sin, cos],
    };
    // The rounding of the middle is below the width of a working unit; for an exact argument it is repeated here.
    let above = x.high.add(&middle.neg(), 64, Round::Up);
    let spread = above.max(middle.add(&x.low.neg(), 64, Round::Up));
    [sin, cos].map(|value| {
        let wide = value.widen(&spread, bits);
        let low = wide.low.max(anything.low.clone());
        Enclosure::new(low, wide.high.min(anything.high.clone()))
    })
}

/// The integer nearest to a number.
fn nearest(x: &Dyadic) -> BigInt {
    x.add(&Dyadic::new(1, -1), 256, Round::Down).floor_of(0)
}

/// [sin x, cos x] for |x| < 1, by halving j times, Taylor, and doubling: with d = cos − 1, sin 2x = 2 sin x (1 + d) and
/// d(2x) = 4d + 2d².
fn sin_cos_small(x: &Enclosure, bits: u32) -> [Enclosure; 2] {
    let halvings = halvings(bits, 2, 4);
    let w = bits + 2 * halvings as u32 + 8;
    let y = x.scale(-halvings);
    let square = y.square(w);
    // sin y = y Σ (−1)^k y^(2k)/(2k+1)!, d = −(y²/2) Σ (−1)^k 2 y^(2k)/(2k+2)!: factors near 1 keep every digit of a small y.
    let [odd, even] =
        [0, 1].map(|n| fixed_series(&square, w, true, |k| [(2 * k + n) * (2 * k + n + 1), 1]));
    let mut sin = y.mul(&odd, w);
    let mut d = square.scale(-1).neg().mul(&even, w);
    for _ in 0..halvings {
        sin = sin.mul(&d.add(&unit(), w), w).scale(1);
        d = d.scale(2).add(&d.square(w).scale(1), w);
    }
    [sin.rounded(bits), d.add(&unit(), w).rounded(bits)]
}

/// Σ (±1)^k t_k/b_k for 0 ≤ s ≤ 1/4 in fixed point with `w` bits, where t_0 = 1 and t_k = t_{k−1} s/a_k; `at` gives the whole
/// numbers a_k and b_k, none of them decreasing.
fn fixed_series(
    s: &Enclosure,
    w: u32,
    alternating: bool,
    at: impl Fn(u64) -> [u64; 2],
) -> Enclosure {
    let [low, high] = [s.low.floor_of(w), s.high.floor_of(w) + 1];
    let mut power: BigInt = BigInt::one() << w;
    let mut total = power.clone();
    let mut terms = 1u64;
    loop {
        let [a, b] = at(terms);
        power = ((power * &low) >> w) / a;
        if power.is_zero() {
            break;
        }
        let term = &power / b;
        if alternating && terms % 2 == 1 {
            total -= term
        } else {
            total += term
        }
        terms += 1;
    }
    // Each power is at most 3 units too small (the error shrinks by 4 per step and grows by 2), each term so by at most 4; the
    // terms left out shrink by 4 from 3 units on; and the slope in s is at most Σ k/4^(k−1)/3 < 1.
    around(total, (high - low) + 4 * terms + 4, w)
}

/// eˣ.
pub(super) fn exp(x: &Enclosure, bits: u32) -> Outcome<Enclosure> {
    // 2^39 keeps the result's exponent countable.
    if x.top() > 39 {
        return Unknown;
    }
    let width = x.width(64);
    if width.top().saturating_add(i64::from(bits) / 2) > 0 {
        return Value(monotone(x, |t| exp_point(t, bits)));
    }
    // e^(x + d) ≤ eˣ (1 + 2d) for d ≤ 1.
    let low = exp_point(&x.low, bits);
    let above = low.high.mul(&width.scale(1));
    Value(low.reaching(&above, bits))
}

fn exp_point(x: &Dyadic, bits: u32) -> Enclosure {
    if x.sign() == 0 {
        return unit();
    }
    let halvings = halvings(bits, 2, 6);
    let w = bits + 64 + halvings as u32;
    // Any integer k is right; this one leaves a rest between 0 and 0.7, whichever way its double is rounded.
    let k = (x.to_f64(Round::Down) / std::f64::consts::LN_2 - 1.0 / 256.0).floor() as i64;
    let turns = Enclosure::point(Dyadic::from_int(k));
    let y = Enclosure::point(x.clone()).sub(&turns.mul(&ln_two(w), w), w);
    let mut total = fixed_series(&y.scale(-halvings), w, false, |n| [n, 1]);
    for _ in 0..halvings {
        total = total.square(w);
    }
    total.scale(k).rounded(bits)
}

/// ln x.
pub(super) fn ln(x: &Enclosure, bits: u32) -> Outcome<Enclosure> {
    if x.high.sign() <= 0 {
        return Undefined;
    }
    if x.low.sign() <= 0 {
        return Unknown;
    }
    let width = x.width(64);
    let is_narrow = width.top().saturating_add(i64::from(bits) / 2) < x.low.top();
    match Enclosure::point(x.low.clone()).recip(64) {
        // ln(x + d) ≤ ln x + d/x.
        Some(slope) if is_narrow => {
            let above = slope.high.mul(&width);
            Value(ln_point(&x.low, bits).reaching(&above, bits))
        }
        _ => Value(monotone(x, |t| ln_point(t, bits))),
    }
}

/// ln x = k ln 2 + 2 artanh((m − 1)/(m + 1)) with x = m·2^k and m in [1/√2, √2], roughly.
fn ln_point(x: &Dyadic, bits: u32) -> Enclosure {
    let w = bits + 64;
    let mut k = x.top();
    let mut m = x.scale(-k);
    // m in [1/2, 1); below 0.7 it is doubled.
    if m < Dyadic::new(45, -6) {
        m = m.scale(1);
        k -= 1;
    }
    let mut m = Enclosure::point(m);
    let mut roots = 0;
    // Near 1 the quotient is small already, and roots would cancel digits.
    if m.sub(&unit(), 64).abs().high.top() > -8 {
        roots = halvings(bits, 2, 0);
    }
    let w = w + roots as u32 + 8;
    for _ in 0..roots {
        m = m.sqrt(w).unwrap_or_else(unit);
    }
    let z = match m.add(&unit(), w).recip(w) {
        Some(inverse) => m.sub(&unit(), w).mul(&inverse, w),
        None => unit(),
    };
    let part = odd_series(&z, w, false).scale(1 + roots);
    let turns = Enclosure::point(Dyadic::from_int(k));
    turns.mul(&ln_two(w), w).add(&part, w).rounded(bits)
}

/// Σ (±1)^k z^(2k+1)/(2k+1) for |z| ≤ 1/2: artanh z, or atan z with alternating signs.
fn odd_series(z: &Enclosure, w: u32, alternating: bool) -> Enclosure {
    let series = fixed_series(&z.square(w), w, alternating, |k| [1, 2 * k + 1]);
    z.mul(&series, w)
}

/// atan x; its slope is at most 1, so a narrow interval that is not far from zero needs one end only.
fn atan(x: &Enclosure, bits: u32) -> Enclosure {
    let width = x.width(64);
    let is_narrow =
        width.top().saturating_add(i64::from(bits) / 2) < x.low.top() && x.low.top() <= 4;
    if !is_narrow || width.sign() == 0 {
        return monotone(x, |t| atan_point(t, bits));
    }
    atan_point(&x.low, bits).reaching(&width, bits)
}

/// atan x by |x| > 1 → π/2 − atan(1/x), then atan x = 2 atan(x/(1 + √(1 + x²))).
fn atan_point(x: &Dyadic, bits: u32) -> Enclosure {
    if x.sign() == 0 {
        return Enclosure::point(Dyadic::zero());
    }
    if x.sign() < 0 {
        return atan_point(&x.neg(), bits).neg();
    }
    let halvings = halvings(bits, 8, 2);
    let w = bits + 32;
    let point = Enclosure::point(x.clone());
    let inverted = x.top() > 0;
    let mut z = match point.recip(w) {
        Some(inverse) if inverted => inverse,
        _ => point,
    };
    for _ in 0..halvings {
        let root = z.square(w).add(&unit(), w).sqrt(w).unwrap_or_else(unit);
        z = match root.add(&unit(), w).recip(w) {
            Some(inverse) => z.mul(&inverse, w),
            None => z,
        };
    }
    let angle = odd_series(&z, w, true).scale(halvings);
    match inverted {
        true => pi(w).scale(-1).sub(&angle, w).rounded(bits),
        false => angle.rounded(bits),
    }
}

/// asin x = atan(x/√(1 − x²)); ±π/2 at ±1.
fn asin(x: &Enclosure, bits: u32) -> Outcome<Enclosure> {
    let one = Dyadic::from_int(1);
    if x.low > one || x.high < one.neg() {
        return Undefined;
    }
    if x.high > one || x.low < one.neg() {
        return Unknown;
    }
    let w = bits + 32;
    let quarter = pi(w).scale(-1);
    let at = |t: &Dyadic| {
        let point = Enclosure::point(t.clone());
        // (1 − t)(1 + t) loses nothing near ±1.
        let rest = unit().sub(&point, 4 * w).mul(&unit().add(&point, 4 * w), w);
        match rest.sqrt(w).and_then(|r| r.recip(w)) {
            Some(inverse) => atan(&point.mul(&inverse, w), w),
            None if !rest.is_exact() => Enclosure::new(quarter.high.neg(), quarter.high.clone()),
            None if t.sign() > 0 => quarter.clone(),
            None => quarter.neg(),
        }
    };
    Value(monotone(x, at).rounded(bits))
}

fn hyperbolic(x: &Enclosure, function: Function, bits: u32) -> Outcome<Enclosure> {
    let w = bits + 32;
    let cosh = |t: &Enclosure| {
        exp(t, w).then(|e| match e.recip(w) {
            Some(inverse) => Value(e.add(&inverse, w).scale(-1)),
            None => Unknown,
        })
    };
    match function {
        Function::Cosh => cosh(&x.abs()).then(|high| {
            // Even, and increasing in |x|.
            cosh(&Enclosure::point(x.abs().low))
                .then(|low| Value(Enclosure::new(low.low.clone(), high.high.clone()).rounded(bits)))
        }),
        _ => exp(x, w).then(|up| {
            if up.recip(w).is_none() {
                return Unknown;
            }
            let at = |t: &Dyadic| {
                let e = exp_point(t, w);
                let inverse = e.recip(w).unwrap_or_else(unit);
                let (difference, sum) = (e.sub(&inverse, w), e.add(&inverse, w));
                match function {
                    Function::Sinh => difference.scale(-1),
                    _ => difference.mul(&sum.recip(w).unwrap_or_else(unit), w),
                }
            };
            Value(monotone(x, at).rounded(bits))
        }),
    }
}

/// The exact fraction 1, as an enclosure.
fn unit() -> Enclosure {
    Enclosure::point(Dyadic::from_int(1))
}
