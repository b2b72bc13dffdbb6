//! How an impact changes the motion of bodies, in words.
//!
//! In: a stage and one outcome. Out: a clause for each body whose change can be told; where its sense depends on the values,
//! the formulas say more than words.

use super::{Case, StageTold};
use crate::algebra::Sign;
use crate::answer::calc::{essential, is_zero, proved};
use crate::domain::Domains;
use crate::expr::{Expr, Vector, dot, minus};
use crate::formula::{Sentence, listed, sentence};
use crate::scene::{StageKind, Strung};
use crate::story::UNDETERMINED;

/// What becomes of every body that moves; those of which the same is said stand together.
pub(super) fn words(told: &StageTold, case: &Case) -> Vec<String> {
    let scene = &told.placed.scene;
    let given: Vec<&Expr> = case.conditions.iter().map(|(_, e)| e).collect();
    let supposed = |domains: Domains, e: &&Expr| domains.given(e, true);
    let domains = given.iter().fold(scene.domains.clone(), supposed);
    let bodies = scene.bodies.iter().enumerate();
    let mut all: Vec<(Clause, Vec<String>)> = Vec::new();
    for (b, body) in bodies.filter(|(_, body)| !body.is_fixed()) {
        let change = Change {
            told,
            case,
            b,
            domains: &domains,
            given: &given,
        };
        let Some(clause) = change.words(&body.name, body.is_particle()) else {
            continue;
        };
        let name = format!("`{}`", body.name);
        match all.iter_mut().find(|(c, _)| *c == clause) {
            Some((_, names)) => names.push(name),
            None => all.push((clause, vec![name])),
        }
    }
    let told = all.into_iter();
    told.map(|(clause, names)| clause.of(&names)).collect()
}

/// Which strings of the motion before an impact lets go slack: the end that drew does not keep up with the other one.
pub(super) fn slack(told: &StageTold, before: &StageTold) -> Option<Sentence> {
    let (StageKind::Slide(slide), [case]) = (&before.placed.kind, told.cases.as_slice()) else {
        return None;
    };
    let scene = &told.placed.scene;
    let is_positive = |e: &Expr| proved(e, &scene.domains) == Some(Sign::Positive);
    let speed = |b: usize, along: &Vector| dot(&case.after.velocity[b], along) / dot(along, along);
    let loosens = |string: &&Strung| {
        let (Some(first), Some(last)) = (string.over.first(), string.over.last()) else {
            return false;
        };
        let [head, tail] = [
            (slide.body, &slide.along, first),
            (string.to[0], &string.along, last),
        ];
        let centers = &told.before.center;
        let [head_draws, tail_draws] = [head, tail].map(|(b, along, pulley)| {
            is_positive(&dot(&minus(&centers[b], &centers[*pulley]), along))
        });
        let lead = &speed(head.0, head.1) - &speed(tail.0, tail.1);
        head_draws != tail_draws && is_positive(&if head_draws { -lead } else { lead })
    };
    let strings = slide.strings.iter().filter(loosens);
    let over = strings.flat_map(|s| &s.over);
    let over: Vec<String> = over
        .map(|b| format!("`{}`", scene.bodies[*b].name))
        .collect();
    let slack = sentence!("the string over {} goes slack", listed(&over));
    (!over.is_empty()).then_some(slack)
}

/// What is said of a body.
#[derive(PartialEq)]
enum Clause {
    /// Of one or several by their names, between what stands before and what stands behind.
    Around([String; 2]),
    /// Of one alone.
    Alone(String),
}

impl Clause {
    fn of(&self, names: &[String]) -> String {
        let who = listed(names);
        match self {
            Clause::Alone(words) => words.clone(),
            Clause::Around([before, behind]) if names.len() == 1 => {
                format!("{before}{who}{behind}")
            }
            Clause::Around([before, behind]) => {
                let words: Vec<&str> = behind.split(' ').map(of_several).collect();
                format!("{before}{who}{}", words.join(" "))
            }
        }
    }
}

