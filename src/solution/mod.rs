//! The worked solution as data: sections of sentences and displayed equations, and the list of claims they are made from.
//!
//! Comes in: a scene, its derivation and the proof of it. Goes out: a [`Solution`] that says what a teacher would say: which
//! system, about which point, which impulses drop out and why, what was divided by, what to notice. Every equation shown is a
//! [`Claim`] of a [`Step`], so that `check` can put exact numbers into both sides. This module knows no output format.

mod angular;
mod answers;
mod asked;
mod balance;
mod block;
mod contact;
mod eliminate;
mod given;
mod heading;
mod impulse;
mod isolate;
mod known;
mod near;
mod neat;
mod notice;
mod opening;
mod page;
mod results;
mod roots;
mod rough;
mod rounded;
mod sentence;
mod slip;
mod story;
mod through;
mod words;
mod writer;

use std::collections::BTreeMap;

pub use known::known;
pub use sentence::{full_sentence, sentence};
pub use words::{assumptions, is_safe_latex, with_symbols};

use writer::Writer;

use crate::answer::Near;
use crate::expr::{Expr, Symbol, Vector};
use crate::scene::{Mode, Scene};
use crate::story::{Case, Told};

/// How much is shown.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default, clap::ValueEnum)]
pub enum Detail {
    /// The answers with their key equations.
    Brief,
    /// What a good textbook shows.
    #[default]
    Normal,
    /// Every line of algebra.
    Full,
}

/// A worked solution.
#[derive(Clone, Debug, Default)]
pub struct Solution {
    /// Heading.
    pub title: String,
    /// Where the problem comes from; may be empty.
    pub source: String,
    /// The problem in words; may be empty.
    pub statement: String,
    /// How much is shown.
    pub detail: Detail,
    /// LaTeX of the symbols that occur, where it differs from what their names give.
    pub names: BTreeMap<Symbol, String>,
    /// What every symbol that is no parameter stands for.
    pub meanings: BTreeMap<Symbol, Meaning>,
    /// The text.
    pub sections: Vec<Section>,
    /// The claims the text is made from, in order.
    pub steps: Vec<Step>,
    /// Impacts of a scene with stages, whose symbols stand for something within them only.
    pub scopes: Vec<Scope>,
    /// Everything the results rest on.
    pub assumptions: Vec<String>,
    /// What must be ≥ 0 for the motions to go as told; steps are replayed where it is.
    pub needs: Vec<Expr>,
    /// What a contact with friction does in the case worked out; points to replay it at are those where it does that.
    pub mode: Option<Mode>,
}

impl Solution {
    /// What stands above it.
    pub fn heading(&self) -> &str {
        match self.title.is_empty() {
            true => "Worked solution",
            false => &self.title,
        }
    }

    /// Lets the text begin with why its result cannot happen.
    pub fn begin_with(&mut self, refusal: &str) {
        let first = Section {
            depth: 0,
            heading: Vec::new(),
            parts: vec![Part::Text(vec![Inline::Text(refusal.to_owned())])],
        };
        self.sections.insert(0, first);
    }

    /// Lets the text end with what it leaves open.
    pub fn end_with(&mut self, scene: &Scene, open: &str) {
        self.text(vec![Inline::Text(sentence::called(scene, open))]);
    }
}

/// What a symbol stands for, in terms of the scene, so that another program can find its value on its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// Component (0: x, 1: y) of the velocity of this body's center of mass just after.
    Velocity(String, usize),
    /// Spin of this body just after; the flag tells whether clockwise counts as positive.
    Spin(String, bool),
    /// Impulse at this contact, hinge or blow: on which body, and which component; `None` for its size along the normal of a
    /// frictionless contact or the direction of a blow.
    Impulse(String, String, Option<usize>),
    /// The answer to this question, or a component of it.
    Answer(String, Option<usize>),
    /// An abbreviation that a step of the solution defines.
    Defined,
}

