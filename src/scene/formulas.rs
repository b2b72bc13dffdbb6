//! Formulas of a scene: read with the scene's symbols, and held to the dimension their field has.
//!
//! In: the text of a formula and what is expected of it. Out: an expression, or a fault that points into the formula.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use super::fault::{Fault, Span, nearest};
use super::record::{Formula, Pair};
use crate::dimension::{self, Dimension};
use crate::expr::number::to_f64;
use crate::expr::{Expr, Node, Symbol, Vector};

/// What a field holds: its name, dimension and a remark that helps when the dimension is wrong.
#[derive(Clone, Copy)]
pub(super) struct Quantity {
    /// Exponents of mass, length and time.
    exponents: [i64; 3],
    /// How such a quantity is made.
    hint: &'static str,
}

impl Quantity {
    pub const NUMBER: Quantity = Quantity { exponents: [0, 0, 0], hint: "divide by a quantity of the same kind" };
    pub const ANGLE: Quantity = Quantity { exponents: [0, 0, 0], hint: "an angle is in radians, or pi/180 times degrees" };
    pub const DIRECTION: Quantity =
        Quantity { exponents: [0, 0, 0], hint: "a direction has components without unit, such as [\"cos(theta)\", \"sin(theta)\"]" };
    pub const MASS: Quantity = Quantity { exponents: [1, 0, 0], hint: "a mass, such as m or 3*m" };
    pub const LENGTH: Quantity = Quantity { exponents: [0, 1, 0], hint: "a length, such as l/2 or d*cos(theta)" };
    pub const VELOCITY: Quantity = Quantity { exponents: [0, 1, -1], hint: "a velocity, such as v or omega*l" };
    pub const SPIN: Quantity =
        Quantity { exponents: [0, 0, -1], hint: "a spin is an angle per time: of a point at speed v and distance l it is v/l" };
    pub const INERTIA: Quantity =
        Quantity { exponents: [1, 2, 0], hint: "a uniform rod of length l has inertia m l^2/12 about its center" };
    pub const IMPULSE: Quantity = Quantity { exponents: [1, 1, -1], hint: "an impulse is a mass times a velocity" };

    /// Its dimension.
    pub fn dimension(self) -> Dimension {
        let [mass, length, time] = self.exponents;
        Dimension::new(mass, length, time)
    }

    /// How such a quantity is made.
    pub fn hint(self) -> &'static str {
        self.hint
    }
}

/// The symbols formulas may use, and which of them have been used.
pub(super) struct Symbols {
    dimensions: BTreeMap<Symbol, Dimension>,
    used: RefCell<BTreeSet<Symbol>>,
}

impl Symbols {
    pub fn new(dimensions: BTreeMap<Symbol, Dimension>) -> Symbols {
        Symbols { dimensions, used: RefCell::default() }
    }

    /// Whether a formula read so far uses the symbol.
    pub fn is_used(&self, name: &str) -> bool {
        self.used.borrow().contains(name)
    }

    /// Counts a symbol as used.
    pub fn mark_used(&self, name: &str) {
        self.used.borrow_mut().insert(name.into());
    }

    /// Reads a formula of the given dimension. A formula without symbols is a number in SI units, whatever the field.
    pub fn read(&self, formula: &Formula, quantity: Quantity, faults: &mut Vec<Fault>) -> Option<Expr> {
        let e = self.expression(formula, faults)?;
        let symbols = e.symbols();
        let is_number = symbols.is_empty();
        self.used.borrow_mut().extend(symbols);
        if is_number {
            return Some(e);
        }
        match dimension::of(&e, &|name| self.dimensions.get(name).cloned()) {
            Err(clash) => {
                faults.push(Fault::new(formula.span, clash.message(&|e| format!("{e:?}"))));
                None
            }
            Ok(Some(found)) if found != quantity.dimension() => {
                let message = format!("expected {}, found {found}", quantity.dimension());
                faults.push(Fault::new(formula.span, message).hint(quantity.hint));
                None
            }
            Ok(_) => Some(e),
        }
    }

    /// Reads both components of a vector.
    pub fn vector(&self, pair: &Pair<Formula>, quantity: Quantity, faults: &mut Vec<Fault>) -> Option<Vector> {
        let [x, y] = &pair.items;
        let (x, y) = (self.read(x, quantity, faults), self.read(y, quantity, faults));
        Some([x?, y?])
    }

