//! What comes out of a scene under a slip: the altered equations solved in doubles or fractions, and the answer read off.
//!
//! In: what was written, a slip and a point. Out: values of the quantity asked for.

use super::super::belief::{Change, Slip};
use super::Written;
use crate::expr::arithmetic::dot;
use crate::expr::{Expr, Point, Rational, Symbol};
use crate::numeric::given::{Freedom, GivenLaw};
use crate::numeric::{self, Answer, Given, Law, Motion, Number, Solution, System, Unknown};
use crate::scene::{Ask, EnergyWhen, ImpulseAt};

/// What is asked, in the motion a slip leads to.
pub(in crate::grade) fn doubles(
    written: &Written,
    slip: &Slip,
    point: &Point<f64>,
) -> Option<Vec<f64>> {
    let solve = |system: &System<f64>| numeric::solve_roughly(system).ok();
    match slip.change {
        Some(Change::EnergyKept) => energy_kept(written, slip, point, has_one_freedom, solve),
        _ => outcome(written, slip, point, solve),
    }
}

pub(super) fn fractions(
    written: &Written,
    slip: &Slip,
    point: &Point<Rational>,
) -> Option<Vec<Rational>> {
    match slip.change {
        Some(Change::EnergyKept) => None,
        _ => outcome(written, slip, point, |s| numeric::solve_exact(s).ok()),
    }
}

/// Whether nothing comes out of a slip in fractions although its data and the right answer are such.
pub(super) fn has_no_value(written: &Written, slip: &Slip, point: &Point<Rational>) -> bool {
    let truth = Slip::none(written.scene);
    !matches!(slip.change, Some(Change::EnergyKept))
        && numeric::given(&slip.scene, point).is_ok()
        && fractions(written, &truth, point).is_some()
        && fractions(written, slip, point).is_none()
}

pub(super) fn outcome<T: Number>(
    written: &Written,
    slip: &Slip,
    point: &Point<T>,
    solve: impl Fn(&System<T>) -> Option<Solution<T>>,
) -> Option<Vec<T>> {
    let given = numeric::given(&slip.scene, point).ok()?;
    let mut system = numeric::assemble(&given);
    if let Some(change) = &slip.change {
        alter(change, point, &given, &mut system)?;
    }
    let solution = solve(&system)?;
    let motion = numeric::motion(&given, &system, &solution);
    read_off(written, slip, point, given, &motion)
}

fn read_off<T: Number>(
    written: &Written,
    slip: &Slip,
    point: &Point<T>,
    mut given: Given<T>,
    motion: &Motion<T>,
) -> Option<Vec<T>> {
    if let Ask::Value { formula, with, .. } = written.ask {
        return (with.is_empty())
            .then(|| in_formula(formula, written, slip, point, &given, motion))?;
    }
    let mut ask = written.ask.clone();
    match (&slip.change, &mut ask) {
        (
            Some(change @ (Change::NoRotationEnergy | Change::NoTranslationEnergy)),
            Ask::Energy { when, of },
        ) => return energies(change, *when, *of, &given, motion).map(|e| vec![e]),
        (Some(Change::PointIsCenter), Ask::Velocity { point, .. }) if point.is_some() => {
            *point = None;
        }
        (
            Some(Change::NoRotationEnergy | Change::NoTranslationEnergy | Change::PointIsCenter),
            _,
        ) => return None,
        _ => {}
    }
    // Impulses of hinges that the belief removed have no value.
    if let Ask::Impulse {
        from: ImpulseAt::Hinge(_),
        ..
    } = &ask
        && slip.scene.hinges.len() != written.scene.hinges.len()
    {
        return None;
    }
    given.known.clear();
    match numeric::answer(&ask, point, &given, motion).ok()? {
        Answer::Scalar(value) => Some(vec![value]),
        Answer::Vector([x, y]) => Some(match written.component {
            Some(0) => vec![x],
            Some(_) => vec![y],
            None => vec![x, y],
        }),
    }
}

/// A formula of other answers, each as it comes out under the slip.
fn in_formula<T: Number>(
    formula: &Expr,
    written: &Written,
    slip: &Slip,
    point: &Point<T>,
    given: &Given<T>,
    motion: &Motion<T>,
) -> Option<Vec<T>> {
    let (used, mut there) = (formula.symbols(), point.clone());
    for question in written.scene.asked_of_impact() {
        let names = ["", "_x", "_y"].map(|part| Symbol::from(format!("{}{part}", question.name)));
        if !names.iter().any(|name| used.contains(name)) {
            continue;
        }
        let inner = written.of(&question.ask, None, Vec::new());
        let [whole, x, y] = names;
        match <[T; 2]>::try_from(read_off(&inner, slip, point, given.clone(), motion)?) {
            Ok(values) => there.values.extend([x, y].into_iter().zip(values)),
            Err(one) => there.values.extend([whole].into_iter().zip(one)),
        }
    }
    formula.evaluate(&there).map(|value| vec![value])
}

