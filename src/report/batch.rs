//! A closed form compiled for many points: expression in, straight-line program out, values by the million.
//!
//! The program does the same roundings in the same order as `Expr::evaluate` over doubles, so the two agree bit for bit;
//! where `evaluate` has no value the program gives NaN. It knows nothing of what the formula means.

mod compile;
mod throughput;

use rayon::prelude::*;

use crate::expr::Function;

pub use compile::{Unbound, compile};
pub(crate) use throughput::quartiles;
pub use throughput::{Doubling, Route, Throughput, doublings, throughput};

/// Points worked on at once: a slot of 64 doubles is 512 bytes, so fifty operations stay in the first-level cache.
const LANES: usize = 64;

/// Points a thread takes at once; large enough that handing out work costs nothing beside it.
const SHARE: usize = 64 * LANES;

/// One operation on earlier slots.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
enum Op {
    Add(u32, u32),
    Sub(u32, u32),
    Mul(u32, u32),
    Neg(u32),
    Recip(u32),
    Sqrt(u32),
    /// 1 where the operand has a value: x⁰.
    One(u32),
    Pow(u32, u32),
    /// A fraction with odd denominator and odd numerator for exponent: real and odd for every base but 0.
    OddRoot(u32, u32),
    /// The same with even numerator: real and even.
    EvenRoot(u32, u32),
    Call(Function, u32),
}

/// A formula as straight-line code. Slots hold constants, then inputs, then one result per operation; every operation
/// reads earlier slots only.
#[derive(Clone, Debug)]
pub struct Program {
    constants: Vec<f64>,
    inputs: usize,
    operations: Vec<Op>,
    result: usize,
}

impl Program {
    /// Length of the scratch space [`Program::eval`] needs.
    pub fn slots(&self) -> usize {
        self.constants.len() + self.inputs + self.operations.len()
    }

    /// Number of operations after sharing.
    pub fn operations(&self) -> usize {
        self.operations.len()
    }

    /// Number of inputs.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// The value at one point, without allocating; NaN where the formula has none. `inputs` are in the order given to
    /// [`compile()`]; `scratch` holds at least [`Program::slots`] numbers, of any value.
    ///
    /// # Panics
    /// If `inputs` or `scratch` is too short.
    pub fn eval(&self, inputs: &[f64], scratch: &mut [f64]) -> f64 {
        let scratch = &mut scratch[..self.slots()];
        let (constants, rest) = scratch.split_at_mut(self.constants.len());
        constants.copy_from_slice(&self.constants);
        rest[..self.inputs].copy_from_slice(&inputs[..self.inputs]);
        let first = self.constants.len() + self.inputs;
        for (k, op) in self.operations.iter().enumerate() {
            let at = |i: u32| scratch[i as usize];
            scratch[first + k] = match *op {
                Op::Add(a, b) => at(a) + at(b),
                Op::Sub(a, b) => at(a) - at(b),
                Op::Mul(a, b) => at(a) * at(b),
                Op::Neg(a) => -at(a),
                Op::Recip(a) => recip(at(a)),
                Op::Sqrt(a) => at(a).sqrt(),
                Op::One(a) => one(at(a)),
                Op::Pow(a, b) => pow(at(a), at(b)),
                Op::OddRoot(a, b) => odd_root(at(a), at(b)),
                Op::EvenRoot(a, b) => pow(at(a).abs(), at(b)),
                Op::Call(f, a) => call(f, at(a)),
            };
        }
        scratch[self.result]
    }

    /// Values at many points on one thread. `columns[i]` holds input i at every point, `out` receives the values.
    ///
    /// # Panics
    /// If a column is missing or shorter than `out`.
    pub fn eval_all(&self, columns: &[&[f64]], out: &mut [f64]) {
        let mut slots = self.prepared();
        self.eval_range(columns, 0, out, &mut slots);
    }

    /// The same on all threads of the current rayon pool. The values do not depend on how many there are.
    ///
    /// # Panics
    /// If a column is missing or shorter than `out`.
    pub fn eval_all_parallel(&self, columns: &[&[f64]], out: &mut [f64]) {
        out.par_chunks_mut(SHARE).enumerate().for_each_init(
            || self.prepared(),
            |slots, (k, chunk)| self.eval_range(columns, k * SHARE, chunk, slots),
        );
    }

