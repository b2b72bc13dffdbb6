//! Judges an answer against what is expected: equivalent, different, invalid or undecided, how that is known, and what is
//! wrong with a wrong one.
//!
//! In: texts of formulas and what the question declares of its symbols. Out: a [`Grade`]. A verdict is proved or marked:
//! undecided never counts as wrong, and what cannot be read is invalid rather than wrong. This module writes no format
//! and knows no file.

mod behind;
pub mod belief;
pub mod believed;
mod cases;
mod compare;
mod context;
mod doubt;
pub mod entry;
mod form;
mod number;
mod partial;
mod read;
mod relation;
mod scalar;
pub mod sheet;
pub mod steps;
mod unit;
mod verdict;
mod worked;

use std::collections::BTreeSet;

use crate::dimension::Dimension;
use crate::domain::{Domain, Domains};
use crate::expr::{Symbol, effort};
use crate::formula::{self, Content, Fault, Reading, Symbols};
pub(crate) use crate::verify::rounding::fraction;
use doubt::Doubt;

pub use form::Form;
pub use number::Tolerance;
pub use verdict::{Apart, Diagnosis, Grade, Proof, Verdict};

/// What a question declares about its symbols.
#[derive(Clone, Debug, Default)]
pub struct Question {
    /// The symbols in play.
    pub symbols: Vec<Given>,
    /// Where they live; see [`Domains`] for what is not declared.
    pub domains: Domains,
    /// Whether nothing but `symbols` may occur in an answer.
    pub closed: bool,
    /// Name of the quantity asked for, where it has one: an answer may begin with `name =`.
    pub asked: Vec<Given>,
    /// Dimension of what is asked for, where known.
    pub dimension: Option<Dimension>,
}

impl Question {
    /// What is declared, and what is asked for.
    pub(crate) fn given(&self) -> impl Iterator<Item = &Given> {
        self.symbols.iter().chain(&self.asked)
    }

    /// The dimension of a symbol, where it is declared.
    pub(crate) fn dimension_of(&self, name: &str) -> Option<Dimension> {
        let given = self.given().find(|g| *g.name == *name)?;
        given.dimension.clone()
    }
}

/// A declared symbol.
#[derive(Clone, Debug)]
pub struct Given {
    /// Its name.
    pub name: Symbol,
    /// How it is typeset.
    pub latex: Option<String>,
    /// Its dimension, where declared.
    pub dimension: Option<Dimension>,
}

impl Given {
    /// A symbol of which the name alone is known.
    pub fn named(name: impl Into<Symbol>) -> Given {
        Given::new(name, None, None)
    }

    fn new(name: impl Into<Symbol>, latex: Option<String>, dimension: Option<Dimension>) -> Given {
        Given {
            name: name.into(),
            latex,
            dimension,
        }
    }
}

/// How a comparison is carried out.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// How strong a proof of equality has to be.
    pub strength: Strength,
    /// How far a number may be off.
    pub tolerance: Option<Tolerance>,
    /// Demands on the way the answer is written.
    pub forms: Vec<Form>,
    /// Whether brackets have to show what stands below a slash.
    pub strict_slash: bool,
}

impl Options {
    /// The same without demands on the form.
    fn plain(&self) -> Options {
        Options {
            forms: Vec::new(),
            ..self.clone()
        }
    }
}

/// How strong a proof of equality has to be.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, clap::ValueEnum)]
pub enum Strength {
    /// An identity in the normal form, and a counterexample with every refutation.
    #[default]
    Identity,
    /// Equal at random points modulo 2⁶¹ − 1 where no root occurs, with the bound of error stated; no diagnosis.
    Fast,
}

