//! The generators of a field, the relations between them, and arithmetic of its elements.

use std::cell::{OnceCell, RefCell};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};
use rustc_hash::FxHashMap;

use super::Stop;
use super::element::{Den, Element};
use super::fuel::Fuel;
use super::mono::{Mono, exponent, mono_max, mono_of};
use super::points::Held;
use super::poly::Poly;
use super::range;
use crate::domain::Domains;
use crate::expr::angle::angle;
use crate::expr::{Expr, Function, Int, Node, Rational, Symbol, Table};

/// Most different angles in one argument.
pub(super) const MOST_ANGLES: usize = 24;

/// Highest multiple of an angle that is written out where no other multiple asks for it.
const MOST_WRITTEN_OUT: i64 = 8;

/// Largest common denominator of exponents with symbols.
const MOST_EXPONENT_PARTS: i64 = 12;

/// What a variable of the polynomials stands for.
#[derive(Clone, Debug)]
pub(crate) enum Kind {
    Symbol(Symbol),
    /// Cosine of a base angle, by index.
    Cos(usize),
    /// Sine of a base angle, by index.
    Sin(usize),
    /// The non-negative root of its relation's value.
    Root,
    /// Absolute value of a polynomial.
    Abs(Poly),
    /// A function this field knows nothing about but congruence.
    Call(Function, Element),
    /// A power whose exponent is no number.
    Power(Element, Element),
}

/// A variable and, where it is algebraic, the relation gⁿ = value over the variables before it.
#[derive(Clone, Debug)]
pub(crate) struct Generator {
    pub kind: Kind,
    pub relation: Option<(u32, Poly)>,
}

/// What an angle is made of.
#[derive(Clone, Debug)]
pub(crate) enum AngleOf {
    Symbol(Symbol),
    /// A term such as ω t.
    Term(Element),
}

/// The base angle part · of, with the variables of its cosine and sine.
#[derive(Clone, Debug)]
pub(crate) struct Base {
    pub of: AngleOf,
    pub part: Rational,
    pub cos: usize,
    pub sin: usize,
}

/// Something used that was not proved.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Assumption {
    /// The expression was nowhere seen negative on the domain, and is taken to be non-negative there.
    NotNegative(Expr),
}

/// Generators (symbols, cosines and sines of base angles, roots, opaque calls) and the relations between them.
#[derive(Clone, Debug)]
pub struct Field {
    pub(crate) domains: Domains,
    pub(crate) gens: Vec<Generator>,
    pub(super) names: BTreeMap<Symbol, usize>,
    pub(crate) bases: Vec<Base>,
    /// Algebraic generators in the order they were adjoined.
    pub(crate) algebraic: Vec<usize>,
    /// Exponent bits ≥ 2 of the algebraic generators: a quick test for "nothing to reduce".
    mask: Mono,
    pub(crate) assumed: Vec<Element>,
    /// Polynomials taken to be positive, or not negative where the flag tells that they may vanish: by the relations of the
    /// domain, and by [`Field::suppose`].
    pub(crate) supposed: Vec<(Poly, bool)>,
    pub(crate) complete: bool,
    /// What exponents with symbols are multiplied by to be free of fractions: b^(n/2) stands for bⁿ too where both occur.
    pub(crate) exponent_parts: i64,
    /// Values of the generators at fixed points of the domain, made when first needed.
    pub(crate) samples: RefCell<Vec<Vec<f64>>>,
    /// At which of these points what is supposed holds, found when first needed.
    pub(super) held: OnceCell<Held>,
    /// What halving the domain has told of signs.
    pub(super) halved: RefCell<BTreeMap<Poly, range::Found>>,
    /// Whether a root is known to be positive, of those whose radicand's sign has been looked for.
    pub(super) roots: RefCell<BTreeMap<usize, bool>>,
    /// Roots whose radicand's sign is being looked for.
    pub(super) asked: RefCell<Vec<usize>>,
    pub(crate) fuel: Fuel,
    /// Normal forms found so far; the same few formulas are read again and again.
    pub(crate) read: FxHashMap<Expr, Element>,
    /// What was written last; the same values are asked for in equations, answers and proofs.
    pub(crate) wrote: RefCell<VecDeque<(Element, Expr)>>,
}

