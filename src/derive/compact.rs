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
use crate::expr::{Expr, Symbol, cross, minus};
use crate::formula::write_plain;
use crate::laws::{Affine, Kinematics, Unknown};
use crate::scene::{Ask, ContactLaw, EnergyWhen, Scene};

/// An answer of at most this many characters is printed in full.
const LONG: usize = 75;
/// A common part of more characters than this gets a name.
const NAMED: usize = 9;

/// A contact of two bodies whose impulse has about so many terms is given in named parts from the start: the number of
/// terms of the speed of approach times that of the inverse effective mass.
const MANY: usize = 32;

/// Unknowns in terms of named parts.
pub(super) struct Parts {
    /// Each unknown of `motion` in parameters and definitions.
    values: BTreeMap<Unknown, Expr>,
    /// The motion in these unknowns.
    motion: Kinematics<Expr>,
    definitions: Vec<Definition>,
    /// What the definitions stand for, in parameters alone.
    meant: BTreeMap<Symbol, Expr>,
    /// Kinetic energy lost by all bodies, −½ P·(u⁻ + u⁺) and the work on what moves as it must.
    lost: Option<Expr>,
}

/// The work that an impulse on the second body does on what is fixed and moves as it must, such as a wall.
fn taken_by_walls(work: &mut Work<'_>, impulse: &[Expr; 2]) -> Result<Expr, Stop> {
    let contact = &work.scene.contacts[0];
    let fixed = [-1, 1].into_iter().zip(contact.bodies);
    let fixed = fixed.filter(|(_, b)| work.scene.bodies[*b].is_fixed());
    let taken = fixed.map(|(sign, b)| {
        let [x, y] = work.scene.bodies[b].velocity_at(&contact.at);
        Expr::from(sign) * (&impulse[0] * &x + &impulse[1] * &y)
    });
    work.tidy(&Expr::sum(taken.collect::<Vec<_>>()))
}

/// The impact of two bodies at one contact in named parts, where anything multiplied out would be long. The form is that
/// of [`Parts::frictionless`] and [`Parts::sticking`]: nothing is solved, and `verify` holds it against every law.
pub(super) fn of_two(work: &mut Work<'_>) -> Result<Option<Parts>, Stop> {
    let scene = work.scene;
    let Some(law) = lone_contact(scene) else {
        return Ok(None);
    };
    let mut parts = Parts::new(work, Vec::new());
    if !work.has_positive_masses() || parts.terms(work, law)? < MANY {
        return Ok(None);
    }
    parts.impact(work, law)?;
    Ok(Some(parts))
}

/// The law of the contact that is all that happens; sticking to a body whose motion is prescribed is short anyway.
fn lone_contact(scene: &Scene) -> Option<&ContactLaw> {
    let alone = scene.contacts.len() == 1
        && scene.hinges.is_empty()
        && scene.blows.is_empty()
        && scene.after.is_empty();
    let contact = scene.contacts.first().filter(|_| alone)?;
    let moving = |b: &usize| !scene.bodies[*b].is_fixed();
    match &contact.law {
        ContactLaw::Frictionless { .. } => Some(&contact.law),
        ContactLaw::Sticking if contact.bodies.iter().all(moving) => Some(&contact.law),
        _ => None,
    }
}

