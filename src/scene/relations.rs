//! Relations between parameters: `"relations": ["M > m"]`, and ends of domains that refer to other parameters.
//!
//! In: the inequalities as written and the domains of their parameters. Out: [`crate::domain::Relation`]s that contradict
//! neither the domains nor each other, or faults.

use super::Scene;
use super::fault::{Fault, Span};
use super::formulas::Symbols;
use super::proof::middle;
use super::record::Text;
use crate::algebra::{Sign, sign};
use crate::domain::{Domain, Domains, Limit, Relation, roles, samples};
use crate::expr::{Expr, Function, Node, ratio};
use crate::formula::{self, Content};
use crate::interval::{Interval, Outcome, evaluate};

/// Reads the relations of a file into the scene.
pub(super) fn resolve(
    written: &[Text],
    scene: &mut Scene,
    symbols: &Symbols,
    faults: &mut Vec<Fault>,
) {
    for text in written {
        let Some((sides, relations)) = symbols.relations(text, faults) else {
            continue;
        };
        if relations.is_empty()
            || sides.len() != relations.len() + 1
            || !relations.iter().all(|r| r.is_order())
        {
            let fault = Fault::new(text.span, "expected an inequality between parameters");
            faults.push(fault.hint(
                "such as \"M > m\" or \"c < L/2\"; what is equal is written with one symbol",
            ));
            continue;
        }
        for (pair, relation) in sides.windows(2).zip(&relations) {
            use formula::Relation as R;
            let (small, large) = match relation.is_below() {
                true => (&pair[0], &pair[1]),
                false => (&pair[1], &pair[0]),
            };
            let closed = matches!(relation, R::LessEqual | R::GreaterEqual);
            if let Some(message) = symbols.clash(&pair[0], &pair[1]) {
                let mut fault = Fault::new(text.span, message);
                if pair.iter().any(is_bare_number) {
                    fault = fault.hint("a number has its unit behind it, such as \"v > 3 m/s\"");
                }
                faults.push(fault);
                continue;
            }
            let [Some(small), Some(large)] = [small, large].map(Content::expr) else {
                continue;
            };
            let [left, right] = [&pair[0], &pair[1]].map(|side| side.plain(&formula::write_plain));
            let words = format!("{left} {} {right}", relation.sign());
            let known = scene.domains.relations.len();
            add(scene, [small, large], closed, words, text.span, faults);
            let is_new = scene.domains.relations.len() > known;
            if is_new && pair.iter().any(|s| matches!(s, Content::Quantity(_))) {
                bounded(scene, [small, large], closed);
            }
        }
    }
}

/// Whether a side is a number without a unit.
fn is_bare_number(side: &Content) -> bool {
    matches!(side, Content::Scalar(e) if e.is_constant())
}

/// Lets the last relation, one of a parameter with a quantity, be the end of its domain: points are then found beyond it.
fn bounded(scene: &mut Scene, [small, large]: [&Expr; 2], closed: bool) {
    let (name, number, is_low) = match (small.as_symbol(), large.as_symbol()) {
        (None, Some(name)) => (name, small.as_number(), true),
        (Some(name), None) => (name, large.as_number(), false),
        _ => return,
    };
    let Some(number) = number else { return };
    let domain = scene.domains.symbols.entry(name.clone());
    let domain = domain.or_insert_with(Domain::positive);
    let end = if is_low {
        &mut domain.low
    } else {
        &mut domain.high
    };
    let new = Limit::number(number.clone(), !closed);
    let is_closer = |end: &Limit| match is_low {
        true => end.approximate() > new.approximate(),
        false => end.approximate() < new.approximate(),
    };
    if !end.as_ref().is_some_and(is_closer) {
        *end = Some(new);
    }
    scene.domains.relations.pop();
}

