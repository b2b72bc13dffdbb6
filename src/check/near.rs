//! Claims that one formula stands for another close to a value of a parameter, or far out: tried in doubles.
//!
//! In: a claim of the file. Out: whether what is left out shrinks as fast as the claim says. No derivative is taken.

use serde_json::Value;

use super::{POINTS, Report, Unusable, read as formula, unusable, written};
use crate::expr::{Expr, Symbol};
use crate::formula::Symbols;
use crate::interval::rounding;
use crate::numeric;
use crate::scene::Scene;

/// Highest order of a claim.
const HIGHEST: u32 = 12;

/// A claim that two formulas come together as a parameter comes to a value.
pub(super) struct Near {
    step: String,
    text: String,
    left: Expr,
    right: Expr,
    parameter: Symbol,
    /// `None` beyond all bounds.
    to: Option<Expr>,
    order: u32,
    /// What the step defines, which must be the right side.
    defined: Option<Expr>,
}

/// Reads a claim; `defining` is its step where that defines a name, which must be the right side.
pub(super) fn read(
    claim: &Value,
    defining: Option<&Value>,
    symbols: &Symbols,
    id: &str,
) -> Result<Near, Unusable> {
    let of = format!("step {id}");
    let side = |name: &str| formula(&claim[name], symbols, &of);
    let order = claim["order"].as_u64().and_then(|n| u32::try_from(n).ok());
    let Some(order) = order.filter(|n| *n <= HIGHEST) else {
        return unusable(format!("step {id}: the order is no number up to {HIGHEST}"));
    };
    let defined = defining.map(|step| formula(&step["after"][0]["right"], symbols, &of));
    Ok(Near {
        step: id.to_string(),
        text: written(claim, "≈"),
        left: side("left")?,
        right: side("right")?,
        parameter: Symbol::from(claim["parameter"].as_str().unwrap_or_default()),
        to: match claim["to"].as_str() {
            Some("infinity") => None,
            _ => Some(side("to")?),
        },
        order,
        defined: defined.transpose()?,
    })
}

/// Tries a claim in doubles: closer by, the difference divided by the distance to the power claimed must be smaller by far. A
/// limit may be approached as slowly as a root, so that it is tried much closer.
pub(super) fn replay(scene: &Scene, near: &Near, report: &mut Report) {
    let mut needed = numeric::needed(scene);
    for e in [&near.left, &near.right].into_iter().chain(&near.to) {
        needed.add(e);
    }
    if near.defined.as_ref().is_some_and(|d| *d != near.right) {
        let why = "the step defines something else than what stands close by";
        return report.fail(&near.step, &near.text, why.to_string());
    }
    let mut tried = 0;
    for seed in 1..=POINTS {
        let mut point = numeric::rounded(&numeric::random_point(&needed, &scene.domains, seed));
        point.directions.remove(&near.parameter);
        let to = near.to.as_ref().map(|to| to.evaluate(&point));
        if to == Some(None) {
            continue;
        }
        let to = to.flatten();
        let mut apart = |h: f64| {
            let x = to.map_or(1.0 / (h * h), |to| to + h);
            point.values.insert(near.parameter.clone(), x);
            let left = near.left.evaluate(&point)?;
            let right = near.right.evaluate(&point)?;
            let both = left.is_finite() && right.is_finite();
            let rounding = [&near.left, &near.right].map(|e| rounding(e, &point));
            let size = left.abs().max(right.abs());
            both.then(|| ((left - right).abs(), size, rounding[0] + rounding[1]))
        };
        let closer = if near.order == 0 { 1024.0 } else { 8.0 };
        let found = [1.0, -1.0].into_iter().find_map(|way| {
            let (far, scale, _) = apart(way / 128.0)?;
            let (close, _, rounding) = apart(way / 128.0 / closer)?;
            Some((far, close, scale, rounding))
        });
        let Some((far, close, scale, rounding)) = found else {
            continue;
        };
        let least = 4.0 * 8f64.powi(near.order as i32);
        let shrinks = close <= 1e-13 * scale || close * least <= far;
        // What rounding may have left tells nothing.
        if !shrinks && close <= rounding {
            continue;
        }
        tried += 1;
        if !shrinks {
            let why = format!(
                "{closer} times closer the sides differ by {close:e} in place of {far:e}: too much for order {}",
                near.order
            );
            return report.fail(&near.step, &near.text, why);
        }
    }
    if tried == 0 {
        report.open.push(near.step.clone());
    } else {
        report.held += 1;
        report.in_doubles += 1;
    }
}
