//! A table of friction held against the path that knows no modes, and the case that given values pick.
//!
//! In: a scene with friction and the table derived from it. Out: which case the values of the scene pick; at random exact
//! points of the domain, whether exactly one case holds there and gives the impulse at the end of the path; whether energy
//! is gained.

use std::collections::{BTreeMap, BTreeSet};

use super::Check;
use crate::algebra::Sign;
use crate::answer::calc::{Seen, sign};
use crate::derive::friction::{Bound, Case, Direction, Table};
use crate::domain::Domains;
use crate::expr::number::to_f64;
use crate::expr::{Expr, Point, Rational, Symbol, effort};
use crate::formula::Relation;
use crate::laws::friction::{Side, When};
use crate::numeric::friction::Followed;
use crate::numeric::path::{NoPath, Path};
use crate::numeric::{self, Number};
use crate::scene::{ContactLaw, Friction, Mode, Scene};

/// Exact points tried; about half of them have other modes than the one wanted.
const POINTS: u64 = 40;

/// What is known of a table beyond its derivation.
#[derive(Clone, Debug)]
pub struct Judged {
    /// Which cases are to be shown.
    pub pick: Pick,
    /// Whether the mode that the scene supposes is the one that its values pick; `None` where nothing is supposed or the
    /// values do not decide.
    pub supposed_holds: Option<bool>,
    /// The outcome of the checks.
    pub checks: Vec<Check>,
    /// The impact at the values of the scene, where there are any.
    pub at_values: Option<AtValues>,
}

/// Which cases a scene is about.
#[derive(Clone, Debug, PartialEq)]
pub enum Pick {
    /// The values of the scene pick this one.
    Values(usize),
    /// The scene supposes these.
    Supposed(Vec<usize>),
    /// Nothing decides: all of them.
    All,
}

impl Pick {
    /// Indices of the cases.
    pub fn cases(&self, table: &Table) -> Vec<usize> {
        match self {
            Pick::Values(one) => vec![*one],
            Pick::Supposed(some) => some.clone(),
            Pick::All => (0..table.cases.len()).collect(),
        }
    }
}

/// An impact in numbers.
#[derive(Clone, Debug)]
pub struct AtValues {
    /// Kinetic energy before \[J\].
    pub energy_before: f64,
    /// Kinetic energy gained \[J\]; negative for a loss.
    pub gain: f64,
    /// Whether the contact jams.
    pub jams: bool,
}

/// A share of the energy that is rounding, and no gain.
const ROUNDING: f64 = 1e-11;

impl AtValues {
    /// The same of the impact of a scene, as a sentence.
    pub fn told(&self, law: &str) -> String {
        let energy = self.energy_words(law);
        format!("at the values of the scene the impact {energy}")
    }

    /// What the energy says of the law, in words.
    pub fn energy_words(&self, law: &str) -> String {
        let share = 100.0 * self.gain / self.energy_before;
        if self.energy_before <= 0.0 {
            return String::from("nothing moves");
        }
        if share > 100.0 * ROUNDING {
            format!(
                "gains {share:.1} % of the energy: {law}'s hypothesis does not fit friction here"
            )
        } else if share < -100.0 * ROUNDING {
            format!("loses {:.1} % of the energy", -share)
        } else {
            String::from("keeps the energy")
        }
    }
}

/// Judges a table.
pub fn judge(scene: &Scene, table: &Table) -> Judged {
    let by_values = picked(scene, table);
    let supposed = table.law.supposing.map(|_| {
        let all = table.cases.iter().enumerate();
        all.filter(|(_, case)| is_supposed(table, case))
            .map(|(i, _)| i)
            .collect::<Vec<_>>()
    });
    let supposed_holds = match (&supposed, by_values) {
        (Some(cases), Some(case)) => Some(cases.contains(&case)),
        _ => None,
    };
    let supposed = supposed.map(|mut cases| {
        let sign = Signs::of(scene);
        cases.retain(|i| sign.goes(&table.side, &table.cases[*i]) != Some(false));
        cases
    });
    let pick = match (supposed, by_values) {
        (Some(cases), Some(case)) if cases.contains(&case) => Pick::Values(case),
        (Some(cases), _) => Pick::Supposed(cases),
        (None, Some(case)) => Pick::Values(case),
        (None, None) => Pick::All,
    };
    let mut checks = Vec::new();
    against_path(scene, table, &mut checks);
    Judged {
        pick,
        supposed_holds,
        checks,
        at_values: at_values(scene),
    }
}

