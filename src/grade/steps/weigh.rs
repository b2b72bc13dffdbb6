//! The links of a chain `a = b = c`: each is judged by itself.

use std::collections::{BTreeMap, BTreeSet};

use num_traits::Signed;

use super::super::relation::{size_in, solve_for, under_root};
use super::super::{Diagnosis, Verdict, read};
use super::cause::MOST_STEPS;
use super::desk::all_of;
use super::impact::Stand;
use super::link::{Link, Values, Weighed, equal, gaps, mentions_vectors};
use super::names::named;
use super::rounded::{is_near, pieces};
use super::sought::Sought;
use super::text::{beside, equations, supposition, with_direction};
use super::{Desk, Status};
use crate::algebra::{self, Sign};
use crate::answer::limit;
use crate::equality;
use crate::expr::{Expr, Function, Symbol, effort};
use crate::formula::{self, Content, Reading, Relation};
use crate::grade;
use crate::scene::{Ask, Question};

/// Most words between a sense of rotation and the word that it is positive.
const MOST_APART: usize = 4;
/// Words before the sense in which something turns.
const TURNS: [&str; 6] = [
    "turns", "rotates", "spins", "turning", "rotating", "spinning",
];

/// Words for a moment, its values, and the bodies of which shared vectors are.
type Elsewhere<'d> = (String, &'d Values, BTreeMap<String, usize>);

