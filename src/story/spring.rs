//! Why a spring has no impulse in a blow: the share of the blow it takes while the blow lasts, and how that vanishes.
//!
//! In: mass, stiffness and duration; the force of the blow is constant while it lasts, and the spring is at rest before.
//! Out: the share 1 − sin φ/φ with φ = τ √(k/m), and its leading term φ²/6. The motion it comes from is put into the
//! equation of motion; the share is held against an integration that does not know it.

use super::integrate;
use crate::answer::Check;
use crate::answer::calc::{is_zero, tidy};
use crate::answer::{Answer, Form, Near, limit};
use crate::domain::{Domain, Domains};
use crate::expr::{Expr, Symbol};
use crate::formula::sentence;

/// The time since the blow began; no scene has such a name.
const TIME: &str = "\u{1}time";
/// The phase φ.
const PHASE: &str = "\u{1}phase";

/// The share, and its leading term.
pub(super) fn share(mut out: Answer, given: [&Expr; 3], domains: &Domains) -> Vec<Answer> {
    let [mass, stiffness, during] = given;
    let rate = (stiffness / mass).sqrt();
    let phase = during * &rate;
    let share = Expr::one() - &phase.sin() / &phase;
    // For a blow of size 1: y from rest under the force 1/τ.
    let t: Symbol = TIME.into();
    let turned = &rate * &Expr::symbol(&t);
    let place = &(Expr::one() - turned.cos()) / &(stiffness * during);
    let force = &Expr::one() / during;
    let speed = place.derivative(&t);
    let gap = &(mass * &speed.derivative(&t)) + &(stiffness * &place) - &force;
    let mut wider = domains.clone();
    wider.symbols.insert(t.clone(), Domain::nonnegative());
    let at = |e: &Expr, time: &Expr| e.substitute(&[(t.clone(), time.clone())].into());
    let rest = [at(&place, &Expr::zero()), at(&speed, &Expr::zero())];
    let left = Expr::one() - mass * &at(&speed, during);
    let all = [
        is_zero(&gap, &wider),
        is_zero(&rest[0], domains),
        is_zero(&rest[1], domains),
        is_zero(&(&left - &share), domains),
    ];
    let holds = match all {
        _ if all.contains(&Some(false)) => Some(false),
        _ if all.iter().all(|x| *x == Some(true)) => Some(true),
        _ => None,
    };
    out.text.push(sentence!("with the blow J spread evenly over the time {}, the body obeys m y″ + k y = J/τ from rest; so y = J (1 − cos(t √(k/m)))/(k τ), and at the end the body has the momentum J sin φ/φ with φ = {}: the spring has taken the rest", during, &phase));
    out.checks.push(Check::new("identity", "this motion satisfies the equation of motion and its initial conditions, and its momentum at the end leaves this share", holds));
    out.checks.push(integrate::share(domains, given, &share));
    let mut short = out.clone();
    short.name = format!("{}_short", out.name);
    short.latex = format!("{{{}}}_0", out.latex);
    short.words = String::from("leading term of that share for a short blow");
    short.checks.clear();
    let leading = &phase.powi(2) / &Expr::from(6);
    let leading = tidy(&leading, domains).unwrap_or(leading);
    short.text = vec![sentence!(
        "for a short blow the share is φ²/6 = {} and higher powers of φ: it vanishes with the square of the time, and so the spring has no impulse",
        &leading
    )];
    // (1 − sin φ/φ)/φ² → 1/6.
    let phi = Expr::symbol(PHASE);
    let ratio = &(Expr::one() - &phi.sin() / &phi) / &phi.powi(2);
    wider.symbols.insert(PHASE.into(), Domain::positive());
    let mut found = short.clone();
    found.text.clear();
    limit::fill(
        &mut found,
        &ratio,
        &PHASE.into(),
        Some(&Expr::zero()),
        &wider,
    );
    let sixth = found.formula().map(|f| *f == Expr::ratio(1, 6));
    short.checks.push(Check::new(
        "limit",
        "the share divided by φ² tends to 1/6 as φ → 0",
        sixth,
    ));
    // What is left out goes with φ⁴.
    short.near.extend(during.as_symbol().map(|time| Near {
        left: share.clone(),
        right: leading.clone(),
        parameter: time.clone(),
        to: Some(Expr::zero()),
        order: 2,
    }));
    short.form = Form::value(leading);
    out.form = Form::value(share);
    vec![out, short]
}
