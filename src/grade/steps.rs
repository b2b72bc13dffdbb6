//! A worked solution, line by line: which lines hold in the scene, which is the first that does not, and whether what
//! follows is carried along by it.
//!
//! A line is an equation in the scene's parameters, the names of what is asked and unknown, and names the student
//! introduces. It holds when it is an identity in the derived motion. After a line that does not hold, later lines are
//! also tried in the motion that line would imply.

mod arrows;
mod bind;
mod cause;
mod desk;
mod finals;
mod impact;
mod inertias;
mod letters;
mod link;
mod names;
mod open;
mod rounded;
mod said;
mod sought;
mod tending;
mod text;
mod vectors;
mod why;

use std::collections::{BTreeMap, BTreeSet};

use super::sheet::{Sheet, judge};
use super::{Diagnosis, Options, Verdict};
use crate::answer::{Answer, Form};
use crate::expr::{Expr, Symbol};
use crate::formula::{self, Fault, Reading};
use crate::scene::Question;
use bind::Values;
use desk::Desk;
use link::{Link, Weighed, gaps};

/// What is found of a line, and what is wrong with it.
type Found = (Status, Vec<Diagnosis>);

/// What is found of one line.
#[derive(Clone, PartialEq, Debug)]
pub enum Status {
    /// It holds in the scene.
    Holds,
    /// It gives a new name to something.
    Defines,
    /// It does not hold, and it does not follow from an earlier slip: a slip of its own.
    Wrong,
    /// It does not hold, and it follows from the wrong line of this number.
    Carried(usize),
    /// It cannot be read.
    Unreadable(Fault),
    /// Words without an equation.
    Comment,
    /// It could not be decided.
    Undecided,
}

impl Status {
    /// What tells more of a line with several equations stands above what tells less.
    fn weight(&self) -> u8 {
        match self {
            Status::Comment => 0,
            Status::Defines => 1,
            Status::Holds => 2,
            Status::Carried(_) => 3,
            Status::Undecided => 4,
            Status::Unreadable(_) => 5,
            Status::Wrong => 6,
        }
    }
}

/// What a solution says last of a quantity that is asked for, in terms of what is given.
#[derive(Clone, Debug)]
pub struct Final {
    /// Number of the line.
    pub line: usize,
    /// The equation.
    pub text: String,
    /// Whether it is the right answer.
    pub verdict: Verdict,
}

/// A worked solution with what is found of it.
#[derive(Clone, Debug)]
pub struct Worked {
    /// Its lines.
    pub lines: Vec<Line>,
    /// For each quantity of the scene its name, and the final answer where one is given.
    pub finals: Vec<(String, Option<Final>)>,
}

/// One line of a worked solution.
#[derive(Clone, Debug)]
pub struct Line {
    /// Its number, from 1.
    pub number: usize,
    /// Its text.
    pub text: String,
    /// What is found.
    pub status: Status,
    /// What is wrong with it, where that is known.
    pub diagnosis: Vec<Diagnosis>,
}

/// Most equations above a line that are solved together.
const MOST_STATED: usize = 24;
/// Most terms of an equation whose signs are tried.
const MOST_TERMS: usize = 12;
/// Most wrong lines that are tried as the cause of a later one.
const MOST_CAUSES: usize = 4;

/// Code of the remark that a line states the condition of a question.
const CONDITION: &str = "CONDITION";
/// Code of the remark that a line holds at another moment of the scene, or in another of its cases.
const MOMENT: &str = "MOMENT";

/// Longest worked solution, in lines.
pub const MAX_LINES: usize = 400;

