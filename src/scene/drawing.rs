//! How a scene wants to be drawn: values, outlines, supports, strings. Nothing here changes mechanics.
//!
//! In: the field `figure` of a scene file. Out: [`Drawn`], with names resolved and lengths read.

use super::fault::Fault;
use super::file::{LooksName, OutlineFile, Support};
use super::formulas::Quantity;
use super::parameters;
use super::record::Text;
use super::record::entries;
use super::resolver::Resolver;
use crate::dimension;
use crate::domain::Domains;
use crate::expr::{Expr, Symbol, Vector};

/// Hints for the figures of a scene.
#[derive(Clone, Debug, Default)]
pub struct Drawn {
    /// Values to draw at, in SI units.
    pub values: Vec<(Symbol, Expr)>,
    /// What bodies look like, by index.
    pub outlines: Vec<(usize, Outline)>,
    /// What stands at a contact, a support or a fixed point, by its name.
    pub supports: Vec<(String, Support)>,
    /// Strings: the contact that stands for one or a body, and where it is fastened; `None` leaves that open.
    pub strings: Vec<(String, Option<Vector>)>,
    /// Springs under a body: the name of the force that they exert, and the points above them \[m\].
    pub springs: Vec<(String, Vec<Vector>)>,
    /// Height of the level ground \[m\].
    pub ground: Option<Expr>,
}

/// A simple outline.
#[derive(Clone, Debug)]
pub enum Outline {
    /// A person stretched out, hands first, of this height \[m\].
    Person(Expr),
    /// A bat of this length \[m\], handle first.
    Bat(Expr),
    /// A box of this width and height \[m\].
    Box([Expr; 2]),
}

impl Drawn {
    /// The outline of a body.
    pub fn outline(&self, body: usize) -> Option<&Outline> {
        self.outlines
            .iter()
            .find(|(b, _)| *b == body)
            .map(|(_, o)| o)
    }

    /// What stands at a point.
    pub fn support(&self, name: &str) -> Option<Support> {
        self.supports
            .iter()
            .find(|(n, _)| n == name)
            .map(|(_, s)| *s)
    }

    /// The points above the springs that exert a force; none where no spring does.
    pub fn springs(&self, force: &str) -> &[Vector] {
        let found = self.springs.iter().find(|(name, _)| name == force);
        found.map_or(&[], |(_, places)| places)
    }

    /// Where a string is fastened: `None` where there is none.
    pub fn string(&self, name: &str) -> Option<&Option<Vector>> {
        self.strings
            .iter()
            .find(|(n, _)| n == name)
            .map(|(_, at)| at)
    }
}

/// The hints of a file.
pub(super) fn hints(r: &mut Resolver<'_>, domains: &Domains) -> Drawn {
    let mut out = Drawn::default();
    let Some(file) = &r.file.figure else {
        return out;
    };
    for (name, formula) in entries(file.values.as_ref()) {
        let parameter = entries(r.file.parameters.as_ref()).find(|(n, _)| n.text == name.text);
        let Some((_, parameter)) = parameter else {
            let known = parameters(r);
            r.unknown(name, "parameter", |_| known);
            continue;
        };
        let unit = parameter.unit.as_ref().map_or("1", |u| u.text.as_str());
        let Ok(unit) = dimension::unit(unit) else {
            continue;
        };
        let Some(value) = parameters::value(formula, &unit, &mut r.faults) else {
            continue;
        };
        let symbol = Symbol::from(name.text.as_str());
        match domains
            .symbols
            .get(&symbol)
            .map(|d| parameters::lies_in(&name.text, &value, d))
        {
            Some(Err(message)) => r.faults.push(Fault::new(formula.span, message)),
            _ => out.values.push((symbol, value)),
        }
    }
    for (name, looks) in entries(file.bodies.as_ref()) {
        let Some(body) = r.moving(name) else { continue };
        if let Some(outline) = outline(r, name, looks) {
            out.outlines.push((body, outline));
        }
    }
    let places = places(r);
    for (name, support) in entries(file.supports.as_ref()) {
        if known(r, name, &places) {
            out.supports.push((name.text.clone(), *support));
        }
    }
    for (name, at) in entries(file.strings.as_ref()) {
        if r.bodies.contains_key(name.text.as_str()) || known(r, name, &places) {
            let at = r.position(at);
            out.strings.push((name.text.clone(), at));
        }
    }
    let forces = forces(r);
    for (name, places) in entries(file.springs.as_ref()) {
        if !forces.contains(&name.text.as_str()) {
            let forces = forces.clone();
            r.unknown(name, "force", |_| forces);
            continue;
        }
        let places = places.iter().filter_map(|at| r.position(at)).collect();
        out.springs.push((name.text.clone(), places));
    }
    if let Some(height) = &file.ground {
        out.ground = r.symbols.read(height, Quantity::LENGTH, &mut r.faults);
    }
    out
}

fn outline(r: &mut Resolver<'_>, name: &Text, looks: &OutlineFile) -> Option<Outline> {
    let mut length = |formula: &Option<_>| {
        let formula = formula.as_ref()?;
        r.symbols.read(formula, Quantity::LENGTH, &mut r.faults)
    };
    match looks.looks {
        LooksName::Person | LooksName::Bat if looks.length.is_some() => {
            let length = length(&looks.length)?;
            Some(match looks.looks {
                LooksName::Person => Outline::Person(length),
                _ => Outline::Bat(length),
            })
        }
        LooksName::Box if looks.width.is_some() && looks.height.is_some() => Some(Outline::Box([
            length(&looks.width)?,
            length(&looks.height)?,
        ])),
        _ => {
            let fault = Fault::new(name.span, "the size of this outline is missing");
            r.faults
                .push(fault.hint("a person and a bat need `length`, a box `width` and `height`"));
            None
        }
    }
}

fn parameters<'f>(r: &Resolver<'f>) -> Vec<&'f str> {
    entries(r.file.parameters.as_ref())
        .map(|(name, _)| name.text.as_str())
        .collect()
}

/// Names of everything that holds or is hit, in the scene and in its stages.
fn places<'f>(r: &Resolver<'f>) -> Vec<&'f str> {
    fn keys<T>(map: &Option<super::record::Map<T>>) -> impl Iterator<Item = &str> {
        entries(map.as_ref()).map(|(name, _)| name.text.as_str())
    }
    let file = r.file;
    let mut out: Vec<&str> = keys(&file.contacts).chain(keys(&file.hinges)).collect();
    out.extend(keys(&file.points));
    for impact in file
        .stages
        .iter()
        .flatten()
        .filter_map(|s| s.impact.as_ref())
    {
        out.extend(impact.places().into_iter().map(|name| name.text.as_str()));
    }
    out
}

/// Names of the finite forces, in the scene and in its stages.
fn forces<'f>(r: &Resolver<'f>) -> Vec<&'f str> {
    let stages = r.file.stages.iter().flatten();
    let impacts = stages.filter_map(|s| s.impact.as_ref());
    let all = impacts.flat_map(|i| i.forces.iter().flatten());
    let all = all.chain(r.file.forces.iter().flatten());
    all.map(|f| f.name.text.as_str()).collect()
}

fn known(r: &mut Resolver<'_>, name: &Text, places: &[&str]) -> bool {
    let known = places.contains(&name.text.as_str());
    if !known {
        let places = places.to_vec();
        r.unknown(name, "contact, support, string, hinge or point", |_| places);
    }
    known
}
