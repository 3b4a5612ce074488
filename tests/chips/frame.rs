//! Layers across other directions than z.

use clsmith::diagnostic::codes;
use clsmith::parse::parse;
use clsmith::program::LengthUnit;
use clsmith::report::layered_chips::{ChipReport, ChipReportOptions, write_stl};
use clsmith::setup::Setup;
use clsmith::simulation_run::layer_run::{LayerDirection, LayerRunOptions};
use clsmith::simulation_run::{Machining, SilentWatcher};
use clsmith::source::Source;
use clsmith::stock::Mesh;
use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use proptest::prelude::*;
use std::f64::consts::PI;
use std::fmt::Write;

/// Runs a program of one end mill (D = 10) over a stock, and returns what is told, or the code of the refusal.
fn chips_across(
    stock: &str,
    more: &str,
    path: &str,
    layer: f64,
    direction: LayerDirection,
) -> Result<ChipReport, String> {
    chips_of(stock, more, path, &LayerRunOptions::new(layer).with_direction(direction))
}

fn chips_of(stock: &str, more: &str, path: &str, options: &LayerRunOptions) -> Result<ChipReport, String> {
    let shop = format!(
        "stock: {stock}\ntools: [ {{ match: {{}}, diameter: 10, flute_length: 30, teeth: 4 }} ]\n{more}"
    );
    let setup = Setup::load(&Source::new("shop.yaml", shop.into_bytes()).unwrap()).unwrap();
    let text = format!("LOAD/TOOL,3\nSPINDL/RPM,5000,CLW\n{path}");
    let program = parse(&Source::new("part.cls", text.into_bytes()).unwrap(), None).program;
    let machining = Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new()).unwrap();
    let keep = ChipReportOptions::default().with_borders(true);
    ChipReport::simulate_layers(&machining, options, keep, &SilentWatcher)
        .map_err(|failure| format!("{failure:?}"))
}

/// A slot of 20 mm, 2 mm deep, from outside the face z = 0 of what stands around (0, 0, -10), turned about the origin.
fn turned_slot(turn: &Rotation3<f64>) -> String {
    let mut path = String::new();
    for (word, x) in [("RAPID", -30.0), ("FEDRAT/MMPM,1000.", 0.0)] {
        let tip = turn * Vector3::new(x, 3.0, -2.0);
        let axis = turn * Vector3::z();
        let numbers: Vec<String> = tip.iter().chain(axis.iter()).map(|at| format!("{at:.9}")).collect();
        let _ = writeln!(path, "{word}\nGOTO/{}", numbers.join(","));
    }
    path
}

fn turned_bar(turn: &Rotation3<f64>) -> String {
    let end = |z: f64| {
        let at = turn * Vector3::new(0.0, 0.0, z);
        format!("[{:.12}, {:.12}, {:.12}]", at.x, at.y, at.z)
    };
    format!("{{ cylinder: {{ diameter: 40, from: {}, to: {} }} }}", end(-10.0), end(0.0))
}

#[test]
fn a_level_tool_mills_a_slot_in_the_side_of_a_block() {
    let block = "{ block: { from: [0, -20, -10], to: [60, 20, 0] } }";
    // The tool stands along x, 2 mm deep in the side x = 60, and goes 20 mm up to the middle of the block.
    let path = "RAPID\nGOTO/58,-30,-5,1,0,0\nFEDRAT/MMPM,1000.\nGOTO/58,0,-5,1,0,0\n";
    let level = chips_across(block, "", path, 0.5, LayerDirection::WorkpieceZ).unwrap();
    assert_eq!((level.rows.len(), level.skipped.len()), (0, 1), "the cut is refused");
    let refusal = level.findings.iter().find(|found| found.code == codes::CHIP_REFUSED).unwrap();
    assert!(refusal.help.as_deref().unwrap().contains("--layers-across tool"), "{refusal:?}");
    for direction in [LayerDirection::ToolAxis, LayerDirection::Vector([3.0, 0.0, 0.0])] {
        let report = chips_across(block, "", path, 0.5, direction).unwrap();
        assert!(report.skipped.is_empty() && report.findings.is_empty(), "{:?}", report.findings);
        // The mill is as wide as the block is high: a slot 20 mm long with half a circle at its end.
        let exact = 2.0 * (10.0 * 20.0 + PI * 25.0 / 2.0);
        let cut = report.rows.last().unwrap();
        assert!((cut.volume_mm3 - exact).abs() < 0.1, "{} of {exact}", cut.volume_mm3);
        let feed_per_tooth = 1000.0 / 5000.0 / 4.0;
        assert!((cut.chip_thickness_mm.unwrap() - feed_per_tooth).abs() < 1e-3 * feed_per_tooth);
        // Four layers from x = 58 to x = 60, told by the heights of their middles.
        let heights: Vec<f64> = cut.layers.iter().map(|layer| layer.z_mm).collect();
        assert_eq!(heights, [58.25, 58.75, 59.25, 59.75]);
        // The solid stands where the chip was cut.
        let mut bytes = Vec::new();
        write_stl(&report, &mut bytes).unwrap();
        let (low, high) = Mesh::from_stl(&bytes).unwrap().bounds();
        for (found, right) in low.into_iter().chain(high).zip([58.0, -20.0, -10.0, 60.0, 5.0, 0.0]) {
            assert!((found - right).abs() < 1e-3, "{low:?} {high:?}");
        }
    }
}

