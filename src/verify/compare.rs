//! Laws of contact laid side by side at the values of one scene: what each gives, and what its energy says.
//!
//! In: a scene with friction whose parameters have values. Out: for each law the impulse, the motion just after, the mode
//! and the energy; all of it followed in numbers, in fractions where there are any.

use super::friction::{AtValues, at_values_of};
use crate::expr::number::to_f64;
use crate::expr::{Expr, Point, Rational};
use crate::numeric::friction::{Followed, happened};
use crate::numeric::path::NoPath;
use crate::numeric::{self, Given, NoAnswer, NoPoint, Number};
use crate::scene::{ContactLaw, ContactSpace, Friction, Hypothesis, Mode, Scene};

/// Laws side by side.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Index of the contact.
    pub contact: usize,
    /// What the contact feels.
    pub space: ContactSpace<f64>,
    /// Coefficient of friction.
    pub mu: f64,
    /// One row for each law.
    pub rows: Vec<Row>,
}

/// What one law gives.
#[derive(Clone, Debug)]
pub struct Row {
    /// Its name.
    pub law: &'static str,
    /// The outcome, or why there is none.
    pub outcome: Result<Outcome, NoPath>,
}

/// The outcome of an impact.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// What the contact does.
    pub mode: Mode,
    /// Impulse on the second body (P_t, P_n) \[N s\].
    pub impulse: [f64; 2],
    /// The same in fractions, where the law and the values have them.
    pub exact: Option<[Rational; 2]>,
    /// Relative velocity after (u_t⁺, u_n⁺) [m/s].
    pub velocity: [f64; 2],
    /// Motion after of the bodies that can move: index, v_x, v_y, ω.
    pub bodies: Vec<(usize, [f64; 3])>,
    /// Energy.
    pub energy: AtValues,
    /// Corners of the path (P_t, P_n).
    pub corners: Vec<[f64; 2]>,
}

/// Why laws cannot be compared.
#[derive(Clone, Debug, PartialEq)]
pub enum NoComparison {
    /// No contact has friction.
    NoFriction,
    /// A parameter has no value.
    NoPoint(NoPoint),
    /// The scene has no motion at its values.
    NoAnswer(NoAnswer),
}

impl std::fmt::Display for NoComparison {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            NoComparison::NoFriction => f.write_str(
                "laws are compared at a contact with friction, and this scene has none\nhint: give a contact \"law\": \"friction\" with `mu` and `restitution`",
            ),
            NoComparison::NoPoint(NoPoint::Missing(names)) => {
                let list = names.join(", ");
                let name = names.first().map_or("", |n| &**n);
                write!(
                    f,
                    "no value for {list}\nhint: laws are compared in numbers; give values in the scene or with --set {name}=…"
                )
            }
            NoComparison::NoPoint(NoPoint::Irrational(name)) => {
                write!(f, "the value of {name} has no number")
            }
            NoComparison::NoAnswer(why) => write!(f, "{why}"),
        }
    }
}

impl std::error::Error for NoComparison {}

/// Compares the laws at the values of a scene.
pub fn compare(scene: &Scene) -> Result<Comparison, NoComparison> {
    let (contact, law) = scene.friction().ok_or(NoComparison::NoFriction)?;
    let floats = numeric::values(scene).map_err(NoComparison::NoPoint)?;
    let exact = numeric::exact_values(scene).ok();
    let mu = law.mu.evaluate(&floats).unwrap_or(0.0);
    let mut comparison: Option<Comparison> = None;
    for (name, other) in laws(law) {
        let mut scene = scene.clone();
        scene.contacts[contact].law = ContactLaw::Friction(Box::new(other.clone()));
        let in_fractions = exact
            .as_ref()
            .map(|at| row(&scene, at, numeric::solve_exact));
        let found = match in_fractions {
            // A root that is no fraction, and nothing else, sends the law to doubles.
            Some(Ok(found)) => found.with_exact(&other),
            Some(Err(NoAnswer::NoPath(why))) if why.is_physical() => Found::none(why),
            _ => match row(&scene, &floats, numeric::solve_f64) {
                Ok(found) => found.in_doubles(&other),
                Err(NoAnswer::NoPath(why)) => Found::none(why),
                Err(why) => return Err(NoComparison::NoAnswer(why)),
            },
        };
        let outcome = found.outcome;
        if let (None, Some(space)) = (&comparison, found.space) {
            comparison = Some(Comparison {
                contact,
                space,
                mu,
                rows: Vec::new(),
            });
        }
        if let Some(comparison) = &mut comparison {
            comparison.rows.push(Row { law: name, outcome });
        }
    }
    comparison.ok_or(NoComparison::NoAnswer(NoAnswer::NoPath(NoPath::Separating)))
}

