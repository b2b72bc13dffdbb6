//! carom: symbolic-numeric mechanics of planar rigid-body collisions.
pub mod algebra;
pub mod dimension;
pub mod domain;
pub mod equality;
pub mod expr;
pub mod formula;
pub mod interval;
pub mod numeric;
pub mod scene;
pub mod laws;
