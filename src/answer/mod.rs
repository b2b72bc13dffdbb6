//! Answers, and questions about answers: limits, thresholds, largest values, zeros, forms for a small parameter, identities.
//!
//! In: what is asked, what earlier answers stand for, the scene's parameters with their domains. Out: answers with how each is
//! known. Nothing here knows mechanics: the answers may come from an impact, from a motion or from anywhere else.

pub mod calc;
mod dimensions;
mod direction;
mod formulas;
mod graph;
mod inequality;
mod intervals;
mod isolate;
pub mod limit;
mod optimum;
mod powers;
pub mod solve;
mod taylor;
mod threshold;
mod undo;
mod zeros;

use std::collections::BTreeMap;
use std::fmt;

pub use dimensions::dimension_of;
pub use formulas::{LONGEST, about, divided_by, formulas, no_coefficient, remember};
pub use graph::{Curve, Graph, graphs};

use crate::algebra::Sign;
use crate::dimension::{Dimension, System};
use crate::domain::Domains;
use crate::expr::{Expr, Symbol, Vector};
use crate::formula::{Relation, Sentence, latex_name, sentence, with_subscript, write_plain};
use crate::scene::{Ask, Mode, Parameter, Question, Scene};

/// The symbol whose square stands for a parameter under a root.
const ROOT: &str = "\u{1}root";

/// What a check says where nothing was found.
pub const NOT_FOUND: &str = "not found";

/// What earlier answers stand for, by name, in parameters alone.
pub type Known = BTreeMap<Symbol, Expr>;

/// One thing that was checked.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Check {
    /// Stable name of the kind of check.
    pub kind: &'static str,
    /// What was found, in words.
    pub words: String,
    /// Whether it held; `None` where it could not be carried out.
    pub holds: Option<bool>,
}

impl Check {
    /// A check of this kind, with what was found and whether it held.
    pub fn new(kind: &'static str, words: impl Into<String>, holds: Option<bool>) -> Check {
        let words = words.into();
        Check { kind, words, holds }
    }
}

/// The answer to a question, or to one component of it.
#[derive(Clone, Debug, Default)]
pub struct Answer {
    /// Name of the question.
    pub question: String,
    /// The stage it belongs to, among those told, and the outcome there; `None` for an answer about formulas alone.
    pub told: Option<(usize, usize)>,
    /// The ways through the cases in which an answer about formulas holds, by index; empty for all.
    pub worlds: Vec<usize>,
    /// Name of the answer.
    pub name: String,
    /// The name typeset.
    pub latex: String,
    /// What it is, in words.
    pub words: String,
    /// The value, equation or matrix.
    pub form: Form,
    /// For which values of a parameter, or of a combination of parameters, something holds: that, relation, value.
    pub range: Vec<(Expr, Relation, Expr)>,
    /// What single values of the range need: the value, and what must be above zero for it, or not below it where `true`.
    pub needs: Vec<(Expr, Expr, bool)>,
    /// What is asked, put into parameters: an equation or inequality to be solved, or the formula that is to be largest.
    pub stated: Option<(Expr, Relation, Expr)>,
    /// Identities that show the answer: both sides are the same in the parameters, with the reason.
    pub put_in: Vec<(Expr, Expr, &'static str)>,
    /// The answer in sentences.
    pub text: Vec<Sentence>,
    /// Dimension of the value.
    pub dimension: Dimension,
    /// What it rests on beyond the domains.
    pub assumptions: Vec<Sentence>,
    /// Solutions that were discarded, with the reason.
    pub discarded: Vec<Sentence>,
    /// What stands for a formula close to a value of a parameter.
    pub near: Vec<Near>,
    /// What was checked.
    pub checks: Vec<Check>,
}

/// What an answer looks like.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Form {
    /// A closed form.
    Value {
        /// In parameters alone; where a derivation went in steps, in its definitions too.
        closed: Expr,
        /// The same, shorter, in parameters and the derivation's definitions; equal to `closed` where that is short.
        short: Expr,
    },
    /// An equation; of a balance, before = after.
    Equation {
        /// Left side.
        left: Expr,
        /// Right side.
        right: Expr,
    },
    /// A system in matrix form, entries as the equations give them.
    Matrix(Matrix),
    /// Not determined by the laws; names of the unknowns it depends on, none where the text says why.
    Open(Vec<String>),
    /// None of these: a range of a parameter, or words.
    #[default]
    Words,
}

impl Form {
    /// A closed form that is short as it is.
    pub fn value(closed: Expr) -> Form {
        Form::Value {
            short: closed.clone(),
            closed,
        }
    }

