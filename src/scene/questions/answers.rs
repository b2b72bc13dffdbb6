//! Questions about formulas of answers: what the file says becomes an [`Ask`].
//!
//! Scenes of one impact and scenes with stages ask these alike: values, thresholds, equations to be solved, largest and least values,
//! limits, forms for a small parameter, identities. Nothing is worked out here.

use crate::expr::{Expr, Symbol};
use crate::formula::Relation;
use crate::formula::near::nearest;
use crate::scene::contact_file::{ContactFile, LawName};
use crate::scene::fault::Fault;
use crate::scene::file::SceneFile;
use crate::scene::formulas::Symbols;
use crate::scene::question_file::QuestionFile;
use crate::scene::record::entries;
use crate::scene::record::{Formula, Map, Text};
use crate::scene::resolver::Resolver;
use crate::scene::{Ask, Extremum, FrictionEvent};

/// Highest power of a small parameter that may be asked for.
const ORDER: u32 = 6;

/// Reads formulas of parameters and of answers to other questions.
pub(in crate::scene) struct Reader<'a, 'f> {
    pub base: &'a mut Resolver<'f>,
    /// What formulas may name.
    pub symbols: &'a Symbols,
}

impl Reader<'_, '_> {
    /// Reads a question about formulas.
    pub fn ask(&mut self, name: &Text, q: &QuestionFile) -> Option<Ask> {
        if let Some(f) = &q.value {
            return Some(Ask::Value {
                formula: self.formula(f)?,
                with: self.with(q.with.as_ref())?,
                meaning: String::new(),
                dimension: None,
                polar: None,
            });
        }
        let extremum = [
            (Extremum::Largest, &q.maximum),
            (Extremum::Least, &q.minimum),
        ];
        for (which, of) in extremum {
            let Some(of) = of else { continue };
            let over = q.over.iter().flatten();
            let over: Vec<Symbol> = over.filter_map(|t| self.parameter(t)).collect();
            if over.is_empty() {
                let message = format!(
                    "the {} value needs the parameters that may be chosen, `over`",
                    which.word()
                );
                return Fault::new(name.span, message).add_to(&mut self.base.faults);
            }
            let of = self.formula(of)?;
            return Some(Ask::Extremum { which, of, over });
        }
        if let Some(of) = &q.limit {
            return self.limit(name, q, of);
        }
        if let Some(of) = &q.approximate {
            return self.approximate(name, q, of);
        }
        if let Some(equation) = &q.show {
            return self.show(q, equation);
        }
        let of = q.threshold.as_ref().or(q.solve.as_ref())?;
        let Some(holds) = &q.holds else {
            let message = "a threshold needs the relation that `holds`";
            return self.refuse(
                name,
                message,
                "\"threshold\": \"v\", \"holds\": \"K_top <= 0\"",
            );
        };
        if let (Some(parameter), Some(event)) = (&q.threshold, event(holds)) {
            let mut declared = self.symbols.names().declared().iter();
            // A product of parameters may bear such a name.
            let places = places(self.base.file, q, event.0);
            if !places.is_empty() || !declared.any(|d| *d.name == *event.0) {
                if let Some((with, _)) = q.with.iter().flat_map(|m| &m.0).next() {
                    let message = "nothing is put into a threshold of friction by `with`";
                    let hint = "give the parameters these values in the scene, by `value` or with --set; where the threshold is a formula, another question takes its name as its \"value\", `with` what you put in";
                    return self.refuse(with, message, hint);
                }
                return self.sticking(&places, parameter, holds, event);
            }
        }
        if let Some(at) = q.at.as_ref().filter(|_| self.base.file.stages.is_some()) {
            let message = "`at` belongs to a threshold of friction, such as \"C sticks\"";
            let hint = "the answers in `holds` say at which stage they are asked";
            return self.refuse(at, message, hint);
        }
        let (left, relation, right) = self.relation(holds)?;
        if q.solve.is_some() != (relation == Relation::Equal) {
            let message = "a threshold holds an inequality, and what is to be solved an equation";
            return Fault::new(holds.span, message).add_to(&mut self.base.faults);
        }
        Some(Ask::Condition {
            parameter: self.parameter(of)?,
            left,
            relation,
            right,
            with: self.with(q.with.as_ref())?,
        })
    }

    pub fn refuse<T>(&mut self, at: &Text, message: impl Into<String>, hint: &str) -> Option<T> {
        let fault = Fault::new(at.span, message).hint(hint);
        fault.add_to(&mut self.base.faults)
    }

