//! Small square systems by determinants, without a division before the last.
//!
//! In: rows over trigonometric elements. Out: every unknown as a quotient of two determinants. Where sin² + cos² = 1 holds,
//! elimination divides by pivots that cannot be cancelled again later, such as sin β cos(α − β); a determinant has no
//! such factors, and its sign is that of the effective mass. Which systems go this way is the affair of [`mod@super::solve`].

use std::collections::BTreeMap;

use super::Stop;
use super::element::Element;
use super::field::Field;

/// One equation Σ coeff·x = rhs.
#[derive(Clone, Debug)]
pub struct Row {
    /// Unknown and its coefficient; an unknown appears at most once.
    pub coeffs: Vec<(usize, Element)>,
    /// Right-hand side.
    pub rhs: Element,
}

/// Minors of some columns by the set of their rows, as bits; those that vanish are left out.
type Minors = BTreeMap<u32, Element>;

/// The unknowns and the determinant; `None` where it vanishes. There must be as many rows as unknowns, at most 31.
pub(crate) fn quotients(
    field: &Field,
    rows: &[Row],
) -> Result<Option<(Vec<Element>, Element)>, Stop> {
    let n = rows.len();
    let entry = |row: usize, column: usize| -> Option<&Element> {
        if column == n {
            return Some(&rows[row].rhs);
        }
        let found = rows[row].coeffs.iter().find(|(j, _)| *j == column);
        found.map(|(_, value)| value)
    };
    // Minors of the columns before and after each one; the right side is column n.
    let mut before: Vec<Minors> = vec![BTreeMap::from([(0, field.integer(1))])];
    for column in 0..n {
        let above = |rows: u32, row: usize| rows >> row;
        let next = extended(field, &before[column], n, |row| entry(row, column), above)?;
        before.push(next);
    }
    let mut after: Vec<Minors> = vec![BTreeMap::from([(0, field.integer(1))])];
    for column in (1..=n).rev() {
        let below = |rows: u32, row: usize| rows & ((1 << row) - 1);
        let known = &after[n - column];
        after.push(extended(field, known, n, |row| entry(row, column), below)?);
    }
    let all = (1u32 << n) - 1;
    let Some(determinant) = before[n].get(&all).cloned() else {
        return Ok(None);
    };
    let mut values = Vec::with_capacity(n);
    for unknown in 0..n {
        // Laplace's expansion of the determinant without this column; the right side stands last.
        let mut total = Element::zero();
        for (rows, minor) in &before[unknown] {
            let Some(rest) = after[n - unknown].get(&(all & !rows)) else {
                continue;
            };
            let product = field.mul(minor, rest)?;
            let swaps: u32 = (0..n)
                .filter(|row| rows >> row & 1 == 1)
                .map(|row| (!rows & ((1 << row) - 1)).count_ones())
                .sum();
            total = signed_sum(field, &total, &product, swaps)?;
        }
        let odd = (n - 1 - unknown) % 2 == 1;
        let moved = field.integer(if odd { -1 } else { 1 });
        values.push(field.div(&field.mul(&total, &moved)?, &determinant)?);
    }
    Ok(Some((values, determinant)))
}

/// The determinant of a square matrix of at most 31 rows.
pub fn determinant(field: &Field, rows: &[Vec<Element>]) -> Result<Element, Stop> {
    let n = rows.len();
    let mut minors = Minors::from([(0, field.integer(1))]);
    for column in 0..n {
        let above = |chosen: u32, row: usize| chosen >> row;
        minors = extended(field, &minors, n, |row| rows[row].get(column), above)?;
    }
    let all = (1u32 << n) - 1;
    Ok(minors.remove(&all).unwrap_or_else(Element::zero))
}

/// Minors with one column more. `passed` picks the rows over which an entry is moved to its place.
fn extended<'a>(
    field: &Field,
    minors: &Minors,
    n: usize,
    entry: impl Fn(usize) -> Option<&'a Element>,
    passed: impl Fn(u32, usize) -> u32,
) -> Result<Minors, Stop> {
    let mut out = Minors::new();
    for (rows, minor) in minors {
        for row in (0..n).filter(|row| rows >> row & 1 == 0) {
            let Some(value) = entry(row).filter(|v| !field.is_zero(v)) else {
                continue;
            };
            let product = field.mul(minor, value)?;
            let slot = out.entry(rows | 1 << row).or_insert_with(Element::zero);
            *slot = signed_sum(field, slot, &product, passed(*rows, row).count_ones())?;
        }
    }
    out.retain(|_, minor| !field.is_zero(minor));
    Ok(out)
}

/// a + b, or a − b after an odd number of swaps.
fn signed_sum(field: &Field, a: &Element, b: &Element, swaps: u32) -> Result<Element, Stop> {
    match swaps.is_multiple_of(2) {
        true => field.add(a, b),
        false => field.sub(a, b),
    }
}
