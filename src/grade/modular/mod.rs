//! Equality at random points modulo a prime near 2⁶¹: fast, and right up to a probability that is stated.
//!
//! For quotients of polynomials in symbols, in sines and cosines of rational multiples of angles, and in square roots.
//! In: texts or expressions and the domains of their symbols; out: equal or not, with the bound. A difference is certain: an
//! identity over ℚ holds modulo every prime that divides no denominator. An equality is wrong with at most the probability
//! stated (Schwartz and Zippel: degree over p for each point), where coefficients are shown to be smaller than the prime.
//! Points are drawn by a strong hash of the two texts and what is declared: nobody can write a formula that meets them.
//! Roots follow the rules told in [`lanes`]. Whatever fits none of this is declined, and [`crate::equality`] decides.

mod build;
mod drawn;
mod exact;
mod lanes;
mod poly;
mod prime;
mod radical;
mod real;
mod value;
mod walk;

use std::sync::OnceLock;

use super::compare::Finding;
use super::{Proof, Verdict};
use crate::domain::{Domain, Domains, roles};
use crate::expr::{Expr, Symbol};
use crate::formula::stream::{Names, Seen, Table, stream};
use crate::formula::write_plain;
use build::Slot;
use exact::{Exact, Generator, Read};
use lanes::{Compared, Lanes};
use prime::{PLAIN, ROOTS};
use value::{Place, Points, Sign};

/// Points for formulas without roots; each divides the chance of an error by p over the degree.
const FEW: usize = 2;
/// Points for formulas with roots: each root makes about half of them useless.
const MANY: usize = 8;
/// Real points that go with them.
const REAL: usize = 2;
/// Finest division of an angle.
const FINEST: i32 = 24;

/// What a comparison at points found.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Quick {
    /// Whether the values agree.
    pub equal: bool,
    /// Largest probability that agreement is chance.
    pub bound: f64,
    /// Whether roots occur.
    pub roots: bool,
}

impl Quick {
    fn of(compared: Compared, roots: bool) -> Quick {
        Quick {
            equal: compared.equal,
            bound: compared.bound,
            roots,
        }
    }

    /// How the verdict is known, in words.
    pub fn words(&self) -> &'static str {
        match (self.equal, self.roots) {
            (true, false) => "equal at random points modulo 2^61 - 1",
            (true, true) => "equal at random points modulo 2^61 - 139666593, roots included",
            (false, false) => "no identity: the values differ modulo 2^61 - 1",
            (false, true) => "the values differ at a real point, by enclosures",
        }
    }

    /// The finding for a grade.
    pub(crate) fn finding(&self, assumed: Vec<String>) -> Finding {
        let mut finding = if self.equal {
            let mut proof = Proof::of("modular", self.words());
            proof.bound = Some(self.bound);
            Finding::new(Verdict::Equivalent, "EQUIV_MODULAR", proof)
        } else {
            Finding::different("DIFF", "modular", self.words())
        };
        finding.assumed = assumed;
        finding
    }
}

/// Names under sines and elsewhere, as bits.
#[derive(Clone, Copy, Default, Debug)]
pub(crate) struct Uses {
    turned: u64,
    bare: u64,
}

impl Uses {
    /// Whether no name is both an angle known by its direction and a value.
    fn fit(self, other: Uses) -> bool {
        (self.turned | other.turned) & (self.bare | other.bare) == 0
    }
}

impl From<&Seen> for Uses {
    fn from(seen: &Seen) -> Uses {
        Uses {
            turned: seen.turned,
            bare: seen.bare,
        }
    }
}

/// An expected formula, and what it takes to compare many answers with it at points.
#[derive(Clone, Debug)]
pub(crate) struct Residues {
    e: Expr,
    /// How it was written: points are drawn for the two texts of a pair.
    text: String,
    /// What is declared of the names, for the same purpose.
    declared: Vec<u8>,
    /// The names in play: their place in the list is their index.
    list: Vec<Symbol>,
    places: Vec<Option<Place>>,
    uses: Uses,
    divisor: i32,
    roots: bool,
    /// Domains assumed, in words.
    assumed: Vec<String>,
    /// The formula as a quotient of polynomials with its generators, where a proof asked for it and it is one.
    exact: OnceLock<Option<(Vec<Generator>, Read)>>,
}

/// How to go on where lanes stopped.
enum Again {
    Divide(i32),
    Roots,
    Never,
}

impl Again {
    fn of<const C: u64, const L: usize, const R: usize>(lanes: &Lanes<C, L, R>) -> Again {
        if lanes.rooted {
            Again::Roots
        } else if lanes.wanted > lanes.divisor && lanes.wanted <= FINEST {
            Again::Divide(lanes.wanted)
        } else {
            Again::Never
        }
    }
}

