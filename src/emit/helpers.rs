//! The double-double arithmetic that emitted functions call, in every language: the operations of [`super::dd`],
//! rounding for rounding.

use std::collections::BTreeSet;

use super::dialect::{Language, filled};
use Helper::*;

/// A helper, in an order in which each needs only earlier ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Helper {
    /// The type, and its making from two doubles.
    Pair,
    /// A double made wide.
    Widen,
    /// Exact sum of two doubles (Knuth).
    TwoSum,
    /// The same where the first is the larger (Dekker).
    QuickTwoSum,
    /// Exact product of two doubles (Dekker, Veltkamp).
    TwoProduct,
    /// Sum.
    Add,
    /// Opposite.
    Negate,
    /// Product.
    Multiply,
    /// Quotient.
    Divide,
    /// Square root.
    Root,
    /// Cosine and sine by their series, after taking off quarter turns.
    Turn,
    /// Cosine.
    Cos,
    /// Sine.
    Sin,
}

/// The helpers as they are called, each with its steps, which all languages share: names for values, and the result last. What
/// begins with `wide_` takes double-doubles, `wide_of` aside. `pair` makes one, `root` is the square root of a double. Without
/// steps a helper is written out for each language.
const ROWS: [&str; 13] = [
    "wide_pair()",
    "wide_of(a) pair(a, 0.0)",
    "two_sum(a, b) high = a + b; part = high - a; pair(high, (a - (high - part)) + (b - part))",
    "quick_two_sum(a, b) high = a + b; pair(high, b - (high - a))",
    "two_product(a, b) c = 134217729.0 * a; d = 134217729.0 * b; a1 = c - (c - a); a2 = a - a1; b1 = d - (d - b); b2 = b - b1; \
     high = a * b; pair(high, ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2)",
    "wide_add(a, b) s = two_sum(a.high, b.high); t = two_sum(a.low, b.low); v = quick_two_sum(s.high, s.low + t.high); \
     quick_two_sum(v.high, t.low + v.low)",
    "wide_neg(a) pair(-a.high, -a.low)",
    "wide_mul(a, b) p = two_product(a.high, b.high); quick_two_sum(p.high, p.low + (a.high * b.low + a.low * b.high))",
    "wide_div(a, b) first = 1.0 / b.high; rest = wide_add(pair(1.0, 0.0), wide_neg(wide_mul(b, pair(first, 0.0)))); \
     wide_mul(a, quick_two_sum(first, rest.high * first))",
    "wide_sqrt(a) if a.high <= 0.0: pair(0.0, 0.0); first = root(a.high); rest = wide_add(a, wide_neg(two_product(first, first))); \
     quick_two_sum(first, rest.high / (2.0 * first))",
    "wide_turn()",
    "wide_cos(angle) wide_turn(angle, 0)",
    "wide_sin(angle) wide_turn(angle, 1)",
];

impl Helper {
    const ALL: [Helper; 13] = [
        Pair,
        Widen,
        TwoSum,
        QuickTwoSum,
        TwoProduct,
        Add,
        Negate,
        Multiply,
        Divide,
        Root,
        Turn,
        Cos,
        Sin,
    ];

    /// Its name, its parameters and its steps.
    fn row(self) -> [&'static str; 3] {
        let row = ROWS[self as usize];
        let (name, rest) = row.split_once('(').unwrap_or((row, ""));
        let (parameters, steps) = rest.split_once(')').unwrap_or((rest, ""));
        [name, parameters, steps.trim_start()]
    }

    /// Its name in code.
    pub fn name(self) -> &'static str {
        self.row()[0]
    }

    /// Adds the helper and all that its code in a language calls.
    pub fn with_needs(self, language: Language, used: &mut BTreeSet<Helper>) {
        if !used.insert(self) {
            return;
        }
        let code = source(language, self);
        let words = code.split(|c: char| !c.is_alphanumeric() && c != '_');
        for other in Helper::ALL {
            // Whoever names the type needs it.
            let is_named =
                |w: &str| w == other.name() || other == Pair && w.eq_ignore_ascii_case("wide");
            if words.clone().any(is_named) {
                other.with_needs(language, used);
            }
        }
    }
}

/// Whether a name is a helper's.
pub fn is_helper(name: &str) -> bool {
    let own = |name: &str| Helper::ALL.iter().any(|h| h.name() == name);
    ["Wide", "wide", "split"].contains(&name) || own(name) || super::units::NAMES.contains(&name)
}

