//! The equations of an impact with one set of supports acting, and whether that set fits.

use nalgebra::{DMatrix, DVector};

use super::super::{Course, Lost};
use super::{ROUNDING, Support, Table};
use crate::expr::arithmetic::{cross, dot};
use crate::numeric::float::solve_f64;
use crate::numeric::friction::{at_corner, happened, settle};
use crate::numeric::given::{Freedom, Given, GivenContact, GivenImpulse, GivenLaw, Joint};
use crate::numeric::least::{Found, NoSolution, solve};
use crate::numeric::path::Event;
use crate::numeric::system::{Law, System, Unknown, assemble, motion_of};
use crate::scene::Mode;

/// The equations with one set of supports, solved.
pub(super) struct Tried {
    pub set: Vec<usize>,
    pub system: System<f64>,
    pub given: Given<f64>,
    pub found: Found,
    /// What a contact with friction does; its impulse is known in `given`.
    pub mode: Option<Mode>,
    /// The same up to each corner of its path.
    pub way: Vec<Tried>,
}

impl Table<'_> {
    /// Solves the equations with these supports acting.
    pub(super) fn tried(&self, course: &Course<'_>, mut set: Vec<usize>) -> Result<Tried, Lost> {
        set.retain(|i| self.kept_supports.contains(i));
        let mut given = self.given.clone();
        given.contacts.extend(set.iter().map(|i| {
            let s = &self.supports[*i];
            GivenContact {
                joint: Joint {
                    bodies: s.bodies,
                    at: s.at,
                },
                normal: Some(s.normal),
                law: GivenLaw::Frictionless(0.0),
            }
        }));
        // With these supports acting throughout, friction is followed along the path of its impulse; what that comes to takes
        // the place of the law.
        let settled = settle(&given, solve_f64)
            .map_err(|why| course.contradiction(format!("friction leads to no motion: {why}")))?;
        let Some((known, followed)) = settled else {
            return self.solved(course, set, given);
        };
        let mode = Some(happened(&given, &followed));
        let corners = followed.path.corners.iter();
        let way = corners
            .filter(|corner| matches!(corner.event, Event::SlipEnds | Event::Compressed))
            .map(|corner| {
                let there = at_corner(&given, followed.contact, corner);
                self.solved(course, set.clone(), there)
            })
            .collect::<Result<Vec<Tried>, Lost>>()?;
        let end = self.solved(course, set, known)?;
        Ok(Tried { mode, way, ..end })
    }

    /// Solves the equations of these numbers.
    fn solved(
        &self,
        course: &Course<'_>,
        set: Vec<usize>,
        given: Given<f64>,
    ) -> Result<Tried, Lost> {
        let system = assemble(&given);
        let (m, n) = (system.laws.len(), system.unknowns.len());
        let mut matrix = DMatrix::zeros(m, n + self.loose.len());
        for row in 0..m {
            for (column, value) in system.row(row).iter().enumerate() {
                matrix[(row, column)] = *value;
            }
        }
        for (j, (body, k)) in self.loose.iter().enumerate() {
            let unit = assemble(&only(&given, *body, *k));
            for row in 0..m {
                matrix[(row, n + j)] = -unit.right[row];
            }
        }
        match solve(&matrix, &DVector::from_row_slice(&system.right)) {
            Ok(found) => Ok(Tried {
                set,
                system,
                given,
                found,
                mode: None,
                way: Vec::new(),
            }),
            Err(NoSolution::OutOfRange) => {
                Err(course.out_of_reach("the equations of the impact go beyond the doubles"))
            }
            Err(NoSolution::Contradiction(rows)) => {
                let laws = rows
                    .iter()
                    .map(|r| self.words(course, &set, system.laws[*r]));
                let laws: Vec<String> = laws.collect();
                Err(course.contradiction(format!(
                    "no motion after satisfies all laws; {} cannot hold with the others",
                    laws.join(" and ")
                )))
            }
        }
    }

    /// A law in words.
    fn words(&self, course: &Course<'_>, set: &[usize], law: Law) -> String {
        let body = |b: usize| &course.solids[b].name;
        let contact = |c: usize| match self.kept[0].get(c) {
            Some(i) => &course.stage.scene.contacts[*i].name,
            None => &self.one_sided[set[c - self.kept[0].len()]].name,
        };
        match law {
            Law::Momentum(b, _) => format!("momentum of `{}`", body(b)),
            Law::AngularMomentum(b) => format!("angular momentum of `{}`", body(b)),
            Law::Hinge(h, _) => {
                format!(
                    "the hinge `{}`",
                    course.stage.scene.hinges[self.kept[1][h]].name
                )
            }
            Law::Sticking(c, _) => format!("sticking at `{}`", contact(c)),
            Law::Restitution(c) => format!("restitution at `{}`", contact(c)),
            Law::Condition(c, _) => format!("friction at `{}`", contact(c)),
            Law::Known(k) => format!("known value {}", k + 1),
        }
    }

    /// Whether the supports in the set act and the others let go, from the first to the last; `None` where that is not
    /// determined.
    pub(super) fn fits(&self, tried: &Tried) -> Option<bool> {
        let mut sure = true;
        let largest = tried.impulses().map(f64::abs).fold(self.momentum, f64::max);
        let ways = tried.way.iter().chain([tried]);
        for i in &self.kept_supports {
            if let Some(place) = tried.set.iter().position(|k| k == i) {
                let unknown = Unknown::ContactNormal(self.kept[0].len() + place);
                let column = tried.column(unknown)?;
                if !tried.found.is_unique(column) {
                    sure = false;
                    continue;
                }
                let pushes: Vec<f64> = ways.clone().map(|way| way.found.values[column]).collect();
                let grows = |pair: &[f64]| pair[1] - pair[0] >= -ROUNDING * largest;
                let all = [&[0.0], pushes.as_slice()].concat();
                // A support that touches and does nothing: the smaller set says the same.
                if !all.windows(2).all(grows) || tried.found.values[column] <= ROUNDING * largest {
                    return Some(false);
                }
                continue;
            }
            for way in ways.clone() {
                match self.lets_go(way, *i) {
                    Some(false) => return Some(false),
                    None => sure = false,
                    Some(true) => {}
                }
            }
        }
        sure.then_some(true)
    }

    /// Whether the bodies do not approach at a support; `None` where that is not determined.
    fn lets_go(&self, tried: &Tried, support: usize) -> Option<bool> {
        let (terms, constant) = tried.opening(&self.supports[support]);
        let products = terms.iter().map(|(k, f)| f * tried.found.values[*k]);
        let size = products
            .clone()
            .map(f64::abs)
            .fold(self.speed.max(constant.abs()), f64::max);
        let determined = tried.found.determines(&terms);
        determined.then(|| constant + products.sum::<f64>() >= -ROUNDING * size)
    }
}

