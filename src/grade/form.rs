//! Demands on the way an answer is written: simplified, factored, in given symbols, to so many digits, with a unit.

use super::compare::Finding;
use super::{Diagnosis, Key, Verdict};
use crate::algebra::{Element, Field, tidy};
use crate::expr::{Expr, Node, Symbol};
use crate::formula::{Content, Link, Reading, Shape, Written};

/// A demand on the form of an answer.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Form {
    /// No like terms or factors left to gather, no fraction to reduce, at most half again as long as the shortest form known.
    Simplified,
    /// A product of factors at the top, none of them a sum with a common factor.
    Factored,
    /// Nothing but these symbols.
    Only(Vec<Symbol>),
    /// A number to so many significant digits.
    Digits(u32),
    /// A number with its unit.
    WithUnit,
}

impl Form {
    /// Reads `simplified`, `factored`, `unit`, `digits=3`, `only=m,v`.
    pub fn read(text: &str) -> Option<Form> {
        let (word, value) = text
            .split_once(['=', ':'])
            .map_or((text, None), |(w, v)| (w, Some(v)));
        match (word.trim(), value) {
            ("simplified", None) => Some(Form::Simplified),
            ("factored", None) => Some(Form::Factored),
            ("unit" | "with unit", None) => Some(Form::WithUnit),
            ("digits", Some(n)) => n
                .trim()
                .parse()
                .ok()
                .filter(|n| (1..=40).contains(n))
                .map(Form::Digits),
            ("only", Some(names)) => Some(Form::Only(
                names.split(',').map(|n| Symbol::from(n.trim())).collect(),
            )),
            _ => None,
        }
    }
}

/// Turns a right answer that does not have the form demanded into a different one.
pub(super) fn demand(forms: &[Form], key: &Key, answer: &Reading, finding: &mut Finding) {
    if finding.is_equivalent()
        && let Some((note, diagnosis)) = unmet(forms, key, answer)
    {
        finding.verdict = Verdict::Different;
        finding.note = note;
        finding.diagnosis.insert(0, diagnosis);
    }
}

/// The first demand that is not met.
fn unmet(forms: &[Form], key: &Key, answer: &Reading) -> Option<(&'static str, Diagnosis)> {
    forms.iter().find_map(|form| {
        let (note, code, words) = check(form, key, answer)?;
        Some((
            note,
            Diagnosis::new(code, format!("right, but {words}"), words),
        ))
    })
}

fn check(form: &Form, key: &Key, answer: &Reading) -> Option<(&'static str, &'static str, String)> {
    match form {
        Form::Simplified => {
            let mut long = false;
            let mut shortest = usize::MAX;
            key.reading
                .content
                .each(&mut |e| shortest = shortest.min(e.size()));
            answer.content.answer().each(&mut |e| {
                let read = Field::of(&key.question.domains, e).ok();
                let tidy = read
                    .filter(|(_, x)| x.terms() <= super::compare::WRITTEN)
                    .map_or(usize::MAX, |(field, x)| field.expr(&x).size())
                    .min(shortest);
                long |= tidy != usize::MAX && 2 * e.size() > 3 * tidy + 4 || repeats(e);
            });
            long |= answer.written.last().is_some_and(reducible);
            long.then(|| {
                (
                    "DIFF_FORM_SIMPLIFIED",
                    "FORM_SIMPLIFIED",
                    "it can be simplified".to_string(),
                )
            })
        }
        Form::Factored => {
            let mut open = false;
            answer
                .content
                .answer()
                .each(&mut |e| open |= !factored(e, key));
            open.then(|| {
                (
                    "DIFF_FORM_FACTORED",
                    "FORM_FACTORED",
                    "it is to be written as a product of factors".to_string(),
                )
            })
        }
        Form::Only(names) => {
            let mut others = Vec::new();
            answer.content.answer().each(&mut |e| {
                others.extend(e.symbols().into_iter().filter(|s| !names.contains(s)))
            });
            let first = others.first()?;
            Some((
                "DIFF_FORM_SYMBOLS",
                "FORM_SYMBOLS",
                format!("it is to be written without {first}"),
            ))
        }
        Form::Digits(n) => match &answer.literal {
            Some(literal) if literal.digits == *n => None,
            Some(literal) => Some((
                "DIFF_FORM_DIGITS",
                "FORM_DIGITS",
                format!(
                    "{n} significant digits are asked for, and it has {}",
                    literal.digits
                ),
            )),
            None => Some((
                "DIFF_FORM_DIGITS",
                "FORM_DIGITS",
                format!("a decimal number with {n} significant digits is asked for"),
            )),
        },
        Form::WithUnit => match answer.content.answer() {
            Content::Quantity(_) => None,
            _ => Some((
                "DIFF_FORM_UNIT",
                "FORM_UNIT",
                "a unit is to be given".to_string(),
            )),
        },
    }
}

