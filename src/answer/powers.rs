//! Limits by the lowest powers of a parameter, at zero and far out.
//!
//! In: a formula and the parameter. Out: what it tends to. The parameter is put as x² or 1/x², so that its square roots are
//! powers too; fractions give their lowest powers, and products and roots of formulas those of their parts.

use num_traits::{Signed, Zero};

use super::ROOT;
use super::calc::{Seen, above_zero, essential, sign, tidy};
use crate::algebra::{Element, Field, Sign};
use crate::domain::{Domain, Domains};
use crate::expr::{Expr, Node, Rational, Symbol};
use crate::formula::{Sentence, sentence};

/// What a formula tends to.
pub(super) enum Tends {
    /// A value.
    To(Expr),
    /// Beyond all bounds, upwards, downwards, or with a sign that hangs on other parameters.
    Beyond(Option<bool>),
    /// Up on one side and down on the other.
    Apart,
}

/// What was found, the reason, and what must not vanish for it.
pub(super) struct Found {
    pub tends: Tends,
    pub how: &'static str,
    pub given: Vec<Sentence>,
}

/// By the powers of the root of the parameter, or of its inverse.
pub(super) fn by_powers(
    of: &Expr,
    p: &Symbol,
    at_infinity: bool,
    domains: &Domains,
) -> Option<Found> {
    let mut domains = domains.clone();
    domains.symbols.insert(ROOT.into(), Domain::positive());
    let x = Expr::symbol(ROOT).powi(if at_infinity { -2 } else { 2 });
    let e = of.put(p, &x);
    let lead = lead(&e, &domains)?;
    let mut given = lead.given;
    let tends = if lead.coefficient.is_zero() {
        return Some(Found {
            tends: Tends::To(Expr::zero()),
            how: "it is zero throughout",
            given,
        });
    } else if lead.power.is_positive() {
        Tends::To(Expr::zero())
    } else if lead.power.is_zero() {
        Tends::To(lead.coefficient)
    } else {
        given.extend(
            lead.above
                .iter()
                .filter_map(|above| not_zero(above, &domains)),
        );
        Tends::Beyond(sign(&lead.coefficient, &domains).side())
    };
    Some(Found {
        tends,
        how: "found from the lowest powers of numerator and denominator",
        given,
    })
}

/// The leading term of a formula for a small positive parameter.
pub(super) struct Leading {
    pub coefficient: Expr,
    /// The power of the parameter.
    pub power: Rational,
    /// What must not vanish for it.
    pub given: Vec<Sentence>,
}

/// The lowest power of a parameter that is not negative, half a whole number where it stands under a root.
pub(super) fn leading(of: &Expr, p: &Symbol, domains: &Domains) -> Option<Leading> {
    sign(&Expr::symbol(p), domains).side().filter(|up| *up)?;
    let mut domains = domains.clone();
    domains.symbols.insert(ROOT.into(), Domain::positive());
    let through = of.put(p, &Expr::symbol(ROOT).powi(2));
    let found = lead(&through, &domains).filter(|found| !found.coefficient.is_zero())?;
    let above = found.above.iter().filter_map(|e| not_zero(e, &domains));
    Some(Leading {
        power: found.power / Rational::from_integer(2.into()),
        given: found.given.iter().cloned().chain(above).collect(),
        coefficient: found.coefficient,
    })
}

/// The lowest power of x in a formula, and its coefficient.
struct Lead {
    coefficient: Expr,
    power: Rational,
    /// Coefficients of numerators, which decide whether this power is there.
    above: Vec<Expr>,
    given: Vec<Sentence>,
}

/// The lowest power of x: of a fraction, of a product of such, of a root of one.
fn lead(e: &Expr, domains: &Domains) -> Option<Lead> {
    if let Some(found) = fraction(e, domains) {
        return Some(found);
    }
    match e.node() {
        Node::Product(factors) => {
            let mut all = Lead {
                coefficient: Expr::one(),
                power: Rational::zero(),
                above: Vec::new(),
                given: Vec::new(),
            };
            for factor in factors {
                let one = lead(factor, domains)?;
                all.coefficient = all.coefficient * one.coefficient;
                all.power += one.power;
                all.above.extend(one.above);
                all.given.extend(one.given);
            }
            all.coefficient = tidy(&all.coefficient, domains).ok()?;
            Some(all)
        }
        Node::Power(base, exponent) => {
            let of_base = lead(base, domains)?;
            // What stands under a root is not negative.
            let is_positive = sign(&of_base.coefficient, domains).side() == Some(true);
            let number = exponent.as_number().filter(|_| is_positive)?;
            let coefficient = of_base.coefficient.power(exponent.clone());
            let needed = of_base.above.iter().filter_map(|a| not_zero(a, domains));
            Some(Lead {
                coefficient: tidy(&coefficient, domains).ok()?,
                power: of_base.power * number,
                given: needed.chain(of_base.given.iter().cloned()).collect(),
                above: Vec::new(),
            })
        }
        _ => None,
    }
}

/// The lowest power of x in a fraction of polynomials.
fn fraction(e: &Expr, domains: &Domains) -> Option<Lead> {
    let (mut field, element) = Field::of(domains, e).ok()?;
    if field.is_zero(&element) {
        return Some(Lead {
            coefficient: Expr::zero(),
            power: Rational::zero(),
            above: Vec::new(),
            given: Vec::new(),
        });
    }
    // The numerator over the element is the denominator, with its sign.
    let coefficients = field.numerator(&element, ROOT).ok()??;
    let mut numerator = field.integer(0);
    for (k, c) in coefficients.iter().enumerate() {
        let power = field.element(&Expr::symbol(ROOT).powi(k as i64)).ok()?;
        numerator = field.add(&numerator, &field.mul(c, &power).ok()?).ok()?;
    }
    let denominator = field.div(&numerator, &element).ok()?;
    let (low, above) = lowest(&mut field, &numerator)?;
    let (down, below) = lowest(&mut field, &denominator)?;
    Some(Lead {
        coefficient: tidy(&(&above / &below), domains).ok()?,
        power: Rational::from_integer((low as i64 - down as i64).into()),
        given: not_zero(&below, domains).into_iter().collect(),
        above: vec![above],
    })
}

/// The lowest power of x in a numerator, and its coefficient.
fn lowest(field: &mut Field, e: &Element) -> Option<(usize, Expr)> {
    let coefficients = field.numerator(e, ROOT).ok()??;
    let k = coefficients.iter().position(|c| !field.is_zero(c))?;
    Some((k, field.expr(&coefficients[k])))
}

/// What must not vanish, in words; nothing where that is proved.
pub(super) fn not_zero(e: &Expr, domains: &Domains) -> Option<Sentence> {
    match sign(e, domains) {
        Seen::Proved(Sign::Positive | Sign::Negative) => None,
        Seen::Proved(Sign::NotNegative) => Some(above_zero(e, domains)),
        Seen::Proved(Sign::NotPositive) => Some(above_zero(&-e, domains)),
        _ => Some(sentence!("{} ≠ 0", &essential(e, domains))),
    }
}
