//! The typeset name of a component from that of its vector.

/// A typeset symbol with one more subscript; the arrow of a vector goes, for a component is none.
pub fn with_subscript(latex: &str, axis: &str) -> String {
    let plain = without_arrow(latex);
    let (mut base, mut sub, mut sup) = (String::new(), String::new(), String::new());
    let mut rest = plain.as_str();
    while let Some(c) = rest.chars().next() {
        let target = match c {
            '_' => &mut sub,
            '^' => &mut sup,
            _ => &mut base,
        };
        if matches!(c, '_' | '^') {
            let (argument, after) = argument(&rest[1..]);
            target.push_str(argument);
            rest = after;
        } else {
            let (piece, after) = argument_with_braces(rest);
            target.push_str(piece);
            rest = after;
        }
    }
    let sub = if sub.is_empty() {
        axis.to_string()
    } else {
        format!("{sub},{axis}")
    };
    let sup = if sup.is_empty() {
        sup
    } else {
        format!("^{{{sup}}}")
    };
    format!("{base}_{{{sub}}}{sup}")
}

fn without_arrow(latex: &str) -> String {
    let Some(at) = latex.find("\\vec") else {
        return latex.to_string();
    };
    let (inner, after) = argument(latex[at + 4..].trim_start());
    format!("{}{inner}{after}", &latex[..at])
}

/// The argument of a script or command: a group without its braces, a command, or a character; and what follows.
fn argument(text: &str) -> (&str, &str) {
    let (piece, after) = argument_with_braces(text);
    let inner = piece
        .strip_prefix('{')
        .and_then(|p| p.strip_suffix('}'))
        .unwrap_or(piece);
    (inner, after)
}

fn argument_with_braces(text: &str) -> (&str, &str) {
    let mut depth = 0_usize;
    let mut chars = text.char_indices().peekable();
    while let Some((i, c)) = chars.next() {
        match c {
            '{' => depth += 1,
            '}' => depth = depth.saturating_sub(1),
            '\\' if depth == 0 => {
                while chars.next_if(|(_, c)| c.is_ascii_alphabetic()).is_some() {}
            }
            _ => {}
        }
        if depth == 0 {
            let end = chars
                .peek()
                .map_or(text.len(), |(j, _)| *j)
                .max(i + c.len_utf8());
            return text.split_at(end);
        }
    }
    (text, "")
}

#[cfg(test)]
mod tests {
    use super::with_subscript;

    #[test]
    fn a_component_keeps_the_marks_of_its_vector() {
        assert_eq!(with_subscript("\\vec{v}_B^{+}", "x"), "v_{B,x}^{+}");
        assert_eq!(with_subscript("v_{G1}^+", "y"), "v_{G1,y}^{+}");
        assert_eq!(with_subscript("P", "x"), "P_{x}");
        assert_eq!(with_subscript("\\omega_1", "x"), "\\omega_{1,x}");
        assert_eq!(with_subscript("\\vec v", "x"), "v_{x}");
    }
}
