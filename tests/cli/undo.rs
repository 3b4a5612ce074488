//! `apply --provenance`, `apply --json` and `undo`.

use super::{clsmith, example, names};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A folder with a corrected program and its report.
fn corrected() -> TempDir {
    let folder = example("pocket");
    let args = [
        "apply",
        "recipe.yaml",
        "part.cls",
        "-o",
        "out.cls",
        "--provenance",
        "comments",
        "--json",
        "out.json",
    ];
    clsmith(folder.path()).args(args).arg("-q").assert().success().stdout("").stderr("");
    folder
}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap()
}

#[test]
fn apply_and_undo_give_the_original_back() {
    let folder = corrected();
    let out = read(folder.path(), "out.cls");
    assert!(out.contains("$$ clsmith scale_feed: 1200.0000 -> 600.0000\nFEDRAT/MMPM,600.0000\n"), "{out}");
    let done = clsmith(folder.path())
        .args(["undo", "out.cls", "--report", "out.json", "-o", "again.cls"])
        .assert()
        .success();
    let told = String::from_utf8_lossy(&done.get_output().stderr).into_owned();
    assert!(
        told.starts_with("out.cls: 4 places undone -> again.cls\n  the original, sha256 a4bfbd93"),
        "{told}"
    );
    assert_eq!(read(folder.path(), "again.cls"), read(folder.path(), "part.cls"));
    // To standard output, from standard input.
    let done = clsmith(folder.path())
        .args(["undo", "-", "--report", "out.json", "-o", "-", "-q"])
        .write_stdin(out)
        .assert()
        .success()
        .stderr("");
    assert_eq!(String::from_utf8_lossy(&done.get_output().stdout), read(folder.path(), "part.cls"));
}

#[test]
fn the_report_is_json_for_other_programs() {
    let folder = corrected();
    let report: serde_json::Value = serde_json::from_str(&read(folder.path(), "out.json")).unwrap();
    assert_eq!(report["format"], "clsmith run");
    assert_eq!(report["provenance"], "comments");
    assert_eq!(report["input"]["file"], "part.cls");
    assert_eq!(report["output"]["file"], "out.cls");
    assert_eq!(report["changes"]["steps"][0]["edited"]["feed"], 1);
    assert_eq!(report["changes"]["steps"][3]["name"], "provenance");
    assert_eq!(report["recipe"]["files"][0]["path"], "recipe.yaml");
    // The header has the same digests, in two halves.
    let (out, whole) = (read(folder.path(), "out.cls"), report["recipe"]["sha256"].as_str().unwrap());
    for half in [&whole[..32], &whole[32..]] {
        assert!(out.contains(&format!("$$ clsmith recipe and files sha256 {half}\n")), "{out}");
    }
}

#[test]
fn a_recipe_asks_for_comments_and_the_command_line_overrides_it() {
    let folder = example("pocket");
    let recipe = read(folder.path(), "recipe.yaml").replace("units: mm", "units: mm\nprovenance: comments");
    std::fs::write(folder.path().join("said.yaml"), recipe).unwrap();
    let run = |args: &[&str]| {
        let done = clsmith(folder.path())
            .arg("apply")
            .args(args)
            .args(["part.cls", "-o", "-", "-q"])
            .assert()
            .success();
        String::from_utf8_lossy(&done.get_output().stdout).matches("$$ clsmith ").count()
    };
    assert_eq!(run(&["recipe.yaml"]), 0);
    assert_eq!(run(&["said.yaml"]), 11);
    assert_eq!(run(&["said.yaml", "--provenance", "none"]), 0);
    assert_eq!(run(&["said.yaml", "--provenance", "header"]), 7);
    assert_eq!(run(&["recipe.yaml", "--provenance", "header"]), 7);
    let args = ["apply", "recipe.yaml", "part.cls", "-o", "-", "--provenance", "full"];
    let done = clsmith(folder.path()).args(args).assert().code(2);
    assert!(String::from_utf8_lossy(&done.get_output().stderr).contains("this is none, header or comments"));
}

#[test]
fn hook_and_batch_write_the_same_comments_as_apply() {
    let folder = example("pocket");
    let recipe = read(folder.path(), "recipe.yaml").replace("units: mm", "units: mm\nprovenance: comments");
    std::fs::write(folder.path().join("recipe.yaml"), recipe).unwrap();
    let run = |args: &[&str]| clsmith(folder.path()).args(args).assert().success();
    run(&["apply", "recipe.yaml", "part.cls", "-o", "apply.cls", "-q"]);
    run(&["hook", "--recipe", "recipe.yaml", "--keep", "hook.cls", "-q", "part.cls", "--", "true", "{}"]);
    run(&["batch", "--recipe", "recipe.yaml", "--output", "done", "part.cls", "-q"]);
    let apply = read(folder.path(), "apply.cls");
    assert_eq!(read(folder.path(), "hook.cls"), apply);
    assert_eq!(read(folder.path(), "done/part.cls"), apply);
}

