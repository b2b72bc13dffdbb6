//! A formula with its number behind it, `v = √(2gh) = 14 m/s`: where a formula is asked that is what is judged, and the number
//! only where the question gives values.

use super::compare;
use super::{Diagnosis, Grade, Key, Proof, Verdict, read};
use crate::dimension;
use crate::expr::{Expr, Symbol};
use crate::formula::{Content, Reading, Relation, Shape, Written};

/// An answer cut before the numbers at its end.
pub(super) struct Worked<'a> {
    /// What stands before them.
    pub formula: &'a str,
    /// The last of them.
    pub number: &'a str,
    /// How that was read.
    pub reading: Reading,
    /// What is told where the numbers are not equal to each other.
    apart: Option<Grade>,
}

/// Cuts an answer that ends in a number with its unit, in degrees, or behind ≈, where a formula in symbols is asked; nothing
/// where it is no such answer.
pub(super) fn worked<'a>(key: &Key, answer: &'a str, reading: &Reading) -> Option<Worked<'a>> {
    const SIGNS: [&str; 3] = ["=", "≈", "\\approx"];
    let constant = |content: &Content| match content {
        Content::Quantity(q) => q.value.is_constant(),
        other => other.expr().is_some_and(Expr::is_constant),
    };
    let asked = key.reading.content.answer();
    if !matches!(asked, Content::Scalar(e) if !e.is_constant()) {
        return None;
    }
    let (sides, signs) = reading.content.relations()?;
    let steps = |sign: &Relation| matches!(sign, Relation::Equal | Relation::Approximately);
    // `2 kg · 9.8 m/s² · 5 m` begins with a number, and has letters that the question does not know.
    let strange = |name: &Symbol| !key.question.given().any(|g| g.name == *name);
    let numbers = |(side, written): &(&Content, &Written)| {
        let digit = answer
            .get(written.start..)
            .is_some_and(|t| t.starts_with(|c: char| c.is_ascii_digit()));
        constant(side) || digit && side.symbols().iter().any(strange)
    };
    let last = sides.iter().zip(&reading.written).rev();
    let symbolic = match sides.last().is_some_and(constant) {
        true => sides.len() - last.take_while(numbers).count(),
        false => sides.len(),
    };
    let named = symbolic == 1 && sides[0].expr().is_some_and(|e| e.as_symbol().is_some());
    if symbolic == 0 || symbolic == sides.len() || named || !signs.iter().all(steps) {
        return None;
    }
    let degrees = |shape: &Shape| matches!(shape, Shape::Degrees(_));
    let measured = matches!(sides.last(), Some(Content::Quantity(_)))
        || signs.last() == Some(&Relation::Approximately)
        || reading.written.last().is_some_and(|w| degrees(&w.shape));
    let mut places: Vec<(usize, usize)> = SIGNS
        .iter()
        .flat_map(|sign| {
            answer
                .match_indices(sign)
                .map(|(at, sign)| (at, at + sign.len()))
        })
        .collect();
    places.sort_unstable();
    if !measured || places.len() != signs.len() {
        return None;
    }
    let (formula, number) = (
        &answer[..places[symbolic - 1].0],
        &answer[places.last()?.1..],
    );
    let apart = compare::numbers_apart(key, &reading.content);
    let reading = read::answer(key, number).ok()?;
    read::answer(key, formula).ok()?;
    Some(Worked {
        formula,
        number,
        reading,
        apart,
    })
}

impl Worked<'_> {
    /// Makes the grade of a right formula that of a chain whose numbers are not equal, where they are not.
    pub(super) fn is_broken(&self, grade: &mut Grade) -> bool {
        if let Some(found) = self
            .apart
            .as_ref()
            .filter(|_| grade.verdict == Verdict::Equivalent)
        {
            grade.verdict = found.verdict;
            grade.note = found.note;
            grade.proof = found.proof.clone();
            grade.diagnosis.extend(found.diagnosis.iter().cloned());
        }
        grade.verdict != Verdict::Equivalent
    }

    /// Tells in the grade of a right formula that its number is not judged, or that it cannot measure what is asked.
    pub(super) fn unjudged(&self, key: &Key, grade: &mut Grade) {
        let known = |name: &str| key.question.dimension_of(name);
        let asked = key.question.dimension.clone();
        let asked = asked.or_else(|| dimension::of(key.reading.expr()?, &known).ok()?);
        let number = self.number.trim().trim_end_matches(['.', '$', ' ']);
        match (&self.reading.content, asked) {
            (Content::Quantity(q), Some(asked)) if q.unit.dimension != asked => {
                let words = format!(
                    "the formula is right; {} measures {}, and {asked} is asked for",
                    q.unit_text, q.unit.dimension
                );
                grade.verdict = Verdict::Different;
                grade.note = "DIFF_UNIT";
                grade.proof = Proof::of("dimension", words.clone());
                let hint = "the unit of your number does not fit your formula";
                grade
                    .diagnosis
                    .insert(0, Diagnosis::new("UNIT_WRONG", words, hint));
            }
            _ => grade
                .assumed
                .push(format!("{number} is not judged: no values are given")),
        }
    }
}
