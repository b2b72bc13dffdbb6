//! What is asked about answers is asked where the scene gets to them: the motions before come to their ends, the bodies approach.
//!
//! In: a question about formulas, and one way through the stages that its answers come from. Out: what must hold for that, the
//! scene on that part of its domain, and the answer with what it rests on.

use std::collections::BTreeSet;

use super::super::grips::Grip;
use super::super::worlds::World;
use super::super::{Case, StageTold, line};
use super::{happens_where, supposed};
use crate::answer::calc::{self, above_zero, beyond_zero, essential, is_zero, tidy};
use crate::answer::{Answer, Form, Known, given_alike, limit};
use crate::domain::{Domain, Domains, Origin, Relation};
use crate::expr::{Expr, Symbol};
use crate::formula::{self, Sentence, sentence};
use crate::scene::{Ask, Question, Scene, StageKind, without_case};
use crate::verify::possible::{Condition, Rule};

/// A step away from a value.
const STEP: &str = "\u{1}step";

/// Something that must hold so that a scene gets to some answers.
#[derive(Clone, PartialEq)]
pub(in crate::story) struct Need {
    /// The relation.
    pub relation: Relation,
    /// The same as an answer tells it.
    pub told: Sentence,
}

impl Need {
    fn new(excess: &Expr, closed: bool, origin: Origin, told: Sentence) -> Need {
        let words = beyond(excess, closed).to_string();
        let relation = Relation::needed(excess, closed, words, origin);
        Need { relation, told }
    }

    /// Whether these are its words: then [`tell`] decides where they stand.
    pub fn says(&self, words: &Sentence) -> bool {
        self.told.to_string() == words.to_string()
    }

    /// The same with values for parameters.
    fn put(&self, with: &Known, domains: &Domains) -> Need {
        let Relation {
            excess,
            closed,
            origin,
            ..
        } = &self.relation;
        let there = match with.keys().any(|name| excess.mentions(name)) {
            true => essential(&excess.substitute(with), domains),
            false => excess.clone(),
        };
        let told = match origin.so_that() {
            Some(so_that) if there != *excess => {
                sentence!(
                    "{}, so that {}",
                    beyond_zero(&there, domains, !closed),
                    so_that
                )
            }
            _ => self.told.clone(),
        };
        Need::new(&there, *closed, origin.clone(), told)
    }

    /// Whether it is proved to hold always, or never.
    fn is_sure(&self, domains: &Domains) -> Option<bool> {
        calc::keeps_to(&self.relation.excess, self.relation.closed, domains)
    }
}

fn beyond(excess: &Expr, closed: bool) -> Sentence {
    match closed {
        true => Sentence::not_negative(excess),
        false => Sentence::positive(excess),
    }
}

/// What is needed besides the domain, each once.
fn open(all: impl Iterator<Item = Need>, domains: &Domains) -> Vec<Need> {
    let mut out: Vec<Need> = Vec::new();
    for need in all.filter(|need| need.is_sure(domains).is_none()) {
        let same = |n: &&mut Need| n.relation.excess == need.relation.excess;
        match out.iter_mut().find(same) {
            // Of the same twice the stricter one holds.
            Some(known) if !need.relation.closed => *known = need,
            Some(_) => {}
            None => out.push(need),
        }
    }
    out
}

/// The scene where all that is needed holds.
pub(in crate::story) fn part(scene: &Scene, needs: &[Need]) -> Scene {
    let mut scene = scene.clone();
    for need in needs {
        scene.domains = scene.domains.with_relation(need.relation.clone());
    }
    scene
}

/// What must hold so that the bodies collide as the one impact of a scene has it, and its contact does what is told.
pub(in crate::story) fn of_impact(scene: &Scene, case: &Case, question: &Question) -> Vec<Need> {
    if !is_of_outcomes(&scene.questions, question) {
        return Vec::new();
    }
    let possible = case.possible.open().into_iter().filter_map(of_condition);
    open(possible.chain(decided(scene)), &scene.domains)
}

/// What a condition of a collision needs, with its reason; nothing of one that is an equation.
pub(in crate::story) fn of_condition(c: &Condition) -> Option<Need> {
    let excess = c.essential.as_ref().filter(|_| !c.is_equation)?;
    let closed = c.rule != Rule::Approach;
    let origin = Origin::Outcome(c.words.clone());
    Some(Need::new(excess, closed, origin, c.told()?))
}

