//! Where symbols live: the connected set of values a formula is claimed for, and exact points inside it.
//!
//! In: declared intervals and the formulas that use the symbols. Out: membership, the domain completed by the stated
//! defaults, and a fixed sequence of sample points from simple to complicated. It knows nothing of equality.

mod coordinate;
mod generic;
mod relation;
mod roles;
mod sample;

use std::cmp::Ordering;
use std::collections::BTreeMap;

use num_traits::{Signed, Zero};

use crate::expr::{Expr, Int, Rational, Symbol, ratio};

pub use coordinate::Coordinate;
pub use generic::generic_point;
pub use relation::Relation;
pub use roles::{Role, Roles, roles};
pub use sample::{Sample, at_ends, samples, samples_until, within};

/// One end of an interval: `value`, or `value`·π.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Limit {
    /// The number, or the coefficient of π.
    pub value: Rational,
    /// Whether `value` counts in units of π.
    pub of_pi: bool,
    /// Whether the end itself is excluded.
    pub open: bool,
}

/// The interval a symbol ranges over; a missing end is infinite.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Domain {
    /// Lower end.
    pub low: Option<Limit>,
    /// Upper end.
    pub high: Option<Limit>,
}

/// The domain of a formula: a product of intervals, restricted to unit circles for declared unit vectors and to the points
/// that keep to the stated relations.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Domains {
    /// Interval of each declared symbol. An undeclared symbol is taken as positive, an undeclared symbol that occurs under
    /// sin, cos or tan as an angle in the first quadrant; whoever relies on that prints it as an assumption.
    pub symbols: BTreeMap<Symbol, Domain>,
    /// Pairs (a, b) of symbols with a² + b² = 1: components of unit vectors. Each lies in [−1, 1].
    pub unit_vectors: Vec<[Symbol; 2]>,
    /// Inequalities between symbols.
    pub relations: Vec<Relation>,
}

impl Limit {
    /// A number as an end.
    pub fn number(value: Rational, open: bool) -> Limit {
        Limit {
            value,
            of_pi: false,
            open,
        }
    }

    /// A multiple of π as an end.
    pub fn pi(value: Rational, open: bool) -> Limit {
        Limit {
            value,
            of_pi: true,
            open,
        }
    }

    /// How a fraction lies to the end; `None` where 36 digits of π do not tell.
    fn compare(&self, x: &Rational) -> Option<Ordering> {
        if self.value.is_zero() {
            return Some(x.numer().cmp(&Int::from(0)));
        }
        if !self.of_pi {
            return Some(compare(x, &self.value));
        }
        let [near, end] = [crate::expr::number::to_f64(x), self.approximate()];
        if (near - end).abs() > 1e-12 * near.abs().max(end.abs()) {
            // Doubles tell, unless the two are as good as equal or leave the doubles.
            return near.partial_cmp(&end);
        }
        let [low, high] = pi_bounds().map(|p| p * &self.value);
        let (low, high) = if low <= high {
            (low, high)
        } else {
            (high, low)
        };
        match (x.cmp(&low), x.cmp(&high)) {
            (Ordering::Less | Ordering::Equal, _) => Some(Ordering::Less),
            (_, Ordering::Greater | Ordering::Equal) => Some(Ordering::Greater),
            _ => None,
        }
    }

    /// The end as an expression.
    pub fn expr(&self) -> Expr {
        let value = Expr::from(self.value.clone());
        if self.of_pi {
            value * Expr::pi()
        } else {
            value
        }
    }

    /// The end in floating point, for plans and pictures.
    pub fn approximate(&self) -> f64 {
        crate::expr::number::to_f64(&self.value)
            * if self.of_pi {
                std::f64::consts::PI
            } else {
                1.0
            }
    }
}

impl Domain {
    /// All numbers > 0.
    pub fn positive() -> Domain {
        Domain {
            low: Some(Limit::number(Rational::zero(), true)),
            high: None,
        }
    }

    /// All numbers < 0.
    pub fn negative() -> Domain {
        Domain {
            low: None,
            high: Some(Limit::number(Rational::zero(), true)),
        }
    }

    /// All numbers ≥ 0.
    pub fn nonnegative() -> Domain {
        Domain {
            low: Some(Limit::number(Rational::zero(), false)),
            high: None,
        }
    }

    /// All real numbers.
    pub fn real() -> Domain {
        Domain::default()
    }

    /// The closed interval from `low` to `high`.
    pub fn between(low: Rational, high: Rational) -> Domain {
        Domain {
            low: Some(Limit::number(low, false)),
            high: Some(Limit::number(high, false)),
        }
    }

    /// The open interval of angles from `low`·π to `high`·π.
    pub fn angle(low: Rational, high: Rational) -> Domain {
        Domain {
            low: Some(Limit::pi(low, true)),
            high: Some(Limit::pi(high, true)),
        }
    }

    /// Angles strictly between 0 and π/2.
    pub fn first_quadrant() -> Domain {
        Domain::angle(Rational::zero(), ratio(1, 2))
    }

    /// Whether a number lies inside for certain.
    pub fn contains(&self, x: &Rational) -> bool {
        let above = self.low.as_ref().is_none_or(|l| match l.compare(x) {
            Some(Ordering::Greater) => true,
            Some(Ordering::Equal) => !l.open,
            _ => false,
        });
        above
            && self.high.as_ref().is_none_or(|h| match h.compare(x) {
                Some(Ordering::Less) => true,
                Some(Ordering::Equal) => !h.open,
                _ => false,
            })
    }

