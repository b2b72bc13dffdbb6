//! How two bodies meet beyond the one normal that a contact has: whether their outlines leave room for each other, what is known
//! where there is no normal, and the other points at which straight sides touch.

use super::super::sides::{self, Sense};
use super::super::{Condition, Rule, Verdict, is_zero};
use super::Judge;
use crate::expr::{Expr, Vector, dot};
use crate::scene::Contact;

impl Judge<'_> {
    /// Whether the outlines of two bodies leave room for each other and have the normal that is given.
    pub(super) fn outlines_fit(&mut self, contact: &Contact) {
        if let Some(why) = sides::misfit(self.scene, contact) {
            self.conditions.push(Condition {
                rule: Rule::Place,
                words: format!("the outlines fit each other at `{}`", contact.name),
                otherwise: why,
                verdict: Verdict::Nowhere,
                essential: None,
                is_equation: false,
                at_values: None,
            });
        }
    }

    /// Two particles that meet and go on along one line have that line for a normal, and none where they start together; of
    /// anything else nothing tells which way the bodies face each other.
    pub(super) fn without_normal(
        &mut self,
        contact: &Contact,
        before: &Vector,
        after: &Vector,
        impulse: &Vector,
    ) {
        let vanishes = |e: &Expr| {
            let closed = self.closed(e);
            closed.is_some_and(|closed| is_zero(&closed, &self.scene.domains))
        };
        let are_particles = contact
            .bodies
            .iter()
            .all(|b| self.scene.bodies[*b].is_particle());
        if are_particles && before.iter().all(vanishes) {
            return;
        }
        let name = &contact.name;
        let across = &before[0] * &after[1] - &before[1] * &after[0];
        // Without an impulse they pass beside each other.
        if are_particles && vanishes(&across) && !impulse.iter().all(vanishes) {
            self.claim(
                Rule::Apart,
                format!("the bodies do not enter each other at `{name}`"),
                format!("the bodies pass through each other at `{name}`"),
                -dot(before, after),
                None,
            );
        } else {
            self.not_judged.push(format!(
                "whether the bodies pass through each other at `{name}`, since neither the scene nor an outline gives a normal there"
            ));
        }
    }

    /// The other touching points, where straight sides lie along each other.
    pub(super) fn along_sides(&mut self, contact: &Contact, before: &Vector, sides: &sides::Sides) {
        let [a, b] = contact.bodies.map(|b| &self.scene.bodies[b].name);
        for touching in &sides.along {
            let after = self.relative(contact, &touching.at, true);
            let sense = match touching.sense {
                Sense::Out => Expr::one(),
                Sense::ByApproach => -dot(before, &touching.normal),
            };
            self.claim(
                Rule::Apart,
                format!("the sides of `{a}` and `{b}` along each other at `{}` stay apart", contact.name),
                format!(
                    "the sides of `{a}` and `{b}` that lie along each other at `{}` enter each other",
                    contact.name
                ),
                &sense * &dot(&after, &touching.normal),
                None,
            );
        }
        if sides.unsure {
            self.not_judged.push(format!(
                "how far the sides of `{a}` and `{b}` lie along each other at `{}`",
                contact.name
            ));
        }
    }
}
