//! Emitted code, compiled and run: what it gives lies within the bound its comment states, in every language.
//!
//! The truth is the closed form in 512 bits at exactly the arguments given, and, where doubles can be a unit vector, the
//! independent solver. A language whose compiler is absent is skipped by name.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use carom::dimension::Dimension;
use carom::domain::Limit;
use carom::emit::{Function, Heading, Language, Style, file, functions};
use carom::expr::number::{from_f64, to_f64};
use carom::expr::{Expr, Point, Scalar};
use carom::formula::{Symbols, read_expr};
use carom::interval::{Big, Enclosure, Outcome, evaluate};
use carom::numeric::{Correct, correct};
use carom::scene::{self, Scene};
use rayon::prelude::*;

use crate::shared;

/// A scene with its functions, and for each function some arguments.
struct Case {
    name: String,
    scene: Scene,
    /// Whether it is one impact, without stages.
    lone: bool,
    functions: Vec<Function>,
    arguments: Vec<Vec<Vec<f64>>>,
    /// What is true at each of them.
    truths: Vec<Vec<f64>>,
    /// How many points of each function do not cancel.
    plain: Vec<usize>,
}

impl Case {
    /// The arguments of each function, each with what is true there.
    fn points(&self) -> impl Iterator<Item = impl Iterator<Item = (&Vec<f64>, f64)>> {
        let both = self.arguments.iter().zip(&self.truths);
        both.map(|(points, truths)| points.iter().zip(truths.iter().copied()))
    }
}

/// How many points of a function are ordinary ones. Some follow in units that make arguments huge or tiny, then some at
/// which the value all but cancels.
const USUAL: usize = 12;

fn cases() -> &'static [Case] {
    static CASES: OnceLock<Vec<Case>> = OnceLock::new();
    CASES.get_or_init(read_cases)
}

/// Where the scenes stand.
const FOLDERS: [&str; 4] = [
    "derivations/book",
    "derivations/more",
    "derivations/problems",
    "tests/stories/scenes",
];

fn read_cases() -> Vec<Case> {
    let mut files: Vec<PathBuf> = FOLDERS
        .iter()
        .flat_map(|folder| fs::read_dir(folder).expect("a folder"))
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
        .collect();
    files.sort();
    files.par_iter().filter_map(|path| case(path)).collect()
}

/// The case of a scene; nothing for laws that contradict each other and for an impact whose friction leaves cases open, which have
/// no code.
fn case(path: &Path) -> Option<Case> {
    let scene = scene::read(&fs::read_to_string(path).expect("a file")).expect("a scene");
    let lone = !scene.has_stages();
    let told = shared::worked(path).as_ref();
    let worked = told.expect("a scene that can be told");
    // One impact whose friction leaves cases is told as if it were a stage.
    if lone && worked.scene.has_stages() {
        return None;
    }
    if !worked.refusals().is_empty() {
        return None;
    }
    let (scene, derivation) = worked.clone().sheet().expect("one sheet");
    let (functions, _) = functions(&scene, &derivation);
    let mut dice = Dice(17);
    let mut plain = Vec::new();
    let mut points = |f: &Function| {
        let formula = formula(f);
        // Where a root would be of a negative number there is nothing to compare.
        let tries = std::iter::repeat_with(|| dice.point(&scene, f)).take(50 * USUAL);
        let usual = tries.filter_map(|x| Some((truth(f, &formula, &x)?, x)));
        let (mut truths, mut points): (Vec<f64>, Vec<Vec<f64>>) = usual.take(USUAL).unzip();
        assert_eq!(points.len(), USUAL, "{}", f.formula);
        plain.push(points.len());
        // The formula of a stage may have poles and roots that come together: ordinary points only.
        if lone {
            let cancelling = nearly_cancelling(&points, &truths, f, &formula);
            let far = points.iter().filter_map(|x| dice.far(f, &formula, x));
            let far: Vec<Vec<f64>> = far.collect();
            *plain.last_mut().expect("just added") += far.len();
            let more = far.into_iter().chain(cancelling);
            for x in more {
                truths.push(truth(f, &formula, &x).expect("a value"));
                points.push(x);
            }
        }
        (points, truths)
    };
    let (arguments, truths) = functions.iter().map(&mut points).unzip();
    let parts = path.with_extension("");
    let parts = parts.iter().map(|part| part.to_string_lossy());
    let name = parts.collect::<Vec<_>>().join("_").replace('-', "_");
    Some(Case {
        name,
        scene,
        lone,
        functions,
        arguments,
        truths,
        plain,
    })
}

