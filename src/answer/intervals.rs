//! An inequality whose sides meet at several values of a parameter, or at one without changing places: the intervals in
//! which it holds.
//!
//! In: the difference of the sides and where it is zero. Out: sentences with the intervals, and how the signs between the
//! zeros are known. Where the zeros cannot be put in order, that is said.

use std::cmp::Ordering;

use super::Answer;
use super::calc::{Seen, by_signs, essential, sign};
use super::solve::{Root, end_of};
use crate::algebra::Sign;
use crate::domain::{Domain, Domains, Limit};
use crate::expr::{Expr, Symbol};
use crate::formula::Relation;
use crate::formula::{Sentence, sentence};

/// Tells the intervals.
pub(super) fn fill(
    out: &mut Answer,
    parameter: &Symbol,
    gap: &Expr,
    relation: Relation,
    roots: &[Root],
    domains: &Domains,
) {
    let meet = |values: &[Expr], why: &str| {
        let values = Sentence::join(values.iter().map(Sentence::from), " and at ");
        sentence!("the sides meet at {} = {}{}", parameter, values, why)
    };
    let Some(zeros) = ordered(roots, domains) else {
        let values: Vec<Expr> = roots.iter().map(|r| r.value.clone()).collect();
        let why = ", and which of these is larger depends on the values";
        out.text.push(meet(&values, why));
        return;
    };
    let signs = between(parameter, gap, &zeros, domains);
    let negative = relation.is_below();
    let strict = matches!(relation, Relation::Less | Relation::Greater);
    // All zeros are known: what is not negative between two of them is positive.
    let holds = |s: &Seen| match (s.is_negative(), s.is_positive()) {
        (true, _) => Some(negative),
        (_, true) => Some(!negative),
        _ => s.side().map(|above| above != negative),
    };
    let all: Option<Vec<bool>> = (0..signs.len())
        .map(|i| {
            let beside = if i == 0 { 1 } else { i - 1 };
            match signs[i] {
                // The zero is the end of the domain, and beyond it there is nothing.
                Seen::Proved(Sign::Zero) => Some(!strict && holds(signs.get(beside)?)?),
                _ => holds(&signs[i]),
            }
        })
        .collect();
    let Some(holds) = all else {
        let why = "; which of them is larger in between could not be told";
        out.text.push(meet(&zeros, why));
        return;
    };
    let pieces = pieces(parameter, &zeros, &holds, strict);
    out.text.push(if pieces.is_empty() {
        "it never holds within the domain".into()
    } else {
        sentence!("it holds for {}", Sentence::join(pieces, ", and for "))
    });
    let proved = signs.iter().all(|s| s.is_proved());
    let words = "between these values, below and above them the sign of the difference is {how}, and there is no other value at which the sides meet";
    out.checks.push(by_signs("sign", words, proved));
}

/// The zeros, ascending; `None` where the order is not the same on the whole domain.
fn ordered(roots: &[Root], domains: &Domains) -> Option<Vec<Expr>> {
    let mut zeros: Vec<Expr> = roots.iter().map(|r| r.value.clone()).collect();
    let mut sure = true;
    zeros.sort_by(|a, b| {
        let difference = sign(&(a - b), domains);
        // Where two of them are the same, nothing lies between.
        if a == b {
            Ordering::Equal
        } else if difference.is_negative() || difference.side() == Some(false) {
            Ordering::Less
        } else if difference.is_positive() || difference.side() == Some(true) {
            Ordering::Greater
        } else {
            sure = false;
            Ordering::Equal
        }
    });
    sure.then_some(zeros)
}

/// Signs of the difference: below the first zero, between every two, above the last.
fn between(parameter: &Symbol, gap: &Expr, zeros: &[Expr], domains: &Domains) -> Vec<Seen> {
    let domain = domains.of_symbol(parameter);
    let (Some(first), Some(last)) = (zeros.first(), zeros.last()) else {
        return vec![sign(gap, domains)];
    };
    let mut out = vec![beside(
        gap,
        parameter,
        first,
        domain.low.as_ref(),
        -1,
        domains,
    )];
    for pair in zeros.windows(2) {
        let middle = &Expr::ratio(1, 2) * &(&pair[0] + &pair[1]);
        let e = gap.put(parameter, &middle);
        out.push(sign(&essential(&e, domains), domains));
    }
    out.push(beside(
        gap,
        parameter,
        last,
        domain.high.as_ref(),
        1,
        domains,
    ));
    out
}

