//! What letters of a whole solution stand for, before any line of it is judged: accelerations, velocities along the normal, and
//! names that it also writes with a mark.

use std::collections::{BTreeMap, BTreeSet};

use super::super::sheet::Sheet;
use super::Desk;
use crate::algebra::{Sign, sign};
use crate::dimension::{self, Dimension};
use crate::expr::{Expr, Symbol, dot, only};
use crate::formula::{self, Content, Reading, Symbols};
use crate::scene::{Ask, StageKind};

/// Most accelerations that one letter is tried as.
const MOST_WAYS: usize = 6;
/// What people call an acceleration, along a line or of a center of mass.
pub(super) const ACCELERATIONS: [&str; 9] = [
    "a", "a_G", "a_cm", "a_CM", "a_C", "a_c", "a_S", "a_x", "a_y",
];

/// The acceleration of a center where its letter alone is asked for as that of a turn.
pub(super) const OF_CENTER: &str = "a_G";

/// Marks behind a name that tell the moment just after.
pub(super) const MARKS: [&str; 2] = ["'", "^{+}"];

/// Whether a side is a name and nothing else.
fn is_alone(side: &Content, name: &str) -> bool {
    side.name().is_some_and(|symbol| &**symbol == name)
}

/// The equations of a worked solution that can be read by themselves.
pub(super) fn readings(sheet: &Sheet, text: &str) -> Vec<Reading> {
    let mut symbols = Symbols::open();
    sheet.declare(&mut symbols);
    let parts = super::pages::all_equations(text);
    parts
        .filter_map(|part| formula::read(part, &symbols).ok())
        .collect()
}

/// The names in them.
pub(super) fn used(sheet: &Sheet, text: &str) -> BTreeSet<Symbol> {
    let readings = readings(sheet, text);
    readings.iter().flat_map(Reading::symbols).collect()
}

/// What is asked that a worked solution writes with a mark as well, and the mark: it may be of another moment with it.
pub(super) fn marked(sheet: &Sheet, text: &str) -> BTreeSet<(Symbol, &'static str)> {
    let used = used(sheet, text);
    let both = |name: &Symbol, mark: &str| {
        let with = format!("{name}{mark}");
        let short = with.replace(['{', '}'], "");
        used.contains(name) && (used.contains(&*with) || used.contains(&*short))
    };
    let asked = sheet.derivation.answers.iter();
    let asked = asked.map(|answer| Symbol::from(answer.name.as_str()));
    let all = asked.flat_map(|name| MARKS.map(|mark| (name.clone(), mark)));
    all.filter(|(name, mark)| both(name, mark)).collect()
}

/// Those of them that are asked before the last impact: with a prime they are of a later moment.
pub(super) fn of_a_later_moment(sheet: &Sheet, text: &str) -> BTreeSet<(Symbol, &'static str)> {
    let Some(last) = sheet.impacts.last() else {
        return BTreeSet::new();
    };
    let is_last = |name: &Symbol| last.questions.iter().any(|q| q.part(name).is_some());
    let mut marked = marked(sheet, text);
    marked.retain(|(name, mark)| *mark == "'" && !is_last(name));
    marked
}

/// The accelerations that such a name in a worked solution may stand for, counted either way: those of the scene, where it
/// has no such name itself and the solution says that of nothing else. `None` stands for whatever the solution says it is.
pub(super) fn accelerations(sheet: &Sheet, text: &str) -> Vec<Option<(Symbol, Expr)>> {
    let scene = &sheet.scene;
    let asked = sheet.derivation.answers.iter().map(|answer| &*answer.name);
    let taken: BTreeSet<&str> = (scene.parameters.iter().map(|p| &*p.name))
        .chain(asked)
        .collect();
    if sheet.accelerations.is_empty() {
        return vec![None];
    }
    let rate = Dimension::new(0, 1, -2);
    let of = |name: &str| Some(scene.parameter(name)?.dimension.clone());
    let is_rate = |side: &Content| match side.expr().map(|e| dimension::of(e, &of)) {
        Some(Ok(Some(found))) => found == rate,
        _ => true,
    };
    let readings = readings(sheet, text);
    let used = used(sheet, text);
    let free = |name: &&&str| !taken.contains(**name) && used.contains(**name);
    let along = ACCELERATIONS.iter().find(free);
    let turns = turning(sheet, text).filter(|_| along.is_none());
    let Some((name, letter)) = along.map(|a| (*a, *a)).or(turns.map(|a| (OF_CENTER, a))) else {
        return vec![None];
    };
    let fits = readings.iter().all(|reading| match &reading.content {
        Content::Relations(sides, _) if is_alone(&sides[0], letter) => {
            sides[1..].iter().all(is_rate)
        }
        _ => true,
    });
    if !fits {
        return vec![None];
    }
    // Bodies that turn, fall or press a spring have others.
    let steady = |kind: &StageKind| match kind {
        StageKind::Impact { .. } => true,
        StageKind::Slide(slide) => slide.spring.is_none() && slide.on.is_none(),
        _ => false,
    };
    let all = scene.stages.iter().all(|stage| steady(&stage.kind));
    let each = sheet.accelerations.iter();
    let both = each.flat_map(|value| [value.clone(), -value]);
    let named = both.map(|value| Some((Symbol::from(name), value)));
    (turns.map(|_| None).into_iter())
        .chain(named.take(MOST_WAYS))
        .chain((!all && turns.is_none()).then_some(None))
        .collect()
}

