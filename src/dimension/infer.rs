//! The dimension of an expression from those of its symbols, or the place where two sides part.

use num_traits::One;

use super::Dimension;
use crate::expr::{Expr, Node, Symbol};

/// Why an expression has no dimension.
#[derive(Clone, PartialEq, Eq, Debug)]
// Always behind a box.
#[allow(clippy::large_enum_variant)]
pub enum Clash {
    /// A symbol whose dimension nobody told.
    Unknown(Symbol),
    /// Two terms of a sum that do not add up.
    Sum {
        /// The first term, or the first that fixes a dimension.
        left: Expr,
        /// Its dimension.
        left_is: Dimension,
        /// A later term.
        right: Expr,
        /// Its dimension.
        right_is: Dimension,
    },
    /// A function or an exponent of something that is no number.
    NotANumber {
        /// The whole: the function with its argument, or the power.
        whole: Expr,
        /// The argument or exponent.
        argument: Expr,
        /// Its dimension.
        is: Dimension,
    },
    /// A dimensional base under an exponent that is no fixed number.
    OpenPower {
        /// The power.
        whole: Expr,
        /// Dimension of the base.
        base_is: Dimension,
    },
}

impl Clash {
    /// The message to a reader, with expressions written by `write`.
    pub fn message(&self, write: &dyn Fn(&Expr) -> String) -> String {
        match self {
            Clash::Unknown(name) => format!("the dimension of {name} is not known"),
            Clash::Sum {
                left,
                left_is,
                right,
                right_is,
            } => {
                let (sign, size) = match right.begins_with_minus() {
                    true => ("−", -right),
                    false => ("+", right.clone()),
                };
                let (first, size) = (write(left), write(&size));
                let plain = [left, right].into_iter().find(|e| e.as_number().is_some());
                let hint = match plain.map(write) {
                    Some(number) => {
                        format!("{number} has no unit: let a parameter with a unit stand for it")
                    }
                    None => missing(left_is, right_is, &size),
                };
                format!("{first} {sign} {size}: {left_is} against {right_is}; {hint}")
            }
            Clash::NotANumber {
                whole,
                argument,
                is,
            } => {
                let (whole, argument) = (write(whole), write(argument));
                format!("in {whole}, {argument} should be a number and is {is}")
            }
            Clash::OpenPower { whole, base_is } => {
                let whole = write(whole);
                format!("{whole} raises {base_is} to a power that is no fixed number")
            }
        }
    }
}

/// Tells which factor would bring `found` to `expected`.
fn missing(expected: &Dimension, found: &Dimension, name: &str) -> String {
    let factor = expected.over(found).plain();
    format!("a factor of dimension {factor} is missing in {name}")
}

/// The dimension of an expression; `None` for a literal 0, which fits everything. Numbers and angles have no dimension.
pub fn of(
    e: &Expr,
    symbols: &dyn Fn(&str) -> Option<Dimension>,
) -> Result<Option<Dimension>, Box<Clash>> {
    match e.node() {
        Node::Number(_) if e.is_zero() => Ok(None),
        Node::Number(_) => Ok(Some(Dimension::none())),
        Node::Symbol(name) if &**name == "pi" => Ok(Some(Dimension::none())),
        Node::Symbol(name) => symbols(name)
            .map(Some)
            .ok_or_else(|| Clash::Unknown(name.clone()).into()),
        Node::Sum(terms) => {
            let mut known: Option<(&Expr, Dimension)> = None;
            for term in terms {
                let Some(found) = of(term, symbols)? else {
                    continue;
                };
                match &known {
                    None => known = Some((term, found)),
                    Some((left, left_is)) if *left_is != found => {
                        let (left, left_is) = ((*left).clone(), left_is.clone());
                        return Err(Box::new(Clash::Sum {
                            left,
                            left_is,
                            right: term.clone(),
                            right_is: found,
                        }));
                    }
                    Some(_) => {}
                }
            }
            Ok(known.map(|(_, dimension)| dimension))
        }
        Node::Product(factors) => {
            let mut total = Some(Dimension::none());
            for factor in factors {
                let found = of(factor, symbols)?;
                total = total.zip(found).map(|(a, b)| a.times(&b));
            }
            Ok(total)
        }
        Node::Power(base, exponent) => {
            number(e, exponent, symbols)?;
            let Some(below) = of(base, symbols)? else {
                return Ok(None);
            };
            match exponent.as_number() {
                Some(k) if k.is_one() => Ok(Some(below)),
                Some(k) => Ok(Some(below.power(k))),
                None if below.is_none() => Ok(Some(below)),
                None => Err(Box::new(Clash::OpenPower {
                    whole: e.clone(),
                    base_is: below,
                })),
            }
        }
        Node::Call(crate::expr::Function::Abs, argument) => of(argument, symbols),
        Node::Call(_, argument) => {
            number(e, argument, symbols)?;
            Ok(Some(Dimension::none()))
        }
    }
}

fn number(
    whole: &Expr,
    argument: &Expr,
    symbols: &dyn Fn(&str) -> Option<Dimension>,
) -> Result<(), Box<Clash>> {
    match of(argument, symbols)? {
        Some(is) if !is.is_none() => Err(Box::new(Clash::NotANumber {
            whole: whole.clone(),
            argument: argument.clone(),
            is,
        })),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mechanics(name: &str) -> Option<Dimension> {
        Some(match name {
            "m" => Dimension::new(1, 0, 0),
            "l" => Dimension::new(0, 1, 0),
            "v" => Dimension::new(0, 1, -1),
            "omega" => Dimension::new(0, 0, -1),
            "t" => Dimension::new(0, 0, 1),
            "theta" | "e" => Dimension::none(),
            _ => return None,
        })
    }

    #[test]
    fn a_product_a_root_and_a_zero_have_the_dimension_they_should() {
        let [m, l, v, omega, t] = ["m", "l", "v", "omega", "t"].map(Expr::symbol);
        assert_eq!(
            of(&(&m * &v), &mechanics),
            Ok(Some(Dimension::new(1, 1, -1)))
        );
        assert_eq!(
            of(&(&v.powi(2) + &(&l * &omega).powi(2)).sqrt(), &mechanics),
            Ok(Some(Dimension::new(0, 1, -1)))
        );
        assert_eq!(
            of(&(&omega * &t).sin(), &mechanics),
            Ok(Some(Dimension::none()))
        );
        assert_eq!(of(&Expr::zero(), &mechanics), Ok(None));
        assert_eq!(
            of(&Expr::symbol("q"), &mechanics),
            Err(Box::new(Clash::Unknown("q".into())))
        );
    }

    #[test]
    fn a_clash_names_both_sides_and_the_missing_factor() {
        let [m, l, v] = ["m", "l", "v"].map(Expr::symbol);
        let clash = of(&(&m * &v + &l), &mechanics).unwrap_err();
        let told = clash.message(&|e| format!("{e:?}"));
        assert_eq!(
            told,
            "(* m v) + l: mass × length/time against length; a factor of dimension mass/time is missing in l"
        );
        assert!(of(&l.sin(), &mechanics).is_err_and(|c| matches!(*c, Clash::NotANumber { .. })));
        assert!(of(&l.power(m), &mechanics).is_err_and(|c| matches!(*c, Clash::NotANumber { .. })));
        assert!(
            of(&l.power(Expr::symbol("e")), &mechanics)
                .is_err_and(|c| matches!(*c, Clash::OpenPower { .. }))
        );
    }
}
