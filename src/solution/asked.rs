//! What is asked beyond the motion: thresholds, largest values, limits, identities, words. One function turns an answer into
//! the section of a worked solution, whether the scene has stages or not.

use super::given::given_that;
use super::heading::{because, further, goes_on, heading};
use super::isolate::on_the_way;
use super::known::{defined, is_fresh, known, number, worth_telling};
use super::near::{near, stands_for};
use super::neat::{alike, tidied};
use super::opening::NUMBERS;
use super::sentence::{called, full_sentence, sentence};
use super::words::{self, fill, say};
use super::{Claim, Detail, Inline, Line, Math, Part, Solution};
use crate::algebra::{Sign, sign};
use crate::answer::{Answer, Form};
use crate::expr::{Expr, Node, Point, Symbol};
use crate::formula::Relation;
use crate::formula::{Piece, Sentence};
use crate::scene::{Ask, Extremum, Scene};

/// Largest formula, in nodes, that is worth a line on the way to an identity.
const READABLE: usize = 120;

/// Adds what is asked beyond the motion, a section for each question.
pub(super) fn beyond_motion(solution: &mut Solution, scene: &Scene, answers: &[Answer]) {
    let mut before: Option<&Ask> = None;
    // Questions about one form, told together.
    let mut forms: Vec<&str> = Vec::new();
    let mut said_of_turns: Vec<Sentence> = Vec::new();
    for question in &scene.questions {
        // What happens in a stage stands where the stage is told.
        let in_stage = matches!(
            question.ask,
            Ask::Assumed | Ask::Describe | Ask::Reaction { .. }
        );
        // So does a speed by its components.
        let stands = solution.meanings.contains_key(question.name.as_str());
        // What explains the answers is no part of a brief solution.
        let explains = matches!(
            question.ask,
            Ask::Impulsive | Ask::Remark(_) | Ask::Unused(_)
        );
        let left_out = explains && solution.detail == Detail::Brief;
        if question.ask.is_motion() || in_stage || stands || left_out {
            continue;
        }
        let mine = answers.iter().filter(|a| a.question == question.name);
        let mut mine: Vec<Answer> = mine.cloned().collect();
        for answer in &mut mine {
            as_it_stands(scene, &question.ask, answers, answer);
        }
        if mine.is_empty() {
            continue;
        }
        let ask = &question.ask;
        let told = before.is_some_and(|before| goes_on(before, ask));
        if let Ask::Approximate { .. } = ask {
            if !told {
                forms = near(solution, scene, question, answers);
            }
            if forms.contains(&question.name.as_str()) {
                before = Some(ask);
                continue;
            }
        }
        if let (Ask::Turn { .. }, true) = (ask, told) {
            // Why it is so for every turn stands with the first of them.
            for a in &mut mine {
                a.text.retain(|t| !said_of_turns.contains(t));
            }
        }
        if let Ask::Turn { .. } = ask {
            said_of_turns.extend(mine.iter().flat_map(|a| a.text.clone()));
        }
        let Some(first) = mine.first() else {
            continue;
        };
        match told {
            true => further(solution, ask, first),
            false => solution.section(0, heading(scene, ask, first)),
        }
        let meaning = match ask {
            Ask::Value { meaning, .. } => meaning.as_str(),
            Ask::Friction { .. } => &first.words,
            _ => "",
        };
        if let Some(reason) = because(solution, meaning)
            && solution.detail != Detail::Brief
        {
            solution.text(reason);
        }
        if let Ask::Extremum { which, of, over } = ask
            && slope(solution, scene, answers, (*which, of, over), &mine)
        {
            // The place comes out of that equation, and the value after it.
            mine.sort_by_key(|a| a.range.is_empty());
        }
        answered(solution, scene, ask, &mine);
        before = Some(ask);
    }
}

