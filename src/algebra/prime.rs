//! Arithmetic modulo a prime 2⁶¹ − C, on machine words.

/// The prime for formulas without roots: C = 1.
pub(crate) const PLAIN: u64 = 1;
/// The prime for roots, found by trying: it is 7 modulo 8, and every prime up to [`SMOOTH`] is a square modulo it, so that
/// a root of a positive constant made of them can be taken, and −1 is no square.
pub(crate) const ROOTS: u64 = 139_666_593;
/// The largest prime of which, and of all below, the roots exist.
pub(crate) const SMOOTH: u64 = 83;

const MASK: u64 = (1 << 61) - 1;

/// The modulus.
pub(crate) const fn prime<const C: u64>() -> u64 {
    (1 << 61) - C
}

/// A number below twice the modulus as a residue.
#[inline]
fn folded(x: u64, modulus: u64) -> u64 {
    if x >= modulus { x - modulus } else { x }
}

/// a + b of residues.
#[inline]
pub(crate) fn add<const C: u64>(a: u64, b: u64) -> u64 {
    folded(a + b, prime::<C>())
}

/// −a of a residue.
#[inline]
pub(crate) fn negative<const C: u64>(a: u64) -> u64 {
    if a == 0 { 0 } else { prime::<C>() - a }
}

/// a·b of residues. Modulo the Mersenne prime they stand for themselves; modulo the other one a residue stands for itself
/// times 2⁶⁴, so that products are reduced without division (Montgomery).
#[inline]
pub(crate) fn times<const C: u64>(a: u64, b: u64) -> u64 {
    let wide = u128::from(a) * u128::from(b);
    if C == PLAIN {
        let sum = (wide as u64 & MASK) + (wide >> 61) as u64;
        return folded((sum & MASK) + (sum >> 61), MASK);
    }
    let factor = (wide as u64).wrapping_mul(inverse::<C>());
    let below = (u128::from(factor) * u128::from(prime::<C>())) >> 64;
    let (difference, borrow) = ((wide >> 64) as u64).overflowing_sub(below as u64);
    if borrow {
        difference.wrapping_add(prime::<C>())
    } else {
        difference
    }
}

/// The inverse of the prime modulo 2⁶⁴, by Newton's rule.
const fn inverse<const C: u64>() -> u64 {
    let p = prime::<C>();
    let mut x = p;
    let mut round = 0;
    while round < 6 {
        x = x.wrapping_mul(2u64.wrapping_sub(p.wrapping_mul(x)));
        round += 1;
    }
    x
}

/// What stands for 1.
pub(crate) const fn one<const C: u64>() -> u64 {
    if C == PLAIN {
        1
    } else {
        ((1u128 << 64) % prime::<C>() as u128) as u64
    }
}

/// What stands for a number.
pub(crate) fn residue<const C: u64>(x: u64) -> u64 {
    let x = x % prime::<C>();
    if C == PLAIN {
        return x;
    }
    let square = const { (u128::MAX % prime::<C>() as u128 + 1) as u64 };
    times::<C>(x, square)
}

/// a to a power.
pub(crate) fn power<const C: u64>(mut a: u64, mut k: u64) -> u64 {
    let mut result = one::<C>();
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
pub(crate) fn powers<const C: u64, const L: usize>(mut a: [u64; L], mut k: u64) -> [u64; L] {
    let mut result = [one::<C>(); L];
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
pub(crate) fn roots<const C: u64, const L: usize>(a: [u64; L]) -> [u64; L] {
    // p is 3 modulo 4. The exponent is mostly ones in binary: runs of them are built by doubling.
    let up = |mut x: [u64; L], count: u32| {
        for _ in 0..count {
            x = each(x, x, times::<C>);
        }
        x
    };
    let k = (prime::<C>() + 1) / 4;
    let ones = (k << 5).leading_ones();
    let mut run = a;
    let mut length = 1;
    // a to the power of 2^ones − 1, bit by bit of `ones`.
    for bit in (0..ones.ilog2()).rev() {
        run = each(up(run, length), run, times::<C>);
        length *= 2;
        if ones >> bit & 1 == 1 {
            run = each(up(run, 1), a, times::<C>);
            length += 1;
        }
    }
    let rest = 59 - ones;
    let low = powers::<C, L>(a, k & ((1 << rest) - 1));
    each(up(run, rest), low, times::<C>)
}

/// Applies an operation lane by lane.
#[inline]
pub(crate) fn each<const L: usize>(
    mut a: [u64; L],
    b: [u64; L],
    f: impl Fn(u64, u64) -> u64,
) -> [u64; L] {
    for (x, y) in a.iter_mut().zip(b) {
        *x = f(*x, y);
    }
    a
}

/// A hash of a name, from which its values are drawn.
#[inline]
pub(crate) fn seed(name: &str) -> u64 {
    name.bytes().fold(0xcbf2_9ce4_8422_2325u64, |h, b| {
        (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// A residue for a seed and a round; the same on every machine and in every run.
#[inline]
pub(crate) fn random<const C: u64>(seed: u64, round: u64) -> u64 {
    let mut z = seed ^ (round + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    folded((z ^ (z >> 31)) & MASK, prime::<C>())
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
            let (a, b) = (random::<PLAIN>(1, round), random::<PLAIN>(2, round));
            assert_eq!(times::<PLAIN>(a, b), naive(a, b, prime::<PLAIN>()));
            let product = naive(a, b, prime::<ROOTS>());
            let (x, y) = (residue::<ROOTS>(a), residue::<ROOTS>(b));
            assert_eq!(times::<ROOTS>(x, y), residue::<ROOTS>(product));
            assert!(x < prime::<ROOTS>());
        }
        let last = prime::<PLAIN>() - 1;
        assert_eq!(times::<PLAIN>(last, last), 1);
        let minus_one = negative::<ROOTS>(one::<ROOTS>());
        assert_eq!(times::<ROOTS>(minus_one, minus_one), one::<ROOTS>());
        assert_eq!(one::<ROOTS>(), residue::<ROOTS>(1));
    }

    #[test]
    fn small_primes_are_squares_and_minus_one_is_none() {
        let prime_numbers = (2..=SMOOTH).filter(|n| (2..*n).all(|d| n % d != 0));
        for q in prime_numbers.map(residue::<ROOTS>) {
            let [root] = roots::<ROOTS, 1>([q]);
            assert_eq!(times::<ROOTS>(root, root), q);
        }
        let minus_one = negative::<ROOTS>(one::<ROOTS>());
        let [root] = roots::<ROOTS, 1>([minus_one]);
        assert_ne!(times::<ROOTS>(root, root), minus_one);
        // Fermat: both moduli at least look like primes.
        for base in [2, 3, 5, 7, 11, 13] {
            let plain = power::<PLAIN>(base, prime::<PLAIN>() - 1);
            assert_eq!(plain, 1);
            let roots = power::<ROOTS>(residue::<ROOTS>(base), prime::<ROOTS>() - 1);
            assert_eq!(roots, one::<ROOTS>());
        }
    }
}
