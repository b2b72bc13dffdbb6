//! What is special about a point: grazing, separating, cancelling, out of range.

use crate::numeric::Given;

/// Normal relative velocity before at a contact with a normal, u_n⁻; negative when approaching.
pub fn approach(given: &Given<f64>, contact: usize) -> Option<f64> {
    let c = &given.contacts[contact];
    let n = c.normal?;
    let [one, two] = c
        .joint
        .bodies
        .map(|b| given.bodies[b].velocity_before(&c.joint.at));
    Some(n[0] * (two[0] - one[0]) + n[1] * (two[1] - one[1]))
}

/// What is special about a point: grazing, cancelling and the like.
pub fn flags(given: &Given<f64>, conditions: &[f64]) -> Vec<&'static str> {
    let mut flags = Vec::new();
    for (i, c) in given.contacts.iter().enumerate() {
        let Some(u) = approach(given, i) else {
            continue;
        };
        let size: f64 = c
            .joint
            .bodies
            .iter()
            .map(|b| {
                let body = &given.bodies[*b];
                let r = body.arm(&c.joint.at);
                body.velocity[0].abs()
                    + body.velocity[1].abs()
                    + body.spin.abs() * (r[0].abs() + r[1].abs())
            })
            .sum();
        if u.abs() <= 1e-6 * size {
            flags.push("grazing");
        }
        if u > 0.0 {
            flags.push("separating");
        }
    }
    if conditions.iter().any(|c| *c > 1e6) {
        flags.push("cancelling");
    }
    let inertia = given.bodies.iter().map(|b| b.inertia).filter(|i| *i != 0.0);
    let energy = given
        .bodies
        .iter()
        .map(|b| b.mass * (b.velocity[0].powi(2) + b.velocity[1].powi(2)))
        .filter(|e| *e != 0.0);
    if inertia.chain(energy).any(|v| !(1e-290..1e290).contains(&v)) {
        flags.push("out of range");
    }
    flags.sort_unstable();
    flags.dedup();
    flags
}
