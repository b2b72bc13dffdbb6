//! What is asked of a scene: of an impact, of a motion, of the answers; and the curves to be drawn. Types only.

use super::{EnergyWhen, FrictionEvent, Turns};
use crate::dimension::Dimension;
use crate::expr::{Expr, Point, Symbol, Vector};
use crate::formula::Relation;

/// Something asked of the scene.
#[derive(Clone, Debug)]
pub struct Question {
    /// Name of the answer; a vector's components are `name_x` and `name_y`.
    pub name: String,
    /// How the name is typeset.
    pub latex: Option<String>,
    /// Index of the stage that is asked about; `None` in a scene without stages, and for a question about answers alone.
    pub stage: Option<usize>,
    /// What is asked.
    pub ask: Ask,
    /// Asked by carom itself, to find out which supports act and what is lost; not answered to the reader.
    pub hidden: bool,
}

impl Question {
    /// A question to be answered to the reader, about no stage in particular.
    pub fn new(name: &str, latex: Option<String>, ask: Ask) -> Question {
        Question {
            name: name.to_string(),
            latex,
            stage: None,
            ask,
            hidden: false,
        }
    }

    /// What of it a name says: all, or a component, 0 for x and 1 for y.
    pub fn part(&self, name: &str) -> Option<Option<usize>> {
        match name.strip_prefix(self.name.as_str())? {
            "" => Some(None),
            "_x" => Some(Some(0)),
            "_y" => Some(Some(1)),
            _ => None,
        }
    }
}

