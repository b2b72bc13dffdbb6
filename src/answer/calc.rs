//! Exact calculation for stories: tidy forms, signs on the domain, and the values of a symbol at which an expression is zero.
//!
//! In: expressions and domains. Out: expressions a person would write, signs that are proved or said to be seen only, roots
//! with the reason why others were discarded. It knows nothing of mechanics.

use num_integer::Integer;

use super::Check;
pub use crate::algebra::tidy;
use crate::algebra::{Element, Field, Powers, Sign, Stop};
use crate::domain::{Domain, Domains, Relation, roles, samples, samples_until};
use crate::expr::{Expr, Function, Node, Point, Symbol};
use crate::formula::{Sentence, sentence};
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

/// Whether the expression is zero on the whole domain: yes by its normal form, no by a point at which it is not; `None`
/// where neither was found.
pub fn is_zero(e: &Expr, domains: &Domains) -> Option<bool> {
    let mut field = Field::new(domains);
    field.prepare([e]);
    if field.element(e).is_ok_and(|x| field.is_zero(&x)) {
        return Some(true);
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
    let mut field = Field::new(domains);
    field.prepare([e]);
    if let Ok(x) = field.element(e)
        && field.assumptions().is_empty()
        && let Some(sign) = field.sign(&x)
    {
        return Seen::Proved(sign);
    }
    if let Some(sign) = constant(e) {
        return Seen::Proved(sign);
    }
    // A factor such as cos(π/36) − sin(π/18) has its sign by itself.
    if let Node::Product(factors) = e.node() {
        let is_fixed = |f: &Expr| f.is_constant() && f.as_number().is_none();
        let (fixed, rest): (Vec<Expr>, Vec<Expr>) = factors.iter().cloned().partition(is_fixed);
        let rest = Expr::product(rest);
        match constant(&Expr::product(fixed)) {
            Some(Sign::Positive) if rest != *e => return sign(&rest, domains),
            Some(Sign::Negative) => return sign(&-&rest, domains),
            _ => {}
        }
    }
    seen(e, domains)
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
fn seen(e: &Expr, domains: &Domains) -> Seen {
    match met_anywhere(e, domains) {
        (3.., 0) => Seen::Positive,
        (0, 3..) => Seen::Negative,
        _ => Seen::Mixed,
    }
}

/// Whether values above and below zero are found in the domain.
pub fn has_both_signs(e: &Expr, domains: &Domains) -> bool {
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
    let roles = roles(&[e]);
    let (domains, _) = domains.completed(&roles);
    let names = roles
        .symbols
        .keys()
        .filter(|name| !domains.is_component(name));
    let starts = samples(&roles, &domains, 1);
    let led = names.flat_map(|name| {
        starts
            .iter()
            .flat_map(|start| start.led_far(name, &domains))
    });
    for sample in led.filter(|sample| domains.admits(sample)) {
        match evaluate::<Interval>(e, &sample.point(roles.radians)) {
            Outcome::Value(v) if v.low > 0.0 => above += 1,
            Outcome::Value(v) if v.high < 0.0 => below += 1,
            _ => {}
        }
    }
    (above, below)
}

/// A sum of quotients times those of their denominators that are known to be positive.
fn without_denominators(e: Expr, domains: &Domains) -> Expr {
    let Node::Sum(terms) = e.node() else {
        return e;
    };
    let mut below: Vec<Expr> = Vec::new();
    for term in terms {
        let factors = match term.node() {
            Node::Product(factors) => factors.as_slice(),
            _ => std::slice::from_ref(term),
        };
        for factor in factors {
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
    let tidied = tidy(e, domains).unwrap_or_else(|_| e.clone());
    let tidied = without_denominators(tidied, domains);
    let factors: Vec<Expr> = match tidied.node() {
        Node::Product(factors) => factors.clone(),
        _ => vec![tidied.clone()],
    };
    let mut minus = false;
    let mut rest = Vec::new();
    for f in factors {
        // One over a quantity has its sign.
        let f = match f.node() {
            Node::Power(base, k) if *k == Expr::from(-1) => base.clone(),
            _ => f,
        };
        match sign(&f, domains) {
            Seen::Proved(Sign::Positive) => {}
            Seen::Proved(Sign::Negative) => minus = !minus,
            _ => rest.push(f),
        }
    }
    let product = Expr::product(rest);
    let turned = if minus { -&product } else { product };
    tidy(&turned, domains).unwrap_or(turned)
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
fn beyond_zero(e: &Expr, domains: &Domains, open: bool) -> Sentence {
    let e = essential(e, domains);
    let e = squared(&e, domains).unwrap_or(e);
    match open {
        true => Sentence::positive(&e),
        false => Sentence::not_negative(&e),
    }
}

/// What has the sign of `a − √(b + c)` without the root, where a is known not to be negative; likewise for `√(b + c) − a`.
/// A condition such as u ≥ μ √(2 g h) reads better as it is.
fn squared(e: &Expr, domains: &Domains) -> Option<Expr> {
    let Node::Sum(terms) = e.node() else {
        return None;
    };
    fn under_root(part: &Expr) -> Option<&Expr> {
        match part.node() {
            Node::Power(inside, k) if *k == Expr::ratio(1, 2) => Some(inside),
            _ => None,
        }
    }
    let is_sum = |e: &Expr| matches!(e.node(), Node::Sum(_));
    let has_root = |e: &&Expr| e.parts().any(|part| under_root(part).is_some());
    let has_sum = |e: &Expr| {
        let mut inside = e.parts().filter_map(under_root);
        inside.any(|inside| inside.parts().any(is_sum))
    };
    let (rooted, plain): (Vec<&Expr>, Vec<&Expr>) = terms.iter().partition(has_root);
    let ([root], plain) = (rooted.as_slice(), Expr::sum(plain.into_iter().cloned())) else {
        return None;
    };
    if !has_sum(root) {
        return None;
    }
    let proved = |e: &Expr| match sign(e, domains) {
        Seen::Proved(sign) => Some(sign.is_not_negative()),
        _ => None,
    };
    let difference = &plain.powi(2) - &root.powi(2);
    let difference = match (proved(&plain)?, proved(root)?) {
        (true, false) => difference,
        (false, true) => -difference,
        _ => return None,
    };
    Some(essential(&difference, domains)).filter(|e| !has_root(&e))
}

/// A value of a symbol at which an expression is zero.
#[derive(Clone, Debug)]
pub struct Root {
    /// The value.
    pub value: Expr,
    /// Whether the expression with the value substituted is identically zero.
    pub proved: bool,
    /// What must hold for it to lie within the domain, where that is not sure.
    pub given: Vec<Sentence>,
}

/// All values of a symbol within its domain at which an expression is zero.
#[derive(Clone, Debug, Default)]
pub struct Roots {
    /// Those within the domain.
    pub inside: Vec<Root>,
    /// The others, with the reason.
    pub discarded: Vec<Sentence>,
    /// Coefficients, ascending, of a factor of higher degree than closed forms are given for.
    pub open: Option<Vec<Expr>>,
}

/// Why an equation was not solved.
#[derive(Clone, Debug, PartialEq)]
pub enum Unsolved {
    /// A limit of the algebra.
    Limit(String),
    /// The symbol stands inside a sine, logarithm or the like.
    Inside,
    /// The symbol does not occur.
    Absent,
}

impl From<Stop> for Unsolved {
    fn from(stop: Stop) -> Unsolved {
        Unsolved::Limit(stop.to_string())
    }
}

/// Solves e = 0 for a symbol, within its domain and the relations that bear upon it.
pub fn solve(e: &Expr, symbol: &Symbol, domains: &Domains) -> Result<Roots, Unsolved> {
    let mut out = within_interval(e, symbol, domains)?;
    let bearing = domains.relations.iter();
    for relation in bearing.filter(|r| r.excess.symbols().contains(symbol)) {
        for mut root in std::mem::take(&mut out.inside) {
            let excess = relation.excess.put(symbol, &root.value);
            match sign(&excess, domains) {
                Seen::Proved(Sign::Negative) | Seen::Negative => {}
                Seen::Proved(Sign::Zero | Sign::NotPositive) if !relation.closed => {}
                seen => {
                    let sure = match seen {
                        Seen::Proved(s) => {
                            s == Sign::Positive || relation.closed && s.is_not_negative()
                        }
                        Seen::Positive => true,
                        _ => false,
                    };
                    if !sure {
                        let holds = beyond_zero(&excess, domains, !relation.closed);
                        root.given
                            .push(sentence!("{}, so that {}", holds, stated(relation)));
                    }
                    out.inside.push(root);
                    continue;
                }
            }
            let why = sentence!("{} = {}, against {}", symbol, &root.value, stated(relation));
            out.discarded.push(why);
        }
    }
    Ok(out)
}

/// The end that a relation sets to a symbol that stands in it to the first power, and whether it is the upper one.
pub(super) fn end_of(
    symbol: &Symbol,
    relation: &Relation,
    domains: &Domains,
) -> Option<(Expr, bool)> {
    let [small, large] = &relation.sides;
    let difference = large - small;
    let slope = tidy(&difference.derivative(symbol), domains).ok()?;
    let toward = sign(&slope, domains);
    if slope.symbols().contains(symbol) || !toward.is_proved() {
        return None;
    }
    if !toward.is_positive() && !toward.is_negative() {
        return None;
    }
    let end = &Expr::symbol(symbol) - &(&difference / &slope);
    Some((tidy(&end, domains).ok()?, toward.is_negative()))
}

fn stated(relation: &Relation) -> Sentence {
    let [small, large] = &relation.sides;
    let than = if relation.closed { " ≤ " } else { " < " };
    sentence!("{}{}{}", small, than, large)
}

fn within_interval(e: &Expr, symbol: &Symbol, domains: &Domains) -> Result<Roots, Unsolved> {
    let mut field = Field::new(domains);
    field.prepare([e]);
    let x = field.element(e)?;
    let Some(Powers {
        factors,
        has_zero,
        squared,
    }) = field.powers(&x, symbol)?
    else {
        return super::zeros::angle(e, symbol, domains);
    };
    if factors.is_empty() && !has_zero {
        return Err(Unsolved::Absent);
    }
    let domain = domains
        .symbols
        .get(symbol)
        .cloned()
        .unwrap_or_else(Domain::positive);
    let mut out = Roots::default();
    if has_zero {
        if domain.contains(&crate::expr::ratio(0, 1)) {
            out.inside.push(Root {
                value: Expr::zero(),
                proved: true,
                given: Vec::new(),
            });
        } else {
            let outside = within(&domain, symbol);
            out.discarded.push(sentence!(
                "{} = {}, outside {}",
                symbol,
                &Expr::zero(),
                outside
            ));
        }
    }
    for coefficients in factors {
        let candidates = match closed(&mut field, &coefficients)? {
            Some(candidates) => candidates,
            None => {
                out.open = Some(coefficients.iter().map(|c| field.expr(c)).collect());
                continue;
            }
        };
        for value in candidates {
            take(e, symbol, value, squared, &domain, domains, &mut out);
        }
    }
    Ok(out)
}

/// Real roots of a polynomial whose powers are 0, d and 2d; `None` for others.
fn closed(field: &mut Field, c: &[Element]) -> Result<Option<Vec<Expr>>, Unsolved> {
    let present: Vec<usize> = (0..c.len()).filter(|k| !field.is_zero(&c[*k])).collect();
    let d = present.iter().fold(0usize, |g, k| g.gcd(k));
    let degree = present.last().copied().unwrap_or(0);
    if d == 0 || degree / d > 2 {
        return Ok(None);
    }
    let mut squares = Vec::new();
    if degree / d == 1 {
        let y = field.neg(&field.div(&c[0], &c[d])?);
        squares.push(field.expr(&y));
    } else {
        let (a, b, k) = (field.expr(&c[2 * d]), field.expr(&c[d]), field.expr(&c[0]));
        // The half formula: with b = 2 b', y = (−b' ± √(b'² − a k))/a.
        let half = &b * &Expr::ratio(1, 2);
        let inner = tidied(field, &(&half.powi(2) - &(&a * &k)))?;
        for s in [1, -1] {
            let root = Expr::from(s) * inner.sqrt();
            squares.push(tidied(field, &(&(&root - &half) / &a))?);
        }
    }
    let mut out = Vec::new();
    for y in squares {
        if d == 1 {
            out.push(y);
            continue;
        }
        let root = y.power(Expr::ratio(1, d as i64));
        let minus = -&root;
        out.push(tidied(field, &root)?);
        if d % 2 == 0 {
            out.push(tidied(field, &minus)?);
        }
    }
    Ok(Some(out))
}

fn tidied(field: &mut Field, e: &Expr) -> Result<Expr, Unsolved> {
    match field.element(e) {
        Ok(x) => Ok(field.expr(&x)),
        // An even root of a negative value: no real root; what is written cannot be evaluated and is discarded below.
        Err(Stop::NotReal) => Ok(e.clone()),
        Err(stop) => Err(stop.into()),
    }
}

/// The domain as a sentence, such as `x > 0`.
pub fn within(domain: &Domain, symbol: &Symbol) -> Sentence {
    let low = domain.low.as_ref().map(|l| (l.expr(), l.open));
    let high = domain.high.as_ref().map(|l| (l.expr(), l.open));
    match (low, high) {
        (None, None) => sentence!("{} is real", symbol),
        (Some((low, open)), None) => {
            sentence!("{}{}{}", symbol, if open { " > " } else { " ≥ " }, &low)
        }
        (None, Some((high, open))) => sentence!("{}{}{}", symbol, below(open), &high),
        (Some((low, from)), Some((high, to))) => {
            sentence!("{}{}{}{}{}", &low, below(from), symbol, below(to), &high)
        }
    }
}

fn below(open: bool) -> &'static str {
    if open { " < " } else { " ≤ " }
}

/// What must hold for a value to be real: radicands not below zero, arguments of arcs between −1 and 1. Nothing where it is
/// proved.
pub fn real(value: &Expr, domains: &Domains) -> Vec<Sentence> {
    let mut gaps = Vec::new();
    for part in value.parts() {
        match part.node() {
            Node::Power(base, k) if k.as_number().is_some_and(|k| !k.is_integer()) => {
                gaps.push(base.clone());
            }
            Node::Call(Function::Asin | Function::Acos, x) => {
                gaps.extend([Expr::one() - x.clone(), Expr::one() + x.clone()]);
            }
            _ => {}
        }
    }
    gaps.retain(|gap| !matches!(sign(gap, domains), Seen::Proved(s) if s.is_not_negative()));
    let mut out: Vec<Sentence> = Vec::new();
    for gap in gaps {
        let words = at_least_zero(&gap, domains);
        if !out.contains(&words) {
            out.push(words);
        }
    }
    out
}

/// What must hold for a value to lie within a domain, where that is not sure, and the domains where it does; in `Err` why it
/// does not.
pub(super) fn placed(
    symbol: &Symbol,
    value: &Expr,
    domain: &Domain,
    domains: &Domains,
) -> Result<(Vec<Sentence>, Domains), Sentence> {
    let (mut given, mut within) = (Vec::new(), domains.clone());
    for (limit, is_low) in [(&domain.low, true), (&domain.high, false)] {
        let Some(limit) = limit else { continue };
        let end = limit.expr();
        let gap = if is_low { value - &end } else { &end - value };
        let seen = sign(&gap, domains);
        let outside = match seen {
            Seen::Proved(Sign::Negative | Sign::NotPositive) | Seen::Negative => true,
            Seen::Proved(Sign::Zero) => limit.open,
            _ => false,
        };
        if seen == Seen::Mixed {
            given.push(sentence!(
                "{}, so that {} lies within its domain",
                beyond_zero(&gap, domains, limit.open),
                symbol
            ));
            within = within.given(&essential(&gap, domains), !limit.open);
        }
        let how = if seen == Seen::Proved(Sign::NotPositive) && !limit.open {
            " or just at its end"
        } else if seen.is_proved() {
            ""
        } else {
            " (seen at points, not proved)"
        };
        if outside {
            return Err(sentence!(
                "{} = {}, outside {}{}",
                symbol,
                value,
                self::within(domain, symbol),
                how
            ));
        }
    }
    Ok((given, within))
}

/// What must hold for something to vanish in which a root came out as the size of what may have either sign; `None` where it
/// never does.
fn fulfilled(put_in: &Expr, domains: &Domains) -> Option<Sentence> {
    let tidied = tidy(put_in, domains).ok()?;
    let sizes = tidied.parts().filter_map(|part| match part.node() {
        Node::Call(Function::Abs, x) => Some(x.clone()),
        _ => None,
    });
    let sides = sizes.flat_map(|x| [-&x, x]);
    let core = |side: Expr| essential(&side, domains);
    let vanishes = |side: &Expr| is_zero(&tidied, &domains.given(side, true)) == Some(true);
    let side = sides.map(core).find(vanishes)?;
    Some(at_least_zero(&side, domains))
}

/// Keeps a candidate, or says why not.
fn take(
    e: &Expr,
    symbol: &Symbol,
    value: Expr,
    squared: bool,
    domain: &Domain,
    domains: &Domains,
    out: &mut Roots,
) {
    let put_in = e.put(symbol, &value);
    let mut there = Field::new(domains);
    there.prepare([&put_in]);
    if matches!(there.element(&put_in), Err(Stop::DivisionByZero)) {
        // A pole, of which multiplying by the denominator made a zero.
        return;
    }
    let words = sentence!("{} = {}", symbol, &value);
    let mut given: Vec<Sentence> = Vec::new();
    let mut probe = Field::new(domains);
    probe.prepare([&value]);
    if matches!(probe.element(&value), Err(Stop::NotReal)) {
        out.discarded
            .push(sentence!("{}, which is not real", words));
        return;
    }
    given.extend(real(&value, domains));
    let domains = match placed(symbol, &value, domain, domains) {
        Ok((conditions, within)) => {
            given.extend(conditions);
            &within.clone()
        }
        Err(why) => {
            out.discarded.push(why);
            return;
        }
    };
    match is_zero(&put_in, domains) {
        Some(true) => out.inside.push(Root {
            value,
            proved: true,
            given,
        }),
        Some(false) if squared => {
            if let Some(side) = fulfilled(&put_in, domains) {
                given.push(side);
                out.inside.push(Root {
                    value,
                    proved: true,
                    given,
                });
                return;
            }
            // Squaring adds solutions; a point decides.
            match seen(&put_in, domains) {
                Seen::Mixed if !put_in.is_constant() => out.inside.push(Root {
                    value,
                    proved: false,
                    given,
                }),
                _ => out.discarded.push(sentence!(
                    "{}, brought in by squaring: it does not fulfil the equation",
                    words
                )),
            }
        }
        _ => out.inside.push(Root {
            value,
            proved: false,
            given,
        }),
    }
}

/// What rounding may make of the value of a formula.
pub fn rounding(e: &Expr, point: &Point<f64>) -> f64 {
    let as_it_is = |(name, value): (&Symbol, &f64)| {
        let [low, high] = [*value; 2];
        (name.clone(), Outcome::Value(Interval { low, high }))
    };
    let exact = Point {
        values: point.values.iter().map(as_it_is).collect(),
        ..Point::default()
    };
    match evaluate(e, &exact) {
        Outcome::Value(enclosed) => enclosed.high - enclosed.low,
        Outcome::Undefined | Outcome::Unknown => 0.0,
    }
}
