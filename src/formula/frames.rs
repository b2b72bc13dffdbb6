//! What stands around several values, taken off: braces of a set, the brace of a system, lines.

/// A line without the mark of an item in a list: `1) ω = …`, `2. ω = …`, `(a) ω = …`, `* ω = …`, and `- ω = …` where `dashes` are
/// marks.
pub(crate) fn unlisted(line: &str, dashes: bool) -> &str {
    let marks = ["* ", "• ", "– ", "- "]
        .iter()
        .take(3 + usize::from(dashes));
    if let Some(rest) = marks.filter_map(|mark| line.strip_prefix(mark)).next() {
        return rest.trim_start();
    }
    let number = |mark: &str| mark.len() < 3 && mark.bytes().all(|b| b.is_ascii_digit());
    if let Some((_, rest)) = line.split_once(". ").filter(|(mark, _)| number(mark)) {
        return rest.trim_start();
    }
    let Some((mark, rest)) = line.split_once(") ") else {
        return line;
    };
    let is_mark = match mark.strip_prefix('(') {
        // `(2) v + (3) u` are factors.
        Some(inside) => {
            ["a", "b", "c", "i", "ii", "iii", "iv"].contains(&inside)
                || number(inside) && !rest.contains('(')
        }
        None => mark.len() == 1 || number(mark),
    };
    if is_mark { rest.trim_start() } else { line }
}

/// `{2, 3}` and `x ∈ {2, 3}` with blanks for the braces and an equals sign for that of membership, byte for byte; nothing
/// where the text is no set.
pub(super) fn without_braces(text: &str) -> Option<String> {
    // All as long as before.
    let text = text
        .replace("\\mathbb{R}", "ℝ       ")
        .replace("\\left\\{", "     \\{")
        .replace("\\right\\}", "\\}      ")
        .replace("\\lbrace", "     \\{")
        .replace("\\rbrace", "\\}     ");
    let (open, close) = (text.find('{')?, text.rfind('}')?);
    let inside = text.get(open + 1..close)?;
    if inside.contains(['{', '}']) || !text[close + 1..].trim().is_empty() {
        return None;
    }
    let escaped = inside.ends_with('\\');
    let before = match (text[..open].strip_suffix('\\'), escaped) {
        (Some(before), true) => before,
        (None, false) => &text[..open],
        _ => return None,
    };
    let inside = &inside[..inside.len() - usize::from(escaped)];
    let named = before.trim_end();
    let name = ["∈", "\\in", " in"]
        .iter()
        .find_map(|sign| named.strip_suffix(sign));
    if let Some(condition) = behind_bar(inside).filter(|_| named.is_empty()) {
        return Some(format!(
            "{:1$}{condition}",
            "",
            open + 1 + inside.len() - condition.len()
        ));
    }
    let start = match name {
        Some(name) => format!("{name}{:<1$}", "=", open - name.len() + 1),
        None if named.is_empty() || is_set_name(named) => " ".repeat(open + 1),
        None => return None,
    };
    Some(format!("{start}{inside}"))
}

/// Whether a set is called by what stands before it: `S =`, `\mathbb{L} =`.
fn is_set_name(before: &str) -> bool {
    let name = before.strip_suffix('=').map(str::trim_end);
    matches!(name, Some("S" | "L" | "\\mathbb{L}" | "\\mathbb L" | "𝕃"))
}

/// The condition in `x | x > 3`, `x \mid x > 3` and `x ∈ ℝ : x > 3`.
fn behind_bar(inside: &str) -> Option<&str> {
    const NUMBERS: [&str; 4] = ["R", "ℝ", "\\mathbb R", "\\R"];
    let (name, condition) = ["\\mid", ":", "|"]
        .iter()
        .find_map(|bar| inside.split_once(*bar))?;
    let set = ["∈", "\\in"].iter().find_map(|sign| name.split_once(*sign));
    let (name, real) = set.map_or((name, true), |(name, of)| {
        (name, NUMBERS.contains(&of.trim()))
    });
    let name = name.trim();
    let first = name.starts_with(|c: char| c.is_alphabetic() || c == '\\');
    let plain = |c: char| c.is_alphanumeric() || "_\\{}".contains(c);
    let again = condition.contains(name) && condition.contains(['<', '>', '≤', '≥', '=', '\\']);
    (real && first && name.chars().all(plain) && again).then_some(condition)
}

