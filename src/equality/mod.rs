//! When are two formulas equal: proved, refuted at a point that can be checked by hand, or honestly undecided.
//!
//! In: two expressions and the domain their symbols live in. Out: a [`Decision`]. Refutation needs no algebra: unequal exact
//! fractions at an exact point of the domain, or disjoint enclosures there. Proof is `algebra`'s normal form. No decision is
//! probabilistic: agreement at points is evidence and is called that; [`at_points`] alone says how likely it is to err.

mod arcs;
mod branch;
mod constants;
mod critical;
mod exact;
mod gap;
mod lattice;
mod line;
mod measure;
mod modular;
mod pinned;
mod proof;
mod refute;
mod valley;
mod verdict;

use std::collections::BTreeSet;

use num_traits::Zero;

use crate::algebra::{self, Stop};
use crate::domain::{Domain, Domains, Roles, Sample, at_ends, roles, samples};
use crate::expr::{Expr, Node, Symbol, effort};
pub(crate) use gap::{divisors, poles};
pub(crate) use line::zero_apart;
use measure::Size;
pub(crate) use measure::work;
pub use modular::AtPoints;
use pinned::Pin;
use proof::Proof;
pub(crate) use refute::sign_at;
use refute::{Probe, Tally};
pub use verdict::{
    Assumption, Condition, Counterexample, Decision, Equality, Evidence, Ground, How, Reason, Side,
    Value,
};

/// Points tried before any proof.
const FIRST: usize = 2;
/// Products of terms beyond which a proof costs more than a look at many digits.
const COSTLY: usize = 2_000_000;

/// Points from which a value below zero is looked for.
const LOOKED_FROM: usize = 8;

/// Whether a point of the domain is found at which an expression is negative: each symbol is led to both sides of every place
/// where it changes sign, to ends and far out.
pub(crate) fn falls_below_zero(e: &Expr, domains: &Domains) -> bool {
    let bearing = domains.relations_of(&e.symbols());
    let all: Vec<&Expr> = bearing.iter().map(|r| &r.excess).chain([e]).collect();
    let roles = roles(&all);
    let (domains, _) = domains.completed(&roles);
    let near = samples(&roles, &domains, LOOKED_FROM);
    let supposed = [Assumption::NotNegative(e.clone())];
    critical::tested(&supposed, &[], &near, &domains, &roles).is_err()
}

/// Decides whether two formulas have the same value everywhere on the domain.
///
/// Same result on every machine: limits count points, nodes and bits. Same result in either order: the search always begins
/// with the one that comes first among expressions.
pub fn decide(a: &Expr, b: &Expr, domains: &Domains) -> Decision {
    match b < a {
        true => decide_in_order(b, a, domains).turned(),
        false => decide_in_order(a, b, domains),
    }
}

fn decide_in_order(a: &Expr, b: &Expr, domains: &Domains) -> Decision {
    let open = |reason| Decision {
        equality: Equality::Undecided {
            reason,
            evidence: Evidence::default(),
        },
        assumed: Vec::new(),
    };
    if effort::spent() {
        return open(Reason::Limit(Stop::TooLarge("steps").to_string()));
    }
    let Some((size, roles)) = within_limits(a, b) else {
        return open(Reason::TooLarge);
    };
    let (domains, assumed) = domains.completed(&roles);
    Decision {
        equality: decide_on(a, b, &domains, &roles, size),
        assumed,
    }
}

/// Whether an expression is zero, and be it on a part of the domain.
pub fn vanishes(e: &Expr, domains: &Domains) -> bool {
    decide(e, &Expr::zero(), domains).equality.is_same()
}

/// Whether two formulas are proved equal on the whole domain.
pub fn identical(a: &Expr, b: &Expr, domains: &Domains) -> bool {
    decide(a, b, domains).equality.is_identity()
}

/// Compares two formulas at random points modulo a prime alone, with the domains assumed, in words. `None` where they are
/// not of the kind this is for.
pub fn at_points(a: &Expr, b: &Expr, domains: &Domains) -> Option<(AtPoints, Vec<String>)> {
    let (_, roles) = within_limits(a, b)?;
    let (domains, assumed) = domains.completed(&roles);
    let found = modular::Pair::of(a, b, &domains, &roles)?.at_points()?;
    Some((found, assumed))
}

/// The size of a pair and how its symbols occur; `None` beyond the limits.
fn within_limits(a: &Expr, b: &Expr) -> Option<(Size, Roles)> {
    let size = measure::of(&[a, b])?;
    let roles = roles(&[a, b]);
    Some((size.with(&roles)?, roles))
}

