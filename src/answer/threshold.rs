//! For which values of a parameter an inequality between answers holds, and for which an equation does.
//!
//! In: both sides in parameters alone. Out: the value at which they meet, on which side of it the inequality holds, and how
//! that is known; or that it always or never holds, with the reason.

mod elsewhere;

use std::collections::BTreeSet;

use super::Check;
use super::calc::{
    Seen, above_zero, beyond_zero, by_signs, essential, is_zero, keeps_to, sign, tidy,
};
use super::inequality::{everywhere, sign_words};
use super::intervals::beside;
use super::isolate::isolate;
use super::solve::{Root, Roots, Unsolved, end_of, solve};
use super::{Answer, Form, intervals, limit, undo};
use crate::algebra::Sign;
use crate::domain::{Domains, Limit, Origin};
use crate::expr::{Expr, Node, Symbol};
use crate::formula::Relation;
use crate::formula::{Sentence, sentence};
use crate::scene::Scene;
use elsewhere::{otherwise, unreal};

/// Largest value, in nodes, that a condition names.
const SHORT: usize = 8;

/// Fills in the answer.
pub(super) fn fill(
    out: &mut Answer,
    parameter: &Symbol,
    left: &Expr,
    relation: Relation,
    right: &Expr,
    scene: &Scene,
) {
    let domains = &scene.domains;
    let gap = left - right;
    let gap = tidy(&gap, domains).unwrap_or(gap);
    let whole = gap.clone();
    let (gap, domains) = match undo::outermost(&gap, parameter, domains) {
        Some(inner) => {
            out.assumptions.extend(inner.given);
            (inner.gap, &inner.domains.clone())
        }
        None => (gap, domains),
    };
    let upward = matches!(relation, Relation::Greater | Relation::GreaterEqual);
    let under = radicand(&gap, parameter, domains).filter(|_| upward);
    let (gap, rooted) = (under.clone().unwrap_or(gap), under.is_some());
    let called = match () {
        () if gap != whole => "it hangs on {}, which is",
        () if right.is_zero() => "the left side is {}, which is",
        () => "left side minus right side is {}, which is",
    };
    let roots = solve(&gap, parameter, domains);
    let real = roots.as_ref().ok().filter(|_| relation != Relation::Equal);
    let real = real.and_then(|found| where_real(found, domains));
    let whole_domains = domains;
    let (roots, domains) = match &real {
        Some(Wanted { granted, told, .. }) => {
            out.assumptions.extend(told.iter().cloned());
            (solve(&gap, parameter, granted), granted)
        }
        None => (roots, domains),
    };
    let roots = match roots {
        Ok(roots) => roots,
        Err(why) => {
            if matches!(why, Unsolved::Absent) && reached(out, parameter, (&gap, relation), domains)
            {
                return;
            }
            out.text.push(match why {
                Unsolved::Absent => always(&gap, Some(parameter), called, relation, domains),
                Unsolved::Inside => {
                    sentence!("not solved: {} stands inside a function", parameter)
                }
                Unsolved::Limit(what) => sentence!("not solved: {}", what),
            });
            return;
        }
    };
    out.discarded = roots.discarded.clone();
    if !roots.open.is_empty() {
        isolate(out, parameter, &gap, &roots, scene);
        return;
    }
    if roots.inside.is_empty() {
        if reached(out, parameter, (&gap, relation), domains) {
            return;
        }
        let rest = essential(&gap, domains);
        let idle = !rest.symbols().contains(parameter);
        out.text.push(match relation {
            Relation::Equal if idle && rest.as_number().is_none() => {
                let [unless, else_all] = [" does, unless ", " = 0, when every value does"];
                sentence!("no value of {}{}{}{}", parameter, unless, &rest, else_all)
            }
            Relation::Equal if !roots.discarded.is_empty() && !sign(&gap, domains).is_proved() => {
                Sentence::words("no solution: each value that solves it is discarded")
            }
            _ => {
                let whatever = idle.then_some(parameter);
                always(&gap, whatever, called, relation, domains)
            }
        });
        return;
    }
    meet(out, parameter, relation, [left, right], &roots);
    out.needs.extend(real.iter().flat_map(|r| r.needs(&roots)));
    if relation == Relation::Equal {
        return values(out, (&gap, parameter), &roots, domains);
    }
    sides(out, parameter, &gap, relation, &roots, domains);
    if let ([root], false) = (roots.inside.as_slice(), out.range.is_empty()) {
        otherwise(out, parameter, &gap, relation, root, domains);
    }
    if let (Some(real), false) = (&real, out.range.is_empty()) {
        unreal(out, parameter, &gap, relation, real, whole_domains);
    }
    if rooted {
        under_the_root(out);
    }
}

