//! What the desk has before a line is read: true values by name, and those of other moments and motions of the scene.

use std::collections::{BTreeMap, BTreeSet};

use super::super::sheet::Sheet;
use super::link::Values;
use crate::answer::Form;
use crate::derive::{Moment, Names};
use crate::expr::{Expr, Symbol};
use crate::formula;
use crate::laws::Unknown;
use crate::scene::{Ask, ContactLaw, Question, Scene};

/// Most moments and ways whose values are tried on a line.
const MOST_MOMENTS: usize = 48;

/// The true values of a scene by name, and which names are of velocities and spins that go in step where there is one freedom.
pub(super) fn true_values(sheet: &Sheet) -> (Values, BTreeSet<Symbol>) {
    let mut closed = BTreeMap::new();
    let mut moving = BTreeSet::new();
    let d = &sheet.derivation;
    for (unknown, name, value) in d.motion_by_name() {
        if !unknown.is_impulse() {
            moving.insert(name.clone());
        }
        closed.insert(name, value);
    }
    for answer in &d.answers {
        if let Form::Value { closed: value, .. } = &answer.form {
            let question = sheet.scene.question_of_impact(&answer.question);
            if question.is_some_and(|q| matches!(q.ask, Ask::Velocity { .. } | Ask::Spin { .. })) {
                moving.insert(Symbol::from(answer.name.as_str()));
            }
            // What is asked of a parameter under a condition is not what the parameter is.
            if sheet.scene.parameter(&answer.name).is_some() {
                continue;
            }
            closed.insert(Symbol::from(answer.name.as_str()), value.clone());
        }
    }
    (closed, moving)
}

/// Values at other moments than those of the true values, and in other ways the scene can go.
pub(super) fn moments(sheet: &Sheet, closed: &Values) -> Vec<Moment> {
    let differs = |values: &Values| {
        let same = |(name, value): (&Symbol, &Expr)| closed.get(name) == Some(value);
        !values.iter().all(same)
    };
    let own = sheet.moments.iter().cloned();
    let others = sheet.otherwise.iter().flat_map(|way| {
        let (answers, given) = (true_values(way).0, way.given.join(", "));
        let later = way.moments.iter().map(|(when, values)| {
            let mut all = answers.clone();
            all.extend(values.clone());
            (format!("{when}, where {given}"), all)
        });
        let later: Vec<Moment> = later.collect();
        std::iter::once((format!("where {given}"), answers)).chain(later)
    });
    // What is asked with a parameter's value is told there: `with e = 1 the energy lost is 0`.
    let asked = sheet.scene.questions.iter().map(|q| q.ask.with());
    let asked = asked.filter(|with| !with.is_empty()).map(|with| {
        let there: Values = with.iter().cloned().collect();
        let mut all: BTreeMap<_, _> = (closed.iter())
            .map(|(name, value)| (name.clone(), value.substitute(&there)))
            .collect();
        let words = there
            .iter()
            .map(|(name, value)| format!("{name} = {}", formula::write_plain(value)));
        let words: Vec<String> = words.collect();
        all.extend(there);
        (format!("with {}", words.join(", ")), all)
    });
    let all = own
        .chain(others)
        .chain(asked)
        .filter(|(_, values)| differs(values));
    all.take(MOST_MOMENTS).collect()
}

/// Velocities and spins at the end of each motion, by the names that derivations give them.
pub(super) fn ends(sheet: &Sheet) -> Vec<(String, Values)> {
    let each = sheet.ends.iter().map(|(stage, scene)| {
        let names = Names::of(scene);
        let bodies = scene.bodies.iter().enumerate();
        let parts = bodies
            .filter(|(_, body)| !body.is_fixed())
            .flat_map(|(b, body)| {
                let [x, y] = &body.velocity;
                let along = [(Unknown::Velocity(b, 0), x), (Unknown::Velocity(b, 1), y)];
                let spin = (Unknown::Spin(b), &body.spin);
                along
                    .into_iter()
                    .chain((!body.is_particle()).then_some(spin))
            });
        let values = parts.map(|(unknown, value)| (names.plain(unknown).into(), value.clone()));
        (stage.clone(), values.collect())
    });
    each.collect()
}

/// Spins that are asked for, as vectors out of the page.
pub(super) fn spins(scene: &Scene) -> BTreeMap<Symbol, (Symbol, bool)> {
    let spin = |q: &Question| match q.ask {
        Ask::Spin { clockwise, .. } => {
            let arrow = Symbol::from(format!("{}_vec", q.name).as_str());
            Some((arrow, (Symbol::from(q.name.as_str()), clockwise)))
        }
        _ => None,
    };
    scene.questions.iter().filter_map(spin).collect()
}

/// Components of spins that are asked for, out of the page, and of places relative to one another.
pub(super) fn parts(scene: &Scene) -> Values {
    let out_of_page = |(spin, clockwise): (Symbol, bool)| {
        let along = Expr::symbol(&spin);
        [
            Expr::zero(),
            Expr::zero(),
            if clockwise { -along } else { along },
        ]
    };
    let spins = spins(scene).into_iter();
    let spins = spins.map(|(arrow, spin)| (arrow.to_string(), out_of_page(spin)));
    let arms = scene.arms().into_iter();
    let arms =
        arms.filter_map(|(name, [x, y])| Some((formula::with_arrow(&name)?, [x, y, Expr::zero()])));
    let all = spins
        .chain(arms)
        .flat_map(|(arrow, value)| formula::along_axes(&arrow).into_iter().zip(value));
    all.collect()
}

/// Whether hinges and sticking contacts leave the bodies one freedom, so that all velocities go in step.
pub(super) fn one_freedom(scene: &Scene) -> bool {
    let free: usize = scene
        .bodies
        .iter()
        .filter(|b| !b.is_fixed())
        .map(|b| if b.is_particle() { 2 } else { 3 })
        .sum();
    let sticking = scene.contacts.iter().all(|c| c.law == ContactLaw::Sticking);
    let held = 2 * (scene.hinges.len() + scene.contacts.len());
    sticking && free == held + 1
}
