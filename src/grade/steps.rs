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
mod line;
mod link;
mod names;
mod open;
mod pages;
mod rounded;
mod said;
mod sought;
mod spoken;
mod start;
mod tending;
mod text;
mod vectors;
mod weigh;
mod why;
mod wording;

use std::collections::BTreeSet;

use super::sheet::Sheet;
use super::{Diagnosis, Options, Verdict};
use crate::answer::{Answer, Form};
use crate::expr::{Expr, Symbol};
use crate::formula::{self, Fault};
use crate::scene::Question;
use desk::Desk;
use link::Values;

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
/// whatever the solution says; a velocity against an axis by its letter alone may be the speed, a spin may be counted in the
/// sense that the page says, and a final answer that is right
/// may be of another moment with a mark. An own name may get another meaning further down, but not to
/// explain away why a final answer is wrong. Where a line fails by what an own name was said to be, the name has the value that
/// the scene has for it, and what was said of it is wrong.
/// Numbers that it gives the scene are those of the scene, but an answer in such numbers is none to what is asked.
pub fn check(sheet: &Sheet, text: &str, options: &Options) -> Worked {
    let plain = pages::joined(text);
    let spoken = spoken::letters(&sheet.scene, &plain);
    let lettered = (!spoken.is_empty()).then(|| Sheet {
        spoken,
        ..sheet.clone()
    });
    let sheet = lettered.as_ref().unwrap_or(sheet);
    let Some(valued) = pages::with_numbers(sheet, &plain) else {
        let mut worked = checked(sheet, text, &plain, options);
        tell_own_data(sheet, &plain, &mut worked);
        return worked;
    };
    let mut worked = checked(&valued, text, &plain, options);
    tell_own_data(sheet, &plain, &mut worked);
    let lines = &worked.lines;
    for (name, told) in &mut worked.finals {
        let right = told
            .as_ref()
            .filter(|told| told.verdict == Verdict::Equivalent);
        if let (Some(last), Ok(entry)) = (right, sheet.entry(name)) {
            // The last formula for it that holds.
            let to = lines.iter().rev().filter(|line| line.number <= last.line);
            let mut holds = to.filter(|line| line.status == Status::Holds);
            let judged = |text: &str| sheet.judge(&entry, text, options).verdict;
            let found = holds.find(|line| judged(&line.text) == Verdict::Equivalent);
            *told = found.map(|line| Final {
                line: line.number,
                text: line.text.clone(),
                verdict: Verdict::Equivalent,
            });
        }
    }
    worked
}

/// Tells of lines that hold as data that the numbers in them are the student's own: the scene gives none.
fn tell_own_data(sheet: &Sheet, plain: &str, worked: &mut Worked) {
    let texts: Vec<&str> = plain.lines().collect();
    // The place of a largest or least value is a result, and no data, and so is what a condition gives.
    let sought = sought::sought(sheet);
    let finals = &worked.finals;
    let is_sought = |name: &Symbol, line: usize| {
        let told = |s: &sought::Sought| {
            let own = finals.iter().filter(|(of, _)| *of == s.question);
            let mut own = own.filter_map(|(_, told)| told.as_ref());
            own.any(|told| told.line == line && told.verdict == Verdict::Equivalent)
        };
        let mut of_it = sought.iter().filter(|s| s.parameter == *name);
        of_it.any(|s| s.condition.is_none() || told(s))
    };
    let holds = |line: &&mut Line| line.status == Status::Holds && line.diagnosis.is_empty();
    for line in worked.lines.iter_mut().filter(holds) {
        let text = texts.get(line.number - 1).copied().unwrap_or_default();
        let own = pages::numbers(sheet, text).unwrap_or_default();
        let own = own.iter().filter(|(name, _)| !is_sought(name, line.number));
        let names: Vec<&str> = own.map(|(name, _)| &**name).collect();
        if !names.is_empty() {
            let words = format!(
                "a number of your own: the scene gives {} no value",
                names.join(", ")
            );
            let hint = "is it given? an answer that rests on it is none in general";
            line.diagnosis.push(Diagnosis::new("OWN_DATA", words, hint));
        }
    }
}

/// The same by the values of the scene.
fn checked(sheet: &Sheet, text: &str, plain: &str, options: &Options) -> Worked {
    let worked = |meant: Meant| {
        let (worked, needed) = check_with(sheet, text, options, &meant);
        (worked, meant, needed)
    };
    let accelerations = letters::accelerations(sheet, plain);
    let bound = Desk::new(sheet, options).bindings(plain);
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
    desk.know_bodies(plain);
    let known = best.1.bound.clone();
    let turned = desk.turned_spin(plain);
    let speeds = desk.speeds().into_iter().chain(turned);
    let speeds = speeds.map(|value| Meant {
        value: Some(value),
        bound: known.clone(),
        ..Meant::default()
    });
    let marked = Some(letters::marked(sheet, plain)).filter(|marked| !marked.is_empty());
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
    let own = names::definitions(plain, &symbols);
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
    if let Some((name, _)) = &meant.value {
        desk.count_otherwise(name);
    }
    desk.know_accelerations(meant.value.as_ref());
    let of_center = meant
        .value
        .as_ref()
        .filter(|(name, _)| **name == *letters::OF_CENTER);
    desk.turning = of_center.and_then(|_| letters::turning(sheet, &pages::joined(text)));
    let read = pages::joined(&arrows::spelled(text, &sheet.scene));
    let read = desk.in_names(&read);
    desk.primed = arrows::primed(&read);
    desk.along_normal(&read);
    desk.know_vectors(&read);
    desk.know_bodies(&read);
    desk.closed.extend(meant.bound.clone());
    desk.by_body.retain(|name| !meant.bound.contains_key(name));
    desk.bound = meant.bound.keys().cloned().collect();
    desk.learned.extend(desk.bound.iter().cloned());
    desk.solved_for = names::solved_for(sheet, &read);
    let later = letters::of_a_later_moment(sheet, &read);
    let marked = later.into_iter().chain(meant.marked.iter().cloned());
    desk.own_with_mark.extend(marked);
    desk.anew = meant.anew;
    desk.in_units = meant.in_units;
    desk.ahead = names::definitions(&read, &desk.symbols(""));
    let mut before = String::new();
    let dashes = pages::has_dashes(text);
    let lines = text
        .lines()
        .zip(read.lines().chain(std::iter::repeat("")))
        .enumerate()
        .filter(|(_, (line, _))| !line.trim().is_empty())
        .take(MAX_LINES)
        .map(|(i, (line, read))| {
            let line = line.trim();
            if pages::is_heading(line) {
                desk.of_earlier_parts = desk.own.keys().cloned().collect();
                desk.head(line);
            }
            desk.number = i + 1;
            // What is aligned may begin with a minus sign.
            let item = formula::unlisted(read.trim(), dashes && !line.contains('&'));
            let whole = pages::continued(&before, item);
            let (status, diagnosis) = desk.line(&whole);
            if status == Status::Wrong && !diagnosis.is_empty() {
                desk.explained.insert(desk.number);
            }
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
}
