//! Variants of a question: exact values inside the domains at which the right answer and the wrong ones keep apart.

use num_traits::{Signed, Zero};

use super::{VARIANTS, Wrong};
use crate::expr::number::to_f64;
use crate::expr::{Expr, Function, Point, Rational, Symbol};
use crate::formula::{Sentence, write_plain};
use crate::numeric::follow::{self, Loss};
use crate::numeric::{self, Answered, Needed, NoAnswer};
use crate::scene::Scene;

/// Points drawn for variants, and how many of those that keep to the conditions are looked at.
const DRAWN: u64 = 10_000;
const TRIED: usize = 60;
/// Share by which the number of the scene followed in numbers may differ: motions are integrated.
const SAME: f64 = 1e-6;
/// Share by which a wrong number differs at least from the right one.
const APART: f64 = 0.05;

/// Exact values of the symbols, and the answers there.
#[derive(Clone, Debug)]
pub(super) struct Variant {
    /// The values.
    pub values: Vec<(Symbol, Exact)>,
    /// The right answer.
    pub right: f64,
    /// The wrong answers, in their order; `None` where one is not told from a right one or another before it.
    pub wrong: Vec<Option<f64>>,
}

/// An exact value.
#[derive(Clone, Debug)]
pub(super) enum Exact {
    /// A fraction.
    Fraction(Rational),
    /// An angle by a multiple of it: how often it is taken, its cosine, and whether it lies below zero.
    Angle(u32, Rational, bool),
}

impl Exact {
    /// The value of a symbol at a point.
    fn of(point: &Point<Rational>, name: &Symbol) -> Option<Exact> {
        if let Some(value) = point.values.get(name) {
            return Some(Exact::Fraction(value.clone()));
        }
        let (times, [cosine, sine]) = point.directions.get(name)?;
        // Half a turn has no sign; its cosine says all.
        let is_below = sine.is_negative() && !sine.is_zero();
        Some(Exact::Angle(*times, cosine.clone(), is_below))
    }

    /// As an expression.
    fn expr(&self) -> Expr {
        match self {
            Exact::Fraction(value) => Expr::from(value.clone()),
            Exact::Angle(times, cosine, is_below) => {
                let times = i64::from(*times) * if *is_below { -1 } else { 1 };
                Expr::from(times) * Expr::call(Function::Acos, Expr::from(cosine.clone()))
            }
        }
    }

    /// In infix notation; `arccosine` is the name of the function.
    pub fn written(&self, arccosine: &str) -> String {
        match self {
            Exact::Fraction(value) => write_plain(&Expr::from(value.clone())),
            Exact::Angle(times, cosine, is_below) => {
                let cosine = write_plain(&Expr::from(cosine.clone()));
                let sign = if *is_below { "-" } else { "" };
                match times {
                    1 => format!("{sign}{arccosine}({cosine})"),
                    n => format!("{sign}{n}*{arccosine}({cosine})"),
                }
            }
        }
    }

    /// In LaTeX.
    pub fn latex(&self) -> String {
        let latex = |v: &Rational| crate::formula::write_latex(&Expr::from(v.clone()), &|_| None);
        match self {
            Exact::Fraction(value) => latex(value),
            Exact::Angle(times, cosine, is_below) => {
                let sign = if *is_below { "-" } else { "" };
                let times = if *times == 1 {
                    String::new()
                } else {
                    times.to_string()
                };
                format!("{sign}{times}\\arccos\\left({}\\right)", latex(cosine))
            }
        }
    }
}

/// What variants are drawn for.
pub(super) struct Asked<'a> {
    /// The scene as its file has it.
    pub scene: &'a Scene,
    /// The part of it that the answer was derived from.
    pub derived: &'a Scene,
    /// Name of the answer.
    pub name: &'a str,
    /// The right answer.
    pub answer: &'a Expr,
    /// The wrong ones.
    pub wrong: &'a [Wrong],
    /// What the answer rests on.
    pub given: &'a [Sentence],
    /// What the stages suppose.
    pub supposed: &'a [Sentence],
}

