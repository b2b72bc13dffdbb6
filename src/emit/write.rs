//! Functions as source text in any of the languages, self-contained, with everything a reader needs in the comment.
//!
//! Steps used once are written where they are used, with brackets that keep their order; every rounding is that of the
//! program, so the languages give the same bits wherever their library gives the same cosines.

use std::collections::BTreeSet;

use super::comment::{Heading, comment, documentation, head};
use super::dd::Dd;
use super::dialect::{Dialect, Language, Style, filled};
use super::function::{Function, Turn};
use super::helpers::{self, Helper};
use super::names::{C_LIBRARY, Names};
use super::program::{Op, Step};
use super::record;
use super::units::{self, Units};

/// The functions with what they need, as one file.
pub fn file(style: &Style, heading: &Heading, functions: &[Function]) -> String {
    let language = style.language;
    let mut given: Vec<String> = Vec::new();
    let mut used = BTreeSet::new();
    let mut names = Names::default();
    let bodies: Vec<String> = functions
        .iter()
        .map(|f| {
            // Functions of the C library stand beside ours; arguments may be called like them.
            let name = format!("{}{}", style.prefix, f.name);
            let name = match C_LIBRARY.split_whitespace().any(|n| n == name) {
                true => names.fresh(&format!("{name}_after")),
                false => names.fresh(&name),
            };
            given.push(name.clone());
            Writer::new(language, f, &mut used).function(&name, style.record)
        })
        .collect();
    let mut out = String::from("\n");
    if style.record && language.is_python() {
        out.push_str("import typing\n");
    }
    out.push_str(&helpers::text(language, &used));
    if functions.iter().any(|f| f.units.is_some()) {
        out.push_str(&units::helpers(language));
    }
    out.push_str(&bodies.join("\n"));
    if style.record {
        out.push_str(&record::record(style, functions, &given, &mut names));
    }
    if language == Language::C && !style.prefix.is_empty() {
        out = helpers::prefixed(&out, &style.prefix);
    }
    out.insert_str(0, &comment(language, &head(heading, functions), true));
    if style.record && language == Language::C {
        out = record::guarded(&out, &style.prefix);
    }
    out
}

/// How tightly a piece of text holds together.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Holds {
    Sum,
    Product,
    Atom,
}

struct Writer<'a> {
    language: Language,
    function: &'a Function,
    used: &'a mut BTreeSet<Helper>,
    names: Names,
    arguments: Vec<String>,
    /// Plain and wide name of each input after the arguments.
    waves: Vec<[String; 2]>,
    lines: Vec<String>,
}

