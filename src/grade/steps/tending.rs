//! What a worked solution says of limits: `For M ≫ m, u → v`, `u → 0 as M → ∞`, `\lim_{M\to\infty} u = 0`, `For large M: …`.

use super::cause::MOST_STEPS;
use super::desk::all_of;
use super::link::Link;
use super::link::Values;
use super::{Desk, Status, text};
use crate::answer::limit;
use crate::equality;
use crate::expr::{Expr, Symbol, effort};
use crate::formula;
use crate::scene::Ask;

/// Signs and words as they are typed, and the sign that stands for them below.
const SPELT: &str = "$||\\rightarrow|→|\\to|→|->|→| tends to | → | tend to | → | approaches | → | goes to | → |\
    \\infty|∞|infinity|∞|→ inf|→ ∞|→inf|→∞|→ zero|→ 0|\\gg|≫|>>|≫|\\ll|≪|<<|≪|\\approx|≈|\\lim|lim|\
     is much larger than | ≫ | is much greater than | ≫ | is much heavier than | ≫ |\
     is much smaller than | ≪ | is much less than | ≪ | is much lighter than | ≪ ";

/// What parts the condition from what holds under it.
const PARTING: &str =
    ", |: | then | we get | we find | we have | gives | as | when | for | if | in the limit ";

/// Words for what grows beyond all bounds, and for what vanishes.
const GROWING: [&str; 3] = ["large", "heavy", "big"];
const FADING: [&str; 3] = ["small", "light", "tiny"];

/// A parameter, and the value it comes to; `None` beyond all bounds.
type Goes = (Symbol, Option<Expr>);

/// A line with one sign for whatever is typed for it.
fn in_signs(line: &str) -> String {
    let spelt: Vec<&str> = SPELT.split('|').collect();
    let mut pairs = spelt.chunks(2);
    let line = pairs.try_fold(line.to_string(), |line, pair| {
        let [typed, sign] = pair else {
            return Err(line);
        };
        Ok(line.replace(typed, sign))
    });
    line.unwrap_or_else(|line| line)
}

/// Whether a line speaks of what something tends to.
fn tends(text: &str) -> bool {
    const PHRASES: &str = "≫|≪|very large|very small|very heavy|very light|for large|for small";
    const WORDS: [&str; 4] = ["lim", "limit", "tends", "approaches"];
    // An arrow to a lone zero, and not to the equation `0 = …`.
    let is_end = |to: &str| {
        let to = to.trim_start().trim_start_matches(['+', '-', '−']);
        let zero = to.strip_prefix('0').map(str::trim_start);
        to.starts_with(['∞'])
            || zero.is_some_and(|behind| {
                !behind.starts_with(|c: char| c.is_alphanumeric() || "=.^*/+-−<>".contains(c))
            })
    };
    let mut words = text.split(|c: char| !c.is_ascii_alphabetic());
    text.split('→').skip(1).any(is_end)
        || PHRASES
            .split('|')
            .any(|phrase| text.to_lowercase().contains(phrase))
        || words.any(|word| WORDS.iter().any(|w| word.eq_ignore_ascii_case(w)))
}

/// The last word of a text, and its first.
fn last(text: &str) -> &str {
    let word = text.split_whitespace().next_back().unwrap_or_default();
    word.trim_matches(['(', ')', ',', '.', ':'])
}

fn first(text: &str) -> &str {
    let word = text.split_whitespace().next().unwrap_or_default();
    word.trim_matches(['(', ')', ',', '.', ':'])
}

