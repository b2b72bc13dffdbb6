//! Exact numbers: integers that are machine words until they no longer fit, and the fractions made of them.
//!
//! Nearly every coefficient in mechanics fits a machine word, and a heap allocation per coefficient would cost more than
//! the arithmetic; [`Int`] therefore grows only when it has to, and never wraps. Fractions come from `num-rational`.

use std::borrow::Cow;
use std::cmp::Ordering;
use std::fmt;
use std::ops::{
    Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, RemAssign, Sub, SubAssign,
};

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_traits::{Float, Num, One, Signed, ToPrimitive, Zero};

/// An exact fraction in lowest terms with a positive denominator.
pub type Rational = num_rational::Ratio<Int>;

/// An integer power of ten.
pub fn ten_to(power: impl Into<i64>) -> Rational {
    let power: i64 = power.into();
    let raised = Int::from(10).pow(power.unsigned_abs() as u32);
    match power < 0 {
        true => Rational::new_raw(Int::from(1), raised),
        false => Rational::from(raised),
    }
}

/// a + b, or a − b: as the operator gives it, by machine words where all four numbers are some.
pub fn sum(a: &Rational, b: &Rational, minus: bool) -> Rational {
    let Some(([na, da], [nb, db])) = words(a).zip(words(b)) else {
        return sum_of_any(a, b, minus);
    };
    // With g = (a's, b's denominator), only what g has can cancel (Henrici 1956).
    let g = common(da, db);
    let (own, other) = (without(da, g), without(db, g));
    let (left, right) = (wide(na, other), wide(nb, own));
    let n = if minus { left - right } else { left + right };
    if g == 1 {
        return Rational::new_raw(Int::from(n), Int::from(wide(own, other)));
    }
    let shared = gcd(n, g.into());
    let below = i128::from(own) * (i128::from(db) / shared);
    Rational::new_raw(Int::from(n / shared), Int::from(below))
}

/// The same for numbers of any size.
fn sum_of_any(a: &Rational, b: &Rational, minus: bool) -> Rational {
    let ((na, da), (nb, db)) = ((a.numer(), a.denom()), (b.numer(), b.denom()));
    let g = da.gcd(db);
    let (left, right) = (na * &(db / &g), nb * &(da / &g));
    let n = if minus { left - right } else { left + right };
    if g.is_one() {
        return Rational::new_raw(n, da * db);
    }
    let shared = n.gcd(&g);
    Rational::new_raw(&n / &shared, (da / &g) * (db / &shared))
}

/// a·b, by machine words where all four numbers are some.
pub fn product(a: &Rational, b: &Rational) -> Rational {
    let Some(([na, da], [nb, db])) = words(a).zip(words(b)) else {
        let (g, h) = (a.numer().gcd(b.denom()), b.numer().gcd(a.denom()));
        let above = (a.numer() / &g) * (b.numer() / &h);
        return Rational::new_raw(above, (a.denom() / &h) * (b.denom() / &g));
    };
    let (g, h) = (common(na, db), common(nb, da));
    let above = wide(without(na, g), without(nb, h));
    let below = wide(without(da, h), without(db, g));
    Rational::new_raw(Int::from(above), Int::from(below))
}

/// Greatest common divisor of a word and a positive one.
fn common(n: i64, d: i64) -> i64 {
    match d {
        1 => 1,
        // No more than d, which is positive.
        _ => n.unsigned_abs().gcd(&d.unsigned_abs()) as i64,
    }
}

/// n/d for a positive divisor, which is 1 more often than not.
fn without(n: i64, d: i64) -> i64 {
    if d == 1 { n } else { n / d }
}

/// A product that cannot overflow.
fn wide(a: i64, b: i64) -> i128 {
    i128::from(a) * i128::from(b)
}

/// Whether a fraction is n/d, which is in lowest terms. Comparing fractions in general costs divisions.
pub fn is(x: &Rational, n: i64, d: i64) -> bool {
    x.numer().as_i64() == Some(n) && x.denom().as_i64() == Some(d)
}

