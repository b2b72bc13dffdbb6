//! Whether a derived collision can happen: bodies touch where they are, come together, do not enter each other, push and
//! do not pull, and gain no energy.
//!
//! In: the scene of one impact, its bodies where they stand then, and its derivation. Out: conditions, each decided for
//! symbols (everywhere, where, nowhere, undecided) from the closed forms, and for given values from the independent numeric
//! solution. The laws of the derivation are not asked: a motion that fulfils all of them may still be impossible.
//!
//! The rules, for the relative velocity u of the second body against the first at a contact (u⁻ before, u⁺ after), a normal
//! n out of the first body, and the impulse P on the second (unilateral contact: Glocker, "Set-Valued Force Laws", ch. 5;
//! Pfeiffer and Glocker, "Multibody Dynamics with Unilateral Contacts", ch. 8):
//! - place: the contact lies on the outlines of its bodies; [`crate::scene::touch`] tells which have one;
//! - approach: u⁻·n ≤ 0; otherwise the bodies part before they collide. A sticking contact grips and may catch what moves
//!   away, like a hook; it has to approach only along a normal that the scene gives;
//! - apart: u⁺·n ≥ 0 at every touching point, also at the ends of straight sides that lie along each other (first order:
//!   positions are frozen during the impact). At the point of a sticking contact itself u⁺ = 0 by its law; a bullet may go
//!   through where the scene says so;
//! - push: P·n ≥ 0, except where the contact sticks: what grips may pull, and that is told where n is given;
//! - energy: nothing is gained at all contacts together, −Σ ½ P·(u⁻ + u⁺) ≥ 0 (Kelvin's theorem; moving walls do their work
//!   outside this sum). Where all contacts have one restitution, Carnot's theorem gives it; where a blow acts at the same
//!   instant, the sum depends on the order of events and is not judged;
//! - restitution: of a contact without law, u⁺·n ≤ −u⁻·n, so that the implied e = −u⁺·n/u⁻·n is at most 1;
//! - supposed: given values keep to what is supposed of a contact with friction.
//!
//! Energy and restitution do not apply to a scene that says it gains energy. The normal is the one the scene gives, and that of the
//! outlines wherever they have one: none at corners, at the ends of rods and inside a body. A thin rod or a ring can be
//! touched from either side; then n points to the body that touches it, as its center or its approach tells.

mod decide;
mod judge;
mod sides;

use std::collections::BTreeMap;

use crate::algebra::Sign;
use crate::answer::calc::constant;
use crate::domain::Domains;
use crate::expr::{Expr, Symbol};
use crate::formula::{Sentence, sentence, write_plain};

use decide::{Decided, decide};

pub use judge::judge;

/// Where in the domain something holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// On the whole domain.
    Everywhere,
    /// On a part of it.
    Where,
    /// At no point of it.
    Nowhere,
    /// Not known.
    Undecided,
}

/// The rule a condition comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Rule {
    Place,
    Approach,
    Apart,
    Push,
    Energy,
    Restitution,
    Supposed,
}

impl Rule {
    /// Its stable name.
    pub fn name(self) -> &'static str {
        match self {
            Rule::Place => "place",
            Rule::Approach => "approach",
            Rule::Apart => "apart",
            Rule::Push => "push",
            Rule::Energy => "energy",
            Rule::Restitution => "restitution",
            Rule::Supposed => "supposed",
        }
    }
}

/// Something that must hold for the collision to be possible.
#[derive(Clone, Debug)]
pub struct Condition {
    /// The rule it comes from.
    pub rule: Rule,
    /// What must hold, such as "the bodies approach at `C`".
    pub words: String,
    /// What happens where it does not hold, such as "the bodies separate at `C` before they collide".
    pub otherwise: String,
    /// Whether it holds for symbols.
    pub verdict: Verdict,
    /// What must not be negative, without positive factors: a polynomial that a person can read as a condition. Present
    /// where the verdict is [`Verdict::Where`].
    pub essential: Option<Expr>,
    /// Whether `essential` must be zero, and not only not negative.
    pub is_equation: bool,
    /// Whether it holds at the given values; `None` without them.
    pub at_values: Option<bool>,
}

