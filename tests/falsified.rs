//! Checks that can fail: each kind of check is given inputs that are wrong, and must refuse every one.
//!
//! The tables in `tests/falsified/` say what is falsified and how; scenes that are not possible stand in `tests/possible/`, wrong
//! printed answers in `tests/printed/`.

use crate::equality::reader;
use crate::shared;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use carom::algebra::{Field, Sign};
use carom::answer::Form;
use carom::derive::{Derivation, derive};
use carom::equality::{Equality, decide};
use carom::expr::{Expr, Point, Rational, ratio};
use carom::grade::Options;
use carom::interval::{Interval, Outcome, evaluate};
use carom::numeric::{self, Motion};
use carom::scene::{self, Ask, Extremum, Scene, Shape};
use carom::verify::{Trust, prove, trust};
use carom::{check, command, render, solution, story, worked};
use rayon::prelude::*;

/// The rows of a table, cell by cell.
fn rows(name: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(format!("tests/falsified/{name}.tsv")).expect("a table");
    let lines = text
        .lines()
        .filter(|l| !l.starts_with('#') && !l.is_empty());
    lines
        .map(|l| l.split('\t').map(str::to_owned).collect())
        .collect()
}

/// The shipped scenes with their text, refused ones aside.
fn shipped() -> Vec<(String, String, Scene)> {
    let files = shared::files("derivations", "json");
    let read = |path: PathBuf| {
        let text = fs::read_to_string(&path).expect("a scene file");
        let scene = scene::read(&text).expect("a sound scene");
        (path.display().to_string(), text, scene)
    };
    files.into_iter().map(read).collect()
}

/// The value that a change makes of `x`.
fn changed(change: &str, x: &Expr) -> Expr {
    reader::formula(change).substitute(&BTreeMap::from([("x".into(), x.clone())]))
}

/// The derivation with one thing falsified, for every thing of that part in which the change shows.
fn falsified(derivation: &Derivation, part: &str, change: &str) -> Vec<(String, Derivation)> {
    let mut all = Vec::new();
    if part == "motion" {
        for (unknown, value) in &derivation.motion {
            let wrong = changed(change, value);
            let mut other = derivation.clone();
            other.motion.insert(*unknown, wrong.clone());
            if wrong != *value {
                all.push((format!("{unknown:?}"), other));
            }
        }
        return all;
    }
    for (i, answer) in derivation.answers.iter().enumerate() {
        let Form::Value { closed, short } = &answer.form else {
            continue;
        };
        let mut other = derivation.clone();
        let (right, wrong, form) = if part == "closed" {
            let wrong = changed(change, closed);
            let short = if closed == short {
                wrong.clone()
            } else {
                short.clone()
            };
            (
                closed,
                wrong.clone(),
                Form::Value {
                    closed: wrong,
                    short,
                },
            )
        } else {
            let wrong = changed(change, short);
            let closed = closed.clone();
            (
                short,
                wrong.clone(),
                Form::Value {
                    closed,
                    short: wrong,
                },
            )
        };
        other.answers[i].form = form;
        if wrong != *right {
            all.push((answer.name.clone(), other));
        }
    }
    all
}

#[test]
fn a_falsified_derivation_is_refused_by_the_check_that_is_for_it() {
    let mut refused: BTreeMap<String, usize> = BTreeMap::new();
    for (path, _, scene) in shipped() {
        if scene.has_stages() {
            continue;
        }
        let derivation = derive(&scene).expect("a derivation");
        assert_eq!(
            trust(&derivation, &prove(&scene, &derivation)),
            Trust::Proved,
            "{path}"
        );
        for row in rows("derivations") {
            let [part, change, kind, reason] = [0, 1, 2, 3].map(|i| row[i].as_str());
            // One of the first answers and one of the last: each scene's answers go through the same checks.
            let mut all = falsified(&derivation, part, change);
            if all.len() > 2 {
                all = vec![all.swap_remove(0), all.swap_remove(all.len() - 1)];
            }
            for (name, wrong) in all {
                let proof = prove(&scene, &wrong);
                let checks = proof.scene.iter().chain(proof.answers.iter().flatten());
                let caught = checks
                    .filter(|c| c.kind == kind)
                    .any(|c| c.holds == Some(false));
                assert!(
                    caught && !proof.holds() && matches!(trust(&wrong, &proof), Trust::Refuted(_)),
                    "{path}, {part} {name}, {reason}: {proof:?}"
                );
                *refused
                    .entry(format!("{part} {change} {kind}"))
                    .or_default() += 1;
            }
        }
    }
    assert!(refused.values().all(|n| *n >= 10), "{refused:?}");
    assert_eq!(refused.len(), rows("derivations").len(), "{refused:?}");
}