/// Points at which the value is about to change sign: found by bisection between points of either sign.
fn nearly_cancelling(
    points: &[Vec<f64>],
    truths: &[f64],
    f: &Function,
    formula: &Expr,
) -> Vec<Vec<f64>> {
    let value = |x: &[f64]| truth(f, formula, x).unwrap_or(f64::NAN);
    let mut found = Vec::new();
    for (pair, values) in points.windows(2).zip(truths.windows(2)) {
        if found.len() == 2 {
            break;
        }
        let [mut low, mut high] = [pair[0].clone(), pair[1].clone()];
        let opposite = values[0] * values[1] < 0.0;
        if !opposite {
            continue;
        }
        let sign = values[0] > 0.0;
        for _ in 0..60 {
            let middle: Vec<f64> = low
                .iter()
                .zip(&high)
                .map(|(a, b)| 0.5 * a + 0.5 * b)
                .collect();
            match (value(&middle) > 0.0) == sign {
                true => low = middle,
                false => high = middle,
            }
        }
        found.push(low);
    }
    found
}

/// The formula in a function's comment, read back.
fn formula(f: &Function) -> Expr {
    let mut symbols = Symbols::strict();
    for argument in &f.arguments {
        symbols.declare(&argument.symbol);
    }
    read_expr(&f.formula, &symbols).expect("carom reads what it writes")
}

/// Its value at exactly these arguments.
fn truth(f: &Function, formula: &Expr, x: &[f64]) -> Option<f64> {
    let value = enclosed(f, formula, x)?;
    Some(value.nearest().unwrap_or_else(|| value.middle()))
}

fn enclosed(f: &Function, formula: &Expr, x: &[f64]) -> Option<Enclosure> {
    let mut point = Point::default();
    for (argument, v) in f.arguments.iter().zip(x) {
        let exact = from_f64(*v).expect("finite");
        point
            .values
            .insert(argument.symbol.clone(), Scalar::from_rational(&exact));
    }
    match evaluate::<Big<512>>(formula, &point) {
        Outcome::Value(Big(value)) => Some(value),
        _ => None,
    }
}

/// Random numbers from a seed.
struct Dice(u64);

impl Dice {
    fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// The same arguments measured in units of 10^±280 at most, such that doubles hold all of them and the value.
    fn far(&mut self, f: &Function, formula: &Expr, x: &[f64]) -> Option<Vec<f64>> {
        f.units.as_ref()?;
        for _ in 0..50 {
            let [mass, length, time] =
                [0; 3].map(|_| ((self.unit() * 561.0).floor() - 280.0) as i64);
            let power = |d: &Dimension| {
                let all = [(&d.mass, mass), (&d.length, length), (&d.time, time)];
                all.into_iter()
                    .map(|(e, by)| to_f64(e) * by as f64)
                    .sum::<f64>()
            };
            let powers: Vec<f64> = f.arguments.iter().map(|a| power(&a.dimension)).collect();
            if powers.iter().any(|p| p.abs() > 295.0) {
                continue;
            }
            let values = x.iter().zip(&powers).map(|(x, p)| x * 10f64.powf(*p));
            let values: Vec<f64> = values.collect();
            let fits = enclosed(f, formula, &values)
                .and_then(|v| v.nearest())
                .is_some_and(|v| (1e-290..1e300).contains(&v.abs()));
            if fits {
                return Some(values);
            }
        }
        None
    }

    /// Arguments in the domains of the scene: between their ends, or of sizes from 1/100 to 100.
    fn point(&mut self, scene: &Scene, f: &Function) -> Vec<f64> {
        let end = |l: &Option<Limit>| l.as_ref().map(Limit::approximate);
        f.arguments
            .iter()
            .map(|a| {
                let domain = scene.domains.symbols.get(&a.symbol);
                let ends = domain.map_or((Some(0.0), None), |d| (end(&d.low), end(&d.high)));
                let size = 10f64.powf(4.0 * self.unit() - 2.0);
                match ends {
                    (Some(low), Some(high)) => low + (high - low) * (0.001 + 0.998 * self.unit()),
                    (Some(low), None) => low + size,
                    (None, Some(high)) => high - size,
                    (None, None) if self.unit() < 0.5 => -size,
                    (None, None) => size,
                }
            })
            .collect()
    }
}

