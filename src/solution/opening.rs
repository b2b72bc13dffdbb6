//! What stands below the title: the statement, what the symbols mean, what moves just before, how a rough contact behaves; and
//! what the rest of the text shows to be needed there.

use std::collections::BTreeSet;

use super::neat::{alike, tidied};
use super::rough;
use super::words::{self, fill, say, set};
use super::{Claim, Detail, Inline, Line, Math, Part, Slot, Solution, Writer};
use crate::expr::{Expr, Symbol, dot, minus};
use crate::scene::{Body, Parameter, Scene, Shape};

/// How the sentence about the axes begins.
pub(super) const AXES: &str = "Let x point right and y up; counterclockwise is positive";
/// What leads to results in numbers.
pub(super) const NUMBERS: &str = "In numbers: ";

impl Solution {
    /// Explains the letter of a center of mass where the text uses it, and the values that numbers were found with, without data
    /// that are unused.
    pub(super) fn explain(&mut self, scene: &Scene, unused: &[Symbol]) {
        let moving: Vec<usize> = scene.moving().collect();
        let uses = |math: &[Math]| uses_center(math);
        let used = self
            .sections
            .iter()
            .flat_map(|s| &s.parts)
            .any(|p| match p {
                Part::Display(lines) | Part::Result(lines) => lines.iter().any(|l| uses(&l.math)),
                _ => false,
            });
        for part in self.sections.iter_mut().flat_map(|s| &mut s.parts) {
            let Part::Text(text) = part else {
                continue;
            };
            let is_axes = matches!(text.first(), Some(Inline::Text(t)) if t.starts_with(AXES));
            let is_plain = |e: &Expr| e.is_constant() && !e.is_zero();
            let in_numbers = moving.iter().any(|b| {
                let body = &scene.bodies[*b];
                is_plain(&body.mass) || body.velocity.iter().any(is_plain)
            });
            if is_axes && in_numbers {
                text.push(say(" Plain numbers are in SI units."));
            }
            if let ([b], true) = (moving.as_slice(), used && is_axes) {
                let whose = words::body(scene, *b);
                text.push(say(format!(" G is the center of mass of {whose}.")));
            }
        }
        self.values(scene, unused);
    }

    /// Where there are results in numbers, the values behind them stand with the meaning of each symbol.
    fn values(&mut self, scene: &Scene, unused: &[Symbol]) {
        let mut texts = Vec::new();
        for part in self.sections.iter_mut().flat_map(|s| &mut s.parts) {
            if let Part::Text(text) = part {
                texts.push(text);
            }
        }
        let begins = |text: &[Inline], with: &str| matches!(text.first(), Some(Inline::Text(t)) if t.starts_with(with));
        let numbers = texts.iter().position(|text| begins(text, NUMBERS));
        let here = texts.iter().position(|text| begins(text, "Here "));
        let Some(numbers) = numbers else {
            return;
        };
        let meant = here.zip(words::meant(scene, true));
        let is_told = |p: &Parameter| meant.is_some() && !p.meaning.is_empty();
        let (told, rest): (Vec<_>, Vec<_>) = scene.parameters.iter().partition(|p| is_told(p));
        let rest = rest.into_iter().filter(|p| !unused.contains(&p.name));
        let rest = rest.filter_map(|p| {
            let value = words::value(p)?;
            Some([words::formula(&Expr::symbol(&p.name)), say(" = "), value])
        });
        let in_brackets = told.iter().any(|p| p.value.is_some());
        let brackets = in_brackets.then(|| vec![say("the values in brackets")]);
        let all: Vec<Vec<Inline>> = brackets.into_iter().chain(rest.map(Vec::from)).collect();
        let mut lead = vec![say("With ")];
        for (i, one) in all.iter().enumerate() {
            let comma = if i + 1 == all.len() { " and " } else { ", " };
            lead.extend((i > 0).then(|| say(comma)));
            lead.extend(one.iter().cloned());
        }
        // Behind equations a comma would be one more of their row.
        let is_row = !in_brackets || all.len() > 1;
        lead.push(say(if is_row { ": " } else { ", " }));
        if !all.is_empty() {
            texts[numbers].splice(0..1, lead);
        }
        if let Some((here, meant)) = meant {
            *texts[here] = meant;
        }
    }
}

