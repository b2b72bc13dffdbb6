//! A quiz for STACK, as Moodle XML: each question takes a formula, and its number at exact values; two potential-response
//! trees hold a branch for the right answer and one for every belief.

use std::fmt::Write;

use super::names::Names;
use super::variant::Variant;
use super::{Exercise, Item, quiet, words, xml};
use crate::expr::Symbol;
use crate::figure::escape;

/// Names that mean something in STACK: constants, and functions of Maxima that hold no other value.
const TAKEN: &[&str] = &[
    "e", "i", "j", "pi", "inf", "minf", "ind", "und", "infinity", "true", "false", "if", "then",
    "else", "do", "for", "from", "in", "next", "step", "thru", "unless", "while", "and", "or",
    "not", "simp", "ev", "at", "diff", "lambda", "beta", "gamma", "psi", "vals", "ta1", "tn",
    "ans1", "ans2",
];

/// Functions and constants by their names in Maxima.
const WORDS: &[(&str, &str)] = &[("ln", "log"), ("pi", "%pi")];

/// How far a number may be off.
const TOLERANCE: &str = "0.01";

/// How a question is typeset.
const SETTINGS: &str = "decimals=. scientificnotation=*10 multiplicationsign=dot sqrtsign=1 complexno=i inversetrig=arccos \
     logicsymbol=lang matrixparens=[ variantsselectionseed=";

/// The quiz.
pub fn stack(exercise: &Exercise) -> String {
    let all = exercise.symbols.iter().map(|g| &g.name);
    let most = exercise.items.iter().map(|i| i.wrong.len()).max();
    let own = (1..=most.unwrap_or(0)).flat_map(own);
    let taken = TAKEN.iter().map(|name| name.to_string()).chain(own);
    let names = Names::new(all, taken, str::to_string, WORDS);
    let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<quiz>\n");
    for item in &exercise.items {
        question(&mut out, exercise, item, &names);
    }
    out.push_str("</quiz>\n");
    out
}

/// The variables of a wrong answer: the formula, and its number. Students may have symbols of short names for themselves.
fn own(k: usize) -> [String; 2] {
    [format!("belief{k}"), format!("beliefn{k}")]
}

/// A field with a text inside.
fn text(out: &mut String, field: &str, content: &str) {
    let content = xml(content);
    out.push_str(&format!(
        "<{field} format=\"html\"><text>{content}</text></{field}>\n"
    ));
}

/// An element whose text is no HTML.
fn field(out: &mut String, field: &str, content: &str) {
    let _ = writeln!(out, "<{field}>{}</{field}>", xml(content));
}

/// Several of them, written `name=text` with blanks between.
fn fields(out: &mut String, all: &str) {
    for (name, content) in all.split_whitespace().filter_map(|f| f.split_once('=')) {
        field(out, name, content);
    }
}