/// A folder of this test's own below the build's.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("emitted-{name}"));
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// Whether a tool is there; says so by name where it is not.
fn is_there(tool: &str) -> bool {
    let found = Command::new(tool)
        .arg("--version")
        .output()
        .is_ok_and(|o| o.status.success());
    if !found {
        eprintln!("skipped: no {tool} on this machine");
    }
    found
}

/// Flags under which emitted C has to compile without a warning.
const STRICT_C: [&str; 6] = [
    "-std=c99",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-O1",
    "-ffp-contract=off",
];

fn output(command: &mut Command) -> String {
    let done = command.output().expect("a tool that starts");
    assert!(
        done.status.success(),
        "{command:?}:\n{}",
        String::from_utf8_lossy(&done.stderr)
    );
    String::from_utf8(done.stdout).expect("text")
}

/// Whether a function of an emitted text serves the others.
fn is_helper(name: &str) -> bool {
    let starts = ["wide_", "two_", "quick_", "unit_"];
    starts.iter().any(|h| name.starts_with(h))
}

/// The names of the functions that a text offers, in the order of the answers.
fn named(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter_map(|l| {
        let rest = l
            .strip_prefix("pub fn ")
            .or(l.strip_prefix("double "))
            .or(l.strip_prefix("static inline double "))
            .or(l.strip_prefix("def "))?;
        let name = rest.split('(').next()?;
        (!is_helper(name)).then_some(name)
    })
}

/// The calls of a case, in the order in which [`hold`] expects their values. Points stand in tables, since a compiler takes
/// longer over a line for each than over all functions.
fn calls<'a>(case: &'a Case, text: &'a str, language: Language, own: &'a str) -> String {
    let mut told = String::new();
    for (name, points) in named(text).zip(&case.arguments) {
        let list = |values: &[f64]| {
            let each: Vec<String> = values.iter().map(|v| format!("{v:?}")).collect();
            each.join(", ")
        };
        let given: Vec<String> = (0..points[0].len()).map(|i| format!("at_[{i}]")).collect();
        let (name, given, count) = (format!("{own}{name}"), given.join(", "), points.len());
        let rows = |open: &str, close: &str| {
            let each: Vec<String> = points
                .iter()
                .map(|x| format!("{open}{}{close}", list(x)))
                .collect();
            each.join(", ")
        };
        told.push_str(&match language {
            _ if given.is_empty() => match language {
                Language::C => format!("for (int i = 0; i < {count}; i++) printf(\"%.17g\\n\", {name}());\n"),
                Language::Rust | Language::NoStd => {
                    format!("for _ in 0..{count} {{ println!(\"{{:?}}\", {name}()); }}\n")
                }
                Language::Python | Language::NumPy => {
                    format!("for _ in range({count}): print(repr({name}()))\n")
                }
            },
            Language::C => format!(
                "{{ static const double points_[][{}] = {{{}}};\nfor (int i = 0; i < {count}; i++) {{ const double *at_ = points_[i]; printf(\"%.17g\\n\", {name}({given})); }} }}\n",
                points[0].len(),
                rows("{", "}")
            ),
            Language::Rust | Language::NoStd => format!(
                "show(&[{}], &|at_| {name}({given}));\n",
                rows("&[", "]")
            ),
            Language::Python | Language::NumPy => format!(
                "for at_ in [{}]: print(repr({name}({given})))\n",
                rows("[", "]")
            ),
        });
    }
    told
}

/// Whether a formula has an arc or a logarithm: library functions whose error nobody states.
fn has_no_bound(formula: &str) -> bool {
    let calls = ["asin(", "acos(", "atan(", "ln("];
    calls.iter().any(|call| formula.contains(call))
}

