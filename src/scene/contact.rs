//! Hinges, contacts with their laws, and what is known after: what may stand together, and between which bodies.

use super::body_file::ShapeName;
use super::claim::{Claim, Claimed};
use super::contact_file::{ContactFile, HypothesisName, KnownFile, LawName, SupposedName};
use super::fault::{Fault, Span};
use super::formulas::Quantity;
use super::record::text;
use super::record::{Formula, Text, is_sound};
use super::resolver::Resolver;
use super::touch::Placed;
use super::{
    ALONE, Body, Contact, ContactLaw, Friction, Hypothesis, Known, KnownQuantity, Mode, Scene,
    beside_friction,
};
use crate::algebra;
use crate::expr::{Expr, Vector, dot, minus};

/// Fields that laws need, with what they hold.
const NORMAL: (&str, &str) = (
    "normal",
    "the unit normal out of the first body into the second",
);
const REBOUND: (&str, &str) = ("restitution", "a number or a symbol from 0 to 1");

impl Resolver<'_> {
    pub(super) fn contact(&mut self, name: &Text, contact: &ContactFile, scene: &mut Scene) {
        let bodies = self.pair(&contact.bodies.items, contact.bodies.span, "contact");
        let collides = matches!(contact.law, Some(LawName::Frictionless | LawName::Friction));
        let normal = match (&contact.normal, bodies) {
            (Some(normal), _) => Some(self.direction(normal)),
            (None, Some(bodies)) if collides => self.line_of_centers(bodies, scene).map(Some),
            _ => None,
        };
        let at = match (&contact.at, bodies) {
            (Some(at), _) => self.position(at),
            (None, Some(bodies)) => {
                let normal = normal.as_ref().and_then(Option::as_ref);
                self.where_they_touch(name, contact, bodies, (scene, normal))
            }
            (None, None) => None,
        };
        let rebounds = contact.restitution.as_ref().filter(|_| collides);
        let restitution = rebounds.map(|e| {
            let value = self.read(e, Quantity::NUMBER);
            if let Some(value) = &value {
                self.claim(e.span, Claim::Fraction(value.clone()));
            }
            value
        });
        self.belongs_to_friction(contact);
        if let (Some(true), Some(_)) = (contact.passes, contact.law) {
            let message = "a contact with a law lets nothing pass";
            let hint = "leave out the law, and say with `after` how fast the body comes out behind";
            self.report(name.span, message, hint);
        }
        let law = match contact.law {
            Some(LawName::Friction) => {
                self.friction(name, contact, restitution.flatten(), normal.is_some())
            }
            Some(LawName::Frictionless) => {
                let missing = [(normal.is_none(), NORMAL), (restitution.is_none(), REBOUND)];
                self.lacks(name, contact, "frictionless contact", &missing);
                let restitution = restitution.flatten();
                restitution.map(|restitution| ContactLaw::Frictionless { restitution })
            }
            law => {
                let is_sound = law.is_some() || is_sound(contact.span, &self.faults);
                if let (Some(e), true) = (&contact.restitution, is_sound) {
                    let with = match law {
                        Some(_) => "a sticking contact",
                        None => "a contact without law",
                    };
                    let message = format!("{with} has no restitution");
                    let hint = "what rebounds has \"law\": \"frictionless\" or \"friction\"";
                    self.report(e.span, message, hint);
                }
                Some(law.map_or(ContactLaw::None, |_| ContactLaw::Sticking))
            }
        };
        // A normal that was given but could not be read has been reported.
        let normal = normal.map_or(Some(None), |n| n.map(Some));
        if let (Some(bodies), Some(at), Some(normal), Some(law)) = (bodies, at, normal, law) {
            self.reach(bodies, &at, name.span, &name.text);
            if self.file.stages.is_none() {
                // In stages bodies have moved by then; where they are shows when the stages are followed.
                self.claim(
                    name.span,
                    Claim::Placed(Placed::Contact(scene.contacts.len())),
                );
            }
            if normal.is_some() {
                self.claim(name.span, Claim::Approach(scene.contacts.len()));
            }
            scene.contacts.push(Contact {
                name: name.text.clone(),
                bodies,
                at,
                normal,
                passes: law == ContactLaw::None && contact.passes.unwrap_or_default(),
                is_string: false,
                law,
            });
        }
    }

    /// The unit normal between two bodies of which one is round and the other is too, or a particle: along the line of their
    /// centers, which are apart by their radii where they touch.
    fn line_of_centers(&mut self, bodies: [usize; 2], scene: &Scene) -> Option<Vector> {
        let shapes = bodies.map(|b| &scene.bodies[b]);
        let radius = |b: &Body| match b.is_particle() {
            true => Some(Expr::zero()),
            false => b.shape.radius().cloned(),
        };
        let [a, b] = shapes.map(radius);
        let apart = a? + b?;
        let [from, to] = bodies.map(|b| self.center(b));
        let gap = minus(&to?, &from?);
        // Between places in numbers the distance is known, whatever stands for the radii or however it was rounded.
        let apart = match gap.iter().all(Expr::is_constant) {
            true => dot(&gap, &gap).sqrt(),
            false => apart,
        };
        let along = |c: Expr| {
            let along = &c / &apart;
            algebra::tidy(&along, &scene.domains).unwrap_or(along)
        };
        (!apart.is_zero()).then(|| gap.map(along))
    }

    /// The place of a contact that is not given: that of the particle in it, or where the normal leaves what is round.
    fn where_they_touch(
        &mut self,
        name: &Text,
        contact: &ContactFile,
        bodies: [usize; 2],
        (scene, normal): (&Scene, Option<&Vector>),
    ) -> Option<Vector> {
        if let Some(particle) = bodies.into_iter().find(|b| self.is_particle(*b)) {
            return self.center(particle);
        }
        let round = bodies
            .into_iter()
            .find_map(|b| Some((b, scene.bodies[b].shape.radius()?)));
        let normal = normal
            .cloned()
            .or_else(|| self.line_of_centers(bodies, scene));
        if let (Some((round, radius)), Some(normal)) = (round, normal) {
            let out = match round == bodies[0] {
                true => radius.clone(),
                false => -radius,
            };
            let [x, y] = self.center(round)?;
            return Some([&x + &(&out * &normal[0]), &y + &(&out * &normal[1])]);
        }
        if is_sound(contact.span, &self.faults) {
            let fault = Fault::new(contact.span, "the field `at` is missing").shown_at(name.span);
            let hint = "where the bodies touch: a point's name, [x, y] or {\"from\": …}";
            self.faults.push(fault.hint(hint));
        }
        None
    }

    /// Friction is followed along the path of one impulse: beside it bodies may be held where they do not collide, by hinges,
    /// contacts that stick, and in stages supports and strings, but nothing else may strike.
    pub(super) fn friction_alone(&mut self, scene: &Scene) {
        let Some((contact, _)) = scene.friction() else {
            return;
        };
        let name = scene.contacts[contact].name.clone();
        let mut strikes = None;
        for (other, _) in self.file.contacts.iter().flat_map(|m| &m.0) {
            let read = scene.contacts.iter().position(|c| c.name == other.text);
            let Some(i) = read.filter(|i| *i != contact) else {
                continue;
            };
            match &scene.contacts[i].law {
                ContactLaw::Friction(_) | ContactLaw::Frictionless { .. } => strikes = Some(other),
                // Supports and strings of a stage are without law here.
                _ => self.claims.push(Claimed {
                    span: other.span,
                    claim: Claim::Rests(i),
                }),
            }
        }
        let blows = self.file.blows.iter().flat_map(|m| &m.0).map(|(n, _)| n);
        if let Some(other) = strikes.into_iter().chain(blows).next() {
            let message = beside_friction(&other.text, &name);
            self.report(other.span, message, ALONE);
        }
        if let Some(known) = self.file.after.iter().flatten().next() {
            let message =
                format!("something known after takes the place of a law, and `{name}` has one");
            let hint = "leave out `after`, or the law";
            self.report(known.span, message, hint);
        }
    }

    /// Reports what only a contact with friction has, where the law is another one.
    fn belongs_to_friction(&mut self, contact: &ContactFile) {
        if contact.law == Some(LawName::Friction) || !is_sound(contact.span, &self.faults) {
            return;
        }
        let at = |f: &Option<Formula>| f.as_ref().map(|f| f.span);
        let given = [
            ("mu", at(&contact.mu)),
            ("hypothesis", contact.hypothesis.map(|_| contact.span)),
            (
                "tangential_restitution",
                at(&contact.tangential_restitution),
            ),
            ("impulse_ratio", at(&contact.impulse_ratio)),
            ("supposing", contact.supposing.map(|_| contact.span)),
        ];
        for (field, span) in given
            .into_iter()
            .filter_map(|(field, at)| Some((field, at?)))
        {
            let message = format!("`{field}` belongs to a contact with friction");
            self.report(span, message, "add \"law\": \"friction\"");
        }
    }

    /// Reports the fields that the law of a contact needs and that are missing.
    fn lacks(
        &mut self,
        name: &Text,
        contact: &ContactFile,
        what: &str,
        all: &[(bool, (&str, &str))],
    ) {
        for (_, (field, hint)) in all.iter().filter(|(missing, _)| *missing) {
            if is_sound(contact.span, &self.faults) {
                self.report(name.span, format!("a {what} needs `{field}`"), *hint);
            }
        }
    }

    /// The law of a contact with friction.
    fn friction(
        &mut self,
        name: &Text,
        contact: &ContactFile,
        restitution: Option<Expr>,
        has_normal: bool,
    ) -> Option<ContactLaw> {
        let brach = contact.hypothesis == Some(HypothesisName::Brach);
        let no_mu = contact.mu.is_none() && !(brach && contact.impulse_ratio.is_some());
        let missing = [
            (!has_normal, NORMAL),
            (contact.restitution.is_none(), REBOUND),
            (no_mu, ("mu", "the coefficient of friction, 0 or greater")),
        ];
        self.lacks(name, contact, "contact with friction", &missing);
        let number = |this: &mut Self, f: &Option<Formula>, claim: fn(Expr) -> Claim| {
            let f = f.as_ref()?;
            let value = this.read(f, Quantity::NUMBER)?;
            this.claim(f.span, claim(value.clone()));
            Some(value)
        };
        let mu = number(self, &contact.mu, Claim::Friction);
        let tangential = number(self, &contact.tangential_restitution, Claim::Tangential);
        let ratio = contact.impulse_ratio.as_ref();
        let ratio = ratio.and_then(|f| self.read(f, Quantity::NUMBER));
        let [ruina, brach_only] = [HypothesisName::ChatterjeeRuina, HypothesisName::Brach];
        let (tangent, ratio_of) = (&contact.tangential_restitution, &contact.impulse_ratio);
        let own = [
            ("tangential_restitution", tangent, ruina, "chatterjee-ruina"),
            ("impulse_ratio", ratio_of, brach_only, "brach"),
        ];
        for (field, given, owner, word) in own {
            if let Some(f) = given.as_ref().filter(|_| contact.hypothesis != Some(owner)) {
                let message = format!("`{field}` belongs to the hypothesis {word}");
                let hint = format!("add \"hypothesis\": \"{word}\"");
                self.report(f.span, message, hint);
            }
        }
        let hypothesis = match contact.hypothesis {
            Some(HypothesisName::Newton) => Hypothesis::Newton,
            None | Some(HypothesisName::Poisson) => Hypothesis::Poisson,
            Some(HypothesisName::Stronge) => Hypothesis::Stronge,
            Some(HypothesisName::ChatterjeeRuina) => Hypothesis::ChatterjeeRuina {
                tangential: tangential.unwrap_or_else(Expr::zero),
            },
            Some(HypothesisName::Brach) => Hypothesis::Brach { ratio },
        };
        let supposing = contact.supposing.map(|supposed| match supposed {
            SupposedName::Slides => Mode::Slides,
            SupposedName::Sticks => Mode::Sticks,
            SupposedName::SticksInCompression => Mode::SticksInCompression,
            SupposedName::SticksInRestitution => Mode::SticksInRestitution,
            SupposedName::ReversesInCompression => Mode::ReversesInCompression,
            SupposedName::ReversesInRestitution => Mode::ReversesInRestitution,
            SupposedName::InsideCone => Mode::InsideCone,
            SupposedName::OnCone => Mode::OnCone,
        });
        let by_cone = matches!(hypothesis, Hypothesis::ChatterjeeRuina { .. });
        let is_cone = |mode: &Mode| matches!(mode, Mode::InsideCone | Mode::OnCone);
        if let Some(mode) = supposing.filter(|mode| is_cone(mode) != by_cone) {
            let (words, law) = (mode.words(), hypothesis.name());
            let message = format!("the law of {law} knows no `{words}`");
            let hint = match by_cone {
                true => {
                    "its impulse lies \"inside the cone\", where the slip ends as `tangential_restitution` says, or \"on the cone\", where it does not"
                }
                false => "the contact slides or sticks; the cone belongs to \"chatterjee-ruina\"",
            };
            self.report(contact.span, message, hint);
        }
        Some(ContactLaw::Friction(Box::new(Friction {
            mu: mu.or_else(|| brach.then(Expr::zero))?,
            restitution: restitution?,
            hypothesis,
            supposing,
        })))
    }

    pub(super) fn known(&mut self, known: &KnownFile) -> Option<Known> {
        let what = match (&known.velocity, &known.spin) {
            (Some(body), None) => {
                let body = self.moving(body);
                let at = known.at.as_ref().map(|at| self.position(at));
                let Some(along) = &known.along else {
                    let message = "a known velocity needs the direction `along` which it is known";
                    let hint = "add \"along\": [\"1\", \"0\"]; a vector takes two entries";
                    return self.refuse(known.span.opening(), message, hint);
                };
                let along = self.direction(along);
                let to = known.relative_to.as_ref().map(|other| {
                    let to = self.body_named(other)?;
                    if Some(to) != body {
                        return Some(to);
                    }
                    let message = format!("`{}` does not move relative to itself", other.text);
                    Fault::new(other.span, message).add_to(&mut self.faults)
                });
                let at = match at {
                    Some(at) => at,
                    None => body.and_then(|b| self.center(b)),
                };
                let what = KnownQuantity::Velocity {
                    at: at?,
                    along: along?,
                    to: to.map_or(Some(None), |to| to.map(Some))?,
                };
                (body?, what, Quantity::VELOCITY)
            }
            (None, Some(body)) => {
                if known.at.is_some() || known.along.is_some() || known.relative_to.is_some() {
                    let message = "a known spin has no `at`, no `along` and no `relative_to`";
                    self.faults.push(Fault::new(known.span, message));
                }
                let index = self.moving(body)?;
                if self.is_particle(index) {
                    let message = format!("the particle `{}` has no spin", body.text);
                    return Fault::new(body.span, message).add_to(&mut self.faults);
                }
                (index, KnownQuantity::Spin, Quantity::SPIN)
            }
            _ => {
                let message = "something known after is either a `velocity` or a `spin`";
                let hint = "its value is the body's name";
                return self.refuse(known.span, message, hint);
            }
        };
        let value = self.symbols.read(&known.is, what.2, &mut self.faults)?;
        Some(Known {
            name: text(&known.name),
            body: what.0,
            what: what.1,
            value,
        })
    }

    /// The two bodies of a hinge or contact: different, and not both immovable.
    pub(super) fn pair(&mut self, names: &[Text; 2], span: Span, what: &str) -> Option<[usize; 2]> {
        let (a, b) = (self.body_named(&names[0]), self.body_named(&names[1]));
        let (a, b) = (a?, b?);
        if a == b {
            let name = &names[0].text;
            let message = format!("a {what} is between two bodies, not `{name}` and itself");
            return Fault::new(span, message).add_to(&mut self.faults);
        }
        if self.shape(a) == Some(ShapeName::Fixed) && self.shape(b) == Some(ShapeName::Fixed) {
            let message = format!(
                "`{}` and `{}` are both fixed: nothing can happen between them",
                names[0].text, names[1].text
            );
            return Fault::new(span, message).add_to(&mut self.faults);
        }
        Some([a, b])
    }

    /// A particle can only be touched where it is.
    pub(super) fn reach(&mut self, bodies: [usize; 2], at: &Vector, span: Span, name: &str) {
        for body in bodies {
            if self.is_particle(body)
                && let Some(center) = self.center(body)
            {
                let claim = Claim::AtParticle {
                    offset: minus(at, &center),
                    at: name.to_owned(),
                    body,
                };
                self.claims.push(Claimed { span, claim });
            }
        }
    }
}
