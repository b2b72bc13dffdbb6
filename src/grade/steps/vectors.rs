//! The vectors that a page names with arrows: which of an impact's they are, and what a line in them says.
//!
//! One without a mark is just before where the same letter stands beside it with the mark of the moment after, else just after
//! or, with a remark, just before.

use std::collections::{BTreeMap, BTreeSet};

use super::super::believed::Story;
use super::Desk;
use super::impact::{Impact, Stand, impacts, shared_key};
use super::letters::readings;
use super::link::Values;
use super::link::{Link, gaps, names_in};
use crate::expr::{Expr, Node, Symbol};
use crate::formula::{self, Content, Reading, Symbols};

/// Most vectors that a page may name.
const MOST_VECTORS: usize = 60;

/// The vector with an arrow that a name is, or is a component of.
fn arrowed(name: &Symbol) -> Option<Symbol> {
    let axes = ["_x", "_y", "_z"];
    let stem = axes.iter().find_map(|axis| name.strip_suffix(axis));
    let whole = stem.filter(|_| formula::is_component(name));
    let whole = whole.map(Symbol::from);
    whole.or_else(|| formula::has_arrow(name).then(|| name.clone()))
}

/// Letters of vectors of which one has the mark of the moment after and none that of the moment before.
pub(super) fn marked_after(text: &str) -> BTreeSet<String> {
    let reading = text
        .contains("vec")
        .then(|| formula::read(text, &Symbols::open()));
    let Some(Ok(reading)) = reading else {
        return BTreeSet::new();
    };
    let arrows = reading.symbols().into_iter();
    let names: Vec<_> = arrows
        .filter_map(|name| formula::vector_name(arrowed(&name)?.as_ref()))
        .collect();
    let after = names
        .iter()
        .filter(|(.., mark)| ["'", "^+"].contains(&&**mark));
    let before = |base: &String| names.iter().any(|(b, _, mark)| b == base && mark == "^-");
    let after = after.map(|(base, ..)| base.clone());
    after
        .filter(|base| ["v", "omega", "H"].contains(&&**base) && !before(base))
        .collect()
}

/// Whether a vector without a mark has a letter of these.
pub(super) fn is_marked(letters: &BTreeSet<String>, name: &str) -> bool {
    let unmarked = formula::vector_name(name).filter(|(.., mark)| mark.is_empty());
    unmarked.is_some_and(|(base, ..)| letters.contains(&base))
}

/// Whether a name with an arrow stands in a product of vectors, rather than alone left of a sign of equality.
pub(super) fn in_products(text: &str) -> impl Fn(&str) -> bool {
    let signs = ["×", "\\times", "·", "\\cdot"];
    let multiplied = signs.iter().any(|sign| text.contains(sign));
    let left = text.split('=').next().filter(|_| multiplied);
    let left = left.filter(|left| !signs.iter().any(|sign| left.contains(sign)));
    let left = left.and_then(|left| formula::read_name(left, &Symbols::open()));
    let left = left.and_then(|left| formula::vector_name(&left));
    let alone = left.map(|(base, index, _)| (base, index));
    move |name| {
        let here = || formula::vector_name(name).map(|(base, index, _)| (base, index));
        multiplied && (alone.is_none() || alone != here())
    }
}

/// Whether a form is a sum of multiples of what `is_one` says are vectors.
fn is_vector(e: &Expr, is_one: &impl Fn(&Symbol) -> bool) -> bool {
    match e.node() {
        Node::Symbol(name) => is_one(name),
        Node::Sum(_) => e.terms().iter().all(|term| is_vector(term, is_one)),
        Node::Product(factors) => {
            let (vectors, others): (Vec<&Expr>, Vec<&Expr>) =
                factors.iter().partition(|factor| is_vector(factor, is_one));
            vectors.len() == 1 && !others.iter().any(|e| e.symbols().iter().any(is_one))
        }
        _ => false,
    }
}

