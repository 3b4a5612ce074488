//! Reports of chips whose numbers are known in closed form.

use super::simulation::{SHOP, SLOT, close, setup};
use crate::support::{program, rounded_snapshots, snapshots};
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::program::LengthUnit;
use clsmith::report::layered_chips::{
    ChipReport, ChipReportOptions, ChipRow, draw_diagrams, draw_layers, to_text, write_csv, write_json,
    write_stl,
};
use clsmith::simulation_run::layer_run::LayerRunOptions;
use clsmith::simulation_run::{Machining, SilentWatcher};
use clsmith::stock::Mesh;
use std::f64::consts::PI;

fn options(layer: f64) -> LayerRunOptions {
    LayerRunOptions::new(layer)
}

fn report(
    text: &str,
    shop: &str,
    options: &LayerRunOptions,
    keep: ChipReportOptions,
) -> Result<ChipReport, Vec<Diagnostic>> {
    let (program, setup) = (program(text), setup(shop));
    let machining =
        Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new()).map_err(Failure::into_findings)?;
    ChipReport::simulate_layers(&machining, options, keep, &SilentWatcher).map_err(Failure::into_findings)
}

fn slot(keep: ChipReportOptions) -> ChipReport {
    let found = report(SLOT, SHOP, &options(1.0), keep).unwrap();
    assert!(found.findings.is_empty(), "{:?}", found.findings);
    found
}

fn row(report: &ChipReport, line: usize) -> &ChipRow {
    report.rows.iter().find(|row| row.line == line).unwrap()
}

fn csv(report: &ChipReport) -> String {
    let mut out = Vec::new();
    write_csv(report, &mut out).unwrap();
    String::from_utf8(out).unwrap()
}

fn json(report: &ChipReport) -> String {
    let mut out = Vec::new();
    write_json(report, &[], &mut out).unwrap();
    String::from_utf8(out).unwrap()
}

#[test]
fn a_slot_has_its_areas_volumes_engagement_and_chip() {
    let found = slot(ChipReportOptions::default());
    // From outside to x 20: a rectangle and half a disc.
    let first = row(&found, 12);
    assert_eq!(first.layers.iter().map(|layer| layer.z_mm).collect::<Vec<_>>(), [-1.5, -0.5]);
    for layer in &first.layers {
        close(Some(layer.area_mm2), 20.0 * 10.0 + PI * 12.5, 0.05);
        close(layer.chip_thickness_mm, 800.0 / (4000.0 * 4.0), 1e-6);
        close(Some(layer.engaged_deg()), 180.0, 0.1);
        assert!(layer.polygons.is_empty() && layer.count == 1);
    }
    close(Some(row(&found, 13).volume_mm3), 20.0 * 10.0 * 2.0, 1e-3);
    close(Some(found.totals.chips_mm3), 60.0 * 15.0 * 2.0, 1e-3);
    close(Some(found.totals.left_mm3), 24_000.0 - 1800.0, 1e-3);
    // In air: no layers, and a chip that is known to be none.
    let air = row(&found, 15);
    assert_eq!((air.layers.len(), air.chip_thickness_mm), (0, Some(0.0)));
}

#[test]
fn the_json_has_the_shape_that_it_shall_have() {
    let keep = ChipReportOptions::default().with_borders(true);
    // An island stands in the way of nothing: a ring-shaped path around it, cut in one arc.
    let found = report(&ring(), RING_SHOP, &options(1.0), keep).unwrap();
    let json: serde_json::Value = serde_json::from_str(&json(&found)).unwrap();
    assert_eq!(json["version"], 1);
    let motions = json["motions"].as_array().unwrap();
    let ring = motions.iter().rfind(|motion| motion["volume_mm3"].as_f64().unwrap() > 0.0).unwrap();
    let layer = &ring["layers"][0];
    let numbers = |value: &serde_json::Value| value.as_array().unwrap().len();
    assert_eq!((numbers(&layer["pieces"]), numbers(&layer["holes"])), (1, 1));
    assert_eq!(layer["hole_of"], serde_json::json!([0]));
    assert!(layer["pieces"][0].as_array().unwrap().iter().all(|point| numbers(point) == 2));
    // Areas of the borders are the area that is told.
    let area = |border: &serde_json::Value| {
        let points: Vec<[f64; 2]> = serde_json::from_value(border.clone()).unwrap();
        let next = points.iter().cycle().skip(1);
        points.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>() / 2.0
    };
    let told = layer["area_mm2"].as_f64().unwrap();
    close(Some(area(&layer["pieces"][0]) + area(&layer["holes"][0])), told, 0.01 * told);
    let volume: f64 = ring["layers"]
        .as_array()
        .unwrap()
        .iter()
        .map(|layer| layer["area_mm2"].as_f64().unwrap() * layer["thickness_mm"].as_f64().unwrap())
        .sum();
    close(ring["volume_mm3"].as_f64(), volume, 1e-4);
}

