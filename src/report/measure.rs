//! Error against run time: every route at every point, held against the exact answer.
//!
//! In: a scene, a derivation, a seed. Out: rows as they finish, and the whole. Errors are in units in the last place of the
//! exact answer; answers that are exactly zero, or beyond the range of normal doubles, are left out and counted.

use std::collections::BTreeMap;
use std::time::Instant;

use serde::Serialize;

use super::errors::{Errors, digits_lost, ulps};
use super::routes::{Place, Prepared, Quantity, Route};
use super::sample::{Family, RANGES, Sampler, flags};
use crate::answer::Form;
use crate::derive::Derivation;
use crate::emit::{self, Heading, Language, Style};
use crate::scene::Scene;

/// How much to measure.
#[derive(Clone, Debug, Serialize)]
pub struct Effort {
    /// Seed of all points.
    pub seed: u64,
    /// Points per level of a family; usual values get eight times as many.
    pub points: usize,
    /// Timed runs per route.
    pub runs: usize,
    /// Repetitions within a run.
    pub repeat: usize,
    /// The one family to measure besides usual values; all if none is named.
    pub family: Option<String>,
}

/// One route at one level of a family, all quantities and points together.
#[derive(Clone, Debug, Serialize)]
pub struct Cell {
    /// The route.
    pub route: Route,
    /// Largest error \[ulp\].
    pub max: f64,
    /// Median error \[ulp\].
    pub median: f64,
    /// Decimal digits lost by the worst answer, of about 16.
    pub digits_lost: f64,
    /// Largest error over 2⁻⁵³ × structured condition number.
    pub stability: f64,
}

/// One level of a family.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Family.
    pub family: String,
    /// Place on its axis.
    pub x: f64,
    /// Points that had an exact answer.
    pub points: usize,
    /// Largest structured condition number of an answer.
    pub condition: f64,
    /// What is special about the points.
    pub flags: Vec<&'static str>,
    /// The routes.
    pub cells: Vec<Cell>,
}

/// A family and its rows.
#[derive(Clone, Debug, Serialize)]
pub struct Swept {
    /// Name.
    pub name: String,
    /// What varies.
    pub words: String,
    /// Label of the axis.
    pub axis: String,
    /// Levels.
    pub rows: Vec<Row>,
}

/// A route over the whole report.
#[derive(Clone, Debug, Serialize)]
pub struct RouteSummary {
    /// The route.
    pub route: Route,
    /// In words.
    pub words: &'static str,
    /// Lower quartile, median, upper quartile of its time \[s\], from the numbers of the scene to all answers.
    pub seconds: [f64; 3],
    /// Errors at usual values, per quantity.
    pub usual: BTreeMap<String, Errors>,
    /// Largest error at usual values \[ulp\].
    pub usual_max: f64,
    /// Largest error anywhere \[ulp\].
    pub worst: f64,
    /// The family it happened in.
    pub worst_family: String,
    /// Largest stability factor wherever nothing leaves the range of doubles.
    pub stability: f64,
    /// Whether another route is both faster and at least as accurate everywhere.
    pub dominated: bool,
}

/// Everything measured of a scene.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Title.
    pub title: String,
    /// Source.
    pub source: String,
    /// Parameters of the measurement.
    pub effort: Effort,
    /// Machine and versions.
    pub machine: Machine,
    /// Names of the quantities.
    pub quantities: Vec<String>,
    /// Largest condition number per quantity at usual values, with the error 2⁻⁵³ × it [ulp of 1].
    pub conditions: BTreeMap<String, f64>,
    /// Routes.
    pub routes: Vec<RouteSummary>,
    /// Families.
    pub families: Vec<Swept>,
    /// Which route to use here, and why.
    pub verdict: String,
    /// Name and closed form of each quantity that has one.
    pub formulas: Vec<[String; 2]>,
    /// What was measured.
    #[serde(skip)]
    pub scene: Scene,
    /// What `carom emit` writes of them in C.
    #[serde(skip)]
    pub code: String,
    /// Answers left out: exactly zero, or beyond the range of normal doubles.
    pub left_out: usize,
    /// Whether the measurement was stopped before its end.
    pub interrupted: bool,
}

/// Where it was measured.
#[derive(Clone, Debug, Serialize)]
pub struct Machine {
    /// Processors seen.
    pub processors: usize,
    /// Architecture.
    pub architecture: &'static str,
    /// Operating system.
    pub system: &'static str,
    /// Version of carom.
    pub carom: &'static str,
    /// Whether optimizations were on.
    pub optimized: bool,
}

impl Machine {
    /// This one.
    pub fn here() -> Machine {
        Machine {
            processors: std::thread::available_parallelism().map_or(1, usize::from),
            architecture: std::env::consts::ARCH,
            system: std::env::consts::OS,
            carom: env!("CARGO_PKG_VERSION"),
            optimized: !cfg!(debug_assertions),
        }
    }
}

