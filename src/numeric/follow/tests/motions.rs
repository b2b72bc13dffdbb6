//! Motions against the laws of the textbook, energies taken apart from the motion, and backwards in time.

use super::*;

/// A uniform rod pinned at the origin, at the angle `a` to the right, with the spin `w`; then one stage.
fn pendulum(stage: &str) -> Scene {
    read(&format!(
        r#"{{"title": "t", "parameters": {{"m": {{"unit": "kg"}}, "l": {{"unit": "m"}}, "g": {{"unit": "m/s^2"}},
            "a": {{"unit": "rad", "domain": {{"min": "-pi", "max": "pi"}}}}, "w": {{"unit": "rad/s", "domain": "real"}}}},
        "points": {{"O": ["0", "0"]}},
        "bodies": {{"pivot": {{"shape": "fixed"}}, "rod": {{"shape": "rod", "mass": "m", "length": "l", "angle": "a",
            "center": {{"from": "O", "distance": "l/2", "angle": "a"}}, "velocity": {{"about": "O"}}, "spin": "w"}}}},
        "stages": [{{"name": "swing", "turn": {{"body": "rod", "about": "O", {stage}}}}}],
        "questions": {{"omega": {{"at": "swing", "spin": "rod"}}}}}}"#
    ))
}

fn swung(stage: &str, m: f64, l: f64, g: f64, a: f64, w: f64) -> Result<Passed, Lost> {
    let at = point(&[("m", m), ("l", l), ("g", g), ("a", a), ("w", w)]);
    let mut followed = follow(&pendulum(stage), &at).expect("numbers");
    followed.stages.remove(0)
}

#[test]
fn a_pendulum_gains_in_speed_what_its_center_loses_in_height() {
    for (m, l, g, a, w) in [
        (1.0, 1.0, 10.0, 0.0, 0.0),
        (3.0, 0.2, 9.81, 0.4, -1.0),
        (0.01, 50.0, 1.6, 2.0, -0.3),
        (1e4, 2.0, 9.81, -0.3, -2.0),
    ] {
        let stage = r#""until": "below", "gravity": "g""#;
        let passed = swung(stage, m, l, g, a, w).expect("it swings down");
        let rod = &passed.after.bodies[1];
        let spin = value_of(&rod.spin);
        let sunk = l / 2.0 * (1.0 + a.sin());
        let inertia = m * l * l / 3.0;
        close(
            0.5 * inertia * spin * spin,
            0.5 * inertia * w * w + m * g * sunk,
            1e-9,
        );
        close(
            value_of(&passed.energy[1]),
            0.5 * inertia * spin * spin,
            1e-9,
        );
        close(value_of(&rod.center[1]), -l / 2.0, 1e-9);
        assert!(value_of(&rod.center[0]).abs() < 1e-9 * l);
        // At the lowest place the point carries the weight and leads the center round.
        let What::Motion(moved) = &passed.what else {
            panic!("a motion")
        };
        let [_, end] = moved.reaction.as_ref().expect("a fixed point");
        close(value_of(&end[1]), m * g + m * spin * spin * l / 2.0, 1e-9);
        assert!(value_of(&end[0]).abs() < 1e-6 * m * g);
        let last = moved.samples.last().expect("samples");
        close(last.time, value_of(&passed.time), 1e-12);
        close(last.poses[0][1], -l / 2.0, 1e-9);
    }
}

#[test]
fn a_level_rod_let_go_rests_on_its_pin_with_a_quarter_of_its_weight() {
    let passed = swung(
        r#""by": "pi/2", "gravity": "g", "clockwise": true"#,
        2.0,
        3.0,
        10.0,
        0.0,
        0.0,
    );
    let passed = passed.expect("it swings");
    let What::Motion(moved) = &passed.what else {
        panic!("a motion")
    };
    let [begin, _] = moved.reaction.as_ref().expect("a fixed point");
    close(value_of(&begin[1]), 2.0 * 10.0 / 4.0, 1e-12);
    assert_eq!(moved.clockwise, Some(true));
}

#[test]
fn small_swings_take_a_quarter_of_the_period() {
    let (l, g, small) = (0.7, 9.81, 1e-4);
    let stage = r#""until": "below", "gravity": "g""#;
    let passed = swung(stage, 1.0, l, g, -PI / 2.0 + small, 0.0).expect("it swings");
    let period = TAU * (2.0 * l / (3.0 * g)).sqrt();
    close(value_of(&passed.time), period / 4.0, 1e-7);
}

