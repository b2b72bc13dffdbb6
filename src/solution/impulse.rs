//! How the point of contact moves under an impulse: what the laws of a rough contact and the conditions of its cases rest on.
//!
//! In: a scene in which it is decided what friction does. Out: the balances of momentum and the motion of a rigid body, and
//! from them the velocity of the contact as a function of its impulse, u = u⁻ + W P, with the effective masses that W holds.

use super::block::AXES;
use super::contact::Touching;
use super::words::{self, fill, say, set, vector};
use super::{Claim, Inline, Line, Math, Meaning, Part, Writer};
use crate::derive::Attachment;
use crate::expr::{Expr, Symbol, Vector, cross, dot};
use crate::formula::latex_words;
use crate::laws::{self, Place, Unknown};
use crate::scene::Decided;

/// Largest coefficient, in nodes, that stands in the equations; a larger one gets a name.
const SHORT: usize = 9;

/// Largest coefficient, in nodes, that is written at all.
const LONGEST: usize = 120;

/// The velocity of a contact under its impulse, in components along the tangent and the normal: along the axes where they lie
/// along these.
#[derive(Clone)]
pub(super) struct Motion {
    /// The contact.
    pub contact: usize,
    /// What the components are called.
    pub along: [&'static str; 2],
    /// 1 where a component is that along the tangent or normal of the law, −1 where it is opposite.
    pub sense: [i64; 2],
    /// The impulse so far.
    pub impulse: [Expr; 2],
    /// The velocity of the second body relative to the first.
    pub velocity: [Expr; 2],
    /// The same just before.
    pub before: [Expr; 2],
    /// W: along the tangent, across, along the normal, as it is written.
    pub written: [Expr; 3],
    /// The same in the symbols of the scene.
    pub values: [Expr; 3],
}

/// The bodies at a contact and the directions in which its motion is told.
struct Frame {
    touching: Touching,
    directions: [Vector; 2],
    along: [&'static str; 2],
    sense: [i64; 2],
    /// Whether the symbols of the impulse are those of the one on the body that moves away along the normal.
    on_second: bool,
}

impl Writer<'_> {
    /// Tells how a contact moves under an impulse; `None` where that would be too long.
    pub(super) fn motion_under_impulse(&mut self, c: usize, decided: &Decided) -> Option<Motion> {
        let frame = self.frame(c)?;
        let space = &decided.space;
        let turned = Expr::from(frame.sense[0] * frame.sense[1]);
        let values = [&space.a, &(&space.b * turned), &space.c].map(|e| self.tidy(e));
        let sums = self.inverse_masses(c, &frame, &values);
        if sums.iter().any(|e| e.size() > LONGEST) {
            return None;
        }
        let at = words::place(&self.scene.contacts[c].name, "contact");
        self.section(vec![say(format!("Motion of {at} under an impulse"))]);
        if frame.along == ["t", "n"] {
            self.directions(c);
        }
        let lead = self.balances_of(c, &frame);
        let impulse = self.impulse_components(c, &frame);
        let velocity = self.velocity_components(c, &frame);
        let written = self.effective_masses(lead, &frame, (&sums, &values));
        let sign = self.on(c, frame.touching.to);
        let before = self.scene.contacts[c].relative_velocity(self.scene);
        let before = frame.directions.each_ref().map(|d| {
            let along = &sign * dot(&before, d);
            self.sum_by_parts(along.terms().to_vec())
        });
        let motion = Motion {
            contact: c,
            along: frame.along,
            sense: frame.sense,
            impulse,
            velocity,
            before,
            written,
            values,
        };
        let order = if frame.along[0] == "y" {
            [1, 0]
        } else {
            [0, 1]
        };
        for i in order {
            let shares = [0, 1].map(|k| &motion.written[i + k] * &motion.impulse[k]);
            let whole = &motion.before[i] + Expr::sum(shares);
            let reason = "the balances solved for the velocity of the contact";
            self.claim(motion.velocity[i].clone(), whole, reason);
        }
        Some(motion)
    }

    /// 1 for the second body of a contact, −1 for the first.
    fn on(&self, c: usize, body: usize) -> Expr {
        Expr::from(if body == self.scene.contacts[c].bodies[1] {
            1
        } else {
            -1
        })
    }

