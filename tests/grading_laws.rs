//! Laws of grading over the shipped answers: whatever is rewritten stays right, whatever is changed at one place is
//! refuted, and an evaluation in doubles that shares nothing with the decision agrees.
//!
//! `CAROM_CASES=1000000 cargo test --release --test all grading_laws:: -- --nocapture` for a long run.

use crate::shared;

use std::fs;

use carom::domain::Domains;
use carom::expr::{Expr, Function, Node, Point};
use carom::formula::{Content, write_latex, write_plain, write_unicode};
use carom::grade::sheet::{Entry, Sheet};
use carom::grade::{Key, Options, Question, Strength, Verdict, judge, judge_against};
use carom::numeric::{self, points::Needed, random::Rng};
use carom::scene;

/// Cases of each test: few by default, as many as `CAROM_CASES` says for a long run.
fn cases() -> u64 {
    told("CAROM_CASES").unwrap_or(300)
}

/// The cases by number, from the one `CAROM_FROM` says; a long run tells how far it is.
fn numbered(cases: u64) -> impl Iterator<Item = u64> {
    let from = told("CAROM_FROM").unwrap_or(0);
    (from..cases).inspect(|case| {
        if case % 100_000 == 99_999 {
            println!("case {} reached", case + 1);
        }
    })
}

fn told(name: &str) -> Option<u64> {
    std::env::var(name).ok()?.parse().ok()
}

/// Every scalar answer of every shipped scene, long ones aside.
fn answers() -> Vec<(Sheet, Entry, Expr)> {
    let files = shared::files("derivations", "json");
    let mut all = Vec::new();
    for file in files {
        let text = fs::read_to_string(&file).expect("a scene");
        let Ok(scene) = scene::read(&text) else {
            continue;
        };
        let Ok(sheet) = shared::sheet(scene) else {
            continue;
        };
        for name in sheet.quantities() {
            let Ok(entry) = sheet.entry(&name) else {
                continue;
            };
            if let Content::Scalar(e) = &entry.key.reading.content
                && e.size() < 120
                && !e.symbols().is_empty()
            {
                all.push((sheet.clone(), entry.clone(), e.clone()));
            }
        }
    }
    assert!(all.len() > 30, "{} answers", all.len());
    all
}

/// Changes the part at a random place.
fn at_random(
    e: &Expr,
    rng: &mut Rng,
    change: &mut dyn FnMut(&Expr, &mut Rng) -> Option<Expr>,
) -> Option<Expr> {
    let mut left = rng.below(e.size()) as isize;
    fn go(
        e: &Expr,
        left: &mut isize,
        rng: &mut Rng,
        change: &mut dyn FnMut(&Expr, &mut Rng) -> Option<Expr>,
        hit: &mut bool,
    ) -> Expr {
        if *left == 0 {
            *left -= 1;
            return match change(e, rng) {
                Some(new) => {
                    *hit = true;
                    new
                }
                None => e.clone(),
            };
        }
        *left -= 1;
        // Exponents stay whole, so that values stay real.
        if let Node::Power(base, k) = e.node() {
            let base = go(base, left, rng, change, hit);
            return base.power(k.clone());
        }
        e.map_parts(|part| go(part, left, rng, change, hit))
    }
    let mut hit = false;
    let new = go(e, &mut left, rng, change, &mut hit);
    hit.then_some(new)
}

/// The same value written otherwise.
fn rewrite(e: &Expr, rng: &mut Rng) -> Option<Expr> {
    let two = Expr::from(2);
    Some(match (e.node(), rng.below(4)) {
        (Node::Number(_), 0) => (e + &Expr::one()) * &two - e - &two,
        (Node::Number(_), _) => Expr::product([e * &two, Expr::ratio(1, 2)]),
        (Node::Symbol(name), 0) if &**name != "pi" => e.powi(2) / e,
        (Node::Symbol(_), 1) => e * &two - e,
        (Node::Sum(terms), 0) => Expr::sum(terms.iter().rev().cloned()),
        (Node::Sum(terms), _) => Expr::sum(terms.iter().map(|t| t * &two)) * Expr::ratio(1, 2),
        (Node::Product(factors), 0) => Expr::product(factors.iter().rev().cloned()),
        (Node::Product(factors), _) => {
            let (i, sum) = factors
                .iter()
                .enumerate()
                .find(|(_, f)| matches!(f.node(), Node::Sum(_)))?;
            let Node::Sum(terms) = sum.node() else {
                return None;
            };
            let rest = Expr::product(
                factors
                    .iter()
                    .enumerate()
                    .filter(|(j, _)| *j != i)
                    .map(|(_, f)| f.clone()),
            );
            Expr::sum(terms.iter().map(|t| t * &rest))
        }
        (Node::Power(base, k), _) if k.as_number().is_some_and(|k| k.is_integer()) => {
            base.power(k - &Expr::one()) * base
        }
        (Node::Call(Function::Sin, x), _) => {
            (x * &Expr::ratio(1, 2)).sin() * (x * &Expr::ratio(1, 2)).cos() * two
        }
        (Node::Call(Function::Cos, x), 0) => {
            Expr::one() - (x * &Expr::ratio(1, 2)).sin().powi(2) * two
        }
        (Node::Call(Function::Cos, x), _) => (Expr::pi() * Expr::ratio(1, 2) - x).sin(),
        _ => return None,
    })
}