impl Tried {
    pub(super) fn column(&self, unknown: Unknown) -> Option<usize> {
        self.system.column(unknown)
    }

    /// The velocity of the second body against the first along the normal: factors of unknowns, and what is prescribed.
    fn opening(&self, support: &Support) -> (Vec<(usize, f64)>, f64) {
        let (mut terms, mut constant) = (Vec::new(), 0.0);
        for (b, sign) in [(support.bodies[1], 1.0), (support.bodies[0], -1.0)] {
            let body = &self.given.bodies[b];
            let n = support.normal.map(|n| sign * n);
            if body.freedom == Freedom::Fixed {
                constant += dot(&n, &body.velocity_before(&support.at));
                continue;
            }
            let lever = cross(&body.arm(&support.at), &n);
            for (unknown, factor) in motion_of(b).into_iter().zip([n[0], n[1], lever]) {
                terms.extend(self.column(unknown).map(|c| (c, factor)));
            }
        }
        (terms, constant)
    }

    pub(super) fn impulses(&self) -> impl Iterator<Item = f64> {
        self.picked(|u| !matches!(u, Unknown::Velocity(..) | Unknown::Spin(_)))
    }

    pub(super) fn speeds(&self) -> impl Iterator<Item = f64> {
        let all = self.picked(|u| matches!(u, Unknown::Velocity(..)));
        all.map(f64::abs)
    }

    fn picked(&self, is_wanted: impl Fn(&Unknown) -> bool) -> impl Iterator<Item = f64> {
        let pairs = self.system.unknowns.iter().zip(&self.found.values);
        pairs.filter(move |(u, _)| is_wanted(u)).map(|(_, v)| *v)
    }
}

/// The same scene at rest and without impulses but for one component of velocity, which is 1.
fn only(given: &Given<f64>, body: usize, component: usize) -> Given<f64> {
    let mut out = given.clone();
    for (b, other) in out.bodies.iter_mut().enumerate() {
        let is = |k: usize| f64::from(u8::from(b == body && k == component));
        (other.velocity, other.spin) = ([is(0), is(1)], is(2));
    }
    for blow in &mut out.blows {
        if let GivenImpulse::Whole(p) = &mut blow.impulse {
            *p = [0.0; 2];
        }
    }
    out.known.iter_mut().for_each(|k| k.value = 0.0);
    out
}
