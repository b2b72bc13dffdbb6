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

use crate::expr::number::to_f64;
use crate::expr::{Expr, Int, Rational, Symbol, ratio};

pub use coordinate::Coordinate;
pub use generic::generic_point;
pub use relation::{Origin, Relation};
pub use roles::{Role, Roles, roles};
pub use sample::{Sample, at_ends, far, samples, samples_until, within};

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
        let [near, end] = [to_f64(x), self.approximate()];
        if (near - end).abs() > 1e-12 * near.abs().max(end.abs()) {
            // Doubles tell, unless the two are as good as equal or leave the doubles.
            return near.partial_cmp(&end);
        }
        let mut bounds = pi_bounds().map(|p| p * &self.value);
        bounds.sort();
        match bounds.map(|end| x.cmp(&end)) {
            [Ordering::Less | Ordering::Equal, _] => Some(Ordering::Less),
            [_, Ordering::Greater | Ordering::Equal] => Some(Ordering::Greater),
            _ => None,
        }
    }

    /// The end as an expression.
    pub fn expr(&self) -> Expr {
        let value = Expr::from(self.value.clone());
        match self.of_pi {
            true => value * Expr::pi(),
            false => value,
        }
    }

    /// The end in floating point, for plans and pictures.
    pub fn approximate(&self) -> f64 {
        let value = to_f64(&self.value);
        match self.of_pi {
            true => value * std::f64::consts::PI,
            false => value,
        }
    }
}

impl Domain {
    /// The interval between two ends, where there are.
    pub fn new(low: Option<Limit>, high: Option<Limit>) -> Domain {
        Domain { low, high }
    }

    /// All numbers > 0.
    pub fn positive() -> Domain {
        Domain::new(Some(Limit::number(Rational::zero(), true)), None)
    }

    /// All numbers < 0.
    pub fn negative() -> Domain {
        Domain::new(None, Some(Limit::number(Rational::zero(), true)))
    }

    /// All numbers ≥ 0.
    pub fn nonnegative() -> Domain {
        Domain::new(Some(Limit::number(Rational::zero(), false)), None)
    }

    /// All real numbers.
    pub fn real() -> Domain {
        Domain::default()
    }

    /// Leaves out a number that is one of its ends; tells whether it was in.
    pub fn leave_out(&mut self, number: i64) -> bool {
        let number = Limit::number(ratio(number, 1), false);
        let ends = self.low.iter_mut().chain(&mut self.high);
        let own = ends.filter(|end| **end == number);
        own.map(|end| end.open = true).count() > 0
    }

    /// The closed interval from `low` to `high`.
    pub fn between(low: Rational, high: Rational) -> Domain {
        let [low, high] = [low, high].map(|end| Some(Limit::number(end, false)));
        Domain::new(low, high)
    }

    /// The open interval of angles from `low`·π to `high`·π.
    pub fn angle(low: Rational, high: Rational) -> Domain {
        let [low, high] = [low, high].map(|end| Some(Limit::pi(end, true)));
        Domain::new(low, high)
    }

    /// Angles strictly between 0 and π/2.
    pub fn first_quadrant() -> Domain {
        Domain::angle(Rational::zero(), ratio(1, 2))
    }

    /// Whether a number lies inside for certain.
    pub fn contains(&self, x: &Rational) -> bool {
        let keeps = |end: &Option<Limit>, side: Ordering| {
            end.as_ref().is_none_or(|end| match end.compare(x) {
                Some(Ordering::Equal) => !end.open,
                found => found == Some(side),
            })
        };
        keeps(&self.low, Ordering::Greater) && keeps(&self.high, Ordering::Less)
    }

    /// The ends that it has.
    pub fn ends(&self) -> impl Iterator<Item = &Limit> {
        [&self.low, &self.high].into_iter().flatten()
    }

    /// Both ends in floating point, where it has them.
    pub fn bounds(&self) -> [Option<f64>; 2] {
        [&self.low, &self.high].map(|end| end.as_ref().map(Limit::approximate))
    }

