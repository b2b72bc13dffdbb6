//! The symbols of a scene: unit, domain and value of each parameter.
//!
//! Values and ends of domains are kept in SI units, so that whoever puts them into formulas need not convert.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

use super::check::{Claim, Claimed};
use super::fault::{Fault, Span};
use super::file::{DomainFile, DomainName, IntervalFile, ParameterFile, SceneFile};
use super::formulas::Symbols;
use super::record::{Formula, Text};
use super::{Parameter, Scene};
use crate::dimension::{self, Unit};
use crate::domain::{Domain, Limit};
use crate::expr::angle::angle;
use crate::expr::{Expr, Function, Point, Rational, ratio};

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
        faults.push(Fault::new(
            name.span,
            format!("{} parameters, more than {PARAMETERS}", all.len()),
        ));
        return Symbols::new(BTreeMap::new());
    }
    let mut spellings: BTreeMap<String, &str> = BTreeMap::new();
    let mut symbols = BTreeMap::new();
    for (name, entry) in all {
        check_name(name, faults);
        if let Some(other) = spellings.insert(spelling(&name.text), &name.text) {
            faults.push(Fault::new(
                name.span,
                format!("`{}` and `{other}` are one symbol in formulas", name.text),
            ));
        }
        let unit = match entry.as_ref().and_then(|p| p.unit.as_ref()) {
            None => dimension::unit("1").ok(),
            Some(text) => read_unit(text, faults),
        };
        let dimension = unit.as_ref().map(|u| u.dimension.clone());
        symbols.insert(name.text.as_str().into(), dimension.clone());
        let (Some(entry), Some(unit)) = (entry, unit) else {
            continue;
        };
        let parameter = Parameter {
            name: name.text.as_str().into(),
            latex: entry.latex.as_ref().map(|t| t.text.clone()),
            unit: entry
                .unit
                .as_ref()
                .map_or_else(|| "1".to_owned(), |t| t.text.clone()),
            dimension: dimension.unwrap_or_default(),
            value: entry.value.as_ref().and_then(|v| value(v, &unit, faults)),
            meaning: entry
                .meaning
                .as_ref()
                .map(|t| t.text.clone())
                .unwrap_or_default(),
        };
        let domain = match &entry.domain {
            Some(written) => domain(written, &unit, faults),
            None if is_restitution(file, &name.text) => {
                Some(Domain::between(ratio(0, 1), ratio(1, 1)))
            }
            None if is_tangential(file, &name.text) || is_component(file, &name.text) => {
                Some(Domain::between(ratio(-1, 1), ratio(1, 1)))
            }
            None if unit.angle && unit.dimension.is_none() => Some(Domain::real()),
            None => Some(Domain::positive()),
        };
        let Some(domain) = domain else { continue };
        if let (Some(value), Some(formula)) = (&parameter.value, &entry.value)
            && let Err(message) = lies_in(&name.text, value, &domain)
        {
            faults
                .push(Fault::new(formula.span, message).hint("change the value, or its `domain`"));
        }
        scene.domains.symbols.insert(parameter.name.clone(), domain);
        scene.parameters.push(parameter);
    }
    let symbols = Symbols::new(symbols);
    unit_vectors(file, scene, &symbols, claims, faults);
    symbols
}

/// The value of a quantity as a person writes it, in the parameter's unit, brought to SI units.
pub(super) fn value(formula: &Formula, unit: &Unit, faults: &mut Vec<Fault>) -> Option<Expr> {
    let before = faults.len();
    let e = Symbols::new(BTreeMap::new()).expression(formula, faults);
    for fault in &mut faults[before..] {
        fault
            .hint
            .get_or_insert_with(|| "a value is a number, or a formula without symbols".to_owned());
    }
    let e = e?;
    let value = e * unit.value();
    if !value
        .evaluate::<f64>(&Point::default())
        .is_some_and(f64::is_finite)
    {
        faults.push(Fault::new(formula.span, "this has no finite value"));
        return None;
    }
    Some(value)
}

