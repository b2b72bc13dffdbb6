//! The cases of an impact with friction, for terminals and programs: when the contact does what, and the closed forms of each.

use serde_json::{Value, json};

use super::{latex, unicode};
use crate::answer::calc::sign;
use crate::answer::{Answer, Check};
use crate::derive::friction::{Bound, Case, Direction, Table};
use crate::expr::Expr;
use crate::formula::{Relation, Sentence, write_plain};
use crate::scene::{Friction, Hypothesis, Scene};
use crate::story::Told;
use crate::verify::Proof;
use crate::verify::friction::{JAMS, Judged, Pick};

/// A case with everything derived for it.
pub struct Shown<'a> {
    /// The case.
    pub case: &'a Case,
    /// The impact in this case; `None` where it has no end.
    pub told: Option<Told>,
}

/// What is said of a case that has no answer.
const NO_END: &str = "  no answer: it sticks where it cannot move along its normal, and nothing ends the impact (where compression is over by then, Poisson's hypothesis has an answer)";

/// The table for the terminal.
pub fn text(
    scene: &Scene,
    table: &Table,
    judged: &Judged,
    shown: &[Shown],
    about: &[Answer],
) -> String {
    let mut out = String::new();
    let mut say = |line: &str| out.extend([line, "\n"]);
    let contact = &scene.contacts[table.contact].name;
    let one = match (shown, &judged.pick) {
        ([one], Pick::Values(_) | Pick::Supposed(_)) => Some(one),
        _ => None,
    };
    let refusals = one.and_then(|one| one.told.as_ref()).map(Told::refusals);
    for refusal in refusals.iter().flatten() {
        say(refusal);
    }
    let heading = super::heading(&scene.title, &scene.source);
    say(&heading);
    say(&law_words(scene, table));
    say(&format!(
        "\nwhat {contact} feels of its bodies, along the tangent t and the normal n:"
    ));
    let vector = |v: &[Expr; 2]| format!("({}, {})", unicode(scene, &v[0]), unicode(scene, &v[1]));
    say(&format!(
        "  t = {}, n = {}",
        vector(&table.tangent),
        vector(&table.normal)
    ));
    for (name, value) in feels(table) {
        say(&format!("  {name} = {}", unicode(scene, value)));
    }
    say("");
    for line in bounds(scene, table) {
        say(&line);
    }
    if let Some(words) = verdict(scene, table, judged) {
        say(&words);
    }
    if let Some(one) = one {
        say(&format!(
            "\n{contact} {}{}",
            table.called(one.case).words(),
            holds_where(scene, &table.law, one.case)
        ));
        let full = one.told.as_ref();
        let full = full.map(|told| super::text::told(&one.case.scene, told));
        // What stands above already.
        let rest = full
            .as_ref()
            .map(|full| full.split_once(&format!("{heading}\n")));
        say(match rest {
            None => NO_END,
            Some(rest) => rest.map_or("", |(_, rest)| rest).trim_end(),
        });
    } else {
        let excluded = match table.ruled_out {
            0 => String::new(),
            n => format!("; {n} more cannot happen on the domain"),
        };
        say(&format!("\n{} cases{excluded}:", shown.len()));
        for each in shown {
            say(case(scene, table, each, about).trim_end());
        }
        if let Some(note) = super::text::nothing_asked(scene) {
            say(&format!("\n{note}"));
        }
        if !about.is_empty() {
            say("\nin every case:");
            say(super::text::answers(scene, None, about).trim_end());
        }
    }
    say("\nchecked against the path of the impulse:");
    for c in &judged.checks {
        let mark = match c.holds {
            Some(true) => "holds",
            Some(false) => "FAILS",
            None => "told",
        };
        say(&format!("  {mark}: {}: {}", c.kind, c.words));
    }
    out
}

