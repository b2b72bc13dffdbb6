//! Demands on the way an answer is written: simplified, factored, in given symbols, to so many digits, with a unit.

use num_traits::{Signed, Zero};

use super::{Diagnosis, Grade, Key, Verdict};
use crate::algebra::{Element, Field, tidy};
use crate::expr::{Expr, Node, Symbol, ratio};
use crate::formula::{Content, Link, Literal, Reading, Shape, Sign, Written};

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
pub(super) fn demand(forms: &[Form], key: &Key, answer: &Reading, finding: &mut Grade) {
    if finding.is_equivalent()
        && let Some((note, words)) = forms.iter().find_map(|form| unmet(form, key, answer))
    {
        finding.verdict = Verdict::Different;
        finding.note = note;
        let code = note.trim_start_matches("DIFF_");
        let found = Diagnosis::new(code, format!("right, but {words}"), words);
        finding.diagnosis.insert(0, found);
    }
}

/// The note and the words for a demand that is not met.
fn unmet(form: &Form, key: &Key, answer: &Reading) -> Option<(&'static str, String)> {
    let content = answer.content.answer();
    let all = content.exprs();
    Some(match form {
        Form::Simplified if is_long(key, answer) => {
            ("DIFF_FORM_SIMPLIFIED", "it can be simplified".into())
        }
        Form::Factored
            if !all.iter().all(|e| factored(e, key))
                || answer.written.last().is_some_and(cancels) =>
        {
            let words = "it is to be written as a product of factors";
            ("DIFF_FORM_FACTORED", words.into())
        }
        Form::Only(names) => {
            let mut used = all.into_iter().flat_map(Expr::symbols);
            let other = used.find(|name| !names.contains(name))?;
            let words = format!("it is to be written without {other}");
            ("DIFF_FORM_SYMBOLS", words)
        }
        Form::Digits(n) => {
            let own = || answer.written.last().and_then(numbers);
            let all = answer.literal.clone().map(|one| vec![one]).or_else(own);
            // A component of a vector may be nothing.
            let is_part = all.as_ref().is_some_and(|all| all.len() > 1);
            let fits = |literal: &Literal| {
                is_part && literal.value.is_zero()
                    || (counted(literal)..=literal.digits).contains(n)
            };
            let words = match all.as_deref() {
                None | Some([]) => {
                    format!("a decimal number with {n} significant digits is asked for")
                }
                Some(all) => {
                    let Literal { digits, .. } = all.iter().find(|literal| !fits(literal))?;
                    format!("{n} significant digits are asked for, and it has {digits}")
                }
            };
            ("DIFF_FORM_DIGITS", words)
        }
        Form::WithUnit if !matches!(content, Content::Quantity(_)) => {
            ("DIFF_FORM_UNIT", "a unit is to be given".into())
        }
        _ => return None,
    })
}

/// Whether an answer is longer than half again the shortest form known, or has like parts that are not gathered.
fn is_long(key: &Key, answer: &Reading) -> bool {
    let known = key.reading.content.exprs().into_iter().map(Expr::size);
    let shortest = known.min().unwrap_or(usize::MAX);
    let long = |e: &&Expr| {
        let read = Field::of(&key.question.domains, e).ok();
        let tidy = read
            .filter(|(_, x)| x.terms() <= super::context::WRITTEN)
            .map_or(usize::MAX, |(field, x)| field.expr(&x).size())
            .min(shortest);
        tidy != usize::MAX && 2 * e.size() > 3 * tidy + 4 || repeats(e)
    };
    let known = key.reading.content.exprs();
    let common = |e: &&Expr| !known.contains(e) && divides(e, key);
    let all = answer.content.answer().exprs();
    let written = |w: &Written| reducible(w) || cancels(w);
    all.iter().any(|e| long(e) || common(e)) || answer.written.last().is_some_and(written)
}

