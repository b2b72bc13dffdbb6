//! A flight in a worked solution: under its weight a center of mass has a constant acceleration, and so its velocity, its way
//! and the time follow from where it begins.

use super::Page;
use crate::answer::Answer;
use crate::answer::calc::is_zero;
use crate::expr::{Expr, Symbol, Vector, dot, minus};
use crate::scene::{Ask, Fall, FallEnd, StageKind};
use crate::solution::neat::{alike, neat, tidied};
use crate::solution::words::{self, name, say};
use crate::solution::{Claim, Line, Math};
use crate::story::{Cluster, StageTold};

/// The letter of the time of a flight, where nothing else bears it.
const TIME: &str = "t";

/// From the common center of mass of what turns as one to one of the bodies, at the end of a flight.
fn arm(cluster: &Cluster, told: &StageTold, body: usize) -> Vector {
    let lead = cluster.bodies[0];
    let turned = &told.after.angle[lead] - &told.before.angle[lead];
    let [x, y] = minus(&told.before.center[body], &cluster.center);
    let (c, s) = (turned.cos(), turned.sin());
    [&x * &c - &y * &s, x * s + y * c]
}

/// The way of a center of mass that begins with a velocity, in a time.
fn drift([x, y]: &Vector, fall: &Fall, time: &Expr) -> Vector {
    let g = fall.gravity.clone().unwrap_or_else(Expr::zero);
    [x * time, y * time - Expr::ratio(1, 2) * g * time.powi(2)]
}

