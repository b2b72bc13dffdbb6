//! Equations and inequalities: the same when they have the same solutions on the domain.
//!
//! In one symbol the solutions are found. In several, the parts of two differences that only one of them has are looked at:
//! one that vanishes nowhere, or only where the other relation holds as well, changes nothing; one without the sought
//! quantity leaves the relations equivalent given that it is not zero; any other is a root lost or gained, shown at a point.
//! Relations without solutions, or that hold everywhere on the domain, are compared over the reals; none of them is rewarded
//! for saying nothing.

mod bounds;
mod cells;
mod defined;
mod equations;
mod factor;
mod inequality;
mod inside;
mod least;
mod listed;
mod locus;
mod normal;
mod plain;
mod points;
mod signs;
mod solved;
mod system;
mod systems;
mod told;
mod undone;
mod values;
mod zeros;

use std::collections::BTreeSet;
use std::slice::from_ref;

use super::context::Context;
use super::scalar::scalars;
use super::{Apart, Grade, Options, Question, Verdict, key_of};
use crate::algebra::{self, Element, Field, Sign};
use crate::domain::{Domain, Domains, roles};
use crate::expr::{Expr, Function, Node, Symbol, only};
use crate::formula::{Content, Join, Relation, is_angle_name, write_plain};
use crate::interval::{Big, Outcome, evaluate};
pub(super) use bounds::at_bounds;
use equations::{alternatives, equations};
use inequality::inequalities;
pub(super) use inside::{angle_in, below_in, size_in, under_root};
pub(super) use least::of_which;
use normal::{Normal, differences, equation, negated, rooted};
use points::{apart_at_points, apart_in_cases};
pub(super) use solved::solve_for;
use solved::{lies_in, solved_in, unknowns};
use systems::{cases, links};
use told::{GAINED, LOST, holding, told};
use values::{hole, main, may_lack_values};

/// Compares two systems of relations.
pub(crate) fn compare(
    ctx: &Context,
    (sides, signs): (&[Content], &[Relation]),
    (mine, my_signs): (&[Content], &[Relation]),
) -> Grade {
    if let Some(found) = least::compare(ctx, (sides, signs), (mine, my_signs)) {
        return found;
    }
    let (Some(expected), Some(answer)) = (links(sides, signs), links(mine, my_signs)) else {
        let words = "the relation holds something that is not a plain expression";
        return Grade::different("DIFF_KIND", "kind", words);
    };
    let domains = ctx.domains();
    if let Some(found) = listed::beyond(ctx, (sides, &expected), (mine, &answer)) {
        return found;
    }
    let one = system::in_one_symbol(ctx, from_ref(&expected), from_ref(&answer), domains);
    let found = one.unwrap_or_else(|| match (expected.as_slice(), answer.as_slice()) {
        ([e], [a]) => match link(ctx, e, a) {
            found if found.is_equivalent() => where_defined(found, [&expected, &answer], domains),
            found => found,
        },
        _ => system::compare(ctx, &expected, &answer),
    });
    match found.verdict {
        Verdict::Undecided => system::scaled(ctx, &expected, &answer)
            .or_else(|| system::with_one_given(ctx, &[expected], &[answer]))
            .unwrap_or(found),
        _ => about_bound(ctx, found, [sides, mine]),
    }
}

/// The finding about an inequality with what is wrong with its bound, where both set one on the same name.
fn about_bound(ctx: &Context, mut found: Grade, each: [&[Content]; 2]) -> Grade {
    let bound = |sides: &[Content]| {
        let [left, right] = sides else { return None };
        let (name, bound) = match left.name() {
            Some(name) => (name, right),
            None => (right.name()?, left),
        };
        Some((name.clone(), bound.expr()?.clone()))
    };
    let [Some((name, e)), Some((other, a))] = each.map(bound) else {
        return found;
    };
    if found.note == told::OTHER_NUMBERS[0] && name == other {
        let mut wrong = scalars(ctx, &e, &a).diagnosis;
        wrong.retain(|d| d.message.starts_with("right") || d.code == "ROUNDED");
        for d in &mut wrong {
            d.message = format!("the bound is {}", d.message);
        }
        if !wrong.is_empty() {
            found.diagnosis = wrong;
        }
    }
    found
}

