//! The LaTeX commands that are read. Nothing is expanded; a command outside this list is a fault.

use super::Relation;
use super::fault::{Fault, Faulty, SETS, is_invisible};
use super::lexer::Lexer;
use super::symbols::name;
use super::symbols::{Parts, letters_at};
use super::token::{Before, Pair, Tok, function};

/// Words that a condition begins with.
const CONDITIONAL: [&str; 7] = ["for", "if", "when", "where", "since", "because", "as"];

impl<'a> Lexer<'a> {
    pub(super) fn command(&mut self, single: bool) -> Faulty<Tok> {
        let start = self.pos;
        let rest = &self.text[start + 1..];
        let length = letters_at(rest);
        let word = &rest[..length];
        let end = start + 1 + length;
        if matches!(
            word,
            "frac" | "dfrac" | "tfrac" | "mathrm" | "text" | "partial" | "dd" | "differentialD"
        ) && let Some(derivative) = self.derivative()
        {
            return derivative;
        }
        if matches!(word, "partial" | "dd" | "differentialD") {
            let message =
                format!("`\\{word}` is read in a derivative of one name only, as in dx/dt");
            return Err(Fault::new(message, start, end));
        }
        if word == "mathrm"
            && rest.starts_with("mathrm{d}")
            && self.differentials()
            && let Some(named) = self.differential_alone(start, start + "\\mathrm{d}".len())
        {
            return named;
        }
        self.pos = end;
        let upright = ["{\\text{", "{\\mathrm{"]
            .iter()
            .any(|font| rest[length..].starts_with(font));
        if word.ends_with("frac") && (upright || self.units_first) && self.before != Before::Nothing
        {
            self.pos = start;
            if let Some(tok) = self.unit(upright) {
                return Ok(tok);
            }
            self.pos = end;
        }
        if word == "rm" && rest[length..].starts_with('{') {
            return self.font(start, word);
        }
        if let Some(tok) = plain(word) {
            return Ok(tok);
        }
        match word {
            "" => self.sign_command(start),
            "SI" | "qty" | "num" | "SIrange" if rest[length..].trim_start().starts_with('{') => {
                self.measured_number(start, word != "num")
            }
            "unit" | "si" if rest[length..].trim_start().starts_with('{') => {
                self.spelled_unit(start)
            }
            "mu" if self.is_micro(end) => {
                self.pos = start;
                self.unit(true).map_or_else(|| self.name(start, end), Ok)
            }
            "Omega" if self.units_first && self.before != Before::Nothing => {
                self.pos = start;
                self.unit(false).map_or_else(|| self.name(start, end), Ok)
            }
            "operatorname" => self.operator(start),
            "begin" | "end" => self.environment(start, word == "begin"),
            "det" => Ok(Tok::Determinant),
            "binom" | "dbinom" | "tbinom" => self.binomial(start),
            "mathrm" | "text" | "textrm" | "mathsf" | "mathbf" | "mathit" | "textbf" | "textit"
            | "boldsymbol" | "bm" | "mathcal" => self.font(start, word),
            "atop" | "choose" => {
                let fault = Fault::new(format!("`\\{word}` is not read"), start, end);
                Err(fault.hint("write \\frac{…}{…}"))
            }
            "infty" => {
                Err(Fault::new("infinity is no value of a formula here", start, end).hint(SETS))
            }
            "in" | "notin" | "mathbb" | "emptyset" | "varnothing" => {
                Err(Fault::new("this set is not read", start, end).hint(SETS))
            }
            word => {
                let lower = word.chars().all(|c| c.is_ascii_lowercase());
                match function(word).filter(|_| lower) {
                    Some(tok) => Ok(self.based(word, tok, start)),
                    None => self.named_command(word, start, single),
                }
            }
        }
    }

