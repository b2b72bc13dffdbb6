//! A scene with friction in numbers: what its contact feels is found by the full system, the impact is followed along its
//! path, and the impulse at its end takes the place of the law.
//!
//! In: the numbers of a scene and a solver. Out: the same numbers with the impulse known, and the path.

use super::energy::relative_velocities;
use super::given::{Given, GivenLaw, Joint};
use super::no_answer::NoAnswer;
use super::path::{Corner, Event, NoPath, Path, follow};
use super::solution::{Contradiction, Solution, motion};
use super::system::{System, Unknown, assemble};
use crate::expr::arithmetic::{Number, difference, dot, stretched, total};
use crate::scene::{Condition, ContactSpace, Hypothesis, Mode};

/// How an impact with friction went.
#[derive(Clone, Debug, PartialEq)]
pub struct Followed<T> {
    /// Index of the contact.
    pub contact: usize,
    /// What the contact feels.
    pub space: ContactSpace<T>,
    /// The path of its impulse.
    pub path: Path<T>,
}

/// A scene with the impulse of its contact with friction known, and the path that led there.
pub type Settled<T> = (Given<T>, Followed<T>);

/// The tangent of a contact: its normal turned clockwise by 90°.
pub fn tangent<T: Number>(normal: &[T; 2]) -> [T; 2] {
    [normal[1].clone(), normal[0].negated()]
}

/// The scene with the impulse of its contact with friction known, and the path that led there; `None` where no contact has
/// friction.
pub fn settle<T: Number + PartialOrd>(
    given: &Given<T>,
    solve: impl Fn(&System<T>) -> Result<Solution<T>, Contradiction>,
) -> Result<Option<Settled<T>>, NoAnswer> {
    let mut contacts = given.contacts.iter().enumerate();
    let found = contacts.find_map(|(i, contact)| match (&contact.law, &contact.normal) {
        (GivenLaw::Friction(law), Some(normal)) => Some((i, law, normal)),
        _ => None,
    });
    let Some((contact, law, normal)) = found else {
        return Ok(None);
    };
    if (0..given.contacts.len()).any(|i| i != contact && strikes(given, i)) {
        return Err(NoAnswer::NoPath(NoPath::Strikes));
    }
    let space = contact_space(given, contact, normal, solve)?;
    let path = follow(&space, law).map_err(NoAnswer::NoPath)?;
    let settled = at_corner(given, contact, path.end());
    let followed = Followed {
        contact,
        space,
        path,
    };
    Ok(Some((settled, followed)))
}

/// The scene with the impulse of its contact with friction known as it is at a corner of the path.
pub fn at_corner<T: Number>(given: &Given<T>, contact: usize, corner: &Corner<T>) -> Given<T> {
    let mut out = given.clone();
    if let Some(normal) = &given.contacts[contact].normal {
        let [p_t, p_n] = &corner.impulse;
        let impulse = total(&stretched(&tangent(normal), p_t), &stretched(normal, p_n));
        out.contacts[contact].law = known_impulse(&impulse);
    }
    out
}

/// Whether the bodies of a contact move against each other just before, where its law has something to say to that. Speeds
/// below a share of those of its bodies are rounding.
fn strikes<T: Number>(given: &Given<T>, contact: usize) -> bool {
    let contact = &given.contacts[contact];
    let Joint { bodies, at } = &contact.joint;
    let speeds = bodies.map(|b| given.bodies[b].velocity_before(at));
    let centers = bodies.map(|b| given.bodies[b].velocity.clone());
    let parts = speeds.iter().chain(&centers).flatten();
    let largest = parts.map(Number::size).fold(0.0, f64::max);
    let along = difference(&speeds[1], &speeds[0]);
    let opening = match (&contact.law, &contact.normal) {
        (GivenLaw::Sticking, _) | (_, None) => along.to_vec(),
        (_, Some(normal)) => vec![dot(&along, normal)],
    };
    let rounding = 1e3 * T::rounding() * largest;
    opening
        .iter()
        .any(|speed| !speed.is_zero() && speed.size() > rounding)
}

