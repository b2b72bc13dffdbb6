//! Curves that a scene asks for: a quantity against a parameter, or against a name that stands for a formula, in closed form.
//!
//! In: a scene and its answers. Out: for every curve a formula of the one variable, with its zeros found exactly. Sampling and
//! drawing are the affair of others.

use std::collections::BTreeMap;

use super::calc::tidy;
use super::dimension_of;
use super::formulas::put;
use super::solve::solve;
use super::{Answer, Refused};
use crate::dimension::Dimension;
use crate::domain::{Domain, Domains, Limit};
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
    let known = &known;
    let each = scene.plots.iter().map(|ask| {
        let mut values = scene.values();
        values.remove(&ask.against);
        let work = Work {
            scene,
            ask,
            known,
            values,
        };
        work.graph()
    });
    each.collect()
}

/// A plot in the making.
struct Work<'a> {
    scene: &'a Scene,
    ask: &'a PlotAsk,
    known: &'a BTreeMap<Symbol, Expr>,
    /// Values of the parameters that do not vary.
    values: BTreeMap<Symbol, Expr>,
}

impl Work<'_> {
    fn refused(&self, reason: impl Into<String>, hint: &str) -> Refused {
        Refused::at(format!("plot `{}`", self.ask.name), reason.into(), hint)
    }

    fn put(&self, e: &Expr) -> Result<Expr, Refused> {
        put(self.scene, &self.ask.name, self.known, e, &[])
    }

    fn dimension(&self, e: &Expr) -> Result<Dimension, Refused> {
        dimension_of(self.scene, e, &self.ask.name)
    }

    fn tidy(&self, e: &Expr, domains: &Domains) -> Result<Expr, Refused> {
        tidy(e, domains).map_err(|stop| self.refused(stop.to_string(), ""))
    }

    /// An end of the axis.
    fn end(&self, e: &Expr) -> Result<f64, Refused> {
        let e = self.put(e)?.substitute(&self.values);
        let value = e.evaluate(&Point::<f64>::default());
        let hint = "give numbers, or values to the parameters in `from` and `to`";
        let value = value.filter(|v| v.is_finite());
        value.ok_or_else(|| self.refused("an end of the axis has no value", hint))
    }

    fn graph(&self) -> Result<Graph, Refused> {
        let ask = self.ask;
        let range = [self.end(&ask.from)?, self.end(&ask.to)?];
        if range[0] >= range[1] {
            let hint = "`from` is smaller than `to`";
            return Err(self.refused("the axis ends before it begins", hint));
        }
        let quantity = self.put(&ask.quantity)?;
        let y = self.dimension(&quantity)?;
        let mut domains = self.scene.domains.clone();
        let (in_variable, x) = match &ask.stands_for {
            None => (quantity, self.dimension(&Expr::symbol(&ask.against))?),
            Some((formula, varying)) => {
                let formula = self.put(formula)?;
                let domain = match range[0] < 0.0 {
                    true => Domain::real(),
                    false => Domain::positive(),
                };
                domains.symbols.insert(ask.against.clone(), domain);
                let value = self.varying(&formula, varying, &domains)?;
                let at = BTreeMap::from([(varying.clone(), value)]);
                let replaced = self.tidy(&quantity.substitute(&at), &domains)?;
                (replaced, self.dimension(&formula)?)
            }
        };
        let curves = ask.curves.iter();
        let curves = curves.map(|with| self.curve(with, &in_variable, &domains, range));
        Ok(Graph {
            ask: ask.clone(),
            x,
            y,
            range,
            curves: curves.collect::<Result<_, Refused>>()?,
        })
    }

    /// The parameter that varies, from the name that stands for a formula.
    fn varying(&self, of: &Expr, varying: &Symbol, domains: &Domains) -> Result<Expr, Refused> {
        let against = &self.ask.against;
        let solved = solve(&(of - &Expr::symbol(against)), varying, domains);
        if let Ok([only]) = solved.as_ref().map(|r| r.inside.as_slice()) {
            return Ok(only.value.clone());
        }
        let why = format!("{varying} is not given by {against} alone");
        let hint = "the formula that the name stands for is solved for the parameter that varies";
        Err(self.refused(why, hint))
    }

    fn curve(
        &self,
        with: &[(Symbol, Expr)],
        quantity: &Expr,
        domains: &Domains,
        range: [f64; 2],
    ) -> Result<Curve, Refused> {
        let (against, values) = (&self.ask.against, &self.values);
        let put_in = with.iter().map(|(s, v)| Ok((s.clone(), self.put(v)?)));
        let put_in = put_in.collect::<Result<BTreeMap<_, _>, Refused>>()?;
        let formula = self.tidy(&quantity.substitute(&put_in), domains)?;
        let in_numbers = formula.substitute(values);
        let mut open = in_numbers.symbols().into_iter();
        if let Some(open) = open.find(|s| s != against && s.as_ref() != "pi") {
            let hint = "give it a value, or say in `curves` what stands for it";
            return Err(self.refused(format!("{open} has no value"), hint));
        }
        // Zeros are sought where they are drawn, ends included.
        let end = |v: f64| Some(Limit::number(crate::expr::number::from_f64(v)?, false));
        let shown = Domain {
            low: end(range[0]),
            high: end(range[1]),
        };
        let mut inside = domains.clone();
        inside.symbols.insert(against.clone(), shown);
        let roots = solve(&formula, against, &inside).map_or(Vec::new(), |r| r.inside);
        let zeros = roots.into_iter().filter(|r| r.proved).filter_map(|r| {
            let at = r.value.substitute(values);
            let at = at.evaluate(&Point::<f64>::default())?;
            (range[0] <= at && at <= range[1]).then_some((r.value, at))
        });
        Ok(Curve {
            with: with.to_vec(),
            formula: in_numbers,
            zeros: zeros.collect(),
        })
    }
}
