//! Blocks of equations: which question they answer, which law each line is, and how they are solved.

use super::words::{self, fill, say};
use super::{Claim, Detail, Inline, Line, Math, Part, Writer};
use crate::derive::{Block, Equation};
use crate::expr::{Expr, Symbol};
use crate::laws::{Direction, Law, Place, Unknown};
use crate::scene::{Ask, ContactLaw, EnergyWhen, KnownQuantity, Question};

/// Above this many equations in a block the balances are not written out in vectors.
const WRITTEN_OUT: usize = 3;

/// Above this many nodes a solution stands below, in named parts.
const LONG: usize = 150;

impl Writer<'_> {
    /// Every block with the question that needs it, then what the question still asks.
    pub(super) fn blocks(&mut self) {
        let (mut kept, mut blocks): (Vec<&Block>, Vec<&Block>) = (Vec::new(), Vec::new());
        for block in self.d.blocks.iter().filter(|b| b.asked_by.is_some()) {
            let list = if self.is_kept(block) {
                &mut kept
            } else {
                &mut blocks
            };
            list.push(block);
        }
        for question in self.scene.asked_of_impact() {
            let asked = |b: &&&Block| b.asked_by.as_deref() == Some(question.name.as_str());
            let mine: Vec<&Block> = blocks.iter().filter(asked).copied().collect();
            let derived = self.is_derived(question);
            let renamed = mine.is_empty() && self.is_renamed(question);
            let begins = !mine.is_empty() || kept.iter().any(|b| asked(&b));
            if !begins && !derived {
                continue;
            }
            let several = mine
                .iter()
                .any(|b| b.unknowns.len() >= 4 && b.unknowns.iter().any(|u| u.is_impulse()));
            let heading = if several {
                vec![say("Just after the collision")]
            } else {
                self.heading(question)
            };
            // Another name for what has just been found needs no heading.
            if !renamed || self.solution.sections.is_empty() {
                self.section(heading);
            }
            // What no impulse changes is told before anything else, and not carried along.
            if begins && !kept.is_empty() {
                self.keeps(&std::mem::take(&mut kept));
            }
            let mut at = 0;
            while at < mine.len() {
                if at + 1 < mine.len() && pair(mine[at], mine[at + 1]) {
                    self.momentum_pair(mine[at], mine[at + 1]);
                    at += 2;
                } else {
                    self.block(mine[at]);
                    at += 1;
                }
            }
            if derived {
                self.derived(question);
            }
        }
    }

    /// The heading of a question: what it asks for, and its symbol.
    pub(super) fn heading(&self, question: &Question) -> Vec<Inline> {
        let body = |b: usize| words::body(self.scene, b);
        if question.hidden {
            return vec![say("The motion just after")];
        }
        let text = match &question.ask {
            Ask::Velocity { body: b, point, .. } => match point {
                Some((name, _)) if *name != self.scene.bodies[*b].name => {
                    format!("Velocity of {name} on {}", body(*b))
                }
                _ => format!("Velocity of {}", body(*b)),
            },
            Ask::Spin { body: b, .. } => format!("Angular velocity of {}", body(*b)),
            Ask::Impulse { from, on, .. } => {
                let at = words::at(self.scene, Place::of(self.scene, *from).0);
                format!("Impulse at {at} on {}", body(*on))
            }
            Ask::Energy { when, of } => {
                let whose = of.map_or(String::new(), |b| format!(" of {}", body(b)));
                match when {
                    EnergyWhen::Before => format!("Kinetic energy{whose} before"),
                    EnergyWhen::After => format!("Kinetic energy{whose} after"),
                    EnergyWhen::Lost => match of {
                        Some(b) => format!("Kinetic energy lost by {}", body(*b)),
                        None => String::from("Kinetic energy lost"),
                    },
                }
            }
            Ask::Balance { system, .. } => {
                format!("Linear momentum of {}", words::bodies(self.scene, system))
            }
            Ask::Matrix { .. } => String::from("Matrix form"),
            // About other answers: no block of equations is solved for it.
            _ => String::new(),
        };
        match &question.ask {
            Ask::Velocity { along: Some(d), .. }
            | Ask::Impulse { along: Some(d), .. }
            | Ask::Balance { along: d, .. } => {
                let along = Inline::Math(vec![d.clone().into()]);
                fill("{} along {}", [say(text), along])
            }
            _ => vec![say(text)],
        }
    }

    fn block(&mut self, block: &Block) {
        let n = block.equations.len();
        if self.detail() == Detail::Brief {
            for equation in &block.equations {
                self.key_equation(equation);
            }
        } else if n == 1 {
            self.name_impulses(block);
            self.balance(&block.equations[0], true);
        } else if self.told_through(block) {
            return;
        } else {
            self.name_impulses(block);
            let unknowns: Vec<Inline> = self.symbols(&block.unknowns);
            let count = words::count(n);
            let lead = fill("{} equations determine ", [say(words::capital(&count))]);
            self.text([lead, unknowns, vec![say(".")]].concat());
            for equation in &block.equations {
                self.balance(equation, n <= WRITTEN_OUT);
            }
        }
        // Homogeneous equations that are independent need no solving.
        let mut sides = block.equations.iter().map(|e| self.sides(e).1);
        let vanish = sides.all(|right| right.is_zero());
        let lead = match vanish && self.d.solution(block).iter().all(Expr::is_zero) {
            true => "They are homogeneous and independent, so",
            false => "Solving them gives",
        };
        self.solved(&[block], lead);
    }

    /// `ω₁, v_x and P`.
    pub(super) fn symbols(&self, unknowns: &[Unknown]) -> Vec<Inline> {
        let plain = |u: &Unknown| words::formula(&Expr::symbol(self.d.names.plain(*u)));
        words::row(unknowns.iter().map(plain), " and ")
    }

    /// The key equation alone, for the brief solution.
    fn key_equation(&mut self, equation: &Equation) {
        let (left, right) = self.sides(equation);
        let reason = self.law_words(&equation.law);
        self.text(vec![say(format!("{}:", words::capital(&reason)))]);
        self.claim(left, right, &reason);
    }

    /// A law's two sides in the scene's symbols.
    pub(super) fn sides(&self, equation: &Equation) -> (Expr, Expr) {
        let symbol = |u| Expr::symbol(self.d.names.plain(u));
        let terms = equation
            .terms
            .iter()
            .filter(|(u, _)| !self.zero.contains(u));
        let left = Expr::sum(terms.map(|(u, k)| k * &symbol(*u)));
        (left, equation.known.clone())
    }

    /// A law in the words of a solution.
    pub(super) fn law_words(&self, law: &Law) -> String {
        match law {
            Law::LinearMomentum { system, along } => format!(
                "linear momentum of {} along {}",
                words::bodies(self.scene, system),
                direction(along)
            ),
            Law::AngularMomentum { system, about } => format!(
                "angular momentum of {} about {}",
                words::bodies(self.scene, system),
                words::about(self.scene, system, *about)
            ),
            Law::Restitution(c) => {
                let at = words::at(self.scene, Place::Contact(*c));
                let contact = &self.scene.contacts[*c];
                let rebounds = !matches!(&contact.law, ContactLaw::Frictionless { restitution } if restitution.is_zero());
                match self.scene.figure.string(&contact.name) {
                    Some(_) if !rebounds => match words::place(&contact.name, "string") {
                        letter if letter == contact.name => {
                            format!("constant length of the string {letter}")
                        }
                        string => format!("constant length of {string}"),
                    },
                    _ if !rebounds => format!("no rebound at {at}"),
                    _ => format!("restitution at {at}"),
                }
            }
            Law::Hinged(h, axis) => {
                format!(
                    "the hinge {} along {}",
                    self.scene.hinges[*h].name, AXES[*axis]
                )
            }
            Law::Condition(..) | Law::Sticking(..) => crate::laws::describe(self.scene, law),
            Law::Given(k) => {
                let known = &self.scene.after[*k];
                let body = words::body(self.scene, known.body);
                match known.what {
                    KnownQuantity::Velocity { to: Some(to), .. } => {
                        let to = words::body(self.scene, to);
                        format!("the given velocity of {body} relative to {to}")
                    }
                    KnownQuantity::Velocity { .. } => format!("the given velocity of {body}"),
                    KnownQuantity::Spin => format!("the given spin of {body}"),
                }
            }
        }
    }

    /// The values of a block's unknowns, and how they follow; `lead` stands before those of several equations.
    pub(super) fn solved(&mut self, blocks: &[&Block], lead: &str) {
        let equations = blocks.iter().flat_map(|b| &b.equations);
        let sides = equations.map(|e| self.sides(e));
        let before: Vec<Claim> = sides.map(|(left, right)| Claim::new(left, right)).collect();
        let unknowns = blocks.iter();
        let pairs: Vec<(Unknown, Expr)> = unknowns
            .flat_map(|b| b.unknowns.iter().copied().zip(self.d.solution(b)))
            .collect();
        if self.reads_solved(&before, &pairs) {
            return;
        }
        let shown = pairs
            .iter()
            .map(|(u, v)| self.with_roots(&self.short(*u, v)));
        let shown: Vec<Expr> = shown.collect();
        self.abbreviations(&shown);
        // The parts of a long value have names where the results stand.
        let has_parts = !self.d.definitions.is_empty();
        let too_long = has_parts && shown.iter().any(|e| e.size() > LONG);
        let lead = if too_long { "" } else { lead };
        let mut substeps = Vec::new();
        if self.detail() == Detail::Full && !lead.is_empty() {
            substeps = self.substeps(|writer| {
                for block in blocks {
                    writer.eliminate(block);
                }
            });
        } else {
            let mut earlier = earlier(blocks);
            earlier.retain(|u| !self.zero.contains(u));
            if !earlier.is_empty() && blocks[0].equations.len() == 1 {
                let known = self.symbols(&earlier);
                self.text([vec![say("With ")], known, vec![say(" from above,")]].concat());
            } else if blocks[0].equations.len() > 1 && !lead.is_empty() {
                self.say(lead);
            }
        }
        let mut after = Vec::new();
        let mut lines = Vec::new();
        for ((u, value), shown) in pairs.iter().zip(&shown) {
            let symbol = Expr::symbol(self.d.names.plain(*u));
            lines.push(words::related(&symbol, "=", shown));
            after.push(Claim::new(symbol, value.clone()));
        }
        let id = self.step(before, after, "solving for the unknowns");
        let divisors: Vec<Expr> = blocks.iter().flat_map(|b| b.divided_by.clone()).collect();
        let conditions: Vec<String> = divisors
            .iter()
            .map(|e| format!("{} ≠ 0", crate::formula::write_plain(e)))
            .collect();
        if let Some(step) = self.last_step() {
            step.assumptions = conditions;
            step.substeps = substeps;
        }
        if too_long {
            self.say("The solution of these equations is long; it stands below.");
        } else {
            let lines = lines.into_iter().map(|math| Line {
                math,
                step: Some(id.clone()),
            });
            let unknowns = pairs.iter().map(|(u, _)| *u);
            self.found(unknowns.zip(lines).collect());
            self.comes_later(blocks, &shown);
        }
        let zero = pairs.iter().filter(|(_, value)| value.is_zero());
        self.zero.extend(zero.map(|(u, _)| *u));
        for divisor in &divisors {
            let divisor = [words::formula(divisor)];
            self.text(fill("This divides by {}, which must not be zero.", divisor));
        }
    }

    /// Whether a single equation already reads `unknown = value`, and so needs no further line.
    fn reads_solved(&mut self, before: &[Claim], pairs: &[(Unknown, Expr)]) -> bool {
        let ([claim], [(u, value)]) = (before, pairs) else {
            return false;
        };
        let name = self.d.names.plain(*u);
        if claim.left != Expr::symbol(name) || claim.right != *value {
            return false;
        }
        let is_asked = self.d.answers.iter().any(|a| a.name == name);
        self.told.insert(Symbol::from(name));
        let is_left_out = value.is_zero() && (is_asked || !self.makes_an_answer(*u));
        self.zero.extend(is_left_out.then_some(*u));
        if is_asked && let Some(line) = self.take_last_line() {
            self.push(Part::Result(vec![line]));
        }
        true
    }

    /// Shows the values of unknowns, those that are asked for boxed and last.
    fn found(&mut self, lines: Vec<(Unknown, Line)>) {
        let is_asked = |u: &Unknown| {
            let name = self.d.names.plain(*u);
            self.d.answers.iter().any(|a| a.name == name)
        };
        let (answers, mut others): (Vec<_>, Vec<_>) =
            lines.into_iter().partition(|(u, _)| is_asked(u));
        // A velocity that a contact gives stands there already.
        let section = self.solution.sections.last();
        others.retain(|(_, line)| !section.is_some_and(|s| s.shows(&line.math)));
        for (i, (_, mut line)) in others.into_iter().enumerate() {
            if i == 0 && matches!(self.last_part(), Some(Part::Display(_))) {
                line.math.insert(0, Math::Op("⇒"));
            }
            self.show(line.math, line.step);
        }
        if answers.is_empty() {
            return;
        }
        let names = answers
            .iter()
            .map(|(u, _)| Symbol::from(self.d.names.plain(*u)));
        self.told.extend(names);
        let boxed: Vec<Line> = answers.into_iter().map(|(_, line)| line).collect();
        // An equation that is the value already stands in the box alone.
        let parts = self.solution.sections.last_mut().map(|s| &mut s.parts);
        for part in parts.into_iter().flatten() {
            if let Part::Display(lines) = part
                && !lines.iter().all(|l| boxed.iter().any(|b| b.math == l.math))
            {
                lines.retain(|l| boxed.iter().all(|b| b.math != l.math));
            }
        }
        self.push(Part::Result(boxed));
    }

    /// Says of impulses that results are written with, and that are not found yet, what they are and that they come.
    fn comes_later(&mut self, blocks: &[&Block], shown: &[Expr]) {
        let known = earlier(blocks);
        let found = blocks.iter().flat_map(|b| &b.unknowns).chain(&known);
        let found: Vec<&str> = found.map(|u| self.d.names.plain(*u)).collect();
        let all = self.d.blocks.iter().flat_map(|b| &b.unknowns);
        for (u, name) in all.map(|u| (u, self.d.names.plain(*u))) {
            let is_used = shown.iter().any(|e| e.mentions(name));
            let symbol = Symbol::from(name);
            if !is_used || found.contains(&name) || self.told.contains(&symbol) {
                continue;
            }
            let place = match u {
                Unknown::Normal(c) | Unknown::Contact(c, _) => Place::Contact(*c),
                Unknown::Hinge(h, _) => Place::Hinge(*h),
                _ => continue,
            };
            let [of, at] = [
                words::formula(&Expr::symbol(&symbol)),
                say(words::at(self.scene, place)),
            ];
            self.text(fill("{} is the impulse at {}, found below.", [of, at]));
        }
    }

    /// Whether an answer under another name is made of this component of a velocity, or of this spin.
    fn makes_an_answer(&self, unknown: Unknown) -> bool {
        let mut asks = self.scene.questions.iter().map(|q| &q.ask);
        asks.any(|ask| match (ask, unknown) {
            (Ask::Velocity { body, along, .. }, Unknown::Velocity(b, axis)) => {
                let is_across = along.as_ref().is_some_and(|d| d[axis].is_zero());
                *body == b && !is_across
            }
            (Ask::Velocity { body, .. } | Ask::Spin { body, .. }, Unknown::Spin(b)) => *body == b,
            _ => false,
        })
    }

    /// Takes the line away that was displayed last.
    fn take_last_line(&mut self) -> Option<Line> {
        let parts = &mut self.solution.sections.last_mut()?.parts;
        let Some(Part::Display(lines)) = parts.last_mut() else {
            return None;
        };
        let line = lines.pop();
        if lines.is_empty() {
            parts.pop();
        }
        line
    }

    fn last_part(&self) -> Option<&Part> {
        self.solution.sections.last().and_then(|s| s.parts.last())
    }

    /// The short form of an unknown's value where an answer has one.
    pub(super) fn short(&self, unknown: Unknown, value: &Expr) -> Expr {
        let name = self.d.names.plain(unknown);
        for answer in &self.d.answers {
            if let crate::answer::Form::Value { closed, short } = &answer.form
                && answer.name == name
                && closed == value
                && short.size() < value.size()
            {
                return short.clone();
            }
        }
        value.clone()
    }

    /// Two balances of the same system along x and y, told as one balance of vectors.
    fn momentum_pair(&mut self, x: &Block, y: &Block) {
        if self.detail() == Detail::Brief {
            self.block(x);
            return self.block(y);
        }
        let (ex, ey) = (&x.equations[0], &y.equations[0]);
        let Law::LinearMomentum { system, .. } = &ex.law else {
            return;
        };
        self.momentum_vector(system, ex, ey);
        self.solved(&[x, y], "");
    }
}

pub(super) const AXES: [&str; 2] = ["x", "y"];

pub(super) fn direction(along: &Direction) -> String {
    match along {
        Direction::X => String::from("x"),
        Direction::Y => String::from("y"),
        Direction::Named(name, _) => name.clone(),
    }
}

/// The unknowns of the blocks' equations that were found before.
fn earlier(blocks: &[&Block]) -> Vec<Unknown> {
    let mut found = Vec::new();
    for (u, _) in blocks
        .iter()
        .flat_map(|b| &b.equations)
        .flat_map(|e| &e.terms)
    {
        if !blocks.iter().any(|b| b.unknowns.contains(u)) && !found.contains(u) {
            found.push(*u);
        }
    }
    found
}

/// Whether two blocks are one balance of linear momentum along x and along y.
fn pair(one: &Block, two: &Block) -> bool {
    let ([a], [b]) = (one.equations.as_slice(), two.equations.as_slice()) else {
        return false;
    };
    matches!(
        (&a.law, &b.law),
        (
            Law::LinearMomentum { system: s, along: Direction::X },
            Law::LinearMomentum { system: t, along: Direction::Y },
        ) if s == t
    )
}
