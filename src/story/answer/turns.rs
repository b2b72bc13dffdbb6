//! The turn of any number n of a repeated group, in closed form, by induction.
//!
//! In: the stages of the turns that the file writes out. Out: the answer. What is handed on from turn to turn is guessed from
//! those turns, as a + c rⁿ or a + c n; the guess proves nothing. It is proved by telling one turn that begins with the state
//! guessed for n − 1: where that turn ends with the state guessed for n, and the first turn ends with the one for 1, every
//! turn does. What is asked is then read off that turn.

use std::collections::BTreeSet;

use num_integer::Integer;

use super::{put, rests_on, supposed, unanswered, ways};
use crate::algebra::Sign;
use crate::answer::calc::{Seen, at_least_zero, is_zero, keeps_to, sign, tidy};
use crate::answer::{Answer, Check, Form, Refused, dimension_of};
use crate::domain::Domains;
use crate::expr::{Expr, Node, Symbol};
use crate::formula::{Sentence, sentence, write_plain};
use crate::scene::{Question, Scene, Turns};
use crate::story::{StageTold, State, through};

const NO_LAW: &str =
    "what one turn hands on to the next grows neither by a constant nor by a constant factor";

/// Longest ratio of one turn to the one before that is taken for a law, in nodes.
const LONGEST_RATIO: usize = 60;

/// What is asked of the turns.
struct Asked<'a> {
    scene: &'a Scene,
    /// The number of the turn.
    number: &'a Symbol,
    turns: &'a Turns,
    /// The formula in the answers of each turn that is written out.
    of: &'a [Expr],
    /// Summed up.
    total: bool,
}

/// The answer for turn n.
pub(super) fn answer(
    scene: &Scene,
    stages: &[StageTold],
    question: &Question,
    (number, turns, of, total): (&Symbol, &Turns, &[Expr], bool),
) -> Result<Answer, Refused> {
    let (scene, given) = &without_zero(scene);
    let asked = Asked {
        scene,
        number,
        turns,
        of,
        total,
    };
    match asked.found(stages, question)? {
        Ok(mut answer) => {
            let stands = |symbol: &&Symbol| answer.formula().is_some_and(|f| f.mentions(symbol));
            let needed = given.iter().filter(stands);
            let needed: Vec<Sentence> = needed.map(|s| sentence!("{} > 0", s)).collect();
            answer.assumptions.extend(needed);
            Ok(answer)
        }
        Err(why) => Ok(unanswered(question, &why)),
    }
}

/// The scene where what may be zero or more is more, and what that was: powers are taken of it. With a restitution of zero there
/// is no second bounce.
fn without_zero(scene: &Scene) -> (Scene, BTreeSet<Symbol>) {
    let (mut scene, mut changed) = (scene.clone(), BTreeSet::new());
    let stages = scene
        .stages
        .iter_mut()
        .map(|stage| &mut stage.scene.domains);
    for domains in stages.chain([&mut scene.domains]) {
        for (symbol, domain) in &mut domains.symbols {
            if domain.leave_out(0) {
                changed.insert(symbol.clone());
            }
        }
    }
    (scene, changed)
}

