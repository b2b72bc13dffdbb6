//! Hinges on a fixed body that a scene with stages states once: they hold in every impact, and a rotation is about them.
//!
//! In: the file. Out: the same file with each hinge in the impacts it holds in, and with the point that a rotation needs.

use crate::scene::body_file::{AboutFile, BodyFile, ShapeName, VelocityFile};
use crate::scene::contact_file::HingeFile;
use crate::scene::fault::Span;
use crate::scene::file::SceneFile;
use crate::scene::place_file::PositionFile;
use crate::scene::record::{Map, Text};
use crate::scene::record::{entries, keys};
use crate::scene::stage_file::StageFile;

/// Hinges by name.
type Hinges = Vec<(Text, HingeFile)>;

/// Puts the hinges of the whole scene into its impacts, and names the points that bodies turn about.
pub(in crate::scene) fn spread(file: &mut SceneFile) {
    let Some(mut stages) = file.stages.take() else {
        return;
    };
    let everywhere = given(file.hinges.as_ref());
    let bodies = &file.bodies;
    let fixed = |h: &HingeFile| h.bodies.items.iter().any(|b| is_fixed(bodies, b));
    let flies = |h: &HingeFile| {
        let moving = stages.iter().flat_map(moving);
        moving
            .into_iter()
            .any(|b| h.bodies.items.iter().any(|of| of.text == b.text))
    };
    let stays = everywhere.iter().all(|(_, h)| fixed(h) && !flies(h));
    let mut known: Hinges = Vec::new();
    if stays {
        known.extend(everywhere.clone());
        file.hinges = None;
    }
    let mut points = Vec::new();
    for stage in &mut stages {
        if let (Some(impact), true) = (&mut stage.impact, stays) {
            let own = impact
                .hinges
                .get_or_insert_with(|| Map(Vec::new(), Span::default()));
            for (name, hinge) in &everywhere {
                if !own.0.iter().any(|(other, _)| other.text == name.text) {
                    own.0.push((name.clone(), Some(hinge.clone())));
                }
            }
            if own.0.is_empty() {
                impact.hinges = None;
            }
        }
        let own = given(stage.impact.as_ref().and_then(|i| i.hinges.as_ref()));
        for (name, hinge) in own.into_iter().filter(|(_, h)| fixed(h)) {
            known.retain(|(other, _)| other.text != name.text);
            known.push((name, hinge));
        }
        let Some(turn) = &mut stage.turn else {
            continue;
        };
        let turns = |h: &HingeFile| h.bodies.items.iter().any(|b| b.text == turn.body.text);
        let found = match &turn.about {
            Some(PositionFile::Name(name)) => known.iter().find(|(h, _)| h.text == name.text),
            Some(_) => None,
            None => {
                let mut all = known.iter().filter(|(_, h)| turns(h));
                all.next().filter(|_| all.next().is_none())
            }
        };
        if let Some((name, hinge)) = found {
            turn.about.get_or_insert(PositionFile::Name(name.clone()));
            points.push((name.clone(), hinge.at.clone()));
        }
    }
    // What a scene begins with in a rotation turns about its fixed point from the start.
    if let Some(turn) = stages.first().and_then(|stage| stage.turn.as_ref())
        && let Some(about) = &turn.about
        && let mut all = file.bodies.0.iter_mut()
        && let Some((_, Some(body))) = all.find(|(name, _)| name.text == turn.body.text)
        && (body.velocity.is_none() && body.spin.is_some())
        && !matches!(body.shape, ShapeName::Particle | ShapeName::Fixed)
    {
        let about = about.clone();
        let span = turn.body.span;
        body.velocity = Some(VelocityFile::About(AboutFile { about, span }));
    }
    file.stages = Some(stages);
    for (name, at) in points {
        let names = keys(file.points.as_ref())
            .into_iter()
            .chain(keys(Some(&file.bodies)));
        if names.into_iter().all(|other| other.text != name.text) {
            let all = file
                .points
                .get_or_insert_with(|| Map(Vec::new(), Span::default()));
            all.0.push((name, Some(at)));
        }
    }
}

fn given(hinges: Option<&Map<HingeFile>>) -> Hinges {
    let all = entries(hinges);
    all.map(|(name, hinge)| (name.clone(), hinge.clone()))
        .collect()
}

/// The bodies that leave their hinges in a stage.
fn moving(stage: &StageFile) -> Vec<&Text> {
    let fall = stage
        .fall
        .iter()
        .flat_map(|f| f.with.iter().flatten().chain([&f.body]));
    let slide = stage
        .slide
        .iter()
        .flat_map(|s| s.with.iter().flatten().chain([&s.body]));
    fall.chain(slide).collect()
}

fn is_fixed(bodies: &Map<BodyFile>, name: &Text) -> bool {
    let all = entries(Some(bodies));
    let mut named = all.filter(|(other, _)| other.text == name.text);
    named.any(|(_, body)| matches!(body.shape, ShapeName::Fixed))
}
