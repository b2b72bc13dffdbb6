//! The worked solution of a scene with stages: a section for each stage, then what is asked, then what it all rests on.
//!
//! In: a scene and its story as told. Out: a [`Solution`]. An impact is written by the same code as a single collision, with
//! the motion handed on by the stage before; a motion is told in [`motion`], a flight in
//! [`flight`].

mod cases;
mod ends;
mod flight;
mod height;
mod impact;
mod motion;
mod newton;
mod pivot;
mod speeds;
mod spring;
mod swing;
mod times;

use super::asked;
use super::known;
use super::neat::tidied;
use super::opening;
use super::rough;
use super::sentence::{self, full_sentence};
use super::slip::Rough;
use super::words::{self, say};
use super::{Before, Detail, Inline, Math, Part, Slot, Solution};
use crate::answer::Answer;
use crate::expr::{Expr, Symbol};
use crate::formula::{Piece, Sentence, sentence as saying};
use crate::scene::{Ask, Scene, StageKind, without_case};
use crate::story::{Case, StageTold, Told, line};

/// Longest condition, in characters, that is a heading.
const LONG_HEADING: usize = 40;

/// Writes the solution of a scene with stages.
pub(super) fn tell(scene: &Scene, told: &Told, detail: Detail) -> Solution {
    let mut page = Page {
        scene,
        told,
        solution: blank(scene, told, detail),
        valid: super::results::stated(scene),
        letters: Vec::new(),
        stands: Vec::new(),
        rough: None,
    };
    page.opening();
    let mut answers = told.answers.clone();
    // What has to grip in a motion is said there.
    let is_said = |words: &Sentence| told.stages.iter().any(|stage| stage.says_of_grips(words));
    for answer in &mut answers {
        answer.assumptions.retain(|words| !is_said(words));
    }
    for (i, stage) in told.stages.iter().enumerate() {
        // A value that a stage takes stands before it.
        let takes = |a: &Answer| stage.earlier.contains_key(a.name.as_str()) && a.told.is_none();
        let (values, later) = answers.into_iter().partition::<Vec<_>, _>(takes);
        answers = later;
        asked::beyond_motion(&mut page.solution, scene, &values);
        page.stage(i);
        page.pivot(i);
    }
    asked::beyond_motion(&mut page.solution, scene, &answers);
    page.rests_on();
    page.cases();
    page.solution
}

fn blank(scene: &Scene, told: &Told, detail: Detail) -> Solution {
    let mut names = std::collections::BTreeMap::new();
    let mut put = |name: &str, latex: &str| {
        if words::is_safe_latex(latex) {
            names.insert(Symbol::from(name), latex.to_string());
        }
    };
    for p in &scene.parameters {
        if let Some(latex) = &p.latex {
            put(&p.name, latex);
        }
    }
    for a in &told.answers {
        put(&a.name, &a.latex);
    }
    // Symbols of answers mean the first of several outcomes.
    let first = |i: &usize| line(&told.stages, (*i, 0)).all(|(_, outcome)| outcome == 0);
    let firsts = (0..told.stages.len()).filter(first);
    let needs = needed(scene, firsts.flat_map(|i| &told.stages[i].needs));
    let stages = told.stages.iter().flat_map(|s| &s.assumptions);
    let given = told.answers.iter().flat_map(|a| &a.assumptions);
    let mut assumptions = told.readings.clone();
    assumptions.extend(stages.chain(given).map(ToString::to_string));
    let mut seen = std::collections::BTreeSet::new();
    assumptions.retain(|a| seen.insert(a.clone()));
    Solution {
        title: scene.title.clone(),
        source: super::source(scene),
        statement: scene.statement.clone(),
        detail,
        names,
        meanings: Default::default(),
        sections: Vec::new(),
        steps: Vec::new(),
        scopes: Vec::new(),
        assumptions,
        needs,
        mode: None,
    }
}

/// Of what must be ≥ 0, that which is told in the parameters of the scene.
fn needed<'a>(scene: &Scene, all: impl Iterator<Item = &'a Expr>) -> Vec<Expr> {
    let is_known = |s: &Symbol| scene.parameter(s).is_some();
    let known = all.filter(|need| need.symbols().iter().all(is_known));
    known.cloned().collect()
}

/// A solution under way.
struct Page<'a> {
    scene: &'a Scene,
    told: &'a Told,
    solution: Solution,
    /// What the impacts are valid for, told at the end.
    valid: Vec<Inline>,
    /// The letters of motions that were told, with what they stand for.
    letters: Vec<(Math, &'static str)>,
    /// Equations that later stages need not tell again.
    stands: Vec<Vec<Math>>,
    /// How the rough contact of the impact under way moves under its impulse, where that is told.
    rough: Option<Rough>,
}