impl Asked<'_> {
    /// The answer, or why there is none.
    fn found(
        &self,
        stages: &[StageTold],
        question: &Question,
    ) -> Result<Result<Answer, Sentence>, Refused> {
        let (scene, turns) = (self.scene, self.turns);
        let open = |why: &str| Ok(Err(Sentence::words(why)));
        let last = turns.turn(turns.times).end;
        let Some(line) = single(scene, stages, turns.first..last) else {
            return open("the turns may go in several ways, and none of them stands for all");
        };
        let ends = (1..=turns.times).map(|k| &stages[line[k * turns.stages - 1]].after);
        let states: Vec<&State> = [&stages[line[0]].before].into_iter().chain(ends).collect();
        let general = match general(&states, self.number, &scene.domains) {
            Ok(general) => general,
            Err(why) => return Ok(Err(why)),
        };
        let at = |n: &Expr| changed(&general, |e| e.put(self.number, n));
        let before = &Expr::symbol(self.number) - &Expr::one();
        let one = scene.turn(turns);
        let told = match through(&one, Some(&at(&before))) {
            Ok(told) if told.ended.is_empty() => told.stages,
            _ => return open("a turn that begins as those before suggest is not worked out"),
        };
        let Some(mine) = single(&one, &told, 0..turns.stages) else {
            return open("what happens in a turn depends on its number");
        };
        let end = &told[mine[mine.len() - 1]].after;
        let mut after = states.iter().enumerate().skip(1);
        // Where the motions of a turn come to their ends.
        let needs = mine.iter().flat_map(|i| &told[*i].needs);
        let within = needs.fold(one.domains.clone(), |all, need| all.given(need, false));
        let is_so = is_same(&one, [end, &general], &within)
            && after.all(|(k, state)| is_same(scene, [state, &at(&count(k))], &scene.domains));
        if !is_so {
            return open(NO_LAW);
        }
        let told_value = match put(&one, &told, Some((mine[mine.len() - 1], 0)), &self.of[0])? {
            Ok(value) => value,
            Err(why) => return open(&why),
        };
        let mut written = Vec::new();
        for (k, formula) in self.of.iter().enumerate() {
            let end = line[(k + 1) * turns.stages - 1];
            match put(scene, stages, Some((end, 0)), formula)? {
                Ok(value) => written.push(value),
                Err(why) => return open(&why),
            }
        }
        let is_told = |(k, value): (usize, &Expr)| {
            let told = told_value.put(self.number, &count(k + 1));
            is_zero(&(&told - value), &scene.domains) == Some(true)
        };
        if !written.iter().enumerate().all(is_told) {
            return open("the turns that are written out are not alike in what is asked");
        }
        let Some(law) = self.law(&written, &told_value) else {
            return open("its sum over the turns has no closed form that was found");
        };
        let mut out = Answer::blank(question, &question.name, self.words());
        out.text = self.reasons(&Symbol::from(question.name.as_str()), &general, &law);
        out.dimension = dimension_of(scene, &law.value, &question.name)?;
        out.assumptions = law.given.into_iter().collect();
        for i in mine {
            granted(&told[i], &one.domains, &mut out.assumptions);
            let conditions = told[i].cases.iter().flat_map(|case| &case.conditions);
            let needed = told[i].needs.iter().chain(conditions.map(|(_, e)| e));
            let needed = needed.map(|need| (law.value.clone(), need.clone(), true));
            out.needs.extend(needed);
        }
        out.form = Form::value(law.value);
        let words =
            "by induction: the first turn begins so, and each hands on what the next begins with";
        out.checks.push(Check::new("identity", words, Some(true)));
        Ok(Ok(out))
    }

    /// What is asked, in words.
    fn words(&self) -> String {
        let [first, second, ..] = self.of else {
            return String::new();
        };
        let [first, second] = [first, second].map(write_plain);
        let n = self.number;
        match self.total {
            true => format!("{first} + {second} + … up to turn {n}"),
            false => format!("{first}, {second}, …, in turn {n}"),
        }
    }

    /// The term of the sequence that is asked for, as a person writes it; or as the turn gives it.
    fn law(&self, written: &[Expr], told: &Expr) -> Option<Law> {
        let domains = &self.scene.domains;
        let n = Expr::symbol(self.number);
        let is = |e: &Expr| is_zero(e, domains) == Some(true);
        if self.total {
            let mut sums = vec![Expr::zero()];
            for term in written {
                sums.push(&sums[sums.len() - 1] + term);
            }
            let law = law(&sums, self.number, domains).ok()?;
            let before = law.value.put(self.number, &(&n - &Expr::one()));
            let starts = law.value.put(self.number, &Expr::zero());
            return (is(&(&law.value - &(&before + told))) && is(&starts)).then_some(law);
        }
        let fitted = preceded(written, domains).and_then(|a| law(&a, self.number, domains).ok());
        let fitted = fitted.filter(|law| is(&(&law.value - told)));
        fitted.or_else(|| {
            let value = tidy(told, domains).ok()?;
            Some(Law {
                value,
                by: By::Nothing,
                given: None,
            })
        })
    }

    /// Why it is so for every turn, and how it goes on from one to the next.
    fn reasons(&self, name: &Symbol, general: &State, law: &Law) -> Vec<Sentence> {
        let n = Expr::symbol(self.number);
        let before = &n - &Expr::one();
        let [places, motion] = self.named_parts(general).map(|mut parts| {
            parts.retain(|(_, part)| part.mentions(self.number));
            parts
        });
        // Where it is follows from how it moves.
        let told = if motion.is_empty() { places } else { motion };
        let moves = told.into_iter();
        let moves =
            moves.map(|(lead, part)| sentence!("{}{}", lead, &part.put(self.number, &before)));
        let moves: Vec<Sentence> = moves.collect();
        let mut out = Vec::new();
        if !moves.is_empty() {
            let moves = Sentence::list(&moves);
            out.push(sentence!("suppose that, as turn {} begins, {}", &n, moves));
            let next = &n + &Expr::one();
            out.push(sentence!("the equations of the first turn then give the same at its end, with {} in place of {}, so turn {} begins as supposed; turn 1 does, and hence every turn", &n, &before, &next));
        } else {
            out.push(Sentence::words("every turn begins as the first does"));
        }
        out.extend(match &law.by {
            By::Factor(ratio) => Some(sentence!("each turn multiplies {} by {}", name, ratio)),
            By::Step(step) => Some(sentence!("each turn adds {} to {}", step, name)),
            By::Sum(ratio) => Some(match self.total {
                true => sentence!(
                    "{} is the sum over {} turns; each turn adds {} times what the one before adds: a geometric series",
                    name,
                    &n,
                    ratio
                ),
                false => sentence!(
                    "each turn adds {} times what the one before adds: a geometric series",
                    ratio
                ),
            }),
            By::Nothing => None,
        });
        out
    }

    /// Where a state has the bodies, and how they move, with the words for it.
    fn named_parts<'s>(&self, state: &'s State) -> [Vec<(String, &'s Expr)>; 2] {
        let mut out = [Vec::new(), Vec::new()];
        for (b, body) in self.scene.bodies.iter().enumerate() {
            let name = &body.name;
            for (k, axis) in ["x", "y"].into_iter().enumerate() {
                let place = format!("`{name}` is at {axis} = ");
                out[0].push((place, &state.center[b][k]));
                let velocity = format!("the velocity of `{name}` along {axis} is ");
                out[1].push((velocity, &state.velocity[b][k]));
            }
            out[0].push((format!("the angle of `{name}` is "), &state.angle[b]));
            out[1].push((format!("the spin of `{name}` is "), &state.spin[b]));
        }
        out
    }
}

