//! One content against another: values, vectors, pairs, quantities with units; relations go to [`super::relation`].

mod scalar;

use std::collections::BTreeMap;

use super::{
    Apart, Diagnosis, Key, Options, Proof, Strength, Tolerance, Verdict, number, partial, relation,
    several, show, unit,
};
use crate::dimension::{self, Dimension};
use crate::domain::Sample;
use crate::equality::{self};
use crate::expr::{Expr, Function, Node, Symbol, ratio};
use crate::formula::{self, Content, Reading, Relation, write_unicode};
use crate::interval::{Interval, Outcome, evaluate};
pub(crate) use scalar::{WRITTEN, is_short, quotient, same_number, scalars};

/// Points at which an equation is tried before its solutions are compared.
const POINTS: usize = 4;

/// What a comparison found; the grade without what concerns the text.
#[derive(Clone, Debug)]
pub(crate) struct Finding {
    pub verdict: Verdict,
    pub note: &'static str,
    pub proof: Proof,
    pub assumed: Vec<String>,
    pub counterexample: Option<Apart>,
    pub diagnosis: Vec<Diagnosis>,
}

impl Finding {
    pub(crate) fn new(
        verdict: Verdict,
        note: &'static str,
        kind: &'static str,
        words: impl Into<String>,
    ) -> Finding {
        Finding {
            verdict,
            note,
            proof: Proof::of(kind, words),
            assumed: Vec::new(),
            counterexample: None,
            diagnosis: Vec::new(),
        }
    }

    pub(crate) fn different(
        note: &'static str,
        kind: &'static str,
        words: impl Into<String>,
    ) -> Finding {
        Finding::new(Verdict::Different, note, kind, words)
    }

    /// Different, as the diagnosis tells in the same words; its code is the note without `DIFF_`.
    pub(super) fn told(
        note: &'static str,
        kind: &'static str,
        words: impl Into<String>,
        hint: impl Into<String>,
    ) -> Finding {
        let words = words.into();
        let code = note.strip_prefix("DIFF_").unwrap_or(note);
        Finding::different(note, kind, words.clone()).with(Diagnosis::new(code, words, hint))
    }

    pub(super) fn is_equivalent(&self) -> bool {
        self.verdict == Verdict::Equivalent
    }

    /// Adds what another finding assumed.
    pub(super) fn assume(&mut self, more: Vec<String>) {
        for words in more {
            if !self.assumed.contains(&words) {
                self.assumed.push(words);
            }
        }
    }

    /// No steps are left: what no proof and no point settled before is undecided for that reason.
    pub(super) fn stopped(&mut self) {
        let settled = match self.verdict {
            Verdict::Different => self.counterexample.is_some(),
            Verdict::Equivalent => true,
            // Without steps left values are unknown, not absent.
            Verdict::Invalid => self.note != "INVALID_UNDEFINED",
            Verdict::Undecided => false,
        };
        if !settled {
            let words = "the two were not settled within the limit of work";
            *self = Finding::new(Verdict::Undecided, "UNDECIDED_LIMIT", "none", words);
        }
    }

    pub(crate) fn with(mut self, diagnosis: Diagnosis) -> Finding {
        self.diagnosis.push(diagnosis);
        self
    }
}

/// What a comparison works with.
pub(crate) struct Context<'a> {
    pub key: &'a Key,
    pub options: &'a Options,
    /// Whether to look for what is wrong.
    pub diagnose: bool,
}

impl<'a> Context<'a> {
    pub(super) fn new(key: &'a Key, options: &'a Options, diagnose: bool) -> Context<'a> {
        Context {
            key,
            options,
            diagnose,
        }
    }

    /// The same without a look for what is wrong.
    pub(super) fn plain(&self) -> Context<'a> {
        Context::new(self.key, self.options, false)
    }

    /// Dimension of a symbol, where the question declares it.
    pub fn dimension_of(&self, name: &str) -> Option<Dimension> {
        let found = self.key.question.given().find(|g| *g.name == *name);
        found.and_then(|g| g.dimension.clone())
    }

    /// An expression as the question's author typesets it, for messages.
    pub fn say(&self, e: &Expr) -> String {
        let names: BTreeMap<&str, &str> = self
            .key
            .question
            .symbols
            .iter()
            .filter_map(|g| Some((&*g.name, g.latex.as_deref()?)))
            .collect();
        write_unicode(e, &|name| names.get(name).map(|l| (*l).to_string()))
    }
}

