//! The correctly rounded double of everything a scene asks for, at the exact values of its parameters.
//!
//! In: a scene whose parameters have values, each an exact formula (0.1 is 1/10, 30° is π/6). Out: for every question and
//! every unknown the double nearest to the true value, and what told: exact fractions rounded once, or enclosures of more
//! and more bits where a value is irrational.

use super::answer::answer;
use super::exact::solve_exact;
use super::field::eliminate;
use super::given::{Given, Reason, given};
use super::no_answer::NoAnswer;
use super::redundant::{Part, regular_part, solve_part};
use super::solution::{Contradiction, Solution, motion};
use super::system::{Law, System, Unknown, assemble};
use super::values::{NoPoint, exact_values, given_values, point_of, unit_of};
use crate::expr::arithmetic::Number;
use crate::expr::number::to_f64;
use crate::expr::{Expr, Point, Rational, Scalar};
use crate::interval::{Big, Outcome, evaluate};
use crate::scene::{Ask, Scene};

/// How a double was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum How {
    /// Exact fractions.
    Exact,
    /// An enclosure of this many bits.
    Bits(u32),
}

/// A number in doubles.
#[derive(Clone, Debug, PartialEq)]
pub enum Correct {
    /// The double nearest to the true value.
    Rounded(f64, How),
    /// The laws leave it open.
    Open,
    /// Irrational, and too close to a middle between two doubles or to zero for the widest enclosure tried: the middle of
    /// that enclosure, zero where it holds zero.
    Undecided(f64),
}

/// Correctly rounded numbers of a scene.
#[derive(Clone, Debug)]
pub struct CorrectAnswers {
    /// Every unknown of the full system.
    pub unknowns: Vec<(Unknown, Correct)>,
    /// Every question that asks for numbers: its name and its components, one or two.
    pub answers: Vec<(String, Result<Vec<Correct>, NoAnswer>)>,
    /// Laws left out because the others imply them. Where not empty, that they do was seen at random exact points only.
    pub left_out: Vec<Law>,
}

impl CorrectAnswers {
    /// Whether nothing was left undecided, nor any law left out that was not proved to follow.
    pub fn is_complete(&self) -> bool {
        self.left_out.is_empty() && self.is_told()
    }

    fn is_told(&self) -> bool {
        let decided = |c: &Correct| !matches!(c, Correct::Undecided(_));
        self.unknowns.iter().all(|(_, c)| decided(c))
            && self
                .answers
                .iter()
                .all(|(_, a)| a.as_ref().map_or(true, |v| v.iter().all(decided)))
    }
}

/// Everything a scene asks for, correctly rounded.
pub fn correct(scene: &Scene) -> Result<CorrectAnswers, NoAnswer> {
    given_values(scene).map_err(NoAnswer::NoPoint)?;
    let mut best = None;
    if let Ok(at) = exact_values(scene) {
        match given(scene, &at) {
            Ok(numbers) => {
                let system = assemble(&numbers);
                let clash = |c: Contradiction| NoAnswer::Contradiction(c.laws(&system));
                let solution = solve_exact(&system).map_err(clash)?;
                let rounded = |v: &Rational| Correct::Rounded(to_f64(v), How::Exact);
                let exact = told(scene, &at, &numbers, &system, &solution, rounded);
                // A direction such as π/3 is no pair of fractions where all else is one.
                let mut all = exact.answers.iter();
                if !all.any(|(_, a)| a.as_ref().is_err_and(NoAnswer::is_of_number_type)) {
                    return Ok(exact);
                }
                best = Some(exact);
            }
            Err(undefined) if undefined.reason != Reason::NotANumber => {
                return Err(NoAnswer::Undecided);
            }
            Err(_) => {}
        }
    }
    // Enclosures never tell that an equation follows from others: those that do at random points are left out.
    let part = regular_part(scene).filter(|part| !part.is_whole());
    for enclosed in [enclosed::<256>, enclosed::<1024>, enclosed::<4096>] {
        let Some(mut found) = enclosed(scene, part.as_ref())? else {
            continue;
        };
        found.left_out = part.iter().flat_map(|p| p.left_out.clone()).collect();
        let joined = join(best, found);
        if joined.is_told() {
            return Ok(joined);
        }
        best = Some(joined);
    }
    best.ok_or(NoAnswer::Undecided)
}