fn count(turns: usize) -> Expr {
    Expr::from(turns as i64)
}

/// How a sequence goes on.
enum By {
    /// It stays, or no short form was found.
    Nothing,
    /// Each term is the one before times this.
    Factor(Expr),
    /// Each term is the one before and this.
    Step(Expr),
    /// Each difference is the one before times this.
    Sum(Expr),
}

/// The terms of a sequence.
struct Law {
    /// Term n.
    value: Expr,
    by: By,
    /// What must not vanish for it.
    given: Option<Sentence>,
}

/// The law of a sequence by its terms from 0 on, at least three, if it or that of the squares is one of those known here:
/// friction takes the same from v² each time.
fn law(terms: &[Expr], number: &Symbol, domains: &Domains) -> Result<Law, Sentence> {
    let plain = plain_law(terms, number, domains);
    let is_short = |law: &Law| !matches!(&law.by, By::Sum(ratio) if ratio.has_root());
    if plain.as_ref().is_ok_and(is_short) {
        return plain;
    }
    let is_on = |side: bool| {
        let mut all = terms.iter();
        all.all(|term| sign(term, domains).side() == Some(side))
    };
    if let Some(squares) = without_roots(terms, domains)
        && let Ok(law) = plain_law(&squares, number, domains)
        && (is_on(true) || is_on(false))
    {
        let root = law.value.sqrt();
        return Ok(Law {
            value: if is_on(true) { root } else { -root },
            by: By::Nothing,
            given: law.given,
        });
    }
    plain
}

