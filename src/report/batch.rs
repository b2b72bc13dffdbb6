//! A closed form compiled for many points: expression in, straight-line program out, values by the million.
//!
//! The program does the same roundings in the same order as [`Expr::evaluate`] over doubles, so the two agree bit for bit;
//! where `evaluate` has no value the program gives NaN. It knows nothing of what the formula means.

use std::collections::HashMap;
use std::time::Instant;

use num_traits::{One, Zero};
use rayon::prelude::*;
use serde::Serialize;

use crate::expr::angle::angle;
use crate::expr::number::to_f64;
use crate::expr::{Expr, Function, Int, Node, Point, Rational, Symbol};

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

/// A symbol of the formula that the order of inputs does not name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unbound(
    /// The symbol.
    pub Symbol,
);

impl std::fmt::Display for Unbound {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "no input is named {}", self.0)
    }
}

impl std::error::Error for Unbound {}

/// Compiles a formula; `order` names the inputs, a name given twice counts where it stands first.
pub fn compile(formula: &Expr, order: &[Symbol]) -> Result<Program, Unbound> {
    if let Some(name) = formula
        .symbols()
        .into_iter()
        .find(|name| !order.contains(name))
    {
        return Err(Unbound(name));
    }
    let mut compiler = Compiler {
        order,
        values: Vec::new(),
        numbers: HashMap::new(),
        seen: HashMap::new(),
    };
    let result = compiler.expression(formula);
    Ok(compiler.lay_out(result))
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
    /// [`compile`]; `scratch` holds at least [`Program::slots`] numbers, of any value.
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

/// A value while compiling: numbered by how it is made, so equal ones are one.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Value {
    Constant(u64),
    Input(u32),
    Made(Op),
}

struct Compiler<'a> {
    order: &'a [Symbol],
    values: Vec<Value>,
    numbers: HashMap<Value, u32>,
    /// Shared parts of the expression are compiled once, found again by their address.
    seen: HashMap<*const Node, u32>,
}

