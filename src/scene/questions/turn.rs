//! What is asked of the turn of any number in a repeated group: `{"turn": "n", "of": "h_#"}`.

use super::answers::Reader;
use crate::domain::{Domain, Limit};
use crate::expr::{Expr, Symbol, ratio};
use crate::scene::claim::{Claim, Claimed};
use crate::scene::formulas::Symbols;
use crate::scene::question_file::QuestionFile;
use crate::scene::record::{Formula, Text};
use crate::scene::resolver::Resolver;
use crate::scene::{Ask, Scene, Turns};

/// How such a question is asked.
const SO: &str = "\"h_n\": {\"turn\": \"n\", \"of\": \"h_#\"}, where n is a parameter without unit and `h_#` is asked in the group";
/// Fewest turns from which it is seen how one goes over into the next.
const FEWEST: usize = 2;

/// Reads the question.
pub(super) fn ask(
    base: &mut Resolver<'_>,
    symbols: &Symbols,
    scene: &Scene,
    number: &Text,
    q: &QuestionFile,
) -> Option<Ask> {
    let Some(of) = q.of.as_ref().filter(|of| of.text.contains('#')) else {
        let message = "a question about any turn needs the answers of one turn, `of`";
        return base.refuse(number.span, message, SO);
    };
    if scene
        .parameter(&Symbol::from(number.text.as_str()))
        .is_none()
    {
        let message = format!("there is no parameter `{}` to count the turns", number.text);
        let hint = format!(
            "add \"{}\": {{\"unit\": \"1\"}} to `parameters`",
            number.text
        );
        return base.refuse(number.span, message, hint);
    }
    let mut reader = Reader { base, symbols };
    let name = reader.parameter(number)?;
    let parameter = scene.parameter(&name)?;
    if !parameter.dimension.is_none() || parameter.is_angle() {
        let message = format!("`{name}` counts turns, and has no unit");
        return base.refuse(number.span, message, SO);
    }
    let mut read = |turn: usize| {
        reader.formula(&Formula {
            span: of.span,
            text: of.text.replace('#', &turn.to_string()),
            start: None,
        })
    };
    let first = read(1)?;
    let Some(turns) = group(scene, &first) else {
        let message = "these are not answers of the first turn of one repeated group";
        return base.refuse(of.span, message, SO);
    };
    let of: Option<Vec<Expr>> = (1..=turns.times).map(read).collect();
    let of = of?;
    let fault = match () {
        () if turns.times < FEWEST => Some("one turn does not show how it goes on"),
        () if !hands_on(scene, &turns) => Some("a turn has to begin where the one before ends"),
        () if counts(scene, &name) => Some("the number of the turn stands in no motion or impact"),
        () => None,
    };
    if let Some(message) = fault {
        let hint = "write \"repeat\": 3, and let the number of turns be a parameter of its own";
        return base.refuse(number.span, message, hint);
    }
    base.claims.push(Claimed {
        span: number.span,
        claim: Claim::Whole(name.clone()),
    });
    Some(Ask::Turn {
        number: name,
        turns,
        of,
        total: q.total == Some(true),
    })
}

/// The group in whose first turn everything is asked that a formula holds.
fn group(scene: &Scene, formula: &Expr) -> Option<Turns> {
    let mut asked = Vec::new();
    stages(scene, formula, &mut asked);
    let mut groups = scene.turns.iter().copied();
    groups.find(|g| !asked.is_empty() && asked.iter().all(|i| g.turn(1).contains(i)))
}

/// The stages of which the answers in a formula are asked.
fn stages(scene: &Scene, formula: &Expr, out: &mut Vec<usize>) {
    for question in formula.symbols().iter().filter_map(|s| scene.answering(s)) {
        match &question.ask {
            Ask::Value { formula, .. } => stages(scene, formula, out),
            _ => out.extend(question.stage),
        }
    }
}

/// Whether the first two turns begin where what is before them ends, and stay among themselves.
fn hands_on(scene: &Scene, turns: &Turns) -> bool {
    (1..=2).all(|k| {
        let range = turns.turn(k);
        let first = &scene.stages[range.start];
        let inside = range.clone().skip(1);
        let mut others = inside.map(|i| scene.stages[i].from);
        first.from == range.start.checked_sub(1)
            && first.start.is_empty()
            && others.all(|from| from.is_some_and(|from| range.contains(&from)))
    })
}

/// Whether a parameter stands in what happens.
fn counts(scene: &Scene, name: &Symbol) -> bool {
    let mut found = false;
    for stage in &scene.stages {
        let mut look = |e: &mut Expr| found |= e.mentions(name);
        stage.clone().formulas_mut(&mut look);
        let bodies = stage.scene.bodies.iter();
        let moving = bodies.flat_map(|b| b.velocity.iter().chain([&b.spin, &b.mass, &b.inertia]));
        found |= moving.into_iter().any(|e| e.mentions(name));
    }
    found
}

/// Numbers of turns are 1 or more, wherever they stand.
pub(super) fn live(scene: &mut Scene) {
    let numbers: Vec<Symbol> = (scene.questions.iter())
        .filter_map(|q| match &q.ask {
            Ask::Turn { number, .. } => Some(number.clone()),
            _ => None,
        })
        .collect();
    let one = Limit::number(ratio(1, 1), false);
    for name in numbers {
        let stages = scene.stages.iter_mut().map(|s| &mut s.scene.domains);
        for domains in stages.chain([&mut scene.domains]) {
            let domain = domains
                .symbols
                .entry(name.clone())
                .or_insert_with(Domain::real);
            let is_less = |low: &Limit| low.of_pi || low.value < one.value;
            if domain.low.as_ref().is_none_or(is_less) {
                domain.low = Some(one.clone());
            }
        }
    }
}