impl Desk<'_> {
    /// Whether what a line says of a limit is so, where it does not hold as it stands; words where that cannot be told.
    pub(super) fn in_limit(&mut self, line: &str) -> Option<Status> {
        let signs = in_signs(line);
        if !tends(&signs) && !tends(line) {
            return None;
        }
        let equations = text::equations(line).into_iter();
        let links: Option<Vec<Link>> = self.links_of(equations);
        let hold = |links: &Vec<Link>| links.iter().all(|link| self.holds(link));
        if links.is_some_and(|links| !links.is_empty() && hold(&links)) {
            return None;
        }
        let Some((goes, links)) = self.parted(&signs) else {
            return Some(Status::Comment);
        };
        // What is asked as a limit is judged as an answer.
        let asked = links.first().and_then(|link| link.sides[0].name());
        if let Some(Ask::Limit { .. }) = asked.and_then(|name| self.ask(name)) {
            return None;
        }
        let so = |instead: &Values| {
            let each = links.iter();
            all_of(each.map(|link| self.tend_together(link, &goes, instead)))
        };
        let status = effort::within(MOST_STEPS, || self.found(so, Status::Comment));
        self.note_limit(line, &goes, &links);
        Some(status)
    }

    /// Keeps `M ≫ m: H = 9h` as an answer where this limit is asked for.
    fn note_limit(&mut self, line: &str, goes: &[Goes], links: &[Link]) {
        let ([first, ..], [.., last]) = (links, links) else {
            return;
        };
        let (of, value) = (first.sides[0].expr(), last.sides[1].expr());
        let mut questions = self.sheet.scene.questions.iter();
        let asked = questions.find(|q| match &q.ask {
            Ask::Limit {
                of: asked,
                parameter,
                to,
            } => {
                of == Some(asked)
                    && goes
                        .iter()
                        .any(|(name, end)| name == parameter && end == to)
            }
            _ => false,
        });
        let right = asked.and_then(|q| Some((q, self.closed.get(q.name.as_str())?)));
        if let (Some((asked, right)), Some(value)) = (right, value) {
            let verdict = self.all_zero(&[value - right], &Values::new()).into();
            self.give(asked.name.clone(), line, verdict);
        }
    }

    fn links_of<'t>(&self, equations: impl Iterator<Item = &'t str>) -> Option<Vec<Link>> {
        let mut all = Vec::new();
        for equation in equations {
            let reading = formula::read(equation, &self.symbols(equation)).ok()?;
            all.extend(self.links(&reading)?);
        }
        Some(all)
    }

    /// What a line says goes where, and what is equal there: the one condition in it, and all that stands beside it.
    fn parted(&self, line: &str) -> Option<(Vec<Goes>, Vec<Link>)> {
        let signs = PARTING.split('|');
        let pieces = signs.fold(vec![line], |pieces, sign| {
            let parts = pieces.into_iter().flat_map(|piece| piece.split(sign));
            parts.collect()
        });
        let limit = line
            .split_once("lim_{")
            .and_then(|(_, rest)| rest.split_once('}'));
        let pieces = limit.map_or(pieces, |(place, said)| vec![place, said]);
        let (places, said): (Vec<_>, Vec<_>) = pieces
            .into_iter()
            .map(|piece| (piece, self.place(piece)))
            .partition(|(_, place)| place.is_some());
        let [(_, Some(goes))] = &places[..] else {
            return None;
        };
        let said = said.iter().map(|(piece, _)| {
            let piece = piece.trim_start_matches([' ', '→', '⇒']);
            piece.replace('→', "=")
        });
        let said: Vec<String> = said.collect();
        let equations = said.iter().flat_map(|piece| text::equations(piece));
        let links = self.links_of(equations)?;
        (!links.is_empty()).then(|| (goes.clone(), links))
    }

    /// The condition of a limit: `M ≫ m` for M beyond all bounds or m to nothing, `θ → π/2`, `m/M → 0`, `for large M`.
    fn place(&self, text: &str) -> Option<Vec<Goes>> {
        let read = |text: &str| formula::read(text, &self.symbols(text)).ok();
        let parameter = |text: &str| {
            let names = read(text)?.expr()?.symbols();
            let mut names = names.into_iter();
            let name = names.next().filter(|_| names.next().is_none())?;
            self.sheet.scene.parameter(&name).map(|p| p.name.clone())
        };
        let above = |large: &str, small: &str| {
            let zero = Some(Expr::zero());
            Some(vec![(parameter(large)?, None), (parameter(small)?, zero)])
        };
        if let Some((large, small)) = text.split_once('≫') {
            return above(last(large), first(small));
        }
        if let Some((small, large)) = text.split_once('≪') {
            return above(first(large), last(small));
        }
        if let Some((name, end)) = text.split_once('→') {
            let (name, end) = (last(name), end.trim().trim_end_matches(['.', ',']));
            let beyond = end.trim_start_matches('+').starts_with('∞');
            let end = || read(end.trim_end_matches(['+', '⁺', '^']))?.expr().cloned();
            return match name.split_once('/') {
                Some((a, b)) if beyond => above(a, b),
                Some((a, b)) => end()?.is_zero().then(|| above(b, a))?,
                None => {
                    let alone = read(name)?.expr()?.as_symbol().is_some();
                    let name = parameter(name).filter(|_| alone)?;
                    let end = if beyond { None } else { Some(end()?) };
                    Some(vec![(name, end)])
                }
            };
        }
        let words = || text.split_whitespace().map(first);
        let has = |known: &[&str]| words().any(|word| known.contains(&word));
        let end = match (has(&GROWING), has(&FADING)) {
            (true, false) => None,
            (false, true) => Some(Expr::zero()),
            _ => return None,
        };
        let mut named = words().filter_map(parameter);
        let name = named.next().filter(|_| !text::relates(text))?;
        named.next().is_none().then(|| vec![(name, end)])
    }

    /// Whether both sides tend to the same in one of the ways that a condition may mean; `None` where that is not known of all.
    fn tend_together(&self, link: &Link, goes: &[Goes], instead: &Values) -> Option<bool> {
        let [a, b] = link
            .sides
            .each_ref()
            .map(|side| Some(self.put_in(side.expr()?, instead)));
        let (a, b) = (a?, b?);
        let domains = &self.sheet.scene.domains;
        let ways = goes
            .iter()
            .filter(|(name, to)| limit::comes(name, to.as_ref(), domains))
            .map(|(name, to)| self.tends_as(&a, &b, name, to.as_ref()));
        let mut ways = ways.map(|so| so.map(|so| !so)).peekable();
        ways.peek()?;
        all_of(ways).map(|none| !none)
    }

    /// Whether two formulas tend to the same value, or vanish or grow alike: `u ≈ m v/M` for M beyond all bounds.
    fn tends_as(&self, a: &Expr, b: &Expr, name: &Symbol, to: Option<&Expr>) -> Option<bool> {
        let domains = &self.sheet.scene.domains;
        let same = |a: &Expr, b: &Expr| equality::decide(a, b, domains).equality.holds();
        let end = |e: &Expr| limit::of(e, name, to, domains);
        let zero = Expr::zero();
        let is_zero = |e: &Expr| same(e, &zero);
        let nothing = is_zero(a)? || is_zero(b)?;
        match (end(a)?, end(b)?) {
            (Some(a), Some(b)) if nothing || !(is_zero(&a)? && is_zero(&b)?) => same(&a, &b),
            _ if nothing => Some(false),
            _ => end(&(a / b))?.map_or(Some(false), |share| same(&share, &Expr::one())),
        }
    }
}
