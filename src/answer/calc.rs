//! Exact calculation for stories: tidy forms, and signs on the domain.
//!
//! In: expressions and domains. Out: expressions a person would write, signs that are proved or said to be seen only, conditions
//! for a sign. It knows nothing of mechanics.

use num_integer::Integer;
use num_traits::Signed as _;

use super::Check;
pub use crate::algebra::tidy;
use crate::algebra::{self, Field, Sign};
use crate::domain::{Domains, Roles, Sample, at_ends, roles, samples, samples_until};
use crate::equality;
use crate::expr::number::is;
use crate::expr::{Expr, Function, Node, Point, Rational, Symbol, effort};
use crate::formula::{Sentence, digits};
use crate::interval::{Interval, Outcome, evaluate};

/// Points at which a sign that could not be proved is looked at.
const POINTS: usize = 24;

/// What is known of a sign.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Seen {
    /// Proved on the whole domain.
    Proved(Sign),
    /// Above zero at every point tried.
    Positive,
    /// Below zero at every point tried.
    Negative,
    /// Of both signs, or never seen.
    Mixed,
}

impl Seen {
    /// Above zero, proved or seen.
    pub fn is_positive(self) -> bool {
        matches!(self, Seen::Proved(Sign::Positive) | Seen::Positive)
    }

    /// Below zero, proved or seen.
    pub fn is_negative(self) -> bool {
        matches!(self, Seen::Proved(Sign::Negative) | Seen::Negative)
    }

    /// Whether it is proved to be nowhere below zero.
    pub fn is_not_negative(self) -> bool {
        matches!(self, Seen::Proved(sign) if sign.is_not_negative())
    }

    /// Whether it is above zero, or below, wherever it is not zero; `None` where that is not proved.
    pub fn side(self) -> Option<bool> {
        match self {
            Seen::Proved(Sign::Positive | Sign::NotNegative) => Some(true),
            Seen::Proved(Sign::Negative | Sign::NotPositive) => Some(false),
            _ => None,
        }
    }

    /// Whether it is proved.
    pub fn is_proved(self) -> bool {
        matches!(self, Seen::Proved(_))
    }
}

/// A check that rests on signs, with how they are known where `{how}` stands in its words.
pub fn by_signs(kind: &'static str, words: &str, proved: bool) -> Check {
    let how = if proved { "proved" } else { "seen at points" };
    Check::new(kind, words.replace("{how}", how), proved.then_some(true))
}

/// The same as the root of its square where it is positive and that is shorter, which opens nested roots.
pub fn shorter(e: &Expr, domains: &Domains) -> Expr {
    let Ok(square) = tidy(&e.powi(2), domains) else {
        return e.clone();
    };
    let Ok(root) = tidy(&square.sqrt(), domains) else {
        return e.clone();
    };
    let is_positive = matches!(sign(e, domains), Seen::Proved(Sign::Positive));
    if root.size() < e.size() && is_positive && is_zero(&(&root - e), domains) == Some(true) {
        root
    } else {
        e.clone()
    }
}

/// Whether a parameter stands under a root.
pub fn has_root(e: &Expr, p: &Symbol) -> bool {
    e.parts().any(|part| match part.node() {
        Node::Power(base, k) => {
            let is_whole = k.is_integer();
            !is_whole && base.mentions(p)
        }
        _ => false,
    })
}

/// The square of what is nowhere negative, where squaring frees a parameter of its roots.
pub fn square(e: &Expr, p: &Symbol, domains: &Domains) -> Option<Expr> {
    has_root(e, p).then_some(())?;
    let square = tidy(&e.powi(2), domains).ok()?;
    let is_free = !has_root(&square, p);
    let is_never_negative = || sign(e, domains).is_not_negative();
    (is_free && is_never_negative()).then_some(square)
}

/// Whether the expression is zero on the whole domain: yes by its normal form, no by a point at which it is not; `None`
/// where neither was found.
pub fn is_zero(e: &Expr, domains: &Domains) -> Option<bool> {
    if Field::of(domains, e).is_ok_and(|(field, x)| field.is_zero(&x)) {
        return Some(true);
    }
    if effort::spent() {
        return None;
    }
    let roles = roles(&[e]);
    let (domains, _) = domains.completed(&roles);
    let mut apart = false;
    samples_until(&roles, &domains, POINTS, |sample| {
        let value = evaluate::<Interval>(e, &sample.point(roles.radians));
        apart = matches!(value, Outcome::Value(v) if v.low > 0.0 || v.high < 0.0);
        apart
    });
    apart.then_some(false)
}

