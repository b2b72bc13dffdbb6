//! Questions about formulas of answers: values, thresholds, largest values, limits, forms for a small parameter, identities.
//!
//! In: a question and what earlier answers stand for, in parameters. Out: answers with how each is known. A scene of one
//! impact and a scene with stages come here alike; what happened in stages is not known here.

use std::collections::BTreeSet;

use super::calc::{essential, is_zero, tidy};
use super::{Answer, Check, Form, Known, Refused, inequality, limit, optimum, threshold, zeros};
use crate::dimension::{self, Dimension};
use crate::domain::Domains;
use crate::equality::{self, Equality, How};
use crate::expr::{Expr, Node, Symbol};
use crate::formula::{Relation, write_plain};
use crate::formula::{Sentence, sentence};
use crate::scene::{Ask, Question, Scene};

/// Answers questions about formulas alone, in their order; `known` holds the answers found before. A question about a stage is
/// refused.
pub fn about<'a>(
    scene: &Scene,
    questions: impl Iterator<Item = &'a Question>,
    known: &Known,
) -> Result<Vec<Answer>, Refused> {
    let mut known = known.clone();
    let mut answers = Vec::new();
    for question in questions {
        let Some(new) = formulas(scene, question, &known)? else {
            return Err(Refused::question(
                &question.name,
                String::from("it asks about a stage, and there are none"),
                String::from("add \"stages\", or ask about a formula"),
            ));
        };
        remember(scene, &new, &mut known);
        answers.extend(new);
    }
    Ok(answers)
}

/// Later formulas may use the answers by name; what is known of a name already stays, and the name of a parameter stands for
/// the parameter.
pub(super) fn remember(scene: &Scene, answers: &[Answer], known: &mut Known) {
    let is_given = |a: &Answer| scene.parameters.iter().any(|p| *p.name == *a.name);
    for answer in answers.iter().filter(|a| !is_given(a)) {
        if let Some(formula) = answer.formula() {
            let name = Symbol::from(answer.name.as_str());
            known.entry(name).or_insert_with(|| formula.clone());
        }
    }
}

/// Longest formula that is worked on, in nodes.
pub const LONGEST: usize = 20_000;

/// Answers a question about formulas; `None` for a question of another kind.
pub fn formulas(
    scene: &Scene,
    question: &Question,
    known: &Known,
) -> Result<Option<Vec<Answer>>, Refused> {
    let of = match &question.ask {
        Ask::Value { formula, .. } => formula,
        Ask::Limit { of, .. } | Ask::Approximate { of, .. } => of,
        Ask::Condition { .. } | Ask::Maximum { .. } | Ask::Show { .. } => {
            return one(scene, question, question.name.clone(), None, known).map(Some);
        }
        _ => return Ok(None),
    };
    // The name of a vector alone asks for both components.
    let parts = of.as_symbol().and_then(|s| components(s, known));
    let Some(parts) = parts else {
        return one(scene, question, question.name.clone(), None, known).map(Some);
    };
    let mut out = Vec::new();
    for (part, axis) in parts.iter().zip(["x", "y"]) {
        let name = format!("{}_{axis}", question.name);
        let of = Expr::symbol(part);
        out.extend(one(scene, question, name, Some(&of), known)?);
    }
    Ok(Some(out))
}

/// The two components of an answer that is a vector.
fn components(name: &Symbol, known: &Known) -> Option<[Symbol; 2]> {
    if known.contains_key(name) {
        return None;
    }
    let parts = ["x", "y"].map(|axis| Symbol::from(format!("{name}_{axis}").as_str()));
    parts.iter().all(|p| known.contains_key(p)).then_some(parts)
}

/// A formula in parameters alone.
pub(super) fn put(
    scene: &Scene,
    name: &str,
    known: &Known,
    e: &Expr,
    with: &[(Symbol, Expr)],
) -> Result<Expr, Refused> {
    let refused = |reason: String, hint: &str| Refused::question(name, reason, hint);
    let open = e
        .symbols()
        .into_iter()
        .find(|s| !known.contains_key(s) && s.as_ref() != "pi" && !is_parameter(scene, s));
    if let Some(open) = open {
        return Err(match components(&open, known) {
            Some([x, y]) => refused(
                format!("`{open}` is a vector"),
                &format!("its components are {x} and {y}"),
            ),
            None => refused(
                format!("`{open}` has no single value that could be substituted"),
                "name an earlier answer that is a formula",
            ),
        });
    }
    let with: Known = with
        .iter()
        .map(|(s, v)| (s.clone(), v.substitute(known)))
        .collect();
    let e = e.substitute(known).substitute(&with);
    if e.size() > LONGEST {
        return Err(Refused::uncalculated(name, "too long"));
    }
    tidy(&e, &scene.domains).map_err(|stop| Refused::uncalculated(name, stop))
}

