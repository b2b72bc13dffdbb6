//! Relations whose sides are the same one-to-one function of something: what stands inside compares as they do.
//!
//! `ln a = ln b` is `a = b` where both have logarithms, `a³ < b³` is `a < b`, `a = arctan b` is `tan a = b` for an angle
//! between −π/2 and π/2. What the new relation needs beside is told, or, where it may not be told, the relation is kept.

use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::{Normal, sign_of};
use crate::algebra::Sign;
use crate::domain::{Domains, Limit};
use crate::expr::angle::angle as combination;
use crate::expr::number::from_f64;
use crate::expr::{Expr, Function, Int, Node, Rational, Symbol, ratio};
use crate::formula::{Relation, write_plain};
use crate::interval::{Interval, Outcome, evaluate};

/// A relation without the function, and what has to hold beside for the old one to have a value.
pub(super) struct Undone {
    pub normal: Normal,
    pub given: Vec<String>,
}

impl Normal {
    /// The relation of another difference, given what is told beside.
    fn undone(&self, difference: Expr, given: Vec<String>) -> Undone {
        let normal = self.of(difference);
        Undone { normal, given }
    }
}

/// A way to undo functions.
pub(super) type Step = fn(&Normal, &Domains) -> Option<Undone>;

/// The ways, in the order in which they are tried: each works on what the one before leaves.
pub(super) const STEPS: [Step; 5] = [logarithms, arcs, turns, powers, exponents];

/// Whether a formula is positive wherever it has a value.
fn is_positive(e: &Expr, domains: &Domains) -> bool {
    match e.node() {
        Node::Product(parts) => parts.iter().all(|p| is_positive(p, domains)),
        Node::Power(base, _) if is_positive(base, domains) => true,
        Node::Call(Function::Exp, _) => true,
        _ => sign_of(e, domains) == Some(Sign::Positive),
    }
}

fn is_not_negative(e: &Expr, domains: &Domains) -> bool {
    sign_of(e, domains).is_some_and(Sign::is_not_negative)
}

/// The two sides of `T₁ + T₂ rel 0` with two terms, turned so that neither is negative where `T₁` has a sign.
fn two_sides(n: &Normal, domains: &Domains) -> Option<[Expr; 2]> {
    let [one, two] = n.difference.terms() else {
        return None;
    };
    let first = sign_of(one, domains).or_else(|| sign_of(two, domains).map(Sign::flip));
    Some(match first.is_some_and(|s| !s.is_not_negative()) {
        true => [two.clone(), -one],
        false => [one.clone(), -two],
    })
}

/// What stands inside has to be positive, told in words.
fn has_to_be_positive(e: &Expr) -> String {
    format!("{} > 0", write_plain(e))
}

/// The terms of a sum without the one logarithm of a number above 1 that they are divided by, as in ln x/ln 2 − 3.
fn without_base(terms: &[Expr]) -> Vec<Expr> {
    let base = |f: &Expr| match f.node() {
        Node::Power(ln, k) if *k == -Expr::one() => match ln.node() {
            Node::Call(Function::Ln, c) => (c.as_number()? > &Rational::one()).then(|| ln.clone()),
            _ => None,
        },
        _ => None,
    };
    let Some(ln) = terms.iter().flat_map(Expr::factors).find_map(base) else {
        return terms.to_vec();
    };
    let times = |term: &Expr| {
        let left = |f: &&Expr| base(f).as_ref() != Some(&ln);
        let rest: Vec<Expr> = term.factors().iter().filter(left).cloned().collect();
        match rest.len() < term.factors().len() {
            true => Expr::product(rest),
            false => term * &ln,
        }
    };
    terms.iter().map(times).collect()
}

