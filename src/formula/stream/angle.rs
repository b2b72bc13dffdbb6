//! The angle under a sine: a combination of names with fractions, and quarter turns.

use super::Builder;
use super::reader::{Peek, Reader};
use super::word::Word;

/// Most different names in one angle.
const MOST: usize = 4;
/// Largest numerator or denominator.
const LARGEST: i32 = 1000;

/// A rational combination of angles and a number of quarter turns.
#[derive(Clone, Copy, Debug, Default)]
pub struct Angle {
    terms: [(u8, Share); MOST],
    count: usize,
    /// Multiple of π/2.
    pub quarters: i32,
}

/// A small fraction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Share {
    /// Above.
    pub above: i32,
    /// Below; positive.
    pub below: i32,
}

impl Default for Share {
    fn default() -> Share {
        Share { above: 0, below: 1 }
    }
}

impl Share {
    fn new(above: i32, below: i32) -> Option<Share> {
        if below == 1 && above.abs() <= LARGEST {
            return Some(Share { above, below });
        }
        if below == 0 {
            return None;
        }
        let common = num_integer::gcd(above, below) * below.signum();
        let share = Share {
            above: above / common,
            below: below / common,
        };
        (share.above.abs() <= LARGEST && share.below <= LARGEST).then_some(share)
    }

    fn times(self, other: Share) -> Option<Share> {
        Share::new(self.above * other.above, self.below * other.below)
    }

    fn plus(self, other: Share) -> Option<Share> {
        Share::new(
            self.above * other.below + other.above * self.below,
            self.below * other.below,
        )
    }
}

impl Angle {
    /// An angle of names with their shares, given as numerators and denominators; `None` beyond the limits of this reader.
    pub fn new(parts: impl IntoIterator<Item = (usize, i64, i64)>, quarters: i64) -> Option<Angle> {
        let small = |x: i64| i32::try_from(x).ok().filter(|x| x.abs() <= LARGEST);
        let mut angle = Angle {
            quarters: small(quarters)?,
            ..Angle::default()
        };
        for (index, above, below) in parts {
            let share = Share::new(small(above)?, small(below)?)?;
            *angle.terms.get_mut(angle.count)? = (u8::try_from(index).ok()?, share);
            angle.count += 1;
        }
        angle.parts().next().is_some().then_some(angle)
    }

    /// The names with their shares, none of them 0.
    pub fn parts(&self) -> impl Iterator<Item = (usize, Share)> + '_ {
        let parts = &self.terms[..self.count];
        parts
            .iter()
            .filter(|(_, share)| share.above != 0)
            .map(|(index, share)| (usize::from(*index), *share))
    }
}

/// While an angle is read: a plain number, or names and π with their shares.
#[derive(Clone, Copy, Default)]
struct Form {
    number: Option<Share>,
    angle: Angle,
    /// Multiple of π.
    pi: Share,
}

impl Form {
    fn times(mut self, other: Form) -> Option<Form> {
        let factor = match (self.number, other.number) {
            (_, Some(factor)) => factor,
            (Some(factor), None) => {
                self = other;
                factor
            }
            (None, None) => return None,
        };
        if let Some(number) = &mut self.number {
            *number = number.times(factor)?;
            return Some(self);
        }
        for (_, share) in &mut self.angle.terms[..self.angle.count] {
            *share = share.times(factor)?;
        }
        self.pi = self.pi.times(factor)?;
        Some(self)
    }

    fn plus(mut self, other: Form) -> Option<Form> {
        // A number among angles would be radians.
        if self.number.is_some() || other.number.is_some() {
            return None;
        }
        for (index, share) in &other.angle.terms[..other.angle.count] {
            let known = self.angle.terms[..self.angle.count]
                .iter_mut()
                .find(|(i, _)| i == index);
            match known {
                Some((_, sum)) => *sum = sum.plus(*share)?,
                None => {
                    *self.angle.terms.get_mut(self.angle.count)? = (*index, *share);
                    self.angle.count += 1;
                }
            }
        }
        self.pi = self.pi.plus(other.pi)?;
        Some(self)
    }

    fn finish(mut self) -> Option<Angle> {
        let quarters = Share::new(2 * self.pi.above, self.pi.below)?;
        let named = self.angle.parts().next().is_some();
        if self.number.is_some() || quarters.below != 1 || !named {
            return None;
        }
        self.angle.quarters = quarters.above;
        Some(self.angle)
    }
}

