//! The scene file as it is written: its fields, their meaning, and what may be left out.
//!
//! The doc comments are the format's documentation: `carom schema` prints them as a JSON Schema, from which an editor
//! helps to write scenes. Nothing is resolved or checked here.

use super::fault::Fault;
use super::json::{Node, Value};
use super::record::{Formula, Map, Pair, Read, Text, choice, record, unexpected};
use super::stage_file::{EndName, ShareFile, StageFile};

record! {
    /// A planar collision: bodies, how they move just before, where and how they touch, and what is asked.
    /// x points to the right, y up, counterclockwise is positive.
    SceneFile {
        /// Address of this schema, for editors; carom ignores it.
        #[allow(dead_code, reason = "read so that it is no unknown field")]
        schema as "$schema": Option<Text>,
        /// Heading of the worked solution.
        title: Option<Text>,
        /// Where the problem comes from, such as "Sample 17.29".
        source: Option<Text>,
        /// The problem in words.
        statement: Option<Text>,
        /// The symbols of the formulas, by name. `pi` is known.
        parameters: Option<Map<ParameterFile>>,
        /// Pairs of parameters that are the components of a unit vector, such as ["nx", "ny"].
        unit_vectors: Option<Vec<Pair<Text>>>,
        /// Points by name.
        points: Option<Map<PositionFile>>,
        /// Bodies by name.
        bodies: Map<BodyFile>,
        /// Hinges by name. They hold before, during and after the collision.
        hinges: Option<Map<HingeFile>>,
        /// Contacts by name: where two bodies collide.
        contacts: Option<Map<ContactFile>>,
        /// Impulses from outside, by name.
        blows: Option<Map<BlowFile>>,
        /// What is known of the motion just after, in place of a law.
        after: Option<Vec<KnownFile>>,
        /// Kinetic energy may be gained at the contacts, as where a spring or a charge is set free there. Missing: it may not,
        /// and a result by which it is gained is not possible.
        gains_energy: Option<bool>,
        /// Finite forces that act too, such as weight. They have no impulse, and the solution says so.
        forces: Option<Vec<ForceFile>>,
        /// What happens before and after the collision: stages that hand the motion on. Hinges, contacts, supports and blows
        /// then stand in the impacts.
        stages: Option<Vec<StageFile>>,
        /// How an incomplete statement or a missing figure is read, in words; the solution repeats it.
        assumptions: Option<Vec<Text>>,
        /// What is asked, under the name of the answer.
        questions: Option<Map<QuestionFile>>,
        /// Curves to be drawn, by name.
        plots: Option<Map<PlotFile>>,
        /// How the scene wants to be drawn; nothing here changes mechanics.
        figure: Option<FigureFile>,
        /// What a book prints about the scene, for `carom verify`.
        printed: Option<Vec<PrintedFile>>,
    }
}

record! {
    /// Hints for the figures. What is missing is chosen so that bodies touch where they should.
    FigureFile {
        /// Values of parameters to draw at, in their units.
        values: Option<Map<Formula>>,
        /// What bodies look like, by name.
        bodies: Option<Map<OutlineFile>>,
        /// What stands at a contact, support, hinge or point, by its name.
        supports: Option<Map<SupportName>>,
        /// Where strings are fastened: by the name of a string, or of a body that hangs on one.
        strings: Option<Map<PositionFile>>,
        /// Height of the level ground.
        ground: Option<Formula>,
    }
}

record! {
    /// A simple outline.
    OutlineFile {
        /// Which one.
        looks: LooksName,
        /// Length of a person from hands to feet, or of a bat.
        length: Option<Formula>,
        /// Width of a box.
        width: Option<Formula>,
        /// Height of a box.
        height: Option<Formula>,
    }
}

choice! {
    /// What a body looks like.
    LooksName {
        /// A person stretched out along the body's angle, the hands first.
        Person = "person",
        /// A bat along the body's angle, the handle first.
        Bat = "bat",
        /// A box.
        Box = "box",
    }
}

