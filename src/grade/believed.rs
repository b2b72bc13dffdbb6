//! What a scene would answer if a belief were true, and which beliefs give exactly the student's formula.
//!
//! The altered scene is solved in doubles at a few points; only what agrees there is held against exact fractions. So
//! hundreds of beliefs, and pairs of them, cost less than one derivation.

use std::collections::BTreeMap;

use super::Diagnosis;
use super::belief::{BELIEFS, Belief, Change, Slip};
use crate::expr::{Expr, Node, Point, Rational, Symbol};
use crate::numeric::{self, Answer, Given, Motion, Number, Solution, System, Unknown};
use crate::scene::{Ask, EnergyWhen, ImpulseAt, Scene};

/// Points at which every belief is tried.
const POINTS: u64 = 4;
/// Pairs of beliefs are searched while there are no more of them than this.
const PAIRS: usize = 6_000;
/// Beliefs and quantities named at most.
pub(super) const NAMED: usize = 4;
/// Pairs of beliefs named at most.
const PAIRS_NAMED: usize = 3;

/// What the student wrote: one expression, or two components.
pub struct Written<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// What is asked.
    pub ask: &'a Ask,
    /// The component asked for, of a vector.
    pub component: Option<usize>,
    /// The answer: one expression, or two components.
    pub values: Vec<Expr>,
    /// For an answer in numbers: how far each may be off, the scene's values being given.
    pub rounding: Option<f64>,
}

struct Trials {
    points: Vec<Point<f64>>,
    exact: Vec<Point<Rational>>,
    targets: Vec<Vec<f64>>,
    rounding: Option<f64>,
}

/// The beliefs that give exactly the written answer, single ones before pairs.
pub fn beliefs(written: &Written) -> Vec<Diagnosis> {
    let Some(trials) = trials(written) else {
        return Vec::new();
    };
    // What is right, and wrong only in its unit or form, comes from no belief.
    let truth = Slip {
        scene: written.scene.clone(),
        changes: Vec::new(),
        place: String::new(),
    };
    if trials.fits(written, &truth) {
        return Vec::new();
    }
    let mut found: Vec<Diagnosis> = Vec::new();
    let mut slips: Vec<(&Belief, Slip)> = Vec::new();
    for belief in BELIEFS {
        let mut named = false;
        for slip in (belief.slips)(written.scene) {
            if !named && trials.fits(written, &slip) {
                found.push(words(belief, &slip, written.rounding.is_some()));
                named = true;
            }
            slips.push((belief, slip));
        }
    }
    // What follows from very many beliefs tells none of them.
    if found.len() > NAMED {
        return Vec::new();
    }
    if found.is_empty() {
        found = opposite(written, &trials, &slips);
    }
    if found.is_empty() && written.rounding.is_none() && slips.len() * slips.len() / 2 <= PAIRS * 4
    {
        found = pairs(written, &trials, &slips);
    }
    found
}

/// The belief whose answer is the written one with the other sign.
fn opposite(written: &Written, trials: &Trials, slips: &[(&Belief, Slip)]) -> Vec<Diagnosis> {
    let turned = Written {
        values: written.values.iter().map(|v| -v).collect(),
        ask: written.ask,
        ..*written
    };
    let mirrored = trials.times(-1.0);
    let hit = slips.iter().find(|(_, slip)| mirrored.fits(&turned, slip));
    hit.map(|(belief, slip)| {
        let mut d = words(belief, slip, written.rounding.is_some());
        d.message.push_str(", with the opposite sign");
        d.hint = format!("{} Check the sign too.", d.hint);
        vec![d]
    })
    .unwrap_or_default()
}

pub(super) fn words(belief: &Belief, slip: &Slip, rounded: bool) -> Diagnosis {
    let place = if slip.place.is_empty() {
        String::new()
    } else {
        format!(" ({})", slip.place)
    };
    Diagnosis::new(
        belief.code,
        match rounded {
            true => format!("what comes out, rounded, when {}{place}", belief.belief),
            false => format!("exactly what comes out when {}{place}", belief.belief),
        },
        belief.hint,
    )
}

