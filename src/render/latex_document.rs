//! A worked solution in LaTeX: a fragment for a handout, or a document that compiles on its own with pdfLaTeX.

use super::html::Picture;
use super::markdown::matrix;
use super::math::{latex, rows};
use crate::solution::{Inline, Part, Solution};

/// A document that compiles on its own; `pictures` are included by their file names.
pub fn document(s: &Solution, pictures: &[(Picture, String)]) -> String {
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
         \\setlength{{\\parindent}}{{0pt}}\n\
         \\setlength{{\\parskip}}{{6pt}}\n\
         \\begin{{document}}\n\
         \\section*{{{}}}\n{}\\end{{document}}\n",
        if pictures.is_empty() {
            ""
        } else {
            "\\usepackage{graphicx}\n"
        },
        text(title),
        body(s, pictures)
    )
}

/// The text alone, to be put into a document that loads amsmath and amssymb, and graphicx where there are pictures.
pub fn fragment(s: &Solution, pictures: &[(Picture, String)]) -> String {
    let title = if s.title.is_empty() {
        "Worked solution"
    } else {
        &s.title
    };
    format!("\\section*{{{}}}\n{}", text(title), body(s, pictures))
}

fn body(s: &Solution, pictures: &[(Picture, String)]) -> String {
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
                Part::Matrix(m) => {
                    out.push_str(&format!("\\[\n{}\n\\]\n", matrix(s, m)));
                }
                Part::Figure(slot) => {
                    for (picture, file) in pictures.iter().filter(|(p, _)| p.slot == *slot) {
                        out.push_str(&format!(
                            "\\begin{{center}}\n\\includegraphics[width=0.62\\linewidth]{{{file}}}\n"
                        ));
                        if !picture.caption.is_empty() {
                            let caption = text(&picture.caption);
                            out.push_str(&format!("\n{{\\small {caption}}}\n"));
                        }
                        out.push_str("\\end{center}\n\n");
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

/// Words with everything TeX would act on made literal; what the usual fonts do not have is named by its number.
pub fn text(words: &str) -> String {
    let mut out = String::new();
    for c in crate::formula::visible(words).chars() {
        match c {
            '\\' => out.push_str("\\textbackslash{}"),
            '{' | '}' | '#' | '$' | '%' | '&' | '_' => {
                out.push('\\');
                out.push(c);
            }
            '~' => out.push_str("\\textasciitilde{}"),
            '^' => out.push_str("\\textasciicircum{}"),
            '<' => out.push_str("\\textless{}"),
            '>' => out.push_str("\\textgreater{}"),
            '|' => out.push_str("\\textbar{}"),
            '"' => out.push_str("\\textquotedbl{}"),
            '`' => out.push_str("\\textasciigrave{}"),
            '≠' => out.push_str("$\\ne$"),
            '≤' => out.push_str("$\\le$"),
            '≥' => out.push_str("$\\ge$"),
            '≈' => out.push_str("$\\approx$"),
            '→' => out.push_str("$\\to$"),
            '∞' => out.push_str("$\\infty$"),
            '−' => out.push_str("$-$"),
            '×' => out.push_str("$\\times$"),
            '·' => out.push_str("$\\cdot$"),
            'ℓ' => out.push_str("$\\ell$"),
            '²' => out.push_str("$^2$"),
            '³' => out.push_str("$^3$"),
            '°' => out.push_str("$^\\circ$"),
            '⁺' => out.push_str("$^+$"),
            '⁻' => out.push_str("$^-$"),
            '₀'..='₉' => out.push_str(&format!("$_{}$", u32::from(c) - 0x2080)),
            '\u{2013}' => out.push_str("--"),
            '\u{2014}' => out.push_str("---"),
            '\u{2018}' => out.push('`'),
            '\u{2019}' => out.push('\''),
            '\u{201c}' => out.push_str("``"),
            '\u{201d}' => out.push_str("''"),
            '…' => out.push_str("\\dots{}"),
            c if greek(c).is_some() => {
                out.push_str(&format!("${}$", greek(c).unwrap_or_default()));
            }
            c if c.is_ascii() || LATIN.contains(c) => out.push(c),
            c => out.push_str(&format!("[U+{:04X}]", u32::from(c))),
        }
    }
    out
}

/// Letters that T1 fonts have.
const LATIN: &str = "ÀÁÂÃÄÅÆÇÈÉÊËÌÍÎÏÐÑÒÓÔÕÖØÙÚÛÜÝÞßàáâãäåæçèéêëìíîïðñòóôõöøùúûüýþÿĀāĂăĄąĆćČčĎďĐđĘęĚěĞğĹĺĽľŁłŃńŇňŐőŒœŔŕŘřŚśŞşŠšŤťŰűŮůŸŹźŻżŽž";

fn greek(c: char) -> Option<String> {
    let name = crate::formula::latex_name(&c.to_string());
    let small = ('α'..='ω').contains(&c) || "ΓΔΘΛΞΠΣΦΨΩ".contains(c);
    (small && name.starts_with('\\')).then_some(name)
}
