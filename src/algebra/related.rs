//! Signs that stated relations decide: with M > m, M − m is positive, and so is 2M − m.

use std::borrow::Cow;
use std::cell::OnceCell;
use std::collections::BTreeSet;

use super::Sign;
use super::field::{Field, Kind};
use super::points::Points;
use super::poly::Poly;
use super::substitution::{MOST_TERMS, replaced};
use crate::domain::{Domain, Relation};
use crate::expr::{Expr, Rational, Symbol, effort, ratio};

/// Relations put in one after the other for one sign.
const DEPTH: usize = 3;

impl Field {
    /// The relations that bear upon some symbols.
    pub(super) fn relations(&self, symbols: &BTreeSet<Symbol>) -> Vec<Relation> {
        let bearing = self.domains.relations_of(symbols).into_iter();
        let mut all: Vec<Relation> = bearing.cloned().collect();
        // What is above zero tells more than that the same is not below it.
        all.sort_by_key(|relation| relation.closed);
        all
    }

    /// Takes in what relations tell of signs.
    pub(super) fn relate_signs(&mut self, relations: &[Relation]) {
        for relation in relations {
            let follow = self.of_angles(relation);
            for excess in [&relation.excess].into_iter().chain(&follow) {
                // Where a factor may be zero, so may the whole, and nothing is told of the rest.
                if let Some((p, others_vanish)) = self.undecided_part(excess)
                    && !(relation.closed && others_vanish)
                {
                    self.take(p, relation.closed);
                }
                if !relation.closed {
                    self.part_from_zero(excess);
                }
            }
        }
    }

    /// What a relation of two angles says of their sines and cosines, where these grow or fall.
    fn of_angles(&self, relation: &Relation) -> Vec<Expr> {
        let [small, large] = &relation.sides;
        let range = |e: &Expr| self.domains.symbols.get(e.as_symbol()?);
        let (Some(one), Some(other)) = (range(small), range(large)) else {
            return Vec::new();
        };
        let is_angle = |e: &Expr| e.as_symbol().and_then(|name| self.base_of(name));
        if is_angle(small).is_none() || is_angle(large).is_none() {
            return Vec::new();
        }
        let both_within = |low: Rational, high: Rational| {
            let range = Domain::angle(low, high);
            one.lies_within(&range) && other.lies_within(&range)
        };
        let mut out = Vec::new();
        if both_within(ratio(-1, 2), ratio(1, 2)) {
            out.push(large.sin() - small.sin());
        }
        if both_within(ratio(0, 1), ratio(1, 1)) {
            out.push(small.cos() - large.cos());
        }
        out
    }

    /// Supposes a polynomial positive, or not negative.
    pub(super) fn take(&mut self, p: Poly, closed: bool) {
        if !self.supposed.iter().any(|(q, c)| *q == p && *c == closed) {
            self.supposed.push((p, closed));
            // Normal forms found before know nothing of it.
            self.read.clear();
            self.samples.get_mut().clear();
            self.held.take();
            self.roots.get_mut().clear();
            self.halved.get_mut().clear();
        }
    }

    /// Supposes of what is above or below zero as a whole that no factor is zero: those that are known not to be negative are
    /// positive.
    fn part_from_zero(&mut self, e: &Expr) {
        let Ok(x) = self.element(e) else { return };
        for (f, _) in self.powers_of_parts(&x).1 {
            match self.sign_poly(&f) {
                Some(Sign::NotNegative) => self.take(f, false),
                Some(Sign::NotPositive) => self.take(f.neg(), false),
                _ => {}
            }
        }
    }

    /// The one factor of odd power whose sign is not known, turned so that it has the sign of the whole; and whether any of
    /// the others may vanish.
    pub(super) fn undecided_part(&mut self, e: &Expr) -> Option<(Poly, bool)> {
        let x = self.element(e).ok()?;
        let (mut negative, parts) = self.powers_of_parts(&x);
        let mut unknown = Vec::new();
        let mut others_vanish = false;
        for (f, k) in parts {
            let sign = self.sign_poly(&f);
            match sign {
                None if k % 2 != 0 => unknown.push(f),
                Some(Sign::Positive) => {}
                Some(sign) => {
                    others_vanish |= k > 0 && sign != Sign::Negative;
                    negative ^= k % 2 != 0 && !sign.is_not_negative();
                }
                None => others_vanish |= k > 0,
            }
        }
        let [f] = unknown.as_slice() else {
            return None;
        };
        let part = if negative { f.neg() } else { f.clone() };
        Some((part, others_vanish))
    }

