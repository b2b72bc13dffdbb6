//! Products as a person writes them: the order of their factors, where a minus sign goes, and roots under one sign.

use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::Sign;
use super::element::Element;
use super::factor::{Parts, conjugates, square_part};
use super::field::{Field, Kind};
use super::poly::Poly;
use crate::expr::{Expr, Int, Node, Rational, ratio};

/// Longest sum whose sign is asked for to write it.
pub(super) const MOST_SIGNED: usize = 3;

/// A factor of a written product.
struct Factor {
    rank: Rank,
    base: Expr,
    power: Rational,
    /// For a root, its generator.
    root: Option<usize>,
}

impl Factor {
    fn written(self) -> Expr {
        match self.base.node() {
            // (eⁿ)² is e²ⁿ.
            Node::Power(base, exponent)
                if self.power.is_integer() && exponent.as_number().is_none() =>
            {
                base.power(Expr::from(self.power) * exponent)
            }
            _ => self.base.power(Expr::from(self.power)),
        }
    }
}

/// Order of factors.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Rank {
    Number,
    /// π and coefficients of friction, as in 2π r and μ m g.
    Coefficient,
    /// Masses stand before other symbols, as in m l².
    Mass,
    /// A coefficient of restitution, as in m e² g h.
    Restitution,
    /// The acceleration of free fall, as in m g h and 2 g H.
    Gravity,
    Symbol,
    Other,
    Sum,
}

impl Rank {
    fn of(base: &Expr) -> Rank {
        match base.node() {
            Node::Number(_) => Rank::Number,
            Node::Symbol(name) => match name.split('_').next().unwrap_or_default() {
                "pi" | "mu" => Rank::Coefficient,
                "e" => Rank::Restitution,
                "g" => Rank::Gravity,
                letter if letter.starts_with(['m', 'M']) => Rank::Mass,
                _ => Rank::Symbol,
            },
            _ => Rank::Other,
        }
    }
}

impl Field {
    /// A quotient from the factors above and below its line, in the order in which a person writes them.
    pub(super) fn assemble(&self, above: &Parts, below: &Parts) -> Expr {
        let (mut above, mut below) = (above.clone(), below.clone());
        let sunk = self.sunk(&mut above, &mut below);
        above.join_conjugates();
        below.join_conjugates();
        let mut number = Rational::new(above.content.clone(), below.content.clone());
        let mut factors: Vec<Factor> = Vec::new();
        // Sums of mixed signs may be turned round to carry a minus sign; 1 − e² reads better as it is, and what is known to
        // be positive shows it.
        let mut turnable: Vec<(bool, &Poly, Expr)> = Vec::new();
        let mut shown: Vec<(&Poly, bool, Expr)> = Vec::new();
        for (parts, sign) in [(&above, 1i64), (&below, -1)] {
            for (f, k) in &parts.factors {
                let mut power = ratio(i64::from(*k) * sign, 1);
                let (expr, rank, root) = if f.len() == 1 {
                    let v = f.variables()[0];
                    let known = sunk.iter().find(|(root, _)| *root == v);
                    let (expr, own) = match known {
                        Some((_, under)) => (under.clone(), ratio(1, 2)),
                        None => self.generator(v),
                    };
                    let root = (!own.is_one()).then_some(v);
                    power *= own;
                    let rank = Rank::of(&expr);
                    (expr, rank, root)
                } else {
                    let (expr, flipped, mixed) = self.sum(f);
                    if flipped && k % 2 == 1 {
                        number = -number;
                    }
                    let number = matches!(expr.node(), Node::Sum(terms) if terms.iter().any(|t| t.as_number().is_some()));
                    // Below the line none is turned to have more minus than plus.
                    let is_mostly_plus = matches!(expr.node(), Node::Sum(terms)
                        if 2 * terms.iter().filter(|t| t.is_negative()).count() < terms.len());
                    let keeps = sign < 0 && is_mostly_plus;
                    if mixed && k % 2 == 1 && sign > 0 {
                        shown.push((f, flipped, expr.clone()));
                    }
                    if mixed && !keeps && k % 2 == 1 {
                        turnable.push((number, f, expr.clone()));
                    }
                    (expr, Rank::Sum, None)
                };
                match factors.iter_mut().find(|other| other.base == expr) {
                    Some(other) => {
                        other.power += power;
                        other.root = other.root.max(root);
                    }
                    None => factors.push(Factor {
                        rank,
                        base: expr,
                        power,
                        root,
                    }),
                }
            }
        }
        let shown = shown
            .into_iter()
            .map(|(f, flipped, sum)| (self.is_below_zero(f, flipped), sum));
        turn_both(&shown.collect::<Vec<_>>(), &mut factors);
        turnable.sort_by_key(|(number, ..)| *number);
        // Of a sum alone nothing is shown by a minus in front.
        let alone = factors.len() == 1 && number == -Rational::one();
        let known = |f: &Poly| !alone && f.len() <= MOST_SIGNED && self.sign_poly(f).is_some();
        let turnable = turnable.into_iter().find(|(_, f, _)| !known(f));
        if let (true, Some((.., sum))) = (number.is_negative(), turnable) {
            let odd =
                |f: &&mut Factor| f.base == sum && f.power.is_integer() && f.power.numer().is_odd();
            if let Some(place) = factors.iter_mut().find(odd) {
                place.base = turned(&sum);
                number = -number;
            }
        }
        factors.retain(|f| !f.power.is_zero());
        factors.sort_by(|a, b| (a.rank, &a.base).cmp(&(b.rank, &b.base)));
        self.with_one_root(number, factors)
    }

