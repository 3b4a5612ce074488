//! `clsmith hook`, with the post of `examples/hooks` and with posts that misbehave.

use super::{clsmith, example, names};
use crate::support::{require_program, wait_for};
use assert_cmd::Command;
use clsmith::fingerprint::Digest;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// What the shipped post runs in.
pub const PYTHON: [&str; 1] = ["python3"];

/// The shipped post.
pub fn post() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/hooks/post.py")
}

/// A hook with the recipe and log of every test, up to its own options.
fn hook(folder: &Path) -> Command {
    let mut command = clsmith(folder);
    command.args(["hook", "--recipe", "recipe.yaml", "--log", "log.jsonl"]);
    // Private folders are made here, so that a test sees what remains.
    fs::create_dir_all(folder.join("tmp")).unwrap();
    command.env("TMPDIR", folder.join("tmp"));
    command
}

/// The lines of the log.
pub fn log(folder: &Path) -> Vec<Value> {
    let text = fs::read_to_string(folder.join("log.jsonl")).unwrap();
    assert!(text.ends_with('\n'), "{text}");
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// The only line of the log.
fn line(folder: &Path) -> Value {
    let [line] = <[Value; 1]>::try_from(log(folder)).unwrap();
    line
}

fn stderr(done: &assert_cmd::assert::Assert) -> String {
    String::from_utf8_lossy(&done.get_output().stderr).into_owned()
}

fn nothing_remains(folder: &Path) {
    assert_eq!(names(&folder.join("tmp")), Vec::<PathBuf>::new());
}

/// A script in a folder.
fn script(folder: &Path, text: &str) -> PathBuf {
    let path = folder.join("script.sh");
    fs::write(&path, format!("#!/bin/sh\n{text}\n")).unwrap();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    }
    path
}

#[test]
fn the_post_gets_the_corrected_program_and_the_log_proves_it() {
    let Some(python) = require_program(&PYTHON) else { return };
    let folder = example("pocket");
    let before = fs::read(folder.path().join("part.cls")).unwrap();
    let done = hook(folder.path())
        .args(["--keep", "kept.cls", "part.cls", "--"])
        .args([&python, &post()])
        .args(["-o", "part.nc", "{}"])
        .assert()
        .code(0);
    assert_eq!(done.get_output().stdout, b"");
    let nc = fs::read_to_string(folder.path().join("part.nc")).unwrap();
    assert!(nc.contains("X20.0000 Y0.0000 Z-1.0000 F600"), "{nc}");
    clsmith(folder.path()).args(["apply", "recipe.yaml", "part.cls", "-o", "out.cls"]).assert().success();
    let corrected = fs::read(folder.path().join("out.cls")).unwrap();
    assert_eq!(fs::read(folder.path().join("kept.cls")).unwrap(), corrected);
    assert_eq!(fs::read(folder.path().join("part.cls")).unwrap(), before);
    nothing_remains(folder.path());
    let line = line(folder.path());
    assert_eq!(line["outcome"], "corrected");
    assert_eq!(line["input"]["sha256"], Digest::from_bytes(&before).to_string());
    assert_eq!(line["output"]["sha256"], Digest::from_bytes(&corrected).to_string());
    let recipe = Digest::from_bytes(&fs::read(folder.path().join("recipe.yaml")).unwrap()).to_string();
    assert_eq!(line["recipe"]["files"][0]["sha256"], recipe);
    assert_eq!(line["clsmith"], env!("CARGO_PKG_VERSION"));
    assert_eq!(line["steps"][0]["name"], "scale_feed");
    assert_eq!(line["steps"][0]["inserted"]["feed"], 1);
    assert_eq!(
        (&line["post"]["ended"], &line["post"]["code"], &line["exit"]),
        (&"exit".into(), &0.into(), &0.into())
    );
    assert!(line["time"].as_str().unwrap().ends_with('Z'), "{line}");
    assert!(line["seconds"].as_f64().unwrap() >= line["post"]["seconds"].as_f64().unwrap());
}

