//! Every shipped scene is drawn; a folder given in `CAROM_GALLERY` gets the pictures, for looking at.

use super::plane::Pair;
use super::sheet::Item;
use super::*;

/// The pictures of one impact.
fn all(scene: &Scene) -> Vec<Drawing> {
    let impact = Chapter::Impact(scene.clone());
    chapter("", &impact).into_iter().map(|d| d.0).collect()
}

fn scenes() -> Vec<(String, Scene)> {
    let mut out = Vec::new();
    let mut folders =
        vec![std::path::PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("derivations")];
    while let Some(folder) = folders.pop() {
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        let (deeper, files): (Vec<_>, Vec<_>) = entries.map(|e| e.path()).partition(|p| p.is_dir());
        folders.extend(deeper.into_iter().filter(|p| !p.ends_with("refused")));
        for file in files
            .into_iter()
            .filter(|p| p.extension().is_some_and(|e| e == "json"))
        {
            let text = std::fs::read_to_string(&file).expect("a shipped scene is readable");
            let name = file
                .file_stem()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned();
            if let Ok(scene) = crate::scene::read(&text) {
                out.push((name, scene));
            }
        }
    }
    out.sort_by(|a, b| a.0.cmp(&b.0));
    assert!(out.len() >= 11, "the book's scenes are there");
    out
}

fn sheets(scene: &Scene) -> Vec<Sheet> {
    let values = values::representative(scene);
    let stage = stage::stage(scene, &values).expect("a shipped scene has a place on paper");
    let motion = picture::outcome(&stage);
    let mut sheets: Vec<Sheet> = kinds(scene)
        .into_iter()
        .map(|which| panel(&stage, motion.as_ref(), which).sheet)
        .collect();
    for chapter in motions(scene) {
        if let Chapter::Motion(course) = chapter {
            sheets.push(motion_panel("way", &course).sheet);
        }
    }
    sheets
}

/// The motions of a story that begin as the file says.
fn motions(scene: &Scene) -> Vec<Chapter> {
    let stages = scene.stages.iter().filter(|s| s.from.is_none());
    let motions = stages.filter(|s| !matches!(s.kind, StageKind::Impact { .. }));
    motions.map(|s| Chapter::Motion(course(s))).collect()
}

/// A motion that begins as the file says.
fn course(stage: &crate::scene::Stage) -> Course {
    let mut begin = stage.scene.clone();
    for (b, velocity, spin) in &stage.start {
        let body = &mut begin.bodies[*b];
        velocity.iter().for_each(|v| body.velocity.clone_from(v));
        spin.iter().for_each(|w| body.spin.clone_from(w));
    }
    Course {
        begin,
        kind: stage.kind.clone(),
        elsewhere: Vec::new(),
        asked: Vec::new(),
    }
}

#[test]
fn every_picture_is_well_formed_stays_inside_and_is_the_same_twice() {
    for (name, scene) in scenes() {
        let mut drawings = all(&scene);
        drawings.push(draw(&scene, Which::All));
        for chapter in motions(&scene) {
            drawings.extend(super::chapter("way", &chapter).into_iter().map(|d| d.0));
        }
        for drawing in &drawings {
            let document =
                roxmltree::Document::parse(&drawing.svg).unwrap_or_else(|e| panic!("{name}: {e}"));
            let root = document.root_element();
            let number = |key: &str| {
                root.attribute(key)
                    .and_then(|v| v.parse::<f64>().ok())
                    .expect("a size")
            };
            let (width, height) = (number("width"), number("height"));
            assert!(
                !drawing.svg.contains("NaN") && !drawing.svg.contains("inf"),
                "{name}"
            );
            assert!(
                !drawing.alternative.is_empty() && !drawing.caption.is_empty(),
                "{name}"
            );
            for text in document.descendants().filter(|n| n.has_tag_name("text")) {
                let at = |key: &str| {
                    text.attribute(key)
                        .and_then(|v| v.parse::<f64>().ok())
                        .expect("a place")
                };
                assert!(
                    (0.0..=width).contains(&at("x")) && (0.0..=height).contains(&at("y")),
                    "{name}"
                );
            }
        }
        let again = all(&scene);
        assert_eq!(drawings[..again.len()], again, "{name}");
    }
    if let Ok(folder) = std::env::var("CAROM_GALLERY") {
        for (name, scene) in scenes() {
            for (k, drawing) in all(&scene).iter().enumerate() {
                std::fs::write(format!("{folder}/{name}-{k}.svg"), &drawing.svg)
                    .expect("a gallery folder");
            }
        }
    }
}

