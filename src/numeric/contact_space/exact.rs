//! The impulses and velocities after without any rounding, then the doubles nearest to them.
//!
//! Doubles are integers times powers of two. Each row of W P = r is multiplied by the masses and moments of inertia of its
//! two bodies, so that no division is left; every unknown is then one integer over another, and is rounded once.

use super::{Axis, Joint, joints, lines};
use crate::expr::Scalar;
use crate::numeric::dyadic::Dyadic;
use crate::numeric::exact::{Cramer, cramer};
use crate::numeric::given::{Freedom, Given, GivenImpulse, GivenLaw};
use crate::numeric::number::{Number, cross, difference, dot};

/// The double nearest to each unknown, in the order of [`crate::numeric::assemble`]; `None` for scenes not solved here,
/// dependent joints, massless bodies, and integers of more than 64·N bits.
pub fn nearest_doubles<const N: usize>(given: &Given<f64>) -> Option<Vec<f64>> {
    let count = lines(given)?;
    let given = given.map(|v| Dyadic::<N>::exact(*v));
    let bodies: Vec<Moved<N>> = given.bodies.iter().map(moved).collect();
    let pushes = pushes(&given)?;
    let lines = all_lines(&given, count)?;
    let (impulses, determinant) = impulses(&lines, &bodies, &pushes)?;
    let mut out = Vec::with_capacity(3 * bodies.len() + count);
    for (b, body) in given.bodies.iter().enumerate() {
        if body.freedom == Freedom::Fixed {
            continue;
        }
        // m v⁻ + J over m, everything times the determinant.
        let [mut x, mut y, mut moment] = pushes[b].map(|q| q.times(&determinant));
        for (line, impulse) in lines.iter().zip(&impulses) {
            for s in (0..2).filter(|s| line.bodies[*s] == b) {
                let impulse = if s == 0 { impulse.negated() } else { *impulse };
                x = x.plus(&line.along[0].times(&impulse));
                y = y.plus(&line.along[1].times(&impulse));
                moment = moment.plus(&line.lever[s].times(&impulse));
            }
        }
        let below = body.mass.times(&determinant);
        out.push(body.velocity[0].times(&below).plus(&x).over(&below)?);
        out.push(body.velocity[1].times(&below).plus(&y).over(&below)?);
        if body.freedom == Freedom::Rigid {
            let below = body.inertia.times(&determinant);
            out.push(body.spin.times(&below).plus(&moment).over(&below)?);
        }
    }
    for impulse in &impulses {
        out.push(impulse.over(&determinant)?);
    }
    Some(out)
}

/// Factors a body brings to its rows.
struct Moved<const N: usize> {
    freedom: Freedom,
    mass: Dyadic<N>,
    inertia: Dyadic<N>,
    /// m I, m for a particle, 1 for a fixed body.
    both: Dyadic<N>,
}

fn moved<const N: usize>(body: &crate::numeric::given::GivenBody<Dyadic<N>>) -> Moved<N> {
    let (mass, inertia) = match body.freedom {
        Freedom::Fixed => (Number::one(), Number::one()),
        Freedom::Particle => (body.mass, Number::one()),
        Freedom::Rigid => (body.mass, body.inertia),
    };
    Moved {
        freedom: body.freedom,
        mass,
        inertia,
        both: mass.times(&inertia),
    }
}

/// Impulse along x and y and its moment about the center, of all given blows on each body.
fn pushes<const N: usize>(given: &Given<Dyadic<N>>) -> Option<Vec<[Dyadic<N>; 3]>> {
    let mut pushes = vec![[Dyadic::zero(); 3]; given.bodies.len()];
    for blow in &given.blows {
        let GivenImpulse::Whole(impulse) = &blow.impulse else {
            return None;
        };
        let moment = cross(&given.bodies[blow.body].arm(&blow.at), impulse);
        let sum = &mut pushes[blow.body];
        for (sum, by) in sum.iter_mut().zip([&impulse[0], &impulse[1], &moment]) {
            *sum = sum.plus(by);
        }
    }
    Some(pushes)
}

/// One component of an impulse.
struct Line<const N: usize> {
    bodies: [usize; 2],
    along: [Dyadic<N>; 2],
    /// Moment of a unit impulse about each body's center.
    lever: [Dyadic<N>; 2],
    /// Minus the velocity to be made up for, blows aside.
    right: Dyadic<N>,
}