impl<'a> Writer<'a> {
    fn new(
        language: Language,
        function: &'a Function,
        used: &'a mut BTreeSet<Helper>,
    ) -> Writer<'a> {
        let mut names = Names::default();
        let arguments = function.arguments.iter();
        let arguments = arguments.map(|a| names.fresh(&a.symbol)).collect();
        let waves = vec![Default::default(); function.program.inputs];
        Writer {
            language,
            function,
            used,
            names,
            arguments,
            waves,
            lines: Vec::new(),
        }
    }

    fn function(mut self, name: &str, of_header: bool) -> String {
        let documentation = documentation(self.function, &self.arguments);
        let function = self.function;
        let scales = function.units.as_ref().map(|units| self.scale(units));
        for turn in &function.turns {
            self.turn(turn);
        }
        self.unused();
        let mut value = self.steps();
        let back = function.units.as_ref().zip(scales.as_deref());
        if let Some(power) = back.and_then(|(units, scales)| power(&units.value, scales, 1)) {
            value = format!("unit_scaled({value}, {power})");
        }
        let list = |of: &str| {
            let each = self.arguments.iter().map(|a| of.replace('#', a));
            each.collect::<Vec<_>>().join(", ")
        };
        let documented = comment(self.language, &documentation, false);
        let arguments = list("#");
        let end = if self.language.is_python() { "" } else { "}\n" };
        let head = match self.language {
            Language::Rust | Language::NoStd => {
                let mut marks = String::new();
                if name.contains(char::is_uppercase) || arguments.contains(char::is_uppercase) {
                    marks.push_str("#[allow(non_snake_case)]\n");
                }
                if self.arguments.len() > 7 {
                    marks.push_str("#[allow(clippy::too_many_arguments)]\n");
                }
                let list = list("#: f64");
                format!("{documented}{marks}pub fn {name}({list}) -> f64 {{\n")
            }
            Language::C => {
                let list = match arguments.is_empty() {
                    true => String::from("void"),
                    false => list("double #"),
                };
                let kind = if of_header { "static inline " } else { "" };
                format!("{documented}{kind}double {name}({list}) {{\n")
            }
            Language::Python | Language::NumPy => {
                format!("\ndef {name}({arguments}):\n{documented}")
            }
        };
        let mut steps = function.program.steps.iter();
        let is_constant = steps.all(|s| !matches!(s.op, Op::Input(_)));
        if self.language == Language::NumPy && is_constant && !arguments.is_empty() {
            value = format!("np.full(np.broadcast({arguments}).shape, {value})");
        }
        self.lines.push(filled(self.dialect().result, &value, ""));
        let lines: String = self.lines.iter().map(|l| format!("    {l}\n")).collect();
        head + &lines + end
    }

    fn dialect(&self) -> &'static Dialect {
        self.language.dialect()
    }

    /// Measures the arguments in units near them where one is far from one; gives the names of the units' exponents.
    fn scale(&mut self, units: &Units) -> Vec<String> {
        let limit = format!("1e{}", self.function.reach);
        let powers = units.arguments.iter().zip(self.arguments.clone());
        let changed = powers.filter(|(powers, _)| powers.iter().any(|p| *p != 0));
        let changed: Vec<(&Vec<i64>, String)> = changed.collect();
        let dialect = self.dialect();
        let tests = changed.iter();
        let tests = tests.map(|(_, a)| format!("unit_far({a}, {limit})"));
        let tests = tests.collect::<Vec<_>>().join(dialect.or);
        let far = self.names.fresh("far");
        self.lines.push(filled(dialect.whole, &far, &tests));
        let mut scales = Vec::new();
        for class in &units.of {
            let size = |a: &usize| self.library("abs", &self.arguments[*a], Holds::Atom);
            let sizes = class.iter().map(size);
            let largest = sizes.reduce(|a, b| filled(dialect.larger, &a, &b));
            let largest = largest.unwrap_or_default();
            let name = format!("size_{}", self.arguments[class[0]]);
            let name = self.names.fresh(&name);
            let size = filled(dialect.choice, &far, &format!("unit_size({largest})"));
            self.lines.push(filled(dialect.whole, &name, &size));
            scales.push(name);
        }
        for (powers, argument) in changed {
            if let Some(power) = power(powers, &scales, -1) {
                let scaled = format!("unit_scaled({argument}, {power})");
                self.lines.push(filled(dialect.again, &argument, &scaled));
            }
        }
        scales
    }

    /// Arguments that no step uses are named all the same, so that compilers do not remark on them.
    fn unused(&mut self) {
        let f = self.function;
        let read = |a: usize| {
            let in_step = |s: &Step| s.op == Op::Input(a);
            let in_turn = f.turns.iter().any(|t| t.terms.iter().any(|(_, i)| *i == a));
            in_turn || f.program.steps.iter().any(in_step)
        };
        let free = (0..self.arguments.len()).filter(|a| !read(*a));
        let free: Vec<String> = free.map(|a| self.arguments[a].clone()).collect();
        match self.language {
            Language::Rust | Language::NoStd if !free.is_empty() => {
                self.lines.push(format!("let _ = ({},);", free.join(", ")));
            }
            Language::C => {
                let lines = free.iter().map(|name| format!("(void){name};"));
                self.lines.extend(lines);
            }
            _ => {}
        }
    }

    fn assign(&mut self, name: &str, value: &str, wide: bool) {
        let dialect = self.dialect();
        let pattern = if wide { dialect.wide } else { dialect.double };
        self.lines.push(filled(pattern, name, value));
    }

    fn call(&mut self, helper: Helper, arguments: &[&str]) -> String {
        helper.with_needs(self.language, self.used);
        format!("{}({})", helper.name(), arguments.join(", "))
    }

    /// The cosine and sine of one angle.
    fn turn(&mut self, turn: &Turn) {
        let bare = match turn.terms.as_slice() {
            [(k, a)] if *k == 1.0 && turn.is_plain() => Some(self.arguments[*a].clone()),
            _ => None,
        };
        let suffix = bare.clone().unwrap_or_else(|| "angle".into());
        let product = |w: &Writer, (k, a): &(f64, usize)| match *k {
            1.0 => w.arguments[*a].clone(),
            k => format!("{} * {}", number(k), w.arguments[*a]),
        };
        if !turn.wide {
            let text = product(self, &turn.terms[0]);
            let argument = match &bare {
                Some(name) => name.clone(),
                None => {
                    let name = self.names.fresh("angle");
                    self.assign(&name, &text, false);
                    name
                }
            };
            for (wave, name) in [(turn.cos, "cos"), (turn.sin, "sin")] {
                if let Some(input) = wave {
                    let fresh = self.names.fresh(&format!("{name}_{suffix}"));
                    let value = self.library(name, &argument, Holds::Atom);
                    self.assign(&fresh, &value, false);
                    self.waves[input] = [fresh, String::new()];
                }
            }
            return;
        }
        let mut angle = (turn.pi != Dd::default()).then(|| self.wide_number(turn.pi));
        for term in &turn.terms {
            // A power of two times a double is a double; other coefficients go wide.
            let (k, a) = (term.0, self.arguments[term.1].clone());
            let text = if k.abs().log2().fract() == 0.0 {
                let text = product(self, term);
                self.widened(&text)
            } else {
                let [k, a] = [self.widened(&number(k)), self.widened(&a)];
                self.call(Helper::Multiply, &[&k, &a])
            };
            angle = Some(match angle {
                None => text,
                Some(sum) => self.call(Helper::Add, &[&sum, &text]),
            });
        }
        let angle = angle.unwrap_or_else(|| self.widened("0.0"));
        let cos = (turn.cos, "cos", Helper::Cos);
        for (wave, name, helper) in [cos, (turn.sin, "sin", Helper::Sin)] {
            if let Some(input) = wave {
                let fresh = self.names.fresh(&format!("{name}_{suffix}"));
                let value = self.call(helper, &[&angle]);
                self.assign(&fresh, &value, true);
                self.waves[input] = [self.high(&fresh), fresh];
            }
        }
    }

    fn library(&self, name: &str, argument: &str, holds: Holds) -> String {
        match holds == Holds::Atom || self.language != Language::Rust {
            true => self.dialect().library(name, &self.receiver(argument)),
            false => self.dialect().library(name, &format!("({argument})")),
        }
    }

    /// What stands before the name of a method of Rust, where a bare number has no type yet.
    fn receiver(&self, atom: &str) -> String {
        let bare = atom.starts_with(|c: char| c.is_ascii_digit()) && atom.parse::<f64>().is_ok();
        match bare && self.language == Language::Rust {
            true => format!("{atom}_f64"),
            false => atom.to_string(),
        }
    }

    fn high(&self, wide: &str) -> String {
        filled(self.dialect().high, wide, "")
    }

    fn widened(&mut self, plain: &str) -> String {
        match self.language {
            Language::C => self.call(Helper::Widen, &[plain]),
            _ => format!("({plain}, 0.0)"),
        }
    }

    fn wide_number(&mut self, v: Dd) -> String {
        let (high, low) = (number(v.high), number(v.low));
        match self.language {
            Language::C => self.call(Helper::Pair, &[&high, &low]),
            _ => format!("({high}, {low})"),
        }
    }

    /// Writes all steps and gives the text of the last.
    fn steps(&mut self) -> String {
        let steps = &self.function.program.steps;
        let mut uses = vec![0usize; steps.len()];
        for step in steps {
            let operands = step.op.operands().into_iter().flatten();
            operands.for_each(|i| uses[i] += 1);
        }
        let mut texts: Vec<(String, Holds)> = Vec::with_capacity(steps.len());
        for (i, step) in steps.iter().enumerate() {
            let (text, holds) = self.step(*step, &texts);
            let trivial = match step.op {
                Op::Number(_) => !step.wide,
                op => matches!(op, Op::Input(_)),
            };
            let long = text.len() > 70;
            let keep = i + 1 == steps.len() || trivial || (uses[i] < 2 && !long);
            texts.push(if keep {
                (text, holds)
            } else {
                let name = self.names.fresh(if step.wide { "w1" } else { "t1" });
                self.assign(&name, &text, step.wide);
                (name, Holds::Atom)
            });
        }
        texts.pop().map_or_else(|| "0.0".into(), |(text, _)| text)
    }

    fn step(&mut self, step: Step, texts: &[(String, Holds)]) -> (String, Holds) {
        // A left operand of the same strength needs no brackets: these operations are read from the left.
        let left = |i: usize, least: Holds| match &texts[i] {
            (text, holds) if *holds >= least => text.clone(),
            (text, _) => format!("({text})"),
        };
        let right = |i: usize| left(i, Holds::Atom);
        let infix = |a: usize, sign: &str, b: usize, holds: Holds| {
            let second = match holds {
                Holds::Sum => left(b, Holds::Product),
                _ => right(b),
            };
            (format!("{} {sign} {second}", left(a, holds)), holds)
        };
        let text = |i: usize| texts[i].0.as_str();
        if step.wide {
            let (helper, operands) = match step.op {
                Op::Number(v) => return (self.wide_number(v), Holds::Atom),
                Op::Input(i) => {
                    let wave = match self.arguments.get(i).cloned() {
                        Some(name) => self.widened(&name),
                        None => self.waves[i][1].clone(),
                    };
                    return (wave, Holds::Atom);
                }
                Op::Widen(a) => return (self.widened(text(a)), Holds::Atom),
                Op::Add(a, b) => (Helper::Add, vec![text(a), text(b)]),
                Op::Multiply(a, b) => (Helper::Multiply, vec![text(a), text(b)]),
                Op::Divide(a, b) => (Helper::Divide, vec![text(a), text(b)]),
                Op::Root(a) => (Helper::Root, vec![text(a)]),
                // No wide step subtracts, calls or takes powers.
                op => {
                    let operands = op.operands().into_iter().flatten();
                    (Helper::Negate, operands.map(text).collect())
                }
            };
            return (self.call(helper, &operands), Holds::Atom);
        }
        match step.op {
            Op::Number(v) if v.high < 0.0 => (number(v.high), Holds::Product),
            Op::Number(v) => (number(v.high), Holds::Atom),
            Op::Input(i) => match self.arguments.get(i) {
                Some(name) => (name.clone(), Holds::Atom),
                None => (self.waves[i][0].clone(), Holds::Atom),
            },
            Op::Add(a, b) => infix(a, "+", b, Holds::Sum),
            Op::Subtract(a, b) => infix(a, "-", b, Holds::Sum),
            Op::Multiply(a, b) => infix(a, "*", b, Holds::Product),
            Op::Divide(a, b) => infix(a, "/", b, Holds::Product),
            Op::Negate(a) => (format!("-{}", right(a)), Holds::Product),
            Op::Root(a) => (self.library("sqrt", &texts[a].0, texts[a].1), Holds::Atom),
            Op::Power(a, b) => {
                // A method stands behind a bracket, and so does an operator; what a call takes needs none.
                let [base, exponent] = match self.language {
                    Language::Rust => [self.receiver(&right(a)), text(b).to_string()],
                    Language::C | Language::NoStd => [a, b].map(|i| text(i).to_string()),
                    Language::Python | Language::NumPy => [right(a), right(b)],
                };
                (filled(self.dialect().power, &base, &exponent), Holds::Atom)
            }
            Op::Call(f, a) => (self.library(f.name(), &texts[a].0, texts[a].1), Holds::Atom),
            Op::Round(a) => (self.high(text(a)), Holds::Atom),
            Op::Widen(a) => (text(a).to_string(), texts[a].1),
        }
    }
}

/// A double as all languages read it.
pub(super) fn number(v: f64) -> String {
    format!("{v:?}")
}

/// A sum of exponents: powers times the exponents' names, all times a sign; `None` for an empty one.
fn power(powers: &[i64], names: &[String], sign: i64) -> Option<String> {
    let mut text = String::new();
    for (power, name) in powers.iter().zip(names).filter(|(p, _)| **p != 0) {
        let power = power * sign;
        text.push_str(match (text.is_empty(), power < 0) {
            (true, true) => "-",
            (true, false) => "",
            (false, true) => " - ",
            (false, false) => " + ",
        });
        text.push_str(&match power.abs() {
            1 => name.clone(),
            k => format!("{k} * {name}"),
        });
    }
    (!text.is_empty()).then_some(text)
}
