//! Relations in one symbol: their solutions along its domain, exactly.
//!
//! The zeros of all differences cut the domain into numbers and intervals on which every relation holds or does not. Absolute
//! values are cut where what they are taken of changes sign: on each part they are that or its negative. What is no polynomial
//! is cut in the same way where all zeros have closed forms.

use super::normal::{Cases, holds};
use std::cmp::Ordering;

use super::defined::has_value;
use super::plain::plain;
use super::values::{holds_at, one_turn};
use super::zeros::{Number, number, zeros};
use super::{Normal, differences};
use crate::algebra::{Cell, Field};
use crate::domain::{Domains, Limit, roles};
use crate::equality::{divisors, identical};
use crate::expr::{Expr, Function, Node, Rational, Symbol, ratio};
use crate::interval::Enclosure;

/// Most different absolute values.
const MOST_FOLDED: usize = 3;

/// Where two systems of relations hold.
#[derive(Debug)]
pub(super) struct Along {
    /// A number in words at which the first holds and the second does not.
    pub lost: Option<String>,
    /// The other way round.
    pub gained: Option<String>,
    /// Whether the first holds somewhere, and whether it does not somewhere; the same of the second.
    pub holds: [[bool; 2]; 2],
    /// At how many numbers each holds; `None` where it holds along an interval.
    pub count: [Option<usize>; 2],
}

/// Compares the cases of two answers in one symbol; `None` where there are more, or the differences are no quotients of polynomials in it
/// or in the one square root that it stands under.
pub(super) fn compare(first: &Cases, second: &Cases, domains: &Domains) -> Option<Along> {
    let all = differences(first.iter().flatten(), second.iter().flatten());
    let uses = roles(&all);
    let mut names = uses.symbols.iter();
    let (name, role) = names.next()?;
    if names.next().is_some() {
        return None;
    }
    let (domains, _) = domains.completed(&uses);
    let found = (!role.turns).then(|| by_polynomials(first, second, name, &domains));
    found.flatten().or_else(|| {
        // What stands in sines and cosines alone is the same after a turn.
        let turn = one_turn(&all, name, &domains);
        let mut found = by_zeros(first, second, name, &turn)?;
        if turn != domains {
            found.count = found.count.map(|count| count.filter(|n| *n == 0));
        }
        Some(found)
    })
}

/// The comparison by polynomials, where the functions can be taken out.
fn by_polynomials(
    first: &Cases,
    second: &Cases,
    name: &Symbol,
    domains: &Domains,
) -> Option<Along> {
    if let (Some(first), Some(second)) = (plain(first, domains), plain(second, domains)) {
        return along(&first, &second, name, domains);
    }
    let all = differences(first.iter().flatten(), second.iter().flatten());
    let is_rooted = |part: &Expr| match part.node() {
        Node::Power(base, k) => {
            base.mentions(name) && k.as_number().is_some_and(|k| !k.is_integer())
        }
        _ => false,
    };
    let rooted = all.iter().any(|e| e.parts().any(is_rooted));
    (!rooted).then(|| along(first, second, name, domains))?
}

