//! `clsmith apply`.

use super::{clsmith, example, names};
use crate::support;

const EMPTY: &str = "version: 1\nsteps: []\n";

#[test]
fn the_first_example_is_corrected() {
    let folder = example("pocket");
    let done =
        clsmith(folder.path()).args(["apply", "recipe.yaml", "part.cls", "-o", "out.cls"]).assert().success();
    let before = std::fs::read_to_string(folder.path().join("part.cls")).unwrap();
    let after = std::fs::read_to_string(folder.path().join("out.cls")).unwrap();
    let added: Vec<&str> = after.lines().filter(|line| !before.contains(line)).collect();
    assert_eq!(
        added,
        ["FEDRAT/MMPM,600.0000", "COOLNT/THRU", "CYCLE/DRILL,RAPTO,3.0000,FEDTO,-12.0000,MMPM,400.0000"]
    );
    let text = String::from_utf8_lossy(&done.get_output().stderr).into_owned();
    support::snapshots("cli").bind(|| insta::assert_snapshot!("apply_summary", text));
}

#[test]
fn an_empty_recipe_gives_every_byte_back() {
    let Some(corpus) = support::require_corpus() else { return };
    for path in corpus {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("empty.yaml"), EMPTY).unwrap();
        clsmith(folder.path())
            .args(["apply", "empty.yaml"])
            .arg(&path)
            .args(["-o", "out", "-q"])
            .assert()
            .success();
        let same = std::fs::read(folder.path().join("out")).unwrap() == std::fs::read(&path).unwrap();
        assert!(same, "{}", path.display());
    }
}

#[test]
fn an_error_is_shown_and_nothing_is_written() {
    let folder = example("pocket");
    let broken = std::fs::read_to_string(folder.path().join("part.cls"))
        .unwrap()
        .replace("-10.0000,-4", "-1O.0000,-4");
    std::fs::write(folder.path().join("part.cls"), broken).unwrap();
    let before = names(folder.path());
    let done =
        clsmith(folder.path()).args(["apply", "recipe.yaml", "part.cls", "-o", "out.cls"]).assert().code(1);
    assert_eq!(names(folder.path()), before);
    let text = String::from_utf8_lossy(&done.get_output().stderr).into_owned();
    support::snapshots("cli").bind(|| insta::assert_snapshot!("apply_broken_program", text));
}

#[test]
fn a_wrong_recipe_is_underlined() {
    let folder = example("pocket");
    std::fs::write(
        folder.path().join("recipe.yaml"),
        "version: 1\nsteps:\n  - scale_feed: { facter: 0.5 }\n",
    )
    .unwrap();
    let done =
        clsmith(folder.path()).args(["apply", "recipe.yaml", "part.cls", "-o", "out.cls"]).assert().code(1);
    let text = String::from_utf8_lossy(&done.get_output().stderr).into_owned();
    assert!(text.contains("Did you mean `factor`"), "{text}");
    assert!(!folder.path().join("out.cls").exists());
}

#[test]
fn an_input_is_never_overwritten() {
    let folder = example("pocket");
    for target in ["part.cls", "./part.cls", "recipe.yaml", "."] {
        let before = std::fs::read(folder.path().join("part.cls")).unwrap();
        clsmith(folder.path()).args(["apply", "recipe.yaml", "part.cls", "-o", target]).assert().code(1);
        assert_eq!(std::fs::read(folder.path().join("part.cls")).unwrap(), before);
    }
}

#[test]
fn standard_input_and_output_work_as_a_pipe() {
    let folder = example("pocket");
    let part = std::fs::read(folder.path().join("part.cls")).unwrap();
    let done = clsmith(folder.path())
        .args(["apply", "recipe.yaml", "-", "-o", "-"])
        .write_stdin(part)
        .assert()
        .success();
    clsmith(folder.path()).args(["apply", "recipe.yaml", "part.cls", "-o", "out.cls"]).assert().success();
    assert_eq!(done.get_output().stdout, std::fs::read(folder.path().join("out.cls")).unwrap());
}

#[test]
fn several_inputs_go_into_a_folder_and_a_bad_one_does_not_stop_the_others() {
    let folder = example("pocket");
    std::fs::write(folder.path().join("bad.cls"), "GOTO/1,2,'\n").unwrap();
    std::fs::create_dir(folder.path().join("out")).unwrap();
    clsmith(folder.path())
        .args(["apply", "recipe.yaml", "bad.cls", "part.cls", "-o", "out"])
        .assert()
        .code(1);
    assert_eq!(names(&folder.path().join("out")), ["part.cls"].map(std::path::PathBuf::from));
}

#[test]
fn the_command_line_is_checked() {
    let folder = example("pocket");
    let run = |args: &[&str]| clsmith(folder.path()).args(args).assert().code(2);
    run(&["apply", "recipe.yaml", "part.cls"]);
    run(&["apply", "recipe.yaml", "part.cls", "part.cls", "-o", "nowhere"]);
    run(&["apply", "recipe.yaml", "-", "-", "-o", "out"]);
    run(&["apply", "recipe.yaml", "part.cls", "--diff", "-o", "-"]);
    run(&["apply", "recipe.yaml", "part.cls", "-o", "out", "--deny", "CL9999"]);
    assert!(!folder.path().join("out").exists());
}

#[test]
fn a_diff_is_shown_and_a_dry_run_writes_nothing() {
    let folder = example("pocket");
    let before = names(folder.path());
    let done =
        clsmith(folder.path()).args(["apply", "recipe.yaml", "part.cls", "--diff", "-q"]).assert().success();
    let text = String::from_utf8_lossy(&done.get_output().stdout).into_owned();
    support::snapshots("cli").bind(|| insta::assert_snapshot!("apply_diff", text));
    clsmith(folder.path())
        .args(["apply", "recipe.yaml", "part.cls", "-o", "x", "--dry-run"])
        .assert()
        .success();
    assert_eq!(names(folder.path()), before);
}

