//! How high a body swings until weight has brought it to rest, and through which angle.

use super::Page;
use crate::answer::Answer;
use crate::answer::calc::is_zero;
use crate::expr::{Expr, Symbol, dot, minus};
use crate::scene::{Ask, Stage, Turn};
use crate::solution::neat::tidied;
use crate::solution::words::{self, fill, say, set};
use crate::solution::{Claim, Line, Meaning};
use crate::story::StageTold;

impl Page<'_> {
    /// How high a body swings until weight has brought it to rest, and through which angle.
    pub(super) fn rise(&mut self, stage: &Stage, told: &StageTold, turn: &Turn, g: &Expr) {
        let Some([start, _]) = &told.energy else {
            return;
        };
        let lump = turn.lump(&stage.scene);
        let weight = tidied(self.scene, &lump.mass) * g;
        let height = tidied(self.scene, &(start / &weight));
        let is_free = |letter: &String| {
            let mut parameters = self.scene.parameters.iter();
            let mut answers = self.told.answers.iter();
            // A second body that swings up rises by another height.
            let is_defined = self.solution.meanings.contains_key(letter.as_str());
            !(is_defined
                || parameters.any(|p| *p.name == **letter)
                || answers.any(|a| a.name == **letter))
        };
        let more = (1..).map(|i| format!("h_{i}"));
        let mut letters = ["h", "h_G"].map(String::from).into_iter().chain(more);
        let letter = letters.find(is_free).unwrap_or_default();
        let letter = Symbol::from(letter);
        let h = Expr::symbol(&letter);
        self.solution
            .meanings
            .insert(letter.clone(), Meaning::Defined);
        self.solution.text(fill(
            "The rotation ends where weight has taken up the kinetic energy. The center of mass has then risen by {}:",
            [words::formula(&h)],
        ));
        let named = Claim::new(h.clone(), height.clone());
        let balanced = Claim::new(&weight * &h, start.clone());
        let claims = vec![named, balanced];
        let step = self
            .solution
            .step(Vec::new(), claims, "kinetic energy over weight");
        if let Some(step) = self.solution.steps.last_mut() {
            step.defines = Some(letter);
        }
        let balance = set("{} = {}", [(&weight * &h).into(), words::kinetic("", "-")]);
        let math = words::related(&h, "=", &height);
        let step = Some(step);
        let lines = vec![Line::plain(balance), Line { math, step }];
        let arm = minus(&lump.center, &turn.about).map(|e| tidied(self.scene, &e));
        let length = tidied(self.scene, &dot(&arm, &arm).sqrt());
        let from_below = is_zero(&(&arm[1] + &length), &self.scene.domains) == Some(true);
        let angle = self
            .to(told, |ask| matches!(ask, Ask::Angle { .. }))
            .cloned();
        self.solution.display(lines);
        // A body that began level with the fixed point rises by its distance times the sine, if the angle counts its way.
        let counted = |angle: &Answer| match told.turned.as_ref() == angle.formula() {
            true => arm[0].clone(),
            false => -&arm[0],
        };
        let from_level = |angle: &Answer| {
            let is_zero = |e: &Expr| is_zero(e, &self.scene.domains) == Some(true);
            is_zero(&arm[1]) && is_zero(&(counted(angle) - &length))
        };
        let Some(angle) = angle.filter(|a| a.formula().is_some()) else {
            return;
        };
        let name = Symbol::from(angle.name.as_str());
        let turned = Expr::symbol(&name);
        let (sine, cosine) = (turned.sin(), turned.cos());
        let lifted = |first: &str, place: &Expr, last: &str| {
            let about = say(&turn.about_name);
            let [length, place] = [&length, place].map(words::formula);
            let [first, last] = [first, last].map(say);
            let words = "It began {} {}, a distance {} away, and ends {} {} it:";
            fill(words, [first, about, length, place, last])
        };
        let (words, swung) = if from_level(&angle) {
            let place = &length * sine;
            (lifted("level with", &place, "above"), place)
        } else if from_below {
            let place = &length * &cosine;
            let swung = &length * (Expr::one() - &cosine);
            (lifted("straight below", &place, "below"), swung)
        } else {
            let swung = counted(&angle) * sine - &arm[1] * (Expr::one() - cosine);
            let words = "A turn through {} lifts it by";
            let swung = tidied(self.scene, &swung);
            (fill(words, [words::formula(&turned)]), swung)
        };
        self.solution.text(words);
        let claim = Claim::new(h.clone(), swung.clone());
        let reason = "where the rotation leads";
        let step = self.solution.step(Vec::new(), vec![claim], reason);
        let math = words::related(&h, "=", &swung);
        let step = Some(step);
        self.solution.display(vec![Line { math, step }]);
        let meaning = Meaning::Answer(angle.question.clone(), None);
        self.solution.meanings.insert(name, meaning);
    }
}