/// An equivalence of the relations of two systems beside what must not be zero, unless in one symbol one system has no value
/// where the other holds.
fn where_defined(found: Grade, [expected, answer]: [&[Normal]; 2], domains: &Domains) -> Grade {
    let (Some((e, _)), Some((a, _))) = (main(expected), main(answer)) else {
        return found;
    };
    match hole(expected, answer, domains) {
        Some(None) if !may_lack_values(e, a, domains) => found,
        Some(Some((at, is_lost))) => {
            let is_equation = e.relation == Relation::Equal;
            let words = match (is_equation, is_lost) {
                (false, _) => told::OTHER_NUMBERS,
                (true, true) => LOST,
                (true, false) => GAINED,
            };
            told(words).shown_by(Apart::new(at, holding(!is_lost), holding(is_lost)))
        }
        _ => undecided("whether both sides have values at all solutions could not be told"),
    }
}

/// The symbols that some relations are about, which no habit makes positive: the only one of a relation, unless it is an angle
/// or has a logarithm in any of them, or one that stands alone beside zero or something negative, as in `0 < x < b`, or alone
/// between bars.
pub(super) fn unsigned(contents: &[&Content]) -> BTreeSet<Symbol> {
    let has_sign = |name: &Symbol| {
        let logarithm = |part: &Expr| matches!(part.node(), Node::Call(Function::Ln, x) if x.as_symbol() == Some(name));
        contents.iter().any(|content| {
            let uses = roles(&content.exprs()).symbols;
            uses.get(name).is_some_and(|role| role.turns) || content.parts().any(logarithm)
        }) || is_angle_name(name)
    };
    let mut parts: Vec<&Content> = contents.to_vec();
    let mut out = BTreeSet::new();
    while let Some(content) = parts.pop() {
        match content {
            Content::Joined(_, inner) => parts.extend(inner),
            Content::Relations(sides, signs) => match only(&roles(&content.exprs()).symbols) {
                Some((name, _)) => out.extend((!has_sign(name)).then(|| name.clone())),
                None => out.extend(bounded(sides, signs)),
            },
            _ => {}
        }
    }
    out
}

/// The symbols that stand alone beside zero or something negative, or between bars.
fn bounded(sides: &[Content], signs: &[Relation]) -> Vec<Symbol> {
    let low = |side: &Content| side.expr().is_some_and(|e| e.is_zero() || e.is_negative());
    let alone = |side: &Content| side.name().cloned();
    let bounds = sides
        .windows(2)
        .zip(signs)
        .filter(|(_, s)| **s != Relation::Equal);
    let beside = bounds.filter_map(|(pair, _)| match pair {
        [a, b] if low(a) => alone(b),
        [a, b] if low(b) => alone(a),
        [a, b] => between_bars(a).or_else(|| between_bars(b)),
        _ => None,
    });
    beside.collect()
}

/// The symbol of `|x|`.
fn between_bars(side: &Content) -> Option<Symbol> {
    match side.expr()?.node() {
        Node::Call(Function::Abs, inside) => inside.as_symbol().cloned(),
        _ => None,
    }
}

