//! Where things are: positions given by names, coordinates and steps, followed through one another.
//!
//! In: positions as written. Out: coordinates as expressions. Circles, over-long chains and sums are faults; a center of
//! mass may come from the parts of a composite, or from where a particle is touched.

use super::Body;
use super::body::Solid;
use super::body_file::{BodyFile, ShapeName};
use super::claim::Claim;
use super::fault::Fault;
use super::formulas::Quantity;
use super::geometry;
use super::geometry::origin;
use super::place_file::{AxisName, DirectionFile, PositionFile, StepFile};
use super::record::Text;
use super::record::entries;
use super::resolver::{Place, Resolver};
use crate::expr::{Expr, Node, Vector};

/// Longest chain of positions that refer to one another.
const CHAIN: usize = 200;
/// Most terms of a coordinate.
const TERMS: usize = 500;

impl<'f> Resolver<'f> {
    pub fn point(&mut self, i: usize) -> Option<Vector> {
        let (name, position) = &self.file.points.as_ref()?.0[i];
        match &self.point_places[i] {
            Place::Done(at) => return at.clone(),
            Place::Underway => return self.circle(name),
            Place::Untouched => {}
        }
        self.point_places[i] = Place::Underway;
        let at = position
            .as_ref()
            .and_then(|p| self.link(name, |this| this.position(p)));
        self.point_places[i] = Place::Done(at.clone());
        at
    }

    /// Center of mass of a body.
    pub fn center(&mut self, i: usize) -> Option<Vector> {
        let (name, body) = &self.file.bodies.0[i];
        match &self.body_places[i] {
            Place::Done(at) => return at.clone(),
            Place::Underway => return self.circle(name),
            Place::Untouched => {}
        }
        self.body_places[i] = Place::Underway;
        let body = body.as_ref();
        let at = body.and_then(|body| match (&body.center, body.shape) {
            (Some(center), ShapeName::Composite) => {
                let message = "the center of a composite follows from its parts";
                let hint = "leave `center` out, and give each part its own";
                self.refuse(center.span(), message, hint)
            }
            (Some(center), _) => self.link(name, |this| this.position(center)),
            (None, ShapeName::Composite) => self.link(name, |this| this.composite(i)),
            (None, ShapeName::Fixed | ShapeName::Particle) => Some(origin()),
            (None, _) => self.without_center(name, body),
        });
        self.body_places[i] = Place::Done(at.clone());
        at
    }

    fn without_center(&mut self, name: &Text, body: &BodyFile) -> Option<Vector> {
        let fault = Fault::new(body.span, "the field `center` is missing").shown_at(name.span);
        fault
            .hint("the position of its center of mass: a point's name, [x, y] or {\"from\": …}")
            .add_to(&mut self.faults)
    }

    fn composite(&mut self, i: usize) -> Option<Vector> {
        let body = self.file.bodies.0[i].1.as_ref()?;
        let mut parts = Vec::new();
        for (name, part) in entries(body.parts.as_ref()) {
            let center = match &part.center {
                Some(center) => self.position(center),
                None => self.without_center(name, part),
            };
            let angle = part.angle.as_ref().map(|a| self.read(a, Quantity::ANGLE));
            let solid = self.solids().read_part(part);
            parts.push((|| {
                let Solid {
                    shape,
                    mass,
                    inertia,
                    inertia_given,
                } = solid?;
                Some(Body {
                    name: name.text.clone(),
                    shape,
                    mass,
                    inertia,
                    inertia_given,
                    center: center?,
                    angle: angle.unwrap_or_else(|| Some(Expr::zero()))?,
                    velocity: origin(),
                    spin: Expr::zero(),
                })
            })());
        }
        let parts = parts.into_iter().collect::<Option<Vec<_>>>()?;
        let (solid, center) = self.solids().join(body, parts)?;
        self.composites.insert(i, solid);
        Some(center)
    }