    /// Every formula in it, the closed one of a value.
    pub fn formulas(&self) -> Vec<&Expr> {
        match self {
            Form::Value { closed, .. } => vec![closed],
            Form::Equation { left, right } => vec![left, right],
            Form::Matrix(m) => m.entries.iter().flatten().chain(&m.rhs).collect(),
            Form::Open(_) | Form::Words => Vec::new(),
        }
    }

    /// The same with every formula changed.
    pub fn map(&self, put: impl Fn(&Expr) -> Expr) -> Form {
        match self {
            Form::Value { closed, .. } => Form::value(put(closed)),
            Form::Equation { left, right } => Form::Equation {
                left: put(left),
                right: put(right),
            },
            Form::Matrix(m) => Form::Matrix(Matrix {
                entries: m
                    .entries
                    .iter()
                    .map(|row| row.iter().map(&put).collect())
                    .collect(),
                rhs: m.rhs.iter().map(&put).collect(),
                ..m.clone()
            }),
            other => other.clone(),
        }
    }
}

/// Entries × unknowns = right side.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    /// Which equation each row is, in words.
    pub rows: Vec<String>,
    /// Names of the unknowns.
    pub unknowns: Vec<String>,
    /// Entries, row by row.
    pub entries: Vec<Vec<Expr>>,
    /// Right sides.
    pub rhs: Vec<Expr>,
}

/// The closer the parameter comes to the value, the less the sides differ, even divided by the distance to a power.
#[derive(Clone, PartialEq, Debug)]
pub struct Near {
    /// Left side.
    pub left: Expr,
    /// Right side.
    pub right: Expr,
    /// The parameter.
    pub parameter: Symbol,
    /// The value it comes to; `None` beyond all bounds.
    pub to: Option<Expr>,
    /// The power.
    pub order: u32,
}

/// The component of a vector that is asked, in the words of an answer: `, along −y`, `, along (cos(a), sin(a))`; nothing for both.
pub fn along(direction: Option<&Vector>) -> String {
    let Some([x, y]) = direction else {
        return String::new();
    };
    let axis = match (x.is_zero(), y.is_zero()) {
        (false, true) if x.is_one() => "x",
        (false, true) if (-x).is_one() => "−x",
        (true, false) if y.is_one() => "y",
        (true, false) if (-y).is_one() => "−y",
        _ => return format!(", along ({}, {})", write_plain(x), write_plain(y)),
    };
    format!(", along {axis}")
}

/// What answers that say the same rest on: what all of them do, and where each does besides, one or another of that.
pub fn given_alike(all: &[&Answer], domains: &Domains) -> Vec<Sentence> {
    let is_common = |s: &&Sentence| all.iter().all(|a| a.assumptions.contains(s));
    let first = all.first().into_iter().flat_map(|a| &a.assumptions);
    let mut out: Vec<Sentence> = first.filter(is_common).cloned().collect();
    without_weaker(&mut out);
    let own = |a: &&Answer| {
        let own = a.assumptions.iter().filter(|s| !is_common(s));
        own.cloned().collect::<Vec<_>>()
    };
    let each: Vec<Vec<Sentence>> = all.iter().map(own).collect();
    if all.len() < 2 || each.iter().any(Vec::is_empty) {
        return out;
    }
    let each = merged(each, domains);
    match each.as_slice() {
        // One of them holds always.
        all if all.iter().any(Vec::is_empty) => {}
        [one] => out.extend(one.iter().cloned()),
        _ => {
            let each = each.into_iter().map(|own| Sentence::join(own, " and "));
            out.push(Sentence::join(each, ", or that "));
        }
    }
    out
}

/// Most cases of which two are looked for that are one.
const MERGED: usize = 4;

/// What several cases need, with those that are one told once.
fn merged(mut each: Vec<Vec<Sentence>>, domains: &Domains) -> Vec<Vec<Sentence>> {
    let pair = |each: &[Vec<Sentence>]| {
        let all = 0..each.len();
        let mut pairs = all.clone().flat_map(|i| all.clone().map(move |j| (i, j)));
        pairs.find_map(|(i, j)| {
            let one = (i != j).then(|| as_one(&each[i], &each[j], domains));
            Some((i, j, one.flatten()?))
        })
    };
    while (2..=MERGED).contains(&each.len())
        && let Some((i, j, one)) = pair(&each)
    {
        each[i] = one;
        each.remove(j);
    }
    each
}

