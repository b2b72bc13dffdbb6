//! Limits, and polynomials that stand for a formula near a value of a parameter.
//!
//! In: a formula in parameters. Out: the answer with the reason. Numerator and denominator are developed in powers of the
//! distance from the value (Taylor's theorem, coefficients exact), and the lowest powers decide; far out, and where square
//! roots of the parameter stand, the powers themselves are read off. Whether a leading coefficient may vanish for special values of
//! other parameters is proved, or told as a condition. Apart from that, the formula is tried in numbers close by.

use super::Check;
use super::calc::{Seen, in_bars, is_zero, sign, square, tidy};
use super::powers::{self, Found, Tends, by_powers, not_zero};
use super::solve::{stated, within};
use super::taylor::{Side, Taylor, rooted};
use super::{Answer, Form, Near};
use crate::algebra::Sign;
use crate::domain::{Domain, Domains, roles, samples};
use crate::expr::{Expr, Function, Node, Symbol};
use crate::formula::{Sentence, sentence, write_plain};
use crate::interval::rounding;

/// Highest power among which the leading one is looked for.
const LEADING: usize = 6;

/// What a formula tends to, `None` where no value is; nothing where it is not found.
pub fn of(
    formula: &Expr,
    parameter: &Symbol,
    to: Option<&Expr>,
    domains: &Domains,
) -> Option<Option<Expr>> {
    Some(match found(formula, parameter, to, domains)?.tends {
        Tends::To(value) => Some(value),
        Tends::Beyond(_) | Tends::Apart => None,
    })
}

/// Whether a parameter comes to a value, or grows beyond all bounds, on its domain.
pub fn comes(parameter: &Symbol, to: Option<&Expr>, domains: &Domains) -> bool {
    cannot_come(parameter, to, domains).is_none()
}

/// Whether a formula is proved not to be negative in the end, when a parameter comes to a value or grows beyond all bounds.
pub fn ends_above(of: &Expr, parameter: &Symbol, to: Option<&Expr>, domains: &Domains) -> bool {
    let found = found(of, parameter, to, domains);
    found.is_some_and(|found| match found.tends {
        Tends::To(value) => sign(&value, domains).is_not_negative(),
        Tends::Beyond(upwards) => upwards == Some(true),
        Tends::Apart => false,
    })
}

/// Words for a place that the parameter cannot come to.
fn cannot_come(parameter: &Symbol, to: Option<&Expr>, domains: &Domains) -> Option<Sentence> {
    match to {
        Some(to) => outside(to, parameter, domains),
        None => bounded(parameter, domains),
    }
}

fn found(of: &Expr, parameter: &Symbol, to: Option<&Expr>, domains: &Domains) -> Option<Found> {
    if let Some(open) = without_bars(of, parameter, to, domains) {
        return found(&open, parameter, to, domains);
    }
    if let Some(arcs) = of_arcs(of, parameter, to, domains) {
        return Some(arcs);
    }
    let own = match to {
        Some(to) => by_taylor(of, parameter, to, domains).or_else(|| {
            let at_root = to.is_zero() && side(parameter, to, domains) == Side::Above;
            at_root.then(|| by_powers(of, parameter, false, domains))?
        }),
        None => dying(of, parameter, domains).or_else(|| by_powers(of, parameter, true, domains)),
    };
    own.or_else(|| {
        let square = square(of, parameter, domains)?;
        let found = found(&square, parameter, to, domains)?;
        let tends = match found.tends {
            Tends::To(value) => Tends::To(tidy(&value.sqrt(), domains).ok()?),
            tends => tends,
        };
        Some(Found { tends, ..found })
    })
}

/// A formula without the first bars in it, where what stands in them has a sign in the end.
fn without_bars(
    of: &Expr,
    parameter: &Symbol,
    to: Option<&Expr>,
    domains: &Domains,
) -> Option<Expr> {
    let (bars, inside) = in_bars(of, |x| x.mentions(parameter))?;
    let is_above = match found(&inside, parameter, to, domains)?.tends {
        Tends::To(value) => match sign(&value, domains) {
            Seen::Proved(Sign::Positive) => true,
            Seen::Proved(Sign::Negative) => false,
            _ => return None,
        },
        Tends::Beyond(upwards) => upwards?,
        Tends::Apart => return None,
    };
    Some(of.replace(&bars, &if is_above { inside } else { -inside }))
}

