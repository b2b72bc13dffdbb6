//! A Numbas exam: each question takes a formula, where every belief's answer is an alternative with its hint, and its number
//! at exact values picked at random.

use serde_json::{Map, Value, json};

use super::names::Names;
use super::variant::Exact;
use super::{Exercise, Item, quiet};
use crate::expr::Symbol;
use crate::figure::escape;
use crate::render::pretty;

/// Names that mean something in Numbas, `e` and `i` aside, which each question takes for its own.
const TAKEN: &[&str] = &[
    "pi", "π", "infinity", "nan", "true", "false", "and", "or", "not", "xor", "in", "isa", "pick",
    "number",
];

/// Functions by their names in Numbas.
const WORDS: &[(&str, &str)] = &[("asin", "arcsin"), ("acos", "arccos"), ("atan", "arctan")];

/// How far a number may be off, as a share of it.
const TOLERANCE: f64 = 0.01;

/// The exam, as the editor of Numbas takes it in.
pub fn numbas(exercise: &Exercise) -> String {
    let questions = exercise.items.iter().map(|i| question(exercise, i));
    let questions: Vec<Value> = questions.collect();
    let exam = json!({
        "name": exercise.title,
        "metadata": {"description": exercise.statement, "licence": "None specified"},
        "duration": 0,
        "percentPass": 0,
        "showQuestionGroupNames": false,
        "navigation": {"allowregen": true, "reverse": true, "browse": true, "showfrontpage": true},
        "feedback": {"showactualmark": true, "showtotalmark": true, "showanswerstate": true, "allowrevealanswer": true},
        "question_groups": [{
            "name": exercise.title,
            "pickingStrategy": "all-ordered",
            "pickQuestions": questions.len(),
            "questions": questions,
        }],
    });
    let exam = pretty(&exam);
    format!("// Numbas version: exam_results_page_options\n{exam}\n")
}

/// HTML in which nothing is a variable or a formula of Numbas. Braces are escaped there by a backslash; dollars and
/// backslashes have no escape and stand as their wide forms.
fn plain(html: &str) -> String {
    let wide = quiet(html).replace('\\', "\u{ff3c}");
    let wide = wide.replace('$', "\u{ff04}");
    wide.replace('{', "\\{").replace('}', "\\}")
}

fn question(exercise: &Exercise, item: &Item) -> Value {
    let all = exercise.symbols.iter().map(|g| &g.name);
    let taken = TAKEN.iter().map(|name| name.to_string());
    // Names differ there in more than capitals.
    let names = Names::new(all, taken, str::to_lowercase, WORDS);
    let mut parts = vec![formula(item, &names)];
    let mut variables = Map::new();
    // The symbols themselves stay free in formulas.
    let held = names.behind("val_");
    if !item.variants.is_empty() {
        let last = item.variants.len() - 1;
        let mut define = |name: &str, definition: String| {
            let value = json!({
                "name": name, "group": "Ungrouped variables", "definition": definition,
                "description": "", "templateType": "anything", "can_override": false,
            });
            variables.insert(name.to_string(), value);
        };
        define("pick", format!("random(0..{last})"));
        for (i, (symbol, _)) in item.variants[0].values.iter().enumerate() {
            let values = item.variants.iter();
            let values = values.map(|v| v.values[i].1.written("arccos"));
            let values = values.collect::<Vec<_>>().join(", ");
            define(&held.name(symbol), format!("[{values}][pick]"));
        }
        define("number", held.written(&item.answer));
        parts.push(number(exercise, item, &held));
    }
    json!({
        "name": format!("{}: {}", exercise.title, item.words),
        "tags": [],
        "metadata": {"description": item.words, "licence": "None specified"},
        "statement": exercise.told(plain, &|s| names.name(s)),
        "advice": plain(&exercise.shown.solution),
        "rulesets": {},
        "builtin_constants": {"e": false, "pi,\u{3c0}": true, "i": false},
        "constants": [],
        "ungrouped_variables": variables.keys().cloned().collect::<Vec<_>>(),
        "variables": variables,
        "variablesTest": {"condition": "", "maxRuns": 100},
        "variable_groups": [],
        "functions": {},
        "preamble": {"js": "", "css": ""},
        "parts": parts,
        "partsMode": "all",
    })
}

/// What parts have in common.
fn part(kind: &str, marks: u32, own: Value) -> Value {
    let mut part = json!({
        "type": kind, "marks": marks, "showCorrectAnswer": true, "showFeedbackIcon": true,
        "scripts": {}, "customMarkingAlgorithm": "", "extendBaseMarkingAlgorithm": true,
        "variableReplacements": [], "variableReplacementStrategy": "originalfirst",
        "adaptiveMarkingPenalty": 0, "unitTests": [],
    });
    if let (Value::Object(all), Value::Object(own)) = (&mut part, own) {
        all.extend(own);
    }
    part
}

/// The formula, with an alternative for every belief.
fn formula(item: &Item, names: &Names) -> Value {
    let compared = |answer| {
        json!({
            "answer": names.written(answer), "showPreview": true, "checkingType": "reldiff",
            "checkingAccuracy": 1e-6, "failureRate": 1, "vsetRangePoints": 5, "vsetRange": [0.1, 1.4],
            "checkVariableNames": false, "singleLetterVariables": false, "allowUnknownFunctions": false,
            "implicitFunctionComposition": false, "valuegenerators": [],
        })
    };
    let alternatives = item.wrong.iter().map(|w| {
        let mut own = compared(&w.answer);
        own["useAlternativeFeedback"] = json!(true);
        own["alternativeFeedbackMessage"] = json!(format!("<p>{}</p>", plain(&escape(&w.hint))));
        own["customName"] = json!(w.code);
        own["useCustomName"] = json!(true);
        part("jme", 0, own)
    });
    let mut own = compared(&item.answer);
    own["alternatives"] = alternatives.collect();
    own["prompt"] = json!(format!(
        "<p>As a formula: {}{}, \\({}\\) =</p>",
        plain(&escape(&item.words)),
        item.given(plain),
        escape(&item.latex)
    ));
    part("jme", 1, own)
}

/// The number at the values that were picked.
fn number(exercise: &Exercise, item: &Item, names: &Names) -> Value {
    let picked = |s: &Symbol, _: &Exact| format!("\\var{{{}}}", names.name(s));
    let values = exercise.valued(&item.variants[0], picked);
    let unit = if item.unit.is_empty() {
        "one"
    } else {
        &item.unit
    };
    let own = json!({
        "prompt": format!("<p>In SI units {values}. Its value, in {unit}:</p>"),
        "minValue": format!("number - {TOLERANCE}*abs(number)"),
        "maxValue": format!("number + {TOLERANCE}*abs(number)"),
        "correctAnswerFraction": false,
        "allowFractions": true,
        "notationStyles": ["plain", "en", "si-en"],
        "correctAnswerStyle": "plain",
    });
    part("numberentry", 1, own)
}