/// The comparison by the numbers at which a difference may change its sign, or have no value, where all these are known in closed form.
fn by_zeros(first: &Cases, second: &Cases, name: &Symbol, domains: &Domains) -> Option<Along> {
    let mut numbers: Vec<Number> = Vec::new();
    for e in differences(first.iter().flatten(), second.iter().flatten()) {
        let mut all = vec![e.clone()];
        for part in e.parts().filter(|part| !part.is_constant()) {
            all.extend(has_value(part)?.map(|need| need.difference));
        }
        for number in all
            .iter()
            .map(|e| zeros(e, name, domains))
            .collect::<Option<Vec<_>>>()?
            .concat()
        {
            match numbers.iter().find(|(_, at)| !at.is_disjoint(&number.1)) {
                Some((other, _)) if identical(other, &number.0, domains) => {}
                Some(_) => return None,
                None => numbers.push(number),
            }
        }
    }
    numbers.sort_by(|a, b| a.1.low.cmp(&b.1.low));
    let domain = domains.symbols.get(name)?;
    let end = |limit: &Option<Limit>| match limit {
        Some(limit) => number(&limit.expr()).map(Some),
        None => Some(None),
    };
    let [low, high] = [end(&domain.low)?, end(&domain.high)?];
    // Every number with one of the gap before it, and one behind the last.
    let mut out = Along::nowhere();
    let mut before = low;
    for next in numbers.into_iter().map(Some).chain([None]) {
        let is_last = next.is_none();
        let next = next.or_else(|| high.clone());
        if let Some(at) = between(before.as_ref(), next.as_ref(), domains)? {
            let at = Expr::from(at);
            let place = number(&at)?.1.decimal(6);
            out.note(
                [first, second],
                |n| holds_at(n, name, &at, domains),
                || format!("{name} = {place}"),
                false,
            )?;
        }
        if let Some((at, place)) = next.as_ref().filter(|_| !is_last) {
            let words = || match at.as_number() {
                Some(at) => format!("{name} = {at}"),
                None => format!("{name} = {}", place.decimal(6)),
            };
            out.note(
                [first, second],
                |n| holds_at(n, name, at, domains),
                words,
                true,
            )?;
        }
        before = next;
    }
    Some(out)
}

/// A fraction between two numbers, or beside one; nothing between a number and itself. `None` where it is not known whether they
/// are the same.
fn between(
    low: Option<&Number>,
    high: Option<&Number>,
    domains: &Domains,
) -> Option<Option<Rational>> {
    Some(match (low, high) {
        (Some(low), Some(high)) if !low.1.is_disjoint(&high.1) => {
            identical(&low.0, &high.0, domains).then_some(None)?
        }
        (Some((_, low)), Some((_, high))) => {
            Some((low.high.to_rational() + high.low.to_rational()) * ratio(1, 2))
        }
        (Some((_, low)), None) => Some(low.high.to_rational().ceil() + ratio(1, 1)),
        (None, Some((_, high))) => Some(high.low.to_rational().floor() - ratio(1, 1)),
        (None, None) => Some(ratio(0, 1)),
    })
}

impl Along {
    fn nowhere() -> Along {
        Along {
            lost: None,
            gained: None,
            holds: [[false; 2]; 2],
            count: [Some(0); 2],
        }
    }

    /// Takes in a number, or an interval by one of its numbers, with what holds there.
    fn note(
        &mut self,
        both: [&Cases; 2],
        mut holds: impl FnMut(&Normal) -> Option<bool>,
        words: impl Fn() -> String,
        single: bool,
    ) -> Option<()> {
        let mut truth = [false; 2];
        for (cases, truth) in both.into_iter().zip(&mut truth) {
            for system in cases {
                let mut all = true;
                for n in system {
                    all &= holds(n)?;
                }
                *truth |= all;
            }
        }
        for (seen, truth) in self.holds.iter_mut().zip(truth) {
            seen[usize::from(!truth)] = true;
        }
        for (count, _) in self.count.iter_mut().zip(truth).filter(|(_, holds)| *holds) {
            *count = count.filter(|_| single).map(|n| n + 1);
        }
        match truth {
            [true, false] => self.lost = self.lost.take().or_else(|| Some(words())),
            [false, true] => self.gained = self.gained.take().or_else(|| Some(words())),
            _ => {}
        }
        Some(())
    }
}

