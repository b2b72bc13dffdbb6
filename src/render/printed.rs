//! Findings about what a book prints, for people and for programs.

use serde_json::{Value, json};

use crate::scene::Scene;
use crate::verify::printed::Finding;

/// Findings as a list; `total` counts those left out too.
pub fn text(scene: &Scene, findings: &[Finding], total: usize) -> String {
    let heading = super::heading(&scene.title, &scene.source);
    let mut out = format!("{heading}: {total} printed\n");
    for f in findings {
        let sign = match f.holds {
            Some(true) => "holds",
            Some(false) => "WRONG",
            None => "open",
        };
        let place = if f.place.is_empty() {
            String::new()
        } else {
            format!(" [{}]", f.place)
        };
        out.push_str(&format!("  {sign:<6}{}{place}: {}\n", f.kind, f.printed));
        let mut line =
            |label: &str, words: &str| out.push_str(&format!("        {label}: {words}\n"));
        if let Some(words) = &f.only_where {
            line("only where", words);
        }
        if f.holds != Some(true) {
            if !f.carom.is_empty() {
                line("carom", &f.carom);
            }
            line("because", &f.because);
        }
        if let Some(words) = &f.explained {
            line("explained", words);
        }
        if let Some(words) = &f.caught_by {
            line("caught by", words);
        }
    }
    out
}

/// Findings as data.
pub fn json(scene: &Scene, findings: &[Finding]) -> Value {
    json!({"title": scene.title, "source": scene.source, "printed": findings})
}
