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

use super::build::Slot;
use super::prime::{self, ROOTS, add, each, negative, one, random, residue, roots, seed, times};
use super::real::Real;
use super::value::{Bound, Circle, Place, Points, Sign, Value, odd_primes, real};

/// Most generators in a pair of formulas.
const MOST_ROOTS: usize = 4;

/// One formula after the other, read into values at the same points.
#[derive(Clone, Debug)]
pub(super) struct Lanes<'a, const C: u64, const L: usize, const R: usize> {
    /// Points found before.
    pub(super) known: &'a Points<L, R>,
    places: &'a [Option<Place>],
    /// Points found now.
    pub points: Points<L, R>,
    /// Angles are multiples of (symbol)/`divisor`.
    pub divisor: i32,
    /// The divisor it takes to read on, where another one is needed.
    pub wanted: i32,
    /// Whether reading ended at a root that these lanes do not take.
    pub rooted: bool,
    /// The points, by the numbers they are drawn with.
    pub rounds: [u64; L],
    pub state: State<L, R>,
    /// Values computed while reading, the last ones used up first.
    pub(super) made: Vec<Value<L, R>>,
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
            rounds: std::array::from_fn(|lane| lane as u64),
            state: State {
                generators: [None; MOST_ROOTS],
                alive: (1 << L) - 1,
                used: 0,
                constants: [0; MOST_ROOTS],
            },
            made: Vec::with_capacity(8),
        }
    }

    pub(super) fn constant(&self, above: u64, below: u64) -> Value<L, R> {
        let odd = match C {
            ROOTS => odd_primes(above).zip(odd_primes(below)).map(|(a, b)| a ^ b),
            _ => None,
        };
        let bound = |norm: u64| Bound {
            degree: 0.0,
            norm: norm as f32,
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

    pub(super) fn place(&self, index: usize) -> Option<&'a Place> {
        self.places.get(index)?.as_ref()
    }

    pub(super) fn fresh(&self, index: usize, name: &[u8]) -> Value<L, R> {
        let mut value = self.constant(1, 1);
        let place = self.place(index);
        if let Some((first, second)) = place.and_then(|p| p.unit.as_ref()) {
            let unit = self.unit(first.as_bytes(), [0.2, 1.3]);
            let bound = Bound {
                degree: 2.0,
                norm: 2.0,
            };
            return Value {
                above: if *second { unit.sin } else { unit.cos },
                below: unit.below,
                whole: false,
                bounds: [bound; 2],
                real: unit.real.map(|both| both[usize::from(*second)]),
                sign: Sign::Unknown,
                monomial: false,
                ..value
            };
        }
        let sign = place.map_or(Sign::Positive, |p| p.sign);
        let power = if C == ROOTS && sign != Sign::Unknown {
            4
        } else {
            1
        };
        let seed = seed(name);
        for (round, above) in self.rounds.iter().zip(value.above.iter_mut()) {
            let drawn = random::<C>(seed, *round);
            *above = match power {
                1 => drawn,
                _ => prime::power::<C>(drawn, 4),
            };
        }
        value.bounds[0].degree = power as f32;
        value.real = real(seed, place.map_or([0.5, 2.5], |p| p.range));
        value.sign = sign;
        value.monomial = power == 4;
        value.odd = 0;
        value
    }

    /// Cosine and sine of an angle of which nothing is known but its name.
    fn unit(&self, name: &[u8], range: [f64; 2]) -> Circle<L, R> {
        let seed = seed(name);
        let parameter = self.rounds.map(|round| random::<C>(seed, round));
        let square = each(parameter, parameter, times::<C>);
        Circle {
            cos: square.map(|x| add::<C>(one::<C>(), negative::<C>(x))),
            sin: parameter.map(|t| add::<C>(t, t)),
            below: square.map(|x| add::<C>(one::<C>(), x)),
            real: real::<R>(seed, range).map(Real::unit),
            degree: 2.0,
            norm: 2.0,
        }
    }

    #[inline]
    pub(super) fn symbol_at(&mut self, index: usize, name: &[u8]) -> Slot {
        if let Some(Some(_)) = self.known.symbols.get(index) {
            return Slot::Known(index as u32);
        }
        if !matches!(self.points.symbols.get(index), Some(Some(_))) {
            let value = self.fresh(index, name);
            if self.points.symbols.len() <= index {
                // More than a kilobyte at a time costs much more.
                self.points.symbols.reserve(12);
                self.points.symbols.resize(index + 1, None);
            }
            self.points.symbols[index] = Some(value);
        }
        Slot::Fresh(index as u32)
    }

    /// Cosine and sine of the unit of an angle.
    #[inline]
    pub(super) fn circle_at(&mut self, index: usize, name: &[u8]) -> Circle<L, R> {
        if let Some(Some(value)) = self.known.circles.get(index) {
            return *value;
        }
        if let Some(Some(value)) = self.points.circles.get(index) {
            return *value;
        }
        let range = self.place(index).map_or([0.1, 1.45], |p| p.range);
        let value = self.unit(name, range.map(|end| end / f64::from(self.divisor)));
        if self.points.circles.len() <= index {
            self.points.circles.reserve(8);
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

    pub(super) fn root(&mut self, a: Value<L, R>) -> Option<Value<L, R>> {
        if C != ROOTS {
            self.rooted = true;
            return None;
        }
        // Without lanes nothing tells one generator from another.
        if !a.monomial && self.state.alive != 0 {
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

    pub(super) fn inverse(&self, a: &Value<L, R>) -> Option<Value<L, R>> {
        (!self.vanishes(a)).then(|| Value {
            above: a.below,
            below: a.above,
            whole: false,
            bounds: [a.bounds[1], a.bounds[0]],
            real: a.real.map(Real::inverse),
            ..*a
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
        // Otherwise the prime could divide all coefficients; the bounds are rounded, and one that overflowed is none.
        let small = f64::from(whole.norm) < largest * 0.99 && whole.degree.is_finite();
        if equal && !small {
            return None;
        }
        // Any two of the lanes may be those left: as many pairs, as many chances.
        let (lanes, choices) = match self.state.alive.count_ones() {
            1 => (1, L as f64),
            _ => (2, (L * (L - 1) / 2) as f64),
        };
        Some(Compared {
            equal,
            bound: choices * (f64::from(whole.degree).max(1.0) / largest).powi(lanes),
        })
    }
}