/// The laws that are compared: without friction, sticking without rebound, and the five hypotheses.
fn laws(own: &Friction) -> Vec<(&'static str, Friction)> {
    let with = |hypothesis: Hypothesis| Friction {
        hypothesis,
        ..own.clone()
    };
    let frictionless = Friction {
        mu: Expr::zero(),
        ..with(Hypothesis::Newton)
    };
    let tangential = match &own.hypothesis {
        Hypothesis::ChatterjeeRuina { tangential } => tangential.clone(),
        _ => Expr::zero(),
    };
    let ratio = match &own.hypothesis {
        Hypothesis::Brach { ratio } => ratio.clone(),
        _ => None,
    };
    let all = [
        Hypothesis::Poisson,
        Hypothesis::Stronge,
        Hypothesis::Newton,
        Hypothesis::ChatterjeeRuina { tangential },
        Hypothesis::Brach { ratio },
    ];
    let mut laws = vec![("no friction", frictionless)];
    laws.extend(
        all.into_iter()
            .map(|hypothesis| (hypothesis.name(), with(hypothesis))),
    );
    laws
}

/// One impact in one number type.
struct Impact<T> {
    given: Given<T>,
    followed: Followed<T>,
    motion: numeric::Motion<T>,
}

/// The same in doubles.
struct Found {
    space: Option<ContactSpace<f64>>,
    outcome: Result<Outcome, NoPath>,
}

impl Found {
    fn none(why: NoPath) -> Found {
        Found {
            space: None,
            outcome: Err(why),
        }
    }
}

fn row<T: Number + PartialOrd>(
    scene: &Scene,
    at: &Point<T>,
    solve: impl Fn(&numeric::System<T>) -> Result<numeric::Solution<T>, numeric::Contradiction>,
) -> Result<Impact<T>, NoAnswer> {
    let numeric::Solved {
        followed, motion, ..
    } = numeric::solved(scene, at, solve)?;
    Ok(Impact {
        given: numeric::given(scene, at).map_err(NoAnswer::Undefined)?,
        followed: followed.ok_or(NoAnswer::NotANumber)?,
        motion,
    })
}

impl Impact<Rational> {
    fn with_exact(self, law: &Friction) -> Found {
        let exact = self.followed.path.end().impulse.clone();
        let mut found = self.read(law, to_f64);
        if let Ok(outcome) = &mut found.outcome {
            outcome.exact = Some(exact);
        }
        found
    }
}

impl Impact<f64> {
    fn in_doubles(self, law: &Friction) -> Found {
        self.read(law, |x| *x)
    }
}

impl<T: Number + PartialOrd> Impact<T> {
    fn read(&self, law: &Friction, double: impl Fn(&T) -> f64) -> Found {
        let Followed { space, path, .. } = &self.followed;
        let end = path.end();
        let pair = |v: &[T; 2]| [double(&v[0]), double(&v[1])];
        let moving = (0..self.given.bodies.len())
            .filter(|i| self.given.bodies[*i].freedom != numeric::given::Freedom::Fixed);
        let bodies = moving.map(|i| {
            let [x, y] = pair(&self.motion.velocity[i]);
            (i, [x, y, double(&self.motion.spin[i])])
        });
        Found {
            space: Some(ContactSpace {
                a: double(&space.a),
                b: double(&space.b),
                c: double(&space.c),
                tangential: double(&space.tangential),
                normal: double(&space.normal),
            }),
            outcome: Ok(Outcome {
                mode: match happened(&self.given, &self.followed) {
                    _ if law.mu.is_zero() => Mode::Slides,
                    mode if path.slips_at_first() => mode,
                    mode => mode.without_slip(),
                },
                impulse: pair(&end.impulse),
                exact: None,
                velocity: pair(&end.velocity),
                bodies: bodies.collect(),
                energy: at_values_of(&self.given, path, &double),
                corners: path.corners.iter().map(|c| pair(&c.impulse)).collect(),
            }),
        }
    }
}
