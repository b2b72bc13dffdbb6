//! Shipped scenes with friction: which case they are about, their answers, and that every check of every case holds.

use std::collections::BTreeMap;

use carom::answer::about;
use carom::derive::derive;
use carom::derive::friction::{Table, table};
use carom::equality::{Equality, decide};
use carom::expr::{Expr, Symbol};
use carom::formula::{Symbols, read_expr};
use carom::numeric::path::{Event, Path};
use carom::scene::{Mode, Scene};
use carom::solution::Detail;
use carom::verify::compare::compare;
use carom::verify::friction::{Judged, Pick, judge};
use carom::verify::{possible, prove};
use carom::{numeric, scene, story, worked};

fn read(name: &str, set: &str) -> Scene {
    let path = format!("derivations/friction/{name}.json");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let mut scene = scene::read(&text).unwrap_or_else(|f| panic!("{}", f.render(&path, &text)));
    for one in set.split_whitespace() {
        let (symbol, value) = one.split_once('=').expect("NAME=VALUE");
        scene::set(&mut scene, symbol, value).unwrap_or_else(|f| panic!("{one}: {}", f.message));
    }
    scene
}

fn names() -> Vec<String> {
    let folder = std::fs::read_dir("derivations/friction").expect("the folder");
    let files = folder.map(|e| e.expect("an entry").path());
    let scenes = files.filter(|p| p.extension().is_some_and(|e| e == "json"));
    let mut names: Vec<String> = scenes
        .map(|p| {
            p.file_stem()
                .expect("a name")
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    // Those with stages are told and held against the scene followed in numbers: `tests/stories`.
    names.retain(|name| !read(name, "").has_stages());
    names.sort();
    names
}

fn judged(scene: &Scene) -> (Table, Judged) {
    let table = table(scene).expect("a table").expect("friction");
    let judged = judge(scene, &table);
    (table, judged)
}

/// Closed forms by name: of the motion, and of what is asked about it.
fn answers(scene: &Scene) -> BTreeMap<String, Expr> {
    let answers = story::tell(scene).expect("a story").answers;
    let formulas = answers
        .iter()
        .filter_map(|a| Some((a.name.clone(), a.formula()?.clone())));
    formulas.collect()
}

fn same(scene: &Scene, got: &Expr, expected: &Expr) -> bool {
    if matches!(
        decide(got, expected, &scene.domains).equality,
        Equality::Same { .. }
    ) {
        return true;
    }
    // A number is that of the scene's own values.
    let Ok(at) = numeric::exact_values(scene) else {
        return false;
    };
    expected.symbols().is_empty() && got.evaluate(&at) == expected.evaluate(&at)
}

#[test]
fn the_answers_are_those_of_the_table() {
    let rows = std::fs::read_to_string("tests/friction/answers.tsv").expect("the table");
    let mut count = 0;
    for row in rows
        .lines()
        .filter(|l| !l.starts_with('#') && !l.is_empty())
    {
        let cells: Vec<&str> = row.split('\t').collect();
        let [name, set, case, answer, formula, _why] = cells.as_slice() else {
            panic!("not six columns: {row}")
        };
        let scene = read(name, set);
        let (table, judged) = judged(&scene);
        let found = match case.is_empty() {
            true => {
                let all = about(&scene, table.about.iter(), &BTreeMap::new()).expect("answers");
                all.into_iter()
                    .filter_map(|a| Some((a.name.clone(), a.formula()?.clone())))
                    .collect()
            }
            false => {
                let picked = judged.pick.cases(&table);
                assert!(set.is_empty() || picked.len() == 1, "{row}: {picked:?}");
                let found = picked
                    .iter()
                    .find(|i| table.cases[**i].mode.words() == *case);
                let i = found.unwrap_or_else(|| panic!("{row}: {:?}, {picked:?}", judged.pick));
                answers(&table.cases[*i].scene)
            }
        };
        let got = found
            .get(*answer)
            .unwrap_or_else(|| panic!("{row}: no answer; {found:?}"));
        let mut symbols = Symbols::strict();
        scene
            .parameters
            .iter()
            .for_each(|p| symbols.declare(&p.name));
        found.keys().for_each(|k| symbols.declare(k));
        let expected =
            read_expr(formula, &symbols).unwrap_or_else(|f| panic!("{}", f.show(formula)));
        let values: BTreeMap<Symbol, Expr> = found
            .iter()
            .map(|(k, v)| (k.as_str().into(), v.clone()))
            .collect();
        let expected = expected.substitute(&values);
        assert!(
            same(&scene, got, &expected),
            "{row}: {}",
            carom::formula::write_plain(got)
        );
        count += 1;
    }
    assert!(count >= 20, "{count} rows");
}

#[test]
fn every_check_of_every_case_holds() {
    for name in names() {
        let scene = read(&name, "");
        let (table, judged) = judged(&scene);
        assert!(!judged.pick.cases(&table).is_empty(), "{name}");
        assert_ne!(judged.supposed_holds, Some(false), "{name}");
        for check in &judged.checks {
            assert_ne!(check.holds, Some(false), "{name}: {}", check.words);
        }
        let path = judged
            .checks
            .iter()
            .find(|c| c.kind == "path")
            .expect("a check");
        assert_eq!(path.holds, Some(true), "{name}: {}", path.words);
        for i in judged.pick.cases(&table) {
            let case = &table.cases[i].scene;
            let derivation = derive(case).expect("a derivation");
            let proof = prove(case, &derivation);
            assert!(
                proof.holds(),
                "{name}: {:?} {:?}",
                table.cases[i].mode,
                proof.scene
            );
            let possible = possible::judge(case, &derivation, &[]);
            assert!(possible.holds(), "{name}: {:?}", possible.reasons());
        }
    }
}

#[test]
fn a_wrong_form_is_refused_by_the_path() {
    let scene = read("rod-slides-into-floor", "");
    let is_refused = |table: &Table| {
        let mut checks = judge(&scene, table).checks.into_iter();
        checks.any(|c| c.kind == "path" && c.holds == Some(false))
    };
    let (mut table, _) = judged(&scene);
    let last = &mut table.cases.last_mut().expect("a case").impulse[0];
    *last = -last.clone();
    assert!(is_refused(&table));
    let (mut table, _) = judged(&scene);
    table.cases[0].conditions[0].when[0].of = Expr::one();
    assert!(is_refused(&table));
}

#[test]
fn what_does_not_happen_is_told_where_it_is_supposed() {
    let mut scene = read("jammed-rod", "");
    if let scene::ContactLaw::Friction(law) = &mut scene.contacts[0].law {
        law.supposing = Some(Mode::Slides);
    }
    let (table, judged) = judged(&scene);
    assert_eq!(judged.supposed_holds, Some(false));
    assert!(
        matches!(judged.pick, Pick::Supposed(_)),
        "{:?}",
        judged.pick.cases(&table)
    );
    assert!(judged.at_values.expect("values").jams);
}

#[test]
fn newton_gains_where_poisson_and_stronge_lose() {
    let found = compare(&read("double-pendulum-hits-floor", "")).expect("values");
    let gain = |law: &str| {
        let row = found.rows.iter().find(|r| r.law == law).expect("a law");
        let energy = &row.outcome.as_ref().expect("an outcome").energy;
        energy.gain / energy.energy_before
    };
    assert!(
        (gain("Newton") - 703.0 / 800.0).abs() < 1e-12,
        "{}",
        gain("Newton")
    );
    for calm in ["Poisson", "Stronge", "Chatterjee and Ruina", "no friction"] {
        assert!(gain(calm) < 0.0, "{calm}");
    }
}

/// The end of a rod that falls straight down does not slip before, so no slip ends or is reversed.
#[test]
fn what_does_not_slip_before_sticks_or_slides_in_table_and_comparison() {
    let (table, _) = judged(&read("falling-rod-on-rough-floor", ""));
    let called: Vec<Mode> = table.cases.iter().map(|c| table.called(c)).collect();
    assert_eq!(called, [Mode::Sticks, Mode::Slides]);
    for (mu, expected) in [("1/5", Mode::Slides), ("5", Mode::Sticks)] {
        let set = format!("m=1 l=1 theta=acos(3/5) v=1 mu={mu}");
        let found = compare(&read("falling-rod-on-rough-floor", &set)).expect("values");
        for row in found
            .rows
            .iter()
            .filter(|r| ["Poisson", "Stronge", "Newton"].contains(&r.law))
        {
            let mode = row.outcome.as_ref().expect("an outcome").mode;
            assert_eq!(mode, expected, "{} at {mu}", row.law);
        }
    }
}

/// A rod hinged to the ground whose tip scrapes a floor: ac = b², which doubles meet only up to rounding.
#[test]
fn a_hinged_body_is_no_freer_in_doubles_than_it_is() {
    for angle in ["0.85", "0.95", "1.1", "1.3"] {
        for hypothesis in ["newton", "stronge", "poisson", "chatterjee-ruina", "brach"] {
            let text = format!(
                r#"{{
  "parameters": {{"L": {{"unit": "m", "value": "7/10"}}, "w": {{"unit": "rad/s", "value": "11/10"}}, "theta": {{"unit": "rad", "value": "{angle}"}}}},
  "points": {{"O": [0, 0], "C": ["L*cos(theta)", "-L*sin(theta)"]}},
  "bodies": {{
    "ground": {{"shape": "fixed"}},
    "rod": {{"shape": "rod", "mass": "3/10", "length": "L", "angle": "-theta", "center": {{"from": "O", "distance": "L/2", "angle": "-theta"}}, "velocity": {{"about": "O"}}, "spin": "-w"}}
  }},
  "hinges": {{"O": {{"bodies": ["ground", "rod"], "at": "O"}}}},
  "contacts": {{"C": {{"bodies": ["ground", "rod"], "at": "C", "normal": "y", "law": "friction", "mu": "9/10", "restitution": "1/3", "hypothesis": "{hypothesis}"}}}},
  "questions": {{"omega": {{"spin": "rod"}}}}
}}"#
            );
            let scene = scene::read(&text).unwrap_or_else(|f| panic!("{}", f.render("rod", &text)));
            let point = numeric::values(&scene).expect("values");
            let given = numeric::given(&scene, &point).expect("numbers");
            let found = numeric::settle(&given, numeric::solve_f64);
            if hypothesis != "poisson" {
                assert!(found.is_err(), "{hypothesis} at {angle}");
                continue;
            }
            let (_, followed) = found.expect("a path").expect("friction");
            let [u_t, u_n] = followed.path.end().velocity;
            assert!(u_t.abs() + u_n.abs() < 1e-14, "{u_t} {u_n} at {angle}");
        }
    }
}