/// Whether a case is one that the scene supposes; all are where it supposes nothing.
fn is_supposed(table: &Table, case: &Case) -> bool {
    let supposed = table.law.supposing;
    supposed.is_none_or(|mode| case.mode.is(mode) || table.called(case) == mode)
}

/// One way an impact with friction can go.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The scene with the conditions of the mode in place of the law.
    pub scene: Scene,
    /// What the contact does, such as "`C` slides".
    pub words: String,
    /// What must be ≥ 0 for it.
    pub when: Vec<Expr>,
    /// The scene up to where slip ends on the way, where other contacts could let go there.
    pub slip_ends: Option<Scene>,
    /// Whether it goes so, as far as the values of the scene and what it supposes tell.
    pub is_so: bool,
    /// Whether the law lets the impact come to an end.
    pub ends: bool,
}

/// The ways a scene with friction can go, as far as its values and what it supposes leave several; the scene itself where
/// there is no friction. The table is held against the path of the impulse first.
pub fn outcomes(scene: &Scene) -> Result<Vec<Outcome>, String> {
    let [mut all, _] = all_outcomes(scene)?;
    all.retain(|outcome| outcome.is_so);
    match all.is_empty() {
        true => Err(no_end()),
        false => Ok(all),
    }
}

/// Why a law of friction has no answer where nothing ends the impact.
pub fn no_end() -> String {
    NoPath::NeverEnds.to_string()
}

/// The same with those that its values exclude; beside them those in which the law lets the impact have no end.
pub fn all_outcomes(scene: &Scene) -> Result<[Vec<Outcome>; 2], String> {
    let all = effort::of_scene(|| out_of_table(scene))?;
    let (ended, endless) = all.into_iter().partition(|outcome| outcome.ends);
    Ok([ended, endless])
}

fn out_of_table(scene: &Scene) -> Result<Vec<Outcome>, String> {
    let table = match crate::derive::friction::table(scene) {
        Ok(Some(table)) => table,
        Ok(None) => {
            let alone = Outcome {
                scene: scene.clone(),
                words: String::new(),
                when: Vec::new(),
                slip_ends: None,
                is_so: true,
                ends: true,
            };
            return Ok(vec![alone]);
        }
        Err(stop) => return Err(stop.to_string()),
    };
    let judged = judge(scene, &table);
    if let Some(failed) = judged.checks.iter().find(|c| c.holds == Some(false)) {
        return Err(failed.words.clone());
    }
    let picked = judged.pick.cases(&table);
    if picked.is_empty() {
        return Err("what the scene supposes of its contact never happens".into());
    }
    let name = &scene.contacts[table.contact].name;
    let outcome = |(i, case): (usize, &Case)| Outcome {
        scene: case.scene.clone(),
        words: table.called(case).of(name),
        when: case.needs(&table.side),
        slip_ends: case.slip_ends.clone(),
        is_so: picked.contains(&i),
        ends: case.ends,
    };
    let all = table.cases.iter().enumerate();
    let supposed = all.filter(|(_, case)| is_supposed(&table, case));
    Ok(supposed.map(outcome).collect())
}

/// The scene in the one case that its values pick or that it supposes; the words say why there is none. A scene without
/// friction is as it is.
pub fn settled(scene: &Scene) -> Result<Scene, String> {
    let all = outcomes(scene)?;
    match all.as_slice() {
        [one] => return Ok(one.scene.clone()),
        [one, other] => {
            if let Some(both) = joined(&one.scene, &other.scene) {
                return Ok(both);
            }
        }
        _ => {}
    }
    let told: BTreeSet<&str> = all.iter().map(|o| o.words.as_str()).collect();
    let told: Vec<&str> = told.into_iter().collect();
    Err(format!(
        "friction leaves {} cases: {}\nhint: give the parameters values, with --set or in the scene, or choose a case with `supposing`; `carom derive` tells when each holds",
        all.len(),
        told.join(", or ")
    ))
}

