//! Random scenes in fractions: 1–3 free bodies of any shape, hinges that form trees, contacts of every law.

use super::build::*;
use crate::expr::number::Rational;
use crate::expr::{Expr, Vector, ratio};
use crate::numeric::points::circle_point;
use crate::scene::{Body, Scene, Shape};

/// Random small numbers from a seed.
pub struct Dice(u64);

impl Dice {
    pub fn new(seed: u64) -> Dice {
        Dice(seed)
    }
    pub fn below(&mut self, limit: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % limit
    }
    pub fn any(&mut self) -> Rational {
        ratio(self.below(41) as i64 - 20, 1 + self.below(6) as i64)
    }
    pub fn positive(&mut self) -> Rational {
        ratio(1 + self.below(20) as i64, 1 + self.below(6) as i64)
    }
    pub fn vector(&mut self) -> [Rational; 2] {
        [self.any(), self.any()]
    }
    pub fn unit(&mut self) -> [Rational; 2] {
        circle_point(&ratio(self.below(21) as i64 - 10, 1 + self.below(9) as i64))
    }
}

/// A scene whose hinges are consistent before; body 0 is fixed and may move.
pub fn random_scene(seed: u64) -> Scene {
    let dice = &mut Dice::new(seed);
    let mut wall = ground();
    if dice.below(3) == 0 {
        wall.velocity = exact(&dice.vector());
    }
    let count = 1 + dice.below(3) as usize;
    let mut bodies = vec![wall];
    let mut hinges = Vec::new();
    for i in 1..=count {
        let hinged = dice.below(5) < 3;
        let parent = if hinged {
            dice.below(i as u64) as usize
        } else {
            0
        };
        let place = if bodies[parent].is_particle() {
            bodies[parent].center.clone()
        } else {
            exact(&dice.vector())
        };
        let mut body = random_body(dice);
        if hinged {
            // Two particles at one point would be one; the hinge then holds a body of another kind.
            if body.is_particle() {
                body.center = place.clone();
            }
            let there = velocity(&bodies[parent], &place);
            let turning = velocity(
                &Body {
                    velocity: at(0, 0),
                    ..body.clone()
                },
                &place,
            );
            body.velocity = [&there[0] - &turning[0], &there[1] - &turning[1]];
            hinges.push(hinge(parent, i, place));
        }
        bodies.push(body);
    }
    let mut contacts = Vec::new();
    for _ in 0..1 + dice.below(5) / 4 {
        let two = 1 + dice.below(count as u64) as usize;
        let one = (two + 1 + dice.below(count as u64) as usize) % (count + 1);
        if bodies[one].is_particle()
            && bodies[two].is_particle()
            && bodies[one].center != bodies[two].center
        {
            continue;
        }
        let place = match (bodies[one].is_particle(), bodies[two].is_particle()) {
            (true, _) => bodies[one].center.clone(),
            (_, true) => bodies[two].center.clone(),
            _ => exact(&dice.vector()),
        };
        let normal = exact(&dice.unit());
        contacts.push(match dice.below(5) {
            0 | 1 => sticks(one, two, place, Some(normal)),
            k => bounces(
                one,
                two,
                place,
                normal,
                [q(0, 1), q(1, 1), q(dice.below(8) as i64, 7)][k as usize - 2].clone(),
            ),
        });
    }
    let mut scene = scene(bodies, hinges, contacts);
    if dice.below(4) == 0 {
        let on = 1 + dice.below(count as u64) as usize;
        let place = if scene.bodies[on].is_particle() {
            scene.bodies[on].center.clone()
        } else {
            exact(&dice.vector())
        };
        scene.blows.push(blow(on, place, exact(&dice.vector())));
    }
    scene
}

fn random_body(dice: &mut Dice) -> Body {
    let mass = Expr::from(dice.positive());
    let (center, velocity, spin) = (
        exact(&dice.vector()),
        exact(&dice.vector()),
        Expr::from(dice.any()),
    );
    let size = Expr::from(dice.positive());
    let square = &mass * &size.powi(2);
    let (shape, inertia) = match dice.below(8) {
        0 | 1 => return particle(mass, center, velocity),
        2 => (Shape::Rod { length: size }, square * q(1, 12)),
        3 => (Shape::Disk { radius: size }, square * q(1, 2)),
        4 => (Shape::Ring { radius: size }, square),
        5 => (Shape::Sphere { radius: size }, square * q(2, 5)),
        6 => {
            let height = Expr::from(dice.positive());
            let inertia = (square + &mass * &height.powi(2)) * q(1, 12);
            (
                Shape::Rectangle {
                    width: size,
                    height,
                },
                inertia,
            )
        }
        _ => (Shape::Other, Expr::from(dice.positive())),
    };
    body("body", shape, mass, inertia, center, velocity, spin)
}

fn velocity(body: &Body, place: &Vector) -> Vector {
    if body.is_particle() {
        return body.velocity.clone();
    }
    let arm = [&place[0] - &body.center[0], &place[1] - &body.center[1]];
    [
        &body.velocity[0] - &body.spin * &arm[1],
        &body.velocity[1] + &body.spin * &arm[0],
    ]
}
