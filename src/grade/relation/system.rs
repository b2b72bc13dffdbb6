//! Several relations at once: chains, components of vectors, and whatever is in one symbol only.

use super::super::context::Context;
use super::super::{Apart, Grade, Verdict};
use super::cells::{self, Along};
use super::defined::only_symbol;
use super::locus::Extent;
use super::locus::by_sign;
use super::normal::{Cases, equations_alone};
use super::solved::{rounded, solve_for, unknowns};
use super::told::{GAINED, LOST, OTHER, OTHER_NUMBERS, holding, told};
use super::undone::{self, called};
use super::values::{hole, main};
use super::{
    Normal, REALS, apart_at_points, differences, link, not_zero, over_reals, same_solutions,
    says_nothing, sign_of, undecided, where_defined,
};
use crate::algebra::Sign;
use crate::domain::{Domain, Domains, roles};
use crate::equality::{self, Equality, How};
use crate::expr::{Expr, Function, Node, Symbol};
use crate::formula::{Relation, write_plain};
use crate::interval::{Big, Outcome, evaluate};
use num_traits::{Signed, Zero};
use std::collections::BTreeMap;
use std::slice::from_ref;

/// The verdict on relations in one symbol, whose solutions are found, in one case or several.
pub(super) fn in_one_symbol(
    ctx: &Context,
    expected: &Cases,
    answer: &Cases,
    domains: &Domains,
) -> Option<Grade> {
    let along = cells::compare(expected, answer, domains)?;
    let [[some, not_all], [mine, not_mine]] = along.holds;
    if along.lost.is_some() || along.gained.is_some() {
        return Some(apart(ctx, expected, answer, &along));
    }
    if some && not_all {
        return Some(same_solutions(
            "the two hold at the same numbers of the domain",
        ));
    }
    debug_assert!(some == mine && not_all == not_mine);
    let [mine, theirs] = [expected, answer].map(|cases| cases.concat());
    let all = differences(&mine, &theirs);
    let along = cells::compare(expected, answer, &over_reals(domains, &all))?;
    match along.holds {
        [[false, _], [false, _]] => return Some(says_nothing("has no solution")),
        [[_, false], [_, false]] => return Some(says_nothing("holds everywhere")),
        _ => {}
    }
    let here = match some {
        true => "both hold everywhere on the domain",
        false => "neither has a solution on the domain",
    };
    if along.lost.is_none() && along.gained.is_none() {
        let words = format!("{here}: {REALS}, the two hold at the same numbers");
        return Some(same_solutions(&words).given(REALS));
    }
    // Different beyond a domain on which both always hold is not different on it.
    if some {
        let words = format!("{here}; over the reals they part");
        return Some(undecided(&words));
    }
    let mut finding = apart(ctx, expected, answer, &along);
    finding.proof.words = format!("{here}: {REALS}, {}", finding.proof.words);
    Some(finding.given(REALS))
}

/// The verdict on relations in two symbols, one of them positive, that hold of all multiples of what they hold of: that one
/// is 1.
pub(super) fn scaled(ctx: &Context, expected: &[Normal], answer: &[Normal]) -> Option<Grade> {
    let all = differences(expected, answer);
    let uses = roles(&all);
    let (domains, _) = ctx.domains().completed(&uses);
    let whole = |name: &Symbol| {
        let domain = domains.symbols.get(name);
        domain.is_none_or(|d| d.ends().all(|l| l.value.is_zero()))
    };
    let bare = uses.symbols.values().all(|role| !role.turns);
    let free = bare && domains.relations.is_empty();
    if uses.symbols.len() != 2 || !free || !uses.symbols.keys().all(whole) {
        return None;
    }
    let positive = |name: &&Symbol| domains.symbols.get(*name) == Some(&Domain::positive());
    let unit = uses.symbols.keys().find(positive)?;
    let other = uses.symbols.keys().find(|name| *name != unit)?;
    let scale = Expr::symbol(unit);
    let fixed = |n: &Normal| {
        let difference = n.difference.put(unit, &Expr::one());
        let there = n.difference.put(other, &(&scale * &Expr::symbol(other)));
        let power = |k: i64| {
            let same = equality::decide(&there, &(&difference * &scale.powi(k)), &domains);
            matches!(same.equality, Equality::Same { how: How::Identity { assumptions, .. } }
                if assumptions.is_empty())
        };
        (-2..=4).any(power).then(|| n.of(difference.clone()))
    };
    let systems = [expected, answer].map(|s| s.iter().map(fixed).collect::<Option<Vec<_>>>());
    let [Some(expected), Some(answer)] = systems else {
        return None;
    };
    let mut finding = in_one_symbol(ctx, &[expected], &[answer], &domains)?;
    if let Some(apart) = &mut finding.counterexample {
        apart.at = format!("{unit} = 1, {}", apart.at);
    }
    Some(finding)
}