/// Whether two fractions in lowest terms are the same; their own comparison divides.
pub fn same(x: &Rational, y: &Rational) -> bool {
    x.numer() == y.numer() && x.denom() == y.denom()
}

/// Whether a fraction in lowest terms is a whole number.
pub fn is_whole(x: &Rational) -> bool {
    x.denom().as_i64() == Some(1)
}

/// Numerator and denominator that fit a machine word.
fn words(x: &Rational) -> Option<[i64; 2]> {
    Some([x.numer().as_i64()?, x.denom().as_i64()?])
}

/// Greatest common divisor of any number and a positive word: 64-bit steps after the first.
pub(crate) fn gcd(n: i128, word: i128) -> i128 {
    let (n, word) = (n.unsigned_abs(), word.unsigned_abs());
    let rest = match (u64::try_from(n), u64::try_from(word)) {
        (Ok(n), Ok(word)) => u128::from(n % word),
        _ => n % word,
    };
    match (u64::try_from(rest), u64::try_from(word)) {
        (Ok(a), Ok(b)) => i128::from(a.gcd(&b)),
        _ => rest.gcd(&word) as i128,
    }
}

/// An integer of any size. Invariant: a value that fits an `i64` is always `Small`, so equality is structural.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Int(Repr);

#[derive(Clone, PartialEq, Eq, Hash)]
enum Repr {
    Small(i64),
    /// Behind a pointer: large numbers are rare, and every fraction of small ones is half as long.
    Big(Box<BigInt>),
}
use Repr::{Big, Small};

impl Int {
    /// The integer as a machine word, when it fits.
    pub fn as_i64(&self) -> Option<i64> {
        match self.0 {
            Small(value) => Some(value),
            Big(_) => None,
        }
    }

    /// The integer in the representation of `num-bigint`.
    pub fn to_bigint(&self) -> BigInt {
        self.big().into_owned()
    }

    /// The same, borrowed where it is large already.
    fn big(&self) -> Cow<'_, BigInt> {
        match &self.0 {
            Small(value) => Cow::Owned(BigInt::from(*value)),
            Big(value) => Cow::Borrowed(value),
        }
    }

    /// Number of bits of the absolute value; 0 for zero.
    pub fn bits(&self) -> u64 {
        match &self.0 {
            Small(value) => u64::from(64 - value.unsigned_abs().leading_zeros()),
            Big(value) => value.bits(),
        }
    }

    /// Integer power. The caller bounds `exponent`; see the limits of the formula reader.
    pub fn pow(&self, exponent: u32) -> Int {
        match &self.0 {
            Small(value) => match value.checked_pow(exponent) {
                Some(result) => Int(Small(result)),
                None => Int::from(BigInt::from(*value).pow(exponent)),
            },
            Big(value) => Int::from(value.pow(exponent)),
        }
    }

    /// The integer whose square this is, where there is one.
    pub fn square_root(&self) -> Option<Int> {
        match &self.0 {
            Small(value) => {
                let root = value.checked_isqrt()?;
                (root * root == *value).then_some(Int(Small(root)))
            }
            Big(value) if value.is_negative() => None,
            Big(value) => {
                // Powers of two, as in long decimals and halves, cost no search.
                let zeros = value.trailing_zeros().unwrap_or(0);
                if zeros % 2 == 1 {
                    return None;
                }
                let odd = &**value >> zeros;
                if !may_be_square(&odd) {
                    return None;
                }
                let root = odd.sqrt();
                (&root * &root == odd).then(|| Int::from(root << (zeros / 2)))
            }
        }
    }
}

/// Whether an odd integer leaves the remainders that squares leave: of those that are no squares 1 in 1 000 does. The root of
/// a long integer costs as much as some hundred products.
fn may_be_square(odd: &BigInt) -> bool {
    const MODULI: [u64; 8] = [8, 63, 65, 11, 17, 19, 23, 31];
    let Some(remainder) = (odd % MODULI.iter().product::<u64>()).to_u64() else {
        return true;
    };
    let leaves = |m: u64| (0..=m / 2).any(|k| k * k % m == remainder % m);
    MODULI.into_iter().all(leaves)
}

