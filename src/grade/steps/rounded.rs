//! Rounded numbers in a line: how far they may be off.

use num_traits::Signed;

use super::super::{Tolerance, fraction, number};
use super::Desk;
use super::link::Link;
use super::link::Values;
use crate::algebra::quotient;
use crate::dimension;
use crate::equality;
use crate::expr::number::to_f64;
use crate::expr::{Expr, Node, Point, Rational, Symbol, ratio};
use crate::formula;

impl Desk<'_> {
    /// Whether a side in numbers is the value of the other, up to the rounding of the numbers in the line; the scene's
    /// values are put in. A number of the scene is exact.
    pub(super) fn is_rounded(&self, text: &str, link: &Link, instead: &Values) -> bool {
        self.is_rounded_after(text, link, instead, None)
    }

    /// The same of a line that follows from a wrong one, whose numbers may be off as well.
    pub(super) fn is_rounded_after(
        &self,
        text: &str,
        link: &Link,
        instead: &Values,
        cause: Option<usize>,
    ) -> bool {
        if instead.is_empty() && self.is_within_own(link) {
            return true;
        }
        let values = self.sheet.scene.values();
        let exact = |e: &Expr| self.put_in(e, instead).substitute(&values);
        let sides = match (
            self.vector(&link.sides[0], true),
            self.vector(&link.sides[1], true),
        ) {
            (Some(a), Some(b)) => a.into_iter().zip(b).collect(),
            _ => match (link.sides[0].expr(), link.sides[1].expr()) {
                (Some(a), Some(b)) => vec![(a.clone(), b.clone())],
                _ => return false,
            },
        };
        // Without digits to round a number is meant as it stands.
        let (mut share, decimal) = coarsest(text, &values).unwrap_or_default();
        share += cause
            .and_then(|cause| self.coarse.get(&cause).cloned())
            .unwrap_or_default();
        let room = Tolerance::Relative(share.clone());
        let all_given = values.len() == self.sheet.scene.parameters.len();
        sides.iter().all(|(a, b)| {
            if !(a.symbols().is_empty() || b.symbols().is_empty()) {
                // `u = -v/8`: what is given is all put in.
                if all_given && !self.mentions_given(a) && !self.mentions_given(b) {
                    if decimal {
                        return self
                            .is_near_in_terms([a, b], instead, &share)
                            .is_some_and(|is| is);
                    }
                    let room = Tolerance::Relative(ratio(1, 1_000_000_000));
                    return number::within(&exact(b), &exact(a), &room) == Some(true);
                }
                // `5v/7 ≈ 0.714 v`: up to a rounded factor.
                let [a, b] = [a, b].map(|e| self.put_in(e, instead));
                let share = self.share(&a, &b).filter(|_| decimal);
                if share.is_some_and(|k| number::within(&k, &Expr::one(), &room) == Some(true)) {
                    return true;
                }
                // `v = e · 4.95 m/s`: some of the values put in, which the dimensions show; else it is a formula.
                if !decimal || self.have_one_dimension([&a, &b]) {
                    return false;
                }
            }
            let (a, b) = (exact(a), exact(b));
            let constant = a.symbols().is_empty() && b.symbols().is_empty();
            // What is no rounded number may be the exact one.
            let same = || equality::vanishes(&(&a - &b), &self.sheet.scene.domains);
            // Half a unit of the last digit is half of the one that was rounded, whichever way that went.
            let near = |a, b| number::within(b, a, &room) == Some(true);
            constant && (near(&a, &b) || near(&b, &a) || same())
        })
    }

    /// Notes a number that a chain of numbers comes to by a slip, `2*3 + 1 = 8`, with what it should be.
    pub(super) fn note_miscount(&mut self, text: &str, links: &[Link], at: usize) {
        let written = pieces(text, links.len()).and_then(|pieces| {
            let end = pieces[at + 1].trim();
            let digits = end.find(|c: char| !(c.is_ascii_digit() || c == '.'));
            Some(end[..digits.unwrap_or(end.len())].to_string()).filter(|number| number.len() > 1)
        });
        let right = links[at].sides[0].expr().map(|e| self.with_own(e));
        if let (Some(written), Some(right)) = (written, right.filter(Expr::is_constant)) {
            self.miscounts.push((self.number, written, right));
        }
    }

    /// The line with a slip of counting whose number a link of a chain takes over.
    pub(super) fn miscounted(&self, text: &str, links: &[Link], at: usize) -> Option<usize> {
        let sides = pieces(text, links.len())?;
        let (a, b) = (sides[at], sides[at + 1]);
        let found = self.miscounts.iter().rev().find(|(_, written, right)| {
            let right = format!("({})", formula::write_plain(right));
            let [left, end] = [a, b].map(|side| with_number(side, written, &right));
            let meant = format!("{left} = {end}");
            let reading = formula::read(&meant, &self.symbols(&meant)).ok();
            let link = reading.and_then(|reading| self.links(&reading)?.into_iter().next());
            let none = Values::new();
            (left != a || end != b)
                && link
                    .is_some_and(|link| self.holds(&link) || self.is_rounded(&meant, &link, &none))
        });
        found.map(|(line, ..)| *line)
    }

    /// Notes how far the numbers of a wrong line may be off.
    pub(super) fn note_coarse(&mut self, text: &str) {
        let found = coarsest(text, &self.sheet.scene.values());
        let decimal = found.filter(|(_, decimal)| *decimal);
        self.coarse
            .extend(decimal.map(|(share, _)| (self.number, share)));
    }

    /// Whether two sides differ by a share of their terms at most: where large ones cancel, what is left is off by more.
    fn is_near_in_terms(
        &self,
        [a, b]: [&Expr; 2],
        instead: &Values,
        share: &Rational,
    ) -> Option<bool> {
        fn size(e: &Expr, value: &dyn Fn(&Expr) -> Option<f64>) -> Option<f64> {
            match e.node() {
                Node::Sum(terms) => terms.iter().map(|term| size(term, value)).sum(),
                Node::Product(factors) => factors.iter().map(|f| size(f, value)).product(),
                _ => Some(value(e)?.abs()),
            }
        }
        let values = self.sheet.scene.values();
        let value = |e: &Expr| {
            let exact = self.put_in(e, instead).substitute(&values);
            exact.evaluate(&Point::<f64>::default())
        };
        let room = to_f64(share) * size(a, &value)?.max(size(b, &value)?);
        Some((value(a)? - value(b)?).abs() <= room)
    }

    fn mentions_given(&self, e: &Expr) -> bool {
        let names = e.symbols();
        names.iter().any(|name| self.is_given(name))
    }

    /// Whether the sides differ by no more than the own names in them may that were said to be decimal numbers.
    fn is_within_own(&self, link: &Link) -> bool {
        let values = self.sheet.scene.values();
        let middle = |e: &Expr| {
            let [low, high] = number::bounds(e)?;
            Some((low + high) / ratio(2, 1))
        };
        let rounded = self.ahead.iter().filter_map(|(name, right)| {
            let own = self.own.get(name)?;
            // Degrees are a fraction of π.
            let in_degrees =
                || fraction(&own.put(&Symbol::from("pi"), &Expr::one())).and(middle(own));
            let value = fraction(own).or_else(in_degrees)?;
            // What goes on to other lines counts from three digits, and is exact with less.
            let share = match coarsest(&format!("{right} ="), &values) {
                Some((share, decimal)) => decimal.then_some(share)?,
                None => ratio(0, 1),
            };
            Some((name, value.abs() * share, value))
        });
        let rounded: Vec<(&Symbol, Rational, Rational)> = rounded.collect();
        let mut exact = self.own.clone();
        exact.retain(|name, _| !rounded.iter().any(|(other, ..)| *other == name));
        let is_near = |gap: &Expr| {
            let own = (0..exact.len().min(8)).fold(gap.clone(), |e, _| e.substitute(&exact));
            let gap = own.substitute(&self.closed).substitute(&values);
            let at = |moved: Option<(&Symbol, &Rational)>| {
                let of = rounded.iter().map(|(name, _, value)| {
                    let by = moved.filter(|(other, _)| other == name).map(|(_, by)| by);
                    let value = by.map_or(value.clone(), |by| value + by);
                    ((*name).clone(), Expr::from(value))
                });
                middle(&gap.substitute(&of.collect()))
            };
            let off = at(None)?;
            let mut room = ratio(0, 1);
            for (name, half, _) in &rounded {
                let ends =
                    [half.clone(), -half].map(|by| Some((at(Some((name, &by)))? - &off).abs()));
                let [Some(a), Some(b)] = ends else {
                    return None;
                };
                room += a.max(b);
            }
            Some(off.abs() <= room)
        };
        !rounded.is_empty()
            && link
                .differences
                .iter()
                .all(|gap| is_near(gap) == Some(true))
    }

    /// Whether two sides in terms of parameters have the same dimension.
    fn have_one_dimension(&self, sides: [&Expr; 2]) -> bool {
        let parameters = &self.sheet.scene.parameters;
        let known = |name: &str| {
            let named = parameters.iter().find(|p| *p.name == *name);
            named.map(|p| p.dimension.clone())
        };
        let [a, b] = sides.map(|side| dimension::of(side, &known));
        matches!((a, b), (Ok(a), Ok(b)) if a == b)
    }

    /// The constant factor between two formulas.
    pub(super) fn share(&self, a: &Expr, b: &Expr) -> Option<Expr> {
        let share = quotient(b, a, &self.sheet.scene.domains).ok()?;
        share.is_constant().then_some(share)
    }
}