/// What a solution may mean by its names beside what it says of them.
#[derive(Clone, Default)]
struct Meant {
    /// A name with its value.
    value: Option<(Symbol, Expr)>,
    /// Own names that have a value in the scene.
    bound: Values,
    /// Names of what is asked that are with a mark of another moment, and the mark.
    marked: BTreeSet<(Symbol, &'static str)>,
    /// Whether a name of the student's own may stand for something else further down, as W does for each way.
    anew: bool,
    /// Whether `h = 0.2 m` says how many meters, though m be a mass.
    in_units: bool,
}

/// Checks a worked solution. Where it may be meant in several ways it is read in the one in which fewest of its lines are wrong:
/// an acceleration that it speaks of and nobody asks for is the scene's, counted either way, or, where there may be others,
/// whatever the solution says; a velocity against an axis by its letter alone may be the speed, and a final answer that is right
/// may be of another moment with a mark. An own name may get another meaning further down, but not to
/// explain away why a final answer is wrong. Where a line fails by what an own name was said to be, the name has the value that
/// the scene has for it, and what was said of it is wrong.
pub fn check(sheet: &Sheet, text: &str, options: &Options) -> Worked {
    let worked = |meant: Meant| {
        let (worked, needed) = check_with(sheet, text, options, &meant);
        (worked, meant, needed)
    };
    let plain = text::joined(text);
    let accelerations = letters::accelerations(sheet, &plain);
    let bound = Desk::new(sheet, options).bindings(&plain);
    let whatever = accelerations.contains(&None).then(|| Meant {
        bound: bound[0].clone(),
        ..Meant::default()
    });
    let meant = bound.iter().flat_map(|bound| {
        accelerations.iter().map(|value| Meant {
            value: value.clone(),
            bound: bound.clone(),
            ..Meant::default()
        })
    });
    let best = meant.map(worked).min_by_key(slips).expect("one at least");
    if slips(&best) == 0 {
        return best.0;
    }
    let mut desk = Desk::new(sheet, options);
    desk.know_bodies(&plain);
    let known = best.1.bound.clone();
    let speeds = desk.speeds().into_iter().map(|speed| Meant {
        value: Some(speed),
        bound: known.clone(),
        ..Meant::default()
    });
    let marked = Some(letters::marked(sheet, &plain)).filter(|marked| !marked.is_empty());
    let marked = marked.map(|marked| Meant {
        marked,
        ..best.1.clone()
    });
    let with_own = [Some(best.1.clone()), whatever, marked.clone()];
    let with_own = with_own.into_iter().flatten().map(|meant| Meant {
        anew: true,
        ..meant
    });
    let symbols = desk.symbols("");
    let own = names::definitions(&plain, &symbols);
    let measured = own
        .iter()
        .any(|(_, right)| names::in_unit(right, &symbols).is_some());
    let measured = measured.then(|| Meant {
        in_units: true,
        ..best.1.clone()
    });
    let others = speeds.chain(marked).chain(with_own).chain(measured);
    let others = others.map(worked);
    let others = others.filter(|other| {
        let right = |told: &Option<Final>| Some(told.as_ref()?.verdict == Verdict::Equivalent);
        let (Worked { finals, .. }, meant, _) = other;
        let of = |name: &Symbol| finals.iter().find(|(of, _)| *of == **name);
        let mut marked = meant.marked.iter();
        let hides = slips(other) == 0 && finals.iter().any(|(_, told)| right(told) == Some(false));
        marked.all(|(name, _)| of(name).is_some_and(|(_, told)| right(told) == Some(true)))
            && !(meant.anew && hides)
    });
    let all = std::iter::once(best).chain(others);
    let mut best = all.min_by_key(slips).expect("one at least");
    for _ in 0..MOST_CAUSES {
        let others = best.2.iter().take(MOST_CAUSES).map(|needed| {
            let mut meant = best.1.clone();
            meant
                .bound
                .insert(needed.name.clone(), needed.value.clone());
            (worked(meant), needed.early)
        });
        // The earlier line is the one with the slip, but for one that holds until it is said what its name is.
        let others = others.filter(|(other, early)| match early {
            true => slips(other) <= slips(&best),
            false => (slips(other), first(other)) < (slips(&best), first(&best)),
        });
        match others.min_by_key(|(other, _)| slips(other)) {
            Some((other, _)) => best = other,
            None => break,
        }
    }
    best.0
}

/// What an own name would have to be for a wrong line to hold.
struct Needed {
    name: Symbol,
    value: Expr,
    /// Whether the line stands above the one that says what the name is.
    early: bool,
}

/// A solution that was checked, what it means, and what own names would have to be.
type Tried = (Worked, Meant, Vec<Needed>);

fn wrong_lines((worked, ..): &Tried) -> impl Iterator<Item = &Line> {
    let lines = worked.lines.iter();
    lines.filter(|line| line.status == Status::Wrong)
}

/// How many lines have a slip of their own.
fn slips(tried: &Tried) -> usize {
    wrong_lines(tried).count()
}

/// The number of the first of them.
fn first(tried: &Tried) -> usize {
    wrong_lines(tried)
        .map(|line| line.number)
        .min()
        .unwrap_or(usize::MAX)
}

/// Checks a worked solution that means this; also what own names would have to be for wrong lines to hold.
fn check_with(
    sheet: &Sheet,
    text: &str,
    options: &Options,
    meant: &Meant,
) -> (Worked, Vec<Needed>) {
    let mut desk = Desk::new(sheet, options);
    desk.closed.extend(meant.value.clone());
    desk.know_accelerations(meant.value.as_ref());
    let of_center = meant
        .value
        .as_ref()
        .filter(|(name, _)| **name == *letters::OF_CENTER);
    desk.turning = of_center.and_then(|_| letters::turning(sheet, &text::joined(text)));
    let read = text::joined(&arrows::spelled(text, &sheet.scene));
    let read = desk.in_names(&read);
    desk.primed = arrows::primed(&read);
    desk.along_normal(&read);
    desk.know_vectors(&read);
    desk.know_bodies(&read);
    desk.closed.extend(meant.bound.clone());
    desk.by_body.retain(|name| !meant.bound.contains_key(name));
    desk.bound = meant.bound.keys().cloned().collect();
    desk.learned.extend(desk.bound.iter().cloned());
    desk.solved_for = names::solved_for(&read);
    desk.own_with_mark = letters::of_a_later_moment(sheet, &read);
    desk.own_with_mark.extend(meant.marked.iter().cloned());
    desk.anew = meant.anew;
    desk.in_units = meant.in_units;
    desk.ahead = names::definitions(&read, &desk.symbols(""));
    let mut before = String::new();
    let dashes = text::has_dashes(text);
    let lines = text
        .lines()
        .zip(read.lines().chain(std::iter::repeat("")))
        .enumerate()
        .filter(|(_, (line, _))| !line.trim().is_empty())
        .take(MAX_LINES)
        .map(|(i, (line, read))| {
            let line = line.trim();
            if text::is_heading(line) {
                desk.of_earlier_parts = desk.own.keys().cloned().collect();
                desk.head(line);
            }
            desk.number = i + 1;
            // What is aligned may begin with a minus sign.
            let item = text::unlisted(read.trim(), dashes && !line.contains('&'));
            let whole = text::continued(&before, item);
            let (status, diagnosis) = desk.line(&whole);
            before = whole;
            Line {
                number: desk.number,
                text: line.to_string(),
                status,
                diagnosis,
            }
        })
        .collect();
    let finals = desk.finals();
    (Worked { lines, finals }, desk.needed)
}

impl Desk<'_> {
    /// Takes the motion that a heading names; one further in may be about anything in it.
    fn head(&mut self, heading: &str) {
        let words = heading.split(|c: char| !c.is_alphanumeric() && !"'_()".contains(c));
        let words = words.filter(|word| !word.is_empty());
        let words = format!(" {} ", words.collect::<Vec<_>>().join(" ")).to_lowercase();
        let stages = self.sheet.ends.iter().map(|(stage, _)| stage);
        let named = stages.filter(|stage| words.contains(&format!(" {} ", stage.to_lowercase())));
        let named = named.max_by_key(|stage| stage.len()).cloned();
        if named.is_some() || !heading.starts_with("###") {
            self.under = named;
        }
    }

