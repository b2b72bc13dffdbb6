//! Time and error of struck chains of n rods, n from 10 to 10⁶: one line of JSON per chain and route.

use carom::report::growth::{CROOKED, Chain, measure};

fn main() {
    for exponent in 1..=6 {
        let rods = 10_usize.pow(exponent);
        let chains = [
            ("crooked", Chain::repeating(rods, &CROOKED, [0.5, 2.0])),
            (
                "straight",
                Chain::repeating(rods, &[[1.0, 0.0]], [1.0, 2.0]),
            ),
        ];
        for (name, chain) in chains {
            for row in measure(&chain, if rods < 100_000 { 9 } else { 3 }) {
                let line = serde_json::json!({
                    "chain": name, "rods": row.rods, "route": row.route, "seconds": row.seconds,
                    "error": row.error, "relative_error": row.relative_error,
                });
                println!("{line}");
            }
        }
    }
}
