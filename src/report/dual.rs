//! A double-double and its derivative, to measure how the data of a scene move its answers.
//!
//! The system is solved for the values first and for the derivatives with the same matrix, so nothing is divided by a
//! number whose value is zero.

use crate::expr::{Function, Point, Rational, Scalar};
use crate::numeric::dd::Dd;
use crate::numeric::solution::Solution;
use crate::numeric::{
    Answer, Motion, Number, System, Unknown, answer, assemble, eliminate, given, motion,
};
use crate::scene::{Ask, Scene};

/// A value and its derivative by one datum.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dual {
    /// The value.
    pub value: Dd,
    /// Its derivative.
    pub slope: Dd,
}

impl Scalar for Dual {
    fn from_rational(value: &Rational) -> Dual {
        Dual {
            value: Dd::from_rational(value),
            slope: Dd::default(),
        }
    }
    fn pi() -> Option<Dual> {
        Dd::pi().map(|value| Dual {
            value,
            slope: Dd::default(),
        })
    }
    fn plus(&self, other: &Dual) -> Dual {
        Dual {
            value: self.value + other.value,
            slope: self.slope + other.slope,
        }
    }
    fn times(&self, other: &Dual) -> Dual {
        Dual {
            value: self.value * other.value,
            slope: self.slope * other.value + self.value * other.slope,
        }
    }
    fn recip(&self) -> Option<Dual> {
        let value = self.value.recip()?;
        Some(Dual {
            value,
            slope: -(self.slope * value * value),
        })
    }
    fn sqrt(&self) -> Option<Dual> {
        let value = Scalar::sqrt(&self.value)?;
        let slope = self.slope * (value + value).recip()?;
        Some(Dual { value, slope })
    }
    fn pow(&self, _: &Dual) -> Option<Dual> {
        None
    }
    fn call(&self, function: Function) -> Option<Dual> {
        let value = self.value.call(function)?;
        let outer = match function {
            Function::Sin => self.value.call(Function::Cos)?,
            Function::Cos => -self.value.call(Function::Sin)?,
            Function::Tan => Dd::exact(1.0) + value * value,
            Function::Abs => Dd::exact(if self.value.high < 0.0 { -1.0 } else { 1.0 }),
            _ => return None,
        };
        Some(Dual {
            value,
            slope: outer * self.slope,
        })
    }
}

impl Number for Dual {
    fn zero() -> Dual {
        Dual::default()
    }
    fn one() -> Dual {
        Dual {
            value: Dd::exact(1.0),
            slope: Dd::default(),
        }
    }
    fn is_zero(&self) -> bool {
        self.value.high == 0.0 && self.slope.high == 0.0
    }
    fn minus(&self, other: &Dual) -> Dual {
        self.plus(&other.negated())
    }
    fn negated(&self) -> Dual {
        Dual {
            value: -self.value,
            slope: -self.slope,
        }
    }
    fn halved(&self) -> Dual {
        Dual {
            value: self.value.halved(),
            slope: self.slope.halved(),
        }
    }
    fn size(&self) -> f64 {
        self.value.high.abs()
    }
}

/// Structured condition number of each answer: Σ |x_k ∂f/∂x_k| / |f| over the data of the scene (parameters; of an angle
/// the cosine and the sine). `None` where the system is not regular.
pub fn conditions(scene: &Scene, at: &Point<Rational>) -> Option<Vec<f64>> {
    let mut moved: Option<Vec<(f64, f64)>> = None;
    let mut add = |slopes: Vec<(f64, f64)>| {
        let sums = moved.get_or_insert_with(|| slopes.iter().map(|(v, _)| (*v, 0.0)).collect());
        for (sum, (_, slope)) in sums.iter_mut().zip(slopes) {
            sum.1 += slope;
        }
    };
    let still = point(at);
    for name in at.values.keys() {
        let mut data = still.clone();
        let entry = data.values.get_mut(name)?;
        entry.slope = entry.value;
        add(slopes(scene, &data)?);
    }
    for name in at.directions.keys() {
        for axis in 0..2 {
            let mut data = still.clone();
            let entry = &mut data.directions.get_mut(name)?.1[axis];
            entry.slope = entry.value;
            add(slopes(scene, &data)?);
        }
    }
    Some(
        moved?
            .into_iter()
            .map(|(value, sum)| if sum == 0.0 { 0.0 } else { sum / value.abs() })
            .collect(),
    )
}

fn point(at: &Point<Rational>) -> Point<Dual> {
    Point {
        values: at
            .values
            .iter()
            .map(|(n, v)| (n.clone(), Dual::from_rational(v)))
            .collect(),
        directions: at
            .directions
            .iter()
            .map(|(n, (k, unit))| (n.clone(), (*k, unit.each_ref().map(Dual::from_rational))))
            .collect(),
    }
}

/// Value and size of the change of each answer when the datum with slope = value changes relatively by one.
fn slopes(scene: &Scene, at: &Point<Dual>) -> Option<Vec<(f64, f64)>> {
    let numbers = given(scene, at).ok()?;
    let system = assemble(&numbers);
    let plain: System<Dd> = system.map(|v| v.value);
    let x = eliminate(&plain)?;
    let n = x.len();
    let mut moved = plain.clone();
    for (r, right) in moved.right.iter_mut().enumerate() {
        let row = &system.matrix[r * n..(r + 1) * n];
        *right = row
            .iter()
            .zip(&x)
            .fold(system.right[r].slope, |sum, (a, x)| sum + -(a.slope * *x));
    }
    let slope = eliminate(&moved)?;
    let values = x
        .into_iter()
        .zip(slope)
        .map(|(value, slope)| Dual { value, slope })
        .collect();
    let solution = Solution {
        values,
        unique: vec![true; n],
        rank: n,
    };
    let motion: Motion<Dual> = motion(&numbers, &system, &solution);
    let mut out = Vec::new();
    for q in scene
        .questions
        .iter()
        .filter(|q| !matches!(q.ask, Ask::Balance { .. } | Ask::Matrix { .. }))
    {
        let pair = |d: Dual| (d.value.high, d.slope.high.abs());
        match answer(&q.ask, at, &numbers, &motion).ok()? {
            Answer::Scalar(d) => out.push(pair(d)),
            Answer::Vector(v) => out.extend(v.map(pair)),
        }
    }
    Some(out)
}

/// Which unknown stands where; used by the routes that give more than answers.
pub fn unknown_value(
    motion: &Motion<f64>,
    unknown: Unknown,
    normal: impl Fn(usize) -> Option<[f64; 2]>,
    along: impl Fn(usize) -> Option<[f64; 2]>,
) -> f64 {
    let on = |v: &[f64; 2], d: Option<[f64; 2]>| d.map_or(f64::NAN, |d| v[0] * d[0] + v[1] * d[1]);
    match unknown {
        Unknown::VelocityX(b) => motion.velocity[b][0],
        Unknown::VelocityY(b) => motion.velocity[b][1],
        Unknown::Spin(b) => motion.spin[b],
        Unknown::HingeX(h) => motion.hinge[h][0],
        Unknown::HingeY(h) => motion.hinge[h][1],
        Unknown::ContactX(c) => motion.contact[c][0],
        Unknown::ContactY(c) => motion.contact[c][1],
        Unknown::ContactNormal(c) => on(&motion.contact[c], normal(c)),
        Unknown::Blow(b) => on(&motion.blow[b], along(b)),
    }
}
