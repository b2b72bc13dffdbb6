//! Writes GRADING.md from the tables of cases: how formulas are read, what verdicts and notes mean, which beliefs are known.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use carom::grade::belief::BELIEFS;
use carom::grade::{Options, judge};

/// Rows shown of each table.
const SHOWN: usize = 10;

/// Tables in the order of the manual, with what they are about.
const TABLES: [(&str, &str, &str); 16] = [
    (
        "typing.tsv",
        "Formulas as people type them",
        "Plain text, Unicode and LaTeX are read by one reader, alone or mixed. What is declared decides where a name ends.",
    ),
    (
        "notation.tsv",
        "Numbers, fractions, roots and functions",
        "Numbers are exact: 0.1 is one tenth, and a rounded number is not the exact one. A root of odd degree of a negative number is the real one, `log` is the natural logarithm, and `log_10` says its base.",
    ),
    (
        "signs.tsv",
        "Letters and signs of Unicode, and vectors",
        "A vector is written with brackets, as a column, or with unit vectors; a matrix row by row. Matrices are added, multiplied with one another and with vectors, and `det` or bars give a determinant.",
    ),
    (
        "names.tsv",
        "What is no product",
        "A Δ or d before a name makes another name of it, `dx/dt` is \\dot x, and names with arrows follow the algebra of vectors. × between symbols that are declared is a product of numbers; between others without arrows it is taken for one in an answer, which is told, and refused in an expected formula.",
    ),
    (
        "sentences.tsv",
        "Words, boxes and precedence",
        "A product without signs and spaces stands below a slash; behind a fraction of two numbers, or behind a space, it does not. Words beside a formula in dollars are passed over where they say that it is the answer; others could change it, and it is not read. In a chain every side has to be right, and a number without a unit has that of the last side. Beside a number words may say when it holds, `v = 3 m/s at t = 2 s`, `if e = 1 then v = 3 m/s`; a formula with a condition is not read. An answer that is right only in the other reading, taken for the whole formula, is right and told so; `--slash strict` wants brackets. Behind a function without brackets stand numbers and one angle, or a product of names; behind an inverse one also their quotient, `arcsin v/c`, `arctan 1/√3`, and behind any one a quotient of numbers, `sin π/6`, where an answer that is right only as `(sin π)/6` would be is undecided. How far the root of `√ab` reaches no habit decides: where the two readings part, the verdict is undecided.",
    ),
    (
        "graders.tsv",
        "What other graders are tested with",
        "Pairs of the kind that suites of other graders hold. An `e` that nobody declared is a symbol; where the verdict hangs on it, it is undecided.",
    ),
    (
        "hostile.tsv",
        "What is refused",
        "The whole text is read or it is invalid, with the place of the fault. Nothing is expanded.",
    ),
    (
        "answers.tsv",
        "Answers of collisions",
        "The same formula written otherwise, and the usual near misses.",
    ),
    (
        "mechanics.tsv",
        "More of mechanics",
        "`e`, `d`, `I`, `m` and `g` are what the question declares, never a constant or a unit.",
    ),
    (
        "algebra.tsv",
        "Algebra and trigonometry",
        "Equality is an identity in a normal form; a difference is shown at the simplest exact point.",
    ),
    (
        "domains.tsv",
        "Domains",
        "Undeclared symbols are positive, undeclared angles lie in the first quadrant; the grade lists what it assumed.",
    ),
    (
        "arcs.tsv",
        "Arcs",
        "Sums of arcs are compared by their sine and cosine and by the range they can have.",
    ),
    (
        "units.tsv",
        "Units",
        "Missing, wrong and compatible units are three different remarks. Values by names of the answer's own, `v_1 = 2 m/s`, have units as well, and so have solutions of equations. Units run together before a negative exponent, `50 Nm^{-1}`, are a product where that alone is right.",
    ),
    (
        "quantities.tsv",
        "Numbers with units",
        "A unit stands behind a number; in `1 m 20 cm` a smaller one goes on, and in brackets, `5 m/s (18 km/h)`, the same is said again. Degrees and percent are of all of a fraction of numbers, `45/2°`. Behind a formula in symbols it has to fit the symbols, and says nothing new.",
    ),
    (
        "relations.tsv",
        "Equations, inequalities, pairs",
        "Equations are the same where they have the same solutions on the domain. A factor that only one of them has leaves them the same, given that it is not zero, where it holds nothing of what is sought: of what is asked for, else of what both hold. Any other factor that may be zero loses or gains a root, and so does one whose symbols are all declared and have either sign. In one symbol a number counts at which only one side has a value.",
    ),
    (
        "several.tsv",
        "Several values, results and bounds",
        "Values stand in any order and each has to be given; results are compared by their names. `[0, 1)` is an interval; `(0, 1)` is one where the other side sets bounds, else a vector. A comma that could part thousands or decimals is read as what is right.",
    ),
];

