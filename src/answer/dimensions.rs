//! Dimensions of formulas of parameters and answers.

use num_traits::Signed;

use super::{Known, Refused, Work};
use crate::dimension::{self, Dimension};
use crate::expr::number::Int;
use crate::expr::{Expr, Node, Symbol};
use crate::formula::write_plain;
use crate::scene::{Ask, Scene};

fn dimension_of_parameter(scene: &Scene, name: &str) -> Option<Dimension> {
    let found = scene.parameter(name);
    found.map(|p| p.dimension.clone())
}

/// The dimension of a parameter, or of what a question asks for: a velocity that came out of plain numbers in their units is a
/// velocity all the same.
pub(super) fn kind_of(scene: &Scene, name: &str) -> Option<Dimension> {
    let Some(question) = scene.answering(name) else {
        return dimension_of_parameter(scene, name);
    };
    if let Ask::Value {
        formula,
        with,
        dimension: None,
        ..
    } = &question.ask
    {
        let of_others = || by_kind(scene, formula).filter(|_| with.is_empty());
        return of_others().or_else(|| dimension_of_parameter(scene, name));
    }
    if let Ask::Condition { parameter, .. } = &question.ask {
        return dimension_of_parameter(scene, parameter);
    }
    match scene.dimension_of(&question.ask) {
        known if known != Dimension::none() => Some(known),
        _ => dimension_of_parameter(scene, name),
    }
}

/// The dimension of a formula by what its names stand for; `None` where that is not known, or where a number in it may be a
/// quantity in its unit.
fn by_kind(scene: &Scene, e: &Expr) -> Option<Dimension> {
    let found = dimension::of(e, &|name| kind_of(scene, name));
    found.ok().flatten().filter(|_| !has_quantity(e))
}

/// The largest whole number that is taken to count, as the 2 in v²/2g.
const COUNTS: i64 = 12;

/// Whether a number stands beside the symbols, other than an exponent, that may be a quantity in its unit.
fn has_quantity(e: &Expr) -> bool {
    match e.node() {
        Node::Number(n) => {
            let small = |k: &Int| k.abs() <= Int::from(COUNTS);
            !(small(n.numer()) && small(n.denom()))
        }
        Node::Symbol(_) => false,
        Node::Sum(parts) | Node::Product(parts) => parts.iter().any(has_quantity),
        Node::Power(base, _) => has_quantity(base),
        Node::Call(_, argument) => has_quantity(argument),
    }
}

fn clashes(at: &str, reason: String) -> Refused {
    let hint = "both sides of a sum or relation have the same dimension";
    Refused::question(at, reason, hint)
}

/// Dimension of an expression in the scene's parameters.
pub fn dimension_of(scene: &Scene, e: &Expr, at: &str) -> Result<Dimension, Refused> {
    match dimension::of(e, &|name| dimension_of_parameter(scene, name)) {
        Ok(found) => Ok(found.unwrap_or_else(Dimension::none)),
        Err(_) if scene.has_plain_numbers => Ok(Dimension::none()),
        Err(clash) => Err(clashes(at, clash.message(&write_plain))),
    }
}

impl Work<'_> {
    pub(super) fn dimension_of(&self, e: &Expr) -> Result<Dimension, Refused> {
        dimension_of(self.scene, e, self.name)
    }

    /// Dimension of the value of a formula; as that is stated, where plain numbers hide what the value is made of.
    pub(super) fn dimension_of_value(
        &self,
        stated: &Expr,
        value: &Expr,
    ) -> Result<Dimension, Refused> {
        match self.scene.has_plain_numbers {
            true => Ok(by_kind(self.scene, stated).unwrap_or_else(Dimension::none)),
            false => self.dimension_of(value),
        }
    }

    /// Dimension of a formula of parameters and earlier answers, as it is stated: what is put in for a parameter may be a plain
    /// number in its unit.
    pub(super) fn stated_dimension(&self, e: &Expr) -> Result<Option<Dimension>, Refused> {
        let (scene, known) = (self.scene, self.known);
        if scene.has_plain_numbers {
            return Ok(by_kind(scene, e));
        }
        let parameter = |name: &str| dimension_of_parameter(scene, name);
        let of_answer = |answer: &Expr| dimension::of(answer, &parameter).ok().flatten();
        let of = |name: &str| match known.get(name) {
            Some(answer) => of_answer(answer),
            None => parameter(name),
        };
        let asked = |name: &str| match known.contains_key(name) {
            true => kind_of(scene, name).or_else(|| of(name)),
            false => of(name),
        };
        // Of an answer that is 0 nothing can be told: it stands for itself.
        let plain = known.iter().filter(|(_, v)| of_answer(v).is_none());
        let plain: Known = plain.map(|(s, v)| (s.clone(), v.clone())).collect();
        dimension::of(&e.substitute(&plain), &of).or_else(|clash| {
            let by_kind = dimension::of(e, &asked);
            by_kind.map_err(|_| clashes(self.name, clash.message(&write_plain)))
        })
    }

    /// What is put in for a parameter has its dimension, or is a number.
    pub(super) fn put_in_fits(&self, with: &[(Symbol, Expr)]) -> Result<(), Refused> {
        for (name, value) in with.iter().filter(|(_, v)| !v.is_constant()) {
            let own = self.stated_dimension(&Expr::symbol(name))?;
            let put = self.stated_dimension(value)?;
            if let (Some(own), Some(put)) = (own, put)
                && own != put
            {
                let reason = format!("{name} is {own}, and what is put in for it {put}");
                return Err(clashes(self.name, reason));
            }
        }
        Ok(())
    }
}
