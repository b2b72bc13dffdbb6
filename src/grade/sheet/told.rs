//! Answers that are no single value: several solutions, and what a parameter lies between.
//!
//! In: an answer in words with what it found. Out: the same as it is graded, relations of the parameter.

use crate::answer::Answer;
use crate::expr::Expr;
use crate::formula::{Content, Join, Piece, Relation, Sentence};

/// What an answer says of a parameter; `None` where that is not said in relations.
pub(super) fn relations(answer: &Answer) -> Option<Content> {
    let mut found = answer.range.iter();
    let are_solutions = answer.range.len() > 1 && found.all(|r| r.1 == Relation::Equal);
    let name = answer.range.first().map(|(of, ..)| of);
    if let Some(name) = name.filter(|_| are_solutions) {
        // What is said without a name, `2 or 3`, is one of the values as well.
        let values = answer.range.iter().map(|(_, _, value)| value.clone());
        let sides = vec![
            Content::Scalar(name.clone()),
            Content::Either(values.collect()),
        ];
        return Some(Content::Relations(sides, vec![Relation::Equal]));
    }
    let parts: Vec<Content> = answer.text.iter().find_map(intervals)?;
    match <[Content; 1]>::try_from(parts) {
        Ok([only]) => Some(only),
        Err(parts) => Some(Content::Joined(Join::Or, parts)),
    }
}

fn related(sides: &[&Expr], signs: &[Relation]) -> Content {
    let sides = sides.iter().map(|e| Content::Scalar((*e).clone()));
    Content::Relations(sides.collect(), signs.to_vec())
}

/// The intervals of a sentence such as "it holds for a ≤ x ≤ b, and for x ≥ c".
fn intervals(said: &Sentence) -> Option<Vec<Content>> {
    let mut parts: Vec<(Vec<&Expr>, Vec<Relation>)> = Vec::new();
    let mut between = String::new();
    for piece in &said.0 {
        let e = match piece {
            Piece::Words(words) => {
                between += words;
                continue;
            }
            Piece::Formula(e) => e,
        };
        match (parts.last_mut(), between.trim()) {
            (None, "it holds for") | (Some(_), ", and for") => parts.push((vec![e], Vec::new())),
            (Some((sides, signs)), sign) => {
                sides.push(e);
                signs.push(match sign {
                    "<" => Relation::Less,
                    "≤" => Relation::LessEqual,
                    ">" => Relation::Greater,
                    "≥" => Relation::GreaterEqual,
                    "=" => Relation::Equal,
                    _ => return None,
                });
            }
            _ => return None,
        }
        between.clear();
    }
    let is_whole = between.is_empty() && !parts.is_empty();
    let each = parts.iter().map(|(sides, signs)| {
        let is_told = is_whole && !signs.is_empty();
        is_told.then(|| related(sides, signs))
    });
    each.collect()
}