/// The kinds of question: about an impact, about a motion, about answers (their formulas may hold names of earlier ones), and
/// in words.
#[derive(Clone, Debug)]
pub enum Ask {
    /// Velocity just after of the point of `body` at `at` (the center of mass if `None`), a vector, or its component.
    Velocity {
        /// Index of the body.
        body: usize,
        /// Name and position of the point.
        point: Option<(String, Vector)>,
        /// Direction for a component.
        along: Option<Vector>,
    },
    /// Angular velocity just after; counterclockwise positive unless `clockwise`.
    Spin {
        /// Index of the body.
        body: usize,
        /// Count clockwise as positive.
        clockwise: bool,
    },
    /// Impulse at a contact, hinge or blow, on `on`, a vector, or its component.
    Impulse {
        /// What transmits it.
        from: ImpulseAt,
        /// Index of the body it acts on.
        on: usize,
        /// Direction for a component.
        along: Option<Vector>,
    },
    /// Kinetic energy of one body, or of all.
    Energy {
        /// Before, after, or the loss.
        when: EnergyWhen,
        /// Index of the body; `None` for all.
        of: Option<usize>,
    },
    /// Linear momentum of a system before = after along a direction, as an equation.
    Balance {
        /// Indices of the bodies.
        system: Vec<usize>,
        /// Direction.
        along: Vector,
    },
    /// The matrix form of the equations that determine these component unknowns.
    Matrix {
        /// Names of balance questions or of entries of [`super::Scene::after`], in order of rows.
        rows: Vec<String>,
        /// Names of component questions, in order of columns.
        unknowns: Vec<String>,
    },
    /// Force of the fixed point on a turning body, or of the surface on what slides or rolls, along a direction.
    Reaction {
        /// Direction.
        along: Vector,
        /// At the end of the stage; else at its beginning.
        at_end: bool,
    },
    /// Angular momentum of a body about a point.
    AngularMomentum {
        /// Index of the body.
        body: usize,
        /// The point.
        about: Vector,
        /// The body whose center of mass it is, wherever that is by then.
        center_of: Option<usize>,
        /// At the end of the stage; else at its beginning.
        at_end: bool,
    },
    /// Angular acceleration of a body in a rotation or a linkage.
    AngularAcceleration {
        /// Index of the body.
        body: usize,
        /// Counted clockwise.
        clockwise: bool,
        /// At the end of the stage; else at its beginning.
        at_end: bool,
    },
    /// Acceleration of a body, or of a point of it, along a direction in a rotation or a linkage.
    PointAcceleration {
        /// Index of the body.
        body: usize,
        /// Name of the point, as the file puts it on the body; `None` for the center of mass.
        point: Option<String>,
        /// Direction.
        along: Vector,
        /// At the end of the stage; else at its beginning.
        at_end: bool,
    },
    /// How long a motion lasts.
    Time,
    /// How far a motion along a line leads.
    Distance,
    /// The angle through which a body turns in a motion.
    Angle {
        /// Index of the body.
        body: usize,
        /// Count clockwise as positive.
        clockwise: bool,
    },
    /// Where the center of mass of a body is, a vector, or its component.
    Position {
        /// Index of the body.
        body: usize,
        /// Direction for a component.
        along: Option<Vector>,
        /// At the end of the stage; else at its beginning.
        at_end: bool,
    },
    /// A formula of earlier answers, with parameters replaced.
    Value {
        /// The formula.
        formula: Expr,
        /// Parameters and what stands for them.
        with: Vec<(Symbol, Expr)>,
        /// What it is, such as the speed of a body; empty for a formula that a scene writes itself.
        meaning: String,
        /// Its dimension, where what it is tells that.
        dimension: Option<Dimension>,
        /// Of the direction of a velocity, whose angle the formula is: the components, along x and y.
        polar: Option<Vector>,
    },
    /// The coefficient of friction from which a contact sticks or jams, or up to which it slides.
    Friction {
        /// Index of the contact.
        contact: usize,
        /// What happens there.
        event: FrictionEvent,
    },
    /// Where an inequality holds, or an equation: the value of a parameter at which its sides meet.
    Condition {
        /// The parameter.
        parameter: Symbol,
        /// Left side.
        left: Expr,
        /// Relation.
        relation: Relation,
        /// Right side.
        right: Expr,
        /// Parameters and what stands for them.
        with: Vec<(Symbol, Expr)>,
    },
    /// The largest or the least value over parameters within their domains.
    Extremum {
        /// Which of the two.
        which: Extremum,
        /// What is to be largest, or least.
        of: Expr,
        /// The parameters.
        over: Vec<Symbol>,
    },
    /// The value a formula tends to.
    Limit {
        /// The formula.
        of: Expr,
        /// The parameter that tends.
        parameter: Symbol,
        /// To what; `None` beyond all bounds.
        to: Option<Expr>,
    },
    /// What a formula is near a value of a parameter, as a polynomial in the small difference.
    Approximate {
        /// The formula.
        of: Expr,
        /// The parameter that is near `to`.
        parameter: Symbol,
        /// The value it is near to.
        to: Expr,
        /// Highest power of the difference; `None` asks for the leading term.
        order: Option<u32>,
    },
    /// An identity or inequality to be proved.
    Show {
        /// Left side.
        left: Expr,
        /// How it stands to the right side.
        relation: Relation,
        /// Right side.
        right: Expr,
        /// Parameters and what stands for them.
        with: Vec<(Symbol, Expr)>,
        /// Answers, single or with two components, that must not vanish for the statement to mean something.
        unless: Vec<Symbol>,
        /// What the identity says, in words; may be empty.
        claim: String,
    },
    /// The share of a blow of constant force that a spring takes while the blow lasts.
    Share {
        /// Mass of the body that is struck \[kg\].
        mass: Expr,
        /// Stiffness of the spring \[N/m\].
        stiffness: Expr,
        /// How long the blow lasts \[s\].
        during: Expr,
    },
    /// What a formula of the answers of one turn comes to in the turn of any number, or its sum over the turns up to that one.
    Turn {
        /// The parameter that counts the turns, from 1.
        number: Symbol,
        /// The group that is repeated.
        turns: Turns,
        /// The formula in the answers of each turn that is written out.
        of: Vec<Expr>,
        /// Summed up.
        total: bool,
    },
    /// Acceleration of a body along its own way, in a motion along a line; along that line where one body slides on another.
    Acceleration {
        /// Index of the body.
        body: usize,
        /// Whether at the end of the stage; at its beginning otherwise. On a spring it changes on the way.
        at_end: bool,
    },
    /// Pull of the string at a body, in a motion along a line.
    Tension {
        /// Index of the body.
        body: usize,
    },
    /// Which forces have an impulse in this stage, and why.
    Impulsive,
    /// What happens in this stage, in words.
    Describe,
    /// What the laws of this stage leave undetermined, and what would close them.
    Missing,
    /// Words of the scene's author; nothing is derived.
    Remark(String),
    /// What is assumed.
    Assumed,
    /// Which given data an earlier answer, by name, does not need.
    Unused(String),
}

