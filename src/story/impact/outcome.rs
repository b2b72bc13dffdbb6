//! One outcome of an impact: these supports act and friction goes this way, under conditions; and the motion just after.

use crate::story::UNDETERMINED;
use std::collections::{BTreeMap, BTreeSet};

use crate::algebra::Sign;
use crate::answer::Form;
use crate::answer::calc::{Seen, essential, is_zero, sign, tidy};
use crate::derive::{self, Derivation};
use crate::domain::{Domains, roles, samples_until};
use crate::expr::{Expr, Symbol};
use crate::formula::{Sentence, sentence};
use crate::laws::Unknown;
use crate::scene::{Ask, ContactLaw, EnergyWhen, ImpulseAt, OneSided, Question, Scene, Stage};
use crate::story::{Case, Part, Refused, State};
use crate::verify::possible::{Possible, Rule};
use crate::verify::{self, friction};

/// Name of the question after the kinetic energy lost; no name of a scene has a blank at its end.
pub(super) const ENERGY: &str = "energy lost ";

/// Name of the question whether a support or string acts.
pub(in crate::story) fn acting(name: &str) -> String {
    format!("whether {name} acts ")
}

/// A set of supports and strings that act.
pub(super) struct Active<'a> {
    /// All of them.
    pub one_sided: &'a [OneSided],
    /// Those that act, by index.
    pub set: &'a [usize],
    /// What tells of each one whether it does: the question, and what its answer says.
    pub wanted: &'a [(String, String)],
    /// Whether the scene says that these act.
    pub is_supposed: bool,
}

/// One set of acting supports, where friction goes one way; `None` where it does not hold anywhere.
pub(super) fn case(
    outcome: &friction::Outcome,
    active: &Active<'_>,
    handed: &BTreeMap<Symbol, Expr>,
    before: &State,
) -> Result<Option<Case>, derive::Stop> {
    let Active {
        one_sided,
        set,
        wanted,
        is_supposed,
    } = active;
    let mut scene = outcome.scene.clone();
    for contact in &mut scene.contacts {
        if let ContactLaw::Decided(decided) = &mut contact.law {
            // Told with the case, in terms of what is given.
            decided.when.clear();
        }
    }
    let derivation = derive::derive(&scene)?;
    if derivation.counting.contradictory {
        let laws = derivation.counting.conflict.join("; ");
        return Err(derive::Stop::Contradiction(laws));
    }
    let closed = values_of(&derivation, handed);
    // Each support or string acts or is left from the first to the last: what holds at the end holds where slip ends, too.
    let on_the_way = match &outcome.slip_ends {
        Some(scene) if !wanted.is_empty() => {
            let mut scene = scene.clone();
            scene.questions.retain(|q| q.hidden);
            Some(values_of(&derive::derive(&scene)?, handed))
        }
        _ => None,
    };
    let mut conditions = Vec::new();
    let (mut idle, mut redundant) = (Vec::new(), false);
    // Where a support needs the same, what friction does says it.
    for need in &outcome.when {
        let need = need.substitute(handed);
        match sign(&need, &scene.domains) {
            Seen::Proved(s) if s.is_not_negative() => {}
            // Where it only vanishes, such as at e = 0, the mode beside it says the same.
            Seen::Proved(Sign::Negative | Sign::NotPositive) => return Ok(None),
            _ => conditions.push((outcome.words.clone(), essential(&need, &scene.domains))),
        }
    }
    for (i, (_, words)) in wanted.iter().enumerate() {
        let Some(end) = amount(&closed, &scene, active, i)? else {
            redundant |= set.contains(&i) && !is_supposed;
            continue;
        };
        if is_zero(&end, &scene.domains) == Some(true) {
            match set.contains(&i) {
                // It touches and does nothing: the smaller set says the same.
                true if !is_supposed => return Ok(None),
                true => {}
                false => idle.push(one_sided[i].name.clone()),
            }
        }
        let way = match &on_the_way {
            Some(values) => amount(values, &scene, active, i)?,
            None => None,
        };
        let amounts = match way {
            // A push only grows, and what is left does not come back.
            Some(way) if set.contains(&i) => vec![tidy(&(end - &way), &scene.domains)?, way],
            Some(way) => vec![end, way],
            None => vec![end],
        };
        for amount in amounts {
            match sign(&amount, &scene.domains) {
                Seen::Proved(s) if s.is_not_negative() => {}
                Seen::Proved(Sign::Negative | Sign::NotPositive) => return Ok(None),
                _ => conditions.push((words.clone(), essential(&amount, &scene.domains))),
            }
        }
    }
    let Some(conditions) = independent(conditions, &scene.domains) else {
        return Ok(None);
    };
    let proof = verify::prove(&scene, &derivation);
    let mut possible = judged(&scene, &derivation, one_sided);
    possible.put(handed, &scene.values(), &scene.domains);
    against_values(&mut possible, &scene, &conditions, &outcome.words);
    Ok(Some(Case {
        possible,
        active: set.iter().map(|i| one_sided[*i].name.clone()).collect(),
        idle,
        redundant,
        when: outcome.when.clone(),
        rubs: outcome.words.clone(),
        conditions,
        places: Vec::new(),
        handed: handed.clone(),
        after: before.clone(),
        scene,
        derivation,
        proof,
    }))
}

