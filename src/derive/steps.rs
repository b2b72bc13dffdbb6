//! Solutions that nobody would want multiplied out: elimination step by step, every long intermediate a definition.
//!
//! Where the closed form of an unknown would run to hundreds of terms, the steps themselves are the short form. Each
//! definition is in parameters and earlier definitions, the unknowns come last, in terms of each other. What is found
//! here is held against the independent solution at exact points; it is not proved as an identity, and says so.

use super::{Definition, Stop, Work};
use crate::algebra::Row;
use crate::expr::{Expr, Point};
use crate::formula::write_plain;
use crate::laws::Unknown;

/// A value found in general position counts as zero below this; the algebra decides whether it really is.
const ZERO: f64 = 1e-11;
/// An intermediate of more characters than this is named.
const NAMED: usize = 24;
/// A coefficient of the equations of more terms than this is named too: those of composite bodies run to pages.
const LONG: usize = 60;

/// An entry of the system: its formula, and its value at a point in general position.
#[derive(Clone, Debug)]
struct Entry {
    e: Expr,
    v: f64,
}

/// Solves the rows for the unknowns, adding the definitions of all steps to `work`. False where the system is singular or
/// has no value in general position.
pub(super) fn solve(work: &mut Work<'_>, rows: &[Row], unknowns: &[Unknown]) -> Result<bool, Stop> {
    let mut point = work.scene.generic_point();
    for definition in &work.definitions {
        let Some(value) = definition.value.evaluate(&point) else {
            return Ok(false);
        };
        point.values.insert(definition.name.clone(), value);
    }
    let n = unknowns.len();
    if rows.len() != n {
        return Ok(false);
    }
    let start = work.definitions.len();
    let mut system: Vec<Vec<Option<Entry>>> = Vec::with_capacity(n);
    for row in rows {
        let mut entries: Vec<Option<Entry>> = vec![None; n + 1];
        for (column, k) in row
            .coeffs
            .iter()
            .map(|(c, k)| (*c, k))
            .chain([(n, &row.rhs)])
        {
            if !work.field.is_zero(k) {
                let e = work.field.expr(k);
                let entry = if k.size() > LONG {
                    named(work, &mut point, e, "coefficient of an equation")?
                } else {
                    entry(e, &point)
                };
                let Some(entry) = entry.filter(|e| e.v.is_finite()) else {
                    work.definitions.truncate(start);
                    return Ok(false);
                };
                entries[column] = Some(entry);
            }
        }
        system.push(entries);
    }
    let mut open: Vec<usize> = (0..n).collect();
    let mut order: Vec<(usize, usize)> = Vec::new();
    while let Some((row, column)) = pivot(&system, &open, n) {
        open.retain(|r| *r != row);
        order.push((row, column));
        for &other in &open {
            if !eliminate(work, &mut system, &mut point, (row, column), other)? {
                work.definitions.truncate(start);
                return Ok(false);
            }
        }
    }
    if order.len() < n {
        work.definitions.truncate(start);
        return Ok(false);
    }
    for (row, column) in order.into_iter().rev() {
        back(work, &system[row], column, unknowns)?;
    }
    Ok(true)
}

fn entry(e: Expr, point: &Point<f64>) -> Option<Entry> {
    let v = e.evaluate(point)?;
    Some(Entry { e, v })
}

/// The pivot that fills in least, then the one with the shortest formula.
fn pivot(system: &[Vec<Option<Entry>>], open: &[usize], n: usize) -> Option<(usize, usize)> {
    let in_row = |r: usize| system[r][..n].iter().flatten().count();
    let in_column = |c: usize| open.iter().filter(|&&r| system[r][c].is_some()).count();
    let mut best = None;
    for &r in open {
        for (c, entry) in system[r][..n].iter().enumerate() {
            if let Some(entry) = entry.as_ref().filter(|e| e.v.abs() > ZERO) {
                let cost = ((in_row(r) - 1) * (in_column(c) - 1), entry.e.size(), r, c);
                if best.as_ref().is_none_or(|(b, _)| cost < *b) {
                    best = Some((cost, (r, c)));
                }
            }
        }
    }
    best.map(|(_, at)| at)
}