impl Ask {
    /// The dimension of what is asked for; that of a number where only the answer tells.
    pub fn dimension(&self) -> Dimension {
        match self {
            Ask::Velocity { .. } => Dimension::new(0, 1, -1),
            Ask::Spin { .. } => Dimension::new(0, 0, -1),
            Ask::Impulse { .. } | Ask::Balance { .. } => Dimension::new(1, 1, -1),
            Ask::Energy { .. } => Dimension::new(1, 2, -2),
            Ask::Reaction { .. } | Ask::Tension { .. } => Dimension::new(1, 1, -2),
            Ask::Acceleration { .. } | Ask::PointAcceleration { .. } => Dimension::new(0, 1, -2),
            Ask::AngularAcceleration { .. } => Dimension::new(0, 0, -2),
            Ask::Time => Dimension::new(0, 0, 1),
            Ask::Distance | Ask::Position { .. } => Dimension::new(0, 1, 0),
            Ask::AngularMomentum { .. } => Dimension::new(1, 2, -1),
            _ => Dimension::none(),
        }
    }

    /// Whether it is about the motion just after an impact or at the end of a motion, about how long and how far it went, or
    /// about the impulses and equations of an impact.
    pub fn is_motion(&self) -> bool {
        matches!(
            self,
            Ask::Velocity { .. }
                | Ask::Spin { .. }
                | Ask::Impulse { .. }
                | Ask::Energy { .. }
                | Ask::Balance { .. }
                | Ask::Matrix { .. }
                | Ask::Time
                | Ask::Distance
                | Ask::Acceleration { .. }
                | Ask::PointAcceleration { .. }
                | Ask::AngularAcceleration { .. }
                | Ask::Tension { .. }
                | Ask::Angle { .. }
                | Ask::Position { .. }
        )
    }

    /// The formulas of answers in it; none where it is not about answers.
    pub fn formulas(&self) -> Vec<&Expr> {
        match self {
            Ask::Value { formula, .. } => vec![formula],
            Ask::Condition { left, right, .. } | Ask::Show { left, right, .. } => {
                vec![left, right]
            }
            Ask::Extremum { of, .. } => vec![of],
            Ask::Limit { of, to, .. } => std::iter::once(of).chain(to).collect(),
            Ask::Approximate { of, to, .. } => vec![of, to],
            _ => Vec::new(),
        }
    }

    /// The number of a value where the names in it have these: of a direction whichever way its angle is written.
    pub fn value(&self, names: &Point<f64>) -> Option<f64> {
        match self {
            Ask::Value {
                polar: Some([x, y]),
                ..
            } => {
                let [x, y] = [x.evaluate(names)?, y.evaluate(names)?];
                // What is at rest moves in no direction.
                (x != 0.0 || y != 0.0).then(|| y.atan2(x))
            }
            Ask::Value { formula, .. } => formula.evaluate(names),
            _ => None,
        }
    }

    /// The SI unit of what it asks for, which has this dimension, as a person says it.
    pub fn unit(&self, dimension: &Dimension) -> String {
        match (self, dimension.spoken()) {
            // The square of an angular velocity is no angular acceleration.
            (Ask::Value { formula, .. }, spoken)
                if spoken == "rad/s²" && formula.as_symbol().is_none() =>
            {
                dimension.si()
            }
            (_, spoken) => spoken,
        }
    }

    /// Whether it asks for an angle.
    pub fn is_angle(&self) -> bool {
        matches!(self, Ask::Angle { .. } | Ask::Value { polar: Some(_), .. })
    }