/// Two cases in which a contact sticks and feels the same, whenever its slip ended: one, where either happens.
fn joined(one: &Scene, other: &Scene) -> Option<Scene> {
    let ((at, a), (_, b)) = (one.decided().next()?, other.decided().next()?);
    if !(a.mode.sticks() && b.mode.sticks() && a.conditions == b.conditions) {
        return None;
    }
    // Where one of them ends the other begins.
    let meet = |(l, r, x): &Holds, (left, relation, right): &Holds| {
        let same = l == left && x == right && r != relation;
        same || *l == -left && x.is_zero() && right.is_zero()
    };
    let mut both = b.clone();
    both.mode = Mode::Sticks;
    both.slip = both.slip.filter(|_| a.slip == b.slip);
    both.when.retain(|w| !a.when.iter().any(|v| meet(v, w)));
    let mut scene = other.clone();
    scene.contacts[at].law = ContactLaw::Decided(Box::new(both));
    (a.when.len() + b.when.len() > 1).then_some(scene)
}

/// What must hold for a case, as left, relation, right.
type Holds = (Expr, Relation, Expr);

/// The case that the values of the scene pick.
fn picked(scene: &Scene, table: &Table) -> Option<usize> {
    let sign = Signs::of(scene);
    let holds = |case: &Case| sign.holds(&table.side, case) == Some(true);
    table.cases.iter().position(holds)
}

/// Signs at the values of a scene: in fractions, and where these do not do by enclosures or the signs of algebraic numbers.
struct Signs<'a> {
    exact: Option<Point<Rational>>,
    values: BTreeMap<Symbol, Expr>,
    domains: &'a Domains,
}

impl Signs<'_> {
    fn of(scene: &Scene) -> Signs<'_> {
        Signs {
            exact: numeric::exact_values(scene).ok(),
            values: scene.values(),
            domains: &scene.domains,
        }
    }

    fn sign(&self, e: &Expr) -> Option<std::cmp::Ordering> {
        if let Some(value) = self.exact.as_ref().and_then(|p| e.evaluate(p)) {
            return Some(value.cmp(&Number::zero()));
        }
        // What has no value may play no part in the sign, such as a mass.
        match sign(&e.substitute(&self.values), self.domains) {
            Seen::Proved(Sign::Positive) => Some(std::cmp::Ordering::Greater),
            Seen::Proved(Sign::Zero) => Some(std::cmp::Ordering::Equal),
            Seen::Proved(Sign::Negative) => Some(std::cmp::Ordering::Less),
            _ => None,
        }
    }

    /// Whether friction has the direction of a case; `None` where a sign is not known.
    fn goes(&self, side: &Side, case: &Case) -> Option<bool> {
        match case.direction {
            Direction::Asked(s) => {
                direction_holds(self.sign(&side.of)?, || self.sign(&side.tie), s)
            }
            _ => Some(true),
        }
    }

    /// Whether a case holds; `None` where a sign is not known.
    fn holds(&self, side: &Side, case: &Case) -> Option<bool> {
        if !self.goes(side, case)? {
            return Some(false);
        }
        let mut all = true;
        for when in case.conditions.iter().flat_map(|bound| &bound.when) {
            all &= satisfied(self.sign(&when.of)?, when);
        }
        Some(all)
    }
}

fn direction_holds(
    of: std::cmp::Ordering,
    tie: impl Fn() -> Option<std::cmp::Ordering>,
    s: i64,
) -> Option<bool> {
    let decides = if of.is_eq() { tie()? } else { of };
    Some(decides.is_ge() == (s > 0))
}

/// Whether a condition holds as it is told; `None` where a side has no exact value.
fn stated(bound: &Bound, at: &Point<Rational>) -> Option<bool> {
    let order = bound.left.evaluate(at)?.cmp(&bound.right.evaluate(at)?);
    match bound.relation {
        Relation::Less => Some(order.is_lt()),
        Relation::LessEqual => Some(order.is_le()),
        Relation::Greater => Some(order.is_gt()),
        Relation::GreaterEqual => Some(order.is_ge()),
        Relation::Equal | Relation::NotEqual | Relation::Approximately => None,
    }
}

fn satisfied(sign: std::cmp::Ordering, when: &When) -> bool {
    sign.is_gt() || !when.strict && sign.is_eq()
}

/// What is strange of an impact with friction at the values of its scene: that its law makes energy, that it jams.
pub fn strange(scene: &Scene) -> Vec<String> {
    let found = scene.friction();
    let Some(((contact, law), values)) = found.zip(found.and_then(|_| at_values(scene))) else {
        return Vec::new();
    };
    let gains = values.gain > ROUNDING * values.energy_before;
    let gains = gains.then(|| values.told(law.hypothesis.name()));
    let name = &scene.contacts[contact].name;
    let jams = values
        .jams
        .then(|| format!("at the values of the scene `{name}` {JAMS}"));
    gains.into_iter().chain(jams).collect()
}

