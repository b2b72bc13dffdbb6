//! Runs of letters: functions, declared words, Greek names and single letters, resolved against the symbols in play.

use super::fault::{Fault, Faulty};
use super::lexer::Lexer;
use super::note::Remark;
use super::symbols::name;
use super::symbols::{Parts, among, both, is_greek, letters_at};
use super::token::{Before, Literal, Pair, Tok, function};
use crate::expr::{Function, Symbol, ratio};

/// Most different names in one formula.
const MAX_NAMES: usize = 256;
/// What makes bold letters vectors: their products, and bars around them.
const SIGNS_OF_VECTORS: [&str; 8] = ["\\times", "×", "\\cdot", "·", "|", "‖", "\\lVert", "\\|"];
/// Functions that are not read, with brackets behind their names.
const OTHER_FUNCTIONS: &str = "max min hypot floor ceil round trunc erf erfc gcd lcm mod sinc mean avg sum conj conjugate arg int \
    integrate diff matrix heaviside Heaviside determinant trace transpose imag real cross dot lim limit solve factorial lambertw";
/// Most faults reported together.
const MAX_FAULTS: usize = 8;

impl Lexer<'_> {
    /// A run of letters: a function, a declared word, a Greek name, or the first letter alone.
    pub(super) fn word(&mut self, single: bool) -> Faulty<Tok> {
        let start = self.pos;
        let rest = &self.text[start..];
        if single {
            let parts = Parts::of(rest[..1].to_string());
            return self.resolve(start, start + 1, parts);
        }
        // A longer run is read in pieces.
        let run = letters_at(rest).min(64);
        if letters_at(&rest[run..]) > 0 {
            let message = "a run of more than 64 letters is no name and no product";
            return Err(Fault::new(message, start, start + run));
        }
        if !(start > 0 && self.text.as_bytes()[start - 1].is_ascii_alphabetic()) {
            self.run_from = start;
        }
        if self.before != Before::Nothing {
            let word = &rest[..run];
            let degrees =
                matches!(word, "deg" | "degree" | "degrees") && self.symbols.find(word).is_none();
            let behind = rest[run..].trim_start();
            if degrees && !behind.starts_with('/') && !behind.starts_with("per ") {
                self.pos += run;
                return Ok(Tok::Degree);
            }
            let percent = ["percent", "per cent", "pct"].into_iter().find(|said| {
                let behind = rest.strip_prefix(said);
                behind.is_some_and(|b| !b.starts_with(|c: char| c.is_alphanumeric()))
            });
            if let Some(said) = percent
                && self.symbols.find(word).is_none()
            {
                return self.percent(start, said.len(), 100);
            }
            if let Some(tok) = self.unit(false) {
                return Ok(tok);
            }
        }
        if let Some((name, end)) = self.bare_name(start) {
            self.pos = end;
            return Ok(Tok::Name(name));
        }
        if let Some(tok) = self.spelled_out(start) {
            return Ok(tok);
        }
        // A letter behind a digit belongs to a name with an index that was declared so: `v1f_y`.
        let of_name = |b: &u8| b.is_ascii_alphanumeric() || *b == b'_';
        let whole = &rest[..rest.bytes().take_while(of_name).count()];
        let base = whole.split_once('_').map_or("", |(base, _)| base);
        if base.ends_with(|c: char| c.is_ascii_alphabetic())
            && base.contains(|c: char| c.is_ascii_digit())
            && let Some(declared) = self.symbols.find(whole)
        {
            self.pos = start + whole.len();
            return Ok(Tok::Name(declared.name.clone()));
        }
        if rest.starts_with('d')
            && !matches!(self.text.as_bytes().get(start + 1), Some(b'_' | b'\''))
        {
            if let Some(derivative) = self.derivative() {
                return derivative;
            }
            if self.differentials()
                && let Some(behind) = rest[1..].chars().next()
                && (behind.is_alphabetic() || behind == '\\')
                && let Some(named) = self.differential_alone(start, start + 1)
            {
                return named;
            }
        }
        // No μ and no ν begin these.
        if matches!(&rest[..run], "must" | "number") && self.symbols.find(&rest[..run]).is_none() {
            self.note(Remark::Letters, start, start, start + run);
        }
        if let Some(tok) = self.known_word(start, run)? {
            return Ok(tok);
        }
        let indexed = rest[1..].starts_with(|c: char| c == '_' || c.is_ascii_digit());
        if !indexed && let Some(axis) = self.symbols.axis(&rest[..1]) {
            self.pos = start + 1;
            return Ok(Tok::Name(axis.into()));
        }
        if self.symbols.is_open() {
            if (run > 2 || matches!(&rest[..run], "is" | "so"))
                && self.before == Before::Nothing
                && !self.notes.iter().any(|n| n.end >= start + run)
            {
                self.note(Remark::Letters, start, start, start + run);
            }
            return self.name(start, start + 1);
        }
        self.unknown_word(start, run)
    }

    /// The longest beginning of a run of letters that is a name, a function or a Greek letter.
    fn known_word(&mut self, start: usize, run: usize) -> Faulty<Option<Tok>> {
        let rest = &self.text[start..];
        for length in (1..=run.min(self.symbols.longest_word())).rev() {
            let word = &rest[..length];
            let base = length == 1 || self.symbols.has_base(word) && !self.symbols.is_product(word);
            if base && let Some(tok) = self.declared_name(start, start + length) {
                return Ok(Some(tok));
            }
            if length < 2 {
                break;
            }
            let signum = matches!(word, "sgn" | "sign" | "signum");
            if signum && rest[length..].starts_with('(') && self.symbols.find(word).is_none() {
                self.pos = start + length;
                return Ok(Some(Tok::Signum));
            }
            let behind = rest[length..].trim_start_matches([' ', '(']);
            let matrix = behind.starts_with("[[") || behind.starts_with("\\begin{");
            if word == "det" && matrix && self.symbols.find(word).is_none() {
                self.pos = start + length;
                return Ok(Some(Tok::Determinant));
            }
            let called = rest[length..].starts_with('(') && self.symbols.find(word).is_none();
            if called && matches!(word, "binomial" | "binom" | "choose" | "nCr") {
                self.pos = start + length;
                return self.binomial_of_list(start).map(Some);
            }
            if called && word == "norm" && !self.is_product(word) {
                self.pos = start + length;
                return Ok(Some(Tok::Call(Function::Abs)));
            }
            let two = usize::from(rest[length..].starts_with("2("));
            let pair = Pair::named(&rest[..length + two]);
            let argued = rest[length + two..].starts_with('(');
            if let Some(pair) = pair
                && argued
                && self.symbols.find(word).is_none()
                && (pair == Pair::Root
                    || self.outside(start + length + two + 1, b',', b"").is_some())
            {
                self.pos = start + length + two;
                return Ok(Some(Tok::Pair(pair)));
            }
            if length == run && start == self.run_from && self.is_no_value(word) {
                let message = format!("`{word}` is no value that is read here");
                return Err(Fault::new(message, start, start + length));
            }
            if self.is_other_function(start, length) {
                let two = rest[length..].starts_with("2(");
                let end = start + length + usize::from(two);
                let shown = &self.text[start..end];
                let message = format!("`{shown}` is no function that is read here");
                return Err(Fault::new(message, start, end));
            }
            if let Some(tok) = function(word) {
                if !self.function_wanted(word, start) {
                    continue;
                }
                self.pos = start + length;
                return Ok(Some(self.based(word, tok, start)));
            }
            let alone = length == run && start == self.run_from;
            if word.eq_ignore_ascii_case("zero") && alone && self.symbols.find(word).is_none() {
                self.pos = start + length;
                return Ok(Some(Tok::Number(Literal::of(ratio(0, 1)))));
            }
            let capital = word == "Pi" || word == "PI" && alone;
            let spelled = capital && self.symbols.find(word).is_none() && !self.has_letter_of(word);
            if word == "pi" || spelled {
                self.pos = start + length;
                return Ok(Some(Tok::Name("pi".into())));
            }
            if is_greek(word) || word == "ell" {
                if let Some(tok) = self.declared_name(start, start + length) {
                    return Ok(Some(tok));
                }
                // `mu` is m·u where m and u are names and μ is none.
                let letters = || (0..length).all(|at| self.symbols.find(&word[at..=at]).is_some());
                // And `Delta E` may be declared as a whole.
                let is_change = matches!(word, "Delta" | "delta");
                if (self.symbols.is_open() || is_change) && !letters() {
                    return self.name(start, start + length).map(Some);
                }
            }
        }
        Ok(None)
    }

    /// A name of one letter, or a letter with digits, with nothing behind it that could belong to the name, and the byte after
    /// it: most names are such.
    fn bare_name(&mut self, start: usize) -> Option<(Symbol, usize)> {
        let digits = self.text[start + 1..].bytes().take(9);
        let end = start + 1 + digits.take_while(u8::is_ascii_digit).count();
        let rest = &self.text[end..];
        let closes = |text: &str| {
            let next = text.trim_start_matches(' ').bytes().next();
            next.is_none_or(|b| b"+-*/)}=".contains(&b))
        };
        let indexed = |text: &str| text.trim_start_matches(' ').starts_with('_');
        // A d could be that of a derivative.
        let free = |text: &str| match self.text[start..].starts_with('d') {
            true => closes(text),
            false => !indexed(text),
        };
        let ends = match rest.bytes().next() {
            Some(b' ') => free(rest),
            Some(b'^') => {
                let power = rest[1..].strip_prefix(|c: char| c.is_ascii_digit());
                power.is_some_and(free)
            }
            _ => closes(rest),
        };
        let inside = start > 0 && self.text.as_bytes()[start - 1].is_ascii_alphabetic();
        if !ends || inside {
            return None;
        }
        let name = &self.text[start..end];
        if let Some(declared) = self.symbols.find(name) {
            return Some((declared.name.clone(), end));
        }
        if let Some(found) = self.found.iter().find(|found| ***found == *name) {
            return Some((found.clone(), end));
        }
        // With names declared it could be another spelling of one.
        let new = self.symbols.is_open() && self.symbols.declared().is_empty();
        if !new || self.found.len() >= MAX_NAMES || self.symbols.axis(name).is_some() {
            return None;
        }
        self.found.push(Symbol::from(name));
        self.found.last().map(|found| (found.clone(), end))
    }

    /// A logarithm to the base behind it: `log_10 x`, `\log_{2}(x)`, `log10(x)`; without one it is the natural one.
    pub(super) fn based(&mut self, word: &str, tok: Tok, start: usize) -> Tok {
        if !word.eq_ignore_ascii_case("log") || tok != Tok::Call(Function::Ln) {
            return tok;
        }
        let rest = self.text[self.pos..].trim_start_matches(' ');
        let index = rest.strip_prefix('_').map(|i| i.trim_start_matches(' '));
        let inside = index.unwrap_or(rest);
        let braced = index.and_then(|i| i.strip_prefix('{'));
        let digits = braced.unwrap_or(inside);
        let attached = rest.len() == self.text.len() - self.pos;
        for (sign, base) in [("₁₀", 10), ("₂", 2)] {
            if let Some(behind) = rest.strip_prefix(sign) {
                self.pos = self.text.len() - behind.len();
                return Tok::Logarithm(base);
            }
        }
        let count = digits.bytes().take_while(u8::is_ascii_digit).count();
        // In TeX an index without braces is one digit; `\log_10` means ten to whoever types it.
        let behind = &digits[count..];
        let closed = match (braced, index) {
            (Some(_), _) => behind.strip_prefix('}'),
            (None, Some(_)) => Some(behind),
            // `log10(x)` and `log10 x`, while `log 2(a+b)` is the logarithm of a product.
            (None, None) => Some(behind).filter(|b| {
                let parted = b.strip_prefix(' ').map(|b| b.trim_start_matches(' '));
                let argued = parted.is_some_and(|b| {
                    b.starts_with(|c: char| c.is_alphanumeric() || c == '(' || c == '\\')
                });
                b.starts_with(['(', '['])
                    || attached && matches!(&digits[..count], "2" | "10") && argued
            }),
        };
        let euler = ["_e", "_{e}"].iter().find_map(|e| rest.strip_prefix(e));
        if let Some(behind) = euler.filter(|b| !b.starts_with(|c: char| c.is_alphanumeric()))
            && self.symbols.find("e").is_none()
        {
            self.pos = self.text.len() - behind.len();
            return tok;
        }
        match (digits[..count].parse::<i64>(), closed) {
            (Ok(base @ 2..=1_000), Some(behind)) => {
                self.pos = self.text.len() - behind.len();
                Tok::Logarithm(base)
            }
            _ => match index {
                Some(index) => {
                    self.pos = self.text.len() - index.len();
                    self.single = !index.starts_with('{');
                    Tok::LogarithmTo
                }
                None => {
                    self.note(Remark::NaturalLogarithm, start, start, self.pos);
                    tok
                }
            },
        }
    }

    /// A function that carom does not know, with its brackets: it is no product of its letters, unless all are declared
    /// and no comma is inside.
    fn is_other_function(&self, start: usize, length: usize) -> bool {
        let word = &self.text[start..start + length];
        let behind = &self.text[start + length..];
        let known = match word {
            "mod" if behind.starts_with(' ') => self.before != Before::Nothing,
            "atan" | "exp" => behind.starts_with("2("),
            // γ times a number stands behind it, or with a sign.
            "gamma" | "Gamma" => behind
                .strip_prefix('(')
                .and_then(|inside| inside.split_once(')'))
                .is_some_and(|(inside, _)| !inside.is_empty() && is_number(inside)),
            // `re(…)` and `tr(…)` may be products of two symbols.
            _ => behind.starts_with('(') && among(OTHER_FUNCTIONS, word),
        };
        let listed = || self.outside(start + length + 1, b',', b"").is_some();
        let declared = self.symbols.find(word).is_some();
        known && !declared && (listed() || !self.is_product(word))
    }

    /// Whether a letter of a word is declared.
    fn has_letter_of(&self, word: &str) -> bool {
        (0..word.len()).any(|at| self.symbols.find(&word[at..=at]).is_some())
    }

    /// Whether all letters of a word are declared.
    fn is_product(&self, word: &str) -> bool {
        (0..word.len()).all(|at| self.symbols.find(&word[at..=at]).is_some())
    }

    /// Whether a word says that there is no number.
    fn is_no_value(&self, word: &str) -> bool {
        let small = word.to_ascii_lowercase();
        among(
            "nan inf infinity infty undefined none nothing solution solutions",
            &small,
        ) && self.symbols.find(word).is_none()
            && !self.is_product(word)
    }

    /// A declared name with several indices, written exactly so: `v_bat_x` stays one name where `vb` is declared too.
    fn spelled_out(&mut self, start: usize) -> Option<Tok> {
        let is_part = |b: &u8| b.is_ascii_alphanumeric() || *b == b'_';
        let bytes = self.text.as_bytes();
        if start > 0 && is_part(&bytes[start - 1]) {
            return None;
        }
        let length = bytes[start..]
            .iter()
            .take(100)
            .take_while(|b| is_part(b))
            .count();
        let word = &self.text[start..start + length];
        let marked = bytes.get(start + length) == Some(&b'\'');
        if marked || word.bytes().filter(|b| *b == b'_').count() < 2 {
            return None;
        }
        let found = self.symbols.find(word).filter(|d| *d.name == *word)?;
        let tok = Tok::Name(found.name.clone());
        self.pos = start + length;
        Some(tok)
    }

    /// `asin` is the arcsine unless `a` is declared and the other reading is asked for; `Asin`, where A is a name or none is
    /// declared, is a product: no function begins with a capital letter alone.
    pub(super) fn function_wanted(&mut self, word: &str, start: usize) -> bool {
        // `lg` and `tg` are products where nothing is declared, or one of their letters is, or no argument follows.
        if matches!(word, "lg" | "tg") {
            let free = |at: usize| self.symbols.find(&word[at..=at]).is_none();
            let behind = &self.text[start + word.len()..];
            let argued = behind.starts_with([' ', '(', '\\', '{']) && behind.trim() != "";
            // No product ends in a number: `lg 1000`, `lg(0.1)`, and not `lg(1-e)`.
            let number = behind.trim_start().trim_start_matches('(');
            let digits = number.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.');
            let whole = digits.starts_with(')') || !behind.contains('(');
            if argued && digits.len() < number.len() && whole && free(0) && free(1) {
                return true;
            }
            return argued && !self.symbols.declared().is_empty() && free(0) && free(1);
        }
        let (letter, trigonometric) = word.split_at(1);
        let arc = matches!(trigonometric, "sin" | "cos" | "tan" | "cot" | "sec" | "csc");
        let declared = self.symbols.find(letter).is_some();
        match letter {
            "A" if arc => return !declared && !self.symbols.is_open(),
            "a" if arc && declared => {}
            _ => return true,
        }
        let usual = self.usual();
        self.note(
            Remark::ArcOrFactor { arc: usual },
            start,
            start + 1,
            start + word.len(),
        );
        usual
    }

    pub(super) fn unknown_word(&mut self, start: usize, run: usize) -> Faulty<Tok> {
        // `3v/2ℓ rad/s`: the unit behind a name.
        if self.units_first
            && self.after_value
            && let Some(tok) = self.unit(false)
        {
            return Ok(tok);
        }
        // A word that starts with declared letters is one fault, not a product and a fault.
        let from = self.run_from.min(start);
        let (start, run) = (from, run + start - from);
        let mut parts = Parts::of(self.text[start..start + run].to_string());
        let mut took = false;
        let end = name::tail(
            self.text,
            start + run,
            &mut parts,
            self.symbols,
            false,
            &mut took,
        );
        self.refuse(&parts.key(), start, end)
    }

    /// A declared component of what has no name as a whole.
    fn part_of(&self, key: &str, axis: &str) -> Option<String> {
        let name = format!("{key}_{axis}");
        let mut declared = self.symbols.declared().iter();
        declared.any(|d| *d.name == *name).then_some(name)
    }

    /// Notes an undeclared name and goes on with it, so that all are reported together.
    pub(super) fn refuse(&mut self, key: &str, start: usize, end: usize) -> Faulty<Tok> {
        if self.symbols.is_brief() {
            return Err(Fault::new("a name is not declared", start, end));
        }
        let shown = &self.text[start..end];
        let small = shown.to_lowercase();
        let mut fault = Fault::new(format!("`{shown}` is not declared"), start, end);
        let letters = shown.len() > 1 && shown.chars().all(char::is_alphabetic);
        if letters && small != shown && crate::dimension::unit(&small).is_ok() {
            fault = fault.hint(format!("the unit is {small}"));
        } else if let [Some(x), Some(y)] = ["x", "y"].map(|axis| self.part_of(key, axis)) {
            fault = fault.hint(format!("it is a vector: its components are {x} and {y}"));
        } else if let Some(nearest) = self.symbols.nearest(key) {
            fault = fault.hint(format!("did you mean {nearest}?"));
        } else {
            let mut names: Vec<&str> = Vec::new();
            for declared in self.symbols.declared() {
                if !names.contains(&&*declared.name) {
                    names.push(&declared.name);
                }
            }
            if (1..=24).contains(&names.len()) {
                fault = fault.hint(format!("declared are {}", names.join(", ")));
            }
        }
        if self.unknown.len() >= MAX_FAULTS {
            return Err(fault);
        }
        self.unknown.push(*fault);
        self.pos = end;
        Ok(Tok::Name(key.into()))
    }

    /// A declared name whose base is these bytes.
    pub(super) fn declared_name(&mut self, start: usize, end: usize) -> Option<Tok> {
        let mut parts = Parts::of(self.text[start..end].to_string());
        let at = name::combining(self.text, end, &mut parts);
        let mut took = false;
        let stop = name::tail(self.text, at, &mut parts, self.symbols, false, &mut took);
        let found = name::find(&parts, self.symbols)?.name.clone();
        self.pos = stop;
        if let Some(Ok(tok)) = self.of_time(start, stop, &parts) {
            return Some(tok);
        }
        Some(Tok::Name(found))
    }

    /// A name whose base starts here; `end` bounds a base of plain letters.
    pub(super) fn name(&mut self, start: usize, end: usize) -> Faulty<Tok> {
        let mut parts = Parts::default();
        let plain = self.text[start..end]
            .bytes()
            .all(|b| b.is_ascii_alphabetic());
        let at = if plain {
            parts.base = self.text[start..end].to_string();
            if parts.base == "ell" {
                parts.base = "l".into();
            }
            name::combining(self.text, end, &mut parts)
        } else {
            match name::base(self.text, start, &mut parts, 0) {
                Some(at) => at,
                None => return Err(Fault::new("this is no name I can read", start, end)),
            }
        };
        self.finish(start, at, parts)
    }

    /// Reads index and marks behind a base and resolves the name.
    pub(super) fn finish(&mut self, start: usize, at: usize, parts: Parts) -> Faulty<Tok> {
        if let Some(change) = self.change(&parts, start, at) {
            return change;
        }
        let mut whole = parts.clone();
        let mut took = false;
        let mut stop = name::tail(self.text, at, &mut whole, self.symbols, false, &mut took);
        if took {
            let usual = self.usual();
            if !usual {
                whole = parts;
                stop = name::tail(self.text, at, &mut whole, self.symbols, true, &mut took);
            }
            self.note(Remark::Component { one: usual }, start, start, stop);
        }
        stop = self.raised_first(stop, &mut whole);
        if let Some(value) = self.of_time(start, stop, &whole) {
            return value;
        }
        self.resolve(start, stop, whole)
    }

    /// `v^2_0`, `v²₀` and `v^{\prime\,2}`: an exponent before the rest of the name, which is read behind it.
    fn raised_first(&mut self, at: usize, parts: &mut Parts) -> usize {
        let rest = &self.text[at..];
        let (inside, behind) = match (rest.strip_prefix('^'), rest.strip_prefix("^{")) {
            (_, Some(inside)) => match inside.split_once('}') {
                Some(pair) => pair,
                None => return at,
            },
            (Some(rest), None) => {
                let digit = rest.starts_with(|c: char| c.is_ascii_digit());
                rest.split_at(digit.into())
            }
            (None, None) => match (rest.strip_prefix('²'), rest.strip_prefix('³')) {
                (Some(behind), _) => ("2", behind),
                (_, Some(behind)) => ("3", behind),
                _ => return at,
            },
        };
        let prime = inside.trim_start().strip_prefix("\\prime");
        let digits: String = prime
            .unwrap_or(inside)
            .chars()
            .filter(|c| !matches!(c, ' ' | '\\' | ','))
            .collect();
        let Some(power) = digits.parse::<u8>().ok().filter(|k| *k > 0) else {
            return at;
        };
        let mut end = self.text.len() - behind.len();
        let index = |c: char| c == '_' || name::lowered(c).is_some();
        let indexed = behind.trim_start_matches(' ').starts_with(index) && parts.index.is_empty();
        if prime.is_none() && !indexed {
            return at;
        }
        let mut read = parts.clone();
        if prime.is_some() {
            read.marks.push('\'');
        }
        if indexed {
            end = name::tail(self.text, end, &mut read, self.symbols, false, &mut false);
        }
        *parts = read;
        let power = crate::expr::ratio(i64::from(power), 1);
        self.pending = Some(Tok::Raised(power));
        end
    }

    /// `v(t_1)` and `v(0)`: the value of v at a time, no product; where v or the time is declared, `v(t_1)` is one. So is
    /// `f(x)`, a letter that is used for functions with the letter they are of, and `U(r) = …`, of what its right side has. At
    /// the start of an equation `v(t) =` says what v is.
    fn of_time(&mut self, start: usize, at: usize, parts: &Parts) -> Option<Faulty<Tok>> {
        let inside = self.text[at..].strip_prefix('(')?;
        let (inside, behind) = inside.split_once(')')?;
        let (time, stop) = (inside.trim(), at + inside.len() + 2);
        if parts.base == "t" {
            return None;
        }
        let mut when = Parts::default();
        if time == "0" {
            when.base.push('0');
        } else {
            let end = name::base(time, 0, &mut when, 0)?;
            let end = name::tail(time, end, &mut when, self.symbols, false, &mut false);
            let alone = !(start > 0 && self.text.as_bytes()[start - 1].is_ascii_alphabetic());
            let function = matches!(&*parts.base, "f" | "g" | "h" | "F" | "G") && alone;
            let of_place = function && matches!(time, "x" | "y" | "z") || said_of(time, behind);
            if end != time.len() || when.base != "t" && !of_place {
                return None;
            }
            let of_all = time == "t" || of_place;
            if of_all && self.count == 1 && alone && behind.trim_start().starts_with('=') {
                return Some(self.resolve(start, stop, parts.clone()));
            }
        }
        let whole = Parts::of(format!("{}({})", parts.key(), when.key()));
        let declared = |parts: &Parts| name::find(parts, self.symbols).is_some();
        let factor = !self.symbols.is_open() || declared(parts) || declared(&when);
        if time != "0" && factor && !declared(&whole) {
            return None;
        }
        Some(self.resolve(start, stop, whole))
    }

    /// Looks a complete name up.
    pub(super) fn resolve(&mut self, start: usize, stop: usize, whole: Parts) -> Faulty<Tok> {
        self.pos = stop;
        if let Some(found) = name::find(&whole, self.symbols) {
            return Ok(Tok::Name(found.name.clone()));
        }
        let crossed = || (SIGNS_OF_VECTORS.iter()).any(|sign| self.text.contains(sign));
        let whole = match both("vec", whole.accent).filter(|_| whole.bold && self.symbols.is_open())
        {
            Some(accent) if crossed() => Parts { accent, ..whole },
            _ => whole,
        };
        let key = whole.key();
        if let Some(vector) = unit_vector(&key).or_else(|| self.symbols.axis(&key)) {
            return Ok(Tok::Name(vector.into()));
        }
        if !self.symbols.is_open() {
            return self.refuse(&key, start, stop);
        }
        if let Some(known) = self.found.iter().find(|name| ***name == *key) {
            return Ok(Tok::Name(known.clone()));
        }
        if self.found.len() >= MAX_NAMES {
            return Err(Fault::new(
                format!("a formula has at most {MAX_NAMES} different names"),
                start,
                stop,
            ));
        }
        let name = Symbol::from(key.as_str());
        self.found.push(name.clone());
        Ok(Tok::Name(name))
    }

    /// `{v}_{1}`: a name in braces whose index stands outside.
    pub(super) fn braced_name(&mut self) -> Option<Tok> {
        let start = self.pos;
        let mut parts = Parts::default();
        let at = name::base(self.text, start, &mut parts, 0)?;
        let behind = self.text[at..].chars().next();
        if !matches!(behind, Some('_' | '\'' | '′'))
            || parts.base.len() > 1 && !is_greek(&parts.base)
        {
            return None;
        }
        let found = self.finish(start, at, parts).ok();
        if found.is_none() {
            self.pos = start;
        }
        found
    }
}

/// Whether a name stands on the right side of the equation that goes on with a text: `= -k/r` says of r what something is.
fn said_of(name: &str, behind: &str) -> bool {
    let Some(right) = behind.trim_start().strip_prefix('=') else {
        return false;
    };
    match name.starts_with('\\') {
        true => right.contains(name),
        // No letter of a command.
        false => right.split('\\').enumerate().any(|(i, part)| {
            let command = part.trim_start_matches(|c: char| c.is_ascii_alphabetic());
            (if i == 0 { part } else { command }).contains(name)
        }),
    }
}

/// The unit vector an accented name means, where it is not declared as something else.
pub(super) fn unit_vector(key: &str) -> Option<&'static str> {
    Some(match key {
        "i_hat" | "i_vec" | "x_hat" | "e_hat_x" | "e_vec_x" => "i_hat",
        "j_hat" | "j_vec" | "y_hat" | "e_hat_y" | "e_vec_y" => "j_hat",
        "k_hat" | "k_vec" | "z_hat" | "e_hat_z" | "e_vec_z" => "k_hat",
        _ => return None,
    })
}

/// Whether a text is a number in digits.
fn is_number(text: &str) -> bool {
    text.bytes().all(|b| b.is_ascii_digit() || b == b'.')
}
