//! Which equations to use: the fewest that close on what is asked.
//!
//! Planning needs only the pattern of a scene, which unknowns occur in which equation, so it is done in doubles at one
//! point in general position. Nothing found here is trusted: the chosen laws are written and solved symbolically
//! afterwards, and a plan that does not close there is given up for the full system.

mod offered;

use std::ops::RangeInclusive;

use rustc_hash::FxHashSet;

use crate::expr::arithmetic::Number;
use crate::expr::{Expr, Vector};
use crate::laws::{self, Direction, Geometry, Kinematics, Law, Place, Unknown};
use crate::scene::{ContactLaw, Scene};

/// Coefficients below this count as zero; in general position the others are of order one.
pub(super) const ZERO: f64 = 1e-9;
/// Search steps before the planner falls back on a larger block; found by trying scenes of up to four bodies.
const STEPS: usize = 30_000;
/// Largest set of equations searched for.
const LARGEST: usize = 6;

/// A body that moves as if joined to another one.
#[derive(Clone, Copy, Debug)]
pub struct Attachment {
    /// The body.
    pub body: usize,
    /// The joint.
    pub at: Place,
    /// The body that carries it.
    pub to: usize,
}

/// What joints and sticking contacts leave free: a tree of attachments, and the joint conditions no tree can hold.
#[derive(Clone, Debug, Default)]
pub struct Reduction {
    /// Attachments, carriers first.
    pub tree: Vec<Attachment>,
    /// Conditions of joints that close a loop.
    pub loops: Vec<Law>,
}

/// Finds the tree, starting from the bodies that do not move.
pub fn reduction(scene: &Scene) -> Reduction {
    let mut joints: Vec<([usize; 2], Place)> = Vec::new();
    joints.extend(
        scene
            .hinges
            .iter()
            .enumerate()
            .map(|(h, hinge)| (hinge.bodies, Place::Hinge(h))),
    );
    for (c, contact) in scene.contacts.iter().enumerate() {
        if contact.law == ContactLaw::Sticking {
            joints.push((contact.bodies, Place::Contact(c)));
        }
    }
    let mut placed: Vec<bool> = scene.bodies.iter().map(|b| b.is_fixed()).collect();
    let mut used = vec![false; joints.len()];
    let mut reduction = Reduction::default();
    let mut queue: Vec<usize> = (0..scene.bodies.len()).filter(|&b| placed[b]).collect();
    let mut next_root = 0;
    loop {
        let mut at = 0;
        while at < queue.len() {
            let carrier = queue[at];
            at += 1;
            for (j, (bodies, place)) in joints.iter().enumerate() {
                let Some(side) = bodies.iter().position(|&b| b == carrier) else {
                    continue;
                };
                let body = bodies[1 - side];
                if !used[j] && !placed[body] {
                    used[j] = true;
                    placed[body] = true;
                    reduction.tree.push(Attachment {
                        body,
                        at: *place,
                        to: carrier,
                    });
                    queue.push(body);
                }
            }
        }
        match (next_root..scene.bodies.len()).find(|&b| !placed[b]) {
            Some(root) => {
                placed[root] = true;
                next_root = root + 1;
                queue = vec![root];
            }
            None => break,
        }
    }
    for (j, (_, place)) in joints.iter().enumerate() {
        if !used[j] {
            reduction.loops.extend([0, 1].map(|axis| match place {
                Place::Hinge(h) => Law::Hinged(*h, axis),
                Place::Contact(c) => Law::Sticking(*c, axis),
                Place::Center(_) | Place::Blow(_) => unreachable!("joints are hinges and contacts"),
            }));
        }
    }
    reduction
}

impl Reduction {
    /// The motion after in terms of what is left free.
    pub fn kinematics<T: Number>(&self, scene: &Scene, g: &Geometry<T>) -> Kinematics<T> {
        let mut motion = Kinematics::full(scene, g);
        for link in &self.tree {
            let at = g.place(link.at).clone();
            let carrier = motion.velocity_of(g, link.to, &at);
            motion.attach(scene, g, link.body, &at, carrier);
        }
        motion
    }
}

/// Ways to determine an unknown.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Way {
    /// The fewest laws that close on it, at least and at most so many.
    Closing(usize, usize),
    /// The impulse first and the rest in terms of it.
    ImpulseFirst,
    /// All velocities together, from laws without unknown impulses.
    WithoutImpulses,
}

/// All ways, best first. With four equations or more either way, the impulse first reads better.
pub(super) const WAYS: [Way; 4] = [
    Way::Closing(1, 3),
    Way::ImpulseFirst,
    Way::Closing(4, LARGEST),
    Way::WithoutImpulses,
];

