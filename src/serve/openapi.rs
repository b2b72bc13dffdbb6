//! The description of the routes for programs, written from the table of commands, so that it cannot be wrong about them.

use serde_json::{Map, Value, json};

use super::commands::{COMMANDS, Command, Field, Gives, Kind, SCENE};
use super::request::MANY;

/// The document, by OpenAPI 3.1.
pub(super) fn document() -> Value {
    let mut paths = Map::new();
    for command in COMMANDS.iter() {
        let address = format!("/v1/{}", command.name);
        paths.insert(address, json!({"post": post(command)}));
    }
    paths.insert("/v1/scenes".into(), json!({"get": {
        "operationId": "scenes",
        "summary": "the scenes of the folder",
        "responses": {"200": {"description": "names, titles and sources", "content": {"application/json": {}}}},
    }}));
    paths.insert("/v1/scenes/{name}".into(), json!({"get": {
        "operationId": "scene",
        "summary": "the text of a scene; its name may hold slashes as they are",
        "parameters": [{"name": "name", "in": "path", "required": true, "schema": {"type": "string"}}],
        "responses": {
            "200": {"description": "the file, JSON with comments", "content": {"text/plain": {}}},
            "404": {"description": "the folder has no such scene", "content": error_content()},
        },
    }}));
    json!({
        "openapi": "3.1.0",
        "info": {
            "title": "carom",
            "version": env!("CARGO_PKG_VERSION"),
            "description": "Collisions of rigid bodies in the plane. Each command gives what it prints with --format json.",
        },
        "paths": paths,
        "components": {"schemas": {"Error": error_schema()}},
    })
}

fn post(command: &Command) -> Value {
    let mut fields = scene_fields();
    fields.extend(command.fields.iter().map(|f| (f.name, schema(f))));
    let mut schema = object(&fields, command.sceneless);
    for field in command.fields.iter().filter(|f| !f.needs.is_empty()) {
        schema["dependentRequired"][field.name] = json!(field.needs);
    }
    let mut request = body(schema);
    let lines = match command.name {
        "grade" => {
            "one answer a line, as `carom grade --batch` reads them; one line comes back for each"
        }
        _ => {
            "one request a line, with an \"id\" if you like; one line comes back for each, a text in \"text\""
        }
    };
    request["content"]["application/jsonl"] =
        json!({"schema": {"type": "string", "description": lines}});
    let media = match command.gives {
        Gives::Json => "application/json",
        Gives::Text(media) => media.split(';').next().unwrap_or(media),
    };
    let mut responses = responses(media);
    if command.fields.iter().any(|f| f.name == "format") {
        responses["200"]["content"]["text/*"] = json!({});
    }
    responses["200"]["content"]["application/jsonl"] = json!({});
    json!({
        "operationId": command.name,
        "summary": command.what,
        "requestBody": request,
        "responses": responses,
    })
}

fn scene_fields() -> Vec<(&'static str, Value)> {
    let [(scene, of_scene), (name, of_name)] = SCENE;
    let scene = (
        scene,
        json!({"description": of_scene, "type": ["object", "string"], "minLength": 1}),
    );
    vec![
        scene,
        (name, json!({"description": of_name, "type": "string"})),
    ]
}

fn schema(field: &Field) -> Value {
    let texts = json!({"type": ["string", "number"]});
    let mut schema = match &field.kind {
        Kind::Values(_) => {
            json!({"type": "object", "additionalProperties": texts, "maxProperties": MANY})
        }
        Kind::Text(_) => texts.clone(),
        Kind::Word(_, words) => json!({"type": "string", "enum": words}),
        Kind::Flag(_) => json!({"type": "boolean"}),
        Kind::Texts(_) => json!({"type": "array", "items": texts, "maxItems": MANY}),
        Kind::Lines(_) => json!({"type": "string"}),
        Kind::List(_) => json!({"type": "array", "items": {"type": "object"}}),
    };
    schema["description"] = json!(field.what);
    schema
}

/// A request: its fields, and a scene or the name of one unless it can do without.
fn object(fields: &[(&str, Value)], sceneless: bool) -> Value {
    let properties = fields
        .iter()
        .map(|(name, schema)| (name.to_string(), schema.clone()));
    let properties = Value::Object(properties.collect());
    let mut object =
        json!({"type": "object", "properties": properties, "additionalProperties": false});
    if !sceneless {
        let one_of = SCENE.iter().map(|(name, _)| json!({"required": [name]}));
        object["oneOf"] = one_of.collect();
    }
    object
}

fn body(schema: Value) -> Value {
    json!({"required": true, "content": {"application/json": {"schema": schema}}})
}

fn responses(media: &str) -> Value {
    let mut all = json!({"200": {
        "description": "the result; whether it was refuted or is not decided stands in it",
        "content": {media: {}},
    }});
    for (status, description) in [
        ("400", "no request: unknown fields, wrong types, no JSON"),
        ("404", "the folder has no scene of this name"),
        ("413", "more than a mebibyte"),
        ("422", "a scene, a value or a formula that cannot be used"),
        (
            "503",
            "too many requests at once, or one that took too long",
        ),
    ] {
        all[status] = json!({"description": description, "content": error_content()});
    }
    all
}

fn error_content() -> Value {
    json!({"application/json": {"schema": {"$ref": "#/components/schemas/Error"}}})
}

fn error_schema() -> Value {
    let text = json!({"type": "string"});
    let place = json!({"type": "integer"});
    json!({
        "type": "object",
        "required": ["version", "error"],
        "properties": {
            "version": place,
            "error": {
                "type": "object",
                "required": ["message"],
                "properties": {
                    "message": text,
                    "hint": text,
                    "pointer": {"type": "string", "description": "JSON pointer into the request"},
                    "faults": {"type": "array", "description": "what is wrong with the scene", "items": {
                        "type": "object",
                        "properties": {
                            "pointer": {"type": "string", "description": "JSON pointer into the scene"},
                            "line": place, "column": place,
                            "start": {"type": "integer", "description": "in UTF-16 units from the start of the text"},
                            "end": place, "message": text,
                            "hint": {"type": ["string", "null"]},
                        },
                    }},
                    "untold": {"type": "integer", "description": "faults beyond those told"},
                },
            },
        },
    })
}
