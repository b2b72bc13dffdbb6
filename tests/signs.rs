//! A sign that is proved for a domain is the sign of every exact value there: ends and corners of closed domains included.
//!
//! Expressions and domains are drawn at random, with factors that vanish at an end, touch zero inside or change sign.
//! `CAROM_CASES=100000 cargo test --release --test all signs:: -- --nocapture` for a long run.

use carom::algebra::{Field, Sign};
use carom::domain::{Domain, Domains, Limit};
use carom::expr::{Expr, Point, Rational, ratio};
use carom::numeric::random::Rng;
use num_traits::Zero;

fn cases() -> u64 {
    let told = std::env::var("CAROM_CASES").ok();
    told.and_then(|n| n.parse().ok()).unwrap_or(300)
}

/// An interval with ends that are small numbers, open or closed or missing; and numbers of it, its ends first.
fn interval(rng: &mut Rng) -> (Domain, Vec<Rational>) {
    let low = ratio(rng.below(7) as i64 - 3, 1 + rng.below(2) as i64);
    let high = &low + ratio(1 + rng.below(6) as i64, 1 + rng.below(3) as i64);
    let has = [rng.below(6) > 0, rng.below(4) > 0];
    let open = [rng.below(2) == 0, rng.below(2) == 0];
    let mut values = Vec::new();
    for (end, (has, open)) in [&low, &high].iter().zip(has.iter().zip(open)) {
        if *has && !open {
            values.push((*end).clone());
        }
    }
    let width = &high - &low;
    for k in [1, 5, 23, 50, 77, 99] {
        values.push(&low + &width * ratio(k, 100));
    }
    for k in [ratio(1, 1000), ratio(1, 3), ratio(7, 2), ratio(100, 1)] {
        if !has[0] {
            values.push(&low - &k);
        }
        if !has[1] {
            values.push(&high + &k);
        }
    }
    let domain = Domain {
        low: has[0].then(|| Limit::number(low, open[0])),
        high: has[1].then(|| Limit::number(high, open[1])),
    };
    (domain, values)
}

/// Angles between two quarter turns, with the directions of some of them, the ends first.
fn angles(rng: &mut Rng) -> (Domain, Vec<[Rational; 2]>) {
    let from = rng.below(4) as i64 - 2;
    let to = from + 1 + rng.below((2 - from) as usize) as i64;
    let open = [rng.below(2) == 0, rng.below(2) == 0];
    let quarter = |k: i64| match k.rem_euclid(4) {
        0 => [ratio(1, 1), ratio(0, 1)],
        1 => [ratio(0, 1), ratio(1, 1)],
        2 => [ratio(-1, 1), ratio(0, 1)],
        _ => [ratio(0, 1), ratio(-1, 1)],
    };
    let mut values = Vec::new();
    for (end, open) in [(from, open[0]), (to, open[1])] {
        if !open {
            values.push(quarter(end));
        }
    }
    for k in from..to {
        let [c, s] = quarter(k);
        if k > from {
            values.push([c.clone(), s.clone()]);
        }
        for t in [ratio(1, 50), ratio(1, 3), ratio(1, 2), ratio(9, 10)] {
            let below = ratio(1, 1) + &t * &t;
            let turned = [(ratio(1, 1) - &t * &t) / &below, ratio(2, 1) * &t / &below];
            let [x, y] = &turned;
            values.push([x * &c - y * &s, x * &s + y * &c]);
        }
    }
    let domain = Domain {
        low: Some(Limit::pi(ratio(from, 2), open[0])),
        high: Some(Limit::pi(ratio(to, 2), open[1])),
    };
    (domain, values)
}

/// Something that often keeps its sign, or loses it at one point only.
fn part(rng: &mut Rng, ends: &[Rational]) -> Expr {
    let (a, b, t) = (Expr::symbol("a"), Expr::symbol("b"), Expr::symbol("t"));
    let number = |rng: &mut Rng| Expr::ratio(rng.below(9) as i64 - 4, 1 + rng.below(3) as i64);
    let one = Expr::one();
    match rng.below(12) {
        0..3 if !ends.is_empty() => &a - &Expr::from(ends[rng.below(ends.len())].clone()),
        0..3 => a,
        3 => &b - &number(rng),
        4 => &a * &a + number(rng) * &a + number(rng),
        5 => t.cos(),
        6 => t.sin(),
        7 => one + t.cos(),
        8 => one - t.sin(),
        9 => &a * &b + number(rng) * &a + number(rng) * &b + number(rng),
        10 => number(rng) + number(rng) * t.cos() + number(rng) * t.sin(),
        _ => (&a + &(number(rng) * &b) + number(rng)).powi(2) + number(rng) * t.cos().powi(2),
    }
}

fn holds(sign: Sign, value: &Rational) -> bool {
    let zero = Rational::zero();
    match sign {
        Sign::Positive => *value > zero,
        Sign::NotNegative => *value >= zero,
        Sign::Zero => *value == zero,
        Sign::NotPositive => *value <= zero,
        Sign::Negative => *value < zero,
    }
}

