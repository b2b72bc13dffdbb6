//! Motion of a body along a straight line under constant forces: on a smooth guide, on a rough surface, or rolling.
//!
//! The acceleration is constant, so that v² − v₀² = 2 a s and v − v₀ = a t. A round body on a rough surface slips by
//! v + R ω at its lowest point, counted along a line to the right; friction acts against the slip until there is none.
//!
//! What the body has to do at the beginning is in `begins`, the forces and the acceleration in `line`, the way to the end in
//! `course`.

mod begins;
mod carried;
mod course;
mod line;

use super::supposed::Supposed;
use super::{half, meanwhile, tidied};
use crate::algebra::Sign;
use crate::answer::calc::{Seen, is_zero, sign};
use crate::expr::{Expr, Vector};
use crate::formula::{listed, sentence};
use crate::scene::{Scene, Shape, Slide, SlideEnd, Stage};
use crate::story::{Refused, StageTold, State};
use line::Course;
use line::Line;

/// Motion along a line; `is_driven` where its acceleration or the pull of a string is asked.
pub(in crate::story) fn slide(
    stage: &Stage,
    before: State,
    slide: &Slide,
    is_driven: bool,
) -> Result<StageTold, Refused> {
    let mut supposed = Supposed::of(stage);
    let before = begins::bent(stage, before, slide, &mut supposed)?;
    if let Some(below) = &slide.on {
        return carried::carried(stage, before, (slide, below), supposed);
    }
    let mut limits = Vec::new();
    begins::fits(stage, &before, slide)?;
    begins::springy(stage, slide)?;
    let line = Line::of(stage, &before, slide, &mut limits)?;
    let is_steady = slide.spring.is_none() && line.is_steady();
    let moves = is_steady && matches!(slide.until, SlideEnd::Distance(_));
    begins::forward(stage, slide, ("speed", &line.speed, moves), &mut supposed)?;
    if let SlideEnd::Distance(distance) = &slide.until {
        begins::forward(stage, slide, ("distance", distance, false), &mut supposed)?;
    }
    // On a spring neither the force nor the acceleration stays as it is.
    let swings = slide.spring.is_some() && matches!(slide.until, SlideEnd::Time(_));
    let mut steps = match swings {
        true => Vec::new(),
        false => line.steps(),
    };
    let course = line.course(&mut steps, &mut supposed, &mut limits)?;
    let by_newton = !matches!(slide.until, SlideEnd::Distance(_));
    if slide.spring.is_none() && (by_newton || line.round.is_some() || is_driven) {
        line.told(&course, &mut steps);
    } else if !swings {
        steps.clear();
    }
    line.held(&limits, &mut supposed)?;
    stands(stage, &before, slide, &mut supposed)?;
    line.fastened(&course, &mut supposed)?;
    begins::rims(&line, &before)?;
    if let ([string], true) = (line.strings.as_slice(), is_driven) {
        steps.extend(string.steps(stage, &line.acceleration)?);
    }
    for string in &line.strings {
        string.keeps_off(stage, &course.distance, &mut supposed)?;
    }
    let tensions = line.tensions(&mut supposed)?;
    let mut after = line.moved(&before, &course)?;
    supposed.words.extend(meanwhile::others(
        stage,
        &before,
        &mut after,
        course.time.as_ref(),
    ));
    let mut out = StageTold::new(stage, before, after);
    out.kept = vec![line.energy_kept()];
    out.energy = Some([
        line.energy(&line.speed, &line.spin)?,
        line.energy(&course.speed, &course.spin)?,
    ]);
    out.work = line.work(&course);
    out.time = course.time;
    out.steps = steps;
    out.acceleration = (slide.spring.is_none()).then(|| line.acceleration.clone());
    let spring = slide.spring.as_ref();
    out.on_spring = spring
        .map(|spring| line.on_spring(spring, &course.distance))
        .transpose()?;
    out.way = Some(course.distance);
    out.tensions = tensions;
    if let SlideEnd::Distance(_) = &slide.until {
        let square = line.tidied(&course.speed.powi(2))?;
        supposed.needs.push(square);
    }
    supposed.told(&mut out);
    Ok(out)
}

