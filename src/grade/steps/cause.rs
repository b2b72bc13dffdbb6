//! From which wrong line a later one follows: what each wrong line implies is kept, and tried.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::FxHashMap;

use super::super::relation::{angle_in, follows, size_in, solve_for, under_root};
use super::link::Link;
use super::link::Values;
use super::{Desk, MOST_CAUSES, MOST_STATED};
use crate::algebra::{Sign, sign, tidy};
use crate::dimension::Dimension;
use crate::domain::Domain;
use crate::equality::{self};
use crate::expr::{Expr, Function, Node, Symbol, effort};
use crate::formula::{self, Content, Reading};
use crate::laws::{self, Geometry, Kinematics, Law, Unknown};
use crate::scene::{Ask, EnergyWhen, Question, Scene};

/// Most laws that may be used without being written.
const MOST_LAWS: usize = 10;

/// Most steps for the search of one line's cause.
pub(super) const MOST_STEPS: u64 = 600_000;

/// A name, and what stands for it.
type Rule = (Symbol, Expr);

impl Desk<'_> {
    /// The wrong line from which equations follow: they hold in the motion it implies, or say the same.
    pub(super) fn cause(&self, text: &str, link: &Link) -> Option<usize> {
        let differences = &link.differences;
        // A name that was defined with a slip, had it been defined without, or all that hang on one slip.
        let one = |(cause, name, value): &(usize, Symbol, Expr)| {
            (*cause, Values::from([(name.clone(), value.clone())]))
        };
        let mut slipped: Vec<(usize, Values)> = self.slipped.iter().rev().map(one).collect();
        let mut together: BTreeMap<usize, Values> = BTreeMap::new();
        for (cause, values) in &slipped {
            together.entry(*cause).or_default().extend(values.clone());
        }
        slipped.extend(together.into_iter().filter(|(_, values)| values.len() > 1));
        for (cause, values) in slipped {
            let own = differences.iter().map(|d| self.with_own_but(d, &values));
            let own: Vec<Expr> = own.collect();
            let uses = |d: &Expr| values.keys().any(|name| d.mentions(name));
            let meant: Vec<Expr> = own.iter().map(|d| d.substitute(&values)).collect();
            if own.iter().any(uses) && self.vanish(&meant, &Values::new()) {
                return Some(cause);
            }
        }
        // The latest first.
        let mut implied = self.believed.iter().rev();
        let found = implied.find(|(cause, values)| {
            self.vanish(differences, values)
                || self.is_rounded_after(text, link, values, Some(*cause))
        });
        let found = found.map(|(cause, _)| *cause);
        found.or_else(|| {
            let one = self.with_own(link.gap()?);
            if let Some(cause) = effort::within(MOST_STEPS, || self.supposed_with(&one)) {
                return Some(cause);
            }
            // What is found may have either sign: ω = −2 and v = −9 are not the same for having no positive solution both.
            let mut domains = self.sheet.scene.domains.clone();
            for name in one.symbols().into_iter().filter(|n| self.is_found(n)) {
                domains.symbols.entry(name).or_insert_with(Domain::real);
            }
            let moves = |e: &Expr| e.symbols().iter().any(|n| self.is_found(n));
            let said = self.wrong.iter().rev().take(8);
            // What is said of given quantities alone follows from nothing but itself.
            if !moves(&one) {
                let mut said = said.filter(|(_, f)| *f == one || *f == -&one);
                return said.next().map(|(cause, _)| *cause);
            }
            said.filter(|(_, f)| moves(f) && follows(f, &one, &domains))
                .map(|(cause, _)| *cause)
                .next()
                .or_else(|| effort::within(MOST_STEPS, || self.eliminated(&one)))
        })
    }

    /// Whether what vanishes is a sum of what is found, rather than a product, also of terms that fall away as those of H about G.
    pub(super) fn says_a_sum(&self, gap: &Expr) -> bool {
        let is_sum = |e: &Expr| matches!(e.node(), Node::Sum(_));
        let moves = |e: &Expr| e.symbols().iter().any(|n| self.is_found(n));
        let is_given = |e: &Expr| match e.node() {
            Node::Product(factors) => !factors.iter().any(|f| is_sum(f) && moves(f)),
            _ => !is_sum(e),
        };
        let tidied = || tidy(gap, &self.sheet.scene.domains);
        is_sum(gap) && tidied().is_ok_and(|gap| !is_given(&gap))
    }

    /// Notes equations for later lines.
    pub(super) fn state(&mut self, cause: Option<usize>, differences: &[Expr]) {
        let plain = |d: &Expr| self.without_sizes(&self.with_own(d));
        let all = differences.iter().map(|d| (cause, plain(d)));
        let all: Vec<_> = all.collect();
        self.stated.extend(all);
        let excess = self.stated.len().saturating_sub(MOST_STATED);
        self.stated.drain(..excess);
    }

    /// An equation with what is found in the place of its size, by the sign that it has in truth: −ω for |ω|.
    fn without_sizes(&self, e: &Expr) -> Expr {
        let Node::Call(Function::Abs, x) = e.node() else {
            return e.map_parts(|part| self.without_sizes(part));
        };
        let truth = x.as_symbol().and_then(|name| self.closed.get(name));
        match truth.and_then(|truth| sign(truth, &self.sheet.scene.domains)) {
            Some(Sign::Positive | Sign::NotNegative) => x.clone(),
            Some(Sign::Negative | Sign::NotPositive) => -x,
            _ => e.clone(),
        }
    }

    /// Whether an equation above that holds says what a quantity is, of what is given alone.
    pub(super) fn is_settled(&self, name: &Symbol) -> bool {
        let parameters = &self.sheet.scene.parameters;
        let given = |n: &Symbol| &**n == "pi" || parameters.iter().any(|p| p.name == *n);
        let mut held = self.stated.iter().filter(|(cause, _)| cause.is_none());
        held.any(|(_, e)| {
            let mut others = e.symbols();
            others.remove(name) && others.iter().all(given)
        })
    }

    /// The wrong line that makes an equation follow from those above it: they are solved for one name after another, first
    /// the wrong line and what hangs on it, and put in.
    fn eliminated(&self, one: &Expr) -> Option<usize> {
        let domains = &self.sheet.scene.domains;
        // What a question asks of a parameter is that parameter where the lines above hold.
        let used = one.symbols();
        let one = &self.by_parameter(one);
        let mut causes: Vec<usize> = self.stated.iter().filter_map(|(c, _)| *c).collect();
        causes.sort_unstable();
        causes.dedup();
        causes.reverse();
        causes.truncate(MOST_CAUSES);
        let reduced = |e: &Expr, rules: &[Rule]| {
            let rules = rules.iter();
            rules.fold(e.clone(), |e, (name, root)| e.put(name, root))
        };
        // Without one law or another the lines before it lead to the same rules.
        let solved: RefCell<FxHashMap<(Expr, bool), Option<Rule>>> = RefCell::default();
        let rule = |line: Expr, again: bool| {
            if let Some(rule) = solved.borrow().get(&(line.clone(), again)) {
                return rule.clone();
            }
            let rule = self.rule(&line, |name| again && !used.contains(name));
            let mut solved = solved.borrow_mut();
            solved.entry((line, again)).or_insert(rule).clone()
        };
        let follows = |causes: &[usize], laws: &[&Expr], again: bool| {
            let hangs = |c: &Option<usize>| c.is_some_and(|c| causes.contains(&c));
            let wrong = self.stated.iter().filter(|(c, _)| hangs(c));
            let right = self.stated.iter().filter(|(c, _)| c.is_none());
            let laws = right.map(|(_, line)| line).chain(laws.iter().copied());
            // A balance of energies speaks of several squares until what binds them is put in, or is first solved for what
            // the equation is about: that is tried again.
            let found = |e: &Expr| {
                let mut names = e.symbols();
                names.retain(|name| self.is_found(name));
                names
            };
            let spoken: BTreeSet<Symbol> = wrong.clone().flat_map(|(_, e)| found(e)).collect();
            let (binding, others): (Vec<&Expr>, Vec<&Expr>) = laws.partition(|law| {
                let names = found(law);
                let linear = |name: &Symbol| solve_for(law, name, domains).is_some();
                let binds = names.is_subset(&spoken) || names.iter().all(linear);
                again && names.len() > 1 && binds
            });
            let mut rules: Vec<Rule> = Vec::new();
            let wrong = wrong.map(|(_, line)| line);
            for line in binding.into_iter().chain(wrong).chain(others) {
                // What says nothing new, or contradicts those before, gives no rule.
                rules.extend(rule(reduced(line, &rules), again));
            }
            equality::vanishes(&reduced(one, &rules), domains)
        };
        let orders = |again: usize| {
            let ways = [false, true].into_iter().take(1 + again);
            ways.flat_map(|again| causes.iter().map(move |cause| (*cause, again)))
        };
        let found = orders(1).find(|(cause, again)| follows(&[*cause], &[], *again));
        let found = found.map(|(cause, _)| cause);
        found
            .or_else(|| {
                // The wrong line stands in place of one law; the others may be used for a result without being written.
                let symbols = one.symbols();
                let results = symbols.iter().filter(|n| self.is_found(n)).count();
                let laws = match results {
                    1 => self.unwritten(one),
                    _ => Vec::new(),
                };
                let without = |j: usize| -> Vec<&Expr> {
                    let others = laws.iter().enumerate().filter(|(i, _)| *i != j);
                    others.map(|(_, law)| law).collect()
                };
                // Of a story the laws of impacts are not among them, and it may stand in place of one of those.
                let others = usize::from(!self.sheet.scene.stages.is_empty());
                let found = orders(usize::from(!laws.is_empty())).find(|(cause, again)| {
                    let mut one = 0..laws.len() + others;
                    one.any(|j| follows(&[*cause], &without(j), *again))
                });
                found.map(|(cause, _)| cause)
            })
            // It may take several slips together.
            .or_else(|| {
                causes
                    .first()
                    .copied()
                    .filter(|_| causes.len() > 1 && follows(&causes, &[], false))
            })
    }

    /// A line solved for one of the names that are found, those first that are not last.
    fn rule(&self, line: &Expr, last: impl Fn(&Symbol) -> bool) -> Option<Rule> {
        let domains = &self.sheet.scene.domains;
        let symbols = line.symbols();
        let mut found: Vec<&Symbol> = symbols.iter().filter(|n| self.is_found(n)).collect();
        found.sort_by_key(|name| last(name));
        let ways = [solve_for, angle_in, size_in, under_root];
        ways.iter().find_map(|way| {
            let mut found = found.iter();
            found.find_map(|n| {
                // That a given quantity is nothing, says a law that contradicts the lines before it.
                let given = self.is_given(n);
                let root = way(line, n, domains).filter(|root| !given || !root.is_zero())?;
                Some(((*n).clone(), root))
            })
        })
    }

    /// A line `name = …` that holds says what the name is under every belief about the others.
    pub(super) fn carry(&mut self, reading: &Reading) {
        let Some(([left, .., right], _)) = reading.content.relations() else {
            return;
        };
        let Some(name) = left.name() else {
            return;
        };
        let is_vector = self.components(name).is_some();
        let told = match (is_vector, right.expr()) {
            (true, _) => self.along(name, right).unwrap_or_default(),
            (false, Some(value)) => vec![(name.clone(), self.with_own(value))],
            _ => return,
        };
        let mut causes = Vec::new();
        let mut believed = std::mem::take(&mut self.believed);
        for (cause, values) in &mut believed {
            for (name, value) in &told {
                let used = value.symbols();
                if values.keys().any(|n| used.contains(n)) && !values.contains_key(name) {
                    // A believed vector may stand on another name that is believed.
                    let implied = self.with_own(&value.substitute(values)).substitute(values);
                    values.insert(name.clone(), implied);
                    causes.push(*cause);
                }
            }
        }
        self.believed = believed;
        causes.dedup();
        for cause in causes.into_iter().filter(|_| is_vector).take(MOST_CAUSES) {
            self.balance(cause, name);
        }
    }

    /// The components of a name with an arrow, and what a side says they are.
    fn along(&self, name: &Symbol, side: &Content) -> Option<Vec<Rule>> {
        let zero = side.expr().is_some_and(Expr::is_zero);
        let value = match zero {
            true => [0; 3].map(|_| Expr::zero()),
            false => self.vector(side, true)?,
        };
        Some(formula::along_axes(name).into_iter().zip(value).collect())
    }

    /// Keeps what a line with a slip says a vector is, as of `\vec{H}_C^{-} = …`, and what its balance says then; nothing of a line
    /// about something else.
    pub(super) fn believe_vector(&mut self, cause: usize, links: &[Link]) -> Option<()> {
        let (first, last) = (links.first()?, links.last()?);
        let name = first.sides[0].name()?;
        let is_spin = self.spins.contains_key(name);
        let named = Some(name).filter(|name| formula::has_arrow(name) && !is_spin);
        let along = self.along(named?, &last.sides[1])?;
        let mut earlier = self.believed.iter().rev();
        let earlier = earlier.find(|(c, _)| *c == cause);
        let mut values = earlier.map(|(_, v)| v.clone()).unwrap_or_default();
        values.extend(along);
        self.believed.push((cause, values));
        self.balance(cause, name);
        Some(())
    }

    /// What a belief about H before or after an impact says where H is the same in truth.
    fn balance(&mut self, cause: usize, name: &Symbol) {
        let Some((base, _, mark)) = formula::vector_name(name) else {
            return;
        };
        let other = match &*mark {
            "^-" => "^+",
            "^+" | "'" => "^-",
            _ => return,
        };
        let stem = name.trim_end_matches(&*mark);
        let other = Symbol::from(format!("{stem}{other}_z"));
        let mine = Symbol::from(format!("{name}_z"));
        let gap = Expr::symbol(&mine) - Expr::symbol(&other);
        let Some(truth) = self.parts.get(&other).filter(|_| base == "H") else {
            return;
        };
        if !self.is_zero(&gap) {
            return;
        }
        let of = |name: &Symbol| {
            let all = self.believed.iter().rev();
            let all = all.filter_map(|(_, values)| values.get(name)).cloned();
            all.take(MOST_CAUSES).collect::<BTreeSet<_>>()
        };
        let mut theirs = of(&other);
        theirs.insert(truth.clone());
        let mine = of(&mine);
        let gaps = mine.iter().flat_map(|a| theirs.iter().map(move |b| a - b));
        let gaps: Vec<Expr> = gaps.map(|gap| self.with_own(&gap)).collect();
        let wrong: Vec<&Expr> = gaps.iter().filter(|gap| self.says_a_sum(gap)).collect();
        let wrong = wrong.into_iter().map(|gap| (cause, gap.clone()));
        self.wrong.extend(wrong);
        self.believe(cause, &gaps);
        self.state(Some(cause), &gaps);
    }

    /// In a motion with one freedom all velocities are what they are, times the same wrong number; and what comes in later
    /// stages is what it would be had the bodies come in faster by that number.
    pub(super) fn carry_along(&self, name: &Symbol, root: &Expr, values: &mut Values) {
        let Some(truth) = self.closed.get(name).filter(|t| !t.is_zero()) else {
            return;
        };
        if !self.moving.contains(name) {
            return;
        }
        let ratio = root * &truth.powi(-1);
        for other in self.moving.iter().filter(|other| *other != name) {
            if let Some(value) = self.closed.get(other) {
                values
                    .entry(other.clone())
                    .or_insert_with(|| value * &ratio);
            }
        }
        let Some(speed) = self.incoming() else {
            return;
        };
        let faster = &Expr::symbol(&speed) * &ratio;
        for other in self.later() {
            if let Some(value) = self.closed.get(&other) {
                values
                    .entry(other)
                    .or_insert_with(|| value.put(&speed, &faster));
            }
        }
    }

    /// The given speed to which all velocities and spins before the impact are proportional.
    fn incoming(&self) -> Option<Symbol> {
        let scene = &self.sheet.scene;
        let bodies = scene.bodies.iter();
        let parts = bodies.flat_map(|b| b.velocity.iter().chain([&b.spin]));
        let moving: Vec<&Expr> = parts.filter(|part| !part.is_zero()).collect();
        let rate = Dimension::new(0, 0, -1);
        let per_time = |d: &Dimension| *d == rate || *d == rate.times(&Dimension::new(0, 1, 0));
        let mut given = scene.parameters.iter().filter(|p| per_time(&p.dimension));
        let found = given.find(|p| {
            let twice = &Expr::symbol(&p.name) * &Expr::from(2);
            moving.iter().all(|part| {
                let doubled = &part.put(&p.name, &twice) - &(*part * &Expr::from(2));
                self.is_zero(&doubled)
            })
        });
        found.filter(|_| !moving.is_empty()).map(|p| p.name.clone())
    }

    /// Answers about stages behind the impact.
    fn later(&self) -> Vec<Symbol> {
        let scene = &self.sheet.scene;
        let behind = |q: &&Question| q.stage > Some(0);
        let questions: Vec<&Question> = scene.questions.iter().filter(behind).collect();
        let answers = self.sheet.derivation.answers.iter();
        let of_them = answers.filter(|a| questions.iter().any(|q| q.name == a.question));
        of_them.map(|a| Symbol::from(a.name.as_str())).collect()
    }

    /// The laws that hold in truth: those of the impact, and of the motions of a story; and what is supposed of a parameter that
    /// a line speaks of.
    fn unwritten(&self, line: &Expr) -> Vec<Expr> {
        let motions = self.sheet.laws.iter().filter(|law| self.is_zero(law));
        let mut all = self.of_impact();
        all.extend_from_slice(&self.linked);
        all.extend(motions.take(MOST_LAWS).cloned());
        let sought = self.sought.iter().filter(|s| line.mentions(&s.parameter));
        all.extend(sought.filter_map(|s| s.condition.clone()));
        all
    }

    /// The scene of the impact, with what an earlier stage hands on by the name of the answer that gives it.
    fn with_named_motion(&self) -> Scene {
        let mut scene = self.sheet.scene.clone();
        let earlier = self.sheet.scene.questions.iter();
        let earlier = earlier.filter(|q| {
            q.stage.is_some() && matches!(q.ask, Ask::Velocity { .. } | Ask::Spin { .. })
        });
        let values: Vec<(Expr, &Expr)> = earlier
            .filter_map(|q| Some((Expr::symbol(&q.name), self.closed.get(q.name.as_str())?)))
            .filter(|(_, value)| value.as_symbol().is_none() && !value.is_constant())
            .collect();
        let parts = scene.bodies.iter_mut();
        for part in parts.flat_map(|b| b.velocity.iter_mut().chain([&mut b.spin])) {
            let named = values.iter().find_map(|(name, value)| match () {
                () if **value == *part => Some(name.clone()),
                () if -*value == *part => Some(-name),
                () => None,
            });
            if let Some(named) = named {
                *part = named;
            }
        }
        scene
    }

    /// The laws of the impact in the names of its unknowns, and what these are called where they are asked for; none where
    /// they are many.
    fn of_impact(&self) -> Vec<Expr> {
        let scene = &self.with_named_motion();
        let names = &self.sheet.derivation.names;
        let laws = laws::of(scene);
        if laws.len() > MOST_LAWS || !scene.stages.is_empty() {
            return Vec::new();
        }
        let g = Geometry::symbolic(scene);
        let motion = Kinematics::full(scene, &g);
        let named = |unknown: Unknown| names.signed(unknown, Expr::symbol(names.plain(unknown)));
        let equation = |law: &Law| {
            let linear = laws::symbolic(scene, &g, &motion, law);
            let terms = linear.terms.iter().map(|(u, k)| k * &named(*u));
            Expr::sum(terms) - linear.known
        };
        let mut all: Vec<Expr> = laws.iter().map(equation).collect();
        // The energy that is lost, or left, is that of the velocities.
        for q in scene.asked_of_impact() {
            let Ask::Energy { when, of: None } = q.ask else {
                continue;
            };
            let kinetic = |after: bool| {
                let free = scene
                    .bodies
                    .iter()
                    .enumerate()
                    .filter(|(_, b)| !b.is_fixed());
                let each = free.map(|(k, b)| {
                    let [x, y] = [0, 1].map(|axis| match after {
                        true => named(Unknown::Velocity(k, axis)),
                        false => b.velocity[axis].clone(),
                    });
                    let spin = match (after, b.is_particle()) {
                        (true, false) => named(Unknown::Spin(k)),
                        _ => b.spin.clone(),
                    };
                    let twice = &b.mass * &(x.powi(2) + y.powi(2)) + &b.inertia * &spin.powi(2);
                    twice * Expr::ratio(1, 2)
                });
                Expr::sum(each)
            };
            let name = Expr::symbol(&q.name);
            match when {
                EnergyWhen::Before => {}
                EnergyWhen::After => all.push(name - kinetic(true)),
                EnergyWhen::Lost => all.push(name - kinetic(false) + kinetic(true)),
            }
        }
        for unknown in laws::unknowns(scene) {
            let name = Symbol::from(names.plain(unknown));
            let Some(value) = self.closed.get(&name).filter(|v| !v.is_zero()) else {
                continue;
            };
            let others = self.closed.iter().filter(|(other, _)| **other != name);
            let same = others.filter(|(_, v)| *v == value);
            all.extend(same.map(|(other, _)| Expr::symbol(other) - Expr::symbol(&name)));
        }
        all
    }
}
