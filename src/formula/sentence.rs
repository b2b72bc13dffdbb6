//! A sentence with formulas in it, so that every format can typeset them.
//!
//! In: words and expressions. Out: pieces in order; as plain text the formulas are written the way people type them.

use std::collections::BTreeMap;
use std::fmt;

use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::write_plain;
use crate::expr::{Expr, Int, Node, Rational, Symbol};

/// A sentence from a template, with words, formulas and other sentences in its gaps, in order:
/// `sentence!("it holds for {} ≤ {}", &h, &limit)`.
macro_rules! sentence {
    ($template:literal $(, $piece:expr)* $(,)?) => {
        $crate::formula::Sentence::filled($template, [$($crate::formula::Sentence::from($piece)),*])
    };
}
pub(crate) use sentence;

/// Words or a formula.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Piece {
    /// Words.
    Words(String),
    /// A formula.
    Formula(Expr),
}

/// Pieces in order.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Sentence(pub Vec<Piece>);

impl fmt::Display for Sentence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.written(write_plain))
    }
}

impl Sentence {
    /// Words without a formula.
    pub fn words(words: impl Into<String>) -> Sentence {
        Sentence(vec![Piece::Words(words.into())])
    }

    /// The sentence with values put in for symbols.
    pub fn put_in(&self, values: &BTreeMap<Symbol, Expr>) -> Sentence {
        self.map(|e| e.substitute(values))
    }

    /// The sentence with every formula changed.
    pub fn map(&self, change: impl Fn(&Expr) -> Expr) -> Sentence {
        let put = |piece: &Piece| match piece {
            Piece::Words(words) => Piece::Words(words.clone()),
            Piece::Formula(e) => Piece::Formula(change(e)),
        };
        Sentence(self.0.iter().map(put).collect())
    }

    /// The sentence with its words changed.
    pub fn worded(&self, change: &dyn Fn(&str) -> String) -> Sentence {
        let put = |piece: &Piece| match piece {
            Piece::Words(words) => Piece::Words(change(words)),
            Piece::Formula(e) => Piece::Formula(e.clone()),
        };
        Sentence(self.0.iter().map(put).collect())
    }

    /// Where it begins with a condition that is needed, what that says is positive, or not negative, and whether it is the former.
    pub fn condition(&self) -> Option<(Expr, bool)> {
        self.conditions().next()
    }

    /// The same of all conditions that are needed: those it begins with, unless something else will do as well.
    pub fn conditions(&self) -> impl Iterator<Item = (Expr, bool)> {
        let is_needed = !self.is_partial();
        self.stated().take_while(move |_| is_needed)
    }

    /// Whether it tells a condition as one of two things that will do, "the way is short, or v ≥ u", "v ≥ u, or that w ≥ u", or
    /// as that of one of several values, "v ≥ u, for x = l".
    pub fn is_partial(&self) -> bool {
        self.0.iter().any(|piece| match piece {
            Piece::Words(words) => {
                words == ", for " || words.ends_with(", or ") || words.ends_with(", or that ")
            }
            Piece::Formula(_) => false,
        })
    }

    /// Whether it says in words alone what a motion needs between its ends: "it does not come to rest while φ changes", "a short and
    /// smooth bend leads it on".
    pub fn is_of_the_way(&self) -> bool {
        self.0.iter().any(|piece| match piece {
            Piece::Words(words) => {
                words.contains("does not come to rest ") || words.contains(" smooth bend ")
            }
            Piece::Formula(_) => false,
        })
    }

    /// Whether two sentences tell the same conditions, for whatever reasons.
    pub fn tells_as(&self, other: &Sentence) -> bool {
        let [a, b] = [self, other].map(|s| s.conditions().collect::<Vec<_>>());
        self == other || !a.is_empty() && a == b
    }

    /// Whether it tells a condition at all, needed or partial, in a formula or in words.
    pub fn is_condition(&self) -> bool {
        self.is_partial() || self.is_of_the_way() || self.stated().next().is_some()
    }

