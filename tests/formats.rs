//! Texts of strangers in every format: a title, a name or a spelling drawn from the signs that a format acts on ends up as
//! words, and the structure around it is that of a harmless scene.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use proptest::prelude::*;
use serde_json::json;

use carom::emit::{Heading, Language, Style, file, functions};
use carom::figure::{self, Which};
use carom::formula::is_hidden;
use carom::render::html::Picture;
use carom::scene::{self, Scene};
use carom::solution::{self, Detail, Slot, Solution};
use carom::{derive, render, story, verify};

/// What formats act on, and some words between.
const PIECES: [&str; 62] = [
    "\\input{/etc/passwd}",
    "<img src=x onerror=alert(1)>",
    "</script>",
    "-->",
    "<!--",
    "]]>",
    "*/",
    "/*",
    "*\\",
    "??/",
    "\"\"\"",
    "'''",
    "\\",
    "{",
    "}",
    "$",
    "$$",
    "%",
    "#",
    "&",
    "&lt;",
    "_",
    "^",
    "^^41",
    "~",
    "`",
    "```",
    "*",
    "**",
    "[a](b)",
    "![a](b)",
    "|",
    "<",
    ">",
    "\"",
    "'",
    "\\end{document}",
    "\\end{align*}",
    "\\]",
    "//",
    "#![cfg(any())]",
    "\u{202e}",
    "\u{2066}",
    "\u{200b}",
    "\u{feff}",
    "\u{2028}",
    "\u{ad}",
    "\u{e0041}",
    "http://a.b",
    "www.a.b",
    "@x",
    "1.",
    "- ",
    "=",
    "é",
    "中",
    "θ",
    "a",
    "B2",
    "x y",
    ";",
    "\\u{41}",
];
/// What only texts may hold, names not.
const LINES: [&str; 5] = ["\n", "\r\n", "\u{1b}[31m", "\u{0}", "\t"];

fn name() -> impl Strategy<Value = String> {
    prop::collection::vec(prop::sample::select(&PIECES[..]), 1..5)
        .prop_map(|pieces| pieces.concat().trim().chars().take(100).collect())
        .prop_filter("a name", |name: &String| {
            !name.is_empty() && name.trim() == name && !name.chars().any(char::is_control)
        })
}

fn words() -> impl Strategy<Value = String> {
    let all: Vec<&str> = PIECES.iter().chain(&LINES).copied().collect();
    prop::collection::vec(prop::sample::select(all), 0..6).prop_map(|pieces| pieces.concat())
}

/// The falling stick with these texts and names.
fn told(text: &str, [body, contact, spin, impulse]: [&str; 4]) -> String {
    json!({
        "title": text, "source": text, "statement": text,
        "parameters": {
            "m": {"unit": "kg", "meaning": text, "latex": text}, "l": {"unit": "m"}, "v": {"unit": "m/s"},
            "theta": {"unit": "rad", "domain": {"min": 0, "max": "pi/2"}}
        },
        "points": {"C": [0, 0]},
        "bodies": {
            "ground": {"shape": "fixed"},
            body: {"shape": "rod", "mass": "m", "length": "l", "angle": "theta",
                "center": {"from": "C", "distance": "l/2", "angle": "theta"}, "velocity": [0, "-v"]}
        },
        "contacts": {contact: {"bodies": ["ground", body], "at": "C", "law": "sticking"}},
        "questions": {
            spin: {"spin": body, "clockwise": true, "latex": text},
            impulse: {"impulse": contact, "on": body}
        }
    })
    .to_string()
}

/// A scene in all formats.
struct Formats {
    latex: String,
    markdown: String,
    html: String,
    svg: Vec<String>,
    plain: String,
    code: [String; 3],
}

const LANGUAGES: [Language; 3] = [Language::Rust, Language::C, Language::Python];

