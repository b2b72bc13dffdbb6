//! The coefficient of friction from which, or up to which, something happens, out of the table of cases.

use std::collections::BTreeSet;
use std::convert::Infallible;

use super::super::Stop;
use super::{Case, Direction, Forms, Table};
use crate::expr::{Expr, Symbol};
use crate::laws::friction::side;
use crate::scene::{Ask, ContactSpace, FrictionEvent, Mode, Question, Scene};

/// The questions that need no answer of a case.
pub(super) fn of_parameters(scene: &Scene, asked: Vec<Question>) -> Vec<Question> {
    let mut known: BTreeSet<Symbol> = scene.parameters.iter().map(|p| p.name.clone()).collect();
    known.insert("pi".into());
    let mut out = Vec::new();
    for question in asked {
        let formulas = question.ask.formulas();
        let mut put_in = question.ask.with().iter().map(|(_, e)| e);
        let is_known = |e: &Expr| e.symbols().is_subset(&known);
        let is_open = matches!(question.ask, Ask::Friction { .. });
        if !formulas.is_empty() && formulas.iter().all(|e| is_known(e)) && put_in.all(is_known) {
            known.insert(question.name.as_str().into());
            out.push(question);
        } else if is_open {
            out.push(question);
        }
    }
    out
}

/// The questions, with thresholds of friction as formulas.
pub(super) fn thresholds(
    scene: &Scene,
    table: &Table,
    forms: &mut Forms,
) -> Result<Vec<Question>, Stop> {
    let mut out = scene.questions.clone();
    for question in &mut out {
        // Where there is none on the whole domain the question stays as it is, and is left open.
        if let Ask::Friction { event, .. } = question.ask
            && let Some(formula) = threshold(table, forms, event)?
        {
            question.ask = found(table, event, formula);
        }
    }
    Ok(out)
}

/// A threshold as a question for its formula.
fn found(table: &Table, event: FrictionEvent, formula: Expr) -> Ask {
    let endless = table.cases.iter().any(|case| !case.ends);
    Ask::Value {
        formula,
        with: Vec::new(),
        meaning: String::from(match event {
            FrictionEvent::Sticks if endless => {
                "coefficient of friction from which it has no answer: it would stick, and nothing would end the impact"
            }
            FrictionEvent::Sticks => "least coefficient of friction with which it sticks",
            FrictionEvent::Slides => "largest coefficient of friction with which it slides",
            FrictionEvent::Jams => "least coefficient of friction with which it jams",
        }),
        dimension: None,
        polar: None,
    }
}

/// Thresholds that have no formula on the domain, as the values of the scene make them: nobody's formula is held against them.
pub(super) fn at_given(
    scene: &Scene,
    table: &Table,
    mut asked: Vec<Question>,
) -> Result<Vec<Question>, Stop> {
    for question in &mut asked {
        if let Ask::Friction { event, .. } = question.ask
            && let Some(value) = at_values(scene, table, event)?
        {
            question.ask = found(table, event, value);
            if let Ask::Value { meaning, .. } = &mut question.ask {
                meaning.push_str(", at the given values");
            }
        }
    }
    Ok(asked)
}

/// The same at the values that a scene gives its other parameters, where it has no one formula on the domain.
fn at_values(scene: &Scene, table: &Table, event: FrictionEvent) -> Result<Option<Expr>, Stop> {
    let Some(mu) = table.law.mu.as_symbol() else {
        return Ok(None);
    };
    let mut values = scene.values();
    values.remove(mu);
    let put = |e: &Expr| e.substitute(&values);
    let Ok(law) = (table.law).try_map(|e| Ok::<_, Infallible>(put(e)));
    let [a, b, c, tangential, normal] = table.space.parts().map(put);
    let space = ContactSpace {
        a,
        b,
        c,
        tangential,
        normal,
    };
    let is_put = |e: &Expr| e.symbols().iter().all(|s| &**s == "pi");
    if values.is_empty() || !space.parts().iter().all(|e| is_put(e)) {
        return Ok(None);
    }
    let mut forms = Forms::new(scene, &law, &space);
    let mut there = Table {
        side: side(&space, &law),
        law,
        space,
        cases: Vec::new(),
        jamming: None,
        ..table.clone()
    };
    forms.fill(scene, &mut there)?;
    threshold(&there, &mut forms, event)
}

/// The coefficient of friction from which, or up to which, something happens.
fn threshold(table: &Table, forms: &mut Forms, event: FrictionEvent) -> Result<Option<Expr>, Stop> {
    // A contact that would stick already in compression does so a fortiori by the end of restitution, and a law with a path
    // asks no more friction of it; so the latest way to stick has the least coefficient.
    use Mode::{InsideCone, OnCone, Slides, Sticks, SticksInCompression, SticksInRestitution};
    const STICKING: &[Mode] = &[SticksInRestitution, SticksInCompression, Sticks, InsideCone];
    let modes = match event {
        FrictionEvent::Sticks => STICKING,
        FrictionEvent::Slides => &[Slides, OnCone],
        FrictionEvent::Jams => return Ok(table.jamming.clone()),
    };
    let of_mode = |mode: &Mode| -> Vec<&Case> {
        let all = table.cases.iter();
        all.filter(|case| case.mode == *mode).collect()
    };
    let cases = modes.iter().map(of_mode).find(|cases| !cases.is_empty());
    let upward = event == FrictionEvent::Sticks;
    let mut bounds = Vec::new();
    for case in cases.iter().flatten() {
        let Some(bound) = bound(table, forms, case, upward)? else {
            return Ok(None);
        };
        bounds.push((case.direction, bound));
    }
    Ok(match bounds.as_slice() {
        [(Direction::Only(_) | Direction::Either, bound)] => Some(bound.clone()),
        // Either way the same, but for the sign that the direction of slip has.
        [(_, one), (_, other)] if forms.tidy(&(one + other))?.is_zero() => Some(forms.size(one)?),
        _ => None,
    })
}

/// The least coefficient of friction of a case, or the largest; `None` where it has none.
fn bound(table: &Table, forms: &mut Forms, case: &Case, up: bool) -> Result<Option<Expr>, Stop> {
    let mut bound: Option<Expr> = None;
    for condition in &case.conditions {
        if condition.left != table.law.mu {
            return Ok(None);
        }
        // No condition is an equation.
        if condition.relation.is_below() != up {
            bound = Some(match bound {
                None => condition.right.clone(),
                Some(other) => forms.larger(&other, &condition.right)?,
            });
        }
    }
    Ok(bound)
}
