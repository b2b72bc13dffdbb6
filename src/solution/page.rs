//! Adds to a solution: sections, what stands in them, and steps.
//!
//! In: pieces of text and claims, in order. Out: the [`Solution`] with them at its end.

use super::words::say;
use super::{Claim, Inline, Line, Math, Meaning, Part, Section, Solution, Step};
use crate::expr::{Expr, Symbol};

impl Part {
    /// Whether it displays an equation.
    fn shows(&self, math: &[Math]) -> bool {
        matches!(self, Part::Display(lines) if lines.iter().any(|l| l.math == math))
    }
}

impl Section {
    /// Whether an equation stands in a display of it.
    pub(super) fn shows(&self, math: &[Math]) -> bool {
        self.parts.iter().any(|part| part.shows(math))
    }
}

impl Solution {
    /// Opens a section; what comes next stands in it.
    pub(super) fn section(&mut self, depth: usize, heading: Vec<Inline>) {
        self.sections.push(Section {
            depth,
            heading,
            parts: Vec::new(),
        });
    }

    /// Adds to the section that is open; results that follow on results share their box.
    pub(super) fn push(&mut self, part: Part) {
        let Some(section) = self.sections.last_mut() else {
            return;
        };
        match (section.parts.last_mut(), part) {
            (Some(Part::Result(lines)), Part::Result(more)) => lines.extend(more),
            (_, part) => section.parts.push(part),
        }
    }

    /// Whether an equation stands in a display already.
    pub(super) fn shows(&self, math: &[Math]) -> bool {
        self.sections.iter().any(|section| section.shows(math))
    }

    /// What stands in the stages before the one under way; nothing where there are none.
    pub(super) fn earlier(&self) -> impl Iterator<Item = &Part> {
        let stage = self.sections.iter().rposition(|s| s.depth == 0);
        let before = &self.sections[..stage.unwrap_or(0)];
        before.iter().flat_map(|s| &s.parts)
    }

    /// Whether an equation stands in an earlier stage.
    pub(super) fn stood(&self, math: &[Math]) -> bool {
        self.earlier().any(|part| part.shows(math))
    }

    /// Whether these sentences stand there already.
    pub(super) fn says(&self, text: &[Inline]) -> bool {
        let mut parts = self.sections.iter().flat_map(|s| &s.parts);
        parts.any(|part| matches!(part, Part::Text(told) if told == text))
    }

    pub(super) fn text(&mut self, text: Vec<Inline>) {
        self.push(Part::Text(text));
    }

    /// A sentence; behind a condition that ends with a comma it goes on there.
    pub(super) fn conclude(&mut self, mut text: Vec<Inline>) {
        let before = self.sections.last_mut().and_then(|s| s.parts.last_mut());
        let Some(Part::Text(condition)) = before else {
            return self.text(text);
        };
        match (condition.last_mut(), text.first_mut()) {
            (Some(Inline::Text(end)), Some(Inline::Text(first))) if end.ends_with(',') => {
                end.push(' ');
                let mut letters = first.chars();
                let small = letters.next().into_iter().flat_map(char::to_lowercase);
                *first = small.chain(letters.clone()).collect();
                condition.extend(text);
            }
            _ => self.text(text),
        }
    }

    pub(super) fn say(&mut self, text: &str) {
        self.text(vec![say(text)]);
    }

    /// Equations, one a line; nothing where there are none.
    pub(super) fn display(&mut self, lines: Vec<Line>) {
        if !lines.is_empty() {
            self.push(Part::Display(lines));
        }
    }

    /// Takes away the line of the open section that gives a symbol its value, where the box that comes next tells it again;
    /// a law that a sentence leads to stays.
    pub(super) fn untell(&mut self, symbol: &Expr) {
        let Some(section) = self.sections.last_mut() else {
            return;
        };
        let gives = |line: &Line| {
            let math = line.math.strip_prefix(&[Math::Op("⇒")]);
            let math = math.unwrap_or(&line.math);
            matches!(math, [Math::Expr(left), Math::Op("="), Math::Expr(_)] if left == symbol)
        };
        for p in (0..section.parts.len()).rev() {
            let (before, from) = section.parts.split_at_mut(p);
            let Part::Display(lines) = &mut from[0] else {
                continue;
            };
            let Some(i) = lines.iter().position(gives) else {
                continue;
            };
            if lines.len() > 1 {
                let removed = lines.remove(i);
                let leads = removed.math[0] == Math::Op("⇒");
                if let Some(next) = lines.get_mut(i).filter(|_| leads) {
                    next.math.insert(0, Math::Op("⇒"));
                }
                return;
            }
            let led_to = matches!(before.last(), Some(Part::Text(text))
                if matches!(text.last(), Some(Inline::Text(words)) if words.ends_with(':')));
            // What a sentence leads to may stand in the box just as well, where that comes next.
            if !led_to || p + 1 == section.parts.len() {
                section.parts.remove(p);
            }
            return;
        }
    }

    /// Records a step and gives its id.
    pub(super) fn step(&mut self, before: Vec<Claim>, after: Vec<Claim>, reason: &str) -> String {
        let id = (self.steps.len() + 1).to_string();
        self.record(id.clone(), before, after, reason);
        id
    }

    /// Records the step that gives a name to a value, with what it is made of where that is told, and gives its id. What the
    /// name means is said before.
    pub(super) fn naming(
        &mut self,
        name: &Symbol,
        made_of: Option<&Expr>,
        value: &Expr,
        words: &str,
    ) -> String {
        let own = Expr::symbol(name);
        let sides = [Some(&own), made_of].into_iter().flatten();
        let claims = sides.map(|side| Claim::new(side.clone(), value.clone()));
        let id = self.step(Vec::new(), claims.collect(), words);
        let is_new = self.meanings.get(name) == Some(&Meaning::Defined);
        if let Some(step) = self.steps.last_mut() {
            step.defines = is_new.then(|| name.clone());
        }
        id
    }

    /// Records a step under an id that is told in advance.
    pub(super) fn record(
        &mut self,
        id: String,
        before: Vec<Claim>,
        after: Vec<Claim>,
        reason: &str,
    ) {
        self.steps.push(Step {
            id,
            before,
            after,
            reason: reason.to_string(),
            scope: None,
            assumptions: Vec::new(),
            needs: Vec::new(),
            substeps: Vec::new(),
            defines: None,
            near: Vec::new(),
        });
    }
}
