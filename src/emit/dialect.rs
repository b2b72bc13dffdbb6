//! How the languages write what every program is made of.

/// The languages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Language {
    /// A module of functions on `f64`.
    Rust,
    /// The same where there is no operating system: `core`, and the crate `libm` for roots, cosines and sines.
    NoStd,
    /// A translation unit of functions on `double`; C99.
    C,
    /// A module of functions on floats; Python 3.
    Python,
    /// A module of functions on arrays of doubles, and on floats; Python 3 with NumPy.
    #[value(name = "numpy")]
    NumPy,
}

/// How a language writes: `#` and `@` stand for what is put in.
pub(super) struct Dialect {
    /// A double `#` with the value `@`.
    pub double: &'static str,
    /// A double-double `#` with the value `@`.
    pub wide: &'static str,
    /// A whole number or a truth value `#` with the value `@`.
    pub whole: &'static str,
    /// The argument `#` given the value `@`.
    pub again: &'static str,
    /// The value `#` given back.
    pub result: &'static str,
    /// Between two conditions of which one is enough.
    pub or: &'static str,
    /// The whole number `@` where `#` holds, 0 otherwise.
    pub choice: &'static str,
    /// The larger of `#` and `@`.
    pub larger: &'static str,
    /// `#` to the power `@`, both in brackets where they need them on the left of a method.
    pub power: &'static str,
    /// The function `@` of the library at `#`.
    pub call: &'static str,
    /// The first double of the double-double `#`.
    pub high: &'static str,
    /// What a file begins with.
    pub imports: &'static str,
    /// What stands before a remark of one line, and behind it.
    pub remark: [&'static str; 2],
    /// Functions of the library that are not called as formulas call them.
    names: &'static [(&'static str, &'static str)],
}

const RUST: Dialect = Dialect {
    double: "let # = @;",
    wide: "let # = @;",
    whole: "let # = @;",
    again: "let # = @;",
    result: "#",
    or: " || ",
    choice: "if # { @ } else { 0 }",
    larger: "#.max(@)",
    power: "#.powf(@)",
    call: "#.@()",
    high: "#.0",
    imports: "",
    remark: ["// ", ""],
    names: &[],
};

const NO_STD: Dialect = Dialect {
    power: "libm::pow(#, @)",
    call: "libm::@(#)",
    names: &[("abs", "fabs"), ("ln", "log")],
    ..RUST
};

const C: Dialect = Dialect {
    double: "const double # = @;",
    wide: "const wide # = @;",
    whole: "const int # = @;",
    again: "# = @;",
    result: "return #;",
    or: " || ",
    choice: "# ? @ : 0",
    larger: "fmax(#, @)",
    power: "pow(#, @)",
    call: "@(#)",
    high: "#.high",
    imports: "#include <math.h>\n\n",
    remark: ["/* ", " */"],
    names: &[("abs", "fabs"), ("ln", "log")],
};

const PYTHON: Dialect = Dialect {
    double: "# = @",
    wide: "# = @",
    whole: "# = @",
    again: "# = @",
    result: "return #",
    or: " or ",
    choice: "@ if # else 0",
    larger: "max(#, @)",
    power: "# ** @",
    call: "math.@(#)",
    high: "#[0]",
    imports: "import math\n\n",
    remark: ["# ", ""],
    names: &[("abs", "fabs"), ("ln", "log")],
};

const NUMPY: Dialect = Dialect {
    or: " | ",
    choice: "np.where(#, @, 0)",
    larger: "np.maximum(#, @)",
    call: "np.@(#)",
    imports: "import numpy as np\n\n",
    names: &[
        ("ln", "log"),
        ("asin", "arcsin"),
        ("acos", "arccos"),
        ("atan", "arctan"),
    ],
    ..PYTHON
};

impl Language {
    /// How it writes.
    pub(super) fn dialect(self) -> &'static Dialect {
        match self {
            Language::Rust => &RUST,
            Language::NoStd => &NO_STD,
            Language::C => &C,
            Language::Python => &PYTHON,
            Language::NumPy => &NUMPY,
        }
    }

    /// Whether it is Rust, with the standard library or without.
    pub(super) fn is_rust(self) -> bool {
        matches!(self, Language::Rust | Language::NoStd)
    }

    /// Whether it is Python, with NumPy or without.
    pub(super) fn is_python(self) -> bool {
        matches!(self, Language::Python | Language::NumPy)
    }
}

/// A pattern with its blanks filled.
pub(super) fn filled(pattern: &str, first: &str, second: &str) -> String {
    let mut out = String::with_capacity(pattern.len() + first.len() + second.len());
    for c in pattern.chars() {
        match c {
            '#' => out.push_str(first),
            '@' => out.push_str(second),
            c => out.push(c),
        }
    }
    out
}

impl Dialect {
    /// A function of the library, by the name formulas have for it, at a value.
    pub fn library(&self, name: &str, at: &str) -> String {
        let own = self.names.iter().find(|(known, _)| *known == name);
        filled(self.call, at, own.map_or(name, |(_, own)| own))
    }
}

/// How a file is written.
#[derive(Clone, Debug)]
pub struct Style {
    /// Its language.
    pub language: Language,
    /// What stands before the name of every function and type.
    pub prefix: String,
    /// Whether one function more takes all arguments in one struct and gives all values in another; in C the file is a
    /// header then.
    pub record: bool,
}

impl Style {
    /// Functions alone, under the names of the answers.
    pub fn of(language: Language) -> Style {
        Style {
            language,
            prefix: String::new(),
            record: false,
        }
    }
}