/// An expected formula, read once and compared many times.
#[derive(Clone, Debug)]
pub struct Key {
    /// The formula.
    pub reading: Reading,
    /// What is asked, with the symbols of the formula among those in play.
    pub question: Question,
    /// Symbols of the formula that the question does not declare.
    undeclared: BTreeSet<Symbol>,
    /// Names an answer may use.
    pub(crate) readable: Symbols,
    /// The key as a quantity, where its text is one as well as a product: `5 m`.
    pub(crate) quantity: Option<Box<Key>>,
    /// The key as an interval, where its text could be one as well as a vector: `[0, 1]`.
    pub(crate) range: Option<Box<Key>>,
    /// The same on parts of the domain, where it is given in cases.
    pub(crate) cases: Vec<Key>,
    /// Whether these cases leave a part of the domain out.
    has_hole: bool,
    /// The key with a decimal comma, where a comma of its text is taken to part thousands and could be one: `1{,}234`.
    pub(crate) decimals: Option<Box<Key>>,
    /// The direction in words behind the key: along x and y, and about the axis out of the page.
    pub(crate) direction: Option<[i32; 3]>,
    /// Whether the question says itself what e is.
    pub(crate) declares_e: bool,
    /// Whether the question knows a symbol i or j, which is then no imaginary unit.
    pub(crate) declares_i: bool,
    /// How the formula was read, where slashes could reach further or less far.
    pub(crate) told: Option<String>,
    /// The same as a fault, for those who want brackets.
    pub(crate) unclear: Option<Fault>,
}

impl Key {
    /// The same of another content.
    fn with(&self, content: Content) -> Key {
        Key {
            reading: self.reading.with(content),
            ..self.clone()
        }
    }

    /// The key with what both relations together leave without a sign, whichever of them is the expected one; `None` where
    /// that is nothing.
    fn beside(&self, answer: &Content) -> Option<Key> {
        let is_relation = |c: &Content| matches!(c, Content::Relations(..) | Content::Joined(..));
        let expected = &self.reading.content;
        if !is_relation(expected) {
            return None;
        }
        let question = &self.question;
        let free = |name: &Symbol| {
            let known = || question.given().any(|given| given.name == *name);
            !question.domains.symbols.contains_key(name)
                && (self.undeclared.contains(name) || !(question.closed || known()))
        };
        let names = relation::unsigned(&[expected, answer]).into_iter();
        let mut free = names.filter(free).peekable();
        free.peek()?;
        let mut key = self.clone();
        let domains = &mut key.question.domains.symbols;
        domains.extend(free.map(|name| (name, Domain::real())));
        Some(key)
    }
}

