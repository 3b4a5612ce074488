//! Forces in program axes and in axes of the tool: with tilted tools, for programs that lie otherwise, and in inch.

use crate::support;
use clsmith::program::LengthUnit;
use clsmith::report::simulation::SimulationReport;
use clsmith::setup::Setup;
use clsmith::simulation_run::{Machining, MotionForces, SilentWatcher, SimulationRunOptions};
use clsmith::source::Source;

/// A cut from a point to another one with a fixed axis, in a block.
struct Cut {
    points: [[f64; 3]; 2],
    axis: [f64; 3],
    block: [[f64; 3]; 2],
    unit: LengthUnit,
}

/// Returns the forces of a cut; all numbers are in mm, and the program is written in the cut's unit.
fn forces(cut: &Cut) -> MotionForces {
    let size = cut.unit.mm_per_unit();
    let goto = |point: [f64; 3]| {
        let [x, y, z] = point.map(|part| part / size);
        let [i, j, k] = cut.axis;
        format!("GOTO/{x:.7},{y:.7},{z:.7},{i:.9},{j:.9},{k:.9}\n")
    };
    let (feed, diameter, length) = (600.0 / size, 10.0 / size, 75.0 / size);
    let (mode, spelled) = match cut.unit {
        LengthUnit::Mm => ("MMPM", "mm"),
        LengthUnit::Inch => ("IPM", "inch"),
    };
    let text = format!(
        "TOOL PATH/A,TOOL,T\nTLDATA/MILL,{diameter:.7},0.0000,{length:.7},0.0000,0.0000\nLOAD/TOOL,1\n\
         SPINDL/RPM,3000,CLW\nRAPID\n{}FEDRAT/{mode},{feed:.7}\n{}END-OF-PATH\n",
        goto(cut.points[0]),
        goto(cut.points[1])
    );
    let [from, to] = cut.block.map(|corner| corner.map(|part| part / size));
    let [flutes, clamp] = [22.0, 45.0].map(|part: f64| part / size);
    let setup = format!(
        "units: {spelled}\nstock: {{ block: {{ from: {from:?}, to: {to:?} }} }}\n\
         tools: [ {{ match: {{}}, flute_length: {flutes}, teeth: 3, helix: 30, stick_out: {clamp}, tool_material: carbide, \
         shank: {{ diameter: {diameter}, length: {clamp} }} }} ]\n\
         material: {{ k_tc: 1800, k_te: 25, k_rc: 600, k_re: 30, k_ac: 200, k_ae: 5 }}\n"
    );
    let program = support::program(text);
    let setup = Setup::load(&Source::new("shop.yaml", setup.into_bytes()).unwrap()).unwrap();
    let machining = Machining::new(&program, &setup, cut.unit, &mut Vec::new()).unwrap();
    let options = SimulationRunOptions::default().with_cell_mm(0.5);
    let report = SimulationReport::simulate_program(&machining, &options, &SilentWatcher).unwrap();
    report.motions.rows.last().unwrap().forces.expect("forces are known")
}

/// A full slot of 3 mm along x.
const ALONG_X: Cut = Cut {
    points: [[10.0, 0.0, -3.0], [40.0, 0.0, -3.0]],
    axis: [0.0, 0.0, 1.0],
    block: [[0.0, -20.0, -10.0], [60.0, 20.0, 0.0]],
    unit: LengthUnit::Mm,
};

#[track_caller]
fn close(found: f64, wanted: f64, scale: f64) {
    assert!((found - wanted).abs() <= 2e-3 * scale, "{found} instead of {wanted}");
}

#[test]
fn an_inch_program_has_the_forces_of_its_cuts() {
    let (mm, inch) = (forces(&ALONG_X), forces(&Cut { unit: LengthUnit::Inch, ..ALONG_X }));
    let scale = mm.resultant_peak_n;
    assert!(scale > 100.0);
    for (found, wanted) in
        inch.mean_n.into_iter().chain(inch.largest_n).zip(mm.mean_n.into_iter().chain(mm.largest_n))
    {
        close(found, wanted, scale);
    }
    let [found, wanted] = [inch, mm].map(|forces| forces.bending.expect("a beam").deflection_peak_mm);
    assert!(wanted > 1e-3 && (found / wanted - 1.0).abs() < 1e-3, "{found} {wanted}");
}

#[test]
fn program_axes_turn_with_the_program_and_tool_axes_do_not() {
    let upright = forces(&ALONG_X);
    let scale = upright.resultant_peak_n;
    // The same slot with the tool along y: x stays, y becomes z, z becomes -y.
    let lying = forces(&Cut {
        points: [[10.0, 3.0, 0.0], [40.0, 3.0, 0.0]],
        axis: [0.0, -1.0, 0.0],
        block: [[0.0, 0.0, -20.0], [60.0, 10.0, 20.0]],
        unit: LengthUnit::Mm,
    });
    let [x, y, z] = upright.mean_n;
    for (found, wanted) in lying.mean_n.into_iter().zip([x, -z, y]) {
        close(found, wanted, scale);
    }
    for (found, wanted) in lying.tool_mean_n.into_iter().zip(upright.tool_mean_n) {
        close(found, wanted, scale);
    }
    close(lying.bending_peak_n, upright.bending_peak_n, scale);
    close(lying.largest_n[2], upright.largest_n[1], 3.0 * scale);
}

#[test]
fn a_tilted_tool_has_its_own_axes() {
    let (sin, cos) = 0.3_f64.sin_cos();
    // Tilted against the feed: ahead stays along x as far as it is across the axis.
    let tilted = forces(&Cut { axis: [-sin, 0.0, cos], ..ALONG_X });
    let scale = tilted.resultant_peak_n;
    let [x, y, z] = tilted.mean_n;
    let [ahead, left, along] = tilted.tool_mean_n;
    close(along, -sin * x + cos * z, scale);
    close(ahead, cos * x + sin * z, scale);
    close(left, y, scale);
    close(tilted.bending_mean_n(), ahead.hypot(left), scale);
    assert!((tilted.resultant_mean_n() - ahead.hypot(left).hypot(along)).abs() < 1e-6 * scale);
    assert!(along.abs() > 0.01 * scale && x.abs() > 0.05 * scale);
}
