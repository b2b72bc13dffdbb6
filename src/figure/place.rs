//! Finds places for labels: many candidates each, scored by what they would cover, the best taken in a fixed order.
//!
//! In: labels with what they belong to, segments and rooms to keep off. Out: one room per label; no two of them overlap.

use super::label::{Label, extent};
use super::plane::{Pair, ahead, apart, between, distance, dot, left, minus, plus, size, times};

/// An upright rectangle.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Room {
    /// Lower left corner.
    pub low: Pair,
    /// Upper right corner.
    pub high: Pair,
}

/// What a label belongs to.
#[derive(Clone, Debug)]
pub enum Spot {
    /// A point; `toward` is the preferred direction, `reach` the least distance.
    Point {
        /// Where.
        at: Pair,
        /// Preferred direction, or zero.
        toward: Pair,
        /// Least distance from the point.
        reach: f64,
    },
    /// A segment; the label stands beside it.
    Along {
        /// Start.
        from: Pair,
        /// End.
        to: Pair,
    },
    /// The inside of a body, or else near it.
    Inside {
        /// Middle of the body.
        at: Pair,
        /// Radius that is certainly inside.
        radius: f64,
    },
}

impl Spot {
    /// A point, with the preferred direction or zero, and the least distance from it.
    pub fn point(at: Pair, toward: Pair, reach: f64) -> Spot {
        Spot::Point { at, toward, reach }
    }

    /// Whether a label in this room stands to the left of it.
    pub fn is_right_of(&self, room: &Room) -> bool {
        match self {
            Spot::Point { at, .. } => room.high[0] <= at[0],
            Spot::Along { from, to } => {
                let [wide, high] = minus(*to, *from).map(f64::abs);
                high > wide && room.middle()[0] < between(*from, *to, 0.5)[0]
            }
            Spot::Inside { .. } => false,
        }
    }
}

/// A label that wants a place.
#[derive(Clone, Debug)]
pub struct Wish {
    /// What it says.
    pub label: Label,
    /// Font size.
    pub size: f64,
    /// What it belongs to.
    pub spot: Spot,
}

impl Room {
    /// The square of half side `reach` around a point.
    pub fn around(at: Pair, reach: f64) -> Room {
        Room { low: at, high: at }.grown(reach)
    }

    /// The least box around points.
    pub fn of(points: &[Pair]) -> Option<Room> {
        let first = points.first()?;
        let point = |p: &Pair| Room { low: *p, high: *p };
        let all = points.iter().map(point);
        Some(all.fold(point(first), |room, p| room.with(&p)))
    }

    /// The least box around two.
    pub fn with(&self, other: &Room) -> Room {
        Room {
            low: [0, 1].map(|k| self.low[k].min(other.low[k])),
            high: [0, 1].map(|k| self.high[k].max(other.high[k])),
        }
    }

    /// Larger by a margin on every side.
    pub fn grown(&self, by: f64) -> Room {
        Room {
            low: self.low.map(|c| c - by),
            high: self.high.map(|c| c + by),
        }
    }

    /// Area shared with another box.
    pub fn overlap(&self, other: &Room) -> f64 {
        let side =
            |i: usize| (self.high[i].min(other.high[i]) - self.low[i].max(other.low[i])).max(0.0);
        side(0) * side(1)
    }

    /// Width and height.
    pub fn extent(&self) -> Pair {
        minus(self.high, self.low)
    }

    /// Middle.
    pub fn middle(&self) -> Pair {
        between(self.low, self.high, 0.5)
    }

    /// Length of a segment inside.
    pub(super) fn crossed(&self, a: Pair, b: Pair) -> f64 {
        // Most segments lie beside it altogether.
        let beside =
            |i: usize| f64::min(a[i], b[i]) > self.high[i] || f64::max(a[i], b[i]) < self.low[i];
        if beside(0) || beside(1) {
            return 0.0;
        }
        let (mut start, mut end) = (0.0f64, 1.0f64);
        for i in 0..2 {
            let d = b[i] - a[i];
            if d.abs() < 1e-9 {
                if a[i] < self.low[i] || a[i] > self.high[i] {
                    return 0.0;
                }
                continue;
            }
            let (p, q) = ((self.low[i] - a[i]) / d, (self.high[i] - a[i]) / d);
            start = start.max(p.min(q));
            end = end.min(p.max(q));
        }
        if end <= start {
            0.0
        } else {
            (end - start) * apart(b, a)
        }
    }
}

/// What a line through the letters of a label costs.
const THROUGH: f64 = 40.0;
/// What it costs to stand so close behind another label that both read as a product.
const AS_ONE: f64 = 5.0;
/// What it costs to be led over the point of another label.
const MISLED: f64 = 60.0;
/// Rounds in which every label may move again.
const ROUNDS: usize = 3;

/// A place a label may take.
struct Place {
    room: Room,
    /// What it costs by itself.
    own: f64,
    /// With what it covers, once that was looked at.
    whole: Option<f64>,
}

