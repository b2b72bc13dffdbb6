//! Adds to a solution: sections, what stands in them, and steps.
//!
//! In: pieces of text and claims, in order. Out: the [`Solution`] with them at its end.

use super::words::say;
use super::{Claim, Inline, Part, Section, Solution, Step};

impl Solution {
    /// Opens a section; what comes next stands in it.
    pub(super) fn section(&mut self, depth: usize, heading: Vec<Inline>) {
        self.sections.push(Section {
            depth,
            heading,
            parts: Vec::new(),
        });
    }

    /// Adds to the section that is open.
    pub(super) fn push(&mut self, part: Part) {
        if let Some(section) = self.sections.last_mut() {
            section.parts.push(part);
        }
    }

    pub(super) fn text(&mut self, text: Vec<Inline>) {
        self.push(Part::Text(text));
    }

    pub(super) fn say(&mut self, text: &str) {
        self.text(vec![say(text)]);
    }

    /// Records a step and gives its id.
    pub(super) fn step(&mut self, before: Vec<Claim>, after: Vec<Claim>, reason: &str) -> String {
        let id = (self.steps.len() + 1).to_string();
        self.record(id.clone(), before, after, reason);
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
            substeps: Vec::new(),
            defines: None,
            near: Vec::new(),
        });
    }
}