/// Compares relations of which all hold, or one, with others.
pub(crate) fn joined(ctx: &Context, expected: &Content, answer: &Content) -> Grade {
    let (Some(mine), Some(theirs)) = (cases(expected), cases(answer)) else {
        let words = "the relation holds something that is not a plain expression";
        return Grade::different("DIFF_KIND", "kind", words);
    };
    let domains = ctx.domains();
    if let Some(found) = system::in_one_symbol(ctx, &mine, &theirs, domains) {
        return found;
    }
    match (mine.as_slice(), theirs.as_slice()) {
        ([mine], [theirs]) => {
            let either = [expected, answer]
                .iter()
                .any(|content| matches!(content, Content::Joined(Join::Or, _)));
            let found = match (mine.as_slice(), theirs.as_slice()) {
                ([e], [a]) if either => alternatives(ctx, &e.difference, &a.difference),
                _ => system::compare(ctx, mine, theirs),
            };
            let left = || system::with_one_given(ctx, from_ref(mine), from_ref(theirs));
            match found.verdict {
                Verdict::Undecided => {
                    (left().or_else(|| apart_at_points(ctx, mine, theirs))).unwrap_or(found)
                }
                _ => found,
            }
        }
        _ => {
            let same =
                |a: &Vec<Normal>, b: &Vec<Normal>| system::compare(ctx, a, b).is_equivalent();
            let found = |cases: &[Vec<Normal>], others: &[Vec<Normal>]| {
                cases.iter().all(|a| others.iter().any(|b| same(a, b)))
            };
            if found(&mine, &theirs) && found(&theirs, &mine) {
                return same_solutions("each case of the one is a case of the other");
            }
            if let (Some(mine), Some(theirs)) = (negated(&mine, domains), negated(&theirs, domains))
                && system::compare(ctx, &mine, &theirs).is_equivalent()
            {
                return same_solutions("none of the cases holds at the same points");
            }
            if signs::agree(&mine, &theirs, domains) && points::says_something(&mine, domains) {
                return same_solutions("both hold for the same signs of their parts");
            }
            let apart = system::with_one_given(ctx, &mine, &theirs)
                .or_else(|| apart_in_cases(ctx, &mine, &theirs));
            apart.unwrap_or_else(|| undecided("cases in several symbols are compared one by one"))
        }
    }
}

/// An answer with the solution of the expected equation in one symbol wherever its own number is near that; those beyond the
/// domain as well, which an exact comparison rules out.
pub(super) fn at_zeros(
    expected: &Content,
    answer: &Content,
    near: &dyn Fn(&Expr, &Expr) -> bool,
    domains: &Domains,
) -> Option<Content> {
    let ([left, right], [Relation::Equal]) = expected.relations()? else {
        return None;
    };
    let gap = left.expr()? - right.expr()?;
    let name = only(gap.symbols())?;
    let mut all = domains.clone();
    all.symbols.insert(name.clone(), Domain::real());
    let zeros = zeros::zeros(&gap, &name, &all)?;
    let exact = |e: &Expr| {
        let roots = zeros.iter().map(|(root, _)| root);
        let mut roots = roots.filter(|_| e.symbols().is_empty());
        roots.find(|root| near(e, root)).unwrap_or(e).clone()
    };
    Some(answer.map(&exact))
}

/// Two relations as they are written, or else with the functions undone that stand around both sides.
fn link(ctx: &Context, expected: &Normal, answer: &Normal) -> Grade {
    let mut pair = [expected.clone(), answer.clone()];
    let domains = ctx
        .domains()
        .of(&[&expected.difference, &answer.difference]);
    if expected.relation == Relation::Equal && answer.relation == Relation::Equal {
        let sought = sought_in(ctx, &expected.difference, &answer.difference);
        let mut plain = pair.clone();
        let [mine, theirs] = plain.each_mut().map(|n| divide(n, &sought, &domains));
        if are_equations([&mine, &theirs], pair.each_ref().map(|n| &n.difference)) {
            plain = pair.clone();
        }
        let given: Vec<String> = mine.iter().chain(&theirs).map(not_zero).collect();
        if plain
            .iter()
            .zip(&pair)
            .any(|(a, b)| a.difference != b.difference)
        {
            let mut found = link(&ctx.plain(), &plain[0], &plain[1]);
            if found.is_equivalent() {
                // A factor that the question itself lets be zero has solutions of its own.
                let zero = |e: &Expr| may_vanish(ctx, e);
                if mine.iter().any(zero) {
                    return told(LOST);
                }
                if theirs.iter().any(zero) {
                    return told(GAINED);
                }
            }
            if found.is_equivalent() && !given.is_empty() {
                let assumed = std::mem::take(&mut found.assumed);
                found = given_not_zero(APART, given);
                found.assume(assumed);
            }
            if found.is_equivalent() {
                return found;
            }
        }
    }
    let mut finding = as_written(ctx, expected, answer);
    let mut given = Vec::new();
    for step in undone::STEPS {
        if finding.verdict != Verdict::Undecided {
            break;
        }
        let undone = pair.each_ref().map(|n| step(n, &domains));
        if undone.iter().all(Option::is_none) {
            continue;
        }
        for (n, undone) in pair
            .iter_mut()
            .zip(undone)
            .filter_map(|(n, u)| Some((n, u?)))
        {
            *n = undone.normal;
            given.extend(undone.given);
        }
        let found = as_written(ctx, &pair[0], &pair[1]);
        // What was undone on the domain is not undone beyond it.
        if found.assumed.iter().any(|given| given == REALS) {
            break;
        }
        // Beyond what has to hold beside, the one may hold where the other has no value.
        let equation = expected.relation == Relation::Equal;
        match found.verdict {
            Verdict::Equivalent
                if given.is_empty()
                    || equation && consistent([expected, answer], &pair, &domains) =>
            {
                finding = found;
            }
            Verdict::Different if given.is_empty() => finding = found,
            _ => {}
        }
    }
    if finding.is_equivalent() {
        finding.assume(given);
    }
    finding
}