    /// Whether a relation says this polynomial to be positive, or its opposite; `None` where none speaks of just this.
    pub(super) fn stated_sign(&self, p: &Poly) -> Option<bool> {
        let is_opposite = |q: &Poly| q.len() == p.len() && *q == p.neg();
        let mut all = self.supposed.iter();
        all.find_map(|(q, _)| match q == p {
            true => Some(true),
            false => is_opposite(q).then_some(false),
        })
    }

    /// The sign of a polynomial of which just this, or its opposite, is supposed.
    fn stated(&self, p: &Poly) -> Option<Sign> {
        let stated = |p: &Poly| {
            let found = self.supposed.iter().find(|(q, _)| q == p);
            found.map(|(_, closed)| Sign::made(true, !closed))
        };
        stated(p).or_else(|| stated(&p.neg()).map(Sign::flip))
    }

    /// The same where it is supposed not to vanish.
    pub(super) fn strictly_stated(&self, p: &Poly) -> Option<Sign> {
        self.stated(p).filter(|sign| sign.is_strict())
    }

    /// The sign of a polynomial by what is supposed.
    pub(crate) fn by_relations(&self, p: &Poly) -> Option<Sign> {
        if self.supposed.is_empty() || p.len() > MOST_TERMS {
            return None;
        }
        let known = self.stated(p);
        if known.is_some() {
            return known;
        }
        let all = self.supposed.iter().enumerate();
        let all = all.map(|(of, (excess, closed))| Related {
            of,
            excess: Cow::Borrowed(excess),
            closed: *closed,
        });
        let all: Vec<Related> = all.collect();
        self.by_conjugates(p)
            .or_else(|| self.eliminated(p, &all, &[], &mut Search::new(self, p)))
    }

    /// The sign of a multiple of q q̄ where q = A + B v is supposed positive, q̄ = A − B v and v² is known: with sinα > μ cosα,
    /// sin²α − μ² cos²α is positive, which as 1 − (1 + μ²) cos²α has no factors.
    fn by_conjugates(&self, p: &Poly) -> Option<Sign> {
        self.supposed.iter().find_map(|(q, closed)| {
            q.variables().into_iter().find_map(|v| {
                let (2, square) = self.gens[v].relation.as_ref()? else {
                    return None;
                };
                let parts = q.by_power(v);
                let [a, b] = parts.as_slice() else {
                    return None;
                };
                let turned = b.mul(b).ok()?.mul(square).ok()?;
                let norm = a.mul(a).ok()?.sub(&turned);
                // With what is known of v the product may be a number, or zero.
                let rest = (!norm.is_constant()).then(|| p.try_div(&norm))??;
                let conjugate = a.sub(&b.mul(&Poly::var(v)).ok()?);
                let sign = self.by_coefficients(&conjugate, &[])?;
                let sign = sign.times(Sign::made(true, !closed));
                Some(sign.times(self.sign_poly(&rest)?))
            })
        })
    }

    /// A relation A v + B > 0 with A > 0 makes v = (δ − B)/A with a positive δ, which takes the place of v: a sign that
    /// follows for all positive δ holds. `used` tells what has been replaced already.
    fn eliminated(
        &self,
        p: &Poly,
        relations: &[Related],
        used: &[Used],
        search: &mut Search,
    ) -> Option<Sign> {
        for relation in relations {
            if effort::spent() {
                return None;
            }
            for v in relation.excess.variables() {
                let is_free =
                    matches!(self.gens[v].kind, Kind::Symbol(_)) && self.gens[v].relation.is_none();
                if !is_free || !p.has(v) || used.iter().any(|u| u.v == v) {
                    continue;
                }
                let own = Used {
                    of: relation.of,
                    v,
                    closed: relation.closed,
                };
                let used = [used, &[own]].concat();
                let others: Vec<&Related> = relations.iter().filter(|r| r.of != own.of).collect();
                // A first one is cheaper tried than weighed at points.
                let is_weighed = used.len() > 1;
                if is_weighed && !search.is_worth(&used, &others) {
                    continue;
                }
                let Some((top, below)) = self.solved(&relation.excess, v, &used) else {
                    continue;
                };
                let Some(q) = replaced(p, v, &top, &below) else {
                    continue;
                };
                if !is_weighed || search.is_open(&used) {
                    let excesses: Vec<_> = used.iter().map(|u| (u.v, u.closed)).collect();
                    let found = self.with_excesses(&q, &excesses);
                    if found.is_some() {
                        return found;
                    }
                }
                if used.len() == DEPTH || !search.may_follow(&used, &others) {
                    continue;
                }
                let others = others.into_iter().filter_map(|r| {
                    let excess = Cow::Owned(replaced(&r.excess, v, &top, &below)?);
                    Some(Related { excess, ..*r })
                });
                let others: Vec<Related> = others.collect();
                let found = self.eliminated(&q, &others, &used, search);
                if found.is_some() {
                    return found;
                }
            }
        }
        None
    }

