//! The modes of friction as closed forms against the path that knows none, exactly, over random rational cases. The first
//! holds its conditions from inequalities; the second walks from event to event.

use std::collections::BTreeMap;

use carom::expr::{Expr, Point, Rational, ratio};
use carom::laws::friction::{ModeLaw, modes, side};
use carom::numeric::Number;
use carom::numeric::path::{Corner, Event, NoPath, Path, follow};
use carom::numeric::random::Rng;
use carom::scene::{ContactSpace, Friction, Hypothesis, Mode};
use num_traits::Signed;

use super::surd::Surd;

const NAMES: [&str; 8] = ["a", "b", "c", "u_t", "u_n", "mu", "e", "e_t"];

/// The contact and the law in symbols.
fn symbols(hypothesis: &Hypothesis<Surd>) -> (ContactSpace, Friction) {
    let [a, b, c, tangential, normal, mu, restitution, e_t] = NAMES.map(Expr::symbol);
    let space = ContactSpace {
        a,
        b,
        c,
        tangential,
        normal,
    };
    let hypothesis = match hypothesis {
        Hypothesis::Newton => Hypothesis::Newton,
        Hypothesis::Poisson => Hypothesis::Poisson,
        Hypothesis::Stronge => Hypothesis::Stronge,
        Hypothesis::ChatterjeeRuina { .. } => Hypothesis::ChatterjeeRuina { tangential: e_t },
        Hypothesis::Brach { .. } => Hypothesis::Brach { ratio: None },
    };
    let law = Friction {
        mu,
        restitution,
        hypothesis,
        supposing: None,
    };
    (space, law)
}

/// A random case: small fractions, among them the edges u_t⁻ = 0, b = 0, μ = 0, e = 0 and 1, and exact ties.
fn case(seed: u64) -> [Rational; 8] {
    let mut rng = Rng::of(seed, "friction");
    let mut small = |n: usize| ratio(1 + rng.below(n) as i64, 1 + rng.below(4) as i64);
    let (a, c) = (small(8), small(8));
    let (k, mu, u_n, u_t, e) = (small(7), small(9), small(8), small(8), small(3));
    let mut pick = Rng::of(seed, "edges");
    // b between −√(ac) and √(ac), from a share of the smaller of a and c.
    let smaller = if a < c { &a } else { &c };
    let sign = ratio(pick.below(2) as i64 * 2 - 1, 1);
    let b = match pick.below(12) {
        0 => ratio(0, 1),
        _ => &k / (&k + ratio(1, 1)) * smaller * &sign,
    };
    let e = match pick.below(6) {
        0 => ratio(0, 1),
        1 => ratio(1, 1),
        _ => &e / (&e + ratio(1, 1)),
    };
    let u_n = -u_n;
    let u_t = &u_t * ratio(pick.below(2) as i64 * 2 - 1, 1);
    let (u_t, mu) = match pick.below(12) {
        0 => (ratio(0, 1), mu),
        1 => (u_t, ratio(0, 1)),
        2 => (u_t, (&b / &a).abs()),
        // Little friction against a drive that turns the slip round.
        5 | 6 => {
            let share = &k / (&k + ratio(3, 1));
            let against = if b.is_negative() {
                u_t.abs()
            } else {
                -u_t.abs()
            };
            (against / ratio(4, 1), (&b / &a).abs() * share)
        }
        // Slip ends with compression, or with the impact, where that can be.
        tie @ (3 | 4) => {
            let factor = if tie == 3 {
                ratio(1, 1)
            } else {
                ratio(1, 1) + &e
            };
            let s = u_t.signum();
            let below = &a * &factor * &u_n - &b * &u_t;
            let critical = match below == ratio(0, 1) {
                true => mu.clone(),
                false => -&s * (&c * &u_t - &b * &factor * &u_n) / below,
            };
            (u_t, if critical.is_negative() { mu } else { critical })
        }
        _ => (u_t, mu),
    };
    let e_t = ratio(pick.below(9) as i64 - 4, 4);
    [a, b, c, u_t, u_n, mu, e, e_t]
}

/// The mode a path shows by its events.
fn seen(path: &Path<Surd>) -> Mode {
    let events: Vec<Event> = path.corners.iter().map(|c| c.event).collect();
    let at = |event| events.iter().position(|e| *e == event);
    let slips = !path.end().velocity[0].is_zero();
    match (at(Event::SlipEnds), at(Event::Compressed)) {
        (None, _) => Mode::Slides,
        (Some(stop), Some(pressed)) if stop < pressed => match slips {
            true => Mode::ReversesInCompression,
            false => Mode::SticksInCompression,
        },
        _ if slips => Mode::ReversesInRestitution,
        _ => Mode::SticksInRestitution,
    }
}

struct Forms {
    side: [Expr; 2],
    /// The modes for s = −1 and for s = 1.
    modes: [Vec<ModeLaw>; 2],
}