/// The force of the surface on the bodies that move along it with this acceleration, where neither string nor spring pulls them.
/// What carries the weight on a level surface lies across the plane.
pub(in crate::story) fn support(scene: &Scene, slide: &Slide, acceleration: &Expr) -> Vector {
    let company = slide.company().into_iter();
    let mass = Expr::sum(company.map(|b| scene.bodies[b].mass.clone()));
    let force = slide.force.clone().unwrap_or_else(Expr::zero);
    let along = &(&mass * acceleration) - &force;
    let weight = slide.gravity.as_ref().filter(|_| !slide.level);
    let up = weight.map_or_else(Expr::zero, |g| &mass * g);
    let [x, y] = &slide.along;
    [&along * x, &(&along * y) + &up]
}

/// Supposes that friction at its base does not tip a box over: to balance the moment μ N H of the friction, the force N that
/// presses the box on the surface moves by μ H towards the front edge, H being the height of its center, and has to stay under
/// the box.
fn stands(
    stage: &Stage,
    before: &State,
    slide: &Slide,
    supposed: &mut Supposed<'_>,
) -> Result<(), Refused> {
    let body = &stage.scene.bodies[slide.body];
    let is_box = matches!(body.shape, Shape::Rectangle { .. });
    let Some(mu) = (slide.friction.as_ref())
        .filter(|_| is_box && !slide.level && slide.gravity.is_some() && slide.with.is_empty())
    else {
        return Ok(());
    };
    let Some([long, high]) = extents(stage, before, slide.body, &slide.along)? else {
        return Ok(());
    };
    let room = tidied(stage, &(&long - &(mu * &high)))?;
    supposed.not_negative(&room, format!("`{}` does not tip over", body.name), || {
        let hint = "let it turn about its front edge instead";
        Refused::new(&stage.name, format!("`{}` tips over", body.name), hint)
    })
}

/// How long a box or a rod is along a line, and how high across it; nothing where no side of it is known to lie along the line.
fn extents(
    stage: &Stage,
    before: &State,
    body: usize,
    along: &Vector,
) -> Result<Option<[Expr; 2]>, Refused> {
    let turn = &before.angle[body];
    if before.why_open([turn]).is_some() {
        return Ok(None);
    }
    let axis = tidied(
        stage,
        &(&(turn.cos() * &along[0]) + &(turn.sin() * &along[1])),
    )?;
    let is_along = is_zero(&(axis.powi(2) - Expr::one()), &stage.scene.domains) == Some(true);
    Ok(match &stage.scene.bodies[body].shape {
        Shape::Rectangle { width, height } if is_along => Some([width.clone(), height.clone()]),
        Shape::Rectangle { width, height } if axis.is_zero() => {
            Some([height.clone(), width.clone()])
        }
        Shape::Rod { length } if is_along => Some([length.clone(), Expr::zero()]),
        _ => None,
    })
}

/// The bodies that move along one line each, with their directions.
fn lumps(slide: &Slide) -> Vec<(Vec<usize>, &Vector)> {
    let strung = slide.strings.iter().map(|s| (s.hung().collect(), &s.along));
    let own = (slide.company(), &slide.along);
    std::iter::once(own).chain(strung).collect()
}