impl From<i32> for Int {
    fn from(value: i32) -> Int {
        Int(Small(i64::from(value)))
    }
}

impl From<i64> for Int {
    fn from(value: i64) -> Int {
        Int(Small(value))
    }
}

impl From<i128> for Int {
    fn from(value: i128) -> Int {
        match i64::try_from(value) {
            Ok(small) => Int(Small(small)),
            Err(_) => Int(Big(Box::new(BigInt::from(value)))),
        }
    }
}

impl From<BigInt> for Int {
    fn from(value: BigInt) -> Int {
        match value.to_i64() {
            Some(small) => Int(Small(small)),
            None => Int(Big(Box::new(value))),
        }
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $assign_trait:ident, $assign:ident, $checked:ident, $symbol:tt) => {
        impl<'a> $trait<&'a Int> for &'a Int {
            type Output = Int;
            fn $method(self, other: &Int) -> Int {
                if let (Small(a), Small(b)) = (&self.0, &other.0) {
                    if let Some(result) = a.$checked(*b) {
                        return Int(Small(result));
                    }
                }
                Int::from(&*self.big() $symbol &*other.big())
            }
        }
        impl $trait for Int {
            type Output = Int;
            fn $method(self, other: Int) -> Int {
                &self $symbol &other
            }
        }
        impl $trait<&Int> for Int {
            type Output = Int;
            fn $method(self, other: &Int) -> Int {
                &self $symbol other
            }
        }
        impl $assign_trait<&Int> for Int {
            fn $assign(&mut self, other: &Int) {
                *self = &*self $symbol other;
            }
        }
        impl $assign_trait for Int {
            fn $assign(&mut self, other: Int) {
                *self = &*self $symbol &other;
            }
        }
    };
}
operator!(Add, add, AddAssign, add_assign, checked_add, +);
operator!(Sub, sub, SubAssign, sub_assign, checked_sub, -);
operator!(Mul, mul, MulAssign, mul_assign, checked_mul, *);
operator!(Div, div, DivAssign, div_assign, checked_div, /);
operator!(Rem, rem, RemAssign, rem_assign, checked_rem, %);

impl Neg for Int {
    type Output = Int;
    fn neg(self) -> Int {
        match self.0 {
            Small(value) => Int::from(-i128::from(value)),
            Big(value) => Int::from(-*value),
        }
    }
}

impl Neg for &Int {
    type Output = Int;
    fn neg(self) -> Int {
        -self.clone()
    }
}

impl Ord for Int {
    fn cmp(&self, other: &Int) -> Ordering {
        match (&self.0, &other.0) {
            (Small(a), Small(b)) => a.cmp(b),
            // A big value lies outside the range of every small one, so its sign alone decides.
            (Big(a), Small(_)) => a.sign().cmp(&Sign::NoSign),
            (Small(_), Big(b)) => Sign::NoSign.cmp(&b.sign()),
            (Big(a), Big(b)) => a.cmp(b),
        }
    }
}