/// An equation that could be used, by its pattern.
#[derive(Clone, Debug)]
struct Candidate {
    law: Law,
    row: Vec<(usize, f64)>,
    mask: u128,
    cost: usize,
}

impl Candidate {
    /// What it costs the reader: mostly its unknowns, a little the terms already known, and its kind.
    fn cost_of(&self, unknowns: u128) -> usize {
        let open = unknowns.count_ones() as usize;
        self.cost + 4 * open + 2 * (self.row.len() - open)
    }
}

/// The candidate equations of a scene.
#[derive(Debug, Default)]
pub struct Planner {
    unknowns: Vec<Unknown>,
    candidates: Vec<Candidate>,
    /// The candidates that hold each unknown.
    holding: Vec<Vec<usize>>,
    attached: Vec<Attachment>,
}

impl Planner {
    /// Lists the candidates; `None` where the scene is too large for a search or has no value at the planning point.
    pub fn new(scene: &Scene, reduction: &Reduction) -> Option<Planner> {
        let point = scene.generic_point();
        let value = |e: &Expr| e.evaluate(&point).ok_or(());
        let g = Geometry::<f64>::of(scene, value).ok()?;
        let motion = reduction.kinematics(scene, &g);
        let mut planner = Planner {
            attached: reduction.tree.clone(),
            ..Planner::default()
        };
        for (law, cost) in offered::candidate_laws(scene, reduction, &g) {
            let vector = |v: &Vector| Ok::<_, ()>([value(&v[0])?, value(&v[1])?]);
            let equation = laws::equation(scene, &g, &motion, &law, vector).ok()?;
            let mut row = Vec::new();
            for (unknown, k) in equation.terms {
                if k.abs() > ZERO {
                    row.push((planner.index(unknown), k));
                }
            }
            if planner.unknowns.len() > 128 {
                return None;
            }
            if !row.is_empty() {
                let mask = row.iter().fold(0, |m, (i, _)| m | 1 << i);
                for (i, _) in &row {
                    planner.holding[*i].push(planner.candidates.len());
                }
                planner.candidates.push(Candidate {
                    law,
                    row,
                    mask,
                    cost,
                });
            }
        }
        Some(planner)
    }

    fn index(&mut self, unknown: Unknown) -> usize {
        let known = self.unknowns.iter().position(|u| *u == unknown);
        known.unwrap_or_else(|| {
            self.unknowns.push(unknown);
            self.holding.push(Vec::new());
            self.unknowns.len() - 1
        })
    }

    /// Laws that determine a target in some way, and all they determine; `None` where that way does not lead there.
    pub(super) fn plan(
        &self,
        way: Way,
        target: Unknown,
        known: &dyn Fn(Unknown) -> bool,
    ) -> Option<(Vec<Law>, Vec<Unknown>)> {
        match way {
            Way::Closing(least, most) => self.closing(target, least..=most, known),
            Way::ImpulseFirst => self.impulse_first(target, known),
            Way::WithoutImpulses if target.is_impulse() => None,
            Way::WithoutImpulses => self.without_impulses(known),
        }
    }

    /// The fewest laws that, with the `known` unknowns given, determine a target; of equally many the simplest.
    fn closing(
        &self,
        target: Unknown,
        sizes: RangeInclusive<usize>,
        known: &dyn Fn(Unknown) -> bool,
    ) -> Option<(Vec<Law>, Vec<Unknown>)> {
        let known_mask = self.mask_of(known);
        let goal = self.mask(std::iter::once(target));
        if goal == 0 {
            return None;
        }
        let open = |c: &Candidate| c.mask & !known_mask;
        let mut search = Search {
            planner: self,
            open: self.candidates.iter().map(open).collect(),
            cost: self.candidates.iter().map(|c| c.cost_of(open(c))).collect(),
            best: None,
            singular: FxHashSet::default(),
            steps: 0,
            limit: 0,
        };
        for k in sizes {
            search.limit = k;
            search.extend(&mut Vec::new(), goal, 0, 0);
            if search.best.is_some() || search.steps > STEPS {
                break;
            }
        }
        let (_, chosen, union) = search.best?;
        Some(self.chosen(&chosen, union))
    }

    /// The laws of candidates, and the unknowns of a mask.
    fn chosen(&self, candidates: &[usize], mask: u128) -> (Vec<Law>, Vec<Unknown>) {
        let laws = candidates.iter().map(|&c| self.candidates[c].law.clone());
        let unknowns = bits(mask).map(|i| self.unknowns[i]);
        (laws.collect(), unknowns.collect())
    }