#[test]
fn what_the_post_leaves_beside_its_program_comes_beside_the_export() {
    let Some(python) = require_program(&PYTHON) else { return };
    let folder = example("pocket");
    fs::create_dir(folder.path().join("exports")).unwrap();
    fs::rename(folder.path().join("part.cls"), folder.path().join("exports/part.cls")).unwrap();
    let before = fs::read(folder.path().join("exports/part.cls")).unwrap();
    let post_args = |command: &mut Command| {
        command
            .args(["exports/part.cls", "--"])
            .args([&python, &post()])
            .args(["--beside", "{}"])
            .assert()
            .code(0)
    };
    let done = post_args(&mut hook(folder.path()));
    assert!(stderr(&done).contains("part.nc: from the post"), "{}", stderr(&done));
    assert_eq!(names(&folder.path().join("exports")), ["part.cls", "part.nc"].map(PathBuf::from));
    assert_eq!(fs::read(folder.path().join("exports/part.cls")).unwrap(), before);
    // A second run replaces it, as the post itself would.
    post_args(&mut hook(folder.path()));
    let lines = log(folder.path());
    assert_eq!(lines.len(), 2);
    assert_eq!(lines[1]["post"]["left"][0], lines[0]["post"]["left"][0]);
    nothing_remains(folder.path());
}

#[test]
fn arguments_reach_the_post_as_they_are() {
    let folder = example("pocket");
    let script = script(folder.path(), "for a in \"$@\"; do printf '<%s>\\n' \"$a\"; done");
    let given = [
        "a b",
        "it's",
        "\"quoted\"",
        "line\nbreak",
        "$HOME;`id`|*",
        "",
        "--log",
        "{}",
        "in={},{}.bak",
        "{ }",
    ];
    let done = hook(folder.path()).args(["part.cls", "--"]).arg(script).args(given).assert().code(0);
    let text = String::from_utf8_lossy(&done.get_output().stdout).into_owned();
    let path = text.split('<').find(|part| part.ends_with("part.cls>\n")).unwrap().trim_end_matches(">\n");
    assert!(Path::new(path).starts_with(folder.path().join("tmp")), "{path}");
    let expected: String = given.iter().map(|given| format!("<{}>\n", given.replace("{}", path))).collect();
    assert_eq!(text, expected);
    assert_eq!(line(folder.path())["post"]["command"][8], "{}");
}

#[cfg(unix)]
#[test]
fn names_and_arguments_need_not_be_utf8() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = example("pocket");
    let script = script(folder.path(), "printf '%s\\n' \"$1\"; cp \"$2\" \"$2.copy\"");
    let name = OsStr::from_bytes(b"gr\xfc\xdfe \xff.cls");
    fs::rename(folder.path().join("part.cls"), folder.path().join(name)).unwrap();
    let odd = OsStr::from_bytes(b"\xfe\xff");
    let done = hook(folder.path()).arg(name).arg("--").arg(script).arg(odd).arg("{}").assert().code(0);
    assert_eq!(done.get_output().stdout, b"\xfe\xff\n");
    assert!(folder.path().join(OsStr::from_bytes(b"gr\xfc\xdfe \xff.cls.copy")).exists());
}

#[cfg(target_os = "linux")]
#[test]
fn nobody_else_can_read_the_copy() {
    let folder = example("pocket");
    let script = script(folder.path(), "stat -c %a \"${1%/*}\"");
    let done = hook(folder.path()).args(["part.cls", "--"]).arg(script).arg("{}").assert().code(0);
    assert_eq!(done.get_output().stdout, b"700\n");
}

#[test]
fn the_exit_code_of_the_post_is_the_hooks() {
    let Some(python) = require_program(&PYTHON) else { return };
    let folder = example("pocket");
    let part = fs::read_to_string(folder.path().join("part.cls")).unwrap();
    fs::write(folder.path().join("part.cls"), part + "THREAD/OFF\nFINI\n").unwrap();
    let done =
        hook(folder.path()).args(["part.cls", "--"]).args([&python, &post()]).arg("{}").assert().code(3);
    assert!(stderr(&done).contains("THREAD is too much for this post"), "{}", stderr(&done));
    let path = script(folder.path(), "exit 77");
    hook(folder.path()).args(["part.cls", "--"]).arg(path).arg("{}").assert().code(77);
    // A code that the hook uses itself is told.
    let path = script(folder.path(), "exit 125");
    let done = hook(folder.path()).args(["part.cls", "--"]).arg(path).arg("{}").assert().code(125);
    assert!(stderr(&done).contains("CL0415"), "{}", stderr(&done));
    let lines = log(folder.path());
    let ends: Vec<_> = lines.iter().map(|line| line["exit"].as_i64().unwrap()).collect();
    assert_eq!(ends, [3, 77, 125]);
    assert_eq!(lines[2]["outcome"], "corrected");
    assert_eq!(lines[2]["findings"]["CL0415"], 1);
}

