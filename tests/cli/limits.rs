//! Limits of memory and time, and programs that would take far too much of both.

use super::{clsmith, names};
#[cfg(target_os = "linux")]
use crate::support::require_program;
use crate::surface::solids::terrain;
use assert_cmd::assert::Assert;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

const PROGRAM: &str = "RAPID\nGOTO/0.0,0.0,5.0\nFEDRAT/MMPM,800.0\nGOTO/10.0,0.0,-1.0\n";
const RECIPE: &str = "version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n";

fn shop() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("part.cls"), PROGRAM).unwrap();
    fs::write(folder.path().join("recipe.yaml"), RECIPE).unwrap();
    folder
}

fn stderr(done: &Assert) -> String {
    String::from_utf8_lossy(&done.get_output().stderr).into_owned()
}

/// A pocket with a coordinate that has lost its decimal point; the stock and the tool are in the recipe.
fn lost_point() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let pocket = "TOOL PATH/POCKET,TOOL,EM12\nTLDATA/MILL,12.0000,0.0000,75.0000,0.0000,0.0000\nLOAD/TOOL,3,ADJUST,3\n\
        SPINDL/RPM,3200,CLW\nRAPID\nGOTO/-20.0000,-10.0000,30.0000\nFEDRAT/MMPM,700.0000\nGOTO/-20.0000,-10.0000,-3.0000\n\
        GOTO/20.0000,-10.0000,-3.0000\nGOTO/20.0000,100000000.0000,-3.0000\nGOTO/-20.0000,10.0000,-3.0000\n\
        GOTO/-20.0000,-10.0000,-3.0000\nRAPID\nGOTO/-20.0000,-10.0000,30.0000\nEND-OF-PATH\n";
    fs::write(folder.path().join("part.cls"), pocket).unwrap();
    let setup = "  machine: { max_feed: 3000, rapid_feed: 15000 }\n  stock: { block: { from: [-35, -25, -15], to: [35, 25, 0] } }\n  \
        tools: [ { match: {}, teeth: 3 } ]\n";
    let recipe =
        format!("version: 1\nsetup:\n{setup}steps:\n  - optimize_feed: {{ target: 0.08, air_feed: 2500 }}\n");
    fs::write(folder.path().join("recipe.yaml"), recipe).unwrap();
    fs::write(folder.path().join("shop.yaml"), setup.replace("\n  ", "\n").trim_start()).unwrap();
    folder
}

/// A motion of 100 km took 11 GB and hours; nearly all of it is air.
#[test]
fn a_lost_decimal_point_takes_neither_memory_nor_hours() {
    let folder = lost_point();
    let begun = Instant::now();
    for args in [
        &["apply", "recipe.yaml", "part.cls", "-o", "out.cls", "--memory", "700M"][..],
        &["simulate", "part.cls", "--setup", "shop.yaml", "--csv", "loads.csv", "--memory", "700M"],
        &[
            "chips",
            "part.cls",
            "--setup",
            "shop.yaml",
            "--layer",
            "1",
            "--csv",
            "chips.csv",
            "--memory",
            "700M",
        ],
    ] {
        let text = stderr(&clsmith(folder.path()).args(args).assert());
        assert!(text.contains("CL0115"), "{args:?}: {text}");
        assert!(!text.contains("CL0442"), "{args:?}: {text}");
    }
    // Some seconds for all three; a debug build on a busy machine gets more.
    assert!(begun.elapsed() < Duration::from_secs(120), "{:?}", begun.elapsed());
    assert!(folder.path().join("loads.csv").exists());
}