impl Residues {
    /// What an expected formula takes; `names` are the names in play and `text` how it was written. `None` where it is not
    /// of the kind this is for.
    pub fn of(
        e: &Expr,
        text: Option<&str>,
        domains: &Domains,
        mut names: Vec<Symbol>,
    ) -> Option<Residues> {
        // A domain without inside, or a single value, is no place for identities.
        let flat =
            |d: &Domain| matches!((&d.low, &d.high), (Some(l), Some(h)) if l.value == h.value);
        if domains.symbols.values().any(flat) {
            return None;
        }
        let roles = roles(&[e]);
        let strange: Vec<Symbol> = e
            .symbols()
            .into_iter()
            .filter(|s| !names.contains(s))
            .collect();
        names.extend(strange);
        let mut residues = Residues {
            e: e.clone(),
            text: text.map_or_else(|| write_plain(e), str::to_string),
            declared: drawn::declared(domains),
            places: names.iter().map(|name| place(name, domains)).collect(),
            list: names,
            uses: Uses::default(),
            divisor: 1,
            roots: false,
            assumed: domains.completed(&roles).1,
            exact: OnceLock::new(),
        };
        loop {
            let again = match residues.roots {
                false => residues.tried::<PLAIN, FEW, 0>(),
                true => residues.tried::<ROOTS, MANY, REAL>(),
            };
            match again {
                Ok(uses) => {
                    residues.uses = uses;
                    return uses.fit(Uses::default()).then_some(residues);
                }
                Err(Again::Divide(finer)) => residues.divisor = finer,
                Err(Again::Roots) => residues.roots = true,
                Err(Again::Never) => return None,
            }
        }
    }

    /// Whether the formula can be read into lanes of a kind.
    fn tried<const C: u64, const L: usize, const R: usize>(&self) -> Result<Uses, Again> {
        let none = Points::EMPTY;
        let mut lanes = Lanes::<C, L, R>::new(&none, &self.places, self.divisor);
        let (mut list, mut uses) = (self.list.clone(), Uses::default());
        match walk::value(&self.e, &mut list, &mut uses, &mut lanes) {
            Some(_) => Ok(uses),
            None => Err(Again::of(&lanes)),
        }
    }

    /// Compares an answer; `None` where it is not of the kind this is for.
    pub fn compare(&self, answer: &Expr) -> Option<Finding> {
        let mut list = self.list.clone();
        let mut uses = Uses::default();
        let text = write_plain(answer);
        let quick = match self.roots {
            false => self.at_points::<PLAIN, FEW, 0>(&text, |lanes| {
                walk::value(answer, &mut list, &mut uses, lanes)
            }),
            true => self.at_points::<ROOTS, MANY, REAL>(&text, |lanes| {
                walk::value(answer, &mut list, &mut uses, lanes)
            }),
        }?;
        uses.fit(self.uses)
            .then(|| quick.finding(self.assumed.clone()))
    }

    /// Compares an answer that is read in one pass with a table of the names given when this was made.
    pub fn judge(&self, answer: &str, names: &Names, seen: &mut Seen) -> Option<Quick> {
        let quick = match self.roots {
            false => self.at_points::<PLAIN, FEW, 0>(answer, |lanes| {
                stream(answer, Table::Known(names), lanes, seen)
            }),
            true => self.at_points::<ROOTS, MANY, REAL>(answer, |lanes| {
                stream(answer, Table::Known(names), lanes, seen)
            }),
        }?;
        Uses::from(&*seen).fit(self.uses).then_some(quick)
    }

    /// Compares both at points drawn for the pair.
    fn at_points<const C: u64, const L: usize, const R: usize>(
        &self,
        answer: &str,
        read: impl FnOnce(&mut Lanes<C, L, R>) -> Option<Slot>,
    ) -> Option<Quick> {
        let none = Points::EMPTY;
        let mut lanes = Lanes::<C, L, R>::new(&none, &self.places, self.divisor);
        lanes.rounds = drawn::rounds([&self.text, answer], &self.declared);
        let (mut list, mut uses) = (self.list.clone(), Uses::default());
        let expected = walk::value(&self.e, &mut list, &mut uses, &mut lanes)?;
        let mine = std::mem::take(&mut lanes.state.used);
        let answer = read(&mut lanes)?;
        let theirs = lanes.state.used;
        let compared = lanes.compare((lanes.at(expected), mine), (lanes.at(answer), theirs))?;
        Some(Quick::of(compared, C == ROOTS))
    }

    /// Whether an answer that is equal at points is proved to be equal to the formula these values are of.
    pub fn proves(&self, e: &Expr, answer: &str, names: &Names, seen: &mut Seen) -> bool {
        let divisor = self.divisor;
        let expected = |exact: &mut Exact| {
            let (mut list, mut uses) = (self.list.clone(), Uses::default());
            exact.read(|exact| walk::value(e, &mut list, &mut uses, exact))
        };
        let fresh = || {
            let mut exact = Exact::new(&self.places, divisor, Vec::new());
            let mine = expected(&mut exact)?;
            Some((exact.generators, mine))
        };
        let Some((generators, mine)) = self.exact.get_or_init(fresh) else {
            return false;
        };
        let mut given = |exact: &mut Exact| {
            exact.read(|exact| stream(answer, Table::Known(names), exact, seen))
        };
        let mut exact = Exact::new(&self.places, divisor, generators.clone());
        let Some(theirs) = given(&mut exact) else {
            return false;
        };
        let proved = exact.proves(mine, &theirs) || {
            // Roots that come first are those by which later ones are known.
            let mut exact = Exact::new(&self.places, divisor, Vec::new());
            let turned = self
                .roots
                .then(|| given(&mut exact).zip(expected(&mut exact)))
                .flatten();
            turned.is_some_and(|(theirs, mine)| exact.proves(&mine, &theirs))
        };
        // Domains of further names would be assumed too.
        let known = self.uses.turned | self.uses.bare;
        seen.names & !known == 0 && proved
    }

