//! What a book prints about a scene, as the file holds it. Formulas stay texts: `verify` reads them, and one that cannot be
//! read is a finding there rather than a fault of the scene.

use super::fault::Fault;
use super::file::{PrintedFile, SceneFile};
use super::record::{Map, Text};

/// Something printed.
#[derive(Clone, Debug)]
pub struct Printed {
    /// Where it is printed, such as `(17.62)`.
    pub place: String,
    /// What is printed.
    pub what: Print,
    /// Special values of parameters for which it is printed: name and formula.
    pub at: Vec<[String; 2]>,
    /// Abbreviations: name and what it stands for.
    pub short: Vec<[String; 2]>,
    /// Angles taken as small.
    pub small: Vec<String>,
}

/// The kinds of things printed.
#[derive(Clone, Debug)]
pub enum Print {
    /// A formula for an answer.
    Formula {
        /// Name of the answer.
        item: String,
        /// The formula.
        text: String,
    },
    /// A number.
    Number {
        /// The number with its unit.
        text: String,
        /// What it is of.
        of: String,
        /// The formula by which the book got it from other numbers.
        from: Option<String>,
    },
    /// An equation or inequality.
    Equation {
        /// The equation.
        text: String,
        /// The same in words, where it is a claim.
        claim: Option<String>,
    },
    /// A matrix equation.
    Matrix {
        /// Entries, row by row.
        entries: Vec<Vec<String>>,
        /// Names of the unknowns.
        unknowns: Vec<String>,
        /// Right sides.
        right: Vec<String>,
    },
}

/// Whether some printed formula has a word that is this name.
pub(super) fn mentions(printed: &[Printed], name: &str) -> bool {
    let inside = |text: &String| {
        text.split(|c: char| !c.is_alphanumeric() && c != '_')
            .any(|word| word == name)
    };
    printed.iter().any(|p| {
        let texts: Vec<&String> = match &p.what {
            Print::Formula { text, .. } | Print::Equation { text, .. } => vec![text],
            Print::Number { of, .. } => vec![of],
            Print::Matrix { entries, right, .. } => entries.iter().flatten().chain(right).collect(),
        };
        texts.into_iter().any(inside)
    })
}

/// Most things printed about one scene.
const PRINTED: usize = 500;

/// Reads the list; entries that say nothing, or two things, are reported.
pub(super) fn resolve(file: &SceneFile, faults: &mut Vec<Fault>) -> Vec<Printed> {
    entries(file.printed.as_deref().unwrap_or_default(), faults)
}

/// The same for a list that stands in a file of its own.
pub(super) fn entries(all: &[PrintedFile], faults: &mut Vec<Fault>) -> Vec<Printed> {
    if let Some(first) = all.get(PRINTED) {
        let message = format!("more than {PRINTED} printed entries");
        faults.push(Fault::new(first.span, message));
        return Vec::new();
    }
    all.iter().filter_map(|entry| one(entry, faults)).collect()
}

fn one(entry: &PrintedFile, faults: &mut Vec<Fault>) -> Option<Printed> {
    let text = |t: &Option<Text>| t.as_ref().map(|t| t.text.clone());
    let texts = |row: &Vec<Text>| row.iter().map(|t| t.text.clone()).collect::<Vec<_>>();
    let list = |t: &Option<Vec<Text>>| t.as_ref().map(texts).unwrap_or_default();
    let map = |m: &Option<Map<Text>>| -> Vec<[String; 2]> {
        let pair = |(name, t): (&Text, &Text)| [name.text.clone(), t.text.clone()];
        super::record::entries(m.as_ref()).map(pair).collect()
    };
    let kinds = [
        entry.item.is_some(),
        entry.number.is_some(),
        entry.equation.is_some(),
        entry.matrix.is_some(),
    ];
    let what = match (
        kinds.iter().filter(|k| **k).count(),
        text(&entry.item),
        text(&entry.number),
        text(&entry.equation),
    ) {
        (1, Some(item), _, _) => text(&entry.printed).map(|text| Print::Formula { item, text }),
        (1, _, Some(number), _) => text(&entry.of).map(|of| Print::Number {
            text: number,
            of,
            from: text(&entry.from),
        }),
        (1, _, _, Some(equation)) => Some(Print::Equation {
            text: equation,
            claim: text(&entry.claim),
        }),
        (1, ..) => {
            let rows = entry.matrix.iter().flatten();
            let entries: Vec<Vec<String>> = rows.map(texts).collect();
            let (unknowns, right) = (list(&entry.unknowns), list(&entry.right));
            let fits = entries.len() == right.len()
                && entries.iter().all(|row| row.len() == unknowns.len());
            fits.then_some(Print::Matrix {
                entries,
                unknowns,
                right,
            })
        }
        _ => None,
    };
    let Some(what) = what else {
        let fault = Fault::new(entry.span, "this printed entry is not complete");
        let hint = "give one of: item with printed; number with of; equation; matrix with as many unknowns as columns and right sides as rows";
        return fault.hint(hint).add_to(faults);
    };
    Some(Printed {
        place: text(&entry.place).unwrap_or_default(),
        what,
        at: map(&entry.at),
        short: map(&entry.short),
        small: list(&entry.small),
    })
}
