//! How bodies stand and move, component by component: a value, or why there is none.

use std::fmt;

use super::outline::Solid;
use crate::numeric::given::{Freedom, GivenBody};

/// A component of the motion, or why it has no value.
pub type Component = Result<f64, Open>;

/// Why a component has no value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Open {
    /// Name of the stage that left it open.
    pub stage: String,
    /// What left it open.
    pub why: Why,
}

/// What leaves a component open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// The laws of the impact allow several values.
    Laws,
    /// Several sets of supports and strings fit, with different motions.
    Supports,
    /// It needs a component that was open before.
    Needed,
    /// The stage takes a time that is not known.
    Time,
    /// Gravity or a force acts in the stage, and what acts on this body is not said.
    Forces,
    /// Another stage tells how it moves meanwhile.
    Meanwhile,
    /// Joined to a body that moves on, and not said to move along.
    Joined,
    /// It grows beyond bounds as the pole becomes thinner.
    Pole,
    /// The body is balanced, and the push that sets it going decides.
    Push,
}

impl fmt::Display for Open {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let stage = &self.stage;
        match self.why {
            Why::Laws => write!(f, "not determined by the laws of `{stage}`"),
            Why::Supports => write!(f, "several sets of supports fit in `{stage}`"),
            Why::Needed => write!(f, "`{stage}` needs what is open before it"),
            Why::Time => write!(f, "`{stage}` takes a time that is not known"),
            Why::Forces => write!(f, "what acts on it during `{stage}` is not said"),
            Why::Meanwhile => write!(f, "it moves during `{stage}` as another stage tells"),
            Why::Joined => write!(f, "joined to a body that moves on in `{stage}`"),
            Why::Pole => write!(f, "the thinner the pole in `{stage}`, the more it grows"),
            Why::Push => write!(f, "depends on the push that begins `{stage}`"),
        }
    }
}

/// How one body stands and moves.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyState {
    /// Center of mass G \[m\].
    pub center: [Component; 2],
    /// Orientation as in [`crate::scene::Body::angle`] \[rad\]; as the file has it for a particle.
    pub angle: Component,
    /// Velocity of G [m/s].
    pub velocity: [Component; 2],
    /// Angular velocity [rad/s], counterclockwise; 0 for a particle, which has none.
    pub spin: Component,
    /// Whether it has taken part in an impact or a motion.
    pub has_begun: bool,
}

/// How all bodies stand and move.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// The bodies, in the scene's order.
    pub bodies: Vec<BodyState>,
    /// Bodies that a sticking contact or a hinge joins, of the last impact that touched either.
    pub joined: Vec<[usize; 2]>,
    /// Largest speed that an impact has seen so far \[m/s\]: beside it, what is left of a motion brought to rest is rounding.
    pub fastest: f64,
}

impl State {
    /// The same, but for bodies that are where, and as fast as, another state has them.
    pub(super) fn taken_back(mut self, bodies: &[usize], to: &State) -> State {
        for &b in bodies {
            self.bodies[b].clone_from(&to.bodies[b]);
        }
        self
    }
}

impl BodyState {
    /// The six components: place, angle, velocity, spin.
    pub fn components(&self) -> [&Component; 6] {
        let [x, y] = &self.center;
        let [u, v] = &self.velocity;
        [x, y, &self.angle, u, v, &self.spin]
    }

    /// Place, angle, velocity and spin where all are known.
    pub(super) fn known(&self) -> Result<[f64; 6], Open> {
        let mut out = [0.0; 6];
        for (out, component) in out.iter_mut().zip(self.components()) {
            *out = component.clone()?;
        }
        Ok(out)
    }

    pub(super) fn set(&mut self, [x, y, angle, u, v, spin]: [f64; 6]) {
        self.center = [Ok(x), Ok(y)];
        self.angle = Ok(angle);
        self.velocity = [Ok(u), Ok(v)];
        self.spin = Ok(spin);
    }

    /// Leaves every component open.
    pub(super) fn leave_open(&mut self, open: &Open) {
        let open = || Err(open.clone());
        self.center = [open(), open()];
        self.angle = open();
        self.velocity = [open(), open()];
        self.spin = open();
    }

    /// The body in numbers as an impact takes it, open velocities as zero.
    pub(super) fn given(&self, solid: &Solid) -> GivenBody<f64> {
        let number = |c: &Component| c.clone().unwrap_or(0.0);
        GivenBody {
            freedom: solid.freedom,
            mass: solid.mass,
            inertia: solid.inertia,
            center: [number(&self.center[0]), number(&self.center[1])],
            velocity: [number(&self.velocity[0]), number(&self.velocity[1])],
            spin: number(&self.spin),
        }
    }
}

/// Kinetic energy of one body, or of all that are not fixed \[J\].
pub fn kinetic(solids: &[Solid], state: &State, of: Option<usize>) -> Component {
    let mut total = 0.0;
    for (b, (solid, body)) in solids.iter().zip(&state.bodies).enumerate() {
        if solid.freedom == Freedom::Fixed || of.is_some_and(|o| o != b) {
            continue;
        }
        if solid.mass > 0.0 {
            for v in &body.velocity {
                total += 0.5 * solid.mass * v.clone()?.powi(2);
            }
        }
        if solid.freedom == Freedom::Rigid && solid.inertia > 0.0 {
            total += 0.5 * solid.inertia * body.spin.clone()?.powi(2);
        }
    }
    Ok(total)
}