/// A word of what a body does as it stands for several.
fn of_several(word: &str) -> &str {
    match word {
        "does" => "do",
        "its" => "their",
        "velocity" => "velocities",
        "moves" | "comes" | "stays" | "keeps" => &word[..word.len() - 1],
        _ => word,
    }
}

/// Which way something goes.
enum Way<'w> {
    /// This way.
    Sure(&'w str),
    /// This way, or it is zero; and the opposite.
    NotBack([&'w str; 2]),
}

/// The change of one body, where the conditions of its outcome hold.
struct Change<'a> {
    told: &'a StageTold,
    case: &'a Case,
    b: usize,
    domains: &'a Domains,
    given: &'a [&'a Expr],
}

impl Change<'_> {
    fn words(&self, name: &str, is_particle: bool) -> Option<Clause> {
        let (before, after) = (&self.told.before, &self.case.after);
        let parts = [before, after].map(|s| s.velocity[self.b].iter().chain([&s.spin[self.b]]));
        if let Some(why) = after.why_open(parts.into_iter().flatten()) {
            let around = match why.strip_suffix(UNDETERMINED) {
                Some(laws) => [format!("{laws} do not determine how "), " moves".into()],
                None => ["how ".into(), format!(" moves is not determined: {why}")],
            };
            return Some(Clause::Around(around));
        }
        let (v0, v1) = (&before.velocity[self.b], &after.velocity[self.b]);
        let zero = |v: &[Expr; 2]| v.iter().all(|c| is_zero(c, self.domains) == Some(true));
        let [keeps, rests] = [zero(&minus(v0, v1)), zero(v1)];
        let moves = match (keeps, rests) {
            (true, true) => Some(String::from("stays at rest")),
            (true, false) => Some(String::from("keeps its velocity")),
            (false, true) => Some(String::from("comes to rest")),
            (false, false) => self.moving(v0, v1),
        };
        if is_particle {
            return moves.map(|moves| Clause::Around([String::new(), format!(" {moves}")]));
        }
        let (w0, w1) = (&before.spin[self.b], &after.spin[self.b]);
        let [spins_on, still] =
            [w0 - w1, w1.clone()].map(|w| is_zero(&w, self.domains) == Some(true));
        let turns = self.turning(w0, w1);
        if let Some(turns) = turns.as_ref().filter(|_| self.is_pinned()) {
            return Some(Clause::Alone(format!("`{name}` {turns}")));
        }
        // Of a body that a joint holds at its center only the spin is worth a word.
        Some(Clause::Alone(match (keeps, rests, spins_on, still) {
            (_, true, true, true) => format!("`{name}` {}", moves?),
            (true, false, true, _) => format!("`{name}` moves on as before"),
            (true, true, ..) => format!("`{name}` {}", turns?),
            _ => match (moves, turns) {
                (Some(moves), Some(turns)) => {
                    format!("the center of mass of `{name}` {moves}, and `{name}` {turns}")
                }
                (Some(moves), None) => format!("the center of mass of `{name}` {moves}"),
                (None, Some(turns)) => format!("`{name}` {turns}"),
                (None, None) => return None,
            },
        }))
    }

    /// Whether a hinge to a fixed body leaves it nothing but to turn.
    fn is_pinned(&self) -> bool {
        let scene = &self.told.placed.scene;
        let is_fixed = |b: &usize| scene.bodies[*b].is_fixed();
        let mut hinges = scene.hinges.iter().map(|h| h.bodies);
        hinges.any(|all| all.contains(&self.b) && all.iter().any(is_fixed))
    }

    /// Which way a velocity points, as far as its signs are known.
    fn moving(&self, before: &[Expr; 2], v: &[Expr; 2]) -> Option<String> {
        let words = [["to the right", "to the left"], ["up", "down"]];
        let is_zero = |e: &Expr| is_zero(e, self.domains) == Some(true);
        let others: Vec<_> = v.iter().zip(words).filter(|(e, _)| !is_zero(e)).collect();
        let known: Vec<_> = others.iter().map(|(e, w)| self.one_of(e, *w)).collect();
        if let [Some(Way::NotBack([way, _]))] = known.as_slice() {
            let rest = match before.iter().all(is_zero) {
                true => "stays at rest",
                false => "comes to rest",
            };
            return Some(format!("moves {way} or {rest}"));
        }
        let (mut sure, mut open, mut not) = (Vec::new(), Vec::new(), Vec::new());
        for way in known.into_iter().flatten() {
            match way {
                Way::Sure(way) => sure.push(way),
                Way::NotBack([way, back]) => {
                    open.push(way);
                    not.push(back);
                }
            }
        }
        let ways = sure.join(" and ");
        match (ways.is_empty(), open.as_slice()) {
            (true, []) => None,
            (true, [one, other]) => Some(format!("moves {one} and {other}, if at all")),
            (true, _) => Some(format!("does not move {}", not.join(""))),
            (false, []) => Some(format!("moves {ways}")),
            (false, open) => Some(format!("moves {ways}, and {} if at all", open.join(""))),
        }
    }

    /// The word for a value above zero, or below; nothing where its sign depends on the values.
    fn one_of<'w>(&self, e: &Expr, [plus, minus]: [&'w str; 2]) -> Option<Way<'w>> {
        let proved = proved(e, self.domains);
        match (above(proved, e, self.domains, self.given), proved) {
            (Some(true), _) => Some(Way::Sure(plus)),
            (Some(false), _) => Some(Way::Sure(minus)),
            (None, Some(Sign::NotNegative)) => Some(Way::NotBack([plus, minus])),
            (None, Some(Sign::NotPositive)) => Some(Way::NotBack([minus, plus])),
            (None, _) => None,
        }
    }

    fn way(&self, e: &Expr) -> Option<bool> {
        way(e, self.domains, self.given)
    }

    /// How the spin changes, as what the body does; nothing where its sense depends on the values.
    fn turning(&self, before: &Expr, after: &Expr) -> Option<String> {
        if is_zero(&(before - after), self.domains) == Some(true) {
            return Some(String::from(match is_zero(after, self.domains) {
                Some(true) => "does not turn",
                _ => "goes on turning as before",
            }));
        }
        if is_zero(after, self.domains) == Some(true) {
            return Some(String::from("stops turning"));
        }
        let begins = is_zero(before, self.domains) == Some(true);
        let sense = match self.one_of(after, ["counterclockwise", "clockwise"])? {
            Way::Sure(sense) if begins => return Some(format!("begins to turn {sense}")),
            Way::NotBack([sense, _]) if begins => {
                return Some(format!("begins to turn {sense} or does not turn"));
            }
            Way::Sure(sense) => sense,
            Way::NotBack([sense, _]) => return Some(format!("turns {sense} or stops turning")),
        };
        if let (Some(a), Some(b)) = (self.way(before), self.way(after))
            && a != b
        {
            return Some(format!("turns the other way, {sense}"));
        }
        Some(match self.way(&(&after.powi(2) - &before.powi(2))) {
            Some(true) => format!("turns {sense}, faster than before"),
            Some(false) => format!("turns {sense}, more slowly than before"),
            None => format!("turns {sense}"),
        })
    }
}

/// Whether a value is above zero where some others are not negative; `None` where that is not known. What was only seen at
/// points is not said.
pub(super) fn way(e: &Expr, domains: &Domains, given: &[&Expr]) -> Option<bool> {
    above(proved(e, domains), e, domains, given)
}

/// The same of a value whose sign may be proved.
fn above(proved: Option<Sign>, e: &Expr, domains: &Domains, given: &[&Expr]) -> Option<bool> {
    match proved {
        Some(Sign::Positive) => return Some(true),
        Some(Sign::Negative) => return Some(false),
        _ if given.is_empty() => return None,
        _ => {}
    }
    let rest = essential(e, domains);
    let is_given = |f: &Expr| {
        let mut all = given.iter();
        all.any(|g| is_zero(&(f - *g), domains) == Some(true))
    };
    match (is_given(&rest), is_given(&-&rest)) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    }
}
