//! Mass and inertia of shapes, and of parts joined rigidly.
//!
//! In: a body as the file describes it. Out: shape, mass m and moment of inertia about the center of mass I_G; for a
//! composite its center too. Which fields belong to which shape is told here.

use num_traits::Zero;

use super::body_file::{BodyFile, ShapeName, VelocityFile};
use super::claim::{Claim, Claimed};
use super::fault::Fault;
use super::formulas::{Quantity, Symbols};
use super::place_file::PositionFile;
use super::record::{Formula, is_sound};
use super::{Body, Shape};
use crate::expr::{Expr, Rational, Vector, dot, minus};

/// What a body is made of.
pub(super) struct Solid {
    pub shape: Shape,
    pub mass: Expr,
    /// About the center of mass.
    pub inertia: Expr,
    /// Whether the file gives it.
    pub inertia_given: bool,
}

/// Reads bodies.
pub(super) struct SolidReader<'a> {
    pub symbols: &'a Symbols,
    pub claims: &'a mut Vec<Claimed>,
    pub faults: &'a mut Vec<Fault>,
}

/// The fields of a shape: those it needs, and those it may have.
fn fields_of(shape: ShapeName) -> (&'static [&'static str], &'static [&'static str]) {
    match shape {
        ShapeName::Fixed => (&[], &["center", "angle", "velocity", "spin"]),
        ShapeName::Particle => (&["mass"], &["center", "velocity"]),
        ShapeName::Rod => (&["mass", "length"], RIGID),
        ShapeName::Disk | ShapeName::Ring | ShapeName::Sphere => (&["mass", "radius"], RIGID),
        ShapeName::Rectangle => (&["mass", "width", "height"], RIGID),
        ShapeName::Body => (&["mass"], RIGID),
        // A center that is given is refused where centers are found, with its own hint.
        ShapeName::Composite => (&["parts"], &["center", "angle", "velocity", "spin"]),
    }
}

const RIGID: &[&str] = &[
    "inertia",
    "radius_of_gyration",
    "center",
    "angle",
    "velocity",
    "spin",
];