fn is_parameter(scene: &Scene, name: &Symbol) -> bool {
    scene.parameters.iter().any(|p| p.name == *name)
}

/// A question about formulas on its way to an answer.
struct Work<'a> {
    scene: &'a Scene,
    question: &'a Question,
    /// Name of the answer.
    name: &'a str,
    /// What earlier answers stand for.
    known: &'a Known,
}

/// One answer, of `of` in place of what the question names where a component is asked; a maximum also tells its place.
fn one(
    scene: &Scene,
    question: &Question,
    name: String,
    of: Option<&Expr>,
    known: &Known,
) -> Result<Vec<Answer>, Refused> {
    let work = Work {
        scene,
        question,
        name: &name,
        known,
    };
    let out = match &question.ask {
        Ask::Value {
            formula,
            with,
            meaning,
        } => work.value(of.unwrap_or(formula), with, meaning)?,
        Ask::Condition {
            parameter,
            left,
            relation,
            right,
            with,
        } => {
            let sides = [work.put(left, with)?, work.put(right, with)?];
            let statement = statement(left, *relation, right);
            same_kind(
                scene,
                &name,
                &statement,
                [left, right],
                [&sides[0], &sides[1]],
            )?;
            condition(
                scene, question, &statement, parameter, *relation, sides, with,
            )?
        }
        Ask::Maximum { of, over } => return work.maximum(of, over),
        Ask::Limit {
            of: whole,
            parameter,
            to,
        } => work.limit(of.unwrap_or(whole), parameter, to.as_ref())?,
        Ask::Approximate {
            of: whole,
            parameter,
            to,
            order,
        } => work.approximate(of.unwrap_or(whole), parameter, to, *order)?,
        Ask::Show {
            left,
            relation,
            right,
            with,
            unless,
            claim,
        } => work.show((left, *relation, right), with, unless, claim)?,
        _ => return Ok(Vec::new()),
    };
    Ok(vec![out])
}