/// The limit of arcs and exponentials, their multiples and sums: of each that of its argument, inside of which it is continuous.
fn of_arcs(of: &Expr, parameter: &Symbol, to: Option<&Expr>, domains: &Domains) -> Option<Found> {
    let (mut how, mut given) = (None, Vec::new());
    let value = arcs_at(of, parameter, &mut |arc, x| {
        let found = found(x, parameter, to, domains)?;
        how = Some(found.how);
        given.extend(found.given);
        let quarter = Expr::pi() / Expr::from(2);
        match found.tends {
            Tends::To(value) => Some(Expr::call(arc, value)),
            Tends::Beyond(Some(true)) if arc == Function::Atan => Some(quarter),
            Tends::Beyond(Some(false)) if arc == Function::Atan => Some(-quarter),
            Tends::Beyond(_) | Tends::Apart => None,
        }
    })?;
    let is_inside = |e: &Expr| match e.node() {
        Node::Call(Function::Acos | Function::Asin, x) => {
            let room = Expr::one() - x.powi(2);
            sign(&room, domains).is_not_negative()
        }
        _ => true,
    };
    let is_real = value.parts().all(is_inside);
    is_real.then_some(())?;
    let tidied = tidy(&value, domains).ok();
    let value = match value.is_constant() {
        true => tidied?,
        false => tidied.filter(|e| e.size() < value.size()).unwrap_or(value),
    };
    Some(Found {
        tends: Tends::To(value),
        how: how?,
        given,
    })
}

/// An expression of arcs and exponentials with what each tends to in its place.
fn arcs_at(
    e: &Expr,
    p: &Symbol,
    tends: &mut impl FnMut(Function, &Expr) -> Option<Expr>,
) -> Option<Expr> {
    match e.node() {
        _ if !e.mentions(p) => Some(e.clone()),
        Node::Call(of @ (Function::Acos | Function::Asin | Function::Atan | Function::Exp), x) => {
            tends(*of, x)
        }
        Node::Sum(_) | Node::Product(_) => e.try_map_parts(|part| arcs_at(part, p, tends)),
        // No exponential is zero.
        Node::Power(base, k) if k.as_number().is_some() => match base.node() {
            Node::Call(Function::Exp, _) => Some(arcs_at(base, p, tends)?.power(k.clone())),
            _ => None,
        },
        _ => None,
    }
}

/// A limit: value, none, or not found, with the reason.
pub fn fill(out: &mut Answer, of: &Expr, parameter: &Symbol, to: Option<&Expr>, domains: &Domains) {
    if let Some(words) = cannot_come(parameter, to, domains) {
        out.text.push(words);
        return;
    }
    let found = found(of, parameter, to, domains);
    let Some(found) = found else {
        out.text.push(Sentence::words("the limit was not found"));
        out.checks.push(open("limit"));
        return;
    };
    out.assumptions.extend(found.given);
    out.checks.push(Check::new("limit", found.how, Some(true)));
    let words = match found.tends {
        Tends::To(value) => {
            let tried = tried(of, &value, parameter, to, 0, domains);
            out.checks.extend(tried);
            out.near.push(Near {
                left: of.clone(),
                right: value.clone(),
                parameter: parameter.clone(),
                to: to.cloned(),
                order: 0,
            });
            out.form = Form::value(value);
            return;
        }
        Tends::Beyond(Some(true)) => "it grows beyond all bounds: there is no limit",
        Tends::Beyond(Some(false)) => "it falls below all bounds: there is no limit",
        Tends::Beyond(None) => "its size grows beyond all bounds: there is no limit",
        Tends::Apart => {
            "there is no limit: beyond all bounds upwards on one side and downwards on the other"
        }
    };
    out.text.push(words.into());
}

