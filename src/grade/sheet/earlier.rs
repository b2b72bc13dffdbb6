//! Answers that stand on answers to earlier questions by their names: `m v²/2 − m ℓ² ω²/6`, where ω was asked before.

use std::collections::{BTreeMap, BTreeSet};

use super::super::{Given, Key, key_of, read, show, unit};
use super::{Entry, Sheet};
use crate::answer::Form;
use crate::expr::{Expr, Symbol, only};
use crate::formula::{self, Content, Reading};

/// Size beyond which a named part is not put in.
const LONGEST: usize = 2_000;

impl Sheet {
    /// An answer with the right values put in for the names of earlier answers, and these in words; nothing where the answer
    /// is read without them, or uses none.
    pub(super) fn with_earlier(
        &self,
        entry: &Entry,
        answer: &str,
    ) -> Option<(String, Vec<String>)> {
        let alone = read::answer(&entry.key, answer);
        let (key, values) = self.key_with_earlier(entry);
        // A time that was asked for is no stranger.
        let named = |name: &Symbol| read::is_stranger(name) && values.contains_key(name);
        // And a way that was asked for is no second.
        let unit = |reading: &Reading| {
            let places = unit::misfit(&entry.key, answer, reading)?;
            let mut letters = places.into_iter().map(|at| &answer[at..=at]);
            letters.find(|letter| values.contains_key(*letter))
        };
        // In `2K` an energy that was asked for is no kelvin.
        let measured = |reading: &Reading| match reading.content.answer() {
            Content::Quantity(q) => {
                let fits = entry.key.question.dimension.as_ref() == Some(&q.unit.dimension);
                !fits && values.contains_key(q.unit_text.as_str())
            }
            _ => false,
        };
        let used = |r: &Reading| r.symbols().iter().any(named) || unit(r).is_some() || measured(r);
        if alone.is_ok_and(|reading| !used(&reading)) {
            return None;
        }
        let content = read::answer(&key, answer).ok()?.content;
        let used = content.symbols();
        // In a case in which nothing moves everything is nothing.
        let none = |e: Option<&Expr>| e.is_some_and(Expr::is_zero);
        let idle = none(entry.key.reading.content.answer().expr())
            && used.iter().any(|name| none(values.get(name)));
        if idle && !(self.given.is_empty() && self.otherwise.is_empty()) {
            return None;
        }
        let told = |(name, value): (&Symbol, &Expr)| {
            let value = crate::formula::write_plain(value);
            (used.contains(name) && !name.ends_with("_hat_z")).then(|| format!("{name} = {value}"))
        };
        let told: Vec<String> = values.iter().filter_map(told).collect();
        let put_in = content.map(&|e| e.substitute(&values));
        (!told.is_empty()).then(|| (show(&put_in), told))
    }

    /// A key that knows the names of earlier answers, and what these are.
    pub(super) fn key_with_earlier<'a>(
        &'a self,
        entry: &'a Entry,
    ) -> (Key, BTreeMap<Symbol, Expr>) {
        // A vector is known by its components.
        let of = |question: &'a str| {
            let answers = self.derivation.answers.iter();
            let answers = answers.filter(move |a| a.question == question);
            answers.filter(|a| {
                let component = a.name.strip_prefix(&a.question);
                component.is_some_and(|axis| matches!(axis, "" | "_x" | "_y"))
            })
        };
        // And of what the short form of the answer is written in: `ω = −3 d P/(m (a² + b²))`, `P_x = (b u_y − c u_x)/D`.
        let own = of(&entry.question.name).filter_map(|a| match &a.form {
            Form::Value { short, .. } => Some(short.symbols()),
            _ => None,
        });
        let mut printed: BTreeSet<Symbol> = own.flatten().collect();
        let mut parts = BTreeMap::new();
        for part in self.derivation.definitions.iter().rev() {
            if printed.contains(&part.name) {
                printed.extend(part.value.symbols());
            }
        }
        for part in &self.derivation.definitions {
            let value = part.value.substitute(&parts);
            if printed.contains(&part.name) && value.size() <= LONGEST {
                parts.insert(part.name.clone(), value);
            }
        }
        let mut asked = self.scene.questions.iter();
        let before = asked.by_ref().take_while(|q| q.name != entry.question.name);
        let before: Vec<_> = before.flat_map(|q| of(&q.name)).collect();
        let later = asked.flat_map(|q| of(&q.name));
        let later = later.filter(|a| printed.contains(a.name.as_str()));
        let known = before.into_iter().chain(later);
        let known = known.filter_map(|a| Some((a.name.as_str().into(), a.formula()?.clone())));
        let mut values: BTreeMap<Symbol, Expr> = parts.into_iter().chain(known).collect();
        let given = |name: &Symbol| self.scene.parameter(name).is_some();
        let asked = |name: &Symbol| of(&entry.question.name).any(|a| *a.name == **name);
        // The unit vectors along the only normal and tangent.
        let contacts = self.impact(entry).0.contacts.iter();
        if let Some([x, y]) = only(contacts.filter_map(|c| c.normal.as_ref())) {
            let [n, t] = ["n_hat", "t_hat"].map(formula::along_axes);
            values.extend(n.into_iter().zip([x.clone(), y.clone(), Expr::zero()]));
            values.extend(t.into_iter().zip([-y, x.clone(), Expr::zero()]));
        }
        values.retain(|name, _| !given(name) && !asked(name));
        let mut question = entry.key.question.clone();
        question
            .symbols
            .extend(values.keys().cloned().map(Given::named));
        let key = key_of(entry.key.reading.content.clone(), &question);
        (key, values)
    }
}
