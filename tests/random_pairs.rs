//! Random pairs of formulas and relations, judged by both proofs and held against arithmetic of 90 digits or the way they
//! were made.
//!
//! Pairs come from a table of identities, of identities that hold on one branch only and of near misses, filled with random
//! parts over random domains: closed and open ends, poles, several angles. `CAROM_CASES=1000000 cargo test --release --test
//! all random_pairs:: -- --nocapture` for a long run.

use std::collections::BTreeMap;

use carom::domain::{Coordinate, Domain, Domains, Limit, Sample};
use carom::equality::{Equality, decide};
use carom::expr::{Expr, Function, Point, Rational, ratio};
use carom::formula::write_plain;
use carom::grade::{Given, Options, Question, Strength, Verdict, judge};
use carom::interval::{Big, Outcome, evaluate};
use carom::numeric::random::Rng;

/// About 96 decimal digits.
type Long = Big<320>;

fn cases() -> u64 {
    let told = std::env::var("CAROM_CASES").ok();
    told.and_then(|n| n.parse().ok()).unwrap_or(150)
}

fn first_case() -> u64 {
    let told = std::env::var("CAROM_FROM").ok();
    told.and_then(|n| n.parse().ok()).unwrap_or(0)
}

/// Symbols with their domains, and numbers of each: closed ends, near the ends, inside.
struct Ground {
    domains: Domains,
    values: BTreeMap<&'static str, Vec<Rational>>,
}

fn ground(rng: &mut Rng) -> Ground {
    let mut out = Ground {
        domains: Domains::default(),
        values: BTreeMap::new(),
    };
    for name in ["a", "b", "x"] {
        let (low, high) = match rng.below(6) {
            // Positive without a word, or with one.
            0 => (Some(Limit::number(ratio(0, 1), true)), None),
            1 => (Some(Limit::number(ratio(0, 1), false)), None),
            2 => (None, None),
            _ => {
                let from = ratio(rng.below(9) as i64 - 4, 1 + rng.below(2) as i64);
                let to = &from + ratio(1 + rng.below(8) as i64, 1 + rng.below(2) as i64);
                let open = [rng.below(2) == 0, rng.below(2) == 0];
                (
                    Some(Limit::number(from, open[0])),
                    Some(Limit::number(to, open[1])),
                )
            }
        };
        let domain = Domain { low, high };
        let mut values = Vec::new();
        let ends = [&domain.low, &domain.high];
        let least = domain
            .low
            .as_ref()
            .map_or(ratio(-40, 1), |l| l.value.clone());
        let most = domain
            .high
            .as_ref()
            .map_or(ratio(40, 1), |l| l.value.clone());
        for end in ends.into_iter().flatten() {
            values.push(end.value.clone());
        }
        for _ in 0..7 {
            let share = ratio(1 + rng.below(997) as i64, 998);
            values.push(&least + (&most - &least) * share);
        }
        values.push(&least + (&most - &least) * ratio(1, 100_003));
        values.retain(|v| domain.contains(v));
        out.domains.symbols.insert(name.into(), domain);
        out.values.insert(name, values);
    }
    for name in ["alpha", "beta"] {
        let from = rng.below(4) as i64 - 2;
        let to = from + 1 + rng.below((2 - from) as usize) as i64;
        let open = rng.below(2) == 0;
        let domain = Domain {
            low: Some(Limit::pi(ratio(from, 2), open)),
            high: Some(Limit::pi(ratio(to, 2), open)),
        };
        let pi = ratio(355, 226);
        let (least, most) = (&pi * ratio(from, 1), &pi * ratio(to, 1));
        let mut values: Vec<Rational> = (0..8)
            .map(|_| &least + (&most - &least) * ratio(1 + rng.below(997) as i64, 998))
            .collect();
        values.retain(|v| domain.contains(v));
        out.domains.symbols.insert(name.into(), domain);
        out.values.insert(name, values);
    }
    out
}

fn call(f: Function, x: &Expr) -> Expr {
    Expr::call(f, x.clone())
}

/// A small part: something linear, a product, a square, an angle's sine.
fn part(rng: &mut Rng) -> Expr {
    let symbol = |rng: &mut Rng| Expr::symbol(["a", "b", "x"][rng.below(3)]);
    let number = |rng: &mut Rng| Expr::ratio(1 + rng.below(6) as i64, 1 + rng.below(3) as i64);
    match rng.below(9) {
        0 | 1 => symbol(rng),
        2 => symbol(rng) - number(rng),
        3 => symbol(rng) + number(rng),
        4 => symbol(rng) * symbol(rng),
        5 => symbol(rng) - symbol(rng),
        6 => symbol(rng).powi(2) + number(rng),
        7 => number(rng) - symbol(rng),
        _ => Expr::symbol(["alpha", "beta"][rng.below(2)]).cos(),
    }
}

