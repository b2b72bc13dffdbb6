//! Dimensions of formulas of parameters and answers.

use super::formulas::Work;
use super::{Known, Refused};
use crate::dimension::{self, Dimension};
use crate::expr::{Expr, Node, Symbol};
use crate::formula::write_plain;
use crate::scene::Scene;

fn dimension_of_parameter(scene: &Scene, name: &str) -> Option<Dimension> {
    let found = scene.parameter(name);
    found.map(|p| p.dimension.clone())
}

/// The dimension of a parameter, or of what a question asks for: a velocity that came out of plain numbers in their units is a
/// velocity all the same.
pub(super) fn kind_of(scene: &Scene, name: &str) -> Option<Dimension> {
    match scene.answering(name).map(|q| scene.dimension_of(&q.ask)) {
        Some(known) if known != Dimension::none() => Some(known),
        _ => dimension_of_parameter(scene, name),
    }
}

/// Whether a number stands beside the symbols, other than an exponent: it may be a quantity in its unit.
fn has_number(e: &Expr) -> bool {
    match e.node() {
        Node::Number(_) => true,
        Node::Symbol(_) => false,
        Node::Sum(parts) | Node::Product(parts) => parts.iter().any(has_number),
        Node::Power(base, _) => has_number(base),
        Node::Call(_, argument) => has_number(argument),
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
        let by_name = match self.scene.has_plain_numbers {
            true => self.stated_dimension(stated)?,
            false => None,
        };
        by_name.map_or_else(|| self.dimension_of(value), Ok)
    }

    /// Dimension of a formula of parameters and earlier answers, as it is stated: what is put in for a parameter may be a plain
    /// number in its unit.
    pub(super) fn stated_dimension(&self, e: &Expr) -> Result<Option<Dimension>, Refused> {
        let (scene, known) = (self.scene, self.known);
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
        let is_plain = |s: &Symbol| known.get(s).is_some_and(Expr::is_constant);
        if e.symbols().iter().any(is_plain)
            && !has_number(e)
            && let Ok(by_kind) = dimension::of(e, &asked)
        {
            return Ok(by_kind);
        }
        // Of an answer that is 0 nothing can be told: it stands for itself.
        let plain = known.iter().filter(|(_, v)| of_answer(v).is_none());
        let plain: Known = plain.map(|(s, v)| (s.clone(), v.clone())).collect();
        dimension::of(&e.substitute(&plain), &of).or_else(|clash| match dimension::of(e, &asked) {
            Err(_) if scene.has_plain_numbers => Ok(None),
            by_kind => by_kind.map_err(|_| clashes(self.name, clash.message(&write_plain))),
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
