//! Strings: between what each piece runs, and how it is drawn.
//!
//! In: a scene on stage, a motion, the bodies where they are. Out: taut pieces in meters, each end with the body that carries it
//! along; lines on the sheet.

use super::fixture::hatched;
use super::plane::{Pair, ahead, cross, dot, left, minus, times, unit};
use super::pose::{Look, Pose};
use super::sheet::{Ink, Line, Sheet};
use super::stage::{DOT, Stage};
use crate::scene::{Body, Slide, StageKind};

/// Length of a string that is fastened nobody knows where, in pixels.
const STRING: f64 = 66.0;

/// A taut piece of string.
pub(super) struct Strand {
    /// Its ends \[m\], each with the body that carries it along.
    pub ends: [(Option<usize>, Pair); 2],
    /// Half the length of the ceiling that its second end is fastened to, in pixels; 0 where there is none.
    ceiling: f64,
}

impl Strand {
    fn between(one: (Option<usize>, Pair), two: (Option<usize>, Pair)) -> Strand {
        Strand {
            ends: [one, two],
            ceiling: 0.0,
        }
    }
}

impl Stage<'_> {
    /// Draws a piece of string, broken where it is only on its way.
    pub(super) fn strand(&self, sheet: &mut Sheet, strand: &Strand, is_broken: bool) {
        let [from, to] = strand.ends.map(|(_, p)| self.px(p));
        let line = Line {
            width: 1.1,
            ..Line::of(Ink::Body)
        };
        let line = if is_broken {
            Line::dashed(Ink::Body)
        } else {
            line
        };
        sheet.segment(from, to, line, 2.0);
        if strand.ceiling > 0.0 && !is_broken {
            let up = if to[1] >= from[1] { 1.0 } else { -1.0 };
            let end = |side: f64| [to[0] + side * up * strand.ceiling, to[1]];
            hatched(sheet, end(1.0), end(-1.0), [0.0, up]);
        }
    }

    /// The strings of contacts and bodies, as the author has them: to where they are fastened, or from body to body.
    pub(super) fn tied(&self) -> Vec<Strand> {
        let hints = &self.scene.figure;
        let is_fixed = |b: usize| self.scene.bodies.get(b).is_none_or(Body::is_fixed);
        let mut out = Vec::new();
        for contact in &self.scene.contacts {
            let (Some(end), Some(at)) =
                (hints.string(&contact.name), self.values.pair(&contact.at))
            else {
                continue;
            };
            let [a, b] = contact.bodies;
            if !is_fixed(a) && !is_fixed(b) {
                // It is tied to a particle, and to where it leaves a body with an outline, such as a pulley.
                let tied = |i: usize| match self.scene.bodies[i].is_particle() {
                    true => (Some(i), self.poses[i].center),
                    false => (Some(i), at),
                };
                out.push(Strand::between(tied(a), tied(b)));
                continue;
            }
            let normal = contact.normal.as_ref().and_then(|n| self.values.pair(n));
            let (other, sign) = if is_fixed(a) { (b, 1.0) } else { (a, -1.0) };
            let normal = normal.map_or([0.0, 1.0], |n| times(n, sign));
            out.push(self.hung(
                other,
                at,
                end.as_ref().and_then(|e| self.values.pair(e)),
                normal,
            ));
        }
        for (b, body) in self.scene.bodies.iter().enumerate() {
            if let Some(end) = hints.string(&body.name) {
                let end = end.as_ref().and_then(|e| self.values.pair(e));
                let at = end.map_or(self.poses[b].center, |end| leaves(&self.poses[b], end));
                out.push(self.hung(b, at, end, [0.0, 1.0]));
            }
        }
        out
    }

    /// A string from a body to where it is fastened: as given, else at a named point in its direction, else somewhere there.
    fn hung(&self, body: usize, at: Pair, end: Option<Pair>, n: Pair) -> Strand {
        let from = self.px(at);
        let is_hook = |p: &Pair| {
            let d = minus(*p, from);
            dot(d, n) > 2.0 * DOT && cross(d, n).abs() < 1.0
        };
        let mut points = self.scene.points.iter().filter_map(|p| self.spot(&p.at));
        let end = end.unwrap_or_else(|| {
            let hook = points.find(is_hook);
            self.place(hook.unwrap_or(ahead(from, n, STRING)))
        });
        Strand {
            ends: [(Some(body), at), (None, end)],
            ceiling: 18.0,
        }
    }

    /// The strings that a motion keeps taut, with the bodies where they are; `None` where something has no place.
    pub(super) fn strands(&self, kind: &StageKind, poses: &[Pose]) -> Option<Vec<Strand>> {
        let from_to = |at: Pair, body: usize| {
            vec![Strand::between(
                (None, at),
                (Some(body), poses[body].center),
            )]
        };
        Some(match kind {
            StageKind::Turn(turn) if matches!(poses.get(turn.body)?.look, Look::Dot) => {
                from_to(self.values.pair(&turn.about)?, turn.body)
            }
            StageKind::Wind(wind) => from_to(self.values.pair(&wind.around)?, wind.body),
            StageKind::Slide(slide) => self.strung(slide, poses)?,
            StageKind::Linkage(linkage) => {
                let hung = linkage.places.iter().filter_map(|(b, _)| {
                    let end = self.scene.figure.string(&self.scene.bodies[*b].name)?;
                    let end = self.values.pair(end.as_ref()?)?;
                    let from = leaves(&poses[*b], end);
                    Some(Strand::between((Some(*b), from), (None, end)))
                });
                hung.collect()
            }
            _ => Vec::new(),
        })
    }

    /// Strings over pulleys: straight from each body to the rim of its pulley, and between two pulleys.
    fn strung(&self, slide: &Slide, poses: &[Pose]) -> Option<Vec<Strand>> {
        let radius = |b: usize| self.values.of(self.scene.bodies[b].shape.radius()?);
        let mut out = Vec::new();
        for string in &slide.strings {
            let load = string.to[0];
            let hung = string.under.unwrap_or(load);
            let last = string.over[string.over.len() - 1];
            let legs = [
                (slide.body, &slide.along, string.over[0], None),
                (hung, &string.along, last, string.under),
            ];
            let mut feet = Vec::new();
            for (body, along, pulley, under) in legs {
                let along = unit(self.values.pair(along)?);
                let center = poses.get(body)?.center;
                let arm = minus(poses.get(pulley)?.center, center);
                let leg = |aside: f64| {
                    let from = ahead(center, left(along), aside);
                    let foot = ahead(from, along, dot(arm, along));
                    Strand::between((Some(body), from), (None, foot))
                };
                let Some(under) = under else {
                    out.push(leg(0.0));
                    feet.push(out[out.len() - 1].ends[1]);
                    continue;
                };
                // The parts at a movable pulley run along its rim on either side, first the one that leads to the other pulley; the
                // other is fastened.
                let (own, rim) = (radius(under)?, radius(pulley)?);
                let off = |a: f64| ((a - cross(along, arm)).abs() - rim).abs();
                let first = if off(own) <= off(-own) { own } else { -own };
                out.push(leg(first));
                feet.push(out[out.len() - 1].ends[1]);
                let ceiling = 12.0;
                out.push(Strand {
                    ceiling,
                    ..leg(-first)
                });
            }
            if string.over.len() > 1 {
                out.push(Strand::between(feet[0], feet[1]));
            }
            if hung != load {
                let end = |b: usize| Some((Some(b), poses.get(b)?.center));
                out.push(Strand::between(end(hung)?, end(load)?));
            }
        }
        Some(out)
    }
}

/// Where a string leaves a body for the place it is fastened to: the rim of a round one, where it hangs straight down beside it.
fn leaves(pose: &Pose, end: Pair) -> Pair {
    match &pose.look {
        Look::Round { radius, .. }
            if ((end[0] - pose.center[0]).abs() - radius).abs() < 1e-6 * radius =>
        {
            [end[0], pose.center[1]]
        }
        _ => pose.center,
    }
}
