//! Light inextensible strings from a body on a line over pulleys: all ends move along lines of their own at one speed.
//!
//! A string does not slip on its pulleys, which turn as it moves: with the body at the speed v a pulley of radius R has
//! |ω| = v/R. It pulls and never pushes.

use super::supposed::Supposed;
use super::tidied;
use crate::answer::calc::{Seen, is_zero, sign};
use crate::expr::{Expr, Vector, cross, dot, minus};
use crate::scene::{Slide, Stage, Strung};
use crate::story::{Balance, Refused, State, Step};

/// A string, with what moves at its other end.
pub(super) struct Pulled<'a> {
    pub string: &'a Strung,
    /// Mass of the other end as it counts where the body is: its energy there is half of this times the body's speed squared
    /// \[kg\].
    pub mass: Expr,
    /// Moments of inertia of the pulleys by the squares of their radii \[kg\].
    pub turning: Expr,
    /// Weight of the other end along its direction, by its share of the body's way \[N\].
    pub pull: Expr,
    /// Friction of the other end along its direction in the same way \[N\], not positive.
    pub friction: Expr,
    /// Spins of the pulleys where the speed is 1 \[1/m\], in the order of the string, the movable one last.
    pub spins: Vec<Expr>,
    /// Whether the other end moves away from the pulleys and draws the body.
    pub draws: bool,
    /// How far the body may go until an end that nears its pulley is beside it \[m\], and the two.
    pub room: (Expr, [usize; 2]),
}

/// What the strings of a motion along a line move.
pub(super) fn pulled<'a>(
    stage: &'a Stage,
    before: &State,
    slide: &'a Slide,
) -> Result<Vec<Pulled<'a>>, Refused> {
    let strings = slide.strings.iter();
    strings.map(|s| one(stage, before, slide, s)).collect()
}

fn one<'a>(
    stage: &'a Stage,
    before: &State,
    slide: &Slide,
    string: &'a Strung,
) -> Result<Pulled<'a>, Refused> {
    let scene = &stage.scene;
    let all = string.hung().map(|b| scene.bodies[b].mass.clone());
    let mass = tidied(stage, &Expr::sum(all))?;
    let zero = Expr::zero();
    let weight = &mass * slide.gravity.as_ref().unwrap_or(&zero);
    let friction = match &string.friction {
        None => Expr::zero(),
        Some(mu) => {
            let level = &string.along[0];
            let across = match sign(level, &scene.domains) {
                Seen::Proved(s) if s.is_not_negative() => level.clone(),
                Seen::Proved(_) => -level,
                _ => {
                    let why = format!(
                        "whether the line of `{}` leads to the right or to the left is not decided, and so is which side the surface is on",
                        scene.bodies[string.to[0]].name
                    );
                    let hint = "say it by the domain of an angle, or by `relations`";
                    return Err(Refused::new(&stage.name, why, hint));
                }
            };
            -(mu * &(&weight * &across))
        }
    };
    let (first, last) = (string.over[0], string.over[string.over.len() - 1]);
    let head = (&before.center[slide.body], &slide.along, slide.body);
    let mut spins = vec![spin(stage, before, first, head)?];
    let loops = string
        .under
        .map(|p| looped(stage, before, string, p, &spins[0]));
    let loops = loops.transpose()?;
    let hung = string.under.unwrap_or(string.to[0]);
    let (from, along) = match &loops {
        Some(looped) => (&looped.from, &looped.along),
        None => (&before.center[hung], &string.along),
    };
    let tail = (from, along, hung);
    let there = spin(stage, before, last, tail)?;
    if string.over.len() > 1 {
        spins.push(there);
    } else if is_zero(&(&spins[0] - &there), &scene.domains) != Some(true) {
        let why = format!(
            "the two parts of the string would turn `{}` opposite ways",
            scene.bodies[first].name
        );
        let hint = "one end moves towards the pulley and the other away from it";
        return Err(Refused::new(&stage.name, why, hint));
    }
    let [to_first, to_last] = [(first, head), (last, tail)].map(|(p, end)| ahead(before, p, end));
    let nears = approaches(stage, &to_first, [head.2, first])?;
    let draws = !approaches(stage, &to_last, [tail.2, last])?;
    if nears != draws {
        let how = if nears { "slack" } else { "longer" };
        let why = format!(
            "the string from `{}` to `{}` would get {how}",
            scene.bodies[head.2].name, scene.bodies[tail.2].name
        );
        let hint = "one end moves towards the pulley and the other away from it";
        return Err(Refused::new(&stage.name, why, hint));
    }
    let pulleys = string.over.iter().zip(&spins);
    let turning = pulleys.map(|(p, k)| &scene.bodies[*p].inertia * &k.powi(2));
    let turning = tidied(stage, &Expr::sum(turning))?;
    let mut mass = &mass * &string.ratio().powi(2);
    if let (Some(looped), Some(pulley)) = (loops, string.under) {
        mass = &mass + &(&scene.bodies[pulley].inertia * &looped.spin.powi(2));
        spins.push(looped.spin);
    }
    Ok(Pulled {
        string,
        turning,
        pull: tidied(stage, &-(&weight * &string.along[1]))?,
        friction: tidied(stage, &friction)?,
        mass: tidied(stage, &mass)?,
        spins,
        draws,
        room: match draws {
            true => (to_first, [head.2, first]),
            false => (&to_last / &string.ratio(), [hung, last]),
        },
    })
}

