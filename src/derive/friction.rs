//! A scene with friction becomes a table of cases: for every mode that its domain allows, the conditions under which it
//! holds, and the scene with the two linear conditions of that mode in place of the law.
//!
//! In: a scene with one contact with friction. Out: the cases, and thresholds of the coefficient of friction. A condition
//! that holds on the whole domain is not listed, a mode with one that never holds is left out; which case given values pick
//! is told by `verify`.

mod directions;
mod space;
mod thresholds;

use super::Stop;
use space::contact_space;
use thresholds::{at_given, of_parameters, thresholds};

use crate::algebra::{Field, Sign};
use crate::expr::{Expr, Function, Node, Vector};
use crate::formula::Relation;
use crate::laws::friction::{Closing, ModeLaw, Side, When, modes, side, stopping_ratio};
use crate::scene::{
    ALONE, Condition, ContactLaw, ContactSpace, Decided, Friction, Hypothesis, Mode, Question,
    Scene, beside_friction,
};

/// Everything known of a contact with friction before values are given.
#[derive(Clone, Debug)]
pub struct Table {
    /// Index of the contact.
    pub contact: usize,
    /// Its law.
    pub law: Friction,
    /// The normal n out of the first body, and the tangent t: n turned clockwise by 90°.
    pub normal: Vector,
    /// The tangent t.
    pub tangent: Vector,
    /// What the contact feels.
    pub space: ContactSpace,
    /// Whether the contact, free along its tangent, can move in one way only: that of a body on a hinge, or on a track.
    pub one_way: bool,
    /// What the direction of friction depends on.
    pub side: Side,
    /// The cases that the domain allows.
    pub cases: Vec<Case>,
    /// Number of modes that the domain rules out.
    pub ruled_out: usize,
    /// The least |P_t|/P_n of an impulse that stops the contact, with the sign of −P_t: what sticking without rebound needs,
    /// whatever the law; `None` where the contact can move in one way only, so that no one impulse stops it.
    pub stopping_ratio: Option<Expr>,
    /// |b|/a: with less friction a contact whose slip has ended does not hold; `None` where its sign is not known, and for laws
    /// that follow no path.
    pub holding: Option<Expr>,
    /// The coefficient of friction from which the contact jams while it slips (Painlevé), c/(s b); `None` where it never
    /// does.
    pub jamming: Option<Expr>,
    /// Questions whose answers are the same in every case: thresholds, and what is asked about these.
    pub about: Vec<Question>,
    /// What P_n tends to where it jams, as u_n⁻ → 0 from below: the normal impulse of a tangential impact, which is not 0.
    pub jump: Option<Expr>,
}

/// A mode that may happen.
#[derive(Clone, Debug)]
pub struct Case {
    /// The mode.
    pub mode: Mode,
    /// The direction s: that of slip before for a law with a path, that of the impulse along t for the others.
    pub direction: Direction,
    /// What must hold besides.
    pub conditions: Vec<Bound>,
    /// Whether the impact comes to an end. A body on a hinge or track that sticks has no way to rebound, and nothing ends it
    /// under laws that ask for that.
    pub ends: bool,
    /// The closed forms of the impulse (P_t, P_n) in a, b, c, u_t⁻, u_n⁻ put in.
    pub impulse: [Expr; 2],
    /// The scene with the mode's two conditions in place of the law.
    pub scene: Scene,
    /// The scene up to where slip ends on the way; `None` where it lasts, or the law has no path.
    pub slip_ends: Option<Scene>,
}

impl Table {
    /// What the contact does in a case, as people call it.
    pub fn called(&self, case: &Case) -> Mode {
        match self.side.of.is_zero() {
            true => case.mode.without_slip(),
            false => case.mode,
        }
    }
}

impl Case {
    /// Everything that must be ≥ 0 for it, the direction included.
    pub fn needs(&self, side: &Side) -> Vec<Expr> {
        let bounds = self.conditions.iter().flat_map(|bound| &bound.when);
        let decides = match side.of.is_zero() {
            false => &side.of,
            true => &side.tie,
        };
        let direction = match self.direction {
            Direction::Asked(s) => Some(Expr::from(s) * decides),
            _ => None,
        };
        let bounds = bounds.map(|when| when.of.clone());
        direction.into_iter().chain(bounds).collect()
    }
}