fn angle(rng: &mut Rng) -> Expr {
    let (a, b) = (Expr::symbol("alpha"), Expr::symbol("beta"));
    match rng.below(5) {
        0 => a,
        1 => b,
        2 => a + b,
        3 => a - b,
        _ => a * Expr::from(2),
    }
}

/// Two formulas, equal or nearly so, of random parts.
fn pair(rng: &mut Rng) -> (Expr, Expr) {
    use Function::{Abs, Acos, Asin, Atan, Exp, Ln};
    let (u, v, w) = (part(rng), part(rng), part(rng));
    let (s, t) = (angle(rng), angle(rng));
    let n = |k: i64| Expr::from(k);
    let one = Expr::one;
    match rng.below(48) {
        0 => ((&u + &v).powi(2), u.powi(2) + n(2) * &u * &v + v.powi(2)),
        1 => (u.powi(2) - v.powi(2), (&u - &v) * (&u + &v)),
        2 => ((u.powi(2) - v.powi(2)) / (&u - &v), &u + &v),
        3 => (one() / &u + one() / &v, (&u + &v) / (&u * &v)),
        4 => (&u / &v * &v, u),
        5 => (u.powi(2).sqrt(), u),
        6 => (u.powi(2).sqrt(), call(Abs, &u)),
        7 => (call(Abs, &u), u),
        8 => (call(Abs, &(&u * &v)), call(Abs, &u) * call(Abs, &v)),
        9 => ((&u * &v).sqrt(), u.sqrt() * v.sqrt()),
        10 => ((&u / &v).sqrt(), u.sqrt() / v.sqrt()),
        11 => ((u.powi(2) * &v).sqrt(), &u * v.sqrt()),
        12 => ((u.powi(2) * &v).sqrt(), call(Abs, &u) * v.sqrt()),
        13 => (u.powi(4).sqrt(), u.powi(2)),
        14 => (u.powi(6).sqrt(), u.powi(3)),
        15 => ((u.sqrt() + v.sqrt()) * (u.sqrt() - v.sqrt()), &u - &v),
        16 => (
            one() / (u.sqrt() - v.sqrt()),
            (u.sqrt() + v.sqrt()) / (&u - &v),
        ),
        17 => (call(Ln, &(&u * &v)), call(Ln, &u) + call(Ln, &v)),
        18 => (call(Ln, &u.powi(2)), n(2) * call(Ln, &u)),
        19 => (call(Ln, &u.powi(2)), n(2) * call(Ln, &call(Abs, &u))),
        20 => (call(Ln, &(&u / &v)), call(Ln, &u) - call(Ln, &v)),
        21 => (call(Exp, &u) * call(Exp, &v), call(Exp, &(&u + &v))),
        22 => (call(Exp, &(&u * &Expr::ratio(1, 2))).powi(2), call(Exp, &u)),
        23 => (call(Exp, &call(Ln, &u)), u),
        24 => (call(Ln, &call(Exp, &u)), u),
        25 => ((&s + &t).sin(), s.sin() * t.cos() + s.cos() * t.sin()),
        26 => ((&s * &n(2)).cos(), one() - n(2) * s.sin().powi(2)),
        27 => (one() - s.sin().powi(2), s.cos().powi(2)),
        28 => ((one() - s.sin().powi(2)).sqrt(), s.cos()),
        29 => ((one() - s.cos().powi(2)).sqrt(), call(Abs, &s.sin())),
        30 => (
            ((one() + s.cos()) / n(2)).sqrt(),
            (&s * &Expr::ratio(1, 2)).cos(),
        ),
        31 => (s.sin() / s.cos() * s.cos(), s.sin()),
        32 => (n(2) * s.sin() * t.cos(), (&s + &t).sin() + (&s - &t).sin()),
        33 => ((s.sin() + s.cos()).powi(2), one() + (&s * &n(2)).sin()),
        34 => (call(Acos, &u).cos(), u),
        35 => (
            call(Asin, &u) + call(Acos, &u),
            Expr::pi() * Expr::ratio(1, 2),
        ),
        36 => (call(Atan, &u).cos(), one() / (one() + u.powi(2)).sqrt()),
        37 => (call(Asin, &u).cos(), (one() - u.powi(2)).sqrt()),
        38 => (((&u - &v).powi(2) + n(4) * &u * &v).sqrt(), &u + &v),
        39 => ((&u * &w + &v * &w) / &w, &u + &v),
        40 => (
            u.powi(3) - v.powi(3),
            (&u - &v) * (u.powi(2) + &u * &v + v.powi(2)),
        ),
        41 => (
            ((&u - &v) * (&u - &w)).sqrt(),
            ((&v - &u) * (&w - &u)).sqrt(),
        ),
        42 => (call(Abs, &(&u - &v)), call(Abs, &(&v - &u))),
        43 => ((n(2) * &u).sqrt(), n(2).sqrt() * u.sqrt()),
        44 => (u.sqrt().sqrt(), u.power(Expr::ratio(1, 4))),
        45 => ((&u + &v).sqrt(), u.sqrt() + v.sqrt()),
        46 => ((&u + &v).powi(2), u.powi(2) + v.powi(2)),
        _ => (
            s.sin() * t.sin(),
            ((&s - &t).cos() - (&s + &t).cos()) / n(2),
        ),
    }
}

