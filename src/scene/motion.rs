//! Motions of a stage: rotations, slides, falls, what winds round a pole, linkages. Types only.

use super::Scene;
use crate::expr::{Expr, Symbol, Vector};

/// Rotation of a body about a fixed point, between two configurations.
#[derive(Clone, Debug)]
pub struct Turn {
    /// Index of the body.
    pub body: usize,
    /// Indices of bodies that are fixed to it and turn along.
    pub with: Vec<usize>,
    /// The fixed point \[m\].
    pub about: Vector,
    /// What the file calls it.
    pub about_name: String,
    /// Where the stage ends.
    pub until: Until,
    /// Sense of the rotation, where the file tells it.
    pub clockwise: Option<bool>,
    /// Gravity g \[m/s²\], downwards.
    pub gravity: Option<Expr>,
    /// Constant moment about the point \[N m\], positive in the sense of the rotation.
    pub torque: Option<Expr>,
}

/// Bodies that move as one.
#[derive(Clone, Debug)]
pub struct Lump {
    /// Mass \[kg\].
    pub mass: Expr,
    /// Center of mass \[m\].
    pub center: Vector,
}

impl Turn {
    /// All bodies that turn.
    pub fn bodies(&self) -> Vec<usize> {
        [&[self.body], self.with.as_slice()].concat()
    }

    /// The bodies that turn as one, where they are in the scene.
    pub fn lump(&self, scene: &Scene) -> Lump {
        let first = &scene.bodies[self.body];
        if self.with.is_empty() {
            return Lump {
                mass: first.mass.clone(),
                center: first.center.clone(),
            };
        }
        let all: Vec<&super::Body> = self.bodies().iter().map(|b| &scene.bodies[*b]).collect();
        let mass = Expr::sum(all.iter().map(|b| b.mass.clone()));
        let center = [0, 1].map(|axis| {
            let moments = all.iter().map(|b| &b.mass * &b.center[axis]);
            &Expr::sum(moments) / &mass
        });
        Lump { mass, center }
    }
}

/// Where a rotation ends.
#[derive(Clone, Debug)]
pub enum Until {
    /// After turning through this angle \[rad\], counted in the sense of the rotation.
    By(Expr),
    /// When the center of mass is straight above the point.
    Above,
    /// When the center of mass is straight below the point.
    Below,
    /// When it comes to rest.
    Stops,
    /// After this time \[s\]; not under weight, which leaves no closed form.
    For(Expr),
}

/// Motion of a body along a straight line under constant forces: on a guide, or on a surface below it.
#[derive(Clone, Debug)]
pub struct Slide {
    /// Index of the body.
    pub body: usize,
    /// Indices of bodies that move along with it.
    pub with: Vec<usize>,
    /// Direction.
    pub along: Vector,
    /// How the stage ends.
    pub until: SlideEnd,
    /// Gravity g \[m/s²\], downwards; away from the reader where the surface is level.
    pub gravity: Option<Expr>,
    /// Whether the scene is seen from above, and the surface is level.
    pub level: bool,
    /// Whether the way bends gently into the line: the bodies begin along it with the speed that they have.
    pub bend: bool,
    /// Constant force along the direction, at the center of mass \[N\].
    pub force: Option<Expr>,
    /// Coefficient of sliding friction μ of the surface; `None` for a smooth guide.
    pub friction: Option<Expr>,
    /// The body whose surface that is, where it moves too; the direction is then that of the slip on it.
    pub on: Option<Box<Carrier>>,
    /// A light spring along the line.
    pub spring: Option<Spring>,
    /// Whether a round body rolls, by as much friction as that takes.
    pub rolling: bool,
    /// Light inextensible strings from the body to others.
    pub strings: Vec<Strung>,
}

impl Slide {
    /// All bodies that move, pulleys last.
    pub fn bodies(&self) -> Vec<usize> {
        let ends = self.strings.iter().flat_map(Strung::hung);
        let all = self.company().into_iter().chain(ends);
        let below = self.on.iter().flat_map(|on| on.company());
        all.chain(below).chain(self.pulleys()).collect()
    }

    /// The body and those that move along with it.
    pub fn company(&self) -> Vec<usize> {
        [&[self.body], self.with.as_slice()].concat()
    }

    /// What keeps the body on its line.
    pub fn support(&self) -> &'static str {
        match self.rolling || self.friction.is_some() {
            true => "surface",
            false => "guide",
        }
    }

    /// Whether the surface is told to be smooth, so that a round body keeps its spin on it.
    pub fn is_smooth(&self) -> bool {
        self.friction.as_ref().is_some_and(Expr::is_zero)
    }

    /// The pulleys of all strings whose centers stay.
    pub fn pulleys(&self) -> impl Iterator<Item = usize> {
        self.strings.iter().flat_map(|s| s.over.iter().copied())
    }
}