impl Compiler<'_> {
    fn value(&mut self, value: Value) -> u32 {
        *self.numbers.entry(value).or_insert_with(|| {
            self.values.push(value);
            (self.values.len() - 1) as u32
        })
    }

    fn constant(&mut self, value: f64) -> u32 {
        self.value(Value::Constant(value.to_bits()))
    }

    fn is_constant(&self, of: u32, value: f64) -> bool {
        self.values[of as usize] == Value::Constant(value.to_bits())
    }

    fn negated(&self, of: u32) -> Option<u32> {
        match self.values[of as usize] {
            Value::Made(Op::Neg(inner)) => Some(inner),
            _ => None,
        }
    }

    fn made(&mut self, op: Op) -> u32 {
        self.value(Value::Made(op))
    }

    fn negate(&mut self, a: u32) -> u32 {
        match self.negated(a) {
            Some(inner) => inner,
            None => self.made(Op::Neg(a)),
        }
    }

    // Signs move outwards and sums with a negative become differences: rounding is symmetric, so no bit changes.
    fn add(&mut self, a: u32, b: u32) -> u32 {
        match (self.negated(a), self.negated(b)) {
            (_, Some(b)) => self.made(Op::Sub(a, b)),
            (Some(a), None) => self.made(Op::Sub(b, a)),
            (None, None) => self.made(Op::Add(a.min(b), a.max(b))),
        }
    }

    fn multiply(&mut self, a: u32, b: u32) -> u32 {
        match (self.negated(a), self.negated(b)) {
            (Some(a), Some(b)) => return self.multiply(a, b),
            (Some(a), None) => {
                let product = self.multiply(a, b);
                return self.negate(product);
            }
            (None, Some(b)) => {
                let product = self.multiply(a, b);
                return self.negate(product);
            }
            (None, None) => {}
        }
        for (one, other) in [(a, b), (b, a)] {
            if self.is_constant(one, 1.0) {
                return other;
            }
            if self.is_constant(one, -1.0) {
                return self.negate(other);
            }
        }
        self.made(Op::Mul(a.min(b), a.max(b)))
    }

    fn recip(&mut self, a: u32) -> u32 {
        match self.negated(a) {
            Some(inner) => {
                let inverse = self.made(Op::Recip(inner));
                self.negate(inverse)
            }
            None => self.made(Op::Recip(a)),
        }
    }

    fn expression(&mut self, e: &Expr) -> u32 {
        let key = std::ptr::from_ref(e.node());
        if let Some(known) = self.seen.get(&key) {
            return *known;
        }
        let value = self.fresh(e);
        self.seen.insert(key, value);
        value
    }

    fn fresh(&mut self, e: &Expr) -> u32 {
        match e.node() {
            Node::Number(value) => self.constant(to_f64(value)),
            Node::Symbol(name) if &**name == "pi" => self.constant(std::f64::consts::PI),
            Node::Symbol(name) => match self.order.iter().position(|n| n == name) {
                Some(i) => self.value(Value::Input(i as u32)),
                None => self.constant(f64::NAN),
            },
            Node::Sum(terms) => {
                let mut total = self.expression(&terms[0]);
                for term in &terms[1..] {
                    let term = self.expression(term);
                    total = self.add(total, term);
                }
                total
            }
            Node::Product(factors) => {
                let mut total = self.expression(&factors[0]);
                for factor in &factors[1..] {
                    let factor = self.expression(factor);
                    total = self.multiply(total, factor);
                }
                total
            }
            Node::Power(base, exponent) => self.power(base, exponent),
            Node::Call(function, argument) => {
                // Whole quarter turns have exact sines, whatever symbols cancel in the angle.
                let turns = matches!(function, Function::Sin | Function::Cos | Function::Tan)
                    && angle(argument).is_some_and(|a| {
                        a.symbols.is_empty() && (a.pi * Rational::from(Int::from(2))).is_integer()
                    });
                if turns {
                    let exact =
                        Expr::call(*function, argument.clone()).evaluate(&Point::<f64>::default());
                    return self.constant(exact.unwrap_or(f64::NAN));
                }
                let argument = self.expression(argument);
                self.made(Op::Call(*function, argument))
            }
        }
    }

    /// The powers of [`Expr::evaluate`]: half-integers by root and repeated squaring, the rest by `powf`.
    fn power(&mut self, base: &Expr, exponent: &Expr) -> u32 {
        let x = self.expression(base);
        let twice = exponent
            .as_number()
            .map(|k| k * Rational::from(Int::from(2)));
        let Some(twice) = twice.filter(Rational::is_integer) else {
            let y = self.expression(exponent);
            return self.made(Op::Pow(x, y));
        };
        let Some(n) = twice.numer().as_i64() else {
            return self.constant(f64::NAN);
        };
        if n.is_zero() {
            return self.made(Op::One(x));
        }
        let (root, times) = if n % 2 == 0 {
            (x, n / 2)
        } else {
            (self.made(Op::Sqrt(x)), n)
        };
        let raised = self.integer_power(root, times.unsigned_abs());
        if times < 0 {
            self.recip(raised)
        } else {
            raised
        }
    }

    fn integer_power(&mut self, base: u32, exponent: u64) -> u32 {
        let (mut result, mut square, mut left) = (None, base, exponent);
        while !left.is_zero() {
            if !(left & 1).is_zero() {
                result = Some(match result {
                    Some(so_far) => self.multiply(so_far, square),
                    None => square,
                });
            }
            left >>= 1;
            if !left.is_zero() {
                square = self.multiply(square, square);
            }
        }
        result.unwrap_or_else(|| self.constant(f64::one()))
    }

    /// Drops what the result does not need and numbers the slots: constants, inputs, operations.
    fn lay_out(&self, result: u32) -> Program {
        let mut needed = vec![false; self.values.len()];
        needed[result as usize] = true;
        for (i, value) in self.values.iter().enumerate().rev() {
            if let (true, Value::Made(op)) = (needed[i], value) {
                operands(*op)
                    .into_iter()
                    .flatten()
                    .for_each(|k| needed[k as usize] = true);
            }
        }
        let mut constants = Vec::new();
        let mut slot = vec![0_u32; self.values.len()];
        for (i, value) in self.values.iter().enumerate() {
            if let (true, Value::Constant(bits)) = (needed[i], value) {
                slot[i] = constants.len() as u32;
                constants.push(f64::from_bits(*bits));
            }
        }
        let inputs = self.order.len();
        let mut operations = Vec::new();
        for (i, value) in self.values.iter().enumerate() {
            match value {
                Value::Input(k) => slot[i] = constants.len() as u32 + k,
                Value::Made(op) if needed[i] => {
                    slot[i] = (constants.len() + inputs + operations.len()) as u32;
                    operations.push(renumbered(*op, &slot));
                }
                _ => {}
            }
        }
        Program {
            constants,
            inputs,
            operations,
            result: slot[result as usize] as usize,
        }
    }
}

fn operands(op: Op) -> [Option<u32>; 2] {
    match op {
        Op::Add(a, b) | Op::Sub(a, b) | Op::Mul(a, b) | Op::Pow(a, b) => [Some(a), Some(b)],
        Op::Neg(a) | Op::Recip(a) | Op::Sqrt(a) | Op::One(a) | Op::Call(_, a) => [Some(a), None],
    }
}

fn renumbered(op: Op, slot: &[u32]) -> Op {
    let at = |i: u32| slot[i as usize];
    match op {
        Op::Add(a, b) => Op::Add(at(a), at(b)),
        Op::Sub(a, b) => Op::Sub(at(a), at(b)),
        Op::Mul(a, b) => Op::Mul(at(a), at(b)),
        Op::Pow(a, b) => Op::Pow(at(a), at(b)),
        Op::Neg(a) => Op::Neg(at(a)),
        Op::Recip(a) => Op::Recip(at(a)),
        Op::Sqrt(a) => Op::Sqrt(at(a)),
        Op::One(a) => Op::One(at(a)),
        Op::Call(f, a) => Op::Call(f, at(a)),
    }
}

/// Time of one way to evaluate a formula at many points.
#[derive(Clone, Debug, Serialize)]
pub struct Throughput {
    /// Which way.
    pub route: Route,
    /// Threads used.
    pub threads: usize,
    /// Points per run.
    pub points: usize,
    /// Lower quartile, median and upper quartile of the time of one run [s].
    pub seconds: [f64; 3],
    /// Points per second at the median.
    pub per_second: f64,
}

/// Ways to evaluate a formula at many points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Route {
    /// The expression walked at each point.
    Expression,
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

/// Quartiles of the time of `work` [s] over `runs` runs, after one that does not count.
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

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use proptest::prelude::*;

    use super::*;

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
                let mut at = Point::<f64>::default();
                at.values = names().into_iter().zip(*point).collect();
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