fn formats(text: &str) -> Option<Formats> {
    let scene: Scene = match scene::read(text) {
        Ok(scene) => scene,
        Err(faults) => {
            eprintln!("{}", faults.render("scene", text));
            return None;
        }
    };
    let derivation = derive::derive(&scene).ok()?;
    let proof = verify::prove(&scene, &derivation);
    let told = story::tell(&scene).ok()?;
    let solution: Solution = solution::write(&scene, &told, Detail::Full);
    let drawn = figure::draw(&scene, Which::All);
    let picture = Picture {
        slot: Slot::Before,
        svg: drawn.svg.clone(),
        tikz: drawn.tikz(),
        caption: drawn.caption,
        alternative: drawn.alternative,
    };
    let pictures = [(picture.clone(), String::from("a.svg"))];
    let heading = Heading {
        title: scene.title.clone(),
        source: scene.source.clone(),
        assumptions: render::assumptions(&scene, &derivation, &proof),
    };
    let (found, _) = functions(&scene, &derivation);
    Some(Formats {
        latex: render::latex_document::document(&solution, std::slice::from_ref(&picture)),
        markdown: render::markdown::solution(&solution, &pictures),
        html: render::html::page(&solution, &[picture]),
        svg: vec![drawn.svg],
        plain: render::plain::solution(&solution),
        code: LANGUAGES.map(|language| {
            let style = Style {
                language,
                prefix: String::new(),
                record: false,
            };
            file(&style, &heading, &found)
        }),
    })
}

/// Control words and control signs of a LaTeX text.
fn commands(latex: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut rest = latex;
    while let Some(at) = rest.find('\\') {
        rest = &rest[at + 1..];
        let length = rest
            .find(|c: char| !c.is_ascii_alphabetic())
            .unwrap_or(rest.len());
        let end = length.max(rest.chars().next().map_or(0, char::len_utf8));
        found.insert(rest[..end].to_string());
        rest = &rest[end..];
    }
    found
}

/// Commands that words and names of strangers may be set with.
const SETTING: &str = "textbackslash textasciitilde textasciicircum textless textgreater textbar textquotedbl textasciigrave theta dots \
    mathrm mathit text square backslash surd { } # $ % & _ ,";

/// Whether braces close in order, and dollars come in pairs.
fn is_balanced(latex: &str) -> bool {
    let (mut depth, mut dollars, mut escaped) = (0_i32, 0, false);
    for c in latex.chars() {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '{' => depth += 1,
            '}' => depth -= 1,
            '$' => dollars += 1,
            '%' | '#' => return false,
            _ => {}
        }
        if depth < 0 {
            return false;
        }
    }
    depth == 0 && dollars % 2 == 0 && !latex.contains("^^")
}

/// Names of elements and attributes.
fn markup(text: &str) -> BTreeSet<String> {
    let options = roxmltree::ParsingOptions {
        allow_dtd: true,
        ..Default::default()
    };
    let tree = roxmltree::Document::parse_with_options(text, options)
        .unwrap_or_else(|e| panic!("{e}:\n{text}"));
    let elements = tree.descendants().filter(|n| n.is_element());
    elements
        .flat_map(|n| {
            let attributes: Vec<String> =
                n.attributes().map(|a| format!("@{}", a.name())).collect();
            attributes
                .into_iter()
                .chain([n.tag_name().name().to_string()])
        })
        .collect()
}

/// The elements of an HTML page: what stands between a `<` and the next sign that ends a name.
fn tags(html: &str) -> BTreeSet<String> {
    let ends = |c: char| c.is_whitespace() || c == '>' || c == '/' && c != '<';
    let starts = html.split('<').skip(1);
    starts
        .map(|t| {
            let inner = t.strip_prefix('/').unwrap_or(t);
            inner.split(ends).next().unwrap_or_default().to_string()
        })
        .collect()
}

