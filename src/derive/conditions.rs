//! What closed forms rest on: divisors that may vanish, roots that must exist, laws of several contacts at once.
//!
//! In: a derivation under way. Out: conditions, as expressions and as sentences.

use num_integer::Integer;

use super::Stop;
use super::work::{Work, formulas};
use crate::algebra::{self, Element, Sign};
use crate::expr::{Expr, Int, Node, Rational, cross, dot, minus};
use crate::formula::{Sentence, sentence};
use crate::scene::{Body, Contact, ContactLaw};

/// Longest condition that is printed with an answer, in characters.
const READABLE: usize = 110;

impl Work<'_> {
    /// The determinant of a block, where nothing shows that it keeps away from zero. Joints in a tree and one contact
    /// need no such condition: their equations are those of a quadratic form, the kinetic energy, that is positive for
    /// positive masses.
    pub(super) fn divisors(&mut self, divisors: &[Element]) -> Result<Vec<Expr>, Stop> {
        let scene = self.scene;
        let positive = self.has_positive_masses();
        let contacts = scene
            .contacts
            .iter()
            .filter(|c| matches!(c.law, ContactLaw::Frictionless { .. }))
            .count();
        if positive && contacts <= 1 && self.reduction.loops.is_empty() && scene.after.is_empty() {
            return Ok(Vec::new());
        }
        let mut determinant = self.field.integer(1);
        for divisor in divisors {
            determinant = self.field.mul(&determinant, divisor)?;
        }
        Ok(match self.field.sign(&determinant) {
            Some(Sign::Positive | Sign::Negative) => Vec::new(),
            _ => vec![self.hangs_on(&determinant, |s| {
                matches!(s, Sign::Positive | Sign::Negative)
            })],
        })
    }

    /// Whether every mass and moment of inertia is known to be positive.
    pub(super) fn has_positive_masses(&mut self) -> bool {
        let mut moving = self.scene.bodies.iter().filter(|b| !b.is_fixed());
        moving.all(|body| {
            self.is_positive(&body.mass) && (body.is_particle() || self.is_positive(&body.inertia))
        })
    }

    /// What stands under square roots of the scene and is not known to have one, without factors that are positive.
    fn radicands(&mut self) -> Vec<Expr> {
        let mut found = Vec::new();
        for e in formulas(self.scene) {
            radicands(&e, &mut found);
        }
        let mut open = Vec::new();
        for base in found {
            let Ok(element) = self.field.element(&base) else {
                open.push(base);
                continue;
            };
            if self.field.sign(&element).is_some_and(Sign::is_not_negative) {
                continue;
            }
            open.push(self.hangs_on(&element, |s| s == Sign::Positive));
        }
        open
    }

    /// The factors of a value on which a condition hangs: those without a sign that settles it.
    fn hangs_on(&mut self, value: &Element, settles: impl Fn(Sign) -> bool) -> Expr {
        let shown = self.field.expr(value);
        let factors = match shown.node() {
            Node::Product(factors) => factors.clone(),
            _ => vec![shown],
        };
        let open = factors.into_iter().filter(|f| {
            let sign = self.field.element(f).ok().and_then(|x| self.field.sign(&x));
            !sign.is_some_and(&settles)
        });
        Expr::product(open)
    }

    fn is_positive(&mut self, e: &Expr) -> bool {
        let element = self.field.element(e);
        element.is_ok_and(|x| self.field.sign(&x) == Some(Sign::Positive))
    }

    /// What the closed forms rest on: signs taken for roots, and conditions `… ≠ 0` under which the blocks were solved.
    pub(super) fn assumptions(&mut self) -> Vec<Sentence> {
        let sign = |a: &algebra::Assumption| match a {
            algebra::Assumption::NotNegative(e) => Sentence::not_negative(e),
        };
        let mut all: Vec<Sentence> = self.field.assumptions().iter().map(sign).collect();
        for base in self.radicands() {
            let condition = Sentence::not_negative(&base);
            if !all.contains(&condition) {
                all.push(condition);
            }
        }
        if self.order_matters() {
            let rebounds = |c: &Contact| matches!(&c.law, ContactLaw::Frictionless { restitution } if !restitution.is_zero());
            let own = match self.scene.contacts.iter().any(rebounds) {
                true => ", each with its own restitution (Newton)",
                false => "",
            };
            all.push(format!("all contacts act at the same instant{own}; acting one after another they could leave a different motion").into());
        }
        for (at, decided) in self.scene.decided() {
            let holds = decided
                .when
                .iter()
                .map(|(left, relation, right)| sentence!("{} {} {}", left, relation.sign(), right));
            // Nobody reads a condition of many lines; the table of cases has it.
            let holds: Vec<Sentence> = holds.collect();
            let is_short = |h: &Sentence| h.to_string().chars().count() <= READABLE;
            match holds.iter().all(is_short) {
                true => all.extend(holds),
                false => all.push(Sentence::words(format!(
                    "{} {} (the case the values pick)",
                    self.scene.contacts[at].name,
                    decided.mode.words()
                ))),
            }
        }
        for divisor in self.blocks.iter().flat_map(|b| &b.divided_by) {
            let condition = sentence!("{} ≠ 0", divisor);
            if !all.contains(&condition) {
                all.push(condition);
            }
        }
        all
    }

    /// Whether contacts that bounce would leave another motion if they acted one after another: an impulse along one normal
    /// changes the speed of approach at another. Of free bodies that takes a body which both touch; joints pass everything on.
    fn order_matters(&mut self) -> bool {
        let scene = self.scene;
        let law = |c: &Contact| matches!(c.law, ContactLaw::Frictionless { .. });
        let bouncing: Vec<&Contact> = scene.contacts.iter().filter(|c| law(c)).collect();
        if bouncing.len() < 2 || bouncing.len() < scene.contacts.len() || !scene.hinges.is_empty() {
            return bouncing.len() > 1;
        }
        let pairs = bouncing.iter().enumerate();
        let pairs: Vec<[&Contact; 2]> = pairs
            .flat_map(|(i, a)| bouncing[i + 1..].iter().map(|b| [*a, *b]))
            .collect();
        pairs.iter().any(|pair| {
            let both = |b: &usize| pair.iter().all(|c| c.bodies.contains(b));
            let mut moving = scene.moving();
            moving.any(|b| both(&b) && self.reaches(pair, &scene.bodies[b]))
        })
    }

    /// Whether an impulse on a free body along the normal of one contact moves its point at the other along the normal there.
    fn reaches(&mut self, [a, b]: &[&Contact; 2], body: &Body) -> bool {
        let (Some(m), Some(n)) = (&a.normal, &b.normal) else {
            return true;
        };
        let arms = [(a, m), (b, n)].map(|(c, n)| cross(&minus(&c.at, &body.center), n));
        let response = match body.is_particle() {
            true => dot(m, n),
            false => &body.inertia * &dot(m, n) + &body.mass * &(&arms[0] * &arms[1]),
        };
        let element = self.field.element(&response);
        !element.is_ok_and(|x| self.field.is_zero(&x))
    }
}

/// The bases of powers with an even root.
fn radicands(e: &Expr, found: &mut Vec<Expr>) {
    match e.node() {
        Node::Number(_) | Node::Symbol(_) => {}
        Node::Sum(parts) | Node::Product(parts) => parts.iter().for_each(|p| radicands(p, found)),
        Node::Power(base, exponent) => {
            let even = |k: &Rational| k.denom().is_multiple_of(&Int::from(2));
            if exponent.as_number().is_some_and(even) && !found.contains(base) {
                found.push(base.clone());
            }
            radicands(base, found);
        }
        Node::Call(_, argument) => radicands(argument, found),
    }
}
