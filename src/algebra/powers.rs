//! Where an element vanishes, as polynomials in one symbol: what solving an equation for that symbol needs.

use super::Stop;
use super::element::Element;
use super::factor::factor;
use super::field::{Field, Kind};
use super::poly::Poly;

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
            if !p.has(g) || g == v || !self.hangs_on(g, v) {
                continue;
            }
            let (Kind::Root, Some((2, value))) = (&self.gens[g].kind, &self.gens[g].relation)
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
        if (0..self.gens.len()).any(|g| g != v && x.num.has(g) && self.hangs_on(g, v)) {
            return Ok(None);
        }
        let parts = x.num.by_power(v).into_iter();
        Ok(Some(parts.map(Element::from_poly).collect()))
    }

    /// Whether a generator's value depends on a variable.
    fn hangs_on(&self, g: usize, v: usize) -> bool {
        let inside = |p: &Poly| {
            let mut all = p.variables().into_iter();
            all.any(|w| w == v || w < g && self.hangs_on(w, v))
        };
        let relation = self.gens[g].relation.as_ref();
        let related = relation.is_some_and(|(_, value)| inside(value));
        let deep = |x: &Element| {
            inside(&x.num)
                || inside(&Poly::term(&x.den.mono, 1.into()))
                || x.den.factors.iter().any(|(f, _)| inside(f))
        };
        related
            || match &self.gens[g].kind {
                Kind::Abs(p) => inside(p),
                Kind::Call(_, x) => deep(x),
                Kind::Power(a, b) => deep(a) || deep(b),
                Kind::Cos(i) | Kind::Sin(i) => match &self.bases[*i].of {
                    super::field::AngleOf::Symbol(name) => {
                        matches!(&self.gens[v].kind, Kind::Symbol(s) if s == name)
                    }
                    super::field::AngleOf::Term(x) => deep(x),
                },
                Kind::Symbol(_) | Kind::Root => false,
            }
    }
}
