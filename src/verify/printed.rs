//! What a book prints about a scene, held against what carom derives: formulas, numbers, equations, claims, matrices.
//!
//! A formula or equation holds when it is an identity in the closed forms; a number when it is the exact value rounded to
//! its own digits; a row of a matrix when it is a law, not merely true of this one solution. What does not hold comes with
//! the value it should have, a slip that explains it where one is found, and the cheap check that would have caught it.

use std::collections::BTreeMap;

use num_traits::Signed;

use super::rounding::{bounds, ten_to};
use super::row_space;
use super::slip;
use crate::derive::{Answer, Derivation, Form};
use crate::dimension::{self, Dimension};
use crate::equality::{self, Equality};
use crate::expr::{Expr, Point, Rational, Symbol, ratio};
use crate::formula::{self, Content, Reading, Relation, Symbols, write_plain, write_unicode};
use crate::laws;
use crate::scene::{Print, Printed, Scene};

/// The finding about one printed thing.
#[derive(Clone, Debug)]
pub struct Finding {
    /// Where it is printed.
    pub place: String,
    /// `formula`, `number`, `equation`, `claim`, `matrix`.
    pub kind: &'static str,
    /// What is printed.
    pub printed: String,
    /// Whether it holds; `None` where that could not be found out.
    pub holds: Option<bool>,
    /// What carom has in its place.
    pub carom: String,
    /// How it is known.
    pub because: String,
    /// What produced a wrong value, where that was found.
    pub explained: Option<String>,
    /// The cheap check that would have caught it.
    pub caught_by: Option<String>,
}

/// Checks everything printed about a scene.
pub fn check(scene: &Scene, derivation: &Derivation) -> Vec<Finding> {
    let desk = Desk::new(scene, derivation);
    let mut findings: Vec<Finding> = scene
        .printed
        .iter()
        .map(|printed| desk.check(printed))
        .collect();
    desk.consequences(&mut findings);
    findings
}

/// What formulas are read and evaluated with.
struct Desk<'a> {
    scene: &'a Scene,
    /// Closed forms by name.
    closed: BTreeMap<Symbol, Expr>,
    /// Components of vectors by name.
    vectors: BTreeMap<Symbol, [Expr; 2]>,
    dimensions: BTreeMap<Symbol, Dimension>,
}