/// A rod with a bead at its end, struck across.
const JOINED: &str = r#"{"title": "rod and bead", "parameters": {"m": {"unit": "kg"}, "l": {"unit": "m"}, "J": {"unit": "N s"}},
    "points": {"O": ["0", "0"], "B": ["l/2", "0"]},
    "bodies": {"club": {"shape": "composite", "parts": {
        "rod": {"shape": "rod", "mass": "m", "length": "l", "center": "O"}, "bead": {"shape": "particle", "mass": "2*m", "center": "B"}}}},
    "blows": {"F": {"on": "club", "at": "B", "impulse": ["0", "J"]}},
    "questions": {"omega": {"spin": "club"}, "v": {"velocity": "club"}}}"#;

#[test]
fn a_falsified_body_is_refused_by_its_outline() {
    let mut refused: BTreeMap<String, usize> = BTreeMap::new();
    let joined = scene::read(JOINED).expect("a sound scene");
    let single = shipped().into_iter().filter(|(_, _, s)| !s.has_stages());
    let all = single.map(|(path, _, scene)| (path, scene));
    for (path, scene) in all.chain([(String::from("a club"), joined)]) {
        for row in rows("bodies") {
            let [what, change, reason] = [0, 1, 2].map(|i| row[i].as_str());
            for (b, body) in scene.bodies.iter().enumerate() {
                let joined = matches!(body.shape, Shape::Composite { .. });
                let outlined = !matches!(body.shape, Shape::Fixed | Shape::Particle | Shape::Other);
                let mut wrong = scene.clone();
                let target = match what {
                    "inertia" if outlined && !body.inertia_given => &mut wrong.bodies[b].inertia,
                    "mass" if joined => &mut wrong.bodies[b].mass,
                    "center" if joined => &mut wrong.bodies[b].center[0],
                    _ => continue,
                };
                let right = target.clone();
                *target = changed(change, &right);
                if *target == right {
                    continue;
                }
                // Laws and numeric solution agree with each other, and are both wrong.
                let derivation = derive(&wrong).expect("a derivation");
                let proof = prove(&wrong, &derivation);
                let caught = |c: &&carom::answer::Check| c.holds == Some(false);
                let kinds: Vec<&str> = proof.scene.iter().filter(caught).map(|c| c.kind).collect();
                assert_eq!(kinds, ["inertia"], "{path}, {}, {reason}", body.name);
                *refused.entry(format!("{what} {change}")).or_default() += 1;
            }
        }
    }
    assert_eq!(refused.len(), rows("bodies").len(), "{refused:?}");
}

/// A scene's exact values, or a random exact point, with the motion there.
fn exact(scene: &Scene) -> Option<(numeric::Given<Rational>, Motion<Rational>)> {
    let needed = numeric::needed(scene);
    (1..20).find_map(|seed| {
        let point = numeric::random_point(&needed, &scene.domains, seed);
        let given = numeric::given(scene, &point).ok()?;
        let system = numeric::assemble(&given);
        let solution = numeric::solve_exact(&system).ok()?;
        let motion = numeric::motion(&given, &system, &solution);
        motion.loose.is_empty().then_some((given, motion))
    })
}