/// One point is looked at before a proof is tried for so many nodes of an expression: a short one is proved sooner.
const NODES: usize = 8;

/// The sign on the domain.
pub fn sign(e: &Expr, domains: &Domains) -> Seen {
    if soon_has_both_signs(e, domains) {
        return Seen::Mixed;
    }
    match shown(e, domains) {
        Some(sign) => Seen::Proved(sign),
        None => seen(e, domains),
    }
}

/// The sign on the domain where it is proved. What points would show, which takes many of them, is not looked at.
pub fn proved(e: &Expr, domains: &Domains) -> Option<Sign> {
    match soon_has_both_signs(e, domains) {
        true => None,
        false => shown(e, domains),
    }
}

/// The sign by proof.
fn shown(e: &Expr, domains: &Domains) -> Option<Sign> {
    let simple = algebra::sign(e, domains).or_else(|| constant(e));
    if simple.is_some() {
        return simple;
    }
    // A factor such as cos(π/36) − sin(π/18) has its sign by itself.
    if let Node::Product(factors) = e.node() {
        let is_fixed = |f: &Expr| f.is_constant() && f.as_number().is_none();
        let (fixed, rest): (Vec<Expr>, Vec<Expr>) = factors.iter().cloned().partition(is_fixed);
        let rest = Expr::product(rest);
        match constant(&Expr::product(fixed)) {
            Some(Sign::Positive) if rest != *e => return proved(&rest, domains),
            Some(Sign::Negative) => return proved(&-&rest, domains),
            _ => {}
        }
    }
    // It has its sign where it has it with either sign of what stands in bars.
    let (bars, inside) = in_bars(e, |_| true)?;
    let [one, other] = [inside.clone(), -inside].map(|side| {
        let open = e.replace(&bars, &side);
        proved(&open, &domains.given(&side, true))
    });
    match (one?, other?) {
        (a, b) if a == b => Some(a),
        (a, b) if [a, b].iter().all(|s| Seen::Proved(*s).is_not_negative()) => {
            Some(Sign::NotNegative)
        }
        _ => None,
    }
}

/// Most magnitudes that are taken with either sign: each doubles the work.
const MOST_BARS: usize = 4;

/// The first magnitude in an expression, and what stands in its bars, where that is of a kind; nothing where there are too many.
pub(super) fn in_bars(e: &Expr, is_wanted: impl Fn(&Expr) -> bool) -> Option<(Expr, Expr)> {
    let bars = e.parts().filter_map(|part| match part.node() {
        Node::Call(Function::Abs, x) if is_wanted(x) => Some((part, x)),
        _ => None,
    });
    let all: Vec<(&Expr, &Expr)> = bars.take(MOST_BARS + 1).collect();
    let (bars, inside) = *all.first()?;
    (all.len() <= MOST_BARS).then(|| (bars.clone(), inside.clone()))
}

/// Whether something is proved to be positive, or not negative where `closed`, on the whole domain, or nowhere.
pub fn keeps_to(e: &Expr, closed: bool, domains: &Domains) -> Option<bool> {
    match sign(e, domains) {
        Seen::Proved(Sign::Positive) => Some(true),
        Seen::Proved(s) if closed && s.is_not_negative() => Some(true),
        Seen::Proved(Sign::Negative) => Some(false),
        Seen::Proved(Sign::NotPositive | Sign::Zero) if !closed => Some(false),
        _ => None,
    }
}

/// The sign of a formula without symbols, such as cos(π/18) − 0.98: its enclosure proves it.
pub fn constant(e: &Expr) -> Option<Sign> {
    if !e.is_constant() {
        return None;
    }
    match evaluate::<Interval>(e, &Point::default()) {
        Outcome::Value(v) if v.low > 0.0 => Some(Sign::Positive),
        Outcome::Value(v) if v.high < 0.0 => Some(Sign::Negative),
        _ => None,
    }
}

/// The sign at points of the domain, by enclosures.
pub(super) fn seen(e: &Expr, domains: &Domains) -> Seen {
    let seen = match met_anywhere(e, domains) {
        (3.., 0) if !equality::falls_below_zero(e, domains) => Seen::Positive,
        (0, 3..) if !equality::falls_below_zero(&-e, domains) => Seen::Negative,
        _ => Seen::Mixed,
    };
    // What could not be looked at to the end is not seen.
    match effort::spent() {
        true => Seen::Mixed,
        false => seen,
    }
}

/// Whether values above and below zero are found in the domain, far out too.
pub fn has_both_signs(e: &Expr, domains: &Domains) -> bool {
    matches!(met_anywhere(e, domains), (1.., 1..))
}

