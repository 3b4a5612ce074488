//! What no program may pass: selections that select nothing, empty exports, slips of units; and what no step may demand.

use super::clsmith;
use std::fs;
use std::path::Path;

const HEAD: &str = "PARTNO/ONE\nUNITS/MM\nCUTTER/10.0\nLOAD/TOOL,1\nSPINDL/1000,RPM,CLW\nFEDRAT/500,MMPM\n";
const SLOT: &str = "RAPID\nGOTO/-20,20,5\nRAPID\nGOTO/-20,20,-1\nGOTO/60,20,-1\nRAPID\nGOTO/60,20,50\n";
const SETUP: &str = "machine: { max_feed: 3000 }
stock: { block: { from: [0, 0, -10], to: [40, 40, 0] } }
tools:
  - match: { number: 1 }
    diameter: 10
    teeth: 2
    flute_length: 20
";

/// Runs `apply` on a program with a step; gives the exit code and what is told, a line a finding.
fn apply(program: &str, step: &str, options: &[&str]) -> (i32, String) {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("part.apt"), format!("{HEAD}{program}FINI\n")).unwrap();
    fs::write(at.join("setup.yaml"), SETUP).unwrap();
    let recipe = format!("version: 1\nunits: mm\nsetup_file: setup.yaml\nsteps:\n  - {step}\n");
    fs::write(at.join("recipe.yaml"), recipe).unwrap();
    let args = ["apply", "recipe.yaml", "part.apt", "-o", "out.apt", "--format", "line", "-q"];
    let done = clsmith(at).args(args).args(options).output().unwrap();
    let code = done.status.code().unwrap();
    assert_eq!(at.join("out.apt").exists(), code == 0);
    (code, String::from_utf8(done.stderr).unwrap())
}

#[test]
fn a_step_that_may_find_nothing_says_so() {
    let (code, told) = apply(SLOT, "scale_feed: { factor: 0.5, where: { tools: [7] } }", &[]);
    assert!(code == 1 && told.contains("CL0303"), "{told}");
    let lenient = "scale_feed: { factor: 0.5, where: { tools: [7], required: false } }";
    assert_eq!(apply(SLOT, lenient, &[]), (0, String::new()));
    let (code, told) = apply(SLOT, lenient, &["--notes"]);
    assert!(code == 0 && told.contains("CL0303"), "{told}");
    for step in [
        "set_spindle: { speed: { scale: 0.9 }, feeds: keep, where: { operations: [NONE] } }",
        "move_origin: { translate: [1, 0, 0], where: { operations: [NONE] } }",
        "rewrite: { where: { tools: [7] }, rules: [{ match: 'COOLNT/ON', delete: true }] }",
        "clamp_feed: { max: 400, where: { motions: [retract] } }",
    ] {
        let (code, told) = apply(SLOT, step, &[]);
        assert!(code == 1 && told.contains("CL0303"), "{step}: {told}");
    }
}