/// The scene's domains where friction does what is told.
pub(in crate::story) fn as_decided(scene: &Scene) -> Domains {
    let with = |all: Domains, need: Need| all.with_relation(need.relation);
    decided(scene).fold(scene.domains.clone(), with)
}

/// What must hold so that friction does what is told.
fn decided(scene: &Scene) -> impl Iterator<Item = Need> {
    scene.decided().flat_map(move |(at, decided)| {
        let excesses = decided.excesses().zip(&decided.when);
        excesses.map(move |((excess, closed), (left, relation, right))| {
            let told = sentence!("{} {} {}", left, relation.sign(), right);
            let origin = Origin::Outcome(decided.mode.of(&scene.contacts[at].name));
            Need::new(&excess, closed, origin, told)
        })
    })
}

/// Leaves open what is asked of a parameter whose value picks the case in which the answers were found: what they say of all its
/// values is so in that case alone. A threshold or root that was found there stays, with its condition.
pub(in crate::story) fn leave_to_cases<'a>(
    scene: &Scene,
    question: &Question,
    mut conditions: impl Iterator<Item = &'a Expr>,
    answers: &mut [Answer],
) {
    let is_given = |name: &&Symbol| scene.parameter(name).is_some_and(|p| p.value.is_some());
    let varied = match &question.ask {
        Ask::Condition { parameter, .. } => std::slice::from_ref(parameter),
        Ask::Extremum { over, .. } => over,
        _ => &[],
    };
    let mut varied = varied.iter().filter(is_given);
    let Some(name) = varied
        .next()
        .filter(|name| conditions.any(|e| e.mentions(name)))
    else {
        return;
    };
    let is_found =
        |a: &Answer| matches!(question.ask, Ask::Condition { .. }) && !a.range.is_empty();
    for answer in answers.iter_mut().filter(|a| !is_found(a)) {
        let why = sentence!(
            "the value of {} picks the case here, and others have another answer: without that value each is told",
            &Expr::symbol(name)
        );
        *answer = super::unanswered(question, &why);
    }
}

/// The conditions of what friction does in an impact; none where that is supposed.
pub(in crate::story) fn picked(impact: &Scene) -> impl Iterator<Item = &Expr> {
    let picked = impact.decided().filter(|(_, d)| d.law.supposing.is_none());
    picked.flat_map(|(_, d)| d.when.iter().flat_map(|(left, _, right)| [left, right]))
}

/// Whether a question is about what an outcome gives; a coefficient at which friction does something else is given by none.
pub(in crate::story) fn is_of_outcomes(questions: &[Question], question: &Question) -> bool {
    let mut used = used(questions, question).into_iter();
    used.any(|q| match q.ask.formulas().is_empty() {
        true => !matches!(q.ask, Ask::Friction { .. }),
        false => is_of_outcomes(questions, q),
    })
}

/// What leads to answers: a scene, its stages as they are told, one of the ways it can go, and the answers that are known.
#[derive(Clone, Copy)]
pub(in crate::story) struct Led<'a> {
    scene: &'a Scene,
    stages: &'a [StageTold],
    world: &'a World,
    earlier: &'a [Answer],
}

impl<'a> Led<'a> {
    pub fn by(
        (scene, stages): (&'a Scene, &'a [StageTold]),
        world: &'a World,
        earlier: &'a [Answer],
    ) -> Led<'a> {
        Led {
            scene,
            stages,
            world,
            earlier,
        }
    }
}

/// What must hold so that the scene gets to the answers that a question is about, in one of the ways it can go.
pub(in crate::story) fn needs(led: Led<'_>, question: &Question) -> Vec<Need> {
    let all = used(&led.scene.questions, question)
        .into_iter()
        .flat_map(|q| {
            let own = of_value(q, &led.world.known, led.earlier);
            if q.ask.formulas().is_empty() {
                return of_stages(led, q).into_iter().chain(own).collect();
            }
            let fixed = fixed(q, &led.world.known);
            let all = needs(led, q).into_iter();
            let all = all.map(|need| need.put(&fixed, &led.scene.domains));
            all.chain(own).collect::<Vec<Need>>()
        });
    open(all, &led.scene.domains)
}