    /// All conditions that it begins with, joined by "and", whether they are needed or not.
    pub fn stated(&self) -> impl Iterator<Item = (Expr, bool)> {
        let joined = |i: usize| match i {
            0 => true,
            _ => matches!(&self.0[i - 1], Piece::Words(words) if words == " and "),
        };
        let each = (0..self.0.len()).step_by(4);
        let each = each.take_while(move |i| joined(*i));
        each.map_while(|i| match self.0.get(i..i + 3)? {
            [
                Piece::Formula(left),
                Piece::Words(op),
                Piece::Formula(right),
            ] => Some(match op.as_str() {
                " ≥ " => (left - right, false),
                " > " => (left - right, true),
                " ≤ " => (right - left, false),
                " < " => (right - left, true),
                _ => return None,
            }),
            _ => None,
        })
    }

    /// The sentence with its formulas as `write` gives them.
    pub fn written(&self, write: impl Fn(&Expr) -> String) -> String {
        let pieces = self.0.iter().map(|piece| match piece {
            Piece::Words(words) => words.clone(),
            Piece::Formula(e) => write(e),
        });
        pieces.collect()
    }

    /// `e ≥ 0` as people state it: what is taken away stands on the other side, `2a − b ≥ 0` as `2a ≥ b`.
    pub fn not_negative(e: &Expr) -> Sentence {
        beyond_zero(e, [" ≥ ", " ≤ "])
    }

    /// `e > 0` in the same way.
    pub fn positive(e: &Expr) -> Sentence {
        beyond_zero(e, [" > ", " < "])
    }

    /// `e = 0` in the same way.
    pub fn zero(e: &Expr) -> Sentence {
        beyond_zero(e, [" = ", " = "])
    }

    /// A template with a piece in each of its gaps `{}`.
    pub fn filled<const N: usize>(template: &str, pieces: [Sentence; N]) -> Sentence {
        debug_assert_eq!(template.matches("{}").count(), N, "{template}");
        let mut out = Sentence::default();
        let mut pieces = pieces.into_iter();
        for words in template.split("{}") {
            if !words.is_empty() {
                out.0.push(Piece::Words(words.to_string()));
            }
            out.0
                .extend(pieces.next().into_iter().flat_map(|piece| piece.0));
        }
        out
    }

    /// Sentences with something between every two.
    pub fn join(all: impl IntoIterator<Item = Sentence>, between: &str) -> Sentence {
        let mut out = Sentence::default();
        for (i, one) in all.into_iter().enumerate() {
            if i > 0 {
                out.0.push(Piece::Words(between.to_string()));
            }
            out.0.extend(one.0);
        }
        out
    }

    /// `a, b and c`.
    pub fn list(all: &[Sentence]) -> Sentence {
        match all {
            [] => Sentence::default(),
            [one] => one.clone(),
            [first @ .., last] => {
                sentence!(
                    "{} and {}",
                    Sentence::join(first.iter().cloned(), ", "),
                    last
                )
            }
        }
    }
}

/// `a, b and c`.
pub fn listed(items: &[String]) -> String {
    together(items, "and")
}

/// `a, b or c`.
pub fn either(items: &[String]) -> String {
    together(items, "or")
}

fn together(items: &[String], word: &str) -> String {
    match items {
        [first @ .., last] if !first.is_empty() => format!("{} {word} {last}", first.join(", ")),
        _ => items.concat(),
    }
}

/// A number with four significant digits.
pub fn digits(value: f64) -> String {
    if value == 0.0 {
        return String::from("0");
    }
    let magnitude = value.abs().log10().floor();
    if !(-4.0..6.0).contains(&magnitude) {
        return format!("{value:.3e}");
    }
    let text = format!("{value:.*}", (3.0 - magnitude).max(0.0) as usize);
    trimmed(&text).replace('-', "−")
}

/// A sentence starts with a capital.
pub fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or(String::new(), |first| {
        first.to_uppercase().chain(chars).collect()
    })
}

