//! Where elements vanish: numerators split into parts without common factors, and signs along one symbol.
//!
//! In one symbol everything is decided: the zeros of all parts are isolated (Vincent, Collins and Akritas) between fractions
//! or found as fractions, and between two of them every sign is that at any point.

use std::cmp::Ordering;

use num_traits::{One, Signed, Zero};

use super::Stop;
use super::element::Element;
use super::factor::Parts;
use super::factor::factor;
use super::field::{Field, Kind};
use super::gcd::gcd;
use super::poly::Poly;
use crate::expr::{Int, Rational, Symbol, ratio};

/// Largest degree of a part whose zeros are isolated.
const MOST_DEGREE: u32 = 40;
/// Most halvings for all zeros together.
const MOST_HALVINGS: usize = 4_000;

/// A part of a symbol's interval: one number at which something vanishes, or all numbers between two of them.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Fractions around the number, equal where it is one; for an interval twice a fraction inside.
    pub around: [Rational; 2],
    /// Whether it is a single number.
    pub single: bool,
    /// The sign of each element there; `None` where it has no value.
    pub signs: Vec<Option<Ordering>>,
}

impl Field {
    /// The parts of the numerators of two elements without repetition: those of the first alone, of both, of the second alone.
    pub fn split_zeros(&self, a: &Element, b: &Element) -> Result<[Vec<Element>; 3], Stop> {
        self.fuel.refill();
        let mut left = self.parts(&a.num);
        let mut right = self.parts(&b.num);
        let mut common = Vec::new();
        let mut i = 0;
        while i < left.len() {
            let mut found = None;
            for (j, other) in right.iter().enumerate() {
                let g = gcd(&left[i], other, &self.fuel)?;
                if !g.is_constant() {
                    found = Some((j, g));
                    break;
                }
            }
            let Some((j, g)) = found else {
                i += 1;
                continue;
            };
            for (list, at) in [(&mut left, i), (&mut right, j)] {
                let mut rest = list.swap_remove(at);
                while let Some(q) = rest.try_div(&g) {
                    rest = q;
                }
                if !rest.is_constant() {
                    list.push(rest);
                }
            }
            common.push(g);
        }
        let elements = |list: Vec<Poly>| list.into_iter().map(Element::from_poly).collect();
        Ok([left, common, right].map(elements))
    }

    /// The different parts of the numerator: where it vanishes, one of them does.
    pub fn zeros(&self, x: &Element) -> Vec<Element> {
        self.fuel.refill();
        let parts = self.parts(&x.num);
        parts.into_iter().map(Element::from_poly).collect()
    }

    /// The denominator as an element.
    pub fn below(&self, x: &Element) -> Result<Element, Stop> {
        Ok(Element::from_poly(x.den.expand(self)?))
    }

    /// The different parts of a polynomial.
    fn parts(&self, p: &Poly) -> Vec<Poly> {
        let parts = factor(p, &self.fuel).factors;
        parts.into_iter().map(|(f, _)| f).collect()
    }

    /// An element without its last square root: its product with the one of the other sign, which vanishes wherever the
    /// element does. `None` where no such root occurs.
    pub fn without_root(&self, x: &Element) -> Result<Option<Element>, Stop> {
        let last = x.num.variables().into_iter().rev().find(|v| {
            matches!(self.gens[*v].kind, Kind::Root | Kind::Abs(_))
                && matches!(self.gens[*v].relation, Some((2, _)))
        });
        let Some((root, (_, value))) =
            last.and_then(|root| Some((root, self.gens[root].relation.clone()?)))
        else {
            return Ok(None);
        };
        let parts = x.num.by_power(root);
        let [a, b] = parts.as_slice() else {
            return Ok(None);
        };
        Ok(Some(Element::from_poly(self.norm(a, b, &value)?)))
    }

