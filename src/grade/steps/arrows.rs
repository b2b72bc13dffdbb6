//! How a page writes its vectors: bold letters, moments in words and letters of other books, as the arrows and marks that are
//! read.

use std::collections::BTreeSet;

use super::pages::is_heading;
use super::text::relates;
use crate::formula::{among, closing};
use crate::scene::Scene;

/// A vector in a line, by the bytes it takes.
struct Arrow {
    from: usize,
    /// The end of its letter and index, where a mark may be put.
    to: usize,
    /// The end with what is raised.
    end: usize,
    letter: String,
    index: String,
    raised: String,
}

/// Moments in words, and the marks for them.
const MOMENTS: [(&str, &str); 2] = [("before", "^{-}"), ("after", "^{+}")];

/// What a moment is before or after.
const EVENTS: &str = "impact collision blow bounce hit hits contact shock strike strikes bump catch landing jerk explosion crash";

/// Letters that are vectors where they are bold.
const BOLD: [&str; 10] = ["v", "\\omega", "r", "H", "P", "L", "J", "p", "n", "u"];

/// The argument of a command: a group in braces, a command or a character; its text, and where it ends.
fn argument(text: &str, at: usize) -> Option<(&str, usize)> {
    let rest = text.get(at..)?;
    let start = at + rest.len() - rest.trim_start_matches(' ').len();
    let rest = &text[start..];
    let c = rest.chars().next()?;
    if c == '{' {
        let end = start + closing(rest.as_bytes())?;
        return Some((text[start + 1..end].trim(), end + 1));
    }
    let letters = rest[c.len_utf8()..].find(|c: char| !c.is_ascii_alphabetic());
    let length = match c {
        '\\' => 1 + letters.unwrap_or(rest.len() - 1),
        _ => c.len_utf8(),
    };
    Some((&rest[..length], start + length))
}

/// The places of a command, without those of longer ones.
fn places<'t>(text: &'t str, command: &'t str) -> impl Iterator<Item = usize> + 't {
    let all = text.match_indices(command).map(|(at, _)| at);
    all.filter(move |at| !text[at + command.len()..].starts_with(|c: char| c.is_ascii_alphabetic()))
}

/// A word in its font, as `\text{before}`.
fn plain(word: &str) -> &str {
    let fonts = ["\\text{", "\\mathrm{", "\\textrm{", "\\rm{"];
    let inside = fonts.iter().find_map(|font| word.strip_prefix(font));
    inside
        .and_then(|word| word.strip_suffix('}'))
        .unwrap_or(word)
}

/// The vectors of a line.
fn arrows(line: &str) -> Vec<Arrow> {
    let at = |from: usize| {
        let (name, mut to) = argument(line, from + "\\vec".len())?;
        let (letter, mut index) = name.split_once('_').unwrap_or((name, ""));
        let behind = |at: usize| line[at..].trim_start_matches(' ');
        if let Some(rest) = behind(to).strip_prefix('_') {
            (index, to) = argument(line, line.len() - rest.len())?;
        }
        let mut end = to;
        if let Some(rest) = behind(to).strip_prefix('^') {
            end = argument(line, line.len() - rest.len())?.1;
        }
        while let Some(c) = line[end..].chars().next().filter(|c| "'′".contains(*c)) {
            end += c.len_utf8();
        }
        let index = index.trim_start_matches('{').to_string();
        Some(Arrow {
            from,
            to,
            end,
            letter: letter.trim().to_string(),
            index: plain(&index).to_string(),
            raised: match name.contains(['^', '\'']) {
                true => name.to_string(),
                false => line[to..end].trim().to_string(),
            },
        })
    };
    places(line, "\\vec").filter_map(at).collect()
}

/// A line with pieces of it by others, from the first on.
fn replaced(line: &str, pieces: impl IntoIterator<Item = (usize, usize, String)>) -> String {
    let (mut out, mut at) = (String::new(), 0);
    for (from, to, with) in pieces {
        if from >= at {
            out.extend([&line[at..from], &*with]);
            at = to;
        }
    }
    out + &line[at..]
}

/// A line with a mark behind the velocities, spins and angular momenta without one that are meant, by letter and index.
pub(super) fn with_mark(line: &str, mark: &str, meant: &dyn Fn(&str, &str) -> bool) -> String {
    let all = arrows(line).into_iter();
    let meant = all.filter(|a| is_of_moment(a) && meant(&a.letter, &a.index));
    replaced(line, meant.map(|a| (a.to, a.to, mark.to_string())))
}

/// Whether it is another vector before an impact than after, and has no mark.
fn is_of_moment(arrow: &Arrow) -> bool {
    ["v", "\\omega", "H"].contains(&&*arrow.letter) && arrow.raised.is_empty()
}

/// Letters and indices of the vectors that a page writes with a prime: without one they may be those before.
pub(super) fn primed(text: &str) -> BTreeSet<(String, String)> {
    let all = text.lines().flat_map(arrows);
    let primed = all.filter(|a| a.raised.starts_with(['\'', '′']));
    primed.map(|a| (a.letter, a.index)).collect()
}

