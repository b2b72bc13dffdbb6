//! From a closed form to a program that loses as few digits as doubles allow.
//!
//! Sums whose terms share one sign, and sums of two inputs, stay plain: they cannot lose digits. a² − b² becomes
//! (a − b)(a + b). Every other sum may cancel and is formed in double-doubles, products in it included, and rounded once.
//! Products and quotients are gathered so that one division is left. Signs are those the declared domains guarantee.

use std::collections::{BTreeMap, HashMap};

use num_traits::{One, Signed, Zero};

use super::dd::Dd;
use super::program::{Op, Program, Step};
use crate::domain::{Domains, Limit};
use crate::expr::angle::angle;
use crate::expr::number::{from_f64, sqrt_exact, to_f64};
use crate::expr::{Expr, Function, Node, Rational, Symbol};

/// What a formula takes as input: a symbol, or the cosine or sine of an angle.
pub type Atoms = Vec<(Symbol, Expr)>;

/// Replaces sines, cosines and tangents of angles by inputs of their own; `atoms` collects what each stands for.
pub fn without_angles(e: &Expr, atoms: &mut Atoms) -> Expr {
    let Some((f, argument)) = angle_call(e) else {
        return e.map_parts(|part| without_angles(part, atoms));
    };
    if f == Function::Tan {
        let [sin, cos] = [argument.sin(), argument.cos()].map(|c| without_angles(&c, atoms));
        return sin / cos;
    }
    if let Some((name, _)) = atoms.iter().find(|(_, of)| of == e) {
        return Expr::symbol(name);
    }
    // No scene has a symbol with a blank.
    let name: Symbol = format!("{} {}", f.name(), atoms.len()).into();
    atoms.push((name.clone(), e.clone()));
    Expr::symbol(&name)
}

/// Whether the input is a cosine or sine rather than a symbol of the scene.
fn is_wave(name: &str) -> bool {
    name.contains(' ')
}

/// The function and the argument of a sine, cosine or tangent of an angle.
fn angle_call(e: &Expr) -> Option<(Function, &Expr)> {
    match e.node() {
        Node::Call(f @ (Function::Sin | Function::Cos | Function::Tan), argument) => {
            angle(argument).map(|_| (*f, argument))
        }
        _ => None,
    }
}

/// acos(1 − u) as 2 asin √(u/2), which keeps its digits where u is small and 1 − u has lost them.
fn half_angle(e: &Expr) -> Option<Expr> {
    let Node::Call(Function::Acos, cosine) = e.node() else {
        return None;
    };
    let Node::Sum(terms) = cosine.node() else {
        return None;
    };
    if !terms.iter().any(Expr::is_one) {
        return None;
    }
    let rest = terms.iter().filter(|t| !t.is_one()).map(|t| -t);
    let half = Expr::ratio(1, 2) * Expr::sum(rest);
    Some(Expr::from(2) * Expr::call(Function::Asin, half.sqrt()))
}

/// Whether every value is ≥ 0 (`Some(true)`), every value ≤ 0 (`Some(false)`), or neither is known.
pub type Signs = BTreeMap<Symbol, bool>;

/// Signs of symbols and of the cosines and sines in `atoms`, as far as the domains tell.
pub fn signs(domains: &Domains, atoms: &Atoms) -> Signs {
    let mut out = Signs::new();
    for (name, domain) in &domains.symbols {
        match domain.bounds() {
            [Some(low), _] if low >= 0.0 => out.insert(name.clone(), true),
            [_, Some(high)] if high <= 0.0 => out.insert(name.clone(), false),
            _ => None,
        };
    }
    for (name, of) in atoms {
        if let Some(sign) = wave_sign(domains, of) {
            out.insert(name.clone(), sign);
        }
    }
    out
}

