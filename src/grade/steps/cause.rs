//! From which wrong line a later one follows: what each wrong line implies is kept, and tried.

use std::collections::BTreeMap;

use super::super::relation::{follows, solve_for};
use super::link::Link;
use super::{Desk, MOST_CAUSES, MOST_STATED};
use crate::equality::{self, Equality};
use crate::expr::{Expr, Symbol};
use crate::formula::{Content, Reading};

impl Desk<'_> {
    /// The wrong line from which equations follow: they hold in the motion it implies, or say the same.
    pub(super) fn cause(&self, text: &str, link: &Link) -> Option<usize> {
        let differences = &link.differences;
        // A name that was defined with a slip, had it been defined without.
        let slipped = self.slipped.iter().rev().map(|(cause, name, value)| {
            let meant = BTreeMap::from([(name.clone(), value.clone())]);
            let meant: Vec<Expr> = differences.iter().map(|d| d.substitute(&meant)).collect();
            (cause, meant)
        });
        let none = BTreeMap::new();
        for (cause, meant) in slipped.filter(|(_, meant)| meant != differences) {
            if self.all_zero(&meant, &none) == Some(true) {
                return Some(*cause);
            }
        }
        // The latest first.
        let mut implied = self.believed.iter().rev();
        let found = implied.find(|(_, values)| {
            self.all_zero(differences, values) == Some(true) || self.is_rounded(text, link, values)
        });
        let found = found.map(|(cause, _)| *cause);
        found.or_else(|| {
            let [one] = differences.as_slice() else {
                return None;
            };
            let one = self.with_own(one);
            let domains = &self.sheet.scene.domains;
            let moves = |e: &Expr| e.symbols().iter().any(|n| self.is_found(n));
            let said = self.wrong.iter().rev().take(8);
            // What is said of given quantities alone follows from nothing but itself.
            if !moves(&one) {
                let mut said = said.filter(|(_, f)| *f == one || *f == -&one);
                return said.next().map(|(cause, _)| *cause);
            }
            said.filter(|(_, f)| moves(f) && follows(f, &one, domains))
                .map(|(cause, _)| *cause)
                .next()
                .or_else(|| self.eliminated(&one))
        })
    }

    /// Notes equations for later lines.
    pub(super) fn state(&mut self, cause: Option<usize>, differences: &[Expr]) {
        let all = differences.iter().map(|d| (cause, self.with_own(d)));
        let all: Vec<_> = all.collect();
        self.stated.extend(all);
        let excess = self.stated.len().saturating_sub(MOST_STATED);
        self.stated.drain(..excess);
    }

    /// The wrong line that makes an equation follow from those above it: they are solved for one name after another, first
    /// the wrong line and what hangs on it, and put in.
    fn eliminated(&self, one: &Expr) -> Option<usize> {
        let domains = &self.sheet.scene.domains;
        // What a question asks of a parameter is that parameter where the lines above hold.
        let used = one.symbols();
        let mut sought = self.sought.iter();
        let one = &match sought.find(|s| used.contains(s.question.as_str())) {
            Some(s) => one.replace(
                &Expr::symbol(s.question.as_str()),
                &Expr::symbol(&s.parameter),
            ),
            None => one.clone(),
        };
        let is_zero = |e: &Expr| {
            let decided = equality::decide(e, &Expr::zero(), domains).equality;
            matches!(decided, Equality::Same { .. })
        };
        let mut causes: Vec<usize> = self.stated.iter().filter_map(|(c, _)| *c).collect();
        causes.sort_unstable();
        causes.dedup();
        causes.into_iter().rev().take(MOST_CAUSES).find(|&cause| {
            let of = |wanted: Option<usize>| self.stated.iter().filter(move |(c, _)| *c == wanted);
            let mut rules: Vec<BTreeMap<Symbol, Expr>> = Vec::new();
            let reduced = |e: &Expr, rules: &[BTreeMap<Symbol, Expr>]| {
                rules.iter().fold(e.clone(), |e, rule| e.substitute(rule))
            };
            for (_, line) in of(Some(cause)).chain(of(None)) {
                let line = reduced(line, &rules);
                // What says nothing new, or contradicts those before, gives no rule.
                let symbols = line.symbols();
                let mut names = symbols.iter().filter(|n| self.is_found(n));
                let rule = names.find_map(|name| {
                    let root = solve_for(&line, name, domains)?;
                    Some(BTreeMap::from([(name.clone(), root)]))
                });
                rules.extend(rule);
            }
            is_zero(&reduced(one, &rules))
        })
    }

    /// A line `name = …` that holds says what the name is under every belief about the others.
    pub(super) fn carry(&mut self, reading: &Reading) {
        let Content::Relations(sides, _) = &reading.content else {
            return;
        };
        let [left, .., right] = sides.as_slice() else {
            return;
        };
        let (Some(name), Some(value)) = (left.expr().and_then(Expr::as_symbol), right.expr())
        else {
            return;
        };
        let value = self.with_own(value);
        let used = value.symbols();
        for (_, values) in &mut self.believed {
            if values.keys().any(|n| used.contains(n)) && !values.contains_key(name) {
                let implied = value.substitute(values);
                values.insert(name.clone(), implied);
            }
        }
    }

    /// In a motion with one freedom all velocities are what they are, times the same wrong number.
    pub(super) fn carry_along(
        &self,
        name: &Symbol,
        root: &Expr,
        values: &mut BTreeMap<Symbol, Expr>,
    ) {
        let Some(truth) = self.closed.get(name).filter(|t| !t.is_zero()) else {
            return;
        };
        if !self.moving.contains(name) {
            return;
        }
        for other in self.moving.iter().filter(|other| *other != name) {
            if let Some(value) = self.closed.get(other) {
                let scaled = value * &(root * &truth.powi(-1));
                values.entry(other.clone()).or_insert(scaled);
            }
        }
    }
}