/// Whether equations have values where others without their functions are fulfilled: at some point for each factor that is
/// solved, and in one symbol, where every solution counts, for all factors.
fn consistent(old: [&Normal; 2], new: &[Normal; 2], domains: &Domains) -> bool {
    let [e, a] = old.map(|n| &n.difference);
    let has_values = |name: &Symbol, root: &Expr| {
        let all = [&e.put(name, root), &a.put(name, root), root].map(Expr::clone);
        let points = domains.points(&all.each_ref(), 12);
        points.iter().any(|at| {
            let point = at.point::<Big<200>>(true);
            match all.each_ref().map(|e| evaluate(e, &point)) {
                [Outcome::Value(_), Outcome::Value(_), Outcome::Value(place)] => {
                    lies_in(&place.0, name, domains)
                }
                _ => false,
            }
        })
    };
    let alone = unknowns(e, a).len() == 1;
    let mut factors = new.iter().flat_map(|n| n.difference.factors());
    factors.all(|factor| {
        let names = unknowns(factor, factor);
        let mut solved = names
            .iter()
            .filter_map(|name| Some((name, solve_for(factor, name, domains)?)));
        let mut found = solved.by_ref().peekable();
        match found.peek() {
            None => !alone || names.is_empty(),
            Some(_) => found.any(|(name, root)| has_values(name, &root)),
        }
    })
}

/// Takes the factors without the sought quantity out of an equation; those that may be zero.
fn divide(n: &mut Normal, sought: &BTreeSet<Symbol>, domains: &Domains) -> Vec<Expr> {
    let Node::Product(factors) = n.difference.node() else {
        return Vec::new();
    };
    let open = |factor: &&Expr| !sign_of(factor, domains).is_some_and(Sign::is_strict);
    let (free, rest): (Vec<Expr>, Vec<Expr>) = factors
        .iter()
        .cloned()
        .partition(|factor| factor.symbols().is_disjoint(sought));
    // What is zero nowhere is no equation.
    if !rest.iter().any(|factor| open(&factor)) || sought.is_empty() {
        return Vec::new();
    }
    n.difference = rooted(Expr::product(rest));
    free.iter().filter(open).cloned().collect()
}

/// Whether a factor vanishes somewhere on the domain for sure: all its symbols are declared, and each to have either sign.
fn may_vanish(ctx: &Context, e: &Expr) -> bool {
    let declared = &ctx.domains().symbols;
    let either = |name: &Symbol| declared.get(name).is_some_and(Domain::changes_sign);
    let is_linear = |name: &Symbol| e.derivative(name).is_constant();
    let names = e.symbols();
    !names.is_empty() && names.iter().all(|name| either(name) && is_linear(name))
}