/// Far out, where the parameter stands in exponents of one base alone: its power dies away, or its inverse does, and what is left
/// is a limit at zero of that power.
fn dying(of: &Expr, parameter: &Symbol, domains: &Domains) -> Option<Found> {
    const POWER: &str = "power that dies away";
    let mut growth: Option<Growth> = None;
    let rest = without_powers(of, parameter, &mut growth, &Expr::symbol(POWER))?;
    let Growth { base, rate } = growth?;
    let mut domains = domains.clone();
    let is_up = |e: &Expr, domains: &Domains| sign(e, domains).side();
    let rises = is_up(&rate, &domains)?;
    let (dies, not_zero_of) = match &base {
        None => (!rises, rate),
        Some(base) => {
            let below = &Expr::one() - base;
            let is_below = is_up(&below, &domains)?;
            let is_positive = sign(base, &domains) == Seen::Proved(Sign::Positive);
            (is_positive || !is_below).then_some(())?;
            (is_below == rises, below)
        }
    };
    // Of what is above 1 the inverse dies away.
    let rest = match dies {
        true => rest,
        false => rest.put(POWER, &Expr::symbol(POWER).powi(-1)),
    };
    let given = not_zero(&not_zero_of, &domains).map(|condition| match &base {
        Some(base) => sentence!("{} ≠ 1", base),
        None => condition,
    });
    domains.symbols.insert(POWER.into(), Domain::positive());
    let name = Symbol::from(POWER);
    let found = by_taylor(&rest, &name, &Expr::zero(), &domains)
        .or_else(|| by_powers(&rest, &name, false, &domains))?;
    Some(Found {
        how: "found from the power of the parameter, or its inverse, whichever dies away",
        given: given.into_iter().chain(found.given).collect(),
        ..found
    })
}

/// What a parameter p stands in the exponents of: b^(r p), with the base of the natural logarithms where there is no other.
struct Growth {
    base: Option<Expr>,
    rate: Expr,
}

/// A formula with a symbol for b^(r p), wherever the parameter p stands in an exponent k r p + c of one base b, with numbers k;
/// nothing where it stands elsewhere too, or where two bases do.
fn without_powers(e: &Expr, p: &Symbol, growth: &mut Option<Growth>, power: &Expr) -> Option<Expr> {
    if !e.mentions(p) {
        return Some(e.clone());
    }
    let (base, exponent) = match e.node() {
        Node::Power(b, exponent) if b.mentions(p) => {
            let inside = without_powers(b, p, growth, power)?;
            return (!exponent.mentions(p)).then(|| inside.power(exponent.clone()));
        }
        Node::Power(b, exponent) => (Some(b.clone()), exponent),
        Node::Call(Function::Exp, exponent) => (None, exponent),
        _ if e.as_symbol().is_some() => return None,
        _ => return e.try_map_parts(|part| without_powers(part, p, growth, power)),
    };
    let none = Domains::default();
    let rest = tidy(&exponent.put(p, &Expr::zero()), &none).ok()?;
    let rate = tidy(&exponent.derivative(p), &none).ok()?;
    // Of exp(l/p) the power stays.
    (!rate.mentions(p)).then_some(())?;
    let rest = match &base {
        Some(base) => base.power(rest),
        None => Expr::call(Function::Exp, rest),
    };
    // Of a number the rate is one: 1/2 to the power n, and of n + 1.
    let own = match rate.as_number() {
        Some(_) => Expr::one(),
        None => rate.clone(),
    };
    let known = growth.get_or_insert(Growth {
        base: base.clone(),
        rate: own,
    });
    let times = tidy(&(&rate / &known.rate), &none).ok()?;
    (known.base == base && times.as_number().is_some()).then(|| &power.power(times) * &rest)
}

