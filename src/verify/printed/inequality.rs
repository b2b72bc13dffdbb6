//! Printed inequalities: claims about the whole domain, and bounds of a quantity.

use super::Finding;
use super::desk::Desk;
use crate::algebra::{self, Field, Sign};
use crate::domain::{Domains, at_ends, roles, samples};
use crate::equality::{self, sign_at};
use crate::expr::number::from_f64;
use crate::expr::{Expr, Symbol};
use crate::formula::{Content, Relation, write_plain};
use crate::interval::{Interval, Outcome, evaluate};

impl Desk<'_> {
    /// A bound as it is printed, `v > …` or `… < v`, of what the scene has a bound for, or a place `d = …`: how what is bounded
    /// stands to it, the bound, and the one that the scene has.
    pub(super) fn bound(&self, item: &Symbol, content: &Content) -> Option<(Relation, Expr, Expr)> {
        let (of, derived, value) = self.bounds.get(item)?;
        let Content::Relations(sides, signs) = content else {
            return None;
        };
        let ([left, right], [sign]) = (sides.as_slice(), signs.as_slice()) else {
            return None;
        };
        let is_place = [sign, derived].iter().all(|r| **r == Relation::Equal);
        // Where one value is asked a range is judged by its end.
        if !is_place && !(sign.is_order() && (derived.is_order() || *derived == Relation::Equal)) {
            return None;
        }
        let (left, right) = (left.expr()?, right.expr()?);
        // Of a largest or least value the name is that of the value, and not of its place.
        let is_bounded = |e: &Expr| e == of || !is_place && *e == Expr::symbol(item);
        match (is_bounded(left), is_bounded(right)) {
            (true, false) => Some((*sign, right.clone(), value.clone())),
            (false, true) => Some((sign.turned(), left.clone(), value.clone())),
            _ => None,
        }
    }

    /// Whether a right bound is printed on the right side of what it bounds.
    pub(super) fn sense(&self, item: &Symbol, printed: Relation, finding: &mut Finding) {
        let Some((of, derived, _)) = self.bounds.get(item) else {
            return;
        };
        finding.carom = format!("{} {} {}", self.say(of), derived.sign(), finding.carom);
        if finding.holds != Some(true) || printed == *derived {
            return;
        }
        if *derived == Relation::Equal {
            finding.holds = Some(false);
            finding.because = "the end of the range is right, and it is the only value".into();
            finding.explained = Some("a range is printed for one value".into());
            finding.caught_by = Some("putting a number from inside the range in".into());
            return;
        }
        if printed.is_below() == derived.is_below() {
            let otherwise = "; whether the bound itself counts is told otherwise";
            finding.because.push_str(otherwise);
            return;
        }
        finding.holds = Some(false);
        finding.because = "the bound is right, and the inequality points the other way".into();
        finding.explained = Some("the sign of the inequality is turned round".into());
        finding.caught_by = Some("limit: let what is bounded grow".into());
    }

    /// An inequality claimed on the whole domain: the sign of each difference.
    pub(super) fn claimed(
        &self,
        values: &[Expr],
        signs: &[Relation],
        domains: &Domains,
        finding: &mut Finding,
    ) {
        let mut holds = Some(true);
        for (pair, sign) in values.windows(2).zip(signs) {
            let one = inequality([&pair[0], &pair[1]], *sign, domains, finding);
            holds = match (holds, one) {
                (_, Some(false)) | (Some(false), _) => Some(false),
                (_, None) => None,
                (h, Some(true)) => h,
            };
        }
        finding.holds = holds;
        match holds {
            Some(false) => {
                finding.explained = Some(match loosely(values, signs, domains) {
                    true => "both sides are equal on the whole domain: it holds with ≤ in place of <",
                    false => "it fails on the whole domain",
                }.into());
                finding.caught_by = Some("putting simple numbers in".into());
            }
            None => at_points(values, signs, domains, finding),
            Some(true) => {}
        }
    }
}

/// Whether an inequality holds by the sign of its difference, where that tells: a difference that is nowhere below zero may be
/// zero nowhere.
pub(super) fn inequality(
    [a, b]: [&Expr; 2],
    sign: Relation,
    domains: &Domains,
    finding: &mut Finding,
) -> Option<bool> {
    let known = algebra::sign(&(b - a), domains)?;
    let known = if matches!(sign, Relation::Greater | Relation::GreaterEqual) {
        known.flip()
    } else {
        known
    };
    let is_strict = match sign {
        Relation::Less | Relation::Greater => true,
        Relation::LessEqual | Relation::GreaterEqual => false,
        _ => return None,
    };
    let holds = match known {
        Sign::Positive => true,
        Sign::NotNegative | Sign::Zero if !is_strict => true,
        Sign::Negative => false,
        Sign::NotPositive | Sign::Zero if is_strict => false,
        _ => return None,
    };
    finding.because = "sign of the difference on the domain".into();
    Some(holds)
}

