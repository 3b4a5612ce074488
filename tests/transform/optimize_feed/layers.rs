//! The step with exact chips in place of columns.

use super::step::{corrected, feeds, program, recipe, snapshot};
use crate::support;
use clsmith::program::LengthUnit;
use clsmith::setup::Setup;
use clsmith::simulation_run::{Machining, SilentWatcher, SimulationRunOptions};
use clsmith::source::Source;
use std::fmt::Write;

/// A wall of the block with the cutter leaning into it, more and more, 1 to 4 mm wide.
fn wall() -> String {
    let mut body = "FEDRAT/MMPM,500.0000\n".to_owned();
    for index in 0..9 {
        let share = f64::from(index) / 8.0;
        let (x, y) = (-8.0 + 40.0 * share, -34.0 + 3.0 * share);
        let (sin, cos) = (15.0 * share).to_radians().sin_cos();
        let _ = writeln!(body, "GOTO/{x:.4},{y:.4},-6.0000,0.0000000,{:.7},{cos:.7}", -sin);
    }
    program(&body)
        .replace("GOTO/-10.0000,0.0000,-3.0000", "GOTO/-10.0000,-34.0000,-6.0000")
        .replace("GOTO/0.0000,0.0000,50.0000", "GOTO/32.0000,-80.0000,50.0000")
}

const LAYERS: &str = "target: 0.06, max_feed: 9000, engagement: layers, layer: 0.25, min_change: 0.02";

/// For each feed motion, the chip thickness at its feed by columns: the estimate and its bound.
fn chips(text: &str, step: &str) -> Vec<[f64; 2]> {
    let program = support::program(text);
    let setup = recipe(step).split("steps:").next().unwrap().replace("version: 1\nsetup:\n", "");
    let setup = setup.lines().map(|line| format!("{}\n", line.trim_start())).collect::<String>();
    let setup = Setup::load(&Source::new("shop.yaml", setup.into_bytes()).unwrap()).unwrap();
    let machining = Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new()).unwrap();
    let teeth = machining.tooling().cutters()[0].teeth.clone().unwrap();
    let options = SimulationRunOptions::default().with_cell_mm(0.25).with_longest_piece_mm(1.0);
    let mut found = Vec::new();
    machining
        .simulate_program(&options, &SilentWatcher, &mut |cut| {
            let Some(feed) = cut.motion.feed.filter(|_| !cut.motion.rapid) else { return };
            let chip = cut.pieces.iter().fold([0.0f64; 2], |[estimate, bound], (_, piece)| {
                [
                    estimate.max(piece.chip_thickness_mm(&teeth, feed.value, 5000.0)),
                    bound.max(piece.chip_thickness_bound_mm(&teeth, feed.value, 5000.0)),
                ]
            });
            found.push(chip);
        })
        .unwrap();
    found
}

#[test]
fn a_full_slot_runs_at_target_times_teeth_times_speed() {
    let pass = "FEDRAT/MMPM,500.0000\nGOTO/110.0000,0.0000,-3.0000\n";
    let step = LAYERS.replace("layer: 0.25", "layer: 1");
    assert_eq!(feeds(&corrected(&step, &program(pass))), [0.06 * 4.0 * 5000.0]);
    let power = "criterion: power, target: 1, max_feed: 9000, engagement: layers, layer: 0.25";
    // 2000 N/mm2 x 30 mm2 x 1000 mm/min = 1 kW; a layer more may be engaged.
    let found = feeds(&corrected(power, &program(pass)));
    assert!((0.88 * 1000.0..=1001.0).contains(&found[0]), "{found:?}");
    let rate = "criterion: removal_rate, target: 30000, max_feed: 9000, engagement: layers";
    let found = feeds(&corrected(rate, &program(pass)));
    assert!((0.9 * 1000.0..=1001.0).contains(&found[0]), "{found:?}");
}

#[test]
fn a_five_axis_wall_keeps_its_target_when_columns_look_again() {
    let once = corrected(LAYERS, &wall());
    let found = feeds(&once);
    // The way to the block is air, which keeps its feed.
    assert!(found.len() > 3 && found.iter().skip(1).all(|feed| *feed > 1200.0), "{once}");
    let chips = chips(&once, LAYERS);
    assert_eq!(chips.len(), 9);
    for [estimate, bound] in &chips {
        assert!(*estimate <= 0.06 * 1.005 + (bound - estimate), "{chips:?}");
    }
    // Not only kept but used: what columns see is near the target somewhere.
    assert!(chips.iter().any(|[_, bound]| *bound > 0.055), "{chips:?}");
    let twice = corrected(LAYERS, &once);
    let again = feeds(&twice);
    assert_eq!(found.len(), again.len(), "{once}\n{twice}");
    let largest = found.iter().zip(&again).map(|(a, b)| (a - b).abs() / a).fold(0.0, f64::max);
    assert!(largest <= 0.02, "{found:?} {again:?}");
}

#[test]
fn what_layers_cannot_model_stops_the_step_at_its_place() {
    let text = wall();
    let layers = recipe(LAYERS);
    let ball = text.replace("TLDATA/MILL,10.0000,0.0000", "TLDATA/MILL,10.0000,5.0000");
    snapshot("layers and a ball", &layers, &ball);
    let flat = program("FEDRAT/MMPM,500.0000\nGOTO/20.0000,0.0000,-3.0000,0.9961947,0.0000000,0.0871557\n");
    snapshot("layers and an axis along them", &layers, &flat);
    snapshot("layers and a cell", &recipe(&format!("{LAYERS}, cell: 0.25")), &text);
    snapshot("columns and a layer", &recipe("target: 0.06, max_feed: 9000, layer: 0.25"), &text);
    snapshot("layers too thin", &recipe(&LAYERS.replace("0.25", "0.00001")), &text);
}
