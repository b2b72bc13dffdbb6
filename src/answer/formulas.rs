//! Questions about formulas of answers: values, thresholds, largest values, limits, forms for a small parameter, identities.
//!
//! In: a question and what earlier answers stand for, in parameters. Out: answers with how each is known. A scene of one
//! impact and a scene with stages come here alike; what happened in stages is not known here.

use std::collections::BTreeSet;

use super::calc::{Seen, beyond_zero, essential, is_zero, keeps_to, sign, tidy};
use super::dimensions::kind_of;
use super::powers::not_zero;
use super::{
    Answer, Check, Form, Known, Refused, Work, inequality, limit, optimum, solve, threshold, zeros,
};
use crate::algebra::{Sign, Stop};
use crate::dimension::{self, Dimension};
use crate::domain::{self, Domains};
use crate::equality::{self, Equality, How};
use crate::expr::{Expr, Function, Node, Symbol, effort};
use crate::formula::{Relation, write_plain};
use crate::formula::{Sentence, sentence};
use crate::scene::{Ask, Extremum, Question, Scene};

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
            let why = "it asks about a stage, and there are none";
            let hint = "add \"stages\", or ask about a formula";
            return Err(Refused::question(&question.name, why, hint));
        };
        remember(scene, &new, &mut known);
        answers.extend(new);
    }
    Ok(answers)
}

/// Later formulas may use the answers by name; what is known of a name already stays, and the name of a parameter stands for
/// the parameter.
pub fn remember(scene: &Scene, answers: &[Answer], known: &mut Known) {
    let is_given = |a: &Answer| scene.parameter(&a.name).is_some();
    for answer in answers.iter().filter(|a| !is_given(a)) {
        if let Some(formula) = answer.formula() {
            let name = Symbol::from(answer.name.as_str());
            known.entry(name).or_insert_with(|| formula.clone());
        }
    }
}

/// Why what is asked is the same as its value.
const SUBSTITUTED: &str = "with the results substituted";

/// Longest formula that is worked on, in nodes.
pub const LONGEST: usize = 20_000;

/// Answers a question about formulas; `None` for a question of another kind.
pub fn formulas(
    scene: &Scene,
    question: &Question,
    known: &Known,
) -> Result<Option<Vec<Answer>>, Refused> {
    let of = match &question.ask {
        Ask::Value { formula, .. } => Some(formula),
        Ask::Limit { of, .. } | Ask::Approximate { of, .. } => Some(of),
        Ask::Condition { .. } | Ask::Extremum { .. } | Ask::Show { .. } => None,
        Ask::Friction { .. } => return Ok(Some(vec![no_coefficient(question)])),
        _ => return Ok(None),
    };
    let (domains, given) = match with_put_in(scene, question, known) {
        Ok(there) => there,
        Err(why) => {
            let open = Answer::blank(question, &question.name, "what is asked").leave_open(why);
            return Ok(Some(vec![open]));
        }
    };
    let scene = &Scene {
        domains,
        ..scene.clone()
    };
    let work = |name: &str, of: Option<&Expr>| {
        let work = Work {
            scene,
            question,
            name,
            known,
        };
        let mut answers = work.answers(of)?;
        for answer in &mut answers {
            answer.assumptions.extend(given.iter().cloned());
        }
        Ok(answers)
    };
    // The name of a vector alone asks for both components.
    let parts = of.and_then(|of| components(of.as_symbol()?, known));
    let Some([x, y]) = parts else {
        return work(&question.name, None).map(Some);
    };
    let name = &question.name;
    let mut out = work(&format!("{name}_x"), Some(&Expr::symbol(&x)))?;
    out.extend(work(&format!("{name}_y"), Some(&Expr::symbol(&y)))?);
    Ok(Some(out))
}

/// The answer to a question for a coefficient of friction that there is not on the whole domain.
pub fn no_coefficient(question: &Question) -> Answer {
    let words = "coefficient of friction at which the contact does something else";
    Answer::blank(question, &question.name, words).leave_open(
        "no one value separates it on the whole domain; with values, or on a narrower domain, there may be one",
    )
}

