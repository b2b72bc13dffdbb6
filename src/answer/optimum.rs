//! Largest and least values over one or two parameters.
//!
//! Two parameters are looked at together first: where only one combination p·qᵏ of them matters, its best value is a curve
//! of maximisers and is told as such. Square roots of the parameter are taken away by p = x², so that the derivative becomes
//! a polynomial whose roots have a closed form or are isolated.

use std::collections::BTreeMap;

use super::calc::{
    Seen, above_zero, by_signs, constant, essential, has_root, is_zero, sign, square, tidy,
};
use super::solve::{Root, Unsolved, end_of, solve, stated};
use super::{Answer, Check, Form, ROOT, Refused, threshold};
use crate::algebra::Sign;
use crate::domain::{Domain, Domains, Limit};
use crate::expr::{Expr, Node, Symbol};
use crate::formula::{Relation, write_plain};
use crate::formula::{Sentence, sentence};
use crate::scene::{Extremum, Scene};

/// The combination of two parameters.
const JOINT: &str = "\u{1}joint";
/// What a refusal says of the way.
const ONE_VARIABLE: &str =
    "such a value is found over one parameter, or two of which one combination matters";

/// A formula of one variable in the place of its parameters.
struct Reduced {
    of: Expr,
    variable: Symbol,
    /// What the variable stands for.
    combination: Expr,
    /// The parameters, where there are two.
    pair: Option<[Symbol; 2]>,
}

/// The largest or least value of a formula over parameters.
pub(super) fn extremum(
    scene: &Scene,
    mut out: Answer,
    which: Extremum,
    (of, over): (&Expr, &[Symbol]),
) -> Result<Vec<Answer>, Refused> {
    let mut domains = scene.domains.clone();
    let plays = |s: &Symbol| !tidy(&of.derivative(s), &domains).is_ok_and(|d| d.is_zero());
    let (free, idle): (Vec<Symbol>, Vec<Symbol>) = over.iter().cloned().partition(plays);
    for s in &idle {
        out.text.push(sentence!("{} plays no part", s));
    }
    if free.is_empty() {
        out.form = Form::value(of.clone());
        return Ok(vec![out]);
    }
    let name = out.name.clone();
    let refused = |reason: String| Refused::question(&name, reason, ONE_VARIABLE);
    let reduced = reduced(of, &free, &mut domains).map_err(refused)?;
    if reduced.pair.is_some() {
        out.text.push(sentence!(
            "only the combination {} matters",
            &reduced.combination
        ));
    }
    let range = domains.symbols.get(&reduced.variable);
    let is_positive = range.is_none_or(|d| *d == Domain::positive() || *d == Domain::nonnegative());
    let related = |r: &crate::domain::Relation| r.excess.symbols().contains(&reduced.variable);
    if !is_positive || domains.relations.iter().any(related) {
        return bounded(scene, out, which, (&reduced.of, &reduced.variable));
    }
    over_positive(scene, out, which, &reduced, domains)
}

/// The formula through one variable, whose domain is entered where it is new; an error tells why there is none.
fn reduced(of: &Expr, free: &[Symbol], domains: &mut Domains) -> Result<Reduced, String> {
    let (p, q) = match free {
        [p] => {
            return Ok(Reduced {
                of: of.clone(),
                variable: p.clone(),
                combination: Expr::symbol(p),
                pair: None,
            });
        }
        [p, q] => (p, q),
        _ => return Err(String::from("more than two parameters")),
    };
    let k = joint(of, p, q, domains)
        .ok_or_else(|| format!("{p} and {q} do not matter through one combination only"))?;
    // u = p qᵏ, so that p = u q⁻ᵏ; what is left of q must cancel.
    let variable: Symbol = JOINT.into();
    domains.symbols.insert(variable.clone(), Domain::positive());
    let replaced = &Expr::symbol(JOINT) * &Expr::symbol(q).power(-&k);
    let through = of.put(p, &replaced);
    let through = tidy(&through, domains).map_err(|s| s.to_string())?;
    if through.symbols().contains(q) {
        return Err(format!("{q} does not cancel"));
    }
    let combination = &Expr::symbol(p) * &Expr::symbol(q).power(k);
    Ok(Reduced {
        of: through,
        variable,
        combination: tidy(&combination, domains).map_err(|s| s.to_string())?,
        pair: Some([p.clone(), q.clone()]),
    })
}

