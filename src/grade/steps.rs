//! A worked solution, line by line: which lines hold in the scene, which is the first that does not, and whether what
//! follows is carried along by it.
//!
//! A line is an equation in the scene's parameters, the names of what is asked and unknown, and names the student
//! introduces. It holds when it is an identity in the derived motion. After a line that does not hold, later lines are
//! also tried in the motion that line would imply.

mod text;
mod why;

use std::collections::{BTreeMap, BTreeSet};

use super::relation::{follows, solve_for};
use super::sheet::Sheet;
use super::{Diagnosis, Options, Tolerance};
use crate::derive::Form;
use crate::equality::{self, Equality};
use crate::expr::{Expr, Function, Node, Symbol};
use crate::formula::{self, Content, Fault, Reading, Relation, Symbols};
use crate::laws;
use crate::scene::{Ask, ContactLaw, Scene};
use text::{equation, is_near};

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

/// Most equations above a line that are solved together.
const MOST_STATED: usize = 24;
/// Most terms of an equation whose signs are tried.
const MOST_TERMS: usize = 12;
/// Most wrong lines that are tried as the cause of a later one.
const MOST_CAUSES: usize = 4;

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
    /// The wrong lines themselves, left minus right, with the student's own names put in.
    wrong: Vec<(usize, Expr)>,
    /// Every equation so far that was decided, as left minus right with the student's own names put in, and the wrong line
    /// it hangs on; `None` for what holds.
    stated: Vec<(Option<usize>, Expr)>,
    /// Names of velocities and spins that all follow from any one of them; empty unless the motion has one freedom.
    moving: BTreeSet<Symbol>,
    /// Names the student introduced.
    own: BTreeMap<Symbol, Expr>,
}

