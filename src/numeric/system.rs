//! From the numbers of a scene to its full system of linear equations, written from geometry alone.
//!
//! In: masses, positions, velocities before. Out: a row per law and a column per unknown. This module never reads an
//! equation from `laws`; that is why agreement between the two means something. Positions are frozen during the
//! collision and finite forces have no impulse. Signs: counterclockwise positive, impulses are those on the second body.

use super::given::{Freedom, Given, GivenImpulse, GivenLaw, Joint};
use crate::expr::arithmetic::{Number, cross, dot};

/// A component that the equations determine, or fail to. The indices are those of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Unknown {
    /// Component along x (0) or y (1) of the velocity of a body's center of mass just after [m/s].
    Velocity(usize, usize),
    /// Angular velocity of a body just after [rad/s].
    Spin(usize),
    /// Component along x (0) or y (1) of a hinge's impulse on its second body \[N s\].
    Hinge(usize, usize),
    /// Component along x (0) or y (1) of a contact's impulse on its second body \[N s\].
    Contact(usize, usize),
    /// A contact's impulse on its second body, along the normal \[N s\].
    ContactNormal(usize),
    /// Size of a blow along its direction \[N s\].
    Blow(usize),
}

impl Unknown {
    /// Whether it is a velocity or the spin of this body.
    pub fn is_motion_of(self, body: usize) -> bool {
        matches!(self, Unknown::Velocity(b, _) | Unknown::Spin(b) if b == body)
    }
}

/// Everything that a body's motion just after is made of.
pub fn motion_of(body: usize) -> [Unknown; 3] {
    [
        Unknown::Velocity(body, 0),
        Unknown::Velocity(body, 1),
        Unknown::Spin(body),
    ]
}

/// The law a row states. The indices are those of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Law {
    /// Momentum of a body along x (0) or y (1).
    Momentum(usize, usize),
    /// Angular momentum of a body about its center of mass.
    AngularMomentum(usize),
    /// Both bodies move alike along x (0) or y (1) at a hinge.
    Hinge(usize, usize),
    /// Both bodies move alike along x (0) or y (1) at a sticking contact.
    Sticking(usize, usize),
    /// Normal relative velocity after = −e × before, at a contact.
    Restitution(usize),
    /// Condition 0 or 1 of a contact, on its impulse and the relative velocity after.
    Condition(usize, usize),
    /// A value known just after.
    Known(usize),
}

/// Linear equations: for each row, Σ coefficient × unknown = right.
#[derive(Clone, Debug, PartialEq)]
pub struct System<T> {
    /// What the columns stand for.
    pub unknowns: Vec<Unknown>,
    /// What the rows state.
    pub laws: Vec<Law>,
    /// Coefficients, row after row.
    pub matrix: Vec<T>,
    /// Right-hand sides.
    pub right: Vec<T>,
}

impl<T> System<T> {
    /// Coefficients of one row.
    pub fn row(&self, row: usize) -> &[T] {
        let n = self.unknowns.len();
        &self.matrix[row * n..(row + 1) * n]
    }

    /// Column of an unknown.
    pub fn column(&self, unknown: Unknown) -> Option<usize> {
        self.unknowns.iter().position(|u| *u == unknown)
    }

    /// The same equations with every number converted.
    pub fn map<U>(&self, mut f: impl FnMut(&T) -> U) -> System<U> {
        System {
            unknowns: self.unknowns.clone(),
            laws: self.laws.clone(),
            matrix: self.matrix.iter().map(&mut f).collect(),
            right: self.right.iter().map(f).collect(),
        }
    }
}

/// The full system of a scene.
pub fn assemble<T: Number>(given: &Given<T>) -> System<T> {
    let columns = Columns::of(given);
    // A square system is what to expect.
    let n = columns.unknowns.len();
    let mut rows = Rows {
        columns: n,
        laws: Vec::with_capacity(n),
        matrix: Vec::with_capacity(n * n),
        right: Vec::with_capacity(n),
    };
    balances(given, &columns, &mut rows);
    joints(given, &columns, &mut rows);
    for (i, known) in given.known.iter().enumerate() {
        let row = rows.start(Law::Known(i));
        match &known.component {
            None => rows.add_spin(row, &columns, given, known.body, &T::one()),
            Some([point, along]) => {
                rows.add_velocity(row, &columns, given, known.body, point, along);
                if let Some(to) = known.to {
                    let back = along.each_ref().map(T::negated);
                    rows.add_velocity(row, &columns, given, to, point, &back);
                }
            }
        }
        rows.right[row] = rows.right[row].plus(&known.value);
    }
    System {
        unknowns: columns.unknowns,
        laws: rows.laws,
        matrix: rows.matrix,
        right: rows.right,
    }
}

