//! Questions about formulas of answers: what the file says becomes an [`Ask`].
//!
//! Scenes of one impact and scenes with stages ask these alike: values, thresholds, equations to be solved, largest values,
//! limits, forms for a small parameter, identities. Nothing is worked out here.

use crate::expr::{Expr, Symbol};
use crate::formula::Relation;
use crate::formula::near::nearest;
use crate::scene::contact_file::{ContactFile, LawName};
use crate::scene::fault::Fault;
use crate::scene::file::SceneFile;
use crate::scene::formulas::Symbols;
use crate::scene::question_file::QuestionFile;
use crate::scene::record::{Formula, Map, Text};
use crate::scene::resolve::{Resolver, entries};
use crate::scene::{Ask, FrictionEvent};

/// Highest power of a small parameter that may be asked for.
const ORDER: u32 = 6;

/// Reads a question about formulas.
pub(super) fn ask(
    base: &mut Resolver<'_>,
    symbols: &Symbols,
    name: &Text,
    q: &QuestionFile,
) -> Option<Ask> {
    if let Some(f) = &q.value {
        return Some(Ask::Value {
            formula: formula(base, symbols, f)?,
            with: with(base, symbols, q.with.as_ref())?,
            meaning: String::new(),
        });
    }
    if let Some(of) = &q.maximum {
        let over = q.over.iter().flatten();
        let over: Vec<Symbol> = over.filter_map(|t| parameter(base, t)).collect();
        if over.is_empty() {
            let message = "a maximum needs the parameters that may be chosen, `over`";
            return Fault::new(name.span, message).add_to(&mut base.faults);
        }
        return Some(Ask::Maximum {
            of: formula(base, symbols, of)?,
            over,
        });
    }
    if let Some(of) = &q.limit {
        return limit(base, symbols, name, q, of);
    }
    if let Some(of) = &q.approximate {
        return approximate(base, symbols, name, q, of);
    }
    if let Some(equation) = &q.show {
        return show(base, symbols, q, equation);
    }
    let of = q.threshold.as_ref().or(q.solve.as_ref())?;
    let Some(holds) = &q.holds else {
        let fault = Fault::new(name.span, "a threshold needs the relation that `holds`");
        let fault = fault.hint("\"threshold\": \"v\", \"holds\": \"K_top <= 0\"");
        return fault.add_to(&mut base.faults);
    };
    if let (Some(parameter), Some(event)) = (&q.threshold, event(holds)) {
        let mut declared = symbols.names().declared().iter();
        // A product of parameters may bear such a name.
        if !places(base.file, q, event.0).is_empty() || !declared.any(|d| *d.name == *event.0) {
            return sticking(base, q, parameter, holds, event);
        }
    }
    if let Some(at) = q.at.as_ref().filter(|_| base.file.stages.is_some()) {
        let message = "`at` belongs to a threshold of friction, such as \"C sticks\"";
        let fault = Fault::new(at.span, message)
            .hint("the answers in `holds` say at which stage they are asked");
        return fault.add_to(&mut base.faults);
    }
    let (left, relation, right) = relation(base, symbols, holds)?;
    if q.solve.is_some() != (relation == Relation::Equal) {
        let message = "a threshold holds an inequality, and what is to be solved an equation";
        return Fault::new(holds.span, message).add_to(&mut base.faults);
    }
    Some(Ask::Condition {
        parameter: parameter(base, of)?,
        left,
        relation,
        right,
        with: with(base, symbols, q.with.as_ref())?,
    })
}

fn limit(
    base: &mut Resolver<'_>,
    symbols: &Symbols,
    name: &Text,
    q: &QuestionFile,
    of: &Formula,
) -> Option<Ask> {
    let (Some(tends), Some(to)) = (&q.tends, &q.to) else {
        let message = "a limit needs the parameter that `tends` and what it tends `to`";
        let fault = Fault::new(name.span, message).hint("\"tends\": \"phi\", \"to\": \"0\"");
        return fault.add_to(&mut base.faults);
    };
    let to = match to.text.trim() {
        "infinity" | "inf" | "oo" | "∞" => None,
        _ => Some(formula(base, symbols, to)?),
    };
    Some(Ask::Limit {
        of: formula(base, symbols, of)?,
        parameter: parameter(base, tends)?,
        to,
    })
}

fn show(
    base: &mut Resolver<'_>,
    symbols: &Symbols,
    q: &QuestionFile,
    equation: &Text,
) -> Option<Ask> {
    let (left, relation, right) = relation(base, symbols, equation)?;
    let unless = q.unless.iter().flatten();
    let unless = unless.filter_map(|t| answer_named(base, symbols, t));
    let unless = unless.collect();
    let claim = q.claim.as_ref().map(|t| t.text.clone());
    Some(Ask::Show {
        left,
        relation,
        right,
        with: with(base, symbols, q.with.as_ref())?,
        unless,
        claim: claim.unwrap_or_default(),
    })
}

/// The threshold of friction at which a contact sticks, slides or jams.
fn sticking(
    base: &mut Resolver<'_>,
    q: &QuestionFile,
    parameter: &Text,
    holds: &Text,
    (contact, event): (&str, FrictionEvent),
) -> Option<Ask> {
    let places = places(base.file, q, contact);
    let (message, hint) = match places.as_slice() {
        [one] => return friction_threshold(base, parameter, one, event),
        [] => (
            format!("no impact has a contact `{contact}`"),
            "a threshold of friction names its contact, such as \"C sticks\"",
        ),
        _ => (
            format!("several impacts have a contact `{contact}`"),
            "say which with `at`",
        ),
    };
    let fault = Fault::new(holds.span, message).hint(hint);
    fault.add_to(&mut base.faults)
}