/// The sign of a cosine or sine of a multiple of an angle.
fn wave_sign(domains: &Domains, of: &Expr) -> Option<bool> {
    let Node::Call(f, argument) = of.node() else {
        return None;
    };
    let turn = angle(argument).filter(|a| a.pi.is_zero())?;
    let [(symbol, factor)] = turn.symbols.iter().collect::<Vec<_>>().try_into().ok()?;
    let domain = domains.symbols.get(symbol)?;
    let side = |l: &Option<Limit>| Some(l.as_ref()?.approximate() * to_f64(factor));
    let (one, other) = (side(&domain.low)?, side(&domain.high)?);
    let (low, high) = (one.min(other), one.max(other));
    let quarter = std::f64::consts::FRAC_PI_2 * (1.0 + 1e-15);
    let positive = match f {
        Function::Sin => low >= 0.0 && high <= 2.0 * quarter,
        _ => low >= -quarter && high <= quarter,
    };
    let negative = *f == Function::Sin && high <= 0.0 && low >= -2.0 * quarter;
    (positive || negative).then_some(positive)
}

/// The formula as derived: every operation plain, in the order of the expression.
pub fn as_derived(e: &Expr, inputs: &[Symbol]) -> Option<Program> {
    Builder::new(inputs, &Signs::new(), false).finish(e)
}

/// The formula arranged for accuracy. `None` where a symbol is no input.
pub fn arranged(e: &Expr, inputs: &[Symbol], signs: &Signs) -> Option<Program> {
    Builder::new(inputs, signs, true).finish(e)
}

struct Builder<'a> {
    inputs: &'a [Symbol],
    signs: &'a Signs,
    careful: bool,
    steps: Vec<Step>,
    /// Steps by how they are made, so that equal parts are computed once.
    made: HashMap<String, usize>,
    /// The step of each expression in doubles, and in double-doubles.
    known: [HashMap<Expr, usize>; 2],
}