/// What stands before the functions: imports, and the helpers used.
pub fn text(language: Language, used: &BTreeSet<Helper>) -> String {
    let dialect = language.dialect();
    let mut out = String::from(dialect.imports);
    if !used.is_empty() {
        let [open, close] = dialect.remark;
        let words = "Double-doubles: the sum of two doubles, about 32 digits.";
        out.push_str(&format!("{open}{words}{close}\n"));
    }
    for helper in used {
        let text = source(language, *helper);
        if !text.is_empty() {
            out.push_str(&text);
            out.push('\n');
        }
    }
    out
}

/// C code with a prefix before the names of all helpers, so that two such headers go into one program.
pub fn prefixed(code: &str, prefix: &str) -> String {
    let mut out = String::new();
    let mut word = String::new();
    for c in code.chars().chain(['\n']) {
        if c.is_alphanumeric() || c == '_' {
            word.push(c);
            continue;
        }
        if is_helper(&word) && word != "split" {
            out.push_str(prefix);
        }
        out.push_str(&std::mem::take(&mut word));
        out.push(c);
    }
    out.pop();
    out
}

/// A helper in one language; empty where the language has it already.
fn source(language: Language, helper: Helper) -> String {
    match (language, helper) {
        (_, Pair) if language.is_rust() => "type Wide = (f64, f64);\n".into(),
        (Language::C, Pair) => C_PAIR.into(),
        (_, Widen | Pair) if language != Language::C => String::new(),
        (Language::Rust, Turn) => RUST_TURN.into(),
        (Language::NoStd, Turn) => RUST_TURN
            .replace("f64::round(", "libm::round(")
            .replace("f64::abs(", "libm::fabs("),
        (Language::C, Turn) => C_TURN.into(),
        (Language::Python, Turn) => PYTHON_TURN.into(),
        (Language::NumPy, Turn) => NUMPY_TURN.into(),
        (Language::NumPy, Root) => NUMPY_ROOT.into(),
        _ => straight(language, helper),
    }
}

/// A helper without loops, written from its steps.
fn straight(language: Language, helper: Helper) -> String {
    let [name, parameters, steps] = helper.row();
    let takes_wide = name.starts_with("wide_") && helper != Widen;
    let list = |of: &str| {
        let each = parameters.split(", ").map(|p| of.replace('#', p));
        each.collect::<Vec<_>>().join(", ")
    };
    let kind = match (language, takes_wide) {
        (Language::C, true) => "wide #",
        (Language::C, false) => "double #",
        (_, true) => "#: Wide",
        (_, false) => "#: f64",
    };
    let mut out = match language {
        Language::Rust | Language::NoStd => format!("fn {name}({}) -> Wide {{\n", list(kind)),
        Language::C => format!("static wide {name}({}) {{\n", list(kind)),
        Language::Python | Language::NumPy => format!("\ndef {name}({}):\n", list("#")),
    };
    let dialect = language.dialect();
    let own = |text: &str| match language {
        Language::C => text
            .replace("pair(", "wide_pair(")
            .replace("root(", "sqrt("),
        _ => text
            .replace("pair(", "(")
            .replace("root(a.high)", &dialect.library("sqrt", "a.high"))
            .replace(".high", &filled(dialect.high, "", ""))
            .replace(".low", &filled(dialect.high, "", "").replace('0', "1")),
    };
    for step in steps.split("; ") {
        let step = own(step);
        let condition = step.strip_prefix("if ").and_then(|s| s.split_once(": "));
        let line = match (condition, step.split_once(" = ")) {
            (Some((test, value)), _) => match language {
                Language::C => format!("if ({test}) return {value};"),
                _ if language.is_rust() => format!("if {test} {{ return {value}; }}"),
                _ => format!("if {test}: return {value}"),
            },
            (_, Some((name, value))) => {
                let called = value.split('(').next().unwrap_or_default();
                let is_wide = called.starts_with("wide_")
                    || called.ends_with("two_sum")
                    || called == "two_product";
                let pattern = if is_wide {
                    dialect.wide
                } else {
                    dialect.double
                };
                filled(pattern, name, value)
            }
            (_, None) => filled(dialect.result, &step, ""),
        };
        out.push_str(&format!("    {line}\n"));
    }
    if !language.is_python() {
        out.push_str("}\n");
    }
    out
}