impl<B: Builder> Reader<'_, B> {
    /// The argument of a function: in brackets, or a number and a name.
    pub(super) fn angle(&mut self) -> Option<Angle> {
        match self.peek()? {
            Peek::Factor if matches!(self.byte(0), b'(' | b'[') => {
                let close = if self.byte(0) == b'(' { b')' } else { b']' };
                self.at += 1;
                self.before = false;
                let form = self.angle_sum()?;
                self.closed(close)?;
                form.finish()
            }
            Peek::Digit => {
                let number = self.angle_number()?;
                self.echo.push(b'*');
                if self.peek()? != Peek::Factor || !self.starts_name() {
                    return None;
                }
                let name = self.angle_name()?;
                self.bare_end()?;
                number.times(name)?.finish()
            }
            Peek::Factor if self.starts_name() => {
                let name = self.angle_name()?;
                self.bare_end()?;
                name.finish()
            }
            _ => None,
        }
    }

    /// Whether a name, rather than a bracket, comes next.
    fn starts_name(&self) -> bool {
        !matches!(self.byte(0), b'(' | b'[')
    }

    /// Behind an argument without brackets nothing may follow that could belong to it.
    fn bare_end(&mut self) -> Option<()> {
        match self.peek()? {
            Peek::Caret | Peek::Raised | Peek::Digit => None,
            Peek::Factor => {
                // Another function ends the argument for everybody; so does a bracket or a fraction.
                let (at, before, end) = (self.at, self.before, self.end);
                let ends = match self.byte(0) {
                    b'(' | b'[' => true,
                    _ => matches!(
                        self.word(true)?,
                        Word::Call(..) | Word::Root { .. } | Word::Fraction
                    ),
                };
                (self.at, self.before, self.end) = (at, before, end);
                ends.then_some(())
            }
            Peek::Slash => {
                self.seen.choices += 1;
                Some(())
            }
            _ => Some(()),
        }
    }

    fn angle_sum(&mut self) -> Option<Form> {
        self.deeper()?;
        let sign = self.peek()?;
        if matches!(sign, Peek::Plus | Peek::Minus) {
            self.take();
        }
        let minus = Form {
            number: Some(Share {
                above: -1,
                below: 1,
            }),
            ..Form::default()
        };
        if sign == Peek::Minus {
            self.echo.push(b'-');
        }
        let mut total = self.angle_term()?;
        if sign == Peek::Minus {
            total = total.times(minus)?;
        }
        loop {
            let negative = match self.peek()? {
                Peek::Plus => false,
                Peek::Minus => true,
                _ => break,
            };
            self.take();
            self.echo
                .extend_from_slice(if negative { b" - " } else { b" + " });
            let mut term = self.angle_term()?;
            if negative {
                term = term.times(minus)?;
            }
            total = total.plus(term)?;
        }
        self.depth -= 1;
        Some(total)
    }

    fn angle_term(&mut self) -> Option<Form> {
        let mut total = self.angle_factor()?;
        loop {
            match self.peek()? {
                Peek::Times => {
                    self.take();
                    self.echo.push(b'*');
                    total = total.times(self.angle_factor()?)?;
                }
                Peek::Slash => {
                    self.take();
                    self.echo.push(b'/');
                    let below = self.angle_number()?.number?;
                    if self.goes_on()? {
                        return None;
                    }
                    let inverse = Form {
                        number: Some(Share::new(below.below, below.above)?),
                        ..Form::default()
                    };
                    total = total.times(inverse)?;
                }
                Peek::Factor => {
                    self.echo.push(b'*');
                    total = total.times(self.angle_factor()?)?;
                }
                Peek::Digit | Peek::Caret | Peek::Raised => return None,
                _ => return Some(total),
            }
        }
    }

    fn angle_factor(&mut self) -> Option<Form> {
        match self.peek()? {
            Peek::Digit => self.angle_number(),
            Peek::Factor if matches!(self.byte(0), b'(' | b'[') => {
                let close = if self.byte(0) == b'(' { b')' } else { b']' };
                self.at += 1;
                self.before = false;
                self.echo.push(b'(');
                let form = self.angle_sum()?;
                self.echo.push(b')');
                self.closed(close)?;
                Some(form)
            }
            Peek::Factor => self.angle_name(),
            _ => None,
        }
    }

    fn angle_number(&mut self) -> Option<Form> {
        if self.peek()? != Peek::Digit {
            return None;
        }
        let start = self.at;
        let value = self.whole()?;
        self.echo.extend_from_slice(&self.text[start..self.at]);
        self.before = true;
        Some(Form {
            number: Some(Share::new(value, 1)?),
            ..Form::default()
        })
    }

    fn angle_name(&mut self) -> Option<Form> {
        let mut form = Form::default();
        match self.word(false)? {
            Word::Name(index) => {
                self.before = false;
                form.angle.terms[0] = (index as u8, Share { above: 1, below: 1 });
                form.angle.count = 1;
            }
            Word::Pi => {
                self.echo.extend_from_slice(b"pi");
                self.before = true;
                form.pi = Share { above: 1, below: 1 };
            }
            _ => return None,
        }
        Some(form)
    }
}