#[test]
fn a_proved_sign_holds_at_every_exact_point_with_ends_and_corners() {
    let (mut strict, mut weak, mut open, mut missed) = (0, 0, 0, 0);
    for case in 0..cases() {
        let mut rng = Rng::new(case);
        let (a, b, t) = (interval(&mut rng), interval(&mut rng), angles(&mut rng));
        let mut domains = Domains::default();
        domains.symbols.insert("a".into(), a.0.clone());
        domains.symbols.insert("b".into(), b.0.clone());
        domains.symbols.insert("t".into(), t.0.clone());
        let limits = [&a.0.low, &a.0.high];
        let ends: Vec<Rational> = limits
            .into_iter()
            .flatten()
            .map(|l| l.value.clone())
            .collect();
        let mut e = part(&mut rng, &ends);
        for _ in 0..rng.below(3) {
            let other = part(&mut rng, &ends);
            e = match rng.below(4) {
                0 => e + other,
                1 => e / other,
                _ => e * other,
            };
        }
        let mut field = Field::new(&domains);
        field.prepare([&e]);
        let Ok(x) = field.element(&e) else { continue };
        let sign = field.sign(&x);
        let (mut plus, mut minus) = (false, false);
        for x in &a.1 {
            for y in &b.1 {
                for unit in &t.1 {
                    let mut at = Point::<Rational>::default();
                    at.values.insert("a".into(), x.clone());
                    at.values.insert("b".into(), y.clone());
                    at.directions.insert("t".into(), (1, unit.clone()));
                    let Some(value) = e.evaluate(&at) else {
                        continue;
                    };
                    plus |= value > Rational::zero();
                    minus |= value < Rational::zero();
                    if let Some(sign) = sign {
                        assert!(
                            holds(sign, &value),
                            "case {case}: {e:?} is {value}, not {sign:?}, at {at:?} of {domains:?}"
                        );
                    }
                }
            }
        }
        match sign {
            Some(Sign::Positive | Sign::Negative) => strict += 1,
            Some(_) => weak += 1,
            None if plus && minus => open += 1,
            None => missed += 1,
        }
    }
    println!(
        "{} expressions: {strict} strict signs, {weak} others, {open} with both signs, {missed} not decided",
        cases()
    );
    assert!(missed * 4 < cases(), "{missed} signs not decided");
}

#[test]
fn a_proved_sign_of_what_is_linear_in_an_angle_holds_with_its_ends() {
    let (mut strict, mut weak) = (0, 0);
    for case in 0..cases() {
        let mut rng = Rng::new(case);
        let a = interval(&mut rng);
        let from = rng.below(8) as i64 - 4;
        let to = from + 1 + rng.below(6) as i64;
        let open = [rng.below(2) == 0, rng.below(2) == 0];
        let mut domains = Domains::default();
        let [low, high] = [(from, open[0]), (to, open[1])];
        let domain = Domain {
            low: Some(Limit::pi(ratio(low.0, 4), low.1)),
            high: Some(Limit::pi(ratio(high.0, 4), high.1)),
        };
        domains.symbols.insert("a".into(), a.0.clone());
        domains.symbols.insert("t".into(), domain);
        let number = |rng: &mut Rng| Expr::ratio(rng.below(9) as i64 - 4, 4);
        let [mut c, mut d, f, k] = [(); 4].map(|()| number(&mut rng));
        if rng.below(2) == 0 {
            // It vanishes at the lower end.
            [c, d] = [&f, &k].map(|slope| slope * &Expr::ratio(-from, 4));
        }
        // The same in units of π, where its values are fractions.
        let linear = |pi: &Expr| {
            let (a, t) = (Expr::symbol("a"), Expr::symbol("t"));
            (&c + &(&d * &a)) * pi + (&f + &(&k * &a)) * t
        };
        let (e, in_turns) = (linear(&Expr::pi()), linear(&Expr::one()));
        let mut field = Field::new(&domains);
        field.prepare([&e]);
        let Some(sign) = field.element(&e).ok().and_then(|x| field.sign(&x)) else {
            continue;
        };
        match sign {
            Sign::Positive | Sign::Negative => strict += 1,
            _ => weak += 1,
        }
        let step = ratio(to - from, 24);
        let first = i64::from(open[0]);
        for part in first..=24 - i64::from(open[1]) {
            for x in &a.1 {
                let mut at = Point::<Rational>::default();
                at.values.insert("a".into(), x.clone());
                at.values.insert(
                    "t".into(),
                    ratio(from, 4) + &step / ratio(4, 1) * ratio(part, 1),
                );
                let value = in_turns.evaluate(&at).expect("no quotient");
                assert!(
                    holds(sign, &value),
                    "case {case}: {e:?} is {value} pi, not {sign:?}, at {at:?} of {domains:?}"
                );
            }
        }
    }
    println!("{strict} strict signs and {weak} others");
    assert!(
        strict > cases() / 20 && weak > cases() / 50,
        "{strict} {weak}"
    );
}
