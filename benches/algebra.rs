//! Time of the algebra under a derivation: reading, solving, writing, and how they grow with a chain of hinged rods.

use carom::algebra::{Field, Row, Solution, solve};
use carom::domain::Domains;
use carom::expr::Expr;

fn main() {
    divan::main();
}

fn s(name: &str) -> Expr {
    Expr::symbol(name)
}

fn row(field: &mut Field, coeffs: &[(usize, &Expr)], rhs: &Expr) -> Row {
    let mut read = |e: &Expr| field.element(e).expect("within limits");
    Row {
        coeffs: coeffs.iter().map(|(j, e)| (*j, read(e))).collect(),
        rhs: read(rhs),
    }
}

/// The frictionless collision of two free bodies: six balances and restitution for v₁, ω₁, v₂, ω₂ and P.
fn two_bodies() -> (Field, Vec<Row>) {
    let mut domains = Domains::default();
    domains.unit_vectors.push(["nx".into(), "ny".into()]);
    let names = "m1 m2 I1 I2 x1 y1 x2 y2 nx ny u1x u1y u2x u2y w1 w2 e";
    let all: Vec<Expr> = names.split(' ').map(s).collect();
    let mut field = Field::new(&domains);
    field.prepare(&all);
    let (nx, ny) = (s("nx"), s("ny"));
    let arm = |i: usize| s(&format!("x{i}")) * &ny - s(&format!("y{i}")) * &nx;
    let (k1, k2) = (arm(1), arm(2));
    let before = |i: usize, k: &Expr| {
        s(&format!("u{i}x")) * &nx + s(&format!("u{i}y")) * &ny + s(&format!("w{i}")) * k
    };
    let restitution = s("e") * (before(1, &k1) - before(2, &k2));
    let mut rows = Vec::new();
    for (i, sign, k) in [(1, 1, &k1), (2, -1, &k2)] {
        let (m, inertia) = (s(&format!("m{i}")), s(&format!("I{i}")));
        let sign = Expr::from(sign);
        let at = 3 * (i - 1);
        for (j, mass, arm, v) in [
            (at, &m, &nx, format!("u{i}x")),
            (at + 1, &m, &ny, format!("u{i}y")),
            (at + 2, &inertia, k, format!("w{i}")),
        ] {
            rows.push(row(
                &mut field,
                &[(j, mass), (6, &(&sign * arm))],
                &(mass * &s(&v)),
            ));
        }
    }
    let gap = [
        (3, &nx),
        (4, &ny),
        (5, &k2),
        (0, &-&nx),
        (1, &-&ny),
        (2, &-&k1),
    ];
    rows.push(row(&mut field, &gap, &restitution));
    (field, rows)
}

/// n hinged rods struck at the free end, through the mass matrix m l² cᵢⱼ cos(θᵢ − θⱼ).
fn chain(n: usize, in_line: bool) -> (Field, Vec<Row>) {
    let mut field = Field::new(&Domains::default());
    let angles: Vec<Expr> = (0..n).map(|i| s(&format!("theta{i}"))).collect();
    let mut all = vec![s("m"), s("l"), s("J")];
    all.extend(angles.iter().map(Expr::cos).filter(|_| !in_line));
    field.prepare(&all);
    let mut rows = Vec::new();
    for i in 0..n {
        let entries: Vec<Expr> = (0..n)
            .map(|j| {
                let share = if i == j {
                    Expr::ratio(1, 3)
                } else {
                    Expr::ratio(1, 2)
                };
                let below = Expr::from((n - 1 - i.max(j)) as i64);
                let turn = if in_line || i == j {
                    Expr::one()
                } else {
                    (&angles[i] - &angles[j]).cos()
                };
                (share + below) * s("m") * s("l").powi(2) * turn
            })
            .collect();
        let coeffs: Vec<(usize, &Expr)> = entries.iter().enumerate().collect();
        let lever = if in_line {
            Expr::one()
        } else {
            angles[i].cos()
        };
        rows.push(row(&mut field, &coeffs, &(s("J") * s("l") * lever)));
    }
    (field, rows)
}

fn last(field: &Field, solution: &Solution) -> usize {
    let value = solution.values.last().and_then(Option::as_ref);
    value.map_or(0, |x| field.expr(x).size())
}

#[divan::bench]
fn two_bodies_read() -> (Field, Vec<Row>) {
    two_bodies()
}

#[divan::bench]
fn two_bodies_solve(bencher: divan::Bencher) {
    let (field, rows) = two_bodies();
    bencher.bench_local(|| solve(&field, &rows, 7));
}

#[divan::bench]
fn two_bodies_write_the_impulse(bencher: divan::Bencher) {
    let (field, rows) = two_bodies();
    let solution = solve(&field, &rows, 7).expect("within limits");
    bencher.bench_local(|| last(&field, &solution));
}

#[divan::bench(args = [1, 2, 4, 8])]
fn chain_in_line(bencher: divan::Bencher, n: usize) {
    let (field, rows) = chain(n, true);
    bencher.bench_local(|| solve(&field, &rows, n));
}

#[divan::bench(args = [2, 3, 4], sample_count = 20)]
fn chain_at_any_angles(bencher: divan::Bencher, n: usize) {
    let (field, rows) = chain(n, false);
    bencher.bench_local(|| solve(&field, &rows, n));
}