/// Reads an expected formula.
pub fn key(expected: &str, question: &Question) -> Result<Key, Fault> {
    if let Some((value, direction)) = read::sense(expected) {
        let mut key = key(value, question)?;
        if let Some(quantity) = &mut key.quantity {
            quantity.direction = Some(direction);
        }
        key.direction = Some(direction);
        return Ok(key);
    }
    let symbols = names_of(question);
    if let Some(cases) = cases::keys(expected, question, &symbols) {
        let (cases, has_hole) = cases?;
        let none = || *Fault::new("none of the cases occurs on the domain", 0, 0);
        let first = cases.first().cloned().ok_or_else(none)?;
        return Ok(Key {
            cases,
            has_hole,
            ..first
        });
    }
    let strict = || with_names(Symbols::strict(), question);
    let closed = || Question {
        closed: true,
        ..question.clone()
    };
    if let Some(once) = formula::said_once(expected, &strict()) {
        return key(once.map_err(|fault| *fault)?, question);
    }
    let reading = match read::expected(expected, &symbols) {
        Ok(reading) => reading,
        // `2.4 1/s` is no product of numbers and letters.
        Err(fault) => {
            if let Some([thousands, decimals]) = doubt::commas(expected) {
                let decimals = key(&decimals, question).ok().map(Box::new);
                let key = key(&thousands, question)?;
                return Ok(Key { decimals, ..key });
            }
            let measured = formula::read(expected, &strict()).ok();
            let measured = measured.filter(|r| matches!(r.content, Content::Quantity(_)));
            return Ok(from_reading(measured.ok_or(fault)?, &closed()));
        }
    };
    let quantity = (!question.closed).then(|| read::quantity(expected, &reading, question));
    let quantity = quantity.flatten();
    let mut key = from_reading(reading, question);
    if let Some(reading) = quantity {
        let same = reading.content == key.reading.content;
        let mut alone = from_reading(reading, &closed());
        alone.range = range(expected, &alone, &strict());
        if same {
            return Ok(alone);
        }
        key.quantity = Some(Box::new(alone));
    }
    let range = range(expected, &key, &symbols);
    key.told = doubt::told(expected, &key.reading);
    key.unclear = doubt::unclear_slash(expected, &key.reading);
    // With its names declared a text may split otherwise; the same text has to mean the same in key and answer.
    let rounds = if read::is_stable(&key.reading) { 0 } else { 3 };
    for _ in 0..rounds {
        match read::answer(&key, expected) {
            Ok(again) if again.content != key.reading.content => {
                let before = key;
                key = from_reading(again, question);
                key.quantity = before.quantity;
                key.told = before.told;
                key.unclear = before.unclear;
            }
            _ => break,
        }
    }
    key.range = range;
    // What is bold in the key may have an arrow in the answer.
    if ["\\mathbf", "\\boldsymbol", "\\bm"]
        .iter()
        .any(|font| expected.contains(font))
    {
        for name in key.reading.symbols() {
            let latex = formula::latex_name(&name);
            let (letter, index) = latex.split_at(latex.find('_').unwrap_or(latex.len()));
            let arrow = format!("\\vec{{{letter}}}{index}");
            key.readable.declare_typeset(name, &arrow);
        }
    }
    Ok(key)
}

/// The interval that two numbers in brackets could be as well as a vector.
fn range(expected: &str, key: &Key, symbols: &Symbols) -> Option<Box<Key>> {
    let vector = matches!(key.reading.content, Content::Vector(_));
    let range = vector.then(|| formula::read_interval(expected, symbols));
    Some(Box::new(from_reading(range.flatten()?, &key.question)))
}

/// A key from an expression that was derived rather than typed.
pub fn key_of(content: Content, question: &Question) -> Key {
    let reading = Reading {
        content,
        written: Vec::new(),
        literal: None,
        unit: None,
        notes: Vec::new(),
        choices: 0,
        slashes: false,
    };
    from_reading(reading, question)
}

fn from_reading(mut reading: Reading, question: &Question) -> Key {
    let declares = |name| question.symbols.iter().any(|g| &*g.name == name);
    let [declares_e, declares_i] = [declares("e"), declares("i") || declares("j")];
    let mut question = question.clone();
    let mut names = reading.symbols();
    let components = names.iter().filter(|name| formula::is_component(name));
    let declared = question.symbols.iter().map(|g| &g.name);
    if let Some(content) = read::sizes(&reading.content, components.chain(declared)) {
        reading.content = content;
        names = reading.symbols();
    }
    for given in question.given() {
        names.remove(&given.name);
    }
    // A component of a vector has either sign.
    for name in &names {
        if formula::is_component(name) && !question.domains.symbols.contains_key(name) {
            let domains = &mut question.domains.symbols;
            domains.insert(name.clone(), Domain::real());
        }
    }
    let undeclared = names.clone();
    question.symbols.extend(names.into_iter().map(Given::named));
    let mut readable = names_of(&question);
    // Vectors whose components are known are named whole, in bold too.
    for name in question.given().map(|given| &given.name) {
        if formula::is_component(name) && readable.find(&name[..name.len() - 2]).is_none() {
            readable.declare(&name[..name.len() - 2]);
        }
    }
    Key {
        reading,
        question,
        undeclared,
        readable,
        quantity: None,
        range: None,
        cases: Vec::new(),
        has_hole: false,
        decimals: None,
        direction: None,
        declares_e,
        declares_i,
        told: None,
        unclear: None,
    }
}