    /// The unknowns of this kind.
    fn mask_of(&self, is_wanted: impl Fn(Unknown) -> bool) -> u128 {
        self.mask(self.unknowns.iter().copied().filter(|u| is_wanted(*u)))
    }

    /// A plan in pieces that can be solved one after the other, each as small as can be: what a single equation tells is
    /// taken from it first.
    pub fn pieces(
        &self,
        plan: (Vec<Law>, Vec<Unknown>),
        known: &dyn Fn(Unknown) -> bool,
    ) -> Vec<(Vec<Law>, Vec<Unknown>)> {
        let (mut laws, mut unknowns) = plan;
        let mut pieces = Vec::new();
        let mut done = self.mask_of(known);
        while laws.len() > 1 && laws.len() <= LARGEST {
            let Some((chosen, union)) = self.smallest_closed(&laws, done) else {
                break;
            };
            let all = laws.into_iter().enumerate();
            let (piece, rest): (Vec<_>, Vec<_>) = all.partition(|(i, _)| chosen >> i & 1 == 1);
            let found: Vec<Unknown> = bits(union).map(|i| self.unknowns[i]).collect();
            unknowns.retain(|u| !found.contains(u));
            pieces.push((piece.into_iter().map(|(_, law)| law).collect(), found));
            laws = rest.into_iter().map(|(_, law)| law).collect();
            done |= union;
        }
        pieces.push((laws, unknowns));
        pieces
    }

    /// The smallest proper subset of laws with as many unknowns as laws.
    fn smallest_closed(&self, laws: &[Law], known: u128) -> Option<(u32, u128)> {
        let mask = |law: &Law| {
            let own = self.candidates.iter().find(|c| c.law == *law)?;
            Some(own.mask & !known)
        };
        let masks = laws.iter().map(mask).collect::<Option<Vec<u128>>>()?;
        let mut subsets: Vec<u32> = (1..(1 << laws.len()) - 1).collect();
        subsets.sort_by_key(|s| (s.count_ones(), *s));
        subsets.into_iter().find_map(|subset| {
            let inside = (0..laws.len()).filter(|i| subset >> i & 1 == 1);
            let union = inside.fold(0u128, |union, i| union | masks[i]);
            (union.count_ones() == subset.count_ones()).then_some((subset, union))
        })
    }

    /// As many independent laws without unknown impulses as there are free velocities; for scenes too large to search.
    pub fn without_impulses(
        &self,
        known: &dyn Fn(Unknown) -> bool,
    ) -> Option<(Vec<Law>, Vec<Unknown>)> {
        let impulses = self.mask_of(|u| u.is_impulse() && !known(u));
        let free = self.mask_of(|u| !u.is_impulse() && !known(u));
        let mask = |c: usize| self.candidates[c].mask;
        let fits = |c: &usize| mask(*c) & impulses == 0 && mask(*c) & free != 0;
        let mut order: Vec<usize> = (0..self.candidates.len()).filter(fits).collect();
        order.sort_by_key(|&c| (mask(c).count_ones(), self.candidates[c].cost, c));
        let wanted = free.count_ones() as usize;
        let mut rows: Vec<Vec<f64>> = Vec::new();
        let mut chosen = Vec::new();
        for c in order {
            if adds_rank(&mut rows, dense(&self.candidates[c], free)) {
                chosen.push(c);
            }
        }
        (chosen.len() == wanted && wanted > 0).then(|| self.chosen(&chosen, free))
    }

    /// The way with the impulse first: every unknown is paired with the balance of its own body, every contact impulse with
    /// the law of its contact, until nothing new turns up. `None` where a hinge takes part or a pair is missing.
    fn impulse_first(
        &self,
        target: Unknown,
        known: &dyn Fn(Unknown) -> bool,
    ) -> Option<(Vec<Law>, Vec<Unknown>)> {
        let mut unknowns = vec![target];
        let mut chosen: Vec<&Candidate> = Vec::new();
        let mut at = 0;
        while at < unknowns.len() {
            let candidate = self.own_law(unknowns[at])?;
            for (i, _) in &candidate.row {
                let unknown = self.unknowns[*i];
                if matches!(unknown, Unknown::Hinge(..)) {
                    return None;
                }
                if !known(unknown) && !unknowns.contains(&unknown) {
                    unknowns.push(unknown);
                }
            }
            chosen.push(candidate);
            at += 1;
        }
        // A contact law may not hold the impulse it is paired with, once the velocities are known.
        let union = self.mask(unknowns.iter().copied());
        let mut rows = Vec::new();
        let independent = chosen.iter().all(|c| adds_rank(&mut rows, dense(c, union)));
        independent.then(|| (chosen.iter().map(|c| c.law.clone()).collect(), unknowns))
    }

