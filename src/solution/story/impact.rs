//! An impact among stages, written like a collision by itself; or the stage or case in which its equations stand already.
//!
//! In: the impact as told, its case, what stands on the page. Out: its text, its steps, and what its symbols stand for.

use super::{Page, befores, cases, needed};
use crate::expr::Symbol;
use crate::scene::{Stage, StageKind};
use crate::solution::words::{self, say};
use crate::solution::{Detail, Math, Scope, Writer, sentence};
use crate::story::{Case, StageTold, line};

impl Page<'_> {
    /// An impact, written like a collision by itself.
    pub(super) fn impact(
        &mut self,
        stage: &Stage,
        case: &Case,
        [i, k]: [usize; 2],
        together: bool,
    ) {
        let told = &self.told.stages[i];
        let several = told.cases.len() > 1;
        let id = if several {
            format!("{}/{}", told.name, k + 1)
        } else {
            told.name.clone()
        };
        let (scene, derivation) = case.asked(&self.going_on([i, k]));
        let mut writer = Writer::new(&scene, &derivation, &case.proof, self.solution.detail);
        writer.depth = if several { 2 } else { 1 };
        let mut names = self.solution.names.clone();
        names.append(&mut writer.solution.names);
        writer.solution.names = names;
        let first = self.solution.steps.len();
        let earlier = self.earlier(&writer, [i, k]);
        if together && k == 0 && earlier.is_none() {
            self.swap(&mut writer);
            self.yields(&mut writer, told, &told.cases);
            self.swap(&mut writer);
        } else if together {
            writer.goes_on_with(self.rough.clone());
        }
        if several {
            let mut heading = vec![say(format!("Case {}: ", k + 1))];
            match self.by_contact(told) {
                true => heading.push(say(sentence::called(self.scene, &case.rubs))),
                false => heading.extend(sentence::sentence(self.scene, &case.holds_where())),
            }
            self.solution.section(1, heading);
        }
        if !together {
            self.handed(case);
        }
        // The text goes on where it stands; symbols belong to the impact.
        self.swap(&mut writer);
        if !together && earlier.is_none() {
            self.yields(&mut writer, told, &told.cases[k..=k]);
        }
        if self.solution.detail != Detail::Brief && !several {
            writer.case();
        }
        writer.given_after();
        self.just_after(&mut writer, case, [i, k], earlier);
        // That everything was checked is told once, at the end.
        if self.solution.detail == Detail::Full || !case.proof.holds() {
            writer.checked();
        }
        for condition in writer.conditions() {
            let known = |s: &Symbol| self.scene.parameter(s).is_some();
            let all_known = sentence::symbols(&condition).all(|s| known(&s));
            if all_known && !self.valid.contains(&condition) {
                self.valid.push(condition);
            }
        }
        self.swap(&mut writer);
        self.solution.names = writer.solution.names;
        for step in &mut self.solution.steps[first..] {
            step.scope = Some(id.clone());
        }
        let line = line(&self.told.stages, (i, k));
        let earlier = line.flat_map(|(j, _)| &self.told.stages[j].needs);
        let given = told.given.iter().map(|(_, e)| e);
        let own = case.conditions.iter().map(|(_, e)| e);
        let mut needs = needed(self.scene, earlier.chain(given).chain(own));
        needs.extend(case.when.iter().cloned());
        self.solution.scopes.push(Scope {
            name: id,
            stage: stage.name.clone(),
            active: case.active.clone(),
            mode: crate::solution::decided(&scene),
            handed: case.handed.clone(),
            earlier: told.earlier.clone(),
            open: told.before.open.keys().cloned().collect(),
            before: befores(&scene),
            needs,
            meanings: writer.solution.meanings,
        });
    }

    /// The bodies whose motion just after an impact later stages go on with.
    fn going_on(&self, [i, k]: [usize; 2]) -> Vec<usize> {
        let next = self.told.stages.iter().filter(|s| s.branch == Some((i, k)));
        let all = next.flat_map(|s| match &s.placed.kind {
            StageKind::Impact { .. } => {
                let joints = s.placed.scene.touching();
                joints.flat_map(|one| one.bodies).collect()
            }
            kind => kind.moved(),
        });
        all.collect()
    }

    /// Lets a writer go on with the text and the steps, or takes them back.
    fn swap(&mut self, writer: &mut Writer<'_>) {
        std::mem::swap(&mut writer.solution.sections, &mut self.solution.sections);
        std::mem::swap(&mut writer.solution.steps, &mut self.solution.steps);
    }

    /// How a rough contact moves under its impulse, for these cases of an impact.
    fn yields(&mut self, writer: &mut Writer<'_>, told: &StageTold, cases: &[Case]) {
        self.rough = None;
        if self.solution.detail == Detail::Brief {
            return;
        }
        let decided: Vec<_> = cases.iter().flat_map(|case| case.scene.decided()).collect();
        let Some((at, _)) = decided.first() else {
            return;
        };
        let says = |case: &Case| case.conditions.iter().any(|(words, _)| *words == case.rubs);
        let has_conditions = told.cases.len() > 1 || cases.iter().any(says);
        let decided: Vec<_> = decided.iter().map(|(_, decided)| *decided).collect();
        let depth = std::mem::replace(&mut writer.depth, 1);
        writer.yields(*at, &decided, has_conditions);
        writer.depth = depth;
        self.rough.clone_from(&writer.rough);
    }

    /// The earlier stage, and its case, in which the equations of an impact are written, and how the bodies come into it where
    /// that is otherwise than there.
    fn earlier(
        &self,
        writer: &Writer<'_>,
        [i, k]: [usize; 2],
    ) -> Option<([usize; 2], Vec<Vec<Math>>)> {
        if let Some(at) = cases::in_earlier(self.told, [i, k]) {
            return Some((at, Vec::new()));
        }
        let is_full = self.solution.detail == Detail::Full;
        (0..i)
            .filter(|_| !is_full)
            .find_map(|j| self.alike(j, writer))
    }

    /// The motion just after an impact: its equations, or the stage or case in which they were written already.
    fn just_after(
        &self,
        writer: &mut Writer<'_>,
        case: &Case,
        [i, k]: [usize; 2],
        earlier: Option<([usize; 2], Vec<Vec<Math>>)>,
    ) {
        let again = || cases::again(self.scene, &self.told.stages[i].cases, k);
        match (earlier, again()) {
            (Some(([j, c], come)), _) => {
                let there = &self.told.stages[j];
                let stage = sentence::called(self.scene, &words::stage(&there.name));
                let which = match there.cases.len() {
                    1 => String::new(),
                    _ => format!("case {} of ", c + 1),
                };
                let rest = match come.as_slice() {
                    [] => ", and so is the motion just after:",
                    _ => ", with another motion just before:",
                };
                let lead = format!("The equations are those of {which}{stage}{rest}");
                writer.in_earlier(&lead, come);
            }
            (None, Some(again)) => writer.again(&case.rubs, &again),
            (None, None) => {
                writer.blocks();
                if !writer.d.definitions.is_empty() {
                    writer.results();
                }
            }
        }
    }

    /// An earlier impact of one outcome whose equations are those of the one under way, and how the bodies come into this one.
    fn alike(&self, j: usize, writer: &Writer<'_>) -> Option<([usize; 2], Vec<Vec<Math>>)> {
        let [case] = self.told.stages[j].cases.as_slice() else {
            return None;
        };
        let (scene, derivation) = case.asked(&self.going_on([j, 0]));
        let same = cases::same_equations((&scene, &derivation), (writer.scene, writer.d));
        let come = cases::come(&scene, writer.scene);
        (same && !come.is_empty()).then_some(([j, 0], come))
    }
}
