//! Two expressions: equal, different or undecided, in the words of a grade; tolerances; quotients that are numbers.

mod near;

use num_traits::Signed;

use super::context::{Context, is_short, quotient};
use super::number::{self, Tolerance};
use super::{Apart, Diagnosis, Grade, Strength, Verdict, partial};
use crate::algebra::{Field, Sign};
use crate::equality::{
    self, Assumption, AtPoints, Condition, Equality, Evidence, Ground, How, Reason, Side, Value,
};
use crate::expr::{Expr, Node, Rational};
use crate::formula::write_plain;

/// Two expressions.
pub(crate) fn scalars(ctx: &Context, expected: &Expr, answer: &Expr) -> Grade {
    if let Some(tolerance) = &ctx.options.tolerance
        && let Some(finding) = tolerant(ctx, expected, answer, tolerance)
    {
        return finding;
    }
    let domains = ctx.domains();
    if ctx.options.strength == Strength::Fast
        && let Some((found, assumed)) = equality::at_points(expected, answer, domains)
    {
        return at_points(found, assumed);
    }
    let mut decision = equality::decide(expected, answer, domains);
    if let (Some(Tolerance::Relative(share)), Equality::Different(at)) =
        (&ctx.options.tolerance, &decision.equality)
    {
        let constant = expected.is_constant() && answer.is_constant();
        let at = at.clone();
        match near::outside(expected, answer, share, at, domains) {
            Some(at) => decision.equality = Equality::Different(at),
            None if constant => {}
            None => return not_apart(share, expected, answer, ctx),
        }
    }
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

/// The finding where two formulas differ, and at no point that was found by more than a tolerance allows.
fn not_apart(share: &Rational, expected: &Expr, answer: &Expr, ctx: &Context) -> Grade {
    let words = Tolerance::Relative(share.clone()).words();
    if near::is_within(expected, answer, share, ctx.domains()) {
        return Grade::new(Verdict::Equivalent, "EQUIV_TOLERANCE", "tolerance", words);
    }
    let words = format!("{words} at all points tried, and it is not shown that it always is");
    Grade::new(Verdict::Undecided, "UNDECIDED_TOLERANCE", "none", words)
}

/// What a comparison at random points says.
fn at_points(found: AtPoints, assumed: Vec<String>) -> Grade {
    let mut finding = match found.equal {
        true => {
            let words = found.words();
            let mut finding = Grade::new(Verdict::Equivalent, "EQUIV_MODULAR", "modular", words);
            finding.proof.bound = Some(found.bound);
            finding
        }
        false => Grade::different("DIFF", "modular", found.words()),
    };
    finding.assumed = assumed;
    finding
}

fn decided(ctx: &Context, expected: &Expr, answer: &Expr, equality: Equality) -> Grade {
    match equality {
        Equality::Same {
            how: How::Identity {
                ground,
                assumptions,
            },
        } => identical(ground, assumptions),
        Equality::Same {
            how: How::OnBranch {
                condition,
                elsewhere,
            },
        } => match condition {
            Condition::BothDefined => where_defined(&elsewhere),
            Condition::NotNegative(e) => on_branch(&ctx.say(&e), &elsewhere),
        },
        Equality::Different(at) => {
            let words = "the values differ at a point of the domain";
            Grade::different("DIFF", "counterexample", words).shown_by(apart(&at))
        }
        Equality::Invalid {
            side: Side::Right, ..
        } => {
            let words = format!("{} has no value anywhere", ctx.say(answer));
            let hint = "your formula has no value anywhere: look for a division by zero or the root of something negative";
            Grade::new(Verdict::Invalid, "INVALID_UNDEFINED", "none", words.clone())
                .with(Diagnosis::new("UNDEFINED", words, hint))
        }
        Equality::Invalid {
            side: Side::Left, ..
        } => {
            let words = format!("the expected {} has no value anywhere", ctx.say(expected));
            Grade::new(Verdict::Invalid, "INVALID_EXPECTED", "none", words)
        }
        Equality::Undecided { reason, evidence } => open(reason, &evidence),
    }
}

/// Equal on the whole domain, with what the proof took for granted.
fn identical(ground: Ground, assumptions: Vec<Assumption>) -> Grade {
    let sign = |a: &Assumption| matches!(a, Assumption::NotNegative(_));
    let note = match assumptions.iter().any(sign) {
        true => "EQUIV_ASSUMED",
        false if assumptions.is_empty() => "EQUIV_IDENTITY",
        false => "EQUIV_WHERE_DEFINED",
    };
    let mut finding = Grade::new(Verdict::Equivalent, note, "identity", ground.words());
    finding.assumed = assumptions
        .iter()
        .map(|a| match a {
            Assumption::NotNegative(e) | Assumption::HasRoot(e) => {
                format!("{} ≥ 0", write_plain(e))
            }
            Assumption::NotAt(sample) => format!("not at {}", sample.words()),
            Assumption::NotZero(e) => format!("{} ≠ 0", write_plain(e)),
        })
        .collect();
    finding
}

/// Equal wherever both have a value. Where only one of them has, nothing is compared; that is told.
fn where_defined(elsewhere: &equality::Counterexample) -> Grade {
    let words = "equal wherever both formulas have a value";
    let note = "EQUIV_WHERE_DEFINED";
    let lacking = match elsewhere.left == Value::None {
        true => "the expected formula",
        false => "the answer",
    };
    let at = elsewhere.at.words();
    Grade::new(Verdict::Equivalent, note, "identity", words)
        .given(format!("both have a value: {lacking} has none at {at}"))
}

/// Equal where an expression is not negative, and different elsewhere.
fn on_branch(condition: &str, elsewhere: &equality::Counterexample) -> Grade {
    let where_equal = format!("where {condition} ≥ 0");
    let words = format!("equal {where_equal}, different elsewhere");
    let message = format!("right {where_equal}; elsewhere it differs");
    let hint = "your formula is right on a part of the domain only: think of signs";
    Grade::different("DIFF_BRANCH", "branch", words)
        .shown_by(apart(elsewhere))
        .with(Diagnosis::new("BRANCH", message, hint))
}

/// Undecided, with the reason and what was seen.
fn open(reason: Reason, evidence: &Evidence) -> Grade {
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
    Grade::new(Verdict::Undecided, note, "none", words + &seen)
}

fn apart(c: &equality::Counterexample) -> Apart {
    let [expected, yours] = c.values();
    Apart::new(c.at.words(), yours, expected)
}

/// How the root of odd degree of a negative number is understood, where one occurs.
fn odd_root(ctx: &Context, e: &Expr) -> Option<String> {
    let is_odd = |part: &&Expr| match part.node() {
        Node::Power(base, k) => {
            base.as_number().is_some_and(Signed::is_negative)
                && k.as_number().is_some_and(|k| !k.is_integer())
        }
        _ => false,
    };
    let root = e.parts().find(is_odd)?;
    Some(format!("{} is the real root", ctx.say(root)))
}

/// Within a tolerance: numbers, or formulas whose quotient is a number.
fn tolerant(ctx: &Context, expected: &Expr, answer: &Expr, tolerance: &Tolerance) -> Option<Grade> {
    let constant = expected.is_constant() && answer.is_constant();
    let inside = if constant {
        number::within(answer, expected, tolerance)?
    } else {
        // A formula with rounded coefficients: its ratio to the exact one is a number near 1.
        match tolerance {
            Tolerance::Relative(_) => match quotient(answer, expected, ctx) {
                Some(ratio) => number::within(&ratio, &Expr::one(), tolerance)?,
                None => is_near(ctx, expected, answer, tolerance),
            },
            // What is rounded to digits is the factor of a term; of a sum those of its terms are.
            Tolerance::Significant(_) => {
                let ratio = quotient(answer, expected, ctx)?;
                let factor = Expr::from(answer.split_number().0);
                number::within(&factor, &(&factor / &ratio), tolerance)?
            }
            Tolerance::Absolute(_) | Tolerance::Measured(_) => return None,
        }
    };
    if inside {
        let (note, words) = ("EQUIV_TOLERANCE", tolerance.words());
        return Some(Grade::new(Verdict::Equivalent, note, "tolerance", words));
    }
    constant.then(|| {
        let words = format!("not {}", tolerance.words());
        let mut finding = Grade::different("DIFF_TOLERANCE", "tolerance", words);
        if ctx.diagnose {
            finding.diagnosis = partial::numbers(expected, answer);
        }
        finding
    })
}

/// Whether an answer is proved to lie within a share of the expected value at all points of the domain: what is left of that
/// share on either side has the sign of the value.
pub(super) fn is_near(
    ctx: &Context,
    expected: &Expr,
    answer: &Expr,
    tolerance: &Tolerance,
) -> bool {
    let Tolerance::Relative(share) = tolerance else {
        return false;
    };
    if !is_short(expected, answer) {
        return false;
    }
    let allowed = Expr::from(share.clone()) * expected;
    let off = answer - expected;
    are_of_one_sign(ctx, &[&allowed + &off, &allowed - &off])
}

/// Whether all terms of an expression are of one sign on the domain, so that what is near each is near the whole.
pub(super) fn has_one_sign(ctx: &Context, e: &Expr) -> bool {
    match e.node() {
        Node::Sum(terms) => are_of_one_sign(ctx, terms),
        _ => true,
    }
}

fn are_of_one_sign(ctx: &Context, all: &[Expr]) -> bool {
    let sign = |e: &Expr| {
        let (field, x) = Field::of(ctx.domains(), e).ok()?;
        field.sign(&x)
    };
    let signs: Vec<Option<Sign>> = all.iter().map(sign).collect();
    let are = |wanted: [Sign; 3]| {
        signs
            .iter()
            .all(|sign| sign.is_some_and(|sign| wanted.contains(&sign)))
    };
    are([Sign::Positive, Sign::NotNegative, Sign::Zero])
        || are([Sign::Negative, Sign::NotPositive, Sign::Zero])
}
