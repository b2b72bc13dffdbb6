//! Names the student introduces: what they stand for, said before or further down, and with which slip.

use std::collections::BTreeSet;

use super::super::relation::{angle_in, below_in, size_in, solve_for};
use super::super::sheet::Sheet;
use super::inertias::is_other_inertia;
use super::letters::OF_CENTER;
use super::link::{Link, Values, Weighed};
use super::{Desk, Found, Status};
use crate::dimension::{self, Dimension};
use crate::expr::{Expr, Node, Symbol, only};
use crate::formula::{self, Content, Fault, Reading, Remark, Symbols};

/// Most names a student may introduce.
const MOST_NAMES: usize = 100;
/// The lone name left of the first equality sign, and what stands right of it.
pub(super) fn named(text: &str) -> Option<(Symbol, &str)> {
    let (left, right) = text.split_once('=')?;
    let left = left.trim_end_matches(':').trim();
    let word = left.starts_with(|c: char| c.is_ascii_alphabetic())
        && left.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    let symbol = formula::read_name(left, &Symbols::open());
    let name = symbol.or_else(|| word.then(|| Symbol::from(left)))?;
    Some((name, right))
}

/// The definitions `name = …` of a worked solution, for lines that use a name before it is said; what the scene names in
/// another spelling is none.
pub(super) fn definitions(text: &str, scene: &Symbols) -> Vec<(Symbol, String)> {
    let parts = super::pages::all_equations(text);
    let new = |part: &&str| {
        let left = part.split('=').next().unwrap_or_default();
        formula::read(left, scene).is_err()
    };
    let named = parts.filter(new).filter_map(named);
    named.map(|(n, right)| (n, right.to_string())).collect()
}

/// What a worked solution says something about: `v = …`, `v ≥ …`, `v² = …`.
pub(super) fn left_sides(text: &str) -> Vec<Expr> {
    let parts = super::pages::all_equations(text);
    let sides = parts.filter_map(|part| {
        let reading = formula::read(part, &Symbols::open()).ok()?;
        let (sides, _) = reading.content.relations()?;
        sides.first()?.expr().cloned()
    });
    sides.collect()
}

/// The names for which it says something at the end of its way, by their powers too, and among them those of questions.
pub(super) fn solved_for(sheet: &Sheet, text: &str) -> BTreeSet<Symbol> {
    let sides = left_sides(text);
    let base = |side: &Expr| match side.node() {
        Node::Power(base, _) => base.as_symbol().cloned(),
        _ => side.as_symbol().cloned(),
    };
    let mut found: BTreeSet<Symbol> = sides.iter().filter_map(base).collect();
    // `d_0` reads as d0 where no scene has such a name.
    let questions = sheet.scene.questions.iter().map(|q| q.name.as_str());
    let open = Symbols::open();
    let asked = questions.filter(|name| {
        let read = formula::read_name(&formula::latex_name(name), &open);
        read.is_some_and(|read| found.contains(&read))
    });
    let asked: Vec<Symbol> = asked.map(Symbol::from).collect();
    found.extend(asked);
    found
}

/// The place of what was read as a unit behind a formula in symbols; of several the last, as others may be names.
pub(super) fn behind(text: &str, reading: &Reading) -> Option<(usize, usize)> {
    let mut notes = reading.notes.iter();
    let note = notes.find(|n| n.remark == Remark::UnitOfSymbols)?;
    let unit = text.get(note.start..note.end)?.trim_end();
    let last = unit.rfind(' ').map_or(0, |at| at + 1);
    Some((note.start + last, note.start + unit.len()))
}

/// Whether what was read as units behind a formula in symbols is several letters of quantities: `m g h`, of a g and an h that
/// are said nowhere.
pub(super) fn are_letters(text: &str, reading: &Reading) -> bool {
    let mut notes = reading.notes.iter();
    let note = notes.find(|n| n.remark == Remark::UnitOfSymbols);
    let unit = note.and_then(|note| text.get(note.start..note.end));
    let words = unit.map(|unit| unit.split_whitespace().rev().collect::<Vec<_>>());
    words.is_some_and(|words| words.len() > 1 && is_quantity_first(words[0]))
}

