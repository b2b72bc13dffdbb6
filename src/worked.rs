//! A scene worked out, one impact or stages alike.
//!
//! In: a scene. Out: what was derived, proved and judged of it, for every command: does it hold, what failed, what can not
//! happen, the written solution, the answers as a sheet. A scene without stages is told as one.

use crate::answer::{self, Answer, Graph, Known, Refused};
use crate::derive::Derivation;
use crate::figure::{Chapter, Course};
use crate::scene::{Ask, Question, Scene};
use crate::solution::{self, Detail, Solution};
use crate::story::{self, StageTold, Told};
use crate::verify::{self, Trust};

/// The stage of a scene of one impact whose outcomes are told one after the other.
pub const IMPACT: &str = "impact";

/// A scene, worked out.
#[derive(Clone, Debug)]
pub struct Worked {
    /// The scene; with friction, in the one case that its values pick or that it supposes.
    pub scene: Scene,
    /// Its stages, or its one impact, told.
    pub told: Told,
    /// What is strange of its friction at the values given: that a law makes energy, that a contact jams.
    pub strange: Vec<String>,
}

/// Works a scene out; the words say why it cannot be.
pub fn out(scene: &Scene) -> Result<Worked, String> {
    let strange = verify::friction::strange(scene);
    let scene = verify::friction::settled(scene)?;
    let told = story::tell(&scene).map_err(|reason| reason.to_string())?;
    Ok(Worked {
        scene,
        told,
        strange,
    }
    .weighed())
}

/// The same, with every case that friction leaves: they are told as outcomes of one stage.
pub fn in_cases(scene: &Scene) -> Result<Worked, String> {
    let alone = !scene.has_stages() && scene.friction().is_some();
    if !alone || verify::friction::outcomes(scene)?.len() < 2 {
        return out(scene);
    }
    out(&scene.staged(IMPACT))
}

/// Its stages alone, up to one where it is named, for pictures: nothing is answered, and nothing checked beyond what telling
/// them takes.
pub fn to_draw(scene: &Scene, last: Option<&str>) -> Result<Worked, String> {
    let mut scene = verify::friction::settled(scene)?;
    if let Some(last) = scene
        .stages
        .iter()
        .position(|s| Some(s.name.as_str()) == last)
    {
        scene.stages.truncate(last + 1);
        let is_told = |q: &Question| q.stage.is_none_or(|stage| stage <= last);
        scene.questions.retain(is_told);
    }
    let told = story::course(&scene).map_err(|reason| reason.to_string())?;
    Ok(drawn(scene, told))
}

/// A scene for pictures, of whose energy nothing is said.
fn drawn(scene: Scene, told: Told) -> Worked {
    let strange = Vec::new();
    Worked {
        scene,
        told,
        strange,
    }
}

/// The first case of an impact whose friction no values settle, to be drawn where that case holds.
pub fn first_case(scene: &Scene) -> Option<Scene> {
    let scene = scene.staged(IMPACT);
    let told = story::course(&scene).ok()?;
    let mut chapters = drawn(scene, told).chapters().into_iter();
    chapters.find_map(|(_, chapter)| match chapter {
        Chapter::Impact(impact) => Some(impact),
        _ => None,
    })
}

impl Worked {
    /// The same with what is strange of the friction in its stages.
    pub fn weighed(mut self) -> Worked {
        if self.scene.has_stages() {
            for (name, impact) in self.impacts() {
                let found = verify::friction::strange(&impact.undecided());
                let found = found.into_iter().map(|what| match name.as_str() {
                    IMPACT => what,
                    _ => format!("in `{name}`, {what}"),
                });
                self.strange.extend(found);
            }
        }
        self
    }

    /// Whether no check failed, no laws contradict each other, and what is told can happen.
    pub fn holds(&self) -> bool {
        self.told.holds()
    }

    /// The checks of what was derived that failed, and where laws contradict each other, in words. A claim to be shown that
    /// does not hold refutes nothing but itself.
    pub fn failed(&self) -> Vec<String> {
        let is_claim = |a: &&Answer| {
            let mut asked = self.scene.questions.iter();
            asked.any(|q| q.name == a.question && matches!(q.ask, Ask::Show { .. }))
        };
        let derived = self.answers().iter().filter(|a| !is_claim(a));
        let checks = self.told.checks_of_stages();
        let checks = checks.chain(derived.flat_map(|a| &a.checks));
        let failed = checks.filter(|c| c.holds == Some(false));
        let mut all: Vec<String> = Vec::new();
        for words in failed.map(|c| c.words.clone()).chain(self.contradictions()) {
            if !all.contains(&words) {
                all.push(words);
            }
        }
        all
    }