/// The bound of what always holds where the motions before come to their ends: from there on they do. Whether there is one.
fn reached(
    out: &mut Answer,
    parameter: &Symbol,
    (gap, relation): (&Expr, Relation),
    domains: &Domains,
) -> bool {
    let seen = sign(gap, domains);
    if !seen.is_proved() || everywhere(seen, relation) != Some(true) {
        return false;
    }
    let mut apart = domains.clone();
    let is_one = |r: &crate::domain::Relation| {
        matches!(r.origin, Origin::Ending(_)) && r.excess.mentions(parameter)
    };
    apart.relations.retain(|r| !is_one(r));
    let ends: Vec<_> = domains.relations.iter().filter(|r| is_one(r)).collect();
    let bound = |r: &&crate::domain::Relation| {
        let (_, is_upper) = end_of(parameter, r, &apart)?;
        let found = solve(&r.excess, parameter, &apart).ok()?;
        let [root] = found.inside.as_slice() else {
            return None;
        };
        root.proved.then(|| (root.clone(), is_upper))
    };
    let Some(bounds) = ends.iter().map(bound).collect::<Option<Vec<_>>>() else {
        return false;
    };
    let is_upper = bounds.first().is_some_and(|(_, upper)| *upper);
    // Of several the one at which all the others hold.
    let is_last = |(root, upper): &&(Root, bool)| {
        let there = |e: &Expr| e.put(parameter, &root.value);
        let at = bounds.iter().zip(&ends);
        let mut others = at.filter(|((other, _), _)| other.value != root.value);
        *upper == is_upper
            && others.all(|(_, r)| keeps_to(&there(&r.excess), true, &apart) == Some(true))
    };
    let Some(last) = bounds.iter().position(|bound| is_last(&bound)) else {
        return false;
    };
    let root = &bounds[last].0;
    // What is to be solved is that the motion comes to its end.
    let (need, closed) = (ends[last].excess.clone(), ends[last].closed);
    let (below, above) = match closed {
        true => (Relation::LessEqual, Relation::GreaterEqual),
        false => (Relation::Less, Relation::Greater),
    };
    out.stated = Some((need, above, Expr::zero()));
    let side = if is_upper { below } else { above };
    let needs = root.needs.iter().cloned();
    out.needs
        .extend(needs.map(|(e, closed)| (root.value.clone(), e, closed)));
    out.assumptions.extend(root.given.iter().cloned());
    out.form = Form::value(root.value.clone());
    out.range
        .push((Expr::symbol(parameter), side, root.value.clone()));
    let there = match (is_upper, closed) {
        (true, true) => "up to there",
        (true, false) => "below",
        (false, true) => "from there on",
        (false, false) => "above",
    };
    let wherever = "it holds wherever the motion comes to its end, which it does";
    out.text.push(sentence!("{} {}", wherever, there));
    let words = "the sign of the difference is proved wherever the motion comes to its end";
    out.checks.push(Check::new("sign", words, Some(true)));
    true
}

/// The values at which both sides are the same.
fn values(out: &mut Answer, (gap, parameter): (&Expr, &Symbol), roots: &Roots, domains: &Domains) {
    exists(out, Some((gap, parameter)), roots, domains);
    let values = roots.inside.iter().map(|root| root.value.clone());
    let at = |value| (Expr::symbol(parameter), Relation::Equal, value);
    out.range.extend(values.map(at));
    if let [root] = roots.inside.as_slice() {
        out.form = Form::value(root.value.clone());
    } else {
        let count = roots.inside.len().to_string();
        out.text.push(sentence!("{} solutions", count));
    }
}

