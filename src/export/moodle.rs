//! Plain Moodle questions, for sites without STACK: a numerical question for each variant, where the number of every belief
//! has its hint.

use std::fmt::Write;

use super::variant::Variant;
use super::{Exercise, Item, Wrong, quiet, words, xml};
use crate::figure::escape;

/// How far a number may be off, as a share of it.
const TOLERANCE: f64 = 0.01;

/// The questions as Moodle XML.
pub fn moodle(exercise: &Exercise) -> Result<String, String> {
    if exercise.items.iter().all(|item| item.variants.is_empty()) {
        return Err(String::from(
            "no exact values fit: an angle stands under a sine and outside of one, or the answers rest on what holds too rarely\nhint: --to stack and --to numbas ask for the formula",
        ));
    }
    let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<quiz>\n");
    for item in &exercise.items {
        for (number, variant) in (1..).zip(&item.variants) {
            question(&mut out, exercise, item, variant, number);
        }
    }
    out.push_str("</quiz>\n");
    Ok(out)
}

/// A text or HTML as the text of a field.
fn text(content: &str) -> String {
    format!("<text>{}</text>", xml(content))
}

fn question(out: &mut String, exercise: &Exercise, item: &Item, variant: &Variant, number: u32) {
    let name = format!("{} · {} · {number}", exercise.title, item.name);
    let unit = match item.unit.as_str() {
        "" => String::new(),
        unit => format!(", in {unit}"),
    };
    let asked = format!(
        "{}<p>In SI units {}. What is \\({}\\), {}{}?</p>",
        exercise.told(quiet, &|s| s.to_string()),
        exercise.valued(variant, |_, v| escape(&v.latex())),
        escape(&item.latex),
        words(&item.words),
        words(&unit)
    );
    let _ = writeln!(
        out,
        "<question type=\"numerical\">\n<name>{}</name>\n<questiontext format=\"html\">{}</questiontext>\n\
         <generalfeedback format=\"html\">{}</generalfeedback>\n\
         <defaultgrade>1</defaultgrade>\n<penalty>0.1</penalty>\n<hidden>0</hidden>",
        text(&name),
        text(&asked),
        text(&quiet(&exercise.shown.solution))
    );
    answer(out, variant.right, 100, None);
    for (wrong, value) in item.wrong.iter().zip(&variant.wrong) {
        value.inspect(|value| answer(out, *value, 0, Some(wrong)));
    }
    let end = "<unitgradingtype>0</unitgradingtype>\n<unitpenalty>0.1</unitpenalty>\n<showunits>3</showunits>\n<unitsleft>0</unitsleft>\n</question>\n";
    out.push_str(end);
}

fn answer(out: &mut String, value: f64, fraction: u32, wrong: Option<&Wrong>) {
    let hint = wrong.map_or(String::new(), |w| format!("<p>{}</p>", words(&w.hint)));
    let _ = writeln!(
        out,
        "<answer fraction=\"{fraction}\" format=\"plain_text\"><text>{value}</text>\
         <feedback format=\"html\">{}</feedback><tolerance>{}</tolerance></answer>",
        text(&hint),
        TOLERANCE * value.abs()
    );
}