/// The polynomial in the distance that stands for a formula near a value; without an order, its leading term.
pub(super) fn approximate(
    out: &mut Answer,
    of: &Expr,
    parameter: &Symbol,
    to: &Expr,
    order: Option<u32>,
    domains: &Domains,
) {
    if let Some(words) = outside(to, parameter, domains) {
        out.text.push(words);
        return;
    }
    let wanted = order.map_or(LEADING, |order| order as usize);
    let powers = [wanted, wanted + 3];
    let series = Series::of(of, parameter, to, powers, domains).or_else(|| {
        let side = side(parameter, to, domains);
        let (of, given) = rooted(of, (parameter, to, side), powers[1], domains);
        let mut series = Series::of(&of, parameter, to, powers, domains)?;
        series.given.extend(given);
        Some(series)
    });
    let Some(series) = series else {
        let is_alone = order.is_none() && to.is_zero();
        if is_alone && let Some(found) = powers::leading(of, parameter, domains) {
            return lead_with_a_root(out, of, parameter, found, domains);
        }
        out.text.push(sentence!(
            "no power series in {} was found there",
            parameter
        ));
        out.checks.push(open("series"));
        return;
    };
    out.assumptions.extend(series.given);
    let distance = &Expr::symbol(parameter) - to;
    let leading = series.coefficients.iter().position(|c| !c.is_zero());
    let power = leading.unwrap_or_default() as i64 + series.lowest.min(0);
    if order.is_none() && leading.is_some() {
        let words = format!("the leading power is {power}");
        out.text.push(words.into());
    }
    if series.lowest < 0 {
        let lead = &series.coefficients[0];
        if order.is_none() {
            let stretched = of * &distance.powi(-power);
            out.checks.push(exact());
            let tried = tried(&stretched, lead, parameter, Some(to), 0, domains);
            out.checks.extend(tried);
            let term = lead * &distance.powi(power);
            out.form = Form::value(tidy(&term, domains).unwrap_or(term));
            return;
        }
        let lowest = series.lowest;
        let power = lowest.to_string();
        out.text.push(sentence!("there is no such form: near {} = {} it grows like the power {} of the distance, beyond all bounds", parameter, to, power));
        return;
    }
    let order = order.unwrap_or(u32::try_from(power).unwrap_or_default());
    let wanted = order as usize;
    let terms = series.coefficients.iter().enumerate();
    let kept = terms.clone().take(wanted + 1);
    let polynomial = Expr::sum(kept.map(|(k, c)| c * &distance.powi(k as i64)));
    let polynomial = tidy(&polynomial, domains).unwrap_or(polynomial);
    let mut later = terms.skip(wanted + 1).filter(|(_, c)| !c.is_zero());
    out.text.push(match later.next() {
        Some((k, c)) => sentence!("the next term is {}", &(c * &distance.powi(k as i64))),
        None if is_zero(&(of - &polynomial), domains) == Some(true) => {
            Sentence::words("nothing is left out: it is this polynomial")
        }
        None => {
            let order = series.coefficients.len();
            format!("what is left out is of order {order} or higher").into()
        }
    });
    out.checks.push(exact());
    let tried = tried(of, &polynomial, parameter, Some(to), order, domains);
    out.checks.extend(tried);
    out.near.push(Near {
        left: of.clone(),
        right: polynomial.clone(),
        parameter: parameter.clone(),
        to: Some(to.clone()),
        order,
    });
    out.form = Form::value(polynomial);
}

/// A leading term with a broken power, as in 2 R √(g h)/(2 R − h) for small h.
fn lead_with_a_root(
    out: &mut Answer,
    of: &Expr,
    parameter: &Symbol,
    found: powers::Leading,
    domains: &Domains,
) {
    let power = Expr::from(found.power);
    let words = format!("the leading power is {}", write_plain(&power));
    out.text.push(words.into());
    out.assumptions.extend(found.given);
    let whole = Expr::symbol(parameter).power(power);
    let words = "found from the lowest powers of numerator and denominator";
    out.checks.push(Check::new("series", words, Some(true)));
    let stretched = of / &whole;
    let zero = Expr::zero();
    let near = tried(
        &stretched,
        &found.coefficient,
        parameter,
        Some(&zero),
        0,
        domains,
    );
    out.checks.extend(near);
    let term = &found.coefficient * &whole;
    out.form = Form::value(tidy(&term, domains).unwrap_or(term));
}

fn exact() -> Check {
    let words = "value and derivatives of the closed form there, exact (Taylor's theorem)";
    Check::new("series", words, Some(true))
}

fn open(kind: &'static str) -> Check {
    Check::new(kind, super::NOT_FOUND, None)
}

