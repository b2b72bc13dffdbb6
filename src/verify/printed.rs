//! What a book prints about a scene, held against what carom derives: formulas, numbers, equations, claims, matrices.
//!
//! A formula or equation holds when it is an identity in the closed forms; a number when it is the exact value rounded to
//! its own digits; a row of a matrix when it is a law, not merely true of this one solution. What does not hold comes with
//! the value it should have, a slip that explains it where one is found, and the cheap check that would have caught it.

mod cases;
mod explain;
mod inequality;
mod matrix;
mod number;
mod remainder;

use std::collections::BTreeMap;

pub use cases::in_cases;

use crate::answer::{Answer, Form};
use crate::derive::Derivation;
use crate::dimension::Dimension;
use crate::equality::{self, Equality};
use crate::expr::{Expr, Symbol, dot, minus};
use crate::formula::{self, Content, Reading, Relation, Symbols, write_unicode};
use crate::laws;
use crate::scene::{Ask, ContactLaw, FrictionEvent, Print, Printed, Scene};

/// The finding about one printed thing.
#[derive(Clone, Debug, Default, serde::Serialize)]
pub struct Finding {
    /// Where it is printed.
    #[serde(rename = "where")]
    pub place: String,
    /// `formula`, `number`, `equation`, `claim`, `matrix`.
    pub kind: &'static str,
    /// What is printed.
    pub printed: String,
    /// Whether it holds; `None` where that could not be found out.
    pub holds: Option<bool>,
    /// In which cases of friction it holds, where it does not in all of them.
    pub only_where: Option<String>,
    /// What carom has in its place.
    pub carom: String,
    /// How it is known.
    pub because: String,
    /// What produced a wrong value, where that was found.
    pub explained: Option<String>,
    /// The cheap check that would have caught it.
    pub caught_by: Option<String>,
}

/// What is said where nothing explains a wrong thing.
pub const UNEXPLAINED: &str = "no single slip of the pen leads to it";

/// Checks everything printed about a scene; all answers tell why there is no value, and where a
/// value is largest.
pub fn check(scene: &Scene, derivation: &Derivation, all: &[Answer]) -> Vec<Finding> {
    let desk = Desk::new(scene, derivation, all);
    let findings = scene.printed.iter().map(|printed| desk.check(printed));
    let mut findings: Vec<Finding> = findings.collect();
    desk.consequences(&mut findings);
    for finding in findings.iter_mut().filter(|f| f.holds == Some(false)) {
        finding.explained.get_or_insert_with(|| UNEXPLAINED.into());
    }
    findings
}

