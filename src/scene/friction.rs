//! Coulomb friction at a contact, as a scene states it: the coefficient, the restitution, and the hypothesis that ends the
//! impact. Over any number type, so that formulas and numbers share one description. Nothing is solved here.

use super::{ContactLaw, Scene};
use crate::expr::{Expr, dot};
use crate::formula::Relation;

/// Coulomb friction with restitution at one contact.
#[derive(Clone, Debug, PartialEq)]
pub struct Friction<T = Expr> {
    /// Coefficient of friction μ ≥ 0.
    pub mu: T,
    /// Coefficient of restitution e, 0 ≤ e ≤ 1.
    pub restitution: T,
    /// What e means, and what ends the impact.
    pub hypothesis: Hypothesis<T>,
    /// The mode the scene supposes, to be held against its condition.
    pub supposing: Option<Mode>,
}

/// What the coefficient of restitution means.
#[derive(Clone, Debug, PartialEq)]
pub enum Hypothesis<T = Expr> {
    /// Kinematic: u_n⁺ = −e u_n⁻ (Newton), reached along Routh's path.
    Newton,
    /// Kinetic: the normal impulse of restitution is e times that of compression (Poisson).
    Poisson,
    /// Energetic: the normal work of restitution is −e² times that of compression (Stronge).
    Stronge,
    /// P = (1+e) P_I + (1+e_t) (P_II − P_I), kept inside the friction cone (Chatterjee and Ruina 1998).
    ChatterjeeRuina {
        /// Tangential restitution e_t, −1 ≤ e_t ≤ 1.
        tangential: T,
    },
    /// u_n⁺ = −e u_n⁻ and P_t = r P_n with an impulse ratio r (Brach).
    Brach {
        /// The ratio r; where it is missing, the one that ends the slip, at most μ in size.
        ratio: Option<T>,
    },
}

impl<T> Hypothesis<T> {
    /// Whose it is.
    pub fn name(&self) -> &'static str {
        match self {
            Hypothesis::Newton => "Newton",
            Hypothesis::Poisson => "Poisson",
            Hypothesis::Stronge => "Stronge",
            Hypothesis::ChatterjeeRuina { .. } => "Chatterjee and Ruina",
            Hypothesis::Brach { .. } => "Brach",
        }
    }

    /// Whether it follows the path of the impulse, on which slip ends at some point; the others state the impulse outright.
    pub fn has_path(&self) -> bool {
        matches!(
            self,
            Hypothesis::Newton | Hypothesis::Poisson | Hypothesis::Stronge
        )
    }

    /// Whether it can gain kinetic energy at one contact; Poisson's, Stronge's, and Chatterjee and Ruina's never do.
    pub fn may_gain(&self) -> bool {
        matches!(self, Hypothesis::Newton | Hypothesis::Brach { .. })
    }
}

impl<T> Friction<T> {
    /// The same law with every number converted; the first failure is returned.
    pub fn try_map<U, E>(&self, mut f: impl FnMut(&T) -> Result<U, E>) -> Result<Friction<U>, E> {
        Ok(Friction {
            mu: f(&self.mu)?,
            restitution: f(&self.restitution)?,
            hypothesis: match &self.hypothesis {
                Hypothesis::Newton => Hypothesis::Newton,
                Hypothesis::Poisson => Hypothesis::Poisson,
                Hypothesis::Stronge => Hypothesis::Stronge,
                Hypothesis::ChatterjeeRuina { tangential } => Hypothesis::ChatterjeeRuina {
                    tangential: f(tangential)?,
                },
                Hypothesis::Brach { ratio } => Hypothesis::Brach {
                    ratio: ratio.as_ref().map(f).transpose()?,
                },
            },
            supposing: self.supposing,
        })
    }

    /// Every number of the law.
    pub fn numbers(&self) -> Vec<&T> {
        let mut all = vec![&self.mu, &self.restitution];
        match &self.hypothesis {
            Hypothesis::ChatterjeeRuina { tangential } => all.push(tangential),
            Hypothesis::Brach { ratio: Some(ratio) } => all.push(ratio),
            _ => {}
        }
        all
    }
}

