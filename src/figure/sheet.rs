//! The display list: lines, circles, arrows and labels on one sheet, in pixels with y up.
//!
//! What is drawn is also an obstacle to labels. Labels are wishes until [`Sheet::settle`] finds them a place. Knows
//! nothing of scenes or SVG.

use std::f64::consts::TAU;

use super::label::{Label, extent};
use super::place::{self, Room, Spot, Wish};
use super::plane::{Pair, ahead, minus, polar, times};

/// What a line or label belongs to; the writer picks colors.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Ink {
    /// Bodies and plain text.
    Body,
    /// Velocities and spins.
    Motion,
    /// Impulses.
    Impulse,
    /// Dimensions, angles, axes.
    Dimension,
    /// Ground, walls and other things that do not move.
    Ground,
    /// The lines that numbers along an axis stand at.
    Grid,
    /// A curve, by its number; after eight the colors begin again.
    Curve(usize),
}

/// How a line is drawn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Line {
    /// What it belongs to.
    pub ink: Ink,
    /// Width in pixels.
    pub width: f64,
    /// Whether it is broken.
    pub dashed: bool,
    /// Whether its inside is tinted.
    pub filled: bool,
}

/// How something is drawn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Paint {
    /// By its outline.
    Stroke(Line),
    /// Filled.
    Fill(Ink),
}

impl Paint {
    /// By how much what is drawn reaches beyond its points, in pixels.
    fn reach(&self) -> f64 {
        match self {
            Paint::Stroke(line) => line.width / 2.0,
            Paint::Fill(_) => 0.0,
        }
    }

    /// Whether it is an outline in an ink.
    fn is_line(&self, ink: Ink) -> bool {
        matches!(self, Paint::Stroke(line) if line.ink == ink)
    }
}

/// One thing on the sheet.
#[derive(Clone, PartialEq, Debug)]
pub enum Item {
    /// A line through points, or a polygon.
    Path {
        /// Its points.
        points: Vec<Pair>,
        /// Whether it returns to its start.
        closed: bool,
        /// How it is drawn.
        paint: Paint,
    },
    /// A circle, or a dot.
    Circle {
        /// Its middle.
        center: Pair,
        /// Its radius.
        radius: f64,
        /// How it is drawn.
        paint: Paint,
    },
    /// A label in its place.
    Text {
        /// Left end of its line of text.
        at: Pair,
        /// Font size.
        size: f64,
        /// Whether it is a heading.
        bold: bool,
        /// Whether its end is what keeps its place: in a wider font it grows away from what it belongs to.
        from_end: bool,
        /// What it says.
        label: Label,
        /// The room it takes.
        room: Room,
    },
    /// What says something where it is pointed at.
    Noted {
        /// What is drawn.
        item: Box<Item>,
        /// What it says.
        note: String,
    },
}

/// Font size of symbols.
pub const SIZE: f64 = 16.0;
/// Font size of notes.
pub const SMALL: f64 = 13.0;
/// Width of an outline.
pub const OUTLINE: f64 = 1.6;

/// A picture in the making.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    /// What is drawn, in order.
    pub items: Vec<Item>,
    /// Segments labels keep off, and how much.
    pub walls: Vec<(Pair, Pair, f64)>,
    /// Labels that wait for their place.
    pub wishes: Vec<Wish>,
    /// Room that labels must leave free.
    pub kept: Vec<Room>,
    /// Edges of ground, walls and supports, each with the direction into it.
    pub grounds: Vec<(Pair, Pair, Pair)>,
}

impl Line {
    /// A full line of usual width.
    pub fn of(ink: Ink) -> Line {
        Line {
            ink,
            width: OUTLINE,
            dashed: false,
            filled: false,
        }
    }

    /// A thin line.
    pub fn thin(ink: Ink) -> Line {
        Line {
            width: 0.9,
            ..Line::of(ink)
        }
    }

    /// A thin broken line.
    pub fn dashed(ink: Ink) -> Line {
        Line {
            dashed: true,
            ..Line::thin(ink)
        }
    }

    /// The outline of a body.
    pub fn solid() -> Line {
        Line {
            filled: true,
            ..Line::of(Ink::Body)
        }
    }
}

