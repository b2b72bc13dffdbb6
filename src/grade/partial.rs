//! How much of a wrong answer is right, found by trying: sign, factor, dimension, special cases, exchanged symbols.
//!
//! Every try is first weighed at a few points in certified doubles and proved only where these agree, so a wrong answer
//! costs little and a diagnosis is never a guess.

mod trial;

use num_traits::Signed;

use super::context::{Context, is_short, same_number};
use super::{Diagnosis, fraction, number};
use crate::algebra::Field;
use crate::dimension::{self, Clash, Dimension};
use crate::equality::identical as proved;
use crate::expr::{Expr, Function, Node, Rational, Symbol, ratio};
use std::collections::BTreeSet;
use trial::Trial;

/// Points weighed before a proof.
const GLANCES: usize = 4;

/// Most parts of a pair times its symbols: more is too long to look for what is wrong.
const MOST_LOOKS: usize = 60_000;

/// The note of a grade whose first diagnosis has this code.
pub(crate) fn note(code: &str) -> &'static str {
    let code = match code {
        "DIMENSION_CLASH" => "DIMENSION",
        "DOUBLE" => "HALF",
        "SYMBOLS_EXTRA" | "SYMBOLS_MISSING" => "SYMBOLS",
        "SIGN_X" | "SIGN_Y" | "SIGN_Z" => "SIGN_COMPONENT",
        other => other,
    };
    let own = |note: &&str| note.strip_prefix("DIFF_") == Some(code);
    NOTES.split(' ').find(own).unwrap_or("DIFF")
}

const NOTES: &str = "DIFF_DIMENSION DIFF_KIND DIFF_SIGN DIFF_FACTOR DIFF_FACTOR_SYMBOL DIFF_MAGNITUDE DIFF_RECIPROCAL \
    DIFF_SIN_COS DIFF_HALF DIFF_EXCHANGED DIFF_SYMBOL_SIGN DIFF_SPECIAL_CASE DIFF_SMALL_ANGLE DIFF_POWER \
    DIFF_SYMBOLS DIFF_ROUNDED DIFF_DEGREES DIFF_TEN DIFF_SIGN_COMPONENT DIFF_SWAPPED";

