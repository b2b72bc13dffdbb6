//! Answers held against the scene followed in numbers: what a motion is asked for, and what is asked about answers.
//!
//! In: questions with their answers in closed form, and the points at which the scene was followed. Out: checks. A threshold is
//! looked at on both sides, a largest or least value beside its place and far from it, a limit and an approximation closer and closer.

use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::iter::successors;

use super::super::StageTold;
use super::values::{Asked, moved};
use super::{CLOSE, Compared, POINTS, Seen, points_of, shaken};
use crate::answer::{Answer, Check};
use crate::expr::{Expr, Symbol};
use crate::formula::Relation;
use crate::numeric::follow::{self, OfTurn};
use crate::scene::{Ask, Extremum, FrictionEvent, Question, without_case};

/// How far from a threshold, a largest or a least value its sides are looked at, in parts of it.
const ASIDE: f64 = 1e-3;
/// Other values of the parameter at which something that is largest or least is looked at.
const OTHERS: usize = 6;
/// How much closer, three times over, a parameter comes to what it tends to, and to that near which something stands for a
/// formula.
const CLOSER: [f64; 2] = [1e-2, 1e-1];
/// Half of the first number of turns at which a limit is looked at.
const FAR: f64 = 25.0;
/// How many turns of a repeated group are followed.
const TURNS: u32 = 6;
/// Relative difference of what was followed that the integrator may have made.
const NOISE: f64 = 1e-8;

/// What came of an answer at a point.
enum Held {
    /// It was not seen there.
    Unseen,
    /// Two numbers that have to be the same, the one told first, and a size of their kind.
    Same([f64; 2], f64),
    /// Whether it is so, and what is otherwise.
    So(bool, String),
}