/// One room per wish.
pub fn place(wishes: &[Wish], walls: &[(Pair, Pair, f64)], kept: &[Room]) -> Vec<Room> {
    let places = |wish| {
        let all = candidates(wish).into_iter();
        let mut all: Vec<Place> = all
            .map(|(room, own)| Place {
                own: own
                    + if misleads(wish, &room, wishes) {
                        MISLED
                    } else {
                        0.0
                    },
                room,
                whole: None,
            })
            .collect();
        all.sort_by(|a, b| a.own.total_cmp(&b.own));
        all
    };
    let mut places: Vec<Vec<Place>> = wishes.iter().map(places).collect();
    let mut taken: Vec<Option<Room>> = vec![None; wishes.len()];
    for _ in 0..ROUNDS {
        for (i, mine) in places.iter_mut().enumerate() {
            let others = taken.iter().enumerate().filter(|(j, _)| *j != i);
            let others: Vec<Room> = others.filter_map(|(_, room)| *room).collect();
            let mut best: Option<(Room, f64)> = None;
            for place in mine {
                let beaten = |cost: f64| best.is_some_and(|(_, least)| cost >= least);
                // What is covered only adds to it.
                if beaten(place.own) {
                    break;
                }
                let covers = || place.own + covered(&place.room, walls, kept);
                let cost = *place.whole.get_or_insert_with(covers);
                if beaten(cost) {
                    continue;
                }
                let wide = place.room.grown(1.5);
                let shared: f64 = others.iter().map(|other| wide.overlap(other)).sum();
                let total = cost
                    + match shared > 0.0 {
                        true => 400.0 + shared,
                        false if others.iter().any(|other| reads_on(&wide, other)) => AS_ONE,
                        false => 0.0,
                    };
                if !beaten(total) {
                    best = Some((place.room, total));
                }
            }
            taken[i] = best.map(|(room, _)| room);
        }
    }
    let mut done: Vec<Room> = Vec::new();
    for (wish, room) in wishes.iter().zip(taken) {
        let mut room = room.unwrap_or_else(|| boxed(wish, [0.0, 0.0]));
        // Last resort, so that labels never cover each other: step down past whatever is there.
        while let Some(other) = done.iter().find(|b| b.overlap(&room) > 0.0) {
            let by = room.high[1] - other.low[1] + 1.0;
            // So far out that doubles no longer tell places apart, no step helps.
            if !by.is_finite() || room.high[1] - by == room.high[1] {
                break;
            }
            room.low[1] -= by;
            room.high[1] -= by;
        }
        done.push(room);
    }
    done
}

/// Whether the line from a label to its point passes over the point of another: it would be read as leading there.
fn misleads(wish: &Wish, room: &Room, all: &[Wish]) -> bool {
    let point = |wish: &Wish| match wish.spot {
        Spot::Point { at, .. } => Some(at),
        Spot::Along { .. } | Spot::Inside { .. } => None,
    };
    let (Some(own), Some([from, to])) = (point(wish), leader(wish, room)) else {
        return false;
    };
    let mut others = all.iter().filter_map(point).filter(|at| *at != own);
    others.any(|at| distance(at, from, to) < 4.0)
}

/// Whether a label stands on the line of another one, less than a space from it.
fn reads_on(room: &Room, other: &Room) -> bool {
    let between = |[a, b]: [&Room; 2]| b.low[0] - a.high[0];
    let gap = between([room, other]).max(between([other, room]));
    let level = (room.middle()[1] - other.middle()[1]).abs();
    gap < 4.0 && level < 0.5 * room.extent()[1].min(other.extent()[1])
}

/// A thin line from a label to its point, where it had to go far.
pub fn leader(wish: &Wish, room: &Room) -> Option<[Pair; 2]> {
    let (at, reach) = match wish.spot {
        Spot::Point { at, reach, .. } => (at, reach),
        // From an arrow or dimension line, not from its very ends.
        Spot::Along { from, to } => {
            let middle = room.middle();
            let d = minus(to, from);
            let t = dot(minus(middle, from), d) / dot(d, d).max(1e-9);
            let t = t.clamp(0.15, 0.85);
            (ahead(from, d, t), 0.0)
        }
        Spot::Inside { .. } => return None,
    };
    let nearest = [
        at[0].clamp(room.low[0], room.high[0]),
        at[1].clamp(room.low[1], room.high[1]),
    ];
    let d = minus(nearest, at);
    let far = size(d);
    (far > reach + 16.0).then(|| {
        let start = (reach + 2.0) / far;
        let stop = 1.0 - 2.0 / far;
        [ahead(at, d, start), ahead(at, d, stop)]
    })
}

fn boxed(wish: &Wish, middle: Pair) -> Room {
    let half = times(extent(&wish.label, wish.size), 0.5);
    Room {
        low: minus(middle, half),
        high: plus(middle, half),
    }
}

