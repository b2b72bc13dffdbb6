//! Sentences about a scene as pieces of a solution: formulas set, bodies called by their names.

use super::words::{self, say};
use super::{Inline, Math};
use crate::expr::Expr;
use crate::formula::{Piece, Sentence};
use crate::scene::{Scene, Stage, StageKind};
use crate::story;

/// A sentence with its formulas set, what stands around a relation in one piece with it, and bodies called as in the rest of
/// a solution.
pub fn sentence(scene: &Scene, text: &Sentence) -> Vec<Inline> {
    let mut out: Vec<Inline> = Vec::new();
    let mut relation = None;
    let mut pieces: Vec<Piece> = Vec::new();
    for piece in &text.0 {
        match (piece, pieces.last_mut()) {
            (Piece::Words(more), Some(Piece::Words(words))) => words.push_str(more),
            _ => pieces.push(piece.clone()),
        }
    }
    let pieces: Vec<Piece> = pieces
        .into_iter()
        .flat_map(|piece| with_symbols(scene, piece))
        .collect();
    for piece in &pieces {
        match piece {
            Piece::Words(words) => {
                let mut words = called(scene, words);
                if let Some(Inline::Math(math)) = out.last_mut()
                    && let Some((op, number, rest)) = number_in(&words)
                {
                    math.extend([Math::Op(op), Math::Expr(Expr::from(number))]);
                    words = String::from(rest);
                    if words.is_empty() {
                        continue;
                    }
                }
                relation = relation_in(&words);
                match (relation, out.last_mut()) {
                    (Some(op), Some(Inline::Math(math))) => math.push(Math::Op(op)),
                    _ => {
                        relation = None;
                        out.push(say(words));
                    }
                }
            }
            Piece::Formula(e) => match (relation.take(), out.last_mut()) {
                (Some(_), Some(Inline::Math(math))) => math.push(Math::Expr(e.clone())),
                _ => out.push(words::formula(e)),
            },
        }
    }
    // A relation that words follow is words itself.
    if let (Some(op), Some(Inline::Math(math))) = (relation, out.last_mut()) {
        math.pop();
        out.push(say(format!(" {op} ")));
    }
    out
}

/// A piece in which the backquoted names of quantities are formulas, as in "`theta0` exists".
fn with_symbols(scene: &Scene, piece: Piece) -> Vec<Piece> {
    let Piece::Words(words) = piece else {
        return vec![piece];
    };
    let is_part = |of: &Scene, name: &str| {
        let contacts = of.contacts.iter().map(|c| &c.name);
        let joints = of.hinges.iter().map(|h| &h.name);
        let mut all = contacts
            .chain(joints)
            .chain(of.blows.iter().map(|b| &b.name));
        all.any(|part| part == name)
    };
    let is_support = |stage: &Stage, name: &str| match &stage.kind {
        StageKind::Impact { one_sided, .. } => one_sided.iter().any(|o| o.name == name),
        StageKind::Turn(turn) => turn.about_name == name,
        _ => false,
    };
    let is_quantity = |name: &str| {
        let is_named = scene.question(name).is_some() || scene.parameter(name).is_some();
        let bodies = scene.bodies.iter().map(|b| &b.name);
        let mut others = bodies.chain(scene.points.iter().map(|p| &p.name));
        let mut stages = scene.stages.iter();
        is_named
            && !others.any(|other| other == name)
            && !is_part(scene, name)
            && !stages.any(|stage| {
                stage.name == name || is_part(&stage.scene, name) || is_support(stage, name)
            })
    };
    let mut out = vec![Piece::Words(String::new())];
    for (i, part) in words.split('`').enumerate() {
        match out.last_mut() {
            Some(Piece::Words(words)) if i % 2 == 0 => words.push_str(part),
            Some(Piece::Words(words)) if !is_quantity(part) => words.push_str(&format!("`{part}`")),
            _ if i % 2 == 0 => out.push(Piece::Words(part.to_string())),
            _ => out.push(Piece::Formula(Expr::symbol(part))),
        }
    }
    out.retain(|piece| !matches!(piece, Piece::Words(words) if words.is_empty()));
    out
}

/// The symbols of the formulas in a piece of a sentence.
pub(super) fn symbols(piece: &Inline) -> impl Iterator<Item = crate::expr::Symbol> {
    let math = match piece {
        Inline::Math(math) => math.as_slice(),
        Inline::Text(_) => &[],
    };
    let formulas = math.iter().filter_map(|m| match m {
        Math::Expr(e) => Some(e.symbols()),
        _ => None,
    });
    formulas.flatten().collect::<Vec<_>>().into_iter()
}

/// Names between backquotes: bodies get their article, stages their quotation marks, and points what a sentence needs.
pub(super) fn called(scene: &Scene, words: &str) -> String {
    let mut out = String::new();
    // A stage may have the name of a body: `wall`.
    let of_stages = words.contains(story::NO_TIME);
    for (i, part) in words.split('`').enumerate() {
        if i % 2 == 0 {
            out.push_str(part);
        } else if let Some(b) = scene
            .bodies
            .iter()
            .position(|b| b.name == part && !of_stages)
        {
            out.push_str(&words::body(scene, b));
        } else if scene.stages.iter().any(|s| s.name == part) {
            out.push_str(&words::stage(part));
        } else if scene.parameters.iter().any(|p| *p.name == *part) {
            out.push_str(part);
        } else {
            out.push_str(&words::place(part, "contact"));
        }
    }
    out
}

const RELATIONS: [&str; 6] = ["=", "≤", "≥", "<", ">", "≠"];

/// The relation that these words are, if they are one and nothing else.
fn relation_in(words: &str) -> Option<&'static str> {
    RELATIONS.into_iter().find(|op| words.trim() == *op)
}

/// The relation to a whole number that words begin with, and what follows it.
fn number_in(words: &str) -> Option<(&'static str, i64, &str)> {
    let words = words.strip_prefix(' ')?;
    let mut all = RELATIONS.into_iter();
    let (op, right) = all.find_map(|op| Some((op, words.strip_prefix(op)?.strip_prefix(' ')?)))?;
    let end = right.find([' ', ';', ',', ')']).unwrap_or(right.len());
    let (number, rest) = right.split_at(end);
    Some((op, number.parse().ok()?, rest))
}

/// A sentence that begins with a capital and ends with a full stop.
pub fn full_sentence(scene: &Scene, text: &Sentence) -> Vec<Inline> {
    let mut out = sentence(scene, text);
    if let Some(Inline::Text(first)) = out.first_mut() {
        *first = words::capital(first);
    }
    match out.last_mut() {
        Some(Inline::Text(last)) if last.ends_with(['.', ':', '?', '!']) => {}
        Some(Inline::Text(last)) => last.push('.'),
        _ => out.push(say(".")),
    }
    out
}