    fn frame(&mut self, c: usize) -> Option<Frame> {
        let touching = self.touching(c);
        let n = touching.normal.clone()?;
        let t = [n[1].clone(), -&n[0]];
        let axis = |d: &Vector| (0..2).find(|i| d[1 - *i].is_zero());
        let second = touching.to == self.scene.contacts[c].bodies[1];
        let on_second = second != self.d.names.is_reversed(Unknown::Contact(c, 0));
        let frame = |directions, along, sense| Frame {
            touching,
            directions,
            along,
            sense,
            on_second,
        };
        Some(match (axis(&t), axis(&n)) {
            (Some(one), Some(other)) => {
                let unit = |i: usize| [0, 1].map(|k| Expr::from(i64::from(k == i)));
                let sense = |d: &Vector, i: usize| if d[i].is_negative() { -1 } else { 1 };
                let senses = [sense(&t, one), sense(&n, other)];
                frame([unit(one), unit(other)], [AXES[one], AXES[other]], senses)
            }
            _ => frame([t, n], ["t", "n"], [1, 1]),
        })
    }

    /// W with a term for each body and its rotation, where the bodies answer the impulse by themselves.
    fn inverse_masses(&mut self, c: usize, frame: &Frame, values: &[Expr; 3]) -> [Expr; 3] {
        if !self.is_free(frame) {
            return values.clone();
        }
        let [t, n] = &frame.directions;
        [(t, t), (t, n), (n, n)].map(|(d, e)| {
            let mut parts = Vec::new();
            for b in frame.touching.moving.iter().copied() {
                let arm = self.arm(&self.g.place(Place::Contact(c)).clone(), Place::Center(b));
                let mass = self.g.mass(b).clone();
                parts.push(dot(d, e) / mass);
                if !self.scene.bodies[b].is_particle() {
                    let inertia = self.g.inertia(b).clone();
                    parts.push(cross(&arm, d) * cross(&arm, e) / inertia);
                }
            }
            self.sum_by_parts(parts)
        })
    }

    /// Whether the bodies at a contact answer its impulse by themselves.
    fn is_free(&self, frame: &Frame) -> bool {
        let hinged = |b: &usize| self.scene.hinges.iter().any(|h| h.bodies.contains(b));
        self.scene.contacts.len() == 1 && !frame.touching.moving.iter().any(hinged)
    }

    /// The hinges in a row by which the only body that feels the impulse hangs from one at rest, that one first; none where it
    /// is joined in another way.
    fn chain(&self, frame: &Frame) -> Vec<Attachment> {
        let links = &self.reduction.tree;
        let own = |b: usize| links.iter().find(|l| l.body == b).copied();
        let [b] = frame.touching.moving.as_slice() else {
            return Vec::new();
        };
        let carrier = |l: &Attachment| own(l.to);
        let mut chain: Vec<_> = std::iter::successors(own(*b), carrier).collect();
        chain.reverse();
        let hangs = chain.first().is_some_and(|l| self.stands(l.to, l.at));
        // Nothing else holds these bodies, and the contact is at the end.
        let alone = self.scene.touching().count() == chain.len() + 1 && links.len() == chain.len();
        chain.retain(|_| hangs && alone);
        chain
    }

