//! How much of a wrong answer is right, found by trying: sign, factor, dimension, special cases, exchanged symbols.
//!
//! Every try is first weighed at a few points in certified doubles and proved only where these agree, so a wrong answer
//! costs little and a diagnosis is never a guess.

use std::collections::{BTreeMap, BTreeSet};

use num_traits::Signed;

use super::compare::{Context, is_short, quotient, same_number};
use super::{Diagnosis, fraction, number};
use crate::dimension::{self, Clash, Dimension};
use crate::domain::{Coordinate, Domains, Sample, roles, samples};
use crate::equality::{self, Equality, How};
use crate::expr::{Expr, Function, Node, Point, Scalar, Symbol, ratio};
use crate::formula::write_plain;
use crate::interval::{Interval, Outcome, evaluate};

/// Points weighed before a proof.
const GLANCES: usize = 4;

/// The note of a grade whose first diagnosis has this code.
pub(crate) fn note(code: &str) -> &'static str {
    match code {
        "DIMENSION" | "DIMENSION_CLASH" => "DIFF_DIMENSION",
        "SIGN" => "DIFF_SIGN",
        "FACTOR" => "DIFF_FACTOR",
        "FACTOR_SYMBOL" => "DIFF_FACTOR_SYMBOL",
        "MAGNITUDE" => "DIFF_MAGNITUDE",
        "RECIPROCAL" => "DIFF_RECIPROCAL",
        "SIN_COS" => "DIFF_SIN_COS",
        "HALF" | "DOUBLE" => "DIFF_HALF",
        "EXCHANGED" => "DIFF_EXCHANGED",
        "SYMBOL_SIGN" => "DIFF_SYMBOL_SIGN",
        "SPECIAL_CASE" => "DIFF_SPECIAL_CASE",
        "SMALL_ANGLE" => "DIFF_SMALL_ANGLE",
        "POWER" => "DIFF_POWER",
        "SYMBOLS_EXTRA" | "SYMBOLS_MISSING" => "DIFF_SYMBOLS",
        "ROUNDED" => "DIFF_ROUNDED",
        "DEGREES" => "DIFF_DEGREES",
        "TEN" => "DIFF_TEN",
        "SIGN_X" | "SIGN_Y" | "SIGN_Z" => "DIFF_SIGN_COMPONENT",
        "SWAPPED" => "DIFF_SWAPPED",
        _ => "DIFF",
    }
}

/// What is wrong with an expression that is known to differ.
pub(crate) fn diagnose(ctx: &Context, expected: &Expr, answer: &Expr) -> Vec<Diagnosis> {
    if expected.size() + answer.size() > 2_000 {
        return Vec::new();
    }
    let mut found = Vec::new();
    if expected.symbols().is_empty() && answer.symbols().is_empty() {
        return numbers(expected, answer);
    }
    found.extend(dimensions(ctx, expected, answer));
    let trial = Trial::new(ctx, expected, answer);
    if let Some(d) = trial
        .sign()
        .or_else(|| trial.factor(ctx))
        .or_else(|| trial.magnitude())
    {
        found.push(d);
    } else if let Some(d) = trial
        .sin_cos()
        .or_else(|| trial.reciprocal())
        .or_else(|| trial.symbol_signs())
        .or_else(|| trial.doubled(ctx))
        .or_else(|| trial.exchanged(ctx))
        .or_else(|| trial.special(ctx))
        .or_else(|| trial.small_angle())
        .or_else(|| trial.power())
        .or_else(|| trial.factor_of_symbols(ctx))
    {
        found.push(d);
    }
    found.extend(symbols(ctx, expected, answer));
    found
}