/// The comparison along the domain of the symbol.
fn along(first: &Cases, second: &Cases, name: &Symbol, domains: &Domains) -> Option<Along> {
    let all = differences(first.iter().flatten(), second.iter().flatten());
    // The differences for every choice of signs, then what absolute values are taken of.
    let folded = folded(&all)?;
    let choices = (0..1 << folded.len()).flat_map(|signs| {
        let folded = &folded;
        all.iter().map(move |e| unfolded(e, folded, signs))
    });
    // And what each divides by, which a normal form may have cancelled.
    let divisors: Vec<Vec<Expr>> = all.iter().map(|e| plain_divisors(e, domains)).collect();
    let others = folded.iter().chain(divisors.iter().flatten()).cloned();
    let choices: Vec<Expr> = choices.chain(others).collect();
    let mut field = Field::new(domains);
    field.prepare(&choices);
    let elements: Option<Vec<_>> = choices.iter().map(|e| field.element(e).ok()).collect();
    let mut cells = field.signs_along(name, &elements?)?;
    for cell in &mut cells {
        let mut arguments = cell.signs.split_off(all.len() << folded.len());
        let mut below = arguments.split_off(folded.len()).into_iter();
        let signs = arguments.iter().enumerate().try_fold(0, |signs, (k, s)| {
            Some(signs | usize::from(s.as_ref()?.is_lt()) << k)
        })?;
        cell.signs.drain(..signs * all.len());
        for (sign, divisors) in cell.signs.iter_mut().zip(&divisors) {
            let own: Vec<_> = below.by_ref().take(divisors.len()).collect();
            if own.iter().any(|below| below.is_none_or(Ordering::is_eq)) {
                *sign = None;
            }
        }
    }
    let mut out = Along::nowhere();
    for cell in &cells {
        // In the order of the differences.
        let mut signs = cell.signs[..all.len()].iter();
        let next = |n: &Normal| Some(holds(n.relation, *signs.next()?));
        out.note(
            [first, second],
            next,
            || words(cell, name, &all),
            cell.single,
        )?;
    }
    Some(out)
}

/// What a formula divides by, where no function takes part.
fn plain_divisors(e: &Expr, domains: &Domains) -> Vec<Expr> {
    let mut all = divisors(e, domains);
    all.retain(Expr::is_rational);
    all
}

/// What absolute values are taken of; `None` where these are too many or one stands inside another.
fn folded(all: &[&Expr]) -> Option<Vec<Expr>> {
    let argument = |part: &Expr| match part.node() {
        Node::Call(Function::Abs, x) => Some(x.clone()),
        _ => None,
    };
    let all = all.iter().flat_map(|e| e.parts());
    let mut out: Vec<Expr> = all.filter_map(argument).collect();
    out.sort();
    out.dedup();
    let nested = |x: &Expr| x.parts().any(|part| argument(part).is_some());
    let plain = out.len() <= MOST_FOLDED && !out.iter().any(nested);
    plain.then_some(out)
}

/// A formula with each absolute value taken as what stands inside, or as its negative where the bit is set.
fn unfolded(e: &Expr, folded: &[Expr], signs: usize) -> Expr {
    let arguments = folded.iter().enumerate();
    arguments.fold(e.clone(), |e, (k, x)| {
        let branch = if signs >> k & 1 == 1 { -x } else { x.clone() };
        e.replace(&Expr::call(Function::Abs, x.clone()), &branch)
    })
}

/// A number of the cell: the root itself where that is a whole number of twelfths.
fn words(cell: &Cell, name: &Symbol, all: &[&Expr]) -> String {
    let twelve = ratio(12, 1);
    let root = (&cell.around[1] * &twelve).floor() / twelve;
    let vanishes = |e: &&Expr| e.put(name, &Expr::from(root.clone())).is_zero();
    if cell.single && root >= cell.around[0] && all.iter().any(vanishes) {
        return format!("{name} = {root}");
    }
    let [low, high] = &cell.around;
    let short = |x: &Rational| x.denom().bits() < 20;
    let value = match low == high && short(low) {
        true => low.to_string(),
        false => {
            let [low, high] = [low, high].map(|x| Enclosure::of(x, 64));
            Enclosure::new(low.low, high.high).decimal(6)
        }
    };
    format!("{name} = {value}")
}