    /// Whether it counts a turn clockwise.
    pub fn is_clockwise(&self) -> bool {
        match self {
            Ask::Spin { clockwise, .. }
            | Ask::Angle { clockwise, .. }
            | Ask::AngularAcceleration { clockwise, .. } => *clockwise,
            _ => false,
        }
    }

    /// What it puts in for parameters.
    pub fn with(&self) -> &[(Symbol, Expr)] {
        match self {
            Ask::Value { with, .. } | Ask::Condition { with, .. } | Ask::Show { with, .. } => with,
            _ => &[],
        }
    }

    /// Whether it is about the end of its stage, and not about its beginning.
    pub fn is_at_end(&self) -> bool {
        match self {
            Ask::Reaction { at_end, .. }
            | Ask::Position { at_end, .. }
            | Ask::Acceleration { at_end, .. }
            | Ask::AngularAcceleration { at_end, .. }
            | Ask::PointAcceleration { at_end, .. }
            | Ask::AngularMomentum { at_end, .. } => *at_end,
            _ => true,
        }
    }

    /// Places and directions in it.
    pub fn vectors(&self) -> Vec<&Vector> {
        match self {
            Ask::Velocity { point, along, .. } => {
                point.iter().map(|(_, at)| at).chain(along).collect()
            }
            Ask::Impulse { along, .. } | Ask::Position { along, .. } => along.iter().collect(),
            Ask::Balance { along, .. }
            | Ask::Reaction { along, .. }
            | Ask::PointAcceleration { along, .. } => vec![along],
            Ask::AngularMomentum { about, .. } => vec![about],
            _ => Vec::new(),
        }
    }

    /// The same, to be changed.
    pub(super) fn vectors_mut(&mut self) -> Vec<&mut Vector> {
        match self {
            Ask::Velocity { point, along, .. } => {
                let at = point.iter_mut().map(|(_, at)| at);
                at.chain(along).collect()
            }
            Ask::Impulse { along, .. } | Ask::Position { along, .. } => along.iter_mut().collect(),
            Ask::Balance { along, .. }
            | Ask::Reaction { along, .. }
            | Ask::PointAcceleration { along, .. } => vec![along],
            Ask::AngularMomentum { about, .. } => vec![about],
            _ => Vec::new(),
        }
    }
}

/// Which of its values a formula is to have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extremum {
    /// The largest.
    Largest,
    /// The least.
    Least,
}

impl Extremum {
    /// Its name.
    pub fn word(self) -> &'static str {
        match self {
            Extremum::Largest => "largest",
            Extremum::Least => "least",
        }
    }

    /// The kind of a question and of a check.
    pub fn kind(self) -> &'static str {
        match self {
            Extremum::Largest => "maximum",
            Extremum::Least => "minimum",
        }
    }

    /// The sign of the second derivative, in words.
    pub fn bend(self) -> &'static str {
        match self {
            Extremum::Largest => "negative",
            Extremum::Least => "positive",
        }
    }

    /// What is the larger, the better a value is: the value, or its negative.
    pub fn merit(self, value: &Expr) -> Expr {
        match self {
            Extremum::Largest => value.clone(),
            Extremum::Least => -value,
        }
    }
}

/// What transmits an impulse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImpulseAt {
    /// Index of a contact.
    Contact(usize),
    /// Index of a hinge.
    Hinge(usize),
    /// Index of a blow.
    Blow(usize),
}

/// A picture that is asked for: a quantity against a parameter.
#[derive(Clone, Debug)]
pub struct PlotAsk {
    /// Name.
    pub name: String,
    /// Heading; may be empty.
    pub title: String,
    /// The quantity, in parameters and answers.
    pub quantity: Expr,
    /// What is written at its axis; `None` for the formula itself.
    pub label: Option<String>,
    /// What it is drawn against: a parameter, or a name for `stands_for`.
    pub against: Symbol,
    /// What the name stands for, and the parameter that varies.
    pub stands_for: Option<(Expr, Symbol)>,
    /// Smallest value shown.
    pub from: Expr,
    /// Largest value shown.
    pub to: Expr,
    /// One curve for each: parameters and what stands for them. Never empty; an entry may be.
    pub curves: Vec<Vec<(Symbol, Expr)>>,
}
