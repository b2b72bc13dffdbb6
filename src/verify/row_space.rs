//! Whether the rows of a printed matrix are laws of a scene, or merely true of its one solution.
//!
//! The equations of `numeric` are taken at exact points of the domain. A printed row that repeats a contact law or a given
//! is a law; any other has to be a combination of the equations without those, so that it does not lean on the very
//! values that other rows state.

use num_traits::Zero;

use crate::expr::angle::arcs_exchanged;
use crate::expr::rows::reduce;
use crate::expr::{Expr, Int, Point, Rational};
use crate::numeric::{self, Answer, Given, Law, Solution, System};
use crate::scene::{Ask, Scene};

/// What is found of a row.
#[derive(Clone, PartialEq, Debug)]
pub enum Row {
    /// It is a law.
    Law,
    /// It is a law, and says nothing that the rows above do not say: the matrix is singular by it.
    Repeats,
    /// It is empty.
    Empty,
    /// The solution fulfils it, and it is no law; with the change of one place that would make it one.
    Masked(Option<Mend>),
    /// The solution does not fulfil it; with the change of one place that would make it a law.
    Wrong(Option<Mend>),
}

/// A change of one place in a row.
#[derive(Clone, PartialEq, Debug)]
pub struct Mend {
    /// The column; none for the right side.
    pub column: Option<usize>,
    /// What should stand there.
    pub value: Expr,
}

/// Entries of a printed row, and its right side.
type PrintedRow = (Vec<Expr>, Expr);

/// Exact points at which rows are tried.
const POINTS: u64 = 2;

struct Place {
    point: Point<Rational>,
    laws: System<Rational>,
    /// Each column of the print as a row over the unknowns, with its constant part.
    columns: Vec<(Vec<Rational>, Rational)>,
}

/// Judges printed rows: entries and right side, over unknowns that are names of answers.
pub fn judge(
    scene: &Scene,
    unknowns: &[String],
    rows: &[(Vec<Expr>, Expr)],
) -> Result<Vec<Row>, String> {
    let mut needed = numeric::needed(scene);
    for (row, right) in rows {
        row.iter().chain([right]).for_each(|e| needed.add(e));
    }
    let mut places = Vec::new();
    for seed in 1..=POINTS {
        let point = numeric::random_point(&needed, &scene.domains, seed);
        let given = numeric::given(scene, &point).map_err(|e| e.to_string())?;
        let laws = numeric::assemble(&given);
        let columns = unknowns.iter();
        let columns = columns.map(|name| column(scene, name, &point, &given, &laws));
        let columns = columns.collect::<Result<Vec<_>, String>>()?;
        places.push(Place {
            point,
            laws,
            columns,
        });
    }
    let stated: Vec<Vec<usize>> = places.iter().map(|p| stated(p, rows)).collect();
    let square = rows.len() <= unknowns.len();
    // Whether a row adds to others, told by its entries alone: what a square matrix needs of each.
    let adds = |row: &PrintedRow, others: &[&PrintedRow]| {
        places.iter().all(|place| {
            let entries = |row: &PrintedRow| -> Option<Vec<Rational>> {
                row.0.iter().map(|e| e.evaluate(&place.point)).collect()
            };
            let known: Option<Vec<_>> = others.iter().map(|r| entries(r)).collect();
            let (Some(mut all), Some(own)) = (known, entries(row)) else {
                return true;
            };
            let before = rank(all.clone());
            all.push(own);
            rank(all) > before
        })
    };
    let judged = rows.iter().enumerate().map(|(i, row)| {
        if row.0.iter().all(Expr::is_zero) {
            return Row::Empty;
        }
        let law = |row: &PrintedRow| places.iter().zip(&stated).all(|(p, s)| is_law(p, s, row));
        if law(row) {
            let above: Vec<&PrintedRow> = rows[..i].iter().collect();
            return match square && !adds(row, &above) {
                true => Row::Repeats,
                false => Row::Law,
            };
        }
        let others = rows.iter().enumerate().filter(|(j, _)| *j != i);
        let others = others.filter(|(_, row)| row.0.iter().any(|e| !e.is_zero()));
        let others: Vec<&PrintedRow> = others.map(|(_, row)| row).collect();
        let sound = |row: &PrintedRow| law(row) && (!square || adds(row, &others));
        // First of all what gives a law as it is written here: a row times a number is one as well.
        let written = |row: &PrintedRow| places.iter().all(|p| is_written(p, row));
        let mend = mend(row, rows, &|r| written(r) && sound(r)).or_else(|| mend(row, rows, &sound));
        match places.iter().all(|p| fulfilled(p, row)) {
            true => Row::Masked(mend),
            false => Row::Wrong(mend),
        }
    });
    Ok(judged.collect())
}

