//! The formula that comes out of a scene under a slip: its altered equations, solved with symbols.
//!
//! In: what is asked, and a slip. Out: closed forms, each held against the doubles of the same slip at points of the domain.

use super::super::belief::{Change, Slip};
use super::{POINTS, Written, outcome};
use crate::algebra::{self, Field, Row, solve};
use crate::domain::Domains;
use crate::expr::{Expr, Point};
use crate::numeric::{self, Solution, System};

/// Largest closed form; what is longer nobody writes.
const LARGEST: usize = 400;

/// The closed forms of what is asked under a slip; `None` where there are none, or where they do not meet the doubles.
pub(in crate::grade) fn formulas(written: &Written, slip: &Slip) -> Option<Vec<Expr>> {
    let domains = &written.scene.domains;
    let mut point = Point::<Expr>::default();
    for p in &slip.scene.parameters {
        let itself = Expr::symbol(&p.name);
        point.values.insert(p.name.clone(), itself);
    }
    let values = match slip.change {
        Some(Change::EnergyKept) => {
            outcome::energy_kept(written, slip, &point, |_, _| true, |s| solved(s, domains))?
        }
        _ => outcome::outcome(written, slip, &point, |s| solved(s, domains))?,
    };
    let tidy = |value: &Expr| {
        let value = algebra::tidy(value, domains).ok();
        value.filter(|e| e.size() <= LARGEST)
    };
    // What is many times too long as it is solved does not become short, and takes seconds to show it.
    if values.iter().any(|v| v.size() > 4 * LARGEST) {
        return None;
    }
    let values: Vec<Expr> = values.iter().map(tidy).collect::<Option<_>>()?;
    meets_doubles(written, slip, &values).then_some(values)
}

/// The solution of a regular system.
fn solved(system: &System<Expr>, domains: &Domains) -> Option<Solution<Expr>> {
    let n = system.unknowns.len();
    let mut field = Field::new(domains);
    let entries = system.matrix.iter().chain(&system.right);
    field.prepare(entries);
    let mut rows = Vec::new();
    for (i, right) in system.right.iter().enumerate() {
        let mut coeffs = Vec::new();
        for (j, entry) in system.row(i).iter().enumerate() {
            if !entry.is_zero() {
                coeffs.push((j, field.element(entry).ok()?));
            }
        }
        let rhs = field.element(right).ok()?;
        rows.push(Row { coeffs, rhs });
    }
    let found = solve(&field, &rows, n).ok()?;
    if found.contradiction.is_some() {
        return None;
    }
    let unique: Vec<bool> = found.values.iter().map(Option::is_some).collect();
    let value = |v: &Option<_>| v.as_ref().map_or_else(Expr::zero, |v| field.stored(v));
    Some(Solution {
        values: found.values.iter().map(value).collect(),
        unique,
        rank: found.rank,
    })
}

/// Whether formulas have the values that the slip leads to in doubles, at two points at least.
fn meets_doubles(written: &Written, slip: &Slip, values: &[Expr]) -> bool {
    let mut needed = numeric::needed(written.scene);
    values.iter().for_each(|e| needed.add(e));
    let mut met = 0;
    for seed in 0..2 * POINTS {
        let point = numeric::random_point(&needed, &written.scene.domains, seed);
        let point = numeric::rounded(&point);
        let Some(doubles) = outcome::doubles(written, slip, &point) else {
            continue;
        };
        let found: Option<Vec<f64>> = values.iter().map(|e| e.evaluate(&point)).collect();
        let close = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-9 * a.abs().max(b.abs()).max(1e-12);
        match found {
            Some(found) if found.len() == doubles.len() => {
                if !found.iter().zip(&doubles).all(close) {
                    return false;
                }
                met += 1;
            }
            _ => return false,
        }
    }
    met >= 2
}
