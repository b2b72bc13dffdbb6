//! Scenes as questions of learning platforms: a question for each number asked, its wrong answers with what leads to them,
//! and variants with exact values.
//!
//! In: a proved answer sheet and the worked solution as HTML. Out: a STACK quiz, plain Moodle questions or a Numbas exam.
//! Each format has one writer and one function that escapes.

mod moodle;
mod names;
mod numbas;
mod stack;
mod variant;

use crate::answer::Form;
use crate::expr::{Expr, Symbol};
use crate::figure::escape;
use crate::formula::{Sentence, latex_name, write_plain};
use crate::grade::believed::Believed;
use crate::grade::sheet::{Entry, Sheet};
use crate::render::{html, naming};
use crate::scene::Scene;
use crate::solution::{self, Inline};
use variant::{Asked, Exact, Variant};

pub use moodle::moodle;
pub use numbas::numbas;
pub use stack::stack;

/// Longest closed form of an answer, in nodes; more is no answer to type.
const LARGEST: usize = 400;
/// Variants of a question.
const VARIANTS: usize = 5;

/// What questions show besides words, as HTML.
#[derive(Clone, Debug, Default)]
pub struct Shown {
    /// The picture of how it begins.
    pub figure: String,
    /// The worked solution.
    pub solution: String,
}

/// A scene as questions.
#[derive(Clone, Debug)]
pub struct Exercise {
    title: String,
    /// What is told, as plain text.
    statement: String,
    /// The same with its symbols typeset, as HTML.
    typeset: String,
    shown: Shown,
    symbols: Vec<Given>,
    items: Vec<Item>,
    /// What became no question, and why.
    pub left_out: Vec<String>,
}

/// A symbol an answer may hold.
#[derive(Clone, Debug)]
struct Given {
    name: Symbol,
    latex: String,
    unit: String,
    /// As HTML.
    meaning: String,
    /// Whether the symbol is never negative.
    is_positive: bool,
}

/// A question.
#[derive(Clone, Debug)]
struct Item {
    name: String,
    /// What is asked, in words.
    words: String,
    /// The conditions that the answer rests on, as HTML.
    given: String,
    latex: String,
    unit: String,
    answer: Expr,
    wrong: Vec<Wrong>,
    variants: Vec<Variant>,
}

/// A wrong answer that a belief leads to.
#[derive(Clone, Debug)]
struct Wrong {
    code: &'static str,
    belief: String,
    hint: String,
    answer: Expr,
}

/// The questions of a sheet; `file` is the scene as its file has it, `assumed` what its stages suppose, to which the values of
/// variants keep where they can. The words say why there are no questions, and what would help.
pub fn exercise(
    sheet: &Sheet,
    file: &Scene,
    shown: Shown,
    assumed: &[Sentence],
) -> Result<Exercise, String> {
    let scene = &sheet.scene;
    let names = naming(scene);
    let typeset = |text: &str| html::typeset(scene, &names, text);
    let symbols = scene.parameters.iter().map(|p| Given {
        name: p.name.clone(),
        latex: p.latex.clone().unwrap_or_else(|| latex_name(&p.name)),
        unit: no_one(p.unit.clone()),
        meaning: typeset(&p.meaning),
        is_positive: match scene.domains.symbols.get(&p.name) {
            Some(domain) => domain.low.as_ref().is_some_and(|l| l.approximate() >= 0.0),
            None => true,
        },
    });
    let mut exercise = Exercise {
        title: scene.title.clone(),
        statement: scene.statement.clone(),
        typeset: typeset(&scene.statement),
        shown,
        symbols: symbols.collect(),
        items: Vec::new(),
        left_out: Vec::new(),
    };
    for answer in &sheet.derivation.answers {
        let item = match &answer.form {
            Form::Value { .. } => {
                let entry = sheet.entry(&answer.name);
                entry.and_then(|entry| item(sheet, file, &entry, [&answer.assumptions, assumed]))
            }
            Form::Open(_) => Err(String::from("the laws do not determine it")),
            Form::Equation { .. } => Err(String::from("an equation has no one formula to type")),
            Form::Matrix(_) => Err(String::from("a matrix is no answer to type")),
            Form::Words => Err(String::from("it is told in words")),
        };
        match item {
            Ok(item) => exercise.items.push(Item {
                latex: answer.latex.clone(),
                unit: no_one(answer.unit(scene)),
                ..item
            }),
            Err(why) => exercise.left_out.push(format!("{}: {why}", answer.name)),
        }
    }
    match exercise.items.is_empty() {
        false => Ok(exercise),
        true => Err(format!(
            "nothing to ask on a learning platform: {}\nhint: add a question for a velocity, a spin, an impulse or an energy that has a closed form",
            exercise.left_out.join("; ")
        )),
    }
}

