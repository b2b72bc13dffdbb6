//! A worked solution in LaTeX: a fragment for a handout, or a document that compiles on its own with pdfLaTeX.

use super::html::Picture;
use super::markdown::{aligned, matrix};
use super::math::{latex, rows};
use crate::figure::{self, Piece};
use crate::solution::{Inline, Part, Solution};

/// A document that compiles on its own and holds its pictures.
pub fn document(s: &Solution, pictures: &[Picture]) -> String {
    let title = if s.title.is_empty() {
        "Worked solution"
    } else {
        &s.title
    };
    format!(
        "\\documentclass[11pt]{{article}}\n\
         \\usepackage[T1]{{fontenc}}\n\
         \\usepackage[a4paper,margin=25mm]{{geometry}}\n\
         \\usepackage{{amsmath,amssymb}}\n\
         {}\
         \\allowdisplaybreaks\n\
         \\clubpenalty=10000 \\widowpenalty=10000\n\
         \\setlength{{\\parindent}}{{0pt}}\n\
         \\setlength{{\\parskip}}{{6pt}}\n\
         \\begin{{document}}\n\
         \\section*{{{}}}\n{}\\end{{document}}\n",
        match pictures.is_empty() {
            true => String::new(),
            false => format!("\\usepackage{{tikz}}\n{}", figure::COLORS),
        },
        text(title),
        body(s, pictures)
    )
}

/// The text alone, to be put into a document that loads amsmath and amssymb, and tikz where there are pictures.
pub fn fragment(s: &Solution, pictures: &[Picture]) -> String {
    let title = if s.title.is_empty() {
        "Worked solution"
    } else {
        &s.title
    };
    format!("\\section*{{{}}}\n{}", text(title), body(s, pictures))
}

fn body(s: &Solution, pictures: &[Picture]) -> String {
    let mut out = String::new();
    if !s.source.is_empty() {
        out.push_str(&format!("\\emph{{{}}}\n\n", text(&s.source)));
    }
    for section in &s.sections {
        if !section.heading.is_empty() {
            out.push_str(&format!(
                "\\{}section*{{{}}}\n",
                "sub".repeat(1 + section.depth.min(1)),
                sentence(s, &section.heading)
            ));
        }
        for part in &section.parts {
            match part {
                Part::Text(words) => out.push_str(&format!("{}\n\n", sentence(s, words))),
                Part::List(items) => {
                    out.push_str("\\begin{itemize}\n");
                    for item in items {
                        out.push_str(&format!("\\item {}\n", sentence(s, item)));
                    }
                    out.push_str("\\end{itemize}\n\n");
                }
                Part::Display(lines) => {
                    let rows: Vec<String> = rows(s, lines)
                        .iter()
                        .map(|[l, r]| format!("{} & {}", latex(s, l), latex(s, r)))
                        .collect();
                    out.push_str(&format!(
                        "\\begin{{align*}}\n{}\n\\end{{align*}}\n",
                        rows.join(" \\\\\n")
                    ));
                }
                Part::Result(lines) => {
                    out.push_str(&format!("\\[\n\\boxed{{{}}}\n\\]\n", aligned(s, lines)));
                }
                Part::Matrix(m) => {
                    out.push_str(&format!("\\[\n{}\n\\]\n", matrix(s, m)));
                }
                Part::Figure(slot) => {
                    // A picture and its caption stay together.
                    for picture in pictures.iter().filter(|p| p.slot == *slot) {
                        out.push_str(&format!(
                            "\\begin{{center}}\n\\begin{{minipage}}{{0.86\\linewidth}}\\centering\n{}\\par\\smallskip\n{{\\small {}\\par}}\n\\end{{minipage}}\n\\end{{center}}\n\n",
                            picture.tikz.trim_end(),
                            caption(&picture.caption)
                        ));
                    }
                }
            }
        }
    }
    // Older LaTeX knows no \lt outside MathJax.
    out.replace("\\lt", "<")
}

fn sentence(s: &Solution, pieces: &[Inline]) -> String {
    pieces
        .iter()
        .map(|piece| match piece {
            Inline::Text(words) => text(words),
            Inline::Math(math) => format!("${}$", latex(s, math)),
        })
        .collect()
}

/// Words with everything TeX would act on made literal.
pub fn text(words: &str) -> String {
    figure::escaped(&crate::formula::visible(words))
}

fn caption(pieces: &[Piece]) -> String {
    let each = pieces.iter().map(|piece| match piece {
        Piece::Words(words) => text(words),
        Piece::Symbol(label) => format!("${}$", label.to_latex()),
    });
    each.collect()
}
