//! The impulses and velocities after as balls, without allocation.
//!
//! W is symmetric and, with masses above zero, positive definite where the joints are independent: elimination needs no
//! choice of pivots, and one reciprocal per impulse component.

use super::{Axis, BODIES, Joint, LINES, joints, lines, unknowns};
use crate::expr::Scalar;
use crate::numeric::ball::Ball;
use crate::numeric::given::{Freedom, Given, GivenBody, GivenImpulse, GivenLaw};
use crate::numeric::number::Number;

/// A number of the scene: a double taken as exact, or a ball.
pub trait Entry: Copy {
    /// As a ball.
    fn ball(self) -> Ball;
    /// Whether it is zero for sure.
    fn is_zero(self) -> bool;
    /// self − other.
    fn less(self, other: Self) -> Ball;
    /// self + ball.
    fn and(self, ball: Ball) -> Ball;
    /// self · ball.
    fn of(self, ball: Ball) -> Ball;
    /// self · other.
    fn product(self, other: Self) -> Ball;
}

impl Entry for f64 {
    #[inline]
    fn ball(self) -> Ball {
        Ball::exact(self)
    }
    #[inline]
    fn is_zero(self) -> bool {
        self == 0.0
    }
    #[inline]
    fn less(self, other: f64) -> Ball {
        Ball::sum(self, -other)
    }
    #[inline]
    fn and(self, ball: Ball) -> Ball {
        ball.plus_double(self)
    }
    #[inline]
    fn of(self, ball: Ball) -> Ball {
        ball.times_double(self)
    }
    #[inline]
    fn product(self, other: f64) -> Ball {
        Ball::product(self, other)
    }
}

impl Entry for Ball {
    #[inline]
    fn ball(self) -> Ball {
        self
    }
    #[inline]
    fn is_zero(self) -> bool {
        Number::is_zero(&self)
    }
    #[inline]
    fn less(self, other: Ball) -> Ball {
        self.minus(&other)
    }
    #[inline]
    fn and(self, ball: Ball) -> Ball {
        self.plus(&ball)
    }
    #[inline]
    fn of(self, ball: Ball) -> Ball {
        self.times(&ball)
    }
    #[inline]
    fn product(self, other: Ball) -> Ball {
        self.times(&other)
    }
}

/// Every unknown, in the order of [`crate::numeric::assemble`], at the front of `out`, and their number; `None` for scenes not
/// solved here, for masses or a W that may be zero, and where `out` is too short.
pub fn enclosures<I: Entry>(given: &Given<I>, out: &mut [Ball]) -> Option<usize> {
    let count = lines(given)?;
    let out = out.get_mut(..unknowns(given, count))?;
    match count {
        0 => solve::<I, 0>(given, out),
        1 => solve::<I, 1>(given, out),
        2 => solve::<I, 2>(given, out),
        3 => solve::<I, 3>(given, out),
        4 => solve::<I, 4>(given, out),
        5 => solve::<I, 5>(given, out),
        6 => solve::<I, 6>(given, out),
        7 => solve::<I, 7>(given, out),
        LINES => solve::<I, LINES>(given, out),
        _ => None,
    }?;
    Some(out.len())
}

/// What a body answers an impulse with: 1/m and 1/I, zero where it does not move.
#[derive(Clone, Copy, Default)]
struct Answer {
    mass: Ball,
    inertia: Ball,
}

/// One component of an impulse.
#[derive(Clone, Copy)]
struct Line<I> {
    bodies: [usize; 2],
    axis: Axis,
    /// The normal; unused along x and y.
    normal: [I; 2],
    /// Moment of a unit impulse about each body's center.
    lever: [Ball; 2],
    /// The same over I: the spin it brings.
    turn: [Ball; 2],
    /// What the right side is: minus the velocity to be made up for.
    right: Ball,
}

fn solve<I: Entry, const K: usize>(given: &Given<I>, out: &mut [Ball]) -> Option<()> {
    let mut answers = [Answer::default(); BODIES];
    for (answer, body) in answers.iter_mut().zip(&given.bodies) {
        if body.freedom != Freedom::Fixed {
            answer.mass = body.mass.ball().recip()?;
        }
        if body.freedom == Freedom::Rigid {
            answer.inertia = body.inertia.ball().recip()?;
        }
    }
    let mut change = [[Ball::default(); 3]; BODIES];
    blows(given, &answers, &mut change)?;
    let impulses = match K {
        0 => [Ball::default(); K],
        _ => {
            let lines = all_lines::<I, K>(given, &answers, &change)?;
            let impulses = eliminate(coupling(&lines, &answers), &lines)?;
            for (line, impulse) in lines.iter().zip(&impulses) {
                push(line, impulse, &mut change);
            }
            impulses
        }
    };
    let (after, rest) = out.split_at_mut(out.len() - K);
    let mut after = after.iter_mut();
    for ((body, answer), change) in given.bodies.iter().zip(&answers).zip(&change) {
        if body.freedom == Freedom::Fixed {
            continue;
        }
        for (before, push) in body.velocity.iter().zip(change) {
            *after.next()? = before.and(push.times(&answer.mass));
        }
        if body.freedom == Freedom::Rigid {
            *after.next()? = body.spin.and(change[2]);
        }
    }
    rest.copy_from_slice(&impulses);
    Some(())
}

