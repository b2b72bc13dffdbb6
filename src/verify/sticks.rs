//! What friction a contact needs that is taken to stick: its impulse must lie inside the friction cone.

use crate::answer::calc::{sign, tidy};
use crate::derive::Derivation;
use crate::expr::{Expr, Vector, dot};
use crate::laws::Unknown;
use crate::scene::{ContactLaw, Scene};

/// The ratio |P_t|/P_n of a sticking contact with a normal, in parameters: the coefficient of friction is at least this. It
/// is necessary and not sufficient, since slip may end late (Routh's path). `None` where no friction is needed, and where the
/// sign of P_t or P_n is not known.
pub fn needed_friction(scene: &Scene, derivation: &Derivation, contact: usize) -> Option<Expr> {
    let here = &scene.contacts[contact];
    let normal = here.normal.as_ref()?;
    if !matches!(here.law, ContactLaw::Sticking) || derivation.in_steps {
        return None;
    }
    let component = |axis| derivation.motion.get(&Unknown::Contact(contact, axis));
    let impulse: Vector = [component(0)?.clone(), component(1)?.clone()];
    let tangent = [normal[1].clone(), -&normal[0]];
    let [along, across] = [normal, &tangent].map(|direction| dot(&impulse, direction));
    let tidy = |e: &Expr| tidy(e, &scene.domains).ok();
    let [along, across] = [tidy(&along)?, tidy(&across)?];
    let side = |e: &Expr| sign(e, &scene.domains).side();
    if across.is_zero() || side(&along) != Some(true) {
        return None;
    }
    let size = if side(&across)? { across } else { -across };
    tidy(&(size / along))
}
