//! Products and quotients: how far a slash reaches, and which neighbours are factors.

use super::fault::{Fault, Faulty};
use super::note::Remark;
use super::parser::{FEW, Parser};
use super::symbols::is_greek;
use super::token::Tok;
use super::written::{Link, Shape, Sign, Written, is_axis};

impl Parser<'_> {
    /// Groups tied by `*` and `/`, from left to right.
    pub(super) fn term(&mut self) -> Faulty<Written> {
        let first = self.group()?;
        let first = self.measured_factor(first, false)?;
        let mut factors: Vec<(Link, Written)> = Vec::new();
        let (start, mut end) = (first.start, first.end);
        let mut first = Some(first);
        loop {
            let link = match self.peek()?.tok {
                Tok::Times => Link::Times,
                Tok::Cross => Link::Cross,
                Tok::Slash => Link::Over,
                _ => break,
            };
            self.next()?;
            if let Some(first) = first.take() {
                factors.reserve(FEW);
                factors.push((Link::Times, first));
            }
            let negative = match self.peek()?.tok {
                Tok::Minus => Some(self.next()?.start),
                Tok::Plus => {
                    self.next()?;
                    None
                }
                _ => None,
            };
            let (mut factor, rest) = if link == Link::Over {
                self.below(&factors)?
            } else {
                (self.group()?, None)
            };
            if let Some(at) = negative {
                let stop = factor.end;
                factor = Written::new(Shape::Sum(vec![(Sign::Minus, factor)]), at, stop);
            }
            let measured = |(_, f): &(Link, Written)| matches!(f.shape, Shape::Measured(..));
            factor = self.measured_factor(factor, factors.iter().any(measured))?;
            end = factor.end;
            if link == Link::Cross
                && let Some((_, before)) = factors.last()
            {
                self.crossed(before, &factor)?;
            }
            factors.push((link, factor));
            if let Some(rest) = rest {
                end = rest.end;
                factors.push((Link::Beside, rest));
            } else {
                factors = self.marked_behind(factors);
            }
        }
        match first {
            Some(only) => Ok(only),
            None => Ok(Written::new(Shape::Product(factors), start, end)),
        }
    }

    /// × between two symbols that no arrow makes vectors: a product of numbers, unless one is a cross product itself.
    fn crossed(&mut self, before: &Written, behind: &Written) -> Faulty<()> {
        let plain = |w: &Written| !w.is_numeric() && !w.is_vector();
        if !plain(before) || !plain(behind) {
            return Ok(());
        }
        let nested = |w: &Written| {
            let Shape::Bracket(inner) = &w.shape else {
                return false;
            };
            matches!(&inner.shape, Shape::Product(factors)
                if factors.iter().any(|(link, f)| *link == Link::Cross && !f.is_numeric()))
        };
        let (start, end) = (before.start, behind.end);
        if nested(before) || nested(behind) {
            let fault = Fault::new("a cross product of symbols without arrows", start, end);
            return Err(fault.hint("write \\vec{r} \\times \\vec{p} for vectors, * for a product"));
        }
        self.lexer.note(Remark::Cross, start, start, end);
        Ok(())
    }

    /// What stands below a slash, and what follows it: a product without signs and spaces stands below, but behind a
    /// fraction of two whole numbers only the number does.
    fn below(&mut self, above: &[(Link, Written)]) -> Faulty<(Written, Option<Written>)> {
        let first = self.factor()?;
        if !self.starts_factor()? {
            return Ok((first, None));
        }
        // `1/2mv²` is half of the rest to everybody.
        let whole = |w: &Written| matches!(&w.shape, Shape::Number(n) if !n.decimal);
        let half = match above {
            [(_, number)] => whole(number) && whole(&first) && first.start == number.end + 1,
            _ => false,
        };
        // Brackets show where the divisor ends: `3v/(2l) cosθ`.
        let enclosed = matches!(first.shape, Shape::Bracket(_));
        let vector = matches!(&self.peek()?.tok, Tok::Name(name) if is_axis(name));
        if vector || enclosed {
            return Ok((first, Some(self.group()?)));
        }
        let usual = self.lexer.usual_slash(self.arguments > 0, half);
        let spaced = self.peek()?.spaced;
        let from = above.last().map_or(first.start, |(_, w)| w.start);
        let middle = first.end;
        let parted = half || spaced;
        let product = if parted {
            first
        } else {
            self.group_until(Some(first), true)?
        };
        let (below, rest) = match (parted || self.starts_factor()?, usual) {
            (true, true) => (product, Some(self.group()?)),
            // `1/2π √(k/m)`: what a space parts from it does not stand below either way.
            (true, false) if !spaced && !self.needs_space(&product)? => {
                let (below, vector) = vector_above(self.group_until(Some(product), true)?);
                let rest = match vector {
                    None if self.starts_factor()? => Some(self.group()?),
                    vector => vector,
                };
                (below, rest)
            }
            (true, false) => vector_above(self.group_from(Some(product))?),
            (false, true) => vector_above(product),
            (false, false) => first_alone(product),
        };
        if self.arguments == 0 {
            let tight = rest.is_none();
            let middle = if tight { middle } else { below.end };
            let end = rest.as_ref().map_or(below.end, |r| r.end);
            self.lexer.note(Remark::Slash { tight }, from, middle, end);
        }
        Ok((below, rest))
    }

    /// `u²/2mu g`: whether a space has to stand between a Greek name in letters and the name behind it, and so parts nothing.
    fn needs_space(&mut self, product: &Written) -> Faulty<bool> {
        let named = matches!(self.peek()?.tok, Tok::Name(_));
        let last = match &product.shape {
            Shape::Product(factors) => factors.last().map_or(product.start, |(_, f)| f.start),
            _ => product.start,
        };
        Ok(named && is_greek(&self.lexer.text[last..product.end]))
    }

    /// Factors side by side.
    pub(super) fn group(&mut self) -> Faulty<Written> {
        let first = self.factor()?;
        self.group_from(Some(first))
    }

    pub(super) fn group_from(&mut self, first: Option<Written>) -> Faulty<Written> {
        self.group_until(first, false)
    }

    /// Factors side by side, in a `tight` one up to the first space.
    pub(super) fn group_until(&mut self, first: Option<Written>, tight: bool) -> Faulty<Written> {
        let first = match first {
            Some(first) => first,
            None => self.factor()?,
        };
        if !self.starts_factor()? {
            return Ok(first);
        }
        let (start, mut end) = (first.start, first.end);
        let mut factors = Vec::with_capacity(FEW);
        factors.push((Link::Beside, first));
        while self.starts_factor()? && !(tight && self.peek()?.spaced) {
            if let (
                Tok::Number(_),
                Some((
                    _,
                    Written {
                        shape: Shape::Number(_),
                        ..
                    },
                )),
            ) = (&self.peek()?.tok, factors.last())
            {
                let token = self.next()?;
                return Err(self.unexpected(&token).hint("write * for a product"));
            }
            let factor = self.factor()?;
            if let Some((_, before)) = factors.last() {
                beside(before, &factor)?;
            }
            end = factor.end;
            factors.push((Link::Beside, factor));
        }
        Ok(Written::new(Shape::Product(factors), start, end))
    }

    /// `45/2°` and `100/4 %`: behind a quotient of numbers the mark of its last one is that of all of it, as a unit would be; `100/5%`
    /// may as well be a quotient by 5%.
    fn marked_behind(&mut self, factors: Vec<(Link, Written)>) -> Vec<(Link, Written)> {
        let bare = |last: &Written| match &last.shape {
            Shape::Degrees(inner) => Some((**inner).clone()),
            Shape::Fraction(inner, _) if last.is_percentage() => Some((**inner).clone()),
            _ => None,
        };
        let Some(((Link::Over, last), before)) = factors.split_last() else {
            return factors;
        };
        let Some(inner) = bare(last).filter(|inner| inner.is_bare_number()) else {
            return factors;
        };
        if !before.iter().all(|(_, factor)| factor.is_bare_number()) {
            return factors;
        }
        let mark = last.clone();
        let (start, end) = (before[0].1.start, mark.end);
        let tight = matches!(mark.shape, Shape::Fraction(..)) && mark.end == inner.end + 1;
        if tight {
            let (from, middle) = (before[before.len() - 1].1.start, inner.end);
            let usual = self.lexer.usual_slash(self.arguments > 0, false);
            self.lexer
                .note(Remark::Slash { tight: false }, from, middle, end);
            if !usual {
                return factors;
            }
        }
        let divided = before.iter().cloned().chain([(Link::Over, inner)]);
        let quotient = Written::new(Shape::Product(divided.collect()), start, end);
        let whole = match mark.shape {
            Shape::Fraction(_, hundred) => quotient.over(hundred.at(start, end)),
            _ => quotient.inside(Shape::Degrees),
        };
        vec![(Link::Times, whole)]
    }

    pub(super) fn starts_factor(&mut self) -> Faulty<bool> {
        let bars = self.bars;
        let token = self.peek()?;
        let end = token.end;
        Ok(match token.tok {
            Tok::Number(_)
            | Tok::Name(_)
            | Tok::Call(_)
            | Tok::Reciprocal(_)
            | Tok::Logarithm(_)
            | Tok::LogarithmTo
            | Tok::Area(_)
            | Tok::Pair(_)
            | Tok::Exponential
            | Tok::Signum
            | Tok::Determinant
            | Tok::Root(_)
            | Tok::Fraction => true,
            Tok::Open(_) | Tok::OpenBar | Tok::Vulgar(..) => true,
            Tok::Bar => bars == 0 || self.lexer.opens_inside(end),
            _ => false,
        })
    }
}

