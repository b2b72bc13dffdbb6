//! A balance of angular momentum written out: why this point, which impulses have no moment about it, then H in vectors.

use super::balance::Outside;
use super::words::{self, name, say};
use super::{Claim, Inline, Math, Writer};
use crate::expr::{Expr, Vector};
use crate::laws::Place;

impl Writer<'_> {
    /// Which system, about which point, and why other impulses do not appear.
    pub(super) fn angular_reason(&mut self, system: &[usize], about: Place) {
        let at = match (about, system) {
            (Place::Center(b), [only]) if b == *only => String::from("its center of mass"),
            _ => words::at(self.scene, about),
        };
        let whom = words::bodies(self.scene, system);
        let mut text = if system.len() > 1 {
            format!("Take {whom} together and balance angular momentum about {at}.")
        } else {
            format!("Balance angular momentum of {whom} about {at}.")
        };
        if let Some(internal) = self.internal_words(system) {
            text.push(' ');
            text.push_str(&internal);
        }
        let outside = self.outside(system, Some(about));
        let mut silent = Vec::new();
        let mut through = Vec::new();
        for o in outside.iter().filter(|o| o.moment.is_zero()) {
            let arm = self.arm(&self.g.place(o.place).clone(), about);
            let place = words::at(self.scene, o.place);
            if arm.iter().all(Expr::is_zero) {
                silent.push(place);
            } else if !o.impulse.iter().all(Expr::is_zero) {
                through.push(place);
            }
        }
        if let [one] = silent.as_slice() {
            text.push_str(&format!(
                " The impulse at {one} acts there and has no moment."
            ));
        } else if !silent.is_empty() {
            text.push_str(&format!(
                " The impulses at {} act there and have no moment.",
                words::listed(&silent)
            ));
        }
        if let [one] = through.as_slice() {
            text.push_str(&format!(
                " The impulse at {one} passes through it and has no moment about it."
            ));
        } else if !through.is_empty() {
            text.push_str(&format!(
                " The impulses at {} pass through it and have no moment about it.",
                words::listed(&through)
            ));
        }
        if outside.is_empty() {
            text.push_str(" No impulse acts on it from outside.");
        }
        self.say(&text);
    }

    /// H⁻ and H⁺ in vectors, evaluated.
    pub(super) fn angular_momentum(&mut self, system: &[usize], about: Place) {
        let o = words::point(self.scene, about);
        let index = match about {
            Place::Center(_) if self.scene.bodies.iter().filter(|b| !b.is_fixed()).count() == 1 => {
                String::from("G")
            }
            _ => o.clone(),
        };
        let outside: Vec<Outside> = self
            .outside(system, Some(about))
            .into_iter()
            .filter(|x| !x.moment.is_zero())
            .collect();
        let h = |mark| name("H", &index, mark, true);
        let before: Vec<(Vector, Expr)> = system
            .iter()
            .map(|&b| {
                let (v, w) = self.g.before(b);
                (v.clone(), w.clone())
            })
            .collect();
        let at_rest = before
            .iter()
            .all(|(v, w)| v.iter().all(Expr::is_zero) && w.is_zero());
        if at_rest {
            let whom = words::capital(&words::bodies(self.scene, system));
            let is = if system.len() == 1 { "is" } else { "are" };
            self.text(vec![
                say(format!("{whom} {is} at rest before, so ")),
                Inline::Math(vec![h("-"), Math::Op("="), Math::Expr(Expr::zero())]),
                say("."),
            ]);
        }
        if self.motion_words(system) {
            self.say(&match outside.is_empty() {
                true => format!("Angular momentum about {o} is conserved:"),
                false => String::from("Then"),
            });
        }
        let mut law = vec![h("-")];
        for x in &outside {
            let q = words::point(self.scene, x.place);
            law.extend([
                Math::Op("+"),
                name("r", &format!("{q}/{o}"), "", true),
                Math::Op("×"),
                name("P", &q, "", true),
            ]);
        }
        law.extend([Math::Op("="), h("+")]);
        self.show(law, None);
        self.definition(system, about, name("H", &index, "", true));
        if !at_rest {
            self.momentum_line(
                system,
                about,
                &before,
                h("-"),
                "angular momentum just before",
            );
        }
        let after: Vec<(Vector, Expr)> = system
            .iter()
            .map(|&b| (self.velocity_after(b), self.spin_after(b)))
            .collect();
        self.momentum_line(system, about, &after, h("+"), "angular momentum just after");
        for x in &outside {
            self.moment_of(x, about);
        }
    }

    /// H as the sum over the bodies of r × m v + I ω, without what vanishes.
    fn definition(&mut self, system: &[usize], about: Place, h: Math) {
        let o = words::point(self.scene, about);
        let mut sum = Vec::new();
        for &b in system {
            let c = words::center(self.scene, b);
            let arm = self.arm(&self.g.place(Place::Center(b)).clone(), about);
            let spins = !self.scene.bodies[b].is_particle() && !self.inertia_vanishes(b);
            let moves = !arm.iter().all(Expr::is_zero) && !self.vanishes(&self.g.mass(b).clone());
            if moves {
                sum.push(vec![
                    name("r", &format!("{c}/{o}"), "", true),
                    Math::Op("×"),
                    Math::Factor(self.g.mass(b).clone()),
                    name("v", &c, "", true),
                ]);
            }
            if spins {
                sum.push(vec![self.inertia_name(b), words::spin(self.scene, b, "")]);
            }
        }
        if !sum.is_empty() {
            let mut math = vec![h, Math::Op("=")];
            math.extend(sum.join(&Math::Op("+")));
            self.show(math, None);
        }
    }

    /// The moment of an impulse from outside, evaluated.
    fn moment_of(&mut self, x: &Outside, about: Place) {
        let [o, q] = [about, x.place].map(|place| words::point(self.scene, place));
        let arm = self.arm(&self.g.place(x.place).clone(), about);
        let raw = &arm[0] * &x.impulse[1] - &arm[1] * &x.impulse[0];
        let math = vec![
            name("r", &format!("{q}/{o}"), "", true),
            Math::Op("×"),
            name("P", &q, "", true),
            Math::Op("="),
            Math::Brackets(vec![Math::Vector(arm)]),
            Math::Op("×"),
            Math::Brackets(vec![Math::Vector(x.impulse.clone())]),
            Math::Op("="),
            Math::Along(x.moment.clone()),
        ];
        let id = self.step(
            Vec::new(),
            vec![Claim::new(raw, x.moment.clone())],
            "the moment of the impulse",
        );
        self.show(math, Some(id));
    }

    fn inertia_vanishes(&mut self, b: usize) -> bool {
        let inertia = self.g.inertia(b).clone();
        self.vanishes(&inertia)
    }

    /// I as the scene names it, or I with the body's index.
    fn inertia_name(&self, b: usize) -> Math {
        let inertia = self.g.inertia(b);
        if inertia.as_symbol().is_some() {
            Math::Expr(inertia.clone())
        } else {
            name("I", &words::center(self.scene, b), "", false)
        }
    }

    /// Σ r × m v + I ω = value, written out and evaluated.
    fn momentum_line(
        &mut self,
        system: &[usize],
        about: Place,
        motion: &[(Vector, Expr)],
        symbol: Math,
        reason: &str,
    ) {
        let mut math = vec![symbol, Math::Op("=")];
        let mut raw = Vec::new();
        let mut pieces = 0;
        for (&b, (v, w)) in system.iter().zip(motion) {
            let mass = self.g.mass(b).clone();
            let arm = self.arm(&self.g.place(Place::Center(b)).clone(), about);
            let moves = !v.iter().all(Expr::is_zero) && !arm.iter().all(Expr::is_zero);
            if moves && !mass.is_zero() {
                if pieces > 0 {
                    math.push(Math::Op("+"));
                }
                math.extend([
                    Math::Brackets(vec![Math::Vector(arm.clone())]),
                    Math::Op("×"),
                    Math::Factor(mass.clone()),
                    Math::Brackets(vec![Math::Vector(v.clone())]),
                ]);
                pieces += 1;
            }
            raw.push(&mass * &(&arm[0] * &v[1] - &arm[1] * &v[0]));
            if !self.scene.bodies[b].is_particle() && !self.inertia_vanishes(b) && !w.is_zero() {
                let inertia = self.g.inertia(b).clone();
                let inertia = self.tidy(&inertia);
                if pieces > 0 {
                    math.push(Math::Op("+"));
                }
                math.extend([
                    Math::Factor(inertia.clone()),
                    Math::Brackets(vec![Math::Along(w.clone())]),
                ]);
                raw.push(&inertia * w);
                pieces += 1;
            }
        }
        let left = Expr::sum(raw);
        let value = self.tidy(&left);
        // I ω alone is the value already.
        if pieces == 1
            && system.len() == 1
            && matches!(math.last(), Some(Math::Brackets(b)) if matches!(b.as_slice(), [Math::Along(_)]))
        {
            math.truncate(2);
            pieces = 0;
        }
        if pieces > 0 {
            math.push(Math::Op("="));
        }
        math.push(Math::Along(value.clone()));
        let claim = Claim::new(left, value);
        let id = self.step(Vec::new(), vec![claim], reason);
        self.show(math, Some(id));
    }
}