    /// The final answers in the order of the questions; of a vector its components, where these stand alone.
    fn finals(&self) -> Vec<(String, Option<Final>)> {
        let mut out = Vec::new();
        let has_value = |q: &&Question| {
            let mut answers = self.sheet.all.iter().chain(&self.sheet.derivation.answers);
            let said =
                |a: &Answer| !matches!(a.form, Form::Words | Form::Open(_)) || !a.range.is_empty();
            answers.any(|a| a.question == q.name && said(a))
        };
        // What a speed or a center of rotation is put together from is asked by nobody.
        let helps = |q: &Question| {
            let of = ["_velocity", "_spin", "_from"]
                .iter()
                .find_map(|part| q.name.strip_suffix(part));
            let asked = |name: String| self.sheet.scene.question(&name).is_some();
            of.is_some_and(|of| asked(of.to_string()) || asked(format!("{of}_x")))
        };
        let asked = self.sheet.answered().filter(|q| !q.hidden);
        for q in asked.filter(has_value) {
            let parts: Vec<String> = [format!("{}_x", q.name), format!("{}_y", q.name)].into();
            let told = |name: &String| self.finals.contains_key(name);
            if helps(q) && !told(&q.name) && !parts.iter().any(told) {
                continue;
            }
            // `a_y` is no part of an angular acceleration a.
            let vector = self.components(&q.name).is_some();
            if told(&q.name) || !vector || !parts.iter().any(told) {
                out.push((q.name.clone(), self.finals.get(&q.name).cloned()));
            } else {
                out.extend(
                    parts
                        .into_iter()
                        .map(|n| (n.clone(), self.finals.get(&n).cloned())),
                );
            }
        }
        out
    }