/// A decimal without the zeros at its end that say nothing.
pub fn trimmed(decimal: &str) -> &str {
    match decimal.contains('.') {
        true => decimal.trim_end_matches('0').trim_end_matches('.'),
        false => decimal,
    }
}

/// Both sides of `e ≥ 0` or `e = 0` as people write them: what is taken away stands on the right.
pub fn sides(e: &Expr) -> [Expr; 2] {
    // The size of a factor before a sum says nothing of its sign.
    let (factor, rest) = e.split_number();
    let terms: Vec<Expr> = match rest.node() {
        Node::Sum(terms) if factor.is_negative() => terms.iter().map(|t| -t).collect(),
        Node::Sum(terms) => terms.clone(),
        _ => vec![e.clone()],
    };
    let by_sign = |terms: Vec<Expr>| {
        let (taken, kept): (Vec<Expr>, Vec<Expr>) = terms.into_iter().partition(Expr::is_negative);
        [Expr::sum(kept), -Expr::sum(taken)].map(|side| gathered(&side))
    };
    let [kept, taken] = by_sign(terms.clone());
    if terms.len() > 1 && (kept.is_zero() || taken.is_zero()) {
        // `A u + m (u − v) ≤ 0` is `m v ≥ u (A + m)`.
        let apart = by_sign(terms.iter().flat_map(taken_apart).collect());
        let total = |[a, b]: &[Expr; 2], of: fn(&Expr) -> usize| of(a) + of(b);
        let is_short = total(&apart, |e| e.terms().len()) <= terms.len() + 1;
        if is_short && total(&apart, Expr::size) <= kept.size() + taken.size() {
            return apart;
        }
    }
    [kept, taken]
}

/// The terms of `m (u − v)`, where the sum in it takes something away.
fn taken_apart(term: &Expr) -> Vec<Expr> {
    let is_sum = |f: &&Expr| matches!(f.node(), Node::Sum(_));
    let mut sums = term.factors().iter().filter(is_sum);
    match (sums.next().map(|f| (f, f.node())), sums.next()) {
        (Some((sum, Node::Sum(inner))), None) if inner.iter().any(Expr::is_negative) => {
            let others = Expr::product(term.factors().iter().filter(|f| *f != sum).cloned());
            inner.iter().map(|t| multiplied(&others, t)).collect()
        }
        _ => vec![term.clone()],
    }
}

/// A product with each power once.
fn multiplied(a: &Expr, b: &Expr) -> Expr {
    let mut all: Vec<(&Expr, Rational)> = Vec::new();
    for f in a.factors().iter().chain(b.factors()) {
        let (base, k) = match f.node() {
            Node::Power(base, k) => (base, k.as_number().cloned()),
            _ => (f, Some(Rational::one())),
        };
        match (all.iter_mut().find(|(own, _)| *own == base), k) {
            (Some((_, own)), Some(k)) => *own += k,
            (_, Some(k)) => all.push((base, k)),
            (_, None) => all.push((f, Rational::one())),
        }
    }
    let powers = all.into_iter().map(|(base, k)| base.power(Expr::from(k)));
    Expr::product(powers)
}

/// A relation to zero by its two sides; the second sign stands where they change places.
fn beyond_zero(e: &Expr, [sign, turned]: [&str; 2]) -> Sentence {
    let [kept, taken] = sides(e);
    // A constant stands on the right, with the factor of the other side put in: `3 − 4μ ≥ 0` as `μ ≤ 3/4`.
    let solved = |side: &Expr, sign, constant: &Expr| {
        let (factor, rest) = side.split_number();
        sentence!(
            "{}{}{}",
            &rest,
            sign,
            &(constant * &Expr::from(factor.recip()))
        )
    };
    // `1 + cosθ > 0` as `cosθ > −1`.
    let number = kept.terms().iter().find(|t| t.as_number().is_some());
    if let (Some(number), true, true) = (number, taken.is_zero(), kept.terms().len() > 1) {
        let rest = kept.terms().iter().filter(|t| *t != number).cloned();
        return sentence!("{}{}{}", &Expr::sum(rest), sign, &-number);
    }
    let is_scaled = |side: &Expr| !side.is_constant() && !side.split_number().0.is_zero();
    match (kept.is_constant(), taken.is_constant()) {
        (true, _) if is_scaled(&taken) => solved(&taken, turned, &kept),
        (_, true) if is_scaled(&kept) => solved(&kept, sign, &taken),
        _ => sentence!("{}{}{}", &kept, sign, &taken),
    }
}