/// By enclosures of `BITS` bits; `None` where they cannot tell the equations from singular ones.
fn enclosed<const BITS: u32>(
    scene: &Scene,
    part: Option<&Part>,
) -> Result<Option<CorrectAnswers>, NoAnswer> {
    let at = enclosed_point::<BITS>(scene).map_err(NoAnswer::NoPoint)?;
    let Ok(numbers) = given(scene, &at) else {
        return Ok(None);
    };
    let system = assemble(&numbers);
    let mut entries = system.matrix.iter().chain(&system.right);
    let known = entries.all(|v| matches!(v, Outcome::Value(_)));
    let solution = match part {
        None => eliminate(&system).map(Solution::determined),
        Some(part) => solve_part(&system, part),
    };
    let rounded = |v: &Outcome<Big<BITS>>| match v {
        Outcome::Value(Big(v)) => match v.nearest() {
            Some(near) => Correct::Rounded(near, How::Bits(BITS)),
            None => Correct::Undecided(v.middle()),
        },
        _ => Correct::Undecided(f64::NAN),
    };
    let solution = solution.filter(|_| known);
    Ok(solution.map(|s| told(scene, &at, &numbers, &system, &s, rounded)))
}

/// What the first could not tell, from the second.
fn join(first: Option<CorrectAnswers>, mut second: CorrectAnswers) -> CorrectAnswers {
    let Some(first) = first else { return second };
    let keep = |old: Correct, new: &mut Correct| {
        if let Correct::Rounded(..) = old {
            *new = old;
        }
    };
    for ((_, old), (_, new)) in first.unknowns.into_iter().zip(&mut second.unknowns) {
        keep(old, new);
    }
    for ((_, old), (_, new)) in first.answers.into_iter().zip(&mut second.answers) {
        if let (Ok(old), Ok(new)) = (old, new) {
            old.into_iter()
                .zip(new)
                .for_each(|(old, new)| keep(old, new));
        }
    }
    second
}

/// Every unknown and every answer of a solution.
fn told<T: Number>(
    scene: &Scene,
    at: &Point<T>,
    numbers: &Given<T>,
    system: &System<T>,
    solution: &Solution<T>,
    rounded: impl Fn(&T) -> Correct,
) -> CorrectAnswers {
    let motion = motion(numbers, system, solution);
    let unknowns = system.unknowns.iter().enumerate().map(|(i, u)| {
        let value = match solution.unique[i] {
            true => rounded(&solution.values[i]),
            false => Correct::Open,
        };
        (*u, value)
    });
    let asked = scene
        .asked_of_impact()
        .filter(|q| !matches!(q.ask, Ask::Balance { .. } | Ask::Matrix { .. }));
    let answers = asked.map(|q| {
        let found = answer(&q.ask, at, numbers, &motion);
        let found = found.map(|a| a.components().iter().map(|(_, v)| rounded(v)).collect());
        (q.name.clone(), found)
    });
    CorrectAnswers {
        unknowns: unknowns.collect(),
        answers: answers.collect(),
        left_out: Vec::new(),
    }
}