/// The lines of code without comments and without the names of the functions.
fn code(language: Language, text: &str, names: usize) -> Vec<String> {
    let mut out = Vec::new();
    let mut inside = false;
    for line in text.lines().map(str::trim) {
        let (start, end) = match language {
            Language::Rust | Language::NoStd => (line.starts_with("//"), true),
            Language::C => (line.starts_with("/*"), line.ends_with("*/")),
            Language::Python | Language::NumPy => {
                let opens = line.starts_with("\"\"\"");
                (
                    opens || inside,
                    line.ends_with("\"\"\"") && (inside || line.len() > 5),
                )
            }
        };
        if start || inside {
            inside = !end;
            continue;
        }
        out.push(line.to_string());
    }
    assert!(!inside, "a comment without an end:\n{text}");
    let heads: Vec<usize> = out
        .iter()
        .enumerate()
        .filter(|(_, l)| {
            ["pub fn ", "double ", "def "]
                .iter()
                .any(|h| l.starts_with(h))
                && !l.contains("unit_")
        })
        .map(|(i, _)| i)
        .collect();
    assert!(heads.len() >= names, "{text}");
    for i in heads {
        let (head, rest) = out[i].split_once('(').expect("a head");
        let kind = head
            .split_once(' ')
            .map_or("", |(kind, _)| kind)
            .to_string();
        out[i] = format!("{kind} ({rest}");
    }
    out.retain(|l| !l.starts_with("#[allow"));
    out
}

fn harmless() -> &'static Formats {
    static PLAIN: OnceLock<Formats> = OnceLock::new();
    PLAIN.get_or_init(|| formats(&told("A stick", ["bar", "C", "omega", "P"])).expect("a scene"))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn texts_of_strangers_stay_words_in_every_format(
        text in words(), body in name(), contact in name(), spin in name(), impulse in name(),
    ) {
        prop_assume!(body != "ground" && spin != impulse);
        let scene = told(&text, [&body, &contact, &spin, &impulse]);
        let Some(found) = formats(&scene) else {
            // A name may be taken already, that of a parameter say.
            return Ok(());
        };
        let plain = harmless();
        let allowed: BTreeSet<String> = commands(&plain.latex)
            .into_iter()
            .chain(SETTING.split_whitespace().map(String::from))
            .collect();
        let strange: Vec<String> = commands(&found.latex).difference(&allowed).cloned().collect();
        prop_assert!(strange.is_empty(), "{strange:?}\n{}", found.latex);
        // The document's own definitions have arguments.
        let own = |line: &&str| ["\\newcommand{\\fitted}", "\\providecommand{\\shown}"].iter().all(|d| !line.starts_with(d));
        let body = found.latex.lines().filter(own).collect::<Vec<_>>().join("\n");
        prop_assert!(is_balanced(&body), "{}", found.latex);
        let stripped = found.markdown.replace("\\<", "");
        prop_assert!(!stripped.contains('<'), "{}", found.markdown);
        prop_assert!(!stripped.contains("://") && !stripped.contains("```"), "{}", found.markdown);
        let signs = |text: &str| text.matches("$$").count();
        prop_assert_eq!(signs(&found.markdown) % 2, 0);
        for line in found.markdown.split("\n\n").filter(|l| !l.starts_with("$$")) {
            let dollars = line.matches('$').count();
            prop_assert!(dollars % 2 == 0, "{line}");
            for math in line.split('$').skip(1).step_by(2) {
                let strange: Vec<String> = commands(math).difference(&allowed).cloned().collect();
                prop_assert!(strange.is_empty(), "{math}");
            }
        }
        for (mine, theirs) in found.svg.iter().zip(&plain.svg) {
            let new: Vec<String> = markup(mine).difference(&markup(theirs)).cloned().collect();
            prop_assert!(new.is_empty(), "{new:?}");
        }
        let new: Vec<String> = tags(&found.html).difference(&tags(&plain.html)).cloned().collect();
        // An index that is a word is set upright, one of several parts in a row.
        prop_assert!(new.iter().all(|t| ["mrow", "span", "mtext", "mspace", "mn", "msub", "mi", "mo", "msubsup", "br", "wbr"].contains(&t.as_str())), "{new:?}");
        for ((language, mine), theirs) in LANGUAGES.into_iter().zip(&found.code).zip(&plain.code) {
            prop_assert_eq!(code(language, mine, 3), code(language, theirs, 3));
        }
        let all = [&found.latex, &found.markdown, &found.html, &found.plain].into_iter();
        for text in all.chain(&found.svg).chain(&found.code) {
            let hidden = text.chars().find(|c| is_hidden(*c) && *c != '\n');
            prop_assert_eq!(hidden, None, "{}", text);
        }
        for line in found.plain.lines() {
            prop_assert!(line.chars().count() < 2_000);
        }
    }
}