/// Compares a reading with the key.
pub(crate) fn contents(key: &Key, answer: &Reading, options: &Options) -> Finding {
    let diagnose = options.strength == Strength::Identity;
    compare(&Context::new(key, options, diagnose), answer)
}

/// The verdict alone, without looking for what is wrong.
pub(crate) fn verdict_of(key: &Key, answer: &Reading, options: &Options) -> Verdict {
    compare(&Context::new(key, options, false), answer).verdict
}

/// A value, possibly with the name it is given to; or relations.
enum Claim<'a> {
    Value(Option<&'a Symbol>, &'a Content),
    Relations(&'a [Content], &'a [Relation]),
}

fn claim(content: &Content) -> Claim<'_> {
    match content {
        Content::Relations(sides, signs) => {
            let name = sides
                .first()
                .and_then(Content::expr)
                .and_then(Expr::as_symbol);
            let value = content.answer();
            let free = |name: &Symbol| {
                let mut free = true;
                sides[1..]
                    .iter()
                    .for_each(|s| s.each(&mut |e| free &= !e.symbols().contains(name)));
                free
            };
            match name {
                Some(name) if !std::ptr::eq(value, content) && free(name) => {
                    Claim::Value(Some(name), value)
                }
                // `(v_x, v_y) = (3, 4)`
                None if !std::ptr::eq(value, content) => Claim::Value(None, value),
                _ => Claim::Relations(sides, signs),
            }
        }
        other => Claim::Value(None, other),
    }
}

fn compare(ctx: &Context, answer: &Reading) -> Finding {
    // Values of one name are a list of which each will do, unless the other side says that they are all the same.
    let expected = &ctx.key.reading.content;
    let is_chain =
        |content: &Content| matches!(content, Content::Relations(sides, _) if sides.len() > 2);
    if let (false, Some(list)) = (is_chain(expected), formula::values_of_one(&answer.content)) {
        return compare(ctx, &answer.with(list));
    }
    if let (false, Some(list)) = (is_chain(&answer.content), formula::values_of_one(expected)) {
        let key = Key {
            reading: ctx.key.reading.with(list),
            ..ctx.key.clone()
        };
        return compare(&Context::new(&key, ctx.options, ctx.diagnose), answer);
    }
    // `a = b = c` is a system, in whatever order, where b and c are not the same of themselves.
    if let (Content::Relations(a, s), Content::Relations(b, t)) =
        (&ctx.key.reading.content, &answer.content)
        && a.len() > 2
        && b.len() > 2
        && apart(ctx, a, s).is_some()
    {
        return relation::compare(ctx, (a, s), (b, t));
    }
    if let Some(found) = several::joined(ctx, &ctx.key.reading.content, answer) {
        return found;
    }
    // An equation between vectors, solved for another of them.
    if let (Content::Relations(a, s), Content::Relations(b, t)) =
        (&ctx.key.reading.content, &answer.content)
        && a.first() != b.first()
        && a.iter()
            .chain(b)
            .any(|side| matches!(side, Content::Vector(_)))
    {
        return relation::compare(ctx, (&spread(a), s), (&spread(b), t));
    }
    match (claim(&ctx.key.reading.content), claim(&answer.content)) {
        (Claim::Value(mine, expected), Claim::Value(theirs, value)) => {
            named_values(ctx, answer, (mine, expected), (theirs, value))
        }
        (Claim::Relations(sides, signs), Claim::Relations(mine, my_signs)) => {
            let finding = relation::compare(ctx, (sides, signs), (mine, my_signs));
            let same = answer.content == ctx.key.reading.content;
            match finding.verdict {
                // What cannot be solved still says the same as itself.
                Verdict::Equivalent | Verdict::Invalid => finding,
                _ if same => {
                    let words = "the same relation";
                    Finding::new(Verdict::Equivalent, "EQUIV_SOLUTIONS", "identity", words)
                }
                _ => finding,
            }
        }
        (Claim::Relations(sides, signs), Claim::Value(Some(_), _)) => match &answer.content {
            Content::Relations(mine, my_signs) => {
                relation::compare(ctx, (sides, signs), (mine, my_signs))
            }
            _ => kind("an equation is expected"),
        },
        (Claim::Relations([left, right], [Relation::Equal]), Claim::Value(None, value))
            if left.expr().is_some_and(|e| {
                let (theirs, mine) = (right.symbols(), value.symbols());
                let free = |name: &Symbol| !theirs.contains(name) && !mine.contains(name);
                of_two_names(e, &free) || is_size(e, &free) && !matches!(value, Content::Either(_))
            }) =>
        {
            values(ctx, right, value)
        }
        (Claim::Relations(sides, signs), Claim::Value(None, value)) => {
            // `2, -2` for `x^2 = 4`
            if let Some(named) = only_unknown(&ctx.key.reading.content, value) {
                return relation::compare(ctx, (sides, signs), (&named, &[Relation::Equal]));
            }
            match sides.first().and_then(Content::expr) {
                // `v ≤ X`: the bare right side of an inequality does not say which way.
                Some(_) if signs.iter().any(|s| *s != Relation::Equal) => kind(&format!(
                    "an inequality is expected, and {} alone does not say which way",
                    show(value)
                )),
                _ => kind("an equation is expected, not a value"),
            }
        }
        (Claim::Value(name, expected), Claim::Relations(mine, my_signs)) => {
            solved(ctx, (name, expected), (mine, my_signs))
        }
    }
}

