//! What no single scene shows: the stiff limit, growth with the number of bodies, and points by the million.
//!
//! In: how much to measure. Out: the measurements of `stiff`, `growth` and `batch` side by side, with what they say of the
//! known findings. Told of every row as it finishes; stops when asked, and keeps what is done.

mod judge;

pub use judge::{millions, route_words};

use serde::Serialize;

use super::batch::{Doubling, Throughput, compile, doublings, quartiles, throughput};
use super::growth::{CROOKED, Chain, Growth, Pose, chain_scene, measure as measure_chain};
use super::measure::Machine;
use super::stiff::{
    Collision, Ground, Integrator, Limit, Order, Restitution, Run, StepCondition, Variables,
    conditions, limit, order, restitutions, run, usual_contacts,
};
use super::verdict::Finding;
use crate::derive::{self, Form};
use crate::expr::{Expr, Symbol};
use crate::scene;

/// How much to measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Extent {
    /// Seconds.
    Quick,
    /// A minute or two.
    Full,
}

/// Everything that does not hang on a scene.
#[derive(Clone, Debug, Serialize)]
pub struct Studies {
    /// How much was measured.
    pub extent: Extent,
    /// Machine and versions.
    pub machine: Machine,
    /// Compliant contact towards the rigid limit.
    pub stiff: Stiff,
    /// Derivations of chains.
    pub symbolic: Vec<Derived>,
    /// Numeric solutions of chains.
    pub numeric: Vec<Growth>,
    /// Points per second of one formula.
    pub batch: Option<Batch>,
    /// What is known, held against these numbers.
    pub findings: Vec<Finding>,
    /// Whether the measurement was stopped before its end.
    pub interrupted: bool,
}

/// The rod on compliant ground.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Stiff {
    /// Angle of the rod to the ground \[rad\].
    pub angle: f64,
    /// Every integrator in raw and scaled variables at every stiffness and tolerance.
    pub runs: Vec<Run>,
    /// Observed orders in K.
    pub orders: Vec<Order>,
    /// Richardson's limits.
    pub limits: Vec<Limit>,
    /// Dissipative contacts, formula against integration.
    pub restitution: Vec<Restitution>,
    /// Condition of the step matrix of a hinge kept as a constraint.
    pub step_matrix: Vec<StepCondition>,
}

/// Cost of one derivation.
#[derive(Clone, Debug, Serialize)]
pub struct Derived {
    /// Number of rods.
    pub rods: usize,
    /// Their angles.
    pub pose: Pose,
    /// Quartiles of the time from scene to closed forms \[s\].
    pub seconds: [f64; 3],
    /// Operations in the closed form of the struck rod's spin, equal parts counted once.
    pub operations: usize,
}

/// One formula at many points.
#[derive(Clone, Debug, Serialize)]
pub struct Batch {
    /// What it is.
    pub formula: &'static str,
    /// Operations of the compiled program.
    pub operations: usize,
    /// Inputs.
    pub inputs: usize,
    /// Largest relative difference from the hand-written function.
    pub difference: f64,
    /// The ways.
    pub rows: Vec<Throughput>,
    /// What a second thread brings, by the number of points.
    pub doublings: Vec<Doubling>,
}

/// Angle of the rod: an ordinary one.
const ANGLE: f64 = 0.7;
/// Steps after which an integration is given up.
const MOST_STEPS: usize = 20_000;

/// Measures everything. `row` is told what has been finished, in words, and says whether to go on.
pub fn measure(extent: Extent, mut row: impl FnMut(&str) -> bool) -> Studies {
    let mut studies = Studies {
        extent,
        machine: Machine::here(),
        stiff: Stiff {
            angle: ANGLE,
            ..Stiff::default()
        },
        symbolic: Vec::new(),
        numeric: Vec::new(),
        batch: None,
        findings: Vec::new(),
        interrupted: false,
    };
    studies.interrupted = !(stiff(&mut studies, &mut row)
        && symbolic(&mut studies, &mut row)
        && numeric(&mut studies, &mut row)
        && batch(&mut studies, &mut row));
    studies.findings = judge::findings(&studies);
    studies
}

fn is_quick(studies: &Studies) -> bool {
    studies.extent == Extent::Quick
}