/// Said where a derivative vanishes at what cannot be written.
const NO_FORM: &str = "where the derivative vanishes has no closed form here";

/// The largest or least value over one variable that may be any positive number, and where it is.
fn over_positive(
    scene: &Scene,
    mut out: Answer,
    which: Extremum,
    reduced: &Reduced,
    mut domains: Domains,
) -> Result<Vec<Answer>, Refused> {
    let name = out.name.clone();
    let refused = |reason: String| Refused::question(&name, reason, ONE_VARIABLE);
    let words = write_plain(&reduced.combination);
    let root: Symbol = ROOT.into();
    domains.symbols.insert(root.clone(), Domain::positive());
    let tidy = |e: &Expr| tidy(e, &domains).map_err(|s| refused(s.to_string()));
    let put = |e: &Expr, x: Expr| e.put(&root, &x);
    // Where it stands under a root, its root makes a fraction of polynomials of the formula.
    let power = if has_root(&reduced.of, &reduced.variable) {
        2
    } else {
        1
    };
    let through = Expr::symbol(ROOT).powi(power);
    let f = tidy(&reduced.of.put(&reduced.variable, &through))?;
    let slope = tidy(&of_square(&f, &root, &domains).derivative(&root))?;
    let roots = match solve(&slope, &root, &domains) {
        Ok(roots) if roots.open.is_empty() => roots,
        Err(Unsolved::Absent) => {
            return Ok(vec![at_the_rim(out, which, &slope, &words, &domains)]);
        }
        Ok(_) | Err(Unsolved::Inside) => {
            return Err(refused(NO_FORM.into()));
        }
        Err(Unsolved::Limit(what)) => return Err(refused(what)),
    };
    let named = BTreeMap::from([(
        root.clone(),
        reduced.combination.power(Expr::ratio(1, power)),
    )]);
    let discarded: Vec<Sentence> = roots.discarded.iter().map(|d| d.put_in(&named)).collect();
    if roots.inside.is_empty() {
        out.discarded = discarded;
        return Ok(vec![at_the_rim(out, which, &slope, &words, &domains)]);
    }
    let [best] = roots.inside.as_slice() else {
        return Err(elsewhere(&name, which, &reduced.variable, &roots.inside));
    };
    out.assumptions
        .extend(best.given.iter().map(|given| given.put_in(&named)));
    let domains = threshold::exists(&mut out, None, &roots, &domains);
    let tidy = |e: &Expr| super::calc::tidy(e, &domains).map_err(|s| refused(s.to_string()));
    let side = |factor: Expr| {
        let e = put(&slope, &factor * &best.value);
        sign(&which.merit(&essential(&e, &domains)), &domains)
    };
    let (before, after) = (side(Expr::ratio(1, 2)), side(Expr::from(2)));
    if !(before.is_positive() && after.is_negative()) {
        return Err(elsewhere(&name, which, &reduced.variable, &roots.inside));
    }
    let value = tidy(&put(&f, best.value.clone()))?;
    let value = super::calc::shorter(&value, &domains);
    let place = tidy(&best.value.powi(power))?;
    out.discarded = discarded;
    out.checks.push(by_signs(
        which.kind(),
        match which {
            Extremum::Largest => "the derivative vanishes there and nowhere else; the value rises before and falls after ({how})",
            Extremum::Least => "the derivative vanishes there and nowhere else; the value falls before and rises after ({how})",
        },
        before.is_proved() && after.is_proved(),
    ));
    out.checks.push(Check::new(
        "identity",
        "the derivative at that place is identically zero",
        best.proved.then_some(true),
    ));
    let at_best = |e: &Expr| put(e, best.value.clone());
    let flat = "the derivative at that place";
    out.put_in = vec![
        (at_best(&slope), Expr::zero(), flat),
        (at_best(&f), value.clone(), "the value there"),
    ];
    let there = Expr::symbol(format!("{name}_at").as_str()).power(Expr::ratio(1, power));
    let mut at = place_of(scene, &out, which, reduced, place)?;
    at.put_in = vec![(put(&slope, there), Expr::zero(), flat)];
    out.form = Form::value(value);
    Ok(vec![out, at])
}