impl Condition {
    fn decided(&self) -> Decided {
        Decided {
            verdict: self.verdict,
            essential: self.essential.clone(),
        }
    }

    /// What it asks of the parameters where it holds on a part of the domain only, with its reason.
    pub fn told(&self) -> Option<Sentence> {
        let essential = self.essential.as_ref()?;
        let holds = match (self.is_equation, self.rule) {
            (true, _) => Sentence::zero(essential),
            // Bodies at rest against each other do not collide.
            (false, Rule::Approach) => Sentence::positive(essential),
            (false, _) => Sentence::not_negative(essential),
        };
        Some(sentence!("{} ({})", holds, &self.words))
    }

    /// Whether it holds on some of a part of the domain, and not on all of it.
    pub fn divides(&self, part: &Domains) -> bool {
        let essential = self.essential.as_ref().filter(|_| !self.is_equation);
        essential.is_some_and(|e| decide(e, part).verdict == Verdict::Where)
    }
}

/// The outcome.
#[derive(Clone, Debug)]
pub struct Possible {
    /// For symbols: the least of what the conditions allow.
    pub verdict: Verdict,
    /// At the given values; `None` without them.
    pub at_values: Option<bool>,
    /// All conditions that were looked at.
    pub conditions: Vec<Condition>,
    /// What could not be judged, in words; then the verdict is at best undecided.
    pub not_judged: Vec<String>,
    /// What is worth knowing besides, in words.
    pub notes: Vec<String>,
    /// Whether several contacts without friction collide at once, for which there are other laws.
    pub beside: bool,
}

impl Possible {
    /// Whether the collision can happen, as far as is known: not refuted for all parameters or at the given values.
    pub fn holds(&self) -> bool {
        self.verdict != Verdict::Nowhere && self.at_values != Some(false)
    }

    /// The sentence that stands first where the result is not possible.
    pub fn refusal(&self) -> Option<String> {
        if self.holds() {
            return None;
        }
        let whatever = match self.verdict {
            Verdict::Nowhere => "whatever the parameters",
            _ => "at the given values",
        };
        let reasons = self.reasons().join("; ");
        let refuses = |c: &Condition| c.verdict == Verdict::Nowhere || c.at_values == Some(false);
        let refusing: Vec<Rule> = {
            let all = self.conditions.iter().filter(|c| refuses(c));
            all.map(|c| c.rule).collect()
        };
        let is_turned = [Rule::Apart, Rule::Push]
            .iter()
            .all(|r| refusing.contains(r));
        let may = if refusing.iter().all(|rule| *rule == Rule::Energy) {
            "; where a charge, a spring or a motor gives it, the scene has \"gains_energy\": true"
        } else if self.beside {
            "; with values, `carom compare` tells what several contacts at once give"
        } else if is_turned {
            "; a normal leads from the first body to the second: turn it, or exchange the bodies"
        } else {
            ""
        };
        Some(format!("not possible: {reasons}, {whatever}{may}"))
    }

    /// What was looked at and is neither shown nor refuted, nor decided by given values; and what could not be judged.
    pub fn undecided(&self) -> Vec<String> {
        let open = self.conditions.iter();
        let open = open.filter(|c| c.verdict == Verdict::Undecided && c.at_values.is_none());
        let mut all: Vec<String> = open.map(|c| format!("whether {}", c.words)).collect();
        all.dedup();
        all.extend(self.not_judged.iter().cloned());
        all
    }

    /// Why it cannot happen; empty where it can.
    pub fn reasons(&self) -> Vec<&str> {
        let mut reasons: Vec<&str> = Vec::new();
        for c in &self.conditions {
            let fails = c.verdict == Verdict::Nowhere || c.at_values == Some(false);
            if fails && !reasons.contains(&c.otherwise.as_str()) {
                reasons.push(&c.otherwise);
            }
        }
        reasons
    }

