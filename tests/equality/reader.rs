//! A plain reader for the tables of this folder, apart from the one of the crate, so that the two cannot share a fault:
//! `+ - * / ^ ( )`, whole numbers and decimals, names, `sqrt`, and the functions by name.

use carom::domain::{Domain, Domains, Limit};
use carom::expr::{Expr, Function, Int, Rational};

/// Reads one formula; the tables hold no wrong ones.
pub fn formula(text: &str) -> Expr {
    let mut rest = text.trim();
    let e = sum(&mut rest);
    assert!(rest.is_empty(), "unread: {rest} of {text}");
    e
}

fn eat(rest: &mut &str, sign: char) -> bool {
    *rest = rest.trim_start();
    match rest.strip_prefix(sign) {
        Some(after) => {
            *rest = after.trim_start();
            true
        }
        None => false,
    }
}

fn sum(rest: &mut &str) -> Expr {
    let mut total = if eat(rest, '-') {
        -product(rest)
    } else {
        product(rest)
    };
    loop {
        if eat(rest, '+') {
            total = total + product(rest);
        } else if eat(rest, '-') {
            total = total - product(rest);
        } else {
            return total;
        }
    }
}

fn product(rest: &mut &str) -> Expr {
    let mut total = power(rest);
    loop {
        if eat(rest, '*') {
            total = total * power(rest);
        } else if eat(rest, '/') {
            total = total / power(rest);
        } else {
            return total;
        }
    }
}

fn power(rest: &mut &str) -> Expr {
    let base = atom(rest);
    if eat(rest, '^') {
        let exponent = if eat(rest, '-') {
            -power(rest)
        } else {
            power(rest)
        };
        return base.power(exponent);
    }
    base
}

fn atom(rest: &mut &str) -> Expr {
    if eat(rest, '(') {
        let e = sum(rest);
        assert!(eat(rest, ')'), "a bracket to close before {rest}");
        return e;
    }
    let end = rest
        .find(|c: char| !c.is_alphanumeric() && c != '_' && c != '.')
        .unwrap_or(rest.len());
    let (word, after) = rest.split_at(end);
    assert!(!word.is_empty(), "a number or a name before {rest}");
    *rest = after.trim_start();
    if word.starts_with(|c: char| c.is_ascii_digit()) {
        return Expr::from(number(word));
    }
    let function = Function::ALL.into_iter().find(|f| f.name() == word);
    if rest.starts_with('(') && (function.is_some() || word == "sqrt") {
        let argument = atom(rest);
        return match function {
            Some(f) => Expr::call(f, argument),
            None => argument.sqrt(),
        };
    }
    Expr::symbol(word)
}

fn number(word: &str) -> Rational {
    let (whole, part) = word.split_once('.').unwrap_or((word, ""));
    let digits: num_bigint::BigInt = format!("{whole}{part}").parse().expect("digits");
    Rational::new(Int::from(digits), Int::from(10).pow(part.len() as u32))
}

/// Reads domains such as `x real; e 0..1; theta 0pi..1pi; n unit m`.
pub fn domains(text: &str) -> Domains {
    let mut out = Domains::default();
    for entry in text
        .split(';')
        .map(str::trim)
        .filter(|t| !t.is_empty() && *t != "-")
    {
        let words: Vec<&str> = entry.split_whitespace().collect();
        let [name, kind, other @ ..] = words.as_slice() else {
            panic!("name and domain: {entry}")
        };
        let domain = match *kind {
            "real" => Domain::real(),
            "positive" => Domain::positive(),
            "nonnegative" => Domain::nonnegative(),
            "unit" => {
                out.unit_vectors.push([(*name).into(), other[0].into()]);
                continue;
            }
            range => {
                let (low, high) = range.split_once("..").expect("low..high");
                Domain {
                    low: Some(limit(low)),
                    high: Some(limit(high)),
                }
            }
        };
        out.symbols.insert((*name).into(), domain);
    }
    out
}

fn limit(text: &str) -> Limit {
    let of_pi = text.ends_with("pi");
    let text = text.trim_end_matches("pi");
    let (sign, text) = text.strip_prefix('-').map_or((1, text), |t| (-1, t));
    let (n, d) = text.split_once('/').unwrap_or((text, "1"));
    let value = number(n) / number(d) * Rational::from(Int::from(sign));
    Limit {
        value,
        of_pi,
        open: of_pi,
    }
}
