//! Whole programs: the same five ramps in three dialects.

use super::{Done, FACE_MILL, correct};
use crate::support;
use clsmith::job::{CorrectionJob, is_program_changed};
use clsmith::report::{finding_policy::FindingPolicy, unified_diff};
use clsmith::setup::Setup;
use clsmith::source::Source;
use clsmith::transform::Recipe;
use clsmith::transform::correct_ramp::{LengtheningMethod, RampOutcome};

const FILES: [&str; 3] = ["nx/web-ramps.cls", "catia/web-ramps.aptsource", "creo/web-ramps.ncl"];

fn text(file: &str) -> String {
    let path = format!("{}/tests/fixtures/{file}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).unwrap()
}

fn web(file: &str, more: &str) -> Done {
    correct(&format!("{FACE_MILL}, {more}"), text(file)).unwrap()
}

#[test]
fn each_ramp_is_corrected_as_it_needs() {
    for file in FILES {
        let done = web(file, "depth_of_cut: 2, clearance: 2.5");
        let kinds: Vec<&str> = done.ramps.iter().map(|ramp| ramp.kind).collect();
        assert_eq!(kinds, ["zigzag", "zigzag", "zigzag", "helix", "zigzag"], "{file}");
        use RampOutcome::{Corrected, Fits};
        assert_eq!(done.outcomes(), [Corrected, Corrected, Corrected, Corrected, Fits], "{file}");
        assert_eq!(done.codes(), ["CL0320"; 4], "{file}");
        let [short, steep, lower, helix, _] = &done.ramps[..] else { panic!() };
        assert_eq!((short.lengthened, short.compression, short.passes), (LengtheningMethod::Circle, 1.0, 1));
        let after = short.after.unwrap();
        assert!(after.legs == 4 && (after.shortest_leg_mm - 38.0).abs() < 0.01, "{after:?}");
        // 4.5 mm above the floor instead of 20, of 100 mm of path: nu = 0.225.
        assert_eq!((steep.lengthened, steep.passes), (LengtheningMethod::No, 1));
        assert!((steep.compression - 0.225).abs() < 1e-6, "{}", steep.compression);
        assert!((steep.after.unwrap().steepest_degrees - (4.5f64 / 100.0).atan().to_degrees()).abs() < 1e-3);
        assert!((lower.compression - 4.5 / 7.0).abs() < 1e-6);
        assert_eq!(helix.lengthened, LengtheningMethod::WidenedHelix);
        assert!((helix.after.unwrap().shortest_leg_mm - 38.0).abs() < 0.01);
    }
}

#[test]
fn without_a_depth_of_cut_layers_fill_the_whole_height() {
    for file in FILES {
        let done = web(file, "region: milled");
        let [_, steep, open, ..] = &done.ramps[..] else { panic!() };
        // A closed ramp of 20 mm over 100: tan 0.2 against 5/38, so once more around.
        assert_eq!((steep.compression, steep.passes), (1.0, 2), "{file}");
        // An open one of 7 mm over 50: to, fro and to.
        assert_eq!((open.compression, open.passes), (1.0, 3), "{file}");
        assert!((open.after.unwrap().height_mm - 7.0).abs() < 1e-3);
    }
}

#[test]
fn a_second_run_changes_nothing() {
    for file in FILES {
        for more in ["depth_of_cut: 2", "region: hull", "region: none"] {
            let once = web(file, more);
            let twice = correct(&format!("{FACE_MILL}, {more}"), &once.text).unwrap();
            assert!(twice.text == once.text, "{file}, {more}");
            assert_eq!(twice.outcomes(), [RampOutcome::Fits; 5], "{file}, {more}");
        }
    }
}

#[test]
fn everything_outside_the_ramps_stays_byte_for_byte() {
    for file in FILES {
        let (before, after) = (text(file), web(file, "depth_of_cut: 2").text);
        let (mut old, new) = (before.lines(), after.lines());
        // Feeds, marks, comments and the end points are still there, in order.
        let kept = |line: &&str| !line.starts_with("GOTO");
        let (outside, written): (Vec<&str>, Vec<&str>) =
            (before.lines().filter(kept).collect(), new.filter(kept).collect());
        assert_eq!(outside, written, "{file}");
        for end in ["74.0000,60.0000,-2.0000", "-4.0000", "-10.5000"] {
            let in_both = before.contains(end) == after.contains(end);
            assert!(in_both, "{file}: {end}");
        }
        assert!(old.next().is_some_and(|first| after.starts_with(first)));
    }
}

#[test]
fn the_feed_of_the_ramp_governs_its_new_points() {
    let done = web(FILES[0], "region: milled");
    let program = support::program(&done.text);
    let feeds: Vec<(f64, bool)> = program
        .motions()
        .filter(|motion| !motion.rapid && motion.class_is_stated)
        .map(|motion| (motion.feed.unwrap().value, motion.class == clsmith::program::MotionClass::Engage))
        .collect();
    assert!(feeds.iter().all(|(feed, engages)| (*feed == 300.0) == *engages || !engages));
    assert!(feeds.iter().filter(|(_, engages)| *engages).count() > 60);
}

#[test]
fn what_a_person_reads() {
    for file in FILES {
        let recipe = format!(
            "version: 1\nunits: mm\nsteps:\n  - correct_ramp: {{ {FACE_MILL}, depth_of_cut: 2, where: {{ operations: [\"*SHORT*\", \"*Short*\", \"61\", \"*HELIX\", \"*Helix*\", \"103\"] }} }}\n"
        );
        let recipe = Source::new("recipe.yaml", recipe.into_bytes()).unwrap();
        let recipe = Recipe::load(&recipe).unwrap();
        let source = Source::new(file, text(file).into_bytes()).unwrap();
        let policy = FindingPolicy::default();
        let setup = recipe.merge_setups(Setup::default(), Setup::default());
        let watch = &clsmith::simulation_run::SilentWatcher;
        let done =
            CorrectionJob::new(&recipe, &setup, &policy).with_watcher(watch).correct_source(&source).unwrap();
        let program = done.program;
        assert!(is_program_changed(&program));
        let mut out = Vec::new();
        unified_diff::write_unified_diff(&mut out, &program, &unified_diff::UnifiedDiffOptions::default())
            .unwrap();
        let mut shown = String::from_utf8_lossy(&out).into_owned();
        for report in &done.reports {
            shown.push_str(&report.to_text(Default::default()));
        }
        for found in &done.findings {
            shown.push_str(&format!(
                "\n{}: {}\n  {}\n",
                found.code,
                found.message,
                found.help.as_deref().unwrap_or("")
            ));
        }
        let name = file.replace(['/', '.'], "-");
        support::rounded_snapshots("correct_ramp").bind(|| insta::assert_snapshot!(name, shown));
    }
}