/// Another formula that differs at one place.
fn mutate(e: &Expr, symbols: &[Expr], rng: &mut Rng) -> Option<Expr> {
    Some(match (e.node(), rng.below(4)) {
        (Node::Number(_), 0) => e + &Expr::one(),
        (Node::Number(_), _) => e * &Expr::from(2),
        (Node::Symbol(_), 0) => symbols[rng.below(symbols.len())].clone(),
        (Node::Symbol(_), _) => e * &Expr::from(2),
        (Node::Sum(terms), 0) => Expr::sum(terms[1..].iter().cloned()),
        (Node::Sum(terms), _) => {
            let i = rng.below(terms.len());
            Expr::sum(
                terms
                    .iter()
                    .enumerate()
                    .map(|(j, t)| if i == j { -t } else { t.clone() }),
            )
        }
        (Node::Product(factors), 0) => Expr::product(factors[1..].iter().cloned()),
        (Node::Product(_), _) => -e,
        (Node::Power(base, k), _) => base.power(k + &Expr::one()),
        (Node::Call(Function::Sin, x), _) => x.cos(),
        (Node::Call(Function::Cos, x), _) => x.sin(),
        _ => return None,
    })
}

/// Whether two expressions agree in doubles at points of the domain; `None` where they have no value.
fn agree(a: &Expr, b: &Expr, domains: &Domains) -> Option<bool> {
    let mut needed = Needed::default();
    needed.add(a);
    needed.add(b);
    let mut known = 0;
    for seed in 100..106 {
        let point: Point<f64> = numeric::rounded(&numeric::random_point(&needed, domains, seed));
        if let (Some(x), Some(y)) = (a.evaluate(&point), b.evaluate(&point)) {
            known += 1;
            if (x - y).abs() > 1e-7 * x.abs().max(y.abs()).max(1e-6) {
                return Some(false);
            }
        }
    }
    (known > 0).then_some(true)
}

/// A text of a formula in one of the three notations.
fn written(e: &Expr, rng: &mut Rng) -> String {
    match rng.below(3) {
        0 => write_plain(e),
        1 => write_unicode(e, &|_| None),
        _ => write_latex(e, &|_| None),
    }
}

/// The comparison at points modulo a prime reaches the verdict of the proof, with a key and without one.
fn same_when_fast(key: &Key, text: &str, sure: Verdict, case: u64) {
    let fast = Options {
        strength: Strength::Fast,
        ..Options::default()
    };
    let quick = judge_against(key, text, &fast);
    assert!(
        quick.verdict == sure || sure == Verdict::Undecided,
        "case {case}: {text} is {sure:?}, and fast {:?}: {}",
        quick.verdict,
        quick.proof.words
    );
    // The same with nothing declared, where every symbol is positive.
    let expected = match &key.reading.content {
        Content::Scalar(e) => write_plain(e),
        _ => return,
    };
    let question = Question::default();
    let quick = judge(&expected, text, &question, &fast);
    if quick.proof.kind == "modular" {
        let sure = judge(&expected, text, &question, &Options::default()).verdict;
        assert!(
            quick.verdict == sure || sure == Verdict::Undecided,
            "case {case}: {text} against {expected} is {sure:?}, and fast {:?}: {}",
            quick.verdict,
            quick.proof.words
        );
    }
}

