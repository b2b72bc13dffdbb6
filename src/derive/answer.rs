//! Questions and their answers: velocities, spins, impulses, energies, projected balances and matrices.

use super::compact::Parts;
use super::{Names, Stop, Work};
use crate::algebra::{self, Element, Row};
use crate::answer::{self, Answer, Form, Matrix};
use crate::derive::count::Counting;
use crate::expr::{Expr, Vector};
use crate::formula::{Sentence, sentence};
use crate::laws::{self, Affine, Direction, Kinematics, Law, Place, Unknown};
use crate::scene::{Ask, Body, ContactLaw, EnergyWhen, ImpulseAt, KnownQuantity, Question, Scene};

/// Most rows of a matrix whose determinant is told.
const SQUARE: usize = 7;

/// The full system of a scene, every law and every unknown, as a matrix.
pub fn full_matrix(scene: &Scene, names: &Names) -> Result<Matrix, Stop> {
    let mut work = Work::new(scene)?;
    let full = Kinematics::full(scene, &work.g);
    let unknowns = laws::unknowns(scene);
    let mut matrix = Matrix {
        rows: Vec::new(),
        unknowns: (unknowns.iter().map(|u| names.plain(*u).to_string())).collect(),
        entries: Vec::new(),
        rhs: Vec::new(),
    };
    for law in laws::of(scene) {
        let linear = laws::symbolic(scene, &work.g, &full, &law);
        let mut row = vec![Expr::zero(); unknowns.len()];
        for (unknown, k) in &linear.terms {
            if let Some(i) = unknowns.iter().position(|u| u == unknown) {
                row[i] = work.tidy(k)?;
            }
        }
        matrix.rows.push(laws::describe(scene, &law));
        matrix.entries.push(row);
        matrix.rhs.push(work.tidy(&linear.known)?);
    }
    Ok(matrix)
}