impl<'a> Builder<'a> {
    fn new(inputs: &'a [Symbol], signs: &'a Signs, careful: bool) -> Builder<'a> {
        Builder {
            inputs,
            signs,
            careful,
            steps: Vec::new(),
            made: HashMap::new(),
            known: Default::default(),
        }
    }

    fn finish(mut self, e: &Expr) -> Option<Program> {
        let last = self.value(e, false)?;
        if last + 1 != self.steps.len() {
            // The value has to be the last step; an input alone, or a shared part, is repeated.
            let step = self.steps[last];
            self.steps.push(step);
        }
        Some(Program {
            steps: self.steps,
            inputs: self.inputs.len(),
        })
    }

    fn step(&mut self, op: Op, wide: bool) -> usize {
        let step = Step { op, wide };
        let key = format!("{step:?}");
        if let Some(known) = self.made.get(&key) {
            return *known;
        }
        self.steps.push(step);
        self.made.insert(key, self.steps.len() - 1);
        self.steps.len() - 1
    }

    fn one(&mut self, wide: bool) -> usize {
        self.step(Op::Number(Dd::exact(1.0)), wide)
    }

    /// The number of a step with the expression's value.
    fn value(&mut self, e: &Expr, wide: bool) -> Option<usize> {
        if let Some(known) = self.known[usize::from(wide)].get(e) {
            return Some(*known);
        }
        if let Some(same) = half_angle(e) {
            return self.value(&same, wide);
        }
        let rounded = |v: Dd| if wide { v } else { Dd::exact(v.high) };
        let step = match e.node() {
            Node::Number(value) => self.step(Op::Number(rounded(Dd::from_rational(value))), wide),
            Node::Symbol(name) if &**name == "pi" => {
                self.step(Op::Number(rounded(super::dd::PI)), wide)
            }
            Node::Symbol(name) if !wide || is_wave(name) => {
                let input = self.inputs.iter().position(|i| i == name)?;
                self.step(Op::Input(input), wide)
            }
            Node::Sum(terms) if wide => self.wide_sum(terms)?,
            Node::Sum(terms) => self.sum(e, terms)?,
            Node::Product(factors) => self.product(factors, wide)?,
            Node::Power(base, exponent) => self.power(e, base, exponent, wide)?,
            Node::Call(f, argument) if !wide => {
                let argument = self.value(argument, false)?;
                self.step(Op::Call(*f, argument), false)
            }
            Node::Symbol(_) | Node::Call(..) => self.widened(e)?,
        };
        self.known[usize::from(wide)].insert(e.clone(), step);
        Some(step)
    }

    fn widened(&mut self, e: &Expr) -> Option<usize> {
        let plain = self.value(e, false)?;
        Some(self.step(Op::Widen(plain), true))
    }

    fn wide_sum(&mut self, terms: &[Expr]) -> Option<usize> {
        let mut total = self.value(&terms[0], true)?;
        for term in &terms[1..] {
            let term = self.value(term, true)?;
            total = self.step(Op::Add(total, term), true);
        }
        Some(total)
    }

    fn sum(&mut self, e: &Expr, terms: &[Expr]) -> Option<usize> {
        if self.careful {
            if let Some([minus, plus]) = difference_of_squares(terms) {
                let [minus, plus] = [self.value(&minus, false)?, self.value(&plus, false)?];
                return Some(self.step(Op::Multiply(minus, plus), false));
            }
            let atoms = terms.len() == 2 && terms.iter().all(is_exact_atom);
            if !atoms && sign(e, self.signs).is_none() {
                let wide = self.value(e, true)?;
                return Some(self.step(Op::Round(wide), false));
            }
        }
        let mut total = self.value(&terms[0], false)?;
        for term in &terms[1..] {
            let positive = negated(term);
            let value = self.value(positive.as_ref().unwrap_or(term), false)?;
            let op = match positive {
                Some(_) => Op::Subtract(total, value),
                None => Op::Add(total, value),
            };
            total = self.step(op, false);
        }
        Some(total)
    }

    fn product(&mut self, factors: &[Expr], wide: bool) -> Option<usize> {
        let (above, below) = fraction(factors);
        let above = self.chain(&above, wide)?;
        let below = self.chain(&below, wide)?;
        Some(match (above, below) {
            (Some(a), Some(b)) => self.step(Op::Divide(a, b), wide),
            (Some(a), None) => a,
            (None, below) => {
                let one = self.one(wide);
                below.map_or(one, |b| self.step(Op::Divide(one, b), wide))
            }
        })
    }

    /// The product of factors; signs among them are taken last.
    fn chain(&mut self, factors: &[Expr], wide: bool) -> Option<Option<usize>> {
        let minus_one = |f: &Expr| f.as_number().is_some_and(|v| *v == -Rational::one());
        let mut total = None;
        let mut negative = false;
        for factor in factors {
            if minus_one(factor) && factors.len() > 1 {
                negative = !negative;
                continue;
            }
            let factor = self.value(factor, wide)?;
            total = Some(total.map_or(factor, |t| self.step(Op::Multiply(t, factor), wide)));
        }
        if negative {
            total = total.map(|t| self.step(Op::Negate(t), wide));
        }
        Some(total)
    }

    fn power(&mut self, e: &Expr, base: &Expr, exponent: &Expr, wide: bool) -> Option<usize> {
        let Some((root, times)) = half_integer(exponent) else {
            if wide {
                return self.widened(e);
            }
            let (base, exponent) = (self.value(base, false)?, self.value(exponent, false)?);
            return Some(self.step(Op::Power(base, exponent), false));
        };
        if times < 0 {
            return self.product(std::slice::from_ref(e), wide);
        }
        let mut base = self.value(base, wide)?;
        if root {
            base = self.step(Op::Root(base), wide);
        }
        Some(self.raised(base, times.unsigned_abs(), wide))
    }

    /// Power by repeated squaring.
    fn raised(&mut self, base: usize, times: u64, wide: bool) -> usize {
        let (mut square, mut left, mut total) = (base, times, None);
        while left > 0 {
            if left & 1 == 1 {
                total = Some(match total {
                    None => square,
                    Some(t) => self.step(Op::Multiply(t, square), wide),
                });
            }
            left >>= 1;
            if left > 0 {
                square = self.step(Op::Multiply(square, square), wide);
            }
        }
        total.unwrap_or_else(|| self.one(wide))
    }
}

