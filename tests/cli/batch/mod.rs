//! `clsmith batch` and `clsmith merge`.

mod cluster;
mod killed;
mod refused;
mod resume;
mod shards;
#[cfg(unix)]
mod stopping;
mod trouble;
#[cfg(unix)]
mod unix;

use super::clsmith;
use crate::support;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Halves the feed of every file.
pub const RECIPE: &str = "version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n";

/// A program whose feed tells which one it is.
pub fn part(number: usize) -> String {
    format!(
        "TOOL PATH/OP{number},TOOL,T1\nFEDRAT/MMPM,{number}00.0\nGOTO/1.0,2.0,3.0\nGOTO/4.0,5.0,6.0\nEND-OF-PATH\n"
    )
}

/// A program with so many points.
pub fn long_part(points: usize) -> String {
    let goto = |index: usize| format!("GOTO/{}.0000,{}.5000,-1.0000\n", index % 97, index % 89);
    format!(
        "TOOL PATH/LONG,TOOL,T1\nFEDRAT/MMPM,100.0\n{}END-OF-PATH\n",
        (0..points).map(goto).collect::<String>()
    )
}

/// A folder with a recipe and so many programs, in three folders.
pub fn shop(programs: usize) -> tempfile::TempDir {
    // In memory where there is such a disk: outputs are synced, which takes long on a busy one.
    let memory = Path::new("/dev/shm");
    let folder = if memory.is_dir() { tempfile::tempdir_in(memory) } else { tempfile::tempdir() }.unwrap();
    write(folder.path(), "r.yaml", RECIPE);
    for number in 1..=programs {
        let name = format!("programs/{}p{number:03}.cls", ["", "a/", "a/b/"][number % 3]);
        write(folder.path(), &name, &part(number));
    }
    folder
}

/// Writes a file and the folders it is in.
pub fn write(folder: &Path, name: &str, text: &str) {
    let path = folder.join(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, text).unwrap();
}

pub const ALL: &str = "programs/**/*.cls";

/// `clsmith batch --recipe r.yaml -o OUT 'programs/**/*.cls'` and more arguments.
pub fn batch(folder: &Path, out: &str, more: &[&str]) -> assert_cmd::assert::Assert {
    let mut command = clsmith(folder);
    command.args(["batch", "--recipe", "r.yaml", "--output", out]).args(more);
    if !more.contains(&"--memory") {
        command.args(["--memory", "64M", "--threads", "4"].iter().take(if more.contains(&"--threads") {
            2
        } else {
            4
        }));
    }
    // Unless a pattern is the last of them.
    if more.last().is_none_or(|last| !last.ends_with(".cls")) {
        command.arg(ALL);
    }
    command.assert()
}

/// All files below a folder with their bytes, but not what the batch keeps for itself.
pub fn tree(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = everything(folder);
    found.retain(|path, _| !path.file_name().unwrap().as_encoded_bytes().starts_with(b".clsmith-batch"));
    found
}

/// All files below a folder with their bytes.
pub fn everything(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in walkdir::WalkDir::new(folder).into_iter().map(Result::unwrap) {
        if entry.file_type().is_file() {
            let below = entry.path().strip_prefix(folder).unwrap().to_path_buf();
            found.insert(below, fs::read(entry.path()).unwrap());
        }
    }
    found
}

pub fn stderr(done: &assert_cmd::assert::Assert) -> String {
    String::from_utf8_lossy(&done.get_output().stderr).into_owned()
}

pub fn stdout(done: &assert_cmd::assert::Assert) -> String {
    String::from_utf8_lossy(&done.get_output().stdout).into_owned()
}

