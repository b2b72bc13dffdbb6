//! Inequalities in which the parameter stands inside an arc, in an exponent or under one, without that function.
//!
//! In: a difference of two sides. Out: another one with the same sign, such as `X − cos θ` for `θ − acos X`, or
//! `n ln e + ln 10` for `10 eⁿ − 1`; and what must hold for that.

use super::calc::{Seen, is_zero, sign, tidy};
use crate::algebra::Sign;
use crate::domain::Domains;
use crate::expr::{Expr, Function, Node, Symbol};
use crate::formula::{Sentence, sentence};

/// A difference without its outermost function.
pub(super) struct Inner {
    /// It has the sign of the one that it stands for.
    pub gap: Expr,
    /// Where it does.
    pub domains: Domains,
    /// What they add, in words.
    pub given: Vec<Sentence>,
}

/// The difference without the function that holds the parameter, where that occurs once, to the first power.
pub(super) fn outermost(gap: &Expr, parameter: &Symbol, domains: &Domains) -> Option<Inner> {
    use Function::{Acos, Asin, Atan};
    let part = gap.parts().find(|part| match part.node() {
        Node::Call(Asin | Acos | Atan, inside) => inside.mentions(parameter),
        Node::Power(base, k) => match k.mentions(parameter) {
            true => !base.mentions(parameter),
            false => base.mentions(parameter) && k.as_number().is_none(),
        },
        _ => false,
    })?;
    let at = |value: i64| tidy(&gap.replace(part, &Expr::from(value)), domains).ok();
    let [rest, one, two] = [at(0)?, at(1)?, at(2)?];
    let step = tidy(&(&one - &rest), domains).ok()?;
    let linear = is_zero(&(two - &one - &step), domains) == Some(true);
    if !linear || rest.mentions(parameter) || step.mentions(parameter) {
        return None;
    }
    let upward = sign(&step, domains).side()?;
    // The function is greater than this just where the difference has the sign of its factor.
    let target = tidy(&-(&rest / &step), domains).ok()?;
    let (grows, difference, domains, given) = match part.node() {
        Node::Call(function, inside) => {
            let value = arc_taken(*function, &target, domains)?;
            (*function != Acos, inside - &value, domains.clone(), vec![])
        }
        Node::Power(base, k) if base.mentions(parameter) => {
            let seen = |e: &Expr| sign(e, domains);
            let positive = |e: &Expr| seen(e) == Seen::Proved(Sign::Positive);
            if seen(base).side() != Some(true) || !positive(k) || !positive(&target) {
                return None;
            }
            let value = target.power(k.powi(-1));
            (true, base - &value, domains.clone(), vec![])
        }
        Node::Power(base, k) => {
            let (domains, given) = without_ends(base, domains);
            let positive = |e: &Expr| sign(e, &domains) == Seen::Proved(Sign::Positive);
            if !positive(base) || !positive(&target) {
                return None;
            }
            let [base, target] = [base, &target].map(|e| Expr::call(Function::Ln, e.clone()));
            let difference = k.clone() * base - target;
            (true, difference, domains, given)
        }
        _ => return None,
    };
    let gap = if grows == upward {
        difference
    } else {
        -difference
    };
    Some(Inner {
        gap,
        domains,
        given,
    })
}

/// The sine, cosine or tangent of a value that its arc takes.
fn arc_taken(function: Function, target: &Expr, domains: &Domains) -> Option<Expr> {
    let half = &Expr::pi() / &Expr::from(2);
    let [low, high] = match function {
        Function::Acos => [Expr::zero(), Expr::pi()],
        _ => [-&half, half],
    };
    let fits = |seen: Seen| match function {
        Function::Atan => seen == Seen::Proved(Sign::Positive),
        _ => seen.side() == Some(true) || seen == Seen::Proved(Sign::Zero),
    };
    let is_taken = [target - &low, &high - target]
        .iter()
        .all(|e| fits(sign(e, domains)));
    is_taken.then(|| match function {
        Function::Acos => target.cos(),
        Function::Asin => target.sin(),
        _ => target.sin() / target.cos(),
    })
}

/// The domains without the ends 0 and 1 of a symbol that is raised to a power: there no power is a measure of the exponent.
fn without_ends(base: &Expr, domains: &Domains) -> (Domains, Vec<Sentence>) {
    let mut domains = domains.clone();
    let mut given = Vec::new();
    let own = base.as_symbol().and_then(|s| domains.symbols.get_mut(s));
    if let Some(own) = own {
        for (end, than) in [(0, " > 0"), (1, " < 1")] {
            if own.leave_out(end) {
                given.push(sentence!("{}{}", base, than));
            }
        }
    }
    (domains, given)
}
