//! A scene worked out, whatever it is: one impact, or stages one after the other.
//!
//! In: a scene. Out: what was derived, proved and judged of it, for every command alike: does it hold, what failed, what can
//! not happen, the written solution, the answers as a sheet. Which of the two ways a scene goes is decided here alone.

use crate::answer::{self, Answer, Check, Graph, Known, Refused};
use crate::derive::{self, Derivation};
use crate::figure::Chapter;
use crate::scene::Scene;
use crate::solution::{self, Detail, Solution};
use crate::story::{self, StageTold, Told};
use crate::verify::possible::{self, Possible};
use crate::verify::{self, Proof, Trust};

/// A scene, worked out.
#[derive(Clone, Debug)]
pub struct Worked {
    /// The scene; with friction, in the one case that its values pick or that it supposes.
    pub scene: Scene,
    /// What was found.
    pub found: Found,
}

/// What was found of a scene.
#[derive(Clone, Debug)]
pub enum Found {
    /// Closed forms of its one impact.
    Impact(Box<Impact>),
    /// Its stages, told.
    Stages(Box<Told>),
}

/// The closed forms of one impact, with all that is known of them.
#[derive(Clone, Debug)]
pub struct Impact {
    /// The closed forms.
    pub derivation: Derivation,
    /// Their proof.
    pub proof: Proof,
    /// Whether the collision can happen.
    pub possible: Possible,
    /// What is asked about its answers.
    pub about: Vec<Answer>,
}

/// Works a scene out; the words say why it cannot be.
pub fn out(scene: &Scene) -> Result<Worked, String> {
    let scene = verify::friction::settled(scene)?;
    let found = if scene.has_stages() {
        let told = story::tell(&scene).map_err(|reason| reason.to_string())?;
        Found::Stages(Box::new(told))
    } else {
        Found::Impact(Box::new(impact(&scene)?))
    };
    Ok(Worked { scene, found })
}

/// Works out one impact, of a scene that has neither stages nor friction.
pub fn impact(scene: &Scene) -> Result<Impact, String> {
    let derivation = derive::derive(scene).map_err(|stop| stop.to_string())?;
    let proof = verify::prove(scene, &derivation);
    let possible = possible::judge(scene, &derivation);
    let about =
        verify::about_answers(scene, &derivation, &proof).map_err(|reason| reason.to_string())?;
    Ok(Impact {
        derivation,
        proof,
        possible,
        about,
    })
}

impl Impact {
    /// Whether no check of an answer failed.
    pub fn is_proved(&self) -> bool {
        self.proof.holds() && self.about.iter().all(Answer::holds)
    }
}

impl Worked {
    /// Whether no check failed, no laws contradict each other, and what is told can happen.
    pub fn holds(&self) -> bool {
        self.failed().is_empty() && self.refusals().is_empty()
    }

    /// The checks that failed, and where laws contradict each other, in words.
    pub fn failed(&self) -> Vec<String> {
        let asked = self.asked().iter().flat_map(|a| &a.checks);
        let (checks, contradictions): (Vec<&Check>, Vec<String>) = match &self.found {
            Found::Impact(impact) => {
                let checks = impact.proof.checks().chain(asked).collect();
                let counting = &impact.derivation.counting;
                let words = || {
                    let laws = counting.conflict.join("; ");
                    format!("these laws contradict each other: {laws}")
                };
                (
                    checks,
                    counting.contradictory.then(words).into_iter().collect(),
                )
            }
            Found::Stages(told) => {
                let ended = told.ended.iter().map(ToString::to_string);
                (told.checks().chain(asked).collect(), ended.collect())
            }
        };
        let failed = checks.into_iter().filter(|c| c.holds == Some(false));
        let failed = failed.map(|c| c.words.clone());
        failed.chain(contradictions).collect()
    }

    /// What the answers rest on.
    pub fn assumptions(&self) -> Vec<String> {
        match &self.found {
            Found::Impact(i) => solution::assumptions(&self.scene, &i.derivation, &i.proof),
            Found::Stages(told) => told.assumed().iter().map(ToString::to_string).collect(),
        }
    }

    /// Why what was found cannot happen, and where laws contradict each other; empty where neither is so.
    pub fn refusals(&self) -> Vec<String> {
        match &self.found {
            Found::Impact(impact) => impact.possible.refusal().into_iter().collect(),
            Found::Stages(told) => {
                let ended = told.ended.iter().map(ToString::to_string);
                told.refusals().into_iter().chain(ended).collect()
            }
        }
    }

    /// Names of the answers that nothing contradicts and nothing proves.
    pub fn not_proved(&self) -> Vec<String> {
        match &self.found {
            Found::Impact(impact) => match verify::trust(&impact.derivation, &impact.proof) {
                Trust::NotProved(names) => names,
                Trust::Proved | Trust::Refuted(_) => Vec::new(),
            },
            Found::Stages(_) => Vec::new(),
        }
    }

    /// The answers that carry their own checks: of stages all, of an impact those about its answers.
    pub fn asked(&self) -> &[Answer] {
        match &self.found {
            Found::Impact(impact) => &impact.about,
            Found::Stages(told) => &told.answers,
        }
    }

    /// The curves of its plots.
    pub fn graphs(&self) -> Result<Vec<Graph>, Refused> {
        let known = match &self.found {
            Found::Impact(impact) => impact.derivation.known(),
            Found::Stages(_) => Known::new(),
        };
        answer::graphs(&self.scene, &known, self.asked())
    }

    /// The written solution. What cannot be so stands first.
    pub fn solution(&self, detail: Detail) -> Solution {
        let scene = &self.scene;
        let mut solution = match &self.found {
            Found::Impact(i) => solution::write(scene, &i.derivation, &i.proof, &i.about, detail),
            Found::Stages(told) => solution::tell(scene, told, detail),
        };
        for why in self.refusals() {
            solution.begin_with(&format!("{why}."));
        }
        solution
    }

    /// The impacts of its stages, by name, each with the motion that goes into it.
    pub fn impacts(&self) -> Vec<(String, Scene)> {
        match &self.found {
            Found::Impact(_) => Vec::new(),
            Found::Stages(told) => story::impacts(&self.scene, told),
        }
    }

    /// What is to be drawn of its stages, by name.
    pub fn chapters(&self) -> Vec<(String, Chapter)> {
        let Found::Stages(told) = &self.found else {
            return Vec::new();
        };
        let chapter = |t: &StageTold| {
            let chapter = match story::impact(&self.scene, told, Some(&t.placed.name)) {
                Some(impact) => Chapter::Impact(impact),
                None => {
                    let clockwise = story::is_clockwise(t);
                    Chapter::Motion(story::beginning(t), t.placed.kind.clone(), clockwise)
                }
            };
            (t.name.clone(), chapter)
        };
        told.stages.iter().map(chapter).collect()
    }

    /// All answers as those of one scene with one derivation.
    pub fn sheet(self) -> Result<(Scene, Derivation), String> {
        match self.found {
            Found::Impact(i) => {
                let mut derivation = i.derivation;
                let about = i.about.iter().filter_map(story::flat_answer);
                derivation.answers.extend(about);
                Ok((self.scene, derivation))
            }
            Found::Stages(told) => {
                story::sheet(&self.scene, &told).map_err(|stop| stop.to_string())
            }
        }
    }
}
