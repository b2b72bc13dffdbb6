//! Whether collisions are possible: a table of scenes with what is told of each, and the same verdict in a mirror, turned by a
//! right angle, and with the bodies of every contact exchanged.

use std::fs;

use carom::command::{self, Format, Numbers};
use carom::expr::{Expr, Vector};
use carom::scene::{self, Body, KnownQuantity, Scene, Shape};
use carom::verify::possible::{Possible, Verdict, judge};
use carom::{derive, render, verify};

/// Parameters that every scene of the table may use.
const PARAMETERS: &str = r#""m": {"unit": "kg"}, "M": {"unit": "kg"}, "I": {"unit": "kg m^2"}, "l": {"unit": "m"}, "d": {"unit": "m"},
    "a": {"unit": "m"}, "b": {"unit": "m"}, "h": {"unit": "m"}, "r": {"unit": "m"}, "v": {"unit": "m/s"}, "u": {"unit": "m/s"},
    "g": {"unit": "m/s^2"}, "e": {"domain": {"min": 0, "max": 1}}, "s": {"unit": "m/s", "domain": "real"},
    "alpha": {"unit": "rad", "domain": {"min": 0, "max": "pi/2", "min_open": true, "max_open": true}}"#;

struct Row {
    verdict: String,
    at_values: String,
    told: String,
    values: String,
    scene: String,
    reason: String,
}

fn rows() -> Vec<Row> {
    let text = fs::read_to_string("tests/possible/scenes.tsv").expect("the table");
    text.lines()
        .filter(|l| !l.starts_with('#') && !l.is_empty())
        .map(|line| {
            let cells: Vec<String> = line.split('\t').map(str::to_owned).collect();
            let [verdict, at_values, told, values, scene, reason] =
                cells.try_into().expect("six cells a row");
            Row {
                verdict,
                at_values,
                told,
                values,
                scene,
                reason,
            }
        })
        .collect()
}

/// The scene of a row, or the first fault the reader finds, in words.
fn read(row: &Row) -> Result<Scene, String> {
    let text = format!(r#"{{"parameters": {{{PARAMETERS}}}, {}}}"#, row.scene);
    let mut scene = scene::read(&text).map_err(|faults| faults.list[0].message.clone())?;
    for assignment in row.values.split_whitespace() {
        let (name, value) = assignment.split_once('=').expect("name=value");
        scene::set(&mut scene, name, value).map_err(|fault| fault.message)?;
    }
    Ok(scene)
}

fn judged(scene: &Scene) -> Possible {
    judge(scene, &derive::derive(scene).expect("a derivation"), &[])
}

fn verdict(possible: &Possible) -> &'static str {
    match possible.verdict {
        Verdict::Everywhere => "everywhere",
        Verdict::Where => "where",
        Verdict::Nowhere => "nowhere",
        Verdict::Undecided => "undecided",
    }
}

fn at_values(possible: &Possible) -> &'static str {
    match possible.at_values {
        Some(true) => "yes",
        Some(false) => "no",
        None => "-",
    }
}

