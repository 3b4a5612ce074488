//! `clsmith watch`.

use super::hook::log;
use super::{clsmith, example, names};
use crate::support::{try_until_met, wait_for};
use assert_cmd::Command;
use assert_cmd::assert::Assert;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

const BROKEN: &str = "RAPID\nGOTO/1.0,2.0,x\n";
const STATE: &str = "out/.clsmith-watch.jsonl";

/// The pocket's recipe, and its program in `exports`.
fn shop() -> tempfile::TempDir {
    let folder = example("pocket");
    fs::create_dir(folder.path().join("exports")).unwrap();
    fs::rename(folder.path().join("part.cls"), folder.path().join("exports/part.cls")).unwrap();
    // The recipe of a watch serves all programs, also those in which it finds nothing to do.
    let recipe = fs::read_to_string(folder.path().join("recipe.yaml")).unwrap();
    let lenient = ["motions: [engage]", "tools: [8]", "operations: [\"HOLES\"]"]
        .iter()
        .fold(recipe, |text, filter| text.replace(filter, &format!("{filter}, required: false")));
    fs::write(folder.path().join("recipe.yaml"), lenient).unwrap();
    folder
}

/// A watch that takes what is there and ends.
fn once(folder: &Path, options: &[&str]) -> Command {
    once_settling("0.1", folder, options)
}

fn once_settling(seconds: &str, folder: &Path, options: &[&str]) -> Command {
    let mut command = clsmith(folder);
    command.args(["watch", "exports", "--output", "out", "--once", "--settle", seconds, "--poll", "0.05"]);
    command.args(["--log", "log.jsonl"]).args(options);
    command
}

fn recipe(folder: &Path, glob: &str) -> Command {
    once(folder, &["--recipe", "recipe.yaml", glob])
}

fn stderr(done: &Assert) -> String {
    String::from_utf8_lossy(&done.get_output().stderr).into_owned()
}

/// Names without those that begin with a point.
fn seen(folder: &Path) -> Vec<String> {
    let all = names(folder).into_iter().map(|name| name.to_string_lossy().into_owned());
    all.filter(|name| !name.starts_with('.')).collect()
}

/// What `apply` makes of the pocket's program.
fn corrected(folder: &Path) -> Vec<u8> {
    let args = ["apply", "-q", "recipe.yaml", "exports/part.cls", "-o", "expected"];
    clsmith(folder).args(args).assert().success();
    fs::read(folder.join("expected")).unwrap()
}

/// A watch that goes on.
fn start(folder: &Path) -> Child {
    start_settling("0.1", folder)
}

