//! Linear systems with symbolic coefficients.
//!
//! Elimination takes the shortest way: among the remaining entries the pivot is the one whose use fills in least, then
//! the simplest coefficient, then the first. Rows and unknowns that do not need each other are thereby solved apart.
//! Small regular systems with sines and cosines go by [`minors`] instead.

use super::Stop;
use super::element::Element;
use super::field::{Field, Kind};
use super::minors::{self, Row};

/// Most unknowns of a system that is solved by determinants; their number of terms grows like 2ⁿ.
const MOST_BY_MINORS: usize = 6;

/// One division of the elimination: the equation, the unknown it was solved for, and its coefficient.
struct Pivot {
    row: usize,
    unknown: usize,
    value: Element,
}

/// What a linear system determines.
#[derive(Clone, Debug)]
pub struct Solution {
    /// Value of each unknown, `None` where the system leaves it open.
    pub values: Vec<Option<Element>>,
    /// Rank of the coefficient matrix.
    pub rank: usize,
    /// An equation the others contradict, by index.
    pub contradiction: Option<usize>,
    /// Unknowns chosen as free, by index; others may still depend on them.
    pub free: Vec<usize>,
    /// What was divided by; the solution holds where none of it is zero. Its product is the determinant up to sign.
    pub divisors: Vec<Element>,
}

/// Solves the rows for n unknowns. Coefficients of unknowns ≥ n are an error of the caller and are ignored.
pub fn solve(field: &Field, rows: &[Row], n: usize) -> Result<Solution, Stop> {
    field.fuel.refill();
    if rows.len() == n
        && (2..=MOST_BY_MINORS).contains(&n)
        && rows.iter().any(|row| is_trigonometric(field, row))
        && let Some((values, determinant)) = minors::quotients(field, rows)?
    {
        return Ok(Solution {
            values: values.into_iter().map(Some).collect(),
            rank: n,
            contradiction: None,
            free: Vec::new(),
            divisors: vec![determinant],
        });
    }
    let mut work: Vec<Vec<(usize, Element)>> = rows
        .iter()
        .map(|row| {
            let mut coeffs: Vec<_> = row
                .coeffs
                .iter()
                .filter(|(j, c)| *j < n && !field.is_zero(c))
                .cloned()
                .collect();
            coeffs.sort_by_key(|(j, _)| *j);
            coeffs
        })
        .collect();
    let mut rhs: Vec<Element> = rows.iter().map(|r| r.rhs.clone()).collect();
    let mut open: Vec<usize> = (0..rows.len()).collect();
    let mut pivots: Vec<Pivot> = Vec::new();
    while let Some((row, unknown)) = choose(&work, &open, n) {
        let value = coefficient(&work[row], unknown)
            .cloned()
            .ok_or(Stop::DivisionByZero)?;
        open.retain(|r| *r != row);
        for &other in &open {
            let Some(entry) = coefficient(&work[other], unknown) else {
                continue;
            };
            let factor = field.div(entry, &value)?;
            rhs[other] = field.sub(&rhs[other], &field.mul(&factor, &rhs[row])?)?;
            work[other] = minus(field, &work[other], &factor, &work[row], unknown)?;
        }
        pivots.push(Pivot {
            row,
            unknown,
            value,
        });
    }
    let contradiction = open.iter().copied().find(|r| !field.is_zero(&rhs[*r]));
    let free: Vec<usize> = (0..n)
        .filter(|j| pivots.iter().all(|p| p.unknown != *j))
        .collect();
    // Back: every pivot unknown as constant + Σ coefficient·free unknown.
    let mut affine: Vec<Option<Affine>> = vec![None; n];
    for j in &free {
        affine[*j] = Some((Element::zero(), vec![(*j, field.integer(1))]));
    }
    for pivot in pivots.iter().rev() {
        let mut constant = rhs[pivot.row].clone();
        let mut dependence: Vec<(usize, Element)> = Vec::new();
        for (j, c) in work[pivot.row].iter().filter(|(j, _)| *j != pivot.unknown) {
            let Some((value, slopes)) = &affine[*j] else {
                continue;
            };
            constant = field.sub(&constant, &field.mul(c, value)?)?;
            dependence = minus(field, &dependence, c, slopes, usize::MAX)?;
        }
        let dependence = dependence
            .into_iter()
            .map(|(j, c)| Ok((j, field.div(&c, &pivot.value)?)))
            .collect::<Result<_, Stop>>()?;
        affine[pivot.unknown] = Some((field.div(&constant, &pivot.value)?, dependence));
    }
    let consistent = contradiction.is_none();
    let values = affine
        .into_iter()
        .map(|a| {
            a.and_then(|(value, dependence)| (consistent && dependence.is_empty()).then_some(value))
        })
        .collect();
    Ok(Solution {
        values,
        rank: pivots.len(),
        contradiction,
        free,
        divisors: pivots.into_iter().map(|p| p.value).collect(),
    })
}

/// Whether sines and cosines occur.
fn is_trigonometric(field: &Field, row: &Row) -> bool {
    let of = |x: &Element| {
        let mut variables = x.num.variables().into_iter();
        variables.any(|v| matches!(field.gens[v].kind, Kind::Sin(_)))
    };
    of(&row.rhs) || row.coeffs.iter().any(|(_, c)| of(c))
}

/// A constant and coefficients of free unknowns.
type Affine = (Element, Vec<(usize, Element)>);

/// Fill-in, length, whether symbolic, width of the row.
type Cost = (usize, usize, usize, usize);

fn coefficient(row: &[(usize, Element)], unknown: usize) -> Option<&Element> {
    row.iter().find(|(j, _)| *j == unknown).map(|(_, c)| c)
}

/// row − factor·other without the entry of one unknown.
fn minus(
    field: &Field,
    row: &[(usize, Element)],
    factor: &Element,
    other: &[(usize, Element)],
    without: usize,
) -> Result<Vec<(usize, Element)>, Stop> {
    let mut out = Vec::with_capacity(row.len() + other.len());
    let (mut i, mut k) = (0, 0);
    while i < row.len() || k < other.len() {
        let a = row.get(i).map_or(usize::MAX, |e| e.0);
        let b = other.get(k).map_or(usize::MAX, |e| e.0);
        let j = a.min(b);
        let value = if j == without {
            None
        } else if a < b {
            Some(row[i].1.clone())
        } else if b < a {
            Some(field.neg(&field.mul(factor, &other[k].1)?))
        } else {
            Some(field.sub(&row[i].1, &field.mul(factor, &other[k].1)?)?)
        };
        if let Some(value) = value.filter(|v| !field.is_zero(v)) {
            out.push((j, value));
        }
        i += usize::from(a == j);
        k += usize::from(b == j);
    }
    Ok(out)
}

/// The entry whose use costs least: fill-in (Markowitz), then length of the coefficient, then position.
fn choose(work: &[Vec<(usize, Element)>], open: &[usize], n: usize) -> Option<(usize, usize)> {
    let mut column = vec![0usize; n];
    for row in open {
        for (j, _) in &work[*row] {
            column[*j] += 1;
        }
    }
    let mut best: Option<(Cost, (usize, usize))> = None;
    for &row in open {
        let width = work[row].len();
        for (j, c) in &work[row] {
            let plain = usize::from(c.as_number().is_none());
            let cost = ((width - 1) * (column[*j] - 1), c.size(), plain, width);
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, (row, *j)));
            }
        }
    }
    best.map(|(_, at)| at)
}