/// A condition on an answer begins with that answer as it stands on the page: arccos x, where reckoning made π/2 − arcsin x of it.
fn as_it_stands(scene: &Scene, ask: &Ask, answers: &[Answer], condition: &mut Answer) {
    let (Ask::Condition { left, .. }, Some((stated, ..))) = (ask, condition.stated.as_mut()) else {
        return;
    };
    let named = |a: &&Answer| left.as_symbol().is_some_and(|name| *a.name == **name);
    if let Some(formula) = answers.iter().find(named).and_then(Answer::formula)
        && tidied(scene, formula) == *stated
    {
        stated.clone_from(formula);
    }
}

/// Where a value is largest or least: inside its range its derivative vanishes, and at an end it has one sign all the way. Whether there
/// was anything to say.
fn slope(
    solution: &mut Solution,
    scene: &Scene,
    answers: &[Answer],
    (which, of, over): (Extremum, &Expr, &[Symbol]),
    mine: &[Answer],
) -> bool {
    let place = mine.iter().find_map(|a| a.range.first());
    let Some((at, Relation::Equal, place)) = place else {
        return false;
    };
    // Of several in one combination, each does the same: one in whose first power it goes.
    let share = |p: &Symbol| tidied(scene, &(at / &Expr::symbol(p)));
    let alone = |p: &&Symbol| !share(p).mentions(p);
    let Some(p) = over.iter().find(alone) else {
        return false;
    };
    let place = &(place / &share(p));
    let known = answers.iter();
    let known = known.filter_map(|a| Some((Symbol::from(a.name.as_str()), a.formula()?.clone())));
    let slope = tidied(scene, &of.substitute(&known.collect()).derivative(p));
    let there = std::collections::BTreeMap::from([(p.clone(), place.clone())]);
    let vanishes = tidied(scene, &slope.substitute(&there)).is_zero();
    let (lead, relation) = match sign(&slope, &scene.domains) {
        Some(Sign::Negative | Sign::NotPositive) => {
            ("It nowhere grows with {}, since its derivative is", "≤")
        }
        Some(Sign::Positive | Sign::NotNegative) => {
            ("It nowhere falls with {}, since its derivative is", "≥")
        }
        _ if vanishes => {
            let form = match which {
                Extremum::Largest => {
                    "It is largest where its derivative with respect to {} vanishes:"
                }
                Extremum::Least => "It is least where its derivative with respect to {} vanishes:",
            };
            (form, "=")
        }
        _ => return false,
    };
    if slope.size() > READABLE {
        return false;
    }
    solution.text(fill(lead, [words::formula(&Expr::symbol(p))]));
    let math = words::related(&slope, relation, &Expr::zero());
    let mut lines = vec![Line::plain(math)];
    if relation == "="
        && let Some(math) = square_of(scene, &slope, p, place)
    {
        lines.push(Line::plain(math));
    }
    solution.display(lines);
    true
}

/// The square that a factor of two terms gives where it vanishes: of 1 − 5 sin²θ, sin²θ = 1/5.
fn square_of(scene: &Scene, slope: &Expr, p: &Symbol, place: &Expr) -> Option<Vec<Math>> {
    let there = std::collections::BTreeMap::from([(p.clone(), place.clone())]);
    let vanishes = |e: &&Expr| tidied(scene, &e.substitute(&there)).is_zero();
    let factor = slope.factors().iter().find(vanishes)?;
    let [one, other] = factor.terms() else {
        return None;
    };
    let (varies, rest) = match (one.mentions(p), other.mentions(p)) {
        (true, false) => (one, other),
        (false, true) => (other, one),
        _ => return None,
    };
    let square = varies.factors().iter().find(|f| f.mentions(p))?;
    let value = tidied(scene, &(-rest / (varies / square)));
    let is_square = matches!(square.node(), Node::Power(_, n) if *n == Expr::from(2));
    let equation = words::related(square, "=", &value);
    (is_square && !value.mentions(p)).then(|| [vec![Math::Op("⇒")], equation].concat())
}

