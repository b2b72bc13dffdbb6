//! Curves to be drawn, as the file asks for them.

use super::fault::Fault;
use super::question_file::PlotFile;
use super::questions::answers::{formula, parameter, parameter_names, with};
use super::questions::names_of;
use super::record::Text;
use super::resolve::{Resolver, entries};
use super::{PlotAsk, Question, Scene};
use crate::expr::Symbol;

/// Most curves of a plot.
const CURVES: usize = 6;

/// Reads the curves that are asked for; `names` are those of the answers.
pub(super) fn plots(base: &mut Resolver<'_>, scene: &mut Scene) {
    let mut names: Vec<String> = Vec::new();
    for q in scene.asked_of_impact() {
        names.extend(names_of(&q.name, &q.ask));
    }
    let given = |q: &&Question| scene.parameters.iter().any(|p| *p.name == *q.name);
    let told = scene
        .questions
        .iter()
        .filter(|q| q.stage.is_some() || !q.ask.is_motion());
    for q in told.filter(|q| !given(q)) {
        for suffix in ["", "_x", "_y", "_at"] {
            names.push(format!("{}{suffix}", q.name));
        }
    }
    for (name, file) in entries(base.file.plots.as_ref()) {
        let ask = plot(base, &names, name, file);
        scene.plots.extend(ask);
    }
}

fn plot(
    base: &mut Resolver<'_>,
    names: &[String],
    name: &Text,
    file: &PlotFile,
) -> Option<PlotAsk> {
    let symbols = base.symbols.extended(names);
    let stands_for = match (&file.stands_for, &file.varying) {
        (Some(f), Some(varying)) => Some((formula(base, &symbols, f)?, parameter(base, varying)?)),
        (None, None) => {
            parameter(base, &file.against)?;
            None
        }
        _ => {
            let fault = Fault::new(
                name.span,
                "`stands_for` and `varying` belong together: a new name for a formula, and the parameter of it that varies",
            );
            return fault
                .hint("\"against\": \"q\", \"stands_for\": \"l/d\", \"varying\": \"d\"")
                .add_to(&mut base.faults);
        }
    };
    if stands_for.is_some()
        && (parameter_names(base.file).contains(&file.against.text.as_str())
            || names.contains(&file.against.text))
    {
        let message = format!("the name `{}` is taken", file.against.text);
        return Fault::new(file.against.span, message)
            .hint("a name for a formula is a new name")
            .add_to(&mut base.faults);
    }
    let mut curves = Vec::new();
    for entry in file.curves.iter().flatten() {
        curves.push(with(base, &symbols, Some(entry))?);
    }
    if curves.len() > CURVES {
        let message = format!("{} curves; a plot has at most {CURVES}", curves.len());
        return Fault::new(name.span, message).add_to(&mut base.faults);
    }
    if curves.is_empty() {
        curves.push(Vec::new());
    }
    Some(PlotAsk {
        name: name.text.clone(),
        title: file
            .title
            .as_ref()
            .map_or_else(String::new, |t| t.text.clone()),
        quantity: formula(base, &symbols, &file.quantity)?,
        label: file.label.as_ref().map(|t| t.text.clone()),
        against: Symbol::from(file.against.text.as_str()),
        stands_for,
        from: formula(base, &symbols, &file.from)?,
        to: formula(base, &symbols, &file.to)?,
        curves,
    })
}
