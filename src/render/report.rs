//! A measured report for the terminal, as data, and as one page without network or script. Every figure comes in ready.

use std::fmt::Write;

use serde_json::{Value, json};

use super::mathml::{self, escape};
use super::report_pareto::{At, ink, level, plot};
use super::{fonts, naming, symbols_of};
use crate::figure::{Ink, Label, color};
use crate::formula;
use crate::plot::{Axis, Curve, Plot, draw};
use crate::report::measure::{Cell, Swept};
use crate::report::verdict::{nanoseconds, short};
use crate::report::{BINS, Report, Route};

/// The tables for a terminal.
pub fn text(report: &Report) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "{}", super::heading(&report.title, &report.source));
    let _ = writeln!(out, "\n{}\n", report.verdict);
    for [name, formula] in &report.formulas {
        let _ = writeln!(out, "  {name} = {formula}");
    }
    let _ = writeln!(out, "\n{}\n", effort(report));
    let _ = writeln!(
        out,
        "{:24} {:>9} {:>19} {:>9} {:>9} {:>9}  worst in",
        "route", "time", "quartiles", "usual max", "worst", "stability"
    );
    for r in &report.routes {
        let mark = if r.dominated { "·" } else { " " };
        let _ = writeln!(
            out,
            "{mark}{:23} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}  {}",
            r.words,
            nanoseconds(r.seconds[1]),
            nanoseconds(r.seconds[0]),
            nanoseconds(r.seconds[2]),
            short(r.usual_max),
            short(r.worst),
            short(r.stability),
            r.worst_family
        );
    }
    out.push_str(LEGEND);
    for f in report.families.iter().filter(|f| !f.axis.is_empty()) {
        let _ = writeln!(out, "\n{}: {}", f.name, f.words);
        let _ = write!(out, "  {:>7}", "level");
        for r in &report.routes {
            let _ = write!(out, " {:>13}", r.route.short());
        }
        let _ = writeln!(out, " {:>9}  flags", "cond·u");
        for row in &f.rows {
            let _ = write!(out, "  {:>7}", row.x);
            for r in &report.routes {
                let cell = row.cells.iter().find(|c| c.route == r.route);
                let _ = write!(out, " {:>13}", cell.map_or("–".into(), |c| short(c.max)));
            }
            let _ = writeln!(
                out,
                " {:>9}  {}",
                short(row.condition),
                row.flags.join(", ")
            );
        }
    }
    if report.interrupted {
        out.push_str("\ninterrupted: what was finished is above\n");
    }
    out
}

const LEGEND: &str = " · dominated: another route is both faster and no less accurate. Errors in units in the last place of the exact answer;\n \
    stability: error over 2⁻⁵³ × structured condition number, where nothing leaves the range of doubles.\n";

fn effort(report: &Report) -> String {
    let (e, m) = (&report.effort, &report.machine);
    format!(
        "seed {}, {} points a level, {} timed runs of {}; carom {}, {} on {}, {} processors{}; {} answers exactly zero or out of range left out",
        e.seed,
        e.points,
        e.runs,
        e.repeat,
        m.carom,
        m.architecture,
        m.system,
        m.processors,
        if m.optimized {
            ""
        } else {
            ", NOT OPTIMIZED: times mean little"
        },
        report.left_out
    )
}

/// Reports as data, each with the plot of its errors at usual values as SVG. Numbers that are no finite doubles become null.
pub fn json(reports: &[Report]) -> Value {
    let value =
        |v: Result<Value, serde_json::Error>| v.unwrap_or_else(|e| json!({"error": e.to_string()}));
    let one = |r: &Report| {
        let mut out = value(serde_json::to_value(r));
        out["plot"] = json!(plot(r, At::Usual));
        out
    };
    json!({
        "reports": reports.iter().map(one).collect::<Vec<_>>(),
    })
}

