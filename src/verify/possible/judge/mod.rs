//! The rules, held against one impact.

mod meet;

use std::collections::BTreeMap;

use super::decide::{self, Decided, Values, decide};
use super::sides::{self, Sense, Side};
use super::{Condition, Possible, Rule, Verdict, concluded};
use crate::derive::Derivation;
use crate::expr::{Expr, Symbol, Vector, dot, minus};
use crate::laws::{self, Unknown};
use crate::scene::outline::Need;
use crate::scene::{Body, Contact, ContactLaw, Scene, Shape, touch};

/// Judges an impact. Bodies that begin in contact, at a support or on a string of these names, need not come together there: a
/// blow, or another contact, may press them on it even as they part.
pub fn judge(scene: &Scene, derivation: &Derivation, supports: &[&str]) -> Possible {
    let mut judge = Judge {
        scene,
        derivation,
        supports,
        values: Values::of(scene, derivation),
        conditions: Vec::new(),
        not_judged: Vec::new(),
        notes: Vec::new(),
    };
    if derivation.counting.contradictory {
        let words = String::from("the motion after, since the laws contradict each other");
        judge.not_judged.push(words);
    } else {
        for i in 0..scene.contacts.len() {
            judge.contact(i);
        }
        judge.energy();
        judge.without_outline();
    }
    let mut possible = judge.outcome();
    for (c, decided) in scene.decided() {
        if let Some(supposed) = decided.law.supposing {
            let words = supposed.of(&scene.contacts[c].name);
            for (need, _) in decided.excesses() {
                possible.suppose(&words, &need, &scene.values());
            }
        }
    }
    possible
}

struct Judge<'a> {
    scene: &'a Scene,
    derivation: &'a Derivation,
    supports: &'a [&'a str],
    values: Values,
    conditions: Vec<Condition>,
    not_judged: Vec<String>,
    notes: Vec<String>,
}

