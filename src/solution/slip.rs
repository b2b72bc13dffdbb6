//! Where along its impulse a rough contact stops sliding and where compression ends: what tells the cases of friction apart.
//!
//! In: how the contact moves under an impulse, and what friction is decided to do. Out: the normal impulses at which slip and
//! compression would end, and each condition in terms of them (Routh; Wang and Mason 1992).

use std::collections::BTreeSet;

use super::impulse::Motion;
use super::words::{self, fill, say};
use super::{Claim, Inline, Line, Math, Meaning, Part, Solution, Writer};
use crate::algebra::Sign;
use crate::expr::{Expr, Function, Symbol};
use crate::scene::{Decided, Hypothesis, Mode};

/// Indices of the normal impulses at which slip and compression end.
const SLIP_ENDS: &str = "slip";
const COMPRESSED: &str = "comp";

impl Solution {
    /// The names of the normal impulses at which compression would end in sliding.
    pub(super) fn ends_of_sliding(&self) -> impl Iterator<Item = Symbol> {
        let named = self.steps.iter().filter_map(|step| step.defines.clone());
        named.filter(|name| {
            name.split_once('_')
                .is_some_and(|(_, end)| end == COMPRESSED)
        })
    }
}

/// Largest value, in nodes, that is written for an impulse.
const LONG: usize = 60;

/// How a rough contact moves under its impulse, as it stands on the page.
#[derive(Clone)]
pub(super) struct Rough {
    pub motion: Motion,
    /// Sliding, one for each direction in which it may slide before; none where it does not slip.
    pub slides: Vec<Sliding>,
    /// What it took to tell that, which the cases need not tell again.
    pub told: BTreeSet<Symbol>,
}

/// A contact that slides in one direction.
#[derive(Clone)]
pub(super) struct Sliding {
    /// Along its tangent, 1, or against it, −1; `None` where it is the same either way.
    pub direction: Option<i64>,
    /// The normal impulse at which the slip would end; `None` where it never does.
    pub slip_ends: Option<Expr>,
    /// That at which compression would end.
    pub compressed: Expr,
}

impl Sliding {
    /// The impulse at which a mode ends, or begins to stick or to slip the other way, among those of sliding.
    pub(super) fn condition(&self, mode: Mode, e: &Expr, strict: bool) -> Option<Vec<Math>> {
        // Where both end together, when the slip ends tells no cases apart.
        if self.slip_ends.as_ref() == Some(&self.compressed) {
            return None;
        }
        let [slip, compressed] =
            [self.slip_ends.as_ref()?, &self.compressed].map(|e| vec![e.into()]);
        let whole = self.whole(e);
        let below = if strict { "<" } else { "≤" };
        let chain = |all: Vec<Vec<Math>>, signs: &[&'static str]| {
            let signs = signs
                .iter()
                .map(|sign| vec![Math::Op(sign)])
                .chain([Vec::new()]);
            let each = all.into_iter().zip(signs);
            each.flat_map(|(e, sign)| [e, sign].concat()).collect()
        };
        Some(match mode {
            Mode::Slides => chain(vec![whole, slip], &["≤"]),
            Mode::SticksInCompression | Mode::ReversesInCompression => {
                chain(vec![slip, compressed], &[below])
            }
            Mode::SticksInRestitution | Mode::ReversesInRestitution => {
                chain(vec![compressed, slip, whole], &["≤", below])
            }
            Mode::Sticks => chain(vec![slip, whole], &[below]),
            _ => return None,
        })
    }

    /// The normal impulse at which restitution would end.
    fn whole(&self, e: &Expr) -> Vec<Math> {
        let factor = Expr::one() + e;
        match factor.as_number() {
            Some(_) => vec![(factor * &self.compressed).into()],
            None => vec![Math::Factor(factor), (&self.compressed).into()],
        }
    }