/// The cases, where more than the motion needs may act. Impulses that push can be had from more of them only if they can from
/// some that have one solution (Carathéodory, on cones), with the same motion: such a set tells when it is so, and the larger one
/// that its impulses are not determined.
pub(super) fn with_redundant(cases: Vec<Case>) -> Vec<Case> {
    let (redundant, sure): (Vec<Case>, Vec<Case>) = cases.into_iter().partition(|c| c.redundant);
    let larger = |case: &Case| {
        let holds = |name| case.active.contains(name) || case.idle.contains(name);
        redundant.iter().find(|all| {
            let acts = |name: &String| all.active.contains(name);
            all.rubs == case.rubs && case.active.iter().all(acts) && all.active.iter().all(holds)
        })
    };
    let as_larger = |case: Case| match larger(&case) {
        Some(all) => Case {
            conditions: case.conditions,
            ..all.clone()
        },
        None => case,
    };
    sure.into_iter().map(as_larger).collect()
}

/// Whether it can happen: what begins at a support or on a string need not come together there.
fn judged(scene: &Scene, derivation: &Derivation, one_sided: &[OneSided]) -> Possible {
    let supports: Vec<&str> = one_sided.iter().map(|one| one.name.as_str()).collect();
    verify::possible::judge(scene, derivation, &supports)
}

/// Takes note where given values do not keep to what is supposed of a contact with friction.
fn against_values(
    possible: &mut Possible,
    scene: &Scene,
    conditions: &[(String, Expr)],
    rubs: &str,
) {
    if scene.decided().any(|(_, d)| d.law.supposing.is_some()) {
        for (words, need) in conditions.iter().filter(|(words, _)| words == rubs) {
            possible.suppose(words, need, &scene.values());
        }
    }
}

/// Closed forms by name of the answer, with what was handed on put in.
fn values_of(derivation: &Derivation, handed: &BTreeMap<Symbol, Expr>) -> BTreeMap<String, Expr> {
    let answers = derivation.answers.iter();
    answers
        .filter_map(|a| match &a.form {
            Form::Value { closed, .. } => {
                let closed = outright(closed, derivation);
                Some((a.name.clone(), closed.substitute(handed)))
            }
            _ => None,
        })
        .collect()
}

/// An expression in parameters alone, also where a derivation went in steps.
fn outright(e: &Expr, derivation: &Derivation) -> Expr {
    match derivation.in_steps {
        true => verify::expand(e, derivation),
        false => e.clone(),
    }
}

/// The impulse of a support or string that acts, or how fast the bodies part at one that is left. Strings over a pulley without
/// mass are one: it turns as they want, and what one end gives the other may take.
fn amount(
    values: &BTreeMap<String, Expr>,
    scene: &Scene,
    active: &Active<'_>,
    i: usize,
) -> Result<Option<Expr>, derive::Stop> {
    let get = |j: usize, suffix: &str| {
        let (name, _) = &active.wanted[j];
        values.get(&format!("{name}{suffix}")).cloned()
    };
    if let Some(impulse) = get(i, "") {
        return Ok(Some(impulse));
    }
    let is_light = |b: &usize| scene.bodies[*b].is_light_pulley();
    let ends = match active.one_sided[i].bodies.into_iter().find(is_light) {
        None => vec![i],
        Some(pulley) => {
            let left = (0..active.one_sided.len()).filter(|j| !active.set.contains(j));
            left.filter(|j| active.one_sided[*j].bodies.contains(&pulley))
                .collect()
        }
    };
    let mut parting = Expr::zero();
    for j in ends {
        let [_, second] = active.one_sided[j].bodies;
        let first = get(j, "1").unwrap_or_else(Expr::zero);
        let second = match get(j, "2") {
            None if is_light(&second) => Expr::zero(),
            None => return Ok(None),
            Some(second) => second,
        };
        parting = parting + second - first;
    }
    Ok(Some(tidy(&parting, &scene.domains)?))
}

/// Longest condition that is held against others, in nodes.
const LONGEST: usize = 120;