/// `Σ k ln u + W` has the sign of `Π u^k − exp(−W)` with whole k, where every u is positive.
pub(super) fn logarithms(n: &Normal, domains: &Domains) -> Option<Undone> {
    let (mut logs, mut rest) = (Vec::new(), Vec::new());
    for term in without_base(n.difference.terms()) {
        let (k, plain) = term.split_number();
        match plain.node() {
            Node::Call(Function::Ln, inside) => logs.push((k, inside.clone())),
            _ => rest.push(term),
        }
    }
    let below = logs.iter().fold(Int::one(), |l, (k, _)| l.lcm(k.denom()));
    let above = logs.iter().fold(Int::zero(), |g, (k, _)| g.gcd(k.numer()));
    // Without logarithms, and where each has the factor 0, there is nothing to undo.
    if above.is_zero() {
        return None;
    }
    let scale = Rational::new(below, above);
    let open = logs.iter().filter(|(_, u)| !is_positive(u, domains));
    let open: Vec<&(Rational, Expr)> = open.collect();
    // The last of the powers is positive where the product is, which is equal to something positive or above it.
    let implied = |(k, _): &(Rational, Expr)| {
        let above = k.is_negative() && matches!(n.relation, Relation::Less | Relation::LessEqual);
        (k * &scale).numer().is_odd() && (n.relation == Relation::Equal || above)
    };
    let given: Vec<String> = match open.as_slice() {
        [one] if implied(one) => Vec::new(),
        _ => open.iter().map(|(_, u)| has_to_be_positive(u)).collect(),
    };
    let side = |positive: bool| {
        let mine = logs.iter().filter(|(k, _)| k.is_positive() == positive);
        Expr::product(mine.map(|(k, u)| u.power(Expr::from((k * &scale).abs()))))
    };
    let rest = Expr::sum(rest) * Expr::from(-scale.clone());
    let right = match rest.is_zero() {
        true => side(false),
        false => side(false) * Expr::call(Function::Exp, rest),
    };
    Some(n.undone(side(true) - right, given))
}

/// A call of one of these functions that a relation is linear in, with its argument: `k f(u) + W`, given as the call, the
/// function, u, k and −W/k.
pub(super) fn called(
    n: &Normal,
    functions: &[Function],
) -> Option<(Expr, Function, Expr, Rational, Expr)> {
    let call = |part: &Expr| match part.node() {
        Node::Call(function, inside) if functions.contains(function) => {
            Some((part.clone(), *function, inside.clone()))
        }
        _ => None,
    };
    let (call, function, inside) = n.difference.parts().find_map(call)?;
    let letter: Symbol = write_plain(&call).into();
    let linear = n.difference.replace(&call, &Expr::symbol(&letter));
    let k = linear.derivative(&letter);
    let k = k.as_number().filter(|k| !k.is_zero())?.clone();
    let rest = linear.put(&letter, &Expr::zero());
    let other = rest * Expr::from(-k.recip());
    Some((call, function, inside, k, other))
}

/// An inequality with one sine, cosine or tangent of an angle on whose domain it only grows or only falls, as one of the
/// angle: `tan θ < 1` is `θ < arctan 1`; or with bars, `sin θ > 1/2` as `|θ − π/2| < π/3`.
pub(super) fn turns(n: &Normal, domains: &Domains) -> Option<Undone> {
    use Function::{Acos, Asin, Atan, Cos, Sin, Tan};
    if !matches!(n.relation, Relation::Less | Relation::LessEqual) {
        return None;
    }
    let (_, function, angle, k, value) = called(n, &[Sin, Cos, Tan])?;
    let [(from, at_from), (to, at_to)] = ends(&angle, domains)?;
    let [least, most] = range(function == Cos);
    let open = function == Tan;
    let monotone = (to < most || to == most && !(open && at_to))
        && (from > least || from == least && !(open && at_from));
    let reached = open || is_not_negative(&(Expr::one() - value.powi(2)), domains);
    // Over a whole turn a cosine falls on both sides of zero, and a sine on both sides of a right angle.
    let [middle, about] = match function {
        Cos => [ratio(0, 1), ratio(1, 1)],
        _ => [ratio(1, 2), ratio(1, 1)],
    };
    let even = !open && from >= &middle - &about && to <= &middle + &about;
    let (arc, k, angle) = match function {
        _ if !monotone => {
            let aside = angle - Expr::pi() * Expr::from(middle);
            (Acos, -k, Expr::call(Function::Abs, aside))
        }
        Sin => (Asin, k, angle),
        Cos => (Acos, -k, angle),
        _ => (Atan, k, angle),
    };
    ((monotone || even) && reached).then(|| {
        let difference = Expr::from(k) * (angle - Expr::call(arc, value));
        n.undone(difference, Vec::new())
    })
}