fn start_settling(seconds: &str, folder: &Path) -> Child {
    std::process::Command::new(env!("CARGO_BIN_EXE_clsmith"))
        .current_dir(folder)
        .args(["watch", "exports", "--recipe", "recipe.yaml", "--output", "out"])
        .args(["--log", "log.jsonl", "--settle", seconds, "--poll", "0.05", "*.cls"])
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

fn stop(mut child: Child) {
    child.kill().unwrap();
    child.wait().unwrap();
}

#[test]
fn an_export_is_corrected_once_and_again_when_it_changes() {
    let folder = shop();
    let expected = corrected(folder.path());
    recipe(folder.path(), "*.cls").assert().code(0);
    let out = folder.path().join("out/part.cls");
    assert_eq!(fs::read(&out).unwrap(), expected);
    let written = fs::metadata(&out).unwrap().modified().unwrap();
    // Nothing to do: not even when the consumer has taken it away.
    recipe(folder.path(), "*.cls").assert().code(0);
    assert_eq!(fs::metadata(&out).unwrap().modified().unwrap(), written);
    fs::remove_file(&out).unwrap();
    recipe(folder.path(), "*.cls").assert().code(0);
    assert!(!out.exists());
    assert_eq!(log(folder.path()).len(), 1);
    let line = &log(folder.path())[0];
    assert_eq!((&line["command"], &line["outcome"]), (&"watch".into(), &"corrected".into()));
    // A change, and back: each content comes out when it is the newest.
    let path = folder.path().join("exports/part.cls");
    let first = fs::read(&path).unwrap();
    fs::write(&path, [&first[..], b"$$ again\n"].concat()).unwrap();
    recipe(folder.path(), "*.cls").assert().code(0);
    assert_eq!(fs::read(&out).unwrap(), [&expected[..], b"$$ again\n"].concat());
    fs::write(&path, &first).unwrap();
    recipe(folder.path(), "*.cls").assert().code(0);
    assert_eq!(fs::read(&out).unwrap(), expected);
    assert_eq!(log(folder.path()).len(), 3);
}

/// Writes on and on until told to stop; the longest pause it made, in seconds.
fn keep_writing(mut file: &fs::File, is_enough: impl Fn() -> bool) -> f64 {
    let (mut longest, mut last) = (0.0_f64, Instant::now());
    while !is_enough() {
        file.write_all(b"GOTO/1.0000,2.0000,3.0000\n").unwrap();
        longest = longest.max(last.elapsed().as_secs_f64());
        last = Instant::now();
        std::thread::sleep(Duration::from_millis(5));
    }
    longest.max(last.elapsed().as_secs_f64())
}

#[test]
fn a_file_that_is_still_written_is_left() {
    // A busy machine may make a pause of our own as long as the second of rest that the watch waits for: then once more.
    try_until_met(|_| {
        let folder = shop();
        let path = folder.path().join("exports/slow.cls");
        let file = fs::File::create(&path).unwrap();
        let out = folder.path().join("out/slow.cls");
        let child = start_settling("1", folder.path());
        let begun = Instant::now();
        let other = folder.path().join("out/part.cls");
        let pause = keep_writing(&file, || begun.elapsed() > Duration::from_millis(2500) && other.exists());
        let taken = out.exists();
        drop(file);
        wait_for("the program after its end", || out.exists());
        let whole = fs::read(&out).unwrap() == fs::read(&path).unwrap();
        stop(child);
        let was_steady = pause < 0.5;
        assert!(!was_steady || (!taken && whole), "taken: {taken}, whole: {whole}");
        was_steady
    });
}

#[test]
fn once_leaves_a_file_that_goes_on_changing() {
    // As above.
    try_until_met(|_| {
        let folder = shop();
        let path = folder.path().join("exports/slow.cls");
        let file = fs::File::create(&path).unwrap();
        let stop = AtomicBool::new(false);
        let (done, pause) = std::thread::scope(|scope| {
            let writer = scope.spawn(|| keep_writing(&file, || stop.load(Ordering::Relaxed)));
            let done = once_settling("1", folder.path(), &["--recipe", "recipe.yaml", "*.cls"]).assert();
            stop.store(true, Ordering::Relaxed);
            (done, writer.join().unwrap())
        });
        let was_steady = pause < 0.5;
        if was_steady {
            let done = done.code(1);
            assert!(stderr(&done).contains("slow.cls: still changing"), "{}", stderr(&done));
            assert_eq!(seen(&folder.path().join("out")), ["part.cls", "refused"]);
        }
        was_steady
    });
}

#[test]
fn refused_programs_are_moved_aside_and_nothing_there_is_overwritten() {
    let folder = shop();
    let bad = folder.path().join("exports/bad.cls");
    for (round, text) in [BROKEN.to_owned(), BROKEN.replace('x', "y"), BROKEN.to_owned()].iter().enumerate() {
        fs::write(&bad, text).unwrap();
        let done = recipe(folder.path(), "*.cls").assert().code(1);
        assert!(stderr(&done).contains("CL0003"), "round {round}: {}", stderr(&done));
        assert!(!bad.exists());
    }
    let refused = folder.path().join("out/refused");
    let expected =
        ["bad.1.cls", "bad.1.cls.diagnostics.txt", "bad.cls", "bad.cls.diagnostics.txt"].map(String::from);
    assert_eq!(seen(&refused), expected);
    assert_eq!(fs::read_to_string(refused.join("bad.cls")).unwrap(), BROKEN);
    let text = fs::read_to_string(refused.join("bad.1.cls.diagnostics.txt")).unwrap();
    assert!(text.contains("`y` is not a number"), "{text}");
    let lines = log(folder.path());
    let last = lines.last().unwrap();
    assert_eq!((&last["outcome"], &last["findings"]["CL0003"]), (&"refused".into(), &1.into()));
    assert!(last["refused_to"].as_str().unwrap().ends_with("bad.cls"), "{last}");
    assert_eq!(seen(&folder.path().join("out")), ["part.cls", "refused"]);
}

#[test]
fn an_older_output_beside_a_refused_export_is_set_aside() {
    let folder = shop();
    recipe(folder.path(), "*.cls").assert().code(0);
    let out = folder.path().join("out");
    let before = fs::read(out.join("part.cls")).unwrap();
    fs::write(folder.path().join("exports/part.cls"), BROKEN).unwrap();
    let done = recipe(folder.path(), "*.cls").assert().code(1);
    assert!(stderr(&done).contains("CL0443"), "{}", stderr(&done));
    assert_eq!(seen(&out), ["part.cls.outdated", "refused"]);
    assert_eq!(fs::read(out.join("part.cls.outdated")).unwrap(), before);
    let lines = log(folder.path());
    assert_eq!(lines.last().unwrap()["findings"]["CL0443"], 1);
}

#[test]
fn a_refused_folder_may_be_elsewhere() {
    let folder = shop();
    fs::write(folder.path().join("exports/bad.cls"), BROKEN).unwrap();
    once(folder.path(), &["--recipe", "recipe.yaml", "--refused", "aside", "*.cls"]).assert().code(1);
    assert_eq!(seen(&folder.path().join("aside")), ["bad.cls", "bad.cls.diagnostics.txt"]);
    assert_eq!(seen(&folder.path().join("out")), ["part.cls"]);
}

#[test]
fn subfolders_are_taken_when_the_pattern_says_so() {
    let folder = shop();
    let deep = folder.path().join("exports/job 7/op");
    fs::create_dir_all(&deep).unwrap();
    fs::copy(folder.path().join("exports/part.cls"), deep.join("deep.cls")).unwrap();
    fs::write(deep.join("bad.cls"), BROKEN).unwrap();
    recipe(folder.path(), "*.cls").assert().code(0);
    assert_eq!(seen(&folder.path().join("out")), ["part.cls", "refused"]);
    recipe(folder.path(), "**/*.cls").assert().code(1);
    assert!(folder.path().join("out/job 7/op/deep.cls").exists());
    assert!(folder.path().join("out/refused/job 7/op/bad.cls").exists());
}

#[cfg(target_os = "linux")]
#[test]
fn names_need_not_be_utf8() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = shop();
    let (good, bad) = (OsStr::from_bytes(b"gr\xfc\xdfe%FF.cls"), OsStr::from_bytes(b"\xff\n.cls"));
    fs::rename(folder.path().join("exports/part.cls"), folder.path().join("exports").join(good)).unwrap();
    fs::write(folder.path().join("exports").join(bad), BROKEN).unwrap();
    recipe(folder.path(), "*.cls").assert().code(1);
    assert!(folder.path().join("out").join(good).exists());
    assert!(folder.path().join("out/refused").join(bad).exists());
    recipe(folder.path(), "*.cls").assert().code(0);
    assert_eq!(log(folder.path()).len(), 2);
    let state = fs::read_to_string(folder.path().join(STATE)).unwrap();
    assert!(state.contains("gr%FC%DFe%25FF.cls"), "{state}");
}