impl PartialOrd for Int {
    fn partial_cmp(&self, other: &Int) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Zero for Int {
    fn zero() -> Int {
        Int(Small(0))
    }
    fn is_zero(&self) -> bool {
        self.0 == Small(0)
    }
}

impl One for Int {
    fn one() -> Int {
        Int(Small(1))
    }
    fn is_one(&self) -> bool {
        self.0 == Small(1)
    }
}

impl Num for Int {
    type FromStrRadixErr = num_bigint::ParseBigIntError;
    fn from_str_radix(text: &str, radix: u32) -> Result<Int, Self::FromStrRadixErr> {
        BigInt::from_str_radix(text, radix).map(Int::from)
    }
}

impl Signed for Int {
    fn abs(&self) -> Int {
        match self.is_negative() {
            true => -self,
            false => self.clone(),
        }
    }
    fn abs_sub(&self, other: &Int) -> Int {
        (self - other).max(Int::zero())
    }
    fn signum(&self) -> Int {
        Int(Small(self.cmp(&Int::zero()) as i64))
    }
    fn is_positive(&self) -> bool {
        *self > Int::zero()
    }
    fn is_negative(&self) -> bool {
        *self < Int::zero()
    }
}

impl Integer for Int {
    fn div_floor(&self, other: &Int) -> Int {
        match (&self.0, &other.0) {
            // i64::MIN / -1 is the one small quotient that does not fit.
            (Small(a), Small(b)) if *b != -1 => Int(Small(a.div_floor(b))),
            _ => Int::from(self.big().div_floor(&other.big())),
        }
    }
    fn mod_floor(&self, other: &Int) -> Int {
        match (&self.0, &other.0) {
            (Small(a), Small(b)) if *b != -1 => Int(Small(a.mod_floor(b))),
            _ => Int::from(self.big().mod_floor(&other.big())),
        }
    }
    fn gcd(&self, other: &Int) -> Int {
        match (&self.0, &other.0) {
            (Small(a), Small(b)) => Int::from(i128::from(a.unsigned_abs().gcd(&b.unsigned_abs()))),
            // One step of Euclid's brings the large one down to a word.
            (Big(large), Small(word)) | (Small(word), Big(large)) if *word != 0 => {
                let rest = &**large % word.unsigned_abs();
                let rest = rest.magnitude().to_u64().unwrap_or(0);
                Int::from(i128::from(rest.gcd(&word.unsigned_abs())))
            }
            (Small(0), _) => other.abs(),
            (_, Small(0)) => self.abs(),
            _ => {
                let (a, b) = (self.big(), other.big());
                let [i, j] = [&a, &b].map(|n| n.trailing_zeros().unwrap_or(0));
                // Long decimals and halves have powers of two below, and little else.
                let [one, two] = [&*a >> i, &*b >> j].map(Int::from);
                match (&one.0, &two.0) {
                    (Big(one), Big(two)) => Int::from(one.gcd(two) << i.min(j)),
                    _ => Int::from(one.gcd(&two).to_bigint() << i.min(j)),
                }
            }
        }
    }
    fn lcm(&self, other: &Int) -> Int {
        if self.is_zero() || other.is_zero() {
            return Int::zero();
        }
        (self / &self.gcd(other) * other).abs()
    }
    fn divides(&self, other: &Int) -> bool {
        self.is_multiple_of(other)
    }
    fn is_multiple_of(&self, other: &Int) -> bool {
        match other.is_zero() {
            true => self.is_zero(),
            false => (self % other).is_zero(),
        }
    }
    fn is_even(&self) -> bool {
        match &self.0 {
            Small(value) => value & 1 == 0,
            Big(value) => value.is_even(),
        }
    }
    fn is_odd(&self) -> bool {
        !self.is_even()
    }
    fn div_rem(&self, other: &Int) -> (Int, Int) {
        (self / other, self % other)
    }
}

impl ToPrimitive for Int {
    fn to_i64(&self) -> Option<i64> {
        self.as_i64()
    }
    fn to_u64(&self) -> Option<u64> {
        self.big().to_u64()
    }
    fn to_f64(&self) -> Option<f64> {
        match &self.0 {
            Small(value) => Some(*value as f64),
            Big(value) => value.to_f64(),
        }
    }
}

impl fmt::Display for Int {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Small(value) => value.fmt(f),
            Big(value) => value.fmt(f),
        }
    }
}

