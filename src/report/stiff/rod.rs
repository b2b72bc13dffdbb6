//! Equations of motion of the rod on compliant ground, in raw and in scaled variables.

use differential_equations::prelude::{CrossingDirection, Event, EventConfig, Matrix, ODE};

use super::contact::{Collision, Ground, Variables};
use super::drive::Start;

/// Time over which the grip is followed [ℓ/v]: long after every transient, for any K worth the name.
const GRIP_TIME: f64 = 0.5;

/// Position and velocity of G and the rod's angle: x, y, θ, ẋ, ẏ, θ̇. In scaled variables the first three are
/// displacements since contact began, in units of ε.
pub(super) type State = [f64; 6];

/// The equations of motion.
pub(super) struct Rod {
    /// What is integrated.
    pub collision: Collision,
    /// ε in scaled variables, 1 in raw ones: the unit of displacement and of time.
    pub unit: f64,
    /// Stiffness in these variables.
    stiffness: f64,
    /// Dashpot constant of the grip in these variables.
    dashpot: f64,
}

impl Rod {
    /// The equations of a collision.
    pub fn new(collision: Collision) -> Rod {
        let (unit, stiffness, dashpot) = match collision.variables {
            Variables::Raw => (1.0, collision.stiffness, collision.stiffness.sqrt()),
            Variables::Scaled => (
                collision.stiffness.powf(-collision.ground.order()),
                1.0,
                1.0,
            ),
        };
        Rod {
            collision,
            unit,
            stiffness,
            dashpot,
        }
    }

    /// When to stop at the latest.
    pub fn horizon(&self) -> f64 {
        match (self.collision.ground, self.collision.variables) {
            (Ground::Grip, _) => GRIP_TIME / self.unit,
            // At K = 1 and beyond contact lasts less than 10 ε in any position of the rod.
            (Ground::Smooth { .. }, Variables::Scaled) => 10.0,
            (Ground::Smooth { .. }, Variables::Raw) => (10.0
                * self
                    .collision
                    .stiffness
                    .powf(-self.collision.ground.order()))
            .max(1.0),
        }
    }

    /// Angle of the rod \[rad\].
    pub fn angle(&self, y: &State) -> f64 {
        match self.collision.variables {
            Variables::Raw => y[2],
            Variables::Scaled => self.collision.angle + self.unit * y[2],
        }
    }

    /// Displacement of C since it struck, in units of displacement.
    fn end(&self, y: &State) -> [f64; 2] {
        match self.collision.variables {
            Variables::Raw => [y[0] - 0.5 * y[2].cos(), y[1] - 0.5 * y[2].sin()],
            Variables::Scaled => {
                // cos(a+b) − cos a and sin(a+b) − sin a without cancellation.
                let half = 0.5 * self.unit * y[2];
                let middle = self.collision.angle + half;
                let chord = half.sin() / self.unit;
                [y[0] + middle.sin() * chord, y[1] - middle.cos() * chord]
            }
        }
    }
}

impl Start<6> for Rod {
    fn start(&self) -> State {
        let a = self.collision.angle;
        match self.collision.variables {
            Variables::Raw => [0.5 * a.cos(), 0.5 * a.sin(), a, 0.0, -1.0, 0.0],
            Variables::Scaled => [0.0, 0.0, 0.0, 0.0, -1.0, 0.0],
        }
    }
}

/// Force on C and its derivatives by the displacement and by the velocity of C (both diagonal).
struct Push {
    force: [f64; 2],
    by_place: [f64; 2],
    by_speed: f64,
}

impl Rod {
    fn push(&self, end: [f64; 2], speed: [f64; 2]) -> Push {
        match self.collision.ground {
            Ground::Smooth { exponent } => {
                // Contact ends at depth 0; the force goes on as an odd function, so that a step over the end meets no corner.
                let depth = -end[1];
                let root = self.stiffness * depth.abs().powf(exponent - 1.0);
                let (force, slope) = (root * depth, root * exponent);
                Push {
                    force: [0.0, force],
                    by_place: [0.0, -slope],
                    by_speed: 0.0,
                }
            }
            Ground::Grip => Push {
                force: std::array::from_fn(|i| -self.stiffness * end[i] - self.dashpot * speed[i]),
                by_place: [-self.stiffness; 2],
                by_speed: -self.dashpot,
            },
        }
    }
}

