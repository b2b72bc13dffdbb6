//! One content against another: values, vectors, pairs, quantities with units; relations go to [`super::relation`].

use std::collections::BTreeMap;

use num_traits::Signed;

use super::number::{self, Tolerance};
use super::{
    Apart, Diagnosis, Key, Options, Proof, Strength, Verdict, fraction, modular, partial, relation,
    show, unit,
};
use crate::algebra::Field;
use crate::dimension::Dimension;
use crate::equality::{self, Assumption, Condition, Equality, How, Reason, Side, Value};
use crate::expr::{Expr, Node, Symbol};
use crate::formula::{Content, Reading, Relation, write_plain, write_unicode};

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
    pub(crate) fn new(verdict: Verdict, note: &'static str, proof: Proof) -> Finding {
        Finding {
            verdict,
            note,
            proof,
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
        Finding::new(Verdict::Different, note, Proof::of(kind, words))
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

impl Context<'_> {
    /// Dimension of a symbol, where the question declares it.
    pub fn dimension_of(&self, name: &str) -> Option<Dimension> {
        let question = &self.key.question;
        let found = question
            .symbols
            .iter()
            .chain(&question.asked)
            .find(|g| *g.name == *name);
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
    compare(
        &Context {
            key,
            options,
            diagnose,
        },
        answer,
    )
}

/// The verdict alone, without looking for what is wrong.
pub(crate) fn verdict_of(key: &Key, answer: &Reading, options: &Options) -> Verdict {
    compare(
        &Context {
            key,
            options,
            diagnose: false,
        },
        answer,
    )
    .verdict
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
                _ => Claim::Relations(sides, signs),
            }
        }
        other => Claim::Value(None, other),
    }
}

fn compare(ctx: &Context, answer: &Reading) -> Finding {
    if matches!(answer.content, Content::Relations(..)) && answer.content == ctx.key.reading.content
    {
        let proof = Proof::of("identity", "the same relation");
        return Finding::new(Verdict::Equivalent, "EQUIV_SOLUTIONS", proof);
    }
    let asked = &ctx.key.question.asked;
    let is_asked = |name: &Symbol| asked.iter().any(|g| g.name == *name);
    match (claim(&ctx.key.reading.content), claim(&answer.content)) {
        (Claim::Value(expected_name, expected), Claim::Value(name, value)) => {
            let mut finding = values(ctx, expected, value, answer);
            if let (Some(mine), Some(theirs)) = (expected_name, name) {
                let declared = |n: &Symbol| ctx.key.question.symbols.iter().any(|g| g.name == *n);
                if mine != theirs && !(is_asked(mine) && is_asked(theirs)) {
                    let inside = |c: &Content, name: &Symbol| {
                        c.expr().is_some_and(|e| e.symbols().contains(name))
                    };
                    finding = match (&ctx.key.reading.content, &answer.content) {
                        // The same equation, solved for another of its symbols.
                        (Content::Relations(a, s), Content::Relations(b, t))
                            if inside(expected, theirs) && inside(value, mine) =>
                        {
                            return relation::compare(ctx, (a, s), (b, t));
                        }
                        _ => other_name(finding, mine, theirs),
                    };
                } else if !declared(theirs) {
                    finding.assumed.retain(|a| !a.starts_with(&**theirs));
                }
            } else if let (None, Some(theirs)) = (expected_name, name) {
                // A symbol of the expected formula cannot be the name of its value: `v = 3v/2` says something else.
                let inside = expected
                    .expr()
                    .is_some_and(|e| e.symbols().contains(theirs));
                if inside && !is_asked(theirs) {
                    finding = Finding::different(
                        "DIFF_KIND",
                        "kind",
                        format!("a value is expected, and the answer is an equation for {theirs}"),
                    );
                } else if !asked.is_empty() && !is_asked(theirs) && declared_symbol(ctx, theirs) {
                    finding = other_name(finding, &asked[0].name.clone(), theirs);
                }
            }
            chain(ctx, answer, &mut finding);
            finding
        }
        (Claim::Relations(sides, signs), Claim::Relations(mine, my_signs)) => {
            relation::compare(ctx, (sides, signs), (mine, my_signs))
        }
        (Claim::Relations(sides, signs), Claim::Value(Some(_), _)) => match &answer.content {
            Content::Relations(mine, my_signs) => {
                relation::compare(ctx, (sides, signs), (mine, my_signs))
            }
            _ => kind("an equation is expected"),
        },
        (Claim::Relations(sides, signs), Claim::Value(None, value)) => {
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
            let name = name
                .cloned()
                .or_else(|| asked.first().map(|g| g.name.clone()))
                .or_else(|| stranger(ctx, mine));
            match name {
                Some(name) => {
                    let sides = [Content::Scalar(Expr::symbol(&name)), expected.clone()];
                    relation::compare(ctx, (&sides, &[Relation::Equal]), (mine, my_signs))
                }
                None => kind("a value is expected, and the answer is a relation"),
            }
        }
    }
}

