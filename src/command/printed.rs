//! What is printed about a scene, judged by answers that were proved first.

use crate::grade::sheet::Sheet;
use crate::scene::Scene;
use crate::verify::friction::outcomes;
use crate::verify::printed::{Finding, check, in_cases};

/// The findings about what a scene prints, and what is to be said of its answers all the same. Where friction leaves several
/// cases, each is judged by itself, and a finding tells in which of them it holds.
pub fn printed(scene: Scene) -> Result<(Vec<Finding>, Vec<String>), String> {
    let is_open = !scene.has_stages() && scene.friction().is_some();
    let cases = if is_open {
        outcomes(&scene)?
    } else {
        Vec::new()
    };
    if cases.len() < 2 {
        return one(scene);
    }
    let mut all = Vec::new();
    let mut notes = Vec::new();
    for case in cases {
        let (findings, said) = one(case.scene)?;
        notes.extend(
            said.into_iter()
                .map(|note| format!("where {}: {note}", case.words)),
        );
        all.push((case.words, findings));
    }
    Ok((in_cases(all), notes))
}

/// The same of a scene that goes one way, or tells its cases in stages.
fn one(scene: Scene) -> Result<(Vec<Finding>, Vec<String>), String> {
    let (sheet, notes) = super::sheet(scene)?;
    let judged = |way: &Sheet| {
        let mut findings = check(&way.scene, &way.derivation, &way.all);
        way.explain(&mut findings);
        findings
    };
    if sheet.otherwise.is_empty() {
        return Ok((judged(&sheet), notes));
    }
    let ways = std::iter::once(&sheet).chain(&sheet.otherwise);
    let each = ways.map(|way| (way.given.join(", "), judged(way)));
    Ok((in_cases(each.collect()), notes))
}