/// Whether to go on.
fn stiff(studies: &mut Studies, row: &mut impl FnMut(&str) -> bool) -> bool {
    let powers = |step: usize| (2..=16).step_by(step).map(|k| 10_f64.powi(k));
    let quick = is_quick(studies);
    let step = if quick { 2 } else { 1 };
    // Error against run time is shown at one stiffness, cost over stiffness at one tolerance.
    let tolerances = |stiffness: f64| -> &[f64] {
        if quick && stiffness != 1e8 {
            &[1e-8]
        } else {
            &[1e-5, 1e-8, 1e-11]
        }
    };
    for exponent in [1.0, 1.5] {
        let stiffnesses: Vec<f64> = powers(1).filter(|k| (1e5..=1e14).contains(k)).collect();
        studies
            .stiff
            .orders
            .extend(order(ANGLE, exponent, &stiffnesses));
        studies.stiff.limits.extend(limit(ANGLE, exponent, 0.05, 9));
        if !row(&format!("orders and limit for p = {exponent}")) {
            return false;
        }
        for stiffness in powers(step) {
            for variables in [Variables::Raw, Variables::Scaled] {
                for integrator in Integrator::ALL {
                    for &tolerance in tolerances(stiffness) {
                        let collision = Collision {
                            angle: ANGLE,
                            ground: Ground::Smooth { exponent },
                            stiffness,
                            variables,
                        };
                        studies
                            .stiff
                            .runs
                            .push(run(collision, integrator, tolerance, MOST_STEPS));
                    }
                }
            }
            if !row(&format!("K = {stiffness:e}, p = {exponent}")) {
                return false;
            }
        }
    }
    // An end that spring and dashpot hold swings fast and decays: the truly stiff case.
    for stiffness in (2..=8).map(|k| 10_f64.powi(k)) {
        for integrator in Integrator::ALL {
            let collision = Collision {
                angle: ANGLE,
                ground: Ground::Grip,
                stiffness,
                variables: Variables::Raw,
            };
            studies
                .stiff
                .runs
                .push(run(collision, integrator, 1e-6, 50 * MOST_STEPS));
        }
        if !row(&format!("held end, K = {stiffness:e}")) {
            return false;
        }
    }
    studies.stiff.restitution = restitutions(&usual_contacts());
    let steps: Vec<f64> = (1..=8).map(|k| 10_f64.powi(-k)).collect();
    studies.stiff.step_matrix = conditions(ANGLE, 1.0, &steps).unwrap_or_default();
    row("restitution and step matrix")
}

fn symbolic(studies: &mut Studies, row: &mut impl FnMut(&str) -> bool) -> bool {
    let quick = is_quick(studies);
    let most = |pose| match (pose, quick) {
        (Pose::Straight, true) => 6,
        (Pose::Straight, false) => 10,
        (Pose::AnyAngles, true) => 3,
        (Pose::AnyAngles, false) => 5,
    };
    for pose in [Pose::Straight, Pose::AnyAngles] {
        for rods in 1..=most(pose) {
            let scene = chain_scene(rods, pose);
            let Ok(derivation) = derive::derive(&scene) else {
                continue;
            };
            let seconds = quartiles(if quick { 3 } else { 5 }, || {
                std::hint::black_box(derive::derive(&scene).is_ok());
            });
            let spin = derivation.answers.iter().find_map(|a| match &a.form {
                Form::Value { closed, .. } => shortest(&derivation, closed, closed, &[]),
                _ => None,
            });
            studies.symbolic.push(Derived {
                rods,
                pose,
                seconds,
                operations: spin.map_or(0, |(program, _)| program.operations()),
            });
            if !row(&format!("derivation of {rods} rods")) {
                return false;
            }
        }
    }
    true
}

fn numeric(studies: &mut Studies, row: &mut impl FnMut(&str) -> bool) -> bool {
    let (most, runs) = if is_quick(studies) { (4, 3) } else { (5, 5) };
    for exponent in 1..=most {
        let rods = 10_usize.pow(exponent);
        let chain = Chain::repeating(rods, &CROOKED, [0.5, 2.0]);
        studies.numeric.extend(measure_chain(&chain, runs));
        if !row(&format!("chain of {rods} rods")) {
            return false;
        }
    }
    true
}