/// The names of a question, and where it is not closed any others.
fn names_of(question: &Question) -> Symbols {
    let symbols = match question.closed {
        true => Symbols::strict(),
        false => Symbols::open(),
    };
    with_names(symbols, question)
}

/// Some names with those of a question.
fn with_names(mut symbols: Symbols, question: &Question) -> Symbols {
    symbols.reserve(question.given().count());
    for given in question.given() {
        symbols.declare_as(
            given.name.clone(),
            given.latex.as_deref(),
            given.dimension.clone(),
        );
    }
    symbols
}

/// Judges an answer against an expected formula.
pub fn judge(expected: &str, answer: &str, question: &Question, options: &Options) -> Grade {
    match key(expected, question) {
        Ok(key) => judge_against(&key, answer, options),
        Err(fault) => unreadable_key(fault),
    }
}

/// The grade where the expected formula itself cannot be read.
pub fn unreadable_key(fault: Fault) -> Grade {
    let words = "the expected formula cannot be read";
    Grade::invalid("INVALID_EXPECTED", words, fault)
}

/// Most steps that one judgement takes in all its stages: readings, points, proof, solutions, what is wrong.
const MOST_STEPS: u64 = 5_000_000;

/// Judges an answer against an expected formula that was read before.
pub fn judge_against(key: &Key, answer: &str, options: &Options) -> Grade {
    match formula::within_limit(answer) {
        Ok(()) => effort::within(MOST_STEPS, || judge_within(key, answer, options)),
        Err(fault) => unreadable(*fault),
    }
}

fn judge_within(key: &Key, answer: &str, options: &Options) -> Grade {
    if options.strict_slash
        && let Some(fault) = &key.unclear
    {
        return unreadable_key(fault.clone());
    }
    if let Some(Tolerance::Measured(width)) = &options.tolerance {
        return match unit::width_of(key.quantity.as_deref().unwrap_or(key), width) {
            Ok(width) => {
                let tolerance = Some(Tolerance::Absolute(width));
                let options = Options {
                    tolerance,
                    ..options.clone()
                };
                judge_within(key, answer, &options)
            }
            Err(why) => {
                let fault = Fault::new(why, 0, 0);
                Grade::invalid("INVALID_TOLERANCE", "the tolerance does not fit", *fault)
            }
        };
    }
    if key.quantity.is_some()
        && let Some(fault) = unit::unclear(answer)
    {
        return unreadable(fault);
    }
    if !key.cases.is_empty() {
        return cases::of_key(key, answer, options);
    }
    if let Some(grade) = cases::judge(key, answer, options) {
        return grade;
    }
    if let Some(decimals) = &key.decimals {
        let thousands = Key {
            decimals: None,
            ..key.clone()
        };
        return doubt::either_comma([&thousands, decimals], answer, options);
    }
    let mut grade = judge_here(key, answer, options);
    if matches!(grade.verdict, Verdict::Different | Verdict::Invalid)
        && let Some(right) = doubt::run_together(key, answer, options)
    {
        grade = right;
    }
    // How a product of letters reads is no matter where the text is a quantity.
    let is_quantity = |q: &Key| read::is_quantity(q, answer);
    if options.strength == Strength::Identity
        && let Some(told) = &key.told
        && !key.quantity.as_deref().is_some_and(is_quantity)
    {
        let words = format!("the expected formula is ambiguous: {told}");
        let hint = "authors write brackets around all that stands below a slash or under a root";
        grade
            .diagnosis
            .push(Diagnosis::new("EXPECTED_READING", words, hint));
    }
    grade
}

