//! Coulomb friction at one contact: its modes as closed forms, each with the condition under which it holds.
//!
//! In: what the contact feels of its bodies (a, b, c, u_t⁻, u_n⁻) as expressions, and the law. Out: the modes of Routh's path
//! (Routh; Wang and Mason 1992) for Newton's, Poisson's and Stronge's hypotheses, and the cases of Chatterjee and Ruina (1998)
//! and of Brach. s is the direction of slip before, k₁ = c − μ s b and μ a − s b are the rates of u_n and −s u_t while it
//! slips. With P_d the normal impulse at which slip ends and P_q that at which compression ends,
//!
//! ```text
//! P_d ≥ (1+e) P_q   ⇔   s u_t⁻ k₁ + (1+e) u_n⁻ (μ a − s b) ≥ 0
//! ```
//!
//! also where one of them is infinite, because ac > b²; so no mode needs a condition of its own on the signs of the rates.
//! Nothing is decided here.

use crate::expr::Expr;
use crate::scene::{ContactSpace, Friction, Hypothesis, Mode};

/// A mode of a law of friction.
#[derive(Clone, Debug)]
pub struct ModeLaw {
    /// Which.
    pub mode: Mode,
    /// What must hold.
    pub when: Vec<When>,
    /// Impulse on the second body (P_t, P_n) \[N s\].
    pub impulse: [Expr; 2],
    /// What the mode says of P and u⁺, as two linear conditions in tangential and normal components.
    pub closing: [Closing; 2],
    /// The same where slip ends on the way; `None` where it lasts, or the law has no path.
    pub slip_ends: Option<[Closing; 2]>,
}

/// A condition: an expression that is not negative, or positive.
#[derive(Clone, Debug, PartialEq)]
pub struct When {
    /// The expression.
    pub of: Expr,
    /// Whether zero does not do.
    pub strict: bool,
}

/// impulse · (P_t, P_n) + velocity · (u_t⁺, u_n⁺) = right.
#[derive(Clone, Debug)]
pub struct Closing {
    /// Coefficients of P_t and P_n.
    pub impulse: [Expr; 2],
    /// Coefficients of u_t⁺ and u_n⁺.
    pub velocity: [Expr; 2],
    /// Right side.
    pub right: Expr,
    /// What it states, in a few words.
    pub words: &'static str,
}

/// On whose sign the direction s of friction depends, and what decides where it vanishes.
#[derive(Clone, Debug)]
pub struct Side {
    /// s is the sign of this.
    pub of: Expr,
    /// Where that is zero, s is the sign of this; where both are zero, either s gives the same.
    pub tie: Expr,
}

/// What decides the direction of friction: the slip before, or for laws without a path the impulse that would end it.
pub fn side(space: &ContactSpace, law: &Friction) -> Side {
    let [_, b, c, u_t, u_n] = space.parts();
    let stopping = |factor: Expr| Side {
        of: factor * b * u_n - c * u_t,
        tie: Expr::zero(),
    };
    match law.hypothesis {
        Hypothesis::Newton | Hypothesis::Poisson | Hypothesis::Stronge => Side {
            of: u_t.clone(),
            tie: -b,
        },
        Hypothesis::ChatterjeeRuina { .. } => stopping(Expr::one()),
        Hypothesis::Brach { .. } => stopping(Expr::one() + &law.restitution),
    }
}

/// The modes for one direction s = ±1.
pub fn modes(space: &ContactSpace, law: &Friction, s: i64) -> Vec<ModeLaw> {
    let forms = Forms {
        space,
        law,
        s: Expr::from(s),
    };
    match &law.hypothesis {
        Hypothesis::Newton | Hypothesis::Poisson | Hypothesis::Stronge => match space.is_held() {
            true => forms.held(),
            false => forms.routh(),
        },
        Hypothesis::ChatterjeeRuina { tangential } => forms.chatterjee_ruina(tangential),
        Hypothesis::Brach { ratio } => forms.brach(ratio.as_ref()),
    }
}

/// The impulse that stops the contact, −W⁻¹ u⁻, needs at least this |P_t|/P_n, as numerator and denominator; the sign is that
/// of −P_t. Of a body on one hinge or track W is singular, and an impulse along the normal alone may do.
pub fn stopping_ratio(space: &ContactSpace) -> [Expr; 2] {
    let [a, b, c, u_t, u_n] = space.parts();
    [c * u_t - b * u_n, b * u_t - a * u_n]
}

/// The parts of the closed forms.
struct Forms<'a> {
    space: &'a ContactSpace,
    law: &'a Friction,
    s: Expr,
}

/// How a path goes on once slip has ended.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Then {
    Sticks,
    Reverses,
}