#[test]
fn without_moments_the_spin_stays() {
    let passed = swung(r#""for": "3/2""#, 1.0, 2.0, 10.0, 0.3, -4.0).expect("it turns");
    let rod = &passed.after.bodies[1];
    close(value_of(&rod.spin), -4.0, 1e-12);
    close(value_of(&rod.angle), 0.3 - 6.0, 1e-11);
    close(value_of(&rod.center[0]), (0.3f64 - 6.0).cos(), 1e-10);
    close(value_of(&rod.center[1]), (0.3f64 - 6.0).sin(), 1e-10);
}

#[test]
fn a_swing_that_is_too_slow_turns_back() {
    // To the top the rod needs w² = 6g/l from below.
    let stage = r#""until": "above", "gravity": "g""#;
    let needed = (6.0f64 * 10.0 / 2.0).sqrt();
    let up = |w| swung(stage, 1.0, 2.0, 10.0, -PI / 2.0, w);
    assert!(matches!(
        up(0.999 * needed),
        Err(Lost {
            why: Loss::NeverEnds(_),
            ..
        })
    ));
    assert!(up(1.001 * needed).is_ok());
    let by = |w| {
        swung(
            r#""by": "pi", "gravity": "g""#,
            1.0,
            2.0,
            10.0,
            -PI / 2.0,
            w,
        )
    };
    assert!(matches!(
        by(0.999 * needed),
        Err(Lost {
            why: Loss::NeverEnds(_),
            ..
        })
    ));
    let spin = value_of(&by(1.001 * needed).expect("over the top").after.bodies[1].spin);
    close(spin, needed * (1.001f64.powi(2) - 1.0).sqrt(), 1e-6);
}

#[test]
fn what_goes_up_and_comes_back_passes_the_lowest_place_the_other_way() {
    let passed = swung(
        r#""until": "below", "gravity": "g""#,
        1.0,
        2.0,
        10.0,
        0.0,
        1.0,
    );
    let spin = value_of(&passed.expect("it comes down").after.bodies[1].spin);
    close(spin, -(1.0f64 + 3.0 * 10.0 / 2.0).sqrt(), 1e-9);
}

#[test]
fn a_balanced_rod_needs_a_push_and_a_sense() {
    let up = PI / 2.0;
    let stage = r#""until": "below", "gravity": "g", "clockwise": true"#;
    let passed = swung(stage, 1.0, 2.0, 10.0, up, 0.0).expect("it falls over");
    close(
        value_of(&passed.after.bodies[1].spin),
        -30.0f64.sqrt(),
        1e-9,
    );
    assert_eq!(passed.time.expect_err("not known").why, Why::Push);
    let stage = r#""until": "below", "gravity": "g""#;
    let silent = swung(stage, 1.0, 2.0, 10.0, up, 0.0);
    assert!(matches!(
        silent,
        Err(Lost {
            why: Loss::Contradiction(_),
            ..
        })
    ));
    let hanging = swung(
        r#""by": "1", "gravity": "g", "clockwise": true"#,
        1.0,
        2.0,
        10.0,
        -up,
        0.0,
    );
    assert!(matches!(
        hanging,
        Err(Lost {
            why: Loss::NeverEnds(_),
            ..
        })
    ));
}

#[test]
fn a_motion_run_backwards_ends_where_it_began() {
    for (a, w, time) in [(0.3, 2.0, 0.7), (-1.0, -3.0, 0.4), (2.0, 0.5, 1.1)] {
        let stage = format!(r#""by": "{time}", "gravity": "g""#);
        let there = match swung(&stage, 1.3, 0.8, 9.81, a, w) {
            Ok(there) => there,
            Err(Lost {
                why: Loss::NeverEnds(_),
                ..
            }) => continue,
            Err(lost) => panic!("{lost}"),
        };
        let end = &there.after.bodies[1];
        let back = swung(
            &stage,
            1.3,
            0.8,
            9.81,
            value_of(&end.angle),
            -value_of(&end.spin),
        );
        let back = back.expect("the way back");
        close(value_of(&back.after.bodies[1].angle), a, 1e-9);
        close(value_of(&back.after.bodies[1].spin), -w, 1e-9);
        close(value_of(&back.time), value_of(&there.time), 1e-9);
    }
}

/// A rod that flies, and perhaps turns, then one stage.
fn flier(stage: &str) -> Scene {
    read(&format!(
        r#"{{"title": "t", "parameters": {{"g": {{"unit": "m/s^2"}}, "u": {{"unit": "m/s", "domain": "real"}},
            "v": {{"unit": "m/s", "domain": "real"}}, "w": {{"unit": "rad/s", "domain": "real"}}}},
        "bodies": {{"ground": {{"shape": "fixed"}}, "rod": {{"shape": "rod", "mass": "2", "length": "3", "angle": "1/5",
            "center": ["1", "2"], "velocity": ["u", "v"], "spin": "w"}},
            "ball": {{"shape": "particle", "mass": "1", "center": ["50", "0"], "velocity": ["7", "0"]}}}},
        "stages": [{{"name": "flight", "fall": {{"body": "rod", {stage}}}}}],
        "questions": {{"omega": {{"at": "flight", "spin": "rod"}}}}}}"#
    ))
}