    /// Slots for a block of points, the constants in place.
    fn prepared(&self) -> Vec<[f64; LANES]> {
        let mut slots = vec![[0.0; LANES]; self.slots()];
        for (slot, value) in slots.iter_mut().zip(&self.constants) {
            *slot = [*value; LANES];
        }
        slots
    }

    fn eval_range(
        &self,
        columns: &[&[f64]],
        start: usize,
        out: &mut [f64],
        slots: &mut [[f64; LANES]],
    ) {
        let first = self.constants.len() + self.inputs;
        for (block, values) in out.chunks_mut(LANES).enumerate() {
            let from = start + block * LANES;
            for (i, slot) in slots[self.constants.len()..first].iter_mut().enumerate() {
                slot[..values.len()].copy_from_slice(&columns[i][from..from + values.len()]);
            }
            for (k, op) in self.operations.iter().enumerate() {
                let (before, here) = slots.split_at_mut(first + k);
                apply(*op, before, &mut here[0]);
            }
            values.copy_from_slice(&slots[self.result][..values.len()]);
        }
    }
}

/// One operation on a block of points.
fn apply(op: Op, before: &[[f64; LANES]], out: &mut [f64; LANES]) {
    let unary = |a: u32, out: &mut [f64; LANES], f: &dyn Fn(f64) -> f64| {
        for (o, x) in out.iter_mut().zip(&before[a as usize]) {
            *o = f(*x);
        }
    };
    match op {
        Op::Add(a, b) => binary(out, &before[a as usize], &before[b as usize], |x, y| x + y),
        Op::Sub(a, b) => binary(out, &before[a as usize], &before[b as usize], |x, y| x - y),
        Op::Mul(a, b) => binary(out, &before[a as usize], &before[b as usize], |x, y| x * y),
        Op::Pow(a, b) => binary(out, &before[a as usize], &before[b as usize], pow),
        Op::OddRoot(a, b) => binary(out, &before[a as usize], &before[b as usize], odd_root),
        Op::EvenRoot(a, b) => binary(out, &before[a as usize], &before[b as usize], |x, y| {
            pow(x.abs(), y)
        }),
        Op::Neg(a) => binary(out, &before[a as usize], &before[a as usize], |x, _| -x),
        Op::Recip(a) => binary(out, &before[a as usize], &before[a as usize], |x, _| {
            recip(x)
        }),
        Op::Sqrt(a) => binary(out, &before[a as usize], &before[a as usize], |x, _| {
            x.sqrt()
        }),
        Op::One(a) => unary(a, out, &one),
        Op::Call(f, a) => unary(a, out, &|x| call(f, x)),
    }
}

/// A function of its own, so that each operation becomes one vector loop.
#[inline]
fn binary(out: &mut [f64; LANES], a: &[f64; LANES], b: &[f64; LANES], f: impl Fn(f64, f64) -> f64) {
    for i in 0..LANES {
        out[i] = f(a[i], b[i]);
    }
}

fn recip(x: f64) -> f64 {
    // An infinity could come back as an innocent 0 further on.
    if x == 0.0 { f64::NAN } else { 1.0 / x }
}

fn one(x: f64) -> f64 {
    if x.is_nan() { x } else { 1.0 }
}

fn pow(x: f64, y: f64) -> f64 {
    if x > 0.0 && !y.is_nan() {
        x.powf(y)
    } else {
        f64::NAN
    }
}

fn odd_root(x: f64, y: f64) -> f64 {
    if x < 0.0 { -pow(-x, y) } else { pow(x, y) }
}

