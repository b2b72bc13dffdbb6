//! Formulas of a scene: read with the scene's symbols, and held to the dimension their field has.
//!
//! In: the text of a formula and what is expected of it. Out: an expression, or a fault that points into the formula.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};

use super::fault::{Fault, Span};
use super::record::{Formula, Pair, Text};
use crate::dimension::{self, Dimension, Unit};
use crate::expr::number::to_f64;
use crate::expr::{Expr, Node, Symbol, Vector};
use crate::formula::{self, Content, Relation};

/// What a field holds: its name, dimension and a remark that helps when the dimension is wrong.
#[derive(Clone, Copy)]
pub(super) struct Quantity {
    /// Exponents of mass, length and time.
    exponents: [i64; 3],
    /// How such a quantity is made.
    hint: &'static str,
}

impl Quantity {
    pub const NUMBER: Quantity =
        Quantity::other([0, 0, 0], "divide by a quantity of the same kind");
    pub const TIME: Quantity = Quantity::other([0, 0, 1], "a time, or a part of one");
    pub const STIFFNESS: Quantity =
        Quantity::other([1, 0, -2], "a stiffness is a force by a length");
    pub const ANGLE: Quantity =
        Quantity::other([0, 0, 0], "an angle is in radians, or pi/180 times degrees");
    pub const DIRECTION: Quantity = Quantity::other(
        [0, 0, 0],
        "a direction has components without unit, such as [\"cos(theta)\", \"sin(theta)\"]",
    );
    pub const MASS: Quantity = Quantity::other([1, 0, 0], "a mass, or a multiple of one");
    pub const LENGTH: Quantity = Quantity::other([0, 1, 0], "a length, or a part of one");
    pub const VELOCITY: Quantity = Quantity::other(
        [0, 1, -1],
        "a velocity, or an angular velocity times a length",
    );
    pub const SPIN: Quantity = Quantity::other(
        [0, 0, -1],
        "a spin is an angle per time: a speed divided by a distance",
    );
    pub const INERTIA: Quantity = Quantity::other(
        [1, 2, 0],
        "a moment of inertia is a mass times the square of a length: of a uniform rod a twelfth of that of its length",
    );
    pub const IMPULSE: Quantity =
        Quantity::other([1, 1, -1], "an impulse is a mass times a velocity");

    /// A quantity by its exponents of mass, length and time.
    pub const fn other(exponents: [i64; 3], hint: &'static str) -> Quantity {
        Quantity { exponents, hint }
    }

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
    names: formula::Symbols,
    dimensions: BTreeMap<Symbol, Option<Dimension>>,
    /// The unit that a symbol is declared with, and where.
    declared: BTreeMap<Symbol, (String, Span)>,
    used: RefCell<BTreeSet<Symbol>>,
    remarks: RefCell<Vec<String>>,
    units: RefCell<Vec<String>>,
    plain: Cell<bool>,
}

impl Symbols {
    /// Symbols with their dimension, if their unit could be read; no others may occur.
    pub fn new(dimensions: BTreeMap<Symbol, Option<Dimension>>) -> Symbols {
        let mut names = formula::Symbols::strict();
        for (name, dimension) in &dimensions {
            names.declare_as(name.clone(), None, dimension.clone());
        }
        Symbols {
            names,
            dimensions,
            declared: BTreeMap::new(),
            used: RefCell::default(),
            remarks: RefCell::default(),
            units: RefCell::default(),
            plain: Cell::default(),
        }
    }

    /// The same symbols and some more, of unknown dimension; what they use is counted apart.
    pub fn extended(&self, names: &[String]) -> Symbols {
        let mut out = Symbols {
            names: self.names.clone(),
            dimensions: self.dimensions.clone(),
            declared: self.declared.clone(),
            used: RefCell::default(),
            remarks: RefCell::default(),
            units: RefCell::default(),
            plain: Cell::default(),
        };
        names.iter().for_each(|name| out.add(name, &[""]));
        out
    }

    /// Takes in a name of this dimension, where it is known.
    pub fn add_as(&mut self, name: &str, dimension: Option<Dimension>) {
        let symbol = Symbol::from(name);
        self.names
            .declare_as(symbol.clone(), None, dimension.clone());
        self.dimensions.insert(symbol, dimension);
    }

