//! Vectors in the plane.

use super::Expr;

/// A vector in the plane, components along x and y.
pub type Vector = [Expr; 2];

/// z-component of the cross product a × b.
pub fn cross(a: &Vector, b: &Vector) -> Expr {
    &a[0] * &b[1] - &a[1] * &b[0]
}

/// Scalar product a · b.
pub fn dot(a: &Vector, b: &Vector) -> Expr {
    &a[0] * &b[0] + &a[1] * &b[1]
}

/// The difference a − b.
pub fn minus(a: &Vector, b: &Vector) -> Vector {
    [&a[0] - &b[0], &a[1] - &b[1]]
}

/// The sum a + b.
pub fn plus(a: &Vector, b: &Vector) -> Vector {
    [&a[0] + &b[0], &a[1] + &b[1]]
}