/// Adds a section with the answers to one question, in the order given.
fn answered(solution: &mut Solution, scene: &Scene, ask: &Ask, answers: &[Answer]) {
    for (i, answer) in answers.iter().enumerate() {
        let checks = |a: &Answer| known(&a.checks);
        let told = i > 0 && checks(&answers[i - 1]) == checks(answer);
        body(solution, scene, ask, answer, told);
    }
}

/// One answer; `told` where its checks stand with the one before.
fn body(solution: &mut Solution, scene: &Scene, ask: &Ask, answer: &Answer, told: bool) {
    let symbol = Expr::symbol(&answer.name);
    let parameter = scene.parameters.iter().any(|p| *p.name == *answer.name);
    let fresh = !parameter && is_fresh(solution, answer);
    let brief = solution.detail == Detail::Brief;
    given_that(solution, scene, ask, answer);
    let mut lines: Vec<Line> = Vec::new();
    let plain = |e: &Expr| e.as_number().is_some();
    let stated = answer.stated.iter();
    for (left, relation, right) in stated.filter(|(l, _, r)| !plain(l) || !plain(r)) {
        lines.push(Line::plain(words::related(left, relation.sign(), right)));
    }
    if let (Some(stated), [range], Ask::Condition { .. }) = (&answer.stated, &*answer.range, ask)
        && !brief
    {
        let way = on_the_way(scene, stated, range).into_iter();
        let short = way.filter(|(left, _, right)| left.size() + right.size() <= READABLE);
        lines.extend(short.map(|(l, op, r)| Line::plain(words::related(&l, op.sign(), &r))));
    }
    // The name of the answer comes first, so that what shows the answer is a claim about it. A parameter that is asked for keeps
    // its name.
    if let Ask::AngularMomentum { body, about, .. } = ask
        && !brief
    {
        let line = moment_of_momentum(scene, *body, scene.named_at(about));
        lines.extend(line.filter(|line| !solution.shows(&line.math)));
    }
    let named = answer.formula().filter(|_| !parameter);
    let defined = named.map(|formula| defined(solution, answer, formula, fresh));
    let shown = claims(scene, ask, answer, named.map(|f| (&symbol, f)));
    let reason = answer.put_in.first().map_or("what is asked", |p| p.2);
    let shown = (!shown.is_empty()).then(|| solution.step(Vec::new(), shown, reason));
    if let (Some(_), Some(step)) = (&shown, solution.steps.last_mut()) {
        step.needs = answer.needs.iter().map(|(_, e, _)| e.clone()).collect();
    }
    if let Ask::Show { .. } = ask {
        lines.extend(identity(solution, scene, ask, answer, &shown));
    }
    let named_step = defined.or_else(|| shown.clone());
    let found = found(scene, ask, answer, [&shown, &named_step], fresh);
    solution.display(lines);
    if !found.is_empty() {
        solution.push(Part::Result(found));
    }
    // Of a parameter that is solved for, the number is its own.
    let of = match answer.range.as_slice() {
        [(solved, Relation::Equal, _)]
            if solved.as_symbol().is_some() && !is_extreme(ask, answer) =>
        {
            solved.clone()
        }
        _ => symbol,
    };
    let stands = stands_for(ask, answer).is_some();
    if let Some(value) = number(scene, answer).filter(|_| !stands) {
        let radians =
            |p: &crate::scene::Parameter| Some(&p.name) == of.as_symbol() && p.unit == "rad";
        let in_degrees = answer.formula().filter(|e| ask.is_angle() || e.is_arc());
        let in_degrees = in_degrees.and_then(|e| {
            e.substitute(&scene.values())
                .evaluate(&Point::<f64>::default())
        });
        let is_angle = in_degrees.is_some() || scene.parameters.iter().any(radians);
        let unit = match is_angle && !value.ends_with(" rad") {
            true => " rad",
            false => "",
        };
        let in_degrees = in_degrees.map(|angle| {
            let degrees = format!("{:.1}", angle.to_degrees());
            format!(", or {}°", crate::formula::trimmed(&degrees))
        });
        let unit = format!("{unit}{}", in_degrees.unwrap_or_default());
        let value = say(format!("{value}{unit}."));
        // Numbers without symbols rest on no values of the scene.
        let is_plain = answer.formula().is_some_and(Expr::is_constant);
        let lead = if is_plain { "That is " } else { NUMBERS };
        solution.text(vec![say(lead), words::formula(&of), value]);
    }
    said(solution, scene, ask, answer);
    if brief && holds(answer) {
        return;
    }
    let discarded = worth_discarding(solution, answer);
    if !discarded.is_empty() {
        let mut text = vec![say("Discarded: ")];
        text.extend(sentence(scene, &Sentence::join(discarded, "; ")));
        text.push(say("."));
        solution.text(text);
    }
    if let Some(words) = worth_telling(&answer.checks, solution.detail).filter(|_| !told) {
        solution.text(vec![say(called(scene, &words))]);
    }
}

