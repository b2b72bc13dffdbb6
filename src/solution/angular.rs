//! A balance of angular momentum written out: why this point, which impulses have no moment about it, then H in vectors.

use super::balance::Outside;
use super::words::{self, fill, name, set, vector};
use super::{Claim, Inline, Math, Writer};
use crate::expr::{Expr, Symbol, Vector, cross};
use crate::laws::Place;
use crate::scene::Shape;

impl Writer<'_> {
    /// Which system, about which point, and why other impulses do not appear.
    pub(super) fn angular_reason(&mut self, system: &[usize], about: Place) {
        let at = words::about(self.scene, system, about);
        let whom = words::bodies(self.scene, system);
        let balance = if system.len() > 1 {
            format!("Take {whom} together and balance angular momentum about {at}")
        } else {
            format!("Balance angular momentum of {whom} about {at}")
        };
        let internal = self.internal_words(system);
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
        let mut text = match internal.is_empty() && silent == [at] {
            true => {
                silent.clear();
                format!("{balance}: the impulse there has no moment.")
            }
            false => format!("{balance}.{internal}"),
        };
        for (places, one, several) in [
            (
                silent,
                "acts there and has no moment.",
                "act there and have no moment.",
            ),
            (
                through,
                "passes through it and has no moment about it.",
                "pass through it and have no moment about it.",
            ),
        ] {
            text.push_str(&words::impulses_at(&places, one, several));
        }
        if outside.is_empty() {
            let them = if system.len() > 1 { "them" } else { "it" };
            text.push_str(&format!(" No impulse acts on {them} from outside."));
        }
        self.say(&text);
    }

    /// H⁻ and H⁺ in vectors, evaluated.
    pub(super) fn angular_momentum(&mut self, system: &[usize], about: Place) {
        let o = words::point(self.scene, about);
        let index = match about {
            Place::Center(_) if self.scene.moving().count() == 1 => String::from("G"),
            // Of two balances about one point the second says whose it is.
            _ => match (
                self.told.insert(Symbol::from(format!("H about {o}"))),
                system,
            ) {
                (false, [b]) => format!("{o},{}", words::center(self.scene, *b)),
                _ => o.clone(),
            },
        };
        let outside: Vec<Outside> = self
            .outside(system, Some(about))
            .into_iter()
            .filter(|x| !x.moment.is_zero())
            .collect();
        let h = |mark| vector("H", &index, mark);
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
            let zero = Inline::Math(set("{} = {}", [h("-"), Expr::zero().into()]));
            self.text(fill(
                "{} {} at rest before, so {}.",
                [whom.into(), is.into(), zero],
            ));
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
            let arm = vector("r", &format!("{q}/{o}"), "");
            law.extend(set("+ {} × {}", [arm, vector("P", &q, "")]));
        }
        law.extend(set("= {}", [h("+")]));
        self.show(law, None);
        self.definition(system, about, vector("H", &index, ""));
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
        let (mut sum, mut inertias) = (Vec::new(), Vec::new());
        for &b in system {
            let c = words::center(self.scene, b);
            let arm = self.arm(&self.g.place(Place::Center(b)).clone(), about);
            let spins = !self.scene.bodies[b].is_particle() && !self.inertia_vanishes(b);
            let moves = !arm.iter().all(Expr::is_zero) && !self.vanishes(&self.g.mass(b).clone());
            if moves {
                let arm = vector("r", &format!("{c}/{o}"), "");
                let mass = self.g.mass(b).clone();
                let mass = Math::Factor(self.tidy(&mass));
                sum.push(set("{} × {} {}", [arm, mass, vector("v", &c, "")]));
            }
            if spins {
                let (inertia, value) = self.inertia_told(b);
                sum.push(vec![inertia, words::spin(self.scene, b, "")]);
                inertias.extend(value);
            }
        }
        if !sum.is_empty() {
            let mut math = set("{} =", [h]);
            math.extend(sum.join(&Math::Op("+")));
            self.show(math, None);
        }
        for math in inertias {
            self.show(math, None);
        }
    }

    /// How the moment of inertia of a body is written, and its value where that does not stand on the page: with its first use,
    /// or that of a body of parts where these are told.
    pub(super) fn inertia_told(&mut self, b: usize) -> (Math, Option<Vec<Math>>) {
        let inertia = self.inertia_name(b);
        let body = &self.scene.bodies[b];
        let by_parts = matches!(body.shape, Shape::Composite { .. }) && !body.inertia_given;
        let c = words::center(self.scene, b);
        let is_new = matches!(inertia, Math::Name(_))
            && !by_parts
            && self.told.insert(Symbol::from(format!("I of {c}")));
        let value = is_new.then(|| {
            let value = self.g.inertia(b).clone();
            set("{} = {}", [inertia.clone(), self.tidy(&value).into()])
        });
        let value = value.filter(|math| !self.solution.stood(math));
        (inertia, value)
    }

    /// The moment of an impulse from outside, evaluated.
    fn moment_of(&mut self, x: &Outside, about: Place) {
        let [o, q] = [about, x.place].map(|place| words::point(self.scene, place));
        let arm = self.arm(&self.g.place(x.place).clone(), about);
        let raw = &arm[0] * &x.impulse[1] - &arm[1] * &x.impulse[0];
        let parts = [
            vector("r", &format!("{q}/{o}"), ""),
            vector("P", &q, ""),
            arm.into(),
            x.impulse.clone().into(),
            Math::Along(x.moment.clone()),
        ];
        let math = set("{} × {} = ({}) × ({}) = {}", parts);
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
        let mut pieces = Vec::new();
        let mut raw = Vec::new();
        for (&b, (v, w)) in system.iter().zip(motion) {
            let mass = self.g.mass(b).clone();
            let mass = self.tidy(&mass);
            let arm = self.arm(&self.g.place(Place::Center(b)).clone(), about);
            let moves = !v.iter().all(Expr::is_zero) && !arm.iter().all(Expr::is_zero);
            raw.push(&mass * cross(&arm, v));
            if moves && !mass.is_zero() {
                let parts = [arm.into(), Math::Factor(mass), v.clone().into()];
                pieces.push(set("({}) × {} ({})", parts));
            }
            if !self.scene.bodies[b].is_particle() && !self.inertia_vanishes(b) && !w.is_zero() {
                let inertia = self.g.inertia(b).clone();
                let inertia = self.tidy(&inertia);
                let turns = [Math::Factor(inertia.clone()), Math::Along(w.clone())];
                pieces.push(set("{} ({})", turns));
                raw.push(&inertia * w);
            }
        }
        let left = Expr::sum(raw);
        let value = self.tidy(&left);
        // I ω alone is the value already.
        let spins =
            |piece: &Vec<Math>| matches!(piece.as_slice(), [Math::Factor(_), Math::Brackets(_)]);
        if pieces.len() == 1 && pieces.iter().all(spins) {
            pieces.clear();
        }
        let mut math = set("{} =", [symbol]);
        if !pieces.is_empty() {
            math.extend(pieces.join(&Math::Op("+")));
            math.push(Math::Op("="));
        }
        math.push(Math::Along(value.clone()));
        let claim = Claim::new(left, value);
        let id = self.step(Vec::new(), vec![claim], reason);
        self.show(math, Some(id));
    }
}