/// The sides of `x = 2` for the values of the only symbol of an equation.
fn only_unknown(equation: &Content, value: &Content) -> Option<[Content; 2]> {
    let constant = match value {
        Content::Scalar(e) => e.is_constant(),
        Content::Either(values) => values.iter().all(Expr::is_constant),
        _ => false,
    };
    let mut symbols = equation.symbols().into_iter().filter(|s| &**s != "pi");
    match (symbols.next(), symbols.next()) {
        (Some(name), None) if constant && !equation.is_bounded() => {
            Some([Content::Scalar(Expr::symbol(&name)), value.clone()])
        }
        _ => None,
    }
}

/// A value, possibly with the name it is given to.
type Named<'a> = (Option<&'a Symbol>, &'a Content);

/// Two values with their names.
fn named_values(
    ctx: &Context,
    answer: &Reading,
    (mine, expected): Named,
    (theirs, value): Named,
) -> Finding {
    let asked = &ctx.key.question.asked;
    let is_asked = |name: &Symbol| asked.iter().any(|g| g.name == *name);
    let inside = |c: &Content, name: &Symbol| c.expr().is_some_and(|e| e.symbols().contains(name));
    let mut finding = values(ctx, expected, value);
    if finding.verdict == Verdict::Different
        && let Content::Relations(sides, signs) = &answer.content
        && let [.., exact, rounded] = sides.as_slice()
        && signs.last() == Some(&Relation::Approximately)
        && signs.len() > 1
        && close(ctx, expected, rounded)
    {
        finding = values(ctx, expected, exact);
    }
    match (mine, theirs) {
        (Some(mine), Some(theirs)) if mine != theirs && !(is_asked(mine) && is_asked(theirs)) => {
            // The same equation, solved for another of its symbols.
            if let (Content::Relations(a, s), Content::Relations(b, t)) =
                (&ctx.key.reading.content, &answer.content)
                && inside(expected, theirs)
                && inside(value, mine)
            {
                return relation::compare(ctx, (a, s), (b, t));
            }
            finding = other_name(finding, mine, theirs);
        }
        (Some(_), Some(theirs)) if !declared_symbol(ctx, theirs) => {
            finding.assumed.retain(|a| !a.starts_with(&**theirs));
        }
        // A symbol of the expected formula cannot be the name of its value: `v = 3v/2` says something else.
        (None, Some(theirs)) if inside(expected, theirs) && !is_asked(theirs) => {
            let words = "a value is expected, and the answer is an equation for";
            finding = Finding::different("DIFF_KIND", "kind", format!("{words} {theirs}"));
        }
        (None, Some(theirs)) if !is_asked(theirs) && declared_symbol(ctx, theirs) => {
            if let Some(first) = asked.first() {
                finding = other_name(finding, &first.name, theirs);
            }
        }
        _ => {}
    }
    chain(ctx, answer, &mut finding);
    finding
}

