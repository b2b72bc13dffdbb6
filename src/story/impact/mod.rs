//! An impact in a story: the motion handed on goes in, the one-sided supports that act are found, `derive` does the rest.
//!
//! Of the supports and strings every subset is tried. Those in it are contacts without rebound, whose impulses must not be
//! negative; those left out are gone, and the bodies must not move against them. What holds on the whole domain is told
//! alone, what holds on a part of it with its condition.

mod held;
mod incoming;
mod outcome;

pub(super) use held::stays_held;
pub(super) use outcome::acting;

use incoming::{approach, hand_on, hinges_fit, touches};
use outcome::{
    Active, ENERGY, add_possible, case, fits, gain, is_refuted, no_answer, put_to_act, state_after,
    with_redundant,
};

use super::{Case, Kept, Refused, StageTold, State};
use crate::answer::calc::{Seen, is_zero, sign, tidy};
use crate::derive;
use crate::expr::{Expr, Symbol};
use crate::formula::{Sentence, sentence};
use crate::scene::{ContactLaw, OneSided, Scene, Stage};
use crate::verify::friction;
use crate::verify::possible::Condition;

/// Works out an impact.
pub(super) fn tell(
    course: &[Stage],
    stage: &Stage,
    before: State,
    (one_sided, supposed): (&[OneSided], Option<&[String]>),
    named: &[(Symbol, Expr)],
    given: &[(String, Expr)],
) -> Result<StageTold, Refused> {
    let mut base = in_motion(&stage.scene, &before);
    touches(course, stage, &base, one_sided, &before)?;
    hinges_fit(stage, &base, &before)?;
    let approaching = approach(stage, &base, &before)?;
    let handed = hand_on(&mut base, named);
    let mut cases: Vec<Case> = Vec::new();
    let mut contradiction = None;
    let mut endless = Vec::new();
    for set in subsets(one_sided, supposed) {
        let mut acting = base.clone();
        let wanted = put_to_act(&mut acting, one_sided, &set);
        let [outcomes, without] =
            friction::all_outcomes(&acting).map_err(|why| Refused::new(&stage.name, why, ""))?;
        let goes_so = |outcome: &friction::Outcome| outcome.is_so;
        endless.extend(without.into_iter().filter(goes_so));
        for mut outcome in outcomes.into_iter().filter(goes_so) {
            // No table stands beside this impact to tell what Newton's or Brach's law gains.
            outcome.scene.gains_energy = base.gains_energy;
            let active = Active {
                one_sided,
                set: &set,
                wanted: &wanted,
                is_supposed: supposed.is_some(),
            };
            match case(&outcome, &active, &handed, &before) {
                Ok(Some(case)) => cases.push(case),
                Ok(None) => {}
                Err(derive::Stop::Contradiction(law)) => contradiction = Some(law),
                Err(stop) => return Err(Refused::stop(&stage.name, stop)),
            }
        }
    }
    cases = with_redundant(cases);
    if let Some(sure) = cases.iter().position(|c| c.conditions.is_empty()) {
        // Momentum and the one-sided laws have one outcome only; what holds everywhere is it.
        cases = vec![cases.swap_remove(sure)];
    }
    if cases.len() > 1 {
        cases.retain(|case| !is_refuted(&base, case, &handed) && fits(case, given, &base.domains));
    }
    if cases.is_empty() && !endless.is_empty() {
        return Err(Refused::new(&stage.name, friction::no_end(), ""));
    }
    if cases.is_empty() {
        return Err(no_case(stage, &base, contradiction));
    }
    for case in &mut cases {
        case.conditions.extend(approaching.iter().cloned());
        add_possible(case, &base.domains);
        case.after = state_after(stage, &before, case)?;
    }
    let after = cases[0].after.clone();
    let kept = kept(&base, one_sided, &cases);
    let mut assumptions: Vec<Sentence> = Vec::new();
    // What one of several cases needs is told with it.
    for condition @ (words, e) in &cases[0].conditions {
        if cases
            .iter()
            .any(|case| !case.conditions.contains(condition))
        {
            continue;
        }
        assumptions.push(sentence!("{} ({})", Sentence::not_negative(e), words));
    }
    let places = cases.iter().flat_map(|case| &case.places);
    for told in places.filter_map(Condition::told) {
        if !assumptions.contains(&told) {
            assumptions.push(told);
        }
    }
    assumptions.extend(cases.iter().filter_map(|case| gain(&base, case)));
    assumptions.extend(endless.iter().filter_map(|o| no_answer(o, &base, &handed)));
    let checks = cases[0].proof.scene.clone();
    Ok(StageTold {
        kept,
        cases,
        assumptions,
        checks,
        ..StageTold::new(stage, before, after)
    })
}

/// The scene with its bodies in the motion that comes in.
fn in_motion(scene: &Scene, before: &State) -> Scene {
    let mut scene = scene.clone();
    let motions = before.velocity.iter().zip(&before.spin);
    for (body, (v, w)) in scene.bodies.iter_mut().zip(motions) {
        body.velocity = v.clone();
        // A particle that went round a point had an angular velocity, but has no spin.
        body.spin = match body.is_particle() {
            true => Expr::zero(),
            false => w.clone(),
        };
    }
    scene
}