#[test]
fn a_scene_left_open_names_the_cases_it_has() {
    let text = std::fs::read_to_string("derivations/friction/ball-slides-at-its-bounce.json")
        .expect("the scene");
    let text = text.replace(", \"supposing\": \"slides\"", "");
    let scene = scene::read(&text).unwrap_or_else(|f| panic!("{}", f.render("ball", &text)));
    let why = carom::verify::friction::settled(&scene).expect_err("several cases");
    assert!(
        why.contains("cases: `C` ") && why.contains("slides"),
        "{why}"
    );
}

#[test]
fn what_is_made_of_the_answers_of_a_case_stands_with_them() {
    for (scene, line, times, why) in [
        (
            "puck-glances-off-a-rough-rail",
            "phi = atan((sinα − μ (1 + e) cosα)/(e cosα))",
            1,
            "one case where it slides",
        ),
        (
            "puck-glances-off-a-rough-rail",
            "phi = 0",
            2,
            "two where it sticks",
        ),
        (
            "ball-asked-in-each-case",
            "the difference of its sides is (2 u − 7 μ v (1 + e))/7, which is not negative",
            1,
            "what is to be shown is shown where the ball slides",
        ),
        (
            "ball-asked-in-each-case",
            "μ cannot grow beyond all bounds: 2 u/(7 v (1 + e)) ≥ μ is needed so that `C` slides",
            1,
            "with much friction it does not slide",
        ),
        (
            "ball-asked-in-each-case",
            "slow = 5 μ v/7",
            1,
            "at u = μ v it sticks in compression alone",
        ),
        (
            "ball-bounces-back-along-its-path",
            "mu_0 = u/v",
            2,
            "the threshold with a spin that is an answer of each case",
        ),
    ] {
        let out = std::process::Command::new(env!("CARGO_BIN_EXE_carom"))
            .args(["derive", &format!("tests/friction/{scene}.json")])
            .output()
            .expect("carom runs");
        let text = String::from_utf8_lossy(&out.stdout).to_string();
        assert_eq!(text.matches(line).count(), times, "{why}: {text}");
    }
}

