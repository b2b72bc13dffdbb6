//! Hints for words of mechanics that people write where scene files have another one.

/// What there is for a word of mechanics that is no word of scene files.
/// `here` are the words that could stand in its place.
pub(super) fn meant(word: &str, here: &[&str]) -> Option<&'static str> {
    let word = word.to_lowercase().replace(' ', "_");
    match among(&word, here) {
        Some(meant) => meant,
        None => anywhere(&word),
    }
}

/// What a field that is missing has to say.
pub(super) fn missing(field: &str) -> Option<&'static str> {
    Some(match field {
        "along" => {
            "the direction: \"x\", \"-x\", \"y\", \"-y\", the components [x, y] of a unit vector, or {\"angle\": …}"
        }
        "about" => "the point that it turns about: its name, or its place [x, y]",
        _ => return None,
    })
}

/// An object with many fields, where something else stands in its place.
pub(super) fn example(fields: &[&str]) -> Option<&'static str> {
    match fields {
        _ if fields.contains(&"threshold") => {
            Some("such as {\"velocity\": \"A\", \"along\": \"x\"}")
        }
        _ if fields.starts_with(&["unit", "meaning"]) => {
            Some("such as {\"unit\": \"kg\"}, or with its value {\"value\": \"3 kg\"}")
        }
        _ if fields.starts_with(&["body", "with", "friction"]) => Some(
            "what is slid `on` moves too, such as {\"body\": \"plank\"}; fixed ground has no `on`",
        ),
        _ => None,
    }
}

/// What a word means among these; `Some(None)` where nothing is to be said of it.
fn among(word: &str, here: &[&str]) -> Option<Option<&'static str>> {
    let has = |word| here.contains(&word);
    Some(Some(match word {
        _ if has("nonnegative") => "an interval is {\"min\": 0, \"max\": 1}",
        "left" | "right" | "up" | "down" | "horizontal" | "vertical" if has("-x") => {
            "\"x\" is to the right, \"-x\" to the left, \"y\" up and \"-y\" down"
        }
        _ if here == ["start", "end"] => {
            "`when` is the beginning or the end of a stage; a parameter `tends` `to` a value"
        }
        "rest" | "stop" | "stopped" | "over" | "end" if has("stops") => {
            "a motion that ends at rest has \"until\": \"stops\""
        }
        "point" | "position" | "place" | "location" if !has("center") && !has("particle") => {
            return Some(has("at").then_some("its place is `at`"));
        }
        "to" | "angle" if has("by") && has("until") => {
            "it turns `by` an angle, or `until` its center is above or below the point, or it stops"
        }
        "top" if has("rising") => {
            "a flight ends after a `height`, a `range` or a time `for`, or at its top: \"until\": \"top\""
        }
        "height" | "rise" if has("position") => {
            "how high a body is at the end of a stage is its `position` along y, such as after a fall `until` its \"top\""
        }
        "between" | "of" | "body" | "on" if has("bodies") => "those that meet are `bodies`, a list",
        "fixed" | "static" | "immovable" if has("shape") => {
            "what does not move has \"shape\": \"fixed\""
        }
        "speed" | "v" | "vx" | "vy" | "u" if has("shape") => {
            "the `velocity` of a body at the beginning is [x, y]"
        }
        "m" if has("shape") => "the mass of a body is `mass`",
        "k" | "constant" | "spring_constant" if has("stiffness") => {
            "the constant of a spring is its `stiffness`"
        }
        "compressed" | "compression" | "pressed" if has("stiffness") => {
            "a spring that is pressed by d when the stage begins has \"relaxed\": \"d\""
        }
        "collision" | "collide" | "hit" | "strike" | "blow" if has("impact") => {
            "bodies that collide do so in an `impact`, at its `contacts`"
        }
        "oscillation" | "vibration" | "spring" if has("impact") => {
            "a body moves on a spring in a `slide` with a `spring`"
        }
        "steps" | "phases" | "events" if has("stages") => {
            "what happens one after the other stands in `stages`"
        }
        "find" | "ask" | "asked" | "unknowns" | "quantities" if has("bodies") => {
            "what is asked stands among the `questions`"
        }
        "objects" if has("bodies") => "what moves, and what does not, stands among the `bodies`",
        "variables" | "symbols" | "constants" | "given" | "data" if has("bodies") => {
            "symbols are declared among the `parameters`, with a `unit` and, if known, a `value`"
        }
        "formula" | "text" | "answer" | "value" if has("printed") => {
            "the formula that is printed for an `item` is `printed`; a `number` is printed `of` one"
        }
        "mu" | "mu_k" | "coefficient" | "friction_coefficient" if has("friction") => {
            "the coefficient of friction of a motion is its `friction`"
        }
        "by" | "length" | "range" if has("rolling") => {
            "how far a body slides is the `distance` of its `slide`"
        }
        "restitution" if has("frictionless") => {
            "a contact with a coefficient of restitution has \"law\": \"frictionless\" and \"restitution\": \"e\""
        }
        word if has("threshold") => return of_question(word).map(Some),
        _ => return None,
    }))
}