/// What a question asks for, as forms that are affine in the unknowns.
enum Asked {
    /// Components with suffix and words.
    Linear(Vec<(&'static str, Affine<Expr>)>),
    Energy(EnergyWhen, Option<usize>),
    Balance(Vec<usize>, Vector),
    Matrix(Vec<String>, Vec<String>),
}

impl Work<'_> {
    /// The unknowns a question hangs on.
    pub(super) fn unknowns_of(&mut self, ask: &Ask) -> Result<Vec<Unknown>, Stop> {
        let mut all: Vec<Unknown> = Vec::new();
        match self.asked(ask, &self.reduced) {
            Asked::Linear(forms) => {
                for (_, form) in forms {
                    all.extend(self.unknowns_in(&form)?);
                }
            }
            Asked::Energy(EnergyWhen::Before, _) | Asked::Balance(..) | Asked::Matrix(..) => {}
            Asked::Energy(_, of) => {
                for b in self.moving(of) {
                    let [x, y] = self.reduced.velocity[b].clone();
                    for form in [x, y, self.reduced.spin[b].clone()] {
                        all.extend(self.unknowns_in(&form)?);
                    }
                }
            }
        }
        all.dedup();
        Ok(all)
    }

    /// Answers all questions. An answer longer than anybody would print is reported as a limit, unless the unknowns stand
    /// for themselves already.
    pub(super) fn answers(&mut self, counting: &Counting) -> Result<Vec<Answer>, Stop> {
        let mut answers = Vec::new();
        let scene = self.scene;
        for question in scene.asked_of_impact() {
            self.answer(question, counting, &mut answers)?;
        }
        Ok(answers)
    }

    /// Answers a question, component by component.
    fn answer(
        &mut self,
        question: &Question,
        counting: &Counting,
        out: &mut Vec<Answer>,
    ) -> Result<(), Stop> {
        let latex = question.latex.clone();
        let latex = latex.unwrap_or_else(|| crate::formula::latex_name(&question.name));
        let words = words(self.scene, &question.ask);
        let dimension = question.ask.dimension();
        let make = |name: &str, latex: String, words: String, form: Form| Answer {
            form,
            dimension: dimension.clone(),
            ..Answer::typeset(question, name, latex, words)
        };
        let motion = self.parts.as_ref().map(Parts::motion);
        match self.asked(&question.ask, motion.unwrap_or(&self.reduced)) {
            Asked::Linear(forms) => {
                for (suffix, form) in forms {
                    let mut open = match counting.open.is_empty() {
                        true => Vec::new(),
                        false => self.unknowns_in(&form)?,
                    };
                    open.retain(|u| !counting.is_unique(*u));
                    let value = match open.is_empty() {
                        true => self.linear(&form)?,
                        false => None,
                    };
                    let form = value.unwrap_or_else(|| Form::Open(self.called(&open)));
                    let (name, latex, words) = match suffix {
                        "" => (question.name.clone(), latex.clone(), words.clone()),
                        axis => (
                            format!("{}_{axis}", question.name),
                            crate::formula::with_subscript(&latex, axis),
                            format!("{words}, along {axis}"),
                        ),
                    };
                    out.push(make(&name, latex, words, form));
                }
            }
            Asked::Energy(EnergyWhen::Lost, None) if loses_nothing(self.scene) => {
                let nothing = self.field.element(&Expr::zero())?;
                let form = self.value(&nothing)?;
                out.push(make(&question.name, latex, words, form));
            }
            Asked::Energy(when, of) => {
                let value = match self.with_parts(|parts, work| parts.energy(work, when, of)) {
                    Some(form) => form?,
                    None => match self.energy(when, of)? {
                        Some(terms) => Some(self.sum(&terms)?),
                        None => None,
                    },
                };
                let form = value.unwrap_or_else(|| Form::Open(self.called(&counting.open)));
                out.push(make(&question.name, latex, words, form));
            }
            Asked::Balance(system, along) => {
                let form = self.balance(&system, &along)?;
                out.push(make(&question.name, latex, words, form));
            }
            Asked::Matrix(rows, unknowns) => {
                let matrix = self.matrix(&rows, &unknowns)?;
                let determinant = self.determinant(&matrix)?;
                let form = Form::Matrix(matrix);
                let mut answer = make(&question.name, latex, words, form);
                answer.text.extend(determinant);
                out.push(answer);
            }
        }
        Ok(())
    }

    fn called(&self, unknowns: &[Unknown]) -> Vec<String> {
        let names = unknowns.iter().map(|u| self.names.plain(*u));
        names.map(String::from).collect()
    }

    /// The value of an affine form; `None` where it is not determined.
    fn linear(&mut self, form: &Affine<Expr>) -> Result<Option<Form>, Stop> {
        match self.with_parts(|parts, work| parts.linear(work, form)) {
            Some(form) => form,
            None => match self.element_of(form)? {
                Some(value) => Ok(Some(self.value(&value)?)),
                None => Ok(None),
            },
        }
    }

    /// What the named parts make of it, where the derivation has any.
    fn with_parts<T>(&mut self, of: impl FnOnce(&Parts, &mut Self) -> T) -> Option<T> {
        let parts = self.parts.take()?;
        let out = of(&parts, self);
        self.parts = Some(parts);
        Some(out)
    }

    fn value(&mut self, value: &Element) -> Result<Form, Stop> {
        if !self.in_steps && value.size() > self.longest() {
            return Err(Stop::Limit(String::from("the length of an answer")));
        }
        Ok(Form::value(self.field.expr(value)))
    }

    /// A sum; in steps term by term where it would be long.
    fn sum(&mut self, terms: &[Element]) -> Result<Form, Stop> {
        let zero = self.field.integer(0);
        let total = (terms.iter()).try_fold(zero, |total, term| self.field.add(&total, term));
        match total {
            Ok(total) if !self.in_steps || total.size() <= super::LONGEST => self.value(&total),
            Err(stop) if !self.in_steps => Err(stop.into()),
            _ => {
                let closed = Expr::sum(terms.iter().map(|term| self.field.expr(term)));
                Ok(Form::value(closed))
            }
        }
    }

    /// An expression as a person would write it.
    pub(super) fn tidy(&mut self, e: &Expr) -> Result<Expr, Stop> {
        let element = self.field.element(e)?;
        Ok(self.field.expr(&element))
    }

    /// The affine forms behind a question, in the unknowns of a description of the motion.
    pub(super) fn linear_forms(
        &self,
        ask: &Ask,
        motion: &Kinematics<Expr>,
    ) -> Option<Vec<(&'static str, Affine<Expr>)>> {
        match self.asked(ask, motion) {
            Asked::Linear(forms) => Some(forms),
            _ => None,
        }
    }

    fn asked(&self, ask: &Ask, motion: &Kinematics<Expr>) -> Asked {
        let scene = self.scene;
        match ask {
            Ask::Velocity { body, point, along } => {
                let center = &self.scene.bodies[*body].center;
                let at = point.as_ref().map_or(center, |(_, at)| at);
                let velocity = motion.velocity_of(&self.g, *body, at);
                Asked::Linear(components(velocity, along.as_ref()))
            }
            Ask::Spin { body, clockwise } => {
                let spin = &motion.spin[*body];
                let counted = match clockwise {
                    true => spin.negated(),
                    false => spin.clone(),
                };
                Asked::Linear(vec![("", counted)])
            }
            Ask::Impulse { from, on, along } => {
                let (place, second) = Place::of(scene, *from);
                let impulse = laws::impulse_at(scene, &self.g, place);
                let impulse = match *on == second {
                    true => impulse,
                    false => impulse.map(|p| p.negated()),
                };
                Asked::Linear(components(impulse, along.as_ref()))
            }
            Ask::Energy { when, of } => Asked::Energy(*when, *of),
            Ask::Balance { system, along } => Asked::Balance(system.clone(), along.clone()),
            Ask::Matrix { rows, unknowns } => Asked::Matrix(rows.clone(), unknowns.clone()),
            // About stages or other answers: nothing of this impact.
            _ => Asked::Linear(Vec::new()),
        }
    }

    pub(super) fn moving(&self, of: Option<usize>) -> Vec<usize> {
        let all = self.scene.moving();
        all.filter(|b| of.is_none_or(|o| o == *b)).collect()
    }

    /// Kinetic energy \[J\] as a sum; `None` where a velocity is not determined.
    fn energy(
        &mut self,
        when: EnergyWhen,
        of: Option<usize>,
    ) -> Result<Option<Vec<Element>>, Stop> {
        let mut terms = Vec::new();
        for b in self.moving(of) {
            let body = &self.scene.bodies[b];
            let weights = [&body.mass, &body.mass, &body.inertia].map(|m| m * &Expr::ratio(1, 2));
            let [vx, vy] = self.reduced.velocity[b].clone();
            let after = [vx, vy, self.reduced.spin[b].clone()];
            let before = [&body.velocity[0], &body.velocity[1], &body.spin];
            for ((weight, after), before) in weights.iter().zip(&after).zip(before) {
                if weight.is_zero() {
                    continue;
                }
                let weight = self.field.element(weight)?;
                let before = self.field.element(before)?;
                let mut change = match when {
                    EnergyWhen::Before | EnergyWhen::Lost => self.field.mul(&before, &before)?,
                    EnergyWhen::After => self.field.element(&Expr::zero())?,
                };
                if when != EnergyWhen::Before {
                    let Some(after) = self.element_of(after)? else {
                        return Ok(None);
                    };
                    let square = self.field.mul(&after, &after)?;
                    change = match when {
                        EnergyWhen::Lost => self.field.sub(&change, &square)?,
                        _ => square,
                    };
                }
                terms.push(self.field.mul(&weight, &change)?);
            }
        }
        Ok(Some(terms))
    }

    /// Linear momentum before = after along a direction, in the components the scene asks for.
    fn balance(&mut self, system: &[usize], along: &Vector) -> Result<Form, Stop> {
        let names = self.component_questions();
        let (terms, known) = self.projected(&names, system, along)?;
        let after = Expr::sum(terms.iter().map(|(name, k)| k * &Expr::symbol(name)));
        Ok(Form::Equation {
            left: known,
            right: after,
        })
    }

    /// The balance along a direction as Σ coefficient × named component = momentum before.
    fn projected(
        &mut self,
        names: &[String],
        system: &[usize],
        along: &Vector,
    ) -> Result<(Vec<(String, Expr)>, Expr), Stop> {
        let along = Direction::Named(String::from("the given direction"), along.clone());
        let law = Law::linear(system, along);
        self.in_components(names, &law)
    }

    /// A law with the velocities written in the components the scene names.
    fn in_components(
        &mut self,
        names: &[String],
        law: &Law,
    ) -> Result<(Vec<(String, Expr)>, Expr), Stop> {
        let full = Kinematics::full(self.scene, &self.g);
        let linear = laws::symbolic(self.scene, &self.g, &full, law);
        // left − right = Σ k·v − known, with every velocity replaced by its components
        let known = self.field.element(&linear.known)?;
        let mut total = self.field.neg(&known);
        for (unknown, k) in &linear.terms {
            let k = self.field.element(k)?;
            let value = match unknown {
                Unknown::Velocity(b, axis) => {
                    let [x, y] = self.velocity_in_components(*b)?;
                    if *axis == 0 { x } else { y }
                }
                other => {
                    let name = Expr::symbol(self.names.plain(*other));
                    self.field.element(&name)?
                }
            };
            let term = self.field.mul(&k, &value)?;
            total = self.field.add(&total, &term)?;
        }
        let unknowns = laws::unknowns(self.scene);
        let others = unknowns.iter().map(|u| self.names.plain(*u).to_string());
        let mut terms = Vec::new();
        for name in names.iter().cloned().chain(others) {
            let (k, rest) = self.field.linear_in(&total, &name)?;
            if !self.field.is_zero(&k) {
                terms.push((name, self.field.expr(&k)));
                total = rest;
            }
        }
        Ok((terms, self.field.expr(&self.field.neg(&total))))
    }

    /// Names of the questions that ask for a component of a body's velocity.
    fn component_questions(&self) -> Vec<String> {
        let is_component = |q: &&Question| {
            matches!(
                &q.ask,
                Ask::Velocity {
                    point: None,
                    along: Some(_),
                    ..
                }
            )
        };
        self.scene
            .asked_of_impact()
            .filter(is_component)
            .map(|q| q.name.clone())
            .collect()
    }

    /// Velocity after of a body in the components that questions name, helped by what is given; x and y where they do not
    /// suffice.
    fn velocity_in_components(&mut self, body: usize) -> Result<[Element; 2], Stop> {
        if let Some(known) = self.in_components.get(&body) {
            return Ok(known.clone());
        }
        let found = self.solved_components(body)?;
        self.in_components.insert(body, found.clone());
        Ok(found)
    }

    fn solved_components(&mut self, body: usize) -> Result<[Element; 2], Stop> {
        let mut rows: Vec<(Vector, Expr)> = Vec::new();
        for question in self.scene.asked_of_impact() {
            if let Ask::Velocity {
                body: b,
                point: None,
                along: Some(d),
            } = &question.ask
                && *b == body
            {
                rows.push((d.clone(), Expr::symbol(&question.name)));
            }
        }
        if rows.len() < 2 {
            for known in self.scene.after.iter().filter(|k| k.body == body) {
                if let KnownQuantity::Velocity { along, .. } = &known.what {
                    rows.push((along.clone(), known.value.clone()));
                }
            }
        }
        rows.truncate(2);
        let mut linear = Vec::new();
        for (d, value) in &rows {
            let mut coeffs = Vec::new();
            for (axis, k) in d.iter().enumerate() {
                let k = self.field.element(k)?;
                if !self.field.is_zero(&k) {
                    coeffs.push((axis, k));
                }
            }
            linear.push(Row {
                coeffs,
                rhs: self.field.element(value)?,
            });
        }
        if linear.len() == 2
            && let [Some(x), Some(y)] = algebra::solve(&self.field, &linear, 2)?.values.as_slice()
        {
            return Ok([x.clone(), y.clone()]);
        }
        let own = [0, 1].map(|axis| Unknown::Velocity(body, axis));
        let [x, y] = own.map(|u| Expr::symbol(self.names.plain(u)));
        Ok([self.field.element(&x)?, self.field.element(&y)?])
    }

    fn matrix(&mut self, rows: &[String], unknowns: &[String]) -> Result<Matrix, Stop> {
        let mut matrix = Matrix {
            rows: Vec::new(),
            unknowns: unknowns.to_vec(),
            entries: Vec::new(),
            rhs: Vec::new(),
        };
        let mut push = |words: String, terms: &[(String, Expr)], known: Expr| {
            let entry = |name: &String| {
                terms
                    .iter()
                    .find(|(n, _)| n == name)
                    .map_or(Expr::zero(), |(_, k)| k.clone())
            };
            matrix.rows.push(words);
            matrix.entries.push(unknowns.iter().map(entry).collect());
            matrix.rhs.push(known);
        };
        for name in rows {
            let question = self.scene.question_of_impact(name);
            if let Some(Ask::Balance { system, along }) = question.map(|q| q.ask.clone()) {
                let (terms, known) = self.projected(unknowns, &system, &along)?;
                push(name.clone(), &terms, known);
            } else if let Some(k) = self.scene.after.iter().position(|k| k.name == *name) {
                let (terms, known) = self.in_components(unknowns, &Law::Given(k))?;
                push(name.clone(), &terms, known);
            }
        }
        Ok(matrix)
    }
}

impl Work<'_> {
    /// What the determinant of a square matrix is, in words.
    fn determinant(&mut self, matrix: &Matrix) -> Result<Option<Sentence>, Stop> {
        let n = matrix.unknowns.len();
        if matrix.entries.len() != n || n > SQUARE {
            return Ok(None);
        }
        let mut rows = Vec::new();
        for row in &matrix.entries {
            let elements = row.iter().map(|e| self.field.element(e));
            rows.push(elements.collect::<Result<Vec<_>, _>>()?);
        }
        let determinant = algebra::determinant(&self.field, &rows)?;
        Ok(Some(match self.field.is_zero(&determinant) {
            true => Sentence::words("its determinant is 0: a row follows from the others"),
            false => sentence!("its determinant is {}", &self.field.expr(&determinant)),
        }))
    }
}