/// Why a scene cannot be measured.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoReport {
    /// It asks for no number.
    NothingAsked,
    /// The laws leave these quantities open.
    Open(Vec<String>),
    /// At no point tried do the laws determine what is asked, or it is irrational there.
    NoAnswer,
    /// It lacks the family asked for; those it has.
    NoFamily(String, Vec<String>),
}

impl std::fmt::Display for NoReport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            NoReport::NothingAsked => {
                f.write_str("the scene asks for no number, so there is nothing to measure")
            }
            NoReport::Open(names) => write!(
                f,
                "the laws leave {} open, so there is nothing to measure against",
                names.join(", ")
            ),
            NoReport::NoAnswer => f.write_str(
                "at no point tried do the laws determine every answer as a fraction, so there is nothing to measure against",
            ),
            NoReport::NoFamily(asked, has) => {
                write!(f, "the scene has no family `{asked}`\nhint: it has {}", has.join(", "))
            }
        }
    }
}

impl std::error::Error for NoReport {}

/// Measures a scene. `row` is told of every row as it finishes and says whether to go on.
pub(super) fn measured(
    scene: &Scene,
    derivation: Option<&Derivation>,
    effort: Effort,
    mut row: impl FnMut(&Row, usize, usize) -> bool,
) -> Result<Report, NoReport> {
    let prepared = Prepared::new(scene, derivation);
    if prepared.quantities.is_empty() {
        return Err(NoReport::NothingAsked);
    }
    let open = derivation.map_or_else(Vec::new, |d| open(d, &prepared.quantities));
    if !open.is_empty() {
        return Err(NoReport::Open(open));
    }
    let sampler = Sampler::new(scene, effort.seed);
    let mut families = sampler.families(effort.points);
    if let Some(asked) = &effort.family {
        let has = families.iter().map(|f| f.name.clone()).collect();
        families.retain(|f| f.axis.is_empty() || f.name == *asked);
        if !families.iter().any(|f| f.name == *asked) {
            return Err(NoReport::NoFamily(asked.clone(), has));
        }
    }
    // Usual values come first; their first point with an answer is where routes are timed.
    let place = families[0].levels[0]
        .points
        .iter()
        .filter(|p| prepared.truth(p).is_some())
        .find_map(|p| prepared.place(p))
        .ok_or(NoReport::NoAnswer)?;
    let routes = prepared.routes(&place);
    let mut bench = Bench {
        prepared: &prepared,
        routes: &routes,
        left_out: 0,
        usual: BTreeMap::new(),
        conditions: BTreeMap::new(),
    };
    let total: usize = families.iter().map(|f| f.levels.len()).sum();
    let mut done = 0;
    let mut interrupted = false;
    let mut swept: Vec<Swept> = Vec::new();
    for family in &families {
        let mut rows = Vec::new();
        for level in 0..family.levels.len() {
            let next = (!interrupted).then(|| bench.row(family, level));
            if let Some(next) = next.flatten() {
                done += 1;
                interrupted = !row(&next, done, total);
                rows.push(next);
            }
        }
        if !rows.is_empty() {
            swept.push(Swept {
                name: family.name.clone(),
                words: family.words.clone(),
                axis: family.axis.clone(),
                rows,
            });
        }
    }
    let runs = effort.runs.min(if interrupted { 5 } else { usize::MAX });
    let seconds = |route| time(&prepared, route, &place, runs, effort.repeat);
    let summary = |r: &Route| bench.summary(*r, &swept, seconds(*r));
    let summaries = routes.iter().map(summary).collect();
    let functions = derivation.map_or_else(Vec::new, |d| emit::functions(scene, d).0);
    let formulas = functions
        .iter()
        .map(|f| [f.name.clone(), f.formula.clone()]);
    let heading = Heading {
        title: scene.title.clone(),
        source: scene.source.clone(),
        assumptions: derivation.map_or_else(Vec::new, |d| {
            d.assumptions.iter().map(ToString::to_string).collect()
        }),
    };
    Ok(Report {
        title: scene.title.clone(),
        source: scene.source.clone(),
        machine: Machine::here(),
        quantities: prepared.quantities.iter().map(|q| q.name.clone()).collect(),
        conditions: bench.conditions,
        effort,
        routes: summaries,
        families: swept,
        verdict: String::new(),
        formulas: formulas.collect(),
        scene: scene.clone(),
        code: match functions.is_empty() {
            true => String::new(),
            false => emit::file(&Style::of(Language::C), &heading, &functions),
        },
        left_out: bench.left_out,
        interrupted,
    })
}

/// Names of the quantities that the laws leave open.
fn open(derivation: &Derivation, quantities: &[Quantity]) -> Vec<String> {
    let is_open = |name: &str| {
        let mut answers = derivation.answers.iter();
        answers.any(|a| a.name == name && matches!(a.form, Form::Open(_)))
    };
    let names = quantities.iter().map(|q| q.name.clone());
    names.filter(|name| is_open(name)).collect()
}