    /// A command of one character that is no letter.
    fn sign_command(&mut self, start: usize) -> Faulty<Tok> {
        let (rest, end) = (&self.text[start + 1..], start + 1);
        Ok(match rest.chars().next() {
            // A set: its members are no decimal number.
            Some('{')
                if rest[1..]
                    .split('}')
                    .next()
                    .is_some_and(|inside| inside.contains(',')) =>
            {
                let fault = Fault::new("a set is not read", start, end + 1);
                return Err(fault.hint("write x = 1 or x = 2, or 1, 2"));
            }
            Some('{') => {
                self.pos += 1;
                Tok::Open('{')
            }
            Some('}') => {
                self.pos += 1;
                Tok::Close('}')
            }
            Some('%') => return self.percent(start, 2, 100),
            Some('|') => {
                self.pos += 1;
                Tok::Bar
            }
            Some('\\') if self.matrix => {
                self.pos = end + 1;
                Tok::EndOfRow
            }
            Some(c) => {
                let shown = if is_invisible(c) || c.is_control() {
                    '\u{fffd}'
                } else {
                    c
                };
                return Err(Fault::new(
                    format!("`\\{shown}` is no command I read"),
                    start,
                    end + c.len_utf8(),
                ));
            }
            None => return Err(Fault::new("a lone backslash", start, end)),
        })
    }

    /// A command that is the letter of a name, or begins one.
    fn named_command(&mut self, word: &str, start: usize, single: bool) -> Faulty<Tok> {
        let end = start + 1 + word.len();
        let mut parts = Parts::default();
        let Some(at) = name::base(self.text, start, &mut parts, 0) else {
            let shown: String = word.chars().take(24).collect();
            let fault = Fault::new(format!("`\\{shown}` is no command I read"), start, end);
            return Err(match function(word).or_else(|| nearest_command(word)) {
                Some(_) => fault.hint("commands are written in lower case and in full, as in \\sin"),
                None => fault.hint("known are \\frac, \\sqrt, \\sin and the like, \\cdot, Greek letters, accents and \\mathrm"),
            });
        };
        match single {
            true => self.resolve(start, at, parts),
            false => self.finish(start, at, parts),
        }
    }

    /// A column or row of components; of other environments nothing is read.
    fn environment(&mut self, start: usize, begins: bool) -> Faulty<Tok> {
        let (name, end) = self.group(start)?;
        let lines = name.trim_end_matches('*');
        if matches!(
            lines,
            "aligned" | "align" | "alignedat" | "equation" | "gathered" | "gather" | "split"
        ) {
            self.pos = end;
            self.aligned = begins;
            self.skip_blanks()?;
            let single = false;
            return self.token(single);
        }
        let known = matches!(name, "pmatrix" | "bmatrix" | "matrix" | "array" | "vmatrix");
        if !known || begins == self.matrix {
            let shown: String = name.chars().take(24).collect();
            let fault = Fault::new(format!("`{shown}` is no environment I read"), start, end);
            return Err(fault.hint("a vector is written [a, b] or in a pmatrix"));
        }
        self.pos = end;
        if begins && name == "array" {
            // How the columns are set.
            (_, self.pos) = self.group(start)?;
        }
        self.matrix = begins;
        Ok(match (begins, name) {
            (true, "vmatrix") => Tok::Open('v'),
            (true, _) => Tok::Open('m'),
            (false, _) => Tok::Close('m'),
        })
    }

    pub(super) fn operator(&mut self, start: usize) -> Faulty<Tok> {
        let (inside, end) = self.group(start)?;
        let word: String = inside.chars().filter(|c| !c.is_whitespace()).collect();
        self.pos = end;
        match function(&word) {
            Some(tok) => Ok(tok),
            None if matches!(&*word, "sgn" | "sign" | "signum") => Ok(Tok::Signum),
            None => Pair::named(&word)
                .map(Tok::Pair)
                .ok_or_else(|| Fault::new(format!("`{word}` is no function I know"), start, end)),
        }
    }