/// Factors above and below the line, exponents positive; a fraction of numbers is split too, so that both are exact.
fn fraction(factors: &[Expr]) -> (Vec<Expr>, Vec<Expr>) {
    let (mut above, mut below) = (Vec::new(), Vec::new());
    for factor in factors {
        match factor.node() {
            Node::Number(value) if !value.is_integer() => {
                if value.numer().as_i64() != Some(1) {
                    above.push(Expr::from(Rational::from(value.numer().clone())));
                }
                below.push(Expr::from(Rational::from(value.denom().clone())));
            }
            _ => {
                let [over, under] = factor.above_and_below();
                above.extend(over);
                below.extend(under);
            }
        }
    }
    (above, below)
}

/// An exponent n or n/2: whether a root is taken first, and the integer.
fn half_integer(exponent: &Expr) -> Option<(bool, i64)> {
    let twice = exponent.as_number()? * Rational::from(crate::expr::Int::from(2));
    let n = twice.is_integer().then(|| twice.numer().as_i64())??;
    let root = n % 2 != 0;
    Some((root, if root { n } else { n / 2 }))
}

/// a − b and a + b for a² − b² with symbols or numbers a and b.
fn difference_of_squares(terms: &[Expr]) -> Option<[Expr; 2]> {
    let [one, two] = terms else { return None };
    let root = |e: &Expr| match e.node() {
        Node::Number(v) => sqrt_exact(v).map(Expr::from),
        Node::Power(base, k)
            if base.as_symbol().is_some()
                && k.as_number()
                    .is_some_and(|k| *k == Rational::from(crate::expr::Int::from(2))) =>
        {
            Some(base.clone())
        }
        _ => None,
    };
    let (a, b) = match (negated(one), negated(two)) {
        (None, Some(b)) => (root(one)?, root(&b)?),
        (Some(b), None) => (root(two)?, root(&b)?),
        _ => return None,
    };
    Some([&a - &b, &a + &b])
}

/// A symbol or a number that is a double, or the opposite of one: exact as it comes in.
fn is_exact_atom(e: &Expr) -> bool {
    match e.node() {
        Node::Number(v) => from_f64(to_f64(v)).as_ref() == Some(v),
        Node::Symbol(name) => &**name != "pi" && !is_wave(name),
        Node::Product(_) => {
            negated(e).is_some_and(|p| p.as_symbol().is_some() && is_exact_atom(&p))
        }
        _ => false,
    }
}

/// −e, where e is a negative number or a product with a negative coefficient.
fn negated(e: &Expr) -> Option<Expr> {
    e.is_negative().then(|| -e)
}

/// The sign an expression has wherever its symbols have theirs.
pub fn sign(e: &Expr, signs: &Signs) -> Option<bool> {
    match e.node() {
        Node::Number(v) => Some(!v.is_negative()),
        Node::Symbol(name) if &**name == "pi" => Some(true),
        Node::Symbol(name) => signs.get(name).copied(),
        Node::Sum(terms) => {
            let first = sign(&terms[0], signs)?;
            let same = terms[1..].iter().all(|t| sign(t, signs) == Some(first));
            same.then_some(first)
        }
        Node::Product(factors) => factors
            .iter()
            .try_fold(true, |sum, f| Some(sum == sign(f, signs)?)),
        Node::Power(base, exponent) => match half_integer(exponent) {
            Some((false, n)) if n % 2 == 0 => Some(true),
            Some((false, _)) => sign(base, signs),
            _ => Some(true),
        },
        Node::Call(Function::Abs | Function::Exp, _) => Some(true),
        Node::Call(..) => None,
    }
}