/// A body on a level or inclined floor, with another that slides on it.
#[derive(Clone, Debug)]
pub struct Carrier {
    /// Index of the body.
    pub body: usize,
    /// Indices of bodies that move along with it.
    pub with: Vec<usize>,
    /// Coefficient of sliding friction of the floor; `None` for a smooth one.
    pub friction: Option<Expr>,
    /// Constant force on it along the direction of the slide, at the center of mass \[N\].
    pub force: Option<Expr>,
}

impl Carrier {
    /// Whether it is a belt, which runs with a prescribed velocity.
    pub fn is_belt(&self, scene: &Scene) -> bool {
        scene.bodies[self.body].is_fixed()
    }

    /// The body and those that move along with it.
    pub fn company(&self) -> Vec<usize> {
        [&[self.body], self.with.as_slice()].concat()
    }
}

/// A light spring along a line: its force on a body that has gone the way s is k (relaxed − s) along the direction.
#[derive(Clone, Debug)]
pub struct Spring {
    /// Stiffness k \[N/m\].
    pub stiffness: Expr,
    /// The way at which it is relaxed \[m\].
    pub relaxed: Expr,
}

/// Bodies at the other end of a string that runs from a body on a line over pulleys, without slipping on them.
#[derive(Clone, Debug)]
pub struct Strung {
    /// Indices of the bodies; they move as one.
    pub to: Vec<usize>,
    /// Their velocity where the body moves along its own direction at the speed 1: a unit vector, or half of one on a movable
    /// pulley.
    pub along: Vector,
    /// Indices of the pulleys whose centers stay, from the body on.
    pub over: Vec<usize>,
    /// Index of the movable pulley on whose axle the bodies hang; behind it the string is fastened.
    pub under: Option<usize>,
    /// Coefficient of sliding friction of a surface below them; `None` for a smooth guide, or where they hang.
    pub friction: Option<Expr>,
}

impl Strung {
    /// What moves along the line of the other end: the bodies there, and a movable pulley.
    pub fn hung(&self) -> impl Iterator<Item = usize> {
        self.to.iter().copied().chain(self.under)
    }

    /// Their speed where the body has the speed 1.
    pub fn ratio(&self) -> Expr {
        Expr::ratio(1, if self.under.is_some() { 2 } else { 1 })
    }
}

/// How a motion along a line ends.
#[derive(Clone, Debug)]
pub enum SlideEnd {
    /// After this distance \[m\], along the body below where that moves.
    Distance(Expr),
    /// After this time \[s\].
    Time(Expr),
    /// When the body comes to rest.
    Stops,
    /// When the point of contact of a round body no longer slips.
    Rolls,
    /// When the body moves with the one below it.
    Together,
}

/// Free fall, or free flight where there is no gravity.
#[derive(Clone, Debug)]
pub struct Fall {
    /// Index of the body whose way ends the stage.
    pub body: usize,
    /// Indices of bodies that fall or fly at the same time, each on its own or stuck to another of them.
    pub with: Vec<usize>,
    /// Gravity g \[m/s²\], downwards; `None` for free flight.
    pub gravity: Option<Expr>,
    /// How the stage ends.
    pub until: FallEnd,
    /// Whether the body passes the height at which it ends on its way up, and not on its way down.
    pub rising: bool,
    /// Pairs of these bodies that an earlier impact has joined, for whoever follows this stage by itself.
    pub stuck: Vec<[usize; 2]>,
}

impl Fall {
    /// All bodies that fall.
    pub fn bodies(&self) -> Vec<usize> {
        [&[self.body], self.with.as_slice()].concat()
    }
}

/// How a fall ends.
#[derive(Clone, Debug)]
pub enum FallEnd {
    /// When the center of mass is so far below its place at the beginning \[m\]; above it if negative.
    Drop(Expr),
    /// When the center of mass is so far to the right of its place at the beginning \[m\]; to the left of it if negative.
    Range(Expr),
    /// When it has turned through this angle in the sense in which it spins \[rad\].
    Turned(Expr),
    /// After this time \[s\].
    Time(Expr),
    /// When the center of mass rises no more.
    Top,
}

/// A rope that winds round a pole.
#[derive(Clone, Debug)]
pub struct Wind {
    /// Index of the particle.
    pub body: usize,
    /// The pole \[m\].
    pub around: Vector,
    /// Free length at the end \[m\].
    pub to: Expr,
}

/// Bodies with one freedom: joints and guides without friction leave them no other places than those that the file gives for
/// each value of a coordinate.
#[derive(Clone, Debug)]
pub struct Linkage {
    /// The coordinate, a parameter of the scene.
    pub coordinate: Symbol,
    /// Its values at the beginning and at the end.
    pub ends: [Expr; 2],
    /// Index of each body that moves with it, with center x, y \[m\] and angle \[rad\] as the file has them.
    pub places: Vec<(usize, [Expr; 3])>,
    /// Gravity g \[m/s²\], downwards.
    pub gravity: Option<Expr>,
}

impl Linkage {
    /// An expression at a value of the coordinate.
    pub fn at(&self, e: &Expr, value: &Expr) -> Expr {
        e.put(&self.coordinate, value)
    }
}