/// Whether a question about a motion is answered under a name, alone or by components.
fn is_motion(scene: &Scene, name: &str) -> bool {
    let mut asked = scene.questions.iter().filter(|q| q.ask.is_motion());
    asked.any(|q| {
        ["", "_x", "_y"]
            .iter()
            .any(|part| name == format!("{}{part}", q.name))
    })
}

/// Every value against the closed form in 512 bits.
fn hold(cases: &[Case], language: &str, output: &str) {
    let mut values = output
        .lines()
        .map(|l| l.trim().parse::<f64>().expect("a number"));
    let (mut cancelled, mut far) = (0, 0);
    for case in cases {
        let functions = case.functions.iter().zip(case.points());
        for ((f, points), plain) in functions.zip(&case.plain) {
            far += plain - USUAL;
            for (i, (x, truth)) in points.enumerate() {
                let value = values.next().expect("a value for every call");
                // Where no bound is stated, as for sines of what stages lead to, an ordinary point is right to six digits.
                let Some(bound) = f.bound else {
                    let is_known = !case.lone || has_no_bound(&f.formula);
                    assert!(is_known, "no bound: {}", f.formula);
                    let near = (value - truth).abs() <= 1e-6 * truth.abs();
                    assert!(
                        near || i >= *plain,
                        "{language}, {} {} at {x:?}: {value:e}, not {truth:e}",
                        case.name,
                        f.name
                    );
                    continue;
                };
                // What cancels to neighbouring doubles cancels by 2⁵³, times the number of terms.
                let cancels = if i < *plain { 1e4 } else { 2f64.powi(56) };
                cancelled += usize::from(i >= *plain);
                let allowed =
                    (bound.plain + bound.wide * cancels + 1.0) * 2f64.powi(-53) * truth.abs();
                assert!(
                    (value - truth).abs() <= allowed,
                    "{language}, {} {} at {x:?}: {value:e}, not {truth:e}; allowed {allowed:e}",
                    case.name,
                    f.name
                );
                assert!(
                    allowed <= 1e-9 * truth.abs(),
                    "{} {}: a bound that says little",
                    case.name,
                    f.name
                );
            }
        }
    }
    assert!(values.next().is_none());
    assert!(far > 500, "only {far} points far from one");
    assert!(
        cancelled > 30,
        "only {cancelled} points at which the answer cancels"
    );
}

/// Functions alone, under the names of the answers.
fn plainly(language: Language) -> Style {
    Style {
        language,
        prefix: String::new(),
        record: false,
    }
}

fn text(case: &Case, language: Language) -> String {
    let heading = Heading {
        title: case.scene.title.clone(),
        ..Heading::default()
    };
    file(&plainly(language), &heading, &case.functions)
}

/// All cases in Rust as modules of one crate, and a program that prints every value.
fn in_rust(language: Language, own: &str) -> [String; 2] {
    let mut whole = String::new();
    let mut main = String::from("fn main() {\n");
    for case in cases() {
        let text = text(case, language);
        main.push_str(&calls(
            case,
            &text,
            language,
            &format!("{own}{}::", case.name),
        ));
        whole.push_str(&format!("pub mod {} {{\n{text}}}\n", case.name));
    }
    [whole, format!("{SHOW}{main}}}\n")]
}

/// What shows the values of a function at some points, compiled once for all.
const SHOW: &str = "fn show(points: &[&[f64]], f: &dyn Fn(&[f64]) -> f64) {
    for x in points {
        println!(\"{:?}\", f(x));
    }
}
";

fn rustc(folder: &Path, arguments: &[&str]) {
    let always = ["--edition", "2021", "-D", "warnings"];
    output(
        Command::new("rustc")
            .current_dir(folder)
            .args(always)
            .args(arguments),
    );
}

#[test]
fn rust_compiles_without_remarks_and_keeps_its_bound() {
    if !is_there("rustc") {
        return;
    }
    let folder = folder("rust");
    let [whole, main] = in_rust(Language::Rust, "");
    fs::write(folder.join("all.rs"), whole + &main).expect("written");
    rustc(&folder, &["-o", "all", "all.rs"]);
    let printed = output(&mut Command::new(folder.join("all")));
    hold(cases(), "Rust", &printed);
}