fn declared_symbol(ctx: &Context, name: &Symbol) -> bool {
    ctx.key.question.symbols.iter().any(|g| g.name == *name)
}

/// The one name of an equation that the expected value does not know.
fn stranger(ctx: &Context, sides: &[Content]) -> Option<Symbol> {
    let mut found = std::collections::BTreeSet::new();
    sides
        .iter()
        .for_each(|s| s.each(&mut |e| found.extend(e.symbols())));
    let mut strange = found.into_iter().filter(|name| !declared_symbol(ctx, name));
    let first = strange.next()?;
    strange.next().is_none().then_some(first)
}

fn kind(words: &str) -> Finding {
    Finding::different("DIFF_KIND", "kind", words).with(Diagnosis::new("KIND", words, words))
}

fn other_name(finding: Finding, mine: &Symbol, theirs: &Symbol) -> Finding {
    let same = finding.verdict == Verdict::Equivalent;
    let words = format!("the answer speaks of {theirs}, and {mine} is asked for");
    let message = if same {
        format!("{words}; the right side is the expected one")
    } else {
        words.clone()
    };
    Finding::different("DIFF_NAME", "kind", words.clone())
        .with(Diagnosis::new("NAME", message, words))
}

/// In `ω = a = b` all sides after the name should be equal; the last decides.
fn chain(ctx: &Context, answer: &Reading, finding: &mut Finding) {
    let Content::Relations(sides, signs) = &answer.content else {
        return;
    };
    if !ctx.diagnose || sides.len() < 3 || signs.iter().any(|s| *s != Relation::Equal) {
        return;
    }
    let exprs: Vec<&Expr> = sides[1..].iter().filter_map(Content::expr).collect();
    for pair in exprs.windows(2) {
        if let Equality::Different(_) =
            equality::decide(pair[0], pair[1], &ctx.key.question.domains).equality
        {
            let message = format!(
                "{} and {} are not equal",
                ctx.say(pair[0]),
                ctx.say(pair[1])
            );
            finding.diagnosis.push(Diagnosis::new(
                "CHAIN",
                message,
                "two sides of your chain of equations are not equal",
            ));
            return;
        }
    }
}

fn values(ctx: &Context, expected: &Content, answer: &Content, reading: &Reading) -> Finding {
    match (expected, answer) {
        (Content::Scalar(e), Content::Scalar(a)) => scalars(ctx, e, a),
        (Content::Quantity(e), Content::Quantity(a)) => unit::quantities(ctx, e, a),
        (Content::Quantity(e), Content::Scalar(a)) => unit::without(ctx, e, a),
        (Content::Scalar(e), Content::Quantity(a)) => unit::with(ctx, e, a),
        (Content::Vector(e), Content::Vector(a)) => all_of(ctx, e, a),
        (Content::Either(e), Content::Either(a)) => pairs(ctx, e, a),
        (Content::Either(e), Content::Scalar(a)) => {
            let one = e
                .iter()
                .any(|e| scalars(ctx, e, a).verdict == Verdict::Equivalent);
            let words = if one {
                "one of the two values is missing"
            } else {
                "two values are expected"
            };
            Finding::different("DIFF_ONE_OF_TWO", "kind", words).with(Diagnosis::new(
                "ONE_OF_TWO",
                words,
                "there are two values",
            ))
        }
        (Content::Scalar(e), Content::Either(a)) => {
            let one = a
                .iter()
                .any(|a| scalars(ctx, e, a).verdict == Verdict::Equivalent);
            let words = if one {
                "one of the two values is the expected one; the other is not"
            } else {
                "one value is expected"
            };
            Finding::different("DIFF_TWO_FOR_ONE", "kind", words).with(Diagnosis::new(
                "TWO_FOR_ONE",
                words,
                "the answer is a single value: decide which sign it has",
            ))
        }
        (Content::Vector(e), Content::Scalar(a)) => {
            let nonzero: Vec<&Expr> = e.iter().filter(|c| !c.is_zero()).collect();
            let right =
                nonzero.len() == 1 && scalars(ctx, nonzero[0], a).verdict == Verdict::Equivalent;
            let message = match right {
                true => "the component is right; the direction is missing",
                false => "a vector is expected, and the answer is a number",
            };
            Finding::different("DIFF_KIND", "kind", message).with(Diagnosis::new(
                "KIND",
                message,
                "a vector is asked: give its direction or components",
            ))
        }
        (Content::Scalar(e), Content::Vector(a)) => {
            // `-(3v/2l) k` for a spin: only the sense of rotation is left of the vector.
            if a[0].is_zero() && a[1].is_zero() {
                return scalars(ctx, e, &a[2]);
            }
            let _ = reading;
            kind("a number is expected, and the answer is a vector")
        }
        _ => kind("the answer is of another kind than what is expected"),
    }
}

