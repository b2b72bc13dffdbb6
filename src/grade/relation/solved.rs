//! Equations solved for one symbol: where it is linear, and where it is an angle that stands in one sine, cosine or tangent.
//!
//! In: a difference that vanishes and the domains. Out: the value of the symbol, points where another difference does not
//! vanish, and whether two equations fix an angle alike.

use super::super::context::WRITTEN;
use super::super::number;
use crate::algebra::Field;
use crate::domain::{Domain, Domains, Sample, roles};
use crate::equality::{self, Equality};
use crate::expr::angle::angle;
use crate::expr::number::to_f64;
use crate::expr::{Expr, Function, Node, Rational, Symbol, effort};
use crate::interval::{Big, Enclosure, Interval, Outcome, evaluate};

/// The value of a symbol at which a difference vanishes, where it is linear in the symbol.
pub(crate) fn solve_for(f: &Expr, name: &Symbol, domains: &Domains) -> Option<Expr> {
    if effort::spent() {
        return None;
    }
    let slope = f.derivative(name);
    let mut field = Field::new(&domains.of(&[f, &slope]));
    field.prepare([f, &slope]);
    let slope = field.proved(&slope).ok()??;
    if field.is_zero(&slope)
        || slope.terms() > WRITTEN
        || field.expr(&slope).symbols().contains(name)
    {
        return None;
    }
    let constant = field.proved(&f.put(name, &Expr::zero())).ok()??;
    let root = field.neg(&field.div(&constant, &slope).ok()?);
    if root.terms() > WRITTEN {
        return None;
    }
    let root = field.expr(&root);
    (!root.symbols().contains(name)).then_some(root)
}

/// The symbols to solve for: those occurring in both first.
pub(super) fn unknowns(f: &Expr, g: &Expr) -> Vec<Symbol> {
    let (a, b) = (f.symbols(), g.symbols());
    a.union(&b).cloned().collect()
}

/// Whether `f = 0`, solved for some symbol, turns `g` into zero identically.
pub(super) fn solved_in(f: &Expr, g: &Expr, domains: &Domains) -> bool {
    unknowns(f, g).iter().any(|name| {
        let root = solve_for(f, name, domains);
        root.is_some_and(|root| equality::vanishes(&g.put(name, &root), domains))
    })
}

/// A point with another value of one symbol, in words.
pub(super) fn words_at(sample: &Sample, name: &Symbol, value: &Enclosure) -> String {
    let mut others = sample.clone();
    others.coordinates.remove(name);
    let words = others.words();
    let here = format!("{name} = {}", value.decimal(6));
    match words.is_empty() {
        true => here,
        false => format!("{words}, {here}"),
    }
}

/// A value rounded to be shown.
pub(super) fn rounded(value: &Enclosure) -> Expr {
    number::decimal(&value.decimal(6)).map_or_else(Expr::zero, Expr::from)
}

/// A point inside the domain where `f` vanishes, `g` does not and `own` has a value, in words, with the value of `g` there.
pub(super) fn solution_apart(
    f: &Expr,
    [g, own]: [&Expr; 2],
    domains: &Domains,
) -> Option<(String, Expr)> {
    let uses = roles(&[f, g, own]);
    let (domains, _) = domains.completed(&uses);
    for name in unknowns(f, g) {
        if uses.symbols.get(&name).is_some_and(|r| r.turns) {
            continue;
        }
        let Some(root) = solve_for(f, &name, &domains) else {
            continue;
        };
        for sample in domains.points(&[f, g, own, &root], 12) {
            let point = sample.point::<Big<200>>(true);
            let Outcome::Value(value) = evaluate(&root, &point) else {
                continue;
            };
            if !exact_inside(&root, &sample, &name, &domains) {
                continue;
            }
            let mut there = point.clone();
            let middle = Outcome::Value(value.clone());
            there.values.insert(name.clone(), middle);
            if let Outcome::Value(left) = evaluate(g, &there)
                && !left.0.has_zero()
                && matches!(evaluate(own, &there), Outcome::Value(_))
            {
                return Some((words_at(&sample, &name, &value.0), rounded(&left.0)));
            }
        }
    }
    None
}

/// Whether a value lies in a symbol's domain, which is positive where nothing is declared.
pub(super) fn lies_in(value: &Enclosure, name: &Symbol, domains: &Domains) -> bool {
    holds_value(&domains.of_symbol(name), value)
}

/// Whether it does so and is no end of it.
pub(super) fn lies_inside(value: &Enclosure, name: &Symbol, domains: &Domains) -> bool {
    let mut domain = domains.of_symbol(name);
    for limit in [&mut domain.low, &mut domain.high].into_iter().flatten() {
        limit.open = true;
    }
    holds_value(&domain, value)
}

fn holds_value(domain: &Domain, value: &Enclosure) -> bool {
    let mut ends = [&value.low, &value.high].into_iter();
    ends.all(|end| domain.contains(&end.to_rational()))
}