/// What emitted code asks of the crate `libm`, by the standard library.
const LIBM: &str = "pub fn sqrt(x: f64) -> f64 { x.sqrt() }
pub fn log(x: f64) -> f64 { x.ln() }
pub fn exp(x: f64) -> f64 { x.exp() }
pub fn tan(x: f64) -> f64 { x.tan() }
pub fn asin(x: f64) -> f64 { x.asin() }
pub fn acos(x: f64) -> f64 { x.acos() }
pub fn atan(x: f64) -> f64 { x.atan() }
pub fn sin(x: f64) -> f64 { x.sin() }
pub fn cos(x: f64) -> f64 { x.cos() }
pub fn round(x: f64) -> f64 { x.round() }
pub fn fabs(x: f64) -> f64 { x.abs() }
pub fn pow(x: f64, y: f64) -> f64 { x.powf(y) }
";

#[test]
fn rust_without_the_standard_library_compiles_and_keeps_its_bound() {
    if !is_there("rustc") {
        return;
    }
    let folder = folder("no_std");
    let [whole, main] = in_rust(Language::NoStd, "all::");
    fs::write(folder.join("libm.rs"), LIBM).expect("written");
    fs::write(folder.join("all.rs"), format!("#![no_std]\n{whole}")).expect("written");
    fs::write(folder.join("main.rs"), main).expect("written");
    rustc(&folder, &["--crate-type", "rlib", "libm.rs"]);
    rustc(
        &folder,
        &[
            "--crate-type",
            "rlib",
            "-L",
            ".",
            "--extern",
            "libm=liblibm.rlib",
            "all.rs",
        ],
    );
    rustc(
        &folder,
        &[
            "-L",
            ".",
            "--extern",
            "all=liball.rlib",
            "-o",
            "main",
            "main.rs",
        ],
    );
    let printed = output(&mut Command::new(folder.join("main")));
    hold(cases(), "Rust without std", &printed);
}

#[test]
fn c_compiles_without_remarks_and_keeps_its_bound() {
    if !is_there("cc") {
        return;
    }
    let cases = cases();
    let folder = folder("c");
    let printed = cases.par_iter().map(|case| {
        let text = text(case, Language::C);
        let mut main = String::from("#include <stdio.h>\nint main(void) {\n");
        main.push_str(&calls(case, &text, Language::C, ""));
        let source = format!("{}.c", case.name);
        fs::write(
            folder.join(&source),
            format!("{text}{main}    return 0;\n}}\n"),
        )
        .expect("written");
        let target = folder.join(&case.name);
        output(
            Command::new("cc")
                .current_dir(&folder)
                .args(STRICT_C)
                .arg("-o")
                .args([&target, Path::new(&source)])
                .arg("-lm"),
        );
        output(&mut Command::new(target))
    });
    let printed: Vec<String> = printed.collect();
    hold(cases, "C", &printed.concat());
}

#[test]
fn python_runs_and_keeps_its_bound() {
    if !is_there("python3") {
        return;
    }
    let cases = cases();
    let folder = folder("python");
    let mut driver = String::new();
    for case in cases {
        let text = text(case, Language::Python);
        driver.push_str(&format!("import {}\n", case.name));
        let own = format!("{}.", case.name);
        driver.push_str(&calls(case, &text, Language::Python, &own));
        fs::write(folder.join(format!("{}.py", case.name)), text).expect("written");
    }
    fs::write(folder.join("driver.py"), driver).expect("written");
    let mut python = Command::new("python3");
    hold(
        cases,
        "Python",
        &output(python.current_dir(&folder).args(["-B", "driver.py"])),
    );
}

