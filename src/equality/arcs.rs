//! Identities the normal form cannot see by itself: sums of arcs or logarithms, hyperbolic functions, powers with symbols above.
//!
//! Arcs: where sin D = 0 and cos D = 1 hold identically, D is a whole number of turns everywhere; where in addition the
//! ranges of its arcs and angles keep D within less than a turn of zero, D is zero. Hyperbolic functions and powers of
//! something positive are written with the exponential function, whose laws the normal form knows. Logarithms: where they all
//! have values, k ln u + l ln v is zero if and only if uᵏ vˡ is one.

use super::proof::{Proof, compare};
use super::{Assumption, Ground};
use crate::algebra::{Sign, sign};
use crate::domain::{Domains, Sample, roles, samples};
use crate::expr::number::to_f64;
use crate::expr::{Expr, Function, Node, Point, Rational};
use crate::interval::{Interval, Outcome, evaluate};

/// What is left to try when the normal forms differ and a function occurs whose laws they do not know.
pub(super) fn prove(a: &Expr, b: &Expr, domains: &Domains) -> Option<Proof> {
    let difference = a - b;
    if has_arc(&difference) {
        let [x, y] = [a, b].map(unwound);
        if (&x, &y) != (a, b)
            && let proof @ Proof::Equal(..) = compare(&x, &y, domains)
        {
            return Some(proof);
        }
        return whole_turns(&without_shared(&difference), domains)
            .or_else(|| with_like_arcs(a, b, domains));
    }
    if let Some(proof) = one_logarithm(&without_shared(&difference), domains) {
        return Some(proof);
    }
    let (x, y) = (exponentials(a, domains), exponentials(b, domains));
    if x == *a && y == *b {
        return None;
    }
    Some(compare(&x, &y, domains)).filter(|proof| matches!(proof, Proof::Equal(..)))
}

/// Most arcs that are held against each other.
const MOST_ARCS: usize = 4;
/// Highest power of what stands under a logarithm.
const HIGHEST: i64 = 12;

/// Whether a sum of logarithms with fixed factors is zero because the product of what they are of is one.
fn one_logarithm(difference: &Expr, domains: &Domains) -> Option<Proof> {
    let Node::Sum(terms) = difference.node() else {
        return None;
    };
    let log = |term: &Expr| {
        let (k, atom) = term.split_number();
        match atom.node() {
            Node::Call(Function::Ln, under) => Some((k, under.clone())),
            _ => None,
        }
    };
    let logs: Vec<(Rational, Expr)> = terms.iter().map(log).collect::<Option<_>>()?;
    let common = Rational::from(common_denominator(&logs));
    let power = |(k, under): &(Rational, Expr)| {
        let k = (k * &common).numer().as_i64()?;
        (k.abs() <= HIGHEST).then(|| under.powi(k))
    };
    let product = Expr::product(logs.iter().map(power).collect::<Option<Vec<_>>>()?);
    match compare(&product, &Expr::one(), domains) {
        Proof::Equal(assumed, _) => Some(Proof::Equal(assumed, Ground::Logarithms)),
        _ => None,
    }
}

/// The least common multiple of the denominators of factors.
fn common_denominator(parts: &[(Rational, Expr)]) -> crate::expr::Int {
    let denominators = parts.iter().map(|(k, _)| k.denom().clone());
    denominators.fold(1.into(), num_integer::lcm)
}

/// A sum without the factors that all its terms share: where the rest is zero the sum is.
fn without_shared(e: &Expr) -> Expr {
    let Node::Sum(terms) = e.node() else {
        return e.clone();
    };
    fn factors(term: &Expr) -> Vec<Expr> {
        match term.node() {
            Node::Product(parts) => parts.iter().flat_map(factors).collect(),
            Node::Power(base, k) if k.is_integer() => {
                let parts = factors(base);
                parts.iter().map(|part| part.power(k.clone())).collect()
            }
            _ => vec![term.clone()],
        }
    }
    let terms: Vec<Vec<Expr>> = terms.iter().map(factors).collect();
    let is_pi = |e: &Expr| e.as_symbol().is_some_and(|name| &**name == "pi");
    let mut shared = terms[0].clone();
    shared.retain(|factor| {
        let free = factor.as_number().is_none() && !is_pi(factor) && !has_arc(factor);
        free && terms.iter().all(|term| term.contains(factor))
    });
    // A sum that was subtracted comes apart, so that a | b and b | a leave the same.
    let rest = |mut term: Vec<Expr>| {
        term.retain(|factor| !shared.contains(factor));
        if let [k, sum] = term.as_slice()
            && let (Some(_), Node::Sum(parts)) = (k.as_number(), sum.node())
        {
            return parts.iter().map(|part| k * part).collect();
        }
        vec![Expr::product(term)]
    };
    Expr::sum(terms.into_iter().flat_map(rest).collect::<Vec<_>>())
}

