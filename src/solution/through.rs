//! Two ways to spare a reader equations: what no impulse acts on keeps its value, said in a clause; and where every velocity
//! follows from the impulses alone, the balances are told together and leave equations for the impulses.

use super::Writer;
use super::neat::neat;
use super::words::{self, fill, say};
use crate::derive::{Block, Equation};
use crate::expr::{Expr, Symbol};
use crate::laws::{Direction, Law, Place, Unknown};
use crate::scene::Ask;

/// Largest equation, in nodes, that is written for the impulses alone.
const READABLE: usize = 90;

impl Writer<'_> {
    /// Whether a block says no more than that a body keeps a component of its velocity, or its spin: no impulse changes it.
    pub(super) fn is_kept(&mut self, block: &Block) -> bool {
        let ([equation], [unknown]) = (block.equations.as_slice(), block.unknowns.as_slice())
        else {
            return false;
        };
        if equation.terms.len() != 1 {
            return false;
        }
        match (&equation.law, *unknown) {
            (Law::LinearMomentum { system, along }, Unknown::Velocity(b, axis)) => {
                let axes = [Direction::X, Direction::Y];
                let d = along.vector();
                // Bodies that were joined keep what they had not before.
                let joined = equation.known.is_zero();
                (*system == [b] || joined)
                    && *along == axes[axis]
                    && self.outside(system, None).iter().all(|o| {
                        let component = &o.impulse[0] * &d[0] + &o.impulse[1] * &d[1];
                        component.is_zero()
                    })
            }
            (Law::AngularMomentum { system, about }, Unknown::Spin(b)) => {
                let here = self.arm(&self.g.place(Place::Center(b)).clone(), *about);
                *system == [b]
                    && here.iter().all(Expr::is_zero)
                    && self
                        .outside(system, Some(*about))
                        .iter()
                        .all(|o| o.moment.is_zero())
            }
            _ => false,
        }
    }

    /// Says why nothing changes these, and what they are. An axis along which no body moves is told once for all.
    pub(super) fn keeps(&mut self, blocks: &[&Block]) {
        let bodies = self.scene.moving().count();
        let mut rest = blocks.to_vec();
        // Of what earlier stages leave open there is nothing to tell.
        rest.retain(|block| {
            let mut values = self.d.solution(block).into_iter();
            let is_known = |e: Expr| {
                e.symbols()
                    .iter()
                    .all(|s| self.scene.parameter(s).is_some())
            };
            self.is_asked(block) || values.all(is_known)
        });
        for (axis, direction) in super::block::AXES.iter().enumerate() {
            let rests = |b: &&&Block| {
                let is_along = matches!(b.unknowns[0], Unknown::Velocity(_, a) if a == axis);
                is_along && self.d.solution(b).iter().all(Expr::is_zero) && !self.is_asked(b)
            };
            let resting: Vec<&Block> = blocks.iter().filter(rests).copied().collect();
            if resting.len() < bodies.max(2) {
                continue;
            }
            self.say(&format!(
                "No impulse acts along {direction}, and nothing moves along it."
            ));
            for block in &resting {
                self.kept(block);
            }
            rest.retain(|b| !resting.iter().any(|r| std::ptr::eq(*r, *b)));
        }
        if !rest.is_empty() {
            self.keeps_each(&rest);
        }
    }

    /// Whether what a block finds is an answer.
    fn is_asked(&self, block: &Block) -> bool {
        let name = self.d.names.plain(block.unknowns[0]);
        self.d.answers.iter().any(|a| a.name == name)
    }

    /// Claims what nothing changes; gives its symbol and value.
    fn kept(&mut self, block: &Block) -> [Expr; 2] {
        let unknown = block.unknowns[0];
        let value = self.d.solution(block).swap_remove(0);
        let symbol = Expr::symbol(self.d.names.plain(unknown));
        if value.is_zero() {
            self.zero.insert(unknown);
        }
        let claim = super::Claim::new(symbol.clone(), value.clone());
        self.step(Vec::new(), vec![claim], "no impulse changes it");
        [symbol, value]
    }

    fn keeps_each(&mut self, blocks: &[&Block]) {
        let mut along: Vec<(usize, Vec<String>)> = Vec::new();
        let mut spins = Vec::new();
        for block in blocks {
            match (&block.equations[0].law, block.unknowns[0]) {
                (Law::LinearMomentum { system, .. }, Unknown::Velocity(_, axis)) => {
                    let on = match system.len() {
                        1 => words::bodies(self.scene, system),
                        _ => words::bodies(self.scene, system) + " together",
                    };
                    match along.iter_mut().find(|(a, _)| *a == axis) {
                        Some((_, bodies)) => bodies.push(on),
                        None => along.push((axis, vec![on])),
                    }
                }
                (_, Unknown::Spin(b)) => spins.push(words::body(self.scene, b)),
                _ => {}
            }
        }
        let direction = |axis: &usize| super::block::AXES[*axis];
        let text = match along.as_slice() {
            [(axis, bodies)] if *bodies == spins => {
                let on = words::either(bodies);
                let axis = direction(axis);
                format!(
                    "No impulse acts on {on} along {axis} or has a moment about its center of mass"
                )
            }
            _ => {
                let both: Vec<String> = match along.as_slice() {
                    [(_, one), (_, other)] => {
                        one.iter().filter(|b| other.contains(b)).cloned().collect()
                    }
                    _ => Vec::new(),
                };
                let alone = along.iter().filter_map(|(axis, bodies)| {
                    let bodies = bodies.iter().filter(|b| !both.contains(b));
                    let bodies: Vec<String> = bodies.cloned().collect();
                    let on = words::either(&bodies);
                    (!bodies.is_empty()).then(|| format!("on {on} along {}", direction(axis)))
                });
                let whole = (!both.is_empty()).then(|| format!("on {}", words::either(&both)));
                let forces: Vec<String> = whole.into_iter().chain(alone).collect();
                let forces = match forces.is_empty() {
                    true => None,
                    false => Some(format!("no impulse acts {}", forces.join(", nor "))),
                };
                let turns = (!spins.is_empty()).then(|| {
                    let of = words::either(&spins);
                    format!("no impulse has a moment about the center of mass of {of}")
                });
                let reasons: Vec<String> = forces.into_iter().chain(turns).collect();
                words::capital(&reasons.join(", and "))
            }
        };
        if blocks.iter().any(|b| self.is_asked(b)) {
            self.say(&format!("{text}, so"));
            return self.solved(blocks, "");
        }
        // What is not asked for is said in the sentence.
        let mut line = vec![say(format!("{text}, so "))];
        let kept = blocks.iter().map(|block| {
            let [symbol, value] = self.kept(block);
            words::equation(&symbol, &value)
        });
        line.extend(words::row(kept, " and "));
        line.push(say("."));
        self.text(line);
    }

    /// The balances of a block, if through each of them one velocity or spin follows from the impulses alone; and the others.
    fn through<'b>(&self, block: &'b Block) -> Option<(Vec<&'b Equation>, Vec<&'b Equation>)> {
        let mut open: Vec<Unknown> = block.unknowns.clone();
        open.retain(|u| !u.is_impulse());
        if open.is_empty() || open.len() == block.unknowns.len() {
            return None;
        }
        let alone = |e: &Equation| {
            let is_balance = matches!(
                e.law,
                Law::LinearMomentum { .. } | Law::AngularMomentum { .. }
            );
            let mut mine = e.terms.iter().filter(|(u, _)| open.contains(u));
            let first = mine.next().map(|(u, _)| *u);
            first.filter(|_| is_balance && mine.next().is_none())
        };
        let (balances, others): (Vec<_>, Vec<_>) =
            block.equations.iter().partition(|e| alone(e).is_some());
        let mut found: Vec<Unknown> = balances.iter().filter_map(|e| alone(e)).collect();
        found.sort_unstable();
        found.dedup();
        (found.len() == open.len() && balances.len() == open.len()).then_some((balances, others))
    }

    /// Tells a block through its impulses; gives whether it could be told so.
    pub(super) fn told_through(&mut self, block: &Block) -> bool {
        let Some((balances, others)) = self.through(block) else {
            return false;
        };
        let mut links: Vec<usize> = Vec::new();
        for e in &balances {
            if let Law::LinearMomentum { system, .. } | Law::AngularMomentum { system, .. } = &e.law
            {
                links.extend(system);
            }
        }
        self.motion_words(&links);
        self.name_impulses(block);
        self.say(&format!("{}.", self.balance_words(&balances)));
        for e in &balances {
            self.short_balance(e);
        }
        for e in &others {
            self.balance(e, true);
        }
        let impulses: Vec<Unknown> = block
            .unknowns
            .iter()
            .copied()
            .filter(|u| u.is_impulse())
            .collect();
        let rows: Vec<_> = others
            .iter()
            .map(|e| self.for_impulses(e, &balances, &impulses))
            .collect();
        // Where abbreviations make the answers short, the equations in full would be long.
        let abbreviated = block
            .unknowns
            .iter()
            .zip(self.d.solution(block))
            .any(|(u, v)| {
                let short = self.short(*u, &v);
                let mut all = self.d.definitions.iter();
                let named = |d: &Symbol| impulses.iter().any(|p| *self.d.names.plain(*p) == **d);
                all.any(|d| !named(&d.name) && short.symbols().contains(&d.name))
            });
        let short = !abbreviated && rows.iter().all(|(l, r)| l.size() + r.size() <= READABLE);
        // What holds impulses alone, or velocities that are given, stands there already.
        let is_mixed = |e: &Equation| {
            let mut found = e.terms.iter().filter(|(u, _)| block.unknowns.contains(u));
            found.any(|(u, _)| !u.is_impulse())
        };
        let mixed = rows.into_iter().zip(&others);
        let rows: Vec<_> = mixed
            .filter(|(_, e)| is_mixed(e))
            .map(|(row, _)| row)
            .collect();
        let short = short && !rows.is_empty();
        if short {
            let these = match (rows.len(), rows.len() == others.len()) {
                (1, true) => "this becomes",
                (1, false) => "the condition on the velocities becomes",
                (_, true) => "these become",
                (_, false) => "the conditions on the velocities become",
            };
            self.say(&format!("With the velocities from the balances {these}"));
            for (left, right) in rows {
                self.claim(left, right, "the velocities substituted");
            }
        }
        // The impulses come first: the motion follows from them.
        let mut order: Vec<usize> = (0..block.unknowns.len()).collect();
        order.sort_by_key(|i| !block.unknowns[*i].is_impulse());
        let sorted = Block {
            unknowns: order.iter().map(|i| block.unknowns[*i]).collect(),
            solution: order.iter().map(|i| block.solution[*i].clone()).collect(),
            ..block.clone()
        };
        self.solved(&[&sorted], if short { "" } else { "Solving them gives" });
        true
    }

    /// What the impulses along normals in a block are, unless its heading says so.
    pub(super) fn name_impulses(&mut self, block: &Block) {
        let mut questions = self.scene.questions.iter();
        let heads = questions.find(|q| block.asked_by.as_deref() == Some(q.name.as_str()));
        if heads.is_some_and(|q| matches!(q.ask, Ask::Impulse { .. })) && block.unknowns.len() == 1
        {
            return;
        }
        let mut all = Vec::new();
        for u in &block.unknowns {
            let Unknown::Normal(c) = u else {
                continue;
            };
            let contact = &self.scene.contacts[*c];
            let on = contact.bodies[usize::from(!self.d.names.is_reversed(*u))];
            let line = match self.scene.figure.string(&contact.name) {
                Some(_) => "the string",
                None => "the normal",
            };
            let parts = [
                words::formula(&Expr::symbol(self.d.names.plain(*u))),
                say(if all.is_empty() { " be" } else { "" }),
                say(words::at(self.scene, Place::Contact(*c))),
                say(words::body(self.scene, on)),
                say(line),
            ];
            all.push(fill("{}{} the impulse at {} on {}, along {}", parts));
        }
        if !all.is_empty() {
            let all = all.join(&say(", and "));
            self.text([vec![say("Let ")], all, vec![say(".")]].concat());
        }
    }

    /// `Balance linear momentum of the disk and of the plate along x, and angular momentum of the plate about …`
    fn balance_words(&self, balances: &[&Equation]) -> String {
        let mut linear: Vec<(String, Vec<String>)> = Vec::new();
        let mut angular: Vec<String> = Vec::new();
        let mut own = Vec::new();
        for e in balances {
            match &e.law {
                Law::LinearMomentum { system, along } => {
                    let whom = words::bodies(self.scene, system);
                    let whom = match system.len() {
                        1 => whom,
                        _ => whom + " together",
                    };
                    let along = super::block::direction(along);
                    match linear.iter_mut().find(|(w, _)| *w == whom) {
                        Some((_, all)) => all.push(along),
                        None => linear.push((whom, vec![along])),
                    }
                }
                Law::AngularMomentum { system, about } => match (about, system.as_slice()) {
                    (Place::Center(c), [b]) if c == b => own.push(*b),
                    _ => angular.push(format!(
                        "of {} about {}",
                        words::bodies(self.scene, system),
                        words::at(self.scene, *about)
                    )),
                },
                _ => {}
            }
        }
        match own.as_slice() {
            [] => {}
            [b] => angular.push(format!(
                "of {} about its center of mass",
                words::body(self.scene, *b)
            )),
            all => angular.push(format!(
                "of {}, each about its center of mass",
                words::bodies(self.scene, all)
            )),
        }
        let mut grouped: Vec<(Vec<String>, Vec<String>)> = Vec::new();
        for (whom, along) in linear {
            match grouped.iter_mut().find(|(_, a)| *a == along) {
                Some((all, _)) => all.push(whom),
                None => grouped.push((vec![whom], along)),
            }
        }
        let mut parts: Vec<String> = Vec::new();
        let linear: Vec<String> = grouped
            .into_iter()
            .map(|(whom, along)| {
                format!(
                    "of {} along {}",
                    words::listed(&whom),
                    words::listed(&along)
                )
            })
            .collect();
        if !linear.is_empty() {
            parts.push(format!("linear momentum {}", words::listed(&linear)));
        }
        if !angular.is_empty() {
            parts.push(format!("angular momentum {}", words::listed(&angular)));
        }
        format!("Balance {}", parts.join(", and "))
    }

    /// Change of momentum = impulses, in one line.
    fn short_balance(&mut self, equation: &Equation) {
        if let Law::AngularMomentum { system, about } = &equation.law
            && let [b] = system.as_slice()
            && *about == Place::Center(*b)
        {
            let change = self.spin_after(*b) - self.g.before(*b).1;
            let change = self.tidy(&change);
            let inertia = self.g.inertia(*b).clone();
            let inertia = self.tidy(&inertia);
            let moments = self.outside(system, Some(*about)).into_iter();
            let moments = Expr::sum(moments.map(|o| o.moment));
            self.claim(
                inertia * change,
                moments,
                "change of angular momentum = moments of the impulses",
            );
        } else if let Law::LinearMomentum { system, along } = &equation.law {
            self.linear_momentum(system, along, equation);
        } else {
            let (left, right) = self.sides(equation);
            let reason = self.law_words(&equation.law);
            self.claim(left, right, &reason);
        }
    }

    /// An equation in the impulses alone, each velocity put in from its balance: terms that belong to one body are one.
    fn for_impulses(
        &mut self,
        equation: &Equation,
        balances: &[&Equation],
        impulses: &[Unknown],
    ) -> (Expr, Expr) {
        let mut right = equation.known.clone();
        let mut terms: Vec<Vec<((usize, bool), Expr)>> = vec![Vec::new(); impulses.len()];
        let mut add = |i: usize, key: (usize, bool), value: Expr| match terms[i]
            .iter_mut()
            .find(|(k, _)| *k == key)
        {
            Some((_, sum)) => *sum = &*sum + &value,
            None => terms[i].push((key, value)),
        };
        for (u, k) in &equation.terms {
            if self.zero.contains(u) {
                continue;
            }
            if let Some(i) = impulses.iter().position(|p| p == u) {
                add(i, (usize::MAX, false), k.clone());
                continue;
            }
            let of = |e: &&&Equation| e.terms.iter().any(|(v, _)| v == u);
            let Some(balance) = balances.iter().find(of) else {
                right = right - k * &Expr::symbol(self.d.names.plain(*u));
                continue;
            };
            let Some((_, own)) = balance.terms.iter().find(|(v, _)| v == u) else {
                continue;
            };
            let factor = k / own;
            right = right - &factor * &balance.known;
            for (v, c) in &balance.terms {
                if let Some(i) = impulses.iter().position(|p| p == v) {
                    let key = match u {
                        Unknown::Velocity(b, _) => (*b, false),
                        Unknown::Spin(b) => (*b, true),
                        _ => (usize::MAX, false),
                    };
                    add(i, key, -(&factor * c));
                } else if v != u && !self.zero.contains(v) {
                    right = right + &factor * c * Expr::symbol(self.d.names.plain(*v));
                }
            }
        }
        let mut left = Vec::new();
        for (i, parts) in terms.into_iter().enumerate() {
            let sum = self.sum_by_parts(parts.into_iter().map(|(_, e)| e).collect());
            let factor = sum;
            left.push(Expr::symbol(self.d.names.plain(impulses[i])) * factor);
        }
        (Expr::sum(left), self.tidy(&right))
    }

    /// A sum whose terms stand each for a body, in its shortest form; equal ones are counted, not repeated.
    pub(super) fn sum_by_parts(&mut self, parts: Vec<Expr>) -> Expr {
        let mut counted: Vec<(Expr, i64)> = Vec::new();
        for part in parts {
            let tidy = self.tidy(&part);
            let part = neat(self.scene, &part);
            let part = if tidy.size() <= part.size() {
                tidy
            } else {
                part
            };
            match counted.iter_mut().find(|(e, _)| *e == part) {
                Some((_, n)) => *n += 1,
                None => counted.push((part, 1)),
            }
        }
        let sum = Expr::sum(counted.into_iter().map(|(e, n)| Expr::from(n) * e));
        let whole = self.tidy(&sum);
        if 3 * whole.size() <= 2 * sum.size() {
            whole
        } else {
            sum
        }
    }
}