#[test]
fn arrays_of_numpy_give_every_point_its_value_within_the_bound() {
    let has_numpy = || {
        Command::new("python3")
            .args(["-c", "import numpy"])
            .status()
    };
    if !is_there("python3") || !has_numpy().is_ok_and(|s| s.success()) {
        eprintln!("skipped: no NumPy on this machine");
        return;
    }
    let folder = folder("numpy");
    let mut driver = String::from("import numpy as np\n");
    for case in cases() {
        let text = text(case, Language::NumPy);
        driver.push_str(&format!("import {}\n", case.name));
        // One call for all points of a function: a column for each argument.
        for (name, points) in named(&text).zip(&case.arguments) {
            let columns = (0..points[0].len()).map(|a| {
                let column: Vec<String> = points.iter().map(|x| format!("{:?}", x[a])).collect();
                format!("np.array([{}])", column.join(", "))
            });
            let columns = columns.collect::<Vec<_>>().join(", ");
            let count = points.len();
            driver.push_str(&format!(
                "for v in np.broadcast_to({}.{name}({columns}), ({count},)): print(repr(float(v)))\n",
                case.name
            ));
        }
        fs::write(folder.join(format!("{}.py", case.name)), text).expect("written");
    }
    fs::write(folder.join("driver.py"), driver).expect("written");
    let mut python = Command::new("python3");
    let printed = output(
        python
            .current_dir(&folder)
            .args(["-B", "-W", "error", "driver.py"]),
    );
    hold(cases(), "NumPy", &printed);
}

#[test]
fn the_formula_in_the_comment_is_what_the_independent_solver_finds() {
    let mut compared = 0;
    for case in cases() {
        // No double but 0 and 1 is part of a unit vector, so those scenes have no such point.
        // The solver of one impact knows no stages: they are followed elsewhere.
        if !case.scene.domains.unit_vectors.is_empty() || !case.lone {
            continue;
        }
        for (f, points) in case.functions.iter().zip(case.points()) {
            for (x, truth) in points.take(3) {
                let mut scene = case.scene.clone();
                for parameter in &mut scene.parameters {
                    let given = f.arguments.iter().position(|a| a.symbol == parameter.name);
                    parameter.value = Some(match given {
                        Some(i) => Expr::from(from_f64(x[i]).expect("finite")),
                        // What the answer does not name may have any value.
                        None => parameter.value.clone().unwrap_or(Expr::ratio(1, 2)),
                    });
                }
                // The values made up for other parameters may make no scene: a disk beside a step, say.
                let Ok(found) = correct(&scene) else { continue };
                let numbers = found.answers.iter().flat_map(|(name, a)| {
                    let parts = a.as_ref().map_or(&[][..], |v| v.as_slice());
                    let name = |i: usize| match parts.len() {
                        1 => name.clone(),
                        _ => format!("{name}_{}", ["x", "y"][i]),
                    };
                    parts
                        .iter()
                        .enumerate()
                        .map(move |(i, c)| (name(i), c.clone()))
                        .collect::<Vec<_>>()
                });
                let solved = numbers.into_iter().find(|(name, _)| *name == f.name);
                // What is asked about other answers, such as a threshold, the solver does not find.
                let Some((_, solved)) = solved else {
                    let asked = is_motion(&case.scene, &f.name);
                    assert!(!asked, "{} {}: not found", case.name, f.name);
                    continue;
                };
                if let Correct::Rounded(v, _) = solved {
                    compared += 1;
                    assert!(
                        (v - truth).abs() <= 2f64.powi(-52) * truth.abs(),
                        "{} {}",
                        case.name,
                        f.name
                    );
                }
            }
        }
    }
    assert!(compared > 60, "{compared}");
}

/// The arguments of all functions of a case from the k-th point of each, where all have values there.
fn joint_point(case: &Case, k: usize) -> Option<Vec<(String, f64)>> {
    let mut given: Vec<(String, f64)> = Vec::new();
    for (f, points) in case.functions.iter().zip(&case.arguments) {
        for (argument, value) in f.arguments.iter().zip(&points[k]) {
            if given.iter().all(|(name, _)| *name != *argument.symbol) {
                given.push((argument.symbol.to_string(), *value));
            }
        }
    }
    let value = |name: &str| given.iter().find(|(n, _)| n == name).expect("given").1;
    let has_value = |f: &Function| {
        let x: Vec<f64> = f.arguments.iter().map(|a| value(&a.symbol)).collect();
        truth(f, &formula(f), &x).is_some()
    };
    case.functions.iter().all(has_value).then_some(given)
}