fn question(out: &mut String, exercise: &Exercise, item: &Item, names: &Names) {
    let with_numbers = !item.variants.is_empty();
    let spelled = |s: &Symbol| names.name(s);
    let name = xml(&format!("{} · {}", exercise.title, item.name));
    out.push_str(&format!(
        "<question type=\"stack\">\n<name><text>{name}</text></name>\n"
    ));
    let mut asked = exercise.told(quiet, &spelled);
    let _ = write!(
        asked,
        "<p>As a formula, with * between factors: {}{}, \\({}\\) = [[input:ans1]] [[validation:ans1]]</p>",
        words(&item.words),
        item.given(quiet),
        escape(&item.latex)
    );
    if with_numbers {
        let _ = write!(
            asked,
            "<p>And where {{@vals@}}, all in SI units: [[input:ans2]] {} [[validation:ans2]]</p>",
            escape(&item.unit)
        );
    }
    text(out, "questiontext", &asked);
    text(out, "generalfeedback", &quiet(&exercise.shown.solution));
    fields(out, "defaultgrade=1 penalty=0.1 hidden=0 idnumber=");
    let _ = writeln!(
        out,
        "<stackversion><text></text></stackversion>\n<questionvariables><text>{}</text></questionvariables>",
        xml(&variables(item, names))
    );
    let (feedback, note) = match with_numbers {
        true => (
            "<p>[[feedback:prt1]]</p><p>[[feedback:prt2]]</p>",
            "{@vals@}",
        ),
        false => ("<p>[[feedback:prt1]]</p>", ""),
    };
    text(out, "specificfeedback", feedback);
    text(out, "questionnote", note);
    text(out, "questiondescription", "");
    let assumed = match exercise.symbols.iter().all(|g| g.is_positive) {
        true => "questionsimplify=1 assumepositive=1 assumereal=0",
        false => "questionsimplify=1 assumepositive=0 assumereal=1",
    };
    fields(out, assumed);
    text(out, "prtcorrect", "<p>Right.</p>");
    text(out, "prtpartiallycorrect", "<p>Right in part.</p>");
    text(out, "prtincorrect", "<p>Not right.</p>");
    fields(out, SETTINGS);
    let own = "name=ans1 type=algebraic tans=ta1 boxsize=30";
    input(out, own, "1", &unusual(exercise, names));
    if with_numbers {
        let own = "name=ans2 type=numerical tans=float(tn) boxsize=12";
        input(out, own, "0", "");
    }
    tree(out, item, &FORMULA);
    if with_numbers {
        tree(out, item, &NUMBER);
        for seed in 1..=item.variants.len() {
            field(out, "deployedseed", &seed.to_string());
        }
    }
    tests(out, item, with_numbers);
    out.push_str("</question>\n");
}

/// The right answer, the wrong ones, and the values of the variant with the numbers there.
fn variables(item: &Item, names: &Names) -> String {
    let mut out = String::new();
    let list = |v: &Variant| {
        let each = v.values.iter();
        let each = each.map(|(s, value)| format!("{}={}", names.name(s), value.written("acos")));
        format!("[{}]", each.collect::<Vec<_>>().join(","))
    };
    if !item.variants.is_empty() {
        let variants: Vec<String> = item.variants.iter().map(list).collect();
        let _ = writeln!(out, "vals: rand([{}]);", variants.join(",\n "));
    }
    let answers = item.wrong.iter().map(|w| &w.answer);
    for (k, answer) in std::iter::once(&item.answer).chain(answers).enumerate() {
        let [own, number] = match k {
            0 => ["ta1", "tn"].map(String::from),
            k => self::own(k),
        };
        let _ = writeln!(out, "{own}: {};", names.written(answer));
        if !item.variants.is_empty() {
            let _ = writeln!(out, "{number}: ratsimp(trigexpand(subst(vals, {own})));");
        }
    }
    out
}

/// Names that STACK takes from students only where it is told to: those of more than two characters.
fn unusual(exercise: &Exercise, names: &Names) -> String {
    let all = exercise.symbols.iter().map(|g| names.name(&g.name));
    all.filter(|n| n.len() > 2).collect::<Vec<_>>().join(",")
}

fn input(out: &mut String, own: &str, check_type: &str, allowed: &str) {
    out.push_str("<input>\n");
    fields(out, own);
    fields(
        out,
        "strictsyntax=1 insertstars=0 syntaxhint= syntaxattribute=0 forbidwords=",
    );
    field(out, "allowwords", allowed);
    fields(out, "forbidfloat=0 requirelowestterms=0");
    field(out, "checkanswertype", check_type);
    fields(out, "mustverify=1 showvalidation=1 options=");
    out.push_str("</input>\n");
}

/// A potential-response tree: its input, the variables it compares with, and how.
struct Tree {
    name: &'static str,
    input: &'static str,
    right: &'static str,
    test: &'static str,
    options: &'static str,
}

/// The formula is held against the right one and the wrong ones.
const FORMULA: Tree = Tree {
    name: "prt1",
    input: "ans1",
    right: "ta1",
    test: "AlgEquiv",
    options: "",
};