struct Bench<'a> {
    prepared: &'a Prepared<'a>,
    routes: &'a [Route],
    left_out: usize,
    /// All errors at usual values by route and quantity.
    usual: BTreeMap<(Route, usize), Vec<f64>>,
    conditions: BTreeMap<String, f64>,
}

impl Bench<'_> {
    fn summary(&self, route: Route, swept: &[Swept], seconds: [f64; 3]) -> RouteSummary {
        let mut stability = 0.0f64;
        let (mut worst, mut worst_family) = (0.0, String::new());
        for family in swept {
            let cells = family.rows.iter().flat_map(|r| &r.cells);
            let in_range = !RANGES.contains(&family.name.as_str());
            for cell in cells.filter(|c| c.route == route) {
                if in_range {
                    stability = stability.max(cell.stability);
                }
                if cell.max > worst {
                    (worst, worst_family) = (cell.max, family.name.clone());
                }
            }
        }
        let quantities = self.prepared.quantities.iter().enumerate();
        let usual: BTreeMap<String, Errors> = quantities
            .map(|(q, quantity)| {
                let all = self.usual.get(&(route, q)).cloned();
                (quantity.name.clone(), Errors::of(all.unwrap_or_default()))
            })
            .collect();
        RouteSummary {
            route,
            words: route.words(),
            seconds,
            usual_max: usual.values().map(|e| e.max).fold(0.0, f64::max),
            usual,
            worst,
            worst_family,
            stability,
            dominated: false,
        }
    }

    fn row(&mut self, family: &Family, level: usize) -> Option<Row> {
        let is_usual = family.axis.is_empty();
        let level = &family.levels[level];
        let mut all: BTreeMap<Route, Vec<f64>> = BTreeMap::new();
        let mut stability: BTreeMap<Route, f64> = BTreeMap::new();
        let mut condition = 0.0f64;
        let mut special: Vec<&'static str> = Vec::new();
        let mut points = 0;
        for point in &level.points {
            let place = self.prepared.place(point);
            let Some((place, truth)) = place.zip(self.prepared.truth(point)) else {
                continue;
            };
            points += 1;
            let near = self.prepared.conditions(point, &truth);
            special.extend(flags(&place.given, &near));
            for (q, exact) in truth.iter().enumerate() {
                if ulps(0.0, exact).is_none() {
                    self.left_out += 1;
                    continue;
                }
                condition = condition.max(near[q]);
                if is_usual {
                    let name = self.prepared.quantities[q].name.clone();
                    let entry = self.conditions.entry(name).or_insert(0.0);
                    *entry = entry.max(near[q]);
                }
            }
            for route in self.routes {
                let found = self.prepared.follow(*route, &place);
                for (q, exact) in truth.iter().enumerate() {
                    let value = found.as_ref().map_or(f64::NAN, |f| f[q]);
                    let Some(error) = ulps(value, exact) else {
                        continue;
                    };
                    all.entry(*route).or_default().push(error);
                    if is_usual {
                        self.usual.entry((*route, q)).or_default().push(error);
                    }
                    // Half a unit in the last place is 2⁻⁵³ of a number just below a power of two; the error relative
                    // to the answer is at most twice the ulps counted in 2⁻⁵³.
                    let factor = 2.0 * error / near[q].max(1.0);
                    let worst = stability.entry(*route).or_insert(0.0);
                    *worst = worst.max(factor);
                }
            }
        }
        let cells = self.routes.iter().filter_map(|route| {
            let errors = Errors::of(all.remove(route)?);
            Some(Cell {
                route: *route,
                max: errors.max,
                median: errors.median,
                digits_lost: digits_lost(errors.max),
                stability: stability.get(route).copied().unwrap_or(0.0),
            })
        });
        let cells: Vec<Cell> = cells.collect();
        special.sort_unstable();
        special.dedup();
        (points > 0 && !cells.is_empty()).then(|| Row {
            family: family.name.clone(),
            x: level.x,
            points,
            condition,
            flags: special,
            cells,
        })
    }
}

fn time(prepared: &Prepared, route: Route, place: &Place, runs: usize, repeat: usize) -> [f64; 3] {
    let Some(mut work) = prepared.work(route, place) else {
        return [f64::NAN; 3];
    };
    let repeat = match route {
        Route::Exact => (repeat / 50).max(1),
        _ => repeat,
    };
    quartiles(runs, || {
        for _ in 0..repeat {
            std::hint::black_box(work());
        }
    })
    .map(|t| t / repeat as f64)
}

/// Quartiles of the time of `work` \[s\] over `runs` runs, after one that does not count.
fn quartiles(runs: usize, mut work: impl FnMut()) -> [f64; 3] {
    work();
    let time = |_| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    };
    let mut times: Vec<f64> = (0..runs.max(1)).map(time).collect();
    times.sort_by(f64::total_cmp);
    [1, 2, 3].map(|q| times[(times.len() - 1) * q / 4])
}
