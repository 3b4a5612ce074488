//! The documentation site: its pages, what they link to, and the commands that they show.

#[cfg(unix)]
mod shown_commands;

use crate::support::require_program;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

fn project() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All pages in Markdown below a folder.
fn pages(folder: &Path) -> Vec<PathBuf> {
    let files =
        walkdir::WalkDir::new(folder).sort_by_file_name().into_iter().map(|entry| entry.unwrap().into_path());
    files.filter(|path| path.extension().is_some_and(|end| end == "md")).collect()
}

/// Targets of links and images outside of code.
fn targets(text: &str) -> Vec<String> {
    let prose = text.split("\n```").step_by(2).collect::<Vec<_>>().join("\n");
    let plain = prose.split('`').step_by(2).collect::<Vec<_>>().join("``");
    let links = plain.split("](").skip(1).filter_map(|rest| rest.split([')', ' ']).next());
    links.filter(|target| !target.contains("://") && !target.starts_with('#')).map(str::to_owned).collect()
}

/// Makes the pages of the site in a folder, with the command under test.
fn make_pages(folder: &Path) -> bool {
    let Some(python) = require_program(&["python3"]) else { return false };
    let mut command = Command::new(python);
    command.current_dir(project()).args([
        "scripts/book",
        "--clsmith",
        env!("CARGO_BIN_EXE_clsmith"),
        "--pages",
    ]);
    let done = command.arg(folder).output().unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    true
}

#[test]
fn the_site_has_every_page_and_every_link_leads_somewhere() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("pages");
    if !make_pages(&root) {
        return;
    }
    let summary = std::fs::read_to_string(root.join("SUMMARY.md")).unwrap();
    assert!(!summary.contains("<!--"), "{summary}");
    let listed = targets(&summary);
    let unique: BTreeSet<PathBuf> = listed.iter().map(|target| root.join(target)).collect();
    assert_eq!(unique.len(), listed.len(), "a page is listed twice");
    let written: BTreeSet<PathBuf> =
        pages(&root).into_iter().filter(|page| !page.ends_with("SUMMARY.md")).collect();
    assert_eq!(unique, written);

    let mut broken = Vec::new();
    for page in written {
        for target in targets(&std::fs::read_to_string(&page).unwrap()) {
            let file = target.split('#').next().unwrap();
            if !page.parent().unwrap().join(file).exists() {
                broken.push(format!("{}: {target}", page.display()));
            }
        }
    }
    assert!(broken.is_empty(), "{broken:#?}");

    let mut pictures = 0;
    for name in clsmith::transform::NAMES {
        let page = std::fs::read_to_string(root.join(format!("transforms/{name}.md"))).unwrap();
        assert!(page.contains("```diff\n@@"), "{name} shows what it changes");
        let picture = root.join(format!("transforms/{name}.svg"));
        assert_eq!(picture.exists(), page.contains(".svg)"), "{name}");
        pictures += usize::from(picture.exists());
    }
    assert!(pictures >= 9, "{pictures}");
}

#[test]
fn the_reference_has_every_key_of_a_setup_and_every_code() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("pages");
    if !make_pages(&root) {
        return;
    }
    let read = |name: &str| std::fs::read_to_string(root.join(name)).unwrap();
    let ask = |words: &[&str]| {
        let done = Command::new(env!("CARGO_BIN_EXE_clsmith")).args(words).output().unwrap();
        serde_json::from_slice::<serde_json::Value>(&done.stdout).unwrap()
    };
    let setup = read("files/setup.md");
    let schema = ask(&["schema", "--setup"]);
    let definitions = schema["$defs"].as_object().unwrap().values();
    for part in definitions.chain([&schema]) {
        for key in part["properties"].as_object().into_iter().flat_map(|keys| keys.keys()) {
            let shown = [format!("- **{key}**: "), format!("\n## {key}\n")];
            assert!(shown.iter().any(|text| setup.contains(text)), "{key}");
        }
    }
    let codes = read("codes.md");
    let all = ask(&["explain", "--json"]);
    assert!(all.as_array().unwrap().len() > 150);
    for code in all.as_array().unwrap() {
        assert!(codes.contains(&format!("\n## {}\n", code["code"].as_str().unwrap())), "{code}");
    }
}