    /// Whether it lies within another bounded interval, ends included.
    pub fn lies_within(&self, outer: &Domain) -> bool {
        let at = |l: &Option<Limit>| l.as_ref().map(Limit::approximate);
        match (
            at(&self.low),
            at(&self.high),
            at(&outer.low),
            at(&outer.high),
        ) {
            (Some(a), Some(b), Some(low), Some(high)) => a >= low && b <= high,
            _ => false,
        }
    }

    /// Whether a number is an end of the interval.
    pub fn is_end(&self, x: &Rational) -> bool {
        [&self.low, &self.high]
            .into_iter()
            .flatten()
            .any(|l| l.compare(x) == Some(Ordering::Equal))
    }

    /// Whether the interval holds both positive and negative numbers.
    pub fn changes_sign(&self) -> bool {
        self.low.as_ref().is_none_or(|l| l.value.is_negative())
            && self.high.as_ref().is_none_or(|h| h.value.is_positive())
    }

    /// The part with the given sign: numbers ≥ 0 for `positive`, else numbers ≤ 0.
    pub fn half(&self, positive: bool) -> Domain {
        let zero = Some(Limit::number(Rational::zero(), false));
        if positive {
            Domain {
                low: zero,
                high: self.high.clone(),
            }
        } else {
            Domain {
                low: self.low.clone(),
                high: zero,
            }
        }
    }

    /// The domain as a condition on a symbol, such as `0 < theta < pi/2`.
    pub fn words(&self, symbol: &str) -> String {
        let end = |l: &Limit| match (
            l.of_pi && !l.value.is_zero(),
            l.value.numer(),
            l.value.denom(),
        ) {
            (false, ..) => l.value.to_string(),
            (true, n, d) => {
                let n = match n.as_i64() {
                    Some(1) => String::new(),
                    Some(-1) => String::from("-"),
                    _ => format!("{n}*"),
                };
                if *d == Int::from(1) {
                    format!("{n}pi")
                } else {
                    format!("{n}pi/{d}")
                }
            }
        };
        let sign = |l: &Limit| if l.open { "<" } else { "≤" };
        match (&self.low, &self.high) {
            (Some(l), None) if l.open && l.value.is_zero() => [symbol, " > 0"].concat(),
            (None, None) => format!("{symbol} is real"),
            (Some(l), None) => format!("{symbol} {} {}", if l.open { ">" } else { "≥" }, end(l)),
            (None, Some(h)) => format!("{symbol} {} {}", sign(h), end(h)),
            (Some(l), Some(h)) => format!("{} {} {symbol} {} {}", end(l), sign(l), sign(h), end(h)),
        }
    }
}

impl Domains {
    /// The domain with every undeclared symbol of `roles` declared by the default, and the defaults used, in words.
    pub fn completed(&self, roles: &Roles) -> (Domains, Vec<String>) {
        let mut all = self.clone();
        let mut assumed = Vec::new();
        for (name, role) in &roles.symbols {
            if all.symbols.contains_key(name) {
                continue;
            }
            if self.unit_vectors.iter().flatten().any(|s| s == name) {
                all.symbols
                    .insert(name.clone(), Domain::between(ratio(-1, 1), ratio(1, 1)));
                continue;
            }
            let domain = if role.turns {
                Domain::first_quadrant()
            } else {
                Domain::positive()
            };
            assumed.push(domain.words(name));
            all.symbols.insert(name.clone(), domain);
        }
        (all, assumed)
    }

    /// The domain with every symbol of some formulas declared.
    pub fn of(&self, formulas: &[&Expr]) -> Domains {
        self.completed(&roles(formulas)).0
    }

    /// The first points at which some formulas may be tried.
    pub fn points(&self, formulas: &[&Expr], count: usize) -> Vec<Sample> {
        let roles = roles(formulas);
        samples(&roles, &self.completed(&roles).0, count)
    }
}

/// Order of two fractions; by cross multiplication where they are small, which nearly all are.
fn compare(a: &Rational, b: &Rational) -> Ordering {
    let small = |x: &Rational| {
        Some((
            i128::from(x.numer().as_i64()?),
            i128::from(x.denom().as_i64()?),
        ))
    };
    match (small(a), small(b)) {
        (Some((n, d)), Some((m, e))) => (n * e).cmp(&(m * d)),
        _ => a.cmp(b),
    }
}

/// Fractions just below and above π, 36 digits.
fn pi_bounds() -> [Rational; 2] {
    // 3.14159265358979323846264338327950288 < π < …289
    let digits = 314_159_265_358_979_323_846_264_338_327_950_288_i128;
    [digits, digits + 1].map(|n| Rational::new(Int::from(n), Int::from(10).pow(35)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_belong_to_closed_intervals_only() {
        assert!(
            Domain::nonnegative().contains(&ratio(0, 1))
                && !Domain::positive().contains(&ratio(0, 1))
        );
        assert!(Domain::between(ratio(0, 1), ratio(1, 1)).contains(&ratio(1, 1)));
    }

    #[test]
    fn right_angles_lie_between_known_fractions() {
        let quadrant = Domain::first_quadrant();
        assert!(quadrant.contains(&ratio(157, 100)) && !quadrant.contains(&ratio(158, 100)));
        assert!(!quadrant.contains(&ratio(0, 1)));
    }

    #[test]
    fn a_domain_reads_as_a_condition() {
        assert_eq!(Domain::positive().words("m"), "m > 0");
        assert_eq!(Domain::first_quadrant().words("theta"), "0 < theta < pi/2");
        assert_eq!(
            Domain::between(ratio(0, 1), ratio(1, 1)).words("e"),
            "0 ≤ e ≤ 1"
        );
    }
}
