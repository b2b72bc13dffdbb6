//! Chains of n hinged rods struck at one end: the scene for any n, and the cost and error of solving it for n up to 10⁵ and more.
//!
//! The large system goes the general way: constraint rows A from the geometry, the joint complement A M⁻¹ Aᵀ as a sparse
//! matrix, and a sparse Cholesky factorization. It is held against a recursion from the free end that never forms a matrix,
//! in double-double or in fractions (mechanics of the tail as one inverse mass at its hinge, after Featherstone 1983).

mod measure;
mod scene;

use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Col, Side};
use serde::Serialize;

use crate::expr::ratio;
use crate::numeric::Number;

pub use measure::{ChainRoute, Growth, measure};
pub use scene::{Pose, chain_scene};

/// A chain in numbers: rods of mass and length 1.
#[derive(Clone, Debug)]
pub struct Chain<T> {
    /// Direction of each rod from its struck end on, (cos θ, sin θ).
    pub directions: Vec<[T; 2]>,
    /// Impulse on the free end of the first rod.
    pub blow: [T; 2],
}

/// Motion of a chain just after the blow.
#[derive(Clone, Debug, PartialEq)]
pub struct Swing<T> {
    /// Velocity of each rod's center.
    pub velocity: Vec<[T; 2]>,
    /// Spin of each rod, counterclockwise.
    pub spin: Vec<T>,
}

impl Chain<f64> {
    /// n rods whose directions repeat those given.
    pub fn repeating(n: usize, pattern: &[[f64; 2]], blow: [f64; 2]) -> Chain<f64> {
        Chain {
            directions: pattern.iter().cycle().take(n).copied().collect(),
            blow,
        }
    }

    /// The same doubles as exact values of another number type.
    pub fn to<T>(&self, exact: impl Fn(f64) -> T) -> Chain<T> {
        let pair = |p: &[f64; 2]| [exact(p[0]), exact(p[1])];
        Chain {
            directions: self.directions.iter().map(pair).collect(),
            blow: pair(&self.blow),
        }
    }
}

/// The motion by recursion, in any number type and in time proportional to n; `None` for a division by zero, which exact
/// unit vectors exclude.
///
/// With Rᵢ the impulse on rod i at its near end and ν its unit normal, the ends of the rod get the velocities
/// u = (1+3νν)Rᵢ − (1−3νν)Rᵢ₊₁ and (1−3νν)Rᵢ − (1+3νν)Rᵢ₊₁. The tail from rod i on answers u = Yᵢ Rᵢ; Y of the last rod is
/// 1+3νν, and Yᵢ follows from Yᵢ₊₁.
pub fn recursion<T: Number>(chain: &Chain<T>) -> Option<Swing<T>> {
    let n = chain.directions.len();
    let mut tails: Vec<[T; 3]> = Vec::with_capacity(n);
    for direction in chain.directions.iter().rev() {
        let [own, cross] = end_responses(direction);
        let tail = match tails.last() {
            None => own,
            Some(next) => {
                let inverse = inverse(&sum(&own, next))?;
                let drop = sandwich(&cross, &inverse);
                std::array::from_fn(|k| own[k].minus(&drop[k]))
            }
        };
        tails.push(tail);
    }
    tails.reverse();
    let mut swing = Swing {
        velocity: Vec::with_capacity(n),
        spin: Vec::with_capacity(n),
    };
    let mut near = chain.blow.clone();
    let minus_six = T::from_rational(&ratio(-6, 1));
    for (i, direction) in chain.directions.iter().enumerate() {
        let [own, cross] = end_responses(direction);
        let far = match tails.get(i + 1) {
            Some(tail) => apply(&inverse(&sum(&own, tail))?, &apply(&cross, &near)),
            None => [T::zero(), T::zero()],
        };
        let both = [near[0].plus(&far[0]), near[1].plus(&far[1])];
        let moment = direction[0]
            .times(&both[1])
            .minus(&direction[1].times(&both[0]));
        swing.spin.push(minus_six.times(&moment));
        swing
            .velocity
            .push([near[0].minus(&far[0]), near[1].minus(&far[1])]);
        near = far;
    }
    Some(swing)
}

/// 1 + 3νν and 1 − 3νν as symmetric matrices (xx, xy, yy), ν = (−s, c).
fn end_responses<T: Number>(direction: &[T; 2]) -> [[T; 3]; 2] {
    let three = T::from_rational(&ratio(3, 1));
    let [c, s] = direction;
    let outer = [s.times(s), c.times(s).negated(), c.times(c)].map(|x| three.times(&x));
    let unit = [T::one(), T::zero(), T::one()];
    [
        sum(&unit, &outer),
        std::array::from_fn(|k| unit[k].minus(&outer[k])),
    ]
}

fn sum<T: Number>(a: &[T; 3], b: &[T; 3]) -> [T; 3] {
    std::array::from_fn(|k| a[k].plus(&b[k]))
}

