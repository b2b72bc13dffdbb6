//! What is asked about answers is asked where the scene gets to them: the motions before come to their ends, the bodies approach.
//!
//! In: a question about formulas, and one way through the stages that its answers come from. Out: what must hold for that, the
//! scene on that part of its domain, and the answer with what it rests on.

use std::collections::BTreeSet;

use super::super::worlds::{World, without_case};
use super::super::{Case, StageTold, line};
use super::supposed;
use crate::algebra::Sign;
use crate::answer::calc::{Seen, above_zero, at_least_zero, essential, is_zero, sign, tidy};
use crate::answer::{Answer, Form, Known, given_alike, limit};
use crate::domain::{Domain, Domains, Origin, Relation};
use crate::expr::{Expr, Symbol};
use crate::formula::{self, Sentence, sentence};
use crate::scene::{Ask, ContactLaw, Question, Scene, StageKind};
use crate::verify::possible::Rule;

/// A step upwards from a value.
const STEP: &str = "\u{1}step";

/// Something that must hold so that a scene gets to some answers.
#[derive(Clone, PartialEq)]
pub(in crate::story) struct Need {
    relation: Relation,
    /// The same as an answer tells it.
    told: Sentence,
}

impl Need {
    fn new(excess: &Expr, closed: bool, origin: Origin, told: Sentence) -> Need {
        let beyond = match closed {
            true => Sentence::not_negative(excess),
            false => Sentence::positive(excess),
        };
        let relation = Relation {
            sides: [Expr::zero(), excess.clone()],
            excess: excess.clone(),
            closed,
            words: beyond.to_string(),
            origin,
        };
        Need { relation, told }
    }

    /// The same with values for parameters; nothing where it holds for certain.
    fn put(&self, with: &Known, domains: &Domains) -> Option<Need> {
        let excess = self.relation.excess.substitute(with);
        let closed = self.relation.closed;
        let is_sure = match sign(&excess, domains) {
            Seen::Proved(s) => s == Sign::Positive || closed && s.is_not_negative(),
            _ => false,
        };
        if is_sure {
            return None;
        }
        let (closed, origin) = (self.relation.closed, &self.relation.origin);
        let told = match origin.so_that() {
            Some(so_that) if excess != self.relation.excess => {
                let beyond = match closed {
                    true => at_least_zero(&excess, domains),
                    false => above_zero(&excess, domains),
                };
                sentence!("{}, so that {}", beyond, so_that)
            }
            _ => self.told.clone(),
        };
        Some(Need::new(&excess, closed, origin.clone(), told))
    }

    /// Whether it is proved not to hold at any values.
    fn is_broken(&self, domains: &Domains) -> bool {
        match sign(&self.relation.excess, domains) {
            Seen::Proved(Sign::Negative) => true,
            Seen::Proved(Sign::NotPositive | Sign::Zero) => !self.relation.closed,
            _ => false,
        }
    }
}

/// What is needed besides the domain where a question puts in values, each once; `Err` with the reason where they keep the scene
/// from there.
fn put_in(
    all: impl Iterator<Item = Need>,
    with: &Known,
    domains: &Domains,
) -> Result<Vec<Need>, Sentence> {
    let mut out: Vec<Need> = Vec::new();
    for whole in all {
        let Some(need) = whole.put(with, domains) else {
            continue;
        };
        if need.is_broken(domains) {
            let each = with.iter();
            let each = each.map(|(name, value)| sentence!("{} = {}", name, value));
            let with = Sentence::join(each, " and ");
            return Err(match with.to_string().as_str() {
                "" => sentence!("{} is needed, which never is so", whole.told),
                _ => sentence!("with {} the scene does not get there: {}", with, whole.told),
            });
        }
        let excess = &need.relation.excess;
        match out.iter_mut().find(|n| n.relation.excess == *excess) {
            // Of the same twice the stricter one holds.
            Some(known) if known.relation.closed => *known = need,
            Some(_) => {}
            None => out.push(need),
        }
    }
    Ok(out)
}

/// The scene where all that is needed holds.
pub(in crate::story) fn part(scene: &Scene, needs: &[Need]) -> Scene {
    let mut scene = scene.clone();
    for Need { relation, .. } in needs {
        let known = scene.domains.relations.iter_mut();
        match known.into_iter().find(|r| r.excess == relation.excess) {
            Some(known) => known.origin.clone_from(&relation.origin),
            None => scene.domains.relations.push(relation.clone()),
        }
    }
    scene
}