/// Words for a value that the parameter cannot come to.
fn outside(to: &Expr, parameter: &Symbol, domains: &Domains) -> Option<Sentence> {
    let mut relations = domains.relations.iter();
    let broken = relations.find(|r| {
        let far = r.excess.put(parameter, to);
        far != r.excess && matches!(sign(&far, domains), Seen::Proved(Sign::Negative))
    });
    if let Some(broken) = broken {
        let against = against(broken);
        return Some(sentence!(
            "{} cannot come to {}: {}",
            parameter,
            to,
            against
        ));
    }
    let domain = domains.symbols.get(parameter)?;
    let below = domain.low.as_ref().map(|l| to - &l.expr());
    let above = domain.high.as_ref().map(|h| &h.expr() - to);
    let mut gaps = below.iter().chain(&above);
    let out = gaps.any(|gap| sign(gap, domains).is_negative());
    let within = within(domain, parameter);
    out.then(|| sentence!("{} cannot come to {}: {}", parameter, to, within))
}

/// Words for a parameter that cannot grow beyond all bounds while the others stay as they are.
fn bounded(parameter: &Symbol, domains: &Domains) -> Option<Sentence> {
    let domain = domains.symbols.get(parameter);
    let high = domain.filter(|d| d.high.is_some());
    if let Some(domain) = high {
        let within = within(domain, parameter);
        return Some(sentence!(
            "{} cannot grow beyond all bounds: {}",
            parameter,
            within
        ));
    }
    let mut relations = domains.relations.iter();
    let broken = relations.find(|r| {
        let far = match r.excess.symbols().contains(parameter) {
            true => by_powers(&r.excess, parameter, true, domains),
            false => None,
        };
        far.is_some_and(|far| matches!(far.tends, Tends::Beyond(Some(false))))
    })?;
    let against = against(broken);
    Some(sentence!(
        "{} cannot grow beyond all bounds: {}",
        parameter,
        against
    ))
}

/// What a relation holds against a place that breaks it.
fn against(relation: &crate::domain::Relation) -> Sentence {
    match relation.origin.so_that() {
        None => sentence!("the scene states {}", &relation.words),
        Some(needed) => sentence!("{} is needed so that {}", stated(relation), needed),
    }
}

/// The sides within the domain.
fn side(parameter: &Symbol, to: &Expr, domains: &Domains) -> Side {
    let domain = domains.of_symbol(parameter);
    let is_at = |l: &crate::domain::Limit| is_zero(&(to - &l.expr()), domains) == Some(true);
    let is_end = |limit: &Option<_>| limit.as_ref().is_some_and(is_at);
    if is_end(&domain.low) {
        Side::Above
    } else if is_end(&domain.high) {
        Side::Below
    } else {
        Side::Both
    }
}

/// A formula in powers of the distance from a value.
struct Series {
    /// The lowest power; negative where it grows beyond all bounds.
    lowest: i64,
    /// Coefficients from the power 0 on, or from the lowest one where that is negative.
    coefficients: Vec<Expr>,
    /// What must not vanish.
    given: Vec<Sentence>,
}

impl Series {
    /// Coefficients up to the power `wanted`, and up to the first that is left out where there is one up to the power `last`.
    fn of(
        of: &Expr,
        p: &Symbol,
        to: &Expr,
        [wanted, last]: [usize; 2],
        domains: &Domains,
    ) -> Option<Series> {
        let (above, below) = common(of, domains)?;
        if is_zero(&above, domains) == Some(true) {
            return Some(Series {
                lowest: 0,
                coefficients: vec![Expr::zero(); last + 1],
                given: Vec::new(),
            });
        }
        let mut above = Taylor::new(above, p, to, domains);
        let mut below = Taylor::new(below, p, to, domains);
        let k = above.lowest()?;
        let j = below.lowest()?;
        let mut given = Vec::new();
        let mut lead = below.coefficient(j)?;
        given.extend(not_zero(&lead, domains));
        if k < j {
            given.extend(not_zero(&above.coefficient(k)?, domains));
            lead = tidy(&(&above.coefficient(k)? / &lead), domains).ok()?;
            return Some(Series {
                lowest: k as i64 - j as i64,
                coefficients: vec![lead],
                given,
            });
        }
        let mut out: Vec<Expr> = Vec::new();
        for m in 0..=last {
            // above = quotient × below, power by power.
            let mut rest = above.coefficient(m + j)?;
            for (i, q) in out.iter().enumerate() {
                rest = &rest - &(q * &below.coefficient(m + j - i)?);
            }
            out.push(tidy(&(&rest / &lead), domains).ok()?);
            if m > wanted && out.last().is_some_and(|next| !next.is_zero()) {
                break;
            }
        }
        Some(Series {
            lowest: (k - j) as i64,
            coefficients: out,
            given,
        })
    }
}

