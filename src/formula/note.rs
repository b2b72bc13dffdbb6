//! Remarks on how a formula was read where another reading is possible.

/// A remark and the place it speaks of.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Note {
    /// What was decided.
    pub remark: Remark,
    /// First byte.
    pub start: usize,
    /// Where the two readings part, in bytes.
    pub middle: usize,
    /// Byte after the last.
    pub end: usize,
}

/// The decisions a reader takes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Remark {
    /// A product without sign behind a slash; `tight` when all of it was taken below.
    Slash {
        /// All of it was taken below the slash.
        tight: bool,
    },
    /// Where the argument of a function without brackets ends; `long` when it went on.
    Argument {
        /// The argument went on behind `middle`.
        long: bool,
    },
    /// How far a root without brackets goes.
    Root {
        /// The root went on behind `middle`.
        long: bool,
    },
    /// `2e-1`: a power of ten, or a symbol.
    PowerOfTen {
        /// Taken as a power of ten.
        ten: bool,
    },
    /// `u1x`: one name, or a product.
    Component {
        /// Taken as one name.
        one: bool,
    },
    /// `asin`: the arcsine, or a times the sine.
    ArcOrFactor {
        /// Taken as the arcsine.
        arc: bool,
    },
    /// Letters behind a number were read as a unit.
    UnitNotSymbols,
    /// A word was read as a product of letters.
    Letters,
    /// `log` was read as the natural logarithm.
    NaturalLogarithm,
    /// `sin^{-1}` was read as the arcsine.
    Inverse,
    /// A number under a sine counts as radians.
    Radians,
    /// × between two symbols was read as a product of numbers.
    Cross,
    /// A comma was read as a decimal sign.
    DecimalComma,
    /// A point or comma behind the formula was passed over.
    Punctuation,
    /// A unit behind a formula in symbols says nothing.
    UnitOfSymbols,
    /// Words around the formula were passed over.
    Words,
    /// `between a and b` was read without its ends.
    Between,
}

impl Note {
    /// The remark in words; `text` is the formula.
    pub fn message(&self, text: &str) -> String {
        let piece = |from: usize, to: usize| text.get(from..to).unwrap_or("").trim();
        let whole = piece(self.start, self.end);
        let (first, second) = (piece(self.start, self.middle), piece(self.middle, self.end));
        let pick = |chosen: bool, a: String, b: String| {
            let (is, other) = if chosen { (a, b) } else { (b, a) };
            format!("I read {whole} as {is}; the other reading is {other}")
        };
        match self.remark {
            Remark::Slash { tight } => {
                let first = first.replace("\\div", "÷");
                let (above, below) = first.split_once(['/', '÷']).unwrap_or((&first, ""));
                let (above, below) = (above.trim(), below.trim());
                pick(
                    tight,
                    format!("{above}/({below} {second})"),
                    format!("({above}/{below})·{second}"),
                )
            }
            Remark::Argument { long } => pick(
                long,
                format!("the function of all of it, ({whole})"),
                format!("({first})·{second}").replace("·/", "/"),
            ),
            Remark::Root { long } => pick(
                long,
                "the root of all of it".into(),
                format!("({first})·{second}"),
            ),
            Remark::PowerOfTen { ten } => pick(
                ten,
                "a power of ten".into(),
                format!(
                    "{first} times the symbol {}",
                    &second[..second.len().min(1)]
                ),
            ),
            Remark::Component { one } => pick(one, "one name".into(), "a product".into()),
            Remark::ArcOrFactor { arc } => pick(
                arc,
                format!("the inverse of {second}"),
                format!("a times {second}"),
            ),
            Remark::UnitNotSymbols => {
                format!("I read {whole} as a unit; the other reading is a product of symbols")
            }
            Remark::Letters => format!("I read {whole} letter by letter, as a product"),
            Remark::NaturalLogarithm => "I read log as the natural logarithm".into(),
            Remark::Inverse => {
                format!("I read {whole} as the inverse function, not as a reciprocal")
            }
            Remark::Radians => format!(
                "{whole} under the function counts as radians; degrees are written {whole}°"
            ),
            Remark::Cross => format!("I read {whole} as a product of numbers"),
            Remark::DecimalComma => format!("I read {whole} as a decimal number"),
            Remark::Punctuation => format!("I passed over the {whole} behind the formula"),
            Remark::Between => format!("I read {whole} without its ends"),
            Remark::Words => format!("I read {whole} and passed over the words around it"),
            Remark::UnitOfSymbols => {
                format!("a formula in symbols has the unit of its symbols; {whole} was not used")
            }
        }
    }
}