#[test]
fn a_rewritten_answer_is_right_in_every_notation() {
    let answers = answers();
    let mut undecided = 0;
    for case in numbered(cases()) {
        let mut rng = Rng::new(case);
        let (sheet, entry, e) = &answers[rng.below(answers.len())];
        let mut new = e.clone();
        for _ in 0..1 + rng.below(3) {
            new = at_random(&new, &mut rng, &mut rewrite).unwrap_or(new);
        }
        let text = written(&new, &mut rng);
        let grade = judge_against(&entry.key, &text, &Options::default());
        same_when_fast(&entry.key, &text, grade.verdict, case);
        match grade.verdict {
            Verdict::Equivalent => {}
            Verdict::Undecided => undecided += 1,
            other => panic!(
                "case {case}, {}: {} for {text}: {other:?}, {:?}",
                sheet.scene.title,
                write_plain(e),
                grade.error
            ),
        }
    }
    println!("{} rewrites, {undecided} undecided", cases());
    assert!(
        undecided * 1000 <= cases(),
        "{undecided} of {} undecided",
        cases()
    );
}

#[test]
fn a_changed_answer_is_refuted_where_doubles_see_it_too() {
    let answers = answers();
    let (mut refuted, mut equal, mut undecided) = (0u64, 0u64, 0u64);
    for case in numbered(cases()) {
        let mut rng = Rng::new(case.wrapping_mul(7) + 3);
        let (sheet, entry, e) = &answers[rng.below(answers.len())];
        let symbols: Vec<Expr> = e.symbols().iter().map(|s| Expr::symbol(s)).collect();
        let Some(new) = at_random(e, &mut rng, &mut |part, rng| mutate(part, &symbols, rng)) else {
            continue;
        };
        let text = written(&new, &mut rng);
        let grade = judge_against(&entry.key, &text, &Options::default());
        same_when_fast(&entry.key, &text, grade.verdict, case);
        let seen = agree(e, &new, &sheet.scene.domains);
        match (grade.verdict, seen) {
            (Verdict::Equivalent, Some(false)) => {
                panic!("case {case}: {} taken for {text}", write_plain(e))
            }
            (Verdict::Different, Some(true)) => panic!(
                "case {case}: {} told from {text}, {:?}",
                write_plain(e),
                grade.counterexample
            ),
            (Verdict::Different, _) => {
                assert!(
                    grade.counterexample.is_some(),
                    "case {case}: no point for {text}"
                );
                refuted += 1;
            }
            (Verdict::Equivalent, _) => equal += 1,
            (Verdict::Undecided, _) => undecided += 1,
            // A division by zero is no answer.
            (Verdict::Invalid, _) => {
                assert!(
                    grade.error.is_none(),
                    "case {case}: {text}: {:?}",
                    grade.error
                );
            }
        }
    }
    println!(
        "{} changes: {refuted} refuted, {equal} equal after all, {undecided} undecided",
        cases()
    );
    assert!(
        undecided * 1000 <= cases(),
        "{undecided} of {} undecided",
        cases()
    );
    assert!(refuted * 10 > cases() * 7, "only {refuted} refuted");
}

#[test]
fn no_jumble_of_tokens_makes_grading_panic() {
    const TOKENS: [&str; 48] = [
        "a", "b", "v_1", "theta", "θ", "\\frac", "{", "}", "(", ")", "[", "]", "|", "^", "_", "+",
        "-", "±", "*", "/", "=", "<", "≤", "sin", "cos", "\\sqrt", "√", "²", "1", "2.5", "1e9",
        "0", "pi", "°", "m/s", "kg", " ", ",", ".", "'", "\\left", "\\right", "\\cdot", "abs",
        "ln", "e", "\\hat i", "\\boxed",
    ];
    for case in numbered(cases() * 10) {
        let mut rng = Rng::new(case ^ 0x5eed);
        let text = |rng: &mut Rng| -> String {
            (0..1 + rng.below(12))
                .map(|_| TOKENS[rng.below(TOKENS.len())])
                .collect()
        };
        let (expected, answer) = (text(&mut rng), text(&mut rng));
        let grade = carom::grade::judge(
            &expected,
            &answer,
            &carom::grade::Question::default(),
            &Options::default(),
        );
        // Whatever can be read equals itself, or has no value.
        let same = carom::grade::judge(
            &expected,
            &expected,
            &carom::grade::Question::default(),
            &Options::default(),
        );
        assert_ne!(
            same.verdict,
            Verdict::Different,
            "{expected}: {}",
            same.note
        );
        assert!(grade.verdict.reward().is_some() || !grade.note.is_empty());
    }
}