/// What must hold so that the bodies collide as the one impact of a scene has it, and its contact does what is told; `Err` with
/// the reason where what a question puts in keeps it from there.
pub(in crate::story) fn of_impact(
    scene: &Scene,
    case: &Case,
    question: &Question,
    known: &Known,
) -> Result<Vec<Need>, Sentence> {
    let open = case.possible.open().into_iter();
    let approach = open.filter(|c| c.rule == Rule::Approach && !c.is_equation);
    let approach = approach.filter_map(|c| {
        let excess = c.essential.as_ref()?;
        let told = sentence!("{} ({})", Sentence::positive(excess), &c.words);
        Some(Need::new(
            excess,
            false,
            Origin::Outcome(c.words.clone()),
            told,
        ))
    });
    let decided = scene.contacts.iter().filter_map(|c| match &c.law {
        ContactLaw::Decided(decided) => Some((&c.name, decided)),
        _ => None,
    });
    let does = decided.flat_map(|(name, decided)| {
        decided.when.iter().map(move |(left, relation, right)| {
            let excess = match relation.is_below() {
                true => right - left,
                false => left - right,
            };
            let told = sentence!("{} {} {}", left, relation.sign(), right);
            Need::new(&excess, true, Origin::Outcome(decided.mode.of(name)), told)
        })
    });
    // A coefficient at which friction does something else is asked of no outcome.
    let of_outcome =
        |q: &&Question| q.name != question.name && !matches!(q.ask, Ask::Friction { .. });
    let uses = chain(&scene.questions, question);
    let uses = uses
        .iter()
        .any(|q| of_outcome(q) && q.ask.formulas().is_empty());
    let all = approach.chain(does).filter(|_| uses);
    let possible = all.filter(|need| !need.is_broken(&scene.domains));
    put_in(possible, &with(question, known), &scene.domains)
}

/// The values that a question puts in for parameters.
fn with(question: &Question, known: &Known) -> Known {
    let with = question.ask.with().iter();
    with.map(|(name, value)| (name.clone(), value.substitute(known)))
        .collect()
}

/// What must hold so that the scene gets to the answers that a question is about, in one of the ways it can go; `Err` with the
/// reason where what the question puts in keeps it from there.
pub(super) fn needs(
    scene: &Scene,
    stages: &[StageTold],
    world: &World,
    question: &Question,
    earlier: &[Answer],
) -> Result<Vec<Need>, Sentence> {
    let leading = leading(stages, world, &chain(&scene.questions, question), earlier);
    let all = leading.into_iter().flat_map(|i| {
        let told = &stages[i];
        let ends = told.needs.iter().map(|need| {
            let so_that = format!("`{}` comes to its end", told.name);
            let need = essential(need, &scene.domains);
            // Whether it may be zero stands in what the motion takes for granted.
            let strict = above_zero(&need, &scene.domains).to_string();
            let mut granted = told.assumptions.iter().map(ToString::to_string);
            let closed = !granted.any(|words| words.starts_with(&strict));
            let least = match closed {
                true => at_least_zero(&need, &scene.domains),
                false => above_zero(&need, &scene.domains),
            };
            let words = sentence!("{}, so that {}", least, &so_that);
            Need::new(&need, closed, Origin::Ending(so_that), words)
        });
        let case = world.outcome.get(&i).and_then(|k| told.cases.get(*k));
        let conditions = case.into_iter().flat_map(|case| &case.conditions);
        let conditions = conditions.map(|condition @ (why, e)| {
            Need::new(e, true, Origin::Outcome(why.clone()), supposed(condition))
        });
        ends.chain(conditions)
    });
    put_in(all, &with(question, &world.known), &scene.domains)
}

/// Lets an answer about a stage tell what the motions suppose that lead there, and what the impacts need.
pub(super) fn led_to(stages: &[StageTold], answer: &mut Answer) {
    let Some(at) = answer.told else { return };
    let before: Vec<(usize, usize)> = line(stages, at).skip(1).collect();
    let each = before.iter().rev().map(|(stage, outcome)| {
        let told = &stages[*stage];
        match told.cases.get(*outcome) {
            Some(case) => case.conditions.iter().map(supposed).collect(),
            None => told.assumptions.clone(),
        }
    });
    let all: Vec<Sentence> = each.flatten().collect();
    besides(
        answer,
        all.iter().filter(|words| words.condition().is_some()),
    );
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
        let either = given_alike(&mine).into_iter().filter(is_new);
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
        if !before.contains(words) && !answer.assumptions.contains(words) {
            before.push(words.clone());
        }
    }
    answer.assumptions.splice(0..0, before);
}

