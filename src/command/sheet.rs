//! A scene as an answer sheet whose keys were proved before anything is judged by them.

use crate::derive::friction::table;
use crate::grade::sheet::{Bound, Sheet};
use crate::scene::Scene;
use crate::{derive, story, verify};

/// The answers of a scene, proved; and what is to be said of them all the same.
pub fn sheet(scene: Scene) -> Result<(Sheet, Vec<String>), String> {
    if let Some(stages) = &scene.story {
        let told = story::tell(&scene, stages).map_err(|reason| reason.to_string())?;
        if !told.holds() {
            return Err(refuted(&told_failures(&told)));
        }
        let (scene, derivation) = story::sheet(&scene, &told).map_err(|stop| stop.to_string())?;
        let bounds = bounds(&told.answers);
        let sheet = Sheet {
            scene,
            derivation,
            bounds,
        };
        return Ok((sheet, Vec::new()));
    }
    let (scene, mut notes) = gradable(scene)?;
    prove(&scene, &mut notes)?;
    let (scene, derivation, answers) =
        story::with_special(scene).map_err(|reason| reason.to_string())?;
    let failed = answers.iter().flat_map(|a| &a.checks);
    let failed = failed.filter(|c| c.holds == Some(false));
    let failed: Vec<String> = failed.map(|c| c.words.clone()).collect();
    if !failed.is_empty() {
        return Err(refuted(&failed));
    }
    let sheet = Sheet {
        scene,
        derivation,
        bounds: bounds(&answers),
    };
    Ok((sheet, notes))
}

/// The quantity that is meant where none is named: the one question of a scene that has no more.
pub fn only_quantity(sheet: &Sheet) -> Option<String> {
    match sheet.scene.questions.as_slice() {
        [one] => Some(one.name.clone()),
        _ => None,
    }
}

/// The scene in the one case of friction it is in. Where several are left, what is the same in all of them can still be
/// asked, and is told.
fn gradable(scene: Scene) -> Result<(Scene, Vec<String>), String> {
    let why = match super::settled(scene.clone()) {
        Ok(scene) => return Ok((scene, Vec::new())),
        Err(why) => why,
    };
    let Ok(Some(mut table)) = table(&scene) else {
        return Err(why);
    };
    if table.about.is_empty() || table.cases.is_empty() {
        return Err(why);
    }
    let note = format!("{why}\nwhat is the same in every case can be graded");
    let mut common = table.cases.swap_remove(0).scene;
    common.questions.clear();
    common.special = table.about;
    Ok((common, vec![note]))
}

/// Proves the answers of a scene; what is not proved is said.
fn prove(scene: &Scene, notes: &mut Vec<String>) -> Result<(), String> {
    let Ok(derivation) = derive::derive(scene) else {
        // Why it stopped is told where the answers are put together.
        return Ok(());
    };
    let proof = verify::prove(scene, &derivation);
    match verify::trust(&derivation, &proof) {
        verify::Trust::Refuted(failed) => return Err(refuted(&failed)),
        verify::Trust::NotProved(names) => notes.push(format!("not proved: {}", names.join(", "))),
        verify::Trust::Proved => {}
    }
    let possible = verify::possible::judge(scene, &derivation);
    notes.extend(possible.refusal().map(|refusal| refusal.to_string()));
    Ok(())
}

fn refuted(failed: &[String]) -> String {
    format!(
        "the derived answers are refuted, and nothing is judged by them: {}",
        failed.join("; ")
    )
}

/// The checks of a story that failed, in words.
fn told_failures(told: &crate::story::Told) -> Vec<String> {
    let cases = told.stages.iter().flat_map(|s| &s.cases);
    let proofs = cases.flat_map(|c| c.proof.scene.iter().chain(c.proof.answers.iter().flatten()));
    let stages = told.stages.iter().flat_map(|s| &s.checks);
    let answers = told.answers.iter().flat_map(|a| &a.checks);
    let failed = proofs
        .chain(stages)
        .chain(answers)
        .filter(|c| c.holds == Some(false));
    failed.map(|c| c.words.clone()).collect()
}

/// The answers that are one bound on a parameter.
fn bounds(answers: &[crate::answer::Answer]) -> Vec<Bound> {
    let bound = |a: &crate::answer::Answer| match a.range.as_slice() {
        [(of, relation, value)]
            if a.name == a.question && a.formula().is_none_or(|f| f == value) =>
        {
            Some(Bound {
                name: a.name.clone(),
                parameter: of.as_symbol()?.clone(),
                relation: *relation,
                value: value.clone(),
            })
        }
        _ => None,
    };
    answers.iter().filter_map(bound).collect()
}
