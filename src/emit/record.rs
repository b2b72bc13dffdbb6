//! One struct in, one struct out: all arguments of a scene's functions, and all their values.
//!
//! In: functions with the names they were given. Out: two types and a function in each language, and the guard of a header.

use super::dialect::{Language, Style};
use super::function::Function;
use super::names::Names;

/// The two types, and the function from one to the other.
pub(super) fn record(
    style: &Style,
    functions: &[Function],
    given: &[String],
    names: &mut Names,
) -> String {
    let mut fields = Names::default();
    let mut inputs: Vec<(String, String, String)> = Vec::new();
    for argument in functions.iter().flat_map(|f| &f.arguments) {
        if !inputs
            .iter()
            .any(|(symbol, ..)| *symbol == *argument.symbol)
        {
            let field = fields.fresh(&argument.symbol);
            inputs.push((argument.symbol.to_string(), field, argument.unit.clone()));
        }
    }
    let mut fields = Names::default();
    let outputs: Vec<String> = functions.iter().map(|f| fields.fresh(&f.name)).collect();
    let solve = names.fresh(&format!("{}solve", style.prefix));
    let kind = |end: &str| match style.language {
        Language::C => format!("{}{end}", style.prefix),
        _ => capitals(&format!("{}{end}", style.prefix)),
    };
    let (inside, outside) = (names.fresh(&kind("in")), names.fresh(&kind("out")));
    let field_of = |symbol: &str| {
        let found = inputs.iter().find(|(name, ..)| name == symbol);
        found.map_or("", |(_, field, _)| field.as_str())
    };
    let call = |f: &Function, name: &str, read: &str| {
        let each = f.arguments.iter();
        let list: Vec<String> = each
            .map(|a| format!("{read}{}", field_of(&a.symbol)))
            .collect();
        format!("{name}({})", list.join(", "))
    };
    let [field, value, read] = lines(style.language);
    let line = |name: &str, unit: &str| field.replace("@unit", unit).replace("@name", name);
    let mut taken: String = inputs
        .iter()
        .map(|(_, name, unit)| line(name, unit))
        .collect();
    let both = || outputs.iter().zip(functions);
    let made: String = both().map(|(name, f)| line(name, &f.unit)).collect();
    let values: String = both()
        .zip(given)
        .map(|((out, f), name)| {
            value
                .replace("@call", &call(f, name, read))
                .replace("@name", out)
        })
        .collect();
    // Answers that are constants need nothing of what is given, and a struct of C needs a member.
    let mut unread = "";
    if inputs.is_empty() && style.language == Language::C {
        taken = line("none", "1");
        unread = "    (void)given;\n";
    }
    match style.language {
        Language::Rust | Language::NoStd => {
            let given = if inputs.is_empty() { "_" } else { "given" };
            let kept = "#[allow(non_snake_case)]\n#[derive(Clone, Copy, Debug, PartialEq)]\n";
            format!(
                "\n/// Everything the functions take.\n{kept}pub struct {inside} {{\n{taken}}}\n\n/// Everything they give.\n{kept}pub struct {outside} {{\n{made}}}\n\n\
                 /// All values at once.\npub fn {solve}({given}: &{inside}) -> {outside} {{\n    {outside} {{\n{values}    }}\n}}\n"
            )
        }
        Language::C => format!(
            "\n/* Everything the functions take. */\ntypedef struct {{\n{taken}}} {inside};\n\n/* Everything they give. */\ntypedef struct {{\n{made}}} {outside};\n\n\
             /* All values at once. */\nstatic inline {outside} {solve}(const {inside} *given) {{\n    {outside} result;\n{unread}{values}    return result;\n}}\n"
        ),
        Language::Python | Language::NumPy => {
            let member = |lines: String| match lines.is_empty() {
                true => String::from("    pass\n"),
                false => lines,
            };
            let (taken, made) = (member(taken), member(made));
            format!(
                "\n\nclass {inside}(typing.NamedTuple):\n    \"\"\"Everything the functions take.\"\"\"\n\n{taken}\n\n\
                 class {outside}(typing.NamedTuple):\n    \"\"\"Everything they give.\"\"\"\n\n{made}\n\n\
                 def {solve}(given):\n    \"\"\"All values at once.\"\"\"\n    return {outside}(\n{values}    )\n"
            )
        }
    }
}

/// A field of a type, a value that fills one, and how an argument is read.
fn lines(language: Language) -> [&'static str; 3] {
    match language {
        Language::Rust | Language::NoStd => [
            "    /// [@unit]\n    pub @name: f64,\n",
            "        @name: @call,\n",
            "given.",
        ],
        Language::C => [
            "    double @name; /* [@unit] */\n",
            "    result.@name = @call;\n",
            "given->",
        ],
        Language::NumPy => [
            "    @name: np.ndarray  # [@unit]\n",
            "        @name=@call,\n",
            "given.",
        ],
        Language::Python => [
            "    @name: float  # [@unit]\n",
            "        @name=@call,\n",
            "given.",
        ],
    }
}

/// A header that may be included twice.
pub(super) fn guarded(text: &str, prefix: &str) -> String {
    let word: String = prefix
        .chars()
        .filter(char::is_ascii_alphanumeric)
        .collect::<String>()
        .to_ascii_uppercase();
    let name = format!("CAROM_{word}_H").replace("__", "_");
    format!("#ifndef {name}\n#define {name}\n\n{text}\n#endif\n")
}

/// The name of a type: `stick_in` becomes `StickIn`.
fn capitals(name: &str) -> String {
    let words = name.split(|c: char| !c.is_ascii_alphanumeric());
    words
        .filter_map(|w| {
            let mut letters = w.chars();
            let first = letters.next()?;
            Some(first.to_ascii_uppercase().to_string() + letters.as_str())
        })
        .collect()
}