/// The same near the usual values alone.
pub fn has_both_signs_near(e: &Expr, domains: &Domains) -> bool {
    matches!(met(e, domains, POINTS), (1.., 1..))
}

/// The same at so many points only as take less than a proof: where both signs are found there is none to be proved.
pub fn soon_has_both_signs(e: &Expr, domains: &Domains) -> bool {
    let most = match domains.relations.is_empty() {
        true => POINTS.min(e.size() / NODES),
        false if e.size() > NODES => POINTS,
        false => 0,
    };
    most > 0 && matches!(met(e, domains, most), (1.., 1..))
}

/// At how many points of the domain, of the first ones, a value is above zero and below, by enclosures, until both are met.
fn met(e: &Expr, domains: &Domains, most: usize) -> (usize, usize) {
    let roles = roles(&[e]);
    let (domains, _) = domains.completed(&roles);
    let (mut above, mut below, mut tried) = (0, 0, 0);
    if effort::spent() {
        return (above, below);
    }
    samples_until(&roles, &domains, POINTS, |sample| {
        match evaluate::<Interval>(e, &sample.point(roles.radians)) {
            Outcome::Value(v) if v.low > 0.0 => above += 1,
            Outcome::Value(v) if v.high < 0.0 => below += 1,
            _ => {}
        }
        tried += 1;
        tried == most || above > 0 && below > 0
    });
    (above, below)
}

/// The same at all of them, and far out where these agree: `v − 120` is above zero for a bullet.
fn met_anywhere(e: &Expr, domains: &Domains) -> (usize, usize) {
    let (mut above, mut below) = met(e, domains, POINTS);
    if (above > 0) == (below > 0) {
        return (above, below);
    }
    let roles = related_roles(e, domains);
    let (domains, _) = domains.completed(&roles);
    for sample in far_out(&roles, &domains) {
        match evaluate::<Interval>(e, &sample.point(roles.radians)) {
            Outcome::Value(v) if v.low > 0.0 => above += 1,
            Outcome::Value(v) if v.high < 0.0 => below += 1,
            _ => {}
        }
    }
    (above, below)
}

/// Points with one symbol far out, or near an end of its domain.
fn far_out(roles: &Roles, domains: &Domains) -> Vec<Sample> {
    let names = roles.symbols.keys();
    let names = names.filter(|name| !domains.is_component(name));
    let starts = samples(roles, domains, 1);
    let led = names.flat_map(|name| starts.iter().flat_map(|start| start.led_far(name, domains)));
    led.filter(|sample| domains.admits(sample)).collect()
}

/// The symbols of an expression and of all relations that bear upon them: only with these is a point known to lie in the domain.
fn related_roles(e: &Expr, domains: &Domains) -> Roles {
    let own = roles(&[e]).symbols.keys().cloned().collect();
    let bearing = domains.relations_of(&own);
    let excesses = bearing.iter().map(|r| &r.excess);
    roles(&[e].into_iter().chain(excesses).collect::<Vec<_>>())
}

/// A point of the domain at which a value is known to be above zero or below, or to be zero where that is looked for, and what it
/// is in words: within, at closed ends, or far out.
pub(super) fn point_where(e: &Expr, domains: &Domains, wanted: Sign) -> Option<(Sample, String)> {
    let roles = related_roles(e, domains);
    let (domains, _) = domains.completed(&roles);
    let within = samples(&roles, &domains, POINTS);
    let mut ends = at_ends(within.get(..2).unwrap_or_default(), &domains);
    ends.retain(|sample| domains.admits(sample));
    let far = far_out(&roles, &domains);
    let mut all = within.into_iter().chain(ends).chain(far);
    all.find_map(|sample| {
        let value = value_at(e, &sample, roles.radians, wanted)?;
        Some((sample, value))
    })
}

/// What a value is at a point, as a fraction or else rounded, where its sign is the one that is wanted.
fn value_at(e: &Expr, at: &Sample, radians: bool, wanted: Sign) -> Option<String> {
    const READABLE: usize = 12;
    let sign = match evaluate::<Interval>(e, &at.point(radians)) {
        Outcome::Value(v) if v.low > 0.0 => Some((Sign::Positive, v)),
        Outcome::Value(v) if v.high < 0.0 => Some((Sign::Negative, v)),
        _ => None,
    };
    let exact = e.evaluate(&at.fractions());
    match sign {
        Some((sign, v)) if sign == wanted => {
            let exact = exact.map(|n| n.to_string().replace('-', "−"));
            let short = exact.filter(|n| n.chars().count() <= READABLE);
            Some(short.unwrap_or_else(|| format!("about {}", digits(v.low / 2.0 + v.high / 2.0))))
        }
        Some(_) => None,
        None => exact.and_then(|n| (wanted == Sign::Zero && is(&n, 0, 1)).then(|| n.to_string())),
    }
}