    /// The signs of elements in one symbol all along its interval, in ascending order. `None` where another symbol, an angle,
    /// a root or a function takes part, or a limit is met.
    pub fn signs_along(&self, name: &Symbol, elements: &[Element]) -> Option<Vec<Cell>> {
        self.fuel.refill();
        let v = *self.names.get(name)?;
        let only = |p: &Poly| p.variables().iter().all(|w| *w == v) && p.degree(v) <= MOST_DEGREE;
        // Each element as a sign and parts with whole powers.
        let mut base: Vec<Poly> = Vec::new();
        let mut all = Vec::new();
        for x in elements {
            if x.num.is_zero() {
                all.push((x, Vec::new()));
                continue;
            }
            let parts = self.whole_parts(x);
            if !parts.iter().all(|(p, _)| only(p)) {
                return None;
            }
            base.extend(parts.iter().map(|(p, _)| p.clone()));
            all.push((x, parts));
        }
        let range = self.interval(name);
        let zeros = zeros_of(&self.product_of(&base)?, v, (&range.low, &range.high))?;
        let sign_at = |at: &Rational, [low, high]: &[Rational; 2], single: bool| {
            let signs = all.iter().map(|(x, parts)| {
                if x.num.is_zero() {
                    return Some(Ordering::Equal);
                }
                let mut sign = x.num_content_sign();
                let mut zero = false;
                for (p, k) in parts {
                    let p = dense(p, v);
                    let here = single && vanishes_between(&p, low, high);
                    match (here, *k > 0) {
                        (true, false) => return None,
                        (true, true) => zero = true,
                        (false, _) if value(&p, at).is_negative() && k % 2 != 0 => {
                            sign = sign.reverse();
                        }
                        _ => {}
                    }
                }
                Some(if zero { Ordering::Equal } else { sign })
            });
            signs.collect::<Vec<_>>()
        };
        let mut cells = Vec::new();
        let mut before = range.low.as_ref().map(|(low, _)| low.clone());
        let gap = |from: Option<&Rational>, to: Option<&Rational>| {
            let at = match (from, to) {
                // Nothing lies beside a zero that is an end; an end that only bounds a zero lies beside it.
                (Some(a), Some(b)) if a == b && zeros.iter().any(|z| z[0] == *a && z[1] == *a) => {
                    return None;
                }
                (Some(a), Some(b)) => (a + b) * ratio(1, 2),
                (Some(a), None) => a + Rational::one(),
                (None, Some(b)) => b - Rational::one(),
                (None, None) => Rational::zero(),
            };
            let around = [at.clone(), at.clone()];
            Some(Cell {
                signs: sign_at(&at, &around, false),
                around,
                single: false,
            })
        };
        let end = range.high.as_ref().map(|(high, _)| high);
        // A domain of one number.
        if let (Some((low, false)), Some((high, false))) = (&range.low, &range.high)
            && low == high
        {
            let around = [low.clone(), low.clone()];
            let signs = sign_at(low, &around, true);
            return Some(vec![Cell {
                around,
                single: true,
                signs,
            }]);
        }
        for zero in &zeros {
            cells.extend(gap(before.as_ref(), Some(&zero[0])));
            cells.push(Cell {
                around: zero.clone(),
                single: true,
                signs: sign_at(&zero[0], zero, true),
            });
            before = Some(zero[1].clone());
        }
        cells.extend(gap(before.as_ref(), end));
        Some(cells)
    }

    /// Factors above and, with negative powers, below the line.
    fn whole_parts(&self, x: &Element) -> Vec<(Poly, i64)> {
        let above = factor(&x.num, &self.fuel).factors.into_iter();
        let below = Parts::below(&x.den).factors.into_iter();
        let above = above.map(|(f, k)| (f, i64::from(k)));
        let below = below.map(|(f, k)| (f, -i64::from(k)));
        above.chain(below).collect()
    }

    /// The product of different squarefree parts.
    fn product_of(&self, base: &[Poly]) -> Option<Poly> {
        let mut product = Poly::one();
        for p in base {
            let g = gcd(&product, p, &self.fuel).ok()?;
            product = product.mul(&p.try_div(&g)?).ok()?;
        }
        // A part that was not split may hold a square.
        let v = *product.variables().first().unwrap_or(&0);
        let g = gcd(&product, &product.derivative(v), &self.fuel).ok()?;
        product.try_div(&g)
    }
}

impl Element {
    /// The sign of the number in front of the numerator's parts.
    fn num_content_sign(&self) -> Ordering {
        match self.num.leading_is_negative() {
            true => Ordering::Less,
            false => Ordering::Greater,
        }
    }
}

/// Coefficients by ascending powers.
fn dense(p: &Poly, v: usize) -> Vec<Int> {
    let parts = p.by_power(v);
    let number = |p: &Poly| p.as_constant().cloned().unwrap_or_else(Int::zero);
    parts.iter().map(number).collect()
}

/// The value times a positive number: of the sign of the polynomial.
fn value(p: &[Int], at: &Rational) -> Int {
    let (n, d) = (at.numer(), at.denom());
    let mut power = Int::one();
    let mut total = Int::zero();
    for k in p.iter().rev() {
        total = total * n + k * &power;
        power *= d;
    }
    total
}