    /// The number at a share of the way between two ends, `step` away from the only one, or `free` where there is none.
    pub fn at(&self, share: f64, step: f64, free: f64) -> f64 {
        match self.bounds() {
            [Some(low), Some(high)] => low + share * (high - low),
            [Some(low), None] => low + step,
            [None, Some(high)] => high - step,
            [None, None] => free,
        }
    }

    /// Whether a double lies between the ends, these included.
    pub fn admits(&self, x: f64) -> bool {
        let [low, high] = self.bounds();
        low.is_none_or(|low| low <= x) && high.is_none_or(|high| x <= high)
    }

    /// Whether it lies within another bounded interval, ends included.
    pub fn lies_within(&self, outer: &Domain) -> bool {
        match [self.bounds(), outer.bounds()] {
            [[Some(a), Some(b)], [Some(low), Some(high)]] => a >= low && b <= high,
            _ => false,
        }
    }

    /// Whether a number is an end of the interval.
    pub fn is_end(&self, x: &Rational) -> bool {
        self.ends()
            .any(|end| end.compare(x) == Some(Ordering::Equal))
    }

    /// Whether the interval holds both positive and negative numbers.
    pub fn changes_sign(&self) -> bool {
        self.low.as_ref().is_none_or(|l| l.value.is_negative())
            && self.high.as_ref().is_none_or(|h| h.value.is_positive())
    }

    /// The part with the given sign: numbers ≥ 0 for `positive`, else numbers ≤ 0.
    pub fn half(&self, positive: bool) -> Domain {
        let zero = Some(Limit::number(Rational::zero(), false));
        match positive {
            true => Domain::new(zero, self.high.clone()),
            false => Domain::new(self.low.clone(), zero),
        }
    }

    /// The domain as a condition on a symbol, such as `0 < theta < pi/2`.
    pub fn words(&self, symbol: &str) -> String {
        let end = |l: &Limit| {
            if !l.of_pi || l.value.is_zero() {
                return l.value.to_string();
            }
            let times = match l.value.numer().as_i64() {
                Some(1) => String::new(),
                Some(-1) => String::from("-"),
                _ => format!("{}*", l.value.numer()),
            };
            match l.value.is_integer() {
                true => format!("{times}pi"),
                false => format!("{times}pi/{}", l.value.denom()),
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
    /// Where a symbol lives: positive where nothing is declared of it.
    pub fn of_symbol(&self, name: &Symbol) -> Domain {
        let own = self.symbols.get(name);
        own.cloned().unwrap_or_else(Domain::positive)
    }

    /// The domain with every undeclared symbol of `roles` declared by the default, and the defaults used, in words.
    pub fn completed(&self, roles: &Roles) -> (Domains, Vec<String>) {
        let mut all = self.clone();
        let mut assumed = Vec::new();
        for (name, role) in &roles.symbols {
            if all.symbols.contains_key(name) {
                continue;
            }
            let domain = match role.turns {
                _ if self.is_component(name) => Domain::between(ratio(-1, 1), ratio(1, 1)),
                true => Domain::first_quadrant(),
                false => Domain::positive(),
            };
            if !self.is_component(name) {
                assumed.push(domain.words(name));
            }
            all.symbols.insert(name.clone(), domain);
        }
        (all, assumed)
    }

    /// The other component of a unit vector.
    pub fn other_component(&self, name: &Symbol) -> Option<&Symbol> {
        self.unit_vectors.iter().find_map(|[a, b]| match name {
            _ if name == a => Some(b),
            _ if name == b => Some(a),
            _ => None,
        })
    }

    /// Whether a symbol is a component of a unit vector.
    pub fn is_component(&self, name: &Symbol) -> bool {
        self.other_component(name).is_some()
    }

    /// The domain with every symbol of some formulas declared.
    pub fn of(&self, formulas: &[&Expr]) -> Domains {
        self.completed(&roles(formulas)).0
    }

    /// The domain without the ends of its intervals.
    pub fn inside(&self) -> Domains {
        let mut out = self.clone();
        let all = out.symbols.values_mut();
        for end in all.flat_map(|d| [&mut d.low, &mut d.high]).flatten() {
            end.open = true;
        }
        out
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
