//! The desk at which a worked solution is read: true values by name, the names a line may use, what the student has said of
//! them, and what the wrong lines imply.

use std::collections::{BTreeMap, BTreeSet};

use super::super::Options;
use super::super::sheet::Sheet;
use super::impact::Stand;
use super::letters::{MARKS, OF_CENTER};
use super::link::Link;
use super::link::Values;
use super::sought::{self, Sought};
use super::start::{ends, moments, one_freedom, parts, spins, true_values};
use super::vectors::{in_products, is_marked, marked_after};
use super::{Final, Needed, Status, wording};
use crate::derive::Moment;
use crate::equality;
use crate::expr::{Expr, Function, Node, Rational, Symbol};
use crate::formula::{self, Content, Reading, Symbols};
use crate::scene::{Ask, Question};

/// What is known while a worked solution is read: the truth, what the student has said, and what wrong lines imply.
pub(super) struct Desk<'a> {
    pub sheet: &'a Sheet,
    pub options: &'a Options,
    /// Number of the line that is read.
    pub number: usize,
    /// True values by name.
    pub closed: Values,
    /// Values at other moments of the scene, and as it goes otherwise, with words that tell when and where.
    pub moments: Vec<Moment>,
    /// The vectors with arrows that the solution names: at other moments, and of other systems of bodies.
    pub vectors: Vec<Stand>,
    /// Velocities, spins and the vectors that the solution names at the end of each motion, by name of its stage.
    pub ends: Vec<(String, Values)>,
    /// The motion whose stage the last heading names.
    pub under: Option<String>,
    /// Their components in whatever motion, first of all that moves, then of each body alone.
    pub whatever: Vec<Values>,
    /// Of which body a vector that two share is at first, and on this page.
    pub first_of: BTreeMap<String, usize>,
    pub counted: BTreeMap<String, usize>,
    /// What wrong lines imply: for each the value of one name, under all that came before.
    pub believed: Vec<(usize, Values)>,
    /// How far the numbers of wrong lines may be off, as shares.
    pub coarse: BTreeMap<usize, Rational>,
    /// Numbers that wrong lines come to by a slip of counting: the line, the number as it is written, and what it should be.
    pub miscounts: Vec<(usize, String, Expr)>,
    /// The wrong lines themselves, left minus right, with the student's own names put in.
    pub wrong: Vec<(usize, Expr)>,
    /// Every equation so far that was decided, as left minus right with the student's own names put in, and the wrong line
    /// it hangs on; `None` for what holds.
    pub stated: Vec<(Option<usize>, Expr)>,
    /// Wrong lines of which is known what led to them.
    pub explained: BTreeSet<usize>,
    /// Names of velocities and spins that all follow from any one of them; empty unless the motion has one freedom.
    pub moving: BTreeSet<Symbol>,
    /// Letters and indices of vectors that the page has with a prime as well.
    pub primed: BTreeSet<(String, String)>,
    /// Names that stand for what has another name in the scene.
    pub stands_for: BTreeMap<Symbol, Symbol>,
    /// Those of velocities by their bodies of which a motion may have others, until a line holds with them.
    pub by_body: BTreeSet<Symbol>,
    /// Names of velocities and spins after an impact by their bodies: of which, and 0 and 1 for the axes, 2 for the spin.
    pub of_bodies: BTreeMap<Symbol, (usize, usize)>,
    /// All names that have their values from the scene without being its own.
    pub learned: BTreeSet<Symbol>,
    /// Own names whose values are the scene's, as long as no line has spoken of them.
    pub bound: BTreeSet<Symbol>,
    /// Own names that wrong lines use, with the values of the scene by which they hold.
    pub needed: Vec<Needed>,
    /// Own names with which a line holds.
    pub proved: BTreeSet<Symbol>,
    /// Own names whose last definition could not be read.
    pub unclear: BTreeSet<Symbol>,
    /// How answers are typeset whose names read otherwise: `u_x` for a component of `u_velocity`.
    pub typeset: Vec<(Symbol, String)>,
    /// An angular acceleration that is asked for by the letter with which the solution means that of a center.
    pub turning: Option<&'a str>,
    /// Names the student introduced.
    pub own: Values,
    /// Names that were defined with a slip, or may have been: the line that shows it, the name, and its value without the slip.
    pub slipped: Vec<(usize, Symbol, Expr)>,
    /// All definitions in the solution, as text.
    pub ahead: Vec<(Symbol, String)>,
    /// Names that some line solves for.
    pub solved_for: BTreeSet<Symbol>,
    /// Names that stand for something else with a mark, and the mark.
    pub own_with_mark: BTreeSet<(Symbol, &'static str)>,
    /// Own names that were said before the last heading.
    pub of_earlier_parts: BTreeSet<Symbol>,
    /// Whether own names may stand for something else further down.
    pub anew: bool,
    /// Whether numbers of own names have units where these may be letters of the scene as well.
    pub in_units: bool,
    /// Own names that were used before the line that says what they are.
    pub early: BTreeSet<Symbol>,
    /// The lines that use them or say by a law what an own name is, left minus right as they stand.
    pub above: Vec<Expr>,
    /// Own names that have the slip of another one, and the line that shows it.
    pub carried: BTreeMap<Symbol, usize>,
    /// Spins as vectors: the name with an arrow, the spin, and whether it counts clockwise.
    pub spins: BTreeMap<Symbol, (Symbol, bool)>,
    /// Components of spins and places as vectors, `omega_vec_z` and `r_vec_B/C_x`.
    pub parts: Values,
    /// What names along the normal are in terms of components, as expressions that are zero.
    pub linked: Vec<Expr>,
    /// Parameters whose values the scene asks for.
    pub sought: Vec<Sought>,
    /// Those of them of which it was stated what is supposed, each behind the line that states it.
    pub supposed: Vec<(usize, usize)>,
    /// What is said last of each quantity.
    pub finals: BTreeMap<String, Final>,
    /// The wrong values that were given last, by what they are of.
    pub said: Values,
}