impl Desk<'_> {
    /// `v1·v2` with arrows, where both are vectors that are asked for.
    pub(super) fn with_arrows_at_dots(&self, text: &str) -> Option<String> {
        let symbols = self.symbols("");
        let arrowed = |word: &str| {
            let name = formula::read_name(word, &symbols)?;
            let mut asked = self.sheet.scene.questions.iter();
            asked.find(|q| *q.name == *name && !self.closed.contains_key(&name))?;
            self.components(&name)?;
            let latex = formula::latex_name(&name);
            let (base, index) = latex.split_at(latex.find(['_', '^']).unwrap_or(latex.len()));
            Some(format!("\\vec{{{base}}}{index}"))
        };
        let ends = |c: char| !(c.is_alphanumeric() || c == '_');
        let dot = ["·", "\\cdot "]
            .into_iter()
            .find(|dot| text.contains(dot))?;
        let (before, behind) = text.split_once(dot)?;
        let (before, behind) = (before.trim_end(), behind.trim_start());
        let start = before.rfind(ends).map_or(0, |at| {
            at + before[at..].chars().next().map_or(1, char::len_utf8)
        });
        let end = behind.find(ends).unwrap_or(behind.len());
        let [left, right] = [&before[start..], &behind[..end]].map(arrowed);
        Some(format!(
            "{}{} \\cdot {}{}",
            &before[..start],
            left?,
            right?,
            &behind[end..]
        ))
    }

    /// The vectors that a solution names, where the scene has a value for them: as it goes first, and at other moments and of
    /// other systems.
    pub(super) fn know_vectors(&mut self, text: &str) {
        let sheet = self.sheet;
        let asked = sheet.scene.questions.iter().map(|q| q.name.as_str());
        let asked: Vec<_> = asked
            .filter_map(|name| Some((formula::with_arrow(name)?, self.components(name)?)))
            .collect();
        for (arrow, vector) in asked {
            let along = formula::along_axes(&arrow).into_iter().zip(vector);
            self.parts.extend(along);
        }
        let readings = readings(sheet, text);
        let used = readings.iter().flat_map(Reading::symbols);
        let symbols = self.symbols(text);
        // Places and spins are others at other moments, though the scene has names for them.
        let read_as = |name: Symbol| {
            let found = formula::read_name(&formula::latex_name(&name), &symbols);
            let (base, ..) = formula::vector_name(&name)?;
            let changes = ["r", "omega"].contains(&&*base);
            match found {
                None => Some((name.clone(), name)),
                Some(found) => (changes && formula::has_arrow(&found)).then_some((name, found)),
            }
        };
        let names: BTreeSet<Symbol> = used.filter_map(|name| arrowed(&name)).collect();
        // Beside `v'` a v without a mark is the one before, and H may be the same at both moments.
        let before = names.iter().flat_map(|name| {
            let (base, _, mark) = formula::vector_name(name).unwrap_or_default();
            let stem = name.trim_end_matches(&*mark);
            let marks: &[&str] = match (&*base, &*mark) {
                ("v" | "omega", "") => &["^-"],
                ("H", _) => &["^-", "^+"],
                _ => &[],
            };
            marks
                .iter()
                .map(move |mark| Symbol::from(format!("{stem}{mark}")))
        });
        let names: BTreeSet<Symbol> = before.chain(names.iter().cloned()).collect();
        let names: Vec<(Symbol, Symbol)> = names.into_iter().filter_map(read_as).collect();
        if names.is_empty() || names.len() > MOST_VECTORS {
            return;
        }
        if sheet.story.is_none() || !sheet.impacts.is_empty() {
            self.know_impacts(&names);
        }
        for ((_, values), (_, scene)) in self.ends.iter_mut().zip(&sheet.ends) {
            let there = Impact::new(scene, "", Values::new()).of_a_motion(&names);
            for (name, value) in &there {
                let told = self.parts.entry(name.clone());
                told.or_insert_with(|| value.clone());
            }
            values.extend(there);
        }
    }

    /// The vectors of all impacts by what they are read as.
    fn know_impacts(&mut self, names: &[(Symbol, Symbol)]) {
        let sheet = self.sheet;
        let known = self.closed.keys();
        let motion = known
            .map(|name| (name.clone(), Expr::symbol(name)))
            .collect();
        let first = Impact::new(&sheet.scene, "the impact", motion);
        for stand in first.moments(names) {
            for (name, value) in &stand.values {
                let told = self.parts.entry(name.clone());
                told.or_insert_with(|| value.clone());
            }
            for (shared, body) in &stand.of {
                self.first_of.entry(shared.clone()).or_insert(*body);
            }
            self.vectors.push(stand);
        }
        self.whatever = first.of_whatever_motion(names);
        let in_stages = impacts(sheet).into_iter();
        for impact in in_stages.filter(|_| sheet.story.is_some()) {
            for stand in impact.moments(names) {
                let all = impact.motion.clone().into_iter().chain(stand.values);
                let values = all.collect();
                self.vectors.push(Stand { values, ..stand });
            }
        }
    }

    /// Whether a line tells velocities and places in vectors, which may be of a moment in a motion, and not just of an impact by
    /// their marks.
    pub(super) fn is_of_a_motion(&self, links: &[Link]) -> bool {
        let names = Desk::arrows(links);
        let (mut moves, mut marked, mut any) = (!names.is_empty(), true, false);
        for name in &names {
            let Some((base, _, mark)) = formula::vector_name(name) else {
                continue;
            };
            let mark = ["^-", "^+"].contains(&&*mark);
            moves &= ["v", "r", "omega"].contains(&&*base);
            // The mark of a spin that is asked for is read off it.
            marked &= mark || base == "r" || self.spins.contains_key(name);
            any |= mark;
        }
        // Below the heading of a motion marks tell its ends; what is known there can be wrong.
        let told = match self.end_here() {
            Some(end) => self.knows(end, links),
            None => any,
        };
        let story = self.sheet.story.as_ref();
        story.is_some_and(Story::has_motions) && moves && !(marked && told)
    }

    /// Whether a line that fails holds at the end of the motion it stands in or, where that is not known, at some moment.
    pub(super) fn holds_there(&self, links: &[Link]) -> bool {
        let all = gaps(links);
        match self.end_here().filter(|end| self.knows(end, links)) {
            Some((_, values)) => self.vanish(&all, values),
            None => self.at_another_moment(links).is_some(),
        }
    }

    /// Whether all vectors of a line have values at the end of a motion.
    fn knows(&self, (_, values): &(String, Values), links: &[Link]) -> bool {
        Desk::arrows(links)
            .iter()
            .all(|name| self.spins.contains_key(name) || values.contains_key(&*format!("{name}_z")))
    }

    /// What is known of the end of the motion whose heading stands above, or of the only one where nothing collides.
    pub(super) fn end_here(&self) -> Option<&(String, Values)> {
        let lone = self.sheet.impacts.is_empty() && self.ends.len() == 1;
        let mut ends = self.ends.iter();
        ends.find(|(stage, _)| lone || self.under.as_ref() == Some(stage))
    }

    /// The vectors with arrows that a line names.
    fn arrows(links: &[Link]) -> BTreeSet<Symbol> {
        let names = names_in(links);
        names.iter().filter_map(arrowed).collect()
    }

    /// Whether a line says more than that nothing is nothing: one of the vectors in it does not vanish at a moment, none of the
    /// velocities without a mark vanishes beside others, since a term with it could be any, or it holds of whatever motion;
    /// with `all` none that has one either.
    pub(super) fn says_enough(&self, links: &[Link], values: &Values, all: bool) -> bool {
        let of_moment = |name: &Symbol, bases: &[&str]| {
            let named = formula::vector_name(name);
            named
                .filter(|(base, ..)| bases.contains(&&**base))
                .map(|(.., mark)| mark)
        };
        let vanishes = |name: &Symbol| {
            let along = formula::along_axes(name).map(|part| Expr::symbol(&part));
            self.vanish(&along, values)
        };
        let names = Desk::arrows(links);
        let bases = ["v", "omega", "H", "P"];
        let moving = names
            .iter()
            .filter(|name| of_moment(name, &bases).is_some());
        let (gone, left): (Vec<&Symbol>, Vec<&Symbol>) = moving.partition(|name| vanishes(name));
        let nothing = |side: &Content| match side {
            Content::Vector(v) => v.iter().all(Expr::is_zero),
            side => side.expr().is_some_and(Expr::is_zero),
        };
        let told = links.iter().any(|link| link.sides.iter().any(nothing));
        if left.is_empty() {
            return gone.len() < 2 || told;
        }
        let unmarked = |name: &&&Symbol| {
            of_moment(name, &bases[..2]).is_some_and(|mark| mark.is_empty() || all)
        };
        !gone.iter().any(|name| unmarked(&name)) || self.is_law(links)
    }

    /// Whether a line holds of whatever motion of all that moves, as H = r × m v + I ω does.
    fn is_law(&self, links: &[Link]) -> bool {
        self.whatever
            .first()
            .is_some_and(|all| self.is_law_of(links, all))
    }

    fn is_law_of(&self, links: &[Link], whatever: &Values) -> bool {
        let marks = Desk::arrows(links).into_iter();
        let marks: BTreeSet<String> = marks
            .filter_map(|n| Some(formula::vector_name(&n)?.2))
            .collect();
        let all = gaps(links);
        let one = marks.iter().filter(|mark| !mark.is_empty()).count() < 2;
        one && self.vanish(&all, whatever)
    }

    /// Whether a line about angular momenta holds of one body, of which so much vanishes that it could be any: that it is
    /// kept where it is nothing, or what it is made of in whatever motion.
    pub(super) fn is_lost_in_a_body(&self, links: &[Link]) -> bool {
        let all = gaps(links);
        let bases = Desk::arrows(links).into_iter();
        let bases = bases.filter_map(|name| Some(formula::vector_name(&name)?.0));
        let bases: BTreeSet<String> = bases.collect();
        let of_one = self.whatever.get(1..).unwrap_or_default();
        let is_law = || of_one.iter().any(|body| self.is_law_of(links, body));
        let fits = bases.contains("H") && (bases.len() == 1 || is_law());
        let mut alone = self
            .vectors
            .iter()
            .filter(|stand| fits && stand.when.ends_with(" alone"));
        alone.any(|stand| {
            let values = &stand.values;
            self.vanish(&all, values) && !self.says_enough(links, values, false)
        })
    }

    /// Whether a line says how vectors of both moments are related that an impact does not change.
    pub(super) fn is_idle(&self, links: &[Link], stand: &Stand) -> bool {
        let names = Desk::arrows(links);
        let marked = |marks: &[&str]| {
            let mark = |name: &Symbol| Some(formula::vector_name(name)?.2);
            names
                .iter()
                .any(|n| mark(n).is_some_and(|m| marks.contains(&&*m)))
        };
        let mut moving = names.iter().filter(|name| {
            let base = formula::vector_name(name).map(|(base, ..)| base);
            base.is_some_and(|base| ["v", "omega", "H"].contains(&&*base))
        });
        marked(&["^-", ""]) && marked(&["^+", "'"]) && moving.all(|name| stand.still.contains(name))
    }

    /// Of the impulses and points in a line that two bodies share: which body is meant at first.
    pub(super) fn shared_in(&self, links: &[Link]) -> Vec<(String, usize)> {
        let names = Desk::arrows(links).into_iter();
        let keys = names.filter_map(|name| {
            let (base, index, _) = formula::vector_name(&name)?;
            let key = shared_key(&base, &index);
            Some((key.clone(), *self.first_of.get(&key)?))
        });
        keys.collect()
    }

    /// Whether a line has a shared impulse or velocity of another body than the page has had it.
    pub(super) fn is_counted_otherwise(&self, links: &[Link]) -> bool {
        let mut shared = self.shared_in(links).into_iter();
        shared.any(|(key, first)| self.counted.get(&key).is_some_and(|kept| *kept != first))
    }

    /// Keeps of which bodies shared vectors are in a line that holds for these alone.
    pub(super) fn count(&mut self, links: &[Link], of: &BTreeMap<String, usize>) {
        let all = gaps(links);
        for (key, first) in self.shared_in(links) {
            let meant = of.get(&key).copied().unwrap_or(first);
            let other = |stand: &&Stand| stand.of.get(&key).is_some_and(|b| *b != meant);
            let mut others = self.vectors.iter().filter(other);
            if !others.any(|stand| self.vanish(&all, &stand.values)) {
                self.counted.entry(key).or_insert(meant);
            }
        }
    }

    /// The components of a sum of multiples of vectors: of those with arrows, and where these stand beside them of those that
    /// are asked for.
    pub(super) fn by_components(&self, e: &Expr, beside: bool) -> Option<[Expr; 3]> {
        let is_one = |name: &Symbol| match formula::has_arrow(name) {
            true => self.components(name).is_some(),
            false => beside && self.components(name).is_some(),
        };
        if !is_vector(e, &is_one) {
            return None;
        }
        let names = e.symbols();
        let vectors = names.iter().filter(|name| is_one(name));
        let vectors: Vec<_> = vectors
            .filter_map(|name| Some((name, self.components(name)?)))
            .collect();
        Some([0, 1, 2].map(|k| {
            let along = vectors
                .iter()
                .map(|(name, v)| ((*name).clone(), v[k].clone()));
            e.substitute(&along.collect())
        }))
    }
}