impl SolidReader<'_> {
    /// Reads a body that is no composite.
    pub fn read(&mut self, body: &BodyFile) -> Option<Solid> {
        if !self.has_its_fields(body) {
            return None;
        }
        let shape = self.shape(body);
        let mass = self.mass(body);
        let own = self.own_inertia(body);
        let (shape, mass, own) = (shape?, mass?, own?);
        let inertia_given = own.is_some();
        let inertia = own.unwrap_or_else(|| uniform(&shape, &mass));
        Some(Solid {
            shape,
            mass,
            inertia,
            inertia_given,
        })
    }

    /// Reads a part of a composite.
    pub fn read_part(&mut self, part: &BodyFile) -> Option<Solid> {
        if matches!(part.shape, ShapeName::Fixed | ShapeName::Composite) {
            let message = "a part is neither fixed nor composite";
            let fault = Fault::new(part.span.opening(), message).hint("list its own parts here");
            return fault.add_to(self.faults);
        }
        let velocity = part.velocity.as_ref().map(VelocityFile::span);
        if let Some(span) = velocity.or(part.spin.as_ref().map(|spin| spin.span)) {
            let hint = "the composite has `velocity` and `spin`";
            let fault = Fault::new(span, "a part has no motion of its own").hint(hint);
            return fault.add_to(self.faults);
        }
        self.read(part)
    }

    /// A composite from its parts, by parallel axes, and its center of mass.
    pub fn join(&mut self, body: &BodyFile, parts: Vec<Body>) -> Option<(Solid, Vector)> {
        if !self.has_its_fields(body) {
            return None;
        }
        // In the order in which every formula has them.
        let mut masses: Vec<Expr> = parts.iter().map(|p| p.mass.clone()).collect();
        masses.sort();
        let mass = Expr::sum(masses);
        if mass.is_zero() {
            let fault = Fault::new(body.span.opening(), "this composite has no mass");
            let fault = fault.hint("give one of its parts a mass");
            return fault.add_to(self.faults);
        }
        let (mass, weights) = weights(&parts, mass);
        let center = [0, 1]
            .map(|axis| Expr::sum(parts.iter().zip(&weights).map(|(p, w)| w * &p.center[axis])));
        let inertia = Expr::sum(parts.iter().map(|p| {
            let r = minus(&p.center, &center);
            &p.inertia + &(&p.mass * &dot(&r, &r))
        }));
        let solid = Solid {
            shape: Shape::Composite { parts },
            mass,
            inertia,
            inertia_given: false,
        };
        Some((solid, center))
    }

    /// Whether the body has the fields of its shape and no others.
    fn has_its_fields(&mut self, body: &BodyFile) -> bool {
        let formula = |f: &Option<Formula>| f.as_ref().map(|f| f.span);
        let given = [
            ("mass", formula(&body.mass)),
            ("length", formula(&body.length)),
            ("radius", formula(&body.radius)),
            ("width", formula(&body.width)),
            ("height", formula(&body.height)),
            ("inertia", formula(&body.inertia)),
            ("radius_of_gyration", formula(&body.radius_of_gyration)),
            ("parts", body.parts.as_ref().map(|_| body.span.opening())),
            ("center", body.center.as_ref().map(PositionFile::span)),
            ("angle", formula(&body.angle)),
            ("velocity", body.velocity.as_ref().map(VelocityFile::span)),
            ("spin", formula(&body.spin)),
        ];
        let (needed, allowed) = fields_of(body.shape);
        let shape = article(body.shape);
        let before = self.faults.len();
        let mut complete = true;
        let is_sound = is_sound(body.span, self.faults);
        for (name, span) in given {
            match span {
                Some(span) if !needed.contains(&name) && !allowed.contains(&name) => {
                    let all = [needed, allowed].concat().join(", ");
                    let fault = Fault::new(span, format!("{shape} has no `{name}`"));
                    self.faults
                        .push(fault.hint(format!("its fields are {all}")));
                }
                None if needed.contains(&name) => {
                    complete = false;
                    if !is_sound {
                        continue;
                    }
                    let message = format!("{shape} needs `{name}`");
                    self.faults.push(Fault::new(body.span.opening(), message));
                }
                _ => {}
            }
        }
        match (&body.inertia, &body.radius_of_gyration) {
            (Some(_), Some(k)) => {
                let message = "`inertia` and `radius_of_gyration` both say how the mass is spread";
                let hint = "keep one: inertia = mass × radius_of_gyration²";
                self.faults.push(Fault::new(k.span, message).hint(hint));
            }
            (None, None) if body.shape == ShapeName::Body && is_sound => {
                let message = "a body needs `inertia` or `radius_of_gyration`";
                let fault = Fault::new(body.span.opening(), message);
                self.faults.push(fault.hint(Quantity::INERTIA.hint()));
            }
            _ => {}
        }
        complete && self.faults.len() == before
    }

    fn mass(&mut self, body: &BodyFile) -> Option<Expr> {
        let Some(formula) = &body.mass else {
            return Some(Expr::zero());
        };
        let mass = self.symbols.read(formula, Quantity::MASS, self.faults)?;
        let links = [ShapeName::Rod, ShapeName::Body, ShapeName::Disk];
        let is_link = links.contains(&body.shape);
        if mass.is_zero() && !is_link {
            let shape = article(body.shape);
            let message = format!("{shape} without mass has no motion of its own");
            let hint = "only a rod or a body may have mass \"0\", a massless link, and a disk, a light pulley";
            let fault = Fault::new(formula.span, message).hint(hint);
            return fault.add_to(self.faults);
        }
        self.claim_size(formula, &mass, "mass", is_link);
        Some(mass)
    }

    fn claim_size(&mut self, formula: &Formula, size: &Expr, what: &'static str, may_vanish: bool) {
        let claim = Claim::Size {
            size: size.clone(),
            what,
            may_vanish,
        };
        let span = formula.span;
        self.claims.push(Claimed { span, claim });
    }

    /// A length that belongs to the shape; present, as the fields have been checked.
    fn length(&mut self, formula: &Option<Formula>, what: &'static str) -> Option<Expr> {
        let formula = formula.as_ref()?;
        let length = self.symbols.read(formula, Quantity::LENGTH, self.faults)?;
        self.claim_size(formula, &length, what, false);
        Some(length)
    }

    fn shape(&mut self, body: &BodyFile) -> Option<Shape> {
        Some(match body.shape {
            ShapeName::Fixed => Shape::Fixed,
            ShapeName::Particle => Shape::Particle,
            ShapeName::Rod => Shape::Rod {
                length: self.length(&body.length, "length")?,
            },
            ShapeName::Disk | ShapeName::Ring | ShapeName::Sphere => {
                let radius = self.length(&body.radius, "radius")?;
                match body.shape {
                    ShapeName::Disk => Shape::Disk { radius },
                    ShapeName::Ring => Shape::Ring { radius },
                    _ => Shape::Sphere { radius },
                }
            }
            ShapeName::Rectangle => {
                let width = self.length(&body.width, "width");
                let height = self.length(&body.height, "height");
                Shape::Rectangle {
                    width: width?,
                    height: height?,
                }
            }
            ShapeName::Body => Shape::Other,
            ShapeName::Composite => return None,
        })
    }

    /// The inertia the file gives, if it gives one; the outer `None` if it cannot be read.
    fn own_inertia(&mut self, body: &BodyFile) -> Option<Option<Expr>> {
        if let Some(formula) = &body.inertia {
            let inertia = self.symbols.read(formula, Quantity::INERTIA, self.faults)?;
            self.claim_size(formula, &inertia, "inertia", true);
            return Some(Some(inertia));
        }
        if let Some(formula) = &body.radius_of_gyration {
            let k = self.symbols.read(formula, Quantity::LENGTH, self.faults)?;
            self.claim_size(formula, &k, "radius of gyration", true);
            let mass = body.mass.as_ref()?;
            let mass = self.symbols.read(mass, Quantity::MASS, &mut Vec::new())?;
            return Some(Some(mass * k.powi(2)));
        }
        Some(None)
    }
}

