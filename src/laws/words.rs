//! Laws said in words: which law, of which body or system, about which point or along which direction.

use super::{Direction, Law, Place};
use crate::scene::{KnownQuantity, Scene};

/// The law in words, such as `angular momentum of bar about C`.
pub fn describe(scene: &Scene, law: &Law) -> String {
    match law {
        Law::LinearMomentum { system, along } => {
            format!(
                "linear momentum of {} along {}",
                body_list(scene, system),
                direction(along)
            )
        }
        Law::AngularMomentum { system, about } => {
            format!(
                "angular momentum of {} about {}",
                body_list(scene, system),
                place(scene, *about)
            )
        }
        Law::Restitution(c) => format!("restitution at {}", scene.contacts[*c].name),
        Law::Sticking(c, axis) => format!(
            "sticking at {} along {}",
            scene.contacts[*c].name, AXES[*axis]
        ),
        Law::Hinged(h, axis) => format!("hinge {} along {}", scene.hinges[*h].name, AXES[*axis]),
        Law::Condition(c, i) => {
            let contact = &scene.contacts[*c];
            let words = contact
                .law
                .conditions()
                .map_or("friction", |both| both[*i].words);
            format!("{words} at {}", contact.name)
        }
        Law::Given(k) => {
            let known = &scene.after[*k];
            let body = &scene.bodies[known.body].name;
            let from = known.to().map(|to| &scene.bodies[to].name);
            let from = from.map_or(String::new(), |to| format!(" relative to {to}"));
            match known.what {
                KnownQuantity::Velocity { .. } => {
                    format!("given velocity of {body}{from} just after")
                }
                KnownQuantity::Spin => format!("given spin of {body} just after"),
            }
        }
    }
}

/// `bar`, `ball and bar`, `rod1, rod2 and rod3`.
pub fn body_list(scene: &Scene, system: &[usize]) -> String {
    let names: Vec<&str> = system
        .iter()
        .map(|&b| scene.bodies[b].name.as_str())
        .collect();
    match names.as_slice() {
        [] => String::from("nothing"),
        [one] => (*one).to_string(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// The point in words.
pub fn place(scene: &Scene, place: Place) -> String {
    match place {
        Place::Center(b) => format!("the center of mass of {}", scene.bodies[b].name),
        Place::Contact(c) => scene.contacts[c].name.clone(),
        Place::Hinge(h) => scene.hinges[h].name.clone(),
        Place::Blow(b) => scene.blows[b].name.clone(),
    }
}

const AXES: [&str; 2] = ["x", "y"];

fn direction(direction: &Direction) -> &str {
    match direction {
        Direction::X => "x",
        Direction::Y => "y",
        Direction::Named(name, _) => name,
    }
}