/// Whether two numbers are the same as far as the digits of a line tell, beside values that are exact.
pub(super) fn is_near(text: &str, [a, b]: [&Expr; 2], exact: &Values) -> bool {
    let share = coarsest(text, exact).map(|(share, _)| Tolerance::Relative(share));
    share.is_some_and(|room| number::within(b, a, &room) == Some(true))
}

/// The sides of a chain with so many signs of equality, as they are written, without the name that it defines.
pub(super) fn pieces(text: &str, signs: usize) -> Option<Vec<&str>> {
    let mut pieces: Vec<&str> = text.split(['=', '≈']).map(str::trim).collect();
    let more = pieces.len().checked_sub(signs + 1)?;
    (more < 2).then(|| pieces.split_off(more))
}

/// A text with something in the place of a number.
fn with_number(text: &str, number: &str, other: &str) -> String {
    let is_digit = |c: char| c.is_ascii_digit() || c == '.';
    let mut out = String::new();
    let mut rest = text;
    while let Some(at) = rest.find(number) {
        let (before, behind) = (&rest[..at], &rest[at + number.len()..]);
        let inside = before.ends_with(is_digit) || behind.starts_with(is_digit);
        out.extend([before, if inside { number } else { other }]);
        rest = behind;
    }
    out + rest
}

