//! Inequalities that hold for all parameters, or for none: decided by the sign of left side less right side.

use super::Check;
use super::calc::{Seen, has_both_signs, point_where, sign};
use crate::algebra::Sign;
use crate::domain::Domains;
use crate::expr::Expr;
use crate::formula::{Relation, Sentence, sentence};

/// The sign of a formula in words.
pub(super) fn sign_words(s: Seen) -> &'static str {
    match s {
        Seen::Proved(Sign::Zero) => "zero",
        Seen::Proved(Sign::NotNegative) => "not negative",
        Seen::Proved(Sign::NotPositive) => "not positive",
        s if s.is_positive() => "positive",
        s if s.is_negative() => "negative",
        _ => "of a sign that could not be told",
    }
}

/// Whether a relation holds everywhere, or nowhere, by the sign of its left side less its right.
pub(super) fn everywhere(s: Seen, relation: Relation) -> Option<bool> {
    let (up, down) = (s.is_positive(), s.is_negative());
    let zero = s == Seen::Proved(Sign::Zero);
    let not_down = up || zero || s == Seen::Proved(Sign::NotNegative);
    let not_up = down || zero || s == Seen::Proved(Sign::NotPositive);
    let (yes, no) = match relation {
        Relation::Less => (down, not_down),
        Relation::LessEqual => (not_up, up),
        Relation::Greater => (up, not_up),
        Relation::GreaterEqual => (not_down, down),
        _ => (zero, up || down),
    };
    (yes || no).then_some(yes)
}

/// An inequality that is to be shown for all parameters, decided by the sign of its left side less its right; where it fails, a
/// point shows it.
pub(super) fn shown(gap: &Expr, relation: Relation, domains: &Domains) -> (Sentence, Check) {
    let seen = sign(gap, domains);
    let known = everywhere(seen, relation).filter(|_| seen.is_proved());
    let wrong: &[Sign] = match relation {
        Relation::Less => &[Sign::Positive, Sign::Zero],
        Relation::LessEqual => &[Sign::Positive],
        Relation::Greater => &[Sign::Negative, Sign::Zero],
        _ => &[Sign::Negative],
    };
    // A plain failure is shown before one where both sides are the same.
    let mut wrong = wrong.iter().filter(|_| known.is_none());
    let against = wrong.find_map(|sign| point_where(gap, domains, *sign));
    let difference = sentence!("the difference of its sides is {}", gap);
    let words = sign_words(seen);
    let (text, why, holds) = match (known, against) {
        (Some(true), _) => {
            let why = "the sign of the difference is proved on the whole domain";
            (
                sentence!("{}, which is {}", difference, words),
                why,
                Some(true),
            )
        }
        (Some(false), _) => {
            let text = sentence!("it never holds: {}, which is {}", difference, words);
            let why = "the difference is proved to have another sign on the whole domain";
            (text, why, Some(false))
        }
        (None, Some((at, value))) => {
            let at = at.words();
            let text = sentence!(
                "it does not hold for all values: {}, which is {} at {}",
                difference,
                value,
                at
            );
            let why = "at one point of the domain it fails";
            (text, why, Some(false))
        }
        (None, None) if has_both_signs(gap, domains) => {
            let text = sentence!("it does not hold for all values: {}", difference);
            let why = "the difference has another sign on a part of the domain";
            (text, why, Some(false))
        }
        (None, None) if seen.side().is_some() => {
            let text = sentence!("not decided: {}, which is {}", difference, words);
            let why = "that both sides are the same somewhere is not excluded";
            (text, why, None)
        }
        (None, None) => {
            let text = sentence!("not decided: {}", difference);
            (text, "the sign of the difference was not proved", None)
        }
    };
    (text, Check::new("sign", why, holds))
}
