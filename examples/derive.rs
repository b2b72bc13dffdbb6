//! Reads a scene, derives its closed forms, proves them and prints both: `cargo run --example derive [SCENE]`.

use carom::{render, scene, worked};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1);
    let path = path.unwrap_or_else(|| String::from("derivations/book/falling-stick.json"));
    let text = std::fs::read_to_string(&path)?;
    let scene = scene::read(&text).map_err(|faults| faults.render(&path, &text))?;
    let worked = worked::out(&scene)?;
    print!("{}", render::text::told(&worked.scene, &worked.told));
    assert!(worked.holds(), "a closed form is not proved");
    Ok(())
}
