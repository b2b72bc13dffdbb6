//! The value of an expression in all lanes, piece by piece.

use super::lanes::Lanes;
use super::prime::{negative, one};
use super::real::Real;
use super::value::{Bound, Circle, Sign, Value};
use crate::expr::angle::angle;
use crate::expr::{Expr, Function, Node, Rational, Symbol};

/// Largest number taken, so that it stays below every prime used.
const LARGEST: u64 = 1_000_000_000_000_000_000;
/// Largest exponent.
const HIGHEST: i64 = 1 << 20;
/// Most nodes.
const MOST: usize = 20_000;
/// Largest multiple of the unit of an angle.
const MOST_TURNS: u32 = 16;

/// The value of an expression; `None` where it is not of the kind this is for.
pub(super) fn value<const C: u64, const L: usize, const R: usize>(
    e: &Expr,
    lanes: &mut Lanes<C, L, R>,
) -> Option<Value<L, R>> {
    Walk { lanes, left: MOST }.value(e)
}

struct Walk<'a, 'b, const C: u64, const L: usize, const R: usize> {
    lanes: &'a mut Lanes<'b, C, L, R>,
    left: usize,
}

impl<const C: u64, const L: usize, const R: usize> Walk<'_, '_, C, L, R> {
    fn value(&mut self, e: &Expr) -> Option<Value<L, R>> {
        self.left = self.left.checked_sub(1)?;
        match e.node() {
            Node::Number(value) => self.number(value),
            // π is transcendental: a symbol like others, with a known real value.
            Node::Symbol(name) if &**name == "pi" => {
                Some(self.lanes.drawn("pi", Sign::Positive, [Real::PI; R]))
            }
            Node::Symbol(name) => {
                let index = self.index(name)?;
                Some(self.lanes.symbol(index))
            }
            Node::Sum(terms) => {
                let mut total = self.value(&terms[0])?;
                for term in &terms[1..] {
                    total.add::<C>(&self.value(term)?);
                }
                Some(total)
            }
            Node::Product(factors) => {
                let mut total = self.value(&factors[0])?;
                for factor in &factors[1..] {
                    total.multiply::<C>(&self.value(factor)?);
                }
                Some(total)
            }
            Node::Power(base, exponent) => {
                let twice = exponent.as_number()? * crate::expr::ratio(2, 1);
                let halves = whole(&twice).filter(|k| *k != 0 && k.abs() <= HIGHEST)?;
                let base = self.value(base)?;
                self.power(base, i32::try_from(halves).ok()?)
            }
            Node::Call(f @ (Function::Sin | Function::Cos | Function::Tan), argument) => {
                self.turn(*f, argument)
            }
            Node::Call(..) => None,
        }
    }

    fn index(&self, name: &Symbol) -> Option<usize> {
        let places = self.lanes.places;
        places.binary_search_by(|place| place.name.cmp(name)).ok()
    }

    fn number(&mut self, value: &Rational) -> Option<Value<L, R>> {
        let small = |n: i64| Some(n.unsigned_abs()).filter(|n| *n <= LARGEST);
        let above = value.numer().as_i64()?;
        let below = small(value.denom().as_i64()?)?;
        let out = self.lanes.constant(small(above)?, below);
        Some(if above < 0 {
            negated::<C, L, R>(out)
        } else {
            out
        })
    }

    /// A value to the power of `halves`/2.
    fn power(&mut self, base: Value<L, R>, halves: i32) -> Option<Value<L, R>> {
        let size = halves.unsigned_abs();
        let out = match size.is_multiple_of(2) {
            true => base.raised::<C>(size / 2),
            false => self.lanes.root(base)?.raised::<C>(size),
        };
        match halves < 0 {
            true => self.lanes.inverse(&out),
            false => Some(out),
        }
    }

    /// Sine, cosine or tangent of a combination of angles and quarter turns.
    fn turn(&mut self, function: Function, argument: &Expr) -> Option<Value<L, R>> {
        let read = angle(argument)?;
        let quarters = whole(&(&read.pi * crate::expr::ratio(2, 1)))?.rem_euclid(4);
        let mut total: Option<Circle<L, R>> = None;
        let mut acute = quarters == 0 && read.symbols.len() == 1;
        for (name, share) in &read.symbols {
            let index = self.index(name)?;
            let place = &self.lanes.places[index];
            let divisor = i64::from(place.divisor);
            let (above, below) = (share.numer().as_i64()?, share.denom().as_i64()?);
            if divisor % below != 0 {
                return None;
            }
            let k = above.checked_mul(divisor / below)?;
            let turns = u32::try_from(k.unsigned_abs()).ok()?;
            if turns > MOST_TURNS {
                return None;
            }
            acute &= above > 0 && above <= below && place.acute;
            let unit = self.lanes.circle(index);
            let mut turned = unit;
            for _ in 1..turns {
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
        let mut value = match function {
            Function::Sin => coordinate::<C, L, R>(&circle, true, quarters),
            Function::Cos => coordinate::<C, L, R>(&circle, false, quarters),
            // Both stand above the same.
            _ => {
                let level = |sine| Value {
                    below: [one::<C>(); L],
                    whole: true,
                    bounds: [bounds(&circle)[0], Bound::ONE],
                    ..coordinate::<C, L, R>(&circle, sine, quarters)
                };
                let mut sine = level(true);
                sine.multiply::<C>(&self.lanes.inverse(&level(false))?);
                sine
            }
        };
        if acute {
            value.sign = Sign::Positive;
        }
        Some(value)
    }
}

/// A fraction that is a whole number of a machine word.
fn whole(value: &Rational) -> Option<i64> {
    value.numer().as_i64().filter(|_| value.is_integer())
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
    quarters: i64,
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