/// What is wrong with a number.
pub(crate) fn numbers(expected: &Expr, answer: &Expr) -> Vec<Diagnosis> {
    let mut found = Vec::new();
    let negated = -answer;
    if same_number(expected, &negated) {
        found.push(Diagnosis::new(
            "SIGN",
            "right up to the sign",
            "check the sign",
        ));
        return found;
    }
    let (Some(exact), Some(value)) = (number::bounds(expected), fraction(answer)) else {
        return found;
    };
    let digits = number::digits_shared(&value, &exact);
    if (2..100).contains(&digits) {
        let message = format!("the expected value rounded to {digits} significant digits");
        found.push(Diagnosis::new(
            "ROUNDED",
            message,
            "give the exact value rather than a rounded one",
        ));
        return found;
    }
    let minus = -value.clone();
    if (2..100).contains(&number::digits_shared(&minus, &exact)) {
        found.push(Diagnosis::new(
            "SIGN",
            "right up to the sign and rounding",
            "check the sign",
        ));
    }
    if let Some(e) = fraction(expected).filter(|e| *e != ratio(0, 1)) {
        let q = &value / &e;
        let tens = |k: i32| q.abs() == number::ten_to(k);
        if let Some(k) = (-12..=12).find(|k| *k != 0 && tens(*k)) {
            found.push(Diagnosis::new(
                "TEN",
                format!("off by a factor 10^{k}"),
                "check powers of ten and prefixes of units",
            ));
        } else if simple(&q) && q.is_positive() {
            found.push(Diagnosis::new(
                "FACTOR",
                format!("right up to the factor {q}"),
                "a constant factor is wrong",
            ));
        }
    }
    found
}

/// What is wrong with a vector of which component `first` differs.
pub(crate) fn vectors(
    ctx: &Context,
    expected: &[Expr; 3],
    answer: &[Expr; 3],
    first: usize,
) -> Vec<Diagnosis> {
    let domains = &ctx.key.question.domains;
    let all = |f: &dyn Fn(usize) -> Expr| (0..3).all(|i| proved(&expected[i], &f(i), domains));
    if all(&|i| -&answer[i]) {
        return vec![Diagnosis::new(
            "SIGN",
            "right up to the sign of the whole vector",
            "check the direction of your vector",
        )];
    }
    let others = (0..3)
        .filter(|i| *i != first)
        .all(|i| proved(&expected[i], &answer[i], domains));
    if others && proved(&expected[first], &-&answer[first], domains) {
        let (code, axis) = [("SIGN_X", "x"), ("SIGN_Y", "y"), ("SIGN_Z", "z")][first];
        return vec![Diagnosis::new(
            code,
            format!("the {axis}-component has the wrong sign, the others are right"),
            "one component has the wrong sign",
        )];
    }
    if proved(&expected[0], &answer[1], domains) && proved(&expected[1], &answer[0], domains) {
        return vec![Diagnosis::new(
            "SWAPPED",
            "the components are exchanged",
            "check which component is which",
        )];
    }
    let mut found = Vec::new();
    if others {
        let axis = ["x", "y", "z"][first];
        found.push(Diagnosis::new(
            "COMPONENT",
            format!("only the {axis}-component is wrong"),
            "one of the components is right",
        ));
    }
    let mut more = diagnose(ctx, &expected[first], &answer[first]);
    found.append(&mut more);
    found
}

/// Whether an identity is proved.
pub(crate) fn proved(a: &Expr, b: &Expr, domains: &Domains) -> bool {
    matches!(
        equality::decide(a, b, domains).equality,
        Equality::Same {
            how: How::Identity { .. }
        }
    )
}

/// A fraction a slip of the pen would produce.
fn simple(q: &crate::expr::Rational) -> bool {
    q.numer().bits() <= 7 && q.denom().bits() <= 7
}

struct Trial<'a> {
    expected: &'a Expr,
    answer: &'a Expr,
    domains: &'a Domains,
    points: Vec<Point<Outcome<Interval>>>,
    values: Vec<Outcome<Interval>>,
    answers: Vec<Outcome<Interval>>,
}