/// An inequality that no sign decides: it does not hold where a point shows that it fails, and is told where it does.
fn at_points(values: &[Expr], signs: &[Relation], domains: &Domains, finding: &mut Finding) {
    let all: Vec<&Expr> = values.iter().collect();
    let uses = roles(&all);
    let (domains, _) = domains.completed(&uses);
    let mut points = samples(&uses, &domains, 24);
    let ends = at_ends(&points[..points.len().min(4)], &domains);
    points.extend(ends.into_iter().filter(|at| domains.admits(at)));
    let mut seen = [None, None];
    let mut is_only_equal = true;
    for sample in points {
        let links = values.windows(2).zip(signs).map(|(pair, sign)| {
            let gap = match sign {
                Relation::Less | Relation::LessEqual => &pair[1] - &pair[0],
                Relation::Greater | Relation::GreaterEqual => &pair[0] - &pair[1],
                _ => return None,
            };
            let gap = sign_at(&gap, &sample)?;
            let is_strict = matches!(sign, Relation::Less | Relation::Greater);
            Some((gap > 0 || gap == 0 && !is_strict, gap == 0))
        });
        let links: Option<Vec<(bool, bool)>> = links.collect();
        if let Some(links) = links {
            let mut failing = links.iter().filter(|(holds, _)| !holds).peekable();
            let holds = failing.peek().is_none();
            is_only_equal &= failing.all(|(_, is_equal)| *is_equal);
            seen[usize::from(holds)].get_or_insert_with(|| sample.words());
        }
    }
    match seen {
        [Some(fails), holds] => {
            finding.holds = Some(false);
            finding.because = format!("it fails at {fails}");
            if is_only_equal {
                finding.because.push_str(", where both sides are equal");
            }
            finding.explained = Some(match holds {
                _ if loosely(values, signs, &domains) => "it holds with ≤ in place of <".into(),
                Some(at) => format!("it holds at {at}: it is not true everywhere"),
                None => "it holds at no point tried".into(),
            });
            finding.caught_by = Some("putting simple numbers in".into());
        }
        _ if !loosely(values, signs, &domains) => {
            finding.because = "the sign is not decided, and it fails at no point tried".into();
        }
        _ => {
            let mut links = values.windows(2).zip(signs);
            let place = links.find_map(|(pair, sign)| {
                let is_strict = matches!(sign, Relation::Less | Relation::Greater);
                equal_at(&(&pair[1] - &pair[0]), &domains).filter(|_| is_strict)
            });
            finding.because = match &place {
                Some(place) => format!("both sides are equal at {place}"),
                None => {
                    "with ≤ in place of < it holds; whether the sides are ever equal is open".into()
                }
            };
            if place.is_some() {
                finding.holds = Some(false);
                finding.explained = Some("it holds with ≤ in place of <".into());
                finding.caught_by = Some("putting simple numbers in".into());
            }
        }
    }
}

/// Whether an inequality holds with equality allowed.
fn loosely(values: &[Expr], signs: &[Relation], domains: &Domains) -> bool {
    let weak = |sign: &Relation| match sign {
        Relation::Less => Relation::LessEqual,
        Relation::Greater => Relation::GreaterEqual,
        other => *other,
    };
    values.windows(2).zip(signs).all(|(pair, sign)| {
        let pair = [&pair[0], &pair[1]];
        inequality(pair, weak(sign), domains, &mut Finding::default()) == Some(true)
    })
}

/// A place inside the domain at which a difference vanishes, by a factor of it that is linear in a symbol.
fn equal_at(gap: &Expr, domains: &Domains) -> Option<String> {
    let (mut field, element) = Field::of(domains, gap).ok()?;
    gap.symbols().iter().find_map(|name| {
        let powers = field.powers(&element, name).ok()??;
        powers.factors.iter().find_map(|factor| {
            let [constant, slope] = factor.as_slice() else {
                return None;
            };
            let root = field.neg(&field.div(constant, slope).ok()?);
            let root = field.expr(&root);
            let is_zero = equality::vanishes(&gap.put(name, &root), domains);
            let mut points = domains.points(&[gap], 8).into_iter().filter(|_| is_zero);
            points.find_map(|at| {
                let Outcome::Value(value) = evaluate::<Interval>(&root, &at.point(true)) else {
                    return None;
                };
                let domain = domains.symbols.get(name)?;
                let mut ends = [value.low, value.high].into_iter().map(from_f64);
                let inside = ends.all(|end| end.is_some_and(|end| domain.contains(&end)));
                (inside && domains.admits_with(&at, name, value))
                    .then(|| format!("{name} = {}", write_plain(&root)))
            })
        })
    })
}
