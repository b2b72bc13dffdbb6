//! The scene file as it is written: its fields, their meaning, and what may be left out.
//!
//! The doc comments are the format's documentation: `carom schema` prints them as a JSON Schema, from which an editor
//! helps to write scenes. Nothing is resolved or checked here.

use super::body_file::BodyFile;
use super::contact_file::{BlowFile, ContactFile, ForceFile, HingeFile, KnownFile};
use super::fault::Fault;
use super::json::{Node, Value};
use super::place_file::PositionFile;
use super::question_file::{PlotFile, QuestionFile};
use super::record::{Formula, Map, Pair, Read, Text, choice, record, unexpected};
use super::stage_file::StageFile;

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
        /// Inequalities between parameters that the problem grants, such as "M > m" or "c < L/2". Signs are decided by them, and
        /// values keep to them.
        relations: Option<Vec<Text>>,
        /// Points by name.
        points: Option<Map<PositionFile>>,
        /// Bodies by name.
        bodies: Map<BodyFile>,
        /// Hinges by name. They hold before, during and after the collision. In a scene with stages those on a fixed body hold
        /// in every impact, and a `turn` is about the one that holds its body; the others stand in an impact.
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
        /// then stand in the impacts. A group of them may be repeated.
        #[schemars(with = "Option<Vec<StageOrGroup>>")]
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

/// A stage, or a group of stages that happens several times.
#[derive(schemars::JsonSchema)]
#[schemars(untagged)]
#[allow(
    dead_code,
    reason = "it stands for either in the schema; the reader writes groups out first"
)]
enum StageOrGroup {
    /// One stage.
    Stage(Box<StageFile>),
    /// A group.
    Group(RepeatFile),
}

record! {
    /// A group of stages that happens several times. `#` in any text of it stands for the number of the turn: 1, 2, 3, ….
    RepeatFile {
        /// How many times, a whole number.
        repeat: Formula,
        /// Its stages, such as one named "bounce #".
        stages: Vec<StageFile>,
        /// What is asked in every turn, such as "v_#"; the questions of the scene may use the answers.
        questions: Option<Map<QuestionFile>>,
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
        supports: Option<Map<Support>>,
        /// Where strings are fastened: by the name of a string, or of a body that hangs on one.
        strings: Option<Map<PositionFile>>,
        /// Where springs stand under a body, by the name of the force that they exert: the points above them.
        springs: Option<Map<Vec<PositionFile>>>,
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
    pub(super) LooksName {
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
    pub Support {
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
        /// Unit, such as "kg", "m/s", "kg m^2", "ft/s", "mm", "deg" or "1". Missing: that of the value, "15 lbf"; else a number without unit.
        /// A pound of mass is "lb", one of force "lbf".
        unit: Option<Text>,
        /// What it is, in words.
        meaning: Option<Text>,
        /// How it is typeset, such as "\\ell".
        latex: Option<Text>,
        /// Its value in the unit: a number, or a formula without symbols such as "1/3" or "acos(3/5)".
        value: Option<Formula>,
        /// Where it may lie. Missing: positive; for an angle any value, or the quarter turn in which its `value` lies; for a
        /// restitution from 0 to 1; for a component of a unit vector from -1 to 1.
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
    pub(super) DomainName {
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
        /// Lower end: a number, a multiple of pi, or a formula of other parameters such as "a/2".
        min: Option<Formula>,
        /// Upper end: a number, a multiple of pi, or a formula of other parameters such as "acos(b/a)".
        max: Option<Formula>,
        /// Whether the lower end itself is excluded.
        min_open: Option<bool>,
        /// Whether the upper end itself is excluded.
        max_open: Option<bool>,
    }
}
