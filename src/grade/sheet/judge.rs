//! Judges answers of a scene: formulas, numbers where the scene gives values, and what beliefs a wrong one shows.

use super::super::believed::{self, Written};
use super::super::relation::of_which;
use super::super::worked::worked;
use super::super::{
    Diagnosis, Grade, Key, Options, Proof, Strength, Tolerance, Verdict, cases, compare, fraction,
    judge_against, key_of, number, read,
};
use super::{Bound, Entry, Sheet, is_case, rows};
use crate::answer::Answer;
use crate::dimension;
use crate::expr::{Expr, Symbol, Vector, dot};
use crate::formula::{self, Content, Quantity, Reading, Relation};
use crate::scene::{Ask, EnergyWhen, Scene, without_case};
use num_traits::{One, Signed};

/// `ΔK = -…` as what is lost, where that is asked: a change is counted as a gain.
fn gained(ask: &Ask, answer: &str) -> Option<String> {
    let asked = matches!(ask, Ask::Energy { when, .. } if *when == EnergyWhen::Lost);
    let text = answer.trim_start_matches([' ', '$']);
    let (_, gain) = text.split_once('=').filter(|_| asked)?;
    let change = text.starts_with('Δ') || text.starts_with("\\Delta");
    let gain = gain.trim_matches([' ', '$']);
    let signs = ['+', '-', '−'];
    // A number keeps its unit beside it.
    let lone = gain
        .strip_prefix(['-', '−'])
        .filter(|rest| !rest.contains(signs));
    change.then(|| lone.map_or(format!("-({gain})"), str::to_string))
}

impl Sheet {
    /// Judges an answer for a quantity of the scene; a wrong one is held against the beliefs students have. Names of earlier
    /// answers stand for the right ones, which is told.
    /// Where the scene can go several ways an answer that is right in one of them is right given that it goes this way.
    /// An answer by the name of one of several cases is judged in that case.
    pub fn judge(&self, entry: &Entry, answer: &str, options: &Options) -> Grade {
        let named = answer.split_once('=').map(|(name, _)| name.trim());
        let case = named.filter(|name| is_case(name) && without_case(name) == entry.name);
        if let Some(case) = case.and_then(|name| self.entry(name).ok()) {
            return self.judge(&case, answer, options);
        }
        if let Some((way, other)) = self.way_of(entry) {
            let value = answer.split_once('=');
            let value = value.filter(|(name, _)| name.trim() == entry.name);
            let value = value.map_or(answer, |(_, value)| value);
            let mut grade = way.judge_one_way(&other, value, options);
            if grade.is_equivalent() {
                grade.assume(way.given.clone());
            }
            return grade;
        }
        if let Some(grade) = cases::of_scene(&entry.key, answer, options) {
            return grade;
        }
        let mut grade = self.judge_one_way(entry, answer, options);
        let others = self.otherwise.iter();
        let mut others = others.filter_map(|way| Some((way, way.entry(&entry.name).ok()?)));
        let same = |other: &Entry| other.key.reading.content == entry.key.reading.content;
        match grade.verdict {
            Verdict::Equivalent => {
                if !others.all(|(_, other)| same(&other)) {
                    grade.assumed.extend(self.given.iter().cloned());
                }
            }
            Verdict::Different | Verdict::Undecided => {
                let mut unseen = None;
                for (way, other) in others {
                    let mut right = way.judge_one_way(&other, answer, options);
                    if right.verdict == Verdict::Equivalent && way.has_points() {
                        right.assumed.extend(way.given.iter().cloned());
                        return right;
                    }
                    if right.verdict == Verdict::Equivalent {
                        let given = way.given.join(", ");
                        let words = format!("right where {given}, of which no point was found");
                        unseen = Some((right, words));
                        continue;
                    }
                    let is_open = grade.verdict == Verdict::Undecided;
                    if is_open && right.verdict == Verdict::Different && same(&other) {
                        return right;
                    }
                }
                if let Some((mut right, words)) = unseen {
                    right.verdict = Verdict::Undecided;
                    right.note = "UNDECIDED_POINT";
                    right.proof = Proof::of("none", words);
                    return right;
                }
            }
            Verdict::Invalid => {}
        }
        grade
    }