    /// Puts in what stands for the motion handed on by an earlier stage, and the given values.
    pub fn put(
        &mut self,
        handed: &BTreeMap<Symbol, Expr>,
        values: &BTreeMap<Symbol, Expr>,
        domains: &Domains,
    ) {
        if handed.is_empty() {
            return;
        }
        for condition in &mut self.conditions {
            let Some(essential) = condition
                .essential
                .as_ref()
                .filter(|_| !condition.is_equation)
            else {
                continue;
            };
            let outright = essential.substitute(handed);
            let decided = decide(&outright, domains);
            (condition.verdict, condition.essential) = (decided.verdict, decided.essential);
            let number = outright.substitute(values);
            if condition.at_values.is_none() && number.is_constant() {
                let sign = decide::sign(&number, domains);
                condition.at_values = sign.map(Sign::is_not_negative);
            }
        }
        decide::without_consequences(&mut self.conditions, domains);
        (self.verdict, self.at_values) = concluded(&self.conditions, &self.not_judged);
    }

    /// Takes note that given values do not keep to what is supposed of a contact with friction, where they do not.
    pub fn suppose(&mut self, words: &str, need: &Expr, values: &BTreeMap<Symbol, Expr>) {
        if constant(&need.substitute(values)) != Some(Sign::Negative) {
            return;
        }
        // What else fails there fails for what does not happen.
        let others = self.conditions.iter_mut();
        let others = others.filter(|c| c.rule != Rule::Supposed);
        others.for_each(|c| c.at_values = None);
        let takes = Sentence::not_negative(need).written(write_plain);
        self.conditions.push(Condition {
            rule: Rule::Supposed,
            words: words.to_owned(),
            otherwise: format!("what is supposed, that {words}, does not happen: it takes {takes}"),
            verdict: Verdict::Where,
            essential: None,
            is_equation: false,
            at_values: Some(false),
        });
        (self.verdict, self.at_values) = concluded(&self.conditions, &self.not_judged);
    }

    /// Keeps what a part of the domain grants.
    pub fn given(&mut self, part: &Domains) {
        for condition in &mut self.conditions {
            let essential = condition.essential.as_ref();
            let mut essential = essential.filter(|_| !condition.is_equation).into_iter();
            if essential.any(|e| decide(e, part).verdict == Verdict::Everywhere) {
                (condition.verdict, condition.essential) = (Verdict::Everywhere, None);
            }
        }
        (self.verdict, self.at_values) = concluded(&self.conditions, &self.not_judged);
    }

    /// The conditions on parameters, each once.
    pub fn open(&self) -> Vec<&Condition> {
        let mut open: Vec<&Condition> = Vec::new();
        for c in &self.conditions {
            let seen = |o: &&Condition| o.essential == c.essential;
            if c.verdict == Verdict::Where && !open.iter().any(seen) {
                open.push(c);
            }
        }
        open
    }
}

/// What conditions come to together, for symbols and at the given values.
fn concluded(conditions: &[Condition], not_judged: &[String]) -> (Verdict, Option<bool>) {
    let any = |v| conditions.iter().any(|c| c.verdict == v);
    let open = any(Verdict::Undecided) || !not_judged.is_empty();
    let verdict = match () {
        () if any(Verdict::Nowhere) => Verdict::Nowhere,
        () if any(Verdict::Where) => Verdict::Where,
        () if open => Verdict::Undecided,
        () => Verdict::Everywhere,
    };
    let known: Option<Vec<bool>> = conditions.iter().map(|c| c.at_values).collect();
    let at_values = match conditions.iter().any(|c| c.at_values == Some(false)) {
        true => Some(false),
        false => known.filter(|k| !k.is_empty()).map(|_| true),
    };
    (verdict, at_values)
}

/// Whether an expression is zero on the whole domain, by its normal form.
fn is_zero(e: &Expr, domains: &Domains) -> bool {
    decide::sign(e, domains) == Some(Sign::Zero)
}
