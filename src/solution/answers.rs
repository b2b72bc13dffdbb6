//! Quantities that follow from what the blocks determine: velocities of points, components, energies, equations asked for.

use super::words::{self, say, vector};
use super::{Claim, Detail, Inline, Line, Math, Part, Writer, full_sentence};
use crate::answer::{Answer, Form};
use crate::expr::{Expr, Symbol, Vector, dot, minus};
use crate::laws::{self, Place};
use crate::scene::{Ask, EnergyWhen, ImpulseAt, Question};

/// Nodes of a symbol, or of its opposite: a component that has a name.
const NAMED: usize = 3;

impl Writer<'_> {
    /// Whether a question asks for more than the unknowns of the blocks.
    pub(super) fn is_derived(&self, question: &Question) -> bool {
        // A brief solution tells where an energy comes from; velocities and impulses follow from its key equations.
        let is_told = self.detail() != Detail::Brief || matches!(question.ask, Ask::Energy { .. });
        if !is_told || self.is_open(question) {
            return false;
        }
        self.answers_of(question).iter().any(|a| {
            let solved = self
                .d
                .blocks
                .iter()
                .flat_map(|b| &b.unknowns)
                .any(|u| self.d.names.plain(*u) == a.name);
            let given = self
                .d
                .given
                .iter()
                .any(|(u, _)| self.d.names.plain(*u) == a.name);
            !solved && !given
        })
    }

    /// Whether a question asks for a component of a velocity that has a name of its own already.
    pub(super) fn is_renamed(&mut self, question: &Question) -> bool {
        let Ask::Velocity {
            body,
            point: None,
            along: Some(d),
        } = &question.ask
        else {
            return false;
        };
        let v = self.velocity_after(*body);
        let raw = &v[0] * &d[0] + &v[1] * &d[1];
        raw.size() <= NAMED
            && raw.symbols().iter().all(|s| {
                let solved = self.d.blocks.iter().flat_map(|b| &b.unknowns);
                let mut solved = solved.filter(|u| *self.d.names.plain(**u) == **s);
                solved.next().is_some()
            })
    }

    /// Whether the laws leave the answer open.
    pub(super) fn is_open(&self, question: &Question) -> bool {
        self.answers_of(question)
            .iter()
            .any(|a| matches!(a.form, Form::Open(_)))
    }

    fn answers_of(&self, question: &Question) -> Vec<Answer> {
        let mine = self
            .d
            .answers
            .iter()
            .filter(|a| a.question == question.name);
        mine.cloned().collect()
    }

    /// The lines from the motion to what a question asks.
    pub(super) fn derived(&mut self, question: &Question) {
        let answers = self.answers_of(question);
        match &question.ask {
            Ask::Velocity { body, point, along } => {
                let at = point
                    .as_ref()
                    .map_or(self.scene.bodies[*body].center.clone(), |(_, at)| {
                        at.clone()
                    });
                let point_name = match point {
                    Some((name, _)) => name.clone(),
                    None => words::center(self.scene, *body),
                };
                self.velocity(*body, &point_name, &at, along.as_ref(), &answers);
            }
            Ask::Impulse { from, on, along } => self.impulse(*from, *on, along.as_ref(), &answers),
            Ask::Energy { when, of } => self.energy(*when, *of, &answers),
            Ask::Spin { body, clockwise } => {
                let sign = if *clockwise {
                    Expr::from(-1)
                } else {
                    Expr::one()
                };
                let raw = &sign * &self.spin_after(*body);
                self.values(&[raw], &answers, None);
            }
            _ => self.asked_equation(&answers),
        }
    }

    fn velocity(
        &mut self,
        body: usize,
        point: &str,
        at: &Vector,
        along: Option<&Vector>,
        answers: &[Answer],
    ) {
        let link = self.reduction.tree.iter().find(|l| l.body == body).copied();
        let carrier = link.map_or(Place::Center(body), |l| l.at);
        let base = words::point(self.scene, carrier);
        let from = self.g.place(carrier).clone();
        let arm = self.tidy_vector(&minus(at, &from));
        let center = words::center(self.scene, body);
        let forms = self.reduced.velocity_of(&self.g, body, at);
        let v = [0, 1].map(|axis| {
            let raw = self.form(&forms[axis]);
            self.tidy(&raw)
        });
        let still = link.is_some_and(|l| self.stands(l.to, l.at));
        let particle = self.scene.bodies[body].is_particle();
        let turns = !arm.iter().all(Expr::is_zero) && !particle;
        let of = || vector("v", point, "+");
        let carried = (!still && (turns || base != point)).then(|| vector("v", &base, "+"));
        let round = turns.then(|| {
            let r = vector("r", &format!("{point}/{base}"), "");
            words::set("{} × {}", [words::spin(self.scene, body, "+"), r])
        });
        let terms = carried.map(|v| vec![v]).into_iter().chain(round);
        let mut math = words::set("{} =", [of()]);
        math.extend(terms.collect::<Vec<_>>().join(&Math::Op("+")));
        if turns && still {
            let put_in = [Math::Along(self.spin_after(body)), arm.into()];
            math.extend(words::set("= ({}) × ({})", put_in));
        }
        math.extend((math.len() > 2).then_some(Math::Op("=")));
        math.push(v.clone().into());
        let whom = words::capital(&words::body(self.scene, body));
        match along {
            None => {
                let lead = match (turns, still) {
                    (true, true) => format!("{whom} turns about {base}:"),
                    (true, false) => format!("{whom} is rigid:"),
                    _ => String::from("In components,"),
                };
                let reason = "velocities of a rigid body: v + ω × r";
                let id = self.step(Vec::new(), fresh(answers, &v), reason);
                // How the center moves may have been told with the joint.
                let told = Symbol::from(format!("motion of {body}"));
                if point != center || !self.told.contains(&told) {
                    self.say(&lead);
                    self.show(math, Some(id));
                }
                self.values(&v, answers, None);
            }
            Some(d) => {
                if turns {
                    self.say(&format!("{whom} is rigid:"));
                    self.show(math, None);
                }
                self.component(d, of(), dot(&v, d), answers);
            }
        }
    }

    /// A component along a direction, as a product with the unit vector.
    fn component(&mut self, d: &Vector, whole: Math, raw: Expr, answers: &[Answer]) {
        let Some(answer) = answers.first() else {
            return;
        };
        let symbol = Expr::symbol(&answer.name);
        let product = words::set("{} · ({})", [whole, d.clone().into()]);
        let claim = Claim::new(symbol.clone(), raw.clone());
        // A component that has a name already needs no line of its own.
        if raw.size() <= NAMED {
            if symbol != raw {
                self.step(Vec::new(), vec![claim], "component along a direction");
            }
            let via = match raw.is_zero() {
                true => product,
                false => vec![Math::Expr(raw.clone())],
            };
            return self.values(&[raw], answers, Some(via));
        }
        let id = self.step(Vec::new(), vec![claim], "component along a direction");
        let mut math = vec![Math::Expr(symbol), Math::Op("=")];
        math.extend(product);
        math.extend([Math::Op("="), Math::Expr(raw.clone())]);
        self.show(math, Some(id));
        self.values(&[raw], answers, None);
    }

    fn impulse(&mut self, from: ImpulseAt, on: usize, along: Option<&Vector>, answers: &[Answer]) {
        let (place, second) = Place::of(self.scene, from);
        let sign = Expr::from(if on == second { 1 } else { -1 });
        let forms = laws::impulse_at(self.scene, &self.g, place);
        let v = [0, 1].map(|axis| &sign * &self.form(&forms[axis]));
        let v = self.tidy_vector(&v);
        let index = words::point(self.scene, place);
        // The number that a contact along its normal has bears the name of the vector.
        let number = format!("P_{index}");
        let is_taken = v.iter().any(|e| e.mentions(&number));
        let whole = match is_taken {
            true => vector(
                "P",
                &format!("{index},{}", words::center(self.scene, on)),
                "",
            ),
            false => vector("P", &index, ""),
        };
        let whom = is_taken.then(|| {
            let body = words::body(self.scene, on);
            [
                Inline::Math(vec![whole.clone()]),
                say(format!(" for the impulse on {body},")),
            ]
        });
        if let Some(d) = along {
            let raw = self.tidy(&dot(&v, d));
            if let Some(whom) = whom.filter(|_| raw.size() > NAMED) {
                self.text([vec![say("With ")], whom.into()].concat());
            }
            return self.component(d, whole, raw, answers);
        }
        let claims = fresh(answers, &v);
        if !claims.is_empty() {
            let id = self.step(Vec::new(), claims, "components of the impulse");
            match whom {
                Some(whom) => self.text([vec![say("In components, with ")], whom.into()].concat()),
                None => self.say("In components,"),
            }
            self.show(words::set("{} = {}", [whole, v.clone().into()]), Some(id));
        }
        self.values(&v, answers, None);
    }

    fn energy(&mut self, when: EnergyWhen, of: Option<usize>, answers: &[Answer]) {
        let moving = self.scene.moving();
        let moving: Vec<usize> = moving.filter(|b| of.is_none_or(|o| o == *b)).collect();
        let half = Expr::ratio(1, 2);
        let (mut before, mut after) = (Vec::new(), Vec::new());
        for &b in &moving {
            let (v, w) = self.g.before(b);
            let (v, w) = (v.clone(), w.clone());
            let mass = self.g.mass(b).clone();
            let inertia = self.g.inertia(b).clone();
            let inertia = self.tidy(&inertia);
            let spins = !self.scene.bodies[b].is_particle() && !self.vanishes(&inertia);
            let energy = |v: &Vector, w: &Expr| {
                let moving = &half * &mass * (v[0].powi(2) + v[1].powi(2));
                let turning = match spins {
                    true => &half * &inertia * w.powi(2),
                    false => Expr::zero(),
                };
                [moving, turning]
            };
            before.extend(energy(&v, &w));
            let v = self.velocity_after(b);
            let parts = energy(&v, &self.spin_after(b));
            // Of a body that turns about a joint it is one term.
            if self.reduction.tree.iter().any(|l| l.body == b) {
                after.push(Expr::sum(parts));
            } else {
                after.extend(parts);
            }
        }
        let raw = [Expr::sum(before.clone()), Expr::sum(after.clone())];
        let tidy = [before, after].map(|parts| {
            let parts = parts.into_iter().filter(|e| !e.is_zero()).collect();
            self.sum_by_parts(parts)
        });
        let index = match of {
            Some(b) => words::center(self.scene, b),
            None => String::new(),
        };
        let ends: &[(usize, &str)] = match when {
            EnergyWhen::Before => &[(0, "-")],
            EnergyWhen::After => &[(1, "+")],
            EnergyWhen::Lost => &[(0, "-"), (1, "+")],
        };
        let named = answers.first().is_some_and(|a| !self.is_solved(&a.name));
        let mut shown = Vec::new();
        for &(i, mark) in ends {
            let claim = Claim::new(raw[i].clone(), tidy[i].clone());
            let reason = ["kinetic energy just before", "kinetic energy just after"][i];
            let id = self.step(Vec::new(), vec![claim], reason);
            // What is asked for stands in the box as it is.
            if when == EnergyWhen::Before && named || tidy[i].size() >= 200 {
                continue;
            }
            if i == 0 {
                self.say("The kinetic energies before and after are");
            }
            let mut math = vec![words::kinetic(&index, mark), Math::Op("=")];
            shown.push(math[0].clone());
            if self.detail() == Detail::Full && raw[i] != tidy[i] && raw[i].size() < 80 {
                math.extend([Math::Expr(raw[i].clone()), Math::Op("=")]);
            }
            math.push(Math::Expr(tidy[i].clone()));
            self.show(math, Some(id));
        }
        let [before, after] = tidy;
        let raw = match when {
            EnergyWhen::Before => before,
            EnergyWhen::After => after,
            EnergyWhen::Lost => before - after,
        };
        // By the energies of the lines above.
        let by = match shown.as_slice() {
            [before, after] => Some(vec![before.clone(), Math::Op("−"), after.clone()]),
            [after] => Some(vec![after.clone()]),
            _ => None,
        };
        self.values(&[raw], answers, by);
    }

    /// Closed forms of answers, each from its expression in the symbols found above; `via` is told between name and value.
    fn values(&mut self, raw: &[Expr], answers: &[Answer], via: Option<Vec<Math>>) {
        let mut lines = Vec::new();
        // An unknown by its name in the chain says where the value comes from.
        let has_name = |via: &Vec<Math>| !via.iter().any(|m| matches!(m, Math::Name(_)));
        let by_name = via.as_ref().is_some_and(has_name);
        for (answer, raw) in answers.iter().zip(raw) {
            let Form::Value { closed, short } = &answer.form else {
                continue;
            };
            let symbol = Expr::symbol(&answer.name);
            // A symbol the blocks solved for has been shown with its value already.
            if self.is_solved(&answer.name) {
                continue;
            }
            let before = if symbol == *raw {
                Vec::new()
            } else {
                vec![Claim::new(symbol.clone(), raw.clone())]
            };
            let id = self.step(
                before,
                vec![Claim::new(symbol.clone(), closed.clone())],
                "with the values found above",
            );
            let mut math = vec![Math::Expr(symbol), Math::Op("=")];
            if by_name {
                for name in raw.symbols() {
                    self.solution.untell(&Expr::symbol(&name));
                }
            }
            if let Some(via) = via.clone().filter(|v| *v != [Math::Expr(short.clone())]) {
                math.extend(via);
                math.push(Math::Op("="));
            }
            math.push(Math::Expr(short.clone()));
            lines.push(Line {
                math,
                step: Some(id),
            });
        }
        if !lines.is_empty() {
            let shorts: Vec<Expr> = answers
                .iter()
                .filter_map(|a| match &a.form {
                    Form::Value { short, .. } => Some(short.clone()),
                    _ => None,
                })
                .collect();
            self.abbreviations(&shorts);
            let mut found: Vec<Expr> = Vec::new();
            for e in raw.iter().flat_map(Expr::symbols) {
                let solved = self.d.blocks.iter().flat_map(|b| &b.unknowns);
                let mut solved = solved.map(|u| self.d.names.plain(*u));
                if solved.any(|name| *name == *e) && !found.contains(&Expr::symbol(&e)) {
                    found.push(Expr::symbol(&e));
                }
            }
            if by_name {
                found.clear();
            }
            if !found.is_empty() && found.len() <= 4 {
                let mut text = vec![say("With ")];
                text.extend(words::row(found.iter().map(words::formula), " and "));
                text.push(say(" from above,"));
                self.text(text);
            } else if !found.is_empty() {
                self.say("With the motion found above,");
            }
            self.told
                .extend(answers.iter().map(|a| Symbol::from(a.name.as_str())));
            let last = self.solution.sections.last_mut();
            match last.and_then(|s| s.parts.last_mut()) {
                Some(Part::Result(others)) if by_name => others.extend(lines),
                _ => self.push(Part::Result(lines)),
            }
        }
    }

    fn is_solved(&self, name: &str) -> bool {
        self.d
            .blocks
            .iter()
            .flat_map(|b| &b.unknowns)
            .any(|u| self.d.names.plain(*u) == name)
    }

    fn asked_equation(&mut self, answers: &[Answer]) {
        for answer in answers {
            match &answer.form {
                Form::Equation { left, right } => {
                    self.say(
                        "It is the same before and after; in the unknowns that are asked for,",
                    );
                    self.claim(
                        left.clone(),
                        right.clone(),
                        "linear momentum, before = after",
                    );
                }
                Form::Matrix(m) => {
                    let mut claims = Vec::new();
                    for (row, rhs) in m.entries.iter().zip(&m.rhs) {
                        let terms = row
                            .iter()
                            .zip(&m.unknowns)
                            .map(|(k, u)| k * &Expr::symbol(u));
                        claims.push(Claim::new(
                            Expr::sum(terms.filter(|t| !t.is_zero())),
                            rhs.clone(),
                        ));
                    }
                    self.step(Vec::new(), claims, "the rows of the matrix form");
                    self.say("The equations in matrix form:");
                    self.push(Part::Matrix(m.clone()));
                    for sentence in &answer.text {
                        self.text(full_sentence(self.scene, sentence));
                    }
                }
                _ => {}
            }
        }
    }
}

/// Claims of the components that go by another name than their own.
fn fresh(answers: &[Answer], v: &Vector) -> Vec<Claim> {
    let symbols = answers.iter().map(|a| Expr::symbol(&a.name));
    let all = symbols.zip(v).filter(|(symbol, value)| symbol != *value);
    all.map(|(left, right)| Claim::new(left, right.clone()))
        .collect()
}