    /// The law a teacher writes for the sake of this unknown.
    fn own_law(&self, unknown: Unknown) -> Option<&Candidate> {
        let linear = |body: usize, axis: usize| {
            let axes = [Direction::X, Direction::Y];
            Law::linear(&[body], axes[axis].clone())
        };
        let law = match unknown {
            Unknown::Velocity(b, axis) => linear(b, axis),
            Unknown::Contact(k, axis) => {
                let mut links = self.attached.iter();
                let link = links.find(|link| link.at == Place::Contact(k))?;
                linear(link.body, axis)
            }
            Unknown::Spin(b) => Law::angular(&[b], Place::Center(b)),
            Unknown::Normal(c) => Law::Restitution(c),
            Unknown::Hinge(..) | Unknown::Blow(_) => return None,
        };
        self.candidates.iter().find(|c| c.law == law)
    }

    fn mask(&self, unknowns: impl Iterator<Item = Unknown>) -> u128 {
        let places = unknowns.filter_map(|u| self.unknowns.iter().position(|v| *v == u));
        places.fold(0, |m, i| m | 1 << i)
    }
}

/// The coefficients of a candidate in the columns of a mask.
fn dense(candidate: &Candidate, columns: u128) -> Vec<f64> {
    let entry = |i: usize| candidate.row.iter().find(|(j, _)| *j == i);
    let entry = |i: usize| entry(i).map_or(0.0, |(_, k)| *k);
    bits(columns).map(entry).collect()
}

/// Depth-first search for a set of equations that has as many unknowns as equations. Every unknown of the set is matched
/// with one of its equations, so each nonsingular set is reached.
struct Search<'a> {
    planner: &'a Planner,
    /// What is not known of each candidate, and what it costs.
    open: Vec<u128>,
    cost: Vec<usize>,
    best: Option<(usize, Vec<usize>, u128)>,
    /// Sets that are known to be singular; the same set is met in many orders.
    singular: FxHashSet<Vec<usize>>,
    steps: usize,
    limit: usize,
}

impl Search<'_> {
    fn extend(&mut self, chosen: &mut Vec<usize>, union: u128, matched: u128, cost: usize) {
        let open = union & !matched;
        if open == 0 {
            return self.record(chosen, union, cost);
        }
        let planner = self.planner;
        let unknown = open.trailing_zeros() as usize;
        for &c in &planner.holding[unknown] {
            if chosen.contains(&c) {
                continue;
            }
            self.steps += 1;
            if self.steps > STEPS {
                return;
            }
            let union = union | self.open[c];
            let cost = cost + self.cost[c];
            let too_dear = self.best.as_ref().is_some_and(|(best, ..)| *best <= cost);
            if !too_dear && union.count_ones() as usize <= self.limit {
                chosen.push(c);
                self.extend(chosen, union, matched | 1 << unknown, cost);
                chosen.pop();
            }
        }
    }

    fn record(&mut self, chosen: &[usize], union: u128, cost: usize) {
        let mut laws = chosen.to_vec();
        laws.sort_unstable();
        if self.singular.contains(&laws) {
            return;
        }
        let mut rows = Vec::new();
        let all = &self.planner.candidates;
        let mut dense = laws.iter().map(|&c| dense(&all[c], union));
        match dense.all(|row| adds_rank(&mut rows, row)) {
            true => self.best = Some((cost, laws, union)),
            false => _ = self.singular.insert(laws),
        }
    }
}

fn bits(mask: u128) -> impl Iterator<Item = usize> {
    (0..128).filter(move |i| mask >> i & 1 == 1)
}

/// Reduces `row` by the echelon rows collected so far and keeps it if something is left.
fn adds_rank(rows: &mut Vec<Vec<f64>>, mut row: Vec<f64>) -> bool {
    for r in rows.iter() {
        let lead = r.iter().position(|k| *k != 0.0).unwrap_or(0);
        let factor = row[lead] / r[lead];
        for (a, b) in row.iter_mut().zip(r) {
            *a -= factor * b;
        }
        row[lead] = 0.0;
    }
    let Some(lead) = (0..row.len()).max_by(|&a, &b| row[a].abs().total_cmp(&row[b].abs())) else {
        return false;
    };
    if row[lead].abs() < ZERO {
        return false;
    }
    // What is negligible must not become a lead.
    let negligible = row.iter_mut().filter(|k| k.abs() < ZERO);
    negligible.for_each(|k| *k = 0.0);
    rows.push(row);
    true
}
