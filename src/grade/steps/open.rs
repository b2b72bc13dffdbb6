//! What a line leaves open that fails as it is read: of which moment its rates are, what a name stands for that was said anew
//! and not read, and what its words only suppose.

use super::sought::Sought;
use std::collections::BTreeSet;

use super::super::believed::Story;
use super::link::{Link, Values, gaps, names_in};
use super::names::named;
use super::{Desk, Diagnosis, Found, MOMENT, Status};
use crate::expr::{Expr, Symbol};
use crate::formula::Content;
use crate::scene::Ask;

/// Words before an equation by which something given is no more than supposed.
const SUPPOSED: [&str; 3] = ["is", "are", "with"];

/// The remark that a line may be so for want of what it speaks of.
pub(super) fn vanishes() -> Diagnosis {
    let words = "what vanishes at this moment may stand in this line with any factor";
    let hint = "check the signs of the terms that vanish, or say which moment is meant";
    Diagnosis::new("VANISHES", words, hint)
}

impl Desk<'_> {
    /// What is found of a line that fails and tells of no certain moment, or of something that is not known.
    pub(super) fn left_open(&self, links: &[Link]) -> Option<Found> {
        let which = |words: &str| vec![Diagnosis::new(MOMENT, words, "say which moment is meant")];
        if self.is_unclear(links) || self.is_of_a_place(links) {
            return Some((Status::Undecided, Vec::new()));
        }
        if self.is_lost_in_a_body(links) {
            return Some((Status::Undecided, vec![vanishes()]));
        }
        match self.is_rate_at_end(links) {
            Some(true) => {
                let words = "this holds at the end of the motion";
                return Some((Status::Holds, which(words)));
            }
            None if !self.is_of_a_motion(links) && !self.is_of_some_end(links) => return None,
            _ => {}
        }
        let words = "which moment of the motion this tells of is not known";
        Some((Status::Undecided, which(words)))
    }

    /// Whether a line speaks of an own name whose last definition could not be read.
    pub(super) fn is_unclear(&self, links: &[Link]) -> bool {
        let used = names_in(links);
        !used.is_disjoint(&self.unclear)
    }

    /// Whether a line holds at the end of a motion, with a mark that may be of that as well as of an impact.
    fn is_of_some_end(&self, links: &[Link]) -> bool {
        let all = gaps(links);
        let used = all.iter().flat_map(Expr::symbols).collect::<BTreeSet<_>>();
        let marked = |name: &Symbol| name.ends_with("^+") && self.of_bodies.contains_key(name);
        let mut ends = self.ends.iter().filter(|_| used.iter().any(marked));
        ends.any(|(_, values)| self.vanish(&all, values))
    }

    /// Whether a line is about given quantities alone, one of which is sought where something is largest, and its place is not one
    /// value.
    fn is_of_a_place(&self, links: &[Link]) -> bool {
        let used = names_in(links);
        let is_open = |name: &Symbol| {
            let mut questions = self.sheet.scene.questions.iter();
            let known = self.sought.iter().any(|s| s.parameter == *name);
            !known
                && questions
                    .any(|q| matches!(&q.ask, Ask::Extremum { over, .. } if over.contains(name)))
        };
        let given = |name: &Symbol| self.is_given(name);
        used.iter().all(given) && used.iter().any(is_open)
    }

    /// Whether a line holds with a rate such as θ̇ as it is at the end of a motion, a velocity or spin then; nothing where it
    /// speaks of no rate, or of a plain multiple of what that is.
    fn is_rate_at_end(&self, links: &[Link]) -> Option<bool> {
        let story = self.sheet.story.as_ref();
        let ([link], true) = (links, story.is_some_and(Story::has_motions)) else {
            return None;
        };
        let gap = link.gap()?;
        let is_rate = |name: &Symbol| name.ends_with("_dot");
        let mut needed = self.own_needed(gap).into_iter();
        let (_, [_, needed]) = needed.find(|(name, _)| is_rate(name))?;
        let all: Vec<&Expr> = match self.end_here() {
            Some((_, values)) => values.values().collect(),
            None => self.ends.iter().flat_map(|(_, v)| v.values()).collect(),
        };
        let same = |value: &Expr| self.is_zero(&(value - &needed));
        if all.iter().any(|value| same(value) || same(&-*value)) {
            return Some(true);
        }
        let square = needed.powi(2);
        let multiple = |value: &&Expr| self.share(&value.powi(2), &square).is_some();
        let mut all = all.into_iter().filter(|value| !value.is_zero());
        (!all.any(|value| multiple(&value))).then_some(false)
    }

    /// Notes what a line supposes of what is given, and says so.
    pub(super) fn supposes(&mut self, links: &[Link]) -> Option<Diagnosis> {
        let values = self.supposed(links)?;
        self.believed.push((self.number, values));
        let words = "this supposes something that the problem does not say";
        let hint = "what follows holds in this case alone: give the answer without it";
        Some(Diagnosis::new("SUPPOSED", words, hint))
    }

    /// What a line supposes of a given quantity in terms of others, as `M = 2 m` does: all that is found as it is then.
    fn supposed(&self, links: &[Link]) -> Option<Values> {
        let [link] = links else { return None };
        let [name, value] = link.sides.each_ref().map(Content::expr);
        let (name, value) = (name?.as_symbol()?, value?);
        let is_given = |e: &Expr| e.symbols().iter().all(|other| self.is_given(other));
        // The place of a largest or least value is a result, and no supposition.
        let is_place = |s: &Sought| s.condition.is_none() && s.parameter == *name;
        let is_sought = self.sought.iter().any(is_place);
        if is_sought || !self.is_given(name) || !is_given(value) || value.mentions(name) {
            return None;
        }
        let changed = self.closed.iter().filter(|(_, found)| found.mentions(name));
        let mut values: Values = changed
            .map(|(found, closed)| (found.clone(), closed.put(name, value)))
            .collect();
        values.insert(name.clone(), value.clone());
        Some(values)
    }

    /// Whether an equation in a sentence only supposes something of a given quantity that nobody asks about: `The exception is
    /// $θ = 0$`, `With $e = 1$, …`.
    pub(super) fn is_supposed(&self, text: &str, equation: &str) -> bool {
        let Some((before, _)) = text.split_once(equation) else {
            return false;
        };
        let words = before.trim_end().strip_suffix('$').map(str::trim_end);
        let last = words.and_then(|words| words.rsplit(' ').next());
        let supposes =
            last.is_some_and(|last| SUPPOSED.iter().any(|w| w.eq_ignore_ascii_case(last)));
        supposes
            && named(equation)
                .is_some_and(|(name, _)| self.is_given(&name) && self.asked_of(&name).is_empty())
    }
}
