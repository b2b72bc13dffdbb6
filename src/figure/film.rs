//! What a film shows beside the stages of a scene: how the bodies come to the first impact, and how they go on after the last.
//!
//! In: a scene, and what somebody takes for right. Out: places of the bodies at moments. No forces are known there, so every
//! body keeps its velocity and spin; what turns about a resting point of a support goes on about it, what moves as one
//! stays together, and what hangs by a joint on another body stays on it. The motion itself is that of [`crate::numeric::follow()`].

use super::motion::{stand_in, surroundings};
use super::plane::{Pair, ahead, cross, dot, left, minus, plus, size, times, turned};
use super::pose::{Pose, posed};
use super::sheet::{Ink, Sheet};
use super::stage::spanning;
use super::values::{Values, fits, representative};
use crate::expr::Point;
use crate::numeric::follow::{self, Followed, Passed, Solid, State, What};
use crate::numeric::given::Freedom;
use crate::scene::{Ask, Scene, Stage};

/// Moments of a part, its beginning aside.
const STEPS: u32 = 12;
/// How far a body goes in a part at most, against the size of the picture, and how far it turns \[rad\].
const FAR: [f64; 2] = [0.6, 0.9];
/// Relative difference that rounding may make.
const ROUNDING: f64 = 1e-9;

/// What a value is multiplied by to see whether more stages come to their ends.
const OTHERS: [f64; 6] = [2.0, 0.5, 4.0, 0.25, 8.0, 0.125];

/// Time in a part \[s\] and, for every body of the scene, x and y of its center \[m\] and its angle \[rad\].
pub type Moment = (f64, Vec<[f64; 3]>);

/// The parts of a film that no stage tells; each is empty where it is not known or nothing moves.
#[derive(Clone, Debug, Default)]
pub struct Film {
    /// Up to the first impact.
    pub before: Vec<Moment>,
    /// From the last impact on.
    pub after: Vec<Moment>,
    /// The same, with a quantity as somebody takes it to be.
    pub claimed: Vec<Moment>,
    /// What stands still where bodies are met or held, as lines through points \[m\].
    pub standing: Vec<Vec<Pair>>,
    /// Strings that are taut in a stage.
    pub strings: Vec<Taut>,
}

/// A piece of string that is taut in a stage.
#[derive(Clone, Debug)]
pub struct Taut {
    /// Index of the stage.
    pub stage: usize,
    /// Its two ends.
    pub ends: [End; 2],
}

/// Where a string ends.
#[derive(Clone, Debug)]
pub struct End {
    /// The body that carries it along, by index; `None` where it stays.
    pub body: Option<usize>,
    /// Where it is \[m\]: from the center of that body, in its frame where it turns with it.
    pub at: Pair,
    /// Whether it turns with the body; the string leaves the rim of a pulley in the same direction all the time.
    pub turns: bool,
}

/// Values a scene is shown at: those given, and for the others some at which its bodies touch and approach each other, and
/// at which as many of its stages as are found come to their ends in a possible way.
pub fn shown_at(scene: &Scene) -> Point<f64> {
    let mut shown = representative(scene).point;
    let told = |point: &Point<f64>| {
        let followed = follow::follow(scene, point);
        let is_told = |s: &&Result<Passed, _>| s.as_ref().is_ok_and(Passed::is_possible);
        followed.map_or(0, |f| f.stages.iter().filter(is_told).count())
    };
    let mut most = if scene.stages.is_empty() {
        0
    } else {
        told(&shown)
    };
    let directions = scene.domains.unit_vectors.as_flattened();
    let free = scene.parameters.iter().filter(|p| p.value.is_none());
    let free = free.filter(|p| !directions.contains(&p.name));
    for (parameter, factor) in free.flat_map(|p| OTHERS.map(|factor| (p, factor))) {
        if most == scene.stages.len() {
            break;
        }
        let mut trial = shown.clone();
        if let Some(value) = trial.values.get_mut(&parameter.name) {
            *value *= factor;
        }
        if fits(scene, parameter, &trial) && told(&trial) > most {
            (most, shown) = (told(&trial), trial);
        }
    }
    shown
}