/// One row of a table: expected, answer, verdict, reason, symbols.
pub type Row = (String, usize, Vec<String>);

/// The whole page.
pub fn page(
    rows: &[Row],
    steps: &str,
    question: &dyn Fn(&str) -> carom::grade::Question,
) -> String {
    let mut out = String::from(
        "# How carom grades\n\n\
         <!-- Written by `UPDATE=1 cargo test --test all grading::` from the tables in tests/grading; do not edit. -->\n\n\
         `carom grade --expected F --answer G` compares two formulas, `carom grade SCENE --quantity Q --answer G` an answer with the\n\
         derivation of a scene, `carom grade --batch` many of them as JSON lines. Every row below is a test.\n\n\
         ## Verdicts\n\n\
         | verdict | reward | meaning |\n| --- | --- | --- |\n\
         | equivalent | 1 | the same value on the whole domain, proved |\n\
         | different | 0 | not the same; with a point of the domain at which the two part |\n\
         | invalid | null | no readable answer, or one without any value |\n\
         | undecided | null | not known, with the reason; never to be counted as wrong |\n\n\
         ## Tables of cases\n",
    );
    let mut notes: BTreeMap<&'static str, (usize, String)> = BTreeMap::new();
    let mut shown: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for (file, _, cells) in rows {
        *counts.entry(file).or_default() += 1;
        let symbols = question(cells.get(4).map_or("", String::as_str));
        let grade = judge(&cells[0], &cells[1], &symbols, &Options::default());
        let example = format!("{} for {}", code(&cells[1]), code(&cells[0]));
        notes.entry(grade.note).or_insert_with(|| (0, example)).0 += 1;
        let domain = match cells.get(4).map_or("", String::as_str) {
            "" => String::new(),
            declared => format!(" ({})", code(declared)),
        };
        shown.entry(file).or_default().push(format!(
            "| {} | {} | {} | {}{domain} | {} |",
            code(&cells[0]),
            code(&cells[1]),
            cells[2],
            cells[3],
            grade.note,
        ));
    }
    for (file, title, words) in TABLES {
        let Some(lines) = shown.get(file) else {
            continue;
        };
        let _ = write!(out, "\n### {title}\n\n{words}\n\n");
        out.push_str(
            "| expected | answer | verdict | why | note |\n| --- | --- | --- | --- | --- |\n",
        );
        let step = lines.len().div_ceil(SHOWN).max(1);
        for line in lines.iter().step_by(step) {
            out.push_str(line);
            out.push('\n');
        }
        let _ = write!(
            out,
            "\n{} of {} rows of `tests/grading/{file}`.\n",
            lines.iter().step_by(step).count(),
            lines.len()
        );
    }
    out.push_str("\n## Notes\n\nA note is a stable code that depends on neither points nor texts.\n\n| note | rows | for instance |\n| --- | --- | --- |\n");
    for (note, (count, example)) in &notes {
        let _ = writeln!(out, "| {note} | {count} | {example} |");
    }
    out.push_str(
        "\n## Beliefs\n\nA wrong answer to a scene is held against what comes out when a law or the geometry is believed to be otherwise. A belief is\n\
         named only where it gives exactly that answer, and where more than a handful do, none is. `tests/grading/scenes.tsv` has the cases.\n\n\
         | code | what is believed | what the student is asked |\n| --- | --- | --- |\n",
    );
    for belief in BELIEFS {
        let _ = writeln!(
            out,
            "| {} | {} | {} |",
            belief.code, belief.belief, belief.hint
        );
    }
    out.push_str("\n## Worked solutions\n\n`carom grade SCENE --steps FILE` judges a solution line by line: a line holds, gives a name, is wrong, or follows from an\nearlier wrong line, alone or together with the lines above it. A wrong answer is explained as above; a law written with a slip\nby the belief under which it holds, or by the term whose sign is turned.\nOf a chain `a = b = c` the first link that does not hold is named; a name may be said before or after it is used, and one\ndefined with a slip carries it; numbers may be rounded.\nWords around the equations, remarks in brackets behind them and senses of rotation are read; what `For θ = 0: …` says is judged\nthere alone.\n`\\vec{v}_B^{+}`, `\\vec{\\omega}`, `\\vec{r}_{B/C}`, `\\vec{P}_C`, `\\vec{n}` and `\\vec{H}_C^{-}` are the vectors of the scene, of its bodies and points\nby their names, G being the center of mass of the one body that moves. Without a mark a vector is of the moment just before\nwhere its letter stands beside it with the mark of the moment after, as in `\\vec{v}' = -e\\vec{v}`; else of the moment just\nafter or, with a remark, just before. At the end stands, for each quantity asked for, whether the last line\nthat gives it is right. `tests/grading/steps` has the cases.\n\n```text\n");
    out.push_str(steps);
    out.push_str(
        "```\n\n## Batches\n\n`carom grade --batch` reads one JSON object a line and writes one, in order, whatever comes in, for\na blank line too. An `error` tells the number of its line.\n\n\
         | field in | meaning |\n| --- | --- |\n\
         | `id` | anything; given back as it came |\n\
         | `expected`, `answer` | the two formulas |\n\
         | `scene`, `quantity` | a scene below the working folder, and which of its questions; `expected` may then stand for the scene's own answer |\n\
         | `symbols` | name: `{\"domain\": \"positive\" or \"nonnegative\" or \"real\" or {\"min\", \"max\"}, \"dimension\": unit, \"latex\"}` |\n\
         | `tolerance` | `\"2%\"`, `{\"relative\"}`, `{\"absolute\"}` or `{\"significant\"}` |\n\
         | `form` | `simplified`, `factored`, `unit`, `digits=3`, `only=m,v`, or a list of them |\n\n\
         | field out | meaning |\n| --- | --- |\n\
         | `id`, `verdict`, `reward`, `note` | as above |\n\
         | `proof` | `kind` and `words`; `error_bound` where it is probabilistic |\n\
         | `assumed`, `counterexample`, `error`, `diagnosis` | where there are such |\n\
         | `read_as`, `symbols` | how the answer was read, and the names in it |\n",
    );
    out
}

/// A text as code in a cell of a table; what cannot be seen is named.
fn code(text: &str) -> String {
    if text.trim().is_empty() {
        return "(blank)".into();
    }
    let text = &text.replace('\n', "↵");
    let mut shown = String::new();
    for c in text.chars() {
        match c {
            '|' => shown.push_str("\\|"),
            c if c.is_control()
                || matches!(c, '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{ad}' | '\u{feff}') =>
            {
                let _ = write!(shown, "\\u{{{:x}}}", u32::from(c));
            }
            c => shown.push(c),
        }
    }
    let fence = if shown.contains('`') { "``" } else { "`" };
    let gap = if shown.contains('`') { " " } else { "" };
    format!("{fence}{gap}{shown}{gap}{fence}")
}
