//! What a judgement says: the verdict, how it is known, the point that shows a difference, what is wrong.

use std::collections::BTreeSet;

use crate::expr::Symbol;
use crate::formula::{Content, Fault};

/// The verdict on an answer with everything it rests on.
#[derive(Clone, Debug)]
pub struct Grade {
    /// The verdict.
    pub verdict: Verdict,
    /// Stable code of the reason; it does not depend on points or texts.
    pub note: &'static str,
    /// How the verdict is known.
    pub proof: Proof,
    /// What was assumed, in words.
    pub assumed: Vec<String>,
    /// A point at which the two part.
    pub counterexample: Option<Apart>,
    /// Why the answer, or the expected formula, cannot be read.
    pub error: Option<Fault>,
    /// What is wrong, and how much is right.
    pub diagnosis: Vec<Diagnosis>,
    /// How the answer was read.
    pub content: Option<Content>,
}

impl Grade {
    pub(crate) fn new(
        verdict: Verdict,
        note: &'static str,
        kind: &'static str,
        words: impl Into<String>,
    ) -> Grade {
        Grade {
            verdict,
            note,
            proof: Proof::of(kind, words),
            assumed: Vec::new(),
            counterexample: None,
            error: None,
            diagnosis: Vec::new(),
            content: None,
        }
    }

    /// Invalid, as something cannot be read.
    pub(crate) fn invalid(note: &'static str, words: &str, fault: Fault) -> Grade {
        Grade {
            error: Some(fault),
            ..Grade::new(Verdict::Invalid, note, "none", words)
        }
    }

    pub(crate) fn different(
        note: &'static str,
        kind: &'static str,
        words: impl Into<String>,
    ) -> Grade {
        Grade::new(Verdict::Different, note, kind, words)
    }

    /// Different, as the diagnosis tells in the same words; its code is the note without `DIFF_`.
    pub(crate) fn told(
        note: &'static str,
        kind: &'static str,
        words: impl Into<String>,
        hint: impl Into<String>,
    ) -> Grade {
        let words = words.into();
        let code = note.strip_prefix("DIFF_").unwrap_or(note);
        Grade::different(note, kind, words.clone()).with(Diagnosis::new(code, words, hint))
    }

    pub(crate) fn is_equivalent(&self) -> bool {
        self.verdict == Verdict::Equivalent
    }

    /// Adds what another comparison assumed.
    pub(crate) fn assume(&mut self, more: Vec<String>) {
        for words in more {
            if !self.assumed.contains(&words) {
                self.assumed.push(words);
            }
        }
    }

    /// The same where this holds.
    pub(crate) fn given(mut self, words: impl Into<String>) -> Grade {
        self.assumed.push(words.into());
        self
    }

    /// The same with a point at which the two part.
    pub(crate) fn shown_by(mut self, apart: Apart) -> Grade {
        self.counterexample = Some(apart);
        self
    }

    /// No steps are left: what no proof and no point settled before is undecided for that reason.
    pub(crate) fn stopped(&mut self) {
        let settled = match self.verdict {
            Verdict::Different => self.counterexample.is_some(),
            Verdict::Equivalent => true,
            // Without steps left values are unknown, not absent.
            Verdict::Invalid => self.note != "INVALID_UNDEFINED",
            Verdict::Undecided => false,
        };
        if !settled {
            let words = "the two were not settled within the limit of work";
            *self = Grade::new(Verdict::Undecided, "UNDECIDED_LIMIT", "none", words);
        }
    }

    pub(crate) fn with(mut self, diagnosis: Diagnosis) -> Grade {
        self.diagnosis.push(diagnosis);
        self
    }

    /// The same of an answer that is right by another reading than the usual one.
    pub(super) fn reread(mut self, message: String, hint: &str) -> Grade {
        self.note = "EQUIV_READING";
        let found = Diagnosis::new("READING", message, hint);
        self.diagnosis.insert(0, found);
        self
    }

    /// How the answer was read, in plain notation.
    pub fn read_as(&self) -> Option<String> {
        self.content.as_ref().map(super::show)
    }

    /// The names in the answer.
    pub fn symbols(&self) -> BTreeSet<Symbol> {
        self.content
            .as_ref()
            .map(Content::symbols)
            .unwrap_or_default()
    }
}

/// The four verdicts.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Verdict {
    /// Same value on the whole domain.
    Equivalent,
    /// Not the same.
    Different,
    /// No readable answer.
    Invalid,
    /// Not known; never to be counted as wrong.
    Undecided,
}

impl Verdict {
    /// The word for it.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Equivalent => "equivalent",
            Verdict::Different => "different",
            Verdict::Invalid => "invalid",
            Verdict::Undecided => "undecided",
        }
    }

    /// 1 for equivalent, 0 for different, nothing for what is invalid or undecided.
    pub fn reward(self) -> Option<u8> {
        match self {
            Verdict::Equivalent => Some(1),
            Verdict::Different => Some(0),
            Verdict::Invalid | Verdict::Undecided => None,
        }
    }
}

impl From<Option<bool>> for Verdict {
    fn from(is_same: Option<bool>) -> Verdict {
        match is_same {
            Some(true) => Verdict::Equivalent,
            Some(false) => Verdict::Different,
            None => Verdict::Undecided,
        }
    }
}

/// How a verdict is known.
#[derive(Clone, PartialEq, Debug, serde::Serialize)]
pub struct Proof {
    /// Stable name: `identity`, `modular`, `counterexample`, `solutions`, `kind`, `dimension`, `tolerance`, `branch`, `none`.
    pub kind: &'static str,
    /// The same in words.
    pub words: String,
    /// Largest probability of error, where the proof is probabilistic.
    #[serde(rename = "error_bound", skip_serializing_if = "Option::is_none")]
    pub bound: Option<f64>,
}

impl Proof {
    pub(crate) fn of(kind: &'static str, words: impl Into<String>) -> Proof {
        Proof {
            kind,
            words: words.into(),
            bound: None,
        }
    }
}

/// A point at which two formulas differ, in words.
#[derive(Clone, PartialEq, Eq, Debug, serde::Serialize)]
pub struct Apart {
    /// The point.
    pub at: String,
    /// Value of the answer there.
    pub yours: String,
    /// Value of the expected formula there.
    pub expected: String,
}

impl Apart {
    pub(crate) fn new(
        at: impl Into<String>,
        yours: impl Into<String>,
        expected: impl Into<String>,
    ) -> Apart {
        Apart {
            at: at.into(),
            yours: yours.into(),
            expected: expected.into(),
        }
    }
}

/// One thing found out about a wrong answer.
#[derive(Clone, PartialEq, Eq, Debug, serde::Serialize)]
pub struct Diagnosis {
    /// Stable code.
    pub code: &'static str,
    /// For the teacher.
    pub message: String,
    /// For the student: helps and does not give the answer away.
    pub hint: String,
}

impl Diagnosis {
    pub(crate) fn new(
        code: &'static str,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) -> Diagnosis {
        Diagnosis {
            code,
            message: message.into(),
            hint: hint.into(),
        }
    }
}