/// A sum of quotients times those of their denominators that are known to be positive.
fn without_denominators(e: Expr, domains: &Domains) -> Expr {
    let Node::Sum(terms) = e.node() else {
        return e;
    };
    let mut below: Vec<Expr> = Vec::new();
    for term in terms {
        for factor in term.factors() {
            let Node::Power(base, k) = factor.node() else {
                continue;
            };
            let is_below = k.is_negative() && matches!(base.node(), Node::Sum(_));
            let power = base.power(-k);
            if is_below && !below.contains(&power) {
                below.push(power);
            }
        }
    }
    below.retain(|b| matches!(sign(b, domains), Seen::Proved(Sign::Positive)));
    if below.is_empty() {
        return e;
    }
    let whole = Expr::product(below.into_iter().chain([e.clone()]));
    tidy(&whole, domains).unwrap_or(e)
}

/// What decides the sign of an expression: factors known to be positive are left away. Gives the rest, such as a − h.
pub fn essential(e: &Expr, domains: &Domains) -> Expr {
    if effort::spent() {
        return e.clone();
    }
    let core = core(e, domains);
    let sides = by_sides(e, domains).filter(|sides| sides.size() < core.size());
    sides.unwrap_or(core)
}

/// The same in the form that calculation gives it.
fn core(e: &Expr, domains: &Domains) -> Expr {
    let tidied = tidy(e, domains).unwrap_or_else(|_| e.clone());
    let tidied = without_denominators(tidied, domains);
    let mut minus = false;
    let mut rest = Vec::new();
    for f in tidied.factors() {
        // An odd power of a quantity, and one over it, has its sign.
        let is_odd = |k: &Expr| {
            let k = k.as_number().filter(|k| k.is_integer());
            k.is_some_and(|k| k.numer().is_odd())
        };
        let f = match f.node() {
            Node::Power(base, k) if is_odd(k) => base,
            _ => f,
        };
        match sign(f, domains) {
            Seen::Proved(Sign::Positive) => {}
            Seen::Proved(Sign::Negative) => minus = !minus,
            Seen::Proved(Sign::Zero) => return Expr::zero(),
            _ => rest.push(f.clone()),
        }
    }
    let product = Expr::product(rest);
    let turned = if minus { -&product } else { product };
    tidy(&turned, domains).unwrap_or(turned)
}

/// What has the sign of a difference of two sides as they stand, each kept in its factors: `2 (M + m)² − m² (1 + e)²` is not
/// multiplied out.
fn by_sides(e: &Expr, domains: &Domains) -> Option<Expr> {
    let Node::Sum(terms) = e.node() else {
        return None;
    };
    let is_taken = |term: &&Expr| term.split_number().0.is_negative();
    let (taken, kept): (Vec<&Expr>, Vec<&Expr>) = terms.iter().partition(is_taken);
    let [kept, taken] = [kept, taken].map(|side| Expr::sum(side.into_iter().cloned()));
    let is_positive = |e: &Expr| matches!(sign(e, domains), Seen::Proved(Sign::Positive));
    let taken = -taken;
    is_positive(&taken).then_some(())?;
    let ratio = tidy(&(&kept / &taken), domains).ok()?;
    let is_below = |f: &&Expr| match f.node() {
        Node::Power(_, k) => k.is_negative(),
        _ => false,
    };
    let (number, rest) = ratio.split_number();
    let (below, above): (Vec<&Expr>, Vec<&Expr>) = rest.factors().iter().partition(is_below);
    let below = Expr::product(below.into_iter().map(|f| f.powi(-1)));
    is_positive(&below).then_some(())?;
    let above = Expr::product(above.into_iter().cloned());
    let [large, small] =
        [number.numer(), number.denom()].map(|n| Expr::from(Rational::from(n.clone())));
    Some(large * above - small * below)
}

/// `e ≥ 0` by what its sign hangs on, as people state it.
pub fn at_least_zero(e: &Expr, domains: &Domains) -> Sentence {
    beyond_zero(e, domains, false)
}

/// `e > 0` with what decides it alone.
pub fn above_zero(e: &Expr, domains: &Domains) -> Sentence {
    beyond_zero(e, domains, true)
}

