//! Formulas in cases, `\begin{cases} a & x ≥ 0 \\ b & x < 0 \end{cases}`: each is judged where it is said to hold, and together
//! they have to say something everywhere.
//!
//! In: the text of an answer or an expected formula. Out: a grade, or keys that live on parts of the domain.

use super::{Diagnosis, Grade, Key, Options, Question, Verdict, judge_within, key, unreadable};
use super::{compare, read, relation};
use crate::algebra::Sign;
use crate::domain::{Domain, Domains, Relation, Sample};
use crate::expr::{Expr, Symbol};
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

/// What is positive, or not negative where the flag is set, in each case; nothing for all that is left. And the symbols that
/// the conditions leave without a sign.
type Conditions = (Vec<Option<Vec<(Expr, bool)>>>, Vec<Symbol>);

/// The conditions of cases, read.
fn conditions(cases: &[Case], symbols: &Symbols) -> Result<Conditions, Fault> {
    let (mut all, mut unsigned) = (Vec::new(), Vec::new());
    for (_, condition) in cases {
        let Some(condition) = condition else {
            all.push(None);
            continue;
        };
        let fault = || *Fault::new("the condition of this case is not read", 0, 0);
        let read = formula::read(condition, symbols).map_err(|_| fault())?;
        unsigned.extend(relation::unsigned(&[&read.content]));
        all.push(Some(links(&read.content).ok_or_else(fault)?));
    }
    Ok((all, unsigned))
}

/// The parts of the domain of a question in which each case holds, and what none of them speaks of. Conditions that are the
/// same as others, or the opposite, come in the words of these.
fn parts(
    cases: &[Case],
    question: &Question,
    symbols: &Symbols,
) -> Result<(Vec<Vec<Domains>>, Vec<Domains>), Fault> {
    let mut domains = question.domains.clone();
    let (mut all, unsigned) = conditions(cases, symbols)?;
    for name in unsigned {
        if !question.given().any(|given| given.name == name) {
            domains.symbols.entry(name).or_insert_with(Domain::real);
        }
    }
    let mut known: Vec<Expr> = domains.relations.iter().map(|r| r.excess.clone()).collect();
    let excesses = all.iter().flatten().flatten().map(|(e, _)| e);
    let bearing: Vec<Expr> = excesses.cloned().chain(known.iter().cloned()).collect();
    let whole = domains.of(&bearing.iter().collect::<Vec<_>>());
    for (e, _) in all.iter_mut().flatten().flatten() {
        let bare = Domains {
            relations: Vec::new(),
            ..whole.clone()
        };
        let same = |f: &Expr| match relation::same_side(f, e, &bare)? {
            true => Some(f.clone()),
            false => Some(-f),
        };
        match known.iter().find_map(same) {
            Some(same) => *e = same,
            None => known.push(e.clone()),
        }
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
        left.retain(|d| extent(d) != Extent::Empty);
        out.push(vec![here]);
    }
    let lives = |d: &Domains| extent(d) != Extent::Empty;
    out.iter_mut().for_each(|part| part.retain(lives));
    Ok((out, left))
}

/// What the relations of a domain leave of it.
#[derive(PartialEq, Debug)]
enum Extent {
    /// Nothing, for certain.
    Empty,
    /// No more than where this is zero.
    Edge(Expr),
    /// As far as signs tell, more than a boundary.
    Open,
}

/// What the relations leave of a domain, as far as the signs of one and of sums of two tell.
fn extent(domain: &Domains) -> Extent {
    let bare = Domains {
        relations: Vec::new(),
        ..domain.clone()
    };
    let mut edge = None;
    let mut seen: Vec<&Relation> = Vec::new();
    for r in &domain.relations {
        let alone = std::iter::once((r.excess.clone(), r.closed));
        let pairs = seen.iter();
        let pairs = pairs.map(|s| (&s.excess + &r.excess, s.closed && r.closed));
        let mut is_single = true;
        for (sum, closed) in alone.chain(pairs) {
            let single = std::mem::take(&mut is_single);
            match relation::sign_of(&sum, &bare) {
                Some(Sign::Negative) => return Extent::Empty,
                // 0 ≥ 0 says nothing: it leaves all of the domain.
                Some(Sign::Zero) if single && closed => {}
                Some(Sign::NotPositive | Sign::Zero) if !closed => return Extent::Empty,
                Some(Sign::NotPositive | Sign::Zero) => edge = Some(r.excess.clone()),
                _ => {}
            }
        }
        seen.push(r);
    }
    edge.map_or(Extent::Open, Extent::Edge)
}

