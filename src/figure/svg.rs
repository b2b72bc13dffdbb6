//! Writes a display list as SVG. Text passes through one escaping function; there are no scripts, fonts or references.

use std::fmt::Write;

use super::label::{Level, SMALL};
use super::plane::Pair;
use super::sheet::{Ink, Item, Paint};

/// A picture with its words.
pub struct Page<'a> {
    /// What is drawn, y up, inside 0 ≤ x ≤ width and 0 ≤ y ≤ height.
    pub items: &'a [Item],
    /// Width in pixels.
    pub width: f64,
    /// Height in pixels.
    pub height: f64,
    /// What the picture is called.
    pub title: &'a str,
    /// The picture in words.
    pub description: &'a str,
}

/// Serif fonts with italics that look like print; any of them will do.
const FONTS: &str =
    "'STIX Two Text','Libertinus Serif',Cambria,'Times New Roman','Liberation Serif',Times,serif";

/// Standing alone, the picture picks its own ink; inside a page it takes the page's text color.
const STYLE: &str = "@media (prefers-color-scheme:dark){svg.carom-figure:root{color:#e6e8eb}}";

/// The SVG document.
pub fn write(page: &Page) -> String {
    let (w, h) = (number(page.width), number(page.height));
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"carom-figure\" role=\"img\" width=\"{w}\" height=\"{h}\" \
         viewBox=\"0 0 {w} {h}\" font-family=\"{FONTS}\" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n\
         <title>{}</title>\n<desc>{}</desc>\n<style>{STYLE}</style>\n",
        escape(page.title),
        escape(page.description)
    );
    for item in page.items {
        write_item(item, page.height, &mut out);
    }
    out.push_str("</svg>\n");
    out
}

/// Text for an element or attribute of SVG, HTML or MathML: markup escaped, hidden characters named.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in crate::formula::visible(text).chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c => out.push(c),
        }
    }
    out
}

/// A coordinate with at most two decimals; never NaN, whatever came in.
pub fn number(value: f64) -> String {
    let value = if value.is_finite() {
        value.clamp(-1e6, 1e6)
    } else {
        0.0
    };
    let text = format!("{value:.2}");
    let text = crate::formula::trimmed(&text);
    if text == "-0" {
        "0".to_string()
    } else {
        text.to_string()
    }
}

/// Middle tones that read on white and on near-black alike; what has to be read as text takes the page's own color.
pub fn color(ink: Ink) -> &'static str {
    match ink {
        Ink::Body | Ink::Ground => "currentColor",
        Ink::Motion => "#2f81d6",
        Ink::Impulse => "#d9534a",
        Ink::Dimension => "#858b93",
        Ink::Grid => "#858b9340",
        Ink::Curve(i) => CURVES[i % CURVES.len()],
    }
}

/// Colors of curves; TikZ knows them as `curve0` and on.
pub(super) const CURVES: [&str; 8] = [
    "#2f81d6", "#d9534a", "#2e965f", "#b06ecd", "#c4801c", "#1496a0", "#c2468f", "#8a6a4c",
];

/// A line through points, in the commands of a path.
fn path(points: &[Pair], closed: bool, height: f64) -> String {
    let through: Vec<String> = points
        .iter()
        .map(|p| format!("{} {}", number(p[0]), number(height - p[1])))
        .collect();
    format!("M{}{}", through.join("L"), if closed { "Z" } else { "" })
}

fn write_item(item: &Item, height: f64, out: &mut String) {
    let x = |p: &[f64; 2]| number(p[0]);
    let y = |p: &[f64; 2]| number(height - p[1]);
    // Writing to a String cannot fail.
    let _ = match item {
        Item::Path {
            points,
            closed,
            paint,
        } => {
            let d = path(points, *closed, height);
            writeln!(out, "<path d=\"{d}\"{}/>", painted(paint))
        }
        Item::Circle {
            center,
            radius,
            paint,
        } => writeln!(
            out,
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}/>",
            x(center),
            y(center),
            number(*radius),
            painted(paint)
        ),
        Item::Noted { item, note } => {
            let _ = write!(out, "<g><title>{}</title>", escape(note));
            write_item(item, height, out);
            writeln!(out, "</g>")
        }
        Item::Text {
            at,
            size,
            bold,
            from_end,
            label,
            ..
        } => {
            let weight = if *bold { " font-weight=\"600\"" } else { "" };
            let (begin, anchor) = match from_end {
                true => ([at[0] + label.width(*size), at[1]], " text-anchor=\"end\""),
                false => (*at, ""),
            };
            let _ = write!(
                out,
                "<text x=\"{}\" y=\"{}\" font-size=\"{}\"{weight}{anchor} fill=\"currentColor\" xml:space=\"preserve\">",
                x(&begin),
                y(&begin),
                number(*size)
            );
            let ends = label.ends(*size);
            let (mut pen, mut shift) = (0.0, 0.0);
            for (run, (start, end)) in label.runs.iter().zip(&ends) {
                let target = match run.level {
                    Level::Base => 0.0,
                    Level::Sub => 0.24 * size,
                    Level::Sup => -0.42 * size,
                };
                let _ = write!(out, "<tspan");
                if run.italic {
                    out.push_str(" font-style=\"italic\"");
                }
                if run.level != Level::Base {
                    let _ = write!(out, " font-size=\"{}\"", number(size * SMALL));
                }
                let (dx, dy): (f64, f64) = (start - pen, target - shift);
                if dx.abs() > 0.01 {
                    let _ = write!(out, " dx=\"{}\"", number(dx));
                }
                if dy.abs() > 0.01 {
                    let _ = write!(out, " dy=\"{}\"", number(dy));
                }
                let _ = write!(out, ">{}</tspan>", escape(&run.text));
                (pen, shift) = (*end, target);
            }
            let _ = writeln!(out, "</text>");
            for (run, (start, end)) in label.runs.iter().zip(&ends).filter(|(run, _)| run.arrow) {
                let tall = run
                    .text
                    .chars()
                    .any(|c| c.is_uppercase() || "ℓbdfhklt".contains(c));
                let above = at[1] + size * if tall { 0.86 } else { 0.66 };
                let (from, to) = ([at[0] + start, above], [at[0] + end + 0.5, above]);
                let _ = writeln!(
                    out,
                    "<path d=\"M{} {}H{}m-2.6 -1.9l2.6 1.9l-2.6 1.9\" stroke=\"currentColor\" stroke-width=\"0.9\"/>",
                    x(&from),
                    y(&from),
                    x(&to)
                );
            }
            Ok(())
        }
    };
}

fn painted(paint: &Paint) -> String {
    let line = match paint {
        Paint::Stroke(line) => line,
        Paint::Fill(ink) => return format!(" fill=\"{}\"", color(*ink)),
    };
    let color = color(line.ink);
    let mut out = format!(
        " stroke=\"{color}\" stroke-width=\"{}\"",
        number(line.width)
    );
    if line.dashed {
        out.push_str(" stroke-dasharray=\"4 3\"");
    }
    if line.filled {
        out.push_str(&format!(" fill=\"{color}\" fill-opacity=\"0.09\""));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_cannot_leave_its_element() {
        assert_eq!(
            escape("<script>&\"'\u{202e}\u{0}"),
            "&lt;script&gt;&amp;&quot;&#39;[U+202E][U+0000]"
        );
    }

    #[test]
    fn numbers_are_numbers() {
        for value in [f64::NAN, f64::INFINITY, -0.001, 1.0, 12.345] {
            assert!(number(value).parse::<f64>().is_ok_and(f64::is_finite));
        }
    }
}