/// `e > 0` where zero is excluded, else `e ≥ 0`.
pub fn beyond_zero(e: &Expr, domains: &Domains, open: bool) -> Sentence {
    let e = decisive(e, domains, open);
    match open {
        true => Sentence::positive(&e),
        false => Sentence::not_negative(&e),
    }
}

/// What decides whether something is above zero, or not below it, alone.
pub(super) fn decisive(e: &Expr, domains: &Domains, open: bool) -> Expr {
    let e = essential(e, domains);
    // A root that has a value is positive where what stands under it is; so is the square of what is not negative.
    let square = |e: &Expr| match e.node() {
        Node::Power(base, k) if k.is_integer() => Some(base.clone()),
        _ => None,
    };
    let is_size = |base: &Expr| sign(base, domains).is_not_negative();
    let inside = e
        .under_root()
        .cloned()
        .or_else(|| square(&e).filter(is_size));
    if let Some(inside) = inside.filter(|_| open) {
        return decisive(&inside, domains, open);
    }
    let e = squared(&e, domains).unwrap_or(e);
    of_squares(&e, domains).unwrap_or(e)
}

/// What has the sign of a difference of two squares: 1 − e² is above zero where 1 − e is, and M² − m² where M − m is.
fn of_squares(e: &Expr, domains: &Domains) -> Option<Expr> {
    let Node::Sum(terms) = e.node() else {
        return None;
    };
    let [first, second] = terms.as_slice() else {
        return None;
    };
    let root = |square: &Expr| {
        let is_even = |f: &Expr| match f.node() {
            Node::Power(_, k) => k
                .as_number()
                .is_some_and(|k| k.is_integer() && k.numer().is_even()),
            _ => f.as_number().is_some(),
        };
        square.factors().iter().all(is_even).then_some(())?;
        let root = tidy(&square.sqrt(), domains).ok()?;
        let is_plain = root.parts().all(|part| part.under_root().is_none());
        let is_size = sign(&root, domains).is_not_negative();
        (is_plain && is_size).then_some(root)
    };
    let difference = |large: &Expr, small: &Expr| Some(root(large)? - root(&-small)?);
    difference(first, second).or_else(|| difference(second, first))
}

/// What has the sign of `a − √(b + c)` without the root, where a is known not to be negative, or is not where a² is as large
/// as b + c; likewise for `√(b + c) − a`. A condition such as u ≥ μ √(2 g h) reads better as it is, and h ≥ √(H h) as h ≥ H.
fn squared(e: &Expr, domains: &Domains) -> Option<Expr> {
    let Node::Sum(terms) = e.node() else {
        return None;
    };
    let is_sum = |e: &Expr| matches!(e.node(), Node::Sum(_));
    // That of a number is one itself.
    let has_root = |e: &&Expr| {
        let mut inside = e.parts().filter_map(Expr::under_root);
        inside.any(|inside| !inside.is_constant())
    };
    let has_sum = |e: &Expr| {
        let mut inside = e.parts().filter_map(Expr::under_root);
        inside.any(|inside| inside.parts().any(is_sum))
    };
    let (rooted, plain): (Vec<&Expr>, Vec<&Expr>) = terms.iter().partition(has_root);
    let plain = Expr::sum(plain.into_iter().cloned());
    let (root, plain) = match rooted.as_slice() {
        [root] => (*root, plain),
        [root, other] if plain.is_zero() => (*root, (*other).clone()),
        _ => return None,
    };
    let proved = |e: &Expr| match sign(e, domains) {
        Seen::Proved(sign) => Some(sign.is_not_negative()),
        _ => None,
    };
    let difference = &plain.powi(2) - &root.powi(2);
    let there = |given: Expr| {
        let sign = sign(&plain, &domains.given(&given, true));
        matches!(sign, Seen::Proved(s) if s.is_not_negative())
    };
    let difference = match (proved(&plain), proved(root)?) {
        (Some(true), false) => difference,
        (Some(false), true) => -difference,
        (None, false) if there(core(&difference, domains)) => difference,
        _ => return None,
    };
    let without = core(&difference, domains);
    let is_better = !has_root(&&without) && (has_sum(root) || without.size() < e.size());
    is_better.then(|| essential(&difference, domains))
}

/// What can make a product vanish: its factors above the line, without their powers.
pub(super) fn bases(e: &Expr) -> Vec<Expr> {
    let factors = e.factors();
    let base = |factor: &Expr| match factor.node() {
        Node::Power(_, k) if k.as_number().is_some_and(num_traits::Signed::is_negative) => None,
        Node::Power(base, k) if k.as_number().is_some() => Some(base.clone()),
        _ => Some(factor.clone()),
    };
    factors.iter().filter_map(base).collect()
}