#[cfg(unix)]
#[test]
fn a_post_that_crashes_is_told_and_what_it_left_is_thrown_away() {
    let folder = example("pocket");
    let script = script(folder.path(), "echo half > \"$1.nc\"; kill -SEGV $$");
    let done = hook(folder.path()).args(["part.cls", "--"]).arg(script).arg("{}").assert().code(128 + 11);
    assert!(stderr(&done).contains("CL0414"), "{}", stderr(&done));
    assert!(!folder.path().join("part.cls.nc").exists());
    nothing_remains(folder.path());
}

#[test]
fn all_that_the_post_prints_is_forwarded() {
    let folder = example("pocket");
    let script = script(folder.path(), "head -c 10485760 /dev/zero; head -c 5000000 /dev/zero >&2");
    let done = hook(folder.path()).args(["-q", "part.cls", "--"]).arg(script).arg("{}").assert().code(0);
    assert_eq!(done.get_output().stdout.len(), 10 * 1024 * 1024);
    assert_eq!(done.get_output().stderr.len(), 5_000_000);
}

#[test]
fn a_post_that_is_missing_or_cannot_be_started_is_told() {
    let folder = example("pocket");
    let done = hook(folder.path()).args(["part.cls", "--", "no-such-post", "{}"]).assert().code(127);
    assert!(stderr(&done).contains("CL0411"), "{}", stderr(&done));
    let done = hook(folder.path()).args(["part.cls", "--", "./recipe.yaml", "{}"]).assert().code(126);
    assert!(stderr(&done).contains("CL0412"), "{}", stderr(&done));
    let lines = log(folder.path());
    assert_eq!(
        (&lines[0]["post"]["ended"], &lines[1]["post"]["ended"]),
        (&"missing".into(), &"not_started".into())
    );
    nothing_remains(folder.path());
}

/// Whether a process is there and no zombie.
#[cfg(target_os = "linux")]
fn lives(id: &str) -> bool {
    let status = fs::read_to_string(format!("/proc/{}/stat", id.trim()));
    status.is_ok_and(|status| !status.rsplit(')').next().unwrap().trim_start().starts_with('Z'))
}

/// Waits until a process that was killed is gone: on a busy machine that takes its time, but not the hour it would have slept.
#[cfg(target_os = "linux")]
fn dies(id: &str) {
    wait_for("the end of a process", || !lives(id));
}

/// A post that hangs with a child, both deaf to a request to end, and writes the child's number.
#[cfg(target_os = "linux")]
const DEAF: &str = "trap '' TERM; (trap '' TERM; sleep 3600 & wait; sleep 3600) & echo $! > child; echo half > \"$1.nc\"; wait; sleep 3600";

#[cfg(target_os = "linux")]
#[test]
fn a_post_that_hangs_is_stopped_with_its_children() {
    let folder = example("pocket");
    let script = script(folder.path(), DEAF);
    let done = hook(folder.path())
        .args(["--timeout", "0.5", "part.cls", "--"])
        .arg(script)
        .arg("{}")
        .assert()
        .code(124);
    assert!(stderr(&done).contains("CL0413"), "{}", stderr(&done));
    dies(&fs::read_to_string(folder.path().join("child")).unwrap());
    assert!(!folder.path().join("part.cls.nc").exists());
    assert_eq!(line(folder.path())["post"]["ended"], "timed_out");
    nothing_remains(folder.path());
}

#[cfg(target_os = "linux")]
#[test]
fn ctrl_c_stops_the_post_and_leaves_nothing() {
    let folder = example("pocket");
    let script = script(folder.path(), "sleep 3600 & echo $! > child; wait");
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_clsmith"))
        .current_dir(folder.path())
        .env("TMPDIR", folder.path())
        .args(["hook", "--recipe", "recipe.yaml", "--log", "log.jsonl", "part.cls", "--"])
        .arg(script)
        .arg("{}")
        .spawn()
        .unwrap();
    let number = || fs::read_to_string(folder.path().join("child")).unwrap_or_default();
    wait_for("the post", || number().ends_with('\n'));
    let number = number();
    let killed = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    dies(&number);
    let left = names(folder.path());
    assert!(!left.iter().any(|name| name.to_string_lossy().starts_with("clsmith-hook")), "{left:?}");
    assert_eq!(line(folder.path())["outcome"], "stopped");
}