/// One self-contained page for several reports.
pub fn html(reports: &[Report]) -> String {
    let mut out = HEAD.replace("<style>\n", &format!("<style>\n{}\n", fonts::face()));
    if reports.len() > 1 {
        out.push_str("<nav><ul>");
        for (i, r) in reports.iter().enumerate() {
            let _ = write!(
                out,
                "<li><a href=\"#s{i}\">{}</a> — {}</li>",
                escape(&r.title),
                escape(&r.verdict)
            );
        }
        out.push_str("</ul></nav>");
    }
    for (i, report) in reports.iter().enumerate() {
        section(&mut out, i, report);
    }
    out.push_str("</main></body></html>\n");
    out
}

fn section(out: &mut String, index: usize, report: &Report) {
    let _ = write!(
        out,
        "<section id=\"s{index}\"><h2>{} <small>{}</small></h2>",
        escape(&report.title),
        escape(&report.source)
    );
    let _ = write!(out, "<p class=\"verdict\">{}</p>", escape(&report.verdict));
    if report.interrupted {
        out.push_str("<p><strong>Interrupted:</strong> only finished rows are shown.</p>");
    }
    formulas(out, report);
    out.push_str("<h3>Usual values</h3>");
    routes_table(out, report);
    out.push_str("<div class=\"plots\">");
    for (at, caption) in [
        (At::Usual, "Largest error at usual values over median time."),
        (
            At::Extremes,
            "Largest stability factor over median time: the error over what rounding the data costs, wherever nothing leaves the range of doubles.",
        ),
    ] {
        let best = "The line joins the routes that no other one beats in both.";
        figure(out, plot(report, at), &format!("{caption} {best}"));
    }
    out.push_str("</div>");
    histogram(out, report);
    conditions(out, report);
    out.push_str(
        "<h3>Extremes</h3><p class=\"small\">“+2” at a line: two routes more run along it; point at a line for all its figures. \
         cond·u: what rounding the data alone costs.</p><div class=\"plots\">",
    );
    for f in report.families.iter().filter(|f| !f.axis.is_empty()) {
        figure(
            out,
            family_plot(report, f),
            &format!("{}: {}. {}", f.name, f.words, flags(f)),
        );
    }
    let _ = write!(
        out,
        "</div><p class=\"small\">{}</p></section>",
        escape(&effort(report))
    );
}

/// The closed forms, and behind a fold the code of them.
fn formulas(out: &mut String, report: &Report) {
    let (names, symbols) = (naming(&report.scene), symbols_of(&report.scene));
    for [name, formula] in &report.formulas {
        let set = |text: &str| {
            let read = formula::read(text, &symbols).ok()?;
            Some(mathml::expr(&names, read.content.expr()?))
        };
        let plain = escape(&format!("{name} = {formula}"));
        let shown = match (set(name), set(formula)) {
            (Some(left), Some(right)) => format!("<math>{left}<mo>=</mo>{right}</math>"),
            _ => plain.clone(),
        };
        let _ = write!(out, "<p class=\"formula\" title=\"{plain}\">{shown}</p>");
    }
    if !report.code.is_empty() {
        let _ = write!(
            out,
            "<details><summary>The closed form, arranged, as code (C)</summary><pre>{}</pre></details>",
            escape(&report.code)
        );
    }
}

fn flags(f: &Swept) -> String {
    let mut all: Vec<&str> = f
        .rows
        .iter()
        .flat_map(|r| r.flags.iter().copied())
        .collect();
    all.sort_unstable();
    all.dedup();
    if all.is_empty() {
        String::new()
    } else {
        format!("Flags: {}.", all.join(", "))
    }
}

/// A plot with its caption, where there is one.
fn figure(out: &mut String, plot: Option<String>, caption: &str) {
    if let Some(svg) = plot {
        let _ = write!(
            out,
            "<figure>{svg}<figcaption>{}</figcaption></figure>",
            escape(caption)
        );
    }
}