/// The part of a string that leads down to a movable pulley.
struct Looped {
    /// Where it meets the rim of that pulley.
    from: Vector,
    /// Direction in which it moves, at the speed of the body.
    along: Vector,
    /// Spin of that pulley where the body has the speed 1 \[1/m\].
    spin: Expr,
}

/// The loop of a string around a movable pulley: down along its rim on one side, and on the other up to where it is fastened.
/// There the rim is at rest, so that the center has half the speed of the string.
fn looped(
    stage: &Stage,
    before: &State,
    string: &Strung,
    pulley: usize,
    first_spin: &Expr,
) -> Result<Looped, Refused> {
    let scene = &stage.scene;
    let zero = Expr::zero();
    let radius = scene.bodies[pulley].shape.radius().unwrap_or(&zero);
    let along = [0, 1].map(|k| &string.along[k] / &string.ratio());
    let last = string.over[string.over.len() - 1];
    for side in [1, -1] {
        let reach = &Expr::from(side) * radius;
        let rim = [-&(&reach * &along[1]), &reach * &along[0]];
        let from = [0, 1].map(|k| &before.center[pulley][k] + &rim[k]);
        let Ok(spin) = spin(stage, before, last, (&from, &along, pulley)) else {
            continue;
        };
        // Over one pulley only the side counts on which the string comes off it.
        let fits =
            string.over.len() > 1 || is_zero(&(&spin - first_spin), &scene.domains) == Some(true);
        if fits {
            let spin = tidied(stage, &-(&string.ratio() / &reach))?;
            return Ok(Looped { from, along, spin });
        }
    }
    let [last, under] = [last, pulley].map(|b| &scene.bodies[b].name);
    let why =
        format!("the string does not run straight from the rim of `{last}` to that of `{under}`");
    let hint = "the center of a movable pulley is one radius beside the line on which the string leaves the pulley before it";
    Err(Refused::new(&stage.name, why, hint))
}

/// Spin of a pulley where a body that hangs on its rim moves with the speed 1.
fn spin(
    stage: &Stage,
    before: &State,
    pulley: usize,
    (center, along, body): (&Vector, &Vector, usize),
) -> Result<Expr, Refused> {
    let scene = &stage.scene;
    let arm = tidied(stage, &cross(&minus(center, &before.center[pulley]), along))?;
    let zero = Expr::zero();
    let radius = scene.bodies[pulley].shape.radius().unwrap_or(&zero);
    let square = radius.powi(2);
    if is_zero(&(&arm.powi(2) - &square), &scene.domains) != Some(true) {
        let why = format!(
            "the line along which `{}` moves does not touch the rim of `{}`",
            scene.bodies[body].name, scene.bodies[pulley].name
        );
        let hint = "the string leaves the pulley along that line, one radius from its center";
        return Err(Refused::new(&stage.name, why, hint));
    }
    tidied(stage, &(&arm / &square))
}

/// How far a body has to go along its line until it is beside a pulley \[m\]; negative where it moves away.
fn ahead(before: &State, pulley: usize, (center, along, _): (&Vector, &Vector, usize)) -> Expr {
    dot(&minus(&before.center[pulley], center), along)
}

