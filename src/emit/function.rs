//! The functions a scene's answers become: what each takes, what it gives, how wrong it may be, and within what range.
//!
//! In: a scene and its derivation. Out: one [`Function`] per number asked for. Knows nothing of languages.

use num_traits::{One, Zero};

use super::arrange::{Atoms, arranged, signs, without_angles};
use super::dd::Dd;
use super::program::{Bound, Op, Program, Step};
use super::range::{Input, divides_safely, reach};
use super::units::{Units, units};
use crate::answer::{Answer, Form};
use crate::derive::Derivation;
use crate::dimension::{self, Dimension};
use crate::expr::angle::angle;
use crate::expr::number::{from_f64, to_f64};
use crate::expr::{Expr, Function as Call, Node, Rational, Symbol};
use crate::formula::write_plain;
use crate::scene::Scene;

/// An argument of a function.
#[derive(Clone, Debug)]
pub struct Argument {
    /// The scene's symbol.
    pub symbol: Symbol,
    /// Its dimension.
    pub dimension: Dimension,
    /// Its unit; values are in SI units.
    pub unit: String,
    /// What it is, in words; empty where the scene does not say.
    pub meaning: String,
    /// Where it lies, `0 ≤ theta ≤ pi/2` say; empty where anywhere.
    pub domain: String,
}

/// The cosine and the sine of an angle, as a program needs them.
#[derive(Default, Clone, Debug)]
pub struct Turn {
    /// The angle: coefficients of arguments, by number.
    pub terms: Vec<(f64, usize)>,
    /// Multiple of π in it, as a double-double; zero where none.
    pub pi: Dd,
    /// The program's inputs that stand for its cosine and its sine.
    pub cos: Option<usize>,
    /// See `cos`.
    pub sin: Option<usize>,
    /// Whether double-doubles are needed: digits would cancel, or the angle itself is no double.
    pub wide: bool,
}

impl Turn {
    /// Whether the angle is an argument, or one times a power of two: then doubles hold it exactly.
    pub fn is_plain(&self) -> bool {
        let exact = |k: f64| k.abs().log2().fract() == 0.0;
        self.pi == Dd::default() && matches!(self.terms.as_slice(), [(k, _)] if exact(*k))
    }
}

/// A program with all that a reader of its code has to know.
#[derive(Clone, Debug)]
pub struct Function {
    /// Name of the answer.
    pub name: String,
    /// What it gives.
    pub words: String,
    /// The unit of its value.
    pub unit: String,
    /// The closed form the program evaluates.
    pub formula: String,
    /// What it takes.
    pub arguments: Vec<Argument>,
    /// Sines and cosines to form first.
    pub turns: Vec<Turn>,
    /// The steps. Inputs below the number of arguments are those; the others are cosines and sines.
    pub program: Program,
    /// What its value may be wrong by, in units of 2⁻⁵³ of it; `None` where a function of unknown error is in it.
    pub bound: Option<Bound>,
    /// Nothing over- or underflows while no argument other than zero lies outside 10^−k … 10^k, sums that cancel aside.
    pub reach: i32,
    /// Units in which larger and smaller arguments are measured first; `None` where the formula allows none.
    pub units: Option<Units>,
}

impl Function {
    /// The value in doubles at arguments in SI units; NaN or infinite where there is none or doubles do not reach. Sums of
    /// angles are taken in double-doubles, their cosines and sines to first order in the second double. `inputs` and
    /// `slots` are scratch space.
    pub fn value(&self, arguments: &[f64], inputs: &mut Vec<f64>, slots: &mut Vec<Dd>) -> f64 {
        inputs.clear();
        inputs.extend_from_slice(arguments);
        inputs.resize(self.program.inputs, 0.0);
        for turn in &self.turns {
            let terms = turn.terms.iter();
            let angle = terms.fold(turn.pi, |sum, (k, a)| {
                sum + Dd::exact(*k) * Dd::exact(arguments[*a])
            });
            let (sin, cos) = angle.high.sin_cos();
            if let Some(at) = turn.cos {
                inputs[at] = cos - angle.low * sin;
            }
            if let Some(at) = turn.sin {
                inputs[at] = sin + angle.low * cos;
            }
        }
        self.program.value(inputs, slots)
    }
}