/// Solutions that were discarded, as far as they are worth a word: complex ones only where every line of algebra is, and so the
/// negative of what is taken with its positive sign.
fn worth_discarding(solution: &Solution, answer: &Answer) -> Vec<Sentence> {
    let full = solution.detail == Detail::Full;
    let complex =
        |s: &Sentence| matches!(s.0.last(), Some(Piece::Words(w)) if w.ends_with("not real"));
    let solved = answer.range.iter().map(|(_, _, value)| value);
    let values: Vec<&Expr> = answer.formula().into_iter().chain(solved).collect();
    let negative = |s: &Sentence| {
        let mut formulas = s.0.iter();
        formulas.any(|p| matches!(p, Piece::Formula(e) if values.iter().any(|v| *e == -*v)))
    };
    let all = answer.discarded.iter();
    all.filter(|s| full || !complex(s) && !negative(s))
        .cloned()
        .collect()
}

/// H = r × m v + I ω of a body about a point with a name.
fn moment_of_momentum(scene: &Scene, b: usize, about: Option<&str>) -> Option<Line> {
    let about = about?;
    let body = &scene.bodies[b];
    let c = words::center(scene, b);
    let mut math = words::set("{} =", [words::vector("H", about, "")]);
    if about != body.name {
        let arm = words::vector("r", &format!("{c}/{about}"), "");
        let mass = Math::Factor(body.mass.clone());
        math.extend(words::set(
            "{} × {} {}",
            [arm, mass, words::vector("v", &c, "")],
        ));
    }
    if !body.is_particle() {
        math.extend((math.len() > 2).then_some(Math::Op("+")));
        math.extend([words::name("I", &c, "", false), words::spin(scene, b, "")]);
    }
    Some(Line::plain(math))
}

/// The lines on the way to an identity that was to be shown; where it holds, also the claim that it does.
fn identity(
    solution: &mut Solution,
    scene: &Scene,
    ask: &Ask,
    answer: &Answer,
    shown: &Option<String>,
) -> Vec<Line> {
    let Ask::Show {
        left,
        relation,
        right,
        with,
        ..
    } = ask
    else {
        return Vec::new();
    };
    let mut lines = Vec::new();
    for (asked, (raw, value, _)) in [left, right].into_iter().zip(&answer.put_in) {
        if asked == value {
            continue;
        }
        let mut forms = vec![raw, value];
        forms.dedup_by(|later, one| {
            let same = alike(later, one);
            if same {
                *one = *later;
            }
            same
        });
        forms.retain(|f| *f != asked && f.size() <= READABLE);
        for (i, form) in forms.into_iter().enumerate() {
            let mut math = vec![Math::Op("="), Math::Expr(form.clone())];
            if i == 0 {
                math.insert(0, Math::Expr(asked.clone()));
            }
            let step = shown.clone();
            lines.push(Line { math, step });
        }
    }
    one_chain(&mut lines, *relation, right);
    if !with.is_empty() {
        let mut text = vec![say("With ")];
        text.extend(words::values(with));
        text.push(say(","));
        solution.text(text);
    }
    // The identity itself, in the symbols whose values an independent solution finds.
    let known = |e: &Expr| {
        let is_parameter = |s: &str| scene.parameters.iter().any(|p| *p.name == *s);
        e.symbols()
            .iter()
            .all(|s| is_parameter(s) || solution.meanings.contains_key(s))
    };
    let is_identity = *relation == Relation::Equal;
    if is_identity && holds(answer) && with.is_empty() && known(left) && known(right) {
        let claim = Claim::new(left.clone(), right.clone());
        solution.step(Vec::new(), vec![claim], "what was to be shown");
    }
    lines
}

