//! The numbers by which the points of a pair are drawn: a strong hash of both texts, in no order, with what is declared.
//!
//! Whoever writes a formula fixes the points by it, and cannot aim at them; every machine and either order reach the same.

use sha2::{Digest, Sha256};

use crate::domain::Domains;

/// One number for each lane.
pub(super) fn rounds<const L: usize>(texts: [&str; 2], declared: &[u8]) -> [u64; L] {
    let [mut a, mut b] = texts;
    if b < a {
        (a, b) = (b, a);
    }
    let mut hash = Sha256::new();
    hash.update((a.len() as u64).to_le_bytes());
    hash.update(a);
    hash.update(b);
    hash.update([0]);
    hash.update(declared);
    let digest = hash.finalize();
    let mut words = [0u64; 4];
    for (word, bytes) in words.iter_mut().zip(digest.chunks_exact(8)) {
        *word = bytes.iter().fold(0, |w, b| w << 8 | u64::from(*b));
    }
    // Lanes beyond the fourth are far from the others in the same sequences.
    std::array::from_fn(|lane| {
        words[lane % 4].wrapping_add((lane / 4) as u64 * 0x5851_f42d_4c95_7f2d)
    })
}

/// What is declared, as bytes.
pub(super) fn declared(domains: &Domains) -> Vec<u8> {
    let mut out = Vec::new();
    for (name, domain) in &domains.symbols {
        out.extend(domain.words(name).as_bytes());
        out.push(b';');
    }
    for [a, b] in &domains.unit_vectors {
        out.extend([a.as_bytes(), b",", b.as_bytes(), b";"].concat());
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_hang_on_both_texts_in_no_order() {
        let drawn = |a: &str, b: &str| rounds::<8>([a, b], b"x > 0;");
        assert_eq!(drawn("x", "y"), drawn("y", "x"));
        assert_ne!(drawn("x", "y"), drawn("x", "y "));
        assert_ne!(drawn("xy", "z"), drawn("x", "yz"));
        let mut lanes = drawn("x", "y").to_vec();
        lanes.sort_unstable();
        lanes.dedup();
        assert_eq!(lanes.len(), 8);
    }
}
