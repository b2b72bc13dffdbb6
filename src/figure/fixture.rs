//! The fixtures that bodies stand on, hang from or strike: hatched ground, pegs, hinge supports, stops, edges, wheels, springs.
//!
//! In: a place on the sheet, in pixels, and which way it faces. Out: lines on the sheet.

use super::place::Room;
use super::plane::{Pair, ahead, left, minus, opposite, right, size, times};
use super::sheet::{Ink, Line, Sheet};
use super::stage::PEG;

/// A line with strokes on its far side.
pub(super) fn hatched(sheet: &mut Sheet, from: Pair, to: Pair, back: Pair) {
    let d = minus(to, from);
    let length = size(d).max(1e-9);
    let along = times(d, 1.0 / length);
    sheet.segment(
        from,
        to,
        Line {
            width: 1.9,
            ..Line::of(Ink::Ground)
        },
        2.0,
    );
    sheet.grounds.push((from, to, back));
    let count = (length / 7.0).floor() as usize;
    for k in 0..count.min(100) {
        let t = (k as f64 + 0.85) * length / count as f64;
        let foot = ahead(from, along, t);
        let end = ahead(ahead(foot, back, 7.0), along, -5.5);
        sheet.segment(foot, end, Line::thin(Ink::Ground), 0.0);
    }
    for depth in [3.5, 7.5] {
        let behind = |p: Pair| ahead(p, back, depth);
        sheet.walls.push((behind(from), behind(to), 3.0));
    }
}

/// A round peg, seen from its end.
pub(super) fn peg(sheet: &mut Sheet, at: Pair) {
    sheet.circle(
        at,
        PEG,
        Line {
            filled: true,
            ..Line::of(Ink::Ground)
        },
    );
    for k in [-3.0, 0.0, 3.0] {
        let half = f64::sqrt(PEG * PEG - k * k) * 0.75;
        let [low, high] = [-1.0, 1.0].map(|s| [at[0] + k + s * half * 0.6, at[1] + s * half * 0.8]);
        sheet.segment(low, high, Line::thin(Ink::Ground), 0.0);
    }
    sheet.kept.push(Room::around(at, PEG));
}

/// The support of a hinge: a triangle on a hatched line, away from the body.
pub(super) fn support(sheet: &mut Sheet, at: Pair, away: Pair) {
    let across = left(away);
    let spot = |out: f64, side: f64| ahead(ahead(at, away, out), across, side);
    sheet.path(
        vec![at, spot(15.0, 10.0), spot(15.0, -10.0)],
        true,
        Line {
            filled: true,
            ..Line::thin(Ink::Ground)
        },
        1.0,
    );
    hatched(sheet, spot(15.0, 18.0), spot(15.0, -18.0), away);
}

/// A low block on the ground whose lower corner is at a point; it stands in the way of what comes.
pub(super) fn stop(sheet: &mut Sheet, at: Pair, way: f64) {
    let at = [at[0] + way * 0.8, at[1]];
    let far = at[0] + way * 11.0;
    let block = vec![at, [far, at[1]], [far, at[1] + 13.0], [at[0], at[1] + 13.0]];
    let line = Line {
        filled: true,
        ..Line::of(Ink::Ground)
    };
    sheet.path(block, true, line, 2.0);
    sheet.kept.push(Room {
        low: [at[0].min(far), at[1]],
        high: [at[0].max(far), at[1] + 13.0],
    });
    for k in [3.0, 6.0, 9.0] {
        let [low, high] = [2.0, 11.0].map(|y| [at[0] + way * k, at[1] + y]);
        sheet.segment(low, high, Line::thin(Ink::Ground), 0.0);
    }
}

/// The corner of a table: its top leads away from the body, its side goes down.
pub(super) fn edge(sheet: &mut Sheet, at: Pair, n: Pair, out: f64) {
    let along = times(right(n), out);
    let back = opposite(n);
    let inner = ahead(at, along, -4.0);
    let far = ahead(at, along, 58.0);
    let foot = ahead(inner, back, 40.0);
    match out > 0.0 {
        true => hatched(sheet, inner, far, back),
        false => hatched(sheet, far, inner, back),
    }
    let line = Line {
        width: 1.9,
        ..Line::of(Ink::Ground)
    };
    sheet.segment(inner, foot, line, 2.0);
}

/// A wheel between the body and the ground.
pub(super) fn wheel(sheet: &mut Sheet, at: Pair, n: Pair) {
    const RADIUS: f64 = 9.0;
    let spot = |down: f64, side: f64| ahead(ahead(at, n, -down), right(n), side);
    sheet.circle(spot(RADIUS, 0.0), RADIUS, Line::of(Ink::Ground));
    sheet.dot(spot(RADIUS, 0.0), 1.6, Ink::Ground);
    let back = opposite(n);
    hatched(
        sheet,
        spot(2.0 * RADIUS + 0.8, -24.0),
        spot(2.0 * RADIUS + 0.8, 24.0),
        back,
    );
}

/// A spring from a body that presses it, in the direction given, to the ground or a wall.
pub(super) fn spring(sheet: &mut Sheet, at: Pair, along: Pair) {
    const TURNS: usize = 5;
    const LEAD: f64 = 4.0;
    const LENGTH: f64 = 30.0;
    const HALF: f64 = 6.0;
    let step = (LENGTH - 2.0 * LEAD) / (2 * TURNS) as f64;
    let spot = |far: f64, side: f64| ahead(ahead(at, along, far), left(along), side);
    let mut points = vec![at, spot(LEAD, 0.0)];
    for k in 0..2 * TURNS {
        let side = if k % 2 == 0 { HALF } else { -HALF };
        points.push(spot(LEAD + (k as f64 + 0.5) * step, side));
    }
    points.extend([spot(LENGTH - LEAD, 0.0), spot(LENGTH, 0.0)]);
    sheet.path(points, false, Line::of(Ink::Ground), 1.0);
    let foot = LENGTH + 0.8;
    hatched(sheet, spot(foot, 16.0), spot(foot, -16.0), along);
}