impl Field {
    /// A field without generators over the given domains.
    pub fn new(domains: &Domains) -> Field {
        Field {
            domains: domains.clone(),
            gens: Vec::new(),
            names: BTreeMap::new(),
            bases: Vec::new(),
            algebraic: Vec::new(),
            mask: Mono::new(),
            assumed: Vec::new(),
            supposed: Vec::new(),
            complete: true,
            exponent_parts: 1,
            samples: RefCell::default(),
            held: OnceCell::new(),
            halved: RefCell::default(),
            roots: RefCell::default(),
            asked: RefCell::default(),
            fuel: Fuel::new(),
            read: FxHashMap::default(),
            wrote: RefCell::default(),
        }
    }

    /// A field that knows a formula, and its element.
    pub fn of(domains: &Domains, e: &Expr) -> Result<(Field, Element), Stop> {
        let mut field = Field::new(domains);
        field.prepare([e]);
        let x = field.element(e)?;
        Ok((field, x))
    }

    /// A field that knows two formulas, and their elements.
    pub fn pair(domains: &Domains, a: &Expr, b: &Expr) -> Result<(Field, Element, Element), Stop> {
        let mut field = Field::new(domains);
        field.prepare([a, b]);
        let (x, y) = (field.element(a)?, field.element(b)?);
        Ok((field, x, y))
    }

    /// Everything from now on together may take so much work, counted in products of terms; then each operation ends with
    /// [`Stop::TooLarge`].
    pub fn limit(&self, work: u64) {
        self.fuel.limit(work);
    }

