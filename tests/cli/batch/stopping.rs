//! A batch that is asked to stop ends within two seconds, whatever it is doing, and goes on to the same result.

use super::{batch, everything, shop, tree, write};
use crate::support::wait_for;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// How long a stop may take: two seconds, and a little for a busy machine to start `kill` and to notice the end.
const SOON: Duration = Duration::from_millis(2500);

const LONG: &str = "programs/long.cls";

/// A program of some hundred operations whose feeds take minutes with columns this fine, and one that is done at once.
fn long_shop() -> tempfile::TempDir {
    let shop = shop(0);
    let head =
        "UNITS/MM\nTLDATA/MILL,10.0000,0.0000,50.0000,0.0000,0.0000\nLOAD/TOOL,1\nSPINDL/RPM,5000,CLW\n";
    let mut long = head.to_owned();
    for number in 0..300 {
        long.push_str(&format!(
            "TOOL PATH/OP{number},TOOL,EM10\nRAPID\nGOTO/-10.0000,0.0000,10.0000\nRAPID\n"
        ));
        long.push_str("GOTO/-10.0000,0.0000,-2.0000\nFEDRAT/MMPM,800.0000\n");
        for pass in 0..200 {
            let (x, y) = (if pass % 2 == 0 { 30 } else { -10 }, f64::from(pass % 20));
            long.push_str(&format!("GOTO/{x}.0000,{y:.4},{:.4}\n", -2.0 - f64::from(number) * 0.01));
        }
        long.push_str("RAPID\nGOTO/0.0000,0.0000,10.0000\nEND-OF-PATH\n");
    }
    write(shop.path(), LONG, &long);
    let short = format!(
        "{head}RAPID\nGOTO/-10.0000,5.0000,10.0000\nRAPID\nGOTO/-10.0000,5.0000,-1.0000\nFEDRAT/MMPM,800.0000\n\
         GOTO/-3.0000,5.0000,-1.0000\nRAPID\nGOTO/-3.0000,5.0000,10.0000\n"
    );
    (0..4).for_each(|number| write(shop.path(), &format!("programs/a{number}.cls"), &short));
    recipe(shop.path(), "0.02");
    shop
}

fn recipe(folder: &Path, cell: &str) {
    write(
        folder,
        "r.yaml",
        &format!(
            "version: 1\nunits: mm\nsetup:\n  machine: {{ max_feed: 3000, rapid_feed: 9000 }}\n  \
             stock: {{ block: {{ from: [0, 0, -10], to: [20, 20, 0] }} }}\n  \
             tools: [ {{ match: {{}}, diameter: 10, flute_length: 20, teeth: 4 }} ]\nsimulate: false\n\
             steps:\n  - optimize_feed: {{ target: 0.05, cell: {cell}, engagement: columns }}\n"
        ),
    );
}

fn start(folder: &Path, out: Stdio, err: Stdio) -> Child {
    Command::new(env!("CARGO_BIN_EXE_clsmith"))
        .current_dir(folder)
        .args(["batch", "--recipe", "r.yaml", "--threads", "2", "--output", "done", "programs/*.cls"])
        .stdout(out)
        .stderr(err)
        .spawn()
        .unwrap()
}

fn journal(folder: &Path) -> String {
    std::fs::read_to_string(folder.join("done/.clsmith-batch.journal")).unwrap_or_default()
}

/// Asks a run to stop, and tells its exit code and how long it took.
fn stop(run: &mut Child, signal: &str) -> (Option<i32>, Duration) {
    let begun = Instant::now();
    let asked = Command::new("kill").args([signal, &run.id().to_string()]).status().unwrap();
    assert!(asked.success());
    while run.try_wait().unwrap().is_none() && begun.elapsed() < 10 * SOON {
        std::thread::sleep(Duration::from_millis(5));
    }
    let took = begun.elapsed();
    let _ = run.kill();
    (run.wait().unwrap().code(), took)
}

#[test]
fn a_long_run_ends_within_two_seconds_and_goes_on() {
    for signal in ["-TERM", "-INT"] {
        let shop = long_shop();
        let mut run = start(shop.path(), Stdio::null(), Stdio::null());
        wait_for("the short files", || journal(shop.path()).lines().count() == 5);
        std::thread::sleep(Duration::from_millis(300));
        let (code, took) = stop(&mut run, signal);
        assert!(took < SOON, "{signal}: {took:?}");
        assert_eq!(code, Some(130), "{signal}");
        // What is there is whole: the journal with the short files, and they.
        let kept = journal(shop.path());
        assert_eq!(kept.lines().count(), 5, "{kept}");
        assert!(kept.ends_with('\n'), "{kept}");
        kept.lines().for_each(|line| drop(serde_json::from_str::<serde_json::Value>(line).unwrap()));
        let done = shop.path().join("done");
        assert!(!done.join("long.cls").exists() && !done.join("results.jsonl").exists());
        // It goes on to what an undisturbed run gives. Coarser columns are another recipe, so all is done again.
        recipe(shop.path(), "0.9");
        batch(shop.path(), "done", &["--resume"]).success();
        batch(shop.path(), "undisturbed", &[]).success();
        let left = everything(&done);
        assert!(left.keys().all(|name| !name.to_string_lossy().ends_with(".tmp")), "{:?}", left.keys());
        assert!(tree(&done) == tree(&shop.path().join("undisturbed")), "{signal}");
    }
}

/// The same recipe goes on where the files that were done are kept.
#[test]
fn files_done_before_a_stop_are_not_done_again() {
    let shop = long_shop();
    let mut run = start(shop.path(), Stdio::null(), Stdio::null());
    wait_for("the short files", || journal(shop.path()).lines().count() == 5);
    assert_eq!(stop(&mut run, "-TERM").0, Some(130));
    std::fs::remove_file(shop.path().join(LONG)).unwrap();
    let resumed = batch(shop.path(), "done", &["--resume"]).success();
    assert!(super::stdout(&resumed).contains("4 done before"), "{}", super::stdout(&resumed));
}

/// Whoever reads the messages has stopped reading: the pipe is full, and whatever is written to it waits.
#[test]
fn a_pipe_that_nobody_reads_keeps_nothing_from_ending() {
    for signal in ["-TERM", "-INT"] {
        let shop = long_shop();
        // Each of these fills the pipe a little more.
        (0..600)
            .for_each(|number| write(shop.path(), &format!("programs/bad{number}.cls"), "GOTO/1,2,x.y.z\n"));
        let mut run = start(shop.path(), Stdio::piped(), Stdio::piped());
        wait_for("the short files", || journal(shop.path()).lines().count() >= 5);
        // Files are done by their size: those with faults come now, and their findings fill the pipe.
        std::thread::sleep(Duration::from_millis(1500));
        assert!(run.try_wait().unwrap().is_none());
        let (code, took) = stop(&mut run, signal);
        assert!(took < SOON, "{signal}: {took:?}");
        assert_eq!(code, Some(130), "{signal}");
        let kept = journal(shop.path());
        kept.lines().for_each(|line| drop(serde_json::from_str::<serde_json::Value>(line).unwrap()));
    }
}
