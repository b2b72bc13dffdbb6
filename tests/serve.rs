//! `carom serve`: every route, what strangers may send, and how it starts and stops.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use serde_json::{Value, json};

const CAROM: &str = env!("CARGO_BIN_EXE_carom");
const STICK: &str = "book/falling-stick.json";

/// A server of a folder; it ends with the test.
struct Server {
    child: Child,
    address: SocketAddr,
}

/// What came back.
struct Answer {
    status: u16,
    head: String,
    body: Vec<u8>,
}

impl Answer {
    fn text(&self) -> &str {
        std::str::from_utf8(&self.body).expect("UTF-8")
    }

    fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap_or_else(|e| panic!("{e}: {}", self.text()))
    }

    fn error(&self) -> String {
        let message = &self.json()["error"]["message"];
        message.as_str().expect("a message").to_string()
    }
}

impl Server {
    fn start(folder: &Path) -> Server {
        Server::of(Path::new(CAROM), folder)
    }

    fn of(program: &Path, folder: &Path) -> Server {
        let mut child = Command::new(program)
            .arg("serve")
            .arg(folder)
            // Debug builds of the tests share the cores with each other.
            .args(["--port=0", "--seconds=80"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("carom serves");
        let out = child.stdout.take().expect("its output");
        let mut line = String::new();
        BufReader::new(out).read_line(&mut line).expect("a line");
        let address = line.trim().trim_start_matches("http://");
        let address = address.trim_end_matches('/').parse();
        let address = address.unwrap_or_else(|e| panic!("{line:?}: {e}"));
        Server { child, address }
    }

    /// Sends bytes as they are, and reads to the end.
    fn raw(&self, request: &[u8]) -> Answer {
        let mut stream = TcpStream::connect(self.address).expect("a connection");
        let patience = Some(Duration::from_secs(250));
        stream.set_read_timeout(patience).expect("a time limit");
        // A server that refuses early may close before everything is sent.
        let _ = stream.write_all(request);
        let mut all = Vec::new();
        let _ = stream.read_to_end(&mut all);
        let end = all.windows(4).position(|w| w == b"\r\n\r\n");
        let end = end.unwrap_or_else(|| panic!("no head: {:?}", String::from_utf8_lossy(&all)));
        let head = String::from_utf8_lossy(&all[..end]).to_lowercase();
        let status = head.split(' ').nth(1).and_then(|s| s.parse().ok());
        Answer {
            status: status.expect("a status"),
            head,
            body: all[end + 4..].to_vec(),
        }
    }

    fn get(&self, path: &str) -> Answer {
        let head = format!("GET {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
        self.raw(head.as_bytes())
    }

    fn send(&self, path: &str, media: &str, body: &[u8]) -> Answer {
        let mut request = format!(
            "POST {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nContent-Type: {media}\r\nContent-Length: {}\r\n\r\n",
            body.len()
        )
        .into_bytes();
        request.extend_from_slice(body);
        self.raw(&request)
    }

    fn post(&self, command: &str, request: &Value) -> Answer {
        let body = request.to_string();
        self.send(
            &format!("/v1/{command}"),
            "application/json",
            body.as_bytes(),
        )
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn server() -> Server {
    Server::start(Path::new("derivations"))
}

/// The command line, with its output as JSON.
fn carom(arguments: &[&str]) -> Value {
    let out = Command::new(CAROM).args(arguments).output().expect("runs");
    serde_json::from_slice(&out.stdout).expect("JSON")
}

/// A folder for one test.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("carom-serve-{}-{name}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

#[test]
fn the_page_and_its_files_come_with_a_strict_policy() {
    let server = server();
    let page = server.get("/");
    assert_eq!(page.status, 200);
    let files: Vec<&str> = page
        .text()
        .split('"')
        .filter(|p| p.ends_with(".js") || p.ends_with(".css"))
        .collect();
    assert!(!files.is_empty());
    let mut seen: Vec<String> = files.iter().map(ToString::to_string).collect();
    let mut at = 0;
    while let Some(file) = seen.get(at).cloned() {
        at += 1;
        let answer = server.get(&file);
        assert_eq!(answer.status, 200, "{file}");
        assert!(answer.head.contains("script-src 'self';"), "{file}");
        assert!(answer.head.contains("default-src 'none'"), "{file}");
        assert!(answer.head.contains("nosniff"), "{file}");
        // Modules that a module names have to be there too; nothing is named from elsewhere.
        for line in answer.text().lines().filter(|l| l.starts_with("import ")) {
            let name = line.split('"').nth(1).expect("a module");
            assert!(name.starts_with('/'), "{file}: {line}");
            if !seen.iter().any(|s| s == name) {
                seen.push(name.to_string());
            }
        }
        assert!(!answer.text().contains("//cdn"), "{file}");
    }
}

#[test]
fn what_comes_back_is_what_the_commands_print() {
    let server = server();
    let path = format!("derivations/{STICK}");
    let values = ["--set=m=1", "--set=l=1", "--set=v=2", "--set=theta=pi/6"];
    let set = json!({"m": 1, "l": 1, "v": 2, "theta": "pi/6"});
    let derive = ["derive", &path, "--format=json"];
    let solve = [&["solve", &path, "--format=json"], &values[..]].concat();
    let grade = [
        "grade",
        &path,
        "--quantity=omega",
        "--answer=3v/(2l)",
        "--format=json",
    ];
    let cases: [(&str, Value, &[&str]); 6] = [
        ("derive", json!({}), &derive),
        ("solve", json!({"set": set}), &solve),
        (
            "grade",
            json!({"quantity": "omega", "answer": "3v/(2l)"}),
            &grade,
        ),
        ("verify", json!({}), &["verify", &path, "--format=json"]),
        (
            "derive",
            json!({"matrix": true}),
            &["derive", &path, "--matrix", "--format=json"],
        ),
        (
            "solution",
            json!({"detail": "brief"}),
            &["solution", &path, "--detail=brief", "--format=json"],
        ),
    ];
    let text = fs::read_to_string(&path).expect("a scene");
    let object: Value = serde_json::from_str(&text).expect("JSON");
    for (command, fields, arguments) in cases {
        let printed = carom(arguments);
        for (how, scene) in [
            ("name", json!(STICK)),
            ("scene", object.clone()),
            ("scene", json!(text)),
        ] {
            let mut request = fields.clone();
            request[how] = scene;
            let answer = server.post(command, &request);
            assert_eq!(answer.status, 200, "{command} by {how}: {}", answer.text());
            let mut found = answer.json();
            assert_eq!(found["version"], 1, "{command}");
            let mut printed = printed.clone();
            for value in [&mut found, &mut printed] {
                let fields = value.as_object_mut().expect("an object");
                fields.remove("version");
                // A solution repeats the text it was given; an object has another layout.
                fields.remove("scene");
            }
            assert_eq!(found, printed, "{command} by {how}");
        }
    }
    let page = server.post("solution", &json!({"name": STICK, "format": "html"}));
    assert!(page.head.contains("text/html") && page.text().contains("<math"));
    let drawn = server.post(
        "draw",
        &json!({"name": STICK, "set": set, "which": "after"}),
    );
    assert!(drawn.head.contains("image/svg+xml") && drawn.text().starts_with("<svg"));
}

#[test]
fn a_film_shows_both_sides_of_an_impact_and_a_wrong_answer_beside_the_right_one() {
    let server = server();
    let set = json!({"m": 1, "l": 1, "v": 2, "theta": "pi/6"});
    let asked =
        json!({"name": STICK, "set": set, "film": true, "quantity": "omega", "answer": "v/l"});
    let film = &server.post("describe", &asked).json()["film"];
    assert_eq!(film["bodies"], json!(["ground", "bar"]));
    let last = |part: &str| film[part].as_array().and_then(|all| all.last().cloned());
    let turned = |part: &str| {
        let last = last(part).expect("moments");
        let angle = last["poses"][1][2].as_f64().expect("an angle");
        (std::f64::consts::FRAC_PI_6 - angle) / last["time"].as_f64().expect("a time")
    };
    assert!((turned("claimed") - 2.0).abs() < 1e-9);
    assert!((turned("after") - 1.5 * 2.0 * (std::f64::consts::FRAC_PI_6).cos()).abs() < 1e-9);
    assert!(film["before"][0]["poses"][1][1].as_f64() > film["after"][0]["poses"][1][1].as_f64());
    // The foot of the bar meets the ground at the origin, and is held there.
    let standing = film["standing"].as_array().expect("lines");
    let foot = standing
        .iter()
        .flat_map(|line| line.as_array().expect("points"));
    let mut heights = foot.map(|p| p[1].as_f64().expect("a height"));
    assert!(heights.all(|y| y < 0.05) && !standing.is_empty());
    assert!(server.post("describe", &json!({"name": STICK})).json()["film"].is_null());
    // An answer is shown in a film, and to a question.
    for (other, asked) in [
        (
            "film",
            json!({"name": STICK, "quantity": "omega", "answer": "v/l"}),
        ),
        (
            "quantity",
            json!({"name": STICK, "film": true, "answer": "v/l"}),
        ),
    ] {
        let refused = server.post("describe", &asked);
        assert_eq!(refused.status, 400);
        let said = refused.json()["error"]["message"].to_string();
        assert!(said.contains(&format!("needs \\\"{other}\\\"")), "{said}");
    }
}

#[test]
fn a_film_has_the_strings_of_its_stages_with_what_carries_their_ends() {
    let server = server();
    let asked = json!({"name": "more/load-on-a-movable-pulley.json", "film": true});
    let film = &server.post("describe", &asked).json()["film"];
    let ends: Vec<Vec<Option<&str>>> = film["strings"]
        .as_array()
        .expect("strings")
        .iter()
        .map(|s| {
            let ends = s["ends"].as_array().expect("two ends");
            ends.iter().map(|e| e["body"].as_str()).collect()
        })
        .collect();
    // From the weight over the fixed pulley, down and up again to the ceiling; the load hangs on the axle.
    let carried = [
        [Some("weight"), None],
        [Some("movable_pulley"), None],
        [Some("movable_pulley"), None],
        [Some("movable_pulley"), Some("load")],
    ];
    assert_eq!(ends, carried);
    assert!(!film["standing"].as_array().expect("lines").is_empty());
}

#[test]
fn sliders_fit_what_their_parameters_are() {
    let server = server();
    let described = |name: &str| server.post("describe", &json!({"name": name})).json();
    let parameter = |name: &str, symbol: &str| {
        let all = described(name)["parameters"].clone();
        let mut all = all.as_array().expect("parameters").clone().into_iter();
        all.find(|p| p["name"] == symbol).expect("the parameter")
    };
    for name in [
        "more/ball-bounces-until-it-rests.json",
        "friction/ball-skips-over-rough-ground.json",
    ] {
        let n = parameter(name, "n");
        let whole = |field: &str| {
            n[field]
                .as_f64()
                .is_some_and(|v| v >= 1.0 && v.fract() == 0.0)
        };
        assert!(
            ["value", "min", "max", "step"].into_iter().all(whole),
            "{n}"
        );
        // The values at which all sliders begin fit together.
        let all = described(name)["parameters"].clone();
        let all = all.as_array().expect("parameters").iter();
        let value = |p: &Value| {
            Some((
                p["name"].as_str()?.to_owned(),
                p["value"].to_string().into(),
            ))
        };
        let set: serde_json::Map<String, Value> = all.filter_map(value).collect();
        let solved = server.post("solve", &json!({"name": name, "set": set}));
        assert_eq!(solved.status, 200, "{}", solved.text());
    }
    // Values from elsewhere are in SI units, and are told with them where the box has another.
    for (name, symbol, si) in [
        ("more/rod-hits-smooth-floor.json", "theta", json!("rad")),
        ("book/billiard-ball.json", "r", json!("m")),
        ("book/billiard-ball.json", "m", Value::Null),
    ] {
        assert_eq!(parameter(name, symbol)["si"], si, "{name}: {symbol}");
    }
}

#[test]
fn laws_of_contact_are_compared_where_there_are_several() {
    let server = server();
    let described = |name: &str| server.post("describe", &json!({"name": name})).json();
    assert_eq!(described(STICK)["has_laws"], false);
    // Several smooth contacts at once.
    let cradle = json!({"name": "more/newtons-cradle.json"});
    assert_eq!(described("more/newtons-cradle.json")["has_laws"], true);
    let several = server.post("compare", &cradle).json();
    assert!(
        several["candidates"]
            .as_array()
            .is_some_and(|c| c.len() > 1)
    );
    // Friction: of one impact, and of a stage.
    let rod = "friction/rod-turns-its-slip-round.json";
    assert_eq!(described(rod)["has_laws"], true);
    let spun = "friction/ball-bounces-with-backspin.json";
    let stages = described(spun)["stages"].clone();
    let stages = stages.as_array().expect("stages");
    let lawful = |s: &&Value| s["has_laws"] == true;
    let impact = stages.iter().find(lawful).expect("an impact")["name"].clone();
    assert!(stages.iter().all(|s| s["is_impact"] == s["has_laws"]));
    for asked in [json!({"name": rod}), json!({"name": spun, "stage": impact})] {
        let found = server.post("compare", &asked).json();
        let plane = found["plane"].as_str().expect("a picture");
        for words in ["friction cone", "sticking", "compression ends", "Poisson"] {
            assert!(plane.contains(words), "{words} is not drawn");
        }
        assert!(found["laws"].as_array().is_some_and(|l| l.len() == 6));
    }
}

#[test]
fn routes_are_measured_and_their_code_is_written() {
    let server = server();
    let report = server.post("report", &json!({"name": STICK})).json();
    let routes = report["reports"][0]["routes"]
        .as_array()
        .expect("routes")
        .clone();
    assert!(routes.iter().any(|r| r["route"] == "closed_form"));
    let code = server.post(
        "emit",
        &json!({"name": STICK, "lang": "numpy", "plain": true}),
    );
    assert!(code.text().contains("def omega(") && !code.text().contains("unit_scaled"));
}

#[test]
fn the_description_names_the_routes_that_are_there() {
    let server = server();
    let document = server.get("/openapi.json").json();
    let paths = document["paths"].as_object().expect("paths");
    for name in [
        "derive", "solve", "grade", "verify", "solution", "report", "emit",
    ] {
        assert!(paths.contains_key(&format!("/v1/{name}")), "{name}");
    }
    for (path, methods) in paths {
        let path = path.replace("{name}", STICK);
        if methods.get("get").is_some() {
            assert_eq!(server.get(&path).status, 200, "{path}");
        } else {
            let answer = server.send(&path, "application/json", b"{\"nothing\": 1}");
            assert_eq!(answer.status, 400, "{path}");
            assert_eq!(answer.json()["error"]["pointer"], "/nothing");
            assert_eq!(server.get(&path).status, 405, "{path}");
        }
    }
    assert_eq!(server.get("/v1/nothing-of-that-name").status, 405);
    assert_eq!(server.post("nothing", &json!({})).status, 404);
    assert_eq!(server.get("/favicon.ico").status, 404);
}

#[test]
fn lines_of_a_batch_are_judged_in_order() {
    let server = server();
    let lines = format!(
        "{{\"id\": 1, \"expected\": \"2 a\", \"answer\": \"a + a\"}}\nno line\n{{\"id\": 3, \"scene\": \"{STICK}\", \"quantity\": \"omega\", \"answer\": \"3 v cos(theta)/(2 l)\"}}\n{{\"name\": \"{STICK}\", \"quantity\": \"omega\", \"answer\": \"1.5 v cos(theta)/l\"}}\n"
    );
    let answer = server.send("/v1/grade", "application/jsonl", lines.as_bytes());
    assert_eq!(answer.status, 200);
    let found: Vec<Value> = answer
        .text()
        .lines()
        .map(|l| serde_json::from_str(l).expect("JSON"))
        .collect();
    let verdicts: Vec<&str> = found
        .iter()
        .map(|v| v["verdict"].as_str().expect("a verdict"))
        .collect();
    assert_eq!(
        verdicts,
        ["equivalent", "invalid", "equivalent", "equivalent"]
    );
    for outside in [
        "../README.md",
        "/etc/passwd",
        "book/../../Cargo.toml",
        "book/falling-stick.md",
    ] {
        let line = json!({"scene": outside, "quantity": "omega", "answer": "1"}).to_string();
        // A scene is named by its `name` as in other requests, too.
        let line = match outside.starts_with("book") {
            true => line.replace("\"scene\"", "\"name\""),
            false => line,
        };
        let lines = format!("{line}\n{{\"id\": 2, \"expected\": \"a\", \"answer\": \"a\"}}\n");
        let answer = server.send("/v1/grade", "application/jsonl", lines.as_bytes());
        assert_eq!(answer.status, 200);
        let told = answer.text();
        let [one, other] = [0, 1].map(|k| told.lines().nth(k).expect("a line for each"));
        assert!(one.contains("the folder has no scene"), "{one}");
        assert!(other.contains("\"verdict\":\"equivalent\""), "{other}");
    }
}

#[test]
fn every_command_takes_lines() {
    let server = server();
    let lines = format!(
        "{{\"id\": 7, \"name\": \"{STICK}\"}}\n{{\"id\": \"b\", \"name\": \"none.json\"}}\nno line\n"
    );
    for command in ["derive", "solve", "verify", "solution"] {
        let answer = server.send(
            &format!("/v1/{command}"),
            "application/jsonl",
            lines.as_bytes(),
        );
        assert_eq!(answer.status, 200, "{command}");
        let told = answer.text();
        let told: Vec<Value> = told
            .lines()
            .map(|l| serde_json::from_str(l).expect("JSON"))
            .collect();
        assert_eq!(told.len(), 3, "{command}");
        assert!(told.iter().all(|line| line["version"] == 1), "{command}");
        assert_eq!([&told[0]["id"], &told[1]["id"]], [&json!(7), &json!("b")]);
        assert!(
            told[1]["error"]["message"]
                .as_str()
                .is_some_and(|m| m.contains("no such scene"))
        );
        assert!(
            told[2]["error"]["message"]
                .as_str()
                .is_some_and(|m| m.contains("no JSON"))
        );
    }
}

#[test]
fn nothing_outside_of_the_folder_is_read() {
    let place = folder("outside");
    let inside = place.join("scenes");
    fs::create_dir_all(&inside).expect("a folder");
    fs::copy(
        "derivations/book/falling-stick.json",
        inside.join("stick.json"),
    )
    .expect("a scene");
    fs::copy(
        "derivations/book/falling-stick.json",
        place.join("secret.json"),
    )
    .expect("a scene");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(place.join("secret.json"), inside.join("link.json"))
            .expect("a link");
        std::os::unix::fs::symlink(&place, inside.join("up")).expect("a link");
    }
    let server = Server::start(&inside);
    let list = server.get("/v1/scenes").json();
    let names: Vec<&Value> = list["scenes"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|s| &s["name"])
        .collect();
    assert_eq!(names, ["stick.json"]);
    assert_eq!(server.get("/v1/scenes/stick.json").status, 200);
    for name in [
        "../secret.json",
        "%2e%2e/secret.json",
        "..%2fsecret.json",
        "..%5csecret.json",
        "%2fetc%2fpasswd",
        "link.json",
        "up/secret.json",
        "up/scenes/stick.json",
        "./stick.json",
        "stick.json%00",
        "stick.json/",
        "stick.md",
    ] {
        assert_eq!(
            server.get(&format!("/v1/scenes/{name}")).status,
            404,
            "{name}"
        );
        let plain = name
            .replace("%2e", ".")
            .replace("%2f", "/")
            .replace("%5c", "\\")
            .replace("%00", "\0");
        let answer = server.post("describe", &json!({"name": plain}));
        assert_eq!(answer.status, 404, "{name}");
    }
    drop(server);
    let _ = fs::remove_dir_all(place);
}

/// What a request comes to where a script stands in the place of the program that the server runs.
#[cfg(target_os = "linux")]
fn run_by(script: &str, place: &Path) -> Answer {
    use std::os::unix::fs::PermissionsExt;
    let program = place.join("carom");
    fs::copy(CAROM, &program).expect("the program");
    let server = Server::of(&program, Path::new("derivations"));
    let other = place.join("script");
    fs::write(&other, format!("#!/bin/sh\n{script}\n")).expect("a script");
    fs::set_permissions(&other, fs::Permissions::from_mode(0o755)).expect("it may run");
    fs::rename(&other, &program).expect("it takes the place");
    server.post("derive", &json!({"name": STICK}))
}

#[cfg(target_os = "linux")]
#[test]
fn a_command_has_a_bound_of_memory_and_wanting_more_is_no_fault() {
    let place = folder("memory");
    // The bound comes just after the beginning.
    run_by("sleep 0.2; ulimit -v > \"$0.limit\"", &place);
    let bound = fs::read_to_string(place.join("carom.limit")).expect("a bound");
    assert_eq!(bound.trim(), (1 << 20).to_string(), "kibibytes");
    let hungry = "echo 'memory allocation of 9 bytes failed' >&2; kill -ABRT $$";
    let answer = run_by(hungry, &place);
    assert_eq!(answer.status, 422);
    assert!(answer.error().contains("more memory than a request may"));
    assert_eq!(run_by("kill -ABRT $$", &place).status, 500);
    let _ = fs::remove_dir_all(place);
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    let server = server();
    let cases = [
        ("derive", "nonsense".to_string(), 400, ""),
        ("derive", "[1]".to_string(), 400, ""),
        ("derive", "{}".to_string(), 400, ""),
        ("derive", "\u{0}".to_string(), 400, ""),
        ("derive", "[".repeat(100_000), 400, ""),
        (
            "derive",
            json!({"name": STICK, "set": [1]}).to_string(),
            400,
            "/set",
        ),
        (
            "derive",
            json!({"name": STICK, "set": {"v/w": []}}).to_string(),
            400,
            "/set/v~1w",
        ),
        (
            "derive",
            json!({"name": STICK, "matrix": "yes"}).to_string(),
            400,
            "/matrix",
        ),
        (
            "derive",
            json!({"name": STICK, "scene": {}}).to_string(),
            400,
            "/name",
        ),
        (
            "solution",
            json!({"name": STICK, "format": "pdf"}).to_string(),
            400,
            "/format",
        ),
        (
            "grade",
            json!({"name": STICK, "quantity": "omega", "answer": "a\u{0}b"}).to_string(),
            400,
            "/answer",
        ),
        (
            "grade",
            json!({"name": STICK, "quantity": "omega", "answer": "1+".repeat(50_000)}).to_string(),
            400,
            "/answer",
        ),
    ];
    for (command, body, status, pointer) in cases {
        let shown = &body[..body.len().min(60)];
        let answer = server.send(
            &format!("/v1/{command}"),
            "application/json",
            body.as_bytes(),
        );
        assert_eq!(answer.status, status, "{shown}");
        assert_eq!(answer.json()["error"]["pointer"], pointer, "{shown}");
    }
    let answer = server.post("solve", &json!({"name": STICK}));
    assert_eq!(
        (answer.status, answer.error()),
        (422, "no value for l, m, theta, v".to_string())
    );
    let answer = server.post(
        "grade",
        &json!({"name": STICK, "quantity": "--help", "answer": "--help"}),
    );
    assert_eq!(answer.status, 422);
    let text = "{\n  \"bodies\": {\"a\": {\"shape\": \"rood\"}}\n}";
    for command in ["derive", "solution", "grade"] {
        let answer = server.post(command, &json!({"scene": text}));
        assert_eq!(answer.status, 422, "{command}");
        let fault = &answer.json()["error"]["faults"][0];
        assert_eq!(
            (&fault["pointer"], &fault["line"]),
            (&json!("/bodies/a/shape"), &json!(2))
        );
        let (start, end) = (fault["start"].as_u64(), fault["end"].as_u64());
        let place = start.expect("a place") as usize..end.expect("a place") as usize;
        assert_eq!(&text[place], "\"rood\"");
    }
    let large = vec![b' '; (1 << 20) + 1];
    let answer = server.send("/v1/derive", "application/json", &large);
    assert_eq!(answer.status, 413);
    // The server is still there.
    assert_eq!(server.get("/").status, 200);
}

#[test]
fn a_formula_that_is_wrong_is_a_result() {
    let server = server();
    for (answer, verdict) in [
        ("3 v cos(theta)/(2 l)", "equivalent"),
        ("3 v/(2 l)", "different"),
        ("3 v (", "invalid"),
    ] {
        let grade = server.post(
            "grade",
            &json!({"name": STICK, "quantity": "omega", "answer": answer}),
        );
        assert_eq!(grade.status, 200, "{answer}");
        assert_eq!(grade.json()["verdict"], verdict, "{answer}");
    }
    let lines = "omega = 3 v cos(theta)/(2 l)\nomega = 3 v/l";
    let marked = server
        .post("grade", &json!({"name": STICK, "steps": lines}))
        .json();
    assert_eq!(marked["first_wrong"], 2);
    let alone = server.post(
        "grade",
        &json!({"expected": "a/b", "answer": "a b^-1", "symbols": {"b": "1..2"}}),
    );
    assert_eq!(alone.json()["verdict"], "equivalent");
    let readings = server
        .post(
            "describe",
            &json!({"name": STICK, "formulas": ["3v/2", "3v +"]}),
        )
        .json();
    let read = readings["readings"].as_array().expect("readings");
    assert!(
        read[0]["mathml"]
            .as_str()
            .expect("MathML")
            .starts_with("<math>")
    );
    assert!(read[1]["error"]["message"].is_string());
}

#[test]
fn content_of_strangers_is_escaped() {
    let server = server();
    let text = fs::read_to_string(format!("derivations/{STICK}")).expect("a scene");
    let mut scene: Value = serde_json::from_str(&text).expect("JSON");
    let evil = "<script>alert(1)</script><img src=x onerror=alert(1)>";
    scene["title"] = json!(evil);
    scene["statement"] = json!(evil);
    scene["parameters"]["v"]["meaning"] = json!(evil);
    for (command, more) in [("solution", json!({"format": "html"})), ("draw", json!({}))] {
        let mut request = more;
        request["scene"] = scene.clone();
        let answer = server.post(command, &request);
        assert_eq!(answer.status, 200, "{command}");
        assert!(!answer.text().contains("<script>alert"), "{command}");
        assert!(!answer.text().contains("<img"), "{command}");
    }
    let hostile = "\\mathrm{<img src=x onerror=alert(1)>}";
    let described = server
        .post("describe", &json!({"name": STICK, "symbols": [hostile]}))
        .json();
    assert!(
        !described["symbols"][0]
            .as_str()
            .expect("MathML")
            .contains("<img")
    );
}

#[test]
fn a_page_of_another_name_gets_nothing() {
    let server = server();
    for (host, status) in [
        ("evil.example", 421),
        ("localhost.evil.example", 421),
        ("127.0.0.1", 200),
        ("[::1]:80", 200),
        ("LOCALHOST:9", 200),
    ] {
        let request =
            format!("GET /v1/scenes HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n");
        assert_eq!(server.raw(request.as_bytes()).status, status, "{host}");
    }
}

#[test]
fn many_at_once_are_answered_and_too_many_are_told_so() {
    let server = server();
    // Somebody who never ends a request keeps nobody else waiting.
    let mut slow = TcpStream::connect(server.address).expect("a connection");
    slow.write_all(b"POST /v1/derive HTTP/1.1\r\nHost: loc")
        .expect("half a head");
    let request = json!({"expected": "a + b", "answer": "b + a"});
    let statuses: Vec<u16> = std::thread::scope(|scope| {
        let ask = || {
            (0..4)
                .map(|_| server.post("grade", &request).status)
                .collect::<Vec<_>>()
        };
        let asking: Vec<_> = (0..32).map(|_| scope.spawn(ask)).collect();
        asking
            .into_iter()
            .flat_map(|t| t.join().expect("answers"))
            .collect()
    });
    assert_eq!(statuses.len(), 128);
    assert!(statuses.iter().all(|s| *s == 200), "{statuses:?}");
    let statuses: Vec<u16> = std::thread::scope(|scope| {
        let asking: Vec<_> = (0..200)
            .map(|_| scope.spawn(|| server.post("grade", &request).status))
            .collect();
        asking
            .into_iter()
            .map(|t| t.join().expect("answers"))
            .collect()
    });
    assert!(statuses.contains(&200));
    assert!(
        statuses.iter().all(|s| matches!(s, 200 | 503)),
        "{statuses:?}"
    );
    assert_eq!(server.get("/").status, 200);
}

fn refused(arguments: &[&str]) -> String {
    let run = Command::new(CAROM).arg("serve").args(arguments).output();
    let Output {
        status,
        stderr,
        stdout,
    } = run.expect("runs");
    assert_eq!(status.code(), Some(2));
    assert!(stdout.is_empty());
    String::from_utf8(stderr).expect("UTF-8")
}

#[test]
fn what_keeps_it_from_starting_is_told() {
    let server = server();
    let port = server.address.port();
    assert_eq!(
        refused(&["--port", &port.to_string()]),
        format!(
            "127.0.0.1:{port}: the port is in use\nhint: choose another with --port, or --port 0 for one that is free\n"
        )
    );
    let empty = folder("empty");
    let path = empty.display().to_string();
    assert_eq!(
        refused(&[&path]),
        format!(
            "{path}: no scenes\nhint: name a folder with scene files (.json), such as derivations\n"
        )
    );
    let _ = fs::remove_dir_all(empty);
    assert!(refused(&["no-such-folder"]).starts_with("no-such-folder: "));
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_it_and_what_is_asked_is_still_answered() {
    for signal in ["-INT", "-TERM"] {
        let mut server = server();
        let body = json!({"expected": "a + b", "answer": "b + a"}).to_string();
        let mut stream = TcpStream::connect(server.address).expect("a connection");
        let head = format!(
            "POST /v1/grade HTTP/1.1\r\nHost: localhost\r\nExpect: 100-continue\r\nContent-Length: {}\r\n\r\n",
            body.len()
        );
        stream.write_all(head.as_bytes()).expect("a head");
        // The server waits for the body, so it is at work on this request.
        let mut go_on = [0; 25];
        stream.read_exact(&mut go_on).expect("a word to go on");
        assert!(go_on.starts_with(b"HTTP/1.1 100"), "{go_on:?}");
        let id = server.child.id().to_string();
        let sent = Command::new("kill").args([signal, &id]).status();
        assert!(sent.expect("kill").success());
        std::thread::sleep(Duration::from_millis(100));
        stream.write_all(body.as_bytes()).expect("a body");
        let mut answer = String::new();
        stream.read_to_string(&mut answer).expect("an answer");
        assert!(answer.starts_with("HTTP/1.1 200"), "{signal}: {answer}");
        assert!(answer.contains("equivalent"), "{signal}: {answer}");
        let status = server.child.wait().expect("it ends");
        assert_eq!(status.code(), Some(0), "{signal}");
    }
}
