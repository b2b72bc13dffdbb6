//! From a scene to closed forms: picks the fewest laws that answer each question, solves them, and records every block
//! of equations with its unknowns, what was divided by, and what was left out and why.
//!
//! Comes in: a [`Scene`]. Goes out: a [`Derivation`], which claims and does not prove; `verify` puts every closed form
//! back into every law and holds it against the independent numeric solution. This module knows no numbers but exact ones
//! (doubles plan, they never decide) and no output format.

mod answer;
mod compact;
mod count;
mod left_out;
mod names;
mod plan;
mod steps;

use std::collections::BTreeMap;
use std::fmt;

use num_integer::Integer;

pub use answer::{Answer, Form, Matrix, dimension, full_matrix};
pub use count::{Counting, count};
pub use left_out::LeftOut;
pub use names::Names;
pub use plan::{Attachment, Reduction, reduction};

use crate::algebra::{self, Element, Field, Row, Sign};
use crate::expr::{Expr, Int, Node, Rational, Symbol, Vector};
use crate::laws::{self, Affine, Geometry, Kinematics, Law, Unknown};
use crate::scene::{ContactLaw, Scene};
use plan::Planner;

/// Most terms of a closed form that is printed as one formula; longer ones are given step by step. About a page.
const LONGEST: usize = 160;

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
    /// Whether some unknowns stand for definitions because their closed forms are too long to be multiplied out.
    pub in_steps: bool,
    /// What the scene did not need.
    pub left_out: Vec<LeftOut>,
    /// What must hold for the answers: expressions that must not vanish, and signs that were seen rather than proved.
    pub assumptions: Vec<String>,
}

/// Some equations solved together.
#[derive(Clone, Debug)]
pub struct Block {
    /// The equations.
    pub equations: Vec<Equation>,
    /// What they determine.
    pub unknowns: Vec<Unknown>,
    /// The values of the unknowns' symbols, in the order of `unknowns`.
    pub solution: Vec<Expr>,
    /// Expressions divided by that are not known to keep away from zero.
    pub divided_by: Vec<Expr>,
    /// Name of the question that needed the block; `None` for the completion that only the proof uses.
    pub asked_by: Option<String>,
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
    /// Laws and givens contradict each other; the words name the law at which it shows.
    Contradiction(String),
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Stop::Limit(what) => write!(f, "stopped at a limit: {what}"),
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
        Stop::Limit(stop.to_string())
    }
}

/// Answers every question of a scene. Unknowns that the laws do not determine have no closed form, and questions that
/// need one are left without an answer; `counting` says so.
pub fn derive(scene: &Scene) -> Result<Derivation, Stop> {
    let counting = count(scene)?;
    let mut work = Work::new(scene)?;
    if counting.contradictory {
        return work.without_answers(counting);
    }
    for question in &scene.questions {
        let needed = work.unknowns_of(&question.ask)?;
        if needed.iter().all(|u| counting.is_unique(*u)) {
            work.determine(&needed, Some(&question.name))?;
        }
    }
    let asked = work.blocks.len();
    let rest: Vec<Unknown> = work
        .reduced_unknowns()
        .into_iter()
        .filter(|u| counting.is_unique(*u))
        .collect();
    work.determine(&rest, None)?;
    let mut definitions = Vec::new();
    let mut answers = match work.answers(&counting) {
        // Sums and squares of long closed forms: from here on the unknowns stand for themselves.
        Err(Stop::Limit(_)) => {
            work.name_values();
            work.answers(&counting)?
        }
        outcome => outcome?,
    };
    compact::shorten(&mut work, &mut answers, &mut definitions)?;
    let motion = work.motion()?;
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
        in_steps: work.in_steps,
        left_out,
        assumptions,
    })
}

/// A law as it stands before anything already solved is put in.
struct Written {
    law: Law,
    terms: Vec<(Unknown, Element)>,
    known: Element,
}

/// Rows to solve, and the laws they come from.
type System = (Vec<Row>, Vec<Written>);

