//! Largest values over one or two parameters.
//!
//! Two parameters are looked at together first: where only one combination p·qᵏ of them matters, its best value is a curve
//! of maximisers and is told as such. Square roots of the parameter are taken away by p = x², so that the derivative becomes
//! a polynomial whose roots have a closed form or are isolated.

use std::collections::BTreeMap;

use super::Check;
use super::calc::{Seen, Unsolved, by_signs, essential, is_zero, sign, solve, tidy};
use super::{Answer, Form, Refused};
use crate::algebra::Sign;
use crate::domain::{Domain, Domains, Limit};
use crate::expr::{Expr, Node, Symbol};
use crate::formula::{Relation, write_plain};
use crate::formula::{Sentence, sentence};
use crate::scene::Scene;

/// The symbol whose square stands for the parameter.
const ROOT: &str = "\u{1}root";
/// The combination of two parameters.
const JOINT: &str = "\u{1}joint";

/// The largest value of a formula over parameters.
pub(super) fn maximum(
    scene: &Scene,
    mut out: Answer,
    of: &Expr,
    over: &[Symbol],
) -> Result<Vec<Answer>, Refused> {
    let mut domains = scene.domains.clone();
    let name = out.name.clone();
    let refused = |reason: &str| {
        Refused::question(
            &name,
            reason.to_string(),
            String::from(
                "the largest value is found over one parameter, or two of which one combination matters",
            ),
        )
    };
    let plays = |s: &Symbol| !tidy(&of.derivative(s), &domains).is_ok_and(|d| d.is_zero());
    let idle: Vec<&Symbol> = over.iter().filter(|s| !plays(s)).collect();
    for s in &idle {
        out.text.push(sentence![*s, " plays no part"]);
    }
    let free: Vec<Symbol> = over.iter().filter(|s| !idle.contains(s)).cloned().collect();
    let (reduced, variable, combination) = match free.as_slice() {
        [] => {
            out.form = Form::value(of.clone());
            return Ok(vec![out]);
        }
        [p] => (of.clone(), p.clone(), Expr::symbol(p)),
        [p, q] => {
            let Some(k) = joint(of, p, q, &domains) else {
                return Err(refused(&format!(
                    "{p} and {q} do not matter through one combination only"
                )));
            };
            // u = p qᵏ, so that p = u q⁻ᵏ; what is left of q must cancel.
            let joint: Symbol = JOINT.into();
            domains.symbols.insert(joint.clone(), Domain::positive());
            let replaced = &Expr::symbol(JOINT) * &Expr::symbol(q).power(-&k);
            let reduced = tidy(
                &of.substitute(&BTreeMap::from([(p.clone(), replaced)])),
                &domains,
            )
            .map_err(|s| refused(&s.to_string()))?;
            if reduced.symbols().contains(q) {
                return Err(refused(&format!("{q} does not cancel")));
            }
            let combination = tidy(&(&Expr::symbol(p) * &Expr::symbol(q).power(k)), &domains)
                .map_err(|s| refused(&s.to_string()))?;
            out.text
                .push(sentence!["only the combination ", &combination, " matters"]);
            (reduced, joint, combination)
        }
        _ => return Err(refused("more than two parameters")),
    };
    let positive = domains
        .symbols
        .get(&variable)
        .is_none_or(|d| *d == Domain::positive() || *d == Domain::nonnegative());
    let related = |r: &crate::domain::Relation| r.excess.symbols().contains(&variable);
    if !positive || domains.relations.iter().any(related) {
        return bounded(scene, out, &reduced, &variable);
    }
    let root: Symbol = ROOT.into();
    domains.symbols.insert(root.clone(), Domain::positive());
    let x = Expr::symbol(ROOT);
    let f = tidy(
        &reduced.substitute(&BTreeMap::from([(variable.clone(), x.powi(2))])),
        &domains,
    )
    .map_err(|s| refused(&s.to_string()))?;
    let slope = tidy(&f.derivative(&root), &domains).map_err(|s| refused(&s.to_string()))?;
    let words = write_plain(&combination);
    let roots = match solve(&slope, &root, &domains) {
        Ok(roots) => roots,
        Err(Unsolved::Absent) => {
            return Ok(vec![at_the_rim(out, &slope, &words, &domains)]);
        }
        Err(Unsolved::Inside) => return Err(refused("the parameter stands inside a function")),
        Err(Unsolved::Limit(what)) => return Err(refused(&what)),
    };
    let named = BTreeMap::from([(root.clone(), combination.sqrt())]);
    let discarded: Vec<Sentence> = roots.discarded.iter().map(|d| d.put_in(&named)).collect();
    if roots.inside.is_empty() {
        out.discarded = discarded;
        return Ok(vec![at_the_rim(out, &slope, &words, &domains)]);
    }
    let [best] = roots.inside.as_slice() else {
        return Err(elsewhere(&name, &variable, &roots.inside));
    };
    out.assumptions.extend(best.given.iter().cloned());
    let side = |factor: Expr| {
        let e = slope.substitute(&BTreeMap::from([(root.clone(), &factor * &best.value)]));
        sign(&essential(&e, &domains), &domains)
    };
    let (before, after) = (side(Expr::ratio(1, 2)), side(Expr::from(2)));
    if !(before.is_positive() && after.is_negative()) {
        return Err(elsewhere(&name, &variable, &roots.inside));
    }
    let value = tidy(
        &f.substitute(&BTreeMap::from([(root.clone(), best.value.clone())])),
        &domains,
    )
    .map_err(|s| refused(&s.to_string()))?;
    let value = super::calc::shorter(&value, &domains);
    let place = tidy(&best.value.powi(2), &domains).map_err(|s| refused(&s.to_string()))?;
    out.discarded = discarded;
    out.dimension = super::formulas::dimension_of(scene, &value, &name)?;
    out.checks.push(by_signs(
        "maximum",
        "the derivative vanishes there and nowhere else; the value rises before and falls after ({how})",
        before.is_proved() && after.is_proved(),
    ));
    out.checks.push(Check {
        kind: "identity",
        words: String::from("the derivative at that place is zero in the normal form"),
        holds: best.proved.then_some(true),
    });
    let at_best = BTreeMap::from([(root.clone(), best.value.clone())]);
    out.put_in = vec![
        (
            slope.substitute(&at_best),
            Expr::zero(),
            "the derivative at that place",
        ),
        (f.substitute(&at_best), value.clone(), "the value there"),
    ];
    let mut at = out.clone();
    at.name = format!("{name}_at");
    at.latex = format!("\\arg {}", out.latex);
    at.words = format!("{words} for which it is largest");
    // How it was found is told with the value.
    at.discarded = Vec::new();
    at.text = match free.as_slice() {
        [p, q] => vec![sentence![
            "every pair ",
            p,
            ", ",
            q,
            " with this ",
            &combination,
            " does it: the maximisers form a curve"
        ]],
        _ => Vec::new(),
    };
    at.range
        .push((combination.clone(), Relation::Equal, place.clone()));
    at.dimension = super::formulas::dimension_of(scene, &combination, &name)?;
    at.form = Form::value(place);
    out.form = Form::value(value);
    Ok(vec![out, at])
}

