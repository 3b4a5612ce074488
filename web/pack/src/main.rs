//! Puts the viewer together: one page that holds the library, the report's page and an example.
//!
//! `pack-viewer MODULE.wasm PAGE.html`: the compiled module, and where the page goes.

#[allow(dead_code)]
#[path = "../../../src/report/html/page_files.rs"]
mod page_files;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::DeflateEncoder;
use sha2::{Digest, Sha256};
use std::error::Error;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

const TEMPLATE: &str = include_str!("../../page/viewer.html");
const STYLE: &str = include_str!("../../page/viewer.css");
const FRAME_STYLE: &str = include_str!("../../page/frame.css");
const GIVEN: &str = include_str!("../../page/given.js");
const WORKER: &str = include_str!("../../page/worker.js");

/// The scripts of the viewer itself, in the order in which they are read. They share one scope.
const SCRIPTS: [&str; 5] = [
    include_str!("../../page/drops.js"),
    include_str!("../../page/files.js"),
    include_str!("../../page/task.js"),
    include_str!("../../page/report_frame.js"),
    include_str!("../../page/viewer.js"),
];

const EXAMPLE: [(&str, &str); 3] = [
    ("part.cls", include_str!("../../../examples/web-pocket/part.cls")),
    ("recipe.yaml", include_str!("../../../examples/web-pocket/recipe.yaml")),
    ("shop.yaml", include_str!("../../../examples/web-pocket/shop.yaml")),
];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [module, page] = arguments.as_slice() else { return Err("pack-viewer MODULE.wasm PAGE.html".into()) };
    let mut bound = wasm_bindgen_cli_support::Bindgen::new();
    bound
        .input_path(module)
        .no_modules(true)?
        .typescript(false)
        .remove_name_section(true)
        .remove_producers_section(true);
    let mut bound = bound.generate_output()?;
    let wasm = bound.wasm_mut().emit_wasm();
    let glue = bound.js();
    let html = write_viewer(&wasm, glue)?;
    std::fs::write(Path::new(page), &html)?;
    println!("{page}: {} bytes, the module {} bytes", html.len(), wasm.len());
    Ok(())
}

/// Returns the viewer's page.
fn write_viewer(wasm: &[u8], glue: &str) -> Result<String, Box<dyn Error>> {
    let script = format!("(() => {{\n\"use strict\";\n{}}})();\n", SCRIPTS.concat());
    let frame_script = page_files::join_scripts(GIVEN);
    let frame_style = format!("{}{FRAME_STYLE}", page_files::STYLE);
    let mut scripts = vec![hash(&script), hash(&frame_script)];
    scripts.extend(page_files::LIBRARIES.iter().map(|(_, library, _)| hash(library)));
    let policy = format!(
        "default-src 'none'; base-uri 'none'; form-action 'none'; img-src data: blob:; worker-src blob:; style-src {} {}; \
         script-src 'wasm-unsafe-eval' {}",
        hash(STYLE),
        hash(&frame_style),
        scripts.join(" ")
    );
    let report = write_report_parts(&frame_style, &frame_script, &policy)?;
    let mut data = String::new();
    let example: String = write_json(&EXAMPLE);
    let parts = [
        ("module", wasm),
        ("worker", format!("{glue}\n{WORKER}").as_bytes()),
        ("report", report.as_bytes()),
        ("example-files", example.as_bytes()),
    ]
    .map(|(id, bytes)| (id, deflate(bytes)));
    for (id, deflated) in parts {
        writeln!(data, "<template id=\"{id}\">{}</template>", STANDARD.encode(deflated?))?;
    }
    let mut page = String::new();
    for (index, piece) in TEMPLATE.split("{{").enumerate() {
        let (mark, text) = piece.split_once("}}").filter(|_| index > 0).unwrap_or(("", piece));
        match mark {
            "" => {}
            "policy" => page.push_str(&policy),
            "styles" => write!(page, "<style>{STYLE}</style>")?,
            "data" => page.push_str(&data),
            "scripts" => write!(page, "<script>{script}</script>")?,
            _ => return Err(format!("the viewer has no part {mark}").into()),
        }
        page.push_str(text);
    }
    Ok(page)
}

/// Returns what is the same in every report, as JSON.
fn write_report_parts(style: &str, script: &str, policy: &str) -> Result<String, Box<dyn Error>> {
    let (mut scripts, mut licences) = (String::new(), String::new());
    for (name, library, licence) in page_files::LIBRARIES {
        writeln!(scripts, "<script>{library}</script>")?;
        let licence = licence.replace('&', "&amp;").replace('<', "&lt;");
        write!(licences, "<h3>{name}</h3><pre>{licence}</pre>")?;
    }
    writeln!(scripts, "<script>{script}</script>")?;
    let styles = format!("<style>{style}</style>");
    Ok(write_json(&[
        ("template", page_files::TEMPLATE),
        ("styles", &styles),
        ("scripts", &scripts),
        ("licences", &licences),
        ("policy", policy),
    ]))
}

/// Returns texts by name as JSON.
fn write_json(texts: &[(&str, &str)]) -> String {
    let quote = |text: &str| {
        let mut quoted = String::from("\"");
        for letter in text.chars() {
            match letter {
                '"' => quoted.push_str("\\\""),
                '\\' => quoted.push_str("\\\\"),
                '\n' => quoted.push_str("\\n"),
                control if (control as u32) < 0x20 => quoted.push_str(&format!("\\u{:04x}", control as u32)),
                other => quoted.push(other),
            }
        }
        quoted + "\""
    };
    let members: Vec<String> =
        texts.iter().map(|(name, text)| format!("{}:{}", quote(name), quote(text))).collect();
    format!("{{{}}}", members.join(","))
}

/// Returns how a policy names a script or a style.
fn hash(text: &str) -> String {
    format!("'sha256-{}'", STANDARD.encode(Sha256::digest(text.as_bytes())))
}

fn deflate(bytes: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    encoder.finish()
}
