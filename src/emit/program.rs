//! Straight-line programs in doubles, with double-doubles where a sum may cancel.
//!
//! Comes in: steps, each on earlier ones. Goes out: the value in doubles, and on request a bound of its error that holds
//! at the point at hand. Knows nothing of formulas.

use super::dd::Dd;
use crate::expr::{Function, Scalar};

/// One step. Plain steps hold a double, wide ones a double-double; operands are numbers of earlier steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// A double that the formula's number rounds to.
    Number(f64),
    /// An input, taken as exact.
    Input(usize),
    /// Plain sum.
    Add(usize, usize),
    /// Plain difference.
    Subtract(usize, usize),
    /// Plain product.
    Multiply(usize, usize),
    /// Plain quotient.
    Divide(usize, usize),
    /// Plain opposite.
    Negate(usize),
    /// Plain square root.
    Root(usize),
    /// Plain power with an odd exponent of its own.
    Power(usize, usize),
    /// Plain function.
    Call(Function, usize),
    /// A wide step rounded to a double.
    Round(usize),
    /// A plain step made wide.
    Widen(usize),
    /// An input with all digits it has, where the plain one is it rounded: the cosine of an angle, say.
    WideInput(usize),
    /// A number to 106 bits.
    WideNumber(Dd),
    /// Wide sum.
    WideAdd(usize, usize),
    /// Wide product.
    WideMultiply(usize, usize),
    /// Wide quotient.
    WideDivide(usize, usize),
    /// Wide opposite.
    WideNegate(usize),
    /// Wide square root.
    WideRoot(usize),
}

impl Step {
    /// The earlier steps it uses.
    pub fn operands(self) -> [Option<usize>; 2] {
        match self {
            Step::Number(_) | Step::Input(_) | Step::WideNumber(_) | Step::WideInput(_) => {
                [None, None]
            }
            Step::Negate(a)
            | Step::Root(a)
            | Step::Call(_, a)
            | Step::Round(a)
            | Step::Widen(a)
            | Step::WideNegate(a)
            | Step::WideRoot(a) => [Some(a), None],
            Step::Add(a, b)
            | Step::Subtract(a, b)
            | Step::Multiply(a, b)
            | Step::Divide(a, b)
            | Step::Power(a, b)
            | Step::WideAdd(a, b)
            | Step::WideMultiply(a, b)
            | Step::WideDivide(a, b) => [Some(a), Some(b)],
        }
    }

    /// Whether its value is a double-double.
    pub fn is_wide(self) -> bool {
        matches!(
            self,
            Step::Widen(_)
                | Step::WideInput(_)
                | Step::WideNumber(_)
                | Step::WideAdd(..)
                | Step::WideMultiply(..)
                | Step::WideDivide(..)
                | Step::WideNegate(_)
                | Step::WideRoot(_)
        )
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

    /// The value and a bound of its relative error in units of 2⁻⁵³, at this point and to first order. `errors` holds the
    /// error of each input in the same units, 0 for exact ones. Infinite where a sum cancels altogether.
    pub fn value_with_bound(&self, inputs: &[f64], errors: &[f64]) -> (f64, f64) {
        let mut slots: Vec<Dd> = Vec::with_capacity(self.steps.len());
        let mut bounds: Vec<f64> = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            let value = perform(*step, &slots, inputs);
            let weighted = |a: usize, b: usize| {
                let sum = slots[a].high.abs() * bounds[a] + slots[b].high.abs() * bounds[b];
                if sum == 0.0 {
                    0.0
                } else {
                    sum / value.high.abs()
                }
            };
            bounds.push(match *step {
                Step::Number(v) => number_error(v),
                Step::Input(i) | Step::WideInput(i) => errors[i],
                Step::Add(a, b) | Step::Subtract(a, b) => weighted(a, b) + 1.0,
                Step::Multiply(a, b) | Step::Divide(a, b) => bounds[a] + bounds[b] + 1.0,
                Step::Negate(a) | Step::WideNegate(a) | Step::Widen(a) => bounds[a],
                Step::Root(a) => 0.5 * bounds[a] + 1.0,
                Step::Call(Function::Abs, a) => bounds[a],
                Step::Power(..) | Step::Call(..) => f64::INFINITY,
                Step::Round(a) => bounds[a] + 1.0,
                Step::WideNumber(_) => FINE,
                Step::WideAdd(a, b) => weighted(a, b) + SHORT * FINE,
                Step::WideMultiply(a, b) => bounds[a] + bounds[b] + SHORT * FINE,
                Step::WideDivide(a, b) => bounds[a] + bounds[b] + (LONG + SHORT) * FINE,
                Step::WideRoot(a) => 0.5 * bounds[a] + LONG * FINE,
            });
            slots.push(value);
        }
        let value = slots.last().map_or(f64::NAN, |v| v.high);
        (value, bounds.last().copied().unwrap_or(f64::INFINITY))
    }

