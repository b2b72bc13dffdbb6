//! Definitions of answers, held against the scene: what a step gives an answer must be what the question comes to in the scene
//! followed in numbers, whether another step uses it or not.
//!
//! In: a scene, what a step defines, a point. Out: whether the two agree there. An answer of one of several cases has to agree
//! where what its step needs is so.

use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

use super::{Claim, Report};
use crate::expr::{Expr, Point, Symbol};
use crate::numeric::follow::{self, Followed};
use crate::numeric::{self, Needed};
use crate::scene::{Ask, Question, Scene, without_case};

/// Relative difference between a value told and the one found.
const CLOSE: f64 = 1e-7;
/// Difference that is none at values of ordinary size.
const SMALL: f64 = 1e-8;
/// How many turns of a repeated group are followed.
const TURNS: u32 = 3;
/// Points of ordinary size, and of any size, at which an answer of a case is looked at.
const TRIES: u64 = 2000;
/// Of these, as many are enough to tell that it is none.
const ENOUGH: usize = 6;
/// Equal parts of a blow in which its motion is followed.
const PARTS: u32 = 400;

/// A scene followed at one point, once it is asked for.
#[derive(Default)]
pub(super) struct Here(OnceCell<Option<Followed>>);

impl Here {
    fn followed(&self, scene: &Scene, at: &Point<f64>) -> Option<&Followed> {
        self.0
            .get_or_init(|| follow::follow(scene, at).ok())
            .as_ref()
    }
}

/// A scene, and what the steps of a solution define.
pub(super) struct Defined<'a> {
    scene: &'a Scene,
    told: BTreeMap<&'a Symbol, &'a Expr>,
}

impl<'a> Defined<'a> {
    pub(super) fn new(scene: &'a Scene, claims: &[&'a Claim]) -> Defined<'a> {
        let told = claims.iter();
        let told = told.filter_map(|claim| Some((claim.defines.as_ref()?, &claim.right)));
        Defined {
            scene,
            told: told.collect(),
        }
    }

    /// Why an answer is not what the question with its name comes to at a point, or that it is; `None` where that was not seen.
    pub(super) fn held(
        &self,
        name: &Symbol,
        told: &Expr,
        (at, here): (&Point<f64>, &Here),
    ) -> Option<Result<(), String>> {
        let scene = self.scene;
        let name = without_case(name);
        let question = scene.answering(name)?;
        match &question.ask {
            Ask::Friction { contact, event } => {
                let (stage, value) = (question.stage?, told.evaluate(at)?);
                let tips = follow::tips(scene, stage, (*contact, *event), value, at)?;
                let why = format!("beside {value} the contact does something else");
                Some(if tips { Ok(()) } else { Err(why) })
            }
            Ask::Turn { number, .. } => {
                let followed = here.followed(scene, at)?;
                let mut there = at.clone();
                let turns = (1..=TURNS).map(|turn| {
                    there.values.insert(number.clone(), f64::from(turn));
                    let found = follow::answer(scene, followed, question, &there).ok()?;
                    Some(same(told.evaluate(&there)?, found.component(None)?))
                });
                turns.collect::<Option<Result<(), String>>>()
            }
            Ask::Share {
                mass,
                stiffness,
                during,
            } if question.name == name => {
                let [m, k, during] = [mass, stiffness, during].map(|e| e.evaluate(at));
                Some(same(told.evaluate(at)?, share([m?, k?, during?])))
            }
            ask => {
                let followed = here.followed(scene, at)?;
                let found = self.value(followed, question, name, at)?;
                let told = told.evaluate(at)?;
                // A direction is the same after a full turn.
                let turns = match ask {
                    Ask::Value { polar: Some(_), .. } => ((told - found) / TAU).round(),
                    _ => 0.0,
                };
                Some(same(told, found + turns * TAU))
            }
        }
    }

    /// What a question comes to, by the name of its answer or of a component of it.
    fn value(
        &self,
        followed: &Followed,
        question: &Question,
        name: &str,
        at: &Point<f64>,
    ) -> Option<f64> {
        let axis = (question.name != name).then(|| usize::from(name.ends_with("_y")));
        let Ask::Value { formula, with, .. } = &question.ask else {
            let found = follow::answer(self.scene, followed, question, at).ok()?;
            return found.component(axis);
        };
        if with.is_empty() && axis.is_none() {
            let names = self.known(followed, formulas(&question.ask), at);
            return question.ask.value(&names);
        }
        let mut there = at.clone();
        for (parameter, value) in with {
            let value = value.evaluate(&self.known(followed, vec![value], at))?;
            there.values.insert(parameter.clone(), value);
            there.directions.remove(parameter);
        }
        let followed = follow::follow(self.scene, &there).ok()?;
        let of = match (axis, formula.as_symbol()) {
            (Some(axis), Some(vector)) => Expr::symbol(&format!("{vector}_{}", ["x", "y"][axis])),
            _ => formula.clone(),
        };
        of.evaluate(&self.known(&followed, vec![&of], &there))
    }

    /// A point with the values of the answers that formulas use, as they are followed; those of which nothing is followed, a threshold
    /// say, by the formula that the solution has for them, which steps of its own hold.
    fn known(&self, followed: &Followed, of: Vec<&Expr>, at: &Point<f64>) -> Point<f64> {
        let mut out = at.clone();
        for name in of.into_iter().flat_map(Expr::symbols) {
            let question = self.scene.answering(&name);
            let Some(question) = question.filter(|_| self.scene.parameter(&name).is_none()) else {
                continue;
            };
            let found = self.value(followed, question, &name, at);
            match found.or_else(|| self.told.get(&name)?.evaluate(at)) {
                Some(value) => out.values.insert(name, value),
                None => out.values.remove(&name),
            };
        }
        out
    }
}

