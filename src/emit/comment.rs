//! Comments of emitted code: what stands at the head of a file, what a function takes, and the error it promises.

use super::dialect::Language;
use super::function::{Function, LIBRARY};
use crate::formula::visible;

/// What stands at the head of a file.
#[derive(Clone, Debug, Default)]
pub struct Heading {
    /// Title of the scene.
    pub title: String,
    /// Where it comes from.
    pub source: String,
    /// What all functions take for granted.
    pub assumptions: Vec<String>,
}

/// What stands at the head of a file.
pub(super) fn head(heading: &Heading, functions: &[Function]) -> Vec<String> {
    let mut lines = vec![match heading.source.is_empty() {
        true => heading.title.clone(),
        false => format!("{} ({})", heading.title, heading.source),
    }];
    lines.push(String::new());
    lines.push(format!(
        "Written by carom {}. Values are in SI units, angles in radians; x points right, y up.",
        env!("CARGO_PKG_VERSION")
    ));
    if !heading.assumptions.is_empty() {
        lines.push(format!("Assumes {}.", heading.assumptions.join(", ")));
    }
    if functions.iter().any(|f| f.bound.is_some()) {
        let mut text = String::from(
            "Errors are relative, for the arguments as given, in round-to-nearest and without contraction or fast-math",
        );
        if functions.iter().flat_map(|f| &f.turns).any(|t| !t.wide) {
            text.push_str(&format!(
                ", with cosines and sines of the library good to {} unit in the last place",
                LIBRARY / 2.0
            ));
        }
        text.push_str(". Nothing over- or underflows while every argument is zero or of a size in the range stated.");
        lines.push(text);
    }
    lines
}

/// Lines as a comment: of the file, or of the item that follows.
pub(super) fn comment(language: Language, lines: &[String], of_file: bool) -> String {
    let lines: Vec<String> = lines.iter().flat_map(|l| wrapped(&harmless(l))).collect();
    let mut out = String::new();
    match language {
        Language::Rust | Language::NoStd => {
            let mark = if of_file { "//!" } else { "///" };
            for line in &lines {
                out.push_str(format!("{mark} {line}").trim_end());
                out.push('\n');
            }
        }
        Language::C => {
            out.push_str("/* ");
            out.push_str(&lines.join("\n   ").replace("   \n", "\n"));
            out.push_str(" */\n");
        }
        Language::Python | Language::NumPy => {
            let indent = if of_file { "" } else { "    " };
            out.push_str(&format!("{indent}\"\"\"{}", lines[0]));
            for line in &lines[1..] {
                out.push('\n');
                out.push_str(format!("{indent}{line}").trim_end());
            }
            let end = if lines.len() > 1 {
                format!("\n{indent}")
            } else {
                String::new()
            };
            out.push_str(&format!("{end}\"\"\"\n"));
        }
    }
    out
}

/// Words that end no comment and no text in quotes, and start none, in any of the languages.
fn harmless(words: &str) -> String {
    let mut out = String::new();
    for c in visible(words).chars() {
        let c = match c {
            '\\' => '/',
            '"' => '\'',
            c => c,
        };
        // `??` starts a trigraph of C.
        if matches!(
            (out.chars().last(), c),
            (Some('*'), '/') | (Some('/'), '*') | (Some('?'), '?')
        ) {
            out.push(' ');
        }
        out.push(c);
    }
    out
}

/// Breaks at blanks, about a hundred characters a line.
fn wrapped(line: &str) -> Vec<String> {
    let mut out = vec![String::new()];
    for word in line.split(' ') {
        let last = out.last_mut().expect("never empty");
        if !last.is_empty() && last.chars().count() + word.chars().count() > 100 {
            out.push(format!("  {word}"));
        } else {
            if !last.is_empty() {
                last.push(' ');
            }
            last.push_str(word);
        }
    }
    out
}

/// What the comment of a function says.
pub(super) fn documentation(f: &Function, names: &[String]) -> Vec<String> {
    let mut lines = vec![format!(
        "{}: {} [{}].",
        f.name,
        f.words.trim_end_matches('.'),
        f.unit
    )];
    lines.push(String::new());
    lines.push(format!("`{}`", f.formula));
    lines.push(String::new());
    for (argument, name) in f.arguments.iter().zip(names) {
        let meaning = match argument.meaning.is_empty() {
            true => String::new(),
            false => format!(": {}", argument.meaning),
        };
        let domain = match argument.domain.is_empty() {
            true => String::new(),
            false => format!(", {}", argument.domain),
        };
        lines.push(format!("{name} [{}]{meaning}{domain}", argument.unit));
    }
    if !f.arguments.is_empty() {
        lines.push(String::new());
    }
    lines.extend(promise(f, names));
    lines
}

/// The bound in words, and what it covers.
fn promise(f: &Function, names: &[String]) -> Vec<String> {
    let Some(bound) = f.bound else {
        return vec![
            "Error: no bound is stated, for it rests on a library function of unknown error."
                .into(),
        ];
    };
    // First order made safe: the terms left out are below 10⁻⁹ of those kept. One decimal, rounded up.
    let up = |v: f64| (v * 10.0 * (1.0 + 1e-9) + 1e-9).ceil() / 10.0;
    if bound.plain == 0.0 && bound.wide == 0.0 {
        return vec!["Error: none, the value is exact.".into()];
    }
    let size = |v: f64| format!("{:.1e}", v * super::program::UNIT * 1.05);
    let plain = up(bound.plain);
    let mut text = format!("Error: at most {} ({plain} * 2^-53)", size(plain));
    if bound.wide > 0.0 {
        text.push_str(&format!(
            ", plus {:.1e} times how far sums cancel: the sizes of the terms added, over the size of their sum, for \
             the sum that cancels most (for nested sums the product)",
            bound.wide * super::program::UNIT * 1.1
        ));
    }
    if f.turns.iter().any(|t| t.wide) {
        text.push_str(", for angles up to 100");
    }
    text.push_str(&format!(". Range: 1e-{0} to 1e{0}", f.reach));
    if let Some(units) = &f.units {
        let near = units.of.iter().map(|class| match class.as_slice() {
            [one] => names[*one].clone(),
            many => {
                let list: Vec<&str> = many.iter().map(|a| names[*a].as_str()).collect();
                format!("the largest of {}", list.join(", "))
            }
        });
        text.push_str(&format!(
            "; beyond, while they are in units in which {} {} near one, powers of two that change no digit",
            near.collect::<Vec<_>>().join(" and "),
            if units.of.len() == 1 { "is" } else { "are" },
        ));
    }
    text.push_str(match bound.wide > 0.0 {
        true => ", unless a sum cancels to less.",
        false => ".",
    });
    vec![text]
}
