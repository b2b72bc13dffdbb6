//! An impact: the velocities after of all bodies and every impulse at once, and which supports and strings act.
//!
//! In: a stage's scene and the state before. Out: [`Impact`] and the state after. The rows come from the geometry
//! ([`crate::numeric::assemble`]); velocities that are open before are unknowns too, so that what does not depend on them
//! comes out all the same. Of the one-sided supports and strings every set is tried; it fits where those that act push or pull
//! and the bodies do not move against those that do not (complementarity). Sets whose impulses are not determined are left out
//! as long as others fit: whatever motion they allow, a smaller set allows it too (Carathéodory).

mod outcome;
mod posed;
mod tried;

use super::{BodyState, Component, Course, Loss, Lost, State};
use crate::numeric::given::{Freedom, Given};
use crate::scene::{Mode, OneSided};
use tried::Tried;

/// Speeds and impulses below this share of those at hand are rounding.
const ROUNDING: f64 = 1e-9;
/// Sets of supports whose motions differ by less than this share give the same motion.
const SAME: f64 = 1e-7;

/// What an impact did.
#[derive(Clone, Debug, PartialEq)]
pub struct Impact {
    /// Impulses of the contacts, then of supports and strings, as questions count them.
    pub contacts: Vec<Impulse>,
    /// Impulses of the hinges.
    pub hinges: Vec<Impulse>,
    /// Impulses from outside.
    pub blows: Vec<Impulse>,
    /// Names of the supports and strings that act, for every set that fits: one set as a rule.
    pub acting: Vec<Vec<String>>,
    /// What a contact with friction did.
    pub mode: Option<Mode>,
    /// How fast bodies part, of every contact with a normal and every support and string.
    pub openings: Vec<Opening>,
    /// What cannot happen so, though the laws were solved.
    pub breaches: Vec<Breach>,
}

impl Impact {
    /// Whether it is these supports and strings that act, and no others.
    pub fn is_by(&self, names: &[String]) -> bool {
        match self.acting.as_slice() {
            [] => names.is_empty(),
            [acting] => acting.len() == names.len() && acting.iter().all(|a| names.contains(a)),
            _ => false,
        }
    }

    /// Whether none but these supports and strings may act.
    pub fn is_within(&self, names: &[String]) -> bool {
        self.acting.iter().flatten().all(|a| names.contains(a))
    }
}

/// An impulse with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Impulse {
    /// Name of what transmits it.
    pub name: String,
    /// Index of the body it acts on: the second one.
    pub on: usize,
    /// Its components \[N s\].
    pub impulse: [Component; 2],
}

/// Velocity of the second body against the first along the normal; negative where they approach.
#[derive(Clone, Debug, PartialEq)]
pub struct Opening {
    /// Name of the contact, support or string.
    pub name: String,
    /// Just before [m/s].
    pub before: Component,
    /// Just after [m/s].
    pub after: Component,
}

/// A way in which a solution of the equations cannot be what happens.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Breach {
    /// The bodies part before they touch at this contact.
    Separates(String),
    /// This contact or support would have to pull, or this string to push.
    Pulls(String),
    /// The bodies go on into each other here, or a string gets longer.
    Enters(String),
    /// The wall that is struck here has moved on since it was struck before.
    Gone(String),
}

/// Solves an impact.
pub(super) fn impact(
    course: &Course<'_>,
    one_sided: &[OneSided],
    supposed: Option<&[String]>,
    before: &State,
) -> Result<(Impact, State), Lost> {
    let table = Table::of(course, one_sided, before)?;
    table.hinges_fit(course)?;
    let mut fitting: Vec<Tried> = Vec::new();
    let mut vague: Vec<Tried> = Vec::new();
    let mut refused = None;
    for set in sets(one_sided, supposed) {
        match table.tried(course, set) {
            Err(lost) if matches!(lost.why, Loss::Contradiction(_)) => refused = Some(lost),
            Err(lost) => return Err(lost),
            Ok(tried) if supposed.is_some() => fitting.push(tried),
            Ok(tried) => match table.fits(&tried) {
                Some(true) => fitting.push(tried),
                Some(false) => {}
                None => vague.push(tried),
            },
        }
    }
    if fitting.is_empty() {
        fitting = vague;
    }
    if fitting.is_empty() {
        return Err(refused.unwrap_or_else(|| {
            course.contradiction("no set of supports and strings fits the motion it begins with")
        }));
    }
    let after = table.after(course, &fitting, before);
    let impact = table.told(course, &fitting, before, &after);
    Ok((impact, after))
}

/// Sets of those that act.
fn sets(one_sided: &[OneSided], supposed: Option<&[String]>) -> Vec<Vec<usize>> {
    let n = one_sided.len();
    let set = |acts: &dyn Fn(usize) -> bool| (0..n).filter(|i| acts(*i)).collect();
    match supposed {
        Some(names) => vec![set(&|i| names.contains(&one_sided[i].name))],
        None => (0..1usize << n)
            .map(|bits| set(&|i| bits >> i & 1 == 1))
            .collect(),
    }
}

/// A support or string in numbers.
struct Support {
    bodies: [usize; 2],
    at: [f64; 2],
    normal: [f64; 2],
}

/// An impact in numbers.
struct Table<'a> {
    given: Given<f64>,
    one_sided: &'a [OneSided],
    supports: Vec<Support>,
    /// The contacts, hinges and blows that stand in `given`, by index in the stage's scene.
    kept: [Vec<usize>; 3],
    /// Supports that stand in the equations.
    kept_supports: Vec<usize>,
    /// Of each body whether anything acts on it in the impact.
    touched: Vec<bool>,
    /// Of each body whether its place is open, or that of a body it is joined to.
    unplaced: Vec<bool>,
    /// Components of velocity that are open before: body, and 0, 1 or 2 for x, y, spin.
    loose: Vec<(usize, usize)>,
    /// The size of speeds, of angular velocities times arms among them.
    speed: f64,
    /// The size of momenta.
    momentum: f64,
    /// The longest arm.
    arm: f64,
}

/// Velocity of a body's point, component by component.
pub(super) fn velocity_at(freedom: Freedom, body: &BodyState, at: &[f64; 2]) -> [Component; 2] {
    let one = |k: usize, sign: f64| -> Component {
        let v = body.velocity[k].clone()?;
        if freedom == Freedom::Particle || body.spin == Ok(0.0) {
            return Ok(v);
        }
        let arm = at[1 - k] - body.center[1 - k].clone()?;
        if arm == 0.0 {
            return Ok(v);
        }
        Ok(v + sign * body.spin.clone()? * arm)
    };
    [one(0, -1.0), one(1, 1.0)]
}

fn norm(v: &[f64; 2]) -> f64 {
    v[0].hypot(v[1])
}