/// Whether no kinetic energy can be lost, since at each contact −½ P·(u⁻ + u⁺) is zero and nothing else does work: bodies are
/// smooth, leave each other as fast as they came, and what moves as it must is at rest.
fn loses_nothing(scene: &Scene) -> bool {
    let gives_back = |law: &ContactLaw| match law {
        ContactLaw::Frictionless { restitution } => *restitution == Expr::one(),
        _ => false,
    };
    let stands = |b: &Body| !b.is_fixed() || b.velocity.iter().chain([&b.spin]).all(Expr::is_zero);
    scene.contacts.iter().all(|c| gives_back(&c.law))
        && scene.blows.is_empty()
        && scene.after.is_empty()
        && scene.bodies.iter().all(stands)
}

fn components(v: [Affine<Expr>; 2], along: Option<&Vector>) -> Vec<(&'static str, Affine<Expr>)> {
    match along {
        Some(d) => vec![("", v[0].times(&d[0]).plus(&v[1].times(&d[1])))],
        None => {
            let [x, y] = v;
            vec![("x", x), ("y", y)]
        }
    }
}

fn words(scene: &Scene, ask: &Ask) -> String {
    let body = |b: usize| scene.bodies[b].name.as_str();
    match ask {
        Ask::Velocity {
            body: b,
            point,
            along,
        } => {
            let point = point.as_ref();
            let of = point.map_or("the center of mass".into(), |(name, _)| {
                format!("point {name}")
            });
            let along = answer::along(along.as_ref());
            format!("velocity of {of} of {} just after{along}", body(*b))
        }
        Ask::Spin { body: b, clockwise } => {
            let sense = if *clockwise {
                "clockwise"
            } else {
                "counterclockwise"
            };
            format!(
                "angular velocity of {} just after, {sense} positive",
                body(*b)
            )
        }
        Ask::Impulse { from, on, along } => {
            let at = match from {
                ImpulseAt::Contact(c) => &scene.contacts[*c].name,
                ImpulseAt::Hinge(h) => &scene.hinges[*h].name,
                ImpulseAt::Blow(b) => &scene.blows[*b].name,
            };
            let along = answer::along(along.as_ref());
            format!("impulse at {at} on {}{along}", body(*on))
        }
        Ask::Energy { when, of } => {
            let whose = of.map_or_else(|| String::from("all bodies"), |b| body(b).to_string());
            match when {
                EnergyWhen::Before => format!("kinetic energy of {whose} just before"),
                EnergyWhen::After => format!("kinetic energy of {whose} just after"),
                EnergyWhen::Lost => format!("kinetic energy lost by {whose}"),
            }
        }
        Ask::Balance { system, .. } => {
            format!(
                "linear momentum of {} along the given direction, before = after",
                laws::body_list(scene, system)
            )
        }
        Ask::Matrix { .. } => String::from("the equations in matrix form"),
        _ => String::new(),
    }
}