/// The change of one place that makes a row a law: its sign, a factor of two or four, sine for cosine, nothing, or what stands
/// elsewhere in the matrix.
fn mend(row: &PrintedRow, rows: &[PrintedRow], law: &dyn Fn(&PrintedRow) -> bool) -> Option<Mend> {
    let mut elsewhere: Vec<&Expr> = Vec::new();
    let all = rows.iter();
    for e in all.flat_map(|(row, right)| row.iter().chain([right])) {
        if !e.is_zero() && !elsewhere.contains(&e) {
            elsewhere.push(e);
        }
    }
    let entries = row.0.iter().enumerate().map(|(i, e)| (Some(i), e));
    let tries: Vec<(Option<usize>, &Expr)> = entries.chain([(None, &row.1)]).collect();
    let changed = |column: Option<usize>, value: Expr| {
        let mut new = row.clone();
        match column {
            Some(i) => new.0[i] = value.clone(),
            None => new.1 = value.clone(),
        }
        law(&new).then_some(Mend { column, value })
    };
    let near = |e: &Expr| {
        let times = |above, below| e * &Expr::ratio(above, below);
        let turned = arcs_exchanged(e, &|_| true);
        let [twice, half, fourfold, quarter] =
            [(2, 1), (1, 2), (4, 1), (1, 4)].map(|(a, b)| times(a, b));
        [-e, Expr::zero(), twice, half, turned, fourfold, quarter]
    };
    // A turned sign in any place comes before a missing factor in another.
    let simple = (0..7).find_map(|kind| {
        let mut places = tries.iter().filter(|(_, e)| !e.is_zero());
        places.find_map(|(column, e)| changed(*column, near(e)[kind].clone()))
    });
    simple.or_else(|| {
        tries.iter().find_map(|(column, _)| {
            let mut others = elsewhere.iter().flat_map(|e| [(*e).clone(), -*e]);
            others.find_map(|value| changed(*column, value))
        })
    })
}

/// A printed row over the unknowns, right side last.
fn spread(place: &Place, (entries, right): &PrintedRow) -> Option<Vec<Rational>> {
    let n = place.laws.unknowns.len();
    let mut out = vec![Rational::zero(); n + 1];
    for (entry, (form, constant)) in entries.iter().zip(&place.columns) {
        let k = entry.evaluate(&place.point)?;
        for (cell, part) in out.iter_mut().zip(form) {
            *cell += &k * part;
        }
        out[n] -= &k * constant;
    }
    out[n] += right.evaluate(&place.point)?;
    Some(out)
}

fn law_row(place: &Place, i: usize) -> Vec<Rational> {
    let mut row = place.laws.row(i).to_vec();
    row.push(place.laws.right[i].clone());
    row
}

/// The contact laws and givens that some printed row repeats.
fn stated(place: &Place, rows: &[PrintedRow]) -> Vec<usize> {
    let closing =
        |law: &Law| matches!(law, Law::Restitution(_) | Law::Sticking(..) | Law::Known(_));
    let candidates = (0..place.laws.laws.len()).filter(|i| closing(&place.laws.laws[*i]));
    let repeats = |row: &PrintedRow, i: usize| {
        spread(place, row)
            .is_some_and(|r| r.iter().any(|x| !x.is_zero()) && rank(vec![r, law_row(place, i)]) < 2)
    };
    candidates
        .filter(|i| rows.iter().any(|row| repeats(row, *i)))
        .collect()
}

fn is_law(place: &Place, stated: &[usize], row: &PrintedRow) -> bool {
    let Some(row) = spread(place, row) else {
        return false;
    };
    if row.iter().all(Zero::is_zero) {
        return true;
    }
    let repeats = |i: &usize| rank(vec![row.clone(), law_row(place, *i)]) < 2;
    if stated.iter().any(repeats) {
        return true;
    }
    let rest = (0..place.laws.laws.len()).filter(|i| !stated.contains(i));
    within(rest.map(|i| law_row(place, i)).collect(), row)
}

/// Whether a row is one of the laws as it is written, or with every sign turned.
fn is_written(place: &Place, row: &PrintedRow) -> bool {
    let same = |own: &[Rational]| {
        let all = (0..place.laws.laws.len()).map(|i| law_row(place, i));
        all.into_iter().any(|law| law == own)
    };
    let turned = |row: &[Rational]| row.iter().map(|x| -x.clone()).collect::<Vec<_>>();
    spread(place, row).is_some_and(|row| same(&row) || same(&turned(&row)))
}

fn fulfilled(place: &Place, row: &PrintedRow) -> bool {
    let all = (0..place.laws.laws.len()).map(|i| law_row(place, i));
    spread(place, row).is_some_and(|row| within(all.collect(), row))
}

fn within(mut rows: Vec<Vec<Rational>>, row: Vec<Rational>) -> bool {
    let before = rank(rows.clone());
    rows.push(row);
    rank(rows) == before
}

fn rank(mut rows: Vec<Vec<Rational>>) -> usize {
    let width = rows.first().map_or(0, Vec::len);
    reduce(&mut rows, width).len()
}

/// What a named unknown is, over the unknowns of the equations, and its constant part.
fn column(
    scene: &Scene,
    name: &str,
    point: &Point<Rational>,
    given: &Given<Rational>,
    laws: &System<Rational>,
) -> Result<(Vec<Rational>, Rational), String> {
    let mut asked = scene.asked_of_impact();
    let asked = asked.find_map(|q| Some((q, q.part(name)?)));
    let (question, axis) = asked.ok_or_else(|| format!("the scene asks for no {name}"))?;
    if let Ask::Energy { .. } = question.ask {
        return Err(format!("{name} is no component of the motion"));
    }
    let at = |values: Vec<Rational>| {
        let motion = numeric::motion(given, laws, &Solution::determined(values));
        match (numeric::answer(&question.ask, point, given, &motion), axis) {
            (Ok(Answer::Scalar(value)), None) => Ok(value),
            (Ok(Answer::Vector([x, y])), Some(axis)) => Ok(if axis == 0 { x } else { y }),
            (Ok(_), _) => Err(format!("{name} is no component")),
            (Err(why), _) => Err(format!("{name}: {why}")),
        }
    };
    // What is asked is linear in the unknowns, up to a constant.
    let n = laws.unknowns.len();
    let constant = at(vec![Rational::zero(); n])?;
    let factor = |i: usize| {
        let unit = (0..n).map(|j| Rational::from(Int::from(i64::from(i == j))));
        Ok(at(unit.collect())? - &constant)
    };
    let row = (0..n).map(factor).collect::<Result<_, String>>()?;
    Ok((row, constant))
}
