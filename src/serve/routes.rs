//! What stands at which address: the page and its files, the scenes of the folder, the commands.

use std::io::Write;
use std::sync::Arc;

use axum::Router;
use axum::body::{Body, Bytes};
use axum::extract::rejection::BytesRejection;
use axum::extract::{DefaultBodyLimit, Path, Request, State};
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header};
use axum::middleware::{self, Next};
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use serde_json::{Map, Value, json};
use tokio::time;

use super::commands::{COMMANDS, Command, Gives};
use super::request::{self, Bad};
use super::work::{Done, Job, NoEnd};
use super::{Shared, describe, openapi};
use crate::render::{self, VERSION};

/// Largest body of a request, in bytes.
const BODY: usize = 1 << 20;
/// How long a request may take from its head to its answer, waiting for a turn included, against how long a command may.
const WAITING: u32 = 3;

/// The files of the page: address and text; the type follows from the name.
const FILES: &[(&str, &str)] = &[
    ("/", include_str!("page/index.html")),
    ("/style.css", include_str!("page/style.css")),
    ("/ask.js", include_str!("page/ask.js")),
    ("/list.js", include_str!("page/list.js")),
    ("/main.js", include_str!("page/main.js")),
    ("/values.js", include_str!("page/values.js")),
    ("/figure.js", include_str!("page/figure.js")),
    ("/answers.js", include_str!("page/answers.js")),
    ("/film.js", include_str!("page/film.js")),
    ("/laws.js", include_str!("page/laws.js")),
    ("/accuracy.js", include_str!("page/accuracy.js")),
    ("/try.js", include_str!("page/try.js")),
    ("/solution.js", include_str!("page/solution.js")),
    ("/editor.js", include_str!("page/editor.js")),
];

/// Nothing but what the server itself holds; styles may stand in pictures and worked solutions, scripts may not.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; font-src 'self' data:; \
     connect-src 'self'; img-src 'self' data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// All addresses.
pub(super) fn routes(shared: Arc<Shared>) -> Router {
    let mut router = Router::new();
    for (address, text) in FILES {
        let media = match address.rsplit_once('.') {
            Some((_, "css")) => "text/css; charset=utf-8",
            Some(_) => "text/javascript; charset=utf-8",
            None => "text/html; charset=utf-8",
        };
        router = router.route(address, get(async move || typed(media, *text)));
    }
    let document = get(async || json_text(openapi::document()));
    let font = get(async || typed("font/woff2", render::fonts::MATH));
    let no_method = "this method is not for this address";
    let no_method = async move || error(StatusCode::METHOD_NOT_ALLOWED, no_method);
    router
        .route("/openapi.json", document)
        .route("/carom-math.woff2", font)
        .route("/v1/scenes", get(scenes))
        .route("/v1/scenes/{*name}", get(scene_text))
        .route("/v1/{command}", post(command))
        .fallback(async || no_address())
        .method_not_allowed_fallback(no_method)
        .layer(DefaultBodyLimit::max(BODY))
        .layer(middleware::from_fn_with_state(shared.clone(), guard))
        .with_state(shared)
}

/// What holds for every request: whose name is asked for, how long it takes, and what a browser may do with the answer.
async fn guard(State(shared): State<Arc<Shared>>, request: Request, next: Next) -> Response {
    let mut response = if shared.is_local && !names_this_machine(request.headers()) {
        let message = "this server answers to localhost only";
        error(StatusCode::MISDIRECTED_REQUEST, message)
    } else {
        let answered = time::timeout(WAITING * shared.workshop.longest, next.run(request));
        let answered = answered.await;
        answered.unwrap_or_else(|_| no_end(&NoEnd::Slow))
    };
    let headers = response.headers_mut();
    let origin = HeaderName::from_static("cross-origin-resource-policy");
    for (name, value) in [
        (header::CONTENT_SECURITY_POLICY, POLICY),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (origin, "same-origin"),
        (header::CACHE_CONTROL, "no-cache"),
    ] {
        headers.insert(name, HeaderValue::from_static(value));
    }
    response
}

/// Whether a request is addressed to this machine by a name that only this machine has.
fn names_this_machine(headers: &HeaderMap) -> bool {
    let Some(host) = headers.get(header::HOST).and_then(|h| h.to_str().ok()) else {
        return false;
    };
    let name = match host.strip_prefix('[') {
        Some(rest) => rest.split(']').next().unwrap_or_default(),
        None => host.split(':').next().unwrap_or_default(),
    };
    let address = name.parse::<std::net::IpAddr>();
    name.eq_ignore_ascii_case("localhost") || address.is_ok_and(|a| a.is_loopback())
}

