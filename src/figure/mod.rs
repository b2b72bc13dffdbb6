//! Figures of a scene: before, free-body diagrams during the collision, after.
//!
//! In: a scene. Out: SVG with a caption and a text alternative. `values` picks representative numbers, `stage` lays
//! bodies out, `picture` draws on a `sheet`, `place` finds room for labels, `svg` writes. Nothing here decides
//! anything about mechanics: the motion after comes from [`crate::numeric`] at the values the scene is drawn at.

mod during;
mod inline;
mod label;
mod latex;
mod marks;
mod measure;
mod motion;
mod picture;
mod place;
#[cfg(feature = "png")]
mod png;
mod pose;
mod quantity;
mod sheet;
mod stage;
mod support;
mod svg;
mod tikz;
mod values;
mod words;

pub use label::Label;
pub use latex::letter;
pub use tikz::{COLORS, escaped, node};

use std::collections::BTreeSet;

use crate::expr::{Expr, Point, Symbol};
use crate::numeric::Motion;
use crate::scene::{BlowImpulse, ContactLaw, KnownQuantity, Scene, Shape, StageKind};
use label::advance;
pub(crate) use label::visible;
pub(crate) use place::{Room, Spot, Wish};
#[cfg(feature = "png")]
pub use png::{PngFault, png};
pub use sheet::Ink;
use sheet::{Item, SMALL};
pub(crate) use sheet::{Line, Sheet};
use stage::Stage;
pub use svg::escape;

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
    /// The same as TikZ.
    pub tikz: String,
    /// What it shows and the values it is drawn at.
    pub caption: Vec<Piece>,
    /// The picture in words, plain text.
    pub alternative: String,
}

/// A piece of a caption.
#[derive(Clone, PartialEq, Debug)]
pub enum Piece {
    /// Plain words.
    Words(String),
    /// A symbol, or a short formula.
    Symbol(Label),
}

/// A caption in plain characters.
pub fn plain(caption: &[Piece]) -> String {
    let each = caption.iter().map(|piece| match piece {
        Piece::Words(words) => words.clone(),
        Piece::Symbol(label) => label.text().replace('\u{2009}', " "),
    });
    each.collect()
}

/// Least width of a picture, in pixels.
const COLUMN: f64 = 340.0;
/// Margin on all sides.
const MARGIN: f64 = 10.0;
/// Font size of headings.
const HEADING: f64 = 14.0;
/// Bodies and parts a scene may have to be drawn; beyond that nobody could read it.
const MOST_BODIES: usize = 40;
/// Hinges, contacts and blows a scene may have to be drawn.
const MOST_JOINTS: usize = 80;
/// Named points a scene may have to be drawn.
const MOST_POINTS: usize = 120;

/// Values a scene is drawn at: those given, and for the others some at which its bodies touch and approach each other.
pub fn shown_at(scene: &Scene) -> Point<f64> {
    values::representative(scene).point
}

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
    /// A motion: the bodies at its beginning, what happens, and whether a rotation is clockwise.
    Motion(Scene, StageKind, bool),
}

/// The pictures of a stage, those of an impact each with what it shows.
pub fn chapter(name: &str, chapter: &Chapter) -> Vec<(Drawing, Option<Which>)> {
    match chapter {
        Chapter::Impact(scene) => kinds(scene)
            .into_iter()
            .map(|which| (draw(scene, which), Some(which)))
            .collect(),
        Chapter::Motion(scene, kind, clockwise) => {
            let panel = motion_panel(name, scene, kind, *clockwise);
            vec![(finish(scene, vec![panel]), None)]
        }
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
                    one.heading = format!("{name}: {}", one.heading);
                    panels.push(one);
                }
            }
            Chapter::Motion(scene, kind, clockwise) => {
                panels.push(motion_panel(name, scene, kind, *clockwise));
            }
        }
    }
    if panels.is_empty() {
        return nothing(scene);
    }
    finish(scene, panels)
}