#[test]
fn the_frame_of_the_program_and_the_table_of_the_machine_tell_the_direction() {
    let block = "{ block: { from: [0, -20, -10], to: [60, 20, 0] } }";
    // The second operation is programmed in a frame whose z is the workpiece's x: its x is y, and its y is z.
    let path = "MSYS/0,0,0,1,0,0,0,1,0\nRAPID\nGOTO/-50,0,50\nGOTO/-40,0,50\nMSYS/0,0,0,0,1,0,0,0,1\nRAPID\nGOTO/-30,-5,58\n\
                FEDRAT/MMPM,1000.\nGOTO/0,-5,58\n";
    let framed = |from: usize| {
        let options = LayerRunOptions::new(0.5).with_lines(from..=100);
        chips_of(block, "", path, &options.with_direction(LayerDirection::ProgramFrame)).unwrap()
    };
    assert!(framed(1).frame.is_workpiece(), "the first motion stands in the workpiece frame");
    let second = framed(9);
    assert_eq!(second.frame.axes(), [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]);
    let exact = 2.0 * (10.0 * 20.0 + PI * 25.0 / 2.0);
    assert!((second.totals.chips_mm3 - exact).abs() < 0.1, "{}", second.totals.chips_mm3);
    let axis = |name: &str, kind: &str, direction: &str| {
        let limits = "max_speed: 9000, rapid: 9000, acceleration: 3000";
        format!("{{ name: {name}, kind: {kind}, direction: {direction}, {limits} }}")
    };
    let table = axis("A", "rotary", "[1, 0, 0], point: [0, 0, 0]");
    let head = [("X", "[1, 0, 0]"), ("Y", "[0, 1, 0]"), ("Z", "[0, 0, 1]")]
        .map(|(name, direction)| axis(name, "linear", direction));
    let turning = format!("machine: {{ table: [ {table} ], head: [ {} ] }}\n", head.join(", "));
    let side = "RAPID\nGOTO/58,-30,-5,1,0,0\nFEDRAT/MMPM,1000.\nGOTO/58,0,-5,1,0,0\n";
    let report = chips_across(block, &turning, side, 0.5, LayerDirection::MachineTable);
    let [_, _, z] = report.unwrap().frame.axes();
    assert_eq!(z, [1.0, 0.0, 0.0]);
    let refused = chips_across(block, "", side, 0.5, LayerDirection::MachineTable).unwrap_err();
    assert!(refused.contains(&codes::LAYERS.to_string()) && refused.contains("axes"), "{refused}");
}

#[test]
fn a_direction_along_z_changes_nothing() {
    let stock = "{ block: { from: [-20, -20, -10], to: [20, 20, 0] } }";
    let path = turned_slot(&Rotation3::identity());
    let [one, other] = [LayerDirection::WorkpieceZ, LayerDirection::Vector([0.0, 0.0, 2.5])]
        .map(|direction| chips_across(stock, "", &path, 0.5, direction).unwrap());
    assert!(other.frame.is_workpiece());
    assert_eq!(format!("{:?}", one.rows), format!("{:?}", other.rows));
}

#[test]
fn stock_that_cannot_be_turned_is_told() {
    let across = LayerDirection::Vector([1.0, 2.0, 2.0]);
    let path = "RAPID\nGOTO/-50,0,50\nFEDRAT/MMPM,1000.\nGOTO/0,0,-2\n";
    let grown = "{ bodies: [ { block: { from: [0, -20, -10], to: [60, 20, 0] } } ], allowance: 1 }";
    let block = chips_across(grown, "", path, 1.0, across);
    // A grown block is a block.
    let volume = block.unwrap().totals.stock_mm3;
    assert!((volume - 62.0 * 42.0 * 12.0).abs() < 0.02 * volume, "{volume}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// Path, stock and layers that are turned together make the same chips.
    #[test]
    fn turning_everything_changes_no_chip(euler in prop::array::uniform3(-3.0..3.0_f64)) {
        let straight = Rotation3::identity();
        let turn = UnitQuaternion::from_euler_angles(euler[0], euler[1], euler[2]).to_rotation_matrix();
        let run = |turn: &Rotation3<f64>| {
            chips_across(&turned_bar(turn), "", &turned_slot(turn), 0.5, LayerDirection::ToolAxis).unwrap()
        };
        let (right, found) = (run(&straight), run(&turn));
        prop_assert!(found.findings.is_empty(), "{:?}", found.findings);
        let (right, found) = (right.rows.last().unwrap(), found.rows.last().unwrap());
        prop_assert_eq!(right.layers.len(), found.layers.len());
        prop_assert!((right.volume_mm3 - found.volume_mm3).abs() < 2e-4 * right.volume_mm3);
        let thickness = |row: &clsmith::report::layered_chips::ChipRow| row.chip_thickness_mm.unwrap();
        prop_assert!((thickness(right) - thickness(found)).abs() < 1e-3 * thickness(right));
    }
}
