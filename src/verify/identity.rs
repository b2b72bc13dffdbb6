//! Identities: the motion put into every equation, and short forms beside closed ones.
//!
//! In: a derivation, as it claims its answers. Out: checks that are decisions of the algebra, not tests. Where the motion
//! is given in named parts, it is put into the equations as it stands, each part a symbol of its own; then what the parts
//! stand for is put in one after the other, so that what cancels does so before anything is multiplied out.

use std::collections::BTreeMap;

use super::meanings;
use crate::algebra::{Element, Field, Stop};
use crate::answer::{Answer, Check};
use crate::derive::Derivation;
use crate::equality::{self, Equality};
use crate::expr::{Expr, Symbol};
use crate::laws::{self, Geometry, Kinematics, Law, Unknown};
use crate::scene::{Ask, EnergyWhen, Scene};

/// The identities of a derivation.
pub(super) struct Identities<'a> {
    scene: &'a Scene,
    derivation: &'a Derivation,
    field: Field,
    meanings: BTreeMap<Symbol, Expr>,
    /// Named parts with what they stand for, in parameters alone.
    parts: Vec<(Symbol, Element)>,
}

impl<'a> Identities<'a> {
    pub(super) fn new(scene: &'a Scene, derivation: &'a Derivation) -> Identities<'a> {
        Identities {
            scene,
            derivation,
            field: Field::new(&scene.domains),
            meanings: meanings(derivation),
            parts: Vec::new(),
        }
    }

    /// The motion put into every equation of the full system.
    pub(super) fn of_motion(&mut self) -> Check {
        if self.derivation.in_steps {
            return Check::new(
                "identity",
                "not carried out: solved in steps, too long to be multiplied out; the exact points decide",
                None,
            );
        }
        match self.count() {
            Ok((0, failed)) if failed.is_empty() => Check::new(
                "identity",
                "nothing is determined, so nothing can be substituted into the equations",
                None,
            ),
            Ok((held, failed)) if failed.is_empty() => Check::new(
                "identity",
                format!("identity in all {held} equations of the full system that are determined"),
                Some(true),
            ),
            Ok((_, failed)) => {
                let refuted = failed.iter().filter(|(_, rest)| self.is_refuted(rest));
                let refuted: Vec<String> = refuted.map(|(law, _)| law.clone()).collect();
                let all = |laws: Vec<String>| laws.join(", ");
                let (words, holds) = if refuted.is_empty() {
                    let open = all(failed.into_iter().map(|(law, _)| law).collect());
                    (format!("undecided for {open}"), None)
                } else {
                    (format!("does not satisfy {}", all(refuted)), Some(false))
                };
                Check::new("identity", words, holds)
            }
            Err(stop) => Check::new("identity", format!("not carried out: {stop}"), None),
        }
    }

    /// The number of equations that hold, and of the others the law and what remains of it.
    fn count(&mut self) -> Result<(usize, Vec<(String, Expr)>), Stop> {
        let scene = self.scene;
        let g = Geometry::symbolic(scene);
        let full = Kinematics::full(scene, &g);
        let written = |law: &Law| laws::symbolic(scene, &g, &full, law);
        let laws = laws::of(scene);
        let equations: Vec<_> = laws.iter().map(|law| (law, written(law))).collect();
        let motion = &self.derivation.motion;
        let mut all: Vec<&Expr> = motion.values().collect();
        for (_, linear) in &equations {
            all.push(&linear.known);
            all.extend(linear.terms.iter().map(|(_, k)| k));
        }
        self.field.prepare(all);
        self.read_parts()?;
        let mut values = BTreeMap::new();
        for unknown in laws::unknowns(scene) {
            let value = match self.value(unknown) {
                Some(value) => value.clone(),
                // Not determined: whatever its value, the equations must hold.
                None => Expr::symbol(self.derivation.names.plain(unknown)),
            };
            values.insert(unknown, self.field.element(&value)?);
        }
        let mut held = 0;
        let mut failed = Vec::new();
        for (law, linear) in equations {
            let open = |u: &Unknown| !motion.contains_key(u);
            if linear.terms.iter().any(|(u, _)| open(u)) {
                continue;
            }
            let mut total = self.field.element(&-&linear.known)?;
            for (unknown, k) in &linear.terms {
                let k = self.field.element(k)?;
                let term = self.field.mul(&k, &values[unknown])?;
                total = self.field.add(&total, &term)?;
            }
            let total = self.put_in(total)?;
            if self.field.is_zero(&total) {
                held += 1;
            } else {
                failed.push((laws::describe(scene, law), self.field.expr(&total)));
            }
        }
        Ok((held, failed))
    }

    /// The value of an unknown, in named parts where it is given so: these must be the motion that all else uses.
    fn value(&self, unknown: Unknown) -> Option<&'a Expr> {
        let closed = self.derivation.motion.get(&unknown)?;
        let named = self.derivation.named.get(&unknown);
        Some(
            named
                .filter(|e| e.substitute(&self.meanings) == *closed)
                .unwrap_or(closed),
        )
    }

    /// What named parts stand for.
    fn read_parts(&mut self) -> Result<(), Stop> {
        for definition in &self.derivation.definitions {
            let value = self.field.element(&self.meanings[&definition.name])?;
            self.parts.push((definition.name.clone(), value));
        }
        Ok(())
    }

    /// What is left once the parts are put in, one after the other until nothing is.
    fn put_in(&self, mut total: Element) -> Result<Element, Stop> {
        for (name, value) in &self.parts {
            if self.field.is_zero(&total) {
                break;
            }
            total = self.field.put(&total, name, value)?;
        }
        Ok(total)
    }

    /// The short form of an answer, with its definitions put in, against the closed form; an energy against that of the
    /// motion as well.
    pub(super) fn of_answer(&mut self, answer: &Answer, closed: &Expr, short: &Expr) -> Check {
        let asked = self.scene.question_of_impact(&answer.question);
        let of_motion = match asked.map(|q| &q.ask) {
            Some(Ask::Energy { when, of }) if !self.derivation.named.is_empty() => {
                self.beside_energy(*when, *of, short)
            }
            _ => Ok(Expr::zero()),
        };
        let rests = of_motion.and_then(|rest| Ok([rest, self.beside(closed, short)?]));
        let (words, holds) = match rests {
            Ok(rests) if rests.iter().all(Expr::is_zero) => {
                ("short form identical to the closed form".into(), Some(true))
            }
            Ok(rests) if rests.iter().any(|rest| self.is_refuted(rest)) => (
                "short form differs from the closed form".into(),
                Some(false),
            ),
            Ok(_) => (
                "not decided whether the short form is the closed form".into(),
                None,
            ),
            Err(stop) => (format!("not carried out: {stop}"), None),
        };
        Check::new("definitions", words, holds)
    }

    /// Whether a remainder is somewhere not zero: that the normal form does not find it to be zero does not say so.
    fn is_refuted(&self, rest: &Expr) -> bool {
        let decision = equality::decide(rest, &Expr::zero(), &self.scene.domains);
        matches!(decision.equality, Equality::Different(_))
    }

    /// By how much the closed form differs from the short one.
    fn beside(&self, closed: &Expr, short: &Expr) -> Result<Expr, Stop> {
        let expanded = short.substitute(&self.meanings);
        if expanded == *closed {
            return Ok(Expr::zero());
        }
        let (field, a, b) = Field::pair(&self.scene.domains, closed, &expanded)?;
        Ok(field.expr(&field.sub(&a, &b)?))
    }

    /// By how much the kinetic energy of the motion differs from a formula.
    fn beside_energy(
        &mut self,
        when: EnergyWhen,
        of: Option<usize>,
        short: &Expr,
    ) -> Result<Expr, Stop> {
        let scene = self.scene;
        let mut terms = vec![-short];
        for (b, body) in scene.bodies.iter().enumerate() {
            if body.is_fixed() || of.is_some_and(|o| o != b) {
                continue;
            }
            let zero = Expr::zero();
            let mut add = |weight: &Expr, before: &Expr, after: Option<&Expr>| {
                let after = after.unwrap_or(&zero).powi(2);
                let squares = match when {
                    EnergyWhen::Before => before.powi(2),
                    EnergyWhen::After => after,
                    EnergyWhen::Lost => before.powi(2) - after,
                };
                terms.push(Expr::ratio(1, 2) * weight * squares);
            };
            for (axis, before) in body.velocity.iter().enumerate() {
                add(&body.mass, before, self.value(Unknown::Velocity(b, axis)));
            }
            if !body.is_particle() {
                add(&body.inertia, &body.spin, self.value(Unknown::Spin(b)));
            }
        }
        let mut total = self.field.integer(0);
        for term in terms {
            let term = self.field.element(&term)?;
            total = self.field.add(&total, &term)?;
        }
        let left = self.put_in(total)?;
        Ok(self.field.expr(&left))
    }
}