/// A relation where a value is expected: whether it says that the value is this.
fn solved(
    ctx: &Context,
    (name, expected): Named,
    (mine, signs): (&[Content], &[Relation]),
) -> Finding {
    if let Some(finding) = nameless(ctx, expected, mine, signs) {
        return finding;
    }
    let solved = |name: &Symbol| {
        let sides = [Content::Scalar(Expr::symbol(name)), expected.clone()];
        relation::compare(ctx, (&sides, &[Relation::Equal]), (mine, signs))
    };
    let asked = ctx.key.question.asked.first().map(|g| &g.name);
    if let Some(name) = name.or(asked) {
        return solved(name);
    }
    match strangers(ctx, mine).as_slice() {
        [name] => solved(name),
        // `mgh = ½mv²` says what v is, whatever m is.
        names => {
            let names = names.iter().take(3);
            let mut found = names
                .filter(|name| may_hold(ctx, mine, name, expected))
                .map(solved);
            found
                .find(Finding::is_equivalent)
                .unwrap_or_else(|| kind("a value is expected, and the answer is a relation"))
        }
    }
}

/// `3v/(2l) = 1.5 v/l` for `3v/(2l)`: a chain without a name, of which every side is the expected value; behind ≈ a rounded
/// one will do.
fn nameless(
    ctx: &Context,
    expected: &Content,
    sides: &[Content],
    signs: &[Relation],
) -> Option<Finding> {
    let plain = ctx.plain();
    let (first, others) = sides.split_first()?;
    let mut finding = values(&plain, expected, first);
    // `KE = mv²/2`: letters that stand nowhere else are a name of the value.
    if let [name, value] = sides
        && name.expr().is_some_and(|e| is_word(ctx, e, expected))
        && strangers(ctx, std::slice::from_ref(value)).is_empty()
    {
        finding = values(&plain, expected, value);
    }
    let right = finding.is_equivalent();
    let follows = |(sign, side): (&Relation, &Content)| match sign {
        Relation::Equal => values(&plain, expected, side).is_equivalent(),
        Relation::Approximately => close(ctx, expected, side),
        _ => false,
    };
    (right && signs.iter().zip(others).all(follows)).then_some(finding)
}

/// Whether a side behind ≈ is the expected value with its factor rounded: to two digits a number is at most 1/20 off.
fn close(ctx: &Context, expected: &Content, side: &Content) -> bool {
    let plain = ctx.plain();
    let share = || quotient(side.expr()?, expected.expr()?, &plain);
    let near = |share| number::within(&share, &Expr::one(), &Tolerance::Relative(ratio(1, 20)));
    share().and_then(near) == Some(true)
}

/// Whether letters side by side, none of them of the question, are a name such as `KE`, `pe` or `Fnet`, or a product that
/// measures what is asked, as `Iω` does for `m v l/2`; so are the letters of a velocity with an index, `vf` and `vx`, and what
/// is made of two names.
fn is_word(ctx: &Context, e: &Expr, expected: &Content) -> bool {
    let free = |name: &Symbol| !declared_symbol(ctx, name);
    if of_two_names(e, &free) {
        return true;
    }
    let Node::Product(parts) = e.node() else {
        return false;
    };
    let letters: Option<Vec<&Symbol>> = parts.iter().map(Expr::as_symbol).collect();
    let index = |name: &Symbol| free(name) && matches!(&**name, "f" | "i" | "x" | "y");
    let velocity = |name: &Symbol| matches!(&**name, "v" | "u" | "V");
    letters.is_some_and(|letters| {
        let capital = |name: &&Symbol| name.starts_with(char::is_uppercase);
        let energy = || letters.iter().any(|name| &***name == "e");
        let word = || letters.len() > 2 || energy() || letters.iter().all(capital);
        let measured = |e: &Expr| dimension::of(e, &usual).ok().flatten();
        let asked = expected.expr().filter(|e| !e.is_constant());
        let fits = match asked.map(|asked| [e, asked].map(measured)) {
            Some([Some(mine), Some(asked)]) => mine == asked,
            Some(_) => word(),
            None => true,
        };
        fits && letters.iter().all(|name| free(name))
            || matches!(letters.as_slice(), [a, b] if velocity(a) && index(b) || velocity(b) && index(a))
    })
}

