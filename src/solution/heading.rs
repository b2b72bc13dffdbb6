//! The heading of a question beyond the motion: what it asks in a line, and where it goes on under the one before.

use super::sentence::called;
use super::words::{self, say};
use super::{Inline, Math, Solution};
use crate::answer::Answer;
use crate::expr::Expr;
use crate::formula::Relation;
use crate::scene::{Ask, Scene};

/// Why a coefficient of friction is the least or the largest with which something happens.
pub(super) fn because(meaning: &str) -> Option<&'static str> {
    let (_, event) = meaning.split_once("coefficient of friction with which it ")?;
    Some(match event {
        "sticks" => {
            "It sticks as long as the tangential impulse this takes is at most the coefficient times the normal one:"
        }
        "slides" => {
            "It slides to the end as long as friction cannot end its slip before the normal impulse has done its work:"
        }
        _ => {
            "It jams where the friction of its slip turns it so fast into the surface that a normal impulse no longer slows its approach:"
        }
    })
}

/// Whether a question needs no heading of its own after the one before: values one after the other, and one formula to
/// several orders.
pub(super) fn goes_on(before: &Ask, ask: &Ask) -> bool {
    let plain = |ask: &Ask| matches!(ask, Ask::Value { with, meaning, .. } if with.is_empty() && meaning.is_empty());
    match (before, ask) {
        (
            Ask::Approximate {
                of, parameter, to, ..
            },
            Ask::Approximate {
                of: f,
                parameter: p,
                to: t,
                ..
            },
        ) => (of, parameter, to) == (f, p, t),
        (Ask::Turn { .. }, Ask::Turn { .. }) => true,
        _ => plain(before) && plain(ask),
    }
}

/// What a further question adds to the heading, or says before its answer.
pub(super) fn further(solution: &mut Solution, ask: &Ask, answer: &Answer) {
    if let Ask::Approximate { order, .. } = ask {
        return solution.say(&match order {
            Some(order) => format!("To order {order},"),
            None => String::from("The leading term is"),
        });
    }
    if let Ask::Turn { .. } = ask {
        return;
    }
    let Some(section) = solution.sections.last_mut() else {
        return;
    };
    if let Some(Inline::Text(lead)) = section.heading.first_mut() {
        *lead = lead.replace("quantity", "quantities");
    }
    section
        .heading
        .extend([say(", "), words::formula(&Expr::symbol(&answer.name))]);
}

/// What is asked, in a line.
pub(super) fn heading(scene: &Scene, ask: &Ask, answer: &Answer) -> Vec<Inline> {
    let math = |e: &Expr| words::formula(e);
    let related = |left: &Expr, relation: Relation, right: &Expr| {
        Inline::Math(words::related(left, relation.sign(), right))
    };
    match ask {
        Ask::Value { meaning, .. } if !meaning.is_empty() => {
            vec![say(words::capital(&called(scene, meaning)))]
        }
        Ask::Value { with, .. } if with.is_empty() => {
            vec![say("Derived quantity "), math(&Expr::symbol(&answer.name))]
        }
        Ask::Value { formula, with, .. } => {
            let mut out = vec![math(formula)];
            out.push(say(" at "));
            out.extend(words::values(with));
            out
        }
        Ask::Condition {
            parameter,
            left,
            relation: Relation::Equal,
            right,
            ..
        } => vec![
            say("For which "),
            math(&Expr::symbol(parameter)),
            say(" is "),
            related(left, Relation::Equal, right),
            say("?"),
        ],
        Ask::Condition {
            parameter,
            left,
            relation,
            right,
            ..
        } => vec![
            say("For which "),
            math(&Expr::symbol(parameter)),
            say(" does "),
            related(left, *relation, right),
            say(" hold?"),
        ],
        Ask::Maximum { of, over } => {
            let mut out = vec![say("Largest value of "), math(of), say(" over ")];
            out.extend(words::symbols(over, " and "));
            out
        }
        Ask::Limit { of, parameter, to } => {
            let p = Math::Expr(Expr::symbol(parameter));
            let end = match to {
                Some(to) => Math::Expr(to.clone()),
                None => Math::Op("∞"),
            };
            vec![
                say("Limit of "),
                math(of),
                say(" as "),
                Inline::Math(vec![p, Math::Op("→"), end]),
            ]
        }
        Ask::Approximate {
            of,
            parameter,
            to,
            order,
        } => {
            let mut out = vec![math(of)];
            if to.is_zero() {
                out.extend([say(" for small "), math(&Expr::symbol(parameter))]);
            } else {
                let near = [Math::Expr(Expr::symbol(parameter)), Math::Op("≈")];
                let near = near.into_iter().chain([Math::Expr(to.clone())]);
                out.extend([say(" for "), Inline::Math(near.collect())]);
            }
            match order {
                Some(0) => {}
                Some(order) => out.push(say(format!(", to order {order}"))),
                None => out.insert(0, say("Leading term of ")),
            }
            out
        }
        Ask::Show {
            left,
            relation,
            right,
            claim,
            ..
        } => match claim.as_str() {
            "" => vec![say("To show: "), related(left, *relation, right)],
            claim => vec![say("To show: "), say(claim)],
        },
        Ask::Turn { number, .. } => {
            vec![
                say("In turn "),
                math(&Expr::symbol(number)),
                say(", whichever it is"),
            ]
        }
        Ask::Unused(of) => vec![say("Data not needed for "), math(&Expr::symbol(of))],
        _ => vec![say(words::capital(&called(scene, &answer.words)))],
    }
}
