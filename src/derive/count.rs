//! Counting: how many equations and unknowns the full system has, its rank, and which unknowns it determines.
//!
//! Where the scene has rational points, the rank is that of the exact matrix at one rational point of the domain. A point can only lower the rank, so "of full
//! rank" and "determined" are proved by it; where the rank falls short, further points are tried, and the largest stands.

use super::{Stop, Work};
use crate::algebra;

use crate::domain::{Coordinate, roles, samples};
use crate::expr::rows::Echelon;
use crate::expr::{Expr, Point, Rational, Vector, ratio};
use crate::laws::{self, Direction, Geometry, Kinematics, Law, Linear, Place, Unknown};
use crate::scene::{ContactLaw, Scene};

/// What counting says about the full system.
#[derive(Clone, Debug)]
pub struct Counting {
    /// Number of scalar equations.
    pub equations: usize,
    /// Number of scalar unknowns.
    pub unknowns: usize,
    /// Rank of the coefficient matrix.
    pub rank: usize,
    /// Unknowns that the equations do not determine.
    pub open: Vec<Unknown>,
    /// Whether the equations contradict each other.
    pub contradictory: bool,
    /// Equations of which a combination reads 0 = 1, in words; empty where there is no contradiction.
    pub conflict: Vec<String>,
    /// Rank after balances of the whole system are added: never more, which is worth saying.
    pub rank_with_system: usize,
    /// Contact laws that would close the equations, in words.
    pub closing_laws: Vec<String>,
}

impl Counting {
    /// Whether every unknown is determined.
    pub fn determined(&self) -> bool {
        self.open.is_empty() && !self.contradictory
    }

    /// Whether one unknown is determined.
    pub fn is_unique(&self, unknown: Unknown) -> bool {
        !self.open.contains(&unknown)
    }
}

/// Counts the full system of a scene.
pub fn count(scene: &Scene) -> Result<Counting, Stop> {
    let laws = laws::of(scene);
    let unknowns = laws::unknowns(scene);
    let system = system_balances(scene);
    let mut best: Option<Counting> = None;
    for attempt in 0..4 {
        let Some(rows) = rational_rows(scene, &unknowns, laws.iter(), attempt) else {
            continue;
        };
        let echelon = Echelon::of(&rows, unknowns.len());
        let rank = echelon.pivots.len();
        let full = rank == unknowns.len().min(laws.len());
        let rank_with_system = if system.is_empty() || full && rank == unknowns.len() {
            rank
        } else {
            rational_rows(scene, &unknowns, laws.iter().chain(&system), attempt)
                .map_or(rank, |rows| Echelon::of(&rows, unknowns.len()).pivots.len())
        };
        let open = unknowns.iter().zip(&echelon.unique);
        let open = open.filter(|(_, unique)| !**unique);
        let counting = Counting {
            equations: laws.len(),
            unknowns: unknowns.len(),
            rank,
            open: open.map(|(u, _)| *u).collect(),
            contradictory: echelon.conflict.is_some(),
            conflict: echelon
                .conflict
                .iter()
                .flatten()
                .map(|&i| laws::describe(scene, &laws[i]))
                .collect(),
            rank_with_system,
            closing_laws: closing_laws(scene),
        };
        if full && !counting.contradictory {
            return Ok(counting);
        }
        if best
            .as_ref()
            .is_none_or(|b| b.rank < counting.rank || (b.contradictory && !counting.contradictory))
        {
            best = Some(counting);
        }
    }
    match best {
        Some(counting) => Ok(counting),
        None => count_symbolically(scene, &laws, &unknowns),
    }
}

