//! What a worked solution says of a quantity in words: `The angular velocity is 3v/2l`, `energy lost = …`, `Answer: …`.
//!
//! In: the lines, with names for words as far as they have any. Out: the lines with the name of what is asked in its place.

use super::Desk;
use super::text::{relates, without_remark};
use super::wording::VERBS;
use crate::expr::{Expr, Symbol};
use crate::formula;
use crate::scene::{Ask, Body, EnergyWhen, Question};

/// Words that leave open what is spoken of.
const FILLERS: &str = "a after amount and answer collision common final finally find get hence hit immediately impact in \
    is it its just kinetic linear magnitude mechanical of our required result resulting so that the then therefore this thus \
    total we which";

/// The words before what a line says, and what it says; `Answer: the speed is …` says it behind two signs.
fn parted(line: &str) -> Option<(Vec<String>, &str)> {
    let (_, behind) = line.split_once(':').unwrap_or_default();
    cut(behind).or_else(|| cut(line))
}

fn cut(line: &str) -> Option<(Vec<String>, &str)> {
    let (at, sign) = (VERBS.iter().chain(&["=", ":"]))
        .filter_map(|s| Some((line.find(s)?, *s)))
        .min_by_key(|(at, s)| (*at, std::cmp::Reverse(s.len())))?;
    let left = line[..at].trim_matches([' ', '$']);
    let mut right = line[at + sign.len()..].trim();
    let plain = |c: char| c.is_alphanumeric() || " .,'-_∴".contains(c);
    if left.is_empty() || right.is_empty() || !left.chars().all(plain) {
        return None;
    }
    let words = left.split([' ', '-']).map(|word| {
        let word = word.trim_matches(['.', ',', '∴']);
        word.to_lowercase()
    });
    right = right.trim_start_matches(['=', ' ', '$']);
    for lead in ["therefore ", "thus ", "hence ", "then "] {
        right = right.strip_prefix(lead).unwrap_or(right);
    }
    Some((words.filter(|word| !word.is_empty()).collect(), right))
}

/// Whether words speak of what is asked, and of nothing else.
fn speaks_of(words: &[String], question: &Question, names: &[String], lone: bool) -> bool {
    let has = |any: &str| words.iter().any(|w| formula::among(any, w));
    let (kind, fits) = match &question.ask {
        Ask::Spin { .. } => (
            "angular rotational rate rotation speed velocity spin",
            has("spin") || has("angular rotational rotation") && has("speed velocity rate"),
        ),
        Ask::Velocity { .. } => ("speed velocity", has("speed velocity")),
        Ask::Value { polar: Some(_), .. } => ("direction angle", has("direction angle")),
        Ask::Value { meaning, .. } if meaning.contains("speed") => ("speed", has("speed")),
        Ask::Energy {
            when: EnergyWhen::Lost,
            ..
        } => (
            "energy ke heat lost loss dissipated generated e_lost ke_lost",
            has("lost loss dissipated") && has("energy ke") || has("heat e_lost ke_lost"),
        ),
        Ask::Impulse { .. } => ("impulse on", has("impulse")),
        Ask::Tension { .. } => ("tension string", has("tension")),
        Ask::Acceleration { .. } => ("acceleration", has("acceleration")),
        Ask::Time => ("time taken", has("time")),
        Ask::Distance => ("distance moved travelled traveled", has("distance")),
        _ => ("", false),
    };
    let known = |word: &String| {
        let listed = |list: &str| formula::among(list, word);
        listed(FILLERS) || listed(kind) || names.contains(word)
    };
    (fits || lone && has("answer result")) && words.iter().all(known)
}

impl Desk<'_> {
    /// Lines in which a quantity that no line has by its name has it where the last line speaks of it in words.
    pub(super) fn with_said(&self, lines: Vec<String>) -> Vec<String> {
        let mut lines = lines;
        let questions: Vec<&Question> = self.sheet.answered().collect();
        let scene = &self.sheet.scene;
        let text = lines.join("\n");
        let sides = super::names::left_sides(&text);
        let solved: Vec<&Symbol> = sides.iter().filter_map(Expr::as_symbol).collect();
        let open: Vec<&Question> = questions
            .iter()
            .copied()
            .filter(|q| self.closed.contains_key(q.name.as_str()))
            .filter(|q| solved.iter().all(|name| q.part(name).is_none()))
            .collect();
        let mut told = vec![false; open.len()];
        // A claim at the end is an answer, right or wrong; words on the way may be about anything else.
        let mut at_end = true;
        for line in lines.iter_mut().rev() {
            let Some((words, right)) = parted(line) else {
                at_end &= !relates(line);
                continue;
            };
            let spoken = |q: &&Question| {
                let names = names(&scene.bodies, &q.ask);
                speaks_of(&words, q, &names, questions.len() == 1)
            };
            if relates(right) {
                let named = questions.iter().any(spoken);
                at_end &= named;
                if named && line.contains(" is ") {
                    *line = right.to_string();
                }
                continue;
            }
            let meant: Vec<&&Question> = questions.iter().filter(|q| spoken(q)).collect();
            let [meant] = meant[..] else {
                at_end &= !relates(line);
                continue;
            };
            let Some(at) = open.iter().position(|q| q.name == meant.name) else {
                continue;
            };
            let right = without_remark(right).trim_end_matches(['.', '$', ' ']);
            let Ok(reading) = formula::read(right, &self.symbols(right)) else {
                continue;
            };
            let is_so = || {
                let value = self.closed.get(meant.name.as_str());
                let pair = reading.expr().zip(value);
                pair.is_some_and(|(said, value)| self.is_zero(&(said - value)))
            };
            if !told[at] && (at_end || is_so()) {
                told[at] = true;
                *line = format!("{} = {right}", meant.name);
            }
        }
        lines
    }
}

/// The words that name the body and the point of a question.
fn names(bodies: &[Body], ask: &Ask) -> Vec<String> {
    let (body, point) = match ask {
        Ask::Velocity { body, point, .. } => (*body, point.as_ref().map(|(name, _)| name)),
        Ask::Spin { body, .. }
        | Ask::Impulse { on: body, .. }
        | Ask::Acceleration { body, .. }
        | Ask::Tension { body } => (*body, None),
        _ => return Vec::new(),
    };
    let all = [Some(&bodies[body].name), point];
    let words = all.into_iter().flatten().flat_map(|name| name.split(' '));
    words.map(str::to_lowercase).collect()
}