/// Whether the root's value lies strictly inside the symbol's domain, and keeps to the relations.
fn exact_inside(root: &Expr, sample: &Sample, name: &Symbol, domains: &Domains) -> bool {
    let Some(domain) = domains.symbols.get(name) else {
        return true;
    };
    let Outcome::Value(value) = evaluate::<Interval>(root, &sample.point(true)) else {
        return false;
    };
    domains.admits_with(sample, name, value)
        && [value.low, value.high]
            .into_iter()
            .all(|end| crate::expr::number::from_f64(end).is_some_and(|end| domain.contains(&end)))
}

/// Whether two equations fix the same angle: `tan θ = 1/2` and `θ = atan(1/2)`, each of which has one solution at most on the
/// angle's domain. `None` where that is not known.
pub(super) fn same_angle(f: &Expr, g: &Expr, domains: &Domains) -> Option<bool> {
    let uses = roles(&[f, g]);
    let (all, _) = domains.completed(&uses);
    let angles = uses.symbols.iter().filter(|(_, role)| role.turns);
    angles.into_iter().find_map(|(name, _)| {
        let domain = all.symbols.get(name)?;
        let (a, b) = (
            angle_of(f, name, domain, &all)?,
            angle_of(g, name, domain, &all)?,
        );
        match equality::decide(&a, &b, &all).equality {
            same if same.is_identity() => Some(true),
            Equality::Different(apart) => [a, b]
                .iter()
                .any(|root| within(root, &apart.at, domain))
                .then_some(false),
            _ => None,
        }
    })
}

/// Sines, cosines and tangents of one multiple of an angle and a multiple of π.
pub(super) struct Turning {
    pub argument: Expr,
    functions: Vec<Function>,
    factor: Rational,
    shift: Rational,
    /// From where to where the argument goes on the domain of the angle, in units of π.
    pub span: [f64; 2],
}

impl Turning {
    pub(super) fn of(f: &Expr, name: &Symbol, domain: &Domain) -> Option<Turning> {
        let calls = calls(f, name);
        let argument = calls.first()?.1.clone();
        let read = angle(&argument).filter(|a| a.symbols.len() == 1)?;
        let (factor, shift) = (read.symbols.get(name)?.clone(), read.pi);
        let turns = |end: f64| end / std::f64::consts::PI * to_f64(&factor) + to_f64(&shift);
        let [from, to] = domain.bounds().map(|end| end.map(turns));
        let (from, to) = (from?, to?);
        let same = calls.iter().all(|(_, other)| *other == argument);
        same.then(|| Turning {
            functions: calls.iter().map(|(function, _)| *function).collect(),
            span: [from.min(to), from.max(to)],
            argument,
            factor,
            shift,
        })
    }

    /// The angle of which this is the argument.
    pub(super) fn angle(&self, argument: Expr) -> Expr {
        let turned = argument - Expr::pi() * Expr::from(self.shift.clone());
        turned * Expr::from(self.factor.recip())
    }
}

/// The sines, cosines and tangents in which an angle stands.
fn calls(f: &Expr, name: &Symbol) -> Vec<(Function, Expr)> {
    let turning = [Function::Sin, Function::Cos, Function::Tan];
    let call = |part: &Expr| match part.node() {
        Node::Call(function, x) if turning.contains(function) && x.symbols().contains(name) => {
            Some((*function, x.clone()))
        }
        _ => None,
    };
    let mut calls: Vec<(Function, Expr)> = f.parts().filter_map(call).collect();
    calls.dedup();
    calls
}

/// The one value of an angle on its domain at which a difference may vanish.
fn angle_of(f: &Expr, name: &Symbol, domain: &Domain, domains: &Domains) -> Option<Expr> {
    if calls(f, name).is_empty() {
        return solve_for(f, name, domains);
    }
    let turning = Turning::of(f, name, domain)?;
    let &[function] = turning.functions.as_slice() else {
        return None;
    };
    let [least, most] = match function {
        Function::Cos => [0.0, 1.0],
        _ => [-0.5, 0.5],
    };
    let margin = 1e-9;
    let [from, to] = turning.span;
    if from < least - margin || to > most + margin {
        return None;
    }
    let value: Symbol = "value of the function".into();
    let call = Expr::call(function, turning.argument.clone());
    let plain = f.replace(&call, &Expr::symbol(&value));
    if plain.symbols().contains(name) {
        return None;
    }
    // Of either sign, where a symbol that nobody declares is positive.
    let mut domains = domains.clone();
    domains.symbols.insert(value.clone(), Domain::real());
    let inverse = match function {
        Function::Sin => Function::Asin,
        Function::Cos => Function::Acos,
        _ => Function::Atan,
    };
    let arc = Expr::call(inverse, solve_for(&plain, &value, &domains)?);
    Some(turning.angle(arc))
}

/// Whether the value at a point lies inside a domain for certain.
fn within(root: &Expr, at: &Sample, domain: &Domain) -> bool {
    let Outcome::Value(value) = evaluate::<Interval>(root, &at.point(true)) else {
        return false;
    };
    let margin = 1e-9;
    let [low, high] = domain.bounds();
    low.is_none_or(|low| value.low > low + margin)
        && high.is_none_or(|high| value.high < high - margin)
}
