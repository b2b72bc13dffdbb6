//! An impact in a story: the motion handed on goes in, the one-sided supports that act are found, `derive` does the rest.
//!
//! Of the supports and strings every subset is tried. Those in it are contacts without rebound, whose impulses must not be
//! negative; those left out are gone, and the bodies must not move against them. What holds on the whole domain is told
//! alone, what holds on a part of it with its condition.

use std::collections::BTreeMap;

use super::{Case, Kept, Part, Refused, StageTold, State};
use crate::algebra::Sign;
use crate::answer::Form;
use crate::answer::calc::{Seen, essential, is_zero, sign, tidy};
use crate::derive::{self, Derivation};
use crate::domain::Domain;
use crate::expr::{Expr, Node, Symbol};
use crate::formula::{Sentence, sentence};
use crate::scene::{
    Ask, Contact, ContactLaw, EnergyWhen, Hypothesis, ImpulseAt, OneSided, Question, Scene, Stage,
    touch,
};
use crate::verify::{self, friction};

/// Name of the question after the kinetic energy lost; no name of a scene has a blank at its end.
const ENERGY: &str = "energy lost ";

/// Name of the question whether a support or string acts.
pub(super) fn acting(name: &str) -> String {
    format!("whether {name} acts ")
}

/// Works out an impact.
pub(super) fn tell(
    stage: &Stage,
    before: State,
    one_sided: &[OneSided],
    supposed: Option<&[String]>,
    named: &[(Symbol, Expr)],
) -> Result<StageTold, Refused> {
    let mut base = stage.scene.clone();
    for (body, (v, w)) in base
        .bodies
        .iter_mut()
        .zip(before.velocity.iter().zip(&before.spin))
    {
        body.velocity = v.clone();
        // A particle that went round a point had an angular velocity, but has no spin.
        body.spin = if body.is_particle() {
            Expr::zero()
        } else {
            w.clone()
        };
    }
    touches(stage, &base, one_sided, &before)?;
    hinges_fit(stage, &base, &before)?;
    let approaching = approach(stage, &base, &before)?;
    let handed = hand_on(&mut base, named);
    let mut cases: Vec<Case> = Vec::new();
    let mut contradiction = None;
    let mut outcomes =
        friction::outcomes(&base).map_err(|why| Refused::new(&stage.name, why, ""))?;
    for outcome in &mut outcomes {
        // No table stands beside this impact to tell what Newton's or Brach's law gains.
        outcome.scene.gains_energy = base.gains_energy;
    }
    let sets = subsets(one_sided, supposed);
    for (outcome, set) in outcomes
        .iter()
        .flat_map(|o| sets.iter().map(move |set| (o, set)))
    {
        match case(
            outcome,
            one_sided,
            set,
            supposed.is_some(),
            &handed,
            &before,
        ) {
            Ok(Some(case)) => cases.push(case),
            Ok(None) => {}
            Err(derive::Stop::Contradiction(law)) => contradiction = Some(law),
            Err(stop) => return Err(Refused::stop(&stage.name, stop)),
        }
    }
    if let Some(sure) = cases.iter().position(|c| c.conditions.is_empty()) {
        // Momentum and the one-sided laws have one outcome only; what holds everywhere is it.
        cases = vec![cases.swap_remove(sure)];
    }
    if cases.len() > 1 {
        cases.retain(|case| !is_refuted(&base, case, &handed));
    }
    if cases.is_empty() {
        let is_contradiction = contradiction.is_some();
        let reason = match contradiction {
            Some(laws) => format!(
                "the laws contradict each other, with the motion that comes in: {laws} cannot hold together"
            ),
            None => String::from(
                "no set of supports and strings fits: one of those that act would have to pull or push the wrong way",
            ),
        };
        let hint = "look at the directions `normal`, and at the motion handed on";
        return Err(Refused {
            contradicts: is_contradiction,
            ..Refused::new(&stage.name, reason, hint)
        });
    }
    for case in &mut cases {
        case.conditions.extend(approaching.iter().cloned());
        case.after = state_after(stage, &before, case)?;
    }
    let after = cases[0].after.clone();
    let kept = kept(&base, one_sided, &cases);
    let mut assumptions: Vec<Sentence> = Vec::new();
    for (words, e) in &cases[0].conditions {
        assumptions.push(sentence![e, " ≥ 0 (", words, ")"]);
    }
    assumptions.extend(cases.iter().filter_map(|case| gain(&base, case)));
    let checks = cases[0].proof.scene.clone();
    Ok(StageTold {
        kept,
        cases,
        assumptions,
        checks,
        ..StageTold::new(stage, before, after)
    })
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

/// One set of acting supports, where friction goes one way; `None` where it does not hold anywhere.
fn case(
    outcome: &friction::Outcome,
    one_sided: &[OneSided],
    set: &[usize],
    is_supposed: bool,
    handed: &BTreeMap<Symbol, Expr>,
    before: &State,
) -> Result<Option<Case>, derive::Stop> {
    let mut scene = outcome.scene.clone();
    for contact in &mut scene.contacts {
        if let ContactLaw::Decided(decided) = &mut contact.law {
            // Told with the case, in terms of what is given.
            decided.when.clear();
        }
    }
    // Among the questions the one-sided contacts count after the others; only those that act are contacts here.
    let others = scene.contacts.len();
    scene.questions.retain_mut(|q| match &mut q.ask {
        Ask::Impulse {
            from: ImpulseAt::Contact(i),
            ..
        } if *i >= others => match set.iter().position(|k| k + others == *i) {
            Some(place) => {
                *i = others + place;
                true
            }
            None => false,
        },
        _ => true,
    });
    let mut wanted: Vec<(String, String)> = Vec::new();
    let hidden = |name: String, ask: Ask| Question {
        hidden: true,
        ..Question::new(&name, None, ask)
    };
    for (i, o) in one_sided.iter().enumerate() {
        let [first, second] = o.bodies;
        if set.contains(&i) {
            let name = acting(&o.name);
            scene.questions.push(hidden(
                name.clone(),
                Ask::Impulse {
                    from: ImpulseAt::Contact(scene.contacts.len()),
                    on: second,
                    along: Some(o.normal.clone()),
                },
            ));
            scene.contacts.push(Contact {
                name: o.name.clone(),
                bodies: o.bodies,
                at: o.at.clone(),
                normal: Some(o.normal.clone()),
                law: ContactLaw::Frictionless {
                    restitution: Expr::zero(),
                },
            });
            let verb = if o.is_string { "pulls" } else { "pushes" };
            wanted.push((name, format!("`{}` {verb}", o.name)));
        } else {
            let name = acting(&o.name);
            for (suffix, body) in [("2", second), ("1", first)] {
                scene.questions.push(hidden(
                    format!("{name}{suffix}"),
                    Ask::Velocity {
                        body,
                        point: Some((o.name.clone(), o.at.clone())),
                        along: Some(o.normal.clone()),
                    },
                ));
            }
            let what = if o.is_string {
                "goes slack"
            } else {
                "comes free"
            };
            wanted.push((name, format!("`{}` {what}", o.name)));
        }
    }
    scene.questions.push(hidden(
        ENERGY.into(),
        Ask::Energy {
            when: EnergyWhen::Lost,
            of: None,
        },
    ));
    let derivation = derive::derive(&scene)?;
    if derivation.counting.contradictory {
        let laws = derivation.counting.conflict.join("; ");
        return Err(derive::Stop::Contradiction(laws));
    }
    let values: BTreeMap<String, Expr> = derivation
        .answers
        .iter()
        .filter_map(|a| match &a.form {
            Form::Value { closed, .. } => Some((a.name.clone(), closed.substitute(handed))),
            _ => None,
        })
        .collect();
    let mut conditions = Vec::new();
    for (i, (name, words)) in wanted.into_iter().enumerate() {
        let amount = match (values.get(&name), values.get(&format!("{name}2"))) {
            (Some(impulse), _) => impulse.clone(),
            (None, Some(second)) => {
                let first = values
                    .get(&format!("{name}1"))
                    .cloned()
                    .unwrap_or_else(Expr::zero);
                tidy(&(second - &first), &scene.domains)?
            }
            _ => continue,
        };
        if set.contains(&i) && is_zero(&amount, &scene.domains) == Some(true) && !is_supposed {
            // It touches and does nothing: the smaller set says the same.
            return Ok(None);
        }
        match sign(&amount, &scene.domains) {
            Seen::Proved(s) if s.is_not_negative() => {}
            Seen::Proved(Sign::Negative | Sign::NotPositive) => return Ok(None),
            _ => conditions.push((words, essential(&amount, &scene.domains))),
        }
    }
    for need in &outcome.when {
        let need = need.substitute(handed);
        match sign(&need, &scene.domains) {
            Seen::Proved(s) if s.is_not_negative() => {}
            Seen::Proved(Sign::Negative) => return Ok(None),
            _ => conditions.push((outcome.words.clone(), essential(&need, &scene.domains))),
        }
    }
    conditions.sort_by(|a, b| a.1.cmp(&b.1));
    conditions.dedup_by(|a, b| a.1 == b.1);
    if conditions.iter().any(|(_, e)| {
        conditions
            .iter()
            .any(|(_, f)| is_zero(&(e + f), &scene.domains) == Some(true))
    }) {
        // One condition is the opposite of another: at most a boundary is left.
        return Ok(None);
    }
    let proof = verify::prove(&scene, &derivation);
    let possible = verify::possible::judge(&scene, &derivation);
    Ok(Some(Case {
        possible,
        active: set.iter().map(|i| one_sided[*i].name.clone()).collect(),
        rubs: outcome.words.clone(),
        conditions,
        handed: handed.clone(),
        after: before.clone(),
        scene,
        derivation,
        proof,
    }))
}

/// The values that the scene gives.
fn values(scene: &Scene) -> BTreeMap<Symbol, Expr> {
    let given = scene.parameters.iter();
    given
        .filter_map(|p| Some((p.name.clone(), p.value.clone()?)))
        .collect()
}

/// What is to be said of the energy under a law of friction that may gain some.
fn gain(scene: &Scene, case: &Case) -> Option<Sentence> {
    let mut laws = case.scene.contacts.iter().filter_map(|c| match &c.law {
        ContactLaw::Decided(decided) => Some(&decided.law.hypothesis),
        _ => None,
    });
    let law = laws.find(|h| matches!(h, Hypothesis::Newton | Hypothesis::Brach { .. }))?;
    let at_values = case.value(ENERGY)?.substitute(&values(scene));
    let name = law.name();
    match sign(&at_values, &scene.domains) {
        Seen::Proved(s) if s.is_not_negative() => None,
        Seen::Proved(_) => Some(Sentence::words(format!(
            "that energy grows, which it does at the values given: {name}’s hypothesis does not fit friction here"
        ))),
        _ => Some(Sentence::words(format!(
            "that no energy is gained, which {name}’s hypothesis with friction does not ensure"
        ))),
    }
}

/// Whether the values that the scene gives rule a case out.
fn is_refuted(scene: &Scene, case: &Case, handed: &BTreeMap<Symbol, Expr>) -> bool {
    let given = values(scene);
    case.conditions.iter().any(|(_, e)| {
        let there = e.substitute(handed).substitute(&given);
        there != *e && matches!(sign(&there, &scene.domains), Seen::Proved(Sign::Negative))
    })
}

/// Bodies joined by a hinge must move alike there before.
fn hinges_fit(stage: &Stage, scene: &Scene, before: &State) -> Result<(), Refused> {
    let at = |b: usize, p: &[Expr; 2]| {
        let body = &scene.bodies[b];
        [
            &body.velocity[0] - &(&body.spin * &(&p[1] - &body.center[1])),
            &body.velocity[1] + &(&body.spin * &(&p[0] - &body.center[0])),
        ]
    };
    for hinge in &scene.hinges {
        let (a, b) = (
            at(hinge.bodies[0], &hinge.at),
            at(hinge.bodies[1], &hinge.at),
        );
        for k in 0..2 {
            let gap = &a[k] - &b[k];
            if let Some(why) = before.why_open([&gap]) {
                return Err(Refused::new(
                    &stage.name,
                    format!(
                        "whether the bodies move alike at the hinge `{}` is open: {why}",
                        hinge.name
                    ),
                    "what is caught in the impact is a contact with the law sticking, not a hinge",
                ));
            }
            if is_zero(&gap, &scene.domains) == Some(false) {
                let [first, second] = hinge.bodies.map(|b| &scene.bodies[b].name);
                return Err(Refused::new(
                    &stage.name,
                    format!(
                        "with the motion handed on, `{first}` and `{second}` move differently at the hinge `{}`",
                        hinge.name
                    ),
                    "what is caught in the impact is a contact with the law sticking, not a hinge",
                ));
            }
        }
    }
    Ok(())
}

/// Bodies that part before they touch do not collide. Gives what must be ≥ 0 for them to approach, where that is not sure.
fn approach(stage: &Stage, scene: &Scene, before: &State) -> Result<Vec<(String, Expr)>, Refused> {
    let mut conditions = Vec::new();
    for contact in &scene.contacts {
        let Some(normal) = &contact.normal else {
            continue;
        };
        let [a, b] = contact.bodies.map(|b| {
            let body = &scene.bodies[b];
            let arm = crate::expr::minus(&contact.at, &body.center);
            [
                &body.velocity[0] - &(&body.spin * &arm[1]),
                &body.velocity[1] + &(&body.spin * &arm[0]),
            ]
        });
        let opening = crate::expr::dot(&crate::expr::minus(&b, &a), normal);
        if before.why_open([&opening]).is_some() {
            continue;
        }
        let seen = sign(&opening, &scene.domains);
        if let Seen::Proved(Sign::Positive) = seen {
            let [first, second] = contact.bodies.map(|b| &scene.bodies[b].name);
            return Err(Refused::new(
                &stage.name,
                format!(
                    "with the motion handed on, `{first}` and `{second}` move apart at `{}`: there is no collision",
                    contact.name
                ),
                "look at the stage before, and at `normal`, which points out of the first body into the second",
            ));
        }
        if !matches!(
            seen,
            Seen::Proved(Sign::Negative | Sign::NotPositive | Sign::Zero)
        ) {
            let words = format!("the bodies approach at `{}`", contact.name);
            conditions.push((words, essential(&-&opening, &scene.domains)));
        }
    }
    Ok(conditions)
}

/// The motion just after: what the laws do not determine is open.
fn state_after(stage: &Stage, before: &State, case: &Case) -> Result<State, Refused> {
    let mut after = before.clone();
    let mut scene = case.scene.clone();
    scene.questions.clear();
    let g = crate::laws::Geometry::of(&scene, |e| Ok::<_, std::convert::Infallible>(e.clone()));
    let Ok(g) = g;
    let full = crate::laws::Kinematics::full(&scene, &g);
    let why = format!("the laws of `{}` do not determine it", stage.name);
    for b in 0..scene.bodies.len() {
        let body = &scene.bodies[b];
        if body.is_fixed() {
            continue;
        }
        let value = |form: &crate::laws::Affine<Expr>| -> Result<Option<Expr>, Refused> {
            let mut total = form.constant.clone();
            for (u, k) in &form.terms {
                let Some(v) = case.derivation.motion.get(u) else {
                    return Ok(None);
                };
                total = &total + &(k * v);
            }
            tidy(&total.substitute(&case.handed), &scene.domains)
                .map(Some)
                .map_err(|s| Refused::stop(&stage.name, s))
        };
        for (k, what) in ["_x", "_y"].into_iter().enumerate() {
            after.velocity[b][k] = match value(&full.velocity[b][k])? {
                Some(v) => v,
                None => after.open(&scene, ["u", what], b, &why),
            };
        }
        if !body.is_particle() {
            after.spin[b] = match value(&full.spin[b])? {
                Some(w) => w,
                None => after.open(&scene, ["w", ""], b, &why),
            };
        }
        after.part[b] = part(&scene, b, before.part[b]);
    }
    Ok(after)
}

/// How a body takes part after an impact.
fn part(scene: &Scene, b: usize, before: Part) -> Part {
    let hinges = scene.hinges.iter().map(|h| (h.bodies, true));
    let contacts = scene
        .contacts
        .iter()
        .map(|c| (c.bodies, matches!(c.law, ContactLaw::Sticking)));
    let mut touching = hinges
        .chain(contacts)
        .filter(|(bodies, _)| bodies.contains(&b));
    let struck = scene.blows.iter().any(|blow| blow.body == b)
        || scene.after.iter().any(|known| known.body == b);
    match touching.next() {
        Some((_, true)) => Part::Joined,
        Some(_) if touching.any(|(_, joins)| joins) => Part::Joined,
        Some(_) => Part::Free,
        None if struck => Part::Free,
        None => before,
    }
}

/// A particle is touched where it is.
fn touches(
    stage: &Stage,
    scene: &Scene,
    one_sided: &[OneSided],
    before: &State,
) -> Result<(), Refused> {
    let contacts = scene.contacts.iter().map(|c| (&c.name, c.bodies, &c.at));
    let hinges = scene.hinges.iter().map(|h| (&h.name, h.bodies, &h.at));
    let blows = scene.blows.iter().map(|b| (&b.name, [b.body; 2], &b.at));
    let joints = contacts.chain(hinges).chain(blows);
    let joints = joints.map(|(name, bodies, at)| (name, bodies, at, None));
    let supports = one_sided
        .iter()
        .map(|o| (&o.name, o.bodies, &o.at, Some(o)));
    for (name, bodies, at, one_sided) in joints.chain(supports) {
        for body in bodies.map(|b| &scene.bodies[b]) {
            if !body.is_particle() {
                continue;
            }
            let gap = one_sided.map_or_else(
                || crate::expr::minus(at, &body.center),
                |o| o.gap(&body.center),
            );
            if let Some(why) = before.why_open(&gap) {
                return Err(Refused::new(
                    &stage.name,
                    format!(
                        "where `{}` is, and whether `{name}` touches it, is open: {why}",
                        body.name
                    ),
                    "end the motion before after a time or at a place that has a closed form",
                ));
            }
            if gap
                .iter()
                .any(|c| is_zero(c, &scene.domains) == Some(false))
            {
                let [x, y] = body.center.each_ref().map(|c| {
                    let tidy = tidy(c, &scene.domains).unwrap_or_else(|_| c.clone());
                    crate::formula::write_plain(&tidy)
                });
                return Err(Refused::new(
                    &stage.name,
                    format!(
                        "`{name}` is not where the particle `{}` is by then: at ({x}, {y})",
                        body.name
                    ),
                    format!("\"at\": \"{}\" is always where it is", body.name),
                ));
            }
        }
    }
    let Some(off) = touch::misplaced(scene).into_iter().next() else {
        return Ok(());
    };
    let body = &scene.bodies[off.body];
    let [x, y] = body.center.each_ref().map(|c| {
        let tidy = tidy(c, &scene.domains).unwrap_or_else(|_| c.clone());
        crate::formula::write_plain(&tidy)
    });
    Err(Refused::new(
        &stage.name,
        format!(
            "{}; the center of `{}` is at ({x}, {y}) by then",
            off.words, body.name
        ),
        off.hint,
    ))
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
                [one] => sentence!["an impulse from outside acts at ", one],
                several => {
                    let all: Vec<Sentence> = several.iter().map(Sentence::from).collect();
                    sentence!["impulses from outside act at ", Sentence::list(&all)]
                }
            },
        },
    });
    if let [(name, _)] = outside.as_slice() {
        out.push(Kept {
            what: format!("angular momentum about {name}"),
            conserved: true,
            why: sentence![
                "the only impulse from outside acts at `",
                name,
                "` and has no moment about it"
            ],
        });
    }
    if let ([case], true) = (cases, scene.blows.is_empty())
        && let Some(closed) = &case.value(ENERGY)
        && case.after.why_open([closed]).is_none()
    {
        out.push(if closed.is_zero() {
            Kept {
                what: "kinetic energy".into(),
                conserved: true,
                why: "the loss comes out as 0".into(),
            }
        } else {
            Kept {
                what: "kinetic energy".into(),
                conserved: false,
                why: sentence!["the loss comes out as ", closed],
            }
        });
    }
    out
}

