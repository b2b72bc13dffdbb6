//! A picture with its heading, notes and words, and pictures under each other on one page.

use super::label::advance;
use super::plane::opposite;
use super::sheet::{Item, SMALL, Sheet};
use super::stage::Stage;
use super::{
    Course, Drawing, Label, Piece, Room, Subject, Which, during, geometry, is_readable, label,
    motion, picture, shown_at, svg, values, words,
};
use crate::numeric::Motion;
use crate::numeric::system::Unknown;
use crate::scene::{self, Scene};

/// Least width of a picture, in pixels.
const COLUMN: f64 = 340.0;
/// Margin on all sides.
const MARGIN: f64 = 10.0;
/// Font size of headings.
const HEADING: f64 = 14.0;
/// By how much a font that stands in for the one measured may be wider.
const WIDER: f64 = 1.2;

/// A picture with its words, before it has a place on the page.
pub(super) struct Panel {
    pub(super) heading: String,
    pub(super) sheet: Sheet,
    notes: Vec<String>,
    caption: Vec<Piece>,
    alternative: String,
}

/// Whether an unknown is drawn in the motion after. Nobody misses the spin of a pulley without mass, which its strings turn.
fn is_drawn(scene: &Scene, unknown: Unknown) -> bool {
    match unknown {
        Unknown::Spin(b) => !scene.bodies[b].is_light_pulley(),
        Unknown::Velocity(..) => true,
        _ => false,
    }
}

pub(super) fn panel(stage: &Stage, motion: Option<&Motion<f64>>, which: Which) -> Panel {
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
                    if motion.loose.iter().any(|u| is_drawn(scene, *u)) {
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
            let bears = super::bearing(scene);
            caption.extend(told(&|name| bears.contains(name)));
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

pub(super) fn motion_panel(name: &str, course: &Course) -> Panel {
    let begin = course.placed();
    let mut scene = motion::stand_in(&begin, &course.kind);
    scene.stages = vec![scene::Stage {
        name: name.to_string(),
        kind: course.kind.clone(),
        scene: begin,
        ..scene::Stage::default()
    }];
    let values = values::Values {
        point: shown_at(&scene),
    };
    let sheet = is_readable(&scene)
        .then(|| motion::motion(&scene, &values, course))
        .flatten();
    let mut notes = Vec::new();
    if sheet.is_none() {
        notes.push(String::from("Not drawn: at the values tried something has no finite place, or the motion does not come to its end."));
    }
    let sheet = sheet.unwrap_or_default();
    let labels = labels(&sheet);
    let name = words::title(name);
    let caption = vec![Piece::Words(format!(
        "{name}: broken lines at the beginning, full lines at the end."
    ))];
    Panel {
        heading: name.clone(),
        alternative: format!("Motion {name}. Marked: {labels}."),
        sheet,
        notes,
        caption,
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
pub(super) fn finish(scene: &Scene, panels: Vec<Panel>) -> Drawing {
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
    written(page, [width, -top], title, caption, &alternatives.join(" "))
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
    sheet.shift(opposite(page.low));
    written(sheet, page.extent(), title, caption, alternative)
}

/// What lies on a page of this width and height, with its words.
fn written(
    page: Sheet,
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
        items: page.items,
        caption,
        alternative: label::visible(alternative),
    }
}

/// Sets words in lines that fit the width.
pub(super) fn lines(
    items: &mut Vec<Item>,
    text: &str,
    size: f64,
    bold: bool,
    width: f64,
    top: &mut f64,
) {
    let room = width - 2.0 * MARGIN;
    let heavy = if bold { 1.06 } else { 1.0 };
    let wide = |s: &str| s.chars().map(advance).sum::<f64>() * size * heavy * WIDER;
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
pub(super) fn nothing(scene: &Scene) -> Drawing {
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
