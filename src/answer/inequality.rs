//! Inequalities that hold for all parameters, or for none: decided by the sign of left side less right side.

use super::Check;
use super::calc::{Seen, has_both_signs, sign};
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

/// An inequality that is to be shown for all parameters, decided by the sign of its left side less its right.
pub(super) fn shown(gap: &Expr, relation: Relation, domains: &Domains) -> (Sentence, Check) {
    let seen = sign(gap, domains);
    let holds = match everywhere(seen, relation) {
        // What is positive somewhere and negative elsewhere holds not for all.
        None if has_both_signs(gap, domains) => Some(false),
        found if seen.is_proved() => found,
        _ => None,
    };
    let is_sided = seen.side().is_some();
    let words = match holds {
        Some(true) => "the sign of the difference is proved on the whole domain",
        Some(false) => "the difference has another sign, or has it on a part of the domain only",
        None if is_sided => "that both sides are the same somewhere is not excluded",
        None => "the sign of the difference was not proved",
    };
    let difference = sentence!("the difference of its sides is {}", gap);
    let text = match holds {
        Some(true) => sentence!("{}, which is {}", difference, sign_words(seen)),
        Some(false) => sentence!("it does not hold for all values: {}", difference),
        None if is_sided => sentence!("not decided: {}, which is {}", difference, sign_words(seen)),
        None => sentence!("not decided: {}", difference),
    };
    (text, Check::new("sign", String::from(words), holds))
}