/// One of several cases: when it holds, and its answers.
fn case(scene: &Scene, table: &Table, each: &Shown, about: &[Answer]) -> String {
    let mut out = String::new();
    let mut say = |line: &str| out.extend([line, "\n"]);
    say(&format!(
        "\n{} {}{}",
        scene.contacts[table.contact].name,
        table.called(each.case).words(),
        holds_where(scene, &table.law, each.case)
    ));
    let Some(told) = &each.told else {
        say(NO_END);
        return out;
    };
    let Some(impact) = told.alone() else {
        return out;
    };
    let is_common = |a: &&Answer| about.iter().any(|b| b.name == a.name);
    for answer in told.answers.iter().filter(|a| !is_common(a)) {
        say(&format!("  {}", super::text::says(scene, None, answer)));
        for line in &answer.text {
            say(&format!("    {}", line.written(|e| unicode(scene, e))));
        }
        let of_case = |words: &&Sentence| impact.assumptions().all(|own| own != **words);
        for words in answer.assumptions.iter().filter(of_case) {
            let words = words.written(|e| unicode(scene, e));
            say(&format!("    given that {words}"));
        }
    }
    for words in (impact.proof.assumptions.iter()).filter(|w| w.condition().is_some()) {
        let words = words.written(|e| unicode(scene, e));
        say(&format!("  given that {words}"));
    }
    for definition in &impact.derivation.definitions {
        say(&format!(
            "    with {} = {}",
            definition.name,
            unicode(scene, &definition.value)
        ));
    }
    say(&format!("  {}", proved(&impact.proof)));
    out
}

/// How far a case is proved: a check that was not decided is no proof.
fn proved(proof: &Proof) -> String {
    let words = |holds: Option<bool>| {
        let some = proof.checks().filter(|c| c.holds == holds);
        some.map(|c| c.words.as_str())
            .collect::<Vec<_>>()
            .join("; ")
    };
    let (failed, open) = (words(Some(false)), words(None));
    if !failed.is_empty() {
        return format!("NOT PROVED: {failed}");
    }
    let is_identity = |c: &&Check| c.kind == "identity" && c.holds == Some(true);
    if proof.scene.iter().any(|c| is_identity(&c)) {
        return String::from("proved: its laws and the conditions of the case hold identically");
    }
    format!("not decided: {open}")
}

/// The law and its parameters.
fn law_words(scene: &Scene, table: &Table) -> String {
    let contact = &scene.contacts[table.contact].name;
    let law = &table.law;
    let more = match &law.hypothesis {
        Hypothesis::ChatterjeeRuina { tangential } => {
            format!(", tangential restitution {}", unicode(scene, tangential))
        }
        Hypothesis::Brach { ratio: Some(ratio) } => {
            format!(", impulse ratio {}", unicode(scene, ratio))
        }
        _ => String::new(),
    };
    format!(
        "at {contact}: friction {}, restitution {}{more} ({}'s hypothesis)",
        unicode(scene, &law.mu),
        unicode(scene, &law.restitution),
        law.hypothesis.name()
    )
}

