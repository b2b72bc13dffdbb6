//! Equality at random points modulo a prime near 2⁶¹: fast, and right up to a probability that is stated.
//!
//! For quotients of polynomials in symbols, in sines and cosines of rational multiples of angles, and in square roots.
//! In: texts or expressions and the domains of their symbols; out: equal or not, with the bound. A difference is certain: an
//! identity over ℚ holds modulo every prime that divides no denominator. An equality is wrong with at most the probability
//! stated (Schwartz and Zippel: degree over p for each point), where coefficients are shown to be smaller than the prime.
//! Roots follow the rules told in [`lanes`]. Whatever fits none of this is declined, and [`crate::equality`] decides.

mod build;
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
use build::Slot;
use exact::{Exact, Generator, Read};
use lanes::{Compared, Lanes, State};
use prime::{PLAIN, ROOTS};
use value::{Place, Points, Sign, Value};

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

/// Values of an expected formula at fixed points, kept for many answers.
#[derive(Clone, Debug)]
pub(crate) struct Residues {
    /// The names in play: their place in the list is their index.
    list: Vec<Symbol>,
    places: Vec<Option<Place>>,
    uses: Uses,
    side: Side,
    /// Domains assumed, in words.
    assumed: Vec<String>,
    /// The formula as a quotient of polynomials with its generators, where a proof asked for it and it is one.
    exact: OnceLock<Option<(Vec<Generator>, Read)>>,
}

#[derive(Clone, Debug)]
enum Side {
    Plain(Box<Kept<PLAIN, FEW, 0>>),
    Roots(Box<Kept<ROOTS, FEW, REAL>>),
    /// Not found yet.
    None,
}

/// The value of an expected formula, and what it takes to find those of answers at the same points.
#[derive(Clone, Debug)]
struct Kept<const C: u64, const L: usize, const R: usize> {
    points: Points<L, R>,
    divisor: i32,
    value: Value<L, R>,
    state: State<L, R>,
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
    /// Values of an expected formula; `names` are the names in play. `None` where it is not of the kind this is for.
    pub fn of(e: &Expr, domains: &Domains, mut names: Vec<Symbol>) -> Option<Residues> {
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
            places: names.iter().map(|name| place(name, domains)).collect(),
            list: names,
            uses: Uses::default(),
            side: Side::None,
            assumed: domains.completed(&roles).1,
            exact: OnceLock::new(),
        };
        let (mut divisor, mut roots) = (1, false);
        loop {
            let kept = match roots {
                false => residues.keep(e, divisor, None).map(Side::Plain),
                true => residues.scouted(e, divisor).map(Side::Roots),
            };
            match kept {
                Ok(side) => {
                    residues.side = side;
                    return residues.uses.fit(Uses::default()).then_some(residues);
                }
                Err(Again::Divide(finer)) => divisor = finer,
                Err(Again::Roots) => roots = true,
                Err(Again::Never) => return None,
            }
        }
    }

    /// Values at a few points at which all roots exist, found among many.
    fn scouted(&mut self, e: &Expr, divisor: i32) -> Result<Box<Kept<ROOTS, FEW, REAL>>, Again> {
        for first in (0..4).map(|k| k * MANY as u64) {
            let rounds = std::array::from_fn(|lane| first + lane as u64);
            let many = self.keep::<ROOTS, MANY, REAL>(e, divisor, Some((rounds, 0)))?;
            let alive = |lane: &usize| many.state.alive >> lane & 1 == 1;
            let mut lanes = (0..MANY).filter(alive).map(|lane| rounds[lane]);
            if let (Some(one), Some(other)) = (lanes.next(), lanes.next()) {
                return self.keep(e, divisor, Some(([one, other], many.state.count())));
            }
        }
        // What real points tell remains.
        self.keep(e, divisor, None)
    }

    fn keep<const C: u64, const L: usize, const R: usize>(
        &mut self,
        e: &Expr,
        divisor: i32,
        at: Option<([u64; L], usize)>,
    ) -> Result<Box<Kept<C, L, R>>, Again> {
        let none = Points::EMPTY;
        let mut lanes = Lanes::<C, L, R>::new(&none, &self.places, divisor);
        if let Some((rounds, trusted)) = at {
            (lanes.rounds, lanes.trusted) = (rounds, trusted);
        }
        let (mut list, mut uses) = (self.list.clone(), Uses::default());
        let Some(value) = walk::value(e, &mut list, &mut uses, &mut lanes) else {
            return Err(Again::of(&lanes));
        };
        for (index, name) in self.list.iter().enumerate() {
            lanes.prepare(index, name.as_bytes());
        }
        let value = *lanes.at(value);
        let (points, state) = (
            std::mem::replace(&mut lanes.points, Points::EMPTY),
            lanes.state,
        );
        self.uses = uses;
        Ok(Box::new(Kept {
            points,
            divisor,
            value,
            state,
        }))
    }

    /// Compares an answer; `None` where it is not of the kind this is for.
    pub fn compare(&self, answer: &Expr) -> Option<Finding> {
        let mut list = self.list.clone();
        let mut uses = Uses::default();
        let quick = match &self.side {
            Side::Plain(kept) => kept.judge(self, |lanes| {
                walk::value(answer, &mut list, &mut uses, lanes)
            }),
            Side::Roots(kept) => kept.judge(self, |lanes| {
                walk::value(answer, &mut list, &mut uses, lanes)
            }),
            Side::None => None,
        }?;
        uses.fit(self.uses)
            .then(|| quick.finding(self.assumed.clone()))
    }

    /// Compares an answer that is read in one pass with a table of the names given when this was made.
    pub fn judge(&self, answer: &str, names: &Names, seen: &mut Seen) -> Option<Quick> {
        let quick = match &self.side {
            Side::Plain(kept) => kept.judge(self, |lanes| {
                stream(answer, Table::Known(names), lanes, seen)
            }),
            Side::Roots(kept) => kept.judge(self, |lanes| {
                stream(answer, Table::Known(names), lanes, seen)
            }),
            Side::None => None,
        }?;
        Uses::from(&*seen).fit(self.uses).then_some(quick)
    }

    /// Whether an answer that is equal at points is proved to be equal to the formula these values are of.
    pub fn proves(&self, e: &Expr, answer: &str, names: &Names, seen: &mut Seen) -> bool {
        let divisor = match &self.side {
            Side::Plain(kept) => kept.divisor,
            Side::Roots(kept) => kept.divisor,
            Side::None => return false,
        };
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
            let rooted = matches!(self.side, Side::Roots(_));
            let turned = rooted
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

impl<const C: u64, const L: usize, const R: usize> Kept<C, L, R> {
    #[inline]
    fn judge(
        &self,
        with: &Residues,
        read: impl FnOnce(&mut Lanes<C, L, R>) -> Option<Slot>,
    ) -> Option<Quick> {
        let mut lanes = Lanes::new(&self.points, &with.places, self.divisor);
        lanes.state = self.state;
        lanes.state.used = 0;
        let answer = read(&mut lanes)?;
        let (mine, theirs) = (self.state.used, lanes.state.used);
        let compared = lanes.compare((&self.value, mine), (lanes.at(answer), theirs))?;
        Some(Quick::of(compared, C == ROOTS))
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
