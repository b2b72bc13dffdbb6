//! Writes a display list as TikZ, for documents that set their figures with their own fonts.
//!
//! In: what is drawn. Out: a `tikzpicture`. A label becomes a formula made of known commands and escaped letters only, so that
//! nothing a scene says is obeyed.

use super::label::latex::command;
use super::label::{Label, Level, Run};
use super::plane::Pair;
use super::sheet::{Ink, Item, Paint};
use super::svg::number;

/// Points of print for a pixel of the screen.
const SCALE: f64 = 0.72;

/// The colors a document defines before its first figure.
pub const COLORS: &str = "\\definecolor{motion}{HTML}{2F81D6}\n\\definecolor{impulse}{HTML}{D9534A}\n\\definecolor{dimension}{HTML}{858B93}\n\
\\definecolor{curve0}{HTML}{2F81D6}\n\\definecolor{curve1}{HTML}{D9534A}\n\\definecolor{curve2}{HTML}{2E965F}\n\
\\definecolor{curve3}{HTML}{B06ECD}\n\\definecolor{curve4}{HTML}{C4801C}\n\\definecolor{curve5}{HTML}{1496A0}\n\
\\definecolor{curve6}{HTML}{C2468F}\n\\definecolor{curve7}{HTML}{8A6A4C}\n";

/// The picture; `y` grows upwards, as on the sheet.
pub(super) fn write(items: &[Item]) -> String {
    let mut out =
        format!("\\begin{{tikzpicture}}[x={SCALE}bp,y={SCALE}bp,line cap=round,line join=round]\n");
    for item in items {
        out.push_str(&one(item));
    }
    out.push_str("\\end{tikzpicture}\n");
    out
}

/// Names of the colors of curves.
const CURVES: [&str; 8] = [
    "curve0", "curve1", "curve2", "curve3", "curve4", "curve5", "curve6", "curve7",
];

fn at(p: &Pair) -> String {
    format!("({},{})", number(p[0]), number(p[1]))
}

fn color(ink: Ink) -> &'static str {
    match ink {
        Ink::Body | Ink::Ground => "black",
        Ink::Motion => "motion",
        Ink::Impulse => "impulse",
        Ink::Dimension => "dimension",
        Ink::Grid => "dimension!25",
        Ink::Curve(i) => CURVES[i % CURVES.len()],
    }
}

fn style(paint: &Paint) -> String {
    let line = match paint {
        Paint::Stroke(line) => line,
        Paint::Fill(ink) => return format!("fill={}", color(*ink)),
    };
    let color = color(line.ink);
    let mut out = format!("draw={color},line width={}bp", number(line.width * SCALE));
    if line.dashed {
        out.push_str(",dash pattern=on 3bp off 2.2bp");
    }
    if line.filled {
        out.push_str(&format!(",fill={color},fill opacity=0.09,draw opacity=1"));
    }
    out
}

/// A line through points.
fn path(points: &[Pair], closed: bool) -> String {
    let through: Vec<String> = points.iter().map(at).collect();
    format!(
        "{}{}",
        through.join("--"),
        if closed { "--cycle" } else { "" }
    )
}

fn one(item: &Item) -> String {
    match item {
        Item::Path {
            points,
            closed,
            paint,
        } => format!("\\path[{}] {};\n", style(paint), path(points, *closed)),
        Item::Circle {
            center,
            radius,
            paint,
        } => format!(
            "\\path[{}] {} circle[radius={}];\n",
            style(paint),
            at(center),
            number(*radius)
        ),
        Item::Noted { item, .. } => one(item),
        Item::Text {
            at: place,
            size,
            bold,
            label,
            ..
        } => node(place, *size, *bold, label),
    }
}

/// A label whose line of text begins at a place.
pub fn node(place: &[f64; 2], size: f64, bold: bool, label: &Label) -> String {
    let points = size * SCALE;
    let words = label
        .runs
        .iter()
        .all(|r| r.level == Level::Base && !r.italic);
    let body = match (words, bold) {
        (true, true) => format!("\\textbf{{{}}}", escaped(&label.text())),
        (true, false) => escaped(&label.text()),
        (false, _) => format!("${}$", label.to_latex()),
    };
    format!(
        "\\node[anchor=base west,inner sep=0pt,font=\\fontsize{{{}}}{{{}}}\\selectfont] at {} {{{body}}};\n",
        number(points),
        number(points * 1.2),
        at(place)
    )
}