/// Two sides that come to the same, the second in one step, stand in one chain: left = … = value = right.
fn one_chain(lines: &mut Vec<Line>, relation: Relation, right: &Expr) {
    let [.., last, other] = lines.as_mut_slice() else {
        return;
    };
    if let [Math::Expr(begins), Math::Op("="), Math::Expr(value)] = other.math.as_slice()
        && relation == Relation::Equal
        && begins == right
        && last.math.last() == Some(&Math::Expr(value.clone()))
    {
        other.math = vec![Math::Op("="), Math::Expr(right.clone())];
    }
}

/// Whether every check of an answer holds.
fn holds(answer: &Answer) -> bool {
    answer.checks.iter().all(|c| c.holds == Some(true))
}

/// What goes into the box: a range of a parameter, a value, an equation. Steps are the one that shows the answer, and the one
/// that names it.
fn found(
    scene: &Scene,
    ask: &Ask,
    answer: &Answer,
    [shown, named_step]: [&Option<String>; 2],
    fresh: bool,
) -> Vec<Line> {
    let symbol = Expr::symbol(&answer.name);
    let name = crate::expr::Symbol::from(answer.name.as_str());
    let line = |left: &Expr, op: &'static str, right: &Expr, step: &Option<String>| Line {
        math: words::related(left, op, right),
        step: step.clone(),
    };
    // A speed by its components, say.
    let is_of_answers = |e: &Expr| e.symbols().iter().any(|s| scene.parameter(s).is_none());
    let mut found: Vec<Line> = Vec::new();
    for (p, relation, value) in &answer.range {
        let mut whole = line(p, relation.sign(), value, shown);
        // A name that later questions use is told where its value is found.
        if fresh && answer.range.len() == 1 && is_used(scene, &name) {
            let named = [Math::Expr(symbol.clone()), Math::Op("=")];
            whole.math.splice(2..2, named);
        }
        found.push(whole);
    }
    if let Some(formula) = answer.formula()
        && (answer.range.is_empty() || is_extreme(ask, answer))
    {
        let (left, op) = match stands_for(ask, answer) {
            Some((of, op)) => (of, op),
            None => (symbol.clone(), "="),
        };
        let mut whole = line(&left, op, formula, named_step);
        if let Ask::Value {
            polar: Some([x, y]),
            ..
        } = ask
            && !x.is_zero()
        {
            found.push(line(&symbol.tan(), "=", &tidied(scene, &(y / x)), &None));
        }
        if let Ask::Value {
            formula: asked,
            with,
            meaning,
            polar: None,
            ..
        } = ask
            && with.is_empty()
            && (meaning.is_empty() || is_of_answers(asked))
            && asked != formula
            && asked.size() <= READABLE / 4
        {
            whole
                .math
                .splice(2..2, [Math::Expr(asked.clone()), Math::Op("=")]);
        }
        found.push(whole);
    }
    if let Form::Equation { left, right } = &answer.form
        && answer.stated.is_none()
        && !matches!(ask, Ask::Show { .. })
    {
        found.push(line(left, "=", right, named_step));
    }
    found
}