/// The film of a scene at the values it is drawn at. `claim` is the name of a question about the last impact, and the value of
/// its answer in SI units as somebody has it.
pub fn film(scene: &Scene, claim: Option<(&str, [f64; 2])>) -> Film {
    let values = Values {
        point: shown_at(scene),
    };
    let Ok(followed) = follow::follow(scene, &values.point) else {
        return Film::default();
    };
    let course = scene.course();
    // Up to the first stage that does not get to its end.
    let told = followed.stages.iter().map_while(|s| s.as_ref().ok());
    let told: Vec<&Passed> = told.collect();
    let Some(poses) = posed(scene, &values) else {
        return Film::default();
    };
    let impact = |k: usize| match told.get(k) {
        Some(passed) if matches!(passed.what, What::Impact(_)) => Some((*passed, &course[k])),
        _ => None,
    };
    let (first, last) = (impact(0), impact(course.len().wrapping_sub(1)));
    let before = first.and_then(|(passed, stage)| {
        Going::new(
            &followed,
            &passed.before,
            joints(stage, &values, &passed.before),
        )
    });
    let after = last.and_then(|(passed, stage)| {
        Going::new(
            &followed,
            &passed.after,
            joints(stage, &values, &passed.after),
        )
    });
    let claimed = after
        .as_ref()
        .zip(claim)
        .and_then(|(after, (name, value))| {
            let asked = scene.question(name)?;
            let of_last = asked
                .stage
                .is_none_or(|stage| stage + 1 == scene.stages.len());
            of_last
                .then(|| after.claimed(&asked.ask, value, &values))
                .flatten()
        });
    let stages = told.iter().copied().zip(course.iter()).enumerate();
    let drawn = stages.filter_map(|(k, stage)| drawn(k, stage, &values, &poses));
    let drawn: Vec<_> = drawn.collect();
    let all: Vec<&Going> = [&before, &after, &claimed].into_iter().flatten().collect();
    let time = seconds(&all, &poses);
    let shown = |going: &Option<Going>, from: f64| {
        let going = going.as_ref().filter(|g| g.fastest() != [0.0, 0.0]);
        going.map_or_else(Vec::new, |g| g.moments(from, time))
    };
    Film {
        before: shown(&before, -time),
        after: shown(&after, 0.0),
        claimed: shown(&claimed, 0.0),
        standing: drawn.iter().flat_map(|d| d.0.clone()).collect(),
        strings: drawn.into_iter().flat_map(|d| d.1).collect(),
    }
}

/// What stands still in a stage and the strings that are taut in it, drawn to a scale that has room for `all`.
fn drawn(
    index: usize,
    (passed, stage): (&Passed, &Stage),
    values: &Values,
    all: &[Pose],
) -> Option<(Vec<Vec<Pair>>, Vec<Taut>)> {
    let scene = match passed.what {
        What::Impact(_) => stage.scene.clone(),
        What::Motion(_) => stand_in(&stage.scene, &stage.kind),
    };
    let [begin, end] = [&passed.before, &passed.after].map(|s| placed(stage, values, s));
    let (poses, last) = (posed(&scene, &begin)?, posed(&scene, &end)?);
    let canvas = spanning(&scene, &begin, poses.clone(), all)?;
    let mut sheet = Sheet::default();
    let body = stage.kind.moved().first().copied().unwrap_or(0);
    surroundings(&canvas, &mut sheet, &stage.kind, &poses[body], &last[body])?;
    let strands = canvas.strands(&stage.kind, &poses)?;
    for strand in &strands {
        canvas.strand(&mut sheet, strand, false);
    }
    let place = |line: Vec<Pair>| line.into_iter().map(|p| canvas.place(p)).collect();
    let standing = sheet.lines(Ink::Ground).into_iter().map(place).collect();
    let end = |(body, at): (Option<usize>, Pair)| match body {
        None => End {
            body,
            at,
            turns: false,
        },
        Some(b) => {
            let (arm, turns) = (
                minus(at, poses[b].center),
                scene.bodies[b].shape.radius().is_none(),
            );
            let at = if turns {
                turned(arm, -poses[b].angle)
            } else {
                arm
            };
            End { body, at, turns }
        }
    };
    let strings = strands.into_iter().chain(canvas.tied()).map(|strand| Taut {
        stage: index,
        ends: strand.ends.map(end),
    });
    Some((standing, strings.collect()))
}

/// Bodies that keep their velocities and spins.
#[derive(Clone)]
struct Going<'f> {
    solids: &'f [Solid],
    /// Place, angle, velocity and spin, by body.
    bodies: Vec<[f64; 6]>,
    joined: Vec<[usize; 2]>,
    joints: Vec<Joint>,
}

/// Two bodies, by index, and the place where they are joined or meet.
type Joint = ([usize; 2], Pair);

/// The values of a stage, with the bodies where they are then.
fn placed(stage: &Stage, values: &Values, state: &State) -> Values {
    Values {
        point: follow::at_places(stage, state, &values.point),
    }
}

