//! Equality at random points modulo a prime near 2⁶¹: fast, and right up to a probability that is stated.
//!
//! For quotients of polynomials in symbols, in sines and cosines of rational multiples of angles, and in square roots.
//! In: expressions and the domains of their symbols; out: equal or not, with the bound. A difference is certain: an
//! identity over ℚ holds modulo every prime that divides no denominator. An equality is wrong with at most the probability
//! stated (Schwartz and Zippel: degree over p for each point), where coefficients are shown to be smaller than the prime.
//! Points are drawn by a strong hash of the two formulas and what is declared: nobody can write one that meets them.
//! Roots follow the rules told in [`lanes`]. Whatever fits none of this is declined.
//!
//! What agrees at points can mostly be proved as quickly, by [`exact`]: that is no matter of chance.

mod build;
mod drawn;
mod exact;
mod lanes;
mod radical;
mod real;
mod value;
mod walk;

use crate::algebra::prime::{PLAIN, ROOTS};
use crate::domain::{Domain, Domains, Role, Roles};
use crate::expr::{Expr, Symbol};
use lanes::Lanes;

use value::Sign;

/// Points for formulas without roots; each divides the chance of an error by p over the degree.
const FEW: usize = 2;
/// Points for formulas with roots: each root makes about half of them useless.
const MANY: usize = 8;
/// Real points that go with them.
const REAL: usize = 2;
/// The number by which the point of the first look is drawn; what agrees there is looked at again.
const GLANCE: u64 = 0x6a09_e667_f3bc_c908;

/// What a comparison at points found.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AtPoints {
    /// Whether the values agree.
    pub equal: bool,
    /// Largest probability that agreement is chance; 0 where they differ.
    pub bound: f64,
    /// Whether roots occur.
    pub roots: bool,
}

impl AtPoints {
    /// How it is known, in words.
    pub fn words(&self) -> &'static str {
        match (self.equal, self.roots) {
            (true, false) => "equal at random points modulo 2^61 - 1",
            (true, true) => "equal at random points modulo 2^61 - 139666593, roots included",
            (false, false) => "no identity: the values differ modulo 2^61 - 1",
            (false, true) => "the values differ at a real point, by enclosures",
        }
    }
}

/// Two formulas, and where their symbols live.
pub(super) struct Pair<'a> {
    formulas: [&'a Expr; 2],
    places: Vec<Place<'a>>,
}

impl<'a> Pair<'a> {
    /// A pair whose symbols, those of `roles`, all have a domain; `None` where that is no place for identities.
    pub fn of(
        a: &'a Expr,
        b: &'a Expr,
        domains: &'a Domains,
        roles: &'a Roles,
    ) -> Option<Pair<'a>> {
        // The points drawn here keep to no relations.
        if !domains.relations.is_empty() {
            return None;
        }
        let place = |(name, role)| place(name, role, domains);
        Some(Pair {
            formulas: [a, b],
            places: roles.symbols.iter().map(place).collect::<Option<_>>()?,
        })
    }

    /// Compares the two at random points. `None` where they are not of the kind this is for, or nothing follows.
    pub fn at_points(&self) -> Option<AtPoints> {
        let [a, b] = self.formulas;
        let drawn = drawn::Drawn::of([a, b], &self.places);
        let mut plain = Lanes::<PLAIN, FEW, 0>::new(&self.places, drawn.rounds());
        let compared = plain.both(a, b);
        if !plain.rooted {
            return compared;
        }
        Lanes::<ROOTS, MANY, REAL>::new(&self.places, drawn.rounds()).both(a, b)
    }

    /// Whether the two are equal, where that is certain: proved, with values at the same points of the domain, or told apart.
    pub fn decided(&self) -> Option<bool> {
        match self.glance() {
            Some(false) => Some(false),
            Some(true) if self.proved() => Some(true),
            // What agrees by chance at points is no proof.
            _ => self.at_points().filter(|found| !found.equal).map(|_| false),
        }
    }

    /// Whether the two agree where it costs least: at one residue, or at real points where roots occur. A difference is
    /// certain, and so is that both have values somewhere where they agree.
    fn glance(&self) -> Option<bool> {
        let [a, b] = self.formulas;
        let mut plain = Lanes::<PLAIN, 1, 0>::new(&self.places, [GLANCE]);
        let agree = plain.agree(a, b);
        match plain.rooted {
            true => Lanes::<ROOTS, 0, REAL>::new(&self.places, []).agree(a, b),
            false => agree,
        }
    }

    /// Whether the two are proved to be equal, with values at the same points of the domain.
    fn proved(&self) -> bool {
        let [a, b] = self.formulas;
        // Roots that come first are those by which later ones are known.
        exact::proves(a, b, &self.places) || exact::proves(b, a, &self.places)
    }
}

/// A symbol and where it lives.
#[derive(Debug)]
struct Place<'a> {
    name: &'a Symbol,
    /// What is known of its sign; nothing of a symbol that is known by its direction only.
    sign: Sign,
    /// Whether it occurs as an angle, and lies in the first quadrant.
    acute: bool,
    /// Real points are taken from here.
    range: [f64; 2],
    /// It occurs as an angle only, in multiples of its part by this.
    divisor: u32,
    /// A component of a unit vector: the name of the first one, and whether this is the second.
    unit: Option<(&'a Symbol, bool)>,
}

/// Where a symbol lives; `None` where that is no place for identities, or the symbol is an angle as well as a value.
fn place<'a>(name: &'a Symbol, role: &Role, domains: &'a Domains) -> Option<Place<'a>> {
    let domain = domains.symbols.get(name)?;
    let [low, high] = domain.bounds();
    if role.turns && role.bare || low.is_some() && low == high {
        return None;
    }
    let pair = domains.unit_vectors.iter().find(|pair| pair.contains(name));
    // A part of the circle only would have signs of its own.
    if pair.is_some() && (low, high) != (Some(-1.0), Some(1.0)) {
        return None;
    }
    let sign = match low {
        Some(low) if low > 0.0 => Sign::Positive,
        Some(0.0) if domain.low.as_ref().is_some_and(|l| l.open) => Sign::Positive,
        Some(0.0) => Sign::NotNegative,
        _ => Sign::Unknown,
    };
    let range = match (low, high) {
        (Some(low), Some(high)) => [low, high],
        (Some(low), None) => [low + 0.5, low + 2.5],
        (None, Some(high)) => [high - 2.5, high - 0.5],
        (None, None) => [-2.0, 2.5],
    };
    Some(Place {
        name,
        sign,
        acute: role.turns && *domain == Domain::first_quadrant(),
        range,
        divisor: role.divisor,
        unit: pair.map(|pair| (&pair[0], pair[1] == *name)),
    })
}

#[cfg(test)]
mod tests;
