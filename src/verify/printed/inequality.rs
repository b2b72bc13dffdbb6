//! Printed inequalities: claims about the whole domain, and bounds of a quantity.

use super::Finding;
use super::desk::Desk;
use super::remainder::loose;
use crate::algebra::{self, Sign};
use crate::domain::{Domains, roles, samples};
use crate::expr::{Expr, Symbol};
use crate::formula::{Content, Relation};
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
        let both = |r: fn(&Relation) -> bool| r(sign) && r(derived);
        let is_place = both(|r| *r == Relation::Equal);
        if !is_place && !both(|r| r.is_order()) {
            return None;
        }
        let (left, right) = (left.expr()?, right.expr()?);
        // Of a largest value the name is that of the value, and not of its place.
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
            Some(false) => loose(values, signs, domains, finding),
            None => at_points(values, signs, domains, finding),
            Some(true) => {}
        }
    }
}

/// Whether an inequality holds by the sign of its difference.
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
    finding.because = "sign of the difference on the domain".into();
    Some(match sign {
        Relation::Less | Relation::Greater => known == Sign::Positive,
        Relation::LessEqual | Relation::GreaterEqual => known.is_not_negative(),
        _ => return None,
    })
}

/// An inequality whose sign is not known: it does not hold where a point shows that it fails, and is told where it does.
fn at_points(values: &[Expr], signs: &[Relation], domains: &Domains, finding: &mut Finding) {
    let all: Vec<&Expr> = values.iter().collect();
    let uses = roles(&all);
    let (domains, _) = domains.completed(&uses);
    let mut seen = [None, None];
    for sample in samples(&uses, &domains, 24) {
        let point = sample.point::<Interval>(true);
        let links = values.windows(2).zip(signs).map(|(pair, sign)| {
            let Outcome::Value(gap) = evaluate::<Interval>(&(&pair[1] - &pair[0]), &point) else {
                return None;
            };
            let (less, more) = (gap.low > 0.0, gap.high < 0.0);
            match sign {
                Relation::Less | Relation::LessEqual => (less || more).then_some(less),
                Relation::Greater | Relation::GreaterEqual => (less || more).then_some(more),
                _ => None,
            }
        });
        let links: Option<Vec<bool>> = links.collect();
        if let Some(links) = links {
            let holds = links.iter().all(|l| *l);
            seen[usize::from(holds)].get_or_insert_with(|| sample.words());
        }
    }
    match seen {
        [Some(fails), holds] => {
            finding.holds = Some(false);
            finding.because = format!("it fails at {fails}");
            finding.explained = Some(match holds {
                Some(at) => format!("it holds at {at}: it is not true everywhere"),
                None => "it holds at no point tried".into(),
            });
            finding.caught_by = Some("putting simple numbers in".into());
        }
        _ => finding.because = "the sign is not decided, and it fails at no point tried".into(),
    }
}
