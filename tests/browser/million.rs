//! Load: the page of a program of a million motions.

use super::DRAWN;
use super::chromium::{self, Browser};
use crate::support::wait_with_peak;
use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// Ten operations of a hundred passes of a thousand points over waves.
fn program(path: &Path) {
    let mut out = BufWriter::new(File::create(path).unwrap());
    for operation in 0..10 {
        write!(
            out,
            "TOOL PATH/FINISH_{operation},TOOL,T{0}\nTLDATA/MILL,10.0000,0.0000,75.0000,0.0000,0.0000\n\
             LOAD/TOOL,{0}\nSPINDL/RPM,5000,CLW\nRAPID\nGOTO/0.0000,0.0000,50.0000,0.0000000,0.0000000,1.0000000\n",
            operation % 3 + 1
        )
        .unwrap();
        for pass in 0..100_i32 {
            writeln!(out, "FEDRAT/MMPM,{}.0000", 800 + 100 * (pass % 8)).unwrap();
            for index in 0..1000_i32 {
                let x = 0.2 * f64::from(if pass % 2 == 0 { index } else { 999 - index });
                let y = 2.0 * f64::from(pass);
                let z = 1.5 * (x / 9.0).sin() * (y / 13.0).cos() - 2.0 - 0.5 * f64::from(operation);
                writeln!(out, "GOTO/{x:.4},{y:.4},{z:.4}").unwrap();
            }
        }
        out.write_all(b"RAPID\nGOTO/0.0000,0.0000,50.0000\nEND-OF-PATH\n").unwrap();
    }
    out.flush().unwrap();
}

/// Every line of the program is changed: it is in the page twice.
const MOVED: &str = "version: 1\nsteps:\n  - move_origin: { translate: [1, 2, 3] }\n";
const SLOWER: &str = "version: 1\nsteps:\n  - scale_feed: { factor: 0.8 }\n";

const SHOP: &str = "machine: { rapid_feed: 20000 }
stock: { block: { from: [-10, -10, -30], to: [210, 210, 0] } }
tools: [ { match: { name: \"T*\" }, teeth: 4 } ]
";

#[test]
#[ignore = "soak: a million motions in a page; minutes, and release"]
fn soak_a_million_motions() {
    let Some(chromium) = chromium::find() else { return };
    let folder = tempfile::tempdir().unwrap();
    program(&folder.path().join("part.cls"));
    fs::write(folder.path().join("shop.yaml"), SHOP).unwrap();
    for (name, recipe, more) in
        [("moved", MOVED, &[][..]), ("slower", SLOWER, &[]), ("simulated", SLOWER, &["--setup", "shop.yaml"])]
    {
        fs::write(folder.path().join("recipe.yaml"), recipe).unwrap();
        let began = Instant::now();
        let run = Command::new(env!("CARGO_BIN_EXE_clsmith"))
            .current_dir(folder.path())
            .args(["apply", "recipe.yaml", "part.cls", "-o", "out.cls", "--report", "out.html", "-q"])
            .args(more)
            .spawn()
            .unwrap();
        let (status, most) = wait_with_peak(run);
        assert!(status.success());
        let seconds = began.elapsed().as_secs_f64();
        let page = folder.path().join("out.html");
        let size = fs::metadata(&page).unwrap().len();

        let mut browser = Browser::start(&chromium);
        let began = Instant::now();
        browser.open(&page);
        browser.wait("window.clsmith !== undefined");
        assert!(browser.number(DRAWN) > 1000.0);
        let drawn = began.elapsed().as_secs_f64();
        assert!(browser.number("clsmith.shown.count") >= 1e6);
        let began = Instant::now();
        browser.value("clsmith.goTo(500000)");
        assert!(browser.number(DRAWN) > 1000.0);
        let moved = began.elapsed().as_secs_f64();
        assert_eq!(browser.complaints(), [] as [String; 0]);
        println!(
            "{name}: written in {seconds:.1} s, peak memory {:.0} MB, page {:.1} MB, drawn after {drawn:.1} s, \
             another place after {moved:.2} s",
            most as f64 / 1e6,
            size as f64 / 1e6
        );
        assert!(size < 60_000_000 && drawn < 30.0, "{size} bytes, {drawn} s");
    }
}
