//! Slips of the pen: one change to a formula, after which it gives what was printed.
//!
//! Knows no formula of its own; it changes the one it is given, a place at a time, and asks its caller whether the result fits.

use num_traits::{Signed, Zero};

use crate::expr::{Expr, Function, Node, Rational, Symbol, ratio};

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
    match e.node() {
        Node::Number(value) => of_number(value),
        Node::Symbol(name) => {
            let kin = names.iter().filter(|n| *n != name && kin(n, name));
            of_name(
                e,
                &kin.map(|n| Expr::from(n.clone())).collect::<Vec<_>>(),
                say,
            )
        }
        Node::Sum(terms) => {
            let mut out = of_sum(e, terms, say);
            let kin = |a: &Symbol, b: &Symbol| a < b && kin(a, b) && e.mentions(a) && e.mentions(b);
            let pairs = names.iter().flat_map(|a| names.iter().map(move |b| (a, b)));
            out.extend(pairs.filter(|(a, b)| kin(a, b)).map(|(a, b)| {
                let [x, y] = [a, b].map(|name| Expr::symbol(name));
                let both = [(a.clone(), y.clone()), (b.clone(), x.clone())];
                let [x, y, whole] = [&x, &y, e].map(say);
                let words = format!("{x} and {y} are exchanged in {whole}");
                (e.substitute(&both.into()), words)
            }));
            out
        }
        Node::Product(factors) => {
            [of_product(factors, say), without_brackets(factors, say)].concat()
        }
        Node::Power(base, k) => of_power(e, base, k, say),
        Node::Call(Function::Sin, x) => vec![(x.cos(), format!("cos stands for {}", say(e)))],
        Node::Call(Function::Cos, x) => vec![(x.sin(), format!("sin stands for {}", say(e)))],
        Node::Call(..) => Vec::new(),
    }
}

fn of_number(value: &Rational) -> Vec<(Expr, String)> {
    let times = |k: Rational, words: &str| {
        let words = format!("{} stands {words}", value.abs());
        (Expr::from(value * &k), words)
    };
    let upside_down = || {
        let words = format!("{value} stands upside down");
        (Expr::from(value.recip()), words)
    };
    let mut out = vec![
        times(ratio(2, 1), "doubled"),
        times(ratio(1, 2), "halved"),
        times(ratio(-1, 1), "with the other sign"),
    ];
    out.extend((!value.is_zero()).then(upside_down));
    out.push((Expr::one(), format!("{value} is left out")));
    out
}

/// A name for another of its kind, a multiple of it, or one for the sum with another: the mass of one body for that of both.
fn of_name(e: &Expr, kin: &[Expr], say: &dyn Fn(&Expr) -> String) -> Vec<(Expr, String)> {
    let other = |new: &Expr| (new.clone(), format!("{} stands for {}", say(new), say(e)));
    let multiple = |(k, words): (Expr, &str)| {
        let words = format!("{words} {} stands for {}", say(e), say(e));
        (e * &k, words)
    };
    let multiples = [(Expr::from(2), "twice"), (Expr::ratio(1, 2), "half")];
    let mut out: Vec<(Expr, String)> = kin.iter().map(other).collect();
    out.extend(multiples.into_iter().map(multiple));
    out.extend(kin.iter().map(|k| other(&(e + k))));
    out
}

fn of_sum(e: &Expr, terms: &[Expr], say: &dyn Fn(&Expr) -> String) -> Vec<(Expr, String)> {
    let mut out = Vec::new();
    if let [a, b] = terms
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
        let mut all = terms.to_vec();
        all[i] = -term;
        let turned = format!("{} has the other sign", say(term));
        out.push((Expr::sum(all.clone()), turned));
        all.remove(i);
        out.push((Expr::sum(all), format!("{} is left out", say(term))));
    }
    out
}

fn of_product(factors: &[Expr], say: &dyn Fn(&Expr) -> String) -> Vec<(Expr, String)> {
    let mut out = Vec::new();
    let n = factors.len().min(8);
    for i in 0..n {
        for j in i..n {
            let all = factors.iter().enumerate();
            let rest = || {
                let others = all.clone().filter(|(k, _)| *k != i && *k != j);
                others.map(|(_, f)| f.clone())
            };
            let picked = match i == j {
                true => factors[i].clone(),
                false => &factors[i] * &factors[j],
            };
            if i == j {
                let words = format!("the factor {} is left out", say(&picked));
                out.push((Expr::product(rest()), words));
            }
            let squared = Expr::product(rest().chain([picked.powi(2)]));
            out.push((squared, format!("the factor {} enters twice", say(&picked))));
        }
        let mut all = factors.to_vec();
        all[i] = factors[i].powi(-1);
        let words = format!("the factor {} stands upside down", say(&factors[i]));
        out.push((Expr::product(all), words));
    }
    out
}

/// `p (a + b)/q` without its brackets: p a + b/q, or with b first; and `p/(q (a + b))`: p/(q a) + b, or p/(q a + b).
fn without_brackets(factors: &[Expr], say: &dyn Fn(&Expr) -> String) -> Vec<(Expr, String)> {
    let below = |f: &Expr| match f.node() {
        Node::Power(_, k) => k.as_number().is_some_and(Signed::is_negative),
        _ => false,
    };
    let mut out = Vec::new();
    for (i, factor) in factors.iter().enumerate() {
        let (sum, k) = match factor.node() {
            Node::Power(sum, k) => (sum, k.clone()),
            _ => (factor, Expr::one()),
        };
        let Node::Sum(terms) = sum.node() else {
            continue;
        };
        let others = factors.iter().enumerate().filter(|(j, _)| *j != i);
        let (behind, before): (Vec<Expr>, Vec<Expr>) =
            others.map(|(_, f)| f.clone()).partition(below);
        let [behind, before] = [behind, before].map(Expr::product);
        for head in terms {
            let tail = sum - head;
            let lost = match below(factor) {
                true => vec![
                    &before * &behind * head.power(k.clone()) + &tail,
                    &before * (behind.powi(-1) * head + tail).power(k.clone()),
                ],
                false => vec![
                    &before * &behind * head + tail.power(k.clone()),
                    &before * head + &behind * tail.power(k.clone()),
                ],
            };
            let words = format!("the brackets around {} are lost", say(sum));
            out.extend(lost.into_iter().map(|e| (e, words.clone())));
        }
    }
    out
}

fn of_power(e: &Expr, base: &Expr, k: &Expr, say: &dyn Fn(&Expr) -> String) -> Vec<(Expr, String)> {
    let step = |step: i64| {
        let other = k + &Expr::from(step);
        let [was, of, is] = [k, base, &other].map(say);
        let words = format!("the exponent {was} of {of} becomes {is}");
        (base.power(other), words)
    };
    let squared = base.power(k * &Expr::from(2));
    let words = format!("{} is squared once more", say(e));
    vec![step(-1), step(1), (squared, words)]
}

/// The root of a square, and whether the square is added: e of −e², 1 of 1.
fn square_of(e: &Expr) -> Option<(Expr, bool)> {
    match e.node() {
        Node::Number(value) => {
            let size = value.abs();
            let root = crate::expr::number::sqrt_exact(&size)?;
            Some((Expr::from(root), !value.is_negative()))
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