    /// The variable v as top/below, below positive, where v in `top` stands for the excess of the relation.
    fn solved(&self, relation: &Poly, v: usize, used: &[Used]) -> Option<(Poly, Poly)> {
        let parts = relation.by_power(v);
        let [b, a] = parts.as_slice() else {
            return None;
        };
        if used.iter().any(|u| a.has(u.v)) {
            return None;
        }
        let excess = Poly::var(v);
        match self.by_coefficients(a, &[])? {
            Sign::Positive => Some((excess.sub(b), a.clone())),
            Sign::Negative => Some((b.sub(&excess), a.neg())),
            _ => None,
        }
    }
}

/// One of the relations supposed, by place, with what has been replaced in it.
struct Related<'a> {
    of: usize,
    excess: Cow<'a, Poly>,
    closed: bool,
}

/// A variable for which the excess of a relation stands.
#[derive(Clone, Copy)]
struct Used {
    of: usize,
    v: usize,
    closed: bool,
}

/// A search for the sign of a polynomial by several relations: some of them prove none where both signs are seen at points
/// at which all of these hold.
struct Search<'a> {
    field: &'a Field,
    of: &'a Poly,
    /// The sample points at which it is positive and negative; found when first needed.
    signs: OnceCell<[Points; 2]>,
    /// Which relations took the place of which variables: the order makes no difference.
    tried: BTreeSet<Vec<(usize, usize)>>,
}