#[test]
fn the_setup_file_that_the_recipe_names_is_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("r.yaml", "version: 1\nsetup_file: shop.yaml\nsteps: []\n");
    write("shop.yaml", "machine: { max_feed: 8000 }\n");
    write("part.cls", "GOTO/0.0000,0.0000,0.0000\n");
    clsmith(folder.path()).args(["apply", "r.yaml", "part.cls", "-o", "shop.yaml"]).assert().code(1);
    let kept = std::fs::read_to_string(folder.path().join("shop.yaml")).unwrap();
    assert_eq!(kept, "machine: { max_feed: 8000 }\n");
}

#[test]
fn an_error_that_a_step_makes_is_not_excused_by_the_same_one_elsewhere() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write(
        "r.yaml",
        "version: 1\nsteps:\n- rewrite:\n    rules:\n    - match: \"CIRCLE/1.0,0.0,0.0,0.0,0.0,1.0,5.0\"\n      delete: true\n    \
         - match: \"GOTO/9.0,9.0,9.0\"\n      insert_after: [\"CIRCLE/0.0,0.0,0.0,0.0,0.0,1.0,5.0\"]\n",
    );
    write(
        "part.cls",
        "TOOL PATH/A,TOOL,T\nFEDRAT/MMPM,100.0\nGOTO/5.0,0.0,0.0\nCIRCLE/1.0,0.0,0.0,0.0,0.0,1.0,5.0\n\
         CIRCLE/0.0,0.0,0.0,0.0,0.0,1.0,5.0\nGOTO/0.0,5.0,0.0\nGOTO/9.0,9.0,9.0\nEND-OF-PATH\n",
    );
    clsmith(folder.path()).args(["apply", "r.yaml", "part.cls", "-o", "out.cls"]).assert().code(1);
    assert!(!folder.path().join("out.cls").exists());
}

#[test]
fn ramps_are_drawn_and_told_as_the_example_shows() {
    let folder = example("web-pocket");
    let shipped = std::fs::read_to_string(folder.path().join("ramps.svg")).unwrap();
    let page = std::fs::read_to_string(folder.path().join("README.md")).unwrap();
    let done = clsmith(folder.path())
        .args(["apply", "recipe.yaml", "part.cls", "--dry-run", "--plot", "new.svg"])
        .assert()
        .success();
    assert!(std::fs::read_to_string(folder.path().join("new.svg")).unwrap() == shipped);
    let told = String::from_utf8_lossy(&done.get_output().stderr).into_owned();
    let shown = page.split("```text\n").nth(1).unwrap().split("```").next().unwrap();
    assert!(told.contains(shown), "{told}");
    let run = |args: &[&str]| clsmith(folder.path()).args(args).assert();
    run(&["apply", "recipe.yaml", "part.cls", "--dry-run", "--plot", "part.cls"]).code(1);
    run(&["apply", "recipe.yaml", "part.cls", "-o", "x", "--plot", "x"]).code(2);
    run(&["apply", "recipe.yaml", "part.cls", "part.cls", "--dry-run", "--plot", "x"]).code(2);
    assert!(!folder.path().join("x").exists());
    std::fs::create_dir(folder.path().join("out")).unwrap();
    run(&["apply", "recipe.yaml", "part.cls", "-o", "out", "--plot", "out/part.cls"]).code(2);
    run(&["apply", "recipe.yaml", "part.cls", "--diff", "--plot", "-"]).code(2);
    run(&["apply", "recipe.yaml", "part.cls", "--dry-run", "--plot", "nowhere/x.svg"]).code(1);
    let mesh = "version: 1\nsteps:\n  - compensate_z: { radius: 5, against: { mesh: part.stl } }\n";
    std::fs::write(folder.path().join("mesh.yaml"), mesh).unwrap();
    std::fs::write(folder.path().join("part.stl"), "solid").unwrap();
    run(&["apply", "mesh.yaml", "part.cls", "-o", "part.stl"]).code(1);
    assert_eq!(std::fs::read_to_string(folder.path().join("part.stl")).unwrap(), "solid");
}

/// Every output beside a private program is as private as the program, from its first byte.
#[cfg(unix)]
#[test]
fn outputs_of_a_private_program_are_private() {
    use std::os::unix::fs::PermissionsExt;
    let folder = super::example("pocket");
    let at = folder.path();
    std::fs::set_permissions(at.join("part.cls"), std::fs::Permissions::from_mode(0o600)).unwrap();
    std::fs::write(at.join("r.yaml"), "version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n").unwrap();
    let runs: [&[&str]; 4] = [
        &[
            "apply",
            "r.yaml",
            "part.cls",
            "-o",
            "a.cls",
            "--report",
            "a.html",
            "--summary",
            "a.md",
            "--json",
            "a.json",
        ],
        &["check", "part.cls", "--json=c.json", "-o", "c.txt"],
        &["batch", "--recipe", "r.yaml", "-o", "done", "part.cls"],
        &["hook", "--recipe", "r.yaml", "part.cls", "--keep", "kept.cls", "--", "cp", "{}", "{}.nc"],
    ];
    for run in runs {
        super::clsmith(at).args(run).assert().success();
    }
    for made in
        ["a.cls", "a.html", "a.md", "a.json", "c.json", "c.txt", "done/part.cls", "kept.cls", "part.cls.nc"]
    {
        let mode = std::fs::metadata(at.join(made)).unwrap().permissions().mode() & 0o777;
        assert_eq!(mode, 0o600, "{made}");
    }
}
