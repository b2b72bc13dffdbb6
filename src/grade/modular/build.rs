//! A formula read into values in all lanes.

use super::lanes::Lanes;
use super::prime::{negative, one};
use super::real::Real;
use super::value::{Bound, Circle, Sign, Value};
use crate::expr::Function;
use crate::formula::stream::{Angle, Builder, Ratio};

/// Largest multiple of the unit of an angle.
const MOST_TURNS: u32 = 16;

/// Where a value is kept while a formula is read, so that values are not moved about.
#[derive(Clone, Copy, Debug)]
pub(super) enum Slot {
    /// A symbol at points found before.
    Known(u32),
    /// A symbol at points found now.
    Fresh(u32),
    /// What was computed; the last ones are used up first.
    Made(u32),
}

impl<const C: u64, const L: usize, const R: usize> Lanes<'_, C, L, R> {
    /// The value kept in a slot.
    #[inline]
    pub fn at(&self, slot: Slot) -> &Value<L, R> {
        let symbol = match slot {
            Slot::Made(at) => return &self.made[at as usize],
            Slot::Known(index) => &self.known.symbols[index as usize],
            Slot::Fresh(index) => &self.points.symbols[index as usize],
        };
        symbol
            .as_ref()
            .expect("a slot is given out for what is there")
    }

    #[inline]
    fn keep(&mut self, value: Value<L, R>) -> Slot {
        self.made.push(value);
        Slot::Made(self.made.len() as u32 - 1)
    }

    /// Takes a value out of its slot.
    #[inline]
    fn take(&mut self, slot: Slot) -> Value<L, R> {
        let value = *self.at(slot);
        if let Slot::Made(at) = slot {
            self.made.truncate(at as usize);
        }
        value
    }

    /// Lets a value be changed where it is, a symbol as a copy; its slot.
    #[inline]
    fn change(&mut self, slot: Slot, change: impl FnOnce(&mut Value<L, R>)) -> Slot {
        match slot {
            Slot::Made(at) => {
                change(&mut self.made[at as usize]);
                slot
            }
            _ => {
                let mut value = *self.at(slot);
                change(&mut value);
                self.keep(value)
            }
        }
    }
}

impl<const C: u64, const L: usize, const R: usize> Builder for Lanes<'_, C, L, R> {
    type Value = Slot;

    fn number(&mut self, digits: u64, tens: u32) -> Option<Slot> {
        let value = self.constant(digits, 10u64.checked_pow(tens)?);
        Some(self.keep(value))
    }

    #[inline]
    fn symbol(&mut self, index: usize, name: &[u8]) -> Option<Slot> {
        Some(self.symbol_at(index, name))
    }

    fn pi(&mut self) -> Option<Slot> {
        // π is transcendental: a symbol like others, with a known real value.
        let mut value = self.fresh(usize::MAX, b"pi");
        value.real = [Real::PI; R];
        Some(self.keep(value))
    }

    fn negative(&mut self, a: Slot) -> Option<Slot> {
        Some(self.change(a, |a| {
            a.above = a.above.map(negative::<C>);
            a.real = a.real.map(Real::negative);
            (a.sign, a.monomial) = (Sign::Unknown, false);
        }))
    }

    #[inline]
    fn sum(&mut self, a: Slot, b: Slot) -> Option<Slot> {
        let b = self.take(b);
        Some(self.change(a, |a| a.add::<C>(&b)))
    }

    #[inline]
    fn product(&mut self, a: Slot, b: Slot) -> Option<Slot> {
        let b = self.take(b);
        Some(self.change(a, |a| a.multiply::<C>(&b)))
    }

    fn quotient(&mut self, a: Slot, b: Slot) -> Option<Slot> {
        let b = self.take(b);
        let inverse = self.inverse(&b)?;
        Some(self.change(a, |a| a.multiply::<C>(&inverse)))
    }

    fn power(&mut self, a: Slot, halves: i32) -> Option<Slot> {
        let base = self.take(a);
        let size = halves.unsigned_abs();
        let mut out = match size.is_multiple_of(2) {
            true => base.raised::<C>(size / 2),
            false => self.root(base)?.raised::<C>(size),
        };
        if halves < 0 {
            out = self.inverse(&out)?;
        }
        Some(self.keep(out))
    }

    fn turn(&mut self, ratio: Ratio, angle: &Angle, names: &[&[u8]]) -> Option<Slot> {
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
                {
                    let mut sine = level(value(true));
                    sine.multiply::<C>(&self.inverse(&level(value(false)))?);
                    sine
                }
            }
        };
        if ratio.reciprocal {
            value = self.inverse(&value)?;
        }
        if acute {
            value.sign = Sign::Positive;
        }
        Some(self.keep(value))
    }
}
