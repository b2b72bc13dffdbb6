//! A worked solution in LaTeX: a fragment for a handout, or a document that compiles on its own with pdfLaTeX.

use super::html::Picture;
use super::markdown::{aligned, matrix};
use super::math::{self, apart, rows, width};
use crate::figure::{self, Piece};
use crate::solution::{Inline, Line, Math, Part, Solution};

/// A document that compiles on its own and holds its pictures.
pub fn document(s: &Solution, pictures: &[Picture]) -> String {
    let title = s.heading();
    format!(
        "\\documentclass[11pt]{{article}}\n\
         \\usepackage[T1]{{fontenc}}\n\
         \\usepackage[a4paper,margin=25mm]{{geometry}}\n\
         \\usepackage{{amsmath,amssymb,graphicx}}\n\
         {FITTED}\
         {}\
         \\allowdisplaybreaks\n\
         \\makeatletter \\@beginparpenalty=10000 \\makeatother\n\
         \\AtBeginDocument{{\\abovedisplayshortskip=\\abovedisplayskip}}\n\
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

/// Scales a formula that is wider than the line down to it.
const FITTED: &str = "\\newcommand{\\fitted}[1]{\\sbox0{$\\displaystyle #1$}\\ifdim\\wd0>\\linewidth\\resizebox{\\linewidth}{!}{\\usebox0}\\else\\usebox0\\fi}\n";
/// A picture that keeps its caption; two stand beside each other where both are narrow enough.
const SHOWN: &str = "\\providecommand{\\shown}[3][.47]{\\sbox0{#2}\\begin{minipage}[t]{\\ifdim\\wd0>#1\\linewidth .86\\else#1\\fi\\linewidth}\\centering\\usebox0\\par\\smallskip{\\small #3\\par}\\end{minipage}}\n";
/// About as many characters as a line of the document holds; a formula that has more is made to fit.
const LINE: usize = 80;

/// The text alone, to be put into a document that loads amsmath and amssymb, and tikz where there are pictures.
pub fn fragment(s: &Solution, pictures: &[Picture]) -> String {
    let title = s.heading();
    let body = body(s, pictures);
    // The document around it may say how a wide formula is made to fit.
    let fitted = match body.contains("\\fitted") {
        true => "\\providecommand{\\fitted}[1]{#1}\n",
        false => "",
    };
    format!("{fitted}\\section*{{{}}}\n{body}", text(title))
}

/// A formula, with the π of a name spelled out: other Greek letters are where a name is read.
fn latex(s: &Solution, math: &[Math]) -> String {
    math::latex(s, math).replace('π', "\\pi ")
}

fn body(s: &Solution, pictures: &[Picture]) -> String {
    let mut out = match pictures {
        [] => String::new(),
        _ => String::from(SHOWN),
    };
    if !s.source.is_empty() {
        out.push_str(&format!("\\emph{{{}}}\n\n", text(&s.source)));
    }
    for section in &s.sections {
        if !section.heading.is_empty() {
            out.push_str(&format!(
                "\\{}*{{{}}}\n",
                ["subsection", "subsubsection", "paragraph"][section.depth.min(2)],
                sentence(s, &section.heading)
            ));
        }
        for (p, part) in section.parts.iter().enumerate() {
            let displays =
                |part: &Part| matches!(part, Part::Display(_) | Part::Result(_) | Part::Matrix(_));
            match part {
                Part::Text(words) => {
                    // A formula belongs to the paragraph that leads to it.
                    let goes_on = section.parts.get(p + 1).is_some_and(displays);
                    let end = if goes_on { "\n" } else { "\n\n" };
                    out.push_str(&format!("{}{end}", sentence(s, words)));
                }
                Part::List(items) => {
                    out.push_str("\\begin{itemize}\n");
                    for item in items {
                        out.push_str(&format!("\\item {}\n", sentence(s, item)));
                    }
                    out.push_str("\\end{itemize}\n\n");
                }
                Part::Display(lines) => {
                    let parts = apart(s, lines).into_iter();
                    out.extend(parts.map(|lines| display(s, lines)));
                }
                Part::Result(lines) => {
                    let boxed = match rows(s, lines).as_slice() {
                        [[left, right]] => format!("{} {}", latex(s, left), latex(s, right)),
                        _ => aligned(s, lines),
                    };
                    let boxed = format!("\\boxed{{{boxed}}}");
                    out.push_str(&match is_wide(s, lines) {
                        true => format!("\\[\n\\fitted{{{boxed}}}\n\\]\n"),
                        false => format!("\\[\n{boxed}\n\\]\n"),
                    });
                }
                Part::Matrix(m) => {
                    out.push_str(&format!("\\[\n{}\n\\]\n", matrix(s, m)));
                }
                Part::Figure(slot) => {
                    let here = pictures.iter().filter(|p| p.slot == *slot);
                    out.push_str(&row(&here.collect::<Vec<_>>()));
                }
            }
        }
    }
    // Older LaTeX knows no \lt outside MathJax.
    out.replace("\\lt", "<")
}

/// Equations below each other, in smaller print where they are wider than the page.
fn display(s: &Solution, lines: &[Line]) -> String {
    if is_wide(s, lines) {
        return format!("\\[\n\\fitted{{{}}}\n\\]\n", aligned(s, lines));
    }
    let rows: Vec<String> = rows(s, lines)
        .iter()
        .map(|[l, r]| format!("{} & {}", latex(s, l), latex(s, r)))
        .collect();
    format!(
        "\\begin{{align*}}\n{}\n\\end{{align*}}\n",
        rows.join(" \\\\\n")
    )
}

/// Pictures beside each other; a page may end between their lines.
fn row(pictures: &[&Picture]) -> String {
    let width = match pictures {
        [] => return String::new(),
        [_] => "[.86]",
        _ => "",
    };
    let shown = |p: &&Picture| {
        let caption = caption(&p.caption);
        format!("\\shown{width}{{{}}}{{{caption}}}\n", p.tikz.trim_end())
    };
    let all: String = pictures.iter().map(shown).collect();
    format!(
        "\\begin{{center}}\\leavevmode\\lineskip=9pt\\clubpenalty=0\\widowpenalty=0\n{all}\\end{{center}}\n\n"
    )
}

/// Whether a line of a display is wider than the page, as far as its characters tell.
fn is_wide(s: &Solution, lines: &[Line]) -> bool {
    let mut rows = rows(s, lines).into_iter();
    rows.any(|[left, right]| width(s, &left) + width(s, &right) > LINE)
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
        // It stays on the line of its symbol.
        Piece::Value(value) => format!("~=~{}", text(value).replace(' ', "~")),
        Piece::Symbol(label) => format!("${}$", label.to_latex()),
    });
    each.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solution::Slot;

    #[test]
    fn narrow_pictures_of_one_place_stand_in_one_row() {
        let picture = Picture {
            slot: Slot::Before,
            svg: String::new(),
            tikz: String::from("\\tikz{}\n"),
            caption: vec![Piece::Words(String::from("Just before."))],
            alternative: String::new(),
        };
        let two = row(&[&picture, &picture]);
        assert_eq!(two.matches("\\begin{center}").count(), 1);
        assert_eq!(two.matches("\\shown{\\tikz{}}{Just before.}").count(), 2);
        assert!(row(&[&picture]).contains("\\shown[.86]{"));
        assert!(row(&[]).is_empty());
    }
}
