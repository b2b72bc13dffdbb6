//! Parameters whose values a scene asks for, and what a solution supposes of them: the conditions that it states, in the words of
//! the scene or in others, and what holds where they do.

use super::super::Diagnosis;
use super::super::relation::{follows, proportional, solve_for};
use super::super::sheet::Sheet;
use super::link::Values;
use super::link::{Link, Weighed, gaps};
use super::{CONDITION, Desk, Found, Status};
use crate::algebra::{Field, quotient};
use crate::answer::Answer;
use crate::expr::{Expr, Symbol, only};
use crate::formula::{Content, Reading};
use crate::scene::Ask;

/// A parameter whose value is sought.
pub(super) struct Sought {
    /// Name of the question.
    pub question: String,
    /// The parameter.
    pub parameter: Symbol,
    /// What is to be zero with it; `None` where something is to be as large as can be.
    pub condition: Option<Expr>,
    /// The value, where the scene's answer gives it.
    value: Option<Expr>,
}

impl Sought {
    /// Whether a name is that of the parameter or, where there is a condition, of the question.
    pub fn is_named(&self, name: &Symbol) -> bool {
        self.parameter == *name || self.condition.is_some() && *self.question == **name
    }
}

/// The parameters whose values a scene asks for.
pub(super) fn sought(sheet: &Sheet) -> Vec<Sought> {
    let ways = std::iter::once(sheet).chain(&sheet.otherwise);
    let questions = ways.enumerate().flat_map(|(way, sheet)| {
        let questions = sheet.scene.questions.iter();
        questions.map(move |q| (way, sheet, q))
    });
    let each = questions.filter_map(|(way, sheet, q)| {
        let mut answers = sheet.derivation.answers.iter();
        let answer = answers.find(|a| *a.name == q.name);
        // In another case something may be largest elsewhere.
        if way > 0 && !matches!(q.ask, Ask::Extremum { .. }) {
            return None;
        }
        let (parameter, condition, value) = match &q.ask {
            Ask::Condition {
                parameter,
                left,
                right,
                ..
            } => {
                let value = answer.and_then(Answer::formula);
                (parameter.clone(), Some(left - right), value)
            }
            Ask::Extremum { .. } => match answer?.range.as_slice() {
                [(of, _, place)] => (of.as_symbol()?.clone(), None, Some(place)),
                _ => return None,
            },
            _ => return None,
        };
        Some(Sought {
            question: q.name.clone(),
            parameter,
            condition,
            value: value.cloned(),
        })
    });
    each.collect()
}

