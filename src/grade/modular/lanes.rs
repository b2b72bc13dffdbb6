//! Values of a formula at several points modulo a prime, side by side, with bounds on the polynomials behind them.
//!
//! A value is a quotient above/below in every lane, so that nothing is inverted. Beside it stand bounds on the degrees of
//! the two polynomials in the parameters of the points and on the sums of the absolute values of their coefficients.
//!
//! # Roots
//! A symbol that is positive is a fourth power at every point, and the root of a residue is the one that is a square
//! itself; so roots of products of such symbols (and of constants made of small primes) are those of real numbers. Any other
//! root is a *generator*: an element adjoined to the field of what came before. It is accepted only if in some lane that
//! is alive its radicand is no square: then it is no square in the field before either, adjoining it is a true extension,
//! and either choice of its sign in the lanes is as good as the real one. Lanes where it has no root are dead from there.

use super::prime::{
    self, ROOTS, SMOOTH, add, each, negative, one, random, residue, roots, seed, times,
};
use super::real::Real;
use crate::expr::{Function, Symbol};
use crate::formula::stream::{Angle, Builder};

/// Largest multiple of the unit of an angle.
const MOST_TURNS: u32 = 16;
/// Most generators in a pair of formulas.
const MOST_ROOTS: usize = 4;

/// Bounds on a polynomial.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bound {
    pub degree: f64,
    /// Sum of the absolute values of the coefficients.
    pub norm: f64,
}

impl Bound {
    pub(super) const ONE: Bound = Bound {
        degree: 0.0,
        norm: 1.0,
    };
    fn times(self, other: Bound) -> Bound {
        Bound {
            degree: self.degree + other.degree,
            norm: self.norm * other.norm,
        }
    }
    fn plus(self, other: Bound) -> Bound {
        Bound {
            degree: self.degree.max(other.degree),
            norm: self.norm + other.norm,
        }
    }
    fn power(self, k: u32) -> Bound {
        Bound {
            degree: self.degree * f64::from(k),
            norm: match k {
                2 => self.norm * self.norm,
                _ => self.norm.powi(k.min(10_000) as i32),
            },
        }
    }
    fn root(self) -> Bound {
        Bound {
            degree: self.degree / 2.0,
            norm: self.norm.sqrt(),
        }
    }
}

/// What is known of the sign of a value on the whole domain.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Sign {
    Unknown,
    NotNegative,
    Positive,
}

/// A value in all lanes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Value<const L: usize, const R: usize> {
    above: [u64; L],
    below: [u64; L],
    /// Whether `below` is 1 everywhere.
    whole: bool,
    bounds: [Bound; 2],
    /// At real points.
    real: [Real; R],
    sign: Sign,
    /// Whether it is a product of positive symbols and a constant made of small primes.
    monomial: bool,
    /// The primes that divide that constant an odd number of times, as bits.
    odd: u32,
}

/// Where a symbol lives; without one it is positive, or an angle in the first quadrant.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Place {
    pub sign: Sign,
    /// Real points are taken from here.
    pub range: [f64; 2],
    /// A component of a unit vector: the name of the first one, and whether this is the second.
    pub unit: Option<(Symbol, bool)>,
}

/// Values of symbols, found once and used by many formulas.
#[derive(Clone, Debug)]
pub(super) struct Points<const L: usize, const R: usize> {
    symbols: Vec<Option<Value<L, R>>>,
    circles: Vec<Option<[Value<L, R>; 2]>>,
}

impl<const L: usize, const R: usize> Points<L, R> {
    pub(super) const EMPTY: Points<L, R> = Points {
        symbols: Vec::new(),
        circles: Vec::new(),
    };
}

/// One formula after the other, read into values at the same points.
#[derive(Clone, Debug)]
pub(super) struct Lanes<'a, const C: u64, const L: usize, const R: usize> {
    /// Points found before.
    known: &'a Points<L, R>,
    places: &'a [Option<Place>],
    /// Points found now.
    pub points: Points<L, R>,
    /// Angles are multiples of (symbol)/`divisor`.
    pub divisor: i32,
    /// The divisor it takes to read on, where another one is needed.
    pub wanted: i32,
    /// Whether reading ended at a root that these lanes do not take.
    pub rooted: bool,
    /// Another one gives other points.
    pub round: u64,
    pub state: State<L, R>,
}