    fn limit(&mut self, name: &Text, q: &QuestionFile, of: &Formula) -> Option<Ask> {
        let (Some(tends), Some(to)) = (&q.tends, &q.to) else {
            let message = "a limit needs the parameter that `tends` and what it tends `to`";
            return self.refuse(name, message, "\"tends\": \"phi\", \"to\": \"0\"");
        };
        let to = match to.text.trim() {
            "infinity" | "inf" | "oo" | "∞" => None,
            _ => Some(self.formula(to)?),
        };
        Some(Ask::Limit {
            of: self.formula(of)?,
            parameter: self.parameter(tends)?,
            to,
        })
    }

    fn show(&mut self, q: &QuestionFile, equation: &Text) -> Option<Ask> {
        let (left, relation, right) = self.relation(equation)?;
        let unless = q.unless.iter().flatten();
        let unless = unless.filter_map(|t| self.answer_named(t)).collect();
        let claim = q.claim.as_ref().map(|t| t.text.clone());
        Some(Ask::Show {
            left,
            relation,
            right,
            with: self.with(q.with.as_ref())?,
            unless,
            claim: claim.unwrap_or_default(),
        })
    }

    /// The threshold of friction at which a contact sticks, slides or jams.
    fn sticking(
        &mut self,
        places: &[ContactPlace],
        parameter: &Text,
        holds: &Text,
        (contact, event): (&str, FrictionEvent),
    ) -> Option<Ask> {
        let place = match places {
            [one] => one,
            [] => {
                let message = format!("no impact has a contact `{contact}`");
                let hint = "a threshold of friction names its contact, such as \"C sticks\"";
                return self.refuse(holds, message, hint);
            }
            _ => {
                let message = format!("several impacts have a contact `{contact}`");
                return self.refuse(holds, message, "say which with `at`");
            }
        };
        let rough = place.file.law == Some(LawName::Friction);
        let Some(mu) = place.file.mu.as_ref().filter(|_| rough) else {
            let message = "only a contact with friction has a threshold of it";
            let hint = "give the contact \"law\": \"friction\" with `mu` and `restitution`";
            return self.refuse(parameter, message, hint);
        };
        let mu = mu.text.trim();
        if mu != parameter.text {
            let of = &parameter.text;
            let message = format!(
                "a threshold of friction is one of `mu`, which is {mu} here, and not of {of}"
            );
            let (word, sign) = match event {
                FrictionEvent::Slides => ("slides", "<="),
                FrictionEvent::Sticks => ("sticks", ">="),
                FrictionEvent::Jams => ("jams", ">="),
            };
            let mu = match mu.starts_with(char::is_alphabetic) {
                true => mu,
                false => "mu",
            };
            let hint = format!(
                "let `{mu}` be a parameter, ask first \"mu_c\": {{\"threshold\": \"{mu}\", \"holds\": \"{contact} {word}\"}}, and then {{\"threshold\": \"{of}\", \"holds\": \"{mu} {sign} mu_c\"}}",
            );
            return self.refuse(parameter, message, &hint);
        }
        let contact = place.contact;
        Some(Ask::Friction { contact, event })
    }

    fn approximate(&mut self, name: &Text, q: &QuestionFile, of: &Formula) -> Option<Ask> {
        let Some(tends) = &q.tends else {
            let message = "a form for a small parameter needs the parameter that `tends`";
            let hint = "\"tends\": \"theta\", \"to\": \"0\", \"order\": 1";
            return self.refuse(name, message, hint);
        };
        let whole = |order: &Formula| order.text.trim().parse().ok().filter(|n| *n <= ORDER);
        let power = q.order.as_ref().map(whole);
        if let (Some(None), Some(order)) = (power, &q.order) {
            let message = format!("the order is a whole number from 0 to {ORDER}");
            self.base.faults.push(Fault::new(order.span, message));
        }
        Some(Ask::Approximate {
            of: self.formula(of)?,
            parameter: self.parameter(tends)?,
            to: match &q.to {
                Some(to) => self.formula(to)?,
                None => Expr::zero(),
            },
            order: power.map_or(Some(None), |power| power.map(Some))?,
        })
    }

    /// A formula of parameters and earlier answers.
    pub fn formula(&mut self, f: &Formula) -> Option<Expr> {
        let e = self.symbols.expression(f, &mut self.base.faults)?;
        self.mark_used(&e);
        Some(e)
    }

    fn mark_used(&self, e: &Expr) {
        for name in e.symbols() {
            self.symbols.mark_used(&name);
            self.base.symbols.mark_used(&name);
        }
    }

