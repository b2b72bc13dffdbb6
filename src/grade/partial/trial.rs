//! One wrong formula held against the right one: what change of it would be right.
//!
//! A glance at a few points comes before every proof, so that what cannot be is not tried.

use std::collections::{BTreeMap, BTreeSet};

use num_traits::Signed;

use super::super::context::{Context, quotient};
use super::super::{Diagnosis, fraction, number};
use super::{GLANCES, simple};
use crate::algebra::{self, Field};
use crate::dimension::Dimension;
use crate::domain::{Coordinate, Domains, Roles, Sample, roles, samples};
use crate::equality::identical as proved;
use crate::expr::angle::arcs_exchanged;
use crate::expr::number::to_f64;
use crate::expr::{Expr, Function, Node, Point, Rational, Scalar, Symbol, Table, ratio};
use crate::formula::write_plain;
use crate::interval::{Interval, Outcome, evaluate};

/// A value as far as doubles tell it, and a point with such values.
type Weighed = Outcome<Interval>;
type Place = Point<Weighed>;

/// The pair, and the values of both at a few points.
pub(super) struct Trial<'a> {
    expected: &'a Expr,
    answer: &'a Expr,
    domains: &'a Domains,
    /// Whether sines and cosines occur.
    turns: bool,
    /// How symbols occur in the expected formula and in the answer.
    uses: [Roles; 2],
    points: Vec<Place>,
    values: Vec<Weighed>,
    answers: Vec<Weighed>,
}

/// Whether two lists of values may be of the same expression, some of them known in both; the first that are apart end it.
fn fits(values: &[Weighed], others: impl Iterator<Item = Weighed>) -> bool {
    let mut known = false;
    for pair in values.iter().zip(others) {
        match pair {
            (Outcome::Value(a), Outcome::Value(b)) if a.is_disjoint(&b) => return false,
            (Outcome::Value(_), Outcome::Value(_)) => known = true,
            _ => {}
        }
    }
    known
}

/// Orders at which two formulas are compared as an angle goes to zero, and the longest derivative looked at.
const HIGHEST_ORDER: usize = 4;
const LARGEST: usize = 2_000;

const SIDE: &str = "check from which side the angle is measured";

/// To how many digits a coefficient of a formula is rounded that would be exact without a factor between these bounds.
fn rounded_to(e: &Expr, [low, high]: [&Rational; 2]) -> Option<u32> {
    match e.node() {
        Node::Number(value) if !value.is_integer() => {
            let digits = number::digits_shared(value, &[value / high, value / low]);
            (digits > 0 && number::has_digits(value, digits)).then_some(digits)
        }
        Node::Sum(parts) | Node::Product(parts) => {
            parts.iter().find_map(|part| rounded_to(part, [low, high]))
        }
        _ => None,
    }
}

