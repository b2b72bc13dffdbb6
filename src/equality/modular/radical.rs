//! Square roots in a proof: taken apart into roots of positive numbers, of positive generators, and of what remains.
//!
//! Every root here is real and not negative. √(A/D) is √(A D)/D only where D is positive, √(a b) is √a √b only where one of
//! the two is positive: where that is not known, no root is taken.

use num_traits::Signed;

use super::exact::{Exact, GENERATORS, Generator, Quotient, times};
use super::value::Sign;
use crate::algebra::mono::{Mono, mono_add, powers};
use crate::algebra::poly::Poly;
use crate::expr::Int;

/// Numbers are taken apart into primes up to here.
const LARGEST_PRIME: i64 = 100;

impl Exact<'_> {
    /// The root of a quotient.
    pub(super) fn root(&mut self, a: &Quotient) -> Option<Quotient> {
        let positive = |e: &Self, f: &Poly| e.sign_of(f) == Sign::Positive;
        if !self.is_positive(&a.monomial) || !a.factors.iter().all(|(f, _)| positive(self, f)) {
            return None;
        }
        // With odd exponents made even, what stands below comes out.
        let (_, odd) = halves(&a.monomial);
        let mut inside = a.above.mul_term(&odd, &a.number).ok()?;
        let mut factors = Vec::with_capacity(a.factors.len());
        for (factor, power) in &a.factors {
            if power % 2 == 1 {
                inside = times(&inside, factor)?;
            }
            factors.push((factor.clone(), power.div_ceil(2)));
        }
        // Powers of roots come out before they are replaced by what they are roots of, squares of sines after.
        let (first, squares, rest) = inside.split();
        let rest = self.reduced(&rest)?.into_owned();
        let (second, more, rest) = self.lighter(rest)?.split();
        let content = first * second;
        let common = mono_add(&squares, &more).ok()?;
        if !self.is_positive(&common) {
            return None;
        }
        let (outside, primes) = taken_apart(content.abs().as_i64()?);
        let (half, rooted) = halves(&common);
        let mut above = Poly::term(&half, Int::from(outside));
        for prime in primes {
            above = times(&above, &self.adjoined(Poly::constant(Int::from(prime)))?)?;
        }
        for (at, _) in powers(&rooted) {
            above = times(&above, &self.adjoined(Poly::var(at))?)?;
        }
        let rest = if content.is_negative() {
            rest.neg()
        } else {
            rest
        };
        if !rest.is_one() {
            above = times(&above, &self.root_of_rest(&rest)?)?;
        }
        Some(Quotient {
            above,
            number: a.number.clone(),
            monomial: halves(&mono_add(&a.monomial, &odd).ok()?).0,
            factors,
        })
    }

    /// The root of a polynomial without a common factor.
    fn root_of_rest(&mut self, rest: &Poly) -> Option<Poly> {
        let rest = self.reduced(rest)?.into_owned();
        if rest.len() < 2 {
            return None;
        }
        if let Some(root) = rest.sqrt() {
            let both = [root.clone(), root.neg()];
            if let Some(root) = both.into_iter().find(|r| self.sign_of(r) > Sign::Unknown) {
                return Some(root);
            }
        }
        match self.product_of_known(&rest)? {
            Some((product, needs)) => {
                self.used |= needs;
                Some(product)
            }
            None => self.adjoined(rest),
        }
    }

    /// √(a b) as √a √b, where these two are known and a is positive; with what it takes to have a value.
    fn product_of_known(&self, rest: &Poly) -> Option<Option<(Poly, u32)>> {
        let known = self.generators.iter().enumerate().filter_map(|(at, g)| {
            let Generator::Root {
                square,
                sign,
                needs,
            } = g
            else {
                return None;
            };
            // Whatever else it takes has to stand in this formula as well.
            let others = needs & !(1 << at);
            let usable = square.len() > 1 && others & !self.used == 0;
            usable.then_some((at, square, *sign, *needs))
        });
        for (i, a, sign, _) in known.clone() {
            for (j, b, _, needs) in known.clone() {
                if i != j && sign == Sign::Positive && *self.reduced(&times(a, b)?)? == *rest {
                    return Some(Some((times(&Poly::var(i), &Poly::var(j))?, needs)));
                }
            }
        }
        Some(None)
    }

    /// The generator whose square is this normal form.
    fn adjoined(&mut self, square: Poly) -> Option<Poly> {
        let known = self
            .generators
            .iter()
            .position(|g| matches!(g, Generator::Root { square: known, .. } if *known == square));
        let at = known.unwrap_or(self.generators.len());
        if at >= GENERATORS {
            return None;
        }
        if known.is_none() {
            let sign = self.sign_of(&square);
            let mut needs = u32::from(sign == Sign::Unknown) << at;
            for (older, generator) in self.generators.iter().enumerate() {
                if let Generator::Root { needs: more, .. } = generator
                    && square.has(older)
                {
                    needs |= more;
                }
            }
            self.generators.push(Generator::Root {
                square,
                sign,
                needs,
            });
        }
        if let Generator::Root { needs, .. } = &self.generators[at] {
            self.used |= needs;
        }
        Some(Poly::var(at))
    }
}

/// Half of every exponent, rounded down, and what is left of each.
fn halves(monomial: &[u64]) -> (Mono, Mono) {
    const EACH: u64 = 0x0101_0101_0101_0101;
    let half = monomial.iter().map(|w| (w & !EACH) >> 1);
    (half.collect(), monomial.iter().map(|w| w & EACH).collect())
}

/// A positive number as the square of one times different primes; the last of these may be a product of large ones.
fn taken_apart(number: i64) -> (i64, Vec<i64>) {
    let (mut left, mut outside, mut primes) = (number, 1, Vec::new());
    let mut q = 2;
    while q <= LARGEST_PRIME && q * q <= left {
        while left % (q * q) == 0 {
            left /= q * q;
            outside *= q;
        }
        if left % q == 0 {
            left /= q;
            primes.push(q);
        }
        q += 1;
    }
    let root = num_integer::sqrt(left);
    if root * root == left {
        outside *= root;
    } else {
        primes.push(left);
    }
    (outside, primes)
}