    /// The way in which a scene goes in one of several cases, and what is asked for there.
    fn way_of(&self, case: &Entry) -> Option<(&Sheet, Entry)> {
        let plain = Some(without_case(&case.name)).filter(|_| is_case(&case.name))?;
        let ways = std::iter::once(self).chain(&self.otherwise);
        let mut entries = ways.filter_map(|way| Some((way, way.entry(plain).ok()?)));
        entries.find(|(_, other)| other.key.reading.content == case.key.reading.content)
    }

    fn judge_one_way(&self, entry: &Entry, answer: &str, options: &Options) -> Grade {
        let grade = self.judge_with_earlier(entry, answer, options);
        if grade.verdict != Verdict::Different {
            return grade;
        }
        if let Some(lost) = gained(&entry.question.ask, answer) {
            let other = self.judge_with_earlier(entry, &lost, options);
            if other.verdict == Verdict::Equivalent {
                return other;
            }
        }
        let is_direction = matches!(entry.question.ask, Ask::Value { polar: Some(_), .. });
        for turn in TURNS.iter().filter(|_| is_direction) {
            let turned = format!("{answer}{turn}");
            let mut other = self.judge_with_earlier(entry, &turned, options);
            if other.verdict == Verdict::Equivalent {
                let words = "a direction is the same after a full turn";
                other.assumed.push(words.into());
                return other;
            }
        }
        // `mu²` for m u², where μ is given and u was asked before.
        let mut names = entry.key.readable.clone();
        let before = self.scene.questions.iter().map(|q| q.name.as_str());
        before
            .take_while(|name| *name != entry.question.name)
            .for_each(|name| names.declare(name));
        let Some(apart) = formula::letters_apart(answer, &names) else {
            return grade;
        };
        let other = self.judge_with_earlier(entry, &apart, options);
        if !other.is_equivalent() {
            return grade;
        }
        let message = format!("right when it is read as {apart}");
        other.reread(message, "write a space between the factors of a product")
    }

    /// A bound with what is granted of its parameter on the other side: `2√(g l) ≤ u < √(5 g l)`.
    fn beside_granted(&self, bound: &Bound) -> Option<Key> {
        let mut granted = self.granted(&bound.parameter).into_iter();
        let below = bound.relation.is_below();
        let opposite = |relation: Relation| relation.is_order() && relation.is_below() != below;
        let (relation, end) = granted.find(|(r, _)| opposite(*r) && bound.relation.is_order())?;
        let sides = [end, Expr::symbol(&bound.parameter), bound.value.clone()];
        let signs = vec![relation.turned(), bound.relation];
        let content = Content::Relations(sides.map(Content::Scalar).into(), signs);
        Some(key_of(content, &self.question()))
    }

    fn judge_with_earlier(&self, entry: &Entry, answer: &str, options: &Options) -> Grade {
        let Some((put_in, told)) = self.with_earlier(entry, answer) else {
            let grade = self.judge_in_given(entry, answer, options);
            // What cannot be read all the same is no fault of the earlier answers in it.
            return match grade.verdict {
                Verdict::Invalid => judge_against(&self.key_with_earlier(entry).0, answer, options),
                _ => self.by_its_name(entry, answer, grade),
            };
        };
        let mut grade = self.judge_in_given(entry, &put_in, options);
        grade.assumed.extend(told);
        self.by_its_name(entry, answer, grade)
    }

    /// The grade of a formula with its number behind it: that of the formula, and where it is right that of the number.
    fn judge_worked(&self, entry: &Entry, answer: &str, options: &Options) -> Option<Grade> {
        let reading = with_unit_last(&entry.key, answer, read::answer(&entry.key, answer).ok()?);
        let parts = worked(&entry.key, answer, &reading)?;
        let mut grade = self.judge_in_given(entry, parts.formula, options);
        if parts.is_broken(&mut grade) {
            return Some(grade);
        }
        match self.numeric(entry, &parts.reading, parts.number, options) {
            Some((mut number, _)) if number.verdict != Verdict::Equivalent => {
                let words = "the formula is right, and its number is not";
                let diagnosis = Diagnosis::new("NUMBER", words, "put the values in once more");
                number.diagnosis.insert(0, diagnosis);
                return Some(number);
            }
            Some(_) => {}
            None => parts.unjudged(&entry.key, &mut grade),
        }
        Some(grade)
    }

