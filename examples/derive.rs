//! Reads a scene, derives its closed forms, proves them and prints both: `cargo run --example derive [SCENE]`.

use carom::{derive, render, scene, verify};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1);
    let path = path.unwrap_or_else(|| String::from("derivations/book/falling-stick.json"));
    let text = std::fs::read_to_string(&path)?;
    let scene = scene::read(&text).map_err(|faults| faults.render(&path, &text))?;
    let derivation = derive::derive(&scene)?;
    let proof = verify::prove(&scene, &derivation);
    let possible = verify::possible::judge(&scene, &derivation);
    print!(
        "{}",
        render::text::derivation(&scene, &derivation, &proof, &possible, &[])
    );
    assert!(proof.holds(), "a closed form is not proved");
    Ok(())
}
