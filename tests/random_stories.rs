//! Laws that hold for every story: random ones are told, and every check of them holds, above all motions integrated in time.

use carom::scene::read;
use carom::story::tell;
use proptest::prelude::*;
use proptest::sample::select;
use proptest::test_runner::RngSeed;

#[path = "random_stories/whole.rs"]
mod whole;

/// A body with its center half a length from O, and what happens to it.
#[derive(Clone, Debug)]
struct Course {
    shape: &'static str,
    /// Direction from O to its center, and that as an angle.
    lies: (&'static str, &'static str, &'static str),
    first: &'static str,
    hit: Option<&'static str>,
    then: Option<&'static str>,
    spin: Option<&'static str>,
    clockwise: Option<bool>,
}

fn course() -> impl Strategy<Value = Course> {
    let lies = select(vec![
        ("1", "0", "0"),
        ("-1", "0", "pi"),
        ("0", "1", "pi/2"),
        ("0", "-1", "-pi/2"),
        ("cos(a)", "sin(a)", "a"),
        ("cos(a)", "-sin(a)", "-a"),
    ]);
    let first = select(vec![
        r#""turn": {"by": "pi/3", "gravity": "g", MORE}"#,
        r#""turn": {"by": "a", "torque": "T", MORE}"#,
        r#""turn": {"until": "below", "gravity": "g", MORE}"#,
        r#""turn": {"until": "above", "gravity": "g", MORE}"#,
        r#""turn": {"until": "stops", "gravity": "g", MORE}"#,
        r#""turn": {"until": "stops", "torque": "-T", MORE}"#,
        r#""fall": {"height": "h", "gravity": "g", MORE}"#,
        r#""slide": {"along": "x", "distance": "s", "force": "-F", MORE}"#,
        r#""impact": MORE"#,
    ]);
    let hit = select(vec![
        r#""law": "sticking""#,
        r#""law": "frictionless", "normal": ["0", "1"], "restitution": "e""#,
        r#""law": "frictionless", "normal": ["-1", "0"], "restitution": "0""#,
    ]);
    let then = select(vec![
        r#""by": "a""#,
        r#""until": "above""#,
        r#""until": "below""#,
        r#""until": "stops""#,
    ]);
    (
        select(vec!["rod", "disk", "rectangle"]),
        lies,
        first,
        prop::option::of(hit),
        prop::option::of(then),
        prop::option::of(select(vec!["w", "-w"])),
        prop::option::of(any::<bool>()),
    )
        .prop_map(|(shape, lies, first, hit, then, spin, clockwise)| Course {
            shape,
            lies,
            first,
            hit,
            then,
            spin,
            clockwise,
        })
}

impl Course {
    fn text(&self) -> String {
        let (x, y, angle) = self.lies;
        let shape = match self.shape {
            "rod" => format!(r#""length": "L", "angle": "{angle}""#),
            "disk" => String::from(r#""radius": "L/2""#),
            _ => format!(r#""width": "L", "height": "L/3", "angle": "{angle}""#),
        };
        let turns = self.first.starts_with("\"turn\"");
        let sense = self
            .clockwise
            .map_or(String::new(), |c| format!(r#", "clockwise": {c}"#));
        let velocity = match (turns, self.spin) {
            (true, Some(w)) => format!(r#", "spin": "{w}", "velocity": {{"about": "O"}}"#),
            (true, None) => String::new(),
            (false, _) if self.first.starts_with("\"fall\"") => {
                String::from(r#", "velocity": ["0", "-v"]"#)
            }
            (false, _) if self.first.starts_with("\"slide\"") => {
                String::from(r#", "velocity": ["v", "0"]"#)
            }
            (false, w) => format!(
                r#", "velocity": ["v", "-v"], "spin": "{}""#,
                w.unwrap_or("0")
            ),
        };
        let law = self.hit.unwrap_or(r#""law": "sticking""#);
        let contact =
            format!(r#"{{"contacts": {{"O": {{"bodies": ["G", "B"], "at": "O", {law}}}}}}}"#);
        let more = match turns {
            true => format!(r#""body": "B", "about": "O"{sense}"#),
            false => String::from(r#""body": "B""#),
        };
        let opens = self.first.starts_with("\"impact\"");
        let first = self
            .first
            .replace("MORE", if opens { &contact } else { &more });
        let mut stages = vec![format!(r#"{{"name": "first", {first}}}"#)];
        let mut questions = vec![
            String::from(r#""u": {"velocity": "B"}"#),
            String::from(r#""K": {"energy": "after", "at": "first"}"#),
        ];
        if turns {
            questions.push(String::from(
                r#""R": {"reaction": "first", "along": "x", "when": "start"}, "alpha": {"angle": "B", "at": "first"}"#,
            ));
        }
        if self.hit.is_some() && !opens {
            stages.push(format!(r#"{{"name": "hit", "impact": {contact}}}"#));
        }
        if let (Some(end), true) = (self.then, law.contains("sticking")) {
            stages.push(format!(
                r#"{{"name": "then", "turn": {{"body": "B", "about": "O", "gravity": "g", {end}{sense}}}}}"#
            ));
            questions.push(String::from(
                r#""F_y": {"reaction": "then", "along": "y"}, "beta": {"angle": "B", "at": "then", "clockwise": true}"#,
            ));
        }
        format!(
            r#"{{
  "parameters": {{
    "m": {{"unit": "kg"}}, "L": {{"unit": "m"}}, "v": {{"unit": "m/s"}}, "g": {{"unit": "m/s^2"}}, "w": {{"unit": "rad/s"}},
    "h": {{"unit": "m"}}, "s": {{"unit": "m"}}, "F": {{"unit": "N"}}, "T": {{"unit": "N m"}},
    "e": {{"unit": "1", "domain": {{"min": 0, "max": 1}}}}, "a": {{"unit": "rad", "domain": {{"min": 0, "max": "pi/2"}}}}
  }},
  "points": {{"O": ["0", "0"]}},
  "bodies": {{
    "G": {{"shape": "fixed"}},
    "B": {{"shape": "{}", "mass": "m", {shape}, "center": ["L/2*({x})", "L/2*({y})"]{velocity}}}
  }},
  "stages": [{}],
  "questions": {{{}}}
}}"#,
            self.shape,
            stages.join(", "),
            questions.join(", ")
        )
    }
}

/// A body on a line, smooth or rough, and how it begins and ends.
fn on_a_line() -> impl Strategy<Value = String> {
    let shape = select(vec![
        r#""shape": "particle""#,
        r#""shape": "rectangle", "width": "R", "height": "2*R""#,
        r#""shape": "disk", "radius": "R""#,
        r#""shape": "ring", "radius": "R""#,
        r#""shape": "sphere", "radius": "R""#,
    ]);
    let along = select(vec![
        ["1", "0"],
        ["-1", "0"],
        ["cos(a)", "-sin(a)"],
        ["cos(a)", "sin(a)"],
        ["-cos(a)", "-sin(a)"],
        ["-cos(a)", "sin(a)"],
    ]);
    let surface = select(vec![
        r#""friction": "mu""#,
        r#""friction": "mu""#,
        r#""friction": "mu", "force": "F""#,
        r#""friction": "mu", "force": "-F""#,
        r#""rolling": true"#,
        r#""force": "-F""#,
    ]);
    let end = select(vec![
        r#""distance": "s""#,
        r#""for": "t""#,
        r#""until": "stops""#,
        r#""until": "rolls""#,
    ]);
    let begin = select(vec![
        ["v", "0", "v > 0"],
        ["0", "0", "v > 0"],
        ["v", "w", "v > R*w"],
        ["v", "-w", "v > R*w"],
        ["v", "w", "v < R*w"],
        ["v", "-w", "v < R*w"],
        ["v", "-v/R", "v > 0"],
        ["v", "v/R", "v > 0"],
    ]);
    let from = prop::option::of(select(vec![["1", "0"], ["-1", "0"], ["cos(a)", "-sin(a)"]]));
    (shape, along, surface, end, begin, from).prop_map(|(shape, along, surface, end, begin, from)| {
        let ([x, y], [v, spin, relation]) = (along, begin);
        let bend = from.map_or("", |_| r#""bend": true, "#);
        let [to_x, to_y] = from.unwrap_or(along);
        let spin = match shape.contains("particle") || shape.contains("rectangle") {
            true => "0",
            false => spin,
        };
        let spin = match shape.contains("particle") {
            true => String::new(),
            false => format!(r#", "spin": "{spin}""#),
        };
        format!(
            r#"{{
  "parameters": {{
    "m": {{"unit": "kg"}}, "R": {{"unit": "m"}}, "v": {{"unit": "m/s"}}, "w": {{"unit": "rad/s"}}, "g": {{"unit": "m/s^2"}},
    "s": {{"unit": "m"}}, "t": {{"unit": "s"}}, "F": {{"unit": "N"}}, "mu": {{"unit": "1"}},
    "a": {{"unit": "rad", "domain": {{"min": 0, "max": "pi/2"}}}}
  }},
  "relations": ["{relation}"],
  "bodies": {{
    "B": {{{shape}, "mass": "m", "center": ["0", "R"], "velocity": ["({v})*({to_x})", "({v})*({to_y})"]{spin}}}
  }},
  "stages": [{{"name": "way", "slide": {{"body": "B", "along": ["{x}", "{y}"], {bend} "gravity": "g", {surface}, {end}}}}}],
  "questions": {{"u": {{"velocity": "B"}}, "w1": {{"spin": "B"}}, "K": {{"energy": "lost"}}, "X": {{"reaction": "way", "along": "x"}},
    "Y": {{"reaction": "way", "along": "y"}}}}
}}"#
        )
    })
}

/// A block on a plank that moves too, on a belt, or on a spring: on which floor, driven by what, and how that begins and ends.
fn on_what_gives() -> impl Strategy<Value = String> {
    let along = select(vec![
        ["1", "0"],
        ["-1", "0"],
        ["3/5", "-4/5"],
        ["-4/5", "3/5"],
    ]);
    let other = select(vec![
        r#""friction": "mu", "on": {"body": "C"}"#,
        r#""friction": "mu", "on": {"body": "C", "friction": "nu"}"#,
        r#""friction": "mu", "on": {"body": "C", "force": "-F"}"#,
        r#""friction": "mu", "with": ["D"], "on": {"body": "C", "friction": "nu"}, "force": "F""#,
        r#""friction": "mu", "on": {"body": "C", "with": ["D"]}, "force": "-F""#,
        r#""friction": "mu", "on": {"body": "belt"}"#,
        r#""friction": "mu", "with": ["D"], "on": {"body": "belt"}, "force": "F""#,
        r#""spring": {"stiffness": "k"}"#,
        r#""friction": "mu", "with": ["D"], "spring": {"stiffness": "k"}, "force": "F""#,
        r#""friction": "mu", "spring": {"stiffness": "k", "relaxed": "b"}"#,
        r#""spring": {"stiffness": "k", "relaxed": "-b"}, "force": "F""#,
        r#""rolling": true, "spring": {"stiffness": "k"}"#,
        r#""rolling": true, "spring": {"stiffness": "k", "relaxed": "b"}, "force": "F""#,
    ]);
    let end = select(vec![
        r#""distance": "s""#,
        r#""for": "t""#,
        r#""until": "stops""#,
        r#""until": "together""#,
        r#""until": "rolls""#,
    ]);
    let begin = select(vec![
        ("v", "0"),
        ("0", "0"),
        ("v", "-w"),
        ("v + w", "w"),
        ("-v", "-v - w"),
        ("0", "v"),
        ("v", "v + w"),
    ]);
    (along, other, end, begin).prop_map(|([x, y], other, end, (v, w))| {
        let rides_below = other.contains(r#""on": {"body": "C", "with""#);
        let third = if rides_below { w } else { v };
        let turn = if x.starts_with('-') { "" } else { "-" };
        let body = match () {
            () if other.contains("rolling") => {
                format!(r#""shape": "disk", "radius": "R", "spin": "{turn}({v})/R""#)
            }
            () if end.contains("rolls") => {
                String::from(r#""shape": "ring", "radius": "R", "spin": "w/R""#)
            }
            () => String::from(r#""shape": "particle""#),
        };
        format!(
            r#"{{
  "parameters": {{
    "m": {{"unit": "kg"}}, "M": {{"unit": "kg"}}, "v": {{"unit": "m/s"}}, "w": {{"unit": "m/s"}}, "g": {{"unit": "m/s^2"}},
    "s": {{"unit": "m"}}, "b": {{"unit": "m"}}, "t": {{"unit": "s"}}, "F": {{"unit": "N"}}, "k": {{"unit": "N/m"}},
    "R": {{"unit": "m"}}, "mu": {{"unit": "1"}}, "nu": {{"unit": "1"}}
  }},
  "bodies": {{
    "B": {{{body}, "mass": "m", "velocity": ["({v})*({x})", "({v})*({y})"]}},
    "C": {{"shape": "particle", "mass": "M", "velocity": ["({w})*({x})", "({w})*({y})"]}},
    "belt": {{"shape": "fixed", "velocity": ["({w})*({x})", "({w})*({y})"]}},
    "D": {{"shape": "particle", "mass": "m", "velocity": ["({third})*({x})", "({third})*({y})"]}}
  }},
  "stages": [{{"name": "way", "slide": {{"body": "B", "along": ["{x}", "{y}"], "gravity": "g", {other}, {end}}}}}],
  "questions": {{"u": {{"velocity": "B"}}, "s1": {{"distance": "way"}}, "x": {{"position": "C"}}, "K": {{"energy": "lost"}}}}
}}"#
        )
    })
}

/// A body on a table, an incline or a plumb line, tied over a wheel to what hangs or lies on another incline, and how that
/// begins and ends.
fn over_a_wheel() -> impl Strategy<Value = String> {
    // Direction of the body, its place from the wheel, and the same of the other end.
    let lines = select(vec![
        ([["1", "0"], ["-d", "R"]], [["0", "-1"], ["R", "-b"]]),
        ([["0", "1"], ["-R", "-d"]], [["0", "-1"], ["R", "-b"]]),
        ([["0", "-1"], ["-R", "-d"]], [["0", "1"], ["R", "-b"]]),
        (
            [
                ["cos(a)", "sin(a)"],
                ["-R*sin(a)-d*cos(a)", "R*cos(a)-d*sin(a)"],
            ],
            [["0", "-1"], ["R", "-b"]],
        ),
        (
            [
                ["-cos(a)", "sin(a)"],
                ["R*sin(a)+d*cos(a)", "R*cos(a)-d*sin(a)"],
            ],
            [
                ["-cos(c)", "-sin(c)"],
                ["-R*sin(c)-b*cos(c)", "R*cos(c)-b*sin(c)"],
            ],
        ),
        // Two wheels, the second to the right of the first.
        ([["0", "1"], ["-R", "-d"]], [["0", "-1"], ["q+R", "-b"]]),
        ([["1", "0"], ["-d", "R"]], [["0", "-1"], ["q+R", "-b"]]),
    ]);
    let wheel = select(vec!["0", "0", "J"]);
    let surfaces = select(vec![
        ("", ""),
        (r#""friction": "mu","#, ""),
        (r#""friction": "mu", "force": "F","#, ""),
        ("", r#""friction": "nu","#),
        (r#""force": "-F","#, ""),
    ]);
    let end = select(vec![
        r#""distance": "s""#,
        r#""for": "t""#,
        r#""until": "stops""#,
    ]);
    let begin = select(vec!["v", "0"]);
    let rider = any::<bool>();
    (lines, wheel, surfaces, end, begin, rider).prop_map(
        |(lines, wheel, (own, other), end, v, rider)| {
            let ([[ux, uy], [x, y]], [[wx, wy], [p, q]]) = lines;
            let over = if p.contains('q') { r#""P", "Q""# } else { r#""P""# };
            let with = if rider { r#""with": ["B2"],"# } else { "" };
            // A plumb line has no surface.
            let own = if ux == "0" { "" } else { own };
            let other = if wx == "0" { "" } else { other };
            format!(
                r#"{{
  "parameters": {{
    "m": {{"unit": "kg"}}, "M": {{"unit": "kg"}}, "J": {{"unit": "kg"}}, "R": {{"unit": "m"}}, "v": {{"unit": "m/s"}},
    "g": {{"unit": "m/s^2"}}, "s": {{"unit": "m"}}, "t": {{"unit": "s"}}, "F": {{"unit": "N"}}, "mu": {{"unit": "1"}},
    "nu": {{"unit": "1"}}, "b": {{"unit": "m"}}, "d": {{"unit": "m"}}, "q": {{"unit": "m"}},
    "a": {{"unit": "rad", "domain": {{"min": 0, "max": "pi/2"}}}}, "c": {{"unit": "rad", "domain": {{"min": 0, "max": "pi/2"}}}}
  }},
  "bodies": {{
    "P": {{"shape": "disk", "mass": "{wheel}", "radius": "R", "center": ["0", "0"], "spin": "SPIN"}},
    "Q": {{"shape": "ring", "mass": "M", "radius": "R", "center": ["q", "0"], "spin": "SPIN"}},
    "B": {{"shape": "particle", "mass": "m", "center": ["{x}", "{y}"], "velocity": ["({v})*({ux})", "({v})*({uy})"]}},
    "B2": {{"shape": "particle", "mass": "M", "center": ["{x}", "{y}"], "velocity": ["({v})*({ux})", "({v})*({uy})"]}},
    "C": {{"shape": "particle", "mass": "M", "center": ["{p}", "{q}"], "velocity": ["({v})*({wx})", "({v})*({wy})"]}}
  }},
  "stages": [{{"name": "way", "slide": {{"body": "B", {with} "along": ["{ux}", "{uy}"], "gravity": "g", {own} {end},
    "strings": [{{"to": ["C"], {other} "along": ["{wx}", "{wy}"], "over": [{over}]}}]}}}}],
  "questions": {{"u": {{"velocity": "C"}}, "w1": {{"spin": "P"}}, "K": {{"energy": "lost"}}}}
}}"#
            )
            .replace("SPIN", &wheel_spin([ux, uy], v))
        },
    )
}

/// Bodies with one freedom, in motion or at rest: a rod between two guides, two rods on a floor, a bead on a wire, a yoke.
fn of_one_freedom() -> impl Strategy<Value = String> {
    let linkage = select(vec![
        r#""A": {"shape": "rod", "mass": "m", "length": "L", "angle": "-q", "center": ["L/2*cos(q)", "L/2*sin(q)"],
            "velocity": ["-L/2*sin(q)*(RATE)", "L/2*cos(q)*(RATE)"], "spin": "-(RATE)"}"#,
        r#""A": {"shape": "rod", "mass": "m", "length": "L", "angle": "q", "center": ["-L/2*cos(q)", "L/2*sin(q)"],
            "velocity": ["L/2*sin(q)*(RATE)", "L/2*cos(q)*(RATE)"], "spin": "RATE"},
           "B": {"shape": "rod", "mass": "M", "length": "L", "angle": "-q", "center": ["L/2*cos(q)", "L/2*sin(q)"],
            "velocity": ["-L/2*sin(q)*(RATE)", "L/2*cos(q)*(RATE)"], "spin": "-(RATE)"}"#,
        r#""A": {"shape": "particle", "mass": "m", "center": ["L*sin(q)", "L*sin(q)^2"],
            "velocity": ["L*cos(q)*(RATE)", "2*L*sin(q)*cos(q)*(RATE)"]}"#,
        r#""A": {"shape": "ring", "mass": "m", "radius": "L", "angle": "q", "center": [0, 0], "spin": "RATE"},
           "B": {"shape": "particle", "mass": "M", "center": ["2*L", "L*sin(q)"], "velocity": [0, "L*cos(q)*(RATE)"]}"#,
    ]);
    let course = select(vec![
        (r#""to": "b", "gravity": "g""#, "b < q", "0"),
        (r#""to": "b", "gravity": "g""#, "b < q", "-w"),
        (r#""to": "b""#, "b < q", "-w"),
        (r#""to": "b", "gravity": "g""#, "b > q", "w"),
        (r#""to": "b""#, "b > q", "w"),
    ]);
    (linkage, course).prop_map(|(bodies, (course, relation, rate))| {
        format!(
            r#"{{
  "parameters": {{
    "m": {{"unit": "kg"}}, "M": {{"unit": "kg"}}, "L": {{"unit": "m"}}, "w": {{"unit": "rad/s"}}, "g": {{"unit": "m/s^2"}},
    "q": {{"unit": "rad", "domain": {{"min": "pi/12", "max": "5*pi/12"}}}},
    "b": {{"unit": "rad", "domain": {{"min": "pi/12", "max": "5*pi/12"}}}}
  }},
  "relations": ["{relation}"],
  "bodies": {{{}}},
  "stages": [{{"name": "way", "linkage": {{"coordinate": "q", {course}}}}}],
  "questions": {{"u": {{"velocity": "A"}}, "K": {{"energy": "lost"}}}}
}}"#,
            bodies.replace("RATE", rate)
        )
    })
}

/// What a particle sticks to, and how the two fly on as one until the body meets a peg, or not.
fn flies_as_one() -> impl Strategy<Value = String> {
    let body = select(vec![
        (
            r#""shape": "rod", "length": "2*L", "angle": "pi/2""#,
            ["0", "L"],
        ),
        (
            r#""shape": "rod", "length": "2*L", "angle": "0""#,
            ["-L/2", "0"],
        ),
        (r#""shape": "disk", "radius": "L""#, ["3/5*L", "4/5*L"]),
        (
            r#""shape": "rectangle", "width": "2*L", "height": "L""#,
            ["L", "L/4"],
        ),
    ]);
    let way = select(vec![["1", "0"], ["0", "-1"], ["-3", "2"], ["1", "1"]]);
    let spin = select(vec!["0", "v/L", "-2*v/L"]);
    let end = select(vec![
        r#""for": "t""#,
        r#""by": "pi/2""#,
        r#""by": "2*pi/3""#,
        r#""by": "b""#,
    ]);
    let gravity = select(vec!["", r#""gravity": "g","#]);
    let stuck_before = any::<bool>();
    let then = any::<bool>();
    (body, way, spin, end, gravity, stuck_before, then).prop_map(
        |((shape, [x, y]), [u, v], spin, end, gravity, two, then)| {
            let with = if two { r#"["C", "D"]"# } else { r#"["C"]"# };
            let far = if two { "" } else { "-9*L" };
            let meets = match then {
                true => format!(
                    r#", {{"name": "meet", "impact": {{"contacts": {{"E": {{"bodies": ["peg", "B"],
      "at": {{"from": "B", "by": ["-({x})", "-({y})"]}}, "law": "sticking"}}}}}}}}"#
                ),
                false => String::new(),
            };
            format!(
                r#"{{
  "parameters": {{
    "m": {{"unit": "kg"}}, "L": {{"unit": "m"}}, "v": {{"unit": "m/s"}}, "g": {{"unit": "m/s^2"}}, "t": {{"unit": "s"}},
    "b": {{"unit": "rad", "domain": {{"min": 0, "max": "pi"}}}}
  }},
  "bodies": {{
    "peg": {{"shape": "fixed"}},
    "B": {{{shape}, "mass": "3*m", "center": ["0", "0"], "velocity": ["0", "v"], "spin": "{spin}"}},
    "C": {{"shape": "particle", "mass": "m", "center": ["{x}", "{y}"], "velocity": ["2*v*({u})", "v*({v})"]}},
    "D": {{"shape": "particle", "mass": "2*m", "center": ["-({x})/2{far}", "-({y})/2"], "velocity": ["0", "0"]}}
  }},
  "stages": [{{"name": "stick", "impact": {{"contacts": {{"C": {{"bodies": ["B", "C"], "law": "sticking"}}{}}}}}}},
    {{"name": "fly", "fall": {{"body": "B", "with": {with}, {gravity} {end}}}}}{meets}],
  "questions": {{"x": {{"position": "B", "at": "fly"}}, "y": {{"position": "C", "at": "fly"}}, "u": {{"velocity": "C", "at": "fly"}},
    "w1": {{"spin": "B"}}}}
}}"#,
                if two { r#", "D": {"bodies": ["B", "D"], "law": "sticking"}"# } else { "" }
            )
        },
    )
}

/// How the wheel turns while its string moves: backwards where the body that comes to it passes above.
fn wheel_spin([ux, uy]: [&str; 2], v: &str) -> String {
    let clockwise = match ux {
        "0" => uy == "1",
        _ => !ux.starts_with('-'),
    };
    format!("{}({v})/R", if clockwise { "-" } else { "" })
}

#[test]
fn what_moves_along_a_line_is_followed_to_the_same_end() {
    same_end(on_a_line());
}

#[test]
fn what_slides_on_a_body_or_a_spring_is_followed_to_the_same_end() {
    same_end(on_what_gives());
}

#[test]
fn what_is_tied_over_a_wheel_is_followed_to_the_same_end() {
    same_end(over_a_wheel());
}

#[test]
fn what_has_one_freedom_is_followed_to_the_same_end() {
    same_end(of_one_freedom());
}

#[test]
fn what_is_stuck_together_flies_to_the_same_end() {
    same_end(flies_as_one());
}

#[test]
fn what_impacts_leave_open_is_open_in_numbers_too() {
    same_end(whole::scene());
}

fn same_end(stories: impl Strategy<Value = String>) {
    use std::sync::atomic::{AtomicU32, Ordering};
    let (followed, told) = (AtomicU32::new(0), AtomicU32::new(0));
    let mut config = ProptestConfig::default();
    config.cases = config.cases * 3 / 8;
    proptest!(config, |(text in stories)| {
        let text = match text.contains(r#""B": {"shape": "particle"#) {
            true => text.replace(r#""w1": {"spin": "B"}, "#, ""),
            false => text,
        };
        // A point does not roll, and a body that rolls does not slip: such scenes are refused by the reader.
        let Ok(scene) = read(&text) else {
            return Ok(());
        };
        let Ok(found) = tell(&scene) else {
            return Ok(());
        };
        told.fetch_add(1, Ordering::Relaxed);
        let checks: Vec<_> = found.stages.iter().flat_map(|s| &s.checks).collect();
        let wrong: Vec<_> = checks.iter().filter(|c| c.holds == Some(false)).collect();
        prop_assert!(wrong.is_empty() && found.holds(), "{wrong:?}\n{text}");
        if checks.iter().any(|c| c.kind == "integration" && c.holds == Some(true)) {
            followed.fetch_add(1, Ordering::Relaxed);
        }
    });
    let (followed, told) = (followed.into_inner(), told.into_inner());
    assert!(
        told > 20 && 10 * followed > 9 * told,
        "{followed} of {told} are followed"
    );
}

/// Draws half of the cases on each of two threads.
fn halves(test: impl Fn(ProptestConfig) + Sync) {
    std::thread::scope(|scope| {
        for half in 0..2 {
            let test = &test;
            scope.spawn(move || {
                let mut config = ProptestConfig::default();
                config.cases = config.cases.div_ceil(2);
                if let RngSeed::Fixed(seed) = config.rng_seed {
                    config.rng_seed = RngSeed::Fixed(seed + half);
                }
                test(config);
            });
        }
    });
}

/// A body that falls or is there already, hits rough ground at one point and flies on; values pick what the contact does.
fn on_rough_ground() -> impl Strategy<Value = String> {
    let body = select(vec![
        (r#""shape": "sphere", "radius": "L""#, ["0", "-L"]),
        (r#""shape": "ring", "radius": "L""#, ["0", "-L"]),
        (
            r#""shape": "rod", "length": "2*L", "angle": "a""#,
            ["-L*cos(a)", "-L*sin(a)"],
        ),
        (
            r#""shape": "rectangle", "width": "2*L", "height": "L/2""#,
            ["-L", "-L/4"],
        ),
    ]);
    let law = select(vec![
        r#""hypothesis": "newton""#,
        r#""hypothesis": "poisson""#,
        r#""hypothesis": "poisson""#,
        r#""hypothesis": "stronge""#,
        r#""hypothesis": "chatterjee-ruina", "tangential_restitution": "1/2""#,
        r#""hypothesis": "brach""#,
    ]);
    let first = select(vec![
        r#"{"name": "drop", "fall": {"body": "B", "gravity": "g", "height": "h"}}, "#,
        r#"{"name": "drop", "fall": {"body": "B", "gravity": "g", "for": "t"}}, "#,
        "",
    ]);
    // Cases in symbols take long.
    let numbers = (
        1..40i32,
        -30..30i32,
        -30..30i32,
        0..11i32,
        prop::bool::weighted(0.75),
    );
    (body, law, first, numbers).prop_map(|((shape, at), law, first, (mu, u, w, e, has_values))| {
        let [x, y] = at;
        let value = |number: String| match has_values {
            true => format!(r#", "value": "{number}""#),
            false => String::new(),
        };
        let given = [("m", "kg", "2"), ("L", "m", "1/2"), ("g", "m/s^2", "10"), ("h", "m", "1"), ("t", "s", "1/4")];
        let given = given.map(|(name, unit, v)| format!(r#""{name}": {{"unit": "{unit}"{}}}"#, value(v.into())));
        let spin = match shape.contains("rod") || shape.contains("rectangle") {
            // A place on the ground that does not turn away while it falls.
            true if !first.is_empty() => String::from("0"),
            _ => format!("{w}/4*v/L"),
        };
        format!(
            r#"{{
  "parameters": {{{}, "v": {{"unit": "m/s"{}}}, "mu": {{"unit": "1"{}}},
    "a": {{"unit": "rad", "domain": {{"min": 0, "max": "pi/2"}}{}}}
  }},
  "bodies": {{
    "G": {{"shape": "fixed"}},
    "B": {{{shape}, "mass": "m", "center": ["0", "0"], "velocity": ["{u}/4*v", "-v"], "spin": "{spin}"}}
  }},
  "stages": [{first}
    {{"name": "bounce", "impact": {{"contacts": {{"C": {{"bodies": ["G", "B"], "at": {{"from": "B", "by": ["{x}", "{y}"]}},
      "normal": "y", "law": "friction", "mu": "mu", "restitution": "{e}/10", {law}}}}}}}}},
    {{"name": "on", "fall": {{"body": "B", "gravity": "g", "for": "t"}}}}],
  "questions": {{"u": {{"velocity": "B", "at": "bounce"}}, "w1": {{"spin": "B"}}, "x": {{"position": "B"}}, "K": {{"energy": "lost", "at": "bounce"}}}}
}}"#,
            given.join(", "),
            value("1".into()),
            value(format!("{mu}/20")),
            value("acos(4/5)".into()),
        )
    })
}

#[test]
fn what_bounces_on_rough_ground_is_followed_to_the_same_end() {
    use std::sync::atomic::{AtomicU32, Ordering};
    let (followed, told) = (AtomicU32::new(0), AtomicU32::new(0));
    halves(|mut config| {
        config.cases /= 8;
        proptest!(config, |(text in on_rough_ground())| {
            let scene = read(&text).map_err(|f| TestCaseError::fail(f.render("story", &text)))?;
            let found = match tell(&scene) {
                Ok(found) => found,
                // The corner leaves the ground whatever the parameters.
                Err(why) if why.to_string().contains("move apart") => return Ok(()),
                Err(why) => return Err(TestCaseError::fail(format!("{why}\n{text}"))),
            };
            // A box that lies flat may not turn into the ground.
            let goes = |why: &String| ["separate", "pass through"].iter().any(|words| why.contains(words));
            if found.refusals().iter().any(goes) {
                return Ok(());
            }
            told.fetch_add(1, Ordering::Relaxed);
            let stages = found.stages.iter().flat_map(|s| &s.checks);
            let all = stages.chain(found.answers.iter().flat_map(|a| &a.checks));
            let wrong: Vec<_> = all.filter(|c| c.holds == Some(false)).collect();
            prop_assert!(wrong.is_empty() && found.holds(), "{wrong:?} {:?}\n{text}", found.refusals());
            let mut ends = found.stages.iter().filter(|s| s.placed.name == "on").flat_map(|s| &s.checks);
            if ends.any(|c| c.kind == "integration" && c.holds == Some(true)) {
                followed.fetch_add(1, Ordering::Relaxed);
            }
        })
    });
    let (followed, told) = (followed.into_inner(), told.into_inner());
    assert!(
        10 * followed > 9 * told,
        "{followed} of {told} are followed"
    );
}

#[test]
fn every_check_of_a_random_story_holds_and_many_stories_can_be_told() {
    use std::sync::atomic::{AtomicU32, Ordering};
    let (told, all) = (AtomicU32::new(0), AtomicU32::new(0));
    halves(|config| {
        proptest!(config, |(course in course())| {
            all.fetch_add(1, Ordering::Relaxed);
            let text = course.text();
            let scene = read(&text).map_err(|f| TestCaseError::fail(f.render("story", &text)))?;
            // One impact alone is no story.
            if !scene.has_stages() {
                return Ok(());
            }
            // Many courses contradict themselves: a sense that is not the motion's, an end that is never reached.
            let Ok(found) = tell(&scene) else {
                return Ok(());
            };
            // What moved away meets nothing there, and what turned shows another side.
            let elsewhere = |why: &String| ["does not lie on", "none of the outline"].iter().any(|words| why.contains(words));
            if found.refusals().iter().any(elsewhere) {
                return Ok(());
            }
            told.fetch_add(1, Ordering::Relaxed);
            let stages = found.stages.iter().flat_map(|s| &s.checks);
            let wrong: Vec<_> = stages
                .chain(found.answers.iter().flat_map(|a| &a.checks))
                .filter(|c| c.holds == Some(false))
                .map(|c| &c.words)
                .collect();
            prop_assert!(wrong.is_empty() && found.holds(), "{wrong:?}\n{text}");
            for a in &found.answers {
                prop_assert!(a.formula().is_none() || !a.checks.is_empty(), "{} is not marked\n{text}", a.name);
            }
        })
    });
    let (told, all) = (told.into_inner(), all.into_inner());
    assert!(3 * told > all, "{told} of {all} stories are told");
}