impl Judge<'_> {
    fn contact(&mut self, i: usize) {
        let contact = &self.scene.contacts[i];
        let name = &contact.name;
        for b in contact.bodies {
            self.place(contact, &self.scene.bodies[b]);
        }
        let sticks = contact.law == ContactLaw::Sticking;
        let [before, after] = [
            self.relative(contact, &contact.at, false),
            self.relative(contact, &contact.at, true),
        ];
        let impulse = self.impulse(i);
        if !sticks && !contact.passes && !contact.is_string {
            self.outlines_fit(contact);
        }
        let sides = sides::of(self.scene, contact);
        if sides.list.is_empty() && contact.passes {
            self.comes_out(name, dot(&before, &after), None);
        } else if sides.list.is_empty() && !sticks {
            self.without_normal(contact, &before, &after, &impulse);
        }
        for Side {
            normal,
            sense,
            is_given,
        } in &sides.list
        {
            let from = self.conditions.len();
            let alone = *is_given && self.acts_alone(contact);
            let opening = dot(&before, normal);
            let sense = match sense {
                Sense::Out => Expr::one(),
                Sense::ByApproach => -&opening,
            };
            let signed = |e: Expr| &sense * &e;
            let is_light = |b: &usize| self.scene.bodies[*b].is_light_pulley();
            let begins = self.supports.contains(&name.as_str());
            if (*is_given || !sticks) && !begins && !contact.bodies.iter().any(is_light) {
                self.claim(
                    Rule::Approach,
                    format!("the bodies approach at `{name}`"),
                    format!("the bodies separate at `{name}` before: they do not collide"),
                    signed(-&opening),
                    None,
                );
            }
            let approach = self.conditions[from..].first();
            let approach = approach.filter(|_| alone).map(Condition::decided);
            if contact.passes {
                self.comes_out(name, signed(-dot(&after, normal)), approach.as_ref());
            } else if !sticks {
                self.claim(
                    Rule::Apart,
                    format!("the bodies do not enter each other at `{name}`"),
                    format!("the bodies pass through each other at `{name}`"),
                    signed(dot(&after, normal)),
                    approach.as_ref(),
                );
            }
            let push = signed(dot(&impulse, normal));
            if sticks && *is_given {
                self.grip(name, &push);
            } else if !sticks {
                self.claim(
                    Rule::Push,
                    format!("the bodies push at `{name}`"),
                    format!("the bodies would have to pull each other at `{name}`"),
                    push,
                    approach.as_ref(),
                );
            }
            let approaches = self.conditions[from..]
                .iter()
                .all(|c| c.rule != Rule::Approach || c.verdict != Verdict::Nowhere);
            let is_free = contact.law == ContactLaw::None && !contact.passes;
            if is_free && approaches && !self.scene.gains_energy {
                let rest = dot(&before, normal) + dot(&after, normal);
                self.claim(
                    Rule::Restitution,
                    format!("the bodies leave `{name}` no faster than they came"),
                    format!("the bodies leave `{name}` faster than they came: e > 1"),
                    signed(-rest),
                    None,
                );
            }
        }
        if !contact.passes {
            self.along_sides(contact, &before, &sides);
        }
    }

    /// That a body without outline says nothing of where its contacts lie, where nothing else was to be judged: what sticks needs
    /// no normal.
    fn without_outline(&mut self) {
        if !self.conditions.is_empty() || !self.not_judged.is_empty() {
            return;
        }
        for contact in &self.scene.contacts {
            let bodies = contact.bodies.map(|b| &self.scene.bodies[b]);
            let shapeless = bodies.into_iter().find(|b| matches!(b.shape, Shape::Other));
            self.notes.extend(shapeless.map(|body| {
                let (at, body) = (&contact.name, &body.name);
                format!("`{body}` has no outline that `{at}` would have to lie on")
            }));
        }
    }

    /// What goes through a body comes out the way it went in.
    fn comes_out(&mut self, name: &str, forward: Expr, like: Option<&Decided>) {
        self.claim(
            Rule::Apart,
            format!("one body comes out behind the other at `{name}`"),
            format!("neither body gets through the other at `{name}`"),
            forward,
            like,
        );
    }

    /// What it takes for a contact to lie on a body, at the piece of its outline where that is best known; nothing for a particle.
    fn spot(&self, contact: &Contact, body: &Body) -> Option<Vec<(Need, decide::Decided)>> {
        if body.is_particle() {
            return None;
        }
        let spots = touch::spots(body, &contact.at, touch::may_lie_inside(contact));
        let mut best: Option<Vec<(Need, decide::Decided)>> = None;
        for spot in spots {
            let needs: Vec<(Need, decide::Decided)> = spot
                .needs
                .into_iter()
                .map(|need| {
                    let decided = decide::need(&need, &self.scene.domains);
                    (need, decided)
                })
                .collect();
            let rank = |needs: &[(Need, decide::Decided)]| {
                let of = |v| needs.iter().filter(|(_, d)| d.verdict == v).count();
                let equations = |(need, d): &&(Need, decide::Decided)| {
                    matches!(need, Need::Zero(_)) && d.verdict != Verdict::Everywhere
                };
                let equations = needs.iter().filter(equations).count();
                (
                    of(Verdict::Nowhere),
                    equations,
                    of(Verdict::Undecided),
                    of(Verdict::Where),
                )
            };
            if best.as_ref().is_none_or(|b| rank(&needs) < rank(b)) {
                best = Some(needs);
            }
        }
        best
    }

    /// Whether the contact lies on the body.
    fn place(&mut self, contact: &Contact, body: &Body) {
        if body.is_particle() || touch::is_second_latch(self.scene, contact) {
            return;
        }
        let best = self.spot(contact, body);
        // A string leaves one of them at its place and reaches the other along its line.
        let is_there = |spot: &Option<Vec<(Need, decide::Decided)>>| {
            let mut needs = spot.iter().flatten();
            needs.all(|(_, decided)| decided.verdict == Verdict::Everywhere)
        };
        if contact.is_string && !is_there(&best) {
            let bodies = contact.bodies.map(|b| &self.scene.bodies[b]);
            let mut others = bodies.into_iter().filter(|other| other.name != body.name);
            if others.any(|other| !other.is_fixed() && is_there(&self.spot(contact, other))) {
                let (string, body) = (&contact.name, &body.name);
                let words = format!("where the string `{string}` is fastened to `{body}`");
                self.not_judged.push(words);
                return;
            }
        }
        let is_out_of_reach = || {
            let reach = touch::reach(body, &contact.at);
            let mut past = reach.iter().map(|e| decide(e, &self.scene.domains).verdict);
            past.any(|verdict| verdict == Verdict::Nowhere)
        };
        for (need, decided) in best.into_iter().flatten() {
            let (Need::Zero(e) | Need::NotNegative(e)) = &need;
            // Numbers and given values that are off the outline were refused when the scene was read.
            if e.is_constant() {
                continue;
            }
            let at_values = self.values.knows(e).then_some(true);
            let verdict = match decided.verdict {
                Verdict::Undecided | Verdict::Where if at_values.is_none() && is_out_of_reach() => {
                    Verdict::Nowhere
                }
                verdict => verdict,
            };
            self.conditions.push(Condition {
                rule: Rule::Place,
                words: format!("`{}` lies on `{}`", contact.name, body.name),
                otherwise: format!("`{}` does not lie on `{}`", contact.name, body.name),
                verdict,
                essential: decided.essential,
                is_equation: matches!(need, Need::Zero(_)),
                at_values,
            });
        }
    }

    /// What grips may pull; that it does is told.
    fn grip(&mut self, name: &str, push: &Expr) {
        let Some(closed) = self.closed(push) else {
            return;
        };
        let pulls = decide(&closed, &self.scene.domains).verdict == Verdict::Nowhere
            || self.values.not_negative(push) == Some(false);
        if pulls {
            self.notes.push(format!(
                "the bodies hold each other at `{name}`: the impulse there pulls, as only what sticks can"
            ));
        }
    }

    /// Energy lost at all contacts together.
    fn energy(&mut self) {
        let scene = self.scene;
        if scene.gains_energy || scene.contacts.is_empty() || !scene.blows.is_empty() {
            return;
        }
        let first = &scene.contacts[0].law;
        let free = scene.contacts.iter().any(|c| c.law == ContactLaw::None);
        let alike = scene.contacts.iter().all(|c| c.law == *first);
        if !free && alike && scene.after.is_empty() {
            return;
        }
        let lost = Expr::sum(scene.contacts.iter().enumerate().map(|(i, contact)| {
            let [before, after] = [false, true].map(|a| self.relative(contact, &contact.at, a));
            let both = [&before[0] + &after[0], &before[1] + &after[1]];
            dot(&self.impulse(i), &both) * Expr::ratio(-1, 2)
        }));
        self.claim(
            Rule::Energy,
            String::from("no kinetic energy is gained"),
            String::from("kinetic energy is gained"),
            lost,
            None,
        );
    }

    /// Whether this is the one contact of a scene in which nothing else acts. Then its impulse is −(1 + e)(u⁻·n)/W with the
    /// W > 0 of a quadratic form in the masses (Delassus), so that it pushes, and the bodies part, exactly where they approach.
    /// Their own forms are long, and the sign of W is out of reach of the algebra.
    fn acts_alone(&self, contact: &Contact) -> bool {
        let scene = self.scene;
        scene.contacts.len() == 1
            && scene.blows.is_empty()
            && scene.after.is_empty()
            && matches!(contact.law, ContactLaw::Frictionless { .. })
    }

    /// Adds the condition that an expression in parameters and unknowns is not negative; by theory it holds just where `like`
    /// does.
    fn claim(
        &mut self,
        rule: Rule,
        words: String,
        otherwise: String,
        e: Expr,
        like: Option<&Decided>,
    ) {
        let decided = match self.closed(&e) {
            Some(closed) => decide::as_like(&closed, like, &self.scene.domains),
            None => decide::UNDECIDED,
        };
        let at_values = self.values.not_negative(&e);
        self.conditions.push(Condition {
            rule,
            words,
            otherwise,
            verdict: decided.verdict,
            essential: decided.essential,
            is_equation: false,
            at_values,
        });
    }

    /// The closed form of an expression in unknowns; `None` where one is open or too long to be multiplied out.
    fn closed(&self, e: &Expr) -> Option<Expr> {
        let mut forms: BTreeMap<Symbol, Expr> = BTreeMap::new();
        let symbols = e.symbols();
        for unknown in laws::unknowns(self.scene) {
            let name: Symbol = self.derivation.names.plain(unknown).into();
            if symbols.contains(&name) {
                if self.derivation.in_steps {
                    return None;
                }
                forms.insert(name, self.derivation.motion.get(&unknown)?.clone());
            }
        }
        Some(e.substitute(&forms))
    }

    fn unknown(&self, unknown: Unknown) -> Expr {
        Expr::symbol(self.derivation.names.plain(unknown))
    }

    /// Velocity of the second body against the first at a point, before or after; after in terms of unknowns.
    fn relative(&self, contact: &Contact, at: &Vector, after: bool) -> Vector {
        let [a, b] = contact.bodies.map(|b| self.velocity(b, at, after));
        minus(&b, &a)
    }

    fn velocity(&self, b: usize, at: &Vector, after: bool) -> Vector {
        let body = &self.scene.bodies[b];
        let (v, w) = if after && !body.is_fixed() {
            let v = [0, 1].map(|axis| self.unknown(Unknown::Velocity(b, axis)));
            let spins = !body.is_particle();
            let w = spins.then(|| self.unknown(Unknown::Spin(b)));
            (v, w.unwrap_or_else(Expr::zero))
        } else {
            (body.velocity.clone(), body.spin.clone())
        };
        if body.is_particle() {
            return v;
        }
        let r = minus(at, &body.center);
        [&v[0] - &(&w * &r[1]), &v[1] + &(&w * &r[0])]
    }

    /// Impulse of a contact on its second body, in terms of unknowns.
    fn impulse(&self, i: usize) -> Vector {
        let contact = &self.scene.contacts[i];
        match (&contact.law, &contact.normal) {
            (ContactLaw::Frictionless { .. }, Some(n)) => {
                let size = self.unknown(Unknown::Normal(i));
                [&size * &n[0], &size * &n[1]]
            }
            _ => [0, 1].map(|axis| self.unknown(Unknown::Contact(i, axis))),
        }
    }

    fn outcome(mut self) -> Possible {
        decide::without_consequences(&mut self.conditions, &self.scene.domains);
        let (verdict, at_values) = concluded(&self.conditions, &self.not_judged);
        Possible {
            verdict,
            at_values,
            conditions: self.conditions,
            not_judged: self.not_judged,
            notes: self.notes,
            beside: {
                let contacts = &self.scene.contacts;
                let is_plain = |c: &Contact| matches!(c.law, ContactLaw::Frictionless { .. });
                contacts.len() > 1 && contacts.iter().all(is_plain)
            },
        }
    }
}