#[test]
fn slips_of_units_are_told() {
    for (step, code, exit) in [
        ("scale_feed: { factor: 0.04 }", "CL0311", 0),
        ("scale_feed: { factor: 80 }", "CL0312", 1),
        ("scale_feed: { factor: 8 }", "CL0313", 0),
        ("set_spindle: { speed: { scale: 20 }, feeds: keep }", "CL0311", 0),
        ("set_spindle: { speed: { scale: 80 }, feeds: keep }", "CL0312", 1),
        ("optimize_feed: { target: 6 }", "CL0312", 1),
        ("optimize_feed: { target: 0.006 }", "CL0311", 0),
        ("optimize_feed: { target: 4.9 }", "CL0314", 0),
        ("optimize_feed: { target: 0.0001 }", "CL0312", 1),
        ("move_origin: { translate: [25400, 0, 0] }", "CL0311", 0),
        ("move_origin: { rotate: { axis: z, degrees: 90, about: [0, 1.0e+8, 0] } }", "CL0312", 1),
        ("clamp_feed: { max: 20 }", "CL0311", 0),
        ("clamp_feed: { max: 2 }", "CL0312", 1),
        ("clamp_feed: { min: 27000, max: 28000 }", "CL0312", 1),
        ("set_spindle: { speed: { set: 600000 }, feeds: keep }", "CL0312", 1),
        ("set_spindle: { speed: { clamp: { max: 30 } }, feeds: keep }", "CL0311", 0),
    ] {
        let (done, told) = apply(SLOT, step, &[]);
        assert!(done == exit && told.contains(code), "{step}: {done} {told}");
        let allowed = ["--allow", "CL0311,CL0312,CL0313,CL0314"];
        let (done, told) = apply(SLOT, step, &allowed);
        assert!(done == 0 && told.contains(&format!("{code}: allowed: ")), "{step}: {done} {told}");
    }
    for usual in [
        "scale_feed: { factor: 0.5 }",
        "clamp_feed: { max: 400 }",
        "set_spindle: { speed: { clamp: { max: 800 } }, feeds: keep }",
    ] {
        assert_eq!(apply(SLOT, usual, &[]), (0, String::new()), "{usual}");
    }
    // A limit that catches single feeds far away does what it is for.
    let stray = format!("{SLOT}FEDRAT/90000,MMPM\nGOTO/60,20,51\n");
    assert_eq!(apply(&stray, "clamp_feed: { max: 500 }", &[]), (0, String::new()));
}

/// A path whose last rapid goes through the stock.
const CRASH: &str = "RAPID\nGOTO/-20,20,5\nRAPID\nGOTO/-20,20,-1\nRAPID\nGOTO/60,20,-1\n";

#[test]
fn a_stock_is_looked_at_unless_the_recipe_says_no() {
    let step = "scale_feed: { factor: 0.5 }";
    let (code, told) = apply(CRASH, step, &[]);
    assert!(code == 1 && told.contains("CL0510"), "{told}");
    assert_eq!(apply(CRASH, &format!("{step}\nsimulate: false"), &[]), (0, String::new()));
    // A tool without a shape leaves the program unlooked at, which is said.
    let other = "LOAD/TOOL,2\nCUTTER/0\nRAPID\nGOTO/-20,10,5\nGOTO/-20,10,-1\n";
    let (code, told) = apply(&format!("{SLOT}{other}"), step, &["--allow", "CL0130,CL0133"]);
    assert!(code == 0 && told.contains("CL0530") && told.contains("was not simulated"), "{told}");
}

#[test]
fn a_crash_that_a_step_has_found_counts_once() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let cut = "GOTO/-20,30,-1\nGOTO/60,30,-1\n";
    write(at, "part.apt", &format!("{HEAD}{CRASH}{cut}FINI\n"));
    write(at, "setup.yaml", SETUP);
    let step = "optimize_feed: { target: 0.2 }";
    write(at, "recipe.yaml", &format!("version: 1\nunits: mm\nsetup_file: setup.yaml\nsteps:\n  - {step}\n"));
    for reports in [&[][..], &["--summary", "out.md"]] {
        let args =
            ["apply", "recipe.yaml", "part.apt", "-o", "out.apt", "--allow", "CL0510", "--json", "out.json"];
        let done = clsmith(at).args(args).args(reports).output().unwrap();
        let told = String::from_utf8(done.stderr).unwrap();
        assert_eq!(done.status.code(), Some(0), "{told}");
        assert!(told.contains("allowed by hand: 1 x CL0510"), "{told}");
    }
}