/// Conditions without those that follow from the others, the longest left away first, none of them twice; `None` where one of
/// them cannot hold beside the others.
fn independent(
    mut conditions: Vec<(String, Expr)>,
    domains: &Domains,
) -> Option<Vec<(String, Expr)>> {
    conditions.sort_by(|a, b| a.1.cmp(&b.1));
    conditions.dedup_by(|a, b| a.1 == b.1);
    let opposite = |e: &Expr| {
        let mut others = conditions.iter();
        others.any(|(_, f)| is_zero(&(e + f), domains) == Some(true))
    };
    if conditions.iter().any(|(_, e)| opposite(e)) {
        // At most a boundary is left.
        return None;
    }
    let mut order: Vec<Expr> = conditions.iter().map(|(_, e)| e.clone()).collect();
    order.sort_by_key(|e| std::cmp::Reverse(e.size()));
    let short = order.iter().filter(|e| e.size() <= LONGEST);
    for e in short.filter(|_| order.len() > 1) {
        let others = conditions
            .iter()
            .filter(|(_, other)| other != e && other.size() <= LONGEST);
        let given = others.fold(domains.clone(), |given, (_, other)| {
            given.given(other, true)
        });
        match sign(e, &given) {
            Seen::Proved(s) if s.is_not_negative() => conditions.retain(|(_, other)| other != e),
            // Where it only vanishes, at most a boundary is left.
            Seen::Proved(Sign::Negative | Sign::NotPositive) => return None,
            _ => {}
        }
    }
    Some(conditions)
}

/// Whether the conditions of a case can hold beside those of the way that leads to it.
pub(super) fn fits(case: &Case, given: &[(String, Expr)], domains: &Domains) -> bool {
    let mut all: Vec<(String, Expr)> = given.to_vec();
    all.extend(case.conditions.iter().cloned());
    has_point(&all, domains) || independent(all, domains).is_some()
}

/// Points that are looked for to find one of them.
const TRIED: usize = 24;

/// Whether a point is found at which all conditions hold, none of them as an equation only.
fn has_point(conditions: &[(String, Expr)], domains: &Domains) -> bool {
    let all: Vec<&Expr> = conditions.iter().map(|(_, e)| e).collect();
    let roles = roles(&all);
    let given = domains.clone();
    let given = all.iter().fold(given, |given, e| given.given(e, false));
    let (given, _) = given.completed(&roles);
    !samples_until(&roles, &given, TRIED, |_| true).is_empty()
}

/// Adds what must hold so that a case is possible, where its conditions do not say it.
pub(super) fn add_possible(case: &mut Case, domains: &Domains) {
    let known = case.conditions.iter();
    let mut known = known.fold(domains.clone(), |given, (_, e)| given.given(e, true));
    case.possible.given(&known);
    for open in case.possible.open() {
        if open.is_equation {
            case.places.push(open.clone());
            continue;
        }
        let Some(e) = open.essential.as_ref().filter(|_| open.divides(&known)) else {
            continue;
        };
        known = known.given(e, true);
        match open.rule {
            Rule::Place => case.places.push(open.clone()),
            _ => case.conditions.push((open.words.clone(), e.clone())),
        }
    }
}

/// Makes contacts of the supports and strings that act, and asks for what tells whether each one acts or is left: the question,
/// and what it would say. The energy lost is asked for too.
pub(super) fn put_to_act(
    scene: &mut Scene,
    one_sided: &[OneSided],
    set: &[usize],
) -> Vec<(String, String)> {
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
            scene.contacts.push(o.acting());
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
    wanted
}

