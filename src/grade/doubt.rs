//! Where a text could mean something else: other readings, an e that nobody declared, and what the reader decided.

mod letters;
mod units;
mod unread;

use super::compare;
use super::{Diagnosis, Grade, Key, Options, Proof, Verdict, read, show};
use crate::dimension;
use crate::expr::{Expr, Node, Point, Symbol};
use crate::formula::{self, Content, Fault, Note, Reading, Relation, Remark, Symbols};
pub(super) use units::run_together;
pub(super) use unread::{commas, either_comma, number, unread};

/// An answer that was read and judged, and may mean something else.
pub(super) struct Doubt<'a> {
    pub key: &'a Key,
    pub answer: &'a str,
    pub options: &'a Options,
    /// How it was read.
    pub reading: Reading,
    /// What was found of it.
    pub finding: Grade,
}

impl<'a> Doubt<'a> {
    /// An answer as it was read.
    pub(super) fn new(
        key: &'a Key,
        answer: &'a str,
        options: &'a Options,
        reading: Reading,
    ) -> Doubt<'a> {
        Doubt {
            finding: compare::contents(key, &reading, options),
            key,
            answer,
            options,
            reading,
        }
    }

    /// The same by another reading.
    fn of(&self, reading: Reading) -> Doubt<'a> {
        Doubt::new(self.key, self.answer, self.options, reading)
    }

    /// The same with another text, where that can be read.
    fn instead(&self, text: &str) -> Option<Doubt<'a>> {
        Some(self.of(read::answer(self.key, text).ok()?))
    }

    /// Whether it is wrong by that.
    pub(super) fn is_wrong(&self) -> bool {
        self.finding.verdict == Verdict::Different
    }

    /// The names with which an answer was read: those of its question, and its own name for what it gives.
    fn readable(&self) -> Symbols {
        let mut names = self.key.readable.clone();
        if self.key.question.closed {
            let known = |name: &Symbol| names.declared().iter().any(|d| d.name == *name);
            let own: Vec<Symbol> = self
                .reading
                .symbols()
                .into_iter()
                .filter(|n| !known(n))
                .collect();
            own.iter().for_each(|name| names.declare(name));
        }
        names
    }

    /// `(1, 2) or (2, 1)`: an interval whose ends stand the wrong way round holds nothing and would agree with anything; it is a
    /// point, or a slip.
    pub(super) fn backwards(&mut self) {
        let value = |side: &Content| side.expr()?.evaluate(&Point::default());
        let empty = |part: &Content| match part {
            Content::Relations(sides, signs) => match (&sides[..], &signs[..]) {
                (
                    [low, _, high],
                    [
                        Relation::Less | Relation::LessEqual,
                        Relation::Less | Relation::LessEqual,
                    ],
                ) => {
                    let ends: Option<(f64, f64)> = value(low).zip(value(high));
                    ends.is_some_and(|(low, high)| low > high)
                }
                _ => false,
            },
            _ => false,
        };
        let some = |content: &Content| matches!(content, Content::Joined(_, parts) if parts.iter().any(empty));
        let sides = [&self.key.reading.content, &self.reading.content];
        if self.finding.is_equivalent() && sides.into_iter().any(some) {
            let words = "the ends of an interval stand the wrong way round; it holds nothing, and may be meant as a point";
            undecide(&mut self.finding, words);
        }
    }

    /// `e^2x` that is wrong as it stands, and would be right with all of 2x in the exponent: many who type mean that. What would
    /// be right with a quotient there, `x^1/2`, stays wrong and is told.
    pub(super) fn raised(&mut self) {
        if !self.is_wrong() || self.answer.len() > LONGEST {
            return;
        }
        for signs in ["", "/"] {
            if let Some(text) = raised_further(self.answer, signs)
                && let Some(mut other) = self.instead(&text)
            {
                other.euler();
                if other.finding.is_equivalent() {
                    let words = format!(
                        "it would be right as {text}; without brackets one factor alone is the exponent"
                    );
                    // A slash ends an exponent by every rule.
                    if signs.is_empty() {
                        undecide(&mut self.finding, &words);
                    }
                    let hint = "write brackets around all that stands in the exponent";
                    self.finding.diagnosis = vec![Diagnosis::new("AMBIGUOUS", words, hint)];
                    return;
                }
            }
        }
    }

    /// `x = 3 y = 4` that is wrong as a chain, and would be right with a comma between two equations: it is not decided.
    pub(super) fn side_by_side(&mut self) {
        let is_chain = self
            .reading
            .content
            .relations()
            .is_some_and(|(sides, _)| sides.len() > 2);
        if !is_chain || !self.is_wrong() || self.answer.len() > LONGEST {
            return;
        }
        let Some(text) = with_commas(self.answer) else {
            return;
        };
        let other = self.instead(&text);
        if other.is_some_and(|other| other.finding.is_equivalent()) {
            let words = format!("it would be right as {text}; without a comma it is one chain");
            ambiguous(
                &mut self.finding,
                &words,
                "write a comma between two equations",
            );
        }
    }

    /// An answer that is wrong as it is usually read, and right with every slash turned round, is right, and is told how it was
    /// taken: people differ about slashes. So is `acosφ` that is right as a times the cosine.
    pub(super) fn turned(&mut self) {
        let arc = |notes: &[Note], arc| {
            let remark = Remark::ArcOrFactor { arc };
            notes.iter().any(|n| n.remark == remark)
        };
        let arcs = arc(&self.reading.notes, true);
        if !(self.reading.slashes || arcs) || !self.is_wrong() {
            return;
        }
        let names = self.readable();
        let slashes = || formula::slashes_turned(self.answer, &names);
        let slashes = self.reading.slashes.then(slashes);
        let factors = || {
            let mut others = formula::other_readings(self.answer, &names, false);
            others.retain(|other| arc(&other.notes, false));
            others
        };
        let others = slashes.into_iter().flatten();
        let others = others.filter(|other| other.content != self.reading.content);
        let others = others.chain(arcs.then(factors).into_iter().flatten());
        let found = others
            .map(|other| self.of(other))
            .find(|other| other.finding.is_equivalent());
        let Some(Doubt {
            reading, finding, ..
        }) = found
        else {
            return;
        };
        let [theirs, mine] = [&reading, &self.reading].map(|reading| show(&reading.content));
        let message = format!("right when it is read as {theirs}; by the usual rule it is {mine}");
        let hint = match arc(&reading.notes, false) {
            true => "write a space before the function: acos is the arccosine",
            false => "the slash can be read in two ways; use brackets to say what stands below",
        };
        self.finding = finding.reread(message, hint);
        self.reading = reading;
    }

    /// `mv sinθ N s`: a wrong answer with a unit behind its last spaces whose letters the question does not know is right when
    /// the formula before it is, and is told so. One letter, or two small ones, are a factor; J, N and W are units first.
    pub(super) fn unit_behind(&mut self) {
        let (key, answer) = (self.key, self.answer);
        let known = |word: &str| key.question.symbols.iter().any(|g| *g.name == *word);
        // `0.25 m g h J` is a number of units where m, g and h are the symbols of a formula.
        let formula = key
            .reading
            .content
            .answer()
            .expr()
            .is_some_and(|e| !e.is_constant());
        let measured = formula && matches!(self.reading.content.answer(), Content::Quantity(_));
        let own = !self.reading.symbols().iter().all(|name| known(name));
        if !self.is_wrong() || !(measured || own) {
            return;
        }
        let spaces = answer.rmatch_indices(' ').take(3);
        let found = spaces.into_iter().find_map(|(at, _)| {
            let (formula, behind) = (answer[..at].trim_end(), &answer[at..]);
            let inside = behind
                .trim()
                .strip_prefix('[')
                .and_then(|unit| unit.strip_suffix(']'));
            let text = formula::plain_unit(inside.unwrap_or(behind))?;
            let letters = text.split(|c: char| !c.is_alphabetic());
            let unit = dimension::unit(&text).ok()?;
            let mut words = letters.filter(|word| !word.is_empty());
            let mut plain = !text.contains(['/', '^', '²', '⁻']);
            let declared = words.any(|word| {
                plain &= word.len() == 1 && word.to_lowercase() == word;
                known(word)
            });
            let letter = text.chars().count() == 1 && !matches!(text.as_str(), "J" | "N" | "W");
            // Brackets show a unit: `v/2 [m/s]`.
            let told = declared || letter || plain;
            if told && inside.is_none() || unit.dimension.is_none() {
                return None;
            }
            let mut other = read::answer(key, formula).ok()?;
            let verdict = compare::verdict_of(key, &other, self.options);
            other.unit = Some(unit);
            (verdict == Verdict::Equivalent).then_some((other, text))
        });
        if let Some((other, unit)) = found {
            let message = format!("right with {unit} read as a unit, not as a factor");
            let hint = "symbols carry their units: leave the unit away";
            let Doubt {
                reading, finding, ..
            } = self.of(other);
            self.finding = finding.reread(message, hint);
            self.reading = reading;
        }
    }

    /// Where a text could be read in another way and that would be right, the grade says so; the usual reading decides.
    pub(super) fn ambiguity(&mut self) {
        if !matches!(
            self.finding.verdict,
            Verdict::Equivalent | Verdict::Different
        ) {
            return;
        }
        let (answer, plain) = (self.answer, self.options.plain());
        let mut others = formula::other_readings(answer, &self.readable(), false);
        if let Some(content) = power_of_function(&self.reading.content) {
            others.push(self.reading.with(content));
        }
        for other in others {
            let verdict = compare::verdict_of(self.key, &other, &plain);
            let finding = &mut self.finding;
            if verdict != finding.verdict
                && matches!(verdict, Verdict::Equivalent | Verdict::Different)
            {
                let right = finding.is_equivalent();
                let [mine, theirs] = [&self.reading, &other].map(|reading| show(&reading.content));
                let would = if right { "wrong" } else { "right" };
                let message = format!("read as {mine}; read as {theirs} it would be {would}");
                let hint =
                    "the formula can be read in two ways; use brackets to say which is meant";
                if tight_root(&other, answer, right) {
                    let words = "the root sign may reach over one letter or over all of them";
                    undecide(finding, words);
                } else if !right && other.notes.iter().any(|note| is_quotient(note, answer)) {
                    let words = "the function may be taken of the quotient or of the number before the slash";
                    undecide(finding, words);
                } else if behind_fraction(&other, answer) {
                    undecide(
                        finding,
                        "the function may be taken of the fraction or of all behind it",
                    );
                }
                let found = Diagnosis::new("AMBIGUOUS", message, hint);
                finding.diagnosis.insert(0, found);
                return;
            }
        }
    }

    /// Tells that × was taken for a product of numbers, where nobody declares that the letters beside it are none of vectors.
    pub(super) fn crossed(&mut self) {
        let undeclared = |name: &Symbol| self.key.undeclared.contains(name);
        if self.finding.is_equivalent()
            && let Some(note) =
                read::cross(&self.reading, self.answer, &self.key.readable, &undeclared)
            && let Some(product) = self.answer.get(note.start..note.end)
        {
            let words = format!("{} is a product of numbers", product.trim());
            self.finding.assumed.push(words);
        }
    }
}