impl Asked<'_> {
    /// Holds an answer against what was followed; `None` for one that no number is asked of.
    pub fn check(&self, question: &Question, answer: &Answer) -> Option<Check> {
        // What was to be shown and is refuted may hold at some points.
        let is_claim = matches!(question.ask, Ask::Show { .. });
        if is_claim && answer.checks.iter().any(|c| c.holds == Some(false)) {
            return None;
        }
        let mut compared = Compared::default();
        let formulas = question.ask.formulas().into_iter();
        let mut about = formulas.flat_map(|formula| self.needs(formula));
        let is_threshold = question.stage.is_some() && matches!(question.ask, Ask::Friction { .. });
        let is_turn = matches!(question.ask, Ask::Turn { .. });
        let asks_motion =
            (self.is_of_motion(question) || is_threshold || is_turn) && answer.formula().is_some();
        let mut is_asked = asks_motion;
        if !asks_motion && !about.any(|q| self.is_of_motion(q)) {
            return None;
        }
        let uses = self.stages_of(question);
        let here = |seen: &&Seen| self.happens(seen, &uses, question, answer);
        let holds = |seen: &&Seen| {
            let value = |e: &Expr| e.evaluate(&seen.point).is_some_and(|v| v >= 0.0);
            answer.needs.iter().all(|(_, e, _)| value(e))
        };
        let mut points: Vec<&Seen> = self.second.points.iter().filter(here).collect();
        let more = match (points.iter().any(holds), answer.range.first()) {
            (false, Some((.., value))) if !answer.needs.is_empty() => {
                let domains = answer.where_is(value, &self.scene.domains);
                let seen = super::seen_where(self.scene, self.stages, &domains);
                seen.filter(|seen| here(&seen)).take(POINTS).collect()
            }
            _ => Vec::new(),
        };
        points.extend(&more);
        for seen in points {
            let held = match &question.ask {
                Ask::Turn { number, .. } => Some(self.repeats(seen, question, number, answer)),
                Ask::Condition { .. } => self.tips(seen, question, answer),
                Ask::Friction { contact, event } => {
                    self.turns(seen, question, (*contact, *event), answer)
                }
                Ask::Extremum { which, of, over } => self.is_best(seen, (*which, of, over), answer),
                Ask::Limit { of, .. } | Ask::Approximate { of, .. } => self.nears(seen, of, answer),
                Ask::Show {
                    left,
                    relation,
                    right,
                    with,
                    ..
                } => Some(self.shows(seen, (left, *relation, right), with)),
                _ => self.number(seen, question, answer),
            };
            is_asked |= held.is_some();
            match held {
                None | Some(Held::Unseen) => {}
                Some(Held::Same(values, size)) => {
                    compared.points += 1;
                    let put_in = || match &question.ask {
                        Ask::Value { formula, .. } => {
                            let part = component(formula, answer);
                            self.shaken_by_what_is_put_in(seen, question, &part)
                        }
                        _ => 0.0,
                    };
                    let shaken = || shaken(answer.formula(), &seen.point) + put_in();
                    compared.put("the value", values, size, shaken);
                }
                Some(Held::So(is_so, otherwise)) => {
                    compared.points += 1;
                    compared.apart = compared.apart.or((!is_so).then_some(otherwise));
                }
            }
        }
        is_asked.then(|| compared.check("this answer", self.second))
    }

    /// Whether a question asks for something of an impact or a motion.
    fn is_of_motion(&self, question: &Question) -> bool {
        match question.ask {
            Ask::Friction { .. } => false,
            _ => question.stage.is_some() || !self.scene.has_stages() && question.ask.is_motion(),
        }
    }

    /// A number, and what the question asks for followed at the same point.
    fn number(&self, seen: &Seen, question: &Question, answer: &Answer) -> Option<Held> {
        let formula = answer.formula()?;
        let told = formula.evaluate(&seen.point);
        let found = match &question.ask {
            Ask::Value {
                polar: Some(parts), ..
            } => {
                let [x, y] = parts.each_ref().map(|v| self.formula(seen, v, &[], &[]));
                let angle = y?.atan2(x?);
                // A direction is the same after a full turn.
                let turns = told.map_or(0.0, |told| ((told - angle) / TAU).round());
                Some(angle + turns * TAU)
            }
            Ask::Value { formula, with, .. } => {
                self.formula(seen, &component(formula, answer), with, &[])
            }
            _ if self.is_of_motion(question) => {
                let found = follow::answer(self.scene, &seen.followed, question, &seen.point);
                found.ok()?.component(answer.axis())
            }
            _ => None,
        }?;
        let size = seen.units.size(&answer.dimension);
        Some(match told {
            Some(told) => Held::Same([told, found], size),
            None => Held::Unseen,
        })
    }

    /// Whether an answer for the turn of any number is what comes of it, turn after turn, in each of the first ones.
    fn repeats(&self, seen: &Seen, question: &Question, number: &Symbol, answer: &Answer) -> Held {
        let mut point = seen.point.clone();
        for turn in 1..=TURNS {
            point.values.insert(number.clone(), f64::from(turn));
            let told = answer
                .formula()
                .and_then(|formula| formula.evaluate(&point));
            let found = follow::of_a_turn(self.scene, &seen.followed, &question.ask, &point);
            let (Some(told), Ok(OfTurn { value, rounding })) = (told, found) else {
                return Held::Unseen;
            };
            let gap = (told - value).abs();
            if gap.is_nan() || gap > NOISE * told.abs().max(value.abs()) + rounding {
                let found = value;
                let apart = format!("in turn {turn} it is {told:.9} here and {found:.9} there");
                return Held::So(false, apart);
            }
        }
        Held::So(true, String::new())
    }

    /// Whether both sides of an identity are the same number, or those of an inequality stand as told.
    fn shows(
        &self,
        seen: &Seen,
        (left, relation, right): (&Expr, Relation, &Expr),
        with: &[(Symbol, Expr)],
    ) -> Held {
        let sides = [left, right];
        let [left, right] = sides.map(|side| self.formula(seen, side, with, &[]));
        let (Some(left), Some(right)) = (left, right) else {
            return Held::Unseen;
        };
        // Where both are nothing, what is nothing of its kind tells what is small.
        let mut sizes = seen.point.clone();
        for question in sides.into_iter().flat_map(|side| self.needs(side)) {
            let size = seen.units.size(&question.ask.dimension());
            let names = ["", "_x", "_y"].map(|axis| format!("{}{axis}", question.name).into());
            sizes.values.extend(names.map(|name| (name, size)));
        }
        let terms = sides.into_iter().flat_map(Expr::terms);
        let terms = terms.filter_map(|term| term.evaluate(&sizes));
        let size = terms.fold(0.0f64, |size, term| size.max(term.abs()));
        let noise = CLOSE * size.max(left.abs()).max(right.abs());
        let stands = match relation {
            Relation::Less | Relation::LessEqual => left - right <= noise,
            Relation::Greater | Relation::GreaterEqual => right - left <= noise,
            _ => return Held::Same([left, right], size),
        };
        let otherwise = format!("the left side is {left:.9} and the right side {right:.9}");
        Held::So(stands, otherwise)
    }

    /// Whether the sides of a relation change places at the values told.
    fn tips(&self, seen: &Seen, question: &Question, answer: &Answer) -> Option<Held> {
        let Ask::Condition {
            parameter,
            left,
            relation: asked,
            right,
            with,
        } = &question.ask
        else {
            return None;
        };
        let own = Expr::symbol(parameter);
        let mut out = None;
        for (_, relation, value) in answer.range.iter().filter(|(of, ..)| *of == own) {
            let Some(at) = value.evaluate(&seen.point) else {
                out = out.or(Some(Held::Unseen));
                continue;
            };
            let mut needs = answer.needs.iter().filter(|(of, ..)| of == value);
            let fails = needs.any(|(_, e, _)| e.evaluate(&seen.point).is_none_or(|v| v < 0.0));
            if fails || !self.stays(seen, answer, parameter, at) {
                out = out.or(Some(Held::Unseen));
                continue;
            }
            let gap = left - right;
            let aside = self.aside(seen, parameter, at);
            // Beyond the end of a domain nothing is told.
            let is_out = |step: f64| !self.admits(seen, parameter, at + step);
            let ends = is_out(-aside) != is_out(aside);
            let sides = [-aside, 0.0, aside].map(|step| {
                if ends && step != 0.0 && is_out(step) {
                    return None;
                }
                let there = (parameter.clone(), at + step);
                self.formula(seen, &gap, with, &[there])
            });
            let Some(tips) = tips((*asked, *relation), &sides) else {
                out = out.or(Some(Held::Unseen));
                continue;
            };
            let shown = sides.map(|s| s.map_or(String::from("-"), |v| format!("{v:.3e}")));
            let shown = shown.join(", ");
            let how = format!("below, at and above it the sides differ by {shown}");
            if !matches!(out, Some(Held::So(false, _))) {
                out = Some(Held::So(tips, how));
            }
        }
        out
    }

    /// How far from a value of a parameter its sides are looked at: as far as both are admitted, where they are at all.
    fn aside(&self, seen: &Seen, parameter: &Symbol, at: f64) -> f64 {
        let far = ASIDE * self.scale(seen, parameter, at);
        let mut steps = (0..10).map(|halved| far * 0.5f64.powi(halved));
        let both = |step: &f64| {
            let mut sides = [at - step, at + step].into_iter();
            sides.all(|value| self.admits(seen, parameter, value))
        };
        steps.find(both).unwrap_or(far)
    }

    /// Names of the stages that a question needs: those of the motions it is about, and those before them.
    fn stages_of(&self, question: &Question) -> BTreeSet<&str> {
        let stages = &self.scene.stages;
        let about = question.ask.formulas().into_iter();
        let about = about.flat_map(|of| self.needs(of)).chain([question]);
        let at = about.filter_map(|q| q.stage);
        let before = at.flat_map(|at| successors(Some(at), |i| stages[*i].from));
        before.map(|i| stages[i].name.as_str()).collect()
    }

    /// Whether an answer is about what happens at a point, in the stages that its question uses.
    fn happens(
        &self,
        seen: &Seen,
        uses: &BTreeSet<&str>,
        question: &Question,
        answer: &Answer,
    ) -> bool {
        let is_used = |told: &StageTold| uses.contains(told.placed.name.as_str());
        let goes = |w: usize| {
            let mut outcome = self.worlds[w].outcome.iter();
            outcome.all(|(i, k)| !is_used(&self.stages[*i]) || seen.way.get(i) == Some(k))
        };
        match answer.told {
            // A threshold of friction is asked of the impact, whatever its contact does.
            Some((stage, _)) if matches!(question.ask, Ask::Friction { .. }) => {
                seen.way.contains_key(&stage)
            }
            Some((stage, case)) => seen.way.get(&stage) == Some(&case),
            None if answer.worlds.is_empty() => (0..self.worlds.len()).any(goes),
            None => answer.worlds.iter().any(|w| goes(*w)),
        }
    }

    /// Whether the scene still goes the way of an answer where a parameter has another value.
    fn stays(&self, seen: &Seen, answer: &Answer, parameter: &Symbol, value: f64) -> bool {
        let there = moved(&seen.point, &[(parameter.clone(), value)]);
        let is_so = |w: &usize| {
            let mut given = self.worlds[*w].given.iter();
            given.all(|(_, e)| e.evaluate(&there).is_none_or(|v| v >= 0.0))
        };
        answer.worlds.is_empty() || answer.worlds.iter().any(is_so)
    }

    /// Whether bodies pass through each other nowhere where a parameter has another value, as far as the scene is followed there.
    fn gets_there(&self, seen: &Seen, parameter: &Symbol, value: f64) -> bool {
        let there = moved(&seen.point, &[(parameter.clone(), value)]);
        let followed = follow::follow(self.scene, &there);
        followed.is_ok_and(|followed| {
            let mut stages = followed.stages.iter().flatten();
            stages.all(|passed| passed.passing.is_empty())
        })
    }

    /// Whether what a contact with friction does changes at a value of its coefficient as told; `None` where it was not seen.
    fn turns(
        &self,
        seen: &Seen,
        question: &Question,
        (contact, event): (usize, FrictionEvent),
        answer: &Answer,
    ) -> Option<Held> {
        let at = answer.formula()?;
        let turns = || {
            let at = at.evaluate(&seen.point)?;
            follow::tips(
                self.scene,
                question.stage?,
                (contact, event),
                at,
                &seen.point,
            )
        };
        let otherwise = || String::from("the contact does something else beside it");
        Some(turns().map_or(Held::Unseen, |turns| Held::So(turns, otherwise())))
    }

    /// Whether a formula has the value told where it is told to be largest or least, and is nowhere larger or less.
    fn is_best(
        &self,
        seen: &Seen,
        (which, of, over): (Extremum, &Expr, &[Symbol]),
        answer: &Answer,
    ) -> Option<Held> {
        let told = answer.formula()?;
        let fails =
            |(_, e, _): &(Expr, Expr, bool)| e.evaluate(&seen.point).is_none_or(|v| v < 0.0);
        if answer.needs.iter().any(fails) {
            return Some(Held::Unseen);
        }
        let same = |a: &&Answer| a.question == answer.question && a.worlds == answer.worlds;
        let place = self
            .answers
            .iter()
            .filter(same)
            .flat_map(|a| &a.range)
            .next();
        let Some((combination, _, place)) = place else {
            // No parameter plays a part.
            let found = self.formula(seen, of, &[], &[]);
            let values = told.evaluate(&seen.point).zip(found);
            let size = seen.units.size(&answer.dimension);
            return values.map(|(told, found)| Held::Same([told, found], size));
        };
        let of_at = |values: &[(Symbol, f64)]| self.formula(seen, of, &[], values);
        let there = || {
            let symbol = over.iter().find(|p| combination.symbols().contains(*p))?;
            let here = seen.point.values.get(symbol)?;
            let at = place.evaluate(&seen.point)?;
            // A combination of two parameters is proportional to the first of them.
            let at = match combination.as_symbol() {
                Some(_) => at,
                None => here * at / combination.evaluate(&seen.point)?,
            };
            let best = of_at(&[(symbol.clone(), at)])?;
            Some((symbol, at, best))
        };
        let Some((symbol, at, best)) = there() else {
            return Some(Held::Unseen);
        };
        let scale = self.scale(seen, symbol, at);
        let mut others = vec![at - ASIDE * scale, at + ASIDE * scale];
        let names = [symbol.clone()].into_iter().collect();
        let far = points_of(names, &self.scene.domains, OTHERS);
        others.extend(far.filter_map(|p| p.values.get(symbol).copied()));
        // Elsewhere the scene may go another way through its cases, where something else is best, or not get there.
        others.retain(|value| {
            self.admits(seen, symbol, *value)
                && self.stays(seen, answer, symbol, *value)
                && self.gets_there(seen, symbol, *value)
        });
        let beyond = |other: f64, best: f64| {
            let more = match which {
                Extremum::Largest => other - best,
                Extremum::Least => best - other,
            };
            more > NOISE * best.abs()
        };
        for value in others {
            let other = of_at(&[(symbol.clone(), value)]);
            if let Some(other) = other.filter(|o| beyond(*o, best)) {
                let how = format!(
                    "with {symbol} = {value:.6} it is {other:.9}, at the place told {best:.9}"
                );
                return Some(Held::So(false, how));
            }
        }
        if without_case(&answer.name) != answer.question {
            return Some(Held::So(true, String::new()));
        }
        let told = told.evaluate(&moved(&seen.point, &[(symbol.clone(), at)]));
        let size = seen.units.size(&answer.dimension);
        Some(told.map_or(Held::Unseen, |told| Held::Same([told, best], size)))
    }

    /// Whether a formula comes closer to what stands for it, the closer the parameter comes to its value.
    fn nears(&self, seen: &Seen, of: &Expr, answer: &Answer) -> Option<Held> {
        let [near] = answer.near.as_slice() else {
            return None;
        };
        let of = component(of, answer);
        let gap = |distance: f64| {
            let here = seen.point.values.get(&near.parameter)?.abs();
            let value = match &near.to {
                // Of turns whole numbers are followed, and few.
                None if self.counts_turns(&near.parameter) => {
                    FAR * (distance.ln() / CLOSER[0].ln()).exp2().round()
                }
                None => here / distance,
                Some(to) => {
                    let to = to.evaluate(&seen.point)?;
                    let aside = distance * self.scale(seen, &near.parameter, to);
                    let mut sides = [to + aside, to - aside].into_iter();
                    sides.find(|value| self.admits(seen, &near.parameter, *value))?
                }
            };
            let there = (near.parameter.clone(), value);
            let told = near
                .right
                .evaluate(&moved(&seen.point, std::slice::from_ref(&there)))?;
            let found = self.formula(seen, &of, &[], &[there])?;
            Some(((found - told).abs(), found.abs().max(told.abs())))
        };
        let step = CLOSER[usize::from(near.order > 0)];
        let gaps: Vec<(f64, f64)> = (1..=3).filter_map(|k| gap(step.powi(k))).collect();
        // Far out something else may decide; what comes as close as rounding shows no more.
        let closer = step.powi(i32::try_from(near.order).unwrap_or(i32::MAX));
        let steps = gaps.windows(2).map(|pair| (pair[0].0, pair[1]));
        let mut nears = steps.map(|(far, (close, size))| {
            let limit = NOISE * size;
            close <= limit || close <= 0.5 * closer * far
        });
        if gaps.len() < 2 {
            return Some(Held::Unseen);
        }
        let gaps: Vec<String> = gaps.iter().map(|(gap, _)| format!("{gap:.3e}")).collect();
        let how = format!("closer and closer by it is apart by {}", gaps.join(", "));
        Some(Held::So(nears.any(|nears| nears), how))
    }

    /// Whether a parameter is the number of a turn.
    fn counts_turns(&self, name: &Symbol) -> bool {
        let mut asks = self.scene.questions.iter().map(|q| &q.ask);
        asks.any(|ask| matches!(ask, Ask::Turn { number, .. } if number == name))
    }
}