fn by_taylor(of: &Expr, p: &Symbol, to: &Expr, domains: &Domains) -> Option<Found> {
    let series = Series::of(of, p, to, [0, 0], domains)?;
    let lead = series.coefficients.first()?;
    let side = side(p, to, domains);
    let tends = if series.lowest >= 0 {
        Tends::To(lead.clone())
    } else if side == Side::Both && series.lowest % 2 != 0 {
        Tends::Apart
    } else {
        let turned = side == Side::Below && series.lowest % 2 != 0;
        Tends::Beyond(sign(lead, domains).side().map(|above| above != turned))
    };
    let how = match series.lowest {
        0.. => "found from the lowest powers of numerator and denominator there",
        _ => "the denominator vanishes there more strongly than the numerator",
    };
    Some(Found {
        tends,
        how,
        given: series.given,
    })
}

/// Numerator and denominator.
pub(super) fn common(of: &Expr, domains: &Domains) -> Option<(Expr, Expr)> {
    let over = |e: &Expr| e.above_and_below().map(Expr::product);
    let tidied = tidy(of, domains).ok()?;
    let parts: Vec<[Expr; 2]> = tidied.terms().iter().map(over).collect();
    let below = Expr::product(parts.iter().map(|[_, below]| below.clone()));
    let above = Expr::sum(parts.iter().enumerate().map(|(i, [above, _])| {
        let others = parts.iter().enumerate().filter(|(j, _)| *j != i);
        above * &Expr::product(others.map(|(_, [_, below])| below.clone()))
    }));
    Some((above, below))
}

/// The formula against what stands for it, in doubles close by or far out: what is left out must shrink faster than the power
/// kept.
fn tried(
    of: &Expr,
    stands: &Expr,
    p: &Symbol,
    to: Option<&Expr>,
    order: u32,
    domains: &Domains,
) -> Option<Check> {
    let from_below = to.is_some_and(|to| side(p, to, domains) == Side::Below);
    let way = if from_below { -1.0 } else { 1.0 };
    let zero = Expr::zero();
    let to = to.ok_or(());
    let gap = of - stands;
    let roles = roles(&[&gap, to.unwrap_or(&zero)]);
    let (domains, _) = domains.completed(&roles);
    // 8 times closer, more than 8ⁿ times smaller; rounding is no remainder. A limit may be approached as slowly as a root.
    let power = 4.0 * 8f64.powi(order as i32);
    let closer = if order == 0 { 1024.0 } else { 8.0 };
    let mut seen = 0;
    for sample in samples(&roles, &domains, 6) {
        let mut point = sample.doubles();
        let at = match to {
            Ok(to) => Some(to.evaluate(&point)?),
            Err(()) => None,
        };
        let mut left_out = |h: f64| {
            let x = at.map_or(1.0 / (h * h), |at| at + way * h);
            point.values.insert(p.clone(), x);
            let scale = of
                .evaluate(&point)?
                .abs()
                .max(stands.evaluate(&point)?.abs());
            let left = gap.evaluate(&point)?.abs();
            // Far out a power may be beyond all doubles.
            left.is_finite().then_some((left, scale))
        };
        let (Some((first, scale)), Some((second, _))) =
            (left_out(1.0 / 128.0), left_out(1.0 / 128.0 / closer))
        else {
            continue;
        };
        if second <= 1e-13 * scale || second * power <= first {
            seen += 1;
        } else if second <= rounding(&gap, &point) {
            // What is left there is rounding.
        } else {
            return Some(Check::new(
                "numbers",
                "in numbers close by this could not be seen",
                None,
            ));
        }
    }
    let nearer = match to {
        Ok(_) => format!("{closer} times closer"),
        Err(()) => format!("{} times as large", closer * closer),
    };
    let words = format!(
        "at {seen} points: where the parameter is {nearer}, the error is at least {power} times smaller"
    );
    (seen > 0).then(|| Check::new("numbers", words, Some(true)))
}
