//! Printed matrices, row by row: a law, or what would make it one.

use std::collections::BTreeMap;

use super::Finding;
use super::desk::Desk;
use crate::domain::Domain;
use crate::expr::{Expr, Symbol};
use crate::scene::Printed;
use crate::verify::{rounding, row_space};

impl Desk<'_> {
    pub(super) fn matrix(
        &self,
        printed: &Printed,
        entries: &[Vec<String>],
        unknowns: &[String],
        right: &[String],
        finding: &mut Finding,
    ) -> Result<(), String> {
        let expr = |text: &String| -> Result<Expr, String> {
            let reading = self.read(text, printed)?;
            let e = reading
                .expr()
                .ok_or_else(|| format!("{text} is no expression"))?
                .clone();
            // Known quantities only: an unknown in an entry stays what it is.
            Ok(e.substitute(&self.known_only()))
        };
        let mut rows = Vec::new();
        for (row, rhs) in entries.iter().zip(right) {
            let row: Result<Vec<Expr>, String> = row.iter().map(expr).collect();
            rows.push((row?, expr(rhs)?));
        }
        let mut scene = self.scene.clone();
        for [name, text] in &printed.at {
            let value = self
                .read(text, printed)?
                .expr()
                .and_then(rounding::fraction);
            let value = value.ok_or_else(|| format!("{name} = {text} is no fraction"))?;
            let only = Domain::between(value.clone(), value);
            scene
                .domains
                .symbols
                .insert(Symbol::from(name.as_str()), only);
        }
        let verdicts = row_space::judge(&scene, unknowns, &rows)?;
        let mut wrong = Vec::new();
        finding.holds = Some(true);
        for (i, verdict) in verdicts.iter().enumerate() {
            match verdict {
                row_space::Row::Law => {}
                row_space::Row::Empty | row_space::Row::Repeats => {
                    finding.holds = Some(false);
                    let why = match verdict {
                        row_space::Row::Empty => "holds nothing",
                        _ => "follows from the rows above it",
                    };
                    wrong.push(format!("row {} {why}, so the matrix is singular", i + 1));
                }
                row_space::Row::Masked(mend) | row_space::Row::Wrong(mend) => {
                    finding.holds = Some(false);
                    let is_masked = matches!(verdict, row_space::Row::Masked(_));
                    let mut words = format!("row {} is no law", i + 1);
                    words.push_str(match is_masked {
                        true => ", though this solution fulfils it: the mistake is masked",
                        false => ", and the solution does not fulfil it",
                    });
                    if let Some(mend) = mend {
                        let row = (i, &rows[i].0[..], &rows[i].1);
                        words.push_str(&self.mended(mend, row, unknowns, is_masked, finding));
                    }
                    wrong.push(words);
                }
            }
        }
        finding.because = match wrong.is_empty() {
            true => "every row is a combination of the laws, at exact points of the domain".into(),
            false => wrong.join("; "),
        };
        if !wrong.is_empty() {
            finding.caught_by = Some("holding each row against the equation it comes from".into());
        }
        Ok(())
    }

    /// What one entry would have to be for its row to be a law, in words; and what that says of the slip.
    fn mended(
        &self,
        mend: &row_space::Mend,
        (i, row, right): (usize, &[Expr], &Expr),
        unknowns: &[String],
        is_masked: bool,
        finding: &mut Finding,
    ) -> String {
        let better = self.say(&mend.value);
        let (place, printed) = match mend.column {
            Some(column) => {
                finding.carom = format!("entry ({}, {}) is {better}", i + 1, column + 1);
                let place = format!("in column {} (of {})", column + 1, unknowns[column]);
                (place, &row[column])
            }
            None => {
                finding.carom = format!("right side {} is {better}", i + 1);
                ("on the right".to_string(), right)
            }
        };
        let slip = match self.is_same(printed, &-&mend.value) {
            true => "the sign of one entry is turned",
            false => "one entry is misprinted",
        };
        let felt = match is_masked {
            true => ", and nothing here feels it",
            false => "",
        };
        finding.explained = Some(format!("{slip}{felt}: a misprint of its own"));
        let printed = self.say(printed);
        format!("; with {better} {place} in place of {printed} it would be")
    }

    pub(super) fn known_only(&self) -> BTreeMap<Symbol, Expr> {
        let given = |name: &Symbol| {
            name.starts_with("I_") || name.starts_with("x_") || name.starts_with("y_")
        };
        self.closed
            .iter()
            .filter(|(name, _)| given(name))
            .map(|(n, e)| (n.clone(), e.clone()))
            .collect()
    }
}