#[test]
fn a_program_that_takes_too_long_is_an_error_and_not_written() {
    let folder = shop();
    let limit = ["--time-limit", "0.000000001"];
    let apply = ["apply", "recipe.yaml", "part.cls", "-o", "out.cls"];
    let done = clsmith(folder.path()).args(apply).args(limit).assert().code(1);
    assert!(stderr(&done).contains("CL0441"), "{}", stderr(&done));
    assert!(!folder.path().join("out.cls").exists());
    let batch = ["batch", "--recipe", "recipe.yaml", "--output", "done", "*.cls"];
    clsmith(folder.path()).args(batch).args(limit).assert().code(1);
    let results = fs::read_to_string(folder.path().join("done/results.jsonl")).unwrap();
    assert!(results.contains("CL0441"), "{results}");
    let hook = ["hook", "--recipe", "recipe.yaml"];
    clsmith(folder.path())
        .args(hook)
        .args(limit)
        .args(["part.cls", "--", "cp", "{}", "out"])
        .assert()
        .code(125);
    assert!(!names(folder.path()).contains(&PathBuf::from("out")));
}

#[test]
fn a_program_that_takes_too_much_memory_is_an_error_and_not_written() {
    let folder = shop();
    let limit = ["--memory", "1M"];
    let apply = ["apply", "recipe.yaml", "part.cls", "-o", "out.cls"];
    let done = clsmith(folder.path()).args(apply).args(limit).assert().code(1);
    assert!(stderr(&done).contains("CL0442") && stderr(&done).contains("1.0 MB"), "{}", stderr(&done));
    assert!(!folder.path().join("out.cls").exists());
    // The size of the program fits here, what the process takes does not.
    let done = clsmith(folder.path()).args(apply).args(["--memory", "5M"]).assert().code(1);
    assert!(stderr(&done).contains("has taken"), "{}", stderr(&done));
}

/// Whoever gives no limit gets none.
#[test]
fn limits_that_are_kept_change_nothing() {
    let folder = shop();
    let read = |name: &str| fs::read(folder.path().join(Path::new(name))).unwrap();
    for (name, limits) in [("a.cls", &[][..]), ("b.cls", &["--memory", "2GiB", "--time-limit", "600"])] {
        let apply = ["apply", "recipe.yaml", "part.cls", "-o", name];
        clsmith(folder.path()).args(apply).args(limits).assert().success();
    }
    assert_eq!(read("a.cls"), read("b.cls"));
}

/// Hills that take a while: 8,000 planes.
fn hills() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let hills = terrain(80.0, 24, |x, y| 3.0 * (x / 9.0).sin() * (y / 7.0).cos());
    let mut bytes = vec![b' '; 80];
    bytes.extend((hills.len() as u32).to_le_bytes());
    for triangle in &hills {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|value| (*value as f32).to_le_bytes()));
        bytes.extend([0; 2]);
    }
    fs::write(folder.path().join("hills.stl"), bytes).unwrap();
    folder
}

const SECTION: [&str; 10] =
    ["section", "hills.stl", "--radius", "5", "--step", "0.01", "--feed", "800", "-o", "out.cls"];

#[test]
fn a_surface_keeps_its_limits() {
    let folder = hills();
    let begun = Instant::now();
    let done = clsmith(folder.path()).args(SECTION).args(["--time-limit", "0.5"]).assert().code(1);
    assert!(stderr(&done).contains("CL0441"), "{}", stderr(&done));
    // A plane takes some milliseconds; the rest is for a busy machine.
    assert!(begun.elapsed() < Duration::from_secs(5), "{:?}", begun.elapsed());
    let done = clsmith(folder.path()).args(SECTION).args(["--memory", "5M"]).assert().code(1);
    assert!(stderr(&done).contains("CL0442"), "{}", stderr(&done));
    assert!(!folder.path().join("out.cls").exists());
    let coarse = SECTION.map(|word| if word == "0.01" { "10" } else { word });
    clsmith(folder.path()).args(coarse).args(["--memory", "2G", "--time-limit", "600"]).assert().success();
}

#[cfg(unix)]
#[test]
fn a_surface_ends_within_two_seconds() {
    let folder = hills();
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_clsmith"))
        .current_dir(folder.path())
        .args(SECTION)
        .stderr(std::process::Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(500));
    let begun = Instant::now();
    assert!(
        std::process::Command::new("kill")
            .args(["-INT", &child.id().to_string()])
            .status()
            .unwrap()
            .success()
    );
    let ended = child.wait().unwrap();
    assert!(begun.elapsed() < Duration::from_millis(2500), "{:?}", begun.elapsed());
    assert_eq!(ended.code(), Some(130));
    assert!(!folder.path().join("out.cls").exists());
}

