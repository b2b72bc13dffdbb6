//! From an expression to a program: equal parts are found by how they are made and computed once.

use std::collections::HashMap;

use num_integer::Integer;
use num_traits::{One, Zero};

use super::{Op, Program};
use crate::expr::angle::angle;
use crate::expr::number::to_f64;
use crate::expr::{Expr, Function, Int, Node, Point, Rational, Symbol};

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

    /// The powers of `Expr::evaluate`: half-integers by root and repeated squaring, the rest by `powf`.
    fn power(&mut self, base: &Expr, exponent: &Expr) -> u32 {
        let x = self.expression(base);
        let twice = exponent
            .as_number()
            .map(|k| k * Rational::from(Int::from(2)));
        let Some(twice) = twice.filter(Rational::is_integer) else {
            let y = self.expression(exponent);
            return self.made(match exponent.as_number() {
                Some(k) if k.denom().is_odd() && k.numer().is_odd() => Op::OddRoot(x, y),
                Some(k) if k.denom().is_odd() => Op::EvenRoot(x, y),
                _ => Op::Pow(x, y),
            });
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
        Op::Add(a, b)
        | Op::Sub(a, b)
        | Op::Mul(a, b)
        | Op::Pow(a, b)
        | Op::OddRoot(a, b)
        | Op::EvenRoot(a, b) => [Some(a), Some(b)],
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
        Op::OddRoot(a, b) => Op::OddRoot(at(a), at(b)),
        Op::EvenRoot(a, b) => Op::EvenRoot(at(a), at(b)),
        Op::Neg(a) => Op::Neg(at(a)),
        Op::Recip(a) => Op::Recip(at(a)),
        Op::Sqrt(a) => Op::Sqrt(at(a)),
        Op::One(a) => Op::One(at(a)),
        Op::Call(f, a) => Op::Call(f, at(a)),
    }
}