/// What a letter of mechanics nearly always measures.
fn usual(name: &str) -> Option<Dimension> {
    let (letter, _) = name.split_once('_').unwrap_or((name, ""));
    let [mass, length, time] = match letter.trim_end_matches(|c: char| c.is_ascii_digit()) {
        "m" | "M" => [1, 0, 0],
        "h" | "l" | "L" | "d" | "r" | "R" | "x" | "s" => [0, 1, 0],
        "t" => [0, 0, 1],
        "v" | "u" => [0, 1, -1],
        "a" | "g" => [0, 1, -2],
        "omega" => [0, 0, -1],
        "F" => [1, 1, -2],
        "I" => [1, 2, 0],
        _ => return None,
    };
    Some(Dimension::new(mass, length, time))
}

/// Whether a formula is the difference, the sum or the quotient of two names, as in `E_1 − E_2` and `K_2/K_1`.
fn of_two_names(e: &Expr, free: &dyn Fn(&Symbol) -> bool) -> bool {
    let name = |e: &Expr| e.as_symbol().is_some_and(free);
    let pair = |parts: &[Expr], turned: &dyn Fn(&Expr) -> Expr| matches!(parts, [a, b] if name(a) && name(&turned(b)) || name(&turned(a)) && name(b));
    match e.node() {
        Node::Sum(parts) => pair(parts, &|b| -b) || pair(parts, &Expr::clone),
        Node::Product(parts) => pair(parts, &|b| b.powi(-1)),
        _ => false,
    }
}

/// Whether a formula is the size of a name, as in `|v|`, or of a vector.
fn is_size(e: &Expr, free: &dyn Fn(&Symbol) -> bool) -> bool {
    let square = |e: &Expr| match e.node() {
        Node::Product(parts) => {
            let mut names = parts.iter().map(Expr::as_symbol);
            names.all(|name| name.is_some_and(|name| formula::is_component(name) && free(name)))
        }
        _ => false,
    };
    match e.node() {
        Node::Call(Function::Abs, inner) => inner.as_symbol().is_some_and(free),
        Node::Power(base, _) => matches!(base.node(), Node::Sum(parts) if parts.iter().all(square)),
        _ => false,
    }
}

/// The sides of an equation between vectors, names with an arrow and sums of them in their components.
fn spread(sides: &[Content]) -> Vec<Content> {
    let vectors = sides.iter().any(|side| matches!(side, Content::Vector(_)));
    let components = |side: &Content| {
        let e = side.expr().filter(|_| vectors)?;
        let mut names = e.symbols();
        names.retain(|name| formula::has_arrow(name) && !formula::is_component(name));
        let part =
            |name: &Symbol, axis: &str| (name.clone(), Expr::symbol(&format!("{name}_{axis}")));
        let along = |axis: &str| e.substitute(&names.iter().map(|n| part(n, axis)).collect());
        (!names.is_empty()).then(|| Content::Vector(["x", "y", "z"].map(along)))
    };
    let spread = |side: &Content| components(side).unwrap_or_else(|| side.clone());
    sides.iter().map(spread).collect()
}

fn declared_symbol(ctx: &Context, name: &Symbol) -> bool {
    ctx.key.question.symbols.iter().any(|g| g.name == *name)
}

/// The names of an equation that the expected value does not know.
fn strangers(ctx: &Context, sides: &[Content]) -> Vec<Symbol> {
    let mut found = std::collections::BTreeSet::new();
    sides
        .iter()
        .for_each(|s| s.each(&mut |e| found.extend(e.symbols())));
    found.retain(|name| !declared_symbol(ctx, name));
    found.into_iter().collect()
}