impl ODE<f64, State> for Rod {
    fn diff(&self, _: f64, y: &State, rate: &mut State) {
        let (sin, cos) = self.angle(y).sin_cos();
        let speed = [y[3] + 0.5 * sin * y[5], y[4] - 0.5 * cos * y[5]];
        let f = self.push(self.end(y), speed).force;
        // I = 1/12; the arm from G to C is −(cos θ, sin θ)/2.
        *rate = [
            y[3],
            y[4],
            y[5],
            f[0],
            f[1],
            6.0 * (sin * f[0] - cos * f[1]),
        ];
    }

    /// By hand: a difference quotient of step 1e−8 is wider than the whole contact when K is large.
    fn jacobian(&self, _: f64, y: &State, j: &mut Matrix<f64>) {
        let (sin, cos) = self.angle(y).sin_cos();
        let speed = [y[3] + 0.5 * sin * y[5], y[4] - 0.5 * cos * y[5]];
        let push = self.push(self.end(y), speed);
        let lever = [0.5 * sin, -0.5 * cos];
        // ∂(lever)/∂θ, in the unit of y[2].
        let turned = [0.5 * cos * self.unit, 0.5 * sin * self.unit];
        for row in 0..6 {
            for column in 0..6 {
                j[(row, column)] = 0.0;
            }
        }
        for i in 0..3 {
            j[(i, i + 3)] = 1.0;
        }
        for i in 0..2 {
            let mut gradient = [0.0; 6];
            gradient[i] = push.by_place[i];
            gradient[2] = push.by_place[i] * lever[i] + push.by_speed * turned[i] * y[5];
            gradient[i + 3] = push.by_speed;
            gradient[5] = push.by_speed * lever[i];
            for (column, value) in gradient.into_iter().enumerate() {
                j[(i + 3, column)] = value;
                j[(5, column)] += 12.0 * lever[i] * value;
            }
            j[(5, 2)] += 12.0 * turned[i] * push.force[i];
        }
    }
}

impl Event<f64, State> for Rod {
    fn config(&self) -> EventConfig {
        EventConfig::new(CrossingDirection::Negative, Some(1))
    }

    /// Depth of C: contact ends where it falls to 0.
    fn event(&self, _: f64, y: &State) -> f64 {
        -self.end(y)[1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_jacobian_by_hand_is_the_derivative_of_the_equations() {
        for ground in [
            Ground::Smooth { exponent: 1.0 },
            Ground::Smooth { exponent: 1.5 },
            Ground::Grip,
        ] {
            for variables in [Variables::Raw, Variables::Scaled] {
                let rod = Rod::new(Collision {
                    angle: 0.7,
                    ground,
                    stiffness: 50.0,
                    variables,
                });
                let mut y = rod.start();
                for (i, value) in y.iter_mut().enumerate() {
                    *value += [0.03, -0.2, 0.1, 0.4, 0.3, -0.8][i];
                }
                let mut by_hand = Matrix::zeros(6, 6);
                rod.jacobian(0.0, &y, &mut by_hand);
                for column in 0..6 {
                    let side = |h: f64| {
                        let (mut moved, mut rate) = (y, [0.0; 6]);
                        moved[column] += h;
                        rod.diff(0.0, &moved, &mut rate);
                        rate
                    };
                    let (low, high) = (side(-1e-6), side(1e-6));
                    for row in 0..6 {
                        let quotient = (high[row] - low[row]) / 2e-6;
                        let error = (by_hand[(row, column)] - quotient).abs();
                        assert!(
                            error < 1e-6 * (1.0 + quotient.abs()),
                            "{ground:?} {variables:?} {row} {column}"
                        );
                    }
                }
            }
        }
    }
}