/// Whether equal terms or factors stand side by side.
fn repeats(e: &Expr) -> bool {
    let twice = |parts: &[Expr]| {
        parts
            .iter()
            .enumerate()
            .any(|(i, p)| parts[..i].contains(p))
    };
    e.parts().any(|part| match part.node() {
        Node::Sum(parts) | Node::Product(parts) => twice(parts),
        _ => false,
    })
}

/// Whether whole factors above and below a fraction line can be reduced, or a whole number under a root has a square in it.
fn reducible(w: &Written) -> bool {
    let mut sides = [1, 1];
    whole_factors(w, false, &mut sides);
    let [above, below] = sides;
    let rooted = match &w.shape {
        Shape::Root(None, inside) => {
            let n = whole(inside).unwrap_or(1).min(MOST_UNDER_ROOT);
            (2..).take_while(|d| d * d <= n).any(|d| n % (d * d) == 0)
        }
        _ => false,
    };
    rooted || num_integer::gcd(above, below) > 1 || w.pieces().into_iter().any(reducible)
}

/// Greatest number in which squares are looked for.
const MOST_UNDER_ROOT: i64 = 1_000_000_000;

/// The value of a whole number.
fn whole(w: &Written) -> Option<i64> {
    match &w.shape {
        Shape::Bracket(inside) => whole(inside),
        _ => {
            let literal = w.literal().filter(|l| l.value.is_integer() && !l.decimal)?;
            literal.value.numer().as_i64().filter(|n| *n > 0)
        }
    }
}

/// Multiplies what stands above the fraction line, and below it, by the whole numbers among the factors.
fn whole_factors(w: &Written, below: bool, sides: &mut [i64; 2]) {
    match &w.shape {
        Shape::Product(factors) => {
            for (i, (link, factor)) in factors.iter().enumerate() {
                whole_factors(factor, below != (i > 0 && *link == Link::Over), sides);
            }
        }
        Shape::Fraction(a, b) => {
            whole_factors(a, below, sides);
            whole_factors(b, !below, sides);
        }
        Shape::Bracket(inside) => whole_factors(inside, below, sides),
        _ => {
            let side = &mut sides[usize::from(below)];
            *side = whole(w).and_then(|n| side.checked_mul(n)).unwrap_or(*side);
        }
    }
}

/// Whether no sum at the top or in a factor has more than one factor in its normal form, or as a polynomial.
fn factored(e: &Expr, key: &Key) -> bool {
    let domains = &key.question.domains;
    let irreducible = |sum: &Expr| {
        let polynomial = |part: &Expr| match part.node() {
            Node::Power(_, k) => k.as_number().is_some_and(|k| k.is_integer()),
            Node::Call(..) => false,
            _ => true,
        };
        let parts = sum
            .parts()
            .all(polynomial)
            .then(|| Field::of(domains, sum).ok());
        let one = |(field, x): (Field, Element)| field.zeros(&x).len() < 2;
        let tidy = tidy(sum, domains);
        parts.flatten().is_none_or(one)
            && (tidy.is_err() || tidy.is_ok_and(|e| matches!(e.node(), Node::Sum(_))))
    };
    match e.node() {
        Node::Sum(_) => irreducible(e),
        Node::Product(factors) => factors.iter().all(|f| factored(f, key)),
        Node::Power(base, k) if k.as_number().is_some_and(|k| k.is_integer()) => {
            factored(base, key)
        }
        _ => true,
    }
}
