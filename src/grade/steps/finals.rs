//! What a line says of what is asked: values, and bounds of a parameter.
//!
//! In: a line that was read. Out: whether it holds, and the final answer that is kept of it, right or wrong.

use super::super::{Diagnosis, Grade, Verdict};
use super::cause::MOST_STEPS;
use super::letters::ACCELERATIONS;
use super::link::Values;
use super::link::{Link, Weighed, equal};
use super::sought::Sought;
use super::{Desk, Final, Found, Status};
use crate::algebra::{self, Sign, quotient};
use crate::answer::Answer;
use crate::expr::{Expr, Function, Node, Symbol, effort};
use crate::formula::{self, Content, Reading, Relation};
use crate::scene::Ask;

impl Desk<'_> {
    /// Keeps what this line says of a quantity, the last word so far.
    pub(super) fn give(&mut self, quantity: String, text: &str, verdict: Verdict) {
        let (line, text) = (self.number, text.to_string());
        let told = Final {
            line,
            text,
            verdict,
        };
        self.finals.insert(quantity, told);
    }

    /// A line about the parameter a question asks for: `d = 4 l/3`, `d <= L/2`.
    pub(super) fn bound(&mut self, text: &str, reading: &Reading) -> Option<Found> {
        let (sides, _) = reading.content.relations()?;
        let name = sides.first()?.name()?;
        let sought = self.sought.iter().filter(|s| s.is_named(name));
        // Where a quantity is largest is no answer of its own.
        let places = sought.filter(|s| s.condition.is_none());
        let links = self.links(reading).unwrap_or_default();
        for place in places {
            // All sides of `d = a = b` are to be the place.
            match links.iter().position(|link| !self.holds_where(link, place)) {
                None if !links.is_empty() => return Some((Status::Holds, Vec::new())),
                Some(at @ 1..) => {
                    let broken = self.broken(reading, at, text).into_iter().collect();
                    return Some((Status::Wrong, broken));
                }
                _ => {}
            }
        }
        let asked = self.asked_of(name);
        asked.first()?;
        // What the answers suppose is said of it as well.
        if self.is_granted(name, reading) {
            return Some((Status::Holds, self.give_granted(&asked, text)));
        }
        let told = self.of_value(reading);
        if let Some(Content::Relations(told, _)) = told.as_ref().map(|told| &told.content)
            && told.len() == 1
        {
            return Some((self.note(reading, &links, &Weighed::Holds), Vec::new()));
        }
        // `μ ≥ P_t/P_n = …` says what its first link says where the others hold.
        let first = told.or_else(|| self.first_link(reading));
        let first = first.or_else(|| self.without_rounded_end(text, reading));
        let reading = first.as_ref().unwrap_or(reading);
        let (sides, _) = reading.content.relations()?;
        let own = self.in_given(reading);
        let own = own.or_else(|| {
            first
                .is_some()
                .then(|| super::super::show(&reading.content))
        });
        let said = own.as_deref().unwrap_or(text);
        let mut judged = self.judged_as(&asked, said);
        let place = |is: &dyn Fn(&Grade) -> bool| judged.iter().position(|(_, grade)| is(grade));
        let right = place(&|grade| grade.verdict == Verdict::Equivalent);
        // A bound answers no question for a value.
        let fits = place(&|grade| {
            let asked = grade.diagnosis.iter().all(|d| d.code != "RELATION");
            asked && grade.verdict == Verdict::Different
        });
        if right.is_none()
            && let Some(question) = self.answer_of_a_case(reading, &asked)
        {
            self.give(question, text, Verdict::Equivalent);
            return Some((Status::Holds, Vec::new()));
        }
        let (first, _) = judged.first()?;
        // What was supposed last has no one value.
        if right.is_none() && *first != asked[0] {
            return Some((Status::Undecided, Vec::new()));
        }
        let (question, grade) = judged.swap_remove(right.or(fits).unwrap_or(0));
        // In numbers the values behind it are those of the scene.
        let verdict = match grade.note {
            "DIFF_ROUNDED" => Verdict::Equivalent,
            _ if self.is_rounded_bound(text, reading, &question) => Verdict::Equivalent,
            _ => grade.verdict,
        };
        let status = match verdict {
            Verdict::Equivalent => Status::Holds,
            Verdict::Different => match self.link(sides.first()?, sides.last()?) {
                Some(link) => {
                    let cause = self.cause(text, &link).or_else(|| self.carried_on(&link));
                    let weighed = cause.map_or(Weighed::Slip(0), Weighed::Carried);
                    self.note(reading, &[link], &weighed)
                }
                None => Status::Wrong,
            },
            Verdict::Invalid | Verdict::Undecided => return None,
        };
        self.give(question, text, verdict);
        let found = Some(grade.diagnosis).filter(|_| grade.verdict == verdict);
        let mut found = found.unwrap_or_default();
        // The sides of a chain agree by what a line above says.
        if let Status::Carried(_) = status {
            found.retain(|d| d.code != "CHAIN");
        }
        Some((status, found))
    }

    /// Whether the answers suppose of a parameter what a line says of it.
    fn is_granted(&self, name: &Symbol, reading: &Reading) -> bool {
        let Some(([_, end], [sign])) = reading.content.relations() else {
            return false;
        };
        let given = self.sheet.scene.values().remove(name);
        let given = given.map(|value| (Relation::Equal, value));
        let mut granted = self.sheet.granted(name).into_iter().chain(given);
        granted.any(|(said, value)| *sign == said && self.is_value(end, &value))
    }

    /// Keeps a bound that is granted as the answer to what asks for it, where it is right or wrong by its end alone, which is told.
    fn give_granted(&mut self, asked: &[String], text: &str) -> Vec<Diagnosis> {
        let judged = self.judged_as(asked, text).into_iter();
        let near =
            |grade: &Grade| grade.verdict == Verdict::Equivalent || grade.note == "DIFF_STRICT";
        let Some((question, grade)) = judged.filter(|(_, grade)| near(grade)).last() else {
            return Vec::new();
        };
        self.give(question, text, grade.verdict);
        grade.diagnosis
    }

    /// Whether a side is this value.
    fn is_value(&self, side: &Content, value: &Expr) -> bool {
        side.expr()
            .is_some_and(|side| self.is_zero(&(side - value)))
    }

    /// How a line is judged as an answer to these questions, in each of the ways the scene can go, until it is right.
    fn judged_as(&self, asked: &[String], said: &str) -> Vec<(String, Grade)> {
        let mut judged = Vec::new();
        let ways = std::iter::once(self.sheet).chain(&self.sheet.otherwise);
        for (sheet, question) in ways.flat_map(|sheet| asked.iter().map(move |q| (sheet, q))) {
            if let Ok(entry) = sheet.entry(question) {
                let grade = sheet.judge(&entry, said, self.options);
                let right = grade.verdict == Verdict::Equivalent;
                judged.push((question.clone(), grade));
                if right {
                    break;
                }
            }
        }
        judged
    }

    /// The question of these to which a line gives an answer that is right in one of the cases of the scene, or one of several
    /// values: `u ≥ 7 g d/(10 e w)` where the ball sticks.
    fn answer_of_a_case(&self, reading: &Reading, asked: &[String]) -> Option<String> {
        let ([name, end], [sign]) = reading.content.relations()? else {
            return None;
        };
        let is_end = |value: &Expr| self.is_value(end, value);
        let says = |answer: &&Answer| {
            let mut range = answer.range.iter();
            let value = answer
                .formula()
                .filter(|_| equal(*sign) && answer.range.is_empty());
            asked.contains(&answer.question)
                && (value.is_some_and(is_end)
                    || range.any(|(of, relation, value)| {
                        name.expr() == Some(of) && relation == sign && is_end(value)
                    }))
        };
        let found = self.sheet.all.iter().find(says);
        found.map(|answer| answer.question.clone())
    }

    /// The questions that ask what a parameter is or may be, under the condition that was supposed last where one was.
    pub(super) fn asked_of(&self, name: &Symbol) -> Vec<String> {
        let named = |s: &&Sought| s.condition.is_some() && s.is_named(name);
        let all = self.sought.iter().filter(named);
        let mut supposed = self.supposed.iter().rev().map(|(_, i)| &self.sought[*i]);
        let last = supposed.find(named);
        let same = |s: &&Sought| last.is_none_or(|last| s.condition == last.condition);
        let asked: Vec<String> = all.filter(same).map(|s| s.question.clone()).collect();
        if !asked.is_empty() {
            return asked;
        }
        let bounds = self.sheet.bounds().filter(|b| b.parameter == *name);
        bounds.map(|b| b.name).take(1).collect()
    }

    /// Whether an inequality in numbers is a bound that is asked for, as far as their digits tell.
    fn is_rounded_bound(&self, text: &str, reading: &Reading, question: &str) -> bool {
        let Some(([_, end], [sign])) = reading.content.relations() else {
            return false;
        };
        let mut bounds = self.sheet.bounds();
        let bound = bounds.find(|b| b.name == question && b.relation == *sign);
        let link = bound.and_then(|b| self.link(&Content::Scalar(b.value), end));
        link.is_some_and(|link| self.is_rounded(text, &link, &Values::new()))
    }

    /// A chain about a parameter without the sides that are the parameter whatever its value, such as `(m+M)/m u` in
    /// `v = (m+M)/m u = …`; nothing where it has none.
    fn of_value(&self, reading: &Reading) -> Option<Reading> {
        let (sides, signs) = reading.content.relations()?;
        let (name, values) = sides.split_first()?;
        let answered = self.closed.contains_key(name.name()?);
        let says = |side: &&Content| {
            let link = self.link(name, side);
            link.is_none_or(|link| !self.holds(&link))
        };
        let told: Vec<Content> = values.iter().filter(says).cloned().collect();
        if answered || told.len() == values.len() || !signs.iter().all(|s| equal(*s)) {
            return None;
        }
        let told: Vec<Content> = [name.clone()].into_iter().chain(told).collect();
        let signs = signs[..told.len() - 1].to_vec();
        Some(reading.with(Content::Relations(told, signs)))
    }

    /// The bound of a chain that goes on with equalities, where all of these hold, and what is known put in.
    fn first_link(&self, reading: &Reading) -> Option<Reading> {
        let ([name, first, rest @ ..], [sign, others @ ..]) = reading.content.relations()? else {
            return None;
        };
        let goes_on = !equal(*sign) && !others.is_empty() && others.iter().all(|s| equal(*s));
        let links = rest.iter().map(|side| self.link(first, side));
        let links: Vec<Link> = links.collect::<Option<_>>().filter(|_| goes_on)?;
        let value = self.truth(first.expr()?);
        let sides = vec![name.clone(), Content::Scalar(value)];
        let content = Content::Relations(sides, vec![*sign]);
        links
            .iter()
            .all(|link| self.holds(link))
            .then(|| reading.with(content))
    }

    /// A chain without its last side, where that rounds the one before it: `v = √(8gl/3) ≈ 1.63 √(gl)`.
    fn without_rounded_end(&self, text: &str, reading: &Reading) -> Option<Reading> {
        let ([before @ .., last], [others @ .., Relation::Approximately]) =
            reading.content.relations()?
        else {
            return None;
        };
        let link = self
            .link(before.last()?, last)
            .filter(|_| before.len() > 1)?;
        let rounds = self.is_rounded(text, &link, &Values::new());
        let content = Content::Relations(before.to_vec(), others.to_vec());
        rounds.then(|| reading.with(content))
    }

    /// A line about a parameter with the student's own names put in, where it has such.
    fn in_given(&self, reading: &Reading) -> Option<String> {
        let own = reading.content.map(&|e| self.with_own(e));
        (own != reading.content).then(|| super::super::show(&own))
    }

    /// A line with an inequality: it holds where its sign is proved, or where it says what a question supposes.
    pub(super) fn inequality(&self, reading: &Reading) -> Status {
        let Some((sides, signs)) = reading.content.relations() else {
            return Status::Undecided;
        };
        let domains = &self.sheet.scene.domains;
        let mut status = Status::Holds;
        for (pair, sign) in sides.windows(2).zip(signs) {
            let (Some(a), Some(b)) = (pair[0].expr(), pair[1].expr()) else {
                return Status::Undecided;
            };
            let plain = self.with_own(&(a - b));
            let mut supposed = self.sought.iter().filter_map(|s| s.condition.as_ref());
            if supposed.any(|c| *c == plain || *c == -&plain) {
                continue;
            }
            let difference = self.truth(&plain);
            let proved = algebra::sign(&difference, domains);
            let zero = proved == Some(Sign::Zero);
            let holds = match (sign, proved) {
                (Relation::Equal | Relation::Approximately, _) => zero.then_some(true),
                (Relation::LessEqual | Relation::GreaterEqual, _) if zero => Some(true),
                (Relation::Greater | Relation::GreaterEqual, Some(Sign::Positive)) => Some(true),
                (Relation::Greater | Relation::GreaterEqual, Some(Sign::Negative)) => Some(false),
                (Relation::Less | Relation::LessEqual, Some(Sign::Negative)) => Some(true),
                (Relation::Less | Relation::LessEqual, Some(Sign::Positive)) => Some(false),
                (Relation::NotEqual, Some(Sign::Positive | Sign::Negative)) => Some(true),
                _ => None,
            };
            match holds {
                Some(true) => {}
                Some(false) => return Status::Wrong,
                None if self.says_a_bound([a, b], *sign) => {}
                None if self.misses_a_bound([a, b], *sign) => return Status::Wrong,
                None => status = Status::Undecided,
            }
        }
        status
    }

    /// Whether an inequality says of a parameter what a bound that is asked for does.
    pub(super) fn says_a_bound(&self, sides: [&Expr; 2], sign: Relation) -> bool {
        let [a, b] = sides.map(|e| formula::write_plain(&self.truth(e)));
        let text = format!("{a} {} {b}", sign.sign());
        let asked: Vec<String> = self.sheet.bounds().map(|bound| bound.name).collect();
        let judged = effort::within(MOST_STEPS, || self.judged_as(&asked, &text));
        judged
            .iter()
            .any(|(_, grade)| grade.verdict == Verdict::Equivalent)
    }

    /// Whether an inequality excludes the bound that is asked for, its sides there differing by a number alone: `m w² ≥ 2 m g L` for
    /// a bound at w² = g L. One that asks for less may be a step on the way.
    fn misses_a_bound(&self, sides: [&Expr; 2], sign: Relation) -> bool {
        let [a, b] = sides.map(|e| self.truth(e));
        let domains = &self.sheet.scene.domains;
        self.sheet.bounds().any(|bound| {
            let at = |e: &Expr| e.put(&bound.parameter, &bound.value);
            let ratio = || quotient(&at(&a), &at(&b), domains).ok();
            let speaks = [&a, &b].iter().any(|e| e.mentions(&bound.parameter));
            let is_number = |k: Expr| k.is_constant() && !k.is_zero() && !k.is_one();
            let excludes = || match (sign, algebra::sign(&(at(&a) - at(&b)), domains)) {
                (Relation::Greater | Relation::GreaterEqual, Some(s)) => s == Sign::Negative,
                (Relation::Less | Relation::LessEqual, Some(s)) => s == Sign::Positive,
                _ => false,
            };
            speaks && ratio().is_some_and(is_number) && excludes()
        })
    }

    /// Whether an answer by the names of others is right with the values that were given for these, wrong ones among them:
    /// a square is whose root has the wrong sign.
    fn stands(&self, name: &Symbol, answer: &Content) -> Option<bool> {
        let mut answer = self.with_own(answer.expr()?);
        let wrong = |n: &Symbol| {
            let told = self.finals.get(&**n).filter(|_| n != name);
            told.is_some_and(|f| f.verdict != Verdict::Equivalent)
        };
        // One answer may stand on the other.
        for _ in 0..self.said.len().min(4) {
            answer = answer.substitute(&self.said);
        }
        let truth = self.closed.get(name)?;
        let open = answer.symbols().iter().any(wrong);
        let off = self.all_zero(&[answer - truth], &Values::new());
        off.filter(|_| !open)
    }

    /// The velocity that is asked for as a vector which a name with an arrow stands for.
    fn asked_vector(&self, name: &Symbol) -> Option<Symbol> {
        let mine = formula::has_arrow(name).then(|| self.components(name))??;
        let mut asked = self.sheet.scene.questions.iter();
        let asked = asked.find(|q| {
            let theirs = matches!(q.ask, Ask::Velocity { .. }).then(|| self.components(&q.name));
            theirs.flatten().is_some_and(|theirs| {
                let gaps: Vec<Expr> = mine.iter().zip(&theirs).map(|(a, b)| a - b).collect();
                self.vanish(&gaps, &Values::new())
            })
        });
        asked.map(|q| Symbol::from(q.name.as_str()))
    }

    /// Whether a side stands in what is given, and in answers that were given before, or names that a line gave.
    fn is_in_given(&self, name: &Symbol, side: &Content) -> bool {
        let parameters = &self.sheet.scene.parameters;
        let told = |n: &Symbol| {
            let told = self.finals.contains_key(&**n);
            n != name && (told || self.learned.contains(n) && self.is_stated(n))
        };
        let given = |e: &Expr| {
            let used = self.with_own(e).symbols();
            let mut used = used.iter();
            used.all(|n| told(n) || &**n == "pi" || parameters.iter().any(|p| p.name == *n))
        };
        side.exprs().into_iter().all(given)
    }

    /// A line that says what the sine, cosine or tangent of an angle is that is asked for, solved for it where it has no other
    /// values.
    fn for_angle(&self, reading: &Reading) -> Option<Reading> {
        let (sides, signs) = reading.content.relations()?;
        let Node::Call(function, angle) = sides.first()?.expr()?.node() else {
            return None;
        };
        let inverse = match function {
            Function::Sin => Function::Asin,
            Function::Cos => Function::Acos,
            Function::Tan => Function::Atan,
            _ => return None,
        };
        let (name, value) = (angle.as_symbol()?, sides.last()?.expr()?);
        let asked = self
            .sheet
            .derivation
            .answers
            .iter()
            .any(|a| *a.name == **name);
        let again = Expr::call(inverse, sides[0].expr()?.clone()) - angle;
        let unique = asked && self.is_zero(&again);
        let solved = [angle.clone(), Expr::call(inverse, value.clone())].map(Content::Scalar);
        let sign = signs.last().copied()?;
        unique.then(|| reading.with(Content::Relations(solved.into(), vec![sign])))
    }

    /// Keeps what a line says of a quantity that is asked for, where it ends in what is given; `there` are the values of another
    /// moment or case of which it speaks.
    pub(super) fn note_final(&mut self, text: &str, reading: &Reading, there: &Values) {
        // `v_2 = v_3 = …` says what both are.
        if let Content::Relations(sides, signs) = &reading.content
            && sides.len() > 2
            && sides[1].name().is_some()
        {
            let mut second = reading.clone();
            second.content = Content::Relations(sides[1..].to_vec(), signs[1..].to_vec());
            let behind = text
                .split_once(['=', '≈'])
                .map_or(text, |(_, behind)| behind);
            self.note_final(behind.trim(), &second, there);
        }
        if let Some(angle) = self.for_angle(reading) {
            return self.note_final(text, &angle, there);
        }
        // What is a number in the unit that is asked for is one.
        let fits = |measured: &Reading| {
            let links = self.links(measured);
            links.is_some_and(|links| self.in_another_unit(&links).is_none())
        };
        let measured = self.measured(text, reading).filter(fits);
        let content = &measured.as_ref().unwrap_or(reading).content;
        let Some(([first, .., last], signs)) = content.relations() else {
            return;
        };
        let equation = signs.iter().all(|s| equal(*s));
        let Some(name) = first.name().filter(|_| equation) else {
            return;
        };
        let name = self.spins.get(&**name).map_or(name, |(spin, _)| spin);
        let vector = self.asked_vector(name);
        let name = vector
            .as_ref()
            .or(self.stands_for.get(name))
            .unwrap_or(name);
        let answers = &self.sheet.derivation.answers;
        let asked = |a: &crate::answer::Answer| *a.name == **name || *a.question == **name;
        // Answers may stand on an acceleration that nobody asked for.
        let lent = ACCELERATIONS.contains(&&**name) && self.closed.contains_key(name)
            || self.learned.contains(name);
        // An answer may stand on another that was given.
        let own = last.exprs().into_iter().map(|e| self.with_own(e));
        let used = own.flat_map(|e| e.symbols()).filter(|n| n != name);
        let used = used.filter_map(|n| Some(self.finals.get(&*n)?.verdict));
        let used: Vec<Verdict> = used.collect();
        let in_given = self.is_in_given(name, last);
        let Some(ends) = self.link(first, last) else {
            return;
        };
        // A speed is no answer where a velocity is asked for.
        let whole = self.vector(first, false).is_some() == self.vector(last, false).is_some();
        if !whole || !(lent || answers.iter().any(asked)) {
            return;
        }
        if !in_given {
            // What is wrong by the names of others is wrong until it is said again.
            let wrong = there.is_empty()
                && self.all_zero(&ends.differences, there) == Some(false)
                && !self.is_rounded(text, &ends, there)
                && !self.follows_condition(&ends);
            if wrong && !self.finals.contains_key(&**name) {
                self.give(name.to_string(), text, Verdict::Different);
            }
            return;
        }
        let end = &text[text.rfind(['=', '≈']).unwrap_or(0)..];
        let in_another_unit = self.in_another_unit(std::slice::from_ref(&ends)).is_some();
        let verdict = match self.all_zero(&ends.differences, there) {
            _ if in_another_unit => Verdict::Different,
            Some(true) => Verdict::Equivalent,
            _ if self.is_rounded(end, &ends, there) => Verdict::Equivalent,
            // What it was worked out from may be rounded more coarsely.
            _ if self.is_rounded(text, &ends, there) => Verdict::Equivalent,
            // What holds where a condition does is a step on the way to what the condition is for.
            Some(false) if self.follows_condition(&ends) => return,
            Some(false) => Verdict::Different,
            None => Verdict::Undecided,
        };
        let verdict = match (verdict, used.iter().all(|v| *v == Verdict::Equivalent)) {
            (verdict, true) => verdict,
            (verdict, false) => match (self.stands(name, last), verdict) {
                (Some(true), _) => Verdict::Equivalent,
                (Some(false), _) => Verdict::Different,
                (None, Verdict::Equivalent) if used.contains(&Verdict::Different) => {
                    Verdict::Different
                }
                (None, _) => Verdict::Undecided,
            },
        };
        match (last.expr(), verdict) {
            (Some(value), Verdict::Different | Verdict::Undecided) => {
                let value = self.with_own(value);
                self.said.insert(name.clone(), value);
            }
            _ => drop(self.said.remove(name)),
        }
        self.give(name.to_string(), text, verdict);
    }
}
