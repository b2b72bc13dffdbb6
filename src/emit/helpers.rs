//! The double-double arithmetic that emitted functions call, in three languages: the operations of [`super::dd`],
//! rounding for rounding.

use std::collections::BTreeSet;

use super::write::Language;

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

impl Helper {
    const ALL: [Helper; 13] = [
        Helper::Pair,
        Helper::Widen,
        Helper::TwoSum,
        Helper::QuickTwoSum,
        Helper::TwoProduct,
        Helper::Add,
        Helper::Negate,
        Helper::Multiply,
        Helper::Divide,
        Helper::Root,
        Helper::Turn,
        Helper::Cos,
        Helper::Sin,
    ];

    /// Its name in code.
    pub fn name(self) -> &'static str {
        match self {
            Helper::Pair => "wide_pair",
            Helper::Widen => "wide_of",
            Helper::TwoSum => "two_sum",
            Helper::QuickTwoSum => "quick_two_sum",
            Helper::TwoProduct => "two_product",
            Helper::Add => "wide_add",
            Helper::Negate => "wide_neg",
            Helper::Multiply => "wide_mul",
            Helper::Divide => "wide_div",
            Helper::Root => "wide_sqrt",
            Helper::Turn => "wide_turn",
            Helper::Cos => "wide_cos",
            Helper::Sin => "wide_sin",
        }
    }

    fn needs(self) -> &'static [Helper] {
        match self {
            Helper::Pair => &[],
            Helper::Widen | Helper::TwoSum | Helper::QuickTwoSum | Helper::TwoProduct => {
                &[Helper::Pair]
            }
            Helper::Add => &[Helper::TwoSum, Helper::QuickTwoSum],
            Helper::Negate => &[Helper::Pair],
            Helper::Multiply => &[Helper::QuickTwoSum, Helper::TwoProduct],
            Helper::Divide | Helper::Root => {
                &[Helper::Add, Helper::Negate, Helper::Multiply, Helper::Widen]
            }
            Helper::Turn => &[Helper::Divide],
            Helper::Cos | Helper::Sin => &[Helper::Turn],
        }
    }

    /// Adds the helper and all it calls.
    pub fn with_needs(self, used: &mut BTreeSet<Helper>) {
        if used.insert(self) {
            self.needs().iter().for_each(|h| h.with_needs(used));
        }
    }
}

/// Whether a name is a helper's.
pub fn is_helper(name: &str) -> bool {
    let own = |name: &str| Helper::ALL.iter().any(|h| h.name() == name);
    name == "Wide" || name == "split" || own(name) || super::units::NAMES.contains(&name)
}

/// What stands before the functions: imports, and the helpers used.
pub fn text(language: Language, used: &BTreeSet<Helper>) -> String {
    let mut out = String::from(match language {
        Language::Rust => "",
        Language::C => "#include <math.h>\n\n",
        Language::Python => "import math\n\n",
    });
    if !used.is_empty() {
        out.push_str(match language {
            Language::Rust => "// Double-doubles: the sum of two doubles, about 32 digits.\n",
            Language::C => "/* Double-doubles: the sum of two doubles, about 32 digits. */\n",
            Language::Python => "# Double-doubles: the sum of two doubles, about 32 digits.\n",
        });
    }
    for helper in used {
        let text = source(language, *helper);
        if !text.is_empty() {
            out.push_str(text);
            out.push('\n');
        }
    }
    out
}

fn source(language: Language, helper: Helper) -> &'static str {
    match language {
        Language::Rust => rust(helper),
        Language::C => c(helper),
        Language::Python => python(helper),
    }
}

