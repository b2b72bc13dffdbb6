//! Friction at one contact, followed as it happens: Routh's path in the plane of impulses (Routh, Dynamics of a System of
//! Rigid Bodies; Wang and Mason 1992), event by event.
//!
//! In: what the contact feels of its bodies, and the law. Out: the corners of the path, the last one the end of the impact.
//! P_n grows; while the contact slips, dP_t = −μ sgn(u_t) dP_n; where slip has ended it sticks if friction can hold it. The
//! module knows no modes and no closed forms, which is why agreement with those of `laws` means something. Any ordered
//! number type will do; exact fractions make every decision exact.

use std::fmt;

use crate::expr::arithmetic::Number;
use crate::scene::{ContactSpace, Friction, Hypothesis};

/// What happens at a corner of the path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// The bodies touch.
    Start,
    /// The contact has stopped slipping.
    SlipEnds,
    /// Compression ends: the normal relative velocity is zero.
    Compressed,
    /// The impact is over.
    End,
}

/// A point of the path.
#[derive(Clone, Debug, PartialEq)]
pub struct Corner<T> {
    /// What happens there.
    pub event: Event,
    /// Impulse so far on the second body, (P_t, P_n) \[N s\].
    pub impulse: [T; 2],
    /// Relative velocity there, (u_t, u_n) [m/s].
    pub velocity: [T; 2],
}

/// The path of an impact.
#[derive(Clone, Debug, PartialEq)]
pub struct Path<T> {
    /// Its corners, from the start to the end. Laws that state the impulse outright have these two only.
    pub corners: Vec<Corner<T>>,
    /// Whether the normal velocity does not grow while the contact slips (Painlevé): it jams.
    pub jams: bool,
}

/// Why an impact has no end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoPath {
    /// The bodies separate already.
    Separating,
    /// Another contact collides at the same moment: the path of one impulse does not say which comes first.
    Strikes,
    /// Compression or restitution never ends: the contact sticks and yields no further, or it jams.
    NeverEnds,
    /// A law divides by something that vanishes here.
    Singular,
    /// The end holds a square root that this number type has not.
    Irrational,
}

impl fmt::Display for NoPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            NoPath::Separating => "the bodies separate at the contact: they do not collide",
            NoPath::Strikes => "another contact collides at the same moment",
            NoPath::NeverEnds => {
                "under this hypothesis the impact has no end: the contact sticks where it cannot move along its normal, still in compression or where e > 0 asks for a rebound (for which Poisson's hypothesis has an answer)"
            }
            NoPath::Singular => {
                "the law divides by zero: its contact does not come together, or cannot move freely in both directions"
            }
            NoPath::Irrational => {
                "the end of the impact holds a square root that is no fraction\nhint: leave out --exact"
            }
        })
    }
}

impl std::error::Error for NoPath {}

impl<T: Number> Path<T> {
    /// The end of the impact.
    pub fn end(&self) -> &Corner<T> {
        self.corners.last().expect("a path has a start")
    }

    /// Whether the contact slips just before, beyond rounding.
    pub fn slips_at_first(&self) -> bool {
        let [slip, approach] = self.corners[0].velocity.each_ref().map(Number::size);
        slip > 1e-12 * approach
    }

    /// Kinetic energy gained, ½ P·(u⁻ + u⁺) \[J\]: negative for a loss.
    pub fn gain(&self) -> T {
        let (start, end) = (&self.corners[0], self.end());
        let part = |i: usize| {
            let sum = start.velocity[i].plus(&end.velocity[i]);
            end.impulse[i].times(&sum)
        };
        part(0).plus(&part(1)).halved()
    }
}

/// Follows an impact to its end.
pub fn follow<T: Number + PartialOrd>(
    space: &ContactSpace<T>,
    law: &Friction<T>,
) -> Result<Path<T>, NoPath> {
    if space.normal > T::zero() {
        return Err(NoPath::Separating);
    }
    match &law.hypothesis {
        Hypothesis::Newton | Hypothesis::Poisson | Hypothesis::Stronge => routh(space, law),
        Hypothesis::ChatterjeeRuina { tangential } => {
            let impulse = chatterjee_ruina(space, law, tangential)?;
            Ok(at_once(space, law, impulse))
        }
        Hypothesis::Brach { ratio } => {
            let impulse = brach(space, law, ratio.as_ref())?;
            Ok(at_once(space, law, impulse))
        }
    }
}