/// Adds to an answer what it rests on of all that is needed.
pub(in crate::story) fn tell(scene: &Scene, ask: &Ask, needs: &[Need], answer: &mut Answer) {
    // A largest value needs what holds at its place.
    let place = match ask {
        Ask::Maximum { .. } => answer.range.iter(),
        _ => [].iter(),
    };
    let place = place.map(|(of, _, value)| Some((of.as_symbol()?.clone(), value.clone())));
    let place: Known = place.flatten().collect();
    let besides = |need: &Need, all: &[Need]| {
        let others: Vec<Need> = all.iter().filter(|n| *n != need).cloned().collect();
        part(scene, &others).domains
    };
    let mut left = needs.to_vec();
    left.retain(|need| !is_granted(need, ask, answer, &besides(need, needs)));
    for need in left.clone() {
        match need.put(&place, &besides(&need, &left)) {
            Some(Need { told, .. }) if answer.assumptions.contains(&told) => {}
            // The place lies where it ends.
            Some(Need { relation, .. })
                if is_zero(&relation.excess, &scene.domains) == Some(true) => {}
            Some(Need { told, .. }) => answer.assumptions.push(told),
            // What the others grant is not told besides.
            None => left.retain(|n| *n != need),
        }
    }
    answer.assumptions.sort();
    answer.assumptions.dedup();
}

/// Whether an answer says by itself that something needed holds.
fn is_granted(need: &Need, ask: &Ask, answer: &Answer, domains: &Domains) -> bool {
    let excess = &need.relation.excess;
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
                is_zero(&excess.put(parameter, value), domains) == Some(true)
                    || is_upward(*relation) && holds_above(excess, parameter, value, domains)
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

fn is_upward(relation: formula::Relation) -> bool {
    use formula::Relation::{Greater, GreaterEqual};
    matches!(relation, Greater | GreaterEqual)
}

/// Whether something is proved not to be negative for every value of a parameter from this one on.
fn holds_above(need: &Expr, symbol: &Symbol, from: &Expr, domains: &Domains) -> bool {
    let step = Symbol::from(STEP);
    let mut domains = domains.clone();
    domains.symbols.insert(step.clone(), Domain::positive());
    let above = from + &Expr::symbol(&step);
    let there = need.put(symbol, &above);
    matches!(sign(&there, &domains), Seen::Proved(s) if s.is_not_negative())
}

/// A question, and all whose answers its formulas use.
fn chain<'a>(questions: &'a [Question], question: &'a Question) -> Vec<&'a Question> {
    let of = |name: &str| questions.iter().find(|q| q.name == name);
    let mut out: Vec<&Question> = Vec::new();
    let mut ahead = vec![question];
    while let Some(question) = ahead.pop() {
        if out.iter().any(|q| q.name == question.name) {
            continue;
        }
        out.push(question);
        let names = question.ask.formulas().into_iter().flat_map(Expr::symbols);
        ahead.extend(names.filter_map(|name| {
            let whole = name.strip_suffix("_x").or(name.strip_suffix("_y"));
            of(&name).or_else(|| of(whole?))
        }));
    }
    out
}

/// The stages that answers to these questions come from in one of the ways, and all before them.
fn leading(
    stages: &[StageTold],
    world: &World,
    chain: &[&Question],
    earlier: &[Answer],
) -> BTreeSet<usize> {
    let mut out = BTreeSet::new();
    for a in earlier {
        let Some(question) = chain.iter().find(|q| q.name == a.question) else {
            continue;
        };
        let happens = |at: &(usize, usize)| world.outcome.get(&at.0) == Some(&at.1);
        let Some((stage, case)) = a.told.filter(happens) else {
            continue;
        };
        if question.ask.is_at_end() {
            out.insert(stage);
        }
        let before = line(stages, (stage, case)).skip(1);
        out.extend(before.map(|(parent, _)| parent));
    }
    out
}
