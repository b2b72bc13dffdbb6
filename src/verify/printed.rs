//! What a book prints about a scene, held against what carom derives: formulas, numbers, equations, claims, matrices.
//!
//! A formula or equation holds when it is an identity in the closed forms; a number when it is the exact value rounded to
//! its own digits; a row of a matrix when it is a law, not merely true of this one solution. What does not hold comes with
//! the value it should have, a slip that explains it where one is found, and the cheap check that would have caught it.

mod cases;
mod coefficient;
mod desk;
mod explain;
mod inequality;
mod matrix;
mod number;
mod remainder;
mod row;
mod small;
mod special;

pub use cases::in_cases;
pub(crate) use desk::friction_bound;
use desk::{Desk, for_the_coefficient};

use crate::answer::Answer;
use crate::derive::Derivation;
use crate::domain::{self, Domains, Origin};
use crate::equality::{self, Equality};
use crate::expr::{Expr, Symbol};
use crate::formula::{self, Content, Relation, Sentence};
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
    /// Whether it holds where the scene goes this way, though the values for which it is printed lead another.
    #[serde(skip)]
    elsewhere: Option<Option<bool>>,
    /// What carom has in its place.
    pub carom: String,
    /// How it is known.
    pub because: String,
    /// What produced a wrong value, where that was found.
    pub explained: Option<String>,
    /// The cheap check that would have caught it.
    pub caught_by: Option<String>,
}

/// Most readings of one text that are tried beside the usual one.
const MOST_READINGS: usize = 4;

/// What is said where nothing explains a wrong thing.
const UNEXPLAINED: &str = "no slip of the pen that was tried leads to it";

/// What is said where some slip would lead to most numbers as short as the printed one.
const FEW_DIGITS: &str = "it has too few digits to tell a slip of the pen from chance";

/// Whether what is said of a wrong thing explains it.
pub fn explains(said: &str) -> bool {
    said != UNEXPLAINED && said != FEW_DIGITS
}

/// One way a scene goes, which what is printed is held against.
pub struct Way<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its derivation.
    pub derivation: &'a Derivation,
    /// All answers: they tell why there is no value, and where a value is largest.
    pub all: &'a [Answer],
    /// Thresholds of friction: the question, the coefficient it bounds, and how that stands to it.
    pub coefficients: &'a [(String, Symbol, Relation)],
    /// What friction does, and what must be ≥ 0 for it.
    pub case: Option<(&'a str, &'a [Expr])>,
    /// Whether the scene goes this way at its values.
    pub is_so: bool,
}

impl<'a> Way<'a> {
    /// A scene that goes one way.
    pub fn of(scene: &'a Scene, derivation: &'a Derivation, all: &'a [Answer]) -> Way<'a> {
        Way {
            scene,
            derivation,
            all,
            coefficients: &[],
            case: None,
            is_so: true,
        }
    }

    /// Where the scene goes this way.
    fn domains(&self) -> Domains {
        let mut domains = self.scene.domains.clone();
        let needs = self
            .case
            .into_iter()
            .flat_map(|(words, needs)| needs.iter().map(move |e| (words, e)));
        for (what, e) in needs {
            let words = for_the_coefficient(self.scene, &Sentence::not_negative(e)).to_string();
            let origin = Origin::Outcome(what.to_string());
            domains = domains.with_relation(domain::Relation::needed(e, true, words, origin));
        }
        domains
    }
}

/// Checks everything printed about a scene against one way it goes.
pub fn check(way: &Way) -> Vec<Finding> {
    let scene = way.scene;
    let desk = Desk::new(way);
    let findings = scene.printed.iter().map(|printed| desk.check(printed));
    let mut findings: Vec<Finding> = findings.collect();
    desk.consequences(&mut findings);
    for (finding, printed) in findings.iter_mut().zip(&scene.printed) {
        if let (Some(true), Print::Formula { item, .. }) = (finding.holds, &printed.what) {
            finding.given = conditions(way, item);
            finding.only_where = cases::in_words(&finding.given);
        }
    }
    for finding in findings.iter_mut().filter(|f| f.holds == Some(false)) {
        finding.explained.get_or_insert_with(|| UNEXPLAINED.into());
    }
    findings
}

/// What an answer rests on beyond what the scene states, in this way before any other.
fn conditions(way: &Way, item: &str) -> Vec<String> {
    let is_it = |a: &&Answer| a.name == item || a.question == item;
    let mut all = way.derivation.answers.iter().chain(way.all);
    let given = all.find(is_it).into_iter().flat_map(|a| &a.assumptions);
    let conditions = given.filter(|words| words.is_condition());
    let solved = conditions.map(|words| for_the_coefficient(way.scene, words).to_string());
    solved.collect()
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
        if finding.holds == Some(false) {
            self.read_otherwise(printed, &mut finding);
        }
        if let Some(excluded) = self.excluded(printed) {
            let because =
                format!("at these values the answer is another one; this one needs {excluded}");
            finding = Finding {
                elsewhere: Some(finding.holds),
                holds: None,
                carom: String::new(),
                because,
                explained: None,
                caught_by: None,
                ..finding
            };
        }
        finding
    }