/// Two expressions.
pub(crate) fn scalars(ctx: &Context, expected: &Expr, answer: &Expr) -> Finding {
    if let Some(tolerance) = &ctx.options.tolerance
        && let Some(finding) = tolerant(ctx, expected, answer, tolerance)
    {
        return finding;
    }
    if ctx.options.strength == Strength::Fast {
        let usual = ctx
            .key
            .residues
            .as_ref()
            .filter(|_| ctx.key.reading.expr() == Some(expected));
        let found = match usual {
            Some(residues) => residues.compare(answer),
            None => modular::Residues::of(expected, &ctx.key.question.domains, Vec::new())
                .and_then(|r| r.compare(answer)),
        };
        if let Some(finding) = found {
            return finding;
        }
    }
    let decision = equality::decide(expected, answer, &ctx.key.question.domains);
    let mut finding = decided(ctx, expected, answer, decision.equality);
    finding.assumed.splice(0..0, decision.assumed);
    for e in [expected, answer] {
        finding.assumed.extend(odd_root(ctx, e));
    }
    finding.assumed.dedup();
    if ctx.diagnose && finding.verdict == Verdict::Different {
        let found = partial::diagnose(ctx, expected, answer);
        if finding.note == "DIFF"
            && let Some(first) = found.first()
        {
            finding.note = partial::note(first.code);
        }
        finding.diagnosis.extend(found);
    }
    finding
}

