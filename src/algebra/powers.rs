//! Where an element vanishes, as polynomials in one symbol: what solving an equation for that symbol needs.

use std::collections::BTreeSet;

use super::Stop;
use super::element::Element;
use super::factor::factor;
use super::field::{AngleOf, Field, Kind};
use super::mono::mono_variables;
use super::poly::Poly;
use crate::expr::Symbol;

/// The numerator of an element as a product of polynomials in one symbol.
#[derive(Clone, Debug)]
pub struct Powers {
    /// Coefficients by ascending powers, of every factor in which the symbol occurs.
    pub factors: Vec<Vec<Element>>,
    /// Whether the symbol itself is a factor.
    pub has_zero: bool,
    /// Whether roots that contain the symbol were squared away, which may add solutions.
    pub squared: bool,
}

impl Field {
    /// The numerator in powers of a symbol; `None` where the symbol stands inside a function.
    pub fn powers(&mut self, x: &Element, symbol: &str) -> Result<Option<Powers>, Stop> {
        self.fuel.refill();
        let v = self.symbol(&symbol.into());
        let mut p = x.num.clone();
        let mut squared = false;
        for g in (0..self.gens.len()).rev() {
            if !p.has(g) || g == v || !self.hangs_on(g, symbol) {
                continue;
            }
            // A root, or the other component of a unit vector.
            let (Kind::Root | Kind::Symbol(_), Some((2, value))) =
                (&self.gens[g].kind, &self.gens[g].relation)
            else {
                return Ok(None);
            };
            let parts = p.by_power(g);
            let high = parts.get(1).cloned().unwrap_or_else(Poly::zero);
            p = self.norm(&parts[0], &high, value)?;
            squared = true;
        }
        let parts = factor(&p, &self.fuel);
        let factors = parts
            .factors
            .iter()
            .filter(|(f, _)| f.has(v) && f.len() > 1);
        Ok(Some(Powers {
            factors: factors
                .map(|(f, _)| f.by_power(v).into_iter().map(Element::from_poly).collect())
                .collect(),
            has_zero: parts.factors.iter().any(|(f, _)| *f == Poly::var(v)),
            squared,
        }))
    }

    /// Coefficients of the numerator by ascending powers of a symbol; `None` where it stands inside a root or function.
    pub fn numerator(&mut self, x: &Element, symbol: &str) -> Result<Option<Vec<Element>>, Stop> {
        let v = self.symbol(&symbol.into());
        let mut others = x.num.variables().into_iter().filter(|g| *g != v);
        if others.any(|g| self.hangs_on(g, symbol)) {
            return Ok(None);
        }
        let parts = x.num.by_power(v).into_iter();
        Ok(Some(parts.map(Element::from_poly).collect()))
    }

    /// Whether a generator's value depends on a symbol.
    fn hangs_on(&self, g: usize, symbol: &str) -> bool {
        let inside = self.symbols(&Element::from_poly(Poly::var(g)));
        inside.contains(symbol)
    }

    /// The symbols on which an element's value depends.
    pub fn symbols(&self, x: &Element) -> BTreeSet<Symbol> {
        let of_element = |x: &Element| {
            let mut all = x.num.variables();
            all.extend(mono_variables(&x.den.mono));
            all.extend(x.den.factors.iter().flat_map(|(f, _)| f.variables()));
            all
        };
        let (mut out, mut seen) = (BTreeSet::new(), BTreeSet::new());
        let mut left = of_element(x);
        while let Some(v) = left.pop() {
            if !seen.insert(v) {
                continue;
            }
            let value = self.gens[v].relation.as_ref();
            left.extend(value.into_iter().flat_map(|(_, value)| value.variables()));
            match &self.gens[v].kind {
                Kind::Symbol(name) => _ = out.insert(name.clone()),
                Kind::Abs(p) => left.extend(p.variables()),
                Kind::Call(_, x) => left.extend(of_element(x)),
                Kind::Power(a, b) => left.extend([a, b].into_iter().flat_map(of_element)),
                Kind::Cos(i) | Kind::Sin(i) => match &self.bases[*i].of {
                    AngleOf::Symbol(name) => _ = out.insert(name.clone()),
                    AngleOf::Term(x) => left.extend(of_element(x)),
                },
                Kind::Root => {}
            }
        }
        out
    }
}
