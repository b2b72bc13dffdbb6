//! Values of a parameter that are found from answers about a stage hold only where the scene gets to that stage.
//!
//! In: an answer about formulas, and the stages that its formulas come from. Out: the same answer without values at which a
//! motion before never ends, and with what else must hold.

use std::collections::BTreeSet;

use super::super::worlds::World;
use super::super::{StageTold, line};
use crate::algebra::Sign;
use crate::answer::calc::{Seen, at_least_zero, is_zero, sign};
use crate::answer::{Answer, Form};
use crate::domain::Domain;
use crate::expr::{Expr, Symbol};
use crate::formula::{Relation, Sentence, sentence};
use crate::scene::{Question, Scene};

/// A step upwards from a value.
const STEP: &str = "\u{1}step";

/// Holds the values of an answer against what the motions need that lead to it.
pub(super) fn held(
    scene: &Scene,
    stages: &[StageTold],
    worlds: &[World],
    questions: &[Question],
    earlier: &[Answer],
    answer: &mut Answer,
) {
    let found = std::mem::take(&mut answer.range);
    let had_values = !found.is_empty();
    let chain = chain(questions, answer);
    let leading = leading(stages, worlds, &chain, earlier, answer);
    // What is put in for a parameter may keep to the need by itself.
    let replaced = |need: &Expr| {
        let mut with = chain.iter().flat_map(|q| q.ask.with());
        with.any(|(name, _)| need.symbols().contains(name))
    };
    let needs = || {
        let each = leading.iter().map(|i| &stages[*i]);
        let all = each.flat_map(|told| told.needs.iter().map(move |need| (told, need)));
        all.filter(|(_, need)| !replaced(need))
    };
    for (of, relation, value) in found {
        let symbol = of
            .symbols()
            .into_iter()
            .next()
            .filter(|s| Expr::symbol(s) == of);
        let Some(symbol) = symbol else {
            answer.range.push((of, relation, value));
            continue;
        };
        let mut never = None;
        let mut besides: Vec<Sentence> = Vec::new();
        for (told, need) in needs().filter(|(_, need)| need.symbols().contains(&symbol)) {
            let there = need.put(&symbol, &value);
            if is_zero(&there, &scene.domains) == Some(true) {
                continue;
            }
            let seen = sign(&there, &scene.domains);
            let words = |e: &Expr| {
                let need = at_least_zero(e, &scene.domains);
                sentence!("{}, so that `{}` comes to its end", need, &told.name)
            };
            match seen {
                Seen::Proved(Sign::Negative) if relation == Relation::Equal => {
                    never = Some(sentence!(
                        "{} = {}, with which `{}` never comes to its end: that needs {}",
                        &symbol,
                        &value,
                        &told.name,
                        at_least_zero(need, &scene.domains)
                    ));
                }
                Seen::Proved(s) if relation == Relation::Equal && s.is_not_negative() => {}
                _ if relation == Relation::Equal => besides.push(words(&there)),
                // What every value grants is no condition.
                _ if matches!(sign(need, &scene.domains), Seen::Proved(s) if s.is_not_negative()) =>
                    {}
                // From that value on, everything above it does too.
                _ if is_upward(relation) && holds_above(need, &symbol, &value, scene) => {}
                _ => besides.push(words(need)),
            }
        }
        match never {
            Some(why) => answer.discarded.push(why),
            None => {
                answer.range.push((of, relation, value));
                answer.assumptions.extend(besides);
            }
        }
    }
    answer.assumptions.sort();
    answer.assumptions.dedup();
    if let Form::Value { closed, .. } = &answer.form
        && had_values
        && answer.range.is_empty()
    {
        let closed = &closed.clone();
        answer.form = Form::Words;
        answer.put_in.clear();
        answer.checks.clear();
        answer.text = vec![sentence!(
            "no value does: {} solves the equation, but the scene does not get there with it",
            closed
        )];
    }
}

fn is_upward(relation: Relation) -> bool {
    matches!(relation, Relation::Greater | Relation::GreaterEqual)
}

/// Whether something is proved not to be negative for every value of a parameter from this one on.
fn holds_above(need: &Expr, symbol: &Symbol, from: &Expr, scene: &Scene) -> bool {
    let step = Symbol::from(STEP);
    let mut domains = scene.domains.clone();
    domains.symbols.insert(step.clone(), Domain::positive());
    let above = from + &Expr::symbol(&step);
    let there = need.put(symbol, &above);
    matches!(sign(&there, &domains), Seen::Proved(s) if s.is_not_negative())
}

/// The question of an answer, and all whose answers its formulas use.
fn chain<'a>(questions: &'a [Question], answer: &Answer) -> Vec<&'a Question> {
    let of = |name: &str| questions.iter().find(|q| q.name == name);
    let mut out: Vec<&Question> = Vec::new();
    let mut ahead: Vec<&Question> = of(&answer.question).into_iter().collect();
    while let Some(question) = ahead.pop() {
        if out.iter().any(|q| q.name == question.name) {
            continue;
        }
        out.push(question);
        let names = question.ask.formulas().into_iter().flat_map(Expr::symbols);
        ahead.extend(names.filter_map(|name| {
            let whole = name.strip_suffix("_x").or(name.strip_suffix("_y"));
            of(&name).or_else(|| of(whole?))
        }));
    }
    out
}

/// The stages that answers to these questions come from, and all before them.
fn leading(
    stages: &[StageTold],
    worlds: &[World],
    chain: &[&Question],
    earlier: &[Answer],
    answer: &Answer,
) -> BTreeSet<usize> {
    let mut out = BTreeSet::new();
    for a in earlier {
        let Some(question) = chain.iter().find(|q| q.name == a.question) else {
            continue;
        };
        let Some((stage, case)) = a.told else {
            continue;
        };
        let happens = |w: &usize| worlds[*w].outcome.get(&stage) == Some(&case);
        if !answer.worlds.is_empty() && !answer.worlds.iter().any(happens) {
            continue;
        }
        if question.ask.is_at_end() {
            out.insert(stage);
        }
        out.extend(
            line(stages, (stage, case))
                .skip(1)
                .map(|(parent, _)| parent),
        );
    }
    out
}
