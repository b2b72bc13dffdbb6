//! The correctly rounded double of every unknown: by balls where they are narrow enough, by exact integers where not.
//!
//! In: a scene's numbers as doubles, taken as exact. Out: for each unknown the double nearest to the true value, and how
//! it was found. Plain doubles with a bound can tell a rounding only where nothing was rounded before, and balls cost no
//! more than nalgebra's elimination, so balls go first and also tell where doubles would have done. Balls and doubles past
//! the range of doubles make a case for the integers, which have no range.

use super::ball::Ball;
use super::contact_space::enclosures;
use super::dyadic::solve_dyadic;
use super::exact::solve_exact;
use super::field::eliminate;
use super::given::{Given, Undefined, given};
use super::number::Number;
use super::solution::{Contradiction, Solution};
use super::system::{Unknown, assemble, unknowns};
use crate::expr::number::{from_f64, to_f64};
use crate::expr::{Point, Rational, Scalar};
use crate::scene::Scene;

/// How an unknown's double was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Tier {
    /// Doubles, and none of them was rounded.
    Double,
    /// A double-double with a rigorous error bound.
    Ball,
    /// Exact integers.
    Exact,
}

/// Correctly rounded values.
#[derive(Clone, Debug, Default, PartialEq)]
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
    let mut found = Certified::default();
    certify_into(given, &mut found)?;
    Ok(found)
}

/// The same into what an earlier scene has left, so that one scene after another needs no new memory.
pub fn certify_into(given: &Given<f64>, found: &mut Certified) -> Result<(), Uncertified> {
    unknowns(given, &mut found.unknowns);
    found.start();
    let mut told = true;
    let mut slots = found.solution.values.iter_mut().zip(&mut found.tiers);
    let solved = enclosures(given, |ball| {
        if let Some((value, tier)) = slots.next() {
            told &= take(&ball, value, tier);
        }
    });
    if solved.is_some() && told {
        return Ok(());
    }
    let mut balls = Vec::new();
    let enclosure = match enclosures(given, |ball| balls.push(ball)) {
        Some(()) => Some(balls),
        None => {
            let all = eliminate(&assemble(&given.map(|v| Ball::exact(*v))));
            if all.as_ref().is_some_and(|balls| found.take_all(balls)) {
                return Ok(());
            }
            all
        }
    };
    let solution = solve_exactly(given)?;
    let unknowns = std::mem::take(&mut found.unknowns);
    *found = finish(solution, unknowns, enclosure.as_deref());
    Ok(())
}

impl Certified {
    /// Makes room for as many unknowns as there are names.
    fn start(&mut self) {
        let n = self.unknowns.len();
        self.solution.values.resize(n, f64::NAN);
        self.tiers.resize(n, Tier::Exact);
        self.solution.unique.clear();
        self.solution.unique.resize(n, true);
        self.solution.rank = n;
    }

    /// The roundings of balls; false where one is too wide.
    fn take_all(&mut self, balls: &[Ball]) -> bool {
        self.start();
        let slots = self.solution.values.iter_mut().zip(&mut self.tiers);
        let all = slots
            .zip(balls)
            .map(|((value, t), ball)| take(ball, value, t));
        all.fold(true, |told, one| told & one)
    }
}

/// The rounding of a ball and what it took; false where the ball is too wide.
#[inline(always)]
fn take(ball: &Ball, value: &mut f64, told: &mut Tier) -> bool {
    let rounded = ball.rounded();
    *value = rounded.unwrap_or(f64::NAN);
    *told = tier(ball);
    rounded.is_some()
}

/// What an enclosure that rounds to one double is good for.
#[inline(always)]
fn tier(ball: &Ball) -> Tier {
    match ball.as_double() {
        Some(_) => Tier::Double,
        None => Tier::Ball,
    }
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
    let mut found = Certified {
        unknowns: balls.unknowns,
        ..Certified::default()
    };
    if enclosure
        .as_ref()
        .is_some_and(|balls| found.take_all(balls))
    {
        return Ok(found);
    }
    let exact = map_point(at, |v| from_f64(*v)).ok_or(Uncertified::NotFinite)?;
    match given::<Rational>(scene, &exact) {
        Ok(numbers) => {
            let solution = solve_exact(&assemble(&numbers)).map_err(Uncertified::Contradiction)?;
            Ok(finish(
                rounded(solution),
                found.unknowns,
                enclosure.as_deref(),
            ))
        }
        Err(undefined) => Err(match enclosure {
            Some(values) => Uncertified::TooClose(
                values
                    .iter()
                    .map(|b| (b.middle.high, b.radius() + b.middle.low.abs()))
                    .collect(),
            ),
            None => Uncertified::Undefined(undefined),
        }),
    }
}

fn rounded(exact: Solution<Rational>) -> Solution<f64> {
    Solution {
        values: exact.values.iter().map(to_f64).collect(),
        unique: exact.unique,
        rank: exact.rank,
    }
}

/// Exact values, marked by tier.
fn finish(exact: Solution<f64>, unknowns: Vec<Unknown>, enclosure: Option<&[Ball]>) -> Certified {
    let told = |i: usize| {
        let ball = enclosure.map(|e| &e[i])?;
        ball.rounded().map(|_| tier(ball))
    };
    let tiers = (0..unknowns.len()).map(|i| told(i).unwrap_or(Tier::Exact));
    Certified {
        tiers: tiers.collect(),
        unknowns,
        solution: exact,
    }
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