/// Impulse along x and y and change of spin of each body by the given blows.
fn blows<I: Entry>(
    given: &Given<I>,
    answers: &[Answer; BODIES],
    change: &mut [[Ball; 3]; BODIES],
) -> Option<()> {
    for blow in &given.blows {
        let GivenImpulse::Whole(impulse) = &blow.impulse else {
            return None;
        };
        let body = &given.bodies[blow.body];
        let arm = arm(body, &blow.at);
        let moment = impulse[1].of(arm[0]).minus(&impulse[0].of(arm[1]));
        let turn = moment.times(&answers[blow.body].inertia);
        let [x, y] = impulse.map(Entry::ball);
        add(&mut change[blow.body], [x, y, turn]);
    }
    Some(())
}

/// From the center of a body to a point; nothing for a particle.
#[inline]
fn arm<I: Entry>(body: &GivenBody<I>, at: &[I; 2]) -> [Ball; 2] {
    match body.freedom {
        Freedom::Particle => [Ball::default(); 2],
        _ => [at[0].less(body.center[0]), at[1].less(body.center[1])],
    }
}

#[inline]
fn add(sum: &mut [Ball; 3], by: [Ball; 3]) {
    for (sum, by) in sum.iter_mut().zip(by) {
        *sum = match Number::is_zero(sum) {
            true => by,
            false => sum.plus(&by),
        };
    }
}

/// Every component with its levers and its right side.
#[inline]
fn all_lines<I: Entry, const K: usize>(
    given: &Given<I>,
    answers: &[Answer; BODIES],
    change: &[[Ball; 3]; BODIES],
) -> Option<[Line<I>; K]> {
    let mut slots: [Option<Line<I>>; K] = [None; K];
    let mut free = slots.iter_mut();
    for joint in joints(given) {
        let (bodies, at, normal, restitution) = match joint {
            Joint::Hinge(i) => (given.hinges[i].bodies, given.hinges[i].at, None, None),
            Joint::Sticking(i) | Joint::Frictionless(i) => {
                let contact = &given.contacts[i];
                let restitution = match &contact.law {
                    GivenLaw::Frictionless(e) => Some(*e),
                    _ => None,
                };
                let normal = contact.normal.filter(|_| restitution.is_some());
                (contact.joint.bodies, contact.joint.at, normal, restitution)
            }
        };
        let [one, two] = bodies.map(|b| &given.bodies[b]);
        let arms = [arm(one, &at), arm(two, &at)];
        for &axis in joint.axes() {
            let normal = normal.unwrap_or(at);
            let lever = arms.map(|[x, y]| match axis {
                Axis::X => y.negated(),
                Axis::Y => x,
                Axis::Normal => normal[1].of(x).minus(&normal[0].of(y)),
            });
            let turn = [0, 1].map(|s| lever[s].times(&answers[bodies[s]].inertia));
            let gap = |k: usize| two.velocity[k].less(one.velocity[k]);
            let mut before = match axis {
                Axis::X => gap(0),
                Axis::Y => gap(1),
                Axis::Normal => normal[0].of(gap(0)).plus(&normal[1].of(gap(1))),
            };
            if !two.spin.is_zero() {
                before = before.plus(&two.spin.of(lever[1]));
            }
            if !one.spin.is_zero() {
                before = before.minus(&one.spin.of(lever[0]));
            }
            let mut line = Line {
                bodies,
                axis,
                normal,
                lever,
                turn,
                right: before.negated(),
            };
            if let Some(e) = restitution {
                line.right = line.right.times(&e.and(Ball::exact(1.0)));
            }
            if !given.blows.is_empty() {
                let [one, two] =
                    [0, 1].map(|s| along(&line, &answers[bodies[s]], &change[bodies[s]], s));
                line.right = line.right.minus(&two).plus(&one);
            }
            *free.next()? = Some(line);
        }
    }
    // Each joint has as many components as were counted.
    let mut filled = slots.iter().flatten();
    let first = *filled.next()?;
    let mut all = [first; K];
    for (slot, line) in all.iter_mut().zip(&slots) {
        *slot = (*line)?;
    }
    Some(all)
}

