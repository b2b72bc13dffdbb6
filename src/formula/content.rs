//! What a formula says: expressions, vectors, values with units, and relations between them.

use std::collections::BTreeSet;

use crate::dimension::Unit;
use crate::expr::{Expr, Symbol};

/// A sign between two sides.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Relation {
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Approximately,
}

impl Relation {
    /// Whether it says which side is the smaller one.
    pub fn is_order(self) -> bool {
        self.is_below() || self.turned().is_below()
    }

    /// Whether the left side is the smaller one, or both may be the same.
    pub fn is_below(self) -> bool {
        matches!(self, Relation::Less | Relation::LessEqual)
    }

    /// The same read from right to left.
    pub fn turned(self) -> Relation {
        match self {
            Relation::Less => Relation::Greater,
            Relation::LessEqual => Relation::GreaterEqual,
            Relation::Greater => Relation::Less,
            Relation::GreaterEqual => Relation::LessEqual,
            same => same,
        }
    }

    /// The sign in Unicode.
    pub fn sign(self) -> &'static str {
        match self {
            Relation::Equal => "=",
            Relation::NotEqual => "≠",
            Relation::Less => "<",
            Relation::LessEqual => "≤",
            Relation::Greater => ">",
            Relation::GreaterEqual => "≥",
            Relation::Approximately => "≈",
        }
    }
}

/// A number, or an expression, with a unit.
#[derive(Clone, PartialEq, Debug)]
pub struct Quantity {
    /// Value in SI units.
    pub value: Expr,
    /// Value in the unit written.
    pub written: Expr,
    /// The unit.
    pub unit: Unit,
    /// The unit as written.
    pub unit_text: String,
}

impl Quantity {
    /// A number in a unit.
    pub fn of(written: Expr, unit: Unit, unit_text: &str) -> Quantity {
        Quantity {
            value: &written * &unit.value(),
            written,
            unit,
            unit_text: unit_text.to_string(),
        }
    }
}

/// What was read.
#[derive(Clone, PartialEq, Debug)]
pub enum Content {
    /// An expression.
    Scalar(Expr),
    /// Values of which each will do: with ± the one of the upper sign first.
    Either(Vec<Expr>),
    /// A vector along x, y and z.
    Vector([Expr; 3]),
    /// A matrix, row by row: two rows at least, all as long, of two entries at least.
    Matrix(Vec<Vec<Expr>>),
    /// A value with a unit.
    Quantity(Box<Quantity>),
    /// Sides with relations between them; one side more than there are relations.
    Relations(Vec<Content>, Vec<Relation>),
    /// Several relations, two at least.
    Joined(Join, Vec<Content>),
}

/// How several relations belong together.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Join {
    /// All of them hold.
    And,
    /// One of them holds.
    Or,
}

impl Join {
    /// The word between two of them.
    pub fn word(self) -> &'static str {
        match self {
            Join::And => " and ",
            Join::Or => " or ",
        }
    }
}

impl Content {
    /// The expression, when it is one; a quantity gives its SI value.
    pub fn expr(&self) -> Option<&Expr> {
        match self {
            Content::Scalar(e) => Some(e),
            Content::Quantity(q) => Some(&q.value),
            _ => None,
        }
    }

    /// What is said of a quantity: the right side of `ω = …`, of `ω = … = …` the last one, else the content itself.
    pub fn answer(&self) -> &Content {
        match self {
            Content::Relations(sides, signs) => {
                let defines = signs
                    .iter()
                    .all(|s| matches!(s, Relation::Equal | Relation::Approximately));
                let named = sides.first().is_some_and(Content::is_name);
                match sides.last() {
                    Some(last) if defines && named => last,
                    _ => self,
                }
            }
            other => other,
        }
    }

    /// A number in a unit, where it has none of its own.
    pub(super) fn in_unit(self, unit: &Unit, text: &str) -> Content {
        match self {
            Content::Scalar(e) if e.is_constant() => {
                Content::Quantity(Box::new(Quantity::of(e, unit.clone(), text)))
            }
            other => other,
        }
    }

    /// `2 < x < 5 m`: the unit behind the upper end is that of both.
    pub(super) fn with_shared_unit(mut self) -> Content {
        if let Content::Relations(sides, signs) = &mut self
            && signs.iter().all(|sign| sign.is_order())
            && let [low, _, Content::Quantity(high)] = &mut sides[..]
        {
            *low = low.clone().in_unit(&high.unit, &high.unit_text);
        }
        self
    }

    /// Whether it holds an inequality.
    pub fn is_bounded(&self) -> bool {
        match self {
            Content::Relations(_, signs) => signs.iter().any(|sign| sign.is_order()),
            Content::Joined(_, parts) => parts.iter().any(Content::is_bounded),
            _ => false,
        }
    }