/// A full circle of radius 10 around an island, by an end mill of 10 mm.
fn ring() -> String {
    SLOT.replace(
        "GOTO/20.0000,20.0000,-2.0000\n",
        "GOTO/20.0000,20.0000,-2.0000\n\
         CIRCLE/30.0000,20.0000,-2.0000,0.0000000,0.0000000,1.0000000,10.0000,0.0600,0.5000,10.0000,0.0000\n\
         GOTO/20.0000,20.0000,-2.0000\nEND-OF-PATH\n",
    )
    .split_inclusive("END-OF-PATH\n")
    .next()
    .unwrap()
    .to_owned()
}

const RING_SHOP: &str = "stock: { block: { from: [0, 0, -10], to: [60, 40, 0] } }\n\
    tools: [ { match: { number: 3 }, teeth: 4, flute_length: 20 } ]\n";

#[test]
fn chips_as_text_csv_and_json() {
    let found = slot(ChipReportOptions::default().with_borders(true));
    snapshots("report").bind(|| {
        insta::assert_snapshot!("chips", to_text(&found));
        insta::assert_snapshot!("chips_csv", csv(&found));
    });
    // One motion is enough of the borders.
    let options = options(2.0).with_lines(13..=13);
    let found = report(SLOT, SHOP, &options, ChipReportOptions::default().with_borders(true)).unwrap();
    rounded_snapshots("report").bind(|| insta::assert_snapshot!("chips_json", json(&found)));
}

#[test]
fn lines_before_are_cut_and_lines_after_are_not_run() {
    let whole = slot(ChipReportOptions::default());
    let some = options(1.0).with_lines(13..=14);
    let found = report(SLOT, SHOP, &some, ChipReportOptions::default()).unwrap();
    assert_eq!(found.rows.as_slice(), &whole.rows[2..4]);
    assert!(found.totals.left_mm3 > whole.totals.left_mm3 + 100.0);
    let none = options(1.0).with_lines(100..=200);
    let errors = report(SLOT, SHOP, &none, ChipReportOptions::default()).unwrap_err();
    assert_eq!(errors[0].code.id(), "CL0524");
}

#[test]
fn what_is_not_known_is_empty_and_said() {
    let unknown = |text: &str, shop: &str, said: &str| {
        let found = report(text, shop, &options(1.0), ChipReportOptions::default()).unwrap();
        assert!(
            found.assumptions.iter().any(|assumption| assumption.contains(said)),
            "{:?}",
            found.assumptions
        );
        assert_eq!(row(&found, 13).chip_thickness_mm, None);
        assert!(csv(&found).lines().nth(1).unwrap().contains(",1,,"), "{}", csv(&found));
    };
    unknown(SLOT, &SHOP.replace("teeth: 4", "helix: 0"), "the teeth of tool 3");
    unknown(&SLOT.replace("FEDRAT/MMPM,800.0000", "PAINT/SPEED,10"), SHOP, "feed or spindle speed of 4 cuts");
}

#[test]
fn a_turn_about_the_tip_has_no_feed() {
    let text = SLOT.replace(
        "GOTO/40.0000,20.0000,-2.0000\n",
        "GOTO/20.0000,20.0000,-2.0000,0.0000000,0.2588190,0.9659258\nGOTO/20.0000,20.0000,-2.0000,0.0000000,0.0000000,1.0000000\n",
    );
    let found = report(&text, SHOP, &options(1.0), ChipReportOptions::default()).unwrap();
    let turned = row(&found, 13);
    assert!(turned.volume_mm3 > 1.0 && turned.chip_thickness_mm.is_none());
    assert!(
        found.assumptions.iter().any(|said| said.contains("turn about a tip at rest")),
        "{:?}",
        found.assumptions
    );
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let found = slot(ChipReportOptions::default().with_borders(true).with_scenes(2));
            let mut stl = Vec::new();
            write_stl(&found, &mut stl).unwrap();
            (
                json(&found),
                csv(&found),
                stl,
                draw_layers(&found, None).unwrap(),
                draw_diagrams(&found, None).unwrap(),
            )
        })
    };
    let one = run(1);
    assert!(one == run(2) && one == run(3));
}

#[test]
fn the_solid_has_the_chip_s_volume() {
    let found = report(
        SLOT,
        SHOP,
        &options(0.5).with_lines(16..=16),
        ChipReportOptions::default().with_borders(true),
    );
    let found = found.unwrap();
    let mut stl = Vec::new();
    write_stl(&found, &mut stl).unwrap();
    // Layers lie on each other with whole faces, so the signed sum is the volume.
    let mesh = Mesh::from_stl(&stl).unwrap();
    let (low, high) = mesh.bounds();
    assert_eq!((low[2], high[2]), (-2.0, 0.0));
    close(Some(found.rows[0].volume_mm3), 60.0 * 5.0 * 2.0, 1e-3);
}