impl<'a> Trial<'a> {
    fn new(ctx: &'a Context, expected: &'a Expr, answer: &'a Expr) -> Trial<'a> {
        let domains = &ctx.key.question.domains;
        let uses = roles(&[expected, answer]);
        let (all, _) = domains.completed(&uses);
        // The first points have many ones, at which a power is as good as another.
        let points = samples(&uses, &all, 2 + GLANCES);
        // What is known by its direction alone costs less by far; that does where no angle is needed in radians.
        let radians = uses.radians
            || uses
                .symbols
                .iter()
                .filter(|(_, r)| r.turns)
                .any(|(name, r)| {
                    let direction = |s: &Sample| {
                        matches!(s.coordinates.get(name), Some(Coordinate::Direction { .. }))
                    };
                    r.bare || !points.iter().all(direction)
                });
        let points: Vec<_> = points.iter().skip(2).map(|s| s.point(radians)).collect();
        let at = |e: &Expr| points.iter().map(|p| evaluate(e, p)).collect::<Vec<_>>();
        Trial {
            expected,
            answer,
            domains,
            values: at(expected),
            answers: at(answer),
            points,
        }
    }

    /// Whether two lists of values are of different expressions for certain.
    fn apart(a: &[Outcome<Interval>], b: &[Outcome<Interval>]) -> bool {
        a.iter().zip(b).any(|pair| match pair {
            (Outcome::Value(a), Outcome::Value(b)) => a.is_disjoint(b),
            _ => false,
        })
    }

    /// Whether an expression may have these values, some of which are known; the first point that tells them apart ends it.
    fn may_be(&self, values: &[Outcome<Interval>], e: &Expr) -> bool {
        let mut known = false;
        for (value, point) in values.iter().zip(&self.points) {
            match (value, evaluate(e, point)) {
                (Outcome::Value(a), Outcome::Value(b)) if a.is_disjoint(&b) => return false,
                (Outcome::Value(_), Outcome::Value(_)) => known = true,
                _ => {}
            }
        }
        known
    }

    /// Whether the answer may be the expected formula times a number: no two points tell two different ones.
    fn in_proportion(&self) -> bool {
        let [mut left, mut right] = [Vec::new(), Vec::new()];
        for (i, (value, answer)) in self.values.iter().zip(&self.answers).enumerate() {
            left.extend(self.answers[..i].iter().map(|other| value.times(other)));
            right.extend(self.values[..i].iter().map(|other| answer.times(other)));
        }
        !Trial::apart(&left, &right)
    }

    /// Whether a changed answer equals the expected formula.
    fn mends(&self, changed: &Expr) -> bool {
        self.may_be(&self.values, changed) && proved(self.expected, changed, self.domains)
    }

    /// Whether the answer is the expected formula changed in a known way.
    fn is(&self, changed: &Expr) -> bool {
        self.may_be(&self.answers, changed) && proved(changed, self.answer, self.domains)
    }

    fn sign(&self) -> Option<Diagnosis> {
        self.mends(&-self.answer).then(|| {
            Diagnosis::new(
                "SIGN",
                "right up to the sign",
                "check the sign, and which direction counts as positive",
            )
        })
    }

    /// A constant factor.
    fn factor(&self, ctx: &Context) -> Option<Diagnosis> {
        if self.expected.is_zero() || self.answer.is_zero() || !self.in_proportion() {
            return None;
        }
        if let Some(k) = quotient(self.answer, self.expected, ctx) {
            let value = fraction(&k);
            if let Some(value) = &value {
                let off = (value - ratio(1, 1)).abs();
                if !simple(value) && off < ratio(1, 50) {
                    let digits = number::digits_shared(value, &[ratio(1, 1), ratio(1, 1)]).min(30);
                    let message =
                        format!("right to about {digits} digits: a coefficient was rounded");
                    return Some(Diagnosis::new(
                        "ROUNDED",
                        message,
                        "give exact coefficients rather than rounded ones",
                    ));
                }
            }
            let message = format!("right up to the constant factor {}", write_plain(&k));
            return Some(Diagnosis::new(
                "FACTOR",
                message,
                "a constant factor is wrong",
            ));
        }
        None
    }

    /// A factor made of symbols that both formulas know.
    fn factor_of_symbols(&self, ctx: &Context) -> Option<Diagnosis> {
        let short = is_short(self.expected, self.answer);
        if self.expected.is_zero() || self.answer.is_zero() || !short {
            return None;
        }
        let mut field = crate::algebra::Field::new(self.domains);
        field.prepare([self.answer, self.expected]);
        let (a, e) = (
            field.element(self.answer).ok()?,
            field.element(self.expected).ok()?,
        );
        let q = field.div(&a, &e).ok()?;
        if !q.is_monomial() {
            return None;
        }
        let shown = field.expr(&q);
        let known: BTreeSet<Symbol> = ctx
            .key
            .question
            .symbols
            .iter()
            .map(|g| g.name.clone())
            .collect();
        let mut calls = false;
        shown.walk(&mut |e| calls |= matches!(e.node(), Node::Call(..)));
        if calls || !shown.symbols().is_subset(&known) || shown.size() > 12 {
            return None;
        }
        let message = format!("too large by the factor {}", ctx.say(&shown));
        Some(Diagnosis::new(
            "FACTOR_SYMBOL",
            message,
            "a factor is missing or too much; compare the dimensions",
        ))
    }

    fn magnitude(&self) -> Option<Diagnosis> {
        let square = |e: &Expr| e.powi(2);
        let values = |v: &[Outcome<Interval>]| -> Vec<f64> {
            v.iter()
                .filter_map(|o| o.clone().value())
                .map(|i| i.low.abs().max(i.high.abs()))
                .collect()
        };
        let close = values(&self.values)
            .iter()
            .zip(values(&self.answers))
            .all(|(a, b)| (a - b).abs() <= 1e-9 * a.abs().max(b));
        (close && proved(&square(self.expected), &square(self.answer), self.domains)).then(|| {
            Diagnosis::new(
                "MAGNITUDE",
                "right in magnitude; the sign is wrong on a part of the domain",
                "the magnitude is right: think of the sign",
            )
        })
    }

    fn reciprocal(&self) -> Option<Diagnosis> {
        if self.answer.is_zero() {
            return None;
        }
        self.mends(&self.answer.powi(-1)).then(|| {
            Diagnosis::new(
                "RECIPROCAL",
                "the reciprocal of the expected value",
                "numerator and denominator look exchanged",
            )
        })
    }

    fn sin_cos(&self) -> Option<Diagnosis> {
        let swapped = swap(self.answer);
        (swapped != *self.answer && self.mends(&swapped))
            .then(|| {
                Diagnosis::new(
                    "SIN_COS",
                    "right with sine and cosine exchanged",
                    "check from which side the angle is measured",
                )
            })
            .or_else(|| self.one_swapped())
    }

    /// One symbol's sines and cosines exchanged.
    fn one_swapped(&self) -> Option<Diagnosis> {
        let angles: Vec<Symbol> = roles(&[self.answer])
            .symbols
            .into_iter()
            .filter(|(_, r)| r.turns)
            .map(|(n, _)| n)
            .collect();
        if angles.len() < 2 {
            return None;
        }
        let right = Expr::pi() * Expr::ratio(1, 2);
        angles.iter().find_map(|name| {
            let turned = self.answer.substitute(&BTreeMap::from([(
                name.clone(),
                &right - &Expr::symbol(name),
            )]));
            self.mends(&turned).then(|| {
                Diagnosis::new(
                    "SIN_COS",
                    format!("right with {name} measured from the other side"),
                    "check from which side the angle is measured",
                )
            })
        })
    }

    fn symbol_signs(&self) -> Option<Diagnosis> {
        self.answer.symbols().into_iter().find_map(|name| {
            let flipped = self
                .answer
                .substitute(&BTreeMap::from([(name.clone(), -Expr::symbol(&name))]));
            self.mends(&flipped).then(|| {
                Diagnosis::new(
                    "SYMBOL_SIGN",
                    format!("right with {name} replaced by -{name}"),
                    format!("check the sign with which {name} enters"),
                )
            })
        })
    }

    /// A length, mass or the like taken twice or half.
    fn doubled(&self, ctx: &Context) -> Option<Diagnosis> {
        self.answer
            .symbols()
            .into_iter()
            .filter(|n| !angle(n, self.answer))
            .find_map(|name| {
                for (n, d, code, words) in [(1, 2, "HALF", "half of"), (2, 1, "DOUBLE", "twice")] {
                    let scaled = self.answer.substitute(&BTreeMap::from([(
                        name.clone(),
                        Expr::symbol(&name) * Expr::ratio(n, d),
                    )]));
                    if self.mends(&scaled) {
                        let message = format!(
                            "right with {words} {} in place of {}",
                            ctx.say(&Expr::symbol(&name)),
                            ctx.say(&Expr::symbol(&name))
                        );
                        return Some(Diagnosis::new(
                            code,
                            message,
                            format!("check what {name} measures: the whole or the half"),
                        ));
                    }
                }
                None
            })
    }

    /// Two symbols of the same kind exchanged, or all symbols of body 1 with those of body 2.
    fn exchanged(&self, ctx: &Context) -> Option<Diagnosis> {
        let names: Vec<Symbol> = self
            .expected
            .symbols()
            .union(&self.answer.symbols())
            .cloned()
            .collect();
        let mut all = BTreeMap::new();
        for (i, a) in names.iter().enumerate() {
            for b in &names[i + 1..] {
                let base = |n: &str| {
                    n.trim_end_matches(|c: char| c.is_ascii_digit() || c == '_')
                        .to_string()
                };
                let kin = match (ctx.dimension_of(a), ctx.dimension_of(b)) {
                    (Some(x), Some(y)) => x == y && !x.is_none(),
                    _ => base(a) == base(b),
                };
                if !kin {
                    continue;
                }
                let pair =
                    BTreeMap::from([(a.clone(), Expr::symbol(b)), (b.clone(), Expr::symbol(a))]);
                if base(a) == base(b) {
                    all.extend(pair.clone());
                }
                if self.mends(&self.answer.substitute(&pair)) {
                    return Some(Diagnosis::new(
                        "EXCHANGED",
                        format!("right with {a} and {b} exchanged"),
                        format!("check which is {a} and which {b}"),
                    ));
                }
            }
        }
        (all.len() > 2 && self.mends(&self.answer.substitute(&all))).then(|| {
            Diagnosis::new(
                "EXCHANGED",
                "right with the two bodies exchanged",
                "check which body is which",
            )
        })
    }

    /// The answer is the expected formula at a special value of one symbol.
    fn special(&self, ctx: &Context) -> Option<Diagnosis> {
        let mine = self.answer.symbols();
        for name in self.expected.symbols() {
            if mine.contains(&name) {
                continue;
            }
            let turning = angle(&name, self.expected);
            let cases: Vec<(Expr, String)> = if turning {
                vec![
                    (Expr::zero(), format!("{name} = 0")),
                    (Expr::pi() * Expr::ratio(1, 2), format!("{name} = 90°")),
                ]
            } else {
                vec![
                    (Expr::zero(), format!("{name} = 0")),
                    (Expr::one(), format!("{name} = 1")),
                ]
            };
            for (value, words) in cases {
                let number = ctx.dimension_of(&name).is_none_or(|d| d.is_none());
                if value.is_one() && !number {
                    continue;
                }
                let special = self
                    .expected
                    .substitute(&BTreeMap::from([(name.clone(), value.clone())]));
                if self.is(&special) {
                    let (code, words) = match turning && value.is_zero() {
                        true => (
                            "SMALL_ANGLE",
                            format!("right only for small {name} (to leading order)"),
                        ),
                        false => ("SPECIAL_CASE", format!("right only for {words}")),
                    };
                    return Some(Diagnosis::new(
                        code,
                        words,
                        format!("the answer should depend on {name}"),
                    ));
                }
            }
        }
        // Two masses taken as equal, and the like.
        let names: Vec<Symbol> = self.expected.symbols().into_iter().collect();
        for a in &names {
            for b in names.iter().filter(|b| *b != a && !mine.contains(*b)) {
                if ctx.dimension_of(a).is_none() || ctx.dimension_of(a) != ctx.dimension_of(b) {
                    continue;
                }
                if self.is(&self
                    .expected
                    .substitute(&BTreeMap::from([(b.clone(), Expr::symbol(a))])))
                {
                    return Some(Diagnosis::new(
                        "SPECIAL_CASE",
                        format!("right only for {b} = {a}"),
                        format!("the answer should depend on {b}"),
                    ));
                }
            }
        }
        None
    }

    /// The same leading term as an angle goes to zero.
    fn small_angle(&self) -> Option<Diagnosis> {
        let angles: BTreeSet<Symbol> = roles(&[self.expected, self.answer])
            .symbols
            .into_iter()
            .filter(|(_, r)| r.turns)
            .map(|(n, _)| n)
            .collect();
        for name in angles {
            let at_zero = |e: &Expr| e.substitute(&BTreeMap::from([(name.clone(), Expr::zero())]));
            let (mut e, mut a) = (self.expected.clone(), self.answer.clone());
            for order in 0..3 {
                let (e0, a0) = (at_zero(&e), at_zero(&a));
                let at =
                    |e: &Expr| -> Vec<_> { self.points.iter().map(|p| evaluate(e, p)).collect() };
                if Trial::apart(&at(&e0), &at(&a0)) {
                    break;
                }
                let zero = |x: &Expr| proved(x, &Expr::zero(), self.domains);
                match (zero(&e0), zero(&a0)) {
                    (true, true) => {
                        (e, a) = (e.derivative(&name), a.derivative(&name));
                        let _ = order;
                        continue;
                    }
                    (false, false) if proved(&e0, &a0, self.domains) => {
                        let words = format!("right only for small {name}, to leading order");
                        return Some(Diagnosis::new(
                            "SMALL_ANGLE",
                            words,
                            format!("right only where {name} is small"),
                        ));
                    }
                    _ => break,
                }
            }
        }
        None
    }

    fn power(&self) -> Option<Diagnosis> {
        if self.mends(&self.answer.powi(2)) {
            return Some(Diagnosis::new(
                "POWER",
                "the square root of the expected value",
                "a root is too much",
            ));
        }
        if self.mends(&self.answer.sqrt()) {
            return Some(Diagnosis::new(
                "POWER",
                "the square of the expected value",
                "a root is missing",
            ));
        }
        None
    }
}

fn angle(name: &Symbol, e: &Expr) -> bool {
    roles(&[e]).symbols.get(name).is_some_and(|r| r.turns)
}

/// Sines and cosines exchanged everywhere.
pub(crate) fn swap(e: &Expr) -> Expr {
    match e.node() {
        Node::Call(Function::Sin, x) => x.cos(),
        Node::Call(Function::Cos, x) => x.sin(),
        Node::Call(Function::Tan, x) => x.tan().powi(-1),
        _ => e.map_parts(swap),
    }
}

/// Dimensions that do not fit, inside the answer or against what is asked.
fn dimensions(ctx: &Context, expected: &Expr, answer: &Expr) -> Option<Diagnosis> {
    let known = |name: &str| ctx.dimension_of(name);
    let asked = match &ctx.key.question.dimension {
        Some(d) => d.clone(),
        None => dimension::of(expected, &known).ok().flatten()?,
    };
    match dimension::of(answer, &known) {
        Ok(Some(found)) if found != asked => {
            let missing = asked.over(&found);
            let message = format!(
                "the answer is {} ({found}), and {} ({asked}) is asked for: {}",
                found.si(),
                asked.si(),
                lacking(&missing)
            );
            Some(Diagnosis::new("DIMENSION", message.clone(), message))
        }
        Err(clash) if !matches!(*clash, Clash::Unknown(_)) => {
            let message = clash.message(&|e| ctx.say(e));
            Some(Diagnosis::new("DIMENSION_CLASH", message.clone(), message))
        }
        _ => None,
    }
}

/// The missing factor in words: `a length is missing below`.
fn lacking(missing: &Dimension) -> String {
    let mut words = Vec::new();
    for (name, k) in [
        ("mass", &missing.mass),
        ("length", &missing.length),
        ("time", &missing.time),
    ] {
        if !num_traits::Zero::is_zero(k) {
            let times = k.abs();
            let power = if times == ratio(1, 1) {
                String::new()
            } else {
                format!("^{times}")
            };
            let place = if k.is_positive() { "above" } else { "below" };
            words.push(format!("a factor {name}{power} is missing {place}"));
        }
    }
    words.join(", ")
}

/// Symbols that are too many or too few.
fn symbols(ctx: &Context, expected: &Expr, answer: &Expr) -> Vec<Diagnosis> {
    let (mine, theirs) = (answer.symbols(), expected.symbols());
    let mut found = Vec::new();
    let list = |names: &[&Symbol]| {
        names
            .iter()
            .map(|n| ctx.say(&Expr::symbol(n)))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let extra: Vec<&Symbol> = mine.difference(&theirs).collect();
    if !extra.is_empty() {
        let words = format!("the value does not depend on {}", list(&extra));
        found.push(Diagnosis::new("SYMBOLS_EXTRA", words.clone(), words));
    }
    let missing: Vec<&Symbol> = theirs.difference(&mine).collect();
    if !missing.is_empty() {
        let words = format!("the value depends on {} too", list(&missing));
        found.push(Diagnosis::new("SYMBOLS_MISSING", words.clone(), words));
    }
    found
}