/// Leaves away that something is not negative where it is told to be positive.
fn without_weaker(all: &mut Vec<Sentence>) {
    let positive: Vec<Expr> = all
        .iter()
        .flat_map(Sentence::conditions)
        .filter_map(|(e, open)| open.then_some(e))
        .collect();
    all.retain(|words| {
        let mut told = words.conditions();
        match (told.next(), told.next()) {
            (Some((e, false)), None) => !positive.contains(&e),
            _ => true,
        }
    });
}

/// Either that x ≥ 0, or that x ≤ 0 and z ≥ 0, as z ≥ 0, where this holds wherever x ≥ 0; for the same reason: a contact sticks,
/// whether it begins to in compression or in restitution.
fn as_one(a: &[Sentence], b: &[Sentence], domains: &Domains) -> Option<Vec<Sentence>> {
    let plain = |all: &[Sentence]| -> Vec<Sentence> {
        let plain = all.iter().map(|s| s.worded(&Mode::without_phase));
        plain.collect()
    };
    let (a, b) = (plain(a), plain(b));
    let (mut out, a): (Vec<Sentence>, Vec<Sentence>) = a.into_iter().partition(|s| b.contains(s));
    let b: Vec<&Sentence> = b.iter().filter(|s| !out.contains(s)).collect();
    let a = a.first().filter(|_| a.len() == 1)?;
    let excess = |s: &Sentence| {
        let mut all = s.conditions();
        let first = all.next().filter(|(_, is_open)| !is_open);
        first.filter(|_| all.next().is_none()).map(|(e, _)| e)
    };
    let x = excess(a)?;
    let is_opposite =
        |b: &Sentence| excess(b).is_some_and(|y| calc::is_zero(&(&x + &y), domains) == Some(true));
    let (b, c) = match b.as_slice() {
        // One of both holds always.
        [b] => return is_opposite(b).then_some(out),
        [b, c] => (b, c),
        _ => return None,
    };
    let is_not_negative = |e: &Expr| calc::sign(e, domains).is_not_negative();
    let rest = [(b, c), (c, b)].into_iter().find(|(not, rest)| {
        let alike = [a, *not].iter().all(|s| s.0.last() == rest.0.last());
        let follows = excess(rest).is_some_and(|z| is_not_negative(&(z - &x)));
        alike && is_opposite(not) && follows
    });
    out.push((*rest?.1).clone());
    Some(out)
}

impl Answer {
    /// An answer without content yet.
    pub fn blank(question: &Question, name: &str, words: impl Into<String>) -> Answer {
        let latex = match (&question.latex, name.strip_prefix(question.name.as_str())) {
            (Some(vector), Some("_x")) => with_subscript(vector, "x"),
            (Some(vector), Some("_y")) => with_subscript(vector, "y"),
            (Some(latex), _) => latex.clone(),
            (None, _) => latex_name(name),
        };
        Answer::typeset(question, name, latex, words)
    }

    /// The same under a name whose LaTeX is known.
    pub fn typeset(
        question: &Question,
        name: &str,
        latex: String,
        words: impl Into<String>,
    ) -> Answer {
        Answer {
            question: question.name.clone(),
            name: name.to_string(),
            latex,
            words: words.into(),
            ..Answer::default()
        }
    }

    /// The domains where all is so that one of its values needs.
    pub fn where_is(&self, value: &Expr, domains: &Domains) -> Domains {
        let own = self.needs.iter().filter(|(of, ..)| of == value);
        own.fold(domains.clone(), |all, (_, e, closed)| all.given(e, *closed))
    }

    /// Leaves the answer open, with the reason; what was said and checked of a value goes.
    pub fn leave_open(mut self, why: impl Into<Sentence>) -> Answer {
        self.form = Form::Open(Vec::new());
        self.text = vec![sentence!("not determined: {}", why.into())];
        self.checks.clear();
        self
    }

    /// Why the laws give no value: by the other unknowns that it depends on, if there are any.
    pub fn left_open(&self) -> Option<String> {
        let Form::Open(names) = &self.form else {
            return None;
        };
        Some(match names.iter().all(|name| *name == self.name) {
            true => String::from("not determined: the laws leave it open"),
            false => format!("not determined: it depends on {}", names.join(", ")),
        })
    }

    /// The value in parameters, where the answer is one.
    pub fn formula(&self) -> Option<&Expr> {
        match &self.form {
            Form::Value { closed, .. } => Some(closed),
            _ => None,
        }
    }