impl Desk<'_> {
    /// An expression at the values of parameters that are sought, where these were supposed.
    pub(super) fn at_sought(&self, e: Expr) -> Expr {
        let supposed = self.supposed.iter();
        let supposed = supposed.filter_map(|(_, i)| self.sought.get(*i));
        supposed.fold(e, |e, s| match self.value_of(s) {
            Some(value) => e.put(&s.parameter, &value),
            None => e,
        })
    }

    /// Whether something is said about a name: the scene answers it, or the solution solves for it where a condition holds.
    pub(super) fn is_found(&self, name: &Symbol) -> bool {
        let mut sought = self.sought.iter().filter(|s| s.is_named(name));
        self.closed.contains_key(name) || sought.any(|s| self.is_solved_for(s))
    }

    /// What a question asks of a parameter is that parameter where the lines above hold.
    pub(super) fn by_parameter(&self, e: &Expr) -> Expr {
        let used = e.symbols();
        let mut sought = self.sought.iter();
        match sought.find(|s| used.contains(s.question.as_str())) {
            Some(s) => e.put(
                &Symbol::from(s.question.as_str()),
                &Expr::symbol(&s.parameter),
            ),
            None => e.clone(),
        }
    }

    /// The wrong line with whose values a condition says of its parameter what an equation does.
    pub(super) fn supposed_with(&self, line: &Expr) -> Option<usize> {
        let line = self.by_parameter(line);
        let sought = self.sought.iter();
        let sought = sought.filter(|s| line.mentions(&s.parameter) && self.is_solved_for(s));
        let conditions: Vec<&Expr> = sought.filter_map(|s| s.condition.as_ref()).collect();
        let line = self.truth(&line);
        self.implied(|values| {
            conditions.iter().any(|condition| {
                let there = self.put_in(condition, values);
                there != self.truth(condition) && follows(&there, &line, &self.sheet.scene.domains)
            })
        })
    }

    /// Whether the solution goes on to what a condition gives.
    pub(super) fn gives(&self, sought: &Sought) -> bool {
        sought.condition.is_some() && self.is_solved_for(sought)
    }

    /// Whether some line says what the parameter is, by its name or that of the question.
    fn is_solved_for(&self, sought: &Sought) -> bool {
        self.solved_for.contains(&sought.parameter)
            || self.solved_for.contains(sought.question.as_str())
    }

    /// The parameter that is sought of which a line states what is supposed, as the scene does or, where it would be a slip
    /// otherwise, in other words.
    pub(super) fn condition(&self, links: &[Link], weighed: &Weighed) -> Option<usize> {
        let stated = self.sought.iter().position(|s| self.states(links, s));
        // ½ m u² = μ m g d for s = d; ½ M u² = M g h where a body gets as high as h, in a solution that goes on to v = ….
        stated.or_else(|| {
            let ([link], Weighed::Slip(_)) = (links, weighed) else {
                return None;
            };
            let one = self.with_own(link.gap()?);
            let in_words = |s: &Sought| {
                self.brings_in(&one, s)
                    || self.is_balance(link, &one, s)
                    || (self.is_solved_for(s) && !self.vanishes(&one, s))
            };
            let mut all = self.sought.iter();
            all.position(|s| in_words(s) && self.holds_where(link, s))
        })
    }

    /// What is found of a line that states a condition: it is supposed from here on where the solution goes on to its parameter.
    pub(super) fn told_condition(
        &mut self,
        reading: &Reading,
        links: &[Link],
        weighed: &Weighed,
    ) -> Option<Found> {
        let at = self.condition(links, weighed)?;
        let words = "a condition the scene asks about, not a fact";
        let found = Diagnosis::new(CONDITION, words, words);
        if self.is_gone_on_from(links, at) {
            self.supposed.push((self.number, at));
            self.state(None, &gaps(links));
            return Some((Status::Holds, vec![found]));
        }
        // The line is wrong, and no name in it has another value.
        let needed = self.needed.len();
        let status = self.note(reading, links, weighed);
        self.needed.truncate(needed);
        Some((status, vec![found]))
    }

    /// Whether a condition is stated for the sake of its parameter: the solution goes on to that, or the line speaks of what is
    /// given alone, or of data that come in by the condition alone. Else it is told as a fact, which it is not.
    pub(super) fn is_gone_on_from(&self, links: &[Link], at: usize) -> bool {
        let sought = &self.sought[at];
        let all: Vec<Expr> = gaps(links).iter().map(|d| self.with_own(d)).collect();
        let is_found = |d: &Expr| d.symbols().iter().any(|n| self.closed.contains_key(n));
        self.is_solved_for(sought)
            || !all.iter().any(is_found)
            || all.iter().any(|one| self.brings_in(one, sought))
    }

    /// What is said of a line about what is found that holds where a condition above it does, and nowhere else.
    pub(super) fn only_under(&self, links: &[Link]) -> Option<Diagnosis> {
        let all: Vec<Expr> = gaps(links).iter().map(|d| self.with_own(d)).collect();
        let is_about = |s: &Sought| {
            let found = |d: &Expr| d.symbols().iter().any(|n| self.closed.contains_key(n));
            all.iter().any(found) && !all.iter().any(|d| self.brings_in(d, s))
        };
        let holds = |s: &Sought| {
            links
                .iter()
                .all(|l| self.holds(l) || self.holds_where(l, s))
        };
        let above = self.supposed.iter().filter(|(line, _)| *line < self.number);
        let mut above = above.map(|(line, at)| (line, &self.sought[*at]));
        let (line, sought) = above.find(|(_, s)| holds(s) && is_about(s))?;
        let is_fact = links.iter().all(|link| self.holds(link));
        (!is_fact && !self.states(links, sought)).then(|| {
            let words = format!("right only under the condition in line {line}");
            let hint = "a condition is no fact: what rests on it answers no question in general";
            Diagnosis::new("CONDITIONAL", words, hint)
        })
    }

    /// Whether a line states the condition of a parameter that is sought; a chain `s = u²/(2 μ g) = d` does so between its
    /// ends, where the rest holds with it.
    pub(super) fn states(&self, links: &[Link], sought: &Sought) -> bool {
        let is = |link: &Link| match (&sought.condition, link.gap()) {
            (Some(c), Some(one)) => {
                let one = self.with_own(one);
                self.is_multiple(&one, c) || self.is_closed_form_of(&one, c, &sought.parameter)
            }
            // `P_A = 0` of a vector with one component says so of that.
            (Some(c), None) => {
                let zero = |side: &Content| side.expr().is_some_and(Expr::is_zero);
                let open = link.differences.iter().filter(|d| !self.is_zero(d));
                link.sides.iter().any(zero) && only(open).is_some_and(|d| d == c || *d == -c)
            }
            _ => false,
        };
        let ends = match links {
            [first, .., last] => self.link(&first.sides[0], &last.sides[1]),
            _ => None,
        };
        let fits = |link: &Link| is(link) || self.holds(link) || self.holds_where(link, sought);
        links.iter().chain(&ends).any(is) && links.iter().all(fits)
    }

    /// Whether a line is a condition in what is given, as the scene goes or in another of its cases, multiplied by what does not
    /// hang on the parameter at most.
    fn is_closed_form_of(&self, line: &Expr, condition: &Expr, parameter: &Symbol) -> bool {
        if !line.mentions(parameter) || line.symbols().iter().any(|n| self.closed.contains_key(n)) {
            return false;
        }
        let none = Values::new();
        let others = self.moments.iter().map(|(_, values)| values);
        std::iter::once(&none).chain(others).any(|values| {
            let told = self.put_in(condition, values);
            let ratio = quotient(line, &told, &self.sheet.scene.domains);
            told.mentions(parameter) && ratio.is_ok_and(|k| !k.is_zero() && !k.mentions(parameter))
        })
    }

    /// Whether a line is a condition, multiplied by given quantities at most: m w²/L = m g where w² = g L is asked about.
    fn is_multiple(&self, line: &Expr, condition: &Expr) -> bool {
        if line == condition || *line == -condition {
            return true;
        }
        let domains = self.sheet.scene.domains.of(&[line, condition]);
        let factor = || {
            let (field, line, condition) = Field::pair(&domains, line, condition).ok()?;
            Some(field.expr(&field.div(&line, &condition).ok()?))
        };
        let given = |name: &Symbol| self.is_given(name) && !self.is_found(name);
        factor().is_some_and(|k| !k.is_zero() && k.symbols().iter().all(given))
    }

    /// Whether a line is a balance of energies for an energy that is to be zero: what is proportional to an energy is about
    /// nothing else.
    fn is_balance(&self, link: &Link, line: &Expr, sought: &Sought) -> bool {
        let is_energy = |name: &Symbol| matches!(self.ask(name), Some(Ask::Energy { .. }));
        let Some(energy) = sought.condition.as_ref().and_then(Expr::as_symbol) else {
            return false;
        };
        let named = |side: &Content| side.expr().is_some_and(|e| e.as_symbol().is_some());
        let [here, there] = [line, &Expr::symbol(energy)].map(|e| self.truth(e));
        is_energy(energy)
            && !line.symbols().contains(energy)
            && !link.sides.iter().any(named)
            && proportional(&there, &here, &self.sheet.scene.domains)
    }

    /// Whether an equality holds where what was supposed does: at the value it gives its parameter.
    pub(super) fn follows_condition(&self, link: &Link) -> bool {
        let supposed = self.supposed.iter();
        let mut supposed = supposed.filter_map(|(_, i)| self.sought.get(*i));
        supposed.any(|s| self.holds_where(link, s))
    }

    /// The value of the parameter that is sought.
    pub(super) fn value_of(&self, sought: &Sought) -> Option<Expr> {
        let solved = || {
            let condition = self.truth(sought.condition.as_ref()?);
            solve_for(&condition, &sought.parameter, &self.sheet.scene.domains)
        };
        sought.value.clone().or_else(solved)
    }

    /// Whether an equality holds at the value that is sought.
    pub(super) fn holds_where(&self, link: &Link, sought: &Sought) -> bool {
        let differences: Vec<&Expr> = link.differences.iter().collect();
        self.is_zero_where(&differences, sought)
    }

    /// Whether expressions vanish at the value that is sought.
    pub(super) fn is_zero_where(&self, all: &[&Expr], sought: &Sought) -> bool {
        let there = all.iter().map(|d| self.at_value(&self.truth(d), sought));
        let there: Option<Vec<Expr>> = there.collect();
        there.is_some_and(|there| self.vanish(&there, &Values::new()))
    }

    /// An expression in what is given at the value that is sought.
    pub(super) fn at_value(&self, e: &Expr, sought: &Sought) -> Option<Expr> {
        Some(e.put(&sought.parameter, &self.value_of(sought)?))
    }

    /// Whether an equation speaks of a quantity that is zero at the value sought: any slip in its factor is lost there.
    pub(super) fn vanishes(&self, line: &Expr, sought: &Sought) -> bool {
        let Some(root) = self.value_of(sought) else {
            return true;
        };
        let symbols = line.symbols();
        let mut found = symbols.iter().filter_map(|name| self.closed.get(name));
        found.any(|value| {
            let there = [value.put(&sought.parameter, &root)];
            self.all_zero(&there, &Values::new()) != Some(false)
        })
    }

    /// Whether a line speaks of data that come in by the condition alone, such as a given distance that an answer is to equal.
    fn brings_in(&self, line: &Expr, sought: &Sought) -> bool {
        let Some(condition) = &sought.condition else {
            return false;
        };
        let elsewhere = |name: &Symbol| {
            let mut others = self
                .closed
                .iter()
                .filter(|(answer, _)| ***answer != *sought.question);
            others.any(|(_, value)| value.symbols().contains(name))
        };
        let own = condition.symbols();
        let mut own = own.iter().filter(|name| **name != sought.parameter);
        own.any(|name| {
            let is_answer = self.closed.contains_key(name);
            !is_answer && line.symbols().contains(name) && !elsewhere(name)
        })
    }
}