/// What the contact does during the impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Mode {
    /// It slips in one direction throughout.
    Slides,
    /// Slip ends during compression, and the contact sticks.
    SticksInCompression,
    /// Slip ends during restitution, and the contact sticks.
    SticksInRestitution,
    /// Slip ends during compression and goes on in the other direction.
    ReversesInCompression,
    /// Slip ends during restitution and goes on in the other direction.
    ReversesInRestitution,
    /// There is no slip just after; when it ended is not said.
    Sticks,
    /// The impulse lies inside the friction cone.
    InsideCone,
    /// The impulse lies on the friction cone.
    OnCone,
    /// The impulse ratio is the given one.
    GivenRatio,
}

impl Mode {
    /// The mode in words, as the predicate of a contact.
    pub fn words(self) -> &'static str {
        match self {
            Mode::Slides => "slides",
            Mode::SticksInCompression => "sticks in compression",
            Mode::SticksInRestitution => "sticks in restitution",
            Mode::ReversesInCompression => "reverses in compression",
            Mode::ReversesInRestitution => "reverses in restitution",
            Mode::Sticks => "sticks",
            Mode::InsideCone => "inside the cone",
            Mode::OnCone => "on the cone",
            Mode::GivenRatio => "given ratio",
        }
    }

    /// What happens at the contact of this name, as a sentence.
    pub fn of(self, contact: &str) -> String {
        match self {
            Mode::InsideCone | Mode::OnCone => {
                format!("the impulse at `{contact}` lies {}", self.words())
            }
            Mode::GivenRatio => format!("the impulses at `{contact}` have the given ratio"),
            _ => format!("`{contact}` {}", self.words()),
        }
    }

    /// Words that say when a contact begins to stick, as words that say that it sticks.
    pub fn without_phase(words: &str) -> String {
        let whens = [Mode::SticksInCompression, Mode::SticksInRestitution];
        let whens = whens.into_iter();
        whens.fold(words.to_string(), |words, mode| {
            words.replace(mode.words(), Mode::Sticks.words())
        })
    }

    /// Whether the contact does not slip just after.
    pub fn sticks(self) -> bool {
        matches!(
            self,
            Mode::Sticks | Mode::SticksInCompression | Mode::SticksInRestitution
        )
    }

    /// What people call it where the points that touch do not slip before: they stick, or slide, from the start.
    pub fn without_slip(self) -> Mode {
        match self {
            Mode::SticksInCompression => Mode::Sticks,
            Mode::ReversesInCompression => Mode::Slides,
            other => other,
        }
    }

    /// Whether it is what a scene supposes: `sticks` means sticking at any time.
    pub fn is(self, supposed: Mode) -> bool {
        self == supposed || supposed == Mode::Sticks && self.sticks()
    }
}

/// One linear condition on the impulse P of a contact and the relative velocity just after, u⁺ = v₂⁺ − v₁⁺:
/// impulse · P + velocity · u⁺ = right. Two of them are what a mode of friction says.
#[derive(Clone, Debug, PartialEq)]
pub struct Condition<T = Expr> {
    /// Coefficients of P_x and P_y.
    pub impulse: [T; 2],
    /// Coefficients of u_x⁺ and u_y⁺.
    pub velocity: [T; 2],
    /// Right side.
    pub right: T,
    /// What it states, in a few words.
    pub words: &'static str,
}

impl<T> Condition<T> {
    /// The same condition with every number converted; the first failure is returned.
    pub fn try_map<U, E>(&self, mut f: impl FnMut(&T) -> Result<U, E>) -> Result<Condition<U>, E> {
        Ok(Condition {
            impulse: [f(&self.impulse[0])?, f(&self.impulse[1])?],
            velocity: [f(&self.velocity[0])?, f(&self.velocity[1])?],
            right: f(&self.right)?,
            words: self.words,
        })
    }

    /// Every number of the condition, to be changed.
    pub fn numbers_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.impulse
            .iter_mut()
            .chain(&mut self.velocity)
            .chain(std::iter::once(&mut self.right))
    }

    /// Every number of the condition.
    pub fn numbers(&self) -> impl Iterator<Item = &T> {
        self.impulse
            .iter()
            .chain(&self.velocity)
            .chain(std::iter::once(&self.right))
    }
}