fn all_lines<const N: usize>(given: &Given<Dyadic<N>>, count: usize) -> Option<Vec<Line<N>>> {
    let mut lines = Vec::with_capacity(count);
    let (zero, one) = (Dyadic::zero(), <Dyadic<N> as Number>::one());
    for joint in joints(given) {
        let (bodies, at, contact) = match joint {
            Joint::Hinge(i) => (given.hinges[i].bodies, &given.hinges[i].at, None),
            Joint::Sticking(i) | Joint::Frictionless(i) => {
                let contact = &given.contacts[i];
                (contact.joint.bodies, &contact.joint.at, Some(contact))
            }
        };
        let sides = bodies.map(|b| &given.bodies[b]);
        let arms = sides.map(|b| b.arm(at));
        let velocities = sides.map(|b| b.velocity_before(at));
        let gap = difference(&velocities[1], &velocities[0]);
        for axis in joint.axes() {
            let along = match axis {
                Axis::X => [one, zero],
                Axis::Y => [zero, one],
                Axis::Normal => contact?.normal?,
            };
            let lever = match axis {
                Axis::X => arms.map(|arm| arm[1].negated()),
                Axis::Y => arms.map(|arm| arm[0]),
                Axis::Normal => arms.map(|arm| cross(&arm, &along)),
            };
            let mut before = match axis {
                Axis::X => gap[0],
                Axis::Y => gap[1],
                Axis::Normal => dot(&along, &gap),
            };
            if let Some(GivenLaw::Frictionless(e)) = contact.map(|c| &c.law) {
                before = before.times(&one.plus(e));
            }
            lines.push(Line {
                bodies,
                along,
                lever,
                right: before.negated(),
            });
        }
    }
    Some(lines)
}

/// The impulses as numerators over one determinant.
fn impulses<const N: usize>(
    lines: &[Line<N>],
    bodies: &[Moved<N>],
    pushes: &[[Dyadic<N>; 3]],
) -> Option<(Vec<Dyadic<N>>, Dyadic<N>)> {
    let mut cells = Vec::with_capacity(lines.len() * (lines.len() + 1));
    for line in lines {
        if line.bodies[0] == line.bodies[1] {
            return None;
        }
        let [one, two] = line.bodies.map(|b| &bodies[b]);
        // What is left of the row's factor without one mass, and without one moment of inertia.
        let rest = [
            [one.inertia.times(&two.both), one.mass.times(&two.both)],
            [two.inertia.times(&one.both), two.mass.times(&one.both)],
        ];
        let response = |s: usize, along: &[Dyadic<N>; 2], lever: &Dyadic<N>| {
            let body = &bodies[line.bodies[s]];
            let mut sum = Dyadic::zero();
            if body.freedom != Freedom::Fixed {
                sum = dot(&line.along, along).times(&rest[s][0]);
            }
            if body.freedom == Freedom::Rigid {
                sum = sum.plus(&line.lever[s].times(lever).times(&rest[s][1]));
            }
            sum
        };
        for other in lines {
            let mut cell = Dyadic::zero();
            for s in 0..2 {
                for t in (0..2).filter(|t| other.bodies[*t] == line.bodies[s]) {
                    let term = response(s, &other.along, &other.lever[t]);
                    cell = if s == t {
                        cell.plus(&term)
                    } else {
                        cell.minus(&term)
                    };
                }
            }
            cells.push(cell);
        }
        let mut right = line.right.times(&one.both.times(&two.both));
        for s in 0..2 {
            let [x, y, moment] = pushes[line.bodies[s]];
            let brought = response(s, &[x, y], &moment);
            right = if s == 0 {
                right.plus(&brought)
            } else {
                right.minus(&brought)
            };
        }
        cells.push(right);
    }
    match cells.as_slice() {
        [] => Some((Vec::new(), Number::one())),
        [w, right] => Some((vec![*right], *w)),
        [a, b, p, c, d, q] => {
            let cross = |a: &Dyadic<N>, d: &Dyadic<N>, b: &Dyadic<N>, c: &Dyadic<N>| {
                a.times(d).minus(&b.times(c))
            };
            Some((
                vec![cross(p, d, b, q), cross(a, q, p, c)],
                cross(a, d, b, c),
            ))
        }
        _ => match cramer(cells, lines.len(), lines.len())? {
            Cramer::Solved {
                numerators,
                determinant,
            } => Some((numerators, determinant)),
            Cramer::Singular => None,
        },
    }
}
