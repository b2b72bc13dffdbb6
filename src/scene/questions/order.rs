//! Questions in an order in which each formula stands behind the answers that it names, and otherwise as in the file: the
//! entries of an object in JSON have no order of their own.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

use super::is_own;
use crate::scene::file::SceneFile;
use crate::scene::question_file::QuestionFile;
use crate::scene::record::Map;

/// Puts the questions in order; those that need each other in a circle come last and are refused when they are read.
pub(in crate::scene) fn order(file: &mut SceneFile) {
    let Some(Map(questions, _)) = &mut file.questions else {
        return;
    };
    let named = questions.iter().enumerate().filter(|(_, (name, q))| {
        // Its name stands for the parameter.
        !q.as_ref().is_some_and(|q| is_own(name, q))
    });
    let places: HashMap<&str, usize> = named.map(|(i, (name, _))| (&*name.text, i)).collect();
    let mut waiting = vec![0; questions.len()];
    let mut needed_by = vec![Vec::new(); questions.len()];
    for (i, (_, q)) in questions.iter().enumerate() {
        for text in q.iter().flat_map(formulas) {
            for word in text.split(|c: char| !c.is_alphanumeric() && c != '_') {
                let whole = word.strip_suffix("_x").or(word.strip_suffix("_y"));
                let place = places.get(word).or_else(|| places.get(whole?));
                if let Some(j) = place.filter(|j| **j != i) {
                    needed_by[*j].push(i);
                    waiting[i] += 1;
                }
            }
        }
    }
    let mut ready: BinaryHeap<Reverse<usize>> = BinaryHeap::new();
    ready.extend(
        (0..questions.len())
            .filter(|i| waiting[*i] == 0)
            .map(Reverse),
    );
    let mut rank = vec![questions.len(); questions.len()];
    for next in 0.. {
        let Some(Reverse(i)) = ready.pop() else { break };
        rank[i] = next;
        for &k in &needed_by[i] {
            waiting[k] -= 1;
            ready.extend((waiting[k] == 0).then_some(Reverse(k)));
        }
    }
    let mut ranked: Vec<_> = rank.into_iter().zip(std::mem::take(questions)).collect();
    ranked.sort_by_key(|(rank, _)| *rank);
    *questions = ranked.into_iter().map(|(_, question)| question).collect();
}

/// The formulas of a question that may name answers.
fn formulas(q: &QuestionFile) -> impl Iterator<Item = &str> {
    let with = q.with.iter().flat_map(|m| &m.0);
    let with = with.filter_map(|(_, formula)| formula.as_ref());
    let alone = [&q.value, &q.limit, &q.to, &q.approximate];
    let alone = alone.into_iter().chain([&q.maximum, &q.minimum]);
    let formulas = alone.flatten().chain(with).map(|f| &*f.text);
    let relations = [&q.holds, &q.show].into_iter().flatten();
    formulas.chain(relations.map(|t| &*t.text))
}