impl Sheet {
    /// Draws a line through points; labels keep off it as much as `weight` says, and not at all for 0.
    pub fn path(&mut self, points: Vec<Pair>, closed: bool, line: Line, weight: f64) {
        let mut walls: Vec<(Pair, Pair, f64)> =
            points.windows(2).map(|w| (w[0], w[1], weight)).collect();
        if let (true, Some(first), Some(last)) = (closed, points.first(), points.last()) {
            walls.push((*last, *first, weight));
        }
        walls.retain(|(.., weight)| *weight > 0.0);
        self.walls.extend(walls);
        let paint = Paint::Stroke(line);
        self.items.push(Item::Path {
            points,
            closed,
            paint,
        });
    }

    /// Draws a segment.
    pub fn segment(&mut self, from: Pair, to: Pair, line: Line, weight: f64) {
        self.path(vec![from, to], false, line, weight);
    }

    /// Draws a circle.
    pub fn circle(&mut self, center: Pair, radius: f64, line: Line) {
        let edge: Vec<Pair> = arc(center, radius, 0.0, TAU);
        self.walls
            .extend(edge.windows(2).map(|w| (w[0], w[1], 1.0)));
        self.items.push(Item::Circle {
            center,
            radius,
            paint: Paint::Stroke(line),
        });
    }

    /// Draws a dot.
    pub fn dot(&mut self, center: Pair, radius: f64, ink: Ink) {
        self.kept.push(Room::around(center, radius + 1.0));
        self.items.push(Item::Circle {
            center,
            radius,
            paint: Paint::Fill(ink),
        });
    }

    /// What was drawn last says this where it is pointed at.
    pub fn note(&mut self, note: &str) {
        if note.is_empty() {
            return;
        }
        if let Some(item) = self.items.pop() {
            self.items.push(Item::Noted {
                item: Box::new(item),
                note: note.to_string(),
            });
        }
    }

    /// Draws an arrow.
    pub fn arrow(&mut self, from: Pair, to: Pair, ink: Ink, width: f64) {
        let d = minus(to, from);
        let length = d[0].hypot(d[1]);
        if length < 1e-6 {
            return;
        }
        let along = times(d, 1.0 / length);
        let size = if width > 1.5 { 10.0 } else { 7.0 };
        let stop = ahead(to, along, -(size * 0.7));
        let line = Line {
            width,
            ..Line::of(ink)
        };
        self.segment(from, stop, line, 0.0);
        self.items.push(head(to, along, size, ink));
        self.walls.push((from, to, 3.0));
        let middle = ahead(to, along, -(size / 2.0));
        self.kept.push(Room::around(middle, size / 2.0));
    }

    /// Draws a circular arrow, counterclockwise if `turn` is positive.
    pub fn turning(&mut self, center: Pair, radius: f64, start: f64, turn: f64, ink: Ink) {
        let points = arc(center, radius, start, start + turn);
        self.walls
            .extend(points.windows(2).map(|w| (w[0], w[1], 3.0)));
        let end = start + turn;
        // The head's base is a chord: leaning it inwards by half its angle keeps it on the circle.
        let sign = turn.signum();
        let lean = end - sign * 4.0 / radius;
        let along = [-lean.sin() * sign, lean.cos() * sign];
        let tip = polar(center, radius, end);
        let cut = arc(center, radius, start, start + turn - sign * 6.0 / radius);
        let line = Line {
            width: 1.9,
            ..Line::of(ink)
        };
        self.path(cut, false, line, 0.0);
        self.items.push(head(tip, along, 9.0, ink));
        self.kept.push(Room::around(tip, 5.0));
    }

    /// Writes a label at a point, with this share of its room to the left of it and below it; gives the room.
    pub fn put(&mut self, label: Label, size: f64, at: Pair, share: Pair) -> Room {
        let extent = extent(&label, size);
        let low = [0, 1].map(|k| at[k] - share[k] * extent[k]);
        let high = [0, 1].map(|k| low[k] + extent[k]);
        let room = Room { low, high };
        self.kept.push(room);
        self.items.push(Item::text(label, size, false, room));
        room
    }

    /// Asks for a label.
    pub fn wish(&mut self, label: Label, size: f64, spot: Spot) {
        if !label.runs.is_empty() {
            self.wishes.push(Wish { label, size, spot });
        }
    }

