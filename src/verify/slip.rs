//! Slips of the pen: one change to a formula, after which it gives what was printed.
//!
//! Knows no formula of its own; it changes the one it is given, a place at a time, and asks its caller whether the result fits.

use crate::expr::{Expr, Function, Node, Symbol, ratio};

/// Words for the slips that lead from a formula to one that `fits`; `kin` says which of the names may be exchanged.
pub fn that_fit(
    e: &Expr,
    names: &[Symbol],
    fits: &dyn Fn(&Expr) -> bool,
    kin: &dyn Fn(&Symbol, &Symbol) -> bool,
    say: &dyn Fn(&Expr) -> String,
) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    sites(e, &|whole| whole, &mut |part, put_back| {
        for (changed, words) in changes(part, names, kin, say) {
            if !found.contains(&words) && fits(&put_back(changed)) {
                found.push(words);
            }
        }
    });
    found
}

/// Takes a part of an expression, and a function that puts another part in its place.
type Visit<'a> = &'a mut dyn FnMut(&Expr, &dyn Fn(Expr) -> Expr);

/// Calls `visit` for every part of an expression with a function that puts a changed part back into the whole.
fn sites(e: &Expr, put_back: &dyn Fn(Expr) -> Expr, visit: Visit<'_>) {
    visit(e, put_back);
    let list = |parts: &[Expr], join: &dyn Fn(Vec<Expr>) -> Expr, visit: Visit<'_>| {
        for i in 0..parts.len() {
            let inner = |new: Expr| {
                let mut all = parts.to_vec();
                all[i] = new;
                put_back(join(all))
            };
            sites(&parts[i], &inner, visit);
        }
    };
    match e.node() {
        Node::Sum(parts) => list(parts, &|all| Expr::sum(all), visit),
        Node::Product(parts) => list(parts, &|all| Expr::product(all), visit),
        Node::Power(base, k) => sites(base, &|new| put_back(new.power(k.clone())), visit),
        Node::Call(f, x) => sites(x, &|new| put_back(Expr::call(*f, new)), visit),
        Node::Number(_) | Node::Symbol(_) => {}
    }
}

/// What one slip can make of a part, with words.
fn changes(
    e: &Expr,
    names: &[Symbol],
    kin: &dyn Fn(&Symbol, &Symbol) -> bool,
    say: &dyn Fn(&Expr) -> String,
) -> Vec<(Expr, String)> {
    let mut out = Vec::new();
    match e.node() {
        Node::Number(value) => {
            for (k, words) in [
                (ratio(2, 1), "doubled"),
                (ratio(1, 2), "halved"),
                (ratio(-1, 1), "with the other sign"),
            ] {
                out.push((Expr::from(value * &k), format!("{value} stands {words}")));
            }
            if !num_traits::Zero::is_zero(value) {
                out.push((
                    Expr::from(value.recip()),
                    format!("{value} stands upside down"),
                ));
            }
            out.push((Expr::one(), format!("{value} is left out")));
        }
        Node::Symbol(name) => {
            for other in names.iter().filter(|n| *n != name && kin(n, name)) {
                out.push((Expr::symbol(other), format!("{other} stands for {name}")));
            }
            for (k, words) in [(Expr::from(2), "twice"), (Expr::ratio(1, 2), "half")] {
                out.push((e * &k, format!("{words} {} stands for {}", say(e), say(e))));
            }
        }
        Node::Sum(terms) => {
            if let [a, b] = terms.as_slice()
                && let (Some((x, plus)), Some((y, also))) = (square_of(a), square_of(b))
            {
                // 1 − e² and (1 − e)².
                let join = |minus: bool| if minus { &x - &y } else { &x + &y };
                let changed = join(plus != also).powi(2);
                let changed = if plus { changed } else { -changed };
                let words = format!("{} stands for {}", say(&changed), say(e));
                out.push((changed, words));
            }
            for (i, term) in terms.iter().enumerate() {
                let mut all = terms.clone();
                all[i] = -term;
                out.push((
                    Expr::sum(all.clone()),
                    format!("{} has the other sign", say(term)),
                ));
                all.remove(i);
                out.push((Expr::sum(all), format!("{} is left out", say(term))));
            }
        }
        Node::Product(factors) => {
            let n = factors.len().min(8);
            for i in 0..n {
                for j in i..n {
                    let rest = || {
                        factors
                            .iter()
                            .enumerate()
                            .filter(move |(k, _)| *k != i && *k != j)
                            .map(|(_, f)| f.clone())
                    };
                    let picked = if i == j {
                        factors[i].clone()
                    } else {
                        &factors[i] * &factors[j]
                    };
                    if i == j {
                        out.push((
                            Expr::product(rest()),
                            format!("the factor {} is left out", say(&picked)),
                        ));
                    }
                    let squared = Expr::product(rest().chain([picked.powi(2)]));
                    out.push((squared, format!("the factor {} enters twice", say(&picked))));
                }
                let inverse = factors
                    .iter()
                    .enumerate()
                    .map(|(k, f)| if k == i { f.powi(-1) } else { f.clone() });
                out.push((
                    Expr::product(inverse),
                    format!("the factor {} stands upside down", say(&factors[i])),
                ));
            }
        }
        Node::Power(base, k) => {
            for step in [-1, 1] {
                let other = k + &Expr::from(step);
                out.push((
                    base.power(other.clone()),
                    format!(
                        "the exponent {} of {} becomes {}",
                        say(k),
                        say(base),
                        say(&other)
                    ),
                ));
            }
            out.push((
                base.power(k * &Expr::from(2)),
                format!("{} is squared once more", say(e)),
            ));
        }
        Node::Call(Function::Sin, x) => out.push((x.cos(), format!("cos stands for {}", say(e)))),
        Node::Call(Function::Cos, x) => out.push((x.sin(), format!("sin stands for {}", say(e)))),
        Node::Call(..) => {}
    }
    out
}

/// The root of a square, and whether the square is added: e of −e², 1 of 1.
fn square_of(e: &Expr) -> Option<(Expr, bool)> {
    match e.node() {
        Node::Number(value) => {
            let size = num_traits::Signed::abs(value);
            let root = crate::expr::number::sqrt_exact(&size)?;
            Some((Expr::from(root), !num_traits::Signed::is_negative(value)))
        }
        Node::Power(base, k) => {
            let half = k.as_number()? * ratio(1, 2);
            half.is_integer()
                .then(|| (base.power(Expr::from(half)), true))
        }
        Node::Product(factors) => match factors.as_slice() {
            [minus, square] if *minus == Expr::from(-1) => {
                let (root, plus) = square_of(square)?;
                Some((root, !plus))
            }
            _ => None,
        },
        _ => None,
    }
}
