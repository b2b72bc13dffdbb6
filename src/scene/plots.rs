//! Curves to be drawn, as the file asks for them.

use super::fault::Fault;
use super::question_file::PlotFile;
use super::questions::answers::{Reader, parameter_names};
use super::questions::names_of;
use super::record::Text;
use super::record::{entries, text};
use super::resolver::Resolver;
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
    let given = |q: &&Question| scene.parameter(&q.name).is_some();
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
    let symbols = &base.symbols.extended(names);
    let parameters = parameter_names(base.file);
    let mut reader = Reader { base, symbols };
    let stands_for = match (&file.stands_for, &file.varying) {
        (Some(f), Some(varying)) => Some((reader.formula(f)?, reader.parameter(varying)?)),
        (None, None) => {
            reader.parameter(&file.against)?;
            None
        }
        _ => {
            let message = "`stands_for` and `varying` belong together: a new name for a formula, and the parameter of it that varies";
            let hint = "\"against\": \"q\", \"stands_for\": \"l/d\", \"varying\": \"d\"";
            return reader.refuse(name, message, hint);
        }
    };
    let against = &file.against.text;
    let is_taken = parameters.contains(&against.as_str()) || names.contains(against);
    if stands_for.is_some() && is_taken {
        let message = format!("the name `{against}` is taken");
        return reader.refuse(&file.against, message, "a name for a formula is a new name");
    }
    let curves = file.curves.iter().flatten();
    let curves = curves.map(|entry| reader.with(Some(entry)));
    let mut curves = curves.collect::<Option<Vec<_>>>()?;
    if curves.len() > CURVES {
        let message = format!("{} curves; a plot has at most {CURVES}", curves.len());
        return Fault::new(name.span, message).add_to(&mut reader.base.faults);
    }
    if curves.is_empty() {
        curves.push(Vec::new());
    }
    Some(PlotAsk {
        name: name.text.clone(),
        title: text(&file.title),
        quantity: reader.formula(&file.quantity)?,
        label: file.label.as_ref().map(|t| t.text.clone()),
        against: Symbol::from(against.as_str()),
        stands_for,
        from: reader.formula(&file.from)?,
        to: reader.formula(&file.to)?,
        curves,
    })
}