/// Lets what was found of the sides say that it is so of what stands under a root.
fn under_the_root(out: &mut Answer) {
    for check in out.checks.iter_mut().filter(|c| c.kind == "sign") {
        let under = "what stands under the root has opposite signs";
        let plain = "the sides differ with opposite signs";
        check.words = check.words.replace(plain, under);
    }
}

/// What stands under the root where a difference is a root, but for positive factors: it is there, and not negative, just
/// where that is not negative. Factors that may vanish whatever the parameter is stay beside it.
fn radicand(gap: &Expr, parameter: &Symbol, domains: &Domains) -> Option<Expr> {
    let core = essential(gap, domains);
    let factors = core.factors();
    let is_idle = |f: &&Expr| !f.mentions(parameter) && sign(f, domains).side() == Some(true);
    let (idle, rest): (Vec<&Expr>, Vec<&Expr>) = factors.iter().partition(is_idle);
    let [root] = rest.as_slice() else {
        return None;
    };
    let base = root.under_root()?;
    Some(Expr::product(idle.into_iter().chain([base]).cloned()))
}

/// That both sides are the same at the values that were found.
fn meet(
    out: &mut Answer,
    parameter: &Symbol,
    relation: Relation,
    sides: [&Expr; 2],
    roots: &Roots,
) {
    for root in &roots.inside {
        if root.proved {
            let [left, right] = sides.map(|side| root.put_in(side, parameter));
            let why = "both sides with the value substituted";
            out.put_in.push((left, right, why));
        }
        let needs = root.needs.iter().cloned();
        let needs = needs.map(|(e, closed)| (root.value.clone(), e, closed));
        out.needs.extend(needs);
        let given = root.given.iter().map(|given| {
            let is_shared = roots.inside.iter().all(|r| r.given.contains(given));
            // Where the answer is a range, its end alone keeps to what is told of the parameter.
            let of_end = relation != Relation::Equal
                && root.value.size() <= SHORT
                && !given.to_string().ends_with(" domain");
            match is_shared {
                true if of_end => sentence!("{} for {} = {}", given, parameter, &root.value),
                true => given.clone(),
                false => sentence!("{}, for {} = {}", given, parameter, &root.value),
            }
        });
        out.assumptions.extend(given);
        let words = match root.proved {
            true => "with the value substituted, both sides are identical",
            false => "whether both sides meet at this value was not proved",
        };
        let holds = root.proved.then_some(true);
        out.checks.push(Check::new("identity", words, holds));
    }
}

/// What is wanted so that values are real.
struct Wanted {
    /// What is to be positive.
    cores: Vec<Expr>,
    /// The same in words.
    told: Vec<Sentence>,
    /// The domains on which it is.
    granted: Domains,
}

impl Wanted {
    /// What makes a value real is needed as what places it is.
    fn needs(&self, roots: &Roots) -> Vec<(Expr, Expr, bool)> {
        let each = |root: &Root| {
            let cores = self.cores.iter().cloned();
            let value = root.value.clone();
            cores.map(move |core| (value.clone(), core, false))
        };
        roots.inside.iter().flat_map(each).collect()
    }
}

/// What must be positive under the roots of the values; `None` where that is sure.
fn where_real(roots: &Roots, domains: &Domains) -> Option<Wanted> {
    let mut granted = domains.clone();
    let (mut cores, mut told) = (Vec::new(), Vec::new());
    for part in roots.inside.iter().flat_map(|root| root.value.parts()) {
        let under = match part.node() {
            Node::Power(base, k) if k.as_number().is_some_and(|k| !k.is_integer()) => base,
            _ => continue,
        };
        let core = essential(under, &granted);
        let seen = sign(&core, &granted);
        let divides = |part: &Expr| match part.node() {
            Node::Power(base, k) => k.is_negative() && essential(base, &granted) == core,
            _ => false,
        };
        // What has a sign by itself is real, or is not; divided by zero it is none.
        match seen {
            _ if core.is_constant() => continue,
            Seen::Proved(Sign::NotNegative) if under.parts().any(divides) => {}
            Seen::Proved(_) => continue,
            _ => {
                told.push(above_zero(&core, &granted));
                cores.push(core.clone());
            }
        }
        granted = granted.given(&core, false);
    }
    (granted != *domains).then_some(Wanted {
        cores,
        told,
        granted,
    })
}

