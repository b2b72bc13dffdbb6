//! Symbols that roots pin to a closed end of their domain: √b with b ≤ 0 has a value at b = 0 only.

use std::collections::BTreeMap;

use num_traits::{Signed, Zero};

use super::Search;
use super::proof::{self, Proof};
use crate::domain::{Coordinate, Domain, Domains, Sample, samples};
use crate::expr::{Expr, Rational, Symbol, only};

/// A symbol with the one value it has where both formulas have values.
pub(super) struct Pin {
    name: Symbol,
    value: Rational,
    /// What a root is taken of, so that it must not be negative.
    root_of: Expr,
}

/// The symbols pinned by what must not be negative.
pub(super) fn pins(needed: &[Expr], domains: &Domains) -> Vec<Pin> {
    let mut out: Vec<Pin> = Vec::new();
    for e in needed {
        let Some(name) = &only(e.symbols()) else {
            continue;
        };
        let tied = domains.is_component(name);
        let Some(domain) = domains.symbols.get(name).filter(|_| !tied) else {
            continue;
        };
        if let Some(value) = only_value(e, name, domain)
            && out.iter().all(|pin| pin.name != *name)
        {
            out.push(Pin {
                name: name.clone(),
                value,
                root_of: e.clone(),
            });
        }
    }
    out
}

/// The closed end of a symbol's domain at which k x + c is 0, where it is negative on the rest.
fn only_value(e: &Expr, name: &Symbol, domain: &Domain) -> Option<Rational> {
    let slope = e.derivative(name).as_number().cloned()?;
    let constant = e.put(name, &Expr::zero()).as_number().cloned()?;
    if slope.is_zero() {
        return None;
    }
    let root = -constant / &slope;
    let end = match slope.is_positive() {
        true => domain.high.as_ref()?,
        false => domain.low.as_ref()?,
    };
    (!end.of_pi && !end.open && end.value == root).then_some(root)
}

impl Search<'_> {
    /// Points of the domain with pinned symbols where they have to be.
    pub(super) fn points_with(&self, pins: &[Pin], count: usize) -> Vec<Sample> {
        let mut points = samples(self.roles, self.domains, count);
        for point in &mut points {
            for pin in pins {
                let value = Coordinate::Number(pin.value.clone());
                point.coordinates.insert(pin.name.clone(), value);
            }
        }
        points.retain(|at| self.domains.admits(at));
        points
    }

    /// A proof with pinned symbols replaced by their values.
    pub(super) fn proof_with(&self, pins: &[Pin]) -> Option<Proof> {
        let values = pins.iter();
        let values = values.map(|pin| (pin.name.clone(), Expr::from(pin.value.clone())));
        let values: BTreeMap<Symbol, Expr> = values.collect();
        let (a, b) = (self.a.substitute(&values), self.b.substitute(&values));
        let roots = pins.iter().map(|pin| pin.root_of.clone());
        proof::compare(&a, &b, self.domains).with_roots(roots)
    }
}
