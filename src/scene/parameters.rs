//! The symbols of a scene: unit, domain and value of each parameter.
//!
//! Values and ends of domains are kept in SI units, so that whoever puts them into formulas need not convert.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::FRAC_PI_2;

use super::claim::{Claim, Claimed};
use super::contact_file::ContactFile;
use super::fault::{Fault, Span, number_words};
use super::file::{DomainFile, DomainName, IntervalFile, ParameterFile, SceneFile};
use super::formulas::Symbols;
use super::record::{Formula, Text};
use super::{Parameter, Scene, relations};
use crate::dimension::{self, Unit};
use crate::domain::{Domain, Limit};
use crate::expr::angle::angle;
use crate::expr::{Expr, Function, Node, Point, Rational, ratio};
use crate::formula::{self, Content};

/// Most parameters a scene may have.
const PARAMETERS: usize = 1000;

/// Reads the parameters into the scene; gives the symbols formulas may use.
pub(super) fn resolve(
    file: &SceneFile,
    scene: &mut Scene,
    claims: &mut Vec<Claimed>,
    faults: &mut Vec<Fault>,
) -> Symbols {
    let all: &[(Text, Option<ParameterFile>)] = file.parameters.as_ref().map_or(&[], |m| &m.0);
    if let Some((name, _)) = all.get(PARAMETERS) {
        let message = format!("{} parameters, more than {PARAMETERS}", all.len());
        faults.push(Fault::new(name.span, message));
        return Symbols::new(BTreeMap::new());
    }
    let mut spellings: BTreeMap<String, &str> = BTreeMap::new();
    let mut dimensions = BTreeMap::new();
    let mut units = Vec::new();
    for (name, entry) in all {
        check_name(name, faults);
        if let Some(other) = spellings.insert(spelling(&name.text), &name.text) {
            let message = format!("`{}` and `{other}` are one symbol in formulas", name.text);
            faults.push(Fault::new(name.span, message));
        }
        // One that could not be read is told by itself: of what dimension it would be is open.
        let unit = entry.as_ref().and_then(|p| match &p.unit {
            None => dimension::unit(&unit_beside(p)).ok(),
            Some(text) => read_unit(text, faults),
        });
        let dimension = unit.as_ref().map(|u| u.dimension.clone());
        dimensions.insert(name.text.as_str().into(), dimension);
        units.push(unit);
    }
    let mut symbols = Symbols::new(dimensions);
    for (name, entry) in all {
        let unit = entry.as_ref().and_then(|p| p.unit.as_ref());
        if let Some(unit) = unit.filter(|unit| unit.text.trim() != "1") {
            symbols.declare_unit(&name.text, unit);
        }
    }
    let mut ends = Vec::new();
    for ((name, entry), unit) in all.iter().zip(units) {
        if let (Some(entry), Some(unit)) = (entry, unit) {
            let read = parameter(file, scene, &symbols, (name, entry), &unit, faults);
            ends.extend(read);
        }
    }
    for end in ends {
        let sides = [&end.small, &end.large];
        relations::add(scene, sides, end.closed, end.words, end.span, faults);
    }
    let stated = file.relations.as_deref().unwrap_or_default();
    relations::resolve(stated, scene, &symbols, faults);
    scene.remarks.extend(relations::without_points(scene));
    unit_vectors(file, scene, &symbols, claims, faults);
    symbols
}

/// Reads one parameter into the scene; gives the ends of its domain that refer to other parameters.
fn parameter(
    file: &SceneFile,
    scene: &mut Scene,
    symbols: &Symbols,
    (name, entry): (&Text, &ParameterFile),
    unit: &Unit,
    faults: &mut Vec<Fault>,
) -> Vec<End> {
    let text = |t: &Option<Text>| t.as_ref().map(|t| t.text.clone());
    let parameter = Parameter {
        name: name.text.as_str().into(),
        latex: text(&entry.latex),
        unit: text(&entry.unit).unwrap_or_else(|| unit_beside(entry)),
        dimension: unit.dimension.clone(),
        value: entry.value.as_ref().and_then(|v| value(v, unit, faults)),
        meaning: text(&entry.meaning).unwrap_or_default(),
    };
    let mut ends = Vec::new();
    let domain = match &entry.domain {
        Some(DomainFile::Named(DomainName::Positive)) => Some(Domain::positive()),
        Some(DomainFile::Named(DomainName::Nonnegative)) => Some(Domain::nonnegative()),
        Some(DomainFile::Named(DomainName::Real)) => Some(Domain::real()),
        Some(DomainFile::Interval(interval)) => {
            let of = Bounded {
                name,
                unit,
                symbols,
            };
            of.domain(interval, &mut ends, faults)
        }
        None if is_restitution(file, &name.text) => Some(Domain::between(ratio(0, 1), ratio(1, 1))),
        None if is_tangential(file, &name.text) || is_component(file, &name.text) => {
            Some(Domain::between(ratio(-1, 1), ratio(1, 1)))
        }
        None if unit.angle && unit.dimension.is_none() => {
            Some(parameter.value.as_ref().map_or(Domain::real(), quarter))
        }
        None => Some(Domain::positive()),
    };
    let Some(domain) = domain else { return ends };
    if let (Some(value), Some(formula)) = (&parameter.value, &entry.value)
        && let Err(message) = lies_in(&name.text, value, &domain)
    {
        faults.push(Fault::new(formula.span, message).hint("change the value, or its `domain`"));
    }
    scene.domains.symbols.insert(parameter.name.clone(), domain);
    scene.parameters.push(parameter);
    ends
}