/// A sum with the symbols and the whole number that stand in each of its terms in front: `3 μ + 6 μ sin²θ` as
/// `3 μ (1 + 2 sin²θ)`.
fn gathered(side: &Expr) -> Expr {
    let Node::Sum(terms) = side.node() else {
        return side.clone();
    };
    let mut common = terms[0].factors().to_vec();
    common.retain(|f| f.as_symbol().is_some() && terms.iter().all(|t| t.factors().contains(f)));
    let (numbers, plain): (Vec<_>, Vec<_>) = terms.iter().map(Expr::split_number).unzip();
    let whole = |all: &[Rational]| all.iter().all(Rational::is_integer);
    let number = match whole(&numbers) {
        true => numbers.iter().fold(Int::zero(), |g, n| g.gcd(n.numer())),
        false => Int::one(),
    };
    let number = Rational::from(number);
    let rest = |(own, term): (&Rational, &Expr)| {
        let factors = term.factors().iter().filter(|f| !common.contains(f));
        let own = Expr::from(own / &number);
        Expr::product([own].into_iter().chain(factors.cloned()))
    };
    let rest = Expr::sum(numbers.iter().zip(&plain).map(rest));
    let number = Expr::from(number);
    Expr::product(
        [number]
            .into_iter()
            .chain(common.iter().cloned())
            .chain([rest]),
    )
}

impl From<&str> for Sentence {
    fn from(words: &str) -> Sentence {
        Sentence::words(words)
    }
}

impl From<String> for Sentence {
    fn from(words: String) -> Sentence {
        Sentence::words(words)
    }
}

impl From<&String> for Sentence {
    fn from(words: &String) -> Sentence {
        Sentence::words(words)
    }
}

impl From<&Expr> for Sentence {
    fn from(e: &Expr) -> Sentence {
        Sentence(vec![Piece::Formula(e.clone())])
    }
}

impl From<&Symbol> for Sentence {
    fn from(name: &Symbol) -> Sentence {
        Sentence::from(&Expr::symbol(name))
    }
}

impl From<&Sentence> for Sentence {
    fn from(other: &Sentence) -> Sentence {
        other.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_condition_needs_is_no_half_of_an_alternative() {
        let [u, v, w] = ["u", "v", "w"].map(Expr::symbol);
        let [first, second] = [(&v - &u, false), (&v - &w, true)];
        let one = sentence!("{} ≥ {} (so that it slides)", &v, &u);
        assert!(one.conditions().eq([first.clone()]));
        let both = sentence!("{} ≤ {} and {} > {}", &u, &v, &v, &w);
        assert_eq!(both.condition(), Some(first.clone()));
        assert_eq!(
            both.conditions().collect::<Vec<_>>(),
            [first.clone(), second]
        );
        let other = sentence!("{} < {}", &w, &u);
        for partial in [
            Sentence::join([one.clone(), other], ", or that "),
            sentence!("{}, for {} = {}", &one, &w, &u),
        ] {
            assert!(partial.is_partial() && partial.is_condition(), "{partial}");
            assert_eq!(partial.condition(), None, "{partial}");
            assert_eq!(partial.stated().next(), Some(first.clone()), "{partial}");
        }
        let short = sentence!("the way is short, or {} ≥ {}", &v, &u);
        assert!(short.is_partial() && short.is_condition() && short.stated().next().is_none());
        assert!(!Sentence::from("it slides, or rests").is_condition());
    }
}