    /// The balances of the bodies at a contact for its impulse so far, and how the contact moves with them; gives the sentence
    /// that goes on where joints leave nothing short to write.
    fn balances_of(&mut self, c: usize, frame: &Frame) -> Vec<Inline> {
        let at = words::point(self.scene, Place::Contact(c));
        let here = words::place(&at, "contact");
        let [from, to] = [frame.touching.from, frame.touching.to];
        let [first, second] = [from, to].map(|b| words::body(self.scene, b));
        let named = if frame.on_second { &second } else { &first };
        let p = Inline::Math(vec![vector("P", &at, "")]);
        let mut text = fill(
            "Let {} be the impulse at {} on {} so far",
            [p, say(&here), say(named)],
        );
        let moving = &frame.touching.moving;
        if moving.len() == 2 {
            let v = Inline::Math(vec![vector("v", &at, "")]);
            let parts = [v, say(&second), say(&first)];
            text.extend(fill(
                ", and {} the velocity there of {} relative to {}",
                parts,
            ));
        }
        let chain = self.chain(frame);
        let moves = match moving.as_slice() {
            [b] => format!("{here} moves with {}", words::body(self.scene, *b)),
            _ => format!("the points at {here} move with the bodies"),
        };
        let is_particle = |b: &usize| self.scene.bodies[*b].is_particle();
        let law = match chain.as_slice() {
            [pin] => {
                let pin = words::at(self.scene, pin.at);
                format!("angular momentum about {pin}, about which {here} turns")
            }
            [_, ..] => {
                let each = (0..chain.len()).rev().map(|i| {
                    let carried: Vec<usize> = chain[i..].iter().map(|l| l.body).collect();
                    let whom = words::bodies(self.scene, &carried);
                    format!("of {whom} about {}", words::at(self.scene, chain[i].at))
                });
                let each: Vec<String> = each.collect();
                format!("angular momentum {}", words::listed(&each))
            }
            [] if !self.is_free(frame) => {
                let others = match self.scene.hinges.is_empty() {
                    true => "other contacts",
                    false => "hinges",
                };
                let with = format!(". The balances of momentum, with the {others}, then give");
                text.push(say(with));
                return text;
            }
            [] if moving.iter().all(is_particle) => String::from("linear momentum"),
            [] => {
                let about = match moving.as_slice() {
                    [b] => match words::center(self.scene, *b).as_str() {
                        "G" => String::from("G"),
                        _ => words::at(self.scene, Place::Center(*b)),
                    },
                    _ => String::from("each center of mass"),
                };
                format!("momentum, and angular momentum about {about}; {moves}")
            }
        };
        text.push(say(format!(". Balance {law}:")));
        self.text(text);
        match chain.as_slice() {
            [pin] => self.pinned(&at, pin.at, frame),
            [] => self.unjoined(&at, c, frame),
            chain => {
                self.chained(&at, chain, frame);
                return vec![say("Solved for the angular velocities, these give")];
            }
        }
        Vec::new()
    }

    /// What follows each hinge of a chain turns about it.
    fn chained(&mut self, at: &str, chain: &[Attachment], frame: &Frame) {
        let mut ends: Vec<String> = chain
            .iter()
            .map(|l| words::point(self.scene, l.at))
            .collect();
        ends.push(at.to_owned());
        for o in ends[..chain.len()].iter().rev() {
            let [now, before] = ["", "-"].map(|mark| vector("H", o, mark));
            let arm = vector("r", &format!("{at}/{o}"), "");
            let mut math = set("{} − {} = {} ×", [now, before, arm]);
            math.extend(self.impulse_factor(at, chain[chain.len() - 1].body, frame));
            self.show(math, None);
        }
        let terms = chain.iter().zip(ends.windows(2)).map(|(link, ends)| {
            let arm = vector("r", &format!("{}/{}", ends[1], ends[0]), "");
            set("{} × {}", [words::spin(self.scene, link.body, ""), arm])
        });
        let terms: Vec<Vec<Math>> = terms.collect();
        let mut math = set("{} =", [vector("v", at, "")]);
        math.extend(terms.join(&Math::Op("+")));
        self.show(math, None);
    }

    /// The impulse on one of the bodies at a contact, with its sign.
    fn impulse_on(&self, at: &str, body: usize, frame: &Frame) -> Vec<Math> {
        let plus = (body == frame.touching.to) == frame.on_second;
        let sign = (!plus).then_some(Math::Op("−"));
        sign.into_iter().chain([vector("P", at, "")]).collect()
    }

    /// The same behind a sign of multiplication.
    fn impulse_factor(&self, at: &str, body: usize, frame: &Frame) -> Vec<Math> {
        let impulse = self.impulse_on(at, body, frame);
        match impulse.len() {
            1 => impulse,
            _ => vec![Math::Brackets(impulse)],
        }
    }

    fn pinned(&mut self, at: &str, pin: Place, frame: &Frame) {
        let b = frame.touching.moving[0];
        let o = words::point(self.scene, pin);
        let arm = || vector("r", &format!("{at}/{o}"), "");
        let inertia = || words::name("I", &o, "", false);
        let [now, before] = ["", "-"].map(|mark| words::spin(self.scene, b, mark));
        let mut turns = set("{} ({} − {}) = {} ×", [inertia(), now, before, arm()]);
        turns.extend(self.impulse_factor(at, b, frame));
        self.show(turns, None);
        let spin = words::spin(self.scene, b, "");
        self.show(
            set("{} = {} × {}", [vector("v", at, ""), spin, arm()]),
            None,
        );
        let center = self.g.place(Place::Center(b)).clone();
        let d = self.arm(&center, pin);
        let about = self.g.inertia(b) + self.g.mass(b) * dot(&d, &d);
        let about = self.tidy(&about);
        self.show(set("{} = {}", [inertia(), about.into()]), None);
        self.arm_line(at, pin);
    }

