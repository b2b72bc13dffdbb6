//! carom: symbolic-numeric mechanics of planar rigid-body collisions.
//!
//! The modules below stand in reading order: each imports only what stands above it.

pub mod expr;

pub mod interval;

pub mod domain;

pub mod dimension;

pub mod algebra;

pub mod equality;

pub mod formula;

pub mod scene;

pub mod laws;

pub mod numeric;

pub mod derive;

pub mod verify;

pub mod grade;

pub mod story;

pub mod emit;

#[cfg(feature = "report")]
pub mod report;

pub mod figure;

pub mod plot;

pub mod solution;

pub mod check;

pub mod render;
