//! Questions and plots as a scene file writes them.

use super::place_file::{DirectionFile, PositionFile};
use super::record::{Formula, Map, Text, choice, record};
use super::stage_file::{EndName, ShareFile};

choice! {
    /// Which kinetic energy.
    pub EnergyWhen {
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
    pub(super) BalanceName {
        /// Linear momentum.
        Momentum = "momentum",
    }
}

record! {
    /// Something asked: exactly one of velocity, spin, impulse, energy, balance and matrix, with what belongs to it; or one of
    /// value, solve, threshold, maximum, minimum, limit, approximate and show, about the answers to those.
    QuestionFile {
        /// How the answer's name is typeset.
        latex: Option<Text>,
        /// Velocity just after of this body (its center of mass), or of this point of the body named in `of`.
        velocity: Option<Text>,
        /// The body: to which the point of a velocity belongs, or of which the energy is asked (missing: of all). Of a `turn`, a
        /// formula of answers to questions of the group, such as "h_#".
        of: Option<Text>,
        /// Direction of the component asked of a velocity or an impulse, or in which momentum is balanced.
        along: Option<DirectionFile>,
        /// Angular velocity just after of this body.
        spin: Option<Text>,
        /// Counts a spin, a direction, an angle or an angular acceleration clockwise.
        clockwise: Option<bool>,
        /// Impulse at this contact, hinge or blow.
        impulse: Option<Text>,
        /// The body on which the impulse acts. Missing: the second body; the first, if the second is fixed.
        on: Option<Text>,
        /// Kinetic energy.
        energy: Option<EnergyWhen>,
        /// An equation: a quantity before equals that after, along `along`, for the bodies in `system`.
        balance: Option<BalanceName>,
        /// Bodies of a balance.
        system: Option<Vec<Text>>,
        /// A matrix: names of balance questions and of entries of `after`, one per row.
        matrix: Option<Vec<Text>>,
        /// Names of the questions whose answers are the unknowns of the matrix, one per column.
        unknowns: Option<Vec<Text>>,
        /// Name of the stage at whose end a velocity, speed, spin, impulse or energy is asked, or which a reaction or angular momentum
        /// belongs to. Missing: the last stage; for an impulse the one impact that has its place.
        at: Option<Text>,
        /// Beginning or end of the stage, for a reaction or an angular momentum; in a scene without stages also just before or
        /// just after the impact, for a velocity, a speed, a direction or a spin. Missing: the end, or just after.
        when: Option<EndName>,
        /// Speed just after of this body (its center of mass), or of this point of the body named in `of`; in a scene with stages
        /// its velocity is answered too, under the same name with `_velocity`, unless it is asked before.
        speed: Option<Text>,
        /// Direction just after in which this body moves (its center of mass), or this point of the body named in `of`: the angle of
        /// its velocity from the x axis, counterclockwise unless `clockwise`; in a scene with stages that velocity is answered too,
        /// under the same name with `_velocity`, unless it is asked before. The direction of a component is given `along`.
        direction: Option<Text>,
        /// Moment of inertia of this body about the point `about`.
        inertia: Option<Text>,
        /// The point of this body, or beside it, that is at rest just after: its coordinates, by `_x` and `_y`.
        instantaneous_center: Option<Text>,
        /// Force of the fixed point on the body that turns in this stage, or of the surface on what slides or rolls in it, along
        /// `along`.
        reaction: Option<Text>,
        /// Name of a stage: how long does it last?
        time: Option<Text>,
        /// Name of a stage in which a body slides or rolls: how far does it get? Along the body that it slides `on`, if any.
        distance: Option<Text>,
        /// Acceleration of this body along its own way in the stage `at`, a `slide`: negative where it slows down; on a spring at
        /// the end or `when` it starts; where one slides `on` another, of either along the direction of the stage. In a `turn` or a
        /// `linkage` that of its center of mass, or of this point of the body named in `of`, along `along`, at the end or `when`
        /// it starts.
        acceleration: Option<Text>,
        /// Angular acceleration of this body at the end of the stage `at`, a `turn` or a `linkage`, or `when` it starts:
        /// counterclockwise positive.
        angular_acceleration: Option<Text>,
        /// Pull of the string at this body in the stage `at`, a `slide` with `strings`.
        tension: Option<Text>,
        /// Angle through which this body turns in the stage `at`, counterclockwise unless `clockwise`.
        angle: Option<Text>,
        /// Where the center of mass of this body is at the end of the stage `at`: coordinates by `_x` and `_y`, or along `along`.
        position: Option<Text>,
        /// Angular momentum of this body about the point `about`.
        angular_momentum: Option<Text>,
        /// Point to which an angular momentum or a moment of inertia refers.
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
        /// A formula to be made as small as possible.
        minimum: Option<Formula>,
        /// The parameters that may be chosen for it.
        over: Option<Vec<Text>>,
        /// A formula whose limit is asked.
        limit: Option<Formula>,
        /// The parameter that tends to `to`.
        tends: Option<Text>,
        /// What it tends to: a formula, or "infinity".
        to: Option<Formula>,
        /// A formula, or the name of a vector, to be written as a polynomial in the small difference between the parameter that
        /// `tends` and what it tends `to` (missing: 0), up to the power `order`; without it, by its leading term.
        approximate: Option<Formula>,
        /// Highest power kept: 0, 1, 2, …. Missing: the leading term, and its power.
        order: Option<Formula>,
        /// An equation or inequality to be proved.
        show: Option<Text>,
        /// Names of answers that must not vanish for what is shown to mean something, such as velocities between which an angle is
        /// measured; where they vanish is found and told.
        unless: Option<Vec<Text>>,
        /// What the equation to be proved says, in words.
        claim: Option<Text>,
        /// The parameter that counts the turns of a repeated group: what is `of` in the turn of that number, whichever it is?
        turn: Option<Text>,
        /// The sum of `of` over all turns up to that one is asked.
        total: Option<bool>,
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
