//! From a scene to closed forms: picks the fewest laws that answer each question, solves them, and records every block
//! of equations with its unknowns, what was divided by, and what was left out and why.
//!
//! Comes in: a [`Scene`]. Goes out: a [`Derivation`], which claims and does not prove; `verify` puts every closed form
//! back into every law and holds it against the independent numeric solution. This module knows no numbers but exact ones
//! (doubles plan, they never decide) and no output format.

mod answer;
mod compact;
mod conditions;
mod count;
pub mod friction;
mod left_out;
mod names;
mod plan;
mod steps;
mod work;

use std::collections::BTreeMap;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

pub use answer::full_matrix;
pub use count::{Counting, count};
pub use left_out::LeftOut;
pub use names::Names;
pub use plan::{Attachment, Reduction, reduction};

use crate::algebra::{self, Element, Field};
use crate::answer::{Answer, Form, Known};
use crate::expr::{Expr, Symbol};
use crate::formula::Sentence;
use crate::laws::{Law, Unknown};
use crate::scene::Scene;
use work::Work;

/// Most terms of a closed form that is printed as one formula; longer ones are given step by step. About a page.
const LONGEST: usize = 160;
/// The same where two free bodies meet: their answers are long by nature.
const LONGEST_OF_TWO: usize = 1_200;

/// A moment in words, and the values of velocities and impulses then by the names that derivations give them.
pub type Moment = (String, BTreeMap<Symbol, Expr>);

/// Everything found out about a scene, ready to be proved and printed.
#[derive(Clone, Debug)]
pub struct Derivation {
    /// Equations, unknowns and rank of the full system.
    pub counting: Counting,
    /// Symbols of the unknowns.
    pub names: Names,
    /// Values of unknowns' symbols that the scene gives outright.
    pub given: Vec<(Unknown, Expr)>,
    /// The blocks of equations that answer the questions, in order of solution.
    pub blocks: Vec<Block>,
    /// Named common parts of long answers, each in terms of the ones before it.
    pub definitions: Vec<Definition>,
    /// Answers in the order of the questions, one per component.
    pub answers: Vec<Answer>,
    /// Closed form of every unknown that is determined, for the proof; those not asked for are not printed.
    pub motion: BTreeMap<Unknown, Expr>,
    /// The same in parameters and definitions, where an impact was given in named parts from the start; empty elsewhere.
    pub named: BTreeMap<Unknown, Expr>,
    /// Whether some unknowns stand for definitions because their closed forms are too long to be multiplied out.
    pub in_steps: bool,
    /// What the scene did not need.
    pub left_out: Vec<LeftOut>,
    /// What must hold for the answers: expressions that must not vanish, and signs that were seen rather than proved.
    pub assumptions: Vec<Sentence>,
    /// Writes the solutions of blocks.
    field: Arc<Mutex<Field>>,
}

impl Derivation {
    /// The values of the unknowns' symbols of a block, in the order of its `unknowns`, as a person would write them.
    pub fn solution(&self, block: &Block) -> Vec<Expr> {
        let field = self.field.lock().unwrap_or_else(PoisonError::into_inner);
        let written = block.solution.iter().map(|value| match value {
            Solved::Closed(value) => field.expr(value),
            Solved::Written(value) => value.clone(),
        });
        written.collect()
    }

    /// The motion just after and the impulses that are determined, each by the symbol that stands for it.
    pub fn motion_by_name(&self) -> impl Iterator<Item = (Unknown, Symbol, Expr)> {
        self.motion.iter().map(|(unknown, value)| {
            let value = self.names.signed(*unknown, value.clone());
            (*unknown, Symbol::from(self.names.plain(*unknown)), value)
        })
    }

    /// The answers, by name, in parameters alone.
    pub fn known(&self) -> Known {
        let mut known = BTreeMap::new();
        let mut defined = BTreeMap::new();
        if self.in_steps {
            for definition in &self.definitions {
                let value = definition.value.substitute(&defined);
                // Written out, a definition of a long chain may grow beyond use; what hangs on it is then not answered.
                if value.size() <= crate::answer::LONGEST {
                    defined.insert(definition.name.clone(), value);
                }
            }
        }
        for answer in &self.answers {
            if let Form::Value { closed, .. } = &answer.form {
                let value = closed.substitute(&defined);
                if value.size() <= crate::answer::LONGEST {
                    known.insert(Symbol::from(answer.name.as_str()), value);
                }
            }
        }
        known
    }
}

/// Some equations solved together.
#[derive(Clone, Debug)]
pub struct Block {
    /// The equations.
    pub equations: Vec<Equation>,
    /// What they determine.
    pub unknowns: Vec<Unknown>,
    /// The values of the unknowns' symbols, in the order of `unknowns`; [`Derivation::solution`] writes them.
    pub(crate) solution: Vec<Solved>,
    /// Expressions divided by that are not known to keep away from zero.
    pub divided_by: Vec<Expr>,
    /// Name of the question that needed the block; `None` for the completion that only the proof uses.
    pub asked_by: Option<String>,
}