/// Replaces what an earlier stage hands on by symbols where it holds roots: the impact is then a matter of fractions, proved
/// and tried at exact points for any motion handed on, and the roots are put in afterwards. A speed or spin that a question
/// names keeps that name. Gives what the symbols stand for.
fn hand_on(scene: &mut Scene, named: &[(Symbol, Expr)]) -> BTreeMap<Symbol, Expr> {
    let mut handed: Vec<(Symbol, Expr)> = Vec::new();
    let mut domains = scene.domains.clone();
    let original = scene.domains.clone();
    let parameters = scene.parameters.clone();
    let asked = scene.questions.clone();
    let is_taken = |n: &Symbol| {
        parameters.iter().any(|p| p.name == *n) || asked.iter().any(|q| *q.name == **n)
    };
    let mut replace = |e: &mut Expr, is_spin: bool| {
        if !has_root(e) {
            return;
        }
        for (name, value) in &handed {
            if let Ok(ratio) = tidy(&(&*e / value), &original)
                && !has_root(&ratio)
            {
                *e = &ratio * &Expr::symbol(name);
                return;
            }
        }
        let of_question = named.iter().find_map(|(name, value)| {
            let ratio = tidy(&(&*e / value), &original).ok()?;
            (!has_root(&ratio) && !ratio.is_zero()).then_some((name, value, ratio))
        });
        let (name, value, factor) = match of_question {
            Some((name, value, ratio)) => (name.clone(), value.clone(), ratio),
            None => {
                let letter = if is_spin { "omega" } else { "v" };
                let name = (1..1000)
                    .map(|k| Symbol::from(format!("{letter}_in{k}").as_str()))
                    .find(|n| !domains.symbols.contains_key(n) && !is_taken(n))
                    .unwrap_or_else(|| Symbol::from("handed"));
                if sign(e, &original).is_negative() {
                    (name, -&*e, Expr::from(-1))
                } else {
                    (name, e.clone(), Expr::one())
                }
            }
        };
        let sign = sign(&value, &original);
        // What a question asks may be negative, such as the velocity of something that falls.
        let domain = match sign {
            Seen::Proved(Sign::Positive) => Domain::positive(),
            Seen::Proved(Sign::Negative) => Domain::negative(),
            _ => Domain::real(),
        };
        domains.symbols.insert(name.clone(), domain);
        *e = &factor * &Expr::symbol(&name);
        handed.push((name, value));
    };
    for body in &mut scene.bodies {
        replace(&mut body.spin, true);
        body.velocity.iter_mut().for_each(|v| replace(v, false));
    }
    scene.domains = domains;
    for (name, value) in &handed {
        let of = |p: &str| {
            let known = scene.parameters.iter().find(|q| *q.name == *p)?;
            Some(known.dimension.clone())
        };
        let dimension = crate::dimension::of(value, &of).ok().flatten();
        let dimension = dimension.unwrap_or_else(crate::dimension::Dimension::none);
        scene.parameters.push(crate::scene::Parameter {
            name: name.clone(),
            latex: None,
            unit: dimension.si(),
            dimension,
            value: None,
            meaning: String::from("handed on by the stage before"),
        });
    }
    handed.into_iter().collect()
}

