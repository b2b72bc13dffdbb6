//! The impulses and velocities after as balls, without allocation.
//!
//! W is symmetric and, with masses above zero, positive definite where the joints are independent: elimination needs no
//! choice of pivots, and one reciprocal per impulse component.

use super::{Axis, BODIES, Joint, LINES, joints, lines};
use crate::expr::Scalar;
use crate::numeric::ball::Ball;
use crate::numeric::given::{Freedom, Given, GivenBody, GivenImpulse, GivenLaw};
use crate::numeric::number::Number;

/// A number of the scene: a double taken as exact, or a ball.
pub trait Entry: Copy + Default {
    /// As a ball.
    fn ball(self) -> Ball;
    /// self − other.
    fn less(self, other: Self) -> Ball;
    /// self + ball.
    fn and(self, ball: Ball) -> Ball;
    /// Whether it is zero for sure.
    fn is_nothing(self) -> bool;
    /// self · ball.
    fn of(self, ball: Ball) -> Ball {
        match self.is_nothing() || Number::is_zero(&ball) {
            true => Ball::default(),
            false => self.scaled(ball),
        }
    }
    /// self · ball; no exact zero where one of them is.
    fn scaled(self, ball: Ball) -> Ball;
    /// self · other; no exact zero where one of them is.
    fn product(self, other: Self) -> Ball;
    /// 1/self.
    fn inverse(self) -> Option<Ball>;
}

impl Entry for f64 {
    #[inline(always)]
    fn ball(self) -> Ball {
        Ball::exact(self)
    }
    #[inline(always)]
    fn less(self, other: f64) -> Ball {
        Ball::sum(self, -other)
    }
    #[inline(always)]
    fn and(self, ball: Ball) -> Ball {
        ball.plus_double(self)
    }
    #[inline(always)]
    fn is_nothing(self) -> bool {
        self == 0.0
    }
    #[inline(always)]
    fn scaled(self, ball: Ball) -> Ball {
        ball.times_double(self)
    }
    #[inline(always)]
    fn product(self, other: f64) -> Ball {
        Ball::product(self, other)
    }
    #[inline(always)]
    fn inverse(self) -> Option<Ball> {
        (self != 0.0).then(|| Ball::inverse(self))
    }
}

impl Entry for Ball {
    #[inline(always)]
    fn ball(self) -> Ball {
        self
    }
    #[inline(always)]
    fn less(self, other: Ball) -> Ball {
        self.minus(&other)
    }
    #[inline(always)]
    fn and(self, ball: Ball) -> Ball {
        self.plus(&ball)
    }
    #[inline(always)]
    fn is_nothing(self) -> bool {
        Number::is_zero(&self)
    }
    #[inline(always)]
    fn scaled(self, ball: Ball) -> Ball {
        self.by(&ball)
    }
    #[inline(always)]
    fn product(self, other: Ball) -> Ball {
        self.by(&other)
    }
    #[inline(always)]
    fn inverse(self) -> Option<Ball> {
        self.recip()
    }
}

/// Gives every unknown to `each`, in the order of [`crate::numeric::assemble`]; `None` for scenes not solved here and for
/// masses or a W that may be zero, whatever was given before.
#[inline(always)]
pub fn enclosures<I: Entry>(given: &Given<I>, mut each: impl FnMut(Ball)) -> Option<()> {
    match lines(given)? {
        0 => solve::<I, 0>(given, &mut each),
        1 if given.blows.is_empty() => smooth(given, each),
        1 => solve::<I, 1>(given, &mut each),
        2 => solve::<I, 2>(given, &mut each),
        3 => solve::<I, 3>(given, &mut each),
        4 => solve::<I, 4>(given, &mut each),
        5 => solve::<I, 5>(given, &mut each),
        6 => solve::<I, 6>(given, &mut each),
        7 => solve::<I, 7>(given, &mut each),
        LINES => solve::<I, LINES>(given, &mut each),
        _ => None,
    }
}

/// One body at the contact: what a unit impulse along the normal does to it.
#[derive(Clone, Copy)]
struct Side {
    /// 1/m.
    mass: Ball,
    /// Moment about the center.
    lever: Ball,
    /// The spin it brings.
    turn: Ball,
    /// Whether the moment is nothing at all, for each term of it has a zero.
    central: bool,
}

