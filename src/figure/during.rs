//! Free-body diagrams during the collision: impulses only, and what is left out.
//!
//! In: a scene on stage, the bodies of the system, the impulses as numbers where the equations fix them. Out: a sheet
//! and notes. Which forces have no impulse is the scene's statement; this module only repeats it.

use super::label::{Label, Level};
use super::marks::{centers, names};
use super::place::Spot;
use super::plane::{Pair, ahead, apart, dot, minus, opposite, size, unit};
use super::pose::Look;
use super::quantity::{magnitude, vector_name};
use super::sheet::{Ink, SIZE, Sheet, arrow_length};
use super::stage::{DOT, Moment, Stage};
use crate::expr::Vector;
use crate::numeric::Motion;
use crate::numeric::system::Unknown;
use crate::scene::{Ask, BlowImpulse, ContactLaw, ImpulseAt};

/// The free body (or system) during the collision, with impulses only.
pub fn during(
    stage: &Stage,
    system: &[usize],
    motion: Option<&Motion<f64>>,
) -> (Sheet, Vec<String>) {
    let mut sheet = Sheet::default();
    for i in system {
        let aside = stage.aside(*i, Moment::During, &[]);
        let aside = if system.len() > 1 { aside } else { [0.0, 0.0] };
        stage.body(&mut sheet, &stage.poses[*i], aside);
    }
    stage.hinges(&mut sheet, &|bodies| {
        bodies.iter().any(|b| system.contains(b))
    });
    centers(stage, &mut sheet, system);
    let pushes = impulses(stage, system, motion);
    let most = pushes.iter().map(|p| size(p.vector)).fold(0.0, f64::max);
    let mut notes = Vec::new();
    for push in &pushes {
        if size(push.vector) <= 1e-9 * most || most == 0.0 {
            notes.push(format!(
                "{} is zero at these values.",
                push.label.text().trim_start_matches('−')
            ));
            continue;
        }
        let taken = pushes.iter().any(|other| other.comes_where(push, stage));
        let length = arrow_length(size(push.vector), most);
        push.draw(stage, &mut sheet, length, taken);
    }
    if pushes.is_empty() {
        let what = if system.len() > 1 { "the system" } else { "it" };
        notes.push(format!("No impulse from outside acts on {what}."));
    }
    notes.extend(left_out(stage, system));
    names(stage, &mut sheet, system, false);
    sheet.settle();
    (sheet, notes)
}

/// Finite forces on the bodies, and why they are not drawn.
fn left_out(stage: &Stage, system: &[usize]) -> Option<String> {
    let mut names: Vec<&str> = Vec::new();
    for force in stage
        .scene
        .forces
        .iter()
        .filter(|f| system.contains(&f.body))
    {
        if !names.contains(&force.name.as_str()) {
            names.push(&force.name);
        }
    }
    (!names.is_empty()).then(|| {
        let (it, s) = if names.len() == 1 {
            ("is", "")
        } else {
            ("are", "s")
        };
        format!(
            "Left out: {}, which {it} finite and ha{} no impulse in so short a time.",
            names.join(", "),
            if s.is_empty() { "s" } else { "ve" }
        )
    })
}

/// An impulse on a body of a system.
pub(super) struct Push {
    at: Pair,
    vector: Pair,
    label: Label,
    body: usize,
    presses: bool,
    /// Whether it comes from outside the scene.
    pub(super) is_blow: bool,
}

impl Push {
    /// Whether this one comes up to a body at the place where another goes away from it.
    fn comes_where(&self, other: &Push, stage: &Stage) -> bool {
        let is_there = apart(stage.px(self.at), stage.px(other.at)) < 1.0;
        let [own, its] = [self, other].map(|push| unit(push.vector));
        self.presses && !other.presses && is_there && dot(own, its) < -0.9
    }

