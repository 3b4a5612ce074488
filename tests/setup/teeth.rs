//! Teeth: pitch and runout.

use super::{close, good, load};
use clsmith::cutter::Teeth;
use std::f64::consts::{FRAC_PI_2, TAU};

fn teeth(keys: &str) -> Option<Teeth> {
    good(&format!("tools: [ {{ match: {{}}, {keys} }} ]")).tools[0].teeth.clone()
}

#[test]
fn teeth_are_even_and_run_true_unless_said() {
    let found = teeth("teeth: 4, helix: 30").unwrap();
    assert_eq!(found, Teeth::evenly_spaced(4, 30_f64.to_radians()).unwrap());
    assert_eq!(teeth("helix: 30, runout: 0.01"), None);
}

#[test]
fn each_of_count_pitch_and_runout_says_how_many() {
    assert_eq!(teeth("pitch: [100, 120, 140]").unwrap().count(), 3);
    assert_eq!(teeth("runout: [0, 0.01]").unwrap().count(), 2);
    assert_eq!(teeth("teeth: 1").unwrap().count(), 1);
}

#[test]
fn pitch_is_from_each_tooth_to_the_next_and_scaled_to_a_turn() {
    let found = teeth("pitch: [100, 120, 140.4]").unwrap();
    let scale = TAU / 360.4;
    for (angle, wanted) in found.pitch_angles_rad().iter().zip([140.4, 100.0, 120.0]) {
        close(*angle, wanted * scale);
    }
}

#[test]
fn one_number_of_runout_is_an_eccentric_cutter() {
    let found = teeth("teeth: 4, runout: 0.01").unwrap();
    for (offset, wanted) in found.runout_offsets_mm().iter().zip([0.01, 0.0, -0.01, 0.0]) {
        close(*offset, wanted);
    }
    let uneven = teeth("pitch: [60, 120, 180], runout: 0.02").unwrap();
    for (offset, wanted) in uneven.runout_offsets_mm().iter().zip([0.02, 0.01, -0.02]) {
        close(*offset, wanted);
    }
}

#[test]
fn a_list_of_runout_is_of_each_tooth_and_in_the_files_unit() {
    let setup = good("units: inch\ntools: [ { match: {}, runout: [0, 0.001, -0.002, 0], helix: -90e-1 } ]");
    let found = setup.tools[0].teeth.clone().unwrap();
    for (offset, wanted) in found.runout_offsets_mm().iter().zip([0.0, 0.0254, -0.0508, 0.0]) {
        close(*offset, wanted);
    }
    close(found.pitch_angles_rad()[0], FRAC_PI_2);
    close(found.helix_rad, -9_f64.to_radians());
}

#[test]
fn flutes_are_the_number_of_teeth_as_nx_calls_it() {
    let counts = ["teeth: 4", "flutes: 4"].map(|key| {
        let setup = good(&format!("tools: [ {{ match: {{}}, {key}, flute_length: 25 }} ]"));
        setup.tools[0].teeth.as_ref().map(|teeth| teeth.count())
    });
    assert_eq!(counts, [Some(4), Some(4)]);
    let found = load("tools:\n  - match: {}\n    flutes: 4\n    teeth: 3\n").unwrap_err();
    assert!(found.iter().any(|found| found.message.contains("given twice")), "{found:?}");
    // A length with the word for a number of teeth is no length.
    assert!(load("tools: [ { match: {}, flutes: 25.4 } ]").is_err());
    let many = load("tools:\n  - match: {}\n    flutes: 5000\n").unwrap_err();
    assert_eq!(many[0].labels[0].span.to_range(), 33..37, "{many:?}");
}