/// A folder of this test's own.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("formats-{name}"));
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

#[test]
fn code_with_such_titles_compiles() {
    let folder = folder("code");
    let all: String = PIECES.iter().chain(&LINES).flat_map(|p| [p, " "]).collect();
    let tight: String = PIECES.iter().chain(&LINES).copied().collect();
    for (i, text) in [
        all.as_str(),
        &tight,
        "*\\",
        "\n#![cfg(any())]\n",
        "*??/\n/ int x",
        "\"\"\"\nimport os",
    ]
    .into_iter()
    .enumerate()
    {
        let scene = told(text, ["<bar>\u{202e}", "*/ C", "\"\"\"\\", "\\input{x}"]);
        let found = formats(&scene).expect("a scene");
        let commands: [(&str, &str, &[&str]); 3] = [
            (
                "a.rs",
                "rustc",
                &[
                    "--edition",
                    "2021",
                    "-D",
                    "warnings",
                    "--crate-type",
                    "lib",
                    "-o",
                    "a.rlib",
                    "a.rs",
                ],
            ),
            (
                "a.c",
                "cc",
                &[
                    "-std=c99", "-Wall", "-Wextra", "-Werror", "-c", "-o", "a.o", "a.c",
                ],
            ),
            (
                "a.py",
                "python3",
                &[
                    "-B",
                    "-W",
                    "error",
                    "-c",
                    "import a; print(len([f for f in dir(a) if f.startswith('q')]))",
                ],
            ),
        ];
        for ((name, tool, arguments), text) in commands.into_iter().zip(&found.code) {
            fs::write(folder.join(name), text).expect("written");
            let Ok(done) = Command::new(tool)
                .current_dir(&folder)
                .args(arguments)
                .output()
            else {
                eprintln!("skipped: no {tool} on this machine");
                continue;
            };
            assert!(
                done.status.success(),
                "{i} {tool}:\n{}\n{text}",
                String::from_utf8_lossy(&done.stderr)
            );
        }
    }
}

#[test]
fn data_for_programs_carries_a_version() {
    let stick = "derivations/book/falling-stick.json";
    let values = ["--set=m=1", "--set=l=1", "--set=v=2", "--set=theta=1"];
    let rod = "derivations/friction/rod-turns-its-slip-round.json";
    let commands: [&[&str]; 12] = [
        &["derive", stick],
        &["derive", stick, "--matrix"],
        &["derive", rod],
        &[&["solve", stick], &values[..]].concat(),
        &["grade", stick, "--quantity=omega", "--answer=v/l"],
        &["grade", "--expected=a", "--answer=a +"],
        &["verify", stick],
        &["solution", stick],
        &["compare", rod],
        &["compare", "derivations/more/newtons-cradle.json"],
        &["read", "x + 1"],
        &["check-scene", stick],
    ];
    for command in commands {
        let run = Command::new(env!("CARGO_BIN_EXE_carom"))
            .args(command)
            .arg("--format=json")
            .output()
            .expect("the program starts");
        let told: serde_json::Value =
            serde_json::from_slice(&run.stdout).unwrap_or_else(|e| panic!("{command:?}: {e}"));
        assert_eq!(told["version"], 1, "{command:?}");
    }
}
