//! Polynomials with whole coefficients in a few generators, an exponent to each byte of a word.

/// Exponents of the generators, one byte each.
pub(super) type Monomial = u128;

/// Most generators.
pub(super) const GENERATORS: usize = 16;
/// Most terms of a polynomial.
const TERMS: usize = 4096;
/// Most terms of a polynomial that is looked for as a square root.
const LONGEST_ROOT: usize = 8;
/// The lowest bit of each exponent.
pub(super) const EACH: Monomial = Monomial::from_ne_bytes([1; 16]);
/// The highest bit of each exponent; set where one is too large.
pub(super) const OVERFLOW: Monomial = Monomial::from_ne_bytes([0x80; 16]);

/// Terms in falling order of their monomials, no coefficient 0.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Poly(pub Vec<(Monomial, i64)>);

impl Poly {
    pub fn constant(k: i64) -> Poly {
        Poly(if k == 0 { Vec::new() } else { vec![(0, k)] })
    }

    /// Sorts and gathers terms.
    pub fn gather(mut terms: Vec<(Monomial, i64)>) -> Option<Poly> {
        terms.sort_unstable_by_key(|term| std::cmp::Reverse(term.0));
        let mut out: Vec<(Monomial, i64)> = Vec::with_capacity(terms.len());
        for (monomial, k) in terms {
            match out.last_mut() {
                Some((last, sum)) if *last == monomial => *sum = sum.checked_add(k)?,
                _ => out.push((monomial, k)),
            }
        }
        out.retain(|(_, k)| *k != 0);
        (out.len() <= TERMS).then_some(Poly(out))
    }

    pub fn scaled(&self, monomial: Monomial, k: i64) -> Option<Poly> {
        let terms = self.0.iter().map(|(m, c)| {
            let sum = m.checked_add(monomial).filter(|s| s & OVERFLOW == 0)?;
            Some((sum, c.checked_mul(k)?))
        });
        terms.collect::<Option<Vec<_>>>().map(Poly)
    }

    pub fn times(&self, other: &Poly) -> Option<Poly> {
        let (short, long) = match self.0.len() <= other.0.len() {
            true => (self, other),
            false => (other, self),
        };
        match short.0.as_slice() {
            [] => return Some(Poly(Vec::new())),
            // Order is kept by a common factor.
            [(monomial, k)] => return long.scaled(*monomial, *k),
            _ => {}
        }
        if short.0.len() * long.0.len() > TERMS {
            return None;
        }
        let mut terms = Vec::with_capacity(short.0.len() * long.0.len());
        for (monomial, k) in &short.0 {
            terms.extend(long.scaled(*monomial, *k)?.0);
        }
        Poly::gather(terms)
    }

    pub fn plus(&self, other: &Poly) -> Option<Poly> {
        self.and(other, 1)
    }

    pub fn minus(&self, other: &Poly) -> Option<Poly> {
        self.and(other, -1)
    }

    /// The sum with a multiple of another one: both are in order already.
    fn and(&self, other: &Poly, factor: i64) -> Option<Poly> {
        let (mut left, mut right) = (self.0.as_slice(), other.0.as_slice());
        let mut out = Vec::with_capacity(left.len() + right.len());
        loop {
            match (left.first(), right.first()) {
                (Some(a), Some(b)) if a.0 == b.0 => {
                    let sum = a.1.checked_add(b.1.checked_mul(factor)?)?;
                    if sum != 0 {
                        out.push((a.0, sum));
                    }
                    (left, right) = (&left[1..], &right[1..]);
                }
                (Some(a), b) if b.is_none_or(|b| a.0 > b.0) => {
                    out.push(*a);
                    left = &left[1..];
                }
                (_, Some(b)) => {
                    out.push((b.0, b.1.checked_mul(factor)?));
                    right = &right[1..];
                }
                _ => break,
            }
        }
        (out.len() <= TERMS).then_some(Poly(out))
    }

    pub fn power(&self, k: u32) -> Option<Poly> {
        let mut out = Poly::constant(1);
        for _ in 0..k {
            out = out.times(self)?;
        }
        Some(out)
    }

    /// Splits off the largest number and monomial that divide all terms; the sign of the first term goes with them.
    pub fn split(&self) -> (i64, Monomial, Poly) {
        let content = self.0.iter().fold(0, |g, (_, k)| num_integer::gcd(g, *k));
        let sign = self.0.first().map_or(1, |(_, k)| k.signum());
        let content = content.max(1) * sign;
        let least = |a: Monomial, b: Monomial| {
            let (a, b) = (a.to_ne_bytes(), b.to_ne_bytes());
            Monomial::from_ne_bytes(std::array::from_fn(|i| a[i].min(b[i])))
        };
        let common = self.0.iter().map(|(m, _)| *m).reduce(least).unwrap_or(0);
        let rest = self.0.iter().map(|(m, k)| (m - common, k / content));
        (content, common, Poly(rest.collect()))
    }
    /// The polynomial whose square this is, by terms from the highest on.
    pub fn root(&self) -> Option<Poly> {
        let whole = |k: i64| {
            let root = num_integer::sqrt(k.max(0));
            (root * root == k).then_some(root)
        };
        let half = |(m, k): &(Monomial, i64)| {
            let even = (m & EACH == 0).then_some(m >> 1)?;
            Some((even, whole(*k)?))
        };
        let (first, _) = (half(self.0.first()?)?, half(self.0.last()?)?);
        let mut root = Poly(vec![first]);
        for _ in 0..LONGEST_ROOT {
            let rest = self.minus(&root.times(&root)?)?;
            let Some((monomial, k)) = rest.0.first() else {
                return Some(root);
            };
            let divides =
                (0..GENERATORS).all(|at| exponent(*monomial, at) >= exponent(first.0, at));
            let double = 2 * first.1;
            if !divides || k % double != 0 {
                return None;
            }
            root.0.push((monomial - first.0, k / double));
        }
        None
    }
}

/// The exponent of a generator.
pub(super) fn exponent(monomial: Monomial, at: usize) -> u8 {
    (monomial >> (8 * at)) as u8
}
