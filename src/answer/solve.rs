//! The values of a symbol at which an expression is zero.
//!
//! In: an expression, the symbol, domains. Out: closed forms of the values within the domain, each with what must hold for it,
//! and the reason why others were discarded.

use num_integer::Integer;

use super::calc::{Seen, at_least_zero, beyond_zero, essential, is_zero, seen, sign, tidy};
use crate::algebra::{Element, Field, Powers, Sign, Stop};
use crate::domain::{Domain, Domains, Relation};
use crate::expr::{Expr, Function, Node, Symbol};
use crate::formula::{Sentence, sentence};

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
    // That the scene gets there with some value of the symbol says nothing of the others.
    let mut apart = domains.clone();
    (apart.relations).retain(|r| r.so_that.is_empty() || !r.excess.mentions(symbol));
    let mut out = within_interval(e, symbol, &apart)?;
    let bearing = domains.relations.iter();
    let domain = domain_of(symbol, domains);
    for relation in bearing.filter(|r| r.excess.symbols().contains(symbol)) {
        for mut root in std::mem::take(&mut out.inside) {
            // Where the value lies in the interval at all.
            let placed = placed(symbol, &root.value, &domain, &apart);
            let domains = &placed.map_or_else(|_| apart.clone(), |(_, within)| within);
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
                        let so_that = match relation.so_that.as_str() {
                            "" => stated(relation),
                            needed => Sentence::words(needed),
                        };
                        root.given.push(sentence!("{}, so that {}", holds, so_that));
                    }
                    out.inside.push(root);
                    continue;
                }
            }
            let against = match relation.so_that.as_str() {
                "" => sentence!(", against {}", stated(relation)),
                needed => sentence!(": {} is needed so that {}", stated(relation), needed),
            };
            let why = sentence!("{} = {}{}", symbol, &root.value, against);
            out.discarded.push(why);
        }
    }
    Ok(out)
}

/// The interval of a symbol.
fn domain_of(symbol: &Symbol, domains: &Domains) -> Domain {
    let own = domains.symbols.get(symbol);
    own.cloned().unwrap_or_else(Domain::positive)
}

/// The one end that a relation sets to a symbol, and whether it is the upper one.
pub(super) fn end_of(
    symbol: &Symbol,
    relation: &Relation,
    domains: &Domains,
) -> Option<(Expr, bool)> {
    let [small, large] = &relation.sides;
    let difference = large - small;
    let slope = tidy(&difference.derivative(symbol), domains).ok()?;
    let grows = sign(&slope, domains).side()?;
    if slope.symbols().contains(symbol) {
        let roots = within_interval(&difference, symbol, domains).ok()?;
        return match roots.inside.as_slice() {
            [root] if root.proved && roots.open.is_none() => Some((root.value.clone(), !grows)),
            _ => None,
        };
    }
    let end = &Expr::symbol(symbol) - &(&difference / &slope);
    Some((tidy(&end, domains).ok()?, !grows))
}

pub(super) fn stated(relation: &Relation) -> Sentence {
    let [small, large] = &relation.sides;
    match (small.is_zero(), relation.closed) {
        (true, true) => Sentence::not_negative(large),
        (true, false) => Sentence::positive(large),
        (false, true) => sentence!("{} ≤ {}", small, large),
        (false, false) => sentence!("{} < {}", small, large),
    }
}

fn within_interval(e: &Expr, symbol: &Symbol, domains: &Domains) -> Result<Roots, Unsolved> {
    let (mut field, x) = Field::of(domains, e)?;
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
    let domain = domain_of(symbol, domains);
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
        // At a bound of what it is made of it may be an end that does not belong to the domain.
        let at_end = seen == Seen::Proved(Sign::NotNegative) && limit.open;
        if seen == Seen::Mixed || at_end {
            given.push(beyond_zero(&gap, domains, limit.open));
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
    let so = sentence!(", so that {} lies within its domain", symbol);
    let told = (!given.is_empty()).then(|| sentence!("{}{}", Sentence::join(given, " and "), so));
    Ok((told.into_iter().collect(), within))
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
    if matches!(Field::of(domains, &put_in), Err(Stop::DivisionByZero)) {
        // A pole, of which multiplying by the denominator made a zero.
        return;
    }
    let words = sentence!("{} = {}", symbol, &value);
    let mut given: Vec<Sentence> = Vec::new();
    if matches!(Field::of(domains, &value), Err(Stop::NotReal)) {
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
