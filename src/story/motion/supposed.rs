//! What a motion supposes beyond the domains, so that it goes as told: in formulas for whoever tries it at values, and in words.

use crate::algebra::Sign;
use crate::answer::calc::{Seen, above_zero, at_least_zero, sign};
use crate::expr::Expr;
use crate::formula::{Sentence, sentence};
use crate::scene::Stage;
use crate::story::{Refused, StageTold};

/// What is supposed so far.
pub(super) struct Supposed<'a> {
    stage: &'a Stage,
    /// What must be ≥ 0.
    pub needs: Vec<Expr>,
    /// The same, and whatever else is taken for granted, in words.
    pub words: Vec<Sentence>,
}

impl<'a> Supposed<'a> {
    /// Nothing yet.
    pub fn of(stage: &'a Stage) -> Supposed<'a> {
        Supposed {
            stage,
            needs: Vec::new(),
            words: Vec::new(),
        }
    }

    /// Supposes that something is not negative where that is not proved, with what it is needed for; refused where it is
    /// negative.
    pub fn not_negative(
        &mut self,
        e: &Expr,
        so_that: impl Into<Sentence>,
        refused: impl FnOnce() -> Refused,
    ) -> Result<(), Refused> {
        if self.is_proved(e, Sign::is_not_negative, refused)? {
            return Ok(());
        }
        // What decides the sign may be longer than what has it.
        let as_it_is = Sentence::not_negative(e);
        let need = at_least_zero(e, &self.stage.scene.domains);
        let [told, plain] = [&need, &as_it_is].map(|words| words.to_string().chars().count());
        let is_longer = told >= plain;
        self.needs(e, if is_longer { as_it_is } else { need }, so_that);
        Ok(())
    }

    /// The same of what has to be positive.
    pub fn positive(
        &mut self,
        e: &Expr,
        so_that: impl Into<Sentence>,
        refused: impl FnOnce() -> Refused,
    ) -> Result<(), Refused> {
        if self.is_proved(e, |sign| sign == Sign::Positive, refused)? {
            return Ok(());
        }
        let need = above_zero(e, &self.stage.scene.domains);
        self.needs(e, need, so_that);
        Ok(())
    }

    /// Whether a sign is proved; refused where it is another one.
    fn is_proved(
        &self,
        e: &Expr,
        is_so: impl Fn(Sign) -> bool,
        refused: impl FnOnce() -> Refused,
    ) -> Result<bool, Refused> {
        match sign(e, &self.stage.scene.domains) {
            Seen::Proved(sign) if is_so(sign) => Ok(true),
            // It is positive but at a bound.
            Seen::Proved(Sign::NotNegative) => Ok(false),
            Seen::Proved(_) | Seen::Negative => Err(refused()),
            _ => Ok(false),
        }
    }

    fn needs(&mut self, e: &Expr, need: Sentence, so_that: impl Into<Sentence>) {
        self.words
            .push(sentence!("{}, so that {}", need, so_that.into()));
        self.needs.push(e.clone());
    }

    /// Tells it with a motion.
    pub fn told(self, out: &mut StageTold) {
        out.needs = self.needs;
        out.assumptions = self.words;
    }
}
