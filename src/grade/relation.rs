//! Equations and inequalities: the same when they have the same solutions on the domain.
//!
//! F = 0 and G = 0 have the same solutions where F/G keeps one sign; where it does not, each equation is solved for a
//! symbol in which it is linear and put into the other. Roots gained or lost are reported with a point.

mod solved;

use num_traits::Signed;

use super::compare::{Context, Finding, WRITTEN, scalars};
use super::{Apart, Diagnosis, Proof, Verdict};
use crate::algebra::{Field, Sign};
use crate::domain::{Domains, roles, samples};
use crate::expr::{Expr, Node};
use crate::formula::{Content, Relation};
use crate::interval::{Interval, Outcome, evaluate};
pub(super) use solved::solve_for;
use solved::{same_angle, solution_apart, solved_in, unknowns};

/// `left − right  rel  0`, turned so that the relation is one of =, ≠, <, ≤.
struct Normal {
    difference: Expr,
    relation: Relation,
}

/// Compares two chains of relations link by link, in any order.
pub(crate) fn compare(
    ctx: &Context,
    (sides, signs): (&[Content], &[Relation]),
    (mine, my_signs): (&[Content], &[Relation]),
) -> Finding {
    if let Some(finding) = vector_equation(ctx, (sides, signs), (mine, my_signs)) {
        return finding;
    }
    let (Some(expected), Some(answer)) = (links(sides, signs), links(mine, my_signs)) else {
        let words = "the relation holds something that is not a plain expression";
        return Finding::different("DIFF_KIND", "kind", words);
    };
    if expected.len() != answer.len() {
        let words = format!(
            "{} relations are expected, and there are {}",
            expected.len(),
            answer.len()
        );
        return Finding::different("DIFF_KIND", "kind", words.clone()).with(Diagnosis::new(
            "KIND",
            words.clone(),
            words,
        ));
    }
    if let ([e], [a]) = (expected.as_slice(), answer.as_slice()) {
        return link(ctx, e, a);
    }
    let mut left: Vec<&Normal> = answer.iter().collect();
    let mut total: Option<Finding> = None;
    for e in &expected {
        let mut first: Option<Finding> = None;
        let mut found = None;
        for (i, a) in left.iter().enumerate() {
            let finding = link(ctx, e, a);
            if finding.verdict == Verdict::Equivalent {
                found = Some((i, finding));
                break;
            }
            first.get_or_insert(finding);
        }
        match (found, first) {
            (Some((i, finding)), _) => {
                left.remove(i);
                total.get_or_insert(finding);
            }
            (None, Some(first)) => return first,
            (None, None) => break,
        }
    }
    total.unwrap_or_else(|| Finding::different("DIFF_KIND", "kind", "no relation"))
}

/// `v = [a, b]` against `v = [c, d]`, and `[a, b] = [c, d]` against its like.
fn vector_equation(
    ctx: &Context,
    (sides, signs): (&[Content], &[Relation]),
    (mine, my_signs): (&[Content], &[Relation]),
) -> Option<Finding> {
    let [Content::Vector(a), Content::Vector(b)] = sides else {
        return None;
    };
    let [Content::Vector(c), Content::Vector(d)] = mine else {
        return None;
    };
    if signs != [Relation::Equal] || my_signs != [Relation::Equal] {
        return None;
    }
    let mut total = None;
    for i in 0..3 {
        let e = Normal {
            difference: &a[i] - &b[i],
            relation: Relation::Equal,
        };
        let m = Normal {
            difference: &c[i] - &d[i],
            relation: Relation::Equal,
        };
        if e.difference.is_zero() && m.difference.is_zero() {
            continue;
        }
        let finding = link(ctx, &e, &m);
        if finding.verdict != Verdict::Equivalent {
            return Some(finding);
        }
        total = Some(finding);
    }
    total
}

fn links(sides: &[Content], signs: &[Relation]) -> Option<Vec<Normal>> {
    let exprs: Option<Vec<&Expr>> = sides.iter().map(Content::expr).collect();
    let exprs = exprs?;
    let pairs = exprs.windows(2).zip(signs);
    let normal = |(pair, sign): (&[&Expr], &Relation)| {
        let (difference, relation) = match sign {
            Relation::Greater => (pair[1] - pair[0], Relation::Less),
            Relation::GreaterEqual => (pair[1] - pair[0], Relation::LessEqual),
            other => (pair[0] - pair[1], *other),
        };
        let equation = matches!(relation, Relation::Equal | Relation::NotEqual);
        Normal {
            difference: if equation {
                rooted(difference)
            } else {
                difference
            },
            relation,
        }
    };
    Some(pairs.map(normal).collect())
}

/// A power vanishes where its base does.
fn rooted(difference: Expr) -> Expr {
    match difference.node() {
        Node::Power(base, k) if k.as_number().is_some_and(Signed::is_positive) => base.clone(),
        _ => difference,
    }
}