/// The mode whose conditions hold, and its impulse; a fault where none or several do.
fn chosen(forms: &Forms, at: &Point<Surd>) -> Result<(Mode, [Surd; 2]), String> {
    let value = |e: &Expr| e.evaluate(at).ok_or(format!("no value of {e:?}"));
    let zero = Surd::zero();
    let [of, tie] = [value(&forms.side[0])?, value(&forms.side[1])?];
    let plus = of > zero || of.is_zero() && tie >= zero;
    let mut found = Vec::new();
    for law in &forms.modes[usize::from(plus)] {
        let mut holds = true;
        for when in &law.when {
            let x = value(&when.of)?;
            holds &= x > zero || !when.strict && x.is_zero();
        }
        if holds {
            found.push(law);
        }
    }
    match found.as_slice() {
        [one] => Ok((one.mode, [value(&one.impulse[0])?, value(&one.impulse[1])?])),
        several => Err(format!("{} modes hold", several.len())),
    }
}

fn laws() -> Vec<Hypothesis<Surd>> {
    vec![
        Hypothesis::Newton,
        Hypothesis::Poisson,
        Hypothesis::Stronge,
        Hypothesis::ChatterjeeRuina {
            tangential: Surd::zero(),
        },
        Hypothesis::Brach { ratio: None },
    ]
}

#[test]
fn closed_forms_and_path_never_differ() {
    let cases: u64 = std::env::var("CAROM_CASES").map_or(400, |n| n.parse().expect("a number"));
    let mut modes_met: BTreeMap<(&str, Mode), usize> = BTreeMap::new();
    let mut gains: BTreeMap<&str, usize> = BTreeMap::new();
    for hypothesis in laws() {
        let name = hypothesis.name();
        let (space, law) = symbols(&hypothesis);
        let decided = side(&space, &law);
        let forms = Forms {
            side: [decided.of, decided.tie],
            modes: [modes(&space, &law, -1), modes(&space, &law, 1)],
        };
        for seed in 0..cases {
            let values = case(seed);
            let mut at = Point::<Surd>::default();
            for (name, value) in NAMES.iter().zip(&values) {
                at.values
                    .insert((*name).into(), Surd::rational(value.clone()));
            }
            let [a, b, c, tangential, normal, mu, restitution, e_t] =
                values.clone().map(Surd::rational);
            let space = ContactSpace {
                a,
                b,
                c,
                tangential,
                normal,
            };
            let hypothesis = match &hypothesis {
                Hypothesis::ChatterjeeRuina { .. } => {
                    Hypothesis::ChatterjeeRuina { tangential: e_t }
                }
                other => other.clone(),
            };
            let law = Friction {
                mu,
                restitution,
                hypothesis,
                supposing: None,
            };
            let path = follow(&space, &law)
                .unwrap_or_else(|why| panic!("{name}, case {seed}: {why}; {values:?}"));
            let (mode, impulse) = chosen(&forms, &at)
                .unwrap_or_else(|why| panic!("{name}, case {seed}: {why}; {values:?}"));
            assert!(
                path.end().impulse == impulse,
                "{name}, case {seed}: {mode:?} gives {impulse:?}, the path {path:?}; {values:?}"
            );
            *modes_met.entry((name, mode)).or_default() += 1;
            if matches!(name, "Newton" | "Poisson" | "Stronge") {
                check_mode(&path, mode, &format!("{name}, case {seed}"));
            }
            if path.gain() > Surd::zero() {
                *gains.entry(name).or_default() += 1;
            }
        }
    }
    println!("{cases} cases of each law: {modes_met:?}; gains of energy: {gains:?}");
    for calm in ["Poisson", "Stronge", "Chatterjee and Ruina"] {
        assert_eq!(gains.get(calm), None, "{calm} gains energy");
    }
    for lively in ["Newton", "Brach"] {
        assert!(
            gains.contains_key(lively),
            "{lively} never gains energy here"
        );
    }
    assert_eq!(modes_met.len(), 3 * 5 + 2 + 2, "some mode is never met");
}

/// Events and conditions agree on the mode where no event falls on another; at ties both names give the same impulse.
fn check_mode(path: &Path<Surd>, mode: Mode, case: &str) {
    let distinct = path
        .corners
        .windows(2)
        .all(|w| w[1].impulse[1] > w[0].impulse[1]);
    let together = |c: &Corner<Surd>| c.event == Event::Compressed && c.velocity[0].is_zero();
    let stopped_before = |i: usize| path.corners[..i].iter().any(|c| c.event == Event::SlipEnds);
    let tie = (0..path.corners.len()).any(|i| together(&path.corners[i]) && !stopped_before(i));
    let starts_slipping = !path.corners[0].velocity[0].is_zero();
    let ends_clear = path.end().velocity[0].is_zero() == mode.sticks();
    if distinct && !tie && starts_slipping && ends_clear {
        assert_eq!(seen(path), mode, "{case}: {path:?}");
    }
}

#[test]
fn a_body_hinged_to_the_ground_has_an_answer_by_poisson_only() {
    let [one, half] = [ratio(1, 1), ratio(1, 2)];
    let space = ContactSpace {
        a: one.clone(),
        b: one.clone(),
        c: one.clone(),
        tangential: -&one,
        normal: -&one,
    };
    let law = |hypothesis| Friction {
        mu: ratio(2, 1),
        restitution: half.clone(),
        hypothesis,
        supposing: None,
    };
    for hypothesis in [Hypothesis::Newton, Hypothesis::Stronge] {
        assert_eq!(follow(&space, &law(hypothesis)), Err(NoPath::NeverEnds));
    }
    let path = follow(&space, &law(Hypothesis::Poisson)).expect("an end");
    assert_eq!(
        path.end().velocity,
        [ratio(0, 1), ratio(0, 1)],
        "Poisson stops the body"
    );
}
