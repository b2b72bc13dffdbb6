//! Several outcomes of one impact: what a case shares with one before it is named there and not told again, and a case with
//! the results of one before it is not worked out again.

use std::collections::BTreeMap;

use crate::answer::Form;
use crate::derive::Derivation;
use crate::expr::{Expr, Symbol, Vector, minus};
use crate::laws::Unknown;
use crate::scene::{Ask, ContactLaw, Decided, Question, Scene};
use crate::solution::neat::tidied;
use crate::solution::words::{self, fill, say};
use crate::solution::{Claim, Detail, Inline, Line, Math, Part, Section, Writer, sentence};
use crate::story::{Case, State, Told};

/// The number of an earlier case whose results, as they are or with the opposite sign of a coefficient of friction, are those
/// of a later one.
pub(super) struct Again {
    pub case: usize,
    pub opposite: Option<Symbol>,
}

impl Writer<'_> {
    /// An impact whose equations stand in an earlier stage: their results, and what follows from them. Where the bodies come
    /// otherwise than there, `come` tells how, and all that the equations determine is shown.
    pub(super) fn in_earlier(&mut self, lead: &str, come: Vec<Vec<Math>>) {
        self.say(lead);
        let anew = !come.is_empty() && self.detail() != Detail::Brief;
        if anew {
            for math in come {
                self.show(math, None);
            }
            self.say("They give");
        }
        let questions: Vec<&Question> = self.scene.asked_of_impact().collect();
        let renamed: Vec<&Question> = questions
            .iter()
            .copied()
            .filter(|q| self.is_renamed(q))
            .collect();
        let asked = self.d.blocks.iter().filter(|b| b.asked_by.is_some());
        for (u, value) in asked.flat_map(|b| b.unknowns.iter().zip(self.d.solution(b))) {
            let name = self.d.names.plain(*u);
            let symbol = Expr::symbol(name);
            let is_zero = value.is_zero();
            self.zero.extend(is_zero.then_some(*u));
            let math = words::related(&symbol, "=", &value);
            let id = self.step(Vec::new(), vec![Claim::new(symbol, value)], lead);
            if self.d.answers.iter().any(|a| a.name == name) {
                self.told.insert(Symbol::from(name));
                let step = Some(id);
                self.push(Part::Result(vec![Line { math, step }]));
            } else if anew && !is_zero && !renamed.iter().any(|q| is_along(q, *u)) {
                self.show(math, Some(id));
            }
        }
        for question in questions {
            if self.is_derived(question) {
                if !renamed.iter().any(|q| q.name == question.name) {
                    let heading = self.heading(question);
                    self.section(heading);
                }
                self.derived(question);
            }
        }
    }

    /// A case whose results can be read off an earlier one; `rubs` is what its rough contact does.
    pub(super) fn again(&mut self, rubs: &str, again: &Again) {
        let Some(name) = &again.opposite else {
            let words = match rubs.is_empty() {
                true => format!("The results are those of case {}.", again.case),
                false => format!("{rubs}, and the results are those of case {}.", again.case),
            };
            let words = sentence::called(self.scene, &words);
            return self.text(vec![say(words)]);
        };
        let mu = Expr::symbol(name);
        let case = say(again.case.to_string());
        self.text(fill(
            "Friction acts the other way: the results are those of case {} with {} in place of {}.",
            [case, words::formula(&-&mu), words::formula(&mu)],
        ));
        self.boxed();
    }
}

/// Whether a question asks for this component of a velocity.
fn is_along(question: &Question, unknown: Unknown) -> bool {
    match (&question.ask, unknown) {
        (
            Ask::Velocity {
                body,
                along: Some(d),
                ..
            },
            Unknown::Velocity(b, axis),
        ) => *body == b && !d[axis].is_zero(),
        _ => false,
    }
}

