//! Equality at random points modulo the prime 2⁶¹ − 1: fast, and right up to a probability that is stated.
//!
//! For rational functions of symbols and of sines and cosines of rational multiples of angles. A difference is certain: an
//! identity over ℚ holds modulo every prime that divides no denominator. Roots and other functions are left to
//! [`crate::equality`], because a wrong choice of root would refute what is true.

use super::compare::Finding;
use super::{Proof, Verdict};
use crate::domain::{Domains, Roles, roles};
use crate::expr::{Expr, Function, Int, Node, Point, Rational, Scalar, Symbol};

/// The prime 2⁶¹ − 1.
const P: u64 = (1 << 61) - 1;

/// Points compared; each divides the chance of an error by p over the degree.
const POINTS: usize = 2;

/// A number modulo p.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Residue(u64);

fn reduce(x: u128) -> u64 {
    let folded = (x as u64 & P) + (x >> 61) as u64;
    let folded = (folded & P) + (folded >> 61);
    if folded >= P { folded - P } else { folded }
}

impl Residue {
    fn power(self, mut exponent: u64) -> Residue {
        let (mut result, mut square) = (1, self.0);
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = reduce(u128::from(result) * u128::from(square));
            }
            square = reduce(u128::from(square) * u128::from(square));
            exponent >>= 1;
        }
        Residue(result)
    }

    fn integer(value: &Int) -> Residue {
        if let Some(k) = value.as_i64() {
            let size = reduce(u128::from(k.unsigned_abs()));
            return Residue(if k < 0 && size > 0 { P - size } else { size });
        }
        let rest = value.to_bigint() % num_bigint::BigInt::from(P);
        let rest = if rest < num_bigint::BigInt::from(0) {
            rest + P
        } else {
            rest
        };
        Residue(num_traits::ToPrimitive::to_u64(&rest).unwrap_or(0))
    }
}

impl Scalar for Residue {
    // The caller admits only denominators below p.
    fn from_rational(value: &Rational) -> Residue {
        let (n, d) = (
            Residue::integer(value.numer()),
            Residue::integer(value.denom()),
        );
        if d.0 == 1 {
            n
        } else {
            n.times(&d.power(P - 2))
        }
    }
    fn pi() -> Option<Residue> {
        // π is transcendental: for rational functions any value will do as well as another.
        Some(Residue(0x0f9a_3c51_7e2b_64d9 % P))
    }
    fn plus(&self, other: &Residue) -> Residue {
        let sum = self.0 + other.0;
        Residue(if sum >= P { sum - P } else { sum })
    }
    fn times(&self, other: &Residue) -> Residue {
        Residue(reduce(u128::from(self.0) * u128::from(other.0)))
    }
    fn recip(&self) -> Option<Residue> {
        (self.0 != 0).then(|| self.power(P - 2))
    }
    fn sqrt(&self) -> Option<Residue> {
        None
    }
    fn pow(&self, _: &Residue) -> Option<Residue> {
        None
    }
    fn call(&self, _: Function) -> Option<Residue> {
        None
    }
}

/// Values of an expected formula at fixed pseudo-random points, kept for many answers.
#[derive(Clone, Debug)]
pub(crate) struct Residues {
    points: Vec<Point<Residue>>,
    values: Vec<Residue>,
    roles: Roles,
    units: Vec<[Symbol; 2]>,
    degree: u64,
    assumed: Vec<String>,
}

impl Residues {
    /// `None` where the formula is not of the kind this comparison is for.
    pub fn of(e: &Expr, domains: &Domains) -> Option<Residues> {
        if !rational(e) {
            return None;
        }
        // A domain without inside, or a single value, is no place for identities.
        let flat = |d: &crate::domain::Domain| matches!((&d.low, &d.high), (Some(l), Some(h)) if l.value == h.value);
        if domains.symbols.values().any(flat) {
            return None;
        }
        let roles = roles(&[e]);
        if roles.radians || roles.symbols.values().any(|r| r.turns && r.bare) {
            return None;
        }
        let mut residues = Residues {
            points: vec![Point::default(); POINTS],
            values: Vec::with_capacity(POINTS),
            units: domains.unit_vectors.clone(),
            degree: degree(e).0,
            assumed: domains.completed(&roles).1,
            roles,
        };
        for round in 0..POINTS {
            let mut point = Point::default();
            for name in residues.roles.symbols.keys() {
                residues.place(name, round, &mut point);
            }
            residues.values.push(e.evaluate(&point)?);
            residues.points[round] = point;
        }
        Some(residues)
    }