/// Whether a polynomial has a zero in an isolating interval, whose ends are no zeros unless they are equal.
fn vanishes_between(p: &[Int], low: &Rational, high: &Rational) -> bool {
    let (a, b) = (value(p, low), value(p, high));
    a.is_zero() || a.is_negative() != b.is_negative()
}

type EndOf<'a> = &'a Option<(Rational, bool)>;

/// The zeros of a squarefree polynomial on an interval in ascending order, each between two fractions that hold no other
/// and are no zeros themselves, or as a fraction.
fn zeros_of(p: &Poly, v: usize, (low, high): (EndOf, EndOf)) -> Option<Vec<[Rational; 2]>> {
    let mut p = dense(p, v);
    if p.len() > MOST_DEGREE as usize * 2 {
        return None;
    }
    let mut exact: Vec<Rational> = Vec::new();
    let inside = |x: &Rational| {
        let keeps = |end: EndOf, side: Ordering| {
            end.as_ref().is_none_or(|(end, open)| match x.cmp(end) {
                Ordering::Equal => !open,
                order => order == side,
            })
        };
        keeps(low, Ordering::Greater) && keeps(high, Ordering::Less)
    };
    let mut left = MOST_HALVINGS;
    // Zeros that are fractions are taken out as they are met, the ends first.
    for (end, _) in [low, high].into_iter().flatten() {
        if p.len() > 1 && value(&p, end).is_zero() {
            p = divided(&p, end);
            exact.push(end.clone());
        }
    }
    if p.len() <= 1 {
        return Some(sorted(exact, Vec::new(), inside));
    }
    let bound = bound(&p);
    let (mut from, mut to) = (-bound.clone(), bound);
    from = low
        .as_ref()
        .map_or(from.clone(), |(l, _)| l.clone().max(from));
    to = high.as_ref().map_or(to.clone(), |(h, _)| h.clone().min(to));
    if from >= to {
        return Some(sorted(exact, Vec::new(), inside));
    }
    let half = |a: &Rational, b: &Rational| (a + b) * ratio(1, 2);
    let mut open = vec![[from, to]];
    let mut single: Vec<[Rational; 2]> = Vec::new();
    while let Some([a, b]) = open.pop() {
        left = left.checked_sub(1)?;
        match changes(&p, &a, &b) {
            0 => {}
            1 => single.push([a, b]),
            _ => {
                let middle = half(&a, &b);
                if value(&p, &middle).is_zero() {
                    p = divided(&p, &middle);
                    exact.push(middle.clone());
                }
                open.extend([[a, middle.clone()], [middle, b]]);
            }
        }
    }
    // Narrow, so that no two touch and ends are no zeros of others.
    let width = ratio(1, 1 << 40);
    let mut found: Vec<[Rational; 2]> = Vec::new();
    'next: for mut pair in single {
        let rising = value(&p, &pair[0]).is_negative();
        while &pair[1] - &pair[0] > width || exact.iter().any(|x| pair[0] <= *x && *x <= pair[1]) {
            left = left.checked_sub(1)?;
            let middle = half(&pair[0], &pair[1]);
            let here = value(&p, &middle);
            if here.is_zero() {
                p = divided(&p, &middle);
                exact.push(middle);
                continue 'next;
            }
            let at = usize::from(here.is_negative() != rising);
            pair[at] = middle;
        }
        found.push(pair);
    }
    Some(sorted(exact, found, inside))
}

fn sorted(
    exact: Vec<Rational>,
    mut found: Vec<[Rational; 2]>,
    inside: impl Fn(&Rational) -> bool,
) -> Vec<[Rational; 2]> {
    found.extend(exact.into_iter().filter(inside).map(|x| [x.clone(), x]));
    found.sort();
    found
}

/// A power of two above the size of every zero: twice the largest k-th root of a coefficient, k places below the leading one,
/// over that (Fujiwara 1916), from the lengths of the coefficients alone.
fn bound(p: &[Int]) -> Rational {
    let bits = |k: &Int| k.bits() as i64;
    let (last, rest) = p.split_last().expect("a polynomial that is not constant");
    let powers = rest.iter().rev().zip(1..).filter(|(k, _)| !k.is_zero());
    let power = |(k, place): (&Int, i64)| {
        num_integer::Integer::div_ceil(&(bits(k) - bits(last) + 1), &place)
    };
    let largest = powers.map(power).max().unwrap_or(0);
    Rational::from(Int::from(2).pow(largest.max(0) as u32 + 1))
}