/// What a case supposes of the direction s, which is 1 or -1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// The domain allows no other.
    Only(i64),
    /// This one, which the conditions of the case do not say.
    Asked(i64),
    /// This one, wherever the conditions hold.
    Follows(i64),
    /// Nothing: the case is the same either way.
    Either,
}

impl Direction {
    /// s, where it is one of the two.
    pub fn sign(self) -> Option<i64> {
        match self {
            Direction::Only(s) | Direction::Asked(s) | Direction::Follows(s) => Some(s),
            Direction::Either => None,
        }
    }
}

/// A condition of a case.
#[derive(Clone, Debug)]
pub struct Bound {
    /// Each not negative, or positive, where the condition holds.
    pub when: Vec<When>,
    /// The same as `left relation right`, solved for the coefficient of friction where that is possible.
    pub left: Expr,
    /// How the sides compare.
    pub relation: Relation,
    /// The other side.
    pub right: Expr,
}

/// The cases of a scene; `None` where no contact has friction.
pub fn table(scene: &Scene) -> Result<Option<Table>, Stop> {
    let Some((contact, law)) = scene.friction() else {
        return Ok(None);
    };
    let law = law.clone();
    let Some(normal) = scene.contacts[contact].normal.clone() else {
        return Ok(None);
    };
    alone(scene, contact)?;
    let tangent = [normal[1].clone(), -&normal[0]];
    let raw = contact_space(scene, contact, [&tangent, &normal])?;
    let mut forms = Forms::new(scene, &law, &raw);
    let [a, b, c, tangential, u_n] = raw.parts();
    let space = ContactSpace {
        a: forms.tidy(a)?,
        b: forms.tidy(b)?,
        c: forms.tidy(c)?,
        tangential: forms.tidy(tangential)?,
        normal: forms.tidy(u_n)?,
    };
    let one_way = !space.is_held() && forms.has_one_way(&space)?;
    if one_way && matches!(law.hypothesis, Hypothesis::ChatterjeeRuina { .. }) {
        let name = &scene.contacts[contact].name;
        return Err(Stop::NoAnswer(format!(
            "{}'s law has no answer at `{name}`: it divides by zero where a contact can move in one way only, like that of a body on a hinge\nhint: take Poisson's, or see `carom compare`",
            law.hypothesis.name()
        )));
    }
    let side = side(&space, &law);
    let mut table = Table {
        contact,
        stopping_ratio: forms.ratio(&space)?,
        holding: match law.hypothesis.has_path() {
            true => forms.holding(&space)?,
            false => None,
        },
        jamming: None,
        jump: None,
        about: Vec::new(),
        law,
        normal,
        tangent,
        one_way,
        side,
        cases: Vec::new(),
        ruled_out: 0,
        space,
    };
    forms.fill(scene, &mut table)?;
    let asked = thresholds(scene, &table, &mut forms)?;
    for case in &mut table.cases {
        case.scene.questions.clone_from(&asked);
    }
    let asked = at_given(scene, &table, asked)?;
    table.about = of_parameters(scene, asked);
    Ok(Some(table))
}

/// Nothing else may strike: the path of one impulse does not say which of two impacts comes first.
fn alone(scene: &Scene, contact: usize) -> Result<(), Stop> {
    let mut field = Field::new(&scene.domains);
    let others = scene.contacts.iter().enumerate();
    for (i, other) in others.filter(|(i, _)| *i != contact) {
        for speed in scene.strikes(i) {
            field.prepare([&speed]);
            let element = field.element(&speed)?;
            if field.sign(&element) != Some(Sign::Zero) {
                let name = &scene.contacts[contact].name;
                let what = beside_friction(&other.name, name);
                return Err(Stop::NoAnswer(format!("{what}\nhint: {ALONE}")));
            }
        }
    }
    Ok(())
}

/// Whether a law lets a contact that sticks end with a rebound.
fn law_asks_for_rebound(law: &Friction) -> bool {
    matches!(
        law.hypothesis,
        Hypothesis::Newton | Hypothesis::Stronge | Hypothesis::Brach { .. }
    )
}

