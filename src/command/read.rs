//! How a formula is understood: in plain notation, in LaTeX, its symbols and dimension, and what else it could mean.

use std::collections::HashMap;

use serde_json::json;

use super::{Format, Output};
use crate::dimension;
use crate::formula as reader;
use crate::grade::sheet::Sheet;
use crate::grade::{self, Question};
use crate::render::{self, json::versioned};

/// How a formula is understood, with the symbols of a sheet where there is one. An unreadable formula is a refusal as text,
/// and status 2 with its fault as JSON.
pub fn read(formula: &str, sheet: Option<&Sheet>, format: Format) -> Result<Output, String> {
    let (symbols, question) = match sheet {
        Some(sheet) => {
            let question = sheet.question();
            let mut symbols = reader::Symbols::strict();
            for g in &question.symbols {
                symbols.declare_as(g.name.clone(), g.latex.as_deref(), g.dimension.clone());
            }
            for q in sheet.answered() {
                symbols.declare_as(q.name.as_str(), q.latex.as_deref(), None);
            }
            (symbols, question)
        }
        None => (reader::Symbols::open(), Question::default()),
    };
    let reading = match reader::read(formula, &symbols) {
        Ok(reading) => reading,
        Err(fault) => {
            if format == Format::Json {
                let text = versioned(&json!({"error": render::grade::error(&fault, formula)}));
                return Ok(Output { text, status: 2 });
            }
            return Err(fault.show(formula));
        }
    };
    let plain = grade::show(&reading.content);
    let names: HashMap<&str, &str> = question
        .symbols
        .iter()
        .filter_map(|g| Some((&*g.name, g.latex.as_deref()?)))
        .collect();
    let named = |name: &str| names.get(name).map(|l| (*l).to_string());
    let latex = render::content::latex(&reading.content, &|e| reader::write_latex(e, &named));
    let known = |name: &str| {
        question
            .symbols
            .iter()
            .find(|g| *g.name == *name)?
            .dimension
            .clone()
    };
    let dimension = reading
        .content
        .answer()
        .expr()
        .and_then(|e| match dimension::of(e, &known) {
            Ok(found) => found.map(|d| format!("{} ({d})", d.si())),
            Err(clash) if matches!(*clash, dimension::Clash::Unknown(_)) => None,
            Err(clash) => Some(format!("none: {}", clash.message(&reader::write_plain))),
        });
    let notes: Vec<String> = reading.notes.iter().map(|n| n.message(formula)).collect();
    let others: Vec<String> = match reading.choices {
        0 => Vec::new(),
        _ => reader::other_readings(formula, &symbols, true)
            .iter()
            .map(|r| grade::show(&r.content))
            .collect(),
    };
    let names: Vec<String> = reading.symbols().iter().map(|s| s.to_string()).collect();
    if format == Format::Json {
        let text = versioned(&json!({
            "plain": plain, "latex": latex, "symbols": names, "dimension": dimension, "notes": notes, "other_readings": others,
        }));
        return Ok(Output { text, status: 0 });
    }
    let mut out = format!(
        "plain     {plain}\nLaTeX     {latex}\nsymbols   {}\n",
        names.join(", ")
    );
    if let Some(d) = dimension {
        out.push_str(&format!("dimension {d}\n"));
    }
    for note in notes {
        out.push_str(&format!("note      {note}\n"));
    }
    for other in others {
        out.push_str(&format!("or        {other}\n"));
    }
    Ok(Output {
        text: out,
        status: 0,
    })
}
