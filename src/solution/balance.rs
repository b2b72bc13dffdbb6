//! Balances written out as the book does: the system and the reason first, then vectors, cross products, and the scalar line.

use super::block::AXES;
use super::words::{self, fill, set, vector};
use super::{Claim, Detail, Math, Writer};
use crate::derive::Equation;
use crate::expr::{Expr, Symbol, Vector};
use crate::laws::{self, Direction, Law, Place};

/// Longest balance of linear momentum, in nodes, that is written as change = impulses.
const LONG: usize = 60;

/// An impulse on a system from outside, as its equation takes it.
pub(super) struct Outside {
    pub(super) place: Place,
    /// In the scene's symbols.
    pub(super) impulse: Vector,
    /// Moment about the point of the balance.
    pub(super) moment: Expr,
}

impl Writer<'_> {
    /// One law: why it is used, written out where `vectors` asks for it, and its scalar equation.
    pub(super) fn balance(&mut self, equation: &Equation, vectors: bool) {
        let (left, right) = self.sides(equation);
        let reason = self.law_words(&equation.law);
        match &equation.law {
            Law::AngularMomentum { system, about } => {
                self.angular_reason(system, *about);
                if vectors {
                    self.angular_momentum(system, *about);
                }
            }
            Law::LinearMomentum { system, along } => {
                self.motion_words(system);
                self.linear_reason(system, along);
                self.linear_momentum(system, along, equation);
                return;
            }
            Law::Restitution(c) => self.restitution(*c),
            Law::Sticking(c, axis) => {
                let at = words::place(&self.scene.contacts[*c].name, "contact");
                self.say(&format!(
                    "The touching points at {at} move together just after, along {}:",
                    AXES[*axis]
                ));
            }
            Law::Hinged(h, axis) => {
                let at = words::place(&self.scene.hinges[*h].name, "hinge");
                self.say(&format!(
                    "The hinge at {at} holds: both its points have the same velocity along {}:",
                    AXES[*axis]
                ));
            }
            Law::Given(k) => self.given(*k),
            Law::Condition(c, i) => {
                self.name_roots(std::slice::from_ref(&right), 1);
                self.rubs(*c, *i, &right);
            }
        }
        let right = self.with_roots(&right);
        let shown = matches!(self.last_line(), Some((l, r)) if l == left && r == right);
        if !shown {
            self.claim(left, right, &reason);
        }
    }

    fn last_line(&self) -> Option<(Expr, Expr)> {
        let claim = self.solution.steps.last()?.after.last()?;
        Some((claim.left.clone(), claim.right.clone()))
    }

    /// Impulses on a system from outside.
    pub(super) fn outside(&mut self, system: &[usize], about: Option<Place>) -> Vec<Outside> {
        let mut places = Vec::new();
        for joint in self.scene.touching() {
            let inside = joint.bodies.map(|b| system.contains(&b));
            if inside[0] != inside[1] {
                places.push((Place::of(self.scene, joint.from).0, inside[1]));
            }
        }
        for (i, blow) in self.scene.blows.iter().enumerate() {
            if system.contains(&blow.body) {
                places.push((Place::Blow(i), true));
            }
        }
        let mut out = Vec::new();
        for (place, on_second) in places {
            let forms = laws::impulse_at(self.scene, &self.g, place);
            let sign = if on_second {
                Expr::one()
            } else {
                Expr::from(-1)
            };
            let raw = [0, 1].map(|i| &sign * &self.form(&forms[i]));
            let impulse = self.tidy_vector(&raw);
            let moment = match about {
                Some(about) => {
                    let arm = self.arm(&self.g.place(place).clone(), about);
                    let raw = &arm[0] * &impulse[1] - &arm[1] * &impulse[0];
                    self.tidy(&raw)
                }
                None => Expr::zero(),
            };
            out.push(Outside {
                place,
                impulse,
                moment,
            });
        }
        out
    }

    /// Vector from a moment point to a position.
    pub(super) fn arm(&mut self, to: &Vector, about: Place) -> Vector {
        let from = self.g.place(about).clone();
        let raw = [&to[0] - &from[0], &to[1] - &from[1]];
        self.tidy_vector(&raw)
    }

    /// Places whose impulses act between bodies of a system.
    fn inside(&self, system: &[usize]) -> Vec<String> {
        let within = |bodies: &[usize; 2]| bodies.iter().all(|b| system.contains(b));
        let contacts = self.scene.contacts.iter().filter(|c| within(&c.bodies));
        let hinges = self.scene.hinges.iter().filter(|h| within(&h.bodies));
        contacts
            .map(|c| words::place(&c.name, "contact"))
            .chain(hinges.map(|h| words::place(&h.name, "hinge")))
            .collect()
    }

    /// Which impulses act within a system.
    pub(super) fn internal_words(&self, system: &[usize]) -> String {
        let inside = self.inside(system);
        words::impulses_at(&inside, "is internal.", "are internal.")
    }

    /// The bodies of a system, each behind those that carry it along, by whose motion its own is told.
    fn carriers_first(&self, system: &[usize]) -> Vec<usize> {
        let link = |b: usize| self.reduction.tree.iter().find(|l| l.body == b);
        let chain = |b: &usize| {
            let carrier = |b: &usize| link(*b).map(|l| l.to).filter(|to| link(*to).is_some());
            let mut chain: Vec<usize> = std::iter::successors(Some(*b), carrier).collect();
            chain.reverse();
            chain
        };
        system.iter().flat_map(chain).collect()
    }

    /// How the bodies move just after, in vectors, where joints leave only their spins free; whether there was anything to tell.
    pub(super) fn motion_words(&mut self, system: &[usize]) -> bool {
        let mut any = false;
        for b in self.carriers_first(system) {
            let Some(link) = self.reduction.tree.iter().find(|l| l.body == b).copied() else {
                continue;
            };
            // How a body moves is told once.
            if !self.told.insert(Symbol::from(format!("motion of {b}"))) {
                continue;
            }
            any = true;
            let at = words::point(self.scene, link.at);
            let c = words::center(self.scene, b);
            let arm = self.arm(&self.g.place(Place::Center(b)).clone(), link.at);
            let v = self.velocity_after(b);
            let whom = words::body(self.scene, b);
            let still = self.stands(link.to, link.at);
            let there = words::at(self.scene, link.at);
            let body = &self.scene.bodies[b];
            let hinged = matches!(link.at, Place::Hinge(_));
            let moved = !body.velocity.iter().chain([&body.spin]).all(Expr::is_zero);
            let when = match hinged && moved {
                true => "Just after, as just before,",
                false => "Just after,",
            };
            let lead = if still && body.is_particle() {
                format!("{when} {whom} is at rest at {there}")
            } else if still {
                format!("{when} {whom} turns about {there}")
            } else {
                let to = words::body(self.scene, link.to);
                format!("{when} {whom} moves with {to} at {there}")
            };
            let carried = (!still).then(|| vec![vector("v", &at, "+")]);
            let turns = !arm.iter().all(Expr::is_zero) && !body.is_particle();
            let round = turns.then(|| {
                let r = vector("r", &format!("{c}/{at}"), "");
                set("{} × {}", [words::spin(self.scene, b, "+"), r])
            });
            let terms: Vec<Vec<Math>> = carried.into_iter().chain(round).collect();
            let mut math = set("{} =", [vector("v", &c, "+")]);
            math.extend(terms.join(&Math::Op("+")));
            // Of a body hinged at its center of mass nothing stands between the name and the value.
            math.extend((!terms.is_empty()).then_some(Math::Op("=")));
            math.push(v.clone().into());
            let spin = laws::Unknown::Spin(b);
            if self.d.names.is_reversed(spin) {
                let symbol = words::formula(&Expr::symbol(self.d.names.plain(spin)));
                let text = fill("{}; with {} counted clockwise,", [lead.into(), symbol]);
                self.text(text);
            } else {
                self.say(&format!("{lead}:"));
            }
            let mut claims = Vec::new();
            for (axis, value) in v.iter().enumerate() {
                let symbol = Expr::symbol(self.d.names.plain(laws::Unknown::Velocity(b, axis)));
                if symbol != *value {
                    claims.push(Claim::new(symbol, value.clone()));
                }
            }
            let id = self.step(Vec::new(), claims, "the joint leaves only the spin free");
            if !self.scene.bodies[b].is_particle() {
                let w = self.spin_after(b);
                let spin = words::spin(self.scene, b, "+");
                self.show(set("{} = {}", [spin, Math::Along(w)]), None);
            }
            self.show(math, Some(id));
        }
        any
    }

    fn linear_reason(&mut self, system: &[usize], along: &Direction) {
        let mut text = format!(
            "Balance linear momentum of {} along {}.",
            words::bodies(self.scene, system),
            super::block::direction(along)
        );
        text.push_str(&self.internal_words(system));
        let d = along.vector();
        let outside = self.outside(system, None);
        let mut silent = Vec::new();
        for x in &outside {
            let component = &x.impulse[0] * &d[0] + &x.impulse[1] * &d[1];
            if self.vanishes(&component) && !x.impulse.iter().all(Expr::is_zero) {
                silent.push(words::at(self.scene, x.place));
            }
        }
        let [one, several] =
            ["is", "are"].map(|be| format!("{be} perpendicular to that direction."));
        text.push_str(&words::impulses_at(&silent, &one, &several));
        self.say(&text);
    }

    /// A velocity after less the one before: as a whole, or term by term where that is shorter.
    fn change(&mut self, after: &Expr, before: &Expr) -> Expr {
        let whole = self.tidy(&(after - before));
        let joined = self.tidy(before);
        let before = match joined.size() < before.size() {
            true => &joined,
            false => before,
        };
        let apart = match after.begins_with_minus() && before.begins_with_minus() {
            true => &-before + after,
            false => after - before,
        };
        match apart.size() < whole.size() {
            true => apart,
            false => whole,
        }
    }

    /// Momentum after − momentum before = impulses, along a direction; where that is long, as it is solved.
    pub(super) fn linear_momentum(
        &mut self,
        system: &[usize],
        along: &Direction,
        equation: &Equation,
    ) {
        let d = along.vector();
        let dot = |v: &Vector| &v[0] * &d[0] + &v[1] * &d[1];
        // Bodies that change their velocity alike count with their mass together.
        let mut changes: Vec<(Expr, Expr)> = Vec::new();
        for &b in system {
            let [after, before] = [dot(&self.velocity_after(b)), dot(self.g.before(b).0)];
            let change = self.change(&after, &before);
            let mass = self.g.mass(b).clone();
            match changes.iter_mut().find(|(_, alike)| *alike == change) {
                Some((total, _)) => *total = self.tidy(&(&*total + &mass)),
                None => changes.push((mass, change)),
            }
        }
        let left: Vec<Expr> = changes.iter().map(|(mass, v)| mass * v).collect();
        let mut right = Vec::new();
        for x in self.outside(system, None) {
            let p = dot(&x.impulse);
            right.push(self.tidy(&p));
        }
        let (mut left, mut right) = (Expr::sum(left), Expr::sum(right));
        if left.is_zero() {
            std::mem::swap(&mut left, &mut right);
        }
        if left.size() + right.size() > LONG {
            let (left, right) = self.sides(equation);
            self.claim(left, right, "linear momentum");
        } else {
            self.claim(
                left,
                right,
                "change of linear momentum = impulses from outside",
            );
        }
    }

    /// Linear momentum along x and y as one balance of vectors.
    pub(super) fn momentum_vector(&mut self, system: &[usize], x: &Equation, y: &Equation) {
        let outside = self.outside(system, None);
        let mut text = format!(
            "Balance linear momentum of {}.",
            words::bodies(self.scene, system)
        );
        text.push_str(&self.internal_words(system));
        self.say(&text);
        let mut math = Vec::new();
        for o in &outside {
            let q = words::point(self.scene, o.place);
            let second = match o.place {
                Place::Contact(c) => system.contains(&self.scene.contacts[c].bodies[1]),
                Place::Hinge(h) => system.contains(&self.scene.hinges[h].bodies[1]),
                _ => true,
            };
            // The impulse on the first body of a joint is the opposite of the one named after the joint.
            let plus = second != self.is_named_on_first(o.place);
            if !plus {
                math.push(Math::Op("−"));
            } else if !math.is_empty() {
                math.push(Math::Op("+"));
            }
            math.push(vector("P", &q, ""));
        }
        if math.is_empty() {
            math.push(Expr::zero().into());
        }
        math.push(Math::Op("="));
        let changes = system.iter().map(|&b| {
            let c = words::center(self.scene, b);
            let [after, before] = ["+", "-"].map(|mark| vector("v", &c, mark));
            let mass = Math::Factor(self.g.mass(b).clone());
            set("{} ({} − {})", [mass, after, before])
        });
        let changes: Vec<Vec<Math>> = changes.collect();
        math.extend(changes.join(&Math::Op("+")));
        self.show(math, None);
        // With the values of the velocities put in.
        let mut sides = Vec::new();
        for axis in [0, 1] {
            let mut total = Vec::new();
            for &b in system {
                let before = self.g.before(b).0[axis].clone();
                let after = self.velocity_after(b)[axis].clone();
                let change = self.change(&after, &before);
                total.push(self.g.mass(b) * &change);
            }
            let impulses = outside.iter().map(|o| o.impulse[axis].clone());
            sides.push((Expr::sum(impulses), Expr::sum(total)));
        }
        if self.detail() == Detail::Full || sides.iter().all(|(_, r)| r.size() < 60) {
            self.say("In components,");
            let along = |axis: usize| format!("linear momentum along {}", AXES[axis]);
            for (axis, (left, right)) in sides.into_iter().enumerate() {
                if right.is_zero() && left.size() < 6 {
                    // What is zero by inspection is told by the result.
                    self.step(Vec::new(), vec![Claim::new(left, right)], &along(axis));
                } else {
                    self.claim(left, right, &along(axis));
                }
            }
        } else {
            for e in [x, y] {
                let (left, right) = self.sides(e);
                let words = self.law_words(&e.law);
                self.claim(left, right, &words);
            }
        }
    }

    /// Whether the scene asks for the impulse on the first body, so that its symbol is the opposite of the usual one.
    fn is_named_on_first(&self, place: Place) -> bool {
        match place {
            Place::Contact(c) => {
                self.d.names.is_reversed(laws::Unknown::Contact(c, 0))
                    || self.d.names.is_reversed(laws::Unknown::Normal(c))
            }
            Place::Hinge(h) => self.d.names.is_reversed(laws::Unknown::Hinge(h, 0)),
            _ => false,
        }
    }
}