/// Two neighbours that people read as a sum or as one number: `1½`, `2\frac12`, `x^1 0`.
fn beside(before: &Written, factor: &Written) -> Faulty<()> {
    let whole = |w: &Written| matches!(&w.shape, Shape::Number(n) if !n.decimal);
    let inner = |w: &Written| match &w.shape {
        Shape::Bracket(inner) => whole(inner),
        _ => whole(w),
    };
    let is_fraction = |w: &Written| match &w.shape {
        Shape::Fraction(above, below) => inner(above) && inner(below),
        _ => false,
    };
    let percent = match &factor.shape {
        Shape::Fraction(above, _) => is_fraction(above) && factor.is_percentage(),
        _ => false,
    };
    if whole(before) && (is_fraction(factor) || percent) {
        let fault = Fault::new("a mixed number or a product", before.start, factor.end);
        return Err(fault.hint("write 3/2 or 1 + 1/2 for one and a half, and * for a product"));
    }
    match (&before.shape, &factor.shape) {
        (Shape::Power(_, exponent), Shape::Number(_)) if whole(exponent) => {
            let fault = Fault::new(
                "a number directly behind an exponent",
                before.start,
                factor.end,
            );
            Err(fault.hint("write braces around the exponent, or * for a product"))
        }
        _ => Ok(()),
    }
}

/// A unit vector never stands below: 3v/2ℓ k̂.
fn vector_above(mut below: Written) -> (Written, Option<Written>) {
    let last = match &mut below.shape {
        Shape::Product(factors) if factors.last().is_some_and(|(_, f)| ends_in_unit_vector(f)) => {
            factors.pop()
        }
        _ => None,
    };
    if let Some((_, vector)) = &last {
        below.end = vector.start;
    }
    (below, last.map(|(_, vector)| vector))
}

/// The first factor of a product, and the others.
fn first_alone(product: Written) -> (Written, Option<Written>) {
    let end = product.end;
    let Shape::Product(mut factors) = product.shape else {
        return (product, None);
    };
    let (_, first) = factors.remove(0);
    let start = factors.first().map_or(end, |(_, f)| f.start);
    (
        first,
        Some(Written::new(Shape::Product(factors), start, end)),
    )
}

fn ends_in_unit_vector(written: &Written) -> bool {
    matches!(&written.shape, Shape::Symbol(name) if is_axis(name))
}