/// Equations below each other behind a brace, with blanks for what lays them out, byte for byte.
pub(super) fn below_each_other(text: &str) -> Option<String> {
    const FRAMES: [[&str; 2]; 3] = [
        ["\\begin{cases}", "\\end{cases}"],
        ["\\left\\{\\begin{array}{l}", "\\end{array}\\right."],
        ["\\left\\{\\begin{aligned}", "\\end{aligned}\\right."],
    ];
    let around = |c: char| c.is_whitespace() || c == '$';
    let inside = |[open, close]: &[&str; 2]| {
        let inside = text.trim_matches(around).strip_prefix(open)?;
        inside.strip_suffix(close)
    };
    let inside = FRAMES.iter().find_map(inside)?;
    let mut marks = inside.split('&').skip(1);
    let aligned = marks.all(|behind| {
        behind
            .trim_start()
            .starts_with(['=', '<', '>', '≤', '≥', '\\'])
    });
    let start = text.find(inside)?;
    let end = text.len() - start - inside.len();
    aligned.then(|| format!("{:start$}{}{:end$}", "", inside.replace('&', " "), ""))
}

/// Environments whose lines follow each other.
const LINES: [&str; 7] = [
    "aligned", "align*", "align", "gathered", "gather*", "gather", "split",
];

/// A line of LaTeX without what lays it out before it.
fn bare(line: &str) -> &str {
    line.trim_start_matches(|c: char| c.is_whitespace() || c == '&')
}

/// Whether a line goes on from the one above: it begins with a sign, or it is the last and empty.
pub(super) fn goes_on(rest: &str) -> bool {
    const SIGNS: &str = "=|+|-|−|<|>|≤|≥|≈|·|\\end|\\le|\\ge|\\approx|\\simeq|\\times|\\cdot|\\pm|\\quad|\\qquad|\\Rightarrow|\\implies|$";
    let line = bare(rest);
    line.is_empty() || SIGNS.split('|').any(|sign| line.starts_with(sign))
}

/// The last of several equations in the lines of an environment, with blanks for the rest, byte for byte: each says what follows
/// from those above. Nothing where lines are no equations, or two of them are about the same name.
pub(super) fn last_equation(text: &str) -> Option<String> {
    let (name, from) = LINES.iter().find_map(|name| {
        let open = format!("\\begin{{{name}}}");
        Some((name, text.find(&open)? + open.len()))
    })?;
    let to = from + text[from..].find(&format!("\\end{{{name}}}"))?;
    let around = |c: char| c.is_whitespace() || "$\\[].".contains(c);
    let begin = from - name.len() - "\\begin{}".len();
    let closed = to + "\\end{}".len() + name.len();
    if !text[..begin].trim_matches(around).is_empty()
        || !text[closed..].trim_matches(around).is_empty()
    {
        return None;
    }
    let mut starts = vec![from];
    let breaks = text[from..to]
        .match_indices("\\\\")
        .map(|(at, _)| from + at + 2);
    starts.extend(breaks.filter(|at| !goes_on(&text[*at..to])));
    let ends = starts[1..].iter().map(|at| at - 2).chain([to]);
    let left = |(start, end): (usize, usize)| {
        let (left, _) = text[start..end].split_once('=')?;
        Some(left.replace('&', "").trim().to_string())
    };
    let lefts: Vec<String> = starts
        .iter()
        .copied()
        .zip(ends)
        .map(left)
        .collect::<Option<_>>()?;
    let last = *starts.last()?;
    let apart = (1..lefts.len()).all(|i| !lefts[..i].contains(&lefts[i]));
    let line = text[last..to].replace('&', " ");
    (starts.len() > 1 && apart).then(|| format!("{:last$}{line}", ""))
}

/// A text of several lines with signs between them, as `x = 1, y = 2` has.
pub(crate) fn lines_apart(text: &str) -> Option<String> {
    let text = text.trim();
    let framed = |name: &str| {
        let inside = text.strip_prefix(&format!("\\begin{{{name}}}"))?;
        inside.strip_suffix(&format!("\\end{{{name}}}"))
    };
    if let Some(inside) = LINES.iter().find_map(|n| framed(n)) {
        return Some(inside.replace('&', " "));
    }
    let lines = text.lines().map(str::trim);
    // What leads to a list ends in a colon.
    let items =
        lines.filter(|line| !line.is_empty() && (!line.ends_with(':') || line.contains('=')));
    let lines: Vec<&str> = items
        .map(|line| unlisted(line, line.contains('=')))
        .collect();
    (lines.len() > 1).then(|| lines.join("; "))
}