    /// Takes in the symbols and angles of all expressions to come, so that base angles and the order of variables do not
    /// depend on the order in which the expressions are read. May be called once more for further symbols; an angle
    /// divided more finely than before is then opaque.
    pub fn prepare<'a>(&mut self, exprs: impl IntoIterator<Item = &'a Expr>) {
        // A relation made now may change normal forms found before.
        self.read.clear();
        let mut found = Found::default();
        for e in exprs {
            found.collect(e);
        }
        let parts = self.exponent_parts.lcm(&found.exponent_parts.max(1));
        if parts <= MOST_EXPONENT_PARTS {
            self.exponent_parts = parts;
        }
        let relations = self.relations(&found.names());
        for relation in &relations {
            found.collect(&relation.excess);
        }
        for pair in &self.domains.unit_vectors {
            if pair.iter().any(|name| found.symbols.contains_key(name)) {
                let pair = pair.iter().map(|name| (name.clone(), ()));
                found.symbols.extend(pair);
            }
        }
        for name in found.symbols.keys() {
            self.symbol(name);
        }
        // Arguments such as ω t: the plain ones first, those with functions inside once the angles of these are known.
        found.others.sort_by_key(|e| (e.size(), e.clone()));
        found.others.dedup();
        let (nested, plain): (Vec<Expr>, Vec<Expr>) = found.others.into_iter().partition(has_call);
        let mut terms = Vec::new();
        self.note_terms(&plain, &mut found.angles, &mut terms);
        let plain = terms.len();
        for (name, part) in std::mem::take(&mut found.angles) {
            if self.base_of(&name).is_none() {
                self.add_base(AngleOf::Symbol(name), &part);
            }
        }
        self.note_terms(&nested, &mut found.angles, &mut terms);
        self.add_exponentials(&found.exponents);
        for (i, (term, part)) in terms.into_iter().enumerate() {
            // Arguments with functions inside are multiplied out: what else comes of them is not among the terms.
            let part = if i < plain { part } else { handy(&part) };
            let same = |b: &Base| matches!(&b.of, AngleOf::Term(t) if self.equal(t, &term));
            if let (false, Some(_)) = (self.bases.iter().any(same), part.denom().to_u32()) {
                self.add_base(AngleOf::Term(term), &part);
            }
        }
        self.relate_signs(&relations);
    }

    /// The terms of arguments with the largest part of them that all are multiples of; bare symbols among the angles.
    fn note_terms(
        &mut self,
        arguments: &[Expr],
        angles: &mut Table<Rational>,
        terms: &mut Vec<(Element, Rational)>,
    ) {
        for argument in arguments {
            let Ok(element) = self.element(argument) else {
                continue;
            };
            let found = self.angle_terms(&element);
            // Reading such an argument will meet the same limit.
            if found.len() > MOST_ANGLES {
                continue;
            }
            for (term, factor) in found {
                match self.as_symbol(&term) {
                    Some(name) if &*name == "pi" => {}
                    Some(name) => refine(angles.get_or_insert(&name, Rational::zero), &factor),
                    None => self.note_term(terms, term, &factor),
                }
            }
        }
    }

    /// A term with the largest part that its coefficients are multiples of.
    fn note_term(&self, terms: &mut Vec<(Element, Rational)>, term: Element, factor: &Rational) {
        match terms.iter_mut().find(|(t, _)| self.equal(t, &term)) {
            Some((_, part)) => *part = common(part, factor),
            None => terms.push((term, factor.clone())),
        }
    }

    /// e to the largest parts of exponents of which all are whole multiples: eˣ is the square of what stands for e^(x/2),
    /// whichever is read first.
    fn add_exponentials(&mut self, exponents: &[Expr]) {
        if exponents.len() < 2 {
            return;
        }
        let mut terms: Vec<(Element, Rational)> = Vec::new();
        self.note_terms(exponents, &mut Table::default(), &mut terms);
        for e in exponents {
            let Ok(element) = self.element(e) else {
                continue;
            };
            // Bare symbols are not among the terms.
            for (term, factor) in self.angle_terms(&element) {
                self.note_term(&mut terms, term, &factor);
            }
        }
        for (term, part) in terms {
            let part = self.number(&handy(&part));
            if let Ok(own) = self.mul(&term, &part) {
                let _ = self.exponential(&own);
            }
        }
    }

    /// Takes what an expression vanishes with not to be negative: for proofs about points at which a root or a logarithm of
    /// it has a value. Whether anything new was learnt: where another factor may be zero, nothing is told of the rest.
    pub fn suppose(&mut self, e: &Expr) -> bool {
        let Some((p, false)) = self.undecided_part(e) else {
            return false;
        };
        self.take(p, true);
        true
    }

    /// The variable of a symbol, new if need be.
    pub(crate) fn symbol(&mut self, name: &Symbol) -> usize {
        match self.names.get(name) {
            Some(v) => *v,
            None => {
                // The component of a unit vector that the other one follows from comes before it.
                let mut pairs = self.domains.unit_vectors.iter();
                let free = pairs.find_map(|[a, b]| (b == name && a != name).then(|| a.clone()));
                let free = free.filter(|free| !self.names.contains_key(free));
                for name in free.iter().chain([name]) {
                    let v = self.adjoin(Kind::Symbol(name.clone()));
                    self.names.insert(name.clone(), v);
                }
                for name in free.iter().chain([name]) {
                    self.relate_units(name);
                }
                self.names[name]
            }
        }
    }

    /// The base angle that is a symbol or a part of one.
    pub(super) fn base_of(&self, name: &Symbol) -> Option<usize> {
        let mut bases = self.bases.iter();
        bases.position(|b| matches!(&b.of, AngleOf::Symbol(s) if s == name))
    }

    /// The first generator of some kind.
    pub(super) fn generator_that(&self, is: impl Fn(&Kind) -> bool) -> Option<usize> {
        self.gens.iter().position(|g| is(&g.kind))
    }

    /// Components of a unit vector come together, with b² = 1 − a².
    fn relate_units(&mut self, name: &Symbol) {
        for [a, b] in self.domains.unit_vectors.clone() {
            if a == b || (a != *name && b != *name) {
                continue;
            }
            let (a, b) = (self.symbol(&a), self.symbol(&b));
            let value = Poly::rest_of_square(a);
            match &self.gens[b].relation {
                None if self.gens[a].relation.is_none() => self.relate(b, 2, value),
                Some((_, known)) if *known == value => {}
                // A symbol in two pairs: the second relation is not used.
                _ => self.complete = false,
            }
        }
    }

    pub(crate) fn adjoin(&mut self, kind: Kind) -> usize {
        self.gens.push(Generator {
            kind,
            relation: None,
        });
        self.gens.len() - 1
    }

    pub(crate) fn relate(&mut self, v: usize, degree: u32, value: Poly) {
        self.gens[v].relation = Some((degree, value));
        self.algebraic.push(v);
        self.mask = mono_max(&self.mask, &mono_of(v, 0x7e));
    }

    /// A base angle of which multiples of the part stand for cosines and sines.
    pub(crate) fn add_base(&mut self, of: AngleOf, part: &Rational) -> usize {
        let index = self.bases.len();
        let (cos, sin) = (self.adjoin(Kind::Cos(index)), self.adjoin(Kind::Sin(index)));
        self.relate(sin, 2, Poly::rest_of_square(cos));
        self.bases.push(Base {
            of,
            part: part.abs(),
            cos,
            sin,
        });
        index
    }

    /// Whether "not zero" means "not identical": true unless a generator may hide a relation this field does not know
    /// (an opaque function, a power with a symbolic exponent, a root whose dependence on others was not searched fully).
    pub fn complete(&self) -> bool {
        self.complete
    }

    /// The normal form, unless it rests on a sign that was only seen at sample points.
    pub fn proved(&mut self, e: &Expr) -> Result<Option<Element>, Stop> {
        let before = self.assumed.len();
        let element = self.element(e)?;
        let proved = self.assumed.len() == before;
        self.assumed.truncate(before);
        Ok(proved.then_some(element))
    }

    /// Signs that were only seen at sample points and not proved.
    pub fn assumptions(&self) -> Vec<Assumption> {
        let assumed = self.assumed.iter().map(|x| self.expr(x));
        assumed.map(Assumption::NotNegative).collect()
    }

    // ---- polynomials modulo the relations ----

    /// Whether no relation has anything to do with a monomial.
    pub(super) fn is_reduced(&self, mono: &[u64]) -> bool {
        mono.iter().zip(&self.mask).all(|(w, k)| w & k == 0)
    }

    pub(crate) fn reduce(&self, p: Poly) -> Result<Poly, Stop> {
        if p.terms().all(|(m, _)| self.is_reduced(m)) {
            return Ok(p);
        }
        let mut p = p;
        for &g in self.algebraic.iter().rev() {
            let Some((degree, value)) = &self.gens[g].relation else {
                continue;
            };
            while let Some((low, high)) = p.divide_by_power(g, *degree) {
                self.fuel.burn(high.len() * value.len())?;
                p = low.add(&high.mul(value)?);
            }
        }
        // A value may bring back powers of generators adjoined earlier only; those come later in the loop above.
        Ok(p)
    }

    pub(crate) fn mul_poly(&self, a: &Poly, b: &Poly) -> Result<Poly, Stop> {
        if b.is_one() {
            return Ok(a.clone());
        }
        self.fuel.burn(a.len() * b.len())?;
        self.reduce(a.mul(b)?)
    }

    // ---- elements ----

    /// The element of a fraction.
    pub fn number(&self, value: &Rational) -> Element {
        let num = Poly::constant(value.numer().clone());
        Element::new(num, Den::of(value.denom().clone()))
    }

    /// The element of a whole number.
    pub fn integer(&self, value: i64) -> Element {
        Element::from_poly(Poly::constant(Int::from(value)))
    }

    /// Whether the element is zero: a decision, not a test.
    pub fn is_zero(&self, x: &Element) -> bool {
        x.num.is_zero()
    }

    /// Whether two elements are the same; a limit met counts as "not shown".
    pub fn equal(&self, a: &Element, b: &Element) -> bool {
        (a.num == b.num && a.den == b.den) || self.sub(a, b).is_ok_and(|d| self.is_zero(&d))
    }

    /// −a.
    pub fn neg(&self, a: &Element) -> Element {
        Element::new(a.num.neg(), a.den.clone())
    }

    /// a + b.
    pub fn add(&self, a: &Element, b: &Element) -> Result<Element, Stop> {
        self.combine(a, b, false)
    }

    /// a − b.
    pub fn sub(&self, a: &Element, b: &Element) -> Result<Element, Stop> {
        self.combine(a, b, true)
    }

    fn combine(&self, a: &Element, b: &Element, minus: bool) -> Result<Element, Stop> {
        if b.num.is_zero() {
            return Ok(a.clone());
        }
        if a.num.is_zero() {
            return Ok(if minus { self.neg(b) } else { b.clone() });
        }
        if let Some(sum) = a.plus_like_monomial(b, minus) {
            return Ok(sum);
        }
        let join = |x: &Poly, y: &Poly| if minus { x.sub(y) } else { x.add(y) };
        if a.den == b.den {
            return self.cancel(join(&a.num, &b.num), a.den.clone());
        }
        let (den, to_a, to_b) = a.den.common(&b.den, self)?;
        let (left, right) = (self.mul_poly(&a.num, &to_a)?, self.mul_poly(&b.num, &to_b)?);
        self.cancel(join(&left, &right), den)
    }

    /// a · b.
    pub fn mul(&self, a: &Element, b: &Element) -> Result<Element, Stop> {
        if a.num.is_zero() || b.num.is_zero() {
            return Ok(Element::zero());
        }
        if a.den.is_one() && b.den.is_one() {
            return Ok(Element::from_poly(self.mul_poly(&a.num, &b.num)?));
        }
        // Cancelling crosswise first keeps the product small.
        let mut den_a = a.den.clone();
        let mut den_b = b.den.clone();
        let num_a = den_b.cancel_into(a.num.clone());
        let num_b = den_a.cancel_into(b.num.clone());
        let (den, negative) = den_a.times(&den_b, self)?;
        let num = self.mul_poly(&num_a, &num_b)?;
        self.cancel(if negative { num.neg() } else { num }, den)
    }

    /// a / b.
    pub fn div(&self, a: &Element, b: &Element) -> Result<Element, Stop> {
        if b.num.is_zero() {
            return Err(Stop::DivisionByZero);
        }
        if a.num.is_zero() {
            return Ok(Element::zero());
        }
        let (mut den_a, mut den_b) = (a.den.clone(), b.den.clone());
        den_a.strike_common(&mut den_b);
        let mut divisor = Den::one();
        let turned = divisor.multiply(&b.num, self)?;
        let num = divisor.cancel_into(a.num.clone());
        let num = match den_b.is_one() {
            true => num,
            false => self.mul_poly(&num, &den_b.expand(self)?)?,
        };
        let (den, negative) = den_a.times(&divisor, self)?;
        self.cancel(if negative ^ turned { num.neg() } else { num }, den)
    }

    /// aⁿ for a whole n.
    pub fn pow(&self, a: &Element, n: i64) -> Result<Element, Stop> {
        let k = u32::try_from(n.unsigned_abs()).map_err(|_| Stop::TooLarge("degree"))?;
        if n == 0 {
            return Ok(self.integer(1));
        }
        if n < 0 {
            return self.div(&self.integer(1), &self.pow(a, -n)?);
        }
        if k == 1 || a.num.is_zero() {
            return Ok(a.clone());
        }
        let num = if a.num.len() == 1 {
            self.reduce(a.num.pow(k)?)?
        } else {
            if k > 127 {
                return Err(Stop::TooLarge("degree"));
            }
            let mut num = a.num.clone();
            for bit in (0..k.ilog2()).rev() {
                num = self.mul_poly(&num, &num)?;
                if k >> bit & 1 == 1 {
                    num = self.mul_poly(&num, &a.num)?;
                }
            }
            num
        };
        let (den, negative) = a.den.power(k, self)?;
        self.cancel(if negative { num.neg() } else { num }, den)
    }

    /// The coefficient of a symbol in an element that is linear in it, and what is left without it.
    pub fn linear_in(&self, x: &Element, name: &str) -> Result<(Element, Element), Stop> {
        let variable = self.names.get(name);
        match variable.and_then(|v| x.num.divide_by_power(*v, 1)) {
            Some((low, high)) => Ok((
                self.cancel(high, x.den.clone())?,
                self.cancel(low, x.den.clone())?,
            )),
            None => Ok((Element::zero(), x.clone())),
        }
    }

    /// The element with a value put in for a symbol, by Horner's rule: what cancels within a coefficient is never
    /// multiplied out. The symbol must not stand in a denominator.
    pub fn put(&self, x: &Element, name: &str, value: &Element) -> Result<Element, Stop> {
        let Some(v) = self.names.get(name) else {
            return Ok(x.clone());
        };
        if x.den.factors.iter().any(|(f, _)| f.has(*v)) || exponent(&x.den.mono, *v) > 0 {
            return Err(Stop::DivisionByZero);
        }
        let highest = x.num.terms().map(|(m, _)| exponent(m, *v)).max();
        let mut total = Element::zero();
        let mut rest = x.num.clone();
        for k in (0..=highest.unwrap_or(0)).rev() {
            let (low, high) = match k {
                0 => (Poly::zero(), rest),
                _ => rest
                    .divide_by_power(*v, k)
                    .unwrap_or_else(|| (rest, Poly::zero())),
            };
            rest = low;
            let coefficient = self.cancel(high, x.den.clone())?;
            total = self.add(&self.mul(&total, value)?, &coefficient)?;
        }
        Ok(total)
    }

    /// A quotient in tidy form: nothing common with any part of the denominator that a trial division finds.
    pub(crate) fn cancel(&self, num: Poly, mut den: Den) -> Result<Element, Stop> {
        if num.is_zero() {
            return Ok(Element::zero());
        }
        if den.is_one() {
            return Ok(Element::new(num, den));
        }
        self.fuel.burn(num.len() * (1 + den.factors.len()))?;
        let num = den.cancel_into(num);
        Ok(Element::new(num, den))
    }
}