/// What a word means in a question.
fn of_question(word: &str) -> Option<&'static str> {
    Some(match word {
        "after" => "what is asked just after an impact is asked `at` its stage",
        "before" => {
            "what was just before is asked `at` the stage before; in a scene without stages it has \"when\": \"start\""
        }
        "heat" => {
            "the energy lost is \"energy\": \"lost\", `at` one stage where there are several; where a body slides on another, friction times the way along it is a `value`, such as \"mu*m*g*d\" with its `distance` d"
        }
        "energy_lost" | "lost" | "loss" | "energy_loss" | "dissipated" => {
            "the energy lost is \"energy\": \"lost\", `at` one stage where there are several"
        }
        "kinetic_energy" | "energy_before" | "energy_after" => {
            "a kinetic energy is \"energy\": \"before\", \"after\" or \"lost\", `of` a body or of all"
        }
        "velocity_after" | "final_velocity" | "velocity_before" | "initial_velocity" => {
            "the `velocity` of a body is asked `at` the stage after which it is meant"
        }
        "ratio" | "fraction" | "percentage" | "formula" | "expression" => {
            "a formula of answers is a `value`, such as \"E_lost/E_0\" with the names of other questions"
        }
        "compression" | "extension" | "displacement" => {
            "how far a body gets in a stage, or presses a spring, is the `distance` of that stage"
        }
        "work" => {
            "the work done on a body is the difference of its energies: \"energy\": \"before\" and \"after\", `at` a stage and `of` the body; that of a force is a `value`, the force times the way"
        }
        "max" | "maximize" | "greatest" => {
            "the greatest value of a formula is its `maximum`, with what may vary `over`"
        }
        "find" | "unknown" => {
            "a parameter that is sought is `solve` with the equation that it `holds`, or a `threshold`"
        }
        "force" | "average_force" => {
            "a force on a body that turns is its `reaction`, that of a string its `tension`; a mean force is a `value`, an impulse over a time"
        }
        "minimum" | "min" | "minimize" | "least" => {
            "the least value of a formula is the `maximum` of its negative; the least parameter for which something `holds` is a `threshold`"
        }
        _ => return None,
    })
}

