//! A term as a quotient, the way a person writes it: its sign, the factors above the bar and those below.

use num_traits::{One, Signed};

use crate::expr::{Expr, Function, Node, Rational, number};

/// Sign and factors of a term: numbers first, functions last.
#[derive(Default)]
pub struct Quotient {
    /// Whether a minus sign stands before it.
    pub negative: bool,
    /// The factors above; none stand for 1.
    pub above: Vec<Expr>,
    /// The factors below; none where it is no fraction.
    pub below: Vec<Expr>,
}

impl Quotient {
    /// Of an expression that is no sum.
    pub fn of(e: &Expr) -> Quotient {
        let mut q = Quotient::default();
        q.take(e.factors());
        q.above.sort_by_key(class);
        q.below.sort_by_key(class);
        q
    }

    /// The same for people: a sine over the cosine of the same angle is its tangent, and the other way round below the bar.
    pub fn typeset(e: &Expr) -> Quotient {
        let mut q = Quotient::of(e);
        q.tangents();
        std::mem::swap(&mut q.above, &mut q.below);
        q.tangents();
        std::mem::swap(&mut q.above, &mut q.below);
        q
    }

    /// Tangents above the bar, for sines there and cosines below of the same angle and power.
    fn tangents(&mut self) {
        for factor in &mut self.above {
            let Some((cosine, tangent)) = in_place_of_sine(factor) else {
                continue;
            };
            if let Some(at) = self.below.iter().position(|below| *below == cosine) {
                self.below.remove(at);
                *factor = tangent;
            }
        }
    }

    /// Sorts factors into above and below; a product below is opened, so that its factors stand beside the others.
    fn take(&mut self, factors: &[Expr]) {
        for factor in factors {
            match factor.node() {
                Node::Number(value) => {
                    self.negative ^= value.is_negative();
                    let n = value.numer().abs();
                    if !n.is_one() {
                        self.above.push(Expr::from(Rational::from(n)));
                    }
                    if !value.is_integer() {
                        let d = Rational::from(value.denom().clone());
                        self.below.push(Expr::from(d));
                    }
                }
                Node::Power(base, exponent) => match exponent.as_number() {
                    // A literal (1/2)^-1 would fold; only powers that stay powers are moved below.
                    Some(k) if number::is(k, -1, 1) => {
                        if let Node::Product(inner) = base.node() {
                            std::mem::swap(&mut self.above, &mut self.below);
                            self.take(inner);
                            std::mem::swap(&mut self.above, &mut self.below);
                        } else {
                            self.below.push(base.clone());
                        }
                    }
                    Some(k) if k.is_negative() => self.below.push(base.power(Expr::from(-k))),
                    _ => self.above.push(factor.clone()),
                },
                _ => self.above.push(factor.clone()),
            }
        }
    }
}

/// The cosine of the same angle and power as a sine, and the tangent.
fn in_place_of_sine(factor: &Expr) -> Option<(Expr, Expr)> {
    match factor.node() {
        Node::Call(Function::Sin, angle) => Some((angle.cos(), angle.tan())),
        Node::Power(base, k) => {
            let (cosine, tangent) = in_place_of_sine(base)?;
            Some((cosine.power(k.clone()), tangent.power(k.clone())))
        }
        _ => None,
    }
}

/// Numbers and their roots, then names, then other roots, then sums, then functions.
fn class(e: &Expr) -> u8 {
    match e.node() {
        Node::Number(_) => 0,
        Node::Symbol(_) => 1,
        Node::Power(base, exponent) if !exponent.as_number().is_some_and(Rational::is_integer) => {
            match (class(base), exponent.as_number()) {
                (0, Some(_)) => 0,
                (base, _) => base.max(2),
            }
        }
        Node::Power(base, _) => class(base),
        Node::Product(_) => 2,
        Node::Sum(_) => 3,
        Node::Call(Function::Abs, _) => 3,
        Node::Call(..) => 4,
    }
}
