//! Pictures as PNG.

use carom::figure::png;

#[test]
fn a_png_has_letters_without_fonts_of_the_system() {
    let drawn = |inside: &str| {
        png(&format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='40' height='20'>{inside}</svg>"
        ))
        .expect("PNG")
    };
    let with = drawn("<text x='2' y='15' font-family='serif'>θ</text>");
    assert_eq!(&with[..4], b"\x89PNG");
    assert_ne!(with, drawn(""));
    assert!(png("<svg").is_err());
}
