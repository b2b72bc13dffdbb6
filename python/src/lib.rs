//! carom for Python, the part in Rust: texts in, JSON out, arrays of doubles. What people meet is written in Python, in
//! `carom/`.
//!
//! Whatever takes long lets other threads of Python run. A fault of carom itself becomes an exception and never ends the
//! process.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyByteArray;
use rayon::prelude::*;

use carom::command::{self, Format, Lines, Numbers, Output};
use carom::expr::{Point, Symbol};
use carom::grade::entry::Keys;
use carom::grade::sheet::Sheet;
use carom::grade::{Options, Strength};
use carom::{emit, render, scene};

pyo3::create_exception!(
    _carom,
    CaromError,
    pyo3::exceptions::PyValueError,
    "What was given cannot be used; the message says why and what would help."
);

/// Lines of a batch judged by one task.
const TASK: usize = 64;
/// Points at which a task evaluates a function.
const POINTS: usize = 1 << 13;

/// Works without holding up other threads of Python; refusals and faults become exceptions.
fn work<T: Send>(py: Python<'_>, f: impl FnOnce() -> Result<T, String> + Send) -> PyResult<T> {
    match py.detach(|| catch_unwind(AssertUnwindSafe(f))) {
        Ok(Ok(value)) => Ok(value),
        Ok(Err(why)) => Err(CaromError::new_err(why)),
        Err(_) => Err(PyRuntimeError::new_err(
            "a fault of carom itself; please report what led to it",
        )),
    }
}

fn pair(output: Output) -> (String, u8) {
    (output.text, output.status)
}

fn opened(name: &str, text: &str, set: &[String]) -> Result<(Sheet, Vec<String>), String> {
    let scene = command::scene(name, text, set)?;
    command::sheet(scene).map_err(|why| format!("{name}: {why}"))
}

/// The derivation of a scene as JSON, and its status.
#[pyfunction]
fn derive(py: Python<'_>, name: &str, text: &str, set: Vec<String>) -> PyResult<(String, u8)> {
    work(py, || {
        let scene = command::scene(name, text, &set)?;
        let found = command::derive(&scene, Format::Json);
        found.map(pair).map_err(|why| format!("{name}: {why}"))
    })
}

/// The numbers of a scene as JSON, and the status.
#[pyfunction]
fn solve(
    py: Python<'_>,
    name: &str,
    text: &str,
    set: Vec<String>,
    numbers: &str,
) -> PyResult<(String, u8)> {
    let numbers = match numbers {
        "exact" => Numbers::Exact,
        "certified" => Numbers::Certified,
        _ => Numbers::Doubles,
    };
    work(py, || {
        let scene = command::scene(name, text, &set)?;
        let found = command::solve(&scene, numbers, Format::Json);
        found.map(pair).map_err(|why| format!("{name}: {why}"))
    })
}

/// What is printed about a scene held against what is derived, as JSON. `answers` takes the place of the scene's own list.
#[pyfunction]
fn printed(py: Python<'_>, name: &str, text: &str, answers: Option<&str>) -> PyResult<String> {
    work(py, || {
        let mut scene = command::scene(name, text, &[])?;
        if let Some(answers) = answers {
            let list = scene::read_printed(answers);
            scene.printed = list.map_err(|faults| faults.render("answers", answers))?;
        }
        let (findings, _) =
            command::printed(scene.clone()).map_err(|why| format!("{name}: {why}"))?;
        Ok(render::json::versioned(&render::printed::json(
            &scene, &findings,
        )))
    })
}

/// How a formula is understood, as JSON, and the status.
#[pyfunction]
fn read(py: Python<'_>, formula: &str) -> PyResult<(String, u8)> {
    work(py, || command::read(formula, None, Format::Json).map(pair))
}

/// A grader of lines of JSON. With the text of a scene every line is about that scene; without one a line may name a file
/// below the working folder.
#[pyclass(frozen)]
struct Grader {
    lines: Lines,
    quantities: Vec<String>,
}

#[pymethods]
impl Grader {
    #[new]
    #[pyo3(signature = (scene=None, fast=false, strict_slash=false))]
    fn new(
        py: Python<'_>,
        scene: Option<(String, String)>,
        fast: bool,
        strict_slash: bool,
    ) -> PyResult<Grader> {
        let options = Options {
            strength: match fast {
                true => Strength::Fast,
                false => Strength::Identity,
            },
            strict_slash,
            ..Options::default()
        };
        work(py, || {
            let Some((name, text)) = scene else {
                return Ok(Grader {
                    lines: Lines::new(options, from_file),
                    quantities: Vec::new(),
                });
            };
            let (sheet, _) = opened(&name, &text, &[])?;
            Ok(Grader {
                quantities: sheet.quantities(),
                lines: Lines::new(options, move |_| Ok(sheet.clone())),
            })
        })
    }