/// Whether a value lies in the domain of its parameter; otherwise what is wrong.
pub(super) fn lies_in(name: &str, value: &Expr, domain: &Domain) -> Result<(), String> {
    let number = value.evaluate::<f64>(&Point::default()).unwrap_or(f64::NAN);
    let compare = |limit: &Limit| {
        let exact = if limit.of_pi {
            multiple_of_pi(value)
        } else {
            value.as_number().cloned()
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
    Err(format!(
        "{name} is {}, outside its domain {}",
        number_words(number),
        domain.words(name)
    ))
}

/// A double as people write it.
pub(super) fn number_words(number: f64) -> String {
    if number != 0.0 && !(1e-4..1e6).contains(&number.abs()) {
        return format!("{number:e}");
    }
    let rounded = format!("{number:.6}");
    rounded
        .trim_end_matches('0')
        .trim_end_matches('.')
        .to_owned()
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
    let is_word = text == "pi"
        || text == "π"
        || text == "sqrt"
        || Function::ALL.iter().any(|f| f.name() == text);
    let fault = if is_word {
        Fault::new(
            name.span,
            format!("`{text}` has a meaning in formulas already"),
        )
        .hint("choose another name")
    } else if !is_identifier || text.len() > 60 {
        let fault = Fault::new(name.span, format!("`{text}` cannot be a symbol"));
        fault.hint("a symbol is a letter followed by letters, digits and _, such as m1, v_G or theta; `latex` says how it looks")
    } else {
        return;
    };
    faults.push(fault);
}

/// `v_1` and `v1` are one symbol.
fn spelling(name: &str) -> String {
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
    match dimension::unit(&text.text) {
        Ok(unit) => Some(unit),
        Err(trouble) => {
            faults.push(Fault::new(text.span, trouble.message));
            None
        }
    }
}

fn domain(written: &DomainFile, unit: &Unit, faults: &mut Vec<Fault>) -> Option<Domain> {
    match written {
        DomainFile::Named(DomainName::Positive) => Some(Domain::positive()),
        DomainFile::Named(DomainName::Nonnegative) => Some(Domain::nonnegative()),
        DomainFile::Named(DomainName::Real) => Some(Domain::real()),
        DomainFile::Interval(interval) => interval_domain(interval, unit, faults),
    }
}

fn interval_domain(
    interval: &IntervalFile,
    unit: &Unit,
    faults: &mut Vec<Fault>,
) -> Option<Domain> {
    let mut end = |formula: &Option<Formula>, open: Option<bool>| match formula {
        None => Some(None),
        Some(formula) => interval_end(formula, open == Some(true), unit, faults).map(Some),
    };
    let (low, high) = (
        end(&interval.min, interval.min_open),
        end(&interval.max, interval.max_open),
    );
    let (low, high) = (low?, high?);
    if let (Some(low), Some(high)) = (&low, &high) {
        let order = if low.of_pi == high.of_pi {
            Some(low.value.cmp(&high.value))
        } else {
            low.approximate().partial_cmp(&high.approximate())
        };
        if order != Some(Ordering::Less) {
            let fault = Fault::new(interval.span, "`min` is not below `max`");
            faults.push(fault.hint(
                "a quantity with one possible value is a number: write it into the formulas",
            ));
            return None;
        }
    }
    Some(Domain { low, high })
}

fn interval_end(
    formula: &Formula,
    open: bool,
    unit: &Unit,
    faults: &mut Vec<Fault>,
) -> Option<Limit> {
    let e = value(formula, unit, faults)?;
    if let Some(number) = e.as_number() {
        return Some(Limit::number(number.clone(), open));
    }
    if let Some(multiple) = multiple_of_pi(&e) {
        return Some(Limit::pi(multiple, open));
    }
    let fault = Fault::new(
        formula.span,
        "an end of a domain is a fraction or a fraction of pi",
    );
    faults.push(fault.hint("such as 3/2, 0.25 or pi/4"));
    None
}

/// Whether a contact uses this name, as it is, for its restitution.
fn is_restitution(file: &SceneFile, name: &str) -> bool {
    let mut contacts = file
        .contacts
        .iter()
        .flat_map(|m| &m.0)
        .filter_map(|(_, c)| c.as_ref());
    contacts.any(|c| {
        c.restitution
            .as_ref()
            .is_some_and(|e| e.text.trim() == name)
    })
}

/// Whether a contact uses this name, as it is, for its tangential restitution.
fn is_tangential(file: &SceneFile, name: &str) -> bool {
    let contacts = file.contacts.iter().flat_map(|m| &m.0);
    let mut given = contacts.filter_map(|(_, c)| c.as_ref()?.tangential_restitution.as_ref());
    given.any(|e| e.text.trim() == name)
}

fn is_component(file: &SceneFile, name: &str) -> bool {
    file.unit_vectors
        .iter()
        .flatten()
        .any(|pair| pair.items.iter().any(|c| c.text == name))
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
            let Some(parameter) = scene.parameters.iter().find(|p| *p.name == *name.text) else {
                is_fine = false;
                let is_there = file
                    .parameters
                    .iter()
                    .flat_map(|m| &m.0)
                    .any(|(n, _)| n.text == name.text);
                if !is_there {
                    let fault = Fault::new(name.span, format!("`{}` is no parameter", name.text));
                    faults.push(fault.hint("declare both components under \"parameters\""));
                }
                continue;
            };
            if !parameter.dimension.is_none() {
                is_fine = false;
                let message = format!(
                    "expected {}, found {}",
                    dimension::Dimension::none(),
                    parameter.dimension
                );
                faults.push(
                    Fault::new(name.span, message)
                        .hint("the components of a unit vector have no unit"),
                );
            }
            if !seen.insert(name.text.as_str()) {
                is_fine = false;
                faults.push(Fault::new(
                    name.span,
                    format!("`{}` is a component already", name.text),
                ));
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
