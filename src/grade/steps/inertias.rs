//! Moments of inertia that a line names or writes out, of one body or of several together.

use super::super::belief::other_shapes;
use super::super::{Diagnosis, Tolerance, number};
use super::Desk;
use crate::equality;
use crate::expr::{Expr, Symbol, only, ratio};
use crate::scene::{Body, Shape};

/// Most points about which a moment of inertia is tried.
const MOST_POINTS: usize = 8;
/// Most bodies whose moments of inertia are added.
const MOST_BODIES: usize = 4;

/// The moment of inertia of a body about a point, by Steiner's theorem.
fn about(body: &Body, at: &[Expr; 2]) -> Expr {
    let [x, y] = [0, 1].map(|k| &at[k] - &body.center[k]);
    &body.inertia + &(&body.mass * &(x.powi(2) + y.powi(2)))
}

/// The sums of some of them, or all.
fn together(each: &[Expr]) -> impl Iterator<Item = Expr> {
    (1..1usize << each.len()).map(|chosen| {
        let parts = each.iter().enumerate();
        let parts = parts.filter(|(k, _)| chosen >> k & 1 == 1);
        Expr::sum(parts.map(|(_, e)| e.clone()).collect::<Vec<_>>())
    })
}

/// The finding about a moment of inertia whose name says about which point it is.
pub(super) fn is_other_inertia(name: &Symbol) -> Diagnosis {
    let words = match name.strip_prefix("I_") {
        Some(place) => format!("the moment of inertia about {place} is another one"),
        None => "the moment of inertia is that of another shape".to_string(),
    };
    let hint = "moments of inertia: I_G of the shape, plus m times the square of the distance to G";
    Diagnosis::new("INERTIA", words, hint)
}

/// The center of mass of several bodies together.
fn common_center(bodies: &[&Body]) -> Option<[Expr; 2]> {
    let total = Expr::sum(bodies.iter().map(|b| b.mass.clone()).collect::<Vec<_>>());
    let along = |axis: usize| {
        let each = bodies.iter().map(|b| &b.mass * &b.center[axis]);
        Expr::sum(each.collect::<Vec<_>>()) / &total
    };
    (bodies.len() > 1).then(|| [along(0), along(1)])
}

impl Desk<'_> {
    /// The moment of inertia that a name such as I_A speaks of, A a point of the scene or G, where the value given to it is that
    /// of no body and of no bodies together.
    pub(super) fn other_inertia(&self, name: &Symbol, value: &Expr) -> Option<Expr> {
        let scene = &self.sheet.scene;
        if &**name == "I" {
            return self.inertia_of_round(value);
        }
        let place = name.strip_prefix("I_")?;
        let point = scene.points.iter().find(|p| p.name == place);
        if point.is_none() && place != "G" || scene.bodies.iter().any(|b| b.name == place) {
            return None;
        }
        // That of several about their common center is one of G as well.
        if point.is_none() && self.is_inertia(value) {
            return None;
        }
        let about = |body: &Body| about(body, point.map_or(&body.center, |p| &p.at));
        let free = scene.bodies.iter().filter(|b| !b.is_fixed());
        let each: Vec<Expr> = free.map(about).take(MOST_BODIES).collect();
        let value = self.with_own(value);
        if value.is_constant() {
            // In numbers it may be rounded, and needs the values of the scene.
            let values = scene.values();
            let room = Tolerance::Relative(ratio(1, 100));
            let is = |e: &Expr| number::within(&value, &e.substitute(&values), &room);
            let none = each.iter().all(|e| is(e) == Some(false));
            return none.then(|| each.into_iter().next()).flatten();
        }
        let others = together(&each).all(|total| {
            let decision = equality::decide(&value, &total, &scene.domains);
            decision.equality.is_different()
        });
        others.then(|| each.into_iter().next()).flatten()
    }

    /// The moment of inertia of something round where a value is that of another round shape, and of nothing in the scene.
    fn inertia_of_round(&self, value: &Expr) -> Option<Expr> {
        let scene = &self.sheet.scene;
        let round = |body: &Body| {
            use Shape::{Disk, Ring, Sphere};
            let shape = matches!(body.shape, Disk { .. } | Ring { .. } | Sphere { .. });
            shape && !body.is_fixed()
        };
        let mine = self.with_own(value);
        let same = |other: &Expr| equality::decide(&mine, other, &scene.domains).equality;
        let is_other = |b: usize| {
            let mut others = other_shapes(scene, b).into_iter();
            others.any(|(other, _)| same(&other).is_same())
        };
        let bodies = scene.bodies.iter().enumerate();
        let mut bodies = bodies.filter(|(_, body)| round(body));
        let (_, body) = bodies.find(|(b, _)| is_other(*b))?;
        (!self.is_inertia(value)).then(|| body.inertia.clone())
    }

    /// Whether a value is the moment of inertia of bodies of the scene about the center of one or a point that the scene names.
    pub(super) fn is_inertia(&self, value: &Expr) -> bool {
        let scene = &self.sheet.scene;
        let free = || scene.bodies.iter().filter(|b| !b.is_fixed());
        let hinges = scene.hinges.iter().map(|h| &h.at);
        let centers = free().map(|b| &b.center).chain(hinges);
        let common = common_center(&free().collect::<Vec<_>>());
        let points = scene.points.iter().map(|p| &p.at).chain(centers);
        let points = points.take(MOST_POINTS).chain(common.as_ref());
        let value = self.with_own(value);
        points.into_iter().any(|point| {
            let each: Vec<Expr> = free().map(|b| about(b, point)).take(MOST_BODIES).collect();
            let same = |total| equality::decide(&value, &total, &scene.domains).equality;
            together(&each).any(|total| same(total).is_same())
        })
    }

    /// What I_G and I_A stand for where nobody says it and only one body moves, and I with the name of a body.
    pub(super) fn lone_inertia(&self, name: &Symbol) -> Option<Expr> {
        let scene = &self.sheet.scene;
        let place = name.strip_prefix("I_")?;
        if let Some(body) = scene
            .bodies
            .iter()
            .find(|b| b.name == place && !b.is_fixed())
        {
            return Some(body.inertia.clone());
        }
        let body = only(scene.bodies.iter().filter(|b| !b.is_fixed()))?;
        match place {
            "G" => Some(body.inertia.clone()),
            place => {
                let point = scene.points.iter().find(|p| p.name == place)?;
                Some(about(body, &point.at))
            }
        }
    }
}
