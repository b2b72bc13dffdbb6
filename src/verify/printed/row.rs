//! What is printed for an answer: a formula, a number as it is rounded, or several in a row, `omega = v/(2 l) ≈ 5.2 rad/s`.

use std::ops::Range;

use super::Finding;
use super::desk::Desk;
use super::number::{Figure, components};
use crate::expr::{Expr, Symbol};
use crate::formula::{self, Content, Relation, Symbols};
use crate::scene::Printed;

/// The places of the sides of a text; those that another sign than one of equality parts are one where not asked for.
fn sides(text: &str, with_order: bool) -> Vec<Range<usize>> {
    let parts = |relation| matches!(relation, Relation::Equal | Relation::Approximately);
    let (mut all, mut start) = (Vec::new(), 0);
    for (at, relation) in formula::relations(text) {
        if with_order || parts(relation) {
            all.push(start..at.start);
            start = at.end;
        }
    }
    all.push(start..text.len());
    all
}

impl Desk<'_> {
    /// A formula, a number with its unit, or both in a row.
    pub(super) fn answer(
        &self,
        printed: &Printed,
        item: &str,
        text: &str,
        finding: &mut Finding,
    ) -> Result<(), String> {
        let own = self.under_own_name(printed, item, text);
        let text = own.as_deref().unwrap_or(text);
        let places = sides(text, false);
        if self.breaks_in_the_middle(printed, item, text, &places, finding) {
            return Ok(());
        }
        let (before, last) = match places.as_slice() {
            [.., before, last] => (&text[..before.end], &text[last.clone()]),
            _ => ("", text),
        };
        let led = self.read(before, printed).ok();
        let name = led.and_then(|led| led.content.answer().expr()?.as_symbol().cloned());
        let arrow = formula::with_arrow(item);
        let is_own = |name: &Symbol| **name == *item || arrow.as_deref() == Some(&**name);
        let place = self
            .bounds
            .get(item)
            .filter(|(of, ..)| of.as_symbol() == name.as_ref());
        let place = place.map(|(.., place)| place);
        let Some(figures) = self.figures(printed, item, place, last) else {
            return self.formula(printed, item, text, finding);
        };
        let is_led = before.trim().is_empty() || before.trim() == item;
        if !is_led && place.is_none() && !name.as_ref().is_some_and(is_own) {
            self.formula(printed, item, before, finding)?;
            if finding.holds != Some(true) {
                return Ok(());
            }
        }
        for (name, figure) in &figures {
            let of = place.map_or_else(|| Expr::symbol(name), Expr::clone);
            self.rounded(printed, figure, name, &of, finding)?;
            if finding.holds != Some(true) {
                if let (true, Some(axis)) = (figures.len() > 1, name.chars().last()) {
                    finding.because = format!("along {axis}, {}", finding.because);
                }
                break;
            }
        }
        Ok(())
    }

    /// A text that leads with a single name that the scene does not know, `\omega = …` for the item `w`: that is what the book calls
    /// the answer.
    fn under_own_name(&self, printed: &Printed, item: &str, text: &str) -> Option<String> {
        let places = sides(text, false);
        let [first, second, others @ ..] = places.as_slice() else {
            return None;
        };
        let name = &text[first.clone()];
        let read = formula::read(name, &Symbols::open()).ok()?;
        let is_name = read.content.expr().is_some_and(|e| e.as_symbol().is_some());
        if !is_name || self.read(name, printed).is_ok() {
            return None;
        }
        Some(match others {
            [] => text[second.clone()].to_string(),
            _ => format!("{item} {}", &text[first.end..]),
        })
    }

    /// Whether a formula between the first and the last of a row is wrong; then that is what is found.
    fn breaks_in_the_middle(
        &self,
        printed: &Printed,
        item: &str,
        text: &str,
        places: &[Range<usize>],
        finding: &mut Finding,
    ) -> bool {
        let [first, middle @ .., _] = places else {
            return false;
        };
        let named = self.read(&text[first.clone()], printed).ok();
        let is_row = named.is_some_and(|name| name.expr().is_some_and(|e| e.as_symbol().is_some()))
            && sides(text, true).len() == places.len();
        is_row
            && middle.iter().any(|side| {
                let mut own = Finding {
                    place: finding.place.clone(),
                    kind: finding.kind,
                    printed: finding.printed.clone(),
                    ..Finding::default()
                };
                let judged = self.answer(printed, item, &text[side.clone()], &mut own);
                let is_wrong = judged.is_ok() && own.holds == Some(false);
                if is_wrong {
                    *finding = own;
                }
                is_wrong
            })
    }

    /// The numbers of which a text is made that stand for an answer, each with the name of what it is of.
    fn figures(
        &self,
        printed: &Printed,
        item: &str,
        place: Option<&Expr>,
        text: &str,
    ) -> Option<Vec<(Symbol, Figure)>> {
        if self.vectors.contains_key(item) {
            let [x, y] = components(text)?;
            let of = |axis: &str| Symbol::from(format!("{item}_{axis}"));
            return Some(vec![(of("x"), x), (of("y"), y)]);
        }
        let figure = self.measured(place.or(self.answered(item))?, text, printed)?;
        Some(vec![(item.into(), figure)])
    }

    /// A number with its unit, or with a degree or percent sign: `9h` is nine times a height h, unless a time is asked for.
    fn measured(&self, of: &Expr, text: &str, printed: &Printed) -> Option<Figure> {
        let figure = Figure::read(text).ok()?;
        let is_unit = match &figure.quantity {
            Some(q) => {
                let is_free =
                    |content: &Content| content.expr().is_some_and(|e| !e.symbols().is_empty());
                let in_names = self.read(text, printed);
                self.other_dimension(of, q).is_none()
                    || !in_names.is_ok_and(|reading| is_free(&reading.content))
            }
            None => figure.is_marked,
        };
        (is_unit && figure.is_literal).then_some(figure)
    }

    /// The number that is printed for a value by itself, or as the bound of something: with its unit, or a decimal.
    pub(super) fn figure(
        &self,
        pairs: &[(Expr, Expr)],
        text: &str,
        printed: &Printed,
    ) -> Option<Figure> {
        let [(of, value)] = pairs else { return None };
        if !value.is_constant() {
            return None;
        }
        let plain = |side: &str| {
            let figure = Figure::read(side).ok()?;
            let is_plain = figure.is_literal && figure.quantity.is_none() && side.contains('.');
            let is_number = || self.dimension(of).is_some_and(|d| d.is_none());
            // Where the scene gives its values, one without its unit is such a number as well.
            let has_value = || {
                let value = self.put_in(of, printed).ok();
                value.is_some_and(|value| self.value(&value).is_ok())
            };
            (is_plain && (of.is_constant() || is_number() || has_value())).then_some(figure)
        };
        let places = sides(text, true);
        let mut each = places.into_iter().map(|place| text[place].trim());
        each.find_map(|side| self.measured(of, side, printed).or_else(|| plain(side)))
    }
}