fn motion_panel(name: &str, scene: &Scene, kind: &StageKind, clockwise: bool) -> Panel {
    let scene = motion::stand_in(scene, kind);
    let values = values::representative(&scene);
    let sheet = is_readable(&scene)
        .then(|| motion::motion(&scene, &values, kind, clockwise))
        .flatten();
    let mut notes = Vec::new();
    if sheet.is_none() {
        notes.push(String::from("Not drawn: something has no finite place."));
    }
    let sheet = sheet.unwrap_or_default();
    let labels = labels(&sheet);
    let caption = vec![Piece::Words(format!(
        "{}: broken lines at the beginning, full lines at the end.",
        words::capital(name)
    ))];
    Panel {
        heading: name.to_string(),
        alternative: format!("Motion {name}. Marked: {labels}."),
        sheet,
        notes,
        caption,
    }
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

/// The pictures a worked solution shows: before, system and bodies during, after.
pub fn all(scene: &Scene) -> Vec<Drawing> {
    if !is_readable(scene) {
        return vec![nothing(scene)];
    }
    kinds(scene)
        .into_iter()
        .map(|which| draw(scene, which))
        .collect()
}

/// The pictures a scene has, in order.
pub fn kinds(scene: &Scene) -> Vec<Which> {
    let movable: Vec<usize> = (0..scene.bodies.len())
        .filter(|i| !scene.bodies[*i].is_fixed())
        .collect();
    let mut out = vec![Which::Before];
    if movable.len() > 1 {
        out.push(Which::During(Subject::System));
    }
    out.extend(movable.into_iter().map(|i| Which::During(Subject::Body(i))));
    out.push(Which::After);
    out
}

/// A picture with its words, before it has a place on the page.
struct Panel {
    heading: String,
    sheet: Sheet,
    notes: Vec<String>,
    caption: Vec<Piece>,
    alternative: String,
}

fn panel(stage: &Stage, motion: Option<&Motion<f64>>, which: Which) -> Panel {
    let scene = stage.scene;
    let geometry = geometry(scene);
    let told = |shown: &dyn Fn(&str) -> bool| words::values(scene, stage.values, shown);
    let say = |words: String| vec![Piece::Words(words)];
    match which {
        Which::Before | Which::All => {
            let heading = "Just before".to_string();
            let mut caption = say(format!("{heading}."));
            caption.extend(told(&|name| geometry.contains(name)));
            Panel {
                sheet: picture::before(stage, motion),
                notes: Vec::new(),
                caption,
                alternative: format!("Just before the collision. {}", words::scene(scene)),
                heading,
            }
        }
        Which::During(subject) => {
            let (bodies, of) = match subject {
                Subject::System => (stage.movable(), "the system".to_string()),
                Subject::Body(i) if i < scene.bodies.len() && !scene.bodies[i].is_fixed() => {
                    (vec![i], scene.bodies[i].called())
                }
                Subject::Body(_) => (Vec::new(), "no movable body".to_string()),
            };
            let of = if matches!(subject, Subject::System) && stage.movable().len() == 1 {
                stage
                    .movable()
                    .first()
                    .map_or(of, |i| scene.bodies[*i].called())
            } else {
                of
            };
            let heading = format!("During the collision: {of}");
            let (sheet, notes) = during::during(stage, &bodies, motion);
            let labels = labels(&sheet);
            let note = notes.join(" ");
            Panel {
                alternative: format!("Free-body diagram of {of} during the collision, impulses only. Marked: {labels}. {note}")
                    .trim_end()
                    .to_string(),
                caption: say(
                    format!("During the collision: the impulses on {of}. {note}")
                        .trim_end()
                        .to_string(),
                ),
                heading,
                sheet,
                notes,
            }
        }
        Which::After => {
            let heading = "Just after".to_string();
            let mut notes = Vec::new();
            let sheet = match motion {
                Some(motion) => {
                    if !motion.loose.is_empty() {
                        notes.push(
                            "The equations leave part of the motion open; that part is not drawn."
                                .to_string(),
                        );
                    }
                    picture::after(stage, motion)
                }
                None => {
                    notes.push("The motion after is not drawn: the scene's equations have no solution at these values.".to_string());
                    Sheet::default()
                }
            };
            let labels = labels(&sheet);
            let mut caption = say(format!("{heading}."));
            caption.extend(told(&|_| true));
            if !notes.is_empty() {
                caption.push(Piece::Words(format!(" {}", notes.join(" "))));
            }
            Panel {
                alternative: format!(
                    "Just after the collision. Marked: {labels}. {}",
                    notes.join(" ")
                )
                .trim_end()
                .to_string(),
                caption,
                heading,
                sheet,
                notes,
            }
        }
    }
}

/// What the labels of a sheet say.
fn labels(sheet: &Sheet) -> String {
    let mut seen = Vec::new();
    for item in &sheet.items {
        if let Item::Text { label, .. } = item {
            let text = label.text();
            if !seen.contains(&text) {
                seen.push(text);
            }
        }
    }
    if seen.is_empty() {
        "nothing".to_string()
    } else {
        seen.join(", ")
    }
}

/// Puts panels under each other on one page.
fn finish(scene: &Scene, panels: Vec<Panel>) -> Drawing {
    let width = panels
        .iter()
        .filter_map(|p| p.sheet.room())
        .map(|r| r.extent()[0] + 2.0 * MARGIN)
        .fold(COLUMN, f64::max);
    let mut items: Vec<Item> = Vec::new();
    let mut top = 0.0;
    let (mut caption, mut alternatives) = (Vec::new(), Vec::new());
    // A picture alone has its words in the caption.
    let several = panels.len() > 1;
    let bare = panels.iter().all(|p| p.sheet.room().is_none());
    for mut panel in panels {
        top -= MARGIN;
        if several || bare {
            lines(&mut items, &panel.heading, HEADING, true, width, &mut top);
            top -= 6.0;
        }
        if let Some(room) = panel.sheet.room() {
            let [_, h] = room.extent();
            panel
                .sheet
                .shift([width / 2.0 - room.middle()[0], top - room.high[1]]);
            items.append(&mut panel.sheet.items);
            top -= h + 6.0;
        }
        for note in panel.notes.iter().filter(|_| several || bare) {
            lines(&mut items, note, SMALL, false, width, &mut top);
        }
        top -= MARGIN;
        if !caption.is_empty() {
            caption.push(Piece::Words(String::from(" ")));
        }
        caption.extend(panel.caption);
        alternatives.push(panel.alternative);
    }
    let mut page = Sheet {
        items,
        ..Sheet::default()
    };
    page.shift([0.0, -top]);
    let title = if scene.title.is_empty() {
        "Collision"
    } else {
        &scene.title
    };
    written(
        &page,
        [width, -top],
        title,
        caption,
        &alternatives.join(" "),
    )
}

/// A sheet as a picture, with a margin on all sides.
pub(crate) fn framed(
    mut sheet: Sheet,
    title: &str,
    caption: Vec<Piece>,
    alternative: &str,
) -> Drawing {
    let room = sheet.room().unwrap_or(Room::around([0.0; 2], 0.0));
    let page = room.grown(MARGIN);
    sheet.shift([-page.low[0], -page.low[1]]);
    written(&sheet, page.extent(), title, caption, alternative)
}

/// What lies on a page of this width and height, with its words.
fn written(
    page: &Sheet,
    [width, height]: [f64; 2],
    title: &str,
    caption: Vec<Piece>,
    alternative: &str,
) -> Drawing {
    let svg = svg::write(&svg::Page {
        items: &page.items,
        width,
        height,
        title,
        description: alternative,
    });
    Drawing {
        svg,
        tikz: tikz::write(&page.items),
        caption,
        alternative: label::visible(alternative),
    }
}

/// Sets words in lines that fit the width.
fn lines(items: &mut Vec<Item>, text: &str, size: f64, bold: bool, width: f64, top: &mut f64) {
    let room = width - 2.0 * MARGIN;
    let wide = |s: &str| s.chars().map(advance).sum::<f64>() * size * if bold { 1.06 } else { 1.0 };
    let mut line = String::new();
    let mut all: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let longer = if line.is_empty() {
            word.to_string()
        } else {
            format!("{line} {word}")
        };
        if wide(&longer) > room && !line.is_empty() {
            all.push(std::mem::replace(&mut line, word.to_string()));
        } else {
            line = longer;
        }
    }
    all.push(line);
    for line in all.into_iter().take(6) {
        let mut fitting = String::new();
        for c in line.chars() {
            if wide(&fitting) > room - size && wide(&line) > room {
                fitting.push('…');
                break;
            }
            fitting.push(c);
        }
        let mut label = Label::default();
        label.push(&label::visible(&fitting), false, label::Level::Base);
        let high = size * 1.3;
        let long = wide(&fitting).min(room);
        items.push(Item::text(
            label,
            size,
            bold,
            Room {
                low: [MARGIN, *top - high],
                high: [MARGIN + long, *top],
            },
        ));
        *top -= high;
    }
}

/// A sheet that says why nothing is drawn.
fn nothing(scene: &Scene) -> Drawing {
    let said =
        "This scene has no picture: a position has no finite value, or there is too much to show.";
    let panel = Panel {
        heading: scene.title.clone(),
        sheet: Sheet::default(),
        notes: vec![said.to_string()],
        caption: vec![Piece::Words(said.to_string())],
        alternative: said.to_string(),
    };
    finish(scene, vec![panel])
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
        if let ContactLaw::Frictionless { .. } = contact.law {}
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

#[cfg(test)]
mod tests;