    fn judge_in_given(&self, entry: &Entry, answer: &str, options: &Options) -> Grade {
        if let Some(grade) = self.judge_worked(entry, answer, options) {
            return grade;
        }
        let spins = matches!(entry.question.ask, Ask::Spin { .. });
        // Turns in a second are no radians in it.
        let counted = answer.trim_end().strip_suffix("Hz").filter(|_| spins);
        let counted = counted.map(|number| format!("{number}rev/s"));
        let answer = counted.as_deref().unwrap_or(answer);
        let sensed = in_words(&entry.question.ask, entry.component, answer);
        let answer = sensed.as_deref().unwrap_or(answer);
        // `-v/l k` with the letter k for the direction out of the page.
        let axes = || {
            let names = entry.key.readable.clone().with_axes();
            formula::read(answer, &names).ok()
        };
        let along = (read::answer(&entry.key, answer).ok().or_else(axes))
            .and_then(|reading| about_z(&entry.question.ask, &reading));
        let answer = along.as_deref().unwrap_or(answer);
        let mut grade = judge_against(&entry.key, answer, options);
        let Ok(reading) = read::answer(&entry.key, answer) else {
            return grade;
        };
        if grade.note == "DIFF_DIMENSION"
            && let Some(measured) = measured_otherwise(&entry.key, answer, options)
        {
            return measured;
        }
        if let Some(grade) = self.of_other_shape(entry, &reading, answer, options) {
            return grade;
        }
        let numeric = self.numeric(entry, &reading, answer, options);
        let rounding = numeric.as_ref().and_then(|(_, room)| *room);
        if let Some((better, _)) = numeric {
            grade = better;
        }
        if grade.verdict != Verdict::Different || options.strength == Strength::Fast {
            return grade;
        }
        if self.is_of_impact(entry) && self.has_finite_force(&reading) {
            grade.note = "DIFF_BELIEF";
            let message = "a finite force, or the time the collision takes, enters: in a collision neither has an impulse";
            let hint = "which forces are large enough to matter in so short a time?";
            let found = Diagnosis::new("GRAVITY_KEPT", message, hint);
            grade.diagnosis.insert(0, found);
        }
        let Some(unit) = self.wrongly_counted(entry, answer, &grade, options) else {
            return grade;
        };
        let values = match reading.content.answer() {
            Content::Scalar(e) => vec![e * &unit],
            Content::Quantity(q) => vec![q.value.clone()],
            Content::Vector([x, y, z]) if z.is_zero() => vec![x.clone(), y.clone()],
            Content::Vector([x, y, z]) if x.is_zero() && y.is_zero() => vec![z.clone()],
            _ => return grade,
        };
        let given = |s: &Symbol| self.scene.parameter(s).is_some();
        let known = |e: &Expr| e.symbols().iter().all(given);
        if !values.iter().all(known) || values.iter().any(|e| e.size() > 2_000) {
            return grade;
        }
        let told = values.iter().any(|v| !v.is_constant());
        let (scene, ask) = self.impact(entry);
        let written = Written {
            scene,
            ask,
            component: entry.component,
            values,
            rounding,
        };
        let expected = match entry.key.reading.content {
            Content::Vector(_) => 2,
            _ => 1,
        };
        let (mut found, mut others) = believed::explain(&written, written.values.len() == expected);
        if let (true, Some(story)) = (found.is_empty(), &self.story) {
            let answers = self.derivation.answers.iter();
            let mine = |a: &&Answer| a.name == entry.name || a.question == entry.name;
            let names: Vec<String> = answers.filter(mine).map(|a| a.name.clone()).collect();
            let asked = (entry.question.name.as_str(), names.as_slice());
            found = story.explain(&entry.key, asked, &written.values, rounding);
        }
        // Which direction counts as positive is asked before any belief that only turns the sign.
        let turned = grade.diagnosis.iter().position(|d| d.code == "SIGN");
        let sign = turned.map(|at| grade.diagnosis.remove(at));
        if !found.is_empty() && sign.is_none() {
            grade.note = "DIFF_BELIEF";
        }
        if told && !others.iter().any(|d| d.code == "OTHER_QUANTITY") {
            let other = self.size_of_vector(entry, answer);
            others.extend(other.or_else(|| self.another_answer(entry, answer)));
        }
        slip_first(&mut found, &mut grade.diagnosis);
        let mut all: Vec<Diagnosis> = sign.into_iter().chain(found).collect();
        all.append(&mut others);
        all.append(&mut grade.diagnosis);
        grade.diagnosis = all;
        grade
    }

