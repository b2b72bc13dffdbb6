//! The results in one place, their abbreviations, and what was checked.

use super::known;
use super::neat::tidied;
use super::opening::NUMBERS;
use super::sentence::sentence;
use super::words::{self, fill, say};
use super::{Claim, Detail, Inline, Line, Math, Meaning, Part, Writer};
use crate::answer::Form;
use crate::expr::{Expr, Symbol};
use crate::formula::Sentence;
use crate::scene::Scene;

/// What stands for a long condition without which roots have no value.
const REAL_ROOTS: &str = "real roots";

/// Least size of such a condition, in nodes.
const LONG_CONDITION: usize = 80;

impl Writer<'_> {
    /// All answers, with abbreviations below.
    pub(super) fn results(&mut self) {
        let shorts = self.untold();
        let open = self
            .d
            .answers
            .iter()
            .any(|a| matches!(a.form, Form::Open(_)));
        if !shorts.is_empty() || open {
            self.section(vec![say("Results")]);
        }
        self.boxed();
    }

    /// The answers that were not told yet, as they are written.
    fn untold(&self) -> Vec<Expr> {
        let answers = self.d.answers.iter();
        let untold = answers.filter(|a| !self.told.contains(a.name.as_str()));
        let shorts = untold.filter_map(|a| match &a.form {
            Form::Value { short, .. } => Some(short.clone()),
            _ => None,
        });
        shorts.collect()
    }

    /// The answers that were not told yet, in a box.
    pub(super) fn boxed(&mut self) {
        let shorts = self.untold();
        self.abbreviations(&shorts);
        self.name_roots(&shorts, 2);
        let mut lines = Vec::new();
        let mut open = Vec::new();
        for answer in &self.d.answers {
            match &answer.form {
                Form::Value { closed, short } => {
                    let symbol = Expr::symbol(&answer.name);
                    let mut math = words::related(&symbol, "=", short);
                    if short == &symbol {
                        math[2] = Math::Expr(closed.clone());
                    }
                    let id = self.step(
                        Vec::new(),
                        vec![Claim::new(symbol, closed.clone())],
                        "result",
                    );
                    if self.told.contains(answer.name.as_str()) {
                        continue;
                    }
                    let rooted = self.with_roots(short);
                    if rooted != *short {
                        math[2] = Math::Expr(rooted);
                    }
                    lines.push(Line {
                        math,
                        step: Some(id),
                    });
                }
                Form::Open(_) => open.push(Expr::symbol(&answer.name)),
                Form::Equation { .. } | Form::Matrix(_) | Form::Words => {}
            }
        }
        if !lines.is_empty() {
            self.push(Part::Result(lines));
        }
        if !open.is_empty() {
            let row = words::row(open.iter().map(words::formula), " and ");
            let counting = &self.d.counting;
            let counts = [counting.equations, counting.rank, counting.unknowns];
            let counts = fill(
                ": {} equations, {} of them independent, for {} unknowns.",
                counts.map(|n| say(n.to_string())),
            );
            let lead = vec![say("Momentum balance and the given laws do not determine ")];
            self.text([lead, row, counts].concat());
            let closing = &self.d.counting.closing_laws;
            if !closing.is_empty() {
                let items = closing.iter().map(|c| vec![say(c.clone())]).collect();
                self.say("One of these would:");
                self.push(Part::List(items));
            }
        }
        self.short_forms();
        self.numbers();
        self.push(Part::Figure(super::Slot::After));
    }

    /// The abbreviations that formulas use and that do not stand on the page yet, each before it is used.
    pub(super) fn abbreviations(&mut self, used: &[Expr]) {
        let mut needed: Vec<Expr> = used.to_vec();
        let mut wanted = Vec::new();
        for definition in self.d.definitions.iter().rev() {
            let uses = |e: &Expr| e.symbols().contains(&definition.name);
            if needed.iter().any(uses) && !self.told.contains(&definition.name) {
                needed.push(definition.value.clone());
                wanted.push(definition.clone());
            }
        }
        let unknown = |name: &Symbol| {
            let all = self.d.blocks.iter().flat_map(|b| &b.unknowns);
            all.into_iter().any(|u| *self.d.names.plain(*u) == **name)
        };
        // An unknown that a block solves for is told there.
        wanted.retain(|d| !unknown(&d.name));
        wanted.reverse();
        if wanted.is_empty() {
            return;
        }
        self.say("With the abbreviations");
        let mut lines = Vec::new();
        let mut meanings = Vec::new();
        for definition in wanted {
            self.told.insert(definition.name.clone());
            let symbol = Expr::symbol(&definition.name);
            self.solution
                .meanings
                .entry(definition.name.clone())
                .or_insert(Meaning::Defined);
            let words = self.by_name(&words::named(self.scene, &definition.meaning));
            let claim = Claim::new(symbol.clone(), definition.value.clone());
            let id = self.step(Vec::new(), vec![claim], &words);
            let fresh = self.solution.meanings.get(&definition.name) == Some(&Meaning::Defined);
            if let Some(step) = self.last_step() {
                step.defines = fresh.then(|| definition.name.clone());
            }
            lines.push(Line {
                math: words::related(&symbol, "=", &definition.value),
                step: Some(id),
            });
            let again = meanings
                .last_mut()
                .filter(|(_, said): &&mut (Vec<Expr>, String)| *said == words);
            match again {
                Some((symbols, _)) => symbols.push(symbol),
                None => meanings.push((vec![symbol], words)),
            }
        }
        self.push(Part::Display(lines));
        if self.detail() != Detail::Brief {
            let each = meanings.into_iter().map(|(symbols, words)| {
                let row = words::row(symbols.iter().map(words::formula), ", ");
                [row, vec![say(format!(": {words}"))]].concat()
            });
            let each: Vec<_> = each.collect();
            let all = each.join(&say("; "));
            self.text([vec![say("that is, ")], all, vec![say(".")]].concat());
        }
    }

    /// The words of a definition, with the bodies of the only contact called by their names.
    fn by_name(&self, words: &str) -> String {
        let [contact] = self.scene.contacts.as_slice() else {
            return words.to_string();
        };
        let [first, second] = contact.bodies.map(|b| words::body(self.scene, b));
        let words = words.replace("the second body", &second);
        words.replace("relative to the first", &format!("relative to {first}"))
    }

    /// Answers written with abbreviations are claims of their own.
    fn short_forms(&mut self) {
        for answer in &self.d.answers {
            if let Form::Value { closed, short } = &answer.form {
                let symbol = Expr::symbol(&answer.name);
                if short != closed && *short != symbol {
                    let claim = Claim::new(symbol, short.clone());
                    self.step(Vec::new(), vec![claim], "result, with abbreviations");
                }
            }
        }
    }

    /// The answers in numbers where the scene gives values.
    fn numbers(&mut self) {
        let mut items = Vec::new();
        for answer in &self.d.answers {
            let Some(number) = known::number(self.scene, answer) else {
                continue;
            };
            if !items.is_empty() {
                items.push(say(", "));
            }
            items.push(words::formula(&Expr::symbol(&answer.name)));
            items.push(say(number));
        }
        if !items.is_empty() {
            items.insert(0, say(NUMBERS));
            items.push(say("."));
            self.text(items);
        }
    }

    /// How the results were checked, and what they rest on.
    pub(super) fn checked(&mut self) {
        let identity = self.proof.scene.iter().find(|c| c.kind == "identity");
        let points = self
            .proof
            .answers
            .iter()
            .flatten()
            .filter(|c| c.kind == "exact points" && c.holds == Some(true))
            .count();
        let mut text: Vec<Inline> = Vec::new();
        if identity.is_some_and(|c| c.holds == Some(true)) {
            let which = if self.d.counting.open.is_empty() {
                ""
            } else {
                " in which nothing stays open"
            };
            text.push(say(format!(
                "Check: the results satisfy every equation{which}"
            )));
            if points > 0 {
                text.push(say(", and an independent numerical solution agrees"));
            }
            text.push(say("."));
        }
        if !self.proof.holds() {
            text = vec![say(
                "A check failed: do not use these results before the fault is found.",
            )];
        }
        let is_sentence =
            |c: &Inline| matches!(c, Inline::Text(t) if t.starts_with(words::AT_ONCE));
        let (sentences, conditions): (Vec<Inline>, Vec<Inline>) =
            self.conditions().into_iter().partition(is_sentence);
        for sentence in sentences {
            if let Inline::Text(words) = sentence {
                let lead = if text.is_empty() { "" } else { " " };
                text.push(say(format!("{lead}{}.", words::capital(&words))));
            }
        }
        if !conditions.is_empty() {
            let all = words::row(conditions, " and ");
            let lead = if text.is_empty() { "" } else { " " };
            text.push(say(format!("{lead}Valid for ")));
            text.extend(all);
            text.push(say("."));
        }
        let needed: Vec<Sentence> = self.needed().cloned().collect();
        if !needed.is_empty() {
            text.push(say(" Needed besides: "));
            text.extend(sentence(self.scene, &Sentence::join(needed, "; ")));
            text.push(say("."));
        }
        if !text.is_empty() {
            self.text(text);
        }
    }

    /// What must hold so that the collision is possible, with the reason.
    pub(super) fn needed(&self) -> impl Iterator<Item = &Sentence> {
        let all = self.proof.assumptions.iter();
        all.filter(|words| words.condition().is_some())
    }

    /// What must hold beyond positive parameters.
    pub(super) fn conditions(&self) -> Vec<Inline> {
        let mut all = stated(self.scene);
        let own = self.d.assumptions.iter().map(ToString::to_string);
        let told = self.proof.assumptions.iter();
        let told = told.filter(|words| words.condition().is_none());
        for a in own.chain(told.map(ToString::to_string)) {
            let text = a.replace("the bodies approach", "bodies that approach");
            let condition = self.or_real_roots(words::condition(self.scene, &text));
            if !all.contains(&condition) {
                all.push(condition);
            }
        }
        all.sort_by_key(|c| matches!(c, Inline::Text(words) if words == REAL_ROOTS));
        all
    }

    /// A condition; a long one that only gives roots of the answers a value is told in words.
    fn or_real_roots(&self, condition: Inline) -> Inline {
        let Inline::Math(math) = &condition else {
            return condition;
        };
        let [Math::Expr(e), Math::Op("≥"), Math::Expr(low)] = math.as_slice() else {
            return condition;
        };
        if e.size() < LONG_CONDITION || !low.is_zero() {
            return condition;
        }
        let own = tidied(self.scene, e);
        let formulas = self.d.answers.iter().flat_map(|a| a.form.formulas());
        let mut roots = formulas.flat_map(Expr::parts).filter_map(Expr::under_root);
        match roots.any(|inside| tidied(self.scene, inside) == own) {
            true => say(REAL_ROOTS),
            false => condition,
        }
    }
}

