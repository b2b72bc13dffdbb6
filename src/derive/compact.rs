//! Long answers as a person writes them: the impulse first, the rest in terms of it, common parts named.
//!
//! For one contact between bodies that are otherwise free, u⁺ = u⁻ + W P holds at the contact, with W the inverse
//! effective mass, and every velocity is its value before plus the impulse over its own inertia. That form is short, says
//! what is going on, and is exactly the one the equations give before anything is multiplied out. Elsewhere long answers
//! are written in terms of the impulses and the other unknowns the equations were solved for. A short answer is left alone.

use std::collections::BTreeMap;

use super::{Definition, Stop, Work};
use crate::algebra::Element;
use crate::answer::{Answer, Form};
use crate::expr::{Expr, Vector, cross, minus};
use crate::formula::write_plain;
use crate::laws::{Kinematics, Unknown};
use crate::scene::{Ask, ContactLaw, EnergyWhen, Question, Scene};

/// An answer of at most this many characters is printed in full.
const LONG: usize = 110;
/// A common part of more characters than this gets a name.
const NAMED: usize = 9;

/// Shortens the answers that are long, adding the definitions they use.
pub(super) fn shorten(
    work: &mut Work<'_>,
    answers: &mut [Answer],
    definitions: &mut Vec<Definition>,
) -> Result<(), Stop> {
    let is_long = |form: &Form| matches!(form, Form::Value { closed, .. } if write_plain(closed).len() > LONG);
    if !work.in_steps && !answers.iter().any(|a| is_long(&a.form)) {
        return Ok(());
    }
    let staged = std::mem::take(&mut work.definitions);
    let mut parts = Parts {
        motion: work.reduced.clone(),
        work,
        definitions: staged,
        lost: None,
    };
    // What was solved step by step is as short as it gets.
    let values = if parts.work.in_steps {
        None
    } else {
        parts.values()?
    }
    .unwrap_or_default();
    for answer in answers.iter_mut().filter(|_| !values.is_empty()) {
        let Some(question) = parts
            .work
            .scene
            .asked_of_impact()
            .find(|q| q.name == answer.question)
            .cloned()
        else {
            continue;
        };
        if let Form::Value { closed, short } = &mut answer.form
            && let Some(written) = parts.rewritten(&question, &answer.name, &values)?
            && write_plain(&written).len() < write_plain(closed).len()
            && write_plain(closed).len() > LONG / 2
        {
            *short = written;
        }
    }
    // An answer that is nothing but a definition shows its value.
    for answer in answers.iter_mut() {
        if let Form::Value { short, closed } = &mut answer.form {
            let defined = parts
                .definitions
                .iter()
                .find(|d| short.as_symbol() == Some(&d.name));
            if let Some(definition) = defined {
                if closed == short {
                    *closed = definition.value.clone();
                }
                *short = definition.value.clone();
            }
        }
    }
    let mut needed: Vec<Expr> = answers
        .iter()
        .filter_map(|a| match &a.form {
            Form::Value { short, .. } => Some(short.clone()),
            _ => None,
        })
        .collect();
    let mut kept = Vec::new();
    for definition in parts.definitions.into_iter().rev() {
        if needed
            .iter()
            .any(|e| e.symbols().contains(&definition.name))
        {
            needed.push(definition.value.clone());
            kept.push(definition);
        }
    }
    kept.reverse();
    definitions.extend(kept);
    Ok(())
}

struct Parts<'w, 'a> {
    work: &'w mut Work<'a>,
    /// The motion in the unknowns that have short values.
    motion: Kinematics<Expr>,
    definitions: Vec<Definition>,
    /// Kinetic energy lost by all bodies, −½ P·(u⁻ + u⁺).
    lost: Option<Expr>,
}