fn routes_table(out: &mut String, report: &Report) {
    out.push_str("<table><thead><tr><th>route<th>time<th>quartiles<th>usual max [ulp]<th>99 %<th>median<th>worst [ulp]<th>in<th>stability</tr></thead><tbody>");
    for r in &report.routes {
        let class = if r.dominated {
            " class=\"dominated\""
        } else {
            ""
        };
        let top =
            |f: &dyn Fn(&crate::report::Errors) -> f64| r.usual.values().map(f).fold(0.0, f64::max);
        let _ = write!(
            out,
            "<tr{class}><th title=\"{}\"><i style=\"background:{}\"></i>{}<td>{}<td>{} – {}<td>{}<td>{}<td>{}<td>{}<td class=\"words\">{}<td>{}</tr>",
            r.route.how(),
            color(ink(r.route)),
            r.words,
            nanoseconds(r.seconds[1]),
            nanoseconds(r.seconds[0]),
            nanoseconds(r.seconds[2]),
            short(r.usual_max),
            short(top(&|e| e.p99)),
            short(top(&|e| e.median)),
            short(r.worst),
            escape(&r.worst_family),
            short(r.stability),
        );
    }
    out.push_str("</tbody></table><details><summary>How each route gets its numbers</summary><dl>");
    for r in &report.routes {
        let _ = write!(out, "<dt>{}<dd>{}", r.words, r.route.how());
    }
    out.push_str("</dl></details>");
}

/// Curves of routes that lie on each other are drawn once.
fn family_plot(report: &Report, family: &Swept) -> Option<String> {
    let points = |route: Route| -> Vec<[f64; 2]> {
        let cell = |c: &&Cell| c.route == route;
        family
            .rows
            .iter()
            .filter_map(|r| Some([r.x, level(r.cells.iter().find(cell)?.max)]))
            .collect()
    };
    let mut groups: Vec<(Vec<Route>, Vec<[f64; 2]>)> = Vec::new();
    for r in &report.routes {
        let own = points(r.route);
        let near = |other: &[[f64; 2]]| {
            other.len() == own.len()
                && other
                    .iter()
                    .zip(&own)
                    .all(|(a, b)| (a[1] - b[1]).abs() < 0.7)
        };
        match groups.iter_mut().find(|(_, p)| near(p)) {
            Some((routes, _)) => routes.push(r.route),
            None => groups.push((vec![r.route], own)),
        }
    }
    let lines_of = |routes: &[Route]| -> String {
        let lines = routes.iter().map(|route| {
            let cells = family.rows.iter().filter_map(|r| {
                let cell = r.cells.iter().find(|c| c.route == *route)?;
                Some(format!("{}: {}", r.x, short(cell.max)))
            });
            format!(
                "{}, ulp at {}",
                route.words(),
                cells.collect::<Vec<_>>().join(", ")
            )
        });
        lines.collect::<Vec<_>>().join("\n")
    };
    let mut curves: Vec<Curve> = groups
        .into_iter()
        .map(|(routes, points)| Curve {
            note: lines_of(&routes),
            label: match routes.as_slice() {
                [one] => Label::words(one.short()),
                [one, rest @ ..] => Label::words(&format!("{} +{}", one.short(), rest.len())),
                [] => Label::default(),
            },
            points,
            ink: routes.first().map_or(Ink::Dimension, |route| ink(*route)),
        })
        .collect();
    curves.truncate(5);
    let data = family
        .rows
        .iter()
        .map(|r| [r.x, level(r.condition)])
        .collect();
    curves.push(Curve {
        note: String::new(),
        label: Label::words("cond·u"),
        points: data,
        ink: Ink::Dimension,
    });
    let single = family.rows.len() < 2;
    let plot = Plot {
        title: format!("{}: {}", family.name, report.title),
        x: Axis {
            label: Label::words(&family.axis),
            range: single.then(|| [family.rows[0].x - 1.0, family.rows[0].x + 1.0]),
            ticks: Vec::new(),
        },
        y: Axis {
            label: Label::words("largest error [ulp]"),
            range: Some([-1.2, 17.5]),
            ticks: vec![
                (0.0, "1".into()),
                (4.0, "1e4".into()),
                (8.0, "1e8".into()),
                (12.0, "1e12".into()),
                (16.0, "1e16".into()),
            ],
        },
        curves,
        marks: Vec::new(),
    };
    Some(draw(&plot).ok()?.svg)
}