#[test]
fn no_label_covers_another() {
    for (name, scene) in scenes() {
        for (k, sheet) in sheets(&scene).iter().enumerate() {
            let rooms: Vec<(&Label, &Room)> = sheet
                .items
                .iter()
                .filter_map(|item| {
                    if let Item::Text { label, room, .. } = item {
                        Some((label, room))
                    } else {
                        None
                    }
                })
                .collect();
            let all = sheet.room().map(|r| r.grown(0.01));
            for (i, (label, room)) in rooms.iter().enumerate() {
                assert!(
                    all.is_some_and(|a| a.with(room) == a),
                    "{name} {k}: {} sticks out",
                    label.text()
                );
                for (other, taken) in &rooms[..i] {
                    assert!(
                        room.overlap(taken) == 0.0,
                        "{name} {k}: {} on {}",
                        label.text(),
                        other.text()
                    );
                }
            }
        }
    }
}

/// The stages of every scene that are one impact by themselves, drawn as they are.
fn impacts() -> Vec<(String, Scene)> {
    let mut out = Vec::new();
    for (name, scene) in scenes() {
        let stages = scene.stages.iter();
        for stage in stages.filter(|s| matches!(s.kind, StageKind::Impact { .. })) {
            out.push((format!("{name}, {}", stage.name), stage.scene.clone()));
        }
        if !scene.has_stages() {
            out.push((name, scene));
        }
    }
    out
}

#[test]
fn a_pulley_of_a_string_stands_on_a_support_where_no_hinge_tells_of_it() {
    let mut seen = 0;
    for (name, scene) in scenes() {
        // As the file puts the bodies, at the beginning of the first stage.
        let Some(first) = scene.stages.first() else {
            continue;
        };
        let scene = &first.scene;
        let values = values::representative(scene);
        let stage = stage::stage(scene, &values).expect("a place on paper");
        let mut sheet = Sheet::default();
        stage.fixed(&mut sheet);
        let hinged = |b: usize| scene.hinges.iter().any(|h| h.bodies.contains(&b));
        for axle in scene.axles.iter().filter(|p| !hinged(**p)) {
            let at = stage.px(stage.poses[*axle].center);
            let near = |p: &Pair| plane::apart(*p, at) < 1.0;
            let stands = sheet.items.iter().any(|item| match item {
                sheet::Item::Path { points, .. } => points.iter().any(near),
                _ => false,
            });
            assert!(stands, "{name}: a pulley hangs in the air");
            seen += 1;
        }
    }
    assert!(seen > 3, "{seen} pulleys");
}

#[test]
fn what_belongs_to_a_body_that_is_a_letter_has_that_letter() {
    let scene = crate::scene::read(
        r#"{"parameters": {"m": {"unit": "kg"}, "r": {"unit": "m"}, "v": {"unit": "m/s"}}, "points": {"C": ["r", 0]}, "bodies": {
            "A": {"shape": "disk", "radius": "r", "mass": "m", "center": [0, 0], "velocity": ["v", 0]},
            "B": {"shape": "disk", "radius": "r", "mass": "2*m", "center": ["2*r", 0]}},
        "contacts": {"C": {"bodies": ["A", "B"], "at": "C", "normal": "x", "law": "frictionless", "restitution": 1}},
        "questions": {"E": {"energy": "after"}}}"#,
    );
    let scene = scene.expect("a scene");
    let marked: String = all(&scene).into_iter().map(|d| d.alternative).collect();
    assert!(marked.contains("G_A") && marked.contains("v_B"), "{marked}");
    assert!(!marked.contains("G₁"), "{marked}");
}