fn inverse<T: Number>(a: &[T; 3]) -> Option<[T; 3]> {
    let over = a[0].times(&a[2]).minus(&a[1].times(&a[1])).recip()?;
    Some([
        a[2].times(&over),
        a[1].negated().times(&over),
        a[0].times(&over),
    ])
}

fn apply<T: Number>(a: &[T; 3], v: &[T; 2]) -> [T; 2] {
    [
        a[0].times(&v[0]).plus(&a[1].times(&v[1])),
        a[1].times(&v[0]).plus(&a[2].times(&v[1])),
    ]
}

/// The symmetric product C B C.
fn sandwich<T: Number>(c: &[T; 3], b: &[T; 3]) -> [T; 3] {
    let first = apply(b, &[c[0].clone(), c[1].clone()]);
    let second = apply(b, &[c[1].clone(), c[2].clone()]);
    let [xx, xy] = apply(c, &first);
    let [_, yy] = apply(c, &second);
    [xx, xy, yy]
}

/// Why the sparse route gives no answer.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct NotDefinite;

/// The motion by sparse matrices: M v⁺ − Aᵀ Λ = Q, A v⁺ = 0, by the joint complement A M⁻¹ Aᵀ Λ = −A M⁻¹ Q.
pub fn sparse(chain: &Chain<f64>) -> Result<Swing<f64>, NotDefinite> {
    let n = chain.directions.len();
    let inverse_mass = [1.0, 1.0, 12.0];
    let mut free = vec![0.0; 3 * n];
    if let Some([c, s]) = chain.directions.first() {
        let [x, y] = chain.blow;
        free[..3].copy_from_slice(&[x, y, -6.0 * (c * y - s * x)]);
    }
    if n > 1 {
        let rows = constraints(&chain.directions);
        let size = 2 * (n - 1);
        let complement = complement(&rows, &inverse_mass, size)?;
        let factor = complement
            .sp_cholesky(Side::Lower)
            .map_err(|_| NotDefinite)?;
        let mut reactions = Col::<f64>::zeros(size);
        for (column, entries) in rows.iter().enumerate() {
            for (row, a) in entries {
                reactions[*row] -= a * free[column];
            }
        }
        factor.solve_in_place(reactions.as_mat_mut());
        for (column, entries) in rows.iter().enumerate() {
            let impulse: f64 = entries.iter().map(|(row, a)| a * reactions[*row]).sum();
            free[column] += inverse_mass[column % 3] * impulse;
        }
    }
    let velocity = free.chunks_exact(3).map(|v| [v[0], v[1]]).collect();
    Ok(Swing {
        velocity,
        spin: free.chunks_exact(3).map(|v| v[2]).collect(),
    })
}

/// A by columns (x, y, θ of each rod): at each hinge, velocity of the next rod's near end minus that of the rod's far end.
fn constraints(directions: &[[f64; 2]]) -> Vec<Vec<(usize, f64)>> {
    let hinges = directions.len().saturating_sub(1);
    let mut columns = vec![Vec::new(); 3 * directions.len()];
    for i in 0..hinges {
        for (body, sign) in [(i, -1.0), (i + 1, 1.0)] {
            let [c, s] = directions[body];
            // The arm is ±d/2, +  at the far end of rod i, − at the near end of the next: the turn is −½(−s, c) in both.
            for (k, turn) in [0.5 * s, -0.5 * c].into_iter().enumerate() {
                columns[3 * body + k].push((2 * i + k, sign));
                columns[3 * body + 2].push((2 * i + k, turn));
            }
        }
    }
    columns
}

/// A M⁻¹ Aᵀ.
fn complement(
    rows: &[Vec<(usize, f64)>],
    inverse_mass: &[f64; 3],
    size: usize,
) -> Result<SparseColMat<usize, f64>, NotDefinite> {
    let mut entries = Vec::with_capacity(8 * rows.len());
    for (column, touched) in rows.iter().enumerate() {
        let w = inverse_mass[column % 3];
        for (row, a) in touched {
            let products = touched
                .iter()
                .map(|(other, b)| Triplet::new(*row, *other, a * w * b));
            entries.extend(products);
        }
    }
    SparseColMat::try_new_from_triplets(size, size, &entries).map_err(|_| NotDefinite)
}

