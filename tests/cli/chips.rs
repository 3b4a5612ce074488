//! `clsmith chips`.

use super::{clsmith, names};
use crate::report::simulation::{SHOP, SLOT};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn job() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("part.cls"), SLOT).unwrap();
    std::fs::write(folder.path().join("shop.yaml"), SHOP).unwrap();
    folder
}

fn run(folder: &Path, args: &[&str]) -> assert_cmd::assert::Assert {
    clsmith(folder).args(["chips", "part.cls", "--setup", "shop.yaml", "--layer", "1"]).args(args).assert()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn every_output_is_written() {
    let folder = job();
    let outputs =
        ["--csv", "a.csv", "--json", "a.json", "--stl", "a.stl", "--plot", "a.svg", "--diagram", "b.svg"];
    let done = run(folder.path(), &outputs).success();
    assert_eq!(
        names(folder.path()),
        ["a.csv", "a.json", "a.stl", "a.svg", "b.svg", "part.cls", "shop.yaml"].map(PathBuf::from)
    );
    let shown = text(&done.get_output().stdout);
    assert!(shown.contains("largest chip: 600.0") && shown.contains("on line 16"), "{shown}");
    assert!(done.get_output().stderr.is_empty(), "no bar where there is no terminal");
    let json = std::fs::read(folder.path().join("a.json")).unwrap();
    let json: serde_json::Value = serde_json::from_slice(&json).unwrap();
    assert!(json["motions"][1]["layers"][0]["pieces"][0][0][0].is_number(), "{json}");
}

#[test]
fn lines_are_chosen() {
    let folder = job();
    let csv = |lines: &str| {
        let done = run(folder.path(), &["--lines", lines, "--csv", "-", "-q"]).success();
        let shown = text(&done.get_output().stdout);
        shown.lines().skip(1).map(|row| row.split(',').next().unwrap().to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(csv("13..14"), ["13", "13", "14", "14"]);
    assert_eq!(csv("16"), ["16", "16"]);
    assert_eq!(csv("..12"), ["12", "12"]);
    assert_eq!(csv("14..").len(), 4);
    let done = run(folder.path(), &["--lines", "900..", "--csv", "a.csv"]).code(1);
    assert!(text(&done.get_output().stderr).contains("CL0524"));
    assert!(!folder.path().join("a.csv").exists());
}

#[test]
fn the_same_bytes_whatever_the_threads() {
    let folder = job();
    for threads in ["1", "3"] {
        let (csv, svg) = (format!("{threads}.csv"), format!("{threads}.svg"));
        run(folder.path(), &["--threads", threads, "--csv", &csv, "--plot", &svg, "-q"])
            .success()
            .stdout("")
            .stderr("");
    }
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert!(read("1.csv") == read("3.csv") && read("1.svg") == read("3.svg"));
}

#[test]
fn an_error_is_in_all_outputs_and_in_the_exit_code() {
    let folder = job();
    std::fs::write(folder.path().join("part.cls"), SLOT.replace("SPINDL/RPM,4000.0000,CLW", "SPINDL/OFF"))
        .unwrap();
    let done = run(folder.path(), &["--csv", "a.csv", "--stl", "a.stl"]).code(1);
    let shown = text(&done.get_output().stderr);
    assert!(shown.contains("CL0512"), "{shown}");
    assert!(folder.path().join("a.csv").exists() && folder.path().join("a.stl").exists());
    run(folder.path(), &["--csv", "a.csv", "--allow", "CL0512"]).success();
    let done = run(folder.path(), &["--layer", "0.0000001"]).code(2);
    assert!(text(&done.get_output().stderr).contains("--layer"));
    let thin = ["chips", "part.cls", "--setup", "shop.yaml", "--layer", "0.0000001"];
    let done = clsmith(folder.path()).args(thin).assert().code(1);
    assert!(text(&done.get_output().stderr).contains("CL0523"));
}

#[test]
fn a_height_with_nothing_to_draw_is_an_error() {
    let folder = job();
    let done = run(folder.path(), &["--plot", "a.svg", "--at", "-5"]).code(1);
    let shown = text(&done.get_output().stderr);
    assert!(shown.contains("CL0525") && shown.contains("at z -5"), "{shown}");
    assert!(!folder.path().join("a.svg").exists());
    run(folder.path(), &["--plot", "a.svg", "--at", "-0.3"]).success();
}

#[test]
fn other_tools_are_warned_of() {
    let folder = job();
    let ball = SLOT.replace("MILL,10.0000,0.0000,", "MILL,10.0000,5.0000,");
    std::fs::write(folder.path().join("part.cls"), ball).unwrap();
    let done = run(folder.path(), &[]).success();
    let shown = text(&done.get_output().stderr);
    assert!(shown.contains("CL0520") && shown.contains("a ball of radius 5 mm"), "{shown}");
    assert!(text(&done.get_output().stdout).contains("nothing is cut"));
    run(folder.path(), &["--deny", "CL0520"]).code(1);
}

#[test]
fn cutters_whose_middle_does_not_cut_are_warned_of() {
    let folder = job();
    let inserts = "tools:\n  - match: { number: 3 }\n    insert: { height: 2, radius: 2 }\n";
    assert!(SHOP.contains("tools:\n  - match: { number: 3 }\n"), "{SHOP}");
    let shop = SHOP.replace("tools:\n  - match: { number: 3 }\n", inserts);
    std::fs::write(folder.path().join("shop.yaml"), shop).unwrap();
    let done = run(folder.path(), &[]).success();
    let shown = text(&done.get_output().stderr);
    assert!(
        shown.contains("CL0520") && shown.contains("inserts that leave a middle of 6 mm uncut"),
        "{shown}"
    );
}

#[test]
fn layers_lie_across_what_is_asked_for() {
    let folder = job();
    let level = run(folder.path(), &["--json", "level.json"]).success();
    let across = run(folder.path(), &["--layers-across", "tool", "--json", "across.json"]).success();
    assert_eq!(level.get_output().stdout, across.get_output().stdout, "the tool stands along z");
    let [level, across] =
        ["level.json", "across.json"].map(|name| std::fs::read(folder.path().join(name)).unwrap());
    assert!(level == across);
    let done = run(folder.path(), &["--layers-across", "0,-3,4", "--json", "a.json"]).success();
    assert!(
        text(&done.get_output().stdout).contains("across the direction 0,-0.6,0.8, along which z is told")
    );
    let json = std::fs::read(folder.path().join("a.json")).unwrap();
    let json: serde_json::Value = serde_json::from_slice(&json).unwrap();
    assert_eq!(json["layer_frame"]["z"], serde_json::json!([0.0, -0.6, 0.8]));
    for wrong in ["0,0,0", "1,2", "up", "nan,0,1"] {
        let refused = run(folder.path(), &["--layers-across", wrong]).code(2);
        assert!(text(&refused.get_output().stderr).contains("--layers-across"), "{wrong}");
    }
    run(folder.path(), &["--layers-across", "table"]).code(1);
}

#[test]
fn no_input_is_overwritten() {
    let folder = job();
    for output in ["part.cls", "./shop.yaml"] {
        let before = std::fs::read(folder.path().join(output)).unwrap();
        let done = run(folder.path(), &["--json", output]).code(1);
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
    run(folder.path(), &["--at", "1"]).code(2);
    run(folder.path(), &["--lines", "5..4"]).code(2);
    run(folder.path(), &["--tolerance", "0"]).code(2);
    run(folder.path(), &["--moves", "0"]).code(2);
    clsmith(folder.path()).args(["chips", "part.cls", "--setup", "shop.yaml"]).assert().code(2);
    assert_eq!(names(folder.path()), ["part.cls", "shop.yaml"].map(PathBuf::from));
    let help = clsmith(folder.path()).args(["chips", "--help"]).assert().success();
    let help = text(&help.get_output().stdout);
    assert!(help.contains("Examples:") && help.contains("chip_thickness_mm"), "{help}");
}

#[test]
fn what_a_rapid_takes_is_no_chip() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let head = "UNITS/MM\nCUTTER/10.0\nLOAD/TOOL,1\nSPINDL/1000,RPM,CLW\nFEDRAT/100,MMPM\n";
    let cut = "RAPID\nGOTO/-20,30,5\nRAPID\nGOTO/-20,30,-1\nGOTO/60,30,-1\nRAPID\nGOTO/60,30,5\n";
    let crash = "RAPID\nGOTO/-20,10,5\nRAPID\nGOTO/-20,10,-3\nRAPID\nGOTO/60,10,-3\n";
    std::fs::write(at.join("part.cls"), format!("{head}{cut}{crash}FINI\n")).unwrap();
    let shop = "machine: { rapid_feed: 9000 }\nstock: { block: { from: [0, 0, -10], to: [40, 40, 0] } }\n\
        tools: [ { match: {}, diameter: 10, teeth: 2, flute_length: 20 } ]\n";
    std::fs::write(at.join("shop.yaml"), shop).unwrap();
    let done = run(at, &["--json=a.json", "--csv", "a.csv"]).code(1);
    let said = text(&done.get_output().stdout);
    // Feed by speed and teeth: 100 / (1000 * 2), on the line of the cut; at rapid it would be 4.5 mm.
    assert!(said.contains("thickest chip of a tooth: 0.0500 mm on line 10"), "{said}");
    assert!(said.contains("largest chip: 400.0000 mm3 on line 10"), "{said}");
    assert!(text(&done.get_output().stderr).contains("CL0510"));
    let json: serde_json::Value = serde_json::from_slice(&std::fs::read(at.join("a.json")).unwrap()).unwrap();
    let rapid = json["motions"].as_array().unwrap().iter().find(|row| row["line"] == 18).unwrap();
    // The material is gone all the same, three layers of it.
    assert_eq!((&rapid["rapid"], &rapid["chip_thickness_mm"]), (&true.into(), &serde_json::Value::Null));
    assert!((rapid["volume_mm3"].as_f64().unwrap() - 1200.0).abs() < 1e-6, "{rapid}");
    assert_eq!(json["operations"][0]["cutting"], 1, "{}", json["operations"]);
}