/// The state of a derivation under way.
struct Work<'a> {
    scene: &'a Scene,
    field: Field,
    names: Names,
    reduction: Reduction,
    g: Geometry<Expr>,
    /// Motion after in terms of what the joints leave free.
    reduced: Kinematics<Expr>,
    planner: Option<Planner>,
    values: BTreeMap<Unknown, Element>,
    given: Vec<Unknown>,
    blocks: Vec<Block>,
    /// Definitions of solutions found step by step.
    definitions: Vec<Definition>,
    in_steps: bool,
}

impl<'a> Work<'a> {
    fn new(scene: &'a Scene) -> Result<Work<'a>, Stop> {
        let mut field = Field::new(&scene.domains);
        let formulas = formulas(scene);
        field.prepare(formulas.iter());
        let Ok(g) = Geometry::of(scene, |e| Ok::<_, std::convert::Infallible>(e.clone()));
        let reduction = plan::reduction(scene);
        let reduced = reduction.kinematics(scene, &g);
        let planner = Planner::new(scene, &reduction);
        let names = Names::of(scene);
        let mut work = Work {
            scene,
            field,
            names,
            reduction,
            g,
            reduced,
            planner,
            values: BTreeMap::new(),
            given: Vec::new(),
            blocks: Vec::new(),
            definitions: Vec::new(),
            in_steps: false,
        };
        work.take_givens()?;
        Ok(work)
    }

    /// What can be said of a scene whose equations contradict each other: that they do.
    fn without_answers(self, counting: Counting) -> Result<Derivation, Stop> {
        Ok(Derivation {
            counting,
            names: self.names,
            given: Vec::new(),
            blocks: Vec::new(),
            definitions: Vec::new(),
            answers: Vec::new(),
            motion: BTreeMap::new(),
            in_steps: false,
            left_out: Vec::new(),
            assumptions: Vec::new(),
        })
    }

    /// What is given of the motion after and speaks of a single unknown is data, not an equation.
    fn take_givens(&mut self) -> Result<(), Stop> {
        let unknowns = self.reduced_unknowns();
        for k in 0..self.scene.after.len() {
            let Some((row, _)) = self.row(&Law::Given(k), &unknowns)? else {
                continue;
            };
            if let [(column, factor)] = row.coeffs.as_slice() {
                let value = self.field.div(&row.rhs, factor)?;
                self.values.insert(unknowns[*column], value);
                self.given.push(unknowns[*column]);
            }
        }
        Ok(())
    }

    /// The unknowns of the reduced description: free velocities and spins, then impulses.
    fn reduced_unknowns(&self) -> Vec<Unknown> {
        let attached = |b: usize| self.reduction.tree.iter().any(|link| link.body == b);
        let mut all = laws::unknowns(self.scene);
        all.retain(|u| !matches!(u, Unknown::Velocity(b, _) if attached(*b)));
        all
    }

    /// Makes sure that all targets have a closed form.
    fn determine(&mut self, targets: &[Unknown], asked_by: Option<&str>) -> Result<(), Stop> {
        for &target in targets {
            if self.values.contains_key(&target) {
                continue;
            }
            let mut solved = self.try_plans(target, asked_by)?;
            if !solved && target.is_impulse() {
                // An impulse follows from its body's balance once the motion is known.
                let known = |u: Unknown| self.values.contains_key(&u);
                if let Some((laws, unknowns)) = self
                    .planner
                    .as_ref()
                    .and_then(|p| p.without_impulses(&known))
                {
                    solved = self.solve(&laws, &unknowns, asked_by)?
                        && self.try_plans(target, asked_by)?;
                }
            }
            if !solved {
                self.solve_everything(asked_by)?;
            }
        }
        Ok(())
    }

    /// Solves the first plan that determines a target; false where none does.
    fn try_plans(&mut self, target: Unknown, asked_by: Option<&str>) -> Result<bool, Stop> {
        for plan in self.plans(target) {
            let known = |u: Unknown| self.values.contains_key(&u);
            let pieces = match &self.planner {
                Some(planner) => planner.pieces(plan, &known),
                None => vec![plan],
            };
            let mut solved = true;
            for (laws, unknowns) in pieces {
                solved = solved && self.solve(&laws, &unknowns, asked_by)?;
            }
            if solved {
                return Ok(self.values.contains_key(&target));
            }
        }
        Ok(false)
    }

    /// Ways to determine a target, best first.
    fn plans(&self, target: Unknown) -> Vec<(Vec<Law>, Vec<Unknown>)> {
        let Some(planner) = &self.planner else {
            return Vec::new();
        };
        let known = |u: Unknown| self.values.contains_key(&u);
        let mut plans = Vec::new();
        plans.extend(planner.closing(&[target], &known));
        let impulse_first = planner.impulse_first(target, &known);
        if let Some(plan) = impulse_first {
            // With many equations either way, the impulse first and the rest in terms of it reads better.
            let at = usize::from(
                plans
                    .first()
                    .is_some_and(|p| p.0.len() < 4 && p.0.len() <= plan.0.len()),
            );
            plans.insert(at.min(plans.len()), plan);
        }
        if !target.is_impulse() {
            plans.extend(planner.without_impulses(&known));
        }
        plans
    }

    /// Solves laws for unknowns; false where they do not determine them all after all.
    fn solve(
        &mut self,
        laws: &[Law],
        unknowns: &[Unknown],
        asked_by: Option<&str>,
    ) -> Result<bool, Stop> {
        let system = match self.system(laws, unknowns) {
            // Products with long closed forms: from here on these stand for themselves.
            Err(Stop::Limit(_)) => {
                self.name_values();
                self.system(laws, unknowns)?
            }
            outcome => outcome?,
        };
        let Some((rows, equations)) = system else {
            return Ok(false);
        };
        let solution = match algebra::solve(&self.field, &rows, unknowns.len()) {
            Ok(solution) if self.is_printable(&solution.values) => solution,
            Ok(solution) if solution.contradiction.is_some() => solution,
            outcome => {
                self.name_values();
                if let Some((rows, equations)) = self.system(laws, unknowns)?
                    && steps::solve(self, &rows, unknowns)?
                {
                    self.push_block(equations, unknowns, Vec::new(), asked_by);
                    return Ok(true);
                }
                outcome?
            }
        };
        if let Some(row) = solution.contradiction {
            // An unknown that stands for itself hides that a law follows from the others.
            return if self.in_steps {
                Ok(false)
            } else {
                Err(Stop::Contradiction(laws::describe(self.scene, &laws[row])))
            };
        }
        if solution.values.iter().any(Option::is_none) {
            return Ok(false);
        }
        for (unknown, value) in unknowns.iter().zip(solution.values.into_iter().flatten()) {
            self.values.insert(*unknown, value);
        }
        let divided_by = self.divisors(&solution.divisors)?;
        self.push_block(equations, unknowns, divided_by, asked_by);
        Ok(true)
    }

    /// Laws as rows over unknowns, and as they stand before anything is put in; `None` where one holds other unknowns.
    fn system(&mut self, laws: &[Law], unknowns: &[Unknown]) -> Result<Option<System>, Stop> {
        let mut rows = Vec::with_capacity(laws.len());
        let mut equations = Vec::with_capacity(laws.len());
        for law in laws {
            let Some((row, (terms, known))) = self.row(law, unknowns)? else {
                return Ok(None);
            };
            rows.push(row);
            equations.push(Written {
                law: law.clone(),
                terms,
                known,
            });
        }
        Ok(Some((rows, equations)))
    }

    /// Whether the closed forms are of a length somebody could want to see. The general case of two bodies has a short
    /// form of its own, however long it is multiplied out.
    fn is_printable(&self, values: &[Option<Element>]) -> bool {
        self.has_two_bodies() || values.iter().flatten().all(|v| v.size() <= LONGEST)
    }

    /// Whether all that happens is one contact between otherwise free bodies.
    fn has_two_bodies(&self) -> bool {
        let scene = self.scene;
        scene.contacts.len() == 1 && scene.hinges.is_empty() && scene.blows.is_empty()
    }

    /// Records a solved block. One that only the proof needs is not written out.
    fn push_block(
        &mut self,
        equations: Vec<Written>,
        unknowns: &[Unknown],
        divided_by: Vec<Expr>,
        asked_by: Option<&str>,
    ) {
        if asked_by.is_none() {
            return;
        }
        let solution = unknowns
            .iter()
            .map(|u| self.symbol_value(*u, &self.values[u]))
            .collect();
        let equations = equations
            .into_iter()
            .map(|e| self.written(e.law, &e.terms, &e.known))
            .collect();
        self.blocks.push(Block {
            equations,
            unknowns: unknowns.to_vec(),
            solution,
            divided_by,
            asked_by: asked_by.map(str::to_string),
        });
    }

    /// A law as a row over `unknowns`, with everything already solved put in; also as it stands before that, for
    /// printing. `None` where it holds an unknown that is neither.
    #[allow(clippy::type_complexity)]
    fn row(
        &mut self,
        law: &Law,
        unknowns: &[Unknown],
    ) -> Result<Option<(Row, (Vec<(Unknown, Element)>, Element))>, Stop> {
        let direction = |v: &Vector| Ok::<_, std::convert::Infallible>(v.clone());
        let Ok(linear) = laws::equation(self.scene, &self.g, &self.reduced, law, direction);
        let mut rhs = self.field.element(&linear.known)?;
        let known = rhs.clone();
        let mut coeffs = Vec::with_capacity(linear.terms.len());
        let mut terms = Vec::with_capacity(linear.terms.len());
        for (unknown, k) in &linear.terms {
            let k = self.field.element(k)?;
            if self.field.is_zero(&k) {
                continue;
            }
            terms.push((*unknown, k.clone()));
            if let Some(value) = self.values.get(unknown) {
                let moved = self.field.mul(&k, value)?;
                rhs = self.field.sub(&rhs, &moved)?;
            } else if let Some(column) = unknowns.iter().position(|u| u == unknown) {
                coeffs.push((column, k));
            } else {
                return Ok(None);
            }
        }
        Ok(Some((Row { coeffs, rhs }, (terms, known))))
    }

    /// The last resort: all laws of the reduced description at once.
    fn solve_everything(&mut self, asked_by: Option<&str>) -> Result<(), Stop> {
        let held: Vec<Law> = laws::of(self.scene)
            .into_iter()
            .filter(|law| match law {
                Law::Hinged(..) | Law::Sticking(..) => self.reduction.loops.contains(law),
                _ => true,
            })
            .collect();
        let unknowns: Vec<Unknown> = self
            .reduced_unknowns()
            .into_iter()
            .filter(|u| !self.values.contains_key(u))
            .collect();
        let mut rows = Vec::new();
        let mut equations = Vec::new();
        for law in held {
            if let Some((row, (terms, known))) = self.row(&law, &unknowns)?
                && !row.coeffs.is_empty()
            {
                rows.push(row);
                equations.push(self.written(law, &terms, &known));
            }
        }
        let mut solution = algebra::solve(&self.field, &rows, unknowns.len())?;
        while let Some(row) = solution.contradiction {
            if !self.in_steps {
                return Err(Stop::Contradiction(laws::describe(
                    self.scene,
                    &equations[row].law,
                )));
            }
            // Counting has shown that nothing contradicts; an unknown that stands for itself hides that this law
            // follows from the others.
            rows.remove(row);
            equations.remove(row);
            solution = algebra::solve(&self.field, &rows, unknowns.len())?;
        }
        let divided_by = self.divisors(&solution.divisors)?;
        let mut found = Vec::new();
        let mut printed = Vec::new();
        for (unknown, value) in unknowns.into_iter().zip(solution.values) {
            if let Some(value) = value {
                found.push(unknown);
                printed.push(self.symbol_value(unknown, &value));
                self.values.insert(unknown, value);
            }
        }
        self.blocks.push(Block {
            equations,
            unknowns: found,
            solution: printed,
            divided_by,
            asked_by: asked_by.map(str::to_string),
        });
        Ok(())
    }

    /// The value of an unknown's symbol.
    fn symbol_value(&self, unknown: Unknown, value: &Element) -> Expr {
        if self.names.is_reversed(unknown) {
            self.field.expr(&self.field.neg(value))
        } else {
            self.field.expr(value)
        }
    }

    /// An equation as a person writes it: in the scene's symbols, and not with minus signs alone on the left.
    fn written(&self, law: Law, terms: &[(Unknown, Element)], known: &Element) -> Equation {
        let symbols: Vec<(Unknown, Element)> = terms
            .iter()
            .map(|(u, k)| {
                let reversed = self.names.is_reversed(*u);
                (
                    *u,
                    if reversed {
                        self.field.neg(k)
                    } else {
                        k.clone()
                    },
                )
            })
            .collect();
        let print = |negate: bool, x: &Element| {
            if negate {
                self.field.expr(&self.field.neg(x))
            } else {
                self.field.expr(x)
            }
        };
        let minus = |x: &Element| crate::formula::write_plain(&print(false, x)).starts_with('-');
        let all_minus = symbols.iter().all(|(_, k)| minus(k));
        Equation {
            law,
            terms: symbols
                .iter()
                .map(|(u, k)| (*u, print(all_minus, k)))
                .collect(),
            known: print(all_minus, known),
        }
    }

    /// Lets every unknown with a closed form of some length stand for a definition.
    fn name_values(&mut self) {
        self.in_steps = true;
        let long: Vec<Unknown> = self
            .values
            .iter()
            .filter(|(_, v)| v.size() > 8)
            .map(|(u, _)| *u)
            .collect();
        for unknown in long {
            let value = self.symbol_value(unknown, &self.values[&unknown]);
            let symbol = Expr::symbol(self.names.plain(unknown));
            let signed = if self.names.is_reversed(unknown) {
                -&symbol
            } else {
                symbol.clone()
            };
            // A symbol is within every limit.
            if let (Ok(element), Some(name)) = (self.field.element(&signed), symbol.as_symbol()) {
                let meaning = String::from("as solved above");
                self.definitions.push(Definition {
                    name: name.clone(),
                    value,
                    meaning,
                });
                self.values.insert(unknown, element);
            }
        }
    }

    /// An affine form with the closed forms put in.
    fn element_of(&mut self, form: &Affine<Expr>) -> Result<Option<Element>, Stop> {
        let mut total = self.field.element(&form.constant)?;
        for (unknown, k) in &form.terms {
            let k = self.field.element(k)?;
            if self.field.is_zero(&k) {
                continue;
            }
            let Some(value) = self.values.get(unknown) else {
                return Ok(None);
            };
            let term = self.field.mul(&k, value)?;
            total = self.field.add(&total, &term)?;
        }
        Ok(Some(total))
    }

    /// The unknowns that occur in a form with a coefficient that is not zero.
    fn unknowns_in(&mut self, form: &Affine<Expr>) -> Result<Vec<Unknown>, Stop> {
        let mut found = Vec::new();
        for (unknown, k) in &form.terms {
            let k = self.field.element(k)?;
            if !self.field.is_zero(&k) {
                found.push(*unknown);
            }
        }
        Ok(found)
    }

    /// Closed form of every unknown of the full description that has one.
    fn motion(&mut self) -> Result<BTreeMap<Unknown, Expr>, Stop> {
        let mut motion = BTreeMap::new();
        for unknown in laws::unknowns(self.scene) {
            let value = match unknown {
                Unknown::Velocity(b, axis) => {
                    let form = self.reduced.velocity[b][axis].clone();
                    self.element_of(&form)?
                }
                _ => self.values.get(&unknown).cloned(),
            };
            if let Some(value) = value {
                motion.insert(unknown, self.field.expr(&value));
            }
        }
        Ok(motion)
    }

    /// The determinant of a block, where nothing shows that it keeps away from zero. Joints in a tree and one contact
    /// need no such condition: their equations are those of a quadratic form, the kinetic energy, that is positive for
    /// positive masses.
    fn divisors(&mut self, divisors: &[Element]) -> Result<Vec<Expr>, Stop> {
        let scene = self.scene;
        let mut positive = true;
        for body in scene.bodies.iter().filter(|b| !b.is_fixed()) {
            positive &= self.is_positive(&body.mass)
                && (body.is_particle() || self.is_positive(&body.inertia));
        }
        let contacts = scene
            .contacts
            .iter()
            .filter(|c| matches!(c.law, ContactLaw::Frictionless { .. }))
            .count();
        if positive && contacts <= 1 && self.reduction.loops.is_empty() && scene.after.is_empty() {
            return Ok(Vec::new());
        }
        let mut determinant = self.field.integer(1);
        for divisor in divisors {
            determinant = self.field.mul(&determinant, divisor)?;
        }
        Ok(match self.field.sign(&determinant) {
            Some(Sign::Positive | Sign::Negative) => Vec::new(),
            _ => vec![self.field.expr(&determinant)],
        })
    }

    /// What stands under square roots of the scene and is not known to have one.
    fn radicands(&mut self) -> Vec<Expr> {
        let mut found = Vec::new();
        for e in formulas(self.scene) {
            radicands(&e, &mut found);
        }
        found.retain(|base| {
            let known = self
                .field
                .element(base)
                .ok()
                .and_then(|x| self.field.sign(&x));
            !known.is_some_and(Sign::is_not_negative)
        });
        found
    }

    fn is_positive(&mut self, e: &Expr) -> bool {
        let element = self.field.element(e);
        element.is_ok_and(|x| self.field.sign(&x) == Some(Sign::Positive))
    }

    /// What the closed forms rest on: signs taken for roots, and conditions `… ≠ 0` under which the blocks were solved.
    fn assumptions(&mut self) -> Vec<String> {
        let sign = |a: &algebra::Assumption| match a {
            algebra::Assumption::NotNegative(e) => {
                format!("{} ≥ 0", crate::formula::write_plain(e))
            }
        };
        let mut all: Vec<String> = self.field.assumptions().iter().map(sign).collect();
        for base in self.radicands() {
            let condition = format!("{} ≥ 0", crate::formula::write_plain(&base));
            if !all.contains(&condition) {
                all.push(condition);
            }
        }
        let bouncing = self
            .scene
            .contacts
            .iter()
            .filter(|c| matches!(c.law, ContactLaw::Frictionless { .. }))
            .count();
        if bouncing > 1 {
            all.push(String::from(
                "all contacts act at the same instant, each with its own restitution (Newton); one after the other they could give another motion",
            ));
        }
        for divisor in self.blocks.iter().flat_map(|b| &b.divided_by) {
            let condition = format!("{} ≠ 0", crate::formula::write_plain(divisor));
            if !all.contains(&condition) {
                all.push(condition);
            }
        }
        all
    }
}

/// The bases of powers with an even root.
fn radicands(e: &Expr, found: &mut Vec<Expr>) {
    match e.node() {
        Node::Number(_) | Node::Symbol(_) => {}
        Node::Sum(parts) | Node::Product(parts) => parts.iter().for_each(|p| radicands(p, found)),
        Node::Power(base, exponent) => {
            let even = |k: &Rational| k.denom().is_multiple_of(&Int::from(2));
            if exponent.as_number().is_some_and(even) && !found.contains(base) {
                found.push(base.clone());
            }
            radicands(base, found);
        }
        Node::Call(_, argument) => radicands(argument, found),
    }
}

/// Every formula of the scene that the laws use.
fn formulas(scene: &Scene) -> Vec<Expr> {
    let mut all: Vec<Expr> = Vec::new();
    let Ok(_) = Geometry::of(scene, |e| {
        all.push(e.clone());
        Ok::<_, std::convert::Infallible>(e.clone())
    });
    for question in &scene.questions {
        all.extend(answer::formulas(question));
    }
    all
}
