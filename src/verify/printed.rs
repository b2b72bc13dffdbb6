//! What a book prints about a scene, held against what carom derives: formulas, numbers, equations, claims, matrices.
//!
//! A formula or equation holds when it is an identity in the closed forms; a number when it is the exact value rounded to
//! its own digits; a row of a matrix when it is a law, not merely true of this one solution. What does not hold comes with
//! the value it should have, a slip that explains it where one is found, and the cheap check that would have caught it.

mod cases;
mod desk;
mod explain;
mod inequality;
mod matrix;
mod number;
mod remainder;

pub use cases::in_cases;
use desk::Desk;
pub(crate) use desk::friction_bound;
use number::{decimal_in, numbers};

use crate::answer::Answer;
use crate::derive::Derivation;
use crate::equality::{self, Equality};
use crate::expr::{Expr, Symbol};
use crate::formula::{self, Content, Quantity, Relation, Symbols};
use crate::scene::{Ask, Print, Printed, Scene};

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
    /// Under which conditions it holds, and in which cases of friction, where it does not in all of them.
    pub only_where: Option<String>,
    /// Those conditions, one each.
    #[serde(skip)]
    given: Vec<String>,
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
    for (finding, printed) in findings.iter_mut().zip(&scene.printed) {
        if let (Some(true), Print::Formula { item, .. }) = (finding.holds, &printed.what) {
            finding.given = conditions(all, item);
            finding.only_where = cases::in_words(&finding.given);
        }
    }
    for finding in findings.iter_mut().filter(|f| f.holds == Some(false)) {
        finding.explained.get_or_insert_with(|| UNEXPLAINED.into());
    }
    findings
}

/// What an answer rests on beyond what the scene states.
fn conditions(all: &[Answer], item: &str) -> Vec<String> {
    let is_it = |a: &&Answer| a.name == item || a.question == item;
    let given = all
        .iter()
        .find(is_it)
        .into_iter()
        .flat_map(|a| &a.assumptions);
    let conditions = given.filter(|words| words.condition().is_some());
    conditions.map(ToString::to_string).collect()
}

impl Desk<'_> {
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
        if self.breaks_in_the_middle(printed, item, text, finding) {
            return Ok(());
        }
        let (before, last) = text.rsplit_once('=').unwrap_or(("", text));
        let number = formula::read(last, &Symbols::strict());
        // `9h` is nine times a height h, unless a time is asked for.
        let is_unit = |q: &Quantity| {
            let target = self.closed.get(item);
            target.is_some_and(|of| self.other_dimension(of, q).is_none())
                || !self.read(last, printed).is_ok_and(|in_names| {
                    let names = in_names.expr().map(Expr::symbols);
                    names.is_some_and(|names| !names.is_empty())
                })
        };
        let number = number.is_ok_and(|number| match &number.content {
            Content::Quantity(q) => number.literal.is_some() && is_unit(q),
            _ => false,
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

    /// Whether a formula between the first and the last of a row `omega = … = …` is wrong; then that is what is found.
    fn breaks_in_the_middle(
        &self,
        printed: &Printed,
        item: &str,
        text: &str,
        finding: &mut Finding,
    ) -> bool {
        let sides: Vec<&str> = text.split('=').collect();
        let [first, middle @ .., _] = sides.as_slice() else {
            return false;
        };
        let named = self.read(first, printed).ok();
        let is_row = named.is_some_and(|name| name.expr().is_some_and(|e| e.as_symbol().is_some()))
            && !text.contains(['<', '>', '≤', '≥', '≈']);
        is_row
            && middle.iter().any(|side| {
                let mut own = Finding {
                    place: finding.place.clone(),
                    kind: finding.kind,
                    printed: finding.printed.clone(),
                    ..Finding::default()
                };
                let judged = self.formula(printed, item, side, &mut own);
                let is_wrong = judged.is_ok() && own.holds == Some(false);
                if is_wrong {
                    *finding = own;
                }
                is_wrong
            })
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
        if reading.content.answer().expr().and_then(Expr::as_symbol) == Some(&name) {
            return Err(format!("{item} stands for itself, and no value is printed"));
        }
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
        // What holds whatever the item is says nothing of it.
        let is_empty = || equality::identical(left, right, &self.scene.domains);
        (spoken && !is_empty()).then(|| (there(left), there(right)))
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