#[cfg(unix)]
#[test]
fn links_do_not_lead_out_and_circles_end() {
    use std::os::unix::fs::symlink;
    let folder = shop();
    let exports = folder.path().join("exports");
    fs::create_dir(folder.path().join("elsewhere")).unwrap();
    fs::copy(exports.join("part.cls"), folder.path().join("elsewhere/secret.cls")).unwrap();
    symlink("../elsewhere/secret.cls", exports.join("secret.cls")).unwrap();
    symlink("../elsewhere", exports.join("folder")).unwrap();
    symlink(".", exports.join("circle")).unwrap();
    symlink("part.cls", exports.join("inside.cls")).unwrap();
    symlink("nowhere.cls", exports.join("dangling.cls")).unwrap();
    let done = recipe(folder.path(), "**/*.cls").assert().code(0);
    assert!(stderr(&done).contains("CL0419") && stderr(&done).contains("secret.cls"), "{}", stderr(&done));
    assert_eq!(seen(&folder.path().join("out")), ["inside.cls", "part.cls", "refused"]);
}

#[cfg(unix)]
#[test]
fn a_pipe_with_the_right_name_is_left_alone() {
    let folder = shop();
    let pipe = folder.path().join("exports/pipe.cls");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let done = recipe(folder.path(), "*.cls").assert().code(1);
    assert!(stderr(&done).contains("pipe or device"), "{}", stderr(&done));
    assert_eq!(seen(&folder.path().join("out")), ["part.cls", "refused"]);
}

