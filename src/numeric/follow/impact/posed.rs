//! An impact put into numbers: what acts on whom, which components are open, and the sizes that rounding is measured by.

use super::super::{BodyState, Course, Lost, State};
use super::{ROUNDING, Support, Table, norm};
use crate::expr::arithmetic::difference;
use crate::numeric::given::{Freedom, GivenBody, GivenImpulse, around};
use crate::scene::{OneSided, Scene};

impl<'a> Table<'a> {
    /// The table of an impact that begins with this state.
    pub(super) fn of(
        course: &Course<'_>,
        one_sided: &'a [OneSided],
        before: &State,
    ) -> Result<Table<'a>, Lost> {
        let scene = &course.stage.scene;
        let links = links(scene, one_sided);
        let (touched, unplaced) = reached(course, &links, before);
        let keeps = |bodies: &[usize]| bodies.iter().all(|b| !unplaced[*b]);
        let mut part = Scene {
            bodies: scene.bodies.clone(),
            ..Scene::default()
        };
        let mut kept = [Vec::new(), Vec::new(), Vec::new()];
        (kept[0], part.contacts) = picked(&scene.contacts, |c| keeps(&c.bodies));
        (kept[1], part.hinges) = picked(&scene.hinges, |h| keeps(&h.bodies));
        (kept[2], part.blows) = picked(&scene.blows, |b| keeps(&[b.body]));
        (_, part.after) = picked(&scene.after, |k| keeps(&[k.body]));
        let bodies: Vec<GivenBody<f64>> = before
            .bodies
            .iter()
            .zip(course.solids)
            .map(|(body, solid)| body.given(solid))
            .collect();
        let given = around(&part, bodies, course.values).map_err(|u| course.undefined(u))?;
        let mut supports = Vec::new();
        for o in one_sided {
            let is_placed = keeps(&o.bodies);
            let pair = |v, what: &str| match is_placed {
                true => course.pair(v, &format!("{what} of {}", o.name)),
                false => Ok([0.0; 2]),
            };
            supports.push(Support {
                bodies: o.bodies,
                at: pair(&o.at, "position")?,
                normal: pair(&o.normal, "normal")?,
            });
        }
        let kept_supports = (0..one_sided.len())
            .filter(|i| keeps(&one_sided[*i].bodies))
            .collect();
        let mut loose = Vec::new();
        for (b, body) in before.bodies.iter().enumerate() {
            let all = [&body.velocity[0], &body.velocity[1], &body.spin];
            let open = (0..3).filter(|k| all[*k].is_err() && touched[b] && !unplaced[b]);
            loose.extend(open.map(|k| (b, k)));
        }
        let rubs = part.friction().is_some();
        if rubs && !loose.is_empty() {
            return Err(course.out_of_reach("friction is followed from a motion that is known"));
        }
        let mut table = Table {
            given,
            one_sided,
            supports,
            kept,
            kept_supports,
            touched,
            unplaced,
            loose,
            speed: before.fastest,
            momentum: 0.0,
            arm: 0.0,
        };
        table.measure();
        Ok(table)
    }

    /// Finds the sizes that rounding is measured by.
    fn measure(&mut self) {
        let earlier = self.speed;
        let joints = self.given.hinges.iter();
        let joints = joints.chain(self.given.contacts.iter().map(|c| &c.joint));
        let places: Vec<([usize; 2], [f64; 2])> = joints
            .map(|j| (j.bodies, j.at))
            .chain(self.supports.iter().map(|s| (s.bodies, s.at)))
            .chain(self.given.blows.iter().map(|b| ([b.body; 2], b.at)))
            .collect();
        for (b, body) in self.given.bodies.iter().enumerate() {
            if !self.touched[b] || self.unplaced[b] {
                continue;
            }
            let arms = places.iter().filter(|(bodies, _)| bodies.contains(&b));
            let arm = arms.map(|(_, at)| norm(&body.arm(at))).fold(0.0, f64::max);
            let speed = norm(&body.velocity) + body.spin.abs() * arm;
            self.arm = self.arm.max(arm);
            self.speed = self.speed.max(speed);
            if body.freedom != Freedom::Fixed {
                // What was brought to rest before has rounding left of its momentum then.
                self.momentum = self.momentum.max(body.mass * speed.max(earlier));
            }
        }
        for blow in &self.given.blows {
            if let GivenImpulse::Whole(p) = &blow.impulse {
                let (p, mass) = (norm(p), self.given.bodies[blow.body].mass);
                self.momentum = self.momentum.max(p);
                self.speed = self.speed.max(if mass > 0.0 { p / mass } else { 0.0 });
            }
        }
    }

    /// Bodies joined by a hinge move alike there before.
    pub(super) fn hinges_fit(&self, course: &Course<'_>) -> Result<(), Lost> {
        for (hinge, i) in self.given.hinges.iter().zip(&self.kept[1]) {
            if hinge
                .bodies
                .iter()
                .any(|b| self.loose.iter().any(|l| l.0 == *b))
            {
                continue;
            }
            let [one, two] = hinge
                .bodies
                .map(|b| self.given.bodies[b].velocity_before(&hinge.at));
            if norm(&difference(&one, &two)) > ROUNDING * self.speed {
                let [first, second] = hinge.bodies.map(|b| &course.solids[b].name);
                return Err(course.contradiction(format!(
                    "`{first}` and `{second}` move differently at the hinge `{}` before",
                    course.stage.scene.hinges[*i].name
                )));
            }
        }
        Ok(())
    }
}

/// What is kept, with its places in the list.
fn picked<T: Clone>(all: &[T], keeps: impl Fn(&T) -> bool) -> (Vec<usize>, Vec<T>) {
    let kept = all.iter().enumerate().filter(|(_, one)| keeps(one));
    kept.map(|(i, one)| (i, one.clone())).unzip()
}

/// Bodies that touch, in pairs; a blow or a known value touches its body alone.
fn links(scene: &Scene, one_sided: &[OneSided]) -> Vec<[usize; 2]> {
    let known = scene.after.iter().map(|k| [k.body; 2]);
    let all = scene.acting().map(|one| one.bodies).chain(known);
    all.chain(one_sided.iter().map(|o| o.bodies)).collect()
}

/// Of each body whether the impact touches it, and whether it or a body joined to it has no place.
fn reached(course: &Course<'_>, links: &[[usize; 2]], before: &State) -> (Vec<bool>, Vec<bool>) {
    let n = course.solids.len();
    let mut touched = vec![false; n];
    links.iter().flatten().for_each(|b| touched[*b] = true);
    let is_unplaced = |b: usize| {
        let body: &BodyState = &before.bodies[b];
        let without_center = body.center.iter().any(Result::is_err);
        match course.solids[b].freedom {
            // A particle has no arms.
            Freedom::Particle => false,
            Freedom::Rigid => without_center,
            Freedom::Fixed => {
                let is_turning = body.spin != Ok(0.0);
                body.velocity.iter().any(Result::is_err) || (is_turning && without_center)
            }
        }
    };
    let mut unplaced: Vec<bool> = (0..n).map(|b| touched[b] && is_unplaced(b)).collect();
    for _ in 0..n {
        for [a, b] in links {
            let spreads = |from: usize, to: usize, all: &[bool]| {
                all[from] && course.solids[to].freedom != Freedom::Fixed
            };
            if spreads(*a, *b, &unplaced) {
                unplaced[*b] = true;
            }
            if spreads(*b, *a, &unplaced) {
                unplaced[*a] = true;
            }
        }
    }
    (touched, unplaced)
}
