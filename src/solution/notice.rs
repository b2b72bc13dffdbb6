//! What to notice in the results: units, signs, what does not matter, limits, energy. Each remark is computed and then proved by
//! the algebra before it is said; what cannot be shown is not said.

use std::collections::BTreeMap;

use super::words::{self, fill, say};
use super::{Claim, Inline, Part, Writer};
use crate::algebra::{Field, Sign};
use crate::answer::solve::{real, solve};
use crate::answer::{Answer, Form};
use crate::dimension::Dimension;
use crate::expr::{Expr, Symbol};
use crate::formula::Sentence;
use crate::laws::Unknown;
use crate::scene::{Ask, EnergyWhen, ImpulseAt, Parameter};
use crate::verify::needed_friction;

/// Largest value, in nodes of its formula, that is worth a remark.
const NOTICED: usize = 30;

/// Remarks about limits that a reader is glad to have; more would bury them.
const LIMITS: usize = 2;
/// Largest value, in nodes, at which something vanishes that is worth a remark.
const SHORT: usize = 8;
/// Largest loss of energy, in nodes, that is worked out for a remark alone.
const LONGEST: usize = 1_000;

impl Writer<'_> {
    /// The section of remarks; absent where there is nothing true to say.
    pub(super) fn notice(&mut self) {
        let mut items: Vec<Vec<Inline>> = Vec::new();
        items.extend(self.energy_remark());
        items.extend(self.signs());
        items.extend(self.friction_remarks());
        items.extend(self.independent());
        items.extend(self.zeros());
        items.extend(self.limits());
        if items.is_empty() {
            return;
        }
        self.section(vec![say("What the results say")]);
        self.push(Part::List(items));
    }

    fn closed(&self) -> Vec<(Answer, Expr)> {
        self.d
            .answers
            .iter()
            .filter_map(|a| match &a.form {
                Form::Value { closed, .. } => Some((a.clone(), closed.clone())),
                _ => None,
            })
            .collect()
    }

    pub(super) fn sign(&mut self, e: &Expr) -> Option<Sign> {
        let element = self.field.element(e).ok()?;
        self.field.sign(&element)
    }

    /// Kinetic energy before, and what is lost of it.
    fn energies(&mut self) -> Option<(Expr, Expr)> {
        let half = Expr::ratio(1, 2);
        let mut before = Vec::new();
        let mut after = Vec::new();
        for (b, body) in self.scene.bodies.iter().enumerate() {
            if body.is_fixed() {
                continue;
            }
            let squares = |v: &[Expr; 2], w: &Expr| {
                let turning = if body.is_particle() {
                    Expr::zero()
                } else {
                    &half * &body.inertia * w.powi(2)
                };
                &half * &body.mass * (v[0].powi(2) + v[1].powi(2)) + turning
            };
            before.push(squares(&body.velocity, &body.spin));
            let v = [
                self.d.motion.get(&Unknown::Velocity(b, 0))?.clone(),
                self.d.motion.get(&Unknown::Velocity(b, 1))?.clone(),
            ];
            let w = match self.d.motion.get(&Unknown::Spin(b)) {
                Some(w) => w.clone(),
                None if body.is_particle() => Expr::zero(),
                None => return None,
            };
            after.push(squares(&v, &w));
        }
        let before = Expr::sum(before);
        let tidy_before = self.normal(&before)?;
        let asked = self.scene.asked_of_impact().find(|q| is_lost(&q.ask));
        let answered = self
            .closed()
            .into_iter()
            .find(|(a, _)| asked.is_some_and(|q| q.name == a.question));
        if let Some((_, lost)) = answered {
            return Some((tidy_before, lost));
        }
        let lost = &before - &Expr::sum(after);
        // A remark is not worth more work than the derivation.
        if lost.size() > LONGEST {
            return None;
        }
        Some((tidy_before, self.normal(&lost)?))
    }

    /// The normal form, unless a limit is met.
    fn normal(&mut self, e: &Expr) -> Option<Expr> {
        let element = self.field.proved(e).ok()??;
        Some(self.field.expr(&element))
    }

    /// What happens to the kinetic energy, and where.
    fn energy_remark(&mut self) -> Option<Vec<Inline>> {
        let (before, lost) = self.energies()?;
        if !self.scene.blows.is_empty() || before.is_zero() {
            return None;
        }
        let moving_wall =
            self.scene.bodies.iter().any(|b| {
                b.is_fixed() && !(b.velocity.iter().all(Expr::is_zero) && b.spin.is_zero())
            });
        if moving_wall {
            return None;
        }
        if lost.is_zero() {
            // Where the loss is asked for, its box says so.
            let mut asked = self.scene.asked_of_impact();
            let is_asked = asked.any(|q| is_lost(&q.ask));
            return (!is_asked).then(|| vec![say("No kinetic energy is lost.")]);
        }
        let contacts = self.scene.contacts.iter();
        let places: Vec<String> = contacts.map(|c| words::place(&c.name, "contact")).collect();
        let sign = self.sign(&lost)?;
        // Only a short fraction is worth telling.
        let fraction =
            (lost.size() < 80).then(|| self.normal(&(&lost / &before)).filter(|f| f.size() < 40));
        if !sign.is_not_negative() {
            return None;
        }
        let at = match places.as_slice() {
            [one] => format!(" at {one}"),
            _ => String::from(" in the contacts"),
        };
        let joints = match self.scene.hinges.as_slice() {
            [] => String::new(),
            [one] => format!(", none at the hinge {}", one.name),
            _ => String::from(", none at the hinges"),
        };
        let Some(fraction) = fraction.flatten() else {
            let words = match sign == Sign::Positive {
                true => format!("Kinetic energy is lost{at}{joints}."),
                false => format!("Kinetic energy is never gained; any loss is{at}{joints}."),
            };
            return Some(vec![say(words)]);
        };
        let parts = [words::formula(&fraction), say(at), say(joints)];
        let claim = Claim::new(lost, fraction * before);
        let reason = "the fraction of kinetic energy lost";
        self.step(Vec::new(), vec![claim], reason);
        Some(fill(
            "Of the kinetic energy, the fraction {} is lost{}{}.",
            parts,
        ))
    }

    /// Spins whose sign is proved, and a loss that is a gain.
    fn signs(&mut self) -> Vec<Vec<Inline>> {
        let mut items = Vec::new();
        for (answer, closed) in self.closed() {
            let question = self.scene.question_of_impact(&answer.question);
            let symbol = words::formula(&Expr::symbol(&answer.name));
            let ask = question.map(|q| q.ask.clone());
            if ask.as_ref().is_some_and(is_lost) && self.sign(&closed) == Some(Sign::Negative) {
                items.push(fill("{} is negative: kinetic energy is gained.", [symbol]));
                continue;
            }
            let Some(Ask::Spin { body, clockwise }) = ask else {
                continue;
            };
            let (is, positive) = match self.sign(&closed) {
                Some(Sign::Positive) => ("positive", true),
                Some(Sign::Negative) => ("negative", false),
                _ => continue,
            };
            let sense = match positive == clockwise {
                true => "clockwise",
                false => "counterclockwise",
            };
            let whom = words::body(self.scene, body);
            let parts = [symbol, say(is), say(whom), say(sense)];
            items.push(fill("{} is {}: {} turns {}.", parts));
        }
        items
    }

    /// What friction the contacts need that are taken to stick.
    fn friction_remarks(&self) -> Vec<Vec<Inline>> {
        let each = self.scene.contacts.iter().enumerate();
        let each = each.filter_map(|(i, contact)| {
            let ratio = needed_friction(self.scene, self.d, i)?;
            let place = words::place(&contact.name, "contact");
            Some(fill(
                "To stick, {} needs a coefficient of friction of at least {}.",
                [say(place), words::formula(&ratio)],
            ))
        });
        each.collect()
    }

    /// Masses that cancel, and lengths that do not matter.
    fn independent(&mut self) -> Vec<Vec<Inline>> {
        let answers = self.closed();
        // What does not matter for the same answers is said at once.
        let mut said: Vec<(Vec<Symbol>, Vec<Symbol>)> = Vec::new();
        for parameter in &self.scene.parameters {
            let mass = &parameter.name;
            let mut motion = self.d.motion.values();
            if parameter.dimension.mass == crate::expr::ratio(0, 1)
                || !motion.any(|e| e.mentions(mass))
            {
                continue;
            }
            let free = answers.iter().filter(|(a, closed)| {
                !closed.is_zero() && !closed.mentions(mass) && !a.dimension.is_none()
            });
            let free: Vec<Symbol> = free.map(|(a, _)| Symbol::from(a.name.as_str())).collect();
            match said.iter_mut().find(|(_, answers)| *answers == free) {
                Some((masses, _)) => masses.push(mass.clone()),
                None if free.is_empty() => {}
                None => said.push((vec![mass.clone()], free)),
            }
        }
        let depends = |(masses, free): (Vec<Symbol>, Vec<Symbol>)| {
            let verb = if free.len() == 1 { "does" } else { "do" };
            let [free, masses] = [
                words::symbols(&free, " and "),
                words::symbols(&masses, " or "),
            ];
            let verb = say(format!(" {verb} not depend on "));
            [free, vec![verb], masses, vec![say(".")]].concat()
        };
        said.into_iter().map(depends).collect()
    }

    /// The one length or mass for which an impulse or a component of the motion vanishes: a hinge that feels nothing, a ball
    /// that stops dead.
    fn zeros(&mut self) -> Vec<Vec<Inline>> {
        let lone = [Dimension::new(0, 1, 0), Dimension::new(1, 0, 0)];
        let mut said: Vec<(Vec<Symbol>, Inline, bool)> = Vec::new();
        for (answer, closed) in self.closed() {
            let ask = self.scene.question_of_impact(&answer.question);
            let ask = ask.map(|q| &q.ask);
            let at_hinge = matches!(
                ask,
                Some(Ask::Impulse {
                    from: ImpulseAt::Hinge(_),
                    ..
                })
            );
            let asked = matches!(
                ask,
                Some(Ask::Impulse { .. } | Ask::Velocity { .. } | Ask::Spin { .. })
            );
            if !asked || closed.is_zero() || closed.size() > 2 * NOTICED {
                continue;
            }
            // Where a body is hit is chosen more freely than how long it is.
            let is_size = |p: &&Parameter| {
                let mut bodies = self.scene.bodies.iter();
                bodies.any(|b| b.inertia.mentions(&p.name))
            };
            let needed = self.needed().filter_map(Sentence::condition);
            let domains = needed.fold(self.scene.domains.clone(), |all, (e, is_open)| {
                all.given(&e, !is_open)
            });
            let parameters = self.scene.parameters.iter();
            let (sizes, places): (Vec<_>, Vec<_>) = parameters.partition(is_size);
            let zero = places
                .into_iter()
                .chain(sizes)
                .filter(|p| lone.contains(&p.dimension) && closed.mentions(&p.name))
                .find_map(|p| {
                    let roots = solve(&closed, &p.name, &domains).ok()?;
                    let [root] = roots.inside.as_slice() else {
                        return None;
                    };
                    let tells = root.proved && root.given.is_empty() && !root.value.is_zero();
                    let tells = tells && self.fits(&p.name, &root.value);
                    (tells && root.value.size() <= SHORT).then(|| {
                        (
                            p.dimension == lone[0],
                            words::equation(&Expr::symbol(&p.name), &root.value),
                        )
                    })
                });
            if let Some((is_length, at)) = zero {
                let name = Symbol::from(answer.name.as_str());
                match said.iter_mut().find(|(_, where_, _)| *where_ == at) {
                    Some((names, ..)) => names.push(name),
                    None => said.push((vec![name], at, at_hinge && is_length)),
                }
            }
        }
        said.truncate(LIMITS);
        let each = said.into_iter().map(|(names, at, percussion)| {
            let verb = if names.len() == 1 {
                "vanishes"
            } else {
                "vanish"
            };
            let end = match percussion {
                true => ", where the center of percussion is hit.",
                false => ".",
            };
            let tail = fill(" {} for {}{}", [say(verb), at, say(end)]);
            [words::symbols(&names, " and "), tail].concat()
        });
        each.collect()
    }

    /// Whether every place of the scene is real with a value for a parameter.
    fn fits(&self, name: &Symbol, value: &Expr) -> bool {
        let put = BTreeMap::from([(name.clone(), value.clone())]);
        let contacts = self.scene.contacts.iter();
        let places = contacts.flat_map(|c| c.at.iter().chain(c.normal.iter().flatten()));
        let centers = self.scene.bodies.iter().flat_map(|b| &b.center);
        let mut places = places.chain(centers).filter(|e| e.mentions(name));
        places.all(|e| real(&e.substitute(&put), &self.scene.domains).is_empty())
    }

    /// Ends of domains and one mass much larger than the others, where an answer becomes zero or much shorter.
    fn limits(&mut self) -> Vec<Vec<Inline>> {
        let mut found: Vec<(usize, Vec<Inline>)> = Vec::new();
        let answers = self.closed();
        for parameter in self.scene.parameters.clone() {
            if self.is_in_unit_vector(&parameter.name) {
                continue;
            }
            for (value, to) in self.ends(&parameter.name) {
                if self.is_shut_off(&parameter.name, &value, to) {
                    continue;
                }
                let mut zeros = Vec::new();
                let mut others = Vec::new();
                for (answer, closed) in &answers {
                    if !closed.symbols().contains(&parameter.name) || closed.size() > 200 {
                        continue;
                    }
                    let Some(at_end) = self.value_at(closed, &parameter.name, &value, to) else {
                        continue;
                    };
                    if at_end.is_zero() {
                        zeros.push(answer.name.clone());
                    } else if (at_end.size() * 2 <= closed.size() && at_end.size() <= NOTICED)
                        || at_end.size() <= 4
                    {
                        others.push((answer.name.clone(), at_end));
                    }
                }
                if zeros.is_empty() && others.is_empty() {
                    continue;
                }
                let symbol = Expr::symbol(&parameter.name);
                let (lead, there, arrow) = match to {
                    To::Value => ("At {}, ", words::related(&symbol, "=", &value), "="),
                    To::Infinity => {
                        let grows = words::set("{} → ∞", [symbol.into()]);
                        ("As {}, ", grows, "→")
                    }
                };
                let zeros = zeros.into_iter().map(|n| (n, Expr::zero()));
                let pieces = zeros.chain(others).take(3);
                let pieces =
                    pieces.map(|(n, e)| Inline::Math(words::related(&Expr::symbol(&n), arrow, &e)));
                let row = words::row(pieces, " and ");
                let text = [fill(lead, [Inline::Math(there)]), row, vec![say(".")]].concat();
                let rank = usize::from(to == To::Infinity);
                found.push((rank, text));
            }
        }
        found.sort_by_key(|(rank, _)| *rank);
        found.truncate(LIMITS);
        found.into_iter().map(|(_, text)| text).collect()
    }

    fn is_in_unit_vector(&self, name: &Symbol) -> bool {
        let pairs = &self.scene.domains.unit_vectors;
        pairs.iter().any(|pair| pair.contains(name))
    }

    /// Closed ends of a parameter's domain; for masses 0 and ∞ as limits.
    fn ends(&self, name: &Symbol) -> Vec<(Expr, To)> {
        let mut out = Vec::new();
        let Some(domain) = self.scene.domains.symbols.get(name) else {
            return out;
        };
        for limit in [&domain.low, &domain.high].into_iter().flatten() {
            let value = limit.expr();
            if !limit.open {
                out.push((value, To::Value));
            }
        }
        let is_mass = |p: &&Parameter| p.dimension == Dimension::new(1, 0, 0);
        let masses: Vec<_> = self.scene.parameters.iter().filter(is_mass).collect();
        if masses.len() > 1 && masses.iter().any(|p| p.name == *name) {
            out.push((Expr::zero(), To::Infinity));
        }
        out
    }

    /// Whether a relation of the scene, or what makes the collision possible, keeps a parameter from an end.
    fn is_shut_off(&mut self, name: &Symbol, value: &Expr, to: To) -> bool {
        let relations = self.scene.domains.relations.iter();
        let relations = relations.map(|r| r.excess.clone());
        let needed = self.needed().filter_map(Sentence::condition);
        let all = relations.chain(needed.map(|(excess, _)| excess));
        let own: Vec<Expr> = all.filter(|excess| excess.mentions(name)).collect();
        own.into_iter().any(|excess| {
            // Far out the leading term decides.
            let at_end = match to {
                To::Value => self.value_at(&excess, name, value, to),
                To::Infinity => self.value_at(&(excess / Expr::symbol(name)), name, value, to),
            };
            at_end.is_some_and(|e| self.sign(&e) == Some(Sign::Negative))
        })
    }

    /// The closed form at an end, where it has a value there.
    fn value_at(&mut self, closed: &Expr, name: &Symbol, value: &Expr, to: To) -> Option<Expr> {
        if to == To::Value {
            return self.put(closed, name, value);
        }
        // x → ∞ is 1/x → 0: first in normal form, so that nothing is divided by zero on the way.
        let turned = self.put(closed, name, &Expr::symbol(name).powi(-1))?;
        self.put(&turned, name, &Expr::zero())
    }

    fn put(&mut self, e: &Expr, name: &Symbol, value: &Expr) -> Option<Expr> {
        let at = e.substitute(&BTreeMap::from([(name.clone(), value.clone())]));
        let mut field = Field::new(&self.scene.domains);
        field.prepare([&at]);
        let element = field.proved(&at).ok()??;
        Some(field.expr(&element))
    }
}

/// How a parameter reaches a value.
#[derive(Clone, Copy, PartialEq, Eq)]
enum To {
    /// It takes the value.
    Value,
    /// It grows beyond all bounds.
    Infinity,
}

/// Whether the kinetic energy that is lost is asked for.
fn is_lost(ask: &Ask) -> bool {
    matches!(
        ask,
        Ask::Energy {
            when: EnergyWhen::Lost,
            of: None
        }
    )
}
