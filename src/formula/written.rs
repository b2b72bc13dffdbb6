//! A formula as somebody wrote it: minus signs, fractions, brackets and products without a sign, each with its place.

use super::Fault;
use super::token::Literal;
use crate::dimension::Unit;
use crate::expr::number::ten_to;
use crate::expr::{Expr, Function, Symbol};

/// A written piece and its place in the text.
#[derive(Clone, PartialEq, Debug)]
pub struct Written {
    /// What it is.
    pub shape: Shape,
    /// First byte.
    pub start: usize,
    /// Byte after the last.
    pub end: usize,
}

/// How a term of a sum is signed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Sign {
    /// +, or nothing in front.
    Plus,
    /// −
    Minus,
    /// ±
    PlusMinus,
    /// ∓
    MinusPlus,
}

/// How a factor is tied to those before it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Link {
    /// Side by side, without a sign.
    Beside,
    /// With a multiplication sign.
    Times,
    /// With ×: the cross product of vectors.
    Cross,
    /// Behind a slash or a division sign.
    Over,
}

/// The kinds of written piece.
#[derive(Clone, PartialEq, Debug)]
pub enum Shape {
    /// A number.
    Number(Literal),
    /// A name, or π.
    Symbol(Symbol),
    /// Signed terms; a single one with a minus is a negative.
    Sum(Vec<(Sign, Written)>),
    /// Factors, the link of the first being meaningless.
    Product(Vec<(Link, Written)>),
    /// A fraction with a bar.
    Fraction(Box<Written>, Box<Written>),
    /// A base and its exponent.
    Power(Box<Written>, Box<Written>),
    /// A root and its index; none is 2.
    Root(Option<Box<Written>>, Box<Written>),
    /// A function of an argument.
    Call(Function, Box<Written>),
    /// The reciprocal of a function: sec, csc, cot.
    Reciprocal(Function, Box<Written>),
    /// A bracketed piece.
    Bracket(Box<Written>),
    /// A piece between bars.
    Abs(Box<Written>),
    /// A number of degrees.
    Degrees(Box<Written>),
    /// A piece and the unit behind it, inside a formula of numbers.
    Measured(Box<Written>, Box<Unit>),
    /// Components of a vector.
    List(Vec<Written>),
}

impl Written {
    pub(crate) fn new(shape: Shape, start: usize, end: usize) -> Written {
        Written { shape, start, end }
    }

    pub(crate) fn fault(&self, message: impl Into<String>) -> Box<Fault> {
        Fault::new(message, self.start, self.end)
    }

    /// The same at another place.
    pub(super) fn at(self, start: usize, end: usize) -> Written {
        Written::new(self.shape, start, end)
    }

    /// A fraction with it above.
    pub(super) fn over(self, below: Written) -> Written {
        let (start, end) = (self.start, below.end);
        Written::new(Shape::Fraction(Box::new(self), Box::new(below)), start, end)
    }

    /// A power of it.
    pub(super) fn power(self, exponent: Written) -> Written {
        let (start, end) = (self.start, exponent.end);
        let shape = Shape::Power(Box::new(self), Box::new(exponent));
        Written::new(shape, start, end)
    }

    /// A sum of two terms.
    pub(super) fn plus(self, sign: Sign, other: Written) -> Written {
        let (start, end) = (self.start, other.end);
        Written::new(
            Shape::Sum(vec![(Sign::Plus, self), (sign, other)]),
            start,
            end,
        )
    }

    /// Something made of it alone.
    pub(super) fn inside(self, shape: impl FnOnce(Box<Written>) -> Shape) -> Written {
        let (start, end) = (self.start, self.end);
        Written::new(shape(Box::new(self)), start, end)
    }

    /// A function of it.
    pub(super) fn call(self, function: Function) -> Written {
        self.inside(|x| Shape::Call(function, x))
    }

    /// How many pieces there are, at any depth, with itself.
    pub(crate) fn size(&self) -> usize {
        1 + self.pieces().into_iter().map(Written::size).sum::<usize>()
    }

    /// The pieces it is made of.
    pub(crate) fn pieces(&self) -> Vec<&Written> {
        match &self.shape {
            Shape::Sum(terms) => terms.iter().map(|(_, term)| term).collect(),
            Shape::Product(factors) => factors.iter().map(|(_, factor)| factor).collect(),
            Shape::Fraction(a, b) | Shape::Power(a, b) => vec![a, b],
            Shape::Root(Some(index), inner) => vec![index, inner],
            Shape::Root(None, a)
            | Shape::Call(_, a)
            | Shape::Reciprocal(_, a)
            | Shape::Bracket(a)
            | Shape::Abs(a)
            | Shape::Degrees(a)
            | Shape::Measured(a, _) => vec![a],
            Shape::List(parts) => parts.iter().collect(),
            Shape::Number(_) | Shape::Symbol(_) => Vec::new(),
        }
    }