impl Work<'_> {
    /// A formula in parameters alone, with some of them at given values.
    fn put(&self, e: &Expr, with: &[(Symbol, Expr)]) -> Result<Expr, Refused> {
        put(self.scene, self.name, self.known, e, with)
    }

    /// What is asked as it stands, with the results in it, and equal factors gathered.
    fn raw(&self, asked: &Expr, with: &[(Symbol, Expr)]) -> Expr {
        let with: Known = with.iter().cloned().collect();
        gathered(&asked.substitute(self.known).substitute(&with))
    }

    fn blank(&self, words: impl Into<String>) -> Answer {
        Answer::blank(self.question, self.name, words)
    }

    fn value(
        &self,
        formula: &Expr,
        with: &[(Symbol, Expr)],
        meaning: &str,
    ) -> Result<Answer, Refused> {
        let (scene, known, name) = (self.scene, self.known, self.name);
        let mut out = self.blank(match meaning {
            "" => format!("value of {}", write_plain(formula)),
            meaning => meaning.to_string(),
        });
        let value = self.put(formula, with)?;
        put_in_fits(scene, known, with, name)?;
        out.dimension = match stated_dimension(scene, known, formula, name)? {
            Some(stated) => stated,
            None if with.is_empty() => dimension_of(scene, &value, name)?,
            None => Dimension::none(),
        };
        let raw = self.raw(formula, with);
        out.checks.push(Check::new(
            "identity",
            "with the results substituted, the difference is zero in the normal form",
            is_zero(&(&raw.substitute(known) - &value), &scene.domains),
        ));
        out.put_in
            .push((raw, value.clone(), "with the results substituted"));
        out.form = Form::value(value);
        out.text.extend(with_words(with));
        Ok(out)
    }

    fn maximum(&self, of: &Expr, over: &[Symbol]) -> Result<Vec<Answer>, Refused> {
        let value = self.put(of, &[])?;
        let mut open = self.blank(format!("largest value of {}", write_plain(of)));
        let found = optimum::maximum(self.scene, open.clone(), &value, over);
        Ok(found.unwrap_or_else(|why| {
            // Not found is an answer too, and leaves the others alone.
            let why = match why.hint.as_str() {
                "" => why.reason,
                hint => format!("{}; {hint}", why.reason),
            };
            open.text.push(sentence!["not found: ", why]);
            open.checks.push(Check::new("maximum", "not found", None));
            vec![open]
        }))
    }

    fn limit(&self, of: &Expr, parameter: &Symbol, to: Option<&Expr>) -> Result<Answer, Refused> {
        let target = to.map_or_else(|| String::from("∞"), write_plain);
        let words = format!("limit of {} as {parameter} → {target}", write_plain(of));
        let mut out = self.blank(words);
        let value = self.put(of, &[])?;
        let to = to.map(|t| self.put(t, &[])).transpose()?;
        let domains = &self.scene.domains;
        limit::fill(&mut out, &value, parameter, to.as_ref(), domains);
        if let Some(formula) = out.formula() {
            out.dimension = dimension_of(self.scene, formula, self.name)?;
        }
        Ok(out)
    }

    fn approximate(
        &self,
        of: &Expr,
        parameter: &Symbol,
        to: &Expr,
        order: Option<u32>,
    ) -> Result<Answer, Refused> {
        let near = if to.is_zero() {
            format!("small {parameter}")
        } else {
            format!("{parameter} near {}", write_plain(to))
        };
        let words = match order {
            Some(order) => format!("{} for {near}, to order {order}", write_plain(of)),
            None => format!("leading term of {} for {near}", write_plain(of)),
        };
        let mut out = self.blank(words);
        let value = self.put(of, &[])?;
        out.dimension = dimension_of(self.scene, &value, self.name)?;
        let to = self.put(to, &[])?;
        let domains = &self.scene.domains;
        limit::approximate(&mut out, &value, parameter, &to, order, domains);
        Ok(out)
    }

    fn show(
        &self,
        asked: (&Expr, Relation, &Expr),
        with: &[(Symbol, Expr)],
        unless: &[Symbol],
        claim: &str,
    ) -> Result<Answer, Refused> {
        let sides = [self.put(asked.0, with)?, self.put(asked.2, with)?];
        let values = sides.clone();
        let mut out = show(self.scene, self.question, asked, claim, sides)?;
        for (asked, value) in [asked.0, asked.2].into_iter().zip(values) {
            let raw = self.raw(asked, with);
            out.put_in
                .push((raw, value, "with the results substituted"));
        }
        out.text.extend(with_words(with));
        for name in unless {
            let parts = components(name, self.known).map_or_else(|| vec![name.clone()], Vec::from);
            let mut square = Expr::zero();
            for part in parts {
                square = &square + &self.put(&Expr::symbol(&part), with)?.powi(2);
            }
            out.text.push(vanishing(name, &square, &self.scene.domains));
        }
        Ok(out)
    }
}

/// The same with equal factors gathered into powers, and nothing else changed.
fn gathered(e: &Expr) -> Expr {
    let e = e.map_parts(gathered);
    let Node::Product(factors) = e.node() else {
        return e;
    };
    let mut bases: Vec<(Expr, Expr)> = Vec::new();
    for factor in factors {
        let (base, exponent) = match factor.node() {
            Node::Power(base, k) if k.as_number().is_some_and(|k| k.is_integer()) => {
                (base.clone(), k.clone())
            }
            _ => (factor.clone(), Expr::one()),
        };
        match bases.iter_mut().find(|(b, _)| *b == base) {
            Some((_, k)) => *k = &*k + &exponent,
            None => bases.push((base, exponent)),
        }
    }
    if bases.iter().any(|(base, _)| base.is_zero()) {
        return Expr::zero();
    }
    // What stands above and below the line is not zero.
    bases.retain(|(_, k)| !k.is_zero());
    Expr::product(bases.into_iter().map(|(base, k)| base.power(k)))
}

fn statement(left: &Expr, relation: Relation, right: &Expr) -> String {
    format!(
        "{} {} {}",
        write_plain(left),
        relation.sign(),
        write_plain(right)
    )
}

