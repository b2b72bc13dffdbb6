//! Points per second of a compiled formula, beside the function somebody wrote by hand, in the same run.

use std::time::Instant;

use rayon::prelude::*;
use serde::Serialize;

use super::{Program, SHARE};

/// Time of one way to evaluate a formula at many points.
#[derive(Clone, Debug, Serialize)]
pub struct Throughput {
    /// Which way.
    pub route: Route,
    /// Threads used.
    pub threads: usize,
    /// Points per run.
    pub points: usize,
    /// Lower quartile, median and upper quartile of the time of one run \[s\].
    pub seconds: [f64; 3],
    /// Points per second at the median.
    pub per_second: f64,
}

/// Ways to evaluate a formula at many points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Route {
    /// The compiled program, one point at a time.
    Program,
    /// The compiled program in blocks.
    Blocks,
    /// The Rust function somebody wrote by hand.
    HandWritten,
}

/// Times the compiled program, one point at a time and in blocks, against the hand-written function `by_hand` of the same
/// formula, in this run, with each number of threads in `threads`; `runs` runs each (at least one).
pub fn throughput(
    program: &Program,
    by_hand: impl Fn(&[f64]) -> f64 + Sync,
    columns: &[&[f64]],
    threads: &[usize],
    runs: usize,
) -> Result<Vec<Throughput>, rayon::ThreadPoolBuildError> {
    let points = columns.iter().map(|c| c.len()).min().unwrap_or(0);
    let mut out = vec![0.0; points];
    let mut rows = Vec::new();
    for &count in threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build()?;
        let mut row = |route: Route, work: &mut (dyn FnMut(&mut [f64]) + Send)| {
            let seconds = quartiles(runs, || pool.install(|| work(&mut out)));
            rows.push(Throughput {
                route,
                threads: count,
                points,
                seconds,
                per_second: points as f64 / seconds[1],
            });
        };
        row(Route::HandWritten, &mut |out| {
            by_point(columns, out, 0, |_, x| by_hand(x))
        });
        row(Route::Program, &mut |out| {
            by_point(columns, out, program.slots(), |s, x| program.eval(x, s))
        });
        row(Route::Blocks, &mut |out| {
            program.eval_all_parallel(columns, out)
        });
    }
    Ok(rows)
}

/// The compiled program in blocks on one thread and on two, at one number of points.
#[derive(Clone, Debug, Serialize)]
pub struct Doubling {
    /// Points per run.
    pub points: usize,
    /// Median time of one run on one thread and on two \[s\].
    pub seconds: [f64; 2],
}

/// What a second thread brings at each number of points; the two take turns, so that what else the machine does meets
/// both.
pub fn doublings(
    program: &Program,
    columns: &[&[f64]],
    sizes: &[usize],
    runs: usize,
) -> Result<Vec<Doubling>, rayon::ThreadPoolBuildError> {
    let pool = |count| rayon::ThreadPoolBuilder::new().num_threads(count).build();
    let pools = [pool(1)?, pool(2)?];
    let most = columns.iter().map(|c| c.len()).min().unwrap_or(0);
    let mut out = vec![0.0; most];
    let mut rows = Vec::new();
    for &points in sizes.iter().filter(|n| **n <= most) {
        let part: Vec<&[f64]> = columns.iter().map(|c| &c[..points]).collect();
        let mut times = [Vec::new(), Vec::new()];
        for run in 0..=runs {
            for (pool, times) in pools.iter().zip(&mut times) {
                let start = Instant::now();
                pool.install(|| program.eval_all_parallel(&part, &mut out[..points]));
                // The first run of each does not count.
                if run > 0 {
                    times.push(start.elapsed().as_secs_f64());
                }
            }
        }
        let seconds = times.map(|mut all| {
            all.sort_by(f64::total_cmp);
            all[all.len() / 2]
        });
        rows.push(Doubling { points, seconds });
    }
    Ok(rows)
}

/// Evaluates point by point on the current pool; `value` gets scratch space of the asked length.
fn by_point(
    columns: &[&[f64]],
    out: &mut [f64],
    scratch: usize,
    value: impl Fn(&mut [f64], &[f64]) -> f64 + Sync,
) {
    out.par_chunks_mut(SHARE).enumerate().for_each_init(
        || (vec![0.0; scratch], vec![0.0; columns.len()]),
        |(scratch, point), (k, chunk)| {
            for (i, out) in chunk.iter_mut().enumerate() {
                for (x, column) in point.iter_mut().zip(columns) {
                    *x = column[k * SHARE + i];
                }
                *out = value(scratch, point);
            }
        },
    );
}

/// Quartiles of the time of `work` \[s\] over `runs` runs, after one that does not count.
pub(crate) fn quartiles(runs: usize, mut work: impl FnMut()) -> [f64; 3] {
    work();
    let mut times: Vec<f64> = (0..runs.max(1))
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    [1, 2, 3].map(|q| times[(times.len() - 1) * q / 4])
}