/// What a contact does that jams.
pub const JAMS: &str = "jams (Painlevé)";

/// The impact at the values of the scene.
fn at_values(scene: &Scene) -> Option<AtValues> {
    if let Ok(point) = numeric::exact_values(scene)
        && let Ok((given, followed)) = followed(scene, &point, numeric::solve_exact)
    {
        return Some(at_values_of(&given, &followed.path, &to_f64));
    }
    let point = numeric::values(scene).ok()?;
    let (given, followed) = followed(scene, &point, numeric::solve_f64).ok()?;
    Some(at_values_of(&given, &followed.path, &|x: &f64| *x))
}

/// The energy of an impact, in doubles.
pub(super) fn at_values_of<T: Number>(
    given: &numeric::Given<T>,
    path: &Path<T>,
    double: &impl Fn(&T) -> f64,
) -> AtValues {
    AtValues {
        energy_before: double(&numeric::energy_before(given, None)),
        gain: double(&path.gain()),
        jams: path.jams,
    }
}

/// The path at a point; one without an end is told from a scene without numbers.
fn followed<T: Number + PartialOrd>(
    scene: &Scene,
    point: &Point<T>,
    solve: impl Fn(&numeric::System<T>) -> Result<numeric::Solution<T>, numeric::Contradiction>,
) -> Result<(numeric::Given<T>, Followed<T>), Option<NoPath>> {
    let given = numeric::given(scene, point).map_err(|_| None)?;
    match numeric::settle(&given, solve) {
        Ok(found) => found.ok_or(None),
        Err(numeric::NoAnswer::NoPath(why)) => Err(Some(why)),
        Err(_) => Err(None),
    }
}

/// At exact points: one case holds, and its impulse is that of the path. Energy is watched on the way.
fn against_path(scene: &Scene, table: &Table, checks: &mut Vec<Check>) {
    let needed = numeric::needed(scene);
    let mut seen: BTreeMap<(Mode, bool), usize> = BTreeMap::new();
    let mut compared = 0;
    let mut gains = 0;
    let mut wrong: Option<String> = None;
    for seed in 1..=POINTS {
        let exact = numeric::random_point(&needed, &scene.domains, seed);
        let outcome = match followed(scene, &exact, numeric::solve_exact) {
            Ok((_, followed)) => {
                gains += usize::from(followed.path.gain() > Number::zero());
                same(table, &exact, &exact, &followed.path.end().impulse, 0.0)
            }
            // Stronge's root is no fraction at most points: the mode is decided in fractions, the impulse in doubles.
            Err(Some(NoPath::Irrational)) => {
                let rounded = numeric::rounded(&exact);
                let Ok((_, followed)) = followed(scene, &rounded, numeric::solve_f64) else {
                    continue;
                };
                let impulse = &followed.path.end().impulse;
                let energy =
                    numeric::given(scene, &rounded).map(|g| numeric::energy_before(&g, None));
                let large = energy.unwrap_or(0.0) * 1e-12;
                gains += usize::from(followed.path.gain() > large);
                same(table, &exact, &rounded, impulse, 1e-9)
            }
            Err(Some(why @ (NoPath::NeverEnds | NoPath::Singular))) => {
                without_end(table, &exact, why)
            }
            Err(_) => continue,
        };
        match outcome {
            Ok(Some(case)) => {
                compared += 1;
                *seen.entry((table.called(case), case.ends)).or_default() += 1;
            }
            Ok(None) => {}
            Err(words) => wrong = Some(words),
        }
    }
    let modes = seen.iter().map(|((mode, ends), n)| match ends {
        true => format!("{} {n}", mode.words()),
        false => format!("{} and has no end {n}", mode.words()),
    });
    let modes = modes.collect::<Vec<String>>().join(", ");
    let (words, holds) = match (wrong, compared) {
        (Some(words), _) => (words, Some(false)),
        (None, 0) => {
            let words = "at none of the points tried are all values rational, which holding them against it takes";
            (words.into(), None)
        }
        (None, n) => {
            let where_it = "one case holds and ends where Routh's path ends";
            (
                format!("at {n} exact points {where_it} ({modes})"),
                Some(true),
            )
        }
    };
    checks.push(Check::new("path", words, holds));
    checks.push(energy(&table.law, gains, compared));
}