/// Intervals and single values in which the relation holds, in words.
fn pieces(parameter: &Symbol, zeros: &[Expr], holds: &[bool], strict: bool) -> Vec<Sentence> {
    let sign = if strict { "<" } else { "≤" };
    let words = |low: Option<&Expr>, high: Option<&Expr>| match (low, high) {
        (None, None) => sentence!("every {} within its domain", parameter),
        (None, Some(b)) => sentence!("{} {} {}", parameter, sign, b),
        (Some(a), Some(b)) => sentence!("{} {} {} {} {}", a, sign, parameter, sign, b),
        (Some(a), None) => sentence!("{} {} {}", parameter, if strict { ">" } else { "≥" }, a),
    };
    let mut out = Vec::new();
    let mut open: Option<Option<&Expr>> = None;
    for (i, here) in holds.iter().enumerate() {
        let low = i.checked_sub(1).and_then(|k| zeros.get(k));
        let before = i > 0 && holds[i - 1];
        // A zero between two parts that hold belongs to them unless equality is excluded.
        if *here && (!before || strict) {
            if let Some(from) = open.take() {
                out.push(words(from, low));
            }
            open = Some(low);
        } else if !*here && let Some(from) = open.take() {
            out.push(words(from, low));
        } else if let (false, false, false, Some(zero)) = (*here, before, strict, low) {
            out.push(sentence!("{} = {}", parameter, zero));
        }
    }
    if let Some(from) = open {
        out.push(words(from, None));
    }
    out
}

/// A step away from a value, of any size.
const STEP: &str = "\u{1}step";

/// The sign of the difference at a place between its zero and the end of the domain on one side; zero where there is none.
pub(super) fn beside(
    gap: &Expr,
    parameter: &Symbol,
    value: &Expr,
    end: Option<&Limit>,
    way: i64,
    domains: &Domains,
) -> Seen {
    let mut domains = domains.clone();
    domains.symbols.insert(STEP.into(), Domain::positive());
    // Any distance does: there is no other zero on this side.
    let at_any = value + &(Expr::from(way) * Expr::symbol(STEP));
    let end = end.map(Limit::expr);
    // A relation counts where it leaves less than the domain.
    let stated = stated(parameter, way, &domains).filter(|stated| {
        let less =
            |end: &Expr| sign(&(Expr::from(way) * (end - stated)), &domains).side() == Some(true);
        end.as_ref().is_none_or(less)
    });
    let place = match stated.or(end) {
        Some(number) => {
            // Where the value lies at the end or beyond, there is nothing on this side of it.
            let inside = essential(&(Expr::from(way) * (&number - value)), &domains);
            if inside.is_zero() {
                return Seen::Proved(Sign::Zero);
            }
            if sign(&inside, &domains) == Seen::Mixed {
                domains = domains.given(&inside, false);
            }
            &(&Expr::ratio(1, 2) * &(value + &number))
        }
        None if way > 0 && sign(value, &domains).is_positive() => &(Expr::from(2) * value.clone()),
        None => &at_any,
    };
    let seen_at = |place: &Expr| {
        let e = gap.put(parameter, place);
        sign(&essential(&e, &domains), &domains)
    };
    match seen_at(place) {
        seen if seen.is_proved() || *place == at_any => seen,
        // What holds at every distance holds up to the end.
        seen => Some(seen_at(&at_any))
            .filter(|s| s.is_proved())
            .unwrap_or(seen),
    }
}

/// The one end that relations put to a parameter on one side.
fn stated(parameter: &Symbol, way: i64, domains: &Domains) -> Option<Expr> {
    let ends = domains.relations.iter().filter_map(|relation| {
        let (end, is_upper) = end_of(parameter, relation, domains)?;
        (is_upper == (way > 0)).then_some(end)
    });
    let ends: Vec<Expr> = ends.collect();
    match ends.as_slice() {
        [only] => Some(only.clone()),
        _ => None,
    }
}
