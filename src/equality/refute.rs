//! Looking for a point at which two formulas part: exactly where their values are fractions, else in enclosures of rising
//! precision.

use super::exact::Exact;
use super::measure::Size;
use super::{Counterexample, Evidence, Side, Value};
use crate::domain::{Coordinate, Roles, Sample};
use crate::expr::{Expr, Rational, Symbol};
use crate::interval::{Big, Certified, Enclosure, Interval, Outcome, evaluate};

/// A pair of formulas to be compared at points.
pub(super) struct Probe<'a> {
    left: &'a Expr,
    right: &'a Expr,
    radians: bool,
    angles: Vec<Symbol>,
    constant: bool,
}

/// What the points tried so far have shown: counts of points.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally {
    pub exact_equal: usize,
    pub both_defined: usize,
    /// Of either side.
    defined: [usize; 2],
    undefined: [usize; 2],
    /// Points where exactly one side has a value, with that side's value.
    pub apart: Vec<(Sample, Value, Value)>,
    /// Points where both are enclosed and overlap.
    pub enclosed: usize,
    pub digits: u32,
}

impl Tally {
    pub fn evidence(&self) -> Evidence {
        Evidence {
            exact_points: self.exact_equal,
            enclosed_points: self.enclosed,
            digits: self.digits,
        }
    }

    pub fn defined(&self, side: Side) -> usize {
        self.defined[side as usize]
    }

    pub fn undefined(&self, side: Side) -> usize {
        self.undefined[side as usize]
    }

    fn note<T>(&mut self, left: &Outcome<T>, right: &Outcome<T>) {
        for (side, outcome) in [left, right].into_iter().enumerate() {
            self.defined[side] += usize::from(matches!(outcome, Outcome::Value(_)));
            self.undefined[side] += usize::from(matches!(outcome, Outcome::Undefined));
        }
        let both = matches!((left, right), (Outcome::Value(_), Outcome::Value(_)));
        self.both_defined += usize::from(both);
    }
}