/// An impact of a scene with stages: the motion that goes in, what acts one way, and what its symbols stand for.
#[derive(Clone, Debug)]
pub struct Scope {
    /// Name, unique in the solution: that of the stage, with a number where it has several outcomes.
    pub name: String,
    /// Name of the stage.
    pub stage: String,
    /// Names of the supports and strings that act.
    pub active: Vec<String>,
    /// What a contact with friction does.
    pub mode: Option<Mode>,
    /// Symbols for what an earlier stage hands on, and what they are.
    pub handed: BTreeMap<Symbol, Expr>,
    /// Answers to earlier stages that its formulas hold, and what they are.
    pub earlier: BTreeMap<Symbol, Expr>,
    /// Symbols that stand for what is not determined.
    pub open: Vec<Symbol>,
    /// The bodies just before.
    pub before: Vec<Before>,
    /// What must be ≥ 0 for them to get there as told, and for the impact to go this way.
    pub needs: Vec<Expr>,
    /// What the other symbols stand for.
    pub meanings: BTreeMap<Symbol, Meaning>,
}

/// A body just before an impact, as the solution has it.
#[derive(Clone, Debug)]
pub struct Before {
    /// Its name.
    pub body: String,
    /// Center of mass \[m\].
    pub center: Vector,
    /// Orientation \[rad\].
    pub angle: Expr,
    /// Velocity of the center of mass [m/s].
    pub velocity: Vector,
    /// Angular velocity [rad/s].
    pub spin: Expr,
}

/// A heading and what stands below it.
#[derive(Clone, Debug)]
pub struct Section {
    /// 0 for a section, 1 for a part of the section before, 2 for a part of that.
    pub depth: usize,
    /// The heading; empty for what stands directly below the title.
    pub heading: Vec<Inline>,
    /// The contents.
    pub parts: Vec<Part>,
}

/// A piece of a section.
#[derive(Clone, Debug)]
pub enum Part {
    /// Sentences.
    Text(Vec<Inline>),
    /// Equations, one a line.
    Display(Vec<Line>),
    /// Results, in a box.
    Result(Vec<Line>),
    /// Items.
    List(Vec<Vec<Inline>>),
    /// A system in matrix form.
    Matrix(crate::answer::Matrix),
    /// The place of a figure.
    Figure(Slot),
}

/// Which figure belongs somewhere.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Slot {
    /// The bodies just before, and the free-body diagrams of the collision.
    Before,
    /// The bodies just after.
    After,
    /// Quantities against a parameter.
    Plot,
    /// The stage of this index.
    Stage(usize),
}

/// One displayed equation.
#[derive(Clone, Debug)]
pub struct Line {
    /// The formula.
    pub math: Vec<Math>,
    /// The step that claims it; `None` for a definition in vectors that a later claim evaluates.
    pub step: Option<String>,
}

impl Line {
    /// An equation that no step claims.
    pub fn plain(math: Vec<Math>) -> Line {
        Line { math, step: None }
    }
}

/// A piece of a sentence.
#[derive(Clone, PartialEq, Debug)]
pub enum Inline {
    /// Words.
    Text(String),
    /// A formula.
    Math(Vec<Math>),
}