fn covered(room: &Room, walls: &[(Pair, Pair, f64)], kept: &[Room]) -> f64 {
    let wide = room.grown(1.5);
    let crossed: f64 = walls
        .iter()
        .map(|(a, b, weight)| {
            let length = wide.crossed(*a, *b);
            if length > 0.0 {
                // A line through the letters is worse than one beside them.
                let through = room.crossed(*a, *b) > 2.0;
                weight * (6.0 + length) + if through { THROUGH } else { 0.0 }
            } else {
                0.0
            }
        })
        .sum();
    let shared: f64 = kept
        .iter()
        .map(|b| {
            let area = wide.overlap(b);
            if area > 0.0 { 20.0 + area } else { 0.0 }
        })
        .sum();
    crossed + shared
}

fn candidates(wish: &Wish) -> Vec<(Room, f64)> {
    let mut out = Vec::new();
    let [w, h] = extent(&wish.label, wish.size);
    let ring = |out: &mut Vec<(Room, f64)>, at: Pair, toward: Pair, reach: f64, extra: f64| {
        for (round, gap) in [1.5, 5.0, 10.0, 16.0, 24.0, 34.0, 46.0, 60.0, 80.0, 105.0]
            .into_iter()
            .enumerate()
        {
            for k in 0..24 {
                let (s, c) = (std::f64::consts::PI * f64::from(k) / 12.0).sin_cos();
                // Least distance of the middle at which the box clears the circle of radius reach + gap.
                let clear = reach + gap;
                let step = f64::min(
                    (w / 2.0 + clear) / c.abs().max(1e-9),
                    (h / 2.0 + clear) / s.abs().max(1e-9),
                );
                let middle = ahead(at, [c, s], step);
                let turned = if size(toward) > 0.0 {
                    4.0 * (1.0 - dot([c, s], toward) / size(toward))
                } else {
                    // Above and to the right is where people look first.
                    0.6 * (1.0 - (0.8 * c + 0.6 * s))
                };
                out.push((
                    boxed(wish, middle),
                    extra + turned + 2.2 * round as f64 + 0.05 * gap,
                ));
            }
        }
    };
    match wish.spot {
        Spot::Point { at, toward, reach } => ring(&mut out, at, toward, reach, 0.0),
        Spot::Inside { at, radius } => {
            ring(&mut out, at, [0.0, 0.0], radius, 8.0);
            for (x, y) in [
                (0.0, 0.0),
                (0.0, -0.5),
                (0.0, 0.5),
                (-0.5, 0.0),
                (0.5, 0.0),
                (0.45, -0.45),
                (-0.45, -0.45),
                (-0.45, 0.45),
                (0.45, 0.45),
            ] {
                let middle = ahead(at, [x, y], radius);
                let corner = size([x * radius, y * radius]) + size([w, h]) / 2.0;
                if corner < radius + 2.0 {
                    out.push((boxed(wish, middle), size([x, y])));
                }
            }
        }
        Spot::Along { from, to } => {
            let d = minus(to, from);
            let normal = times(left(d), 1.0 / size(d).max(1e-9));
            for (rank, t) in [0.5, 0.62, 0.38, 0.75, 0.25, 0.9, 0.1, 1.0]
                .into_iter()
                .enumerate()
            {
                for (round, gap) in [2.5, 6.0, 11.0, 18.0].into_iter().enumerate() {
                    for side in [1.0, -1.0] {
                        let n = times(normal, side);
                        let support = n[0].abs() * w / 2.0 + n[1].abs() * h / 2.0 + gap;
                        let middle = ahead(ahead(from, d, t), n, support);
                        let above = if n[1] + 0.3 * n[0] > 0.0 { 0.0 } else { 0.3 };
                        out.push((
                            boxed(wish, middle),
                            rank as f64 * 0.7 + 2.0 * round as f64 + above,
                        ));
                    }
                }
            }
            ring(&mut out, to, d, 3.0, 5.0);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_of_one_point_do_not_cover_each_other() {
        let wish = |text: &str| Wish {
            label: Label::words(text),
            size: 16.0,
            spot: Spot::point([0.0, 0.0], [0.0, 0.0], 3.0),
        };
        let wishes: Vec<Wish> = (0..40)
            .map(|i| wish(&format!("a long label {i}")))
            .collect();
        let rooms = place(&wishes, &[], &[]);
        for (i, a) in rooms.iter().enumerate() {
            assert!(rooms[..i].iter().all(|b| a.overlap(b) == 0.0), "label {i}");
        }
    }

    #[test]
    fn two_labels_do_not_read_as_a_product() {
        let wish = |text: &str, x: f64| Wish {
            label: Label::words(text),
            size: 16.0,
            spot: Spot::point([x, 0.0], [0.0, 1.0], 3.0),
        };
        let rooms = place(&[wish("2l", 0.0), wish("ω⁻", 18.0)], &[], &[]);
        assert!(!reads_on(&rooms[0].grown(1.5), &rooms[1]), "{rooms:?}");
    }

    #[test]
    fn a_label_keeps_off_a_line() {
        let wish = Wish {
            label: Label::words("x"),
            size: 16.0,
            spot: Spot::point([0.0, 0.0], [1.0, 0.0], 3.0),
        };
        let line = ([0.0, 0.0], [50.0, 0.0], 3.0);
        let rooms = place(&[wish], &[line], &[]);
        assert_eq!(rooms[0].crossed(line.0, line.1), 0.0);
    }
}
