//! Two routes a person would take in doubles: coordinates that the joints leave free, and the effective mass.
//!
//! In: the numbers of a scene. Out: the motion after, by nalgebra's LU on the small system each way leads to. Not every
//! scene has them: unknown laws and values known after belong to the full system alone.

use nalgebra::{DMatrix, DVector};

use crate::numeric::given::{Freedom, GivenImpulse, GivenLaw};
use crate::numeric::{Given, Motion};

/// Whether every contact has a law and nothing is known but the motion before.
pub fn is_plain(given: &Given<f64>) -> bool {
    given.known.is_empty()
        && given
            .contacts
            .iter()
            .all(|c| !matches!(c.law, GivenLaw::None))
        && given
            .blows
            .iter()
            .all(|b| matches!(b.impulse, GivenImpulse::Whole(_)))
}

/// A condition on the motion after: relative velocity at a point along a direction equals `target`; its impulse.
struct Row {
    joint: Place,
    bodies: [usize; 2],
    at: [f64; 2],
    along: [f64; 2],
    target: f64,
}

#[derive(Clone, Copy, PartialEq)]
enum Place {
    Hinge(usize),
    Contact(usize),
}

fn cross(a: &[f64; 2], b: &[f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Conditions of one joint: two for hinges and sticking contacts, one for a frictionless one.
fn rows_of(given: &Given<f64>, place: Place) -> Vec<Row> {
    let (joint, law) = match place {
        Place::Hinge(h) => (&given.hinges[h], None),
        Place::Contact(c) => (&given.contacts[c].joint, Some(&given.contacts[c])),
    };
    let row = |along: [f64; 2], target: f64| Row {
        joint: place,
        bodies: joint.bodies,
        at: joint.at,
        along,
        target,
    };
    match law.map(|c| (&c.law, &c.normal)) {
        Some((GivenLaw::Frictionless(e), Some(n))) => {
            let [one, two] = joint
                .bodies
                .map(|b| given.bodies[b].velocity_before(&joint.at));
            let before = n[0] * (two[0] - one[0]) + n[1] * (two[1] - one[1]);
            vec![row(*n, -e * before)]
        }
        _ => vec![row([1.0, 0.0], 0.0), row([0.0, 1.0], 0.0)],
    }
}

fn places(given: &Given<f64>) -> Vec<Place> {
    let hinges = (0..given.hinges.len()).map(Place::Hinge);
    hinges
        .chain((0..given.contacts.len()).map(Place::Contact))
        .collect()
}

fn holds_velocity(given: &Given<f64>, place: Place) -> bool {
    match place {
        Place::Hinge(_) => true,
        Place::Contact(c) => matches!(given.contacts[c].law, GivenLaw::Sticking),
    }
}

/// Generalized velocity of each body, three rows a body: v_x, v_y, ω = matrix · q + rest.
struct Free {
    matrix: DMatrix<f64>,
    rest: DVector<f64>,
    /// Attachments in order, carriers first: body, joint.
    tree: Vec<(usize, Place)>,
    loops: Vec<Place>,
}

fn joint(given: &Given<f64>, place: Place) -> ([usize; 2], [f64; 2]) {
    let joint = match place {
        Place::Hinge(h) => &given.hinges[h],
        Place::Contact(c) => &given.contacts[c].joint,
    };
    (joint.bodies, joint.at)
}

fn free(given: &Given<f64>) -> Free {
    let count = given.bodies.len();
    let mut columns: Vec<DVector<f64>> = Vec::new();
    let mut rest = DVector::zeros(3 * count);
    let mut placed = vec![false; count];
    let (mut tree, mut used) = (Vec::new(), Vec::new());
    for (b, body) in given.bodies.iter().enumerate() {
        if body.freedom == Freedom::Fixed {
            placed[b] = true;
            rest[3 * b] = body.velocity[0];
            rest[3 * b + 1] = body.velocity[1];
            rest[3 * b + 2] = body.spin;
        }
    }
    let stiff: Vec<Place> = places(given)
        .into_iter()
        .filter(|p| holds_velocity(given, *p))
        .collect();
    loop {
        let next = stiff.iter().find_map(|place| {
            let (bodies, at) = joint(given, *place);
            let side = (0..2).find(|s| placed[bodies[*s]] && !placed[bodies[1 - s]])?;
            (!used.contains(place)).then_some((*place, bodies[side], bodies[1 - side], at))
        });
        if let Some((place, carrier, body, at)) = next {
            let (to, from) = (given.bodies[carrier].arm(&at), given.bodies[body].arm(&at));
            // Velocity of the joint by the carrier; the body's center follows from it and the body's own spin.
            for column in &mut columns {
                column[3 * body] = column[3 * carrier] - column[3 * carrier + 2] * to[1];
                column[3 * body + 1] = column[3 * carrier + 1] + column[3 * carrier + 2] * to[0];
            }
            rest[3 * body] = rest[3 * carrier] - rest[3 * carrier + 2] * to[1];
            rest[3 * body + 1] = rest[3 * carrier + 1] + rest[3 * carrier + 2] * to[0];
            if given.bodies[body].freedom == Freedom::Rigid {
                let mut own = DVector::zeros(3 * count);
                own[3 * body] = from[1];
                own[3 * body + 1] = -from[0];
                own[3 * body + 2] = 1.0;
                columns.push(own);
            }
            placed[body] = true;
            used.push(place);
            tree.push((body, place));
            continue;
        }
        let Some(root) = placed.iter().position(|p| !p) else {
            break;
        };
        placed[root] = true;
        let own = if given.bodies[root].freedom == Freedom::Rigid {
            3
        } else {
            2
        };
        for k in 0..own {
            let mut column = DVector::zeros(3 * count);
            column[3 * root + k] = 1.0;
            columns.push(column);
        }
    }
    let loops = places(given)
        .into_iter()
        .filter(|p| !used.contains(p))
        .collect();
    let matrix = if columns.is_empty() {
        DMatrix::zeros(3 * count, 0)
    } else {
        DMatrix::from_columns(&columns)
    };
    Free {
        matrix,
        rest,
        tree,
        loops,
    }
}

/// J of a condition: relative velocity = J · (velocities of all bodies).
fn gradient(given: &Given<f64>, row: &Row) -> DVector<f64> {
    let mut j = DVector::zeros(3 * given.bodies.len());
    for (body, sign) in [(row.bodies[0], -1.0), (row.bodies[1], 1.0)] {
        j[3 * body] += sign * row.along[0];
        j[3 * body + 1] += sign * row.along[1];
        j[3 * body + 2] += sign * cross(&given.bodies[body].arm(&row.at), &row.along);
    }
    j
}

/// M v⁻ + Q, M, v⁻; fixed bodies count as massless.
fn momenta(given: &Given<f64>) -> (DVector<f64>, DVector<f64>, DVector<f64>) {
    let n = 3 * given.bodies.len();
    let (mut mass, mut before, mut blow) =
        (DVector::zeros(n), DVector::zeros(n), DVector::zeros(n));
    for (b, body) in given.bodies.iter().enumerate() {
        before[3 * b] = body.velocity[0];
        before[3 * b + 1] = body.velocity[1];
        before[3 * b + 2] = body.spin;
        if body.freedom != Freedom::Fixed {
            mass[3 * b] = body.mass;
            mass[3 * b + 1] = body.mass;
            mass[3 * b + 2] = body.inertia;
        }
    }
    for b in &given.blows {
        if let GivenImpulse::Whole(q) = &b.impulse {
            blow[3 * b.body] += q[0];
            blow[3 * b.body + 1] += q[1];
            blow[3 * b.body + 2] += cross(&given.bodies[b.body].arm(&b.at), q);
        }
    }
    (mass.component_mul(&before) + blow, mass, before)
}

/// Angular momentum about the joints: unknowns are what hinges and sticking contacts leave free, so their impulses never
/// appear. `None` where nothing is jointed, or the small system is singular.
pub fn about_joints(given: &Given<f64>) -> Option<Motion<f64>> {
    let free = free(given);
    if free.tree.is_empty() || !is_plain(given) {
        return None;
    }
    let (momentum, mass, _) = momenta(given);
    let rows: Vec<Row> = free.loops.iter().flat_map(|p| rows_of(given, *p)).collect();
    let (q, l) = (free.matrix.ncols(), rows.len());
    let weighted = DMatrix::from_fn(free.matrix.nrows(), q, |r, c| mass[r] * free.matrix[(r, c)]);
    let small = free.matrix.transpose() * &weighted;
    let right = free.matrix.transpose() * (&momentum - mass.component_mul(&free.rest));
    let mut matrix = DMatrix::zeros(q + l, q + l);
    let mut known = DVector::zeros(q + l);
    matrix.view_mut((0, 0), (q, q)).copy_from(&small);
    known.rows_mut(0, q).copy_from(&right);
    for (k, row) in rows.iter().enumerate() {
        let j = gradient(given, row);
        let reduced = free.matrix.transpose() * &j;
        for c in 0..q {
            matrix[(q + k, c)] = reduced[c];
            matrix[(c, q + k)] = -reduced[c];
        }
        known[q + k] = row.target - j.dot(&free.rest);
    }
    let x = if q + l == 0 {
        known
    } else {
        matrix.lu().solve(&known)?
    };
    let after = &free.matrix * x.rows(0, q) + &free.rest;
    let mut motion = start(given, &after);
    // What each body still lacks in momentum came through the joint that carries it, leaves first.
    let mut lack = mass.component_mul(&after) - momentum;
    for (k, row) in rows.iter().enumerate() {
        add(&mut motion, row, x[q + k]);
        lack -= gradient(given, row) * x[q + k];
    }
    for (body, place) in free.tree.iter().rev() {
        let (bodies, at) = joint(given, *place);
        let felt = [lack[3 * body], lack[3 * body + 1]];
        let sign = if bodies[1] == *body { 1.0 } else { -1.0 };
        for (axis, along) in [[1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
            let row = Row {
                joint: *place,
                bodies,
                at,
                along,
                target: 0.0,
            };
            add(&mut motion, &row, sign * felt[axis]);
            lack -= gradient(given, &row) * (sign * felt[axis]);
        }
    }
    finite(motion)
}

/// Effective mass: impulses from J M⁻¹ Jᵀ P = u⁺ − u⁻, velocities from the impulses. `None` where a mass is zero.
pub fn effective_mass(given: &Given<f64>) -> Option<Motion<f64>> {
    let rows: Vec<Row> = places(given)
        .iter()
        .flat_map(|p| rows_of(given, *p))
        .collect();
    if rows.is_empty() || !is_plain(given) {
        return None;
    }
    let (momentum, mass, before) = momenta(given);
    let mut inverse = DVector::zeros(mass.len());
    for (b, body) in given.bodies.iter().enumerate() {
        let own = match body.freedom {
            Freedom::Fixed => 0,
            Freedom::Particle => 2,
            Freedom::Rigid => 3,
        };
        for k in 3 * b..3 * b + own {
            if mass[k] == 0.0 {
                return None;
            }
            inverse[k] = 1.0 / mass[k];
        }
    }
    let blow = momentum - mass.component_mul(&before);
    let free = &before + inverse.component_mul(&blow);
    let j: Vec<DVector<f64>> = rows.iter().map(|r| gradient(given, r)).collect();
    let n = rows.len();
    let w = DMatrix::from_fn(n, n, |a, b| j[a].dot(&inverse.component_mul(&j[b])));
    let gap = DVector::from_fn(n, |a, _| rows[a].target - j[a].dot(&free));
    let impulse = w.lu().solve(&gap)?;
    let mut after = free;
    for (k, j) in j.iter().enumerate() {
        after += inverse.component_mul(j) * impulse[k];
    }
    let mut motion = start(given, &after);
    for (row, p) in rows.iter().zip(impulse.iter()) {
        add(&mut motion, row, *p);
    }
    finite(motion)
}

fn start(given: &Given<f64>, after: &DVector<f64>) -> Motion<f64> {
    let count = given.bodies.len();
    Motion {
        velocity: (0..count)
            .map(|b| [after[3 * b], after[3 * b + 1]])
            .collect(),
        spin: (0..count).map(|b| after[3 * b + 2]).collect(),
        hinge: vec![[0.0; 2]; given.hinges.len()],
        contact: vec![[0.0; 2]; given.contacts.len()],
        blow: given
            .blows
            .iter()
            .map(|b| match &b.impulse {
                GivenImpulse::Whole(q) => *q,
                GivenImpulse::Along(_) => [0.0; 2],
            })
            .collect(),
        loose: Vec::new(),
    }
}

fn add(motion: &mut Motion<f64>, row: &Row, size: f64) {
    let to = match row.joint {
        Place::Hinge(h) => &mut motion.hinge[h],
        Place::Contact(c) => &mut motion.contact[c],
    };
    to[0] += size * row.along[0];
    to[1] += size * row.along[1];
}

fn finite(motion: Motion<f64>) -> Option<Motion<f64>> {
    let all = motion
        .velocity
        .iter()
        .flatten()
        .chain(&motion.spin)
        .chain(motion.hinge.iter().flatten());
    all.chain(motion.contact.iter().flatten())
        .all(|v| v.is_finite())
        .then_some(motion)
}