fn is_arc(e: &Expr) -> bool {
    use Function::{Acos, Asin, Atan};
    matches!(e.node(), Node::Call(Asin | Acos | Atan, _))
}

fn has_arc(e: &Expr) -> bool {
    e.parts().any(is_arc)
}

/// Whether formulas are the same with one arc for those that are alike: atan(1/a) is π/2 − atan a.
fn with_like_arcs(a: &Expr, b: &Expr, domains: &Domains) -> Option<Proof> {
    let mut arcs: Vec<&Expr> = Vec::new();
    for part in a.parts().chain(b.parts()).filter(|part| is_arc(part)) {
        if !arcs.contains(&part) {
            arcs.push(part);
        }
    }
    if arcs.len() > MOST_ARCS {
        return None;
    }
    let at = samples(&roles(&[a, b]), domains, 2).pop()?;
    let (mut same, mut assumed) = (Vec::new(), Vec::new());
    for (i, arc) in arcs.iter().enumerate() {
        let mut known = arcs[..i].iter();
        if let Some((other, more)) = known.find_map(|known| alike(arc, known, domains, &at)) {
            same.push((*arc, other));
            assumed.extend(more);
        }
    }
    if same.is_empty() {
        return None;
    }
    let put = |e: &Expr| {
        let same = same.iter();
        same.fold(e.clone(), |e, (arc, other)| e.replace(arc, other))
    };
    match compare(&put(a), &put(b), domains) {
        Proof::Equal(more, _) => Some(Proof::Equal([assumed, more].concat(), Ground::Turns)),
        _ => None,
    }
}