    fn place(&self, name: &Symbol, round: usize, point: &mut Point<Residue>) {
        let unit = |t: Residue| -> Option<[Residue; 2]> {
            let one = Residue(1);
            let square = t.times(&t);
            let below = one.plus(&square).recip()?;
            let minus = Residue(P - 1).times(&square);
            Some([one.plus(&minus).times(&below), t.plus(&t).times(&below)])
        };
        if let Some(pair) = self.units.iter().find(|pair| pair.contains(name)) {
            if let Some([c, s]) = unit(random(&pair[0], round)) {
                point.values.insert(pair[0].clone(), c);
                point.values.insert(pair[1].clone(), s);
            }
            return;
        }
        match self.roles.symbols.get(name) {
            Some(role) if role.turns => {
                if let Some(direction) = unit(random(name, round)) {
                    point
                        .directions
                        .insert(name.clone(), (role.divisor, direction));
                }
            }
            _ => {
                point.values.insert(name.clone(), random(name, round));
            }
        }
    }

    /// The verdict on an answer; `None` where it is not of the kind this comparison is for.
    pub fn compare(&self, answer: &Expr) -> Option<Finding> {
        if !rational(answer) {
            return None;
        }
        let mut equal = true;
        for (round, point) in self.points.iter().enumerate() {
            let value = match answer.evaluate(point) {
                Some(value) => value,
                None => self.elsewhere(answer, round)?,
            };
            equal &= value == self.values[round];
            if !equal {
                break;
            }
        }
        let degree = self.degree.saturating_add(degree(answer).0).max(1);
        let mut finding = if equal {
            let bound = (degree as f64 / P as f64).powi(POINTS as i32);
            let mut proof = Proof::of(
                "modular",
                format!("equal at {POINTS} random points modulo 2^61 - 1"),
            );
            proof.bound = Some(bound);
            Finding::new(Verdict::Equivalent, "EQUIV_MODULAR", proof)
        } else {
            Finding::different(
                "DIFF",
                "modular",
                "no identity: the values differ modulo 2^61 - 1",
            )
        };
        finding.assumed = self.assumed.clone();
        Some(finding)
    }

    /// The value of an answer with symbols the expected formula does not have.
    fn elsewhere(&self, answer: &Expr, round: usize) -> Option<Residue> {
        let mine = roles(&[answer]);
        let mut point = self.points[round].clone();
        for (name, role) in &mine.symbols {
            match self.roles.symbols.get(name) {
                // Another use of the same symbol: the points do not fit.
                Some(known) if known.turns != role.turns || known.bare != role.bare => return None,
                Some(known) if role.turns && known.divisor % role.divisor != 0 => return None,
                Some(_) => {}
                None if role.turns && role.bare => return None,
                None if role.turns => {
                    let other = Residues {
                        roles: mine.clone(),
                        ..self.clone()
                    };
                    other.place(name, round, &mut point);
                }
                None => self.place(name, round, &mut point),
            }
        }
        answer.evaluate(&point)
    }
}

/// Whether only rational operations, sines, cosines and tangents occur, with exponents of a sensible size.
fn rational(e: &Expr) -> bool {
    let mut fits = true;
    let mut nodes = 0usize;
    e.walk(&mut |part| {
        nodes += 1;
        match part.node() {
            // A longer denominator might be divisible by p.
            Node::Number(value) => {
                fits &= value.denom().bits() <= 60 && value.numer().bits() < 1 << 14
            }
            Node::Power(_, k) => {
                fits &= k.as_number().is_some_and(|k| {
                    k.is_integer() && k.numer().as_i64().is_some_and(|k| k.abs() < 1 << 20)
                });
            }
            Node::Call(f, _) => fits &= matches!(f, Function::Sin | Function::Cos | Function::Tan),
            _ => {}
        }
    });
    fits && nodes < 20_000
}

/// Bounds on the degrees of numerator and denominator in the parameters of the points.
fn degree(e: &Expr) -> (u64, u64) {
    match e.node() {
        Node::Number(_) => (0, 0),
        // A component of a unit vector has degree 2 over 2.
        Node::Symbol(_) => (2, 2),
        Node::Sum(parts) => {
            let all: Vec<(u64, u64)> = parts.iter().map(degree).collect();
            let below: u64 = all.iter().fold(0, |t, d| t.saturating_add(d.1));
            let above = all
                .iter()
                .map(|d| d.0.saturating_add(below.saturating_sub(d.1)))
                .max()
                .unwrap_or(0);
            (above, below)
        }
        Node::Product(parts) => parts.iter().map(degree).fold((0, 0), |t, d| {
            (t.0.saturating_add(d.0), t.1.saturating_add(d.1))
        }),
        Node::Power(base, k) => {
            let k = k.as_number().and_then(|k| k.numer().as_i64()).unwrap_or(1);
            let (n, d) = degree(base);
            let times = |x: u64| x.saturating_mul(k.unsigned_abs());
            if k < 0 {
                (times(d), times(n))
            } else {
                (times(n), times(d))
            }
        }
        Node::Call(..) => {
            // Multiples of an angle are known up to 4096 divisors of it.
            (8192, 8192)
        }
    }
}

/// A number for a name and a round; the same on every machine and in every run.
fn random(name: &Symbol, round: usize) -> Residue {
    let hash = name.bytes().fold(0xcbf2_9ce4_8422_2325u64, |h, b| {
        (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3)
    });
    let mut z = hash ^ (round as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    Residue((z ^ (z >> 31)) % (P - 2) + 1)
}
