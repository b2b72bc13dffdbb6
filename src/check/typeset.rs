//! Claims as they are typeset: the LaTeX beside a claim is read, with the spellings the file gives its symbols, and has to
//! say the same as the claim.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use super::Meaning;
use crate::expr::{Expr, Symbol};
use crate::formula::{self, Content, Relation, Symbols};
use crate::scene::Scene;

/// The names that formulas may hold.
pub(super) struct Known {
    /// As formulas are read.
    pub symbols: Symbols,
    /// What they look like in LaTeX, where the file says so.
    spelled: BTreeMap<Symbol, String>,
}

impl Known {
    /// The parameters of a scene, the symbols of the file, and its spellings.
    pub(super) fn of(scene: &Scene, meanings: &BTreeMap<Symbol, Meaning>, file: &Value) -> Known {
        let all = file.as_object().into_iter().flatten();
        let spelled = all.filter_map(|(name, latex)| {
            Some((Symbol::from(name.as_str()), latex.as_str()?.to_string()))
        });
        let spelled = spelled.collect();
        let mut symbols = Symbols::strict();
        let parameters = scene.parameters.iter().map(|p| &p.name);
        for name in parameters.chain(meanings.keys()) {
            symbols.declare(name);
        }
        Known { symbols, spelled }
    }
}

/// Why the LaTeX of a claim is not the claim; `None` where it is, and where there is none.
pub(super) fn differs(claim: &Value, left: &Expr, right: &Expr, known: &Known) -> Option<String> {
    let latex = match &claim["latex"] {
        Value::Null => return None,
        latex => latex.as_str().unwrap_or_default(),
    };
    // Cases may call their answers alike; within one claim a spelling is one symbol.
    let mut symbols = Symbols::strict();
    let mut taken = BTreeMap::new();
    let names: BTreeSet<Symbol> = [left, right].into_iter().flat_map(Expr::symbols).collect();
    for name in &names {
        let spelling = known.spelled.get(name);
        if let Some(spelling) = spelling {
            if !latex.contains(spelling) {
                return Some(format!("the typeset formula spells {name} in another way"));
            }
            if let Some(other) = taken.insert(spelling, name) {
                return Some(format!("{other} and {name} are both spelled {spelling}"));
            }
        }
        symbols.declare_as(name.clone(), spelling.map(String::as_str), None);
    }
    // What carom would write itself is taken as it is: some spellings no reader takes apart.
    let write = |e: &Expr| formula::write_latex(e, &|n| known.spelled.get(n).cloned());
    if latex == format!("{} = {}", write(left), write(right)) {
        return None;
    }
    let found = match formula::read(latex, &symbols) {
        Ok(reading) => reading.content,
        Err(fault) => {
            let why = fault.message;
            return Some(format!("the typeset formula cannot be read: {why}"));
        }
    };
    let is = |side: &Content, e: &Expr| side.expr().is_some_and(|found| found == e);
    match &found {
        Content::Relations(sides, signs)
            if matches!(signs.as_slice(), [Relation::Equal])
                && is(&sides[0], left)
                && is(&sides[1], right) =>
        {
            None
        }
        _ => Some(String::from("the typeset formula says something else")),
    }
}
