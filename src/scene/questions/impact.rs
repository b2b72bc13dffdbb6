//! Questions about one impact: velocities and spins just after, impulses, energies, balances, matrices.

use crate::expr::only;
use crate::scene::fault::Fault;
use crate::scene::question_file::QuestionFile;
use crate::scene::record::Text;
use crate::scene::record::keys;
use crate::scene::resolver::Resolver;
use crate::scene::{Ask, ImpulseAt, Known, Scene};

/// Reads a question about the motion just after an impact, its impulses and equations.
pub(super) fn ask(
    resolver: &mut Resolver<'_>,
    scene: &Scene,
    name: &Text,
    question: &QuestionFile,
) -> Option<Ask> {
    let along = question.along.as_ref().map(|d| resolver.direction(d));
    // A direction that was given but could not be read has been reported.
    let component = || match &along {
        None => Some(None),
        Some(along) => along.clone().map(Some),
    };
    if let Some(of_velocity) = &question.velocity {
        let (body, point) = velocity(resolver, scene, of_velocity, question.of.as_ref())?;
        return Some(Ask::Velocity {
            body,
            point,
            along: component()?,
        });
    }
    if let Some(body) = &question.spin {
        let index = resolver.moving(body)?;
        if resolver.is_particle(index) {
            let message = format!("the particle `{}` has no spin", body.text);
            return Fault::new(body.span, message).add_to(&mut resolver.faults);
        }
        return Some(Ask::Spin {
            body: index,
            clockwise: question.clockwise == Some(true),
        });
    }
    if let Some(from) = &question.impulse {
        let (from, on) = impulse(resolver, scene, from, question.on.as_ref())?;
        return Some(Ask::Impulse {
            from,
            on,
            along: component()?,
        });
    }
    if let Some(when) = question.energy {
        let of = match &question.of {
            Some(body) => Some(resolver.moving(body)?),
            None => None,
        };
        return Some(Ask::Energy { when, of });
    }
    if question.balance.is_some() {
        let system = question.system.as_deref().unwrap_or_default();
        if system.is_empty() || along.is_none() {
            let message = "a balance needs its bodies, `system`, and its direction, `along`";
            let hint = "\"system\": [\"ball\"], \"along\": [\"1\", \"0\"]";
            return resolver.refuse(name.span, message, hint);
        }
        let bodies: Vec<Option<usize>> = system.iter().map(|body| resolver.moving(body)).collect();
        let bodies = bodies.into_iter().collect::<Option<Vec<_>>>()?;
        let is_twice = |i: &usize| system[..*i].iter().any(|b| b.text == system[*i].text);
        if let Some(twice) = (1..system.len()).find(is_twice) {
            let message = format!("`{}` is in this system twice", system[twice].text);
            return Fault::new(system[twice].span, message).add_to(&mut resolver.faults);
        }
        return Some(Ask::Balance {
            system: bodies,
            along: component()??,
        });
    }
    let words = |list: &Option<Vec<Text>>| -> Vec<String> {
        let all = list.iter().flatten();
        all.map(|t| t.text.clone()).collect()
    };
    Some(Ask::Matrix {
        rows: words(&question.matrix),
        unknowns: words(&question.unknowns),
    })
}

type NamedPosition = (String, crate::expr::Vector);

/// The body, and the point of it if it is not its center.
pub(super) fn velocity(
    resolver: &mut Resolver<'_>,
    scene: &Scene,
    what: &Text,
    of: Option<&Text>,
) -> Option<(usize, Option<NamedPosition>)> {
    if of.is_none()
        && let Some(body) = resolver.find_body(&what.text)
    {
        resolver.moving(what)?;
        return Some((body, None));
    }
    let Some(at) = resolver.find_point(&what.text) else {
        if of.is_some_and(|of| of.text == what.text) && resolver.find_body(&what.text).is_some() {
            return Some((resolver.moving(what)?, None));
        }
        if let Some(of) = of
            && resolver.find_body(&what.text).is_some()
            && resolver.find_point(&of.text).is_some()
        {
            let message = format!("`{}` is a body and `{}` a point", what.text, of.text);
            let hint = format!(
                "the other way round: \"velocity\": \"{}\", \"of\": \"{}\"",
                of.text, what.text
            );
            return resolver.refuse(what.span, message, hint);
        }
        let sought = of.map_or("body or point", |_| "point");
        resolver.unknown(what, sought, Resolver::positions);
        return None;
    };
    let body = match of {
        Some(of) => resolver.moving(of)?,
        None => match only(scene.moving()) {
            Some(only) => only,
            None => {
                let message = format!("the point `{}` may belong to several bodies", what.text);
                let hint = "say which: \"of\": the body's name";
                return resolver.refuse(what.span, message, hint);
            }
        },
    };
    Some((body, Some((what.text.clone(), at?))))
}