#[test]
fn what_an_earlier_run_wrote_is_set_aside_when_a_run_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    write(at, "part.apt", &format!("{HEAD}{CRASH}FINI\n"));
    write(at, "setup.yaml", SETUP);
    let recipe = "version: 1\nunits: mm\nsetup_file: setup.yaml\nsteps:\n  - scale_feed: { factor: 0.5 }\n";
    write(at, "recipe.yaml", recipe);
    write(at, "out.apt", "of an earlier run");
    let args = ["apply", "recipe.yaml", "part.apt", "-o", "out.apt", "--format", "line"];
    let tried = clsmith(at).args(args).arg("--dry-run").output().unwrap();
    assert_eq!(tried.status.code(), Some(1));
    assert!(at.join("out.apt").exists(), "a dry run touches nothing");
    let done = clsmith(at).args(args).output().unwrap();
    let told = String::from_utf8(done.stderr).unwrap();
    assert!(done.status.code() == Some(1) && told.contains("CL0443"), "{told}");
    assert!(!at.join("out.apt").exists() && at.join("out.apt.outdated").exists());
}

#[test]
fn a_pitch_that_is_no_feed_is_told_where_threads_are_meant() {
    let thread = "SPINDL/500,RPM,CLW\nPITCH/1.5\nTHREAD/TURN\nGOTO/0,0,0\nGOTO/0,0,-20\nTHREAD/OFF\n";
    let step = "scale_feed: { factor: 0.5, where: { threads: true } }\nsimulate: false";
    let (code, told) = apply(thread, step, &[]);
    assert!(code == 0 && told.contains("CL0305") && told.contains("PITCH"), "{code} {told}");
}

#[test]
fn a_tool_that_no_step_selects_needs_no_data() {
    let other =
        "LOAD/TOOL,2\nRAPID\nGOTO/-20,10,5\nRAPID\nGOTO/-20,10,-1\nGOTO/60,10,-1\nRAPID\nGOTO/60,10,50\n";
    // CUTTER belongs to tool 1 alone.
    let program = format!("{SLOT}CUTTER/0\n{other}");
    let (code, told) = apply(
        &program,
        "optimize_feed: { target: 0.2, where: { tools: [1] } }",
        &["--allow", "CL0130,CL0133"],
    );
    assert_eq!(code, 0, "{told}");
    // Nor does one that only moves in operations which are not selected.
    let named = format!("OPFEATSTART/KNOWN\n{SLOT}OPFEATEND/KNOWN\nCUTTER/0\nOPFEATSTART/OTHER\n{other}");
    let recipe = "optimize_feed: { target: 0.2, where: { operations: [KNOWN] } }";
    let (code, told) = apply(&named, recipe, &["--allow", "CL0130,CL0133"]);
    assert_eq!(code, 0, "{told}");
    let (code, told) = apply(&program, "optimize_feed: { target: 0.2 }", &["--allow", "CL0130,CL0133"]);
    assert!(code == 1 && told.contains("CL050"), "{told}");
}

fn write(at: &Path, name: &str, text: &str) {
    fs::write(at.join(name), text).unwrap();
}

#[test]
fn an_empty_export_is_refused_by_every_command() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::create_dir(at.join("watched")).unwrap();
    write(at, "part.apt", "PARTNO/EMPTY\nUNITS/MM\nFINI\n");
    write(at, "watched/part.apt", "PARTNO/EMPTY\nUNITS/MM\nFINI\n");
    write(at, "recipe.yaml", "version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n");
    for (args, exit) in [
        (&["check", "part.apt"][..], 1),
        (&["apply", "recipe.yaml", "part.apt", "-o", "out.apt"], 1),
        (&["batch", "--recipe", "recipe.yaml", "--output", "done", "part.apt"], 1),
        (&["watch", "watched", "--recipe", "recipe.yaml", "--output", "out", "--once", "*.apt"], 1),
        (&["hook", "--recipe", "recipe.yaml", "part.apt", "--", "cp", "{}", "posted"], 125),
    ] {
        let done = clsmith(at).args(args).output().unwrap();
        let told =
            String::from_utf8_lossy(&done.stdout).into_owned() + &String::from_utf8_lossy(&done.stderr);
        assert!(done.status.code() == Some(exit) && told.contains("CL0116"), "{args:?}: {told}");
    }
    assert!(!at.join("posted").exists() && !at.join("out.apt").exists());
}