/// The verdict on relations in two real symbols, one of which an equation of one side gives by the other, where every case of
/// the other side gives it as well: what is left is about one symbol.
pub(super) fn with_one_given(ctx: &Context, expected: &Cases, answer: &Cases) -> Option<Grade> {
    let domains = ctx.domains();
    let all = differences(expected.iter().flatten(), answer.iter().flatten());
    let uses = roles(&all);
    let real = |name: &Symbol| domains.symbols.get(name) == Some(&Domain::real());
    let plain = domains.relations.is_empty() && uses.symbols.keys().all(real);
    if uses.symbols.len() != 2 || !plain {
        return None;
    }
    let ([one], others) = (match expected {
        [_] => (expected, answer),
        _ => (answer, expected),
    }) else {
        return None;
    };
    let fixed = |n: &Normal, name: &Symbol| {
        let slope = n.difference.derivative(name);
        let linear = slope.as_number().is_some_and(|k| !k.is_zero());
        // The value has to exist wherever the other symbol has one.
        let root = (n.relation == Relation::Equal && linear)
            .then(|| solve_for(&n.difference, name, domains))??;
        root.is_polynomial().then_some(root)
    };
    let names = || uses.symbols.keys();
    let mut found = one.iter().flat_map(|n| names().map(move |name| (n, name)));
    let (name, root) = found.find_map(|(n, name)| Some((name, fixed(n, name)?)))?;
    let gap = Expr::symbol(name) - &root;
    let gives = |case: &Vec<Normal>| {
        let numbers = case.iter().flat_map(|n| names().map(move |name| (n, name)));
        let numbers = numbers.filter_map(|(n, name)| {
            let value = fixed(n, name)?;
            value.as_number().is_some().then(|| (name.clone(), value))
        });
        let there = gap.substitute(&numbers.collect());
        let same = |n: &Normal| {
            fixed(n, name).is_some() && equality::vanishes(&n.difference.put(name, &root), domains)
        };
        equality::vanishes(&there, domains) || case.iter().any(same)
    };
    if !others.iter().all(gives) {
        return None;
    }
    let left = |case: &Vec<Normal>| {
        let put = case.iter().map(|n| n.of(n.difference.put(name, &root)));
        let says = |n: &Normal| {
            n.relation != Relation::Equal || !equality::vanishes(&n.difference, domains)
        };
        put.filter(says).collect::<Vec<_>>()
    };
    let [expected, answer] =
        [expected, answer].map(|cases| cases.iter().map(left).collect::<Vec<_>>());
    let mut finding = in_one_symbol(ctx, &expected, &answer, domains)?;
    if let Some(apart) = &mut finding.counterexample {
        apart.at = format!("{name} = {}, {}", write_plain(&root), apart.at);
    }
    matches!(finding.verdict, Verdict::Equivalent | Verdict::Different).then_some(finding)
}

/// The finding for relations in one symbol that part at a number.
fn apart(ctx: &Context, expected: &Cases, answer: &Cases, along: &Along) -> Grade {
    let at = |at: &String, lost: bool| Apart::new(at, holding(!lost), holding(lost));
    let somewhere = || {
        let gained = along.gained.as_ref().map(|x| at(x, false));
        along.lost.as_ref().map(|x| at(x, true)).or(gained)
    };
    let only = |cases: &Cases| match cases {
        [system] if system.len() == 1 => system.first().cloned(),
        _ => None,
    };
    let words = match (&only(expected), &only(answer)) {
        _ if equations_alone(expected, answer) => match (&along.lost, &along.gained) {
            (Some(_), Some(_)) => OTHER,
            (Some(_), None) => LOST,
            _ => GAINED,
        },
        // Bounds and directions are told as those of inequalities in several symbols.
        (Some(e), Some(a)) => {
            let mut finding = link(ctx, e, a);
            if finding.verdict == Verdict::Different {
                finding.counterexample = somewhere();
                return finding;
            }
            OTHER_NUMBERS
        }
        _ => OTHER_NUMBERS,
    };
    let mut finding = told(words);
    finding.counterexample = somewhere();
    finding
}

