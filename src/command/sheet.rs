//! A scene as an answer sheet whose keys were proved before anything is judged by them.

use crate::answer::Answer;
use crate::expr::Symbol;
use crate::formula::{Relation, Sentence};
use crate::grade::believed::Story;
use crate::grade::sheet::Sheet;
use crate::scene::{Question, Scene};
use crate::verify::printed::friction_bound;
use crate::{story, verify, worked};

/// The answers of a scene, proved; and what is to be said of them all the same.
pub fn sheet(scene: Scene) -> Result<(Sheet, Vec<String>), String> {
    let coefficients = coefficients(&scene);
    let has_stages = scene.has_stages();
    let (scene, mut notes) = gradable(scene);
    let worked = worked::out(&scene)?;
    let failed = worked.failed();
    if !failed.is_empty() {
        return Err(format!(
            "the derived answers are refuted, and nothing is judged by them: {}",
            failed.join("; ")
        ));
    }
    let open = worked.not_proved();
    if !open.is_empty() {
        notes.push(format!("not proved: {}", open.join(", ")));
    }
    notes.extend(worked.refusals());
    let all = worked.answers().to_vec();
    let impacts = story::impacts(&worked.scene, &worked.told);
    let laws = story::lent(&worked.scene, &worked.told);
    let impacts: Vec<Scene> = impacts.into_iter().map(|(_, impact)| impact).collect();
    let moments = story::moments(&worked.told);
    let ends = story::ends(&worked.scene, &worked.told);
    // Of one impact beliefs are tried on that alone, not on all that friction leaves.
    let story = has_stages.then(|| worked.scene.clone());
    let ways = worked.ways()?.into_iter().map(|way| Sheet {
        given: (way.given.iter().map(Sentence::not_negative))
            .map(|given| given.to_string())
            .collect(),
        scene: way.scene,
        derivation: way.derivation,
        moments: moments.clone(),
        all: all.clone(),
        impacts: impacts.clone(),
        ends: ends.clone(),
        laws: laws.clone(),
        accelerations: story::accelerations(&worked.told),
        coefficients: coefficients.clone(),
        story: (story.clone()).map(|scene| Story::new(scene, answers)),
        spoken: Vec::new(),
        otherwise: Vec::new(),
    });
    let mut ways: Vec<Sheet> = ways.collect();
    // What leads one way may hold nowhere in the domain, though nobody proved that: the others go first.
    if ways.len() > 1 {
        ways.sort_by_cached_key(|way| !way.has_points());
    }
    let mut sheet = ways.remove(0);
    sheet.otherwise = ways;
    Ok((sheet, notes))
}

/// Thresholds of friction that are asked for: the question, the coefficient it bounds, and how that stands to it.
pub(super) fn coefficients(scene: &Scene) -> Vec<(String, Symbol, Relation)> {
    let rough = |q: &Question| {
        let (mu, relation) = friction_bound(scene, &q.name)?;
        Some((q.name.clone(), mu, relation))
    };
    scene.questions.iter().filter_map(rough).collect()
}

/// The answers of a scene that may not be possible.
fn answers(scene: &Scene) -> Vec<Answer> {
    story::tell(scene).map_or_else(|_| Vec::new(), |told| told.answers)
}

/// The quantity that is meant where none is named: the one question of a scene that has no more.
pub fn only_quantity(sheet: &Sheet) -> Option<String> {
    let mut answered = sheet.answered();
    let one = answered.next()?;
    answered.next().is_none().then(|| one.name.clone())
}

/// The scene in the one case of friction it is in. Where several are left each is a way it can go, which is told.
fn gradable(scene: Scene) -> (Scene, Vec<String>) {
    match verify::friction::settled(&scene) {
        Ok(scene) => (scene, Vec::new()),
        Err(why) if scene.has_stages() => (scene, vec![why]),
        Err(why) => {
            let note = format!(
                "{why}\nan answer is right where it is in one of them, given that it goes this way"
            );
            (scene.staged(worked::IMPACT), vec![note])
        }
    }
}