/// What the value of an answer needs, to be one of those that were asked for.
fn of_value<'a>(
    question: &'a Question,
    known: &'a Known,
    earlier: &'a [Answer],
) -> impl Iterator<Item = Need> + 'a {
    let value = known.get(question.name.as_str());
    let mine = earlier.iter().filter(|a| a.question == question.name);
    let needs = mine.flat_map(|a| &a.needs);
    let needs = needs.filter(move |(of, ..)| Some(of) == value);
    needs.map(|(_, excess, closed)| {
        let so_that = format!("`{}` exists", question.name);
        let told = sentence!("{}, so that {}", beyond(excess, *closed), &so_that);
        Need::new(excess, *closed, Origin::Outcome(so_that), told)
    })
}

/// The values of parameters at which a question about formulas is answered.
fn fixed(question: &Question, known: &Known) -> Known {
    let with = question.ask.with().iter().cloned();
    let mut all: Known = with
        .map(|(name, value)| (name, value.substitute(known)))
        .collect();
    let own = match &question.ask {
        Ask::Condition { parameter, .. } => {
            let value = known.get(question.name.as_str());
            value.map(|value| (parameter.clone(), value.clone()))
        }
        Ask::Limit { parameter, to, .. } => {
            let to = to.as_ref().map(|to| to.substitute(known));
            to.map(|to| (parameter.clone(), to))
        }
        _ => None,
    };
    all.extend(own);
    all
}

/// What the stages need that lead to the answers to a question about one.
fn of_stages(led: Led<'_>, question: &Question) -> Vec<Need> {
    let leading = leading(led, question).into_iter();
    let all = leading.flat_map(|i| {
        let told = &led.stages[i];
        let ends = told.needs.iter().map(|need| {
            let so_that = format!("`{}` comes to its end", told.name);
            let need = essential(need, &told.placed.scene.domains);
            // Whether it may be zero stands in what the motion takes for granted.
            let strict = above_zero(&need, &led.scene.domains).condition();
            let mut granted = told.assumptions.iter().map(Sentence::condition);
            let closed = !granted.any(|condition| condition.is_some() && condition == strict);
            let least = beyond_zero(&need, &led.scene.domains, !closed);
            let words = sentence!("{}, so that {}", least, &so_that);
            Need::new(&need, closed, Origin::Ending(so_that), words)
        });
        let case = led.world.outcome.get(&i).and_then(|k| told.cases.get(*k));
        let conditions = case.into_iter().flat_map(|case| &case.conditions);
        let conditions = conditions.map(|condition @ (why, e)| {
            Need::new(e, true, Origin::Outcome(why.clone()), supposed(condition))
        });
        let places = case.into_iter().flat_map(|case| &case.places);
        let places = places.filter_map(of_condition);
        ends.chain(conditions).chain(places)
    });
    all.collect()
}

/// The stages that lead to the answers to a question about one.
fn leading(led: Led<'_>, question: &Question) -> BTreeSet<usize> {
    let happens = |at: &(usize, usize)| led.world.outcome.get(&at.0) == Some(&at.1);
    let told = led.earlier.iter().filter(|a| a.question == question.name);
    let leading = told.filter_map(|a| a.told.filter(happens)).flat_map(|at| {
        let whole = line(led.stages, at).map(|(stage, _)| stage);
        whole.skip(usize::from(!question.ask.is_at_end()))
    });
    leading.collect()
}

/// Lets an answer about formulas tell what the motions before need on their way, such as over a highest place.
pub(super) fn on_the_way(led: Led<'_>, question: &Question, answer: &mut Answer) {
    for q in used(&led.scene.questions, question) {
        if !q.ask.formulas().is_empty() {
            on_the_way(led, q, answer);
        }
        let leading = leading(led, q).into_iter();
        let all = leading.flat_map(|i| &led.stages[i].assumptions);
        let is_told = |words: &&Sentence| words.is_partial() || words.is_of_the_way();
        besides(answer, all.filter(is_told));
    }
}

