//! Straight-line programs in doubles, with double-doubles where a sum may cancel.
//!
//! Comes in: steps, each on earlier ones. Goes out: the value in doubles, and a bound of its error that holds at every
//! point. Knows nothing of formulas.

use super::dd::Dd;
use crate::expr::{Function, Scalar};

/// One step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// What it does.
    pub op: Op,
    /// Whether it holds a double-double, as its operands then do.
    pub wide: bool,
}

/// What a step does; operands are numbers of earlier steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Op {
    /// A number: the double nearest to the formula's, or 106 bits of it.
    Number(Dd),
    /// An input: taken as exact in doubles; wide, with all digits it has (the cosine of an angle, say).
    Input(usize),
    /// Sum.
    Add(usize, usize),
    /// Difference.
    Subtract(usize, usize),
    /// Product.
    Multiply(usize, usize),
    /// Quotient.
    Divide(usize, usize),
    /// Opposite.
    Negate(usize),
    /// Square root.
    Root(usize),
    /// Power with an odd exponent of its own; never wide.
    Power(usize, usize),
    /// Function; never wide.
    Call(Function, usize),
    /// A wide step rounded to a double.
    Round(usize),
    /// A plain step made wide.
    Widen(usize),
}

impl Op {
    /// In doubles.
    pub fn plain(self) -> Step {
        Step {
            op: self,
            wide: false,
        }
    }

    /// The earlier steps it uses.
    pub fn operands(self) -> [Option<usize>; 2] {
        match self {
            Op::Number(_) | Op::Input(_) => [None, None],
            Op::Negate(a) | Op::Root(a) | Op::Call(_, a) | Op::Round(a) | Op::Widen(a) => {
                [Some(a), None]
            }
            Op::Add(a, b)
            | Op::Subtract(a, b)
            | Op::Multiply(a, b)
            | Op::Divide(a, b)
            | Op::Power(a, b) => [Some(a), Some(b)],
        }
    }
}

/// A program for one value.
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// The steps; the value is the last one's.
    pub steps: Vec<Step>,
    /// How many inputs it takes.
    pub inputs: usize,
}

/// Relative errors of wide operations in units of 2⁻¹⁰⁶, as [`super::dd`] states them.
const SHORT: f64 = 8.0;
const LONG: f64 = 64.0;
/// 2⁻⁵³, the relative error of one plain operation.
pub const UNIT: f64 = 1.0 / (1u64 << 53) as f64;
/// 2⁻¹⁰⁶ in units of 2⁻⁵³.
const FINE: f64 = UNIT;

impl Program {
    /// The value; NaN or infinite where the formula has none or doubles do not reach. `slots` is scratch space.
    pub fn value(&self, inputs: &[f64], slots: &mut Vec<Dd>) -> f64 {
        slots.clear();
        for step in &self.steps {
            slots.push(perform(*step, slots, inputs));
        }
        slots.last().map_or(f64::NAN, |v| v.high)
    }

    /// The bound that holds at every point, in units of 2⁻⁵³ and to first order; `None` where a function makes it depend on
    /// more. `errors` holds the error of each input in the same units, 0 for exact ones, `wide_errors` that of wide inputs.
    /// Where wide sums cancel κ-fold, κ times `wide` is added.
    pub fn bound(&self, errors: &[f64], wide_errors: &[f64]) -> Option<Bound> {
        let mut bounds: Vec<Bound> = Vec::with_capacity(self.steps.len());
        for Step { op, wide } in &self.steps {
            let of = |a: usize| bounds[a];
            let inherited = match *op {
                Op::Number(_) => Bound::default(),
                Op::Input(i) if *wide => Bound::wide(wide_errors[i]),
                Op::Input(i) => Bound::plain(errors[i]),
                Op::Add(a, b) | Op::Subtract(a, b) => Bound {
                    plain: of(a).plain.max(of(b).plain),
                    wide: of(a).wide.max(of(b).wide),
                },
                Op::Multiply(a, b) | Op::Divide(a, b) => of(a).and(of(b)),
                Op::Negate(a) | Op::Root(a) | Op::Round(a) | Op::Call(Function::Abs, a) => of(a),
                Op::Power(..) | Op::Call(..) => return None,
                // What was rounded before it became wide is amplified with the rest.
                Op::Widen(a) => Bound::wide(of(a).plain + of(a).wide),
            };
            bounds.push(inherited.and(match (*op, *wide) {
                (Op::Number(v), false) => Bound::plain(number_error(v.high)),
                (Op::Number(_), true) => Bound::wide(FINE),
                (Op::Input(_) | Op::Negate(_) | Op::Call(..) | Op::Widen(_), _) => Bound::default(),
                (_, false) => Bound::plain(1.0),
                (Op::Divide(..), true) => Bound::wide((LONG + SHORT) * FINE),
                (Op::Root(_), true) => Bound::wide(LONG * FINE),
                (_, true) => Bound::wide(SHORT * FINE),
            }));
        }
        bounds.last().copied()
    }

    /// Whether any step is wide.
    pub fn is_wide(&self) -> bool {
        self.steps.iter().any(|s| matches!(s.op, Op::Round(_)))
    }
}

/// Error of a number written in a program: whole numbers below 2⁵³ are exact.
fn number_error(value: f64) -> f64 {
    let exact = value.fract() == 0.0 && value.abs() < (1u64 << 53) as f64;
    if exact { 0.0 } else { 1.0 }
}

/// Relative error: `plain` everywhere, and `wide` times the factor by which wide sums cancel; units of 2⁻⁵³.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bound {
    /// What always applies.
    pub plain: f64,
    /// What cancellation amplifies.
    pub wide: f64,
}

impl Bound {
    fn plain(plain: f64) -> Bound {
        Bound { plain, wide: 0.0 }
    }

    fn wide(wide: f64) -> Bound {
        Bound { plain: 0.0, wide }
    }

    fn and(self, other: Bound) -> Bound {
        Bound {
            plain: self.plain + other.plain,
            wide: self.wide + other.wide,
        }
    }
}

fn perform(step: Step, slots: &[Dd], inputs: &[f64]) -> Dd {
    let wide = |i: usize| slots[i];
    if step.wide {
        return match step.op {
            Op::Add(a, b) => wide(a) + wide(b),
            Op::Subtract(a, b) => wide(a) + -wide(b),
            Op::Multiply(a, b) => wide(a) * wide(b),
            Op::Divide(a, b) => wide(a) * wide(b).inverse(),
            Op::Negate(a) => -wide(a),
            Op::Root(a) => wide(a).root(),
            Op::Number(v) => v,
            op => perform(op.plain(), slots, inputs),
        };
    }
    let plain = |i: usize| slots[i].high;
    Dd::exact(match step.op {
        Op::Number(v) => v.high,
        Op::Input(i) => inputs[i],
        Op::Add(a, b) => plain(a) + plain(b),
        Op::Subtract(a, b) => plain(a) - plain(b),
        Op::Multiply(a, b) => plain(a) * plain(b),
        Op::Divide(a, b) => plain(a) / plain(b),
        Op::Negate(a) => -plain(a),
        Op::Root(a) => plain(a).sqrt(),
        Op::Power(a, b) => plain(a).powf(plain(b)),
        Op::Call(f, a) => plain(a).call(f).unwrap_or(f64::NAN),
        Op::Round(a) | Op::Widen(a) => plain(a),
    })
}