/// What a scene states of its parameters beyond that they are positive.
pub(super) fn stated(scene: &Scene) -> Vec<Inline> {
    let mut all = Vec::new();
    for (name, domain) in &scene.domains.symbols {
        let in_pair = scene
            .domains
            .unit_vectors
            .iter()
            .any(|pair| pair.contains(name));
        let positive = *domain == crate::domain::Domain::positive();
        // What an earlier stage has found is no condition.
        let is_found = scene.parameter(name).is_none();
        if is_found || in_pair || positive || (domain.low.is_none() && domain.high.is_none()) {
            continue;
        }
        let sign = |open: bool| if open { "<" } else { "≤" };
        let symbol = || Math::from(Expr::symbol(name));
        let mut math = match (&domain.low, &domain.high) {
            // One limit stands behind the symbol.
            (Some(low), None) => {
                let over = if low.open { ">" } else { "≥" };
                vec![symbol(), Math::Op(over), low.expr().into()]
            }
            (Some(low), _) => vec![low.expr().into(), Math::Op(sign(low.open)), symbol()],
            (None, _) => vec![symbol()],
        };
        if let Some(high) = &domain.high {
            math.extend([Math::Op(sign(high.open)), high.expr().into()]);
        }
        all.push(Inline::Math(math));
    }
    for [a, b] in &scene.domains.unit_vectors {
        let squares = Expr::symbol(a).powi(2) + Expr::symbol(b).powi(2);
        all.push(words::equation(&squares, &Expr::one()));
    }
    all.extend(scene.domains.relations.iter().map(|r| {
        let [small, large] = r.sides.clone().map(Math::Expr);
        let sign = if r.closed { "≤" } else { "<" };
        Inline::Math(vec![small, Math::Op(sign), large])
    }));
    all
}