/// What changes for each unit of normal impulse.
struct Rates<T> {
    /// dP_t/dP_n.
    friction: T,
    /// du_t/dP_n.
    tangential: T,
    /// du_n/dP_n.
    normal: T,
}

/// A difference that is nothing but the rounding of its parts is zero: of a body hinged to the ground, ac = b², and what is
/// left of c − b²/a in doubles would be taken for a way to move along the normal.
fn unless_rounding<T: Number>(difference: T, part: &T) -> T {
    let share = T::rounding();
    if share > 0.0 && difference.size() <= share * part.size() {
        return T::zero();
    }
    difference
}

fn size<T: Number + PartialOrd>(x: &T) -> T {
    if *x < T::zero() {
        x.negated()
    } else {
        x.clone()
    }
}

/// The rates at a tangential velocity. Where it is zero, the contact sticks if friction can hold it; otherwise slip begins
/// in the direction into which the normal impulse drives it.
fn rates<T: Number + PartialOrd>(
    space: &ContactSpace<T>,
    mu: &T,
    tangential: &T,
) -> Option<Rates<T>> {
    let ContactSpace { a, b, c, .. } = space;
    let friction = if *tangential > T::zero() {
        mu.negated()
    } else if *tangential < T::zero() {
        mu.clone()
    } else if size(b) <= mu.times(a) {
        // Where nothing drives the contact along its tangent, no friction acts.
        if b.is_zero() {
            T::zero()
        } else {
            b.times(&a.recip()?).negated()
        }
    } else if *b > T::zero() {
        mu.negated()
    } else {
        mu.clone()
    };
    let sticks = tangential.is_zero() && size(b) <= mu.times(a);
    Some(Rates {
        tangential: if sticks {
            T::zero()
        } else {
            b.plus(&a.times(&friction))
        },
        normal: unless_rounding(c.plus(&b.times(&friction)), c),
        friction,
    })
}

/// Routh's path with an end by Newton's, Poisson's or Stronge's hypothesis.
fn routh<T: Number + PartialOrd>(
    space: &ContactSpace<T>,
    law: &Friction<T>,
) -> Result<Path<T>, NoPath> {
    let zero = T::zero();
    let mut at = Corner {
        event: Event::Start,
        impulse: [zero.clone(), zero.clone()],
        velocity: [space.tangential.clone(), space.normal.clone()],
    };
    let mut path = Path {
        corners: Vec::with_capacity(4),
        jams: false,
    };
    path.corners.push(at.clone());
    let mut restitution: Option<Restitution<T>> = None;
    let mut work = zero.clone();
    // A path has at most five corners: start, end of slip, end of compression, end, and a grazing start.
    for _ in 0..8 {
        let rates = rates(space, &law.mu, &at.velocity[0]).ok_or(NoPath::Singular)?;
        if path.corners.len() == 1 && rates.normal <= zero && !at.velocity[0].is_zero() {
            path.jams = true;
        }
        let [u_t, u_n] = &at.velocity;
        let slips_towards_zero = u_t.times(&rates.tangential) < zero;
        let slip_ends = match slips_towards_zero {
            true => Some(quotient(&u_t.negated(), &rates.tangential)?),
            false => None,
        };
        let phase_ends = match &restitution {
            None => compression_ends(u_n, &rates)?,
            Some(aim) => aim.ends(&at, &rates, &work, slip_ends.as_ref())?,
        };
        let (step, event) = match (&slip_ends, &phase_ends) {
            (Some(slip), Some(phase)) if slip < phase => (slip.clone(), Event::SlipEnds),
            (_, Some(phase)) if restitution.is_some() => (phase.clone(), Event::End),
            (_, Some(phase)) => (phase.clone(), Event::Compressed),
            (Some(slip), None) => (slip.clone(), Event::SlipEnds),
            (None, None) => return Err(NoPath::NeverEnds),
        };
        let done = step.times(&u_n.plus(&rates.normal.times(&step).halved()));
        work = work.plus(&done);
        let stops = slip_ends.is_some_and(|slip| slip <= step);
        let u_t = match stops {
            true => zero.clone(),
            false => u_t.plus(&rates.tangential.times(&step)),
        };
        let u_n = match event {
            Event::Compressed => zero.clone(),
            Event::SlipEnds => unless_rounding(u_n.plus(&rates.normal.times(&step)), &space.normal),
            _ => u_n.plus(&rates.normal.times(&step)),
        };
        at = Corner {
            event,
            impulse: [
                at.impulse[0].plus(&rates.friction.times(&step)),
                at.impulse[1].plus(&step),
            ],
            velocity: [u_t, u_n],
        };
        path.corners.push(at.clone());
        match event {
            Event::End => return Ok(path),
            Event::Compressed => {
                restitution = Some(Restitution::of(space, law, &at.impulse[1], &work));
                work = zero.clone();
            }
            Event::SlipEnds | Event::Start => {}
        }
    }
    Err(NoPath::NeverEnds)
}

