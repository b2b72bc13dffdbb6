//! The heading of a question beyond the motion: what it asks in a line, and where it goes on under the one before.

use super::sentence::called;
use super::words::{self, fill, say};
use super::{Inline, Math, Solution};
use crate::answer::Answer;
use crate::expr::{Expr, Symbol};
use crate::formula::Relation;
use crate::scene::{Ask, Extremum, INSTANTANEOUS_CENTER, Scene};

/// Why an answer is what it is, where its formula does not show that.
pub(super) fn because(solution: &Solution, meaning: &str) -> Option<Vec<Inline>> {
    if meaning.starts_with("moment of inertia") {
        let text = "By the parallel-axis theorem it is that about the center of mass plus the mass times the square of the distance from there:";
        return Some(vec![say(text)]);
    }
    let (_, event) = meaning.split_once("coefficient of friction with which it ")?;
    let ends: Vec<Symbol> = solution.ends_of_sliding().collect();
    let text = match event {
        "jams" if ends.len() == 1 => {
            let end = [words::formula(&Expr::symbol(&ends[0]))];
            return Some(fill("It jams where {} is infinite:", end));
        }
        "sticks" => "It sticks as long as friction can give the tangential impulse this takes:",
        "slides" => {
            "It slides to the end as long as friction cannot end its slip before the normal impulse has done its work:"
        }
        _ => {
            "It jams where the friction of its slip turns it so fast into the surface that a normal impulse no longer slows its approach:"
        }
    };
    Some(vec![say(text)])
}

/// Whether a question needs no heading of its own after the one before: values one after the other, and one formula to
/// several orders.
pub(super) fn goes_on(before: &Ask, ask: &Ask) -> bool {
    let plain = |ask: &Ask| matches!(ask, Ask::Value { with, meaning, .. } if with.is_empty() && !is_headed(meaning));
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

/// Whether what a value means stands in its heading: the coordinates of a point go by their names.
fn is_headed(meaning: &str) -> bool {
    !meaning.is_empty() && !meaning.starts_with(INSTANTANEOUS_CENTER)
}

/// What a further question adds to the heading, or says before its answer.
pub(super) fn further(solution: &mut Solution, ask: &Ask, answer: &Answer) {
    if let Ask::Approximate { order, .. } = ask {
        return solution.say(&match order {
            Some(order) => format!("To {},", words::order(*order)),
            None => String::from("The leading term is"),
        });
    }
    if let Ask::Turn { .. } = ask {
        return;
    }
    let Some(section) = solution.sections.last_mut() else {
        return;
    };
    for piece in &mut section.heading {
        if let Inline::Text(words) = piece {
            *words = words.replace("quantity", "quantities");
            *words = words.replace(" and ", ", ");
        }
    }
    section
        .heading
        .extend([say(" and "), words::formula(&Expr::symbol(&answer.name))]);
}

/// What is asked, in a line.
pub(super) fn heading(scene: &Scene, ask: &Ask, answer: &Answer) -> Vec<Inline> {
    let math = |e: &Expr| words::formula(e);
    let related = |left: &Expr, relation: Relation, right: &Expr| {
        Inline::Math(words::related(left, relation.sign(), right))
    };
    match ask {
        Ask::Value { meaning, .. } if is_headed(meaning) => {
            vec![say(words::capital(&called(scene, meaning)))]
        }
        Ask::Value { with, .. } if with.is_empty() => {
            fill("Derived quantity {}", [math(&Expr::symbol(&answer.name))])
        }
        Ask::Value { formula, with, .. } => {
            let lead = fill("{} at ", [math(formula)]);
            [lead, words::values(with)].concat()
        }
        Ask::Condition {
            parameter,
            left,
            relation,
            right,
            ..
        } => {
            let form = match relation {
                Relation::Equal => "For which {} is {}?",
                _ => "For which {} does {} hold?",
            };
            let of = math(&Expr::symbol(parameter));
            fill(form, [of, related(left, *relation, right)])
        }
        Ask::Extremum { which, of, over } => {
            let form = match which {
                Extremum::Largest => "Largest value of {} over ",
                Extremum::Least => "Least value of {} over ",
            };
            let lead = fill(form, [math(of)]);
            [lead, words::symbols(over, " and ")].concat()
        }
        Ask::Limit { of, parameter, to } => {
            let p = Math::Expr(Expr::symbol(parameter));
            let end = to.as_ref().map_or(Math::Op("∞"), Math::from);
            let tends = Inline::Math(words::set("{} → {}", [p, end]));
            fill("Limit of {} as {}", [math(of), tends])
        }
        Ask::Approximate {
            of,
            parameter,
            to,
            order,
        } => {
            let p = Expr::symbol(parameter);
            let mut out = match to.is_zero() {
                true => fill("{} for small {}", [math(of), math(&p)]),
                false => {
                    let near = Inline::Math(words::related(&p, "≈", to));
                    fill("{} for {}", [math(of), near])
                }
            };
            match order {
                Some(0) => {}
                Some(1) => out.push(say(", to first order")),
                Some(2) => out.push(say(", to second order")),
                Some(order) => out.push(say(format!(", to {}", words::order(*order)))),
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
        Ask::Turn { number, total, .. } => {
            let form = match total {
                true => "In the first {} turns",
                false => "In the {}th turn",
            };
            fill(form, [math(&Expr::symbol(number))])
        }
        Ask::Unused(of) => fill("Data not needed for {}", [math(&Expr::symbol(of))]),
        _ => vec![say(words::capital(&called(scene, &answer.words)))],
    }
}
