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

use super::Place;
use super::real::Real;
use super::value::{Bound, Circle, Sign, Value, odd_primes, real};
use super::{AtPoints, walk};
use crate::algebra::prime::{
    self, ROOTS, add, each, negative, one, random, residue, roots, seed, times,
};
use crate::expr::Expr;

/// Most generators in a pair of formulas.
const MOST_ROOTS: usize = 4;

/// Two formulas, read into values at the same points.
#[derive(Debug)]
pub(super) struct Lanes<'a, const C: u64, const L: usize, const R: usize> {
    /// The symbols in alphabetical order.
    places: &'a [Place<'a>],
    /// Values and directions of symbols met so far.
    symbols: Vec<Option<Value<L, R>>>,
    circles: Vec<Option<Circle<L, R>>>,
    /// Whether reading ended at a root that these lanes do not take.
    pub rooted: bool,
    /// The points, by the numbers they are drawn with.
    rounds: [u64; L],
    state: State<L, R>,
}

/// The generators met so far.
#[derive(Clone, Copy, Debug)]
struct State<const L: usize, const R: usize> {
    generators: [Option<Generator<L, R>>; MOST_ROOTS],
    /// Lanes in which all roots so far exist, as bits.
    alive: u32,
    /// Generators used since this was cleared, as bits.
    used: u32,
    /// Constants whose roots were taken: their odd primes, reduced to independent ones.
    constants: [u32; MOST_ROOTS],
}

#[derive(Clone, Copy, Debug)]
struct Generator<const L: usize, const R: usize> {
    core: Value<L, R>,
    root: Value<L, R>,
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
    pub fn new(places: &'a [Place<'a>], rounds: [u64; L]) -> Self {
        Lanes {
            places,
            symbols: vec![None; places.len()],
            circles: vec![None; places.len()],
            rooted: false,
            rounds,
            state: State {
                generators: [None; MOST_ROOTS],
                alive: (1 << L) - 1,
                used: 0,
                constants: [0; MOST_ROOTS],
            },
        }
    }

    /// Reads two formulas one after the other, and compares them.
    pub fn both(&mut self, a: &Expr, b: &Expr) -> Option<AtPoints> {
        let left = walk::value(a, self.places, self)?;
        let mine = std::mem::take(&mut self.state.used);
        let right = walk::value(b, self.places, self)?;
        self.compare((&left, mine), (&right, self.state.used))
    }

    /// Whether two formulas agree in these lanes and at the real points, at one of which both have a value.
    pub fn agree(&mut self, a: &Expr, b: &Expr) -> Option<bool> {
        let left = walk::value(a, self.places, self)?;
        let right = walk::value(b, self.places, self)?;
        let mut pairs = left.real.iter().zip(&right.real);
        if pairs.clone().any(|(x, y)| x.apart(y)) {
            return Some(false);
        }
        match C {
            ROOTS => pairs
                .any(|(x, y)| x.is_known() && y.is_known())
                .then_some(true),
            _ => Some(self.same(&left, &right)),
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

    /// A symbol, by its place in the alphabet.
    pub(super) fn at(&mut self, index: usize) -> Value<L, R> {
        if let Some(value) = self.symbols[index] {
            return value;
        }
        let place = &self.places[index];
        let value = match place.unit {
            Some((first, second)) => self.component(first, second),
            None => self.drawn(place.name, place.sign, real(seed(place.name), place.range)),
        };
        self.symbols[index] = Some(value);
        value
    }

    /// A component of a unit vector.
    fn component(&self, first: &str, second: bool) -> Value<L, R> {
        let unit = self.unit(first, [0.2, 1.3]);
        let bound = Bound {
            degree: 2.0,
            norm: 2.0,
        };
        Value {
            above: if second { unit.sin } else { unit.cos },
            below: unit.below,
            whole: false,
            bounds: [bound; 2],
            real: unit.real.map(|both| both[usize::from(second)]),
            sign: Sign::Unknown,
            monomial: false,
            odd: 0,
        }
    }

    /// Something of which only its sign and real values are known: drawn by its name, a fourth power where roots of it are
    /// taken.
    pub(super) fn drawn(&self, name: &str, sign: Sign, real: [Real; R]) -> Value<L, R> {
        let power = match sign {
            Sign::Unknown => 1,
            _ if C == ROOTS => 4,
            _ => 1,
        };
        let seed = seed(name);
        let above = self.rounds.map(|round| match power {
            1 => random::<C>(seed, round),
            _ => prime::power::<C>(random::<C>(seed, round), 4),
        });
        let degree = power as f32;
        Value {
            above,
            below: [one::<C>(); L],
            whole: true,
            bounds: [Bound { degree, norm: 1.0 }, Bound::ONE],
            real,
            sign,
            monomial: power == 4,
            odd: 0,
        }
    }

    /// Cosine and sine of an angle of which nothing is known but its name.
    fn unit(&self, name: &str, range: [f64; 2]) -> Circle<L, R> {
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

    /// Cosine and sine of the part of an angle of which multiples occur.
    pub(super) fn circle(&mut self, index: usize) -> Circle<L, R> {
        if let Some(circle) = self.circles[index] {
            return circle;
        }
        let place = &self.places[index];
        let range = place.range.map(|end| end / f64::from(place.divisor));
        let circle = self.unit(place.name, range);
        self.circles[index] = Some(circle);
        circle
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

    /// Compares two values; each comes with the generators it uses. `None` where nothing follows.
    fn compare(&self, left: (&Value<L, R>, u32), right: (&Value<L, R>, u32)) -> Option<AtPoints> {
        let ((a, mine), (b, theirs)) = (left, right);
        let found = |equal, bound| AtPoints {
            equal,
            bound,
            roots: C == ROOTS,
        };
        // Enclosures at real points that do not meet settle it.
        let pairs = || a.real.iter().zip(&b.real);
        if pairs().any(|(x, y)| x.apart(y)) {
            return Some(found(false, 0.0));
        }
        if self.state.alive == 0 {
            return None;
        }
        let equal = self.same(a, b);
        if C == ROOTS {
            // Roots of what may be negative: both sides have to lack values at the same places, and to have some at one.
            let defined = pairs().any(|(x, y)| x.is_known() && y.is_known());
            if !equal || !defined || self.unsure(mine) != self.unsure(theirs) {
                return None;
            }
        }
        if !equal {
            return Some(found(false, 0.0));
        }
        let whole = a.bounds[0].times(b.bounds[1]);
        let whole = whole.plus(b.bounds[0].times(a.bounds[1]));
        // The product of the difference with its conjugates, one for each choice of signs of the roots.
        let whole = whole.power(1 << self.state.degree());
        let largest = prime::prime::<C>() as f64;
        // Otherwise the prime could divide all coefficients; the bounds are rounded, and one that overflowed is none.
        if f64::from(whole.norm) >= largest * 0.99 || !whole.degree.is_finite() {
            return None;
        }
        // Any two of the lanes may be those left: as many pairs, as many chances.
        let (lanes, choices) = match self.state.alive.count_ones() {
            1 => (1, L as f64),
            _ => (2, (L * (L - 1) / 2) as f64),
        };
        let chance = f64::from(whole.degree).max(1.0) / largest;
        Some(found(true, choices * chance.powi(lanes)))
    }
}
