//! The two directions of friction: cases that are the same in both become one, and conditions that say the direction by
//! themselves need not be told it.

use super::super::Stop;
use super::{Bound, Case, Direction, Forms, Table, impossible};
use crate::algebra::Sign;
use crate::formula::Relation;
use crate::laws::friction::Side;
use crate::scene::ContactLaw;

impl Forms {
    /// Joins the cases of both directions where they are the same, and finds where the conditions say the direction.
    pub(super) fn without_directions(&mut self, table: &mut Table) -> Result<(), Stop> {
        if table.side.of.is_zero() {
            return Ok(());
        }
        let (along, mut against): (Vec<Case>, Vec<Case>) = std::mem::take(&mut table.cases)
            .into_iter()
            .partition(|case| case.direction != Direction::Asked(-1));
        for mut one in along {
            let like = |other: &Case| {
                other.mode == one.mode && other.conditions.len() == one.conditions.len()
            };
            if one.direction == Direction::Asked(1)
                && let Some(i) = against.iter().position(like)
            {
                let turned = match self.turned(&one, &against[i], &table.side) {
                    // What would be compared has no value, such as what is divided by μ = 0.
                    Err(Stop::DivisionByZero) => None,
                    turned => turned?,
                };
                match turned {
                    Some(Direction::Either) => {
                        let other = against.remove(i);
                        self.join(&mut one, other.conditions, table.contact)?;
                    }
                    Some(_) => {
                        one.direction = Direction::Follows(1);
                        against[i].direction = Direction::Follows(-1);
                    }
                    None => {}
                }
            }
            table.cases.push(one);
        }
        table.cases.extend(against);
        Ok(())
    }

    /// Compares a case with that of the other direction: whether they are the same, or the conditions of each say its
    /// direction. Conditions of the two, one by one, must differ by a factor of known sign times what decides the direction.
    fn turned(&mut self, one: &Case, other: &Case, side: &Side) -> Result<Option<Direction>, Stop> {
        let (mut same, mut told) = (true, false);
        for (a, b) in one.conditions.iter().zip(&other.conditions) {
            let [[a], [b]] = [&a.when, &b.when].map(Vec::as_slice) else {
                return Ok(None);
            };
            let gap = self.sign(&((&b.of - &a.of) / &side.of))?;
            same &= gap.is_some_and(Sign::is_not_negative);
            // Not both hold, and the one that does is on its own side.
            told |= gap == Some(Sign::Negative)
                && (self.sign(&(&a.of + &b.of))?)
                    .is_some_and(|sum| impossible(sum, a.strict || b.strict));
        }
        for (p, q) in one.impulse.iter().zip(&other.impulse) {
            same = same && self.tidy(&(p - q))?.is_zero();
        }
        Ok(match (same, told) {
            (true, _) => Some(Direction::Either),
            (false, true) => Some(one.direction),
            (false, false) => None,
        })
    }

    /// A case that holds either way, under its conditions for both: those of opposite right sides become one.
    fn join(&mut self, one: &mut Case, others: Vec<Bound>, contact: usize) -> Result<(), Stop> {
        one.direction = Direction::Either;
        let mut joined = Vec::new();
        for (mut bound, other) in std::mem::take(&mut one.conditions).into_iter().zip(others) {
            let alike = bound.left == other.left && bound.relation == other.relation;
            let is_lower = matches!(bound.relation, Relation::Greater | Relation::GreaterEqual);
            let sum = self.tidy(&(&bound.right + &other.right))?;
            if alike && is_lower && sum.is_zero() && !bound.right.is_zero() {
                bound.when.extend(other.when);
                bound.right = self.size(&bound.right)?;
                joined.push(bound);
            } else {
                joined.extend([bound, other]);
            }
        }
        one.conditions = joined;
        let told = one.conditions.iter();
        let told = told.map(|b| (b.left.clone(), b.relation, b.right.clone()));
        if let ContactLaw::Decided(decided) = &mut one.scene.contacts[contact].law {
            decided.when = told.collect();
            decided.slip = None;
        }
        Ok(())
    }
}