/// Two beliefs at a time: the second is applied to the scene of the first. Several pairs that explain the answer equally
/// well are all named, unless they are too many to mean anything.
fn pairs(written: &Written, trials: &Trials, slips: &[(&Belief, Slip)]) -> Vec<Diagnosis> {
    let mut tried = 0;
    let mut found: Vec<Diagnosis> = Vec::new();
    let mut named: Vec<[&str; 2]> = Vec::new();
    for (i, (first, slip)) in slips.iter().enumerate() {
        // A change of the equations is combined as it is; one of the scene carries the second along.
        for second in BELIEFS.iter().filter(|b| b.code > first.code) {
            if !slip.changes.is_empty() {
                continue;
            }
            for other in (second.slips)(&slip.scene) {
                tried += 1;
                if tried > PAIRS {
                    return found;
                }
                let pair = [first.code, second.code];
                if !named.contains(&pair) && trials.fits(written, &other) {
                    named.push(pair);
                    if found.len() == PAIRS_NAMED {
                        return Vec::new();
                    }
                    let mut d = words(first, &slips[i].1, false);
                    d.code = "TWO_BELIEFS";
                    d.message = format!(
                        "{} and, with it, {} ({})",
                        d.message, second.belief, other.place
                    );
                    d.hint = format!("two things to look at: {} And: {}", first.hint, second.hint);
                    found.push(d);
                }
            }
        }
    }
    found
}

fn trials(written: &Written) -> Option<Trials> {
    let mut needed = numeric::needed(written.scene);
    written.values.iter().for_each(|e| needed.add(e));
    let (points, exact) = match written.rounding {
        Some(_) => (vec![given_values(written.scene)?], Vec::new()),
        None => {
            let exact: Vec<_> = (11..11 + POINTS)
                .map(|seed| numeric::random_point(&needed, &written.scene.domains, seed))
                .collect();
            (exact.iter().map(numeric::rounded).collect(), exact)
        }
    };
    let mut trials = Trials {
        points: Vec::new(),
        exact,
        targets: Vec::new(),
        rounding: written.rounding,
    };
    for point in points {
        let values: Option<Vec<f64>> = written.values.iter().map(|e| e.evaluate(&point)).collect();
        if let Some(values) = values.filter(|v| v.iter().all(|x| x.is_finite())) {
            trials.points.push(point);
            trials.targets.push(values);
        }
    }
    let enough = if written.rounding.is_some() { 1 } else { 2 };
    (trials.points.len() >= enough).then_some(trials)
}

/// The scene's own values in doubles.
pub fn given_values(scene: &Scene) -> Option<Point<f64>> {
    let mut point = Point::default();
    for p in &scene.parameters {
        let value: f64 = p.value.as_ref()?.evaluate(&Point::<f64>::default())?;
        point.values.insert(p.name.clone(), value);
    }
    Some(point)
}

impl Trials {
    /// The same points, all targets times a number.
    fn times(&self, k: f64) -> Trials {
        Trials {
            points: self.points.clone(),
            exact: self.exact.clone(),
            targets: self
                .targets
                .iter()
                .map(|t| t.iter().map(|v| v * k).collect())
                .collect(),
            rounding: self.rounding,
        }
    }

    fn fits(&self, written: &Written, slip: &Slip) -> bool {
        let mut defined = 0;
        for (point, target) in self.points.iter().zip(&self.targets) {
            let Some(values) = doubles(written, slip, point) else {
                continue;
            };
            defined += 1;
            if values.len() != target.len()
                || !values.iter().zip(target).all(|(a, b)| self.close(*a, *b))
            {
                return false;
            }
        }
        if defined == 0 || (self.rounding.is_none() && defined < 2) {
            return false;
        }
        // Exact fractions tell what doubles cannot, where there are no roots.
        for point in self.exact.iter().take(2) {
            let target: Option<Vec<Rational>> =
                written.values.iter().map(|e| bounded(e, point)).collect();
            if let (Some(target), Some(values)) = (target, fractions(written, slip, point))
                && target != values
            {
                return false;
            }
        }
        true
    }

    fn close(&self, a: f64, b: f64) -> bool {
        let room = self
            .rounding
            .unwrap_or(1e-9 * a.abs().max(b.abs()).max(1e-12));
        (a - b).abs() <= room
    }
}

/// A value in fractions, where no power is so high that it would be long.
fn bounded(e: &Expr, point: &Point<Rational>) -> Option<Rational> {
    let mut tame = true;
    e.walk(&mut |part| {
        if let Node::Power(_, k) = part.node() {
            tame &= k
                .as_number()
                .is_some_and(|k| k.numer().as_i64().is_some_and(|k| k.abs() <= 64));
        }
    });
    tame.then(|| e.evaluate(point)).flatten()
}

