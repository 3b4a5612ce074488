//! `clsmith section`.

use super::{clsmith, names};
use crate::surface::solids::{cube, terrain};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A binary STL.
fn stl(triangles: &[[[f64; 3]; 3]]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|value| (*value as f32).to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn job() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let block = cube([0.0, 0.0, 0.0], [40.0, 20.0, 10.0]);
    std::fs::write(path("part.stl"), stl(&block)).unwrap();
    std::fs::write(path("open.stl"), stl(&block[1..])).unwrap();
    std::fs::write(path("hills.stl"), stl(&terrain(10.0, 8, |x, y| 3.0 * (x / 3.0).sin() * (y / 4.0).cos())))
        .unwrap();
    std::fs::write(path("profile.yaml"), "start: [0, 0]\npieces: [ { line: [40, 5] } ]\n").unwrap();
    folder
}

fn run(folder: &Path, args: &str) -> assert_cmd::assert::Assert {
    clsmith(folder).arg("section").args(args.split(' ')).assert()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

const GOOD: &str = "--plane zx --step 2 --radius 5 --tolerance 0.005 --feed 800";

#[test]
fn a_model_becomes_a_program() {
    let folder = job();
    let before = names(folder.path());
    let done = run(folder.path(), &format!("part.stl {GOOD} -o part.cls --plot part.svg")).success();
    let shown = text(&done.get_output().stdout);
    assert!(
        shown.contains("part.stl: 11 planes 2.0000 mm apart, 11 passes, 440 mm of cutting in 11 motions"),
        "{shown}"
    );
    assert!(shown.contains("deepest gouge 0 mm at ") && shown.contains("largest gap 0 mm at "), "{shown}");
    assert!(shown.contains("-> part.cls: Siemens NX CLSF"), "{shown}");
    assert!(std::fs::read_to_string(folder.path().join("part.svg")).unwrap().starts_with("<svg"));
    clsmith(folder.path()).args(["check", "part.cls"]).assert().success();
    for (output, dialect) in [("a.aptsource", "catia"), ("a.ncl", "creo"), ("b.txt", "nx")] {
        run(folder.path(), &format!("part.stl {GOOD} -q -o {output}")).success().stdout("");
        let done = clsmith(folder.path()).args(["stats", "--json", output]).assert().success();
        let stats: serde_json::Value = serde_json::from_slice(&done.get_output().stdout).unwrap();
        assert_eq!(stats["dialect"]["name"], dialect);
    }
    assert_eq!(names(folder.path()).len(), before.len() + 5);
    let done = run(folder.path(), &format!("part.stl {GOOD} -o - --dialect creo")).success();
    assert!(text(&done.get_output().stdout).starts_with("$$*          Pro/CLfile"));
    assert!(text(&done.get_output().stderr).contains("deepest gouge"));
}

#[test]
fn a_profile_is_swept_between_two_planes() {
    let folder = job();
    let done =
        run(folder.path(), &format!("--profile profile.yaml --from -5 --to 5 {GOOD} -o a.cls")).success();
    assert!(text(&done.get_output().stdout).contains("6 planes 2.0000 mm apart"));
    let program = std::fs::read_to_string(folder.path().join("a.cls")).unwrap();
    assert!(program.contains(",-5.0000,") && program.contains(",5.0000,"), "{program}");
    run(folder.path(), &format!("--profile profile.yaml {GOOD} -o b.cls")).code(1);
    run(folder.path(), &format!("--profile profile.yaml part.stl {GOOD} -o b.cls")).code(2);
}

#[test]
fn inches_are_inches_everywhere() {
    let folder = job();
    let args =
        "part.stl --units inch --step 2 --radius 5 --tolerance 0.005 --feed 80 -o a.cls --spindle 5000";
    run(folder.path(), args).success();
    let program = std::fs::read_to_string(folder.path().join("a.cls")).unwrap();
    assert!(program.contains("FEDRAT/IPM,80.0000") && program.contains("GOTO/40.0000,"), "{program}");
    assert!(program.contains("TLDATA/MILL,10.0000,5.0000,"), "{program}");
}

#[test]
fn a_dry_run_writes_nothing() {
    let folder = job();
    let before = names(folder.path());
    let done = run(folder.path(), &format!("part.stl {GOOD} --dry-run -o a.cls")).success();
    assert!(text(&done.get_output().stdout).contains("deepest gouge"));
    assert_eq!(names(folder.path()), before);
}

#[test]
fn what_is_wrong_is_shown_at_its_place_and_nothing_is_written() {
    let folder = job();
    let before = names(folder.path());
    let cases = [
        ("part.stl --step 1 --feed 800 -o a.cls", 2, "CL0601: --radius is missing", "section"),
        (
            "part.stl --step 1 --radius 0 --feed 800 -o a.cls",
            2,
            "CL0601: --radius must be a number above 0, not `0`",
            "0 --feed",
        ),
        ("part.stl --step 1 --radius -5 --feed 800 -o a.cls", 2, "CL0601: --radius must be", "-5 --feed"),
        ("part.stl --step=-1 --radius 5 --feed 800 -o a.cls", 2, "CL0601: --step must be", "-1 --radius"),
        ("part.stl --step 1 --radius 5 --feed fast -o a.cls", 2, "CL0601: --feed must be", "fast -o"),
        (
            "part.stl --plane up --step 1 --radius 5 --feed 8 -o a.cls",
            2,
            "CL0601: --plane is zx, yz or an angle",
            "up --step",
        ),
        ("part.stl --plane 400 --step 1 --radius 5 --feed 8 -o a.cls", 2, "CL0601: --plane", "400 --step"),
        (
            "part.stl --tolerance 0 --step 1 --radius 5 --feed 8 -o a.cls",
            2,
            "CL0601: --tolerance",
            "0 --step",
        ),
        ("part.stl --from 1 --step 1 --radius 5 --feed 8 -o a.cls", 2, "CL0601: --to is missing", "section"),
        (
            "part.stl --operation A,B --step 1 --radius 5 --feed 8 -o a.cls",
            2,
            "CL0601: a name in a CL program",
            "A,B --step",
        ),
        (
            "open.stl --step 1 --radius 5 --feed 8 -o a.cls",
            1,
            "CL0602: the model open.stl cannot be milled: the surface is not closed",
            "",
        ),
        ("profile.yaml --step 1 --radius 5 --feed 8 -o a.cls", 1, "CL0602: the model profile.yaml", ""),
        ("none.stl --step 1 --radius 5 --feed 8 -o a.cls", 1, "none.stl cannot be read", ""),
        (
            "part.stl --step 1 --radius 5 --feed 8 --from 50 --to 60 -o a.cls",
            1,
            "CL0603: no plane from 50 to 60 mm",
            "",
        ),
        (
            "hills.stl --against profile --step 1 --radius 5 --feed 8 -o a.cls",
            1,
            "CL0604: the deepest gouge is",
            "",
        ),
        (
            "part.stl --tolerance 0.0001 --step 1 --radius 5 --feed 8 -o a.cls",
            1,
            "CL0605: Siemens NX CLSF writes 4 decimals",
            "",
        ),
        ("part.stl --step 1 --radius 5 --feed 8 -o part.stl", 1, "would overwrite the input part.stl", ""),
        (
            "part.stl --step 1 --radius 5 --feed 8 -o a.cls --plot part.stl",
            1,
            "would overwrite the input part.stl",
            "",
        ),
        ("--profile part.stl --step 1 --radius 5 --feed 8 -o a.cls", 1, "part.stl", ""),
    ];
    for (args, code, message, at) in cases {
        let done = run(folder.path(), &format!("{args} --format line")).code(code);
        let shown = text(&done.get_output().stderr);
        assert!(shown.contains(message), "{args}: {shown}");
        assert_eq!(names(folder.path()), before, "{args}");
        if !at.is_empty() {
            let line = format!("clsmith section {args}");
            let column = line.find(at).unwrap() + 1;
            assert!(shown.contains(&format!("command line:1:{column}: ")), "{args}: {shown}");
        }
    }
    // Unless somebody wants it so.
    run(folder.path(), "hills.stl --against profile --step 1 --radius 5 --feed 8 -o a.cls --allow CL0604")
        .success();
    assert!(names(folder.path()).contains(&PathBuf::from("a.cls")));
}

#[test]
fn a_setup_is_written_with_which_the_program_can_be_simulated() {
    let folder = job();
    let args = "hills.stl --step 0.5 --radius 2 --feed 800 --spindle 8000 --teeth 2 --allowance 0.5 --save-setup hills.yaml \
                --simulate --floor -3 -o hills.cls";
    let done = run(folder.path(), args).success();
    let shown = text(&done.get_output().stdout);
    let setup = std::fs::read_to_string(folder.path().join("hills.yaml")).unwrap();
    assert!(setup.contains("around: { model: \"hills.stl\", allowance: 0.5 }"), "{setup}");
    assert!(setup.contains("diameter: 4, corner_radius: 2, taper: 0, tip: 0, teeth: 2"), "{setup}");
    // What the command tells of its simulation is what `simulate` tells of the files.
    let again = clsmith(folder.path())
        .args([
            "simulate",
            "hills.cls",
            "--setup",
            "hills.yaml",
            "--target",
            "hills.stl",
            "--chips",
            "columns",
        ])
        .assert()
        .success();
    let again = text(&again.get_output().stdout);
    let of_target = |text: &str| -> Vec<String> {
        let told = text.lines().filter(|line| line.contains("gouge") || line.contains("excess"));
        told.map(|line| line.trim().replace("hills.stl", "")).collect()
    };
    assert!(!of_target(&again).is_empty(), "{again}");
    for line in of_target(&again) {
        assert!(of_target(&shown).contains(&line), "{line}\nin\n{shown}");
    }
    // The setup needs what nobody but the user knows, and a model.
    let without =
        run(folder.path(), "hills.stl --step 0.5 --radius 2 --feed 800 --save-setup a.yaml -o a.cls");
    assert!(text(&without.failure().code(2).get_output().stderr).contains("--teeth"));
    run(
        folder.path(),
        "--profile profile.yaml --step 2 --radius 5 --feed 800 --teeth 2 --save-setup a.yaml -o a.cls",
    )
    .failure()
    .code(2);
}