/// Symbols that count clockwise: answers asked for so, and the ω of a spin −ω.
fn clockwise(scene: &Scene) -> Vec<Symbol> {
    let told = |name: &Symbol| {
        let mut all = scene.parameters.iter();
        all.any(|p| p.name == *name && p.meaning.contains("clockwise"))
    };
    let asked = scene.questions.iter().filter(|q| q.ask.is_clockwise());
    let mut clockwise: Vec<Symbol> = asked.map(|q| Symbol::from(q.name.as_str())).collect();
    for body in &scene.bodies {
        let reversed = -&body.spin;
        clockwise.extend(reversed.as_symbol().filter(|name| !told(name)).cloned());
    }
    let mut seen = BTreeSet::new();
    clockwise.retain(|name| seen.insert(name.clone()));
    clockwise
}

/// What counts as positive, where some symbols count the other way: even a brief solution says so.
pub(super) fn turned_axes(scene: &Scene) -> Option<Vec<Inline>> {
    (!clockwise(scene).is_empty()).then(|| axes(scene, ""))
}

/// What counts as positive, and which symbols count the other way.
pub(super) fn axes(scene: &Scene, unless: &str) -> Vec<Inline> {
    let clockwise = clockwise(scene);
    if clockwise.is_empty() {
        return vec![say(format!("{AXES}{unless}."))];
    }
    let are = if clockwise.len() == 1 { "is" } else { "are" };
    let lead = vec![say(format!("{AXES}, but "))];
    let end = vec![say(format!(" {are} counted clockwise."))];
    [lead, words::symbols(&clockwise, " and "), end].concat()
}

/// Sets the names of the axes in sentences and headings as the symbols they are.
pub(super) fn set_axes(solution: &mut Solution) {
    for section in &mut solution.sections {
        let texts = section.parts.iter_mut().flat_map(|part| match part {
            Part::Text(text) => std::slice::from_mut(text),
            Part::List(items) => items.as_mut_slice(),
            _ => &mut [],
        });
        for text in texts.chain([&mut section.heading]) {
            *text = std::mem::take(text).into_iter().flat_map(axes_in).collect();
        }
    }
}

/// A piece of a sentence with `x` and `y`, where they are words, as formulas.
fn axes_in(piece: Inline) -> Vec<Inline> {
    let Inline::Text(text) = piece else {
        return vec![piece];
    };
    let (mut out, mut words) = (Vec::new(), String::new());
    // Behind a word they are the axes, behind a letter a formula of the author.
    let mut behind_word = true;
    for word in text.split_inclusive(' ') {
        let name = word.trim_end_matches([' ', ',', '.', ':', ';']);
        let is_axis = matches!(name, "x" | "y") && behind_word;
        behind_word = name.len() > 1 && name.chars().all(char::is_alphabetic);
        if is_axis {
            out.extend([
                say(std::mem::take(&mut words)),
                words::formula(&Expr::symbol(name)),
            ]);
            words.push_str(&word[name.len()..]);
        } else {
            words.push_str(word);
        }
    }
    out.push(say(words));
    out.retain(|piece| *piece != say(""));
    out
}

/// Where the center of mass of a body of several parts lies, and what its parts make of its moment of inertia.
pub(super) fn composites(solution: &mut Solution, scene: &Scene) {
    let by_parts = |(_, body): &(usize, &Body)| !body.inertia_given;
    for (b, body) in scene.bodies.iter().enumerate().filter(by_parts) {
        let Shape::Composite { parts } = &body.shape else {
            continue;
        };
        let c = words::center(scene, b);
        let terms = parts.iter().flat_map(|part| {
            let arm = minus(&part.center, &body.center);
            let own = match part.is_particle() {
                true => Expr::zero(),
                false => part.inertia.clone(),
            };
            [own, &part.mass * dot(&arm, &arm)].map(|e| tidied(scene, &e))
        });
        let raw = Expr::sum(terms);
        let whole = tidied(scene, &body.inertia);
        let claim = Claim::new(raw.clone(), whole.clone());
        let why = "moment of inertia of the parts about the common center of mass: I + m d²";
        let step = solution.step(Vec::new(), vec![claim], why);
        let place = body.center.each_ref().map(|e| tidied(scene, e));
        let there = match place.iter().all(Expr::is_zero) {
            true => say("the origin"),
            false => Inline::Math(vec![place.into()]),
        };
        solution.text(fill(
            "The parts of {} have their common center of mass at {}; each adds its own moment of inertia and its mass times the square of its distance from there:",
            [say(words::body(scene, b)), there],
        ));
        let mut math = set("{} =", [words::name("I", &c, "", false)]);
        if !alike(&raw, &whole) {
            math.extend(set("{} =", [raw.into()]));
        }
        math.push(whole.into());
        solution.push(Part::Display(vec![Line {
            math,
            step: Some(step),
        }]));
    }
}

