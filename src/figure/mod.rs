//! Figures of a scene: before, free-body diagrams during the collision, after.
//!
//! In: a scene. Out: SVG with a caption and a text alternative. `values` picks representative numbers, `stage` lays
//! bodies out, `picture` draws on a `sheet`, `place` finds room for labels, `svg` writes. Nothing here decides
//! anything about mechanics: the motion after comes from [`crate::numeric`] at the values the scene is drawn at.

mod during;
mod film;
mod fixture;
pub(crate) mod label;
mod marks;
mod measure;
mod motion;
mod panel;
mod picture;
mod place;
mod plane;
#[cfg(feature = "png")]
mod png;
mod pose;
mod quantity;
mod sheet;
mod stage;
mod strand;
mod support;
mod svg;
mod tikz;
mod values;
mod way;
mod words;

pub use film::{End, Film, Moment, Taut, film, shown_at};
pub use label::{Label, Level};
pub(crate) use panel::framed;
pub use tikz::{COLORS, escaped, node};

use std::collections::BTreeSet;

use crate::expr::{Expr, Symbol};
use crate::numeric::{Needed, needed};
use crate::scene::{Ask, BlowImpulse, KnownQuantity, Question, Scene, Shape, StageKind};
pub(crate) use label::visible;
use panel::{Panel, finish, motion_panel, nothing, panel};
pub(crate) use place::{Room, Spot};
#[cfg(feature = "png")]
pub use png::{PngFault, png};
pub use sheet::Ink;
use sheet::Item;
pub(crate) use sheet::{Line, Sheet};
pub use svg::{color, escape};

/// Which picture.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Which {
    /// Just before: velocities, spins, dimensions, angles.
    Before,
    /// The free-body diagram during the collision.
    During(Subject),
    /// Just after.
    After,
    /// All of them in one column.
    All,
}

/// Whose free-body diagram.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Subject {
    /// All bodies that can move.
    System,
    /// One body, by index.
    Body(usize),
}

/// A picture ready to use.
#[derive(Clone, PartialEq, Debug)]
pub struct Drawing {
    /// The SVG document; may stand alone or inside HTML.
    pub svg: String,
    /// What lies on it.
    items: Vec<Item>,
    /// What it shows and the values it is drawn at.
    pub caption: Vec<Piece>,
    /// The picture in words, plain text.
    pub alternative: String,
}

impl Drawing {
    /// The same as TikZ.
    pub fn tikz(&self) -> String {
        tikz::write(&self.items)
    }
}

/// A piece of a caption.
#[derive(Clone, PartialEq, Debug)]
pub enum Piece {
    /// Plain words.
    Words(String),
    /// A symbol, or a short formula.
    Symbol(Label),
    /// What the symbol before it is, a number with its unit.
    Value(String),
}

/// A caption in plain characters.
pub fn plain(caption: &[Piece]) -> String {
    let each = caption.iter().map(|piece| match piece {
        Piece::Words(words) => words.clone(),
        Piece::Value(value) => format!(" = {value}"),
        Piece::Symbol(label) => label.text().replace('\u{2009}', " "),
    });
    each.collect()
}

/// Bodies and parts a scene may have to be drawn; beyond that nobody could read it.
const MOST_BODIES: usize = 40;
/// Hinges, contacts and blows a scene may have to be drawn.
const MOST_JOINTS: usize = 80;
/// Named points a scene may have to be drawn.
const MOST_POINTS: usize = 120;

/// Outlines of the bodies in the order of the scene, in meters where the scene places them: closed lines, of two points for
/// a thin rod and of one for a particle. `None` where a body has no finite place.
pub fn outlines(scene: &Scene) -> Option<Vec<Vec<Vec<[f64; 2]>>>> {
    let poses = pose::posed(scene, &values::representative(scene))?;
    Some(poses.iter().map(pose::Pose::lines).collect())
}

/// Draws one picture. A scene that has no place on paper gives a sheet that says so.
pub fn draw(scene: &Scene, which: Which) -> Drawing {
    if !is_readable(scene) {
        return nothing(scene);
    }
    let values = values::representative(scene);
    let stage = stage::stage(scene, &values);
    let Some(stage) = stage else {
        return nothing(scene);
    };
    let motion = picture::outcome(&stage);
    match which {
        Which::All => {
            let panels: Vec<Panel> = kinds(scene)
                .into_iter()
                .map(|w| panel(&stage, motion.as_ref(), w))
                .collect();
            finish(scene, panels)
        }
        one => finish(scene, vec![panel(&stage, motion.as_ref(), one)]),
    }
}

/// A stage of a story, to be drawn.
#[derive(Clone, Debug)]
pub enum Chapter {
    /// An impact, with the motion handed on put in.
    Impact(Scene),
    /// A motion.
    Motion(Course),
    /// No motion: the bodies are where it would end already.
    Rest,
}

/// A motion, to be drawn.
#[derive(Clone, Debug)]
pub struct Course {
    /// The bodies at its beginning.
    pub begin: Scene,
    /// What happens.
    pub kind: StageKind,
    /// Bodies that other stages move meanwhile, which their figures show.
    pub elsewhere: Vec<usize>,
    /// What is asked about it.
    pub asked: Vec<Question>,
}

impl Course {
    /// Whether a body takes no part and has no known place by then, as a rod that swings on from a blow.
    fn is_lost(&self, b: usize) -> bool {
        let body = &self.begin.bodies[b];
        let is_open = |name: &Symbol| self.begin.parameter(name).is_none() && **name != *"pi";
        let place = body.center.iter().chain([&body.angle]);
        !self.kind.moved().contains(&b) && place.flat_map(Expr::symbols).any(|name| is_open(&name))
    }