/// Whether a body with this way to go moves towards a pulley.
fn approaches(stage: &Stage, ahead: &Expr, [body, pulley]: [usize; 2]) -> Result<bool, Refused> {
    let side = sign(ahead, &stage.scene.domains).side();
    side.ok_or_else(|| {
        Refused::new(
            &stage.name,
            format!(
                "whether `{}` moves towards `{}` or away from it is not decided",
                stage.scene.bodies[body].name, stage.scene.bodies[pulley].name
            ),
            "say it by `relations`",
        )
    })
}

impl Pulled<'_> {
    /// What must be ≥ 0 so that the string stays taut at this acceleration: its tensions at the other end and, where its
    /// pulleys have inertia, at the body \[N\].
    fn tensions(&self, acceleration: &Expr) -> Vec<Expr> {
        let way = Expr::from(if self.draws { 1 } else { -1 });
        let net = &(&self.pull + &self.friction) - &(&self.mass * acceleration);
        let end = &way * &net;
        if self.turning.is_zero() {
            return vec![end];
        }
        let body = &end - &(&way * &(&self.turning * acceleration));
        vec![end, body]
    }

    /// The tensions as steps of a solution.
    pub(super) fn steps(&self, stage: &Stage, acceleration: &Expr) -> Result<Vec<Step>, Refused> {
        let why = [
            match self.string.under {
                Some(pulley) if stage.scene.bodies[pulley].inertia.is_zero() => {
                    "the pull of the string, of which two parts carry what hangs on the movable pulley"
                }
                Some(_) => {
                    "the pull of the string on the moving side of the movable pulley, by moments about where the fastened side leaves it"
                }
                None => {
                    "the pull of the string beyond the pulleys, from the forces on what it moves there"
                }
            },
            "its pull on the other side, from the moment that turns the pulleys",
        ];
        let letters = ["T", "S"];
        // A movable pulley hangs on two parts of the string, and moves half as fast.
        let parts = Expr::one() / self.string.ratio();
        let way = Expr::from(if self.draws { 1 } else { -1 });
        let hung = Balance {
            inertia: tidied(stage, &(&self.mass * &parts))?,
            force: tidied(stage, &((&self.pull + &self.friction) * &parts))?,
            pulls: vec![("T", -(&way * parts))],
        };
        let pulleys = Balance {
            inertia: self.turning.clone(),
            force: Expr::zero(),
            pulls: vec![("T", way.clone()), ("S", -way)],
        };
        let tensions = self.tensions(acceleration).into_iter();
        let each = letters.into_iter().zip(why).zip([hung, pulleys]);
        each.zip(tensions)
            .map(|(((letter, why), balance), raw)| {
                Ok(Step {
                    balance: Some(balance),
                    ..Step::new(letter, &raw, &tidied(stage, &raw)?, why)
                })
            })
            .collect()
    }

    /// Supposes what it takes that no end gets beside its pulley on a way of this length; refused where one does.
    pub(super) fn keeps_off(
        &self,
        stage: &Stage,
        way: &Expr,
        supposed: &mut Supposed<'_>,
    ) -> Result<(), Refused> {
        let (ahead, pair) = &self.room;
        let [body, pulley] = pair.map(|b| &stage.scene.bodies[b].name);
        let left = tidied(stage, &(ahead - way))?;
        let stays = format!("`{body}` does not get to `{pulley}`");
        supposed.not_negative(&left, stays, || {
            let why = format!("`{body}` gets to `{pulley}` before the stage ends");
            let hint = "end the stage earlier, or let the string be longer";
            Refused::new(&stage.name, why, hint)
        })
    }

    /// The tensions: at the other end first, at the body last. Supposes what the string needs so that it stays taut; refused where
    /// it goes slack.
    pub(super) fn taut(
        &self,
        stage: &Stage,
        acceleration: &Expr,
        supposed: &mut Supposed<'_>,
    ) -> Result<Vec<Expr>, Refused> {
        let name = &stage.scene.bodies[self.string.to[0]].name;
        let mut all = Vec::new();
        for tension in self.tensions(acceleration) {
            let tension = tidied(stage, &tension)?;
            let taut = format!("the string to `{name}` stays taut");
            supposed.not_negative(&tension, taut, || {
                let why =
                    format!("the string to `{name}` goes slack, and this motion takes it as taut");
                let hint = "let the bodies move each on its own";
                Refused::new(&stage.name, why, hint)
            })?;
            all.push(tension);
        }
        Ok(all)
    }
}