/// A part of an angle that a coefficient of it makes finer.
fn refine(part: &mut Rational, factor: &Rational) {
    let least = |r: Rational, most: i64| {
        Rational::new(r.numer().clone(), r.denom().clone().min(Int::from(most)))
    };
    if factor.denom().to_u32().is_some() {
        *part = least(common(part, &least(factor.clone(), 1_000)), 1_000_000);
    }
}

/// The largest number that both are multiples of; zero is a multiple of all.
fn common(a: &Rational, b: &Rational) -> Rational {
    Rational::new(a.numer().gcd(b.numer()), a.denom().lcm(b.denom()))
}

/// A part that what is read later is likely a multiple of too: one over its denominator, unless that would make high multiples
/// of all there is.
pub(super) fn handy(part: &Rational) -> Rational {
    match part.numer().abs() > Int::from(MOST_WRITTEN_OUT) {
        true => part.abs(),
        false => Rational::new(Int::one(), part.denom().clone()),
    }
}

/// Whether a function is called somewhere inside.
fn has_call(e: &Expr) -> bool {
    e.parts().any(|part| matches!(part.node(), Node::Call(..)))
}

/// Symbols and angles met in expressions.
#[derive(Default)]
struct Found {
    symbols: Table<()>,
    /// The largest part of each angle that its coefficients are multiples of.
    angles: Table<Rational>,
    /// Arguments of sin, cos, tan that are not linear in symbols.
    others: Vec<Expr>,
    /// Different exponents of the exponential function.
    exponents: Vec<Expr>,
    /// The least common denominator of the numbers in exponents with symbols; 0 where there are none.
    exponent_parts: i64,
}