    /// What the unit is worth in which a wrong number without one counts, that of the scene; nothing where only the unit is missing.
    fn wrongly_counted(
        &self,
        entry: &Entry,
        answer: &str,
        grade: &Grade,
        options: &Options,
    ) -> Option<Expr> {
        let missing = (entry.key.question.dimension.as_ref())
            .filter(|_| grade.note == "DIFF_UNIT_MISSING")
            .map(|dimension| self.scene.system().counted_in(dimension));
        let Some((unit, text)) = missing else {
            return Some(Expr::one());
        };
        let measured = format!("{answer} {text}");
        let reading = read::answer(&entry.key, &measured).ok();
        let right = reading.and_then(|reading| self.numeric(entry, &reading, &measured, options));
        let is_right = right.is_some_and(|(grade, _)| grade.is_equivalent());
        (!is_right).then(|| unit.value())
    }

    /// A matrix whose rows stand in another order, or a relation for the bound that is asked.
    fn of_other_shape(
        &self,
        entry: &Entry,
        reading: &Reading,
        answer: &str,
        options: &Options,
    ) -> Option<Grade> {
        match (&entry.key.reading.content, &reading.content) {
            (Content::Matrix(expected), Content::Matrix(rows)) => {
                let ordered = rows::as_answered(expected, rows, &self.scene.domains)?;
                if ordered == *expected {
                    return None;
                }
                let key = key_of(Content::Matrix(ordered), &entry.key.question);
                let mut grade = judge_against(&key, answer, options);
                let words = "an equation may stand in any row, and be multiplied";
                grade.assumed.push(words.into());
                Some(grade)
            }
            (_, Content::Relations(said, signs)) => {
                let bound = self.bounds().find(|b| b.name == entry.name);
                let bound = bound.or_else(|| self.least(entry))?;
                let equation = signs.iter().all(|s| *s == Relation::Equal);
                if equation && !bound.is_in(said) {
                    return None;
                }
                let sides = [Expr::symbol(&bound.parameter), bound.value.clone()];
                let sides = sides.map(Content::Scalar).to_vec();
                let relation = match equation {
                    true => Relation::Equal,
                    false => bound.relation,
                };
                let content = Content::Relations(sides, vec![relation]);
                let key = key_of(content, &self.question());
                let grade = judge_against(&key, answer, options);
                if grade.verdict == Verdict::Different
                    && let Some(key) = self.beside_granted(&bound).filter(|_| signs.len() > 1)
                {
                    let other = judge_against(&key, answer, options);
                    return Some(if other.verdict == Verdict::Equivalent {
                        other
                    } else {
                        grade
                    });
                }
                Some(grade)
            }
            _ => None,
        }
    }

    /// What a parameter has to be at least, or may be at most, where a value is asked by such a name: μ ≥ … for μ_min.
    fn least(&self, entry: &Entry) -> Option<Bound> {
        let value = entry.key.reading.content.expr()?;
        let (of, relation) = of_which(&entry.name)?;
        let is_free = self.scene.question(&of).is_none();
        is_free.then(|| Bound {
            name: entry.name.clone(),
            parameter: of,
            relation,
            value: value.clone(),
        })
    }

    /// Whether a question is of an impact, and not of a motion before or after it.
    fn is_of_impact(&self, entry: &Entry) -> bool {
        let of = |impact: &Scene| impact.question(&entry.question.name).is_some();
        self.story.is_none() || self.impacts.iter().any(of)
    }

    /// Whether gravity or a time enters that neither the scene nor an answer names.
    fn has_finite_force(&self, reading: &Reading) -> bool {
        let given = |s: &Symbol| {
            let answered = self.derivation.answers.iter().any(|a| *a.name == **s);
            answered || self.scene.parameter(s).is_some()
        };
        let symbols = reading.symbols();
        let mut finite = (symbols.iter()).filter(|s| matches!(&***s, "g" | "t" | "dt"));
        finite.any(|s| !given(s))
    }