    /// The first condition of its value that the given values do not keep to: there it has no number. What bears on the
    /// parameter that is sought says nothing of the value that the scene gives it.
    pub fn broken(&self, scene: &Scene) -> Option<Sentence> {
        self.formula()?;
        let values = scene.values();
        let sought: Vec<Symbol> = self
            .range
            .iter()
            .flat_map(|(of, ..)| of.symbols())
            .collect();
        let is_broken = |(e, _): &(Expr, bool)| {
            let bears = sought.iter().any(|s| e.mentions(s));
            !bears && calc::constant(&e.substitute(&values)) == Some(Sign::Negative)
        };
        let rests = self.assumptions.iter().flat_map(Sentence::conditions);
        let decided = scene.decided().flat_map(|(_, decided)| decided.excesses());
        let decided = decided.map(|(e, closed)| (e, !closed));
        let (e, open) = rests.chain(decided).find(is_broken)?;
        Some(match open {
            true => Sentence::positive(&e),
            false => Sentence::not_negative(&e),
        })
    }

    /// Its unit as a person says it; 1 for a plain number.
    pub fn unit(&self, scene: &Scene) -> String {
        let asked = scene.question(&self.question);
        let of = asked.and_then(|q| match &q.ask {
            Ask::Condition { parameter, .. } => scene.parameter(parameter),
            _ => None,
        });
        let is_angle = asked.is_some_and(|q| matches!(q.ask, Ask::Angle { .. }));
        match of {
            _ if is_angle || of.is_some_and(Parameter::is_angle) => String::from("rad"),
            // A moment has the dimension of an energy, and no joules.
            Some(of) if of.unit == "N m" => of.unit.clone(),
            _ => asked.map_or_else(|| self.dimension.spoken(), |q| q.ask.unit(&self.dimension)),
        }
    }

    /// Its unit in the system that the scene's data are in.
    pub fn unit_of_data(&self, scene: &Scene) -> String {
        match scene.system() {
            System::Si => self.unit(scene),
            system => system.unit(&self.dimension),
        }
    }

    /// A value in SI units as a number with that unit; a plain number stands alone.
    pub fn measured(&self, scene: &Scene, value: f64, digits: impl Fn(f64) -> String) -> String {
        let number = digits(value / scene.system().scale(&self.dimension));
        match self.unit_of_data(scene).as_str() {
            "1" => number,
            unit => format!("{number} {unit}"),
        }
    }

    /// Which component of a vector it is: 0 for x, 1 for y.
    pub fn axis(&self) -> Option<usize> {
        let rest = self.name.strip_prefix(self.question.as_str())?;
        let is = |axis: &&str| rest == *axis || rest.starts_with(&format!("{axis}_case"));
        ["_x", "_y"].iter().position(is)
    }
}

/// Why a stage, a question or a plot cannot be worked out.
#[derive(Clone, Debug, PartialEq)]
pub struct Refused {
    /// The stage, question or plot; empty for the whole of a scene that is one impact.
    pub at: String,
    /// The reason.
    pub reason: String,
    /// What to do.
    pub hint: String,
    /// Whether the laws contradict each other, rather than that the file says something that does not fit.
    pub contradicts: bool,
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.at.is_empty() {
            write!(f, "{}: ", self.at)?;
        }
        f.write_str(&self.reason)?;
        if self.hint.is_empty() {
            Ok(())
        } else {
            write!(f, "\nhint: {}", self.hint)
        }
    }
}

impl std::error::Error for Refused {}

/// What to do where formulas get too long.
pub const TOO_LONG: &str =
    "give some parameters numbers by `value`, or let `carom solve` follow the scene in numbers";

impl Refused {
    /// Refuses what stands at a place.
    pub fn at(at: String, reason: impl Into<String>, hint: impl Into<String>) -> Refused {
        Refused {
            at,
            reason: reason.into(),
            hint: hint.into(),
            contradicts: false,
        }
    }

    /// Refuses a question.
    pub fn question(name: &str, reason: impl Into<String>, hint: impl Into<String>) -> Refused {
        Refused::at(format!("question `{name}`"), reason, hint)
    }

    /// Refuses a question whose answer the algebra did not work out.
    pub fn uncalculated(name: &str, stop: impl fmt::Display) -> Refused {
        Refused::question(name, format!("not calculated: {stop}"), TOO_LONG)
    }
}

/// A question about formulas on its way to an answer.
pub(super) struct Work<'a> {
    pub scene: &'a Scene,
    pub question: &'a Question,
    /// Name of the answer.
    pub name: &'a str,
    /// What earlier answers stand for.
    pub known: &'a Known,
}
