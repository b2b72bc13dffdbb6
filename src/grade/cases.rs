//! Formulas in cases, `\begin{cases} a & x ≥ 0 \\ b & x < 0 \end{cases}`: each is judged where it is said to hold, and together
//! they have to say something everywhere.
//!
//! In: the text of an answer or an expected formula. Out: a grade, or keys that live on parts of the domain.

use super::{Diagnosis, Grade, Key, Options, Question, Verdict, judge_here, key, unreadable};
use crate::algebra::{Sign, sign};
use crate::domain::{Domain, Domains, Relation, roles, samples};
use crate::expr::Expr;
use crate::formula::{self, Content, Fault, Join, Symbols};

/// One case: its value behind the name of the whole, and its condition; nothing for all that is left.
type Case = (String, Option<String>);

/// The cases of a text; nothing where it is in none.
fn parted(text: &str) -> Option<Vec<Case>> {
    const WORDS: [&str; 5] = ["if ", "for ", "when ", "where ", "in case "];
    let frames = [
        ["\\begin{cases}", "\\end{cases}"],
        ["\\begin{dcases}", "\\end{dcases}"],
    ];
    let (name, inside, behind) = frames.iter().find_map(|[open, close]| {
        let (name, rest) = text.split_once(open)?;
        let (inside, behind) = rest.split_once(close)?;
        Some((name, inside, behind))
    })?;
    if !behind.trim_matches([' ', '.', '$']).is_empty() {
        return None;
    }
    let rows = inside.split("\\\\").filter(|row| !row.trim().is_empty());
    let case = |row: &str| {
        let (value, condition) = row.split_once('&')?;
        let plain = ["\\text{", "\\mathrm{", "\\textrm{"].iter().fold(
            condition.replace("\\quad", " "),
            |said, font| match said.split_once(font) {
                Some((before, rest)) => format!("{before}{}", rest.replacen('}', " ", 1)),
                None => said,
            },
        );
        let said = plain.trim_matches([' ', ',', '.', ';', '$']);
        let said = WORDS
            .iter()
            .find_map(|word| said.strip_prefix(word))
            .unwrap_or(said)
            .trim();
        if said.starts_with('=') || said.is_empty() {
            return None;
        }
        let left = ["otherwise", "else", "elsewhere"].contains(&said);
        let value = format!("{name}{}", value.trim().trim_end_matches([',', ';']));
        Some((value, (!left).then(|| said.to_string())))
    };
    let cases: Option<Vec<Case>> = rows.map(case).collect();
    cases.filter(|cases| cases.len() > 1)
}

/// What is positive, or not negative where the flag is set, under a condition.
fn links(condition: &Content) -> Option<Vec<(Expr, bool)>> {
    let (sides, signs) = match condition {
        Content::Joined(Join::And, parts) => {
            let each: Option<Vec<_>> = parts.iter().map(links).collect();
            return Some(each?.concat());
        }
        other => other.relations()?,
    };
    let link = |(pair, sign): (&[Content], &formula::Relation)| {
        let (left, right) = (pair[0].expr()?, pair[1].expr()?);
        let excess = if sign.is_below() {
            right - left
        } else {
            left - right
        };
        let closed = sign.sign() == "≤" || sign.sign() == "≥";
        sign.is_order().then_some((excess, closed))
    };
    sides.windows(2).zip(signs).map(link).collect()
}

/// The parts of a domain in which each case holds, boundaries left out, and what none of them speaks of.
fn parts(
    cases: &[Case],
    question: &Question,
    symbols: &Symbols,
) -> Result<(Vec<Vec<Domains>>, Vec<Domains>), Fault> {
    let mut domains = question.domains.clone();
    let mut all: Vec<Option<Vec<(Expr, bool)>>> = Vec::new();
    for (_, condition) in cases {
        let Some(condition) = condition else {
            all.push(None);
            continue;
        };
        let fault = || *Fault::new("the condition of this case is not read", 0, 0);
        let read = formula::read(condition, symbols).map_err(|_| fault())?;
        // What is compared may have either sign.
        for name in read.symbols() {
            let declared = question.given().any(|given| given.name == name);
            let place = domains.symbols.entry(name);
            if !declared {
                place.or_insert_with(Domain::real);
            }
        }
        all.push(Some(links(&read.content).ok_or_else(fault)?));
    }
    let mut left = vec![domains.clone()];
    let mut out = Vec::new();
    for links in all {
        let Some(links) = links else {
            out.push(std::mem::take(&mut left));
            continue;
        };
        let here = links
            .iter()
            .fold(domains.clone(), |d, (e, closed)| d.given(e, *closed));
        let without = |d: &Domains| -> Vec<Domains> {
            links
                .iter()
                .map(|(e, closed)| d.given(&-e, !closed))
                .collect()
        };
        left = left.iter().flat_map(without).collect();
        out.push(vec![here]);
    }
    let lives = |d: &Domains| !is_thin(d, &domains);
    out.iter_mut().for_each(|part| part.retain(lives));
    left.retain(lives);
    Ok((out, left))
}