    /// The size of the vector whose component is asked for.
    fn size_of_vector(&self, entry: &Entry, answer: &str) -> Option<Diagnosis> {
        entry.component?;
        let whole = self.entry(&entry.question.name).ok()?;
        let Content::Vector(vector) = &whole.key.reading.content else {
            return None;
        };
        let size = Content::Scalar(compare::size(vector));
        let key = key_of(size, &whole.key.question);
        let right = judge_against(&key, answer, &Options::default()).is_equivalent();
        let message = format!("this is the size of {}, not its component", whole.name);
        let hint = "along which direction is it asked for?";
        right.then(|| Diagnosis::new("OTHER_QUANTITY", message, hint))
    }

    /// The answer to another question that this is, of any stage.
    fn another_answer(&self, entry: &Entry, answer: &str) -> Option<Diagnosis> {
        let options = Options {
            strength: Strength::Fast,
            ..Options::default()
        };
        let others = self.answered().filter(|q| q.name != entry.question.name);
        let mut entries = others.filter_map(|q| self.entry(&q.name).ok());
        let is_it = |other: &Entry| {
            let grade = judge_against(&other.key, answer, &options);
            grade.verdict == Verdict::Equivalent
        };
        let other = entries.find(is_it)?;
        let message = format!("this is {}, the {}", other.name, other.words);
        let hint = "this is right for another quantity: what is asked for?";
        Some(Diagnosis::new("OTHER_QUANTITY", message, hint))
    }

    /// An answer in numbers, where the scene gives values: right when it is the exact value rounded to its own digits, three
    /// at least, or within the tolerance. Also how far it may be off for a belief to explain it.
    fn numeric(
        &self,
        entry: &Entry,
        reading: &Reading,
        answer: &str,
        options: &Options,
    ) -> Option<(Grade, Option<f64>)> {
        let values = self.scene.values();
        let all = values.len() == self.scene.parameters.len();
        let valued = |e: &Expr| match e.symbols() {
            symbols if symbols.is_empty() => all,
            symbols => symbols.iter().all(|s| values.contains_key(s)),
        };
        // `v_x = 1.57 m/s, v_y = 4 m/s`
        let in_components = matches!(entry.key.reading.content, Content::Vector(_))
            && matches!(reading.content, Content::Joined(..));
        let asked = |s: &Symbol| {
            let named = entry.key.question.asked.iter().any(|g| g.name == *s);
            let given = self.scene.parameter(s).is_some();
            named || in_components && !given && formula::along_axis(s).is_some()
        };
        let of_unit = match reading.symbols().iter().all(asked) {
            true => None,
            false => Some(number_with_unit(&entry.key, reading, answer)?),
        };
        if values.is_empty() {
            return None;
        }
        let closed = match &entry.key.reading.content {
            Content::Scalar(closed) if valued(closed) => closed,
            Content::Vector(closed) if closed.iter().all(valued) => {
                let exact = closed.each_ref().map(|e| e.substitute(&values));
                return Some((components(entry, exact, answer, options)?, None));
            }
            _ => return None,
        };
        let exact = closed.substitute(&values);
        let mut question = entry.key.question.clone();
        question.dimension = None;
        if of_unit.is_some() {
            question.symbols.clear();
        }
        let reading = of_unit.as_ref().unwrap_or(reading);
        let dimension = entry.key.question.dimension.as_ref();
        let content = match dimension.filter(|d| !d.is_none()) {
            Some(dimension) => {
                let (unit, unit_text) = self.scene.system().counted_in(dimension);
                Content::Quantity(Box::new(Quantity {
                    value: exact.clone(),
                    written: &exact * &unit.value().powi(-1),
                    unit,
                    unit_text,
                }))
            }
            None => Content::Scalar(exact.clone()),
        };
        let key = key_of(content, &question);
        let in_degrees = || digits_in_degrees(&key, answer);
        let digits = reading.literal.as_ref().map(|l| l.digits);
        let digits = digits.or_else(in_degrees).unwrap_or(40).min(40);
        let rounded = Tolerance::Significant(digits.max(3));
        let within = Options {
            tolerance: options.tolerance.clone().or(Some(rounded)),
            ..options.clone()
        };
        let mut grade = judge_against(&key, answer, options);
        if !grade.is_equivalent() {
            grade = judge_against(&key, answer, &within);
        }
        if grade.note == "EQUIV_TOLERANCE" && options.tolerance.is_none() {
            grade.note = "EQUIV_ROUNDED";
            grade.proof.words = format!("the exact value rounded to {digits} significant digits");
        }
        if of_unit.is_some() {
            let words = "letters behind the number are its unit, not symbols of the scene";
            grade.assumed.push(words.into());
        }
        // What has π in it has no last digit.
        let value = reading.content.answer().expr().and_then(fraction);
        let room = value.map(|value| {
            let half = number::half_unit(&value, digits.min(12));
            crate::expr::number::to_f64(&half) * 1.000_001
        });
        Some((grade, room))
    }
}