/// Whether what only either of two equations has may be what it says: `v − w` and `u − b` beside the factor `M − m` of both,
/// or v and u where each equation is written as a product that is zero.
fn are_equations<'e>(each: [impl IntoIterator<Item = &'e Expr>; 2], whole: [&Expr; 2]) -> bool {
    let [mine, theirs] = each.map(|parts| parts.into_iter().collect::<Vec<_>>());
    let is_sum = |e: &&Expr| matches!(e.node(), Node::Sum(_));
    let are_products = whole.iter().all(|e| matches!(e.node(), Node::Product(_)));
    let each_has_own = !mine.is_empty() && !theirs.is_empty();
    each_has_own && (are_products || mine.iter().chain(&theirs).any(is_sum))
}

fn as_written(ctx: &Context, expected: &Normal, answer: &Normal) -> Grade {
    let is_equation = |n: &Normal| !matches!(n.relation, Relation::Less | Relation::LessEqual);
    match (is_equation(expected), is_equation(answer)) {
        (true, true) if expected.relation == answer.relation => equations(ctx, expected, answer),
        (false, false) => inequalities(ctx, expected, answer),
        _ => {
            let said = |n: &Normal| match n.relation {
                Relation::Equal => "an equation",
                Relation::NotEqual => "a relation with ≠",
                _ => "an inequality",
            };
            let [asked, given] = [said(expected), said(answer)];
            let mut words = format!("{asked} is expected, and the answer is {given}");
            let end = Normal {
                relation: Relation::Equal,
                ..answer.clone()
            };
            if asked == "an equation" && given == "an inequality" && ctx.diagnose {
                let is_right = equations(ctx, expected, &end).is_equivalent();
                let shown = if is_right {
                    "is right"
                } else {
                    "is another value"
                };
                words.push_str(&format!(": its end {shown}"));
            }
            match apart_at_points(ctx, from_ref(expected), from_ref(answer)) {
                Some(apart) => Grade {
                    counterexample: apart.counterexample,
                    ..Grade::told("DIFF_RELATION", "kind", words.clone(), words)
                },
                None => undecided(&words),
            }
        }
    }
}

fn same_solutions(words: &str) -> Grade {
    Grade::new(Verdict::Equivalent, "EQUIV_SOLUTIONS", "solutions", words)
}

/// What equations may differ by.
const APART: &str = "the two differ by factors without the sought quantity";

/// The same solutions where nothing is zero of what sets the two apart.
fn given_not_zero(words: &str, assumed: Vec<String>) -> Grade {
    let words = format!("{words}, given that no factor is zero");
    Grade {
        assumed,
        ..Grade::new(Verdict::Equivalent, "EQUIV_ASSUMED", "solutions", words)
    }
}

fn undecided(words: &str) -> Grade {
    Grade::new(Verdict::Undecided, "UNDECIDED_SOLUTIONS", "none", words)
}

/// The finding where the expected relation says nothing.
fn says_nothing(what: &str) -> Grade {
    let words = format!("the expected relation {what}, even over the reals: it says nothing");
    Grade::new(Verdict::Invalid, "INVALID_EXPECTED", "none", words)
}

/// The domains with every symbol real.
fn over_reals(domains: &Domains, expressions: &[&Expr]) -> Domains {
    let mut all = domains.clone();
    for name in expressions.iter().flat_map(|e| e.symbols()) {
        if &*name != "pi" {
            all.symbols.insert(name, Domain::real());
        }
    }
    all
}

/// What is told where relations had to be compared over the reals.
const REALS: &str = "compared over the reals";

/// Whether `g = 0` says the same as `f = 0`, or follows from it: up to a factor without zeros, or solved for a symbol.
pub(crate) fn follows(f: &Expr, g: &Expr, domains: &Domains) -> bool {
    let [f_normal, g_normal] = [f, g].map(equation);
    same_sign(&f_normal, &g_normal, domains).is_some() || solved_in(g, f, domains)
}

/// Whether `f` and `g` are zero at the same points: the quotient of neither with the other vanishes.
pub(crate) fn proportional(f: &Expr, g: &Expr, domains: &Domains) -> bool {
    let [f, g] = [f, g].map(equation);
    same_sign(&f, &g, domains).is_some() && same_sign(&g, &f, domains).is_some()
}