/// Whether an equation can hold with a value in the place of a name: solutions are compared at much greater cost.
fn may_hold(ctx: &Context, sides: &[Content], name: &Symbol, value: &Content) -> bool {
    let ([left, right], Some(value)) = (sides, value.expr()) else {
        return true;
    };
    let (Some(left), Some(right)) = (left.expr(), right.expr()) else {
        return true;
    };
    let difference = (left - right).put(name, value);
    let points = ctx.key.question.domains.points(&[&difference], POINTS);
    let is_zero = |sample: &Sample| match evaluate::<Interval>(&difference, &sample.point(true)) {
        Outcome::Value(value) => value.low <= 0.0 && value.high >= 0.0,
        _ => true,
    };
    points.iter().all(is_zero)
}

pub(super) fn kind(words: &str) -> Finding {
    Finding::told("DIFF_KIND", "kind", words, words)
}

fn other_name(finding: Finding, mine: &Symbol, theirs: &Symbol) -> Finding {
    let words = format!("the answer speaks of {theirs}, and {mine} is asked for");
    let message = match finding.is_equivalent() {
        true => format!("{words}; the right side is the expected one"),
        false => words.clone(),
    };
    Finding::different("DIFF_NAME", "kind", words.clone())
        .with(Diagnosis::new("NAME", message, words))
}

/// In `ω = a = b` all sides after the name should be equal; the last decides.
fn chain(ctx: &Context, answer: &Reading, finding: &mut Finding) {
    let Content::Relations(sides, signs) = &answer.content else {
        return;
    };
    if !ctx.diagnose {
        return;
    }
    if let Some([one, two]) = apart(ctx, sides, signs) {
        let message = format!("{} and {} are not equal", ctx.say(one), ctx.say(two));
        let hint = "two sides of your chain of equations are not equal";
        let found = Diagnosis::new("CHAIN", message, hint);
        finding.diagnosis.push(found);
    }
}

/// Two neighbouring sides of a chain of equations, after its first, that are not equal.
fn apart<'a>(ctx: &Context, sides: &'a [Content], signs: &[Relation]) -> Option<[&'a Expr; 2]> {
    if sides.len() < 3 || signs.iter().any(|s| *s != Relation::Equal) {
        return None;
    }
    let exprs: Vec<&Expr> = sides[1..].iter().filter_map(Content::expr).collect();
    let differ = |pair: &&[&Expr]| {
        let decision = equality::decide(pair[0], pair[1], &ctx.key.question.domains);
        decision.equality.is_different()
    };
    let pair = exprs.windows(2).find(differ)?;
    Some([pair[0], pair[1]])
}

pub(super) fn values(ctx: &Context, expected: &Content, answer: &Content) -> Finding {
    match (expected, answer) {
        (Content::Scalar(e), Content::Scalar(a)) => scalars(ctx, e, a),
        (Content::Quantity(e), Content::Quantity(a)) => unit::quantities(ctx, e, a),
        (Content::Quantity(e), Content::Scalar(a)) => unit::without(ctx, e, a),
        (Content::Scalar(e), Content::Quantity(a)) => unit::with(ctx, e, a),
        (Content::Vector(e), Content::Vector(a)) => {
            all_of(ctx, e.iter().zip(a), |i| partial::vectors(ctx, e, a, i))
        }
        (Content::Matrix(e), Content::Matrix(a)) => matrices(ctx, e, a),
        (Content::Either(e), Content::Either(a)) => several::lists(ctx, e, a),
        (Content::Either(e), Content::Scalar(a)) => {
            let right = e.iter().filter(|e| equal(ctx, e, a)).count();
            if right == e.len() {
                return scalars(ctx, &e[0], a);
            }
            let one = right > 0;
            let words = match (one, e.len()) {
                (true, 2) => "one of the two values is missing",
                (true, _) => "the other values are missing",
                (false, 2) => "two values are expected",
                (false, _) => "several values are expected",
            };
            Finding::told("DIFF_ONE_OF_TWO", "kind", words, "there are two values")
        }
        (Content::Scalar(e), Content::Either(a)) => {
            let right = a.iter().filter(|a| equal(ctx, e, a)).count();
            if right == a.len() {
                return scalars(ctx, e, &a[0]);
            }
            let words = match right {
                0 => "one value is expected",
                _ if a.len() > 2 => "one of the values is the expected one; the others are not",
                _ => "one of the two values is the expected one; the other is not",
            };
            let hint = "the answer is a single value: decide which sign it has";
            Finding::told("DIFF_TWO_FOR_ONE", "kind", words, hint)
        }
        (Content::Quantity(e), Content::Either(_)) => {
            values(ctx, &Content::Scalar(e.value.clone()), answer)
        }
        (Content::Vector(e), Content::Scalar(a)) => {
            // `a × a = 0`
            if a.is_zero() && e.iter().all(|e| equal(ctx, e, a)) {
                return scalars(ctx, &e[0], a);
            }
            let nonzero: Vec<&Expr> = e.iter().filter(|c| !c.is_zero()).collect();
            let right = nonzero.len() == 1 && equal(ctx, nonzero[0], a);
            let message = match right {
                true => "the component is right; the direction is missing",
                false => "a vector is expected, and the answer is a number",
            };
            let hint = "a vector is asked: give its direction or components";
            Finding::told("DIFF_KIND", "kind", message, hint)
        }
        (Content::Scalar(e), Content::Vector(a)) => {
            // `-(3v/2l) k` for a spin: only the sense of rotation is left of the vector.
            if a[0].is_zero() && a[1].is_zero() {
                return scalars(ctx, e, &a[2]);
            }
            kind("a number is expected, and the answer is a vector")
        }
        _ => kind("the answer is of another kind than what is expected"),
    }
}