    /// Whether a μ that ends here stands behind a number and before a unit in another font, `5\,\mu\mathrm{m}`, or one letter
    /// of a unit that ends the side and is no name, `20\mu m`.
    fn is_micro(&self, end: usize) -> bool {
        let fonts = ["\\mathrm{", "\\text{", "\\textrm{"];
        let rest = self.text[end..].trim_start();
        let letter = rest
            .get(..1)
            .filter(|letter| "msgAFHCVNJW".contains(letter));
        let is_unit = letter.is_some_and(|letter| {
            self.symbols.find(letter).is_none() && self.fills_side(self.text.len() - rest.len() + 1)
        });
        matches!(self.before, Before::Number { .. })
            && (is_unit || fonts.iter().any(|font| rest.starts_with(font)))
            && self.symbols.find("mu").is_none()
    }

    /// A piece in another font: a unit behind a number, a function, or a name.
    pub(super) fn font(&mut self, start: usize, word: &str) -> Faulty<Tok> {
        self.pos = start + 1 + word.len();
        // Behind a name it could be another name, `m\mathrm{g}`, unless it is written as units are.
        let as_unit = self.after_value
            && self
                .group(start)
                .is_ok_and(|(i, _)| i.starts_with(' ') || i.contains(['/', '^']));
        // One bold letter is a vector.
        let is_text = match word {
            "textbf" => self.group(start).is_ok_and(|(i, _)| i.len() > 1),
            _ => matches!(word, "mathrm" | "rm" | "text" | "textrm" | "mathsf"),
        };
        if let Ok((inside, end)) = self.group(start)
            && matches!(inside.trim(), "deg" | "degrees" | "°")
            && self.before != Before::Nothing
        {
            self.pos = end;
            return Ok(Tok::Degree);
        }
        self.pos = start;
        if is_text
            && (self.before != Before::Nothing || as_unit)
            && let Some(tok) = self.unit(true)
        {
            return Ok(tok);
        }
        self.pos = start + 1 + word.len();
        if let Ok((inside, end)) = self.group(start) {
            let trimmed = inside.trim();
            let called = || {
                let rest = self.text[end..].trim_start();
                rest.starts_with('(') || rest.starts_with("\\left(")
            };
            let pair = || Pair::named(trimmed).filter(|_| called()).map(Tok::Pair);
            if let Some(tok) = function(trimmed).or_else(pair) {
                self.pos = end;
                return Ok(tok);
            }
            let bold = matches!(word, "mathbf" | "boldsymbol" | "bm" | "textbf");
            if bold
                && self.symbols.find(trimmed).is_none()
                && let Some(vector) = super::words::unit_vector(&format!("{trimmed}_hat"))
                    .filter(|_| matches!(trimmed, "i" | "j" | "k"))
            {
                self.pos = end;
                return Ok(Tok::Name(vector.into()));
            }
            if trimmed == "pi" || trimmed == "\\pi" {
                self.pos = end;
                return Ok(Tok::Name("pi".into()));
            }
            // `\mathbf{12}` is a number in another font.
            if trimmed.starts_with(|c: char| c.is_ascii_digit())
                && let Ok((literal, used)) =
                    super::number::literal(trimmed, 0, super::number::Exponent::Symbol, false)
                && used == trimmed.len()
            {
                self.pos = end;
                return Ok(Tok::Number(literal));
            }
        }
        let inside = self.group(start).map_or("", |(inside, _)| inside);
        if word == "text" && CONDITIONAL.contains(&inside.trim()) {
            let end = self.group(start)?.1;
            let fault = Fault::new("a word between formulas", start, end);
            return Err(fault.hint("give the formula alone, without the condition behind it"));
        }
        let mut parts = Parts::default();
        match name::base(self.text, start, &mut parts, 0) {
            Some(at) => self.finish(start, at, parts),
            // `\mathbf{\frac{a}{b}}` is a formula in another font.
            None if matches!(word, "mathbf" | "boldsymbol" | "bm")
                && inside.contains(['\\', '+', '-', '/', '^']) =>
            {
                self.pos = start + 1 + word.len();
                self.skip_blanks()?;
                let single = false;
                self.token(single)
            }
            None => {
                let end = self.group(start).map_or(self.pos, |(_, end)| end);
                Err(Fault::new(
                    "this text is neither a unit, a function nor a name",
                    start,
                    end,
                ))
            }
        }
    }