/// `cosθ^2`, read as the cosine of a square, would be right as the square of the cosine.
pub(super) fn power_of_function(content: &Content) -> Option<Content> {
    fn lifted(e: &Expr) -> Option<Expr> {
        if let Node::Call(f, x) = e.node()
            && let Node::Power(base, k) = x.node()
            && k.is_integer()
        {
            return Some(Expr::call(*f, base.clone()).power(k.clone()));
        }
        None
    }
    fn lift(e: &Expr) -> Expr {
        lifted(e).unwrap_or_else(|| e.map_parts(lift))
    }
    if !content.parts().any(|part| lifted(part).is_some()) {
        return None;
    }
    let changed = match content {
        Content::Scalar(_) | Content::Vector(_) | Content::Matrix(_) => content.map(&lift),
        _ => return None,
    };
    (changed != *content).then_some(changed)
}

/// A text with a comma before each name behind a space that stands left of a further sign of equality.
fn with_commas(text: &str) -> Option<String> {
    let mut pieces = text.split('=');
    let mut out = pieces.next()?.to_string();
    let pieces: Vec<&str> = pieces.collect();
    let (last, between) = pieces
        .split_last()
        .filter(|(_, between)| !between.is_empty())?;
    for piece in between {
        let (value, name) = piece.trim_end().rsplit_once(' ')?;
        out.extend(["=", value.trim_end(), ", ", name, " "]);
    }
    Some(out + "=" + last)
}