impl<'a> Desk<'a> {
    fn new(sheet: &'a Sheet) -> Desk<'a> {
        let mut closed = BTreeMap::new();
        let mut moving = BTreeSet::new();
        let d = &sheet.derivation;
        for unknown in laws::unknowns(&sheet.scene) {
            if let Some(value) = d.motion.get(&unknown) {
                let value = if d.names.is_reversed(unknown) {
                    -value
                } else {
                    value.clone()
                };
                let name = Symbol::from(d.names.plain(unknown));
                if !unknown.is_impulse() {
                    moving.insert(name.clone());
                }
                closed.insert(name, value);
            }
        }
        for answer in &d.answers {
            if let Form::Value { closed: value, .. } = &answer.form {
                let question = sheet
                    .scene
                    .questions
                    .iter()
                    .find(|q| q.name == answer.question);
                if question
                    .is_some_and(|q| matches!(q.ask, Ask::Velocity { .. } | Ask::Spin { .. }))
                {
                    moving.insert(Symbol::from(answer.name.as_str()));
                }
                closed.insert(Symbol::from(answer.name.as_str()), value.clone());
            }
        }
        Desk {
            sheet,
            closed,
            believed: Vec::new(),
            wrong: Vec::new(),
            stated: Vec::new(),
            moving: if one_freedom(&sheet.scene) {
                moving
            } else {
                BTreeSet::new()
            },
            own: BTreeMap::new(),
        }
    }

    fn symbols(&self) -> Symbols {
        let mut symbols = Symbols::strict();
        for p in &self.sheet.scene.parameters {
            symbols.declare_as(&p.name, p.latex.as_deref(), Some(p.dimension.clone()));
        }
        for q in &self.sheet.scene.questions {
            if self.closed.contains_key(q.name.as_str()) || self.components(&q.name).is_some() {
                symbols.declare_as(&q.name, q.latex.as_deref(), None);
            }
        }
        self.closed
            .keys()
            .chain(self.own.keys())
            .for_each(|name| symbols.declare(name));
        // `ω⁺` is what is asked of the moment just after.
        for name in self.closed.keys().filter(|name| !name.contains('^')) {
            let after = format!("{}^{{+}}", formula::latex_name(name));
            symbols.declare_as(name, Some(&after), None);
        }
        symbols
    }

    /// The components of a vector that is asked for.
    fn components(&self, name: &str) -> Option<[Expr; 3]> {
        let part = |axis: &str| {
            let component = format!("{name}_{axis}");
            let known = self.closed.contains_key(component.as_str());
            known.then(|| Expr::symbol(&component))
        };
        Some([part("x")?, part("y")?, Expr::zero()])
    }

    /// Left minus right of every equation of a line, components of vectors one by one.
    fn differences(&self, reading: &Reading) -> Option<Vec<Expr>> {
        let Content::Relations(sides, signs) = &reading.content else {
            return None;
        };
        let equal = |s: &Relation| matches!(s, Relation::Equal | Relation::Approximately);
        if !signs.iter().all(equal) {
            return None;
        }
        let vector = |side: &Content| match side {
            Content::Vector(v) => Some(v.clone()),
            other => self.components(other.expr()?.as_symbol()?),
        };
        let mut out = Vec::new();
        for pair in sides.windows(2) {
            match (vector(&pair[0]), vector(&pair[1])) {
                (Some(a), Some(b)) => out.extend(a.iter().zip(&b).map(|(a, b)| a - b)),
                _ => out.push(pair[0].expr()? - pair[1].expr()?),
            }
        }
        Some(out)
    }

    fn line(&mut self, number: usize, text: &str, options: &Options) -> (Status, Vec<Diagnosis>) {
        let none = Vec::new;
        let text = equation(text);
        if !text.contains(['=', '<', '>', '≤', '≥', '≈']) {
            return (Status::Comment, none());
        }
        let symbols = self.symbols();
        let reading = match formula::read(text, &symbols) {
            Ok(reading) => reading,
            Err(fault) => match self.definition(text) {
                Some(status) => return (status, none()),
                // A name that looks like one of the scene's is a slip of the pen rather than a new name.
                None if !is_near(&fault) && self.new_name(text).is_some() => {
                    return (Status::Defines, none());
                }
                None => return (Status::Unreadable(fault), none()),
            },
        };
        let Some(differences) = self.differences(&reading) else {
            return (Status::Undecided, none());
        };
        match self.all_zero(&differences, &BTreeMap::new()) {
            Some(true) => {
                self.link(&reading);
                self.state(None, &differences);
                return (Status::Holds, none());
            }
            None => return (Status::Undecided, none()),
            Some(false) => {}
        }
        if self.rounded(&reading) {
            return (Status::Holds, none());
        }
        if let Some(cause) = self.cause(&differences) {
            self.believe(cause, &differences);
            self.state(Some(cause), &differences);
            return (Status::Carried(cause), none());
        }
        // The student may have meant the other reading of a slash.
        for other in formula::other_readings(text, &symbols, true)
            .into_iter()
            .take(4)
        {
            let Some(differences) = self.differences(&other) else {
                continue;
            };
            if let Some(cause) = self.cause(&differences) {
                self.believe(cause, &differences);
                self.state(Some(cause), &differences);
                return (Status::Carried(cause), none());
            }
            if self.all_zero(&differences, &BTreeMap::new()) == Some(true) {
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
        self.state(Some(number), &differences);
        if let [one] = differences.as_slice() {
            self.wrong.push((number, self.with_own(one)));
        }
        (Status::Wrong, self.diagnosis(&reading, text, options))
    }

    /// The wrong line from which equations follow: they hold in the motion it implies, or say the same.
    fn cause(&self, differences: &[Expr]) -> Option<usize> {
        // The latest first.
        let implied = self.believed.iter().rev();
        let found = implied
            .filter(|(_, values)| self.all_zero(differences, values) == Some(true))
            .map(|(cause, _)| *cause)
            .next();
        found.or_else(|| {
            let [one] = differences else { return None };
            let one = self.with_own(one);
            let domains = &self.sheet.scene.domains;
            let said = self.wrong.iter().rev().take(8);
            said.filter(|(_, f)| follows(f, &one, domains))
                .map(|(cause, _)| *cause)
                .next()
                .or_else(|| self.eliminated(&one))
        })
    }

    /// Notes equations for later lines.
    fn state(&mut self, cause: Option<usize>, differences: &[Expr]) {
        let all = differences.iter().map(|d| (cause, self.with_own(d)));
        let all: Vec<_> = all.collect();
        self.stated.extend(all);
        let excess = self.stated.len().saturating_sub(MOST_STATED);
        self.stated.drain(..excess);
    }

    /// The wrong line that makes an equation follow from those above it: they are solved for one name after another, first
    /// the wrong line and what hangs on it, and put in.
    fn eliminated(&self, one: &Expr) -> Option<usize> {
        let domains = &self.sheet.scene.domains;
        let is_zero = |e: &Expr| {
            let decided = equality::decide(e, &Expr::zero(), domains).equality;
            matches!(decided, Equality::Same { .. })
        };
        let mut causes: Vec<usize> = self.stated.iter().filter_map(|(c, _)| *c).collect();
        causes.sort_unstable();
        causes.dedup();
        causes.into_iter().rev().take(MOST_CAUSES).find(|&cause| {
            let of = |wanted: Option<usize>| self.stated.iter().filter(move |(c, _)| *c == wanted);
            let mut rules: Vec<BTreeMap<Symbol, Expr>> = Vec::new();
            let reduced = |e: &Expr, rules: &[BTreeMap<Symbol, Expr>]| {
                rules.iter().fold(e.clone(), |e, rule| e.substitute(rule))
            };
            for (_, line) in of(Some(cause)).chain(of(None)) {
                let line = reduced(line, &rules);
                // What says nothing new, or contradicts those before, gives no rule.
                let symbols = line.symbols();
                let mut names = symbols.iter().filter(|n| self.closed.contains_key(*n));
                let rule = names.find_map(|name| {
                    let root = solve_for(&line, name, domains)?;
                    Some(BTreeMap::from([(name.clone(), root)]))
                });
                rules.extend(rule);
            }
            is_zero(&reduced(one, &rules))
        })
    }

    /// An equation with one name that is new: it says what the name stands for.
    fn new_name(&mut self, text: &str) -> Option<Status> {
        let mut open = Symbols::open();
        for p in &self.sheet.scene.parameters {
            open.declare_as(&p.name, p.latex.as_deref(), Some(p.dimension.clone()));
        }
        let known = self.closed.keys().chain(self.own.keys());
        known.for_each(|name| open.declare(name));
        let reading = formula::read(text, &open).ok()?;
        let given = |name: &Symbol| {
            let parameters = &self.sheet.scene.parameters;
            self.closed.contains_key(name)
                || self.own.contains_key(name)
                || parameters.iter().any(|p| p.name == *name)
        };
        let letters = reading
            .notes
            .iter()
            .any(|n| n.remark == formula::Remark::Letters);
        let new: Vec<Symbol> = reading
            .symbols()
            .into_iter()
            .filter(|n| !given(n))
            .collect();
        let ([name], false, true) = (new.as_slice(), letters, self.own.len() < 100) else {
            return None;
        };
        let [one] = &self.differences(&reading)?[..] else {
            return None;
        };
        let value = solve_for(&self.with_own(one), name, &self.sheet.scene.domains)?;
        self.own.insert(name.clone(), value);
        Some(Status::Defines)
    }

    /// Whether a line ends in a number that is the value of what stands before it, rounded to its digits: the scene's values
    /// put in, at least two digits.
    fn rounded(&self, reading: &Reading) -> bool {
        let Content::Relations(sides, _) = &reading.content else {
            return false;
        };
        let (Some(literal), [.., before, last]) = (&reading.literal, sides.as_slice()) else {
            return false;
        };
        let (Some(before), Some(number)) = (before.expr(), last.expr()) else {
            return false;
        };
        let values = super::believed::values(&self.sheet.scene);
        let exact = self.put_in(before, &BTreeMap::new()).substitute(&values);
        let digits = Tolerance::Significant(literal.digits.clamp(2, 12));
        let links = &sides[..sides.len() - 1];
        let linked = links.windows(2).all(|pair| {
            let gap = pair[0].expr().zip(pair[1].expr()).map(|(a, b)| a - b);
            gap.is_some_and(|gap| self.all_zero(&[gap], &BTreeMap::new()) == Some(true))
        });
        let constant = exact.is_constant() && number.is_constant();
        constant && linked && super::number::within(number, &exact, &digits) == Some(true)
    }

    /// |v| of a vector that is asked for, as the root of the squares of its components.
    fn magnitudes(&self, e: &Expr) -> Expr {
        if let Node::Call(Function::Abs, inner) = e.node()
            && let Some([x, y, _]) = inner.as_symbol().and_then(|name| self.components(name))
        {
            return (x.powi(2) + y.powi(2)).sqrt();
        }
        e.map_parts(|part| self.magnitudes(part))
    }

    /// An expression with the student's own names put in.
    fn with_own(&self, e: &Expr) -> Expr {
        // Own names may use one another.
        let rounds = 0..self.own.len().min(8);
        rounds.fold(e.clone(), |e, _| e.substitute(&self.own))
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
        self.magnitudes(&self.with_own(e))
            .substitute(instead)
            .substitute(&self.closed)
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
        let value = self.with_own(value);
        let used = value.symbols();
        for (_, values) in &mut self.believed {
            if values.keys().any(|n| used.contains(n)) && !values.contains_key(name) {
                let implied = value.substitute(values);
                values.insert(name.clone(), implied);
            }
        }
    }

    /// In a motion with one freedom all velocities are what they are, times the same wrong number.
    fn carry_along(&self, name: &Symbol, root: &Expr, values: &mut BTreeMap<Symbol, Expr>) {
        let Some(truth) = self.closed.get(name).filter(|t| !t.is_zero()) else {
            return;
        };
        if !self.moving.contains(name) {
            return;
        }
        for other in self.moving.iter().filter(|other| *other != name) {
            if let Some(value) = self.closed.get(other) {
                let scaled = value * &(root * &truth.powi(-1));
                values.entry(other.clone()).or_insert(scaled);
            }
        }
    }
}

/// Whether hinges and sticking contacts leave the bodies one freedom, so that all velocities go in step.
fn one_freedom(scene: &Scene) -> bool {
    let free: usize = scene
        .bodies
        .iter()
        .filter(|b| !b.is_fixed())
        .map(|b| if b.is_particle() { 2 } else { 3 })
        .sum();
    let sticking = scene.contacts.iter().all(|c| c.law == ContactLaw::Sticking);
    let held = 2 * (scene.hinges.len() + scene.contacts.len());
    sticking && free == held + 1
}