/// On which side of the root the inequality holds.
fn sides(
    out: &mut Answer,
    parameter: &Symbol,
    gap: &Expr,
    relation: Relation,
    roots: &Roots,
    domains: &Domains,
) {
    let domains = &exists(out, Some((gap, parameter)), roots, domains);
    let gap = &without_idle(out, parameter, gap, domains);
    if let Some(words) = jumps(gap, parameter, domains) {
        let values = roots.inside.iter().map(|r| Sentence::from(&r.value));
        let meet = sentence!("the sides meet at {} = ", parameter);
        let values = Sentence::join(values, " and at ");
        out.text.push(sentence!(
            "{}{}; {}, so that it is not told where it holds",
            meet,
            values,
            words
        ));
        if let [root] = roots.inside.as_slice() {
            out.form = Form::value(root.value.clone());
        }
        return;
    }
    let [root] = roots.inside.as_slice() else {
        return intervals::fill(out, parameter, gap, relation, &roots.inside, domains);
    };
    let value = &root.value;
    let domain = domains.of_symbol(parameter);
    let [below, above] = match slope(&essential(gap, domains), parameter, domains) {
        Some(slope) => [Seen::Proved(slope.flip()), Seen::Proved(slope)],
        None => [(&domain.low, -1), (&domain.high, 1)]
            .map(|(end, way)| beside(gap, parameter, value, end.as_ref(), way, domains)),
    };
    // All zeros are known: what is not negative beside them is positive.
    let is_up = |side: Seen| side.is_positive() || side == Seen::Proved(Sign::NotNegative);
    let is_down = |side: Seen| side.is_negative() || side == Seen::Proved(Sign::NotPositive);
    // Where the domain begins or ends at the value, the other side decides.
    let is_empty = |side: Seen| side == Seen::Proved(Sign::Zero);
    let both_empty = is_empty(below) && is_empty(above);
    let falls = (is_up(below) || is_empty(below)) && (is_down(above) || is_empty(above));
    let grows = (is_down(below) || is_empty(below)) && (is_up(above) || is_empty(above));
    let [falls, grows] = [falls, grows].map(|goes| goes && !both_empty);
    let [holds_below, holds_above] = match relation.is_below() {
        true => [grows, falls],
        false => [falls, grows],
    };
    let strict = matches!(relation, Relation::Less | Relation::Greater);
    let is_ending = |r: &crate::domain::Relation| matches!(r.origin, Origin::Ending(_));
    let ends = |upper: bool| {
        let own = if upper { &domain.high } else { &domain.low };
        let own = own
            .as_ref()
            .map(|end| is_zero(&(value - &end.expr()), domains));
        own == Some(Some(true)) || bound_at(parameter, value, upper, domains, |r| !is_ending(r))
    };
    if holds_below && ends(false) || holds_above && ends(true) {
        return at_the_end(out, parameter, value, strict);
    }
    // Where a motion comes to its end just up to there, what is asked of it has a value beyond.
    let unfinished = |upper| bound_at(parameter, value, upper, domains, is_ending);
    if holds_below && unfinished(false) || holds_above && unfinished(true) {
        let words = "there the motion does not come to its end";
        out.text.push(Sentence::words(words));
    }
    let found = match strict {
        true if holds_below => Some(Relation::Less),
        false if holds_below => Some(Relation::LessEqual),
        true if holds_above => Some(Relation::Greater),
        false if holds_above => Some(Relation::GreaterEqual),
        _ => None,
    };
    out.form = Form::value(value.clone());
    match found {
        Some(relation) => {
            out.range
                .push((Expr::symbol(parameter), relation, value.clone()));
            let proved = below.is_proved() && above.is_proved();
            let words = "below and above that value the sides differ with opposite signs ({how}), and there is no other value at which they meet";
            out.checks.push(by_signs("sign", words, proved));
        }
        None => intervals::fill(out, parameter, gap, relation, &roots.inside, domains),
    }
}

