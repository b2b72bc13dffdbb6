//! Relations between symbols, such as `M > m`: which points keep to them, and which belong to the symbols in play.

use std::cell::OnceCell;
use std::collections::BTreeSet;

use super::{Domains, Sample};
use crate::expr::{Expr, Symbol};
use crate::interval::{Interval, Outcome, evaluate};

/// An inequality between formulas of the symbols.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Relation {
    /// The smaller side and the larger one.
    pub sides: [Expr; 2],
    /// What is positive by it: the larger side minus the smaller one, or something of the same sign.
    pub excess: Expr,
    /// Whether the two sides may be equal.
    pub closed: bool,
    /// As stated, such as `M > m`.
    pub words: String,
    /// Where it comes from.
    pub origin: Origin,
}

/// Where a relation comes from.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub enum Origin {
    /// It is stated.
    #[default]
    Stated,
    /// An outcome of an impact needs it: which one, such as "`C` slides".
    Outcome(String),
    /// A motion needs it to come to its end, as in "`round` comes to its end"; formulas of its end have values beyond it.
    Ending(String),
}

impl Origin {
    /// What it is needed for; nothing where it is stated.
    pub fn so_that(&self) -> Option<&str> {
        match self {
            Origin::Stated => None,
            Origin::Outcome(what) | Origin::Ending(what) => Some(what),
        }
    }
}

impl Relation {
    /// That something is positive, or not negative where `closed`, in words.
    pub fn needed(excess: &Expr, closed: bool, words: String, origin: Origin) -> Relation {
        Relation {
            sides: [Expr::zero(), excess.clone()],
            excess: excess.clone(),
            closed,
            words,
            origin,
        }
    }

    /// Whether a value of the excess, told by its bounds, keeps to it; `None` where the bounds do not tell.
    pub fn admits(&self, low: f64, high: f64) -> Option<bool> {
        if low > 0.0 || (self.closed && low == 0.0) {
            return Some(true);
        }
        (high < 0.0 || (!self.closed && high == 0.0)).then_some(false)
    }
}

impl Domains {
    /// The same with something that is positive besides, or not negative where `closed`.
    pub fn given(&self, excess: &Expr, closed: bool) -> Domains {
        let relation = Relation::needed(excess, closed, String::new(), Origin::Stated);
        self.with_relation(relation)
    }

    /// The same with a relation besides; of two that say the same the stricter one holds.
    pub fn with_relation(&self, relation: Relation) -> Domains {
        let mut domains = self.clone();
        let mut known = domains.relations.iter_mut();
        match known.find(|r| r.excess == relation.excess) {
            Some(known) if known.words.is_empty() => {
                let closed = known.closed && relation.closed;
                *known = Relation { closed, ..relation };
            }
            Some(known) => known.closed &= relation.closed,
            None => domains.relations.push(relation),
        }
        domains
    }

    /// The relations that bear upon some symbols, directly or through each other.
    pub fn relations_of(&self, symbols: &BTreeSet<Symbol>) -> Vec<&Relation> {
        let mut reached = symbols.clone();
        let mut taken = vec![false; self.relations.len()];
        loop {
            let mut grew = false;
            for (relation, taken) in self.relations.iter().zip(&mut taken) {
                let own = relation.excess.symbols();
                if !*taken && own.iter().any(|name| reached.contains(name)) {
                    (*taken, grew) = (true, true);
                    reached.extend(own);
                }
            }
            if !grew {
                break;
            }
        }
        let all = self.relations.iter().zip(taken);
        all.filter_map(|(r, taken)| taken.then_some(r)).collect()
    }

    /// The relations between symbols that all have a place.
    pub(super) fn placed(&self, has_place: impl Fn(&Symbol) -> bool) -> Vec<&Relation> {
        let placed = |name: &Symbol| &**name == "pi" || has_place(name);
        let all = self.relations.iter();
        all.filter(|r| r.excess.symbols().iter().all(placed))
            .collect()
    }

    /// Whether a point keeps for certain to every relation between symbols that it places.
    pub fn admits(&self, sample: &Sample) -> bool {
        sample.keeps_to(&self.placed(|name| sample.coordinates.contains_key(name)))
    }