/// The same done to both, and sometimes a slip in one.
fn wrapped(rng: &mut Rng, (mut e, mut f): (Expr, Expr)) -> (Expr, Expr) {
    for _ in 0..rng.below(3) {
        let k = part(rng);
        (e, f) = match rng.below(6) {
            0 => (&e + &k, &k + &f),
            1 => (&e * &k, &k * &f),
            2 => (&e / &k, &f / &k),
            3 => (&k - &e, &k - &f),
            4 => (e.powi(2), &f * &f),
            _ => (&e - &k, -(&k - &f)),
        };
    }
    if rng.below(4) == 0 {
        let k = part(rng);
        f = match rng.below(5) {
            0 => -f,
            1 => f * Expr::ratio(1001, 1000),
            2 => f + Expr::ratio(1, 1_000_000_007),
            3 => call(Function::Abs, &f),
            _ => &f + &(k * Expr::ratio(1, 1000)),
        };
    }
    match rng.below(2) {
        0 => (e, f),
        _ => (f, e),
    }
}

/// What 90 digits say: apart at a point for certain, the same at all points, or too few values.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Truth {
    Apart,
    Same,
    Open,
}

fn truth(e: &Expr, f: &Expr, ground: &Ground, rng: &mut Rng) -> Truth {
    let mut known = 0;
    for k in 0..14 {
        let mut at = Point::<Outcome<Long>>::default();
        for (name, values) in &ground.values {
            if values.is_empty() {
                return Truth::Open;
            }
            // Corners first.
            let pick = if k < 3 {
                k.min(values.len() - 1)
            } else {
                rng.below(values.len())
            };
            let value = <Long as carom::interval::Certified>::from_rational(&values[pick]);
            at.values.insert((*name).into(), Outcome::Value(value));
        }
        let (Outcome::Value(x), Outcome::Value(y)) = (evaluate(e, &at), evaluate(f, &at)) else {
            continue;
        };
        if x.0.is_disjoint(&y.0) {
            return Truth::Apart;
        }
        if x.0.digits().min(y.0.digits()) >= 60 || x.0.has_zero() && y.0.has_zero() {
            known += 1;
        }
    }
    if known >= 3 { Truth::Same } else { Truth::Open }
}

/// The coordinates of a point that are fractions, and directions with a fraction for cosine and sine.
fn fractions(at: &Sample) -> Point<Rational> {
    let mut point = Point::default();
    for (name, coordinate) in &at.coordinates {
        match coordinate {
            Coordinate::Number(value) => {
                point.values.insert(name.clone(), value.clone());
            }
            Coordinate::Direction { divisor, unit, .. } => {
                point
                    .directions
                    .insert(name.clone(), (*divisor, unit.clone()));
            }
            Coordinate::Pi(_) => {}
        }
    }
    point
}

/// Whether the proof's own point parts two formulas, by fractions or by 90 digits.
fn point_holds(e: &Expr, f: &Expr, domains: &Domains) -> bool {
    match decide(e, f, domains).equality {
        Equality::Different(found)
        | Equality::Same {
            how: carom::equality::How::OnBranch {
                elsewhere: found, ..
            },
        } => {
            // Fractions know that x − x is 0, which long numbers do not.
            let exact = fractions(&found.at);
            if let (Some(x), Some(y)) = (e.evaluate(&exact), f.evaluate(&exact)) {
                return x != y;
            }
            let at = found.at.point::<Long>(true);
            match (evaluate(e, &at), evaluate(f, &at)) {
                (Outcome::Value(x), Outcome::Value(y)) => x.0.is_disjoint(&y.0),
                _ => false,
            }
        }
        _ => false,
    }
}

