//! Evaluates a closed form, arranged for accuracy, at a million points: `cargo run --release --example million`.

use std::time::Instant;

use carom::emit::{Function, functions};
use carom::{derive, scene};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = "derivations/book/falling-stick.json";
    let text = std::fs::read_to_string(path)?;
    let scene = scene::read(&text).map_err(|faults| faults.render(path, &text))?;
    let derivation = derive::derive(&scene)?;
    let (found, _) = functions(&scene, &derivation);
    let omega = found.iter().find(|f| f.name == "omega").ok_or("no omega")?;
    let start = Instant::now();
    let (mut largest, mut slots): (f64, Vec<_>) = (0.0, Vec::new());
    let count = 1_000_000;
    for i in 0..count {
        let share = f64::from(i) / f64::from(count);
        // l = 1 m, v from 0 to 2 m/s, theta from 0 to a right angle.
        let inputs = inputs(
            omega,
            &[1.0, 2.0 * share, std::f64::consts::FRAC_PI_2 * share],
        );
        largest = largest.max(omega.program.value(&inputs, &mut slots));
    }
    println!("{} = {}", omega.name, omega.formula);
    println!("largest of {count}: {largest} {}", omega.words);
    println!("{:.0?} a point", start.elapsed() / count);
    Ok(())
}

/// The arguments, and behind them the cosines and sines that the program takes.
fn inputs(f: &Function, arguments: &[f64]) -> Vec<f64> {
    let mut inputs = arguments.to_vec();
    inputs.resize(f.program.inputs, 0.0);
    for turn in &f.turns {
        let angle: f64 = turn.terms.iter().map(|(k, a)| k * arguments[*a]).sum();
        if let Some(cos) = turn.cos {
            inputs[cos] = angle.cos();
        }
        if let Some(sin) = turn.sin {
            inputs[sin] = angle.sin();
        }
    }
    inputs
}
