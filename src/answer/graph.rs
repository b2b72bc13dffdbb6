//! Curves that a scene asks for: a quantity against a parameter, or against a name that stands for a formula, in closed form.
//!
//! In: a scene and its answers. Out: for every curve a formula of the one variable, with its zeros found exactly. Sampling and
//! drawing are the affair of others.

use std::collections::BTreeMap;

use super::calc::{solve, tidy};
use super::formulas::{dimension_of, put};
use super::{Answer, Refused};
use crate::dimension::Dimension;
use crate::domain::{Domain, Limit};
use crate::expr::{Expr, Point, Symbol};
use crate::scene::{PlotAsk, Scene};

/// A plot with everything it needs.
#[derive(Clone, Debug)]
pub struct Graph {
    /// What is asked.
    pub ask: PlotAsk,
    /// Dimension of the variable.
    pub x: Dimension,
    /// Dimension of the quantity.
    pub y: Dimension,
    /// Smallest and largest value of the variable, in SI units.
    pub range: [f64; 2],
    /// The curves.
    pub curves: Vec<Curve>,
}

/// A curve.
#[derive(Clone, Debug)]
pub struct Curve {
    /// What tells it from the others.
    pub with: Vec<(Symbol, Expr)>,
    /// The quantity in the variable alone.
    pub formula: Expr,
    /// Values of the variable at which the quantity is zero, exact, with their approximate value.
    pub zeros: Vec<(Expr, f64)>,
}

/// The plots of a scene; `known` holds its answers in parameters, `later` what was asked about them.
pub fn graphs(
    scene: &Scene,
    known: &BTreeMap<Symbol, Expr>,
    later: &[Answer],
) -> Result<Vec<Graph>, Refused> {
    let mut known = known.clone();
    super::formulas::remember(scene, later, &mut known);
    scene
        .plots
        .iter()
        .map(|ask| one(scene, ask, &known))
        .collect()
}

fn one(scene: &Scene, ask: &PlotAsk, known: &BTreeMap<Symbol, Expr>) -> Result<Graph, Refused> {
    let refused =
        |reason: String, hint: &str| Refused::at(format!("plot `{}`", ask.name), reason, hint);
    let values: BTreeMap<Symbol, Expr> = scene
        .parameters
        .iter()
        .filter(|p| p.name != ask.against)
        .filter_map(|p| Some((p.name.clone(), p.value.clone()?)))
        .collect();
    let number = |e: &Expr| {
        let e = put(scene, &ask.name, known, e, &[])?.substitute(&values);
        let value = e.evaluate(&Point::<f64>::default());
        value.filter(|v| v.is_finite()).ok_or_else(|| {
            refused(
                String::from("an end of the axis has no value"),
                "give numbers, or values to the parameters in `from` and `to`",
            )
        })
    };
    let range = [number(&ask.from)?, number(&ask.to)?];
    if range[0] >= range[1] {
        return Err(refused(
            String::from("the axis ends before it begins"),
            "`from` is smaller than `to`",
        ));
    }
    let quantity = put(scene, &ask.name, known, &ask.quantity, &[])?;
    let y = dimension_of(scene, &quantity, &ask.name)?;
    let variable = Expr::symbol(&ask.against);
    let mut domains = scene.domains.clone();
    let (in_variable, x) = match &ask.stands_for {
        None => (quantity, dimension_of(scene, &variable, &ask.name)?),
        Some((formula, varying)) => {
            let formula = put(scene, &ask.name, known, formula, &[])?;
            let x = dimension_of(scene, &formula, &ask.name)?;
            let domain = if range[0] < 0.0 {
                Domain::real()
            } else {
                Domain::positive()
            };
            domains.symbols.insert(ask.against.clone(), domain);
            let solved = solve(&(&formula - &variable), varying, &domains);
            let value = match solved.as_ref().map(|r| r.inside.as_slice()) {
                Ok([only]) => only.value.clone(),
                _ => {
                    return Err(refused(
                        format!("{varying} is not given by {} alone", ask.against),
                        "the formula that the name stands for is solved for the parameter that varies",
                    ));
                }
            };
            let at = BTreeMap::from([(varying.clone(), value)]);
            let replaced = tidy(&quantity.substitute(&at), &domains);
            let replaced = replaced.map_err(|stop| refused(stop.to_string(), ""))?;
            (replaced, x)
        }
    };
    // Zeros are sought where they are drawn, ends included.
    let end = |v: f64| Some(Limit::number(crate::expr::number::from_f64(v)?, false));
    let shown = Domain {
        low: end(range[0]),
        high: end(range[1]),
    };
    let mut curves = Vec::new();
    for with in &ask.curves {
        let put_in: BTreeMap<Symbol, Expr> = with
            .iter()
            .map(|(s, v)| Ok((s.clone(), put(scene, &ask.name, known, v, &[])?)))
            .collect::<Result<_, Refused>>()?;
        let formula = tidy(&in_variable.substitute(&put_in), &domains);
        let formula = formula.map_err(|stop| refused(stop.to_string(), ""))?;
        let in_numbers = formula.substitute(&values);
        let open = in_numbers.symbols().into_iter();
        let open: Vec<Symbol> = open
            .filter(|s| *s != ask.against && s.as_ref() != "pi")
            .collect();
        if let Some(open) = open.first() {
            return Err(refused(
                format!("{open} has no value"),
                "give it a value, or say in `curves` what stands for it",
            ));
        }
        let mut inside = domains.clone();
        inside.symbols.insert(ask.against.clone(), shown.clone());
        let roots = solve(&formula, &ask.against, &inside).map_or(Vec::new(), |r| r.inside);
        let zeros = roots.into_iter().filter(|r| r.proved).filter_map(|r| {
            let at = r.value.substitute(&values);
            let at = at.evaluate(&Point::<f64>::default())?;
            (range[0] <= at && at <= range[1]).then_some((r.value, at))
        });
        curves.push(Curve {
            with: with.clone(),
            formula: in_numbers,
            zeros: zeros.collect(),
        });
    }
    Ok(Graph {
        ask: ask.clone(),
        x,
        y,
        range,
        curves,
    })
}