/// The squares, where none of them has a root.
fn without_roots(terms: &[Expr], domains: &Domains) -> Option<Vec<Expr>> {
    let squares = terms.iter().map(|term| tidy(&term.powi(2), domains).ok());
    squares
        .map(|square| square.filter(|e| !e.has_root()))
        .collect()
}

fn plain_law(terms: &[Expr], number: &Symbol, domains: &Domains) -> Result<Law, Sentence> {
    let n = Expr::symbol(number);
    let no_law = || Sentence::words(NO_LAW);
    let is = |e: &Expr| is_zero(e, domains) == Some(true);
    let tidied = |e: Expr| tidy(&e, domains).map_err(|_| no_law());
    let steps = terms.windows(2).map(|pair| &pair[1] - &pair[0]);
    let steps: Vec<Expr> = steps.collect();
    let ([first, second, ..], [step, next, ..]) = (terms, steps.as_slice()) else {
        return Err(no_law());
    };
    if steps.iter().all(is) {
        return Ok(Law {
            value: first.clone(),
            by: By::Nothing,
            given: None,
        });
    }
    let goes_on = |ratio: &Expr| {
        let mut pairs = steps.windows(2);
        pairs.all(|pair| is(&(&pair[1] - &(ratio * &pair[0]))))
    };
    if goes_on(&Expr::one()) {
        let step = step.clone();
        let step = tidied(step)?;
        return Ok(Law {
            value: first + &(&n * &step),
            by: By::Step(step),
            given: None,
        });
    }
    let is_positive = |e: &Expr| sign(e, domains) == Seen::Proved(Sign::Positive);
    let doubtful = |ratio: &Expr| {
        sentence!(
            "its powers are taken of what is positive, and {} is not known to be",
            ratio
        )
    };
    if !is(first) {
        let ratio = tidied(second / first)?;
        let mut pairs = terms.windows(2);
        if pairs.all(|pair| is(&(&pair[1] - &(&ratio * &pair[0])))) {
            if !is_positive(&ratio) {
                return Err(doubtful(&ratio));
            }
            return Ok(Law {
                value: &tidied(first.clone())? * &raised(&ratio, &n, domains),
                by: By::Factor(ratio),
                given: None,
            });
        }
    }
    if is(step) {
        return Err(no_law());
    }
    let ratio = tidied(next / step)?;
    // Any three terms go on so with some ratio; a law has a short one.
    if !goes_on(&ratio) || ratio.size() > LONGEST_RATIO {
        return Err(no_law());
    }
    if !is_positive(&ratio) {
        return Err(doubtful(&ratio));
    }
    let gap = &Expr::one() - &ratio;
    let given = match is_positive(&gap) || is_positive(&-&gap) {
        true => None,
        false => Some(sentence!("{} ≠ 1", &ratio)),
    };
    // Of what gets less from turn to turn the loss is told.
    let falls = sign(step, domains).is_negative() == is_positive(&gap);
    let sign_of_step = Expr::from(if falls { -1 } else { 1 });
    let factor = &tidied(&(step * &sign_of_step) / &gap)? * &sign_of_step;
    let whole = tidied(first + &factor)?;
    // a + c (1 − rⁿ) may be a multiple of 1 − rⁿ⁺¹.
    let later = (0..=1).find(|j| is(&(&(&whole * &ratio.powi(*j)) - &factor)));
    let (from, parts, turns) = match later {
        Some(j) => (Expr::zero(), whole, &n + &Expr::from(j)),
        None => (first.clone(), factor, n),
    };
    let (one, power) = (Expr::one(), raised(&ratio, &turns, domains));
    // Powers of what is more than one are more than one.
    let value = match is_positive(&-&gap) {
        true => from + -&parts * (power - one),
        false => from + parts * (one - power),
    };
    Ok(Law {
        value,
        by: By::Sum(ratio),
        given,
    })
}