    /// Gives every label its place.
    pub fn settle(&mut self) {
        let wishes = std::mem::take(&mut self.wishes);
        let boxes = place::place(&wishes, &self.walls, &self.kept);
        for (i, (wish, room)) in wishes.into_iter().zip(boxes.clone()).enumerate() {
            // A leader through another label would be worse than none.
            let crosses = |[a, b]: [Pair; 2]| {
                let others = boxes.iter().enumerate().filter(|(j, _)| *j != i);
                others.map(|(_, room)| room).any(|r| r.crossed(a, b) > 0.0)
            };
            if let Some([from, to]) = place::leader(&wish, &room).filter(|l| !crosses(*l)) {
                self.segment(from, to, Line::thin(Ink::Dimension), 0.0);
            }
            let is_left = wish.label.is_plain() && wish.spot.is_right_of(&room);
            let mut text = Item::text(wish.label, wish.size, false, room);
            if let Item::Text { from_end, .. } = &mut text {
                *from_end = is_left;
            }
            self.items.push(text);
        }
    }

    /// The lines drawn in an ink, each through its points; a closed one returns to its first.
    pub fn lines(&self, ink: Ink) -> Vec<Vec<Pair>> {
        let drawn = self.items.iter().filter_map(|item| match item {
            Item::Path {
                points,
                closed,
                paint,
            } if paint.is_line(ink) => {
                let again = points.first().filter(|_| *closed);
                Some(points.iter().chain(again).copied().collect())
            }
            Item::Circle {
                center,
                radius,
                paint,
            } if paint.is_line(ink) => Some(arc(*center, *radius, 0.0, TAU)),
            _ => None,
        });
        drawn.collect()
    }

    /// The room everything takes; `None` for an empty sheet.
    pub fn room(&self) -> Option<Room> {
        let rooms = self.items.iter().filter_map(Item::room);
        rooms.reduce(|all, room| all.with(&room))
    }

    /// Moves everything.
    pub fn shift(&mut self, by: Pair) {
        self.items.iter_mut().for_each(|item| item.shift(by));
    }
}

impl Item {
    /// A label that fills a room.
    pub fn text(label: Label, size: f64, bold: bool, room: Room) -> Item {
        let (_, lowered) = label.reach();
        let depth = if lowered { 0.42 } else { 0.25 };
        Item::Text {
            at: [room.low[0] + 1.0, room.low[1] + depth * size],
            size,
            bold,
            from_end: false,
            label,
            room,
        }
    }

    /// The room it takes; `None` where it has no point.
    fn room(&self) -> Option<Room> {
        match self {
            Item::Path { points, paint, .. } => Some(Room::of(points)?.grown(paint.reach())),
            Item::Circle {
                center,
                radius,
                paint,
            } => Some(Room::around(*center, radius + paint.reach())),
            Item::Text { room, .. } => Some(*room),
            Item::Noted { item, .. } => item.room(),
        }
    }

    fn shift(&mut self, by: Pair) {
        let moved = |p: &mut Pair| {
            p[0] += by[0];
            p[1] += by[1];
        };
        match self {
            Item::Path { points, .. } => points.iter_mut().for_each(moved),
            Item::Circle { center, .. } => moved(center),
            Item::Text { at, room, .. } => {
                moved(at);
                moved(&mut room.low);
                moved(&mut room.high);
            }
            Item::Noted { item, .. } => item.shift(by),
        }
    }
}

/// The head of an arrow, as long as `size`, whose tip points along a unit vector.
fn head(tip: Pair, along: Pair, size: f64, ink: Ink) -> Item {
    let corner = |back: f64, side: f64| {
        [
            tip[0] - along[0] * back - along[1] * side,
            tip[1] - along[1] * back + along[0] * side,
        ]
    };
    let notch = corner(size * 0.75, 0.0);
    let points = vec![
        tip,
        corner(size, size * 0.36),
        notch,
        corner(size, -size * 0.36),
    ];
    Item::Path {
        points,
        closed: true,
        paint: Paint::Fill(ink),
    }
}

/// Points on an arc, close enough to look round.
pub fn arc(center: Pair, radius: f64, from: f64, to: f64) -> Vec<Pair> {
    let steps = ((to - from).abs() * 10.0).ceil().clamp(4.0, 64.0) as usize;
    (0..=steps)
        .map(|i| {
            let phi = from + (to - from) * i as f64 / steps as f64;
            polar(center, radius, phi)
        })
        .collect()
}

/// Longest arrow in pixels.
pub(super) const LONG: f64 = 62.0;
/// Shortest arrow in pixels.
const SHORT: f64 = 24.0;

/// The length of the arrow of a value in pixels, beside the largest of its kind.
pub(super) fn arrow_length(value: f64, most: f64) -> f64 {
    if most > 0.0 {
        (LONG * value / most).max(SHORT)
    } else {
        SHORT
    }
}
