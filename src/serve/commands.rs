//! The commands that can be asked for: what each does, the fields of its requests, and the options these become.

/// A command that can be asked for.
pub(super) struct Command {
    /// Its name, here and on the command line.
    pub name: &'static str,
    /// What it does.
    pub what: &'static str,
    /// Its own fields.
    pub fields: &'static [Field],
    /// Options it is always given; a format that is asked for takes the place of them.
    pub always: &'static [&'static str],
    /// What comes back if the request names no format.
    pub gives: Gives,
    /// Whether it can do without a scene.
    pub sceneless: bool,
}

/// A field of a request.
pub(super) struct Field {
    /// Its name.
    pub name: &'static str,
    /// What it may hold, and the option it becomes.
    pub kind: Kind,
    /// What it is for.
    pub what: &'static str,
}

/// What a field may hold; each kind carries the option of the command line it becomes.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    /// An object of names and values, such as {"v": 2, "theta": "pi/6"}.
    Values(&'static str),
    /// A text or a number.
    Text(&'static str),
    /// One of these words.
    Word(&'static str, &'static [&'static str]),
    /// Whether something is wanted.
    Flag(&'static str),
    /// Several texts.
    Texts(&'static str),
    /// A text of several lines.
    Lines(&'static str),
    /// A list of objects.
    List(&'static str),
}

/// The form of an answer.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Gives {
    /// JSON, to which the version is added.
    Json,
    /// JSON that tells its version itself.
    OwnJson,
    /// Text of this type.
    Text(&'static str),
}

const SET: Field = Field {
    name: "set",
    kind: Kind::Values("--set"),
    what: "values of parameters in their units, such as {\"v\": 2, \"theta\": \"pi/6\"}",
};
const STAGE: Field = Field {
    name: "stage",
    kind: Kind::Text("--stage"),
    what: "only this stage",
};

/// All commands.
pub(super) const COMMANDS: &[Command] = &[
    Command {
        name: "derive",
        what: "closed forms, the equations they took, what was left out, the proof",
        fields: &[
            SET,
            STAGE,
            Field {
                name: "matrix",
                kind: Kind::Flag("--matrix"),
                what: "the full system of equations in matrix form instead",
            },
        ],
        always: &["--format=json"],
        gives: Gives::Json,
        sceneless: false,
    },
    Command {
        name: "solve",
        what: "numbers with units, from the geometry alone; a scene with stages is followed in time",
        fields: &[
            SET,
            Field {
                name: "exact",
                kind: Kind::Flag("--exact"),
                what: "exact fractions instead of doubles",
            },
            Field {
                name: "certify",
                kind: Kind::Flag("--certify"),
                what: "the double nearest to each true value",
            },
        ],
        always: &["--format=json"],
        gives: Gives::Json,
        sceneless: false,
    },
    Command {
        name: "grade",
        what: "whether an answer is right, how that is known, and what is wrong with it",
        fields: &[
            Field {
                name: "quantity",
                kind: Kind::Text("--quantity"),
                what: "the question of the scene that is answered",
            },
            Field {
                name: "expected",
                kind: Kind::Text("--expected"),
                what: "the expected formula, where there is no scene",
            },
            Field {
                name: "answer",
                kind: Kind::Text("--answer"),
                what: "the answer to judge",
            },
            Field {
                name: "steps",
                kind: Kind::Lines("--steps"),
                what: "a worked solution, one equation a line, instead of an answer",
            },
            Field {
                name: "symbols",
                kind: Kind::Values("--symbol"),
                what: "domains of symbols where there is no scene, such as {\"e\": \"0..1\"}",
            },
            Field {
                name: "tolerance",
                kind: Kind::Text("--tolerance"),
                what: "how far a number may be off, such as 2%",
            },
            Field {
                name: "form",
                kind: Kind::Texts("--form"),
                what: "demands on the form: simplified, factored, unit, digits=3, only=m,v",
            },
            Field {
                name: "proof",
                kind: Kind::Word("--proof", &["identity", "fast"]),
                what: "how strong a proof of equality has to be",
            },
            Field {
                name: "slash",
                kind: Kind::Word("--slash", &["usual", "strict"]),
                what: "what a slash without brackets means",
            },
        ],
        always: &["--format=json"],
        gives: Gives::Json,
        sceneless: true,
    },
    Command {
        name: "verify",
        what: "which printed formulas, numbers and matrix entries hold, and what explains those that do not",
        fields: &[Field {
            name: "answers",
            kind: Kind::List("--answers"),
            what: "printed things in the form of a scene's \"printed\", instead of its own",
        }],
        always: &["--format=json"],
        gives: Gives::Json,
        sceneless: false,
    },
    Command {
        name: "solution",
        what: "the worked solution; as JSON each step is a claim that can be replayed",
        fields: &[
            SET,
            Field {
                name: "format",
                kind: Kind::Word(
                    "--format",
                    &[
                        "json",
                        "html",
                        "markdown",
                        "text",
                        "latex",
                        "latex-fragment",
                    ],
                ),
                what: "the format",
            },
            Field {
                name: "detail",
                kind: Kind::Word("--detail", &["brief", "normal", "full"]),
                what: "how much is shown",
            },
        ],
        always: &["--format=json"],
        gives: Gives::OwnJson,
        sceneless: false,
    },
    Command {
        name: "compare",
        what: "laws of friction side by side at the values of a scene",
        fields: &[SET],
        always: &["--format=json"],
        gives: Gives::Json,
        sceneless: false,
    },
    Command {
        name: "draw",
        what: "the pictures of a scene as one SVG",
        fields: &[
            SET,
            STAGE,
            Field {
                name: "which",
                kind: Kind::Word("--which", &["before", "during", "after", "all"]),
                what: "the moment",
            },
            Field {
                name: "body",
                kind: Kind::Text("--body"),
                what: "the free-body diagram of this body alone",
            },
            Field {
                name: "plot",
                kind: Kind::Text("--plot"),
                what: "this plot of the scene instead",
            },
        ],
        always: &[],
        gives: Gives::Text("image/svg+xml; charset=utf-8"),
        sceneless: false,
    },
    Command {
        name: "report",
        what: "error against run time of every route to the numbers of a scene, measured briefly",
        fields: &[SET, STAGE],
        always: &["--quick", "--format=json"],
        gives: Gives::Json,
        sceneless: false,
    },
    Command {
        name: "emit",
        what: "the closed forms as code, arranged for accuracy, each with a bound of its error",
        fields: &[
            STAGE,
            Field {
                name: "lang",
                kind: Kind::Word("--lang", &["rust", "no-std", "c", "python", "numpy"]),
                what: "the language",
            },
            Field {
                name: "plain",
                kind: Kind::Flag("--plain"),
                what: "without scaling by powers of two",
            },
        ],
        always: &[],
        gives: Gives::Text("text/plain; charset=utf-8"),
        sceneless: false,
    },
    Command {
        name: "describe",
        what: "parameters of a scene with ranges for sliders, its stages and plots, and how formulas about it are read; where it cannot be read, what is wrong and where",
        fields: &[
            SET,
            Field {
                name: "formulas",
                kind: Kind::Texts("--formula"),
                what: "formulas about the scene, given back as plain text and as MathML",
            },
            Field {
                name: "symbols",
                kind: Kind::Texts("--symbol"),
                what: "symbols in LaTeX, given back as MathML",
            },
            Field {
                name: "film",
                kind: Kind::Flag("--film"),
                what: "how the bodies come to the first impact and go on after the last, as places at moments",
            },
            Field {
                name: "quantity",
                kind: Kind::Text("--quantity"),
                what: "with a film: a question whose answer is shown beside the right motion",
            },
            Field {
                name: "answer",
                kind: Kind::Text("--answer"),
                what: "with a film: that answer",
            },
        ],
        always: &[],
        gives: Gives::Json,
        sceneless: false,
    },
];

/// What a request for a command needs besides its own fields.
pub(super) const SCENE: [(&str, &str); 2] = [
    ("scene", "a scene: an object, or the text of a scene file"),
    ("name", "a scene of the folder, instead of \"scene\""),
];
