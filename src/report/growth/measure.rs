//! Time and error of the ways to solve a chain, against the recursion in double-double.

use serde::Serialize;

use super::{Chain, Swing, recursion, sparse};
use crate::numeric::Number;
use crate::numeric::dd::Dd;
use crate::report::batch::quartiles;

/// Ways to solve a chain.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum ChainRoute {
    /// Joint complement, sparse Cholesky, doubles.
    Sparse,
    /// Recursion from the free end, doubles.
    Recursion,
}

/// Cost and error of one chain by one route.
#[derive(Clone, Debug, Serialize)]
pub struct Growth {
    /// Number of rods.
    pub rods: usize,
    /// Number of unknowns of the full system: three velocities per rod, two reactions per hinge.
    pub unknowns: usize,
    /// How it was solved.
    pub route: ChainRoute,
    /// Lower quartile, median and upper quartile of the time \[s\], assembly included.
    pub seconds: [f64; 3],
    /// Largest error of a velocity or spin over the largest of them (rods have length 1).
    pub error: f64,
    /// The same rod by rod, where the rod's motion is above 1e−290; the largest.
    pub relative_error: f64,
    /// Relative error along the chain: (number of the rod, error), about thirty rods per row.
    pub along: Vec<(usize, f64)>,
}

/// Measures a chain by both routes against the recursion in double-double, over `runs` timed runs.
pub fn measure(chain: &Chain<f64>, runs: usize) -> Vec<Growth> {
    let Some(reference) = recursion(&chain.to(Dd::exact)) else {
        return Vec::new();
    };
    [ChainRoute::Sparse, ChainRoute::Recursion]
        .into_iter()
        .filter_map(|route| {
            let solve = || match route {
                ChainRoute::Sparse => sparse(chain).ok(),
                ChainRoute::Recursion => recursion(chain),
            };
            let swing = solve()?;
            let seconds = quartiles(runs, || {
                std::hint::black_box(solve());
            });
            Some(row(route, &swing, &reference, seconds))
        })
        .collect()
}

fn row(route: ChainRoute, swing: &Swing<f64>, reference: &Swing<Dd>, seconds: [f64; 3]) -> Growth {
    let rods = swing.spin.len();
    // Per rod: largest error of its three velocities, and the largest of them.
    let pairs: Vec<[f64; 2]> = (0..rods)
        .map(|i| {
            let values = [swing.velocity[i][0], swing.velocity[i][1], swing.spin[i]];
            let exact = [
                reference.velocity[i][0],
                reference.velocity[i][1],
                reference.spin[i],
            ];
            let mut worst = [0.0; 2];
            for (value, exact) in values.iter().zip(&exact) {
                worst[0] = f64::max(worst[0], Dd::exact(*value).minus(exact).high.abs());
                worst[1] = f64::max(worst[1], exact.high.abs());
            }
            worst
        })
        .collect();
    let largest = |k: usize| pairs.iter().map(|p| p[k]).fold(0.0, f64::max);
    // Below, the tail of a straight chain struck across underflows: 0.27ⁿ.
    let relative: Vec<(usize, f64)> = pairs
        .iter()
        .enumerate()
        .filter(|(_, p)| p[1] > 1e-290)
        .map(|(i, p)| (i + 1, p[0] / p[1]))
        .collect();
    let every = relative.len().div_ceil(30).max(1);
    Growth {
        rods,
        unknowns: (5 * rods).saturating_sub(2),
        route,
        seconds,
        error: largest(0) / largest(1),
        relative_error: relative.iter().map(|(_, e)| *e).fold(0.0, f64::max),
        along: relative.into_iter().step_by(every).collect(),
    }
}