impl Forms<'_> {
    /// c − μ s b, the rate of u_n while slipping; with the other sign after a reversal.
    fn slipping(&self, reversed: bool) -> Expr {
        let drive = &self.law.mu * &self.s * &self.space.b;
        if reversed {
            &self.space.c + drive
        } else {
            &self.space.c - drive
        }
    }

    /// μ a − s b, the rate at which slip dies.
    fn dying(&self) -> Expr {
        &self.law.mu * &self.space.a - &self.s * &self.space.b
    }

    /// P_d, the normal impulse at which slip ends.
    fn slip_ends(&self) -> Expr {
        &self.s * &self.space.tangential / self.dying()
    }

    /// Not negative where slip lasts beyond the normal impulse `factor` · P_q.
    fn outlasts(&self, factor: Expr) -> Expr {
        &self.s * &self.space.tangential * self.slipping(false)
            + factor * &self.space.normal * self.dying()
    }

    fn bounce(&self) -> Expr {
        Expr::one() + &self.law.restitution
    }

    /// P_t = −μ s P_n; where slip has been reversed, P_t = μ s (P_n − 2 P_d).
    fn on_the_cone(&self, reversed: bool) -> Closing {
        let ratio = &self.law.mu * &self.s;
        if !reversed {
            return Closing {
                impulse: [Expr::one(), ratio],
                velocity: nothing(),
                right: Expr::zero(),
                words: "friction of a sliding contact",
            };
        }
        Closing {
            impulse: [Expr::one(), -&ratio],
            velocity: nothing(),
            right: Expr::from(-2) * ratio * self.slip_ends(),
            words: "friction before and after the reversal of slip",
        }
    }

    fn restitution(&self) -> Closing {
        separates(-&self.law.restitution * &self.space.normal, "restitution")
    }

    fn routh(&self) -> Vec<ModeLaw> {
        let [a, b, _, _, u_n] = self.space.parts();
        let (mu, s) = (&self.law.mu, &self.s);
        let to_the_end = self.outlasts(self.bounce());
        let through_compression = self.outlasts(Expr::one());
        let held = mu * a + s * b;
        let p_n = -self.bounce() * u_n / self.slipping(false);
        let mut all = vec![ModeLaw {
            mode: Mode::Slides,
            when: vec![not_negative(to_the_end.clone())],
            impulse: [-mu * s * &p_n, p_n],
            closing: [self.on_the_cone(false), self.restitution()],
            slip_ends: None,
        }];
        let in_restitution = [
            not_negative(through_compression.clone()),
            positive(-to_the_end),
        ];
        let in_compression = [positive(-through_compression)];
        let holds = [
            (Then::Sticks, not_negative(held.clone())),
            (Then::Reverses, positive(-held)),
        ];
        for (then, held) in holds {
            for compression in [true, false] {
                let mut when = match compression {
                    true => in_compression.to_vec(),
                    false => in_restitution.to_vec(),
                };
                when.push(held.clone());
                all.push(self.ended(then, compression, when));
            }
        }
        all
    }

    /// Where the joints hold the contact along its tangent nothing drives it to slip, and friction has nothing to oppose.
    fn held(&self) -> Vec<ModeLaw> {
        let without_friction = Closing {
            impulse: [Expr::one(), Expr::zero()],
            velocity: nothing(),
            right: Expr::zero(),
            words: "no friction, since nothing drives the contact to slip",
        };
        vec![ModeLaw {
            mode: Mode::SticksInCompression,
            when: Vec::new(),
            impulse: [
                Expr::zero(),
                -self.bounce() * &self.space.normal / &self.space.c,
            ],
            closing: [without_friction, self.restitution()],
            slip_ends: None,
        }]
    }

    /// A mode in which slip ends.
    fn ended(&self, then: Then, compression: bool, when: Vec<When>) -> ModeLaw {
        let [a, b, c, u_t, u_n] = self.space.parts();
        let mode = match (then, compression) {
            (Then::Sticks, true) => Mode::SticksInCompression,
            (Then::Sticks, false) => Mode::SticksInRestitution,
            (Then::Reverses, true) => Mode::ReversesInCompression,
            (Then::Reverses, false) => Mode::ReversesInRestitution,
        };
        let p_d = self.slip_ends();
        let k_1 = self.slipping(false);
        let k_2 = match then {
            Then::Sticks => c - b * b / a,
            Then::Reverses => self.slipping(true),
        };
        let u_d = u_n + &k_1 * &p_d;
        let poisson = || match (compression, then) {
            (false, _) => -self.bounce() * u_n / &k_1,
            (true, Then::Sticks) => -self.bounce() * (a * u_n - b * u_t) / (a * c - b * b),
            (true, Then::Reverses) => {
                let turned = Expr::from(2) * &self.law.mu * &self.s * b * &p_d;
                -self.bounce() * (u_n - turned) / &k_2
            }
        };
        let from_speed = |speed: &Expr| &p_d + (speed - &u_d) / &k_2;
        let (p_n, normal) = match self.law.hypothesis {
            Hypothesis::Newton => {
                let speed = -&self.law.restitution * u_n;
                (from_speed(&speed), self.restitution())
            }
            Hypothesis::Stronge => {
                let speed = self.energetic(compression, &p_d, [&k_1, &k_2], &u_d);
                let words = "restitution by energy";
                (from_speed(&speed), separates(speed, words))
            }
            _ => {
                let p_n = poisson();
                let words = "normal impulse, 1 + e times that of compression";
                (p_n.clone(), presses(p_n, words))
            }
        };
        let (p_t, tangential) = match then {
            Then::Sticks => (-(b * &p_n + u_t) / a, no_slip("no slip after")),
            Then::Reverses => (
                &self.law.mu * &self.s * (&p_n - Expr::from(2) * &p_d),
                self.on_the_cone(true),
            ),
        };
        ModeLaw {
            mode,
            when,
            impulse: [p_t, p_n],
            closing: [tangential, normal],
            slip_ends: Some([self.on_the_cone(false), no_slip("slip ends")]),
        }
    }

    /// u_n⁺ by Stronge's hypothesis, where slip ends on the way.
    fn energetic(&self, compression: bool, p_d: &Expr, [k_1, k_2]: [&Expr; 2], u_d: &Expr) -> Expr {
        let (e, u_n) = (&self.law.restitution, &self.space.normal);
        if compression {
            // −W_c = −(u_n⁻ + u_d) P_d/2 + u_d²/(2 k₂); the form (u_n⁻² − u_d²)/(2 k₁) is 0/0 where k₁ = 0.
            let twice = -(u_n + u_d) * p_d * k_2 + u_d * u_d;
            return e * twice.sqrt();
        }
        let square = u_d * u_d * (Expr::one() - k_2 / k_1) + k_2 * e * e * u_n * u_n / k_1;
        square.sqrt()
    }

    fn chatterjee_ruina(&self, tangential: &Expr) -> Vec<ModeLaw> {
        let [a, b, c, u_t, u_n] = self.space.parts();
        let (mu, s) = (&self.law.mu, &self.s);
        let first = -u_n / c;
        let determinant = a * c - b * b;
        let stop_t = (b * u_n - c * u_t) / &determinant;
        let more = (b * u_t - a * u_n) / &determinant - &first;
        let bounced = self.bounce() * &first;
        let at = |k: &Expr| [k * &stop_t, &bounced + k * &more];
        let inside = at(&(Expr::one() + tangential));
        let room = mu * &inside[1] - s * &inside[0];
        let kappa = mu * &bounced / (s * &stop_t - mu * &more);
        let outright = |mode: Mode, when: When, [p_t, p_n]: [Expr; 2]| ModeLaw {
            mode,
            when: vec![when],
            closing: [
                Closing {
                    impulse: [Expr::one(), Expr::zero()],
                    velocity: nothing(),
                    right: p_t.clone(),
                    words: "tangential impulse (Chatterjee and Ruina)",
                },
                presses(p_n.clone(), "normal impulse (Chatterjee and Ruina)"),
            ],
            slip_ends: None,
            impulse: [p_t, p_n],
        };
        vec![
            outright(Mode::InsideCone, not_negative(room.clone()), inside),
            outright(Mode::OnCone, positive(-room), at(&kappa)),
        ]
    }

    fn brach(&self, ratio: Option<&Expr>) -> Vec<ModeLaw> {
        let [a, b, c, u_t, u_n] = self.space.parts();
        let (mu, s) = (&self.law.mu, &self.s);
        let bounce = self.bounce() * u_n;
        let along = |r: Expr, mode: Mode, when: Vec<When>| {
            let p_n = -&bounce / (c + &r * b);
            ModeLaw {
                mode,
                when,
                impulse: [&r * &p_n, p_n],
                closing: [
                    Closing {
                        impulse: [Expr::one(), -r],
                        velocity: nothing(),
                        right: Expr::zero(),
                        words: "impulse ratio",
                    },
                    self.restitution(),
                ],
                slip_ends: None,
            }
        };
        if let Some(r) = ratio {
            return vec![along(r.clone(), Mode::GivenRatio, Vec::new())];
        }
        let above = c * u_t - b * &bounce;
        let below = a * &bounce - b * u_t;
        let over = mu * &below - s * &above;
        let p_n = -&below / (a * c - b * b);
        let sticks = ModeLaw {
            mode: Mode::Sticks,
            when: vec![not_negative(-&over)],
            impulse: [-(b * &p_n + u_t) / a, p_n],
            closing: [no_slip("no slip after"), self.restitution()],
            slip_ends: None,
        };
        vec![along(mu * s, Mode::Slides, vec![positive(over)]), sticks]
    }
}

fn nothing() -> [Expr; 2] {
    [Expr::zero(), Expr::zero()]
}

fn not_negative(of: Expr) -> When {
    When { of, strict: false }
}

fn positive(of: Expr) -> When {
    When { of, strict: true }
}

/// u_t⁺ = 0.
fn no_slip(words: &'static str) -> Closing {
    Closing {
        impulse: nothing(),
        velocity: [Expr::one(), Expr::zero()],
        right: Expr::zero(),
        words,
    }
}

/// u_n⁺ = speed.
fn separates(speed: Expr, words: &'static str) -> Closing {
    Closing {
        impulse: nothing(),
        velocity: [Expr::zero(), Expr::one()],
        right: speed,
        words,
    }
}

/// P_n = impulse.
fn presses(impulse: Expr, words: &'static str) -> Closing {
    Closing {
        impulse: [Expr::zero(), Expr::one()],
        velocity: nothing(),
        right: impulse,
        words,
    }
}