/// Adds `small < large` (or ≤) to what is known of the parameters, unless it contradicts that.
pub(super) fn add(
    scene: &mut Scene,
    [small, large]: [&Expr; 2],
    closed: bool,
    words: String,
    span: Span,
    faults: &mut Vec<Fault>,
) {
    let plain = large.clone() - small.clone();
    let excess = unwound(small, large, &scene.domains).unwrap_or(plain);
    let impossible = match sign(&excess, &scene.domains) {
        Some(Sign::Negative) => true,
        Some(Sign::NotPositive | Sign::Zero) => !closed,
        _ => false,
    };
    if impossible {
        let known = scene.domains.conditions().join(", ");
        let fault = Fault::new(span, format!("`{words}` is never so"));
        faults.push(fault.hint(format!("known already: {known}")));
        return;
    }
    let relation = Relation {
        sides: [small.clone(), large.clone()],
        excess,
        closed,
        words,
        origin: crate::domain::Origin::Stated,
    };
    scene.domains.relations.push(relation);
    if let Some(fault) = broken(scene, span) {
        scene.domains.relations.pop();
        faults.push(fault);
        return;
    }
    opened(scene);
}

/// Opens the ends of domains at which the last relation cannot hold.
fn opened(scene: &mut Scene) {
    let Some(Relation { excess, closed, .. }) = scene.domains.relations.last().cloned() else {
        return;
    };
    for symbol in excess.symbols() {
        let Some(mut domain) = scene.domains.symbols.get(&symbol).cloned() else {
            continue;
        };
        for end in [&mut domain.low, &mut domain.high].into_iter().flatten() {
            let there = excess.put(&symbol, &end.expr());
            end.open |= match sign(&there, &scene.domains) {
                Some(Sign::Negative) => true,
                Some(Sign::NotPositive | Sign::Zero) => !closed,
                _ => false,
            };
        }
        scene.domains.symbols.insert(symbol, domain);
    }
}

/// The fault where the values now given break a relation for certain.
pub(super) fn broken(scene: &Scene, span: Span) -> Option<Fault> {
    let given = scene.given();
    scene.domains.relations.iter().find_map(|relation| {
        let Outcome::Value(v) = evaluate::<Interval>(&relation.excess, &given) else {
            return None;
        };
        if relation.admits(v.low, v.high) != Some(false) {
            return None;
        }
        let values = scene.parameters.iter().filter_map(|p| {
            let value = p.value.as_ref()?;
            if !relation.excess.symbols().contains(&p.name) {
                return None;
            }
            let value = evaluate::<Interval>(value, &Default::default()).value()?;
            let number = super::fault::number_words(middle(&value));
            Some(format!("{} = {number}", p.name))
        });
        let values: Vec<String> = values.collect();
        let message = format!("{} with {}", relation.words, values.join(" and "));
        let fault = Fault::new(span, format!("the values break a relation: {message}"));
        Some(fault.hint("change the values (in SI units here), or the relation"))
    })
}

/// Told where no point was found that keeps to every relation: signs and identities can then not be tried.
pub(super) fn without_points(scene: &Scene) -> Option<String> {
    let excesses: Vec<&Expr> = scene.domains.relations.iter().map(|r| &r.excess).collect();
    if excesses.is_empty() {
        return None;
    }
    let roles = roles(&excesses);
    let (domains, _) = scene.domains.completed(&roles);
    samples(&roles, &domains, 1).is_empty().then(|| {
        let all: Vec<&str> = scene
            .domains
            .relations
            .iter()
            .map(|r| r.words.as_str())
            .collect();
        format!(
            "no simple values were found that keep to {}",
            all.join(", ")
        )
    })
}

/// θ < acos x is cos θ > x for angles from 0 to π, and so on: signs are decided without the inverse function.
fn unwound(small: &Expr, large: &Expr, domains: &Domains) -> Option<Expr> {
    let inverse = |e: &Expr| match e.node() {
        Node::Call(f @ (Function::Acos | Function::Asin | Function::Atan), x) => {
            Some((*f, x.clone()))
        }
        _ => None,
    };
    let (angle, (function, x), is_above) = match (inverse(small), inverse(large)) {
        (None, Some(found)) => (small, found, true),
        (Some(found), None) => (large, found, false),
        _ => return None,
    };
    let (low, high) = match function {
        Function::Acos => (ratio(0, 1), ratio(1, 1)),
        _ => (ratio(-1, 2), ratio(1, 2)),
    };
    let domain = domains.symbols.get(angle.as_symbol()?)?;
    if !domain.lies_within(&Domain::angle(low, high)) {
        return None;
    }
    // The inverse function minus the angle, up to a positive factor.
    let rest = match function {
        Function::Acos => angle.cos() - x,
        Function::Asin => x - angle.sin(),
        _ => x * angle.cos() - angle.sin(),
    };
    Some(if is_above { rest } else { -rest })
}