#[test]
fn laws_are_compared_at_an_impact_inside_stages_with_the_motion_handed_on() {
    let said = |arguments: &[&str]| {
        let out = std::process::Command::new(env!("CARGO_BIN_EXE_carom"))
            .args(["compare", "derivations/friction/stone-lands-and-skids.json"])
            .args(arguments)
            .output()
            .expect("carom runs");
        let text = [out.stdout, out.stderr].concat();
        (
            out.status.code(),
            String::from_utf8_lossy(&text).to_string(),
        )
    };
    // The stone lands with 2 m/s and 3 m/s along the ground: it slides on with 3 - 2/4, and sticks where μ is 2.
    let values = ["m=1", "u=3", "h=1/5", "g=10", "kappa=1/2"].map(|v| ["--set", v]);
    let values: Vec<&str> = values.into_iter().flatten().collect();
    for (mu, after) in [
        ("mu=1/4", "Poisson: stone 2.5, 0, 0"),
        ("mu=2", "Poisson: stone 0, 0, 0"),
    ] {
        let (status, text) = said(&[&values[..], &["--set", mu]].concat());
        assert!(status == Some(0) && text.contains(after), "{mu}: {text}");
    }
    let (status, text) = said(&[&values[..], &["--stage", "fall"]].concat());
    assert!(
        status != Some(0) && text.contains("--stage with one of: landing"),
        "{text}"
    );
}

