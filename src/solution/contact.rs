//! What a contact or a known velocity says of the motion just after: restitution along the normal, the relation of rigid
//! bodies for the touching points, and where a normal passes through a center of mass.

use super::words::{self, say, set, vector};
use super::{Inline, Math, Part, Writer};
use crate::expr::{Expr, Symbol, Vector};
use crate::laws::Place;
use crate::scene::{ContactLaw, KnownQuantity};

/// Largest velocity, in nodes, that is written out for a touching point.
const READABLE: usize = 90;

/// Two bodies that touch.
pub(super) struct Touching {
    /// The one that the normal points away from.
    pub from: usize,
    /// The one that it points to.
    pub to: usize,
    /// Those of the two that move at the contact.
    pub moving: Vec<usize>,
    pub normal: Option<Vector>,
}

impl Writer<'_> {
    /// What is known of the motion just after, with the relation of rigid bodies where it is about a point of one.
    pub(super) fn given(&mut self, k: usize) {
        let known = self.scene.after[k].clone();
        let body = words::body(self.scene, known.body);
        let KnownQuantity::Velocity { at, along, to } = &known.what else {
            return self.say(&format!("The given spin of {body}:"));
        };
        let from = to.map(|to| format!(" relative to {}", words::body(self.scene, to)));
        let from = from.unwrap_or_default();
        let center = words::center(self.scene, known.body);
        let scene = self.scene;
        let mut places = scene.acting().map(|one| (one.name, one.at));
        let is_center = *at == scene.bodies[known.body].center;
        let point = places
            .find(|(_, p)| *p == at)
            .filter(|_| !is_center && to.is_none());
        let centers = to.is_none_or(|to| *at == scene.bodies[to].center);
        let mut math = Vec::new();
        let of = match point {
            Some((name, _)) => {
                math.push(self.rigid(known.body, name, "+"));
                format!(
                    "the velocity of {} on {body}",
                    words::place(name, "contact")
                )
            }
            None if is_center && centers => {
                let own = vector("v", &center, "+");
                math = match to {
                    Some(to) => {
                        let other = words::center(scene, *to);
                        set("({} − {})", [own, vector("v", &other, "+")])
                    }
                    None => vec![own],
                };
                format!("the velocity of {body}{from}")
            }
            None => return self.say(&format!("The given velocity of {body}{from}:")),
        };
        let along = self.tidy_vector(along);
        math.extend(set("· ({}) = {}", [along.into(), (&known.value).into()]));
        self.say(&format!("A component of {of} just after is given:"));
        self.show(math, None);
    }

    /// Restitution in vectors, and how the touching points move.
    pub(super) fn restitution(&mut self, c: usize) {
        let contact = &self.scene.contacts[c];
        let at = contact.name.clone();
        let ContactLaw::Frictionless { restitution } = contact.law.clone() else {
            return;
        };
        let is_string = self.scene.figure.string(&at).is_some();
        let rule = if is_string {
            "The string does not stretch: its ends move alike along it"
        } else if restitution.is_one() {
            "The contact is elastic: its points separate along the normal as fast as they approached"
        } else if restitution.is_zero() {
            "There is no rebound: the points in contact do not separate along the normal"
        } else {
            "Restitution: the points in contact separate along the normal at "
        };
        let at_it = words::at(self.scene, Place::Contact(c));
        // A rule that was told for one contact, or in an earlier stage, is not told again for the next.
        let factor = rule.ends_with("at ").then(|| words::formula(&restitution));
        let tells = |part: &Part| match part {
            Part::Text(text) => {
                let mut pieces = text.iter();
                pieces.next() == Some(&say(rule))
                    && factor.as_ref().is_none_or(|f| pieces.next() == Some(f))
            }
            _ => false,
        };
        let above = self.solution.earlier().any(tells);
        let own = Symbol::from(format!("{rule} {restitution:?}"));
        let again = !self.told.insert(own) || above;
        let mut text = vec![say(match again {
            true => format!("Likewise at {at_it}"),
            false => rule.to_string(),
        })];
        if let Some(factor) = factor.filter(|_| !again) {
            text.extend([factor, say(" times their speed of approach")]);
        }
        let there = match again {
            true => String::new(),
            false => format!(" at {at_it}"),
        };
        let touching = self.touching(c);
        let (first, second) = (
            words::body(self.scene, touching.from),
            words::body(self.scene, touching.to),
        );
        let mut normal = vec![vector("n", "", "")];
        if let Some(n) = touching.normal.clone() {
            normal.extend([Math::Op("="), Math::Vector(n)]);
        }
        let normal = Inline::Math(normal);
        let through: Vec<usize> = match &touching.normal {
            Some(n) => self.centers_on(&touching, c, n),
            None => Vec::new(),
        };
        let with = |words: &str| match again {
            true => format!("; {words}"),
            false => format!(". {}", words::capital(words)),
        };
        if is_string {
            let end = say(format!(" in which it pulls {second},"));
            text.extend([say(with("with the direction ")), normal, end]);
        } else if through.is_empty() {
            let end = say(format!("{there} from {first} to {second},"));
            text.extend([say(with("with the normal ")), normal, end]);
        } else {
            let centers = if through.len() == 1 {
                "center"
            } else {
                "centers"
            };
            let whose = words::bodies(self.scene, &through);
            let end = say(format!(
                "{there}, from {first} to {second}, passes through the {centers} of mass of {whose}:"
            ));
            text.extend([say(with("the normal ")), normal, end]);
        }
        self.text(text);
        if let Some(n) = &touching.normal {
            self.separation(c, &restitution, &touching, ("n", n));
        }
    }

    /// The bodies at a contact that move there, and its normal. Of a support at rest nothing needs to be said; the normal points
    /// away from it.
    pub(super) fn touching(&mut self, c: usize) -> Touching {
        let [one, two] = self.scene.contacts[c].bodies;
        let moving = [one, two].into_iter();
        let moving: Vec<usize> = moving
            .filter(|b| !self.stands(*b, Place::Contact(c)))
            .collect();
        let flipped = moving == [one];
        let (from, to) = if flipped { (two, one) } else { (one, two) };
        let normal = self.scene.contacts[c].normal.clone();
        let normal = normal.map(|n| if flipped { n.map(|x| -x) } else { n });
        Touching {
            from,
            to,
            normal: normal.map(|n| self.tidy_vector(&n)),
            moving,
        }
    }

    /// The bodies through whose centers of mass a direction at a contact passes.
    fn centers_on(&mut self, touching: &Touching, c: usize, direction: &Vector) -> Vec<usize> {
        let moving = touching.moving.iter().copied();
        moving
            .filter(|b| self.passes_center(*b, c, direction))
            .collect()
    }

    /// The law of restitution at a contact along its normal, or the like along its tangent.
    pub(super) fn separation(
        &mut self,
        c: usize,
        restitution: &Expr,
        touching: &Touching,
        (letter, direction): (&'static str, &Vector),
    ) {
        let through = self.centers_on(touching, c, direction);
        let (from, to, moving) = (touching.from, touching.to, touching.moving.len());
        let at = self.scene.contacts[c].name.clone();
        let index = |b: usize| {
            if self.scene.bodies[b].is_particle()
                || self.spin_after(b).is_zero() && moving == 2
                || through.contains(&b)
            {
                words::center(self.scene, b)
            } else if moving == 1 {
                at.clone()
            } else {
                format!("{at},{}", words::center(self.scene, b))
            }
        };
        let indices = [from, to].map(index);
        let both = moving == 2;
        let relative = |mark| {
            let [one, two] = [1, 0].map(|i| vector("v", &indices[i], mark));
            match both {
                true => set("({} − {})", [one, two]).remove(0),
                false => one,
            }
        };
        let n = || vector(letter, "", "");
        let mut math = set("{} · {} =", [relative("+"), n()]);
        let turns = |index: &String| index.starts_with(at.as_str());
        // Of a single point the relation of rigid bodies stands in the same line.
        if !both && turns(&indices[1]) {
            math.extend(set("{} · {} =", [self.rigid(to, &at, "+"), n()]));
        }
        if restitution.is_zero() {
            math.push(Expr::zero().into());
        } else {
            math.push(Math::Op("−"));
            math.extend((!restitution.is_one()).then(|| Math::Factor(restitution.clone())));
            math.extend(set("{} · {}", [relative("-"), n()]));
        }
        self.show(math, None);
        for (b, index) in [to, from].into_iter().zip(indices.iter().rev()) {
            if both && turns(index) {
                self.point_velocity(b, c, index, (letter, direction));
            }
        }
    }

    /// Whether the normal at a contact passes through the center of mass of a body, so that its spin does not count.
    fn passes_center(&mut self, b: usize, c: usize, n: &Vector) -> bool {
        let body = &self.scene.bodies[b];
        if body.is_particle() || body.is_fixed() || self.reduction.tree.iter().any(|l| l.body == b)
        {
            return false;
        }
        let arm = self.arm(&self.g.place(Place::Contact(c)).clone(), Place::Center(b));
        let moment = &arm[0] * &n[1] - &arm[1] * &n[0];
        !self.spin_after(b).is_zero() && self.vanishes(&moment)
    }

    /// `(v + ω × r)` for the touching point of a body, from its center of mass or from the joint it turns about; `when` is the
    /// mark of the instant.
    pub(super) fn rigid(&self, b: usize, point: &str, when: &'static str) -> Math {
        let link = self.reduction.tree.iter().find(|l| l.body == b).copied();
        let carrier = link.map_or(Place::Center(b), |l| l.at);
        let base = words::point(self.scene, carrier);
        let [carried, arm] = [
            vector("v", &base, when),
            vector("r", &format!("{point}/{base}"), ""),
        ];
        let spin = words::spin(self.scene, b, when);
        let mut whole = match link.is_some_and(|l| self.stands(l.to, l.at)) {
            true => set("({} × {})", [spin, arm]),
            false => set("({} + {} × {})", [carried, spin, arm]),
        };
        whole.remove(0)
    }

    /// The velocity just after of the touching point of a body along a direction, (v + ω × r) · n.
    fn point_velocity(
        &mut self,
        b: usize,
        c: usize,
        index: &str,
        (letter, n): (&'static str, &Vector),
    ) {
        let at = self.g.place(Place::Contact(c)).clone();
        let forms = self.reduced.velocity_of(&self.g, b, &at);
        let v = [0, 1].map(|axis| self.form(&forms[axis]));
        let along = self.tidy(&(&v[0] * &n[0] + &v[1] * &n[1]));
        let n = || vector(letter, "", "");
        let mut math = set("{} · {} =", [vector("v", index, "+"), n()]);
        let rigid = self.rigid(b, &self.scene.contacts[c].name, "+");
        math.extend(set("{} · {}", [rigid, n()]));
        if along.size() <= READABLE {
            math.extend(set("= {}", [along.into()]));
        }
        self.show(math, None);
    }

    /// Whether a body is fixed and its point at a place does not move.
    pub(super) fn stands(&self, b: usize, at: Place) -> bool {
        let here = self.g.place(at).clone();
        self.scene.bodies[b].is_fixed()
            && self.g.velocity_before(b, &here).iter().all(Expr::is_zero)
    }
}