    fn unjoined(&mut self, at: &str, c: usize, frame: &Frame) {
        let moving = frame.touching.moving.clone();
        let mut relative = set("{} =", [vector("v", at, "")]);
        for b in [frame.touching.to, frame.touching.from] {
            if !moving.contains(&b) {
                continue;
            }
            let g = words::center(self.scene, b);
            let mass = self.g.mass(b).clone();
            let mass = Math::Factor(self.tidy(&mass));
            let [now, before] = ["", "-"].map(|mark| vector("v", &g, mark));
            let mut math = set("{} ({} − {}) =", [mass, now, before]);
            math.extend(self.impulse_on(at, b, frame));
            self.show(math, None);
            if moving.len() == 2 && b == frame.touching.from {
                relative.push(Math::Op("−"));
            }
            if self.scene.bodies[b].is_particle() {
                relative.push(vector("v", &g, ""));
                continue;
            }
            let arm = || vector("r", &format!("{at}/{g}"), "");
            let (inertia, value) = self.inertia_told(b);
            let [now, before] = ["", "-"].map(|mark| words::spin(self.scene, b, mark));
            let mut math = set("{} ({} − {}) = {} ×", [inertia, now, before, arm()]);
            math.extend(self.impulse_factor(at, b, frame));
            self.show(math, None);
            if let Some(value) = value {
                self.show(value, None);
            }
            self.arm_line(at, Place::Center(b));
            let name = &self.scene.contacts[c].name;
            let whole = self.rigid(b, name, "");
            match (whole, moving.len()) {
                (Math::Brackets(inner), 1) => relative.extend(inner),
                (whole, _) => relative.push(whole),
            }
        }
        // Of a particle the point of contact is the body.
        let is_same = matches!(relative.as_slice(), [v, _, w] if v == w);
        if !is_same {
            self.show(relative, None);
        }
    }

    /// The arm from a center of mass or a pin to the contact.
    fn arm_line(&mut self, at: &str, from: Place) {
        let mut contacts = self.scene.contacts.iter();
        let Some(c) = contacts.position(|c| c.name == at) else {
            return;
        };
        let o = words::point(self.scene, from);
        let arm = self.arm(&self.g.place(Place::Contact(c)).clone(), from);
        let r = vector("r", &format!("{at}/{o}"), "");
        self.show(set("{} = {}", [r, arm.into()]), None);
    }

    /// The symbols of the components of an impulse: those of the scene along the axes, else names of their own.
    fn impulse_components(&mut self, c: usize, frame: &Frame) -> [Expr; 2] {
        let sign = self.on(c, frame.touching.to);
        let forms = laws::impulse_at(self.scene, &self.g, Place::Contact(c));
        let whole = forms.map(|form| &sign * self.form(&form));
        let along = frame.directions.each_ref().map(|d| {
            let raw = dot(&whole, d);
            self.tidy(&raw)
        });
        if frame.along != ["t", "n"] {
            return along;
        }
        let at = &self.scene.contacts[c].name;
        let names = self.free(&["P", "Q"], |letter| {
            frame.along.map(|d| format!("{letter}_{at}_{d}"))
        });
        for (name, value) in names.iter().zip(along) {
            self.names_only(name, value, "a component of the impulse");
        }
        self.typeset(at, &names, frame.along);
        names.map(|name| Expr::symbol(&name))
    }

    /// Names for the components of the velocity of a contact, with what they are at the end of the impact.
    fn velocity_components(&mut self, c: usize, frame: &Frame) -> [Expr; 2] {
        let at = &self.scene.contacts[c].name;
        let names = self.free(&["v", "u", "w"], |letter| {
            frame.along.map(|d| format!("{letter}_{at}_{d}"))
        });
        let place = self.g.place(Place::Contact(c)).clone();
        let [to, from] = [frame.touching.to, frame.touching.from].map(|b| {
            let forms = self.reduced.velocity_of(&self.g, b, &place);
            forms.map(|form| self.form(&form))
        });
        for (name, d) in names.iter().zip(&frame.directions) {
            let value = dot(&to, d) - dot(&from, d);
            self.names_only(
                name,
                value,
                "the velocity of the contact, at the end that of the motion just after",
            );
        }
        self.typeset(at, &names, frame.along);
        names.map(|name| Expr::symbol(&name))
    }