/// The same relation without an arc: `k f⁻¹(u) + W` has the sign of k (u − f(w)) with w = −W/k, where w is an angle that
/// the arc can be; of an arccosine, the other sign. At an end the tangent has no value, and the relation must not hold
/// there either. Two arcs of a kind compare as what stands inside.
pub(super) fn arcs(n: &Normal, domains: &Domains) -> Option<Undone> {
    use Function::{Acos, Asin, Atan};
    let (arc, function, inside, k, angle) = called(n, &[Atan, Asin, Acos])?;
    let k = if function == Acos { -k } else { k };
    let other = match angle.node() {
        Node::Call(same, other) if *same == function => other.clone(),
        _ => {
            let [(from, at_from), (to, at_to)] = ends(&angle, domains)?;
            let [least, most] = range(function == Acos);
            let tangent = function == Atan;
            let inside_range = (to < most || to == most && !(tangent && at_to && k.is_positive()))
                && (from > least || from == least && !(tangent && at_from && k.is_negative()));
            if !inside_range {
                return None;
            }
            match function {
                Atan => angle.tan(),
                Asin => angle.sin(),
                _ => angle.cos(),
            }
        }
    };
    // An equation with an angle says itself that the arc has a value.
    let paired = matches!(angle.node(), Node::Call(same, _) if *same == function);
    let everywhere = function == Atan
        || n.relation == Relation::Equal && !paired
        || is_not_negative(&(Expr::one() - inside.powi(2)), domains);
    let given = match everywhere {
        true => Vec::new(),
        false => vec![format!("{} has a value", write_plain(&arc))],
    };
    Some(n.undone(Expr::from(k) * (inside - other), given))
}

/// Where the cosine of an angle, or its sine or tangent, only grows or only falls, in units of π.
fn range(cosine: bool) -> [Rational; 2] {
    match cosine {
        true => [ratio(0, 1), ratio(1, 1)],
        false => [ratio(-1, 2), ratio(1, 2)],
    }
}

/// The least and the greatest value of an angle in units of π, each with whether it is reached: of a number, or of one
/// symbol and a multiple of π.
fn ends(angle: &Expr, domains: &Domains) -> Option<[(Rational, bool); 2]> {
    let Some(read) = combination(angle).filter(|read| read.symbols.len() < 2) else {
        let Outcome::Value(value) = evaluate::<Interval>(angle, &Default::default()) else {
            return None;
        };
        // Wider than any rounding; a limit that is a multiple of π was read as such.
        let margin = 1e-9;
        let end = |x: f64| from_f64(x / std::f64::consts::PI);
        return Some([
            (end(value.low - margin)?, true),
            (end(value.high + margin)?, true),
        ]);
    };
    let Some((name, factor)) = read.symbols.first_key_value() else {
        return Some([(read.pi.clone(), true), (read.pi, true)]);
    };
    let all = domains.of(&[&Expr::symbol(name).sin()]);
    let domain = all.symbols.get(name)?;
    let end = |limit: &Limit| {
        let value = (limit.of_pi || limit.value.is_zero()).then(|| &limit.value * factor)?;
        Some((value + &read.pi, !limit.open))
    };
    let mut ends = [end(domain.low.as_ref()?)?, end(domain.high.as_ref()?)?];
    if factor.is_negative() {
        ends.reverse();
    }
    Some(ends)
}

