//! What explains a printed formula, equation or number that does not hold, and the cheap check that would have caught it.

use std::cell::RefCell;
use std::collections::BTreeMap;

use num_traits::Signed;

use super::desk::Desk;
use super::number::{last_place, number_of};
use super::{FEW_DIGITS, Finding};
use crate::algebra::{self, Sign};
use crate::dimension::{self, Clash};
use crate::domain::Domains;
use crate::equality::{self, Equality};
use crate::expr::{Expr, Point, Rational, Symbol, ratio};
use crate::formula::{Content, Reading, Relation};
use crate::numeric;
use crate::scene::{Ask, Print, Printed};
use crate::verify::rounding::ten_to;
use crate::verify::slip;

/// Explanations of a number told at most; when there are more, none is worth much.
const TOLD: usize = 3;

/// Largest chance with which some slip leads to a number that has nothing to do with any, at which one is told.
const MOST_BY_CHANCE: f64 = 0.1;

/// Most points tried for such as have values.
const TRIED: u64 = 40;

impl Desk<'_> {
    /// A velocity or spin before the collision, printed as the one after.
    pub(super) fn before(&self, item: &str, pairs: &[(Expr, Expr)]) -> Option<String> {
        use crate::scene::Ask;
        let question = self.scene.question_of_impact(item)?;
        let before = match &question.ask {
            Ask::Velocity {
                body,
                point: None,
                along: None,
            } => self.scene.bodies[*body].velocity.to_vec(),
            Ask::Spin { body, .. } => vec![self.scene.bodies[*body].spin.clone()],
            _ => return None,
        };
        let mut each = before.iter().zip(pairs);
        let same = each.all(|(b, (_, value))| self.is_same(b, value));
        same.then(|| "it is the value before the collision: the superscript is wrong".to_string())
    }

    /// Whether two formulas are one on the domain.
    pub(super) fn is_same(&self, a: &Expr, b: &Expr) -> bool {
        equality::decide(a, b, &self.scene.domains)
            .equality
            .is_same()
    }

    /// The place of a largest or least value, printed as the value.
    pub(super) fn place(&self, item: &str, pairs: &[(Expr, Expr)]) -> Option<String> {
        let (of, relation, place) = self.bounds.get(item)?;
        let [(_, value)] = pairs else { return None };
        let is_place = *relation == Relation::Equal && self.is_same(place, value);
        let mut asks = self.scene.questions.iter().map(|q| (&q.name, &q.ask));
        let which = asks.find_map(|(name, ask)| match ask {
            Ask::Extremum { which, .. } if *name == item => Some(which.word()),
            _ => None,
        });
        let (of, which) = (self.say(of), which?);
        is_place
            .then(|| format!("it is the {of} at which `{item}` is {which}: print it as {of} = …"))
    }

    /// Sides that agree when two parameters of one kind are exchanged in one of them.
    pub(super) fn exchanged(&self, pairs: &[(Expr, Expr)]) -> Option<String> {
        let parameters = &self.scene.parameters;
        for (i, p) in parameters.iter().enumerate() {
            let others = parameters[i + 1..].iter();
            for q in others.filter(|q| q.dimension == p.dimension) {
                let swap = [(p, q), (q, p)].map(|(p, q)| (p.name.clone(), Expr::symbol(&q.name)));
                let swap = BTreeMap::from(swap);
                let mut each = pairs.iter();
                if each.all(|(a, b)| self.is_same(a, &b.substitute(&swap))) {
                    let (p, q) = (&p.name, &q.name);
                    return Some(format!("it holds with {p} and {q} exchanged on one side"));
                }
            }
        }
        None
    }

    /// An equation that would hold with the sign of one side turned.
    pub(super) fn turned(&self, sides: &[Content], printed: &Printed) -> Option<String> {
        let [left, right] = sides else { return None };
        let l = self.put_in(left.expr()?, printed).ok()?;
        let r = self.put_in(right.expr()?, printed).ok()?;
        let same = self.is_same(&l, &-r);
        same.then(|| "it holds with the sign of one side turned".to_string())
    }

    /// Sides, or a value and the printed one, that agree up to one number, or turned upside down.
    pub(super) fn factor(&self, pairs: &[(Expr, Expr)]) -> Option<String> {
        if let [(closed, value)] = pairs
            && self.is_same(&(closed * value), &Expr::one())
        {
            return Some("it stands upside down".into());
        }
        let mut found: Option<Rational> = None;
        for (closed, value) in pairs.iter().filter(|(a, b)| !(a.is_zero() && b.is_zero())) {
            let k = self.factor_of(closed, value)?;
            if found.as_ref().is_some_and(|known| *known != k) {
                return None;
            }
            found = Some(k);
        }
        let k = found.filter(|k| *k != ratio(0, 1))?;
        Some(match k == ratio(-1, 1) {
            true => "right up to the sign".into(),
            false => format!("right up to the factor {k}"),
        })
    }

    /// Whether a slip may put one name for another: both given or both found, and of one dimension.
    fn kin(&self, a: &Symbol, b: &Symbol) -> bool {
        let found = |name: &Symbol| self.closed.contains_key(name);
        self.dimensions.get(a) == self.dimensions.get(b) && found(a) == found(b)
    }

    /// Exact points of the domain in doubles, with the values of everything that has a closed form, at which a formula has
    /// a value: a root has none where a motion does not get to its end.
    fn points(&self, formula: &Expr, wanted: &Expr) -> (Vec<Point<f64>>, Vec<f64>) {
        let mut needed = numeric::needed(self.scene);
        [formula, wanted].into_iter().for_each(|e| needed.add(e));
        self.closed.values().for_each(|e| needed.add(e));
        let point = |seed| {
            let random = numeric::random_point(&needed, &self.scene.domains, seed);
            let mut point: Point<f64> = numeric::rounded(&random);
            let value = |(name, e): (&Symbol, &Expr)| Some((name.clone(), e.evaluate(&point)?));
            let known: Vec<(Symbol, f64)> = self.closed.iter().filter_map(value).collect();
            point.values.extend(known);
            let value = wanted.evaluate(&point).filter(|v| v.is_finite())?;
            Some((point, value))
        };
        (31..31 + TRIED).filter_map(point).take(3).unzip()
    }

    /// The slip of the pen that turns a formula into the wanted one: seen at points in doubles, then proved.
    fn slip_of(&self, formula: &Expr, wanted: &Expr) -> Option<String> {
        let (points, values) = self.points(formula, wanted);
        let names: Vec<Symbol> = points.first()?.values.keys().cloned().collect();
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b.abs().max(1e-12);
        let whole = wanted.substitute(&self.closed);
        let fits = |changed: &Expr| {
            let mut pairs = points.iter().zip(&values);
            let seen = pairs.all(|(at, wanted)| {
                let value = changed.evaluate(at);
                value.is_some_and(|value| near(value, *wanted))
            });
            seen && self.is_same(&changed.substitute(&self.closed), &whole)
        };
        let kin = |a: &Symbol, b: &Symbol| self.kin(a, b);
        let found = slip::that_fit(formula, &names, &fits, &kin, &|e| self.say(e));
        // Whatever else was found makes the same formula.
        let first = found.into_iter().next()?;
        Some(format!("comes out when {first}"))
    }

    /// One slip that makes the printed formula out of the derived one.
    pub(super) fn slip(&self, pairs: &[(Expr, Expr)]) -> Option<String> {
        let wrong = pairs.iter().filter(|(a, b)| !self.is_same(a, b));
        match wrong.collect::<Vec<_>>().as_slice() {
            [(closed, value)] => self.slip_of(closed, value),
            _ => None,
        }
    }

    /// One change of the printed formula after which it is right: carom's own may be written otherwise.
    pub(super) fn slip_in_printed(&self, pairs: &[(Expr, Expr)]) -> Option<String> {
        let [(closed, value)] = pairs else {
            return None;
        };
        let found = self.slip_of(value, closed)?;
        Some(found.replacen("comes out when", "it would hold if", 1))
    }

    /// One change of a printed side after which the equation holds.
    pub(super) fn slip_in_equation(&self, sides: &[Content], printed: &Printed) -> Option<String> {
        let [left, right] = sides else { return None };
        if !printed.at.is_empty() || !printed.small.is_empty() || !printed.short.is_empty() {
            return None;
        }
        let (left, right) = (left.expr()?, right.expr()?);
        let found = self.slip_of(right, left);
        let found = found.or_else(|| self.slip_of(left, right))?;
        Some(found.replacen("comes out when", "it would hold if", 1))
    }

    fn tidied(&self, e: &Expr) -> Expr {
        algebra::tidy(e, &self.scene.domains).unwrap_or_else(|_| e.clone())
    }

    /// The number by which one formula is too large, if it is one.
    fn factor_of(&self, closed: &Expr, value: &Expr) -> Option<Rational> {
        let factor = algebra::quotient(value, closed, &self.scene.domains).ok()?;
        factor.as_number().cloned()
    }

    /// The cheapest check that shows a pair to be wrong.
    pub(super) fn caught(&self, pairs: &[(Expr, Expr)], printed: &Printed, finding: &mut Finding) {
        let within = self.domains_of(printed);
        let known = |name: &str| self.dimensions.get(name).cloned();
        for (closed, value) in pairs {
            if self.is_same(closed, value) {
                continue;
            }
            let by = match [closed, value].map(|e| dimension::of(e, &known)) {
                [Ok(Some(a)), Ok(Some(b))] if a != b => Some(format!("{b} instead of {a}")),
                [Ok(_), Err(clash)] if !matches!(*clash, Clash::Unknown(_)) => {
                    Some(clash.message(&|e| self.say(e)))
                }
                _ => None,
            };
            if let Some(by) = by {
                finding.caught_by = Some(format!("dimensions: {by}"));
                return;
            }
            if self.is_same(closed, &-value) {
                let words = "signs: a sketch of the motion, since only the sign is wrong";
                finding.caught_by = Some(words.into());
                return;
            }
            // Limits: each parameter at 0, where both sides have a value. A number too many or too few is seen there only
            // where the right one is given or a number.
            let is_plain =
                |e: &Expr| e.is_constant() || e.as_symbol().is_some() || (-e).as_symbol().is_some();
            let factor = self.factor_of(closed, value);
            for p in &self.scene.parameters {
                let Some(there) = vanishing(&within, &p.name) else {
                    continue;
                };
                let at_zero = BTreeMap::from([(p.name.clone(), Expr::zero())]);
                let (a, b) = (closed.substitute(&at_zero), value.substitute(&at_zero));
                let shorter =
                    a.symbols().len() + 1 < closed.symbols().len() || a.size() < closed.size() / 2;
                if shorter
                    && (factor.is_none() || is_plain(&a))
                    && let Equality::Different(_) = equality::decide(&a, &b, &there).equality
                {
                    let [p, a, b] =
                        [&Expr::from(p.name.clone()), &a, &b].map(|e| self.say(&self.tidied(e)));
                    let words = format!("limit: as {p} goes to 0 it becomes {a}, not {b}");
                    finding.caught_by = Some(words);
                    return;
                }
            }
        }
        let words = "putting simple numbers in, or the result back into the laws";
        finding.caught_by = Some(words.into());
    }

    /// A single slip in evaluating a formula for the same quantity that gives the printed number.
    pub(super) fn slips(
        &self,
        printed: &Printed,
        of: &Expr,
        wanted: f64,
        room: f64,
    ) -> Option<String> {
        let name = of.as_symbol()?;
        // The book's own formula first, as it stands; then carom's.
        let mut formulas: Vec<Expr> = Vec::new();
        let mut places: Vec<&str> = Vec::new();
        for p in &self.scene.printed {
            let Print::Formula { item, text } = &p.what else {
                continue;
            };
            let Ok(reading) = self.read(text, p) else {
                continue;
            };
            let component = match reading.content.answer() {
                Content::Vector(v) if **name == *format!("{item}_x") => Some(&v[0]),
                Content::Vector(v) if **name == *format!("{item}_y") => Some(&v[1]),
                other if **name == **item => other.expr(),
                _ => None,
            };
            // A number printed in its place is no formula.
            let component = component.filter(|e| !e.is_constant() && p.at == printed.at);
            let component = component.and_then(|e| self.put_in(e, p).ok());
            places.extend(component.as_ref().map(|_| p.place.as_str()));
            formulas.extend(component);
        }
        formulas.extend(self.put_in(&self.by_answer(of), printed));
        let values = self.scene.all_given()?;
        let kin = |a: &Symbol, b: &Symbol| self.kin(a, b);
        let printed = formulas.iter().zip(&places).find(|(e, _)| {
            let value = e.evaluate(&values);
            value.is_some_and(|v| (v - wanted).abs() <= room)
        });
        if let Some((_, place)) = printed {
            let words = format!("follows from the formula printed at [{place}]");
            return Some(format!("{words}; no misprint of its own"));
        }
        let names: Vec<Symbol> = values.values.keys().cloned().collect();
        // Where slips lead that are as near as a reader would look.
        let tried = RefCell::new(Vec::new());
        let fits = |changed: &Expr| {
            let value = changed.evaluate(&values);
            let near = value.filter(|v| (0.1..10.0).contains(&(v / wanted)));
            tried.borrow_mut().extend(near);
            value.is_some_and(|value| (value - wanted).abs() <= room)
        };
        let each = formulas.iter();
        let each = each.map(|e| slip::that_fit(e, &names, &fits, &kin, &|e| self.say(e)));
        let found = each.into_iter().find(|found| !found.is_empty())?;
        if by_chance(tried.into_inner(), room) > MOST_BY_CHANCE {
            return Some(FEW_DIGITS.into());
        }
        Some(match found.len() {
            n if n <= TOLD => format!("comes out when {}", found.join("; or when ")),
            n => {
                let (first, others) = (&found[0], n - 1);
                format!(
                    "comes out when {first}; or by one of {others} other slips, too many to tell which"
                )
            }
        })
    }

    /// Wrong numbers that follow from wrong numbers before them.
    pub(super) fn consequences(&self, findings: &mut [Finding]) {
        let printed = &self.scene.printed;
        for i in 0..findings.len() {
            let Print::Number {
                text,
                from: Some(from),
                ..
            } = &printed[i].what
            else {
                continue;
            };
            if findings[i].holds != Some(false) {
                continue;
            }
            let reading = self.read(from, &printed[i]).ok();
            let Some(formula) = reading.as_ref().and_then(Reading::expr) else {
                continue;
            };
            for j in 0..i {
                let Print::Number {
                    text: earlier, of, ..
                } = &printed[j].what
                else {
                    continue;
                };
                let of_it = Symbol::from(of.as_str());
                if findings[j].holds != Some(false) || !formula.symbols().contains(&of_it) {
                    continue;
                }
                let (Some(wrong), Some(mine)) = (number_of(earlier), number_of(text)) else {
                    continue;
                };
                let with = formula.put(&of_it, &Expr::from(wrong));
                let value = self.put_in(&with, &printed[i]).and_then(|e| self.value(&e));
                let Ok([low, _]) = value else { continue };
                if (mine - low).abs() <= ten_to(last_place(text)) * ratio(1, 2) {
                    findings[i].explained = Some(format!(
                        "follows from the earlier {earlier} for {of}; no misprint of its own"
                    ));
                }
            }
        }
    }
}