#[test]
fn what_undo_refuses_it_does_not_write() {
    let folder = corrected();
    let args = ["apply", "recipe.yaml", "part.cls", "--dry-run", "--report", "page.html", "-q"];
    clsmith(folder.path()).args(args).assert().success();
    let before = names(folder.path());
    let run = |args: &[&str], exit: i32, says: &str| {
        let done =
            clsmith(folder.path()).arg("undo").args(args).args(["--format", "line"]).assert().code(exit);
        let told = String::from_utf8_lossy(&done.get_output().stderr).into_owned();
        assert!(told.contains(says), "{told}");
    };
    run(&["out.cls", "--report", "page.html", "-o", "a.cls"], 1, "CL0430: this is a page for people");
    run(&["part.cls", "--report", "out.json", "-o", "a.cls"], 1, "CL0432: this is the original already");
    run(
        &["recipe.yaml", "--report", "out.json", "-o", "a.cls"],
        1,
        "CL0432: the file is not the one that the run wrote",
    );
    run(&["none.cls", "--report", "out.json", "-o", "a.cls"], 1, "CL0401");
    run(&["out.cls", "--report", "out.json", "-o", "out.cls"], 1, "CL0404");
    run(&["out.cls", "--report", "out.json", "-o", "out.json"], 1, "CL0404");
    run(&["out.cls", "--report", "out.json", "-o", "no/a.cls"], 1, "CL0402");
    run(&["-", "--report", "-", "-o", "a.cls"], 2, "standard input can be read only once");
    run(&["out.cls", "--report", "out.json", "-o", "a.cls", "--allow", "CL0432"], 2, "cannot be allowed");
    run(&["out.cls", "--report", "out.json"], 2, "--output");
    assert_eq!(names(folder.path()), before);
}

#[test]
fn the_report_shares_no_file_with_anything() {
    let folder = example("pocket");
    let run = |args: &[&str], exit: i32| {
        clsmith(folder.path()).args(["apply", "recipe.yaml", "part.cls"]).args(args).assert().code(exit);
    };
    run(&["-o", "a.cls", "--json", "a.cls"], 2);
    run(&["-o", "-", "--json", "-"], 2);
    run(&["part.cls", "--dry-run", "--json", "a.json"], 2);
    run(&["-o", "a.cls", "--json", "part.cls"], 1);
    let expected = ["README.md", "part.cls", "recipe.yaml"].map(PathBuf::from);
    assert_eq!(names(folder.path()), expected);
    // What would be, without writing it.
    run(&["--dry-run", "--json", "a.json"], 0);
    assert!(read(folder.path(), "a.json").contains("\"output\":{\"file\":null,"));
}

#[test]
fn no_program_is_written_without_its_reports() {
    let folder = example("pocket");
    std::fs::write(folder.path().join("out.cls"), "as it was").unwrap();
    for option in ["--json", "--report", "--summary"] {
        let args = ["apply", "recipe.yaml", "part.cls", "-o", "out.cls", option, "nowhere/report", "-q"];
        clsmith(folder.path()).args(args).assert().code(1);
        assert_eq!(read(folder.path(), "out.cls"), "as it was", "{option}");
    }
}

#[test]
fn a_batch_makes_room_for_comments() {
    let folder = tempfile::tempdir().unwrap();
    let text = format!("UNITS/MM\nFEDRAT/100,MMPM\n{}", "GOTO/1.0,2.0,3.0\n".repeat(20_000));
    std::fs::write(folder.path().join("part.apt"), text).unwrap();
    let run = |provenance: &str| {
        let recipe =
            format!("version: 1\nprovenance: {provenance}\nsteps: [{{ scale_feed: {{ factor: 0.5 }} }}]\n");
        std::fs::write(folder.path().join("recipe.yaml"), recipe).unwrap();
        let args =
            ["batch", "--recipe", "recipe.yaml", "--output", provenance, "--memory", "16MB", "part.apt"];
        let done = clsmith(folder.path()).args(args).assert().success();
        String::from_utf8_lossy(&done.get_output().stderr).contains("CL0425")
    };
    assert_eq!([run("header"), run("comments")], [false, true]);
}