#[test]
fn every_scene_of_the_table_is_judged_as_it_says() {
    let mut wrong = Vec::new();
    for row in rows() {
        let said = match read(&row) {
            Err(message) => ["fault".to_owned(), "-".to_owned(), message],
            Ok(scene) => {
                let possible = judged(&scene);
                // Possible or not, what the laws and the numbers say of it is the same.
                let derivation = derive::derive(&scene).expect("a derivation");
                let proof = verify::prove(&scene, &derivation);
                assert!(proof.holds(), "{}: {proof:?}", row.reason);
                let told = if possible.holds() {
                    render::possible::conditions(&scene, &possible).join("; ")
                } else {
                    possible.reasons().join("; ")
                };
                [verdict(&possible).into(), at_values(&possible).into(), told]
            }
        };
        if said != [row.verdict.clone(), row.at_values.clone(), row.told.clone()] {
            wrong.push(format!(
                "{}:\n  said     {said:?}\n  expected {:?}",
                row.reason,
                [row.verdict, row.at_values, row.told]
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn stories_that_cannot_happen_are_told_as_such() {
    let text = fs::read_to_string("tests/possible/stories.tsv").expect("the table");
    let mut in_numbers = 0;
    for line in text.lines().filter(|l| !l.starts_with('#')) {
        let cells: Vec<&str> = line.split('\t').collect();
        let [told, values, scene, reason] = cells[..] else {
            panic!("four cells a row: {line}");
        };
        let row = Row {
            verdict: String::new(),
            at_values: String::new(),
            told: told.into(),
            values: values.into(),
            scene: scene.into(),
            reason: reason.into(),
        };
        let scene = read(&row).unwrap_or_else(|fault| panic!("{reason}: {fault}"));
        let found = carom::story::tell(&scene).unwrap_or_else(|stop| panic!("{reason}: {stop}"));
        let said = found.refusals();
        let said = said.first().map_or("-", String::as_str);
        assert_eq!((said, found.holds()), (told, told == "-"), "{reason}");
        // Numbers of what cannot happen are told as such, too.
        if let Ok(solved) = command::solve(&scene, Numbers::Doubles, Format::Text) {
            assert_eq!(solved.status == 0, told == "-", "{reason}: {}", solved.text);
            in_numbers += 1;
        }
    }
    assert!(in_numbers >= 7, "{in_numbers} scenes have all values");
}

/// A motion of the plane that turns right angles into right angles, exact in formulas.
#[derive(Clone, Copy)]
enum Frame {
    /// (x, y) becomes (−x, y).
    Mirror,
    /// (x, y) becomes (−y, x).
    Quarter,
}

impl Frame {
    fn vector(self, [x, y]: &Vector) -> Vector {
        match self {
            Frame::Mirror => [-x, y.clone()],
            Frame::Quarter => [-y, x.clone()],
        }
    }

    fn angle(self, angle: &Expr) -> Expr {
        match self {
            Frame::Mirror => Expr::pi() - angle.clone(),
            Frame::Quarter => angle + &(Expr::pi() * Expr::ratio(1, 2)),
        }
    }

    fn spin(self, spin: &Expr) -> Expr {
        match self {
            Frame::Mirror => -spin,
            Frame::Quarter => spin.clone(),
        }
    }

    fn body(self, body: &mut Body) {
        body.center = self.vector(&body.center);
        body.angle = self.angle(&body.angle);
        body.velocity = self.vector(&body.velocity);
        body.spin = self.spin(&body.spin);
        if let Shape::Composite { parts } = &mut body.shape {
            parts.iter_mut().for_each(|p| self.body(p));
        }
    }

    fn scene(self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        scene.bodies.iter_mut().for_each(|b| self.body(b));
        for contact in &mut scene.contacts {
            contact.at = self.vector(&contact.at);
            contact.normal = contact.normal.as_ref().map(|n| self.vector(n));
        }
        for hinge in &mut scene.hinges {
            hinge.at = self.vector(&hinge.at);
        }
        for known in &mut scene.after {
            match &mut known.what {
                KnownQuantity::Velocity { at, along, .. } => {
                    *at = self.vector(at);
                    *along = self.vector(along);
                }
                KnownQuantity::Spin => known.value = self.spin(&known.value),
            }
        }
        scene
    }
}

/// The same scene with the bodies of every contact named in the other order.
fn exchanged(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    for contact in &mut scene.contacts {
        contact.bodies.swap(0, 1);
        contact.normal = contact.normal.as_ref().map(|[x, y]| [-x, -y]);
    }
    scene
}

#[test]
fn the_verdict_is_the_same_in_a_mirror_turned_and_with_the_bodies_exchanged() {
    for row in rows() {
        let Ok(scene) = read(&row) else { continue };
        let own = judged(&scene);
        let frames = [
            Frame::Mirror.scene(&scene),
            Frame::Quarter.scene(&scene),
            Frame::Quarter.scene(&Frame::Mirror.scene(&scene)),
            exchanged(&scene),
        ];
        for (k, other) in frames.iter().enumerate() {
            let other = judged(other);
            assert_eq!(
                (
                    own.verdict,
                    own.at_values,
                    own.reasons().len(),
                    own.open().len()
                ),
                (
                    other.verdict,
                    other.at_values,
                    other.reasons().len(),
                    other.open().len()
                ),
                "{}, frame {k}: {own:?}\n{other:?}",
                row.reason
            );
        }
    }
}

#[test]
fn what_is_not_possible_is_told_first_and_with_status_1() {
    let scene = r#"{"parameters": {"m": {"unit": "kg"}, "v": {"unit": "m/s"}},
        "bodies": {"floor": {"shape": "fixed"}, "ball": {"shape": "particle", "mass": "m", "center": ["0", "0"], "velocity": ["0", "-v"]}},
        "contacts": {"C": {"bodies": ["floor", "ball"], "at": ["0", "0"], "normal": "y"}},
        "after": [{"velocity": "ball", "along": "y", "is": "-v/2"}, {"velocity": "ball", "along": "x", "is": "0"}],
        "questions": {"P": {"impulse": "C", "on": "ball"}}}"#;
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("through-the-floor.json");
    fs::write(&path, scene).expect("a writable folder");
    let run = |arguments: &[&str]| {
        let run = std::process::Command::new(env!("CARGO_BIN_EXE_carom"))
            .args(arguments)
            .arg(&path)
            .output()
            .expect("carom runs");
        let text = String::from_utf8_lossy(&run.stdout).into_owned();
        (run.status.code(), text)
    };
    let refusal =
        "not possible: the bodies pass through each other at `C`, whatever the parameters";
    let (status, text) = run(&["derive"]);
    assert_eq!((status, text.lines().next()), (Some(1), Some(refusal)));
    let (status, text) = run(&["derive", "--format", "json"]);
    let data: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(
        (status, &data["admissible"]["holds"]),
        (Some(1), &false.into())
    );
    assert_eq!(data["admissible"]["verdict"], "nowhere");
    let (status, text) = run(&["solution"]);
    assert!(status == Some(1) && text.contains(refusal), "{text}");
    let (status, text) = run(&["solve", "--set", "m=1", "--set", "v=2"]);
    assert_eq!((status, text.lines().next()), (Some(1), Some(refusal)));
}