/// Most points at which two formulas both have values that count as ends where they meet.
const MEETINGS: usize = 2;

/// How many times more points are tried where it is certain that the formulas differ.
const PATIENCE: usize = 10;

/// A pair with what is known of it so far.
struct Search<'a> {
    a: &'a Expr,
    b: &'a Expr,
    domains: &'a Domains,
    roles: &'a Roles,
    size: Size,
    probe: Probe<'a>,
    points: Vec<Sample>,
    tally: Tally,
    /// Whether they differ for certain: then no proof is tried, and a point is looked for that can be shown.
    apart: bool,
    /// What roots and logarithms are taken of, where that may be negative.
    unsure: Vec<(Expr, bool)>,
    /// Symbols whose only value these allow is an end of the domain.
    pins: Vec<Pin>,
}

fn decide_on(a: &Expr, b: &Expr, domains: &Domains, roles: &Roles, size: Size) -> Equality {
    let pair = modular::Pair::of(a, b, domains, roles);
    let decided = pair.and_then(|pair| pair.decided());
    if decided == Some(true) {
        let how = How::Identity {
            ground: Ground::NormalForm,
            assumptions: Vec::new(),
        };
        return Equality::Same { how };
    }
    let mut search = Search {
        a,
        b,
        domains,
        roles,
        size,
        probe: Probe::new(a, b, roles),
        points: Vec::new(),
        tally: Tally::default(),
        apart: decided == Some(false),
        unsure: Vec::new(),
        pins: Vec::new(),
    };
    if let Some(found) = search.before_proof() {
        return search.different(found);
    }
    let proof = search.proof();
    match proof {
        Proof::Invalid(side) if search.tally.defined(side) == 0 => search.invalid(side),
        Proof::Equal(assumptions, ground) if search.tally.both_defined > 0 => {
            search.equal(assumptions, ground)
        }
        open => search.after_proof(open),
    }
}

/// A formula of so many parts is first looked at for another order of them: a sum of fractions has a large common denominator.
const LONG: usize = 50;

/// A formula with the parts of its sums and products in one order.
fn ordered(e: &Expr) -> Expr {
    let sorted = |parts: &[Expr]| {
        let mut parts: Vec<Expr> = parts.iter().map(ordered).collect();
        parts.sort();
        parts
    };
    match e.node() {
        Node::Sum(parts) => Expr::sum(sorted(parts)),
        Node::Product(parts) => Expr::product(sorted(parts)),
        _ => e.map_parts(ordered),
    }
}