fn flown(stage: &str, g: f64, [u, v, w]: [f64; 3]) -> Result<Passed, Lost> {
    let at = point(&[("g", g), ("u", u), ("v", v), ("w", w)]);
    let mut followed = follow(&flier(stage), &at).expect("numbers");
    followed.stages.remove(0)
}

#[test]
fn a_flight_moves_and_turns_the_body_and_others_wait_until_they_begin() {
    let passed = flown(r#""for": "2", "gravity": "g""#, 9.0, [3.0, 4.0, 0.5]).expect("it flies");
    let [x, y, angle, u, v, w] = passed.after.bodies[1].components().map(value_of);
    close(x, 1.0 + 6.0, 1e-12);
    close(y, 2.0 + 8.0 - 18.0, 1e-12);
    close(angle, 0.2 + 1.0, 1e-12);
    close(u, 3.0, 1e-12);
    close(v, 4.0 - 18.0, 1e-12);
    close(w, 0.5, 1e-12);
    assert_eq!(passed.after.bodies[2], passed.before.bodies[2]);
}

#[test]
fn places_on_the_way_of_a_low_hop_lie_on_it() {
    // Some of its heights differ by rounding alone, and the top may lie just before a sample.
    for speed in [3e-4, 4.3e-6, 7e-7, 5.1e-8] {
        let hop = flown(r#""height": 0, "gravity": "g""#, 340.0, [93.8, speed, 0.1]);
        let hop = hop.expect("it comes down");
        let What::Motion(moved) = &hop.what else {
            panic!("a motion");
        };
        let [first, last] = [&moved.samples[0], &moved.samples[moved.samples.len() - 1]];
        for k in 0..=1000 {
            let time = last.time * f64::from(k) / 1000.0;
            let [x, y, _] = moved.pose(0, time);
            assert!(
                (y - first.poses[0][1]).abs() < 1e-9,
                "{y} after {time} at {speed}"
            );
            assert!(x > first.poses[0][0] - 1e-9 && x < last.poses[0][0] + 1e-9);
        }
    }
}

#[test]
fn what_sticks_and_turns_flies_about_its_common_center_whatever_happens_elsewhere() {
    let stuck = |place: &str| {
        let scene = read(&format!(
            r#"{{"title": "t", "parameters": {{}},
            "bodies": {{"rod": {{"shape": "rod", "mass": "2", "length": "4", "center": ["0", "0"]}},
                "clay": {{"shape": "particle", "mass": "1", "center": ["{place}", "0"], "velocity": ["0", "3"]}},
                "a": {{"shape": "particle", "mass": "1", "center": ["9", "0"], "velocity": ["1", "0"]}},
                "b": {{"shape": "particle", "mass": "1", "center": ["9", "0"]}}}},
            "stages": [
                {{"name": "stick", "impact": {{"contacts": {{"C": {{"bodies": ["rod", "clay"], "law": "sticking"}}}}}}}},
                {{"name": "elsewhere", "impact": {{"contacts": {{"D": {{"bodies": ["a", "b"], "law": "sticking"}}}}}}}},
                {{"name": "fly", "fall": {{"body": "rod", "with": ["clay"], "for": "1"}}}}],
            "questions": {{"omega": {{"at": "stick", "spin": "rod"}}}}}}"#
        ));
        let followed = follow(&scene, &point(&[])).expect("numbers");
        let mut stages = followed.stages.into_iter();
        let flown = stages.nth(2).expect("a flight").expect("it is followed");
        let end = [0, 1].map(|b| flown.after.bodies[b].components().map(value_of));
        // A stage by itself, as a picture shows it, knows what is stuck.
        let mut alone = scene.clone();
        let mut fly = alone.stages.remove(2);
        fly.from = None;
        for (body, state) in alone.bodies.iter_mut().zip(&flown.before.bodies) {
            let [.., u, v, w] = state.components().map(value_of);
            let fraction = |x: f64| crate::expr::Expr::ratio((x * 30.0).round() as i64, 30);
            (body.velocity, body.spin) = ([u, v].map(fraction), fraction(w));
        }
        alone.stages = vec![fly];
        let alone = follow(&alone, &point(&[]))
            .expect("numbers")
            .stages
            .remove(0);
        let alone = alone.expect("it is followed");
        for (b, end) in end.iter().enumerate() {
            let found = alone.after.bodies[b].components().map(value_of);
            for (found, expected) in found.into_iter().zip(*end) {
                close(found, expected, 1e-10);
            }
        }
        end
    };
    let [rod, clay] = stuck("0");
    for body in [rod, clay] {
        close(body[1], 1.0, 1e-10);
    }
    // Mass 3 with its center at 1/3 goes at 1 m/s; H = 2 and I = 8/3 + 2/3 about it.
    let [rod, clay] = stuck("1");
    let (s, c) = 0.6_f64.sin_cos();
    let expected = [
        (rod[0], (1.0 - c) / 3.0),
        (rod[1], 1.0 - s / 3.0),
        (rod[2], 0.6),
        (clay[0], (1.0 + 2.0 * c) / 3.0),
        (clay[1], 1.0 + 2.0 * s / 3.0),
        (clay[3], -0.4 * s),
        (clay[4], 1.0 + 0.4 * c),
    ];
    for (found, expected) in expected {
        close(found, expected, 1e-10);
    }
}