/// The generators met so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct State<const L: usize, const R: usize> {
    generators: [Option<Generator<L, R>>; MOST_ROOTS],
    /// Lanes in which all roots so far exist, as bits.
    pub alive: u32,
    /// Generators used since this was cleared, as bits.
    pub used: u32,
    /// Constants whose roots were taken: their odd primes, reduced to independent ones.
    constants: [u32; MOST_ROOTS],
}

#[derive(Clone, Copy, Debug)]
struct Generator<const L: usize, const R: usize> {
    core: Value<L, R>,
    root: Value<L, R>,
}

/// How two values compare.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Compared {
    pub equal: bool,
    /// Largest probability that an equality is none.
    pub bound: f64,
}

impl<const L: usize, const R: usize> State<L, R> {
    /// Adjoins the root of a constant, unless it is a product of those that are there.
    fn adjoin(&mut self, mut odd: u32) -> Option<()> {
        for known in &mut self.constants {
            if odd == 0 {
                return Some(());
            }
            if *known == 0 {
                *known = odd;
                return Some(());
            }
            odd = odd.min(odd ^ *known);
        }
        (odd == 0).then_some(())
    }

    /// How many square roots have two signs each.
    fn degree(&self) -> i32 {
        let constants = self.constants.iter().filter(|c| **c != 0).count();
        (self.generators.iter().flatten().count() + constants) as i32
    }
}

impl<'a, const C: u64, const L: usize, const R: usize> Lanes<'a, C, L, R> {
    pub fn new(known: &'a Points<L, R>, places: &'a [Option<Place>], divisor: i32) -> Self {
        Lanes {
            known,
            places,
            points: Points::EMPTY,
            divisor,
            wanted: divisor,
            rooted: false,
            round: 0,
            state: State {
                generators: [None; MOST_ROOTS],
                alive: (1 << L) - 1,
                used: 0,
                constants: [0; MOST_ROOTS],
            },
        }
    }

    fn constant(&self, above: u64, below: u64) -> Value<L, R> {
        let odd = match C {
            ROOTS => odd_primes(above).zip(odd_primes(below)).map(|(a, b)| a ^ b),
            _ => None,
        };
        let bound = |norm: u64| Bound {
            degree: 0.0,
            norm: norm as f64,
        };
        Value {
            above: [residue::<C>(above); L],
            below: [residue::<C>(below); L],
            whole: below == 1,
            bounds: [bound(above), bound(below)],
            real: [Real::quotient(above, below); R],
            sign: if above == 0 {
                Sign::NotNegative
            } else {
                Sign::Positive
            },
            monomial: C == ROOTS && above > 0 && odd.is_some(),
            odd: odd.unwrap_or(0),
        }
    }