#[test]
fn a_scene_is_drawn_at_values_that_keep_to_its_relations() {
    let (mut seen, mut faults) = (0, Vec::new());
    for (name, scene) in scenes() {
        let values = values::representative(&scene);
        for relation in &scene.domains.relations {
            let excess = values.of(&relation.excess);
            if excess.is_none_or(|e| e <= 0.0) {
                faults.push(format!("{name}: {excess:?} by {}", relation.words));
            }
            seen += 1;
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(seen > 10, "{seen} relations");
}

#[test]
fn a_rise_is_marked_by_its_height_and_what_has_rolled_on_is_in_nobodys_way() {
    for (name, scene) in scenes() {
        for stage in &scene.stages {
            let chapter = Chapter::Motion(course(stage));
            if !matches!(stage.kind, StageKind::Fall(_)) {
                continue;
            }
            for (drawing, _) in super::chapter(&stage.name, &chapter) {
                let words = drawing.alternative;
                let marked = words.split("Marked: ").skip(1).flat_map(|w| w.split(", "));
                assert!(
                    !marked.clone().any(|l| l.starts_with('−')),
                    "{name}: {words}"
                );
            }
        }
        for sheet in sheets(&scene) {
            let round = |item: &Item| match item {
                Item::Circle {
                    center,
                    radius,
                    paint: sheet::Paint::Fill(_),
                } if *radius > 12.0 => Some((*center, *radius)),
                _ => None,
            };
            let disks: Vec<(Pair, f64)> = sheet.items.iter().filter_map(round).collect();
            for (i, (p, r)) in disks.iter().enumerate() {
                for (q, s) in &disks[..i] {
                    let apart = plane::apart(*p, *q);
                    assert!(apart > 0.97 * (r + s), "{name}: {apart} of {}", r + s);
                }
            }
        }
    }
}

#[test]
fn bodies_that_nothing_acts_on_get_no_diagram() {
    for (name, scene) in impacts() {
        for which in kinds(&scene) {
            let Which::During(Subject::Body(b)) = which else {
                continue;
            };
            let contacts = scene.contacts.iter().map(|c| c.bodies);
            let mut joints = contacts.chain(scene.hinges.iter().map(|h| h.bodies));
            let touched = joints.any(|bodies| bodies.contains(&b))
                || scene.blows.iter().any(|blow| blow.body == b);
            let any =
                !(scene.contacts.is_empty() && scene.hinges.is_empty() && scene.blows.is_empty());
            assert!(touched || !any, "{name}: {}", scene.bodies[b].name);
        }
    }
}

#[test]
fn no_body_crosses_a_support() {
    let mut seen = 0;
    for (name, scene) in impacts() {
        let values = values::representative(&scene);
        let Some(stage) = stage::stage(&scene, &values) else {
            continue;
        };
        let mut sheet = Sheet::default();
        stage.fixed(&mut sheet);
        for (from, to, back) in &sheet.grounds {
            let d = [to[0] - from[0], to[1] - from[1]];
            for p in stage.poses.iter().flat_map(|p| {
                let drawn = p.drawn().concat();
                if drawn.is_empty() { p.outline() } else { drawn }
            }) {
                let p = stage.px(p);
                let r = [p[0] - from[0], p[1] - from[1]];
                let along = plane::dot(r, d) / plane::dot(d, d);
                let deep = plane::dot(r, *back);
                seen += 1;
                assert!(
                    !(0.0..=1.0).contains(&along) || !(2.0..40.0).contains(&deep),
                    "{name}: {deep} px inside what stands there"
                );
            }
        }
    }
    assert!(seen > 100, "{seen} points");
}

#[test]
fn no_label_lies_on_a_line() {
    let mut labels = 0;
    let mut faults = Vec::new();
    let drawn = impacts();
    for (name, scene) in drawn.iter().chain(&scenes()) {
        if stage::stage(scene, &values::representative(scene)).is_none() {
            continue;
        }
        for (k, sheet) in sheets(scene).iter().enumerate() {
            let lines = sheet.items.iter().filter_map(|item| match item {
                Item::Path {
                    points,
                    closed,
                    paint: sheet::Paint::Stroke(line),
                } => Some((points, *closed, line)),
                _ => None,
            });
            let lines: Vec<_> = lines.collect();
            for item in &sheet.items {
                let Item::Text { label, room, .. } = item else {
                    continue;
                };
                labels += 1;
                // A line box is taller than its letters.
                let [w, h] = room.extent();
                let core = Room {
                    low: [room.low[0] + 0.12 * w, room.low[1] + 0.25 * h],
                    high: [room.high[0] - 0.12 * w, room.high[1] - 0.25 * h],
                };
                let crossed = |a: &Pair, b: &Pair| {
                    (0..=40).any(|k| {
                        let t = f64::from(k) / 40.0;
                        let p = [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t];
                        Room::around(p, 0.01).overlap(&core) > 0.0
                    })
                };
                for (points, closed, line) in &lines {
                    let last = if *closed {
                        points.first().zip(points.last())
                    } else {
                        None
                    };
                    let hit = points.windows(2).any(|w| crossed(&w[0], &w[1]))
                        || last.is_some_and(|(a, b)| crossed(a, b));
                    if hit {
                        faults.push(format!(
                            "{name} {k}: {} on a line of {:?}",
                            label.text(),
                            line.ink
                        ));
                    }
                }
            }
        }
    }
    assert!(labels > 300, "{labels} labels");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_scene_named_like_markup_is_only_text() {
    let text = r#"{
        "title": "<script>alert(1)</script>\u202e",
        "parameters": {"m": {"unit": "kg", "latex": "\\input{<b>}"}, "v": {"unit": "m/s"}},
        "bodies": {
            "ground": {"shape": "fixed"},
            "ball": {"shape": "particle", "mass": "m", "velocity": ["0", "-v"]}
        },
        "contacts": {"C": {"bodies": ["ground", "ball"], "at": ["0", "0"], "law": "sticking"}},
        "forces": [{"name": "]]> & <img src=x onerror=alert(1)>", "on": "ball"}],
        "questions": {"E": {"energy": "lost"}}
    }"#;
    let mut scene = crate::scene::read(text).expect("the scene is sound");
    scene.bodies[1].name = "</text><script>".to_string();
    for drawing in all(&scene).iter().chain([&draw(&scene, Which::All)]) {
        let document = roxmltree::Document::parse(&drawing.svg).expect("XML");
        for node in document.descendants().filter(|n| n.is_element()) {
            let name = node.tag_name().name();
            assert!(
                [
                    "svg", "title", "desc", "style", "path", "circle", "text", "tspan"
                ]
                .contains(&name),
                "{name}"
            );
            assert!(
                node.attributes().all(|a| !a.name().starts_with("on")),
                "{name}"
            );
        }
        assert!(!drawing.svg.contains('\u{202e}'));
    }
}

#[test]
fn what_cannot_be_placed_is_said_and_does_not_panic() {
    let whole = scenes()
        .into_iter()
        .find(|(name, _)| name.contains("falling-stick"));
    let (_, whole) = whole.expect("the falling stick is shipped");
    let mut scene = whole.clone();
    scene.bodies[0].center = [Expr::zero().powi(-1), Expr::zero()];
    assert!(plain(&draw(&scene, Which::All).caption).contains("no picture"));
    assert!(
        all(&Scene::default())
            .iter()
            .all(|d| roxmltree::Document::parse(&d.svg).is_ok())
    );
    assert!(
        plain(&draw(&whole, Which::During(Subject::Body(99))).caption).contains("no movable body")
    );
}

#[test]
fn captions_tell_the_values_in_the_units_of_the_scene() {
    let scenes = scenes();
    let find = |name: &str| &scenes.iter().find(|(n, _)| n == name).expect("shipped").1;
    assert!(
        plain(&draw(find("falling-stick"), Which::Before).caption)
            .contains("ℓ = 1 m, v = 1 m/s, θ = 35°")
    );
    assert!(plain(&draw(find("billiard-ball"), Which::Before).caption).contains("r = 30 mm"));
}

#[test]
fn a_ladder_stands_between_its_wall_and_its_floor() {
    let (_, scene) = (scenes().into_iter())
        .find(|(name, _)| name == "ladder-slides-down")
        .expect("a shipped scene");
    let slip = &scene.stages[0];
    let values = values::representative(&slip.scene);
    let stage = stage::stage(&slip.scene, &values).expect("a place on paper");
    let begin = stage.poses.clone();
    let gone = way::Gone::new(&scene, &values, &begin).expect("a way");
    let end = gone.last(&begin).swap_remove(0);
    let mut sheet = Sheet::default();
    stage.guides(&mut sheet, &[[&begin[0], &end]]);
    let room = sheet.room().expect("a wall and a floor");
    let corner = stage.px([0.0, 0.0]);
    let foot = stage.px(end.ends().expect("a rod")[0]);
    let top = stage.px(begin[0].ends().expect("a rod")[1]);
    assert!(room.low[0] < corner[0] && room.low[1] < corner[1]);
    assert!(room.high[0] > foot[0].max(top[0]) && room.high[1] > foot[1].max(top[1]));
    let mut nothing = Sheet::default();
    stage.guides(&mut nothing, &[[&begin[0], &begin[0]]]);
    assert!(
        nothing.items.is_empty(),
        "what does not move shows no guide"
    );
}

fn told(text: &str) -> Scene {
    crate::scene::read(text).expect("a scene")
}

#[test]
fn a_block_is_above_its_plank_and_rough_ground_presses_and_holds_it_back() {
    let text = include_str!("../../tests/stories/scenes/plank-overtakes-a-block.json");
    let all = motions(&told(text));
    let Some(Chapter::Motion(course)) = all.first() else {
        panic!("a motion");
    };
    let sheet = motion_panel("slip", course).sheet;
    let planks = sheet.items.iter().filter_map(|item| match item {
        Item::Path {
            points,
            closed: true,
            paint: sheet::Paint::Stroke(_),
        } => Room::of(points),
        _ => None,
    });
    let blocks = sheet.items.iter().filter_map(|item| match item {
        Item::Circle { center, radius, .. } if *radius > 5.0 => Some(*center),
        _ => None,
    });
    let pairs: Vec<(Room, Pair)> = planks.zip(blocks).collect();
    assert_eq!(pairs.len(), 2);
    for (plank, block) in pairs {
        assert!(plank.low[0] < block[0] && block[0] < plank.high[0]);
        assert!(plank.high[1] < block[1]);
    }
    let arrows: Vec<Pair> = sheet
        .lines(sheet::Ink::Impulse)
        .iter()
        .map(|line| ends(line))
        .collect();
    let [weight, normal, friction] = arrows.as_slice() else {
        panic!("{arrows:?}");
    };
    assert!(weight[1] < 0.0 && normal[1] > 0.0 && friction[0] > 0.0);
}

/// From the tail of an arrow to its head.
fn ends(line: &[Pair]) -> Pair {
    plane::minus(line[line.len() - 1], line[0])
}

#[test]
fn two_impulses_on_a_particle_do_not_lie_on_each_other() {
    let text = include_str!("../../derivations/more/cart-stops-and-its-rod-swings.json");
    let scene = told(text);
    let begin = scene.stages[0].scene.clone();
    let values = values::representative(&begin);
    let stage = stage::stage(&begin, &values).expect("a stage");
    let motion = picture::outcome(&stage);
    let cart = begin.bodies.iter().position(|b| b.name == "cart");
    let (sheet, _) = during::during(&stage, &[cart.expect("a cart")], motion.as_ref());
    let lines = sheet.lines(sheet::Ink::Impulse);
    let rooms: Vec<Room> = lines.iter().filter_map(|l| Room::of(l)).collect();
    let [a, b] = rooms.as_slice() else {
        panic!("{lines:?}");
    };
    assert!(a.high[0] < b.low[0] || b.high[0] < a.low[0], "{lines:?}");
}

#[test]
fn a_heading_leaves_room_for_a_wider_font() {
    let heading = |text: &str| {
        let (mut items, mut top) = (Vec::new(), 0.0);
        panel::lines(&mut items, text, 14.0, true, 340.0, &mut top);
        items.len()
    };
    let text = "During the collision: the rod and the cart again";
    assert_eq!([heading(&text[..30]), heading(text)], [1, 2]);
}

#[test]
fn a_label_left_of_an_arrow_keeps_its_end() {
    let mut sheet = Sheet::default();
    let (from, to) = ([0.0, 20.0], [0.0, -20.0]);
    sheet.arrow(from, to, sheet::Ink::Impulse, 1.8);
    // Something stands on the right.
    sheet.kept.push(Room::around([60.0, 0.0], 59.0));
    sheet.wish(Label::words("m g"), 16.0, place::Spot::Along { from, to });
    sheet.settle();
    let drawn = panel::framed(sheet, "", Vec::new(), "");
    assert!(drawn.svg.contains("text-anchor=\"end\""), "{}", drawn.svg);
}