#[test]
fn folders_stand_side_by_side() {
    let folder = shop();
    for options in [
        &["--output", "exports"][..],
        &["--output", "exports/out"],
        &["--output", "."],
        &["--output", "out", "--refused", "exports/refused"],
        &["--output", "out", "--state", "exports/state"],
        &["--output", "out", "--log", "exports/log.cls"],
    ] {
        let mut command = clsmith(folder.path());
        command.args(["watch", "exports", "--once", "--recipe", "recipe.yaml", "*.cls"]).args(options);
        let done = command.assert().code(1);
        assert!(stderr(&done).contains("CL0417"), "{options:?}: {}", stderr(&done));
        assert_eq!(names(&folder.path().join("exports")), ["part.cls"].map(PathBuf::from));
    }
    assert!(!folder.path().join("out").exists());
    let mut command = clsmith(folder.path());
    let done = command
        .args(["watch", "nowhere", "--output", "out", "--recipe", "recipe.yaml", "*"])
        .assert()
        .code(1);
    assert!(stderr(&done).contains("CL0401"), "{}", stderr(&done));
}

#[test]
fn a_folder_has_one_watch() {
    let folder = shop();
    let child = start(folder.path());
    wait_for("the first watch", || folder.path().join("out/part.cls").exists());
    let done = recipe(folder.path(), "*.cls").assert().code(1);
    assert!(stderr(&done).contains("CL0418"), "{}", stderr(&done));
    // Another folder for outputs does not help.
    let mut command = clsmith(folder.path());
    command.args(["watch", "exports", "--output", "other", "--once", "--recipe", "recipe.yaml", "*.cls"]);
    assert!(stderr(&command.assert().code(1)).contains("CL0418"));
    stop(child);
    recipe(folder.path(), "*.cls").assert().code(0);
}

#[test]
fn a_broken_recipe_is_told_before_the_watch_begins() {
    let folder = shop();
    fs::write(folder.path().join("recipe.yaml"), "version: 1\n").unwrap();
    let done = recipe(folder.path(), "*.cls").assert().code(1);
    assert!(stderr(&done).contains("no `steps`"), "{}", stderr(&done));
    assert!(folder.path().join("exports/part.cls").exists());
    let text = "rules:\n- when: { file: other }\n  recipe: missing.yaml\n";
    fs::write(folder.path().join("recipes.yaml"), text).unwrap();
    let done = once(folder.path(), &["--select", "recipes.yaml", "*.cls"]).assert().code(1);
    assert!(stderr(&done).contains("missing.yaml"), "{}", stderr(&done));
}

#[test]
fn a_recipe_that_breaks_meanwhile_refuses_nothing() {
    let folder = shop();
    let child = start(folder.path());
    wait_for("the first program", || folder.path().join("out/part.cls").exists());
    let good = fs::read(folder.path().join("recipe.yaml")).unwrap();
    fs::write(folder.path().join("recipe.yaml"), "version: 1\n").unwrap();
    fs::copy(folder.path().join("exports/part.cls"), folder.path().join("exports/next.cls")).unwrap();
    std::thread::sleep(Duration::from_millis(500));
    assert!(folder.path().join("exports/next.cls").exists());
    assert!(!folder.path().join("out/next.cls").exists());
    fs::write(folder.path().join("recipe.yaml"), good).unwrap();
    wait_for("the program after the recipe was put right", || folder.path().join("out/next.cls").exists());
    stop(child);
}

#[test]
fn rules_choose_pass_and_refuse() {
    let folder = shop();
    let text = "rules:\n- when: { operation: \"POCKET*\" }\n  recipe: recipe.yaml\notherwise: pass\n";
    fs::write(folder.path().join("recipes.yaml"), text).unwrap();
    fs::write(folder.path().join("exports/other.cls"), "RAPID\nGOTO/1.0,2.0,3.0\n").unwrap();
    once(folder.path(), &["--select", "recipes.yaml", "*.cls"]).assert().code(0);
    let outcomes: Vec<_> = log(folder.path()).iter().map(|line| line["outcome"].clone()).collect();
    assert_eq!(outcomes, ["passed", "corrected"]);
    assert_eq!(fs::read(folder.path().join("out/other.cls")).unwrap(), b"RAPID\nGOTO/1.0,2.0,3.0\n");
    fs::write(folder.path().join("recipes.yaml"), text.replace("pass", "stop")).unwrap();
    fs::write(folder.path().join("exports/other.cls"), "RAPID\nGOTO/1.0,2.0,4.0\n").unwrap();
    let done = once(folder.path(), &["--select", "recipes.yaml", "*.cls"]).assert().code(1);
    assert!(stderr(&done).contains("CL0416"), "{}", stderr(&done));
    assert!(folder.path().join("out/refused/other.cls").exists());
}