impl Parts<'_, '_> {
    /// Each reduced unknown in terms of named parts; `None` where nothing is gained.
    fn values(&mut self) -> Result<Option<BTreeMap<Unknown, Expr>>, Stop> {
        let scene = self.work.scene;
        let alone = scene.contacts.len() == 1
            && scene.hinges.is_empty()
            && scene.blows.is_empty()
            && scene.after.is_empty();
        match (alone, scene.contacts.first().map(|c| &c.law)) {
            (true, Some(ContactLaw::Frictionless { restitution })) => {
                self.frictionless(&restitution.clone()).map(Some)
            }
            (true, Some(ContactLaw::Sticking))
                if scene.contacts[0]
                    .bodies
                    .iter()
                    .all(|&b| !scene.bodies[b].is_fixed()) =>
            {
                self.sticking().map(Some)
            }
            _ => self.solved(),
        }
    }

    /// P = (1+e) u / W with W = Σ (1/m + h²/I), u the speed of approach along n, h the arm of n about each center.
    fn frictionless(&mut self, e: &Expr) -> Result<BTreeMap<Unknown, Expr>, Stop> {
        let scene = self.work.scene;
        let contact = &scene.contacts[0];
        let normal = contact
            .normal
            .clone()
            .unwrap_or([Expr::zero(), Expr::zero()]);
        let approach = approach(scene);
        let speed = -(&approach[0] * &normal[0] + &approach[1] * &normal[1]);
        let speed = self.tidy(&speed)?;
        let mut inverse_mass = Vec::new();
        let mut values = BTreeMap::new();
        let impulse = Expr::symbol(self.work.names.plain(Unknown::Normal(0)));
        let mut pending = Vec::new();
        for (side, &b) in contact.bodies.iter().enumerate() {
            let body = &scene.bodies[b];
            if body.is_fixed() {
                continue;
            }
            let sign = if side == 0 {
                Expr::from(-1)
            } else {
                Expr::one()
            };
            inverse_mass.push(self.tidy(&body.mass.powi(-1))?);
            for (axis, n) in normal.iter().enumerate() {
                let before = self.tidy(&body.velocity[axis])?;
                let gain = self.tidy(&(&sign * n / &body.mass))?;
                pending.push((Unknown::Velocity(b, axis), before, gain));
            }
            if !body.is_particle() {
                let arm = self.tidy(&cross(&minus(&contact.at, &body.center), &normal))?;
                let arm = self.named(
                    &format!("h{}", side + 1),
                    arm,
                    &format!("arm of the normal about the center of {}", body.name),
                );
                let share = self.tidy(&(&arm.powi(2) / &body.inertia))?;
                if !share.is_zero() {
                    inverse_mass.push(share);
                }
                let before = self.tidy(&body.spin)?;
                let gain = self.tidy(&(&sign * &arm / &body.inertia))?;
                pending.push((Unknown::Spin(b), before, gain));
            }
        }
        let speed = self.named(
            "u_n",
            speed,
            "speed at which the touching points approach each other along the normal, just before",
        );
        let size = (Expr::one() + e) * &speed / Expr::sum(inverse_mass);
        self.lost = Some((Expr::one() - e) * &speed * &impulse * Expr::ratio(1, 2));
        self.define(
            &impulse,
            size,
            "impulse on the second body along the normal",
        );
        values.insert(Unknown::Normal(0), impulse.clone());
        for (unknown, before, gain) in pending {
            values.insert(unknown, before + gain * &impulse);
        }
        Ok(values)
    }