/// A text with brackets around all letters, digits and `signs` behind each sign of a power; nothing where that changes nothing.
fn raised_further(text: &str, signs: &str) -> Option<String> {
    let mut pieces = text.split('^');
    let mut out = pieces.next()?.to_string();
    let mut changed = false;
    for piece in pieces {
        let unsigned = piece.trim_start_matches(['-', '−']);
        let inside = |c: char| c.is_alphanumeric() || signs.contains(c);
        let rest = unsigned.trim_start_matches(inside);
        let (exponent, rest) = piece.split_at(piece.len() - rest.len());
        let further = unsigned.len() > rest.len() + 1;
        changed |= further;
        out.push_str(&match further {
            true => format!("^({exponent}){rest}"),
            false => format!("^{piece}"),
        });
    }
    changed.then_some(out)
}

/// Nothing is decided, for a text has two meanings.
fn undecide(finding: &mut Grade, words: &str) {
    finding.verdict = Verdict::Undecided;
    finding.note = "UNDECIDED_AMBIGUOUS";
    finding.proof = Proof::of("none", words);
    finding.counterexample = None;
    finding.diagnosis.clear();
}

/// The same, with words on what could be written in place of it.
fn ambiguous(finding: &mut Grade, words: &str, hint: &str) {
    undecide(finding, words);
    finding.diagnosis = vec![Diagnosis::new("AMBIGUOUS", words, hint)];
}