    /// Whether it is a name, or the components of something by their names, as in `(v_x, v_y)`.
    fn is_name(&self) -> bool {
        let name = |e: &Expr| e.as_symbol().is_some();
        match self {
            Content::Vector(parts) => {
                parts.iter().any(name) && parts.iter().all(|e| name(e) || e.is_zero())
            }
            other => other.expr().is_some_and(name),
        }
    }

    /// The same with every expression inside changed; a quantity stays as it is.
    pub(crate) fn map(&self, change: &dyn Fn(&Expr) -> Expr) -> Content {
        match self {
            Content::Scalar(e) => Content::Scalar(change(e)),
            Content::Either(values) => Content::Either(values.iter().map(change).collect()),
            Content::Vector(components) => Content::Vector(components.each_ref().map(change)),
            Content::Matrix(rows) => Content::Matrix(
                rows.iter()
                    .map(|row| row.iter().map(change).collect())
                    .collect(),
            ),
            Content::Quantity(_) => self.clone(),
            Content::Relations(sides, signs) => {
                let sides = sides.iter().map(|side| side.map(change)).collect();
                Content::Relations(sides, signs.clone())
            }
            Content::Joined(join, parts) => {
                let parts = parts.iter().map(|part| part.map(change)).collect();
                Content::Joined(*join, parts)
            }
        }
    }

    /// It in plain notation; `write` writes an expression.
    pub fn plain(&self, write: &dyn Fn(&Expr) -> String) -> String {
        let all = |values: &[Expr]| values.iter().map(write).collect::<Vec<_>>();
        let list = |values: &[Expr]| format!("[{}]", all(values).join(", "));
        match self {
            Content::Scalar(e) => write(e),
            Content::Either(values) => all(values).join(" or "),
            Content::Vector(components) => list(components),
            Content::Matrix(rows) => {
                let rows: Vec<String> = rows.iter().map(|row| list(row)).collect();
                format!("[{}]", rows.join(", "))
            }
            Content::Quantity(q) => format!("{} {}", write(&q.written), q.unit_text),
            Content::Relations(sides, signs) => {
                let signs = signs.iter().map(|sign| format!(" {} ", sign.sign()));
                let signs = std::iter::once(String::new()).chain(signs);
                let sides = signs.zip(sides);
                sides
                    .map(|(sign, side)| sign + &side.plain(write))
                    .collect()
            }
            Content::Joined(join, parts) => {
                let part = |part: &Content| match (join, part) {
                    (Join::And, Content::Joined(Join::Or, _)) => format!("({})", part.plain(write)),
                    _ => part.plain(write),
                };
                let parts: Vec<String> = parts.iter().map(part).collect();
                parts.join(join.word())
            }
        }
    }

    /// The names that occur.
    pub fn symbols(&self) -> BTreeSet<Symbol> {
        self.exprs().into_iter().flat_map(Expr::symbols).collect()
    }

    /// Whether a name occurs.
    pub fn mentions(&self, name: &str) -> bool {
        self.exprs().iter().any(|e| e.mentions(name))
    }

    /// The name that it is, when it is one.
    pub fn name(&self) -> Option<&Symbol> {
        self.expr()?.as_symbol()
    }

    /// The sides of its relations and the signs between them, when it is a chain of such.
    pub fn relations(&self) -> Option<(&[Content], &[Relation])> {
        match self {
            Content::Relations(sides, signs) => Some((sides, signs)),
            _ => None,
        }
    }

    /// The expressions inside.
    pub fn exprs(&self) -> Vec<&Expr> {
        match self {
            Content::Scalar(e) => vec![e],
            Content::Either(values) => values.iter().collect(),
            Content::Vector(components) => components.iter().collect(),
            Content::Matrix(rows) => rows.iter().flatten().collect(),
            Content::Quantity(q) => vec![&q.value],
            Content::Relations(parts, _) | Content::Joined(_, parts) => {
                parts.iter().flat_map(Content::exprs).collect()
            }
        }
    }

    /// The expressions inside, with all their parts.
    pub(crate) fn parts(&self) -> impl Iterator<Item = &Expr> {
        self.exprs().into_iter().flat_map(Expr::parts)
    }

    /// The sides of the relations inside, chain by chain.
    pub(crate) fn chains(&self) -> Vec<&[Content]> {
        match self {
            Content::Relations(sides, _) => vec![sides],
            Content::Joined(_, parts) => parts.iter().flat_map(Content::chains).collect(),
            _ => Vec::new(),
        }
    }
}