/// Two systems, at least one of several relations.
pub(super) fn compare(ctx: &Context, expected: &[Normal], answer: &[Normal]) -> Grade {
    let domains = ctx.domains();
    // One relation each, beside what must not be zero.
    if let (Some((e, _)), Some((a, _))) = (main(expected), main(answer))
        && only_symbol([&e.difference, &a.difference]).is_some()
    {
        let found = link(&ctx.plain(), e, a);
        if found.is_equivalent() {
            return where_defined(found, [expected, answer], domains);
        }
    }
    let [mine, theirs] = [expected, answer].map(|system| match expected.len() == answer.len() {
        true => system.to_vec(),
        false => spread(system, domains),
    });
    if mine.len() == theirs.len()
        && let Some(finding) = matched(ctx, &mine, &theirs)
    {
        return finding;
    }
    if equations_alone(&[expected.to_vec()], &[answer.to_vec()]) {
        let ([expected, answer], domains) = with_distances([expected, answer], domains);
        for positive in [false, true] {
            let [lost, gained] = [(&expected, &answer), (&answer, &expected)]
                .map(|(system, other)| fulfilled(system, other, &domains, positive));
            match (lost, gained) {
                (Some(Ok(given)), Some(Ok(more))) => {
                    let words = "each system of equations, solved, fulfils the other";
                    let mut finding = same_solutions(words);
                    finding.assume([given, more].concat());
                    return finding;
                }
                (Some(Err(at)), _) => return other_system(at, true),
                (_, Some(Err(at))) => return other_system(at, false),
                _ => {}
            }
        }
    }
    apart_at_points(ctx, expected, answer).unwrap_or_else(|| {
        undecided("the relations could not be solved to compare their solutions")
    })
}

/// A system with each bound by itself: `x² < y` as `x < √y` and `−x < √y`, without what holds everywhere on the domain.
fn spread(system: &[Normal], domains: &Domains) -> Vec<Normal> {
    let domains = domains.of(&differences(system, []));
    let plain = |n: &Normal| {
        let undone = [undone::turns, undone::powers, undone::square].map(|step| step(n, &domains));
        let given = undone.into_iter().flatten().find(|u| u.given.is_empty());
        given.map_or_else(|| n.clone(), |undone| undone.normal)
    };
    let all: Vec<Normal> = system
        .iter()
        .flat_map(|n| without_bars(&plain(n)))
        .collect();
    let says = |n: &&Normal| by_sign(n, &domains) != Extent::All;
    let some: Vec<Normal> = all.iter().filter(says).cloned().collect();
    if some.is_empty() { all } else { some }
}

/// `|u| < v` as `u < v` and `−u < v`; any other relation as it is.
fn without_bars(n: &Normal) -> Vec<Normal> {
    let bounded = matches!(n.relation, Relation::Less | Relation::LessEqual);
    match called(n, &[Function::Abs]) {
        Some((_, _, inside, k, other)) if bounded && k.is_positive() => {
            vec![n.of(&inside - &other), n.of(-&inside - &other)]
        }
        _ => vec![n.clone()],
    }
}

/// Every relation of the one system with one of the other that says the same.
fn matched(ctx: &Context, expected: &[Normal], answer: &[Normal]) -> Option<Grade> {
    let plain = ctx.plain();
    let domains = ctx.domains();
    let mut left: Vec<&Normal> = answer.iter().collect();
    let mut assumed: Vec<String> = Vec::new();
    for e in expected {
        let found = left.iter().enumerate().find_map(|(i, a)| {
            let finding = link(&plain, e, a);
            let same =
                finding.is_equivalent() && hole(from_ref(e), from_ref(a), domains) == Some(None);
            same.then_some((i, finding))
        });
        let (i, finding) = found?;
        left.remove(i);
        assumed.extend(finding.assumed);
    }
    let mut finding = same_solutions("each relation says the same as one of the other side");
    assumed.sort();
    assumed.dedup();
    finding.assumed = assumed;
    Some(finding)
}

