//! The table of what is read as what, `tests/formula/read.tsv`: symbols in play, input, reading, reason.

use carom::formula::{Content, Symbols, read, write_plain};

fn show(content: &Content) -> String {
    match content {
        Content::Scalar(e) => write_plain(e),
        Content::Either(values) => {
            let values: Vec<String> = values.iter().map(write_plain).collect();
            values.join(" or ")
        }
        Content::Joined(join, parts) => {
            let parts: Vec<String> = parts.iter().map(show).collect();
            parts.join(join.word())
        }
        Content::Matrix(_) => carom::grade::show(content),
        Content::Vector(v) => format!("[{}]", v.each_ref().map(write_plain).join(", ")),
        Content::Quantity(q) => format!("{} {}", write_plain(&q.value), q.unit.dimension.si()),
        Content::Relations(sides, signs) => {
            let mut out = show(&sides[0]);
            for (side, sign) in sides[1..].iter().zip(signs) {
                out.push_str(&format!(" {} {}", sign.sign(), show(side)));
            }
            out
        }
    }
}

fn symbols(column: &str) -> Symbols {
    if column == "*" {
        return Symbols::open();
    }
    let mut symbols = Symbols::strict();
    for name in column.split(' ') {
        match name.split_once('=') {
            Some((name, latex)) => symbols.declare_as(name, Some(latex), None),
            None => symbols.declare(name),
        }
    }
    symbols
}

#[test]
fn every_row_of_the_table_is_read_as_it_says() {
    let table = include_str!("formula/read.tsv");
    let (mut rows, mut wrong) = (0, Vec::new());
    for (number, line) in table
        .lines()
        .enumerate()
        .filter(|(_, line)| !line.starts_with('#'))
    {
        let [names, input, expected, _] = line.split('\t').collect::<Vec<_>>()[..] else {
            panic!("line {}: four columns are expected: {line}", number + 1);
        };
        rows += 1;
        let found = match read(input, &symbols(names)) {
            Ok(reading) => show(&reading.content),
            Err(fault) => {
                assert!(
                    fault.start <= fault.end && fault.end <= input.len(),
                    "{input}: {fault:?}"
                );
                assert!(fault.show(input).contains('^'), "{input}");
                match expected.strip_prefix("error: ") {
                    Some(piece) if fault.message.contains(piece) => expected.to_string(),
                    _ => format!("error: {}", fault.message),
                }
            }
        };
        if found != expected {
            wrong.push(format!(
                "line {}: {input}\n    expected {expected}\n    read as  {found}",
                number + 1
            ));
        }
    }
    assert!(rows >= 200, "the table has {rows} rows");
    assert!(
        wrong.is_empty(),
        "{} of {rows} rows:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}