    /// Follows one reference further, within the bound on chains.
    fn link<T>(&mut self, name: &Text, f: impl FnOnce(&mut Self) -> Option<T>) -> Option<T> {
        if self.chain.len() >= CHAIN {
            let message = format!("positions refer to one another more than {CHAIN} deep");
            return Fault::new(name.span, message).add_to(&mut self.faults);
        }
        self.chain.push(name.text.clone());
        let out = f(self);
        self.chain.pop();
        out
    }

    fn circle(&mut self, name: &Text) -> Option<Vector> {
        let start = self.chain.iter().position(|n| *n == name.text).unwrap_or(0);
        let mut round = self.chain[start..].join(" → ");
        round.push_str(&format!(" → {}", name.text));
        let message = format!("positions refer to one another in a circle: {round}");
        let hint = "give one of them coordinates";
        self.refuse(name.span, message, hint)
    }

    /// A position.
    pub fn position(&mut self, position: &PositionFile) -> Option<Vector> {
        match position {
            PositionFile::Name(name) => {
                if let Some(i) = self.points.get(name.text.as_str()).copied() {
                    self.point(i)
                } else if let Some(i) = self.bodies.get(name.text.as_str()).copied() {
                    self.center(i)
                } else {
                    self.unknown(name, "point or body", Self::positions);
                    None
                }
            }
            PositionFile::At(pair) => self.vector(pair, Quantity::LENGTH),
            PositionFile::From(step) => {
                let from = self.position(&step.from);
                let by = self.step(step);
                let (from, by) = (from?, by?);
                let at = [&from[0] + &by[0], &from[1] + &by[1]];
                if at.iter().any(|c| terms(c) > TERMS) {
                    let message = format!("a coordinate here is a sum of more than {TERMS} terms");
                    let hint = "measure from a nearer point";
                    return self.refuse(step.span, message, hint);
                }
                Some(at)
            }
        }
    }

    /// The body by whose center of mass a position is given, at once or in steps.
    pub fn named_body<'p>(&self, position: &'p PositionFile) -> Option<(&'p Text, usize)> {
        match position {
            PositionFile::Name(name) => {
                let is_point = self.points.contains_key(name.text.as_str());
                let body = self.bodies.get(name.text.as_str()).filter(|_| !is_point);
                Some((name, *body?))
            }
            PositionFile::At(_) => None,
            PositionFile::From(step) => self.named_body(&step.from),
        }
    }

    fn step(&mut self, step: &StepFile) -> Option<Vector> {
        match (&step.distance, &step.angle, &step.by) {
            (Some(distance), Some(angle), None) => {
                let distance = self.read(distance, Quantity::LENGTH);
                let angle = self.read(angle, Quantity::ANGLE);
                let [x, y] = geometry::direction(&angle?);
                let distance = distance?;
                Some([&distance * &x, &distance * &y])
            }
            (None, None, Some(by)) => self.vector(by, Quantity::LENGTH),
            _ => {
                let message = "a step has either `distance` and `angle`, or `by`";
                let hint = "{\"from\": \"A\", \"distance\": \"l\", \"angle\": \"theta\"} or {\"from\": \"A\", \"by\": [\"l\", \"0\"]}";
                self.refuse(step.span, message, hint)
            }
        }
    }

    /// A direction, claimed to be a unit vector.
    pub fn direction(&mut self, direction: &DirectionFile) -> Option<Vector> {
        match direction {
            DirectionFile::Axis(axis) => {
                let [x, y] = match axis {
                    AxisName::Right => [1, 0],
                    AxisName::Left => [-1, 0],
                    AxisName::Up => [0, 1],
                    AxisName::Down => [0, -1],
                };
                Some([Expr::from(x), Expr::from(y)])
            }
            DirectionFile::Components(pair) => {
                let vector = self.vector(pair, Quantity::DIRECTION)?;
                self.claim(pair.span, Claim::Unit(vector.clone()));
                Some(vector)
            }
            DirectionFile::Angle(angle) => self
                .read(&angle.angle, Quantity::ANGLE)
                .map(|a| geometry::direction(&a)),
        }
    }
}

/// Number of terms of a sum.
fn terms(e: &Expr) -> usize {
    match e.node() {
        Node::Sum(terms) => terms.len(),
        _ => 1,
    }
}