/// The point of the scene's values, enclosed.
fn enclosed_point<const BITS: u32>(scene: &Scene) -> Result<Point<Outcome<Big<BITS>>>, NoPoint> {
    let value = |e: &Expr| evaluate::<Big<BITS>>(e, &Point::default());
    let unit = |part: &Expr| match unit_of(part) {
        Some(unit) => unit.each_ref().map(Scalar::from_rational),
        None => [value(&part.cos()), value(&part.sin())],
    };
    point_of(scene, |_, given| Ok(value(given)), |_, part| Ok(unit(part)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{read, set};

    /// A rod, inclined at theta, hits a smooth floor.
    const ROD: &str = r#"{
        "parameters": {
            "m": {"unit": "kg", "value": 1}, "l": {"unit": "m", "value": 1}, "v": {"unit": "m/s", "value": 3},
            "theta": {"unit": "rad", "value": "pi/6", "domain": {"min": 0, "max": "pi/2"}},
            "e": {"unit": "1", "domain": {"min": 0, "max": 1}, "value": "1/2"}
        },
        "bodies": {
            "floor": {"shape": "fixed"},
            "rod": {"shape": "rod", "mass": "m", "length": "l", "angle": "theta",
                    "center": {"from": ["0", "0"], "distance": "l/2", "angle": "theta"}, "velocity": ["0", "-v"]}
        },
        "contacts": {"C": {"bodies": ["floor", "rod"], "at": ["0", "0"], "normal": ["0", "1"], "law": "frictionless", "restitution": "e"}},
        "questions": {"v": {"velocity": "rod"}, "u": {"velocity": "rod", "along": ["cos(theta)", "sin(theta)"]}, "E": {"energy": "lost"}}
    }"#;

    fn numbers(assignments: &[(&str, &str)]) -> Vec<Correct> {
        let text = ROD.replace("\"questions\": {\"v\"", "\"questions\": {\"vG\"");
        let mut scene = read(&text).expect("a scene");
        for (name, value) in assignments {
            set(&mut scene, name, value).expect("a value");
        }
        let found = correct(&scene).expect("determined");
        found
            .answers
            .into_iter()
            .flat_map(|(_, a)| a.expect("a number"))
            .collect()
    }

    fn value(c: &Correct) -> (f64, How) {
        match c {
            Correct::Rounded(v, how) => (*v, *how),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_rod_at_thirty_degrees_moves_as_the_closed_form_says() {
        // v_y⁺ = v (e − 3cos²θ)/(1 + 3cos²θ) = 3 (1/2 − 9/4)/(13/4), E = 6/13 · (1 − e²)/… = ½ m v² (1−e²)/(1+3cos²θ).
        let all = numbers(&[]);
        assert_eq!(value(&all[0]).0, 0.0);
        assert_eq!(value(&all[1]), (-21.0 / 13.0, How::Bits(256)));
        assert_eq!(value(&all[3]).0, 4.5 * 0.75 / 3.25);
    }

    #[test]
    fn a_velocity_that_all_but_cancels_is_rounded_from_fractions_or_wide_enclosures() {
        // e = 3cos²θ stops the center; e is larger by 10⁻⁴⁰ here, so v_y⁺ = 3·10⁻⁴⁰/(1 + 3cos²θ).
        let exact = "3*(8/17)^2 + 1/10^40";
        let all = numbers(&[("theta", "acos(8/17)"), ("e", exact)]);
        let (v, how) = value(&all[1]);
        assert_eq!(how, How::Exact);
        // 867/481 · 10⁻⁴⁰, rounded once by the reader of numbers.
        assert_eq!(v, 1.802_494_802_494_802_5e-40);
        let all = numbers(&[("theta", "acos(1/sqrt(5))"), ("e", "3/5 + 1/10^40")]);
        let (v, how) = value(&all[1]);
        assert_eq!((v, how), (1.875e-40, How::Bits(256)));
    }

    /// Two bars hinged to the ground and to each other at two places: one bar held twice over.
    const HELD_TWICE: &str = r#"{
        "parameters": {
            "m": {"unit": "kg", "value": 1}, "l": {"unit": "m", "value": 1}, "J": {"unit": "N s", "value": 2},
            "theta": {"unit": "rad", "value": "pi/7", "domain": {"min": 0, "max": "pi/2"}}
        },
        "points": {"A": [0, 0], "B": {"from": "A", "distance": "l", "angle": "theta"},
                   "D": {"from": "A", "distance": "l/2", "angle": "theta"}},
        "bodies": {
            "ground": {"shape": "fixed"},
            "one": {"shape": "rod", "mass": "m", "length": "l", "angle": "theta",
                    "center": {"from": "A", "distance": "l/2", "angle": "theta"}},
            "two": {"shape": "rod", "mass": "m", "length": "l", "angle": "theta",
                    "center": {"from": "A", "distance": "l/2", "angle": "theta"}}
        },
        "hinges": {"A": {"bodies": ["ground", "one"], "at": "A"}, "B": {"bodies": ["one", "two"], "at": "B"},
                   "D": {"bodies": ["one", "two"], "at": "D"}},
        "blows": {"Q": {"on": "two", "at": "B", "impulse": ["0", "J"]}},
        "questions": {"omega": {"spin": "one"}, "v": {"velocity": "two"}}
    }"#;

    #[test]
    fn a_bar_held_twice_over_turns_as_it_must_at_irrational_values() {
        let scene = read(HELD_TWICE).expect("a scene");
        let found = correct(&scene).expect("determined");
        assert!(!found.left_out.is_empty() && !found.is_complete());
        // ω = J l cosθ / (2 · m l²/3).
        let omega = found.answers[0].1.as_ref().expect("a number");
        let (value, how) = value(&omega[0]);
        assert_eq!(how, How::Bits(256));
        let near = 3.0 * (std::f64::consts::PI / 7.0).cos();
        assert!((value - near).abs() < 1e-15, "{value} {near}");
        assert!(found.unknowns.iter().any(|(_, c)| *c == Correct::Open));
    }

    #[test]
    fn a_velocity_that_cancels_for_irrational_values_is_left_undecided() {
        let all = numbers(&[("theta", "acos(1/sqrt(5))"), ("e", "3/5")]);
        assert_eq!(all[1], Correct::Undecided(0.0));
    }
}
