//! What is behind a wrong line: a belief, a turned sign, another quantity.

use std::collections::{BTreeMap, BTreeSet};

use super::super::Diagnosis;
use super::super::behind::{Named, behind, keeps_energy};
use super::super::belief::{BELIEFS, MOTIONS, other_shapes};
use super::super::relation::{size_in, solve_for};
use super::cause::MOST_STEPS;
use super::impact::{angular_momenta, energies};
use super::inertias::is_other_inertia;
use super::link::in_vectors;
use super::sought::Sought;
use super::{Desk, MOST_TERMS};
use crate::algebra::{Sign, sign, tidy};
use crate::equality;
use crate::expr::angle::arcs_exchanged;
use crate::expr::{Expr, Node, Symbol, effort};
use crate::formula::{self, Content, Reading};
use crate::laws::{self, Unknown};
use crate::scene::{Ask, Question, Scene};

/// Longest value, in letters, that an own name is said to need.
const LONGEST_VALUE: usize = 80;
/// Most values of the scene that an own name may stand for.
const MOST_VALUES: usize = 48;
/// Most pairs of parameters of one kind that are tried for one another.
const MOST_PAIRS: usize = 12;

/// A term with cosines for its sines and sines for its cosines; nothing where it has none.
fn other_arcs(term: &Expr) -> Option<Expr> {
    let other = arcs_exchanged(term, &|_| true);
    (other != *term).then_some(other)
}

/// A product with the sign of one term of a sum in it turned.
fn turned_inside(term: &Expr) -> Vec<Expr> {
    let Node::Product(factors) = term.node() else {
        return Vec::new();
    };
    let sums = factors.iter().filter(|f| matches!(f.node(), Node::Sum(_)));
    let each = sums.flat_map(|sum| (0..sum.terms().len()).map(move |i| (sum, i)));
    let turned = each.map(|(sum, i)| {
        let mut terms = sum.terms().to_vec();
        terms[i] = -&terms[i];
        term.replace(sum, &Expr::sum(terms))
    });
    turned.collect()
}

/// Whether a finding is a belief, or two together.
fn is_belief(d: &Diagnosis) -> bool {
    let mut all = BELIEFS.iter().chain(MOTIONS);
    d.code == "TWO_BELIEFS" || all.any(|b| b.code == d.code)
}

