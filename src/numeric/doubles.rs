//! Doubles for everything a scene asks for, at any scale.
//!
//! In: a scene whose parameters have values. Out: the nearest double wherever enclosures or fractions can tell it, and
//! where they cannot (irrational values at which the equations leave something open) what elimination in doubles judges.
//! Plain elimination alone would not do: a mass of 1e−15 beside one of 1 looks like a missing equation to it, and m l²
//! may underflow before there is any equation.

use super::answer::{Answer, Answered, answers};
use super::correct::{Correct, correct};
use super::exact::solve_exact;
use super::float::solve_f64;
use super::no_answer::NoAnswer;
use super::values::{exact_values, values};
use crate::expr::Rational;
use crate::expr::number::to_f64;
use crate::scene::Scene;

/// A double for every question that asks for numbers, and for formulas of such.
pub fn doubles(scene: &Scene) -> Result<Answered<f64>, NoAnswer> {
    let mut out = motion(scene)?;
    // A formula may take data that the impact does not need.
    let mut known = scene.given::<f64>();
    for question in &scene.questions {
        let name = &question.name;
        let is_plain = question.ask.with().is_empty();
        if let Some(value) = question.ask.value(&known).filter(|_| is_plain) {
            out.push((name.clone(), Ok(Answer::Scalar(value))));
        }
        let found = out.iter().find(|(of, _)| of == name);
        let parts = found.and_then(|(_, found)| Some(found.clone().ok()?.components()));
        for (part, value) in parts.into_iter().flatten() {
            let name = format!("{name}{part}").as_str().into();
            known.values.insert(name, value);
        }
    }
    Ok(out)
}

fn motion(scene: &Scene) -> Result<Answered<f64>, NoAnswer> {
    if scene.friction().is_some() {
        return with_friction(scene);
    }
    let found = match correct(scene) {
        Ok(found) => found,
        Err(NoAnswer::Undecided) => {
            let point = values(scene).map_err(NoAnswer::NoPoint)?;
            return answers(scene, &point, solve_f64);
        }
        Err(why) => return Err(why),
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
fn with_friction(scene: &Scene) -> Result<Answered<f64>, NoAnswer> {
    if let Ok(point) = exact_values(scene)
        && let Ok(found) = answers(scene, &point, solve_exact)
    {
        let answer = |a: Answer<Rational>| a.map(|x| to_f64(&x));
        let named = found.into_iter();
        let mut found: Answered<f64> = named.map(|(name, a)| (name, a.map(answer))).collect();
        if (found.iter()).any(|(_, a)| a.as_ref().is_err_and(NoAnswer::is_of_number_type)) {
            let point = values(scene).map_err(NoAnswer::NoPoint)?;
            let doubles = answers(scene, &point, solve_f64)?;
            for (name, double) in doubles {
                let mut same = found.iter_mut().filter(|(of, _)| *of == name);
                if let Some((_, a)) = same.next()
                    && a.as_ref().is_err_and(NoAnswer::is_of_number_type)
                {
                    *a = double;
                }
            }
        }
        return Ok(found);
    }
    let point = values(scene).map_err(NoAnswer::NoPoint)?;
    answers(scene, &point, solve_f64)
}

fn double(c: &Correct) -> Option<f64> {
    match c {
        Correct::Rounded(v, _) | Correct::Undecided(v) => Some(*v),
        Correct::Open => None,
    }
}