/// Energies with one part left out.
fn energies<T: Number>(
    change: &Change,
    when: EnergyWhen,
    of: Option<usize>,
    given: &Given<T>,
    motion: &Motion<T>,
) -> Option<T> {
    let mut counted = given.clone();
    for body in &mut counted.bodies {
        match change {
            Change::NoRotationEnergy => body.inertia = T::zero(),
            _ => body.mass = T::zero(),
        }
    }
    let before = numeric::energy_before(&counted, of);
    let after = numeric::energy_after(&counted, motion, of);
    Some(match when {
        EnergyWhen::Before => before,
        EnergyWhen::After => after,
        EnergyWhen::Lost => before.minus(&after),
    })
}

/// Changes the equations; `None` where the change does not apply.
fn alter<T: Number>(
    change: &Change,
    point: &Point<T>,
    given: &Given<T>,
    system: &mut System<T>,
) -> Option<()> {
    match change {
        Change::NoImpulse { of, instead } => {
            let law = Law::AngularMomentum(*instead);
            put(system, law, &[(*of, T::one())], T::zero())
        }
        Change::MomentsIgnored {
            bodies,
            about,
            instead,
        } => {
            let o = [about[0].evaluate(point)?, about[1].evaluate(point)?];
            moments_ignored(bodies, &o, *instead, given, system)
        }
        Change::CentersBounce(contact) => centers_bounce(*contact, given, system),
        Change::WholeBounce { contact, body } => whole_bounce(*contact, *body, given, system),
        Change::EnergyKept => None,
        Change::NoRotationEnergy | Change::NoTranslationEnergy | Change::PointIsCenter => Some(()),
    }
}

/// Puts an equation in the place of a law; `None` where there is no such law or unknown.
fn put<T: Number>(
    system: &mut System<T>,
    law: Law,
    entries: &[(Unknown, T)],
    right: T,
) -> Option<()> {
    let n = system.unknowns.len();
    let row = system.laws.iter().position(|l| *l == law)?;
    for column in 0..n {
        system.matrix[row * n + column] = T::zero();
    }
    for (unknown, value) in entries {
        let column = system.column(*unknown)?;
        let cell = &mut system.matrix[row * n + column];
        *cell = cell.plus(value);
    }
    system.right[row] = right;
    Some(())
}

/// The angular momentum of bodies about a point is kept, whatever impulses have a moment about it.
fn moments_ignored<T: Number>(
    bodies: &[usize],
    o: &[T; 2],
    instead: usize,
    given: &Given<T>,
    system: &mut System<T>,
) -> Option<()> {
    let mut entries = Vec::new();
    let mut right = T::zero();
    for &b in bodies {
        let body = &given.bodies[b];
        let r = [body.center[0].minus(&o[0]), body.center[1].minus(&o[1])];
        let m = &body.mass;
        entries.push((Unknown::Velocity(b, 0), m.times(&r[1]).negated()));
        entries.push((Unknown::Velocity(b, 1), m.times(&r[0])));
        let [vx, vy] = &body.velocity;
        right = right.plus(&m.times(&r[0].times(vy).minus(&r[1].times(vx))));
        if body.freedom == Freedom::Rigid {
            entries.push((Unknown::Spin(b), body.inertia.clone()));
            right = right.plus(&body.inertia.times(&body.spin));
        }
    }
    put(system, Law::AngularMomentum(instead), &entries, right)
}

/// Restitution relates the velocities of the centers in place of those of the touching points.
fn centers_bounce<T: Number>(
    contact: usize,
    given: &Given<T>,
    system: &mut System<T>,
) -> Option<()> {
    let touch = &given.contacts[contact];
    let normal = touch.normal.clone()?;
    let GivenLaw::Frictionless(e) = &touch.law else {
        return None;
    };
    let mut entries = Vec::new();
    let mut right = T::zero();
    for (sign, b) in [T::one().negated(), T::one()]
        .into_iter()
        .zip(touch.joint.bodies)
    {
        let body = &given.bodies[b];
        let before = dot(&body.velocity, &normal).times(&sign);
        right = right.minus(&e.times(&before));
        if body.freedom == Freedom::Fixed {
            right = right.minus(&before);
        } else {
            entries.push((Unknown::Velocity(b, 0), normal[0].times(&sign)));
            entries.push((Unknown::Velocity(b, 1), normal[1].times(&sign)));
        }
    }
    put(system, Law::Restitution(contact), &entries, right)
}

