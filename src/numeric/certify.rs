//! The correctly rounded double of every unknown: by balls where they are narrow enough, by exact integers where not.
//!
//! In: a scene's numbers as doubles, taken as exact. Out: for each unknown the double nearest to the true value, and how
//! it was found. Balls and doubles past the range of doubles
//! make a case for the integers, which have no range.

use super::ball::Ball;
use super::dyadic::solve_dyadic;
use super::exact::solve_exact;
use super::field::eliminate;
use super::given::{Given, Undefined, given};
use super::number::Number;
use super::solution::{Contradiction, Solution};
use super::system::{Unknown, assemble};
use crate::expr::number::{from_f64, to_f64};
use crate::expr::{Point, Rational, Scalar};
use crate::scene::Scene;

/// How an unknown's double was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Tier {
    /// A double-double with a rigorous error bound.
    Ball,
    /// Exact integers.
    Exact,
}

/// Correctly rounded values.
#[derive(Clone, Debug, PartialEq)]
pub struct Certified {
    /// The unknowns, as [`assemble`] orders them.
    pub unknowns: Vec<Unknown>,
    /// For each the double nearest to the true value, and where it is not unique one of many.
    pub solution: Solution<f64>,
    /// How each was found.
    pub tiers: Vec<Tier>,
}

/// Why there is no certified answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Uncertified {
    /// The equations contradict each other.
    Contradiction(Contradiction),
    /// A quantity has no value at the point.
    Undefined(Undefined),
    /// Some values are irrational and too close to the middle between two doubles, or too far from all others, for
    /// double-doubles to tell: the enclosures, as middle and radius.
    TooClose(Vec<(f64, f64)>),
    /// An infinity or a NaN among the numbers of the scene.
    NotFinite,
}

/// Certifies the motion after of a scene whose numbers are exactly these doubles.
pub fn certify(given: &Given<f64>) -> Result<Certified, Uncertified> {
    let balls = assemble(&given.map(|v| Ball::exact(*v)));
    let enclosure = eliminate(&balls);
    if let Some(certified) = all_rounded(&balls.unknowns, enclosure.as_deref()) {
        return Ok(certified);
    }
    finish(solve_exactly(given)?, balls.unknowns, enclosure)
}

/// Certifies the motion after of a scene at a point. Formulas are evaluated in balls, and exactly where that is not enough.
pub fn certify_scene(scene: &Scene, at: &Point<f64>) -> Result<Certified, Uncertified> {
    let balls = assemble(
        &given(
            scene,
            &map_point(at, |v| Some(Ball::exact(*v))).ok_or(Uncertified::NotFinite)?,
        )
        .map_err(Uncertified::Undefined)?,
    );
    let enclosure = eliminate(&balls);
    if let Some(certified) = all_rounded(&balls.unknowns, enclosure.as_deref()) {
        return Ok(certified);
    }
    let exact = map_point(at, |v| from_f64(*v)).ok_or(Uncertified::NotFinite)?;
    match given::<Rational>(scene, &exact) {
        Ok(numbers) => {
            let solution = solve_exact(&assemble(&numbers)).map_err(Uncertified::Contradiction)?;
            finish(rounded(solution), balls.unknowns, enclosure)
        }
        Err(undefined) => Err(match enclosure {
            Some(values) => Uncertified::TooClose(
                values
                    .iter()
                    .map(|b| (b.middle.high, b.error + b.middle.low.abs()))
                    .collect(),
            ),
            None => Uncertified::Undefined(undefined),
        }),
    }
}

/// The outcome where every ball is narrow enough.
fn all_rounded(unknowns: &[Unknown], enclosure: Option<&[Ball]>) -> Option<Certified> {
    let values: Vec<f64> = enclosure?
        .iter()
        .map(Ball::rounded)
        .collect::<Option<_>>()?;
    let n = values.len();
    let solution = Solution {
        values,
        unique: vec![true; n],
        rank: n,
    };
    Some(Certified {
        unknowns: unknowns.to_vec(),
        solution,
        tiers: vec![Tier::Ball; n],
    })
}

fn rounded(exact: Solution<Rational>) -> Solution<f64> {
    Solution {
        values: exact.values.iter().map(to_f64).collect(),
        unique: exact.unique,
        rank: exact.rank,
    }
}

/// Exact values, marked by tier.
fn finish(
    exact: Solution<f64>,
    unknowns: Vec<Unknown>,
    enclosure: Option<Vec<Ball>>,
) -> Result<Certified, Uncertified> {
    let tier = |i: usize| match enclosure.as_ref().and_then(|e| e[i].rounded()) {
        Some(_) => Tier::Ball,
        None => Tier::Exact,
    };
    let tiers = (0..unknowns.len()).map(tier).collect();
    Ok(Certified {
        unknowns,
        solution: exact,
        tiers,
    })
}

fn solve_exactly(given: &Given<f64>) -> Result<Solution<f64>, Uncertified> {
    if let Some(values) = solve_dyadic(given) {
        let n = values.len();
        return Ok(Solution {
            values,
            unique: vec![true; n],
            rank: n,
        });
    }
    let mut finite = true;
    let exact = given.map(|v| {
        from_f64(*v).unwrap_or_else(|| {
            finite = false;
            <Rational as Number>::zero()
        })
    });
    if !finite {
        return Err(Uncertified::NotFinite);
    }
    solve_exact(&assemble(&exact))
        .map(rounded)
        .map_err(Uncertified::Contradiction)
}

fn map_point<T: Scalar>(at: &Point<f64>, f: impl Fn(&f64) -> Option<T>) -> Option<Point<T>> {
    let mut point = Point::default();
    for (name, value) in &at.values {
        point.values.insert(name.clone(), f(value)?);
    }
    for (name, (divisor, [c, s])) in &at.directions {
        point
            .directions
            .insert(name.clone(), (*divisor, [f(c)?, f(s)?]));
    }
    Some(point)
}
