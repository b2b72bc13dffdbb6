//! The public table of cases: what is expected, what is answered, the verdict, and why.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use carom::command;
use carom::grade::sheet::Sheet;
use carom::grade::{Given, Grade, Options, Question, Strength, Verdict, entry, judge};
use carom::scene;
use rayon::prelude::*;

use crate::shared::{self, clock};
#[path = "grading/manual.rs"]
mod manual;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Rows of a table: file, line number, cells.
fn rows(filter: impl Fn(&str) -> bool) -> Vec<(String, usize, Vec<String>)> {
    let mut files: Vec<PathBuf> = fs::read_dir(root().join("tests/grading"))
        .expect("a folder of tables")
        .map(|e| e.expect("an entry").path())
        .filter(|p| p.extension().is_some_and(|e| e == "tsv"))
        .collect();
    files.sort();
    let mut all = Vec::new();
    for file in files {
        let name = file
            .file_name()
            .expect("a name")
            .to_string_lossy()
            .to_string();
        if !filter(&name) {
            continue;
        }
        let text = fs::read_to_string(&file).expect("a readable table");
        for (i, line) in text
            .lines()
            .enumerate()
            .filter(|(_, l)| !l.starts_with("# "))
        {
            all.push((
                name.clone(),
                i + 1,
                // ↵ ends a line within a cell.
                line.split('\t')
                    .map(|cell| cell.replace('↵', "\n"))
                    .collect(),
            ));
        }
    }
    all
}

/// `e=0..1 v=real` as declarations.
fn question(text: &str) -> Question {
    let mut question = Question::default();
    for word in text.split_whitespace() {
        let (name, domain) = word.split_once('=').expect("NAME=DOMAIN");
        let value = match domain.split_once("..") {
            Some((low, high)) => serde_json::json!({"min": low, "max": high}),
            None => serde_json::json!(domain),
        };
        let domain = entry::domain(&value).expect("a domain");
        question.domains.symbols.insert(name.into(), domain);
        question.symbols.push(Given {
            name: name.into(),
            latex: None,
            dimension: None,
        });
    }
    question
}