/// Puts a single slip that is right before two beliefs together, which explain less.
fn slip_first(found: &mut Vec<Diagnosis>, others: &mut Vec<Diagnosis>) {
    let slip = |d: &Diagnosis| matches!(d.code, "SYMBOL_SIGN" | "SIN_COS" | "EXCHANGED");
    if !found.is_empty()
        && found.iter().all(|d| d.code == "TWO_BELIEFS")
        && let Some(at) = others.iter().position(slip)
    {
        found.insert(0, others.remove(at));
    }
    // Which exponent a belief changes is not told besides.
    others.retain(|d| found.is_empty() || d.code != "POWER");
}

/// What makes a direction the same one.
const TURNS: [&str; 2] = [" - 2*pi", " + 2*pi"];

/// The digits of an angle in degrees, or of a rate, which is read as a multiple of π: `69.4°`, `69.4 deg`, `69.4°/s`.
fn digits_in_degrees(key: &Key, answer: &str) -> Option<u32> {
    let signs = ["°", "^\\circ", "^{\\circ}", "degrees", "deg"];
    let turned = TURNS.iter().find_map(|turn| answer.strip_suffix(turn));
    let answer = turned.unwrap_or(answer).trim_end();
    let answer = answer.strip_suffix("/s").unwrap_or(answer);
    let number = signs.iter().find_map(|sign| answer.strip_suffix(sign))?;
    let digits = read::answer(key, number).ok()?.literal?.digits;
    // 429.4° less a turn is 69.4°: those of the turn are gone.
    Some(digits - u32::from(turned.is_some() && digits > 3))
}

/// `0.31 m` where m is also a mass of the scene and a length is asked: a number with its unit, since only that fits.
fn number_with_unit(key: &Key, reading: &Reading, answer: &str) -> Option<Reading> {
    let asked = key.question.dimension.as_ref()?;
    let dimension = |name: &str| {
        let given = key.question.symbols.iter().find(|g| *g.name == *name);
        given?.dimension.clone()
    };
    let formula = reading.content.answer().expr()?;
    if dimension::of(formula, &dimension).is_ok_and(|d| d.as_ref() == Some(asked)) {
        return None;
    }
    let mut question = key.question.clone();
    question.symbols.clear();
    let number = read::answer(&key_of(Content::Scalar(Expr::one()), &question), answer).ok()?;
    let fits = match number.content.answer() {
        Content::Quantity(q) => q.unit.dimension == *asked,
        _ => false,
    };
    (fits && number.literal.is_some()).then_some(number)
}

/// A chain whose last side is a number with its unit, where letters of that are quantities of the scene: `x = u t ≈ 1.08 m`.
fn with_unit_last(key: &Key, answer: &str, mut reading: Reading) -> Reading {
    let at = reading.written.last().map_or(0, |w| w.start);
    if let Content::Relations(sides, _) = &mut reading.content
        && sides.len() > 2
        && let Some((last, text)) = sides.last_mut().zip(answer.get(at..))
        && let Some(side) = read::answer(key, text).ok()
        && let Some(number) = number_with_unit(key, &side, text)
    {
        *last = number.content;
    }
    reading
}