choice! {
    /// What stands at a point.
    SupportName {
        /// A level floor.
        Floor = "floor",
        /// A wall across the normal.
        Wall = "wall",
        /// A low stop on the ground.
        Stop = "stop",
        /// The edge of a table.
        Edge = "edge",
        /// A post with a point.
        Post = "post",
        /// A wheel on the ground.
        Wheel = "wheel",
        /// A round bar or peg, seen from its end.
        Bar = "bar",
    }
}

record! {
    /// Something a book prints: a formula (`item` with `printed`), a `number`, an `equation`, a `claim` or a `matrix`.
    PrintedFile {
        /// Where it is printed, such as "(17.62)".
        place as "where": Option<Text>,
        /// Name of the answer a printed formula is for.
        item: Option<Text>,
        /// The printed formula; of a vector [x, y].
        printed: Option<Text>,
        /// A printed number with its unit.
        number: Option<Text>,
        /// What the number is of: a name, or a formula in names.
        of: Option<Text>,
        /// The formula by which the book got the number from others.
        from: Option<Text>,
        /// A printed equation or inequality, in parameters, answers and unknowns.
        equation: Option<Text>,
        /// A statement in words; `equation` says it in formulas.
        claim: Option<Text>,
        /// Entries of a printed matrix, row by row.
        matrix: Option<Vec<Vec<Text>>>,
        /// Names of its unknowns, one for each column.
        unknowns: Option<Vec<Text>>,
        /// Its right side.
        right: Option<Vec<Text>>,
        /// Special values of parameters for which it is printed.
        at: Option<Map<Text>>,
        /// Abbreviations it uses, with what they stand for.
        short as "let": Option<Map<Text>>,
        /// Angles that are taken as small.
        small: Option<Vec<Text>>,
    }
}

record! {
    /// A given quantity.
    ParameterFile {
        /// Unit, such as "kg", "m/s", "kg m^2", "mm", "deg" or "1". Missing: a number without unit.
        unit: Option<Text>,
        /// What it is, in words.
        meaning: Option<Text>,
        /// How it is typeset, such as "\\ell".
        latex: Option<Text>,
        /// Its value in the unit: a number, or a formula without symbols such as "1/3" or "acos(3/5)".
        value: Option<Formula>,
        /// Where it may lie. Missing: positive; for an angle any value; for a restitution from 0 to 1; for a component of a
        /// unit vector from -1 to 1.
        domain: Option<DomainFile>,
    }
}

/// Where a parameter may lie.
#[derive(Clone, Debug, schemars::JsonSchema)]
#[schemars(untagged)]
pub(super) enum DomainFile {
    /// A known set.
    Named(DomainName),
    /// An interval.
    Interval(IntervalFile),
}

impl Read for DomainFile {
    fn read(node: &Node<'_>, faults: &mut Vec<Fault>) -> Option<Self> {
        match node.value {
            Value::Text(_) => DomainName::read(node, faults).map(DomainFile::Named),
            Value::Object(_) => IntervalFile::read(node, faults).map(DomainFile::Interval),
            _ => unexpected(
                node,
                "\"positive\", \"nonnegative\", \"real\" or {\"min\": …, \"max\": …}",
                faults,
            ),
        }
    }
}

choice! {
    /// A known set of numbers.
    DomainName {
        /// Greater than 0.
        Positive = "positive",
        /// 0 or greater.
        Nonnegative = "nonnegative",
        /// Any number.
        Real = "real",
    }
}