#[test]
fn every_row_of_the_tables_gets_its_verdict() {
    let mut wrong = String::new();
    let rows = rows(|name| name != "scenes.tsv");
    for (file, line, cells) in &rows {
        let [expected, answer, verdict, reason] = [0, 1, 2, 3].map(|i| cells[i].as_str());
        let symbols = cells.get(4).map_or("", String::as_str);
        let grade = judge(expected, answer, &question(symbols), &Options::default());
        let given = cells
            .get(5)
            .is_none_or(|given| grade.assumed.contains(given));
        if grade.verdict.word() != verdict || !given {
            let read = grade.read_as().unwrap_or_default();
            let _ = writeln!(
                wrong,
                "{file}:{line} {expected} | {answer} [{reason}] is {} ({}; read {read}; given {:?}), not {verdict}",
                grade.verdict.word(),
                grade.note,
                grade.assumed
            );
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn the_tables_have_at_least_eleven_hundred_rows() {
    let count = rows(|_| true).len();
    assert!(count >= 1_100, "{count} rows");
}

#[test]
fn the_manual_says_what_the_tables_say() {
    let steps = fs::read_to_string(root().join("tests/grading/steps/falling-stick-energy.tsv"));
    let steps = steps.expect("a worked solution").replace('\t', "  ");
    let page = manual::page(&rows(|name| name != "scenes.tsv"), &steps, &question);
    let path = root().join("GRADING.md");
    if std::env::var_os("UPDATE").is_some() {
        fs::write(&path, &page).expect("written");
    }
    let known = fs::read_to_string(&path).unwrap_or_default();
    assert!(
        page == known,
        "GRADING.md is old: UPDATE=1 cargo test --test all grading::"
    );
}

/// The proved answers of a scene, those about answers and of all stages among them.
fn keys(scene: scene::Scene) -> Sheet {
    command::sheet(scene).expect("answers that are proved").0
}

#[test]
fn answers_to_scenes_get_their_verdict_and_the_belief_behind_them() {
    let mut wrong = String::new();
    for (file, line, cells) in rows(|name| name == "scenes.tsv") {
        let [path, quantity, answer, verdict, code] = [0, 1, 2, 3, 4].map(|i| cells[i].as_str());
        let sheet = shared::key(&Path::new("derivations").join(path));
        let entry = sheet.entry(quantity).expect("a question of the scene");
        let grade = sheet.judge(&entry, answer, &Options::default());
        let codes: Vec<&str> = grade.diagnosis.iter().map(|d| d.code).collect();
        // What is right but for its sign is never told to be right for another quantity.
        let twice = codes.contains(&"SIGN") && codes.contains(&"OTHER_QUANTITY");
        // A mark of exclamation stands before what must not be found.
        let told = match code.strip_prefix('!') {
            Some(absent) => !codes.contains(&absent),
            None => code.is_empty() || codes.contains(&code),
        };
        if grade.verdict.word() != verdict || !told || twice {
            let _ = writeln!(
                wrong,
                "{file}:{line} {path} {quantity} | {answer} is {} {codes:?} ({}), not {verdict} {code}",
                grade.verdict.word(),
                grade.note
            );
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn the_fast_comparison_never_contradicts_the_proof() {
    let fast = Options {
        strength: Strength::Fast,
        ..Options::default()
    };
    for (file, line, cells) in rows(|name| name != "scenes.tsv") {
        let symbols = question(cells.get(4).map_or("", String::as_str));
        let [quick, sure] =
            [&fast, &Options::default()].map(|o| judge(&cells[0], &cells[1], &symbols, o).verdict);
        // Where no proof was reached, the fast comparison may still tell, with its bound.
        assert!(
            quick == sure || sure == Verdict::Undecided,
            "{file}:{line}: {quick:?}, {sure:?}"
        );
    }
}

#[test]
fn what_strangers_send_is_refused_in_an_instant() {
    let long = [
        "(".repeat(1_000_000),
        "9".repeat(1_000_000),
        format!("a{}", "+a".repeat(400_000)),
        "\\frac{".repeat(50_000),
        "x^".repeat(50_000),
        "sqrt(".repeat(50_000),
        "|".repeat(100_000),
        "-".repeat(60_000),
        "a".repeat(65_000),
        "9^9^9^9^9^9^9".into(),
        "1e1000000000".into(),
        "(a+b)^1000000000".into(),
        "\u{0}".into(),
        "\u{202e}a".into(),
        "\\input{/etc/passwd}".into(),
        "<script>".into(),
    ];
    for text in long {
        let (grade, spent) =
            clock::spent(|| judge("a", &text, &Question::default(), &Options::default()));
        let head: String = text.chars().take(20).collect();
        assert_ne!(grade.verdict, Verdict::Equivalent, "{head}");
        // No line of what is said about it is longer than people read.
        let told = carom::render::grade::text(&grade, &text);
        assert!(told.lines().all(|l| l.chars().count() < 1_000), "{head}");
        // Ten milliseconds in a release build; tests are built without optimization.
        assert!(spent.as_millis() < 3_000, "{head}: {spent:?}");
    }
}

#[test]
fn a_note_does_not_depend_on_the_order_or_the_names_of_symbols() {
    for (a, b) in [("a - b", "b - a"), ("2*x", "3*x"), ("sin(x)", "cos(x)")] {
        let renamed = |t: &str| t.replace('a', "p").replace('b', "k").replace('x', "y");
        let note = |e: &str, f: &str| judge(e, f, &Question::default(), &Options::default()).note;
        assert_eq!(note(a, b), note(&renamed(a), &renamed(b)));
    }
}

#[test]
fn a_worked_solution_is_followed_beyond_its_first_slip() {
    use carom::grade::steps::{Status, check};
    let path = Path::new("derivations/book/falling-stick.json");
    let text = fs::read_to_string(root().join(path)).expect("a scene");
    let sheet = shared::sheet(scene::read(&text).expect("a sound scene")).expect("a derivation");
    let solution = "Angular momentum about C is conserved.\n\
        J = m*l^2/12\n\
        m*v*l/2*cos(theta) = J*omega\n\
        omega = 6*v*cos(theta)/l\n\
        v_B_y = -omega*l*cos(theta)\n\
        v_B_y = -6*v*cos(theta)^2\n\
        v_B_x = 3*v*sin(theta)*cos(theta)";
    let found: Vec<Status> = check(&sheet, solution, &Options::default())
        .lines
        .into_iter()
        .map(|l| l.status)
        .collect();
    assert_eq!(
        found,
        [
            Status::Comment,
            Status::Defines,
            Status::Wrong,
            Status::Carried(3),
            Status::Holds,
            Status::Carried(3),
            Status::Wrong
        ]
    );
}

#[test]
fn worked_solutions_are_judged_line_by_line() {
    use carom::grade::steps::{Status, check};
    let mut files: Vec<PathBuf> = fs::read_dir(root().join("tests/grading/steps"))
        .expect("a folder of solutions")
        .map(|e| e.expect("an entry").path())
        .collect();
    files.sort();
    assert!(files.len() >= 19);
    // A scene with several solutions is derived once.
    let mut of_scene: BTreeMap<String, Vec<(PathBuf, String)>> = BTreeMap::new();
    for file in files {
        let text = fs::read_to_string(&file).expect("a solution");
        let (head, rows) = text.split_once('\n').expect("a scene and lines");
        let path = head.split_whitespace().nth(1).expect("the scene's path");
        let solutions = of_scene.entry(path.to_owned()).or_default();
        solutions.push((file, rows.to_owned()));
    }
    let misjudged = |sheet: &Sheet, file: &Path, rows: &str| {
        let mut wrong = String::new();
        // The last rows tell the verdicts on the final answers.
        let (finals, rows): (Vec<&str>, Vec<&str>) =
            rows.lines().partition(|row| row.starts_with("answer\t"));
        let (told, lines): (Vec<&str>, Vec<&str>) = rows
            .into_iter()
            .map(|row| row.split_once('\t').expect("two cells"))
            .unzip();
        // A third cell names what is found to have led to the line.
        let (lines, codes): (Vec<&str>, Vec<&str>) = lines
            .into_iter()
            .map(|rest| rest.split_once('\t').unwrap_or((rest, "")))
            .unzip();
        let worked = check(sheet, &lines.join("\n"), &Options::default());
        let shown = carom::render::grade::steps_text(&worked);
        if shown.lines().any(|line| line.chars().count() >= 1_000) {
            let _ = writeln!(wrong, "{}: a line nobody reads to its end", file.display());
        }
        for row in finals {
            let (name, told) = row[7..].split_once('\t').expect("a name and a verdict");
            let last = worked.finals.iter().find(|(asked, _)| asked == name);
            let last = last.and_then(|(_, last)| last.as_ref());
            let word = last.map_or("missing", |last| last.verdict.word());
            if word != told {
                let place = file.display();
                let _ = writeln!(wrong, "{place} final {name} is {word}, not {told}");
            }
        }
        let found = worked.lines;
        assert_eq!(found.len(), lines.len(), "{}", file.display());
        for ((line, told), code) in found.iter().zip(told).zip(codes) {
            let is_told = |code: &str| line.diagnosis.iter().any(|d| d.code == code);
            let fits = match code.strip_prefix('!') {
                Some(absent) => !is_told(absent),
                None => code.is_empty() || is_told(code),
            };
            if !fits {
                let place = format!("{}:{}", file.display(), line.number);
                let _ = writeln!(
                    wrong,
                    "{place} {} lacks {code}: {:?}",
                    line.text, line.diagnosis
                );
            }
            let word = match &line.status {
                Status::Holds => "holds",
                Status::Defines => "defines",
                Status::Wrong => "WRONG",
                Status::Carried(_) => "carried",
                Status::Unreadable(_) => "unread",
                Status::Comment => "words",
                Status::Undecided => "open",
            };
            if word != told {
                let _ = writeln!(
                    wrong,
                    "{}:{} {} is {word}, not {told}",
                    file.display(),
                    line.number,
                    line.text
                );
            }
        }
        wrong
    };
    let of_scene: Vec<_> = of_scene.into_iter().collect();
    let wrong = of_scene.par_iter().map(|(path, solutions)| {
        let sheet = shared::key(&Path::new("derivations").join(path));
        let all = solutions.iter();
        all.map(|(file, rows)| misjudged(sheet, file, rows))
            .collect::<String>()
    });
    let wrong: String = wrong.collect();
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn a_line_of_a_batch_is_the_grade_as_data() {
    let rows = rows(|name| name != "scenes.tsv");
    for (_, line, cells) in &rows {
        let grade = judge(
            &cells[0],
            &cells[1],
            &Question::default(),
            &Options::default(),
        );
        let id = serde_json::json!({"line": line});
        let mut text = String::new();
        carom::render::grade::line(&mut text, &id, 1, &grade, &cells[1]);
        let mut read: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        let told = read
            .as_object_mut()
            .and_then(|fields| fields.shift_remove("id"));
        assert_eq!(told, Some(id));
        let mut data = carom::render::grade::json(&grade, &cells[1]);
        if let Some(error) = data.get_mut("error") {
            error["line"] = serde_json::json!(1);
        }
        assert_eq!(read, data);
    }
}

#[test]
fn a_slash_without_brackets_is_refused_where_authors_ask_for_brackets() {
    let strict = Options {
        strict_slash: true,
        ..Options::default()
    };
    let none = Question::default();
    for (expected, answer, verdict) in [
        ("3*v/(2*l)", "3v/(2l)", Verdict::Equivalent),
        ("3*v/(2*l)", "3v/2/l", Verdict::Equivalent),
        ("3*v/(2*l)", "3v/2l", Verdict::Invalid),
        ("m*v^2/2", "1/2mv^2", Verdict::Invalid),
        ("3v/2l", "3*v/(2*l)", Verdict::Invalid),
    ] {
        let grade = judge(expected, answer, &none, &strict);
        assert_eq!(grade.verdict, verdict, "{expected} | {answer}");
    }
    // Without that the author of an expected formula is told.
    let told = judge("3v/2l", "3*v/(2*l)", &none, &Options::default());
    let is_told = |grade: &Grade| grade.diagnosis.iter().any(|d| d.code == "EXPECTED_READING");
    assert!(is_told(&told), "{told:?}");
    // So he is of a root that could reach further.
    let root = judge("√2gh", "√2 g h", &none, &Options::default());
    assert!(is_told(&root), "{root:?}");
    // A quotient of quantities is read in one way.
    let quantity = judge("10 m / 2 s", "5 m/s", &none, &Options::default());
    assert!(!is_told(&quantity), "{quantity:?}");
}

/// A formula of answers comes out wrong where a belief makes the answers wrong.
#[test]
fn beliefs_are_tried_for_formulas_of_answers() {
    let text = fs::read_to_string(root().join("derivations/book/falling-stick.json"));
    let mut file: serde_json::Value =
        serde_json::from_str(&text.expect("a scene")).expect("a scene as JSON");
    file["questions"]["tip"] = serde_json::json!({"value": "omega*l"});
    let sheet = keys(scene::read(&file.to_string()).expect("a sound scene"));
    let entry = sheet.entry("tip").expect("a question of the scene");
    for (answer, verdict, first) in [
        ("3*v*cos(theta)/2", Verdict::Equivalent, None),
        ("12 v cosθ/13", Verdict::Different, Some("ARM_TO_END")),
        ("6 v cosθ/(1+3 cos²θ)", Verdict::Different, Some("SLIDES")),
        ("7 v cosθ/2", Verdict::Different, Some("FACTOR")),
    ] {
        let grade = sheet.judge(&entry, answer, &Options::default());
        let code = grade.diagnosis.first().map(|d| d.code);
        assert_eq!((grade.verdict, code), (verdict, first), "{answer}");
    }
}

#[test]
fn numbers_are_judged_where_the_answer_needs_no_other_values() {
    let text = fs::read_to_string(root().join("derivations/more/cars-lock-and-skid.json"));
    let mut file: serde_json::Value =
        serde_json::from_str(&text.expect("a scene")).expect("a scene as JSON");
    for (name, value) in [
        ("m", 1000.0),
        ("M", 1500.0),
        ("mu", 0.7),
        ("g", 9.81),
        ("d", 10.0),
    ] {
        file["parameters"][name]["value"] = value.into();
    }
    file["questions"]["h"] = serde_json::json!({"value": "v_first^2/(2*g)"});
    let sheet = keys(scene::read(&file.to_string()).expect("a sound scene"));
    for (quantity, answer, note) in [
        ("v_first", "29.3 m/s", "EQUIV_ROUNDED"),
        ("v_first", "11.7 m/s", "DIFF_BELIEF"),
        ("h", "43.75 m", "EQUIV_IDENTITY"),
        ("h", "43.8 m", "EQUIV_ROUNDED"),
        ("h", "45 m", "DIFF_TOLERANCE"),
        ("h", "43.75", "DIFF_UNIT_MISSING"),
        ("h", "43.75 kg", "DIFF_UNIT"),
        ("u", "11.7 m/s", "DIFF_KIND"),
    ] {
        let entry = sheet.entry(quantity).expect("a question of the scene");
        let grade = sheet.judge(&entry, answer, &Options::default());
        assert_eq!(grade.note, note, "{quantity}: {answer}");
    }
}

#[test]
fn a_number_without_a_unit_counts_in_that_of_the_scene() {
    let sheet = shared::key(Path::new("tests/printed/ballistic-pendulum-in-feet.json"));
    for (quantity, answer, words) in [
        (
            "V",
            "3.98",
            "the number is right, and its unit ft/s is missing",
        ),
        (
            "F",
            "61.9",
            "the number is right, and its unit lbf is missing",
        ),
        // In meters a second the number would be right, and no belief leads to it.
        (
            "V",
            "1.21",
            "the unit is missing, and the number is not the expected one",
        ),
    ] {
        let entry = sheet.entry(quantity).expect("a question of the scene");
        let grade = sheet.judge(&entry, answer, &Options::default());
        let told: Vec<&str> = grade.diagnosis.iter().map(|d| &*d.message).collect();
        assert_eq!(
            (grade.note, told),
            ("DIFF_UNIT_MISSING", vec![words]),
            "{answer}"
        );
    }
}

/// SplitMix64.
fn next(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Three-digit numbers of the size of the right one, and the right formula times a fraction of whole numbers up to 40.
#[test]
fn random_wrong_answers_are_seldom_explained() {
    let cases: u64 = std::env::var("CAROM_CASES")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(140);
    let numbers = [
        ("book/billiard-ball.json", "omega", "-", "rad/s", 10),
        ("book/ball-hits-bat.json", "v_D_x", "-", "m/s", 1),
        ("book/flying-dish.json", "P", "", "N s", 1),
        ("more/rolling-disk-meets-step.json", "omega", "", "rad/s", 1),
    ];
    let formulas = [
        ("book/falling-stick.json", "omega", "3 v cosθ/(2ℓ)"),
        ("book/pool-balls.json", "P", "m v (1+e) cosθ/2"),
        ("book/falling-stick.json", "E_lost", "m v²(4 - 3 cos²θ)/8"),
        ("book/billiard-ball.json", "omega", "-5 d v/(2 r²)"),
        (
            "more/rod-hits-smooth-floor.json",
            "P",
            "m v (1+e)/(1+3cos²θ)",
        ),
        ("more/ballistic-pendulum.json", "E_lost", "M m v²/(2(M+m))"),
        ("more/hammer-drives-a-pile.json", "eta", "M/(M+m)"),
        ("more/bowling-ball-begins-to-roll.json", "t", "2v/(7μ g)"),
    ];
    let open = |path: &str| shared::key(&Path::new("derivations").join(path));
    let sheets: Vec<_> = numbers
        .iter()
        .map(|(path, name, ..)| (open(path), *name))
        .chain(formulas.iter().map(|(path, name, _)| (open(path), *name)))
        .collect();
    let (mut state, mut explained, mut wrong) = (7, 0u64, 0u64);
    for round in 0..cases {
        let at = (round % sheets.len() as u64) as usize;
        let (sheet, name) = &sheets[at];
        let entry = sheet.entry(name).expect("a question of the scene");
        let answer = match numbers.get(at) {
            Some((_, _, sign, unit, size)) => {
                let digits = 100 + next(&mut state) % 900;
                format!("{sign}{}.{:02} {unit}", digits / 100, digits % 100)
                    .replace('.', if *size == 10 { "" } else { "." })
            }
            None => {
                let [p, q] = [1, 2].map(|_| next(&mut state) % 40 + 1);
                format!("({p}/{q})*({})", formulas[at - numbers.len()].2)
            }
        };
        let grade = sheet.judge(&entry, &answer, &Options::default());
        if grade.verdict != Verdict::Different {
            continue;
        }
        wrong += 1;
        let belief = |code: &str| {
            let known = carom::grade::belief::BELIEFS.iter().any(|b| b.code == code);
            known || matches!(code, "TWO_BELIEFS" | "OTHER_QUANTITY")
        };
        let found = grade.note == "DIFF_BELIEF" || grade.diagnosis.iter().any(|d| belief(d.code));
        explained += u64::from(found);
    }
    println!("{explained} of {wrong} random wrong answers were explained");
    assert!(
        wrong > cases / 2 && explained * 50 <= wrong,
        "{explained} of {wrong}"
    );
}

#[test]
fn an_unknown_name_is_no_fault_of_the_earlier_answers_beside_it() {
    let sheet = shared::key(Path::new("derivations/more/door-meets-its-stop.json"));
    let entry = sheet.entry("P_S").expect("a question of the scene");
    let grade = sheet.judge(&entry, "I (w + omega)/d", &Options::default());
    let told = format!("{:?}", grade.error.expect("a fault"));
    assert!(told.contains("`I` is not declared"), "{told}");
    assert!(!told.contains("`omega` is not declared"), "{told}");
}