    /// The scene as it begins, with what has no known place, and is not drawn, as a point at rest where the motion begins.
    fn placed(&self) -> Scene {
        let mut out = self.begin.clone();
        for b in (0..out.bodies.len()).filter(|b| self.is_lost(*b)) {
            if let Some(first) = self.kind.moved().first() {
                out.bodies[b].center = out.bodies[*first].center.clone();
            }
            let body = &mut out.bodies[b];
            (body.angle, body.spin) = (Expr::zero(), Expr::zero());
            body.velocity = [Expr::zero(), Expr::zero()];
            body.shape = Shape::Particle;
        }
        out
    }

    /// The symbol of something that is asked about it.
    fn symbol(&self, is: impl Fn(&Ask) -> bool) -> Option<Label> {
        let mut asked = self.asked.iter().filter(|q| is(&q.ask));
        let first = asked.next()?;
        Some(Label::symbol(&first.name, first.latex.as_deref()))
    }
}

/// The pictures of a stage, those of an impact each with what it shows.
pub fn chapter(name: &str, chapter: &Chapter) -> Vec<(Drawing, Option<Which>)> {
    match chapter {
        Chapter::Impact(scene) => kinds(scene)
            .into_iter()
            .map(|which| (draw(scene, which), Some(which)))
            .collect(),
        Chapter::Motion(course) => {
            let panel = motion_panel(name, course);
            vec![(finish(&course.begin, vec![panel]), None)]
        }
        Chapter::Rest => Vec::new(),
    }
}

/// What a file with this picture is called.
pub fn file_name(which: Which) -> String {
    match which {
        Which::Before | Which::All => String::from("before"),
        Which::During(Subject::System) => String::from("during"),
        Which::During(Subject::Body(b)) => format!("during-{}", b + 1),
        Which::After => String::from("after"),
    }
}

/// All stages of a story in one column.
pub fn chapters(scene: &Scene, all: &[(String, Chapter)]) -> Drawing {
    let mut panels = Vec::new();
    for (name, chapter) in all {
        match chapter {
            Chapter::Impact(scene) => {
                let values = values::representative(scene);
                let stage = is_readable(scene).then(|| stage::stage(scene, &values));
                let Some(stage) = stage.flatten() else {
                    continue;
                };
                let motion = picture::outcome(&stage);
                for which in kinds(scene) {
                    let mut one = panel(&stage, motion.as_ref(), which);
                    one.heading = format!("{}. {}", words::title(name), one.heading);
                    panels.push(one);
                }
            }
            Chapter::Motion(course) => panels.push(motion_panel(name, course)),
            Chapter::Rest => {}
        }
    }
    if panels.is_empty() {
        return nothing(scene);
    }
    finish(scene, panels)
}

/// Whether a picture of so many things could be read at all.
fn is_readable(scene: &Scene) -> bool {
    let parts = |b: &crate::scene::Body| match &b.shape {
        Shape::Composite { parts } => parts.len(),
        _ => 1,
    };
    scene.bodies.iter().map(parts).sum::<usize>() <= MOST_BODIES
        && scene.hinges.len() + scene.contacts.len() + scene.blows.len() <= MOST_JOINTS
        && scene.points.len() <= MOST_POINTS
}

/// The pictures a scene has, in order.
pub fn kinds(scene: &Scene) -> Vec<Which> {
    let mut movable: Vec<usize> = scene.moving().collect();
    let touched = |i: &usize| scene.acting().any(|one| one.bodies.contains(i));
    // What nothing acts on shows nothing.
    if movable.iter().any(touched) {
        movable.retain(touched);
    }
    let mut out = vec![Which::Before];
    if movable.len() > 1 {
        out.push(Which::During(Subject::System));
    }
    out.extend(movable.into_iter().map(|i| Which::During(Subject::Body(i))));
    out.push(Which::After);
    out
}

/// Symbols that shape the picture before.
fn geometry(scene: &Scene) -> BTreeSet<Symbol> {
    let mut out = BTreeSet::new();
    let mut add = |e: &Expr| out.extend(e.symbols());
    for body in &scene.bodies {
        let parts = match &body.shape {
            Shape::Composite { parts } => parts.as_slice(),
            _ => &[],
        };
        for b in std::iter::once(body).chain(parts) {
            b.center
                .iter()
                .chain(&b.velocity)
                .chain([&b.angle, &b.spin])
                .for_each(&mut add);
            match &b.shape {
                Shape::Rod { length: e }
                | Shape::Disk { radius: e }
                | Shape::Ring { radius: e }
                | Shape::Sphere { radius: e } => add(e),
                Shape::Rectangle { width, height } => {
                    [width, height].into_iter().for_each(&mut add)
                }
                _ => {}
            }
        }
    }
    scene.points.iter().flat_map(|p| &p.at).for_each(&mut add);
    scene.hinges.iter().flat_map(|h| &h.at).for_each(&mut add);
    for contact in &scene.contacts {
        contact
            .at
            .iter()
            .chain(contact.normal.iter().flatten())
            .for_each(&mut add);
    }
    for blow in &scene.blows {
        let (BlowImpulse::Given(v) | BlowImpulse::Along(v)) = &blow.impulse;
        blow.at.iter().chain(v).for_each(&mut add);
    }
    for known in &scene.after {
        if let KnownQuantity::Velocity { along, .. } = &known.what {
            along.iter().for_each(&mut add);
        }
    }
    out
}

/// The parameters that the picture after hangs on: those of the picture before, and of the motion.
fn bearing(scene: &Scene) -> BTreeSet<Symbol> {
    let Needed { plain, angles } = needed(scene);
    let mut names = geometry(scene);
    names.extend(plain.into_iter().chain(angles.into_keys()));
    names
}

#[cfg(test)]
mod tests;