/// Whether something of this sign is never positive, or where it may vanish never negative.
fn impossible(sign: Sign, strict: bool) -> bool {
    match sign {
        Sign::Negative => true,
        Sign::Zero | Sign::NotPositive => strict,
        Sign::NotNegative | Sign::Positive => false,
    }
}

/// Writing and signs on the domain of a scene.
struct Forms {
    field: Field,
}

impl Forms {
    fn new(scene: &Scene, law: &Friction, space: &ContactSpace) -> Forms {
        let mut field = Field::new(&scene.domains);
        let mut all = super::work::formulas(scene);
        all.extend(law.numbers().into_iter().cloned());
        all.extend(space.parts().map(Clone::clone));
        field.prepare(all.iter());
        Forms { field }
    }

    /// The cases, and where it jams.
    fn fill(&mut self, scene: &Scene, table: &mut Table) -> Result<(), Stop> {
        let directions = self.directions(&table.side)?;
        for s in &directions {
            for mode in modes(&table.space, &table.law, *s) {
                match self.conditions(&mode, &table.law)? {
                    Some(conditions) => {
                        let direction = match directions.len() {
                            1 => Direction::Only(*s),
                            _ => Direction::Asked(*s),
                        };
                        let case = self.case(scene, table, mode, direction, conditions)?;
                        table.cases.push(case);
                    }
                    None => table.ruled_out += 1,
                }
            }
            if table.jamming.is_none() && !table.space.tangential.is_zero() {
                table.jamming = self.jamming(&table.space, *s)?;
                if table.jamming.is_some() {
                    table.jump = self.jump(&table.space, &table.law, *s)?;
                }
            }
        }
        self.without_directions(table)
    }

    /// The form to print; as it is, where another form rests on a sign that was only seen at points.
    fn tidy(&mut self, e: &Expr) -> Result<Expr, Stop> {
        let proved = self.field.proved(e)?;
        Ok(proved.map_or_else(|| e.clone(), |element| self.field.expr(&element)))
    }

    fn sign(&mut self, e: &Expr) -> Result<Option<Sign>, Stop> {
        let proved = self.field.proved(e)?;
        Ok(proved.and_then(|element| self.field.sign(&element)))
    }

    /// The directions of friction that the domain allows.
    fn directions(&mut self, side: &Side) -> Result<Vec<i64>, Stop> {
        Ok(match self.sign(&side.of)? {
            Some(Sign::Positive) => vec![1],
            Some(Sign::Negative) => vec![-1],
            // With neither slip nor a drive along the tangent either direction gives no friction.
            Some(Sign::Zero) => match self.sign(&side.tie)? {
                Some(sign) if sign.is_not_negative() => vec![1],
                Some(Sign::Negative | Sign::NotPositive) => vec![-1],
                _ => vec![1, -1],
            },
            _ => vec![1, -1],
        })
    }

    /// What remains to be asked of a mode; `None` where it cannot happen.
    fn conditions(&mut self, mode: &ModeLaw, law: &Friction) -> Result<Option<Vec<Bound>>, Stop> {
        let mut open = Vec::new();
        for when in &mode.when {
            let of = self.tidy(&when.of)?;
            match self.sign(&of)? {
                Some(sign) if impossible(sign, when.strict) => return Ok(None),
                Some(Sign::Positive) => {}
                Some(sign) if sign.is_not_negative() && !when.strict => {}
                // Nowhere above zero: it holds where it vanishes, an edge that the neighboring mode covers as well.
                _ => open.push(When {
                    of,
                    strict: when.strict,
                }),
            }
        }
        // Two conditions exclude each other where their sum cannot be positive.
        for (i, one) in open.iter().enumerate() {
            for other in &open[..i] {
                if let Some(sign) = self.sign(&(&one.of + &other.of))?
                    && impossible(sign, one.strict || other.strict)
                {
                    return Ok(None);
                }
            }
        }
        let bounds = open.into_iter().map(|when| self.bound(when, law));
        let bounds = bounds.collect::<Result<Vec<_>, _>>()?;
        // So do a least and a greatest value that are the same, where one of them does not belong to its side.
        let is_strict = |r: Relation| matches!(r, Relation::Less | Relation::Greater);
        let is_upper = |r: Relation| matches!(r, Relation::Less | Relation::LessEqual);
        let excluded = bounds.iter().enumerate().any(|(i, one)| {
            bounds[..i].iter().any(|other| {
                one.left == other.left
                    && one.right == other.right
                    && is_upper(one.relation) != is_upper(other.relation)
                    && (is_strict(one.relation) || is_strict(other.relation))
            })
        });
        Ok((!excluded).then_some(bounds))
    }