/// A formula, or of a vector the component that is told.
fn component(formula: &Expr, answer: &Answer) -> Expr {
    match (answer.axis(), formula.as_symbol()) {
        (Some(axis), Some(vector)) => Expr::symbol(&format!("{vector}_{}", ["x", "y"][axis])),
        _ => formula.clone(),
    }
}

/// Whether a relation that is asked for changes at a value as told, from the gap between its sides below, at and above it; `None`
/// where too little of it was followed.
fn tips((asked, told): (Relation, Relation), gaps: &[Option<f64>; 3]) -> Option<bool> {
    let [below, on, above] = *gaps;
    if below.is_some() != above.is_some() {
        // A motion that gets to its end on one side only.
        let gap = below.or(above)?;
        let holds = if asked.is_below() {
            gap <= 0.0
        } else {
            gap >= 0.0
        };
        let is_told = told.is_below() == below.is_some();
        return Some(told == Relation::Equal || holds == is_told);
    }
    if told == Relation::Equal {
        // At the value the sides meet, and beside it they do not.
        let beside = below.or(above)?.abs();
        return Some(on?.abs() <= 0.1 * beside);
    }
    match (below, above) {
        // Where a support comes free, its impulse stays zero beyond.
        (Some(a), Some(b)) => Some(a * b <= 0.0 && a != b),
        _ => None,
    }
}