/// Takes the pivot row, times a factor, off another row. False where a value cannot be followed.
fn eliminate(
    work: &mut Work<'_>,
    system: &mut [Vec<Option<Entry>>],
    point: &mut Point<f64>,
    (row, column): (usize, usize),
    other: usize,
) -> Result<bool, Stop> {
    let Some(head) = system[other][column].take() else {
        return Ok(true);
    };
    let Some(pivot) = system[row][column].clone() else {
        return Ok(false);
    };
    let quotient = &head.e / &pivot.e;
    let Some(factor) = named(work, point, quotient, "factor of an elimination")? else {
        return Ok(true);
    };
    for j in 0..system[row].len() {
        if j == column {
            continue;
        }
        if let Some(top) = system[row][j].clone() {
            let product = &factor.e * &top.e;
            let difference = match &system[other][j] {
                Some(old) => &old.e - &product,
                None => -product,
            };
            system[other][j] = named(
                work,
                point,
                difference,
                "coefficient left after an elimination",
            )?;
            if system[other][j].as_ref().is_some_and(|e| !e.v.is_finite()) {
                return Ok(false);
            }
        }
    }
    Ok(true)
}

/// A tidied intermediate, named when it is long; `None` where it is zero.
fn named(
    work: &mut Work<'_>,
    point: &mut Point<f64>,
    e: Expr,
    meaning: &str,
) -> Result<Option<Entry>, Stop> {
    let element = work.field.element(&e)?;
    if work.field.is_zero(&element) {
        return Ok(None);
    }
    let e = work.field.expr(&element);
    let v = e.evaluate(point).unwrap_or(f64::NAN);
    if write_plain(&e).len() <= NAMED {
        return Ok(Some(Entry { e, v }));
    }
    let name = work
        .names
        .fresh(&format!("k{}", work.definitions.len() + 1));
    let symbol = Expr::symbol(&name);
    point.values.insert(name.as_str().into(), v);
    work.definitions.push(Definition {
        name: name.as_str().into(),
        value: e,
        meaning: meaning.to_string(),
    });
    Ok(Some(Entry { e: symbol, v }))
}

/// One unknown from its row, in terms of those found before it.
fn back(
    work: &mut Work<'_>,
    row: &[Option<Entry>],
    column: usize,
    unknowns: &[Unknown],
) -> Result<(), Stop> {
    let n = unknowns.len();
    let mut rest = row[n].as_ref().map_or(Expr::zero(), |e| e.e.clone());
    for (j, entry) in row[..n].iter().enumerate().filter(|(j, _)| *j != column) {
        if let Some(entry) = entry {
            let value = work.values.get(&unknowns[j]).cloned();
            let known = value.map_or(Expr::zero(), |v| work.field.expr(&v));
            rest = rest - &entry.e * &known;
        }
    }
    let Some(pivot) = &row[column] else {
        return Ok(());
    };
    let element = work.field.element(&(rest / &pivot.e))?;
    let value = work.field.expr(&element);
    if write_plain(&value).len() <= NAMED {
        work.values.insert(unknowns[column], element);
        return Ok(());
    }
    let unknown = unknowns[column];
    let symbol = Expr::symbol(work.names.plain(unknown));
    let reversed = work.names.is_reversed(unknown);
    let own = if reversed { -&value } else { value };
    if let Some(name) = symbol.as_symbol() {
        let meaning = String::from("as solved in steps");
        work.definitions.push(Definition {
            name: name.clone(),
            value: own,
            meaning,
        });
    }
    let stands_for = work
        .field
        .element(&if reversed { -symbol } else { symbol })?;
    work.values.insert(unknown, stands_for);
    Ok(())
}