/// Where bodies are joined or meet, as far as that has a place.
fn joints(stage: &Stage, values: &Values, state: &State) -> Vec<Joint> {
    let values = placed(stage, values, state);
    let scene = &stage.scene;
    let hinges = scene.hinges.iter().map(|h| (h.bodies, &h.at));
    let contacts = scene.contacts.iter().map(|c| (c.bodies, &c.at));
    let all = hinges.chain(contacts);
    all.filter_map(|(bodies, at)| Some((bodies, values.pair(at)?)))
        .collect()
}

/// How long a part lasts, so that it stays about where the bodies are.
fn seconds(all: &[&Going], poses: &[Pose]) -> f64 {
    let points: Vec<Pair> = poses.iter().flat_map(Pose::outline).collect();
    let span = |k: usize| {
        let each = || points.iter().map(|p| p[k]);
        each().fold(f64::MIN, f64::max) - each().fold(f64::MAX, f64::min)
    };
    let wide = match points.is_empty() {
        true => 0.0,
        false => size([span(0), span(1)]),
    };
    // Particles that meet have no size of their own.
    let wide = if wide > 1e-6 { wide } else { 1.0 };
    let mut time = f64::MAX;
    for going in all {
        let [speed, spin] = going.fastest();
        for (rate, far) in [(speed, FAR[0] * wide), (spin, FAR[1])] {
            if rate > 0.0 {
                time = time.min(far / rate);
            }
        }
    }
    time
}

