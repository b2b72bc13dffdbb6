use carom::grade::{Given, Options, Question, Strength, entry, judge};
fn question(text: &str) -> Question {
    let mut question = Question::default();
    for word in text.split_whitespace() {
        let (name, domain) = word.split_once('=').expect("NAME=DOMAIN");
        let value = match domain.split_once("..") {
            Some((low, high)) => serde_json::json!({"min": low, "max": high}),
            None => serde_json::json!(domain),
        };
        let domain = entry::domain(&value).expect("a domain");
        question.domains.symbols.insert(name.into(), domain);
        question.symbols.push(Given {
            name: name.into(),
            latex: None,
            dimension: None,
        });
    }
    question
}
#[test]
fn scratch() {
    let text =
        std::fs::read_to_string(std::env::var("PAIRS").unwrap_or("/tmp/wt/eq_pairs.tsv".into()))
            .unwrap();
    for l in text.lines() {
        let c: Vec<&str> = l.split('\t').collect();
        if c.len() < 2 {
            continue;
        }
        let q = question(c.get(2).copied().unwrap_or(""));
        let fast = Options {
            strength: Strength::Fast,
            ..Options::default()
        };
        let t = std::time::Instant::now();
        let g = judge(c[0], c[1], &q, &Options::default());
        let e = t.elapsed();
        let h = judge(c[1], c[0], &q, &Options::default());
        let f = judge(c[0], c[1], &q, &fast);
        println!(
            "{} | {} => {} {} [{}] {:?} {:?} ({} ms){}{}",
            c[0],
            c[1],
            g.verdict.word(),
            g.note,
            g.proof.words,
            g.assumed,
            g.counterexample
                .map(|a| format!("{}: {} / {}", a.at, a.expected, a.yours)),
            e.as_millis(),
            if h.verdict != g.verdict {
                format!("   <<< SWAPPED {} {}", h.verdict.word(), h.note)
            } else {
                String::new()
            },
            if f.verdict != g.verdict || f.proof.bound.is_some() {
                format!(
                    "   FAST {} {} {:?}",
                    f.verdict.word(),
                    f.proof.words,
                    f.proof.bound
                )
            } else {
                String::new()
            }
        );
    }
}
