//! `scripts/release`, with a small program in the place of the binary, so that packing takes no time.

use super::{git, output, project, read};
use crate::support::require_program;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;

/// Makes a release of a program that is no clsmith; manual pages and completions come from the real one.
#[cfg(target_os = "linux")]
fn release(python: &Path, out: &Path) -> String {
    let given = [
        "scripts/release",
        "--binary",
        "/bin/true",
        "--local",
        env!("CARGO_BIN_EXE_clsmith"),
        "--out",
        out.to_str().unwrap(),
    ];
    output(python, &given)
}

#[cfg(target_os = "linux")]
#[test]
fn a_release_is_whole_and_the_same_twice() {
    let (Some(python), Some(_)) = (require_program(&["python3"]), git()) else { return };
    let folder = tempfile::tempdir().unwrap();
    let (first, second) = (folder.path().join("first"), folder.path().join("second"));
    let said = release(&python, &first);
    release(&python, &second);
    let sums = std::fs::read_to_string(first.join("SHA256SUMS")).unwrap();
    assert_eq!(sums, std::fs::read_to_string(second.join("SHA256SUMS")).unwrap(), "{said}");
    let archive = sums.lines().find(|line| line.ends_with(".tar.gz")).unwrap();
    let name = archive.split_once("  ").unwrap().1;

    let listed = output(Path::new("tar"), &["-tzf", first.join(name).to_str().unwrap()]);
    let top = name.strip_suffix(".tar.gz").unwrap();
    let inside: BTreeSet<&str> =
        listed.lines().map(|line| line.strip_prefix(&format!("{top}/")).unwrap()).collect();
    for file in [
        "clsmith",
        "README.md",
        "CHANGELOG.md",
        "LICENSE-MIT",
        "LICENSE-APACHE",
        "THIRD-PARTY.txt",
        "sbom.cdx.json",
        "man/clsmith.1",
        "man/clsmith-apply.1",
        "completions/clsmith.bash",
        "completions/_clsmith",
        "completions/clsmith.fish",
        "completions/clsmith.ps1",
        "schemas/clsmith-setup.schema.json",
        "configs/machines/vmc-3axis.yaml",
        "hooks/nx/clsmith_hook.tcl",
        "services/clsmith-watch@.service",
    ] {
        assert!(inside.contains(file), "{file} of {inside:?}");
    }
    let staged = first.join("stage").join(top);
    let script = std::fs::read(staged.join("hooks/nx/clsmith-hook.bat")).unwrap();
    assert!(script.windows(2).any(|pair| pair == b"\r\n"));
    let lone = script.iter().enumerate().filter(|(at, byte)| **byte == b'\n' && script[at - 1] != b'\r');
    assert_eq!(lone.count(), 0, "lines of a .bat that cmd.exe does not see");
    the_list_of_parts_is_closed(&std::fs::read_to_string(staged.join("sbom.cdx.json")).unwrap());
    licences_are_told(&std::fs::read_to_string(staged.join("THIRD-PARTY.txt")).unwrap());
}

/// Every part is named once, with its licence; what a part needs is a part; a crate has the checksum of the lock file.
fn the_list_of_parts_is_closed(text: &str) {
    let bill: Value = serde_json::from_str(text).unwrap();
    assert_eq!((&bill["bomFormat"], &bill["specVersion"]), (&"CycloneDX".into(), &"1.5".into()));
    let parts = bill["components"].as_array().unwrap();
    let names: BTreeSet<&str> = parts.iter().map(|part| part["bom-ref"].as_str().unwrap()).collect();
    assert_eq!(names.len(), parts.len());
    let lock = read("Cargo.lock");
    for part in parts {
        assert!(part["licenses"].as_array().is_some_and(|list| !list.is_empty()), "{part}");
        if part["purl"].is_string() {
            assert!(lock.contains(part["hashes"][0]["content"].as_str().unwrap()), "{part}");
        }
    }
    let own = bill["metadata"]["component"]["bom-ref"].as_str().unwrap();
    for needs in bill["dependencies"].as_array().unwrap() {
        let (from, to) = (needs["ref"].as_str().unwrap(), needs["dependsOn"].as_array().unwrap());
        assert!(from == own || names.contains(from), "{from}");
        assert!(to.iter().all(|to| names.contains(to.as_str().unwrap())), "{from}: {to:?}");
    }
    for wanted in ["nalgebra", "pest", "serde_yaml", "miette", "clap", "three", "DejaVu Sans", "std"] {
        assert!(parts.iter().any(|part| part["name"] == wanted), "{wanted}");
    }
    // Only tests need it.
    assert!(parts.iter().all(|part| part["name"] != "insta"));
}

fn licences_are_told(text: &str) {
    for wanted in ["nalgebra ", "three (MIT)", "DejaVu Sans (Bitstream-Vera)", "Permission is hereby granted"]
    {
        assert!(text.contains(wanted), "{wanted}");
    }
}

#[test]
fn workflows_call_what_is_there() {
    let mut calls = 0;
    for name in ["test", "release"] {
        let text = read(&format!(".github/workflows/{name}.yml"));
        let workflow: serde_yaml::Value = serde_yaml::from_str(&text).unwrap();
        assert!(workflow["jobs"].as_mapping().unwrap().len() >= 2, "{name}");
        for word in text.split_whitespace() {
            if ["scripts/", "packaging/", ".ci/"].iter().any(|folder| word.starts_with(folder)) {
                assert!(project().join(word).is_file(), "{name}: {word}");
                calls += 1;
            }
        }
    }
    assert!(calls >= 5, "{calls}");
}

#[test]
fn a_version_without_its_section_is_not_released() {
    let (Some(python), Some(_)) = (require_program(&["python3"]), git()) else { return };
    let check = "import sys; sys.path.insert(0, 'scripts'); sys.dont_write_bytecode = True\n\
                 from pathlib import Path; from release_parts import tree\n\
                 root = Path('.'); tree.check_changelog(root, tree.version(root))\n\
                 try: tree.check_changelog(root, '9.9.9')\n\
                 except SystemExit as stop: print(stop)";
    assert_eq!(output(&python, &["-c", check]).trim(), "release: CHANGELOG.md has no section `## 9.9.9`");
}