/// Whether an answer is a largest or least value beside the place where it is reached.
fn is_extreme(ask: &Ask, answer: &Answer) -> bool {
    let place = answer.range.first().map(|(_, _, place)| place);
    matches!(ask, Ask::Extremum { .. }) && answer.formula() != place
}

/// What is said of an answer in sentences.
fn said(solution: &mut Solution, scene: &Scene, ask: &Ask, answer: &Answer) {
    // At which values a formula is taken stands in the heading.
    let in_heading = match ask {
        Ask::Value { with, .. } if !matches!(answer.form, Form::Open(_)) => with.len(),
        _ => 0,
    };
    let mut text: Vec<Vec<Inline>> = answer
        .text
        .iter()
        .skip(in_heading)
        .map(|t| full_sentence(scene, t))
        .collect();
    if let Ask::Show {
        claim,
        with,
        relation,
        ..
    } = ask
        && holds(answer)
    {
        // What is proved stands above; the values put in, before it. Of an inequality the sign is told.
        let kept = usize::from(*relation != Relation::Equal);
        text.drain(kept.min(text.len())..text.len().min(1 + with.len()));
        let end = match claim.as_str() {
            "" => String::from("This was to be shown."),
            claim => format!("So {}.", claim.trim_end_matches('.')),
        };
        text.insert(kept.min(text.len()), vec![say(end)]);
    }
    if text.len() > 1 && matches!(ask, Ask::Show { .. }) {
        let sentences = std::mem::take(&mut text);
        text.push(sentences.join(&say(" ")));
    }
    match text.len() {
        0 => {}
        1 => solution.conclude(text.remove(0)),
        _ => solution.push(Part::List(text)),
    }
}

/// Whether another question of the scene asks about this symbol.
fn is_used(scene: &Scene, name: &crate::expr::Symbol) -> bool {
    let mut asks = scene.questions.iter().map(|q| &q.ask);
    let has = |e: &Expr| e.symbols().contains(name);
    asks.any(|ask| match ask {
        Ask::Value { formula, with, .. } => has(formula) || with.iter().any(|(_, e)| has(e)),
        Ask::Condition {
            left, right, with, ..
        }
        | Ask::Show {
            left, right, with, ..
        } => has(left) || has(right) || with.iter().any(|(_, e)| has(e)),
        Ask::Extremum { of, .. } | Ask::Limit { of, .. } | Ask::Approximate { of, .. } => has(of),
        _ => false,
    })
}

/// What shows an answer, about its name where it has one.
fn claims(scene: &Scene, ask: &Ask, answer: &Answer, named: Option<(&Expr, &Expr)>) -> Vec<Claim> {
    let claim = |left: &Expr, right: &Expr| Claim::new(left.clone(), right.clone());
    let put_in = answer.put_in.iter();
    let Some((symbol, formula)) = named else {
        return put_in.map(|(left, right, _)| claim(left, right)).collect();
    };
    // The other component of a unit vector has its value put in as well, and no name.
    let is_alone = |parameter: &Symbol, sides: [&Expr; 2]| {
        let other = scene.domains.other_component(parameter);
        other.is_none_or(|other| !sides.iter().any(|side| side.mentions(other)))
    };
    match (ask, &answer.stated) {
        (Ask::Condition { parameter, .. }, Some((left, _, right)))
            if answer.put_in.len() == 1 && is_alone(parameter, [left, right]) =>
        {
            let at = std::collections::BTreeMap::from([(parameter.clone(), symbol.clone())]);
            vec![claim(&left.substitute(&at), &right.substitute(&at))]
        }
        _ => put_in
            .map(|(left, right, _)| claim(left, if right == formula { symbol } else { right }))
            .collect(),
    }
}
