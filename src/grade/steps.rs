//! A worked solution, line by line: which lines hold in the scene, which is the first that does not, and whether what
//! follows is carried along by it.
//!
//! A line is an equation in the scene's parameters, the names of what is asked and unknown, and names the student
//! introduces. It holds when it is an identity in the derived motion. After a line that does not hold, later lines are
//! also tried in the motion that line would imply.

use std::collections::BTreeMap;

use super::relation::solve_for;
use super::sheet::Sheet;
use super::{Diagnosis, Options};
use crate::derive::Form;
use crate::equality::{self, Equality};
use crate::expr::{Expr, Symbol};
use crate::formula::{self, Content, Fault, Reading, Relation, Symbols};
use crate::laws;

/// What is found of one line.
#[derive(Clone, PartialEq, Debug)]
pub enum Status {
    /// It holds in the scene.
    Holds,
    /// It gives a new name to something.
    Defines,
    /// It does not hold, and it does not follow from an earlier slip: a slip of its own.
    Wrong,
    /// It does not hold, and it follows from the wrong line of this number.
    Carried(usize),
    /// It cannot be read.
    Unreadable(Fault),
    /// Words without an equation.
    Comment,
    /// It could not be decided.
    Undecided,
}

/// One line of a worked solution.
#[derive(Clone, Debug)]
pub struct Line {
    /// Its number, from 1.
    pub number: usize,
    /// Its text.
    pub text: String,
    /// What is found.
    pub status: Status,
    /// What is wrong with it, where that is known.
    pub diagnosis: Vec<Diagnosis>,
}

/// Longest worked solution, in lines.
pub const MAX_LINES: usize = 400;

/// Checks a worked solution.
pub fn check(sheet: &Sheet, text: &str, options: &Options) -> Vec<Line> {
    let mut desk = Desk::new(sheet);
    text.lines()
        .enumerate()
        .filter(|(_, line)| !line.trim().is_empty())
        .take(MAX_LINES)
        .map(|(i, line)| {
            let line = line.trim();
            let (status, diagnosis) = desk.line(i + 1, line, options);
            Line {
                number: i + 1,
                text: line.to_string(),
                status,
                diagnosis,
            }
        })
        .collect()
}

struct Desk<'a> {
    sheet: &'a Sheet,
    /// True values by name.
    closed: BTreeMap<Symbol, Expr>,
    /// What wrong lines imply: for each the value of one name, under all that came before.
    believed: Vec<(usize, BTreeMap<Symbol, Expr>)>,
    /// Names the student introduced.
    own: BTreeMap<Symbol, Expr>,
}