impl Search<'_> {
    /// Points tried before any proof.
    fn before_proof(&mut self) -> Option<Counterexample> {
        // The simplest points first: nearly every wrong formula fails there.
        if let Some(found) = self.extend(FIRST) {
            return Some(found);
        }
        // Roots and logarithms lack values on whole parts of a domain; more points show it.
        let signed = self.domains.symbols.values().any(Domain::changes_sign);
        let nowhere = self.tally.both_defined == 0;
        if self.size.partial || nowhere {
            let seen = if signed || nowhere { 8 } else { 5 };
            if let Some(found) = self.extend(self.size.points().min(seen)) {
                return Some(found);
            }
        }
        // Then both sides of the places where what they are taken of changes sign.
        if self.size.branches || self.size.partial {
            self.unsure = critical::arguments(&[self.a, self.b]);
            self.unsure
                .retain(|(e, _)| !critical::nowhere_negative(e, self.domains));
        }
        if !self.unsure.is_empty() {
            let arguments: Vec<Expr> = self.unsure.iter().map(|(e, _)| e.clone()).collect();
            let near = samples(self.roles, self.domains, FIRST + 2);
            let risky = critical::points(&arguments, &near, self.domains, self.roles);
            if let Some(found) = self.probe.points(&risky, &mut self.tally) {
                return Some(found);
            }
        }
        self.pins = pinned::pins(&self.needed(), self.domains);
        if !self.pins.is_empty() {
            let points = self.points_with(&self.pins, 8);
            if let Some(found) = self.probe.points(&points, &mut self.tally) {
                return Some(found);
            }
        }
        // A root may have its only values at closed ends.
        if self.tally.both_defined == 0 {
            let near = samples(self.roles, self.domains, FIRST);
            let ends = at_ends(&near, self.domains);
            if let Some(found) = self.probe.points(&ends, &mut self.tally) {
                return Some(found);
            }
        }
        let costly = work(self.a).saturating_add(work(self.b)) > COSTLY;
        if self.a == self.b || !costly {
            return None;
        }
        let first = samples(self.roles, self.domains, FIRST);
        self.probe
            .rising_precision(&first, self.size, &mut Tally::default())
    }

    /// Compares at the first points of the domain, as many as told, that were not tried yet.
    fn extend(&mut self, count: usize) -> Option<Counterexample> {
        let mut new = samples(self.roles, self.domains, count);
        new.retain(|p| !self.points.contains(p));
        let found = self.probe.points(&new, &mut self.tally);
        self.points.extend(new);
        found
    }

    fn proof(&self) -> Proof {
        let (a, b, domains) = (self.a, self.b, self.domains);
        // What costs much to multiply out is often the same in another order.
        let costly = || a.size() > LONG || work(a).saturating_add(work(b)) > COSTLY;
        let same = a == b || a.size() == b.size() && costly() && ordered(a) == ordered(b);
        if same && self.tally.both_defined > 0 {
            return Proof::Equal(Vec::new(), Ground::NormalForm);
        }
        if self.apart {
            return Proof::Unequal {
                settled: true,
                folded: Vec::new(),
            };
        }
        let open = match proof::compare(a, b, domains) {
            known @ (Proof::Equal(..) | Proof::Invalid(_)) => return known,
            open => open,
        };
        let settled = matches!(open, Proof::Unequal { settled: true, .. });
        let beyond = match settled {
            true => None,
            false => lattice::prove(a, b).or_else(|| arcs::prove(a, b, domains)),
        };
        beyond
            .or_else(|| constants::prove(a, b, domains))
            .or_else(|| self.other_proofs().next())
            .or_else(|| self.on_halves(&open))
            .or_else(|| if settled { None } else { self.above_ends() })
            .unwrap_or(open)
    }

    /// A proof for what is above zero and one for what is below, where the absolute values of one symbol or two stand in the
    /// way: cos|x| is cos x in both. Where something that must not be negative is so, there is nothing to prove.
    fn on_halves(&self, open: &Proof) -> Option<Proof> {
        let Proof::Unequal { folded, .. } = open else {
            return None;
        };
        let is_split = |name: &&Symbol| {
            let changes = self.domains.symbols.get(*name);
            changes.is_some_and(Domain::changes_sign) && !self.domains.is_component(name)
        };
        let plain = folded.iter().filter(|e| !matches!(e.node(), Node::Sum(_)));
        let names: BTreeSet<Symbol> = plain.flat_map(Expr::symbols).collect();
        let names: Vec<&Symbol> = names.iter().filter(is_split).collect();
        if names.is_empty() || names.len() > 2 {
            return None;
        }
        let needed = self.needed();
        let (mut used, mut ground) = (Vec::new(), None);
        for signs in 0..1 << names.len() {
            let mut half = self.domains.clone();
            let mut pair = [self.a.clone(), self.b.clone()];
            for (i, name) in names.iter().enumerate() {
                let positive = signs >> i & 1 == 0;
                let x = Expr::symbol(name);
                let value = if positive { x.clone() } else { -&x };
                pair = pair.map(|e| branch::unfold(&e, &x, &value));
                if let Some(domain) = half.symbols.get_mut(*name) {
                    *domain = domain.half(positive);
                    if self.divides_by(name) {
                        domain.leave_out(0);
                    }
                }
            }
            let below = |e: &Expr| algebra::sign(e, &half) == Some(algebra::Sign::Negative);
            if let Some(none) = needed.iter().find(|e| below(e)) {
                used.push(none.clone());
                continue;
            }
            let [a, b] = pair;
            let proof = match proof::compare(&a, &b, &half) {
                known @ Proof::Equal(..) => known,
                _ => arcs::prove(&a, &b, &half)?,
            };
            match proof {
                Proof::Equal(assumed, found) if assumed.is_empty() => {
                    ground.get_or_insert(found);
                }
                _ => return None,
            }
        }
        used.dedup();
        Proof::Equal(Vec::new(), ground?).with_roots(used)
    }

    /// A proof above the closed ends at zero and one at each of them: powers with symbols above follow their laws for positive
    /// bases, and 0ⁿ is 0.
    fn above_ends(&self) -> Option<Proof> {
        let zero = |d: &Domain| {
            let low = d.low.as_ref();
            low.is_some_and(|l| !l.open && l.value.is_zero()) && d.bounds()[1] != Some(0.0)
        };
        let own = |name: &Symbol| self.roles.symbols.contains_key(name);
        let mut open = self.domains.clone();
        let mut names = Vec::new();
        for (name, domain) in open
            .symbols
            .iter_mut()
            .filter(|(name, d)| own(name) && zero(d))
        {
            domain.low.as_mut()?.open = true;
            names.push(name.clone());
        }
        if names.is_empty() || names.len() > 2 || !open.relations.is_empty() {
            return None;
        }
        let mut whole = None;
        for ends in 0..1 << names.len() {
            let at_end = names.iter().enumerate().filter(|(i, _)| ends >> i & 1 == 1);
            let put = |e: &Expr| {
                at_end
                    .clone()
                    .fold(e.clone(), |e, (_, n)| e.put(n, &Expr::zero()))
            };
            let [a, b] = [put(self.a), put(self.b)];
            let proof = match proof::compare(&a, &b, &open) {
                known @ Proof::Equal(..) => known,
                _ => arcs::prove(&a, &b, &open)?,
            };
            let is_proved = matches!(&proof, Proof::Equal(assumed, _) if assumed.is_empty());
            whole.get_or_insert(is_proved.then_some(proof)?);
        }
        whole
    }

    /// Whether one of the two has no value where a symbol is zero.
    fn divides_by(&self, name: &Symbol) -> bool {
        [self.a, self.b].into_iter().any(|e| {
            let there = e.put(name, &Expr::zero());
            matches!(
                algebra::Field::of(self.domains, &there),
                Err(Stop::DivisionByZero)
            )
        })
    }

    /// What must not be negative where both have values.
    fn needed(&self) -> Vec<Expr> {
        let needed = self.unsure.iter().filter(|(_, needed)| *needed);
        needed.map(|(e, _)| e.clone()).collect()
    }

    /// Proofs where both have values, and in either order: what is read first may decide how the other is written, and
    /// neither order knows more than the other.
    fn other_proofs(&self) -> impl Iterator<Item = Proof> {
        let orders = [(self.a, self.b), (self.b, self.a)];
        let needed = self.needed();
        let where_defined = orders.into_iter().filter_map(move |(a, b)| {
            let (proof, used) = proof::compare_where_defined(a, b, self.domains, &needed)?;
            proof.with_roots(used)
        });
        let pinned = (!self.pins.is_empty()).then_some(&self.pins).into_iter();
        let pinned = pinned.filter_map(|pins| self.proof_with(pins));
        let turned = std::iter::once_with(|| proof::compare(self.b, self.a, self.domains));
        let found = |proof: &Proof| matches!(proof, Proof::Equal(..));
        pinned.chain(where_defined).chain(turned).filter(found)
    }

    /// The verdict for a proved identity, once signs that were only seen are put to the test.
    fn equal(&mut self, assumptions: Vec<Assumption>, ground: Ground) -> Equality {
        if let Some(known) = self.tested(assumptions, ground) {
            return known;
        }
        // A sign may fail where the two have no values or agree all the same: that spoils one proof, not the others.
        let others: Vec<Proof> = self.other_proofs().collect();
        for proof in others {
            if let Proof::Equal(assumptions, ground) = proof
                && let Some(known) = self.tested(assumptions, ground)
            {
                return known;
            }
        }
        self.undecided(Reason::NoPointApart)
    }

    /// Puts signs that a proof took for granted to the test.
    fn put_to_the_test(&self, assumed: &[Assumption]) -> Result<Vec<Assumption>, Vec<Sample>> {
        let near = samples(self.roles, self.domains, FIRST + 2);
        // What signs are taken of may have been written out on the way; here its squares are left.
        let factors = self.unsure.iter().flat_map(|(e, _)| e.factors());
        let sums: Vec<Expr> = factors.cloned().collect();
        critical::tested(assumed, &sums, &near, self.domains, self.roles)
    }

    /// The verdict of a proof, unless a sign that it took for granted fails.
    fn tested(&mut self, assumptions: Vec<Assumption>, ground: Ground) -> Option<Equality> {
        let tested = self.put_to_the_test(&assumptions);
        // A sign that was not put to the test is not to be taken for granted.
        if tested.as_ref().is_ok_and(|left| !left.is_empty()) && effort::spent() {
            let limit = Stop::TooLarge("steps").to_string();
            return Some(self.undecided(Reason::Limit(limit)));
        }
        match tested {
            Ok(assumptions) => {
                let pair = (self.a, self.b);
                Some(gap::same(
                    pair,
                    self.domains,
                    assumptions,
                    ground,
                    &self.tally,
                ))
            }
            Err(points) => {
                let found = self.probe.points(&points, &mut self.tally)?;
                Some(self.different(found))
            }
        }
    }

    /// Points where the two may part: where what absolute values are taken of changes sign and, of formulas that differ for
    /// certain, where a sign fails that a proof would take for granted.
    fn risky(&self, proof: &Proof) -> Vec<Sample> {
        let near = samples(self.roles, self.domains, FIRST + 2);
        match proof {
            Proof::Unequal { folded, .. } if !folded.is_empty() => {
                critical::points(folded, &near, self.domains, self.roles)
            }
            Proof::Equal(assumptions, _) if self.apart => {
                let tested = self.put_to_the_test(assumptions);
                tested.err().unwrap_or_default()
            }
            _ => Vec::new(),
        }
    }

    /// More points and more digits, where no proof was found.
    fn after_proof(&mut self, proof: Proof) -> Equality {
        // Of formulas that differ for certain it is worth looking longer for a point that can be shown.
        let patience = if self.apart { PATIENCE } else { 1 };
        if let Some(found) = self.extend(patience * self.size.points()) {
            return self.different(found);
        }
        let risky = match self.apart {
            true => self.risky(&proof::compare(self.a, self.b, self.domains)),
            false => self.risky(&proof),
        };
        if let Some(found) = self.probe.points(&risky, &mut self.tally) {
            return self.different(found);
        }
        for (side, e) in [(Side::Left, self.a), (Side::Right, self.b)] {
            if self.tally.defined(side) > 0 || self.tally.undefined(side) == 0 {
                continue;
            }
            // Constants have one point only; elsewhere no value at points is no proof.
            if self.roles.symbols.is_empty() || critical::no_value(e, self.domains) {
                return self.invalid(side);
            }
        }
        let found = self
            .probe
            .rising_precision(&self.points, self.size, &mut self.tally);
        if let Some(found) = found {
            return self.different(found);
        }
        if let Some(found) = self.live_apart(&proof) {
            return Equality::Different(found);
        }
        match proof {
            _ if self.tally.both_defined == 0 => self.undecided(Reason::NoPoint),
            // A point at which both have a value was found only now.
            Proof::Equal(assumptions, ground) => self.equal(assumptions, ground),
            Proof::Unequal { settled: true, .. } => self.undecided(Reason::NoPointApart),
            Proof::Unequal { settled: false, .. } => self.undecided(Reason::UnknownLaws),
            Proof::Stopped(limit) => self.undecided(Reason::Limit(limit)),
            // It has values all the same.
            Proof::Invalid(_) => self.undecided(Reason::NoPointApart),
        }
    }

    /// A point at which only the left side has a value, where each has values that the other has not and they hardly meet: at
    /// ends of what their roots allow, as those of 2 − x and x − 2 do.
    fn live_apart(&self, proof: &Proof) -> Option<Counterexample> {
        let is_known = matches!(proof, Proof::Unequal { settled: true, .. });
        let meets = self.tally.exact_equal > MEETINGS || self.tally.enclosed > 0;
        if meets || !(is_known || self.tally.both_defined == 0) {
            return None;
        }
        let only = |side: Side| {
            let has = |v: &Value| *v != Value::None;
            let mut apart = self.tally.apart.iter();
            apart.find(|(_, left, right)| match side {
                Side::Left => has(left) && !has(right),
                Side::Right => has(right) && !has(left),
            })
        };
        only(Side::Right)?;
        let (at, left, right) = only(Side::Left)?;
        Some(Counterexample::confirmed(at, left.clone(), right.clone()))
    }

    fn different(&self, found: Counterexample) -> Equality {
        let how = match self.size.branches {
            true => branch::equal_where(self.a, self.b, self.domains, self.roles, &found),
            false => None,
        };
        how.map_or(Equality::Different(found), |how| Equality::Same { how })
    }

    fn invalid(&self, side: Side) -> Equality {
        Equality::Invalid {
            side,
            points: self.tally.undefined(side),
        }
    }

    fn undecided(&self, reason: Reason) -> Equality {
        Equality::Undecided {
            reason,
            evidence: self.tally.evidence(),
        }
    }
}

#[cfg(test)]
mod tests;
