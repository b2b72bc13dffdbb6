//! The values of a symbol at which an expression is zero.
//!
//! In: an expression, the symbol, domains. Out: closed forms of the values within the domain, each with what must hold for it,
//! and the reason why others were discarded.

mod angle;

use num_integer::{Integer, Roots as _};

use super::calc::{Seen, decisive, essential, has_both_signs, in_bars, is_zero, seen, sign, tidy};
use crate::algebra::{self, Element, Field, Powers, Sign, Stop};
use crate::domain::{Domain, Domains, Origin, Relation};
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
    /// The same as what must be above zero, or not below it where `true`.
    pub needs: Vec<(Expr, bool)>,
    /// For a component of a unit vector the other one, where it plays a part.
    pub other: Option<(Symbol, Expr)>,
}

impl Root {
    /// A value that solves without conditions.
    pub(super) fn sure(value: Expr) -> Root {
        Root {
            value,
            proved: true,
            given: Vec::new(),
            needs: Vec::new(),
            other: None,
        }
    }

    /// A formula with the value in it.
    pub fn put_in(&self, e: &Expr, symbol: &Symbol) -> Expr {
        let e = e.put(symbol, &self.value);
        match &self.other {
            Some((other, value)) => e.put(other, value),
            None => e,
        }
    }

    /// What should be zero, with the other component of a unit vector, which may be above zero or below: where only one of these
    /// does, that is needed.
    fn beside(&mut self, e: &Expr, symbol: &Symbol, other: &Symbol, domains: &Domains) -> Expr {
        let size = (Expr::one() - self.value.powi(2)).sqrt();
        let ways = [(size.clone(), true), (-size, false)].map(|(value, above)| {
            self.other = Some((other.clone(), value));
            let put_in = self.put_in(e, symbol);
            let vanishes = is_zero(&put_in, domains) == Some(true);
            (above, self.other.clone(), put_in, vanishes)
        });
        let vanish = ways.each_ref().map(|(.., vanishes)| *vanishes);
        let [above, below] = ways;
        let (is_above, value, put_in, _) = if vanish == [false, true] {
            below
        } else {
            above
        };
        self.other = value;
        if vanish[0] != vanish[1] {
            let own = Expr::symbol(other);
            self.rests_on(if is_above { own } else { -own });
        }
        put_in
    }

    /// Holds where something is not below zero, and only there.
    fn rests_on(&mut self, need: Expr) {
        self.given.push(Sentence::not_negative(&need));
        self.needs.push((need, true));
    }

    /// The domains where all that it needs is so.
    fn within(&self, domains: &Domains) -> Domains {
        let needs = self.needs.iter();
        needs.fold(domains.clone(), |all, (e, closed)| all.given(e, *closed))
    }
}

