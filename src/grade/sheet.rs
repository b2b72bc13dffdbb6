//! A scene as an answer sheet: its derived answers are the keys, its parameters and domains the declarations.

mod earlier;
pub(in crate::grade) mod judge;
mod others;
mod rows;
mod told;

use super::believed::{self, Believed, Story, Written};
use super::relation::{size_in, solve_for};
use super::{Given, Key, Options, Question, key_of};
use crate::algebra::{self, Sign};
use crate::answer::{Answer, Form};
use crate::derive::{Derivation, Moment};
use crate::domain::Domains;
use crate::equality;
use crate::expr::{Expr, Symbol};
use crate::formula::{self, Content, Relation, Sentence, Symbols};
use crate::scene::{self, Ask, Print, Scene, without_case};
use crate::verify::printed::{Finding, explains};

/// A scene with its answers.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// The scene.
    pub scene: Scene,
    /// Its derivation.
    pub derivation: Derivation,
    /// The motion just after each impact, in each of its cases, and when that is.
    pub moments: Vec<Moment>,
    /// All answers: also those in words, places of largest values and further outcomes, which the derivation leaves out.
    pub all: Vec<Answer>,
    /// The impacts of a scene with stages, each with the motion that comes in and with its own questions.
    pub impacts: Vec<Scene>,
    /// The bodies at the end of each motion, by name of its stage.
    pub ends: Vec<(String, Scene)>,
    /// Laws of the motions between the impacts, in the names of the answers: expressions that are zero.
    pub laws: Vec<Expr>,
    /// Accelerations along the lines of the motions, whether they are asked for or not.
    pub accelerations: Vec<Expr>,
    /// Thresholds of friction: the question, the coefficient it bounds, and how that stands to it.
    pub coefficients: Vec<(String, Symbol, Relation)>,
    /// Its story, where it has stages.
    pub story: Option<Story>,
    /// What must hold for these answers, in words; empty where they hold on the whole domain.
    pub given: Vec<String>,
    /// Letters of somebody's own for parameters: `m` for what the scene calls M.
    pub spoken: Vec<(Symbol, String)>,
    /// The same scene as it goes otherwise, where supports, strings or friction leave several ways.
    pub otherwise: Vec<Sheet>,
}

/// An answer such as d ≤ 4ℓ/3.
#[derive(Clone, Debug)]
pub struct Bound {
    /// Name of the answer.
    pub name: String,
    /// The parameter.
    pub parameter: Symbol,
    /// How it stands to the value.
    pub relation: Relation,
    /// The value.
    pub value: Expr,
}

impl Bound {
    fn new(name: &str, parameter: &Symbol, relation: Relation, value: &Expr) -> Bound {
        Bound {
            name: name.to_string(),
            parameter: parameter.clone(),
            relation,
            value: value.clone(),
        }
    }

    /// Whether an equation speaks of the parameter and is not solved for it.
    fn is_in(&self, sides: &[Content]) -> bool {
        let first = sides.first().and_then(Content::expr);
        let solved = first.and_then(Expr::as_symbol) == Some(&self.parameter);
        let other = |side: &Content| side.symbols().contains(&self.parameter);
        !solved && sides.iter().any(other)
    }
}

/// A quantity of a sheet: a question, or one component of its answer.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Name of the answer.
    pub name: String,
    /// What is asked.
    pub question: scene::Question,
    /// Component along x (0) or y (1), where only one of a vector's is asked for.
    pub component: Option<usize>,
    /// What it is, in words.
    pub words: String,
    /// The key.
    pub key: Key,
}

/// Whether a name is that of an answer in one of several cases: `omega_landing_case2`.
fn is_case(name: &str) -> bool {
    without_case(name) != name
}

/// Where an answer is asked for: a motion that does not get to its end has no speed there.
fn where_it_is(chosen: &[&Answer], mut domains: Domains) -> Domains {
    let rests_on = chosen.iter().flat_map(|a| &a.assumptions);
    for (excess, strict) in rests_on.flat_map(Sentence::conditions) {
        domains = domains.given(&excess, !strict);
    }
    domains
}