    /// Notes the unit that a symbol is declared with.
    pub fn declare_unit(&mut self, name: &str, unit: &Text) {
        let unit = (unit.text.clone(), unit.span);
        self.declared.insert(Symbol::from(name), unit);
    }

    /// Takes over what other symbols have used and what is to be told of them.
    pub fn absorb(&mut self, other: &Symbols) {
        self.used.borrow_mut().extend(other.used());
        self.remarks.borrow_mut().extend(other.remarks());
        self.units.borrow_mut().extend(other.units());
        self.plain
            .set(self.plain.get() || other.has_plain_numbers());
    }

    /// Takes in a name with each of these endings, of unknown dimension.
    pub fn add(&mut self, name: &str, endings: &[&str]) {
        for ending in endings {
            let name = format!("{name}{ending}");
            self.names.declare(&name);
            self.dimensions.insert(Symbol::from(name), None);
        }
    }

    /// The symbols used so far.
    pub fn used(&self) -> Vec<Symbol> {
        self.used.borrow().iter().cloned().collect()
    }

    /// The names formulas may use, for readings that are no single expression.
    pub fn names(&self) -> &formula::Symbols {
        &self.names
    }

    /// What is to be told of formulas that can be read in two ways.
    pub fn remarks(&self) -> Vec<String> {
        self.remarks.borrow().clone()
    }

    /// Units that stood beside numbers.
    pub fn units(&self) -> Vec<String> {
        self.units.borrow().clone()
    }

    /// Whether something that has a unit was a plain number, in which its dimension can no longer be told.
    pub fn has_plain_numbers(&self) -> bool {
        self.plain.get()
    }

    /// Whether a formula read so far uses the symbol.
    pub fn is_used(&self, name: &str) -> bool {
        self.used.borrow().contains(name)
    }

    /// Counts a symbol as used.
    pub fn mark_used(&self, name: &str) {
        self.used.borrow_mut().insert(name.into());
    }

    /// Reads a formula of the given dimension. A formula without symbols is a number in SI units, whatever the field, or has
    /// its unit beside it: `500 g`.
    pub fn read(
        &self,
        formula: &Formula,
        quantity: Quantity,
        faults: &mut Vec<Fault>,
    ) -> Option<Expr> {
        let e = match self.content(formula, faults)? {
            Content::Quantity(q) => in_si(*q, &quantity.dimension(), formula)
                .map_err(|fault| faults.push(fault))
                .ok()?,
            content => scalar(content, formula, faults)?,
        };
        let symbols = e.symbols();
        let is_number = symbols.is_empty();
        let is_known = |name: &Symbol| self.dimensions.get(name).is_some_and(Option::is_some);
        let is_open = !symbols.iter().all(is_known);
        self.used.borrow_mut().extend(symbols);
        if is_number && !e.is_zero() && quantity.dimension() != Dimension::none() {
            self.plain.set(true);
        }
        if is_number || is_open {
            return Some(e);
        }
        match dimension::of(&e, &|name| self.dimensions.get(name).cloned().flatten()) {
            Err(clash) => {
                let message = clash.message(&formula::write_plain);
                faults.push(self.with_units(&e, Fault::new(formula.span, message)));
                None
            }
            Ok(Some(found)) if found != quantity.dimension() => {
                let message = format!("expected {}, found {found}", quantity.dimension());
                let fault = self.with_units(&e, Fault::new(formula.span, message));
                let of_its_names = named_like_its_unit(&formula.text, quantity)
                    .or_else(|| self.without_unit(&e, &found, quantity))
                    .or_else(|| pound_for_weight(&found, quantity));
                faults.push(match of_its_names {
                    Some(hint) => fault.hint(hint),
                    None if quantity.dimension().is_none() => fault.hint(quantity.hint),
                    None => {
                        let unit = quantity.dimension().spoken();
                        fault.hint(format!("{}; its unit is one such as {unit}", quantity.hint))
                    }
                });
                None
            }
            Ok(_) => Some(e),
        }
    }