impl Desk<'_> {
    /// Notes what a wrong line implies: each of its names in turn is what it would have to be.
    pub(super) fn believe(&mut self, cause: usize, differences: &[Expr]) {
        let earlier = self
            .believed
            .iter()
            .rev()
            .find(|(c, _)| *c == cause)
            .map(|(_, v)| v.clone())
            .unwrap_or_default();
        for d in differences {
            let d = self.with_own(d);
            let names: Vec<Symbol> = d
                .symbols()
                .into_iter()
                .filter(|n| self.closed.contains_key(n))
                .collect();
            for name in names {
                let mut others = self.closed.clone();
                others.remove(&name);
                let mut known = earlier.clone();
                known.remove(&name);
                let reduced = d.substitute(&known).substitute(&others);
                let domains = &self.sheet.scene.domains;
                // In an energy or a law of constant acceleration it stands by its square, and has the sign that it has in truth.
                let size = || size_in(&reduced, &name, domains);
                let below = || matches!(sign(&self.closed[&name], domains), Some(Sign::Negative));
                // With the closed forms of all others put in, a balance of energies may run away.
                let root = effort::within(MOST_STEPS, || {
                    solve_for(&reduced, &name, domains)
                        .or_else(|| size().map(|size| if below() { -size } else { size }))
                });
                if let Some(root) = root {
                    let mut values = earlier.clone();
                    self.carry_along(&name, &root, &mut values);
                    // What is the same in truth, as a spin some time later, or the other way round, is believed to be so; or
                    // not, where that is a coincidence.
                    let truth = &self.closed[&name];
                    let turned = -truth;
                    let others = self.closed.iter().filter(|(n, _)| **n != name);
                    let same = others.filter_map(|(n, v)| match () {
                        () if v == truth => Some((n.clone(), root.clone())),
                        () if *v == turned => Some((n.clone(), -&root)),
                        () => None,
                    });
                    let same: Vec<(Symbol, Expr)> = same.collect();
                    if !same.is_empty() {
                        let mut alone = values.clone();
                        alone.insert(name.clone(), root.clone());
                        self.believed.push((cause, alone));
                    }
                    for (other, value) in same {
                        values.entry(other).or_insert(value);
                    }
                    values.insert(name, root);
                    self.believed.push((cause, values));
                }
            }
        }
        let excess = self.believed.len().saturating_sub(64);
        self.believed.drain(..excess);
    }

    /// For a line that states a quantity of the scene: the belief behind it. `at` tells the first wrong link of a chain.
    pub(super) fn diagnosis(&self, reading: &Reading, at: usize, text: &str) -> Vec<Diagnosis> {
        let chain = matches!(&reading.content, Content::Relations(sides, _) if sides.len() > 2);
        let broken = chain.then(|| self.broken(reading, at, text)).flatten();
        let mut found: Vec<Diagnosis> = broken.into_iter().collect();
        // What is found by the terms of a line in vectors is in names of components that nobody wrote.
        if !self.links(reading).is_some_and(|links| in_vectors(&links)) {
            found.extend(effort::within(MOST_STEPS, || {
                self.behind_line(reading, at, text)
            }));
        }
        found
    }

    /// The belief that leads to the value which a line gives, where the line follows from a wrong one of which nothing is known.
    pub(super) fn carried_belief(&mut self, reading: &Reading, cause: usize) -> Vec<Diagnosis> {
        let sides = reading.content.relations().map(|(sides, _)| sides);
        let (Some([first, .., last]), false) = (sides, self.explained.contains(&cause)) else {
            return Vec::new();
        };
        let entry = first.name().and_then(|n| self.sheet.entry(n).ok());
        let value = last.expr().map(|e| formula::write_plain(&self.with_own(e)));
        let (Some(entry), Some(value)) = (entry, value) else {
            return Vec::new();
        };
        let mut found = self.sheet.judge(&entry, &value, self.options).diagnosis;
        found.retain(is_belief);
        if !found.is_empty() {
            self.explained.insert(cause);
        }
        found
    }

    fn behind_line(&self, reading: &Reading, at: usize, text: &str) -> Vec<Diagnosis> {
        let Some((sides, _)) = reading.content.relations() else {
            return Vec::new();
        };
        let name = sides.first().and_then(Content::name);
        let value = sides.get(at + 1).and_then(Content::expr);
        if let (Some(name), Some(value)) = (name, value)
            && self.bound.contains(name)
            && self.other_inertia(name, value).is_some()
        {
            return vec![is_other_inertia(name)];
        }
        if let Some(entry) = name.and_then(|n| self.sheet.entry(n).ok()) {
            // The side behind the first wrong sign, with the student's own names put in.
            let side = sides.get(at + 1).and_then(Content::expr);
            let own = side.map(|side| (side, self.put_in_others(side, name)));
            let own = own.filter(|(side, own)| *side != own || sides.len() > 2);
            let by_others = own.is_some();
            // What is said by way of other quantities is a law, and the sign of a term in it says more than a factor.
            if let (Some(_), [left, right]) = (&own, sides)
                && let (Some(left), Some(right)) = (left.expr(), right.expr())
                && let Some(found) = self
                    .turned(left, right)
                    .or_else(|| self.other_shape([left, right]))
            {
                return vec![found];
            }
            let text = own.map_or(text.to_string(), |(_, own)| formula::write_plain(&own));
            let mut found = self.sheet.judge(&entry, &text, self.options).diagnosis;
            // Behind a side that is right a slip of algebra follows, and no belief; what a belief explains needs no other words.
            let settled = name.is_some_and(|name| self.is_settled(name));
            match at {
                // So does one behind a law that holds.
                _ if settled => found.retain(|d| !is_belief(d)),
                0 if found.iter().any(is_belief) => found.retain(|d| {
                    !d.code.starts_with("SYMBOLS_")
                        && !["SPECIAL_CASE", "SMALL_ANGLE"].contains(&d.code)
                }),
                0 => {}
                _ => found.retain(|d| !is_belief(d)),
            }
            // The unit stands at the end of the chain.
            if let Some(Content::Quantity(_)) = sides.last() {
                found.retain(|d| d.code != "UNIT_MISSING");
            }
            // By way of other quantities a value may well be said in symbols that it does not depend on.
            if by_others {
                found.retain(|d| !d.code.starts_with("SYMBOLS_"));
            }
            if !found.is_empty() {
                return found;
            }
        }
        // A law with a slip.
        let [left, right] = sides else {
            return Vec::new();
        };
        let (Some(left), Some(right)) = (left.expr(), right.expr()) else {
            return Vec::new();
        };
        let turned = self.turned(left, right);
        if let Some(arm) = self.other_arm(left - right).filter(|_| turned.is_none()) {
            return vec![arm];
        }
        let mut found: Vec<Diagnosis> = turned
            .or_else(|| self.other_shape([left, right]))
            .or_else(|| self.own_value([left, right], true))
            .into_iter()
            .collect();
        let sides = [left, right];
        let (left, right) = (self.with_own(left), self.with_own(right));
        let used: BTreeSet<Symbol> = left.symbols().union(&right.symbols()).cloned().collect();
        let names = used.into_iter().filter(|n| self.closed.contains_key(n));
        let names: Vec<Symbol> = names.collect();
        let scenes = std::iter::once(&self.sheet.scene).chain(&self.sheet.impacts);
        let mut asked = scenes.filter_map(|scene| {
            let named: Option<Vec<_>> = names.iter().map(|n| self.named(n, scene)).collect();
            Some((scene, named?))
        });
        if let Some((scene, named)) = asked.next().filter(|(_, named)| !named.is_empty()) {
            // Where one sign is all that is wrong, moments were taken about the point that the line says.
            let is_sign = found.iter().any(|d| d.code == "TERM_SIGN");
            let beliefs = behind(scene, [&left, &right], &named).into_iter();
            let mut beliefs = beliefs.filter(|d| !(is_sign && d.code == "WRONG_MOMENT_POINT"));
            // Several beliefs that make one slip alike are evidence of one at most.
            found.extend(beliefs.next());
        }
        if found.is_empty() {
            let kept = self.kept_energy(&(left - right), &names);
            let sought = self.sought.iter().filter(|s| self.gives(s)).map(Some);
            let mut sought = [None].into_iter().chain(sought);
            let other = kept.or_else(|| sought.find_map(|s| self.other_term(sides, s)));
            found.extend(other.or_else(|| self.own_value(sides, false)));
        }
        found
    }

    /// A side with the student's own names and what is asked put in, where it stands on such; `name` is what it gives.
    fn put_in_others(&self, side: &Expr, name: Option<&Symbol>) -> Expr {
        let own = self.with_own(side);
        let mut others = self.closed.clone();
        others.retain(|n, _| Some(n) != name);
        own.substitute(&others)
    }

    /// The student's own names in an equation that does not hold: what each stands for, and what it would have to stand for.
    pub(super) fn own_needed(&self, gap: &Expr) -> Vec<(Symbol, [Expr; 2])> {
        let domains = &self.sheet.scene.domains;
        let used = gap.symbols();
        let open = |name: &&Symbol| used.contains(*name) && !self.proved.contains(*name);
        let own = self.own.keys().filter(open);
        let needed = own.filter_map(|name| {
            let mut others = self.own.clone();
            let value = self.with_own(&others.remove(name)?);
            let rest = gap.substitute(&others).substitute(&self.closed);
            let needed = solve_for(&rest, name, domains).or_else(|| size_in(&rest, name, domains));
            let needed = needed.filter(|needed| !needed.is_zero())?;
            Some((name.clone(), [value, needed]))
        });
        needed.collect()
    }

    /// One of the student's own names whose value is off where the equation is right, or the other way round: by a `factor`, or
    /// by more.
    fn own_value(&self, [left, right]: [&Expr; 2], factor: bool) -> Option<Diagnosis> {
        let each = self.own_needed(&(left - right)).into_iter();
        let found = each.filter_map(|(name, [value, needed])| {
            // A moment of inertia of the scene, or a velocity in it, is no slip, unless another such is needed.
            let [mine, theirs] = [&value, &needed].map(|e| self.of_scene(e));
            if mine.is_some() && theirs.is_none() {
                return None;
            }
            let share = self.share(&value.substitute(&self.closed), &needed);
            let rational = share.as_ref().is_some_and(|k| k.as_number().is_some());
            let same = share.is_some_and(|k| k.is_one());
            let needed = theirs.as_ref().unwrap_or(&needed);
            let [value, needed] = [&value, needed].map(formula::write_plain);
            let likely = theirs.is_some() || rational == factor;
            let told = likely && !same && needed.len().max(value.len()) < LONGEST_VALUE;
            // Of several the one that is said shortest is most likely meant.
            let length = (theirs.is_none(), needed.len());
            told.then(|| {
                let found = Diagnosis::new(
                    "OWN_VALUE",
                    format!("this line holds with {name} = {needed}, where you have {value}"),
                    match factor {
                        _ if theirs.is_some() => {
                            "this line may well be right: check the one that gives that value"
                        }
                        true => "either that value or this line is off by a factor: check both",
                        false => "either that value or this line is wrong: check both",
                    },
                );
                (length, found)
            })
        });
        found
            .min_by_key(|(length, _)| *length)
            .map(|(_, found)| found)
    }

    /// What an own name was meant to be where it would have to be another one in a line: what the scene has, where its value is
    /// none, and neither given nor a part of what was said; or the same with one sign turned, or with a cosine for a sine.
    pub(super) fn meant_by(
        &self,
        gap: &Expr,
        name: &Symbol,
        needed: Option<&Expr>,
    ) -> Option<Expr> {
        // What only has another name was not worked out.
        let value = self.with_own(self.own.get(name)?);
        let value = Some(&value).filter(|value| value.as_symbol().is_none())?;
        let given = |e: &Expr| e.as_symbol().is_some_and(|n| self.is_given(n));
        let part = |e: &Expr| value.terms().contains(e) || value.terms().contains(&-e);
        let early = self.early.contains(name);
        let truth = needed.and_then(|needed| self.of_scene(needed));
        let truth = truth.filter(|truth| !given(truth) && !part(truth));
        if truth.is_some() {
            return truth.filter(|_| early || self.of_scene(value).is_none());
        }
        let terms = value.terms().iter().take(MOST_TERMS);
        let others = terms.flat_map(|term| {
            let others = [
                Some(-term).filter(|_| value.terms().len() > 1),
                other_arcs(term),
            ];
            others
                .into_iter()
                .flatten()
                .map(move |other| value - term + other)
        });
        let exchanged = match early {
            true => self.exchanged(gap, value),
            false => Vec::new(),
        };
        let mut others = others
            .chain(exchanged)
            .filter(|other| self.is_zero(&gap.put(name, other)));
        others.next()
    }

    /// A value with two parameters of one kind for one another, which do not both stand in an equation that it is put into.
    fn exchanged(&self, gap: &Expr, value: &Expr) -> Vec<Expr> {
        let parameters = &self.sheet.scene.parameters;
        let pairs = parameters.iter().enumerate().flat_map(|(i, p)| {
            let alike = parameters[..i].iter();
            alike
                .filter(|q| q.dimension == p.dimension)
                .map(move |q| (&p.name, &q.name))
        });
        let here = |e: &Expr, (p, q): &(&Symbol, &Symbol)| (e.mentions(p), e.mentions(q));
        let fits = |pair: &(&Symbol, &Symbol)| {
            here(value, pair) != (false, false) && here(gap, pair) != (true, true)
        };
        let pairs = pairs.filter(fits).take(MOST_PAIRS);
        let other = pairs.map(|(p, q)| {
            let both = [(p.clone(), Expr::symbol(q)), (q.clone(), Expr::symbol(p))];
            value.substitute(&both.into())
        });
        other.collect()
    }

    /// What the scene has that a value is: a moment of inertia, a kinetic energy, or a velocity or spin, also as it comes into an
    /// impact.
    fn of_scene(&self, value: &Expr) -> Option<Expr> {
        let value = self.truth(value);
        if self.is_inertia(&value) {
            return Some(value);
        }
        let moments = self.moments.iter().map(|(_, values)| values);
        let all = moments.chain([&self.closed]).flat_map(BTreeMap::values);
        let momenta = angular_momenta(self.sheet);
        let bodies = self.sheet.impacts.iter().flat_map(|scene| &scene.bodies);
        let before = bodies.flat_map(|b| b.velocity.iter().chain([&b.spin]));
        let all = all.chain(before).chain(&momenta);
        let all: BTreeSet<&Expr> = all.filter(|e| !e.is_zero()).collect();
        let same = |truth: &&Expr| self.is_zero(&(&value - *truth));
        let found = all.into_iter().take(MOST_VALUES).find(same).cloned();
        found.or_else(|| energies(self.sheet).into_iter().find(|e| same(&e)))
    }

    /// The arm of an impulse with which a balance of moments holds, where the scene has such a distance.
    fn other_arm(&self, gap: Expr) -> Option<Diagnosis> {
        let is_impulse = |q: &&Question| matches!(q.ask, Ask::Impulse { .. });
        let mut asked = self.sheet.scene.questions.iter().filter(is_impulse);
        let gap = self.with_own(&gap);
        asked.find_map(|q| {
            let name = Symbol::from(q.name.as_str());
            let truth = self.closed.get(&name).filter(|_| gap.mentions(&name))?;
            let arm = gap.derivative(&name);
            let rest = gap.put(&name, &Expr::zero());
            let places = self.sheet.scene.arms().into_iter().flat_map(|(_, at)| at);
            let places = places.flat_map(|at| [-&at, at]).filter(|at| !at.is_zero());
            let places: BTreeSet<Expr> = places.collect();
            let mut others = places.iter().filter(|at| **at != arm);
            let needed = others.find(|at| self.is_zero(&(&rest + &(*at * truth))))?;
            let [needed, arm] = [needed, &arm].map(|e| {
                let text = formula::write_plain(e);
                text.trim_start_matches('-').to_string()
            });
            (!arm.contains(&*name)).then(|| {
                let words = format!("this line holds with the arm {needed} of {name}, where you have {arm}");
                let hint = "the arm is the distance from the axis to the line along which the impulse acts";
                Diagnosis::new("ARM", words, hint)
            })
        })
    }

    /// The term with whose other sign an equation holds.
    pub(super) fn turned(&self, left: &Expr, right: &Expr) -> Option<Diagnosis> {
        let [term, _] = self.term([left, right], None, |term| vec![-term])?;
        let term = formula::write_plain(&term);
        Some(Diagnosis::new(
            "TERM_SIGN",
            format!(
                "this line holds with the other sign of the term {}",
                term.trim_start_matches('-')
            ),
            "check the sign of every term: which directions count as positive?",
        ))
    }

    /// The term of an equation that holds with another one in its place, everywhere or for what is sought, and that other one.
    fn term(
        &self,
        [left, right]: [&Expr; 2],
        sought: Option<&Sought>,
        others: impl Fn(&Expr) -> Vec<Expr>,
    ) -> Option<[Expr; 2]> {
        let gap = left - right;
        // On the left a term stands in the gap as it is, on the right with the other sign.
        let all = [(left, 1), (right, -1)].into_iter();
        let all = all.flat_map(|(side, k)| side.terms().iter().map(move |term| (term, k)));
        let mut tried = all.take(MOST_TERMS).flat_map(|(term, k)| {
            let others = others(term).into_iter();
            others.map(move |other| (term, other, k))
        });
        let found = tried.find(|(term, other, k)| {
            let meant = &gap + &(other - *term) * Expr::from(*k);
            match sought {
                Some(s) => !self.vanishes(&meant, s) && self.is_zero_where(&[&meant], s),
                None => self.is_zero(&meant),
            }
        });
        found.map(|(term, other, _)| [term.clone(), other])
    }

    /// The term of a law with the moment of inertia of another shape, or about another point.
    fn other_shape(&self, sides: [&Expr; 2]) -> Option<Diagnosis> {
        let scene = &self.sheet.scene;
        let free = (0..scene.bodies.len()).filter(|&b| !scene.bodies[b].is_fixed());
        let mut shapes = free.flat_map(|b| {
            let others = other_shapes(scene, b).into_iter();
            others.map(move |(other, words)| (other, &scene.bodies[b].inertia, words))
        });
        let tidied = |e: Expr| tidy(&e, &scene.domains).unwrap_or(e);
        shapes.find_map(|(other, truth, words)| {
            let share = self.share(&other, truth)?;
            share.as_number()?;
            let names = other.symbols();
            // Beside it stands nothing of its own: `m g l` is no moment of inertia.
            let ways = [(other.powi(-1), share.clone()), (other, share.powi(-1))];
            let found = self.term(sides, None, |term| {
                let of = |k: &Expr| tidied(term * k).symbols().is_disjoint(&names);
                let ways = ways.iter().filter(|(k, _)| of(k));
                let uses = names.is_subset(&term.symbols());
                ways.filter(|_| uses)
                    .map(|(_, k)| tidied(term * k))
                    .collect()
            })?;
            // The moment of inertia of a body about a point of the scene is none of another shape.
            let [mine, theirs] = found.each_ref().map(|term| self.inertia_in(term));
            if mine && !theirs {
                return None;
            }
            let [term, meant] = found.map(|e| formula::write_plain(&e));
            let words = format!(
                "this line holds with {meant} in place of {term} (moment of inertia {words})"
            );
            let hint = "which shape has the moment of inertia you used, and about which point?";
            Some(Diagnosis::new("INERTIA", words, hint))
        })
    }

    /// Whether a term has the moment of inertia of a body of the scene with a spin, as its momentum or its energy has it.
    fn inertia_in(&self, term: &Expr) -> bool {
        let found = |name: &Symbol| self.closed.contains_key(name);
        let mut spins = term.symbols().into_iter().filter(found);
        spins.any(|spin| {
            let slope = term.derivative(&spin);
            let slope = match slope.mentions(&spin) {
                true => slope.derivative(&spin),
                false => slope,
            };
            self.is_inertia(&slope) || self.is_inertia(&-&slope)
        })
    }

    /// A balance of energies from before a plastic impact to after it, also where it is to give what is sought.
    fn kept_energy(&self, gap: &Expr, names: &[Symbol]) -> Option<Diagnosis> {
        let is_energy = |name: &Symbol| matches!(self.ask(name), Some(Ask::Energy { .. }));
        if names.iter().any(is_energy) {
            return None;
        }
        let gap = self.truth(gap);
        let sought = self.sought.iter().filter(|s| self.gives(s));
        let there = sought.filter_map(|s| self.at_value(&gap, s));
        let gaps: Vec<Expr> = there.chain([gap.clone()]).collect();
        let scenes = std::iter::once(&self.sheet.scene).chain(&self.sheet.impacts);
        let mut scenes = scenes.filter(|scene| scene.stages.is_empty());
        scenes.find_map(|scene| gaps.iter().find_map(|gap| keeps_energy(scene, gap)))
    }

    /// The term of a law that is off by a factor 2 or has the name of another body's quantity, or a sine for a cosine.
    fn other_term(&self, sides: [&Expr; 2], sought: Option<&Sought>) -> Option<Diagnosis> {
        // A half is lost where none is written, and too much where one is.
        let factor = |likely: bool| {
            self.term(sides, sought, |term| {
                let half = term.split_number().0.is_integer() == likely;
                let [one, two] = if half { [1, 2] } else { [2, 1] };
                vec![term * &Expr::ratio(one, two)]
            })
        };
        let scene = &self.sheet.scene;
        let pairs = scene.parameters.iter().flat_map(|p| {
            let others = scene.parameters.iter();
            let others = others.filter(|q| q.dimension == p.dimension && q.name != p.name);
            others.map(|q| [&p.name, &q.name].map(|name| Expr::symbol(name)))
        });
        // Of two bodies that move as one the mass of one alone, or the other way round.
        let pairs = pairs.take(MOST_PAIRS).flat_map(|[p, q]| {
            let both = &p + &q;
            [(p.clone(), q), (p.clone(), both.clone()), (both, p)]
        });
        let named = |(p, q): (Expr, Expr)| {
            self.term(sides, sought, |term| {
                let other = term.replace(&p, &q);
                let says = other != *term && !equality::vanishes(&other, &scene.domains);
                Vec::from_iter(says.then_some(other))
            })
        };
        let mut pairs = pairs;
        let arcs = |term: &Expr| Vec::from_iter(other_arcs(term));
        let found = factor(true)
            .or_else(|| factor(false))
            .or_else(|| pairs.find_map(named))
            .or_else(|| self.term(sides, sought, arcs))
            .or_else(|| self.term(sides, sought, turned_inside))?;
        let [term, other] = found.map(|e| formula::write_plain(&e));
        Some(Diagnosis::new(
            "TERM",
            format!("this line holds with {other} in place of {term}"),
            "compare this term with the law: its factor, whose quantities it has, and from where an angle is measured",
        ))
    }

    /// What a name stands for in the motion.
    pub(super) fn named(&self, name: &Symbol, scene: &Scene) -> Option<Named> {
        let d = &self.sheet.derivation;
        if let Some(answer) = d.answers.iter().find(|a| *a.name == **name) {
            let question = scene.question_of_impact(&answer.question)?;
            return Some((name.clone(), question.ask.clone(), answer.axis()));
        }
        let mut unknowns = laws::unknowns(scene).into_iter();
        let of_scene = || {
            let here = std::ptr::eq(scene, &self.sheet.scene);
            unknowns.find(|u| here && d.names.plain(*u) == &**name)
        };
        let of_body = self.of_bodies.get(name).map(|&(body, part)| match part {
            2 => Unknown::Spin(body),
            axis => Unknown::Velocity(body, axis),
        });
        let (point, along) = (None, None);
        let (ask, component) = match of_body.or_else(of_scene)? {
            Unknown::Velocity(body, axis) => (Ask::Velocity { body, point, along }, Some(axis)),
            unknown @ Unknown::Spin(body) => {
                let clockwise = of_body.is_none() && d.names.is_reversed(unknown);
                (Ask::Spin { body, clockwise }, None)
            }
            _ => return None,
        };
        Some((name.clone(), ask, component))
    }
}