    /// What does not hold as it is usually read, and holds in another reading, is open: no habit decides how far `√ab` reaches.
    fn read_otherwise(&self, printed: &Printed, finding: &mut Finding) {
        let text = match &printed.what {
            Print::Formula { text, .. } | Print::Equation { text, .. } => text,
            Print::Number { .. } | Print::Matrix { .. } => return,
        };
        let others = formula::other_readings(text, &self.symbols(printed), false);
        for other in others.iter().take(MOST_READINGS) {
            let shown = other.content.plain(&formula::write_plain);
            let mut found = Finding::default();
            let outcome = match &printed.what {
                Print::Formula { item, .. } => self.answer(printed, item, &shown, &mut found),
                _ => self.equation(printed, &shown, &mut found),
            };
            if outcome.is_ok() && found.holds == Some(true) {
                finding.holds = None;
                finding.because =
                    format!("as it is usually read it does not hold; read as {shown} it does");
                (finding.explained, finding.caught_by) = (None, None);
                return;
            }
        }
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
        self.is_of(&name, &reading.content)?;
        let bound = self.bound(&name, &reading.content);
        let said = self.said_of(&name, &reading.content);
        let is_said = bound.is_none() && said.is_some();
        let pairs: Vec<(Expr, Expr)> = match (
            &bound,
            self.vectors.get(&name),
            self.answered(&name),
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
        let mut is_whole = true;
        for (closed, value) in &pairs {
            let (order, whole) = small::order(value, &printed.small);
            is_whole &= whole;
            let closed = self.put_in_to(closed, printed, order)?;
            let is_special = !printed.at.is_empty() || !printed.small.is_empty();
            shown.push(match is_said || is_special {
                true => self.tidy(&closed),
                false => self.say(&closed),
            });
            all.push((closed, self.put_in_to(value, printed, order)?));
        }
        shown.truncate(if pairs.len() == 3 { 2 } else { 1 });
        finding.carom = if shown.len() == 1 {
            shown.remove(0)
        } else {
            format!("[{}]", shown.join(", "))
        };
        self.identities(&all, printed, finding);
        leave_open(is_whole, finding);
        let figure = self.figure(&all, text, printed);
        let figure = figure.filter(|_| finding.holds == Some(false));
        let is_number = figure.is_some_and(|figure| {
            let of = match bound.is_some() || is_said {
                true => all[0].0.clone(),
                false => Expr::symbol(&name),
            };
            let judged = self.rounded(printed, &figure, item, &of, finding);
            judged.is_ok()
        });
        if let (Some(false), false, [pair]) = (finding.holds, is_number, &all[..]) {
            self.coefficient(printed, &name, (text, pair), finding);
        }
        if let Some((sign, ..)) = bound {
            self.sense(&name, sign, finding);
        }
        if is_number {
            return Ok(());
        }
        if finding.holds == Some(false) && finding.explained.is_none() {
            self.caught(&all, printed, finding);
            finding.explained = self.explained(item, &all);
        }
        Ok(())
    }

    /// What led to a wrong formula for an item.
    fn explained(&self, item: &str, all: &[(Expr, Expr)]) -> Option<String> {
        self.before(item, all)
            .or_else(|| self.place(item, all))
            .or_else(|| self.factor(all))
            .or_else(|| self.exchanged(all))
            .or_else(|| self.sought(all))
            .or_else(|| self.slip(all))
            .or_else(|| self.slip_in_printed(all))
            .or_else(|| self.component(all))
            .or_else(|| self.short_factor(all))
    }

    /// Whether a formula gives the item something; one for another parameter, `m = …`, gives it nothing.
    fn is_of(&self, item: &Symbol, content: &Content) -> Result<(), String> {
        if content.answer().expr().and_then(Expr::as_symbol) == Some(item) {
            return Err(format!("{item} stands for itself, and no value is printed"));
        }
        let Content::Relations(sides, _) = content else {
            return Ok(());
        };
        let first = sides.first().and_then(|side| side.expr()?.as_symbol());
        let bounded = self.bounds.get(item).and_then(|(of, ..)| of.as_symbol());
        let is_other = |name: &Symbol| name != item && self.scene.parameter(name).is_some();
        match first.filter(|name| is_other(name) && bounded != Some(*name)) {
            Some(name) if self.said_of(item, content).is_none() => Err(format!(
                "{name} is a parameter of the scene, and no name of {item}"
            )),
            _ => Ok(()),
        }
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
        // A number may stand before what is said.
        let (left, right) = match (left.expr()?, right.expr()?) {
            (left, right) if left.is_constant() => (right, left),
            both => both,
        };
        let (name, truth) = match self.bounds.get(item) {
            Some((of, _, value)) => (of.as_symbol()?, value),
            None => (item, self.answered(item)?),
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
        let orders = sides.iter().flat_map(Content::exprs);
        let orders = orders.map(|e| small::order(e, &printed.small));
        let order = orders.clone().map(|(order, _)| order).max().unwrap_or(0);
        let is_whole = orders.clone().all(|(_, whole)| whole);
        for side in sides {
            let parts = self
                .components(side)
                .ok_or("a side of the equation is neither a number nor a vector")?;
            let parts = parts.iter().map(|e| {
                let e = self.by_answer(e);
                self.put_in_to(&e, printed, order)
            });
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
                    [x, y, z] if z == "0" => format!("[{x}, {y}]"),
                    [x, y, z] => format!("[{x}, {y}, {z}]"),
                    one => one.concat(),
                }
            });
            finding.carom = shown.collect::<Vec<_>>().join(" against ");
            self.identities(&pairs, printed, finding);
            leave_open(is_whole, finding);
            if finding.holds == Some(false) && !self.is_number(&pairs, text, printed, finding) {
                self.caught(&pairs, printed, finding);
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
        self.claimed(&values, signs, &self.domains_of(printed), finding);
        Ok(())
    }

    /// Whether an equation is one between a value and a number, and is judged by the digits of that.
    fn is_number(
        &self,
        pairs: &[(Expr, Expr)],
        text: &str,
        printed: &Printed,
        finding: &mut Finding,
    ) -> bool {
        let [(left, right)] = pairs else { return false };
        let (of, value, name) = match left.is_constant() {
            true => (right, left, text.rsplit('=').next()),
            false => (left, right, text.split('=').next()),
        };
        let name = name.unwrap_or(text).trim();
        let figure = self.figure(&[(of.clone(), value.clone())], text, printed);
        figure.is_some_and(|figure| self.rounded(printed, &figure, name, of, finding).is_ok())
    }

    fn identities(&self, pairs: &[(Expr, Expr)], printed: &Printed, finding: &mut Finding) {
        let mut holds = Some(true);
        finding.because = match printed.small.is_empty() {
            true => "identity".to_string(),
            false => format!(
                "identity to the order printed in small {}",
                printed.small.join(", ")
            ),
        };
        let mut within: Option<Domains> = None;
        for (closed, value) in pairs {
            let mut found = equality::decide(closed, value, &self.scene.domains).equality;
            // What shows that they differ must lie where the scene goes this way, and where the answers hold.
            if !found.is_same() {
                let within = within.get_or_insert_with(|| self.domains_of(printed));
                if *within != self.scene.domains {
                    found = equality::decide(closed, value, within).equality;
                }
            }
            match found {
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
                    // A way that the scene goes at equal values alone says nothing against one that goes on.
                    if within.as_ref().is_some_and(special::is_a_boundary) {
                        finding.elsewhere = Some(None);
                    }
                }
            }
        }
        finding.holds = holds;
    }
}

/// Says of what holds and is more than powers of what is small that no more than its beginning was looked at.
fn leave_open(is_whole: bool, finding: &mut Finding) {
    if !is_whole && finding.holds == Some(true) {
        let begins = finding
            .because
            .replace("the order printed", "leading order");
        finding.because = format!("{begins}; what is printed beyond it is not checked");
    }
}
