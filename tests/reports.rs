//! Reports: their figures come out again by another way, the same seed gives the same errors, and every fault has one message.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use carom::derive;
use carom::expr::number::{from_f64, to_f64};
use carom::expr::{Rational, ratio};
use carom::report::sample::Sampler;
use carom::report::{Effort, Report, Route, measure};
use carom::scene;
use serde_json::Value;

const STICK: &str = "derivations/book/falling-stick.json";

/// With few points a level, and all families or one besides usual values.
fn report(seed: u64, points: usize, family: Option<&str>) -> Report {
    let effort = Effort {
        seed,
        points,
        runs: 3,
        repeat: 1,
        family: family.map(String::from),
    };
    let scene = scene::read(&fs::read_to_string(STICK).expect("a file")).expect("a scene");
    let derivation = derive::derive(&scene).expect("closed forms");
    measure(&scene, Some(&derivation), effort, |_, _, _| true).expect("a report")
}

/// Everything but times, and what follows from them.
fn errors(report: &Report) -> Value {
    let mut all = serde_json::to_value(report).expect("data");
    for route in all["routes"].as_array_mut().expect("a list") {
        route["seconds"] = Value::Null;
        route["dominated"] = Value::Null;
    }
    all["verdict"] = Value::Null;
    all
}

#[test]
fn the_same_seed_gives_the_same_errors_and_another_one_others() {
    let [one, again, other] = [1, 1, 2].map(|seed| errors(&report(seed, 1, None)));
    assert_eq!(one, again);
    assert_ne!(one["families"], other["families"]);
}

/// Error in units in the last place, counted in doubles: the truth lies between two of them.
fn ulps(value: f64, exact: &Rational) -> f64 {
    let near = to_f64(exact).abs();
    let unit = near.next_up() - near;
    // Just below a power of two the unit is half of what lies above.
    let unit = if near.log2().fract() == 0.0 && *exact < from_f64(to_f64(exact)).expect("finite") {
        0.5 * unit
    } else {
        unit
    };
    to_f64(&((from_f64(value).expect("finite") - exact) / from_f64(unit).expect("finite"))).abs()
}

#[test]
fn errors_of_the_falling_stick_come_out_again_from_the_formula_in_the_book() {
    // ω = 3 v cosθ/(2 ℓ) after (17.29): exact over fractions, and in doubles as somebody would type it.
    let scene = scene::read(&fs::read_to_string(STICK).expect("a file")).expect("a scene");
    let family = Sampler::new(&scene, 1).usual(3 * 8);
    let mut all: Vec<f64> = family.levels[0]
        .points
        .iter()
        .map(|at| {
            let of = |name: &str| at.values.get(name).expect("a value").clone();
            let (_, [cos, _]) = at.directions.get("theta").expect("a direction").clone();
            let exact = ratio(3, 2) * of("v") * &cos / of("l");
            let [v, l, c] = [of("v"), of("l"), cos].map(|x| to_f64(&x));
            ulps(3.0 * v * c / (2.0 * l), &exact)
        })
        .collect();
    all.sort_by(f64::total_cmp);
    let report = report(1, 3, Some("overflow"));
    let route = report
        .routes
        .iter()
        .find(|r| r.route == Route::ClosedForm)
        .expect("the route");
    let found = &route.usual["omega"];
    assert_eq!(found.count, all.len());
    assert!(
        (found.max - all[all.len() - 1]).abs() < 1e-9,
        "{} {all:?}",
        found.max
    );
    assert!((found.median - all[all.len().div_ceil(2) - 1]).abs() < 1e-9);
    assert_eq!(
        found.histogram[0],
        all.iter().filter(|e| **e <= 0.5).count()
    );
    // Exact fractions rounded once are never wrong by more than half a unit.
    let exact = report
        .routes
        .iter()
        .find(|r| r.route == Route::Exact)
        .expect("the route");
    assert!(exact.usual_max <= 0.5 && exact.usual_max > 0.3);
    for r in &report.routes {
        let better = |o: &&carom::report::measure::RouteSummary| {
            o.route != r.route && o.seconds[1] < r.seconds[1] && o.worst <= r.worst
        };
        assert_eq!(
            r.dominated,
            report.routes.iter().any(|o| better(&o)),
            "{:?}",
            r.route
        );
    }
}

fn carom(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_carom"))
        .args(arguments)
        .output()
        .expect("carom starts")
}

fn refused(arguments: &[&str], message: &str) {
    ends_with(2, arguments, message);
}

fn ends_with(status: i32, arguments: &[&str], message: &str) {
    let out = carom(arguments);
    let text = String::from_utf8_lossy(&out.stderr).to_string();
    assert_eq!(out.status.code(), Some(status), "{text}");
    assert!(text.contains(message), "{text}");
    assert!(out.stdout.is_empty());
}

