//! What printed formulas are read and evaluated with: every name that may stand in one, and what it is in truth.
//!
//! In: a scene, its derivation and answers. Out: the closed forms by name, and a formula with them in it.

use std::collections::BTreeMap;

use super::{Way, small};
use crate::algebra::{Sign, sign, tidy};
use crate::answer::{Answer, Form};
use crate::dimension::Dimension;
use crate::domain::Domains;
use crate::expr::{Expr, Symbol, dot, minus, only};
use crate::formula::{
    self, Content, Reading, Relation, Sentence, Symbols, sentence, write_unicode,
};
use crate::scene::{Ask, Body, FrictionEvent, Printed, Scene};

/// What formulas are read and evaluated with.
pub(super) struct Desk<'a> {
    pub(super) scene: &'a Scene,
    /// The answers of this way, and all, with what they rest on.
    pub(super) answers: [&'a [Answer]; 2],
    /// Where the scene goes this way: its domains, with what decides between the cases of friction.
    pub(super) domains: Domains,
    /// Whether it does so at the values of the scene.
    pub(super) is_so: bool,
    /// Closed forms by name.
    pub(super) closed: BTreeMap<Symbol, Expr>,
    /// What is answered under the name of a parameter: in any other formula that name is the parameter itself.
    pub(super) solved: BTreeMap<Symbol, Expr>,
    /// What an answer says of a parameter, a bound or the place of a maximum: of what, how it stands to what.
    pub(super) bounds: BTreeMap<Symbol, (Expr, Relation, Expr)>,
    /// Components of vectors by name.
    pub(super) vectors: BTreeMap<Symbol, [Expr; 2]>,
    /// The same by their names with an arrow, with those just before.
    pub(super) arrows: BTreeMap<Symbol, [Expr; 3]>,
    pub(super) dimensions: BTreeMap<Symbol, Dimension>,
    /// Why an answer has no value, by its name.
    pub(super) open: BTreeMap<String, String>,
}

/// Places of centers, so that geometry can be checked too, and moments of inertia.
fn geometry(
    scene: &Scene,
    closed: &mut BTreeMap<Symbol, Expr>,
    dimensions: &mut BTreeMap<Symbol, Dimension>,
) {
    for body in &scene.bodies {
        for (axis, value) in ["x", "y"].iter().zip(&body.center) {
            let name = Symbol::from(format!("{axis}_{}", body.name));
            dimensions.insert(name.clone(), Dimension::new(0, 1, 0));
            closed.insert(name, value.clone());
        }
        let name = Symbol::from(format!("I_{}", body.name));
        if !body.is_fixed() {
            dimensions.insert(name.clone(), Dimension::new(1, 2, 0));
            closed.insert(name, body.inertia.clone());
        }
    }
    // The moment of inertia of the one body that can move about each point.
    if let Some(body) = only_body(scene) {
        for point in &scene.points {
            let [x, y] = minus(&point.at, &body.center).map(|d| d.powi(2));
            let name = Symbol::from(format!("I_{}", point.name));
            dimensions.insert(name.clone(), Dimension::new(1, 2, 0));
            let about = &body.inertia + &(&body.mass * &(x + y));
            if scene.parameters.iter().all(|p| p.name != name) {
                closed.entry(name).or_insert(about);
            }
        }
    }
}

/// The name of a vector with an arrow over it.
fn arrowed(name: &str) -> Option<Symbol> {
    formula::with_arrow(name).map(Symbol::from)
}

