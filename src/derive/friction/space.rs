//! The contact space: what a contact feels of its bodies.
//!
//! In: a scene and one of its contacts. Out: a, b, c and the velocity before, along the tangent and the normal.

use super::super::Stop;
use super::super::work::Work;
use crate::expr::{Expr, Vector, cross, dot, minus};
use crate::laws::Affine;
use crate::scene::{Body, Condition, ContactLaw, ContactSpace, Decided, Mode, Scene};

/// What a contact feels of its bodies: a, b, c and the relative velocity before, along t and n.
pub(super) fn contact_space(
    scene: &Scene,
    contact: usize,
    [t, n]: [&Vector; 2],
) -> Result<ContactSpace, Stop> {
    let bodies = scene.contacts[contact].bodies;
    let before = scene.contacts[contact].relative_velocity(scene);
    let is_free = scene.contacts.len() == 1 && is_free(scene, bodies);
    let [a, b, c] = match is_free {
        true => [(t, t), (t, n), (n, n)].map(|(d, e)| inverse_mass(scene, contact, d, e)),
        false => eliminated(scene, contact, [t, n])?,
    };
    Ok(ContactSpace {
        a,
        b,
        c,
        tangential: dot(&before, t),
        normal: dot(&before, n),
    })
}

/// Whether both bodies answer the impulse by themselves.
fn is_free(scene: &Scene, bodies: [usize; 2]) -> bool {
    let hinged = |b: usize| scene.hinges.iter().any(|h| h.bodies.contains(&b));
    let massive =
        |b: &Body| b.is_fixed() || !b.mass.is_zero() && (b.is_particle() || !b.inertia.is_zero());
    let answers = |&b: &usize| !hinged(b) && massive(&scene.bodies[b]);
    bodies.iter().all(answers)
}

/// Σ d·e/m + (r × d)(r × e)/I over both bodies.
fn inverse_mass(scene: &Scene, contact: usize, d: &Vector, e: &Vector) -> Expr {
    let contact = &scene.contacts[contact];
    let mut terms = Vec::new();
    for body in contact.bodies.map(|b| &scene.bodies[b]) {
        if body.is_fixed() {
            continue;
        }
        terms.push(dot(d, e) / &body.mass);
        if !body.is_particle() {
            let r = minus(&contact.at, &body.center);
            terms.push(cross(&r, d) * cross(&r, e) / &body.inertia);
        }
    }
    Expr::sum(terms)
}

/// The same by exact elimination, for bodies with hinges: everything at rest, one unit of impulse along t, then along n.
fn eliminated(scene: &Scene, contact: usize, [t, n]: [&Vector; 2]) -> Result<[Expr; 3], Stop> {
    let mut probe = scene.clone();
    for body in &mut probe.bodies {
        body.velocity = [Expr::zero(), Expr::zero()];
        body.spin = Expr::zero();
    }
    probe.questions.clear();
    let mut found = Vec::with_capacity(3);
    let Some((_, law)) = scene.friction() else {
        return Err(Stop::Limit(String::from("a contact without friction")));
    };
    let [a, b, c, tangential, normal] = [(); 5].map(|()| Expr::zero());
    let unknown = ContactSpace {
        a,
        b,
        c,
        tangential,
        normal,
    };
    for (unit, seen) in [(t, vec![t, n]), (n, vec![n])] {
        let outright = |axis: usize| {
            let mut impulse = [Expr::zero(), Expr::zero()];
            impulse[axis] = Expr::one();
            Condition {
                impulse,
                velocity: [Expr::zero(), Expr::zero()],
                right: unit[axis].clone(),
                words: "one unit of impulse",
            }
        };
        probe.contacts[contact].law = ContactLaw::Decided(Box::new(Decided {
            law: law.clone(),
            mode: Mode::GivenRatio,
            when: Vec::new(),
            conditions: [outright(0), outright(1)],
            space: unknown.clone(),
            slip: None,
        }));
        let mut work = Work::new(&probe)?;
        let at = &probe.contacts[contact].at;
        let [one, two] = probe.contacts[contact]
            .bodies
            .map(|b| work.reduced.velocity_of(&work.g, b, at));
        for along in seen {
            let relative = [0, 1].map(|axis| two[axis].minus(&one[axis]).times(&along[axis]));
            let form = relative[0].plus(&relative[1]);
            found.push(value(&mut work, &form)?);
        }
    }
    let [a, b, c] = [0, 1, 2].map(|i| found[i].clone());
    Ok([a, b, c])
}

fn value(work: &mut Work<'_>, form: &Affine<Expr>) -> Result<Expr, Stop> {
    let needed = work.unknowns_in(form)?;
    work.determine(&needed, None)?;
    match work.element_of(form)? {
        Some(value) => Ok(work.field.expr(&value)),
        None => Err(Stop::Limit(String::from(
            "how the contact yields, which its joints leave open",
        ))),
    }
}
