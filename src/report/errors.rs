//! Errors in units in the last place of the exact answer, one and many.

use num_traits::{Signed, Zero};
use serde::Serialize;

use crate::expr::Rational;
use crate::expr::number::{from_f64, to_f64};

/// Errors of one quantity by one route, in units in the last place.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Errors {
    /// Numbers compared.
    pub count: usize,
    /// Largest.
    pub max: f64,
    /// 99 % are no larger.
    pub p99: f64,
    /// Half are no larger.
    pub median: f64,
    /// How many lie at or below each of [`BINS`], and above the last.
    pub histogram: Vec<usize>,
}

/// Upper ends of the histogram's classes, in units in the last place.
pub const BINS: [f64; 10] = [0.5, 1.0, 2.0, 4.0, 16.0, 256.0, 1e4, 1e8, 1e12, 1e16];

impl Errors {
    /// Of all of them, in any order.
    pub(super) fn of(mut all: Vec<f64>) -> Errors {
        all.sort_by(f64::total_cmp);
        let at = |share: f64| {
            all.get(((all.len() as f64 * share).ceil() as usize).clamp(1, all.len().max(1)) - 1)
                .copied()
                .unwrap_or(0.0)
        };
        let mut histogram = vec![0; BINS.len() + 1];
        for error in &all {
            histogram[BINS.iter().position(|b| error <= b).unwrap_or(BINS.len())] += 1;
        }
        Errors {
            count: all.len(),
            max: at(1.0),
            p99: at(0.99),
            median: at(0.5),
            histogram,
        }
    }
}

/// Error in units in the last place of the exact answer; `None` where that is zero or no normal double.
pub fn ulps(value: f64, exact: &Rational) -> Option<f64> {
    let near = to_f64(exact);
    if exact.is_zero() || !(1e-300..1e300).contains(&near.abs()) {
        return None;
    }
    let Some(value) = from_f64(value) else {
        return Some(f64::INFINITY);
    };
    let mut power = near.abs().log2().floor() as i32;
    // The logarithm may be off at powers of two.
    if 2f64.powi(power) > near.abs() {
        power -= 1;
    }
    if 2f64.powi(power + 1) <= near.abs() {
        power += 1;
    }
    let unit = from_f64(2f64.powi(power - 52))?;
    Some(to_f64(&((value - exact).abs() / unit)))
}

/// Decimal digits lost of about 16.
pub fn digits_lost(ulps: f64) -> f64 {
    ulps.max(1.0).log10().min(16.0)
}