/// The scene the batch takes its formula from, and its inputs in the order of [`by_hand`].
const TWO_BODIES: &str = include_str!("../../derivations/book/two-bodies-frictionless.json");
const INPUTS: [&str; 17] = [
    "m1", "m2", "I1", "I2", "x1", "y1", "x2", "y2", "nx", "ny", "u1x", "u1y", "u2x", "u2y", "w1",
    "w2", "e",
];

/// The impulse between two smooth bodies as somebody would program it from (17.57): −(1+e)u_n/(1/m₁+1/m₂+h₁²/I₁+h₂²/I₂).
fn by_hand(v: &[f64]) -> f64 {
    let &[
        m1,
        m2,
        i1,
        i2,
        x1,
        y1,
        x2,
        y2,
        nx,
        ny,
        u1x,
        u1y,
        u2x,
        u2y,
        w1,
        w2,
        e,
    ] = v
    else {
        return f64::NAN;
    };
    let (h1, h2) = (x1 * ny - y1 * nx, x2 * ny - y2 * nx);
    let approach = (u2x - u1x) * nx + (u2y - u1y) * ny + w2 * h2 - w1 * h1;
    -(1.0 + e) * approach / (1.0 / m1 + 1.0 / m2 + h1 * h1 / i1 + h2 * h2 / i2)
}

fn batch(studies: &mut Studies, row: &mut impl FnMut(&str) -> bool) -> bool {
    studies.batch = measure_batch(is_quick(studies));
    row("points per second")
}

/// Numbers of points at which one thread is held against two.
const SIZES: [usize; 6] = [1 << 10, 1 << 12, 1 << 14, 1 << 16, 1 << 18, 1 << 20];

fn measure_batch(quick: bool) -> Option<Batch> {
    let scene = scene::read(TWO_BODIES).ok()?;
    let derivation = derive::derive(&scene).ok()?;
    let answer = derivation.answers.iter().find(|a| a.name == "P")?;
    let Form::Value { closed, short } = &answer.form else {
        return None;
    };
    let (program, _) = shortest(&derivation, closed, short, &INPUTS)?;
    let points = if quick { 1 << 16 } else { 1 << 20 };
    let mut columns: Vec<Vec<f64>> = (0..INPUTS.len())
        .map(|i| {
            (0..points)
                .map(|k| 0.2 + ((k * (2 * i + 3)) % 1013) as f64 / 1013.0)
                .collect()
        })
        .collect();
    // The normal has length 1.
    let (nx, ny): (Vec<f64>, Vec<f64>) = columns[8]
        .iter()
        .map(|turn| (turn.cos(), turn.sin()))
        .unzip();
    (columns[8], columns[9]) = (nx, ny);
    let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let mut values = vec![0.0; points];
    program.eval_all(&columns, &mut values);
    let mut x = [0.0; INPUTS.len()];
    let difference = values
        .iter()
        .enumerate()
        .fold(0.0, |worst: f64, (k, value)| {
            x.iter_mut()
                .zip(&columns)
                .for_each(|(x, column)| *x = column[k]);
            let hand = by_hand(&x);
            worst.max((value - hand).abs() / hand.abs().max(1e-3))
        });
    let runs = if quick { 5 } else { 21 };
    let rows = throughput(&program, by_hand, &columns, &[1, 2], runs).ok()?;
    Some(Batch {
        formula: "impulse between two smooth bodies, (17.57)",
        operations: program.operations(),
        inputs: INPUTS.len(),
        difference,
        rows,
        doublings: doublings(&program, &columns, &SIZES, runs).ok()?,
    })
}

/// The form with fewer operations as a program, definitions put in; inputs in the order given, or all symbols there are.
fn shortest(
    derivation: &derive::Derivation,
    closed: &Expr,
    short: &Expr,
    inputs: &[&str],
) -> Option<(super::batch::Program, Vec<Symbol>)> {
    let mut known = std::collections::BTreeMap::<Symbol, Expr>::new();
    for d in &derivation.definitions {
        let value = d.value.substitute(&known);
        known.insert(d.name.clone(), value);
    }
    let forms = [closed, short].map(|e| e.substitute(&known));
    let programs = forms.iter().filter_map(|e| {
        let order: Vec<Symbol> = match inputs {
            [] => e.symbols().into_iter().collect(),
            list => list.iter().map(|s| Symbol::from(*s)).collect(),
        };
        Some((compile(e, &order).ok()?, order))
    });
    programs.min_by_key(|(p, _)| p.operations())
}