/// Friction in one of its modes.
#[derive(Clone, Debug, PartialEq)]
pub struct Decided {
    /// The law.
    pub law: Friction,
    /// The mode.
    pub mode: Mode,
    /// What must hold for it, as left, relation, right.
    pub when: Vec<(Expr, Relation, Expr)>,
    /// What it says of the impulse and of the velocity just after.
    pub conditions: [Condition; 2],
    /// What the contact feels of its bodies.
    pub space: ContactSpace,
    /// Whether it slips along its tangent, 1, or against it, −1, or is driven to; `None` where it does the same either way.
    pub slip: Option<i64>,
}

impl Decided {
    /// What must be ≥ 0, or > 0, for it; and whether zero will do.
    pub fn excesses(&self) -> impl Iterator<Item = (Expr, bool)> {
        self.when.iter().map(|(left, relation, right)| {
            let excess = match relation.is_below() {
                true => right - left,
                false => left - right,
            };
            let closed = matches!(relation, Relation::LessEqual | Relation::GreaterEqual);
            (excess, closed)
        })
    }
}

impl ContactLaw {
    /// Its law of friction, where it has one.
    pub fn friction(&self) -> Option<&Friction> {
        match self {
            ContactLaw::Friction(law) => Some(law),
            ContactLaw::Decided(decided) => Some(&decided.law),
            _ => None,
        }
    }
}

impl Scene {
    /// What friction is decided to do, at the contacts of these indices.
    pub fn decided(&self) -> impl Iterator<Item = (usize, &Decided)> {
        let contacts = self.contacts.iter().enumerate();
        contacts.filter_map(|(c, contact)| match &contact.law {
            ContactLaw::Decided(decided) => Some((c, &**decided)),
            _ => None,
        })
    }

    /// The same with the laws of friction in place of what was decided.
    pub fn undecided(mut self) -> Scene {
        for contact in &mut self.contacts {
            if let ContactLaw::Decided(decided) = &contact.law {
                contact.law = ContactLaw::Friction(Box::new(decided.law.clone()));
            }
        }
        self
    }
}

/// What a contact feels of its bodies, in tangential and normal components: u⁺ = u⁻ + W P with W = [[a, b], [b, c]].
/// The tangent is the normal turned clockwise by 90°.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactSpace<T = Expr> {
    /// Tangential velocity that a tangential impulse of one unit gives, a [1/kg].
    pub a: T,
    /// Normal velocity that a tangential impulse of one unit gives, and the reverse, b [1/kg].
    pub b: T,
    /// Normal velocity that a normal impulse of one unit gives, c [1/kg].
    pub c: T,
    /// Tangential relative velocity just before, u_t⁻ [m/s].
    pub tangential: T,
    /// Normal relative velocity just before, u_n⁻ [m/s]; negative when approaching.
    pub normal: T,
}

impl<T> ContactSpace<T> {
    /// a, b, c, u_t⁻, u_n⁻.
    pub fn parts(&self) -> [&T; 5] {
        [&self.a, &self.b, &self.c, &self.tangential, &self.normal]
    }
}

impl ContactSpace {
    /// Whether the contact neither slips before nor yields to a push along its tangent: its joints hold it there.
    pub fn is_held(&self) -> bool {
        self.a.is_zero() && self.tangential.is_zero()
    }
}

/// What a threshold of the coefficient of friction may be asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrictionEvent {
    /// The contact does not slip just after: with at least this coefficient.
    Sticks,
    /// It slips in one direction throughout: with at most this coefficient.
    Slides,
    /// The normal velocity does not grow while it slips (Painlevé): with at least this coefficient.
    Jams,
}

/// What to do where something else strikes beside a contact with friction.
pub const ALONE: &str = "friction is followed along the path of one impulse: beside it hinges may act, and where the bodies do not approach, contacts that stick and the `supports` and `strings` of an impact in `stages`; take all contacts without friction, or one impact after the other: what sticks in the first moves as one in the next";

/// What is wrong there.
pub fn beside_friction(other: &str, friction: &str) -> String {
    format!("`{other}` acts at the same time as the contact with friction `{friction}`")
}

impl Scene {
    /// How fast the bodies of a contact move against each other, where its law has something to say to that \[m/s\]: beside
    /// friction these vanish.
    pub fn strikes(&self, contact: usize) -> Vec<Expr> {
        let contact = &self.contacts[contact];
        let velocity = contact.relative_velocity(self);
        match (&contact.law, &contact.normal) {
            (ContactLaw::Sticking, _) | (_, None) => velocity.to_vec(),
            (_, Some(normal)) => vec![dot(&velocity, normal)],
        }
    }
}