impl<'f> Going<'f> {
    fn new(followed: &'f Followed, state: &State, joints: Vec<Joint>) -> Option<Going<'f>> {
        let known = |b: &follow::BodyState| {
            let mut out = [0.0; 6];
            for (out, component) in out.iter_mut().zip(b.components()) {
                *out = *component.as_ref().ok()?;
            }
            Some(out)
        };
        Some(Going {
            solids: &followed.solids,
            bodies: state.bodies.iter().map(known).collect::<Option<_>>()?,
            joined: state.joined.clone(),
            joints,
        })
    }

    fn is_fixed(&self, body: usize) -> bool {
        self.solids[body].freedom == Freedom::Fixed
    }

    /// Largest speed and largest spin.
    fn fastest(&self) -> [f64; 2] {
        let free = (0..self.bodies.len()).filter(|b| !self.is_fixed(*b));
        free.fold([0.0, 0.0], |[speed, spin], b| {
            let b = self.bodies[b];
            [
                f64::max(speed, size([b[3], b[4]])),
                f64::max(spin, b[5].abs()),
            ]
        })
    }

    /// Velocity of the point of a body that is somewhere now.
    fn velocity(&self, body: usize, at: Pair) -> Pair {
        let [x, y, _, u, v, spin] = self.bodies[body];
        ahead([u, v], left(minus(at, [x, y])), spin)
    }

    fn is_nothing(&self, v: Pair) -> bool {
        let [speed, _] = self.fastest();
        size(v) <= ROUNDING * speed
    }

    /// The point of a support about which a body turns.
    fn pivot(&self, body: usize) -> Option<Pair> {
        let turns = self.bodies[body][5] != 0.0;
        let held = |(bodies, _): &&Joint| turns && bodies.iter().any(|b| self.is_fixed(*b));
        let mut supports = self.joints.iter().filter(held).map(|(_, at)| *at);
        supports.find(|at| self.is_nothing(self.velocity(body, *at)))
    }

    /// For every leader the body on which it hangs, and the place of the joint; nothing where it goes by itself. What a support
    /// holds comes first, and where there is none the first body of a chain.
    fn hung(&self, leaders: &[usize]) -> Vec<Option<(usize, Pair)>> {
        let moves_as_one = |([a, b], at): &&Joint| {
            let apart = minus(self.velocity(*a, *at), self.velocity(*b, *at));
            let is_free = !self.is_fixed(*a) && !self.is_fixed(*b);
            is_free && leaders[*a] != leaders[*b] && self.is_nothing(apart)
        };
        let joints: Vec<&Joint> = self.joints.iter().filter(moves_as_one).collect();
        let mut out = vec![None; leaders.len()];
        let mut placed: Vec<bool> = (0..leaders.len())
            .map(|b| self.pivot(leaders[b]).is_some())
            .collect();
        loop {
            let next = joints.iter().find_map(|([a, b], at)| {
                let [by_a, by_b] = [*a, *b].map(|body| placed[leaders[body]]);
                match (by_a, by_b) {
                    (true, false) => Some((leaders[*b], Some((*a, *at)))),
                    (false, true) => Some((leaders[*a], Some((*b, *at)))),
                    _ => None,
                }
            });
            let first = || {
                joints
                    .iter()
                    .map(|([a, _], _)| leaders[*a])
                    .find(|l| !placed[*l])
            };
            let Some((leader, on)) = next.or_else(|| Some((first()?, None))) else {
                return out;
            };
            placed[leader] = true;
            out[leader] = on;
        }
    }

    /// For every body the one whose motion it shares; itself where it goes alone.
    fn leaders(&self) -> Vec<usize> {
        let mut leader: Vec<usize> = (0..self.bodies.len()).collect();
        let is_rigid = |b: usize| self.solids[b].freedom == Freedom::Rigid;
        for pair in &self.joined {
            let [a, b] = if is_rigid(pair[0]) {
                *pair
            } else {
                [pair[1], pair[0]]
            };
            let [x, y, _, u, v, spin] = self.bodies[b];
            let [own_u, own_v] = self.velocity(a, [x, y]);
            let same_spin =
                !is_rigid(b) || (spin - self.bodies[a][5]).abs() <= ROUNDING * spin.abs();
            if same_spin && self.is_nothing([u - own_u, v - own_v]) {
                let (of_a, of_b) = (leader[a], leader[b]);
                for l in leader.iter_mut().filter(|l| **l == of_b) {
                    *l = of_a;
                }
            }
        }
        leader
    }

    /// The bodies in time, from a moment on.
    fn moments(&self, from: f64, long: f64) -> Vec<Moment> {
        let leaders = self.leaders();
        let hung = self.hung(&leaders);
        let each = (0..=STEPS).map(|k| {
            let elapsed = long * f64::from(k) / f64::from(STEPS);
            let place = |b| self.place(b, &leaders, &hung, from + elapsed);
            (elapsed, (0..self.bodies.len()).map(place).collect())
        });
        each.collect()
    }

    /// Where a body is after a time.
    fn place(
        &self,
        body: usize,
        leaders: &[usize],
        hung: &[Option<(usize, Pair)>],
        time: f64,
    ) -> [f64; 3] {
        let [x, y, angle, ..] = self.bodies[body];
        if self.is_fixed(body) {
            return [x, y, angle];
        }
        let leader = leaders[body];
        let by = self.bodies[leader][5] * time;
        if let Some((other, joint)) = hung[leader] {
            let [from_x, from_y, from, ..] = self.bodies[other];
            let [to_x, to_y, to] = self.place(other, leaders, hung, time);
            let arm = turned(minus(joint, [from_x, from_y]), to - from);
            let joint_then = plus([to_x, to_y], arm);
            let [x, y] = plus(joint_then, turned(minus([x, y], joint), by));
            return [x, y, angle + by];
        }
        let (about, shift) = match self.pivot(leader) {
            Some(pivot) => (pivot, [0.0, 0.0]),
            None => {
                let group = (0..leaders.len()).filter(|b| leaders[*b] == leader);
                let mut sums = [0.0; 5];
                for b in group {
                    let mass = self.solids[b].mass;
                    let [x, y, _, u, v, _] = self.bodies[b];
                    for (sum, c) in sums.iter_mut().zip([1.0, x, y, u, v]) {
                        *sum += mass * c;
                    }
                }
                let [mass, rest @ ..] = sums;
                let [x, y, _, u, v, _] = self.bodies[leader];
                let [x, y, u, v] = match mass > 0.0 {
                    true => rest.map(|sum| sum / mass),
                    false => [x, y, u, v],
                };
                ([x, y], [u * time, v * time])
            }
        };
        let arm = turned(minus([x, y], about), by);
        let [x, y] = plus(plus(about, arm), shift);
        [x, y, angle + by]
    }

    /// The same with a velocity or spin as somebody has it. What turns about a support still does; else the rest of the
    /// motion stays as it is. `None` where the question is about something else.
    fn claimed(&self, ask: &Ask, value: [f64; 2], values: &Values) -> Option<Going<'f>> {
        let mut out = self.clone();
        let (Ask::Spin { body, .. } | Ask::Velocity { body, .. }) = ask else {
            return None;
        };
        let pivot = self.pivot(*body);
        let [x, y, _, u, v, spin] = self.bodies[*body];
        let own = &mut out.bodies[*body];
        match ask {
            Ask::Spin { clockwise, .. } => own[5] = if *clockwise { -value[0] } else { value[0] },
            Ask::Velocity { point, along, .. } => {
                let at = match point {
                    Some((_, at)) => values.pair(at)?,
                    None => [x, y],
                };
                let now = self.velocity(*body, at);
                let more = match along {
                    Some(along) => {
                        let along = values.pair(along)?;
                        times(along, value[0] - dot(now, along))
                    }
                    None => minus(value, now),
                };
                match pivot {
                    // Only the part across the arm is left to it.
                    Some(p) => {
                        let arm = minus(at, p);
                        own[5] = spin + cross(arm, more) / dot(arm, arm);
                    }
                    None => [own[3], own[4]] = [u + more[0], v + more[1]],
                }
            }
            _ => return None,
        }
        if let Some(p) = pivot {
            [own[3], own[4]] = times(left(minus([x, y], p)), own[5]);
        }
        own.iter().all(|c| c.is_finite()).then_some(out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shipped(name: &str) -> Scene {
        let path = format!("{}/derivations/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).expect("a shipped scene");
        crate::scene::read(&text).expect("a scene")
    }

    /// Where the lower end C of the falling stick is, from the place of the bar.
    fn foot(place: [f64; 3], length: f64) -> Pair {
        let [x, y, angle] = place;
        [
            x - angle.cos() * length / 2.0,
            y - angle.sin() * length / 2.0,
        ]
    }

    #[test]
    fn a_stick_comes_straight_down_and_then_turns_about_the_end_that_sticks() {
        let scene = shipped("book/falling-stick");
        let at = |name: &str| representative(&scene).point.values[name];
        let length = at("l");
        let film = film(&scene, Some(("omega", [at("v") / length, 0.0])));
        let bar = |part: &[Moment]| part.iter().map(|(_, all)| all[1]).collect::<Vec<_>>();
        let before = bar(&film.before);
        assert!(
            before
                .windows(2)
                .all(|two| two[0][2] == two[1][2] && two[0][1] > two[1][1])
        );
        for part in [&film.after, &film.claimed] {
            assert!(
                bar(part)
                    .iter()
                    .all(|place| size(foot(*place, length)) < 1e-12)
            );
        }
        let turned = |part: &[Moment]| part[part.len() - 1].1[1][2] - part[0].1[1][2];
        let spin = -turned(&film.claimed) / film.claimed[film.claimed.len() - 1].0;
        assert!(
            (spin - at("v") / length).abs() < 1e-12,
            "clockwise, as it is asked"
        );
        let right = 1.5 * at("v") * at("theta").cos() / length;
        assert!(
            (turned(&film.after) / turned(&film.claimed) - right * length / at("v")).abs() < 1e-12
        );
    }

    #[test]
    fn bodies_that_stick_together_stay_together() {
        let scene = shipped("more/bullet-swings-a-rod");
        let mut alone = scene.course()[0].scene.clone();
        alone.domains = scene.domains.clone();
        let film = film(&alone, None);
        let apart = |(_, all): &Moment| size([all[2][0] - all[1][0], all[2][1] - all[1][1]]);
        let first = apart(&film.after[0]);
        assert!(film.after.iter().all(|m| (apart(m) - first).abs() < 1e-12));
        assert!(film.after[12].1[1] != film.after[0].1[1]);
    }

    #[test]
    fn hinged_rods_stay_on_their_hinge() {
        let film = film(&shipped("more/toggle-hits-stop"), None);
        let end = |[x, y, angle]: [f64; 3], to: f64| plus([x, y], turned([to, 0.0], angle));
        // Half a rod is 0.25 m long; the rods are the second and the third body.
        let apart = |all: &[[f64; 3]]| size(minus(end(all[1], 0.25), end(all[2], -0.25)));
        let all = film.before.iter().chain(&film.after);
        assert!(all.clone().count() > 20);
        assert!(all.clone().all(|(_, places)| apart(places) < 1e-12));
        assert!(film.before[0].1[2] != film.before[12].1[2]);
    }

    #[test]
    fn a_question_about_something_else_has_no_motion_of_its_own() {
        let scene = shipped("book/falling-stick");
        assert!(
            film(&scene, Some(("E_lost", [1.0, 0.0])))
                .claimed
                .is_empty()
        );
    }

    #[test]
    fn a_scene_is_shown_where_its_stages_come_to_their_ends() {
        for name in ["more/ball-bounces", "more/ballistic-pendulum"] {
            let scene = shipped(name);
            let ends = |point: &Point<f64>| {
                let followed = follow::follow(&scene, point).expect("it is followed");
                followed.stages.iter().all(Result::is_ok)
            };
            assert!(
                !ends(&representative(&scene).point),
                "{name}: another scene"
            );
            assert!(ends(&shown_at(&scene)), "{name}");
        }
    }
}