    /// The fault of a formula whose dimension is wrong, with the units its symbols are declared with, of which one may be.
    fn with_units(&self, e: &Expr, mut fault: Fault) -> Fault {
        let symbols = e.symbols();
        let declared = |name| Some((name, self.declared.get(name)?));
        let units: Vec<_> = symbols.iter().filter_map(declared).collect();
        match units.as_slice() {
            [] => {}
            [(name, (unit, at))] if symbols.len() == 1 => {
                fault.message += &format!(": `{name}` is declared with the unit {unit}");
                fault.declared = Some(at.start);
            }
            all => {
                let all = all
                    .iter()
                    .map(|(name, (unit, _))| format!("`{name}` is in {unit}"));
                fault.message += &format!(": {}", all.collect::<Vec<_>>().join(", "));
            }
        }
        fault
    }

    /// What to say of a parameter alone that should have had a unit.
    fn without_unit(&self, e: &Expr, found: &Dimension, quantity: Quantity) -> Option<String> {
        let name = e.as_symbol().filter(|_| found.is_none())?;
        let unit = quantity.dimension().spoken();
        let hint =
            format!("`{name}` has no unit: declare it as \"{name}\": {{\"unit\": \"{unit}\"}}");
        (!self.declared.contains_key(name)).then_some(hint)
    }

    /// Reads both components of a vector.
    pub fn vector(
        &self,
        pair: &Pair<Formula>,
        quantity: Quantity,
        faults: &mut Vec<Fault>,
    ) -> Option<Vector> {
        let [x, y] = &pair.items;
        let (x, y) = (
            self.read(x, quantity, faults),
            self.read(y, quantity, faults),
        );
        Some([x?, y?])
    }

    /// Reads inequalities or equations, one or a chain: the formulas, and quantities, and what stands between them. Their
    /// dimensions are not looked at.
    pub fn relations(
        &self,
        text: &Text,
        faults: &mut Vec<Fault>,
    ) -> Option<(Vec<Content>, Vec<Relation>)> {
        let reading = match formula::read(&text.text, &self.names) {
            Ok(reading) => reading,
            Err(trouble) => {
                let mut fault = Fault::new(text.span, &trouble.message);
                fault.hint = trouble.hint.clone();
                return fault.add_to(faults);
            }
        };
        for name in reading.symbols() {
            self.mark_used(&name);
        }
        let Content::Relations(sides, relations) = &reading.content else {
            return Some((Vec::new(), Vec::new()));
        };
        let sides = match sides.iter().all(|side| side.expr().is_some()) {
            true => sides.clone(),
            false => Vec::new(),
        };
        Some((sides, relations.clone()))
    }

    /// What is wrong with comparing two formulas: their dimensions, or one within them.
    pub fn clash(&self, a: &Content, b: &Content) -> Option<String> {
        let known = |name: &str| self.dimensions.get(name).cloned().flatten();
        let of = |content: &Content| match (content, content.expr()) {
            (Content::Quantity(q), _) => Ok(Some(q.unit.dimension.clone())),
            (_, Some(e)) => dimension::of(e, &known).map_err(|c| c.message(&formula::write_plain)),
            (_, None) => Ok(None),
        };
        match (of(a), of(b)) {
            (Err(message), _) | (_, Err(message)) => Some(message),
            (Ok(Some(a)), Ok(Some(b))) if a != b => Some(format!("{a} is compared with {b}")),
            _ => None,
        }
    }

    /// Reads a formula without regard to its dimension.
    pub fn expression(&self, formula: &Formula, faults: &mut Vec<Fault>) -> Option<Expr> {
        scalar(self.content(formula, faults)?, formula, faults)
    }

    /// Reads what is put in for a parameter: a formula, or a number in a unit of its dimension.
    pub fn in_place_of(
        &self,
        parameter: &Symbol,
        formula: &Formula,
        faults: &mut Vec<Fault>,
    ) -> Option<Expr> {
        let dimension = self.dimensions.get(parameter).cloned().flatten();
        let unit = Unit::coherent(dimension.unwrap_or_else(Dimension::none));
        self.measured(formula, &unit, faults)
    }

    /// Reads a number in a unit, or in the one beside it; its value in SI units.
    pub fn measured(
        &self,
        formula: &Formula,
        unit: &Unit,
        faults: &mut Vec<Fault>,
    ) -> Option<Expr> {
        match self.content(formula, faults)? {
            Content::Quantity(q) => in_si(*q, &unit.dimension, formula)
                .map_err(|fault| faults.push(fault))
                .ok(),
            content => {
                let e = scalar(content, formula, faults)?;
                // `30°` is read as π/6, and nobody counts degrees in multiples of π; acos(3/5) is an angle in radians.
                let is_angle = unit.angle && unit.dimension == Dimension::none();
                let is_arc = |part: &Expr| match part.node() {
                    Node::Call(function, _) => function.is_arc(),
                    _ => *part == Expr::pi(),
                };
                let in_radians = is_angle && e.parts().any(is_arc);
                Some(if in_radians { e } else { e * unit.value() })
            }
        }
    }