/// The name of what a contact did, for those who name it: following it needs none. Where two events fall on one another, either
/// name would do.
pub fn happened<T: Number + PartialOrd>(given: &Given<T>, followed: &Followed<T>) -> Mode {
    let Followed { contact, path, .. } = followed;
    let end = path.end();
    let still = end.velocity[0].is_zero() || {
        let scale = end.velocity[1].size() + path.corners[0].velocity[0].size();
        end.velocity[0].size() <= 1e-12 * scale
    };
    if let GivenLaw::Friction(law) = &given.contacts[*contact].law {
        match &law.hypothesis {
            Hypothesis::Brach { ratio: Some(_) } => return Mode::GivenRatio,
            Hypothesis::Brach { ratio: None } if still => return Mode::Sticks,
            Hypothesis::Brach { ratio: None } => return Mode::Slides,
            Hypothesis::ChatterjeeRuina { .. } => {
                let [p_t, p_n] = &end.impulse;
                let room = law.mu.size() * p_n.size() - p_t.size();
                let inside = room > 1e-12 * p_n.size();
                return if inside {
                    Mode::InsideCone
                } else {
                    Mode::OnCone
                };
            }
            Hypothesis::Newton | Hypothesis::Poisson | Hypothesis::Stronge => {}
        }
    }
    // Where slip ends together with compression, that corner tells it; where it ends with the impact, it lasted.
    let all = end.impulse[1].size();
    let ends = |c: &Corner<T>| end.impulse[1].minus(&c.impulse[1]).size() <= 1e-12 * all;
    let last = path.corners.iter().rfind(|c| !ends(c));
    let lasts = last.is_some_and(|c| !c.velocity[0].is_zero());
    let at = |event| path.corners.iter().position(|c| c.event == event);
    let slip_at_start = path.slips_at_first();
    match (at(Event::SlipEnds), at(Event::Compressed), still) {
        // Without slip before, it sticks from the start or slips from the start.
        (_, _, true) if !slip_at_start => Mode::SticksInCompression,
        (_, _, false) if !slip_at_start => Mode::ReversesInCompression,
        (Some(slip), Some(pressed), true) if slip < pressed => Mode::SticksInCompression,
        (Some(slip), Some(pressed), false) if slip < pressed => Mode::ReversesInCompression,
        (Some(_), _, true) => Mode::SticksInRestitution,
        (Some(_), _, false) => Mode::ReversesInRestitution,
        (None, _, _) if lasts => Mode::Slides,
        (None, _, true) => Mode::SticksInRestitution,
        (None, _, false) => Mode::ReversesInRestitution,
    }
}

/// What a contact feels: its relative velocity before, and how that changes with one unit of impulse along t and n.
pub fn contact_space<T: Number>(
    given: &Given<T>,
    contact: usize,
    normal: &[T; 2],
    solve: impl Fn(&System<T>) -> Result<Solution<T>, Contradiction>,
) -> Result<ContactSpace<T>, NoAnswer> {
    let directions = [tangent(normal), normal.clone()];
    let joint = given.contacts[contact].joint.clone();
    let [one, two] = joint
        .bodies
        .map(|b| given.bodies[b].velocity_before(&joint.at));
    let before = difference(&two, &one);
    // Everything at rest, and one unit of impulse: the velocity after is a column of W.
    let mut probe = given.clone();
    for body in &mut probe.bodies {
        body.velocity = [T::zero(), T::zero()];
        body.spin = T::zero();
    }
    let mut columns = Vec::with_capacity(2);
    for direction in &directions {
        probe.contacts[contact].law = known_impulse(direction);
        let system = assemble(&probe);
        let solution = solve(&system).map_err(|c| NoAnswer::Contradiction(c.laws(&system)))?;
        let moved = motion(&probe, &system, &solution);
        let open = |u: &Unknown| joint.bodies.iter().any(|b| u.is_motion_of(*b));
        let open: Vec<Unknown> = moved.loose.iter().copied().filter(open).collect();
        if !open.is_empty() {
            return Err(NoAnswer::NotDetermined(open));
        }
        let [_, after] = relative_velocities(&probe, &moved, joint.bodies, &joint.at);
        columns.push(after);
    }
    let [t, n] = &directions;
    // Of a body that cannot slip there, or does not, rounding of the parts is no slip: friction would be driven by it.
    let largest = |parts: &[&[T; 2]]| {
        let all = parts.iter().flat_map(|part| part.iter().map(Number::size));
        all.fold(0.0, f64::max)
    };
    let along = |v: &[T; 2], direction: &[T; 2], size: f64| {
        let part = dot(v, direction);
        let is_rounding = part.size() <= T::rounding() * size;
        if is_rounding { T::zero() } else { part }
    };
    let [yields, speeds] = [largest(&[&columns[0], &columns[1]]), largest(&[&one, &two])];
    Ok(ContactSpace {
        a: along(&columns[0], t, yields),
        b: along(&columns[0], n, yields),
        c: along(&columns[1], n, yields),
        tangential: along(&before, t, speeds),
        normal: dot(&before, n),
    })
}

/// The law that states an impulse outright.
fn known_impulse<T: Number>([x, y]: &[T; 2]) -> GivenLaw<T> {
    let condition = |impulse: [T; 2], right: &T| Condition {
        impulse,
        velocity: [T::zero(), T::zero()],
        right: right.clone(),
        words: "the impulse",
    };
    GivenLaw::Conditions([
        condition([T::one(), T::zero()], x),
        condition([T::zero(), T::one()], y),
    ])
}

impl NoPath {
    /// Whether the impact fails for reasons of mechanics rather than of arithmetic.
    pub fn is_physical(self) -> bool {
        self != NoPath::Irrational
    }
}
