//! A line of a solution, equation by equation: what is found of it, and what later lines may hang on.

use std::collections::BTreeMap;

use super::super::sheet::judge;
use super::super::{Diagnosis, read};
use super::link::Values;
use super::link::{self, Link, Weighed};
use super::{CONDITION, Desk, Found, MOMENT, Needed, Status, arrows, names, open, text};
use crate::expr::{Expr, Symbol};
use crate::formula::{self, Reading};
use crate::scene::Ask;

/// A side with the sign by which its name counts.
type Turn<'t> = Box<dyn Fn(&str) -> Option<String> + 't>;

impl Desk<'_> {
    /// A line is as good as its worst equation.
    pub(super) fn line(&mut self, text: &str) -> Found {
        if let Some(status) = self.in_case(text) {
            return (status, Vec::new());
        }
        if let Some(status) = self.equivalence(text) {
            return (status, Vec::new());
        }
        let mut line = (Status::Comment, Vec::new());
        for equation in text::equations(text) {
            if self.is_supposed(text, equation) {
                continue;
            }
            let sensed = text::with_direction(text, equation);
            let sensed = sensed.and_then(|equation| self.with_sense(&equation));
            let turned = sensed.or_else(|| self.with_sense(equation));
            let equation = turned.as_deref().unwrap_or(equation);
            let arrowed = self.with_arrows_at_dots(equation);
            let equation = arrowed.as_deref().unwrap_or(equation);
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

    pub(super) fn equation(&mut self, text: &str) -> Found {
        if let Some(found) = self.said_before(text) {
            return found;
        }
        // `v = 20 m/s` of data, though v be sought as well and m be a mass.
        if let Some((name, value)) = super::pages::number(self.sheet, text)
            && self.sheet.scene.values().get(&name) == Some(&value)
        {
            return (Status::Holds, Vec::new());
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
            Ok(reading) => self.in_its_unit(text, &reading).unwrap_or(reading),
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
                let near = text::near(&fault, text).is_some_and(|meant| !self.is_own(meant));
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
                            Err(fault) => return self.of_new_names(text, fault),
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
        // Other lines hold with another value of a name that nothing else explains.
        if let (Status::Wrong, Some((name, _)), true) =
            (&found.0, names::named(text), found.1.is_empty())
            && self.bound.contains(&name)
            && let Some(value) = self.closed.get(&name)
        {
            let value = formula::write_plain(value);
            let words = format!("the lines that use {name} hold with {name} = {value}");
            let hint = "what belongs to it, and about which point is it taken?";
            found.1.push(Diagnosis::new("OWN_VALUE", words, hint));
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

    /// Whether a name that looks like one that is known is beside one of the student's own, as V_y beside V_x: no slip of the pen.
    fn is_own(&self, meant: &str) -> bool {
        let plain = |name: &str| name.replace('_', "");
        self.own.keys().any(|own| plain(own) == plain(meant))
    }

    /// `ω = 3v/(4a) clockwise` and `P_y = m v downwards` with the sign by which the name counts, on every side.
    fn with_sense(&self, text: &str) -> Option<String> {
        let (name, right) = names::named(text)?;
        // `P_C_y` is a component of P_C.
        let left = text.split('=').next().unwrap_or_default().trim();
        let name = formula::read_name(left, &self.symbols(text)).unwrap_or(name);
        let (values, senses) = read::sense(right)?;
        let word = right[values.len()..].trim_start_matches([' ', ',', '(']);
        let plain = name.trim_end_matches(['\'', '^', '+']);
        let mut questions = self.sheet.scene.questions.iter();
        let asked = questions.find_map(|q| Some((q.ask.clone(), q.part(plain)?)));
        let one: Turn = match asked {
            Some((Ask::Spin { .. }, _)) => {
                let mut spins = self.spins.values();
                let (_, clockwise) = spins.find(|(spin, _)| **spin == *plain)?;
                let same = (senses[2] < 0) == *clockwise;
                let turns = senses[2] != 0;
                Box::new(move |side| turns.then(|| read::with_sign(side, same)))
            }
            Some((ask, component)) => {
                Box::new(move |side| judge::in_words(&ask, component, &format!("{side} {word}")))
            }
            None => {
                let same = senses[self.axis(&name)?];
                Box::new(move |side| (same != 0).then(|| read::with_sign(side, same > 0)))
            }
        };
        // `v = -√(2 g h) (downwards)`: the word behind says why there is a minus, and turns nothing round once more.
        let explains = right[values.len()..].trim_start().starts_with(['(', ','])
            && senses.iter().any(|s| *s < 0);
        let size = |side: &str| match side.trim().strip_prefix(['-', '−']) {
            Some(size) if explains && !size.contains(['+', '-', '−', '±', '∓']) => {
                size.to_owned()
            }
            _ => side.to_owned(),
        };
        let sides: Option<Vec<String>> = values.split('=').map(|side| one(&size(side))).collect();
        let name = if self.of_bodies.contains_key(&name) {
            &name
        } else {
            plain
        };
        Some(format!("{name} = {}", sides?.join(" = ")))
    }

    /// Along which axis a name counts that is known and that nobody asks for: x, y, or that of a spin.
    fn axis(&self, name: &Symbol) -> Option<usize> {
        let known = self.closed.contains_key(name);
        let of_body = self.of_bodies.get(name).map(|(_, part)| *part);
        of_body.or_else(|| match name.chars().last()? {
            'x' if known => Some(0),
            'y' if known => Some(1),
            _ => None,
        })
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
        if fails && let Some(found) = self.told_condition(reading, &links, &weighed) {
            return found;
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
                let shown = super::super::show(&other.content);
                // `t = 0.35 s`, where s is asked as well, reads the same either way.
                let message = match shown == text.trim() {
                    true => "holds when what stands behind its number is the unit".to_string(),
                    false => format!("holds when read as {shown}"),
                };
                let hint = "this line can be read in two ways; use brackets to say which is meant";
                let found = match again {
                    Weighed::Carried(cause) => self.carried_belief(&other, cause),
                    _ => vec![Diagnosis::new("AMBIGUOUS", message, hint)],
                };
                return (self.note(&other, &links, &again), found);
            }
        }
        if let Weighed::Slip(at) = weighed {
            self.note_coarse(text);
            self.note_miscount(text, &links, at);
        }
        let status = self.note(reading, &links, &weighed);
        let found = match weighed {
            Weighed::Slip(at) => match self.diagnosis(reading, at, text) {
                found if found.is_empty() => self.supposes(&links).into_iter().collect(),
                found => found,
            },
            Weighed::Holds if link::in_vectors(&links) => {
                self.count(&links, &BTreeMap::new());
                let says = self.says_enough(&links, &self.parts, false);
                (!says).then(open::vanishes).into_iter().collect()
            }
            Weighed::Carried(cause) => self.carried_belief(reading, cause),
            Weighed::Holds | Weighed::Rounded => self.only_under(&links).into_iter().collect(),
            Weighed::Open => Vec::new(),
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
    pub(super) fn note(&mut self, reading: &Reading, links: &[Link], weighed: &Weighed) -> Status {
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
                let own: Vec<_> = own.collect();
                if own.iter().any(|name| self.early.contains(name)) {
                    self.above.extend(all.iter().cloned());
                }
                let only_says = self.only_says(&all);
                self.proved.extend(own);
                self.carry(reading);
                self.state(None, &all);
                match only_says {
                    true => Status::Defines,
                    false => Status::Holds,
                }
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