fn question(domains: &Domains) -> Question {
    let mut question = Question {
        domains: domains.clone(),
        ..Question::default()
    };
    for name in domains.symbols.keys() {
        question.symbols.push(Given {
            name: name.clone(),
            latex: None,
            dimension: None,
        });
    }
    question
}

#[derive(Default)]
struct Counts {
    equivalent: u64,
    different: u64,
    undecided: u64,
    invalid: u64,
}

impl Counts {
    fn add(&mut self, verdict: Verdict) {
        match verdict {
            Verdict::Equivalent => self.equivalent += 1,
            Verdict::Different => self.different += 1,
            Verdict::Undecided => self.undecided += 1,
            Verdict::Invalid => self.invalid += 1,
        }
    }

    fn words(&self) -> String {
        let Counts {
            equivalent,
            different,
            undecided,
            invalid,
        } = self;
        format!(
            "{equivalent} equivalent, {different} different, {undecided} undecided, {invalid} invalid"
        )
    }
}

#[test]
fn no_verdict_on_formulas_is_wrong_and_order_does_not_matter() {
    let (mut sure, mut fast) = (Counts::default(), Counts::default());
    let mut asymmetric = 0;
    let strengths = [Strength::Identity, Strength::Fast].map(|strength| Options {
        strength,
        ..Options::default()
    });
    for case in first_case()..first_case() + cases() {
        if case % 100_000 == 99_999 {
            println!("case {case}: {}", sure.words());
        }
        let mut rng = Rng::new(case.wrapping_mul(0x9e37_79b9) + 11);
        let ground = ground(&mut rng);
        let made = pair(&mut rng);
        let (e, f) = wrapped(&mut rng, made);
        let known = truth(&e, &f, &ground, &mut rng);
        let question = question(&ground.domains);
        let (a, b) = (write_plain(&e), write_plain(&f));
        let verdicts = strengths.each_ref().map(|o| judge(&a, &b, &question, o));
        let domains = &ground.domains;
        for verdict in &verdicts {
            let words =
                || format!("case {case}: {a} | {b} on {domains:?}: {verdict:?}, truth {known:?}");
            match (verdict.verdict, known) {
                (Verdict::Equivalent, Truth::Apart) => panic!("wrong: {}", words()),
                (Verdict::Different, Truth::Same | Truth::Open) => {
                    assert!(point_holds(&e, &f, domains), "no point: {}", words());
                }
                (Verdict::Invalid, Truth::Apart | Truth::Same) => panic!("has values: {}", words()),
                _ => {}
            }
        }
        sure.add(verdicts[0].verdict);
        fast.add(verdicts[1].verdict);
        let turned = judge(&b, &a, &question, &strengths[0]);
        asymmetric += u64::from(turned.verdict != verdicts[0].verdict);
        if turned.verdict != verdicts[0].verdict {
            println!(
                "order, case {case}: {a} | {b}: {:?}, turned {:?}, {domains:?}",
                verdicts[0].verdict, turned.verdict
            );
        }
        if verdicts[0].verdict == Verdict::Undecided && cases() <= 5_000 {
            println!(
                "undecided, case {case} ({known:?}): {a} | {b}: {}\n{domains:?}",
                verdicts[0].proof.words
            );
        }
    }
    println!("{} pairs, identity: {}", cases(), sure.words());
    println!("{} pairs, fast: {}", cases(), fast.words());
    println!("{asymmetric} verdicts hang on the order");
    assert_eq!(asymmetric, 0, "verdicts that hang on the order");
    assert!(
        sure.undecided * 50 < cases().max(50),
        "{} undecided",
        sure.undecided
    );
}

/// A relation between a product of powers of (x − r) and zero.
fn relation(rng: &mut Rng, roots: &[i64]) -> (Expr, &'static str, Vec<(i64, i64)>) {
    let x = Expr::symbol("x");
    let mut powers = Vec::new();
    let mut e = Expr::from([1, -1, 2][rng.below(3)]);
    for r in roots {
        let k = rng.below(3) as i64;
        if k > 0 {
            powers.push((*r, k));
            e = e * (&x - &Expr::from(*r)).powi(k);
        }
    }
    if rng.below(4) == 0 {
        e = e * (x.powi(2) + Expr::one());
    }
    (e, ["=", "<", "<=", ">", ">=", "!="][rng.below(6)], powers)
}

