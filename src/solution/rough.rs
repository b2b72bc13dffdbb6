//! A contact with friction in a worked solution: its law, what it does in the case that is told, and why each of its two
//! conditions holds.

use super::words::{self, fill, say, vector};
use super::{Inline, Math, Writer};
use crate::expr::{Expr, Function, Symbol, Vector, dot};
use crate::laws::Place;
use crate::scene::{Contact, ContactLaw, Decided, Hypothesis, Mode, Scene};

/// Longest condition, in nodes, that stands in the sentence about its case.
const LONG: usize = 60;

/// The contact whose friction is decided.
fn decided(scene: &Scene) -> Option<(&Contact, &Decided)> {
    let (at, decided) = scene.decided().next()?;
    Some((&scene.contacts[at], decided))
}

/// The law of the rough contact of a scene.
pub(super) fn law(scene: &Scene) -> Option<Vec<Inline>> {
    let (at, decided) = decided(scene)?;
    let law = &decided.law;
    let at = say(words::place(&at.name, "contact"));
    // What symbols mean is told with the others.
    let explained = |e: &Expr, meaning: &str| {
        let parameter = e.as_symbol().and_then(|name| scene.parameter(name));
        parameter.is_some_and(|p| p.meaning.starts_with(meaning))
    };
    let mu = explained(&law.mu, "coefficient of friction");
    let parts = [&law.mu, &law.restitution].map(words::formula);
    let form = match mu && explained(&law.restitution, "coefficient of restitution") {
        true => "The contact at {} is rough, with {} and {}",
        false => {
            "The contact at {} is rough, with coefficient of friction {} and coefficient of restitution {}"
        }
    };
    let mut text = fill(form, [vec![at], parts.to_vec()].concat());
    if let Hypothesis::ChatterjeeRuina { tangential } = &law.hypothesis {
        let both = [words::formula(tangential)];
        text.extend(fill(" along the normal and {} along the surface", both));
    }
    let name = law.hypothesis.name();
    text.push(say(format!(" ({name}’s hypothesis).")));
    Some(text)
}