/// What a word means wherever it stands.
fn anywhere(word: &str) -> Option<&'static str> {
    Some(match word {
        "gains_energy" | "relations" => {
            "it stands at the top of the scene, beside `bodies`, for all its stages"
        }
        "points" => {
            "the points of a scene stand at its top, as \"points\": {\"A\": [\"x\", \"y\"]}"
        }
        "elastic" | "perfectly elastic" => {
            "an elastic collision is \"law\": \"frictionless\" with \"restitution\": \"1\""
        }
        "inelastic" | "plastic" | "perfectly inelastic" | "completely inelastic" => {
            "\"law\": \"sticking\", or \"frictionless\" with \"restitution\": \"0\""
        }
        "smooth" => "a smooth contact is \"law\": \"frictionless\" with a `restitution`",
        "friction" | "rough" | "coulomb" | "slipping" | "sliding" => {
            "a contact with friction has \"law\": \"friction\" with `mu`, `restitution` and `hypothesis`"
        }
        "newton" | "poisson" | "stronge" | "brach" | "routh" => {
            "\"law\": \"friction\", and this word as its `hypothesis`: newton, poisson, stronge, chatterjee-ruina or brach"
        }
        "e" | "cor" | "coefficient_of_restitution" => {
            "the coefficient of restitution is `restitution`"
        }
        "string" | "strings" | "rope" | "cord" | "cable" => {
            "a string that jerks taut stands among the `strings` of an impact, in `stages`; in a scene of one impact it is a blow `along` it, with the velocity along it `after`"
        }
        "support" | "supports" => {
            "what holds a body from one side without a jerk stands among the `supports` of an impact, in `stages`"
        }
        "pulley" | "pulleys" => {
            "a pulley is a body, a disk of mass \"0\" where it is light; a `slide` has `strings` `over` it, and an impact has one of the `strings` on each side of it"
        }
        "weld" | "welded" | "glued" | "rigid" | "docking" => {
            "bodies that are one after the impact stick at two points: two contacts with \"law\": \"sticking\", the second anywhere beside the first"
        }
        "omega" | "angular_velocity" | "rotation" => "an angular velocity is `spin`",
        "gained" | "gain" | "released" => "energy that is gained is `lost` with a minus sign",
        "spring" | "springs" => {
            "a body meets a `spring` with `stiffness` in a `slide`, in `stages`; how far it is pressed by an energy E is another question: \"solve\": \"x\", \"holds\": \"k*x^2/2 = E\""
        }
        "explosive" | "charge" | "burst" | "explosion" => {
            "a burst is an impact at a contact without law, with \"gains_energy\": true and what is known `after`"
        }
        "relative" | "relative_velocity" => {
            "a velocity counted from another body is the `velocity` of the one, `relative_to` the other"
        }
        "box" | "block" | "square" | "plate" | "brick" => {
            "a box is a `rectangle` with `width` and `height`"
        }
        "hoop" | "tube" => "a thin hoop is a `ring` with `radius`",
        "triangle" | "semicircle" | "cone" | "shell" | "hollow_sphere" | "ellipse" => {
            "what has no shape of its own here is a `body` with its `inertia` or `radius_of_gyration`"
        }
        "side" => "the sides of a `rectangle` are its `width` and its `height`",
        "circle" | "cylinder" | "wheel" => {
            "a uniform wheel is a `disk` with `radius`, a thin one a `ring`"
        }
        "ball" | "billiard" => "a ball is a `sphere` with `radius`, or a `particle`",
        "bar" | "stick" | "beam" | "plank" | "line" => "a thin bar is a `rod` with `length`",
        "wall" | "ground" | "floor" | "static" => "what does not move is `fixed`",
        "mass_point" | "point_mass" | "point" => "a point mass is a `particle`",
        "roll" | "rolls" | "rolling" => {
            "a body rolls in a `slide` with \"rolling\": true, or with `friction` and \"until\": \"rolls\""
        }
        "swing" | "rotate" | "pivot" => "a body turns about a point in a `turn`",
        "fly" | "flight" | "throw" | "drop" | "free_fall" => {
            "a body flies in a `fall`, with `gravity` or without"
        }
        "stage" => "the stage a question asks about is `at`",
        "direction" | "component" | "axis" => "a direction is given `along`",
        "left" | "right" | "lhs" | "rhs" | "equation" | "condition" | "for" => {
            "a question names its unknown and says the equation as a whole: \"solve\": \"x\", \"holds\": \"u = 0\""
        }
        "position" | "place" | "location" => "a body stands at its `center`",
        "momentum" => {
            "\"balance\": \"momentum\" gives an equation, `angular_momentum` with `about` a quantity"
        }
        "collisions" | "impacts" => "bodies collide at their `contacts`",
        "determinant" | "det" => "a square `matrix` tells its determinant",
        "moment_of_inertia" => "a moment of inertia is `inertia`",
        "gravity" => {
            "gravity belongs to a motion in `stages`; in an impact weight has no impulse, and is one of `forces`"
        }
        _ => return None,
    })
}
