//! The times of `../shared/cases/machine`, and the three corners that were measured on a machine.

use super::neutral::{read_json, to_setup};
use crate::support::require_shared_folder;
use clsmith::machine::time_program;
use clsmith::program::LengthUnit;
use clsmith::setup::Setup;
use clsmith::source::Source;

#[test]
fn agree_with_an_independent_computation() {
    let Some(folder) = require_shared_folder("cases/machine") else { return };
    let expected = read_json(&folder.join("time.expected.json"));
    let machine = read_json(&folder.join("time.machine.json"));
    let cases = expected["cases"].as_array().unwrap();
    assert!(cases.len() >= 8);
    for case in cases {
        let name = case["program"].as_str().unwrap();
        let number = |key: &str| case[key].as_f64().unwrap();
        let mut keys = format!(
            "  max_acceleration: {}\n  corner_constant: {}\n",
            60.0 * number("path_acceleration"),
            number("corner_constant")
        );
        if let Some(jerk) = case["jerk"].as_f64() {
            keys += &format!("  path_jerk: {jerk}\n");
        }
        let text = to_setup(&machine, &keys);
        let setup = Setup::load(&Source::new("time.yaml", text.into_bytes()).unwrap()).unwrap();
        let program = crate::support::program(std::fs::read(folder.join(name)).unwrap());
        let time = time_program(&program, LengthUnit::Mm, &setup.machine.dynamics().unwrap());
        let close = |found: f64, key: &str| {
            let wanted = number(key);
            assert!(
                (found - wanted).abs() <= (1e-3 * wanted).max(1e-9),
                "{name}, {key}: {found} instead of {wanted}"
            );
        };
        close(time.total(), "total_s");
        close(time.feed.feed, "feed_s");
        close(time.feed.corners, "corners_s");
        close(time.feed.start_stop, "start_stop_s");
        close(time.feed.feed_steps, "feed_step_s");
        close(time.rapid, "rapid_s");
        let sum: f64 = time.motions.iter().flatten().sum();
        assert!((sum - time.total()).abs() < 1e-9, "{name}: motions take {sum}, all {}", time.total());
    }
}