/// The scenes of the folder, each with title and source.
async fn scenes(State(shared): State<Arc<Shared>>) -> Response {
    let folder = shared.folder.clone();
    let listed = tokio::task::spawn_blocking(move || {
        let each = folder.names().into_iter().map(|name| {
            let text = folder.text(&name).unwrap_or_default();
            describe::heading(&name, &text)
        });
        each.collect::<Vec<Value>>()
    });
    match listed.await {
        Ok(list) => json_text(json!({"version": VERSION, "scenes": list})),
        Err(_) => fault_of_carom(String::from("the list of scenes broke off")),
    }
}

async fn scene_text(State(shared): State<Arc<Shared>>, Path(name): Path<String>) -> Response {
    match shared.folder.text(&name) {
        Some(text) => typed("text/plain; charset=utf-8", text),
        None => error(StatusCode::NOT_FOUND, "the folder has no such scene"),
    }
}

/// Runs a command.
async fn command(
    State(shared): State<Arc<Shared>>,
    Path(name): Path<String>,
    headers: HeaderMap,
    body: Result<Bytes, BytesRejection>,
) -> Response {
    let Some(command) = COMMANDS.iter().find(|c| c.name == name) else {
        return no_address();
    };
    let body = match body {
        Ok(body) => body,
        Err(e) if e.status() == StatusCode::PAYLOAD_TOO_LARGE => {
            let message = format!("a request has at most {BODY} bytes");
            return error(StatusCode::PAYLOAD_TOO_LARGE, message);
        }
        Err(e) => return error(e.status(), e.body_text()),
    };
    let media = headers
        .get(header::CONTENT_TYPE)
        .and_then(|m| m.to_str().ok());
    let lines = media.is_some_and(|m| m.contains("jsonl") || m.contains("ndjson"));
    if !lines {
        return answer(&shared, command, request::fields(&body)).await;
    }
    let Ok(lines) = std::str::from_utf8(&body) else {
        return refused(Bad::new("", "the body is not in UTF-8"));
    };
    match command.name {
        "grade" => grades(&shared, lines).await,
        _ => answers(&shared, command, lines).await,
    }
}

/// What is wrong with a request.
fn refused(bad: Bad) -> Response {
    let pointer = Map::from_iter([("pointer".to_string(), json!(bad.pointer))]);
    let status = match bad.is_absent {
        true => StatusCode::NOT_FOUND,
        false => StatusCode::BAD_REQUEST,
    };
    error_with(status, bad.message, pointer)
}

/// Lines to grade, in one process; one line back for each.
async fn grades(shared: &Shared, lines: &str) -> Response {
    let absent = request::absent_scenes(lines, &shared.folder);
    let of = |k: usize| absent.iter().find(|(line, ..)| *line == k);
    // A line that names a file beside the scenes is not handed on.
    let input = lines.lines().enumerate().map(|(k, line)| match of(k) {
        Some(_) => "",
        None => line,
    });
    let job = Job {
        arguments: ["grade", "--batch", "--jobs=1"].map(String::from).into(),
        input: input.map(|line| format!("{line}\n")).collect(),
        file: None,
    };
    let done = match shared.workshop.run(job, shared.folder.root()).await {
        Ok(done) if done.status == Some(0) => done,
        Ok(done) => return fault_of_carom(done.said),
        Err(why) => return no_end(&why),
    };
    let out = String::from_utf8_lossy(&done.out);
    let told = out.lines().enumerate().map(|(k, line)| {
        let Some((_, id, name)) = of(k) else {
            return format!("{line}\n");
        };
        let mut grade: Value = serde_json::from_str(line).unwrap_or_default();
        grade["id"] = id.clone();
        grade["error"]["message"] = json!(format!("the folder has no scene {name}"));
        format!("{grade}\n")
    });
    typed(LINES, told.collect::<String>())
}

/// A request in every line, each with an "id" of its own if it likes; one line back for each, in their order.
async fn answers(shared: &Shared, command: &Command, lines: &str) -> Response {
    let mut out = String::new();
    let begun = time::Instant::now();
    for line in lines.lines() {
        let mut fields = request::fields(line.as_bytes());
        let id = fields.as_mut().ok().and_then(|f| f.remove("id"));
        // The lines before keep their answers where the whole takes too long.
        let response = match begun.elapsed() < (WAITING - 1) * shared.workshop.longest {
            true => answer(shared, command, fields).await,
            false => no_end(&NoEnd::Slow),
        };
        let body = axum::body::to_bytes(response.into_body(), usize::MAX).await;
        let body = body.unwrap_or_default();
        let mut told = match serde_json::from_slice(&body) {
            Ok(Value::Object(told)) => told,
            _ => {
                let text = String::from_utf8_lossy(&body);
                Map::from_iter([
                    ("version".to_string(), json!(VERSION)),
                    ("text".to_string(), json!(text)),
                ])
            }
        };
        told.extend(id.map(|id| ("id".to_string(), id)));
        out.push_str(&Value::Object(told).to_string());
        out.push('\n');
    }
    typed(LINES, out)
}

