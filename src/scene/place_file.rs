//! Positions and directions as a scene file writes them.

use super::fault::{Fault, Span};
use super::json::{Node, Value};
use super::record::{Formula, Pair, Read, Text, choice, record, unexpected};

/// A position: the name of a point or a body (its center), coordinates [x, y], or a step from another position.
#[derive(Clone, Debug, schemars::JsonSchema)]
#[schemars(untagged)]
pub(super) enum PositionFile {
    /// Name of a point, or of a body for its center of mass.
    Name(Text),
    /// Coordinates x and y.
    At(Pair<Formula>),
    /// A step from another position.
    From(Box<StepFile>),
}

impl PositionFile {
    /// Where it stands.
    pub fn span(&self) -> Span {
        match self {
            PositionFile::Name(name) => name.span,
            PositionFile::At(pair) => pair.span,
            PositionFile::From(step) => step.span,
        }
    }
}

impl Read for PositionFile {
    fn read(node: &Node<'_>, faults: &mut Vec<Fault>) -> Option<Self> {
        match node.value {
            Value::Text(_) => Text::read(node, faults).map(PositionFile::Name),
            Value::List(_) => Pair::read(node, faults).map(PositionFile::At),
            Value::Object(_) => Box::read(node, faults).map(PositionFile::From),
            _ => unexpected(node, "a position: a name, [x, y], or {\"from\": …}", faults),
        }
    }
}

record! {
    /// A step from a position: either `distance` and `angle`, or `by`.
    StepFile {
        /// Where the step starts.
        from: PositionFile,
        /// Length of the step.
        distance: Option<Formula>,
        /// Direction of the step, counterclockwise from x.
        angle: Option<Formula>,
        /// Components of the step along x and y.
        by: Option<Pair<Formula>>,
    }
}

/// A direction: an axis, the components [x, y] of a unit vector, or an angle counterclockwise from x.
#[derive(Clone, Debug, schemars::JsonSchema)]
#[schemars(untagged)]
pub(super) enum DirectionFile {
    /// An axis.
    Axis(AxisName),
    /// Components of a unit vector.
    Components(Pair<Formula>),
    /// An angle.
    Angle(AngleFile),
}

impl Read for DirectionFile {
    fn read(node: &Node<'_>, faults: &mut Vec<Fault>) -> Option<Self> {
        match node.value {
            Value::Text(_) => AxisName::read(node, faults).map(DirectionFile::Axis),
            Value::List(_) => Pair::read(node, faults).map(DirectionFile::Components),
            Value::Object(_) => AngleFile::read(node, faults).map(DirectionFile::Angle),
            _ => unexpected(node, "a direction: \"x\", [x, y] or {\"angle\": …}", faults),
        }
    }
}

choice! {
    /// One of the four directions of the axes.
    pub(super) AxisName {
        /// To the right.
        Right = "x",
        /// To the left.
        Left = "-x",
        /// Up.
        Up = "y",
        /// Down.
        Down = "-y",
    }
}

record! {
    /// A direction by its angle.
    AngleFile {
        /// Counterclockwise from x.
        angle: Formula,
    }
}