    /// Reads a formula without regard to its dimension.
    pub fn expression(&self, formula: &Formula, faults: &mut Vec<Fault>) -> Option<Expr> {
        let names: Vec<&str> = self.dimensions.keys().map(|k| &**k).collect();
        match expression(&formula.text, &names) {
            Ok(e) if is_finite(&e) => Some(e),
            Ok(_) => {
                faults.push(Fault::new(formula.span, "a number here is too large").hint("numbers go up to about 1e308"));
                None
            }
            Err(trouble) => {
                let span = formula.start.map_or(formula.span, |at| Span::new(at + trouble.start, at + trouble.end));
                let mut fault = Fault::new(span, trouble.message);
                fault.hint = trouble.hint;
                faults.push(fault);
                None
            }
        }
    }
}

/// Whether every number in the expression is within the range of doubles.
fn is_finite(e: &Expr) -> bool {
    let mut finite = true;
    e.walk(&mut |part| {
        if let Node::Number(value) = part.node() {
            finite &= to_f64(value).is_finite();
        }
    });
    finite
}

/// Why a formula could not be read, and where in it.
struct Trouble {
    start: usize,
    end: usize,
    message: String,
    hint: Option<String>,
}

/// A stand-in until `formula::read` lands.
fn expression(text: &str, names: &[&str]) -> Result<Expr, Trouble> {
    let mut p = Stub { text, at: 0, names, depth: 0 };
    let e = p.sum()?;
    p.blank();
    if p.at < text.len() { Err(p.trouble("unexpected")) } else { Ok(e) }
}

struct Stub<'a> {
    text: &'a str,
    at: usize,
    names: &'a [&'a str],
    depth: usize,
}

impl Stub<'_> {
    fn trouble(&self, m: &str) -> Trouble {
        Trouble { start: self.at, end: self.at, message: m.into(), hint: None }
    }
    fn blank(&mut self) {
        while self.text[self.at..].starts_with(' ') {
            self.at += 1;
        }
    }
    fn eat(&mut self, c: char) -> bool {
        self.blank();
        let hit = self.text[self.at..].starts_with(c);
        if hit {
            self.at += 1;
        }
        hit
    }
    fn sum(&mut self) -> Result<Expr, Trouble> {
        self.depth += 1;
        if self.depth > 50 {
            return Err(self.trouble("too deep"));
        }
        let mut e = self.product()?;
        loop {
            if self.eat('+') {
                e = e + self.product()?;
            } else if self.eat('-') {
                e = e - self.product()?;
            } else {
                self.depth -= 1;
                return Ok(e);
            }
        }
    }
    fn product(&mut self) -> Result<Expr, Trouble> {
        let mut e = self.unary()?;
        loop {
            if self.eat('*') {
                e = e * self.unary()?;
            } else if self.eat('/') {
                e = e / self.unary()?;
            } else {
                return Ok(e);
            }
        }
    }
    fn unary(&mut self) -> Result<Expr, Trouble> {
        if self.eat('-') {
            let e = self.atom()?;
            return Ok(-e);
        }
        let e = self.atom()?;
        if self.eat('^') { Ok(e.power(self.atom()?)) } else { Ok(e) }
    }
    fn atom(&mut self) -> Result<Expr, Trouble> {
        if self.eat('(') {
            let e = self.sum()?;
            return if self.eat(')') { Ok(e) } else { Err(self.trouble(")")) };
        }
        let rest = &self.text[self.at..];
        let digits = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
        if digits > 0 {
            let (i, f) = rest[..digits].split_once('.').unwrap_or((&rest[..digits], ""));
            let n: i64 = format!("{i}{f}").parse().map_err(|_| self.trouble("number"))?;
            let d = 10i64.checked_pow(f.len() as u32).ok_or_else(|| self.trouble("number"))?;
            self.at += digits;
            return Ok(Expr::ratio(n, d));
        }
        let letters = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        let word = &rest[..letters];
        if let Some(f) = crate::expr::Function::ALL.iter().find(|f| f.name() == word) {
            self.at += letters;
            let a = self.atom()?;
            return Ok(match word {
                "sin" => a.sin(),
                "cos" => a.cos(),
                "tan" => a.tan(),
                _ => Expr::call(*f, a),
            });
        }
        if word == "sqrt" {
            self.at += letters;
            return Ok(self.atom()?.sqrt());
        }
        if word == "pi" || self.names.contains(&word) {
            self.at += letters;
            return Ok(Expr::symbol(word));
        }
        Err(Trouble {
            start: self.at,
            end: self.at + letters,
            message: format!("unknown symbol `{word}`"),
            hint: nearest(word, self.names.iter().copied()).map(|n| format!("did you mean `{n}`?")),
        })
    }
}
