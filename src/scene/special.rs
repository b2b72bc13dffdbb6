//! Questions about formulas of answers, and curves to be drawn: what the file says becomes a [`Ask`] or [`PlotAsk`].
//!
//! Scenes of one impact and scenes with stages ask these alike: values, thresholds, equations to be solved, largest values,
//! limits, forms for a small parameter, identities. Nothing is worked out here.

use super::contact_file::{ContactFile, LawName};
use super::fault::Fault;
use super::file::SceneFile;
use super::formulas::Symbols;
use super::question::is_motion;
use super::question_file::{PlotFile, QuestionFile};
use super::record::{Formula, Map, Text};
use super::resolve::{Resolver, entries};
use super::told::is_own;
use super::{Ask, FrictionEvent, PlotAsk, Question, Scene};
use crate::expr::{Expr, Symbol};
use crate::formula::Relation;

/// Highest power of a small parameter that may be asked for.
const ORDER: u32 = 6;
/// Most curves of a plot.
const CURVES: usize = 6;

/// Whether the question is about formulas of answers.
pub(super) fn is_asked(q: &QuestionFile) -> bool {
    asked(q).iter().any(|(_, given, _)| *given)
}

/// The kinds of question, which of them are asked, and what else belongs to each.
pub(super) fn asked(q: &QuestionFile) -> [(&'static str, bool, &'static [&'static str]); 7] {
    [
        ("value", q.value.is_some(), &["with"]),
        ("threshold", q.threshold.is_some(), &["holds", "with"]),
        ("solve", q.solve.is_some(), &["holds", "with"]),
        ("maximum", q.maximum.is_some(), &["over"]),
        ("limit", q.limit.is_some(), &["tends", "to"]),
        (
            "approximate",
            q.approximate.is_some(),
            &["tends", "to", "order"],
        ),
        ("show", q.show.is_some(), &["with", "unless", "claim"]),
    ]
}

/// Fields that belong to these questions, and whether they are given.
pub(super) fn companions(q: &QuestionFile) -> [(&'static str, bool); 8] {
    [
        ("with", q.with.is_some()),
        ("holds", q.holds.is_some()),
        ("over", q.over.is_some()),
        ("tends", q.tends.is_some()),
        ("to", q.to.is_some()),
        ("order", q.order.is_some()),
        ("unless", q.unless.is_some()),
        ("claim", q.claim.is_some()),
    ]
}

/// Reads the questions of a scene of one impact that are about its answers.
pub(super) fn resolve(base: &mut Resolver<'_>, scene: &mut Scene) {
    let mut names: Vec<String> = Vec::new();
    for q in &scene.questions {
        names.extend(names_of(&q.name, &q.ask));
    }
    names.extend(scene.special.iter().map(|q| q.name.clone()));
    for (name, q) in entries(base.file.questions.as_ref()) {
        if let Some(at) = &q.at {
            let message = "`at` names a stage, and this scene has none";
            base.faults.push(Fault::new(at.span, message));
        }
        let is_own = is_own(name, Some(q));
        if scene.parameters.iter().any(|p| *p.name == *name.text) && !is_own {
            continue;
        }
        if !is_asked(q) || is_motion(q) {
            continue;
        }
        let ask = with_names(base, &names, |base, symbols| ask(base, symbols, name, q));
        if let Some(ask) = ask {
            let latex = q.latex.as_ref().map(|t| t.text.clone());
            scene.special.push(Question::new(&name.text, latex, ask));
        }
        if is_own {
            continue;
        }
        for suffix in ["", "_x", "_y", "_at"] {
            names.push(format!("{}{suffix}", name.text));
        }
    }
}

/// Reads a question with the names of earlier answers beside the parameters.
pub(super) fn with_names<T>(
    base: &mut Resolver<'_>,
    names: &[String],
    read: impl FnOnce(&mut Resolver<'_>, &Symbols) -> Option<T>,
) -> Option<T> {
    let earlier = base.faults.len();
    let symbols = base.symbols.extended(names.iter().map(String::as_str));
    let found = read(base, &symbols);
    for used in symbols.used() {
        base.symbols.mark_used(&used);
    }
    let questions = base.file.questions.iter().flat_map(|m| &m.0);
    for (name, _) in questions {
        let open = format!("`{}` is not declared", name.text);
        for fault in base.faults[earlier..]
            .iter_mut()
            .filter(|f| f.message == open)
        {
            fault.hint = Some(format!(
                "`{}` is asked further down; a formula takes answers to questions above it",
                name.text
            ));
        }
    }
    found
}

/// Names under which the answer to a question about motion stands in formulas.
fn names_of(name: &str, ask: &Ask) -> Vec<String> {
    match ask {
        Ask::Velocity { along: None, .. } | Ask::Impulse { along: None, .. } => ["", "_x", "_y"]
            .map(|suffix| format!("{name}{suffix}"))
            .to_vec(),
        Ask::Balance { .. } | Ask::Matrix { .. } => Vec::new(),
        _ => vec![name.to_string()],
    }
}

/// Reads a question about formulas.
pub(super) fn ask(
    base: &mut Resolver<'_>,
    symbols: &Symbols,
    name: &Text,
    q: &QuestionFile,
) -> Option<Ask> {
    let kinds: Vec<_> = asked(q)
        .into_iter()
        .filter(|(_, given, _)| *given)
        .collect();
    let [(kind, _, own)] = kinds.as_slice() else {
        let all: Vec<&str> = kinds.iter().map(|k| k.0).collect();
        let message = format!(
            "this question asks {} things: {}",
            all.len(),
            all.join(", ")
        );
        base.faults
            .push(Fault::new(name.span, message).hint("give each of them a question of its own"));
        return None;
    };
    for (other, given) in companions(q) {
        if given && !own.contains(&other) {
            let message = format!("a question about a {kind} has no `{other}`");
            base.faults.push(Fault::new(name.span, message));
        }
    }
    let read = |base: &mut Resolver<'_>, f: &Formula| formula(base, symbols, f);
    if let Some(f) = &q.value {
        return Some(Ask::Value {
            formula: read(base, f)?,
            with: with(base, symbols, q.with.as_ref())?,
            meaning: String::new(),
        });
    }
    if let Some(of) = &q.maximum {
        let over = q
            .over
            .iter()
            .flatten()
            .filter_map(|t| parameter(base, t))
            .collect::<Vec<_>>();
        if over.is_empty() {
            base.faults.push(Fault::new(
                name.span,
                "a maximum needs the parameters that may be chosen, `over`",
            ));
            return None;
        }
        return Some(Ask::Maximum {
            of: read(base, of)?,
            over,
        });
    }
    if let Some(of) = &q.limit {
        let (Some(tends), Some(to)) = (&q.tends, &q.to) else {
            let fault = Fault::new(
                name.span,
                "a limit needs the parameter that `tends` and what it tends `to`",
            );
            base.faults
                .push(fault.hint("\"tends\": \"phi\", \"to\": \"0\""));
            return None;
        };
        let to = if matches!(to.text.trim(), "infinity" | "inf" | "oo" | "∞") {
            None
        } else {
            Some(read(base, to)?)
        };
        return Some(Ask::Limit {
            of: read(base, of)?,
            parameter: parameter(base, tends)?,
            to,
        });
    }
    if let Some(of) = &q.approximate {
        return approximate(base, symbols, name, q, of);
    }
    if let Some(equation) = &q.show {
        let (left, relation, right) = relation(base, symbols, equation)?;
        if relation != Relation::Equal {
            base.faults.push(Fault::new(
                equation.span,
                "what is to be shown is an equation",
            ));
            return None;
        }
        let unless = q
            .unless
            .iter()
            .flatten()
            .filter_map(|t| answer_named(base, symbols, t))
            .collect();
        return Some(Ask::Show {
            left,
            right,
            with: with(base, symbols, q.with.as_ref())?,
            unless,
            claim: q
                .claim
                .as_ref()
                .map_or_else(String::new, |t| t.text.clone()),
        });
    }
    let of = q.threshold.as_ref().or(q.solve.as_ref())?;
    let Some(holds) = &q.holds else {
        let fault = Fault::new(name.span, "a threshold needs the relation that `holds`");
        base.faults
            .push(fault.hint("\"threshold\": \"v\", \"holds\": \"K_top <= 0\""));
        return None;
    };
    if let (Some(parameter), Some(asked)) = (&q.threshold, of_friction(base, holds)) {
        return friction_threshold(base, parameter, asked);
    }
    let (left, relation, right) = relation(base, symbols, holds)?;
    if q.solve.is_some() != (relation == Relation::Equal) {
        let message = "a threshold holds an inequality, and what is to be solved an equation";
        base.faults.push(Fault::new(holds.span, message));
        return None;
    }
    Some(Ask::Condition {
        parameter: parameter(base, of)?,
        left,
        relation,
        right,
        with: with(base, symbols, q.with.as_ref())?,
    })
}

/// The contact and the event of a relation such as `C sticks`; `None` for a relation between formulas.
fn of_friction<'f>(
    base: &Resolver<'f>,
    holds: &Text,
) -> Option<(usize, &'f ContactFile, FrictionEvent)> {
    let (name, event) = holds.text.trim().rsplit_once(' ')?;
    let event = match event {
        "sticks" => FrictionEvent::Sticks,
        "slides" => FrictionEvent::Slides,
        "jams" => FrictionEvent::Jams,
        _ => return None,
    };
    let contacts = base.file.contacts.iter().flat_map(|m| &m.0);
    let found = contacts
        .enumerate()
        .find(|(_, (n, _))| n.text == name.trim());
    found.and_then(|(i, (_, contact))| Some((i, contact.as_ref()?, event)))
}

/// A threshold of the coefficient of friction.
fn friction_threshold(
    base: &mut Resolver<'_>,
    parameter: &Text,
    (contact, file, event): (usize, &ContactFile, FrictionEvent),
) -> Option<Ask> {
    let Some(mu) = file
        .mu
        .as_ref()
        .filter(|_| file.law == Some(LawName::Friction))
    else {
        let message = "only a contact with friction has a threshold of it";
        let fault = Fault::new(parameter.span, message);
        base.faults
            .push(fault.hint("give the contact \"law\": \"friction\" with `mu` and `restitution`"));
        return None;
    };
    if mu.text.trim() != parameter.text {
        let message = format!(
            "a threshold of friction is one of `mu`, which is {} here, and not of {}",
            mu.text.trim(),
            parameter.text
        );
        let fault = Fault::new(parameter.span, message);
        base.faults.push(
            fault.hint(
                "let the `mu` of the contact be a parameter, and ask for the threshold of that",
            ),
        );
        return None;
    }
    Some(Ask::Friction { contact, event })
}

fn approximate(
    base: &mut Resolver<'_>,
    symbols: &Symbols,
    name: &Text,
    q: &QuestionFile,
    of: &Formula,
) -> Option<Ask> {
    let (Some(tends), Some(order)) = (&q.tends, &q.order) else {
        let fault = Fault::new(
            name.span,
            "a form for a small parameter needs the parameter that `tends` and the `order`",
        );
        base.faults
            .push(fault.hint("\"tends\": \"theta\", \"to\": \"0\", \"order\": 1"));
        return None;
    };
    let power: Option<u32> = order.text.trim().parse().ok().filter(|n| *n <= ORDER);
    if power.is_none() {
        base.faults.push(Fault::new(
            order.span,
            format!("the order is a whole number from 0 to {ORDER}"),
        ));
    }
    Some(Ask::Approximate {
        of: formula(base, symbols, of)?,
        parameter: parameter(base, tends)?,
        to: match &q.to {
            Some(to) => formula(base, symbols, to)?,
            None => Expr::zero(),
        },
        order: power?,
    })
}

/// Reads the curves that are asked for; `names` are those of the answers.
pub(super) fn plots(base: &mut Resolver<'_>, scene: &mut Scene) {
    let mut names: Vec<String> = Vec::new();
    for q in &scene.questions {
        names.extend(names_of(&q.name, &q.ask));
    }
    let later = scene.story.iter().flat_map(|s| &s.questions);
    let given = |q: &&Question| scene.parameters.iter().any(|p| *p.name == *q.name);
    for q in scene.special.iter().chain(later).filter(|q| !given(q)) {
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
    let symbols = base.symbols.extended(names.iter().map(String::as_str));
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
            base.faults.push(
                fault.hint("\"against\": \"q\", \"stands_for\": \"l/d\", \"varying\": \"d\""),
            );
            return None;
        }
    };
    if stands_for.is_some()
        && (parameter_names(base.file).contains(&file.against.text.as_str())
            || names.contains(&file.against.text))
    {
        let message = format!("the name `{}` is taken", file.against.text);
        base.faults.push(
            Fault::new(file.against.span, message).hint("a name for a formula is a new name"),
        );
        return None;
    }
    let mut curves = Vec::new();
    for entry in file.curves.iter().flatten() {
        curves.push(with(base, &symbols, Some(entry))?);
    }
    if curves.len() > CURVES {
        let message = format!("{} curves; a plot has at most {CURVES}", curves.len());
        base.faults.push(Fault::new(name.span, message));
        return None;
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

/// A formula of parameters and earlier answers.
pub(super) fn formula(base: &mut Resolver<'_>, symbols: &Symbols, f: &Formula) -> Option<Expr> {
    let e = symbols.expression(f, &mut base.faults)?;
    e.symbols().iter().for_each(|name| symbols.mark_used(name));
    e.symbols()
        .iter()
        .for_each(|name| base.symbols.mark_used(name));
    Some(e)
}

/// Parameters and what stands for them.
fn with(
    base: &mut Resolver<'_>,
    symbols: &Symbols,
    map: Option<&Map<Formula>>,
) -> Option<Vec<(Symbol, Expr)>> {
    let mut out = Vec::new();
    for (name, value) in entries(map) {
        let value = formula(base, symbols, value)?;
        out.push((parameter(base, name)?, value));
    }
    Some(out)
}

/// The symbol of an earlier answer.
fn answer_named(base: &mut Resolver<'_>, symbols: &Symbols, name: &Text) -> Option<Symbol> {
    let given = parameter_names(base.file);
    let declared: Vec<String> = symbols
        .names()
        .declared()
        .iter()
        .map(|d| d.name.to_string())
        .filter(|n| !given.contains(&n.as_str()))
        .collect();
    if declared.contains(&name.text) {
        return Some(name.text.as_str().into());
    }
    let fault = Fault::new(
        name.span,
        format!("no earlier answer is called `{}`", name.text),
    );
    base.faults.push(
        match super::fault::nearest(&name.text, declared.iter().map(String::as_str)) {
            Some(near) => fault.hint(format!("did you mean `{near}`?")),
            None => fault,
        },
    );
    None
}

/// The symbol of a parameter.
fn parameter(base: &mut Resolver<'_>, name: &Text) -> Option<Symbol> {
    let all: Vec<&str> = parameter_names(base.file);
    if all.contains(&name.text.as_str()) {
        base.symbols.mark_used(&name.text);
        return Some(name.text.as_str().into());
    }
    base.unknown(name, "parameter", |_| all);
    None
}

/// Names of the parameters.
pub(super) fn parameter_names(file: &SceneFile) -> Vec<&str> {
    file.parameters
        .iter()
        .flat_map(|m| &m.0)
        .map(|(n, _)| n.text.as_str())
        .collect()
}

/// A relation between two formulas.
fn relation(
    base: &mut Resolver<'_>,
    symbols: &Symbols,
    text: &Text,
) -> Option<(Expr, Relation, Expr)> {
    let (sides, relations) = symbols.relations(text, &mut base.faults)?;
    if let ([left, right], [relation]) = (sides.as_slice(), relations.as_slice())
        && !matches!(relation, Relation::NotEqual | Relation::Approximately)
    {
        return Some((left.clone(), *relation, right.clone()));
    }
    let fault = Fault::new(text.span, "expected one relation between two formulas");
    base.faults
        .push(fault.hint("such as \"K_top <= 0\" or \"omega_end = 0\""));
    None
}