impl Found {
    /// Symbols and angles.
    fn names(&self) -> BTreeSet<Symbol> {
        let names = self.symbols.keys().chain(self.angles.keys());
        names.cloned().collect()
    }

    fn note_parts(&mut self, exponent: &Expr) {
        let terms = match exponent.node() {
            Node::Sum(terms) => terms.as_slice(),
            _ => std::slice::from_ref(exponent),
        };
        for term in terms {
            let parts = term.split_number().0.denom().as_i64();
            let common = parts.map(|parts| self.exponent_parts.max(1).lcm(&parts));
            if let Some(common) = common.filter(|common| *common <= MOST_EXPONENT_PARTS) {
                self.exponent_parts = common;
            }
        }
    }

    fn collect(&mut self, e: &Expr) {
        match e.node() {
            Node::Number(_) => {}
            Node::Symbol(name) => {
                self.symbols.get_or_insert(name, || ());
            }
            Node::Sum(parts) | Node::Product(parts) => parts.iter().for_each(|p| self.collect(p)),
            Node::Power(base, exponent) => {
                self.collect(base);
                self.collect(exponent);
                if exponent.as_number().is_none() {
                    self.note_parts(exponent);
                }
            }
            Node::Call(Function::Sin | Function::Cos | Function::Tan, argument) => {
                match angle(argument) {
                    Some(a) => {
                        for (name, factor) in a.symbols {
                            refine(self.angles.get_or_insert(&name, Rational::zero), &factor);
                        }
                    }
                    None => {
                        self.collect(argument);
                        self.others.push(argument.clone());
                    }
                }
            }
            Node::Call(function, argument) => {
                self.collect(argument);
                if *function == Function::Exp && !self.exponents.contains(argument) {
                    self.exponents.push(argument.clone());
                }
            }
        }
    }
}