    /// Whether it is a vector by the way it is written: an arrow, a unit vector, components, or a sum or multiple of such.
    pub(crate) fn is_vector(&self) -> bool {
        match &self.shape {
            Shape::Symbol(name) => is_axis(name) || has_components(name),
            Shape::List(_) => true,
            Shape::Bracket(inner) | Shape::Fraction(inner, _) | Shape::Measured(inner, _) => {
                inner.is_vector()
            }
            Shape::Sum(terms) => terms.iter().any(|(_, t)| t.is_vector()),
            Shape::Product(factors) => {
                // Two vectors give a number with a dot, and a vector with a cross.
                let mut vector = false;
                for (link, factor) in factors {
                    vector = match (vector, factor.is_vector()) {
                        (true, true) => *link == Link::Cross,
                        (a, b) => a || b,
                    };
                }
                vector
            }
            _ => false,
        }
    }

    /// Whether it is a matrix by the way it is written: rows, or a sum or product of such.
    pub(super) fn is_matrix(&self) -> bool {
        let row = |part: &Written| matches!(part.shape, Shape::List(_));
        match &self.shape {
            Shape::List(rows) => rows.iter().all(row),
            Shape::Bracket(inner) => inner.is_matrix(),
            Shape::Sum(_) | Shape::Product(_) => self.pieces().into_iter().any(Written::is_matrix),
            _ => false,
        }
    }

    /// Whether vectors with arrows are multiplied with vectors, measured, or added to components, so that theirs matter.
    pub(crate) fn multiplies_vectors(&self) -> bool {
        let arrow = |w: &Written| w.is_vector() && w.has_arrow();
        let here = match &self.shape {
            Shape::Product(factors) => {
                let vectors = factors.iter().filter(|(_, f)| f.is_vector()).count();
                vectors > 1 && factors.iter().any(|(_, f)| arrow(f))
            }
            Shape::Abs(inner) | Shape::Call(Function::Abs, inner) | Shape::Power(inner, _) => {
                arrow(inner) && !inner.is_hat()
            }
            // `\vec{v} + 2\hat{\imath}` adds components too.
            Shape::Sum(terms) => {
                let plain = |w: &Written| w.is_vector() && !w.has_arrow();
                terms.iter().any(|(_, t)| arrow(t)) && terms.iter().any(|(_, t)| plain(t))
            }
            _ => false,
        };
        here || self.pieces().into_iter().any(Written::multiplies_vectors)
    }

    /// Whether a name in it has an arrow.
    pub(super) fn names_vector(&self) -> bool {
        match &self.shape {
            Shape::Symbol(name) => has_arrow(name),
            _ => self.pieces().into_iter().any(Written::names_vector),
        }
    }

    /// Whether such a name in it has a hat.
    pub(super) fn names_hat(&self, so: &dyn Fn(&str) -> bool) -> bool {
        match &self.shape {
            Shape::Symbol(name) => name.contains("_hat") && has_components(name) && so(name),
            _ => self.pieces().into_iter().any(|piece| piece.names_hat(so)),
        }
    }

    /// Whether it is one name with a hat, which may be a number: `\hat{p}^2`.
    fn is_hat(&self) -> bool {
        matches!(&self.shape, Shape::Symbol(name) if !has_arrow(name))
    }

    fn has_arrow(&self) -> bool {
        match &self.shape {
            Shape::Symbol(name) => has_components(name),
            Shape::Bracket(inner) | Shape::Fraction(inner, _) | Shape::Measured(inner, _) => {
                inner.has_arrow()
            }
            Shape::Sum(terms) => terms.iter().any(|(_, t)| t.has_arrow()),
            Shape::Product(factors) => factors.iter().any(|(_, f)| f.has_arrow()),
            _ => false,
        }
    }

    /// Whether it is made of numbers and π alone, without a sum of several terms.
    pub(crate) fn is_numeric(&self) -> bool {
        match &self.shape {
            Shape::Number(_) => true,
            Shape::Symbol(name) => &**name == "pi",
            Shape::Fraction(a, b) | Shape::Power(a, b) => a.is_numeric() && b.is_numeric(),
            Shape::Product(factors) => factors.iter().all(|(_, f)| f.is_numeric()),
            Shape::Root(_, inner)
            | Shape::Bracket(inner)
            | Shape::Measured(inner, _)
            | Shape::Degrees(inner) => inner.is_numeric(),
            Shape::Sum(terms) => matches!(terms.as_slice(), [(_, only)] if only.is_numeric()),
            _ => false,
        }
    }

    /// Whether it is a percentage: its hundred begins where the number does.
    pub(super) fn is_percentage(&self) -> bool {
        matches!(&self.shape, Shape::Fraction(above, below) if below.start == above.start)
    }

    /// The number in front of a degree or percent sign.
    pub(crate) fn marked(&self) -> Option<Literal> {
        match &self.shape {
            Shape::Degrees(inner) => inner.literal(),
            Shape::Fraction(inner, _) if self.is_percentage() => inner.literal(),
            Shape::Sum(terms) => match terms.as_slice() {
                [(_, only)] => only.marked(),
                _ => None,
            },
            _ => None,
        }
    }

