//! The font that formulas of a page are set in, carried by the page itself, so that every system shows them alike.
//!
//! The font and its licence lie in `fonts/`.

/// A subset of STIX Math: letters, digits, signs, accents, stretching brackets; about 28 kB.
pub const MATH: &[u8] = include_bytes!("fonts/carom-math.woff2");

/// The rule of a style sheet that brings the font.
pub fn face() -> String {
    format!(
        "@font-face{{font-family:'carom math';src:url(data:font/woff2;base64,{}) format('woff2')}}",
        base64(MATH)
    )
}

/// Bytes in the alphabet of RFC 4648.
pub(super) fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len() * 4 / 3 + 4);
    for three in bytes.chunks(3) {
        let byte = |i: usize| u32::from(three.get(i).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for k in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * k)) as usize & 63];
            out.push(if k > three.len() {
                '='
            } else {
                char::from(letter)
            });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::base64;

    #[test]
    fn the_examples_of_the_standard() {
        for (bytes, text) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(base64(bytes.as_bytes()), text);
        }
    }
}
