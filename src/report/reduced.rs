//! Two routes a person would take in doubles, each a smaller system: coordinates that the joints leave free, and the
//! effective mass.
//!
//! In: the numbers of a scene and its full system. Out: the unknowns, by nalgebra's LU on the system each way leads to. In
//! the full system the momenta stand above the conditions of joints and contacts, velocities left of impulses:
//! M v + B P = p, J v + D P = u.

use nalgebra::{DMatrix, DVector};

use crate::numeric::given::Freedom;
use crate::numeric::{Given, Law, System, Unknown};

/// A system as a matrix, with the velocities of free bodies before.
struct Parts {
    matrix: DMatrix<f64>,
    right: DVector<f64>,
    before: DVector<f64>,
}

impl Parts {
    fn of(given: &Given<f64>, system: &System<f64>) -> Parts {
        let free = given.bodies.iter().flat_map(|b| {
            let [x, y] = b.velocity;
            let motion = [x, y, b.spin];
            let count = match b.freedom {
                Freedom::Fixed => 0,
                Freedom::Particle => 2,
                Freedom::Rigid => 3,
            };
            motion.into_iter().take(count)
        });
        let (rows, columns) = (system.laws.len(), system.unknowns.len());
        Parts {
            matrix: DMatrix::from_row_slice(rows, columns, &system.matrix),
            right: DVector::from_column_slice(&system.right),
            before: DVector::from_vec(free.collect()),
        }
    }

    fn picked(&self, rows: &[usize], columns: &[usize]) -> DMatrix<f64> {
        self.matrix.select_rows(rows).select_columns(columns)
    }
}

/// Effective mass: impulses from (D − J M⁻¹ B) P = u − J M⁻¹ p, velocities from the impulses. `None` where nothing acts or a
/// mass is zero.
pub fn effective_mass(given: &Given<f64>, system: &System<f64>) -> Option<Vec<f64>> {
    let parts = Parts::of(given, system);
    let (rows, columns) = parts.matrix.shape();
    let v = parts.before.len();
    let mass = parts.matrix.view((0, 0), (v, v)).diagonal();
    if rows != columns || columns == v || mass.iter().any(|m| *m == 0.0) {
        return None;
    }
    let per_mass = |of: DVector<f64>| of.component_div(&mass);
    let given = parts.right.rows(0, v) - mass.component_mul(&parts.before);
    let free = &parts.before + per_mass(given);
    let mut moved = parts.matrix.view((0, v), (v, columns - v)).clone_owned();
    for mut column in moved.column_iter_mut() {
        column.component_div_assign(&mass);
    }
    let conditions = parts.matrix.view((v, 0), (rows - v, v));
    let direct = parts.matrix.view((v, v), (rows - v, columns - v));
    let effective = direct - conditions * &moved;
    let gap = parts.right.rows(v, rows - v) - conditions * &free;
    let impulses = effective.lu().solve(&gap)?;
    let velocities = free - moved * &impulses;
    finite(velocities.iter().chain(impulses.iter()))
}

/// Where a joint that carries a body stands in the system: the first of its two conditions, the first velocity of the body,
/// the first component of the impulse. The second ones follow.
type Carrier = [usize; 3];

/// Joints that carry a body each, from fixed bodies and one body of each free group outwards.
fn carriers(given: &Given<f64>, system: &System<f64>) -> Option<Vec<Carrier>> {
    let joints = system.laws.iter().enumerate();
    let joints = joints.filter_map(|(row, law)| match *law {
        Law::Hinge(h, 0) => Some((row, given.hinges[h].bodies, Unknown::Hinge(h, 0))),
        Law::Sticking(c, 0) => Some((row, given.contacts[c].joint.bodies, Unknown::Contact(c, 0))),
        _ => None,
    });
    let joints: Vec<_> = joints.collect();
    let is_fixed = given.bodies.iter().map(|b| b.freedom == Freedom::Fixed);
    let mut placed: Vec<bool> = is_fixed.collect();
    let mut found = Vec::new();
    while let Some(root) = placed.iter().position(|p| !p) {
        let next = joints.iter().find_map(|(row, [a, b], impulse)| {
            let body = match (placed[*a], placed[*b]) {
                (true, false) => *b,
                (false, true) => *a,
                _ => return None,
            };
            Some((*row, body, *impulse))
        });
        let Some((row, body, impulse)) = next else {
            placed[root] = true;
            continue;
        };
        placed[body] = true;
        found.push([
            row,
            system.column(Unknown::Velocity(body, 0))?,
            system.column(impulse)?,
        ]);
    }
    Some(found)
}