/// One frictionless contact and nothing else: written out and without branches, for it is what one meets most. Zeros of
/// the geometry are seen to at the end.
#[inline(always)]
fn smooth<I: Entry>(given: &Given<I>, mut each: impl FnMut(Ball)) -> Option<()> {
    let contact = given.contacts.first()?;
    let (GivenLaw::Frictionless(e), Some([nx, ny])) = (&contact.law, contact.normal) else {
        return None;
    };
    let [first, second] = contact.joint.bodies;
    if first == second {
        return None;
    }
    let (one, two) = (given.bodies.get(first)?, given.bodies.get(second)?);
    let side = |body: &GivenBody<I>| {
        let [x, y] = arm(body, &contact.joint.at);
        let lever = ny.scaled(x).minus(&nx.scaled(y));
        let (mass, inertia) = match body.freedom {
            Freedom::Fixed => (Ball::default(), Ball::default()),
            Freedom::Particle => (body.mass.inverse()?, Ball::default()),
            Freedom::Rigid => (body.mass.inverse()?, body.inertia.inverse()?),
        };
        Some(Side {
            mass,
            lever,
            turn: lever.by(&inertia),
            central: (ny.is_nothing() || Number::is_zero(&x))
                && (nx.is_nothing() || Number::is_zero(&y)),
        })
    };
    let (left, right) = (side(one)?, side(two)?);
    let gap = |k: usize| two.velocity[k].less(one.velocity[k]);
    let turned = two
        .spin
        .scaled(right.lever)
        .minus(&one.spin.scaled(left.lever));
    let before = nx.scaled(gap(0)).plus(&ny.scaled(gap(1))).plus(&turned);
    let square = nx.product(nx).plus(&ny.product(ny));
    let turning = left.turn.by(&left.lever).plus(&right.turn.by(&right.lever));
    let w = left.mass.plus(&right.mass).by(&square).plus(&turning);
    let leave = before.by(&e.and(Ball::exact(1.0)));
    let impulse = leave.by(&w.recip()?).negated();
    let push = [nx.scaled(impulse), ny.scaled(impulse)];
    let after = |before: I, change: Ball, plus: bool, none: bool| match none {
        true => before.ball(),
        false => before.and(signed(change, plus)),
    };
    for (b, body) in given.bodies.iter().enumerate() {
        let plus = b == second;
        if !plus && b != first || body.freedom == Freedom::Fixed {
            rest(body, &mut each);
            continue;
        }
        let side = if plus { right } else { left };
        let [x, y] = body.velocity;
        each(after(x, push[0].by(&side.mass), plus, nx.is_nothing()));
        each(after(y, push[1].by(&side.mass), plus, ny.is_nothing()));
        if body.freedom == Freedom::Rigid {
            each(after(body.spin, impulse.by(&side.turn), plus, side.central));
        }
    }
    each(impulse);
    Some(())
}

/// A body that nothing happens to.
fn rest<I: Entry>(body: &GivenBody<I>, each: &mut impl FnMut(Ball)) {
    if body.freedom != Freedom::Fixed {
        body.velocity.iter().for_each(|v| each(v.ball()));
    }
    if body.freedom == Freedom::Rigid {
        each(body.spin.ball());
    }
}

/// What a body answers an impulse with.
#[derive(Clone, Copy, Default)]
struct Answer {
    /// 1/m; zero where it does not move.
    mass: Ball,
    /// 1/I; zero where it does not turn.
    inertia: Ball,
}

/// One component of an impulse.
#[derive(Clone, Copy, Default)]
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

/// Impulse along x and y, and change of spin.
type Change = [Ball; 3];