    /// Whether a short sum, shown with its sign turned or not, is below zero, where that is known.
    fn is_below_zero(&self, f: &Poly, flipped: bool) -> Option<bool> {
        match (f.len() <= MOST_SIGNED).then(|| self.sign_poly(f))?? {
            Sign::Positive => Some(flipped),
            Sign::Negative => Some(!flipped),
            _ => None,
        }
    }

    /// The radicands of roots above the line that have what stands below it: √(a b)/b is √(a/b) where b > 0. A root of no more
    /// than that goes below: √b/b is 1/√b.
    fn sunk(&self, above: &mut Parts, below: &mut Parts) -> Vec<(usize, Expr)> {
        let mut out = Vec::new();
        let once = above
            .factors
            .iter()
            .filter(|(f, k)| *k == 1 && f.len() == 1);
        let roots = once.filter_map(|(f, _)| {
            let root = f.variables()[0];
            match (&self.gens[root].kind, &self.gens[root].relation) {
                (Kind::Root, Some((2, value))) => Some((root, value)),
                _ => None,
            }
        });
        let roots: Vec<(usize, &Poly)> = roots.collect();
        if !roots.is_empty() {
            *below = self.split_circles(below);
        }
        for &(root, value) in &roots {
            let whole = self.split_circles(&self.taken_apart(value));
            // Under one root sign with another that has a part of it, like factors would stand apart.
            let has_part = |(other, value): &(usize, &Poly)| {
                let theirs = self.split_circles(&self.taken_apart(value)).factors;
                *other != root
                    && theirs
                        .iter()
                        .any(|(f, _)| whole.factors.iter().any(|(g, _)| f == g))
            };
            if roots.len() > 1 && roots.iter().any(has_part) {
                continue;
            }
            let shared = |is_known: &dyn Fn(&Poly) -> bool| {
                let (mut inside, mut under) = (whole.clone(), Parts::one());
                for (f, _) in below.factors.iter().filter(|(f, k)| *k == 1 && is_known(f)) {
                    let is_it = |(g, k): &(Poly, u32)| *k == 1 && (g == f || *g == f.neg());
                    if let Some(at) = inside.factors.iter().position(is_it) {
                        if inside.factors.remove(at).0 != *f {
                            inside.content = -inside.content;
                        }
                        under.note(f.clone(), 1);
                    }
                }
                (inside, under)
            };
            let (rest, all) = shared(&|_| true);
            let is_whole = rest.factors.is_empty();
            let (inside, under) = match is_whole {
                true => (rest, all),
                false => shared(&|f| self.sign_poly(f) == Some(Sign::Positive)),
            };
            if under.factors.is_empty() {
                continue;
            }
            below
                .factors
                .retain(|factor| !under.factors.contains(factor));
            if is_whole {
                below.note(Poly::var(root), 1);
                above.content *= inside.content;
                above.factors.retain(|(f, _)| *f != Poly::var(root));
            } else {
                out.push((root, self.assemble(&inside, &under)));
            }
        }
        out
    }