impl<'a> Trial<'a> {
    pub(super) fn new(ctx: &'a Context, expected: &'a Expr, answer: &'a Expr) -> Trial<'a> {
        let domains = ctx.domains();
        let uses = roles(&[expected, answer]);
        let (all, _) = domains.completed(&uses);
        // The first points have many ones, at which a power is as good as another.
        let points = samples(&uses, &all, 2 + GLANCES);
        // What is known by its direction alone costs less by far; that does where no angle is needed in radians.
        let direction = |s: &Sample, name: &Symbol| {
            matches!(s.coordinates.get(name), Some(Coordinate::Direction { .. }))
        };
        let mut angles = uses.symbols.iter().filter(|(_, r)| r.turns);
        let radians = uses.radians
            || angles.any(|(name, r)| r.bare || !points.iter().all(|s| direction(s, name)));
        let points: Vec<_> = points.iter().skip(2).map(|s| s.point(radians)).collect();
        use Function::{Cos, Sin, Tan};
        let turning = |part: &Expr| matches!(part.node(), Node::Call(Sin | Cos | Tan, _));
        let turns = expected.parts().chain(answer.parts()).any(turning);
        Trial {
            expected,
            answer,
            domains,
            turns,
            uses: [expected, answer].map(|e| roles(&[e])),
            values: values(expected, &points),
            answers: values(answer, &points),
            points,
        }
    }

    /// Whether a symbol is an angle in the expected formula, and in the answer.
    fn turned(&self, name: &str) -> [bool; 2] {
        let turns = |uses: &Roles| uses.symbols.get(name).is_some_and(|role| role.turns);
        self.uses.each_ref().map(turns)
    }

    /// Whether two lists of values are of different expressions for certain.
    fn apart(a: &[Weighed], b: &[Weighed]) -> bool {
        a.iter().zip(b).any(|pair| match pair {
            (Outcome::Value(a), Outcome::Value(b)) => a.is_disjoint(b),
            _ => false,
        })
    }

    /// Whether an expression may have these values.
    fn may_be(&self, values: &[Weighed], e: &Expr) -> bool {
        fits(values, self.points.iter().map(|point| evaluate(e, point)))
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

    /// Whether the answer with other values of its symbols equals the expected formula. It is weighed at points changed in
    /// that way before the changed formula is built.
    fn mends_at<const N: usize>(
        &self,
        change: impl Fn(&mut Place),
        symbols: [(Symbol, Expr); N],
    ) -> bool {
        let weigh = |point: &Place| {
            let mut point = point.clone();
            change(&mut point);
            evaluate(self.answer, &point)
        };
        let changed = || self.answer.substitute(&BTreeMap::from(symbols));
        fits(&self.values, self.points.iter().map(weigh))
            && proved(self.expected, &changed(), self.domains)
    }

    /// Whether the answer changed as a whole equals the expected formula; its values are changed first.
    fn mends_whole(
        &self,
        change: impl Fn(&Weighed) -> Option<Weighed>,
        changed: impl Fn(&Expr) -> Expr,
    ) -> bool {
        let weigh = |answer: &Weighed| change(answer).unwrap_or(Outcome::Unknown);
        fits(&self.values, self.answers.iter().map(weigh))
            && proved(self.expected, &changed(self.answer), self.domains)
    }

    /// Whether a changed answer equals the expected formula.
    fn mends(&self, changed: &Expr) -> bool {
        self.may_be(&self.values, changed) && proved(self.expected, changed, self.domains)
    }

    /// Whether the answer is the expected formula changed in a known way.
    pub(super) fn is(&self, changed: &Expr) -> bool {
        self.may_be(&self.answers, changed) && proved(changed, self.answer, self.domains)
    }

    pub(super) fn sign(&self) -> Option<Diagnosis> {
        let minus = Weighed::from_rational(&ratio(-1, 1));
        let right = self.mends_whole(|v| Some(v.times(&minus)), |e| -e);
        let hint = "check the sign, and which direction counts as positive";
        right.then(|| Diagnosis::new("SIGN", "right up to the sign", hint))
    }

    /// A constant factor.
    pub(super) fn factor(&self, ctx: &Context) -> Option<Diagnosis> {
        if self.expected.is_zero() || self.answer.is_zero() || !self.in_proportion() {
            return None;
        }
        // A factor 1 holds on one branch of |f| alone.
        if let Some(k) = quotient(self.answer, self.expected, ctx).filter(|k| !k.is_one()) {
            let fraction = fraction(&k).is_some_and(|k| simple(&k));
            if let Some([low, high]) = number::bounds(&k).filter(|_| !fraction) {
                let one = ratio(1, 1);
                let near = |k: &&Rational| (*k - &one).abs() < ratio(1, 50);
                if [&low, &high].iter().all(near)
                    && let Some(digits) = rounded_to(self.answer, [&low, &high])
                {
                    let s = if digits == 1 { "" } else { "s" };
                    let message =
                        format!("right to about {digits} digit{s}: a coefficient was rounded");
                    let hint = "give exact coefficients rather than rounded ones";
                    return Some(Diagnosis::new("ROUNDED", message, hint));
                }
            }
            let message = format!("right up to the constant factor {}", write_plain(&k));
            let energy = ctx.key.question.dimension == Some(Dimension::new(1, 2, -2));
            let hint = match energy && k == Expr::from(2) {
                true => "an energy twice too large: has every kinetic energy its factor 1/2?",
                false => "a constant factor is wrong",
            };
            return Some(Diagnosis::new("FACTOR", message, hint));
        }
        None
    }

    /// A factor made of symbols that both formulas know.
    pub(super) fn factor_of_symbols(&self, ctx: &Context) -> Option<Diagnosis> {
        if self.expected.is_zero() || self.answer.is_zero() || !self.may_be_factor() {
            return None;
        }
        let (field, a, e) = Field::pair(self.domains, self.answer, self.expected).ok()?;
        let q = field.div(&a, &e).ok()?;
        if !q.is_monomial() {
            return None;
        }
        let shown = field.expr(&q);
        if shown.is_one() {
            return None;
        }
        let known = ctx.key.question.symbols.iter();
        let known: BTreeSet<Symbol> = known.map(|g| g.name.clone()).collect();
        let calls = shown.parts().any(|e| matches!(e.node(), Node::Call(..)));
        if calls || !shown.symbols().is_subset(&known) || shown.size() > 12 {
            return None;
        }
        let message = format!("the expected formula times {}", ctx.say(&shown));
        let hint = "a factor is missing or too much; compare the dimensions";
        Some(Diagnosis::new("FACTOR_SYMBOL", message, hint))
    }

    /// Whether answer over expected may be a product of powers of symbols and of one root of a sum. Whatever is a power of a
    /// symbol grows by the same factor when that symbol is doubled again.
    fn may_be_factor(&self) -> bool {
        let Some(point) = self.points.first() else {
            return true;
        };
        let mut roots = Vec::new();
        for part in self.expected.parts().chain(self.answer.parts()) {
            if let Node::Power(base, k) = part.node()
                && matches!(base.node(), Node::Sum(_))
                && k.as_number().is_none_or(|k| !k.is_integer())
            {
                roots.push(base);
            }
        }
        let free = |name: &Symbol| match self.domains.symbols.get(name) {
            Some(domain) => domain.high.is_none() && !domain.changes_sign(),
            None => !self.domains.is_component(name),
        };
        let grown = |e: &Expr, name: &Symbol| -> Option<f64> {
            let at = |scale: i64| {
                let mut point = point.clone();
                let value = point.values.get_mut(name)?;
                *value = value.times(&Weighed::from_rational(&ratio(scale, 1)));
                let value = evaluate(e, &point).value()?;
                let size = (value.low.abs() + value.high.abs()) / 2.0;
                (value.high - value.low < 1e-10 * size).then_some(size.ln())
            };
            Some(2.0 * at(2)? - at(1)? - at(4)?)
        };
        let names = self.answer.symbols();
        names.iter().filter(|name| free(name)).all(|name| {
            let bent = |e: &Expr| grown(e, name);
            let (Some(a), Some(b)) = (bent(self.answer), bent(self.expected)) else {
                return true;
            };
            let halves = |root: &&Expr| {
                let share = bent(root).map_or(0.0, |r| 2.0 * (a - b) / r);
                (share - share.round()).abs() < 1e-6
            };
            (a - b).abs() < 1e-9 || roots.iter().any(halves)
        })
    }

    pub(super) fn magnitude(&self) -> Option<Diagnosis> {
        let square = |e: &Expr| e.powi(2);
        let values = |v: &[Weighed]| -> Vec<f64> {
            let known = v.iter().filter_map(|o| o.clone().value());
            known.map(|i| i.low.abs().max(i.high.abs())).collect()
        };
        let mut pairs = values(&self.values).into_iter().zip(values(&self.answers));
        let close = pairs.all(|(a, b)| (a - b).abs() <= 1e-9 * a.abs().max(b));
        let right = close && proved(&square(self.expected), &square(self.answer), self.domains);
        let message = "right in magnitude; the sign is wrong on a part of the domain";
        let hint = "the magnitude is right: think of the sign";
        right.then(|| Diagnosis::new("MAGNITUDE", message, hint))
    }

    pub(super) fn reciprocal(&self) -> Option<Diagnosis> {
        let right = !self.answer.is_zero() && self.mends_whole(Weighed::recip, |e| e.powi(-1));
        let message = "the reciprocal of the expected value";
        let hint = "numerator and denominator look exchanged";
        right.then(|| Diagnosis::new("RECIPROCAL", message, hint))
    }

    pub(super) fn sin_cos(&self) -> Option<Diagnosis> {
        if !self.turns {
            return None;
        }
        let swapped = arcs_exchanged(self.answer, &|_| true);
        let right = swapped != *self.answer && self.mends(&swapped);
        let message = "right with sine and cosine exchanged";
        let found = right.then(|| Diagnosis::new("SIN_COS", message, SIDE));
        found.or_else(|| self.one_swapped())
    }

    /// One symbol's sines and cosines exchanged.
    fn one_swapped(&self) -> Option<Diagnosis> {
        let uses = self.uses[1].symbols.iter();
        let angles: Vec<&Symbol> = uses.filter(|(_, r)| r.turns).map(|(n, _)| n).collect();
        if angles.len() < 2 {
            return None;
        }
        let right = Expr::pi() * Expr::ratio(1, 2);
        angles.iter().find_map(|name| {
            let turned = self.answer.put(name, &(&right - &Expr::symbol(name)));
            let message = format!("right with {name} measured from the other side");
            let right = self.mends(&turned);
            right.then(|| Diagnosis::new("SIN_COS", message, SIDE))
        })
    }

    pub(super) fn symbol_signs(&self) -> Option<Diagnosis> {
        let minus = Weighed::from_rational(&ratio(-1, 1));
        let mends = |name: &Symbol| {
            let turn = |point: &mut Place| {
                let value = point.values.get_mut(name);
                let sine = point.directions.get_mut(name).map(|(_, [_, sine])| sine);
                let all = value.into_iter().chain(sine);
                all.for_each(|v| *v = v.times(&minus));
            };
            self.mends_at(turn, [(name.clone(), -Expr::symbol(name))])
        };
        // In a product the sign may be that of any factor.
        let mut names: Vec<Symbol> = self.answer.symbols().into_iter().collect();
        names.retain(mends);
        let replaced = names
            .iter()
            .map(|name| format!("{name} replaced by -{name}"));
        let message = format!("right with {}", any_of(replaced));
        let hint = format!("check the sign with which {} enters", any_of(names.iter()));
        (!names.is_empty()).then(|| Diagnosis::new("SYMBOL_SIGN", message, hint))
    }

    /// The expected formula without an exponent, or with one too many: cos θ for cos²θ.
    pub(super) fn exponent(&self, ctx: &Context) -> Option<Diagnosis> {
        let squares = |e: &Expr| -> Vec<(Expr, Expr)> {
            let square = |part: &Expr| match part.node() {
                Node::Power(base, k) if *k == Expr::from(2) => Some((part.clone(), base.clone())),
                _ => None,
            };
            let whole = e.factors();
            let mut all: Vec<_> = e.parts().filter_map(square).collect();
            // What is off by a factor made of symbols is told as such.
            all.retain(|(power, base)| base.as_symbol().is_none() || !whole.contains(power));
            all
        };
        let lost = squares(self.expected)
            .into_iter()
            .find(|(power, base)| self.is(&self.expected.replace(power, base)));
        // The expected formula may be written with the other function.
        let lost = lost.or_else(|| {
            let mut all = self.answer.parts();
            let call = all.find(|part| {
                let turns = matches!(part.node(), Node::Call(Function::Sin | Function::Cos, _));
                turns && self.mends(&self.answer.replace(part, &part.powi(2)))
            });
            call.map(|call| (call.powi(2), call.clone()))
        });
        let gained = || {
            let mut all = squares(self.answer).into_iter();
            all.find(|(power, base)| self.mends(&self.answer.replace(power, base)))
        };
        let (lacks, (power, base)) = match lost {
            Some(lost) => (true, lost),
            None => (false, gained()?),
        };
        let [power, base] = [power, base].map(|e| ctx.say(&e));
        let (right, mine) = if lacks { (power, base) } else { (base, power) };
        let message = format!("right with {right} in place of {mine}");
        Some(Diagnosis::new(
            "POWER",
            message,
            format!("check the exponent of {mine}"),
        ))
    }

    /// A length, mass or the like taken twice or half.
    pub(super) fn doubled(&self, ctx: &Context) -> Option<Diagnosis> {
        let mut found: Vec<(&'static str, String, Symbol)> = Vec::new();
        for name in self.answer.symbols() {
            if self.turned(&name)[1] {
                continue;
            }
            let symbol = Expr::symbol(&name);
            for (n, d, code, words) in [(1, 2, "HALF", "half of"), (2, 1, "DOUBLE", "twice")] {
                let factor = Weighed::from_rational(&ratio(n, d));
                let scale = |point: &mut Place| {
                    let value = point.values.get_mut(&name);
                    value.into_iter().for_each(|v| *v = v.times(&factor));
                };
                if self.mends_at(scale, [(name.clone(), &symbol * &Expr::ratio(n, d))]) {
                    let shown = ctx.say(&symbol);
                    let message = format!("{words} {shown} in place of {shown}");
                    found.push((code, message, name.clone()));
                }
            }
        }
        // In a quotient it may be twice the one or half of the other.
        let (code, ..) = found.first()?;
        let message = any_of(found.iter().map(|(_, message, _)| message));
        let names = any_of(found.iter().map(|(.., name)| name));
        let hint = format!("check what {names} measures: the whole or the half");
        Some(Diagnosis::new(code, format!("right with {message}"), hint))
    }

    /// Two symbols of the same kind exchanged, or all symbols of body 1 with those of body 2.
    pub(super) fn exchanged(&self, ctx: &Context) -> Option<Diagnosis> {
        let (theirs, mine) = (self.expected.symbols(), self.answer.symbols());
        let names: Vec<Symbol> = theirs.union(&mine).cloned().collect();
        let mut all = BTreeMap::new();
        for (i, a) in names.iter().enumerate() {
            for b in &names[i + 1..] {
                let index = |c: char| c.is_ascii_digit() || c == '_';
                let base = |n: &str| n.trim_end_matches(index).to_string();
                let kin = match (ctx.dimension_of(a), ctx.dimension_of(b)) {
                    (Some(x), Some(y)) => x == y && !x.is_none(),
                    _ => base(a) == base(b),
                };
                if !kin {
                    continue;
                }
                let pair = [(a.clone(), Expr::symbol(b)), (b.clone(), Expr::symbol(a))];
                // A body has its index: m is no other body's m₁.
                let indexed = [a, b].iter().all(|name| name.len() > base(name).len());
                if base(a) == base(b) && indexed {
                    all.extend(pair.clone());
                }
                let swapped = |point: &mut Place| {
                    exchange(&mut point.values, a, b);
                    exchange(&mut point.directions, a, b);
                };
                if self.mends_at(swapped, pair) {
                    let message = format!("right with {a} and {b} exchanged");
                    let hint = format!("check which is {a} and which {b}");
                    return Some(Diagnosis::new("EXCHANGED", message, hint));
                }
            }
        }
        let right = all.len() > 2 && self.mends(&self.answer.substitute(&all));
        let message = "right with the two bodies exchanged";
        right.then(|| Diagnosis::new("EXCHANGED", message, "check which body is which"))
    }

    /// The answer is the expected formula at a special value of one symbol.
    pub(super) fn special(&self, ctx: &Context) -> Option<Diagnosis> {
        let mine = self.answer.symbols();
        let (mut cases, mut names): (Vec<String>, Vec<String>) = Default::default();
        for name in self.expected.symbols() {
            if mine.contains(&name) {
                continue;
            }
            let [turning, _] = self.turned(&name);
            let other = match turning {
                true => (Expr::pi() * Expr::ratio(1, 2), "90°"),
                false => (Expr::one(), "1"),
            };
            for (value, words) in [(Expr::zero(), "0"), other] {
                let number = ctx.dimension_of(&name).is_none_or(|d| d.is_none());
                if value.is_one() && !number {
                    continue;
                }
                let turning_at_zero = turning && value.is_zero();
                // Nothing is no leading term.
                if turning_at_zero && self.answer.is_zero() {
                    continue;
                }
                if self.is(&self.expected.put(&name, &value))
                    && (turning || self.only_at(&name, &value))
                {
                    if turning_at_zero {
                        let message = format!("right only for small {name} (to leading order)");
                        let hint = format!("the answer should depend on {name}");
                        return Some(Diagnosis::new("SMALL_ANGLE", message, hint));
                    }
                    cases.push(format!("{name} = {words}"));
                    names.push(name.to_string());
                }
            }
        }
        if !cases.is_empty() {
            let message = format!("right only for {}", cases.join(" or "));
            let hint = format!("the answer should depend on {}", names.join(", "));
            return Some(Diagnosis::new("SPECIAL_CASE", message, hint));
        }
        // Two masses taken as equal, and the like.
        let names: Vec<Symbol> = self.expected.symbols().into_iter().collect();
        for a in &names {
            for b in names.iter().filter(|b| *b != a && !mine.contains(*b)) {
                if ctx.dimension_of(a).is_none() || ctx.dimension_of(a) != ctx.dimension_of(b) {
                    continue;
                }
                let other = Expr::symbol(a);
                if self.is(&self.expected.put(b, &other)) && self.only_at(b, &other) {
                    let message = format!("right only for {b} = {a}");
                    let hint = format!("the answer should depend on {b}");
                    return Some(Diagnosis::new("SPECIAL_CASE", message, hint));
                }
            }
        }
        None
    }

    /// The same as an angle goes to zero, up to the first order at which the expected formula varies with it. That two formulas
    /// agree at zero alone says nothing: many wrong ones do.
    pub(super) fn small_angle(&self) -> Option<Diagnosis> {
        if !self.turns {
            return None;
        }
        let both = self.uses.iter().flat_map(|uses| uses.symbols.iter());
        let angles = both.filter(|(_, r)| r.turns).map(|(name, _)| name.clone());
        for name in angles.collect::<BTreeSet<Symbol>>() {
            let (mut e, mut a) = (self.expected.clone(), self.answer.clone());
            for order in 0..=HIGHEST_ORDER {
                let [e0, a0] = [&e, &a].map(|e| e.put(&name, &Expr::zero()));
                let at = |e: &Expr| values(e, &self.points);
                let apart = Trial::apart(&at(&e0), &at(&a0));
                if apart || e.size() > LARGEST || !proved(&e0, &a0, self.domains) {
                    break;
                }
                let nothing = vec![Weighed::from_rational(&ratio(0, 1)); self.points.len()];
                let may_vanish = self.may_be(&nothing, &e0);
                if order > 0 && !(may_vanish && proved(&e0, &Expr::zero(), self.domains)) {
                    let words = format!("right only for small {name}, to leading order");
                    let hint = format!("right only where {name} is small");
                    return Some(Diagnosis::new("SMALL_ANGLE", words, hint));
                }
                (e, a) = (e.derivative(&name), a.derivative(&name));
            }
        }
        None
    }

    /// Whether the answer is right on the domain where a symbol has a value and nowhere else: each part of the difference has one
    /// sign throughout, or grows or falls throughout and vanishes at that value.
    fn only_at(&self, name: &Symbol, value: &Expr) -> bool {
        let domain = self.domains.symbols.get(name);
        let reached = value
            .as_number()
            .is_none_or(|value| domain.map_or(!value.is_negative(), |d| d.admits(to_f64(value))));
        let gap = self.expected - self.answer;
        let Ok((field, x)) = Field::of(&self.domains.of(&[&gap]), &gap) else {
            return false;
        };
        let strict = |e: &Expr| {
            let sign = algebra::sign(e, &self.domains.of(&[&gap, e]));
            sign.is_some_and(algebra::Sign::is_strict)
        };
        let only = |part: &Expr| {
            let vanishes = || proved(&part.put(name, value), &Expr::zero(), self.domains);
            strict(part) || strict(&part.derivative(name)) && vanishes()
        };
        reached && field.zeros(&x).iter().all(|part| only(&field.expr(part)))
    }

    pub(super) fn power(&self) -> Option<Diagnosis> {
        if self.mends_whole(|v| Some(v.times(v)), |e| e.powi(2)) {
            let message = "the square root of the expected value";
            return Some(Diagnosis::new("POWER", message, "a root is too much"));
        }
        let right = self.mends_whole(Weighed::sqrt, Expr::sqrt);
        let message = "the square of the expected value";
        right.then(|| Diagnosis::new("POWER", message, "a root is missing"))
    }
}

/// Words of which any may be meant.
fn any_of(all: impl Iterator<Item = impl ToString>) -> String {
    let all: Vec<String> = all.map(|one| one.to_string()).collect();
    all.join(" or ")
}

/// The values of a formula at some points.
fn values(e: &Expr, points: &[Place]) -> Vec<Weighed> {
    points.iter().map(|point| evaluate(e, point)).collect()
}

/// Exchanges what two names stand for.
fn exchange<T>(values: &mut Table<T>, a: &Symbol, b: &Symbol) {
    let (first, second) = (values.remove(a), values.remove(b));
    values.extend(first.map(|value| (b.clone(), value)));
    values.extend(second.map(|value| (a.clone(), value)));
}
