//! The turn of any number of a repeated group: one turn followed after the other, however many the file writes out.

use super::answer::named;
use super::{Followed, Unanswered, through, with_angles};
use crate::expr::{Expr, Point};
use crate::numeric::Answer;
use crate::scene::{Scene, Turns};

/// Most turns that are followed.
const MOST: usize = 10_000;

/// A formula of the answers of one turn, or its sum over the turns up to that one: as the file has it for each of the turns it
/// writes out, as for the first of them afterwards.
pub(super) fn answer(
    scene: &Scene,
    followed: &Followed,
    turns: &Turns,
    (of, total): (&[Expr], bool),
    number: Option<f64>,
    values: &Point<f64>,
) -> Result<Answer<f64>, Unanswered> {
    let whole = |n: &f64| n.fract() == 0.0 && (1.0..=MOST as f64).contains(n);
    let last = number.filter(whole).ok_or(Unanswered::NotANumber)? as usize;
    let values = with_angles(values);
    let one = scene.turn(turns);
    let lost = |lost: &super::Lost| Unanswered::Lost(lost.clone());
    let first = followed.stages[turns.first].as_ref().map_err(lost)?;
    let mut state = first.before.clone();
    let mut sum = 0.0;
    let mut value = 0.0;
    for turn in 1..=last {
        let later;
        let (scene, followed, end, of) = match of.get(turn - 1) {
            Some(of) => (scene, followed, turns.turn(turn).end, of),
            None => {
                later = through(&one, followed.solids.clone(), &state, &values);
                (&one, &later, turns.stages, &of[0])
            }
        };
        let mut found = values.clone();
        for name in of.symbols() {
            let answer = named(scene, followed, &name, &values);
            found.values.extend(answer.map(|value| (name, value)));
        }
        let end = followed.stages[end - 1].as_ref().map_err(lost)?;
        state = end.after.clone();
        value = of.evaluate(&found).ok_or(Unanswered::NotANumber)?;
        sum += value;
    }
    Ok(Answer::Scalar(if total { sum } else { value }))
}