#[test]
fn pictures_show_moves_and_layers() {
    let found = slot(ChipReportOptions::default().with_scenes(3));
    assert_eq!(found.scenes.iter().map(|scene| scene.line).collect::<Vec<_>>(), [12, 13, 14]);
    let drawn = draw_layers(&found, None).unwrap();
    for title in ["line 12, z -0.5", "line 14, z -1.5", "workpiece after the move"] {
        assert!(drawn.contains(title), "{title}");
    }
    let at = draw_layers(&found, Some(-1.2)).unwrap();
    assert!(at.contains("z -1.5") && !at.contains("z -0.5"));
    let diagrams = draw_diagrams(&found, Some(-1.2)).unwrap();
    assert!(diagrams.contains("line 13, z -1.5") && diagrams.contains("advances"));
    // Nothing is cut at this height.
    let nothing = slot(ChipReportOptions::default().with_scenes(3).with_at_z_mm(-5.0));
    assert!(nothing.scenes.is_empty());
}

#[test]
fn parts_of_a_motion_have_their_chips_and_forces() {
    let material = "{ k_tc: 1800, k_rc: 600, k_ac: 0, k_te: 20, k_re: 30, k_ae: 0 }";
    let shop = SHOP.replace("{ k_tc: 2000, name: C45 }", material);
    let (program, setup) = (program(SLOT), setup(&shop));
    let machining = Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new()).unwrap();
    let asked = options(1.0).with_moments(4);
    let mut found =
        ChipReport::simulate_layers(&machining, &asked, ChipReportOptions::default(), &SilentWatcher)
            .unwrap();
    found.find_moment_forces(&machining, &SilentWatcher).unwrap();

    // The way into the block: parts grow, and together they are the motion's chip.
    let entry = row(&found, 12);
    let volumes: Vec<f64> = entry.moments.iter().map(|moment| moment.volume_mm3).collect();
    close(Some(volumes.iter().sum()), entry.volume_mm3, 1e-2);
    assert!(volumes.len() == 4 && volumes[0] < volumes[3], "{volumes:?}");

    // Full slot, 4 teeth, 2 mm deep, 0.05 mm a tooth: N a / 4 K c + N a / pi K_e.
    let slot = row(&found, 13);
    assert_eq!(slot.moments.len(), 4);
    for (number, moment) in slot.moments.iter().enumerate() {
        let from = 5.0 * number as f64;
        close(Some(moment.along_mm[0]), from, 1e-9);
        close(Some(moment.along_mm[1]), from + 5.0, 1e-9);
        close(Some(moment.volume_mm3), 5.0 * 10.0 * 2.0, 1e-2);
        close(moment.chip_thickness_mm, 0.05, 1e-6);
        let forces = moment.forces.as_ref().unwrap();
        let [ahead, left, _] = forces.tool_mean_n.map(f64::abs);
        close(Some(ahead), 2.0 * 600.0 * 0.05 + 8.0 / PI * 30.0, 0.7);
        close(Some(left), 2.0 * 1800.0 * 0.05 + 8.0 / PI * 20.0, 1.2);
        // Straight teeth meet the edge's force at once, which 120 rotations see to one rotation in thirty a tooth.
        let count = moment.rotations.len() as f64;
        for axis in 0..3 {
            let mean = moment.rotations.iter().map(|rotation| rotation.force_n[axis]).sum::<f64>() / count;
            close(Some(mean), forces.mean_n[axis], 2.5);
        }
    }
    let text = csv(&found);
    let head = text.lines().next().unwrap();
    assert!(head.contains(",arcs_deg,moment,along_from_mm,along_to_mm,fx_mean_n,"), "{head}");
    assert_eq!(text.lines().filter(|line| line.starts_with("13,")).count(), 4 * 2);
    let whole: serde_json::Value = serde_json::from_str(&json(&found)).unwrap();
    let motions = whole["motions"].as_array().unwrap();
    let slot = motions.iter().find(|motion| motion["line"] == 13).unwrap();
    assert_eq!(slot["moments"][2]["moment"], 3);
    assert_eq!(slot["moments"][2]["rotations"].as_array().unwrap().len(), 120);
    assert_eq!(slot["moments"][2]["layers"].as_array().unwrap().len(), 2);
}

#[test]
fn parts_of_an_arc_are_the_arc() {
    let text = "TLDATA/MILL,10,0,50,0,0\nLOAD/TOOL,3\nSPINDL/RPM,4000,CLW\nRAPID\nGOTO/-10,0,-2\nFEDRAT/MMPM,800.\nGOTO/20,0,-2\n\
                CIRCLE/20,10,-2,0,0,1,10\nGOTO/30,10,-2\nGOTO/30,30,-2\n";
    let keep = ChipReportOptions::default();
    let whole = report(text, SHOP, &options(1.0), keep).unwrap();
    let parts = report(text, SHOP, &options(1.0).with_moments(7), keep).unwrap();
    for (one, other) in whole.rows.iter().zip(&parts.rows) {
        let sum: f64 = other.moments.iter().map(|moment| moment.volume_mm3).sum();
        close(Some(sum), one.volume_mm3, 0.05);
        assert!(other.moments.is_empty() || other.moments.len() == 7);
    }
    close(Some(parts.totals.left_mm3), whole.totals.left_mm3, 0.05);
}