/// The question for an entry, whose answer rests on what is given; and what the stages suppose.
fn item(
    sheet: &Sheet,
    file: &Scene,
    entry: &Entry,
    [given, supposed]: [&[Sentence]; 2],
) -> Result<Item, String> {
    let scene = &sheet.scene;
    let Some(answer) = entry.key.reading.content.expr() else {
        return Err(String::from("its components are asked one by one"));
    };
    let is_given = |s: &Symbol| scene.parameter(s).is_some();
    if !answer.symbols().iter().all(is_given) || answer.size() > LARGEST {
        return Err(String::from("its closed form goes over several lines"));
    }
    if answer.is_constant() {
        return Err(format!("it is {} whatever the values", write_plain(answer)));
    }
    let believed = sheet.believed(entry).into_iter();
    let wrong: Vec<Wrong> = believed.filter_map(|b| wrong(file, b)).collect();
    let names = naming(scene);
    let conditions = given.iter().filter(|words| words.is_condition());
    let conditions = conditions.map(|s| html::sentence(&names, &solution::sentence(file, s)));
    Ok(Item {
        name: entry.name.clone(),
        words: called(file, &entry.words),
        given: conditions.collect::<Vec<_>>().join(", and that "),
        latex: String::new(),
        unit: String::new(),
        variants: variant::variants(&Asked {
            scene: file,
            derived: scene,
            name: &entry.name,
            answer,
            wrong: &wrong,
            given,
            supposed,
        }),
        answer: answer.clone(),
        wrong,
    })
}

fn wrong(scene: &Scene, believed: Believed) -> Option<Wrong> {
    let [answer] = believed.values.try_into().ok()?;
    Some(Wrong {
        code: believed.diagnosis.code,
        belief: called(scene, &believed.diagnosis.message),
        hint: called(scene, &believed.diagnosis.hint),
        answer,
    })
}

/// Words with what stands between marks in them called as in a solution.
fn called(scene: &Scene, words: &str) -> String {
    let pieces = solution::sentence(scene, &Sentence::words(words));
    let words = pieces.into_iter().map(|piece| match piece {
        Inline::Text(words) => words,
        Inline::Math(_) => String::new(),
    });
    words.collect()
}

/// HTML of others in which a platform and its typesetting see no marks of their own: these are parted by an empty element.
fn quiet(html: &str) -> String {
    ["[[", "{@", "{#", "\\(", "\\[", "$$"]
        .iter()
        .fold(html.to_string(), |text, mark| {
            let (first, rest) = mark.split_at(1);
            text.replace(mark, &format!("{first}<span></span>{rest}"))
        })
}

/// A text, HTML among it, as the content of an XML element.
fn xml(text: &str) -> String {
    let allowed = |c: &char| !c.is_control() || matches!(c, '\n' | '\t');
    let kept: String = text.chars().filter(allowed).collect();
    kept.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

/// Words of a scene as such HTML.
fn words(text: &str) -> String {
    quiet(&escape(text))
}

/// A unit as it is told: nothing for a pure number.
fn no_one(unit: String) -> String {
    if unit == "1" { String::new() } else { unit }
}

impl Item {
    /// What the answer is asked for under, behind the words of a question; `quiet` as with what is told.
    fn given(&self, quiet: fn(&str) -> String) -> String {
        match self.given.as_str() {
            "" => String::new(),
            given => format!(", given that {}", quiet(given)),
        }
    }
}

impl Exercise {
    /// Symbols with a value each, the way `written` writes them.
    fn valued(&self, variant: &Variant, written: impl Fn(&Symbol, &Exact) -> String) -> String {
        let latex = |name: &Symbol| {
            let given = self.symbols.iter().find(|g| g.name == *name);
            given.map_or(name.to_string(), |g| g.latex.clone())
        };
        let values = variant.values.iter();
        let values =
            values.map(|(s, v)| format!("\\({} = {}\\)", escape(&latex(s)), written(s, v)));
        values.collect::<Vec<_>>().join(", ")
    }

    /// What is told and shown, and what the symbols mean, as HTML: `quiet` keeps what comes from the scene from meaning
    /// something on the platform, `written` spells the symbols as they are typed.
    fn told(&self, quiet: fn(&str) -> String, written: &dyn Fn(&Symbol) -> String) -> String {
        let rows = self.symbols.iter().map(|g| {
            format!(
                "<tr><td>\\({}\\)</td><td><code>{}</code></td><td>{}</td><td>{}</td></tr>",
                escape(&g.latex),
                quiet(&escape(&written(&g.name))),
                quiet(&g.meaning),
                quiet(&escape(&g.unit))
            )
        });
        format!(
            "<p>{}</p>{}<table><tr><th>symbol</th><th>typed as</th><th>meaning</th><th>unit</th></tr>{}</table>",
            quiet(&self.typeset),
            quiet(&self.shown.figure),
            rows.collect::<String>()
        )
    }
}