/// Directions with exact decimals or short fractions, so that a pattern has no symmetry; rounded to doubles where needed.
pub const CROOKED: [[f64; 2]; 5] = [
    [1.0, 0.0],
    [0.8, 0.6],
    [5.0 / 13.0, -12.0 / 13.0],
    [15.0 / 17.0, 8.0 / 17.0],
    [0.6, -0.8],
];

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::expr::number::from_f64;
    use crate::expr::{Point, Rational};
    use crate::numeric::dd::Dd;
    use crate::numeric::{assemble, given, motion, solve_exact};

    fn exact_unit_vectors(n: usize) -> Vec<[Rational; 2]> {
        let all = [
            (1, 0, 1),
            (4, 3, 5),
            (5, -12, 13),
            (15, 8, 17),
            (-3, 4, 5),
            (20, 21, 29),
        ];
        all.iter()
            .cycle()
            .take(n)
            .map(|(c, s, r)| [ratio(*c, *r), ratio(*s, *r)])
            .collect()
    }

    #[test]
    fn the_recursion_solves_the_scene_exactly_at_any_angles() {
        for n in 1..=6 {
            let scene = chain_scene(n, Pose::AnyAngles);
            let directions = exact_unit_vectors(n);
            let mut at = Point::<Rational> {
                values: ["m", "l", "J"]
                    .map(|name| (name.into(), ratio(1, 1)))
                    .into_iter()
                    .collect(),
                ..Point::default()
            };
            for (i, d) in directions.iter().enumerate() {
                at.directions
                    .insert(format!("theta{}", i + 1).into(), (1, d.clone()));
            }
            let numbers = given(&scene, &at).expect("every quantity has a value");
            let system = assemble(&numbers);
            let solution = solve_exact(&system).expect("consistent");
            let expected = motion(&numbers, &system, &solution);
            let chain = Chain {
                directions,
                blow: [ratio(0, 1), ratio(1, 1)],
            };
            let swing = recursion(&chain).expect("no division by zero");
            assert_eq!(swing.spin, expected.spin, "n = {n}");
            assert_eq!(swing.velocity, expected.velocity, "n = {n}");
        }
    }

    #[test]
    fn eight_straight_rods_turn_the_struck_one_at_a_known_rate() {
        let directions = vec![[ratio(1, 1), ratio(0, 1)]; 8];
        let chain = Chain {
            directions,
            blow: [ratio(0, 1), ratio(1, 1)],
        };
        let swing = recursion(&chain).expect("no division by zero");
        assert_eq!(swing.spin[0], ratio(-23859, 5432));
    }

    #[test]
    fn sparse_matrices_agree_with_fractions() {
        for n in [1, 2, 3, 6, 20] {
            let chain = Chain::repeating(n, &CROOKED, [0.5, 2.0]);
            let exact = recursion(&chain.to(|x| from_f64(x).expect("finite")))
                .expect("no division by zero");
            let near = sparse(&chain).expect("definite");
            for (a, b) in near.spin.iter().zip(&exact.spin) {
                let b = crate::expr::number::to_f64(b);
                assert!((a - b).abs() < 1e-13, "{a} {b}");
            }
        }
    }

    #[test]
    fn double_double_agrees_with_fractions_to_thirty_digits() {
        let chain = Chain::repeating(12, &CROOKED, [0.5, 2.0]);
        let exact =
            recursion(&chain.to(|x| from_f64(x).expect("finite"))).expect("no division by zero");
        let near = recursion(&chain.to(Dd::exact)).expect("no division by zero");
        for (a, b) in near.spin.iter().zip(&exact.spin) {
            let a = from_f64(a.high).expect("finite") + from_f64(a.low).expect("finite");
            let error = crate::expr::number::to_f64(&((a - b) / b)).abs();
            assert!(error < 1e-28, "{error}");
        }
    }

    #[test]
    fn time_grows_in_proportion_and_error_slowly() {
        let time = |n| measure(&Chain::repeating(n, &CROOKED, [0.5, 2.0]), 5);
        let (small, large) = (time(300), time(9600));
        for (a, b) in small.iter().zip(&large) {
            let growth = (b.seconds[0] / a.seconds[0]).ln() / 32_f64.ln();
            // A dense factorization would grow with the third power; a busy machine may add a factor of ten to one time.
            assert!(growth < 2.0, "{:?}: {growth}", a.route);
            assert!(b.error < 1e-10, "{:?}: {}", b.route, b.error);
            assert!(b.along.len() >= 25);
        }
    }

    #[test]
    fn the_scene_names_what_it_uses() {
        for (pose, angles) in [(Pose::Straight, 0), (Pose::AnyAngles, 4)] {
            let scene = chain_scene(4, pose);
            assert_eq!(
                (scene.bodies.len(), scene.hinges.len(), scene.blows.len()),
                (4, 3, 1)
            );
            assert_eq!(scene.parameters.len(), 3 + angles);
            let declared: BTreeMap<_, _> = scene
                .parameters
                .iter()
                .map(|p| (p.name.clone(), ()))
                .collect();
            for body in &scene.bodies {
                for e in body.center.iter().chain([&body.mass, &body.inertia]) {
                    assert!(
                        e.symbols().iter().all(|s| declared.contains_key(s)),
                        "{e:?}"
                    );
                }
            }
        }
        assert!(chain_scene(0, Pose::Straight).bodies.is_empty());
    }
}