    /// Names of everything that can be asked of the scene.
    #[getter]
    fn quantities(&self) -> Vec<String> {
        self.quantities.clone()
    }

    /// A line of JSON for each line, in order; `first` is the number of the first.
    fn judge(&self, py: Python<'_>, lines: Vec<String>, first: u64) -> PyResult<Vec<String>> {
        work(py, || {
            let tasks = lines.par_chunks(TASK).enumerate();
            let judged = tasks.map(|(task, lines)| {
                let mut keys = Keys::default();
                let numbers = first + (task * TASK) as u64..;
                let one = |(line, number): (&String, u64)| {
                    let mut out = String::new();
                    self.lines.judge(&mut keys, line, number, &mut out);
                    out
                };
                lines.iter().zip(numbers).map(one).collect::<Vec<_>>()
            });
            Ok(judged.flatten().collect())
        })
    }
}

fn from_file(path: &str) -> Result<Sheet, String> {
    let length = std::fs::metadata(path).map_err(|e| e.to_string())?.len();
    if length > scene::LONGEST as u64 {
        return Err(String::from("too long"));
    }
    let text = std::fs::read_to_string(path).map_err(|e| e.to_string())?;
    opened(path, &text, &[]).map(|(sheet, _)| sheet)
}

/// A closed form in doubles, arranged for accuracy.
#[pyclass(frozen)]
struct Function {
    function: Arc<emit::Function>,
    /// The scene's own value of each argument.
    given: Vec<Option<f64>>,
}

/// Symbol, unit, domain in words, meaning, and the scene's own value.
type Argument = (String, String, String, String, Option<f64>);

#[pymethods]
impl Function {
    /// Name of the answer.
    #[getter]
    fn name(&self) -> &str {
        &self.function.name
    }

    /// What it takes.
    #[getter]
    fn arguments(&self) -> Vec<Argument> {
        let each = self.function.arguments.iter().zip(&self.given);
        each.map(|(a, given)| {
            (
                a.symbol.to_string(),
                a.unit.clone(),
                a.domain.clone(),
                a.meaning.clone(),
                *given,
            )
        })
        .collect()
    }

    /// The values at `count` points: a column of native doubles for each argument, one column back.
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        columns: Vec<Vec<u8>>,
        count: usize,
    ) -> PyResult<Bound<'py, PyByteArray>> {
        let f = self.function.clone();
        let values = work(py, move || {
            let right = columns.len() == f.arguments.len()
                && columns.iter().all(|c| c.len() == count * size_of::<f64>());
            if !right {
                return Err(String::from(
                    "a column of doubles is needed for each argument",
                ));
            }
            let columns: Vec<&[[u8; 8]]> = columns.iter().map(|c| c.as_chunks().0).collect();
            let mut values = vec![[0u8; 8]; count];
            let tasks = values.par_chunks_mut(POINTS).enumerate();
            tasks.for_each(|(task, values)| {
                let (mut inputs, mut slots) = (Vec::new(), Vec::new());
                let mut arguments = vec![0.0; columns.len()];
                for (i, value) in values.iter_mut().enumerate() {
                    let row = task * POINTS + i;
                    for (argument, column) in arguments.iter_mut().zip(&columns) {
                        *argument = f64::from_ne_bytes(column[row]);
                    }
                    let found = f.value(&arguments, &mut inputs, &mut slots);
                    *value = found.to_ne_bytes();
                }
            });
            Ok(values)
        })?;
        Ok(PyByteArray::new(py, values.as_flattened()))
    }
}

/// A function for every number that a scene asks for.
#[pyfunction]
fn functions(py: Python<'_>, name: &str, text: &str, set: Vec<String>) -> PyResult<Vec<Function>> {
    work(py, || {
        let (sheet, _) = opened(name, text, &set)?;
        let (found, _) = emit::functions(&sheet.scene, &sheet.derivation);
        let given = |name: &Symbol| {
            let found = sheet.scene.parameters.iter().find(|p| p.name == *name)?;
            found.value.as_ref()?.evaluate(&Point::<f64>::default())
        };
        let found = found.into_iter().map(|f| Function {
            given: f.arguments.iter().map(|a| given(&a.symbol)).collect(),
            function: Arc::new(f),
        });
        Ok(found.collect())
    })
}

/// carom, for the Python package around this.
#[pymodule]
fn _carom(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("CaromError", m.py().get_type::<CaromError>())?;
    m.add("LONGEST_SCENE", scene::LONGEST)?;
    m.add_class::<Grader>()?;
    m.add_class::<Function>()?;
    m.add_function(wrap_pyfunction!(derive, m)?)?;
    m.add_function(wrap_pyfunction!(solve, m)?)?;
    m.add_function(wrap_pyfunction!(printed, m)?)?;
    m.add_function(wrap_pyfunction!(read, m)?)?;
    m.add_function(wrap_pyfunction!(functions, m)?)
}