    fn place(&self, index: usize) -> Option<&'a Place> {
        self.places.get(index)?.as_ref()
    }

    fn fresh(&self, index: usize, name: &[u8]) -> Value<L, R> {
        let mut value = self.constant(1, 1);
        let place = self.place(index);
        if let Some((first, second)) = place.and_then(|p| p.unit.as_ref()) {
            return self.unit(first.as_bytes(), [0.2, 1.3])[usize::from(*second)];
        }
        let sign = place.map_or(Sign::Positive, |p| p.sign);
        let power = if C == ROOTS && sign != Sign::Unknown {
            4
        } else {
            1
        };
        let seed = seed(name) ^ self.round;
        for (lane, above) in value.above.iter_mut().enumerate() {
            let drawn = random::<C>(seed, lane as u64);
            *above = match power {
                1 => drawn,
                _ => prime::power::<C>(drawn, 4),
            };
        }
        value.bounds[0].degree = power as f64;
        value.real = real(seed, place.map_or([0.5, 2.5], |p| p.range));
        value.sign = sign;
        value.monomial = power == 4;
        value.odd = 0;
        value
    }

    /// Cosine and sine of an angle of which nothing is known but its name.
    fn unit(&self, name: &[u8], range: [f64; 2]) -> [Value<L, R>; 2] {
        let mut both = [self.constant(1, 1); 2];
        let seed = seed(name) ^ self.round;
        for lane in 0..L {
            let t = random::<C>(seed, lane as u64);
            let square = times::<C>(t, t);
            both[0].above[lane] = add::<C>(one::<C>(), negative::<C>(square));
            both[1].above[lane] = add::<C>(t, t);
            both[0].below[lane] = add::<C>(one::<C>(), square);
        }
        both[1].below = both[0].below;
        let units = real::<R>(seed, range).map(Real::unit);
        both[0].real = units.map(|[cos, _]| cos);
        both[1].real = units.map(|[_, sin]| sin);
        for value in &mut both {
            value.whole = false;
            value.bounds = [Bound {
                degree: 2.0,
                norm: 2.0,
            }; 2];
            value.sign = Sign::Unknown;
            value.monomial = false;
        }
        both
    }

    /// Finds the values of a name before anything is read.
    pub fn prepare(&mut self, index: usize, name: &[u8]) {
        self.symbol_at(index, name);
        self.circle_at(index, name);
    }

    #[inline]
    fn symbol_at(&mut self, index: usize, name: &[u8]) -> Value<L, R> {
        if let Some(Some(value)) = self.known.symbols.get(index) {
            return *value;
        }
        if let Some(Some(value)) = self.points.symbols.get(index) {
            return *value;
        }
        let value = self.fresh(index, name);
        if self.points.symbols.len() <= index {
            self.points.symbols.reserve(16);
            self.points.symbols.resize(index + 1, None);
        }
        self.points.symbols[index] = Some(value);
        value
    }

    /// Cosine and sine of the unit of an angle.
    #[inline]
    fn circle_at(&mut self, index: usize, name: &[u8]) -> [Value<L, R>; 2] {
        if let Some(Some(value)) = self.known.circles.get(index) {
            return *value;
        }
        if let Some(Some(value)) = self.points.circles.get(index) {
            return *value;
        }
        let range = self.place(index).map_or([0.1, 1.45], |p| p.range);
        let value = self.unit(name, range.map(|end| end / f64::from(self.divisor)));
        if self.points.circles.len() <= index {
            self.points.circles.resize(index + 1, None);
        }
        self.points.circles[index] = Some(value);
        value
    }

    /// Whether a value is 0 in a lane that counts.
    #[inline]
    fn vanishes(&self, a: &Value<L, R>) -> bool {
        (0..L).any(|lane| a.above[lane] == 0 && self.state.alive >> lane & 1 == 1)
    }

    fn same(&self, a: &Value<L, R>, b: &Value<L, R>) -> bool {
        (0..L).all(|lane| {
            self.state.alive >> lane & 1 == 0
                || times::<C>(a.above[lane], b.below[lane])
                    == times::<C>(b.above[lane], a.below[lane])
        })
    }

    fn root(&mut self, a: Value<L, R>) -> Option<Value<L, R>> {
        if C != ROOTS {
            self.rooted = true;
            return None;
        }
        if !a.monomial {
            for at in 0..MOST_ROOTS {
                if let Some(generator) = self.state.generators[at]
                    && self.same(&generator.core, &a)
                {
                    self.state.used |= 1 << at;
                    return Some(generator.root);
                }
            }
        }
        // √(n/d) = √(n d)/d.
        let radicand = each(a.above, a.below, times::<C>);
        let above = roots::<C, L>(radicand);
        let square = each(above, above, times::<C>);
        let exists = (0..L).fold(0, |set, lane| {
            set | u32::from(square[lane] == radicand[lane]) << lane
        });
        let inner = a.bounds[0].times(a.bounds[1]);
        let root = Value {
            above,
            bounds: [inner.root(), a.bounds[1]],
            real: a.real.map(Real::sqrt),
            sign: a.sign.max(Sign::NotNegative),
            monomial: false,
            ..a
        };
        if a.monomial {
            if self.state.adjoin(a.odd).is_none() {
                self.state.alive = 0;
            }
            return Some(root);
        }
        let lost = self.state.alive & !exists;
        let free = self.state.generators.iter().position(Option::is_none);
        match free {
            Some(free) if lost != 0 => {
                self.state.alive &= exists;
                self.state.generators[free] = Some(Generator { core: a, root });
                self.state.used |= 1 << free;
            }
            // Nothing more is known of the lanes; what real points tell remains.
            _ => self.state.alive = 0,
        }
        Some(root)
    }

    fn raised(&self, a: Value<L, R>, k: u32) -> Value<L, R> {
        if k == 1 {
            return a;
        }
        let lanes = |x: [u64; L]| match k {
            2 => each(x, x, times::<C>),
            _ => prime::powers::<C, L>(x, u64::from(k)),
        };
        Value {
            above: lanes(a.above),
            below: if a.whole { a.below } else { lanes(a.below) },
            bounds: a.bounds.map(|b| b.power(k)),
            real: a.real.map(|x| x.power(k)),
            sign: if k % 2 == 0 {
                a.sign.max(Sign::NotNegative)
            } else {
                a.sign
            },
            odd: if k % 2 == 0 { 0 } else { a.odd },
            ..a
        }
    }

    fn inverse(&self, a: Value<L, R>) -> Option<Value<L, R>> {
        (!self.vanishes(&a)).then(|| Value {
            above: a.below,
            below: a.above,
            whole: false,
            bounds: [a.bounds[1], a.bounds[0]],
            real: a.real.map(Real::inverse),
            ..a
        })
    }

    /// Those of some generators whose radicand may be negative.
    fn unsure(&self, used: u32) -> u32 {
        let mut out = 0;
        for (at, generator) in self.state.generators.iter().enumerate() {
            let unsure = generator.is_some_and(|g| g.core.sign == Sign::Unknown);
            out |= u32::from(unsure) << at;
        }
        out & used
    }

    /// Compares an answer with what is expected; each comes with the generators it uses. `None` where nothing follows.
    pub fn compare(
        &self,
        expected: (&Value<L, R>, u32),
        answer: (&Value<L, R>, u32),
    ) -> Option<Compared> {
        let ((e, mine), (a, theirs)) = (expected, answer);
        // Enclosures at real points that do not meet settle it.
        let pairs = || e.real.iter().zip(&a.real);
        if pairs().any(|(x, y)| x.apart(y)) {
            return Some(Compared {
                equal: false,
                bound: 0.0,
            });
        }
        if self.state.alive == 0 {
            return None;
        }
        let equal = self.same(e, a);
        if C == ROOTS {
            // Roots of what may be negative: both sides have to lack values at the same places, and to have some at one.
            let defined = pairs().any(|(x, y)| x.is_known() && y.is_known());
            if !equal || !defined || self.unsure(mine) != self.unsure(theirs) {
                return None;
            }
        }
        let left = e.bounds[0].times(a.bounds[1]);
        let right = a.bounds[0].times(e.bounds[1]);
        // The product of the difference with its conjugates, one for each choice of signs of the roots.
        let conjugates = 1 << self.state.degree();
        let whole = left.plus(right).power(conjugates);
        let largest = prime::prime::<C>() as f64;
        // Otherwise the prime could divide all coefficients.
        if equal && whole.norm >= largest * 0.999 {
            return None;
        }
        let lanes = self.state.alive.count_ones().min(2) as i32;
        Some(Compared {
            equal,
            bound: (whole.degree.max(1.0) / largest).powi(lanes),
        })
    }
}