/// What a run will take is told before it, if it is much.
#[test]
fn a_long_simulation_is_told_before_it() {
    let folder = lost_point();
    let mut program = fs::read_to_string(folder.path().join("part.cls")).unwrap();
    let ways = "GOTO/-20.0000,-10.0000,-3.0000\nGOTO/20.0000,-10.0000,-3.0000\n".repeat(1500);
    program = program.replace("GOTO/20.0000,100000000.0000,-3.0000\n", &ways);
    fs::write(folder.path().join("part.cls"), program).unwrap();
    let run = ["simulate", "part.cls", "--setup", "shop.yaml", "--threads", "1", "--time-limit", "1"];
    let long = ["--cell", "0.02"];
    let text = stderr(&clsmith(folder.path()).args(run).args(long).assert().code(1));
    assert!(text.contains("the simulation will take up to about ") && text.contains(" GiB: "), "{text}");
    let text = stderr(&clsmith(folder.path()).args(run).args(long).arg("-q").assert().code(1));
    assert!(!text.contains("will take"), "{text}");
    assert!(!stderr(&clsmith(folder.path()).args(run).args(["--cell", "1"]).assert()).contains("will take"));
}

/// A helix with turns without end, as when its height has lost its decimal point; the first cut is fine.
fn endless_helix() -> tempfile::TempDir {
    let folder = lost_point();
    let program = fs::read_to_string(folder.path().join("part.cls")).unwrap();
    let helix = "CIRCLE/16.0000,-10.0000,-3.0000,0.0000000,0.0000000,1.0000000,4.0000,0.0600,0.5000,12.0000,0.0000,TIMES,9999\n\
        GOTO/20.0000,-10.0000,-4.0000\n";
    let program = program.replace("GOTO/20.0000,100000000.0000,-3.0000\n", helix);
    fs::write(folder.path().join("part.cls"), program).unwrap();
    folder
}

/// Its pieces would take gigabytes and hours. It is refused before, by its line, whatever computes cuts.
#[test]
fn a_motion_of_endless_pieces_is_refused_before_the_work() {
    let folder = endless_helix();
    let chips = ["chips", "part.cls", "--setup", "shop.yaml", "--layer", "0.01", "--csv", "chips.csv"];
    for args in [
        &["simulate", "part.cls", "--setup", "shop.yaml", "--csv", "loads.csv"][..],
        &["apply", "recipe.yaml", "part.cls", "-o", "out.cls"],
        &["plot", "part.cls", "--setup", "shop.yaml", "--of", "chip", "-o", "chip.svg"],
        &chips,
    ] {
        let begun = Instant::now();
        let done = clsmith(folder.path()).args(args).args(["--memory", "400M"]).assert().code(1);
        let text = stderr(&done);
        assert!(text.contains("CL0535") && !text.contains("CL0442"), "{args:?}: {text}");
        assert!(text.contains("part.cls:11:1"), "{args:?}: {text}");
        assert!(text.contains("more than the 100000 that one may have"), "{args:?}: {text}");
        assert!(begun.elapsed() < Duration::from_secs(5), "{args:?}: {:?}", begun.elapsed());
    }
    assert_eq!(names(folder.path()).len(), 3, "{:?}", names(folder.path()));
    // Motions behind those that are asked for do not run, and so they do not count.
    let before = ["chips", "part.cls", "--setup", "shop.yaml", "--layer", "1", "--lines", "..9"];
    let done = clsmith(folder.path()).args(before).assert();
    assert!(!stderr(&done).contains("CL0535"), "{}", stderr(&done));
}