/// What is asked, in the motion a slip leads to.
pub(super) fn doubles(written: &Written, slip: &Slip, point: &Point<f64>) -> Option<Vec<f64>> {
    if slip.changes.iter().any(|c| matches!(c, Change::EnergyKept)) {
        return energy_kept(written, slip, point);
    }
    outcome(written, slip, point, |system| {
        numeric::solve_f64(system).ok()
    })
}

fn fractions(written: &Written, slip: &Slip, point: &Point<Rational>) -> Option<Vec<Rational>> {
    if slip.changes.iter().any(|c| matches!(c, Change::EnergyKept)) {
        return None;
    }
    outcome(written, slip, point, |system| {
        numeric::solve_exact(system).ok()
    })
}

fn outcome<T: Number>(
    written: &Written,
    slip: &Slip,
    point: &Point<T>,
    solve: impl Fn(&System<T>) -> Option<Solution<T>>,
) -> Option<Vec<T>> {
    let given = numeric::given(&slip.scene, point).ok()?;
    let mut system = numeric::assemble(&given);
    for change in &slip.changes {
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
    let mut ask = written.ask.clone();
    for change in &slip.changes {
        match change {
            Change::NoRotationEnergy | Change::NoTranslationEnergy => {
                let Ask::Energy { when, of } = &ask else {
                    return None;
                };
                return energies(change, *when, *of, &given, motion).map(|e| vec![e]);
            }
            Change::PointIsCenter => match &mut ask {
                Ask::Velocity {
                    point: at @ Some(_),
                    ..
                } => *at = None,
                _ => return None,
            },
            _ => {}
        }
    }
    // Impulses of hinges that the belief removed have no value.
    if let Ask::Impulse {
        from: ImpulseAt::Hinge(h),
        ..
    } = &ask
        && slip.scene.hinges.len() != written.scene.hinges.len()
    {
        let _ = h;
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
    use numeric::Law;
    let n = system.unknowns.len();
    let row_of = |system: &System<T>, law: Law| system.laws.iter().position(|l| *l == law);
    let set =
        |system: &mut System<T>, row: usize, entries: &[(Unknown, T)], right: T| -> Option<()> {
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
        };
    match change {
        Change::MomentsIgnored {
            bodies,
            about,
            instead,
        } => {
            let o = [about[0].evaluate(point)?, about[1].evaluate(point)?];
            let row = row_of(system, Law::AngularMomentum(*instead))?;
            let mut entries = Vec::new();
            let mut right = T::zero();
            for &b in bodies {
                let body = &given.bodies[b];
                let r = [body.center[0].minus(&o[0]), body.center[1].minus(&o[1])];
                let m = &body.mass;
                entries.push((Unknown::VelocityX(b), m.times(&r[1]).negated()));
                entries.push((Unknown::VelocityY(b), m.times(&r[0])));
                right = right.plus(
                    &m.times(
                        &r[0]
                            .times(&body.velocity[1])
                            .minus(&r[1].times(&body.velocity[0])),
                    ),
                );
                if body.freedom == numeric::given::Freedom::Rigid {
                    entries.push((Unknown::Spin(b), body.inertia.clone()));
                    right = right.plus(&body.inertia.times(&body.spin));
                }
            }
            set(system, row, &entries, right)
        }
        Change::NoHingeImpulse {
            hinge,
            axis,
            instead,
        } => {
            let row = row_of(system, Law::AngularMomentum(*instead))?;
            let unknown = if *axis == 0 {
                Unknown::HingeX(*hinge)
            } else {
                Unknown::HingeY(*hinge)
            };
            set(system, row, &[(unknown, T::one())], T::zero())
        }
        Change::NoContactImpulse {
            contact,
            axis,
            instead,
        } => {
            let row = row_of(system, Law::AngularMomentum(*instead))?;
            let unknown = if *axis == 0 {
                Unknown::ContactX(*contact)
            } else {
                Unknown::ContactY(*contact)
            };
            set(system, row, &[(unknown, T::one())], T::zero())
        }
        Change::CentersBounce(c) => {
            let contact = &given.contacts[*c];
            let normal = contact.normal.clone()?;
            let numeric::given::GivenLaw::Frictionless(e) = &contact.law else {
                return None;
            };
            let row = row_of(system, Law::Restitution(*c))?;
            let mut entries = Vec::new();
            let mut right = T::zero();
            for (sign, b) in [
                (T::one().negated(), contact.joint.bodies[0]),
                (T::one(), contact.joint.bodies[1]),
            ] {
                let body = &given.bodies[b];
                let before = numeric::number::dot(&body.velocity, &normal).times(&sign);
                right = right.minus(&e.times(&before));
                if body.freedom == numeric::given::Freedom::Fixed {
                    right = right.minus(&before);
                } else {
                    entries.push((Unknown::VelocityX(b), normal[0].times(&sign)));
                    entries.push((Unknown::VelocityY(b), normal[1].times(&sign)));
                }
            }
            set(system, row, &entries, right)
        }
        Change::WholeBounce { contact, body } => {
            let numeric::given::GivenLaw::Frictionless(e) = &given.contacts[*contact].law else {
                return None;
            };
            let velocity = given.bodies[*body].velocity.clone();
            let [x, y] = velocity.map(|v| v.times(e).negated());
            // The impulse follows from the momentum along the normal; the balances of the body give way.
            let normal = given.contacts[*contact].normal.clone()?;
            let m = given.bodies[*body].mass.clone();
            let first = given.contacts[*contact].joint.bodies[0] == *body;
            let change = numeric::number::dot(
                &[
                    x.minus(&given.bodies[*body].velocity[0]),
                    y.minus(&given.bodies[*body].velocity[1]),
                ],
                &normal,
            );
            let impulse = if first {
                m.times(&change).negated()
            } else {
                m.times(&change)
            };
            let rows = [
                Law::MomentumX(*body),
                Law::MomentumY(*body),
                Law::Restitution(*contact),
            ]
            .map(|law| row_of(system, law));
            set(
                system,
                rows[0]?,
                &[(Unknown::VelocityX(*body), T::one())],
                x,
            )?;
            set(
                system,
                rows[1]?,
                &[(Unknown::VelocityY(*body), T::one())],
                y,
            )?;
            set(
                system,
                rows[2]?,
                &[(Unknown::ContactNormal(*contact), T::one())],
                impulse,
            )
        }
        Change::EnergyKept => None,
        Change::NoRotationEnergy | Change::NoTranslationEnergy | Change::PointIsCenter => Some(()),
    }
}

/// The motion with the joints' one freedom and the energy before.
fn energy_kept(written: &Written, slip: &Slip, point: &Point<f64>) -> Option<Vec<f64>> {
    let given = numeric::given(&slip.scene, point).ok()?;
    if given.known.iter().any(|_| true) {
        return None;
    }
    let mut system = numeric::assemble(&given);
    let velocity = |u: &Unknown| {
        matches!(
            u,
            Unknown::VelocityX(_) | Unknown::VelocityY(_) | Unknown::Spin(_)
        )
    };
    let n = system.unknowns.len();
    // The shape of the motion: what the laws themselves give, which has the joints' freedom.
    let real = numeric::solve_f64(&system).ok()?;
    let kinematic: Vec<usize> = (0..system.laws.len())
        .filter(|i| {
            use numeric::Law::*;
            matches!(
                system.laws[*i],
                HingeX(_) | HingeY(_) | StickingX(_) | StickingY(_)
            )
        })
        .collect();
    let columns: Vec<usize> = (0..n).filter(|c| velocity(&system.unknowns[*c])).collect();
    let matrix =
        nalgebra::DMatrix::from_fn(kinematic.len().max(columns.len()), columns.len(), |i, j| {
            kinematic
                .get(i)
                .map_or(0.0, |row| system.matrix[row * n + columns[j]])
        });
    let singular = matrix.singular_values();
    let largest = singular.iter().copied().fold(0.0, f64::max);
    if singular.iter().filter(|s| **s <= 1e-10 * largest).count() != 1 {
        return None;
    }
    let mut solution = real;
    let motion = numeric::motion(&given, &system, &solution);
    let (before, after) = (
        numeric::energy_before(&given, None),
        numeric::energy_after(&given, &motion, None),
    );
    if after <= 0.0 || !before.is_finite() {
        return None;
    }
    let scale = (before / after).sqrt();
    solution.values.iter_mut().for_each(|v| *v *= scale);
    system.right.iter_mut().for_each(|v| *v *= scale);
    // Impulses do not scale with the motion.
    if matches!(written.ask, Ask::Impulse { .. }) {
        return None;
    }
    let motion = numeric::motion(&given, &system, &solution);
    if let Ask::Energy {
        when: EnergyWhen::Lost,
        of: None,
    } = written.ask
    {
        return Some(vec![0.0]);
    }
    read_off(written, slip, point, given, &motion)
}

/// Other quantities of the scene that the answer would be right for, in words.
pub fn other_quantities(written: &Written) -> Vec<Diagnosis> {
    let Some(trials) = trials(written) else {
        return Vec::new();
    };
    let scene = written.scene;
    let mut asks: Vec<(Ask, String)> = Vec::new();
    for (b, body) in scene
        .bodies
        .iter()
        .enumerate()
        .filter(|(_, b)| !b.is_fixed())
    {
        asks.push((
            Ask::Velocity {
                body: b,
                point: None,
                along: None,
            },
            format!("velocity of the center of {}", body.name),
        ));
        if !body.is_particle() {
            asks.push((
                Ask::Spin {
                    body: b,
                    clockwise: false,
                },
                format!("spin of {}, counterclockwise", body.name),
            ));
            for p in &scene.points {
                let at = Some((p.name.clone(), p.at.clone()));
                asks.push((
                    Ask::Velocity {
                        body: b,
                        point: at,
                        along: None,
                    },
                    format!("velocity of {} moving with {}", p.name, body.name),
                ));
            }
        }
        for (when, words) in [
            (EnergyWhen::Before, "before"),
            (EnergyWhen::After, "after"),
            (EnergyWhen::Lost, "lost"),
        ] {
            asks.push((
                Ask::Energy { when, of: Some(b) },
                format!("energy of {} {words}", body.name),
            ));
        }
    }
    for (when, words) in [
        (EnergyWhen::Before, "before"),
        (EnergyWhen::After, "after"),
        (EnergyWhen::Lost, "lost"),
    ] {
        asks.push((
            Ask::Energy { when, of: None },
            format!("total kinetic energy {words}"),
        ));
    }
    for (i, c) in scene.contacts.iter().enumerate() {
        asks.push((
            Ask::Impulse {
                from: ImpulseAt::Contact(i),
                on: c.bodies[1],
                along: None,
            },
            format!("impulse at {}", c.name),
        ));
        if let Some(n) = &c.normal {
            let ask = Ask::Impulse {
                from: ImpulseAt::Contact(i),
                on: c.bodies[1],
                along: Some(n.clone()),
            };
            asks.push((ask, format!("normal impulse at {}", c.name)));
        }
    }
    for (i, h) in scene.hinges.iter().enumerate() {
        asks.push((
            Ask::Impulse {
                from: ImpulseAt::Hinge(i),
                on: h.bodies[1],
                along: None,
            },
            format!("impulse at {}", h.name),
        ));
    }
    let plain = Slip {
        scene: scene.clone(),
        changes: Vec::new(),
        place: String::new(),
    };
    let mut found = Vec::new();
    for (ask, words) in asks {
        let vector = matches!(
            ask,
            Ask::Velocity { along: None, .. } | Ask::Impulse { along: None, .. }
        );
        let components: Vec<Option<usize>> = match (vector, written.values.len()) {
            (true, 2) => vec![None],
            (true, _) => vec![Some(0), Some(1)],
            (false, 1) => vec![None],
            (false, _) => continue,
        };
        for component in components {
            for sign in [1, -1] {
                let values: Vec<Expr> = written
                    .values
                    .iter()
                    .map(|v| if sign < 0 { -v } else { v.clone() })
                    .collect();
                if values.iter().all(Expr::is_zero) {
                    continue;
                }
                let other = Written {
                    scene,
                    ask: &ask,
                    component,
                    values,
                    rounding: written.rounding,
                };
                let mirrored = trials.times(f64::from(sign));
                if mirrored.fits(&other, &plain) {
                    let axis = component.map_or("", |c| [" along x", " along y"][c]);
                    let minus = if sign < 0 {
                        ", with the opposite sign"
                    } else {
                        ""
                    };
                    let message = format!("this is the {words}{axis}{minus}");
                    found.push(Diagnosis::new(
                        "OTHER_QUANTITY",
                        message,
                        "this is right for another quantity: what is asked for?",
                    ));
                    break;
                }
            }
        }
        if found.len() >= 2 {
            break;
        }
    }
    found
}

/// Values of the parameters as expressions, for answers in numbers.
pub fn values(scene: &Scene) -> BTreeMap<Symbol, Expr> {
    scene
        .parameters
        .iter()
        .filter_map(|p| Some((p.name.clone(), p.value.clone()?)))
        .collect()
}
