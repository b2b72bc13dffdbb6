//! What is told of relations with other solutions: note, words and hint.

use crate::grade::Grade;

/// Note, words and hint where each of two equations has a solution of its own, and where one is lost or gained.
pub(super) const OTHER: [&str; 3] = [
    "DIFF_EQUATION",
    "the equation says something else than the expected one",
    "compare your equation with the law it comes from, term by term",
];

pub(super) const LOST: [&str; 3] = [
    "DIFF_ROOT_LOST",
    "a solution of the expected equation does not fulfil the answer",
    "a solution is missing or the equation says something else",
];

pub(super) const GAINED: [&str; 3] = [
    "DIFF_ROOT_GAINED",
    "the answer has a solution that the expected equation lacks",
    "your equation is fulfilled where it should not be",
];

/// Different, with note, words and hint.
pub(super) fn told([note, words, hint]: [&'static str; 3]) -> Grade {
    Grade::told(note, "solutions", words, hint)
}

/// Note, words and hint for relations that hold at different numbers.
pub(super) const OTHER_NUMBERS: [&str; 3] = [
    "DIFF_INEQUALITY",
    "one holds where the other does not",
    "check the bound and the direction of your inequality",
];

/// What is said of a relation that holds at a point, and of one that does not.
pub(super) fn holding(holds: bool) -> &'static str {
    if holds { "holds" } else { "does not hold" }
}