/// That nothing can come out of an impact, and why.
fn no_case(stage: &Stage, base: &Scene, contradiction: Option<String>) -> Refused {
    let contradicts = contradiction.is_some();
    let reason = match contradiction {
        Some(laws) => format!(
            "the laws contradict each other, with the motion that comes in: {laws} cannot hold together"
        ),
        None => String::from(
            "no set of supports and strings fits: one of those that act would have to pull or push the wrong way",
        ),
    };
    let hint = match base.friction() {
        None => "look at the directions `normal`, and at the motion before the impact",
        Some(_) => {
            "look at the directions `normal`, and at the motion before the impact; with friction a support may let go and come back while the impact lasts, which is not followed"
        }
    };
    Refused {
        contradicts,
        ..Refused::new(&stage.name, reason, hint)
    }
}

/// Sets of those that act, the largest first.
fn subsets(one_sided: &[OneSided], supposed: Option<&[String]>) -> Vec<Vec<usize>> {
    let n = one_sided.len();
    if let Some(names) = supposed {
        return vec![
            (0..n)
                .filter(|i| names.contains(&one_sided[*i].name))
                .collect(),
        ];
    }
    let mut all: Vec<Vec<usize>> = (0..1usize << n)
        .map(|bits| (0..n).filter(|i| bits >> i & 1 == 1).collect())
        .collect();
    all.sort_by_key(|set| std::cmp::Reverse(set.len()));
    all
}

/// What an impact conserves.
fn kept(scene: &Scene, one_sided: &[OneSided], cases: &[Case]) -> Vec<Kept> {
    let fixed = |bodies: &[usize; 2]| bodies.iter().any(|b| scene.bodies[*b].is_fixed());
    // Where impulses from outside act, by name and place.
    let mut outside: Vec<(String, [Expr; 2])> = Vec::new();
    for h in scene.hinges.iter().filter(|h| fixed(&h.bodies)) {
        outside.push((h.name.clone(), h.at.clone()));
    }
    for c in scene.contacts.iter().filter(|c| fixed(&c.bodies)) {
        outside.push((c.name.clone(), c.at.clone()));
    }
    for o in one_sided
        .iter()
        .filter(|o| fixed(&o.bodies) && cases.iter().any(|c| c.active.contains(&o.name)))
    {
        outside.push((o.name.clone(), o.at.clone()));
    }
    for b in &scene.blows {
        outside.push((b.name.clone(), b.at.clone()));
    }
    let mut out = Vec::new();
    let names: Vec<String> = outside.iter().map(|(n, _)| format!("`{n}`")).collect();
    out.push(match names.as_slice() {
        [] => Kept {
            what: "momentum".into(),
            conserved: true,
            why: "no impulse comes from outside".into(),
        },
        _ => Kept {
            what: "momentum".into(),
            conserved: false,
            why: match names.as_slice() {
                [one] => sentence!("an impulse from outside acts at {}", one),
                several => {
                    let all: Vec<Sentence> = several.iter().map(Sentence::from).collect();
                    sentence!("impulses from outside act at {}", Sentence::list(&all))
                }
            },
        },
    });
    if let [(name, _)] = outside.as_slice() {
        out.push(Kept {
            what: format!("angular momentum about `{name}`"),
            conserved: true,
            why: sentence!(
                "the only impulse from outside acts at `{}` and has no moment about it",
                name
            ),
        });
    }
    if let ([case], true) = (cases, scene.blows.is_empty())
        && let Some(closed) = &case.value(ENERGY)
        && case.after.why_open([closed]).is_none()
    {
        let elastic = scene.contacts.iter().find_map(|c| match &c.law {
            ContactLaw::Frictionless { restitution } => restitution.as_symbol(),
            _ => None,
        });
        let is_none = |e: &Expr| is_zero(e, &scene.domains) == Some(true);
        let spared = elastic.filter(|e| is_none(&closed.put(e, &Expr::one())));
        // What is handed on is real, and so is not negative under its root.
        let domains =
            case.handed
                .values()
                .fold(scene.domains.clone(), |domains, value| {
                    match tidy(&value.powi(2), &domains) {
                        Ok(square) => domains.given(&square, true),
                        Err(_) => domains,
                    }
                });
        let seen = sign(closed, &domains);
        out.push(Kept {
            what: "kinetic energy".into(),
            conserved: closed.is_zero(),
            why: match spared {
                _ if closed.is_zero() => "none is lost at the contacts".into(),
                _ if seen.side() == Some(false) => sentence!("{} is gained", &-closed),
                _ if seen == Seen::Mixed => {
                    sentence!("{} is lost, or gained where that is negative", closed)
                }
                Some(e) => sentence!("{} is lost, nothing where {} = 1", closed, e),
                None => sentence!("{} is lost", closed),
            },
        });
    }
    out
}