impl<'a> Desk<'a> {
    pub(super) fn new(sheet: &'a Sheet, options: &'a Options) -> Desk<'a> {
        let (mut closed, moving) = true_values(sheet);
        // A vector along one axis may be written by its letter alone: `P = m (v_G + v)`.
        let axes = ["x", "y"].map(|axis| move |name: &str| Symbol::from(format!("{name}_{axis}")));
        for q in &sheet.scene.questions {
            let [x, y] = axes.each_ref().map(|of| closed.get(&of(&q.name)));
            let along = match (x, y) {
                (Some(x), Some(y)) if x.is_zero() => Some(y),
                (Some(x), Some(y)) if y.is_zero() => Some(x),
                _ => None,
            };
            if let Some(along) = along.cloned() {
                closed.entry(Symbol::from(q.name.as_str())).or_insert(along);
            }
        }
        let mut desk = Desk {
            sheet,
            options,
            number: 0,
            moments: moments(sheet, &closed),
            closed,
            vectors: Vec::new(),
            ends: ends(sheet),
            under: None,
            whatever: Vec::new(),
            first_of: BTreeMap::new(),
            counted: BTreeMap::new(),
            primed: BTreeSet::new(),
            believed: Vec::new(),
            coarse: BTreeMap::new(),
            miscounts: Vec::new(),
            wrong: Vec::new(),
            stated: Vec::new(),
            explained: BTreeSet::new(),
            moving: if one_freedom(&sheet.scene) {
                moving
            } else {
                BTreeSet::new()
            },
            stands_for: BTreeMap::new(),
            by_body: BTreeSet::new(),
            of_bodies: BTreeMap::new(),
            learned: BTreeSet::new(),
            bound: BTreeSet::new(),
            needed: Vec::new(),
            proved: BTreeSet::new(),
            unclear: BTreeSet::new(),
            typeset: Vec::new(),
            turning: None,
            own: BTreeMap::new(),
            slipped: Vec::new(),
            ahead: Vec::new(),
            solved_for: BTreeSet::new(),
            own_with_mark: BTreeSet::new(),
            of_earlier_parts: BTreeSet::new(),
            anew: false,
            in_units: false,
            early: BTreeSet::new(),
            above: Vec::new(),
            carried: BTreeMap::new(),
            spins: spins(&sheet.scene),
            parts: parts(&sheet.scene),
            linked: Vec::new(),
            sought: sought::sought(sheet),
            supposed: Vec::new(),
            finals: BTreeMap::new(),
            said: BTreeMap::new(),
        };
        let symbols = desk.symbols("");
        let derivation = &sheet.derivation;
        let answers = derivation.answers.iter();
        let answers = answers.map(|a| (Symbol::from(a.name.as_str()), a.latex.as_str()));
        let motion = derivation.motion_by_name();
        let motion = motion.map(|(unknown, name, _)| (name, derivation.names.latex(unknown)));
        // Of a body that is called `bar` the name reads otherwise.
        let unread = answers.chain(motion).filter(|(name, latex)| {
            desk.closed.contains_key(name) && formula::read(latex, &symbols).is_err()
        });
        let typeset = unread.map(|(name, latex)| (name, latex.to_string()));
        desk.typeset = typeset.collect();
        desk
    }

    /// The names a line may use; around the cross of `ω × r_{B/C}` letters are vectors without their arrows.
    pub(super) fn symbols(&self, text: &str) -> Symbols {
        let mut symbols = Symbols::strict();
        // `\vec r_{B/C}` has its arrow.
        let arms = text.matches("r_").count() > text.matches("\\vec r_").count();
        let crossed = ["×", "\\times"].iter().any(|sign| text.contains(sign)) && arms;
        let is_vector =
            |name: &Symbol| crossed && self.spins.values().any(|(spin, _)| spin == name);
        self.sheet.declare(&mut symbols);
        let is_other = |name: &Symbol| self.turning == Some(&**name);
        if let Some(letter) = self.turning {
            symbols.declare_typeset(OF_CENTER, letter);
        }
        // The speed v_D that is given goes before a vector that is asked for and typeset otherwise.
        let given = symbols.clone();
        let is_given =
            |name: &str| formula::read_name(name, &given).is_some_and(|symbol| *symbol != *name);
        // In a product of vectors what is asked for is one by its arrow; alone on the left it is what is said.
        let in_product = in_products(text);
        // Beside `v'` a v without a mark is the one before.
        let marked = marked_after(text);
        let asked = self.sheet.scene.questions.iter();
        let asked: Vec<(String, &Question)> = asked
            .filter_map(|q| Some((formula::with_arrow(&q.name)?, q)))
            .filter(|(arrow, _)| self.parts.contains_key(&*format!("{arrow}_z")))
            .collect();
        for q in &self.sheet.scene.questions {
            let known = self.closed.contains_key(q.name.as_str());
            let spin = is_vector(&Symbol::from(q.name.as_str()));
            let mut vectors = asked.iter().filter(|(_, other)| other.name == q.name);
            let crossed = vectors.any(|(arrow, _)| in_product(arrow) || is_marked(&marked, arrow));
            let other = self.turning == Some(&*q.name);
            if other && let Some(latex) = &q.latex {
                symbols.declare_typeset(q.name.as_str(), latex);
            }
            let vector = self.components(&q.name).is_some();
            if !spin && !other && (known || vector) && !is_given(&q.name) {
                let latex = q
                    .latex
                    .as_deref()
                    .filter(|l| !crossed || !l.contains("vec"));
                symbols.declare_as(q.name.as_str(), latex, None);
            }
        }
        let later = self.moments.iter().flat_map(|(_, values)| values.keys());
        let later = later.filter(|name| !self.closed.contains_key(&**name));
        let later: BTreeSet<&Symbol> = later.collect();
        (self.closed.keys().chain(self.own.keys()))
            .chain(later.iter().copied())
            .filter(|name| !is_vector(name) && !is_given(name) && !is_other(name))
            .for_each(|name| symbols.declare(name));
        for (name, _) in self.sheet.scene.arms() {
            if let Some(arrow) = formula::with_arrow(&name) {
                let [plain, arrowed] = [&name, &arrow].map(|name| formula::latex_name(name));
                symbols.declare_as(&*arrow, Some(&plain), None);
                symbols.declare_as(&*arrow, Some(&arrowed), None);
            }
        }
        let own = self.own.keys().filter(|name| formula::is_component(name));
        let vectors = self.parts.keys().chain(own);
        for name in vectors.filter_map(|name| name.strip_suffix("_z")) {
            let asked = asked.iter().any(|(arrow, _)| arrow == name);
            let before = format!("{name}^-");
            let beside = is_marked(&marked, name);
            if asked && (in_product(name) || beside) {
                for mark in MARKS {
                    let after = format!("{}{mark}", formula::latex_name(name));
                    symbols.declare_typeset(name, &after);
                }
            }
            if beside && self.parts.contains_key(&*format!("{before}_z")) {
                symbols.declare_typeset(before.as_str(), &formula::latex_name(name));
            } else if !asked || in_product(name) {
                symbols.declare(name);
            }
        }
        for (name, latex) in &self.typeset {
            symbols.declare_typeset(name.clone(), latex);
        }
        // `ω⁺` and `ω'` are what is asked of the moment just after, and a vector may wear its arrow.
        let now = |name: &&Symbol| !name.contains('^') && !is_vector(name) && !is_other(name);
        for name in self.closed.keys().chain(later).filter(now) {
            let own = |mark: &&str| self.own_with_mark.contains(&(name.clone(), *mark));
            for mark in [""].into_iter().chain(MARKS).filter(|mark| !own(mark)) {
                let after = format!("{}{mark}", formula::latex_name(name));
                symbols.declare_typeset(name.clone(), &after);
            }
        }
        for (arrow, (spin, _)) in self.spins.iter().filter(|(_, (spin, _))| is_vector(spin)) {
            let latex = formula::latex_name(spin);
            for moment in ["", "^{+}"] {
                symbols.declare_as(arrow.clone(), Some(&format!("{latex}{moment}")), None);
            }
        }
        self.declare_arrows(&mut symbols);
        symbols
    }

    /// Declares what is asked for with an arrow, where it is a vector or a spin.
    fn declare_arrows(&self, symbols: &mut Symbols) {
        let vectors = self.sheet.scene.questions.iter().map(|q| q.name.as_str());
        let vectors = vectors.filter(|name| self.components(name).is_some());
        let spins = self
            .spins
            .iter()
            .map(|(arrow, (spin, _))| (&**arrow, &**spin));
        for (name, plain) in vectors.map(|name| (name, name)).chain(spins) {
            let latex = formula::latex_name(plain);
            let (base, index) = latex.split_at(latex.find(['_', '^']).unwrap_or(latex.len()));
            for moment in ["", "^{+}"] {
                let arrow = format!("\\vec{{{base}}}{index}{moment}");
                symbols.declare_typeset(name, &arrow);
            }
        }
    }

    /// A solution with signs and names for words, line by line.
    pub(super) fn in_names(&self, text: &str) -> String {
        let symbols = self.symbols(text);
        let asked = |word: &str| {
            let name = formula::read_name(word, &symbols);
            name.is_some_and(|name| self.closed.contains_key(&name))
        };
        let lines = text.lines().map(|line| wording::in_names(line, &asked));
        self.with_said(lines.collect()).join("\n")
    }

    /// Whether texts are read as they stand.
    pub(super) fn are_read(&self, parts: &[String]) -> bool {
        let symbols = self.symbols("");
        parts
            .iter()
            .all(|part| formula::read(part, &symbols).is_ok())
    }

    /// The line with `0.2 m` as a number of meters, where it says so of a length that is asked for or given.
    pub(super) fn in_its_unit(&self, text: &str, reading: &Reading) -> Option<Reading> {
        let (sides, _) = reading.content.relations()?;
        let name = sides.first()?.name()?;
        let mut answers = self.sheet.derivation.answers.iter();
        let asked = answers.find(|a| a.name == **name).map(|a| &a.dimension);
        let given = || Some(&self.sheet.scene.parameter(name)?.dimension);
        let dimension = asked.or_else(given).filter(|d| !d.is_none())?;
        let measured = self.measured(text, reading)?;
        let (sides, _) = measured.content.relations()?;
        let fits = |side: &Content| match side {
            Content::Quantity(q) => q.unit.dimension == *dimension,
            _ => true,
        };
        sides.iter().all(fits).then_some(measured)
    }

    /// The line with `0.2 m` as a number of meters, where m is also a mass of the scene.
    pub(super) fn measured(&self, text: &str, reading: &Reading) -> Option<Reading> {
        let mut other = reading.clone();
        let Content::Relations(sides, _) = &mut other.content else {
            return None;
        };
        let texts: Vec<&str> = text.split(['=', '≈']).collect();
        let mut found = false;
        for (side, text) in sides.iter_mut().zip(&texts).skip(1) {
            let read = formula::read(text, &Symbols::strict()).ok();
            let read =
                read.filter(|read| read.literal.is_some() && matches!(side, Content::Scalar(_)));
            if let Some(content @ Content::Quantity(_)) = read.map(|read| read.content) {
                (*side, found) = (content, true);
            }
        }
        (found && texts.len() == sides.len()).then_some(other)
    }

    /// |v| of a vector as the root of the squares of its components, and |v|² without a root.
    fn magnitudes(&self, e: &Expr) -> Expr {
        let squares = |e: &Expr| match e.node() {
            Node::Call(Function::Abs, inner) => {
                let [x, y, _] = self.components(inner.as_symbol()?)?;
                Some(x.powi(2) + y.powi(2))
            }
            _ => {
                let inside = e.under_root()?;
                let mut names = inside.symbols().into_iter();
                names
                    .any(|name| formula::is_component(&name))
                    .then(|| inside.clone())
            }
        };
        if let Node::Power(base, two) = e.node()
            && *two == Expr::from(2)
            && let Some(squares) = squares(base)
        {
            return squares;
        }
        match squares(e) {
            Some(squares) => squares.sqrt(),
            None => e.map_parts(|part| self.magnitudes(part)),
        }
    }

    /// An expression with the student's own names put in.
    pub(super) fn with_own(&self, e: &Expr) -> Expr {
        self.with_own_but(e, &Values::new())
    }

    /// The same without some of them.
    pub(super) fn with_own_but(&self, e: &Expr, others: &Values) -> Expr {
        let plain = self.with_names(e, others).substitute(&self.parts);
        self.with_names(&plain, others)
    }

    /// An expression with own names put in, which may use one another, but for some.
    fn with_names(&self, e: &Expr, others: &Values) -> Expr {
        let mut e = e.clone();
        for _ in 0..self.own.len().min(8) {
            let mut used = e.symbols();
            used.retain(|name| !others.contains_key(name));
            let own = |name: Symbol| Some((name.clone(), self.own.get(&name)?.clone()));
            let own: Values = used.into_iter().filter_map(own).collect();
            if own.is_empty() {
                break;
            }
            e = e.substitute(&own);
        }
        e
    }

    /// Whether all differences vanish with the names' values put in; those of `instead` go first.
    pub(super) fn all_zero(&self, differences: &[Expr], instead: &Values) -> Option<bool> {
        all_of(differences.iter().map(|d| {
            let value = self.put_in(d, instead);
            let domains = &self.sheet.scene.domains;
            equality::decide(&value, &Expr::zero(), domains)
                .equality
                .holds()
        }))
    }

    /// Whether they do so for certain.
    pub(super) fn vanish(&self, differences: &[Expr], instead: &Values) -> bool {
        self.all_zero(differences, instead) == Some(true)
    }

    /// Whether an expression vanishes as the scene goes.
    pub(super) fn is_zero(&self, e: &Expr) -> bool {
        self.vanish(std::slice::from_ref(e), &Values::new())
    }

    /// Whether an equality holds as the scene goes.
    pub(super) fn holds(&self, link: &Link) -> bool {
        self.vanish(&link.differences, &Values::new())
    }

    /// What an expression is as the scene goes, in given quantities.
    pub(super) fn truth(&self, e: &Expr) -> Expr {
        self.put_in(e, &Values::new())
    }

    /// What is asked by a name.
    pub(super) fn ask(&self, name: &str) -> Option<&Ask> {
        Some(&self.sheet.scene.question(name)?.ask)
    }

    /// Whether a name is that of a given quantity.
    pub(super) fn is_given(&self, name: &Symbol) -> bool {
        self.sheet.scene.parameter(name).is_some()
    }

    /// The latest wrong line of those that imply something.
    pub(super) fn implied(&self, is_so: impl Fn(&Values) -> bool) -> Option<usize> {
        let mut believed = self.believed.iter().rev();
        let found = believed.find(|(_, values)| is_so(values));
        found.map(|(cause, _)| *cause)
    }

    /// What is found of a line that is or is not so with values in place of the true ones: it may be so by what a wrong line
    /// implies.
    pub(super) fn found(&self, is_so: impl Fn(&Values) -> Option<bool>, open: Status) -> Status {
        match is_so(&Values::new()) {
            Some(true) => Status::Holds,
            None => open,
            Some(false) => self
                .implied(|values| is_so(values) == Some(true))
                .map_or(Status::Wrong, Status::Carried),
        }
    }

    pub(super) fn put_in(&self, e: &Expr, instead: &Values) -> Expr {
        // A vector of another moment goes before the one that is known first.
        let vectors = instead
            .iter()
            .filter(|(name, _)| formula::is_component(name));
        let vectors: BTreeMap<_, _> = vectors.map(|(n, v)| (n.clone(), v.clone())).collect();
        // Sizes of vectors first: their components are known as such before these are put in. Own names may stand for such.
        let own = self.magnitudes(&self.with_names(e, &Values::new()));
        let own = own.substitute(&vectors);
        let own = self.with_own(&own);
        self.magnitudes(&own)
            .substitute(instead)
            .substitute(&self.closed)
    }
}

/// Whether all of something is so: it is not where one is known not to be.
pub(super) fn all_of(each: impl IntoIterator<Item = Option<bool>>) -> Option<bool> {
    let mut sure = Some(true);
    for one in each {
        match one {
            Some(true) => {}
            Some(false) => return Some(false),
            None => sure = None,
        }
    }
    sure
}