impl Page<'_> {
    /// Lets the steps that name answers of a case tell what leads there.
    fn cases(&mut self) {
        let is_of_a_case = |a: &&Answer| without_case(&a.name) != a.name;
        for answer in self.told.answers.iter().filter(is_of_a_case) {
            let Some(at) = answer.told else { continue };
            let on_the_way = line(&self.told.stages, at).flat_map(|(i, k)| {
                let stage = &self.told.stages[i];
                let case = stage.cases.get(k).into_iter();
                let own = case.flat_map(|case| {
                    let when = case.when.iter().map(|e| e.substitute(&case.handed));
                    when.chain(case.conditions.iter().map(|(_, e)| e.clone()))
                });
                let given = stage.given.iter().map(|(_, e)| e.clone());
                stage.needs.iter().cloned().chain(given).chain(own)
            });
            let needs: Vec<Expr> = on_the_way.collect();
            let names =
                |step: &&mut super::Step| step.defines.as_deref() == Some(answer.name.as_str());
            if let Some(step) = self.solution.steps.iter_mut().find(names) {
                step.needs = needed(self.scene, needs.iter());
            }
        }
    }

    /// What is told, and how it is read.
    fn opening(&mut self) {
        self.solution.section(0, Vec::new());
        if !self.solution.statement.is_empty() {
            let statement = words::with_symbols(self.scene, &self.solution.statement);
            self.solution.text(statement);
        }
        if let Some(text) = words::meant(self.scene, false) {
            self.solution.text(text);
        }
        if self.solution.detail == Detail::Brief {
            let turned = opening::turned_axes(self.scene);
            turned.into_iter().for_each(|axes| self.solution.text(axes));
            return;
        }
        if !self.told.readings.is_empty() {
            self.solution
                .text(vec![say(match self.scene.statement.as_str() {
                    "" => "It is understood that:",
                    _ => "The statement is read as follows:",
                })]);
            let readings = self.readings();
            self.solution.push(Part::List(readings));
        }
        let axes = opening::axes(self.scene, " unless said otherwise");
        self.solution.text(axes);
        opening::composites(&mut self.solution, self.scene);
    }

    /// How the statement is read, a sentence each.
    fn readings(&self) -> Vec<Vec<Inline>> {
        let each = self.told.readings.iter();
        let items = each.map(|r| {
            let reading = sentence::called(self.scene, r);
            let mut item = words::with_symbols(self.scene, &words::capital(&reading));
            item.push(say("."));
            item
        });
        items.collect()
    }

    fn stage(&mut self, i: usize) {
        let (told, stage) = (&self.told.stages[i], &self.told.stages[i].placed);
        let number = match self.told.stages.len() {
            1 => String::new(),
            _ => format!("{}. ", i + 1),
        };
        let title = sentence::called(self.scene, &told.name.replace('_', " "));
        let title = words::capital(&title);
        self.solution
            .section(0, vec![say(format!("{number}{title}"))]);
        let brief = self.solution.detail == Detail::Brief;
        let on_condition = |w: &&Sentence| w.to_string().starts_with("where ");
        if brief {
            // Of several cases each heading has the condition.
            let mut all = told.words.iter().filter(|_| told.cases.len() == 1);
            if let Some(words) = all.find(on_condition) {
                self.solution.text(full_sentence(self.scene, words));
            }
        } else {
            self.from(i);
            self.happens(i);
        }
        self.solution.push(Part::Figure(Slot::Stage(i)));
        let rests = told.time.as_ref().is_some_and(Expr::is_zero);
        if !rests && !self.flight(told) {
            self.kept(told);
            if told.cases.is_empty() {
                self.motion(stage, told);
            }
            if let StageKind::Slide(slide) = &stage.kind
                && let Some(spring) = &slide.spring
            {
                self.at_ends_of_spring(told, spring);
            }
        }
        // What goes into every case stands before them.
        let together = told.cases.windows(2).all(|c| c[0].handed == c[1].handed);
        if let (Some(first), true) = (told.cases.first(), together) {
            self.handed(first);
        }
        let begins = self.solution.sections.len() - 1;
        let mut shared = Vec::new();
        for (k, case) in told.cases.iter().enumerate() {
            let from = self.solution.sections.len();
            self.impact(stage, case, [i, k], together);
            if told.cases.len() > 1 {
                cases::share(&mut shared, k + 1, &mut self.solution.sections[from..]);
            }
            self.asked_of(i, k, begins);
        }
        if told.cases.is_empty() {
            self.asked_of(i, 0, begins);
        }
        let all = &self.solution.sections[begins..];
        let is_empty = |p: &Part| matches!(p, Part::Figure(_));
        if brief && all.iter().flat_map(|s| &s.parts).all(is_empty) {
            let sentences = told.words.iter().map(|w| full_sentence(self.scene, w));
            let sentences: Vec<_> = sentences.collect();
            self.solution.text(sentences.join(&say(" ")));
        }
        if brief || !told.cases.is_empty() {
            return;
        }
        if !told.assumptions.is_empty() {
            let mut text = vec![say("Assumed: ")];
            text.extend(sentence::sentence(
                self.scene,
                &Sentence::join(told.assumptions.clone(), "; "),
            ));
            text.push(say("."));
            if !self.solution.says(&text) {
                self.solution.text(text);
            }
        }
        // Why it cannot happen stands at the head of the solution.
        let refusals = self.told.refusals();
        let told_first = |words: &String| refusals.iter().any(|r| r.ends_with(words.as_str()));
        let checks = told.checks.iter().filter(|c| !told_first(&c.words));
        let checks: Vec<_> = checks.cloned().collect();
        if let Some(words) = known::worth_telling(&checks, self.solution.detail) {
            self.solution
                .text(vec![say(sentence::called(self.scene, &words))]);
        }
    }

    /// What happens in a stage.
    fn happens(&mut self, i: usize) {
        let told = &self.told.stages[i];
        let on_condition = |w: &Sentence| w.to_string().starts_with("where ");
        // What happens may stand with an earlier stage.
        let said = self.told.stages[..i]
            .iter()
            .flat_map(|s| &s.words)
            .collect::<Vec<_>>();
        // Another way of going on from the same stage goes like the one before.
        let parent = |s: &StageTold| s.branch.map(|(parent, _)| parent);
        let mut others = self.told.stages[..i].iter();
        let is_sibling = told.cases.is_empty()
            && told.branch.is_some()
            && others.any(|s| parent(s) == parent(told) && s.words == told.words);
        let is_case = |w: &Sentence| on_condition(w) && said.contains(&w);
        let words = match is_sibling || told.words.iter().all(is_case) {
            true => &[],
            false => told.words.as_slice(),
        };
        match words {
            [] => {}
            [one] => self
                .solution
                .text(full_sentence(self.scene, &self.by_told(one))),
            all => {
                let items = all.iter().map(|w| self.by_told(w));
                let items = items.map(|w| full_sentence(self.scene, &w)).collect();
                self.solution.push(Part::List(items));
            }
        }
    }

    /// A sentence in which what stands on the page by a name goes by it.
    fn by_told(&self, sentence: &Sentence) -> Sentence {
        let each = sentence.0.iter().map(|piece| match piece {
            Piece::Formula(e) if e.size() >= newton::WORTH_A_NAME => Piece::Formula(self.named(e)),
            piece => piece.clone(),
        });
        Sentence(each.collect())
    }

    /// What the stage keeps and what not: of a motion its energy, for an impact the balances themselves say why they hold; all
    /// of it at full length.
    fn kept(&mut self, told: &StageTold) {
        let full = self.solution.detail == Detail::Full;
        if self.solution.detail == Detail::Brief || (!full && !told.cases.is_empty()) {
            return;
        }
        if let (Some(b), false) = (self.steady(told), full) {
            let body = say(words::body(self.scene, b));
            let keeps = "No force acts along the line, so {} keeps its speed.";
            return self.solution.text(words::fill(keeps, [body]));
        }
        // An equation of motion does without the energy.
        let is_used = told.steps.is_empty() && !self.is_of_moments(told);
        let named = told.kept.iter();
        let named = named.filter(|k| full || k.what == "energy" && (is_used || !k.conserved));
        let mut items: Vec<Vec<Inline>> = named
            .map(|k| {
                let is = if k.conserved { "is" } else { "is not" };
                let lead = format!("{} {is} conserved: ", k.what);
                let text = Sentence([Sentence::words(lead).0, k.why.0.clone()].concat());
                full_sentence(self.scene, &text)
            })
            .collect();
        match items.len() {
            0 => {}
            // Why it is so may stand with an earlier stage.
            1 if self.solution.says(&items[0]) => {}
            1 => self.solution.text(items.remove(0)),
            _ => self.solution.push(Part::List(items)),
        }
    }

    /// The body that moves along a line with nothing to change its speed, where nobody asks for its energy.
    fn steady(&self, told: &StageTold) -> Option<usize> {
        let StageKind::Slide(slide) = &told.placed.kind else {
            return None;
        };
        let [start, end] = told.energy.as_ref()?;
        let alone = slide.gravity.is_none() && slide.strings.is_empty() && slide.on.is_none();
        let alone = alone && slide.spring.is_none();
        let is_free = alone && told.work.is_empty() && told.steps.is_empty() && start == end;
        let mut answers = self.told.answers.iter();
        let named = answers.any(|a| Self::is_end_energy(told, a));
        (is_free && !named).then_some(slide.body)
    }

    /// Where a stage begins, if that is not where the one before it ends.
    fn from(&mut self, i: usize) {
        let told = &self.told.stages[i];
        let text = match told.branch {
            None if i > 0 => {
                let mut text = saying!("this begins anew, with the bodies as they are given");
                for (b, velocity, spin) in &told.placed.start {
                    let name = &self.scene.bodies[*b].name;
                    text = saying!("{}, but for `{}`, which begins with", text, name);
                    let short = |e: &Expr| tidied(self.scene, e);
                    let velocity = velocity.as_ref().map(|v| v.each_ref().map(short));
                    let velocity = velocity.map(|[x, y]| saying!(" the velocity ({}, {})", &x, &y));
                    let spin = spin.as_ref().map(short);
                    let spin = spin.map(|w| saying!(" the spin {}", &w));
                    let each = velocity.into_iter().chain(spin);
                    text.0.extend(Sentence::join(each, " and").0);
                }
                text
            }
            Some((j, _)) if j + 1 != i => {
                let stage = words::stage(&self.told.stages[j].name);
                saying!("this goes on from the end of {}", stage)
            }
            _ => return,
        };
        self.solution.text(full_sentence(self.scene, &text));
    }

    /// Whether cases are called by what a rough contact does: their conditions are long, and stand before them.
    fn by_contact(&self, told: &StageTold) -> bool {
        let differ = |c: &Case| told.cases.iter().filter(|o| o.rubs == c.rubs).count() == 1;
        let is_long = |c: &Case| c.holds_where().to_string().chars().count() > LONG_HEADING;
        self.solution.detail != Detail::Brief
            && told.cases.iter().any(is_long)
            && told.cases.iter().all(|c| !c.rubs.is_empty() && differ(c))
    }

    /// Whether no earlier stage has told this equation; notes it, in place of another one for the same quantity.
    fn is_new(&mut self, equation: &[Math]) -> bool {
        if self.stands.iter().any(|told| told == equation) {
            return false;
        }
        self.stands.retain(|told| told.first() != equation.first());
        self.stands.push(equation.to_vec());
        true
    }

    /// What an earlier stage hands on, where it got a symbol of its own, and the law of a rough contact.
    fn handed(&mut self, case: &Case) {
        // What was asked for stands above by its name.
        let stands = |name: &Symbol| self.solution.meanings.contains_key(name);
        let all = case.handed.iter().filter(|(name, _)| !stands(name));
        let all = all.map(|(name, value)| (name.clone(), tidied(self.scene, value)));
        let mut fresh: Vec<(Symbol, Expr)> = all.collect();
        fresh.retain(|(name, value)| self.is_new(&words::related(&Expr::symbol(name), "=", value)));
        if !fresh.is_empty() {
            let mut text = Vec::new();
            for (i, (name, value)) in fresh.iter().enumerate() {
                text.push(say(match i {
                    0 => "From the stage before, ",
                    _ => ", and ",
                }));
                text.push(words::equation(&Expr::symbol(name), value));
                let of = speeds::handed_on(&case.scene, name);
                text.extend(of.map(|of| say(format!(", {of}"))));
            }
            text.push(say("."));
            self.solution.text(text);
        }
        if self.solution.detail != Detail::Brief
            && let Some(law) = rough::law(&case.scene)
        {
            self.solution.text(law);
        }
    }

    /// What is taken for granted, data that no answer needs, and how the results were checked.
    fn rests_on(&mut self) {
        let brief = self.solution.detail == Detail::Brief;
        let mut items: Vec<Vec<Inline>> = match brief {
            true => self.readings(),
            false => Vec::new(),
        };
        for a in self.assumed() {
            items.push(full_sentence(self.scene, &a));
        }
        let mut asks = self.scene.questions.iter().map(|q| &q.ask);
        let is_told = asks.any(|ask| matches!(ask, Ask::Unused(_)));
        if !self.told.unused.is_empty() && !is_told {
            let mut text = vec![say("No answer depends on ")];
            text.extend(words::symbols(&self.told.unused, " or "));
            text.push(say("."));
            items.push(text);
        }
        // A restitution of zero ends a scene that a later stage needs to go on.
        let assumed = self.told.assumed();
        let is_positive = |name: &Expr| {
            let mut all = assumed.iter().filter_map(Sentence::condition);
            all.any(|(e, is_open)| is_open && e == *name)
        };
        for condition in &mut self.valid {
            let Inline::Math(math) = condition else {
                continue;
            };
            if let [Math::Expr(low), sign @ Math::Op("≤"), Math::Expr(name), ..] = &mut math[..]
                && low.is_zero()
                && is_positive(name)
            {
                *sign = Math::Op("<");
            }
        }
        // What no answer needs has no conditions either.
        let unused = &self.told.unused;
        self.valid.retain(|condition| {
            let mut symbols = sentence::symbols(condition).peekable();
            symbols.peek().is_none() || symbols.any(|s| !unused.contains(&s))
        });
        self.valid.retain(|condition| match condition {
            Inline::Text(words) if words.starts_with(words::AT_ONCE) => {
                items.push(vec![say(words::capital(words) + ".")]);
                false
            }
            _ => true,
        });
        if !self.valid.is_empty() && self.solution.detail != Detail::Full {
            let mut text = vec![say("The results hold for ")];
            text.extend(words::row(std::mem::take(&mut self.valid), " and "));
            text.push(say("."));
            items.push(text);
        }
        if !items.is_empty() {
            self.solution.section(0, vec![say("Assumptions")]);
            self.solution.push(Part::List(items));
        }
        let stages = self.told.stages.iter().flat_map(|s| &s.checks);
        let answers = self.told.answers.iter().flat_map(|a| &a.checks);
        let followed = |c: &&crate::answer::Check| c.kind == "integration";
        let mut followed = stages.chain(answers).filter(followed).peekable();
        let is_followed = followed.peek().is_some() && followed.all(|c| c.holds == Some(true));
        let words = match self.told.holds() {
            false if self.told.fails_in_claims_alone(self.scene) => {
                "What was to be shown does not hold, as it says there; the other results stand."
            }
            false if self.told.is_proved() && self.told.ended.is_empty() => {
                "What cannot happen stands first: do not use these results."
            }
            false => "A check failed: do not use these results before the fault is found.",
            true if self.solution.detail != Detail::Normal => return,
            true if is_followed && self.told.stages.iter().any(|s| s.cases.is_empty()) => {
                "Check: followed in time numerically, from the given data alone, the scene ends with the same values."
            }
            true if self.told.stages.iter().any(|s| !s.cases.is_empty()) => {
                "Check: the results of the impacts satisfy every equation, and an independent numerical solution agrees."
            }
            true => return,
        };
        self.solution.text(vec![say(words)]);
    }

    /// What is taken for granted and does not stand above: readings of the statement are told first, and what a motion assumes
    /// where the motion is told.
    fn assumed(&self) -> Vec<Sentence> {
        let all = self.told.assumed();
        let brief = self.solution.detail == Detail::Brief;
        let motions = self.told.stages.iter().filter(|s| s.cases.is_empty());
        let said: Vec<&Sentence> = motions
            .filter(|_| !brief)
            .flat_map(|s| &s.assumptions)
            .collect();
        // So are the conditions of the cases, each with what happens there.
        let listed = |s: &&StageTold| s.words.iter().any(|w| w.to_string().starts_with("where "));
        let cases = self
            .told
            .stages
            .iter()
            .filter(listed)
            .flat_map(|s| &s.cases);
        let conditions = cases.flat_map(|case| &case.conditions);
        let conditions: Vec<Sentence> =
            conditions.map(|(_, e)| Sentence::not_negative(e)).collect();
        let in_a_case = |a: &Sentence| conditions.iter().any(|c| a.0.starts_with(&c.0));
        let unread = all.into_iter().skip(self.told.readings.len());
        unread
            .filter(|a| !said.contains(&a) && !in_a_case(a))
            .collect()
    }
}

/// The bodies that move, just before an impact.
fn befores(scene: &Scene) -> Vec<Before> {
    let moving = scene.bodies.iter().filter(|b| !b.is_fixed());
    moving
        .map(|b| Before {
            body: b.name.clone(),
            center: b.center.clone(),
            angle: b.angle.clone(),
            velocity: b.velocity.clone(),
            spin: b.spin.clone(),
        })
        .collect()
}