/// The unit that a value is written with, where the parameter has none of its own: `"value": "15 ft"`.
fn unit_beside(entry: &ParameterFile) -> String {
    let value = entry.value.as_ref();
    let read = value.and_then(|v| formula::read(&v.text, &formula::Symbols::strict()).ok());
    let in_degrees = |v: &Formula| {
        let text = v.text.trim_end();
        ["°", "deg", "degrees"].iter().any(|m| text.ends_with(m))
    };
    match read.map(|reading| reading.content) {
        Some(Content::Quantity(q)) => q.unit_text,
        // `30°` is read as π/6, and is an angle all the same.
        Some(_) if value.is_some_and(in_degrees) => String::from("deg"),
        _ => String::from("1"),
    }
}

/// The quarter turn inside of which a given angle lies; any angle where it lies at an end of one.
fn quarter(angle: &Expr) -> Domain {
    let quarters = angle.evaluate::<f64>(&Point::default()).unwrap_or(0.0) / FRAC_PI_2;
    let beyond = (quarters - quarters.round()).abs();
    if !(1e-9..=1.0).contains(&beyond) || quarters.abs() > 4.0 {
        return Domain::real();
    }
    let first = quarters.floor() as i64;
    Domain::angle(ratio(first, 2), ratio(first + 1, 2))
}

/// The value of a quantity as a person writes it, in the parameter's unit or one beside it, brought to SI units.
pub(super) fn value(formula: &Formula, unit: &Unit, faults: &mut Vec<Fault>) -> Option<Expr> {
    let before = faults.len();
    let value = Symbols::new(BTreeMap::new()).measured(formula, unit, faults);
    for fault in &mut faults[before..] {
        let hint = "a value is a number, or a formula without symbols; its unit stands behind the whole of it";
        fault.hint.get_or_insert_with(|| hint.to_owned());
    }
    let value = value?;
    let number = value.evaluate::<f64>(&Point::default());
    if !number.is_some_and(f64::is_finite) {
        return Fault::new(formula.span, "this has no finite value").add_to(faults);
    }
    Some(value)
}

/// Whether a value lies in the domain of its parameter; otherwise what is wrong.
pub(super) fn lies_in(name: &str, value: &Expr, domain: &Domain) -> Result<(), String> {
    let number = value.evaluate::<f64>(&Point::default()).unwrap_or(f64::NAN);
    let compare = |limit: &Limit| {
        let exact = match limit.of_pi {
            true => multiple_of_pi(value),
            false => value.as_number().cloned(),
        };
        match exact {
            Some(exact) => Some(exact.cmp(&limit.value)),
            // A fraction against a multiple of pi, or a value like acos(3/5): never nearer than doubles can tell apart.
            None => number.partial_cmp(&limit.approximate()),
        }
    };
    let is_fine = |limit: &Option<Limit>, inside: Ordering| {
        limit.as_ref().is_none_or(|l| {
            compare(l).is_some_and(|order| order == inside || order.is_eq() && !l.open)
        })
    };
    if is_fine(&domain.low, Ordering::Greater) && is_fine(&domain.high, Ordering::Less) {
        return Ok(());
    }
    let (number, domain) = (number_words(number), domain.words(name));
    Err(format!("{name} is {number}, outside its domain {domain}"))
}

fn multiple_of_pi(e: &Expr) -> Option<Rational> {
    let read = angle(e)?;
    read.symbols.is_empty().then_some(read.pi)
}

