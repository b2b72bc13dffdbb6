//! Real numbers as doubles with a bound on their error: rigorous, and quick enough to stand beside every residue.
//!
//! An error that is not a number means that nothing is known; every comparison with it fails.

/// A number and how far the true one may be off.
#[derive(Clone, Copy, Debug)]
pub(super) struct Real {
    value: f64,
    error: f64,
}

/// Twice the unit roundoff: room for the rounding of the bounds as well.
const ROUND: f64 = f64::EPSILON;
/// What underflow can lose, with room.
const TINY: f64 = 1e-300;

impl Real {
    /// The circle constant.
    pub const PI: Real = Real {
        value: std::f64::consts::PI,
        error: 1e-15,
    };

    /// A double that is meant as it is.
    pub fn exact(value: f64) -> Real {
        Real { value, error: 0.0 }
    }

    fn rounded(value: f64, error: f64) -> Real {
        Real {
            value,
            error: (error + value.abs() * ROUND) * (1.0 + 16.0 * ROUND) + TINY,
        }
    }

    /// A quotient of whole numbers.
    pub fn quotient(above: u64, below: u64) -> Real {
        let value = above as f64 / below as f64;
        Real::rounded(value, value * 4.0 * ROUND)
    }

    /// Cosine and sine near an angle: exactly those of some angle, which is all that is asked.
    pub fn unit(angle: Real) -> [Real; 2] {
        let t = Real::exact((angle.value / 2.0).tan());
        let square = t.times(t);
        let below = Real::exact(1.0).plus(square).inverse();
        let cos = Real::exact(1.0).plus(square.negative()).times(below);
        [cos, t.plus(t).times(below)]
    }

    #[inline]
    pub fn plus(self, other: Real) -> Real {
        Real::rounded(self.value + other.value, self.error + other.error)
    }

    #[inline]
    pub fn negative(self) -> Real {
        Real {
            value: -self.value,
            ..self
        }
    }

    #[inline]
    pub fn times(self, other: Real) -> Real {
        let error = self.value.abs() * other.error
            + other.value.abs() * self.error
            + self.error * other.error;
        Real::rounded(self.value * other.value, error)
    }

    #[inline]
    pub fn inverse(self) -> Real {
        let size = self.value.abs();
        let nearest = size - self.error;
        // So near to 0 that it could be 0: unknown.
        let nearest = if nearest > size * 1e-6 {
            nearest
        } else {
            f64::NAN
        };
        Real::rounded(1.0 / self.value, self.error / (size * nearest))
    }

    #[inline]
    pub fn sqrt(self) -> Real {
        // Unknown where the radicand could be negative.
        let root = if self.value - self.error > self.value * 1e-6 {
            self.value.sqrt()
        } else {
            f64::NAN
        };
        Real::rounded(root, self.error / root)
    }

    pub fn power(self, mut k: u32) -> Real {
        let (mut result, mut square) = (Real::exact(1.0), self);
        loop {
            if k & 1 == 1 {
                result = result.times(square);
            }
            k >>= 1;
            if k == 0 {
                return result;
            }
            square = square.times(square);
        }
    }

    /// Whether two numbers differ for certain.
    #[inline]
    pub fn apart(&self, other: &Real) -> bool {
        let room = (self.error + other.error) * (1.0 + 16.0 * ROUND);
        let size = self.value.abs().max(other.value.abs());
        // Beyond what errors can reach; so is the rounding of this difference.
        (self.value - other.value).abs() > room + size * 4.0 * ROUND && room.is_finite()
    }

    /// Whether something is known: the number is real and not too large.
    pub fn is_known(&self) -> bool {
        self.value.is_finite() && self.error.is_finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn true_values_stay_within_the_error() {
        let third = Real::quotient(1, 3);
        let one = third.plus(third).plus(third);
        assert!(!one.apart(&Real::exact(1.0)) && one.error < 1e-14);
        let two = Real::exact(2.0).sqrt().power(2);
        assert!(!two.apart(&Real::exact(2.0)) && two.error < 1e-14);
        let [cos, sin] = Real::unit(Real::exact(0.7));
        assert!(!cos.power(2).plus(sin.power(2)).apart(&Real::exact(1.0)));
        assert!(Real::exact(1.0).apart(&Real::exact(1.0 + 1e-9)));
    }

    #[test]
    fn what_could_be_zero_or_negative_is_unknown() {
        let zero = third_three_times().plus(Real::exact(-1.0));
        assert!(!zero.inverse().is_known() && !zero.sqrt().is_known());
        assert!(!Real::exact(-1.0).sqrt().is_known());
        assert!(!Real::exact(-1.0).sqrt().apart(&Real::exact(5.0)));
    }

    fn third_three_times() -> Real {
        let third = Real::quotient(1, 3);
        third.plus(third).plus(third)
    }
}