/// What transmits the impulse, and on which body it is asked.
fn impulse(
    resolver: &mut Resolver<'_>,
    scene: &Scene,
    from: &Text,
    on: Option<&Text>,
) -> Option<(ImpulseAt, usize)> {
    let name = &from.text;
    let Some(found) = scene.acting().find(|one| one.name == name) else {
        let file = resolver.file;
        let (hinges, blows) = (keys(file.hinges.as_ref()), keys(file.blows.as_ref()));
        let all = [keys(file.contacts.as_ref()), hinges, blows].concat();
        let names: Vec<&str> = all.iter().map(|name| name.text.as_str()).collect();
        // A contact that is there but could not be read has been reported.
        if !names.contains(&name.as_str()) {
            resolver.unknown(from, "contact, hinge or blow", |_| names);
        }
        return None;
    };
    let on = match on {
        Some(on) => {
            let body = resolver.body_named(on)?;
            if !found.bodies.contains(&body) {
                let message = format!("`{name}` does not touch `{}`", on.text);
                return Fault::new(on.span, message).add_to(&mut resolver.faults);
            }
            body
        }
        // Asked for is the impulse on something that moves.
        None => (found.bodies.into_iter()).rfind(|b| !resolver.is_fixed(*b))?,
    };
    Some((found.from, on))
}

/// Checks that the rows and unknowns of a matrix name questions of the right kind.
pub(super) fn matrix_names(
    resolver: &mut Resolver<'_>,
    scene: &Scene,
    name: &Text,
    question: &QuestionFile,
) {
    let Some(rows) = &question.matrix else { return };
    if rows.is_empty() || question.unknowns.as_ref().is_none_or(Vec::is_empty) {
        let message = "a matrix needs rows, `matrix`, and columns, `unknowns`";
        let hint = "both are lists of names of questions";
        resolver.report(name.span, message, hint);
        return;
    }
    let find = |n: &str| scene.question(n);
    let mut unknown: Vec<(&Text, &str)> = Vec::new();
    let mut wrong = |at: &Text, message: String| resolver.faults.push(Fault::new(at.span, message));
    for row in rows {
        let name = &row.text;
        let is_it = |k: &Known| k.name == *name && !k.name.is_empty();
        match find(name) {
            Some(q) if !matches!(q.ask, Ask::Balance { .. }) => {
                wrong(row, format!("the question `{name}` is no equation"));
            }
            None if !scene.after.iter().any(is_it) => {
                unknown.push((row, "balance question or named entry of `after`"));
            }
            _ => {}
        }
    }
    for column in question.unknowns.iter().flatten() {
        let name = &column.text;
        match find(name).map(|q| &q.ask) {
            Some(
                Ask::Spin { .. }
                | Ask::Velocity { along: Some(_), .. }
                | Ask::Impulse { along: Some(_), .. },
            ) => {}
            Some(Ask::Velocity { .. } | Ask::Impulse { .. }) => {
                let message = format!("`{name}` is a vector; an unknown of a matrix is a number");
                wrong(column, message);
            }
            Some(_) => wrong(column, format!("the question `{name}` is no unknown")),
            None => unknown.push((column, "question")),
        }
    }
    let names = keys(resolver.file.questions.as_ref()).into_iter();
    let names: Vec<&str> = names.map(|name| name.text.as_str()).collect();
    for (text, what) in unknown {
        // A question that is there but could not be read has been reported.
        if !names.contains(&text.text.as_str()) {
            resolver.unknown(text, what, |_| names.clone());
        }
    }
}