#[test]
fn rods_that_stick_at_two_places_turn_as_one_and_at_one_place_are_not_followed() {
    let locked = |second: &str| {
        let scene = read(&format!(
            r#"{{"title": "t", "parameters": {{}}, "points": {{"C": ["0", "1"], "D": ["0", "{second}"]}},
            "bodies": {{"one": {{"shape": "rod", "mass": "1", "length": "2", "angle": "pi/2", "center": ["0", "0"], "velocity": ["8", "0"]}},
                "other": {{"shape": "rod", "mass": "1", "length": "2", "angle": "pi/2", "center": ["0", "2"]}}}},
            "stages": [
                {{"name": "lock", "impact": {{"contacts": {{
                    "C": {{"bodies": ["one", "other"], "at": "C", "law": "sticking"}},
                    "D": {{"bodies": ["one", "other"], "at": "D", "law": "sticking"}}}}}}}},
                {{"name": "fly", "fall": {{"body": "one", "with": ["other"], "for": "1"}}}}],
            "questions": {{"omega": {{"at": "lock", "spin": "one"}}}}}}"#
        ));
        let followed = follow(&scene, &point(&[])).expect("numbers");
        followed.stages.into_iter().nth(1).expect("a flight")
    };
    // A rod of mass 2 and length 4 goes on at 4 m/s; H = 8 and I = 8/3 about its center.
    let flown = locked("3/2").expect("it is followed");
    let [x, y, angle, ..] = flown.after.bodies[0].components().map(value_of);
    let expected = [
        (x, 4.0 + 3_f64.sin()),
        (y, 1.0 - 3_f64.cos()),
        (angle - PI / 2.0, 3.0),
    ];
    for (found, expected) in expected {
        close(found, expected, 1e-10);
    }
    // Two joints at one place are one, about which the rods turn against each other.
    assert!(locked("1").is_err());
}

#[test]
fn a_fall_through_a_height_ends_on_the_way_down() {
    let fall = r#""height": "5/2", "gravity": "g""#;
    for v in [-3.0, 0.0, 4.0] {
        let passed = flown(fall, 9.0, [0.0, v, 2.0]).expect("it falls");
        let [_, y, angle, _, end, _] = passed.after.bodies[1].components().map(value_of);
        let expected = -(v * v + 2.0 * 9.0 * 2.5f64).sqrt();
        close(end, expected, 1e-10);
        close(y, -0.5, 1e-10);
        close(value_of(&passed.time), (v - expected) / 9.0, 1e-10);
        close(angle, 0.2 + 2.0 * (v - expected) / 9.0, 1e-10);
    }
    let up = r#""height": "-1", "gravity": "g""#;
    assert!(matches!(
        flown(up, 10.0, [0.0, 4.4, 0.0]),
        Err(Lost {
            why: Loss::NeverEnds(_),
            ..
        })
    ));
    let passed = flown(up, 10.0, [0.0, 4.6, 0.0]).expect("it gets there");
    close(
        value_of(&passed.after.bodies[1].velocity[1]),
        -(4.6f64 * 4.6 - 20.0).sqrt(),
        1e-8,
    );
}