fn call(function: Function, x: f64) -> f64 {
    let value = match function {
        Function::Sin => x.sin(),
        Function::Cos => x.cos(),
        Function::Tan => x.tan(),
        Function::Asin => x.asin(),
        Function::Acos => x.acos(),
        Function::Atan => x.atan(),
        Function::Sinh => x.sinh(),
        Function::Cosh => x.cosh(),
        Function::Tanh => x.tanh(),
        Function::Exp => x.exp(),
        Function::Ln => x.ln(),
        Function::Abs => x.abs(),
    };
    if value.is_finite() { value } else { f64::NAN }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use proptest::prelude::*;

    use super::*;
    use crate::expr::{Expr, Point, Symbol};

    fn names() -> Vec<Symbol> {
        ["x", "y", "theta"].map(Arc::from).to_vec()
    }

    fn formula() -> impl Strategy<Value = Expr> {
        let leaf = prop_oneof![
            prop::sample::select(vec!["x", "y", "theta", "pi"]).prop_map(Expr::symbol),
            (-9_i64..9, 1_i64..9).prop_map(|(n, d)| Expr::ratio(n, d)),
        ];
        leaf.prop_recursive(6, 60, 4, |inner| {
            prop_oneof![
                prop::collection::vec(inner.clone(), 2..4).prop_map(Expr::sum),
                prop::collection::vec(inner.clone(), 2..4).prop_map(Expr::product),
                (inner.clone(), -7_i64..7, 1_i64..4)
                    .prop_map(|(e, n, d)| e.power(Expr::ratio(n, d))),
                (inner.clone(), inner.clone()).prop_map(|(e, k)| e.power(k)),
                (inner, prop::sample::select(Function::ALL.to_vec()))
                    .prop_map(|(e, f)| Expr::call(f, e)),
            ]
        })
    }

    fn same(a: f64, b: f64) -> bool {
        a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
    }

    proptest! {
        #[test]
        fn the_program_agrees_with_the_expression_bit_for_bit(
            e in formula(),
            points in prop::collection::vec((-3.0..3.0, 0.0..2.0, prop_oneof![Just(0.0), -4.0..4.0]), 1..150),
        ) {
            let program = compile(&e, &names()).expect("all symbols are inputs");
            let points: Vec<[f64; 3]> = points.into_iter().map(|(x, y, t)| [x, y, t]).collect();
            let mut scratch = vec![f64::NAN; program.slots()];
            let columns: Vec<Vec<f64>> = (0..3).map(|i| points.iter().map(|p| p[i]).collect()).collect();
            let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
            let (mut blocks, mut threads) = (vec![0.0; points.len()], vec![0.0; points.len()]);
            program.eval_all(&columns, &mut blocks);
            program.eval_all_parallel(&columns, &mut threads);
            for (i, point) in points.iter().enumerate() {
                let at = Point::<f64> { values: names().into_iter().zip(*point).collect(), ..Point::default() };
                let expected = e.evaluate(&at).unwrap_or(f64::NAN);
                let one = program.eval(point, &mut scratch);
                prop_assert!(same(one, expected), "{e:?} at {point:?}: {one} for {expected}");
                prop_assert!(same(blocks[i], expected) && same(threads[i], expected));
            }
        }
    }

    #[test]
    fn a_sine_written_twice_is_computed_once() {
        let theta = Expr::symbol("theta");
        let e = Expr::sum([
            theta.sin().powi(2) * Expr::from(3),
            theta.sin().powi(4),
            theta.sin(),
        ]);
        let program = compile(&e, &names()).expect("compiles");
        // sin, its square, 3·square, the fourth power, two sums.
        assert_eq!(program.operations(), 6);
    }

    #[test]
    fn a_reciprocal_of_zero_does_not_come_back_as_a_number() {
        let e = (Expr::symbol("x").powi(-1) + Expr::one()).powi(-1);
        let program = compile(&e, &names()).expect("compiles");
        assert!(
            program
                .eval(&[0.0; 3], &mut vec![0.0; program.slots()])
                .is_nan()
        );
    }

    #[test]
    fn a_symbol_without_input_is_named() {
        let missing = compile(&Expr::symbol("k"), &names()).map(|_| ());
        assert_eq!(missing, Err(Unbound("k".into())));
    }

    #[test]
    fn every_route_is_timed_on_every_number_of_threads() {
        let e = Expr::symbol("x") * Expr::symbol("theta").cos();
        let program = compile(&e, &names()).expect("compiles");
        let column = vec![0.5; 1000];
        let columns = [&column[..], &column, &column];
        let rows = throughput(&program, |x| x[0] * x[2].cos(), &columns, &[1, 2], 3)
            .expect("threads start");
        assert_eq!(rows.len(), 6);
        assert!(
            rows.iter()
                .all(|r| r.points == 1000 && r.seconds[0] <= r.seconds[2] && r.per_second > 0.0)
        );
    }
}
