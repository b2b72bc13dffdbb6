//! The site: every page is there, every link leads to one, and words of a scene stay words.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("site-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(folder.join("in/deep")).expect("a folder");
    folder
}

fn site(folder: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_carom"))
        .current_dir(folder)
        .args(["site", "in", "-o", "out"])
        .output()
        .expect("the program starts")
}

/// What the links of a page lead to.
fn links(page: &str) -> Vec<&str> {
    let behind = page.split(" href=\"").skip(1);
    behind.filter_map(|rest| rest.split('"').next()).collect()
}

#[test]
fn every_link_of_the_site_leads_to_a_page_of_it() {
    let folder = folder("links");
    for (from, to) in [
        ("book/falling-stick", "stick"),
        ("book/tipping-box", "book/tipping-box"),
        ("book/billiard-ball", "deep/ball"),
        ("friction/superball", "deep/cases"),
    ] {
        let to = folder.join(format!("in/{to}.json"));
        fs::create_dir_all(to.parent().expect("a folder")).expect("a folder");
        fs::copy(format!("derivations/{from}.json"), to).expect("copied");
    }
    let run = site(&folder);
    assert!(
        run.status.success(),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
    let out = folder.join("out");
    for page in [
        "index.html",
        "guide.html",
        "grading.html",
        "stick.html",
        "deep/ball.html",
        "deep/cases.html",
    ] {
        let text = fs::read_to_string(out.join(page)).expect(page);
        assert!(text.contains("default-src 'none'"), "{page}");
        assert!(links(&text).len() >= 3, "{page}");
        for link in links(&text).into_iter().filter(|l| !l.contains(':')) {
            let at = out.join(page).parent().expect("a folder").join(link);
            assert!(at.is_file(), "{page}: {link}");
        }
    }
    // The guide leads to the pages of shipped scenes that the site has.
    let guide = fs::read_to_string(out.join("guide.html")).expect("the guide");
    assert!(links(&guide).contains(&"book/tipping-box.html"));
    assert_eq!(
        fs::read(out.join("stick.json")).expect("a copy"),
        fs::read("derivations/book/falling-stick.json").expect("the scene")
    );
}

#[test]
fn words_of_a_scene_stay_words() {
    let folder = folder("words");
    let scene = fs::read_to_string("derivations/book/billiard-ball.json").expect("a scene");
    let title = scene.replace(
        "Cueing a billiard ball",
        "</title><script>alert(1)</script>",
    );
    assert_ne!(title, scene);
    fs::write(folder.join("in/a b&\"'.json"), title).expect("written");
    assert!(site(&folder).status.success());
    for page in ["index.html", "a b&\"'.html"] {
        let text = fs::read_to_string(folder.join("out").join(page)).expect(page);
        assert!(!text.contains("<script>alert"), "{page}");
    }
}

#[test]
fn a_broken_scene_is_told_and_the_others_stand() {
    let folder = folder("broken");
    let empty = site(&folder);
    assert_eq!(empty.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&empty.stderr).contains("no scenes"));
    fs::copy(
        "derivations/book/billiard-ball.json",
        folder.join("in/ball.json"),
    )
    .expect("copied");
    fs::write(folder.join("in/broken.json"), "{").expect("written");
    let run = site(&folder);
    assert_eq!(run.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&run.stderr).contains("broken.json"));
    assert!(folder.join("out/ball.html").is_file() && !folder.join("out/broken.html").exists());
}