record! {
    /// An interval in the parameter's unit; a missing end is infinite.
    IntervalFile {
        /// Lower end: a number, or a multiple of pi.
        min: Option<Formula>,
        /// Upper end: a number, or a multiple of pi.
        max: Option<Formula>,
        /// Whether the lower end itself is excluded.
        min_open: Option<bool>,
        /// Whether the upper end itself is excluded.
        max_open: Option<bool>,
    }
}

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
    AxisName {
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

choice! {
    /// What a body looks like.
    ShapeName {
        /// Ground, wall or peg; a `velocity` makes it a wall that moves steadily.
        Fixed = "fixed",
        /// A point mass.
        Particle = "particle",
        /// A uniform thin rod: `length`, along `angle`. Mass "0" makes it a massless link.
        Rod = "rod",
        /// A uniform disk: `radius`.
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
        /// Parts of a composite, by name.
        parts: Option<Map<PartFile>>,
        /// Position of the center of mass. A particle without it sits where it is touched.
        center: Option<PositionFile>,
        /// Orientation, counterclockwise from x. Missing: 0.
        angle: Option<Formula>,
        /// Velocity of the center of mass just before: [x, y], or {"about": point} for a body that turns about a point
        /// with its spin. Missing: at rest.
        velocity: Option<VelocityFile>,
        /// Angular velocity just before, counterclockwise. Missing: 0.
        spin: Option<Formula>,
    }
}

record! {
    /// A part of a composite body; the fields are those of a body.
    PartFile {
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
        /// Moment of inertia about the part's own center of mass.
        inertia: Option<Formula>,
        /// Radius of gyration about the part's own center of mass.
        radius_of_gyration: Option<Formula>,
        /// Position of the part's center of mass.
        center: PositionFile,
        /// Orientation, counterclockwise from x. Missing: 0.
        angle: Option<Formula>,
    }
}

impl From<&PartFile> for BodyFile {
    fn from(part: &PartFile) -> BodyFile {
        let PartFile {
            span,
            shape,
            mass,
            length,
            radius,
            width,
            height,
            inertia,
            radius_of_gyration,
            center,
            angle,
        } = part.clone();
        BodyFile {
            span,
            shape,
            mass,
            length,
            radius,
            width,
            height,
            inertia,
            radius_of_gyration,
            parts: None,
            center: Some(center),
            angle,
            velocity: None,
            spin: None,
        }
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

impl Read for VelocityFile {
    fn read(node: &Node<'_>, faults: &mut Vec<Fault>) -> Option<Self> {
        match node.value {
            Value::List(_) => Pair::read(node, faults).map(VelocityFile::Components),
            Value::Object(_) => AboutFile::read(node, faults).map(VelocityFile::About),
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

record! {
    /// A frictionless hinge between two bodies.
    HingeFile {
        /// Names of the two bodies; one may be fixed. The reaction is the impulse on the second.
        bodies: Pair<Text>,
        /// Where it is.
        at: PositionFile,
    }
}

choice! {
    /// What is assumed of a collision beyond momentum balance.
    LawName {
        /// The touching points have the same velocity after.
        Sticking = "sticking",
        /// The impulse is along the normal; the normal relative velocity after is -e times that before.
        Frictionless = "frictionless",
        /// Coulomb friction: `mu`, `restitution` and `hypothesis`. The answers depend on whether the contact slides, sticks or
        /// reverses its slip; values decide, and symbols give one answer for each case.
        Friction = "friction",
    }
}

choice! {
    /// What the coefficient of restitution e means where there is friction.
    HypothesisName {
        /// Kinematic: the normal relative velocity after is -e times that before. Energy may grow.
        Newton = "newton",
        /// Kinetic: the normal impulse of restitution is e times that of compression.
        Poisson = "poisson",
        /// Energetic: the normal work of restitution is -e^2 times that of compression.
        Stronge = "stronge",
        /// Chatterjee and Ruina 1998: two coefficients, e and `tangential_restitution`; the impulse stays in the friction cone.
        ChatterjeeRuina = "chatterjee-ruina",
        /// Brach: normal restitution e and a ratio of tangential to normal impulse, `impulse_ratio`. Energy may grow.
        Brach = "brach",
    }
}

choice! {
    /// What a contact with friction is supposed to do; carom tells when that is so.
    SupposedName {
        /// It slips in one direction throughout.
        Slides = "slides",
        /// It does not slip just after.
        Sticks = "sticks",
        /// Slip ends during compression, and the contact sticks.
        SticksInCompression = "sticks in compression",
        /// Slip ends during restitution, and the contact sticks.
        SticksInRestitution = "sticks in restitution",
        /// Slip ends during compression and goes on the other way.
        ReversesInCompression = "reverses in compression",
        /// Slip ends during restitution and goes on the other way.
        ReversesInRestitution = "reverses in restitution",
        /// The impulse of Chatterjee and Ruina lies inside the friction cone.
        InsideCone = "inside the cone",
        /// The impulse of Chatterjee and Ruina lies on the friction cone.
        OnCone = "on the cone",
    }
}

record! {
    /// A point where two bodies collide.
    ContactFile {
        /// Names of the two bodies; one may be fixed. The impulse is the one on the second.
        bodies: Pair<Text>,
        /// Where they touch.
        at: PositionFile,
        /// Unit normal, out of the first body into the second.
        normal: Option<DirectionFile>,
        /// The law that closes the equations. Missing: none, and carom tells what remains undetermined.
        law: Option<LawName>,
        /// Coefficient of restitution e of a frictionless contact or of one with friction, from 0 to 1.
        restitution: Option<Formula>,
        /// Coefficient of friction, 0 or greater.
        mu: Option<Formula>,
        /// What the restitution of a contact with friction means. Missing: "poisson".
        hypothesis: Option<HypothesisName>,
        /// Tangential restitution of "chatterjee-ruina", from -1 to 1. Missing: 0, no slip where the cone allows it.
        tangential_restitution: Option<Formula>,
        /// Ratio of tangential to normal impulse of "brach"; the tangent is the normal turned clockwise by 90 degrees.
        /// Missing: the ratio that ends the slip, at most `mu` in size.
        impulse_ratio: Option<Formula>,
        /// What the contact does, if the answer for this one case is wanted.
        supposing: Option<SupposedName>,
    }
}

record! {
    /// An impulse from outside: either given, or of unknown size along a direction.
    BlowFile {
        /// Name of the body it acts on.
        on: Text,
        /// Where it acts.
        at: PositionFile,
        /// Components of a given impulse.
        impulse: Option<Pair<Formula>>,
        /// Direction of an impulse of unknown size.
        along: Option<DirectionFile>,
    }
}

record! {
    /// Something known just after: a velocity component, or a spin.
    KnownFile {
        /// Name under which a matrix question takes it as a row.
        name: Option<Text>,
        /// Name of the body whose velocity is known.
        velocity: Option<Text>,
        /// Point of that body. Missing: its center of mass.
        at: Option<PositionFile>,
        /// Direction of the known component.
        along: Option<DirectionFile>,
        /// Name of the body whose spin is known.
        spin: Option<Text>,
        /// The value.
        is: Formula,
    }
}

record! {
    /// A finite force.
    ForceFile {
        /// What it is, such as "weight".
        name: Text,
        /// Name of the body it acts on.
        on: Text,
    }
}

choice! {
    /// Which kinetic energy.
    EnergyName {
        /// Just before.
        Before = "before",
        /// Just after.
        After = "after",
        /// Before minus after.
        Lost = "lost",
    }
}

choice! {
    /// Which balance.
    BalanceName {
        /// Linear momentum.
        Momentum = "momentum",
    }
}

record! {
    /// Something asked: exactly one of velocity, spin, impulse, energy, balance and matrix, with what belongs to it; or one of
    /// value, solve, threshold, maximum, limit, approximate and show, about the answers to those.
    QuestionFile {
        /// How the answer's name is typeset.
        latex: Option<Text>,
        /// Velocity just after of this body (its center of mass), or of this point of the body named in `of`.
        velocity: Option<Text>,
        /// The body: to which the point of a velocity belongs, or of which the energy is asked (missing: of all).
        of: Option<Text>,
        /// Direction of the component asked of a velocity or an impulse, or in which momentum is balanced.
        along: Option<DirectionFile>,
        /// Angular velocity just after of this body.
        spin: Option<Text>,
        /// Counts a spin clockwise.
        clockwise: Option<bool>,
        /// Impulse at this contact, hinge or blow.
        impulse: Option<Text>,
        /// The body on which the impulse acts. Missing: the second body; the first, if the second is fixed.
        on: Option<Text>,
        /// Kinetic energy.
        energy: Option<EnergyName>,
        /// An equation: a quantity before equals that after, along `along`, for the bodies in `system`.
        balance: Option<BalanceName>,
        /// Bodies of a balance.
        system: Option<Vec<Text>>,
        /// A matrix: names of balance questions and of entries of `after`, one per row.
        matrix: Option<Vec<Text>>,
        /// Names of the questions whose answers are the unknowns of the matrix, one per column.
        unknowns: Option<Vec<Text>>,
        /// Name of the stage at whose end a velocity, spin, impulse or energy is asked, or which a reaction or angular momentum
        /// belongs to. Missing: the last stage.
        at: Option<Text>,
        /// Beginning or end of the stage, for a reaction or an angular momentum. Missing: its end.
        when: Option<EndName>,
        /// Force of the fixed point on the body that turns in this stage, along `along`.
        reaction: Option<Text>,
        /// Angular momentum of this body about the point `about`.
        angular_momentum: Option<Text>,
        /// Point to which an angular momentum refers.
        about: Option<PositionFile>,
        /// A formula of parameters and earlier answers.
        value: Option<Formula>,
        /// Parameters and the formulas that stand for them, in a value, a threshold, a solution or what is to be shown.
        with: Option<Map<Formula>>,
        /// The parameter for whose values the relation `holds` is true.
        threshold: Option<Text>,
        /// The parameter for whose value the equation `holds` is true.
        solve: Option<Text>,
        /// An inequality or equation between formulas of parameters and earlier answers, such as "K_top <= 0".
        holds: Option<Text>,
        /// A formula to be made as large as possible.
        maximum: Option<Formula>,
        /// The parameters that may be chosen for it.
        over: Option<Vec<Text>>,
        /// A formula whose limit is asked.
        limit: Option<Formula>,
        /// The parameter that tends to `to`.
        tends: Option<Text>,
        /// What it tends to: a formula, or "infinity".
        to: Option<Formula>,
        /// A formula, or the name of a vector, to be written as a polynomial in the small difference between the parameter that
        /// `tends` and what it tends `to` (missing: 0), up to the power `order`.
        approximate: Option<Formula>,
        /// Highest power kept: 0, 1, 2, ….
        order: Option<Formula>,
        /// An equation to be proved.
        show: Option<Text>,
        /// Names of answers that must not vanish for what is shown to mean something, such as velocities between which an angle is
        /// measured; where they vanish is found and told.
        unless: Option<Vec<Text>>,
        /// What the equation to be proved says, in words.
        claim: Option<Text>,
        /// Name of the stage: which forces have an impulse in it, and why?
        impulsive: Option<Text>,
        /// A spring that a blow of constant force presses: what share of the blow does it take while the blow lasts?
        share: Option<ShareFile>,
        /// Name of the stage: what happens in it, in words?
        describe: Option<Text>,
        /// Name of the stage: what do its laws leave open?
        missing: Option<Text>,
        /// Words of the author that nothing here derives, told as such.
        remark: Option<Text>,
        /// What is assumed?
        assumed: Option<bool>,
        /// Name of an earlier answer: which data does it not need?
        unused: Option<Text>,
    }
}

record! {
    /// A curve of a quantity against a parameter, or against a name that stands for a formula.
    PlotFile {
        /// Heading. Missing: the quantity against the parameter.
        title: Option<Text>,
        /// A formula of parameters and answers.
        quantity: Formula,
        /// What is written at its axis, such as "P_A/(m_1 v)". Missing: the formula.
        label: Option<Text>,
        /// The parameter along the other axis, or a new name that `stands_for` explains.
        against: Text,
        /// What the new name stands for, such as "l/d".
        stands_for: Option<Formula>,
        /// The parameter of that formula that varies.
        varying: Option<Text>,
        /// Smallest value shown.
        from: Formula,
        /// Largest value shown.
        to: Formula,
        /// One curve for each entry: parameters and the formulas that stand for them. Missing: one curve.
        curves: Option<Vec<Map<Formula>>>,
    }
}