    /// A line is as good as its worst equation.
    fn line(&mut self, text: &str) -> Found {
        if let Some(status) = self.in_case(text) {
            return (status, Vec::new());
        }
        let mut line = (Status::Comment, Vec::new());
        for equation in text::equations(text) {
            if self.is_supposed(text, equation) {
                continue;
            }
            let sensed = text::in_brackets_behind(text, equation);
            let sensed = sensed.and_then(|equation| self.with_sense(&equation));
            let turned = sensed.or_else(|| self.with_sense(equation));
            let equation = turned.as_deref().unwrap_or(equation);
            let (status, diagnosis) = self.equation(equation);
            self.note_clear(equation, &status);
            if status.weight() > line.0.weight() {
                line.0 = status;
            }
            line.1.extend(diagnosis);
        }
        line
    }

    /// Notes an own name that is said anew in a line that cannot be read: what it is from here on is not known.
    fn note_clear(&mut self, equation: &str, status: &Status) {
        let own = names::named(equation).filter(|(name, _)| self.own.contains_key(name));
        if let Some((name, _)) = own {
            match status {
                Status::Unreadable(_) => self.unclear.insert(name),
                _ => self.unclear.remove(&name),
            };
        }
    }

    fn equation(&mut self, text: &str) -> Found {
        if let Some(found) = self.said_before(text) {
            return found;
        }
        let reading = match formula::read(text, &self.symbols(text)) {
            // `(m+M) V`, `(m+M) g h`: a letter that is said further down, or is a quantity first, is no unit.
            Ok(reading) if names::behind(text, &reading).is_some() => {
                let unit = names::behind(text, &reading).and_then(|(from, to)| text.get(from..to));
                // `v² = 2 a s` speaks of a way, `t = v/(μ g) s` of seconds.
                let solved = names::named(text).is_some();
                let letter = self.is_misfit(text, &reading)
                    || unit.is_some_and(|unit| {
                        names::is_quantity_first(unit) || unit == "s" && !solved
                    });
                match self.looked_ahead(text) {
                    Some(reading) => reading,
                    None if letter && self.new_name(text).is_some() => {
                        return (Status::Defines, Vec::new());
                    }
                    None if self.has_normal(text, &reading) && self.new_side(text).is_some() => {
                        formula::read(text, &self.symbols(text)).unwrap_or(reading)
                    }
                    None if names::are_letters(text, &reading) => {
                        return (Status::Undecided, Vec::new());
                    }
                    None => reading,
                }
            }
            Ok(reading) => reading,
            Err(fault) => {
                if let Some(found) = self.definition(text) {
                    return found;
                }
                let parts = text::measured_end(text);
                if let Some(parts) = parts.filter(|parts| self.are_read(parts)) {
                    let [mut first, second] = parts.map(|part| self.equation(&part));
                    if second.0.weight() > first.0.weight() {
                        first.0 = second.0;
                    }
                    first.1.extend(second.1);
                    return first;
                }
                // A name that looks like one of the scene's is a slip of the pen rather than a new name; V_y beside an own
                // V_x is none.
                let near = text::near(&fault, text);
                let near = near.is_some_and(|meant| !self.own.contains_key(meant));
                match self.looked_ahead(text) {
                    Some(reading) => reading,
                    None if near => return (Status::Unreadable(fault), Vec::new()),
                    None if self.new_name(text).is_some() => {
                        return (Status::Defines, Vec::new());
                    }
                    None if self.is_conservation(text) => return (Status::Comment, Vec::new()),
                    None => {
                        self.new_side(text);
                        match formula::read(text, &self.symbols(text)) {
                            Ok(reading) => reading,
                            Err(fault) => return (Status::Unreadable(fault), Vec::new()),
                        }
                    }
                }
            }
        };
        if let Some(found) = self.bound(text, &reading) {
            return found;
        }
        let mut found = self.judged(text, &reading);
        if let (Status::Holds, Some((name, _))) = (&found.0, names::named(text))
            && self.bound.remove(&name)
        {
            found.0 = Status::Defines;
        }
        if found
            .1
            .iter()
            .all(|d| ![CONDITION, MOMENT].contains(&d.code))
        {
            self.note_final(text, &reading, &Values::new());
        }
        found
    }