/// Lets an answer about formulas tell which contacts have to grip, with the values for which it asks.
pub(super) fn gripped(led: Led<'_>, question: &Question, answer: &mut Answer) {
    let mut with = fixed(question, &led.world.known);
    // A bound holds for all values beyond it.
    let is_value = match &question.ask {
        Ask::Condition { relation, .. } => *relation == formula::Relation::Equal,
        _ => matches!(question.ask, Ask::Extremum { .. }),
    };
    let found = answer.range.iter().filter(|_| is_value);
    with.extend(found.filter_map(|(of, _, value)| Some((of.as_symbol()?.clone(), value.clone()))));
    let all = grips(led, question).into_iter();
    let all = all.map(|grip| grip.put(&with, &led.scene.domains));
    let words: Vec<Sentence> = all
        .filter_map(|grip| grip.told(&led.scene.domains))
        .collect();
    besides(answer, words.iter());
}

/// The contacts that have to grip in the stages that lead to the answers that a question is about.
fn grips(led: Led<'_>, question: &Question) -> Vec<Grip> {
    let all = used(&led.scene.questions, question)
        .into_iter()
        .flat_map(|q| {
            if q.ask.formulas().is_empty() {
                let leading = leading(led, q).into_iter();
                return leading.flat_map(|i| led.stages[i].grips.clone()).collect();
            }
            let with = fixed(q, &led.world.known);
            let all = grips(led, q).into_iter();
            let all = all.map(|grip| grip.put(&with, &led.scene.domains));
            all.collect::<Vec<Grip>>()
        });
    all.collect()
}

/// Lets an answer about a stage tell what the motions suppose that lead there, and what the impacts need.
pub(super) fn led_to(stages: &[StageTold], answer: &mut Answer) {
    let Some(at) = answer.told else { return };
    let before: Vec<(usize, usize)> = line(stages, at).skip(1).collect();
    let each = before.iter().rev().map(|(stage, outcome)| {
        let told = &stages[*stage];
        match told.cases.get(*outcome) {
            Some(case) => happens_where(case).collect::<Vec<_>>(),
            None => {
                let mut all = told.assumptions.clone();
                all.retain(Sentence::is_condition);
                let domains = &told.placed.scene.domains;
                all.extend(told.grips.iter().filter_map(|grip| grip.told(domains)));
                all
            }
        }
    });
    let all: Vec<Sentence> = each.flatten().collect();
    besides(answer, all.iter());
}

/// Lets an answer that is the same in all cases tell that one of them happens, where others are left away.
pub(super) fn one_of_the_cases(
    scene: &Scene,
    question: &Question,
    earlier: &[Answer],
    answer: &mut Answer,
) {
    let is_supposed = scene.stages.iter().any(|stage| {
        let law = stage.scene.friction().and_then(|(_, law)| law.supposing);
        law.is_some()
            || matches!(&stage.kind, StageKind::Impact { supposed, .. } if supposed.is_some())
    });
    if !is_supposed || matches!(answer.form, Form::Open(_)) {
        return;
    }
    let found = answer.range.iter();
    let found = found.map(|(of, _, value)| Some((of.as_symbol()?.clone(), value.clone())));
    let found: Known = found.flatten().collect();
    let mut all: Vec<Sentence> = Vec::new();
    for name in question.ask.formulas().into_iter().flat_map(Expr::symbols) {
        let is_it = |a: &&Answer| without_case(&a.name) == &*name || a.question == *name;
        let mine: Vec<&Answer> = earlier.iter().filter(is_it).collect();
        let is_new = |words: &Sentence| mine.iter().all(|a| !a.assumptions.contains(words));
        let either = given_alike(&mine, &scene.domains)
            .into_iter()
            .filter(is_new);
        let there = |e: &Expr| {
            let put = e.substitute(&found);
            tidy(&put, &scene.domains).unwrap_or(put)
        };
        all.extend(either.map(|words| words.map(there)));
    }
    besides(answer, all.iter());
}

/// Puts conditions before those of an answer, none of them twice.
fn besides<'a>(answer: &mut Answer, all: impl Iterator<Item = &'a Sentence>) {
    let mut before: Vec<Sentence> = Vec::new();
    for words in all {
        let mut known = before.iter().chain(&answer.assumptions);
        if !known.any(|known| known.tells_as(words)) {
            before.push(words.clone());
        }
    }
    answer.assumptions.splice(0..0, before);
}

