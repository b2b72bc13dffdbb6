//! Particles of which a file does not say where they are: they are where something touches them first.
//!
//! In: a file. Out: the same file, in which such a particle has a `center`.

use super::body_file::ShapeName;
use super::file::SceneFile;
use super::place_file::PositionFile;
use super::record::entries;
use super::record::{Map, Text};

/// Gives each particle without a center the place of the first hinge, contact, support, string or blow that touches it when the
/// scene begins, unless that place is the particle itself. One that nothing touches then is at the origin.
pub(super) fn settle(file: &mut SceneFile) {
    let places = places(file);
    let points = entries(file.points.as_ref());
    let points: Vec<String> = points.map(|(name, _)| name.text.clone()).collect();
    let Map(bodies, _) = &mut file.bodies;
    for (name, body) in bodies {
        let Some(body) = body else { continue };
        if body.shape != ShapeName::Particle || body.center.is_some() {
            continue;
        }
        let is_itself = |at: &PositionFile| matches!(at, PositionFile::Name(n) if n.text == name.text && !points.contains(&n.text));
        let touches = |bodies: &[Text]| bodies.iter().any(|b| b.text == name.text);
        let mut all = places.iter();
        let found = all.find(|(bodies, at)| touches(bodies) && !is_itself(at));
        body.center = found.map(|(_, at)| at.clone());
    }
}

/// What touches bodies when the scene begins: which, and where.
fn places(file: &SceneFile) -> Vec<(Vec<Text>, PositionFile)> {
    let stages = file.stages.iter().flatten().enumerate();
    let begins = stages.filter(|(i, stage)| match &stage.from {
        None => *i == 0,
        Some(from) => from.text == "start",
    });
    let impacts: Vec<_> = begins.filter_map(|(_, s)| s.impact.as_ref()).collect();
    let each = impacts.iter();
    let hinges = file
        .hinges
        .iter()
        .chain(each.clone().flat_map(|i| &i.hinges));
    let contacts = file
        .contacts
        .iter()
        .chain(each.clone().flat_map(|i| &i.contacts));
    let blows = file.blows.iter().chain(each.clone().flat_map(|i| &i.blows));
    let one_sided = each.flat_map(|i| i.supports.iter().chain(&i.strings));
    let mut out = Vec::new();
    for (_, h) in hinges.flat_map(|m| entries(Some(m))) {
        out.push((h.bodies.items.to_vec(), h.at.clone()));
    }
    for (_, c) in contacts.flat_map(|m| entries(Some(m))) {
        out.extend(c.at.clone().map(|at| (c.bodies.items.to_vec(), at)));
    }
    for (_, o) in one_sided.flat_map(|m| entries(Some(m))) {
        out.extend(o.at.clone().map(|at| (o.bodies.items.to_vec(), at)));
    }
    for (_, b) in blows.flat_map(|m| entries(Some(m))) {
        out.push((vec![b.on.clone()], b.at.clone()));
    }
    out
}