/// Whether two formulas are positive at the same points and zero at the same (true), or the one where the other is negative
/// (false).
pub(super) fn same_side(f: &Expr, g: &Expr, domains: &Domains) -> Option<bool> {
    let below = |e: &Expr| Normal::new(-e, Relation::Less);
    if let Some(same) = same_sign(&below(f), &below(g), domains) {
        return Some(same);
    }
    if f.symbols() != g.symbols() {
        return None;
    }
    let question = Question {
        domains: domains.of(&[f, g]),
        ..Question::default()
    };
    let (key, options) = (
        key_of(Content::Scalar(f.clone()), &question),
        Options::default(),
    );
    let ctx = Context::new(&key, &options, false);
    let same = |f: &Expr, g: &Expr| {
        [Relation::Less, Relation::LessEqual].iter().all(|sign| {
            let [f, g] = [f, g].map(|e| Normal::new(-e, *sign));
            let found = link(&ctx, &f, &g);
            found.is_equivalent() && found.assumed.is_empty()
        })
    };
    match same(f, g) {
        true => Some(true),
        false => same(f, &-g).then_some(false),
    }
}

/// The sign of a formula on the domain.
pub(super) fn sign_of(e: &Expr, domains: &Domains) -> Option<Sign> {
    algebra::sign(e, &domains.of(&[e]))
}

/// A field with two formulas, unless what it makes of them rests on a sign that was only seen at points.
fn pair(f: &Expr, g: &Expr, domains: &Domains) -> Option<(Field, Element, Element)> {
    let found = Field::pair(&domains.of(&[f, g]), f, g).ok()?;
    found.0.assumptions().is_empty().then_some(found)
}

/// Whether the quotient of the differences is positive (true) or negative (false) on the whole domain.
fn same_sign(expected: &Normal, answer: &Normal, domains: &Domains) -> Option<bool> {
    let (mut field, e, a) = pair(&expected.difference, &answer.difference, domains)?;
    if field.is_zero(&e) || field.is_zero(&a) {
        return (field.is_zero(&e) && field.is_zero(&a)).then_some(true);
    }
    let definite = |sign: Option<Sign>| match sign? {
        Sign::Positive => Some(true),
        Sign::Negative => Some(false),
        _ => None,
    };
    if let Some(sign) = definite(field.sign(&field.div(&a, &e).ok()?)) {
        return Some(sign);
    }
    // Roots of numbers may hide in a quotient what they cancel: √5 a − 2 b is √5 (a − 2√5 b/5). Slopes tell the factor.
    let names = answer.difference.symbols();
    names.iter().take(4).find_map(|name| {
        let slopes = [&answer.difference, &expected.difference].map(|d| d.derivative(name));
        let [mine, theirs] = slopes.map(|slope| field.proved(&slope).ok());
        let (mine, theirs) = (mine??, theirs??);
        if field.is_zero(&theirs) {
            return None;
        }
        let factor = field.div(&mine, &theirs).ok()?;
        let scaled = field.mul(&factor, &e).ok()?;
        match field.equal(&scaled, &a) {
            true => definite(field.sign(&factor)),
            false => None,
        }
    })
}

/// The sought quantity of two relations: what is asked for, else the symbols they share.
fn sought_in(ctx: &Context, f: &Expr, g: &Expr) -> BTreeSet<Symbol> {
    let all = f.symbols().intersection(&g.symbols()).cloned().collect();
    sought_of(ctx, all)
}

/// What is asked for among some symbols, else all of these.
fn sought_of(ctx: &Context, all: BTreeSet<Symbol>) -> BTreeSet<Symbol> {
    let asked = ctx.key.question.asked.iter().map(|g| g.name.clone());
    let asked: BTreeSet<Symbol> = asked.filter(|name| all.contains(name)).collect();
    if asked.is_empty() { all } else { asked }
}

/// The assumption that a formula is not zero.
fn not_zero(e: &Expr) -> String {
    format!("{} ≠ 0", write_plain(e))
}
