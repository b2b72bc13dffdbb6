//! Doubles for everything a scene asks for, at any scale.
//!
//! In: a scene whose parameters have values. Out: the nearest double wherever enclosures or fractions can tell it, and
//! where they cannot (irrational values at which the equations leave something open) what elimination in doubles judges.
//! Plain elimination alone would not do: a mass of 1e−15 beside one of 1 looks like a missing equation to it, and m l²
//! may underflow before there is any equation.

use super::answer::{Answer, Answered, NoAnswer, answers};
use super::correct::{Correct, NoCorrect, correct};
use super::exact::solve_exact;
use super::float::solve_f64;
use super::values::{NoPoint, exact_values, values};
use crate::expr::Rational;
use crate::expr::number::to_f64;
use crate::scene::Scene;

/// Why there are none.
#[derive(Clone, Debug, PartialEq)]
pub enum NoDoubles {
    /// A parameter has no value.
    NoPoint(NoPoint),
    /// The scene has no motion at its values.
    NoAnswer(NoAnswer),
}

/// A double for every question that asks for numbers.
pub fn doubles(scene: &Scene) -> Result<Answered<f64>, NoDoubles> {
    if scene.friction().is_some() {
        return with_friction(scene);
    }
    let found = match correct(scene) {
        Ok(found) => found,
        Err(NoCorrect::NoPoint(why)) => return Err(NoDoubles::NoPoint(why)),
        Err(NoCorrect::Contradiction(laws)) => {
            return Err(NoDoubles::NoAnswer(NoAnswer::Contradiction(laws)));
        }
        Err(NoCorrect::Undecided) => {
            let point = values(scene).map_err(NoDoubles::NoPoint)?;
            return answers(scene, &point, solve_f64).map_err(NoDoubles::NoAnswer);
        }
    };
    let answer = |components: Vec<Correct>| {
        let numbers: Option<Vec<f64>> = components.iter().map(double).collect();
        match numbers.as_deref() {
            Some([one]) => Ok(Answer::Scalar(*one)),
            Some([x, y]) => Ok(Answer::Vector([*x, *y])),
            _ => Err(NoAnswer::NotDetermined(Vec::new())),
        }
    };
    let named = found.answers.into_iter();
    Ok(named.map(|(name, a)| (name, a.and_then(answer))).collect())
}

/// With friction the impact is followed in fractions where there are any, so that its mode is decided exactly.
fn with_friction(scene: &Scene) -> Result<Answered<f64>, NoDoubles> {
    if let Ok(point) = exact_values(scene)
        && let Ok(found) = answers(scene, &point, solve_exact)
    {
        let answer = |a: Answer<Rational>| match a {
            Answer::Scalar(x) => Answer::Scalar(to_f64(&x)),
            Answer::Vector(v) => Answer::Vector(v.map(|x| to_f64(&x))),
        };
        let named = found.into_iter();
        return Ok(named.map(|(name, a)| (name, a.map(answer))).collect());
    }
    let point = values(scene).map_err(NoDoubles::NoPoint)?;
    answers(scene, &point, solve_f64).map_err(NoDoubles::NoAnswer)
}

fn double(c: &Correct) -> Option<f64> {
    match c {
        Correct::Rounded(v, _) | Correct::Undecided(v) => Some(*v),
        Correct::Open => None,
    }
}