/// The earlier stage, and its case, into which the bodies came with the same motion as into this one, and left with the same.
pub(super) fn in_earlier(told: &Told, [i, k]: [usize; 2]) -> Option<[usize; 2]> {
    let moves = |case: &Case| {
        let all = case.derivation.motion.iter();
        let all = all.filter(|(u, _)| !u.is_impulse());
        all.map(|(u, e)| (*u, e.clone())).collect::<Vec<_>>()
    };
    let here = &told.stages[i];
    let own = moves(&here.cases[k]);
    let begins = |s: &State| {
        (
            s.center.clone(),
            s.angle.clone(),
            s.velocity.clone(),
            s.spin.clone(),
        )
    };
    (0..i).find_map(|j| {
        let there = &told.stages[j];
        let mut cases = there.cases.iter();
        let case =
            cases.position(|case| moves(case) == own && case.handed == here.cases[k].handed)?;
        (begins(&there.before) == begins(&here.before)).then_some([j, case])
    })
}

/// Least number of equations that are not written again for bodies that come with another motion.
const MANY: usize = 3;

/// Whether the equations of the second impact are those of the first, but for the motion with which the bodies come.
pub(super) fn same_equations(first: (&Scene, &Derivation), second: (&Scene, &Derivation)) -> bool {
    let asked = |d: &'_ Derivation| {
        let asked = d.blocks.iter().filter(|b| b.asked_by.is_some());
        let all = asked.flat_map(|b| b.equations.clone());
        all.map(|e| (e.law, e.terms)).collect::<Vec<_>>()
    };
    let joints = |scene: &Scene| {
        let from =
            |at: &Vector, b: usize| minus(at, &scene.bodies[b].center).map(|x| tidied(scene, &x));
        let moving = |bodies: [usize; 2]| {
            let moving = bodies.into_iter().filter(|b| !scene.bodies[*b].is_fixed());
            moving.collect::<Vec<_>>()
        };
        let contacts = scene.contacts.iter().map(|c| {
            let law = match &c.law {
                ContactLaw::Decided(decided) => ContactLaw::Friction(Box::new(decided.law.clone())),
                law => law.clone(),
            };
            let arms: Vec<_> = moving(c.bodies).iter().map(|b| from(&c.at, *b)).collect();
            (c.bodies, arms, c.normal.clone(), Some(law))
        });
        let hinges = scene.hinges.iter().map(|h| {
            let arms = moving(h.bodies).iter().map(|b| from(&h.at, *b)).collect();
            (h.bodies, arms, None, None)
        });
        contacts.chain(hinges).collect::<Vec<_>>()
    };
    let is_plain = |scene: &Scene| scene.blows.is_empty() && scene.after.is_empty();
    let modes = [first.0, second.0].map(crate::solution::decided);
    let [there, here] = [first.1, second.1].map(asked);
    here.len() >= MANY
        && here.iter().all(|e| there.contains(e))
        && modes[0] == modes[1]
        && is_plain(first.0)
        && is_plain(second.0)
        && joints(first.0) == joints(second.0)
}

/// How the bodies come into the second of two impacts, where that is otherwise than into the first.
pub(super) fn come(first: &Scene, second: &Scene) -> Vec<Vec<Math>> {
    let mut out = Vec::new();
    let bodies = first.bodies.iter().zip(&second.bodies).enumerate();
    for (b, (there, here)) in bodies.filter(|(b, _)| second.takes_part(*b)) {
        if there.velocity != here.velocity {
            let v = words::vector("v", &words::center(second, b), "-");
            out.push(vec![v, Math::Op("="), here.velocity.clone().into()]);
        }
        if there.spin != here.spin {
            let omega = words::spin(second, b, "-");
            out.push(vec![omega, Math::Op("="), Math::Along(here.spin.clone())]);
        }
    }
    out
}

/// The first case before one, by index, that has its results already.
pub(super) fn again(scene: &Scene, cases: &[Case], k: usize) -> Option<Again> {
    let own = results(&cases[k]);
    if own.is_empty() {
        return None;
    }
    let (earlier, own_law) = (&cases[..k], decided(&cases[k]));
    if let Some(j) = earlier.iter().position(|case| results(case) == own) {
        return Some(Again {
            case: j + 1,
            opposite: None,
        });
    }
    let name = own_law?.law.mu.as_symbol()?;
    let opposite = BTreeMap::from([(name.clone(), -Expr::symbol(name))]);
    let turned = |(a, e): (String, Expr)| (a, tidied(scene, &e.substitute(&opposite)));
    let turned: Vec<(String, Expr)> = own.into_iter().map(turned).collect();
    let is_opposite = |case: &Case| {
        let same_mode = decided(case).map(|d| d.mode) == own_law.map(|d| d.mode);
        let tidy = |(a, e): (String, Expr)| (a, tidied(scene, &e));
        same_mode
            && results(case)
                .into_iter()
                .map(tidy)
                .eq(turned.iter().cloned())
    };
    earlier.iter().position(is_opposite).map(|j| Again {
        case: j + 1,
        opposite: Some(name.clone()),
    })
}

