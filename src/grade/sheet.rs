//! A scene as an answer sheet: its derived answers are the keys, its parameters and domains the declarations.

use super::{Given, Grade, Key, Options, Question, judge_against, key_of};
use crate::derive::{self, Answer, Derivation, Form};
use crate::expr::{Expr, Symbol};
use crate::formula::{Content, Relation};
use crate::scene::{Ask, Scene};

/// A scene with its answers.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// The scene.
    pub scene: Scene,
    /// Its derivation.
    pub derivation: Derivation,
}

/// A quantity of a sheet: a question, or one component of its answer.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Name of the answer.
    pub name: String,
    /// What is asked.
    pub ask: Ask,
    /// Component along x (0) or y (1), where only one of a vector's is asked for.
    pub component: Option<usize>,
    /// What it is, in words.
    pub words: String,
    /// The key.
    pub key: Key,
}

/// Derives a scene's answers.
pub fn sheet(scene: Scene) -> Result<Sheet, derive::Stop> {
    let derivation = derive::derive(&scene)?;
    Ok(Sheet { scene, derivation })
}

impl Sheet {
    /// Names of everything that can be asked, vectors before their components.
    pub fn quantities(&self) -> Vec<String> {
        let mut names: Vec<String> = self
            .scene
            .questions
            .iter()
            .map(|q| q.name.clone())
            .collect();
        for answer in &self.derivation.answers {
            if !names.contains(&answer.name) {
                names.push(answer.name.clone());
            }
        }
        names
    }

    /// What the scene declares of its symbols.
    pub fn question(&self) -> Question {
        let symbols = self.scene.parameters.iter().map(|p| Given {
            name: p.name.clone(),
            latex: p.latex.clone(),
            dimension: Some(p.dimension.clone()),
        });
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
        let answers: Vec<&Answer> = self
            .derivation
            .answers
            .iter()
            .filter(|a| a.question == name)
            .collect();
        let (chosen, component) = match answers.as_slice() {
            [] => {
                let found = self.derivation.answers.iter().find(|a| a.name == name);
                let answer = found.ok_or_else(|| {
                    format!(
                        "the scene asks for no {name:?}; it asks for {}",
                        self.quantities().join(", ")
                    )
                })?;
                (vec![answer], Some(usize::from(answer.name.ends_with("_y"))))
            }
            all => (all.to_vec(), None),
        };
        let first = chosen[0];
        let question = self
            .scene
            .questions
            .iter()
            .find(|q| q.name == first.question);
        let question = question.ok_or_else(|| format!("{name:?} is not asked"))?;
        let mut declared = self.question();
        declared.dimension = Some(first.dimension.clone());
        declared.asked.push(Given {
            name: Symbol::from(name),
            latex: component.map_or(question.latex.clone(), |_| Some(first.latex.clone())),
            dimension: Some(first.dimension.clone()),
        });
        let mut values = Vec::new();
        for answer in &chosen {
            match &answer.form {
                Form::Value { closed, .. } => values.push(closed.clone()),
                Form::Equation { left, right } => {
                    let sides = vec![
                        Content::Scalar(left.clone()),
                        Content::Scalar(right.clone()),
                    ];
                    declared.asked.clear();
                    declare_unknowns(self, &mut declared);
                    let content = Content::Relations(sides, vec![Relation::Equal]);
                    return Ok(Entry {
                        name: name.to_string(),
                        ask: question.ask.clone(),
                        component,
                        words: first.words.clone(),
                        key: key_of(content, &declared),
                    });
                }
                Form::Matrix(_) => {
                    return Err(format!(
                        "{name} is a matrix; its entries are checked by `carom verify`"
                    ));
                }
                Form::Open(_) => {
                    return Err(format!("{name} is not determined by the laws of the scene"));
                }
            }
        }
        let content = match values.as_slice() {
            [one] => Content::Scalar(one.clone()),
            [x, y] => Content::Vector([x.clone(), y.clone(), Expr::zero()]),
            _ => return Err(format!("{name} has no single value")),
        };
        Ok(Entry {
            name: name.to_string(),
            ask: question.ask.clone(),
            component,
            words: first
                .words
                .trim_end_matches(", along x")
                .trim_end_matches(", along y")
                .to_string(),
            key: key_of(content, &declared),
        })
    }

    /// Judges an answer for a quantity of the scene.
    pub fn judge(&self, entry: &Entry, answer: &str, options: &Options) -> Grade {
        judge_against(&entry.key, answer, options)
    }
}

/// Names of the unknown motion, for equations that hold them.
fn declare_unknowns(sheet: &Sheet, question: &mut Question) {
    for unknown in crate::laws::unknowns(&sheet.scene) {
        let name = Symbol::from(sheet.derivation.names.plain(unknown));
        question
            .domains
            .symbols
            .insert(name.clone(), crate::domain::Domain::real());
        question.symbols.push(Given {
            name,
            latex: None,
            dimension: None,
        });
    }
    for q in &sheet.scene.questions {
        let name = Symbol::from(q.name.as_str());
        if !question.symbols.iter().any(|g| g.name == name) {
            question
                .domains
                .symbols
                .insert(name.clone(), crate::domain::Domain::real());
            question.symbols.push(Given {
                name,
                latex: q.latex.clone(),
                dimension: None,
            });
        }
    }
}