    /// The product of a number and factors in their order: √a·√b/√c is written √(ab/c) where each of them is known to be real; if
    /// all but one are, so is that one.
    fn with_one_root(&self, number: Rational, factors: Vec<Factor>) -> Expr {
        let half = |f: &Factor| f.root.is_some() && *f.power.denom() == Int::from(2);
        let is_real = |v: usize| {
            let under = self.gens[v].relation.as_ref().map(|(_, p)| p);
            let sign = under.and_then(|p| self.sign_poly(p));
            sign.is_some_and(|s| s.is_not_negative())
        };
        let unsure = |f: &Factor| half(f) && !f.root.is_some_and(is_real);
        // One alone is as real as the whole.
        let several = factors.iter().filter(|f| half(f)).count() > 1;
        let apart = several && factors.iter().filter(|f| unsure(f)).count() > 1;
        let (rooted, mut rest): (Vec<Factor>, Vec<Factor>) = factors
            .into_iter()
            .partition(|f| half(f) && !(apart && unsure(f)));
        let rooted = self.with_joined_conjugates(rooted);
        // 1/√2 is written √2/2, and numbers stand in front.
        let numeric = rooted.iter().all(|f| f.rank == Rank::Number);
        let all_below = !numeric && rooted.iter().all(|f| f.power.is_negative());
        let mut inside = Vec::new();
        for f in rooted {
            let below = f.power.is_negative() && !numeric;
            let half = ratio(if below { -1 } else { 1 }, 2);
            if f.power != half {
                rest.push(Factor {
                    rank: f.rank,
                    base: f.base.clone(),
                    power: &f.power - &half,
                    root: None,
                });
            }
            inside.push(if below && !all_below {
                f.base.powi(-1)
            } else {
                f.base
            });
        }
        let number = match numeric || all_below {
            true => number,
            false => with_number_inside(number, &mut inside, &rest),
        };
        let root = (!inside.is_empty()).then(|| {
            // Nothing above: 1/√(ab).
            Expr::product(inside).power(Expr::ratio(if all_below { -1 } else { 1 }, 2))
        });
        rest.sort_by(|a, b| (a.rank, &a.base).cmp(&(b.rank, &b.base)));
        let mut out = vec![Expr::from(number)];
        if numeric {
            out.extend(root);
            out.extend(rest.into_iter().map(Factor::written));
        } else {
            out.extend(rest.into_iter().map(Factor::written));
            out.extend(root);
        }
        Expr::product(out)
    }

    /// √(x − y) √(x + y) is √(x² − y²).
    fn with_joined_conjugates(&self, mut rooted: Vec<Factor>) -> Vec<Factor> {
        let under = |f: &Factor| Some(&self.gens[f.root?].relation.as_ref()?.1);
        let joined = |f: &Factor, g: &Factor| match f.power == g.power {
            true => self.joined_conjugates(under(f)?, under(g)?),
            false => None,
        };
        let mut i = 0;
        while i < rooted.len() {
            let partner =
                (i + 1..rooted.len()).find_map(|j| Some((j, joined(&rooted[i], &rooted[j])?)));
            if let Some((j, product)) = partner {
                rooted.remove(j);
                rooted[i].base = product;
                rooted[i].root = None;
            }
            i += 1;
        }
        rooted
    }

    /// The product of x − y and x + y, or of the roots of such.
    fn joined_conjugates(&self, f: &Poly, g: &Poly) -> Option<Expr> {
        if let Some(product) = conjugates(f, g) {
            return Some(self.kept(&Element::from_poly(product)));
        }
        let ((n, f), (m, g)) = (self.as_root(f)?, self.as_root(g)?);
        let inside = (n == m).then(|| self.joined_conjugates(&f, &g))??;
        Some(inside.power(Expr::ratio(1, i64::from(n))))
    }
}