    /// What the answers rest on.
    pub fn assumptions(&self) -> Vec<String> {
        let mut all = self.scene.domains.conditions();
        all.extend(self.told.assumed().iter().map(ToString::to_string));
        all
    }

    /// Why what was found cannot happen, and where laws contradict each other; empty where neither is so.
    pub fn refusals(&self) -> Vec<String> {
        let mut all = self.told.refusals();
        all.extend(self.contradictions());
        all
    }

    /// What of its impacts was neither shown nor refuted, each once.
    fn undecided(&self) -> Vec<String> {
        let cases = self.told.stages.iter().flat_map(|s| &s.cases);
        let cases = cases.filter(|case| !case.derivation.counting.contradictory);
        let mut all: Vec<String> = Vec::new();
        for what in cases.flat_map(|case| case.possible.undecided()) {
            if !all.contains(&what) {
                all.push(what);
            }
        }
        all
    }

    fn contradictions(&self) -> impl Iterator<Item = String> {
        self.told.ended.iter().map(ToString::to_string)
    }

    /// Names of the answers that nothing contradicts and nothing proves.
    pub fn not_proved(&self) -> Vec<String> {
        let cases = self.told.stages.iter().flat_map(|s| &s.cases);
        let open = cases.flat_map(|case| match verify::trust(&case.derivation, &case.proof) {
            Trust::NotProved(names) => names,
            Trust::Proved | Trust::Refuted(_) => Vec::new(),
        });
        let is_asked = |name: &String| self.answers().iter().any(|a| a.name == *name);
        open.filter(is_asked).collect()
    }

    /// Its answers, those about other answers behind them.
    pub fn answers(&self) -> &[Answer] {
        &self.told.answers
    }

    /// The curves of its plots.
    pub fn graphs(&self) -> Result<Vec<Graph>, Refused> {
        let alone = self.told.alone();
        let known = alone.map_or_else(Known::new, |case| case.derivation.known());
        answer::graphs(&self.scene, &known, self.answers())
    }

    /// The written solution. What cannot be so stands first.
    pub fn solution(&self, detail: Detail) -> Solution {
        let mut solution = solution::write(&self.scene, &self.told, detail);
        for why in self.refusals() {
            solution.begin_with(&format!("{why}."));
        }
        for strange in &self.strange {
            solution.end_with(&self.scene, &format!("Note that {strange}."));
        }
        for what in self.undecided() {
            solution.end_with(&self.scene, &format!("Not judged: {what}."));
        }
        solution
    }

    /// Its impacts, by name of their stages, each with the motion that goes into it.
    pub fn impacts(&self) -> Vec<(String, Scene)> {
        story::impacts(&self.scene, &self.told)
    }

    /// What is to be drawn of its stages, by name.
    pub fn chapters(&self) -> Vec<(String, Chapter)> {
        let chapter = |(i, t): (usize, &StageTold)| {
            let chapter = match story::impact(&self.scene, &self.told, Some(&t.placed.name)) {
                Some(impact) => Chapter::Impact(impact),
                None if t.way.as_ref().is_some_and(|way| way.is_zero()) => Chapter::Rest,
                None => Chapter::Motion(Course {
                    begin: story::beginning(&self.told, i),
                    kind: t.placed.kind.clone(),
                    elsewhere: self.scene.moved_meanwhile(&t.placed.name),
                    asked: self.asked_of(&t.placed.name),
                }),
            };
            (t.name.clone(), chapter)
        };
        self.told.stages.iter().enumerate().map(chapter).collect()
    }

    /// The questions about a stage.
    fn asked_of(&self, name: &str) -> Vec<Question> {
        let index = self.scene.stages.iter().position(|s| s.name == name);
        let asked = self.scene.questions.iter();
        let asked = asked.filter(|q| q.stage.is_some() && q.stage == index && !q.hidden);
        asked.cloned().collect()
    }

    /// Each way the scene can go, as one scene with one derivation; at least one.
    pub fn ways(&self) -> Result<Vec<story::Way>, String> {
        story::ways(&self.scene, &self.told).map_err(|stop| stop.to_string())
    }

    /// All answers as those of one scene with one derivation.
    pub fn sheet(self) -> Result<(Scene, Derivation), String> {
        story::sheet(&self.scene, &self.told).map_err(|stop| stop.to_string())
    }
}