/// A program that takes all arguments in one struct and prints every value it gets back, one a line.
fn by_struct(case: &Case, language: Language) -> (String, String) {
    let style = Style {
        language,
        prefix: String::from("c_"),
        record: true,
    };
    let text = file(&style, &Heading::default(), &case.functions);
    let given = (0..USUAL).find_map(|k| joint_point(case, k));
    let given = given.expect("a point at which all functions have values");
    // What one function takes of another's points is the same number, so that both ways see the same arguments.
    let names: Vec<&str> = named(&text)
        .filter_map(|n| n.strip_prefix("c_"))
        .filter(|n| !is_helper(n))
        .take(case.functions.len())
        .collect();
    let calls = case.functions.iter().zip(&names).map(|(f, name)| {
        let value = |name: &str| given.iter().find(|(n, _)| n == name).expect("given").1;
        let list = f
            .arguments
            .iter()
            .map(|a| format!("{:?}", value(&a.symbol)));
        format!("c_{name}({})", list.collect::<Vec<_>>().join(", "))
    });
    let list = |of: &dyn Fn(&str, f64) -> String| {
        let each = given.iter().map(|(name, v)| of(name, *v));
        each.collect::<Vec<_>>().join(", ")
    };
    let fields = names.iter().map(|name| format!("out.{name}"));
    let printed: String = fields
        .chain(calls)
        .map(|value| match language {
            Language::Rust | Language::NoStd => format!("    println!(\"{{:?}}\", {value});\n"),
            Language::C => format!("    printf(\"%.17g\\n\", {value});\n"),
            Language::Python | Language::NumPy => format!("print(repr({value}))\n"),
        })
        .collect();
    let program = match language {
        Language::Rust | Language::NoStd => format!(
            "{text}\nfn main() {{\n    let out = c_solve(&CIn {{ {} }});\n{printed}}}\n",
            list(&|name, v| format!("{name}: {v:?}")),
        ),
        Language::C => format!(
            "#include <stdio.h>\nint main(void) {{\n    const c_in given = {{ {} }};\n    const c_out out = c_solve(&given);\n{printed}    return 0;\n}}\n",
            list(&|name, v| format!(".{name} = {v:?}")),
        ),
        Language::Python | Language::NumPy => format!(
            "{text}\n\nout = c_solve(CIn({}))\n{printed}",
            list(&|name, v| format!("{name}={v:?}")),
        ),
    };
    (text, program)
}

/// Values by the struct first, by the functions behind them.
fn same_twice(case: &Case, printed: &str) {
    let values: Vec<&str> = printed.lines().collect();
    let (one, two) = values.split_at(case.functions.len());
    assert_eq!(one, two, "{}", case.name);
}

#[test]
fn one_struct_in_and_one_out_gives_what_the_functions_give() {
    let folder = folder("struct");
    let picked = || {
        let all = cases()
            .iter()
            .filter(|c| c.lone && c.functions.iter().any(|f| !f.arguments.is_empty()));
        all.step_by(5)
    };
    for case in picked().filter(|_| is_there("rustc")) {
        let (_, program) = by_struct(case, Language::Rust);
        fs::write(folder.join("one.rs"), &program).expect("written");
        let arguments = ["--edition", "2021", "-D", "warnings", "-o", "one", "one.rs"];
        output(Command::new("rustc").current_dir(&folder).args(arguments));
        same_twice(case, &output(&mut Command::new(folder.join("one"))));
    }
    for case in picked().filter(|_| is_there("cc")) {
        let (header, program) = by_struct(case, Language::C);
        // Included twice, and beside another header with helpers of its own.
        let other = header.replace("c_", "d_").replace("CAROM_C_H", "CAROM_D_H");
        fs::write(folder.join("c.h"), header).expect("written");
        fs::write(folder.join("d.h"), other).expect("written");
        let includes = "#include \"c.h\"\n#include \"c.h\"\n#include \"d.h\"\n";
        fs::write(folder.join("two.c"), format!("{includes}{}", program)).expect("written");
        let mut cc = Command::new("cc");
        cc.current_dir(&folder).args(STRICT_C);
        output(cc.args(["-o", "two", "two.c", "-lm"]));
        same_twice(case, &output(&mut Command::new(folder.join("two"))));
    }
    for case in picked().filter(|_| is_there("python3")) {
        let (_, program) = by_struct(case, Language::Python);
        fs::write(folder.join("three.py"), &program).expect("written");
        let mut python = Command::new("python3");
        let printed = output(python.current_dir(&folder).args(["-B", "three.py"]));
        same_twice(case, &printed);
    }
}