/// A number with its unit where a letter of the scene may stand as well: `0.2 m`, though m be a mass.
pub(super) fn in_unit(text: &str, symbols: &Symbols) -> Option<Reading> {
    let read = formula::read(text, &Symbols::strict()).ok()?;
    let own = formula::read(text, symbols).ok()?;
    let measured = matches!(read.content, Content::Quantity(_)) && read.literal.is_some();
    (measured && matches!(own.content, Content::Scalar(_))).then_some(read)
}

/// Whether a letter behind a formula is a quantity first: a speed V rather than volts, also in `½ M V²`, a
/// time t rather than tonnes.
pub(super) fn is_quantity_first(unit: &str) -> bool {
    let power = ["²", "^2", "^{2}"].into_iter();
    let letter = power.filter_map(|p| unit.trim().strip_suffix(p)).next();
    let letter = letter.unwrap_or(unit.trim());
    formula::among("Ω \\Omega V h t A C F H K L T l d W", letter)
}

impl Desk<'_> {
    /// Whether a name is the scene's or was introduced.
    fn is_known(&self, name: &Symbol) -> bool {
        let parameters = &self.sheet.scene.parameters;
        self.closed.contains_key(name)
            || self.own.contains_key(name)
            || self.parts.contains_key(&*format!("{name}_z"))
            || parameters.iter().any(|p| p.name == *name)
    }

    /// Whether an equation says what a new name stands for.
    pub(super) fn names_something(&self, text: &str) -> bool {
        let known = |c: char| self.is_known(&Symbol::from(c.to_string()));
        named(text).is_some_and(|(name, right)| {
            let is_new = !self.is_known(&name) && !name.chars().all(known);
            is_new && formula::read(right, &self.symbols(right)).is_ok()
        })
    }

    /// A new name for something: `h = l/2 sin(theta)`; of a chain all further links are judged.
    pub(super) fn definition(&mut self, text: &str) -> Option<Found> {
        let known = |c: char| self.is_known(&Symbol::from(c.to_string()));
        let new = |name: &Symbol| !self.is_known(name) && !name.chars().all(known);
        let (name, right) = named(text).filter(|(name, _)| new(name))?;
        let right = super::super::read::sense(right).map_or(right, |(value, _)| value);
        let measured = || in_unit(right, &self.symbols(right));
        let measured = self.in_units.then(measured).flatten();
        let right = match formula::read(right, &self.symbols(right)) {
            Ok(reading) if measured.is_some() => measured.unwrap_or(reading),
            // Of a normal force that is said nowhere yet, nothing is known.
            Ok(reading) if self.has_normal(right, &reading) => match self.looked_ahead(right) {
                Some(reading) => reading,
                None => {
                    let found = self.definition_by_parts(text);
                    return found.or(Some((Status::Defines, Vec::new())));
                }
            },
            Ok(reading) => reading,
            Err(_) => match self.looked_ahead(right) {
                Some(reading) => reading,
                None => return self.definition_by_parts(text),
            },
        };
        let sides = match &right.content {
            Content::Relations(sides, _) => sides.as_slice(),
            one => std::slice::from_ref(one),
        };
        if self.own.len() >= MOST_NAMES {
            return None;
        }
        let vector = match sides {
            [Content::Vector(v)] => Some(v.clone()),
            [side, ..] if formula::has_arrow(&name) => self.vector(side, true),
            _ => None,
        };
        if let Some(v) = vector {
            return self.own_vector(text, &name, v, &right);
        }
        let values: Option<Vec<&Expr>> = sides.iter().map(Content::expr).collect();
        let values = values?;
        let (first, last) = ((*values.first()?).clone(), (*values.last()?).clone());
        if let Some(true_value) = self.other_inertia(&name, &first) {
            let found = is_other_inertia(&name);
            // A slip in I_G goes on to I_A = I_G + m d².
            let off = |name: &Symbol, truth: &Expr| self.with_own(&Expr::symbol(name)) - truth;
            let mine = self.with_own(&first) - &true_value;
            let mut earlier = self.slipped.iter();
            let cause = earlier.find(|(_, name, truth)| {
                name.starts_with('I') && self.is_zero(&(&off(name, truth) - &mine))
            });
            let cause = cause.map(|(cause, ..)| *cause);
            self.own.insert(name.clone(), last);
            self.slip_above(cause.unwrap_or(self.number), &name, &true_value);
            self.slipped
                .push((cause.unwrap_or(self.number), name, true_value));
            return Some(match cause {
                Some(cause) => (Status::Carried(cause), Vec::new()),
                None => (Status::Wrong, vec![found]),
            });
        }
        if sides.len() == 1 {
            let cause = self.carried.get(&name);
            let status = cause.map_or(Status::Defines, |cause| Status::Carried(*cause));
            self.own.insert(name, last);
            return Some((status, Vec::new()));
        }
        let (links, weighed) = self.weighed_ends(text, &right)?;
        // What is rounded, or cannot be decided, stands for what it was rounded from.
        let exact = !matches!(weighed, Weighed::Slip(_) | Weighed::Carried(_));
        self.own
            .insert(name.clone(), if exact { first.clone() } else { last });
        if let Weighed::Slip(at) = weighed {
            self.note_miscount(text, &links, at);
        }
        let cause = match weighed {
            Weighed::Slip(_) if self.is_unclear(&links) => {
                return Some((Status::Undecided, Vec::new()));
            }
            // `ω_2 = 2 ω = …` of another case.
            Weighed::Slip(_) if self.at_another_moment(&links).is_some() => {
                return Some((Status::Defines, Vec::new()));
            }
            Weighed::Slip(_) => Some(self.number),
            Weighed::Carried(cause) => Some(cause),
            _ => None,
        };
        self.slipped.extend(cause.map(|cause| (cause, name, first)));
        Some(self.defined(text, &right, weighed))
    }

    /// The further links of a definition and what is found of them: of `c = √(2 R h - h²) = 0.3 m` in meters where that holds,
    /// though m be a mass.
    fn weighed_ends(&self, text: &str, right: &Reading) -> Option<(Vec<Link>, Weighed)> {
        let links = self.links(right)?;
        let weighed = self.weigh(text, &links);
        let in_meters = || {
            let (_, sides) = text.split_once('=')?;
            let links = self.links(&self.measured(sides, right)?)?;
            let again = self.weigh(text, &links);
            matches!(again, Weighed::Holds | Weighed::Rounded).then_some((links, again))
        };
        let other = matches!(weighed, Weighed::Slip(_)).then(in_meters);
        Some(other.flatten().unwrap_or((links, weighed)))
    }

    /// A name that is said with a slip below the lines that use it: the one other own name of such a line has the slip as well.
    fn slip_above(&mut self, cause: usize, name: &Symbol, truth: &Expr) {
        let own = |gap: &Expr| {
            gap.symbols()
                .into_iter()
                .filter(|n| self.own.contains_key(n))
        };
        let lines = self.above.iter().filter(|gap| gap.mentions(name));
        let found = lines.filter_map(|gap| {
            let others: Vec<Symbol> = own(gap).filter(|other| other != name).collect();
            let [other] = others.as_slice() else {
                return None;
            };
            let gap = gap.put(name, truth);
            let value = solve_for(&gap, other, &self.sheet.scene.domains)?;
            Some((cause, other.clone(), value))
        });
        let found: Vec<_> = found.collect();
        let names = found.iter().map(|(_, other, _)| (other.clone(), cause));
        self.carried.extend(names);
        self.slipped.extend(found);
    }

    /// A new name for a vector; of a chain all further links are judged.
    fn own_vector(
        &mut self,
        text: &str,
        name: &str,
        value: [Expr; 3],
        right: &Reading,
    ) -> Option<Found> {
        let links = match &right.content {
            Content::Relations(..) => self.links(right)?,
            _ => Vec::new(),
        };
        self.own
            .extend(formula::along_axes(name).into_iter().zip(value));
        let weighed = self.weigh(text, &links);
        Some(match weighed {
            Weighed::Slip(_) if self.holds_there(&links) => (Status::Defines, Vec::new()),
            Weighed::Slip(_) if self.is_of_a_motion(&links) => (Status::Undecided, Vec::new()),
            _ => self.defined(text, right, weighed),
        })
    }

    /// What is found of a definition by its further links.
    fn defined(&self, text: &str, right: &Reading, weighed: Weighed) -> Found {
        let status = match weighed {
            Weighed::Holds | Weighed::Rounded => Status::Defines,
            Weighed::Open => Status::Undecided,
            Weighed::Carried(cause) => Status::Carried(cause),
            Weighed::Slip(at) => {
                let broken = self.broken(right, at, text);
                return (Status::Wrong, broken.into_iter().collect());
            }
        };
        (status, Vec::new())
    }

    /// A chain such as `I_C = I_G + m d^2 = m l^2/12 + m d^2`, where a side has a new name: the other sides say what it is.
    fn definition_by_parts(&mut self, text: &str) -> Option<Found> {
        let (_, right) = text.split_once('=')?;
        self.new_side(right)?;
        self.definition(text)
    }

    /// The one side of a chain that has a new name says what the name stands for by the last of the other sides.
    pub(super) fn new_side(&mut self, text: &str) -> Option<Status> {
        match self.known_sides(text) {
            (known, Some(new)) => self.new_name(&format!("{new} = {}", known.last()?)),
            _ => None,
        }
    }

    /// The sides of a chain that can be read, and the one that cannot.
    fn known_sides<'t>(&self, text: &'t str) -> (Vec<&'t str>, Option<&'t str>) {
        let symbols = self.symbols(text);
        let (known, new): (Vec<&str>, Vec<&str>) =
            text.split('=').map(str::trim).partition(|side| {
                let read = formula::read(side, &symbols);
                read.is_ok_and(|reading| !self.has_normal(side, &reading))
            });
        let only = new.first().filter(|_| new.len() == 1);
        (known, only.copied())
    }

    /// A chain that cannot be read for the sum of two new names in it, `K_1 − K_2 = …`, says what the sum is: its other sides are
    /// judged alone.
    pub(super) fn of_new_names(&mut self, text: &str, fault: Fault) -> Found {
        let (known, new) = self.known_sides(text);
        let sum = new.and_then(|new| formula::read(new, &Symbols::open()).ok());
        let names = sum.as_ref().map(Reading::symbols).unwrap_or_default();
        let sum = sum.as_ref().and_then(Reading::expr).map(Expr::node);
        let is_sum = matches!(sum, Some(Node::Sum(terms)) if terms.len() == 2);
        let are_new = names.len() == 2 && !names.iter().any(|name| self.is_known(name));
        match known.as_slice() {
            [_] if is_sum && are_new => (Status::Defines, Vec::new()),
            [_, _, ..] if is_sum && are_new => self.equation(&known.join(" = ")),
            _ => (Status::Unreadable(fault), Vec::new()),
        }
    }

    /// Whether what was read as newtons is a force by its letter: behind what has no dimension, as in `μ N`.
    pub(super) fn has_normal(&self, text: &str, reading: &Reading) -> bool {
        let force = behind(text, reading).filter(|(from, to)| &text[*from..*to] == "N");
        let measured = force.and_then(|(from, _)| self.measures(text, from));
        measured.is_some_and(|dimension| dimension.is_none())
    }

    /// Whether what was read as a unit behind a formula is a letter: joules measure no length, as in `r J`.
    pub(super) fn is_misfit(&self, text: &str, reading: &Reading) -> bool {
        let unit = behind(text, reading).and_then(|(from, to)| {
            let unit = dimension::unit(text[from..to].trim()).ok()?;
            Some((unit, self.measures(text, from)?))
        });
        unit.is_some_and(|(unit, measured)| unit.dimension != measured)
    }

    /// What the formula before a place measures, back to the sign of equality.
    fn measures(&self, text: &str, to: usize) -> Option<Dimension> {
        let before = text[..to].rsplit(['=', '≈']).next().unwrap_or_default();
        let factor = formula::read(before, &self.symbols(before)).ok()?;
        let of = |name: &str| Some(self.sheet.scene.parameter(name)?.dimension.clone());
        dimension::of(factor.expr()?, &of).ok()?
    }

    /// Whether a line only says that something stays what it is, in names that it never gives: `H_C = H_C'`, `E_1 = E_2`.
    pub(super) fn is_conservation(&self, text: &str) -> bool {
        let letter = |side: &str| {
            let name = formula::read_name(side, &Symbols::open())?;
            (!self.is_known(&name)).then(|| name.chars().next())
        };
        match text.split('=').collect::<Vec<_>>()[..] {
            [a, b] => letter(a).is_some() && letter(a) == letter(b),
            _ => false,
        }
    }

    /// The line that defines a name which lines above it used already.
    pub(super) fn said_before(&mut self, text: &str) -> Option<Found> {
        let (name, _) = named(text)?;
        self.early.remove(&name).then(|| self.own.remove(&name))?;
        self.definition(text)
    }

    /// A line that says anew what an own name of an earlier part stands for, where that may be: `W = …` of the next way. The
    /// name is said in so many words more than once then.
    pub(super) fn said_anew(&mut self, text: &str) -> Option<Found> {
        if !self.anew {
            return None;
        }
        let left = text.split('=').next()?;
        let left = formula::read(left, &self.symbols(left)).ok()?;
        let names = left.symbols().into_iter();
        let name = only(names.filter(|name| self.own.contains_key(name)))?;
        let said = self.ahead.iter().filter(|(other, _)| *other == name);
        if said.count() < 2 || !self.of_earlier_parts.contains(&name) {
            return None;
        }
        let before = self.own.remove(&name);
        let found = match named(text) {
            Some(_) => self.definition(text),
            None => self.new_name(text).map(|status| (status, Vec::new())),
        };
        let found = found.filter(|(status, _)| *status == Status::Defines);
        match found {
            Some(_) => drop(self.of_earlier_parts.remove(&name)),
            None => self.own.extend(before.map(|value| (name, value))),
        }
        found
    }

    /// Whether what holds by what is said further down of the one own name in it says no more than that: however the scene goes it
    /// would hold, and the scene has no such quantity.
    pub(super) fn only_says(&self, all: &[Expr]) -> bool {
        let used: BTreeSet<Symbol> = all.iter().flat_map(Expr::symbols).collect();
        let given = |name: &&Symbol| self.is_given(name) || ***name == *"pi";
        let own = only(used.iter().filter(|name| !given(name)));
        let Some(name) = own.filter(|name| self.early.contains(*name)) else {
            return false;
        };
        let value = self.with_own(&Expr::symbol(name));
        value.symbols().iter().all(|name| given(&name)) && !self.is_of_scene(&value)
    }

    /// Whether a quantity of the scene has a value at some moment, counted either way, or as the size of a velocity.
    fn is_of_scene(&self, value: &Expr) -> bool {
        let moments = self.moments.iter().map(|(_, values)| values);
        let ends = self.ends.iter().map(|(_, values)| values);
        let stands = self.vectors.iter().map(|stand| &stand.values);
        let all = std::iter::once(&self.closed).chain(moments).chain(ends);
        let is_it = |known: &Expr| self.is_zero(&(value.powi(2) - known.powi(2)));
        let size = |values: &Values, name: &Symbol, x: &Expr| {
            let y = values.get(&*format!("{}_y", name.strip_suffix("_x")?))?;
            Some((x.powi(2) + y.powi(2)).sqrt())
        };
        all.chain(stands).any(|values| {
            let mut each = values.iter();
            each.any(|(name, x)| is_it(x) || size(values, name, x).is_some_and(|s| is_it(&s)))
        })
    }

    /// A text with names that are said only further down.
    pub(super) fn looked_ahead(&mut self, text: &str) -> Option<Reading> {
        for _ in 0..8 {
            let symbols = self.symbols(text);
            let (from, to) = match formula::read(text, &symbols) {
                Ok(reading) => match behind(text, &reading) {
                    Some(unit) => unit,
                    None => return Some(reading),
                },
                Err(fault) => (fault.start, fault.end),
            };
            let word = text.get(from..to)?;
            let missing = formula::read_name(word, &Symbols::open());
            let missing = missing.or_else(|| self.new_letter(word));
            let missing = missing.unwrap_or_else(|| Symbol::from(word.trim()));
            if self.own.len() >= MOST_NAMES || self.is_known(&missing) {
                return None;
            }
            if self.said_ahead(&missing, &symbols) {
                continue;
            }
            let value = self.lone_inertia(&missing)?;
            if self.ahead.iter().any(|(name, _)| *name == missing) {
                self.early.insert(missing.clone());
            }
            self.own.insert(missing, value);
        }
        None
    }

    /// Takes what a name is from the line further down that says it: `V = b/2 W`, where W is no watt if `W = 6v/(5b)` is said.
    fn said_ahead(&mut self, name: &Symbol, symbols: &Symbols) -> bool {
        let said = |name: &Symbol| self.ahead.iter().find(|(other, _)| other == name);
        let unit = said(name).and_then(|(_, right)| {
            let reading = formula::read(right, symbols).ok()?;
            let (from, to) = behind(right, &reading)?;
            Some((right.clone(), Symbol::from(&right[from..to])))
        });
        let own =
            unit.filter(|(_, unit)| unit != name && !self.is_known(unit) && said(unit).is_some());
        let symbols = match own {
            Some((right, unit)) if self.taken_ahead(&unit, symbols) => &self.symbols(&right),
            _ => symbols,
        };
        self.taken_ahead(name, symbols)
    }

    fn taken_ahead(&mut self, name: &Symbol, symbols: &Symbols) -> bool {
        let said = self.ahead.iter().find(|(other, _)| other == name);
        let value = said.and_then(|(_, right)| {
            let measured = self.in_units.then(|| in_unit(right, symbols)).flatten();
            let read = measured.or_else(|| formula::read(right, symbols).ok())?;
            match read.content {
                Content::Relations(sides, _) => sides.last()?.expr().cloned(),
                one => one.expr().cloned(),
            }
        });
        let found = value.is_some();
        if let Some(value) = value {
            self.early.insert(name.clone());
            self.own.insert(name.clone(), value);
        }
        found
    }

    /// The one letter of a short run that is no name: `a` in `ma`, where m is one.
    fn new_letter(&self, run: &str) -> Option<Symbol> {
        let letters = run.bytes().all(|b| b.is_ascii_alphabetic());
        let names = run.chars().map(|c| Symbol::from(c.to_string()));
        let (known, new): (Vec<Symbol>, Vec<Symbol>) = names.partition(|name| self.is_known(name));
        match new.as_slice() {
            [name] if letters && run.len() < 4 && !known.is_empty() => Some(name.clone()),
            _ => None,
        }
    }

    /// An equation with one name that is new: it says what the name stands for.
    pub(super) fn new_name(&mut self, text: &str) -> Option<Status> {
        let mut open = Symbols::open();
        if let Some(letter) = self.turning {
            open.declare_typeset(OF_CENTER, letter);
        }
        for p in &self.sheet.scene.parameters {
            open.declare_as(
                p.name.clone(),
                p.latex.as_deref(),
                Some(p.dimension.clone()),
            );
        }
        let known = self.closed.keys().chain(self.own.keys());
        let known = known.filter(|name| self.turning != Some(&***name));
        known.for_each(|name| open.declare(name));
        // No scene has a resistance.
        open.declare(&Symbol::from("Omega"));
        let reading = formula::read(text, &open).ok()?;
        let product = |n: &formula::Note| {
            text.get(n.start..n.end)
                .is_some_and(|run| self.new_letter(run).is_some())
        };
        let letters = reading
            .notes
            .iter()
            .any(|n| n.remark == formula::Remark::Letters && !product(n));
        let mut new: Vec<Symbol> = reading.symbols().into_iter().collect();
        new.retain(|name| !self.is_known(name));
        let symbols = self.symbols(text);
        // What the scene has, with a mark, is not new.
        let is_read = |name: &Symbol| {
            let read = formula::read_name(&formula::latex_name(name), &symbols);
            read.is_some_and(|read| self.closed.contains_key(&read))
        };
        if new.iter().any(is_read) {
            return None;
        }
        if new.len() > 1 {
            new.retain(|name| !self.said_ahead(name, &symbols));
        }
        let ([name], false, true) = (new.as_slice(), letters, self.own.len() < MOST_NAMES) else {
            return None;
        };
        // Gravity is no name of one's own: through an impact no equation says what it is.
        if &**name == "g" {
            return None;
        }
        let [link] = &self.links(&reading)?[..] else {
            return None;
        };
        // A name with a slip stays, so that what hangs on it can be told.
        let slipped = self.slipped.iter();
        let slipped = slipped.map(|(_, name, value)| (name.clone(), value.clone()));
        let one = self.with_own_but(link.gap()?, &slipped.collect());
        let domains = &self.sheet.scene.domains;
        let mut ways = [solve_for, size_in, angle_in, below_in].into_iter();
        let value = ways.find_map(|way| way(&one, name, domains))?;
        self.above.extend(link.gap().cloned());
        self.own.insert(name.clone(), value);
        Some(Status::Defines)
    }
}