fn histogram(out: &mut String, report: &Report) {
    out.push_str("<table class=\"counts\"><thead><tr><th>route");
    for bin in BINS {
        let bin = match bin < 1e4 {
            true => bin.to_string(),
            false => format!("{bin:e}"),
        };
        let _ = write!(out, "<th>≤ {bin}");
    }
    out.push_str("<th>more</tr></thead><tbody>");
    for r in &report.routes {
        let mut counts = vec![0usize; BINS.len() + 1];
        for e in r.usual.values() {
            counts
                .iter_mut()
                .zip(&e.histogram)
                .for_each(|(sum, n)| *sum += n);
        }
        let all: usize = counts.iter().sum();
        let _ = write!(out, "<tr><th>{}", r.words);
        for n in counts {
            let share = n as f64 / all.max(1) as f64;
            let shown = if n == 0 { String::new() } else { n.to_string() };
            let _ = write!(out, "<td style=\"--share:{:.0}%\">{shown}", 100.0 * share);
        }
        out.push_str("</tr>");
    }
    out.push_str("</tbody></table><p class=\"small\">How many answers lie within so many units in the last place, all quantities together.</p>");
}

fn conditions(out: &mut String, report: &Report) {
    out.push_str("<table><thead><tr><th>quantity<th>largest condition number");
    for r in &report.routes {
        let _ = write!(out, "<th>{}", r.route.short());
    }
    out.push_str("</tr></thead><tbody>");
    for q in &report.quantities {
        let condition = report.conditions.get(q).map_or("–".into(), |c| short(*c));
        let _ = write!(out, "<tr><th>{}<td>{condition}", escape(q));
        for r in &report.routes {
            let worst = r
                .usual
                .get(q)
                .filter(|e| e.count > 0)
                .map_or("–".into(), |e| short(e.max));
            let _ = write!(out, "<td>{worst}");
        }
        out.push_str("</tr>");
    }
    out.push_str("</tbody></table><p class=\"small\">Largest error [ulp] per quantity; – where the answer is exactly zero.</p>");
}

const HEAD: &str = r#"<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark"><title>carom: error against run time</title>
<style>
:root{--ink:#1b1f24;--soft:#667;--line:#d5d9de;--paper:#fdfdfc;--tint:47,129,214}
@media (prefers-color-scheme:dark){:root{--ink:#e6e8eb;--soft:#99a1ab;--line:#3a4048;--paper:#15181c}}
body{margin:0;background:var(--paper);color:var(--ink);font:15px/1.45 system-ui,sans-serif}
main{max-width:78rem;margin:0 auto;padding:1.5rem}
h2{margin-top:2.5rem;border-bottom:1px solid var(--line)}h2 small{color:var(--soft);font-weight:normal}
math{font-family:'carom math',math;font-size:1.1em;math-style:normal}.formula{margin:.5rem 0;overflow-x:auto;overflow-y:hidden}
.verdict{font-size:1.1rem;border-left:4px solid rgb(var(--tint));padding-left:.8rem}
table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:.85rem}
pre,table{overflow-x:auto;max-width:100%}table{display:block}
section:first-of-type h2{margin-top:.5rem}i{display:inline-block;width:.6rem;height:.6rem;border-radius:50%;margin-right:.4rem}dd{color:var(--soft);margin-left:1.2rem}
th,td{padding:.15rem .5rem;text-align:right;border-bottom:1px solid var(--line);white-space:nowrap}
tbody th{text-align:left;font-weight:normal}td.words{text-align:left}
tr.dominated{color:var(--soft);opacity:.6}
.counts td{background:color-mix(in srgb,rgb(var(--tint)) calc(var(--share)*.6),transparent)}
.plots{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(23rem,100%),1fr));gap:1rem}
figure{margin:.5rem 0;max-width:34rem}figure svg{width:100%;height:auto;overflow:visible;color:var(--ink)}
figcaption,.small{color:var(--soft);font-size:.82rem}
</style></head><body><main><h1>Error against run time</h1>
"#;