impl Line<'_> {
    /// Supposes what keeps the motion going on as it begins; refused where that cannot be.
    fn held(&self, limits: &[Expr], supposed: &mut Supposed<'_>) -> Result<(), Refused> {
        let (name, rolls) = (self.name(), !self.slips());
        let (does, why, hint) = match (&self.round, rolls) {
            (Some(_), true) => (
                "does not slip",
                "it slips",
                "the surface is too smooth for it to roll",
            ),
            (Some(_), false) => (
                "slips to the end of the stage",
                "it rolls before the stage ends",
                "end the stage with \"until\": \"rolls\", and let it roll in the next one",
            ),
            (None, _) => (
                "does not stop before",
                "it stops before the stage ends",
                "end the stage with \"until\": \"stops\"",
            ),
        };
        for limit in limits {
            supposed.not_negative(limit, format!("`{name}` {does}"), || {
                self.refused(why, hint)
            })?;
        }
        Ok(())
    }

    /// Tells that a spring which pushes the body on is fastened to it, and what moves with it as well, where that goes farther
    /// than the spring is pressed.
    fn fastened(&self, course: &Course, supposed: &mut Supposed<'_>) -> Result<(), Refused> {
        let Some(spring) = &self.slide.spring else {
            return Ok(());
        };
        let beyond = self.tidied(&(&course.distance - &spring.relaxed))?;
        let may_be = |e: &Expr| match sign(e, self.domains()) {
            Seen::Proved(sign) => matches!(sign, Sign::Positive | Sign::NotNegative),
            seen => !matches!(seen, Seen::Negative),
        };
        if may_be(&spring.relaxed) && may_be(&beyond) {
            supposed.words.push(sentence!(
                "the spring is fastened to `{}`, and holds it back beyond the first {}",
                self.name(),
                &spring.relaxed
            ));
            let riders = self.slide.with.iter();
            let riders: Vec<String> = riders
                .map(|b| format!("`{}`", self.stage.scene.bodies[*b].name))
                .collect();
            if !riders.is_empty() {
                let is = if riders.len() == 1 { "is" } else { "are" };
                let words = format!("{} {is} fastened to `{}` too", listed(&riders), self.name());
                supposed.words.push(words.into());
            }
        }
        Ok(())
    }

    /// The pull of the strings on each body.
    fn tensions(&self, supposed: &mut Supposed<'_>) -> Result<Vec<(usize, Expr)>, Refused> {
        let mut tensions = Vec::new();
        for string in &self.strings {
            let pulls = string.taut(self.stage, &self.acceleration, supposed)?;
            let own = self.slide.company().into_iter().map(|b| (b, pulls.last()));
            // Of several strings at one body none is meant more than another.
            let own = own.filter(|_| self.strings.len() == 1);
            let others = string.string.to.iter().map(|b| (*b, pulls.first()));
            tensions.extend(
                own.chain(others)
                    .filter_map(|(b, pull)| Some((b, pull?.clone()))),
            );
        }
        Ok(tensions)
    }

    /// Where all that moves is at the end, and how it moves.
    fn moved(&self, before: &State, course: &Course) -> Result<State, Refused> {
        let mut after = before.clone();
        for (bodies, along) in lumps(self.slide) {
            for (b, k) in bodies.iter().flat_map(|b| [(*b, 0), (*b, 1)]) {
                after.center[b][k] = &after.center[b][k] + &(&along[k] * &course.distance);
                after.velocity[b][k] = self.tidied(&(&course.speed * &along[k]))?;
            }
        }
        for (pulley, spin) in self.pulleys() {
            after.spin[pulley] = self.tidied(&(spin * &course.speed))?;
            let turned = &before.angle[pulley] + &(spin * &course.distance);
            after.angle[pulley] = self.tidied(&turned)?;
        }
        if let Some(round) = &self.round {
            let b = self.slide.body;
            after.spin[b] = course.spin.clone();
            after.angle[b] = match &course.time {
                _ if self.slide.spring.is_some() => {
                    let turned = &course.distance / &round.arm;
                    self.tidied(&(&before.angle[b] - &turned))?
                }
                Some(t) => {
                    let turned = half(&(&(&self.spin + &course.spin) * t));
                    self.tidied(&(&before.angle[b] + &turned))?
                }
                None => before.angle[b].clone(),
            };
        }
        Ok(after)
    }
}