/// All values of a symbol within its domain at which an expression is zero.
#[derive(Clone, Debug, Default)]
pub struct Roots {
    /// Those within the domain.
    pub inside: Vec<Root>,
    /// The others, with the reason.
    pub discarded: Vec<Sentence>,
    /// Coefficients, ascending, of each factor of higher degree than closed forms are given for.
    pub open: Vec<Vec<Expr>>,
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

/// Solves e = 0 for a symbol, within its domain and the relations that bear upon it. What stands in bars is taken with either
/// sign, and of its roots those are kept at which it has that sign.
pub fn solve(e: &Expr, symbol: &Symbol, domains: &Domains) -> Result<Roots, Unsolved> {
    let Some((bars, x)) = in_bars(e, |x| x.mentions(symbol)) else {
        return solve_without_bars(e, symbol, domains);
    };
    let mut out = Roots::default();
    for side in [x.clone(), -x] {
        let open = e.replace(&bars, &side);
        let found = match solve(&open, symbol, &domains.given(&side, true)) {
            // Every value on one side of the bars solves it.
            Err(Unsolved::Absent) if is_zero(&open, domains) != Some(false) => {
                return Err(Unsolved::Inside);
            }
            Err(Unsolved::Absent) => continue,
            found => found?,
        };
        out.discarded.extend(found.discarded);
        out.open.extend(found.open);
        for root in found.inside {
            if out.inside.iter().all(|known| known.value != root.value) {
                out.inside.push(root);
            }
        }
    }
    Ok(out)
}

fn solve_without_bars(e: &Expr, symbol: &Symbol, domains: &Domains) -> Result<Roots, Unsolved> {
    // That the scene gets there with some value of the symbol says nothing of the others.
    let mut apart = domains.clone();
    (apart.relations).retain(|r| r.origin == Origin::Stated || !r.excess.mentions(symbol));
    // Of a unit vector the component that is sought is the one that the other follows from.
    let mine = apart.unit_vectors.iter_mut();
    mine.filter(|[_, b]| b == symbol)
        .for_each(|pair| pair.swap(0, 1));
    let mut out = within_interval(e, symbol, &apart)?;
    let bearing = domains.relations.iter();
    for relation in bearing.filter(|r| r.excess.symbols().contains(symbol)) {
        for mut root in std::mem::take(&mut out.inside) {
            let excess = relation.excess.put(symbol, &root.value);
            // Where the value lies in the interval at all.
            let here = &root.within(&apart);
            let seen = sign(&excess, here);
            match seen {
                Seen::Proved(Sign::Negative) | Seen::Negative => {}
                // It may lie just at the end of what is wanted, and nowhere else.
                Seen::Proved(Sign::NotPositive) => {}
                Seen::Proved(Sign::Zero) if !relation.closed => {}
                _ => {
                    let sure = match seen {
                        Seen::Proved(s) => {
                            s == Sign::Positive || relation.closed && s.is_not_negative()
                        }
                        // Seen at points is not proved.
                        _ => false,
                    };
                    if !sure {
                        let need = decisive(&excess, here, !relation.closed);
                        let holds = match relation.closed {
                            true => Sentence::not_negative(&need),
                            false => Sentence::positive(&need),
                        };
                        let so_that = match relation.origin.so_that() {
                            None => stated(relation),
                            Some(needed) => Sentence::words(needed),
                        };
                        root.given.push(sentence!("{}, so that {}", holds, so_that));
                        root.needs.push((need, relation.closed));
                    }
                    out.inside.push(root);
                    continue;
                }
            }
            let against = match relation.origin.so_that() {
                None => sentence!(", against {}", stated(relation)),
                Some(needed) => sentence!(": {} is needed so that {}", stated(relation), needed),
            };
            let why = sentence!("{} = {}{}{}", symbol, &root.value, against, how(seen));
            out.discarded.push(why);
        }
    }
    Ok(out)
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
            [root] if root.proved && roots.open.is_empty() => Some((root.value.clone(), !grows)),
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
        return angle::zeros(e, symbol, domains);
    };
    if factors.is_empty() && !has_zero {
        return Err(Unsolved::Absent);
    }
    let domain = domains.of_symbol(symbol);
    let mut out = Roots::default();
    if has_zero {
        if domain.contains(&crate::expr::ratio(0, 1)) {
            out.inside.push(Root::sure(Expr::zero()));
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
        let found = match closed(&mut field, &coefficients)? {
            None => around_middle(&mut field, &coefficients)?,
            found => found,
        };
        let candidates = match found {
            Some(candidates) => candidates,
            None => {
                let factor = coefficients.iter().map(|c| field.expr(c)).collect();
                out.open.push(factor);
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
        let sides = [Some(root.clone()), (d % 2 == 0).then(|| -&root)];
        for (side, sign) in sides.into_iter().flatten().zip([1, -1]) {
            out.push(match root_of_number(&y, d) {
                Some(root) => Expr::from(sign) * root,
                None => tidied(field, &side)?,
            });
        }
    }
    Ok(Some(out))
}

/// A root of a positive number above the second, as a power of the least number that it is one of: ⁸√128 is 2^(7/8).
fn root_of_number(y: &Expr, d: usize) -> Option<Expr> {
    let y = y
        .as_number()
        .filter(|y| y.numer().as_i64() > Some(0) && d > 2)?;
    let [over, under] = [y.numer().as_i64()?, y.denom().as_i64()?];
    let powers = (1..=62u32)
        .rev()
        .map(|j| (j, over.nth_root(j), under.nth_root(j)));
    let mut powers = powers
        .filter(|(j, a, b)| a.checked_pow(*j) == Some(over) && b.checked_pow(*j) == Some(under));
    let (j, a, b) = powers.next()?;
    Some(Expr::ratio(a, b).power(Expr::ratio(i64::from(j), d as i64)))
}

/// The same of a polynomial in x and what lies in the middle of its roots, as (1 + x)⁸ = 2 is one in 1 + x.
fn around_middle(field: &mut Field, c: &[Element]) -> Result<Option<Vec<Expr>>, Unsolved> {
    let Some(degree) = c.iter().rposition(|c| !field.is_zero(c)).filter(|n| *n > 2) else {
        return Ok(None);
    };
    let count = field.integer(degree as i64);
    let whole = field.mul(&count, &c[degree])?;
    let middle = field.neg(&field.div(&c[degree - 1], &whole)?);
    if field.is_zero(&middle) {
        return Ok(None);
    }
    let mut shifted = c[..=degree].to_vec();
    for i in 0..degree {
        for j in (i..degree).rev() {
            let step = field.mul(&middle, &shifted[j + 1])?;
            shifted[j] = field.add(&shifted[j], &step)?;
        }
    }
    let Some(found) = closed(field, &shifted)? else {
        return Ok(None);
    };
    let middle = field.expr(&middle);
    let moved = found.iter().map(|y| match y.is_constant() {
        true => Ok(y + &middle),
        false => tidied(field, &(y + &middle)),
    });
    moved.collect::<Result<_, _>>().map(Some)
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

/// What must not be below zero for a value to be real: radicands, and how far arguments of arcs lie between −1 and 1. Nothing
/// where it is proved.
pub fn real(value: &Expr, domains: &Domains) -> Vec<Expr> {
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
    gaps.retain(|gap| !sign(gap, domains).is_not_negative());
    let mut out: Vec<Expr> = Vec::new();
    for gap in gaps {
        let need = decisive(&gap, domains, false);
        if !out.contains(&need) {
            out.push(need);
        }
    }
    out
}

/// How a sign is known, where it is not proved.
fn how(seen: Seen) -> &'static str {
    if seen.is_proved() {
        ""
    } else {
        " (seen at points, not proved)"
    }
}

/// What must be above zero, or not below it, for a value to lie within a domain, where that is not sure; in `Err` why it does
/// not.
pub(super) fn placed(
    symbol: &Symbol,
    value: &Expr,
    domain: &Domain,
    whole: &Domains,
) -> Result<Vec<(Expr, bool)>, Sentence> {
    let mut needs: Vec<(Expr, bool)> = Vec::new();
    let mut domains = whole.clone();
    for (limit, is_low) in [(&domain.low, true), (&domain.high, false)] {
        let Some(limit) = limit else { continue };
        let end = limit.expr();
        let gap = if is_low { value - &end } else { &end - value };
        let seen = sign(&gap, &domains);
        // Where a small domain is left, points of it may all lie beyond the other end.
        let between = seen == Seen::Negative && domains != *whole && has_both_signs(&gap, whole);
        let outside = match seen {
            Seen::Proved(Sign::Negative | Sign::NotPositive) => true,
            Seen::Negative => !between,
            Seen::Proved(Sign::Zero) => limit.open,
            _ => false,
        };
        // At a bound of what it is made of it may be an end that does not belong to the domain.
        let at_end = seen == Seen::Proved(Sign::NotNegative) && limit.open;
        if seen == Seen::Mixed || between || at_end {
            for need in each_decisive(&gap, &domains, limit.open) {
                let closed = !limit.open && !divides(&need, value, &domains);
                domains = domains.given(&need, closed);
                needs.push((need, closed));
            }
        }
        let how = if seen == Seen::Proved(Sign::NotPositive) && !limit.open {
            " or just at its end"
        } else {
            how(seen)
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
    // The upper end may ask for more than the lower one.
    if let [(low, closed), high] = needs.as_slice()
        && follows(low, *closed, high, whole)
    {
        needs.remove(0);
    }
    Ok(needs)
}

/// What decides whether something is above zero, or not below it: of a product each factor, where none is below zero and the
/// product is to be above it.
fn each_decisive(e: &Expr, domains: &Domains, open: bool) -> Vec<Expr> {
    let core = essential(e, domains);
    let is_size = |f: &Expr| sign(f, domains).is_not_negative();
    match core.node() {
        Node::Product(factors) if open && factors.iter().all(is_size) => {
            // One over something is above zero wherever it has a value.
            let above = factors
                .iter()
                .filter(|f| !matches!(f.node(), Node::Power(_, k) if k.is_negative()));
            above.map(|f| decisive(f, domains, open)).collect()
        }
        _ => {
            // As it stands it is read against the value: `m/M + 1/tan²α ≤ 1`.
            let need = decisive(e, domains, open);
            vec![if e.size() <= need.size() {
                e.clone()
            } else {
                need
            }]
        }
    }
}

/// Whether a value is divided by this, or its opposite, but for factors that are positive.
fn divides(divisor: &Expr, value: &Expr, domains: &Domains) -> bool {
    value.parts().any(|part| match part.node() {
        Node::Power(base, k) if k.is_negative() => {
            let core = essential(base, domains);
            core == *divisor || -core == *divisor
        }
        _ => false,
    })
}

/// Whether one need follows from another.
fn follows(need: &Expr, closed: bool, other: &(Expr, bool), domains: &Domains) -> bool {
    match algebra::sign(need, &domains.given(&other.0, other.1)) {
        Some(Sign::Positive) => true,
        Some(sign) => closed && sign.is_not_negative(),
        None => false,
    }
}

/// What places a value within its domain, in words.
pub(super) fn placing(symbol: &Symbol, needs: &[(Expr, bool)]) -> Option<Sentence> {
    let each = needs.iter().map(|(e, closed)| match closed {
        true => Sentence::not_negative(e),
        false => Sentence::positive(e),
    });
    let so = sentence!(", so that {} lies within its domain", symbol);
    (!needs.is_empty()).then(|| sentence!("{}{}", Sentence::join(each, " and "), so))
}

/// What must hold for something to vanish in which a root came out as the size of what may have either sign; `None` where it
/// never does.
fn fulfilled(put_in: &Expr, domains: &Domains) -> Option<Expr> {
    let tidied = tidy(put_in, domains).ok()?;
    let sizes = tidied.parts().filter_map(|part| match part.node() {
        Node::Call(Function::Abs, x) => Some(x.clone()),
        _ => None,
    });
    let sides = sizes.flat_map(|x| [-&x, x]);
    let core = |side: Expr| essential(&side, domains);
    let vanishes = |side: &Expr| is_zero(&tidied, &domains.given(side, true)) == Some(true);
    let side = sides.map(core).find(vanishes)?;
    Some(decisive(&side, domains, false))
}

/// Keeps a candidate, or says why not.
fn take(
    e: &Expr,
    symbol: &Symbol,
    value: Expr,
    squared: bool,
    domain: &Domain,
    whole: &Domains,
    out: &mut Roots,
) {
    let put_in = e.put(symbol, &value);
    if matches!(Field::of(whole, &put_in), Err(Stop::DivisionByZero)) {
        // A pole, of which multiplying by the denominator made a zero.
        return;
    }
    let words = sentence!("{} = {}", symbol, &value);
    if matches!(Field::of(whole, &value), Err(Stop::NotReal)) {
        out.discarded
            .push(sentence!("{}, which is not real", words));
        return;
    }
    let mut root = Root {
        proved: false,
        ..Root::sure(value)
    };
    let real = real(&root.value, whole).into_iter();
    real.for_each(|need| root.rests_on(need));
    let domains = &root.within(whole);
    if let Some(shorter) = tidy(&root.value, domains)
        .ok()
        .filter(|v| v.size() < root.value.size())
    {
        root.value = shorter;
    }
    let words = sentence!("{} = {}", symbol, &root.value);
    match placed(symbol, &root.value, domain, domains) {
        Ok(needs) => {
            // That the value is real follows where it lies within its domain.
            let is_told = |(need, closed): &(Expr, bool)| {
                needs
                    .iter()
                    .any(|other| follows(need, *closed, other, whole))
            };
            root.needs.retain(|need| !is_told(need));
            let real = root.needs.iter().map(|(e, _)| Sentence::not_negative(e));
            root.given = real.chain(placing(symbol, &needs)).collect();
            root.needs.extend(needs);
        }
        Err(why) => {
            out.discarded.push(why);
            return;
        }
    }
    let domains = &root.within(whole);
    let put_in = e.put(symbol, &root.value);
    let (put_in, squared) = match domains.other_component(symbol) {
        Some(other) if e.mentions(other) => (root.beside(e, symbol, other, domains), true),
        _ => (put_in, squared),
    };
    match is_zero(&put_in, domains) {
        Some(false) if squared => {
            let squaring = "brought in by squaring: it does not fulfil the equation";
            if let Some(side) = fulfilled(&put_in, domains) {
                // Where what it needs cannot be at once, it is no solution anywhere.
                if sign(&side, domains) == Seen::Proved(Sign::Negative) {
                    out.discarded.push(sentence!("{}, {}", words, squaring));
                    return;
                }
                root.rests_on(side);
                root.proved = true;
            } else if seen(&put_in, domains) != Seen::Mixed || put_in.is_constant() {
                // Squaring adds solutions; a point decides.
                out.discarded.push(sentence!("{}, {}", words, squaring));
                return;
            }
        }
        zero => root.proved = zero == Some(true),
    }
    out.inside.push(root);
}