    /// The bound that holds at every point, in units of 2⁻⁵³ and to first order; `None` where a function makes it depend on
    /// more. `errors` as in [`Program::value_with_bound`], `wide_errors` those of [`Step::WideInput`]. Where wide sums cancel
    /// κ-fold, κ times `wide` is added.
    pub fn bound(&self, errors: &[f64], wide_errors: &[f64]) -> Option<Bound> {
        let mut bounds: Vec<Bound> = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            let of = |a: usize| bounds[a];
            let larger = |a: usize, b: usize| Bound {
                plain: of(a).plain.max(of(b).plain),
                wide: of(a).wide.max(of(b).wide),
            };
            let both = |a: usize, b: usize| Bound {
                plain: of(a).plain + of(b).plain,
                wide: of(a).wide + of(b).wide,
            };
            let plain = |b: Bound| Bound {
                plain: b.plain + 1.0,
                ..b
            };
            let wide = |b: Bound, by: f64| Bound {
                wide: b.wide + by * FINE,
                ..b
            };
            bounds.push(match *step {
                Step::Number(v) => Bound {
                    plain: number_error(v),
                    wide: 0.0,
                },
                Step::Input(i) => Bound {
                    plain: errors[i],
                    wide: 0.0,
                },
                Step::Add(a, b) | Step::Subtract(a, b) => plain(larger(a, b)),
                Step::Multiply(a, b) | Step::Divide(a, b) => plain(both(a, b)),
                Step::Negate(a) | Step::WideNegate(a) | Step::Call(Function::Abs, a) => of(a),
                Step::Root(a) | Step::Round(a) => plain(of(a)),
                Step::Power(..) | Step::Call(..) => return None,
                // What was rounded before it became wide is amplified with the rest.
                Step::Widen(a) => Bound {
                    plain: 0.0,
                    wide: of(a).plain + of(a).wide,
                },
                Step::WideInput(i) => Bound {
                    plain: 0.0,
                    wide: wide_errors[i],
                },
                Step::WideNumber(_) => Bound {
                    plain: 0.0,
                    wide: FINE,
                },
                Step::WideAdd(a, b) => wide(larger(a, b), SHORT),
                Step::WideMultiply(a, b) => wide(both(a, b), SHORT),
                Step::WideDivide(a, b) => wide(both(a, b), LONG + SHORT),
                Step::WideRoot(a) => wide(of(a), LONG),
            });
        }
        bounds.last().copied()
    }

    /// Whether any step is wide.
    pub fn is_wide(&self) -> bool {
        self.steps.iter().any(|s| matches!(s, Step::Round(_)))
    }
}

/// Error of a number written in a program: whole numbers below 2⁵³ are exact.
fn number_error(value: f64) -> f64 {
    let exact = value.fract() == 0.0 && value.abs() < (1u64 << 53) as f64;
    if exact { 0.0 } else { 1.0 }
}

/// Relative error: `plain` everywhere, and `wide` times the factor by which wide sums cancel; units of 2⁻⁵³.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// What always applies.
    pub plain: f64,
    /// What cancellation amplifies.
    pub wide: f64,
}

fn perform(step: Step, slots: &[Dd], inputs: &[f64]) -> Dd {
    let plain = |i: usize| slots[i].high;
    let wide = |i: usize| slots[i];
    match step {
        Step::Number(v) => Dd::exact(v),
        Step::Input(i) | Step::WideInput(i) => Dd::exact(inputs[i]),
        Step::Add(a, b) => Dd::exact(plain(a) + plain(b)),
        Step::Subtract(a, b) => Dd::exact(plain(a) - plain(b)),
        Step::Multiply(a, b) => Dd::exact(plain(a) * plain(b)),
        Step::Divide(a, b) => Dd::exact(plain(a) / plain(b)),
        Step::Negate(a) => Dd::exact(-plain(a)),
        Step::Root(a) => Dd::exact(plain(a).sqrt()),
        Step::Power(a, b) => Dd::exact(plain(a).powf(plain(b))),
        Step::Call(f, a) => Dd::exact(plain(a).call(f).unwrap_or(f64::NAN)),
        Step::Round(a) => Dd::exact(wide(a).high),
        Step::Widen(a) => Dd::exact(plain(a)),
        Step::WideNumber(v) => v,
        Step::WideAdd(a, b) => wide(a) + wide(b),
        Step::WideMultiply(a, b) => wide(a) * wide(b),
        Step::WideDivide(a, b) => wide(a) * wide(b).inverse(),
        Step::WideNegate(a) => -wide(a),
        Step::WideRoot(a) => wide(a).root(),
    }
}
