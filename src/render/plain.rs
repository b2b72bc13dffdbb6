//! A worked solution for the terminal, in Unicode.

use std::fmt::Write;

use super::math::{rows, unicode};
use crate::answer::Matrix;
use crate::formula::visible;
use crate::solution::{Inline, Part, Solution};

/// Longest line of running text.
const WIDTH: usize = 88;

/// The whole solution.
pub fn solution(s: &Solution) -> String {
    let mut out = String::new();
    let title = super::heading(&s.title, &s.source);
    line(&mut out, &title);
    if !title.is_empty() {
        line(&mut out, &"═".repeat(title.chars().count().min(WIDTH)));
    }
    for section in &s.sections {
        if !section.heading.is_empty() {
            let heading = sentence(s, &section.heading);
            line(&mut out, "");
            line(&mut out, &heading);
            let rule = if section.depth == 0 { "─" } else { "╌" };
            line(&mut out, &rule.repeat(heading.chars().count().min(WIDTH)));
        }
        for (i, part) in section.parts.iter().enumerate() {
            let after_text = i > 0 && matches!(section.parts[i - 1], Part::Text(_) | Part::List(_));
            match part {
                Part::Text(text) => {
                    if after_text {
                        line(&mut out, "");
                    }
                    wrapped(&mut out, "", "", &sentence(s, text));
                }
                Part::List(items) => {
                    for item in items {
                        wrapped(&mut out, "• ", "  ", &sentence(s, item));
                    }
                }
                Part::Display(lines) | Part::Result(lines) => {
                    let cells: Vec<[String; 2]> = rows(s, lines)
                        .iter()
                        .map(|[l, r]| [unicode(s, l), unicode(s, r)])
                        .collect();
                    // Relations stand below each other unless a left side is long.
                    let width = cells
                        .iter()
                        .map(|[l, _]| l.chars().count())
                        .filter(|w| *w <= 24)
                        .max()
                        .unwrap_or(0);
                    for [l, r] in &cells {
                        let pad = " ".repeat(width.saturating_sub(l.chars().count()));
                        let gap = if l.is_empty() { "" } else { " " };
                        let lead = if l.is_empty() && width > 0 { " " } else { "" };
                        line(&mut out, format!("    {pad}{l}{gap}{lead}{r}").trim_end());
                    }
                }
                Part::Matrix(m) => matrix(&mut out, s, m),
                Part::Figure(_) => {}
            }
        }
    }
    out
}

fn sentence(s: &Solution, text: &[Inline]) -> String {
    text.iter()
        .map(|piece| match piece {
            Inline::Text(words) => visible(words),
            Inline::Math(math) => held(&unicode(s, math)),
        })
        .collect()
}

/// A formula with spaces that do not break: a line may end before a relation of it, in a long one before a sign too.
fn held(formula: &str) -> String {
    let is_long = formula.chars().count() > WIDTH / 2;
    let breaks = |word: &str| match word {
        "+" | "−" => is_long,
        _ => matches!(word, "=" | "≈" | "<" | ">" | "≤" | "≥" | "≠"),
    };
    let mut words = formula.split(' ');
    let mut out = String::from(words.next().unwrap_or_default());
    for word in words {
        out.push(if breaks(word) { ' ' } else { '\u{a0}' });
        out.push_str(word);
    }
    out
}

fn wrapped(out: &mut String, first: &str, next: &str, text: &str) {
    let mut current = String::from(first);
    let mut empty = true;
    for word in text.split(' ').filter(|w| !w.is_empty()) {
        if !empty && current.chars().count() + 1 + word.chars().count() > WIDTH {
            line(out, &current);
            current = String::from(next);
            empty = true;
        }
        if !empty {
            current.push(' ');
        }
        current.push_str(&word.replace('\u{a0}', " "));
        empty = false;
    }
    line(out, &current);
}

fn matrix(out: &mut String, s: &Solution, m: &Matrix) {
    let names = |n: &str| s.names.get(n).cloned();
    let write = |e: &crate::expr::Expr| crate::formula::write_unicode(e, &names);
    let cells: Vec<Vec<String>> = m
        .entries
        .iter()
        .map(|r| r.iter().map(write).collect())
        .collect();
    let symbols: Vec<String> = m
        .unknowns
        .iter()
        .map(|u| write(&crate::expr::Expr::symbol(u)))
        .collect();
    let widths: Vec<usize> = (0..symbols.len())
        .map(|j| {
            cells
                .iter()
                .map(|r| r[j].chars().count())
                .max()
                .unwrap_or(0)
        })
        .collect();
    let column = symbols.iter().map(|u| u.chars().count()).max().unwrap_or(0);
    for (i, row) in cells.iter().enumerate() {
        let padded: Vec<String> = row
            .iter()
            .zip(&widths)
            .map(|(c, w)| format!("{c}{}", " ".repeat(w - c.chars().count())))
            .collect();
        let unknown = symbols.get(i).map_or("", String::as_str);
        let equals = if i == 0 { "=" } else { " " };
        line(
            out,
            &format!(
                "    [ {} ] [ {unknown}{} ] {equals} [ {} ]",
                padded.join("  "),
                " ".repeat(column - unknown.chars().count()),
                write(&m.rhs[i])
            ),
        );
    }
}

fn line(out: &mut String, text: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(out, "{text}");
}