/// A power of what is positive, which may be a power itself or the root of something without roots.
fn raised(ratio: &Expr, exponent: &Expr, domains: &Domains) -> Expr {
    let times = |k: &Expr| {
        Expr::sum(match exponent.node() {
            Node::Sum(terms) => terms.iter().map(|term| k * term).collect(),
            _ => vec![k * exponent],
        })
    };
    if let Some((base, k)) = common_power(ratio, domains) {
        return base.power(times(&Expr::from(k)));
    }
    match ratio.node() {
        Node::Power(base, k) if k.as_number().is_some() => base.power(times(k)),
        _ if ratio.has_root() => match tidy(&ratio.powi(2), domains) {
            Ok(square) if !square.has_root() => square.power(times(&Expr::ratio(1, 2))),
            _ => ratio.power(exponent.clone()),
        },
        _ => ratio.power(exponent.clone()),
    }
}

/// What is positive and of which a product is a whole power above the first: a²/(a + b)² is the square of a/(a + b).
fn common_power(product: &Expr, domains: &Domains) -> Option<(Expr, i64)> {
    let Node::Product(factors) = product.node() else {
        return None;
    };
    let parts = factors.iter().map(|factor| match factor.node() {
        Node::Power(base, k) => {
            let k = k.as_number().filter(|k| k.is_integer())?;
            Some((base.clone(), k.numer().as_i64()?))
        }
        _ => Some((factor.clone(), 1)),
    });
    let parts = parts.collect::<Option<Vec<(Expr, i64)>>>()?;
    let k = parts.iter().fold(0, |all: i64, (_, k)| all.gcd(k));
    let bases = parts.iter().map(|(base, each)| base.powi(each / k.max(1)));
    let base = Expr::product(bases.collect::<Vec<_>>());
    let is_positive = sign(&base, domains) == Seen::Proved(Sign::Positive);
    (k > 1 && is_positive).then_some((base, k))
}

/// A sequence from its term 0 on, of which the terms from 1 on are known.
fn preceded(terms: &[Expr], domains: &Domains) -> Option<Vec<Expr>> {
    let [first, second, ..] = terms else {
        return None;
    };
    let step = second - first;
    let is = |e: &Expr| is_zero(e, domains) == Some(true);
    let before = match terms.get(2) {
        _ if is(&step) => first.clone(),
        Some(third) => first - &(&step.powi(2) / &(third - second)),
        None => &first.powi(2) / second,
    };
    let before = tidy(&before, domains).ok()?;
    Some([before].into_iter().chain(terms.iter().cloned()).collect())
}

/// The stages of a range, by index among those told, where each happens in one way.
fn single(
    scene: &Scene,
    stages: &[StageTold],
    range: std::ops::Range<usize>,
) -> Option<Vec<usize>> {
    let each = range.map(|i| match ways(stages, &scene.stages[i])[..] {
        [(at, told, _)] if told.cases.len() < 2 => Some(at),
        _ => None,
    });
    each.collect()
}

/// The state after turn n, guessed from those before the first turn and after each.
fn general(states: &[&State], number: &Symbol, domains: &Domains) -> Result<State, Sentence> {
    let [first, second, ..] = states else {
        return Err(Sentence::words(NO_LAW));
    };
    if let Some(why) = states.iter().find_map(|s| s.open.values().next()) {
        return Err(why.as_str().into());
    }
    let terms = |i: usize| -> Vec<Expr> { states.iter().map(|s| parts(s)[i].clone()).collect() };
    let laws = (0..parts(first).len()).map(|i| law(&terms(i), number, domains));
    let laws: Vec<Result<Law, Sentence>> = laws.collect();
    let mut ratios: Vec<Expr> = Vec::new();
    for law in laws.iter().flatten() {
        if let By::Factor(ratio) | By::Sum(ratio) = &law.by
            && !ratios.contains(ratio)
        {
            ratios.push(ratio.clone());
        }
    }
    let mut fault = None;
    let mut next = laws.into_iter().enumerate();
    let out = changed(first, |a| match next.next() {
        Some((_, Ok(law))) => law.value,
        Some((i, Err(why))) => by_two(&terms(i), &ratios, number, domains).unwrap_or_else(|| {
            fault.get_or_insert(why);
            a.clone()
        }),
        None => a.clone(),
    });
    let part = second.part.clone();
    fault.map_or(Ok(State { part, ..out }), Err)
}

