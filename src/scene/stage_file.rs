//! The part of the scene file that tells stages: fields, meaning, and what may be left out.

use super::body_file::VelocityFile;
use super::contact_file::{BlowFile, ContactFile, ForceFile, HingeFile, KnownFile};
use super::fault::Fault;
use super::place_file::{DirectionFile, PositionFile};
use super::record::keys;
use super::record::{Formula, Map, Pair, Text, choice, record};
use crate::formula::near::nearest;

record! {
    /// A stage: exactly one of impact, turn, slide, fall, wind and linkage. Its formulas may hold the names of answers to
    /// stages before it.
    StageFile {
        /// Name, by which questions and later stages refer to it.
        name: Text,
        /// Name of the stage whose end is the beginning of this one, or "start" for the bodies as given. Missing: the stage before.
        from: Option<Text>,
        /// Name of a motion before, during which this one happens too: it begins and ends with it, and has no end of its own.
        during: Option<Text>,
        /// Bodies that start otherwise than `bodies` says; only in a stage from "start".
        start: Option<Map<StartFile>>,
        /// A collision or blow: velocities jump, nothing moves.
        impact: Option<ImpactFile>,
        /// One body turns about a fixed point.
        turn: Option<TurnFile>,
        /// One body moves along a straight line: on a guide, on a rough surface, or rolling.
        slide: Option<SlideFile>,
        /// One body falls or flies freely.
        fall: Option<FallFile>,
        /// A particle on a rope that winds round a thin pole.
        wind: Option<WindFile>,
        /// Bodies joined so that one coordinate tells where they all are.
        linkage: Option<LinkageFile>,
    }
}

record! {
    /// How a body starts.
    StartFile {
        /// Velocity of the center of mass.
        velocity: Option<VelocityFile>,
        /// Angular velocity, counterclockwise.
        spin: Option<Formula>,
    }
}

record! {
    /// A collision or blow.
    ImpactFile {
        /// Hinges by name.
        hinges: Option<Map<HingeFile>>,
        /// Contacts by name.
        contacts: Option<Map<ContactFile>>,
        /// Supports by name: they push the second body along `normal`, or not at all, and nothing rebounds from them.
        supports: Option<Map<SupportFile>>,
        /// Strings by name: they pull the second body along `normal`, or not at all.
        strings: Option<Map<SupportFile>>,
        /// Names of the supports and strings that are supposed to act. Missing: every possibility is told.
        supposing: Option<Vec<Text>>,
        /// Impulses from outside, by name.
        blows: Option<Map<BlowFile>>,
        /// What is known of the motion just after, in place of a law.
        after: Option<Vec<KnownFile>>,
        /// Finite forces that act too.
        forces: Option<Vec<ForceFile>>,
    }
}

record! {
    /// Something that acts one way only.
    SupportFile {
        /// Names of the two bodies; one may be fixed.
        bodies: Pair<Text>,
        /// Where it acts. Missing: as of a contact, where the particle of the two is, or where the normal leaves what is round.
        at: Option<PositionFile>,
        /// Direction in which the second body is pushed or pulled.
        normal: DirectionFile,
    }
}

choice! {
    /// Where a rotation ends.
    pub(super) UntilName {
        /// The center of mass straight above the point.
        Above = "above",
        /// The center of mass straight below the point.
        Below = "below",
        /// The body at rest, before it turns back or stays.
        Stops = "stops",
    }
}

record! {
    /// Rotation about a fixed point; its end is given by one of `by`, `until` and `for`.
    TurnFile {
        /// Name of the body.
        body: Text,
        /// Names of bodies that are fixed to it and turn along. A particle that an impact before has made stick need not be named.
        with: Option<Vec<Text>>,
        /// The fixed point; without it the one hinge that holds the body.
        about: Option<PositionFile>,
        /// Angle turned through, in the sense of the rotation.
        by: Option<Formula>,
        /// Where the center of mass is at the end.
        until: Option<UntilName>,
        /// Time; not under gravity, which leaves no closed form.
        time as "for": Option<Formula>,
        /// Whether it turns clockwise. Missing: as it begins.
        clockwise: Option<bool>,
        /// Gravity, such as "g", where weight does work.
        gravity: Option<Formula>,
        /// Constant moment in the sense of the rotation.
        torque: Option<Formula>,
    }
}

choice! {
    /// Where a motion along a line ends.
    pub(super) SlideEndName {
        /// The body comes to rest.
        Stops = "stops",
        /// The point of contact of a round body no longer slips.
        Rolls = "rolls",
        /// The body moves with the one that it slides `on`.
        Together = "together",
    }
}

record! {
    /// Motion along a straight line; its end is given by one of `distance`, `for` and `until`.
    SlideFile {
        /// Name of the body.
        body: Text,
        /// Names of bodies that move along with it, such as a rider. What an impact before has made stick need not be named.
        with: Option<Vec<Text>>,
        /// Direction.
        along: DirectionFile,
        /// Distance; along the body that it slides `on`, where that is given.
        distance: Option<Formula>,
        /// Time.
        time as "for": Option<Formula>,
        /// What ends the motion.
        until: Option<SlideEndName>,
        /// Gravity, such as "g", where weight does work or presses the body on a rough surface.
        gravity: Option<Formula>,
        /// Constant force in that direction, at the center of mass.
        force: Option<Formula>,
        /// Coefficient of sliding friction of the surface below the body; a disk, ring or sphere turns on it, and
        /// keeps its spin where it is 0.
        friction: Option<Formula>,
        /// The body whose surface that is, such as a plank or a cart, where it moves too; the direction is then that in which the
        /// body slides along it; a disk, ring or sphere slips on it until it rolls.
        on: Option<CarrierFile>,
        /// A light spring along the line, which the body presses or stretches.
        spring: Option<SpringFile>,
        /// Whether a disk, ring or sphere rolls on the surface below it without slipping, however much friction that takes.
        rolling: Option<bool>,
        /// Whether the scene is seen from above: gravity presses the body on a level surface, and pulls it nowhere.
        level: Option<bool>,
        /// Whether the way bends gently into this line from where the body came, so that it keeps its speed.
        bend: Option<bool>,
        /// Light inextensible strings from the body over pulleys to other bodies, taut all the while.
        strings: Option<Vec<StrungFile>>,
    }
}