impl fmt::Debug for Int {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// The fraction `numerator / denominator`; `denominator` must not be zero.
pub fn ratio(numerator: i64, denominator: i64) -> Rational {
    let shared = match denominator {
        1 => 1,
        d if d > 0 => gcd(numerator.into(), d.into()) as i64,
        _ => return Rational::new(Int::from(numerator), Int::from(denominator)),
    };
    let [above, below] = [numerator, denominator].map(|word| Int::from(word / shared));
    Rational::new_raw(above, below)
}

/// The exact square root of a fraction, when it is a fraction too.
pub fn sqrt_exact(value: &Rational) -> Option<Rational> {
    let root = value.numer().square_root()?;
    Some(Rational::new_raw(root, value.denom().square_root()?))
}

/// Nearest double, correctly rounded (ties to even), also where numerator or denominator leave the range of doubles.
pub fn to_f64(value: &Rational) -> f64 {
    let (n, d) = (value.numer(), value.denom());
    if let (Some(a), Some(b)) = (n.as_i64(), d.as_i64()) {
        // Both exact in a double: one correctly rounded division.
        if a.unsigned_abs() <= 1 << 53 && b.unsigned_abs() <= 1 << 53 {
            return a as f64 / b as f64;
        }
    }
    // num-rational rounds correctly for big integers.
    num_rational::BigRational::new_raw(n.to_bigint(), d.to_bigint())
        .to_f64()
        .unwrap_or(f64::NAN)
}

/// The exact value of a double; `None` for infinities and NaN.
pub fn from_f64(value: f64) -> Option<Rational> {
    if !value.is_finite() {
        return None;
    }
    let (mantissa, exponent, sign) = Float::integer_decode(value);
    let zeros = mantissa.trailing_zeros();
    let Some(odd) = mantissa.checked_shr(zeros) else {
        return Some(Rational::zero());
    };
    let numer = Int::from(i128::from(odd) * i128::from(sign));
    let exponent = i32::from(exponent) + zeros as i32;
    let power = Int::from(2).pow(exponent.unsigned_abs());
    Some(match exponent < 0 {
        true => Rational::new_raw(numer, power),
        false => Rational::from(numer * power),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arithmetic_leaves_machine_words_without_wrapping() {
        let max = Int::from(i64::MAX);
        assert_eq!((&max + &Int::one()).to_string(), "9223372036854775808");
        assert_eq!(
            (&max * &max).to_string(),
            "85070591730234615847396907784232501249"
        );
        assert_eq!(-Int::from(i64::MIN), &max + &Int::one());
        assert_eq!(
            Int::from(i64::MIN).gcd(&Int::from(i64::MIN)),
            &max + &Int::one()
        );
    }

    #[test]
    fn a_value_that_shrinks_is_small_again() {
        let big = Int::from(i64::MAX) + Int::one();
        assert_eq!(big - Int::one(), Int::from(i64::MAX));
    }

    #[test]
    fn squares_are_told_from_their_neighbours() {
        for root in [0i64, 1, 2, 7, 1 << 31, 3_037_000_499] {
            for long in [Int::one(), Int::from(3).pow(90), Int::from(2).pow(301)] {
                let root = &Int::from(root) * &long;
                let square = &root * &root;
                assert_eq!(square.square_root(), Some(root.clone()));
                for (near, off) in [(-1, Int::from(4)), (1, Int::zero()), (2, Int::zero())] {
                    let near = &square + &Int::from(near);
                    assert!(square <= off || near.square_root().is_none(), "{near}");
                }
            }
        }
        assert_eq!(Int::from(-4).square_root(), None);
    }

    #[test]
    fn big_values_order_by_sign_against_small_ones() {
        let big = Int::from(10).pow(30);
        assert!(big > Int::from(5) && -big < Int::from(i64::MIN));
    }

    #[test]
    fn doubles_are_nearest() {
        assert_eq!(to_f64(&ratio(1, 3)), 1.0 / 3.0);
        let third = Rational::new(Int::from(10).pow(40), Int::from(3) * Int::from(10).pow(40));
        assert_eq!(to_f64(&third), 1.0 / 3.0);
        assert_eq!(from_f64(0.1).map(|r| to_f64(&r)), Some(0.1));
    }
}
