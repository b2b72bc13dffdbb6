//! What stands between a printed thing and the right one, where no slip of the pen does: a factor, a term, a component, a
//! condition, one digit.

use std::collections::BTreeMap;

use num_traits::{Signed, Zero};

use super::desk::Desk;
use crate::algebra::Field;
use crate::expr::{Expr, Rational};
use crate::formula::Content;
use crate::scene::Printed;
use crate::verify::rounding::ten_to;

/// Longest factor that is told.
const SHORT: usize = 6;

impl Desk<'_> {
    /// A component that is printed as zero and is not, or two in each other's place.
    pub(super) fn component(&self, pairs: &[(Expr, Expr)]) -> Option<String> {
        if let [(x, first), (y, second), ..] = pairs
            && !self.is_same(x, y)
            && self.is_same(x, second)
            && self.is_same(y, first)
        {
            return Some("the components along x and y stand exchanged".into());
        }
        let wrong: Vec<usize> = (0..pairs.len())
            .filter(|i| !self.is_same(&pairs[*i].0, &pairs[*i].1))
            .collect();
        let [i] = wrong.as_slice() else { return None };
        let (axis, wrong) = (["x", "y", "z"].get(*i)?, &pairs[*i..=*i]);
        match wrong {
            _ if pairs.len() < 2 => None,
            [(_, printed)] if printed.is_zero() => {
                Some(format!("the {axis}-component is left out"))
            }
            wrong => Some(format!(
                "along {axis}, {}",
                self.factor(wrong).or_else(|| self.slip(wrong))?
            )),
        }
    }

    /// Two sides that agree but for a short factor.
    pub(super) fn short_factor(&self, pairs: &[(Expr, Expr)]) -> Option<String> {
        let [(right, printed)] = pairs else {
            return None;
        };
        let (field, a, b) = Field::pair(&self.scene.domains, right, printed).ok()?;
        if field.is_zero(&a) || field.is_zero(&b) {
            return None;
        }
        let more = field.expr(&field.div(&b, &a).ok()?);
        let less = field.expr(&field.div(&a, &b).ok()?);
        match more.size() <= less.size() {
            true if more.size() <= SHORT => {
                Some(format!("the factor {} is too much", self.say(&more)))
            }
            false if less.size() <= SHORT => {
                Some(format!("the factor {} is left out", self.say(&less)))
            }
            _ => None,
        }
    }

    /// An equation that lacks one quantity of the scene, such as the impulse at a hinge.
    pub(super) fn lacking(&self, pairs: &[(Expr, Expr)]) -> Option<String> {
        let [(left, right)] = pairs else { return None };
        let difference = right - left;
        let (name, _) = self.closed.iter().find(|(_, value)| {
            !value.is_zero()
                && (self.is_same(value, &difference) || self.is_same(value, &-&difference))
        })?;
        Some(format!("it would hold with {name} added to one side"))
    }

    /// What holds at a value of a parameter that the scene asks for, and is no 0 = 0 there.
    pub(super) fn sought(&self, pairs: &[(Expr, Expr)]) -> Option<String> {
        self.bounds.iter().find_map(|(item, (of, _, value))| {
            let at = BTreeMap::from([(of.as_symbol()?.clone(), value.clone())]);
            let holds = pairs.iter().all(|(a, b)| {
                let [a, b] = [a, b].map(|e| e.substitute(&at));
                self.is_same(&a, &b) && !self.is_same(&a, &Expr::zero())
            });
            let (of, value) = (self.say(of), self.say(value));
            holds.then(|| {
                format!("it holds for {of} = {value}, which `{item}` asks for; `at` can say so")
            })
        })
    }

    /// A claim for a special value of a parameter that holds for another one.
    pub(super) fn condition(&self, sides: &[Content], printed: &Printed) -> Option<String> {
        let ([left, right], [[name, _]]) = (sides, printed.at.as_slice()) else {
            return None;
        };
        let open = Printed {
            at: Vec::new(),
            ..printed.clone()
        };
        let put_in = |side: &Content| self.put_in(side.expr()?, &open).ok();
        let difference = put_in(left)? - put_in(right)?;
        let (mut field, element) = Field::of(&self.scene.domains, &difference).ok()?;
        let powers = field.powers(&element, name).ok()??;
        let [root] = powers.factors.as_slice() else {
            return None;
        };
        let [constant, slope] = root.as_slice() else {
            return None;
        };
        let value = field.neg(&field.div(constant, slope).ok()?);
        Some(format!(
            "it would hold for {name} = {}",
            self.say(&field.expr(&value))
        ))
    }
}

/// One digit misprinted or two exchanged: what the right value, rounded to the same place, shows.
pub(super) fn digits(written: &Rational, right: &Rational, place: i32) -> Option<String> {
    let whole = |v: &Rational| (v.abs() / ten_to(place)).round().numer().to_string();
    let (mine, theirs) = (whole(written), whole(right));
    if mine.len() != theirs.len() || written.is_negative() != right.is_negative() {
        return None;
    }
    let apart: Vec<usize> = (0..mine.len())
        .filter(|i| mine.as_bytes()[*i] != theirs.as_bytes()[*i])
        .collect();
    let digit = |text: &str, i: usize| text.as_bytes()[i];
    let words = match apart.as_slice() {
        [i] => format!(
            "one digit is misprinted: {} for {}",
            char::from(digit(&mine, *i)),
            char::from(digit(&theirs, *i))
        ),
        [i, j]
            if *j == i + 1
                && digit(&mine, *i) == digit(&theirs, *j)
                && digit(&mine, *j) == digit(&theirs, *i) =>
        {
            "two digits stand exchanged".to_string()
        }
        _ => return None,
    };
    (!right.is_zero()).then(|| format!("{words}; a misprint of its own"))
}