    /// Where restitution would end, for a mode that this is held against.
    pub(super) fn ending(&self, modes: &[Mode], e: &Expr) -> Vec<Inline> {
        let in_compression = |mode: &Mode| {
            matches!(
                mode,
                Mode::SticksInCompression | Mode::ReversesInCompression
            )
        };
        if e.is_zero() || modes.iter().all(in_compression) {
            return Vec::new();
        }
        fill(
            "Restitution would end at {}. ",
            [Inline::Math(self.whole(e))],
        )
    }
}

impl Rough {
    /// The sliding that a case begins with.
    pub(super) fn of(&self, decided: &Decided) -> Option<&Sliding> {
        let own = |s: &&Sliding| s.direction == decided.slip || s.direction.is_none();
        self.slides.iter().find(own)
    }
}

impl Writer<'_> {
    /// Tells how the rough contact moves under an impulse and where its slip and its compression end, if the laws of these cases
    /// or their conditions rest on that.
    pub(super) fn yields(&mut self, contact: usize, cases: &[&Decided], has_conditions: bool) {
        let rests = |c: &Decided| {
            let mut words = c.conditions.iter().map(|c| c.words);
            words.any(|w| {
                w.starts_with("normal impulse") || w.contains("reversal") || w.contains("by energy")
            })
        };
        let Some(first) = cases.first().copied() else {
            return;
        };
        let outright = matches!(first.law.hypothesis, Hypothesis::ChatterjeeRuina { .. });
        let is_followed = first.law.hypothesis.has_path() || outright;
        let needed = has_conditions || cases.iter().any(|c| rests(c));
        if !is_followed || !needed || first.space.is_held() {
            return;
        }
        let Some(motion) = self.motion_under_impulse(contact, first) else {
            return;
        };
        let mut rough = Rough {
            motion,
            slides: Vec::new(),
            told: BTreeSet::new(),
        };
        if outright {
            self.stopping(&rough.motion);
        } else if self.vanishes(&first.space.tangential) {
            self.held_from_the_start(&rough.motion, first);
        } else {
            let mut directions: Vec<Option<i64>> = cases.iter().map(|c| c.slip).collect();
            let straight = first.space.b.is_zero();
            if directions.contains(&None)
                || straight && directions.iter().any(|d| *d != directions[0])
            {
                directions = if straight {
                    vec![None]
                } else {
                    vec![Some(1), Some(-1)]
                };
            }
            directions.sort_unstable();
            directions.dedup();
            directions.reverse();
            let several = directions.len() > 1;
            for direction in directions {
                let sliding = self.slides(&rough.motion, first, (direction, several));
                self.cases_of(&sliding, cases);
                rough.slides.push(sliding);
            }
            self.after_slip(&rough.motion, cases);
        }
        rough.told.clone_from(&self.told);
        self.rough = Some(rough);
    }

    /// Goes on with what stands there of the motion of the rough contact.
    pub(super) fn goes_on_with(&mut self, rough: Option<Rough>) {
        self.told
            .extend(rough.iter().flat_map(|rough| rough.told.clone()));
        self.rough = rough;
    }

    /// Sliding in one direction, or in either where that is the same: where its slip and its compression would end.
    fn slides(
        &mut self,
        motion: &Motion,
        decided: &Decided,
        (direction, several): (Option<i64>, bool),
    ) -> Sliding {
        let at = words::place(&self.scene.contacts[motion.contact].name, "contact");
        let mu = &decided.law.mu;
        let [t, n] = motion.sense;
        let slip = Expr::from(direction.unwrap_or(1) * t) * &motion.before[0];
        let slip = match direction {
            Some(_) => self.tidy(&slip),
            None => self.size(&slip),
        };
        let approach = self.tidy(&(Expr::from(-n) * &motion.before[1]));
        // By how much a unit of the normal impulse lessens either.
        let across = Expr::from(t * n * direction.unwrap_or(0));
        let rates = |[a, b, c]: &[Expr; 3]| [mu * a - &across * b, c - mu * &across * b];
        let (values, written) = (rates(&motion.values), rates(&motion.written));
        let signs = values.each_ref().map(|e| self.sign(e));
        let never = signs[0].is_some_and(|s| !s.is_not_negative() || s == Sign::Zero);
        let names = self.free(&["P", "Q"], |letter| {
            [SLIP_ENDS, COMPRESSED].map(|end| format!("{letter}_{end}"))
        });
        let [end, compressed] = names.each_ref().map(|name| Expr::symbol(name));
        let mut text = match direction {
            Some(direction) => {
                let ratio = Expr::from(-direction * t * n) * mu;
                let friction = ratio * &motion.impulse[1];
                let friction = words::equation(&motion.impulse[0], &friction);
                let (lead, so) = if several {
                    ("Where ", ", ")
                } else {
                    ("", ": ")
                };
                let lead = vec![say(format!("{lead}{at} slides "))];
                let parts = [say(so), friction];
                let law = fill(" at first{}{}.", parts);
                [lead, way(motion, direction), law].concat()
            }
            None => fill(
                "While {} slides, friction is {} times the normal impulse, against the slip.",
                [say(at), words::formula(mu)],
            ),
        };
        let zero = |v: &Expr| words::equation(v, &Expr::zero());
        let parts = [
            zero(&motion.velocity[0]),
            words::formula(&end),
            zero(&motion.velocity[1]),
            words::formula(&compressed),
        ];
        let [a, b, c] = &motion.values;
        // A contact that can move in one way only stops sliding when it stops approaching.
        let together = self.vanishes(&(a * c - b * b));
        let alone = usize::from(never || together);
        text.extend(match (never, together) {
            (true, _) => fill(
                " Its slip does not end; compression would end, {}, at the normal impulse {}",
                parts.into_iter().skip(2),
            ),
            (_, true) => fill(
                " Sliding on, its slip and compression would end together, {}, at the normal impulse {}",
                parts.into_iter().skip(2),
            ),
            (false, false) => fill(
                " Sliding on, its slip would end, {}, at the normal impulse {}, and compression, {}, at {}",
                parts,
            ),
        });
        let is_open = |sign: &Option<Sign>| *sign != Some(Sign::Positive);
        let open = match signs.iter().skip(alone).any(is_open) {
            true if alone == 0 => " (infinite where a denominator is not positive):",
            true => " (infinite where its denominator is not positive):",
            false => ":",
        };
        text.push(say(open));
        self.text(text);
        let mut lines = Vec::new();
        for (i, above) in [slip, approach].into_iter().enumerate().skip(alone) {
            let value = self.tidy(&(&above / &values[i]));
            let quotient = &above / &written[i];
            lines.push(self.end_of(&names[i], quotient, value));
        }
        self.push(Part::Display(lines));
        Sliding {
            direction,
            slip_ends: match together {
                true => Some(compressed.clone()),
                false => (!never).then_some(end),
            },
            compressed,
        }
    }

    /// The normal impulse at which something ends, with the coefficients as they are written and put in.
    fn end_of(&mut self, name: &Symbol, quotient: Expr, value: Expr) -> Line {
        self.names_only(
            name,
            value.clone(),
            "a normal impulse at which sliding ends",
        );
        let symbol = Expr::symbol(name);
        let mut math = words::related(&symbol, "=", &quotient);
        if !self.has_names(&quotient) {
            math = words::related(&symbol, "=", &value);
        } else if value.size() <= LONG {
            math.extend([Math::Op("="), value.into()]);
        }
        let claim = Claim::new(symbol, quotient);
        let step = self.step(Vec::new(), vec![claim], "the velocity that vanishes there");
        Line {
            math,
            step: Some(step),
        }
    }

    /// Whether a formula holds names that the solution gives.
    fn has_names(&self, e: &Expr) -> bool {
        let mut symbols = e.symbols().into_iter();
        symbols.any(|name| self.solution.meanings.get(&name) == Some(&Meaning::Defined))
    }

    /// |x|, without the bars where the sign is known.
    fn size(&mut self, x: &Expr) -> Expr {
        let x = self.tidy(x);
        match self.sign(&x) {
            Some(sign) if sign.is_not_negative() => x,
            Some(_) => self.tidy(&-x),
            None => self.tidy(&Expr::call(Function::Abs, x)),
        }
    }

    /// In which cases a contact that slides in one direction at first does what.
    fn cases_of(&mut self, sliding: &Sliding, cases: &[&Decided]) {
        let direction = sliding.direction;
        let own = cases
            .iter()
            .filter(|c| direction.is_none() || c.slip.is_none() || c.slip == direction);
        let modes: Vec<Mode> = own.map(|c| c.mode).collect();
        let e = &cases[0].law.restitution;
        let kinds = [
            (Mode::Slides, Mode::Slides, "slides to the end where {}"),
            (
                Mode::SticksInRestitution,
                Mode::ReversesInRestitution,
                "stops sliding in restitution where {}",
            ),
            (
                Mode::SticksInCompression,
                Mode::ReversesInCompression,
                "stops sliding in compression where {}",
            ),
            (Mode::Sticks, Mode::Sticks, "stops sliding where {}"),
        ];
        let parts = kinds.iter().filter_map(|(one, other, does)| {
            let math = sliding.condition(*one, e, false)?;
            let happens = modes.contains(one) || modes.contains(other);
            happens.then(|| fill(does, [Inline::Math(math)]))
        });
        let parts: Vec<Vec<Inline>> = parts.collect();
        if cases.len() < 2 || parts.is_empty() {
            return;
        }
        let mut text = sliding.ending(&modes, e);
        text.push(say("The conditions of the cases say that it "));
        let last = parts.len() - 1;
        for (i, part) in parts.into_iter().enumerate() {
            text.extend((i > 0).then(|| say(if i == last { ", and " } else { ", " })));
            text.extend(part);
        }
        text.push(say("."));
        self.text(text);
    }

    /// What follows once slip has ended: friction holds the contact, or its slip is reversed.
    fn after_slip(&mut self, motion: &Motion, cases: &[&Decided]) {
        let reverses = |c: &&Decided| {
            matches!(
                c.mode,
                Mode::ReversesInCompression | Mode::ReversesInRestitution
            )
        };
        if cases.iter().any(reverses) {
            self.holding(
                motion,
                cases[0],
                ("Once its slip has ended", "it slides the other way"),
            );
        }
    }

    /// A contact that does not slip before: whether friction keeps it so.
    fn held_from_the_start(&mut self, motion: &Motion, decided: &Decided) {
        let at = words::place(&self.scene.contacts[motion.contact].name, "contact");
        match motion.values[1].is_zero() {
            true => self.say(&format!(
                "{} does not slip before, and no normal impulse drives it to.",
                words::capital(&at)
            )),
            false => self.holding(
                motion,
                decided,
                (
                    &format!("As {at} does not slip before"),
                    "it slides from the start",
                ),
            ),
        }
    }

    /// Stronge: the work of the normal impulse in compression, where slip ends on the way; gives the normal velocity that
    /// remains where restitution gives back its share.
    pub(super) fn work(&mut self, decided: &Decided) -> Option<Expr> {
        let rough = self.rough.clone()?;
        let (motion, sliding) = (&rough.motion, rough.of(decided)?);
        let (end, direction) = (sliding.slip_ends.as_ref()?, sliding.direction?);
        let [t, n] = motion.sense;
        let (mu, e) = (&decided.law.mu, &decided.law.restitution);
        let drive = Expr::from(t * n * direction) * mu;
        let [a, b, c] = &motion.written;
        let before = c - &drive * b;
        let after = match decided.mode.sticks() {
            true => c - b.powi(2) / a,
            false => c + &drive * b,
        };
        let approach = self.tidy(&(Expr::from(-n) * &motion.before[1]));
        let [left] = self.free(&["v", "w"], |letter| [format!("{letter}_slip")]);
        let [rate, work] = self.free(&["k W", "q A"], |both| {
            [0, 2].map(|i| both.get(i..=i).unwrap_or(both).to_owned())
        });
        let symbols = [&left, &rate, &work].map(|name| Expr::symbol(name));
        let [v, k, w] = &symbols;
        let half = Expr::ratio(1, 2);
        let in_compression = matches!(
            decided.mode,
            Mode::SticksInCompression | Mode::ReversesInCompression
        );
        let taken = match in_compression {
            true => &half * (&approach - v) * end + v.powi(2) / (Expr::from(2) * k),
            false => &half * &approach * &sliding.compressed,
        };
        let parts = [v, k, w, &e.powi(2)].map(words::formula);
        self.text(fill(
            "When the slip ends, the normal velocity is {}; from there on each unit of normal impulse adds {} to it. Compression takes the work {}, of which restitution gives back {} times as much:",
            parts,
        ));
        let reason = "a part of the work of the normal impulse";
        let parts = [
            (&left, before * end - &approach),
            (&rate, after),
            (&work, taken),
        ];
        for (name, written) in parts {
            let math = words::related(&Expr::symbol(name), "=", &written);
            let id = self.names_only(name, written, reason);
            self.show(math, Some(id));
        }
        let two = || Expr::from(2);
        let remains = match in_compression {
            true => e * (two() * k * w).sqrt(),
            false => {
                let until_then = v * (end - &sliding.compressed) / two();
                (v.powi(2) + two() * k * (e.powi(2) * w - until_then)).sqrt()
            }
        };
        let up = Expr::from(n) * &motion.velocity[1];
        let claim = Claim::new(up, remains.clone());
        self.step(Vec::new(), vec![claim], "what restitution gives back");
        Some(remains)
    }

    /// What it takes to keep a contact from slipping, against what friction can.
    fn holding(&mut self, motion: &Motion, decided: &Decided, (when, otherwise): (&str, &str)) {
        let [a, b, _] = &motion.values;
        let ratio = self.tidy(&(b / a));
        let size = self.size(&ratio);
        let written = &motion.written[1] / &motion.written[0];
        let ratio = match self.has_names(&written) {
            true => written,
            false => ratio,
        };
        let needed = words::equation(&motion.impulse[0], &(-ratio * &motion.impulse[1]));
        let within = Inline::Math(words::related(&size, "≤", &decided.law.mu));
        self.text(fill(
            "{}, it sticks where friction can give the {} this takes, {}; otherwise {}.",
            [say(when), needed, within, say(otherwise)],
        ));
    }

    /// The impulse that brings a contact to rest.
    fn stopping(&mut self, motion: &Motion) {
        let [a, b, c] = &motion.values;
        let [u, v] = &motion.before;
        let determinant = a * c - b * b;
        let rest = [b * v - c * u, b * u - a * v].map(|e| self.tidy(&(e / &determinant)));
        let at = words::place(&self.scene.contacts[motion.contact].name, "contact");
        let [p_t, p_n] = [0, 1].map(|i| words::equation(&motion.impulse[i], &rest[i]));
        let parts = [say(words::capital(&at)), p_t, p_n];
        let mut text = fill("{} comes to rest at {} and {}", parts);
        if !b.is_zero() {
            let alone = self.tidy(&(-v / c));
            let alone = words::equation(&motion.impulse[1], &alone);
            text.extend(fill(
                "; without friction the approach would end at {}",
                [alone],
            ));
        }
        text.push(say("."));
        self.text(text);
    }
}

/// `to the left`, `up`, or along the tangent.
fn way(motion: &Motion, direction: i64) -> Vec<Inline> {
    let tangent = |form| {
        let t = words::vector("t", "", "");
        vec![say("along "), Inline::Math(words::set(form, [t]))]
    };
    match (motion.along[0], direction * motion.sense[0] > 0) {
        ("x", true) => vec![say("to the right")],
        ("x", false) => vec![say("to the left")],
        ("y", true) => vec![say("up")],
        ("y", false) => vec![say("down")],
        (_, true) => tangent("{}"),
        (_, false) => tangent("− {}"),
    }
}
