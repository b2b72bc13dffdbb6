//! What is printed about a scene, judged by answers that were proved first.

use super::sheet::coefficients;
use crate::grade::sheet::Sheet;
use crate::scene::Scene;
use crate::verify::friction::{Outcome, all_outcomes};
use crate::verify::printed::{Finding, Way, check, in_cases};

/// The findings about what a scene prints, and what is to be said of its answers all the same. Where friction leaves several
/// cases, each is judged by itself, and a finding tells in which of them it holds.
pub fn printed(scene: Scene) -> Result<(Vec<Finding>, Vec<String>), String> {
    let is_open = !scene.has_stages() && scene.friction().is_some();
    let cases = if is_open {
        let [ended, _] = all_outcomes(&scene)?;
        ended
    } else {
        Vec::new()
    };
    if cases.len() < 2 {
        return one(scene.clone(), &scene, cases.first());
    }
    let several = cases.iter().filter(|case| case.is_so).count() > 1;
    let mut all = Vec::new();
    let mut notes = Vec::new();
    for case in cases {
        let judged = one(case.scene.clone(), &scene, Some(&case));
        // Another case than that of the values is told beside it.
        let (findings, said) = match judged {
            Err(_) if !case.is_so => continue,
            judged => judged?,
        };
        let told = said.into_iter().filter(|_| case.is_so);
        notes.extend(told.map(|note| match several {
            true => format!("where {}: {note}", case.words),
            false => note,
        }));
        all.push((case.words, findings));
    }
    Ok((in_cases(all), notes))
}

/// The same of a scene that goes one way, or tells its cases in stages; what is asked of friction is asked of the whole.
fn one(
    scene: Scene,
    whole: &Scene,
    case: Option<&Outcome>,
) -> Result<(Vec<Finding>, Vec<String>), String> {
    let coefficients = coefficients(whole);
    let (sheet, notes) = super::sheet(scene)?;
    let judged = |way: &Sheet| {
        let mut findings = check(&Way {
            coefficients: &coefficients,
            case: case.map(|case| (case.words.as_str(), case.when.as_slice())),
            is_so: case.is_none_or(|case| case.is_so),
            ..Way::of(&way.scene, &way.derivation, &way.all)
        });
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