/// Where a value is largest or least, as an answer of its own.
fn place_of(
    scene: &Scene,
    value: &Answer,
    which: Extremum,
    reduced: &Reduced,
    place: Expr,
) -> Result<Answer, Refused> {
    let combination = reduced.combination.clone();
    let words = write_plain(&combination);
    let mut at = Answer {
        name: format!("{}_at", value.name),
        latex: format!("\\arg {}", value.latex),
        words: format!("{words} for which it is {}", which.word()),
        dimension: super::dimension_of(scene, &combination, &value.name)?,
        form: Form::value(place.clone()),
        // How it was found is told with the value.
        discarded: Vec::new(),
        text: Vec::new(),
        ..value.clone()
    };
    if let Some([p, q]) = &reduced.pair {
        let pair = sentence!("every pair {}, {} with this ", p, q);
        let does = "{}{} does it: the best pairs form a curve";
        let parts = [pair, (&combination).into()];
        at.text.push(Sentence::filled(does, parts));
    }
    at.range.push((combination, Relation::Equal, place));
    Ok(at)
}

/// Told where the derivative vanishes more than once, or not where it is sought: only an interval decides then.
fn elsewhere(
    name: &str,
    which: Extremum,
    variable: &Symbol,
    roots: &[super::solve::Root],
) -> Refused {
    let reason = match roots.len() {
        1 => format!(
            "where the derivative vanishes the value is not {}",
            which.word()
        ),
        count => format!("the derivative vanishes at {count} values of {variable}"),
    };
    let hint = format!(
        "with a \"domain\" of `min` and `max` for {variable} the values at its ends are compared too"
    );
    Refused::question(name, reason, hint)
}

/// The largest or least value over one parameter in an interval: where the derivative vanishes once, or at an end.
fn bounded(
    scene: &Scene,
    mut out: Answer,
    which: Extremum,
    (f, p): (&Expr, &Symbol),
) -> Result<Vec<Answer>, Refused> {
    let domains = &scene.domains;
    let name = out.name.clone();
    let refused = |reason: String| Refused::question(&name, reason, "");
    if let Some(pole) = pole(f, p, domains) {
        let pole = write_plain(&pole);
        return Err(refused(format!("{pole} may vanish within the interval")));
    }
    let search = Search {
        name: &name,
        which,
        f,
        slope: tidy(&of_square(f, p, domains).derivative(p), domains)
            .map_err(|s| refused(s.to_string()))?,
        p,
        domain: domains.of_symbol(p),
        domains,
    };
    let ends = search.ends();
    let is_end = |x: &Expr| (ends.iter()).any(|e| is_zero(&(x - e), domains) == Some(true));
    let mut inside = search.flat(&mut out)?;
    inside.retain(|root| !is_end(&root.value));
    let bends = match inside.as_slice() {
        [only] => Some(search.at(&only.value, &search.slope.derivative(p))?),
        _ => None,
    };
    let bends = bends.map(|bends| sign(&which.merit(&bends), domains));
    let place = match (inside.as_slice(), bends) {
        ([only], Some(bends)) if bends.is_negative() => {
            let holds = bends.is_proved().then_some(true);
            out.assumptions.extend(only.given.iter().cloned());
            match search.beyond(only, scene, &mut out)? {
                Some(end) => {
                    let words = "the derivative vanishes beyond that end and nowhere else, and the second derivative is {} there";
                    let words = words.replace("{}", which.bend());
                    out.checks.push(Check::new(which.kind(), words, holds));
                    end
                }
                None => {
                    let words = "the derivative vanishes there and nowhere else in the interval, and the second derivative is {}";
                    let words = words.replace("{}", which.bend());
                    out.checks.push(Check::new(which.kind(), words, holds));
                    only.value.clone()
                }
            }
        }
        ([], _) => match search.at_an_end(&mut out)? {
            Some(place) => place,
            None => return Ok(vec![at_the_rim(out, which, &search.slope, p, domains)]),
        },
        (several, _) => {
            let values: Vec<Expr> = several.iter().map(|root| root.value.clone()).collect();
            let place = search.compared(&values, &mut out)?;
            // That it is better than at the others rests on nothing that these rest on.
            let there = several.iter().filter(|root| root.value == place);
            out.assumptions
                .extend(there.flat_map(|root| root.given.clone()));
            place
        }
    };
    let value = search.at(&place, f)?;
    out.assumptions.extend(search.breaks(&place, &value));
    let there = BTreeMap::from([(p.clone(), place.clone())]);
    let raw = tidy_under_roots(&f.substitute(&there), domains);
    out.put_in.push((raw, value.clone(), "the value there"));
    out.range.push((Expr::symbol(p), Relation::Equal, place));
    out.form = Form::value(value);
    Ok(vec![out])
}