/// Puts a reading into the form that is compared; gives what its unit is taken for.
fn as_compared(key: &Key, reading: &mut Reading) -> Option<String> {
    if let Some(content) = compare::several::named(&key.reading.content, &reading.content) {
        reading.content = content;
    }
    if let Some(content) = compare::turned(&reading.content) {
        reading.content = content;
    }
    let meant = unit::as_asked(key, reading);
    let names = key.question.symbols.iter().map(|g| &g.name);
    if let Some(content) = read::sizes(&reading.content, names) {
        reading.content = content;
    }
    if matches!(reading.content, Content::Relations(..) | Content::Scalar(_)) {
        read::differentials(key, reading);
    }
    meant
}

fn judge_here(key: &Key, answer: &str, options: &Options) -> Grade {
    if let Some(quantity) = &key.quantity
        && read::is_quantity(quantity, answer)
    {
        let mut grade = judge_against(quantity, answer, options);
        let unit = match quantity.reading.content.answer() {
            Content::Quantity(q) => q.unit_text.as_str(),
            _ => "what follows the number",
        };
        let words = format!("{unit} is a unit, not a symbol");
        grade.assumed.push(words);
        return grade;
    }
    let reading = read::answer(key, answer);
    let bounds = |reading: &Reading| reading.content.is_bounded();
    if let Some(range) = &key.range
        && reading.as_ref().is_ok_and(bounds)
    {
        return judge_against(range, answer, options);
    }
    let mut reading = match reading {
        Ok(reading) => reading,
        Err(fault) => {
            return doubt::unread(key, answer, options).unwrap_or_else(|| unreadable(fault));
        }
    };
    if options.strict_slash
        && let Some(fault) = doubt::unclear_slash(answer, &reading)
    {
        return unreadable(fault);
    }
    if let Some(parts) = worked::worked(key, answer, &reading) {
        let mut grade = judge_here(key, parts.formula, options);
        if !parts.is_broken(&mut grade) {
            parts.unjudged(key, &mut grade);
        }
        return grade;
    }
    let meant = as_compared(key, &mut reading);
    let mut doubt = Doubt::new(key, answer, options, reading);
    if doubt.is_wrong()
        && let Some(grade) = doubt::number(key, answer, options)
    {
        return grade;
    }
    doubt.turned();
    doubt.unit_behind();
    unit::behind(key, &doubt.reading, &mut doubt.finding);
    unit::of_relations(key, &doubt.reading, &mut doubt.finding);
    unit::of_names(key, &doubt.reading, &mut doubt.finding);
    doubt.finding.assumed.extend(meant);
    let is_right = doubt.finding.is_equivalent();
    if is_right && key.direction.is_some() && read::sense(answer).is_none() {
        let words = "the direction is not judged";
        doubt.finding.assumed.push(words.into());
    }
    doubt.crossed();
    // A wrong answer is never told so where another reading is right, however fast.
    let open_to_doubt = (options.strength == Strength::Identity || doubt.is_wrong())
        && doubt.finding.note != "EQUIV_READING"
        && (doubt.reading.choices > u32::from(doubt.reading.slashes)
            || doubt::power_of_function(&doubt.reading.content).is_some());
    doubt.euler();
    doubt.raised();
    doubt.side_by_side();
    doubt.primes();
    doubt.imaginary();
    doubt.any_whole_number();
    doubt.backwards();
    if open_to_doubt {
        doubt.ambiguity();
    }
    let Doubt {
        reading,
        mut finding,
        ..
    } = doubt;
    if effort::spent() {
        finding.stopped();
    }
    form::demand(&options.forms, key, &reading, &mut finding);
    if options.strength == Strength::Identity {
        finding
            .diagnosis
            .extend(doubt::remarks(&reading, answer, finding.verdict));
    }
    Grade {
        content: Some(reading.content),
        ..finding
    }
}

/// The grade of an answer that cannot be read.
fn unreadable(fault: Fault) -> Grade {
    Grade::invalid("INVALID_SYNTAX", "the answer cannot be read", fault)
}

/// A content in plain notation, decimals as such.
pub fn show(content: &Content) -> String {
    content.plain(&number::shown)
}

#[cfg(test)]
mod tests;
