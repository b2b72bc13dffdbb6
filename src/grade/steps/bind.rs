//! What a name stands for that a solution need not say: `v_A` beside a body A, `u'` beside a given u, and the velocities in
//! a balance of momenta, told by the masses before them.
//!
//! A name that is found in such a way has its true value from the start, so that a line about it can be wrong.

use std::collections::BTreeSet;

use super::super::believed::Story;
use super::Desk;
use super::impact::{Impact, impacts};
use super::letters::{MARKS, readings, used};
use super::link::{Link, Values, names_in};
use crate::dimension::{self, Dimension};
use crate::equality;
use crate::expr::{Expr, Symbol, Vector, only};
use crate::formula::{self, Reading, Relation};
use crate::scene::Ask;

/// Most readings of names that are tried.
const MOST_READINGS: usize = 4;
/// Most names in a balance of momenta.
const MOST_VELOCITIES: usize = 4;

/// What moves along a direction, after and before an impact: the mass of a body, and of all that move alike, by the first of them.
fn carried(impact: &Impact, axis: &Vector) -> Vec<(Expr, usize, bool)> {
    let moving = impact.moving();
    let times = moving.iter().flat_map(|b| [(*b, true), (*b, false)]);
    let each = times.flat_map(|(b, after)| {
        let along = |b: usize| impact.along(b, axis, after);
        let value = along(b).filter(|value| !value.is_zero());
        let alike = |other: &&usize| along(**other) == value;
        let all: Vec<&usize> = moving.iter().filter(alike).collect();
        let mass = |b: &usize| impact.scene.bodies[*b].mass.clone();
        let first = value.is_some() && all.len() > 1 && *all[0] == b;
        let together = first.then(|| Expr::sum(all.into_iter().map(mass)));
        let alone = value.map(|_| mass(&b));
        let both = alone.into_iter().chain(together);
        both.map(move |mass| (mass, b, after)).collect::<Vec<_>>()
    });
    each.collect()
}

/// The number in a name: 2 in `u_2` and `v_{2n}`.
fn number(name: &Symbol) -> Option<char> {
    name.chars().find(char::is_ascii_digit)
}

/// The body and the part of its motion that a name speaks of: `v_A`, `v_{A,x}`, and `v_x` where nothing else moves; 0 and 1
/// for the axes, 2 for the spin.
fn spoken(all: &[Impact], base: &str, index: &str) -> Option<(usize, usize)> {
    let first = all.first()?;
    let plain = |text: &str| text.replace(['_', ',', ' '], "");
    let index = plain(index);
    let lone = first.moving().len() == 1;
    let is_point = |name: &str| first.scene.points.iter().any(|p| p.name == name);
    first.moving().into_iter().find_map(|b| {
        let name = Some(&first.scene.bodies[b].name).filter(|name| !is_point(name));
        let name = name.map_or(String::from("?"), |name| plain(name));
        let rest = index.strip_prefix(&name);
        let rest = rest.or_else(|| {
            lone.then(|| index.strip_prefix('G').unwrap_or(&index))
                .filter(|rest| !rest.is_empty())
        });
        let moves = |axis: usize| {
            let times = all.iter().flat_map(|a| [(a, false), (a, true)]);
            let mut values = times.filter_map(|(a, after)| a.part(b, axis, after));
            values.any(|value| !value.is_zero())
        };
        let part = match (base, rest?) {
            ("v", "x") => 0,
            ("v", "y") => 1,
            ("v", "") if moves(0) != moves(1) => usize::from(moves(1)),
            ("omega", "") if !first.scene.bodies[b].is_particle() => 2,
            _ => return None,
        };
        Some((b, part))
    })
}

