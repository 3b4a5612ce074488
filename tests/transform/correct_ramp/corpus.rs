//! Real files, which the corpus has.

use super::correct_program;
use crate::support;
use clsmith::transform::correct_ramp::RampOutcome;

const TOOL: &str = "tool: { diameter: 25, insert_radius: 6, insert_height: 1 }";

#[test]
fn drilling_lathe_and_wire_files_have_no_ramp() {
    for name in [
        "deep_drill.clsf",
        "4_SVERL_63_N2.cls",
        "DEMO1.aptsource",
        "DEMO3.aptsource",
        "PrepaFlans_Pointage.aptsource",
        "wire-edm-excerpt.cls",
        "Guincho_Lbar.apt",
        "nurbs.clsf",
    ] {
        let Some(path) = support::require_corpus_file(name) else { return };
        let program = clsmith::parse::parse(&support::source(&path), None).program;
        let done = correct_program(TOOL, "", program).unwrap();
        assert!(done.ramps.is_empty(), "{name}: {:?}", done.ramps.first());
    }
}

#[test]
fn every_file_runs_twice_to_the_same_bytes() {
    let Some(corpus) = support::require_corpus() else { return };
    for path in corpus {
        // 35,000 points of five-axis finishing have no ramp, and take a while.
        if path.ends_with("finition2.ncl") {
            continue;
        }
        let parse = |bytes: Vec<u8>| {
            let source = clsmith::source::Source::new("part", bytes).unwrap();
            clsmith::parse::parse(&source, None).program
        };
        let keep = format!("{TOOL}, if_impossible: keep");
        let once = correct_program(&keep, "", parse(std::fs::read(&path).unwrap())).unwrap();
        let corrected = once.ramps.iter().filter(|ramp| ramp.outcome == RampOutcome::Corrected).count();
        let original = String::from_utf8_lossy(&std::fs::read(&path).unwrap()).into_owned();
        assert_eq!(once.text == original, corrected == 0, "{}", path.display());
        if once.text.contains('\u{fffd}') {
            continue;
        }
        let twice = correct_program(&keep, "", parse(once.text.clone().into_bytes())).unwrap();
        assert!(twice.text == once.text, "{}", path.display());
        assert!(
            twice.outcomes().iter().all(|outcome| *outcome != RampOutcome::Corrected),
            "{}",
            path.display()
        );
    }
}