impl Writer<'_> {
    /// What the rough contact does in the one case that is told, and when it does that.
    pub(super) fn case(&mut self) {
        let Some((contact, decided)) = decided(self.scene) else {
            return;
        };
        let does = match decided.mode {
            Mode::InsideCone => "the impulse lies inside the friction cone",
            Mode::OnCone => "the impulse lies on the friction cone",
            Mode::GivenRatio => "the ratio of the impulses is given",
            Mode::Slides => "it slides to the end",
            Mode::Sticks => "it sticks",
            Mode::SticksInCompression if !self.slips_before(contact) => {
                "nothing slides at any time"
            }
            Mode::SticksInCompression => "it stops sliding during compression, and sticks",
            Mode::SticksInRestitution => "it stops sliding during restitution, and sticks",
            Mode::ReversesInCompression if !self.slips_before(contact) => {
                "it slides from the start"
            }
            Mode::ReversesInCompression => "its slip is reversed during compression",
            Mode::ReversesInRestitution => "its slip is reversed during restitution",
        };
        let sliding = self.rough.as_ref().and_then(|rough| rough.of(decided));
        let e = &decided.law.restitution;
        let rest = sliding.and_then(|s| s.condition(decided.mode, e, true));
        let mut text = match (sliding, rest) {
            (Some(sliding), Some(math)) => {
                let ending = sliding.ending(&[decided.mode], e);
                let lead = fill("Here {}: {}", [Inline::Math(math), say(does)]);
                [ending, lead].concat()
            }
            _ => vec![say(format!("Here {does}"))],
        };
        if let (Mode::InsideCone, Some(rough)) = (decided.mode, &self.rough) {
            let [t, n] = &rough.motion.impulse;
            let most = Expr::from(rough.motion.sense[1]) * &decided.law.mu * n;
            let within = words::related(&Expr::call(Function::Abs, t.clone()), "≤", &most);
            text.extend([say(", "), Inline::Math(within)]);
        }
        let is_short = |(left, _, right): &&(Expr, _, Expr)| left.size() + right.size() <= LONG;
        if !decided.when.is_empty() && decided.when.iter().all(|c| is_short(&c)) {
            text.push(say(", for "));
            let all = decided.when.iter().map(|(left, relation, right)| {
                Inline::Math(words::related(left, relation.sign(), right))
            });
            text.extend(words::row(all, " and "));
        }
        text.push(say("."));
        self.text(text);
    }

    /// Whether the touching points slide on each other just before; where that is not known, they are said to.
    fn slips_before(&mut self, contact: &Contact) -> bool {
        contact.normal.as_ref().is_none_or(|[x, y]| {
            let slip = dot(&contact.relative_velocity(self.scene), &[y.clone(), -x]);
            !self.vanishes(&slip)
        })
    }

    /// Why one of the two conditions of a rough contact holds: its index, as the laws count them, and its right side.
    pub(super) fn rubs(&mut self, contact: usize, index: usize, right: &Expr) {
        let c = &self.scene.contacts[contact];
        let at = words::place(&c.name, "contact");
        let ContactLaw::Decided(decided) = &c.law else {
            return;
        };
        let e = &decided.law.restitution;
        let [here, begins] = [say(&at), say(words::capital(&at))];
        let text = match decided.conditions[index].words {
            "no slip after" => fill("{} does not slip just after:", [begins]),
            "restitution" if e.is_zero() => fill("{} does not rebound:", [begins]),
            "restitution" => {
                let parts = [begins, words::formula(e)];
                fill("{} rebounds at {} times its speed of approach:", parts)
            }
            "friction of a sliding contact" => {
                fill("{} slides against friction all the while:", [begins])
            }
            "friction before and after the reversal of slip" if self.slips_before(c) => {
                let sliding = self.rough.as_ref().and_then(|rough| rough.of(decided));
                match sliding.and_then(|s| s.slip_ends.as_ref()) {
                    Some(end) => fill(
                        "Friction acts against the slip, up to the normal impulse {} one way and for the rest of it the other way:",
                        [words::formula(end)],
                    ),
                    None => vec![say(
                        "Friction acts against the slip, first one way and then the other:",
                    )],
                }
            }
            "friction before and after the reversal of slip" => {
                fill("{} slides from the start, against friction:", [begins])
            }
            "normal impulse, 1 + e times that of compression" => {
                return self.compression(contact, decided, right);
            }
            "restitution by energy" => match self.work(decided) {
                Some(remains) => {
                    let parts = [here, words::formula(&remains)];
                    fill("That leaves {} the normal velocity {}:", parts)
                }
                None => fill(
                    "Restitution gives back {} times the work that the normal impulse took in compression, which leaves {} the normal velocity",
                    [words::formula(&e.powi(2)), here],
                ),
            },
            "impulse ratio" => {
                vec![say(
                    "The friction impulse bears a fixed ratio to the normal one:",
                )]
            }
            "tangential impulse (Chatterjee and Ruina)" => fill(
                "Along the surface the impulse is one plus the tangential coefficient times the one that brings {} to rest:",
                [here],
            ),
            "normal impulse (Chatterjee and Ruina)" if decided.space.b.is_zero() => vec![say(
                "Along the normal it is one plus the coefficient of restitution times the impulse that ends the approach:",
            )],
            "normal impulse (Chatterjee and Ruina)" => vec![say(
                "Along the normal it is one plus the coefficient of restitution times the impulse that would end the approach without friction, plus what the tangential impulse adds:",
            )],
            other => fill("{} at {}:", [say(words::capital(other)), here]),
        };
        let words = decided.conditions[index].words;
        let impulse = decided.conditions[index].impulse.clone();
        self.directions(contact);
        self.text(text);
        self.in_vectors(contact, words, &impulse);
    }

    /// Names the normal and the tangent of a rough contact, where they do not lie along the axes.
    pub(super) fn directions(&mut self, c: usize) {
        let Some(([_, to], [n, t])) = self.inclined(c) else {
            return;
        };
        let contact = &self.scene.contacts[c].name;
        if !self
            .told
            .insert(Symbol::from(format!("normal at {contact}")))
        {
            return;
        }
        let at = words::place(contact, "contact");
        let lead = "Let {} be the normal at {}, towards {}, and {} the tangent.";
        let set = |letter: &'static str, v: Vector| {
            Inline::Math(vec![vector(letter, "", ""), Math::Op("="), Math::Vector(v)])
        };
        let toward = words::body(self.scene, to);
        self.text(fill(lead, [set("n", n), say(at), say(toward), set("t", t)]));
    }

    /// The law of a rough contact in vectors, where its components along the axes would not be recognized.
    fn in_vectors(&mut self, c: usize, law: &str, impulse: &Vector) {
        let Some((_, [n, t])) = self.inclined(c) else {
            return;
        };
        let touching = self.touching(c);
        match law {
            "no slip after" => self.separation(c, &Expr::zero(), &touching, ("t", &t)),
            "restitution" => {
                let ContactLaw::Decided(decided) = &self.scene.contacts[c].law else {
                    return;
                };
                let e = decided.law.restitution.clone();
                self.separation(c, &e, &touching, ("n", &n));
            }
            "friction of a sliding contact" => {
                // P is at right angles to what it is multiplied by.
                let ratio = -dot(impulse, &n) / dot(impulse, &t);
                let ratio = self.tidy(&ratio);
                let at = words::point(self.scene, Place::Contact(c));
                let of = || vector("P", &at, "");
                let [n, t] = ["n", "t"].map(|letter| vector(letter, "", ""));
                let mut math = words::set("{} · {} =", [of(), t]);
                math.extend(ratio.is_negative().then_some(Math::Op("−")));
                let size = if ratio.is_negative() { -ratio } else { ratio };
                math.extend(words::set("{} {} · {}", [Math::Factor(size), of(), n]));
                self.show(math, None);
            }
            _ => {}
        }
    }

    /// The bodies at a contact, the normal from the first to the second and the tangent, where these lie along no axis.
    fn inclined(&mut self, c: usize) -> Option<([usize; 2], [Vector; 2])> {
        let touching = self.touching(c);
        let n = touching.normal?;
        let along_no_axis = n.iter().all(|x| !x.is_zero());
        let t = [n[1].clone(), -&n[0]];
        along_no_axis.then_some(([touching.from, touching.to], [n, t]))
    }

    /// Poisson: compression ends when the contact has no normal velocity left, and restitution adds e times its impulse.
    fn compression(&mut self, contact: usize, decided: &Decided, whole: &Expr) {
        let c = &self.scene.contacts[contact];
        let at = words::place(&c.name, "contact");
        let e = &decided.law.restitution;
        let slips = self.slips_before(c);
        let slides = matches!(
            decided.mode,
            Mode::SticksInRestitution | Mode::ReversesInRestitution
        );
        let sliding = self.rough.as_ref().and_then(|rough| rough.of(decided));
        let mut text = match (decided.mode, sliding) {
            (_, Some(sliding)) if slides => {
                let parts = [say(&at), words::formula(&sliding.compressed)];
                fill("Since {} slides until then, compression ends at {}", parts)
            }
            _ => {
                let end = match decided.mode {
                    Mode::SticksInCompression => format!("Compression ends with {at} at rest"),
                    _ if slides || !slips => format!("{at} slides until compression ends"),
                    _ => format!("By the end of compression {at} slides the other way"),
                };
                let whole = whole / (Expr::one() + e);
                let impulse = words::formula(&self.tidy(&whole));
                match e.is_zero() {
                    true => vec![say(end)],
                    false => fill("{}, at the normal impulse {}", [say(end), impulse]),
                }
            }
        };
        text.extend(match e.is_zero() {
            true => vec![say("; there is no rebound:")],
            false => fill("; restitution adds {} times that:", [words::formula(e)]),
        });
        self.text(text);
    }
}