/// Told where the derivative vanishes more than once, or where there is no maximum: only an interval decides then.
fn elsewhere(name: &str, variable: &Symbol, roots: &[super::calc::Root]) -> Refused {
    let reason = match roots.len() {
        1 => String::from("where the derivative vanishes there is no maximum"),
        count => format!("the derivative vanishes at {count} values of {variable}"),
    };
    Refused::question(
        name,
        reason,
        format!(
            "with a \"domain\" of `min` and `max` for {variable} the values at its ends are compared too"
        ),
    )
}

/// The largest value over one parameter in an interval: where the derivative vanishes once, or at an end.
fn bounded(scene: &Scene, mut out: Answer, f: &Expr, p: &Symbol) -> Result<Vec<Answer>, Refused> {
    let domains = &scene.domains;
    let name = out.name.clone();
    let refused = |reason: String| Refused::question(&name, reason, "");
    let domain = domains
        .symbols
        .get(p)
        .cloned()
        .unwrap_or_else(Domain::positive);
    if let Some(pole) = pole(f, p, domains) {
        return Err(refused(format!(
            "{} may vanish within the interval",
            write_plain(&pole)
        )));
    }
    let slope = tidy(&f.derivative(p), domains).map_err(|s| refused(s.to_string()))?;
    let at = |x: &Expr, e: &Expr| {
        tidy(
            &e.substitute(&BTreeMap::from([(p.clone(), x.clone())])),
            domains,
        )
    };
    let (inside, discarded) = match solve(&slope, p, domains) {
        Ok(roots) if roots.open.is_none() => {
            let given = roots.inside.iter().flat_map(|r| r.given.clone());
            out.assumptions.extend(given);
            (roots.inside, roots.discarded)
        }
        Ok(_) | Err(Unsolved::Inside) => {
            return Err(refused(format!(
                "where the derivative by {p} vanishes has no closed form here"
            )));
        }
        Err(Unsolved::Absent) => (Vec::new(), Vec::new()),
        Err(Unsolved::Limit(what)) => return Err(refused(what)),
    };
    out.discarded = discarded;
    let value_of = |end: &Limit| match end.of_pi {
        true => Expr::from(end.value.clone()) * Expr::pi(),
        false => Expr::from(end.value.clone()),
    };
    let ends: Vec<Expr> = [&domain.low, &domain.high]
        .into_iter()
        .flatten()
        .map(value_of)
        .collect();
    let is_end = |x: &Expr| {
        ends.iter()
            .any(|e| is_zero(&(x - e), domains) == Some(true))
    };
    let inside: Vec<Expr> = inside
        .into_iter()
        .map(|r| r.value)
        .filter(|x| !is_end(x))
        .collect();
    let bends = match inside.as_slice() {
        [only] => {
            let bend = at(only, &slope.derivative(p)).map_err(|s| refused(s.to_string()))?;
            Some(sign(&bend, domains))
        }
        _ => None,
    };
    let place = match inside.as_slice() {
        [best] if bends.is_some_and(Seen::is_negative) => {
            out.checks.push(Check {
                kind: "maximum",
                words: String::from("the derivative vanishes there and nowhere else in the interval, and the second derivative is negative"),
                holds: bends.is_some_and(Seen::is_proved).then_some(true),
            });
            best.clone()
        }
        [] => {
            let rising = sign(&slope, domains);
            // Where the slope is zero at an end alone, it has one sign inside.
            let grows = if rising.is_positive() || rising == Seen::Proved(Sign::NotNegative) {
                true
            } else if rising.is_negative() || rising == Seen::Proved(Sign::NotPositive) {
                false
            } else {
                return Err(refused(format!(
                    "whether it grows with {p} could not be decided"
                )));
            };
            let limit = if grows { &domain.high } else { &domain.low };
            let (value, open) = match (related_end(p, grows, domains).map_err(refused)?, limit) {
                (Some(end), _) => end,
                (None, Some(end)) => (value_of(end), end.open),
                (None, None) => return Ok(vec![at_the_rim(out, &slope, p, domains)]),
            };
            let words = "the derivative has one sign inside the interval ({how})";
            out.checks
                .push(by_signs("maximum", words, rising.is_proved()));
            out.text.push(sentence![
                "the derivative by ",
                p,
                " does not vanish inside: the largest value is ",
                if open {
                    "approached at, and not reached, as the domain excludes"
                } else {
                    "at"
                },
                " the bound ",
                p,
                " = ",
                &value
            ]);
            value
        }
        several => {
            let closed = |end: &Option<Limit>| end.as_ref().is_some_and(|e| !e.open);
            if !closed(&domain.low) || !closed(&domain.high) {
                return Err(Refused {
                    hint: format!(
                        "give {p} a \"domain\" with `min` and `max`: the ends are then compared too"
                    ),
                    ..refused(format!(
                        "the derivative by {p} vanishes where the value is not largest, and the interval does not end"
                    ))
                });
            }
            let mut found: Vec<(Expr, Expr)> = Vec::new();
            for x in several.iter().chain(&ends) {
                found.push((x.clone(), at(x, f).map_err(|s| refused(s.to_string()))?));
            }
            let above = |a: &Expr, b: &Expr| sign(&(a - b), domains);
            let is_best = |(i, (_, value)): &(usize, &(Expr, Expr))| {
                let mut others = found.iter().enumerate().filter(|(j, _)| j != i);
                others.all(|(_, (_, other))| {
                    let s = above(value, other);
                    s.is_positive() || matches!(s, Seen::Proved(s) if s.is_not_negative())
                })
            };
            let Some((i, (place, value))) = found.iter().enumerate().find(is_best) else {
                return Err(refused(format!(
                    "which of the values where the derivative by {p} vanishes and at the ends is largest hangs on the other parameters"
                )));
            };
            let others = found.iter().enumerate().filter(|(j, _)| *j != i);
            let proved = others
                .clone()
                .all(|(_, (_, other))| above(value, other).is_proved());
            let words = "of the places where the derivative vanishes and the two ends it is largest there ({how})";
            out.checks.push(by_signs("maximum", words, proved));
            place.clone()
        }
    };
    let value = at(&place, f).map_err(|s| refused(s.to_string()))?;
    out.dimension = super::formulas::dimension_of(scene, &value, &name)?;
    let there = BTreeMap::from([(p.clone(), place.clone())]);
    out.put_in
        .push((f.substitute(&there), value.clone(), "the value there"));
    out.range.push((Expr::symbol(p), Relation::Equal, place));
    out.form = Form::value(value);
    Ok(vec![out])
}

