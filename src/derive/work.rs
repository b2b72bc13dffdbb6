//! A derivation under way: plans are tried, blocks of laws solved, and values kept for what comes next.
//!
//! In: a scene. Out: values of unknowns as elements of the field, and the blocks they come from. The choice of laws is the
//! affair of [`super::plan`].

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use super::compact::Parts;
use super::plan::{self, Planner};
use super::steps;
use super::{
    Block, Counting, Definition, Derivation, Equation, LONGEST, LONGEST_OF_TWO, Names, Reduction,
    Solved, Stop, TRIED, WORK,
};
use crate::algebra::{self, Element, Field, Row};
use crate::expr::Expr;
use crate::laws::{self, Affine, Geometry, Kinematics, Law, Unknown};
use crate::scene::Scene;

/// Arms and positions of a larger size than this are written anew before laws are made of them: those of a chain are sums
/// over all its members.
const SHORT: usize = 8;

/// A law as it stands before anything already solved is put in.
struct Written {
    pub(super) law: Law,
    pub(super) terms: Vec<(Unknown, Element)>,
    pub(super) known: Element,
}

/// Rows to solve, and the laws they come from.
type System = (Vec<Row>, Vec<Written>);

/// The state of a derivation under way.
pub(super) struct Work<'a> {
    pub(super) scene: &'a Scene,
    pub(super) field: Field,
    pub(super) names: Names,
    pub(super) reduction: Reduction,
    pub(super) g: Geometry<Expr>,
    /// Motion after in terms of what the joints leave free.
    pub(super) reduced: Kinematics<Expr>,
    pub(super) planner: Option<Planner>,
    pub(super) values: BTreeMap<Unknown, Element>,
    pub(super) given: Vec<Unknown>,
    pub(super) blocks: Vec<Block>,
    /// Definitions of solutions found step by step.
    pub(super) definitions: Vec<Definition>,
    pub(super) in_steps: bool,
    /// The unknowns in named parts, where solving the equations and multiplying out would only make them longer.
    pub(super) parts: Option<Parts>,
    /// Velocities after of bodies in the components that questions name.
    pub(super) in_components: BTreeMap<usize, [Element; 2]>,
}

impl<'a> Work<'a> {
    pub(super) fn new(scene: &'a Scene) -> Result<Work<'a>, Stop> {
        let mut field = Field::new(&scene.domains);
        let formulas = formulas(scene);
        field.prepare(formulas.iter());
        let short = |field: &mut Field, e: &Expr| match e.size() > SHORT {
            true => field.element(e).map_or(e.clone(), |x| field.stored(&x)),
            false => e.clone(),
        };
        let exact = |e: &Expr| Ok::<_, std::convert::Infallible>(short(&mut field, e));
        let Ok(g) = Geometry::of(scene, exact);
        let reduction = plan::reduction(scene);
        let mut reduced = reduction.kinematics(scene, &g);
        let forms = reduced.velocity.iter_mut().flatten();
        for (_, k) in forms.flat_map(|form| &mut form.terms) {
            *k = short(&mut field, k);
        }
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
            parts: None,
            in_components: BTreeMap::new(),
        };
        work.take_givens()?;
        Ok(work)
    }