/// A central contact that sticks feels the same whenever its slip ended: supposed to stick, it is one case.
#[test]
fn a_ball_that_is_supposed_to_stick_is_one_case_whenever_its_slip_ends() {
    let path = "derivations/friction/ball-rolls-off-its-bounce.json";
    let text = std::fs::read_to_string(path).expect("the scene");
    let text = text.replace(
        r#""hypothesis": "poisson""#,
        r#""hypothesis": "poisson", "supposing": "sticks""#,
    );
    let scene = scene::read(&text).expect("a sound scene");
    let (table, _) = judged(&scene);
    let sticks = table.cases.iter().filter(|case| case.mode.sticks()).count();
    assert_eq!(sticks, 2, "in compression, and in restitution");
    let one = carom::verify::friction::settled(&scene).expect("one case");
    let law = &one.contacts[table.contact].law;
    let carom::scene::ContactLaw::Decided(decided) = law else {
        panic!("{law:?}");
    };
    let when = decided.when.iter();
    let when: Vec<String> = when
        .map(|(left, relation, right)| {
            format!(
                "{} {} {}",
                carom::formula::write_plain(left),
                relation.sign(),
                carom::formula::write_plain(right)
            )
        })
        .collect();
    assert_eq!(when, ["mu > 2*u/(7*v*(1 + e))"], "where it does not slide");
    let turns = answers(&one).remove("omega").expect("its spin");
    assert_eq!(carom::formula::write_plain(&turns), "5*u/(7*r)");
}