/// An angular acceleration that is asked for by a letter with which a worked solution may mean that of a center.
pub(super) fn turning<'s>(sheet: &'s Sheet, text: &str) -> Option<&'s str> {
    let used = used(sheet, text);
    let mut asked = sheet.scene.questions.iter().filter(|q| {
        let turns = matches!(q.ask, Ask::AngularAcceleration { .. });
        turns && ACCELERATIONS.contains(&&*q.name) && used.contains(&*q.name)
    });
    let asked = asked.next()?;
    (!used.contains(OF_CENTER)).then_some(&*asked.name)
}

impl Desk<'_> {
    /// Velocities that are asked for along the one normal of the scene and its tangent, as in v_{1n} and v_{1t}, unless the solution
    /// says itself what such a name is.
    pub(super) fn along_normal(&mut self, text: &str) {
        let text = text.replace(['_', '{', '}'], "");
        let scene = &self.sheet.scene;
        let normals = scene.contacts.iter().filter_map(|c| c.normal.as_ref());
        let Some([x, y]) = only(normals) else {
            return;
        };
        let has_time = scene.parameter("t").is_some() || scene.question("t").is_some();
        let tangent = (!has_time).then(|| self.tangent(&text, [-y, x.clone()]));
        let axes = [("n", Some([x.clone(), y.clone()])), ("t", tangent)];
        let both = |q| axes.each_ref().map(|axis| (q, axis));
        for (q, (axis, along)) in scene.questions.iter().flat_map(both) {
            let name = Symbol::from(format!("{}_{axis}", q.name));
            // `v1_n` and `v_{1n}` are one name, the student's own where it comes first with what it is.
            let joined = name.replace('_', "");
            let first = text.split_once(&*joined);
            let in_sum = |before: &str| before.trim_end().ends_with(['+', '-', '−', '*', '·']);
            let said = first.is_some_and(|(before, behind)| {
                *axis == "n" && behind.trim_start().starts_with('=') && !in_sum(before)
            });
            let used = *axis == "n" || first.is_some();
            if let Ask::Velocity { along: None, .. } = q.ask
                && !said
                && used
                && let Some(along) = along
                && let Some([x, y, _]) = self.components(&q.name)
            {
                let along = dot(&[x, y], along);
                self.linked.push(Expr::symbol(&name) - &along);
                let along = along.substitute(&self.closed);
                self.closed.insert(name, along);
            }
        }
    }

    /// The tangent on the side that a line `v_{1t} = …` counts by; else that to which something moves along it at first.
    fn tangent(&self, text: &str, [x, y]: [Expr; 2]) -> [Expr; 2] {
        let scene = &self.sheet.scene;
        let symbols = self.symbols("");
        let along = |v: [&Expr; 2], axis: &[Expr; 2]| v[0] * &axis[0] + v[1] * &axis[1];
        let axis = [x, y];
        let said = scene.questions.iter().find_map(|q| {
            let [x, y, _] = self.components(&q.name)?;
            let (_, behind) = text.split_once(&format!("{}t", q.name.replace('_', "")))?;
            let value = behind.trim_start().strip_prefix('=')?.lines().next()?;
            let value = formula::read(value, &symbols).ok()?.expr()?.clone();
            let truth = self.truth(&along([&x, &y], &axis));
            (!truth.is_zero()).then(|| self.is_zero(&(value + truth)))
        });
        let mut before = scene
            .bodies
            .iter()
            .map(|b| along(b.velocity.each_ref(), &axis));
        let negative = |e: Expr| sign(&e, &scene.domains) == Some(Sign::Negative);
        match said.unwrap_or_else(|| before.any(negative)) {
            true => axis.map(|part| -part),
            false => axis,
        }
    }

    /// The accelerations of the other motions, counted as the one that a letter stands for.
    pub(super) fn know_accelerations(&mut self, meant: Option<&(Symbol, Expr)>) {
        let Some((name, value)) = meant.filter(|(name, _)| ACCELERATIONS.contains(&&**name)) else {
            return;
        };
        // With a prime it is that of another motion.
        let marks = MARKS.map(|mark| (name.clone(), mark));
        self.own_with_mark.extend(marks);
        let all = &self.sheet.accelerations;
        let turned = !all.contains(value);
        let others = all
            .iter()
            .map(|other| if turned { -other } else { other.clone() });
        let others = others.filter(|other| other != value).take(MOST_WAYS);
        let moments = others.map(|other| {
            let when = String::from("in another motion");
            (when, BTreeMap::from([(name.clone(), other)]))
        });
        self.moments.extend(moments.collect::<Vec<_>>());
    }
}
