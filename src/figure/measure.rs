//! Dimensions and angles: which lengths a reader needs to see, and where their lines go.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use num_traits::{One, Signed, Zero};

use super::label::Label;
use super::place::{Room, Spot};
use super::plane::{
    Pair, ahead, apart, bearing, between, left, minus, opposite, plus, polar, size, times, unit,
};
use super::pose::Look;
use super::sheet::{Ink, Line, SIZE, Sheet, arc};
use super::stage::Stage;
use super::values::Values;
use crate::dimension::Dimension;
use crate::expr::{self, Expr, Rational, Symbol, Vector};
use crate::scene::{BlowImpulse, KnownQuantity, Shape};

/// Draws the lengths and angles of a scene that its symbols name.
pub fn measure(stage: &Stage, sheet: &mut Sheet) {
    let mut shown: Vec<Expr> = Vec::new();
    shapes(stage, sheet, &mut shown);
    distances(stage, sheet, &shown);
    angles(stage, sheet);
}

/// Lengths, radii and sides that belong to shapes.
fn shapes(stage: &Stage, sheet: &mut Sheet, shown: &mut Vec<Expr>) {
    for (body, pose) in stage.scene.bodies.iter().zip(&stage.poses) {
        let text = |e: &Expr| Label::formula(e, stage.scene);
        match (&body.shape, &pose.look) {
            (Shape::Rod { length }, Look::Bar(_)) => {
                if let Some([a, b]) = pose.ends() {
                    beside(sheet, stage.px(a), stage.px(b), text(length));
                    shown.push(length.clone());
                }
            }
            (
                Shape::Disk { radius } | Shape::Ring { radius } | Shape::Sphere { radius },
                Look::Round { radius: r, .. },
            ) => {
                if shown.contains(radius) {
                    continue;
                }
                let (center, r) = (stage.px(pose.center), stage.long(*r));
                let phi = quiet(sheet, center, r);
                let edge = polar(center, r, phi);
                sheet.arrow(center, edge, Ink::Dimension, 0.9);
                sheet.wish(
                    text(radius),
                    SIZE,
                    Spot::Along {
                        from: center,
                        to: edge,
                    },
                );
                shown.push(radius.clone());
            }
            (Shape::Rectangle { width, height }, Look::Plate(..)) => {
                let c: Vec<Pair> = pose.outline().into_iter().map(|p| stage.px(p)).collect();
                outside(sheet, [c[0], c[1], c[2], c[3]], text(width));
                outside(sheet, [c[1], c[2], c[3], c[0]], text(height));
                shown.extend([width.clone(), height.clone()]);
            }
            _ => {}
        }
    }
}

/// Direction from a center in which least is drawn.
fn quiet(sheet: &Sheet, center: Pair, radius: f64) -> f64 {
    let busy = |phi: f64| {
        let room = Room::around(polar(center, 0.6 * radius, phi), 0.3 * radius);
        crowd(sheet, &room)
    };
    [135.0, 45.0, 225.0, 315.0, 110.0, 250.0]
        .into_iter()
        .map(|d: f64| d * PI / 180.0)
        .min_by(|a, b| busy(*a).total_cmp(&busy(*b)))
        .unwrap_or(0.0)
}

fn crowd(sheet: &Sheet, room: &Room) -> f64 {
    let near =
        |a: &Pair, b: &Pair| Room::of(&[*a, *b]).is_some_and(|s| s.grown(0.5).overlap(room) > 0.0);
    let lines = sheet.walls.iter().filter(|(a, b, _)| {
        let parts = 8;
        near(a, b)
            && (0..=parts).any(|k| {
                let t = f64::from(k) / f64::from(parts);
                let p = between(*a, *b, t);
                Room::around(p, 0.5).overlap(room) > 0.0
            })
    });
    lines.map(|w| w.2).sum::<f64>()
        + 2.0 * sheet.kept.iter().filter(|b| b.overlap(room) > 0.0).count() as f64
}