    /// Whether it does so with another value of one symbol, which is told by its bounds.
    pub fn admits_with(&self, sample: &Sample, name: &Symbol, value: Interval) -> bool {
        let placed = self.placed(|other| other == name || sample.coordinates.contains_key(other));
        if placed.is_empty() {
            return true;
        }
        let mut point = sample.point::<Interval>(true);
        point.directions.remove(name);
        point.values.insert(name.clone(), Outcome::Value(value));
        placed.iter().all(|r| {
            let excess = evaluate(&r.excess, &point);
            matches!(excess, Outcome::Value(v) if r.admits(v.low, v.high) == Some(true))
        })
    }

    /// What is said of the symbols, one condition each: ends of intervals, unit vectors, relations.
    pub fn conditions(&self) -> Vec<String> {
        let bounded = self.symbols.iter();
        let bounded = bounded.filter(|(_, d)| d.low.is_some() || d.high.is_some());
        let pairs = self.unit_vectors.iter();
        bounded
            .map(|(name, domain)| domain.words(name))
            .chain(pairs.map(|[a, b]| format!("{a}^2 + {b}^2 = 1")))
            .chain(self.relations.iter().map(|r| r.words.clone()))
            .collect()
    }
}

impl Sample {
    /// Whether the point keeps for certain to relations between symbols that it places.
    pub(super) fn keeps_to(&self, relations: &[&Relation]) -> bool {
        if relations.is_empty() {
            return true;
        }
        // Angles known by direction get their value where a relation needs it.
        let plain = self.point::<Interval>(false);
        let full = OnceCell::new();
        relations.iter().all(|r| {
            let bounds = match evaluate::<Interval>(&r.excess, &plain) {
                Outcome::Value(v) => Outcome::Value(v),
                _ => evaluate(&r.excess, full.get_or_init(|| self.point(true))),
            };
            matches!(bounds, Outcome::Value(v) if r.admits(v.low, v.high) == Some(true))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::{roles, samples};

    fn chain() -> Domains {
        let relation = |small: &str, large: &str, closed| {
            let [small, large] = [small, large].map(Expr::symbol);
            Relation {
                excess: large.clone() - small.clone(),
                sides: [small, large],
                closed,
                words: String::new(),
                origin: Origin::Stated,
            }
        };
        Domains {
            relations: vec![relation("m", "M", false), relation("k", "m", true)],
            ..Domains::default()
        }
    }

    #[test]
    fn points_keep_to_relations_through_symbols_that_are_not_asked_for() {
        let e = Expr::symbol("M") + Expr::symbol("k");
        let roles = roles(&[&e]);
        let (domains, _) = chain().completed(&roles);
        let all = samples(&roles, &domains, 12);
        assert_eq!(all.len(), 12);
        for sample in all {
            assert_eq!(sample.coordinates.len(), 2);
            let gap = Expr::symbol("M") - Expr::symbol("k");
            match evaluate::<Interval>(&gap, &sample.point(false)) {
                Outcome::Value(v) => assert!(v.low > 0.0, "{}", sample.words()),
                _ => panic!("a value"),
            }
        }
    }

    #[test]
    fn a_point_is_left_out_where_another_value_of_a_symbol_breaks_a_relation() {
        let e = Expr::symbol("M") + Expr::symbol("m");
        let roles = roles(&[&e]);
        let (domains, _) = chain().completed(&roles);
        for sample in samples(&roles, &domains, 4) {
            let far =
                |value| domains.admits_with(&sample, &"M".into(), Interval::new(value, value));
            assert!(far(1e6) && !far(1e-6), "{}", sample.words());
        }
    }

    #[test]
    fn a_formula_without_symbols_has_a_point_whatever_the_relations() {
        let all = samples(&roles(&[&Expr::one()]), &chain(), 3);
        assert_eq!(all.len(), 1);
    }

    #[test]
    fn an_open_relation_excludes_equal_sides() {
        let domains = chain();
        let [open, closed] = domains.relations.as_slice() else {
            panic!("two relations")
        };
        assert_eq!(open.admits(0.0, 0.0), Some(false));
        assert_eq!(closed.admits(0.0, 0.0), Some(true));
        assert_eq!(open.admits(-1.0, 1.0), None);
    }
}
