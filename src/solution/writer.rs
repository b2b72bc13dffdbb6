//! A solution under way: the scene with its derivation, what stands on the page by now, and how lines and their claims get there.

use std::collections::{BTreeMap, BTreeSet};

use super::slip::Rough;
use super::words;
use super::{Claim, Detail, Inline, Line, Math, Meaning, Part, Solution, Step};
use crate::algebra::Field;
use crate::answer::Form;
use crate::derive::{self, Derivation, Reduction};
use crate::expr::{Expr, Symbol, Vector};
use crate::laws::{self, Affine, Geometry, Kinematics, Unknown};
use crate::scene::Scene;
use crate::verify::Proof;

/// A solution under way.
pub(super) struct Writer<'a> {
    pub(super) scene: &'a Scene,
    pub(super) d: &'a Derivation,
    pub(super) proof: &'a Proof,
    pub(super) field: Field,
    pub(super) g: Geometry<Expr>,
    pub(super) reduction: Reduction,
    pub(super) reduced: Kinematics<Expr>,
    pub(super) solution: Solution,
    /// Whether its sections are parts of a larger one.
    pub(super) depth: usize,
    /// What the ids of its steps begin with: that of the step they are parts of, and a point.
    pub(super) within: String,
    /// Answers and abbreviations that stand on the page already.
    pub(super) told: BTreeSet<Symbol>,
    /// Unknowns found to be zero: no later line carries them along.
    pub(super) zero: BTreeSet<Unknown>,
    /// Long roots with the letters they got.
    pub(super) roots: Vec<(Expr, Symbol)>,
    /// How the rough contact moves under its impulse, where that is told.
    pub(super) rough: Option<Rough>,
}