/// What is asked of a case, by name.
fn results(case: &Case) -> Vec<(String, Expr)> {
    let (_, derivation) = case.asked(&[]);
    let all = derivation.answers.into_iter();
    all.filter_map(|a| match a.form {
        Form::Value { closed, .. } => Some((a.name, closed)),
        _ => None,
    })
    .collect()
}

fn decided(case: &Case) -> Option<&Decided> {
    case.scene.decided().map(|(_, decided)| decided).next()
}

/// Equations that a case tells, with the sentence that leads to them.
pub(super) struct Shared {
    case: usize,
    lead: Vec<Inline>,
    lines: Vec<Vec<Math>>,
}

/// Points at an earlier case where this one, the sections given, tells the same equations for the same reason; notes the
/// others for the cases to come.
pub(super) fn share(known: &mut Vec<Shared>, case: usize, sections: &mut [Section]) {
    let mut fresh = Vec::new();
    for section in sections {
        let mut p = 0;
        while p + 1 < section.parts.len() {
            let told = equations(&section.parts[p], &section.parts[p + 1]);
            p += 1;
            let Some((lead, lines)) = told else {
                continue;
            };
            let same = |s: &&Shared| s.lead == lead && s.lines == lines;
            let Some(earlier) = known.iter().find(same) else {
                fresh.push(Shared { case, lead, lines });
                continue;
            };
            let Some(Inline::Text(words)) = lead.first() else {
                continue;
            };
            let first = words.split(". ").next().unwrap_or(words);
            let first = first.trim_end_matches(['.', ':', ',']);
            let comma = if first.ends_with(" are") { "" } else { "," };
            let there = format!("{comma} as in case {}.", earlier.case);
            let text = match section.parts[..p - 1].last() {
                Some(Part::Text(before)) => joined(before, first, &there),
                _ => None,
            };
            section.parts.remove(p);
            match text {
                Some(text) => {
                    section.parts.remove(p - 1);
                    p -= 1;
                    section.parts[p - 1] = Part::Text(vec![say(text)]);
                }
                None => section.parts[p - 1] = Part::Text(vec![say(format!("{first}{there}"))]),
            }
        }
    }
    known.append(&mut fresh);
}

/// Two laws of an earlier case that differ in their last word, such as a direction, in one sentence: the one that points there
/// already, and the next.
fn joined(before: &[Inline], next: &str, there: &str) -> Option<String> {
    let [Inline::Text(words)] = before else {
        return None;
    };
    let first = words.strip_suffix(there)?;
    let (same, last) = next.rsplit_once(' ')?;
    let rest = first.strip_prefix(same)?.strip_prefix(' ')?;
    let is_row = rest.split(" and ").all(|word| !word.contains(' '));
    is_row.then(|| format!("{first} and {last}{there}"))
}

/// A law in words and the equations it gives; `None` for anything else, such as a solution of equations.
fn equations(lead: &Part, lines: &Part) -> Option<(Vec<Inline>, Vec<Vec<Math>>)> {
    let (Part::Text(text), Part::Display(lines)) = (lead, lines) else {
        return None;
    };
    let Some(Inline::Text(first)) = text.first() else {
        return None;
    };
    // Where a formula cuts the first sentence, it cannot be told by its beginning.
    let ends = |piece: &Inline| matches!(piece, Inline::Text(next) if next.starts_with(". "));
    let is_whole = text.len() == 1 || first.contains(". ") || ends(&text[1]);
    let is_result = first.starts_with("With") || first.starts_with("Solving");
    let math = |line: &Line| line.math.clone();
    (is_whole && !is_result).then(|| (text.clone(), lines.iter().map(math).collect()))
}