    /// `ω = 3v/(4a) clockwise` and `P_y = m v downwards` with the sign the question counts by, on every side.
    fn with_sense(&self, text: &str) -> Option<String> {
        let (name, right) = names::named(text)?;
        let name = name.trim_end_matches(['\'', '^', '+']);
        let part = |q: &Question| match name.strip_prefix(q.name.as_str())? {
            "" => Some((q.ask.clone(), None)),
            "_x" => Some((q.ask.clone(), Some(0))),
            "_y" => Some((q.ask.clone(), Some(1))),
            _ => None,
        };
        let (ask, component) = self.sheet.scene.questions.iter().find_map(part)?;
        let (values, _) = super::read::sense(right)?;
        let word = right[values.len()..].trim_start_matches([' ', ',', '(']);
        judge::in_words(&ask, component, &format!("{values} {word}"))?;
        let sides = values.split('=');
        let sides: Option<Vec<String>> = sides
            .map(|side| judge::in_words(&ask, component, &format!("{side} {word}")))
            .collect();
        Some(format!("{name} = {}", sides?.join(" = ")))
    }

    fn judged(&mut self, text: &str, reading: &Reading) -> Found {
        let Some(links) = self.links(reading) else {
            return (self.inequality(reading), Vec::new());
        };
        let weighed = match self.is_counted_otherwise(&links) {
            true => Weighed::Slip(0),
            false => self.weigh(text, &links),
        };
        if let (Weighed::Slip(_), Some(found)) = (&weighed, self.said_anew(text)) {
            return found;
        }
        let fails = matches!(weighed, Weighed::Slip(_) | Weighed::Carried(_));
        if fails && self.is_condition(&links, &weighed) {
            let all = gaps(&links);
            self.state(None, &all);
            let words = "a condition the scene asks about, not a fact";
            let found = Diagnosis::new(CONDITION, words, words);
            return (Status::Holds, vec![found]);
        }
        if let Weighed::Slip(_) = weighed
            && let Some((when, there, of)) = self.at_another_moment(&links)
        {
            let there = there.clone();
            self.count(&links, &of);
            let mut sides = links.iter().map(|link| &link.sides[0]);
            let said = sides.next().and_then(|side| side.name());
            if !said.is_some_and(|name| formula::has_arrow(name)) {
                self.note_final(text, reading, &there);
            }
            let hint = "say which moment or case is meant";
            let found = Diagnosis::new(MOMENT, format!("this holds {when}"), hint);
            return (Status::Holds, vec![found]);
        }
        if self.forgets(&links, matches!(weighed, Weighed::Slip(_))) {
            return self.equation(text);
        }
        if let Weighed::Slip(_) = weighed {
            // `v(t) = v − μ g t` tells a motion in time, of which the scene knows the end.
            if text::is_of_time(text) {
                return (Status::Undecided, Vec::new());
            }
            if let Some(found) = self.left_open(&links) {
                return found;
            }
            // The student may have meant the other reading of a slash, or m u by `mu`.
            let symbols = self.symbols(text);
            let others = formula::other_readings(text, &symbols, true);
            let apart = formula::letters_apart(text, &symbols);
            let apart = apart.and_then(|text| formula::read(&text, &symbols).ok());
            let measured = self.measured(text, reading);
            if self.is_before_beside_primes(text) {
                let words = "this holds just before the impact, as it is with a prime after it";
                let hint = "say which moment is meant";
                return (Status::Holds, vec![Diagnosis::new(MOMENT, words, hint)]);
            }
            for other in others.into_iter().take(4).chain(apart).chain(measured) {
                let Some(links) = self.links(&other) else {
                    continue;
                };
                let again = self.weigh(text, &links);
                if let Weighed::Slip(_) | Weighed::Open = again {
                    continue;
                }
                let message = format!("holds when read as {}", super::show(&other.content));
                let hint = "this line can be read in two ways; use brackets to say which is meant";
                let found = match again {
                    Weighed::Carried(_) => Vec::new(),
                    _ => vec![Diagnosis::new("AMBIGUOUS", message, hint)],
                };
                return (self.note(&other, &links, &again), found);
            }
        }
        if let Weighed::Slip(_) = weighed {
            self.note_coarse(text);
        }
        let status = self.note(reading, &links, &weighed);
        let found = match weighed {
            Weighed::Slip(at) => self.diagnosis(reading, at, text),
            Weighed::Holds if link::in_vectors(&links) => {
                self.count(&links, &BTreeMap::new());
                let says = self.says_enough(&links, &self.parts, false);
                (!says).then(open::vanishes).into_iter().collect()
            }
            _ => Vec::new(),
        };
        (status, found)
    }