    /// P = −W⁻¹ u with the symmetric 2 × 2 matrix W = [[a, b], [b, c]] in x and y.
    fn sticking(&mut self) -> Result<BTreeMap<Unknown, Expr>, Stop> {
        let scene = self.work.scene;
        let contact = &scene.contacts[0];
        let approach = approach(scene);
        let [ux, uy] = [0, 1].map(|axis| approach[axis].clone());
        let (ux, uy) = (self.tidy(&ux)?, self.tidy(&uy)?);
        let words =
            "velocity of the second body relative to the first, at the contact, just before";
        let ux = self.named("u_x", ux, words);
        let uy = self.named("u_y", uy, words);
        let (mut a, mut b, mut c) = (Vec::new(), Vec::new(), Vec::new());
        let mut arms = Vec::new();
        for (side, &i) in contact.bodies.iter().enumerate() {
            let body = &scene.bodies[i];
            let inverse = self.tidy(&body.mass.powi(-1))?;
            a.push(inverse.clone());
            c.push(inverse);
            let r = minus(&contact.at, &body.center);
            let (x, y) = (self.tidy(&r[0])?, self.tidy(&r[1])?);
            let words = format!("arm from the center of {} to the contact", body.name);
            let x = self.named(&format!("r{}_x", side + 1), x, &words);
            let y = self.named(&format!("r{}_y", side + 1), y, &words);
            if !body.is_particle() {
                let inertia = self.tidy(&body.inertia)?;
                a.push(&y.powi(2) / &inertia);
                b.push(-(&x * &y / &inertia));
                c.push(&x.powi(2) / &inertia);
            }
            arms.push([x, y]);
        }
        let words = "entry of the inverse effective mass at the contact";
        let a = self.named("a_W", Expr::sum(a), words);
        let b = self.named("b_W", Expr::sum(b), words);
        let c = self.named("c_W", Expr::sum(c), words);
        let det = self.named(
            "D_W",
            &a * &c - b.powi(2),
            "determinant of the inverse effective mass",
        );
        let sizes = [(&b * &uy - &c * &ux) / &det, (&b * &ux - &a * &uy) / &det];
        let impulse = [0, 1].map(|axis| {
            let words = format!("impulse at the contact along {}", ["x", "y"][axis]);
            self.define_unknown(Unknown::Contact(0, axis), sizes[axis].clone(), &words)
        });
        self.lost = Some(-(&impulse[0] * &ux + &impulse[1] * &uy) * Expr::ratio(1, 2));
        self.motion = Kinematics::full(scene, &self.work.g);
        let mut values = BTreeMap::new();
        for (side, &i) in contact.bodies.iter().enumerate() {
            let body = &scene.bodies[i];
            let sign = if side == 0 {
                Expr::from(-1)
            } else {
                Expr::one()
            };
            for (axis, p) in impulse.iter().enumerate() {
                let before = self.tidy(&body.velocity[axis])?;
                values.insert(Unknown::Velocity(i, axis), before + &sign * p / &body.mass);
                values.insert(Unknown::Contact(0, axis), p.clone());
            }
            if !body.is_particle() {
                let before = self.tidy(&body.spin)?;
                let moment = &arms[side][0] * &impulse[1] - &arms[side][1] * &impulse[0];
                values.insert(
                    Unknown::Spin(i),
                    before + &sign * moment / self.tidy(&body.inertia)?,
                );
            }
        }
        Ok(values)
    }

    /// Elsewhere: every unknown whose closed form is long stands for itself, or for what impulses make of a free body.
    fn solved(&mut self) -> Result<Option<BTreeMap<Unknown, Expr>>, Stop> {
        let mut values: BTreeMap<Unknown, Expr> = BTreeMap::new();
        let mut solved: Vec<(Unknown, Element)> = self
            .work
            .values
            .iter()
            .map(|(u, v)| (*u, v.clone()))
            .collect();
        solved.sort_by_key(|(unknown, _)| !unknown.is_impulse());
        for (unknown, value) in solved {
            let closed = self.work.field.expr(&value);
            let length = write_plain(&closed).len();
            let value = match self.pushed(unknown, &values)? {
                Some(short) if write_plain(&short).len() < length => short,
                _ if length > NAMED => self.define_unknown(unknown, closed, "as solved above"),
                _ => closed,
            };
            values.insert(unknown, value);
        }
        Ok((!self.definitions.is_empty()).then_some(values))
    }