    /// Whether it is made of numbers and π, functions and sums of them too, without a unit, a degree or percent sign.
    pub(super) fn is_bare_number(&self) -> bool {
        match &self.shape {
            Shape::Symbol(name) => &**name == "pi",
            Shape::Degrees(_) | Shape::Measured(..) | Shape::List(_) => false,
            _ => !self.is_percentage() && self.pieces().into_iter().all(Written::is_bare_number),
        }
    }

    /// The number, when the whole is one written as digits, a sign and a power of ten.
    pub fn literal(&self) -> Option<Literal> {
        match &self.shape {
            Shape::Number(literal) => Some(literal.clone()),
            Shape::Bracket(inner) => inner.literal(),
            Shape::Sum(terms) => match terms.as_slice() {
                [(Sign::Plus, inner)] => inner.literal(),
                [(Sign::Minus, inner)] => {
                    let found = inner.literal()?;
                    Some(Literal {
                        value: -found.value.clone(),
                        ..found
                    })
                }
                _ => None,
            },
            Shape::Product(factors) => match factors.as_slice() {
                [(_, number), (Link::Times | Link::Beside | Link::Cross, ten)] => {
                    let found = number.literal()?;
                    let Shape::Power(base, exponent) = &ten.shape else {
                        return None;
                    };
                    let (base, exponent) = (base.literal()?, exponent.literal()?);
                    let whole = exponent.value.is_integer();
                    let k = exponent.value.numer().as_i64().filter(|_| whole)?;
                    if base.value != crate::expr::ratio(10, 1)
                        || k.abs() > super::token::MAX_EXPONENT
                    {
                        return None;
                    }
                    let scaled = &found.value * &ten_to(k);
                    Some(Literal {
                        value: scaled,
                        digits: found.digits,
                        place: found.place + k as i32,
                        decimal: true,
                    })
                }
                _ => None,
            },
            _ => None,
        }
    }
}

/// Whether a name is that of a unit vector along an axis.
pub(crate) fn is_axis(name: &str) -> bool {
    matches!(name, "i_hat" | "j_hat" | "k_hat")
}

/// Whether a name stands for a vector by its arrow.
pub(crate) fn has_arrow(name: &str) -> bool {
    let name = super::write::derivative(name).map_or(name, |(above, _)| above);
    name.contains("_vec") && super::symbols::parts_of(name).accent.starts_with("vec")
}

/// Whether a name stands for a vector by its arrow or its hat, apart from those along the axes.
pub(crate) fn has_components(name: &str) -> bool {
    let hat = || name.contains("_hat") && super::symbols::parts_of(name).accent.starts_with("hat");
    has_arrow(name) || !is_axis(name) && hat()
}

/// Whether components are those of a unit vector, by the hat over its name.
pub(super) fn is_unit([x, ..]: &[Expr; 3]) -> bool {
    x.as_symbol().is_some_and(|name| unit_of(name).is_some())
}

/// The name with a hat that a component is one of.
pub(crate) fn unit_of(component: &str) -> Option<&str> {
    let stem = stem_of(component)?;
    (super::symbols::parts_of(stem).accent == "hat").then_some(stem)
}

/// The name that a component has before its axis.
fn stem_of(component: &str) -> Option<&str> {
    let mut axes = ["_x", "_y", "_z"].iter();
    axes.find_map(|axis| component.strip_suffix(axis))
}

/// Whether a name is the component of a vector written with an arrow or a hat along x, y or z.
pub(crate) fn is_component(name: &str) -> bool {
    stem_of(name).is_some_and(has_components)
}

/// What a component is one of, and along which axis: `v_{Bx}` and `v_B_x` of v_B along x, `x` of nothing.
pub(crate) fn along_axis(name: &str) -> Option<(String, usize)> {
    let mut parts = super::symbols::parts_of(name);
    let (index, base) = (parts.index.as_str(), parts.base.as_str());
    let letter = if index.is_empty() { base } else { index };
    let axis = ["x", "y", "z"]
        .iter()
        .position(|axis| letter.ends_with(axis))?;
    let stem = letter[..letter.len() - 1]
        .trim_end_matches([',', ' '])
        .to_string();
    match index.is_empty() {
        true if stem.is_empty() => parts.base = stem,
        true => return None,
        false => parts.index = stem,
    }
    Some((
        format!("{} {} {}", parts.base, parts.index, parts.marks),
        axis,
    ))
}

/// The names of the components of a vector.
pub(crate) fn along_axes(name: &str) -> [Symbol; 3] {
    ["x", "y", "z"].map(|axis| Symbol::from(format!("{name}_{axis}")))
}

/// The letter, the index and the mark of a name with an arrow: v, `C,rod` and `^+`.
pub(crate) fn vector_name(name: &str) -> Option<(String, String, String)> {
    let parts = super::symbols::parts_of(name);
    (parts.accent == "vec").then_some((parts.base, parts.index, parts.marks))
}

/// The name with an arrow over it; nothing where it has an accent.
pub(crate) fn with_arrow(name: &str) -> Option<String> {
    let mut parts = super::symbols::parts_of(name);
    parts.accent.is_empty().then(|| {
        parts.accent = "vec";
        parts.key()
    })
}