    /// Whether a line holds where a vector that the page has with a prime as well is the one before.
    fn is_before_beside_primes(&self, text: &str) -> bool {
        let of_primed = |letter: &str, index: &str| {
            let mut primed = self.primed.iter();
            primed.any(|(l, i)| l == letter && i == index)
        };
        let before = arrows::with_mark(text, "^{-}", &of_primed);
        let reading = formula::read(&before, &self.symbols(&before)).ok();
        let links = reading
            .filter(|_| before != text)
            .and_then(|r| self.links(&r));
        links.is_some_and(|links| {
            matches!(self.weigh(text, &links), Weighed::Holds | Weighed::Rounded)
                && self.says_enough(&links, &self.parts, true)
        })
    }

    /// Keeps what later lines may hang on.
    fn note(&mut self, reading: &Reading, links: &[Link], weighed: &Weighed) -> Status {
        // A chain also says that its ends are equal: what is read off goes on from there.
        let ends = match (links.first(), links.last()) {
            (Some(a), Some(b)) if links.len() > 1 => self.link(&a.sides[0], &b.sides[1]),
            _ => None,
        };
        let all = ends.iter().chain(links).flat_map(|l| &l.differences);
        let all: Vec<Expr> = all.cloned().collect();
        match weighed {
            Weighed::Holds => {
                let used = all.iter().flat_map(Expr::symbols);
                let own = used.filter(|name| self.own.contains_key(name));
                self.proved.extend(own.collect::<Vec<_>>());
                self.carry(reading);
                self.state(None, &all);
                Status::Holds
            }
            Weighed::Rounded => Status::Holds,
            Weighed::Open => Status::Undecided,
            Weighed::Carried(cause) => {
                if self.believe_vector(*cause, links).is_none() {
                    self.believe(*cause, &all);
                }
                self.state(Some(*cause), &all);
                Status::Carried(*cause)
            }
            Weighed::Slip(_) => {
                // What a wrong vector says of all else is not meant: `H = ml²ω/12` would say that ω = 0.
                if self.believe_vector(self.number, links).is_none() {
                    self.believe(self.number, &all);
                }
                self.state(Some(self.number), &all);
                // That a product vanishes says too little, and too much follows from it.
                let own = all.iter().map(|d| self.with_own(d));
                let own: Vec<_> = own.filter(|d| self.says_a_sum(d)).collect();
                let number = self.number;
                self.wrong.extend(own.into_iter().map(|d| (number, d)));
                // It may be such a name that is wrong, which later lines use as well.
                for gap in &all {
                    let needed: BTreeMap<_, _> = self.own_needed(gap).into_iter().collect();
                    let used = gap.symbols();
                    let used = used.into_iter().filter(|name| self.own.contains_key(name));
                    for name in used.collect::<Vec<_>>() {
                        let truth = needed.get(&name).map(|[_, truth]| truth);
                        let early = self.early.contains(&name);
                        self.needed
                            .extend(self.meant_by(gap, &name, truth).map(|value| Needed {
                                name: name.clone(),
                                value,
                                early,
                            }));
                        let truth = truth.map(|truth| (number, name, truth.clone()));
                        self.slipped.extend(truth);
                    }
                }
                Status::Wrong
            }
        }
    }
}