/// The domain where a question puts in values for parameters, ends of their intervals included, and what these ask for; `Err`
/// where they lie outside.
fn with_put_in(
    scene: &Scene,
    question: &Question,
    known: &Known,
) -> Result<(Domains, Vec<Sentence>), Sentence> {
    let mut domains = scene.domains.clone();
    let with = question.ask.with().iter();
    let with: Known = with
        .map(|(s, v)| (s.clone(), v.substitute(known)))
        .collect();
    let mut given = Vec::new();
    for (name, value) in &with {
        let mut own = scene.domains.of_symbol(name);
        let ends = [&mut own.low, &mut own.high].into_iter().flatten();
        ends.for_each(|end| end.open = false);
        let needs = solve::placed(name, value, &own, &scene.domains)?.into_iter();
        given.extend(needs.map(|(need, _)| {
            let least = Sentence::not_negative(&need);
            sentence!("{}, so that {} lies within its domain", least, name)
        }));
    }
    let is_put = |r: &domain::Relation| with.keys().any(|name| r.excess.mentions(name));
    let (put, kept) = std::mem::take(&mut domains.relations)
        .into_iter()
        .partition(is_put);
    domains.relations = kept;
    for relation in Vec::into_iter(put) {
        let excess = relation.excess.substitute(&with);
        let stated = solve::stated(&relation);
        match keeps_to(&excess, relation.closed, &domains) {
            Some(true) => {}
            Some(false) => {
                let put = with
                    .iter()
                    .map(|(name, value)| sentence!("{} = {}", name, value));
                let put = Sentence::join(put, " and ");
                return Err(match relation.origin.so_that() {
                    None => sentence!("{}, against {}", put, stated),
                    Some(needed) => sentence!(
                        "with {} the scene does not get there: {} is needed so that {}",
                        put,
                        stated,
                        needed
                    ),
                });
            }
            None => {
                let least = beyond_zero(&excess, &domains, !relation.closed);
                let words = least.to_string();
                let so_that = relation.origin.so_that().map(Sentence::words);
                // Each value that is sought is held against what it has to keep to.
                let is_held = match &question.ask {
                    Ask::Condition {
                        parameter,
                        relation: Relation::Equal,
                        ..
                    } => so_that.is_some() && excess.mentions(parameter),
                    _ => false,
                };
                if !is_held {
                    let so_that = so_that.unwrap_or(stated);
                    given.push(sentence!("{}, so that {}", least, so_that));
                }
                let (closed, origin) = (relation.closed, relation.origin);
                let needed = domain::Relation::needed(&excess, closed, words, origin);
                domains = domains.with_relation(needed);
            }
        }
    }
    Ok((domains, given))
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
    let is_parameter = |s: &Symbol| scene.parameter(s).is_some();
    let is_open = |s: &Symbol| !known.contains_key(s) && s.as_ref() != "pi" && !is_parameter(s);
    let put_in = with.iter().map(|(_, value)| value);
    let mut used = std::iter::once(e).chain(put_in).flat_map(Expr::symbols);
    if let Some(open) = used.find(is_open) {
        let (reason, hint) = match components(&open, known) {
            Some([x, y]) => ("is a vector", format!("its components are {x} and {y}")),
            None => (
                "has no single value that could be substituted",
                String::from("name an earlier answer that is a formula"),
            ),
        };
        return Err(Refused::question(name, format!("`{open}` {reason}"), hint));
    }
    let with = with.iter().map(|(s, v)| (s.clone(), v.substitute(known)));
    let e = e.substitute(known).substitute(&with.collect());
    if e.size() > LONGEST {
        return Err(Refused::uncalculated(name, "too long"));
    }
    let tidied =
        |e: &Expr| tidy(e, &scene.domains).map_err(|stop| Refused::uncalculated(name, stop));
    // An angle, or a multiple of one, stays the arc as which it is asked: acos(1 − x) is no π/2 + asin(x − 1).
    let (fixed, rest): (Vec<Expr>, Vec<Expr>) =
        e.factors().iter().cloned().partition(Expr::is_constant);
    let arc = match rest.as_slice() {
        [arc] => arc,
        _ => return tidied(&e),
    };
    let Node::Call(function @ (Function::Acos | Function::Asin | Function::Atan), x) = arc.node()
    else {
        return tidied(&e);
    };
    let own = Expr::product(fixed) * Expr::call(*function, tidied(x)?);
    let other = tidied(&own)?;
    Ok(if other.size() < own.size() {
        other
    } else {
        own
    })
}

/// An equation or inequality, as it is asked.
type Stated<'e> = (&'e Expr, Relation, &'e Expr);