#[test]
fn a_falsified_motion_violates_a_balance_or_a_law() {
    let mut refused = 0;
    for (path, _, scene) in shipped() {
        let Some((given, motion)) = exact(&scene) else {
            continue;
        };
        let held = numeric::identities(&given, &motion);
        assert!(held.iter().all(|i| i.holds(0.0)), "{path}");
        for row in rows("motions") {
            let by: Rational = match row[1].split_once('/') {
                Some((n, d)) => ratio(n.parse().expect("a number"), d.parse().expect("a number")),
                None => unreachable!("a fraction"),
            };
            for b in 0..scene
                .bodies
                .len()
                .max(motion.contact.len())
                .max(motion.hinge.len())
            {
                let mut wrong = motion.clone();
                let free = scene.bodies.get(b).is_some_and(|b| !b.is_fixed());
                let turns = free && !scene.bodies[b].is_particle();
                let target = match row[0].as_str() {
                    "velocity x" if free => Some(&mut wrong.velocity[b][0]),
                    "velocity y" if free => Some(&mut wrong.velocity[b][1]),
                    "spin" if turns => Some(&mut wrong.spin[b]),
                    "contact" => wrong.contact.get_mut(b).map(|p| &mut p[0]),
                    "hinge" => wrong.hinge.get_mut(b).map(|p| &mut p[1]),
                    _ => None,
                };
                let Some(target) = target else { continue };
                *target = &*target + &by;
                let all = numeric::identities(&given, &wrong);
                assert!(
                    !all.iter().all(|i| i.holds(0.0)),
                    "{path}, {} of {b}",
                    row[0]
                );
                refused += 1;
            }
        }
    }
    assert!(refused > 100, "{refused}");
}

/// The written solution of a scene, as data.
fn written(text: &str, scene: &Scene) -> serde_json::Value {
    let detail = solution::Detail::Normal;
    let solution = worked::out(scene)
        .expect("a scene that is worked out")
        .solution(detail);
    render::steps::solution(&solution, text, &[])
}

/// What was falsified: how many of each kind were refused, and what was accepted.
#[derive(Default)]
struct Tried {
    refused: BTreeMap<String, usize>,
    passed: Vec<String>,
}

impl Tried {
    fn note(&mut self, is_refused: bool, kind: &str, words: impl FnOnce() -> String) {
        match is_refused {
            true => *self.refused.entry(kind.to_owned()).or_default() += 1,
            false => self.passed.push(words()),
        }
    }
}

/// Falsifies something in each shipped scene; a scene comes with its number, path and text.
fn over_shipped(
    each: impl Fn(&mut Tried, usize, &str, &str, &Scene) + Sync,
) -> (BTreeMap<String, usize>, Vec<String>) {
    let all = shipped().into_par_iter().enumerate();
    let all = all.map(|(k, (path, text, scene))| {
        let mut tried = Tried::default();
        each(&mut tried, k, &path, &text, &scene);
        tried
    });
    let both = all.reduce(Tried::default, |mut tried, other| {
        for (kind, count) in other.refused {
            *tried.refused.entry(kind).or_default() += count;
        }
        tried.passed.extend(other.passed);
        tried
    });
    (both.refused, both.passed)
}

