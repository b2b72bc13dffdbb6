//! Strangers' input: random formulas, answers and scenes, half of them built from pieces, half mutated from the tables and
//! scenes of this repository. Nothing panics, nothing runs away, whatever is read reads back.
//!
//! `CAROM_FUZZ=10000000 cargo test --release --test all fuzz:: -- --nocapture --test-threads=1` runs ten million inputs: eight
//! tenths read, a tenth graded, a tenth read as scenes; and one in a hundred more where a scene is worked out. A case is known
//! by its number; the slowest input of each target is printed, and `CAROM_FROM` says where to take a run up again.

use crate::shared;
use crate::shared::clock;
#[path = "fuzz/worked.rs"]
mod worked;

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use carom::formula::{self, Symbols};
use carom::grade::{Options, Question, Verdict, entry, judge};
use carom::numeric::random::Rng;
use carom::{render, scene};

/// Inputs in all targets together: few by default, as many as `CAROM_FUZZ` says for a long run.
fn inputs() -> u64 {
    told("CAROM_FUZZ").unwrap_or(5_000)
}

fn told(name: &str) -> Option<u64> {
    std::env::var(name).ok()?.parse().ok()
}

/// Pieces of formulas, sound and hostile, between blanks; those with blanks or control characters in them stand apart.
const PIECES: &str = r"a b m_1 v_{2} v1' theta θ \ell \omega^{+} \dot\theta \hat_k \vec_v e I_1 2 0 1.5 .5 4. 1e3 1e-400
    1e999999 00 9999999999999999999999 ½ 3,5 50% \% + - − * · \cdot / ÷ ^ ** _ ' ² ⁻¹ ± +- \pm = == < ≤ \ne \approx , ; . |
    \left| \right| ! & \\ # @ ~ $ \( \) ( ) [ ] { } \{ \left( \right) ⟨ \rangle \frac \dfrac12 \frac{a}{b} \sqrt \sqrt[3] √ ∛
    sqrt( sin \cos tan^2 \sin^{-1} asin abs( ln \log_ exp( sinh pi π 30° ^\circ \,\mathrm{m} \text{s} \begin{pmatrix}
    \end{pmatrix} \boxed{ \operatorname{sin} \mathbf{i} \input{x} \def <script> é 中 𝄞 𝑚 ^^ (((((((( )))) ^9^9^9 ^{9999} -(-(-(
    1/(a-a) a/0 0^0";
const BLANKS_INSIDE: [&str; 12] = [
    " ",
    " deg",
    " m/s",
    " kg",
    " N m",
    " rad/s",
    "\\text{the answer is }",
    "x 10^3",
    "\u{0}",
    "\u{200b}",
    "\u{202e}",
    "\u{feff}",
];

fn piece(rng: &mut Rng, all: &[&'static str]) -> &'static str {
    match rng.below(6) {
        0 => BLANKS_INSIDE[rng.below(BLANKS_INSIDE.len())],
        _ => all[rng.below(all.len())],
    }
}

fn all_pieces() -> Vec<&'static str> {
    PIECES.split_whitespace().collect()
}

/// Random pieces side by side.
fn pieces(rng: &mut Rng) -> String {
    let most = if rng.below(40) == 0 { 200 } else { 14 };
    let (count, all) = (1 + rng.below(most), all_pieces());
    (0..count).map(|_| piece(rng, &all)).collect()
}

/// A formula grown from its grammar, so that most are read.
fn grown(rng: &mut Rng, depth: u32) -> String {
    const LEAVES: &str = "a b m v l m_1 v_2 theta 2 3 1/2 0.25 pi e 7";
    let leaf = |rng: &mut Rng| {
        let count = LEAVES.split(' ').count();
        LEAVES
            .split(' ')
            .nth(rng.below(count))
            .unwrap_or("a")
            .to_string()
    };
    if depth == 0 {
        return leaf(rng);
    }
    let part = |rng: &mut Rng| grown(rng, depth - 1);
    match rng.below(14) {
        0 | 1 => format!("({} + {})", part(rng), part(rng)),
        2 => format!("({} - {})", part(rng), part(rng)),
        3 | 4 => format!("{}*{}", part(rng), part(rng)),
        5 => format!("({})/({})", part(rng), part(rng)),
        6 => format!("\\frac{{{}}}{{{}}}", part(rng), part(rng)),
        7 => format!("({})^{}", part(rng), rng.below(5)),
        8 => format!("sqrt({})", part(rng)),
        9 => format!("sin({})", part(rng)),
        10 => format!("cos({})", part(rng)),
        11 => format!("|{}|", leaf(rng)),
        12 => format!("-({})", part(rng)),
        _ => leaf(rng),
    }
}

/// A few bytes of a text changed, cut, doubled or moved; always UTF-8 again.
fn mutated(text: &str, other: &str, rng: &mut Rng) -> String {
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..1 + rng.below(4) {
        let at = rng.below(bytes.len() + 1);
        match rng.below(7) {
            0 => bytes.insert(at, rng.word() as u8),
            1 if at < bytes.len() => bytes[at] = rng.word() as u8,
            2 if at < bytes.len() => {
                bytes.remove(at);
            }
            3 => bytes.truncate(at),
            4 => {
                let piece = piece(rng, &all_pieces()).as_bytes();
                bytes.splice(at..at, piece.iter().copied());
            }
            5 => {
                let stop = at + rng.below(bytes.len() - at + 1);
                let doubled = bytes[at..stop].to_vec();
                bytes.splice(at..at, doubled);
            }
            _ => {
                let from = rng.below(other.len() + 1);
                bytes.truncate(at);
                bytes.extend_from_slice(&other.as_bytes()[from..]);
            }
        }
        bytes.truncate(1 << 16);
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Formulas and answers of the tables.
fn corpus() -> Vec<String> {
    let mut all = Vec::new();
    for folder in ["tests/grading", "tests/formula"] {
        for file in shared::files(folder, "tsv") {
            for line in fs::read_to_string(file).expect("a table").lines() {
                all.extend(line.split('\t').take(2).map(str::to_string));
            }
        }
    }
    assert!(all.len() > 1_000, "{} texts", all.len());
    all
}

/// What a formula may take.
const LONG: Duration = Duration::from_millis(50);

/// The slowest input so far.
#[derive(Default)]
struct Slowest {
    time: Duration,
    case: u64,
    input: String,
}

/// Runs cases, names the input of a panic, and tells the slowest.
fn run(
    target: &str,
    cases: u64,
    longest: Duration,
    mut one: impl FnMut(&mut Rng) -> (String, Box<dyn FnOnce()>),
) {
    let mut slowest = Slowest::default();
    let (mut tenths, mut over) = (1, 0u64);
    let begun = Instant::now();
    // What runs away is named rather than waited for.
    let now = Arc::new(Mutex::new(Some((begun, 0, String::new()))));
    let (watched, name) = (now.clone(), target.to_string());
    let watch = std::thread::spawn(move || {
        loop {
            std::thread::sleep(Duration::from_millis(200));
            match &*watched.lock().expect("a lock") {
                Some((start, case, input)) if start.elapsed() > 3 * longest => {
                    eprintln!("{name}, case {case} has not ended: {input:?}");
                    std::process::exit(1);
                }
                Some(_) => {}
                None => return,
            }
        }
    });
    for case in told("CAROM_FROM").unwrap_or(0)..cases {
        let mut rng = Rng::new(case ^ 0x00fa_11ed);
        let (input, work) = one(&mut rng);
        let start = Instant::now();
        *now.lock().expect("a lock") = Some((start, case, input.clone()));
        if catch_unwind(AssertUnwindSafe(work)).is_err() {
            panic!("{target}, case {case}: {input:?}");
        }
        let time = start.elapsed();
        over += u64::from(time > LONG);
        if time > LONG && std::env::var("SHOW").is_ok() {
            println!("{time:.0?} {case} {input:?}");
        }
        if time > slowest.time {
            slowest = Slowest { time, case, input };
        }
        if cases >= 100_000 && case * 10 >= cases * tenths {
            println!("{target}: case {case} reached in {:.0?}", begun.elapsed());
            tenths += 1;
        }
    }
    *now.lock().expect("a lock") = None;
    watch.join().expect("a watch");
    let head: String = slowest.input.chars().take(300).collect();
    println!(
        "{target}: {cases} inputs in {:.0?}, {over} above {LONG:.0?}; the slowest, case {}, took {:.1?}: {head:?}",
        begun.elapsed(),
        slowest.case,
        slowest.time
    );
    assert!(
        slowest.time < longest,
        "{target}: {:?} for {head:?}",
        slowest.time
    );
}

fn text(rng: &mut Rng, corpus: &[String]) -> String {
    match rng.below(4) {
        0 => pieces(rng),
        1 => {
            let depth = 1 + rng.below(4) as u32;
            grown(rng, depth)
        }
        _ => {
            let (one, other) = (rng.below(corpus.len()), rng.below(corpus.len()));
            mutated(&corpus[one], &corpus[other], rng)
        }
    }
}

fn read_anything(cases: u64) {
    let corpus = corpus();
    let strict: Symbols = ["a", "b", "m_1", "v_{2}", "theta", "l", "v"]
        .into_iter()
        .collect();
    run("reader", cases, Duration::from_secs(1), |rng| {
        let text = text(rng, &corpus);
        let symbols = if rng.below(2) == 0 {
            Symbols::open()
        } else {
            strict.clone()
        };
        let input = text.clone();
        let work = move || match formula::read(&text, &symbols) {
            Ok(reading) => {
                // What was read is one formula in every notation.
                let shown = carom::grade::show(&reading.content);
                if let Some(e) = reading.expr() {
                    let _ = formula::write_latex(e, &|_| None);
                }
                for note in &reading.notes {
                    assert!(!note.message(&text).is_empty());
                }
                assert!(!shown.is_empty());
            }
            Err(fault) => {
                assert!(
                    fault.start <= fault.end && fault.end <= text.len(),
                    "{fault:?}"
                );
                assert!(text.is_char_boundary(fault.start) && text.is_char_boundary(fault.end));
                let _ = fault.show(&text);
            }
        };
        (input, Box::new(work))
    });
}

fn grade_anything(cases: u64) {
    let corpus = corpus();
    run("grading", cases, Duration::from_secs(10), |rng| {
        let expected = text(rng, &corpus);
        let answer = match rng.below(3) {
            0 => text(rng, &corpus),
            _ => mutated(&expected, "a+b", rng),
        };
        let input = format!("{expected} | {answer}");
        // Every tenth as a line of a batch, whole or damaged.
        let line = (rng.below(10) == 0).then(|| {
            let line =
                serde_json::json!({"id": 1, "expected": expected, "answer": answer}).to_string();
            match rng.below(2) {
                0 => line,
                _ => mutated(
                    &line,
                    "\"symbols\": {\"a\": {\"domain\": {\"min\": 0}}}}",
                    rng,
                ),
            }
        });
        let work = move || match line {
            Some(line) => {
                if let Ok(entry) = entry::entry(&line, &Options::default()) {
                    let no_scene = |_: &entry::Entry, _: &str| Err("no scene here".to_string());
                    let grade = entry::judge(&entry, &mut entry::Keys::default(), &no_scene);
                    let mut out = String::new();
                    render::grade::line(&mut out, &entry.id, 1, &grade, &entry.answer);
                    let _: serde_json::Value = serde_json::from_str(&out).expect("JSON out");
                }
            }
            None => {
                let grade = judge(
                    &expected,
                    &answer,
                    &Question::default(),
                    &Options::default(),
                );
                if expected == answer {
                    assert_ne!(grade.verdict, Verdict::Different);
                }
                let _ = render::grade::text(&grade, &answer);
            }
        };
        (input, Box::new(work))
    });
}

fn read_any_scene(cases: u64) {
    let scenes: Vec<String> = ["derivations", "derivations/refused"]
        .iter()
        .flat_map(|folder| shared::files(folder, "json"))
        .map(|file| fs::read_to_string(file).expect("a scene"))
        .filter(|text| text.len() < 8_000)
        .collect();
    let corpus = corpus();
    run("scenes", cases, Duration::from_secs(10), |rng| {
        let scene_text = scenes[rng.below(scenes.len())].clone();
        let damaged = match rng.below(3) {
            // A value replaced by a formula, or by one of another place, keeps the shape of a scene.
            0 | 1 => replaced(&scene_text, &text(rng, &corpus), rng),
            _ => {
                let other = rng.below(scenes.len());
                mutated(&scene_text, &scenes[other], rng)
            }
        };
        let derive = rng.below(100) == 0;
        let input = damaged.clone();
        let work = move || match scene::read(&damaged) {
            Ok(scene) if derive && !scene.has_stages() && scene.bodies.len() < 5 => {
                let _ = carom::derive::derive(&scene);
            }
            Ok(_) => {}
            Err(faults) => assert!(!faults.list.is_empty()),
        };
        (input, Box::new(work))
    });
}

/// A text of a scene with one of its quoted texts replaced by another text or by one of its own.
fn replaced(scene: &str, formula: &str, rng: &mut Rng) -> String {
    let quotes: Vec<usize> = scene.match_indices('"').map(|(at, _)| at).collect();
    if quotes.len() < 4 {
        return scene.to_string();
    }
    let spot = |rng: &mut Rng| {
        let i = rng.below(quotes.len() / 2) * 2;
        (quotes[i] + 1, quotes[i + 1])
    };
    let (start, end) = spot(rng);
    let (from, to) = spot(rng);
    let new = match rng.below(3) {
        0 => scene[from..to].to_string(),
        _ => formula.replace(['"', '\\', '\n'], " "),
    };
    format!("{}{}{}", &scene[..start], new, &scene[end..])
}

#[test]
fn eight_tenths_of_the_inputs_are_read_without_a_panic() {
    read_anything(inputs() / 10 * 8);
}

#[test]
fn a_tenth_of_the_inputs_is_graded_without_a_panic() {
    grade_anything(inputs() / 10);
}

#[test]
fn a_tenth_of_the_inputs_is_read_as_scenes_without_a_panic() {
    read_any_scene(inputs() / 10);
}

#[test]
fn answers_in_scenes_are_judged_without_a_panic() {
    worked::answer_anything(inputs() / 250);
}

#[test]
fn worked_solutions_are_checked_without_a_panic() {
    worked::check_any_solution(inputs() / 250);
}

#[test]
fn printed_answers_are_verified_without_a_panic() {
    worked::verify_anything(inputs() / 1_000);
}

#[test]
fn changed_stages_are_worked_out_without_a_panic() {
    worked::work_out_any_stages(inputs() / 1_000);
}

#[test]
fn hostile_formulas_are_refused_in_an_instant() {
    let rows: Vec<(&str, String)> = vec![
        ("tower of powers", "9^9^9^9".into()),
        ("million brackets", "(".repeat(1_000_000)),
        (
            "million closed brackets",
            format!("{}a{}", "(".repeat(30_000), ")".repeat(30_000)),
        ),
        ("million digits", "9".repeat(1_000_000)),
        ("digits within the limit of a text", "9".repeat(65_000)),
        ("huge exponent", "1e1000000000".into()),
        ("deep fractions", "\\frac{".repeat(10_000)),
        ("deep roots", "\\sqrt{".repeat(9_000)),
        ("deep indices", format!("v{}", "_{".repeat(30_000))),
        ("many signs", "-".repeat(65_000)),
        (
            "many names",
            (0..9_000).map(|i| format!("x_{i}+")).collect(),
        ),
        ("many letters", "a".repeat(65_000)),
        ("many dollars", "$".repeat(65_000)),
        ("huge power", "(a+b)^1000000000".into()),
        ("zero-width space", "a\u{200b}b".into()),
        ("right-to-left override", "a\u{202e}b".into()),
        ("input", "\\input{/etc/passwd}".into()),
        ("definition", "\\def\\a{\\a\\a}\\a".into()),
        ("script", "<script>alert(1)</script>".into()),
        ("NUL", "a\u{0}b".into()),
        (
            "half a surrogate",
            String::from_utf8_lossy(b"\xed\xa0\x80").into_owned(),
        ),
        ("many boxes", "\\boxed{".repeat(9_000)),
        ("many bars", "|".repeat(65_000)),
        ("many words", "sin ".repeat(16_000)),
        ("unit without end", format!("5 {}", "kg ".repeat(20_000))),
    ];
    // Tests are built without optimization.
    let longest = Duration::from_millis(if cfg!(debug_assertions) { 1_000 } else { 10 });
    let mut late = Vec::new();
    println!("{:<36} {:>10}  verdict", "input", "time");
    for (name, text) in rows {
        // The best of three: what is measured is the work, not what else the machine does.
        let mut best = Duration::MAX;
        let mut verdict = Verdict::Undecided;
        for _ in 0..3 {
            let (grade, spent) =
                clock::spent(|| judge("a", &text, &Question::default(), &Options::default()));
            verdict = grade.verdict;
            best = best.min(spent);
        }
        println!("{name:<36} {best:>10.1?}  {}", verdict.word());
        assert_ne!(verdict, Verdict::Equivalent, "{name}");
        if best > longest {
            late.push(format!("{name}: {best:?}"));
        }
    }
    assert!(late.is_empty(), "{}", late.join("\n"));
}