    /// What can be said of a scene whose equations contradict each other: that they do.
    pub(super) fn without_answers(self, counting: Counting) -> Result<Derivation, Stop> {
        Ok(Derivation {
            counting,
            names: self.names,
            given: Vec::new(),
            blocks: Vec::new(),
            definitions: Vec::new(),
            answers: Vec::new(),
            motion: BTreeMap::new(),
            named: BTreeMap::new(),
            in_steps: false,
            left_out: Vec::new(),
            assumptions: Vec::new(),
            field: Arc::new(Mutex::new(self.field)),
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
    pub(super) fn reduced_unknowns(&self) -> Vec<Unknown> {
        let attached = |b: usize| self.reduction.tree.iter().any(|link| link.body == b);
        let mut all = laws::unknowns(self.scene);
        all.retain(|u| !matches!(u, Unknown::Velocity(b, _) if attached(*b)));
        all
    }

    /// Makes sure that all targets have a closed form.
    pub(super) fn determine(
        &mut self,
        targets: &[Unknown],
        asked_by: Option<&str>,
    ) -> Result<(), Stop> {
        for &target in targets {
            if self.values.contains_key(&target) {
                continue;
            }
            let mut solved = self.try_plans(target, asked_by)?;
            if !solved && target.is_impulse() {
                // An impulse follows from its body's balance once the motion is known.
                let known = |u: Unknown| self.values.contains_key(&u);
                let planner = self.planner.as_ref();
                if let Some((laws, unknowns)) = planner.and_then(|p| p.without_impulses(&known)) {
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
        for way in plan::WAYS {
            let known = |u: Unknown| self.values.contains_key(&u);
            let Some(planner) = &self.planner else {
                break;
            };
            let Some(plan) = planner.plan(way, target, &known) else {
                continue;
            };
            let mut solved = true;
            for (laws, unknowns) in planner.pieces(plan, &known) {
                solved = solved && self.solve(&laws, &unknowns, asked_by)?;
            }
            if solved || self.values.contains_key(&target) {
                return Ok(self.values.contains_key(&target));
            }
        }
        Ok(false)
    }

    /// Solves laws for unknowns; false where they do not determine them all after all.
    pub(super) fn solve(
        &mut self,
        laws: &[Law],
        unknowns: &[Unknown],
        asked_by: Option<&str>,
    ) -> Result<bool, Stop> {
        if self.parts.is_some() {
            return self.take_parts(laws, unknowns, asked_by);
        }
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
        if self.in_steps {
            self.field.limit(TRIED);
        }
        let solved = algebra::solve(&self.field, &rows, unknowns.len());
        if self.in_steps {
            self.field.limit(WORK);
        }
        let solution = match solved {
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
            let contradicts = || Stop::Contradiction(laws::describe(self.scene, &laws[row]));
            return self.in_steps.then_some(false).ok_or_else(contradicts);
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

    /// The values of unknowns that are known in named parts; false where a law holds others.
    fn take_parts(
        &mut self,
        laws: &[Law],
        unknowns: &[Unknown],
        asked_by: Option<&str>,
    ) -> Result<bool, Stop> {
        let Some((_, equations)) = self.system(laws, unknowns)? else {
            return Ok(false);
        };
        for unknown in unknowns {
            let value = self.parts.as_ref().and_then(|p| p.value(*unknown));
            let Some(value) = value.cloned() else {
                return Ok(false);
            };
            let value = self.field.element(&value)?;
            self.values.insert(*unknown, value);
        }
        self.push_block(equations, unknowns, Vec::new(), asked_by);
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

    /// Whether the closed forms are of a length somebody could want to see.
    fn is_printable(&self, values: &[Option<Element>]) -> bool {
        values.iter().flatten().all(|v| v.size() <= self.longest())
    }

    /// Most terms of a closed form. The general case of two bodies has a short form of its own, made from a long one.
    pub(super) fn longest(&self) -> usize {
        match self.has_two_bodies() {
            true => LONGEST_OF_TWO,
            false => LONGEST,
        }
    }

    /// Whether all that happens is one contact between otherwise free bodies.
    pub(super) fn has_two_bodies(&self) -> bool {
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
        let solution = unknowns.iter().map(|u| self.solved(*u)).collect();
        let equations = equations.into_iter();
        let equations = equations.map(|e| self.written(e.law, &e.terms, &e.known));
        let equations = equations.collect();
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
    pub(super) fn row(
        &mut self,
        law: &Law,
        unknowns: &[Unknown],
    ) -> Result<Option<(Row, (Vec<(Unknown, Element)>, Element))>, Stop> {
        let linear = laws::symbolic(self.scene, &self.g, &self.reduced, law);
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
        let mut held = laws::of(self.scene);
        held.retain(|law| match law {
            Law::Hinged(..) | Law::Sticking(..) => self.reduction.loops.contains(law),
            _ => true,
        });
        let mut unknowns = self.reduced_unknowns();
        unknowns.retain(|u| !self.values.contains_key(u));
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
                printed.push(Solved::Closed(self.symbol_element(unknown, &value)));
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

    /// The value of the symbol of an unknown that has one, to be written when it is shown.
    fn solved(&self, unknown: Unknown) -> Solved {
        match self.parts.as_ref().and_then(|p| p.closed(unknown)) {
            Some(closed) => Solved::Written(self.names.signed(unknown, closed)),
            None => Solved::Closed(self.symbol_element(unknown, &self.values[&unknown])),
        }
    }

    fn symbol_element(&self, unknown: Unknown, value: &Element) -> Element {
        match self.names.is_reversed(unknown) {
            true => self.field.neg(value),
            false => value.clone(),
        }
    }

    /// The value of an unknown's symbol.
    pub(super) fn symbol_value(&self, unknown: Unknown, value: &Element) -> Expr {
        self.field.expr(&self.symbol_element(unknown, value))
    }

    /// An equation as a person writes it: in the scene's symbols, and not with minus signs alone on the left.
    pub(super) fn written(
        &self,
        law: Law,
        terms: &[(Unknown, Element)],
        known: &Element,
    ) -> Equation {
        let symbols: Vec<(Unknown, Element)> = terms
            .iter()
            .map(|(u, k)| (*u, self.symbol_element(*u, k)))
            .collect();
        let print = |negate: bool, x: &Element| {
            if negate {
                self.field.expr(&self.field.neg(x))
            } else {
                self.field.expr(x)
            }
        };
        let mut terms: Vec<(Unknown, Expr)> =
            symbols.iter().map(|(u, k)| (*u, print(false, k))).collect();
        let all_minus = terms.iter().all(|(_, k)| k.begins_with_minus());
        if all_minus {
            for ((_, k), (_, x)) in terms.iter_mut().zip(&symbols) {
                *k = print(true, x);
            }
        }
        Equation {
            law,
            terms,
            known: print(all_minus, known),
        }
    }

    /// Lets every unknown with a closed form of some length stand for a definition, and begins to count work anew.
    pub(super) fn name_values(&mut self) {
        self.in_steps = true;
        self.field.limit(WORK);
        if let Some(parts) = self.parts.take() {
            self.definitions.extend(parts.definitions());
        }
        let long: Vec<Unknown> = self
            .values
            .iter()
            .filter(|(_, v)| v.size() > 8)
            .map(|(u, _)| *u)
            .collect();
        for unknown in long {
            let value = self.symbol_value(unknown, &self.values[&unknown]);
            let symbol = Expr::symbol(self.names.plain(unknown));
            let signed = self.names.signed(unknown, symbol.clone());
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
    pub(super) fn element_of(&mut self, form: &Affine<Expr>) -> Result<Option<Element>, Stop> {
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
    pub(super) fn unknowns_in(&mut self, form: &Affine<Expr>) -> Result<Vec<Unknown>, Stop> {
        let mut found = Vec::new();
        for (unknown, k) in &form.terms {
            let k = self.field.element(k)?;
            if !self.field.is_zero(&k) {
                found.push(*unknown);
            }
        }
        Ok(found)
    }

    /// Closed form of every unknown of the full description that has one, for the proof.
    pub(super) fn motion(&mut self) -> Result<BTreeMap<Unknown, Expr>, Stop> {
        let mut motion = BTreeMap::new();
        for unknown in laws::unknowns(self.scene) {
            if let Some(closed) = self.parts.as_ref().and_then(|p| p.closed(unknown)) {
                motion.insert(unknown, closed);
                continue;
            }
            let value = match unknown {
                Unknown::Velocity(b, axis) => {
                    let form = self.reduced.velocity[b][axis].clone();
                    self.element_of(&form)?
                }
                _ => self.values.get(&unknown).cloned(),
            };
            if let Some(value) = value {
                motion.insert(unknown, self.field.stored(&value));
            }
        }
        Ok(motion)
    }
}

/// Every formula of the scene that the laws use.
pub(super) fn formulas(scene: &Scene) -> Vec<Expr> {
    let mut all: Vec<Expr> = Vec::new();
    let Ok(_) = Geometry::of(scene, |e| {
        all.push(e.clone());
        Ok::<_, std::convert::Infallible>(e.clone())
    });
    for question in scene.asked_of_impact() {
        all.extend(question.ask.vectors().into_iter().flatten().cloned());
    }
    all
}