    /// Draws the arrow: up to the body where it pushes or the other way is `taken`, else away from it.
    pub(super) fn draw(&self, stage: &Stage, sheet: &mut Sheet, length: f64, taken: bool) {
        if size(self.vector) < 1e-300 {
            return;
        }
        let at = stage.px(self.at);
        let center = stage.px(stage.poses[self.body].center);
        let inward = minus(center, at);
        let d = unit(self.vector);
        // What presses on a body acts on its outline.
        let pose = &stage.poses[self.body];
        let solid = matches!(
            pose.look,
            Look::Plate(..) | Look::Blob(_) | Look::Round { .. }
        );
        let deep = stage.long(pose.reach(self.at, opposite(d)));
        // On the outline and away from the body it pulls, as a cord does.
        let beyond = stage.long(pose.reach(self.at, d));
        let presses = self.presses && !(deep > 1.0 && beyond < 1.0);
        let at = match solid && presses {
            true => ahead(at, d, -deep),
            false => at,
        };
        let moved = solid && presses && (self.is_blow || deep > 1.0);
        let pushing = moved || dot(d, inward) > 0.25 * size(inward) && size(inward) > 1.0;
        let free = if stage.scene.bodies[self.body].is_particle() {
            DOT + 2.0
        } else {
            2.0
        };
        let (from, to) = if taken || pushing || (size(inward) <= 1.0 && presses) {
            (ahead(at, d, -(length + free)), ahead(at, d, -free))
        } else {
            (at, ahead(at, d, length))
        };
        sheet.arrow(from, to, Ink::Impulse, 2.2);
        sheet.wish(self.label.clone(), SIZE, Spot::Along { from, to });
    }
}

/// Where an impulse passes from one body to another.
struct Joint<'s> {
    from: ImpulseAt,
    /// The bodies, the second one the impulse is counted on; `None` for what does not move or is outside.
    bodies: [Option<usize>; 2],
    at: &'s Vector,
    /// The impulse, where the equations fix it.
    known: Option<Pair>,
    /// The direction it is known to have.
    along: Option<Pair>,
    /// Whether it presses on an outline.
    presses: bool,
    name: &'s str,
}

/// The impulses on a system of bodies, from outside of it.
pub(super) fn impulses(stage: &Stage, system: &[usize], motion: Option<&Motion<f64>>) -> Vec<Push> {
    let joints = joints(stage, motion).into_iter();
    joints
        .flat_map(|joint| joint.pushes(stage, system))
        .collect()
}

impl Joint<'_> {
    /// What it does to a system: nothing where it lies within, one arrow where its direction is known, else its components.
    fn pushes(&self, stage: &Stage, system: &[usize]) -> Vec<Push> {
        let scene = stage.scene;
        let [first, second] = self.bodies.map(|b| b.filter(|b| system.contains(b)));
        let (body, sign) = match (first, second) {
            (Some(body), None) => (body, -1.0),
            (None, Some(body)) => (body, 1.0),
            _ => return Vec::new(),
        };
        // A string pulls a particle where that is, not where its other end is.
        let at = match scene.bodies[body].is_particle() {
            true => &scene.bodies[body].center,
            false => self.at,
        };
        let Some(at) = stage.values.pair(at) else {
            return Vec::new();
        };
        let given = match self.from {
            // A given impulse carries its own symbol.
            ImpulseAt::Blow(i) => blow_label(stage, i),
            _ => None,
        };
        let base = match given {
            Some(label) => Named {
                label,
                on: body,
                scalar: true,
            },
            None => impulse_name(stage, self.from, self.name, self.along.is_some()),
        };
        let push = |vector: Pair, label: Label, presses: bool| Push {
            at,
            vector,
            label,
            body,
            presses,
            is_blow: matches!(self.from, ImpulseAt::Blow(_)),
        };
        if let Some(whole) = self.known.or(self.along) {
            let label = base.label(body, sign, self.along.is_some());
            return vec![push(whole.map(|c| c * sign), label, self.presses)];
        }
        let component = |(axis, index): (Pair, &str)| {
            let mut label = base.plain();
            match label.runs.iter_mut().find(|r| r.level == Level::Sub) {
                Some(run) => run.text.push_str(index),
                None => label.push(index, true, Level::Sub),
            }
            let label = if sign < 0.0 { label.negated() } else { label };
            push(axis, label, false)
        };
        [([1.0, 0.0], "x"), ([0.0, 1.0], "y")].map(component).into()
    }
}