/// What is wrong with an expression that is known to differ.
pub(crate) fn diagnose(ctx: &Context, expected: &Expr, answer: &Expr) -> Vec<Diagnosis> {
    // A symbol is tried at a time, at the cost of a look at the whole.
    let size = expected.size() + answer.size();
    let names = expected.symbols().len() + answer.symbols().len();
    if size > 2_000 || size * names > MOST_LOOKS || !is_short(expected, answer) {
        return Vec::new();
    }
    let mut found = Vec::new();
    if expected.is_constant() && answer.is_constant() {
        return numbers(expected, answer);
    }
    if turned_in_degrees(answer).is_some_and(|turned| proved(expected, &turned, ctx.domains())) {
        return vec![in_degrees()];
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
        .or_else(|| trial.exponent(ctx))
        .or_else(|| trial.special(ctx))
        .or_else(|| found.is_empty().then(|| trial.small_angle())?)
        .or_else(|| trial.power())
        .or_else(|| trial.factor_of_symbols(ctx))
    {
        found.push(d);
    }
    found.extend(symbols(ctx, expected, answer));
    found
}

/// A formula whose numbers under sines, cosines and tangents count as degrees; nothing where there are none.
fn turned_in_degrees(e: &Expr) -> Option<Expr> {
    use Function::{Cos, Sin, Tan};
    let degree = &Expr::pi() * &Expr::ratio(1, 180);
    let turned = |part: &Expr| match part.node() {
        Node::Call(f @ (Cos | Sin | Tan), angle) if angle.as_number().is_some() => {
            Some((part.clone(), Expr::call(*f, angle * &degree)))
        }
        _ => None,
    };
    let all: Vec<(Expr, Expr)> = e.parts().filter_map(turned).collect();
    let replaced = |e: Expr, (old, new): &(Expr, Expr)| e.replace(old, new);
    (!all.is_empty()).then(|| all.iter().fold(e.clone(), replaced))
}

fn in_degrees() -> Diagnosis {
    let message = "right in degrees; without their sign a number counts as radians";
    Diagnosis::new("DEGREES", message, "in which unit is your angle?")
}

/// What is wrong with a number.
pub(crate) fn numbers(expected: &Expr, answer: &Expr) -> Vec<Diagnosis> {
    let mut found = Vec::new();
    let sign = |message: &str| Diagnosis::new("SIGN", message, "check the sign");
    if same_number(expected, &-answer) {
        return vec![sign("right up to the sign")];
    }
    let degree = &Expr::pi() * &Expr::ratio(1, 180);
    let near = |turned: &Expr, share: i64| {
        let [Some([low, high]), Some([least, most])] = [expected, turned].map(number::bounds)
        else {
            return false;
        };
        let room = (&high / &ratio(share, 1)).abs();
        least <= &high + &room && &low - &room <= most
    };
    // Only an angle is rounded in degrees.
    let share = if expected.is_arc() {
        1_000
    } else {
        1_000_000_000
    };
    let turned = turned_in_degrees(answer);
    if near(&(answer * &degree), share) || turned.is_some_and(|turned| near(&turned, 200)) {
        return vec![in_degrees()];
    }
    // An angle that is a fraction in degrees was rounded in degrees.
    let in_degrees = answer.is_arc().then(|| {
        let degrees = Expr::from(180);
        let expected = expected * &(&degrees / &Expr::pi());
        [expected, answer.replace(&Expr::pi(), &degrees)]
    });
    let [expected, answer] = match &in_degrees {
        Some([expected, answer]) => [expected, answer],
        None => [expected, answer],
    };
    let (Some(exact), Some(value)) = (number::bounds(expected), fraction(answer)) else {
        return found;
    };
    let digits = number::digits_shared(&value, &exact);
    let rounded = number::has_digits(&value, digits);
    if (2..100).contains(&digits) && (rounded || digits > 2) {
        let message = match rounded {
            true => format!("the expected value rounded to {digits} significant digits"),
            false => format!("right to about {digits} digits"),
        };
        let hint = "give the exact value rather than a rounded one";
        return vec![Diagnosis::new("ROUNDED", message, hint)];
    }
    let minus = -value.clone();
    let digits = number::digits_shared(&minus, &exact);
    if digits >= 2 {
        // As far as anything is compared.
        found.push(sign(match digits < number::MOST_DIGITS {
            true => "right up to the sign and rounding",
            false => "right up to the sign",
        }));
    }
    if let Some(e) = fraction(expected).filter(|e| *e != ratio(0, 1)) {
        let q = &value / &e;
        let tens = |k: i32| q.abs() == number::ten_to(k);
        if let Some(k) = (-12..=12).find(|k| *k != 0 && tens(*k)) {
            let message = format!("off by a factor 10^{k}");
            let hint = "check powers of ten and prefixes of units";
            found.push(Diagnosis::new("TEN", message, hint));
        } else if slip(&q) {
            let message = format!("right up to the factor {q}");
            let hint = "a constant factor is wrong";
            found.push(Diagnosis::new("FACTOR", message, hint));
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
    let domains = ctx.domains();
    let all = |f: &dyn Fn(usize) -> Expr| (0..3).all(|i| proved(&expected[i], &f(i), domains));
    if all(&|i| -&answer[i]) {
        let message = "right up to the sign of the whole vector";
        let hint = "check the direction of your vector";
        return vec![Diagnosis::new("SIGN", message, hint)];
    }
    let others = (0..3)
        .filter(|i| *i != first)
        .all(|i| proved(&expected[i], &answer[i], domains));
    if others && proved(&expected[first], &-&answer[first], domains) {
        let (code, axis) = [("SIGN_X", "x"), ("SIGN_Y", "y"), ("SIGN_Z", "z")][first];
        let message = format!("the {axis}-component has the wrong sign, the others are right");
        let hint = "one component has the wrong sign";
        return vec![Diagnosis::new(code, message, hint)];
    }
    if proved(&expected[0], &answer[1], domains) && proved(&expected[1], &answer[0], domains) {
        let message = "the components are exchanged";
        let hint = "check which component is which";
        return vec![Diagnosis::new("SWAPPED", message, hint)];
    }
    let mut found = Vec::new();
    let axis = ["x", "y", "z"][first];
    if others {
        let message = format!("only the {axis}-component is wrong");
        let hint = "one of the components is right";
        found.push(Diagnosis::new("COMPONENT", message, hint));
    }
    found.extend(diagnose(ctx, &expected[first], &answer[first]));
    // What is found of one of several wrong components is not said of the whole.
    for d in found.iter_mut().filter(|_| !others) {
        d.message = format!("along {axis}: {}", d.message);
    }
    found
}

/// A factor so common that a number off by it is told: any other would be met by chance too often.
fn slip(q: &Rational) -> bool {
    [(2, 1), (1, 2), (4, 1), (1, 4)]
        .iter()
        .any(|(n, d)| *q == ratio(*n, *d))
}

/// A fraction a slip of the pen would produce.
fn simple(q: &Rational) -> bool {
    q.numer().bits() <= 7 && q.denom().bits() <= 7
}

/// Dimensions that do not fit, inside the answer or against what is asked.
fn dimensions(ctx: &Context, expected: &Expr, answer: &Expr) -> Option<Diagnosis> {
    let known = |name: &str| ctx.dimension_of(name);
    let asked = match &ctx.key.question.dimension {
        Some(d) => d.clone(),
        None => dimension::of(expected, &known).ok().flatten()?,
    };
    match dimension::of(answer, &known) {
        Ok(Some(_)) if answer.is_constant() => {
            let message = "a formula is asked for, and the answer is a number";
            Some(Diagnosis::new("KIND", message, message))
        }
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
            let message = told(*clash, expected, answer, &asked).message(&|e| ctx.say(e));
            Some(Diagnosis::new("DIMENSION_CLASH", message.clone(), message))
        }
        _ => None,
    }
}

/// A clash of two terms with the one behind that is not as it should be: what stands in the expected formula too, or measures
/// what the whole does, is right.
fn told(clash: Clash, expected: &Expr, answer: &Expr, asked: &Dimension) -> Clash {
    let Clash::Sum {
        left,
        left_is,
        right,
        right_is,
    } = &clash
    else {
        return clash;
    };
    let bare = |e: &Expr| e.split_number().1;
    let stands = |e: &Expr| expected.parts().any(|part| bare(part) == bare(e));
    let is_whole = answer.terms().contains(left);
    let is_turned = match stands(left) == stands(right) {
        true => is_whole && right_is == asked,
        false => stands(right),
    };
    match is_turned {
        true => Clash::Sum {
            left: right.clone(),
            left_is: right_is.clone(),
            right: left.clone(),
            right_is: left_is.clone(),
        },
        false => clash,
    }
}

/// The missing factor in words: `a length is missing below`.
fn lacking(missing: &Dimension) -> String {
    let word = |(name, k): (&str, &Rational)| {
        let power = match k.abs() {
            times if times == ratio(1, 1) => String::new(),
            times => format!("^{times}"),
        };
        let place = if k.is_positive() { "above" } else { "below" };
        format!("a factor {name}{power} is missing {place}")
    };
    let words: Vec<String> = missing.powers().map(word).collect();
    words.join(", ")
}

/// Symbols that are too many or too few, where they do not cancel.
fn symbols(ctx: &Context, expected: &Expr, answer: &Expr) -> Vec<Diagnosis> {
    let (mut mine, mut theirs) = (answer.symbols(), expected.symbols());
    if mine != theirs {
        // How it would be written does not matter for that.
        let kept = |e: &Expr| {
            let (field, x) = Field::of(ctx.domains(), e).ok()?;
            Some(field.symbols(&x))
        };
        mine = kept(answer).unwrap_or(mine);
        theirs = kept(expected).unwrap_or(theirs);
    }
    let mut found = Vec::new();
    let list = |some: &BTreeSet<Symbol>, without: &BTreeSet<Symbol>| {
        let names = some.difference(without).map(|n| ctx.say(&Expr::symbol(n)));
        names.collect::<Vec<_>>().join(", ")
    };
    let (extra, missing) = (list(&mine, &theirs), list(&theirs, &mine));
    if !extra.is_empty() {
        let words = format!("the value does not depend on {extra}");
        found.push(Diagnosis::new("SYMBOLS_EXTRA", words.clone(), words));
    }
    if !missing.is_empty() {
        let words = format!("the value depends on {missing} too");
        found.push(Diagnosis::new("SYMBOLS_MISSING", words.clone(), words));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::{Symbols, read_expr};

    fn codes(expected: &str, answer: &str) -> Vec<&'static str> {
        let read = |text: &str| read_expr(text, &Symbols::strict()).expect("a formula");
        let found = numbers(&read(expected), &read(answer));
        found.iter().map(|d| d.code).collect()
    }

    #[test]
    fn an_angle_rounded_in_degrees_is_told_as_rounded() {
        assert_eq!(codes("atan(4/3)", "53.13*pi/180"), ["ROUNDED"]);
        assert_eq!(codes("atan(4/3)", "-53.13*pi/180"), ["SIGN"]);
        assert_eq!(codes("pi/3", "-pi/3"), ["SIGN"]);
        assert!(codes("atan(4/3)", "37*pi/180").is_empty());
    }

    #[test]
    fn numbers_under_a_cosine_may_be_meant_in_degrees() {
        assert_eq!(codes("10*cos(pi/6)", "10*cos(30)"), ["DEGREES"]);
        assert_eq!(codes("-8.66", "-10*cos(30)"), ["DEGREES"]);
        assert!(codes("8.66", "10*cos(31)").is_empty());
        let read = |text: &str| read_expr(text, &Symbols::open()).expect("a formula");
        let turned = turned_in_degrees(&read("v*cos(60)")).expect("a number under a cosine");
        assert_eq!(turned, read("v*cos(pi/3)"));
        assert_eq!(turned_in_degrees(&read("v*cos(theta)")), None);
    }
}