fn equal(ctx: &Context, expected: &Expr, answer: &Expr) -> bool {
    scalars(ctx, expected, answer).is_equivalent()
}

/// Matrices, entry by entry.
fn matrices(ctx: &Context, expected: &[Vec<Expr>], answer: &[Vec<Expr>]) -> Finding {
    let columns = expected[0].len();
    if [expected.len(), columns] != [answer.len(), answer[0].len()] {
        let size = |m: &[Vec<Expr>]| format!("{} × {}", m.len(), m[0].len());
        let (expected, answer) = (size(expected), size(answer));
        return kind(&format!(
            "a matrix of {expected} entries is expected, and the answer has {answer}"
        ));
    }
    let pairs = expected.iter().flatten().zip(answer.iter().flatten());
    all_of(ctx, pairs, |i| {
        let turned = |(r, row): (usize, &Vec<Expr>)| {
            let mut entries = row.iter().enumerate();
            entries.all(|(c, e)| answer.get(c).is_some_and(|row| equal(ctx, e, &row[r])))
        };
        let square = expected.len() == columns;
        let found = match square && expected.iter().enumerate().all(turned) {
            true => {
                let words = "rows and columns are exchanged";
                Diagnosis::new("TRANSPOSED", words, "which index counts the rows?")
            }
            false => {
                let (row, column) = (i / columns + 1, i % columns + 1);
                let words =
                    format!("the entry in row {row} and column {column} is not the expected one");
                Diagnosis::new(
                    "ENTRY",
                    words,
                    "compare the entries with the equations they come from",
                )
            }
        };
        vec![found]
    })
}

/// Components or entries, one by one; the first that differs decides, and is explained.
fn all_of<'e>(
    ctx: &Context,
    pairs: impl Iterator<Item = (&'e Expr, &'e Expr)>,
    explained: impl Fn(usize) -> Vec<Diagnosis>,
) -> Finding {
    let plain = ctx.plain();
    let mut undecided = None;
    let mut total: Option<Finding> = None;
    for (i, (e, a)) in pairs.enumerate() {
        let mut finding = scalars(&plain, e, a);
        match finding.verdict {
            Verdict::Equivalent => match &mut total {
                None => total = Some(finding),
                Some(total) => total.assume(finding.assumed),
            },
            Verdict::Undecided => undecided = Some(finding),
            _ => {
                if ctx.diagnose {
                    finding.diagnosis.extend(explained(i));
                    if let Some(first) = finding.diagnosis.first() {
                        finding.note = partial::note(first.code);
                    }
                }
                return finding;
            }
        }
    }
    undecided
        .or(total)
        .unwrap_or_else(|| kind("an empty vector"))
}
