//! What a formula comes to near a value of a parameter: its highest order in one box, what is left out in one sentence, lower
//! orders in a line.

use super::given::given_that;
use super::heading::{goes_on, heading};
use super::known::{defined, is_fresh, worth_telling};
use super::sentence::{called, sentence};
use super::words::{self, say};
use super::{Inline, Line, Math, Part, Solution};
use crate::answer::Answer;
use crate::expr::Expr;
use crate::formula::{Piece, Sentence};
use crate::scene::{Ask, Question, Scene};

/// How a sentence about the term behind a form begins.
const NEXT: &str = "the next term is ";

/// Adds a section for a question about a form near a value, and for those after it that ask for other orders of it; gives the
/// names of all of them. Nothing where one of them has no such form.
pub(super) fn near<'s>(
    solution: &mut Solution,
    scene: &'s Scene,
    first: &Question,
    answers: &[Answer],
) -> Vec<&'s str> {
    let from = scene.questions.iter().skip_while(|q| q.name != first.name);
    let mut all: Vec<(Option<u32>, &Question, Vec<&Answer>)> = Vec::new();
    for question in from.take_while(|q| q.name == first.name || goes_on(&first.ask, &q.ask)) {
        let Ask::Approximate { order, .. } = &question.ask else {
            return Vec::new();
        };
        let mine = answers.iter().filter(|a| a.question == question.name);
        let mine: Vec<&Answer> = mine.collect();
        let is_form = |a: &&Answer| {
            a.formula().is_some() && a.stated.is_none() && a.text.len() == 1 && !a.near.is_empty()
        };
        if mine.is_empty() || !mine.iter().all(is_form) {
            return Vec::new();
        }
        all.push((*order, question, mine));
    }
    let names = all.iter().map(|(_, q, _)| q.name.as_str()).collect();
    all.sort_by_key(|(order, ..)| *order);
    let Some((_, question, highest)) = all.pop() else {
        return names;
    };
    solution.section(0, heading(scene, &question.ask, highest[0]));
    given_that(solution, scene, &question.ask, highest[0]);
    let box_of = forms(solution, &question.ask, &highest);
    let told: Vec<Vec<Math>> = box_of.iter().map(|l| l.math.clone()).collect();
    solution.push(Part::Result(box_of));
    left_out(solution, scene, &told, &highest);
    for (order, question, mine) in all {
        let lines = forms(solution, &question.ask, &mine).into_iter();
        let other: Vec<Inline> = lines
            .filter(|l| !told.contains(&l.math))
            .map(|l| Inline::Math(l.math))
            .collect();
        if !other.is_empty() {
            let mut text = vec![say(match order {
                Some(order) => format!("To {}, ", words::order(order)),
                None => String::from("Its leading term: "),
            })];
            text.extend(words::row(other, " and "));
            text.push(say("."));
            solution.text(text);
        }
    }
    if let Some(words) = worth_telling(&highest[0].checks, solution.detail) {
        solution.text(vec![say(called(scene, &words))]);
    }
    names
}

/// The forms, each with the step that names it.
fn forms(solution: &mut Solution, ask: &Ask, answers: &[&Answer]) -> Vec<Line> {
    let mut lines = Vec::new();
    for answer in answers {
        let Some(formula) = answer.formula() else {
            continue;
        };
        let fresh = is_fresh(solution, answer);
        let step = defined(solution, answer, formula, fresh);
        let named = || (Expr::symbol(&answer.name), "≈");
        let (left, op) = stands_for(ask, answer).unwrap_or_else(named);
        let math = vec![Math::Expr(left), Math::Op(op), Math::Expr(formula.clone())];
        let step = Some(step);
        lines.push(Line { math, step });
    }
    lines
}

/// What the forms leave out: the next terms together where each has one, else of each what is known.
fn left_out(solution: &mut Solution, scene: &Scene, told: &[Vec<Math>], answers: &[&Answer]) {
    let next = |a: &&Answer| match a.text[0].0.as_slice() {
        [Piece::Words(words), rest @ ..] if words == NEXT => Some(Sentence(rest.to_vec())),
        _ => None,
    };
    let terms: Option<Vec<Sentence>> = answers.iter().map(next).collect();
    let mut text = Vec::new();
    match terms {
        Some(terms) => {
            text.push(say(match terms.len() {
                1 => "The next term is ",
                _ => "The next terms are ",
            }));
            let terms = terms.iter().flat_map(|t| sentence(scene, t));
            text.extend(words::row(terms, " and "));
        }
        None => {
            for (i, (answer, math)) in answers.iter().zip(told).enumerate() {
                text.push(say(if i == 0 { "Of " } else { "; of " }));
                text.push(Inline::Math(math[..1].to_vec()));
                text.push(say(" "));
                text.extend(sentence(scene, &answer.text[0]));
            }
        }
    }
    text.push(say("."));
    solution.text(text);
}

/// What an answer stands for near a value of a parameter, and how: the formula asked about, or its component.
pub(super) fn stands_for(ask: &Ask, answer: &Answer) -> Option<(Expr, &'static str)> {
    let (of, op) = match ask {
        Ask::Approximate { of, .. } => (of, "≈"),
        Ask::Limit { of, .. } => (of, "→"),
        _ => return None,
    };
    let axis = answer.name.strip_prefix(answer.question.as_str())?;
    Some(match of.as_symbol() {
        Some(vector) if !axis.is_empty() => (Expr::symbol(&format!("{vector}{axis}")), op),
        _ => (of.clone(), op),
    })
}