fn quotient<T: Number>(above: &T, below: &T) -> Result<T, NoPath> {
    Ok(above.times(&below.recip().ok_or(NoPath::Singular)?))
}

/// The normal impulse to the end of compression, if the rates stay as they are.
fn compression_ends<T: Number + PartialOrd>(
    u_n: &T,
    rates: &Rates<T>,
) -> Result<Option<T>, NoPath> {
    let zero = T::zero();
    if *u_n >= zero && rates.normal >= zero {
        return Ok(Some(zero));
    }
    if rates.normal <= zero {
        return Ok(None);
    }
    quotient(&u_n.negated(), &rates.normal).map(Some)
}

/// What restitution has to reach.
enum Restitution<T> {
    /// This normal velocity (Newton).
    Velocity(T),
    /// This normal impulse in all (Poisson).
    Impulse(T),
    /// This normal work during restitution (Stronge).
    Work(T),
}

impl<T: Number + PartialOrd> Restitution<T> {
    fn of(space: &ContactSpace<T>, law: &Friction<T>, compression: &T, work: &T) -> Restitution<T> {
        let e = &law.restitution;
        match law.hypothesis {
            Hypothesis::Newton => Restitution::Velocity(e.times(&space.normal).negated()),
            Hypothesis::Stronge => Restitution::Work(e.times(e).times(work).negated()),
            _ => Restitution::Impulse(T::one().plus(e).times(compression)),
        }
    }

    /// The normal impulse that is missing, if the rates stay as they are; `None` where they never lead there, or where slip
    /// ends before that.
    fn ends(
        &self,
        at: &Corner<T>,
        rates: &Rates<T>,
        work: &T,
        slip_ends: Option<&T>,
    ) -> Result<Option<T>, NoPath> {
        let zero = T::zero();
        let u_n = &at.velocity[1];
        match self {
            Restitution::Impulse(all) => Ok(Some(all.minus(&at.impulse[1]))),
            Restitution::Velocity(aim) if u_n >= aim => Ok(Some(zero)),
            Restitution::Velocity(aim) if rates.normal > zero => {
                quotient(&aim.minus(u_n), &rates.normal).map(Some)
            }
            Restitution::Velocity(_) => Ok(None),
            Restitution::Work(all) => {
                let left = all.minus(work);
                if left <= zero {
                    return Ok(Some(zero));
                }
                // Work up to the end of slip; a root is taken only where the impact ends before.
                if let Some(slip) = slip_ends {
                    let half = rates.normal.times(slip).halved();
                    if slip.times(&u_n.plus(&half)) < left {
                        return Ok(None);
                    }
                }
                if rates.normal.is_zero() {
                    return match u_n.is_zero() {
                        true => Ok(None),
                        false => quotient(&left, u_n).map(Some),
                    };
                }
                let twice = rates.normal.times(&left).plus(&rates.normal.times(&left));
                let square = u_n.times(u_n).plus(&twice);
                if square < zero {
                    return Ok(None);
                }
                let speed = square.sqrt().ok_or(NoPath::Irrational)?;
                quotient(&speed.minus(u_n), &rates.normal).map(Some)
            }
        }
    }
}

