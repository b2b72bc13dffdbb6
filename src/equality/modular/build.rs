//! The pieces of an expression as values in all lanes.

use super::lanes::Lanes;
use super::real::Real;
use super::value::{Bound, Circle, Sign, Value};
use super::walk::{Builder, Turn};
use crate::algebra::prime::{negative, one};
use crate::expr::Function;

/// Largest number taken, so that it stays below every prime used.
const LARGEST: u64 = 1_000_000_000_000_000_000;
/// Largest multiple of the unit of an angle.
const MOST_TURNS: u64 = 16;

impl<const C: u64, const L: usize, const R: usize> Builder for Lanes<'_, C, L, R> {
    type Value = Value<L, R>;

    fn number(&mut self, above: i64, below: i64) -> Option<Value<L, R>> {
        let small = |n: i64| Some(n.unsigned_abs()).filter(|n| *n <= LARGEST);
        let out = self.constant(small(above)?, small(below)?);
        Some(if above < 0 {
            negated::<C, L, R>(out)
        } else {
            out
        })
    }

    fn symbol(&mut self, index: usize) -> Option<Value<L, R>> {
        Some(self.at(index))
    }

    fn pi(&mut self) -> Option<Value<L, R>> {
        // π is transcendental: a symbol like others, with a known real value.
        Some(self.drawn("pi", Sign::Positive, [Real::PI; R]))
    }

    fn sum(&mut self, mut a: Value<L, R>, b: Value<L, R>) -> Option<Value<L, R>> {
        a.add::<C>(&b);
        Some(a)
    }

    fn product(&mut self, mut a: Value<L, R>, b: Value<L, R>) -> Option<Value<L, R>> {
        a.multiply::<C>(&b);
        Some(a)
    }

    fn power(&mut self, base: Value<L, R>, halves: i32) -> Option<Value<L, R>> {
        let size = halves.unsigned_abs();
        let out = match size.is_multiple_of(2) {
            true => base.raised::<C>(size / 2),
            false => self.root(base)?.raised::<C>(size),
        };
        match halves < 0 {
            true => self.inverse(&out),
            false => Some(out),
        }
    }

    fn turn(&mut self, function: Function, turn: &Turn) -> Option<Value<L, R>> {
        let mut total: Option<Circle<L, R>> = None;
        for (index, k) in &turn.parts {
            if k.unsigned_abs() > MOST_TURNS {
                return None;
            }
            let unit = self.circle(*index);
            let mut turned = unit;
            for _ in 1..k.unsigned_abs() {
                turned = turned.turned::<C>(&unit);
            }
            if *k < 0 {
                turned.sin = turned.sin.map(negative::<C>);
                turned.real = turned.real.map(|[cos, sin]| [cos, sin.negative()]);
            }
            total = Some(match total {
                None => turned,
                Some(before) => before.turned::<C>(&turned),
            });
        }
        let circle = total?;
        let mut value = match function {
            Function::Sin => coordinate::<C, L, R>(&circle, true, turn.quarters),
            Function::Cos => coordinate::<C, L, R>(&circle, false, turn.quarters),
            // Both stand above the same.
            _ => {
                let level = |sine| Value {
                    below: [one::<C>(); L],
                    whole: true,
                    bounds: [bounds(&circle)[0], Bound::ONE],
                    ..coordinate::<C, L, R>(&circle, sine, turn.quarters)
                };
                let mut sine = level(true);
                sine.multiply::<C>(&self.inverse(&level(false))?);
                sine
            }
        };
        if turn.acute {
            value.sign = Sign::Positive;
        }
        Some(value)
    }
}

fn negated<const C: u64, const L: usize, const R: usize>(a: Value<L, R>) -> Value<L, R> {
    Value {
        above: a.above.map(negative::<C>),
        real: a.real.map(Real::negative),
        sign: Sign::Unknown,
        monomial: false,
        ..a
    }
}

/// Bounds on the numerator and the denominator of a coordinate.
fn bounds<const L: usize, const R: usize>(circle: &Circle<L, R>) -> [Bound; 2] {
    let half = circle.norm * circle.norm / 2.0;
    [half, circle.norm].map(|norm| Bound {
        degree: circle.degree,
        norm,
    })
}

/// Sine or cosine of an angle on a circle, some quarter turns further.
fn coordinate<const C: u64, const L: usize, const R: usize>(
    circle: &Circle<L, R>,
    sine: bool,
    quarters: i32,
) -> Value<L, R> {
    let (sine, minus) = match (quarters, sine) {
        (0, _) => (sine, false),
        (1, true) => (false, false),
        (1, false) => (true, true),
        (2, _) => (sine, true),
        (_, true) => (false, true),
        (_, false) => (true, false),
    };
    let value = Value {
        above: if sine { circle.sin } else { circle.cos },
        below: circle.below,
        whole: false,
        bounds: bounds(circle),
        real: circle.real.map(|[cos, sin]| if sine { sin } else { cos }),
        sign: Sign::Unknown,
        monomial: false,
        odd: 0,
    };
    match minus {
        true => negated::<C, L, R>(value),
        false => value,
    }
}