/// A sequence a + p rⁿ + q sⁿ by its terms from 0 on, r and s among some ratios and their products: a ball that is slowed by
/// friction at every bounce flies on for shorter and shorter.
fn by_two(terms: &[Expr], ratios: &[Expr], number: &Symbol, domains: &Domains) -> Option<Expr> {
    let [first, second, third, fourth, ..] = terms else {
        return None;
    };
    let n = Expr::symbol(number);
    let steps = [second - first, third - second, fourth - third];
    let products = ratios
        .iter()
        .flat_map(|r| ratios.iter().map(move |s| r * s));
    let products = products.filter_map(|e| tidy(&e, domains).ok());
    let mut all = ratios.to_vec();
    for product in products.collect::<Vec<_>>() {
        if !all.contains(&product) {
            all.push(product);
        }
    }
    let pairs = all.iter().enumerate();
    let mut pairs = pairs.flat_map(|(i, r)| all[i + 1..].iter().map(move |s| (r, s)));
    pairs.find_map(|(r, s)| {
        let p = tidy(&(&(&steps[1] - &(s * &steps[0])) / &(r - s)), domains).ok()?;
        let q = tidy(&(&steps[0] - &p), domains).ok()?;
        let third = &(&p * &r.powi(2)) + &(&q * &s.powi(2));
        (is_zero(&(&steps[2] - &third), domains) == Some(true)).then(|| {
            let sum = |p: &Expr, r: &Expr| {
                let one = Expr::one();
                p * &(&(&one - &raised(r, &n, domains)) / &(&one - r))
            };
            Expr::sum([first.clone(), sum(&p, r), sum(&q, s)])
        })
    })
}

/// Everything that says where bodies are and how they move.
fn parts(state: &State) -> Vec<&Expr> {
    let vectors = state.center.iter().chain(&state.velocity).flatten();
    vectors.chain(&state.angle).chain(&state.spin).collect()
}

/// The same state with each of its [`parts`] changed, in their order.
fn changed(state: &State, mut put: impl FnMut(&Expr) -> Expr) -> State {
    let mut out = state.clone();
    let vectors = out.center.iter_mut().chain(&mut out.velocity).flatten();
    for part in vectors.chain(&mut out.angle).chain(&mut out.spin) {
        *part = put(part);
    }
    out
}

/// Whether two states are the same for all values of what stands in them, however a particle has turned.
fn is_same(scene: &Scene, [a, b]: [&State; 2], domains: &Domains) -> bool {
    let mut a = a.clone();
    for (i, _) in scene
        .bodies
        .iter()
        .enumerate()
        .filter(|(_, body)| body.is_particle())
    {
        a.angle[i].clone_from(&b.angle[i]);
    }
    let mut pairs = parts(&a).into_iter().zip(parts(b));
    a.part == b.part && pairs.all(|(a, b)| is_zero(&(a - b), domains) == Some(true))
}

/// What a stage of a turn rests on, without what holds on the domain.
fn granted(told: &StageTold, domains: &Domains, out: &mut Vec<Sentence>) {
    let needs = told.needs.iter().map(|need| at_least_zero(need, domains));
    let cases = told.cases.iter().flat_map(rests_on);
    let given = told.given.iter().map(supposed);
    let all = told.assumptions.iter().cloned();
    for one in all.chain(needs).chain(cases).chain(given) {
        let holds = |(e, open): (Expr, bool)| keeps_to(&e, !open, domains) == Some(true);
        let is_sure = one.stated().next().is_some() && one.stated().all(holds);
        // The same may be told with its reason.
        let words = one.to_string();
        let is_told = out
            .iter()
            .any(|known| known.to_string().starts_with(&words));
        if !is_sure && !is_told {
            out.push(one);
        }
    }
}