    fn content(&self, formula: &Formula, faults: &mut Vec<Fault>) -> Option<Content> {
        let reading = match formula::read(&formula.text, &self.names) {
            Ok(reading) => reading,
            Err(trouble) => {
                for part in std::iter::once(&trouble).chain(&trouble.also) {
                    let span = formula
                        .start
                        .map_or(formula.span, |at| Span::new(at + part.start, at + part.end));
                    let mut fault = Fault::new(span, &part.message);
                    fault.hint = part.hint.clone();
                    faults.push(fault);
                }
                return None;
            }
        };
        let content = reading.content;
        if let Content::Quantity(q) = &content {
            self.units.borrow_mut().push(q.unit_text.clone());
        }
        let e = content.expr();
        if let Some(e) = e.filter(|_| reading.choices > 0) {
            let remark = format!("`{}` is read as {}", formula.text, formula::write_plain(e));
            self.remarks.borrow_mut().push(remark);
        }
        if e.is_some_and(|e| !is_finite(e)) {
            return Fault::new(formula.span, "a number here is too large")
                .hint("numbers go up to about 1e308")
                .add_to(faults);
        }
        Some(content)
    }
}

/// The value of what was written with its unit.
fn in_si(q: formula::Quantity, dimension: &Dimension, at: &Formula) -> Result<Expr, Fault> {
    match q.unit.dimension == *dimension && !q.unit.cycles {
        true => Ok(q.value),
        false => {
            let found = match q.unit.dimension == *dimension {
                true => String::from("cycles per time"),
                false => q.unit.dimension.to_string(),
            };
            let message = format!("expected {dimension}, found {found} ({})", q.unit_text);
            let hint = match dimension.is_none() {
                true => String::from("this has no unit"),
                false => format!("its unit is one such as {}", dimension.spoken()),
            };
            Err(Fault::new(at.span, message).hint(hint))
        }
    }
}

/// The expression that was read.
fn scalar(content: Content, formula: &Formula, faults: &mut Vec<Fault>) -> Option<Expr> {
    match content {
        Content::Scalar(e) => Some(e),
        _ => Fault::new(formula.span, "a single expression is expected here").add_to(faults),
    }
}

/// Whether every number in the expression is within the range of doubles.
fn is_finite(e: &Expr) -> bool {
    let mut numbers = e.parts().filter_map(Expr::as_number);
    numbers.all(|value| to_f64(value).is_finite())
}

/// What to say of a mass divided by g where a mass is asked for: the pound of a weight has another name.
fn pound_for_weight(found: &Dimension, quantity: Quantity) -> Option<String> {
    let acceleration = Dimension::new(0, 1, -2);
    let is_divided = found.times(&acceleration) == quantity.dimension();
    let hint = "a pound `lb` is a mass here; of a weight W the mass is W/g, with W in `lbf`";
    (is_divided && quantity.dimension() == Quantity::MASS.dimension()).then(|| hint.to_owned())
}

/// What to write for a number with a unit that is also the name of a parameter: `3 m` where m is a mass.
fn named_like_its_unit(text: &str, quantity: Quantity) -> Option<String> {
    let text = text.trim();
    let unit =
        text.trim_start_matches(|c: char| c.is_ascii_digit() || matches!(c, '.' | ' ' | '-'));
    let number = text.strip_suffix(unit).map(str::trim)?;
    let meant = dimension::unit(unit).ok()?;
    if meant.dimension != quantity.dimension() || number.is_empty() {
        return None;
    }
    let one = formula::write_plain(&meant.value());
    let alone = match (one.as_str(), one.strip_prefix("1/")) {
        ("1", _) => number.to_owned(),
        (_, Some(below)) => format!("{number}/{below}"),
        _ => format!("{number}*{one}"),
    };
    Some(format!(
        "`{unit}` is a parameter here: write {alone} alone, which is in SI units"
    ))
}
