//! carom: collisions of rigid bodies in the plane, from a scene to closed forms that are proved.
//!
//! ```
//! let text = r#"{
//!     "parameters": {"m": {"unit": "kg"}, "l": {"unit": "m"}, "v": {"unit": "m/s"}},
//!     "points": {"O": [0, 0]},
//!     "bodies": {
//!         "ground": {"shape": "fixed"},
//!         "rod": {"shape": "rod", "mass": "m", "length": "l", "angle": 0,
//!                 "center": ["l/2", 0], "velocity": [0, "-v"]}
//!     },
//!     "contacts": {"O": {"bodies": ["ground", "rod"], "at": "O", "law": "sticking"}},
//!     "questions": {"omega": {"spin": "rod", "clockwise": true}}
//! }"#;
//! let scene = carom::scene::read(text).expect("a sound scene");
//! let derivation = carom::derive::derive(&scene).expect("laws that close");
//! let proof = carom::verify::prove(&scene, &derivation);
//!
//! let answer = &derivation.answers[0];
//! let carom::answer::Form::Value { short, .. } = &answer.form else {
//!     panic!("a value");
//! };
//! assert_eq!(carom::formula::write_plain(short), "3*v/(2*l)");
//! assert!(proof.holds());
//! ```
//!
//! # The way of a scene
//!
//! ```text
//!                     ┌─ derive: the fewest laws of impact ──┐
//! file ─ scene::read ─┤                                      ├─ Derivation ─┐
//!                     └─ story: laws of motion, in stages ───┘              ├─ verify ─ solution ─ render
//!            └─ numeric, numeric::follow: geometry and values, in numbers ──┘
//! ```
//!
//! What is asked about the answers of either (a threshold, a maximum, a limit) is the affair of [`answer`], which knows no
//! mechanics.
//!
//! # Where trust ends
//!
//! Two ways lead from the file to a value, and they meet in [`verify`], [`story`] and [`check`] alone. The first one works with
//! formulas: [`laws`] writes equations, [`derive`](mod@derive) picks and solves them with [`algebra`]. The second, [`numeric`], sees
//! the scene and values of its parameters; it knows no law, no formula of an answer and no table of moments of inertia. A
//! result counts as proved where the two agree and every law holds as an identity; whatever was not held against
//! something is marked so. A test keeps the table of who may import whom.
//!
//! # Words
//!
//! | word | what it is |
//! | --- | --- |
//! | [`scene::Scene`] | bodies, contacts, hinges, what is known and what is asked; and its stages, where it has any |
//! | [`scene::Stage`] | one impact or one motion, with the scene as it is when the stage begins |
//! | [`scene::Question`] | what is asked: of an impact, of a motion at the end of a stage, of other answers, or in words |
//! | [`answer::Answer`] | the answer to it: a value, an equation, a matrix, a range of a parameter, words, or what leaves it open |
//! | [`laws::Law`] | an equation the scene obeys, with its [`laws::Unknown`]s |
//! | [`derive::Derivation`] | the equations chosen, solved in order, and the closed forms they give; it claims, and proves nothing |
//! | [`answer::Check`] | one thing that was held against another: what, how, and whether it holds, fails or is undecided |
//! | [`verify::Proof`] | the checks of a derivation |
//! | [`story::Told`] | the stages worked out one after the other, or the one impact of a scene, and the answers, each with its checks |
//! | [`numeric::follow`](mod@numeric::follow) | the same scene in numbers, motions in time |
//! | [`solution::Solution`] | a worked solution: text and steps, each step a claim that [`check`] replays |
//! | [`worked::Worked`] | a scene worked out, one impact and stages alike: what every command works with |
//! | [`grade::Grade`] | the verdict on a formula: same, different with a point that shows it, or undecided; and what explains it |
//!
//! The modules below stand in reading order: each imports only what stands above it. Inside a module, too, no files need each
//! other in a circle: one can be read, and changed, before those that use it.

pub mod expr;

pub mod interval;

pub mod domain;

pub mod dimension;

pub mod algebra;

pub mod equality;

pub mod formula;

pub mod scene;

pub mod answer;

pub mod laws;

pub mod numeric;

pub mod derive;

pub mod verify;

pub mod grade;

pub mod story;

pub mod emit;

pub mod report;

pub mod figure;

pub mod plot;

pub mod solution;

pub mod worked;

pub mod check;

pub mod render;

pub mod command;

pub mod export;

#[cfg(feature = "serve")]
pub mod serve;