/// The grade of `6.54 m/s²`, where m and s are quantities of the scene and another dimension is asked: as a number with its unit,
/// which is what people write.
fn measured_otherwise(key: &Key, answer: &str, options: &Options) -> Option<Grade> {
    let mut question = key.question.clone();
    question.symbols.clear();
    let alone = key_of(key.reading.content.clone(), &question);
    let number = read::answer(&alone, answer).ok()?;
    let measured = matches!(number.content.answer(), Content::Quantity(_));
    let grade =
        (measured && number.literal.is_some()).then(|| judge_against(&alone, answer, options));
    grade.filter(|grade| grade.note == "DIFF_UNIT")
}

/// A vector in numbers, each component to three digits or within the tolerance.
fn components(entry: &Entry, exact: [Expr; 3], answer: &str, options: &Options) -> Option<Grade> {
    let mut question = entry.key.question.clone();
    let dimension = question.dimension.take();
    let mut key = key_of(Content::Vector(exact), &question);
    key.reading.unit = dimension
        .filter(|d| !d.is_none())
        .map(crate::dimension::Unit::coherent);
    let tolerance = options.tolerance.clone();
    let rounded = tolerance.is_none();
    let options = Options {
        tolerance: tolerance.or(Some(Tolerance::Significant(3))),
        ..options.clone()
    };
    let mut grade = judge_against(&key, answer, &options);
    if grade.verdict == Verdict::Equivalent && rounded {
        grade.note = "EQUIV_ROUNDED";
        grade.proof.words = "the exact values rounded to 3 significant digits".into();
    }
    Some(grade)
}

/// `9.31 rad/s clockwise` and `m u/M to the left` with the sign the question counts by; for a vector in formulas its components.
pub(in crate::grade) fn in_words(
    ask: &Ask,
    component: Option<usize>,
    answer: &str,
) -> Option<String> {
    let (body, [x, y, z]) = read::sense(answer)?;
    let along = |axis: &Vector| {
        let part = dot(&[Expr::from(x), Expr::from(y)], axis);
        part.as_number()
            .filter(|part| part.abs().is_one())
            .map(Signed::is_positive)
    };
    let axes = [[1, 0], [0, 1]].map(|axis| axis.map(Expr::from));
    let same = match (ask, component) {
        (
            Ask::Spin { clockwise, .. }
            | Ask::Angle { clockwise, .. }
            | Ask::AngularAcceleration { clockwise, .. },
            _,
        ) if z != 0 => (z < 0) == *clockwise,
        (Ask::Velocity { along: None, .. } | Ask::Impulse { along: None, .. }, Some(axis)) => {
            along(&axes[axis])?
        }
        (Ask::Velocity { along: None, .. } | Ask::Impulse { along: None, .. }, None) if z == 0 => {
            true
        }
        (
            Ask::Velocity {
                along: Some(axis), ..
            }
            | Ask::Impulse {
                along: Some(axis), ..
            }
            | Ask::PointAcceleration { along: axis, .. }
            | Ask::Reaction { along: axis, .. },
            _,
        ) => along(axis)?,
        _ => return None,
    };
    if component.is_none()
        && let Ask::Velocity { along: None, .. } | Ask::Impulse { along: None, .. } = ask
    {
        let at = body.rfind('=').map_or(0, |at| at + 1);
        let parts = [x, y].map(|part| format!("{part}*({})", body[at..].trim()));
        return Some(format!("{}[{}]", &body[..at], parts.join(", ")));
    }
    Some(read::with_sign(body, same))
}

/// A spin as a vector along k, which points out of the page, in the sense the question counts by.
fn about_z(ask: &Ask, reading: &Reading) -> Option<String> {
    let Ask::Spin { clockwise, .. } = ask else {
        return None;
    };
    let Content::Vector([x, y, z]) = reading.content.answer() else {
        return match &reading.content {
            // `\vec ω = … k̂` has a name in front that is no answer's.
            Content::Relations(sides, _) => match sides.last() {
                Some(last @ Content::Vector(_)) => about_z(ask, &reading.with(last.clone())),
                _ => None,
            },
            _ => None,
        };
    };
    let flat = x.is_zero() && y.is_zero();
    let value = if *clockwise { -z } else { z.clone() };
    let shown = || match &reading.unit {
        Some(unit) => {
            let value = &value * &unit.value();
            format!("{} {}", number::shown(&value), unit.dimension.si())
        }
        None => number::shown(&value),
    };
    flat.then(shown)
}