const RUST_TURN: &str = "/// Cosine (`lead` 0) or sine (`lead` 1).
fn wide_turn(angle: Wide, lead: i64) -> Wide {
    let quarters = f64::round(angle.0 / 1.5707963267948966);
    let mut rest = angle;
    for part in [1.5707963267948966, 6.123233995736766e-17, -1.4973849048591698e-33] {
        rest = wide_add(rest, wide_neg(two_product(quarters, part)));
    }
    let square = wide_neg(wide_mul(rest, rest));
    let quadrant = (quarters as i64 - lead).rem_euclid(4);
    let (mut term, mut k) = if quadrant % 2 == 0 { ((1.0, 0.0), 1.0) } else { (rest, 2.0) };
    let mut sum = term;
    while f64::abs(term.0) > 1e-36 {
        term = wide_div(wide_mul(term, square), (k * (k + 1.0), 0.0));
        sum = wide_add(sum, term);
        k += 2.0;
    }
    if quadrant == 1 || quadrant == 2 { wide_neg(sum) } else { sum }
}
";

const C_TURN: &str = "/* Cosine (lead 0) or sine (lead 1). */
static wide wide_turn(wide angle, int lead) {
    const double parts[3] = {1.5707963267948966, 6.123233995736766e-17, -1.4973849048591698e-33};
    const double quarters = round(angle.high / parts[0]);
    wide rest = angle, square, term, sum;
    double k;
    int i, quadrant;
    for (i = 0; i < 3; i++) {
        rest = wide_add(rest, wide_neg(two_product(quarters, parts[i])));
    }
    square = wide_neg(wide_mul(rest, rest));
    quadrant = (((int)fmod(quarters, 4.0) - lead) % 4 + 4) % 4;
    term = quadrant % 2 == 0 ? wide_of(1.0) : rest;
    k = quadrant % 2 == 0 ? 1.0 : 2.0;
    sum = term;
    while (fabs(term.high) > 1e-36) {
        term = wide_div(wide_mul(term, square), wide_of(k * (k + 1.0)));
        sum = wide_add(sum, term);
        k += 2.0;
    }
    return quadrant == 1 || quadrant == 2 ? wide_neg(sum) : sum;
}
";

const PYTHON_TURN: &str = "
def wide_turn(angle, lead):
    # Cosine (lead 0) or sine (lead 1).
    parts = (1.5707963267948966, 6.123233995736766e-17, -1.4973849048591698e-33)
    quarters = round(angle[0] / parts[0])
    rest = angle
    for part in parts:
        rest = wide_add(rest, wide_neg(two_product(float(quarters), part)))
    square = wide_neg(wide_mul(rest, rest))
    quadrant = (quarters - lead) % 4
    term, k = ((1.0, 0.0), 1.0) if quadrant % 2 == 0 else (rest, 2.0)
    total = term
    while abs(term[0]) > 1e-36:
        term = wide_div(wide_mul(term, square), (k * (k + 1.0), 0.0))
        total = wide_add(total, term)
        k += 2.0
    return wide_neg(total) if quadrant in (1, 2) else total
";

const NUMPY_TURN: &str = "
def wide_turn(angle, lead):
    # Cosine (lead 0) or sine (lead 1).
    parts = (1.5707963267948966, 6.123233995736766e-17, -1.4973849048591698e-33)
    quarters = np.round(angle[0] / parts[0])
    rest = angle
    for part in parts:
        rest = wide_add(rest, wide_neg(two_product(quarters, part)))
    square = wide_neg(wide_mul(rest, rest))
    quadrant = np.mod(quarters - lead, 4.0)
    even = np.mod(quadrant, 2.0) == 0.0
    term = (np.where(even, 1.0, rest[0]), np.where(even, 0.0, rest[1]))
    k = np.where(even, 1.0, 2.0)
    total = term
    while np.any(np.abs(term[0]) > 1e-36):
        term = wide_div(wide_mul(term, square), (k * (k + 1.0), 0.0))
        total = wide_add(total, term)
        k = k + 2.0
    back = (quadrant == 1.0) | (quadrant == 2.0)
    return tuple(np.where(back, -part, part) for part in total)
";

const NUMPY_ROOT: &str = "
def wide_sqrt(a):
    none = a[0] <= 0.0
    first = np.sqrt(np.where(none, 1.0, a[0]))
    rest = wide_add(a, wide_neg(two_product(first, first)))
    root = quick_two_sum(first, rest[0] / (2.0 * first))
    return tuple(np.where(none, 0.0, part) for part in root)
";

const C_PAIR: &str = "typedef struct { double high, low; } wide;

static wide wide_pair(double high, double low) {
    wide w;
    w.high = high;
    w.low = low;
    return w;
}
";