fn decided(ctx: &Context, expected: &Expr, answer: &Expr, equality: Equality) -> Finding {
    match equality {
        Equality::Same {
            how: How::Identity {
                ground,
                assumptions,
            },
        } => {
            let proof = Proof::of("identity", ground.words());
            let signs = assumptions
                .iter()
                .any(|a| matches!(a, Assumption::NotNegative(_)));
            let note = if signs {
                "EQUIV_ASSUMED"
            } else {
                "EQUIV_IDENTITY"
            };
            let mut finding = Finding::new(Verdict::Equivalent, note, proof);
            finding.assumed = assumptions
                .iter()
                .map(|a| match a {
                    Assumption::NotNegative(e) => format!("{} ≥ 0", write_plain(e)),
                    Assumption::NotAt(sample) => format!("not at {}", sample.words()),
                })
                .collect();
            finding
        }
        // Where the expected formula has no value it says nothing.
        Equality::Same {
            how:
                How::OnBranch {
                    condition: Condition::BothDefined,
                    elsewhere,
                },
        } if elsewhere.left == Value::None => {
            let words = "equal wherever the expected formula has a value";
            let mut finding = Finding::new(
                Verdict::Equivalent,
                "EQUIV_ASSUMED",
                Proof::of("identity", words),
            );
            finding.assumed = vec![format!("{} has a value", ctx.say(expected))];
            finding
        }
        Equality::Same {
            how: How::OnBranch {
                condition,
                elsewhere,
            },
        } => {
            let where_equal = match condition {
                Condition::NotNegative(e) => format!("where {} ≥ 0", ctx.say(&e)),
                Condition::BothDefined => "where both have a value".to_string(),
            };
            let mut finding = Finding::different(
                "DIFF_BRANCH",
                "branch",
                format!("equal {where_equal}, different elsewhere"),
            );
            finding.counterexample = Some(apart(&elsewhere));
            finding.with(Diagnosis::new(
                "BRANCH",
                format!("right {where_equal}; elsewhere it differs"),
                "your formula is right on a part of the domain only: think of signs",
            ))
        }
        Equality::Different(at) => {
            let mut finding = Finding::different(
                "DIFF",
                "counterexample",
                "the values differ at a point of the domain",
            );
            finding.counterexample = Some(apart(&at));
            finding
        }
        Equality::Invalid {
            side: Side::Right, ..
        } => {
            let words = format!("{} has no value anywhere", ctx.say(answer));
            Finding::new(Verdict::Invalid, "INVALID_UNDEFINED", Proof::of("none", words.clone())).with(Diagnosis::new(
                "UNDEFINED",
                words,
                "your formula has no value anywhere: look for a division by zero or the root of something negative",
            ))
        }
        Equality::Invalid {
            side: Side::Left, ..
        } => {
            let words = format!("the expected {} has no value anywhere", ctx.say(expected));
            Finding::new(
                Verdict::Invalid,
                "INVALID_EXPECTED",
                Proof::of("none", words),
            )
        }
        Equality::Undecided { reason, evidence } => {
            let (note, words) = match reason {
                Reason::TooLarge => (
                    "UNDECIDED_SIZE",
                    "the formulas are larger than the limit".to_string(),
                ),
                Reason::NoPoint => (
                    "UNDECIDED_POINT",
                    "no point of the domain at which both have a value was found".into(),
                ),
                Reason::NoPointApart => (
                    "UNDECIDED_POINT",
                    "no identity, yet no point was found at which they differ".into(),
                ),
                Reason::UnknownLaws => (
                    "UNDECIDED_FUNCTION",
                    "a function occurs whose laws are not known".into(),
                ),
                Reason::Limit(what) => ("UNDECIDED_LIMIT", what),
            };
            let seen = match (evidence.exact_points, evidence.enclosed_points) {
                (0, 0) => String::new(),
                (n, m) => format!(
                    "; equal at {n} exact points, to {} digits at {m} more",
                    evidence.digits
                ),
            };
            Finding::new(
                Verdict::Undecided,
                note,
                Proof::of("none", format!("{words}{seen}")),
            )
        }
    }
}

fn apart(c: &equality::Counterexample) -> Apart {
    let [expected, yours] = c.values();
    Apart {
        at: c.at.words(),
        yours,
        expected,
    }
}

/// How the root of odd degree of a negative number is understood, where one occurs.
fn odd_root(ctx: &Context, e: &Expr) -> Option<String> {
    let mut found = None;
    e.walk(&mut |part| {
        if let Node::Power(base, k) = part.node()
            && let (Some(base), Some(k)) = (base.as_number(), k.as_number())
            && base.is_negative()
            && !k.is_integer()
        {
            found.get_or_insert_with(|| format!("{} is the real root", ctx.say(part)));
        }
    });
    found
}

/// Within a tolerance: numbers, or formulas whose quotient is a number.
fn tolerant(
    ctx: &Context,
    expected: &Expr,
    answer: &Expr,
    tolerance: &Tolerance,
) -> Option<Finding> {
    let constant = expected.symbols().is_empty() && answer.symbols().is_empty();
    let inside = if constant {
        number::within(answer, expected, tolerance)?
    } else {
        // A formula with rounded coefficients: its ratio to the exact one is a number near 1.
        let (Tolerance::Relative(_) | Tolerance::Significant(_)) = tolerance else {
            return None;
        };
        let ratio = quotient(answer, expected, ctx)?;
        number::within(&ratio, &Expr::one(), tolerance)?
    };
    if inside {
        return Some(Finding::new(
            Verdict::Equivalent,
            "EQUIV_TOLERANCE",
            Proof::of("tolerance", tolerance.words()),
        ));
    }
    constant.then(|| {
        let mut finding = Finding::different(
            "DIFF_TOLERANCE",
            "tolerance",
            format!("not {}", tolerance.words()),
        );
        if ctx.diagnose {
            finding.diagnosis = partial::numbers(expected, answer);
        }
        finding
    })
}

/// Most terms of what is written out while looking for what is wrong; more would cost much and tell nobody anything.
pub(crate) const WRITTEN: usize = 300;

