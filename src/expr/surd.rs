//! Exact numbers with square roots: sums of fractions times √n for n that divide 210, so that what stands at 30°, 45° and 60°
//! has exact values. These roots are linearly independent over the fractions (Besicovitch 1940), so that equality is that of
//! the terms.

use std::cmp::Ordering;
use std::fmt;

use num_integer::Integer;
use num_traits::Signed;

use super::arithmetic::Number;
use super::{Function, Int, Rational, Scalar, number, ratio};

/// The primes below a root.
const PRIMES: [u32; 4] = [7, 5, 3, 2];

/// Σ qᵢ √nᵢ, by increasing n, without terms that are zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surd(Vec<(u32, Rational)>);

impl Surd {
    /// One term, q √n.
    fn term(n: u32, q: Rational) -> Surd {
        match q.is_zero() {
            true => Surd::default(),
            false => Surd(vec![(n, q)]),
        }
    }

    /// Its value, where there is no root in it.
    fn as_rational(&self) -> Option<Rational> {
        match self.0.as_slice() {
            [] => Some(Rational::zero()),
            [(1, q)] => Some(q.clone()),
            _ => None,
        }
    }

    fn add(&mut self, n: u32, q: Rational) {
        match self.0.binary_search_by_key(&n, |(own, _)| *own) {
            Ok(i) => {
                self.0[i].1 = number::sum(&self.0[i].1, &q, false);
                if self.0[i].1.is_zero() {
                    self.0.remove(i);
                }
            }
            Err(i) if !q.is_zero() => self.0.insert(i, (n, q)),
            Err(_) => {}
        }
    }

    fn scaled(&self, by: &Rational) -> Surd {
        let terms = self.0.iter().map(|(n, q)| (*n, number::product(q, by)));
        Surd(terms.filter(|(_, q)| !q.is_zero()).collect())
    }

    /// a, b and p of a + b √p, where neither a nor b holds √p; `None` where there is no root.
    fn parted(&self) -> Option<(Surd, Surd, u32)> {
        let holds = |p: &u32| self.0.iter().any(|(n, _)| n % p == 0);
        let p = PRIMES.into_iter().find(holds)?;
        let (with, without): (Vec<_>, Vec<_>) =
            self.0.iter().cloned().partition(|(n, _)| n % p == 0);
        let with = with.into_iter().map(|(n, q)| (n / p, q)).collect();
        Some((Surd(without), Surd(with), p))
    }

    /// a² − p b², in which √p does not occur.
    fn norm(a: &Surd, b: &Surd, p: u32) -> Surd {
        let square = b.times(b).scaled(&ratio(i64::from(p), 1));
        a.times(a).minus(&square)
    }

    fn sign(&self) -> Ordering {
        let Some((a, b, p)) = self.parted() else {
            let value = self
                .0
                .first()
                .map_or_else(Rational::zero, |(_, q)| q.clone());
            return value.cmp(&Rational::zero());
        };
        match (a.sign(), b.sign()) {
            (left, right) if left == right || right == Ordering::Equal => left,
            (Ordering::Equal, right) => right,
            // The larger of a² and p b² tells.
            (left, right) => match Surd::norm(&a, &b, p).sign() {
                Ordering::Greater => left,
                _ => right,
            },
        }
    }
}

impl From<Rational> for Surd {
    fn from(value: Rational) -> Surd {
        Surd::term(1, value)
    }
}

impl PartialOrd for Surd {
    fn partial_cmp(&self, other: &Surd) -> Option<Ordering> {
        Some(self.minus(other).sign())
    }
}

impl fmt::Display for Surd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_empty() {
            return write!(f, "0");
        }
        for (i, (n, q)) in self.0.iter().enumerate() {
            let sign = match (i, q.is_negative()) {
                (0, false) => "",
                (0, true) => "-",
                (_, false) => " + ",
                (_, true) => " - ",
            };
            write!(f, "{sign}{}", q.abs())?;
            if *n > 1 {
                write!(f, "*sqrt({n})")?;
            }
        }
        Ok(())
    }
}

impl Scalar for Surd {
    const STEPS: u64 = 8;