/// A value of an unknown's symbol. Writing it well takes longer than solving, and most are never shown.
#[derive(Clone, Debug)]
pub(crate) enum Solved {
    Closed(Element),
    Written(Expr),
}

/// A law written out: Σ coefficient × symbol = known, with the symbols of [`Names`].
#[derive(Clone, Debug)]
pub struct Equation {
    /// The law.
    pub law: Law,
    /// Coefficients of the unknowns' symbols, as a person would write them.
    pub terms: Vec<(Unknown, Expr)>,
    /// Right side.
    pub known: Expr,
}

/// A named part of a long answer.
#[derive(Clone, Debug)]
pub struct Definition {
    /// Its symbol.
    pub name: Symbol,
    /// Its value, in parameters and earlier definitions.
    pub value: Expr,
    /// What it means.
    pub meaning: String,
}

/// Why a derivation stopped.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop {
    /// A limit of the algebra was met.
    Limit(String),
    /// Something is divided by what is zero whatever the parameters.
    DivisionByZero,
    /// Laws and givens contradict each other; the words name the law at which it shows.
    Contradiction(String),
    /// A law of friction has no answer, as beside something else that strikes; the words say why.
    NoAnswer(String),
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Stop::Limit(what) => write!(f, "stopped at a limit: {what}"),
            Stop::DivisionByZero => f.write_str("stopped at a limit: division by zero"),
            Stop::NoAnswer(why) => f.write_str(why),
            Stop::Contradiction(law) => write!(
                f,
                "the laws contradict each other: {law} cannot hold together with the others"
            ),
        }
    }
}

impl std::error::Error for Stop {}

impl From<algebra::Stop> for Stop {
    fn from(stop: algebra::Stop) -> Stop {
        match stop {
            algebra::Stop::DivisionByZero => Stop::DivisionByZero,
            limit => Stop::Limit(limit.to_string()),
        }
    }
}

/// Most work of a derivation before it goes on in steps, and of each step from there on, in products of terms: some tenths
/// of a second.
const WORK: u64 = 3_000_000;
/// Most work that a derivation in steps spends on solving some equations at once.
const TRIED: u64 = 300_000;

/// A piece of work; where closed forms are too large to multiply out, once more with the unknowns standing for themselves.
fn stepwise<T>(work: &mut Work, piece: impl Fn(&mut Work) -> Result<T, Stop>) -> Result<T, Stop> {
    match piece(work) {
        Err(Stop::Limit(_)) => {
            work.name_values();
            piece(work)
        }
        outcome => outcome,
    }
}

/// Answers every question of a scene. Unknowns that the laws do not determine have no closed form, and questions that
/// need one are left without an answer; `counting` says so.
pub fn derive(scene: &Scene) -> Result<Derivation, Stop> {
    let counting = count(scene)?;
    let mut work = Work::new(scene)?;
    work.field.limit(WORK);
    if counting.contradictory {
        return work.without_answers(counting);
    }
    work.parts = match compact::of_two(&mut work) {
        Err(Stop::Limit(_)) => None,
        outcome => outcome?,
    };
    for question in scene.asked_of_impact() {
        let needed = work.unknowns_of(&question.ask)?;
        if needed.iter().all(|u| counting.is_unique(*u)) {
            stepwise(&mut work, |work| {
                work.determine(&needed, Some(&question.name))
            })?;
        }
    }
    let asked = work.blocks.len();
    if work.parts.is_none() {
        let mut rest = work.reduced_unknowns();
        rest.retain(|u| counting.is_unique(*u));
        stepwise(&mut work, |work| work.determine(&rest, None))?;
    }
    let mut definitions = Vec::new();
    let mut answers = stepwise(&mut work, |work| work.answers(&counting))?;
    work.field.limit(WORK);
    let motion = work.motion()?;
    let named = work.parts.as_ref().map(compact::Parts::all);
    let plain = (answers.clone(), definitions.clone());
    match compact::shorten(&mut work, &mut answers, &mut definitions) {
        // What cannot be written shorter stays as it is.
        Err(Stop::Limit(_)) => (answers, definitions) = plain,
        outcome => outcome?,
    }
    let left_out = left_out::list(&work, &counting, asked);
    let assumptions = work.assumptions();
    let given = work
        .given
        .iter()
        .map(|u| (*u, work.symbol_value(*u, &work.values[u])))
        .collect();
    work.blocks.truncate(asked);
    Ok(Derivation {
        counting,
        names: work.names,
        given,
        blocks: work.blocks,
        definitions,
        answers,
        motion,
        named: named.unwrap_or_default(),
        in_steps: work.in_steps,
        left_out,
        assumptions,
        field: Arc::new(Mutex::new(work.field)),
    })
}