fn rust(helper: Helper) -> &'static str {
    match helper {
        Helper::Pair => "type Wide = (f64, f64);\n",
        Helper::Widen => "",
        Helper::TwoSum => {
            "fn two_sum(a: f64, b: f64) -> Wide {
    let high = a + b;
    let part = high - a;
    (high, (a - (high - part)) + (b - part))
}
"
        }
        Helper::QuickTwoSum => {
            "fn quick_two_sum(a: f64, b: f64) -> Wide {
    let high = a + b;
    (high, b - (high - a))
}
"
        }
        Helper::TwoProduct => {
            "fn two_product(a: f64, b: f64) -> Wide {
    let split = |x: f64| {
        let c = 134217729.0 * x;
        let high = c - (c - x);
        (high, x - high)
    };
    let (a1, a2) = split(a);
    let (b1, b2) = split(b);
    let high = a * b;
    (high, ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2)
}
"
        }
        Helper::Add => {
            "fn wide_add(a: Wide, b: Wide) -> Wide {
    let s = two_sum(a.0, b.0);
    let t = two_sum(a.1, b.1);
    let v = quick_two_sum(s.0, s.1 + t.0);
    quick_two_sum(v.0, t.1 + v.1)
}
"
        }
        Helper::Negate => {
            "fn wide_neg(a: Wide) -> Wide {
    (-a.0, -a.1)
}
"
        }
        Helper::Multiply => {
            "fn wide_mul(a: Wide, b: Wide) -> Wide {
    let p = two_product(a.0, b.0);
    quick_two_sum(p.0, p.1 + (a.0 * b.1 + a.1 * b.0))
}
"
        }
        Helper::Divide => {
            "fn wide_div(a: Wide, b: Wide) -> Wide {
    let first = 1.0 / b.0;
    let rest = wide_add((1.0, 0.0), wide_neg(wide_mul(b, (first, 0.0))));
    wide_mul(a, quick_two_sum(first, rest.0 * first))
}
"
        }
        Helper::Root => {
            "fn wide_sqrt(a: Wide) -> Wide {
    if a.0 <= 0.0 {
        return (0.0, 0.0);
    }
    let first = a.0.sqrt();
    let rest = wide_add(a, wide_neg(two_product(first, first)));
    quick_two_sum(first, rest.0 / (2.0 * first))
}
"
        }
        Helper::Turn => {
            "/// Cosine (`lead` 0) or sine (`lead` 1).
fn wide_turn(angle: Wide, lead: i64) -> Wide {
    let quarters = (angle.0 / 1.5707963267948966).round();
    let mut rest = angle;
    for part in [1.5707963267948966, 6.123233995736766e-17, -1.4973849048591698e-33] {
        rest = wide_add(rest, wide_neg(two_product(quarters, part)));
    }
    let square = wide_neg(wide_mul(rest, rest));
    let quadrant = (quarters as i64 - lead).rem_euclid(4);
    let (mut term, mut k) = if quadrant % 2 == 0 { ((1.0, 0.0), 1.0) } else { (rest, 2.0) };
    let mut sum = term;
    while term.0.abs() > 1e-36 {
        term = wide_div(wide_mul(term, square), (k * (k + 1.0), 0.0));
        sum = wide_add(sum, term);
        k += 2.0;
    }
    if quadrant == 1 || quadrant == 2 { wide_neg(sum) } else { sum }
}
"
        }
        Helper::Cos => {
            "fn wide_cos(angle: Wide) -> Wide {
    wide_turn(angle, 0)
}
"
        }
        Helper::Sin => {
            "fn wide_sin(angle: Wide) -> Wide {
    wide_turn(angle, 1)
}
"
        }
    }
}

fn c(helper: Helper) -> &'static str {
    match helper {
        Helper::Pair => {
            "typedef struct { double high, low; } wide;

static wide wide_pair(double high, double low) {
    wide w;
    w.high = high;
    w.low = low;
    return w;
}
"
        }
        Helper::Widen => {
            "static wide wide_of(double a) {
    return wide_pair(a, 0.0);
}
"
        }
        Helper::TwoSum => {
            "static wide two_sum(double a, double b) {
    const double high = a + b, part = high - a;
    return wide_pair(high, (a - (high - part)) + (b - part));
}
"
        }
        Helper::QuickTwoSum => {
            "static wide quick_two_sum(double a, double b) {
    const double high = a + b;
    return wide_pair(high, b - (high - a));
}
"
        }
        Helper::TwoProduct => {
            "static wide two_product(double a, double b) {
    const double c = 134217729.0 * a, d = 134217729.0 * b;
    const double a1 = c - (c - a), a2 = a - a1, b1 = d - (d - b), b2 = b - b1;
    const double high = a * b;
    return wide_pair(high, ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2);
}
"
        }
        Helper::Add => {
            "static wide wide_add(wide a, wide b) {
    const wide s = two_sum(a.high, b.high), t = two_sum(a.low, b.low);
    const wide v = quick_two_sum(s.high, s.low + t.high);
    return quick_two_sum(v.high, t.low + v.low);
}
"
        }
        Helper::Negate => {
            "static wide wide_neg(wide a) {
    return wide_pair(-a.high, -a.low);
}
"
        }
        Helper::Multiply => {
            "static wide wide_mul(wide a, wide b) {
    const wide p = two_product(a.high, b.high);
    return quick_two_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}