/// A dimension line parallel to a segment, on its emptier side, as near as it can be.
fn beside(sheet: &mut Sheet, a: Pair, b: Pair, label: Label) {
    let d = minus(b, a);
    let length = size(d);
    if length < 14.0 {
        return;
    }
    let n = unit(left(d));
    let n = if n[1] < -1e-9 || (n[1].abs() < 1e-9 && n[0] < 0.0) {
        opposite(n)
    } else {
        n
    };
    let mut best: Option<(f64, f64)> = None;
    for (rank, offset) in [24.0, -24.0, 36.0, -36.0, 48.0, -48.0, 64.0, -64.0]
        .into_iter()
        .enumerate()
    {
        let out = offset + 12.0 * f64::signum(offset);
        let mut cost = 0.8 * rank as f64;
        for k in 0..=10 {
            let t = f64::from(k) / 10.0;
            let spot = |o: f64| ahead(ahead(a, d, t), n, o);
            cost += crowd(sheet, &Room::around(spot(offset), 3.0))
                + 0.2 * crowd(sheet, &Room::around(spot(out), 4.0));
        }
        if best.is_none_or(|(least, _)| cost < least) {
            best = Some((cost, offset));
        }
    }
    let offset = best.map_or(24.0, |(_, o)| o);
    line(sheet, [a, b], times(n, offset), label);
}

/// A dimension line of one of two opposite sides of a rectangle, the emptier one.
fn outside(sheet: &mut Sheet, corners: [Pair; 4], label: Label) {
    let [a, b, c, d] = corners;
    let across = minus(a, d);
    let long = size(across).max(1e-9);
    let n = times(across, 1.0 / long * 16.0);
    let busy = |p: Pair, q: Pair, n: Pair| {
        (0..=8)
            .map(|k| {
                let t = f64::from(k) / 8.0;
                crowd(sheet, &Room::around(plus(between(p, q, t), n), 7.0))
            })
            .sum::<f64>()
    };
    // The lower or right side at equal crowding.
    let first_is_low = n[1] < -1.0 || (n[1].abs() <= 1.0 && n[0] > 0.0);
    let (first, second) = (busy(a, b, n), busy(c, d, opposite(n)));
    if first < second || (first == second && first_is_low) {
        line(sheet, [a, b], n, label);
    } else {
        line(sheet, [c, d], opposite(n), label);
    }
}

/// A dimension line from one end to the other, shifted by `offset`, with extension lines.
fn line(sheet: &mut Sheet, ends: [Pair; 2], offset: Pair, label: Label) {
    let [a, b] = ends.map(|p| plus(p, offset));
    let far = size(offset);
    if far > 1.0 {
        let u = times(offset, 1.0 / far);
        for (end, foot) in ends.iter().zip([a, b]) {
            let start = ahead(*end, u, 5.0_f64.min(far / 2.0));
            sheet.segment(start, ahead(foot, u, 3.0), Line::thin(Ink::Dimension), 1.0);
        }
    }
    let middle = between(a, b, 0.5);
    sheet.arrow(middle, a, Ink::Dimension, 0.9);
    sheet.arrow(middle, b, Ink::Dimension, 0.9);
    sheet.wish(label, SIZE, Spot::Along { from: a, to: b });
}