/// The first points at which all relations of a domain hold, with all symbols of these and of some formulas.
fn points(domain: &Domains, formulas: &[&Expr], count: usize) -> Vec<Sample> {
    let all = domain.relations.iter().map(|r| &r.excess);
    let all: Vec<&Expr> = all.chain(formulas.iter().copied()).collect();
    domain.points(&all, count)
}

/// Whether a point is found at which all relations of a domain hold.
fn has_points(domain: &Domains) -> bool {
    !points(domain, &[], 1).is_empty()
}

/// The grade of a text on the domain of a key, which may be a boundary; nothing where there is none.
fn on(key: &Key, text: &str, options: &Options) -> Option<Grade> {
    let domain = &key.question.domains;
    let edge = match extent(domain) {
        Extent::Empty => return None,
        Extent::Edge(edge) => edge,
        Extent::Open => {
            let mut grade = judge_within(key, text, options);
            if !matches!(grade.verdict, Verdict::Different | Verdict::Undecided) {
                return Some(grade);
            }
            if !has_points(domain) {
                return Some(untold("whether these conditions are met anywhere"));
            }
            name_all(key, &mut grade);
            return Some(grade);
        }
    };
    let reading = match read::answer(key, text) {
        Ok(reading) => reading,
        Err(fault) => return Some(unreadable(fault)),
    };
    for name in edge.symbols() {
        let Some(value) = at_zero(&edge, &name, domain) else {
            continue;
        };
        let there = put(domain, &name, &value);
        if extent(&there) == Extent::Empty {
            return None;
        }
        let at = |content: &Content| content.map(&|e| e.put(&name, &value));
        let mut question = key.question.clone();
        question.domains = there;
        let mut here = key.with(at(&key.reading.content));
        here.question = question;
        let found = compare::contents(&here, &reading.with(at(&reading.content)), options);
        if found.is_equivalent() {
            return Some(found);
        }
        if has_points(&here.question.domains) {
            let place = format!("{name} = {}", formula::write_plain(&value));
            return Some(told_at(found, place));
        }
    }
    let mut wide = key.clone();
    wide.question.domains.relations.clear();
    let found = compare::contents(&wide, &reading, options);
    let words = "whether the two agree where one case ends and the other begins";
    Some(match found.is_equivalent() {
        true => found,
        false => untold(words),
    })
}

/// Undecided, as something could not be told.
fn untold(what: &str) -> Grade {
    let words = format!("{what} could not be told");
    Grade::new(Verdict::Undecided, "UNDECIDED_POINT", "none", words)
}

/// A finding on a boundary, with the place.
fn told_at(mut grade: Grade, place: String) -> Grade {
    if let Some(apart) = &mut grade.counterexample {
        apart.at = match apart.at.is_empty() {
            true => place,
            false => format!("{place}, {}", apart.at),
        };
    }
    let words = "the two part where one case ends and the other begins";
    let hint = "to which case does the boundary belong?";
    grade.with(Diagnosis::new("BOUNDARY", words, hint))
}

/// The value of a symbol at which something is zero, where that is the only one on the domain.
fn at_zero(edge: &Expr, name: &Symbol, domain: &Domains) -> Option<Expr> {
    let own = domain.of_symbol(name);
    let is_acute = || own.lies_within(&Domain::first_quadrant());
    relation::solve_for(edge, name, domain)
        .or_else(|| relation::angle_in(edge, name, domain).filter(|_| is_acute()))
        .or_else(|| relation::size_in(edge, name, domain).filter(|_| !own.changes_sign()))
}

