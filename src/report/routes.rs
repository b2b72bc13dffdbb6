//! Every route a scene has from its numbers to what is asked: closed forms, small systems, the full system, fractions.
//!
//! In: a scene, and a point with exact values. Out: for each quantity asked a double, and for routes that find the whole
//! motion that too. Routes in doubles see the exact values rounded once, as a program would.

use nalgebra::{DMatrix, DVector};
use num_traits::Zero;
use serde::Serialize;

use super::reduced;
use crate::answer::Form;
use crate::derive::Derivation;
use crate::emit::{Atoms, Program, arranged, as_derived, signs, without_angles};
use crate::expr::number::to_f64;
use crate::expr::{Expr, Int, Point, Rational, Symbol};
use crate::numeric::{
    Given, Motion, Number, Solution, System, answer, assemble, given, lu_scaled, motion, rounded,
    solve_exact,
};
use crate::scene::{Ask, Scene};

/// A way to the numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Route {
    /// The closed form in doubles, operations in the order of the derivation.
    ClosedForm,
    /// The closed form arranged for accuracy.
    Arranged,
    /// Angular momentum about the joints: minimal coordinates.
    AboutJoints,
    /// Effective mass at the joints and contacts.
    EffectiveMass,
    /// The full system, nalgebra's LU as it comes.
    LuRaw,
    /// The same with rows and columns scaled by powers of two.
    LuScaled,
    /// The same with three steps of refinement, residuals in plain doubles.
    LuRefined,
    /// The full system in exact fractions, rounded once.
    Exact,
}

impl Route {
    /// Every route.
    pub const ALL: [Route; 8] = [
        Route::ClosedForm,
        Route::Arranged,
        Route::AboutJoints,
        Route::EffectiveMass,
        Route::LuRaw,
        Route::LuScaled,
        Route::LuRefined,
        Route::Exact,
    ];

    /// In words.
    pub fn words(self) -> &'static str {
        self.row()[0]
    }

    /// In one or two words, for legends.
    pub fn short(self) -> &'static str {
        self.row()[1]
    }

    /// How it gets its numbers.
    pub fn how(self) -> &'static str {
        self.row()[2]
    }

    fn row(self) -> [&'static str; 3] {
        let mut parts = ROWS[self as usize].splitn(3, " | ");
        [(); 3].map(|()| parts.next().unwrap_or_default())
    }
}

/// Each route in words, in one or two for legends, and how it gets its numbers.
const ROWS: [&str; 8] = [
    "closed form | closed form | the formulas above, every operation in doubles as it stands",
    "closed form, arranged | arranged | the same formulas with sums that cancel in double-doubles: the code above, which \
     carom emit writes in every language",
    "about the joints | joints | angular momentum about every joint: a small system for the spins alone, solved at every point",
    "effective mass | eff. mass | impulses from the effective masses at joints and contacts, then velocities",
    "full system, LU | LU | all laws of all bodies as one linear system, solved by LU at every point",
    "full system, LU scaled | LU scaled | the same, rows and columns scaled by powers of two first",
    "full system, LU refined | LU refined | the same with three steps of refinement, residuals in doubles",
    "exact fractions | exact | the same system in fractions, rounded once: carom solve --exact",
];

/// One number asked for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Quantity {
    /// Its name, with `_x` or `_y` for a component.
    pub name: String,
    /// Its question.
    pub question: String,
    /// Whether it is a velocity or spin after.
    #[serde(skip)]
    pub is_motion: bool,
}

/// What a scene asks for, one entry a number.
pub fn quantities(scene: &Scene) -> Vec<Quantity> {
    let mut out = Vec::new();
    for q in scene.asked_of_impact() {
        let is_motion = matches!(q.ask, Ask::Velocity { .. } | Ask::Spin { .. });
        let vector = match &q.ask {
            Ask::Velocity { along, .. } | Ask::Impulse { along, .. } => along.is_none(),
            Ask::Spin { .. } | Ask::Energy { .. } => false,
            _ => continue,
        };
        let suffixes: &[&str] = if vector { &["_x", "_y"] } else { &[""] };
        out.extend(suffixes.iter().map(|s| Quantity {
            name: format!("{}{s}", q.name),
            question: q.name.clone(),
            is_motion,
        }));
    }
    out
}

/// Closed forms as programs, one a quantity.
struct Forms {
    inputs: Vec<Symbol>,
    atoms: Atoms,
    derived: Vec<Program>,
    arranged: Vec<Program>,
}