/// Whether energy is gained: a fault of the cases where the hypothesis excludes it, and told of one that allows it.
fn energy(law: &Friction, gains: usize, points: usize) -> Check {
    let name = law.hypothesis.name();
    match (gains, law.hypothesis.may_gain()) {
        (0, _) => Check::new(
            "energy",
            format!("no energy is gained at {points} points"),
            (points > 0).then_some(true),
        ),
        (n, false) => Check::new(
            "energy",
            format!(
                "energy is gained at {n} of {points} points, which {name}'s hypothesis excludes"
            ),
            Some(false),
        ),
        (n, true) => Check::new(
            "energy",
            format!(
                "energy is gained at {n} of {points} points of the domain: {name}'s hypothesis does not fit friction there"
            ),
            None,
        ),
    }
}

/// The one case that holds at a point where the path has no end, if it is one without. Of a path whose equations are
/// singular, as where a corner neither rises nor falls, a case that ends says nothing.
fn without_end<'a>(
    table: &'a Table,
    exact: &Point<Rational>,
    why: NoPath,
) -> Result<Option<&'a Case>, String> {
    let has_value = |case: &Case| case.impulse.iter().all(|p| p.evaluate(exact).is_some());
    let says_nothing = |case: &Case| matches!(why, NoPath::Singular) || !has_value(case);
    match holding(table, exact)? {
        Some(case) if case.ends && says_nothing(case) => Ok(None),
        Some(case) if case.ends => Err(format!(
            "`{}` holds at one point where the path has no end",
            table.called(case).words()
        )),
        found => Ok(found),
    }
}

/// The one case that holds at a point; `None` where it has no value there.
fn holding<'a>(table: &'a Table, exact: &Point<Rational>) -> Result<Option<&'a Case>, String> {
    let sign = |e: &Expr| e.evaluate(exact).map(|x| x.cmp(&Number::zero()));
    let mut holding = Vec::new();
    for case in &table.cases {
        let Some(of) = sign(&table.side.of) else {
            return Ok(None);
        };
        let tie = || sign(&table.side.tie);
        let mut all = match case.direction {
            Direction::Asked(s) => direction_holds(of, tie, s).unwrap_or(false),
            Direction::Only(_) | Direction::Follows(_) | Direction::Either => true,
        };
        for bound in &case.conditions {
            let each = bound
                .when
                .iter()
                .map(|when| Some(satisfied(sign(&when.of)?, when)));
            let Some(each) = each.collect::<Option<Vec<bool>>>() else {
                return Ok(None);
            };
            let holds = each.iter().all(|holds| *holds);
            // As it is told, solved for μ where that is possible, it must say the same.
            if stated(bound, exact).is_some_and(|told| told != holds) {
                return Err(format!(
                    "a condition of `{}` says something else than its law at one point",
                    table.called(case).words()
                ));
            }
            all &= holds;
        }
        if all {
            holding.push(case);
        }
    }
    match holding.as_slice() {
        [case] => Ok(Some(case)),
        all => Err(format!("{} cases hold at one point", all.len())),
    }
}

/// The one case that holds at a point, if its impulse is the one given; `None` where it has no value there.
fn same<'a, T: Number>(
    table: &'a Table,
    exact: &Point<Rational>,
    at: &Point<T>,
    impulse: &[T; 2],
    tolerance: f64,
) -> Result<Option<&'a Case>, String> {
    let Some(case) = holding(table, exact)? else {
        return Ok(None);
    };
    if !case.ends {
        return Err(format!(
            "the path ends at one point where `{}` has no end",
            table.called(case).words()
        ));
    }
    let [Some(p_t), Some(p_n)] = [0, 1].map(|i| case.impulse[i].evaluate(at)) else {
        return Ok(None);
    };
    let length = impulse[0].size() + impulse[1].size();
    for (derived, followed) in [p_t, p_n].iter().zip(impulse) {
        let gap = derived.minus(followed);
        if !gap.is_zero() && gap.size() > tolerance * length {
            return Err(format!(
                "`{}` gives another impulse than the path at one point",
                table.called(case).words()
            ));
        }
    }
    Ok(Some(case))
}