/// `a^k rel b^k` with a rational k, where `a` and `b` are products of powers.
pub(super) fn powers(n: &Normal, domains: &Domains) -> Option<Undone> {
    let sides = two_sides(n, domains)?;
    let exponent = |f: &Expr| match f.node() {
        Node::Power(_, k) => k.as_number().cloned(),
        Node::Number(_) => Some(Rational::zero()),
        _ => Some(Rational::one()),
    };
    let mut common = Rational::zero();
    for factor in sides.iter().flat_map(Expr::factors) {
        let k = exponent(factor)?;
        common = Rational::new(
            (common.numer() * k.denom()).gcd(&(k.numer() * common.denom())),
            common.denom() * k.denom(),
        );
    }
    let root_of = |side: &Expr, power: &Rational| {
        let back = Expr::from(power.recip());
        Expr::product(side.factors().iter().map(|f| match f.node() {
            Node::Power(base, k) => base.power(k * &back),
            Node::Number(k) if k.is_negative() => -Expr::from(-k).power(back.clone()),
            _ => f.power(back.clone()),
        }))
    };
    let not_negative = |side: &Expr| is_not_negative(side, domains);
    let below_zero = |f: &Expr| f.as_number().is_some_and(Signed::is_negative);
    while common.numer().is_even()
        && !common.is_zero()
        && sides.iter().flat_map(Expr::factors).any(below_zero)
    {
        common *= ratio(1, 2);
    }
    // The square of what may be negative is that of its size.
    let is_even = common.numer().is_even();
    let root_of = |side: &Expr, power: &Rational| match root_of(side, power) {
        root if is_even && !not_negative(&root) => Expr::call(Function::Abs, root),
        root => root,
    };
    if common.is_zero() || common.is_one() {
        return None;
    }
    // A square root is never negative.
    let whole = |f: &Expr| exponent(f).is_some_and(|k| k.is_integer());
    let beside = |side: &Expr| {
        let parts = side.factors().iter().filter(|f| whole(f)).cloned();
        not_negative(&Expr::product(parts))
    };
    if common.denom().is_even() && !sides.iter().all(beside) {
        return None;
    }
    let roots = sides.iter().flat_map(Expr::factors).filter(|f| !whole(f));
    let open: Vec<(&Expr, Rational)> = roots
        .filter_map(|f| match f.node() {
            Node::Power(base, k) => Some((base, k.as_number()? / &common)),
            _ => None,
        })
        .filter(|(base, _)| !is_not_negative(base, domains))
        .collect();
    let given = match open.as_slice() {
        // The last of the powers is not negative where the product is not.
        [(_, k)] if n.relation == Relation::Equal && k.numer().is_odd() => Vec::new(),
        _ => open
            .iter()
            .map(|(base, _)| format!("{} >= 0", write_plain(base)))
            .collect(),
    };
    let [left, right] = sides.each_ref().map(|side| root_of(side, &common));
    Some(n.undone(left - right, given))
}

/// A bound on the square of what may have either sign: `x² < y` as `|x| < √y`.
pub(super) fn square(n: &Normal, domains: &Domains) -> Option<Undone> {
    let symbols = n.difference.symbols();
    symbols.iter().find_map(|name| {
        let letter = Symbol::from(format!("{name}^2"));
        let size = Expr::call(Function::Abs, Expr::symbol(name));
        let line = (n.difference).replace(&Expr::symbol(name).powi(2), &Expr::symbol(&letter));
        let slope = line.derivative(&letter);
        let bound = -line.put(&letter, &Expr::zero()) * slope.powi(-1);
        let linear = !line.symbols().contains(name) && !slope.symbols().contains(&letter);
        (linear && is_positive(&slope, domains) && is_not_negative(&bound, domains))
            .then(|| n.undone(size - bound.sqrt(), Vec::new()))
    })
}

/// `a rel b` with exponentials in them as `ln a rel ln b`.
pub(super) fn exponents(n: &Normal, domains: &Domains) -> Option<Undone> {
    let is_exponential = |part: &Expr| match part.node() {
        Node::Power(_, k) => k.as_number().is_none(),
        Node::Call(function, _) => *function == Function::Exp,
        _ => false,
    };
    if !n.difference.parts().any(is_exponential) {
        return None;
    }
    let sides = two_sides(n, domains)?;
    if !sides.iter().all(|side| is_positive(side, domains)) {
        return None;
    }
    let [a, b] = sides.map(|side| logarithm(&side, domains));
    Some(n.undone(a? - b?, Vec::new()))
}

/// The logarithm of a positive formula, factor by factor.
fn logarithm(e: &Expr, domains: &Domains) -> Option<Expr> {
    match e.node() {
        Node::Number(k) if k.is_one() => Some(Expr::zero()),
        Node::Product(parts) => {
            let parts: Option<Vec<Expr>> = parts.iter().map(|p| logarithm(p, domains)).collect();
            parts.map(Expr::sum)
        }
        Node::Call(Function::Exp, inside) => Some(inside.clone()),
        Node::Power(base, k) if is_positive(base, domains) => Some(k * logarithm(base, domains)?),
        _ => is_positive(e, domains).then(|| Expr::call(Function::Ln, e.clone())),
    }
}
