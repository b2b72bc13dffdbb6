//! A solution as a page of lines: its headings, the items of its lists, and lines that go on with the one before.

use std::collections::BTreeMap;

use super::super::sheet::Sheet;
use super::MAX_LINES;
use super::text::{BETWEEN, equations, relates};
use crate::dimension;
use crate::expr::{Expr, Symbol};
use crate::formula::{self, Content, Symbols};
use crate::scene;

/// The equations of a page, one by one.
pub(super) fn all_equations(page: &str) -> impl Iterator<Item = &str> {
    page.lines().take(MAX_LINES).flat_map(equations)
}

/// The numbers that a line gives to quantities of the scene which have none there: `m = 2 kg, l = 1.5 m`. Nothing where it says
/// something else as well.
pub(super) fn numbers(sheet: &Sheet, line: &str) -> Option<Vec<(Symbol, Expr)>> {
    let is_open = |name: &Symbol| {
        sheet
            .scene
            .parameter(name)
            .is_some_and(|p| p.value.is_none())
    };
    let open = |equation| number(sheet, equation).filter(|(name, _)| is_open(name));
    equations(line).into_iter().map(open).collect()
}

/// A parameter with the number that an equation gives it, in its unit or bare: `m = 2 kg`.
pub(super) fn number(sheet: &Sheet, equation: &str) -> Option<(Symbol, Expr)> {
    let mut symbols = Symbols::strict();
    sheet.declare(&mut symbols);
    let (left, right) = equation.split_once('=')?;
    let name = formula::read_name(left.trim(), &symbols)?;
    let given = sheet.scene.parameter(&name)?;
    let value = formula::read(right, &Symbols::strict()).ok()?.content;
    let measured = match &value {
        Content::Quantity(q) => q.unit.dimension == given.dimension,
        _ => true,
    };
    let plain = dimension::unit(&given.unit).is_ok_and(|unit| unit.value().is_one());
    let value = value
        .expr()
        .filter(|e| measured && plain && e.is_constant())?
        .clone();
    Some((name, value))
}

/// The scene with the numbers that a page gives several of its quantities, where it has none itself, in lines of numbers alone.
pub(super) fn with_numbers(sheet: &Sheet, page: &str) -> Option<Sheet> {
    let lines = page.lines().take(MAX_LINES);
    let said = lines.filter_map(|line| numbers(sheet, line)).flatten();
    let mut values = BTreeMap::new();
    for (name, value) in said {
        // What is said twice is no number for all of the page.
        if values
            .insert(name.clone(), value.clone())
            .is_some_and(|before| before != value)
        {
            return None;
        }
    }
    let mut sheet = (values.len() > 1).then(|| sheet.clone())?;
    for (name, value) in values {
        scene::set(&mut sheet.scene, &name, &formula::write_plain(&value)).ok()?;
    }
    Some(sheet)
}

/// Whether a line is the heading of a part: `## 2. Bounce`, `Second bounce:`, `(b) After the impact`.
pub(super) fn is_heading(line: &str) -> bool {
    const MOST: usize = 6;
    let words = line.split_whitespace().count();
    let is_sentence = line.ends_with([',', '.', ';']);
    let says = line.chars().any(char::is_alphabetic) && !line.contains(['$', '\\', '&']);
    line.starts_with('#') || says && words <= MOST && !is_sentence && !relates(line)
}

/// A solution without what aligns its lines in LaTeX: a line that goes on with a further term or factor, `& + …`, is put behind
/// the one before it, and a heading is words.
pub(super) fn joined(text: &str) -> String {
    let mut out: Vec<String> = Vec::new();
    let mut last = None;
    for line in text.lines() {
        let aligned = line.trim_start().strip_prefix('&').map(str::trim_start);
        let signs = ["+", "-", "\\times", "\\cdot"];
        let goes_on = aligned.filter(|rest| signs.iter().any(|sign| rest.starts_with(sign)));
        match (goes_on, last) {
            (Some(rest), Some(at)) => {
                let line: &mut String = &mut out[at];
                line.push(' ');
                line.push_str(&unaligned(rest));
                out.push(String::new());
            }
            _ if line.starts_with("#") => out.push(String::new()),
            _ => {
                last = Some(out.len());
                out.push(unaligned(line.trim()));
            }
        }
    }
    out.join("\n")
}

/// A line without what aligns it with others in LaTeX: `ω &= 3v/(2ℓ) \\\\`.
fn unaligned(line: &str) -> String {
    // `**Momentum:** m v = …`
    let bold = line.strip_prefix("**").and_then(|l| l.split_once("**"));
    let bold = bold.map(|(words, rest)| format!("{words}{rest}"));
    // `\\textbf{Step 1.} $m v = …$`
    let heading = ["\\textbf{", "\\emph{", "\\textit{"].into_iter();
    let mut heading = heading.filter_map(|font| line.strip_prefix(font)?.split_once('}'));
    let bold = bold.or_else(|| {
        let (words, rest) = heading.find(|(words, _)| words.contains([' ', ':']))?;
        Some(format!(
            "{}: {rest}",
            words.trim_end_matches([' ', ':', '.'])
        ))
    });
    let line = bold.as_deref().unwrap_or(line);
    let line = line.trim_end_matches("\\\\").trim_end();
    let line = line
        .trim_end_matches("\\\\")
        .replace("&=", "=")
        .replace("&\\approx", "\\approx");
    let line = between_formulas(&line.replace("\\quad", " ").replace('&', " "));
    // `v = 3 u/7 [m/s]`
    let unit = line.strip_suffix(']').and_then(|l| l.rsplit_once('['));
    match unit.filter(|(_, unit)| dimension::unit(unit).is_ok()) {
        Some((said, unit)) => format!("{said}{unit}"),
        None => line,
    }
}

/// A line with the words between its formulas, `\\text{and}`, as words.
fn between_formulas(line: &str) -> String {
    let mut pieces = line.split("\\text{");
    let mut out = pieces.next().unwrap_or_default().to_string();
    for piece in pieces {
        let said = piece
            .split_once('}')
            .map(|(word, rest)| (word.trim(), rest));
        let known = |word: &str| BETWEEN.split('|').any(|sign| sign.trim() == word);
        match said.filter(|(word, _)| known(word)) {
            Some((word, rest)) => out.extend([" ", word, " ", rest]),
            None => out.extend(["\\text{", piece]),
        }
    }
    out
}

/// Whether dashes begin the items of a list: more than one line begins with one that a blank follows.
pub(super) fn has_dashes(text: &str) -> bool {
    let dashed = |line: &&str| line.trim_start().starts_with("- ");
    text.lines().filter(dashed).count() > 1
}

/// A line that goes on with an equality sign, with the ends of the chain before it: what is spoken of, and its last side.
pub(super) fn continued(whole: &str, line: &str) -> String {
    let rest = line.trim_start_matches(['&', '$', ' ']);
    let goes_on =
        rest.starts_with(['=', '≈']) && !rest.starts_with("=>") || rest.starts_with("\\approx");
    // What stands behind `where` says what a letter is.
    let wheres = [", where ", " where ", ", with "].into_iter();
    let before = wheres.filter_map(|word| whole.split_once(word)).next();
    let before = before.map_or(whole, |(chain, _)| chain);
    let chain = equations(before).pop().filter(|_| goes_on);
    let Some((first, last)) =
        chain.and_then(|chain| Some((chain.split('=').next()?, chain.rsplit(['=', '≈']).next()?)))
    else {
        return line.to_string();
    };
    format!("{first}= {last} {rest}")
}