impl Desk<'_> {
    /// The components of a vector that is asked for, or of a spin as a vector out of the page.
    pub(super) fn components(&self, name: &str) -> Option<[Expr; 3]> {
        // At another moment the vector may be another one.
        let over = |values: &Values| values.contains_key(&*format!("{name}_z"));
        if self.vectors.iter().any(|stand| over(&stand.values)) {
            return Some(formula::along_axes(name).map(|part| Expr::symbol(&part)));
        }
        if let Some((spin, clockwise)) = self.spins.get(name) {
            let along = Expr::symbol(spin);
            let along = if *clockwise { -along } else { along };
            return Some([Expr::zero(), Expr::zero(), along]);
        }
        if self.learned.contains(name) {
            return None;
        }
        // `v_first` may be a speed that is asked for where a body is called `first`.
        let mut answers = self.sheet.derivation.answers.iter();
        if answers.any(|a| a.name == name) {
            return None;
        }
        let part = |axis: &str| {
            let component = Symbol::from(format!("{name}_{axis}").as_str());
            let maps = [&self.closed, &self.own, &self.parts];
            let known = maps.iter().any(|map| map.contains_key(&component));
            known.then(|| Expr::symbol(&component))
        };
        Some([part("x")?, part("y")?, part("z").unwrap_or(Expr::zero())])
    }

    /// Velocities that are asked for as vectors, or named by their bodies, and point against an axis, counted as speeds.
    pub(super) fn speeds(&self) -> Vec<(Symbol, Expr)> {
        let domains = &self.sheet.scene.domains;
        let moving = |q: &&Question| matches!(q.ask, Ask::Velocity { .. });
        let asked = self.sheet.scene.questions.iter().filter(moving);
        let asked = asked.filter(|q| self.components(&q.name).is_some());
        let asked = asked.map(|q| Symbol::from(q.name.as_str()));
        let no_axis = |name: &&Symbol| {
            !name
                .trim_end_matches(['\'', '^', '+'])
                .ends_with(['x', 'y'])
        };
        let all = asked.chain(self.learned.iter().filter(no_axis).cloned());
        let along = all.filter_map(|name| {
            let value = self.closed.get(&name)?;
            let against = algebra::sign(value, domains) == Some(Sign::Negative);
            against.then(|| (name, -value))
        });
        along.collect()
    }

    /// The one spin that is asked for, counted in the sense that a page says is positive where the question counts the other one.
    pub(super) fn turned_spin(&self, page: &str) -> Option<(Symbol, Expr)> {
        let says = |line: &str| {
            let line = line.to_lowercase();
            let words = line.split(|c: char| !c.is_alphabetic());
            let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
            let at = |found: &dyn Fn(&str) -> bool| words.iter().position(|word| found(word));
            let sense = at(&|word| word.ends_with("clockwise"))?;
            let positive = at(&|word| word == "positive");
            let beside = positive.is_some_and(|at| at.abs_diff(sense) <= MOST_APART);
            let turns = sense > 0 && TURNS.contains(&words[sense - 1]);
            (beside || turns).then(|| words[sense] == "clockwise")
        };
        let mut spins = self.spins.values();
        let (Some((spin, counted)), None) = (spins.next(), spins.next()) else {
            return None;
        };
        // `m v d = I ω, clockwise`
        let symbols = self.symbols("");
        let behind = |line: &str| {
            let turns = equations(line).into_iter().find_map(|equation| {
                let whole = with_direction(line, equation);
                let (own, [.., turns]) = read::sense(whole.as_deref().unwrap_or(equation))?;
                let reading = formula::read(own, &symbols).ok()?;
                reading.symbols().contains(spin).then_some(turns)
            });
            turns.filter(|turns| *turns != 0).map(|turns| turns < 0)
        };
        let mut lines = page.lines();
        let clockwise = lines.find_map(|line| behind(line).or_else(|| says(line)))?;
        let value = self.closed.get(spin)?;
        (*counted != clockwise).then(|| (spin.clone(), -value))
    }

    /// Counts a spin in the other sense, where the name is that of one.
    pub(super) fn count_otherwise(&mut self, name: &Symbol) {
        let of_it = self.spins.iter_mut().filter(|(_, (spin, _))| spin == name);
        for (arrow, (_, clockwise)) in of_it {
            *clockwise = !*clockwise;
            if let Some(part) = self.parts.get_mut(&*format!("{arrow}_z")) {
                *part = -&*part;
            }
            for (_, values) in &mut self.moments {
                if let Some(value) = values.get_mut(name) {
                    *value = -&*value;
                }
            }
        }
    }

    /// The components of a side; of names that are asked for only where a vector with an arrow stands `beside`.
    pub(super) fn vector(&self, side: &Content, beside: bool) -> Option<[Expr; 3]> {
        match side {
            Content::Vector(v) => Some(v.clone()),
            other => {
                let side = other.expr()?;
                let named = side.as_symbol().and_then(|name| self.components(name));
                named.or_else(|| self.by_components(side, beside))
            }
        }
    }

    /// The equality of two sides.
    pub(super) fn link(&self, a: &Content, b: &Content) -> Option<Link> {
        let mut sides = [a.clone(), b.clone()];
        let beside = mentions_vectors(&sides);
        let differences = match (self.vector(a, beside), self.vector(b, beside)) {
            (Some(a), Some(b)) => a.iter().zip(&b).map(|(a, b)| a - b).collect(),
            (Some(v), None) | (None, Some(v))
                if [a, b]
                    .iter()
                    .any(|side| side.expr().is_some_and(Expr::is_zero)) =>
            {
                v.to_vec()
            }
            // A velocity that is put equal to a number is meant as the speed, unless it has one component and is that.
            (Some(_), None) if !b.expr()?.is_zero() && !self.is_along(a.expr()?, b.expr()?) => {
                let speed = Expr::call(Function::Abs, a.expr()?.clone());
                sides[0] = Content::Scalar(speed.clone());
                vec![speed - b.expr()?]
            }
            _ => vec![a.expr()? - b.expr()?],
        };
        Some(Link { sides, differences })
    }

    /// Whether a vector with one component is this component.
    pub(super) fn is_along(&self, vector: &Expr, value: &Expr) -> bool {
        let known = vector
            .as_symbol()
            .is_some_and(|name| self.closed.contains_key(name));
        // No speed is negative.
        let negative = value.as_number().is_some_and(Signed::is_negative);
        known && (negative || self.is_zero(&(vector - value)))
    }

    /// The links of a chain of equalities.
    pub(super) fn links(&self, reading: &Reading) -> Option<Vec<Link>> {
        let (sides, signs) = reading.content.relations()?;
        if !signs.iter().all(|s| equal(*s)) {
            return None;
        }
        let pairs = sides.windows(2);
        pairs.map(|pair| self.link(&pair[0], &pair[1])).collect()
    }

    /// Whether what a line says of one value of a parameter is so: `For θ = 0: ω = 3v/(2l)`. Nothing later hangs on it.
    pub(super) fn in_case(&mut self, text: &str) -> Option<Status> {
        if let Some(status) = self.in_limit(text) {
            return Some(status);
        }
        if let Some([said, other]) = beside(text) {
            let mut ways = [[said, other], [other, said]].into_iter();
            return ways.find_map(|[a, b]| self.in_case(&format!("{a} for {b}")));
        }
        let (given, behind) = supposition(text)?;
        // `2 m` is a number of meters, though m be a mass.
        let read = |part: &str| {
            let arrowed = self.with_arrows_at_dots(part);
            let part = arrowed.as_deref().unwrap_or(part);
            let reading = formula::read(part, &self.symbols(part)).ok()?;
            Some(self.in_its_unit(part, &reading).unwrap_or(reading))
        };
        let then: Option<Vec<Reading>> = behind.iter().map(|part| read(part)).collect();
        let Some(then) = then else {
            // A name of one's own for a special case.
            let is_value = |part: &str| self.supposes_a_value(part);
            let is_new = behind.iter().all(|part| self.names_something(part));
            let is_case = is_new && equations(given).into_iter().all(is_value);
            return is_case.then_some(Status::Defines);
        };
        let is_parameter = |name: &Symbol| self.is_given(name);
        let symbol = |side: &Content| side.name().cloned();
        let mut there = BTreeMap::new();
        for part in equations(given) {
            let given = read(part)?.content;
            let ([left, right], [Relation::Equal]) = given.relations()? else {
                // What holds where an inequality does is not known to hold.
                return Some(Status::Undecided);
            };
            let (name, value) = match (symbol(left), symbol(right)) {
                (Some(name), _) if is_parameter(&name) => (name, right.expr()?),
                (_, Some(name)) if is_parameter(&name) => (name, left.expr()?),
                // `s = d when u = √(2 μ g d)`: what is supposed, and what follows from it.
                (Some(_), _) => {
                    let (links, given) = (self.links(then.first()?)?, self.link(left, right)?);
                    let mut all = self.sought.iter();
                    let found =
                        all.position(|s| self.states(&links, s) && self.holds_where(&given, s))?;
                    self.supposed.push((self.number, found));
                    return Some(Status::Holds);
                }
                _ => return None,
            };
            // `for s = d` puts what s is for d.
            if self.truth(value).mentions(&name) {
                return None;
            }
            there.insert(name, value.clone());
        }
        let links: Option<Vec<Vec<Link>>> = then.iter().map(|then| self.links(then)).collect();
        let links: Vec<Link> = links?.into_iter().flatten().collect();
        let domains = &self.sheet.scene.domains;
        // `For e = 1: H = h`, where the question is which H it is.
        let is_side = |s: &Sought| {
            let mut sides = links.iter().flat_map(|link| &link.sides);
            !there.contains_key(&s.parameter) && sides.any(|side| side.name() == Some(&s.parameter))
        };
        let solved = self.sought.iter().filter(|s| is_side(s));
        let solved: Values = solved
            .filter_map(|s| Some((s.parameter.clone(), self.value_of(s)?)))
            .filter(|(_, value)| there.keys().any(|name| value.mentions(name)))
            .collect();
        let at = |e: &Expr, instead: &Values| {
            let there = there.iter();
            let there = there.map(|(name, value)| (name.clone(), self.put_in(value, instead)));
            let there: Values = there.collect();
            let value = self.put_in(e, instead).substitute(&there);
            self.at_sought(value).substitute(&solved).substitute(&there)
        };
        let values = self.sheet.scene.values();
        let zero = |instead: &Values| {
            // Without a value there, nothing is said.
            let zero = links.iter().map(|link| {
                let number = |side: &Content| Some(at(side.expr()?, instead).substitute(&values));
                let sides = link.sides.each_ref().map(number);
                // Where both sides are formulas nothing is rounded.
                let is_number = |side: &Content| side.symbols().is_empty();
                let rounded = link.sides.iter().any(is_number)
                    && matches!(&sides, [Some(a), Some(b)] if is_near(text, [a, b], &there));
                let mut parts = link
                    .differences
                    .iter()
                    .map(|d| equality::decide(&at(d, instead), &Expr::zero(), domains).equality);
                match parts.find(|part| !part.is_same()) {
                    None => Some(true),
                    Some(_) if rounded => Some(true),
                    Some(part) => part.is_different().then_some(false),
                }
            });
            all_of(zero)
        };
        let status = self.found(zero, Status::Undecided);
        self.note_place(text, &links, &there, &status);
        Some(status)
    }

    /// Whether an equation gives a parameter a value.
    fn supposes_a_value(&self, part: &str) -> bool {
        named(part).is_some_and(|(name, right)| {
            let value = formula::read(right, &self.symbols(right));
            self.is_given(&name) && value.is_ok_and(|value| value.expr().is_some())
        })
    }

    /// Whether two inequalities with a sign of equivalence between them say the same as the scene goes; nothing where a line is
    /// no such thing, or tells a bound that is asked for.
    pub(super) fn equivalence(&self, text: &str) -> Option<Status> {
        let signs = ["⟺", "⇔", "<=>", "\\iff", "\\Leftrightarrow", " iff "];
        let sides = signs.iter().find_map(|sign| text.split_once(sign))?;
        let read = |side: &str| {
            let side = side.trim_matches([' ', '$']);
            let content = formula::read(side, &self.symbols(side)).ok()?.content;
            let ([left, right], [sign]) = content.relations()? else {
                return None;
            };
            let asked = self.says_a_bound([left.expr()?, right.expr()?], *sign);
            (sign.is_order() && !asked).then(|| content.map(&|e| self.truth(e)))
        };
        let [a, b] = [read(sides.0)?, read(sides.1)?];
        let question = grade::Question {
            domains: self.sheet.scene.domains.clone(),
            ..grade::Question::default()
        };
        let key = grade::key_of(a, &question);
        let reading = key.reading.with(b);
        match grade::compare::verdict_of(&key, &reading, self.options) {
            Verdict::Equivalent => Some(Status::Holds),
            Verdict::Different => Some(Status::Wrong),
            _ => Some(Status::Undecided),
        }
    }

    /// Keeps `u = 0 for η = 4` as an answer where it is asked for which η that is so.
    fn note_place(&mut self, text: &str, links: &[Link], there: &Values, status: &Status) {
        let verdict = match status {
            Status::Holds => Verdict::Equivalent,
            Status::Wrong => Verdict::Different,
            _ => return,
        };
        let mut names = there.keys();
        let (Some(name), None) = (names.next(), names.next()) else {
            return;
        };
        let mut all = self.sought.iter();
        let asked = all.find(|s| s.parameter == *name && self.states(links, s));
        if let Some(question) = asked.map(|s| s.question.clone()) {
            self.give(question, text, verdict);
        }
    }

    /// Judges links one by one.
    pub(super) fn weigh(&self, text: &str, links: &[Link]) -> Weighed {
        if let Some(at) = self.in_another_unit(links) {
            return Weighed::Slip(at);
        }
        let none = Values::new();
        let (mut rounded, mut open, mut carried) = (false, false, None);
        for (at, link) in links.iter().enumerate() {
            match self.all_zero(&link.differences, &none) {
                Some(true) => {}
                _ if self.is_rounded(text, link, &none) => rounded = true,
                None => open = true,
                Some(false) if self.follows_condition(link) => {}
                Some(false) => {
                    match (self.cause_of(text, link)).or_else(|| self.miscounted(text, links, at)) {
                        Some(cause) => carried = carried.or(Some(cause)),
                        None => return Weighed::Slip(at),
                    }
                }
            }
        }
        match (carried, open, rounded) {
            (Some(cause), ..) => Weighed::Carried(cause),
            (_, true, _) => Weighed::Open,
            (_, _, true) => Weighed::Rounded,
            _ => Weighed::Holds,
        }
    }

    /// When or where all links of a line hold that do not as the scene goes first: just after another impact, or in another case;
    /// with the bodies of which shared vectors are then.
    pub(super) fn at_another_moment(&self, links: &[Link]) -> Option<Elsewhere<'_>> {
        let all = gaps(links);
        let holds = |values: &Values| self.vanish(&all, values);
        // What still speaks of a parameter is no line about one value of it.
        let own: Vec<Expr> = all.iter().map(|d| self.with_own(d)).collect();
        let is_open = |name: &Symbol| {
            let parameter = self.sheet.scene.parameter(name);
            parameter.is_some() && own.iter().any(|d| d.mentions(name))
        };
        // In a case in which nothing moves everything is nothing.
        let used: BTreeSet<Symbol> = all.iter().flat_map(Expr::symbols).collect();
        let is_idle = |values: &Values| {
            let found: Vec<&Expr> = used.iter().filter_map(|name| values.get(name)).collect();
            found.len() > 1 && found.into_iter().all(Expr::is_zero)
        };
        let fits = |values: &Values| {
            !values.keys().any(is_open)
                && !is_idle(values)
                && holds(values)
                && self.says_enough(links, values, false)
        };
        let vectors = all
            .iter()
            .any(|d| d.symbols().iter().any(|n| formula::is_component(n)));
        let other = self.is_counted_otherwise(links);
        let mut moments = self.moments.iter().filter(|_| !other);
        if let Some((when, values)) = moments.find(|(_, values)| fits(values)) {
            return Some((when.clone(), values, BTreeMap::new()));
        }
        let shared = self.shared_in(links);
        let agrees = |stand: &&Stand| {
            let kept = shared
                .iter()
                .filter(|(key, _)| self.counted.contains_key(key));
            kept.clone()
                .all(|(key, _)| stand.of.get(key) == self.counted.get(key))
        };
        let mut stands = self.vectors.iter().filter(|_| vectors).filter(agrees);
        let stand = stands.find(|s| fits(&s.values) && !self.is_idle(links, s));
        let Some(stand) = stand else {
            let (stage, values) = self.end_here().filter(|(_, values)| fits(values))?;
            return Some((format!("at the end of `{stage}`"), values, BTreeMap::new()));
        };
        let of = stand
            .of
            .iter()
            .filter(|(key, _)| shared.iter().any(|(k, _)| k == *key));
        let of: BTreeMap<String, usize> = of.map(|(key, b)| (key.clone(), *b)).collect();
        let impulses = of.iter().filter_map(|(key, b)| {
            let index = key.strip_prefix("P ")?;
            let body = &self.sheet.scene.bodies.get(*b)?.name;
            Some(format!(", P_{index} counted on `{body}`"))
        });
        Some((
            stand.when.clone() + &impulses.collect::<String>(),
            &stand.values,
            of,
        ))
    }

    /// The wrong line from which an equality follows, or the last of those from which the components in a list do one by one.
    fn cause_of(&self, text: &str, link: &Link) -> Option<usize> {
        let whole = self.cause(text, link).or_else(|| self.carried_on(link));
        whole.or_else(|| {
            if mentions_vectors(&link.sides) {
                return None;
            }
            let [a, b] = link.sides.each_ref().map(|side| self.vector(side, true));
            let parts = a?
                .into_iter()
                .zip(b?)
                .filter(|(a, b)| !self.is_zero(&(a - b)));
            let causes = parts.map(|(a, b)| {
                let differences = vec![&a - &b];
                let sides = [a, b].map(Content::Scalar);
                let part = Link { sides, differences };
                self.cause(text, &part).or_else(|| self.carried_on(&part))
            });
            causes.collect::<Option<Vec<usize>>>()?.into_iter().max()
        })
    }

    pub(super) fn carried_on(&self, link: &Link) -> Option<usize> {
        effort::within(MOST_STEPS, || self.again(link))
    }

    /// The wrong line whose slip a later one repeats, or whose value it carries on by a law that nobody wrote: another value of
    /// a parameter gives both, as √e for e does in `h_1 = e h` and `h_2 = e² h`, and v (m+M)/M for v in `u = m v/M` and
    /// `t = m v/(μ g M)`.
    fn again(&self, link: &Link) -> Option<usize> {
        let scene = &self.sheet.scene;
        let value = |name: &Symbol, d: &Expr| solve_for(d, name, &scene.domains);
        let one = link.gap()?;
        let name = link.sides[0].name()?;
        let mut sought = self.sought.iter();
        let asked = sought.find(|s| s.is_named(name));
        let right = self.closed.get(asked.map_or(&**name, |s| &s.question))?;
        let mine = value(name, &self.with_own(one))?;
        if let Some(Ask::Limit { of, parameter, to }) = self.ask(name) {
            return self.implied(|values| {
                let of = self.put_in(of, values);
                let end = limit::of(&of, parameter, to.as_ref(), &scene.domains).flatten();
                end.is_some_and(|end| self.is_zero(&(end - &mine)))
            });
        }
        let number = Symbol::from("another value");
        let stands_for = |p: &Symbol, right: &Expr, mine: &Expr| {
            let right = right.put(p, &Expr::symbol(&number));
            // It may stand below.
            let lines = [&right - mine, right.powi(-1) - mine.powi(-1)];
            let ways = [solve_for, size_in, under_root].into_iter();
            let mut ways = ways.flat_map(|way| lines.iter().map(move |line| (way, line)));
            ways.find_map(|(way, line)| way(line, &number, &scene.domains))
        };
        let repeats = |values: &Values, name: &Symbol, p: &Symbol| {
            let theirs = &values[name];
            let first = self.closed.get(name).filter(|first| first.mentions(p));
            let other = first.and_then(|first| stands_for(p, first, theirs));
            other.is_some_and(|other| {
                self.is_zero(&(right.put(p, &other) - mine.substitute(values)))
            })
        };
        let parameters = scene.parameters.iter().map(|p| &p.name);
        let parameters: Vec<&Symbol> = parameters.filter(|p| right.mentions(p)).collect();
        let mut tried = BTreeSet::new();
        let mut implied = self.believed.iter().rev();
        let found = implied.find(|(_, values)| {
            values.iter().any(|(name, theirs)| {
                let new = tried.insert((name, theirs));
                new && parameters.iter().any(|p| repeats(values, name, p))
            })
        });
        found.map(|(cause, _)| *cause)
    }

    /// The link of `lost = … = 6 kg` in which an answer of the scene gets a unit of another quantity.
    pub(super) fn in_another_unit(&self, links: &[Link]) -> Option<usize> {
        let name = links.first()?.sides[0].name()?;
        let asked = self.sheet.entry(name).ok()?.key.question.dimension?;
        links.iter().position(|link| match &link.sides[1] {
            Content::Quantity(q) => q.unit.dimension != asked && !q.value.is_zero(),
            _ => false,
        })
    }

    /// The finding about the link of a chain that does not hold.
    pub(super) fn broken(&self, reading: &Reading, at: usize, text: &str) -> Option<Diagnosis> {
        let links = self.links(reading)?;
        let link = links.get(at)?;
        // As they are written, rather than as they are read.
        let written = pieces(text, links.len());
        let [a, b] = match written.as_deref().and_then(|pieces| pieces.get(at..at + 2)) {
            Some([a, b]) => [(*a).to_string(), (*b).to_string()],
            _ => link.sides.each_ref().map(super::super::show),
        };
        Some(Diagnosis::new(
            "LINK",
            format!("of this chain {a} = {b} does not hold"),
            "compare the two sides of this equality sign",
        ))
    }
}
