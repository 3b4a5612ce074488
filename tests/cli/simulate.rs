//! `clsmith simulate`.

use super::{clsmith, names};
use crate::report::simulation::{SHOP, SLOT};
use crate::support;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn job() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("part.cls"), SLOT).unwrap();
    std::fs::write(folder.path().join("shop.yaml"), SHOP).unwrap();
    folder
}

fn run(folder: &Path, args: &[&str]) -> assert_cmd::assert::Assert {
    clsmith(folder).args(["simulate", "part.cls", "--setup", "shop.yaml"]).args(args).assert()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn every_output_is_written() {
    let folder = job();
    let outputs = ["--csv", "a.csv", "--json", "a.json", "--stl", "a.stl", "--save-stock", "a.clstock"];
    let done = run(folder.path(), &[&outputs[..], &["--plot", "a.svg"]].concat()).success();
    assert_eq!(
        names(folder.path()),
        ["a.clstock", "a.csv", "a.json", "a.stl", "a.svg", "part.cls", "shop.yaml"].map(PathBuf::from)
    );
    let shown = text(&done.get_output().stdout);
    assert!(shown.contains("thickest chip: 0.0500 mm on line 12"), "{shown}");
    assert!(done.get_output().stderr.is_empty(), "no bar where there is no terminal");
    // What is left is stock for the next program, and a part that the same program gouges nowhere.
    let left = SHOP.replace("{ block: { from: [0, 0, -10], to: [60, 40, 0] } }", "{ file: a.clstock }");
    std::fs::write(folder.path().join("next.yaml"), left).unwrap();
    let done =
        clsmith(folder.path()).args(["simulate", "part.cls", "--setup", "next.yaml"]).assert().success();
    assert!(text(&done.get_output().stdout).contains("nothing is cut"));
    let done =
        run(folder.path(), &["--target", "a.stl", "--plot", "b.svg", "--plot-before", "part.cls"]).success();
    assert!(text(&done.get_output().stdout).contains("no gouge"));
}

#[test]
fn the_same_bytes_whatever_the_threads() {
    let folder = job();
    for threads in ["1", "2", "5"] {
        let name = format!("{threads}.csv");
        run(folder.path(), &["--threads", threads, "--csv", &name, "-q"]).success().stdout("").stderr("");
    }
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert!(read("1.csv") == read("2.csv") && read("1.csv") == read("5.csv"));
}

#[test]
fn a_table_goes_to_standard_output() {
    let folder = job();
    let done = run(folder.path(), &["--csv", "-"]).success();
    let (out, err) = (text(&done.get_output().stdout), text(&done.get_output().stderr));
    assert!(out.starts_with("line,operation,tool,length_mm,") && out.lines().count() == 8, "{out}");
    assert!(err.contains("thickest chip"), "{err}");
    let done = run(folder.path(), &["--json", "-", "-q"]).success();
    assert!(serde_json::from_slice::<serde_json::Value>(&done.get_output().stdout).is_ok());
    let part = clsmith(folder.path())
        .args(["simulate", "-", "--setup", "shop.yaml", "--csv", "-"])
        .write_stdin(SLOT)
        .assert()
        .success();
    assert_eq!(text(&part.get_output().stdout), out);
}

#[test]
fn analysis_is_written_also_when_errors_were_found() {
    let folder = job();
    std::fs::write(folder.path().join("part.cls"), SLOT.replace("4000.0000", "0.0000")).unwrap();
    let outputs = ["--csv", "a.csv", "--stl", "a.stl", "--save-stock", "a.clstock"];
    let done = run(folder.path(), &outputs).code(1);
    // Only the stock for the next program is not: it would carry on what went wrong in this one.
    assert_eq!(names(folder.path()), ["a.csv", "a.stl", "part.cls", "shop.yaml"].map(PathBuf::from));
    let shown = text(&done.get_output().stderr);
    support::snapshots("cli").bind(|| insta::assert_snapshot!("simulate_zero_spindle", shown));
    run(folder.path(), &["--csv", "a.csv", "--allow", "CL0516"]).success();
    std::fs::write(folder.path().join("shop.yaml"), "machine: {}\n").unwrap();
    let done = run(folder.path(), &["--csv", "b.csv"]).code(1);
    assert!(text(&done.get_output().stderr).contains("CL0503"));
    assert!(!folder.path().join("b.csv").exists());
}

#[test]
fn a_gouge_is_an_error() {
    let folder = job();
    run(folder.path(), &["--stl", "part.stl", "-q"]).success();
    let deep = SLOT.replace(",-2.0000", ",-3.0000");
    std::fs::write(folder.path().join("part.cls"), deep).unwrap();
    let done = run(folder.path(), &["--target", "part.stl", "--csv", "a.csv"]).code(1);
    let shown = text(&done.get_output().stderr);
    assert!(shown.contains("CL0518") && shown.contains("1.000 mm along z"), "{shown}");
    assert!(folder.path().join("a.csv").exists());
    run(folder.path(), &["--target", "part.stl", "--tolerance", "1.1", "--csv", "a.csv"]).success();
}

#[test]
fn no_input_is_overwritten() {
    let folder = job();
    run(folder.path(), &["--save-stock", "left.clstock", "--stl", "left.stl", "-q"]).success();
    let next = SHOP.replace("{ block: { from: [0, 0, -10], to: [60, 40, 0] } }", "{ file: left.clstock }");
    std::fs::write(folder.path().join("shop.yaml"), next).unwrap();
    for output in ["part.cls", "./shop.yaml", "left.clstock", "left.stl"] {
        let before = std::fs::read(folder.path().join(output)).unwrap();
        let done = run(folder.path(), &["--csv", output, "--target", "left.stl"]).code(1);
        assert!(text(&done.get_output().stderr).contains("CL0404"), "{output}");
        assert_eq!(std::fs::read(folder.path().join(output)).unwrap(), before);
    }
}

#[test]
fn the_command_line_is_checked_and_the_help_has_examples() {
    let folder = job();
    run(folder.path(), &["--csv", "-", "--json", "-"]).code(2);
    run(folder.path(), &["--csv", "a", "--json", "a"]).code(2);
    run(folder.path(), &["--stl", "-"]).code(2);
    run(folder.path(), &["--cell", "0"]).code(2);
    run(folder.path(), &["--tolerance", "1"]).code(2);
    run(folder.path(), &["--plot-before", "part.cls"]).code(2);
    clsmith(folder.path()).args(["simulate", "part.cls"]).assert().code(2);
    assert_eq!(names(folder.path()), ["part.cls", "shop.yaml"].map(PathBuf::from));
    let help = clsmith(folder.path()).args(["simulate", "--help"]).assert().success();
    let help = text(&help.get_output().stdout);
    assert!(help.contains("Examples:") && help.contains("engagement_start_deg"), "{help}");
}

#[test]
fn the_stock_at_a_line_is_that_of_the_program_up_to_it() {
    let folder = job();
    let whole = run(folder.path(), &["--json", "whole.json", "-q"]).success();
    drop(whole);
    let volume = |name: &str| {
        let text = std::fs::read_to_string(folder.path().join(name)).unwrap();
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        json["stock"]["removed_mm3"].as_f64().unwrap_or_else(|| panic!("{json}"))
    };
    let lines = SLOT.lines().count();
    let mut last = 0.0;
    for line in 1..=lines {
        let name = format!("at-{line}.json");
        let ran = run(folder.path(), &["--until", &line.to_string(), "--json", &name, "-q"]);
        let first = SLOT.lines().position(|text| text.starts_with("GOTO")).unwrap() + 1;
        if line < first {
            ran.failure();
            continue;
        }
        ran.success();
        let removed = volume(&name);
        assert!(removed >= last, "line {line}: {removed} after {last}");
        last = removed;
    }
    assert!(last > 0.0 && (last - volume("whole.json")).abs() < 1e-9);
    let beyond = run(folder.path(), &["--until", "4000"]).failure();
    let told = text(&beyond.get_output().stderr);
    assert!(told.contains("CL0524") && told.contains(&format!("{lines} lines")), "{told}");
}