/// The lines of results below the head.
pub fn lines(path: &Path) -> Vec<serde_json::Value> {
    let text = fs::read_to_string(path).unwrap();
    text.lines().skip(1).map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn every_file_is_what_apply_makes_of_it() {
    let shop = shop(7);
    batch(shop.path(), "done", &[]).success();
    let done = tree(&shop.path().join("done"));
    assert_eq!(done.len(), 8, "{:?}", done.keys());
    for (name, bytes) in done.iter().filter(|(name, _)| !name.ends_with("results.jsonl")) {
        let input = Path::new("programs").join(name);
        clsmith(shop.path()).args(["apply", "r.yaml", "-q", "-o", "one"]).arg(input).assert().success();
        assert_eq!(fs::read(shop.path().join("one")).unwrap(), *bytes);
    }
}

#[test]
fn the_summary_and_the_results_tell_what_happened() {
    let shop = shop(4);
    write(shop.path(), "programs/bad.cls", "GOTO/1.0,2.0,x\n");
    write(
        shop.path(),
        "programs/nothing.cls",
        "TOOL PATH/A,TOOL,T\nRAPID\nGOTO/0.0000,0.0000,50.0000\nEND-OF-PATH\n",
    );
    write(shop.path(), "programs/empty.cls", "$$ only a comment\n");
    let done = batch(shop.path(), "done", &["--threads", "1"]).code(1);
    let mut settings = support::snapshots("cli");
    settings.add_filter(r"in \d+\.\d s", "in [seconds]");
    settings.bind(|| insta::assert_snapshot!("batch_summary", format!("{}{}", stderr(&done), stdout(&done))));
    let results = fs::read_to_string(shop.path().join("done/results.jsonl")).unwrap();
    settings.add_filter(r#""version":"[^"]*""#, r#""version":"[version]""#);
    settings.add_filter(r#""batch":"[^"]*""#, r#""batch":"[digest]""#);
    settings.bind(|| insta::assert_snapshot!("batch_results", results));
    assert!(!shop.path().join("done/bad.cls").exists());
    let quiet = batch(shop.path(), "done", &["-q", "--format", "line"]).code(1);
    assert_eq!(stdout(&quiet), "");
    let lines = stderr(&quiet);
    let mut lines: Vec<&str> = lines.lines().collect();
    lines.sort_unstable();
    let empty = "programs/empty.cls: CL0116: nothing moves in this program";
    assert_eq!(lines, ["programs/bad.cls:1:14: CL0003: `x` is not a number", empty]);
}

#[test]
fn a_jobs_file_has_its_paths_beside_itself() {
    let shop = shop(3);
    write(shop.path(), "jobs/slow.yaml", RECIPE);
    write(shop.path(), "jobs/fast.yaml", "version: 1\nsteps:\n  - scale_feed: { factor: 2 }\n");
    let jobs = "out: ../done\njobs:\n  - { recipe: slow.yaml, files: ['../programs/**/*.cls'] }\n  - { recipe: fast.yaml, files: ['../programs/*.cls'], out: fast }\n";
    write(shop.path(), "jobs/all.yaml", jobs);
    let run =
        |args: &[&str]| clsmith(shop.path()).args(["batch", "jobs/all.yaml"]).args(args).assert().success();
    run(&[]);
    let done = tree(&shop.path().join("done"));
    let names: Vec<String> = done.keys().map(|path| path.to_string_lossy().replace('\\', "/")).collect();
    assert_eq!(names, ["a/b/p002.cls", "a/p001.cls", "fast/p003.cls", "p003.cls", "results.jsonl"]);
    let feed =
        |name: &str| String::from_utf8_lossy(&done[Path::new(name)]).lines().nth(1).unwrap().to_owned();
    assert_eq!(
        (feed("p003.cls").as_str(), feed("fast/p003.cls").as_str()),
        ("FEDRAT/MMPM,150.0", "FEDRAT/MMPM,600.0")
    );
    // Names in results are as the jobs file has them, wherever clsmith runs.
    assert_eq!(lines(&shop.path().join("done/results.jsonl"))[0]["input"], "../programs/a/b/p002.cls");
    clsmith(&shop.path().join("jobs")).args(["batch", "all.yaml"]).assert().success();
    assert_eq!(tree(&shop.path().join("done")), done);
    run(&["--output", "elsewhere"]);
    assert_eq!(tree(&shop.path().join("elsewhere")), done);
    assert!(stdout(&run(&[])).contains("all"), "a sum over the recipes");
    let schema = clsmith(shop.path()).args(["schema", "--jobs"]).assert().success();
    assert!(stdout(&schema).contains("clsmith jobs file"));
}

#[test]
fn results_do_not_depend_on_threads_memory_or_order() {
    let shop = shop(30);
    write(shop.path(), "programs/long.cls", &long_part(3000));
    write(shop.path(), "programs/bad.cls", "GOTO/x\n");
    batch(shop.path(), "one", &["--threads", "1"]).code(1);
    batch(shop.path(), "four", &["--threads", "4"]).code(1);
    batch(shop.path(), "little", &["--threads", "4", "--memory", "9M"]).code(1);
    let one = tree(&shop.path().join("one"));
    assert_eq!(one.len(), 32);
    assert_eq!(one, tree(&shop.path().join("four")));
    assert_eq!(one, tree(&shop.path().join("little")));
}

#[test]
fn a_file_over_the_budget_runs_and_is_told() {
    let shop = shop(3);
    let done = batch(shop.path(), "done", &["--memory", "1M", "--format", "line"]).success();
    assert_eq!(stderr(&done).matches("CL0425").count(), 3, "{}", stderr(&done));
    assert_eq!(tree(&shop.path().join("done")).len(), 4);
    batch(shop.path(), "never", &["--memory", "1M", "--deny", "CL0425"]).code(1);
    assert!(tree(&shop.path().join("never")).is_empty());
}

#[test]
fn one_failure_stops_the_rest_only_if_asked() {
    let shop = shop(20);
    // The largest is first.
    write(shop.path(), "programs/bad.cls", &format!("GOTO/x\n{}", long_part(200)));
    batch(shop.path(), "done", &["--threads", "1"]).code(1);
    assert_eq!(tree(&shop.path().join("done")).len(), 21);
    let done = batch(shop.path(), "stopped", &["--threads", "1", "--fail-fast"]).code(1);
    assert_eq!(tree(&shop.path().join("stopped")).len(), 1, "only results");
    let results = lines(&shop.path().join("stopped/results.jsonl"));
    let not_run = results.iter().filter(|line| line["outcome"] == "not_run").count();
    assert_eq!((results.len(), not_run), (21, 20), "{}", stdout(&done));
}

#[test]
fn results_go_where_they_are_told_and_have_times_on_request() {
    let shop = shop(2);
    batch(shop.path(), "done", &["--results", "r.jsonl", "--times"]).success();
    assert!(lines(&shop.path().join("r.jsonl")).iter().all(|line| line["seconds"].is_f64()));
    assert!(!shop.path().join("done/results.jsonl").exists());
    let done = batch(shop.path(), "done", &["--results", "nowhere/r.jsonl"]).code(1);
    assert!(stderr(&done).contains("CL0402"), "{}", stderr(&done));
}