/// What the columns of the full system stand for, in order.
pub fn unknowns<T>(given: &Given<T>, into: &mut Vec<Unknown>) {
    into.clear();
    for (i, body) in given.bodies.iter().enumerate() {
        let all = motion_of(i);
        into.extend_from_slice(match body.freedom {
            Freedom::Fixed => &[],
            Freedom::Particle => &all[..2],
            Freedom::Rigid => &all,
        });
    }
    for i in 0..given.hinges.len() {
        into.extend([Unknown::Hinge(i, 0), Unknown::Hinge(i, 1)]);
    }
    for (i, contact) in given.contacts.iter().enumerate() {
        match contact.law {
            GivenLaw::Frictionless(_) => into.push(Unknown::ContactNormal(i)),
            _ => into.extend([Unknown::Contact(i, 0), Unknown::Contact(i, 1)]),
        }
    }
    let sizes = given.blows.iter().enumerate();
    let open = sizes.filter(|(_, blow)| matches!(blow.impulse, GivenImpulse::Along(_)));
    into.extend(open.map(|(i, _)| Unknown::Blow(i)));
}

/// Momentum and angular momentum of every free body.
fn balances<T: Number>(given: &Given<T>, columns: &Columns, rows: &mut Rows<T>) {
    let mut first_row = vec![None; given.bodies.len()];
    for (i, body) in given.bodies.iter().enumerate() {
        let Some(column) = columns.body[i] else {
            continue;
        };
        first_row[i] = Some(rows.laws.len());
        for axis in 0..2 {
            let row = rows.start(Law::Momentum(i, axis));
            rows.put(row, column + axis, body.mass.clone());
            rows.right[row] = body.mass.times(&body.velocity[axis]);
        }
        if body.freedom == Freedom::Rigid {
            let turn = rows.start(Law::AngularMomentum(i));
            rows.put(turn, column + 2, body.inertia.clone());
            rows.right[turn] = body.inertia.times(&body.spin);
        }
    }
    let [ex, ey] = [[T::one(), T::zero()], [T::zero(), T::one()]];
    // An unknown impulse goes to the left side: m v⁺ − J = m v⁻.
    let mut push =
        |body: usize, at: &[T; 2], direction: &[T; 2], column: usize, on_second: bool| {
            let Some(row) = first_row[body] else { return };
            let sign = |v: T| if on_second { v.negated() } else { v };
            rows.add(row, column, &sign(direction[0].clone()));
            rows.add(row + 1, column, &sign(direction[1].clone()));
            if given.bodies[body].freedom == Freedom::Rigid {
                let lever = cross(&given.bodies[body].arm(at), direction);
                rows.add(row + 2, column, &sign(lever));
            }
        };
    for (i, hinge) in given.hinges.iter().enumerate() {
        for (body, on_second) in [(hinge.bodies[0], false), (hinge.bodies[1], true)] {
            push(body, &hinge.at, &ex, columns.hinge[i], on_second);
            push(body, &hinge.at, &ey, columns.hinge[i] + 1, on_second);
        }
    }
    for (contact, column) in given.contacts.iter().zip(&columns.contact) {
        let Joint { bodies, at } = &contact.joint;
        for (body, on_second) in [(bodies[0], false), (bodies[1], true)] {
            match (&contact.law, &contact.normal) {
                (GivenLaw::Frictionless(_), Some(n)) => push(body, at, n, *column, on_second),
                _ => {
                    push(body, at, &ex, *column, on_second);
                    push(body, at, &ey, column + 1, on_second);
                }
            }
        }
    }
    for (blow, column) in given.blows.iter().zip(&columns.blow) {
        if let (GivenImpulse::Along(direction), Some(column)) = (&blow.impulse, column) {
            push(blow.body, &blow.at, direction, *column, true);
        }
    }
    for blow in &given.blows {
        if let (GivenImpulse::Whole(impulse), Some(row)) = (&blow.impulse, first_row[blow.body]) {
            rows.right[row] = rows.right[row].plus(&impulse[0]);
            rows.right[row + 1] = rows.right[row + 1].plus(&impulse[1]);
            if given.bodies[blow.body].freedom == Freedom::Rigid {
                let moment = cross(&given.bodies[blow.body].arm(&blow.at), impulse);
                rows.right[row + 2] = rows.right[row + 2].plus(&moment);
            }
        }
    }
}

