//! Facts about judging.
use super::*;

fn grade(expected: &str, answer: &str) -> Grade {
    judge(expected, answer, &Question::default(), &Options::default())
}

#[test]
fn a_rearranged_formula_is_equivalent_and_a_wrong_sign_is_told() {
    assert_eq!(
        grade("3v cosθ/2ℓ", "1.5 v cos(theta)/l").note,
        "EQUIV_IDENTITY"
    );
    assert_eq!(grade("a - b", "b - a").note, "DIFF_SIGN");
    assert_eq!(grade("3*v/(2*l)", "3*v/l").note, "DIFF_FACTOR");
    assert_eq!(grade("a", "(a").verdict, Verdict::Invalid);
}

#[test]
fn a_word_behind_a_number_is_called_a_unit_as_a_whole() {
    let message = |answer| grade("5*a", answer).error.map(|fault| fault.message);
    let unit = "`apples` is no unit known here";
    assert_eq!(message("5 apples").as_deref(), Some(unit));
    let name = "`apples` is no name of the question";
    assert_eq!(message("a + apples").as_deref(), Some(name));
}

#[test]
fn what_takes_too_much_work_is_undecided_for_that_reason() {
    let expected = "sin(7*q)^9*cos(5*q)^9*sin(4*p)^9*cos(3*p)^9 = acos(w/4) + atan(9/12)";
    let open = grade(expected, "q = sin(7*q)^9*cos(5*q)^9*sin(4*p)^9*cos(3*p)^9");
    assert_eq!(open.note, "UNDECIDED_LIMIT");
    assert!(open.proof.words.contains("limit of work"));
}

#[test]
fn values_that_are_all_rounded_are_told_as_rounded() {
    let note = |answer| grade("1 ± sqrt(2)", answer).note;
    assert_eq!(note("2.414 or -0.414"), "DIFF_ROUNDED");
    assert_eq!(note("2.414 or 1 - sqrt(2)"), "DIFF_ROUNDED");
    assert_eq!(note("2.414 or -0.5"), "DIFF_ROOT_GAINED");
    // Two roundings of one value are not both.
    assert_eq!(note("2.414 or 2.41"), "DIFF_ROOT_GAINED");
}
