//! Square roots in a proof: taken apart into roots of positive numbers, of positive generators, and of what remains.
//!
//! Every root here is real and not negative. √(A/D) is √(A D)/D only where D is positive, √(a b) is √a √b only where one of
//! the two is positive: where that is not known, no root is taken.

use super::exact::{Exact, Generator, Quotient};
use super::poly::{EACH, GENERATORS, Monomial, OVERFLOW, Poly, exponent};
use super::value::Sign;

/// Numbers are taken apart into primes up to here.
const LARGEST_PRIME: i64 = 100;

impl Exact<'_> {
    /// The root of a quotient.
    pub(super) fn root(&mut self, a: &Quotient) -> Option<Quotient> {
        let positive = |e: &Self, f: &Poly| e.sign_of(f) == Sign::Positive;
        if !self.is_positive(a.monomial) || !a.factors.iter().all(|(f, _)| positive(self, f)) {
            return None;
        }
        // With odd exponents made even, what stands below comes out.
        let odd = a.monomial & EACH;
        let mut inside = a.above.scaled(odd, a.number)?;
        let mut factors = Vec::with_capacity(a.factors.len());
        for (factor, power) in &a.factors {
            if power % 2 == 1 {
                inside = inside.times(factor)?;
            }
            factors.push((factor.clone(), power.div_ceil(2)));
        }
        // Powers of roots come out before they are replaced by what they are roots of, squares of sines after.
        let (first, powers, rest) = inside.split();
        let rest = self.reduced(&rest)?.into_owned();
        let (second, more, rest) = self.lighter(rest)?.split();
        let content = first.checked_mul(second)?;
        let common = powers
            .checked_add(more)
            .filter(|common| common & OVERFLOW == 0)?;
        if !self.is_positive(common) {
            return None;
        }
        let (outside, primes) = taken_apart(content.checked_abs()?);
        let mut above = Poly(vec![((common - (common & EACH)) >> 1, outside)]);
        for prime in primes {
            above = above.times(&self.adjoined(Poly::constant(prime))?)?;
        }
        for at in (0..GENERATORS).filter(|at| exponent(common, *at) % 2 == 1) {
            above = above.times(&self.adjoined(Poly(vec![(1 << (8 * at), 1)]))?)?;
        }
        let rest = rest.scaled(0, content.signum())?;
        if rest != Poly::constant(1) {
            above = above.times(&self.root_of_rest(&rest)?)?;
        }
        Some(Quotient {
            above,
            number: a.number,
            monomial: (a.monomial + odd) >> 1,
            factors,
        })
    }

    /// The root of a polynomial without a common factor.
    fn root_of_rest(&mut self, rest: &Poly) -> Option<Poly> {
        let rest = self.reduced(rest)?.into_owned();
        if rest.0.len() < 2 {
            return None;
        }
        let square = rest.root();
        for root in [square.clone(), square.and_then(|r| r.scaled(0, -1))] {
            if let Some(root) = root.filter(|r| self.sign_of(r) > Sign::Unknown) {
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
            let usable = square.0.len() > 1 && others & !self.used == 0;
            usable.then_some((at, square, *sign, *needs))
        });
        for (i, a, sign, _) in known.clone() {
            for (j, b, _, needs) in known.clone() {
                if i != j && sign == Sign::Positive && *self.reduced(&a.times(b)?)? == *rest {
                    let product: Monomial = (1 << (8 * i)) + (1 << (8 * j));
                    return Some(Some((Poly(vec![(product, 1)]), needs)));
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
                    && square.0.iter().any(|(m, _)| exponent(*m, older) > 0)
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
        Some(Poly(vec![(1 << (8 * at), 1)]))
    }
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

#[cfg(test)]
mod tests {
    use super::super::exact::Read;
    use super::super::prime::{PLAIN, random};
    use super::super::value::Place;
    use super::*;
    use crate::formula::stream::{Angle, Builder, Names, Ratio, Seen, Table, stream};

    /// The values of a formula of `a` and `b` at a point; not a number where it has none.
    struct At([f64; 2]);

    impl Builder for At {
        type Value = f64;
        fn number(&mut self, digits: u64, tens: u32) -> Option<f64> {
            Some(digits as f64 / 10f64.powi(tens as i32))
        }
        fn symbol(&mut self, index: usize, _: &[u8]) -> Option<f64> {
            Some(self.0[index])
        }
        fn pi(&mut self) -> Option<f64> {
            None
        }
        fn negative(&mut self, a: f64) -> Option<f64> {
            Some(-a)
        }
        fn sum(&mut self, a: f64, b: f64) -> Option<f64> {
            Some(a + b)
        }
        fn product(&mut self, a: f64, b: f64) -> Option<f64> {
            Some(a * b)
        }
        fn quotient(&mut self, a: f64, b: f64) -> Option<f64> {
            Some(if b.abs() < 1e-9 { f64::NAN } else { a / b })
        }
        fn power(&mut self, a: f64, halves: i32) -> Option<f64> {
            // Rounding may put a zero below it.
            let a = if a.abs() < 1e-9 { 0.0 } else { a };
            let base = if halves % 2 == 0 { a * a } else { a };
            let root = base.sqrt();
            let plain = if halves % 2 == 0 {
                a.powi(halves / 2)
            } else {
                root.powi(halves)
            };
            Some(if plain.is_finite() { plain } else { f64::NAN })
        }
        fn turn(&mut self, _: Ratio, _: &Angle, _: &[&[u8]]) -> Option<f64> {
            None
        }
    }

    /// A small formula with roots.
    fn grown(draw: &mut impl FnMut(u64) -> u64, depth: u32) -> String {
        if depth == 0 {
            return ["a", "b", "2", "a", "b", "8"][draw(6) as usize].to_string();
        }
        let one = grown(draw, depth - 1);
        match draw(9) {
            0 | 1 => format!("({one})*({})", grown(draw, depth - 1)),
            2 => format!("({one})/({})", grown(draw, depth - 1)),
            3 => format!("(({one})+({}))", grown(draw, depth - 1)),
            4 => format!("(({one})-({}))", grown(draw, depth - 1)),
            5 | 6 => format!("sqrt({one})"),
            7 => format!("({one})^2"),
            _ => format!("({one})^(3/2)"),
        }
    }

    /// Proves what can be proved of some pairs and looks at the values at points; how many were proved.
    fn compared(places: &[Option<Place>], points: &[[f64; 2]], count: u64) -> usize {
        let mut round = 0;
        let mut draw = |below: u64| {
            round += 1;
            random::<PLAIN>(17, round) % below
        };
        let texts: Vec<String> = (0..count)
            .map(|k| grown(&mut draw, 1 + k as u32 % 3))
            .collect();
        let names = Names::declared(["a", "b"].map(|name| (name, None)), true).expect("names");
        let values = |text: &str| -> Option<Vec<f64>> {
            let at = |point: &[f64; 2]| {
                stream(
                    text,
                    Table::Known(&names),
                    &mut At(*point),
                    &mut Seen::default(),
                )
            };
            points.iter().map(at).collect()
        };
        let read = |exact: &mut Exact, text: &str| -> Option<Read> {
            exact.read(|e| stream(text, Table::Known(&names), e, &mut Seen::default()))
        };
        let mut proofs = 0;
        for (i, a) in texts.iter().enumerate() {
            let mut known = Exact::new(places, 1, Vec::new());
            // Divisors that are 0 everywhere are found before a proof is asked for.
            let sound = values(a).filter(|v| v.iter().any(|v| !v.is_nan()));
            let Some((left, mine)) = read(&mut known, a).zip(sound) else {
                continue;
            };
            for b in texts[..i].iter().filter(|b| *b != a) {
                let mut exact = known.clone();
                let right = read(&mut exact, b);
                if !right.is_some_and(|right| exact.proves(&left, &right)) {
                    continue;
                }
                proofs += 1;
                for (x, y) in mine.iter().zip(values(b).expect("it was read")) {
                    let close = (x - y).abs() <= 1e-6 * (1.0 + x.abs());
                    assert!(
                        close || x.is_nan() && y.is_nan(),
                        "{a} and {b}: {x} and {y}"
                    );
                }
            }
        }
        proofs
    }

    #[test]
    fn what_is_proved_has_the_same_values_at_the_same_points() {
        let positive = [
            [0.7, 1.9],
            [2.3, 0.4],
            [1.25, 1.5],
            [3.0, 2.9],
            [1.0, 1.0],
            [2.0, 1.0],
        ];
        assert!(compared(&[], &positive, 300) > 100);
        let real = || {
            Some(Place {
                sign: Sign::Unknown,
                range: [-2.0, 2.0],
                unit: None,
            })
        };
        let anywhere = [
            [0.7, 1.9],
            [-2.3, 0.4],
            [1.25, -1.5],
            [-3.0, -2.9],
            [-1.0, 1.0],
            [0.0, 1.0],
        ];
        assert!(compared(&[real(), real()], &anywhere, 300) > 20);
    }
}