/// Longest answer, in bytes, of which a number is tried in its other meaning: what is longer no student wrote.
const LONGEST: usize = 1_000;

/// What an author should know about an expected formula in which a slash or a root could reach further or less far.
pub(super) fn told(expected: &str, reading: &Reading) -> Option<String> {
    let slash = |n: &&Note| match n.remark {
        Remark::Slash { .. } => reading.slashes,
        Remark::Root { .. } => true,
        _ => is_quotient(n, expected),
    };
    let note = reading.notes.iter().find(slash)?;
    Some(note.message(expected))
}

/// Whether a function without brackets stands before a quotient of numbers, `arctan 3/4`.
fn is_quotient(note: &Note, text: &str) -> bool {
    let above = text.get(note.start..note.middle).unwrap_or_default();
    let below = text.get(note.middle..note.end).unwrap_or_default();
    let number = |piece: &str| {
        let piece = piece.replace("pi", "π").replace("sqrt", "√");
        let mut all = piece.chars();
        all.all(|c| c.is_ascii_digit() || ". π√\\{}()".contains(c))
    };
    matches!(note.remark, Remark::Argument { .. })
        && number(above)
        && below.strip_prefix('/').is_some_and(number)
}

/// The fault of a slash whose reach is not shown by brackets, where that is asked for.
pub(super) fn unclear_slash(text: &str, reading: &Reading) -> Option<Fault> {
    let slash = |n: &&Note| matches!(n.remark, Remark::Slash { .. });
    let note = reading.notes.iter().find(slash)?;
    let reading = note.message(text);
    let message = format!("what stands below the slash is unclear: {reading}");
    let hint = "write brackets around all that stands below";
    Some(*Fault::new(message, note.start, note.end).hint(hint))
}

/// Whether a reading takes `√ab`, with nothing between the letters, as the root of all of them: no habit decides that.
fn tight_root(other: &Reading, answer: &str, right: bool) -> bool {
    let tight = |note: &Note| {
        let (root, behind) = answer.split_at_checked(note.middle).unwrap_or_default();
        // The root of a number and then letters is what most mean by `√2x`.
        if right && root.ends_with(|c: char| c.is_ascii_digit()) {
            return false;
        }
        behind.starts_with(|c: char| c.is_alphanumeric() || c == '\\')
    };
    let long = Remark::Root { long: true };
    other.notes.iter().any(|n| n.remark == long && tight(n))
}

/// Whether a reading takes a function of a fraction and the name behind it, as in `\sin\frac{n\pi}{L}x`.
fn behind_fraction(other: &Reading, answer: &str) -> bool {
    let long = Remark::Argument { long: true };
    let fraction = |note: &Note| answer.get(..note.middle).is_some_and(|t| t.ends_with('}'));
    other.notes.iter().any(|n| n.remark == long && fraction(n))
}

/// What the reader decided that a student should know about.
pub(super) fn remarks(reading: &Reading, answer: &str, verdict: Verdict) -> Vec<Diagnosis> {
    let wrong = verdict != Verdict::Equivalent;
    let worth = |note: &&Note| match note.remark {
        Remark::Letters => wrong && note.end > note.start + 3,
        Remark::Radians | Remark::NaturalLogarithm => wrong,
        Remark::UnitOfSymbols | Remark::Words => true,
        Remark::Cross | Remark::Inverse | Remark::UnitNotSymbols => wrong,
        _ => false,
    };
    let said = reading.notes.iter().filter(worth).map(|note| {
        let words = note.message(answer);
        Diagnosis::new("READING", words.clone(), words)
    });
    said.collect()
}
