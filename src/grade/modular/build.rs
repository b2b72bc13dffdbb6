//! A formula read into values in all lanes.

use super::lanes::Lanes;
use super::prime::{add, each, negative, one, times};
use super::real::Real;
use super::value::{Bound, Circle, Sign, Value};
use crate::expr::Function;
use crate::formula::stream::{Angle, Builder, Ratio};

/// Largest multiple of the unit of an angle.
const MOST_TURNS: u32 = 16;
impl<const C: u64, const L: usize, const R: usize> Builder for Lanes<'_, C, L, R> {
    type Value = Value<L, R>;

    fn number(&mut self, digits: u64, tens: u32) -> Option<Value<L, R>> {
        Some(self.constant(digits, 10u64.checked_pow(tens)?))
    }

    #[inline]
    fn symbol(&mut self, index: usize, name: &[u8]) -> Option<Value<L, R>> {
        Some(self.symbol_at(index, name))
    }

    fn pi(&mut self) -> Option<Value<L, R>> {
        // π is transcendental: a symbol like others, with a known real value.
        let mut value = self.fresh(usize::MAX, b"pi");
        value.real = [Real::PI; R];
        Some(value)
    }

    fn negative(&mut self, a: Value<L, R>) -> Option<Value<L, R>> {
        Some(Value {
            above: a.above.map(negative::<C>),
            real: a.real.map(Real::negative),
            sign: Sign::Unknown,
            monomial: false,
            ..a
        })
    }

    #[inline]
    fn sum(&mut self, a: Value<L, R>, b: Value<L, R>) -> Option<Value<L, R>> {
        let mut out = a;
        out.monomial = false;
        out.sign = match (a.sign, b.sign) {
            (Sign::Unknown, _) | (_, Sign::Unknown) => Sign::Unknown,
            (x, y) => x.max(y),
        };
        for (x, y) in out.real.iter_mut().zip(b.real) {
            *x = x.plus(y);
        }
        if (a.whole && b.whole) || a.below == b.below {
            out.above = each(a.above, b.above, add::<C>);
            out.bounds[0] = a.bounds[0].plus(b.bounds[0]);
            return Some(out);
        }
        let cross = |x: &Value<L, R>, y: &Value<L, R>| match y.whole {
            true => (x.above, x.bounds[0]),
            false => (
                each(x.above, y.below, times::<C>),
                x.bounds[0].times(y.bounds[1]),
            ),
        };
        let ((left, left_bound), (right, right_bound)) = (cross(&a, &b), cross(&b, &a));
        out.above = each(left, right, add::<C>);
        out.bounds[0] = left_bound.plus(right_bound);
        if a.whole {
            (out.below, out.bounds[1]) = (b.below, b.bounds[1]);
        } else if !b.whole {
            out.below = each(a.below, b.below, times::<C>);
            out.bounds[1] = a.bounds[1].times(b.bounds[1]);
        }
        out.whole = false;
        Some(out)
    }

    #[inline]
    fn product(&mut self, a: Value<L, R>, b: Value<L, R>) -> Option<Value<L, R>> {
        let mut out = a;
        out.above = each(a.above, b.above, times::<C>);
        out.bounds[0] = a.bounds[0].times(b.bounds[0]);
        if a.whole {
            (out.below, out.bounds[1]) = (b.below, b.bounds[1]);
        } else if !b.whole {
            out.below = each(a.below, b.below, times::<C>);
            out.bounds[1] = a.bounds[1].times(b.bounds[1]);
        }
        out.whole = a.whole && b.whole;
        for (x, y) in out.real.iter_mut().zip(b.real) {
            *x = x.times(y);
        }
        out.sign = a.sign.min(b.sign);
        out.monomial = a.monomial && b.monomial;
        out.odd = a.odd ^ b.odd;
        Some(out)
    }

    fn quotient(&mut self, a: Value<L, R>, b: Value<L, R>) -> Option<Value<L, R>> {
        let inverse = self.inverse(b)?;
        self.product(a, inverse)
    }

    fn power(&mut self, a: Value<L, R>, halves: i32) -> Option<Value<L, R>> {
        let size = halves.unsigned_abs();
        let base = if size.is_multiple_of(2) {
            a
        } else {
            self.root(a)?
        };
        let k = if size.is_multiple_of(2) {
            size / 2
        } else {
            size
        };
        let raised = self.raised(base, k);
        if halves < 0 {
            return self.inverse(raised);
        }
        Some(raised)
    }

    fn turn(&mut self, ratio: Ratio, angle: &Angle, names: &[&[u8]]) -> Option<Value<L, R>> {
        let mut total: Option<Circle<L, R>> = None;
        let mut acute = angle.quarters == 0;
        for ((index, share), name) in angle.parts().zip(names) {
            if self.divisor % share.below != 0 {
                self.wanted = num_integer::lcm(self.divisor, share.below);
                return None;
            }
            let k = share.above * (self.divisor / share.below);
            if k.unsigned_abs() > MOST_TURNS {
                return None;
            }
            acute &= total.is_none()
                && share.above > 0
                && share.above <= share.below
                && self.place(index).is_none();
            let unit = self.circle_at(index, name);
            let mut turned = unit;
            for _ in 1..k.unsigned_abs() {
                turned = turned.turned::<C>(&unit);
            }
            if k < 0 {
                turned.sin = turned.sin.map(negative::<C>);
                turned.real = turned.real.map(|[cos, sin]| [cos, sin.negative()]);
            }
            total = Some(match total {
                None => turned,
                Some(before) => before.turned::<C>(&turned),
            });
        }
        let circle = total?;
        // The coordinate, its sign and whether it is the sine, after some quarter turns.
        let coordinate = |sine: bool, quarters: i32| -> (bool, bool) {
            match (quarters.rem_euclid(4), sine) {
                (0, _) => (sine, false),
                (1, true) => (false, false),
                (1, false) => (true, true),
                (2, _) => (sine, true),
                (_, true) => (false, true),
                (_, false) => (true, false),
            }
        };
        let half = circle.norm * circle.norm / 2.0;
        let bound = |norm: f32| Bound {
            degree: circle.degree,
            norm,
        };
        let value = |sine: bool| {
            let (sine, minus) = coordinate(sine, angle.quarters);
            let above = if sine { circle.sin } else { circle.cos };
            let real = circle.real.map(|[cos, sin]| if sine { sin } else { cos });
            Value {
                above: if minus {
                    above.map(negative::<C>)
                } else {
                    above
                },
                below: circle.below,
                whole: false,
                bounds: [bound(half), bound(circle.norm)],
                real: if minus {
                    real.map(Real::negative)
                } else {
                    real
                },
                sign: Sign::Unknown,
                monomial: false,
                odd: 0,
            }
        };
        let mut value = match ratio.function {
            Function::Sin => value(true),
            Function::Cos => value(false),
            // Both stand above the same.
            _ => {
                let level = |v: Value<L, R>| Value {
                    below: [one::<C>(); L],
                    whole: true,
                    bounds: [v.bounds[0], Bound::ONE],
                    ..v
                };
                self.quotient(level(value(true)), level(value(false)))?
            }
        };
        if ratio.reciprocal {
            value = self.inverse(value)?;
        }
        if acute {
            value.sign = Sign::Positive;
        }
        Some(value)
    }
}