impl<'a> Writer<'a> {
    pub(super) fn new(
        scene: &'a Scene,
        derivation: &'a Derivation,
        proof: &'a Proof,
        detail: Detail,
    ) -> Writer<'a> {
        let g = Geometry::symbolic(scene);
        let reduction = derive::reduction(scene);
        let reduced = reduction.kinematics(scene, &g);
        let mut names = BTreeMap::new();
        let mut meanings = BTreeMap::new();
        for p in &scene.parameters {
            if let Some(latex) = p.latex.as_deref().filter(|l| words::is_safe_latex(l)) {
                names.insert(p.name.clone(), latex.to_string());
            }
        }
        for unknown in laws::unknowns(scene) {
            let symbol = Symbol::from(derivation.names.plain(unknown));
            let latex = derivation.names.latex(unknown);
            if words::is_safe_latex(latex) {
                names.insert(symbol.clone(), latex.to_string());
            }
            let reversed = derivation.names.is_reversed(unknown);
            meanings.insert(symbol, words::meaning(scene, unknown, reversed));
        }
        for answer in &derivation.answers {
            if matches!(answer.form, Form::Matrix(_) | Form::Equation { .. }) {
                continue;
            }
            let symbol = Symbol::from(answer.name.as_str());
            let axis = answer.axis();
            if words::is_safe_latex(&answer.latex) {
                names
                    .entry(symbol.clone())
                    .or_insert_with(|| answer.latex.clone());
            }
            meanings
                .entry(symbol)
                .or_insert_with(|| Meaning::Answer(answer.question.clone(), axis));
        }
        // A vector has a name of its own beside those of its components.
        for question in scene.asked_of_impact() {
            if let Some(latex) = question
                .latex
                .as_deref()
                .filter(|l| words::is_safe_latex(l))
            {
                names
                    .entry(Symbol::from(question.name.as_str()))
                    .or_insert_with(|| latex.to_string());
            }
        }
        let given_zero = derivation.given.iter();
        let given_zero = given_zero.filter(|(_, value)| value.is_zero());
        let given_zero = given_zero.map(|(u, _)| *u).collect();
        let mut field = Field::new(&scene.domains);
        let symbols: Vec<Expr> = meanings.keys().map(|s| Expr::symbol(s)).collect();
        let mut all: Vec<&Expr> = derivation.motion.values().collect();
        for body in &scene.bodies {
            all.extend([&body.mass, &body.inertia, &body.spin]);
            all.extend(body.center.iter().chain(&body.velocity));
        }
        all.extend(&symbols);
        field.prepare(all);
        let assumptions = words::assumptions(scene, derivation, proof);
        Writer {
            scene,
            d: derivation,
            proof,
            field,
            g,
            reduction,
            reduced,
            solution: Solution {
                title: scene.title.clone(),
                source: super::source(scene),
                statement: scene.statement.clone(),
                detail,
                names,
                meanings,
                assumptions,
                mode: super::decided(scene),
                ..Solution::default()
            },
            depth: 0,
            within: String::new(),
            told: BTreeSet::new(),
            zero: given_zero,
            roots: Vec::new(),
            rough: None,
        }
    }

    pub(super) fn detail(&self) -> Detail {
        self.solution.detail
    }

    pub(super) fn section(&mut self, heading: Vec<Inline>) {
        self.solution.section(self.depth, heading);
    }

    pub(super) fn push(&mut self, part: Part) {
        self.solution.push(part);
    }

    pub(super) fn text(&mut self, text: Vec<Inline>) {
        self.solution.text(text);
    }

    pub(super) fn say(&mut self, text: &str) {
        self.solution.say(text);
    }

    /// Adds a line to the display that stands last, or opens one.
    pub(super) fn show(&mut self, math: Vec<Math>, step: Option<String>) {
        let line = Line { math, step };
        if let Some(Part::Display(lines)) = self
            .solution
            .sections
            .last_mut()
            .and_then(|s| s.parts.last_mut())
        {
            lines.push(line);
        } else {
            self.push(Part::Display(vec![line]));
        }
    }

    /// Records a step and gives its id.
    pub(super) fn step(&mut self, before: Vec<Claim>, after: Vec<Claim>, reason: &str) -> String {
        let id = format!("{}{}", self.within, self.solution.steps.len() + 1);
        self.solution.record(id.clone(), before, after, reason);
        id
    }

    /// Lets `tell` record the substeps of the step that comes next.
    pub(super) fn substeps(&mut self, tell: impl FnOnce(&mut Self)) -> Vec<Step> {
        let steps = std::mem::take(&mut self.solution.steps);
        let outer = format!("{}{}.", self.within, steps.len() + 1);
        let within = std::mem::replace(&mut self.within, outer);
        tell(self);
        self.within = within;
        std::mem::replace(&mut self.solution.steps, steps)
    }

    /// The last step, to add assumptions or substeps.
    pub(super) fn last_step(&mut self) -> Option<&mut Step> {
        self.solution.steps.last_mut()
    }

    /// Records a single claim and shows it.
    pub(super) fn claim(&mut self, left: Expr, right: Expr, reason: &str) -> String {
        let math = words::related(&left, "=", &right);
        let id = self.step(Vec::new(), vec![Claim::new(left, right)], reason);
        self.show(math, Some(id.clone()));
        id
    }

    /// An expression as a person would write it; as it is where a limit of the algebra is met.
    pub(super) fn tidy(&mut self, e: &Expr) -> Expr {
        match self.field.proved(e) {
            Ok(Some(element)) => self.field.expr(&element),
            _ => e.clone(),
        }
    }

    pub(super) fn tidy_vector(&mut self, v: &Vector) -> Vector {
        [self.tidy(&v[0]), self.tidy(&v[1])]
    }

    /// Whether an expression is zero on the whole domain.
    pub(super) fn vanishes(&mut self, e: &Expr) -> bool {
        e.is_zero() || self.field.element(e).is_ok_and(|x| self.field.is_zero(&x))
    }

    /// The symbol of an unknown with the sign that makes it the unknown; nothing where it has been found to be zero.
    pub(super) fn unknown(&self, u: Unknown) -> Expr {
        if self.zero.contains(&u) {
            return Expr::zero();
        }
        self.d.names.symbol(u)
    }

    /// An affine form in the symbols of its unknowns, untidied.
    pub(super) fn form(&self, form: &Affine<Expr>) -> Expr {
        let terms = form.terms.iter().map(|(u, k)| k * &self.unknown(*u));
        Expr::sum(terms.chain([form.constant.clone()]))
    }

    /// Velocity just after of a body's center of mass, in the symbols of what is left free.
    pub(super) fn velocity_after(&mut self, b: usize) -> Vector {
        let v = self.reduced.velocity[b].clone();
        [0, 1].map(|axis| {
            let raw = self.form(&v[axis]);
            self.tidy(&raw)
        })
    }

    /// Spin just after in the symbol of the scene.
    pub(super) fn spin_after(&self, b: usize) -> Expr {
        self.form(&self.reduced.spin[b])
    }
}
