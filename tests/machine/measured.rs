//! Values of machines from timed blocks.

use crate::support::require_shared_folder;
use clsmith::machine::rest_to_rest_s;
use clsmith::report::measured_times::{MeasuredTimes, read_timing_log};
use clsmith::source::Source;
use std::fmt::Write as _;

fn fit(text: &str) -> MeasuredTimes {
    let source = Source::new("log.csv", text.as_bytes().to_vec()).unwrap();
    MeasuredTimes::from_log(&read_timing_log(&source).unwrap_or_else(|f| panic!("{:?}", f.into_findings())))
}

#[test]
fn three_corners_of_a_machine_give_its_constant() {
    let Some(folder) = require_shared_folder("measured") else { return };
    let text = std::fs::read_to_string(folder.join("corners.csv")).unwrap();
    let found = fit(&text).corner_constant.unwrap();
    assert!((found.value - 0.0087).abs() < 0.0001, "{}", found.value);
    assert_eq!(found.blocks, 3);
    assert!(found.largest_error_s < 0.002);
}

#[test]
fn what_a_model_has_timed_is_found_again() {
    let mut text = "axis,length_mm,feed_mm_min,seconds\n# a comment\n".to_owned();
    for length in [0.5, 2.0, 10.0, 50.0] {
        let seconds = rest_to_rest_s(length, 50.0, Some(1800.0), None);
        let _ = writeln!(text, ",{length},3000,{seconds}");
    }
    for (axis, speed, acceleration) in [("X", 500.0, 3000.0), ("C", 150.0, 800.0)] {
        for length in [2.0, 60.0, 200.0, 400.0] {
            let seconds = rest_to_rest_s(length, speed, Some(acceleration), None);
            let _ = writeln!(text, "{axis},{length},,{seconds}");
        }
    }
    let found = fit(&text);
    let path = found.path_acceleration.unwrap();
    assert!((path.value / 1800.0 - 1.0).abs() < 1e-6, "{}", path.value);
    assert!(found.corner_constant.is_none());
    for (axis, speed, acceleration) in [("X", 500.0, 3000.0), ("C", 150.0, 800.0)] {
        let axis = found.axes.iter().find(|one| one.name == axis).unwrap();
        assert!((axis.rapid.unwrap() / (60.0 * speed) - 1.0).abs() < 1e-4, "{axis:?}");
        assert!((axis.acceleration.unwrap().value / acceleration - 1.0).abs() < 1e-3, "{axis:?}");
    }
    // A setup can take the lines as they are.
    let lines = found.to_text();
    let setup = clsmith::setup::Setup::load(&Source::new("m.yaml", lines.into_bytes()).unwrap()).unwrap();
    assert!((setup.machine.max_acceleration.unwrap().get() / 60.0 - 1800.0).abs() < 0.1);
}

#[test]
fn what_cannot_be_read_is_told_where_it_stands() {
    for (text, at, part) in [
        ("corner,feed_mm_min\n1,2\n", "corner,feed_mm_min", "no column"),
        ("corner_deg,feed_mm_min,lost_s\n90,576\n", "90,576", "`lost_s` is missing"),
        ("corner_deg,feed_mm_min,lost_s\n90,abc,0.1\n", "90,abc,0.1", "`abc`"),
        ("length_mm,seconds\n90,-1\n", "90,-1", "above 0"),
    ] {
        let source = Source::new("log.csv", text.as_bytes().to_vec()).unwrap();
        let found = read_timing_log(&source).unwrap_err().into_findings();
        assert_eq!(String::from_utf8_lossy(source.slice(found[0].labels[0].span)), at);
        assert!(found[0].message.contains(part), "{}", found[0].message);
    }
    let empty = Source::new("log.csv", b"# nothing\n".to_vec()).unwrap();
    assert!(read_timing_log(&empty).is_err());
}