#[test]
fn a_falsified_step_threshold_limit_or_motion_handed_on_is_refused() {
    let changes = rows("steps");
    let (refused, passed) = over_shipped(|tried, _, path, text, scene| {
        // Cases of friction in a scene of one impact have checks of their own, in `tests/friction`.
        if path.contains("friction") && !scene.has_stages() {
            return;
        }
        let json = written(text, scene);
        let caught = |tampered: &serde_json::Value| {
            let report = check::check(&tampered.to_string()).expect("a usable solution");
            !report.failed.is_empty()
        };
        let open = check::check(&json.to_string())
            .expect("a usable solution")
            .open;
        let steps = json["steps"].as_array().map_or(0, Vec::len);
        // Every third step, over all scenes each kind comes often enough, and all that define something.
        for i in 0..steps {
            let defines = json["steps"][i]["defines"].as_str();
            if i % 3 > 0 && defines.is_none() {
                continue;
            }
            let id = json["steps"][i]["id"].as_str().unwrap_or_default();
            let kind = json["steps"][i]["kind"]
                .as_str()
                .unwrap_or("step")
                .to_owned();
            if open.iter().any(|o| o == id) {
                continue;
            }
            // One change for each step, the next one for the next: a solution is replayed whole each time.
            let row = &changes[i / 3 % changes.len()];
            let mut tampered = json.clone();
            let Some(side) = tampered["steps"][i]["after"][0].get_mut("right") else {
                continue;
            };
            let Some(right) = side.as_str() else { continue };
            *side = row[0].replace('x', right).into();
            tried.note(caught(&tampered), &kind, || {
                format!("{path}, step {id}, {}", row[1])
            });
        }
        let impacts: Vec<&serde_json::Value> =
            json["impacts"].as_array().into_iter().flatten().collect();
        for (i, impact) in impacts.iter().enumerate() {
            // What friction does in one outcome is not what it does in another.
            let modes = impacts.iter().map(|other| &other["mode"]);
            for mode in modes.filter(|mode| mode.is_string() && **mode != impact["mode"]) {
                let mut tampered = json.clone();
                tampered["impacts"][i]["mode"] = mode.clone();
                tried.note(caught(&tampered), "mode of friction", || {
                    format!("{path}, impact {i}, {mode}")
                });
            }
            let moving = scene.bodies.iter().filter(|b| !b.is_fixed());
            for name in moving.map(|b| &b.name).take(1) {
                let mut tampered = json.clone();
                let place = &mut tampered["impacts"][i]["before"][name]["center"][0];
                let value = place.as_str().expect("a formula");
                // Farther by one length of the scene.
                let Some(length) = scene.parameters.iter().find(|p| p.unit == "m") else {
                    continue;
                };
                *place = format!("{value} + {}", length.name).into();
                tried.note(caught(&tampered), "place", || format!("{path}, {name}"));
            }
            for (list, kind) in [("handed", "handed on"), ("earlier", "earlier answer")] {
                let symbols = impact[list].as_object().into_iter().flatten();
                for (symbol, value) in symbols {
                    let mut tampered = json.clone();
                    let value = value.as_str().expect("a formula");
                    tampered["impacts"][i][list][symbol] = format!("1 + 2*({value})").into();
                    tried.note(caught(&tampered), kind, || {
                        format!("{path}, {symbol} {kind}")
                    });
                }
            }
        }
    });
    assert!(passed.is_empty(), "accepted:\n{}", passed.join("\n"));
    assert!(refused.values().sum::<usize>() > 150, "{refused:?}");
    for kind in ["handed on", "earlier answer", "mode of friction", "place"] {
        assert!(refused.contains_key(kind), "{refused:?}");
    }
}

#[test]
fn a_falsified_answer_is_refused_by_the_scene_followed_in_numbers() {
    let about = |ask: &Ask| {
        matches!(
            ask,
            Ask::Extremum { .. } | Ask::Limit { .. } | Ask::Approximate { .. } | Ask::Turn { .. }
        )
    };
    let (refused, passed) = over_shipped(|tried, k, path, _, scene| {
        // Every third scene, and all that ask for what is rare.
        if k % 3 > 0 && !scene.questions.iter().any(|q| about(&q.ask)) {
            return;
        }
        // Cases of friction in a scene of one impact have checks of their own, in `tests/friction`.
        let worked = shared::worked(Path::new(path)).as_ref();
        let worked = worked.unwrap_or_else(|why| panic!("{path}: {why}"));
        if worked.scene.has_stages() != scene.has_stages() {
            assert!(path.contains("friction"), "{path}");
            return;
        }
        let told = &worked.told;
        let sound = story::held(scene, told);
        for row in rows("steps") {
            let wrong = |e: &Expr| {
                let x = BTreeMap::from([("x".into(), e.clone())]);
                reader::formula(&row[0]).substitute(&x)
            };
            let mut told = told.clone();
            for answer in &mut told.answers {
                answer.form = answer.form.map(wrong);
                let values = answer.range.iter_mut().map(|(_, _, value)| value);
                let values = values.chain(answer.near.iter_mut().map(|near| &mut near.right));
                values.for_each(|value| *value = wrong(value));
            }
            let falsified = story::held(scene, &told);
            for (i, _) in sound.iter().filter(|(_, c)| c.holds == Some(true)) {
                let answer = &told.answers[*i];
                let question = scene.questions.iter().find(|q| q.name == answer.question);
                let kind = match &question.expect("a question").ask {
                    Ask::Condition { .. } => "threshold",
                    Ask::Extremum { which, .. } => match which {
                        Extremum::Largest => "largest value",
                        Extremum::Least => "least value",
                    },
                    Ask::Turn { .. } => "turn",
                    Ask::Limit { .. } | Ask::Approximate { .. } => "limit",
                    // Its sides are those of the file.
                    Ask::Show { .. } => continue,
                    Ask::Value { .. } => "value",
                    _ => "motion",
                };
                // Beyond a threshold a motion may never get to its end: then it is told that nothing was held against it.
                let holds = falsified.get(i).and_then(|check| check.holds);
                tried.note(holds != Some(true), kind, || {
                    format!("{path}, {}, {}", answer.name, row[1])
                });
            }
        }
    });
    assert!(passed.is_empty(), "accepted:\n{}", passed.join("\n"));
    for kind in [
        "threshold",
        "largest value",
        "least value",
        "limit",
        "turn",
        "value",
        "motion",
    ] {
        assert!(refused.contains_key(kind), "{refused:?}");
    }
}