impl Sheet {
    /// The impact that beliefs are tried on, and what is asked of it; of a motion nothing is that they would change.
    fn impact<'a>(&'a self, entry: &'a Entry) -> (&'a Scene, &'a Ask) {
        let question = &entry.question;
        if question.stage.is_none() {
            return (&self.scene, &question.ask);
        }
        let of = |impact: &'a Scene| {
            let asked = impact.question(&question.name)?;
            Some((impact, &asked.ask))
        };
        let found = self.impacts.iter().find_map(of);
        found.unwrap_or((&self.scene, &Ask::Describe))
    }

    /// The answers that are one bound on a parameter.
    pub fn bounds(&self) -> impl Iterator<Item = Bound> {
        let bound = |a: &Answer| match a.range.as_slice() {
            [(of, relation, value)]
                if a.name == a.question && a.formula().is_none_or(|f| f == value) =>
            {
                Some(Bound::new(&a.name, of.as_symbol()?, *relation, value))
            }
            _ => None,
        };
        let friction = self.coefficients.iter().filter_map(|(name, mu, relation)| {
            let mut answers = self.derivation.answers.iter();
            let answer = answers.find(|a| a.name == *name)?;
            Some(Bound::new(name, mu, *relation, answer.formula()?))
        });
        self.all.iter().filter_map(bound).chain(friction)
    }

    /// Declares the parameters, by the letters that somebody gives them.
    pub fn declare(&self, symbols: &mut Symbols) {
        self.scene.declare_parameters(symbols);
        for (name, letter) in &self.spoken {
            symbols.respell(name, letter);
        }
    }

    /// What the answers take for granted of a parameter, solved for it: `u ≥ 2√(g l)`, so that a bob gets to the top.
    pub fn granted(&self, parameter: &Symbol) -> Vec<(Relation, Expr)> {
        let domains = &self.scene.domains;
        let all = self.all.iter().chain(&self.derivation.answers);
        let conditions = all.flat_map(|a| a.assumptions.iter().flat_map(Sentence::conditions));
        let solved = conditions.filter_map(|(excess, strict)| {
            let value = solve_for(&excess, parameter, domains)
                .or_else(|| size_in(&excess, parameter, domains))?;
            let grows = algebra::sign(&excess.derivative(parameter), domains)?;
            let relation = match (grows, strict) {
                (Sign::Positive, true) => Relation::Greater,
                (Sign::Positive, false) => Relation::GreaterEqual,
                (Sign::Negative, true) => Relation::Less,
                (Sign::Negative, false) => Relation::LessEqual,
                _ => return None,
            };
            Some((relation, value))
        });
        solved.collect()
    }

    /// Whether a point of the domain is found: what a way supposes may hold nowhere.
    pub fn has_points(&self) -> bool {
        let names = self.scene.parameters.iter().map(|p| Expr::symbol(&p.name));
        let sum = Expr::sum(names.collect::<Vec<_>>());
        let twice = &sum + &sum;
        let compared = equality::decide(&sum, &twice, &self.scene.domains);
        sum.is_zero() || compared.equality.is_different()
    }

    /// The questions that have an answer.
    pub fn answered(&self) -> impl Iterator<Item = &scene::Question> {
        let answers = &self.derivation.answers;
        let answered = |q: &&scene::Question| answers.iter().any(|a| a.question == q.name);
        self.scene.questions.iter().filter(answered)
    }

    /// Names of everything that can be asked, vectors before their components.
    pub fn quantities(&self) -> Vec<String> {
        let mut names: Vec<String> = self.answered().map(|q| q.name.clone()).collect();
        for answer in &self.derivation.answers {
            if !names.contains(&answer.name) {
                names.push(answer.name.clone());
            }
        }
        names
    }

    /// What the scene declares of its symbols.
    pub fn question(&self) -> Question {
        let parameters = self.scene.parameters.iter();
        let symbols = parameters
            .map(|p| Given::new(p.name.clone(), p.latex.clone(), Some(p.dimension.clone())));
        Question {
            symbols: symbols.collect(),
            domains: self.scene.domains.clone(),
            closed: true,
            asked: Vec::new(),
            dimension: None,
        }
    }

    /// The key of a quantity, or why there is none.
    pub fn entry(&self, name: &str) -> Result<Entry, String> {
        let answers = &self.derivation.answers;
        let mut chosen: Vec<&Answer> = answers.iter().filter(|a| a.question == name).collect();
        let mut component = None;
        if chosen.is_empty() {
            if let Some(entry) = self.in_relations(name) {
                return Ok(entry);
            }
            let cases = self.all.iter().filter(|a| is_case(&a.name));
            let answer = answers.iter().chain(cases).find(|a| a.name == name);
            let answer = answer.ok_or_else(|| self.without_value(name))?;
            let plain = without_case(name);
            component = (plain != answer.question).then(|| usize::from(plain.ends_with("_y")));
            chosen.push(answer);
        }
        let first = chosen[0];
        let question = self.scene.question(&first.question);
        let question = question.ok_or_else(|| format!("{name:?} is not asked"))?;
        let mut declared = self.question();
        declared.dimension = Some(first.dimension.clone());
        declared.domains = where_it_is(&chosen, declared.domains);
        let latex = component.map_or(question.latex.clone(), |_| Some(first.latex.clone()));
        // Without the mark of the moment after, where nothing else is called so.
        let bare = latex.as_deref().and_then(|l| l.strip_suffix("^{+}"));
        let spelled = [latex.clone(), bare.map(String::from)];
        let spelled = (spelled.into_iter().enumerate()).filter(|(i, l)| *i == 0 || l.is_some());
        let asked = spelled.map(|(_, l)| Given::new(name, l, Some(first.dimension.clone())));
        declared.asked.extend(asked);
        // `d = …` and `d ≤ …` answer a question about d.
        let bound = self.bounds().find(|b| b.name == first.name);
        let bound = bound.map(|b| Given::new(b.parameter, None, Some(first.dimension.clone())));
        declared.asked.extend(bound);
        let plain = first.words.trim_end_matches(", along x");
        let mut words = plain.trim_end_matches(", along y");
        let content = match &first.form {
            Form::Equation { left, right } => {
                declared.asked.clear();
                declare_unknowns(self, &mut declared);
                words = &first.words;
                let sides = [left, right].map(|side| Content::Scalar(side.clone()));
                Content::Relations(sides.into(), vec![Relation::Equal])
            }
            Form::Matrix(matrix) => {
                declare_unknowns(self, &mut declared);
                declared.dimension = None;
                words = &first.words;
                Content::Matrix(matrix.entries.clone())
            }
            _ => {
                let values = chosen.iter().map(|answer| answer.formula());
                let values: Option<Vec<&Expr>> = values.collect();
                let open = || format!("{name} is not determined by the laws of the scene");
                match values.ok_or_else(open)?[..] {
                    [one] => Content::Scalar(one.clone()),
                    [x, y] => Content::Vector([x.clone(), y.clone(), Expr::zero()]),
                    _ => return Err(format!("{name} has no single value")),
                }
            }
        };
        Ok(Entry {
            name: name.to_string(),
            question: question.clone(),
            component,
            words: words.to_string(),
            key: key_of(content, &declared),
        })
    }

    /// Why there is no key of a quantity that no answer is of.
    fn without_value(&self, name: &str) -> String {
        let all = self.quantities().join(", ");
        match self.scene.question(name) {
            Some(_) => format!(
                "the scene finds no value for {name:?} (`carom derive` says why); it has {all}"
            ),
            None => format!("the scene asks for no {name:?}; it asks for {all}"),
        }
    }

    /// The key of an answer that is no single value, where relations of a parameter say it.
    fn in_relations(&self, name: &str) -> Option<Entry> {
        let answer = self.all.iter().find(|a| a.name == name)?;
        let question = self.scene.question(&answer.question)?;
        let content = told::relations(answer)?;
        let mut declared = self.question();
        declared.domains = where_it_is(&[answer], declared.domains);
        Some(Entry {
            name: name.to_string(),
            question: question.clone(),
            component: None,
            words: answer.words.clone(),
            key: key_of(content, &declared),
        })
    }

    /// The wrong answers to a quantity that single beliefs lead to, in closed form; those to one component of a vector where
    /// the entry is about one.
    pub fn believed(&self, entry: &Entry) -> Vec<Believed> {
        let values = match &entry.key.reading.content {
            Content::Scalar(e) => vec![e.clone()],
            Content::Vector([x, y, _]) => vec![x.clone(), y.clone()],
            _ => return Vec::new(),
        };
        let (scene, ask) = self.impact(entry);
        believed::answers(&Written {
            scene,
            ask,
            component: entry.component,
            values,
            rounding: None,
        })
    }

    /// Adds to findings about printed formulas and numbers the belief that produces exactly what is printed.
    pub fn explain(&self, findings: &mut [Finding]) {
        for (printed, finding) in self.scene.printed.iter().zip(findings) {
            let (name, text) = match &printed.what {
                Print::Formula { item, text } => (item, text),
                Print::Number { of, text, .. } => (of, text),
                _ => continue,
            };
            // Of a row of several sides the judge would take the last, and another may be the wrong one.
            let as_it_stands = printed.at.is_empty()
                && printed.short.is_empty()
                && printed.small.is_empty()
                && formula::relations(text).count() < 2;
            let slips = ["comes out when", "right up to the factor"];
            let known = finding.explained.as_ref().filter(|e| explains(e));
            let open = known.is_none_or(|e| slips.iter().any(|slip| e.starts_with(slip)));
            let grade = match finding.holds {
                Some(false) if as_it_stands && open => self
                    .entry(name)
                    .map(|entry| self.judge(&entry, text, &Options::default())),
                _ => continue,
            };
            if let Ok(grade) = grade
                && let ("DIFF_BELIEF", Some(first)) = (grade.note, grade.diagnosis.first())
            {
                finding.explained = Some(match known {
                    Some(known) => format!("{known}; or {}", first.message),
                    None => first.message.clone(),
                });
            }
        }
    }
}

/// Names of the unknown motion, for equations that hold them.
fn declare_unknowns(sheet: &Sheet, question: &mut Question) {
    let unknowns = crate::laws::unknowns(&sheet.scene).into_iter();
    let unknowns = unknowns.map(|u| (sheet.derivation.names.plain(u).to_string(), None));
    let asked = sheet.scene.questions.iter();
    let asked = asked.map(|q| (q.name.clone(), q.latex.clone()));
    for (name, latex) in unknowns.chain(asked) {
        let name = Symbol::from(name.as_str());
        if question.symbols.iter().any(|g| g.name == name) {
            continue;
        }
        let real = crate::domain::Domain::real();
        question.domains.symbols.insert(name.clone(), real);
        question.symbols.push(Given::new(name, latex, None));
    }
}
