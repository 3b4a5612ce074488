//! The forms of a simulation, and what is left against a target.

use super::{SHOP, SLOT, simulate};
use crate::support::{rounded_snapshots, snapshots};
use clsmith::program::LengthUnit;
use clsmith::report::simulation::time_plot::{PlottedMotion, ProgramTimeSeries, draw_time_series};
use clsmith::report::simulation::{SimulationReport, to_json, to_text, write_csv};
use clsmith::simulation_run::Machining;
use clsmith::stock::stl_export;

fn slot() -> SimulationReport {
    simulate(SLOT, SHOP, LengthUnit::Mm).unwrap()
}

/// Without forces, which are the model's matter and have tests of their own.
fn without_forces() -> SimulationReport {
    simulate(SLOT, &SHOP.replace("material: { k_tc: 2000, name: C45 }\n", ""), LengthUnit::Mm).unwrap()
}

fn csv(found: &SimulationReport) -> String {
    let mut out = Vec::new();
    write_csv(found, &mut out).unwrap();
    String::from_utf8(out).unwrap()
}

#[test]
fn a_simulation_as_text() {
    snapshots("report").bind(|| insta::assert_snapshot!("simulation", to_text(&without_forces())));
}

#[test]
fn a_simulation_as_csv_and_json() {
    let found = without_forces();
    rounded_snapshots("report").bind(|| {
        insta::assert_snapshot!("simulation_csv", csv(&found));
        insta::assert_snapshot!("simulation_json", to_json(&found, &[]));
    });
}

#[test]
fn the_json_names_the_columns_of_the_csv() {
    let found = slot();
    let json: serde_json::Value = serde_json::from_str(&to_json(&found, &[])).unwrap();
    let csv = csv(&found);
    let columns: std::collections::BTreeSet<&str> = csv.lines().next().unwrap().split(',').collect();
    let motions = json["motions"].as_array().unwrap();
    let keys: std::collections::BTreeSet<&str> =
        motions[0].as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!((columns, motions.len()), (keys, csv.lines().count() - 1));
    assert_eq!(json["version"], 1);
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let found = slot();
            let mut stl = Vec::new();
            stl_export::write_stl(&found.left, &mut stl).unwrap();
            (csv(&found), to_json(&found, &[]), stl, draw_time_series(&[found.to_time_series("a")]).unwrap())
        })
    };
    let one = run(1);
    for threads in [2, 3, 7] {
        assert!(run(threads) == one, "{threads} threads");
    }
}

#[test]
fn what_is_left_is_compared_with_a_target() {
    let mut found = slot();
    let mut stl = Vec::new();
    stl_export::write_stl(&found.left, &mut stl).unwrap();
    let target = Machining::read_target_part(&stl, LengthUnit::Mm).unwrap();
    found.compare_with_target(&target, "part.stl", None);
    let compared = found.target.clone().unwrap();
    assert_eq!((compared.gouge.columns, compared.excess.columns), (0, 0));
    assert!(found.findings.is_empty());

    let mut deep = simulate(&SLOT.replace(",-2.0000", ",-3.0000"), SHOP, LengthUnit::Mm).unwrap();
    deep.compare_with_target(&target, "part.stl", Some(0.3));
    let compared = deep.target.clone().unwrap();
    let thickest = compared.gouge.thickest.unwrap();
    assert!(
        (thickest.thickness_mm - 1.0).abs() < 1e-4 && (thickest.at_mm[2] + 3.0).abs() < 1e-4,
        "{thickest:?}"
    );
    // Beside walls a column is near enough to what is left.
    let wanted = 60.0 * (15.0 - 2.0 * 0.25);
    assert!((compared.gouge.volume_mm3 - wanted).abs() < 1e-2, "{}", compared.gouge.volume_mm3);
    assert_eq!(deep.findings[0].code.id(), "CL0518");
    deep.compare_with_target(&target, "part.stl", Some(1.1));
    assert_eq!(deep.target.unwrap().gouge.columns, 0);

    let mut shallow = simulate(&SLOT.replace(",-2.0000", ",-1.0000"), SHOP, LengthUnit::Mm).unwrap();
    shallow.compare_with_target(&target, "part.stl", None);
    let compared = shallow.target.clone().unwrap();
    assert!((compared.excess.thickest.unwrap().thickness_mm - 1.0).abs() < 1e-4);
    assert!(shallow.findings.is_empty(), "excess is only reported");
}

#[test]
fn a_wall_that_is_a_little_off_is_no_gouge_of_its_height() {
    // The slot as the target, and a program whose last motion is a tenth too far to the side: less than a cell.
    let mut stl = Vec::new();
    stl_export::write_stl(&slot().left, &mut stl).unwrap();
    let target = Machining::read_target_part(&stl, LengthUnit::Mm).unwrap();
    let aside = |by: &str| {
        let mut found = simulate(&SLOT.replace(",15.0000,-2", by), SHOP, LengthUnit::Mm).unwrap();
        found.compare_with_target(&target, "part.stl", None);
        found.target.unwrap().gouge.columns
    };
    assert_eq!(aside(",14.8000,-2"), 0);
    assert!(aside(",14.2000,-2") > 0);
}

#[test]
fn programs_are_drawn_over_each_other() {
    let found = slot();
    let drawn =
        draw_time_series(&[found.to_time_series("before <1>"), found.to_time_series("after")]).unwrap();
    assert!(drawn.starts_with("<svg width=\"1200\" height=\"800\"") && drawn.trim_end().ends_with("</svg>"));
    for text in ["thickest chip, mm", "feed, mm/min", "time, s", "before &lt;1&gt;", "after", "#4A5260"] {
        assert!(drawn.contains(text), "{text}");
    }
    // Nothing to draw is no error, and very long programs stay small.
    assert!(draw_time_series(&[]).is_ok() && draw_time_series(&[ProgramTimeSeries::default()]).is_ok());
    let moment = |index: u32| PlottedMotion {
        from_s: f64::from(index),
        to_s: f64::from(index + 1),
        chip_thickness_mm: Some(0.01 * f64::from(index % 7)),
        feed_mm_min: (!index.is_multiple_of(1000)).then_some(500.0),
    };
    let size_of = |count: u32| {
        let long = ProgramTimeSeries {
            name: "long".to_owned(),
            moments: (0..count).map(moment).collect(),
            ..ProgramTimeSeries::default()
        };
        draw_time_series(&[long]).unwrap().len()
    };
    // A band of least and largest values for each pixel, however many moments there are.
    let sizes = [200_000, 400_000].map(size_of);
    assert!(sizes[1] * 10 < sizes[0] * 11 && sizes[0] < 200_000, "{sizes:?}");
}