impl<'a> Desk<'a> {
    fn new(scene: &'a Scene, derivation: &Derivation) -> Desk<'a> {
        let mut closed = BTreeMap::new();
        let mut dimensions: BTreeMap<Symbol, Dimension> = scene
            .parameters
            .iter()
            .map(|p| (p.name.clone(), p.dimension.clone()))
            .collect();
        // Places of centers, so that geometry can be checked too.
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
        let whole = |n: usize| Expr::from(n as i64);
        closed.insert("equations".into(), whole(derivation.counting.equations));
        closed.insert("unknowns".into(), whole(derivation.counting.unknowns));
        for unknown in laws::unknowns(scene) {
            if let Some(value) = derivation.motion.get(&unknown) {
                let value = if derivation.names.is_reversed(unknown) {
                    -value
                } else {
                    value.clone()
                };
                closed.insert(Symbol::from(derivation.names.plain(unknown)), value);
            }
        }
        let mut vectors: BTreeMap<Symbol, [Expr; 2]> = BTreeMap::new();
        for answer in &derivation.answers {
            if let Form::Value { closed: value, .. } = &answer.form {
                let name = Symbol::from(answer.name.as_str());
                dimensions.insert(name.clone(), answer.dimension.clone());
                closed.insert(name, value.clone());
                if answer.name != answer.question {
                    let vector = vectors
                        .entry(Symbol::from(answer.question.as_str()))
                        .or_insert_with(|| [Expr::zero(), Expr::zero()]);
                    vector[usize::from(answer.name.ends_with("_y"))] = value.clone();
                }
            }
        }
        Desk {
            scene,
            closed,
            vectors,
            dimensions,
        }
    }

    fn symbols(&self, printed: &Printed) -> Symbols {
        let mut symbols = Symbols::strict();
        for p in &self.scene.parameters {
            symbols.declare_as(&p.name, p.latex.as_deref(), Some(p.dimension.clone()));
        }
        for name in self.closed.keys() {
            symbols.declare_as(name, None, self.dimensions.get(name).cloned());
        }
        for [name, _] in &printed.short {
            symbols.declare(name);
        }
        symbols
    }

    fn read(&self, text: &str, printed: &Printed) -> Result<Reading, String> {
        formula::read(text, &self.symbols(printed)).map_err(|fault| fault.to_string())
    }

    /// Abbreviations, then closed forms, then special values put in.
    fn put_in(&self, e: &Expr, printed: &Printed) -> Result<Expr, String> {
        let map = |pairs: &[[String; 2]]| -> Result<BTreeMap<Symbol, Expr>, String> {
            pairs
                .iter()
                .map(|[name, text]| {
                    let reading = self.read(text, printed)?;
                    let value = reading
                        .expr()
                        .ok_or_else(|| format!("{text} is no expression"))?;
                    Ok((Symbol::from(name.as_str()), value.clone()))
                })
                .collect()
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
        Ok(out.substitute(&self.closed).substitute(&special))
    }

    fn say(&self, e: &Expr) -> String {
        let names: BTreeMap<&str, &str> = self
            .scene
            .parameters
            .iter()
            .filter_map(|p| Some((&*p.name, p.latex.as_deref()?)))
            .collect();
        write_unicode(e, &|name| names.get(name).map(|l| (*l).to_string()))
    }

    fn check(&self, printed: &Printed) -> Finding {
        let (kind, text) = match &printed.what {
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
            holds: None,
            carom: String::new(),
            because: String::new(),
            explained: None,
            caught_by: None,
        };
        let outcome = match &printed.what {
            Print::Formula { item, text } => self.formula(printed, item, text, &mut finding),
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

    fn formula(
        &self,
        printed: &Printed,
        item: &str,
        text: &str,
        finding: &mut Finding,
    ) -> Result<(), String> {
        let reading = self.read(text, printed)?;
        let name = Symbol::from(item);
        let pairs: Vec<(Expr, Expr)> = match (
            self.vectors.get(&name),
            self.closed.get(&name),
            reading.content.answer(),
        ) {
            (_, Some(closed), content) => {
                let value = match content {
                    Content::Vector([x, y, z]) if x.is_zero() && y.is_zero() => z.clone(),
                    other => other
                        .expr()
                        .cloned()
                        .ok_or("the printed formula is no single expression")?,
                };
                vec![(closed.clone(), value)]
            }
            (Some(vector), None, Content::Vector(v)) => vector
                .iter()
                .cloned()
                .zip(v[..2].iter().cloned())
                .chain([(Expr::zero(), v[2].clone())])
                .collect(),
            (Some(_), None, _) => {
                return Err(format!("{item} is a vector, and a number is printed"));
            }
            (None, None, _) => return Err(format!("the scene answers no {item}")),
        };
        let mut shown = Vec::new();
        let mut all = Vec::new();
        for (closed, value) in &pairs {
            let closed = self.put_in(closed, printed)?;
            shown.push(self.say(&closed));
            all.push((closed, self.put_in(value, printed)?));
        }
        shown.truncate(if pairs.len() == 3 { 2 } else { 1 });
        finding.carom = if shown.len() == 1 {
            shown.remove(0)
        } else {
            format!("[{}]", shown.join(", "))
        };
        self.identities(&all, printed, finding);
        if finding.holds == Some(false) {
            self.caught(&all, finding);
            finding.explained = self.before(item, &all).or_else(|| self.exchanged(&all));
        }
        Ok(())
    }

    /// A velocity or spin before the collision, printed as the one after.
    fn before(&self, item: &str, pairs: &[(Expr, Expr)]) -> Option<String> {
        use crate::scene::Ask;
        let question = self.scene.questions.iter().find(|q| q.name == item)?;
        let before = match &question.ask {
            Ask::Velocity {
                body,
                point: None,
                along: None,
            } => self.scene.bodies[*body].velocity.to_vec(),
            Ask::Spin { body, .. } => vec![self.scene.bodies[*body].spin.clone()],
            _ => return None,
        };
        let same = |(b, (_, value)): (&Expr, &(Expr, Expr))| {
            matches!(
                equality::decide(b, value, &self.scene.domains).equality,
                Equality::Same { .. }
            )
        };
        before
            .iter()
            .zip(pairs)
            .all(same)
            .then(|| "it is the value before the collision: the superscript is wrong".to_string())
    }

    /// Sides that agree when two parameters of one kind are exchanged in one of them.
    fn exchanged(&self, pairs: &[(Expr, Expr)]) -> Option<String> {
        let parameters = &self.scene.parameters;
        for (i, p) in parameters.iter().enumerate() {
            for q in parameters[i + 1..]
                .iter()
                .filter(|q| q.dimension == p.dimension)
            {
                let swap = BTreeMap::from([
                    (p.name.clone(), Expr::symbol(&q.name)),
                    (q.name.clone(), Expr::symbol(&p.name)),
                ]);
                let same = |(a, b): &(Expr, Expr)| {
                    matches!(
                        equality::decide(a, &b.substitute(&swap), &self.scene.domains).equality,
                        Equality::Same { .. }
                    )
                };
                if pairs.iter().all(same) {
                    return Some(format!(
                        "it holds with {} and {} exchanged on one side",
                        p.name, q.name
                    ));
                }
            }
        }
        None
    }

    fn equation(&self, printed: &Printed, text: &str, finding: &mut Finding) -> Result<(), String> {
        let reading = self.read(text, printed)?;
        let Content::Relations(sides, signs) = &reading.content else {
            return Err("an equation has two sides".into());
        };
        let mut values = Vec::new();
        for side in sides {
            let e = side
                .expr()
                .ok_or("a side of the equation is no single expression")?;
            values.push(self.put_in(e, printed)?);
        }
        if signs.iter().all(|s| *s == Relation::Equal) {
            let pairs: Vec<(Expr, Expr)> = values
                .windows(2)
                .map(|w| (w[0].clone(), w[1].clone()))
                .collect();
            finding.carom = values
                .iter()
                .map(|v| self.tidy(v))
                .collect::<Vec<_>>()
                .join(" against ");
            self.identities(&pairs, printed, finding);
            if finding.holds == Some(false) {
                self.caught(&pairs, finding);
                finding.explained = self
                    .turned(sides, printed)
                    .or_else(|| self.exchanged(&pairs));
            }
            return Ok(());
        }
        // An inequality claimed on the whole domain: the sign of each difference.
        let mut holds = Some(true);
        for (pair, sign) in values.windows(2).zip(signs) {
            let one = self.inequality(&pair[0], &pair[1], *sign, finding);
            holds = match (holds, one) {
                (_, Some(false)) => Some(false),
                (Some(false), _) => Some(false),
                (_, None) => None,
                (h, Some(true)) => h,
            };
        }
        finding.holds = holds;
        Ok(())
    }

    /// An equation that would hold with the sign of one side turned.
    fn turned(&self, sides: &[Content], printed: &Printed) -> Option<String> {
        let [left, right] = sides else { return None };
        let (l, r) = (
            self.put_in(left.expr()?, printed).ok()?,
            self.put_in(right.expr()?, printed).ok()?,
        );
        let same = matches!(
            equality::decide(&l, &-&r, &self.scene.domains).equality,
            Equality::Same { .. }
        );
        same.then(|| "it holds with the sign of one side turned".to_string())
    }

    fn tidy(&self, e: &Expr) -> String {
        let mut field = crate::algebra::Field::new(&self.scene.domains);
        field.prepare([e]);
        match field.element(e) {
            Ok(x) => self.say(&field.expr(&x)),
            Err(_) => self.say(e),
        }
    }

    fn inequality(
        &self,
        a: &Expr,
        b: &Expr,
        sign: Relation,
        finding: &mut Finding,
    ) -> Option<bool> {
        use crate::algebra::Sign;
        let mut field = crate::algebra::Field::new(&self.scene.domains);
        let difference = b - a;
        field.prepare([&difference]);
        let element = field.element(&difference).ok()?;
        let known = field.sign(&element)?;
        let known = if matches!(sign, Relation::Greater | Relation::GreaterEqual) {
            known.flip()
        } else {
            known
        };
        finding.because = "sign of the difference on the domain".into();
        Some(match sign {
            Relation::Less | Relation::Greater => known == Sign::Positive,
            Relation::LessEqual | Relation::GreaterEqual => known.is_not_negative(),
            _ => return None,
        })
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

    /// The cheapest check that shows a pair to be wrong.
    fn caught(&self, pairs: &[(Expr, Expr)], finding: &mut Finding) {
        let known = |name: &str| self.dimensions.get(name).cloned();
        for (closed, value) in pairs {
            if matches!(
                equality::decide(closed, value, &self.scene.domains).equality,
                Equality::Same { .. }
            ) {
                continue;
            }
            let dimensions = [closed, value].map(|e| dimension::of(e, &known).ok().flatten());
            if let [Some(a), Some(b)] = &dimensions
                && a != b
            {
                finding.caught_by = Some(format!("dimensions: {b} instead of {a}"));
                return;
            }
            let minus = -value;
            if matches!(
                equality::decide(closed, &minus, &self.scene.domains).equality,
                Equality::Same { .. }
            ) {
                finding.caught_by =
                    Some("signs: a sketch of the motion, since only the sign is wrong".into());
                return;
            }
            // Limits: each parameter at 0, where both sides have a value.
            for p in &self.scene.parameters {
                let at_zero = BTreeMap::from([(p.name.clone(), Expr::zero())]);
                let (a, b) = (closed.substitute(&at_zero), value.substitute(&at_zero));
                let shorter =
                    a.symbols().len() + 1 < closed.symbols().len() || a.size() < closed.size() / 2;
                if shorter
                    && let Equality::Different(_) =
                        equality::decide(&a, &b, &self.scene.domains).equality
                {
                    finding.caught_by = Some(format!("limit: let {} go to 0", p.name));
                    return;
                }
            }
        }
        finding.caught_by =
            Some("putting simple numbers in, or the result back into the laws".into());
    }

    fn number(
        &self,
        printed: &Printed,
        text: &str,
        of: &str,
        finding: &mut Finding,
    ) -> Result<(), String> {
        let reading = formula::read(text, &Symbols::strict()).map_err(|f| f.to_string())?;
        let target = self.read(of, printed)?;
        let of_expr = target
            .expr()
            .ok_or_else(|| format!("{of} is no single expression"))?;
        let exact = self.value(&self.put_in(of_expr, printed)?)?;
        let (value, unit) = match &reading.content {
            Content::Quantity(q) => {
                let known = |name: &str| self.dimensions.get(name).cloned();
                if let Ok(Some(is)) = dimension::of(of_expr, &known)
                    && is != q.unit.dimension
                {
                    finding.holds = Some(false);
                    finding.carom = is.si();
                    finding.because = format!(
                        "{} measures {}, and {of} is {is}",
                        q.unit_text, q.unit.dimension
                    );
                    finding.caught_by = Some("dimensions".into());
                    return Ok(());
                }
                (q.written.clone(), q.unit.value())
            }
            other => (
                other
                    .expr()
                    .cloned()
                    .ok_or("the printed number is no number")?,
                Expr::one(),
            ),
        };
        let unit = super::rounding::fraction(&unit).ok_or("the unit has no exact size")?;
        let written =
            super::rounding::fraction(&value).ok_or("the printed number is no fraction")?;
        let place = reading
            .literal
            .as_ref()
            .map_or_else(|| last_place(text), |l| l.place);
        let half = ten_to(place) * ratio(1, 2);
        let [low, high] = exact.clone().map(|v| v / &unit);
        let off = (&written - &low).abs().max((&written - &high).abs());
        let digits = (crate::verify::rounding::magnitude_or_zero(&low) - place + 2).max(3) as u32;
        finding.carom = crate::interval::enclosure::decimal(&low, digits);
        if off <= half {
            finding.holds = Some(true);
            finding.because = "the exact value, rounded to the printed digits".into();
            return Ok(());
        }
        finding.holds = Some(false);
        finding.because = format!(
            "the exact value is {}, not within half a unit of the last printed digit",
            finding.carom
        );
        if off <= ten_to(place) {
            finding.explained = Some("the last digit was cut off or rounded the wrong way".into());
        } else if (&written + &low).abs() <= half {
            finding.explained = Some("the sign is wrong".into());
        }
        finding.caught_by = Some("putting the numbers into the printed formula".into());
        if finding.explained.is_none() {
            finding.explained = self.slips(of_expr, &written, &half, &unit);
        }
        Ok(())
    }

    /// A single slip in evaluating a formula for the same quantity that gives the printed number.
    fn slips(
        &self,
        of: &Expr,
        written: &Rational,
        half: &Rational,
        unit: &Rational,
    ) -> Option<String> {
        let name = of.as_symbol()?;
        let wanted = crate::expr::number::to_f64(&(written * unit));
        let room = crate::expr::number::to_f64(&(half * unit)) * 1.000_001;
        // The book's own formula first, as it stands; then carom's.
        let mut formulas: Vec<Expr> = Vec::new();
        for p in &self.scene.printed {
            let Print::Formula { item, text } = &p.what else {
                continue;
            };
            let Ok(reading) = self.read(text, p) else {
                continue;
            };
            let component = match reading.content.answer() {
                Content::Vector(v) if **name == *format!("{item}_x") => Some(v[0].clone()),
                Content::Vector(v) if **name == *format!("{item}_y") => Some(v[1].clone()),
                other if **name == **item => other.expr().cloned(),
                _ => None,
            };
            formulas.extend(component);
        }
        formulas.extend(self.closed.get(name).cloned());
        let mut values = Point::<f64>::default();
        for p in &self.scene.parameters {
            values.values.insert(
                p.name.clone(),
                p.value.as_ref()?.evaluate(&Point::default())?,
            );
        }
        let kin = |a: &Symbol, b: &Symbol| self.dimensions.get(a) == self.dimensions.get(b);
        formulas
            .iter()
            .find_map(|e| slip::explains(e, &values, wanted, room, &kin, &|e| self.say(e)))
    }

    /// Bounds of an expression at the scene's values.
    fn value(&self, e: &Expr) -> Result<[Rational; 2], String> {
        let values: BTreeMap<Symbol, Expr> = self
            .scene
            .parameters
            .iter()
            .filter_map(|p| Some((p.name.clone(), p.value.clone()?)))
            .collect();
        let put_in = e.substitute(&values);
        if let Some(name) = put_in.symbols().into_iter().next() {
            return Err(format!("the scene gives {name} no value"));
        }
        bounds(&put_in).ok_or_else(|| format!("{} has no value", write_plain(e)))
    }

    /// Wrong numbers that follow from wrong numbers before them.
    fn consequences(&self, findings: &mut [Finding]) {
        let printed = &self.scene.printed;
        for i in 0..findings.len() {
            let Print::Number {
                text,
                from: Some(from),
                ..
            } = &printed[i].what
            else {
                continue;
            };
            if findings[i].holds != Some(false) {
                continue;
            }
            let Ok(reading) = self.read(from, &printed[i]) else {
                continue;
            };
            let Some(formula) = reading.expr() else {
                continue;
            };
            for j in 0..i {
                let Print::Number {
                    text: earlier, of, ..
                } = &printed[j].what
                else {
                    continue;
                };
                if findings[j].holds != Some(false)
                    || !formula.symbols().iter().any(|s| **s == **of)
                {
                    continue;
                }
                let Some(wrong) = number_of(earlier) else {
                    continue;
                };
                let with = formula.substitute(&BTreeMap::from([(
                    Symbol::from(of.as_str()),
                    Expr::from(wrong),
                )]));
                let Ok([low, _]) = self.put_in(&with, &printed[i]).and_then(|e| self.value(&e))
                else {
                    continue;
                };
                let Some(mine) = number_of(text) else {
                    continue;
                };
                if (mine - low).abs() <= ten_to(last_place(text)) * ratio(1, 2) {
                    findings[i].explained = Some(format!(
                        "follows from the earlier {earlier} for {of}; no misprint of its own"
                    ));
                }
            }
        }
    }

    fn matrix(
        &self,
        printed: &Printed,
        entries: &[Vec<String>],
        unknowns: &[String],
        right: &[String],
        finding: &mut Finding,
    ) -> Result<(), String> {
        let expr = |text: &String| -> Result<Expr, String> {
            let reading = self.read(text, printed)?;
            let e = reading
                .expr()
                .ok_or_else(|| format!("{text} is no expression"))?
                .clone();
            // Known quantities only: an unknown in an entry stays what it is.
            Ok(e.substitute(&self.known_only()))
        };
        let mut rows = Vec::new();
        for (row, rhs) in entries.iter().zip(right) {
            let row: Result<Vec<Expr>, String> = row.iter().map(expr).collect();
            rows.push((row?, expr(rhs)?));
        }
        let mut scene = self.scene.clone();
        for [name, text] in &printed.at {
            let value = self
                .read(text, printed)?
                .expr()
                .and_then(super::rounding::fraction);
            let value = value.ok_or_else(|| format!("{name} = {text} is no fraction"))?;
            let only = crate::domain::Domain::between(value.clone(), value);
            scene
                .domains
                .symbols
                .insert(Symbol::from(name.as_str()), only);
        }
        let verdicts = row_space::judge(&scene, unknowns, &rows)?;
        let mut wrong = Vec::new();
        finding.holds = Some(true);
        for (i, verdict) in verdicts.iter().enumerate() {
            match verdict {
                row_space::Row::Law => {}
                row_space::Row::Masked(mend) | row_space::Row::Wrong(mend) => {
                    finding.holds = Some(false);
                    let masked = matches!(verdict, row_space::Row::Masked(_));
                    let mut words = format!("row {} is no law", i + 1);
                    if masked {
                        words.push_str(", though this solution fulfils it: the mistake is masked");
                    } else {
                        words.push_str(", and the solution does not fulfil it");
                    }
                    if let Some((column, better)) = mend {
                        words.push_str(&format!(
                            "; with {} in column {} (of {}) in place of {} it would be",
                            self.say(better),
                            column + 1,
                            unknowns[*column],
                            self.say(&rows[i].0[*column])
                        ));
                        finding.carom =
                            format!("entry ({}, {}) is {}", i + 1, column + 1, self.say(better));
                    }
                    wrong.push(words);
                }
            }
        }
        finding.because = match wrong.is_empty() {
            true => "every row is a combination of the laws, at exact points of the domain".into(),
            false => wrong.join("; "),
        };
        if !wrong.is_empty() {
            finding.caught_by = Some("holding each row against the equation it comes from".into());
        }
        Ok(())
    }

    fn known_only(&self) -> BTreeMap<Symbol, Expr> {
        let given = |name: &Symbol| {
            name.starts_with("I_") || name.starts_with("x_") || name.starts_with("y_")
        };
        self.closed
            .iter()
            .filter(|(name, _)| given(name))
            .map(|(n, e)| (n.clone(), e.clone()))
            .collect()
    }
}

/// Answers of a derivation by name, for those who list them.
pub fn answer<'a>(derivation: &'a Derivation, name: &str) -> Option<&'a Answer> {
    derivation.answers.iter().find(|a| a.name == name)
}

/// The number at the head of a text such as `-2.08 m/s`, in the unit written.
fn number_of(text: &str) -> Option<Rational> {
    let reading = formula::read(text, &Symbols::strict()).ok()?;
    match &reading.content {
        Content::Quantity(q) => super::rounding::fraction(&q.value),
        other => super::rounding::fraction(other.expr()?),
    }
}

/// The power of ten of the last digit of the number at the head of a text.
fn last_place(text: &str) -> i32 {
    let digits: String = text
        .trim_start_matches(['-', '+', '−', ' '])
        .chars()
        .take_while(|c| c.is_ascii_digit() || *c == '.')
        .collect();
    let after = digits.split_once('.').map_or(0, |(_, d)| d.len());
    -(after as i32)
}
