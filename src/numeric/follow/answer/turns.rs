//! The turn of any number of a repeated group: one turn followed after the other, however many the file writes out.

use super::named;
use crate::expr::{Expr, Point, Symbol};
use crate::numeric::follow::{Followed, Unanswered, through, with_angles};
use crate::scene::{Ask, Scene, Turns};

/// Most turns that are followed.
const MOST: usize = 10_000;
/// What the integrator and rounding may make of something that was measured, as a part of it.
const ROUNDED: f64 = 1e-12;

/// A number of a turn.
#[derive(Clone, Copy, Debug, Default)]
pub struct OfTurn {
    /// The number.
    pub value: f64,
    /// How far rounding of what was measured may carry it: far where what is left is a small difference.
    pub rounding: f64,
}

/// A formula of the answers of one turn, or its sum over the turns up to that one: as the file has it for each of the turns it
/// writes out, as for the first of them afterwards.
pub(super) fn answer(
    scene: &Scene,
    followed: &Followed,
    turns: &Turns,
    (of, total): (&[Expr], bool),
    number: Option<f64>,
    values: &Point<f64>,
) -> Result<OfTurn, Unanswered> {
    let whole = |n: &f64| n.fract() == 0.0 && (1.0..=MOST as f64).contains(n);
    let last = number.filter(whole).ok_or(Unanswered::NotANumber)? as usize;
    let values = with_angles(values);
    let one = scene.turn(turns);
    let lost = |lost: &crate::numeric::follow::Lost| Unanswered::Lost(lost.clone());
    let first = followed.stages[turns.first].as_ref().map_err(lost)?;
    let mut state = first.before.clone();
    let [mut sum, mut now] = [OfTurn::default(); 2];
    for turn in 1..=last {
        let later;
        let (scene, followed, end, of) = match of.get(turn - 1) {
            Some(of) => (scene, followed, turns.turn(turn).end, of),
            None => {
                later = through(&one, followed.solids.clone(), &state, &values);
                (&one, &later, turns.stages, &of[0])
            }
        };
        let end = followed.stages[end - 1].as_ref().map_err(lost)?;
        state = end.after.clone();
        now = measured(scene, followed, of, &values).ok_or(Unanswered::NotANumber)?;
        sum.value += now.value;
        sum.rounding += now.rounding;
    }
    Ok(if total { sum } else { now })
}

/// A formula of answers to what was followed.
fn measured(scene: &Scene, followed: &Followed, of: &Expr, values: &Point<f64>) -> Option<OfTurn> {
    let mut at = values.clone();
    let names = motions(scene, of);
    for name in &names {
        let found = named(scene, followed, name, values);
        at.values.extend(found.map(|value| (name.clone(), value)));
    }
    let formula = |at: &Point<f64>| {
        let mut at = at.clone();
        for name in of.symbols() {
            let found = named(scene, followed, &name, &at).filter(|_| !names.contains(&name));
            at.values.extend(found.map(|value| (name, value)));
        }
        of.evaluate(&at)
    };
    let value = formula(&at)?;
    let carried = names.iter().filter_map(|name| {
        let mut near = at.clone();
        *near.values.get_mut(name)? *= 1.0 + ROUNDED;
        Some((formula(&near)? - value).abs())
    });
    let rounding: f64 = carried.sum();
    rounding.is_finite().then_some(OfTurn { value, rounding })
}

/// The answers about motion that a formula comes to, through formulas of answers.
fn motions(scene: &Scene, of: &Expr) -> Vec<Symbol> {
    let through = |name: Symbol| match scene.answering(&name).map(|q| &q.ask) {
        Some(Ask::Value { formula, .. }) => motions(scene, formula),
        Some(_) => vec![name],
        None => Vec::new(),
    };
    let mut out: Vec<Symbol> = of.symbols().into_iter().flat_map(through).collect();
    out.sort();
    out.dedup();
    out
}