/// What chips and passes will take is held to `--memory` before it is taken, and that of passes is told.
#[test]
fn chips_and_passes_are_held_before_the_work() {
    let folder = lost_point();
    let chips = ["chips", "part.cls", "--setup", "shop.yaml"];
    let told = |args: &[&str]| stderr(&clsmith(folder.path()).args(chips).args(args).assert());
    let text = told(&["--layer", "0.001", "--memory", "20M"]);
    assert!(text.contains("CL0514") && text.contains("in layers of 0.001 mm"), "{text}");

    let folder = hills();
    let begun = Instant::now();
    let fine = SECTION.map(|word| if word == "0.01" { "0.005" } else { word });
    let text = stderr(&clsmith(folder.path()).args(fine).args(["--memory", "250M"]).assert().code(1));
    assert!(text.contains("CL0514") && text.contains("32001 planes will have about "), "{text}");
    assert!(begun.elapsed() < Duration::from_secs(5), "{:?}", begun.elapsed());
    let text =
        stderr(&clsmith(folder.path()).args(fine).args(["--threads", "1", "--time-limit", "1"]).assert());
    assert!(text.contains("making the passes will take up to about "), "{text}");
}

/// A pipe without an end and a large file are refused at the limit, not after a gigabyte.
#[cfg(unix)]
#[test]
fn a_pipe_is_read_to_the_memory_and_a_large_file_not_at_all() {
    let folder = shop();
    let at = |name: &str| folder.path().join(name);
    assert!(std::process::Command::new("mkfifo").arg(at("pipe.cls")).status().unwrap().success());
    let mut writer = std::process::Command::new("sh")
        .args(["-c", "yes GOTO/1,2,3 > pipe.cls"])
        .current_dir(folder.path())
        .stderr(std::process::Stdio::null())
        .spawn()
        .unwrap();
    let done = clsmith(folder.path()).args(["stats", "pipe.cls", "--memory", "1M"]).assert().code(1);
    assert!(stderr(&done).contains("it has given 1000001 bytes and no end"), "{}", stderr(&done));
    writer.wait().unwrap();
    // A file without content takes no room on the disk; it is as large as it says.
    fs::File::create(at("large.cls")).unwrap().set_len(3 << 30).unwrap();
    let begun = Instant::now();
    let limit = ["--memory", "100M"];
    for args in [
        &["check", "large.cls"][..],
        &["stats", "large.cls"],
        &["apply", "recipe.yaml", "large.cls", "-o", "out.cls"],
    ] {
        let done = clsmith(folder.path()).args(args).args(limit).assert().code(1);
        assert!(stderr(&done).contains("CL0442") || stdout(&done).contains("CL0442"), "{}", stderr(&done));
    }
    let hook = ["hook", "--recipe", "recipe.yaml", "large.cls", "--memory", "100M", "--", "cp", "{}", "out"];
    assert!(stderr(&clsmith(folder.path()).args(hook).assert().code(125)).contains("CL0442"));
    // Reading 3 GiB four times over takes longer than that.
    assert!(begun.elapsed() < Duration::from_secs(4), "{:?}", begun.elapsed());
}

fn stdout(done: &Assert) -> String {
    String::from_utf8_lossy(&done.get_output().stdout).into_owned()
}

/// Without `/proc`, as in a folder that is entered by `chroot`, it stopped with a defect.
#[cfg(target_os = "linux")]
#[test]
fn a_batch_on_a_system_that_does_not_tell_its_memory_works_on_each_file_alone() {
    let Some(unshare) = require_program(&["unshare"]) else { return };
    let folder = shop();
    let hide = "mount -t tmpfs none /proc || exit 77; exec \"$0\" \"$@\"";
    let mut batch = assert_cmd::Command::new(unshare);
    batch.args(["--mount", "--map-root-user", "sh", "-c", hide, env!("CARGO_BIN_EXE_clsmith")]);
    batch.args(["batch", "--recipe", "recipe.yaml", "-o", "done", "part.cls"]).current_dir(folder.path());
    let done = batch.assert();
    if done.get_output().status.code() == Some(77) {
        require_program(&["a mount namespace of one's own"]);
        return;
    }
    let done = done.success();
    assert!(stderr(&done).contains("this system does not tell its memory"), "{}", stderr(&done));
    assert!(folder.path().join("done/part.cls").is_file());
}