fn link(ctx: &Context, expected: &Normal, answer: &Normal) -> Finding {
    let domains = &ctx.key.question.domains;
    if expected.relation != answer.relation {
        let kinds = [expected.relation, answer.relation];
        let strict = |r: Relation| matches!(r, Relation::Less | Relation::LessEqual);
        if kinds.iter().all(|r| strict(*r)) && same_sign(expected, answer, domains) == Some(true) {
            let words = "the boundary belongs to one of the two inequalities and not to the other";
            return Finding::different("DIFF_STRICT", "solutions", words).with(Diagnosis::new(
                "STRICT",
                words,
                "look at the case of equality",
            ));
        }
        let words = format!(
            "{} is expected, and the answer has {}",
            expected.relation.sign(),
            answer.relation.sign()
        );
        return Finding::different("DIFF_RELATION", "kind", words.clone()).with(Diagnosis::new(
            "RELATION",
            words.clone(),
            words,
        ));
    }
    let equation = matches!(
        expected.relation,
        Relation::Equal | Relation::NotEqual | Relation::Approximately
    );
    match (same_sign(expected, answer, domains), equation) {
        (Some(true), _) | (Some(false), true) => {
            let words = "the two differ by a factor that is nowhere zero";
            Finding::new(
                Verdict::Equivalent,
                "EQUIV_SOLUTIONS",
                Proof::of("solutions", words),
            )
        }
        (Some(false), false) => {
            let words = "the inequality points the other way";
            Finding::different("DIFF_TURNED", "solutions", words).with(Diagnosis::new(
                "TURNED",
                words,
                "multiplying by something negative turns an inequality round",
            ))
        }
        (None, true) => equations(ctx, expected, answer),
        (None, false) => inequalities(ctx, expected, answer),
    }
}

/// Whether `g = 0` says the same as `f = 0`, or follows from it: up to a factor without zeros, or solved for a symbol.
pub(crate) fn follows(f: &Expr, g: &Expr, domains: &Domains) -> bool {
    let [f_normal, g_normal] = [f, g].map(|e| Normal {
        difference: e.clone(),
        relation: Relation::Equal,
    });
    same_sign(&f_normal, &g_normal, domains).is_some() || solved_in(g, f, domains)
}