#[test]
fn every_fault_has_one_clear_message() {
    refused(
        &["report", "--family", "no such", "--quick", STICK],
        "has no family `no such`\nhint: it has usual values",
    );
    ends_with(
        74,
        &["report", "--quick", STICK, "--html", "/nowhere/page.html"],
        "the output cannot be written: /nowhere/page.html",
    );
    refused(
        &["report", "--quick", "nowhere.json"],
        "nowhere.json: cannot be read",
    );
    refused(
        &["report", "--quick", "derivations/book/two-bodies.json"],
        "the laws leave P_x, P_y,",
    );
    refused(
        &[
            "report",
            "--quick",
            "derivations/more/ball-bounces-twice.json",
        ],
        "several impacts\nhint: --stage with one of: ",
    );
}

#[test]
fn an_impact_of_stages_is_measured_with_the_motion_it_begins_with_as_data() {
    let out = carom(&[
        "report",
        "--quick",
        "--points",
        "1",
        "--family",
        "overflow",
        "--format",
        "json",
        "derivations/more/ball-bounces.json",
    ]);
    let data: Value = serde_json::from_slice(&out.stdout).expect("JSON");
    let formulas = &data["reports"][0]["formulas"];
    assert_eq!(*formulas, serde_json::json!([["v_2", "-e*v_1"]]));
}

#[test]
fn a_scene_without_values_is_measured_at_seeded_points_and_says_so() {
    let out = carom(&[
        "report", "--quick", "--points", "1", "--family", "overflow", "--format", "json", STICK,
    ]);
    assert_eq!(out.status.code(), Some(0));
    let said = String::from_utf8_lossy(&out.stderr).to_string();
    assert!(
        said.contains("no value for l, m, theta, v; measured at seeded points"),
        "{said}"
    );
    let data: Value = serde_json::from_slice(&out.stdout).expect("JSON");
    assert_eq!(data["reports"][0]["effort"]["seed"], 1);
    assert!(
        data["reports"][0]["routes"]
            .as_array()
            .expect("routes")
            .len()
            >= 8
    );
}

#[test]
fn a_report_is_written_in_the_format_that_its_file_name_tells() {
    let short = [
        "report", "--quick", "--points", "1", "--family", "overflow", STICK, "-o",
    ];
    let begins = [
        ("report.json", "{\n"),
        ("report.txt", "Falling stick"),
        ("report.html", "<!DOCTYPE html>"),
    ];
    for (name, first) in begins {
        let path = scratch(name);
        let out = Command::new(env!("CARGO_BIN_EXE_carom"))
            .args(short)
            .arg(&path)
            .output()
            .expect("carom starts");
        assert_eq!(out.status.code(), Some(0));
        let text = fs::read_to_string(&path).expect("the report");
        assert!(text.starts_with(first), "{name}: {text:.40}");
    }
}

/// A file of this test's own below the build's folder.
fn scratch(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_what_is_finished() {
    let rows = scratch("interrupted.jsonl");
    let _ = fs::remove_file(&rows);
    let child = Command::new(env!("CARGO_BIN_EXE_carom"))
        .args(["report", "--points", "4", STICK, "--rows"])
        .arg(&rows)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("carom starts");
    let start = Instant::now();
    let lines = || fs::read_to_string(&rows).map_or(0, |t| t.lines().count());
    while lines() < 2 {
        assert!(
            start.elapsed() < Duration::from_secs(120),
            "no row in two minutes"
        );
        std::thread::sleep(Duration::from_millis(20));
    }
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(sent.expect("a kill command").success());
    let out = child.wait_with_output().expect("it ends");
    assert_eq!(out.status.code(), Some(130));
    let text = String::from_utf8_lossy(&out.stdout).to_string();
    assert!(
        text.contains("interrupted: what was finished is above"),
        "{text}"
    );
    let finished = fs::read_to_string(&rows).expect("rows");
    assert!(
        finished
            .lines()
            .all(|l| serde_json::from_str::<Value>(l).is_ok())
    );
}

#[test]
fn a_page_answers_first_with_formula_and_code_then_usual_values_then_extremes() {
    let report = report(1, 1, None);
    let page = carom::render::report::html(std::slice::from_ref(&report));
    let at = |text: &str| page.find(text).unwrap_or_else(|| panic!("no {text}"));
    let order = [
        at("class=\"verdict\""),
        at("title=\"omega = "),
        at("double omega("),
        at(">Usual values<"),
        at("Largest error at usual values"),
        at(">Extremes<"),
    ];
    assert!(order.is_sorted(), "{order:?}");
}

#[test]
fn a_route_that_is_better_at_usual_values_is_not_beaten_by_one_that_fails_no_worse() {
    let report = report(1, 1, None);
    for one in report.routes.iter().filter(|r| r.dominated) {
        let beats = |other: &&carom::report::RouteSummary| {
            other.seconds[1] < one.seconds[1]
                && other.usual_max <= one.usual_max
                && other.worst <= one.worst
        };
        assert!(report.routes.iter().any(|r| beats(&r)), "{}", one.words);
    }
}