/// Whether a polynomial divides both sides of a fraction.
fn divides(e: &Expr, key: &Key) -> bool {
    let shared = |factors: &[Expr]| {
        let [mut above, mut below] = [Vec::new(), Vec::new()];
        for factor in factors.iter().filter(|f| f.is_rational()) {
            match factor.node() {
                Node::Power(base, k) if k.as_number().is_some_and(Signed::is_negative) => {
                    below.push(base.clone());
                }
                _ => above.push(factor.clone()),
            }
        }
        let [above, below] = [above, below].map(Expr::product);
        let parts = |(field, [a, b]): (Field, [Element; 2])| {
            let below: Vec<Expr> = field
                .zeros(&b)
                .iter()
                .map(|part| field.expr(part))
                .collect();
            let shared = |part: &Element| below.contains(&field.expr(part));
            field.zeros(&a).iter().any(shared)
        };
        let pair = Field::pair(&key.question.domains, &above, &below).ok();
        !below.is_constant() && pair.is_some_and(|(field, a, b)| parts((field, [a, b])))
    };
    e.parts().any(|part| match part.node() {
        Node::Product(factors) => shared(factors),
        _ => false,
    })
}

/// Whether the same factor stands above and below a fraction line as it is written.
fn cancels(w: &Written) -> bool {
    let mut sides = [Vec::new(), Vec::new()];
    factors(w, false, &mut sides);
    let [above, below] = &sides;
    let shared = above.iter().any(|a| below.iter().any(|b| same(a, b)));
    shared || w.pieces().into_iter().any(cancels)
}

/// Every factor of a piece, each with whether it stands below the fraction line.
fn each_factor<'w>(w: &'w Written, below: bool, take: &mut dyn FnMut(&'w Written, bool)) {
    match &w.shape {
        Shape::Product(parts) => {
            for (i, (link, part)) in parts.iter().enumerate() {
                each_factor(part, below != (i > 0 && *link == Link::Over), take);
            }
        }
        Shape::Fraction(a, b) => {
            each_factor(a, below, take);
            each_factor(b, !below, take);
        }
        Shape::Bracket(inside) => each_factor(inside, below, take),
        _ => take(w, below),
    }
}

/// What stands above the fraction line, and below it, without exponents.
fn factors<'w>(w: &'w Written, below: bool, sides: &mut [Vec<&'w Written>; 2]) {
    each_factor(w, below, &mut |part, below| match &part.shape {
        Shape::Power(base, exponent) if whole(exponent).is_some() => factors(base, below, sides),
        _ => sides[usize::from(below)].push(part),
    });
}

/// Whether two pieces are the same name, or the same sum of such.
fn same(a: &Written, b: &Written) -> bool {
    match (&a.shape, &b.shape) {
        (Shape::Symbol(a), Shape::Symbol(b)) => a == b,
        (Shape::Number(a), Shape::Number(b)) => a.value == b.value,
        (Shape::Bracket(a), _) => same(a, b),
        (_, Shape::Bracket(b)) => same(a, b),
        (Shape::Sum(a), Shape::Sum(b)) => {
            let pair =
                |((s, a), (t, b)): (&(Sign, Written), &(Sign, Written))| s == t && same(a, b);
            a.len() == b.len() && a.iter().zip(b).all(pair)
        }
        _ => false,
    }
}

/// The numbers that an answer in digits is written with: one with its sign of degrees or percent, with ± or its unit, the
/// components of a vector.
fn numbers(written: &Written) -> Option<Vec<Literal>> {
    if let Some(one) = written.literal().or_else(|| written.marked()) {
        return Some(vec![one]);
    }
    let inside: Vec<&Written> = match &written.shape {
        Shape::List(_) | Shape::Measured(..) | Shape::Bracket(_) => written.pieces(),
        Shape::Sum(terms) if terms.len() == 1 => written.pieces(),
        _ => return None,
    };
    let all: Option<Vec<Vec<Literal>>> = inside.into_iter().map(numbers).collect();
    Some(all?.concat())
}

/// The digits of a number that surely count: those before the zeros at the end of a whole one, all of a decimal.
fn counted(literal: &Literal) -> u32 {
    if literal.decimal {
        return literal.digits;
    }
    let number = literal.value.to_string();
    let zeros = number.len() - number.trim_end_matches('0').len();
    literal.digits.saturating_sub(zeros as u32).max(1)
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
    let mut sides = [1_i64, 1];
    each_factor(w, false, &mut |part, below| {
        let side = &mut sides[usize::from(below)];
        *side = whole(part)
            .and_then(|n| side.checked_mul(n))
            .unwrap_or(*side);
    });
    let [above, below] = sides;
    let rooted = match &w.shape {
        Shape::Root(None, inside) => {
            let n = whole(inside).unwrap_or(1).min(MOST_UNDER_ROOT);
            (2..).take_while(|d| d * d <= n).any(|d| n % (d * d) == 0)
        }
        _ => false,
    };
    rooted
        || unfinished(w)
        || num_integer::gcd(above, below) > 1
        || w.pieces().into_iter().any(reducible)
}

