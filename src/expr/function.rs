//! The functions of one argument.

/// The functions of one argument that formulas in mechanics use. Square roots are powers, not functions.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
#[allow(missing_docs)]
pub enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
    Abs,
}

impl Function {
    /// Every function, in the order of declaration.
    pub const ALL: [Function; 12] = {
        use Function::*;
        [
            Sin, Cos, Tan, Asin, Acos, Atan, Sinh, Cosh, Tanh, Exp, Ln, Abs,
        ]
    };

    /// Whether a minus sign may be taken out of the argument.
    pub fn is_odd(self) -> bool {
        use Function::*;
        matches!(self, Sin | Tan | Asin | Atan | Sinh | Tanh)
    }

    /// Whether its value is an angle in radians.
    pub fn is_arc(self) -> bool {
        use Function::*;
        matches!(self, Asin | Acos | Atan)
    }

    /// The name in plain infix notation.
    pub fn name(self) -> &'static str {
        NAMES[self as usize]
    }
}

const NAMES: [&str; 12] = [
    "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "ln", "abs",
];