fn holds(e: &Expr, sign: &str, at: &Rational) -> bool {
    let mut point = Point::<Rational>::default();
    point.values.insert("x".into(), at.clone());
    let value = e.evaluate(&point).expect("a polynomial has values");
    let zero = ratio(0, 1);
    match sign {
        "=" => value == zero,
        "<" => value < zero,
        "<=" => value <= zero,
        ">" => value > zero,
        ">=" => value >= zero,
        _ => value != zero,
    }
}

#[test]
fn relations_in_one_symbol_are_judged_by_their_solutions() {
    let mut counts = Counts::default();
    let options = Options::default();
    for case in first_case()..first_case() + cases() {
        let mut rng = Rng::new(case.wrapping_mul(0x51ed) + 5);
        let ground = ground(&mut rng);
        // The only symbol of a relation has either sign where nobody says more.
        let declared = rng.below(3) > 0;
        let domain = match declared {
            true => ground.domains.symbols["x"].clone(),
            false => Domain::real(),
        };
        let roots: Vec<i64> = (0..1 + rng.below(3))
            .map(|_| rng.below(9) as i64 - 4)
            .collect();
        let (e, sign, _) = relation(&mut rng, &roots);
        let (f, other, _) = match rng.below(3) {
            0 => (&e * &Expr::from(3), sign, Vec::new()),
            _ => relation(&mut rng, &roots),
        };
        // Both hold or not at the roots, between them and at the ends: nothing else can part them.
        let mut points: Vec<Rational> = (-12..=12).map(|k| ratio(k, 2)).collect();
        points.extend((-9..=9).map(|k| ratio(2 * k + 1, 4)));
        points.extend(ground.values["x"].iter().cloned());
        points.extend([ratio(-1000, 1), ratio(1000, 1)]);
        let inside = points.iter().filter(|p| domain.contains(p));
        let truth: Vec<[bool; 2]> = inside
            .map(|p| [holds(&e, sign, p), holds(&f, other, p)])
            .collect();
        let same = truth.iter().all(|[a, b]| a == b);
        let plain = truth.iter().any(|t| t[0]) && truth.iter().any(|t| !t[0]);
        let mut domains = Domains::default();
        if declared {
            domains.symbols.insert("x".into(), domain);
        }
        let question = question(&domains);
        let (a, b) = (
            format!("{} {sign} 0", write_plain(&e)),
            format!("{} {other} 0", write_plain(&f)),
        );
        let grade = judge(&a, &b, &question, &options);
        let words = || format!("case {case}: {a} | {b} on {domains:?}: {grade:?}");
        match (same, plain, grade.verdict) {
            (true, true, Verdict::Equivalent) | (false, _, Verdict::Different) => {}
            // Relations that always or never hold are compared beyond the domain.
            (true, false, _) => {}
            (_, _, Verdict::Undecided) => println!("undecided: {}", words()),
            _ => panic!("wrong: {}", words()),
        }
        counts.add(grade.verdict);
        let turned = judge(&b, &a, &question, &options).verdict;
        assert_eq!(turned, grade.verdict, "order: {}", words());
    }
    println!("{} pairs of relations: {}", cases(), counts.words());
    assert!(
        counts.undecided * 10 < cases(),
        "{} undecided",
        counts.undecided
    );
}

/// A relation as students write it, in names of which nothing is declared.
fn undeclared(rng: &mut Rng) -> String {
    let [x, y] = [0, 1].map(|_| ["x", "y", "m", "M", "theta", "v_x"][rng.below(6)]);
    let n = 1 + rng.below(3);
    let sign = ["=", "=", "=", "<", "<=", ">"][rng.below(6)];
    let side = match rng.below(16) {
        0 => format!("({x}-{y})*x"),
        1 => format!("{x}*({y}-{n})"),
        2 => format!("tan({x})-1"),
        3 => format!("sqrt({x})-{y}"),
        4 => format!("ln({x})-{n}"),
        5 => format!("{x}^2-{n}"),
        6 => format!("abs({x})-{y}"),
        7 => format!("{x}/{y}"),
        8 => format!("{x}^2-{y}^2"),
        9 => format!("{x}-pi/4"),
        10 => format!("{x}*{y}"),
        11 => format!("{x}+{y}"),
        12 => format!("({x}-{n})*({y}+{n})"),
        13 => format!("sin({x})-{y}"),
        _ => x.to_string(),
    };
    let end = ["0", "0", "0", "1", "y"][rng.below(5)];
    format!("{side} {sign} {end}")
}

