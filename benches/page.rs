//! The page of a report of a million motions: `cargo bench --bench page`.
//!
//! Prints seconds and peak memory of `apply --report`, the size of the page, and how long a headless Chromium takes to draw it and to go
//! to another place, by the clock: where little changes, where every line does, and with both simulations. Ends with a failure where a page
//! takes more than 60 MB or is not open within five seconds. `CLSMITH_BENCH_POINTS` sets the number of motions (1,000,000).

// A benchmark that has no browser or cannot make its program has nothing to measure.
#![allow(clippy::expect_used, clippy::unwrap_used, clippy::panic, clippy::indexing_slicing)]

#[path = "../tests/browser/chromium.rs"]
#[allow(dead_code)] // what only the tests of the page use
mod chromium;
mod support;

use chromium::{Browser, DRAWN};
use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;
use support::wait_with_peak;

/// Every line of the program is changed: it is in the page twice.
const MOVED: &str = "version: 1\nsteps:\n  - move_origin: { translate: [1, 2, 3] }\n";
const SLOWER: &str = "version: 1\nsteps:\n  - scale_feed: { factor: 0.8 }\n";

const SHOP: &str = "machine: { rapid_feed: 20000 }
stock: { block: { from: [-10, -10, -30], to: [210, 210, 0] } }
tools: [ { match: { name: \"T*\" }, teeth: 4 } ]
";

fn main() {
    let points: usize =
        std::env::var("CLSMITH_BENCH_POINTS").ok().and_then(|text| text.parse().ok()).unwrap_or(1_000_000);
    let chromium = find_chromium().expect("a Chromium (apt-get install chromium)");
    let folder = tempfile::tempdir().expect("a folder");
    write_program(&folder.path().join("part.cls"), points).expect("the program");
    fs::write(folder.path().join("shop.yaml"), SHOP).expect("the setup");
    for (name, recipe, more) in
        [("moved", MOVED, &[][..]), ("slower", SLOWER, &[]), ("simulated", SLOWER, &["--setup", "shop.yaml"])]
    {
        fs::write(folder.path().join("recipe.yaml"), recipe).expect("a recipe");
        let began = Instant::now();
        let run = Command::new(env!("CARGO_BIN_EXE_clsmith"))
            .current_dir(folder.path())
            .args(["apply", "recipe.yaml", "part.cls", "-o", "out.cls", "--report", "out.html", "-q"])
            .args(more)
            .spawn()
            .expect("the command");
        let (status, most) = wait_with_peak(run);
        assert!(status.success(), "{status}");
        let seconds = began.elapsed().as_secs_f64();
        let page = folder.path().join("out.html");
        let size = fs::metadata(&page).expect("the page").len();
        let [opened, drawn, moved] = draw(&chromium, &page, points);
        println!(
            "{name}: written in {seconds:.1} s, peak memory {:.0} MB, page {:.1} MB, open after {opened:.1} s, \
             its 3D view drawn after {drawn:.1} s, another place after {moved:.2} s",
            most as f64 / 1e6,
            size as f64 / 1e6
        );
        assert!(size < 60_000_000 && opened < 5.0, "{size} bytes, {opened} s");
    }
}

fn find_chromium() -> Option<PathBuf> {
    let folders = std::env::var_os("PATH")?;
    let all = std::env::split_paths(&folders)
        .flat_map(|folder| chromium::NAMES.iter().map(move |name| folder.join(name)));
    all.into_iter().find(|path| path.is_file())
}

/// Seconds until a reader can work with the page, until its 3D view is drawn, and until it shows another place.
fn draw(chromium: &Path, page: &Path, points: usize) -> [f64; 3] {
    let mut browser = Browser::start(chromium);
    let began = Instant::now();
    browser.open(page);
    browser.wait("window.clsmith !== undefined");
    let opened = began.elapsed().as_secs_f64();
    assert!(browser.number(DRAWN) > 1000.0);
    let drawn = began.elapsed().as_secs_f64();
    assert!(browser.number("clsmith.shown.count") >= 0.99 * points as f64);
    let began = Instant::now();
    browser.value("clsmith.goTo(Math.floor(clsmith.shown.count / 2))");
    assert!(browser.number(DRAWN) > 1000.0);
    let moved = began.elapsed().as_secs_f64();
    assert_eq!(browser.complaints(), [] as [String; 0]);
    [opened, drawn, moved]
}

/// Ten operations of passes of a thousand points over waves.
fn write_program(path: &Path, points: usize) -> std::io::Result<()> {
    let mut out = BufWriter::new(File::create(path)?);
    for operation in 0..10 {
        write!(
            out,
            "TOOL PATH/FINISH_{operation},TOOL,T{0}\nTLDATA/MILL,10.0000,0.0000,75.0000,0.0000,0.0000\n\
             LOAD/TOOL,{0}\nSPINDL/RPM,5000,CLW\nRAPID\nGOTO/0.0000,0.0000,50.0000,0.0000000,0.0000000,1.0000000\n",
            operation % 3 + 1
        )?;
        for pass in 0..points / 10_000 {
            writeln!(out, "FEDRAT/MMPM,{}.0000", 800 + 100 * (pass % 8))?;
            for index in 0..1000_i32 {
                let x = 0.2 * f64::from(if pass % 2 == 0 { index } else { 999 - index });
                let y = 2.0 * pass as f64;
                let z = 1.5 * (x / 9.0).sin() * (y / 13.0).cos() - 2.0 - 0.5 * f64::from(operation);
                writeln!(out, "GOTO/{x:.4},{y:.4},{z:.4}")?;
            }
        }
        out.write_all(b"RAPID\nGOTO/0.0000,0.0000,50.0000\nEND-OF-PATH\n")?;
    }
    out.flush()
}