fn solve<I: Entry, const K: usize>(given: &Given<I>, each: &mut impl FnMut(Ball)) -> Option<()> {
    let mut answers = [Answer::default(); BODIES];
    for (answer, body) in answers.iter_mut().zip(&given.bodies) {
        if body.freedom != Freedom::Fixed {
            answer.mass = body.mass.inverse()?;
        }
        if body.freedom == Freedom::Rigid {
            answer.inertia = body.inertia.inverse()?;
        }
    }
    let mut lines = [Line::default(); K];
    fill(given, &answers, &mut lines)?;
    let impulses = eliminate(coupling(&lines, &answers), &lines)?;
    let mut pushes = [[Ball::default(); 2]; K];
    for k in 0..K {
        pushes[k] = push(&lines[k], impulses[k]);
    }
    for (b, body) in given.bodies.iter().enumerate() {
        if body.freedom == Freedom::Fixed {
            continue;
        }
        let mut change = blown(given, b, &answers[b])?;
        for k in 0..K {
            for s in 0..2 {
                if lines[k].bodies[s] == b {
                    let turn = lines[k].turn[s].times(&impulses[k]);
                    add(&mut change, [pushes[k][0], pushes[k][1], turn], s == 1);
                }
            }
        }
        for (before, push) in body.velocity.iter().zip(&change) {
            each(before.and(push.times(&answers[b].mass)));
        }
        if body.freedom == Freedom::Rigid {
            each(body.spin.and(change[2]));
        }
    }
    impulses.into_iter().for_each(each);
    Some(())
}

/// What the given blows bring to a body.
fn blown<I: Entry>(given: &Given<I>, body: usize, answer: &Answer) -> Option<Change> {
    let mut change = Change::default();
    for blow in given.blows.iter().filter(|blow| blow.body == body) {
        let GivenImpulse::Whole([x, y]) = blow.impulse else {
            return None;
        };
        let arm = arm(&given.bodies[body], &blow.at);
        let moment = y.of(arm[0]).minus(&x.of(arm[1]));
        let turn = moment.times(&answer.inertia);
        add(&mut change, [x.ball(), y.ball(), turn], true);
    }
    Some(change)
}

/// From the center of a body to a point; nothing for a particle.
#[inline(always)]
fn arm<I: Entry>(body: &GivenBody<I>, at: &[I; 2]) -> [Ball; 2] {
    match body.freedom {
        Freedom::Particle => [Ball::default(); 2],
        _ => [at[0].less(body.center[0]), at[1].less(body.center[1])],
    }
}

/// Adds what a body receives on the second side of a joint, takes it away on the first.
#[inline(always)]
fn add(change: &mut Change, by: Change, second: bool) {
    for (change, by) in change.iter_mut().zip(by) {
        *change = sum(*change, signed(by, second));
    }
}

#[inline(always)]
fn signed(value: Ball, plus: bool) -> Ball {
    if plus { value } else { value.negated() }
}

/// Every component with its levers and its right side.
#[inline(always)]
fn fill<I: Entry>(
    given: &Given<I>,
    answers: &[Answer; BODIES],
    lines: &mut [Line<I>],
) -> Option<()> {
    let mut lines = lines.iter_mut();
    for joint in joints(given) {
        let (bodies, at, normal, restitution) = match joint {
            Joint::Hinge(i) => (given.hinges[i].bodies, given.hinges[i].at, None, None),
            Joint::Sticking(i) => {
                let joint = &given.contacts[i].joint;
                (joint.bodies, joint.at, None, None)
            }
            Joint::Frictionless(i) => {
                let contact = &given.contacts[i];
                let GivenLaw::Frictionless(e) = contact.law else {
                    return None;
                };
                let joint = &contact.joint;
                (joint.bodies, joint.at, contact.normal, Some(e))
            }
        };
        let (one, two) = (&given.bodies[bodies[0]], &given.bodies[bodies[1]]);
        let arms = [arm(one, &at), arm(two, &at)];
        for &axis in joint.axes() {
            let line = lines.next()?;
            (line.bodies, line.axis) = (bodies, axis);
            line.normal = normal.unwrap_or_default();
            let n = line.normal;
            for s in 0..2 {
                line.lever[s] = match axis {
                    Axis::X => arms[s][1].negated(),
                    Axis::Y => arms[s][0],
                    Axis::Normal => n[1].of(arms[s][0]).minus(&n[0].of(arms[s][1])),
                };
                line.turn[s] = line.lever[s].times(&answers[bodies[s]].inertia);
            }
            let gap = |k: usize| two.velocity[k].less(one.velocity[k]);
            let mut before = match axis {
                Axis::X => gap(0),
                Axis::Y => gap(1),
                Axis::Normal => n[0].of(gap(0)).plus(&n[1].of(gap(1))),
            };
            let turned = two.spin.of(line.lever[1]);
            before = before.plus(&turned.minus(&one.spin.of(line.lever[0])));
            line.right = before.negated();
            if let Some(e) = restitution {
                line.right = line.right.times(&e.and(Ball::exact(1.0)));
            }
            if !given.blows.is_empty() {
                for s in 0..2 {
                    let answer = &answers[bodies[s]];
                    let brought = along(line, answer, &blown(given, bodies[s], answer)?, s);
                    line.right = line.right.plus(&signed(brought, s == 0));
                }
            }
        }
    }
    Some(())
}