fn condition(
    scene: &Scene,
    question: &Question,
    statement: &str,
    parameter: &Symbol,
    relation: Relation,
    [left, right]: [Expr; 2],
    with: &[(Symbol, Expr)],
) -> Result<Answer, Refused> {
    let name = question.name.as_str();
    let what = if relation == Relation::Equal {
        "value"
    } else {
        "threshold"
    };
    let mut out = Answer::blank(
        question,
        name,
        format!("{what} of {parameter} for {statement}"),
    );
    out.text.extend(with_words(with));
    out.stated = Some((left.clone(), relation, right.clone()));
    threshold::fill(&mut out, parameter, &left, relation, &right, scene);
    if let Some(root) = out.formula() {
        // What stands in the equation and not in its solution plays no part, which is worth saying.
        let used = root.symbols();
        let all: BTreeSet<Symbol> = left.symbols().union(&right.symbols()).cloned().collect();
        let idle: Vec<Sentence> = all
            .iter()
            .filter(|s| *s != parameter && s.as_ref() != "pi" && !used.contains(*s))
            .map(Sentence::from)
            .collect();
        if let [first @ .., last] = idle.as_slice() {
            let lead = Sentence::join(first.iter().cloned(), ", ");
            let or = if first.is_empty() { "" } else { " or " };
            out.text
                .push(sentence!["it does not depend on ", lead, or, last]);
        }
    }
    out.dimension = dimension_of(scene, &Expr::symbol(parameter), name)?;
    Ok(out)
}

/// Refuses to compare quantities of different kinds. A plain number counts in SI units, and what came out of plain numbers is of
/// the kind that was asked for.
fn same_kind(
    scene: &Scene,
    name: &str,
    statement: &str,
    stated: [&Expr; 2],
    put: [&Expr; 2],
) -> Result<(), Refused> {
    if stated.iter().any(|side| side.is_constant()) || put.iter().any(|side| side.is_zero()) {
        return Ok(());
    }
    let kinds = stated.map(|side| dimension::of(side, &|name| kind_of(scene, name)));
    if let [Ok(Some(l)), Ok(Some(r))] = &kinds
        && l == r
    {
        return Ok(());
    }
    let [l, r] = put.map(|side| dimension_of(scene, side, name));
    let (l, r) = (l?, r?);
    if l == r {
        return Ok(());
    }
    Err(Refused::question(
        name,
        format!("the sides of {statement} are {l} and {r}"),
        String::from("compare quantities of the same kind"),
    ))
}

fn show(
    scene: &Scene,
    question: &Question,
    shown: (&Expr, Relation, &Expr),
    claim: &str,
    [left, right]: [Expr; 2],
) -> Result<Answer, Refused> {
    let name = question.name.as_str();
    let (_, relation, _) = shown;
    let equation = statement(shown.0, relation, shown.2);
    same_kind(scene, name, &equation, [shown.0, shown.2], [&left, &right])?;
    let words = match claim {
        "" => equation,
        claim => claim.to_string(),
    };
    let mut out = Answer::blank(question, name, format!("to be shown: {words}"));
    out.dimension = dimension_of(scene, &left, name)?;
    if relation != Relation::Equal {
        let gap = tidy(&(&left - &right), &scene.domains);
        let gap = gap.map_err(|stop| Refused::uncalculated(name, stop))?;
        let (text, check) = inequality::shown(&gap, relation, &scene.domains);
        out.text.push(text);
        out.checks.push(check);
        return Ok(out);
    }
    out.checks.push(identity(&left, &right, &scene.domains));
    let equation = sentence![shown.0, " = ", shown.2];
    out.text.push(match out.checks[0].holds {
        Some(true) => sentence![equation, ": both are ", &left],
        Some(false) => sentence![equation, " does not hold: ", &left, " against ", &right],
        None => sentence![equation, " could not be decided"],
    });
    out.form = Form::Equation { left, right };
    Ok(out)
}

/// Where a quantity vanishes whose square this is.
fn vanishing(name: &Symbol, square: &Expr, domains: &Domains) -> Sentence {
    if is_zero(square, domains) == Some(true) {
        return sentence![name, " is zero throughout: the statement is empty"];
    }
    let places = zeros::of(&essential(square, domains), domains);
    if places.is_empty() {
        return sentence![name, " is nowhere zero"];
    }
    let places = Sentence::join(places, " or ");
    sentence![
        "the exception is ",
        places,
        ": there ",
        name,
        " is zero and the statement is empty"
    ]
}

/// An identity, decided.
pub(super) fn identity(left: &Expr, right: &Expr, domains: &Domains) -> Check {
    let decision = equality::decide(left, right, domains).equality;
    let (words, holds) = match decision {
        Equality::Same {
            how: How::Identity { .. },
        } => (
            String::from("identity: the difference is zero in the normal form"),
            Some(true),
        ),
        Equality::Same {
            how: How::OnBranch { elsewhere, .. },
        } => (
            format!(
                "holds on a part of the domain only, not at {}",
                elsewhere.at.words()
            ),
            Some(false),
        ),
        Equality::Different(point) => (format!("different at {}", point.at.words()), Some(false)),
        _ => (String::from("not decided"), None),
    };
    Check::new("identity", words, holds)
}

