//! Points and directions in the plane.

/// A point or direction in the plane.
pub type Pair = [f64; 2];

/// The sum of two.
pub fn plus(a: Pair, b: Pair) -> Pair {
    [a[0] + b[0], a[1] + b[1]]
}

/// The first without the second: the way from the second point to the first.
pub fn minus(a: Pair, b: Pair) -> Pair {
    [a[0] - b[0], a[1] - b[1]]
}

/// A direction as many times as long.
pub fn times(v: Pair, k: f64) -> Pair {
    [v[0] * k, v[1] * k]
}

/// The opposite direction.
pub fn opposite(v: Pair) -> Pair {
    [-v[0], -v[1]]
}

/// A direction turned counterclockwise by a quarter.
pub fn left(v: Pair) -> Pair {
    [-v[1], v[0]]
}

/// A direction turned clockwise by a quarter.
pub fn right(v: Pair) -> Pair {
    [v[1], -v[0]]
}

/// A direction turned counterclockwise by an angle.
pub fn turned(v: Pair, angle: f64) -> Pair {
    let (s, c) = angle.sin_cos();
    [v[0] * c - v[1] * s, v[0] * s + v[1] * c]
}

/// The point `far` times a direction ahead of a point.
pub fn ahead(p: Pair, along: Pair, far: f64) -> Pair {
    [p[0] + along[0] * far, p[1] + along[1] * far]
}

/// The point at a share of the way from one point to another.
pub fn between(from: Pair, to: Pair, share: f64) -> Pair {
    ahead(from, minus(to, from), share)
}

/// The point at a distance from another, at an angle to x.
pub fn polar(center: Pair, radius: f64, angle: f64) -> Pair {
    ahead(center, [angle.cos(), angle.sin()], radius)
}

/// Scalar product.
pub fn dot(a: Pair, b: Pair) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The angle of a direction, counterclockwise from x.
pub fn bearing(v: Pair) -> f64 {
    v[1].atan2(v[0])
}

/// Product across: positive where the second direction lies to the left of the first.
pub fn cross(a: Pair, b: Pair) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Length of a direction.
pub fn size(v: Pair) -> f64 {
    v[0].hypot(v[1])
}

/// Distance of two points.
pub fn apart(a: Pair, b: Pair) -> f64 {
    size(minus(a, b))
}

/// Distance of a point from the segment between two others.
pub fn distance(p: Pair, a: Pair, b: Pair) -> f64 {
    let d = minus(b, a);
    let t = (dot(minus(p, a), d) / dot(d, d).max(1e-12)).clamp(0.0, 1.0);
    size(ahead(minus(p, a), d, -t))
}

/// The direction with length 1.
pub fn unit(v: Pair) -> Pair {
    // The inverse of the smallest doubles is beyond all of them.
    let length = size(v);
    v.map(|part| part / length)
}