/// A search for the largest or least value over one parameter in an interval.
struct Search<'a> {
    /// The question.
    name: &'a str,
    which: Extremum,
    f: &'a Expr,
    /// Its derivative, or that of its square where that has no root and the same sign.
    slope: Expr,
    p: &'a Symbol,
    domain: Domain,
    domains: &'a Domains,
}

impl Search<'_> {
    fn refused(&self, reason: String) -> Refused {
        Refused::question(self.name, reason, "")
    }

    /// An expression where the parameter has a value.
    fn at(&self, x: &Expr, e: &Expr) -> Result<Expr, Refused> {
        let there = e.put(self.p, x);
        tidy(&there, self.domains).map_err(|s| self.refused(s.to_string()))
    }

    fn ends(&self) -> Vec<Expr> {
        let ends = [&self.domain.low, &self.domain.high];
        ends.into_iter().flatten().map(Limit::expr).collect()
    }

    /// Where the derivative vanishes.
    fn flat(&self, out: &mut Answer) -> Result<Vec<Root>, Refused> {
        match solve(&self.slope, self.p, self.domains) {
            Ok(roots) if roots.open.is_empty() => {
                out.discarded = roots.discarded;
                Ok(roots.inside)
            }
            Ok(_) | Err(Unsolved::Inside) => Err(self.refused(format!(
                "where the derivative with respect to {} vanishes has no closed form here",
                self.p
            ))),
            Err(Unsolved::Absent) => Ok(Vec::new()),
            Err(Unsolved::Limit(what)) => Err(self.refused(what)),
        }
    }

    /// The only place where the derivative vanishes, and where the value is best, may lie beyond one end of the range: then it
    /// is best at that end. Gives the end where the values of the scene say so; says so of all others otherwise.
    fn beyond(
        &self,
        root: &Root,
        scene: &Scene,
        out: &mut Answer,
    ) -> Result<Option<Expr>, Refused> {
        let [(need, closed)] = root.needs.as_slice() else {
            return Ok(None);
        };
        let there = self.domains.given(&-need, !closed);
        let passes = |upper: bool| -> Result<Option<Expr>, Refused> {
            let Some((end, false)) = self.end(upper)? else {
                return Ok(None);
            };
            let gap = if upper {
                &root.value - &end
            } else {
                &end - &root.value
            };
            let passes = sign(&gap, &there).is_not_negative();
            Ok(passes.then_some(end))
        };
        let end = match passes(true)? {
            Some(end) => Some(end),
            None => passes(false)?,
        };
        let Some(end) = end else {
            return Ok(None);
        };
        let needed = match closed {
            true => Sentence::positive(&-need),
            false => Sentence::not_negative(&-need),
        };
        if constant(&need.substitute(&scene.values())) == Some(Sign::Negative) {
            let so_that = sentence!("{} = {} is not in the range", self.p, &root.value);
            out.assumptions.retain(|told| !root.given.contains(told));
            out.assumptions
                .push(sentence!("{}, so that {}", needed, so_that));
            out.needs.push((end.clone(), -need, !closed));
            return Ok(Some(end));
        }
        let value = self.at(&end, self.f)?;
        let words = "where {} instead, the {} value is {}, at the end {} of the range of {}";
        let best = Sentence::words(self.which.word());
        let parts = [needed, best, (&value).into(), (&end).into(), self.p.into()];
        out.text.push(Sentence::filled(words, parts));
        Ok(None)
    }

    /// The end towards which the value grows, or falls, all the way; `None` where the interval does not end there.
    fn at_an_end(&self, out: &mut Answer) -> Result<Option<Expr>, Refused> {
        let p = self.p;
        let rising = sign(&self.slope, self.domains);
        // Where the slope is zero at an end alone, it has one sign inside.
        let grows = if rising.is_positive() || rising == Seen::Proved(Sign::NotNegative) {
            true
        } else if rising.is_negative() || rising == Seen::Proved(Sign::NotPositive) {
            false
        } else {
            return Err(self.refused(format!("whether it grows with {p} could not be decided")));
        };
        let end = self.end(grows == (self.which == Extremum::Largest))?;
        let Some((value, open)) = end else {
            return Ok(None);
        };
        let words = "the derivative has one sign inside the interval ({how})";
        out.checks
            .push(by_signs(self.which.kind(), words, rising.is_proved()));
        let bound = self.bound(&value, open);
        let best = self.which.word();
        out.text.push(match grows {
            true => sentence!("it grows with {}: the {} value is {}", p, best, bound),
            false => sentence!("it falls as {} grows: the {} value is {}", p, best, bound),
        });
        Ok(Some(value))
    }

    /// That another symbol is not at the end of its domain where the value at a place is no longer what it is elsewhere: of
    /// cos θ/(cos θ + e sin θ) at θ = π/2, 0, that is e > 0.
    fn breaks(&self, place: &Expr, value: &Expr) -> Vec<Sentence> {
        let others = self.f.symbols().into_iter().filter(|s| s != self.p);
        let ends = others.flat_map(|symbol| {
            let domain = self.domains.of_symbol(&symbol);
            let ends = [(domain.low, true), (domain.high, false)];
            ends.map(|(end, is_low)| (symbol.clone(), end, is_low))
        });
        ends.filter_map(|(symbol, end, is_low)| {
            let end = end.filter(|end| !end.open && !end.of_pi)?.expr();
            let [here, place, value] = [self.f, place, value].map(|e| {
                let there = e.put(&symbol, &end);
                tidy(&there, self.domains).ok()
            });
            let here = here.and_then(|f| tidy(&f.put(self.p, &place?), self.domains).ok());
            let goes_on = matches!((here, value), (Some(here), Some(value))
                if is_zero(&(&here - &value), self.domains) != Some(false));
            let inside = match is_low {
                true => Expr::symbol(&symbol) - end,
                false => end - Expr::symbol(&symbol),
            };
            (!goes_on).then(|| above_zero(&inside, self.domains))
        })
        .collect()
    }

    /// That a value is reached or approached at an end of the interval, in words.
    fn bound(&self, end: &Expr, open: bool) -> Sentence {
        let how = match open {
            true => "approached at, and not reached, as the domain excludes",
            false => "at",
        };
        sentence!("{} the bound {} = {}", how, self.p, end)
    }

    /// The upper or lower end of the interval, by its domain and the relations, and whether it is excluded; `None` where there
    /// is none.
    fn end(&self, upper: bool) -> Result<Option<(Expr, bool)>, Refused> {
        let (p, domains) = (self.p, self.domains);
        let limit = match upper {
            true => &self.domain.high,
            false => &self.domain.low,
        };
        let mut tightest = limit.as_ref().map(|end| (end.expr(), end.open));
        let bearing = domains.relations.iter();
        for r in bearing.filter(|r| r.excess.symbols().contains(p)) {
            let Some((end, is_upper)) = end_of(p, r, domains) else {
                return Err(self.refused(format!(
                    "it is {} at an end of the range of {p}, which {} does not give alone",
                    self.which.word(),
                    stated(r)
                )));
            };
            if is_upper != upper {
                continue;
            }
            let is_tighter = match &tightest {
                None => true,
                Some((so_far, _)) => {
                    let room = if upper { so_far - &end } else { &end - so_far };
                    match sign(&room, domains) {
                        Seen::Proved(s) if s.is_not_negative() => true,
                        s if s.is_positive() => true,
                        s if s.is_negative() || s == Seen::Proved(Sign::NotPositive) => false,
                        _ => {
                            let why = format!("several relations end the range of {p}");
                            return Err(self.refused(why));
                        }
                    }
                }
            };
            if is_tighter {
                tightest = Some((end, !r.closed));
            }
        }
        Ok(tightest)
    }

    /// The best of the places where the derivative vanishes and of the two ends.
    fn compared(&self, flat: &[Expr], out: &mut Answer) -> Result<Expr, Refused> {
        let p = self.p;
        let ends = [self.end(false)?, self.end(true)?];
        let is_pole = |(x, open): &(Expr, bool)| {
            let there = BTreeMap::from([(p.clone(), x.clone())]);
            let mut divisors = divisors(self.f, p);
            let is_zero = |d: &Expr| {
                let seen = sign(&d.substitute(&there), self.domains);
                !matches!(seen, Seen::Proved(Sign::Positive | Sign::Negative))
            };
            *open && divisors.any(is_zero)
        };
        if let Some((end, _)) = ends.iter().flatten().find(|end| is_pole(end)) {
            let end = write_plain(end);
            return Err(self.refused(format!(
                "at {p} = {end}, which its range excludes, it divides by zero, and what it comes to near that is not compared"
            )));
        }
        let [Some(low), Some(high)] = ends else {
            let why = format!(
                "the derivative with respect to {p} vanishes where the value is not {}, and the interval does not end",
                self.which.word()
            );
            let hint = format!(
                "give {p} a \"domain\" with `min` and `max`: the ends are then compared too"
            );
            return Err(Refused::question(self.name, why, hint));
        };
        let flat = flat.iter().map(|x| (x.clone(), None));
        let places = flat.chain([low, high].map(|(x, open)| (x, Some(open))));
        let mut found: Vec<(Expr, Option<bool>, Expr)> = Vec::new();
        for (x, end) in places {
            let value = self.at(&x, self.f)?;
            found.push((x, end, value));
        }
        // How each value stands to the others.
        let above = |i: usize| -> Vec<Seen> {
            let others = found.iter().enumerate().filter(|(j, _)| *j != i);
            let over = |other: &Expr| sign(&self.which.merit(&(&found[i].2 - other)), self.domains);
            others.map(|(_, (.., other))| over(other)).collect()
        };
        let is_above = |s: &Seen| s.is_positive() || s.is_not_negative();
        let mut all = (0..found.len()).map(|i| (&found[i], above(i)));
        let best = all.find(|(_, above)| above.iter().all(is_above));
        let Some(((place, end, _), above)) = best else {
            return Err(self.refused(format!(
                "which of the values where the derivative with respect to {p} vanishes and at the ends is {} depends on the other parameters",
                self.which.word()
            )));
        };
        let words =
            "of the places where the derivative vanishes and the two ends it is {} there ({how})";
        let words = words.replace("{}", self.which.word());
        let is_proved = above.iter().all(|s| s.is_proved());
        out.checks
            .push(by_signs(self.which.kind(), &words, is_proved));
        if *end == Some(true) {
            let bound = self.bound(place, true);
            let best = self.which.word();
            out.text.push(sentence!("the {} value is {}", best, bound));
        }
        let others = found.iter().filter(|(x, ..)| x != place).zip(&above);
        let equal = others.filter(|(_, seen)| **seen == Seen::Proved(Sign::Zero));
        out.text.extend(equal.map(|((x, end, _), _)| match end {
            Some(true) => sentence!("as close to that it comes near {} = {}", p, x),
            _ => sentence!("it has the same value at {} = {}", p, x),
        }));
        Ok(place.clone())
    }
}