/// One request, one answer.
async fn answer(
    shared: &Shared,
    command: &Command,
    fields: Result<Map<String, Value>, Bad>,
) -> Response {
    let job = fields.and_then(|fields| {
        let scene = request::scene(&fields, &shared.folder)?;
        request::job(command, &fields, scene)
    });
    let (job, gives) = match job {
        Ok(job) => job,
        Err(bad) => return refused(bad),
    };
    let text = job.input.clone();
    match shared.workshop.run(job, shared.folder.root()).await {
        Ok(done) if matches!(done.status, Some(0..=3)) && !done.out.is_empty() => {
            result(done, gives)
        }
        Ok(done) if done.status == Some(2) => unusable(shared, &done.said, text).await,
        Ok(done) => fault_of_carom(done.said),
        Err(why) => no_end(&why),
    }
}

/// What a command printed; JSON gets the doubts that the command told beside it.
fn result(done: Done, gives: Gives) -> Response {
    let doubts: Vec<&str> = done.said.lines().map(without_place).collect();
    match (gives, done.out.strip_prefix(b"{")) {
        (Gives::Text(media), _) => typed(media, done.out),
        (Gives::Json, Some(rest)) if !doubts.is_empty() => {
            let mut out = format!("{{\n  \"doubts\": {},", json!(doubts)).into_bytes();
            out.extend_from_slice(rest);
            typed(JSON, out)
        }
        (Gives::Json, _) => typed(JSON, done.out),
    }
}

/// Why a request could not be carried out; if that is its scene, what is wrong with it and where.
async fn unusable(shared: &Shared, said: &str, scene: String) -> Response {
    let mut message = said.trim_end();
    let mut more = Map::new();
    // Several faults stay together, each with its own hint.
    if let Some((first, hint)) = message.split_once("\nhint: ")
        && !hint.contains('\n')
    {
        message = first;
        more.insert("hint".into(), json!(hint));
    }
    let status = StatusCode::UNPROCESSABLE_ENTITY;
    let job = Job {
        arguments: ["describe", "-"].map(String::from).into(),
        input: scene,
        file: None,
    };
    if !job.input.is_empty()
        && let Ok(done) = shared.workshop.run(job, shared.folder.root()).await
        && done.status == Some(2)
        && let Ok(Value::Object(mut faults)) = serde_json::from_slice(&done.out)
    {
        faults.remove("version");
        return error_with(status, "the scene cannot be read", faults);
    }
    error_with(status, without_place(message), more)
}

/// A message without the name of standard input before it; an option is called as the field that it comes from.
fn without_place(message: &str) -> &str {
    let message = message.strip_prefix("-: ").unwrap_or(message);
    message.strip_prefix("--").unwrap_or(message)
}

fn no_end(why: &NoEnd) -> Response {
    let message = match why {
        NoEnd::Busy => "too many requests at once; come again",
        NoEnd::Slow => {
            "this takes longer than a request may; `carom serve --seconds` sets the limit, and the command line has none"
        }
        NoEnd::Large => "the result is too large to send",
        NoEnd::Hungry => {
            "this takes more memory than a request may; the command line has no such limit"
        }
        NoEnd::Broken(why) => return fault_of_carom(why.clone()),
    };
    let status = match why {
        NoEnd::Busy | NoEnd::Slow => StatusCode::SERVICE_UNAVAILABLE,
        _ => StatusCode::UNPROCESSABLE_ENTITY,
    };
    let mut response = error(status, message);
    if matches!(why, NoEnd::Busy) {
        let headers = response.headers_mut();
        headers.insert(header::RETRY_AFTER, HeaderValue::from_static("1"));
    }
    response
}

/// What should not happen; the particulars are for who runs the server.
fn fault_of_carom(said: String) -> Response {
    let said = render::screen(&said);
    // That nobody may be there to read it changes nothing.
    let _ = writeln!(std::io::stderr(), "a command failed: {said}");
    let message = "a fault of carom; it told more where the server runs";
    error(StatusCode::INTERNAL_SERVER_ERROR, message)
}

fn no_address() -> Response {
    let message = "nothing stands here; GET /openapi.json tells what there is";
    error(StatusCode::NOT_FOUND, message)
}

fn error(status: StatusCode, message: impl Into<String>) -> Response {
    error_with(status, message, Map::new())
}

/// An error as JSON: a message, and what else is known.
fn error_with(
    status: StatusCode,
    message: impl Into<String>,
    mut more: Map<String, Value>,
) -> Response {
    more.insert("message".into(), json!(message.into()));
    let body = json_text(json!({"version": VERSION, "error": more}));
    (status, body).into_response()
}

const JSON: &str = "application/json";
const LINES: &str = "application/jsonl; charset=utf-8";

fn json_text(value: Value) -> Response {
    typed(JSON, value.to_string())
}

fn typed(media: &str, body: impl Into<Body>) -> Response {
    let media = HeaderValue::from_str(media);
    let media = media.unwrap_or(HeaderValue::from_static("text/plain"));
    ([(header::CONTENT_TYPE, media)], body.into()).into_response()
}