/// Whether one of these relations ends the values of a parameter at one, from above or from below.
fn bound_at(
    parameter: &Symbol,
    value: &Expr,
    upper: bool,
    domains: &Domains,
    counts: impl Fn(&crate::domain::Relation) -> bool,
) -> bool {
    let bounds = domains.relations.iter();
    let bounds = bounds.filter(|r| counts(r) && r.excess.mentions(parameter));
    let mut ends = bounds.filter_map(|r| end_of(parameter, r, domains));
    ends.any(|(end, is_upper)| is_upper == upper && is_zero(&(value - &end), domains) == Some(true))
}

/// The sides meet at the end of the domain beyond which the inequality would hold: it holds there alone, or nowhere.
fn at_the_end(out: &mut Answer, parameter: &Symbol, value: &Expr, strict: bool) {
    if strict {
        out.form = Form::Words;
        out.put_in.clear();
        out.checks.clear();
        out.text.push(sentence!(
            "it never holds: the sides meet at {} = {}, where the domain ends",
            parameter,
            value
        ));
    } else {
        out.form = Form::value(value.clone());
        out.range
            .push((Expr::symbol(parameter), Relation::Equal, value.clone()));
        out.text.push(Sentence::words(
            "it holds there alone, where the domain ends",
        ));
    }
}

/// The sign of the slope of a difference without poles, where it is proved and never zero: it only grows or only falls wherever it
/// has a value.
fn slope(gap: &Expr, parameter: &Symbol, domains: &Domains) -> Option<Sign> {
    // Without a common denominator poles were not looked for.
    limit::common(gap, domains)?;
    match sign(&gap.derivative(parameter), domains) {
        Seen::Proved(sign @ (Sign::Positive | Sign::Negative)) => Some(sign),
        _ => None,
    }
}

/// The difference without factors that are the same for every value of the parameter, and positive where they are not zero: there
/// both sides are the same.
fn without_idle(out: &mut Answer, parameter: &Symbol, gap: &Expr, domains: &Domains) -> Expr {
    let core = essential(gap, domains);
    let Node::Product(factors) = core.node() else {
        return gap.clone();
    };
    let is_idle = |f: &Expr| {
        let seen = sign(f, domains);
        !f.mentions(parameter) && seen == Seen::Proved(Sign::NotNegative)
    };
    let (idle, rest): (Vec<Expr>, Vec<Expr>) = factors.iter().cloned().partition(is_idle);
    if idle.is_empty() {
        return gap.clone();
    }
    for factor in &idle {
        let needed = sentence!("{} > 0 (otherwise both sides are the same)", factor);
        out.assumptions.push(needed);
    }
    Expr::product(rest)
}

/// The domains within which there are such values: a symbol they are divided by is at no end where that vanishes, and all is so
/// that each of them needs. With the difference that is zero at them, and what of, it tells where there are others at that end.
pub(super) fn exists(
    out: &mut Answer,
    zero: Option<(&Expr, &Symbol)>,
    roots: &Roots,
    domains: &Domains,
) -> Domains {
    let mut domains = domains.clone();
    let values = roots.inside.iter().map(|r| &r.value);
    let symbols: BTreeSet<Symbol> = values.flat_map(Expr::symbols).collect();
    for (symbol, is_low) in symbols.iter().flat_map(|s| [(s, true), (s, false)]) {
        let Some(end) = end_of_domain(&mut domains, symbol, is_low).cloned() else {
            continue;
        };
        let at_end = Expr::from(end.value.clone());
        if end.open || end.of_pi {
            continue;
        }
        let lost = |r: &&Root| tidy(&r.value.put(symbol, &at_end), &domains).is_err();
        let lost: Vec<&Root> = roots.inside.iter().filter(lost).collect();
        if lost.is_empty() {
            continue;
        }
        if let Some(end) = end_of_domain(&mut domains, symbol, is_low) {
            end.open = true;
        }
        let own = Expr::symbol(symbol);
        let inside = match is_low {
            true => &own - &at_end,
            false => &at_end - &own,
        };
        let needs = lost
            .iter()
            .map(|r| (r.value.clone(), inside.clone(), false));
        // That it lies within its domain may say so already.
        let is_new = |need: &(Expr, Expr, bool)| !out.needs.contains(need);
        let needs: Vec<_> = needs.filter(is_new).collect();
        if needs.is_empty() {
            continue;
        }
        out.needs.extend(needs);
        let beyond = if is_low { " > " } else { " < " };
        let others = zero.and_then(|(gap, of)| {
            let gap = tidy(&gap.put(symbol, &at_end), &domains).ok()?;
            let found = solve(&gap, of, &domains).ok()?;
            let is_one = !found.inside.is_empty() || !found.open.is_empty();
            is_one.then(|| {
                found
                    .inside
                    .iter()
                    .map(|r| r.value.clone())
                    .collect::<Vec<_>>()
            })
        });
        let otherwise = match (others, zero) {
            (Some(values), Some((_, of))) if !values.is_empty() => {
                let values = Sentence::join(values.iter().map(Sentence::from), " or ");
                sentence!("at {} = {} it is {} = {}", symbol, &at_end, of, values)
            }
            (Some(_), _) => sentence!("at {} = {} it is another value", symbol, &at_end),
            (None, _) => sentence!("otherwise there is no such value"),
        };
        out.assumptions
            .push(sentence!("{}{}{} ({})", symbol, beyond, &at_end, otherwise));
    }
    let [first, rest @ ..] = roots.inside.as_slice() else {
        return domains;
    };
    let needs = first.needs.iter();
    let needs = needs.filter(|need| rest.iter().all(|root| root.needs.contains(need)));
    needs.fold(domains, |all, (e, closed)| all.given(e, *closed))
}

