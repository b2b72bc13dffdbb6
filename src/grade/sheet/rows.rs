//! The matrix of a scene's equations with its rows as an answer has them: an equation is the same in any place, and times
//! anything that is not zero.

use crate::algebra::{quotient, sign, tidy};
use crate::domain::Domains;
use crate::expr::Expr;

/// The expected rows in the order and with the factors of the answer's; those that no row of the answer is a multiple of fill
/// its other places. Nothing where the sizes differ.
pub(super) fn as_answered(
    expected: &[Vec<Expr>],
    answer: &[Vec<Expr>],
    domains: &Domains,
) -> Option<Vec<Vec<Expr>>> {
    if [expected.len(), expected[0].len()] != [answer.len(), answer[0].len()] {
        return None;
    }
    let mut left: Vec<&Vec<Expr>> = expected.iter().collect();
    let mut place = |row: &Vec<Expr>| {
        let found = |(at, of): (usize, &&Vec<Expr>)| Some((at, multiple(of, row, domains)?));
        let (at, scaled) = left.iter().enumerate().find_map(found)?;
        left.remove(at);
        Some(scaled)
    };
    let found: Vec<Option<Vec<Expr>>> = answer.iter().map(&mut place).collect();
    let mut rest = left.into_iter().cloned();
    found
        .into_iter()
        .map(|row| row.or_else(|| rest.next()))
        .collect()
}

/// The multiple of a row that another row is, where the factor is never zero.
fn multiple(row: &[Expr], other: &[Expr], domains: &Domains) -> Option<Vec<Expr>> {
    let (first, itself) = row.iter().zip(other).find(|(entry, _)| !entry.is_zero())?;
    let factor = quotient(itself, first, domains).ok()?;
    sign(&factor, domains).filter(|sign| sign.is_strict())?;
    let scaled: Vec<Expr> = row.iter().map(|entry| entry * &factor).collect();
    let same = |(a, b): (&Expr, &Expr)| tidy(&(a - b), domains).is_ok_and(|gap| gap.is_zero());
    scaled.iter().zip(other).all(same).then_some(scaled)
}