    /// Sets the components at a contact as those of the scene are set.
    fn typeset(&mut self, at: &str, names: &[Symbol; 2], along: [&str; 2]) {
        for (name, d) in names.iter().zip(along) {
            let letter = name.chars().next().unwrap_or_default();
            let latex = format!("{letter}_{{{},{d}}}", latex_words(at));
            self.solution.names.insert(name.clone(), latex);
        }
    }

    /// Names for the long ones of the coefficients, each with its value; gives them as they are written.
    fn effective_masses(
        &mut self,
        mut text: Vec<Inline>,
        frame: &Frame,
        (sums, values): (&[Expr; 3], &[Expr; 3]),
    ) -> [Expr; 3] {
        let mass = |letter: &str| frame.along.map(|d| format!("{letter}_{d}"));
        let [along, normal] = self.free(&["m", "M"], mass);
        let [coupling] = self.free(&["c", "k", "b", "q"], |letter| [letter.to_owned()]);
        let names = [along, coupling, normal];
        let (mut lines, mut named) = (Vec::new(), Vec::new());
        let mut written = sums.clone();
        for i in [0, 2, 1] {
            if sums[i].size() <= SHORT {
                continue;
            }
            let symbol = Expr::symbol(&names[i]);
            let (shown, value) = match i {
                1 => (symbol.clone(), values[i].clone()),
                _ => (symbol.powi(-1), values[i].powi(-1)),
            };
            self.names_only(
                &names[i],
                value,
                "a coefficient of the motion of the contact",
            );
            let claim = Claim::new(shown.clone(), sums[i].clone());
            let id = self.step(
                Vec::new(),
                vec![claim],
                "from the masses and the moments of inertia",
            );
            let mut math = words::related(&shown, "=", &sums[i]);
            if sums[i] != values[i] && values[i].size() < sums[i].size() {
                math.extend([Math::Op("="), values[i].clone().into()]);
            }
            let step = Some(id);
            lines.push(Line { math, step });
            named.push((i, words::formula(&symbol)));
            written[i] = shown;
        }
        let masses = named.iter().filter(|(i, _)| *i != 1);
        let masses = words::row(masses.map(|(_, name)| name.clone()), " and ");
        let mut with = Vec::new();
        if !masses.is_empty() {
            let is_one = masses.len() == 1;
            let noun = if is_one {
                "the effective mass"
            } else {
                "effective masses"
            };
            with.extend([vec![say(format!("with {noun} "))], masses].concat());
        }
        if let Some((_, name)) = named.iter().find(|(i, _)| *i == 1) {
            let lead = if with.is_empty() { "with " } else { " and " };
            with.extend([say(lead), name.clone(), say(", which couples them")]);
        }
        let mut parts = match frame.along {
            ["t", "n"] => {
                let both = ["t", "n"].map(|letter| Inline::Math(vec![vector(letter, "", "")]));
                vec![fill("in components along {} and {}", both)]
            }
            _ if with.is_empty() || !text.is_empty() => vec![vec![say("in components")]],
            _ => Vec::new(),
        };
        parts.extend((!with.is_empty()).then_some(with));
        let mut parts = parts.join(&say(", "));
        if text.is_empty() {
            if let Some(Inline::Text(first)) = parts.first_mut() {
                *first = words::capital(first);
            }
        } else {
            text.push(say(" "));
        }
        text.extend(parts);
        text.push(say(","));
        self.text(text);
        if !lines.is_empty() {
            self.push(Part::Display(lines));
        }
        written
    }

    /// Records that a name stands for a value, without a line; gives the id of the step.
    pub(super) fn names_only(&mut self, name: &Symbol, value: Expr, reason: &str) -> String {
        self.solution
            .meanings
            .insert(name.clone(), Meaning::Defined);
        self.solution.naming(name, None, &value, reason)
    }

    /// Names made of the first letter with which all of them are free.
    pub(super) fn free<const N: usize>(
        &self,
        letters: &[&str],
        names: impl Fn(&str) -> [String; N],
    ) -> [Symbol; N] {
        let is_taken = |name: &String| {
            let is_known = self.solution.meanings.contains_key(name.as_str());
            is_known || self.scene.parameter(name).is_some() || self.scene.question(name).is_some()
        };
        let numbered = (1..).map(|i| format!("{}_{i}", letters[0]));
        let mut all = letters.iter().map(ToString::to_string).chain(numbered);
        let free = all.find_map(|letter| {
            let found = names(&letter);
            (!found.iter().any(is_taken)).then_some(found)
        });
        free.unwrap_or_else(|| names("")).map(Symbol::from)
    }
}