fn check_name(name: &Text, faults: &mut Vec<Fault>) {
    let text = name.text.as_str();
    let is_letter = |c: char| {
        c.is_ascii_alphabetic() || ('α'..='ω').contains(&c) || ('Α'..='Ω').contains(&c) || c == 'ℓ'
    };
    let mut letters = text.chars();
    let is_identifier = letters.next().is_some_and(is_letter)
        && letters.all(|c| is_letter(c) || c.is_ascii_digit() || c == '_');
    let is_function = Function::ALL.iter().any(|f| f.name() == text);
    // `π2` is twice π.
    let is_pi = text == "pi" || text.starts_with('π');
    let (what, hint) = if is_function || is_pi || text == "sqrt" {
        ("has a meaning in formulas already", "choose another name")
    } else if !is_identifier || text.len() > 60 {
        let hint = "a symbol is a letter followed by letters, digits and _, such as m1, v_G or theta; `latex` says how it looks";
        ("cannot be a symbol", hint)
    } else {
        return;
    };
    faults.push(Fault::new(name.span, format!("`{text}` {what}")).hint(hint));
}

/// `v_1` and `v1` are one symbol.
pub(super) fn spelling(name: &str) -> String {
    let mut out = String::new();
    let mut letters = name.chars().peekable();
    while let Some(c) = letters.next() {
        if c != '_' || !letters.peek().is_some_and(char::is_ascii_digit) {
            out.push(c);
        }
    }
    out
}

fn read_unit(text: &Text, faults: &mut Vec<Fault>) -> Option<Unit> {
    let found = dimension::unit(&text.text);
    let refused = found.map_err(|trouble| Fault::new(text.span, trouble.message));
    refused.map_err(|fault| faults.push(fault)).ok()
}

/// An end of a domain that refers to other parameters, as an inequality.
struct End {
    small: Expr,
    large: Expr,
    closed: bool,
    words: String,
    span: Span,
}

/// A parameter whose domain is an interval.
struct Bounded<'a> {
    name: &'a Text,
    unit: &'a Unit,
    symbols: &'a Symbols,
}

impl Bounded<'_> {
    /// Its domain as far as its ends are numbers; the others go to `ends`.
    fn domain(
        &self,
        interval: &IntervalFile,
        ends: &mut Vec<End>,
        faults: &mut Vec<Fault>,
    ) -> Option<Domain> {
        let mut end = |formula: &Option<Formula>, open: Option<bool>, is_low: bool| match formula {
            None => Some(None),
            Some(formula) => self.end(formula, open == Some(true), is_low, ends, faults),
        };
        let low = end(&interval.min, interval.min_open, true);
        let high = end(&interval.max, interval.max_open, false);
        let (low, high) = (low?, high?);
        if let (Some(low), Some(high)) = (&low, &high) {
            let order = if low.of_pi == high.of_pi {
                Some(low.value.cmp(&high.value))
            } else {
                low.approximate().partial_cmp(&high.approximate())
            };
            if order != Some(Ordering::Less) {
                let fault = Fault::new(interval.span, "`min` is not below `max`");
                let hint =
                    "a quantity with one possible value is a number: write it into the formulas";
                return fault.hint(hint).add_to(faults);
            }
        }
        Some(Domain { low, high })
    }

    fn end(
        &self,
        formula: &Formula,
        open: bool,
        is_low: bool,
        ends: &mut Vec<End>,
        faults: &mut Vec<Fault>,
    ) -> Option<Option<Limit>> {
        let e = self.symbols.expression(formula, faults)?;
        if e.symbols().iter().any(|name| &**name != "pi") {
            return self.by_others(formula, e, open, is_low, ends, faults);
        }
        let e = value(formula, self.unit, faults)?;
        if let Some(number) = e.as_number() {
            return Some(Some(Limit::number(number.clone(), open)));
        }
        if let Some(multiple) = multiple_of_pi(&e) {
            return Some(Some(Limit::pi(multiple, open)));
        }
        let fault = Fault::new(
            formula.span,
            "an end of a domain is a fraction, a fraction of pi or a formula of parameters",
        );
        faults.push(fault.hint("such as 3/2, 0.25, pi/4 or acos(b/a)"));
        None
    }

    /// An end that refers to other parameters; of an inverse function the range bounds the angle too.
    fn by_others(
        &self,
        formula: &Formula,
        e: Expr,
        open: bool,
        is_low: bool,
        ends: &mut Vec<End>,
        faults: &mut Vec<Fault>,
    ) -> Option<Option<Limit>> {
        for name in e.symbols() {
            self.symbols.mark_used(&name);
        }
        let own = Expr::symbol(&self.name.text);
        if let Some(message) = self
            .symbols
            .clash(&Content::Scalar(own.clone()), &Content::Scalar(e.clone()))
        {
            return Fault::new(formula.span, message).add_to(faults);
        }
        let sign = if open { "<" } else { "≤" };
        let (small, large) = if is_low { (&e, &own) } else { (&own, &e) };
        let plain = crate::formula::write_plain;
        ends.push(End {
            words: format!("{} {sign} {}", plain(small), plain(large)),
            small: small.clone(),
            large: large.clone(),
            closed: !open,
            span: formula.span,
        });
        let [low, high] = match e.node() {
            Node::Call(Function::Acos, _) => [ratio(0, 1), ratio(1, 1)],
            Node::Call(Function::Asin | Function::Atan, _) => [ratio(-1, 2), ratio(1, 2)],
            _ => return Some(None),
        };
        Some(Some(Limit::pi(if is_low { low } else { high }, false)))
    }
}