    /// `\SI{3}{m/s}`: a number and, in the second group, its unit, which is read next.
    fn measured_number(&mut self, start: usize, unit: bool) -> Faulty<Tok> {
        let (number, end) = self.group(start)?;
        let plain = number.trim();
        let sign = plain.starts_with(['-', '−']);
        let digits = plain.trim_start_matches(['-', '+', '−']).replace(',', ".");
        let (literal, used) =
            super::number::literal(&digits, 0, super::number::Exponent::Ten, true)?;
        if used != digits.len() {
            return Err(Fault::new("a single number is expected here", start, end));
        }
        self.pos = end;
        let tok = match sign {
            true => Tok::Number(super::token::Literal {
                value: -literal.value.clone(),
                ..literal
            }),
            false => Tok::Number(literal),
        };
        if unit {
            self.pending = Some(self.spelled_unit(start)?);
        }
        Ok(tok)
    }

    /// The unit in the braces of `\unit{m/s}`, and in the second ones of `\qty{5}{m/s}`.
    fn spelled_unit(&mut self, start: usize) -> Faulty<Tok> {
        let at = self.pos;
        let (inside, stop) = self.group(start)?;
        let read = crate::dimension::unit(&super::units::spelled(inside))
            .map_err(|fault| Fault::new(fault.message, at, stop))?;
        self.pos = stop;
        Ok(Tok::Unit(Box::new(read)))
    }

    /// The text of the brace group that starts at the current place, and the byte after it.
    pub(super) fn group(&self, start: usize) -> Faulty<(&'a str, usize)> {
        let blanks = self.text[self.pos..].len()
            - self.text[self.pos..].trim_start_matches([' ', '*']).len();
        let at = self.pos + blanks;
        match name::closing(&self.text.as_bytes()[at..]) {
            Some(length) => Ok((&self.text[at + 1..at + length], at + length + 1)),
            None => Err(Fault::new("a group in braces is expected here", start, at)),
        }
    }
}

/// Commands that are one sign each.
fn plain(word: &str) -> Option<Tok> {
    Some(match word {
        "frac" | "dfrac" | "tfrac" | "cfrac" => Tok::Fraction,
        "sqrt" | "surd" => Tok::Root(2),
        "max" => Tok::Pair(Pair::Greater),
        "min" => Tok::Pair(Pair::Smaller),
        "cdot" | "ast" | "bullet" => Tok::Times,
        "times" => Tok::Cross,
        "div" => Tok::Slash,
        "pm" => Tok::PlusMinus,
        "mp" => Tok::MinusPlus,
        "le" | "leq" | "leqslant" | "leqq" => Tok::Relation(Relation::LessEqual),
        "ge" | "geq" | "geqslant" | "geqq" => Tok::Relation(Relation::GreaterEqual),
        "lt" => Tok::Relation(Relation::Less),
        "gt" => Tok::Relation(Relation::Greater),
        "ne" | "neq" => Tok::Relation(Relation::NotEqual),
        "approx" | "simeq" | "cong" | "doteq" => Tok::Relation(Relation::Approximately),
        "equiv" => Tok::Relation(Relation::Equal),
        "vert" | "mid" | "Vert" => Tok::Bar,
        "lvert" | "lVert" => Tok::OpenBar,
        "rvert" | "rVert" => Tok::CloseBar,
        "lg" => Tok::Logarithm(10),
        "over" => Tok::Over,
        "exponentialE" => Tok::Exponential,
        "langle" => Tok::Open('<'),
        "rangle" => Tok::Close('>'),
        "lbrace" => Tok::Open('{'),
        "rbrace" => Tok::Close('}'),
        "lbrack" => Tok::Open('['),
        "rbrack" => Tok::Close(']'),
        "pi" => Tok::Name("pi".into()),
        "degree" => Tok::Degree,
        _ => return None,
    })
}

fn nearest_command(word: &str) -> Option<Tok> {
    function(&word.to_ascii_lowercase())
}