/// The primes that divide a number an odd number of times, as bits by their size; `None` where a large one occurs.
fn odd_primes(n: u64) -> Option<u32> {
    const PRIMES: [u64; 23] = [
        2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71, 73, 79, SMOOTH,
    ];
    let mut left = n.max(1);
    let mut odd = 0;
    for (bit, q) in PRIMES.iter().enumerate() {
        if left == 1 {
            break;
        }
        while left % q == 0 {
            left /= q;
            odd ^= 1 << bit;
        }
    }
    (left == 1).then_some(odd)
}

/// Numbers inside a range, drawn for a seed.
fn real<const R: usize>(seed: u64, [low, high]: [f64; 2]) -> [Real; R] {
    std::array::from_fn(|lane| {
        let share = random::<1>(seed, 1000 + lane as u64) as f64 / prime::prime::<1>() as f64;
        Real::exact(low + (high - low) * (0.05 + 0.9 * share))
    })
}

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
        let base = if size % 2 == 0 { a } else { self.root(a)? };
        let k = if size % 2 == 0 { size / 2 } else { size };
        let raised = self.raised(base, k);
        if halves < 0 {
            return self.inverse(raised);
        }
        Some(raised)
    }

    fn turn(
        &mut self,
        f: Function,
        reciprocal: bool,
        angle: &Angle,
        names: &[&[u8]],
    ) -> Option<Value<L, R>> {
        let mut total: Option<[Value<L, R>; 2]> = None;
        let mut acute = angle.quarters == 0;
        for ((index, share), name) in angle.parts().zip(names) {
            if self.divisor % share.below != 0 {
                self.wanted = num_integer::lcm(self.divisor, share.below);
                return None;
            }
            let k = share.above * (self.divisor / share.below);
            acute &= total.is_none()
                && share.above > 0
                && share.above <= share.below
                && self.place(index).is_none();
            let mut unit = self.circle_at(index, name);
            if k.unsigned_abs() > MOST_TURNS {
                return None;
            }
            let size = k.unsigned_abs();
            let one = unit;
            for _ in 1..size {
                unit = self.turned(&unit, &one)?;
            }
            for value in &mut unit {
                value.bounds = [
                    Bound {
                        degree: 2.0 * f64::from(size),
                        norm: f64::from(2u32.pow(size)).powi(2) / 2.0,
                    },
                    Bound {
                        degree: 2.0 * f64::from(size),
                        norm: f64::from(2u32.pow(size)),
                    },
                ];
            }
            if k < 0 {
                unit[1] = self.negative(unit[1])?;
            }
            total = Some(match total {
                None => unit,
                Some(before) => self.turned(&before, &unit)?,
            });
        }
        let [cos, sin] = total?;
        let [cos, sin] = match angle.quarters.rem_euclid(4) {
            0 => [cos, sin],
            1 => [self.negative(sin)?, cos],
            2 => [self.negative(cos)?, self.negative(sin)?],
            _ => [sin, self.negative(cos)?],
        };
        let mut value = match f {
            Function::Sin => sin,
            Function::Cos => cos,
            // Both stand above the same.
            _ => {
                let level = |v: Value<L, R>| Value {
                    below: [one::<C>(); L],
                    whole: true,
                    bounds: [v.bounds[0], Bound::ONE],
                    ..v
                };
                self.quotient(level(sin), level(cos))?
            }
        };
        if reciprocal {
            value = self.inverse(value)?;
        }
        if acute {
            value.sign = Sign::Positive;
        }
        Some(value)
    }
}

impl<const C: u64, const L: usize, const R: usize> Lanes<'_, C, L, R> {
    /// Cosine and sine of the sum of two angles, over the product of what stands below.
    fn turned(&mut self, a: &[Value<L, R>; 2], b: &[Value<L, R>; 2]) -> Option<[Value<L, R>; 2]> {
        let mut product = |x: Value<L, R>, y: Value<L, R>| self.product(x, y);
        let (cc, ss) = (product(a[0], b[0])?, product(a[1], b[1])?);
        let (sc, cs) = (product(a[1], b[0])?, product(a[0], b[1])?);
        let minus = self.negative(ss)?;
        Some([self.sum(cc, minus)?, self.sum(sc, cs)?])
    }
}
