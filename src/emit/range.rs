//! Within what sizes of its arguments a program neither over- nor underflows, and whether what it divides by can cancel.
//!
//! Sizes are followed as powers of ten, from the smallest a value can have, zero aside, to the largest. Sums count as
//! their smallest term at least: what cancels is told to the reader apart.

use super::program::{Op, Program};

/// What is known of an input: whether it is an argument, and its sign.
#[derive(Clone, Copy, Debug)]
pub struct Input {
    /// An argument, rather than a cosine or sine.
    pub is_argument: bool,
    /// At least zero (`Some(true)`), at most zero, or neither known.
    pub sign: Option<bool>,
}

/// The largest k such that nothing over- or underflows while every argument is zero or within 10^−k … 10^k; what a cosine
/// or sine of a double leaves is above 1e−20.
pub fn reach(program: &Program, inputs: &[Input]) -> i32 {
    let mut sizes = (0..=300).rev();
    let largest = sizes.find(|k| fits(program, inputs, f64::from(*k)));
    largest.unwrap_or(0)
}

/// Doubles, with what their products leave below them: 2⁻⁵³ and 2⁻¹⁰⁶ of the value.
const LARGEST: f64 = 290.0;
const SMALLEST: f64 = -290.0;
const PLAIN_SMALLEST: f64 = -307.0;

fn fits(program: &Program, inputs: &[Input], k: f64) -> bool {
    let mut sizes: Vec<[f64; 2]> = Vec::with_capacity(program.steps.len());
    let number = |v: f64| {
        let size = if v == 0.0 { 0.0 } else { v.abs().log10() };
        [size, size]
    };
    let input = |i: usize| match inputs[i].is_argument {
        true => [-k, k],
        false => [-20.0, 0.0],
    };
    for step in &program.steps {
        let of = |a: usize| sizes[a];
        let sum = |a: usize, b: usize| [of(a)[0].min(of(b)[0]), of(a)[1].max(of(b)[1]) + 0.31];
        let times = |a: [f64; 2], b: [f64; 2]| [a[0] + b[0], a[1] + b[1]];
        let per = |a: [f64; 2], b: [f64; 2]| [a[0] - b[1], a[1] - b[0]];
        let size = match step.op {
            Op::Number(v) => number(v.high),
            Op::Input(i) => input(i),
            Op::Add(a, b) | Op::Subtract(a, b) => sum(a, b),
            Op::Multiply(a, b) => times(of(a), of(b)),
            // A wide reciprocal is formed first.
            Op::Divide(a, b) if step.wide => {
                let inverse = per([0.0, 0.0], of(b));
                if inverse[0] < SMALLEST || inverse[1] > LARGEST {
                    return false;
                }
                times(of(a), inverse)
            }
            Op::Divide(a, b) => per(of(a), of(b)),
            Op::Negate(a) | Op::Round(a) | Op::Widen(a) | Op::Call(_, a) => of(a),
            Op::Root(a) => of(a).map(|v| 0.5 * v),
            Op::Power(..) => return false,
        };
        let smallest = if step.wide { SMALLEST } else { PLAIN_SMALLEST };
        if size[0] < smallest || size[1] > LARGEST {
            return false;
        }
        sizes.push(size);
    }
    true
}

/// Whether every divisor has one sign, whatever the arguments: a sum of terms that cannot cancel.
pub fn divides_safely(program: &Program, inputs: &[Input]) -> bool {
    let signs = signs(program, inputs);
    program.steps.iter().all(|step| match step.op {
        Op::Divide(_, b) => signs[b].is_some(),
        _ => true,
    })
}

/// The sign of every step, as far as those of the inputs tell.
fn signs(program: &Program, inputs: &[Input]) -> Vec<Option<bool>> {
    let mut signs: Vec<Option<bool>> = Vec::with_capacity(program.steps.len());
    for step in &program.steps {
        let both = |a: usize, b: usize| signs[a].zip(signs[b]);
        signs.push(match step.op {
            Op::Number(v) => Some(v.high >= 0.0),
            Op::Input(i) => inputs[i].sign,
            Op::Add(a, b) => both(a, b).and_then(|(a, b)| (a == b).then_some(a)),
            Op::Subtract(a, b) => both(a, b).and_then(|(a, b)| (a != b).then_some(a)),
            Op::Multiply(a, b) if a == b => Some(true),
            Op::Multiply(a, b) | Op::Divide(a, b) => both(a, b).map(|(a, b)| a == b),
            Op::Negate(a) => signs[a].map(|s| !s),
            Op::Round(a) | Op::Widen(a) => signs[a],
            Op::Root(_) => Some(true),
            Op::Power(..) | Op::Call(..) => None,
        });
    }
    signs
}
