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

/// A folder whose recipe simulates. The second program's cutter is so small that its stock has a hundred times as many
/// columns as that of the others.
fn tight_shop() -> tempfile::TempDir {
    let folder = shop();
    let program = |diameter: f64| {
        format!(
            "TOOL PATH/A,TOOL,B\nTLDATA/MILL,{diameter:.4},0.0000,75.0000,0.0000,0.0000\nLOAD/TOOL,3\nSPINDL/RPM,3200,CLW\n\
             RAPID\nGOTO/-10.0000,0.0000,5.0000\nFEDRAT/MMPM,700.0000\nGOTO/-10.0000,0.0000,-1.0000\n\
             GOTO/30.0000,0.0000,-1.0000\nRAPID\nGOTO/30.0000,0.0000,9.0000\nEND-OF-PATH\n"
        )
    };
    for (name, diameter) in [("a.cls", 12.0), ("b-large.cls", 1.2), ("c.cls", 12.0)] {
        fs::write(folder.path().join("in").join(name), program(diameter)).unwrap();
    }
    fs::remove_file(folder.path().join("in/b-unlucky.cls")).unwrap();
    let setup = "{ stock: { block: { from: [0, -10, -5], to: [20, 10, 0] } }, tools: [ { match: {}, teeth: 3 } ], \
        machine: { max_feed: 3000, rapid_feed: 15000 } }";
    let recipe = format!("version: 1\nsetup: {setup}\nsteps:\n  - optimize_feed: {{ target: 0.05 }}\n");
    fs::write(folder.path().join("recipe.yaml"), recipe).unwrap();
    folder
}

/// The command with memory for fewer columns than the small cutter needs: 3.6 MB.
fn tight(folder: &Path) -> Command {
    let mut command = clsmith(folder);
    command.env("CLSMITH_TEST_NO_MEMORY", "1000000");
    command
}

/// A failed allocation ends the process, if nobody asks first.
#[test]
fn a_file_without_memory_for_its_stock_stops_no_other_file() {
    let folder = tight_shop();
    let done = tight(folder.path())
        .args(["batch", "--recipe", "recipe.yaml", "--out", "out", "in/*.cls"])
        .assert()
        .code(1);
    let text = all_output(&done);
    assert!(text.contains("CL0442") && text.contains("no memory for columns of stock: 3.6 MB"), "{text}");
    let results = fs::read_to_string(folder.path().join("out/results.jsonl")).unwrap();
    assert_eq!(results.matches("\"corrected\"").count(), 2, "{results}");
    let args = ["watch", "in", "--recipe", "recipe.yaml", "--out", "watched", "--once", "*.cls"];
    let pace = ["--settle", "0.1", "--poll", "0.05", "--log", "log.jsonl"];
    let large = folder.path().join("in/b-large.cls");
    let program = fs::read(&large).unwrap();
    let done = tight(folder.path()).args(args).args(pace).assert().code(1);
    assert!(all_output(&done).contains("CL0442"));
    assert!(folder.path().join("watched/a.cls").exists() && folder.path().join("watched/c.cls").exists());
    fs::write(&large, program).unwrap();
    let hook = ["hook", "--recipe", "recipe.yaml", "in/b-large.cls", "--", "cp", "{}", "x"];
    let done = tight(folder.path()).args(hook).assert().code(125);
    assert!(all_output(&done).contains("CL0442"));
    clsmith(folder.path()).args(hook).assert().code(0);
}

#[test]
fn a_model_without_memory_is_an_error() {
    let folder = shop();
    let mut stl = vec![0_u8; 84];
    stl[80..84].copy_from_slice(&100_000_u32.to_le_bytes());
    stl.resize(84 + 50 * 100_000, 0);
    fs::write(folder.path().join("part.stl"), stl).unwrap();
    let args = ["section", "part.stl", "--radius", "5", "--step", "0.5", "--feed", "800", "--dry-run"];
    let done = tight(folder.path()).args(args).assert().code(1);
    assert!(
        all_output(&done).contains("there is no memory for the vertices of a mesh"),
        "{}",
        all_output(&done)
    );
}