/// Shortens the answers that are long, adding the definitions they use.
pub(super) fn shorten(
    work: &mut Work<'_>,
    answers: &mut [Answer],
    definitions: &mut Vec<Definition>,
) -> Result<(), Stop> {
    let is_long = |form: &Form| matches!(form, Form::Value { closed, .. } if write_plain(closed).len() > LONG);
    let parts = match work.parts.take() {
        Some(parts) => parts,
        None if !work.in_steps && !answers.iter().any(|a| is_long(&a.form)) => return Ok(()),
        None => {
            let staged = std::mem::take(&mut work.definitions);
            let mut parts = Parts::new(work, staged);
            // What was solved step by step is as short as it gets.
            if !work.in_steps {
                match lone_contact(work.scene) {
                    Some(law) => parts.impact(work, law)?,
                    None => parts.solved(work)?,
                }
                parts.rewrite(work, answers)?;
            }
            parts
        }
    };
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

impl Parts {
    fn new(work: &Work<'_>, definitions: Vec<Definition>) -> Parts {
        Parts {
            values: BTreeMap::new(),
            motion: work.reduced.clone(),
            definitions,
            meant: BTreeMap::new(),
            lost: None,
        }
    }

    fn impact(&mut self, work: &mut Work<'_>, law: &ContactLaw) -> Result<(), Stop> {
        match law {
            ContactLaw::Frictionless { restitution } => self.frictionless(work, restitution)?,
            _ => self.sticking(work)?,
        }
        self.bystanders(work)
    }

    /// What touches nothing keeps its motion.
    fn bystanders(&mut self, work: &mut Work<'_>) -> Result<(), Stop> {
        let scene = work.scene;
        for (b, body) in scene.bodies.iter().enumerate() {
            if body.is_fixed() || scene.contacts[0].bodies.contains(&b) {
                continue;
            }
            for (axis, before) in body.velocity.iter().enumerate() {
                let before = work.tidy(before)?;
                self.values.insert(Unknown::Velocity(b, axis), before);
            }
            let before = work.tidy(&body.spin)?;
            self.values.insert(Unknown::Spin(b), before);
        }
        Ok(())
    }

    /// About how many terms an impulse has when it is multiplied out.
    fn terms(&self, work: &mut Work<'_>, law: &ContactLaw) -> Result<usize, Stop> {
        let scene = work.scene;
        let contact = &scene.contacts[0];
        let mut terms = |e: &Expr| Ok::<_, Stop>(work.field.element(e)?.terms());
        let approach = scene.contacts[0].relative_velocity(scene);
        let arms = contact.bodies.map(|b| {
            let body = &scene.bodies[b];
            let extended = !body.is_fixed() && !body.is_particle();
            extended.then(|| minus(&contact.at, &body.center))
        });
        if let (ContactLaw::Frictionless { .. }, Some(n)) = (law, &contact.normal) {
            let speed = terms(&(&approach[0] * &n[0] + &approach[1] * &n[1]))?;
            let mut inverse_mass = 2;
            for arm in arms.iter().flatten() {
                inverse_mass += terms(&cross(arm, n).powi(2))?;
            }
            return Ok(speed * inverse_mass);
        }
        // A common factor of both components stays one.
        let direction = terms(&(&approach[0] / &approach[1])).unwrap_or(usize::MAX);
        let speed = terms(&approach[0])? + terms(&approach[1])?;
        let speed = speed.min(direction.saturating_add(1));
        let (mut a, mut c) = (2, 2);
        for [x, y] in arms.iter().flatten() {
            a += terms(&y.powi(2))?;
            c += terms(&x.powi(2))?;
        }
        Ok(speed * a * c)
    }

    /// An expression in parameters alone.
    fn meant(&self, e: &Expr) -> Expr {
        e.substitute(&self.meant)
    }

    /// The value of an unknown, in parameters and definitions.
    pub(super) fn value(&self, unknown: Unknown) -> Option<&Expr> {
        self.values.get(&unknown)
    }

    /// The values of all unknowns, in parameters and definitions.
    pub(super) fn all(&self) -> BTreeMap<Unknown, Expr> {
        self.values.clone()
    }

    /// The closed form of an unknown, in parameters alone.
    pub(super) fn closed(&self, unknown: Unknown) -> Option<Expr> {
        Some(self.meant(self.values.get(&unknown)?))
    }

    /// An answer in parameters and definitions, beside the same in parameters alone.
    fn form(&self, work: &mut Work<'_>, short: Expr) -> Result<Form, Stop> {
        let closed = self.meant(&short);
        if write_plain(&closed).len() > LONG / 2 {
            return Ok(Form::Value { closed, short });
        }
        Ok(Form::value(work.tidy(&closed)?))
    }

    /// An affine form with the values of the unknowns; `None` where one has none.
    fn put(&self, work: &mut Work<'_>, form: &Affine<Expr>) -> Result<Option<Expr>, Stop> {
        let mut total = work.tidy(&form.constant)?;
        for (unknown, k) in &form.terms {
            let k = work.tidy(k)?;
            if k.is_zero() {
                continue;
            }
            let Some(value) = self.values.get(unknown) else {
                return Ok(None);
            };
            total = total + k * value;
        }
        Ok(Some(total))
    }

    /// The motion after in the unknowns that have values.
    pub(super) fn motion(&self) -> &Kinematics<Expr> {
        &self.motion
    }

    /// The definitions.
    pub(super) fn definitions(self) -> Vec<Definition> {
        self.definitions
    }

    /// An affine form in the unknowns of [`Parts::motion`], in named parts; `None` where it is not determined.
    pub(super) fn linear(
        &self,
        work: &mut Work<'_>,
        form: &Affine<Expr>,
    ) -> Result<Option<Form>, Stop> {
        match self.put(work, form)? {
            Some(short) => self.form(work, short).map(Some),
            None => Ok(None),
        }
    }

    /// The answers in named parts where that makes them shorter.
    fn rewrite(&self, work: &mut Work<'_>, answers: &mut [Answer]) -> Result<(), Stop> {
        if self.values.is_empty() {
            return Ok(());
        }
        for answer in answers.iter_mut() {
            let Form::Value { closed, short } = &mut answer.form else {
                continue;
            };
            let Some(question) = work.scene.question_of_impact(&answer.question) else {
                continue;
            };
            let written = match &question.ask {
                Ask::Energy {
                    when: EnergyWhen::Lost,
                    of: None,
                } => self.lost.clone(),
                ask => {
                    let forms = work.linear_forms(ask, &self.motion).unwrap_or_default();
                    let own = |suffix: &str| match suffix {
                        "" => question.name == answer.name,
                        axis => format!("{}_{axis}", question.name) == answer.name,
                    };
                    match forms.into_iter().find(|(suffix, _)| own(suffix)) {
                        Some((_, form)) => self.put(work, &form)?,
                        None => None,
                    }
                }
            };
            let length = write_plain(closed).len();
            if let Some(written) = written
                && write_plain(&written).len() < length
                && length > LONG / 2
            {
                *short = written;
            }
        }
        Ok(())
    }

    /// P = (1+e) u / W with W = Σ (1/m + h²/I), u the speed of approach along n, h the arm of n about each center.
    fn frictionless(&mut self, work: &mut Work<'_>, e: &Expr) -> Result<(), Stop> {
        let scene = work.scene;
        let contact = &scene.contacts[0];
        let nothing = || [Expr::zero(), Expr::zero()];
        let normal = contact.normal.clone().unwrap_or_else(nothing);
        let approach = scene.contacts[0].relative_velocity(scene);
        let speed = -(&approach[0] * &normal[0] + &approach[1] * &normal[1]);
        let speed = work.tidy(&speed)?;
        let mut inverse_mass = Vec::new();
        let impulse = Expr::symbol(work.names.plain(Unknown::Normal(0)));
        let mut pending = Vec::new();
        for (side, &b) in contact.bodies.iter().enumerate() {
            let body = &scene.bodies[b];
            if body.is_fixed() {
                continue;
            }
            let sign = Expr::from([-1, 1][side]);
            inverse_mass.push(work.tidy(&body.mass.powi(-1))?);
            for (axis, n) in normal.iter().enumerate() {
                let before = work.tidy(&body.velocity[axis])?;
                let gain = work.tidy(&(&sign * n / &body.mass))?;
                pending.push((Unknown::Velocity(b, axis), before, gain));
            }
            if !body.is_particle() {
                let arm = work.tidy(&cross(&minus(&contact.at, &body.center), &normal))?;
                let words = format!("arm of the normal about the center of {}", body.name);
                let arm = self.named(work, &format!("h{}", side + 1), arm, &words);
                let share = work.tidy(&(&arm.powi(2) / &body.inertia))?;
                if !share.is_zero() {
                    inverse_mass.push(share);
                }
                let before = work.tidy(&body.spin)?;
                let gain = work.tidy(&(&sign * &arm / &body.inertia))?;
                pending.push((Unknown::Spin(b), before, gain));
            }
        }
        let words =
            "speed at which the touching points approach each other along the normal, just before";
        let speed = self.named(work, "u_n", speed, words);
        let size = (Expr::one() + e) * &speed / Expr::sum(inverse_mass);
        let lost = (Expr::one() - e) * &speed * &impulse * Expr::ratio(1, 2);
        let along = normal.each_ref().map(|n| n * &impulse);
        self.lost = Some(lost + taken_by_walls(work, &along)?);
        let words = "impulse on the second body along the normal";
        self.define(&impulse, size, words);
        for (unknown, before, gain) in pending {
            self.values.insert(unknown, before + gain * &impulse);
        }
        self.values.insert(Unknown::Normal(0), impulse);
        Ok(())
    }

    /// P = −W⁻¹ u with the symmetric 2 × 2 matrix W = [[a, b], [b, c]] in x and y.
    fn sticking(&mut self, work: &mut Work<'_>) -> Result<(), Stop> {
        let scene = work.scene;
        let contact = &scene.contacts[0];
        let approach = scene.contacts[0].relative_velocity(scene);
        let [ux, uy] = [0, 1].map(|axis| approach[axis].clone());
        let (ux, uy) = (work.tidy(&ux)?, work.tidy(&uy)?);
        let words =
            "velocity of the second body relative to the first, at the contact, just before";
        let ux = self.named(work, "u_x", ux, words);
        let uy = self.named(work, "u_y", uy, words);
        let (mut a, mut b, mut c) = (Vec::new(), Vec::new(), Vec::new());
        let mut arms = Vec::new();
        for (side, &i) in contact.bodies.iter().enumerate() {
            let body = &scene.bodies[i];
            let inverse = work.tidy(&body.mass.powi(-1))?;
            a.push(inverse.clone());
            c.push(inverse);
            let r = minus(&contact.at, &body.center);
            let (x, y) = (work.tidy(&r[0])?, work.tidy(&r[1])?);
            let words = format!("arm from the center of {} to the contact", body.name);
            let x = self.named(work, &format!("r{}_x", side + 1), x, &words);
            let y = self.named(work, &format!("r{}_y", side + 1), y, &words);
            if !body.is_particle() {
                let inertia = work.tidy(&body.inertia)?;
                for (sum, moment) in [(&mut a, y.powi(2)), (&mut c, x.powi(2))] {
                    let (inverse, share) = (sum.pop(), work.tidy(&(&moment / &inertia))?);
                    let apart = inverse.unwrap_or_else(Expr::zero) + share;
                    let joined = work.tidy(&apart)?;
                    let is_shorter = joined.size() < apart.size();
                    sum.push(if is_shorter { joined } else { apart });
                }
                let share = work.tidy(&(&x * &y / &inertia))?;
                if !share.is_zero() {
                    b.push(-share);
                }
            }
            arms.push([x, y]);
        }
        let words = "entry of the inverse effective mass at the contact";
        let a = self.named(work, "a_W", Expr::sum(a), words);
        let b = (!b.is_empty()).then(|| self.named(work, "b_W", Expr::sum(b), words));
        let c = self.named(work, "c_W", Expr::sum(c), words);
        let sizes = match b {
            None => [-(&ux / &a), -(&uy / &c)],
            Some(b) => {
                let words = "determinant of the inverse effective mass";
                let det = self.named(work, "D_W", &a * &c - b.powi(2), words);
                [(&b * &uy - &c * &ux) / &det, (&b * &ux - &a * &uy) / &det]
            }
        };
        let impulse = [0, 1].map(|axis| {
            let words = format!("impulse at the contact along {}", ["x", "y"][axis]);
            self.define_unknown(work, Unknown::Contact(0, axis), sizes[axis].clone(), &words)
        });
        let lost = -(&impulse[0] * &ux + &impulse[1] * &uy) * Expr::ratio(1, 2);
        self.lost = Some(lost + taken_by_walls(work, &impulse)?);
        self.motion = Kinematics::full(scene, &work.g);
        for (side, &i) in contact.bodies.iter().enumerate() {
            let body = &scene.bodies[i];
            let sign = Expr::from([-1, 1][side]);
            for (axis, p) in impulse.iter().enumerate() {
                let before = work.tidy(&body.velocity[axis])?;
                let after = before + &sign * p / &body.mass;
                self.values.insert(Unknown::Velocity(i, axis), after);
                self.values.insert(Unknown::Contact(0, axis), p.clone());
            }
            if !body.is_particle() {
                let before = work.tidy(&body.spin)?;
                let [x, y] = &arms[side];
                let inertia = work.tidy(&body.inertia)?;
                let [px, py] = &impulse;
                let gain = match (x.is_zero(), y.is_zero()) {
                    (_, true) => work.tidy(&(x / &inertia))? * py,
                    (true, false) => -(work.tidy(&(y / &inertia))? * px),
                    (false, false) => (x * py - y * px) / inertia,
                };
                let after = match x.is_zero() && y.is_zero() {
                    true => before,
                    false => before + sign * gain,
                };
                self.values.insert(Unknown::Spin(i), after);
            }
        }
        Ok(())
    }

    /// Elsewhere: every unknown asked for whose closed form is long stands for itself, or for what impulses make of a free
    /// body.
    fn solved(&mut self, work: &mut Work<'_>) -> Result<(), Stop> {
        let asked = work.scene.asked_of_impact();
        let forms = asked.filter_map(|q| work.linear_forms(&q.ask, &self.motion));
        let forms: Vec<Affine<Expr>> = forms.flatten().map(|(_, form)| form).collect();
        let is_used = |u: &Unknown| {
            let mut terms = forms.iter().flat_map(|form| &form.terms);
            matches!(u, Unknown::Normal(_)) || terms.any(|(v, _)| u == v)
        };
        let all = work.values.iter().filter(|(u, _)| is_used(u));
        let mut solved: Vec<(Unknown, Element)> = all.map(|(u, v)| (*u, v.clone())).collect();
        solved.sort_by_key(|(unknown, _)| !unknown.is_impulse());
        for (unknown, value) in solved {
            let closed = work.field.expr(&value);
            let length = write_plain(&closed).len();
            let value = match self.pushed(work, unknown)? {
                Some(short) if write_plain(&short).len() < length => short,
                _ if length > NAMED => {
                    self.define_unknown(work, unknown, closed, "as solved above")
                }
                _ => closed,
            };
            self.values.insert(unknown, value);
        }
        if self.definitions.is_empty() {
            self.values.clear();
        }
        Ok(())
    }

    /// A velocity or spin of a body that only smooth contacts act on: its value before plus the impulses over the inertia.
    fn pushed(&self, work: &mut Work<'_>, unknown: Unknown) -> Result<Option<Expr>, Stop> {
        let scene = work.scene;
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
            Unknown::Velocity(_, axis) => work.tidy(&body.velocity[axis])?,
            _ => work.tidy(&body.spin)?,
        };
        for (k, contact) in scene.contacts.iter().enumerate() {
            let Some(side) = contact.bodies.iter().position(|&i| i == b) else {
                continue;
            };
            let (Some(normal), Some(impulse)) =
                (&contact.normal, self.values.get(&Unknown::Normal(k)))
            else {
                return Ok(None);
            };
            let share = match unknown {
                Unknown::Velocity(_, axis) => &normal[axis] / &body.mass,
                _ => cross(&minus(&contact.at, &body.center), normal) / &body.inertia,
            };
            let share = work.tidy(&if side == 0 { -share } else { share })?;
            total = total + share * impulse;
        }
        Ok(Some(total))
    }

    /// Kinetic energy, in named parts; `None` where a velocity is not determined.
    pub(super) fn energy(
        &self,
        work: &mut Work<'_>,
        when: EnergyWhen,
        of: Option<usize>,
    ) -> Result<Option<Form>, Stop> {
        if let (EnergyWhen::Lost, None, Some(lost)) = (when, of, &self.lost) {
            return self.form(work, lost.clone()).map(Some);
        }
        let mut terms = Vec::new();
        for b in work.moving(of) {
            let body = &work.scene.bodies[b];
            let [x, y] = &self.motion.velocity[b];
            let before = [&body.velocity[0], &body.velocity[1], &body.spin];
            let mut squares = Vec::new();
            for (after, before) in [x, y, &self.motion.spin[b]].into_iter().zip(before) {
                let Some(after) = self.put(work, after)? else {
                    return Ok(None);
                };
                squares.push(match when {
                    EnergyWhen::Before => before.powi(2),
                    EnergyWhen::After => after.powi(2),
                    EnergyWhen::Lost => before.powi(2) - after.powi(2),
                });
            }
            let turning = squares.split_off(2);
            let half = Expr::ratio(1, 2);
            terms.push(&half * &body.mass * Expr::sum(squares));
            terms.push(&half * &body.inertia * Expr::sum(turning));
        }
        self.form(work, Expr::sum(terms)).map(Some)
    }

    /// The expression itself if it is short, else a new symbol for it.
    fn named(&mut self, work: &mut Work<'_>, wanted: &str, value: Expr, meaning: &str) -> Expr {
        if write_plain(&value).len() <= NAMED {
            return value;
        }
        let name = work.names.fresh(wanted);
        let symbol = Expr::symbol(&name);
        self.define(&symbol, value, meaning);
        symbol
    }

    /// Defines an unknown's own symbol; gives the unknown in terms of it.
    fn define_unknown(
        &mut self,
        work: &Work<'_>,
        unknown: Unknown,
        value: Expr,
        meaning: &str,
    ) -> Expr {
        let symbol = Expr::symbol(work.names.plain(unknown));
        self.define(&symbol, work.names.signed(unknown, value), meaning);
        work.names.signed(unknown, symbol)
    }

    fn define(&mut self, symbol: &Expr, value: Expr, meaning: &str) {
        if let Some(name) = symbol.as_symbol() {
            self.meant.insert(name.clone(), self.meant(&value));
            self.definitions.push(Definition {
                name: name.clone(),
                value,
                meaning: meaning.to_string(),
            });
        }
    }
}