impl Page<'_> {
    /// Tells a flight by its acceleration; whether that does without its energy.
    pub(super) fn flight(&mut self, told: &StageTold) -> bool {
        let Some((fall, time)) = self.kinematic(told) else {
            return false;
        };
        let domains = &told.placed.scene.domains;
        let bodies = fall.bodies();
        let before = |b: &usize| &told.before.velocity[*b];
        let is_particle = |b: &usize| self.scene.bodies[*b].is_particle();
        let who = match (bodies.as_slice(), bodies.iter().all(is_particle)) {
            _ if bodies.iter().all(|b| told.cluster_of(*b).is_some()) => {
                String::from(match told.clusters.as_slice() {
                    [_] => "the common center of mass G",
                    _ => "each common center of mass",
                })
            }
            ([_, _, ..], true) => String::from("each body"),
            ([_, _, ..], false) => String::from("each center of mass"),
            (_, true) => words::body(self.scene, fall.body),
            _ => format!(
                "the center of mass of {}",
                words::body(self.scene, fall.body)
            ),
        };
        let mut text = match &fall.gravity {
            None => vec![say(format!("No force acts, so {who} keeps its velocity"))],
            Some(g) => vec![
                say(format!("The weight gives {who} the constant acceleration ")),
                match g.evaluate(&crate::expr::Point::<f64>::default()) {
                    Some(g) => say(format!("{} m/s²", words::digits(g))),
                    None => words::formula(g),
                },
                say(" downward"),
            ],
        };
        if fall.gravity.is_some()
            && !bodies
                .iter()
                .all(|b| is_zero(&before(b)[0], domains) == Some(true))
        {
            text.push(say(" and leaves its horizontal velocity as it is"));
        }
        text.push(say("."));
        let to_top = matches!(fall.until, FallEnd::Top);
        if to_top {
            text.push(say(" At the top the vertical velocity is zero."));
        }
        let letter = Symbol::from(TIME);
        let needs_time = self.answered(told).any(|answer| {
            let shown = self
                .ask(answer)
                .and_then(|ask| self.flown(told, ask, answer));
            shown.is_some_and(|[shown, _]| shown.mentions(&letter))
        });
        let defines_time = needs_time
            && !self.asked(told, |ask| matches!(ask, Ask::Time))
            && self.letter(fall).is_some();
        // What a flight is like is told once.
        if !self.solution.says(&text) {
            self.solution.text(text);
        }
        if defines_time {
            let t = words::formula(&Expr::symbol(&letter));
            let text = vec![say("Let "), t, say(" be the time of the flight.")];
            self.solution.text(text);
        }
        let mut lines = self.turning(told, fall, time);
        lines.extend(self.falling(told, fall, time, defines_time));
        self.solution.display(lines);
        !self.asks_energy(told)
    }

    /// How fast bodies fall at the end, and the time that takes, where it has a letter: what is told by it comes after it.
    fn falling(
        &mut self,
        told: &StageTold,
        fall: &Fall,
        time: &Expr,
        defines_time: bool,
    ) -> Vec<Line> {
        let (bodies, letter) = (fall.bodies(), Symbol::from(TIME));
        let to_top = matches!(fall.until, FallEnd::Top);
        let mut lines = Vec::new();
        let by_height = matches!(fall.until, FallEnd::Drop(_));
        let shown = match defines_time {
            true => Expr::symbol(&letter),
            false => time.clone(),
        };
        let mut clock = defines_time.then(|| {
            let raw = self.takes(told, fall, time);
            let head = Math::Expr(Expr::symbol(&letter));
            self.defined(head, [&raw, &raw], time, "the time of the flight")
        });
        for b in bodies.iter().filter(|_| fall.gravity.is_some()) {
            let asks = |ask: &Ask| matches!(ask, Ask::Velocity { body, .. } if body == b);
            // The velocity at a height decides when it is reached, and what comes next begins with it.
            let rises = |b: usize| &told.before.velocity[b][1];
            let said = to_top && rises(*b) == rises(fall.body);
            let needed = self.goes_on(told) || by_height && *b == fall.body;
            if said || !needed || self.asked(told, asks) {
                continue;
            }
            if !(by_height && *b == fall.body) {
                lines.extend(clock.take());
            }
            let raw = [&shown, time].map(|time| self.falls_with(told, fall, *b, time));
            let meanwhile = self.scene.moved_meanwhile(&told.placed.name);
            let index = match bodies.len() + meanwhile.len() {
                1 => String::from("y"),
                _ => format!("{},y", words::center(self.scene, *b)),
            };
            let value = &told.after.velocity[*b][1];
            let why = "velocity at the end: v² = v₀² + 2 g h, or v = v₀ + g t";
            lines.push(self.defined(name("v", &index, "+", false), raw.each_ref(), value, why));
        }
        lines.extend(clock);
        lines
    }

    /// The common center of mass of what turns as one, and the arms from it to what is asked about.
    fn turning(&mut self, told: &StageTold, fall: &Fall, time: &Expr) -> Vec<Line> {
        let mut lines = Vec::new();
        let vanishes = |e: &Expr| is_zero(e, &told.placed.scene.domains) == Some(true);
        for cluster in &told.clusters {
            let g = match told.clusters.as_slice() {
                [_] => String::from("G"),
                _ => format!("G,{}", words::center(self.scene, cluster.bodies[0])),
            };
            let mass = |b: &usize| &self.scene.bodies[*b].mass;
            let all = Expr::sum(cluster.bodies.iter().map(|b| mass(b).clone()));
            let begins = &told.before;
            let quantities = [
                (["x", "y"], &begins.center, &cluster.center, false),
                (["v", "v"], &begins.velocity, &cluster.velocity, true),
            ];
            for (letters, of, values, is_rate) in quantities {
                for (k, axis) in ["x", "y"].into_iter().enumerate() {
                    if vanishes(&values[k]) {
                        continue;
                    }
                    let parts = cluster.bodies.iter().map(|b| mass(b) * &of[*b][k]);
                    let parts = parts.map(|part| tidied(self.scene, &part));
                    let raw = Expr::sum(parts) / &all;
                    let index = if is_rate {
                        format!("{g},{axis}")
                    } else {
                        g.clone()
                    };
                    let mark = if is_rate { "" } else { "-" };
                    let why = "common center of mass: the sum of m r over the sum of m";
                    let head = name(letters[k], &index, mark, false);
                    lines.push(self.defined(head, [&raw, &raw], &values[k], why));
                }
            }
            for b in &cluster.bodies {
                let asks = |ask: &Ask| match ask {
                    Ask::Position { body, .. } | Ask::Velocity { body, .. } => body == b,
                    _ => false,
                };
                if self.asked(told, asks) {
                    let arm = arm(cluster, told, *b).map(|e| tidied(self.scene, &e));
                    // The place at the end, less that of the common center.
                    let way = drift(&cluster.velocity, fall, time);
                    let claim = |k: usize| {
                        let center = &cluster.center[k] + &way[k];
                        Claim::new(&told.after.center[*b][k] - center, arm[k].clone())
                    };
                    let why = "the arm from the common center of mass, turned with the body";
                    let claims = vec![claim(0), claim(1)];
                    let step = Some(self.solution.step(Vec::new(), claims, why));
                    let index = format!("{}/{g}", words::center(self.scene, *b));
                    let head = name("r", &index, "+", true);
                    let math = vec![head, Math::Op("="), Math::Vector(arm)];
                    lines.push(Line { math, step });
                }
            }
        }
        lines
    }

    /// `name = raw = value`, where raw is what is shown, and what is claimed to be the value.
    fn defined(&mut self, head: Math, raw: [&Expr; 2], value: &Expr, why: &str) -> Line {
        let [shown, claimed] = raw;
        let claim = Claim::new(claimed.clone(), value.clone());
        let step = Some(self.solution.step(Vec::new(), vec![claim], why));
        let mut math = vec![head, Math::Op("=")];
        if !alike(shown, value) {
            math.extend([Math::Expr(shown.clone()), Math::Op("=")]);
        }
        math.push(Math::Expr(value.clone()));
        Line { math, step }
    }

    /// The letter that stands for the time of a flight: none where its time is given, or where something else has the letter.
    fn letter(&self, fall: &Fall) -> Option<Symbol> {
        let parameters = self.scene.parameters.iter().map(|p| p.name.as_ref());
        let answers = self.told.answers.iter().map(|a| a.name.as_str());
        let is_given = matches!(fall.until, FallEnd::Time(_));
        let is_taken = parameters.chain(answers).any(|name: &str| name == TIME);
        (!is_given && !is_taken).then(|| Symbol::from(TIME))
    }

    /// The velocity with which a body that turns as one with others goes round their common center of mass at the end; the velocity
    /// of that center at the beginning.
    fn round(&self, told: &StageTold, body: usize) -> Option<[Vector; 2]> {
        let cluster = told.cluster_of(body)?;
        let [x, y] = arm(cluster, told, body).map(|e| tidied(self.scene, &e));
        let w = self.named(&cluster.spin);
        Some([[-(&w * y), w * x], cluster.velocity.clone()])
    }

    /// The velocity upwards of a body at the end of a flight, from that at its beginning.
    fn falls_with(&self, told: &StageTold, fall: &Fall, body: usize, time: &Expr) -> Expr {
        let g = fall.gravity.clone().unwrap_or_else(Expr::zero);
        if let Some([round, center]) = self.round(told, body) {
            return self.named(&center[1]) - g * time + &round[1];
        }
        let [v, first] = [body, fall.body].map(|b| &told.before.velocity[b][1]);
        // What begins alike falls alike.
        let alike = v == first;
        let v = self.named(v);
        match &fall.until {
            FallEnd::Drop(h) if alike && h.is_zero() && !fall.rising => -v,
            FallEnd::Drop(h) if alike && !g.is_zero() => {
                let size = (v.powi(2) + Expr::from(2) * &g * self.named(h)).sqrt();
                if fall.rising { size } else { -size }
            }
            FallEnd::Top if body == fall.body => Expr::zero(),
            _ => v - g * time,
        }
    }

    /// The time that a flight takes, from the velocities of its beginning and its end.
    fn takes(&self, told: &StageTold, fall: &Fall, time: &Expr) -> Expr {
        let [x, y] = told.before.velocity[fall.body]
            .each_ref()
            .map(|v| self.named(v));
        match (&fall.until, &fall.gravity) {
            (FallEnd::Drop(_), Some(g)) => {
                let end = self.named(&told.after.velocity[fall.body][1]);
                tidied(self.scene, &(y - end)) / g
            }
            (FallEnd::Drop(h), None) => -(h / y),
            (FallEnd::Range(s), _) => s / x,
            (FallEnd::Top, g) => y / g.clone().unwrap_or_else(Expr::zero),
            (FallEnd::Time(_), _) => time.clone(),
            (FallEnd::Turned(by), _) => {
                let spin = &told.before.spin[fall.body];
                let is_forward = told.turned.as_ref() == Some(by);
                by / self.named(&if is_forward { spin.clone() } else { -spin })
            }
        }
    }

    /// The way of a body through a flight, in the velocities it began with and the time.
    fn way(&self, told: &StageTold, fall: &Fall, body: usize, time: &Expr) -> Vector {
        let cluster = told.cluster_of(body);
        let begins = cluster.map_or(&told.before.velocity[body], |cluster| &cluster.velocity);
        let mut way = drift(&begins.each_ref().map(|v| self.named(v)), fall, time);
        match &fall.until {
            FallEnd::Drop(h) if body == fall.body => way[1] = -h,
            FallEnd::Range(s) if body == fall.body => way[0] = s.clone(),
            _ => {}
        }
        if let Some(cluster) = cluster {
            let begins = minus(&told.before.center[body], &cluster.center);
            let round = minus(&arm(cluster, told, body), &begins);
            way = [0, 1].map(|k| &way[k] + tidied(self.scene, &round[k]));
        }
        way
    }

    /// Where a body is, how it moves, or what time has passed after a flight, in the motion it began with: as it is shown, and
    /// as it can be claimed.
    pub(super) fn flown(&self, told: &StageTold, ask: &Ask, answer: &Answer) -> Option<[Expr; 2]> {
        let (fall, time) = self.kinematic(told)?;
        let letter = self
            .letter(fall)
            .filter(|_| !self.asked(told, |ask| matches!(ask, Ask::Time)));
        let shown = letter.map_or_else(|| self.named(time), |letter| Expr::symbol(&letter));
        let direction = |along: &Option<Vector>| {
            let axis = answer.axis();
            let unit = || [0, 1].map(|k| Expr::from(i64::from(axis == Some(k))));
            along.clone().unwrap_or_else(unit)
        };
        let both = match ask {
            Ask::Position {
                body,
                along,
                at_end: true,
            } if fall.bodies().contains(body) => {
                let along = direction(along);
                let from = tidied(self.scene, &dot(&told.before.center[*body], &along));
                let from = self.named(&from);
                [&shown, time].map(|time| &from + dot(&self.way(told, fall, *body, time), &along))
            }
            Ask::Velocity {
                body,
                point: None,
                along,
            } if fall.bodies().contains(body) => {
                let along = direction(along);
                let x = match self.round(told, *body) {
                    Some([round, center]) => self.named(&center[0]) + &round[0],
                    None => self.named(&told.before.velocity[*body][0]),
                };
                [&shown, time].map(|time| {
                    let y = self.falls_with(told, fall, *body, time);
                    dot(&[x.clone(), y], &along)
                })
            }
            Ask::Angle { body, clockwise } if fall.bodies().contains(body) => {
                let spin = &told.before.spin[*body];
                let spin = self.named(&if *clockwise { -spin } else { spin.clone() });
                [&shown, time].map(|time| &spin * time)
            }
            Ask::Distance => {
                let v = &told.before.velocity[fall.body];
                let speed = self.named(&tidied(self.scene, &dot(v, v).sqrt()));
                [&shown, time].map(|time| &speed * time)
            }
            Ask::Time if told.time.as_ref() == answer.formula() => {
                let raw = self.takes(told, fall, time);
                [raw.clone(), raw]
            }
            _ => return None,
        };
        let both = both.map(|e| neat(self.scene, &e));
        Some(both).filter(|[shown, _]| !answer.formula().is_some_and(|value| alike(shown, value)))
    }

    /// Whether something of a kind is answered at the end of a stage.
    pub(super) fn asked(&self, told: &StageTold, is: impl Fn(&Ask) -> bool) -> bool {
        self.to(told, is).is_some()
    }

    /// A flight that is told by its acceleration, and its time: each but those of which nothing but the energy is asked
    /// for, besides velocities, or in which one body goes straight up or down through a height and is asked for no more than its velocity, which energy gives at once.
    pub(super) fn kinematic<'t>(&self, told: &'t StageTold) -> Option<(&'t Fall, &'t Expr)> {
        let StageKind::Fall(fall) = &told.placed.kind else {
            return None;
        };
        let time = told.time.as_ref()?;
        let by_height = matches!(fall.until, FallEnd::Drop(_)) && fall.gravity.is_some();
        let is_upright = |b: &usize| told.before.velocity[*b][0].is_zero();
        let timeless = !self.asked(told, |ask| matches!(ask, Ask::Time | Ask::Position { .. }));
        let at_once = by_height && timeless && fall.bodies().iter().all(is_upright);
        let at_once = at_once && (fall.with.is_empty() || !self.goes_on(told));
        let by_energy = timeless && self.asks_energy(told);
        (!by_energy && !at_once).then_some((fall, time))
    }

    fn asks_energy(&self, told: &StageTold) -> bool {
        self.asked(told, |ask| matches!(ask, Ask::Energy { .. }))
    }
}