fn feels(table: &Table) -> [(&'static str, &Expr); 5] {
    let space = &table.space;
    [
        ("a", &space.a),
        ("b", &space.b),
        ("c", &space.c),
        ("u_t⁻", &space.tangential),
        ("u_n⁻", &space.normal),
    ]
}

/// What holds whatever the case: the ratio that sticking needs, the friction that holds, jamming.
fn bounds(scene: &Scene, table: &Table) -> Vec<String> {
    let mut all = Vec::new();
    if let Some(ratio) = &table.stopping_ratio {
        all.push(format!(
            "to stop the contact without rebound takes |P_t|/P_n = {}, whatever the law: necessary",
            unicode(scene, ratio)
        ));
    }
    if let Some(holding) = &table.holding {
        all.push(format!(
            "once slip has ended, the contact holds with friction of at least |b|/a = {}: the law's own threshold",
            unicode(scene, holding)
        ));
    }
    if let Some(jamming) = &table.jamming {
        all.push(format!(
            "it jams while slipping (Painlevé) with friction of at least c/(s b) = {}, where that is positive",
            unicode(scene, jamming)
        ));
    }
    if let (Some(_), Some(jump)) = (&table.jamming, &table.jump) {
        all.push(format!(
            "    there P_n tends to {} as u_n⁻ tends to 0, and not to 0: a tangential impact",
            unicode(scene, jump)
        ));
    }
    all
}

/// What the values say of the supposed mode and of the energy.
fn verdict(scene: &Scene, table: &Table, judged: &Judged) -> Option<String> {
    let mut words = Vec::new();
    if judged.supposed_holds == Some(false) {
        words.push(String::from(
            "at the values of the scene what is supposed is NOT what happens",
        ));
    }
    if judged.supposed_holds == Some(true) {
        words.push(String::from(
            "at the values of the scene what is supposed happens",
        ));
    }
    if let Some(values) = &judged.at_values {
        let law = table.law.hypothesis.name();
        words.push(match judged.supposed_holds {
            Some(false) => format!("what happens there {}", values.energy_words(law)),
            _ => values.told(law),
        });
        if values.jams {
            let contact = &scene.contacts[table.contact].name;
            words.push(format!(
                "{contact} {JAMS}: slip dies at once, whatever the speed of approach"
            ));
        }
    }
    (!words.is_empty()).then(|| words.join("\n"))
}

fn bound(scene: &Scene, b: &Bound) -> String {
    let edge = || sign(&(&b.left - &b.right), &scene.domains).is_not_negative();
    let relation = match b.relation {
        Relation::LessEqual if edge() => Relation::Equal,
        relation => relation,
    };
    format!(
        "{} {} {}",
        unicode(scene, &b.left),
        relation.sign(),
        unicode(scene, &b.right)
    )
}

fn holds_where(scene: &Scene, law: &Friction, case: &Case) -> String {
    let mut all = Vec::new();
    if let Direction::Asked(s) | Direction::Follows(s) = case.direction {
        let what = match law.hypothesis.has_path() {
            true => "slip before is",
            false => "friction is",
        };
        let way = if s > 0 { "along t" } else { "against t" };
        all.push(format!("{what} {way}"));
    }
    all.extend(case.conditions.iter().map(|b| bound(scene, b)));
    match all.is_empty() {
        true => String::from(", on the whole domain"),
        false => format!(", where {}", all.join(" and ")),
    }
}

/// The table as data.
pub fn json(scene: &Scene, table: &Table, judged: &Judged, shown: &[Shown]) -> Value {
    let formula = |e: &Expr| json!({"formula": write_plain(e), "latex": latex(scene, e)});
    let cases: Vec<Value> = shown
        .iter()
        .map(|each| {
            let told = each.told.as_ref();
            let told = told.map(|told| super::json::told(&each.case.scene, told));
            let mut value = told.unwrap_or_else(|| json!({"reason": NO_END.trim_start()}));
            if let Value::Object(fields) = &mut value {
                fields.insert("mode".into(), json!(table.called(each.case).words()));
                fields.insert("direction".into(), json!(each.case.direction.sign()));
                let conditions: Vec<Value> = each
                    .case
                    .conditions
                    .iter()
                    .map(|b| {
                        json!({
                            "left": formula(&b.left),
                            "relation": b.relation.sign(),
                            "right": formula(&b.right),
                        })
                    })
                    .collect();
                fields.insert("conditions".into(), json!(conditions));
            }
            value
        })
        .collect();
    let holds = judged.checks.iter().all(|c| c.holds != Some(false));
    json!({
        "title": scene.title,
        "source": scene.source,
        "contact": scene.contacts[table.contact].name,
        "hypothesis": table.law.hypothesis.name(),
        "mu": formula(&table.law.mu),
        "restitution": formula(&table.law.restitution),
        "contact_space": {
            "a": formula(&table.space.a),
            "b": formula(&table.space.b),
            "c": formula(&table.space.c),
            "u_t": formula(&table.space.tangential),
            "u_n": formula(&table.space.normal),
        },
        "necessary_ratio": table.stopping_ratio.as_ref().map(formula),
        "holding": table.holding.as_ref().map(formula),
        "jamming": table.jamming.as_ref().map(formula),
        "jump": table.jump.as_ref().map(formula),
        "picked_by": match judged.pick {
            Pick::Values(_) => "values",
            Pick::Supposed(_) => "supposing",
            Pick::All => "nothing",
        },
        "supposed_holds": judged.supposed_holds,
        "energy_gained": judged.at_values.as_ref().map(|v| v.gain),
        "jams": judged.at_values.as_ref().map(|v| v.jams),
        "cases": cases,
        "checks": judged.checks,
        "verified": holds && shown.iter().flat_map(|s| &s.told).all(Told::is_proved),
    })
}