impl<'a> Desk<'a> {
    fn new(sheet: &'a Sheet) -> Desk<'a> {
        let mut closed = BTreeMap::new();
        let d = &sheet.derivation;
        for unknown in laws::unknowns(&sheet.scene) {
            if let Some(value) = d.motion.get(&unknown) {
                let value = if d.names.is_reversed(unknown) {
                    -value
                } else {
                    value.clone()
                };
                closed.insert(Symbol::from(d.names.plain(unknown)), value);
            }
        }
        for answer in &d.answers {
            if let Form::Value { closed: value, .. } = &answer.form {
                closed.insert(Symbol::from(answer.name.as_str()), value.clone());
            }
        }
        Desk {
            sheet,
            closed,
            believed: Vec::new(),
            own: BTreeMap::new(),
        }
    }

    fn symbols(&self) -> Symbols {
        let mut symbols = Symbols::strict();
        for p in &self.sheet.scene.parameters {
            symbols.declare_as(&p.name, p.latex.as_deref(), Some(p.dimension.clone()));
        }
        for q in &self.sheet.scene.questions {
            if self.closed.contains_key(q.name.as_str()) {
                symbols.declare_as(&q.name, q.latex.as_deref(), None);
            }
        }
        self.closed
            .keys()
            .chain(self.own.keys())
            .for_each(|name| symbols.declare(name));
        symbols
    }

    fn line(&mut self, number: usize, text: &str, options: &Options) -> (Status, Vec<Diagnosis>) {
        let none = Vec::new;
        if !text.contains(['=', '<', '>', '≤', '≥', '≈']) {
            return (Status::Comment, none());
        }
        let symbols = self.symbols();
        let reading = match formula::read(text, &symbols) {
            Ok(reading) => reading,
            Err(fault) => match self.definition(text) {
                Some(status) => return (status, none()),
                None => return (Status::Unreadable(fault), none()),
            },
        };
        let Some(differences) = left_minus_right(&reading) else {
            return (Status::Undecided, none());
        };
        match self.all_zero(&differences, &BTreeMap::new()) {
            Some(true) => {
                self.link(&reading);
                return (Status::Holds, none());
            }
            None => return (Status::Undecided, none()),
            Some(false) => {}
        }
        // Under what the wrong lines before imply, the latest first.
        for (cause, values) in self.believed.iter().rev() {
            if self.all_zero(&differences, values) == Some(true) {
                let cause = *cause;
                self.believe(cause, &differences);
                return (Status::Carried(cause), none());
            }
        }
        // The student may have meant the other reading of a slash.
        for other in formula::other_readings(text, &symbols).into_iter().take(4) {
            let fits = left_minus_right(&other);
            if fits.is_some_and(|d| self.all_zero(&d, &BTreeMap::new()) == Some(true)) {
                self.link(&other);
                let message = format!("holds when read as {}", super::show(&other.content));
                let hint = "this line can be read in two ways; use brackets to say which is meant";
                return (
                    Status::Holds,
                    vec![Diagnosis::new("AMBIGUOUS", message, hint)],
                );
            }
        }
        self.believe(number, &differences);
        (Status::Wrong, self.diagnosis(&reading, text, options))
    }

    /// A new name for something: `h = l/2 sin(theta)`.
    fn definition(&mut self, text: &str) -> Option<Status> {
        let (left, right) = text.split_once('=')?;
        let name = formula::read(left, &Symbols::open())
            .ok()?
            .expr()?
            .as_symbol()?
            .clone();
        let value = formula::read(right, &self.symbols()).ok()?.expr()?.clone();
        if self.own.len() >= 100 {
            return None;
        }
        self.own.insert(name, value);
        Some(Status::Defines)
    }

    /// Whether all differences vanish with the names' values put in; those of `instead` go first.
    fn all_zero(&self, differences: &[Expr], instead: &BTreeMap<Symbol, Expr>) -> Option<bool> {
        let mut sure = Some(true);
        for d in differences {
            let value = self.put_in(d, instead);
            match equality::decide(&value, &Expr::zero(), &self.sheet.scene.domains).equality {
                Equality::Same { .. } => {}
                Equality::Different(_) | Equality::Invalid { .. } => return Some(false),
                Equality::Undecided { .. } => sure = None,
            }
        }
        sure
    }

    fn put_in(&self, e: &Expr, instead: &BTreeMap<Symbol, Expr>) -> Expr {
        let mut out = e.clone();
        // Own names may use one another.
        for _ in 0..self.own.len().min(8) {
            out = out.substitute(&self.own);
        }
        out.substitute(instead).substitute(&self.closed)
    }

    /// A line `name = …` that holds says what the name is under every belief about the others.
    fn link(&mut self, reading: &Reading) {
        let Content::Relations(sides, _) = &reading.content else {
            return;
        };
        let [left, .., right] = sides.as_slice() else {
            return;
        };
        let (Some(name), Some(value)) = (left.expr().and_then(Expr::as_symbol), right.expr())
        else {
            return;
        };
        let mut value = value.clone();
        for _ in 0..self.own.len().min(8) {
            value = value.substitute(&self.own);
        }
        let used = value.symbols();
        for (_, values) in &mut self.believed {
            if values.keys().any(|n| used.contains(n)) && !values.contains_key(name) {
                let implied = value.substitute(values);
                values.insert(name.clone(), implied);
            }
        }
    }

    /// Notes what a wrong line implies: each of its names in turn is what it would have to be.
    fn believe(&mut self, cause: usize, differences: &[Expr]) {
        let earlier = self
            .believed
            .iter()
            .rev()
            .find(|(c, _)| *c == cause)
            .map(|(_, v)| v.clone())
            .unwrap_or_default();
        for d in differences {
            let mut d = d.clone();
            for _ in 0..self.own.len().min(8) {
                d = d.substitute(&self.own);
            }
            let names: Vec<Symbol> = d
                .symbols()
                .into_iter()
                .filter(|n| self.closed.contains_key(n))
                .collect();
            for name in names {
                let mut others = self.closed.clone();
                others.remove(&name);
                let mut known = earlier.clone();
                known.remove(&name);
                let reduced = d.substitute(&known).substitute(&others);
                if let Some(root) = solve_for(&reduced, &name, &self.sheet.scene.domains) {
                    let mut values = earlier.clone();
                    values.insert(name, root);
                    self.believed.push((cause, values));
                }
            }
        }
        let excess = self.believed.len().saturating_sub(64);
        self.believed.drain(..excess);
    }

    /// For a line that states a quantity of the scene: the belief behind it.
    fn diagnosis(&self, reading: &Reading, text: &str, options: &Options) -> Vec<Diagnosis> {
        let Content::Relations(sides, _) = &reading.content else {
            return Vec::new();
        };
        let name = sides
            .first()
            .and_then(Content::expr)
            .and_then(Expr::as_symbol);
        let Some(entry) = name.and_then(|n| self.sheet.entry(n).ok()) else {
            return Vec::new();
        };
        let grade = self.sheet.judge(&entry, text, options);
        grade.diagnosis
    }
}

/// Left minus right of every equation of a line, components of vectors one by one.
fn left_minus_right(reading: &Reading) -> Option<Vec<Expr>> {
    let Content::Relations(sides, signs) = &reading.content else {
        return None;
    };
    if signs
        .iter()
        .any(|s| !matches!(s, Relation::Equal | Relation::Approximately))
    {
        return None;
    }
    let mut out = Vec::new();
    for pair in sides.windows(2) {
        match (&pair[0], &pair[1]) {
            (Content::Vector(a), Content::Vector(b)) => {
                out.extend(a.iter().zip(b).map(|(a, b)| a - b))
            }
            (a, b) => out.push(a.expr()? - b.expr()?),
        }
    }
    Some(out)
}
