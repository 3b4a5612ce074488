//! A defect of clsmith in one file stops no other file. The tests make it panic on a file of their choice.

use super::hook::log;
use super::{clsmith, names};
use assert_cmd::Command;
use assert_cmd::assert::Assert;
use std::fs;
use std::path::Path;

const PROGRAM: &str = "RAPID\nGOTO/0.0,0.0,5.0\nFEDRAT/MMPM,800.0\nGOTO/10.0,0.0,-1.0\n";
const RECIPE: &str = "version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n";

/// A recipe and three programs, of which the second one is the unlucky one.
fn shop() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("in")).unwrap();
    for name in ["a.cls", "b-unlucky.cls", "c.cls"] {
        fs::write(folder.path().join("in").join(name), PROGRAM).unwrap();
    }
    fs::write(folder.path().join("recipe.yaml"), RECIPE).unwrap();
    folder
}

fn unlucky(folder: &Path) -> Command {
    let mut command = clsmith(folder);
    command.env("CLSMITH_TEST_PANIC", "unlucky");
    command
}

/// The defect is told as a finding with its place and what to do, and not as Rust tells it.
fn assert_defect_is_told(done: &Assert) {
    let text = String::from_utf8_lossy(&done.get_output().stderr).into_owned();
    assert!(text.contains("CL0440"), "{text}");
    assert!(text.contains("b-unlucky.cls") && text.contains("run_limits.rs"), "{text}");
    assert!(text.contains("Send this message"), "{text}");
    assert!(!text.contains("panicked") && !text.contains("RUST_BACKTRACE"), "{text}");
}

fn assert_others_are_done(folder: &Path, out: &str) {
    for name in ["a.cls", "c.cls"] {
        let text = fs::read_to_string(folder.join(out).join(name)).unwrap();
        assert!(text.contains("FEDRAT/MMPM,400.0"), "{text}");
    }
    assert!(!folder.join(out).join("b-unlucky.cls").exists());
}

#[test]
fn batch_goes_on_with_the_next_file() {
    let folder = shop();
    let done = unlucky(folder.path())
        .args(["batch", "--recipe", "recipe.yaml", "--output", "out", "in/*.cls"])
        .assert()
        .code(1);
    assert_defect_is_told(&done);
    assert_others_are_done(folder.path(), "out");
    let results = fs::read_to_string(folder.path().join("out/results.jsonl")).unwrap();
    assert_eq!(results.matches("\"outcome\"").count(), 3, "{results}");
    assert_eq!(results.matches("CL0440").count(), 1, "{results}");
}

#[test]
fn watch_goes_on_with_the_next_file_and_moves_the_unlucky_one_aside() {
    let folder = shop();
    let args = ["watch", "in", "--recipe", "recipe.yaml", "--output", "out", "--once", "*.cls"];
    let pace = ["--settle", "0.1", "--poll", "0.05", "--log", "log.jsonl"];
    let done = unlucky(folder.path()).args(args).args(pace).assert().code(1);
    assert_defect_is_told(&done);
    assert_others_are_done(folder.path(), "out");
    assert!(folder.path().join("out/refused/b-unlucky.cls").exists());
    let lines = log(folder.path());
    assert_eq!(lines.len(), 3);
    assert!(lines.iter().any(|line| line["outcome"] == "refused" && line["findings"]["CL0440"] == 1));
}

#[test]
fn apply_goes_on_with_the_next_file() {
    let folder = shop();
    fs::create_dir(folder.path().join("out")).unwrap();
    let files = ["in/a.cls", "in/b-unlucky.cls", "in/c.cls"];
    let done = unlucky(folder.path())
        .args(["apply", "recipe.yaml"])
        .args(files)
        .args(["-o", "out"])
        .assert()
        .code(1);
    assert_defect_is_told(&done);
    assert_others_are_done(folder.path(), "out");
}

#[test]
fn hook_posts_nothing_and_logs() {
    let folder = shop();
    let done = unlucky(folder.path())
        .args([
            "hook",
            "--recipe",
            "recipe.yaml",
            "--log",
            "log.jsonl",
            "in/b-unlucky.cls",
            "--",
            "cp",
            "{}",
            "x",
        ])
        .assert()
        .code(125);
    assert_defect_is_told(&done);
    assert!(!names(folder.path()).iter().any(|name| name == Path::new("x")));
    let lines = log(folder.path());
    assert_eq!((lines.len(), &lines[0]["exit"]), (1, &serde_json::json!(125)));
    assert_eq!(lines[0]["findings"]["CL0440"], 1);
}

/// What was written to both outputs.
fn all_output(done: &Assert) -> String {
    let output = done.get_output();
    format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr))
}

/// What has no end is refused, by every command that reads files.
#[cfg(unix)]
#[test]
fn a_device_is_refused_and_not_read() {
    let folder = shop();
    for args in [
        &["check", "/dev/zero"][..],
        &["stats", "/dev/zero"],
        &["apply", "recipe.yaml", "/dev/zero", "--dry-run"],
        &["apply", "/dev/zero", "in/a.cls", "--dry-run"],
    ] {
        let done = clsmith(folder.path()).args(args).assert().code(1);
        let text = all_output(&done);
        assert!(text.contains("it is a device"), "{args:?}: {text}");
    }
    let zero = fs::File::open("/dev/zero").unwrap();
    let done = std::process::Command::new(env!("CARGO_BIN_EXE_clsmith"))
        .current_dir(folder.path())
        .args(["check", "-"])
        .stdin(zero)
        .output()
        .unwrap();
    assert_eq!(done.status.code(), Some(1));
}

#[test]
fn a_file_above_4_gib_is_refused_by_its_size() {
    let folder = shop();
    let file = fs::File::create(folder.path().join("large.cls")).unwrap();
    file.set_len(5 << 30).unwrap();
    let done = clsmith(folder.path()).args(["check", "large.cls"]).assert().code(1);
    let text = all_output(&done);
    assert!(text.contains("CL0403") && text.contains("below 4 GiB"), "{text}");
}