/// The same with what stands under roots tidied: at an end of the domain it is often a difference that vanishes, of which doubles
/// leave their rounding.
fn tidy_under_roots(e: &Expr, domains: &Domains) -> Expr {
    let e = e.map_parts(|part| tidy_under_roots(part, domains));
    match e.node() {
        Node::Power(base, k) if k.as_number().is_some_and(|k| !k.is_integer()) => {
            tidy(base, domains).map_or_else(|_| e.clone(), |base| base.power(k.clone()))
        }
        _ => e,
    }
}

/// What rises and falls with a formula: its square where that frees the parameter of roots, otherwise the formula.
fn of_square(f: &Expr, p: &Symbol, domains: &Domains) -> Expr {
    square(f, p, domains).unwrap_or_else(|| f.clone())
}

/// A divisor with the parameter in it that is not known to keep one sign.
fn pole(f: &Expr, p: &Symbol, domains: &Domains) -> Option<Expr> {
    let mut divisors = divisors(f, p);
    let changes = |base: &&Expr| {
        let seen = sign(base, domains);
        !seen.is_positive() && !seen.is_negative()
    };
    divisors.find(changes).cloned()
}

/// What the powers with negative exponents divide by, where the parameter stands in it.
fn divisors<'e>(f: &'e Expr, p: &'e Symbol) -> impl Iterator<Item = &'e Expr> {
    let all = f.parts().filter_map(Expr::divides_by);
    all.map(|(base, _)| base).filter(|base| base.mentions(p))
}