/// Most products of terms it may take to write out two formulas while looking for what is wrong.
const PRODUCTS: usize = 100_000;

/// Whether two formulas are written out as sums of products without much work.
pub(crate) fn is_short(a: &Expr, b: &Expr) -> bool {
    /// Terms, and products of terms on the way there; both at most.
    fn cost(e: &Expr) -> (usize, usize) {
        match e.node() {
            Node::Sum(parts) => parts.iter().map(cost).fold((0, 0), |total, part| {
                let work = total.1.saturating_add(part.1);
                (total.0.saturating_add(part.0), work)
            }),
            Node::Product(parts) => parts.iter().map(cost).fold((1, 0), |total, part| {
                let terms = total.0.saturating_mul(part.0);
                let work = total.1.saturating_add(part.1);
                (terms, work.saturating_add(terms))
            }),
            Node::Power(base, k) => {
                let (base, work) = cost(base);
                let k = k.as_number().filter(|k| k.is_integer());
                let k = k.and_then(|k| k.numer().as_i64()).unwrap_or(1);
                let k = usize::try_from(k.unsigned_abs()).unwrap_or(usize::MAX);
                // k of the terms, their order left aside: (base + k − 1 over k).
                let mut terms = 1usize;
                for i in 1..base.min(6) {
                    terms = terms.saturating_mul(k.saturating_add(i)) / i;
                }
                let squared = terms.saturating_mul(terms);
                (
                    terms,
                    work.saturating_add(if base > 1 { squared } else { 0 }),
                )
            }
            _ => (1, 0),
        }
    }
    cost(a).1.saturating_add(cost(b).1) <= PRODUCTS
}

/// The quotient of two expressions where it is a number.
pub(crate) fn quotient(a: &Expr, b: &Expr, ctx: &Context) -> Option<Expr> {
    if !is_short(a, b) {
        return None;
    }
    let mut field = Field::new(&ctx.key.question.domains);
    field.prepare([a, b]);
    let (x, y) = (field.element(a).ok()?, field.element(b).ok()?);
    if field.is_zero(&y) {
        return None;
    }
    let q = field.div(&x, &y).ok()?;
    if q.terms() > WRITTEN {
        return None;
    }
    let q = field.expr(&q);
    q.symbols().is_empty().then_some(q)
}

/// Components of vectors, one by one; the first that differs decides.
fn all_of(ctx: &Context, expected: &[Expr; 3], answer: &[Expr; 3]) -> Finding {
    let plain = Context {
        key: ctx.key,
        options: ctx.options,
        diagnose: false,
    };
    let mut undecided = None;
    let mut total: Option<Finding> = None;
    for (i, (e, a)) in expected.iter().zip(answer).enumerate() {
        let finding = scalars(&plain, e, a);
        match finding.verdict {
            Verdict::Equivalent => match &mut total {
                None => total = Some(finding),
                Some(t) => {
                    let new: Vec<String> = finding
                        .assumed
                        .into_iter()
                        .filter(|w| !t.assumed.contains(w))
                        .collect();
                    t.assumed.extend(new);
                }
            },
            Verdict::Undecided => undecided = Some(finding),
            _ => {
                let mut finding = finding;
                if ctx.diagnose {
                    finding
                        .diagnosis
                        .extend(partial::vectors(ctx, expected, answer, i));
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

/// Unordered pairs.
fn pairs(ctx: &Context, expected: &[Expr; 2], answer: &[Expr; 2]) -> Finding {
    let plain = Context {
        key: ctx.key,
        options: ctx.options,
        diagnose: false,
    };
    let both = |i: usize, j: usize| {
        let (a, b) = (
            scalars(&plain, &expected[0], &answer[i]),
            scalars(&plain, &expected[1], &answer[j]),
        );
        if a.verdict == Verdict::Equivalent {
            b
        } else {
            a
        }
    };
    let straight = both(0, 1);
    if straight.verdict == Verdict::Equivalent {
        return straight;
    }
    let crossed = both(1, 0);
    if crossed.verdict == Verdict::Different {
        straight
    } else {
        crossed
    }
}

/// Whether two constants are plainly equal.
pub(crate) fn same_number(a: &Expr, b: &Expr) -> bool {
    matches!((fraction(a), fraction(b)), (Some(a), Some(b)) if a == b)
}