/// A domain with a value in the place of a symbol, which has to lie where the symbol does.
fn put(domain: &Domains, name: &Symbol, value: &Expr) -> Domains {
    let mut there = domain.clone();
    let own = domain.of_symbol(name);
    there.relations.clear();
    let low = own.low.map(|end| (value - &end.expr(), !end.open));
    let high = own.high.map(|end| (end.expr() - value, !end.open));
    let stated = domain.relations.iter();
    let stated = stated.map(|r| (r.excess.put(name, value), r.closed));
    let all = stated.chain(low).chain(high);
    all.fold(there, |there, (e, closed)| {
        match relation::sign_of(&e, &there) {
            Some(Sign::Positive) => there,
            Some(Sign::NotNegative | Sign::Zero) if closed => there,
            _ => there.given(&e, closed),
        }
    })
}

/// Names all symbols of the conditions at the point at which the two part.
fn name_all(key: &Key, grade: &mut Grade) {
    const TRIED: usize = 60;
    let (Some(apart), Some(content)) = (&mut grade.counterexample, &grade.content) else {
        return;
    };
    let formulas = [key.reading.content.exprs(), content.exprs()].concat();
    let is_own = |name: &Symbol| formulas.iter().any(|e| e.symbols().contains(name));
    let same = points(&key.question.domains, &formulas, TRIED).into_iter();
    let same = same.map(|point| {
        let mut own = point.clone();
        own.coordinates.retain(|name, _| is_own(name));
        (own.words(), point.words())
    });
    if let Some((_, words)) = same.into_iter().find(|(own, _)| *own == apart.at) {
        apart.at = words;
    }
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

/// The grade of an answer to a key in cases.
pub(super) fn of_key(key: &Key, answer: &str, options: &Options) -> Grade {
    let each = key.cases.iter();
    let found =
        each.filter_map(|part| judge(part, answer, options).or_else(|| on(part, answer, options)));
    let mut grade = together(found.collect());
    if key.has_hole && grade.is_equivalent() {
        grade.note = "EQUIV_WHERE_DEFINED";
        grade.assume(vec!["where one of the expected cases holds".into()]);
    }
    grade
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
            let Some(mut grade) = on(&here, value, options) else {
                continue;
            };
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
    let (open, edges): (Vec<_>, Vec<_>) = left.iter().partition(|d| extent(d) == Extent::Open);
    if !open.is_empty() {
        let words = "the cases do not say what holds in all of the domain";
        found.push(match open.iter().any(|d| has_points(d)) {
            true => Grade::told("DIFF_CASES", "kind", words, "which case is missing?"),
            false => untold("whether the cases leave something out"),
        });
    }
    let mut grade = together(found);
    if !edges.is_empty() && grade.is_equivalent() {
        grade.note = "EQUIV_WHERE_DEFINED";
        grade.assume(vec!["not where one case ends and the next begins".into()]);
    }
    Some(grade)
}

/// The grade of all cases: that of the first that is not right.
pub(super) fn together(found: Vec<Grade>) -> Grade {
    let weight = |grade: &Grade| match grade.verdict {
        Verdict::Invalid => 0,
        Verdict::Different => 1,
        Verdict::Undecided => 2,
        Verdict::Equivalent if grade.note != "EQUIV_IDENTITY" => 3,
        Verdict::Equivalent => 4,
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

/// The keys of an expected formula in cases, each on its part of the domain, and whether they leave more than edges of it out;
/// nothing where it is in none.
pub(super) fn keys(
    expected: &str,
    question: &Question,
    symbols: &Symbols,
) -> Option<Result<(Vec<Key>, bool), Fault>> {
    let cases = parted(expected)?;
    let (parts, left) = match parts(&cases, question, symbols) {
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
    let is_hole = |d: &Domains| extent(d) == Extent::Open && has_points(d);
    let all: Result<Vec<Key>, Fault> = keys.collect();
    Some(all.map(|keys| (keys, left.iter().any(is_hole))))
}