/// The path of a law that states the impulse outright.
fn at_once<T: Number + PartialOrd>(
    space: &ContactSpace<T>,
    law: &Friction<T>,
    impulse: [T; 2],
) -> Path<T> {
    let [a, b, c, tangential, normal] = space.parts();
    let zero = T::zero();
    let [t, n] = &impulse;
    let after = [
        tangential.plus(&a.times(t)).plus(&b.times(n)),
        normal.plus(&b.times(t)).plus(&c.times(n)),
    ];
    let slipping = !tangential.is_zero();
    let jams = slipping && rates(space, &law.mu, tangential).is_some_and(|r| r.normal <= zero);
    Path {
        corners: vec![
            Corner {
                event: Event::Start,
                impulse: [zero.clone(), zero],
                velocity: [tangential.clone(), normal.clone()],
            },
            Corner {
                event: Event::End,
                impulse,
                velocity: after,
            },
        ],
        jams,
    }
}

/// (1+e) P_I + (1+e_t) (P_II − P_I), or the point of the friction cone on the line from (1+e) P_I towards it.
fn chatterjee_ruina<T: Number + PartialOrd>(
    space: &ContactSpace<T>,
    law: &Friction<T>,
    tangential: &T,
) -> Result<[T; 2], NoPath> {
    let [a, b, c, u_t, u_n] = space.parts();
    // P_I ends the approach without friction; P_II stops the contact.
    let first = quotient(&u_n.negated(), c)?;
    let product = a.times(c);
    let determinant = unless_rounding(product.minus(&b.times(b)), &product);
    let stop_t = quotient(&b.times(u_n).minus(&c.times(u_t)), &determinant)?;
    let stop_n = quotient(&b.times(u_t).minus(&a.times(u_n)), &determinant)?;
    let more = stop_n.minus(&first);
    let bounced = T::one().plus(&law.restitution).times(&first);
    let at = |k: &T| [k.times(&stop_t), bounced.plus(&k.times(&more))];
    let [p_t, p_n] = at(&T::one().plus(tangential));
    if size(&p_t) <= law.mu.times(&p_n) {
        return Ok([p_t, p_n]);
    }
    let below = size(&stop_t).minus(&law.mu.times(&more));
    let kappa = quotient(&law.mu.times(&bounced), &below)?;
    Ok(at(&kappa))
}

/// P_n = −(1+e) u_n⁻/(c + r b), P_t = r P_n.
fn brach<T: Number + PartialOrd>(
    space: &ContactSpace<T>,
    law: &Friction<T>,
    ratio: Option<&T>,
) -> Result<[T; 2], NoPath> {
    let [a, b, c, u_t, u_n] = space.parts();
    let zero = T::zero();
    let bounce = T::one().plus(&law.restitution).times(u_n);
    let limited = || {
        // The ratio that ends the slip is above/below; it pushes only where `below` is negative.
        let above = c.times(u_t).minus(&b.times(&bounce));
        let below = a.times(&bounce).minus(&b.times(u_t));
        let opposed = match u_t {
            u if *u > zero => law.mu.negated(),
            _ => law.mu.clone(),
        };
        if below >= zero {
            return Ok(opposed);
        }
        let wanted = quotient(&above, &below)?;
        Ok(if size(&wanted) <= law.mu {
            wanted
        } else if wanted < zero {
            law.mu.negated()
        } else {
            law.mu.clone()
        })
    };
    let r = ratio.cloned().map_or_else(limited, Ok)?;
    let p_n = quotient(&bounce.negated(), &unless_rounding(c.plus(&r.times(b)), c))?;
    Ok([r.times(&p_n), p_n])
}