/// A solution with all its vectors as letters with arrows, and with marks for the moments that it tells in words.
pub(super) fn spelled(text: &str, scene: &Scene) -> String {
    let signs = "\\vec|\\mathbf|\\boldsymbol|\\bm|\\overrightarrow";
    if !signs.split('|').any(|sign| text.contains(sign)) {
        return text.to_string();
    }
    let text = own_hats(&from_bold(&text.replace("\\overrightarrow", "\\vec")));
    let is_momentum = |line: &str| {
        let (left, right) = line.split_once('=').unwrap_or((line, ""));
        let turns = [
            "\\times", "×", "\\omega", "\\hat k", "\\hat{k}", "\\vec L", "\\vec{L}",
        ];
        arrows(left).iter().any(|a| a.letter == "L")
            && !turns.iter().any(|sign| right.contains(sign))
    };
    let momentum = text.lines().any(is_momentum);
    let asked = |letter: &str, index: &str| {
        let name = format!("{letter}{index}");
        let same = |q: &str| q.replace('_', "") == name.replace('_', "");
        scene.questions.iter().any(|q| same(&q.name))
    };
    let letters = |line: &str| {
        let all = arrows(line).into_iter();
        let other = all.filter_map(|a| Some((a.from, a.end, in_letters(&a, momentum, &asked)?)));
        replaced(line, other)
    };
    let mut heading = None;
    let lines = text.lines().map(|line| {
        let line = letters(line);
        if !relates(&line) {
            let found = moments(line.trim_start_matches(['#', '*', ' ']));
            let heads = is_heading(&line) || line.ends_with(':') && !line.contains(['$', '\\']);
            if !line.trim().is_empty() {
                heading = Some(found).filter(|found| heads && found.len() == 1);
            }
            return line;
        }
        match &heading {
            Some(said) if moments(&line).is_empty() => with_mark(&line, said[0].2, &|_, _| true),
            _ => with_moments(&line),
        }
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// Bold letters with arrows, where a line of the page has several of them or multiplies them.
fn from_bold(text: &str) -> String {
    let bold = |line: &str| {
        let fonts = ["\\mathbf", "\\boldsymbol", "\\bm"];
        let all = fonts.iter().flat_map(|font| {
            let at = places(line, font).filter(|at| {
                let before = line[..*at].trim_end_matches([' ', '{']);
                !before.ends_with("\\vec") && !before.ends_with("\\hat")
            });
            at.filter_map(move |at| Some((at, argument(line, at + font.len())?)))
        });
        let mut all: Vec<_> = all
            .map(|(at, (name, end))| (at, end, name.to_string()))
            .collect();
        all.sort();
        all
    };
    let multiplies = |line: &str| {
        ["\\times", "\\hat", "\\cdot"]
            .iter()
            .any(|s| line.contains(s))
    };
    let in_vectors = |line: &str| {
        let found = bold(line).len();
        found > 1 || found > 0 && multiplies(line)
    };
    let has_bold = text.lines().any(in_vectors);
    let line = |line: &str| {
        let all = bold(line).into_iter().filter_map(|(from, to, name)| {
            let letter = name.split('_').next().unwrap_or_default();
            let as_read = match letter {
                "0" => String::from("0"),
                "e" => format!("\\hat{{{name}}}"),
                _ if BOLD.contains(&letter) => format!("\\vec{{{name}}}"),
                _ => return None,
            };
            Some((from, to, as_read))
        });
        replaced(line, all)
    };
    match has_bold {
        true => text.lines().map(line).collect::<Vec<_>>().join("\n"),
        false => text.to_string(),
    }
}

/// Unit vectors with hats: those that the page says itself are vectors of its own, another n̂ is the normal of the scene.
fn own_hats(text: &str) -> String {
    let is_axis = |name: &str| {
        let name = name.trim_start_matches('\\');
        ["i", "j", "k", "x", "y", "z", "imath", "jmath"].contains(&name)
    };
    let hats = |line: &str| -> Vec<(usize, usize, String)> {
        let all = places(line, "\\hat");
        let all = all.filter_map(|at| {
            let (name, end) = argument(line, at + "\\hat".len())?;
            (!is_axis(name)).then(|| (at, end, name.to_string()))
        });
        all.collect()
    };
    let own: BTreeSet<String> = (text.lines())
        .filter_map(|line| {
            let line = line.trim_start_matches([' ', '$']);
            let (at, end, name) = hats(line).into_iter().next()?;
            let alone = at == 0 && line[end..].trim_start().starts_with(['=', '_']);
            (alone && line.contains('=')).then_some(name)
        })
        .collect();
    let line = |line: &str| {
        let all = hats(line).into_iter().filter_map(|(from, to, name)| {
            let letter = match (&*name, own.contains(&name)) {
                ("n", true) => "\\nu",
                (_, true) | ("n", false) => &name,
                _ => return None,
            };
            Some((from, to, format!("\\vec{{{letter}}}")))
        });
        replaced(line, all)
    };
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// A vector as it is read: `\vec{v}_{G,before}` with its mark, `\vec{CB}` as the place of B from C, L of a point as H and J as P
/// where the scene asks for none of this name, and nothing for a vector 0.
fn in_letters(arrow: &Arrow, momentum: bool, asked: &dyn Fn(&str, &str) -> bool) -> Option<String> {
    let (mut letter, mut index) = (&*arrow.letter, arrow.index.clone());
    let mut raised = arrow.raised.clone();
    if letter == "0" && index.is_empty() {
        return Some(String::from("0"));
    }
    if let [a, b] = letter.as_bytes()
        && [a, b].iter().all(|c| c.is_ascii_uppercase())
        && index.is_empty()
    {
        return Some(format!(
            "\\vec{{r}}_{{{}/{}}}",
            char::from(*b),
            char::from(*a)
        ));
    }
    for (word, mark) in MOMENTS {
        let stem = match index.rsplit_once(',') {
            Some((stem, last)) => (plain(last.trim()) == word).then(|| stem.trim().to_string()),
            None => (index == word).then(String::new),
        };
        let above = raised.strip_prefix('^').map(str::trim);
        let above = above.map(|above| above.trim_start_matches('{'));
        if let Some(stem) = stem {
            (index, raised) = (stem, mark.to_string());
        } else if above.is_some_and(|a| plain(a).trim_end_matches('}') == word) {
            raised = mark.to_string();
        }
    }
    let free = !index.is_empty() && !asked(letter, &index);
    match letter {
        "L" if free && !momentum => letter = "H",
        "J" if free => letter = "P",
        _ => {}
    }
    let same = letter == arrow.letter && index == arrow.index && raised == arrow.raised;
    let index = match index.is_empty() {
        true => index,
        false => format!("_{{{index}}}"),
    };
    (!same).then(|| format!("\\vec{{{letter}}}{index}{raised}"))
}

/// The moments that a line tells in words: where these begin and end, and the mark.
fn moments(line: &str) -> Vec<(usize, usize, &'static str)> {
    let lower = line.to_ascii_lowercase();
    let mut found = Vec::new();
    for (word, mark) in MOMENTS {
        for (at, _) in lower.match_indices(word) {
            let end = at + word.len();
            let apart = lower[..at].is_empty() || lower[..at].ends_with([' ', '(', '*', '_']);
            let rest = &lower[end..];
            let mut words = rest.split(' ').skip(1).take(4);
            let closed = rest.trim_start().is_empty()
                || rest
                    .trim_start()
                    .starts_with([':', ',', ')', '.', ';', '$', '=', '\\', '*']);
            let is_event =
                |w: &str| among(EVENTS, w.trim_end_matches(|c: char| !c.is_alphabetic()));
            let event = words.position(is_event);
            let to = match event {
                Some(k) if rest.starts_with(' ') => {
                    let said: Vec<&str> = rest.split(' ').take(k + 2).collect();
                    end + said
                        .join(" ")
                        .trim_end_matches(|c: char| !c.is_alphabetic())
                        .len()
                }
                _ => end,
            };
            let simple = lower[end..to]
                .chars()
                .all(|c| c.is_alphabetic() || c == ' ');
            if apart && simple && (closed || to > end) {
                let leads = ["just", "immediately", "right", "shortly"].into_iter();
                let before = lower[..at].trim_end();
                let lead = leads.filter_map(|lead| before.strip_suffix(lead)).next();
                let from = lead.map_or(at, str::len);
                found.push((from, to, mark));
            }
        }
    }
    found.sort_unstable();
    found
}

/// A line with marks for moments that it tells in words, before its vectors or behind them; as it is where they say different
/// ones of the same.
fn with_moments(line: &str) -> String {
    let (said, all) = (moments(line), arrows(line));
    let (Some(first), Some(vector)) = (said.first(), all.first()) else {
        return line.to_string();
    };
    let between = |a: usize, b: usize| all.iter().any(|v| (a..b).contains(&v.from));
    let mixed = said
        .windows(2)
        .any(|pair| pair[0].2 != pair[1].2 && !between(pair[0].0, pair[1].0));
    if mixed {
        return line.to_string();
    }
    let leads = first.0 < vector.from;
    let marks = all.iter().filter(|v| is_of_moment(v)).filter_map(|v| {
        let of = match leads {
            true => said.iter().rev().find(|m| m.0 < v.from),
            false => said.iter().find(|m| m.0 >= v.from),
        };
        Some((v.to, v.to, of?.2.to_string()))
    });
    let words = said.iter().filter(|_| !leads).map(|(from, to, _)| {
        let open = line[..*from].trim_end().ends_with('(');
        let close = line[*to..].starts_with(')');
        match open && close {
            true => (
                line[..*from].rfind('(').unwrap_or(*from),
                to + 1,
                String::new(),
            ),
            false => (*from, *to, String::new()),
        }
    });
    let mut pieces: Vec<_> = marks.chain(words).collect();
    pieces.sort();
    replaced(line, pieces)
}
