//! Restitution of dissipative contacts with one degree of freedom: integrated, and by formula.
//!
//! Mass, stiffness and approach speed are 1. A dashpot gives a different restitution depending on when contact is taken to
//! end: when the spring is back at rest, or when the force falls to zero (the ground cannot pull). For Hunt and Crossley's
//! F = k xⁿ (1 + λ ẋ) it is implicit, and does not depend on n.

use differential_equations::prelude::{CrossingDirection, Event, EventConfig, ODE, Status};
use serde::Serialize;

use super::drive::{Integrator, MANY, Start, TIGHT, end_of_contact, integrate};

/// A contact with losses.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Contact {
    /// Spring and dashpot, contact ended at x = 0; damping ratio z < 1.
    DashpotToRest {
        /// Damping ratio z.
        damping: f64,
    },
    /// Spring and dashpot, contact ended at zero force; any damping ratio z ≥ 0.
    DashpotToZeroForce {
        /// Damping ratio z.
        damping: f64,
    },
    /// F = k xⁿ (1 + λ ẋ).
    HuntCrossley {
        /// d = λ v₀ > 0.
        damping: f64,
        /// Exponent n.
        exponent: f64,
    },
}

impl Contact {
    /// Coefficient of restitution by formula; `None` outside the range where contact ends.
    pub fn formula(self) -> Option<f64> {
        match self {
            Contact::DashpotToRest { damping: z } => (0.0..1.0)
                .contains(&z)
                .then(|| (-std::f64::consts::PI * z / ((1.0 - z) * (1.0 + z)).sqrt()).exp()),
            Contact::DashpotToZeroForce { damping: z } if z >= 0.0 => {
                let root = ((1.0 - z) * (1.0 + z)).abs().sqrt();
                // acos z/√(1−z²), continued through 1 at z = 1.
                let ratio = if z < 1.0 {
                    root.atan2(z) / root
                } else if z > 1.0 {
                    z.acosh() / root
                } else {
                    1.0
                };
                Some((-2.0 * z * ratio).exp())
            }
            Contact::HuntCrossley { damping: d, .. } if d > 0.0 => Some(hunt_crossley(d)),
            _ => None,
        }
    }

    /// Coefficient of restitution by integration; `None` if the end of contact is not found.
    pub fn integrated(self) -> Option<f64> {
        // Without oscillation x only decays, and its rounding errors are no end of contact.
        if matches!(self, Contact::DashpotToRest { damping } if damping >= 1.0) {
            return None;
        }
        let solution = integrate(
            &self,
            Integrator::Dop853,
            (0.0, self.start()),
            200.0,
            TIGHT,
            MANY,
            true,
        )
        .ok()?;
        if solution.status != Status::Interrupted {
            return None;
        }
        let (_, state) = end_of_contact(&self, *solution.t.last()?)?;
        Some(-state[1])
    }

    fn force(self, x: f64, speed: f64) -> f64 {
        match self {
            Contact::DashpotToRest { damping } | Contact::DashpotToZeroForce { damping } => {
                x + 2.0 * damping * speed
            }
            Contact::HuntCrossley { damping, exponent } => {
                x * x.abs().powf(exponent - 1.0) * (1.0 + damping * speed)
            }
        }
    }
}

/// The root e in (0, 1) of (1+e)d = ln((1+d)/(1−e d)); the difference of the sides falls from e = 0 on.
fn hunt_crossley(d: f64) -> f64 {
    let difference = |e: f64| (d - d.ln_1p()) + (e * d + (-e * d).ln_1p());
    let (mut low, mut high) = (0.0, (1.0 / d).min(1.0));
    // 60 halvings exhaust a double.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if difference(middle) > 0.0 {
            low = middle
        } else {
            high = middle
        }
    }
    0.5 * (low + high)
}

impl Start<2> for Contact {
    fn start(&self) -> [f64; 2] {
        [0.0, 1.0]
    }
}

impl ODE<f64, [f64; 2]> for Contact {
    fn diff(&self, _: f64, y: &[f64; 2], rate: &mut [f64; 2]) {
        *rate = [y[1], -self.force(y[0], y[1])];
    }
}

impl Event<f64, [f64; 2]> for Contact {
    fn config(&self) -> EventConfig {
        EventConfig::new(CrossingDirection::Negative, Some(1))
    }

    fn event(&self, _: f64, y: &[f64; 2]) -> f64 {
        match self {
            Contact::DashpotToZeroForce { .. } => self.force(y[0], y[1]),
            // Hunt and Crossley's force and depth vanish together.
            _ => y[0],
        }
    }
}

/// One comparison.
#[derive(Clone, Debug, Serialize)]
pub struct Restitution {
    /// The contact.
    pub contact: Contact,
    /// By formula.
    pub formula: f64,
    /// By integration.
    pub integrated: f64,
    /// |integrated − formula| / formula.
    pub error: f64,
}

/// Formula and integration side by side; contacts that have no end are left out.
pub fn restitutions(contacts: &[Contact]) -> Vec<Restitution> {
    contacts
        .iter()
        .filter_map(|&contact| {
            let (formula, integrated) = (contact.formula()?, contact.integrated()?);
            Some(Restitution {
                contact,
                formula,
                integrated,
                error: ((integrated - formula) / formula).abs(),
            })
        })
        .collect()
}

/// The contacts a report shows: damping from almost none to heavy.
pub fn usual_contacts() -> Vec<Contact> {
    let mut all = Vec::new();
    for damping in [0.01, 0.1, 0.3, 0.5, 0.7] {
        all.push(Contact::DashpotToRest { damping });
    }
    for damping in [0.01, 0.1, 0.3, 0.5, 0.9, 1.0, 2.0] {
        all.push(Contact::DashpotToZeroForce { damping });
    }
    for damping in [0.1, 0.5, 1.0, 3.0] {
        for exponent in [1.0, 1.5] {
            all.push(Contact::HuntCrossley { damping, exponent });
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integration_agrees_with_the_formulas() {
        let contacts = usual_contacts();
        let rows = restitutions(&contacts);
        assert_eq!(rows.len(), contacts.len(), "every contact ends");
        for row in rows {
            assert!(row.error < 1e-11, "{row:?}");
        }
    }

    #[test]
    fn the_two_ends_of_a_dashpot_contact_differ() {
        let rest = Contact::DashpotToRest { damping: 0.5 }
            .formula()
            .expect("z < 1");
        let zero = Contact::DashpotToZeroForce { damping: 0.5 }
            .formula()
            .expect("z ≥ 0");
        assert!(zero > rest + 0.1, "{zero} {rest}");
    }

    #[test]
    fn an_overdamped_spring_never_comes_back_to_rest() {
        let contact = Contact::DashpotToRest { damping: 1.5 };
        assert_eq!((contact.formula(), contact.integrated()), (None, None));
    }
}