/// An arc by another one, of either sign and with as many quarters of a turn as they differ by at a point; and what was taken
/// for granted.
fn alike(
    arc: &Expr,
    known: &Expr,
    domains: &Domains,
    at: &Sample,
) -> Option<(Expr, Vec<Assumption>)> {
    let value = |e: &Expr| match evaluate::<Interval>(e, &at.point(true)) {
        Outcome::Value(value) => Some((value.low + value.high) / 2.0),
        _ => None,
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    [1, -1].into_iter().find_map(|sign| {
        let other = Expr::from(sign) * known;
        let quarters = (value(arc)? - value(&other)?) / quarter;
        let whole = [-2, -1, 0, 1, 2]
            .into_iter()
            .find(|k| (quarters - f64::from(*k)).abs() < 1e-9)?;
        let turn = Expr::symbol("pi") * Expr::ratio(whole.into(), 2);
        match whole_turns(&Expr::sum([arc.clone(), -&other, -&turn]), domains)? {
            Proof::Equal(assumed, _) => Some((other + turn, assumed)),
            _ => None,
        }
    })
}

/// Whether a difference is zero because it is a whole number of turns and less than one.
fn whole_turns(difference: &Expr, domains: &Domains) -> Option<Proof> {
    let parts: Option<Vec<(Rational, Expr)>> = difference.terms().iter().map(coefficient).collect();
    let parts = parts?;
    let common = Rational::from(common_denominator(&parts));
    let (mut low, mut high) = (0.0, 0.0);
    for (k, atom) in &parts {
        let times = to_f64(&(k * &common));
        let [from, to] = range(atom, domains)?;
        let (p, q) = (times * from, times * to);
        low += p.min(q);
        high += p.max(q);
    }
    // Ranges are open or touched at single points; the margin is far above the rounding of a few sums.
    let turn = 2.0 * std::f64::consts::PI * (1.0 - 1e-9);
    if low <= -turn || high >= turn {
        return None;
    }
    let d = &Expr::from(common) * difference;
    let mut assumed = Vec::new();
    for (value, there) in [(d.sin(), Expr::zero()), (d.cos(), Expr::one())] {
        let Proof::Equal(more, _) = compare(&value, &there, domains) else {
            return None;
        };
        for assumption in more {
            if !assumed.contains(&assumption) {
                assumed.push(assumption);
            }
        }
    }
    Some(Proof::Equal(assumed, Ground::Turns))
}

/// Arcs of functions of numbers, without both: asin(sin 10) is 3π − 10.
fn unwound(e: &Expr) -> Expr {
    use Function::{Acos, Asin, Atan, Cos, Sin, Tan};
    let e = e.map_parts(unwound);
    let Node::Call(arc, inside) = e.node() else {
        return e;
    };
    let Node::Call(function, angle) = inside.node() else {
        return e;
    };
    let pi = Expr::pi();
    let turned = match (arc, function) {
        (Asin, Sin) | (Atan, Tan) => angle / &pi + Expr::ratio(1, 2),
        (Acos, Cos) => angle / &pi,
        _ => return e,
    };
    let Outcome::Value(turns) = evaluate::<Interval>(&turned, &Point::default()) else {
        return e;
    };
    let half = turns.low.floor();
    if half != turns.high.floor() || half.abs() > 1e9 || !angle.is_constant() {
        return e;
    }
    let half = half as i64;
    let rest = angle - &(&pi * &Expr::from(half));
    match (arc, half % 2 == 0) {
        (Atan, _) | (_, true) => rest,
        (Asin, false) => -rest,
        (_, false) => pi - rest,
    }
}

/// A term as a number times the rest.
fn coefficient(term: &Expr) -> Option<(Rational, Expr)> {
    let (k, atom) = term.split_number();
    let is_atom = !matches!(atom.node(), Node::Number(_) | Node::Product(_));
    is_atom.then_some((k, atom))
}

/// Bounds of an arc, of π, or of an angle that lives between two ends.
fn range(atom: &Expr, domains: &Domains) -> Option<[f64; 2]> {
    use std::f64::consts::{FRAC_PI_2, PI};
    if atom.is_constant()
        && let Outcome::Value(value) = evaluate::<Interval>(atom, &Point::default())
    {
        return Some([value.low, value.high]);
    }
    match atom.node() {
        Node::Call(function, argument) => {
            let sign = sign(argument, domains);
            let positive = matches!(sign, Some(Sign::Positive | Sign::NotNegative | Sign::Zero));
            let negative = matches!(sign, Some(Sign::Negative | Sign::NotPositive | Sign::Zero));
            let low = if positive { 0.0 } else { -FRAC_PI_2 };
            let high = if negative { 0.0 } else { FRAC_PI_2 };
            match function {
                Function::Asin | Function::Atan => Some([low, high]),
                Function::Acos => Some([FRAC_PI_2 - high, FRAC_PI_2 - low]),
                _ => None,
            }
        }
        Node::Symbol(name) if &**name == "pi" => Some([PI, PI]),
        Node::Symbol(name) => {
            let [low, high] = domains.symbols.get(name)?.bounds();
            Some([low?, high?])
        }
        _ => None,
    }
}

/// Hyperbolic functions, and powers of something positive with a symbol above, by the exponential function.
fn exponentials(e: &Expr, domains: &Domains) -> Expr {
    let e = e.map_parts(|part| exponentials(part, domains));
    let exp = |x: Expr| Expr::call(Function::Exp, x);
    match e.node() {
        Node::Call(function @ (Function::Sinh | Function::Cosh | Function::Tanh), x) => {
            let (up, down) = (exp(x.clone()), exp(-x));
            match function {
                Function::Sinh => (up - down) * Expr::ratio(1, 2),
                Function::Cosh => (up + down) * Expr::ratio(1, 2),
                _ => (&up - &down) / (up + down),
            }
        }
        Node::Call(Function::Ln, x) => match x.node() {
            Node::Call(Function::Exp, inner) => inner.clone(),
            _ => e,
        },
        Node::Power(base, k) if k.as_number().is_none() => match sign(base, domains) {
            Some(Sign::Positive) => {
                let ln = match base.node() {
                    Node::Call(Function::Exp, inner) => inner.clone(),
                    _ => Expr::call(Function::Ln, base.clone()),
                };
                exp(k * &ln)
            }
            _ => e,
        },
        _ => e,
    }
}
