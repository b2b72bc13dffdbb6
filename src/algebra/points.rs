//! Sample points of a domain, and what is seen at them.

/// Points at which an unproved sign is looked at. Enough that a sign change over a tenth of the domain is hardly missed;
/// what is missed still stands in the list of assumptions.
pub(super) const SAMPLES: usize = 80;

/// How many times as many are drawn where relations leave only some of them.
pub(super) const RELATED: usize = 8;

/// What sample points tell of what is supposed.
#[derive(Clone, Debug)]
pub(super) struct Held {
    /// The points at which all of it holds.
    pub points: Vec<usize>,
    /// Of each part, the points at which it is positive.
    pub each: Vec<Points>,
}

/// Some of the sample points, as bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Points([u128; (RELATED * SAMPLES).div_ceil(u128::BITS as usize)]);

impl Points {
    /// Those whose values are of some kind.
    pub fn that(values: &[Option<f64>], is: impl Fn(f64) -> bool) -> Points {
        let mut points = Points(Default::default());
        for (k, value) in values.iter().enumerate() {
            let bit = u128::from(value.is_some_and(&is));
            points.0[k / 128] |= bit << (k % 128);
        }
        points
    }

    /// Those that are among others, too.
    pub fn within(mut self, others: &Points) -> Points {
        self.0.iter_mut().zip(others.0).for_each(|(a, b)| *a &= b);
        self
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.iter().all(|bits| *bits == 0)
    }
}