/// The exponent k for which the formula depends on p·qᵏ alone.
fn joint(of: &Expr, p: &Symbol, q: &Symbol, domains: &Domains) -> Option<Expr> {
    let weighted = |s: &Symbol| &Expr::symbol(s) * &of.derivative(s);
    let ratio = tidy(&(&weighted(q) / &weighted(p)), domains).ok()?;
    ratio.as_number()?;
    Some(ratio)
}

/// No place inside: the largest or least value is approached at an end.
fn at_the_rim(
    mut out: Answer,
    which: Extremum,
    slope: &Expr,
    words: &str,
    domains: &Domains,
) -> Answer {
    let s = sign(slope, domains);
    let how = match s.is_proved() {
        true => "proved",
        false => "seen at points",
    };
    let best = which.word();
    out.text.push(if !s.is_positive() && !s.is_negative() {
        sentence!("whether there is a {} value could not be decided", best)
    } else {
        let grows = match s.is_positive() {
            true => sentence!("it grows with {} throughout ({})", words, how),
            false => sentence!("it falls as {} grows ({})", words, how),
        };
        match s.is_positive() == (which == Extremum::Largest) {
            true => {
                let none = sentence!("there is no {} value: {}", best, grows);
                sentence!("{}, and the end, {} → ∞, is never reached", none, words)
            }
            false => {
                let none = sentence!("there is no {} value inside: {}", best, grows);
                sentence!(
                    "{}, so it is approached as {} → 0 and not reached there",
                    none,
                    words
                )
            }
        }
    });
    out
}
