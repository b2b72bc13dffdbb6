//! Right values by the name of something else that the scene knows.

use super::super::{Grade, compare, read};
use super::{Entry, Sheet};
use crate::expr::Symbol;
use crate::formula::Content;
use crate::scene::{Ask, ImpulseAt, without_case};

/// A name without what people leave out or write otherwise: `v_{By}`, `v_B_y` and `vBy` are one.
fn bare(name: &str) -> String {
    let plain = name.trim_end_matches("_vec");
    plain.chars().filter(|c| !"_{},".contains(*c)).collect()
}

impl Sheet {
    /// The grade of a right answer, unless it says to be that of another question or impulse: `E_lost = …` for `omega`.
    pub(super) fn by_its_name(&self, entry: &Entry, answer: &str, grade: Grade) -> Grade {
        let value = &entry.key.reading.content;
        let is_value = matches!(value, Content::Scalar(_) | Content::Vector(_));
        if !grade.is_equivalent() || !is_value {
            return grade;
        }
        let content = read::answer(&entry.key, answer).ok().map(|r| r.content);
        let sides = content.as_ref().and_then(|content| content.relations());
        let Some((sides, _)) = sides else {
            return grade;
        };
        let given = |name: &Symbol| self.scene.parameter(name).is_some();
        let ends = [sides.first(), sides.last()].into_iter().flatten();
        let names = ends.filter_map(|side| side.name());
        let mut others = names.filter(|name| !given(name) && self.is_of_another(entry, name));
        let Some(theirs) = others.next() else {
            return grade;
        };
        let found = compare::other_name(grade.clone(), &entry.name.as_str().into(), theirs);
        Grade {
            content: grade.content,
            assumed: grade.assumed,
            ..found
        }
    }

    /// Whether a name is that of another question, with another value, or of an impulse that is not asked for.
    fn is_of_another(&self, entry: &Entry, name: &Symbol) -> bool {
        let name = bare(name);
        let own = entry.key.question.asked.iter().map(|given| &*given.name);
        let mut own = own.chain([entry.question.name.as_str(), without_case(&entry.name)]);
        if own.any(|own| bare(own) == name) {
            return false;
        }
        let same = |other: &Entry| other.key.reading.content == entry.key.reading.content;
        let quantities = self.quantities();
        let mut called = quantities.iter().filter(|other| bare(other) == name);
        if let Some(other) = called.next() {
            return self.entry(other).is_ok_and(|other| !same(&other));
        }
        let asked = match &entry.question.ask {
            Ask::Impulse { from, .. } => Some(from),
            Ask::Velocity { .. } | Ask::Spin { .. } | Ask::Energy { .. } => None,
            _ => return false,
        };
        let contacts = self.scene.contacts.iter().enumerate();
        let contacts = contacts.map(|(i, c)| (c.name.as_str(), ImpulseAt::Contact(i)));
        let hinges = self.scene.hinges.iter().enumerate();
        let hinges = hinges.map(|(i, h)| (h.name.as_str(), ImpulseAt::Hinge(i)));
        let is_it = |at: &str| {
            ["", "x", "y"]
                .iter()
                .any(|axis| bare(&format!("P{at}{axis}")) == name)
        };
        let at = |from: &ImpulseAt| format!("{from:?}");
        contacts
            .chain(hinges)
            .any(|(c, from)| is_it(c) && asked.is_none_or(|own| at(own) != at(&from)))
    }
}