/// The same where the scene has no rational point, as with an angle of 30°: by elimination over the functions themselves.
fn count_symbolically(scene: &Scene, laws: &[Law], unknowns: &[Unknown]) -> Result<Counting, Stop> {
    let mut work = Work::new(scene)?;
    let full = Kinematics::full(scene, &work.g);
    let mut rows = Vec::new();
    for law in laws {
        let linear = laws::symbolic(scene, &work.g, &full, law);
        let mut coeffs = Vec::new();
        for (unknown, k) in &linear.terms {
            if let Some(i) = unknowns.iter().position(|u| u == unknown) {
                coeffs.push((i, work.field.element(k)?));
            }
        }
        rows.push(algebra::Row {
            coeffs,
            rhs: work.field.element(&linear.known)?,
        });
    }
    let solution = algebra::solve(&work.field, &rows, unknowns.len())?;
    let open = solution
        .values
        .iter()
        .zip(unknowns)
        .filter(|(v, _)| v.is_none());
    Ok(Counting {
        equations: laws.len(),
        unknowns: unknowns.len(),
        rank: solution.rank,
        open: open.map(|(_, u)| *u).collect(),
        contradictory: solution.contradiction.is_some(),
        conflict: solution
            .contradiction
            .iter()
            .map(|&i| laws::describe(scene, &laws[i]))
            .collect(),
        rank_with_system: solution.rank,
        closing_laws: closing_laws(scene),
    })
}

/// Balances of all movable bodies together: combinations of those of the single bodies.
fn system_balances(scene: &Scene) -> Vec<Law> {
    let system: Vec<usize> = scene.moving().collect();
    if system.len() < 2 {
        return Vec::new();
    }
    let along = [Direction::X, Direction::Y];
    let mut laws = along.map(|d| Law::linear(&system, d)).to_vec();
    if !scene.contacts.is_empty() {
        laws.push(Law::angular(&system, Place::Contact(0)));
    }
    laws
}

/// For every contact without a law, the two laws that are not controversial (section 17.5).
fn closing_laws(scene: &Scene) -> Vec<String> {
    let mut out = Vec::new();
    for contact in scene.contacts.iter().filter(|c| c.law == ContactLaw::None) {
        let at = &contact.name;
        out.push(format!(
            "sticking at {at}: 2 more equations, equal velocities of the touching points after"
        ));
        out.push(format!("frictionless at {at} with restitution e: 1 unknown less, impulse along the normal; 1 more equation"));
    }
    out
}

/// The full system at a rational point; `None` where a formula of the scene has no rational value there.
fn rational_rows<'a>(
    scene: &Scene,
    unknowns: &[Unknown],
    laws: impl Iterator<Item = &'a Law>,
    attempt: usize,
) -> Option<Vec<Vec<Rational>>> {
    let point = exact_point(scene, attempt)?;
    let value = |e: &Expr| e.evaluate(&point).ok_or(());
    let g = Geometry::<Rational>::of(scene, value).ok()?;
    let motion = Kinematics::full(scene, &g);
    let linear: Option<Vec<Linear<Rational>>> = laws
        .map(|law| {
            let vector = |v: &Vector| Ok::<_, ()>([value(&v[0])?, value(&v[1])?]);
            laws::equation(scene, &g, &motion, law, vector).ok()
        })
        .collect();
    Some(linear?.iter().map(|row| dense(row, unknowns)).collect())
}

/// The sample point of the scene's domain with this number, exact.
fn exact_point(scene: &Scene, number: usize) -> Option<Point<Rational>> {
    let formulas = super::work::formulas(scene);
    let roles = roles(&formulas.iter().collect::<Vec<_>>());
    let (domains, _) = scene.domains.completed(&roles);
    // The first sample gives every symbol the same simple value, which is not a general position.
    let sample = samples(&roles, &domains, number + 2)
        .into_iter()
        .nth(number + 1)?;
    let is_round = |at: &Coordinate| matches!(at, Coordinate::Pi(_));
    (!sample.coordinates.values().any(is_round)).then(|| sample.fractions())
}

/// Coefficients and right side.
fn dense(linear: &Linear<Rational>, unknowns: &[Unknown]) -> Vec<Rational> {
    let mut out = vec![ratio(0, 1); unknowns.len() + 1];
    for (unknown, k) in &linear.terms {
        if let Some(i) = unknowns.iter().position(|u| u == unknown) {
            out[i] = k.clone();
        }
    }
    out[unknowns.len()] = linear.known.clone();
    out
}