/// A scene with everything prepared that does not depend on the point.
pub struct Prepared<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// What it asks for.
    pub quantities: Vec<Quantity>,
    forms: Option<Forms>,
}

/// A point in every number type the routes need.
pub struct Place {
    /// Exact values.
    pub exact: Point<Rational>,
    /// The same rounded to doubles.
    pub near: Point<f64>,
    /// The scene in numbers.
    pub given: Given<f64>,
    inputs: Vec<f64>,
}

impl<'a> Prepared<'a> {
    /// Prepares a scene; `derivation` is left out where there is none.
    pub fn new(scene: &'a Scene, derivation: Option<&Derivation>) -> Prepared<'a> {
        let quantities = quantities(scene);
        let forms = derivation.and_then(|d| forms(scene, d, &quantities));
        Prepared {
            scene,
            quantities,
            forms,
        }
    }

    /// A point in all number types; `None` where the scene has no numbers there.
    pub fn place(&self, exact: &Point<Rational>) -> Option<Place> {
        let near = rounded(exact);
        let numbers = given(self.scene, &near).ok()?;
        let inputs = self.forms.as_ref().and_then(|forms| {
            let input = |name: &Symbol| match forms.atoms.iter().find(|(n, _)| n == name) {
                Some((_, of)) => of.evaluate(exact).map(|v| to_f64(&v)),
                None => near.values.get(name).copied(),
            };
            forms.inputs.iter().map(input).collect()
        });
        Some(Place {
            exact: exact.clone(),
            near,
            given: numbers,
            inputs: inputs.unwrap_or_default(),
        })
    }

    /// The exact answers; `None` where the laws leave one open or a value is irrational.
    pub fn truth(&self, at: &Point<Rational>) -> Option<Vec<Rational>> {
        self.solved(at, &given(self.scene, at).ok()?)
    }

    fn solved(&self, at: &Point<Rational>, numbers: &Given<Rational>) -> Option<Vec<Rational>> {
        let system = assemble(numbers);
        let solution = solve_exact(&system).ok()?;
        self.flat(at, numbers, &motion(numbers, &system, &solution))
    }

    /// Structured condition number of each answer: Σ |x_k ∂f/∂x_k| / |f| over the data of the scene (parameters; of an angle
    /// the cosine and the sine), by exact differences with steps of 2⁻¹²⁸ x_k. Infinite where a datum cannot move.
    pub fn conditions(&self, at: &Point<Rational>, truth: &[Rational]) -> Vec<f64> {
        let step = Rational::new(1.into(), Int::from(2).pow(128));
        let larger = |v: &Rational| v + &(v * &step);
        let mut moved: Vec<Point<Rational>> = Vec::new();
        for (name, value) in &at.values {
            let mut near = at.clone();
            near.values.insert(name.clone(), larger(value));
            moved.push(near);
        }
        for (name, (n, unit)) in &at.directions {
            for axis in 0..2 {
                let mut unit = unit.clone();
                unit[axis] = larger(&unit[axis]);
                let mut near = at.clone();
                near.directions.insert(name.clone(), (*n, unit));
                moved.push(near);
            }
        }
        let mut sums = vec![0.0; truth.len()];
        for near in moved {
            let found = self.truth(&near);
            for (q, sum) in sums.iter_mut().enumerate() {
                let change = found.as_ref().map(|f| (&f[q] - &truth[q]) / &step);
                *sum += match change {
                    None => f64::INFINITY,
                    Some(change) if Zero::is_zero(&change) => 0.0,
                    Some(_) if Zero::is_zero(&truth[q]) => f64::INFINITY,
                    Some(change) => to_f64(&(change / &truth[q])).abs(),
                };
            }
        }
        sums
    }

    /// The routes that have an answer at a place.
    pub fn routes(&self, at: &Place) -> Vec<Route> {
        let has = |r: &Route| self.follow(*r, at).is_some();
        Route::ALL.into_iter().filter(has).collect()
    }

    /// The answers by a route, NaN where one has none; `None` where the scene does not have the route.
    pub fn follow(&self, route: Route, at: &Place) -> Option<Vec<f64>> {
        match route {
            Route::ClosedForm | Route::Arranged => {
                let programs = self.programs(route, at)?;
                let mut slots = Vec::new();
                let values = programs.iter().map(|p| p.value(&at.inputs, &mut slots));
                Some(values.collect())
            }
            Route::Exact => Some(self.truth(&at.exact)?.iter().map(to_f64).collect()),
            _ => {
                let system = assemble(&at.given);
                let unknowns = match route {
                    Route::AboutJoints => reduced::about_joints(&at.given, &system)?,
                    Route::EffectiveMass => reduced::effective_mass(&at.given, &system)?,
                    _ => full(route, &system)?,
                };
                let solution = Solution::determined(unknowns);
                Some(self.of_motion(at, &motion(&at.given, &system, &solution)))
            }
        }
    }

    fn programs(&self, route: Route, at: &Place) -> Option<&[Program]> {
        let forms = self.forms.as_ref()?;
        let programs = match route {
            Route::ClosedForm => &forms.derived,
            _ => &forms.arranged,
        };
        (forms.inputs.len() == at.inputs.len()).then_some(programs)
    }

    /// A closure that does the work of a route once, from the numbers of the scene to its answers; what came before the
    /// numbers (sines, positions from formulas) is not counted for any route.
    pub fn work<'b>(&'b self, route: Route, at: &'b Place) -> Option<Box<dyn FnMut() -> f64 + 'b>> {
        Some(match route {
            Route::ClosedForm | Route::Arranged => {
                let programs = self.programs(route, at)?;
                let mut slots = Vec::new();
                Box::new(move || {
                    let values = programs.iter().map(|p| p.value(&at.inputs, &mut slots));
                    values.sum()
                })
            }
            Route::Exact => {
                let numbers = given(self.scene, &at.exact).ok()?;
                Box::new(move || {
                    let found = self.solved(&at.exact, &numbers);
                    found.map_or(f64::NAN, |v| v.iter().map(to_f64).sum())
                })
            }
            _ => Box::new(move || {
                let found = self.follow(route, at);
                found.map_or(f64::NAN, |v| v.iter().sum())
            }),
        })
    }

    fn of_motion(&self, at: &Place, motion: &Motion<f64>) -> Vec<f64> {
        let found = self.flat(&at.near, &at.given, motion);
        found.unwrap_or_else(|| vec![f64::NAN; self.quantities.len()])
    }

    fn flat<T: Number>(
        &self,
        at: &Point<T>,
        numbers: &Given<T>,
        motion: &Motion<T>,
    ) -> Option<Vec<T>> {
        let mut out = Vec::with_capacity(self.quantities.len());
        let is_number = |a: &Ask| !matches!(a, Ask::Balance { .. } | Ask::Matrix { .. });
        let asked = self.scene.asked_of_impact();
        for q in asked.filter(|q| is_number(&q.ask)) {
            let found = answer(&q.ask, at, numbers, motion).ok()?;
            out.extend(found.components().into_iter().map(|(_, v)| v));
        }
        Some(out)
    }
}

/// The unknowns of the full system by nalgebra's LU.
fn full(route: Route, system: &System<f64>) -> Option<Vec<f64>> {
    let n = system.unknowns.len();
    if route == Route::LuScaled {
        return lu_scaled(system, 0);
    }
    if system.laws.len() != n {
        return None;
    }
    let matrix = DMatrix::from_row_slice(n, n, &system.matrix);
    let right = DVector::from_row_slice(&system.right);
    let lu = matrix.clone().lu();
    let mut x = lu.solve(&right)?;
    if route == Route::LuRefined {
        for _ in 0..3 {
            let residual = &right - &matrix * &x;
            x += lu.solve(&residual)?;
        }
    }
    Some(x.iter().copied().collect())
}

/// The closed forms of all quantities as programs; `None` where one has no closed form.
fn forms(scene: &Scene, derivation: &Derivation, quantities: &[Quantity]) -> Option<Forms> {
    let mut atoms = Atoms::new();
    let mut closed: Vec<Expr> = Vec::new();
    for quantity in quantities {
        let mut answers = derivation.answers.iter();
        let answer = answers.find(|a| a.name == quantity.name)?;
        let Form::Value { closed: form, .. } = &answer.form else {
            return None;
        };
        closed.push(without_angles(form, &mut atoms));
    }
    let mut inputs: Vec<Symbol> = closed.iter().flat_map(Expr::symbols).collect();
    inputs.sort();
    inputs.dedup();
    let signs = signs(&scene.domains, &atoms);
    let derived = closed.iter().map(|e| as_derived(e, &inputs));
    let arranged = closed.iter().map(|e| arranged(e, &inputs, &signs));
    Some(Forms {
        derived: derived.collect::<Option<_>>()?,
        arranged: arranged.collect::<Option<_>>()?,
        inputs,
        atoms,
    })
}