#[test]
fn a_block_slides_off_the_end_of_a_cart() {
    // It would come to rest on the cart after v²/(2 μ g (1 + m/M)) = 2 m.
    let slide = |width: &str, along: &str, from: &str| {
        let text = format!(
            r#"{{"title": "t", "parameters": {{"v": {{"unit": "m/s"}}}},
            "bodies": {{"cart": {{"shape": "rectangle", "mass": "1", "width": "{width}", "height": "1", "center": ["0", "0"]}},
                "block": {{"shape": "particle", "mass": "1", "center": ["{from}", "1/2"], "velocity": ["{along}4", "0"]}}}},
            "stages": [{{"name": "slip", "slide": {{"body": "block", "along": "{along}x", "on": {{"body": "cart"}}, "friction": "1/5",
                "gravity": "10", "until": "together"}}}}],
            "questions": {{"u": {{"at": "slip", "velocity": "block"}}}}}}"#
        );
        let mut followed = follow(&read(&text), &point(&[("v", 1.0)])).expect("numbers");
        followed.stages.remove(0)
    };
    for along in ["", "-"] {
        slide("4.01", along, "0").expect("it stays");
        for (width, from) in [("3.99", "0"), ("2", format!("{along}3/2").as_str())] {
            assert!(matches!(
                slide(width, along, from),
                Err(Lost {
                    why: Loss::NeverEnds(_),
                    ..
                })
            ));
        }
    }
}

#[test]
fn a_slide_gains_force_times_distance() {
    let slide = |force: &str, v: f64| {
        let text = format!(
            r#"{{"title": "t", "parameters": {{"v": {{"unit": "m/s", "domain": "real"}}}},
            "bodies": {{"ground": {{"shape": "fixed"}}, "block": {{"shape": "rectangle", "mass": "2", "width": "1", "height": "1",
                "center": ["0", "0"], "velocity": ["3*v/5", "-4*v/5"]}}}},
            "stages": [{{"name": "slide", "slide": {{"body": "block", "along": ["3/5", "-4/5"], "distance": "5", "gravity": "10" {force}}}}}],
            "questions": {{"u": {{"at": "slide", "velocity": "block"}}}}}}"#
        );
        let mut followed = follow(&read(&text), &point(&[("v", v)])).expect("numbers");
        followed.stages.remove(0)
    };
    let passed = slide("", 0.0).expect("it slides");
    let block = &passed.after.bodies[1];
    close(value_of(&block.velocity[0]), 0.6 * 80.0f64.sqrt(), 1e-10);
    close(value_of(&block.center[1]), -4.0, 1e-10);
    close(value_of(&passed.time), (2.0 * 5.0 / 8.0f64).sqrt(), 1e-10);
    // A force of 20 N against the weight's 16 N stops what is slower than 2√5.
    let held = r#", "force": "-20""#;
    assert!(matches!(
        slide(held, 4.0),
        Err(Lost {
            why: Loss::NeverEnds(_),
            ..
        })
    ));
    let passed = slide(held, 5.0).expect("it gets there");
    close(value_of(&passed.energy[1]), 25.0 - 4.0 * 5.0, 1e-9);
}

#[test]
fn a_winding_rope_keeps_the_speed_and_takes_its_time() {
    let text =
        std::fs::read_to_string("derivations/problems/skater-on-a-rope.json").expect("shipped");
    let at = point(&[("m", 50.0), ("v", 3.0), ("L0", 10.0), ("L", 2.5)]);
    let followed = follow(&read(&text), &at).expect("numbers");
    let passed = passed(&followed, 0);
    let [_, v] = &passed.after.bodies[0].velocity;
    close(value_of(v), 3.0, 1e-9);
    assert_eq!(
        passed.time.clone().expect_err("without bound").why,
        Why::Pole
    );
}