/// Whether a step of arithmetic is left: numbers added, multiplied or raised, a term 0, a factor or an exponent 1, a fraction
/// below a fraction line or alone above one.
fn unfinished(w: &Written) -> bool {
    let inside = |w: &Written| match &w.shape {
        Shape::Bracket(inside) => (**inside).clone(),
        _ => w.clone(),
    };
    let is_fraction = |w: &Written| match &inside(w).shape {
        Shape::Fraction(..) => true,
        Shape::Product(factors) => factors.iter().skip(1).any(|(link, _)| *link == Link::Over),
        _ => false,
    };
    let zero = |w: &Written| w.literal().is_some_and(|l| l.value == ratio(0, 1));
    match &w.shape {
        Shape::Sum(terms) => {
            let numbers = terms.iter().filter(|(_, term)| rational(term)).count();
            let negative = |w: &Written| match &inside(w).shape {
                Shape::Sum(terms) => matches!(terms[..], [(Sign::Minus, _)]),
                _ => false,
            };
            let twice = |(sign, term): &(Sign, Written)| *sign == Sign::Minus && negative(term);
            numbers > 1
                || terms.iter().any(twice)
                || terms.len() > 1 && terms.iter().any(|(_, term)| zero(term))
        }
        Shape::Product(factors) => {
            let over = |i: usize, link: &Link| i > 0 && *link == Link::Over;
            let all = || factors.iter().enumerate();
            let [above, below] = [false, true].map(|side| {
                let here = all().filter(|(i, (link, _))| over(*i, link) == side);
                here.map(|(_, (_, factor))| factor).collect::<Vec<_>>()
            });
            let whole =
                |side: &[&Written]| side.iter().filter_map(|w| signless(w)).collect::<Vec<_>>();
            let (mine, theirs) = (whole(&above), whole(&below));
            let one = mine.contains(&1) && above.len() > 1 || theirs.contains(&1);
            let alone = !below.is_empty() && above.len() == 1 && is_fraction(above[0]);
            let nested = alone || below.iter().any(|w| is_fraction(w));
            mine.len() > 1 || theirs.len() > 1 || one || nested
        }
        Shape::Fraction(above, below) => {
            is_fraction(above) || is_fraction(below) || signless(below) == Some(1)
        }
        Shape::Power(base, exponent) => {
            let n = whole(exponent);
            n == Some(1)
                || zero(exponent)
                || n.is_some() && whole(base).is_some_and(|base| base != 10)
        }
        _ => false,
    }
}

/// The whole number of a factor, whatever its sign.
fn signless(w: &Written) -> Option<i64> {
    match &w.shape {
        Shape::Bracket(inside) => signless(inside),
        Shape::Sum(terms) => match &terms[..] {
            [(_, only)] => signless(only),
            _ => None,
        },
        _ => whole(w),
    }
}

/// Whether a term is a number without a root or a function: `1`, `1/3`, `0.5`.
fn rational(w: &Written) -> bool {
    match &w.shape {
        Shape::Number(_) => true,
        Shape::Bracket(_) | Shape::Product(_) | Shape::Fraction(..) => {
            w.pieces().into_iter().all(rational)
        }
        Shape::Sum(terms) => terms.iter().all(|(_, term)| rational(term)),
        _ => false,
    }
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

/// Whether no sum at the top or in a factor has more than one factor in its normal form, or as a polynomial.
fn factored(e: &Expr, key: &Key) -> bool {
    let domains = &key.question.domains;
    let irreducible = |sum: &Expr| {
        let parts = sum.is_rational().then(|| Field::of(domains, sum).ok());
        let one = |(field, x): (Field, Element)| field.zeros(&x).len() < 2;
        let tidy = tidy(sum, domains);
        parts.flatten().is_none_or(one)
            && (tidy.is_err() || tidy.is_ok_and(|e| matches!(e.node(), Node::Sum(_))))
    };
    match e.node() {
        Node::Sum(_) => irreducible(e),
        Node::Product(factors) => factors.iter().all(|f| factored(f, key)),
        Node::Power(base, k) if k.is_integer() => factored(base, key),
        _ => true,
    }
}