/// A line with decimal points for decimal commas.
fn with_points(text: &str) -> String {
    let before = std::iter::once(None).chain(text.chars().map(Some));
    let behind = text.chars().skip(1).map(Some).chain([None]);
    let is_digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    let each = before.zip(text.chars()).zip(behind);
    let point = each.map(|((before, c), behind)| match c {
        ',' if is_digit(before) && is_digit(behind) => '.',
        c => c,
    });
    point.collect()
}

/// How far numbers of a line may be off, as a share: half a unit in the last digit of the coarsest one. What stands last
/// counts from two digits, what leads to it from three; values of the scene are exact. Also whether any has a decimal point.
fn coarsest(text: &str, values: &Values) -> Option<(Rational, bool)> {
    let text = &with_points(text);
    let last = text.rfind(['=', '≈']).unwrap_or(0);
    let share = |word: &str, least: usize| {
        let value = number::decimal(word).filter(Signed::is_positive)?;
        let digits = word.trim_start_matches(['0', '.']).replace('.', "").len();
        let mut known = values.values().filter_map(fraction);
        if digits < least || known.any(|v| v == value) {
            return None;
        }
        let digits = u32::try_from(digits.max(2)).ok()?.min(12);
        Some(number::half_unit(&value, digits) / value)
    };
    let words = |text: &'_ str| -> Vec<String> {
        let words = text.split(|c: char| !(c.is_ascii_digit() || c == '.'));
        let words = words.map(|word| word.trim_end_matches('.').to_string());
        words.collect()
    };
    let decimal = |word: &&String| word.contains('.');
    let before = words(&text[..last]);
    let behind = words(&text[last..]);
    let led = before.iter().filter(decimal).filter_map(|w| share(w, 3));
    let mut ends: Vec<Rational> = behind
        .iter()
        .filter(decimal)
        .filter_map(|w| share(w, 2))
        .collect();
    let led: Vec<Rational> = led.collect();
    let decimals = !(led.is_empty() && ends.is_empty());
    if ends.is_empty() {
        let whole = behind.iter().find(|w| !w.is_empty() && !w.contains('.'));
        ends.extend(whole.and_then(|w| share(w, 1)));
    }
    Some((led.into_iter().chain(ends).max()?, decimals))
}