impl Desk<'_> {
    /// The names of a solution that the desk does not know.
    fn unknown_names(&self, text: &str) -> BTreeSet<Symbol> {
        let symbols = self.symbols("");
        let used = used(self.sheet, text).into_iter();
        // `vx` is `v_x`.
        let words = text.split(|c: char| !c.is_ascii_alphanumeric());
        let joined = words.filter_map(|word| match word.as_bytes() {
            [b'v', axis @ b'A'..=b'z'] => Some(format!("v_{}", char::from(*axis)).into()),
            _ => None,
        });
        // A volt is no name of the scene.
        let known =
            |name: &Symbol| formula::read_name(&formula::latex_name(name), &symbols).is_some();
        let all: BTreeSet<Symbol> = used.chain(joined).collect();
        let plain = |name: &Symbol| !formula::has_arrow(name) && !formula::is_component(name);
        all.into_iter()
            .filter(|name| plain(name) && !known(name))
            .collect()
    }

    /// Learns names of velocities and spins by the bodies in their index. One without a mark is that before the impact where
    /// it stands with a mark as well.
    pub(super) fn know_bodies(&mut self, text: &str) {
        let all = impacts(self.sheet);
        let used = self.unknown_names(text);
        let named: Vec<_> = used
            .iter()
            .filter_map(|name| {
                let (base, index, mark) = formula::vector_name(&formula::with_arrow(name)?)?;
                let (body, part) = spoken(&all, &base, &index)?;
                Some((name, (base, index), mark, body, part))
            })
            .collect();
        let moves = self.sheet.story.as_ref().is_some_and(Story::has_motions);
        let is_after = |mark: &str| mark == "'" || mark == "^+";
        let incoming = self.coming_in(&all, text);
        let mut of: Vec<Values> = vec![Values::new(); all.len()];
        for (name, key, mark, body, part) in &named {
            let mut others = named.iter();
            let beside = others.any(|(_, other, mark, ..)| other == key && is_after(mark));
            let after = match &**mark {
                "" => !beside && !incoming.contains_key(*name),
                "^-" if !moves => false,
                mark if is_after(mark) => true,
                _ => continue,
            };
            if beside && mark.is_empty() {
                let marks = MARKS.iter().map(|mark| ((*name).clone(), *mark));
                self.own_with_mark.extend(marks);
            }
            if after {
                self.of_bodies.insert((*name).clone(), (*body, *part));
            }
            for (impact, values) in all.iter().zip(&mut of) {
                let value = impact.part(*body, *part, after).cloned();
                values.extend(value.map(|value| ((*name).clone(), value)));
            }
            // The end of a motion has such a mark as well.
            for ((_, values), (_, scene)) in self.ends.iter_mut().zip(&self.sheet.ends) {
                let body = &scene.bodies[*body];
                let [x, y] = &body.velocity;
                values.insert((*name).clone(), [x, y, &body.spin][*part].clone());
            }
            let mut asked = self.sheet.scene.questions.iter();
            let asked = asked.find(|q| match &q.ask {
                Ask::Velocity { body: b, point, .. } => b == body && point.is_none() && *part < 2,
                Ask::Spin { body: b, .. } => b == body && *part == 2,
                _ => false,
            });
            if let Some(q) = asked.filter(|_| after && all.len() == 1) {
                let part = format!("{}_{}", q.name, ["x", "y", ""][*part]);
                let names = [part.as_str(), q.name.as_str()].map(Symbol::from);
                let known = names.into_iter().find(|n| self.closed.contains_key(n));
                self.stands_for
                    .extend(known.map(|known| ((*name).clone(), known)));
            }
        }
        let names: BTreeSet<&Symbol> = of.iter().flat_map(Values::keys).collect();
        self.learned
            .extend(names.iter().map(|name| (*name).clone()));
        if moves {
            self.by_body = self.learned.clone();
        }
        match of.as_slice() {
            // What is meant otherwise stays.
            [one] => {
                for (name, value) in one {
                    let known = self.closed.entry(name.clone());
                    known.or_insert_with(|| value.clone());
                }
            }
            _ => {
                let later = all.iter().zip(of).filter(|(_, values)| !values.is_empty());
                let later = later.map(|(impact, values)| {
                    let mut motion = impact.motion.clone();
                    motion.extend(values);
                    (format!("just after {}", impact.which), motion)
                });
                self.moments.extend(later.collect::<Vec<_>>());
            }
        }
    }

    /// Whether a name of a velocity by its body is the solution's own from here on: `v_A = …` may be of any moment of a motion, until
    /// a line holds with it just after an impact.
    pub(super) fn forgets(&mut self, links: &[Link], fails: bool) -> bool {
        let used = names_in(links);
        if !fails {
            self.by_body.retain(|name| !used.contains(name));
            return false;
        }
        let Some(name) = only(self.by_body.intersection(&used)).cloned() else {
            return false;
        };
        self.by_body.remove(&name);
        self.learned.remove(&name);
        self.closed.remove(&name);
        for (_, values) in &mut self.moments {
            values.remove(&name);
        }
        true
    }

    /// Names that stand for velocities before an impact, with these: one side of a balance of momenta has them with the masses of
    /// their bodies, and of one of them it is said that it is what its body comes in with.
    fn coming_in(&self, all: &[Impact], text: &str) -> Values {
        let readings = readings(self.sheet, text);
        let sides = readings.iter().filter_map(|reading| {
            let (sides, _) = reading.content.relations()?;
            Some([sides.first()?.expr()?, sides.get(1)?.expr()?])
        });
        let sides: Vec<[&Expr; 2]> = sides.collect();
        let given = |name: &Symbol| self.is_given(name);
        let said = sides.iter().filter_map(|[name, value]| {
            let name = name.as_symbol().filter(|name| !given(name))?;
            Some((name.clone(), (*value).clone()))
        });
        let said: Values = said.collect();
        let mut found = Values::new();
        for [left, right] in sides {
            for (side, other) in [(left, right), (right, left)] {
                let names = side.symbols().into_iter().filter(|name| !given(name));
                let names: Vec<Symbol> = names.collect();
                if side.as_symbol().is_none() && names.iter().any(|name| said.contains_key(name)) {
                    let ways = all.iter().flat_map(|a| [0, 1].map(|axis| (a, axis)));
                    let way = ways.filter_map(|(a, axis)| self.coming(a, axis, side, &names));
                    found.extend(
                        way.filter(|way| self.comes_in(way, side, other, &said))
                            .flatten(),
                    );
                }
            }
        }
        found
    }

    /// Whether names are velocities before an impact by what is said of one of them, and by the balance in which they stand.
    fn comes_in(&self, way: &Values, side: &Expr, other: &Expr, said: &Values) -> bool {
        let zero = |e: Expr| self.is_zero(&e);
        let told = way.iter().any(|(name, before)| {
            let value = said.get(name).map(|e| e.substitute(said).substitute(said));
            value.is_some_and(|value| zero(value - before))
        });
        let gap = other - side.substitute(way);
        // `m v = m v_1 + M v_2` says nothing of what comes in.
        told && !equality::vanishes(&gap, &self.sheet.scene.domains) && zero(gap)
    }

    /// Names in a side of a balance, each with the velocity before the impact of the one body whose mass it has.
    fn coming(
        &self,
        impact: &Impact,
        axis: usize,
        side: &Expr,
        names: &[Symbol],
    ) -> Option<Values> {
        let (mut free, mut way): (Vec<usize>, _) = (impact.moving(), Values::new());
        for name in names {
            let factor = side.derivative(name);
            let has = |b: &usize| self.is_zero(&(&factor - &impact.scene.bodies[*b].mass));
            let body = free.remove(free.iter().position(has)?);
            way.insert(name.clone(), impact.part(body, axis, false)?.clone());
        }
        Some(way)
    }

    /// Whether a line that holds gives a name in what is given.
    pub(super) fn is_stated(&self, name: &Symbol) -> bool {
        let given = |other: &Symbol| other == name || self.is_given(other);
        let mut held = self.stated.iter().filter(|(cause, _)| cause.is_none());
        held.any(|(_, gap)| gap.mentions(name) && gap.symbols().iter().all(given))
    }

    /// What names of one's own stand for by the balances of momenta they stand in, and with a prime beside what is given.
    pub(super) fn bindings(&self, text: &str) -> Vec<Values> {
        let all = impacts(self.sheet);
        let unknown = self.unknown_names(text);
        let mut found = vec![self.coming_in(&all, text)];
        for name in &unknown {
            let ways = self.after_given(&all, name);
            if !ways.is_empty() {
                let with = |values: &Values| {
                    let one = |way: &Expr| {
                        let mut values = values.clone();
                        values.insert(name.clone(), way.clone());
                        values
                    };
                    ways.iter().map(one).collect::<Vec<_>>()
                };
                found = found.iter().flat_map(with).take(MOST_READINGS).collect();
            }
        }
        let readings = readings(self.sheet, text);
        for reading in &readings {
            let gap = reading
                .content
                .relations()
                .and_then(|(sides, _)| match sides {
                    [left, right] => Some(left.expr()? - right.expr()?),
                    _ => None,
                });
            let Some(gap) = gap else {
                continue;
            };
            let with = |values: &Values| {
                let gap = gap.substitute(values);
                let used = gap.symbols();
                let open: Vec<&Symbol> = unknown.iter().filter(|n| used.contains(*n)).collect();
                let ways = self.momenta(&all, &gap, &open).into_iter();
                let ways = ways.filter(|way| self.are_velocities(way, &readings));
                let ways = ways.map(|mut way| {
                    way.extend(values.clone());
                    way
                });
                let ways: Vec<Values> = ways.collect();
                if ways.is_empty() {
                    vec![values.clone()]
                } else {
                    ways
                }
            };
            found = found.iter().flat_map(with).take(MOST_READINGS).collect();
        }
        found
    }

    /// Whether names may be velocities by all that is said of them: `x_1 + x_2 = L` says that they are lengths.
    fn are_velocities(&self, way: &Values, readings: &[Reading]) -> bool {
        let velocity = Dimension::new(0, 1, -1);
        let of = |name: &str| match way.contains_key(name) {
            true => Some(velocity.clone()),
            false => Some(self.sheet.scene.parameter(name)?.dimension.clone()),
        };
        let clashes = |reading: &Reading| {
            let Some(([left, right], [Relation::Equal])) = reading.content.relations() else {
                return false;
            };
            let sides = [left, right].map(|side| side.expr().map(|e| dimension::of(e, &of)));
            match sides {
                [Some(Ok(Some(a))), Some(Ok(Some(b)))] => a != b,
                _ => false,
            }
        };
        let speaks = |reading: &&Reading| reading.symbols().iter().any(|n| way.contains_key(n));
        !readings.iter().filter(speaks).any(clashes)
    }

    /// What a given velocity or spin is after the impact, which has its letter with a prime; a velocity may be counted either way,
    /// as a ball that is thrown back has a speed.
    fn after_given(&self, all: &[Impact], name: &Symbol) -> Vec<Expr> {
        let given = name.strip_suffix('\'').map(Symbol::from);
        let Some(given) = given.filter(|given| self.is_given(given)) else {
            return Vec::new();
        };
        let given = Expr::symbol(&given);
        let each = all.iter().flat_map(|impact| {
            let parts = impact
                .moving()
                .into_iter()
                .flat_map(|b| [0, 1, 2].map(|part| (b, part)));
            parts.map(move |(b, part)| (impact, b, part))
        });
        let mut ways = each.filter_map(|(impact, b, part)| {
            let before = impact.part(b, part, false)?;
            let after = impact.part(b, part, true)?.clone();
            let with = *before == given;
            let against = *before == -&given;
            (with || against).then(|| match (part, with) {
                (2, true) => vec![after],
                (2, false) => vec![-after],
                (_, true) => vec![after.clone(), -after],
                (_, false) => vec![-&after, after],
            })
        });
        ways.next().unwrap_or_default()
    }

    /// The velocities that names in an equation are where it is a balance of momenta: each has the mass of its body before it; or
    /// says with which velocity two bodies part.
    fn momenta(&self, all: &[Impact], gap: &Expr, names: &[&Symbol]) -> Vec<Values> {
        if names.is_empty() || names.len() > MOST_VELOCITIES {
            return Vec::new();
        }
        let zero = |e: Expr| self.is_zero(&e);
        let factors: Vec<Expr> = names.iter().map(|name| gap.derivative(name)).collect();
        if factors.iter().any(|k| names.iter().any(|n| k.mentions(n))) {
            return Vec::new();
        }
        // `u_2 − u_1 = e v` says with what they part, whatever their masses are.
        let parting = match factors.as_slice() {
            [a, b] => zero(a + b) && zero(a.powi(2) - Expr::one()),
            _ => false,
        };
        let rest = names
            .iter()
            .fold(gap.clone(), |e, n| e.put(n, &Expr::zero()));
        if parting && zero(rest) {
            return Vec::new();
        }
        let mut ways = Vec::new();
        let ways_of = all
            .iter()
            .flat_map(|impact| impact.axes().map(move |axis| (impact, axis)));
        for (impact, axis) in ways_of {
            let carried = carried(impact, &axis);
            let each = factors.iter().map(|factor| {
                let of = |mass: &Expr| zero(factor - mass) || zero(factor + mass);
                let fits = carried.iter().filter(|(mass, _, after)| match parting {
                    true => *after,
                    false => of(mass),
                });
                fits.map(|(_, b, after)| (*b, *after)).collect()
            });
            let each: Vec<Vec<(usize, bool)>> = each.collect();
            let mut chosen: Vec<Vec<(usize, bool)>> = vec![Vec::new()];
            for times in &each {
                let with = |before: &Vec<(usize, bool)>| {
                    let free = times.iter().filter(|time| !before.contains(time));
                    let with = free.map(|time| [before.as_slice(), &[*time]].concat());
                    with.collect::<Vec<_>>()
                };
                chosen = chosen.iter().flat_map(with).collect();
            }
            let after = |way: &Vec<(usize, bool)>| match way.as_slice() {
                // Names that are numbered are so in the order of the bodies.
                [(a, _), (b, _)] if parting => {
                    let [m, n] = [0, 1].map(|k| number(names[k]));
                    m == n || m.cmp(&n) == a.cmp(b)
                }
                way => way.iter().any(|(_, after)| *after),
            };
            for way in chosen.into_iter().filter(after) {
                let values = names.iter().zip(way).filter_map(|(name, (b, after))| {
                    Some(((*name).clone(), impact.along(b, &axis, after)?))
                });
                let values: Values = values.collect();
                if zero(gap.substitute(&values)) {
                    ways.push(values);
                }
            }
        }
        ways.truncate(MOST_READINGS);
        ways
    }
}