/// Lengths that no shape shows: between named places, along x or y.
fn distances(stage: &Stage, sheet: &mut Sheet, shown: &[Expr]) {
    let scene = stage.scene;
    let is_length = |name: &Symbol| {
        let parameter = scene.parameter(name);
        parameter.is_some_and(|p| p.dimension == Dimension::new(0, 1, 0))
    };
    let mut seen: Vec<Symbol> = shown.iter().flat_map(Expr::symbols).collect();
    let mut places: Vec<Vector> = Vec::new();
    let all = scene
        .hinges
        .iter()
        .map(|h| &h.at)
        .chain(scene.contacts.iter().map(|c| &c.at))
        .chain(scene.blows.iter().map(|b| &b.at))
        .chain(scene.points.iter().map(|p| &p.at))
        .chain(
            scene
                .bodies
                .iter()
                .filter(|b| !b.is_fixed())
                .map(|b| &b.center),
        );
    for v in all {
        if !places.contains(v) && places.len() < 24 {
            places.push(v.clone());
        }
    }
    let inner: Vec<Vector> = scene
        .bodies
        .iter()
        .flat_map(|b| match &b.shape {
            Shape::Composite { parts } => parts.iter().map(|p| p.center.clone()).collect(),
            _ => Vec::new(),
        })
        .collect();
    places.extend(inner.into_iter().take(12));
    for parameter in scene.parameters.iter().filter(|p| is_length(&p.name)) {
        if seen.contains(&parameter.name) {
            continue;
        }
        let mut best: Option<(u32, usize, usize, usize, Expr)> = None;
        for i in 0..places.len() {
            for j in i + 1..places.len() {
                let difference = expr::minus(&places[j], &places[i]);
                for axis in 0..2 {
                    let Some((factor, name)) = single(&difference[axis]) else {
                        continue;
                    };
                    if name != parameter.name {
                        continue;
                    }
                    let other = collected(&difference[1 - axis]).is_empty();
                    let cost = u32::from(!other) * 4 + u32::from(!factor.abs().is_one()) * 2;
                    if best.as_ref().is_none_or(|b| cost < b.0) {
                        let shown = Expr::from(factor.abs()) * Expr::symbol(&name);
                        best = Some((cost, i, j, axis, shown));
                    }
                }
            }
        }
        let Some((_, i, j, axis, e)) = best else {
            continue;
        };
        let (Some(p), Some(q)) = (stage.spot(&places[i]), stage.spot(&places[j])) else {
            continue;
        };
        let corner = if axis == 0 {
            [q[0], p[1]]
        } else {
            [p[0], q[1]]
        };
        let negative = stage
            .values
            .of(&Expr::symbol(&parameter.name))
            .is_some_and(|v| v < 0.0);
        let label = Label::formula(&e, scene);
        beside(
            sheet,
            p,
            corner,
            if negative { label.negated() } else { label },
        );
        seen.push(parameter.name.clone());
    }
}

/// The terms of a sum by what they multiply.
fn collected(e: &Expr) -> BTreeMap<Expr, Rational> {
    let mut terms = BTreeMap::new();
    for part in e.terms() {
        let (factor, rest) = part.split_number();
        *terms.entry(rest).or_insert_with(Rational::zero) += factor;
    }
    terms.retain(|_, k| !k.is_zero());
    terms
}

/// The number and the symbol, when the formula is no more than that.
fn single(e: &Expr) -> Option<(Rational, Symbol)> {
    let terms = collected(e);
    let (rest, factor) = terms.iter().next()?;
    if terms.len() == 1 {
        Some((factor.clone(), rest.as_symbol()?.clone()))
    } else {
        None
    }
}

/// A direction at the values a scene is drawn at.
type Direction<'a> = Box<dyn Fn(&Values) -> Option<Pair> + 'a>;

/// A direction that may make an angle with a visible line: where, and a formula for it.
struct Ray<'a> {
    at: Pair,
    direction: Direction<'a>,
    drawn: bool,
}