/// What is to be said of the energy under a law of friction that may gain some.
pub(super) fn gain(scene: &Scene, case: &Case) -> Option<Sentence> {
    let mut laws = case.scene.decided().map(|(_, d)| &d.law.hypothesis);
    let law = laws.find(|hypothesis| hypothesis.may_gain())?;
    let at_values = case.value(ENERGY)?.substitute(&scene.values());
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

/// Where a law of friction has no answer, because the impact has no end.
pub(super) fn no_answer(
    outcome: &friction::Outcome,
    scene: &Scene,
    handed: &BTreeMap<Symbol, Expr>,
) -> Option<Sentence> {
    let (_, law) = scene.friction()?;
    let name = law.hypothesis.name();
    let needs = outcome.when.iter().map(|need| need.substitute(handed));
    let open = |need: &Expr| {
        let sign = sign(need, &scene.domains);
        !matches!(sign, Seen::Proved(s) if s.is_not_negative())
    };
    let needs = needs.filter(open);
    let needs = needs.map(|need| Sentence::not_negative(&essential(&need, &scene.domains)));
    let needs = Sentence::join(needs, " and ");
    let words = format!("{name}’s hypothesis has no answer where ");
    Some(sentence!(
        "{}{} ({})",
        words,
        needs,
        format!("{}, and nothing ends it", outcome.words)
    ))
}

/// Whether the values that the scene gives rule a case out.
pub(super) fn is_refuted(scene: &Scene, case: &Case, handed: &BTreeMap<Symbol, Expr>) -> bool {
    let given = scene.values();
    case.conditions.iter().any(|(_, e)| {
        let there = e.substitute(handed).substitute(&given);
        there != *e && matches!(sign(&there, &scene.domains), Seen::Proved(Sign::Negative))
    })
}

/// The motion just after: what the laws do not determine is open.
pub(super) fn state_after(stage: &Stage, before: &State, case: &Case) -> Result<State, Refused> {
    let mut after = before.clone();
    let mut scene = case.scene.clone();
    scene.questions.clear();
    let g = crate::laws::Geometry::symbolic(&scene);
    let full = crate::laws::Kinematics::full(&scene, &g);
    let why = format!("the laws of `{}`{UNDETERMINED}", stage.name);
    for b in 0..scene.bodies.len() {
        let body = &scene.bodies[b];
        if !scene.has_law(b) {
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
            let total = outright(&total, &case.derivation);
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
    match touching.next() {
        Some((_, true)) => Part::Joined,
        Some(_) if touching.any(|(_, joins)| joins) => Part::Joined,
        Some(_) => Part::Free,
        None if scene.takes_part(b) => Part::Free,
        None => before,
    }
}

impl Case {
    /// The value of an answer in parameters alone.
    pub(in crate::story) fn value(&self, name: &str) -> Option<Expr> {
        let found = self.derivation.answers.iter().find(|a| a.name == name)?;
        match &found.form {
            Form::Value { closed, .. } => Some(self.put_in(&outright(closed, &self.derivation))),
            _ => None,
        }
    }

    /// The form of an answer of the impact in parameters alone: what is named in the impact has no name in later stages.
    pub(in crate::story) fn form(&self, form: &Form) -> Form {
        let Form::Value { closed, short } = form else {
            return form.map(|e| self.put_in(e));
        };
        let closed = self.put_in(&outright(closed, &self.derivation));
        let named = short.symbols();
        let mut definitions = self.derivation.definitions.iter();
        let short = match definitions.any(|d| named.contains(&d.name)) {
            true => closed.clone(),
            false => self.put_in(short),
        };
        Form::Value { closed, short }
    }

    /// An expression with what was handed on put in.
    pub(in crate::story) fn put_in(&self, e: &Expr) -> Expr {
        if self.handed.is_empty() {
            return e.clone();
        }
        let put = e.substitute(&self.handed);
        tidy(&put, &self.scene.domains).unwrap_or(put)
    }

    /// The scene and the derivation without the questions that were only asked to find the outcome, unless there are no
    /// others, or the motion of these bodies comes with them.
    pub fn asked(&self, of: &[usize]) -> (Scene, Derivation) {
        let mut scene = self.scene.clone();
        let mut derivation = self.derivation.clone();
        let own: Vec<&Question> = self.scene.questions.iter().filter(|q| q.hidden).collect();
        let is_own = |name: &str| own.iter().any(|q| q.name == name);
        derivation.answers.retain(|a| !is_own(&a.question));
        // What comes to rest or goes on as before is told in words.
        let by_inspection = |u: &Unknown| {
            match *u {
                Unknown::Velocity(b, k) => Some(&scene.bodies[b].velocity[k]),
                Unknown::Spin(b) => Some(&scene.bodies[b].spin),
                _ => None,
            }
            .zip(derivation.motion.get(u))
            .is_some_and(|(before, after)| {
                let change = before - after;
                after.is_zero() || is_zero(&change, &scene.domains) == Some(true)
            })
        };
        let asked = scene.questions.iter().any(|q| !q.hidden);
        let moves = |u: &Unknown| match u {
            Unknown::Velocity(b, _) | Unknown::Spin(b) => of.contains(b),
            _ => false,
        };
        let mut blocks = derivation.blocks.clone();
        let mut asking: Vec<&str> = Vec::new();
        // What the later equations hold; they stand behind those that determine it.
        let mut needed: BTreeSet<Unknown> = BTreeSet::new();
        for block in blocks.iter_mut().rev() {
            let has_own = block.asked_by.as_deref().is_some_and(is_own);
            let mut goes_on = block
                .unknowns
                .iter()
                .filter(|u| moves(u) || needed.contains(u));
            let is_dropped = asked && goes_on.next().is_none();
            if has_own && block.unknowns.iter().all(by_inspection) {
                continue;
            }
            match has_own {
                true if is_dropped => block.asked_by = None,
                true => asking.extend(block.asked_by.as_deref()),
                false => {}
            }
            if block.asked_by.is_some() {
                let terms = block.equations.iter().flat_map(|e| &e.terms);
                needed.extend(terms.map(|(u, _)| *u));
            }
        }
        scene
            .questions
            .retain(|q| !q.hidden || asking.contains(&q.name.as_str()));
        derivation.blocks = blocks;
        (scene, derivation)
    }
}
