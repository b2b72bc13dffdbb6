//! Taylor coefficients of a formula at a value of a parameter, one after the other, and roots of what vanishes there.
//!
//! In: a formula, a parameter, the value. Out: exact coefficients; or the same formula with its roots developed.

use super::calc::{Seen, is_zero, sign, tidy};
use super::powers::not_zero;
use crate::algebra::Sign;
use crate::domain::Domains;
use crate::expr::{Expr, Function, Node, Symbol};
use crate::formula::Sentence;

/// Highest power of the distance that is looked at.
const POWERS: usize = 12;
/// Largest formula whose derivatives are followed, in nodes.
const LONGEST: usize = 4_000;

/// From which sides a parameter can come to a value.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    Above,
    Below,
    Both,
}

/// Derivatives at a value, one after the other.
pub(super) struct Taylor<'a> {
    p: &'a Symbol,
    to: &'a Expr,
    domains: &'a Domains,
    derivative: Expr,
    coefficients: Vec<Expr>,
}

impl<'a> Taylor<'a> {
    pub fn new(e: Expr, p: &'a Symbol, to: &'a Expr, domains: &'a Domains) -> Taylor<'a> {
        Taylor {
            p,
            to,
            domains,
            derivative: e,
            coefficients: Vec::new(),
        }
    }

    /// The coefficient of a power; `None` where a derivative has no value.
    pub fn coefficient(&mut self, n: usize) -> Option<Expr> {
        while self.coefficients.len() <= n {
            let done = self.coefficients.len();
            if done > 2 * POWERS {
                return None;
            }
            if done > 0 {
                self.derivative = tidy(&self.derivative.derivative(self.p), self.domains).ok()?;
            }
            if self.derivative.size() > LONGEST {
                return None;
            }
            let value = tidy(&self.derivative.put(self.p, self.to), self.domains).ok()?;
            let factorial: i64 = (1..=done as i64).product();
            let scaled = &value / &Expr::from(factorial);
            self.coefficients.push(tidy(&scaled, self.domains).ok()?);
        }
        self.coefficients.get(n).cloned()
    }

    /// The lowest power whose coefficient is not zero.
    pub fn lowest(&mut self) -> Option<usize> {
        for n in 0..POWERS {
            let c = self.coefficient(n)?;
            if is_zero(&c, self.domains)? {
                continue;
            }
            return Some(n);
        }
        None
    }
}

/// A formula in which roots of what vanishes at a value, such as √(1 − cos θ) at 0, are powers of the distance times roots of what
/// does not vanish there: the same up to the power `last`. With it what must not vanish.
pub(super) fn rooted(
    e: &Expr,
    at: (&Symbol, &Expr, Side),
    last: usize,
    domains: &Domains,
) -> (Expr, Vec<Sentence>) {
    let mut given = Vec::new();
    let e = e.map_parts(|part| {
        let (part, more) = rooted(part, at, last, domains);
        given.extend(more);
        part
    });
    let half = Expr::ratio(1, 2);
    let vanishes = |e: &Expr| is_zero(&e.put(at.0, at.1), domains) == Some(true);
    match e.node() {
        // arccos x = 2 arcsin √((1 − x)/2), whose root is the one that vanishes at x = 1; arcsin x is π/2 less that.
        Node::Call(f @ (Function::Acos | Function::Asin), x) if vanishes(&(Expr::one() - x)) => {
            let under = &half * &(Expr::one() - x);
            let (root, more) = rooted(&under.sqrt(), at, last, domains);
            given.extend(more);
            let arc = Expr::from(2) * Expr::call(Function::Asin, root);
            match f {
                Function::Acos => (arc, given),
                _ => (&half * &Expr::pi() - arc, given),
            }
        }
        Node::Power(base, k) if is_odd_half(k) && vanishes(base) => {
            match developed(base, at, last, domains) {
                Some((distance, rest, lead)) => {
                    given.extend(not_zero(&lead, domains));
                    let twice = Expr::from(2) * k;
                    (distance.power(twice) * rest.power(k.clone()), given)
                }
                None => (e, given),
            }
        }
        _ => (e, given),
    }
}

fn is_odd_half(k: &Expr) -> bool {
    let twice = Expr::from(2) * k;
    let is_whole = |k: &Expr| k.is_integer();
    is_whole(&twice) && !is_whole(k)
}

/// What vanishes as the square of a quantity that is not negative, times a rest that does not vanish, with the value of the rest.
fn developed(
    base: &Expr,
    (p, to, side): (&Symbol, &Expr, Side),
    last: usize,
    domains: &Domains,
) -> Option<(Expr, Expr, Expr)> {
    let mut taylor = Taylor::new(base.clone(), p, to, domains);
    let lowest = taylor.lowest()?;
    let lead = taylor.coefficient(lowest)?;
    if lowest % 2 > 0 || matches!(sign(&lead, domains), Seen::Proved(Sign::Negative)) {
        return None;
    }
    let distance = &Expr::symbol(p) - to;
    let root = distance.powi(lowest as i64 / 2);
    let root = match (lowest % 4, side) {
        (0, _) | (_, Side::Above) => root,
        (_, Side::Below) => -root,
        // Its size has no power series.
        (_, Side::Both) => return None,
    };
    let mut rest = Vec::new();
    for m in 0..=last {
        rest.push(taylor.coefficient(lowest + m)? * distance.powi(m as i64));
    }
    Some((root, Expr::sum(rest), lead))
}
