//! Time per decision by class of pair: one equal and one different pair each.

#[path = "../tests/equality/reader.rs"]
mod reader;

use carom::algebra::Field;
use carom::domain::{roles, samples};
use carom::equality::decide;
use carom::expr::Expr;

fn main() {
    divan::main();
}

/// Name, formula, an equal one, a different one.
const PAIRS: [(&str, &str, &str, &str); 6] = [
    (
        "rational",
        "(m1-e*m2)*v/(m1+m2)",
        "v-(1+e)*m2*v/(m1+m2)",
        "v-(1+e)*m1*v/(m1+m2)",
    ),
    (
        "one_angle",
        "3*v*sin(2*theta)/(2*l)",
        "3*v*cos(theta)*sin(theta)/l",
        "3*v*cos(theta)*sin(theta)/(2*l)",
    ),
    (
        "several_angles",
        "l*(omega1*cos(alpha-beta)+omega2)",
        "l*omega1*(cos(alpha)*cos(beta)+sin(alpha)*sin(beta))+l*omega2",
        "l*omega1*(cos(alpha)*cos(beta)-sin(alpha)*sin(beta))+l*omega2",
    ),
    (
        "roots",
        "sqrt(2*g*h*(1-cos(theta)))",
        "2*sqrt(g)*sqrt(h)*sin(theta/2)",
        "sqrt(2)*sqrt(g)*sqrt(h)*sin(theta/2)",
    ),
    (
        "long",
        "(m1*(v1*cos(alpha)+e*v2*cos(beta))-m2*(v1*sin(alpha)-v2*sin(beta)))*(m1+m2)/(m1*m2*(1+e)*(l1+l2)^2)+6*v1/((4*m1+m2)*l1)",
        "6*v1/((4*m1+m2)*l1)+(m1*v1*cos(alpha)+m1*e*v2*cos(beta)-m2*v1*sin(alpha)+m2*v2*sin(beta))*(1/m1+1/m2)/((1+e)*(l1^2+2*l1*l2+l2^2))",
        "6*v1/((4*m1+m2)*l1)+(m1*v1*cos(alpha)+m1*e*v2*cos(beta)-m2*v1*sin(alpha)-m2*v2*sin(beta))*(1/m1+1/m2)/((1+e)*(l1^2+2*l1*l2+l2^2))",
    ),
    ("high_power", "(x-a)^6000", "(a-x)^6000", "(x-a)^5999"),
];

fn pair(name: &str) -> [Expr; 3] {
    let (_, a, same, different) = PAIRS
        .iter()
        .find(|p| p.0 == name)
        .expect("a class of the table");
    [a, same, different].map(|text| reader::formula(text))
}

const NAMES: [&str; 6] = [
    "rational",
    "one_angle",
    "several_angles",
    "roots",
    "long",
    "high_power",
];

#[divan::bench(args = NAMES)]
fn equal(bencher: divan::Bencher, name: &str) {
    let [a, b, _] = pair(name);
    let domains = reader::domains("-");
    bencher.bench(|| decide(&a, &b, &domains));
}

#[divan::bench(args = NAMES)]
fn different(bencher: divan::Bencher, name: &str) {
    let [a, _, b] = pair(name);
    let domains = reader::domains("-");
    bencher.bench(|| decide(&a, &b, &domains));
}

#[divan::bench(args = NAMES)]
fn two_points(bencher: divan::Bencher, name: &str) {
    let [a, _, b] = pair(name);
    let domains = reader::domains("-");
    bencher.bench(|| {
        let roles = roles(&[&a, &b]);
        let (domains, _) = domains.completed(&roles);
        samples(&roles, &domains, 2)
    });
}

#[divan::bench(args = NAMES)]
fn normal_forms(bencher: divan::Bencher, name: &str) {
    let [a, b, _] = pair(name);
    let (domains, _) = reader::domains("-").completed(&roles(&[&a, &b]));
    bencher.bench(|| {
        let mut field = Field::new(&domains);
        field.prepare([&a, &b]);
        let (left, right) = (field.element(&a).ok()?, field.element(&b).ok()?);
        field.sub(&left, &right).ok()
    });
}

/// Formulas made to waste time; each has to come back within 10 ms.
#[divan::bench(args = ["nested_roots", "many_sines", "deep", "tower", "exponentials", "many_symbols", "long_product"], sample_count = 10)]
fn hostile(bencher: divan::Bencher, name: &str) {
    let [x, y] = ["x", "y"].map(Expr::symbol);
    let numbers = |n: i64| (1..=n).map(Expr::from);
    let exp = |e: Expr| Expr::call(carom::expr::Function::Exp, e);
    let (a, b) = match name {
        "nested_roots" => (
            numbers(100).fold(x.clone(), |e, k| (e + k).sqrt()),
            numbers(99).fold(y, |e, k| (e + k).sqrt()),
        ),
        "many_sines" => (
            Expr::sum(numbers(1500).map(|k| (&k * &x * &y).sin())),
            Expr::zero(),
        ),
        "deep" => (
            numbers(180).fold(x.clone(), |e, k| Expr::one() / (e + k)),
            numbers(180).fold(x.clone(), |e, k| Expr::one() / (k + e)),
        ),
        "tower" => (
            Expr::from(9).powi(387_420_489) * &x,
            Expr::from(9).powi(387_420_490) * &x / Expr::from(9),
        ),
        "exponentials" => (
            exp(exp(exp(exp(exp(x.clone()))))),
            exp(exp(exp(exp(exp(y))))),
        ),
        "many_symbols" => {
            let all = |from: i64| {
                Expr::sum((from..from + 3000).map(|k| Expr::symbol(&format!("x{k}")).powi(2)))
            };
            (all(0), all(0) + Expr::ratio(1, 1_000_000))
        }
        _ => (
            Expr::product(numbers(2000).map(|k| &x + &k)),
            Expr::product(numbers(2000).map(|k| k + &y)),
        ),
    };
    let domains = reader::domains("-");
    bencher.bench(|| decide(&a, &b, &domains));
}
