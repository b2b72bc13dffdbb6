//! A worked solution as one page: native MathML, pictures inline, no script, nothing loaded from anywhere.

use super::fonts;
use super::math::{Cells, apart, pieces, rows, rows_within, width};
use super::mathml::{escape, expr, formula, from_latex};
use crate::answer::Matrix;
use crate::expr::Expr;
use crate::figure::Piece;
use crate::scene::Scene;
use crate::solution::{Inline, Line, Math, Part, Slot, Solution, with_symbols};

/// A picture that belongs to a solution.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Where.
    pub slot: Slot,
    /// The SVG element.
    pub svg: String,
    /// The same as TikZ.
    pub tikz: String,
    /// What it shows.
    pub caption: Vec<Piece>,
    /// The picture in words, plain text.
    pub alternative: String,
}

impl Picture {
    /// The same as an image that stands by itself: its style and its names meet nobody else's.
    pub fn standalone(&self) -> Picture {
        let svg = format!(
            "<img alt=\"{}\" src=\"data:image/svg+xml;base64,{}\">",
            escape(&self.alternative),
            fonts::base64(self.svg.as_bytes())
        );
        Picture {
            svg,
            ..self.clone()
        }
    }
}

/// Longest formula, in characters as they are set, that a line of a narrow window holds.
const IN_TEXT: usize = 36;
/// Longest row of a display in a wide window; what cannot be broken to it is set smaller.
const DESK: usize = 80;
/// The same in a narrow window.
const PHONE: usize = 38;

/// The windows a display is written for.
#[derive(Clone, Copy)]
enum Windows {
    /// Narrow and wide ones: the style shows one of two forms.
    Any,
    /// Wide ones alone, in cells that are aligned without a style.
    Wide,
}