record! {
    /// A light spring with its fixed end ahead of or behind a body on a line.
    SpringFile {
        /// Force by length.
        stiffness: Formula,
        /// Where it is relaxed: so far ahead of the beginning, along the direction. Missing: at the beginning, as where a body comes
        /// upon it; positive where it is pressed and pushes the body on, negative where it holds it back from the beginning.
        relaxed: Option<Formula>,
    }
}

record! {
    /// A body on a floor, with another that slides on it; or a belt.
    CarrierFile {
        /// Name of the body. A belt is a fixed one with a `velocity`, and nothing else is said of it here.
        body: Text,
        /// Names of bodies that move along with it.
        with: Option<Vec<Text>>,
        /// Coefficient of sliding friction of the floor below it. Missing: the floor is smooth.
        friction: Option<Formula>,
        /// Constant force on it along the direction of the slide, at the center of mass; negative against it.
        force: Option<Formula>,
    }
}

record! {
    /// A string over pulleys, and what moves at its other end.
    StrungFile {
        /// Names of the bodies at the other end; they move as one.
        to: Vec<Text>,
        /// Direction in which they move while the body moves along its own.
        along: DirectionFile,
        /// Names of one or two pulleys, from the body on: disks or rings whose centers stay, of mass "0" where they are light
        /// or smooth. The string runs along their rims.
        over: Vec<Text>,
        /// Name of a movable pulley, a disk or ring that hangs in the string with `to` on its axle; behind it the string is
        /// fastened. They move half as fast as the body.
        under: Option<Text>,
        /// Coefficient of sliding friction of a surface below what moves at the other end.
        friction: Option<Formula>,
    }
}

choice! {
    /// Where a flight ends.
    pub(super) FlightEndName {
        /// At its highest point.
        Top = "top",
    }
}

record! {
    /// Free fall, or free flight where no gravity is given; it ends after one of `height`, `range`, `by` and `for`, or `until`
    /// its top. What an impact has stuck together turns about its common center of mass.
    FallFile {
        /// Name of the body.
        body: Text,
        /// Names of bodies that fall or fly at the same time, each on its own or stuck to another of them.
        with: Option<Vec<Text>>,
        /// Gravity, such as "g".
        gravity: Option<Formula>,
        /// How far the center of mass is then below its place at the beginning; above it if negative.
        height: Option<Formula>,
        /// Whether it passes that height on its way up, as where it hits a ceiling. Missing: on its way down.
        rising: Option<bool>,
        /// How far the center of mass is then to the right of its place at the beginning; to the left of it if negative.
        range: Option<Formula>,
        /// Angle through which it has turned then, in the sense in which it spins.
        by: Option<Formula>,
        /// Time.
        time as "for": Option<Formula>,
        /// The top of the flight.
        until: Option<FlightEndName>,
    }
}

record! {
    /// A rope that winds round a thin pole.
    WindFile {
        /// Name of the particle at its end.
        body: Text,
        /// The pole.
        around: PositionFile,
        /// Free length at the end.
        to: Formula,
    }
}

record! {
    /// Bodies with one freedom, on joints and guides without friction: every body whose place in `bodies` depends on the
    /// coordinate moves as the coordinate goes from one value to another.
    LinkageFile {
        /// Name of the parameter that is the coordinate, an angle or a length.
        coordinate: Text,
        /// Its value at the beginning. Missing: the parameter itself.
        from: Option<Formula>,
        /// Its value at the end.
        to: Formula,
        /// Gravity, such as "g".
        gravity: Option<Formula>,
    }
}

record! {
    /// A body on a spring, struck by a force that stays the same while it lasts.
    ShareFile {
        /// Mass of the body.
        mass: Formula,
        /// Stiffness of the spring.
        stiffness: Formula,
        /// How long the blow lasts.
        during: Formula,
    }
}

choice! {
    /// Beginning or end of a stage.
    pub(super) EndName {
        /// At the beginning.
        Start = "start",
        /// At the end.
        End = "end",
    }
}

impl ImpactFile {
    /// Names of everything that holds or touches.
    pub fn places(&self) -> Vec<&Text> {
        let joints = [keys(self.contacts.as_ref()), keys(self.hinges.as_ref())];
        let one_sided = [keys(self.supports.as_ref()), keys(self.strings.as_ref())];
        joints.into_iter().chain(one_sided).flatten().collect()
    }
}

pub(super) fn stage_named(
    faults: &mut Vec<Fault>,
    stages: &[StageFile],
    name: Option<&Text>,
) -> Option<usize> {
    let Some(name) = name else {
        return stages.len().checked_sub(1);
    };
    let found = stages.iter().position(|s| s.name.text == name.text);
    if found.is_none() {
        let fault = Fault::new(name.span, format!("there is no stage `{}`", name.text));
        faults.push(
            match nearest(&name.text, stages.iter().map(|s| s.name.text.as_str())) {
                Some(near) => fault.hint(format!("did you mean `{near}`?")),
                None => {
                    let names = stages.iter().map(|s| s.name.text.as_str());
                    fault.hint(format!("there is {}", names.collect::<Vec<_>>().join(", ")))
                }
            },
        );
    }
    found
}
