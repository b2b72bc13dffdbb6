//! What does not move: ground, walls, stops, edges, posts, wheels, bars, the supports of hinges, and strings.
//!
//! In: a scene on stage. Out: lines on the sheet. What stands at a point is the author's word; without it, it follows from the
//! normal, from where the body lies and from where it comes.

use super::fixture::{edge, hatched, peg, spring, stop, support, wheel};
use super::place::Room;
use super::plane::{
    Pair, ahead, apart, cross, dot, left, minus, opposite, right, size, times, unit,
};
use super::pose::{Look, Pose};
use super::sheet::{Ink, Line, Sheet};
use super::stage::{DOT, PEG, Stage, THICK};
use crate::expr::Vector;
use crate::scene::{Body, Slide, Support};

impl Stage<'_> {
    /// Draws what does not move, and the strings.
    pub fn fixed(&self, sheet: &mut Sheet) {
        let hints = &self.scene.figure;
        let is_fixed = |i: usize| self.scene.bodies.get(i).is_some_and(Body::is_fixed);
        for strand in self.tied() {
            self.strand(sheet, &strand, false);
        }
        let strings = |name: &str| hints.string(name).is_some();
        for contact in self.scene.contacts.iter().filter(|c| !strings(&c.name)) {
            let (other, sign) = match contact.bodies {
                [a, b] if is_fixed(a) => (b, 1.0),
                [a, b] if is_fixed(b) => (a, -1.0),
                _ => continue,
            };
            if let Some(at) = self.values.pair(&contact.at) {
                let normal = contact.normal.as_ref().and_then(|n| self.values.pair(n));
                let normal = normal.map(|n| times(n, sign));
                self.standing(sheet, &contact.name, at, normal, other);
            }
        }
        for hinge in &self.scene.hinges {
            let [a, b] = hinge.bodies;
            let other = if is_fixed(a) { b } else { a };
            if !is_fixed(a) && !is_fixed(b) {
                continue;
            }
            let (Some(at), Some(pose)) = (self.values.pair(&hinge.at), self.poses.get(other))
            else {
                continue;
            };
            // Where a string is fastened, its ceiling is drawn already.
            let ends = hints.strings.iter().filter_map(|(name, end)| {
                let shown = self.scene.bodies.iter().any(|b| b.name == *name);
                end.as_ref().filter(|_| shown)
            });
            let near = |end: &Vector| {
                let [p, q] = [self.spot(end), Some(self.px(at))];
                p.zip(q).is_some_and(|(p, q)| apart(p, q) < 2.0)
            };
            if ends.into_iter().any(near) {
                continue;
            }
            if hints.support(&hinge.name).is_some() {
                self.standing(sheet, &hinge.name, at, None, other);
                continue;
            }
            let d = minus(at, pose.center);
            let away = if size(d) < 1e-9 {
                [0.0, -1.0]
            } else if d[0].abs() > d[1].abs() {
                [d[0].signum(), 0.0]
            } else {
                [0.0, d[1].signum()]
            };
            support(sheet, self.px(at), away);
        }
        self.axles(sheet);
        self.springs(sheet);
        self.ground(sheet);
    }

    /// The supports of pulleys whose axles no hinge here stands for.
    fn axles(&self, sheet: &mut Sheet) {
        for p in &self.scene.axles {
            let mut hinges = self.scene.hinges.iter();
            if hinges.any(|h| h.bodies.contains(p)) {
                continue;
            }
            if let Some(pose) = self.poses.get(*p) {
                let at = self.px(pose.center);
                support(sheet, at, [0.0, -1.0]);
                // Its bracket stands before the pulley; what else crosses it is no body.
                sheet.grounds.pop();
                sheet.circle(at, 3.6, Line::of(Ink::Body));
            }
        }
    }

    /// The springs under bodies on which their force acts.
    fn springs(&self, sheet: &mut Sheet) {
        for force in &self.scene.forces {
            for at in self.scene.figure.springs(&force.name) {
                if let Some(at) = self.values.pair(at) {
                    spring(sheet, self.touch(force.body, at, [0.0, 1.0]), [0.0, -1.0]);
                }
            }
        }
    }

    /// The spring along a line: ahead of a body at its end, or behind one at its beginning that it pushes on.
    pub(super) fn pressed(
        &self,
        sheet: &mut Sheet,
        slide: &Slide,
        [from, end]: [&Pose; 2],
    ) -> Option<()> {
        let relaxed = self.values.of(&slide.spring.as_ref()?.relaxed)?;
        let along = unit(self.values.pair(&slide.along)?);
        let (pose, way) = match relaxed > 0.0 {
            true => (from, opposite(along)),
            false => (end, along),
        };
        spring(sheet, self.rim(pose, pose.center, opposite(way)), way);
        Some(())
    }

    /// The level ground, where the author gives its height.
    fn ground(&self, sheet: &mut Sheet) {
        let height = self.scene.figure.ground.as_ref();
        let Some(height) = height.and_then(|h| self.values.of(h)) else {
            return;
        };
        let points: Vec<Pair> = self.poses.iter().flat_map(Pose::outline).collect();
        let points: Vec<Pair> = points.into_iter().map(|p| self.px(p)).collect();
        if let Some(room) = Room::of(&points) {
            let y = self.px([0.0, height])[1] - 0.8;
            let (low, high) = (room.low[0] - 26.0, room.high[0] + 40.0);
            hatched(sheet, [low, y], [high, y], [0.0, -1.0]);
        }
    }

    /// The surface below a body that moves along a line from one place to another.
    pub(super) fn surface(&self, sheet: &mut Sheet, from: &Pose, end: &Pose, along: Pair) {
        let way = if along[0] < 0.0 { -1.0 } else { 1.0 };
        let down = [way * along[1], -way * along[0]];
        let ends = [(from, -40.0), (end, 40.0)].map(|(pose, more)| {
            let foot = self.foot(pose, down);
            let more = self.clear(from, foot, along, more);
            ahead(foot, along, more)
        });
        match way > 0.0 {
            true => hatched(sheet, ends[0], ends[1], down),
            false => hatched(sheet, ends[1], ends[0], down),
        }
    }

    /// Where a body stands on a surface, on the sheet.
    pub(super) fn foot(&self, pose: &Pose, down: Pair) -> Pair {
        let center = self.px(pose.center);
        let outline = pose.outline().into_iter().map(|p| self.px(p));
        let below = outline.map(|p| dot(minus(p, center), down));
        ahead(center, down, below.fold(DOT, f64::max) + 0.8)
    }

    /// How far a surface goes on from a foot of a body, in pixels: it ends before a wheel in its way.
    fn clear(&self, body: &Pose, foot: Pair, along: Pair, more: f64) -> f64 {
        let way = times(along, more.signum());
        let mut far = more.abs();
        for pose in self.poses.iter().filter(|p| p.center != body.center) {
            if let Look::Round { radius, .. } = &pose.look {
                let (center, r) = (self.px(pose.center), self.long(*radius));
                let to = minus(center, foot);
                let (off, reach) = (cross(to, way), dot(to, way));
                if off.abs() < r && reach > 0.0 {
                    far = far.min((reach - (r * r - off * off).sqrt() - 3.0).max(0.0));
                }
            }
        }
        far * more.signum()
    }

    /// Floors and walls that the free ends of rods keep to: an end that moves along x or along y. Each rod is given at its
    /// beginning and at its end.
    pub(super) fn guides(&self, sheet: &mut Sheet, rods: &[[&Pose; 2]]) {
        let ends = |[from, to]: &[&Pose; 2]| from.ends().zip(to.ends());
        // By the axis that is kept and the place on it: from where to where along the other axis, and on which side the rods are.
        let mut all: Vec<(usize, [f64; 3], f64)> = Vec::new();
        for (i, rod) in rods.iter().enumerate() {
            let Some((begins, stops)) = ends(rod) else {
                continue;
            };
            for (a, b) in begins.into_iter().zip(stops) {
                let near = |p: Pair, q: Pair| apart(p, q) < 1e-9;
                let joined = (rods.iter().enumerate()).any(|(j, other)| {
                    j != i && ends(other).is_some_and(|(ends, _)| ends.iter().any(|e| near(*e, a)))
                });
                let kept = [0, 1].map(|k| (a[k] - b[k]).abs() < 1e-9);
                let k = match kept {
                    [true, false] if !joined => 0,
                    [false, true] if !joined => 1,
                    _ => continue,
                };
                let side = (rod[0].center[k] + rod[1].center[k]) / 2.0 - a[k];
                let [at, p, q] = [a[k], a[1 - k], b[1 - k]];
                match all
                    .iter_mut()
                    .find(|g| g.0 == k && (g.1[0] - at).abs() < 1e-9)
                {
                    Some((_, [_, low, high], _)) => {
                        (*low, *high) = (low.min(p.min(q)), high.max(p.max(q)));
                    }
                    None => all.push((k, [at, p.min(q), p.max(q)], side)),
                }
            }
        }
        for (k, [at, low, high], side) in &all {
            let out = if *side < 0.0 { 1.0 } else { -1.0 };
            let point = |along: f64, more: f64| {
                let mut p = [0.0; 2];
                (p[*k], p[1 - k]) = (*at, along);
                let mut p = self.px(p);
                p[*k] += out * (THICK / 2.0 + 0.8);
                p[1 - k] += more;
                p
            };
            let mut ends = [point(*low, -26.0), point(*high, 26.0)];
            // A floor ends at the wall, and a wall on the floor.
            for (_, [level, ..], side) in all.iter().filter(|g| g.0 != *k) {
                let corner = point(*level, -side.signum() * (THICK / 2.0 + 0.8));
                ends[usize::from(*side < 0.0)] = corner;
            }
            let mut back = [0.0; 2];
            back[*k] = out;
            hatched(sheet, ends[0], ends[1], back);
        }
    }

    /// A slack string: as long as it is at the end of a fall that makes it taut, it hangs between its end and the body.
    pub(super) fn slack(&self, sheet: &mut Sheet, end: &Vector, from: Pair, taut: Pair) {
        const PIECES: usize = 24;
        let Some(top) = self.spot(end) else {
            return;
        };
        let (body, length) = (self.px(from), {
            let p = self.px(taut);
            apart(p, top)
        });
        let hanging = |sag: f64| -> Vec<Pair> {
            let each = (0..=PIECES).map(|k| {
                let t = k as f64 / PIECES as f64;
                let line = |axis: usize| top[axis] + t * (body[axis] - top[axis]);
                [line(0), line(1) - 4.0 * sag * t * (1.0 - t)]
            });
            each.collect()
        };
        let long = |points: &[Pair]| -> f64 {
            let each = points.windows(2);
            each.map(|p| apart(p[1], p[0])).sum()
        };
        let (mut low, mut high) = (0.0, length);
        if long(&hanging(low)) >= length {
            return;
        }
        for _ in 0..40 {
            let middle = (low + high) / 2.0;
            match long(&hanging(middle)) < length {
                true => low = middle,
                false => high = middle,
            }
        }
        sheet.path(hanging(low), false, Line::dashed(Ink::Body), 1.0);
        sheet.segment(top, self.px(taut), Line::thin(Ink::Body), 1.0);
        hatched(
            sheet,
            [top[0] + 18.0, top[1]],
            [top[0] - 18.0, top[1]],
            [0.0, 1.0],
        );
    }

    /// What stands where a body is touched, and which way it faces.
    fn standing(
        &self,
        sheet: &mut Sheet,
        name: &str,
        at: Pair,
        normal: Option<Pair>,
        other: usize,
    ) {
        let faces = normal.or_else(|| self.upright(other, at));
        let hint = self.scene.figure.support(name);
        let kind = hint.unwrap_or_else(|| match faces {
            Some(n) => self.usual(other, at, n),
            None => Support::Bar,
        });
        let hit = self.hit(other, at).filter(|v| size(*v) > 1e-9);
        let hit = hit.map(unit);
        match kind {
            Support::Wall => self.wall(sheet, at, faces.unwrap_or([-1.0, 0.0]), other),
            Support::Floor => self.wall(sheet, at, [0.0, 1.0], other),
            Support::Stop => {
                let way = hit.map_or(1.0, |v| if v[0] < 0.0 { -1.0 } else { 1.0 });
                stop(sheet, self.px(at), way);
            }
            Support::Edge => {
                let n = faces.unwrap_or([0.0, 1.0]);
                let center = self.poses[other].center;
                let along = right(n);
                let out = dot(minus(at, center), along);
                edge(sheet, self.touch(other, at, n), n, out.signum());
            }
            Support::Post => {
                let n = faces.unwrap_or([0.0, 1.0]);
                support(sheet, self.touch(other, at, n), opposite(n));
            }
            Support::Wheel => {
                let n = faces.unwrap_or([0.0, 1.0]);
                wheel(sheet, self.touch(other, at, n), n);
            }
            Support::Bar => {
                // A bar touches the body from the side the body comes from.
                let n = normal.or(hit.map(opposite)).unwrap_or([0.0, 0.0]);
                let foot = self.touch(other, at, n);
                peg(sheet, ahead(foot, n, -PEG));
            }
        }
    }

    /// What usually stands where a body is touched: under a body that lies along it a post, or an edge at its end.
    fn usual(&self, other: usize, at: Pair, n: Pair) -> Support {
        let points = self.poses[other].outline();
        let part = |axis: Pair| {
            let each = points.iter().map(move |p| dot(minus(*p, at), axis));
            let low = each.clone().fold(0.0, f64::min);
            (low, each.fold(0.0, f64::max))
        };
        let (low, high) = part(right(n));
        let (below, above) = part(n);
        let long = high - low;
        if long < 1e-9 || above.max(-below) > 0.1 * long {
            return Support::Wall;
        }
        match high.min(-low) < 0.05 * long {
            true => Support::Edge,
            false => Support::Post,
        }
    }

    /// The place on a body's outline next to what faces it with the normal `n`.
    fn touch(&self, other: usize, at: Pair, n: Pair) -> Pair {
        self.rim(&self.poses[other], at, n)
    }

    fn rim(&self, pose: &Pose, at: Pair, n: Pair) -> Pair {
        let thick = match &pose.look {
            Look::Bar(_) if pose.skin.is_empty() => THICK + 0.8,
            Look::Dot | Look::Parts(_) => DOT + 0.8,
            _ => 0.8,
        };
        let far = self.long(pose.reach(at, opposite(n))) + thick;
        let at = self.px(at);
        ahead(at, n, -far)
    }

    /// Velocity just before of a body's point.
    fn hit(&self, body: usize, at: Pair) -> Option<Pair> {
        let center = self.poses.get(body)?.center;
        let r = minus(at, center);
        let v = self.values.pair(&self.scene.bodies[body].velocity)?;
        let spin = self.values.of(&self.scene.bodies[body].spin)?;
        Some(ahead(v, left(r), spin))
    }

    /// Which way a wall faces that a body hits without a stated normal; `None` for a peg.
    fn upright(&self, other: usize, at: Pair) -> Option<Pair> {
        let pose = self.poses.get(other)?;
        let r = minus(pose.center, at);
        let hit = self.hit(other, at)?;
        if let Look::Blob(_) = pose.look {
            return (size(r) > 1e-9).then(|| unit(r));
        }
        if let Look::Dot = pose.look {
            return (size(hit) > 1e-9).then(|| opposite(unit(hit)));
        }
        let points = pose.outline();
        let span = points.iter().map(|p| apart(*p, at)).fold(0.0, f64::max);
        [[0.0, 1.0], [1.0, 0.0], [-1.0, 0.0], [0.0, -1.0]]
            .into_iter()
            .filter(|n| {
                let heights = || points.iter().map(|p| dot(minus(*p, at), *n));
                heights().all(|h| h > -1e-6 * span)
                    && heights().fold(0.0, f64::max) > 0.15 * span
                    && dot(hit, *n) < -1e-9
            })
            .min_by(|a, b| dot(hit, *a).total_cmp(&dot(hit, *b)))
    }

    fn wall(&self, sheet: &mut Sheet, at: Pair, n: Pair, other: usize) {
        let along = right(n);
        let at = match &self.poses[other].look {
            _ if self.poses[other].lies_along(at, n) => {
                let [x, y] = self.px(at);
                let far = THICK + 0.8;
                [x - far * n[0], y - far * n[1]]
            }
            Look::Bar(_) | Look::Dot | Look::Parts(_) => self.px(at),
            _ => self.touch(other, at, n),
        };
        let (mut low, mut high) = (-42.0f64, 42.0f64);
        for p in self.poses.get(other).map(Pose::outline).unwrap_or_default() {
            let q = self.px(p);
            let t = dot(minus(q, at), along);
            low = low.min(t - 14.0);
            high = high.max(t + 14.0);
        }
        let spot = |t: f64| ahead(at, along, t);
        hatched(sheet, spot(low), spot(high), opposite(n));
    }
}
