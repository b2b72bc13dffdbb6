//! Variants of a question: exact values inside the domains at which the right answer and the wrong ones keep apart.

use num_traits::{Signed, Zero};

use super::{VARIANTS, Wrong};
use crate::expr::number::to_f64;
use crate::expr::{Expr, Point, Rational, Symbol};
use crate::formula::{Sentence, write_plain};
use crate::numeric;
use crate::scene::Scene;

/// Points looked at for variants.
const TRIED: u64 = 60;
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

/// Variants for an answer; none where a symbol is an angle and a plain factor at once, which no fraction fits. What is
/// `given` must hold in each; of what is `supposed`, which may be of several cases, as much holds as at any point that was looked at.
pub(super) fn variants(
    scene: &Scene,
    answer: &Expr,
    wrong: &[Wrong],
    [given, supposed]: [&[Sentence]; 2],
) -> Vec<Variant> {
    let mut needed = numeric::needed(scene);
    needed.add(answer);
    wrong.iter().for_each(|w| needed.add(&w.answer));
    if needed.angles.keys().any(|name| needed.plain.contains(name)) {
        return Vec::new();
    }
    let points = (0..TRIED).map(|seed| numeric::random_point(&needed, &scene.domains, seed));
    let found = points.filter(|p| broken(given, p) == 0);
    let found =
        found.filter_map(|p| Some((broken(supposed, &p), variant(scene, &p, answer, wrong)?)));
    let mut found: Vec<(usize, Variant)> = found.collect();
    let least = found.iter().map(|(broken, _)| *broken).min();
    found.retain(|(broken, _)| Some(*broken) == least);
    // Those at which most wrong answers are told apart come first.
    found.sort_by_key(|(_, v)| v.wrong.iter().filter(|w| w.is_none()).count());
    found.into_iter().take(VARIANTS).map(|(_, v)| v).collect()
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

fn variant(
    scene: &Scene,
    point: &Point<Rational>,
    answer: &Expr,
    wrong: &[Wrong],
) -> Option<Variant> {
    let doubles = numeric::rounded(point);
    let right: f64 = answer.evaluate(&doubles)?;
    if !right.is_finite() || right.abs() < 1e-9 {
        return None;
    }
    let mut told = vec![right];
    let apart = |value: f64| {
        let value: f64 = value;
        let close = |other: &f64| (value - other).abs() <= APART * value.abs().max(other.abs());
        let is_new = value.is_finite() && !told.iter().any(close);
        is_new.then(|| {
            told.push(value);
            value
        })
    };
    let mut apart = apart;
    let wrong = wrong
        .iter()
        .map(|w| w.answer.evaluate(&doubles).and_then(&mut apart));
    let wrong: Vec<Option<f64>> = wrong.collect();
    let mut values = Vec::new();
    for p in &scene.parameters {
        if let Some(value) = point.values.get(&p.name) {
            values.push((p.name.clone(), Exact::Fraction(value.clone())));
        } else if let Some((times, [cosine, sine])) = point.directions.get(&p.name) {
            let is_below = sine.is_negative();
            // Half a turn has no sign; its cosine says all.
            let is_below = is_below && !sine.is_zero();
            values.push((
                p.name.clone(),
                Exact::Angle(*times, cosine.clone(), is_below),
            ));
        }
    }
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