#[test]
fn a_sign_is_not_told_where_a_point_of_the_domain_has_another() {
    for row in rows("signs") {
        let [e, domains, wrong, reason] = [0, 1, 2, 3].map(|i| row[i].as_str());
        let (e, domains) = (reader::formula(e), reader::domains(domains));
        let mut field = Field::new(&domains);
        field.prepare([&e]);
        let element = field.element(&e).expect("an element");
        let told = field.sign(&element).map(|sign| match sign {
            Sign::Positive => "positive",
            Sign::NotNegative => "nonnegative",
            Sign::Zero => "zero",
            Sign::NotPositive => "nonpositive",
            Sign::Negative => "negative",
        });
        assert!(
            !told.is_some_and(|t| wrong.split(' ').any(|w| w == t)),
            "{} is told to be {told:?}: {reason}",
            row[0]
        );
    }
}

#[test]
fn an_enclosure_holds_the_value_and_a_value_that_is_off_is_told_from_it() {
    let domains = carom::domain::Domains::default();
    for row in rows("enclosures") {
        let (e, value, off) = (
            reader::formula(&row[0]),
            reader::formula(&row[1]),
            reader::formula(&row[2]),
        );
        let exact = |e: &Expr| {
            e.evaluate(&Point::<Rational>::default())
                .expect("a fraction")
        };
        let (value, off) = (exact(&value), exact(&off));
        let Outcome::Value(found) = evaluate::<Interval>(&e, &Point::default()) else {
            panic!("{} has a value", row[0])
        };
        let end = |x: f64| carom::expr::number::from_f64(x).expect("a double");
        let (low, high) = (end(found.low), end(found.high));
        assert!(
            low <= &value + &off && high >= &value - &off,
            "{} {found:?}",
            row[0]
        );
        // A bound of its width: a double or two to either side for every operation.
        assert!(
            found.high - found.low <= 1e-14 * found.high.abs().max(1.0),
            "{}",
            row[0]
        );
        if let Some(fraction) = e.evaluate(&Point::<Rational>::default()) {
            assert!(low <= fraction && fraction <= high, "{} {found:?}", row[0]);
        }
        for sign in [1, -1] {
            let wrong = Expr::from(&value + &off * ratio(2 * sign, 1));
            let decision = decide(&e, &wrong, &domains).equality;
            assert!(
                matches!(decision, Equality::Different(_)),
                "{}: {decision:?}",
                row[0]
            );
        }
    }
}

#[test]
fn a_belief_is_told_where_it_led_to_the_answer_and_nowhere_else() {
    for row in rows("beliefs") {
        let [path, quantity, answer, verdict, codes] = [0, 1, 2, 3, 4].map(|i| row[i].as_str());
        let text = fs::read_to_string(format!("derivations/{path}")).expect("a scene");
        let scene = scene::read(&text).expect("a sound scene");
        let (sheet, _) = command::sheet(scene).expect("answers");
        let entry = sheet.entry(quantity).expect("a quantity");
        let grade = sheet.judge(&entry, answer, &Options::default());
        let told: Vec<&str> = grade.diagnosis.iter().map(|d| d.code).collect();
        assert_eq!(
            (grade.verdict.word(), told.join(" ").as_str()),
            (verdict, codes),
            "{path} {quantity} = {answer}"
        );
    }
}