fn with_words(with: &[(Symbol, Expr)]) -> Vec<Sentence> {
    with.iter()
        .map(|(s, v)| sentence!["taken at ", s, " = ", v])
        .collect()
}

/// Dimension of a formula of parameters and earlier answers, as it is stated: what is put in for a parameter may be a plain
/// number in its unit.
fn stated_dimension(
    scene: &Scene,
    known: &Known,
    e: &Expr,
    at: &str,
) -> Result<Option<Dimension>, Refused> {
    let parameter = |name: &str| dimension_of_parameter(scene, name);
    let of_answer = |answer: &Expr| dimension::of(answer, &parameter).ok().flatten();
    let of = |name: &str| match known.get(name) {
        Some(answer) => of_answer(answer),
        None => parameter(name),
    };
    let asked = |name: &str| match known.contains_key(name) {
        true => kind_of(scene, name).or_else(|| of(name)),
        false => of(name),
    };
    let is_plain = |s: &Symbol| known.get(s).is_some_and(Expr::is_constant);
    if e.symbols().iter().any(is_plain)
        && !has_number(e)
        && let Ok(by_kind) = dimension::of(e, &asked)
    {
        return Ok(by_kind);
    }
    // Of an answer that is 0 nothing can be told: it stands for itself.
    let plain = known.iter().filter(|(_, v)| of_answer(v).is_none());
    let plain: Known = plain.map(|(s, v)| (s.clone(), v.clone())).collect();
    dimension::of(&e.substitute(&plain), &of).or_else(|clash| {
        let by_kind = dimension::of(e, &asked);
        by_kind.map_err(|_| clashes(at, clash.message(&write_plain)))
    })
}

fn dimension_of_parameter(scene: &Scene, name: &str) -> Option<Dimension> {
    let found = scene.parameters.iter().find(|p| *p.name == *name);
    found.map(|p| p.dimension.clone())
}

/// The dimension of a parameter, or of what a question asks for: a velocity that came out of plain numbers in their units is a
/// velocity all the same.
fn kind_of(scene: &Scene, name: &str) -> Option<Dimension> {
    let mut questions = scene.questions.iter();
    let found = questions.find(|q| {
        let part = name.strip_prefix(&*q.name);
        part.is_some_and(|part| matches!(part, "" | "_x" | "_y"))
    });
    match found.map(|q| q.ask.dimension()) {
        Some(known) if known != Dimension::none() => Some(known),
        _ => dimension_of_parameter(scene, name),
    }
}

/// Whether a number stands beside the symbols, other than an exponent: it may be a quantity in its unit.
fn has_number(e: &Expr) -> bool {
    match e.node() {
        Node::Number(_) => true,
        Node::Symbol(_) => false,
        Node::Sum(parts) | Node::Product(parts) => parts.iter().any(has_number),
        Node::Power(base, _) => has_number(base),
        Node::Call(_, argument) => has_number(argument),
    }
}

/// What is put in for a parameter has its dimension, or is a number.
fn put_in_fits(
    scene: &Scene,
    known: &Known,
    with: &[(Symbol, Expr)],
    at: &str,
) -> Result<(), Refused> {
    for (name, value) in with.iter().filter(|(_, v)| !v.is_constant()) {
        let own = stated_dimension(scene, known, &Expr::symbol(name), at)?;
        let put = stated_dimension(scene, known, value, at)?;
        if let (Some(own), Some(put)) = (own, put)
            && own != put
        {
            let reason = format!("{name} is {own}, and what is put in for it {put}");
            return Err(clashes(at, reason));
        }
    }
    Ok(())
}

fn clashes(at: &str, reason: String) -> Refused {
    Refused::question(
        at,
        reason,
        String::from("both sides of a sum or relation have the same dimension"),
    )
}

/// Dimension of an expression in the scene's parameters.
pub(super) fn dimension_of(scene: &Scene, e: &Expr, at: &str) -> Result<Dimension, Refused> {
    match dimension::of(e, &|name| dimension_of_parameter(scene, name)) {
        Ok(found) => Ok(found.unwrap_or_else(Dimension::none)),
        Err(clash) => Err(clashes(at, clash.message(&write_plain))),
    }
}
