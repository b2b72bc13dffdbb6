//! What is known while a scene is put together, and how what the file names is found.

use super::body_file::ShapeName;
use std::collections::HashMap;

use super::body::{Solid, SolidReader};
use super::claim::{Claim, Claimed};
use super::fault::{Fault, Span, TOLD};
use super::file::SceneFile;
use super::formulas::{Quantity, Symbols};
use super::record::{Formula, Pair, Text, names};
use crate::expr::{Expr, Vector};
use crate::formula::near::nearest;

/// How far a position is known.
#[derive(Clone)]
pub(super) enum Place {
    Untouched,
    Underway,
    /// `None` if it cannot be found, which has been reported.
    Done(Option<Vector>),
}

/// What is known while a scene is put together.
pub(super) struct Resolver<'f> {
    pub file: &'f SceneFile,
    pub symbols: Symbols,
    pub faults: Vec<Fault>,
    /// What the scene claims of its formulas, to be checked when everything is read.
    pub claims: Vec<Claimed>,
    pub points: HashMap<&'f str, usize>,
    pub bodies: HashMap<&'f str, usize>,
    pub point_places: Vec<Place>,
    pub body_places: Vec<Place>,
    pub composites: HashMap<usize, Solid>,
    pub chain: Vec<String>,
}

impl<'f> Resolver<'f> {
    /// Nothing of the file placed yet.
    pub fn new(
        file: &'f SceneFile,
        symbols: Symbols,
        faults: Vec<Fault>,
        claims: Vec<Claimed>,
    ) -> Resolver<'f> {
        let points = names(file.points.as_ref());
        let bodies = names(Some(&file.bodies));
        Resolver {
            file,
            symbols,
            faults,
            claims,
            point_places: vec![Place::Untouched; points.len()],
            body_places: vec![Place::Untouched; bodies.len()],
            points,
            bodies,
            composites: HashMap::new(),
            chain: Vec::new(),
        }
    }

    /// Reads a formula of a quantity.
    pub fn read(&mut self, formula: &Formula, quantity: Quantity) -> Option<Expr> {
        self.symbols.read(formula, quantity, &mut self.faults)
    }

    /// Reads both components of a vector.
    pub fn vector(&mut self, pair: &Pair<Formula>, quantity: Quantity) -> Option<Vector> {
        self.symbols.vector(pair, quantity, &mut self.faults)
    }

    /// Notes what the scene relies on, to be checked when everything is read.
    pub fn claim(&mut self, span: Span, claim: Claim) {
        self.claims.push(Claimed { span, claim });
    }

    /// Reports what is wrong at a place, and what to do about it.
    pub fn report(&mut self, at: Span, message: impl Into<String>, hint: impl Into<String>) {
        self.faults.push(Fault::new(at, message).hint(hint));
    }

    /// The same, for what cannot be read because of it.
    pub fn refuse<T>(
        &mut self,
        at: Span,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) -> Option<T> {
        self.report(at, message, hint);
        None
    }

    pub fn solids(&mut self) -> SolidReader<'_> {
        SolidReader {
            symbols: &self.symbols,
            claims: &mut self.claims,
            faults: &mut self.faults,
        }
    }

    pub(super) fn shape(&self, body: usize) -> Option<ShapeName> {
        self.file.bodies.0.get(body)?.1.as_ref().map(|b| b.shape)
    }

    /// Whether the body is a particle.
    pub fn is_particle(&self, body: usize) -> bool {
        self.shape(body) == Some(ShapeName::Particle)
    }

    /// Whether the body is fixed.
    pub fn is_fixed(&self, body: usize) -> bool {
        self.shape(body) == Some(ShapeName::Fixed)
    }

    /// Index of a body.
    pub fn body_named(&mut self, name: &Text) -> Option<usize> {
        let found = self.bodies.get(name.text.as_str()).copied();
        if found.is_none() {
            self.unknown(name, "body", |this| this.bodies.keys().copied().collect());
        }
        found
    }

    /// Index of a body that can move.
    pub fn moving(&mut self, name: &Text) -> Option<usize> {
        let body = self.body_named(name)?;
        if self.is_fixed(body) {
            let message = format!("`{}` is fixed, and does not move", name.text);
            return Fault::new(name.span, message).add_to(&mut self.faults);
        }
        Some(body)
    }

    /// Index of a body, if one has this name.
    pub fn find_body(&self, name: &str) -> Option<usize> {
        self.bodies.get(name).copied()
    }

    /// Position of a named point, if there is one of this name.
    pub fn find_point(&mut self, name: &str) -> Option<Option<Vector>> {
        let i = self.points.get(name).copied()?;
        Some(self.point(i))
    }

    /// Reports a name that stands for nothing, with the nearest that does.
    pub fn unknown<'a>(
        &mut self,
        name: &Text,
        what: &str,
        candidates: impl FnOnce(&Self) -> Vec<&'a str>,
    ) {
        let fault = Fault::new(name.span, format!("there is no {what} `{}`", name.text));
        // Searching for the nearest name takes time that is not worth it for faults nobody will be told.
        let mut candidates = match self.faults.len() <= TOLD {
            true => candidates(self),
            false => Vec::new(),
        };
        candidates.sort_unstable();
        let near = nearest(&name.text, candidates.iter().copied());
        self.faults.push(match near {
            Some(near) => fault.hint(format!("did you mean `{near}`?")),
            None if (1..=12).contains(&candidates.len()) => {
                let are = if candidates.len() == 1 { "is" } else { "are" };
                fault.hint(format!("there {are} {}", candidates.join(", ")))
            }
            None => fault,
        });
    }

    /// Names of all bodies and points.
    pub fn positions(&self) -> Vec<&'f str> {
        let all = self.points.keys().chain(self.bodies.keys());
        all.copied().collect()
    }
}