#[test]
fn where_nothing_slips_before_and_one_way_only_is_driven_there_is_one_direction() {
    let text = r#"{"title": "rod", "parameters": {"m": {"unit": "kg"}, "l": {"unit": "m"}, "v": {"unit": "m/s"}, "e": {"unit": "1"}, "theta": {"unit": "rad", "domain": {"min": 0, "max": "pi/2"}}},
        "bodies": {"floor": {"shape": "fixed"}, "rod": {"shape": "rod", "mass": "m", "length": "l", "angle": "theta", "center": ["l/2*cos(theta)", "l/2*sin(theta)"], "velocity": [0, "-v"]}},
        "contacts": {"C": {"bodies": ["floor", "rod"], "at": [0, 0], "normal": "y", "law": "friction", "mu": "1/3", "restitution": "e"}},
        "questions": {"omega": {"spin": "rod"}}}"#;
    let scene = scene::read(text).unwrap_or_else(|f| panic!("{}", f.render("rod", text)));
    let (table, _) = judged(&scene);
    let cases: Vec<Mode> = table.cases.iter().map(|case| table.called(case)).collect();
    assert_eq!(cases, [Mode::Sticks, Mode::Slides], "{cases:?}");
}

/// What the commands tell: a command, a scene, what stands in place of what in it, values, the status, and texts between bars;
/// with `not:` in front it stands nowhere.
#[test]
fn the_commands_tell_what_the_table_says() {
    let rows = std::fs::read_to_string("tests/friction/told.tsv").expect("the table");
    let rows = rows.lines().filter(|line| !line.starts_with('#'));
    let mut wrong = Vec::new();
    for (i, row) in rows.enumerate() {
        let cells: Vec<&str> = row.split('\t').collect();
        let [command, path, put, set, status, texts, why] = cells[..] else {
            panic!("not seven columns: {row}")
        };
        let mut scene = std::fs::read_to_string(path).expect("the scene");
        for pair in put.split(" || ").filter(|pair| !pair.is_empty()) {
            let (old, new) = pair.split_once(" => ").expect("old => new");
            assert!(scene.contains(old), "{why}: {old}");
            scene = scene.replace(old, new);
        }
        let file = format!("friction-{i}.json");
        let file = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(file);
        std::fs::write(&file, scene).expect("a writable folder");
        let mut run = std::process::Command::new(env!("CARGO_BIN_EXE_carom"));
        run.args(command.split(' ')).arg(&file);
        set.split_whitespace().for_each(|value| {
            run.args(["--set", value]);
        });
        let out = run.output().expect("carom runs");
        let said = [out.stdout, out.stderr].concat();
        let said = String::from_utf8_lossy(&said);
        let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
        let code = out.status.code().map_or(String::new(), |c| c.to_string());
        let mut texts = texts.split(" | ");
        let holds = texts.all(|text| match text.strip_prefix("not: ") {
            Some(text) => !said.contains(text),
            None => said.contains(text),
        });
        if code != status || !holds {
            wrong.push(format!("{why}: status {code}: {said}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

/// What a solution names of the path, at the corners of the path that knows no formulas: a claim is read by the name it gives.
fn seen_at_corners(path: &Path<f64>, name: &str) -> Option<f64> {
    let at = |event| path.corners.iter().position(|c| c.event == event);
    let (slip, compressed) = (at(Event::SlipEnds), at(Event::Compressed));
    let corner = |i: usize| &path.corners[i];
    let first = |i: usize, other: Option<usize>| other.is_none_or(|other| i <= other);
    match name {
        "P_slip" | "Q_slip" => slip.map(|i| corner(i).impulse[1]),
        // Where the slip ends first, compression ends elsewhere.
        "P_comp" | "Q_comp" => {
            let own = compressed.filter(|i| first(*i, slip));
            own.map(|i| corner(i).impulse[1])
        }
        "v_slip" => slip.map(|i| corner(i).velocity[1]),
        "k" => slip.map(|i| {
            let [one, two] = [corner(i), corner(i + 1)];
            (two.velocity[1] - one.velocity[1]) / (two.impulse[1] - one.impulse[1])
        }),
        "W" => compressed.map(|end| {
            let pairs = path.corners[..=end].windows(2);
            let works = pairs.map(|pair| {
                let speed = pair[0].velocity[1] + pair[1].velocity[1];
                -speed / 2.0 * (pair[1].impulse[1] - pair[0].impulse[1])
            });
            works.sum()
        }),
        _ => None,
    }
}

#[test]
fn the_impulses_that_a_solution_names_are_corners_of_the_path() {
    let of_tests = crate::shared::files("tests/friction", "json");
    let shipped = names().into_iter();
    let shipped = shipped.map(|name| format!("derivations/friction/{name}.json").into());
    let mut compared: BTreeMap<String, usize> = BTreeMap::new();
    for path in shipped.chain(of_tests) {
        let scene = scene::read(&std::fs::read_to_string(&path).expect("a scene"));
        let scene = scene.expect("a valid scene");
        if scene.has_stages() {
            continue;
        }
        let worked = worked::out(&scene).or_else(|_| worked::in_cases(&scene));
        let worked = worked.unwrap_or_else(|why| panic!("{}: {why}", path.display()));
        let solution = worked.solution(Detail::Normal);
        let named = solution.steps.iter().filter_map(|step| {
            let name = step.defines.clone()?;
            Some((name, step.after.first()?.right.clone(), solution.mode))
        });
        let named: Vec<_> = named.collect();
        let values: BTreeMap<Symbol, Expr> = named
            .iter()
            .map(|(n, e, _)| (n.clone(), e.clone()))
            .collect();
        let put_in = |e: &Expr| (0..3).fold(e.clone(), |e, _| e.substitute(&values));
        let formulas: Vec<Expr> = named.iter().map(|(_, e, _)| put_in(e)).collect();
        let known = |e: &Expr| e.symbols().iter().all(|s| scene.parameter(s).is_some());
        let parameters = scene.parameters.iter().map(|p| Expr::symbol(&p.name));
        let parameters: Vec<Expr> = parameters.collect();
        let given = formulas.iter().filter(|e| known(e)).chain(&parameters);
        let given: Vec<&Expr> = given.collect();
        for sample in scene.domains.points(&given, 400) {
            let point = sample.doubles();
            let Ok(numbers) = numeric::given(&scene, &point) else {
                continue;
            };
            let Ok(Some((_, followed))) = numeric::settle(&numbers, numeric::solve_f64) else {
                continue;
            };
            let mode = numeric::friction::happened(&numbers, &followed);
            for ((name, _, of), formula) in named.iter().zip(&formulas) {
                let seen = seen_at_corners(&followed.path, name).filter(|_| known(formula));
                // Of a case alone these hold: how the contact goes on after its slip.
                let of_case = matches!(&**name, "k" | "W");
                let (Some(seen), false) = (seen, of_case && *of != Some(mode)) else {
                    continue;
                };
                let value = formula.evaluate(&point).expect("a value");
                // Names of the other direction have other values.
                let turned = match name.split_once('_') {
                    Some(("P", end)) => format!("Q_{end}"),
                    Some(("Q", end)) => format!("P_{end}"),
                    _ => String::new(),
                };
                let other = values
                    .get(turned.as_str())
                    .and_then(|e| put_in(e).evaluate(&point));
                let close = |x: f64| (x - seen).abs() <= 1e-9 * (x.abs() + seen.abs());
                assert!(
                    close(value) || other.is_some_and(close),
                    "{}: {name} is {value}, not {seen}",
                    path.display()
                );
                *compared.entry(name.to_string()).or_default() += 1;
            }
        }
    }
    for name in ["P_slip", "P_comp", "v_slip", "k", "W"] {
        let times = compared.get(name).copied().unwrap_or(0);
        assert!(times > 2, "{name}: {compared:?}");
    }
}