/// Angular momentum about the joints: unknowns are the velocities that hinges and sticking contacts leave free, so that their
/// impulses appear nowhere. `None` where nothing is jointed, or the small system is singular.
pub fn about_joints(given: &Given<f64>, system: &System<f64>) -> Option<Vec<f64>> {
    let parts = Parts::of(given, system);
    let (rows, columns) = parts.matrix.shape();
    let v = parts.before.len();
    let carriers = carriers(given, system)?;
    if carriers.is_empty() || rows != columns {
        return None;
    }
    let both = |k: usize| carriers.iter().flat_map(move |c| [c[k], c[k] + 1]);
    let [joints, carried, held] = [0, 1, 2].map(|k| both(k).collect::<Vec<usize>>());
    let rest = |all: std::ops::Range<usize>, without: &[usize]| -> Vec<usize> {
        all.filter(|i| !without.contains(i)).collect()
    };
    let (free, other_rows) = (rest(0..v, &carried), rest(v..rows, &joints));
    let others = rest(v..columns, &held);
    // Velocities = basis · those left free + what fixed bodies lend them.
    let by_joints = parts.picked(&joints, &carried).lu();
    let follow = by_joints.solve(&parts.picked(&joints, &free))?;
    let lent = by_joints.solve(&parts.right.select_rows(&joints))?;
    let (q, l) = (free.len(), others.len());
    let mut basis = DMatrix::zeros(v, q);
    let mut start = DVector::zeros(v);
    for (k, column) in free.iter().enumerate() {
        basis[(*column, k)] = 1.0;
    }
    for (k, column) in carried.iter().enumerate() {
        basis.row_mut(*column).copy_from(&-follow.row(k));
        start[*column] = lent[k];
    }
    let all: Vec<usize> = (0..v).collect();
    let mass = parts.matrix.view((0, 0), (v, v)).diagonal();
    let mut weighted = basis.clone();
    for mut column in weighted.column_iter_mut() {
        column.component_mul_assign(&mass);
    }
    let acting = parts.picked(&all, &others);
    let conditions = parts.picked(&other_rows, &all);
    let momenta = parts.right.rows(0, v);
    let mut small = DMatrix::zeros(q + l, q + l);
    let turned = basis.transpose();
    for (at, block) in [
        ((0, 0), &turned * weighted),
        ((0, q), &turned * &acting),
        ((q, 0), &conditions * &basis),
        ((q, q), parts.picked(&other_rows, &others)),
    ] {
        small.view_mut(at, block.shape()).copy_from(&block);
    }
    let mut known = DVector::zeros(q + l);
    let lacking = &turned * (momenta - mass.component_mul(&start));
    known.rows_mut(0, q).copy_from(&lacking);
    let lacking = parts.right.select_rows(&other_rows) - &conditions * &start;
    known.rows_mut(q, l).copy_from(&lacking);
    if q + l > 0 {
        known = small.lu().solve(&known)?;
    }
    let velocities = basis * known.rows(0, q) + start;
    // What bodies still lack in momentum came through the joints that carry them.
    let lack = momenta - mass.component_mul(&velocities) - acting * known.rows(q, l);
    let through = parts.picked(&carried, &held).lu();
    let through = through.solve(&lack.select_rows(&carried))?;
    let mut found = vec![0.0; columns];
    found[..v].copy_from_slice(velocities.as_slice());
    let impulses = others.iter().zip(known.iter().skip(q));
    for (column, value) in impulses.chain(held.iter().zip(through.iter())) {
        found[*column] = *value;
    }
    finite(found.iter())
}

fn finite<'a>(values: impl Iterator<Item = &'a f64>) -> Option<Vec<f64>> {
    let values: Vec<f64> = values.copied().collect();
    values.iter().all(|v| v.is_finite()).then_some(values)
}