    /// A condition solved for μ where it is linear in μ with a factor of known sign.
    fn bound(&mut self, when: When, law: &Friction) -> Result<Bound, Stop> {
        let relation = |up: bool| match (up, when.strict) {
            (true, true) => Relation::Greater,
            (true, false) => Relation::GreaterEqual,
            (false, true) => Relation::Less,
            (false, false) => Relation::LessEqual,
        };
        if let Some(mu) = law.mu.as_symbol() {
            let factor = self.tidy(&when.of.derivative(mu))?;
            let free = !factor.is_zero() && !factor.symbols().contains(mu);
            let up = match self.sign(&factor)? {
                Some(Sign::Positive) => Some(true),
                Some(Sign::Negative) => Some(false),
                _ => None,
            };
            if let (true, Some(up)) = (free, up) {
                let rest = &when.of - &factor * &law.mu;
                let right = self.tidy(&(-rest / factor))?;
                let relation = relation(up);
                return Ok(Bound {
                    when: vec![when],
                    left: law.mu.clone(),
                    relation,
                    right,
                });
            }
        }
        let (left, up) = self.without_signed_factors(&when.of)?;
        Ok(Bound {
            left,
            relation: relation(up),
            right: Expr::zero(),
            when: vec![when],
        })
    }

    /// An expression of the same sign, or where `false` of the opposite one, as short as its factors allow.
    fn without_signed_factors(&mut self, e: &Expr) -> Result<(Expr, bool), Stop> {
        let Node::Product(factors) = e.node() else {
            return Ok((e.clone(), true));
        };
        let mut kept = Vec::new();
        let mut up = true;
        for factor in factors {
            match self.sign(factor)? {
                Some(Sign::Positive) => {}
                Some(Sign::Negative) => up = !up,
                _ => kept.push(factor.clone()),
            }
        }
        Ok((Expr::product(kept), up))
    }

    /// The scene of one case.
    fn case(
        &mut self,
        scene: &Scene,
        table: &Table,
        mode: ModeLaw,
        direction: Direction,
        conditions: Vec<Bound>,
    ) -> Result<Case, Stop> {
        let holds = |b: &Bound| (b.left.clone(), b.relation, b.right.clone());
        let when: Vec<_> = conditions.iter().map(holds).collect();
        let mut settled = |closing: &[Closing; 2]| -> Result<Scene, Stop> {
            let [one, two] = closing;
            let conditions = [self.condition(one, table)?, self.condition(two, table)?];
            let mut settled = scene.clone();
            // These two may gain energy; what they gain is told beside the table, and is no reason to withhold the answers.
            let law = &table.law.hypothesis;
            settled.gains_energy |= matches!(law, Hypothesis::Newton | Hypothesis::Brach { .. });
            settled.contacts[table.contact].law = ContactLaw::Decided(Box::new(Decided {
                law: table.law.clone(),
                mode: mode.mode,
                when: when.clone(),
                conditions,
                space: table.space.clone(),
                slip: direction.sign(),
            }));
            Ok(settled)
        };
        let slip_ends = mode.slip_ends.as_ref().map(&mut settled).transpose();
        let (scene, slip_ends, ends) = match (settled(&mode.closing), slip_ends) {
            // No impulse, however large, brings such an impact to its end.
            (Err(Stop::DivisionByZero), _) | (_, Err(Stop::DivisionByZero)) => {
                (scene.clone(), None, false)
            }
            (settled, slip_ends) => (settled?, slip_ends?, true),
        };
        let rebounds = mode.mode.sticks() && law_asks_for_rebound(&table.law);
        Ok(Case {
            mode: mode.mode,
            direction,
            conditions,
            ends: ends && !(table.one_way && rebounds),
            impulse: mode.impulse,
            scene,
            slip_ends,
        })
    }