/// What hinges and contacts say of the velocities after.
fn joints<T: Number>(given: &Given<T>, columns: &Columns, rows: &mut Rows<T>) {
    let [ex, ey] = [[T::one(), T::zero()], [T::zero(), T::one()]];
    let relative =
        |rows: &mut Rows<T>, law: Law, [one, two]: [usize; 2], at: &[T; 2], along: &[T; 2]| {
            let row = rows.start(law);
            rows.add_velocity(row, columns, given, two, at, along);
            let back = along.each_ref().map(T::negated);
            rows.add_velocity(row, columns, given, one, at, &back);
            row
        };
    for (i, hinge) in given.hinges.iter().enumerate() {
        relative(rows, Law::Hinge(i, 0), hinge.bodies, &hinge.at, &ex);
        relative(rows, Law::Hinge(i, 1), hinge.bodies, &hinge.at, &ey);
    }
    for (i, contact) in given.contacts.iter().enumerate() {
        let (bodies, at) = (contact.joint.bodies, &contact.joint.at);
        match (&contact.law, &contact.normal) {
            (GivenLaw::Sticking, _) => {
                relative(rows, Law::Sticking(i, 0), bodies, at, &ex);
                relative(rows, Law::Sticking(i, 1), bodies, at, &ey);
            }
            (GivenLaw::Frictionless(e), Some(n)) => {
                let row = relative(rows, Law::Restitution(i), bodies, at, n);
                let [one, two] = bodies.map(|b| given.bodies[b].velocity_before(at));
                let before = dot(n, &two).minus(&dot(n, &one));
                rows.right[row] = rows.right[row].minus(&e.times(&before));
            }
            (GivenLaw::Conditions(both), _) => {
                for (k, condition) in both.iter().enumerate() {
                    let law = Law::Condition(i, k);
                    let row = relative(rows, law, bodies, at, &condition.velocity);
                    for (axis, factor) in condition.impulse.iter().enumerate() {
                        rows.add(row, columns.contact[i] + axis, factor);
                    }
                    rows.right[row] = rows.right[row].plus(&condition.right);
                }
            }
            _ => {}
        }
    }
}

/// Where the unknowns of each body and joint stand.
struct Columns {
    unknowns: Vec<Unknown>,
    body: Vec<Option<usize>>,
    hinge: Vec<usize>,
    contact: Vec<usize>,
    blow: Vec<Option<usize>>,
}

impl Columns {
    fn of<T>(given: &Given<T>) -> Columns {
        let mut names = Vec::with_capacity(3 * given.bodies.len() + 8);
        unknowns(given, &mut names);
        let mut next = 0;
        let mut take = |count: usize| {
            next += count;
            next - count
        };
        let body = given.bodies.iter().map(|body| match body.freedom {
            Freedom::Fixed => None,
            Freedom::Particle => Some(take(2)),
            Freedom::Rigid => Some(take(3)),
        });
        let body = body.collect();
        let hinge = given.hinges.iter().map(|_| take(2)).collect();
        let contact = given.contacts.iter().map(|contact| match contact.law {
            GivenLaw::Frictionless(_) => take(1),
            _ => take(2),
        });
        let contact = contact.collect();
        let blow = given.blows.iter().map(|blow| match blow.impulse {
            GivenImpulse::Whole(_) => None,
            GivenImpulse::Along(_) => Some(take(1)),
        });
        let blow = blow.collect();
        Columns {
            unknowns: names,
            body,
            hinge,
            contact,
            blow,
        }
    }
}

/// Rows under construction.
struct Rows<T> {
    columns: usize,
    laws: Vec<Law>,
    matrix: Vec<T>,
    right: Vec<T>,
}

impl<T: Number> Rows<T> {
    /// A new empty row 0 = 0.
    fn start(&mut self, law: Law) -> usize {
        self.laws.push(law);
        self.matrix
            .resize(self.matrix.len() + self.columns, T::zero());
        self.right.push(T::zero());
        self.laws.len() - 1
    }

    fn put(&mut self, row: usize, column: usize, value: T) {
        self.matrix[row * self.columns + column] = value;
    }

    fn add(&mut self, row: usize, column: usize, value: &T) {
        let cell = &mut self.matrix[row * self.columns + column];
        *cell = match cell.is_zero() {
            true => value.clone(),
            false => cell.plus(value),
        };
    }

    /// Adds ω⁺ of a body, times `factor`, to the left side.
    fn add_spin(
        &mut self,
        row: usize,
        columns: &Columns,
        given: &Given<T>,
        body: usize,
        factor: &T,
    ) {
        match (given.bodies[body].freedom, columns.body[body]) {
            (Freedom::Rigid, Some(column)) => self.add(row, column + 2, factor),
            _ => self.right[row] = self.right[row].minus(&factor.times(&given.bodies[body].spin)),
        }
    }

    /// Adds the component along `along` of the velocity after of a body's point at `point` to the left side. What is
    /// prescribed goes to the right side.
    fn add_velocity(
        &mut self,
        row: usize,
        columns: &Columns,
        given: &Given<T>,
        body: usize,
        point: &[T; 2],
        along: &[T; 2],
    ) {
        let b = &given.bodies[body];
        match columns.body[body] {
            None => self.right[row] = self.right[row].minus(&dot(along, &b.velocity_before(point))),
            Some(column) => {
                self.add(row, column, &along[0]);
                self.add(row, column + 1, &along[1]);
                if b.freedom == Freedom::Rigid {
                    self.add(row, column + 2, &cross(&b.arm(point), along));
                }
            }
        }
    }
}