/// Takes of a number in front what stands shorter under the root behind it, and gives what stays in front: `√70 x/7` is
/// `√(10 x/7)` and `2 √(6 x)/3` is `√(8 x/3)`. A number without a line below it stays: `2 √(6 x)`.
fn with_number_inside(number: Rational, inside: &mut Vec<Expr>, rest: &[Factor]) -> Rational {
    let under: Rational = inside.iter().filter_map(Expr::as_number).product();
    if number.denom().gcd(under.numer()).is_one() || !under.is_positive() {
        return number;
    }
    // √(2 g h), the speed of a fall, stays, unless no number is left in front.
    let two = Rational::from(Int::from(2));
    if under == two && *number.denom() != Int::from(2) {
        return number;
    }
    let square = &(&number * &number) * &under;
    let [(above, above_rest), (below, below_rest)] =
        [square.numer(), square.denom()].map(square_part);
    let splits = [
        (number.abs(), under),
        (
            Rational::new(above, below),
            Rational::new(above_rest, below_rest),
        ),
        (Rational::one(), square),
    ];
    let has_line = |x: &Rational| !x.denom().is_one();
    let line_outside = rest.iter().any(|f| f.power.is_negative());
    let line_inside = inside.iter().any(is_below);
    // A line in a line costs as much as two digits more.
    let cost = |(outside, under): &(Rational, Rational)| {
        let all = [
            outside.numer(),
            outside.denom(),
            under.numer(),
            under.denom(),
        ];
        let seen = all.map(|n| if n.is_one() { 0 } else { n.to_string().len() });
        let nested = (line_outside || has_line(outside)) && (line_inside || has_line(under));
        (
            seen.iter().sum::<usize>() + if nested { 2 } else { 0 },
            all.into_iter().fold(Int::one(), |all, n| all * n),
        )
    };
    let [first, others @ ..] = splits;
    let sign = Rational::from(Int::from(if number.is_negative() { -1 } else { 1 }));
    let best = others.into_iter().fold(
        first,
        |best, one| if cost(&one) < cost(&best) { one } else { best },
    );
    inside.retain(|e| e.as_number().is_none());
    if !best.1.is_one() {
        inside.insert(0, Expr::from(best.1));
    }
    sign * best.0
}

/// Whether a factor is a power below the line.
fn is_below(e: &Expr) -> bool {
    matches!(e.node(), Node::Power(_, k) if k.is_negative())
}

/// Turns two sums round of which one is known to be below zero and the other not to be above: the product is what it was.
fn turn_both(shown: &[(Option<bool>, Expr)], factors: &mut [Factor]) {
    let [(first, one), (second, other)] = shown else {
        return;
    };
    let known = [first, second];
    if !known.contains(&&Some(true)) || known.contains(&&Some(false)) {
        return;
    }
    let place = |sum: &Expr| {
        let is_odd = |f: &Factor| f.power.is_integer() && f.power.numer().is_odd();
        factors.iter().position(|f| f.base == *sum && is_odd(f))
    };
    if let (Some(i), Some(j)) = (place(one), place(other)) {
        for place in [i, j] {
            factors[place].base = turned(&factors[place].base);
        }
    }
}

/// The negative of a sum, its positive terms in front again.
fn turned(sum: &Expr) -> Expr {
    let Node::Sum(terms) = sum.node() else {
        return -sum;
    };
    let mut terms: Vec<Expr> = terms.iter().map(turned_inside).collect();
    terms.sort_by_key(Expr::is_negative);
    Expr::sum(terms)
}

/// A term with its sign turned, within its bracket where something is taken away there: `m (u − v)` as `m (v − u)`.
pub(super) fn turned_inside(term: &Expr) -> Expr {
    let takes = |f: &Expr| f.terms().len() > 1 && f.terms().iter().any(Expr::is_negative);
    match term.factors().iter().find(|f| takes(f)) {
        Some(bracket) if !term.is_negative() => {
            let own = |f: &Expr| if f == bracket { turned(f) } else { f.clone() };
            Expr::product(term.factors().iter().map(own))
        }
        _ => -term,
    }
}