    fn from_rational(value: &Rational) -> Surd {
        Surd::from(value.clone())
    }
    // π fulfils no equation with these numbers as coefficients (Lindemann), so that any value shows whether two formulas in it
    // agree. This one is close, for signs, and has no root here.
    fn pi() -> Option<Surd> {
        Some(Surd::from(ratio(355, 113)))
    }
    fn plus(&self, other: &Surd) -> Surd {
        let mut total = self.clone();
        other.0.iter().for_each(|(n, q)| total.add(*n, q.clone()));
        total
    }
    fn times(&self, other: &Surd) -> Surd {
        let mut total = Surd::default();
        for (n, q) in &self.0 {
            for (m, r) in &other.0 {
                // √n √m = g √(n m/g²) with their greatest common divisor g.
                let g = n.gcd(m);
                let product = number::product(&number::product(q, r), &ratio(i64::from(g), 1));
                total.add(n / g * (m / g), product);
            }
        }
        total
    }
    fn recip(&self) -> Option<Surd> {
        let Some((a, b, p)) = self.parted() else {
            let value = self.as_rational()?;
            return (!value.is_zero()).then(|| Surd::from(value.recip()));
        };
        let mut conjugate = a.clone();
        for (n, q) in &b.0 {
            conjugate.add(n * p, -q.clone());
        }
        Some(conjugate.times(&Surd::norm(&a, &b, p).recip()?))
    }
    fn sqrt(&self) -> Option<Surd> {
        let value = self.as_rational()?;
        let below = value.denom().clone();
        let (mut rest, mut root) = (value.numer() * &below, 1);
        if value.is_zero() {
            return Some(Surd::default());
        }
        for p in PRIMES {
            let prime = Int::from(i64::from(p));
            let mut odd = false;
            let mut times = Int::from(1);
            while rest.is_multiple_of(&prime) {
                rest = &rest / &prime;
                if odd {
                    times = &times * &prime;
                }
                odd = !odd;
            }
            // Pairs go back as squares, of which the root is taken below.
            rest = &rest * &(&times * &times);
            root *= if odd { p } else { 1 };
        }
        let whole = rest.square_root()?;
        Some(Surd::term(root, Rational::new(whole, below)))
    }
    fn exact_root(n: u32) -> Option<Surd> {
        Surd::from(ratio(i64::from(n), 1)).sqrt()
    }
    fn pow(&self, exponent: &Surd) -> Option<Surd> {
        (self.0.is_empty() && exponent.sign() == Ordering::Greater).then(Surd::default)
    }
    fn below_zero(&self) -> bool {
        self.sign() == Ordering::Less
    }
    fn call(&self, function: Function) -> Option<Surd> {
        match function {
            Function::Abs if self.below_zero() => Some(self.negated()),
            Function::Abs => Some(self.clone()),
            _ => Some(Surd::from(self.as_rational()?.call(function)?)),
        }
    }
}

impl Number for Surd {
    fn zero() -> Surd {
        Surd::default()
    }
    fn one() -> Surd {
        Surd::from(Rational::one())
    }
    fn is_zero(&self) -> bool {
        self.0.is_empty()
    }
    fn minus(&self, other: &Surd) -> Surd {
        self.plus(&other.negated())
    }
    fn negated(&self) -> Surd {
        self.scaled(&ratio(-1, 1))
    }
    fn halved(&self) -> Surd {
        self.scaled(&ratio(1, 2))
    }
    fn size(&self) -> f64 {
        let terms = self.0.iter();
        let terms = terms.map(|(n, q)| number::to_f64(q) * f64::from(*n).sqrt());
        terms.sum::<f64>().abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn surd() -> impl Strategy<Value = Surd> {
        let term = (0usize..16, -9i64..10, 1i64..5);
        prop::collection::vec(term, 0..5).prop_map(|terms| {
            let mut out = Surd::default();
            for (bits, above, below) in terms {
                let chosen = (0..4).filter(|k| bits >> k & 1 == 1);
                out.add(chosen.map(|k| PRIMES[k]).product(), ratio(above, below));
            }
            out
        })
    }

    fn value(x: &Surd) -> f64 {
        x.0.iter()
            .map(|(n, q)| number::to_f64(q) * f64::from(*n).sqrt())
            .sum()
    }

    proptest! {
        #[test]
        fn they_form_an_ordered_field(a in surd(), b in surd(), c in surd()) {
            prop_assert_eq!(a.times(&b.plus(&c)), a.times(&b).plus(&a.times(&c)));
            prop_assert!(a.minus(&a).is_zero());
            if let Some(inverse) = a.recip() {
                prop_assert_eq!(a.times(&inverse), Surd::one());
            } else {
                prop_assert!(a.is_zero());
            }
            let gap = value(&a) - value(&b);
            if gap.abs() > 1e-9 {
                prop_assert_eq!(a.partial_cmp(&b), gap.partial_cmp(&0.0));
            }
        }

        #[test]
        fn a_root_is_that_of_its_square(n in 0i64..3000, d in 1i64..60) {
            let x = Surd::from(ratio(n, d));
            if let Some(root) = x.sqrt() {
                prop_assert_eq!(root.times(&root), x);
                prop_assert!(!root.below_zero());
            }
        }
    }

    #[test]
    fn roots_outside_are_refused() {
        let root = |n| Surd::from(ratio(n, 1)).sqrt();
        assert_eq!(root(72), Some(Surd::term(2, ratio(6, 1))));
        assert_eq!(root(11), None);
        assert_eq!(root(-4), None);
    }
}