/// Whether the quotient of the differences is positive (true) or negative (false) on the whole domain.
fn same_sign(expected: &Normal, answer: &Normal, domains: &Domains) -> Option<bool> {
    let (domains, _) = domains.completed(&roles(&[&expected.difference, &answer.difference]));
    let mut field = Field::new(&domains);
    field.prepare([&expected.difference, &answer.difference]);
    let e = field.element(&expected.difference).ok()?;
    let a = field.element(&answer.difference).ok()?;
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
        let [mine, theirs] = slopes.map(|slope| field.element(&slope).ok());
        let (mine, theirs) = (mine?, theirs?);
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

/// Two equations whose quotient changes sign or vanishes somewhere, or is not known.
fn equations(ctx: &Context, expected: &Normal, answer: &Normal) -> Finding {
    let domains = &ctx.key.question.domains;
    let (f, g) = (&expected.difference, &answer.difference);
    let same_angle = same_angle(f, g, domains);
    if same_angle == Some(true) {
        let words = "each equation fixes the angle, and at the same value";
        let proof = Proof::of("solutions", words);
        return Finding::new(Verdict::Equivalent, "EQUIV_SOLUTIONS", proof);
    }
    // A solution of one that the other lacks.
    let lost = solution_apart(f, g, domains);
    if let (Some(at), Some(_)) = (&lost, solution_apart(g, f, domains)) {
        let words = "the equation says something else than the expected one";
        let mut finding = parted(ctx, words, "DIFF_EQUATION", at.clone());
        if let Some(term) = turned_term(f, g, domains) {
            let message = format!("right with the sign of {} turned", ctx.say(&term));
            finding.note = "DIFF_TERM_SIGN";
            finding.diagnosis = vec![Diagnosis::new(
                "TERM_SIGN",
                message,
                "one term of your equation has the wrong sign",
            )];
        }
        return finding;
    }
    if let Some(at) = lost {
        let words = "a solution of the expected equation does not fulfil the answer";
        return parted(ctx, words, "DIFF_ROOT_LOST", at);
    }
    if let Some(at) = solution_apart(g, f, domains) {
        let words = "the answer has a solution that the expected equation lacks";
        return parted(ctx, words, "DIFF_ROOT_GAINED", at);
    }
    // Where one is the other times something that vanishes inside the domain, that is a root more.
    if let Some(ratio) = ratio(f, g, domains) {
        if let Some(at) = solution_apart(&ratio.powi(-1), g, domains) {
            let words = "divided by something that vanishes inside the domain";
            return parted(ctx, words, "DIFF_ROOT_LOST", at);
        }
        if let Some(at) = solution_apart(&ratio, f, domains) {
            let words = "multiplied by something that vanishes inside the domain";
            let swapped = (at.0, at.2, at.1);
            return parted(ctx, words, "DIFF_ROOT_GAINED", swapped);
        }
    }
    let both_ways = solved_in(f, g, domains) && solved_in(g, f, domains);
    if both_ways {
        let mut finding = Finding::new(
            Verdict::Equivalent,
            "EQUIV_SOLUTIONS",
            Proof::of("solutions", "each equation, solved, fulfils the other"),
        );
        finding
            .assumed
            .push("what was divided by is not zero".into());
        return finding;
    }
    if same_angle == Some(false) {
        let words = "the two equations fix the angle at different values";
        return Finding::different("DIFF_EQUATION", "solutions", words).with(Diagnosis::new(
            "EQUATION",
            words,
            "compare your equation with the law it comes from, term by term",
        ));
    }
    Finding::new(
        Verdict::Undecided,
        "UNDECIDED_SOLUTIONS",
        Proof::of(
            "none",
            "the equations could not be solved to compare their solutions",
        ),
    )
}

fn parted(ctx: &Context, words: &str, note: &'static str, at: (String, Expr, Expr)) -> Finding {
    let mut finding = Finding::different(note, "solutions", words);
    finding.counterexample = Some(Apart {
        at: at.0,
        yours: format!("left minus right is {}", ctx.say(&at.2)),
        expected: format!("left minus right is {}", ctx.say(&at.1)),
    });
    let hint = match note {
        "DIFF_EQUATION" => "compare your equation with the law it comes from, term by term",
        "DIFF_ROOT_LOST" => "a solution is missing or the equation says something else",
        _ => "your equation is fulfilled where it should not be",
    };
    let code = match note {
        "DIFF_EQUATION" => "EQUATION",
        "DIFF_ROOT_LOST" => "ROOT_LOST",
        _ => "ROOT_GAINED",
    };
    finding.with(Diagnosis::new(code, words, hint))
}

/// The one term of the answer whose sign has to be turned to make the equations the same.
fn turned_term(f: &Expr, g: &Expr, domains: &Domains) -> Option<Expr> {
    let Node::Sum(terms) = g.node() else {
        return None;
    };
    (0..terms.len().min(12)).find_map(|i| {
        let all = terms
            .iter()
            .enumerate()
            .map(|(j, t)| if i == j { -t } else { t.clone() });
        let normal = |difference: Expr| Normal {
            difference,
            relation: Relation::Equal,
        };
        same_sign(&normal(f.clone()), &normal(Expr::sum(all)), domains).map(|_| terms[i].clone())
    })
}

/// The quotient g/f in its normal form.
fn ratio(f: &Expr, g: &Expr, domains: &Domains) -> Option<Expr> {
    let (domains, _) = domains.completed(&roles(&[f, g]));
    let mut field = Field::new(&domains);
    field.prepare([f, g]);
    let (a, b) = (field.element(f).ok()?, field.element(g).ok()?);
    let ratio = field.div(&b, &a).ok()?;
    (ratio.terms() <= WRITTEN).then(|| field.expr(&ratio))
}

/// Two inequalities whose quotient is not known to keep a sign.
fn inequalities(ctx: &Context, expected: &Normal, answer: &Normal) -> Finding {
    let domains = &ctx.key.question.domains;
    let (f, g) = (&expected.difference, &answer.difference);
    let uses = roles(&[f, g]);
    let (all, assumed) = domains.completed(&uses);
    for sample in samples(&uses, &all, 48) {
        let at = |e: &Expr| match evaluate::<Interval>(e, &sample.point(true)) {
            Outcome::Value(v) if v.high < 0.0 => Some(true),
            Outcome::Value(v) if v.low > 0.0 => Some(false),
            _ => None,
        };
        if let (Some(a), Some(b)) = (at(f), at(g))
            && a != b
        {
            let word = |holds: bool| if holds { "holds" } else { "does not hold" }.to_string();
            let mut finding = Finding::different(
                "DIFF_INEQUALITY",
                "counterexample",
                "one holds where the other does not",
            );
            finding.counterexample = Some(Apart {
                at: sample.words(),
                yours: word(b),
                expected: word(a),
            });
            finding.assumed = assumed;
            return finding.with(Diagnosis::new(
                "INEQUALITY",
                "the inequality holds elsewhere than it should",
                "check the bound and the direction of your inequality",
            ));
        }
    }
    // The same bound on the same symbol?
    for name in unknowns(f, g) {
        if let (Some(a), Some(b)) = (solve_for(f, &name, domains), solve_for(g, &name, domains)) {
            let finding = scalars(
                &Context {
                    key: ctx.key,
                    options: ctx.options,
                    diagnose: false,
                },
                &a,
                &b,
            );
            if finding.verdict == Verdict::Different {
                return Finding {
                    note: "DIFF_INEQUALITY",
                    ..finding
                };
            }
        }
    }
    Finding::new(
        Verdict::Undecided,
        "UNDECIDED_SOLUTIONS",
        Proof::of(
            "none",
            "the inequalities agree at every point tried, and no proof was found",
        ),
    )
}