/// Two systems with a letter of their own, not negative, for every |k x + c| of a real x that they know no other way:
/// each such number is the distance of some x, so that solutions are neither lost nor gained.
fn with_distances(systems: [&[Normal]; 2], domains: &Domains) -> ([Vec<Normal>; 2], Domains) {
    let mut systems = systems.map(<[Normal]>::to_vec);
    let mut domains = domains.clone();
    let mut bars: Vec<Expr> = Vec::new();
    let differences = systems.iter().flatten().map(|n| &n.difference);
    for part in differences.flat_map(Expr::parts) {
        if matches!(part.node(), Node::Call(Function::Abs, _)) && !bars.contains(part) {
            bars.push(part.clone());
        }
    }
    for bar in &bars {
        let Node::Call(_, inside) = bar.node() else {
            continue;
        };
        let letter: Symbol = write_plain(bar).into();
        let put = |n: &Normal| n.of(n.difference.replace(bar, &Expr::symbol(&letter)));
        let without = systems
            .each_ref()
            .map(|s| s.iter().map(put).collect::<Vec<_>>());
        let reaches_all = |name: &Symbol| {
            let real = domains.symbols.get(name) == Some(&Domain::real());
            let slope = inside.derivative(name);
            let elsewhere = |n: &Normal| n.difference.symbols().contains(name);
            real && !domains.is_component(name)
                && slope.as_number().is_some_and(|k| !k.is_zero())
                && !without.iter().flatten().any(elsewhere)
        };
        if inside.symbols().iter().any(reaches_all) {
            domains.symbols.insert(letter, Domain::nonnegative());
            systems = without;
        }
    }
    (systems, domains)
}

/// Where a point parts two systems.
type At = (String, Expr);

/// Whether a system of equations, solved one after the other, fulfils another, and what must not be zero for it in words;
/// else a point at which it does not. Symbols with `positive` values, if any, are solved for first: these lie in the domain.
fn fulfilled(
    system: &[Normal],
    other: &[Normal],
    domains: &Domains,
    positive: bool,
) -> Option<Result<Vec<String>, At>> {
    let mut known: BTreeMap<Symbol, Expr> = BTreeMap::new();
    let mut given = Vec::new();
    for n in system {
        let left = n.difference.substitute(&known);
        if equality::vanishes(&left, domains) {
            continue;
        }
        // What may have any value is solved for first: its value lies in the domain.
        let mut names = unknowns(&left, &left);
        names.sort_by_key(|name| domains.symbols.get(name) != Some(&Domain::real()));
        let mut solved = names
            .into_iter()
            .filter_map(|name| Some((name.clone(), solve_for(&left, &name, domains)?)))
            .peekable();
        let first = solved.peek().cloned();
        let mut likely = solved.filter(|_| positive);
        let likely = likely.find(|(_, root)| sign_of(root, domains) == Some(Sign::Positive));
        let (name, root) = likely.or(first)?;
        let slope = left.derivative(&name);
        if !sign_of(&slope, domains).is_some_and(Sign::is_strict) {
            given.push(not_zero(&slope.split_number().1));
        }
        for value in known.values_mut() {
            *value = value.put(&name, &root);
        }
        known.insert(name, root);
    }
    for n in other {
        let there = n.difference.substitute(&known);
        match equality::decide(&there, &Expr::zero(), domains).equality {
            same if same.is_identity() => {}
            Equality::Different(_) => return point_of(&known, &there, domains).map(Err),
            _ => return None,
        }
    }
    // Solutions have to lie in the domain to say anything.
    point_of(&known, &Expr::one(), domains).map(|_| Ok(given))
}

/// A point of the domain among the solutions at which an expression is not zero.
fn point_of(known: &BTreeMap<Symbol, Expr>, not_zero: &Expr, domains: &Domains) -> Option<At> {
    let all: Vec<&Expr> = known.values().chain([not_zero]).collect();
    let points = domains.points(&all, 24).into_iter();
    let domains = domains.of(&all);
    points.into_iter().find_map(|sample| {
        let point = sample.point::<Big<200>>(true);
        let mut words = vec![sample.words()];
        for (name, root) in known {
            let Outcome::Value(value) = evaluate(root, &point) else {
                return None;
            };
            if !super::solved::lies_in(&value.0, name, &domains) {
                return None;
            }
            words.push(format!("{name} = {}", value.0.decimal(6)));
        }
        match evaluate(not_zero, &point) {
            Outcome::Value(value) if !value.0.has_zero() => {
                words.retain(|w| !w.is_empty());
                Some((words.join(", "), rounded(&value.0)))
            }
            _ => None,
        }
    })
}

fn other_system((at, _): At, lost: bool) -> Grade {
    let words = match lost {
        true => "a solution of the expected equations does not fulfil the answer",
        false => "a solution of the answer does not fulfil the expected equations",
    };
    let hint = "compare your equations with the laws they come from, term by term";
    let word = |holds: bool| if holds { "fulfilled" } else { "not fulfilled" };
    told([OTHER[0], words, hint]).shown_by(Apart::new(at, word(!lost), word(lost)))
}