impl Work<'_> {
    /// The answers, of `of` in place of what the question names where a component is asked; a maximum also tells its place.
    fn answers(&self, of: Option<&Expr>) -> Result<Vec<Answer>, Refused> {
        let asked = &self.question.ask;
        let is_search = matches!(asked, Ask::Condition { .. } | Ask::Extremum { .. });
        if is_search && effort::spent() {
            let mut out = self.blank("");
            let why = "not looked for: the work of the scene is used up";
            out.text.push(Sentence::words(why));
            return Ok(vec![out]);
        }
        let one = match asked {
            Ask::Value {
                formula,
                with,
                meaning,
                dimension,
                polar,
            } => match polar {
                Some(parts) => self.direction(formula, parts, meaning),
                None => {
                    let told = (meaning.as_str(), dimension.as_ref());
                    self.value(of.unwrap_or(formula), with, told)
                }
            },
            Ask::Condition {
                parameter,
                left,
                relation,
                right,
                with,
            } => self.condition(parameter, (left, *relation, right), with),
            Ask::Extremum { which, of, over } => return self.extremum(*which, of, over),
            Ask::Limit {
                of: whole,
                parameter,
                to,
            } => self.limit(of.unwrap_or(whole), parameter, to.as_ref()),
            Ask::Approximate {
                of: whole,
                parameter,
                to,
                order,
            } => self.approximate(of.unwrap_or(whole), parameter, to, *order),
            Ask::Show {
                left,
                relation,
                right,
                with,
                unless,
                claim,
            } => self.show((left, *relation, right), with, unless, claim),
            _ => return Ok(Vec::new()),
        };
        Ok(vec![one?])
    }

    /// A formula in parameters alone, with some of them at given values.
    pub(super) fn put(&self, e: &Expr, with: &[(Symbol, Expr)]) -> Result<Expr, Refused> {
        put(self.scene, self.name, self.known, e, with)
    }

    /// Whether what is asked has no value anywhere, such as the instantaneous center of what does not turn.
    fn divides_by_zero(&self, asked: &Expr, with: &[(Symbol, Expr)]) -> bool {
        let with: Known = with.iter().cloned().collect();
        let whole = asked.substitute(self.known).substitute(&with);
        matches!(tidy(&whole, &self.scene.domains), Err(Stop::DivisionByZero))
    }

    /// What is asked as it stands, with the results in it, and equal factors gathered.
    fn raw(&self, asked: &Expr, with: &[(Symbol, Expr)]) -> Expr {
        let with: Known = with.iter().cloned().collect();
        gathered(&asked.substitute(self.known).substitute(&with))
    }

    pub(super) fn blank(&self, words: impl Into<String>) -> Answer {
        Answer::blank(self.question, self.name, words)
    }

    fn value(
        &self,
        formula: &Expr,
        with: &[(Symbol, Expr)],
        (meaning, dimension): (&str, Option<&Dimension>),
    ) -> Result<Answer, Refused> {
        let mut out = self.blank(match meaning {
            "" => format!("value of {}", write_plain(formula)),
            meaning => meaning.to_string(),
        });
        let value = match self.put(formula, with) {
            Err(_) if self.divides_by_zero(formula, with) => {
                let why = "no value: it is divided by zero, whatever the parameters";
                out.text.push(Sentence::words(why));
                return Ok(out);
            }
            value => value?,
        };
        self.put_in_fits(with)?;
        out.dimension = match (dimension, self.stated_dimension(formula)?) {
            (Some(told), _) => told.clone(),
            (None, Some(stated)) => stated,
            (None, None) if with.is_empty() => self.dimension_of_value(formula, &value)?,
            (None, None) => Dimension::none(),
        };
        out.assumptions
            .extend(divided_by(&value, &self.scene.domains, true));
        let raw = self.raw(formula, with);
        let substituted = raw.substitute(self.known);
        out.checks.push(self.same(&substituted, &value));
        out.put_in.push((raw, value.clone(), SUBSTITUTED));
        out.form = Form::value(value);
        out.text.extend(with_words(with));
        Ok(out)
    }

    /// That a result is the formula with the other results in it.
    fn same(&self, substituted: &Expr, value: &Expr) -> Check {
        let domains = &self.scene.domains;
        let words = "with the results substituted, the difference is identically zero";
        let holds = is_zero(&(substituted - value), domains);
        if holds.is_some() {
            return Check::new("identity", words, holds);
        }
        // What stands under a root is not negative where both have a value.
        let decided = equality::decide(substituted, value, domains).equality;
        let holds = (decided.is_identity().then_some(true))
            .or_else(|| decided.is_different().then_some(false));
        let words = "with the results substituted, both are equal wherever they have a value";
        Check::new("identity", words, holds)
    }

    fn extremum(
        &self,
        which: Extremum,
        of: &Expr,
        over: &[Symbol],
    ) -> Result<Vec<Answer>, Refused> {
        let value = self.put(of, &[])?;
        let mut open = self.blank(format!("{} value of {}", which.word(), write_plain(of)));
        open.dimension = self.dimension_of_value(of, &value)?;
        let found = optimum::extremum(self.scene, open.clone(), which, (&value, over));
        Ok(found.unwrap_or_else(|why| {
            // Not found is an answer too, and leaves the others alone.
            let why = match why.hint.as_str() {
                "" => why.reason,
                hint => format!("{}; {hint}", why.reason),
            };
            open.text.push(sentence!("not found: {}", why));
            open.checks
                .push(Check::new(which.kind(), super::NOT_FOUND, None));
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
        // A limit of 0 has no dimension of its own.
        out.dimension = self.dimension_of_value(of, &value)?;
        Ok(out)
    }

    fn approximate(
        &self,
        of: &Expr,
        parameter: &Symbol,
        to: &Expr,
        order: Option<u32>,
    ) -> Result<Answer, Refused> {
        let near = match to.is_zero() {
            true => format!("small {parameter}"),
            false => format!("{parameter} near {}", write_plain(to)),
        };
        let words = match order {
            Some(order) => format!("{} for {near}, to order {order}", write_plain(of)),
            None => format!("leading term of {} for {near}", write_plain(of)),
        };
        let mut out = self.blank(words);
        let value = self.put(of, &[])?;
        out.dimension = self.dimension_of_value(of, &value)?;
        let to = self.put(to, &[])?;
        let domains = &self.scene.domains;
        limit::approximate(&mut out, &value, parameter, &to, order, domains);
        Ok(out)
    }

    fn show(
        &self,
        asked: Stated,
        with: &[(Symbol, Expr)],
        unless: &[Symbol],
        claim: &str,
    ) -> Result<Answer, Refused> {
        let domains = &self.scene.domains;
        let [left, right] = self.sides(asked, with)?;
        let words = match claim {
            "" => statement(asked),
            claim => claim.to_string(),
        };
        let mut out = self.blank(format!("to be shown: {words}"));
        out.dimension = self.dimension_of(&left)?;
        for (asked, value) in [(asked.0, &left), (asked.2, &right)] {
            let raw = self.raw(asked, with);
            out.put_in.push((raw, value.clone(), SUBSTITUTED));
        }
        if asked.1 == Relation::Equal {
            let check = identity(&left, &right, domains);
            let equation = sentence!("{} = {}", asked.0, asked.2);
            out.text.push(match check.holds {
                Some(true) => sentence!("{}: both are {}", equation, &left),
                Some(false) => {
                    sentence!("{} does not hold: {} against {}", equation, &left, &right)
                }
                None => sentence!("{} could not be decided", equation),
            });
            out.checks.push(check);
            out.form = Form::Equation { left, right };
        } else {
            let gap = tidy(&(&left - &right), domains);
            let gap = gap.map_err(|stop| Refused::uncalculated(self.name, stop))?;
            let (text, check) = inequality::shown(&gap, asked.1, domains);
            out.text.push(text);
            out.checks.push(check);
        }
        out.text.extend(with_words(with));
        for name in unless {
            let parts = components(name, self.known).map_or_else(|| vec![name.clone()], Vec::from);
            let mut square = Expr::zero();
            for part in parts {
                square = &square + &self.put(&Expr::symbol(&part), with)?.powi(2);
            }
            out.text.push(vanishing(name, &square, domains));
        }
        Ok(out)
    }

    fn condition(
        &self,
        parameter: &Symbol,
        asked: Stated,
        with: &[(Symbol, Expr)],
    ) -> Result<Answer, Refused> {
        let relation = asked.1;
        let [left, right] = self.sides(asked, with)?;
        let what = match relation {
            Relation::Equal => "value",
            _ => "threshold",
        };
        let mut out = self.blank(format!("{what} of {parameter} for {}", statement(asked)));
        out.text.extend(with_words(with));
        out.stated = Some((left.clone(), relation, right.clone()));
        threshold::fill(&mut out, parameter, &left, relation, &right, self.scene);
        if let Some(root) = out.formula() {
            // What stands in the equation and not in its solution plays no part, which is worth saying.
            let used = root.symbols();
            let all: BTreeSet<Symbol> = left.symbols().union(&right.symbols()).cloned().collect();
            // The other component of a unit vector follows.
            let other = self.scene.domains.other_component(parameter);
            let is_own = |s: &&Symbol| *s == parameter || Some(*s) == other;
            let is_idle = |s: &&Symbol| !is_own(s) && s.as_ref() != "pi" && !used.contains(*s);
            let idle: Vec<Sentence> = all.iter().filter(is_idle).map(Sentence::from).collect();
            if let [first @ .., last] = idle.as_slice() {
                let lead = Sentence::join(first.iter().cloned(), ", ");
                let or = if first.is_empty() { "" } else { " or " };
                let words = sentence!("it does not depend on {}{}{}", lead, or, last);
                out.text.push(words);
            }
        }
        out.dimension = self.dimension_of(&Expr::symbol(parameter))?;
        Ok(out)
    }

    /// Both sides of a statement in parameters alone. Quantities of different kinds are not compared: a plain number counts in SI
    /// units, and what came out of plain numbers is of the kind that was asked for.
    fn sides(&self, asked: Stated, with: &[(Symbol, Expr)]) -> Result<[Expr; 2], Refused> {
        let stated = [asked.0, asked.2];
        let put = [self.put(asked.0, with)?, self.put(asked.2, with)?];
        if stated.iter().any(|side| side.is_constant()) || put.iter().any(Expr::is_zero) {
            return Ok(put);
        }
        let kinds = stated.map(|side| dimension::of(side, &|name| kind_of(self.scene, name)));
        if let [Ok(Some(l)), Ok(Some(r))] = &kinds
            && l == r
        {
            return Ok(put);
        }
        let (l, r) = (self.dimension_of(&put[0])?, self.dimension_of(&put[1])?);
        if l == r {
            return Ok(put);
        }
        let reason = format!("the sides of {} are {l} and {r}", statement(asked));
        let named = unit_meant(asked.0, &r).or_else(|| unit_meant(asked.2, &l));
        let hint = named.unwrap_or_else(|| String::from("compare quantities of the same kind"));
        Err(Refused::question(self.name, reason, hint))
    }
}

/// What to write for a side such as `1 m` where m is a mass, and the other side a length.
fn unit_meant(side: &Expr, other: &Dimension) -> Option<String> {
    let (number, name) = side.split_number();
    let name = name.as_symbol()?;
    let unit = dimension::unit(name).ok()?;
    let alone = write_plain(&(Expr::from(number) * unit.value()));
    (unit.dimension == *other)
        .then(|| format!("`{name}` is a parameter here: write {alone} alone, which is in SI units"))
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
            Node::Power(base, k) if k.is_integer() => (base.clone(), k.clone()),
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

fn statement((left, relation, right): Stated) -> String {
    let [left, right] = [left, right].map(write_plain);
    format!("{left} {} {right}", relation.sign())
}

/// Where a quantity vanishes whose square this is.
fn vanishing(name: &Symbol, square: &Expr, domains: &Domains) -> Sentence {
    if is_zero(square, domains) == Some(true) {
        return sentence!("{} is zero throughout: the statement is empty", name);
    }
    let places = zeros::of(&essential(square, domains), domains);
    if places.is_empty() {
        return sentence!("{} is nowhere zero", name);
    }
    let places = Sentence::join(places, " or ");
    sentence!(
        "the exception is {}: there {} is zero and the statement is empty",
        places,
        name
    )
}

/// An identity, decided.
pub(super) fn identity(left: &Expr, right: &Expr, domains: &Domains) -> Check {
    let (words, holds) = match equality::decide(left, right, domains).equality {
        Equality::Same {
            how: How::Identity { .. },
        } => {
            let words = "identity: the difference is identically zero";
            (words.into(), Some(true))
        }
        Equality::Same {
            how: How::OnBranch { elsewhere, .. },
        } => {
            let at = elsewhere.at.words();
            let words = format!("holds on a part of the domain only, not at {at}");
            (words, Some(false))
        }
        Equality::Different(point) => (format!("different at {}", point.at.words()), Some(false)),
        _ => (String::from("not decided"), None),
    };
    Check::new("identity", words, holds)
}

fn with_words(with: &[(Symbol, Expr)]) -> Vec<Sentence> {
    with.iter()
        .map(|(s, v)| sentence!("taken at {} = {}", s, v))
        .collect()
}

/// What a value divides by and what is known to vanish at an end of the domain; with `inside` also what was seen to vanish within.
pub fn divided_by(value: &Expr, domains: &Domains, inside: bool) -> Vec<Sentence> {
    let below = value.parts().filter_map(Expr::divides_by);
    let vanishes = below
        .map(|(base, _)| base)
        .filter(|base| match sign(base, domains) {
            Seen::Proved(sign) => !matches!(sign, Sign::Positive | Sign::Negative),
            Seen::Positive | Seen::Negative => false,
            Seen::Mixed => inside,
        });
    let mut out: Vec<Sentence> = Vec::new();
    for condition in vanishes.filter_map(|base| not_zero(base, domains)) {
        if !out.contains(&condition) {
            out.push(condition);
        }
    }
    out
}