/// Velocity along a component that blows have brought to one of its sides.
fn along<I: Entry>(line: &Line<I>, answer: &Answer, change: &Change, side: usize) -> Ball {
    let n = line.normal;
    let push = match line.axis {
        Axis::X => change[0],
        Axis::Y => change[1],
        Axis::Normal => n[0].of(change[0]).plus(&n[1].of(change[1])),
    };
    push.times(&answer.mass)
        .plus(&change[2].times(&line.lever[side]))
}

/// W, the upper half.
#[inline(always)]
fn coupling<I: Entry, const K: usize>(
    lines: &[Line<I>; K],
    answers: &[Answer; BODIES],
) -> [[Ball; K]; K] {
    let mut w = [[Ball::default(); K]; K];
    for k in 0..K {
        for l in k..K {
            w[k][l] = response(&lines[k], &lines[l], answers);
        }
    }
    w
}

/// The velocity along one component that a unit impulse along another brings.
#[inline(always)]
fn response<I: Entry>(one: &Line<I>, two: &Line<I>, answers: &[Answer; BODIES]) -> Ball {
    let mass = |s: usize| answers[one.bodies[s]].mass;
    let turn = |s: usize, t: usize| one.turn[s].times(&two.lever[t]);
    let (masses, turning) = if one.bodies == two.bodies {
        (mass(0).plus(&mass(1)), turn(0, 0).plus(&turn(1, 1)))
    } else {
        let (mut masses, mut turning) = (Ball::default(), Ball::default());
        for s in 0..2 {
            for t in (0..2).filter(|t| one.bodies[s] == two.bodies[*t]) {
                masses = sum(masses, signed(mass(s), s == t));
                turning = sum(turning, signed(turn(s, t), s == t));
            }
        }
        (masses, turning)
    };
    let (n, m) = (one.normal, two.normal);
    let masses = match (one.axis, two.axis) {
        (Axis::X, Axis::X) | (Axis::Y, Axis::Y) => masses,
        (Axis::X, Axis::Y) | (Axis::Y, Axis::X) => Ball::default(),
        (Axis::X, Axis::Normal) => m[0].of(masses),
        (Axis::Y, Axis::Normal) => m[1].of(masses),
        (Axis::Normal, Axis::X) => n[0].of(masses),
        (Axis::Normal, Axis::Y) => n[1].of(masses),
        (Axis::Normal, Axis::Normal) => masses.times(&n[0].product(m[0]).plus(&n[1].product(m[1]))),
    };
    sum(masses, turning)
}

/// The sum, as exact as can be where one of them is nothing.
#[inline(always)]
fn sum(a: Ball, b: Ball) -> Ball {
    match Number::is_zero(&a) {
        true => b,
        false => a.plus(&b),
    }
}

/// The impulses: elimination down the diagonal, then back.
#[inline(always)]
fn eliminate<I: Entry, const K: usize>(
    mut w: [[Ball; K]; K],
    lines: &[Line<I>; K],
) -> Option<[Ball; K]> {
    let mut right = [Ball::default(); K];
    for k in 0..K {
        right[k] = lines[k].right;
    }
    let mut inverses = [Ball::default(); K];
    for p in 0..K {
        inverses[p] = w[p][p].recip()?;
        for r in p + 1..K {
            if Number::is_zero(&w[p][r]) {
                continue;
            }
            let factor = w[p][r].times(&inverses[p]).negated();
            let line = w[p];
            for (cell, above) in w[r].iter_mut().zip(&line).skip(r) {
                if !Number::is_zero(above) {
                    *cell = sum(*cell, factor.times(above));
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

/// The impulse of a component along x and y.
#[inline(always)]
fn push<I: Entry>(line: &Line<I>, impulse: Ball) -> [Ball; 2] {
    match line.axis {
        Axis::X => [impulse, Ball::default()],
        Axis::Y => [Ball::default(), impulse],
        Axis::Normal => [line.normal[0].of(impulse), line.normal[1].of(impulse)],
    }
}