/// Whether two relations of a domain, or one, leave no more of it than a boundary.
fn is_thin(domain: &Domains, whole: &Domains) -> bool {
    let seen = |e: &Expr| sign(e, whole);
    let never = |e: &Expr| matches!(seen(e), Some(Sign::Negative | Sign::Zero));
    // 0 ≥ 0 says nothing: it leaves all of the domain.
    let says = |r: &&Relation| !(r.closed && seen(&r.excess) == Some(Sign::Zero));
    let all: Vec<&Expr> = domain
        .relations
        .iter()
        .filter(says)
        .map(|r| &r.excess)
        .collect();
    let against =
        |(i, e): (usize, &&Expr)| never(e) || all[..i].iter().any(|other| never(&(*e + *other)));
    all.iter().enumerate().any(against)
}

/// Whether a point is found at which all relations of a domain hold.
fn has_points(domain: &Domains) -> bool {
    const TRIED: usize = 8;
    let all: Vec<&Expr> = domain.relations.iter().map(|r| &r.excess).collect();
    let roles = roles(&all);
    let (completed, _) = domain.completed(&roles);
    !samples(&roles, &completed, TRIED).is_empty()
}

/// The grade of an answer in cases to a question of a scene, of which the scene may go by one alone.
pub(super) fn of_scene(key: &Key, answer: &str, options: &Options) -> Option<Grade> {
    let mut grade = judge(key, answer, options)?;
    if grade.verdict == Verdict::Different {
        let words = "the cases are not all right on the whole domain, and which of them the scene is in is not judged";
        grade = Grade::new(Verdict::Undecided, "UNDECIDED_AMBIGUOUS", "none", words);
    }
    Some(grade)
}

/// The grade of an answer in cases; nothing where it is in none.
pub(super) fn judge(key: &Key, answer: &str, options: &Options) -> Option<Grade> {
    let cases = parted(answer)?;
    let (parts, left) = match parts(&cases, &key.question, &key.readable) {
        Ok(found) => found,
        Err(fault) => return Some(unreadable(fault)),
    };
    let mut found = Vec::new();
    for ((value, condition), domains) in cases.iter().zip(parts) {
        for domains in domains {
            let question = Question {
                domains,
                ..key.question.clone()
            };
            let here = Key {
                question,
                ..key.clone()
            };
            let mut grade = judge_here(&here, value, options);
            if grade.verdict == Verdict::Different {
                let when = condition.as_deref().unwrap_or("all that is left");
                let words = format!("this is so in the case {when}");
                grade
                    .diagnosis
                    .push(Diagnosis::new("CASE", words.clone(), words));
            }
            found.push(grade);
        }
    }
    if !left.is_empty() {
        let words = "the cases do not say what holds in all of the domain";
        found.push(match left.iter().any(has_points) {
            true => Grade::told("DIFF_CASES", "kind", words, "which case is missing?"),
            false => {
                let words = "whether the cases leave something out could not be told";
                Grade::new(Verdict::Undecided, "UNDECIDED_POINT", "none", words)
            }
        });
    }
    Some(together(found))
}

/// The grade of all cases: that of the first that is not right.
pub(super) fn together(found: Vec<Grade>) -> Grade {
    let weight = |grade: &Grade| match grade.verdict {
        Verdict::Invalid => 0,
        Verdict::Different => 1,
        Verdict::Undecided => 2,
        Verdict::Equivalent => 3,
    };
    let worst = found.iter().min_by_key(|grade| weight(grade)).cloned();
    let words = "none of the cases occurs on the domain";
    let mut grade =
        worst.unwrap_or_else(|| Grade::new(Verdict::Undecided, "UNDECIDED_POINT", "none", words));
    grade.content = None;
    if grade.is_equivalent() {
        found
            .into_iter()
            .for_each(|other| grade.assume(other.assumed));
    }
    grade
}

/// The keys of an expected formula in cases, each on its part of the domain; nothing where it is in none.
pub(super) fn keys(
    expected: &str,
    question: &Question,
    symbols: &Symbols,
) -> Option<Result<Vec<Key>, Fault>> {
    let cases = parted(expected)?;
    let (parts, _) = match parts(&cases, question, symbols) {
        Ok(found) => found,
        Err(fault) => return Some(Err(fault)),
    };
    let each = cases.iter().zip(parts);
    let each =
        each.flat_map(|((value, _), parts)| parts.into_iter().map(move |domains| (value, domains)));
    let keys = each.map(|(value, domains)| {
        key(
            value,
            &Question {
                domains,
                ..question.clone()
            },
        )
    });
    Some(keys.collect())
}