#[test]
fn a_program_that_cannot_be_corrected_is_not_posted() {
    let folder = example("pocket");
    let part = fs::read_to_string(folder.path().join("part.cls")).unwrap();
    fs::write(folder.path().join("part.cls"), part.replace("-10.0000,-4", "-1O.0000,-4")).unwrap();
    let script = script(folder.path(), "cp \"$1\" posted");
    let done = hook(folder.path()).args(["part.cls", "--"]).arg(&script).arg("{}").assert().code(125);
    assert!(
        stderr(&done).contains("CL0003") && stderr(&done).contains("nothing was posted"),
        "{}",
        stderr(&done)
    );
    assert!(!folder.path().join("posted").exists());
    let done = hook(folder.path())
        .args(["--on-error", "pass-original", "part.cls", "--"])
        .arg(&script)
        .arg("{}")
        .assert()
        .code(0);
    assert!(stderr(&done).contains("CL0410") && stderr(&done).contains("UNTOUCHED"), "{}", stderr(&done));
    let (posted, export) = (folder.path().join("posted"), folder.path().join("part.cls"));
    assert_eq!(fs::read(posted).unwrap(), fs::read(export).unwrap());
    let lines = log(folder.path());
    assert_eq!((&lines[0]["outcome"], &lines[1]["outcome"]), (&"refused".into(), &"passed_original".into()));
    assert_eq!((&lines[0]["post"], &lines[0]["exit"]), (&Value::Null, &125.into()));
    assert!(lines[0]["errors"][0].as_str().unwrap().starts_with("part.cls:21:"), "{}", lines[0]);
    assert_eq!(lines[1]["output"]["sha256"], lines[1]["input"]["sha256"]);
}

#[test]
fn a_broken_recipe_stops_or_passes_too() {
    let folder = example("pocket");
    fs::write(folder.path().join("recipe.yaml"), "version: 1\nsteps:\n  - scale_feed: { facter: 0.5 }\n")
        .unwrap();
    let script = script(folder.path(), "cp \"$1\" posted");
    let done = hook(folder.path()).args(["part.cls", "--"]).arg(&script).arg("{}").assert().code(125);
    assert!(stderr(&done).contains("Did you mean `factor`"), "{}", stderr(&done));
    assert!(!folder.path().join("posted").exists());
    let mut command = hook(folder.path());
    command.args(["--on-error", "pass-original", "part.cls", "--"]).arg(&script).arg("{}").assert().code(0);
    assert!(folder.path().join("posted").exists());
    // What is not there cannot be passed on.
    let mut command = hook(folder.path());
    let done = command
        .args(["--on-error", "pass-original", "gone.cls", "--"])
        .arg(&script)
        .arg("{}")
        .assert()
        .code(125);
    assert!(stderr(&done).contains("CL0401"), "{}", stderr(&done));
}

#[test]
fn nothing_that_a_run_reads_is_overwritten() {
    let folder = example("pocket");
    let before: Vec<_> =
        ["part.cls", "recipe.yaml"].map(|name| fs::read(folder.path().join(name)).unwrap()).into();
    let path = script(folder.path(), "echo other > \"${1%/*}/recipe.yaml\"; echo more > \"$1\"");
    for keep in ["part.cls", ".", "recipe.yaml"] {
        let mut command = hook(folder.path());
        let done = command.args(["--keep", keep, "part.cls", "--"]).arg(&path).arg("{}").assert().code(125);
        assert!(stderr(&done).contains("CL0404"), "{keep}: {}", stderr(&done));
    }
    let done = hook(folder.path()).args(["part.cls", "--"]).arg(&path).arg("{}").assert().code(125);
    assert!(stderr(&done).contains("CL0404"), "{}", stderr(&done));
    for log in ["part.cls", "recipe.yaml"] {
        let mut command = clsmith(folder.path());
        command.args(["hook", "--recipe", "recipe.yaml", "--log", log, "part.cls", "--", "true", "{}"]);
        assert!(stderr(&command.assert().code(125)).contains("CL0404"), "{log}");
    }
    let after: Vec<_> =
        ["part.cls", "recipe.yaml"].map(|name| fs::read(folder.path().join(name)).unwrap()).into();
    assert_eq!(before, after);
}

#[test]
fn a_log_or_a_kept_file_that_cannot_be_written_stops_the_run_before_the_post() {
    let folder = example("pocket");
    let script = script(folder.path(), "cp \"$1\" posted");
    let run = |options: &[&str], code: i32| {
        let mut command = clsmith(folder.path());
        command.args(["hook", "--recipe", "recipe.yaml"]).args(options).args(["part.cls", "--"]);
        let done = command.arg(&script).arg("{}").assert().code(code);
        assert!(stderr(&done).contains("CL0402"), "{}", stderr(&done));
    };
    run(&["--log", "nowhere/log.jsonl"], 125);
    run(&["--keep", "nowhere/part.cls"], 125);
    assert!(!folder.path().join("posted").exists());
    run(&["--log", "nowhere/log.jsonl", "--on-error", "pass-original"], 0);
    assert!(folder.path().join("posted").exists());
}