/// Where impulses pass: contacts, hinges, blows.
fn joints<'s>(stage: &Stage<'s>, motion: Option<&Motion<f64>>) -> Vec<Joint<'s>> {
    let scene = stage.scene;
    let moving =
        |bodies: [usize; 2]| bodies.map(|b| Some(b).filter(|b| !scene.bodies[*b].is_fixed()));
    let sure = |part: fn(usize, usize) -> Unknown, i: usize, m: &Motion<f64>| {
        (0..2).all(|axis| m.determines(part(i, axis)))
    };
    let mut out = Vec::new();
    for (i, contact) in scene.contacts.iter().enumerate() {
        let frictionless = matches!(contact.law, ContactLaw::Frictionless { .. });
        let normal = contact.normal.as_ref().filter(|_| frictionless);
        let known = motion.filter(|m| match frictionless {
            true => m.determines(Unknown::ContactNormal(i)),
            false => sure(Unknown::Contact, i, m),
        });
        out.push(Joint {
            from: ImpulseAt::Contact(i),
            bodies: moving(contact.bodies),
            at: &contact.at,
            known: known.map(|m| m.contact[i]),
            along: normal.and_then(|n| stage.values.pair(n)),
            // A string pulls.
            presses: scene.figure.string(&contact.name).is_none(),
            name: &contact.name,
        });
    }
    for (i, hinge) in scene.hinges.iter().enumerate() {
        let known = motion.filter(|m| sure(Unknown::Hinge, i, m));
        out.push(Joint {
            from: ImpulseAt::Hinge(i),
            bodies: moving(hinge.bodies),
            at: &hinge.at,
            known: known.map(|m| m.hinge[i]),
            along: None,
            presses: false,
            name: &hinge.name,
        });
    }
    for (i, blow) in scene.blows.iter().enumerate() {
        let known = motion.filter(|m| m.determines(Unknown::Blow(i)));
        let (along, known) = match &blow.impulse {
            BlowImpulse::Given(v) => (None, stage.values.pair(v)),
            BlowImpulse::Along(v) => (stage.values.pair(v), known.map(|m| m.blow[i])),
        };
        out.push(Joint {
            from: ImpulseAt::Blow(i),
            bodies: [None, Some(blow.body)],
            at: &blow.at,
            known,
            along,
            presses: true,
            name: &blow.name,
        });
    }
    out
}

/// The symbol of a given impulse, where it has a short one.
fn blow_label(stage: &Stage, i: usize) -> Option<Label> {
    match &stage.scene.blows[i].impulse {
        BlowImpulse::Given(v) => magnitude(stage, v, stage.values.pair(v)?),
        BlowImpulse::Along(_) => None,
    }
}

/// What an impulse is called, and on which body it is counted.
struct Named {
    label: Label,
    on: usize,
    scalar: bool,
}

impl Named {
    fn plain(&self) -> Label {
        let mut label = self.label.clone();
        label.runs.iter_mut().for_each(|r| r.arrow = false);
        label
    }

    fn label(&self, body: usize, sign: f64, directed: bool) -> Label {
        let opposite =
            self.on != usize::MAX && self.on != body || self.on == usize::MAX && sign < 0.0;
        // A scalar along a drawn direction is the arrow's length, whichever body it acts on.
        if self.scalar || directed && !self.label.runs.iter().any(|r| r.arrow) {
            return self.plain();
        }
        if opposite {
            self.label.clone().negated()
        } else {
            self.label.clone()
        }
    }
}

fn impulse_name(stage: &Stage, from: ImpulseAt, name: &str, directed: bool) -> Named {
    let scene = stage.scene;
    // What the reader is told of comes before what carom asks itself.
    let (asked, hidden): (Vec<_>, Vec<_>) = scene.asked_of_impact().partition(|q| !q.hidden);
    for question in asked.into_iter().chain(hidden) {
        if let Ask::Impulse {
            from: asked,
            on,
            along,
        } = &question.ask
            && *asked == from
        {
            let mut label = vector_name(&question.name, question.latex.as_deref());
            if along.is_some() {
                label.runs.iter_mut().for_each(|r| r.arrow = false);
            }
            return Named {
                label,
                on: *on,
                scalar: along.is_some(),
            };
        }
    }
    let several = scene.contacts.len() + scene.hinges.len() + scene.blows.len() > 1;
    let index = if several { name } else { "" };
    let mut label = Label::vector("P", index, "");
    if directed {
        label.runs.iter_mut().for_each(|r| r.arrow = false);
    }
    Named {
        label,
        on: usize::MAX,
        scalar: directed,
    }
}