/// Adds to an answer what it rests on of all that is needed.
pub(in crate::story) fn tell(scene: &Scene, ask: &Ask, needs: &[Need], answer: &mut Answer) {
    // A largest value needs what holds at its place, a limit what holds as it is come to.
    let place = match ask {
        Ask::Extremum { .. } => answer.range.iter(),
        _ => [].iter(),
    };
    let place = place.map(|(of, _, value)| Some((of.as_symbol()?.clone(), value.clone())));
    let best: Known = place.flatten().collect();
    let mut place = best.clone();
    if let Ask::Limit {
        parameter,
        to: Some(to),
        ..
    } = ask
    {
        place.insert(parameter.clone(), to.clone());
    }
    // What others say elsewhere than at the place of a largest value grants nothing there, and what is sought is not granted.
    let is_sought = |n: &Need| match ask {
        Ask::Condition { parameter, .. } => n.relation.excess.mentions(parameter),
        _ => false,
    };
    let besides = |need: &Need, all: &[Need]| {
        let others = all.iter().filter(|n| *n != need && !is_sought(n));
        let others: Vec<Need> = others.map(|n| n.put(&best, &scene.domains)).collect();
        part(scene, &others).domains
    };
    let mut left = needs.to_vec();
    left.retain(|need| !is_granted(need, ask, answer, &besides(need, needs)));
    for need in left.clone() {
        let domains = &besides(&need, &left);
        let there = need.put(&place, domains);
        // What the others grant is not told besides.
        if there.is_sure(domains) == Some(true) {
            left.retain(|n| *n != need);
            continue;
        }
        // The place may lie where it ends. A limit is come to from one side, and that is told.
        let is_end = is_zero(&there.relation.excess, &scene.domains) == Some(true);
        let there = match ask {
            Ask::Limit { .. } if is_end || tidy(&there.relation.excess, domains).is_err() => {
                need.clone()
            }
            _ if is_end => continue,
            _ => there,
        };
        if !answer.assumptions.contains(&there.told) {
            answer.assumptions.push(there.told);
        }
    }
    answer.assumptions.sort();
    // One of several values is told of each.
    answer
        .assumptions
        .dedup_by(|later, first| later.tells_as(first));
}

/// Whether an answer says by itself that something needed holds.
fn is_granted(need: &Need, ask: &Ask, answer: &Answer, domains: &Domains) -> bool {
    let excess = &need.relation.excess;
    // What is put in is held against it already.
    if ask.with().iter().any(|(name, _)| excess.mentions(name)) {
        return true;
    }
    match ask {
        // Each value is held against it already.
        Ask::Condition {
            parameter,
            relation: formula::Relation::Equal,
            ..
        } => excess.mentions(parameter) && !answer.range.is_empty(),
        Ask::Condition { parameter, .. } => match answer.range.as_slice() {
            // At that value the scene just gets there, or gets there from it on.
            [(of, relation, value)] if *of == Expr::symbol(parameter) => {
                let domains = &answer.where_is(value, domains);
                is_zero(&excess.put(parameter, value), domains) == Some(true)
                    || holds_on(*relation, excess, parameter, value, domains)
            }
            _ => false,
        },
        Ask::Limit { parameter, to, .. } => {
            let ends_above = || limit::ends_above(excess, parameter, to.as_ref(), domains);
            excess.mentions(parameter) && (answer.formula().is_none() || ends_above())
        }
        _ => false,
    }
}

/// Whether something is proved not to be negative for every value of a parameter on the side of this one that a relation tells.
fn holds_on(
    relation: formula::Relation,
    need: &Expr,
    symbol: &Symbol,
    from: &Expr,
    domains: &Domains,
) -> bool {
    let step = Expr::symbol(STEP);
    let mut domains = domains.clone();
    domains.symbols.insert(STEP.into(), Domain::positive());
    let there = match relation.is_below() {
        true => from - &step,
        false => from + &step,
    };
    let there = need.put(symbol, &there);
    relation != formula::Relation::Equal && calc::keeps_to(&there, true, &domains) == Some(true)
}

/// The questions whose answers a question uses by name, in its formulas or in what is put in.
pub(super) fn used<'a>(questions: &'a [Question], question: &Question) -> Vec<&'a Question> {
    let before = questions.iter().take_while(|q| q.name != question.name);
    let put_in = question.ask.with().iter().map(|(_, value)| value);
    let all = question.ask.formulas().into_iter().chain(put_in);
    let names: BTreeSet<Symbol> = all.flat_map(Expr::symbols).collect();
    let is_used = |q: &&Question| names.iter().any(|name| q.part(name).is_some());
    before.filter(is_used).collect()
}
