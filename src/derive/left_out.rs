//! What a scene did not need, and why: finite forces, impulses without a moment, motion that cannot change, equations.

use std::collections::BTreeSet;

use super::Work;
use super::count::Counting;
use crate::expr::{Expr, Symbol};
use crate::laws::{self, Law, Place, Unknown};
use crate::scene::{Ask, Contact, ContactLaw, ImpulseAt, Scene};

/// Something that was neither built nor printed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// What.
    pub what: String,
    /// Why.
    pub why: String,
}

/// Lists what was left out of the first `asked` blocks.
pub(super) fn list(work: &Work<'_>, counting: &Counting, asked: usize) -> Vec<LeftOut> {
    let scene = work.scene;
    let mut out = Vec::new();
    let mut add = |what: String, why: String| out.push(LeftOut { what, why });
    for force in &scene.forces {
        add(
            format!("{} of {}", force.name, scene.bodies[force.body].name),
            String::from("a finite force has no impulse in the vanishing time of the collision"),
        );
    }
    let blocks = &work.blocks[..asked];
    let used = |u: Unknown| blocks.iter().any(|b| b.unknowns.contains(&u));
    for (place, unknowns) in impulses(scene) {
        let asked_for = scene.asked_of_impact().any(|q| asks_for(&q.ask, &unknowns));
        if unknowns.iter().any(|u| used(*u)) || asked_for || blocks.is_empty() {
            continue;
        }
        add(
            format!("impulse at {place}"),
            why_not_needed(work, &unknowns, asked),
        );
    }
    for body in &scene.bodies {
        if body.is_fixed() {
            add(
                format!("equations of {}", body.name),
                String::from("its motion is prescribed, so it needs none"),
            );
        } else if body.is_particle() {
            add(
                format!("spin of {}", body.name),
                String::from("a particle has no extension: no spin, no moment equation"),
            );
        }
    }
    for contact in &scene.contacts {
        if is_pin(scene, contact) {
            let [a, b] = contact.bodies.map(|b| &scene.bodies[b].name);
            add(
                format!("couple at {}", contact.name),
                format!(
                    "{a} and {b} stick at a point, about which each may turn as on a pin; what is one body afterwards sticks at two points"
                ),
            );
        }
        if let ContactLaw::Frictionless { .. } = contact.law {
            add(
                format!("tangential impulse at {}", contact.name),
                String::from("the contact is frictionless"),
            );
        }
    }
    let used_equations: usize = blocks.iter().map(|b| b.equations.len()).sum();
    if used_equations > 0 && used_equations < counting.equations {
        add(
            format!(
                "{} of the {} equations of the full system",
                counting.equations - used_equations,
                counting.equations
            ),
            String::from("what is asked does not depend on them"),
        );
    }
    let symbols = symbols(scene);
    for parameter in &scene.parameters {
        if !symbols.contains(&parameter.name) {
            add(
                format!("parameter {}", parameter.name),
                String::from("it stands in no equation of the impact"),
            );
        }
    }
    out
}

fn asks_for(ask: &Ask, unknowns: &[Unknown]) -> bool {
    let Ask::Impulse { from, .. } = ask else {
        return false;
    };
    unknowns.iter().any(|u| match (from, u) {
        (ImpulseAt::Contact(c), Unknown::Contact(i, _) | Unknown::Normal(i)) => c == i,
        (ImpulseAt::Hinge(h), Unknown::Hinge(i, _)) => h == i,
        _ => false,
    })
}

fn why_not_needed(work: &Work<'_>, unknowns: &[Unknown], asked: usize) -> String {
    let mut reasons: Vec<String> = Vec::new();
    let bodies = joined(work.scene, unknowns);
    for equation in work.blocks[..asked].iter().flat_map(|b| &b.equations) {
        let reason = match &equation.law {
            Law::LinearMomentum { system, .. } | Law::AngularMomentum { system, .. }
                if bodies.iter().all(|b| system.contains(b)) =>
            {
                format!(
                    "internal to the system of {}",
                    laws::body_list(work.scene, system)
                )
            }
            Law::AngularMomentum { system, about } if bodies.iter().any(|b| system.contains(b)) => {
                format!("no moment about {}", laws::place_name(work.scene, *about))
            }
            _ => continue,
        };
        if !reasons.contains(&reason) {
            reasons.push(reason);
        }
    }
    reasons.push(String::from("not asked for"));
    reasons.join("; ")
}

fn joined(scene: &Scene, unknowns: &[Unknown]) -> Vec<usize> {
    match unknowns.first() {
        Some(Unknown::Contact(c, _) | Unknown::Normal(c)) => scene.contacts[*c].bodies.to_vec(),
        Some(Unknown::Hinge(h, _)) => scene.hinges[*h].bodies.to_vec(),
        Some(Unknown::Blow(b)) => vec![scene.blows[*b].body],
        _ => Vec::new(),
    }
}

/// Whether two bodies that can turn stick at this contact alone.
fn is_pin(scene: &Scene, contact: &Contact) -> bool {
    let turns = |b: &usize| !scene.bodies[*b].is_fixed() && !scene.bodies[*b].is_particle();
    let joins = |bodies: &[usize; 2]| contact.bodies.iter().all(|b| bodies.contains(b));
    let sticks = |c: &&Contact| c.law == ContactLaw::Sticking && joins(&c.bodies);
    sticks(&contact)
        && contact.bodies.iter().all(turns)
        && scene.contacts.iter().filter(sticks).count() == 1
}

/// The unknown impulses by the place that transmits them.
fn impulses(scene: &Scene) -> Vec<(String, Vec<Unknown>)> {
    let contacts = (0..scene.contacts.len()).map(Place::Contact);
    let hinges = (0..scene.hinges.len()).map(Place::Hinge);
    let at = |place| {
        let name = laws::place_name(scene, place);
        (name, laws::impulses_at(scene, place))
    };
    contacts.chain(hinges).map(at).collect()
}

/// The symbols in the formulas of the impact, in the conditions of a mode of friction and in unit vectors.
fn symbols(scene: &Scene) -> BTreeSet<Symbol> {
    let mut all = super::work::formulas(scene);
    for (_, decided) in scene.decided() {
        let sides = decided.when.iter();
        all.extend(sides.flat_map(|(left, _, right)| [left.clone(), right.clone()]));
    }
    let units = scene.domains.unit_vectors.iter().flatten().cloned();
    all.iter().flat_map(Expr::symbols).chain(units).collect()
}