/// Velocity along a component that blows have brought to one of its sides.
fn along<I: Entry>(line: &Line<I>, answer: &Answer, change: &[Ball; 3], side: usize) -> Ball {
    let push = match line.axis {
        Axis::X => change[0],
        Axis::Y => change[1],
        Axis::Normal => line.normal[0]
            .of(change[0])
            .plus(&line.normal[1].of(change[1])),
    };
    push.times(&answer.mass)
        .plus(&change[2].times(&line.lever[side]))
}

/// W, the upper half.
#[inline]
fn coupling<I: Entry, const K: usize>(
    lines: &[Line<I>; K],
    answers: &[Answer; BODIES],
) -> [[Ball; K]; K] {
    let mut w = [[Ball::default(); K]; K];
    for (k, one) in lines.iter().enumerate() {
        for (l, two) in lines.iter().enumerate().skip(k) {
            let (mut masses, mut turning) = (Ball::default(), Ball::default());
            for s in 0..2 {
                for t in 0..2 {
                    if one.bodies[s] != two.bodies[t] {
                        continue;
                    }
                    let mass = answers[one.bodies[s]].mass;
                    let turn = one.turn[s].times(&two.lever[t]);
                    let signed = |v: Ball| if s == t { v } else { v.negated() };
                    masses = sum(masses, signed(mass));
                    turning = sum(turning, signed(turn));
                }
            }
            let masses = match (one.axis, two.axis) {
                (Axis::X, Axis::X) | (Axis::Y, Axis::Y) => masses,
                (Axis::X, Axis::Y) | (Axis::Y, Axis::X) => Ball::default(),
                (Axis::X, Axis::Normal) => two.normal[0].of(masses),
                (Axis::Y, Axis::Normal) => two.normal[1].of(masses),
                (Axis::Normal, Axis::X) => one.normal[0].of(masses),
                (Axis::Normal, Axis::Y) => one.normal[1].of(masses),
                (Axis::Normal, Axis::Normal) => {
                    let [x, y] = [0, 1].map(|i| one.normal[i].product(two.normal[i]));
                    masses.times(&x.plus(&y))
                }
            };
            w[k][l] = sum(masses, turning);
        }
    }
    w
}

#[inline]
fn sum(a: Ball, b: Ball) -> Ball {
    match (Number::is_zero(&a), Number::is_zero(&b)) {
        (true, _) => b,
        (_, true) => a,
        _ => a.plus(&b),
    }
}

/// The impulses: elimination down the diagonal, then back.
#[inline]
fn eliminate<I: Entry, const K: usize>(
    mut w: [[Ball; K]; K],
    lines: &[Line<I>; K],
) -> Option<[Ball; K]> {
    let mut right = [Ball::default(); K];
    for (right, line) in right.iter_mut().zip(lines) {
        *right = line.right;
    }
    let mut inverses = [Ball::default(); K];
    for p in 0..K {
        let row = w[p];
        inverses[p] = row[p].recip()?;
        for r in p + 1..K {
            if Number::is_zero(&row[r]) {
                continue;
            }
            let factor = row[r].times(&inverses[p]).negated();
            for c in r..K {
                if !Number::is_zero(&row[c]) {
                    w[r][c] = sum(w[r][c], factor.times(&row[c]));
                }
            }
            right[r] = sum(right[r], factor.times(&right[p]));
        }
    }
    for p in (0..K).rev() {
        for c in p + 1..K {
            right[p] = sum(right[p], w[p][c].times(&right[c]).negated());
        }
        right[p] = right[p].times(&inverses[p]);
    }
    Some(right)
}

/// Adds the impulse of a component to what each of its bodies receives.
#[inline]
fn push<I: Entry>(line: &Line<I>, impulse: &Ball, change: &mut [[Ball; 3]; BODIES]) {
    let none = Ball::default();
    let [x, y] = match line.axis {
        Axis::X => [*impulse, none],
        Axis::Y => [none, *impulse],
        Axis::Normal => line.normal.map(|n| n.of(*impulse)),
    };
    for (s, &body) in line.bodies.iter().enumerate() {
        let all = [x, y, line.turn[s].times(impulse)];
        let signed = if s == 0 {
            all.map(|v| v.negated())
        } else {
            all
        };
        add(&mut change[body], signed);
    }
}