/// The number is, up to a tolerance.
const NUMBER: Tree = Tree {
    name: "prt2",
    input: "ans2",
    right: "float(tn)",
    test: "NumRelative",
    options: TOLERANCE,
};

impl Tree {
    /// What a branch compares with.
    fn against(&self, k: usize) -> String {
        match (k, self.test) {
            (0, _) => self.right.to_string(),
            (k, "NumRelative") => format!("float({})", own(k)[1]),
            (k, _) => own(k)[0].clone(),
        }
    }

    /// The note of a branch.
    fn note(&self, item: &Item, k: usize) -> String {
        match k {
            0 => format!("{}-RIGHT", self.name),
            k => format!("{}-{}-{k}", self.name, item.wrong[k - 1].code),
        }
    }
}

/// The tree: the right answer, then each belief; every branch that holds ends it.
fn tree(out: &mut String, item: &Item, tree: &Tree) {
    out.push_str("<prt>\n");
    field(out, "name", tree.name);
    fields(out, "value=1 autosimplify=1 feedbackstyle=1");
    out.push_str("<feedbackvariables><text></text></feedbackvariables>\n");
    for k in 0..=item.wrong.len() {
        let wrong = k.checked_sub(1).map(|k| &item.wrong[k]);
        let next = match k < item.wrong.len() {
            true => format!("falsenextnode={}", k + 1),
            false => String::from("falsenextnode=-1"),
        };
        let belief = wrong.map_or("the right answer", |w| &w.belief).chars();
        let belief: String = belief.take(250).collect();
        let score = if k == 0 { "1" } else { "0" };
        out.push_str("<node>\n");
        field(out, "name", &k.to_string());
        field(out, "description", &belief);
        field(out, "answertest", tree.test);
        field(out, "sans", tree.input);
        field(out, "tans", &tree.against(k));
        field(out, "testoptions", tree.options);
        fields(out, "quiet=1 truescoremode==");
        field(out, "truescore", score);
        fields(out, "truepenalty= truenextnode=-1");
        field(out, "trueanswernote", &tree.note(item, k));
        let hint = wrong.map_or(String::new(), |w| format!("<p>{}</p>", words(&w.hint)));
        text(out, "truefeedback", &hint);
        let other = format!("{}-OTHER-{k}", tree.name);
        fields(out, "falsescoremode== falsescore=0 falsepenalty=");
        fields(out, &next);
        field(out, "falseanswernote", &other);
        text(out, "falsefeedback", "");
        out.push_str("</node>\n");
    }
    out.push_str("</prt>\n");
}

/// STACK's own tests of the question: the right answer, and each belief's.
fn tests(out: &mut String, item: &Item, with_numbers: bool) {
    for k in 0..=item.wrong.len() {
        let (score, penalty, what) = match k {
            0 => ("1", "0", "the right answer"),
            k => ("0", "0.1", item.wrong[k - 1].code),
        };
        let mut trees = vec![&FORMULA];
        // Two numbers may be near each other at some values: then the branch before is as good.
        let is_told = k == 0 || item.variants.iter().all(|v| v.wrong[k - 1].is_some());
        if with_numbers && is_told {
            trees.push(&NUMBER);
        }
        out.push_str("<qtest>\n");
        field(out, "testcase", &(k + 1).to_string());
        field(out, "description", what);
        for tree in &trees {
            let (name, value) = (tree.input, tree.against(k));
            let line =
                format!("<testinput><name>{name}</name><value>{value}</value></testinput>\n");
            out.push_str(&line);
        }
        for tree in &trees {
            out.push_str("<expected>\n");
            field(out, "name", tree.name);
            field(out, "expectedscore", score);
            field(out, "expectedpenalty", penalty);
            field(out, "expectedanswernote", &tree.note(item, k));
            out.push_str("</expected>\n");
        }
        out.push_str("</qtest>\n");
    }
}