/// Variants for an answer; none where a symbol is an angle and a plain factor at once, which no fraction fits. What is
/// given must hold in each, and the scene followed in numbers must give the same; of what is supposed, which may be of several
/// cases, as much holds as at any point that was looked at, and all of it where there is one case alone.
pub(super) fn variants(asked: &Asked) -> Vec<Variant> {
    let Asked { derived, given, .. } = *asked;
    let alone = !asked.scene.has_stages();
    let mut needed = numeric::needed(derived);
    needed.add(asked.answer);
    asked.wrong.iter().for_each(|w| needed.add(&w.answer));
    let supposed = asked.supposed.iter().filter(|_| alone);
    let conditions = given.iter().chain(supposed).flat_map(Sentence::conditions);
    conditions.for_each(|(e, _)| needed.add(&e));
    if needed.angles.keys().any(|name| needed.plain.contains(name)) {
        return Vec::new();
    }
    // What the answer does not depend on has to have a value all the same for the scene to be followed, and is not told.
    let mut all = needed.clone();
    let others = asked.scene.parameters.iter().map(|p| &p.name);
    let others = others.filter(|name| !needed.angles.contains_key(*name));
    all.plain.extend(others.cloned());
    let points = (0..DRAWN).map(|seed| numeric::random_point(&all, &derived.domains, seed));
    let points = points.filter(|p| broken(given, p) == 0).take(TRIED);
    let found = points.filter_map(|p| {
        let untrue = broken(asked.supposed, &p);
        Some((untrue, variant(asked, &needed, &p)?, p))
    });
    let mut found: Vec<(usize, Variant, Point<Rational>)> = found.collect();
    let least = found.iter().map(|(untrue, ..)| *untrue).min();
    found.retain(|(untrue, ..)| Some(*untrue) == least && !(alone && *untrue > 0));
    // Those at which most wrong answers are told apart come first.
    found.sort_by_key(|(_, v, _)| v.wrong.iter().filter(|w| w.is_none()).count());
    let found = found
        .into_iter()
        .filter(|(_, v, p)| is_followed(asked, v, p));
    found.take(VARIANTS).map(|(_, v, _)| v).collect()
}

/// Whether the scene followed in numbers gives the right answer of a variant, as far as it can be followed: an answer of one
/// case is wrong at values that lead to another.
fn is_followed(asked: &Asked, variant: &Variant, at: &Point<Rational>) -> bool {
    let Asked { scene, name, .. } = *asked;
    let number = match scene.has_stages() {
        true => {
            let doubles = numeric::rounded(at);
            let Ok(followed) = follow::follow(scene, &doubles) else {
                return false;
            };
            let lost = followed.stages.iter().filter_map(|s| s.as_ref().err());
            if lost
                .into_iter()
                .any(|lost| !matches!(lost.why, Loss::OutOfReach(_) | Loss::After(_)))
            {
                return false;
            }
            follow::named(scene, &followed, &name.into(), &doubles)
        }
        false => {
            let mut scene = scene.clone();
            for p in &mut scene.parameters {
                p.value = Exact::of(at, &p.name).map(|value| value.expr());
            }
            match numeric::doubles(&scene) {
                Ok(found) => number(found, name),
                Err(NoAnswer::Contradiction(_)) => return false,
                Err(_) => None,
            }
        }
    };
    number.is_none_or(|n| (n - variant.right).abs() <= SAME * n.abs().max(variant.right.abs()))
}

/// The number of an answer among those of questions.
fn number(found: Answered<f64>, name: &str) -> Option<f64> {
    found.into_iter().find_map(|(question, answer)| {
        let part = name.strip_prefix(question.as_str())?;
        let parts = answer.ok()?.components().into_iter();
        parts.filter(|(own, _)| *own == part).map(|(_, n)| n).next()
    })
}

/// How many conditions do not hold at a point.
fn broken(conditions: &[Sentence], at: &Point<Rational>) -> usize {
    let doubles: Point<f64> = numeric::rounded(at);
    let holds = |(e, is_open): &(Expr, bool)| match e.evaluate(&doubles) {
        Some(value) => value > 0.0 || value == 0.0 && !is_open,
        None => true,
    };
    let all = conditions.iter().flat_map(Sentence::conditions);
    all.filter(|condition| !holds(condition)).count()
}

fn variant(asked: &Asked, needed: &Needed, point: &Point<Rational>) -> Option<Variant> {
    let doubles = numeric::rounded(point);
    let right: f64 = asked.answer.evaluate(&doubles)?;
    if !right.is_finite() || right.abs() < 1e-9 {
        return None;
    }
    let mut told = vec![right];
    let mut apart = |value: f64| {
        let close = |other: &f64| (value - other).abs() <= APART * value.abs().max(other.abs());
        let is_new = value.is_finite() && !told.iter().any(close);
        // A number that is not told apart has its branch all the same, into which one behind it might fall.
        told.push(value);
        is_new.then_some(value)
    };
    let wrong = asked.wrong.iter();
    let wrong = wrong.map(|w| w.answer.evaluate(&doubles).and_then(&mut apart));
    let wrong: Vec<Option<f64>> = wrong.collect();
    let is_told = |s: &&Symbol| {
        needed.plain.contains(*s) || needed.angles.contains_key(*s) || is_component(asked, s)
    };
    let names = asked.derived.parameters.iter().map(|p| &p.name);
    let values = names.filter(is_told);
    let values = values.filter_map(|name| Some((name.clone(), Exact::of(point, name)?)));
    let values: Vec<(Symbol, Exact)> = values.collect();
    let short = |v: &Exact| match v {
        Exact::Fraction(v) | Exact::Angle(_, v, _) => {
            to_f64(&Rational::from(v.denom().clone())) < 1e3
        }
    };
    values.iter().all(|(_, v)| short(v)).then_some(Variant {
        values,
        right,
        wrong,
    })
}

/// Whether a symbol is a component of a unit vector: both are told, or none.
fn is_component(asked: &Asked, name: &Symbol) -> bool {
    asked
        .derived
        .domains
        .unit_vectors
        .iter()
        .flatten()
        .any(|n| n == name)
}
