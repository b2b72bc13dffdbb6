//! Findings about one printed thing in several cases of friction, put together.

use super::{Finding, explains};

/// Findings in each of several cases, all about the same printed things. What holds in one of the cases holds there: a book
/// prints one of them, and what it is read with is told beside it.
pub fn in_cases(cases: Vec<(String, Vec<Finding>)>) -> Vec<Finding> {
    let mut columns: Vec<Vec<(&str, Finding)>> = Vec::new();
    for (words, findings) in &cases {
        columns.resize_with(findings.len(), Vec::new);
        for (column, finding) in columns.iter_mut().zip(findings) {
            column.push((words, finding.clone()));
        }
    }
    columns.into_iter().filter_map(together).collect()
}

/// One finding of those in each case that the values do not exclude.
fn together(all: Vec<(&str, Finding)>) -> Option<Finding> {
    let (all, excluded): (Vec<_>, Vec<_>) =
        all.into_iter().partition(|(_, f)| f.elsewhere.is_none());
    if all.is_empty() {
        return excluded.into_iter().next().map(|(_, found)| found);
    }
    let mut found = of_cases(all)?;
    let mut right: Vec<&str> = excluded
        .iter()
        .filter(|(_, f)| f.elsewhere == Some(Some(true)))
        .map(|(words, _)| *words)
        .collect();
    right.dedup();
    if found.holds == Some(false) && !right.is_empty() {
        let words = right.join(", or ");
        found.explained = Some(format!(
            "it holds where {words}, which is not so at these values"
        ));
    }
    Some(found)
}

fn of_cases(all: Vec<(&str, Finding)>) -> Option<Finding> {
    let holds = |wanted: Option<bool>| all.iter().filter(move |(_, f)| f.holds == wanted);
    if let Some((_, found)) = holds(Some(true)).next() {
        let mut where_: Vec<&str> = holds(Some(true)).map(|(words, _)| *words).collect();
        let is_everywhere = where_.len() == all.len();
        where_.dedup();
        let mut told: Vec<String> = Vec::new();
        if !is_everywhere {
            told.push(where_.join(", or "));
        }
        // What it rests on in each of them.
        let shared = |words: &&String| holds(Some(true)).all(|(_, f)| f.given.contains(words));
        told.extend(found.given.iter().filter(shared).cloned());
        return Some(Finding {
            only_where: in_words(&told),
            ..found.clone()
        });
    }
    if let Some((_, open)) = holds(None).next() {
        return Some(open.clone());
    }
    let is_explained = |f: &Finding| f.explained.as_deref().is_some_and(explains);
    let told = all.iter().find(|(_, f)| is_explained(f)).or(all.first())?;
    let mut values: Vec<String> = Vec::new();
    for (words, f) in &all {
        let value = match all.len() {
            1 => f.carom.clone(),
            _ => format!("{} where {words}", f.carom),
        };
        if !values.contains(&value) {
            values.push(value);
        }
    }
    Some(Finding {
        carom: values.join("; "),
        ..told.1.clone()
    })
}

/// Conditions one after the other; nothing where there are none.
pub(super) fn in_words(all: &[String]) -> Option<String> {
    (!all.is_empty()).then(|| all.join("; "))
}
