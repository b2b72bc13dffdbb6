//! Special values for which something is printed: whether the scene goes this way there, and where it may be tried.

use std::collections::{BTreeMap, BTreeSet};

use super::desk::{Desk, for_the_coefficient};
use crate::answer::Answer;
use crate::answer::calc::sign;
use crate::domain::{Domains, Origin, Relation};
use crate::equality;
use crate::expr::{Expr, Symbol};
use crate::formula::{self, Content, Quantity, Sentence, Symbols};
use crate::scene::{Print, Printed};

impl Desk<'_> {
    /// The special values; one may be what the scene answers with.
    pub(super) fn special(&self, printed: &Printed) -> Result<BTreeMap<Symbol, Expr>, String> {
        // `0.1 m` for a length, though m be a mass.
        let measured = |name: &str, text: &str| {
            let reading = formula::read(text, &Symbols::strict()).ok()?;
            let fits = |q: &Quantity| {
                let parameter = self.scene.parameter(name);
                parameter.is_some_and(|p| p.dimension == q.unit.dimension)
            };
            match &reading.content {
                Content::Quantity(q) if fits(q) => Some(q.value.clone()),
                _ => None,
            }
        };
        let (mut special, mut others) = (BTreeMap::new(), Vec::new());
        for pair @ [name, text] in &printed.at {
            match measured(name, text) {
                Some(value) => drop(special.insert(Symbol::from(name.as_str()), value)),
                None => others.push(pair.clone()),
            }
        }
        special.extend(self.values_of(&others, printed)?);
        for (name, value) in &mut special {
            if self.scene.parameter(name).is_none() {
                return Err(format!("`at` names {name}, which is no parameter"));
            }
            *value = self.by_answer(value).substitute(&self.closed);
        }
        Ok(special)
    }

    /// What the answers rest on that something printed speaks of.
    fn conditions(&self, printed: &Printed) -> Vec<&Sentence> {
        let text = match &printed.what {
            Print::Formula { item, .. } => item,
            Print::Number { of, .. } => of,
            Print::Equation { text, .. } => text,
            Print::Matrix { .. } => return Vec::new(),
        };
        let read = self.read(text, printed);
        let mut spoken: BTreeSet<Symbol> = read.map_or_else(|_| BTreeSet::new(), |r| r.symbols());
        spoken.insert(Symbol::from(text.as_str()));
        let of = |name: &Symbol| {
            let is_it = |a: &&Answer| *a.name == **name || *a.question == **name;
            let [own, all] = self.answers.map(|answers| answers.iter().find(is_it));
            own.or(all)
        };
        let given = spoken.iter().filter_map(of).flat_map(|a| &a.assumptions);
        given.filter(|words| words.condition().is_some()).collect()
    }

    /// Everything that must hold where something printed is the answer, in words too.
    fn needs(&self, printed: &Printed) -> Vec<Relation> {
        let mut all = self.domains.relations.clone();
        for words in self.conditions(printed) {
            for (excess, strict) in words.conditions() {
                let excess = excess.substitute(&self.closed);
                let words = for_the_coefficient(self.scene, words).to_string();
                all.push(Relation::needed(&excess, !strict, words, Origin::Stated));
            }
        }
        all
    }

    /// What must hold and does not at the values for which something is printed: the special ones, and those of the scene
    /// where there are such or it is a number.
    pub(super) fn excluded(&self, printed: &Printed) -> Option<String> {
        if printed.at.is_empty() {
            if !self.is_so {
                return Some("the values of the scene".into());
            }
            if !matches!(printed.what, Print::Number { .. }) {
                return None;
            }
        }
        let special = self.special(printed).ok()?;
        for (name, value) in &special {
            let domain = self.scene.domains.symbols.get(name);
            if let (Some(domain), Some(value)) = (domain, value.as_number())
                && !domain.contains(value)
                && !domain.is_end(value)
            {
                return Some(domain.words(name));
            }
        }
        let (given, plain) = (self.scene.values(), &self.scene.domains);
        let fails = |e: &Expr| sign(e, plain).is_negative();
        let broken = self.needs(printed).into_iter().find(|need| {
            let there = need.excess.substitute(&special);
            fails(&there) || fails(&there.substitute(&given))
        })?;
        Some(match broken.origin.so_that() {
            Some(what) => format!("{}, so that {what}", broken.words),
            None => broken.words,
        })
    }

    /// Where something printed may be tried: in this case, where the answers hold, and at its special values.
    pub(super) fn domains_of(&self, printed: &Printed) -> Domains {
        let special = self.special(printed).unwrap_or_default();
        let mut domains = self.scene.domains.clone();
        domains.relations = Vec::new();
        for need in self.needs(printed) {
            let there = need.excess.substitute(&special);
            if !there.is_constant() {
                let touched = special.keys().any(|name| need.excess.mentions(name));
                let need = match touched {
                    true => Relation::needed(&there, need.closed, need.words, need.origin),
                    false => need,
                };
                domains = domains.with_relation(need);
            }
        }
        domains
    }
}

/// Whether two relations leave nothing between them: a ≥ b and b ≥ a.
pub(super) fn is_a_boundary(domains: &Domains) -> bool {
    let mut free = domains.clone();
    let all = std::mem::take(&mut free.relations);
    let mut pairs = (1..all.len()).flat_map(|i| (0..i).map(move |j| [i, j]));
    pairs.any(|pair| {
        let [a, b] = pair.map(|i| &all[i].excess);
        equality::vanishes(&(a + b), &free)
    })
}