/// The contacts of a scene and of the impacts of its stages.
fn contacts(file: &SceneFile) -> impl Iterator<Item = &ContactFile> {
    let stages = file.stages.iter().flatten();
    let impacts = stages.filter_map(|s| s.impact.as_ref()?.contacts.as_ref());
    let maps = file.contacts.iter().chain(impacts);
    maps.flat_map(|m| &m.0).filter_map(|(_, c)| c.as_ref())
}

/// Whether a contact uses this name, as it is, for its restitution.
fn is_restitution(file: &SceneFile, name: &str) -> bool {
    let mut given = contacts(file).filter_map(|c| c.restitution.as_ref());
    given.any(|e| e.text.trim() == name)
}

/// Whether a contact uses this name, as it is, for its tangential restitution.
fn is_tangential(file: &SceneFile, name: &str) -> bool {
    let mut given = contacts(file).filter_map(|c| c.tangential_restitution.as_ref());
    given.any(|e| e.text.trim() == name)
}

fn is_component(file: &SceneFile, name: &str) -> bool {
    let mut pairs = file.unit_vectors.iter().flatten();
    pairs.any(|pair| pair.items.iter().any(|c| c.text == name))
}

fn unit_vectors(
    file: &SceneFile,
    scene: &mut Scene,
    symbols: &Symbols,
    claims: &mut Vec<Claimed>,
    faults: &mut Vec<Fault>,
) {
    let mut seen = BTreeSet::new();
    for pair in file.unit_vectors.iter().flatten() {
        let mut is_fine = true;
        for name in &pair.items {
            let Some(parameter) = scene.parameter(&name.text) else {
                is_fine = false;
                let mut all = file.parameters.iter().flat_map(|m| &m.0);
                if !all.any(|(n, _)| n.text == name.text) {
                    let fault = Fault::new(name.span, format!("`{}` is no parameter", name.text));
                    faults.push(fault.hint("declare both components under \"parameters\""));
                }
                continue;
            };
            if !parameter.dimension.is_none() {
                is_fine = false;
                let none = dimension::Dimension::none();
                let message = format!("expected {none}, found {}", parameter.dimension);
                let hint = "the components of a unit vector have no unit";
                faults.push(Fault::new(name.span, message).hint(hint));
            }
            if !seen.insert(name.text.as_str()) {
                is_fine = false;
                let message = format!("`{}` is a component already", name.text);
                faults.push(Fault::new(name.span, message));
            }
        }
        if !is_fine {
            continue;
        }
        let names = [0, 1].map(|i| pair.items[i].text.as_str().into());
        let values: Vec<Expr> = scene
            .parameters
            .iter()
            .filter(|p| names.contains(&p.name))
            .filter_map(|p| p.value.clone())
            .collect();
        if let [a, b] = values.as_slice() {
            claims.push(Claimed {
                span: pair.span,
                claim: Claim::Unit([a.clone(), b.clone()]),
            });
        }
        names.iter().for_each(|n| symbols.mark_used(n));
        scene.domains.unit_vectors.push(names);
    }
}

/// The place of a whole text, for values that come from outside a file.
pub(super) fn whole(text: &str) -> Formula {
    Formula {
        span: Span::new(0, text.len()),
        text: text.to_owned(),
        start: Some(0),
    }
}