/// Where the other symbols may lie as one goes to zero; `None` where its domain or what is granted keeps it away from there.
fn vanishing(domains: &Domains, name: &Symbol) -> Option<Domains> {
    let low = domains.symbols.get(name).and_then(|d| d.bounds()[0]);
    if low.is_some_and(|low| low > 0.0) {
        return None;
    }
    let mut there = domains.clone();
    there.relations.retain(|r| !r.excess.mentions(name));
    for r in domains.relations.iter().filter(|r| r.excess.mentions(name)) {
        let excess = r.excess.put(name, &Expr::zero());
        match algebra::sign(&excess, &domains.of(&[&excess])) {
            Some(Sign::Negative) => return None,
            Some(sign) if sign.is_not_negative() => {}
            _ => there = there.given(&excess, true),
        }
    }
    Some(there)
}

/// The chance that one of several values lies within `room` of a number between a tenth and ten times what was looked for.
fn by_chance(mut values: Vec<f64>, room: f64) -> f64 {
    values.iter_mut().for_each(|value| *value = value.abs());
    values.sort_by(f64::total_cmp);
    values.dedup_by(|b, a| *b - *a <= room);
    let each = values.iter().map(|value| 2.0 * room / value);
    each.sum::<f64>() / 100f64.ln()
}