/// What formulas are read and evaluated with.
struct Desk<'a> {
    scene: &'a Scene,
    /// Closed forms by name.
    closed: BTreeMap<Symbol, Expr>,
    /// What an answer says of a parameter, a bound or the place of a maximum: of what, how it stands to what.
    bounds: BTreeMap<Symbol, (Expr, Relation, Expr)>,
    /// Components of vectors by name.
    vectors: BTreeMap<Symbol, [Expr; 2]>,
    /// The same by their names with an arrow, with those just before.
    arrows: BTreeMap<Symbol, [Expr; 3]>,
    dimensions: BTreeMap<Symbol, Dimension>,
    /// Why an answer has no value, by its name.
    open: BTreeMap<String, String>,
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
    let mut free = scene.bodies.iter().filter(|b| !b.is_fixed());
    if let (Some(body), None) = (free.next(), free.next()) {
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

impl<'a> Desk<'a> {
    fn new(scene: &'a Scene, derivation: &Derivation, all: &[Answer]) -> Desk<'a> {
        let mut closed = BTreeMap::new();
        let given = scene.parameters.iter();
        let given = given.map(|p| (p.name.clone(), p.dimension.clone()));
        let mut dimensions: BTreeMap<Symbol, Dimension> = given.collect();
        geometry(scene, &mut closed, &mut dimensions);
        let whole = |n: usize| Expr::from(n as i64);
        closed.insert("equations".into(), whole(derivation.counting.equations));
        closed.insert("unknowns".into(), whole(derivation.counting.unknowns));
        for unknown in laws::unknowns(scene) {
            if let Some(value) = derivation.motion.get(&unknown) {
                let value = match derivation.names.is_reversed(unknown) {
                    true => -value,
                    false => value.clone(),
                };
                closed.insert(Symbol::from(derivation.names.plain(unknown)), value);
            }
        }
        let mut vectors: BTreeMap<Symbol, [Expr; 2]> = BTreeMap::new();
        let mut bounds = BTreeMap::new();
        let mut open = BTreeMap::new();
        for answer in derivation.answers.iter().chain(all) {
            if let [bound] = answer.range.as_slice() {
                let name = Symbol::from(answer.name.as_str());
                bounds.insert(name.clone(), bound.clone());
                // The place of a largest value is printed under its own name, or under that of the value.
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
                if let Some((mu, relation)) = friction_bound(scene, &answer.name) {
                    bounds.insert(name.clone(), (mu, relation, value.clone()));
                }
                closed.insert(name, value.clone());
                if answer.name != answer.question {
                    let vector = vectors
                        .entry(Symbol::from(answer.question.as_str()))
                        .or_insert_with(|| [Expr::zero(), Expr::zero()]);
                    vector[usize::from(answer.name.ends_with("_y"))] = value.clone();
                }
            }
        }
        let arrowed = |name: &str| formula::with_arrow(name).map(Symbol::from);
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
        for (name, value) in before(scene) {
            match value.as_slice() {
                [x, y] => {
                    for (axis, part) in [("x", x), ("y", y)] {
                        closed.insert(format!("{name}_{axis}^-").into(), part.clone());
                    }
                    let arrow = arrowed(&format!("{name}^-"));
                    let value = in_plane(&[x.clone(), y.clone()]);
                    arrows.extend(arrow.map(|arrow| (arrow, value)));
                }
                one => closed.extend(one.iter().map(|v| (format!("{name}^-").into(), v.clone()))),
            }
        }
        Desk {
            scene,
            closed,
            bounds,
            vectors,
            arrows,
            dimensions,
            open,
        }
    }

    /// What is said of something printed for which the scene has no value.
    fn unanswered(&self, item: &str) -> String {
        match self.open.get(item) {
            Some(why) => format!("{item} has no value: {why}"),
            None if item.contains("_case") => format!(
                "the scene answers no {item}; what is printed of any case goes by the plain name"
            ),
            None => format!("the scene answers no {item}"),
        }
    }

    fn symbols(&self, printed: &Printed) -> Symbols {
        let mut symbols = Symbols::strict();
        for p in &self.scene.parameters {
            let dimension = Some(p.dimension.clone());
            symbols.declare_as(p.name.clone(), p.latex.as_deref(), dimension);
        }
        for name in self.closed.keys() {
            let latex = name.contains('^').then(|| formula::latex_name(name));
            let dimension = self.dimensions.get(name).cloned();
            symbols.declare_as(name.clone(), latex.as_deref(), dimension);
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

    /// The components of a side: one of a number, three of a vector or a multiple of one that is asked for.
    fn components(&self, side: &Content) -> Option<Vec<Expr>> {
        if let Content::Vector(v) = side {
            return Some(v.to_vec());
        }
        let e = side.expr()?;
        let all = e.symbols().into_iter();
        let used: Vec<Symbol> = all.filter(|n| self.arrows.contains_key(n)).collect();
        if used.is_empty() {
            return Some(vec![e.clone()]);
        }
        let along = |axis: usize| -> BTreeMap<Symbol, Expr> {
            let part = |name: &Symbol| (name.clone(), self.arrows[name][axis].clone());
            used.iter().map(part).collect()
        };
        // Only what is linear in the vectors goes component by component.
        let linear = used.iter().all(|name| {
            let slope = e.derivative(name).symbols();
            used.iter().all(|other| !slope.contains(other))
        });
        let whole = e.substitute(&along(2)).is_zero() && linear;
        whole.then(|| (0..3).map(|axis| e.substitute(&along(axis))).collect())
    }

    fn read(&self, text: &str, printed: &Printed) -> Result<Reading, String> {
        formula::read(text, &self.symbols(printed)).map_err(|fault| fault.to_string())
    }

    /// Abbreviations, then closed forms, then special values put in.
    fn put_in(&self, e: &Expr, printed: &Printed) -> Result<Expr, String> {
        let map = |pairs: &[[String; 2]]| -> Result<BTreeMap<Symbol, Expr>, String> {
            let read = pairs.iter().map(|[name, text]| {
                let reading = self.read(text, printed)?;
                let value = reading.expr().cloned();
                let value = value.ok_or_else(|| format!("{text} is no expression"))?;
                Ok((Symbol::from(name.as_str()), value))
            });
            read.collect()
        };
        let mut out = e.clone();
        let short = map(&printed.short)?;
        // Abbreviations may use one another; as many rounds as there are settle it.
        for _ in &printed.short {
            out = out.substitute(&short);
        }
        let mut special = map(&printed.at)?;
        for angle in &printed.small {
            special.insert(Symbol::from(angle.as_str()), Expr::zero());
        }
        let parts = self.arrows.iter().flat_map(|(name, value)| {
            let axes = ["x", "y", "z"].iter().zip(value);
            axes.map(move |(axis, part)| (format!("{name}_{axis}").into(), part.clone()))
        });
        let out = out.substitute(&self.closed).substitute(&parts.collect());
        let symbols = out.symbols();
        if symbols.iter().any(|name| self.arrows.contains_key(name)) {
            return Err("a vector stands where a number belongs".into());
        }
        // A special value may be one that the scene answers with.
        for value in special.values_mut() {
            *value = value.substitute(&self.closed);
        }
        Ok(out.substitute(&special))
    }

    fn say(&self, e: &Expr) -> String {
        write_unicode(e, &|name| {
            let mut parameters = self.scene.parameters.iter();
            parameters.find(|p| *p.name == *name)?.latex.clone()
        })
    }

    fn check(&self, printed: &Printed) -> Finding {
        let (kind, text) = match &printed.what {
            Print::Formula { item, text } if text.contains(['=', '<', '>', '≤', '≥']) => {
                ("formula", format!("{item}: {text}"))
            }
            Print::Formula { item, text } => ("formula", format!("{item} = {text}")),
            Print::Number { text, of, .. } => ("number", format!("{of} = {text}")),
            Print::Equation {
                text,
                claim: Some(claim),
            } => ("claim", format!("{claim}: {text}")),
            Print::Equation { text, claim: None } => ("equation", text.clone()),
            Print::Matrix {
                entries, unknowns, ..
            } => (
                "matrix",
                format!("{} rows in {}", entries.len(), unknowns.join(", ")),
            ),
        };
        let mut finding = Finding {
            place: printed.place.clone(),
            kind,
            printed: text,
            ..Finding::default()
        };
        let outcome = match &printed.what {
            Print::Formula { item, text } => self.answer(printed, item, text, &mut finding),
            Print::Number { text, of, .. } => self.number(printed, text, of, &mut finding),
            Print::Equation { text, .. } => self.equation(printed, text, &mut finding),
            Print::Matrix {
                entries,
                unknowns,
                right,
            } => self.matrix(printed, entries, unknowns, right, &mut finding),
        };
        if let Err(message) = outcome {
            finding.because = message;
        }
        finding
    }

    /// A formula, a number with its unit, or both in a row: `omega = v/(2 l) = 5.2 rad/s`.
    fn answer(
        &self,
        printed: &Printed,
        item: &str,
        text: &str,
        finding: &mut Finding,
    ) -> Result<(), String> {
        let (before, last) = text.rsplit_once('=').unwrap_or(("", text));
        let number = formula::read(last, &Symbols::strict());
        let number = number.is_ok_and(|number| {
            matches!(number.content, Content::Quantity(_)) && number.literal.is_some()
        });
        if self.vectors.contains_key(item)
            && let Some(parts) = numbers(last)
        {
            for (axis, number) in ["x", "y"].iter().zip(parts) {
                self.number(printed, &number, &format!("{item}_{axis}"), finding)?;
                if finding.holds != Some(true) {
                    finding.because = format!("along {axis}, {}", finding.because);
                    break;
                }
            }
            return Ok(());
        }
        if !number || !self.closed.contains_key(item) {
            return self.formula(printed, item, text, finding);
        }
        if !before.is_empty() && before.trim() != item {
            self.formula(printed, item, before, finding)?;
            if finding.holds != Some(true) {
                return Ok(());
            }
        }
        self.number(printed, last, item, finding)
    }

    /// Whether an answer is a spin that counts clockwise.
    fn is_clockwise(&self, item: &str) -> bool {
        let mut questions = self.scene.questions.iter();
        let clockwise = |ask: &Ask| {
            matches!(
                ask,
                Ask::Spin {
                    clockwise: true,
                    ..
                }
            )
        };
        questions.any(|q| q.name == item && clockwise(&q.ask))
    }

    fn formula(
        &self,
        printed: &Printed,
        item: &str,
        text: &str,
        finding: &mut Finding,
    ) -> Result<(), String> {
        let reading = self.read(text, printed)?;
        let name = Symbol::from(item);
        let bound = self.bound(&name, &reading.content);
        let said = self.said_of(&name, &reading.content);
        let is_said = bound.is_none() && said.is_some();
        let pairs: Vec<(Expr, Expr)> = match (
            &bound,
            self.vectors.get(&name),
            self.closed.get(&name),
            reading.content.answer(),
        ) {
            (Some((_, value, derived)), ..) => vec![(derived.clone(), value.clone())],
            (None, ..) if is_said => said.into_iter().collect(),
            (_, _, Some(closed), content) => {
                let value = match content {
                    // Along k, out of the page, whichever way the answer counts.
                    Content::Vector([x, y, z]) if x.is_zero() && y.is_zero() => {
                        match self.is_clockwise(item) {
                            true => -z,
                            false => z.clone(),
                        }
                    }
                    other => other
                        .expr()
                        .cloned()
                        .ok_or(format!("{item} is a value, and none is printed"))?,
                };
                vec![(closed.clone(), value)]
            }
            (_, Some(vector), None, Content::Vector(v)) => vector
                .iter()
                .cloned()
                .zip(v[..2].iter().cloned())
                .chain([(Expr::zero(), v[2].clone())])
                .collect(),
            (_, Some(_), None, _) => {
                return Err(format!("{item} is a vector, and a number is printed"));
            }
            (_, None, None, _) => return Err(self.unanswered(item)),
        };
        let mut shown = Vec::new();
        let mut all = Vec::new();
        for (closed, value) in &pairs {
            let closed = self.put_in(closed, printed)?;
            shown.push(match is_said {
                true => self.tidy(&closed),
                false => self.say(&closed),
            });
            all.push((closed, self.put_in(value, printed)?));
        }
        shown.truncate(if pairs.len() == 3 { 2 } else { 1 });
        finding.carom = if shown.len() == 1 {
            shown.remove(0)
        } else {
            format!("[{}]", shown.join(", "))
        };
        self.identities(&all, printed, finding);
        let decimal = decimal_in(text).filter(|_| finding.holds == Some(false));
        let is_number = matches!(all.as_slice(), [(closed, _)] if closed.is_constant());
        if let Some(decimal) = decimal.filter(|_| is_number) {
            self.number(printed, decimal, item, finding)?;
        }
        if let Some((sign, ..)) = bound {
            self.sense(&name, sign, finding);
        }
        if decimal.is_some() && is_number {
            return Ok(());
        }
        if finding.holds == Some(false) && finding.explained.is_none() {
            self.caught(&all, finding);
            finding.explained = self
                .before(item, &all)
                .or_else(|| self.place(item, &all))
                .or_else(|| self.factor(&all))
                .or_else(|| self.exchanged(&all))
                .or_else(|| self.sought(&all))
                .or_else(|| self.slip(&all))
                .or_else(|| self.component(&all))
                .or_else(|| self.short_factor(&all));
        }
        Ok(())
    }

    /// `cos(alpha) = …` and `e = sqrt(H/h)` say what alpha and H are: both sides with the item, or the parameter that it gives,
    /// as that is in truth.
    fn said_of(&self, item: &Symbol, content: &Content) -> Option<(Expr, Expr)> {
        let Content::Relations(sides, signs) = content else {
            return None;
        };
        let ([left, right], [Relation::Equal]) = (&sides[..], &signs[..]) else {
            return None;
        };
        let (left, right) = (left.expr()?, right.expr()?);
        let (name, truth) = match self.bounds.get(item) {
            Some((of, _, value)) => (of.as_symbol()?, value),
            None => (item, self.closed.get(item)?),
        };
        if left.as_symbol().is_some_and(|s| s == name || s == item) {
            return None;
        }
        let there = |e: &Expr| e.put(name, truth).put(item, truth);
        let spoken = [left, right]
            .iter()
            .any(|e| e.mentions(name) || e.mentions(item));
        spoken.then(|| (there(left), there(right)))
    }

    fn equation(&self, printed: &Printed, text: &str, finding: &mut Finding) -> Result<(), String> {
        let reading = self.read(text, printed)?;
        let Content::Relations(sides, signs) = &reading.content else {
            return Err("an equation has two sides".into());
        };
        let mut values: Vec<Vec<Expr>> = Vec::new();
        for side in sides {
            let parts = self
                .components(side)
                .ok_or("a side of the equation is neither a number nor a vector")?;
            let parts = parts.iter().map(|e| self.put_in(e, printed));
            values.push(parts.collect::<Result<_, _>>()?);
        }
        let size = values.iter().map(Vec::len).max().unwrap_or(1);
        for parts in values.iter_mut().filter(|parts| parts.len() < size) {
            if !parts[0].is_zero() {
                return Err("one side is a vector and another a number".into());
            }
            parts.resize(size, Expr::zero());
        }
        if signs.iter().all(|s| *s == Relation::Equal) {
            let rows = values.windows(2);
            let pairs: Vec<(Expr, Expr)> = rows
                .flat_map(|w| w[0].iter().cloned().zip(w[1].iter().cloned()))
                .collect();
            let shown = values.iter().map(|parts| {
                let parts: Vec<String> = parts.iter().map(|v| self.tidy(v)).collect();
                match parts.as_slice() {
                    [x, y, _] => format!("[{x}, {y}]"),
                    one => one.concat(),
                }
            });
            finding.carom = shown.collect::<Vec<_>>().join(" against ");
            self.identities(&pairs, printed, finding);
            if finding.holds == Some(false) {
                self.caught(&pairs, finding);
                finding.explained = self
                    .turned(sides, printed)
                    .or_else(|| self.factor(&pairs))
                    .or_else(|| self.exchanged(&pairs))
                    .or_else(|| self.sought(&pairs))
                    .or_else(|| self.slip_in_equation(sides, printed))
                    .or_else(|| self.lacking(&pairs))
                    .or_else(|| self.short_factor(&pairs))
                    .or_else(|| self.condition(sides, printed));
            }
            return Ok(());
        }
        if size > 1 {
            return Err("an inequality compares numbers, and a side is a vector".into());
        }
        let values: Vec<Expr> = values.into_iter().flatten().collect();
        self.claimed(&values, signs, finding);
        Ok(())
    }

    fn tidy(&self, e: &Expr) -> String {
        let mut field = crate::algebra::Field::new(&self.scene.domains);
        field.prepare([e]);
        match field.element(e) {
            Ok(x) => self.say(&field.expr(&x)),
            Err(_) => self.say(e),
        }
    }

    fn identities(&self, pairs: &[(Expr, Expr)], printed: &Printed, finding: &mut Finding) {
        let mut holds = Some(true);
        finding.because = match printed.small.is_empty() {
            true => "identity".to_string(),
            false => format!(
                "identity to leading order in small {}",
                printed.small.join(", ")
            ),
        };
        for (closed, value) in pairs {
            match equality::decide(closed, value, &self.scene.domains).equality {
                Equality::Same { .. } => {}
                Equality::Different(c) => {
                    let [carom, book] = c.values();
                    let place = c.at.words();
                    finding.because = match place.is_empty() {
                        true => format!("{carom} against {book}"),
                        false => format!("at {place}: {carom} against {book}"),
                    };
                    holds = Some(false);
                    break;
                }
                Equality::Invalid { .. } => {
                    finding.because = "one side has no value".into();
                    holds = Some(false);
                    break;
                }
                Equality::Undecided { .. } => {
                    finding.because = "not decided".into();
                    holds = None;
                }
            }
        }
        finding.holds = holds;
    }
}

/// The components of a vector in numbers, each with the unit behind all: `[-1.84, 3.12] N s`.
fn numbers(text: &str) -> Option<[String; 2]> {
    let (inside, unit) = text
        .trim()
        .strip_prefix(['[', '('])?
        .split_once([']', ')'])?;
    let (x, y) = inside.split_once(',')?;
    let number = |part: &str| {
        let text = format!("{} {}", part.trim(), unit.trim());
        let read = formula::read(&text, &Symbols::strict()).ok()?;
        read.literal.map(|_| text)
    };
    Some([number(x)?, number(y)?])
}

/// The decimal number in its unit that is printed by itself, or as the bound of something: rounded, like every decimal.
fn decimal_in(text: &str) -> Option<&str> {
    let mut sides = text.split(['<', '>', '=', '≤', '≥']).map(str::trim);
    sides.find(|side| {
        side.contains('.')
            && formula::read(side, &Symbols::strict()).is_ok_and(|r| r.literal.is_some())
    })
}

/// Which coefficient of friction a threshold bounds, and how it stands to it.
pub(crate) fn friction_bound(scene: &Scene, name: &str) -> Option<(Expr, Relation)> {
    let question = scene.question(name)?;
    let Ask::Friction { contact, event } = &question.ask else {
        return None;
    };
    // Of another impact than the scene's own the contact has another number.
    let law = match (question.stage, &scene.contacts.get(*contact)?.law) {
        (None, ContactLaw::Friction(law)) => law,
        (None, ContactLaw::Decided(decided)) => &decided.law,
        _ => return None,
    };
    let relation = match event {
        FrictionEvent::Slides => Relation::LessEqual,
        FrictionEvent::Sticks | FrictionEvent::Jams => Relation::GreaterEqual,
    };
    Some((law.mu.clone(), relation))
}

/// What is asked of velocities and spins, just before: one value, or two components.
fn before(scene: &Scene) -> Vec<(&str, Vec<Expr>)> {
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
        Some((q.name.as_str(), value))
    });
    asked.collect()
}
