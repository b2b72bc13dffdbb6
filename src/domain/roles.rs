//! How symbols occur in formulas: as angles, as plain values, or both.

use num_integer::Integer;
use num_traits::ToPrimitive;

use crate::expr::angle::angle;
use crate::expr::{Expr, Function, Node, Symbol, Table, ratio};

/// How a symbol occurs in formulas.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Role {
    /// It occurs under sin, cos or tan in a rational combination of symbols.
    pub turns: bool,
    /// It also occurs elsewhere, so that its value is needed and not only its direction.
    pub bare: bool,
    /// Smallest N such that only multiples of (angle)/N occur.
    pub divisor: u32,
}

/// The roles of all symbols of some formulas.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Roles {
    /// Role of each symbol.
    pub symbols: Table<Role>,
    /// Whether angles known by direction are also needed in radians: sin(θ + π/3), sin(θ + x) with x bare.
    pub radians: bool,
}

/// Divisors above this make fractions too long; the angle gets a plain value.
const LARGEST_DIVISOR: u32 = 24;

/// Finds how each symbol occurs.
pub fn roles(formulas: &[&Expr]) -> Roles {
    let mut out = Roles::default();
    formulas.iter().for_each(|e| note(e, &mut out));
    for role in out.symbols.values_mut() {
        // Too fine a division: treated as a value.
        role.bare |= role.turns && role.divisor > LARGEST_DIVISOR;
    }
    let mixed = out.symbols.values().any(|r| r.turns && r.bare)
        && out.symbols.values().any(|r| r.turns && !r.bare);
    out.radians |= mixed;
    out
}

fn note(e: &Expr, out: &mut Roles) {
    match e.node() {
        Node::Number(_) => {}
        Node::Symbol(name) => {
            if &**name != "pi" {
                role(out, name).bare = true;
            }
        }
        Node::Sum(parts) | Node::Product(parts) => parts.iter().for_each(|p| note(p, out)),
        Node::Power(base, exponent) => {
            note(base, out);
            note(exponent, out);
        }
        Node::Call(Function::Sin | Function::Cos | Function::Tan, argument) => {
            // Most angles are a bare symbol.
            if let Some(name) = argument.as_symbol().filter(|name| &***name != "pi") {
                role(out, name).turns = true;
                return;
            }
            match angle(argument) {
                Some(read) => {
                    out.radians |= !(&read.pi * ratio(2, 1)).is_integer();
                    for (name, factor) in &read.symbols {
                        let role = role(out, name);
                        role.turns = true;
                        let below = factor.denom().to_u32().unwrap_or(u32::MAX);
                        role.divisor = if role.divisor.max(below) > LARGEST_DIVISOR
                            || factor.numer().bits() > 11
                        {
                            u32::MAX
                        } else {
                            role.divisor.lcm(&below)
                        };
                    }
                }
                None => {
                    out.radians = true;
                    note(argument, out);
                }
            }
        }
        Node::Call(_, argument) => note(argument, out),
    }
}

fn role<'a>(out: &'a mut Roles, name: &Symbol) -> &'a mut Role {
    out.symbols.get_or_insert(name, || Role {
        turns: false,
        bare: false,
        divisor: 1,
    })
}