/// Whether a root occurs.
fn has_root(e: &Expr) -> bool {
    let mut found = false;
    e.walk(&mut |part| {
        if let Node::Power(_, k) = part.node() {
            found |= k.as_number().is_none_or(|k| !k.is_integer());
        }
    });
    found
}

impl Case {
    /// The value of an answer in parameters alone.
    pub(super) fn value(&self, name: &str) -> Option<Expr> {
        let found = self.derivation.answers.iter().find(|a| a.name == name)?;
        match &found.form {
            Form::Value { closed, .. } => Some(self.put_in(closed)),
            _ => None,
        }
    }

    /// An expression with what was handed on put in.
    pub(super) fn put_in(&self, e: &Expr) -> Expr {
        if self.handed.is_empty() {
            return e.clone();
        }
        let put = e.substitute(&self.handed);
        tidy(&put, &self.scene.domains).unwrap_or(put)
    }

    /// The scene and the derivation without the questions that were only asked to find the outcome, unless there are no
    /// others.
    pub fn asked(&self) -> (Scene, Derivation) {
        let mut scene = self.scene.clone();
        let mut derivation = self.derivation.clone();
        let own: Vec<&Question> = self.scene.questions.iter().filter(|q| q.hidden).collect();
        let is_own = |name: &str| own.iter().any(|q| q.name == name);
        derivation.answers.retain(|a| !is_own(&a.question));
        let has_block = |q: &Question| {
            let mut blocks = derivation.blocks.iter();
            blocks.any(|b| b.asked_by.as_deref() == Some(q.name.as_str()))
        };
        let asked = scene.questions.iter().any(|q| !q.hidden);
        scene
            .questions
            .retain(|q| !q.hidden || (!asked && has_block(q)));
        (scene, derivation)
    }
}
