//! Letters that may mean something else than a symbol: the base of the natural logarithm, the imaginary unit, a derivative, any
//! whole number.

use std::collections::BTreeMap;

use num_traits::Signed;

use super::super::Diagnosis;
use super::super::compare;
use super::{Doubt, ambiguous};
use crate::algebra;
use crate::domain::Domains;
use crate::expr::{Expr, Function, Node, Symbol};
use crate::formula::Content;

impl Doubt<'_> {
    /// `e^x` against `exp(x)` with an e that nobody declared: only one of them knows a symbol e. Where they are equal with e as
    /// the base of the natural logarithm, that is what was meant, unless an expected e may be a restitution to the power of a
    /// count: then nothing is decided, unless a logarithm takes part and no letter that counts.
    pub(in crate::grade) fn euler(&mut self) {
        let (expected, answer) = (&self.key.reading.content, &self.reading.content);
        let is_ln = |part: &Expr| {
            use Function::{Cosh, Ln, Sinh, Tanh};
            matches!(part.node(), Node::Call(Ln | Sinh | Cosh | Tanh, _))
        };
        let logarithm = expected.parts().chain(answer.parts()).any(is_ln);
        let is_euler =
            |part: &Expr| matches!(part.node(), Node::Call(Function::Exp, k) if k.is_one());
        let alone = logarithm || expected.parts().any(is_euler);
        fn number(e: &Expr, alone: bool) -> Expr {
            match e.node() {
                Node::Power(base, k) if is_e(base) => Expr::call(Function::Exp, number(k, alone)),
                Node::Call(Function::Ln, x) if is_e(x) => Expr::one(),
                Node::Symbol(_) if alone && is_e(e) => Expr::call(Function::Exp, Expr::one()),
                _ => e.map_parts(|part| number(part, alone)),
            }
        }
        // Alone it is a number beside a logarithm or a hyperbolic function only, `ln x = 1` and `x = e`, and for `exp(1)`.
        let number = |e: &Expr| number(e, alone);
        let occurs = |content: &Content| content.mentions("e");
        if !self.is_wrong() || occurs(expected) == occurs(answer) || self.key.declares_e {
            return;
        }
        let (a, b) = (expected.map(&number), answer.map(&number));
        if occurs(&a) || occurs(&b) {
            return;
        }
        let (other, mine) = (self.key.with(a), self.reading.with(b));
        let found = compare::contents(&other, &mine, &self.options.plain());
        if !found.is_equivalent() {
            // Beside an exponential function or a logarithm e is no symbol that is too much.
            let is_exp =
                |part: &Expr| matches!(part.node(), Node::Call(Function::Exp | Function::Ln, _));
            if expected.parts().any(is_exp) {
                self.finding = found;
            }
            return;
        }
        let counter = |name: &Symbol| matches!(&**name, "n" | "N" | "k" | "i" | "j");
        let mut exponents = expected.parts().filter_map(|part| match part.node() {
            Node::Power(base, k) if is_e(base) => Some(k),
            _ => None,
        });
        let counts = |k: &Expr| is_count(k) && (!logarithm || k.symbols().iter().any(counter));
        if !(occurs(expected) && exponents.all(counts)) {
            self.finding = found;
            let given = "e is the base of the natural logarithm";
            self.finding.assumed.push(given.into());
            return;
        }
        let words = "e is a symbol; as the base of the natural logarithm it would be right";
        let hint = "write exp(x) for the exponential function";
        ambiguous(&mut self.finding, words, hint);
    }

    /// `y'` for `dy/dx`, which would be right if it is that: a prime does not say by what.
    pub(in crate::grade) fn primes(&mut self) {
        let primed = |name: &Symbol| {
            let (of, _) = name.strip_prefix('d')?.split_once("/d")?;
            Some((name.clone(), Expr::symbol(&Symbol::from(format!("{of}'")))))
        };
        let sides = [&self.key.reading.content, &self.reading.content];
        let names = sides.into_iter().flat_map(Content::symbols);
        let primed: BTreeMap<Symbol, Expr> = names.filter_map(|name| primed(&name)).collect();
        if !self.is_wrong() || primed.is_empty() {
            return;
        }
        let [expected, mine] = sides.map(|content| content.map(&|e| e.substitute(&primed)));
        let other = self.key.with(expected);
        if compare::contents(&other, &self.reading.with(mine), self.options).is_equivalent() {
            let words = "a prime does not say by what is differentiated; it would be right as the derivative that is asked for";
            let hint = "write the derivative as a quotient, as in dy/dx";
            ambiguous(&mut self.finding, words, hint);
        }
    }

    /// `e^(i theta)` with an i that the question does not know: what sets the two apart is told of a symbol, and is no belief
    /// where the imaginary unit was meant.
    pub(in crate::grade) fn imaginary(&mut self) {
        let turns = |k: &Expr| !is_count(k) && (k.mentions("i") || k.mentions("j"));
        let contents = [&self.key.reading.content, &self.reading.content];
        let all = contents.into_iter().flat_map(Content::parts);
        let found = all.filter_map(exponent).any(turns);
        let open = self.is_wrong() && !self.key.declares_i;
        if open && found {
            let words =
                "i or j in an exponent is read as a symbol; complex numbers are not compared";
            let hint = "write cosines and sines, or declare i and j where they are quantities";
            self.finding.note = "DIFF";
            self.finding.diagnosis = vec![Diagnosis::new("AMBIGUOUS", words, hint)];
        }
        if let [Some(a), Some(b)] = contents.map(|content| content.answer().expr())
            && open
            && agree_as_complex(&turning(&(a - b)), &self.key.question.domains)
        {
            let words = "i is read as a symbol; as the imaginary unit it would be right";
            let hint = "complex numbers are not compared: ask for real and imaginary part";
            ambiguous(&mut self.finding, words, hint);
        }
    }

    /// `x = n pi` for an equation in sines: its n may stand for any whole number, which is told of no symbol.
    pub(in crate::grade) fn any_whole_number(&mut self) {
        let (expected, answer) = (&self.key.reading.content, &self.reading.content);
        let count = counted_turns(expected, answer).or_else(|| counted_turns(answer, expected));
        if let (true, Some(count)) = (self.is_wrong(), count) {
            let words = format!(
                "{count} is read as a symbol; what holds for any whole number is not compared"
            );
            ambiguous(
                &mut self.finding,
                &words,
                "give the solutions of one period",
            );
        }
    }
}

