//! Points per second: a closed form compiled to a program, beside the same formula written by hand.

use carom::expr::{Expr, Symbol};
use carom::report::batch::{Program, compile};
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};

fn main() {
    divan::main();
}

const POINTS: usize = 1 << 16;

/// Tangential and normal restitution of a rod that strikes the ground at an angle: 7 symbols, one sine, one cosine, a root.
fn formula() -> Expr {
    let [m, l, v, theta, e, w, h] = ["m", "l", "v", "theta", "e", "w", "h"].map(Expr::symbol);
    let arm = &l * &theta.cos() * Expr::ratio(1, 2);
    let inverse = m.powi(-1) + arm.powi(2) * Expr::from(12) / (&m * &l.powi(2));
    let speed = &v * (v.powi(2) + &w * &h).power(Expr::ratio(-1, 2));
    (Expr::one() + &e) * (&v + &w * &arm) * &speed / inverse
        * (Expr::one() + Expr::from(3) * theta.sin().powi(2))
}

fn by_hand(x: &[f64]) -> f64 {
    let [m, l, v, theta, e, w, h] = [x[0], x[1], x[2], x[3], x[4], x[5], x[6]];
    let (sin, cos) = theta.sin_cos();
    let arm = l * cos / 2.0;
    let inverse = 1.0 / m + 12.0 * arm * arm / (m * l * l);
    let speed = v / (v * v + w * h).sqrt();
    (1.0 + e) * (v + w * arm) * speed / inverse * (1.0 + 3.0 * sin * sin)
}

fn program() -> Program {
    let order: Vec<Symbol> = ["m", "l", "v", "theta", "e", "w", "h"]
        .map(Symbol::from)
        .to_vec();
    compile(&formula(), &order).expect("every symbol is an input")
}

fn columns() -> Vec<Vec<f64>> {
    (0..7)
        .map(|i| {
            (0..POINTS)
                .map(|k| 0.2 + ((k * (2 * i + 3)) % 1013) as f64 / 1013.0)
                .collect()
        })
        .collect()
}

fn with_columns(bencher: Bencher, threads: usize, work: impl Fn(&[&[f64]], &mut [f64]) + Sync) {
    let columns = columns();
    let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let mut out = vec![0.0; POINTS];
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .expect("threads start");
    bencher
        .counter(ItemsCount::new(POINTS))
        .bench_local(|| pool.install(|| work(black_box(&columns), &mut out)));
}

#[divan::bench]
fn hand_written(bencher: Bencher) {
    with_columns(bencher, 1, |columns, out| {
        let mut x = [0.0; 7];
        for (i, out) in out.iter_mut().enumerate() {
            for (x, column) in x.iter_mut().zip(columns) {
                *x = column[i];
            }
            *out = by_hand(&x);
        }
    });
}

#[divan::bench]
fn program_one_point_at_a_time(bencher: Bencher) {
    let program = program();
    with_columns(bencher, 1, |columns, out| {
        let mut scratch = vec![0.0; program.slots()];
        let mut x = [0.0; 7];
        for (i, out) in out.iter_mut().enumerate() {
            for (x, column) in x.iter_mut().zip(columns) {
                *x = column[i];
            }
            *out = program.eval(&x, &mut scratch);
        }
    });
}

#[divan::bench(args = [1, 2])]
fn program_in_blocks(bencher: Bencher, threads: usize) {
    let program = program();
    with_columns(bencher, threads, |columns, out| {
        program.eval_all_parallel(columns, out)
    });
}
