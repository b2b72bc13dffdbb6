//! Equations and inequalities: the same when they have the same solutions on the domain.
//!
//! F = 0 and G = 0 have the same solutions where F/G keeps one sign; where it does not, each equation is solved for a
//! symbol in which it is linear and put into the other. Roots gained or lost are reported with a point.

use std::collections::BTreeMap;

use super::compare::{Context, Finding, WRITTEN, scalars};
use super::{Apart, Diagnosis, Proof, Verdict};
use crate::algebra::{Field, Sign};
use crate::domain::{Domains, roles, samples};
use crate::equality::{self, Equality};
use crate::expr::{Expr, Node, Symbol};
use crate::formula::{Content, Relation};
use crate::interval::{Interval, Outcome, evaluate};

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
        Normal {
            difference,
            relation,
        }
    };
    Some(pairs.map(normal).collect())
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
    match field.sign(&field.div(&a, &e).ok()?)? {
        Sign::Positive => Some(true),
        Sign::Negative => Some(false),
        _ => None,
    }
}

/// Two equations whose quotient changes sign or vanishes somewhere, or is not known.
fn equations(ctx: &Context, expected: &Normal, answer: &Normal) -> Finding {
    let domains = &ctx.key.question.domains;
    let (f, g) = (&expected.difference, &answer.difference);
    // A solution of one that the other lacks.
    let lost = solution_apart(f, g, domains);
    if let (Some(at), Some(_)) = (&lost, solution_apart(g, f, domains)) {
        let words = "the equation says something else than the expected one";
        let mut finding = parted(ctx, words, "DIFF_EQUATION", at.clone(), f, g);
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
        return parted(ctx, words, "DIFF_ROOT_LOST", at, f, g);
    }
    if let Some(at) = solution_apart(g, f, domains) {
        let words = "the answer has a solution that the expected equation lacks";
        return parted(ctx, words, "DIFF_ROOT_GAINED", at, f, g);
    }
    // Where one is the other times something that vanishes inside the domain, that is a root more.
    if let Some(ratio) = ratio(f, g, domains) {
        if let Some(at) = solution_apart(&ratio.powi(-1), g, domains) {
            let words = "divided by something that vanishes inside the domain";
            return parted(ctx, words, "DIFF_ROOT_LOST", at, f, g);
        }
        if let Some(at) = solution_apart(&ratio, f, domains) {
            let words = "multiplied by something that vanishes inside the domain";
            let swapped = (at.0, at.2, at.1);
            return parted(ctx, words, "DIFF_ROOT_GAINED", swapped, f, g);
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
    // Where the answer is the expected equation times something that changes sign, that something is a root gained.
    if let Some(at) = sign_change(f, g, domains) {
        let words = "multiplied by something that vanishes inside the domain";
        return Finding {
            counterexample: Some(Apart {
                at,
                yours: "holds".into(),
                expected: "need not hold".into(),
            }),
            ..Finding::different("DIFF_ROOT_GAINED", "solutions", words)
        }
        .with(Diagnosis::new(
            "ROOT_GAINED",
            words,
            "your equation has more solutions than asked for",
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

fn parted(
    ctx: &Context,
    words: &str,
    note: &'static str,
    at: (String, Expr, Expr),
    f: &Expr,
    g: &Expr,
) -> Finding {
    let _ = (f, g);
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

/// The value of a symbol at which a difference vanishes, where it is linear in the symbol.
pub(crate) fn solve_for(f: &Expr, name: &Symbol, domains: &Domains) -> Option<Expr> {
    let slope = f.derivative(name);
    let (all, _) = domains.completed(&roles(&[f, &slope]));
    let mut field = Field::new(&all);
    field.prepare([f, &slope]);
    let slope = field.element(&slope).ok()?;
    if field.is_zero(&slope)
        || slope.terms() > WRITTEN
        || field.expr(&slope).symbols().contains(name)
    {
        return None;
    }
    let constant = field
        .element(&f.substitute(&BTreeMap::from([(name.clone(), Expr::zero())])))
        .ok()?;
    let root = field.neg(&field.div(&constant, &slope).ok()?);
    if root.terms() > WRITTEN {
        return None;
    }
    let root = field.expr(&root);
    (!root.symbols().contains(name)).then_some(root)
}

/// The symbols to solve for: those occurring in both first.
fn unknowns(f: &Expr, g: &Expr) -> Vec<Symbol> {
    let (a, b) = (f.symbols(), g.symbols());
    a.union(&b).cloned().collect()
}

/// Whether `f = 0`, solved for some symbol, turns `g` into zero identically.
fn solved_in(f: &Expr, g: &Expr, domains: &Domains) -> bool {
    unknowns(f, g).iter().any(|name| {
        solve_for(f, name, domains).is_some_and(|root| {
            let put_in = g.substitute(&BTreeMap::from([(name.clone(), root)]));
            matches!(
                equality::decide(&put_in, &Expr::zero(), domains).equality,
                Equality::Same { .. }
            )
        })
    })
}

/// A point inside the domain where `f` vanishes and `g` does not, in words, with both values there.
fn solution_apart(f: &Expr, g: &Expr, domains: &Domains) -> Option<(String, Expr, Expr)> {
    let uses = roles(&[f, g]);
    let (domains, _) = domains.completed(&uses);
    for name in unknowns(f, g) {
        if uses.symbols.get(&name).is_some_and(|r| r.turns) {
            continue;
        }
        let Some(root) = solve_for(f, &name, &domains) else {
            continue;
        };
        for sample in samples(&roles(&[f, g, &root]), &domains, 12) {
            let point = sample.point::<crate::interval::Big<200>>(true);
            let Outcome::Value(value) = evaluate(&root, &point) else {
                continue;
            };
            let middle = crate::interval::Outcome::Value(value.clone());
            let inside = exact_inside(&root, &sample, &name, &domains);
            if !inside {
                continue;
            }
            let mut there = point.clone();
            there.values.insert(name.clone(), middle);
            if let Outcome::Value(left) = evaluate(g, &there)
                && !left.0.has_zero()
            {
                let digits = |v: &crate::interval::Enclosure| v.decimal(6);
                let mut shown = sample.clone();
                shown.coordinates.remove(&name);
                let mut at = shown.words();
                if !at.is_empty() {
                    at.push_str(", ");
                }
                at.push_str(&format!("{name} = {}", digits(&value.0)));
                let number = |text: String| {
                    super::number::decimal(&text).map_or_else(Expr::zero, Expr::from)
                };
                return Some((at, Expr::zero(), number(digits(&left.0))));
            }
        }
    }
    None
}

/// Whether the root's value lies strictly inside the symbol's domain.
fn exact_inside(
    root: &Expr,
    sample: &crate::domain::Sample,
    name: &Symbol,
    domains: &Domains,
) -> bool {
    let Some(domain) = domains.symbols.get(name) else {
        return true;
    };
    let Outcome::Value(value) = evaluate::<Interval>(root, &sample.point(true)) else {
        return false;
    };
    [value.low, value.high]
        .into_iter()
        .all(|end| crate::expr::number::from_f64(end).is_some_and(|end| domain.contains(&end)))
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

/// A point pair between which the quotient g/f changes sign, in words.
fn sign_change(f: &Expr, g: &Expr, domains: &Domains) -> Option<String> {
    let quotient = g / f;
    let uses = roles(&[&quotient]);
    let (domains, _) = domains.completed(&uses);
    let mut field = Field::new(&domains);
    field.prepare([f, g]);
    let (a, b) = (field.element(f).ok()?, field.element(g).ok()?);
    let ratio = field.div(&b, &a).ok()?;
    if ratio.terms() > WRITTEN {
        return None;
    }
    let ratio = field.expr(&ratio);
    let mut seen: [Option<String>; 2] = [None, None];
    for sample in samples(&roles(&[&ratio]), &domains, 24) {
        if let Outcome::Value(v) = evaluate::<Interval>(&ratio, &sample.point(true)) {
            if v.low > 0.0 {
                seen[1].get_or_insert(sample.words());
            } else if v.high < 0.0 {
                seen[0].get_or_insert(sample.words());
            }
        }
    }
    let [negative, positive] = seen;
    Some(format!("somewhere between {} and {}", negative?, positive?))
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