#[test]
fn an_output_that_cannot_be_written_is_tried_again() {
    let folder = shop();
    // A folder stands where the program is to go: so for root, too, whom no permission stops.
    fs::create_dir_all(folder.path().join("out/part.cls")).unwrap();
    let done = recipe(folder.path(), "*.cls").assert().code(1);
    assert!(stderr(&done).contains("CL0402"), "{}", stderr(&done));
    assert!(folder.path().join("exports/part.cls").exists());
    fs::remove_dir(folder.path().join("out/part.cls")).unwrap();
    recipe(folder.path(), "*.cls").assert().code(0);
    assert_eq!(fs::read(folder.path().join("out/part.cls")).unwrap(), corrected(folder.path()));
}

#[cfg(unix)]
#[test]
fn files_that_cannot_be_read_and_folders_that_cannot_be_written_are_told() {
    use std::os::unix::fs::PermissionsExt;
    let folder = shop();
    let mode = |path: &str, mode: u32| {
        fs::set_permissions(folder.path().join(path), fs::Permissions::from_mode(mode)).unwrap();
    };
    let run = || {
        let mut command = Command::from_std(super::as_anybody(folder.path()));
        command.args(["watch", "exports", "--output", "out", "--once", "--settle", "0.1", "--poll", "0.05"]);
        command.args(["--recipe", "recipe.yaml", "*.cls"]).assert()
    };
    fs::create_dir(folder.path().join("out")).unwrap();
    ["", "exports", "out"].iter().for_each(|path| mode(path, 0o777));
    mode("exports/part.cls", 0o000);
    assert!(stderr(&run().code(1)).contains("CL0401"));
    mode("exports/part.cls", 0o644);
    mode("out", 0o555);
    assert!(stderr(&run().code(1)).contains("CL0402"));
    mode("out", 0o777);
    run().code(0);
    assert!(folder.path().join("out/part.cls").exists());
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_leaves_nothing_half_written() {
    let folder = shop();
    let long = "GOTO/1.0000,2.0000,3.0000\n".repeat(40_000);
    fs::write(folder.path().join("exports/long.cls"), &long).unwrap();
    // A limit on the size of files is a full disk that needs no disk.
    let command = format!(
        "ulimit -f 64; trap '' XFSZ; exec '{}' watch exports -o out --once --settle 0.1 --recipe recipe.yaml '*.cls'",
        env!("CARGO_BIN_EXE_clsmith")
    );
    let mut shell = Command::new("bash");
    let done = shell.current_dir(folder.path()).args(["-c", &command]).assert().code(1);
    assert!(stderr(&done).contains("CL0402"), "{}", stderr(&done));
    assert_eq!(seen(&folder.path().join("out")), ["part.cls", "refused"]);
    recipe(folder.path(), "*.cls").assert().code(0);
    assert_eq!(fs::read_to_string(folder.path().join("out/long.cls")).unwrap(), long);
}

#[test]
fn a_watch_that_is_killed_at_any_moment_goes_on() {
    let folder = shop();
    let part = fs::read_to_string(folder.path().join("exports/part.cls")).unwrap();
    let names: Vec<String> = (0..12).map(|number| format!("part{number}.cls")).collect();
    for name in &names {
        fs::write(folder.path().join("exports").join(name), format!("{part}$$ {name}\n")).unwrap();
        fs::write(folder.path().join("exports").join(format!("bad-{name}")), format!("{BROKEN}$$ {name}\n"))
            .unwrap();
    }
    let (out, refused) = (folder.path().join("out"), folder.path().join("out/refused"));
    let made = || {
        [&out, &refused].into_iter().filter(|made| made.exists()).map(|made| seen(made).len()).sum::<usize>()
    };
    // As soon as something new stands there, and a little later each time: in the midst of the next.
    for round in 0..12 {
        let before = made();
        if before == 13 + 1 + 24 {
            break;
        }
        let child = start(folder.path());
        wait_for("something new", || made() > before);
        std::thread::sleep(Duration::from_millis(3 * round));
        stop(child);
        for name in seen(&folder.path().join("out")).iter().filter(|name| name.ends_with(".cls")) {
            let text = fs::read_to_string(folder.path().join("out").join(name)).unwrap();
            assert!(text.ends_with(&format!("$$ {name}\n")) || name == "part.cls", "{name} is cut");
        }
    }
    // The rest; what was refused before the last kill no longer counts, so either code is right.
    let _ = recipe(folder.path(), "*.cls").assert();
    let expected = corrected(folder.path());
    for name in &names {
        let text = fs::read(folder.path().join("out").join(name)).unwrap();
        assert_eq!(text, [&expected[..], format!("$$ {name}\n").as_bytes()].concat(), "{name}");
        let bad = fs::read_to_string(folder.path().join("out/refused").join(format!("bad-{name}"))).unwrap();
        assert_eq!(bad, format!("{BROKEN}$$ {name}\n"));
        assert!(!folder.path().join("exports").join(format!("bad-{name}")).exists());
    }
    assert_eq!(seen(&folder.path().join("out/refused")).len(), 24);
    let before = log(folder.path()).len();
    recipe(folder.path(), "*.cls").assert().code(0);
    assert_eq!(log(folder.path()).len(), before, "nothing is done twice");
}

#[test]
fn a_state_that_a_crash_has_cut_is_read() {
    let folder = shop();
    recipe(folder.path(), "*.cls").assert().code(0);
    let path = folder.path().join(STATE);
    let whole = fs::read(&path).unwrap();
    fs::copy(folder.path().join("exports/part.cls"), folder.path().join("exports/next.cls")).unwrap();
    recipe(folder.path(), "*.cls").assert().code(0);
    let both = fs::read(&path).unwrap();
    fs::write(&path, &both[..whole.len() + 30]).unwrap();
    let written = fs::metadata(folder.path().join("out/next.cls")).unwrap().modified().unwrap();
    let done = recipe(folder.path(), "*.cls").assert().code(0);
    assert!(stderr(&done).contains("1 line"), "{}", stderr(&done));
    // Its output stands, and nobody sees it change.
    assert_eq!(fs::metadata(folder.path().join("out/next.cls")).unwrap().modified().unwrap(), written);
    recipe(folder.path(), "*.cls").assert().code(0);
    assert_eq!(log(folder.path()).len(), 3);
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_a_watch() {
    let folder = shop();
    let mut child = start(folder.path());
    wait_for("the program", || folder.path().join("out/part.cls").exists());
    let id = child.id().to_string();
    assert!(std::process::Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
}

#[test]
fn the_watchs_command_line_is_checked() {
    let folder = shop();
    let run = |args: &[&str]| clsmith(folder.path()).arg("watch").args(args).assert().code(2);
    run(&["exports", "--output", "out", "*.cls"]);
    run(&["exports", "--recipe", "recipe.yaml", "*.cls"]);
    run(&["exports", "--output", "out", "--recipe", "recipe.yaml", "[.cls"]);
    run(&["exports", "--output", "out", "--recipe", "recipe.yaml", "--settle", "-1", "*.cls"]);
    run(&["exports", "--output", "out", "--recipe", "recipe.yaml", "--allow", "CL0419", "*.cls"]);
}

#[test]
fn without_a_pattern_exports_are_taken_by_their_usual_names() {
    let folder = shop();
    fs::write(folder.path().join("exports/notes.txt"), "no program").unwrap();
    once(folder.path(), &["--recipe", "recipe.yaml"]).assert().code(0);
    assert_eq!(seen(&folder.path().join("out")), ["part.cls", "refused"]);
}

#[test]
fn no_export_replaces_what_the_watch_keeps() {
    let folder = shop();
    let exports = folder.path().join("exports");
    let program = fs::read(exports.join("part.cls")).unwrap();
    fs::write(exports.join("part.cls"), "GOTO/x\n").unwrap();
    recipe(folder.path(), "**/*.cls").assert().code(1);
    let refused = folder.path().join("out/refused/part.cls");
    assert_eq!(fs::read(&refused).unwrap(), b"GOTO/x\n");
    fs::create_dir(exports.join("refused")).unwrap();
    fs::write(exports.join("refused/part.cls"), &program).unwrap();
    let done = recipe(folder.path(), "**/*.cls").assert().code(1);
    assert!(stderr(&done).contains("CL0404"), "{}", stderr(&done));
    assert_eq!(fs::read(&refused).unwrap(), b"GOTO/x\n");
}

#[cfg(unix)]
#[test]
fn outputs_do_not_leave_their_folder_through_links() {
    use std::os::unix::fs::symlink;
    let folder = shop();
    fs::create_dir_all(folder.path().join("out")).unwrap();
    fs::write(folder.path().join("precious"), "mine").unwrap();
    symlink("../precious", folder.path().join("out/part.cls")).unwrap();
    let done = recipe(folder.path(), "*.cls").assert().code(1);
    assert!(stderr(&done).contains("CL0422"), "{}", stderr(&done));
    assert_eq!(fs::read(folder.path().join("precious")).unwrap(), b"mine");
}