    /// The names in play.
    pub fn list(&self) -> &[Symbol] {
        &self.list
    }

    /// The domains that are assumed, in words.
    pub fn assumed(&self) -> &[String] {
        &self.assumed
    }
}

/// Where the question says that a symbol lives; `None` where it says nothing.
fn place(name: &Symbol, domains: &Domains) -> Option<Place> {
    let unit = domains.unit_vectors.iter().find(|pair| pair.contains(name));
    if let Some(pair) = unit {
        return Some(Place {
            sign: Sign::Unknown,
            range: [-1.0, 1.0],
            unit: Some((pair[0].clone(), pair[1] == *name)),
        });
    }
    let domain = domains.symbols.get(name)?;
    let [low, high] = [&domain.low, &domain.high].map(|l| l.as_ref().map(|l| l.approximate()));
    let sign = match low {
        Some(low) if low > 0.0 => Sign::Positive,
        Some(low) if low == 0.0 && domain.low.as_ref().is_some_and(|l| l.open) => Sign::Positive,
        Some(0.0) => Sign::NotNegative,
        _ => Sign::Unknown,
    };
    let range = match (low, high) {
        (Some(low), Some(high)) => [low, high],
        (Some(low), None) => [low + 0.5, low + 2.5],
        (None, Some(high)) => [high - 2.5, high - 0.5],
        (None, None) => [-2.0, 2.5],
    };
    Some(Place {
        sign,
        range,
        unit: None,
    })
}

/// Two formulas compared with nothing declared and nothing kept.
pub(crate) struct Pair {
    /// What was found.
    pub quick: Quick,
    /// The names, collected from the expected formula.
    pub names: Names,
    /// What was seen of the expected formula and of the answer.
    pub seen: [Seen; 2],
    divisor: i32,
}

impl Pair {
    /// Whether formulas that are equal at points are proved to be so.
    pub fn proves(&self, expected: &str, answer: &str) -> bool {
        let proved = |first, second| {
            let mut exact = Exact::new(&[], self.divisor, Vec::new());
            let mut read = |text| {
                let names = Table::Known(&self.names);
                exact.read(|exact| stream(text, names, exact, &mut Seen::default()))
            };
            match (read(first), read(second)) {
                (Some(a), Some(b)) => exact.proves(&a, &b),
                _ => false,
            }
        };
        // Roots that come first are those by which later ones are known.
        proved(expected, answer) || self.quick.roots && proved(answer, expected)
    }
}

/// Compares two texts, the first read on its own and the second with its names.
pub(crate) fn pair(expected: &str, answer: &str) -> Option<Pair> {
    // A first look at the letters spares reading up to the first root in vain.
    let (mut divisor, mut roots) = (1, expected.contains("sqrt"));
    loop {
        let read = match roots {
            false => pair_in::<PLAIN, FEW, 0>(expected, answer, divisor),
            true => pair_in::<ROOTS, MANY, REAL>(expected, answer, divisor),
        };
        match read {
            Ok(pair) => return Some(pair),
            Err(Again::Divide(finer)) => divisor = finer,
            Err(Again::Roots) => roots = true,
            Err(Again::Never) => return None,
        }
    }
}

fn pair_in<const C: u64, const L: usize, const R: usize>(
    expected: &str,
    answer: &str,
    divisor: i32,
) -> Result<Pair, Again> {
    let none = Points::EMPTY;
    let mut lanes = Lanes::<C, L, R>::new(&none, &[], divisor);
    lanes.rounds = drawn::rounds([expected, answer], &[]);
    let mut names = Names::collecting();
    let mut seen = [Seen::default(), Seen::default()];
    let table = Table::Collect(&mut names);
    let Some(left) = stream(expected, table, &mut lanes, &mut seen[0]) else {
        return Err(Again::of(&lanes));
    };
    names.close();
    let mine = std::mem::take(&mut lanes.state.used);
    let Some(right) = stream(answer, Table::Known(&names), &mut lanes, &mut seen[1]) else {
        return Err(Again::of(&lanes));
    };
    let compared = lanes.compare((lanes.at(left), mine), (lanes.at(right), lanes.state.used));
    let fit = Uses::from(&seen[0]).fit(Uses::from(&seen[1]));
    match compared {
        Some(compared) if fit => Ok(Pair {
            quick: Quick::of(compared, C == ROOTS),
            names,
            seen,
            divisor,
        }),
        _ => Err(Again::Never),
    }
}