impl<'a> Search<'a> {
    fn new(field: &'a Field, of: &'a Poly) -> Search<'a> {
        Search {
            field,
            of,
            signs: OnceCell::new(),
            tried: BTreeSet::new(),
        }
    }

    /// Whether no point rules out that these relations prove a sign.
    fn is_open(&self, used: &[Used]) -> bool {
        self.is_open_at(&self.signs_given(used))
    }

    /// Whether no point rules out that these relations, with others up to the greatest number, prove a sign.
    fn may_follow(&self, used: &[Used], others: &[&Related]) -> bool {
        self.may_follow_at(&self.signs_given(used), others, DEPTH - used.len())
    }

    fn may_follow_at(&self, signs: &[Points; 2], others: &[&Related], left: usize) -> bool {
        left > 0
            && others.iter().any(|r| {
                let signs = signs.map(|seen| seen.within(&self.field.held().each[r.of]));
                self.is_open_at(&signs) || self.may_follow_at(&signs, others, left - 1)
            })
    }

    /// Whether these relations may lead to a sign, and have not been tried in another order.
    fn is_worth(&mut self, used: &[Used], others: &[&Related]) -> bool {
        let mut pairs: Vec<(usize, usize)> = used.iter().map(|u| (u.of, u.v)).collect();
        pairs.sort_unstable();
        (self.is_open(used) || self.may_follow(used, others)) && self.tried.insert(pairs)
    }

    fn is_open_at(&self, signs: &[Points; 2]) -> bool {
        signs.iter().any(Points::is_empty)
    }

    /// Where each sign is seen among the points at which these relations hold.
    fn signs_given(&self, used: &[Used]) -> [Points; 2] {
        let find = || self.field.signs_at_points(self.of);
        let each = &self.field.held().each;
        let given = |all: Points, u: &Used| all.within(&each[u.of]);
        let signs = self.signs.get_or_init(find);
        signs.map(|seen| used.iter().fold(seen, given))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Domains;

    fn s(name: &str) -> Expr {
        Expr::symbol(name)
    }

    fn related(stated: &[(Expr, Expr, bool)]) -> Domains {
        let relations = stated.iter().map(|(small, large, closed)| Relation {
            sides: [small.clone(), large.clone()],
            excess: large.clone() - small.clone(),
            closed: *closed,
            words: String::new(),
            origin: crate::domain::Origin::Stated,
        });
        let restitution = Domain::between(ratio(0, 1), ratio(1, 1));
        Domains {
            relations: relations.collect(),
            symbols: [("e".into(), restitution)].into_iter().collect(),
            ..Domains::default()
        }
    }

    fn sign(e: &Expr, domains: &Domains) -> Option<Sign> {
        let mut field = Field::new(domains);
        field.prepare([e]);
        let x = field.element(e).expect("a normal form");
        field.sign(&x)
    }

    /// Left side, right side, and whether they may be equal.
    type Granted = (Expr, Expr, bool);

    #[test]
    fn a_relation_decides_what_follows_from_it_and_no_more() {
        let two = || Expr::from(2);
        let heavier = [(s("m"), s("M"), false)];
        let chain = [(s("m"), s("M"), false), (s("k"), s("m"), true)];
        let half = [(s("c"), s("L") / two(), false)];
        let steep = [(s("b"), s("a") * s("theta").cos(), false)];
        let closed = [(s("m"), s("M"), true)];
        let rebounds = [(s("e"), Expr::one(), false)];
        let may_rebound = [(s("e"), Expr::one(), true)];
        let table: [(&[Granted], Expr, Option<Sign>); 18] = [
            // Within a closed interval, what parts it from its end.
            (&rebounds, Expr::one() - s("e"), Some(Sign::Positive)),
            (
                &rebounds,
                s("e").powi(2) - Expr::one(),
                Some(Sign::Negative),
            ),
            (&rebounds, s("e"), Some(Sign::NotNegative)),
            (&may_rebound, Expr::one() - s("e"), Some(Sign::NotNegative)),
            (&heavier, s("M") - s("m"), Some(Sign::Positive)),
            (&heavier, s("m") - s("M"), Some(Sign::Negative)),
            (&heavier, two() * s("M") - s("m"), Some(Sign::Positive)),
            (
                &heavier,
                s("M").powi(2) - s("m").powi(2),
                Some(Sign::Positive),
            ),
            (&heavier, s("M") - two() * s("m"), None),
            (&heavier, s("M") - s("k"), None),
            (&closed, s("M") - s("m"), Some(Sign::NotNegative)),
            (&closed, two() * s("M") - s("m"), Some(Sign::Positive)),
            (&chain, s("M") - s("k"), Some(Sign::Positive)),
            (&chain, s("k") - two() * s("M"), Some(Sign::Negative)),
            (
                &half,
                s("L").powi(2) - Expr::from(4) * s("c").powi(2),
                Some(Sign::Positive),
            ),
            (&half, s("L") - s("c"), Some(Sign::Positive)),
            (&steep, s("a") - s("b"), Some(Sign::Positive)),
            (&[], s("M") - s("m"), None),
        ];
        for (stated, e, expected) in table {
            let found = sign(&e, &related(stated));
            assert_eq!(found, expected, "{e:?}");
        }
    }

    #[test]
    fn an_absolute_value_opens_where_a_relation_tells_the_sign() {
        let domains = related(&[(s("m"), s("M"), false)]);
        let e = (s("m") - s("M")).powi(2).sqrt() - s("M") + s("m");
        let mut field = Field::new(&domains);
        field.prepare([&e]);
        let x = field.element(&e).expect("a normal form");
        assert!(field.is_zero(&x) && field.assumptions().is_empty());
    }

    #[test]
    fn a_factor_that_may_vanish_gives_nothing_away() {
        // (a − b)(c − 1)² ≥ 0 holds for any a and b where c = 1.
        let factor = (s("c") - Expr::one()).powi(2);
        let stated = [(Expr::zero(), (s("a") - s("b")) * factor, true)];
        assert_eq!(sign(&(s("a") - s("b")), &related(&stated)), None);
        let mut domains = related(&[(s("b") * s("c"), s("a") * s("c"), false)]);
        let open = crate::domain::Domain::between(ratio(0, 1), ratio(1, 1));
        domains.symbols.insert("c".into(), open);
        assert_eq!(sign(&(s("a") - s("b")), &domains), Some(Sign::Positive));
    }

    #[test]
    fn a_relation_of_angles_decides_their_sines_and_cosines() {
        let domains = |low, high| {
            let mut domains = related(&[(s("beta"), s("theta"), false)]);
            for name in ["beta", "theta"] {
                let range = Domain::angle(ratio(low, 2), ratio(high, 2));
                domains.symbols.insert(name.into(), range);
            }
            domains
        };
        let sines = s("theta").sin() - s("beta").sin();
        let cosines = s("theta").cos() - s("beta").cos();
        assert_eq!(sign(&sines, &domains(0, 1)), Some(Sign::Positive));
        assert_eq!(sign(&cosines, &domains(0, 1)), Some(Sign::Negative));
        assert_eq!(sign(&sines, &domains(-1, 1)), Some(Sign::Positive));
        assert_eq!(sign(&cosines, &domains(-1, 1)), None);
        assert_eq!(sign(&sines, &domains(0, 2)), None);
        assert_eq!(sign(&cosines, &domains(0, 2)), Some(Sign::Negative));
    }
}