/// A piece of a formula.
#[derive(Clone, PartialEq, Debug)]
pub enum Math {
    /// A scalar in the scene's symbols.
    Expr(Expr),
    /// A scalar factor: a sum stands in brackets.
    Factor(Expr),
    /// A vector in components along î and ĵ.
    Vector(Vector),
    /// A vector along k̂.
    Along(Expr),
    /// A named quantity of the textbook, such as r_{G/C} or H_C⁻.
    Name(Name),
    /// `=`, `+`, `−`, `×`, `·`, `≈`, `⇒`, `→` or a comma.
    Op(&'static str),
    /// Something in brackets.
    Brackets(Vec<Math>),
}

impl From<String> for Inline {
    fn from(words: String) -> Inline {
        Inline::Text(words)
    }
}

impl From<&str> for Inline {
    fn from(words: &str) -> Inline {
        Inline::Text(words.to_owned())
    }
}

impl From<Expr> for Math {
    fn from(e: Expr) -> Math {
        Math::Expr(e)
    }
}

impl From<&Expr> for Math {
    fn from(e: &Expr) -> Math {
        Math::Expr(e.clone())
    }
}

impl From<Vector> for Math {
    fn from(v: Vector) -> Math {
        Math::Vector(v)
    }
}

/// A quantity with a letter, an index and a mark.
#[derive(Clone, PartialEq, Debug)]
pub struct Name {
    /// The letter; `omega` for ω, `alpha` for α.
    pub letter: &'static str,
    /// The index, such as `G/C` or `bar`; may be empty.
    pub index: String,
    /// `+` just after, `-` just before, or nothing.
    pub mark: &'static str,
    /// Whether an arrow stands above.
    pub vector: bool,
}

impl Name {
    /// The letter as it is printed.
    pub fn glyph(&self) -> &'static str {
        match self.letter {
            "omega" => "ω",
            "alpha" => "α",
            other => other,
        }
    }
}

/// Two sides that are equal.
#[derive(Clone, PartialEq, Debug)]
pub struct Claim {
    /// Left side.
    pub left: Expr,
    /// Right side.
    pub right: Expr,
}

impl Claim {
    /// Both sides.
    pub fn new(left: Expr, right: Expr) -> Claim {
        Claim { left, right }
    }
}

/// A step of the solution.
#[derive(Clone, Debug)]
pub struct Step {
    /// Stable within the solution: `1`, `2`, …, substeps `2.1`.
    pub id: String,
    /// What is used: equations claimed earlier.
    pub before: Vec<Claim>,
    /// What follows.
    pub after: Vec<Claim>,
    /// Why.
    pub reason: String,
    /// Name of the scope its symbols belong to; `None` for the whole solution.
    pub scope: Option<String>,
    /// What must hold for the step.
    pub assumptions: Vec<String>,
    /// What must be ≥ 0 for the step alone.
    pub needs: Vec<Expr>,
    /// The step in smaller steps.
    pub substeps: Vec<Step>,
    /// The symbol the step introduces as an abbreviation, if it does.
    pub defines: Option<Symbol>,
    /// What stands for a formula close to a value of a parameter.
    pub near: Vec<Near>,
}

/// Writes the solution of everything a scene asks.
pub fn write(scene: &Scene, told: &Told, detail: Detail) -> Solution {
    let mut solution = match told.alone() {
        Some(impact) => lone(scene, told, impact, detail),
        None => story::tell(scene, told, detail),
    };
    solution.explain(scene, &told.unused);
    solution.round(opening::AXES);
    opening::set_axes(&mut solution);
    solution
}

/// The solution of a scene that is one impact and nothing else.
fn lone(scene: &Scene, told: &Told, impact: &Case, detail: Detail) -> Solution {
    let mut writer = Writer::new(scene, &impact.derivation, &impact.proof, detail);
    let decided = scene.decided().flat_map(|(_, d)| d.excesses());
    writer.solution.needs = decided.map(|(excess, _)| excess).collect();
    writer.opening();
    writer.blocks();
    writer.results();
    if detail == Detail::Brief {
        writer.checked();
    }
    asked::beyond_motion(&mut writer.solution, scene, &told.answers);
    if !scene.plots.is_empty() {
        writer.push(Part::Figure(Slot::Plot));
    }
    if detail != Detail::Brief {
        writer.notice();
        writer.checked();
    }
    writer.solution
}

/// Where a problem comes from, unless that is its title.
fn source(scene: &Scene) -> String {
    match scene.source == scene.title {
        true => String::new(),
        false => scene.source.clone(),
    }
}

/// What the contact with friction does, in a scene whose case is decided.
fn decided(scene: &Scene) -> Option<Mode> {
    scene.decided().map(|(_, decided)| decided.mode).next()
}
