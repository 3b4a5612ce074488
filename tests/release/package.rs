//! The package for the registry of crates, and the version.

use super::{output, project, read};
use flate2::{Compression, write::GzEncoder};
use std::io::Write;
use std::path::Path;

fn packaged_files() -> Vec<String> {
    let list = output(Path::new(env!("CARGO")), &["package", "--list", "--allow-dirty", "--offline"]);
    list.lines().map(|line| line.replace('\\', "/")).collect()
}

#[test]
fn the_package_has_what_it_is_compiled_of_and_no_test_data() {
    let files = packaged_files();
    let folders = ["src/", "grammar/", "configs/", "schemas/"];
    let pages =
        ["README.md", "ARCHITECTURE.md", "CHANGELOG.md", "CONTRIBUTING.md", "LICENSE-MIT", "LICENSE-APACHE"];
    let made = ["Cargo.toml", "Cargo.toml.orig", "Cargo.lock", ".cargo_vcs_info.json"];
    for file in &files {
        let known = folders.iter().any(|folder| file.starts_with(folder));
        assert!(known || pages.contains(&file.as_str()) || made.contains(&file.as_str()), "{file}");
    }
    // Read at compile time: without one of them the published crate does not compile, or its documentation not.
    for needed in ["grammar/cl.pest", "grammar/rewrite.pest", "src/report/html/vendor/three.iife.min.js"] {
        assert!(files.iter().any(|file| file == needed), "{needed}");
    }
    assert!(pages.iter().all(|page| files.iter().any(|file| file == page)));
}

#[test]
fn the_package_stays_small() {
    // As cargo packs it: one stream, level 9. Measured: 1.53 MB, 1.26 MB of them the Rust sources alone.
    let mut packed = GzEncoder::new(Vec::new(), Compression::best());
    for file in packaged_files() {
        if let Ok(bytes) = std::fs::read(project().join(&file)) {
            packed.write_all(&bytes).unwrap();
        }
    }
    let size = packed.finish().unwrap().len();
    assert!((500_000..1_800_000).contains(&size), "{size} bytes");
}

#[test]
fn the_version_has_its_section_in_the_list_of_changes() {
    let version = env!("CARGO_PKG_VERSION");
    let changes = read("CHANGELOG.md");
    let heads: Vec<&str> = changes.lines().filter_map(|line| line.strip_prefix("## ")).collect();
    assert!(heads[0].split(' ').next() == Some(version), "{heads:?} begins with {version}");
    // The wheel for Python has the same.
    let wheel = read("python/Cargo.toml");
    assert!(wheel.lines().any(|line| line == format!("version = \"{version}\"")), "{wheel}");
    // The list of steps there is the list of steps.
    for name in clsmith::transform::NAMES {
        assert!(changes.contains(&format!("`{name}`")), "{name}");
    }
}