/// Moment of inertia of a uniform body about its center of mass.
fn uniform(shape: &Shape, mass: &Expr) -> Expr {
    let of = |numerator, denominator, square: Expr| {
        Expr::product([Expr::ratio(numerator, denominator), mass.clone(), square])
    };
    match shape {
        Shape::Rod { length } => of(1, 12, length.powi(2)),
        Shape::Disk { radius } => of(1, 2, radius.powi(2)),
        Shape::Ring { radius } => of(1, 1, radius.powi(2)),
        Shape::Sphere { radius } => of(2, 5, radius.powi(2)),
        Shape::Rectangle { width, height } => of(1, 12, width.powi(2) + height.powi(2)),
        Shape::Fixed | Shape::Particle | Shape::Other | Shape::Composite { .. } => Expr::zero(),
    }
}

/// Total mass, and the share of each part in it. Masses that are multiples of one, such as m and 3 m, have plain
/// numbers as shares, and 4 m as sum.
fn weights(parts: &[Body], total: Expr) -> (Expr, Vec<Expr>) {
    let split: Vec<(Rational, Expr)> = parts.iter().map(|p| p.mass.split_number()).collect();
    let mut with_mass = split.iter().filter(|(k, _)| !k.is_zero());
    let unit = with_mass.next();
    let unit = unit.map_or_else(Expr::one, |(_, unit)| unit.clone());
    let sum = split.iter().fold(Rational::zero(), |sum, (k, _)| sum + k);
    if with_mass.all(|(_, rest)| *rest == unit) && !sum.is_zero() {
        let weights = split.iter().map(|(k, _)| Expr::from(k / &sum)).collect();
        return (Expr::from(sum) * unit, weights);
    }
    let weights = parts.iter().map(|p| &p.mass / &total).collect();
    (total, weights)
}

/// The shape with its article.
fn article(shape: ShapeName) -> &'static str {
    match shape {
        ShapeName::Fixed => "a fixed body",
        ShapeName::Particle => "a particle",
        ShapeName::Rod => "a rod",
        ShapeName::Disk => "a disk",
        ShapeName::Ring => "a ring",
        ShapeName::Sphere => "a sphere",
        ShapeName::Rectangle => "a rectangle",
        ShapeName::Body => "a body",
        ShapeName::Composite => "a composite",
    }
}