#[test]
fn the_hooks_command_line_is_checked() {
    let folder = example("pocket");
    let run = |args: &[&str]| clsmith(folder.path()).arg("hook").args(args).assert().code(2);
    let done = run(&["--recipe", "recipe.yaml", "part.cls", "--", "post", "part.cls"]);
    assert!(stderr(&done).contains("`{}`"), "{}", stderr(&done));
    run(&["--recipe", "recipe.yaml", "part.cls", "--", "{}"]);
    run(&["--recipe", "recipe.yaml", "part.cls"]);
    run(&["--recipe", "recipe.yaml", "-", "--", "post", "{}"]);
    run(&["part.cls", "--", "post", "{}"]);
    run(&["--recipe", "recipe.yaml", "--select", "recipes.yaml", "part.cls", "--", "post", "{}"]);
    run(&["--recipe", "recipe.yaml", "--timeout", "0", "part.cls", "--", "post", "{}"]);
    run(&["--recipe", "recipe.yaml", "--timeout", "soon", "part.cls", "--", "post", "{}"]);
    run(&["--recipe", "recipe.yaml", "--allow", "CL0410", "part.cls", "--", "post", "{}"]);
}

#[test]
fn lines_of_runs_at_the_same_time_do_not_mix() {
    let folder = example("pocket");
    let path = script(folder.path(), "true");
    std::thread::scope(|scope| {
        for _ in 0..8 {
            scope.spawn(|| {
                hook(folder.path()).args(["-q", "part.cls", "--"]).arg(&path).arg("{}").assert().code(0);
            });
        }
    });
    assert_eq!(log(folder.path()).len(), 8);
}

#[cfg(unix)]
#[test]
fn what_cannot_be_put_beside_the_export_is_no_success() {
    let folder = example("pocket");
    fs::write(folder.path().join("part.nc"), "of yesterday").unwrap();
    let script = script(folder.path(), "mkfifo \"${1%.cls}.nc\"");
    let done = hook(folder.path()).args(["part.cls", "--"]).arg(&script).arg("{}").assert().code(125);
    assert!(stderr(&done).contains("CL0401"), "{}", stderr(&done));
    assert_eq!(line(folder.path())["exit"], 125);
    nothing_remains(folder.path());
}

#[cfg(unix)]
#[test]
fn an_export_that_is_still_written_is_not_posted() {
    use std::io::Write;
    let folder = example("pocket");
    let script = script(folder.path(), "cp \"$1\" posted");
    // The hook has read the export when it opens the recipe, and waits at this pipe until the recipe has come.
    let pipe = folder.path().join("pipe.yaml");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let done = std::thread::scope(|scope| {
        scope.spawn(|| {
            let recipe = fs::read(folder.path().join("recipe.yaml")).unwrap();
            let mut pipe = fs::File::options().write(true).open(&pipe).unwrap();
            let mut export = fs::File::options().append(true).open(folder.path().join("part.cls")).unwrap();
            export.write_all(b"$$ more\n").unwrap();
            pipe.write_all(&recipe).unwrap();
        });
        let mut command = clsmith(folder.path());
        command.args(["hook", "--recipe", "pipe.yaml", "--on-error", "pass-original", "part.cls", "--"]);
        command.arg(&script).arg("{}").assert()
    });
    let done = done.code(125);
    assert!(stderr(&done).contains("CL0424"), "{}", stderr(&done));
    assert!(!folder.path().join("posted").exists());
}

#[test]
fn a_line_that_a_full_disk_has_cut_does_not_spoil_the_next() {
    let folder = example("pocket");
    let script = script(folder.path(), "true");
    fs::write(folder.path().join("log.jsonl"), "{\"cut").unwrap();
    hook(folder.path()).args(["part.cls", "--"]).arg(&script).arg("{}").assert().code(0);
    let text = fs::read_to_string(folder.path().join("log.jsonl")).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[0], "{\"cut");
    assert_eq!(serde_json::from_str::<Value>(lines[1]).unwrap()["exit"], 0);
}

#[test]
fn a_folder_to_keep_in_is_made() {
    let folder = example("pocket");
    let script = script(folder.path(), "true");
    let mut command = hook(folder.path());
    command.args(["--keep", "kept/", "part.cls", "--"]).arg(&script).arg("{}").assert().code(0);
    assert!(folder.path().join("kept/part.cls").exists());
}
