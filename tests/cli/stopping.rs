//! A wish to stop is followed at once, nothing is left behind, and nothing old looks new.

#![cfg(unix)]

use super::clsmith;
use super::hook::log;
use crate::support::wait_for;
use assert_cmd::Command;
use assert_cmd::assert::Assert;
use std::fs::{self, File};
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant, SystemTime};

const PROGRAM: &str = "RAPID\nGOTO/0.0,0.0,5.0\nFEDRAT/MMPM,800.0\nGOTO/10.0,0.0,-1.0\n";
const RECIPE: &str = "version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n";

fn shop() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("exports")).unwrap();
    fs::write(folder.path().join("exports/part.cls"), PROGRAM).unwrap();
    fs::write(folder.path().join("recipe.yaml"), RECIPE).unwrap();
    // The post writes beside the program that it is given, as most do.
    fs::write(folder.path().join("post.sh"), "cp \"$1\" \"$(dirname \"$1\")/part.nc\"\n").unwrap();
    folder
}

fn hook(folder: &Path) -> Command {
    let mut command = clsmith(folder);
    command.args(["hook", "--recipe", "recipe.yaml", "--log", "log.jsonl", "exports/part.cls"]);
    command.args(["--", "sh", "post.sh", "{}"]);
    command
}

fn stderr(done: &Assert) -> String {
    String::from_utf8_lossy(&done.get_output().stderr).into_owned()
}

/// A model on a share that gives no answer: a pipe that nobody writes to.
#[test]
fn a_hook_that_waits_for_a_model_ends_within_two_seconds_and_logs() {
    let folder = shop();
    let made = std::process::Command::new("mkfifo").arg(folder.path().join("setup.yaml")).status().unwrap();
    assert!(made.success());
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_clsmith"))
        .current_dir(folder.path())
        .args(["hook", "--recipe", "recipe.yaml", "--setup", "setup.yaml", "--log", "log.jsonl"])
        .args(["exports/part.cls", "--", "sh", "post.sh", "{}"])
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    wait_for("the log", || folder.path().join("log.jsonl").exists());
    std::thread::sleep(Duration::from_millis(500));
    let begun = Instant::now();
    let asked = std::process::Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap();
    assert!(asked.success());
    let ended = child.wait().unwrap();
    // A busy machine may take a little to start `kill` and to notice the end.
    assert!(begun.elapsed() < Duration::from_millis(2500), "{:?}", begun.elapsed());
    assert_eq!(ended.code(), Some(130));
    let lines = log(folder.path());
    assert_eq!((lines.len(), &lines[0]["outcome"]), (1, &serde_json::json!("stopped")));
    assert_eq!(lines[0]["exit"], 130);
}

#[test]
fn what_a_post_left_is_never_written_through_a_link_out_of_the_folder() {
    let folder = shop();
    fs::write(folder.path().join("elsewhere.nc"), "MINE").unwrap();
    std::os::unix::fs::symlink("../elsewhere.nc", folder.path().join("exports/part.nc")).unwrap();
    let done = hook(folder.path()).assert().code(125);
    assert!(stderr(&done).contains("leads out of"), "{}", stderr(&done));
    assert_eq!(fs::read(folder.path().join("elsewhere.nc")).unwrap(), b"MINE");
}

#[test]
fn an_older_result_does_not_look_like_that_of_a_refused_export() {
    let folder = shop();
    hook(folder.path()).assert().success();
    assert!(folder.path().join("exports/part.nc").exists());
    fs::write(folder.path().join("exports/part.cls"), "RAPID\nGOTO/0.0,0.0,x\n").unwrap();
    let done = hook(folder.path()).assert().code(125);
    assert!(stderr(&done).contains("CL0443"), "{}", stderr(&done));
    assert!(!folder.path().join("exports/part.nc").exists());
    assert!(folder.path().join("exports/part.nc.outdated").exists());
    // Put right, it is posted under its name again.
    fs::write(folder.path().join("exports/part.cls"), PROGRAM).unwrap();
    hook(folder.path()).assert().success();
    assert!(folder.path().join("exports/part.nc").exists());
}

#[test]
fn a_log_that_cannot_be_written_is_an_error() {
    let folder = shop();
    let done = clsmith(folder.path())
        .args(["hook", "--recipe", "recipe.yaml", "--log", "/dev/full", "exports/part.cls"])
        .args(["--", "sh", "post.sh", "{}"])
        .assert()
        .code(125);
    assert!(stderr(&done).contains("CL0402"), "{}", stderr(&done));
}

#[test]
fn left_overs_of_killed_runs_are_cleaned_by_the_next_one() {
    let folder = shop();
    let out = folder.path().join("out");
    fs::create_dir(&out).unwrap();
    let left = File::create(out.join(".clsmith-Xa81Qz.tmp")).unwrap();
    left.set_modified(SystemTime::now() - Duration::from_secs(3600)).unwrap();
    drop(left);
    let fresh = out.join(".clsmith-fresh1.tmp");
    fs::write(&fresh, "somebody may be at it").unwrap();
    clsmith(folder.path())
        .args(["apply", "recipe.yaml", "exports/part.cls", "-o", "out/part.cls"])
        .assert()
        .success();
    assert!(!out.join(".clsmith-Xa81Qz.tmp").exists());
    assert!(fresh.exists() && out.join("part.cls").exists());
}
