//! Evaluates a closed form, arranged for accuracy, at a million points: `cargo run --release --example million`.

use std::time::Instant;

use carom::emit::functions;
use carom::{derive, scene};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = "derivations/book/falling-stick.json";
    let text = std::fs::read_to_string(path)?;
    let scene = scene::read(&text).map_err(|faults| faults.render(path, &text))?;
    let derivation = derive::derive(&scene)?;
    let (found, _) = functions(&scene, &derivation);
    let omega = found.iter().find(|f| f.name == "omega").ok_or("no omega")?;
    let start = Instant::now();
    let (mut inputs, mut slots) = (Vec::new(), Vec::new());
    let mut largest: f64 = 0.0;
    let count = 1_000_000;
    for i in 0..count {
        let share = f64::from(i) / f64::from(count);
        // l = 1 m, v from 0 to 2 m/s, theta from 0 to a right angle.
        let arguments = [1.0, 2.0 * share, std::f64::consts::FRAC_PI_2 * share];
        largest = largest.max(omega.value(&arguments, &mut inputs, &mut slots));
    }
    println!("{} = {}", omega.name, omega.formula);
    println!("largest of {count}: {largest} {}", omega.words);
    println!("{:.0?} a point", start.elapsed() / count);
    Ok(())
}
