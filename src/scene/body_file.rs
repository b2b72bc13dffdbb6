//! Bodies as a scene file writes them: shapes, sizes, places and motion just before.

use super::fault::{Fault, Span};
use super::json::{Node, Value};
use super::place_file::PositionFile;
use super::record::{Formula, Map, Pair, Read, choice, record, unexpected};

choice! {
    /// What a body looks like.
    pub(super) ShapeName {
        /// Ground, wall or peg; a `velocity` makes it a wall that moves steadily.
        Fixed = "fixed",
        /// A point mass.
        Particle = "particle",
        /// A uniform thin rod: `length`, along `angle`. Mass "0" makes it a massless link.
        Rod = "rod",
        /// A uniform disk: `radius`. Mass "0" makes it a light pulley.
        Disk = "disk",
        /// A thin ring: `radius`.
        Ring = "ring",
        /// A uniform solid sphere: `radius`.
        Sphere = "sphere",
        /// A uniform rectangle: `width` along `angle`, `height` across.
        Rectangle = "rectangle",
        /// Any rigid body: `inertia` or `radius_of_gyration` about its center of mass.
        Body = "body",
        /// `parts` held together rigidly by massless bars; mass, center and inertia follow from them.
        Composite = "composite",
    }
}

record! {
    /// A rigid body, a particle, or something immovable.
    BodyFile {
        /// What it looks like.
        shape: ShapeName,
        /// Mass.
        mass: Option<Formula>,
        /// Length of a rod.
        length: Option<Formula>,
        /// Radius of a disk, ring or sphere.
        radius: Option<Formula>,
        /// Side of a rectangle along `angle`.
        width: Option<Formula>,
        /// Side of a rectangle across `angle`.
        height: Option<Formula>,
        /// Moment of inertia about the center of mass; it may also replace that of a named shape.
        inertia: Option<Formula>,
        /// Radius of gyration about the center of mass.
        radius_of_gyration: Option<Formula>,
        /// Parts of a composite, by name: bodies, each with its `center` and without a motion of its own.
        parts: Option<Map<BodyFile>>,
        /// Position of the center of mass. A particle without it sits where it is touched.
        center: Option<PositionFile>,
        /// Orientation, counterclockwise from x. Missing: 0.
        angle: Option<Formula>,
        /// Velocity of the center of mass just before: [x, y], or {"about": point} for a body that turns about a point
        /// with its spin. Missing: as its hinges, or the point of the rotation that the scene begins with, make it move with its
        /// spin; without them, at rest.
        velocity: Option<VelocityFile>,
        /// Angular velocity just before, counterclockwise. Missing: 0.
        spin: Option<Formula>,
    }
}

/// A velocity just before.
#[derive(Clone, Debug, schemars::JsonSchema)]
#[schemars(untagged)]
pub(super) enum VelocityFile {
    /// Components of the velocity of the center of mass.
    Components(Pair<Formula>),
    /// Rotation about a point.
    About(AboutFile),
}

impl VelocityFile {
    /// Where it stands.
    pub fn span(&self) -> Span {
        match self {
            VelocityFile::Components(pair) => pair.span,
            VelocityFile::About(about) => about.span,
        }
    }
}

impl Read for VelocityFile {
    fn read(node: &Node<'_>, faults: &mut Vec<Fault>) -> Option<Self> {
        match &node.value {
            Value::List(_) => Pair::read(node, faults).map(VelocityFile::Components),
            Value::Object(_) => AboutFile::read(node, faults).map(VelocityFile::About),
            Value::Text(text) => {
                let message = "expected a velocity: [x, y] or {\"about\": …}, found a text";
                let hint = format!("to the right it is [\"{text}\", 0]");
                Fault::new(node.span, message).hint(hint).add_to(faults)
            }
            _ => unexpected(node, "a velocity: [x, y] or {\"about\": …}", faults),
        }
    }
}

record! {
    /// The body turns about a point at rest, with its spin.
    AboutFile {
        /// The point at rest.
        about: PositionFile,
    }
}