    /// A condition of a mode in components along x and y.
    fn condition(&mut self, part: &Closing, table: &Table) -> Result<Condition, Stop> {
        let [t, n] = [&table.tangent, &table.normal];
        let turned =
            |[along, across]: &[Expr; 2]| [0, 1].map(|axis| along * &t[axis] + across * &n[axis]);
        // A root stays as it is until the derivation takes it into its field.
        let right = match part.right.has_root() {
            true => part.right.clone(),
            false => self.tidy(&part.right)?,
        };
        Ok(Condition {
            impulse: turned(&part.impulse),
            velocity: turned(&part.velocity),
            right,
            words: part.words,
        })
    }

    /// Whether the contact can move in one way only, ac = b²: that of a body on a hinge, or on a track.
    fn has_one_way(&mut self, space: &ContactSpace) -> Result<bool, Stop> {
        let ContactSpace { a, b, c, .. } = space;
        Ok(self.tidy(&(a * c - b * b))?.is_zero())
    }

    /// The ratio |P_t|/P_n of stopping, without its sign where that is known.
    fn ratio(&mut self, space: &ContactSpace) -> Result<Option<Expr>, Stop> {
        let [above, below] = stopping_ratio(space);
        if self.has_one_way(space)? || self.tidy(&below)?.is_zero() {
            return Ok(None);
        }
        self.size(&(above / below)).map(Some)
    }

    /// |x|, without the bars where the sign is known.
    fn size(&mut self, x: &Expr) -> Result<Expr, Stop> {
        let x = self.tidy(x)?;
        Ok(match self.sign(&x)? {
            Some(sign) if sign.is_not_negative() => x,
            Some(_) => self.tidy(&-x)?,
            None => self.tidy(&Expr::call(Function::Abs, x))?,
        })
    }

    fn holding(&mut self, space: &ContactSpace) -> Result<Option<Expr>, Stop> {
        if self.tidy(&space.a)?.is_zero() {
            return Ok(None);
        }
        let drive = &space.b / &space.a;
        self.size(&drive).map(Some)
    }

    /// c/(s b), where s b can be positive.
    fn jamming(&mut self, space: &ContactSpace, s: i64) -> Result<Option<Expr>, Stop> {
        let drive = Expr::from(s) * &space.b;
        match self.sign(&drive)? {
            Some(Sign::Positive | Sign::NotNegative) | None => {
                self.tidy(&(&space.c / drive)).map(Some)
            }
            Some(_) => Ok(None),
        }
    }

    /// f b u_t⁻/(ac − b²), with f = 1 + e (Poisson), 1 (Newton), 1 + e √(−k₁/(k₂ − k₁)) (Stronge).
    fn jump(&mut self, space: &ContactSpace, law: &Friction, s: i64) -> Result<Option<Expr>, Stop> {
        let [a, b, c, tangential, _] = space.parts();
        if self.has_one_way(space)? {
            return Ok(None);
        }
        let stopping = self.tidy(&(b * tangential / (a * c - b * b)))?;
        let e = &law.restitution;
        Ok(match law.hypothesis {
            Hypothesis::Poisson => Some(self.tidy(&((Expr::one() + e) * stopping))?),
            Hypothesis::Newton => Some(stopping),
            Hypothesis::Stronge => {
                let k_1 = c - &law.mu * Expr::from(s) * b;
                let k_2 = c - b * b / a;
                let share = self.tidy(&(-&k_1 / (k_2 - &k_1)))?;
                Some((Expr::one() + e * share.sqrt()) * stopping)
            }
            Hypothesis::ChatterjeeRuina { .. } | Hypothesis::Brach { .. } => None,
        })
    }

    /// The larger of two numbers.
    fn larger(&mut self, one: &Expr, other: &Expr) -> Result<Expr, Stop> {
        let gap = self.tidy(&(one - other))?;
        Ok(match self.sign(&gap)? {
            Some(sign) if sign.is_not_negative() => one.clone(),
            Some(_) => other.clone(),
            None => {
                let half = Expr::ratio(1, 2);
                half * (one + other + Expr::call(Function::Abs, gap))
            }
        })
    }
}