/// The polynomial without the zero at a fraction.
fn divided(p: &[Int], at: &Rational) -> Vec<Int> {
    // Horner's rule with the denominators taken along: (d x − n) divides p.
    let (n, d) = (at.numer(), at.denom());
    let mut out = vec![Int::zero(); p.len() - 1];
    let mut carried = Int::zero();
    for k in (0..out.len()).rev() {
        carried = (&carried * n + &p[k + 1]) / d;
        out[k] = carried.clone();
    }
    out
}

/// Changes of sign among the coefficients of (1 + u)ⁿ p((a + b u)/(1 + u)): 0 or 1 is the number of zeros between a and b.
fn changes(p: &[Int], a: &Rational, b: &Rational) -> usize {
    let n = p.len() - 1;
    let d = num_integer::Integer::lcm(a.denom(), b.denom());
    let whole = |x: &Rational| x.numer() * &(&d / x.denom());
    let (a, b) = (whole(a), whole(b));
    let times = |q: &[Int], c: &Int, e: &Int| {
        let mut out = vec![Int::zero(); q.len() + 1];
        for (i, k) in q.iter().enumerate() {
            out[i] += k * c;
            out[i + 1] += k * e;
        }
        out
    };
    // Horner's rule with above = a + b u and below = d + d u.
    let mut total = vec![p[n].clone()];
    let mut below = vec![Int::one()];
    for k in (0..n).rev() {
        total = times(&total, &a, &b);
        below = times(&below, &d, &d);
        for (t, q) in total.iter_mut().zip(&below) {
            *t += q * &p[k];
        }
    }
    let signs = total.iter().filter(|k| !k.is_zero());
    let signs: Vec<bool> = signs.map(Signed::is_negative).collect();
    signs.windows(2).filter(|w| w[0] != w[1]).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::{Domain, Domains};
    use crate::expr::Expr;

    fn cells(domain: Domain, elements: &[Expr]) -> Vec<Cell> {
        let mut domains = Domains::default();
        domains.symbols.insert("x".into(), domain);
        let mut field = Field::new(&domains);
        field.prepare(elements);
        let elements: Vec<Element> = elements
            .iter()
            .map(|e| field.element(e).expect("small"))
            .collect();
        field.signs_along(&"x".into(), &elements).expect("decided")
    }

    #[test]
    fn thirty_whole_numbers_are_thirty_zeros() {
        let x = Expr::symbol("x");
        let product = Expr::product((0..30).map(|k| &x - &Expr::from(k)).collect::<Vec<_>>());
        let cells = cells(Domain::real(), &[product]);
        let single = cells.iter().filter(|cell| cell.single);
        let whole: Vec<_> = single.map(|cell| cell.around[0].clone()).collect();
        assert_eq!(whole, (0..30).map(|k| ratio(k, 1)).collect::<Vec<_>>());
    }

    #[test]
    fn signs_alternate_between_simple_zeros() {
        use Ordering::{Equal, Greater, Less};
        let x = Expr::symbol("x");
        let square = x.powi(2) - Expr::from(2);
        let found = cells(Domain::real(), std::slice::from_ref(&square));
        let signs: Vec<_> = found.iter().map(|c| c.signs[0]).collect();
        assert_eq!(
            signs,
            [Greater, Equal, Less, Equal, Greater].map(Some),
            "{found:?}"
        );
        let found = cells(Domain::positive(), &[square.powi(-1)]);
        let signs: Vec<_> = found.iter().map(|c| c.signs[0]).collect();
        assert_eq!(signs, [Some(Less), None, Some(Greater)]);
    }

    #[test]
    fn close_zeros_and_closed_ends_are_single_cells() {
        let x = Expr::symbol("x");
        let near = (&x - &Expr::ratio(1, 3)) * (&x - &Expr::ratio(1_000_001, 3_000_000));
        let ends = &x * &(Expr::one() - &x);
        let found = cells(
            Domain::between(ratio(0, 1), ratio(1, 1)),
            &[near.clone(), ends.clone(), x.powi(5) - &x - Expr::one()],
        );
        assert_eq!(found.iter().filter(|c| c.single).count(), 4, "{found:?}");
        assert!(found[0].single && found.last().is_some_and(|c| c.single));
    }
}