#[test]
fn undeclared_names_live_in_the_same_place_in_either_order() {
    let (mut counts, options) = (Counts::default(), Options::default());
    for case in first_case()..first_case() + cases() * 4 {
        let mut rng = Rng::new(case.wrapping_mul(0x6b) + 29);
        let a = undeclared(&mut rng);
        let b = match rng.below(4) {
            0 => a.replace(['m', 'y'], "x"),
            1 => format!("m*({}", a.replacen(' ', ") ", 1)),
            _ => undeclared(&mut rng),
        };
        let [one, other] = [(&a, &b), (&b, &a)]
            .map(|(expected, answer)| judge(expected, answer, &Question::default(), &options));
        // `x = x` is no answer, and as what is expected it says nothing.
        let invalid = [&one, &other].iter().any(|g| g.verdict == Verdict::Invalid);
        assert!(
            invalid || one.verdict == other.verdict,
            "case {case}: {a} | {b}: {one:?}\n{other:?}"
        );
        counts.add(one.verdict);
    }
    println!("relations in undeclared names: {}", counts.words());
}

#[test]
fn factors_of_equations_are_told_or_refuted() {
    let mut counts = Counts::default();
    let options = Options::default();
    for case in first_case()..first_case() + cases() {
        let mut rng = Rng::new(case.wrapping_mul(0x77) + 3);
        let (x, a, e) = (Expr::symbol("x"), Expr::symbol("a"), Expr::symbol("e"));
        let t = Expr::symbol("alpha");
        let mut domains = Domains::default();
        let closed = rng.below(2) == 0;
        let unit = Domain {
            low: Some(Limit::number(ratio(0, 1), !closed)),
            high: Some(Limit::number(ratio(1, 1), !closed)),
        };
        domains.symbols.insert("e".into(), unit);
        domains.symbols.insert("x".into(), Domain::real());
        domains.symbols.insert("a".into(), Domain::real());
        domains
            .symbols
            .insert("alpha".into(), Domain::first_quadrant());
        let bound = match rng.below(3) {
            0 => a.clone(),
            1 => &a * &t.cos() + Expr::one(),
            _ => &a * &Expr::ratio(3, 2) - &e,
        };
        let law = &x - &bound;
        // A factor, and whether it may vanish: never, where the sought quantity plays no part, or where it does.
        let (factor, vanishes, sought) = match rng.below(9) {
            0 => (Expr::from(-3), false, false),
            1 => (Expr::one() + &e, false, false),
            2 => (x.powi(2) + Expr::one(), false, true),
            3 => (t.cos(), false, false),
            4 => (Expr::from(2) - t.sin(), false, false),
            5 => (Expr::one() - &e, closed, false),
            6 => (Expr::one() - Expr::from(3) * t.cos().powi(2), true, false),
            7 => (&x - &Expr::from(7), true, true),
            _ => (&x + &a, true, true),
        };
        let other = match rng.below(5) {
            0 => &law + &Expr::from(1),
            1 => &x + &bound,
            _ => &law * &factor,
        };
        let product = other == &law * &factor;
        let mut question = question(&domains);
        question.asked.push(Given {
            name: "x".into(),
            latex: None,
            dimension: None,
        });
        let pair = [
            format!("{} = 0", write_plain(&law)),
            format!("{} = 0", write_plain(&other)),
        ];
        let order = rng.below(2);
        let grade = judge(&pair[order], &pair[1 - order], &question, &options);
        let words = || format!("case {case}: {pair:?} {order} on {domains:?}: {grade:?}");
        match (product, vanishes, sought) {
            (false, ..) | (true, true, true) => {
                assert_eq!(grade.verdict, Verdict::Different, "{}", words());
            }
            (true, true, false) => {
                assert_eq!(grade.verdict, Verdict::Equivalent, "{}", words());
                let told = grade.assumed.iter().any(|w| w.contains('≠'));
                assert!(told, "not told: {}", words());
            }
            (true, false, _) => {
                assert_eq!(grade.verdict, Verdict::Equivalent, "{}", words());
                let told = grade.assumed.iter().any(|w| w.contains('≠'));
                assert!(!told, "told in vain: {}", words());
            }
        }
        counts.add(grade.verdict);
    }
    println!("{} equations with factors: {}", cases(), counts.words());
}