/// Vectors by their names with an arrow: what is asked for, arms, and spins, out of the page.
fn arrows(
    scene: &Scene,
    vectors: &BTreeMap<Symbol, [Expr; 2]>,
    closed: &BTreeMap<Symbol, Expr>,
) -> BTreeMap<Symbol, [Expr; 3]> {
    let in_plane = |[x, y]: &[Expr; 2]| [x.clone(), y.clone(), Expr::zero()];
    let mut arrows: BTreeMap<Symbol, [Expr; 3]> = vectors
        .iter()
        .map(|(name, v)| (name.to_string(), v.clone()))
        .chain(scene.arms())
        .filter_map(|(name, v)| Some((arrowed(&name)?, in_plane(&v))))
        .collect();
    for q in scene.asked_of_impact() {
        let Ask::Spin { clockwise, .. } = q.ask else {
            continue;
        };
        // A spin is a vector out of the page.
        if let (Some(arrow), Some(spin)) = (arrowed(&q.name), closed.get(q.name.as_str())) {
            let spin = if clockwise { -spin } else { spin.clone() };
            arrows.insert(arrow, [Expr::zero(), Expr::zero(), spin]);
        }
    }
    arrows
}

impl<'a> Desk<'a> {
    pub(super) fn new(way: &Way<'a>) -> Desk<'a> {
        let Way {
            scene,
            derivation,
            all,
            ..
        } = *way;
        let mut closed = BTreeMap::new();
        let given = scene.parameters.iter();
        let given = given.map(|p| (p.name.clone(), p.dimension.clone()));
        let mut dimensions: BTreeMap<Symbol, Dimension> = given.collect();
        geometry(scene, &mut closed, &mut dimensions);
        let whole = |n: usize| Expr::from(n as i64);
        closed.insert("equations".into(), whole(derivation.counting.equations));
        closed.insert("unknowns".into(), whole(derivation.counting.unknowns));
        let motion = derivation.motion_by_name();
        closed.extend(motion.map(|(_, name, value)| (name, value)));
        let mut solved = BTreeMap::new();
        let mut vectors: BTreeMap<Symbol, [Expr; 2]> = BTreeMap::new();
        let mut bounds = BTreeMap::new();
        let mut open = BTreeMap::new();
        for answer in derivation.answers.iter().chain(all) {
            if let [bound] = answer.range.as_slice() {
                let name = Symbol::from(answer.name.as_str());
                bounds.insert(name.clone(), bound.clone());
                // The place of a largest or least value is printed under its own name, or under that of the value.
                if answer.name == format!("{}_at", answer.question) {
                    bounds.insert(Symbol::from(answer.question.as_str()), bound.clone());
                    closed.insert(name, bound.2.clone());
                }
            }
            if let (Form::Open(_) | Form::Words, [why, ..]) = (&answer.form, answer.text.as_slice())
            {
                open.insert(answer.name.clone(), why.to_string());
            }
        }
        for answer in &derivation.answers {
            // What is asked under a name is meant by it, though it has no value.
            closed.remove(answer.name.as_str());
            if let Form::Value { closed: value, .. } = &answer.form {
                let name = Symbol::from(answer.name.as_str());
                // What follows from plain numbers may be in a unit that nobody states.
                if !(value.is_constant() && answer.dimension.is_none()) {
                    dimensions.insert(name.clone(), answer.dimension.clone());
                }
                let mut rough = way.coefficients.iter();
                if let Some((_, mu, relation)) = rough.find(|(of, ..)| *of == answer.name) {
                    bounds.insert(name.clone(), (Expr::symbol(mu), *relation, value.clone()));
                }
                match scene.parameter(&name) {
                    Some(_) => solved.insert(name, value.clone()),
                    None => closed.insert(name, value.clone()),
                };
                if answer.name != answer.question {
                    let vector = vectors
                        .entry(Symbol::from(answer.question.as_str()))
                        .or_insert_with(|| [Expr::zero(), Expr::zero()]);
                    vector[usize::from(answer.name.ends_with("_y"))] = value.clone();
                }
            }
        }
        let mut arrows = arrows(scene, &vectors, &closed);
        for (name, value) in before(scene) {
            match value.as_slice() {
                [x, y] => {
                    for (axis, part) in [("x", x), ("y", y)] {
                        closed.insert(format!("{name}_{axis}^-").into(), part.clone());
                    }
                    let arrow = arrowed(&format!("{name}^-"));
                    let value = [x.clone(), y.clone(), Expr::zero()];
                    arrows.extend(arrow.map(|arrow| (arrow, value)));
                }
                one => {
                    if let (true, [about]) = (name.starts_with("H_"), one) {
                        let out = [Expr::zero(), Expr::zero(), about.clone()];
                        arrows.extend(arrowed(&format!("{name}^-")).map(|arrow| (arrow, out)));
                    }
                    closed.extend(one.iter().map(|v| (format!("{name}^-").into(), v.clone())));
                }
            }
        }
        Desk {
            scene,
            answers: [&derivation.answers, all],
            domains: way.domains(),
            is_so: way.is_so,
            closed,
            solved,
            bounds,
            vectors,
            arrows,
            dimensions,
            open,
        }
    }

    /// What is said of something printed for which the scene has no value.
    pub(super) fn unanswered(&self, item: &str) -> String {
        match self.open.get(item) {
            Some(why) => format!("{item} has no value: {why}"),
            None if item.contains("_case") => format!(
                "the scene answers no {item}; what is printed of any case goes by the plain name"
            ),
            None => format!("the scene answers no {item}"),
        }
    }

    pub(super) fn symbols(&self, printed: &Printed) -> Symbols {
        let mut symbols = Symbols::strict();
        self.scene.declare_parameters(&mut symbols);
        for name in self.closed.keys().chain(self.solved.keys()) {
            let latex = formula::latex_name(name);
            let dimension = self.dimensions.get(name).cloned();
            symbols.declare_as(name.clone(), Some(&latex), dimension);
            if let Some(latex) = self.typeset(name) {
                symbols.declare_as(name.clone(), Some(&latex), None);
            }
        }
        // `ω⁺` is what is asked of the moment just after.
        for name in self.closed.keys().filter(|name| !name.contains('^')) {
            let after = format!("{}^{{+}}", formula::latex_name(name));
            symbols.declare_as(name.clone(), Some(&after), None);
        }
        for name in self.arrows.keys() {
            symbols.declare(name);
            let after = format!("{}^{{+}}", formula::latex_name(name));
            if !name.contains('^') {
                symbols.declare_as(name.clone(), Some(&after), None);
            }
        }
        for [name, _] in &printed.short {
            symbols.declare(name);
        }
        symbols
    }

    /// How the scene writes what it asks for, in LaTeX; a component has its axis below.
    fn typeset(&self, name: &str) -> Option<String> {
        let latex = |name: &str| self.scene.question(name)?.latex.as_deref();
        let of_axis = || {
            let (of, axis) = name.rsplit_once('_')?;
            let is_axis = self.vectors.contains_key(of) && matches!(axis, "x" | "y");
            is_axis.then(|| Some(formula::with_subscript(latex(of)?, axis)))?
        };
        latex(name).map(str::to_string).or_else(of_axis)
    }

    /// The components of a side: one of a number, three of a vector or a multiple of one that is asked for.
    pub(super) fn components(&self, side: &Content) -> Option<Vec<Expr>> {
        if let Content::Vector(v) = side {
            return Some(v.to_vec());
        }
        let e = side.expr()?;
        let all = e.symbols().into_iter();
        let used: Vec<Symbol> = all.filter(|n| self.arrows.contains_key(n)).collect();
        if used.is_empty() {
            return Some(vec![e.clone()]);
        }
        let nothing = used.iter().map(|name| (name.clone(), Expr::zero()));
        let nothing: BTreeMap<Symbol, Expr> = nothing.collect();
        let along = |axis: usize| -> BTreeMap<Symbol, Expr> {
            let part = |name: &Symbol| (name.clone(), self.arrows[name][axis].clone());
            used.iter().map(part).collect()
        };
        // Only what is linear in the vectors goes component by component.
        let linear = used.iter().all(|name| {
            let slope = e.derivative(name).symbols();
            used.iter().all(|other| !slope.contains(other))
        });
        let whole = e.substitute(&nothing).is_zero() && linear;
        whole.then(|| (0..3).map(|axis| e.substitute(&along(axis))).collect())
    }

    pub(super) fn read(&self, text: &str, printed: &Printed) -> Result<Reading, String> {
        let reading = formula::read(text, &self.symbols(printed)).map_err(|f| f.to_string())?;
        // `v T with v = …`: what is passed over could say something else.
        let words = reading
            .notes
            .iter()
            .find(|n| n.remark == formula::Remark::Words);
        match words {
            Some(_) => Err("words stand beside the formula: print it alone".into()),
            None => Ok(reading),
        }
    }

    /// What the scene answers under a name.
    pub(super) fn answered(&self, name: &str) -> Option<&Expr> {
        self.solved.get(name).or_else(|| self.closed.get(name))
    }

    /// What stands by itself under a name that is answered, as it is in truth: `d` of the number for it, of `d = 2 b/3`.
    pub(super) fn by_answer(&self, e: &Expr) -> Expr {
        let solved = e.as_symbol().and_then(|name| self.solved.get(name));
        solved.unwrap_or(e).clone()
    }

    /// Abbreviations, then closed forms, then special values put in; of what is small nothing but what stands without it.
    pub(super) fn put_in(&self, e: &Expr, printed: &Printed) -> Result<Expr, String> {
        self.put_in_to(e, printed, 0)
    }

    /// The same with the powers of what is small up to one of them.
    pub(super) fn put_in_to(
        &self,
        e: &Expr,
        printed: &Printed,
        order: usize,
    ) -> Result<Expr, String> {
        let mut out = e.clone();
        let short = self.values_of(&printed.short, printed)?;
        // Abbreviations may use one another; as many rounds as there are settle it.
        for _ in &printed.short {
            out = out.substitute(&short);
        }
        let special = self.special(printed)?;
        let parts = self.arrows.iter().flat_map(|(name, value)| {
            let axes = ["x", "y", "z"].iter().zip(value);
            axes.map(move |(axis, part)| (format!("{name}_{axis}").into(), part.clone()))
        });
        let out = out.substitute(&self.closed).substitute(&parts.collect());
        let symbols = out.symbols();
        if symbols.iter().any(|name| self.arrows.contains_key(name)) {
            return Err("a vector stands where a number belongs".into());
        }
        Ok(small::up_to(
            &out.substitute(&special),
            &printed.small,
            order,
        ))
    }

    /// What names stand for, as it is printed.
    pub(super) fn values_of(
        &self,
        pairs: &[[String; 2]],
        printed: &Printed,
    ) -> Result<BTreeMap<Symbol, Expr>, String> {
        let read = pairs.iter().map(|[name, text]| {
            let reading = self.read(text, printed)?;
            let value = reading.expr().cloned();
            let value = value.ok_or_else(|| format!("{text} is no expression"))?;
            Ok((Symbol::from(name.as_str()), value))
        });
        read.collect()
    }

    pub(super) fn say(&self, e: &Expr) -> String {
        write_unicode(e, &|name| {
            let mut parameters = self.scene.parameters.iter();
            parameters.find(|p| *p.name == *name)?.latex.clone()
        })
    }

    pub(super) fn tidy(&self, e: &Expr) -> String {
        let tidied = tidy(e, &self.scene.domains);
        self.say(tidied.as_ref().unwrap_or(e))
    }
}

/// Which coefficient of friction a threshold bounds, and how it stands to it.
pub(crate) fn friction_bound(scene: &Scene, name: &str) -> Option<(Symbol, Relation)> {
    let question = scene.question(name)?;
    let Ask::Friction { contact, event } = &question.ask else {
        return None;
    };
    let impact = match question.stage {
        None => scene,
        Some(stage) => &scene.stages.get(stage)?.scene,
    };
    let law = impact.contacts.get(*contact)?.law.friction()?;
    let relation = match event {
        FrictionEvent::Slides => Relation::LessEqual,
        FrictionEvent::Sticks | FrictionEvent::Jams => Relation::GreaterEqual,
    };
    Some((law.mu.as_symbol()?.clone(), relation))
}

/// A condition solved for a coefficient of friction, `mu ≤ u/v` for `u − mu v ≥ 0`, where it is one on that; else as it is.
pub(super) fn for_the_coefficient(scene: &Scene, words: &Sentence) -> Sentence {
    let Some((excess, strict)) = words.condition() else {
        return words.clone();
    };
    let stages = scene.stages.iter().flat_map(|stage| &stage.scene.contacts);
    let all = scene.contacts.iter().chain(stages);
    let mut all = all.filter_map(|contact| contact.law.friction()?.mu.as_symbol());
    let solved = all.find_map(|mu| {
        let slope = excess.derivative(mu);
        if slope.mentions(mu) {
            return None;
        }
        let op = match (sign(&slope, &scene.domains)?, strict) {
            (Sign::Positive, true) => " > ",
            (Sign::Positive, false) => " ≥ ",
            (Sign::Negative, true) => " < ",
            (Sign::Negative, false) => " ≤ ",
            _ => return None,
        };
        let bound = -(excess.put(mu, &Expr::zero()) / slope);
        let bound = tidy(&bound, &scene.domains).unwrap_or(bound);
        Some(sentence!("{}{}{}", mu, op, &bound))
    });
    match solved {
        Some(Sentence(mut solved)) => {
            // The reason stays behind it.
            solved.extend(words.0.iter().skip(3).cloned());
            Sentence(solved)
        }
        None => words.clone(),
    }
}

/// The one body that can move.
fn only_body(scene: &Scene) -> Option<&Body> {
    only(scene.bodies.iter().filter(|b| !b.is_fixed()))
}

/// The motion of bodies just before, by their names, and for the one body that can move its kinetic energy and, as vectors
/// out of the page, its angular momenta about points.
fn motion_before(scene: &Scene) -> Vec<(String, Vec<Expr>)> {
    let moving = scene.bodies.iter().filter(|b| !b.is_fixed());
    let motion = moving.flat_map(|b| {
        [
            (format!("v_{}", b.name), b.velocity.to_vec()),
            (format!("omega_{}", b.name), vec![b.spin.clone()]),
        ]
    });
    let mut all: Vec<(String, Vec<Expr>)> = motion.collect();
    if let Some(body) = only_body(scene) {
        let twice =
            &body.mass * &dot(&body.velocity, &body.velocity) + &body.inertia * &body.spin.powi(2);
        let energy = twice * Expr::ratio(1, 2);
        all.extend(["K", "E_k"].map(|name| (name.to_string(), vec![energy.clone()])));
        for point in &scene.points {
            let [x, y] = minus(&body.center, &point.at);
            let [u, v] = &body.velocity;
            let about = &body.mass * &(&x * v - &y * u) + &body.inertia * &body.spin;
            all.push((format!("H_{}", point.name), vec![about]));
        }
    }
    all
}

/// What is asked of velocities and spins, just before: one value, or two components.
fn before(scene: &Scene) -> Vec<(String, Vec<Expr>)> {
    let asked = scene.asked_of_impact().filter_map(|q| {
        let value = match &q.ask {
            Ask::Velocity { body, point, along } => {
                let body = &scene.bodies[*body];
                let velocity = match point {
                    Some((_, at)) => body.velocity_at(at),
                    None => body.velocity.clone(),
                };
                match along {
                    Some(along) => vec![dot(&velocity, along)],
                    None => velocity.to_vec(),
                }
            }
            Ask::Spin { body, clockwise } => {
                let spin = &scene.bodies[*body].spin;
                vec![if *clockwise { -spin } else { spin.clone() }]
            }
            _ => return None,
        };
        Some((q.name.clone(), value))
    });
    // Of several stages the bodies tell one beginning alone.
    let is_one = scene.questions.iter().all(|q| q.stage.is_none());
    let mut all = if is_one {
        motion_before(scene)
    } else {
        Vec::new()
    };
    all.extend(asked);
    all
}