impl<'a> Probe<'a> {
    pub fn new(left: &'a Expr, right: &'a Expr, roles: &Roles) -> Probe<'a> {
        let angles = roles.symbols.iter().filter(|(_, r)| r.turns && !r.bare);
        Probe {
            left,
            right,
            radians: roles.radians,
            angles: angles.map(|(name, _)| name.clone()).collect(),
            constant: roles.symbols.is_empty(),
        }
    }

    fn values<T: Certified>(&self, at: &Sample) -> (Outcome<T>, Outcome<T>) {
        // An angle whose domain left no rational direction has a plain value; the others must then have theirs too.
        let plain =
            |name: &Symbol| !matches!(at.coordinates.get(name), Some(Coordinate::Direction { .. }));
        let radians = self.radians || self.angles.iter().any(plain);
        let point = at.point::<T>(radians);
        (evaluate(self.left, &point), evaluate(self.right, &point))
    }

    /// Compares at each point, exactly where possible, else in double intervals.
    pub fn points(&self, points: &[Sample], tally: &mut Tally) -> Option<Counterexample> {
        points.iter().find_map(|at| self.point(at, tally))
    }

    fn point(&self, at: &Sample, tally: &mut Tally) -> Option<Counterexample> {
        let (left, right) = self.values::<Exact>(at);
        if let (Outcome::Value(Exact(l)), Outcome::Value(Exact(r))) = (&left, &right) {
            tally.note(&left, &right);
            if l == r {
                tally.exact_equal += 1;
                return None;
            }
            return Some(self.confirm(at, l.clone(), r.clone()));
        }
        if let (Outcome::Undefined, Outcome::Undefined) = (&left, &right) {
            tally.note(&left, &right);
            return None;
        }
        let (rough_left, rough_right) = self.values::<Interval>(at);
        // What exact arithmetic knows for sure stands.
        let merge = |exact: &Outcome<Exact>, rough: Outcome<Interval>| match exact {
            Outcome::Undefined => Outcome::Undefined,
            Outcome::Value(Exact(v)) => Outcome::Value(Interval::from_rational(v)),
            Outcome::Unknown => rough,
        };
        let (l, r) = (merge(&left, rough_left), merge(&right, rough_right));
        tally.note(&l, &r);
        match (&l, &r) {
            (Outcome::Value(l), Outcome::Value(r)) => {
                if l.is_disjoint(r) {
                    return self.separate(at, &left, &right);
                }
                tally.enclosed += 1;
                tally.digits = tally.digits.max(agreement(l, r));
                None
            }
            (Outcome::Undefined, Outcome::Value(_)) => {
                if let Some(value) = self.shown(&right, at, false) {
                    tally.apart.push((at.clone(), Value::None, value));
                }
                None
            }
            (Outcome::Value(_), Outcome::Undefined) => {
                if let Some(value) = self.shown(&left, at, true) {
                    tally.apart.push((at.clone(), value, Value::None));
                }
                None
            }
            _ => None,
        }
    }

    fn shown(&self, exact: &Outcome<Exact>, at: &Sample, left: bool) -> Option<Value> {
        if let Outcome::Value(Exact(v)) = exact {
            return Some(Value::Exact(v.clone()));
        }
        let (l, r) = self.values::<Big<192>>(at);
        match if left { l } else { r } {
            Outcome::Value(Big(e)) => Some(Value::Within(e)),
            _ => None,
        }
    }

    /// Values for show at a point where double intervals are disjoint.
    fn separate(
        &self,
        at: &Sample,
        left: &Outcome<Exact>,
        right: &Outcome<Exact>,
    ) -> Option<Counterexample> {
        let (l, r) = (self.shown(left, at, true)?, self.shown(right, at, false)?);
        let apart = match (enclosure(&l), enclosure(&r)) {
            (Some(l), Some(r)) => l.is_disjoint(&r),
            _ => false,
        };
        // Two independent enclosures must agree that the values differ.
        apart.then(|| Counterexample::confirmed(at, l, r))
    }

    /// A counterexample in fractions, checked by interval arithmetic: doubles first, dyadic numbers where these overlap.
    fn confirm(&self, at: &Sample, left: Rational, right: Rational) -> Counterexample {
        let smaller_left = left < right;
        let confirmed = match self.values::<Interval>(at) {
            (Outcome::Value(l), Outcome::Value(r)) if l.is_disjoint(&r) => {
                (l.high < r.low) == smaller_left
            }
            _ => match self.values::<Big<192>>(at) {
                (Outcome::Value(Big(l)), Outcome::Value(Big(r))) => {
                    l.is_disjoint(&r)
                        && (l.high < r.low) == smaller_left
                        && l.contains(&left)
                        && r.contains(&right)
                }
                _ => false,
            },
        };
        let [left, right] = [left, right].map(Value::Exact);
        Counterexample {
            confirmed,
            ..Counterexample::confirmed(at, left, right)
        }
    }

    /// Compares at rising precision, as far as the work limit for the size allows.
    pub fn rising_precision(
        &self,
        points: &[Sample],
        size: Size,
        tally: &mut Tally,
    ) -> Option<Counterexample> {
        self.level::<192>(points, 6, size, tally)
            .or_else(|| self.level::<640>(points, 3, size, tally))
            .or_else(|| self.level::<4096>(points, 2, size, tally))
    }

    fn level<const BITS: u32>(
        &self,
        points: &[Sample],
        most: usize,
        size: Size,
        tally: &mut Tally,
    ) -> Option<Counterexample> {
        let count = if self.constant { 1 } else { most };
        for at in points.iter().take(count.min(size.evaluations(BITS))) {
            let (Outcome::Value(Big(l)), Outcome::Value(Big(r))) = self.values::<Big<BITS>>(at)
            else {
                continue;
            };
            if l.is_disjoint(&r) {
                let [left, right] = [l, r].map(Value::Within);
                return Some(Counterexample::confirmed(at, left, right));
            }
            tally.both_defined += 1;
            let digits = l.digits().min(r.digits()).min(BITS * 3 / 10);
            tally.digits = tally.digits.max(digits);
        }
        None
    }
}

fn agreement(l: &Interval, r: &Interval) -> u32 {
    let width = (l.high.max(r.high) - l.low.min(r.low)).abs();
    let size = l.high.abs().max(r.high.abs());
    match size > 0.0 && width > 0.0 {
        true => (size / width).log10().clamp(0.0, 15.0) as u32,
        false => 0,
    }
}

/// The enclosure of a value, unless there is none.
pub(super) fn enclosure(value: &Value) -> Option<Enclosure> {
    match value {
        Value::Exact(v) => Some(Enclosure::of(v, 256)),
        Value::Within(e) => Some(e.clone()),
        Value::None => None,
    }
}

/// The sign of an expression at a point, where enclosures tell it.
pub(crate) fn sign_at(e: &Expr, at: &Sample) -> Option<i32> {
    // Arc tangents for the radians of known directions cost more than the rest; they are rarely needed.
    let value = [false, true].into_iter().find_map(|radians| {
        match evaluate::<Big<192>>(e, &at.point(radians)) {
            Outcome::Value(Big(value)) => Some(value),
            _ => None,
        }
    })?;
    match (value.low.sign(), value.high.sign()) {
        (1, _) => Some(1),
        (_, -1) => Some(-1),
        (0, 0) => Some(0),
        _ => None,
    }
}
