//! Arithmetic of denominators: common multiples, products and powers in coprime factors, and cancelling against numerators.

use num_integer::Integer;
use num_traits::One;

use super::Stop;
use super::element::Den;
use super::field::{Field, Generator, Kind};
use super::mono::{
    exponent, mono_add, mono_div, mono_is_one, mono_max, mono_min, mono_of, mono_variables, powers,
};
use super::poly::Poly;

impl Den {
    /// Least common multiple, and what each side has to be multiplied by.
    pub(crate) fn common(&self, other: &Den, field: &Field) -> Result<(Den, Poly, Poly), Stop> {
        let int = self.int.lcm(&other.int);
        let mono = mono_max(&self.mono, &other.mono);
        let mut factors = self.factors.clone();
        for (f, k) in &other.factors {
            match factors.binary_search_by(|(g, _)| g.cmp(f)) {
                Ok(at) => factors[at].1 = factors[at].1.max(*k),
                Err(at) => factors.insert(at, (f.clone(), *k)),
            }
        }
        let lacking = |den: &Den| {
            let start = Poly::term(&mono_div(&mono, &den.mono), &int / &den.int);
            factors.iter().try_fold(start, |to, (f, k)| {
                let own = den.factors.iter().find(|(g, _)| g == f);
                let own = own.map_or(0, |(_, own)| *own);
                (own..*k).try_fold(to, |to, _| field.mul_poly(&to, f))
            })
        };
        let (to_self, to_other) = (lacking(self)?, lacking(other)?);
        Ok((Den { int, mono, factors }, to_self, to_other))
    }

    /// The product, and whether its sign was turned.
    pub(crate) fn times(&self, other: &Den, field: &Field) -> Result<(Den, bool), Stop> {
        if other.is_one() {
            return Ok((self.clone(), false));
        }
        let mut out = self.clone();
        out.int *= &other.int;
        out.mono = mono_add(&out.mono, &other.mono)?;
        for (f, k) in &other.factors {
            out.insert(f.clone(), *k)?;
        }
        let negative = out.settle(field)?;
        Ok((out, negative))
    }

    pub(crate) fn power(&self, k: u32, field: &Field) -> Result<(Den, bool), Stop> {
        if !self.int.is_one() && u64::from(k) * self.int.bits() > 20_000 {
            return Err(Stop::TooLarge("digits"));
        }
        let mut out = Den::of(self.int.pow(k));
        for (v, e) in powers(&self.mono) {
            let e = e.checked_mul(k).filter(|e| *e < 128);
            let power = mono_of(v, e.ok_or(Stop::TooLarge("degree"))?);
            out.mono = mono_add(&out.mono, &power)?;
        }
        let factors = self.factors.iter();
        out.factors = factors
            .map(|(f, e)| (f.clone(), e.saturating_mul(k)))
            .collect();
        let negative = out.settle(field)?;
        Ok((out, negative))
    }

    /// Multiplies by p or −p, taken apart into number, monomial and rest; true for −p.
    pub(crate) fn multiply(&mut self, p: &Poly, field: &Field) -> Result<bool, Stop> {
        let (content, mono, rest) = p.split();
        self.int *= num_traits::Signed::abs(&content);
        self.mono = mono_add(&self.mono, &mono)?;
        if !rest.is_constant() {
            self.insert(rest, 1)?;
        }
        Ok(self.settle(field)? ^ num_traits::Signed::is_negative(&content))
    }

    /// Takes a factor in, dividing out known factors first so that equal parts meet.
    fn insert(&mut self, mut factor: Poly, times: u32) -> Result<(), Stop> {
        if times > 127 {
            return Err(Stop::TooLarge("degree"));
        }
        for (f, k) in &mut self.factors {
            while !factor.is_constant()
                && let Some(q) = factor.try_div(f)
            {
                factor = q;
                *k += times;
            }
        }
        if factor.is_constant() {
            return Ok(());
        }
        let at = self.factors.partition_point(|(f, _)| *f < factor);
        self.factors.insert(at, (factor, times));
        Ok(())
    }

    /// Replaces gⁿ by its value for roots g, odd ones of either sign among them. Sines stay, since a sine may cancel against the numerator.
    fn settle(&mut self, field: &Field) -> Result<bool, Stop> {
        let mut negative = false;
        if mono_is_one(&self.mono) {
            return Ok(negative);
        }
        for v in mono_variables(&self.mono) {
            let Some(Generator {
                kind: Kind::Root | Kind::Power(..),
                relation: Some((degree, value)),
            }) = field.gens.get(v)
            else {
                continue;
            };
            let e = exponent(&self.mono, v);
            if e >= *degree {
                self.mono = mono_div(&self.mono, &mono_of(v, e - e % degree));
                for _ in 0..e / degree {
                    negative ^= self.multiply(value, field)?;
                }
            }
        }
        Ok(negative)
    }

    /// Removes from both what both have.
    pub(crate) fn strike_common(&mut self, other: &mut Den) {
        let g = self.int.gcd(&other.int);
        self.int /= &g;
        other.int /= &g;
        let m = mono_min(&self.mono, &other.mono);
        self.mono = mono_div(&self.mono, &m);
        other.mono = mono_div(&other.mono, &m);
        for (f, k) in &mut self.factors {
            if let Some((_, l)) = other.factors.iter_mut().find(|(g, _)| g == f) {
                let both = (*k).min(*l);
                *k -= both;
                *l -= both;
            }
        }
        self.factors.retain(|(_, k)| *k > 0);
        other.factors.retain(|(_, k)| *k > 0);
    }

    /// Divides the numerator and this denominator by what is plainly common to them.
    pub(crate) fn cancel_into(&mut self, mut num: Poly) -> Poly {
        if num.is_zero() {
            return num;
        }
        if !self.int.is_one() {
            let g = num.content().gcd(&self.int);
            if !g.is_one() {
                num = num.div_int(&g);
                self.int /= &g;
            }
        }
        if !mono_is_one(&self.mono) {
            let m = mono_min(&num.mono_content(), &self.mono);
            if !mono_is_one(&m) {
                num = num.div_mono(&m);
                self.mono = mono_div(&self.mono, &m);
            }
        }
        for (f, k) in &mut self.factors {
            while *k > 0
                && let Some(q) = num.try_div(f)
            {
                num = q;
                *k -= 1;
            }
        }
        self.factors.retain(|(_, k)| *k > 0);
        num
    }

    pub(crate) fn expand(&self, field: &Field) -> Result<Poly, Stop> {
        let mut total = field.reduce(Poly::term(&self.mono, self.int.clone()))?;
        for (f, k) in &self.factors {
            for _ in 0..*k {
                total = field.mul_poly(&total, f)?;
            }
        }
        Ok(total)
    }
}