/// The name and the event in words such as `C sticks`.
fn event(holds: &Text) -> Option<(&str, FrictionEvent)> {
    let (name, event) = holds.text.trim().rsplit_once(' ')?;
    let event = match event {
        "sticks" => FrictionEvent::Sticks,
        "slides" => FrictionEvent::Slides,
        "jams" => FrictionEvent::Jams,
        _ => return None,
    };
    Some((name.trim(), event))
}

/// A contact of the file.
struct ContactPlace<'f> {
    /// Index of the stage it stands in; `None` in a scene of one impact.
    stage: Option<usize>,
    /// Its index there.
    contact: usize,
    file: &'f ContactFile,
}

/// The contacts of this name, at the stage that the question names if it does.
fn places<'f>(file: &'f SceneFile, q: &QuestionFile, name: &str) -> Vec<ContactPlace<'f>> {
    let all = |stage, contacts: &'f Option<Map<ContactFile>>| {
        let contacts = contacts.iter().flat_map(|m| &m.0).enumerate();
        contacts.filter_map(move |(contact, (n, file))| Some((stage, contact, n, file.as_ref()?)))
    };
    let stages = file.stages.iter().flatten().enumerate();
    let named = stages.filter(|(_, s)| q.at.as_ref().is_none_or(|at| at.text == s.name.text));
    let inside = named.filter_map(|(i, s)| Some(all(Some(i), &s.impact.as_ref()?.contacts)));
    let found = all(None, &file.contacts).chain(inside.flatten());
    found
        .filter(|(_, _, n, _)| n.text == name)
        .map(|(stage, contact, _, file)| ContactPlace {
            stage,
            contact,
            file,
        })
        .collect()
}

/// The stage to which a question about answers belongs: a threshold of friction is one of its contact.
pub(super) fn stage_of(file: &SceneFile, q: &QuestionFile, ask: &Ask) -> Option<usize> {
    let (Ask::Friction { .. }, Some(holds)) = (ask, &q.holds) else {
        return None;
    };
    places(file, q, event(holds)?.0).first()?.stage
}

/// A threshold of the coefficient of friction.
fn friction_threshold(
    base: &mut Resolver<'_>,
    parameter: &Text,
    ContactPlace { contact, file, .. }: &ContactPlace<'_>,
    event: FrictionEvent,
) -> Option<Ask> {
    let Some(mu) = file
        .mu
        .as_ref()
        .filter(|_| file.law == Some(LawName::Friction))
    else {
        let message = "only a contact with friction has a threshold of it";
        let fault = Fault::new(parameter.span, message);
        return fault
            .hint("give the contact \"law\": \"friction\" with `mu` and `restitution`")
            .add_to(&mut base.faults);
    };
    if mu.text.trim() != parameter.text {
        let message = format!(
            "a threshold of friction is one of `mu`, which is {} here, and not of {}",
            mu.text.trim(),
            parameter.text
        );
        let fault = Fault::new(parameter.span, message);
        return fault
            .hint("let the `mu` of the contact be a parameter, and ask for the threshold of that")
            .add_to(&mut base.faults);
    }
    Some(Ask::Friction {
        contact: *contact,
        event,
    })
}

fn approximate(
    base: &mut Resolver<'_>,
    symbols: &Symbols,
    name: &Text,
    q: &QuestionFile,
    of: &Formula,
) -> Option<Ask> {
    let Some(tends) = &q.tends else {
        let fault = Fault::new(
            name.span,
            "a form for a small parameter needs the parameter that `tends`",
        );
        return fault
            .hint("\"tends\": \"theta\", \"to\": \"0\", \"order\": 1")
            .add_to(&mut base.faults);
    };
    let whole = |order: &Formula| order.text.trim().parse().ok().filter(|n| *n <= ORDER);
    let power = q.order.as_ref().map(whole);
    if let (Some(None), Some(order)) = (power, &q.order) {
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
        order: power.map_or(Some(None), |power| power.map(Some))?,
    })
}

/// A formula of parameters and earlier answers.
pub(in crate::scene) fn formula(
    base: &mut Resolver<'_>,
    symbols: &Symbols,
    f: &Formula,
) -> Option<Expr> {
    let e = symbols.expression(f, &mut base.faults)?;
    e.symbols().iter().for_each(|name| symbols.mark_used(name));
    e.symbols()
        .iter()
        .for_each(|name| base.symbols.mark_used(name));
    Some(e)
}

/// Parameters and what stands for them.
pub(in crate::scene) fn with(
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
        match nearest(&name.text, declared.iter().map(String::as_str)) {
            Some(near) => fault.hint(format!("did you mean `{near}`?")),
            None => fault,
        },
    );
    None
}

/// The symbol of a parameter.
pub(in crate::scene) fn parameter(base: &mut Resolver<'_>, name: &Text) -> Option<Symbol> {
    let all: Vec<&str> = parameter_names(base.file);
    if all.contains(&name.text.as_str()) {
        base.symbols.mark_used(&name.text);
        return Some(name.text.as_str().into());
    }
    base.unknown(name, "parameter", |_| all);
    None
}

/// Names of the parameters.
pub(in crate::scene) fn parameter_names(file: &SceneFile) -> Vec<&str> {
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