/// Error of a cosine or sine of the library, one unit in the last place, in units of 2⁻⁵³.
pub const LIBRARY: f64 = 2.0;
/// Relative error of a cosine or sine in double-doubles of an angle up to 100, in units of 2⁻⁵³: no double below 100 but 0
/// is nearer to a multiple of π/2 than 2⁻⁶¹, and taking those off leaves an error below 2⁻¹⁵¹.
const WIDE_WAVE: f64 = 1.0 / (1u64 << 37) as f64;

/// A function for every number the scene asks for; the names of those that are none in doubles come second. A value that
/// needs no argument, zero say, takes those of all others, so that it is called as they are.
pub fn functions(scene: &Scene, derivation: &Derivation) -> (Vec<Function>, Vec<String>) {
    let mut found = Vec::new();
    let mut without = Vec::new();
    for answer in &derivation.answers {
        match function(scene, derivation, answer) {
            Some(f) => found.push(f),
            None => without.push(answer.name.clone()),
        }
    }
    let constant = |f: &Function| f.arguments.is_empty();
    let mut all: Vec<Argument> = Vec::new();
    for argument in found.iter().flat_map(|f| &f.arguments) {
        if !all.iter().any(|a| a.symbol == argument.symbol) {
            all.push(argument.clone());
        }
    }
    let place = |a: &Argument| scene.parameters.iter().position(|p| p.name == a.symbol);
    all.sort_by_key(place);
    for f in found.iter_mut().filter(|f| constant(f)) {
        f.program.inputs = all.len();
        f.arguments = all.clone();
    }
    (found, without)
}

fn function(scene: &Scene, derivation: &Derivation, answer: &Answer) -> Option<Function> {
    let Form::Value { closed, short } = &answer.form else {
        return None;
    };
    let mut defined = std::collections::BTreeMap::<Symbol, Expr>::new();
    for d in &derivation.definitions {
        let value = d.value.substitute(&defined);
        defined.insert(d.name.clone(), value);
    }
    let forms = [closed, short].map(|form| form.substitute(&defined));
    // Plain steps alone are quicker and as good. Then a determinant should be a sum of terms of one sign, never a
    // difference of products; then the length counts.
    let candidates = forms.iter().filter_map(|form| draft(scene, form));
    let Draft {
        program,
        arguments,
        atoms,
        reach,
        form,
        ..
    } = candidates.min_by_key(|d| (d.program.is_wide(), !d.safe, d.program.steps.len()))?;
    let turns = turns(&atoms, &arguments, &program)?;
    let mut errors = vec![0.0; arguments.len() + atoms.len()];
    for turn in &turns {
        for wave in [turn.cos, turn.sin].into_iter().flatten() {
            errors[wave] = if turn.wide { 1.0 } else { LIBRARY };
        }
    }
    let wide_errors: Vec<f64> = errors.iter().map(|e| e.min(WIDE_WAVE)).collect();
    let bound = program.bound(&errors, &wide_errors);
    let arguments: Vec<Argument> = arguments.iter().map(|a| argument(scene, a)).collect();
    Some(Function {
        name: answer.name.clone(),
        words: answer.words.clone(),
        unit: answer.unit(scene),
        formula: write_plain(&form),
        units: units_of(&form, &arguments, &answer.dimension).filter(|_| reach > 0),
        arguments,
        turns,
        program,
        bound,
        reach,
    })
}

/// Units for a formula whose dimensions agree: one with a length written as a bare number gives other values in others.
fn units_of(form: &Expr, arguments: &[Argument], value: &Dimension) -> Option<Units> {
    let known = |name: &str| {
        let argument = arguments.iter().find(|a| &*a.symbol == name)?;
        Some(argument.dimension.clone())
    };
    let agrees = dimension::of(form, &known).is_ok_and(|found| found.as_ref() == Some(value));
    let dimensions: Vec<Dimension> = arguments.iter().map(|a| a.dimension.clone()).collect();
    agrees.then(|| units(&dimensions, value))?
}

