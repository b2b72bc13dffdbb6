//! A worked solution as Markdown with LaTeX mathematics, as GitHub, Jupyter and Quarto set it.

use super::html::Picture;
use super::math::{apart, latex, rows};
use crate::answer::Matrix;
use crate::figure::plain;
use crate::formula::visible;
use crate::solution::{Inline, Line, Part, Solution};

/// The whole solution; `pictures` are linked by their file names.
pub fn solution(s: &Solution, pictures: &[(Picture, String)]) -> String {
    let mut blocks: Vec<String> = Vec::new();
    let title = s.heading();
    blocks.push(format!("# {}", text(title)));
    if !s.source.is_empty() {
        blocks.push(format!("*{}*", text(&s.source)));
    }
    for section in &s.sections {
        if !section.heading.is_empty() {
            let marks = "#".repeat(2 + section.depth);
            blocks.push(format!("{marks} {}", sentence(s, &section.heading)));
        }
        for part in &section.parts {
            match part {
                Part::Text(words) => blocks.push(paragraph(s, words)),
                Part::List(items) => {
                    let items: Vec<String> = items
                        .iter()
                        .map(|i| format!("- {}", paragraph(s, i)))
                        .collect();
                    blocks.push(items.join("\n"));
                }
                Part::Display(lines) => {
                    let parts = apart(s, lines).into_iter();
                    blocks.extend(parts.map(|lines| format!("$$\n{}\n$$", aligned(s, lines))));
                }
                Part::Result(lines) => {
                    blocks.push(format!("$$\n\\boxed{{{}}}\n$$", aligned(s, lines)));
                }
                Part::Matrix(m) => blocks.push(format!("$$\n{}\n$$", matrix(s, m))),
                Part::Figure(slot) => {
                    for (picture, file) in pictures.iter().filter(|(p, _)| p.slot == *slot) {
                        let alternative = text(&picture.alternative);
                        let caption = text(&plain(&picture.caption));
                        // A picture alone in its paragraph would get its alternative as a caption from Pandoc and Quarto.
                        blocks.push(format!("![{alternative}]({file})\\\n*{caption}*"));
                    }
                }
            }
        }
    }
    let mut out = blocks.join("\n\n");
    out.push('\n');
    out
}

/// A sentence that does not start a numbered list.
fn paragraph(s: &Solution, pieces: &[Inline]) -> String {
    let mut out = sentence(s, pieces);
    let digits = out.bytes().take_while(u8::is_ascii_digit).count();
    if digits > 0 && out[digits..].starts_with(['.', ')']) {
        out.insert(digits, '\\');
    }
    out
}

/// Equations below each other.
pub fn aligned(s: &Solution, lines: &[Line]) -> String {
    let rows: Vec<String> = rows(s, lines)
        .iter()
        .map(|[l, r]| format!("{} & {}", latex(s, l), latex(s, r)))
        .collect();
    let rows = rows.join(" \\\\\n").replace("\n &", "\n&");
    format!("\\begin{{aligned}}\n{rows}\n\\end{{aligned}}")
}

fn sentence(s: &Solution, pieces: &[Inline]) -> String {
    let mut out = String::new();
    for piece in pieces {
        match piece {
            Inline::Text(words) => out.push_str(&text(words)),
            Inline::Math(math) => out.push_str(&format!("${}$", latex(s, math))),
        }
    }
    out.trim().to_string()
}

/// Words with everything Markdown or HTML would act on made literal.
pub fn text(words: &str) -> String {
    let mut out = String::with_capacity(words.len());
    for c in visible(words).chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '\\' | '`' | '*' | '_' | '[' | ']' | '#' | '|' | '~' | '{' | '}' => {
                out.push('\\');
                out.push(c);
            }
            // `\$` would still open mathematics in some readers.
            '$' => out.push_str("&#36;"),
            '!' => out.push_str("&#33;"),
            '@' => out.push_str("&#64;"),
            c => out.push(c),
        }
    }
    // A line must not start a list, a quotation or a rule.
    if out.starts_with(['-', '+', '=']) {
        out.insert(0, '\\');
    }
    // An address must not become a link.
    out.replace("://", "&#58;//").replace("www.", "www&#46;")
}

/// A system in matrix form.
pub fn matrix(s: &Solution, m: &Matrix) -> String {
    let names = |n: &str| s.names.get(n).cloned();
    let write = |e: &crate::expr::Expr| crate::formula::write_latex(e, &names);
    super::latex_system(m, write, "\n")
}
