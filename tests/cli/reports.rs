//! `--report` and `--summary`.

use super::{clsmith, names};
use crate::report::simulation::{SHOP, SLOT};
use std::path::PathBuf;
use tempfile::TempDir;

fn job() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [
        ("part.cls", SLOT),
        ("shop.yaml", SHOP),
        ("recipe.yaml", "version: 1\nsetup_file: shop.yaml\nsteps:\n  - scale_feed: { factor: 0.5 }\n"),
    ] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

fn read(folder: &TempDir, name: &str) -> String {
    std::fs::read_to_string(folder.path().join(name)).unwrap()
}

#[test]
fn apply_writes_page_and_summary() {
    let folder = job();
    let run =
        |args: &[&str]| clsmith(folder.path()).args(["apply", "recipe.yaml", "part.cls"]).args(args).assert();
    run(&["-o", "out.cls", "--report", "out.html", "--summary", "out.md", "-q"])
        .success()
        .stdout("")
        .stderr("");
    let page = read(&folder, "out.html");
    for part in [
        "<!doctype html>",
        "data-array=\"before.chip\"",
        "data-array=\"after.power\"",
        "setup_file: shop.yaml",
        "teeth: 4",
    ] {
        assert!(page.contains(part), "{part}");
    }
    let summary = read(&folder, "out.md");
    assert!(summary.contains("| thickest chip, mm | 0.0500 | 0.0250 | -50.0 % |"), "{summary}");
    assert!(summary.contains("| time at feed, with acceleration | 12.4 s | 24.8 s |"), "{summary}");
    // Without writing the program, on standard output.
    let done = run(&["--dry-run", "--summary", "-", "-q"]).success();
    assert_eq!(String::from_utf8_lossy(&done.get_output().stdout), summary);
    assert_eq!(
        names(folder.path()),
        ["out.cls", "out.html", "out.md", "part.cls", "recipe.yaml", "shop.yaml"].map(PathBuf::from)
    );
}

#[test]
fn a_report_without_stock_is_no_error() {
    let folder = job();
    std::fs::write(
        folder.path().join("recipe.yaml"),
        "version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n",
    )
    .unwrap();
    let args = ["apply", "recipe.yaml", "part.cls", "-o", "out.cls", "--report", "out.html"];
    clsmith(folder.path()).args(args).assert().success();
    assert!(read(&folder, "out.html").contains("a simulation needs the stock"));
}

#[test]
fn simulate_shows_one_program() {
    let folder = job();
    let args =
        ["simulate", "part.cls", "--setup", "shop.yaml", "-q", "--report", "a.html", "--summary", "a.md"];
    clsmith(folder.path()).args(args).assert().success();
    let page = read(&folder, "a.html");
    assert!(page.contains("data-array=\"after.chip\"") && !page.contains("data-array=\"before.chip\""));
    assert!(read(&folder, "a.md").contains("| thickest chip, mm | 0.0500 |"));
}

#[test]
fn reports_share_no_file_with_anything() {
    let folder = job();
    for (args, said) in [
        (&["-o", "a.cls", "--report", "a.cls"][..], "--report and -o name one file"),
        (
            &["-o", "a.cls", "--report", "a.html", "--summary", "a.html"],
            "--summary and --report name one file",
        ),
        (&["-o", "-", "--report", "-"], "--report - would go to standard output"),
        (&["--dry-run", "--report", "-", "--summary", "-"], "both write to standard output"),
        (&["part.cls", "--dry-run", "--report", "a.html"], "--report shows one program"),
    ] {
        let done =
            clsmith(folder.path()).args(["apply", "recipe.yaml", "part.cls"]).args(args).assert().code(2);
        let told = String::from_utf8_lossy(&done.get_output().stderr).into_owned();
        assert!(told.contains(said), "{told}");
    }
    for input in ["part.cls", "shop.yaml", "recipe.yaml"] {
        clsmith(folder.path())
            .args(["apply", "recipe.yaml", "part.cls", "-o", "a.cls", "--report", input])
            .assert()
            .code(1);
    }
    assert_eq!(names(folder.path()).len(), 3);
    assert_eq!(read(&folder, "part.cls"), SLOT);
}

#[test]
fn reports_are_written_of_a_program_that_is_refused() {
    let folder = job();
    std::fs::write(folder.path().join("part.cls"), SLOT.replace("GOTO/70.0000,15", "GOTO/70..0000,15"))
        .unwrap();
    let args = ["apply", "recipe.yaml", "part.cls", "-o", "a.cls", "--report", "a.html", "--summary", "a.md"];
    clsmith(folder.path()).args(args).assert().code(1);
    assert!(!folder.path().join("a.cls").exists());
    assert!(read(&folder, "a.md").contains("- **error** CL0003 part.cls:"));
    assert!(read(&folder, "a.html").contains("error[CL0003]"));
}