fn same(told: f64, found: f64) -> Result<(), String> {
    match (told - found).abs() <= CLOSE * told.abs().max(found.abs()) + SMALL {
        true => Ok(()),
        false => Err(format!(
            "it is {told} in the solution, {found} when followed"
        )),
    }
}

/// The formulas that the value of a question is made of.
fn formulas(ask: &Ask) -> Vec<&Expr> {
    match ask {
        Ask::Value {
            polar: Some(parts), ..
        } => parts.iter().collect(),
        ask => ask.formulas(),
    }
}

/// The share of a blow of constant force that a spring takes, from its motion in small steps of time.
fn share([mass, stiffness, during]: [f64; 3]) -> f64 {
    // For a blow of size 1.
    let force = 1.0 / during;
    let step = during / f64::from(PARTS);
    let rate = |[place, speed, _]: [f64; 3]| {
        [speed, (force - stiffness * place) / mass, stiffness * place]
    };
    let on = |from: [f64; 3], rate: [f64; 3], by: f64| [0, 1, 2].map(|i| from[i] + by * rate[i]);
    let mut state = [0.0; 3];
    for _ in 0..PARTS {
        let first = rate(state);
        let second = rate(on(state, first, step / 2.0));
        let third = rate(on(state, second, step / 2.0));
        let fourth = rate(on(state, third, step));
        state = [0, 1, 2]
            .map(|i| state[i] + step / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]));
    }
    state[2]
}

/// Whether a name is that of an answer in one of several cases.
pub(super) fn is_case(name: &str) -> bool {
    without_case(name) != name
}

/// Whether a claim defines such an answer.
pub(super) fn is_of_a_case(claim: &Claim) -> bool {
    claim.defines.as_deref().is_some_and(is_case)
}

/// Holds the answers of cases against the scene: each must be what is followed at one of the points where its step's needs hold.
pub(super) fn in_cases(scene: &Scene, needed: &Needed, claims: &[&Claim], report: &mut Report) {
    let defined = Defined::new(scene, claims);
    let all = claims.iter().filter(|claim| is_of_a_case(claim));
    let mut open: Vec<(&Claim, Vec<String>)> = all.map(|claim| (*claim, Vec::new())).collect();
    let draws = [numeric::random_point, numeric::point_of_any_size];
    let seeds = draws
        .into_iter()
        .flat_map(|draw| (1..=TRIES).map(move |seed| (draw, seed)));
    for (draw, seed) in seeds {
        if open.iter().all(|(_, whys)| whys.len() >= ENOUGH) {
            break;
        }
        let point = numeric::rounded(&draw(needed, &scene.domains, seed));
        let here = Here::default();
        open.retain_mut(|(claim, whys)| {
            let wanted = whys.len() < ENOUGH && holds(&claim.needs, &point);
            let name = claim.defines.as_ref().filter(|_| wanted);
            match name.and_then(|name| defined.held(name, &claim.right, (&point, &here))) {
                Some(Ok(())) => return false,
                Some(Err(why)) => whys.push(why),
                None => {}
            }
            true
        });
    }
    for (claim, whys) in open {
        if let (Some(why), true) = (whys.first(), whys.len() >= ENOUGH) {
            report.fail(&claim.step, &claim.text, why.clone());
        }
    }
}

/// Whether nothing that has to be ≥ 0 is negative at a point.
pub(super) fn holds(needs: &[Expr], at: &Point<f64>) -> bool {
    let mut values = needs.iter().filter_map(|e| e.evaluate(at));
    values.all(|value| value >= 0.0)
}

/// Whether all of these are above zero at a point; none without one.
pub(super) fn within(needs: &[Expr], at: &Point<f64>) -> bool {
    let mut values = needs.iter().filter_map(|e| e.evaluate(at));
    !needs.is_empty() && values.all(|value| value > 0.0)
}