    /// Parameters and what stands for them.
    pub fn with(&mut self, map: Option<&Map<Formula>>) -> Option<Vec<(Symbol, Expr)>> {
        let mut out = Vec::new();
        for (name, value) in entries(map) {
            let parameter = self.parameter(name)?;
            let faults = &mut self.base.faults;
            let value = self.symbols.in_place_of(&parameter, value, faults)?;
            self.mark_used(&value);
            out.push((parameter, value));
        }
        Some(out)
    }

    /// The symbol of an earlier answer.
    fn answer_named(&mut self, name: &Text) -> Option<Symbol> {
        let given = parameter_names(self.base.file);
        let declared = self.symbols.names().declared().iter();
        let answers = declared.filter(|d| !given.contains(&&*d.name));
        let answers: Vec<&str> = answers.map(|d| &*d.name).collect();
        if answers.contains(&name.text.as_str()) {
            return Some(name.text.as_str().into());
        }
        let message = format!("no earlier answer is called `{}`", name.text);
        let mut fault = Fault::new(name.span, message);
        if let Some(near) = nearest(&name.text, answers) {
            fault = fault.hint(format!("did you mean `{near}`?"));
        }
        fault.add_to(&mut self.base.faults)
    }

    /// The symbol of a parameter.
    pub fn parameter(&mut self, name: &Text) -> Option<Symbol> {
        let all: Vec<&str> = parameter_names(self.base.file);
        if all.contains(&name.text.as_str()) {
            self.base.symbols.mark_used(&name.text);
            return Some(name.text.as_str().into());
        }
        self.base.unknown(name, "parameter", |_| all);
        None
    }

    /// A relation between two formulas.
    fn relation(&mut self, text: &Text) -> Option<(Expr, Relation, Expr)> {
        let (sides, relations) = self.symbols.relations(text, &mut self.base.faults)?;
        if let ([left, right], [relation]) = (sides.as_slice(), relations.as_slice())
            && !matches!(relation, Relation::NotEqual | Relation::Approximately)
        {
            return Some((left.expr()?.clone(), *relation, right.expr()?.clone()));
        }
        let message = "expected one relation between two formulas";
        self.refuse(text, message, "such as \"K_top <= 0\" or \"omega_end = 0\"")
    }
}

/// The name and the event in words such as `C sticks`.
fn event(holds: &Text) -> Option<(&str, FrictionEvent)> {
    let (name, event) = holds.text.trim().rsplit_once(' ')?;
    let event = match event {
        "sticks" => FrictionEvent::Sticks,
        "slides" => FrictionEvent::Slides,
        "jams" => FrictionEvent::Jams,
        _ => return None,
    };
    Some((name.trim(), event))
}

/// A contact of the file.
struct ContactPlace<'f> {
    /// Index of the stage it stands in; `None` in a scene of one impact.
    stage: Option<usize>,
    /// Its index there.
    contact: usize,
    file: &'f ContactFile,
}

/// The contacts of this name, at the stage that the question names if it does.
fn places<'f>(file: &'f SceneFile, q: &QuestionFile, name: &str) -> Vec<ContactPlace<'f>> {
    let all = |stage, contacts: &'f Option<Map<ContactFile>>| {
        let contacts = contacts.iter().flat_map(|m| &m.0).enumerate();
        contacts.filter_map(move |(contact, (n, file))| Some((stage, contact, n, file.as_ref()?)))
    };
    let stages = file.stages.iter().flatten().enumerate();
    let named = stages.filter(|(_, s)| q.at.as_ref().is_none_or(|at| at.text == s.name.text));
    let inside = named.filter_map(|(i, s)| Some(all(Some(i), &s.impact.as_ref()?.contacts)));
    let found = all(None, &file.contacts).chain(inside.flatten());
    found
        .filter(|(_, _, n, _)| n.text == name)
        .map(|(stage, contact, _, file)| ContactPlace {
            stage,
            contact,
            file,
        })
        .collect()
}

/// The stage to which a question about answers belongs: a threshold of friction is one of its contact.
pub(super) fn stage_of(file: &SceneFile, q: &QuestionFile, ask: &Ask) -> Option<usize> {
    let (Ask::Friction { .. }, Some(holds)) = (ask, &q.holds) else {
        return None;
    };
    places(file, q, event(holds)?.0).first()?.stage
}

/// Names of the parameters.
pub(in crate::scene) fn parameter_names(file: &SceneFile) -> Vec<&str> {
    file.parameters
        .iter()
        .flat_map(|m| &m.0)
        .map(|(n, _)| n.text.as_str())
        .collect()
}