/// Whether a formula names the center of mass G.
fn uses_center(math: &[Math]) -> bool {
    math.iter().any(|m| match m {
        Math::Name(name) => name.index.split(['/', ',']).any(|part| part == "G"),
        Math::Brackets(inner) => uses_center(inner),
        _ => false,
    })
}

impl Writer<'_> {
    /// What stands below the title: the figure before, and what is meant by the symbols.
    pub(super) fn opening(&mut self) {
        self.section(Vec::new());
        if !self.solution.statement.is_empty() {
            let statement = words::with_symbols(self.scene, &self.solution.statement);
            self.text(statement);
        }
        if let Some(text) = words::meant(self.scene, false) {
            self.text(text);
        }
        if self.detail() == Detail::Brief {
            turned_axes(self.scene)
                .into_iter()
                .for_each(|axes| self.text(axes));
            return self.given_after();
        }
        self.push(Part::Figure(Slot::Before));
        let mut text = String::new();
        let forces: Vec<String> = self.forces();
        if !forces.is_empty() {
            let one = forces.len() == 1 && !forces[0].starts_with("the weights ");
            text.push_str(&format!(
                " {} {} finite and {} no impulse.",
                words::capital(&words::listed(&forces)),
                if one { "is" } else { "are" },
                if one { "has" } else { "have" },
            ));
        }
        let mut lead = axes(self.scene, "");
        lead.push(say(text));
        self.text(lead);
        composites(&mut self.solution, self.scene);
        self.before();
        if let Some(law) = rough::law(self.scene) {
            self.text(law);
        }
        let decided: Vec<_> = self.scene.decided().collect();
        if let [(at, decided)] = decided.as_slice() {
            self.yields(*at, &[*decided], !decided.when.is_empty());
        }
        self.case();
        self.given_after();
    }

    /// What is given of the motion just after.
    pub(super) fn given_after(&mut self) {
        let given = self.d.given.iter();
        let given = given.map(|(unknown, value)| {
            let symbol = Expr::symbol(self.d.names.plain(*unknown));
            words::equation(&symbol, value)
        });
        let given = words::row(given, " and ");
        if given.is_empty() {
            return;
        }
        let lead = [say("It is given that ")];
        self.text(
            lead.into_iter()
                .chain(given)
                .chain([say(" just after.")])
                .collect(),
        );
    }

    /// The motion just before, where the scene has symbols for it that it does not explain.
    fn before(&mut self) {
        let explained = |s: &Symbol| {
            let mut all = self.scene.parameters.iter();
            all.any(|p| p.name == *s && !p.meaning.is_empty())
        };
        let mut text = vec![say("Just before, ")];
        for (b, body) in self.scene.bodies.iter().enumerate() {
            let all = body.velocity.iter().chain([&body.spin]);
            if body.is_fixed() || all.flat_map(Expr::symbols).all(|s| explained(&s)) {
                continue;
            }
            if text.len() > 1 {
                text.push(say("; "));
            }
            let c = words::center(self.scene, b);
            let v = [words::vector("v", &c, "-"), body.velocity.clone().into()];
            text.push(Inline::Math(set("{} = {}", v)));
            if !body.is_particle() && !body.spin.is_zero() {
                let w = [
                    words::spin(self.scene, b, "-"),
                    Math::Along(body.spin.clone()),
                ];
                text.extend(fill(" and {}", [Inline::Math(set("{} = {}", w))]));
            }
        }
        if text.len() > 1 {
            text.push(say("."));
            self.text(text);
        }
    }

    /// The finite forces of the scene, those of one name together.
    fn forces(&self) -> Vec<String> {
        let mut by_name: Vec<(&str, Vec<usize>)> = Vec::new();
        for force in &self.scene.forces {
            match by_name.iter_mut().find(|(n, _)| *n == force.name) {
                Some((_, bodies)) => bodies.push(force.body),
                None => by_name.push((&force.name, vec![force.body])),
            }
        }
        by_name
            .into_iter()
            .map(|(name, bodies)| {
                let article = if name.to_lowercase().starts_with("the ") {
                    ""
                } else {
                    "the "
                };
                // Whose weight it is needs to be said; other forces say it in their names.
                match (name, bodies.len()) {
                    ("weight", 1) => {
                        format!("the weight of {}", words::body(self.scene, bodies[0]))
                    }
                    ("weight", _) => {
                        format!("the weights of {}", words::bodies(self.scene, &bodies))
                    }
                    _ => format!("{article}{name}"),
                }
            })
            .collect()
    }
}
