//! Motions that happen at the same time: each a stage of its own, all but the first `during` another.
//!
//! In: the records of the stages. Out: which of them begin and end together, which bodies others move meanwhile, and in which
//! of them something is asked of a body.

use std::iter::successors;

use crate::scene::Scene;
use crate::scene::question_file::QuestionFile;
use crate::scene::record::Text;
use crate::scene::resolver::Resolver;
use crate::scene::stage_file::StageFile;

/// The motion with which a stage begins and ends; itself, where it happens during no other.
pub(in crate::scene) fn first(stages: &[StageFile], i: usize) -> usize {
    let during = |j: &usize| {
        let name = stages[*j].during.as_ref()?;
        stages[..*j].iter().position(|s| s.name.text == name.text)
    };
    successors(Some(i), during).last().unwrap_or(i)
}

/// The one of several motions at the same time that moves the body of which something is asked; the one that is named, where
/// none does.
pub(in crate::scene) fn home(stages: &[StageFile], named: usize, q: &QuestionFile) -> usize {
    let bodies = [
        &q.of,
        &q.velocity,
        &q.speed,
        &q.direction,
        &q.spin,
        &q.position,
        &q.acceleration,
        &q.angular_acceleration,
        &q.angle,
        &q.tension,
        &q.angular_momentum,
    ];
    let Some(body) = bodies.into_iter().flatten().next() else {
        return named;
    };
    let first = self::first(stages, named);
    let mut at_once = (first..stages.len()).filter(|j| self::first(stages, *j) == first);
    let moves = |j: &usize| stages[*j].moves().any(|name| name.text == body.text);
    at_once.find(moves).unwrap_or(named)
}

impl StageFile {
    /// Names of the bodies that a motion which may have others beside it is said to move.
    fn moves(&self) -> impl Iterator<Item = &Text> {
        let turn = self.turn.iter().map(|turn| (&turn.body, &turn.with));
        let fall = self.fall.iter().map(|fall| (&fall.body, &fall.with));
        let slide = self.slide.iter().map(|slide| (&slide.body, &slide.with));
        let on = self.slide.iter().filter_map(|slide| slide.on.as_ref());
        let all = turn.chain(fall).chain(slide);
        let all = all.chain(on.map(|on| (&on.body, &on.with)));
        let strings = self.slide.iter().flat_map(|slide| &slide.strings).flatten();
        let hung = strings.flat_map(|string| string.to.iter().chain(&string.over));
        all.flat_map(|(body, with)| std::iter::once(body).chain(with.iter().flatten()))
            .chain(hung)
    }
}

/// Tells each motion which bodies others move at the same time; no body has two motions at once.
pub(in crate::scene) fn tell_apart(
    base: &mut Resolver<'_>,
    scene: &mut Scene,
    written: &[StageFile],
) {
    let stages = &scene.stages;
    let mut apart: Vec<Vec<usize>> = vec![Vec::new(); stages.len()];
    for (i, stage) in stages.iter().enumerate() {
        let Some(during) = &stage.during else {
            continue;
        };
        let back = |j: &usize| stages[*j].from.filter(|_| *j != during.stage);
        let mine = stage.kind.moved();
        for j in successors(stage.from, back) {
            let theirs = stages[j].kind.moved();
            if let Some(b) = theirs.iter().find(|b| mine.contains(b)) {
                let (body, other) = (&scene.bodies[*b].name, &stages[j].name);
                let message = format!("`{body}` moves in `{other}` at the same time");
                let hint = "a stage `during` another tells how other bodies move meanwhile";
                base.report(written[i].name.span, message, hint);
            }
            apart[j].extend(&mine);
        }
    }
    for (stage, apart) in scene.stages.iter_mut().zip(apart) {
        stage.apart = apart;
    }
}