/// A program with its arguments, and the cosines and sines that follow them as inputs.
struct Draft {
    form: Expr,
    program: Program,
    arguments: Vec<Symbol>,
    atoms: Atoms,
    reach: i32,
    /// Whether no divisor can cancel.
    safe: bool,
}

fn draft(scene: &Scene, form: &Expr) -> Option<Draft> {
    let mut atoms = Atoms::new();
    let plain = without_angles(form, &mut atoms);
    // An angle's symbols are arguments even where only its cosine is needed.
    let mut arguments: Vec<Symbol> = plain.symbols().into_iter().collect();
    arguments.extend(atoms.iter().flat_map(|(_, of)| of.symbols()));
    arguments.retain(|a| &**a != "pi" && !atoms.iter().any(|(name, _)| name == a));
    let order = |a: &Symbol| scene.parameters.iter().position(|p| p.name == *a);
    arguments.sort_by(|a, b| order(a).cmp(&order(b)).then(a.cmp(b)));
    arguments.dedup();
    let signs = signs(&scene.domains, &atoms);
    let input = |name: &Symbol, is_argument| Input {
        is_argument,
        sign: signs.get(name).copied(),
    };
    let waves = atoms.iter().map(|(name, _)| input(name, false));
    let known = arguments.iter().map(|a| input(a, true)).chain(waves);
    let known: Vec<Input> = known.collect();
    let names = atoms.iter().map(|(name, _)| name.clone());
    let inputs: Vec<Symbol> = arguments.iter().cloned().chain(names).collect();
    let program = arranged(&plain, &inputs, &signs)?;
    let reach = reach(&program, &known);
    let safe = divides_safely(&program, &known);
    Some(Draft {
        form: form.clone(),
        safe,
        program,
        arguments,
        atoms,
        reach,
    })
}

fn turns(atoms: &Atoms, arguments: &[Symbol], program: &Program) -> Option<Vec<Turn>> {
    let mut turns: Vec<Turn> = Vec::new();
    for (i, (_, of)) in atoms.iter().enumerate() {
        let Node::Call(call, argument) = of.node() else {
            return None;
        };
        let sum = angle(argument)?;
        let mut terms = Vec::new();
        for (symbol, factor) in &sum.symbols {
            // A third of an angle is no double; no scene has one, and a wrong bound would be worse than none.
            let k = to_f64(factor);
            if from_f64(k).as_ref() != Some(factor) {
                return None;
            }
            terms.push((k, arguments.iter().position(|a| a == symbol)?));
        }
        let pi = multiple_of_pi(&sum.pi);
        let same = turns.iter().position(|t| t.terms == terms && t.pi == pi);
        let place = same.unwrap_or(turns.len());
        if same.is_none() {
            turns.push(Turn {
                terms,
                pi,
                ..Turn::default()
            });
        }
        let turn = &mut turns[place];
        let input = arguments.len() + i;
        match call {
            Call::Sin => turn.sin = Some(input),
            _ => turn.cos = Some(input),
        }
        let is_wide = |s: &Step| s.wide && s.op == Op::Input(input);
        turn.wide |= !turn.is_plain() || program.steps.iter().any(is_wide);
    }
    Some(turns)
}

fn multiple_of_pi(factor: &Rational) -> Dd {
    match factor {
        none if none.is_zero() => Dd::default(),
        one if one.is_one() => super::dd::PI,
        _ => Dd::from_rational(factor) * super::dd::PI,
    }
}

fn argument(scene: &Scene, symbol: &Symbol) -> Argument {
    let parameter = scene.parameter(symbol);
    let domain = scene.domains.symbols.get(symbol);
    Argument {
        symbol: symbol.clone(),
        dimension: parameter.map_or_else(Dimension::none, |p| p.dimension.clone()),
        unit: parameter.map_or_else(String::new, |p| match p.is_angle() {
            true => "rad".into(),
            false => p.dimension.spoken(),
        }),
        meaning: parameter.map_or_else(String::new, |p| p.meaning.clone()),
        domain: domain.map_or_else(String::new, |d| d.words(symbol)),
    }
}