const STYLE: &str = "
:root{color-scheme:light dark}
*{box-sizing:border-box}
body{margin:0 auto;max-width:46rem;padding:1.2rem 1rem 3rem;font:17px/1.55 Georgia,'Times New Roman',serif;color:#1a1a1a;background:#fff;overflow-wrap:break-word}
h1{font-size:1.55rem;line-height:1.25;margin:.4rem 0 .1rem}
h2{font-size:1.12rem;margin:1.9rem 0 .4rem;border-bottom:1px solid #ccc;padding-bottom:.15rem}
h3,h4{font-size:1rem;margin:1.2rem 0 .3rem}h4{font-weight:normal;font-style:italic}
p{margin:.55rem 0}
.source{color:#555;font-style:italic;margin-top:0}
.display{overflow-x:auto;overflow-y:hidden;margin:.5rem 0;padding:.15rem 0}
.display math{margin:0 0 0 1.2rem;text-align:left}
.result math{border:1px solid #888;padding:.25em 0;width:max-content;margin:0 auto}
.phone{display:none}
math{font-family:'carom math',math;font-size:1.05em}
mover>mo{font-size:.75em}
.wide{display:inline-block;max-width:100%;overflow-x:auto;overflow-y:hidden;vertical-align:middle}
mtable{border-spacing:0}
mtd{padding:.22em .12em;text-align:left}
mtd.l{text-align:right;text-align:-webkit-right;white-space:nowrap}
.result mtd.l{padding-left:.8em}
.result mtd:last-child{padding-right:.8em}
.matrix mtd{padding:.25em .5em;text-align:center;text-align:-webkit-center}
ul{padding-left:1.3rem}
li{margin:.3rem 0}
figure{margin:1rem 0;text-align:center}
figure svg{max-width:100%;height:auto}
figcaption{font-size:.86rem;color:#555}.value{white-space:nowrap}
.figures{display:flex;flex-wrap:wrap;gap:1rem;justify-content:center;align-items:flex-end}
.figures figure{flex:1 1 300px;margin:0;min-width:0;max-width:26rem}
@media (prefers-color-scheme:dark){body{color:#e6e6e6;background:#16181c}h2{border-color:#444}.source,figcaption{color:#aaa}}
@media (max-width:480px){body{font-size:16px;padding:.8rem .8rem 2rem}.display:not(.result) math{margin-left:.2rem}.desk{display:none}.phone{display:block}}
@media print{body{max-width:none;font-size:11pt;color:#000;background:#fff}h2,h3,h4,.display,figure{break-inside:avoid}h2,h3,h4{break-after:avoid}.display{overflow:visible}p{orphans:3;widows:3}}
";

/// The whole page.
pub fn page(s: &Solution, pictures: &[Picture]) -> String {
    page_among(s, pictures, "", "")
}

/// The same as one of several: HTML in front of the title, and at the end.
pub fn page_among(s: &Solution, pictures: &[Picture], above: &str, below: &str) -> String {
    let title = s.heading();
    let mut body = String::new();
    if !s.source.is_empty() {
        body.push_str(&format!("<p class=\"source\">{}</p>\n", escape(&s.source)));
    }
    body.push_str(&sections(s, pictures, Windows::Any));
    body.push_str(below);
    shell(title, above, &body, None)
}

/// A page in the style of solutions. `above` is HTML in front of the title, `body` behind it; a page with a script of its
/// own runs that one and loads none.
pub fn shell(title: &str, above: &str, body: &str, script: Option<&str>) -> String {
    let title = escape(title);
    let (allowed, script) = match script {
        Some(script) => (
            "; script-src 'unsafe-inline'",
            format!("<script>\n{script}</script>\n"),
        ),
        None => ("", String::new()),
    };
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; font-src data:{allowed}\">\n\
         <title>{title}</title>\n<style>{}{STYLE}</style>\n</head>\n<body>\n{above}<main>\n<h1>{title}</h1>\n{body}</main>\n{script}</body>\n</html>\n",
        fonts::face()
    )
}

/// What stands below the title, to be put into a page of somebody else, which has no style for it.
pub fn fragment(s: &Solution, pictures: &[Picture]) -> String {
    sections(s, pictures, Windows::Wide)
}

fn sections(s: &Solution, pictures: &[Picture], windows: Windows) -> String {
    let mut out = String::new();
    for section in &s.sections {
        out.push_str("<section>\n");
        if !section.heading.is_empty() {
            let level = 2 + section.depth;
            out.push_str(&format!(
                "<h{level}>{}</h{level}>\n",
                sentence(s, &section.heading)
            ));
        }
        for part in &section.parts {
            out.push_str(&self::part(s, part, pictures, windows));
        }
        out.push_str("</section>\n");
    }
    out
}

fn part(s: &Solution, part: &Part, pictures: &[Picture], windows: Windows) -> String {
    match part {
        Part::Text(words) => format!("<p>{}</p>\n", sentence(s, words)),
        Part::List(items) => {
            let items: String = items
                .iter()
                .map(|i| format!("<li>{}</li>\n", sentence(s, i)))
                .collect();
            format!("<ul>\n{items}</ul>\n")
        }
        Part::Display(lines) => {
            let parts = apart(s, lines).into_iter();
            parts.map(|lines| display(s, lines, "", windows)).collect()
        }
        Part::Result(lines) => display(s, lines, " result", windows),
        Part::Matrix(m) => matrix(s, m),
        Part::Figure(slot) => {
            let figures: Vec<String> = pictures
                .iter()
                .filter(|p| p.slot == *slot)
                .map(|p| {
                    format!(
                        "<figure>{}<figcaption>{}</figcaption></figure>\n",
                        p.svg,
                        caption(&p.caption)
                    )
                })
                .collect();
            match figures.len() {
                0 => String::new(),
                _ => format!("<div class=\"figures\">\n{}</div>\n", figures.concat()),
            }
        }
    }
}

/// Equations in rows, once for wide windows and, where they need more breaks, once for narrow ones.
fn display(s: &Solution, lines: &[Line], class: &str, windows: Windows) -> String {
    let desk = rows(s, lines);
    if let Windows::Wide = windows {
        let aligned = [
            (
                "class=\"l\"",
                "style=\"text-align:right;text-align:-webkit-right\"",
            ),
            ("<mtd>", "<mtd style=\"text-align:left\">"),
            (
                "class=\"display result\"",
                "style=\"border:1px solid;padding:0 1em;width:fit-content;margin:auto\"",
            ),
        ];
        let table = table(s, &desk, class, DESK);
        let each = aligned.iter();
        return each.fold(table, |table, (class, style)| table.replace(class, style));
    }
    let phone = rows_within(s, lines, PHONE);
    let same = |a: &[Cells], b: &[Cells]| {
        let wide = |rows: &[Cells]| span(s, rows);
        a.len() == b.len() && wide(a) == wide(b) && wide(b) <= PHONE
    };
    if same(&desk, &phone) {
        return table(s, &desk, class, DESK);
    }
    let wide = table(s, &desk, &format!("{class} desk"), DESK);
    let phone_class = format!("{class} phone");
    // Lines that fit a narrow window one by one, but not with their relations below each other, stand each for itself.
    if lines.len() > 1 && class.is_empty() && span(s, &phone) > PHONE {
        let each = lines.iter().map(|line| {
            let rows = rows_within(s, std::slice::from_ref(line), PHONE);
            table(s, &rows, &phone_class, PHONE)
        });
        return wide + &each.collect::<String>();
    }
    wide + &table(s, &phone, &phone_class, PHONE)
}

/// Characters from the left edge of the widest left side to the right edge of the widest right side.
fn span(s: &Solution, rows: &[Cells]) -> usize {
    let widest = |side: usize| rows.iter().map(|row| width(s, &row[side])).max();
    widest(0).unwrap_or(0) + widest(1).unwrap_or(0)
}

fn table(s: &Solution, rows: &[Cells], class: &str, most: usize) -> String {
    let inner: String = rows
        .iter()
        .map(|[l, r]| {
            format!(
                "<mtr><mtd class=\"l\">{}</mtd><mtd>{}</mtd></mtr>\n",
                formula(s, l),
                formula(s, r)
            )
        })
        .collect();
    let percent = 100 * most / span(s, rows).max(1);
    let style = match percent {
        100.. => String::new(),
        percent => format!(" style=\"font-size:{}%\"", percent.max(62)),
    };
    format!(
        "<div class=\"display{class}\" tabindex=\"0\"><math display=\"block\"{style}><mtable displaystyle=\"true\">\n{inner}</mtable></math></div>\n"
    )
}

fn caption(pieces: &[Piece]) -> String {
    let mut out = String::new();
    for (i, piece) in pieces.iter().enumerate() {
        // A value stays on the line of its symbol: a browser may break between a formula and a space of any kind.
        let has_value = matches!(pieces.get(i + 1), Some(Piece::Value(_)));
        match piece {
            Piece::Words(words) => out.push_str(&escape(words)),
            Piece::Value(value) => out.push_str(&format!(" = {}</span>", escape(value))),
            Piece::Symbol(label) => {
                let span = if has_value {
                    "<span class=\"value\">"
                } else {
                    ""
                };
                let symbol = from_latex(&label.to_latex());
                out.push_str(&format!("{span}<math>{symbol}</math>"));
            }
        }
    }
    out
}

/// Words of a scene as markup, its symbols typeset as `names` has them.
pub fn typeset(scene: &Scene, names: &Solution, text: &str) -> String {
    sentence(names, &with_symbols(scene, text))
}

/// A sentence as markup, its words escaped.
pub fn sentence(s: &Solution, pieces: &[Inline]) -> String {
    pieces
        .iter()
        .map(|piece| match piece {
            Inline::Text(words) => escape(words),
            Inline::Math(math) => in_text(s, math),
        })
        .collect()
}

/// A formula in a sentence; a long one may be cut at the end of a line, and what is still long is moved sideways by itself.
fn in_text(s: &Solution, math: &[Math]) -> String {
    let pieces = pieces(s, math, IN_TEXT);
    let set = pieces.iter().map(|piece| {
        let set = format!("<math>{}</math>", formula(s, piece));
        match width(s, piece) > IN_TEXT {
            true => format!("<span class=\"wide\">{set}</span>"),
            false => set,
        }
    });
    set.collect::<Vec<_>>().join(" ")
}

fn matrix(s: &Solution, m: &Matrix) -> String {
    let table = |rows: Vec<Vec<String>>| {
        let rows: String = rows
            .into_iter()
            .map(|r| {
                let cells: String = r.into_iter().map(|c| format!("<mtd>{c}</mtd>")).collect();
                format!("<mtr>{cells}</mtr>")
            })
            .collect();
        format!("<mrow><mo>[</mo><mtable>{rows}</mtable><mo>]</mo></mrow>")
    };
    let entries = m
        .entries
        .iter()
        .map(|r| r.iter().map(|e| expr(s, e)).collect())
        .collect();
    let symbols = m
        .unknowns
        .iter()
        .map(|u| vec![expr(s, &Expr::symbol(u))])
        .collect();
    let rhs = m.rhs.iter().map(|e| vec![expr(s, e)]).collect();
    format!(
        "<div class=\"display matrix\" tabindex=\"0\"><math display=\"block\">{}{}<mo>=</mo>{}</math></div>\n",
        table(entries),
        table(symbols),
        table(rhs)
    )
}