/// The whole velocity of a body turns back, e times as large. The impulse follows from the momentum along the normal; the
/// balances of the body give way.
fn whole_bounce<T: Number>(
    contact: usize,
    body: usize,
    given: &Given<T>,
    system: &mut System<T>,
) -> Option<()> {
    let touch = &given.contacts[contact];
    let GivenLaw::Frictionless(e) = &touch.law else {
        return None;
    };
    let normal = touch.normal.clone()?;
    let before = &given.bodies[body].velocity;
    let [x, y] = before.clone().map(|v| v.times(e).negated());
    let change = [x.minus(&before[0]), y.minus(&before[1])];
    let gained = (given.bodies[body].mass).times(&dot(&change, &normal));
    let impulse = match touch.joint.bodies[0] == body {
        true => gained.negated(),
        false => gained,
    };
    for (law, unknown, value) in [
        (Law::Momentum(body, 0), Unknown::Velocity(body, 0), x),
        (Law::Momentum(body, 1), Unknown::Velocity(body, 1), y),
        (
            Law::Restitution(contact),
            Unknown::ContactNormal(contact),
            impulse,
        ),
    ] {
        put(system, law, &[(unknown, T::one())], value)?;
    }
    Some(())
}

/// The motion with the joints' one freedom and the energy before.
pub(super) fn energy_kept<T: Number>(
    written: &Written,
    slip: &Slip,
    point: &Point<T>,
    has_one_freedom: impl Fn(&System<T>, &Solution<T>) -> bool,
    solve: impl Fn(&System<T>) -> Option<Solution<T>>,
) -> Option<Vec<T>> {
    let given = numeric::given(&slip.scene, point).ok()?;
    // Impulses do not scale with the motion.
    if !given.known.is_empty() || matches!(written.ask, Ask::Impulse { .. }) {
        return None;
    }
    let mut system = numeric::assemble(&given);
    // The shape of the motion: what the laws themselves give, which has the joints' freedom.
    let mut solution = solve(&system)?;
    if !has_one_freedom(&system, &solution) {
        return None;
    }
    let motion = numeric::motion(&given, &system, &solution);
    let after = numeric::energy_after(&given, &motion, None);
    let before = numeric::energy_before(&given, None);
    let scale = before.times(&after.recip()?).sqrt()?;
    if !scale.size().is_finite() {
        return None;
    }
    let scaled = |v: &mut T| *v = v.times(&scale);
    solution.values.iter_mut().for_each(scaled);
    system.right.iter_mut().for_each(scaled);
    let motion = numeric::motion(&given, &system, &solution);
    if let Ask::Energy {
        when: EnergyWhen::Lost,
        of: None,
    } = written.ask
    {
        return Some(vec![T::zero()]);
    }
    read_off(written, slip, point, given, &motion)
}

/// Whether hinges and sticking contacts leave what moves one freedom: two lumps on a line have no other.
fn has_one_freedom(system: &System<f64>, solution: &Solution<f64>) -> bool {
    let fastest = solution.values.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let moves = |c: &usize| {
        let velocity = matches!(
            system.unknowns[*c],
            Unknown::Velocity(..) | Unknown::Spin(_)
        );
        velocity && solution.values[*c].abs() > 1e-12 * fastest
    };
    let n = system.unknowns.len();
    let kinematic: Vec<usize> = (0..system.laws.len())
        .filter(|i| {
            use numeric::Law::*;
            matches!(system.laws[*i], Hinge(..) | Sticking(..))
        })
        .collect();
    let columns: Vec<usize> = (0..n).filter(moves).collect();
    // What does not move has none.
    if columns.is_empty() {
        return false;
    }
    let matrix =
        nalgebra::DMatrix::from_fn(kinematic.len().max(columns.len()), columns.len(), |i, j| {
            kinematic
                .get(i)
                .map_or(0.0, |row| system.matrix[row * n + columns[j]])
        });
    let singular = matrix.singular_values();
    let largest = singular.iter().copied().fold(0.0, f64::max);
    singular.iter().filter(|s| **s <= 1e-10 * largest).count() == 1
}