/// Words with everything TeX would act on made literal; what the usual fonts lack is left out.
pub fn escaped(words: &str) -> String {
    let mut out = String::new();
    for c in words.chars() {
        match c {
            '\\' => out.push_str("\\textbackslash{}"),
            '{' | '}' | '#' | '$' | '%' | '&' | '_' => {
                out.push('\\');
                out.push(c);
            }
            '~' => out.push_str("\\textasciitilde{}"),
            '^' => out.push_str("\\textasciicircum{}"),
            '<' | '>' | '|' => out.push_str(&format!("${c}$")),
            '"' => out.push_str("\\textquotedbl{}"),
            '`' => out.push_str("\\textasciigrave{}"),
            '\u{2013}' => out.push_str("--"),
            '\u{2014}' => out.push_str("---"),
            '\u{2018}' => out.push('`'),
            '\u{2019}' => out.push('\''),
            '\u{201c}' => out.push_str("``"),
            '\u{201d}' => out.push_str("''"),
            '\u{307}' | '\u{308}' => {
                let letter = out.pop().unwrap_or(' ');
                let dots = if c == '\u{308}' { "ddot" } else { "dot" };
                out.push_str(&format!("$\\{dots}{{{letter}}}$"));
            }
            c => match command(c) {
                Some(known) => out.push_str(&format!("${known}$")),
                None if c.is_ascii() || LATIN.contains(c) => out.push(c),
                None => out.push_str("$\\square$"),
            },
        }
    }
    out
}

/// Letters that T1 fonts have.
const LATIN: &str = "ÀÁÂÃÄÅÆÇÈÉÊËÌÍÎÏÐÑÒÓÔÕÖØÙÚÛÜÝÞßàáâãäåæçèéêëìíîïðñòóôõöøùúûüýþÿĀāĂăĄąĆćČčĎďĐđĘęĚěĞğĹĺĽľŁłŃńŇňŐőŒœŔŕŘřŚśŞşŠšŤťŰűŮůŸŹźŻżŽž";

impl Label {
    /// The label as a formula of LaTeX: letters, known commands, indices.
    pub fn to_latex(&self) -> String {
        let mut out = String::new();
        let mut i = 0;
        while i < self.runs.len() {
            let level = self.runs[i].level;
            let same = self.runs[i..]
                .iter()
                .take_while(|r| r.level == level)
                .count();
            let inner: String = self.runs[i..i + same].iter().map(run).collect();
            match level {
                Level::Base => out.push_str(&inner),
                Level::Sub => out.push_str(&format!("_{{{inner}}}")),
                Level::Sup if inner.chars().all(|c| c == '\'') => out.push_str(&inner),
                Level::Sup => out.push_str(&format!("^{{{inner}}}")),
            }
            i += same;
        }
        out
    }
}

fn run(run: &Run) -> String {
    let mut out = String::new();
    let mut word = String::new();
    let flush = |word: &mut String, out: &mut String| {
        if word.is_empty() {
            return;
        }
        let plain =
            run.italic && word.chars().count() == 1 || word.chars().all(|c| c.is_ascii_digit());
        out.push_str(&match (plain, run.italic) {
            (true, _) => word.clone(),
            (false, true) => format!("\\mathit{{{word}}}"),
            (false, false) => format!("\\mathrm{{{word}}}"),
        });
        word.clear();
    };
    for c in run.text.chars() {
        // A mark stands over the letter before it.
        let mark = match c {
            '\u{307}' => "\\dot",
            '\u{308}' => "\\ddot",
            '\u{302}' => "\\hat",
            '\u{304}' => "\\bar",
            '\u{303}' => "\\tilde",
            _ => "",
        };
        if !mark.is_empty() {
            if word.is_empty() {
                let start = out.rfind('\\').unwrap_or(0);
                let base = out.split_off(start);
                out.push_str(&format!("{mark}{{{}}}", base.trim_end()));
            } else {
                let letter = word.pop().unwrap_or(' ');
                flush(&mut word, &mut out);
                out.push_str(&format!("{mark}{{{letter}}}"));
            }
            continue;
        }
        if c.is_ascii_alphanumeric() {
            word.push(c);
            continue;
        }
        flush(&mut word, &mut out);
        match c {
            ' ' | '\u{2009}' => out.push_str("\\,"),
            '′' => out.push('\''),
            '{' | '}' | '#' | '$' | '%' | '&' | '_' => {
                out.push('\\');
                out.push(c);
            }
            '\\' => out.push_str("\\backslash "),
            '~' | '^' | '"' | '`' => {}
            c if c.is_ascii() => out.push(c),
            c => match command(c) {
                Some(known) => {
                    out.push_str(&known);
                    if known.ends_with(|c: char| c.is_alphabetic()) {
                        out.push(' ');
                    }
                }
                None if LATIN.contains(c) => out.push_str(&format!("\\text{{{c}}}")),
                None => out.push_str("\\square "),
            },
        }
    }
    flush(&mut word, &mut out);
    match run.arrow {
        true => format!("\\vec{{{}}}", out.trim_end()),
        false => out,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_label_is_a_formula_of_known_commands() {
        for (spelling, formula) in [
            ("\\vec{v}_{G1}^{+}", "\\vec{v}_{G1}^{+}"),
            ("\\omega_1^-", "\\omega _{1}^{-}"),
            ("\\dot\\phi", "\\dot{\\phi}"),
            ("\\input{x}", "\\mathrm{input}x"),
        ] {
            let written = Label::latex(spelling).to_latex();
            assert_eq!(written, formula, "{spelling}");
        }
        assert_eq!(
            escaped("50% of \\x_1, θ"),
            "50\\% of \\textbackslash{}x\\_1, $\\theta$"
        );
    }
}
