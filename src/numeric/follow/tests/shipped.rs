//! Every shipped scene is followed without loss, and without stages the answers are those of the other solver.

use rayon::prelude::*;

use super::*;

fn scenes() -> BTreeMap<String, Scene> {
    fn collect(folder: &Path, out: &mut BTreeMap<String, Scene>) {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() && !path.ends_with("refused") {
                collect(&path, out);
            } else if path.extension().is_some_and(|e| e == "json") {
                let text = std::fs::read_to_string(&path).expect("a scene");
                out.insert(path.display().to_string(), read(&text));
            }
        }
    }
    let mut out = BTreeMap::new();
    collect(Path::new("derivations/book"), &mut out);
    collect(Path::new("derivations/more"), &mut out);
    collect(Path::new("derivations/problems"), &mut out);
    out
}

#[test]
fn every_shipped_scene_is_followed_at_points_of_its_domain() {
    for (file, scene) in scenes() {
        let mut whole = 0;
        for seed in 0..40 {
            let at = random_point(&scene, seed);
            let mut relations = scene.domains.relations.iter();
            let outside = |e: f64| e <= 0.0;
            if relations.any(|r| r.excess.evaluate(&at).is_some_and(outside)) {
                continue;
            }
            let followed = follow(&scene, &at).unwrap_or_else(|u| panic!("{file}: {u}"));
            let mut got_through = true;
            for stage in &followed.stages {
                match stage {
                    Ok(_) => {}
                    // Where it is slow, a swing turns back; where a side is too long, a triangle does not close.
                    Err(Lost {
                        why: Loss::NeverEnds(_) | Loss::After(_) | Loss::Undefined(_),
                        ..
                    }) => {
                        got_through = false;
                    }
                    Err(lost) => panic!("{file}, stage `{}` at {at:?}: {lost}", lost.stage),
                }
            }
            whole += u32::from(got_through);
            if whole == 3 {
                break;
            }
        }
        assert!(whole == 3, "{file}: followed at {whole} of 40 points");
    }
}

#[test]
fn without_stages_the_other_solver_says_the_same() {
    for (file, scene) in scenes() {
        if scene.has_stages() {
            continue;
        }
        for seed in 0..5 {
            let at = random_point(&scene, seed);
            if numeric::given(&scene, &at).is_err() {
                continue;
            }
            let followed = follow(&scene, &at).expect("numbers");
            let passed = passed(&followed, 0);
            let course = Course {
                stage: &Stage::alone(scene.clone()),
                solids: &followed.solids,
                values: &at,
            };
            let answers = numeric::answers(&scene, &at, numeric::solve_f64).expect("answers");
            for (name, told) in answers {
                let question = scene
                    .questions
                    .iter()
                    .find(|q| q.name == name)
                    .expect("asked");
                let found = answer::about_end(&course, passed, &question.ask);
                match (told, found) {
                    (Ok(numeric::Answer::Scalar(a)), Ok(numeric::Answer::Scalar(b))) => {
                        close(b, a, 1e-9);
                    }
                    (Ok(numeric::Answer::Vector(a)), Ok(numeric::Answer::Vector(b))) => {
                        close(b[0], a[0], 1e-9);
                        close(b[1], a[1], 1e-9);
                    }
                    (Err(_), Err(_)) => {}
                    (told, found) => panic!("{file}, {name}: {told:?} and {found:?}"),
                }
            }
        }
    }
}

#[test]
fn extreme_values_lead_to_an_outcome_and_never_to_a_panic() {
    let sizes = [
        0.0,
        -1.0,
        1e-300,
        1e-12,
        1.0,
        1e12,
        1e300,
        f64::INFINITY,
        f64::NAN,
    ];
    for (file, scene) in scenes() {
        let names = symbols(&scene);
        // Motions at extreme values take many steps.
        (0..24).into_par_iter().for_each(|seed: u64| {
            let mut at = random_point(&scene, seed);
            for (k, name) in names.iter().enumerate() {
                // Some symbols of every point are left as they are, so that not everything fails at once.
                let pick = (seed as usize * 7 + k * 5 + k * seed as usize) % (sizes.len() + 4);
                if let Some(size) = sizes.get(pick) {
                    at.directions.remove(name);
                    at.values.insert(name.clone(), *size);
                }
            }
            let Ok(followed) = follow(&scene, &at) else {
                return;
            };
            for passed in followed.stages.into_iter().flatten() {
                for body in &passed.after.bodies {
                    let known = body.components().into_iter().flatten();
                    known.for_each(|v| assert!(!v.is_nan(), "{file} at {at:?}"));
                }
            }
        });
    }
}

#[test]
fn a_question_has_the_values_that_only_it_needs() {
    let text = std::fs::read_to_string("derivations/more/stick-let-go-overtakes-a-coin.json");
    let mut scene = read(&text.expect("a scene"));
    for (name, value) in [("m", "2"), ("l", "1"), ("c", "3/5"), ("g", "10")] {
        crate::scene::set(&mut scene, name, value).expect("a value");
    }
    let at = values(&scene).expect("all values");
    let followed = follow(&scene, &at).expect("a motion");
    let asked = scene.question("a_c").expect("the question");
    let answer = answer(&scene, &followed, asked, &at).expect("a number");
    // a = α c with α = 3 g/(2 ℓ).
    close(answer.component(None).expect("one number"), 9.0, 1e-12);
}