/// The end that a relation sets to a parameter on the side to which a value grows, and whether it is excluded; an error where
/// there are several or the relation does not give the parameter itself.
fn related_end(p: &Symbol, grows: bool, domains: &Domains) -> Result<Option<(Expr, bool)>, String> {
    let bearing = domains.relations.iter();
    let bearing = bearing.filter(|r| r.excess.symbols().contains(p));
    let mut ends = Vec::new();
    for r in bearing {
        match &r.sides {
            [small, large] if small.as_symbol() == Some(p) && !large.symbols().contains(p) => {
                if grows {
                    ends.push((large.clone(), !r.closed));
                }
            }
            [small, large] if large.as_symbol() == Some(p) && !small.symbols().contains(p) => {
                if !grows {
                    ends.push((small.clone(), !r.closed));
                }
            }
            _ => {
                return Err(format!(
                    "it is largest at an end of the range of {p}, which {} does not give alone",
                    r.words
                ));
            }
        }
    }
    if ends.len() > 1 {
        return Err(format!("several relations end the range of {p}"));
    }
    Ok(ends.pop())
}

/// A divisor with the parameter in it that is not known to keep one sign.
fn pole(f: &Expr, p: &Symbol, domains: &Domains) -> Option<Expr> {
    let mut found = None;
    f.walk(&mut |part| {
        if let Node::Power(base, k) = part.node()
            && k.as_number().is_some_and(num_traits::Signed::is_negative)
            && base.symbols().contains(p)
        {
            let s = sign(base, domains);
            let keeps = matches!(
                s,
                Seen::Positive | Seen::Negative | Seen::Proved(Sign::Positive | Sign::Negative)
            );
            if !keeps {
                found = Some(base.clone());
            }
        }
    });
    found
}

/// The exponent k for which the formula depends on p·qᵏ alone.
fn joint(of: &Expr, p: &Symbol, q: &Symbol, domains: &Domains) -> Option<Expr> {
    let weighted = |s: &Symbol| &Expr::symbol(s) * &of.derivative(s);
    let ratio = tidy(&(&weighted(q) / &weighted(p)), domains).ok()?;
    ratio.as_number()?;
    Some(ratio)
}

/// No place inside: the largest value is approached at an end.
fn at_the_rim(mut out: Answer, slope: &Expr, words: &str, domains: &Domains) -> Answer {
    let s = sign(slope, domains);
    let how = if s.is_proved() {
        "proved"
    } else {
        "seen at points"
    };
    out.text.push(if s.is_positive() {
        sentence![
            "there is no largest value inside: it grows with ",
            words,
            " without end (",
            how,
            "), so it is approached as ",
            words,
            " → ∞ and never reached"
        ]
    } else if s.is_negative() {
        sentence![
            "there is no largest value inside: it falls as ",
            words,
            " grows (",
            how,
            "), so it is approached as ",
            words,
            " → 0 and not reached there"
        ]
    } else {
        Sentence::words("whether there is a largest value could not be decided")
    });
    out
}