"
        }
        Helper::Divide => {
            "static wide wide_div(wide a, wide b) {
    const double first = 1.0 / b.high;
    const wide rest = wide_add(wide_of(1.0), wide_neg(wide_mul(b, wide_of(first))));
    return wide_mul(a, quick_two_sum(first, rest.high * first));
}
"
        }
        Helper::Root => {
            "static wide wide_sqrt(wide a) {
    double first;
    wide rest;
    if (a.high <= 0.0) {
        return wide_of(0.0);
    }
    first = sqrt(a.high);
    rest = wide_add(a, wide_neg(two_product(first, first)));
    return quick_two_sum(first, rest.high / (2.0 * first));
}
"
        }
        Helper::Turn => {
            "/* Cosine (lead 0) or sine (lead 1). */
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
"
        }
        Helper::Cos => {
            "static wide wide_cos(wide angle) {
    return wide_turn(angle, 0);
}
"
        }
        Helper::Sin => {
            "static wide wide_sin(wide angle) {
    return wide_turn(angle, 1);
}
"
        }
    }
}

fn python(helper: Helper) -> &'static str {
    match helper {
        Helper::Pair | Helper::Widen => "",
        Helper::TwoSum => {
            "
def two_sum(a, b):
    high = a + b
    part = high - a
    return high, (a - (high - part)) + (b - part)
"
        }
        Helper::QuickTwoSum => {
            "
def quick_two_sum(a, b):
    high = a + b
    return high, b - (high - a)
"
        }
        Helper::TwoProduct => {
            "
def two_product(a, b):
    c, d = 134217729.0 * a, 134217729.0 * b
    a1, b1 = c - (c - a), d - (d - b)
    a2, b2 = a - a1, b - b1
    high = a * b
    return high, ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2
"
        }
        Helper::Add => {
            "
def wide_add(a, b):
    s, t = two_sum(a[0], b[0]), two_sum(a[1], b[1])
    v = quick_two_sum(s[0], s[1] + t[0])
    return quick_two_sum(v[0], t[1] + v[1])
"
        }
        Helper::Negate => {
            "
def wide_neg(a):
    return -a[0], -a[1]
"
        }
        Helper::Multiply => {
            "
def wide_mul(a, b):
    p = two_product(a[0], b[0])
    return quick_two_sum(p[0], p[1] + (a[0] * b[1] + a[1] * b[0]))
"
        }
        Helper::Divide => {
            "
def wide_div(a, b):
    first = 1.0 / b[0]
    rest = wide_add((1.0, 0.0), wide_neg(wide_mul(b, (first, 0.0))))
    return wide_mul(a, quick_two_sum(first, rest[0] * first))
"
        }
        Helper::Root => {
            "
def wide_sqrt(a):
    if a[0] <= 0.0:
        return 0.0, 0.0
    first = math.sqrt(a[0])
    rest = wide_add(a, wide_neg(two_product(first, first)))
    return quick_two_sum(first, rest[0] / (2.0 * first))
"
        }
        Helper::Turn => {
            "
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
"
        }
        Helper::Cos => {
            "
def wide_cos(angle):
    return wide_turn(angle, 0)
"
        }
        Helper::Sin => {
            "
def wide_sin(angle):
    return wide_turn(angle, 1)
"
        }
    }
}
