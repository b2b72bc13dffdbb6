//! The laws a planner may choose from: balances of connected systems, moments about the points that may spare an impulse.
//!
//! In: a scene and what its joints leave free, in numbers. Out: laws, the simpler first.

use super::{Reduction, ZERO};
use crate::laws::{Direction, Geometry, Law, Place};
use crate::scene::{ContactLaw, Scene};

/// Every law worth considering, with a cost that prefers what a reader finds simplest.
pub(super) fn candidate_laws(
    scene: &Scene,
    reduction: &Reduction,
    g: &Geometry<f64>,
) -> Vec<(Law, usize)> {
    let mut laws: Vec<(Law, usize)> = Vec::new();
    for system in systems(scene, reduction) {
        let size = system.len();
        let axes = [Direction::X, Direction::Y];
        laws.extend(axes.map(|along| (Law::linear(&system, along), 2 * (size - 1))));
        for (c, contact) in scene.contacts.iter().enumerate() {
            let touches = contact.bodies.iter().filter(|b| system.contains(b)).count() == 1;
            if let (Some([nx, ny]), true) = (&contact.normal, touches) {
                let is_axis = nx.as_number().is_some() && ny.as_number().is_some();
                if matches!(scene.contacts[c].law, ContactLaw::Frictionless { .. }) && !is_axis {
                    let along = Direction::Named(
                        format!("the tangent at {}", contact.name),
                        [-ny, nx.clone()],
                    );
                    laws.push((Law::linear(&system, along), 2 * (size - 1) + 1));
                }
            }
        }
        if system.iter().all(|&b| scene.bodies[b].is_particle()) && size == 1 {
            continue;
        }
        for about in moment_points(scene, g, &system) {
            // A center of mass is the natural point for one body and an odd one for several.
            let center = match about {
                Place::Center(_) if size > 1 => 3,
                Place::Center(_) => 1,
                _ => 0,
            };
            let cost = 2 * (size - 1) + 3 + center;
            laws.push((Law::angular(&system, about), cost));
        }
    }
    for (c, contact) in scene.contacts.iter().enumerate() {
        match contact.law {
            ContactLaw::Frictionless { .. } => laws.push((Law::Restitution(c), 0)),
            ContactLaw::Decided(_) => {
                laws.extend([0, 1].map(|i| (Law::Condition(c, i), 0)));
            }
            ContactLaw::None | ContactLaw::Sticking | ContactLaw::Friction(_) => {}
        }
    }
    laws.extend(reduction.loops.iter().map(|law| (law.clone(), 0)));
    laws.extend((0..scene.after.len()).map(|k| (Law::Given(k), 0)));
    laws
}

/// Connected systems of movable bodies: all of them in small scenes; else single bodies, the two sides of every joint of
/// the tree, and whole components.
fn systems(scene: &Scene, reduction: &Reduction) -> Vec<Vec<usize>> {
    let free: Vec<usize> = scene.moving().collect();
    let mut edges: Vec<[usize; 2]> = scene.hinges.iter().map(|h| h.bodies).collect();
    edges.extend(scene.contacts.iter().map(|c| c.bodies));
    let mut systems: Vec<Vec<usize>> = free.iter().map(|&b| vec![b]).collect();
    if free.len() <= 4 {
        for subset in 1_u32..1 << free.len() {
            let bodies: Vec<usize> = (0..free.len())
                .filter(|i| subset >> i & 1 == 1)
                .map(|i| free[i])
                .collect();
            let whole = connected(bodies[0], &bodies, &edges);
            if bodies.len() > 1 && whole.len() == bodies.len() {
                systems.push(bodies);
            }
        }
        return systems;
    }
    for link in &reduction.tree {
        let mut side = vec![link.body];
        // Attachments come carriers first, so one pass collects everything carried.
        for other in &reduction.tree {
            if side.contains(&other.to) && !side.contains(&other.body) {
                side.push(other.body);
            }
        }
        side.sort_unstable();
        if side.len() > 1 {
            systems.push(side);
        }
    }
    for &root in &free {
        let mut whole = connected(root, &free, &edges);
        whole.sort_unstable();
        if whole[0] == root && whole.len() > 1 && !systems.contains(&whole) {
            systems.push(whole);
        }
    }
    systems
}

/// The bodies that joints within these link to one of them, itself first.
fn connected(to: usize, within: &[usize], edges: &[[usize; 2]]) -> Vec<usize> {
    let mut reached = vec![to];
    let mut at = 0;
    while at < reached.len() {
        for edge in edges {
            if let Some(side) = edge.iter().position(|b| *b == reached[at]) {
                let other = edge[1 - side];
                if within.contains(&other) && !reached.contains(&other) {
                    reached.push(other);
                }
            }
        }
        at += 1;
    }
    reached
}

/// Points about which moments of a system are worth taking: where impulses act on it, then the center of a single body.
fn moment_points(scene: &Scene, g: &Geometry<f64>, system: &[usize]) -> Vec<Place> {
    let touches = |bodies: &[usize; 2]| bodies.iter().any(|b| system.contains(b));
    let mut places: Vec<Place> = Vec::new();
    places.extend(
        (0..scene.contacts.len())
            .filter(|&c| touches(&scene.contacts[c].bodies))
            .map(Place::Contact),
    );
    places.extend(
        (0..scene.hinges.len())
            .filter(|&h| touches(&scene.hinges[h].bodies))
            .map(Place::Hinge),
    );
    places.extend(
        (0..scene.blows.len())
            .filter(|&b| system.contains(&scene.blows[b].body))
            .map(Place::Blow),
    );
    places.extend(
        system
            .iter()
            .filter(|&&b| !scene.bodies[b].is_particle())
            .map(|&b| Place::Center(b)),
    );
    let mut distinct: Vec<Place> = Vec::new();
    for place in places {
        let p = g.place(place);
        let same = |q: &Place| {
            let q = g.place(*q);
            (p[0] - q[0]).abs() + (p[1] - q[1]).abs() < ZERO
        };
        if !distinct.iter().any(same) {
            distinct.push(place);
        }
    }
    distinct
}