fn is_e(e: &Expr) -> bool {
    e.as_symbol().is_some_and(|name| &**name == "e")
}

/// What e is raised to.
fn exponent(e: &Expr) -> Option<&Expr> {
    match e.node() {
        Node::Power(base, k) if is_e(base) => Some(k),
        Node::Call(Function::Exp, k) => Some(k),
        _ => None,
    }
}

/// cos x + i sin x for e to the power of i x.
fn turning(e: &Expr) -> Expr {
    let factor = |k: &Expr| match k.node() {
        Node::Product(parts) => {
            let (units, others): (Vec<_>, Vec<_>) = parts
                .iter()
                .cloned()
                .partition(|part| *part == Expr::symbol("i"));
            (units.len() == 1 && others.iter().all(|part| !part.mentions("i")))
                .then(|| Expr::product(others))
        }
        _ => (*k == Expr::symbol("i")).then(Expr::one),
    };
    match exponent(e).and_then(factor) {
        Some(x) => {
            Expr::call(Function::Cos, x.clone()) + Expr::symbol("i") * Expr::call(Function::Sin, x)
        }
        None => e.map_parts(turning),
    }
}

/// Whether a difference vanishes where i² = −1: its even and its odd part in i do, which stand on i² alone.
fn agree_as_complex(difference: &Expr, domains: &Domains) -> bool {
    let square = Expr::symbol("i^2");
    let root = square.sqrt();
    let [plus, minus] = [&root, &-&root].map(|root| difference.put("i", root));
    let vanishes = |part: Expr| {
        let part = algebra::tidy(&part, domains).ok();
        let part = part.map(|part| part.replace(&root, &Expr::symbol("i")));
        let part = part.filter(|part| !part.mentions("i"));
        let there = part.map(|part| part.put("i^2", &Expr::from(-1)));
        there.is_some_and(|there| algebra::tidy(&there, domains).is_ok_and(|e| e.is_zero()))
    };
    difference.mentions("i") && vanishes(&plus + &minus) && vanishes((&plus - &minus) * &root)
}

/// The letter that counts turns in what is said of an equation in sines, which does not know it.
fn counted_turns(equation: &Content, said: &Content) -> Option<Symbol> {
    let known = equation.symbols();
    let is_count = |name: &Symbol| matches!(&**name, "n" | "k" | "m" | "N" | "j");
    let mut counts = said.symbols().into_iter();
    let count = counts.find(|name| !known.contains(name) && is_count(name))?;
    let is_turn = |part: &Expr| {
        matches!(part.node(), Node::Product(_)) && part.mentions(&count) && part.mentions("pi")
    };
    let is_arc = |part: &Expr| {
        use Function::{Cos, Sin, Tan};
        matches!(part.node(), Node::Call(Sin | Cos | Tan, _))
    };
    (said.parts().any(is_turn) && equation.parts().any(is_arc)).then_some(count)
}

/// Whether an exponent may count something: a whole number, a symbol, or a sum of such with positive factors.
fn is_count(k: &Expr) -> bool {
    let whole = |e: &Expr| e.is_integer();
    match k.node() {
        Node::Symbol(_) => true,
        Node::Sum(terms) => terms.iter().all(is_count),
        Node::Product(factors) => match factors.as_slice() {
            [number, rest] => {
                whole(number)
                    && number.as_number().is_some_and(Signed::is_positive)
                    && rest.as_symbol().is_some()
            }
            _ => false,
        },
        _ => whole(k),
    }
}
