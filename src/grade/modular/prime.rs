//! Arithmetic modulo a prime 2⁶¹ − C, on machine words.

/// The prime for formulas without roots: C = 1.
pub(super) const PLAIN: u64 = 1;
/// The prime for roots, found by trying: it is 7 modulo 8, and every prime up to [`SMOOTH`] is a square modulo it, so that
/// a root of a positive constant made of them can be taken, and −1 is no square.
pub(super) const ROOTS: u64 = 139_666_593;
/// The largest prime of which, and of all below, the roots exist.
pub(super) const SMOOTH: u64 = 83;

const MASK: u64 = (1 << 61) - 1;

/// The modulus.
pub(super) const fn prime<const C: u64>() -> u64 {
    (1 << 61) - C
}

/// a + b of residues.
#[inline]
pub(super) fn add<const C: u64>(a: u64, b: u64) -> u64 {
    let sum = a + b;
    if sum >= prime::<C>() {
        sum - prime::<C>()
    } else {
        sum
    }
}

/// −a of a residue.
#[inline]
pub(super) fn negative<const C: u64>(a: u64) -> u64 {
    if a == 0 { 0 } else { prime::<C>() - a }
}

/// a·b of residues.
#[inline]
pub(super) fn times<const C: u64>(a: u64, b: u64) -> u64 {
    let wide = u128::from(a) * u128::from(b);
    let (low, high) = (wide as u64 & MASK, (wide >> 61) as u64);
    let once = if C == 1 {
        low + high
    } else {
        // 2⁶¹ is C; what is left above after the first fold has less than 29 bits, as C has.
        let again = u128::from(high) * u128::from(C) + u128::from(low);
        (again as u64 & MASK) + (again >> 61) as u64 * C
    };
    let folded = (once & MASK) + (once >> 61) * C;
    if folded >= prime::<C>() {
        folded - prime::<C>()
    } else {
        folded
    }
}

/// A residue of any number.
pub(super) fn residue<const C: u64>(x: u64) -> u64 {
    x % prime::<C>()
}

/// a to a power.
pub(super) fn power<const C: u64>(mut a: u64, mut k: u64) -> u64 {
    let mut result = 1;
    while k > 0 {
        if k & 1 == 1 {
            result = times::<C>(result, a);
        }
        a = times::<C>(a, a);
        k >>= 1;
    }
    result
}

/// The same power of several residues; they are raised side by side, which a processor likes.
#[inline]
pub(super) fn powers<const C: u64, const L: usize>(mut a: [u64; L], mut k: u64) -> [u64; L] {
    let mut result = [1; L];
    while k > 0 {
        if k & 1 == 1 {
            result = each(result, a, times::<C>);
        }
        a = each(a, a, times::<C>);
        k >>= 1;
    }
    result
}

/// For each residue its root that is a square itself; what is none comes out as something whose square is not the residue.
pub(super) fn roots<const C: u64, const L: usize>(a: [u64; L]) -> [u64; L] {
    // p is 3 modulo 4.
    powers::<C, L>(a, (prime::<C>() + 1) / 4)
}

/// Applies an operation lane by lane.
#[inline]
pub(super) fn each<const L: usize>(
    mut a: [u64; L],
    b: [u64; L],
    f: impl Fn(u64, u64) -> u64,
) -> [u64; L] {
    for (x, y) in a.iter_mut().zip(b) {
        *x = f(*x, y);
    }
    a
}

/// A number for a name and a round; the same on every machine and in every run.
pub(super) fn random<const C: u64>(name: &[u8], round: u64) -> u64 {
    let hash = name.iter().fold(0xcbf2_9ce4_8422_2325u64, |h, b| {
        (h ^ u64::from(*b)).wrapping_mul(0x0100_0000_01b3)
    });
    let mut z = hash ^ (round + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z ^ (z >> 31)) % (prime::<C>() - 2) + 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn naive(a: u64, b: u64, p: u64) -> u64 {
        (u128::from(a) * u128::from(b) % u128::from(p)) as u64
    }

    #[test]
    fn products_are_those_of_long_division() {
        for round in 0..2000 {
            let (a, b) = (random::<PLAIN>(b"a", round), random::<PLAIN>(b"b", round));
            assert_eq!(times::<PLAIN>(a, b), naive(a, b, prime::<PLAIN>()));
            let (a, b) = (a % prime::<ROOTS>(), b % prime::<ROOTS>());
            assert_eq!(times::<ROOTS>(a, b), naive(a, b, prime::<ROOTS>()));
        }
        for p in [prime::<PLAIN>(), prime::<ROOTS>()] {
            assert_eq!(naive(p - 1, p - 1, p), 1);
        }
        let last = prime::<ROOTS>() - 1;
        assert_eq!(times::<ROOTS>(last, last), 1);
        let last = prime::<PLAIN>() - 1;
        assert_eq!(times::<PLAIN>(last, last), 1);
    }

    #[test]
    fn small_primes_are_squares_and_minus_one_is_none() {
        let prime_numbers = (2..=SMOOTH).filter(|n| (2..*n).all(|d| n % d != 0));
        for q in prime_numbers {
            let [root] = roots::<ROOTS, 1>([q]);
            assert_eq!(times::<ROOTS>(root, root), q, "{q}");
        }
        let [root] = roots::<ROOTS, 1>([prime::<ROOTS>() - 1]);
        assert_ne!(times::<ROOTS>(root, root), prime::<ROOTS>() - 1);
        // Fermat: both moduli at least look like primes.
        for base in [2, 3, 5, 7, 11, 13] {
            assert_eq!(power::<PLAIN>(base, prime::<PLAIN>() - 1), 1);
            assert_eq!(power::<ROOTS>(base, prime::<ROOTS>() - 1), 1);
        }
    }
}