    /// A velocity or spin of a body that only smooth contacts act on: its value before plus the impulses over the inertia.
    fn pushed(
        &mut self,
        unknown: Unknown,
        values: &BTreeMap<Unknown, Expr>,
    ) -> Result<Option<Expr>, Stop> {
        let scene = self.work.scene;
        let (Unknown::Velocity(b, _) | Unknown::Spin(b)) = unknown else {
            return Ok(None);
        };
        let body = &scene.bodies[b];
        let held = scene.hinges.iter().any(|h| h.bodies.contains(&b))
            || scene.blows.iter().any(|blow| blow.body == b);
        if held {
            return Ok(None);
        }
        let mut total = match unknown {
            Unknown::Velocity(_, axis) => self.tidy(&body.velocity[axis])?,
            _ => self.tidy(&body.spin)?,
        };
        for (k, contact) in scene.contacts.iter().enumerate() {
            let Some(side) = contact.bodies.iter().position(|&i| i == b) else {
                continue;
            };
            let (Some(normal), Some(impulse)) = (&contact.normal, values.get(&Unknown::Normal(k)))
            else {
                return Ok(None);
            };
            let share = match unknown {
                Unknown::Velocity(_, axis) => &normal[axis] / &body.mass,
                _ => cross(&minus(&contact.at, &body.center), normal) / &body.inertia,
            };
            let share = self.tidy(&if side == 0 { -share } else { share })?;
            total = total + share * impulse;
        }
        Ok(Some(total))
    }

    /// An answer with the unknowns replaced by their short values.
    fn rewritten(
        &mut self,
        question: &Question,
        name: &str,
        values: &BTreeMap<Unknown, Expr>,
    ) -> Result<Option<Expr>, Stop> {
        if let Ask::Energy {
            when: EnergyWhen::Lost,
            of: None,
        } = question.ask
        {
            return Ok(self.lost.clone());
        }
        let Some(forms) = self.work.linear_forms(&question.ask, &self.motion) else {
            return Ok(None);
        };
        let wanted = |suffix: &str| match suffix {
            "" => question.name == name,
            axis => format!("{}_{axis}", question.name) == name,
        };
        for (suffix, form) in forms {
            if wanted(suffix) {
                let mut total = self.tidy(&form.constant)?;
                for (unknown, k) in &form.terms {
                    let k = self.tidy(k)?;
                    if k.is_zero() {
                        continue;
                    }
                    let Some(value) = values.get(unknown) else {
                        return Ok(None);
                    };
                    total = total + k * value;
                }
                return Ok(Some(total));
            }
        }
        Ok(None)
    }

    fn tidy(&mut self, e: &Expr) -> Result<Expr, Stop> {
        self.work.tidy(e)
    }

    /// The expression itself if it is short, else a new symbol for it.
    fn named(&mut self, wanted: &str, value: Expr, meaning: &str) -> Expr {
        if write_plain(&value).len() <= NAMED {
            return value;
        }
        let name = self.work.names.fresh(wanted);
        let symbol = Expr::symbol(&name);
        self.define(&symbol, value, meaning);
        symbol
    }

    /// Defines an unknown's own symbol; gives the unknown in terms of it.
    fn define_unknown(&mut self, unknown: Unknown, value: Expr, meaning: &str) -> Expr {
        let symbol = Expr::symbol(self.work.names.plain(unknown));
        if self.work.names.is_reversed(unknown) {
            self.define(&symbol, -value, meaning);
            -symbol
        } else {
            self.define(&symbol, value, meaning);
            symbol
        }
    }

    fn define(&mut self, symbol: &Expr, value: Expr, meaning: &str) {
        if let Some(name) = symbol.as_symbol() {
            self.definitions.push(Definition {
                name: name.clone(),
                value,
                meaning: meaning.to_string(),
            });
        }
    }
}

/// Relative velocity just before of the touching points of the only contact, second body minus first.
fn approach(scene: &Scene) -> Vector {
    let contact = &scene.contacts[0];
    let point = |b: usize| {
        let body = &scene.bodies[b];
        let r = minus(&contact.at, &body.center);
        [
            &body.velocity[0] - &(&body.spin * &r[1]),
            &body.velocity[1] + &(&body.spin * &r[0]),
        ]
    };
    minus(&point(contact.bodies[1]), &point(contact.bodies[0]))
}