/// The lower or the upper end of the domain of a symbol.
fn end_of_domain<'d>(
    domains: &'d mut Domains,
    symbol: &Symbol,
    is_low: bool,
) -> Option<&'d mut Limit> {
    let domain = domains.symbols.get_mut(symbol)?;
    match is_low {
        true => domain.low.as_mut(),
        false => domain.high.as_mut(),
    }
}

/// Words for a difference that has no value somewhere, and may change its sign there without being zero.
fn jumps(gap: &Expr, parameter: &Symbol, domains: &Domains) -> Option<Sentence> {
    let (_, below) = limit::common(gap, domains)?;
    if let Seen::Proved(Sign::Positive | Sign::Negative) = sign(&below, domains) {
        return None;
    }
    match solve(&below, parameter, domains) {
        Ok(poles) if poles.open.is_empty() && poles.inside.is_empty() => None,
        Err(Unsolved::Absent) => None,
        Ok(poles) if poles.open.is_empty() => {
            let places = poles.inside.iter().map(|r| Sentence::from(&r.value));
            let places = Sentence::join(places, " and ");
            Some(sentence!(
                "their difference has no value at {} = {}",
                parameter,
                places
            ))
        }
        _ => Some("their difference may have no value elsewhere".into()),
    }
}

/// Words for an inequality without a threshold, `whatever` a parameter is that has no part in it; what decides it is `called` so.
fn always(
    gap: &Expr,
    whatever: Option<&Symbol>,
    called: &'static str,
    relation: Relation,
    domains: &Domains,
) -> Sentence {
    let s = sign(gap, domains);
    let difference = Sentence::filled(called, [gap.into()]);
    let reason = |what: &str| match gap.is_zero() {
        true => sentence!("both sides are the same"),
        false => sentence!("{} {} on the whole domain", &difference, what),
    };
    let sign_words = sign_words(s);
    let words = match everywhere(s, relation) {
        Some(true) if s.is_proved() => sentence!("it always holds: {}", reason(sign_words)),
        Some(false) if s.is_proved() => sentence!("it never holds: {}", reason(sign_words)),
        Some(_) => {
            let seen = format!("{sign_words} at the points tried");
            sentence!("not decided: {} {}", &difference, seen)
        }
        None if relation != Relation::Equal && whatever.is_some() => {
            let strict = matches!(relation, Relation::Less | Relation::Greater);
            let turned = match relation.is_below() {
                true => -gap,
                false => gap.clone(),
            };
            sentence!("it holds where {}", beyond_zero(&turned, domains, strict))
        }
        None => sentence!("not decided: {}", reason(sign_words)),
    };
    match whatever {
        Some(parameter) => sentence!("{}, whatever {} is", words, parameter),
        None => words,
    }
}