/// Angles: a symbol is shown where a direction turns by just that much when it goes from 0 to its value.
fn angles(stage: &Stage, sheet: &mut Sheet) {
    let rays = rays(stage);
    for parameter in stage.scene.parameters.iter().filter(|p| p.is_angle()) {
        let Some(value) = stage.values.of(&Expr::symbol(&parameter.name)) else {
            continue;
        };
        let mut flat = stage.values.clone();
        flat.point.values.insert(parameter.name.clone(), 0.0);
        for ray in &rays {
            let (Some(d), Some(d0)) = ((ray.direction)(stage.values), (ray.direction)(&flat))
            else {
                continue;
            };
            let (end, start) = (bearing(d), bearing(d0));
            let turn = (end - start + PI).rem_euclid(2.0 * PI) - PI;
            if size(d) < 1e-9
                || size(d0) < 1e-9
                || (turn.abs() - value.abs()).abs() > 1e-6
                || turn.abs() < 0.03
            {
                continue;
            }
            let reach = if turn.abs() < 0.4 { 50.0 } else { 34.0 };
            let tip = |phi: f64, r: f64| polar(ray.at, r, phi);
            sheet.segment(
                ray.at,
                tip(start, reach + 22.0),
                Line::dashed(Ink::Dimension),
                1.5,
            );
            if !ray.drawn {
                sheet.segment(
                    ray.at,
                    tip(end, reach + 22.0),
                    Line::dashed(Ink::Dimension),
                    1.5,
                );
            }
            sheet.path(
                arc(ray.at, reach, start, start + turn),
                false,
                Line::thin(Ink::Dimension),
                3.0,
            );
            let half = start + turn / 2.0;
            let label = Label::symbol(&parameter.name, parameter.latex.as_deref());
            let spot = Spot::point(tip(half, reach), [half.cos(), half.sin()], 1.5);
            sheet.wish(
                if value < 0.0 { label.negated() } else { label },
                SIZE,
                spot,
            );
            break;
        }
    }
}

fn rays<'a>(stage: &'a Stage) -> Vec<Ray<'a>> {
    let scene = stage.scene;
    let mut rays: Vec<Ray> = Vec::new();
    let joints: Vec<(&[usize; 2], &Vector)> = scene
        .hinges
        .iter()
        .map(|h| (&h.bodies, &h.at))
        .chain(scene.contacts.iter().map(|c| (&c.bodies, &c.at)))
        .collect();
    for (i, body) in scene.bodies.iter().enumerate() {
        if !matches!(body.shape, Shape::Rod { .. } | Shape::Rectangle { .. }) {
            continue;
        }
        let center = stage.px(stage.poses[i].center);
        let joint = joints.iter().copied().find(|(bodies, at)| {
            bodies.contains(&i)
                && stage.spot(at).is_some_and(|p| apart(p, center) > 8.0)
                && matches!(body.shape, Shape::Rod { .. })
        });
        match joint {
            Some((_, at)) => rays.push(Ray {
                at: stage.spot(at).unwrap_or(center),
                direction: Box::new(move |v| {
                    let (g, p) = (v.pair(&body.center)?, v.pair(at)?);
                    Some(minus(g, p))
                }),
                drawn: true,
            }),
            None => rays.push(Ray {
                at: center,
                direction: Box::new(move |v| v.of(&body.angle).map(|a| [a.cos(), a.sin()])),
                drawn: matches!(body.shape, Shape::Rod { .. }),
            }),
        }
    }
    let mut add = |at: Pair, v: &'a Vector, drawn: bool| {
        rays.push(Ray {
            at,
            direction: Box::new(move |values| values.pair(v)),
            drawn,
        });
    };
    for contact in &scene.contacts {
        let from = contact
            .bodies
            .iter()
            .find(|b| !scene.bodies[**b].is_fixed());
        if let (Some(n), Some(body)) = (&contact.normal, from) {
            let at = if scene.bodies[*body].is_particle() {
                stage.spot(&contact.at)
            } else {
                None
            };
            add(
                at.unwrap_or_else(|| stage.px(stage.poses[*body].center)),
                n,
                false,
            );
        }
    }
    for (i, body) in scene.bodies.iter().enumerate() {
        if !body.is_fixed() {
            add(stage.px(stage.poses[i].center), &body.velocity, false);
        }
    }
    for blow in &scene.blows {
        let (BlowImpulse::Given(v) | BlowImpulse::Along(v)) = &blow.impulse;
        if let Some(at) = stage.spot(&blow.at) {
            add(at, v, false);
        }
    }
    for known in &scene.after {
        if let KnownQuantity::Velocity { at, along, .. } = &known.what
            && let Some(at) = stage.spot(at)
        {
            add(at, along, false);
        }
    }
    rays
}
