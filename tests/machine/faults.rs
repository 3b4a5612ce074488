//! Machines that are none, and what is underlined.

use super::neutral::{read_json, to_setup};
use crate::support::require_shared_folder;
use clsmith::setup::Setup;
use clsmith::source::Source;

/// What the first finding underlines, and its message.
#[track_caller]
fn refused(text: &str) -> (String, String) {
    let source = Source::new("machine.yaml", text.as_bytes().to_vec()).unwrap();
    let Err(failure) = Setup::load(&source) else { panic!("not refused:\n{text}") };
    let findings = failure.into_findings();
    let first = &findings[0];
    let label = first.labels.first().unwrap_or_else(|| panic!("no place: {}", first.message));
    (String::from_utf8_lossy(source.slice(label.span)).into_owned(), first.message.clone())
}

#[test]
fn bad_machines_of_the_shared_cases_are_refused() {
    let Some(folder) = require_shared_folder("cases/machine") else { return };
    let bad = read_json(&folder.join("bad.machines.json"));
    let machines = bad["machines"].as_array().unwrap();
    assert!(machines.len() >= 12);
    for one in machines {
        let (at, message) = refused(&to_setup(&one["machine"], ""));
        assert!(!at.is_empty() && !message.is_empty(), "{}", one["why"]);
    }
}

const LINEARS: &str = "  head:
    - { name: X, kind: linear, direction: [1, 0, 0], max_speed: 1, rapid: 1, acceleration: 1 }
    - { name: Y, kind: linear, direction: [0, 1, 0], max_speed: 1, rapid: 1, acceleration: 1 }
    - { name: Z, kind: linear, direction: [0, 0, 1], max_speed: 1, rapid: 1, acceleration: 1 }
";

fn with_table(axes: &[&str]) -> String {
    let axes: Vec<String> = axes.iter().map(|axis| format!("    - {{ {axis} }}\n")).collect();
    format!("machine:\n{LINEARS}  table:\n{}", axes.concat())
}

const C: &str =
    "name: C, kind: rotary, direction: [0, 0, 1], point: [0, 0, 0], max_speed: 1, rapid: 1, acceleration: 1";

#[test]
fn the_place_is_the_number_that_is_wrong() {
    let a = "name: A, kind: rotary, direction: [1, 0, 0], point: [0, 0, 0], max_speed: 1, rapid: 1, acceleration: 1";
    let cases = [
        (with_table(&[C, &a.replace("[1, 0, 0]", "[0, 0, -2]")]), "direction", "parallel"),
        (with_table(&[C, &a.replace("[1, 0, 0]", "[0, 0, 0]")]), "[0, 0, 0]", "no direction"),
        (with_table(&[C, &a.replace(", point: [0, 0, 0]", "")]), "{ name: A", "no point"),
        (with_table(&[C, &format!("{a}, limits: [30, -30]")]), "[30, -30]", "crossed"),
        (with_table(&[C, &a.replace("name: A", "name: C")]), "C", "two axes"),
        (with_table(&[C, &a.replace("max_speed: 1", "max_speed: 0")]), "0", "greater than 0"),
        (with_table(&[C, a, &a.replace("name: A", "name: B")]), "kind", "more than two rotary"),
        (with_table(&[a, C]), "direction", "along the tool"),
        (
            with_table(&[
                "name: U, kind: linear, direction: [1, 0, 0], max_speed: 1, rapid: 1, acceleration: 1",
            ]),
            "machine",
            "4 linear",
        ),
        (with_table(&[&a.replace("rotary", "linear")]), "point", "has a point"),
        (with_table(&[&format!("{a}, pitch: 3")]), "pitch", "pitch"),
    ];
    for (text, at, part) in cases {
        let (found, message) = refused(&text);
        assert!(message.contains(part), "{message} does not say {part}");
        assert!(found.starts_with(at), "{found} is underlined and not {at}: {message}");
    }
}

#[test]
fn lengths_are_in_the_unit_of_the_file() {
    let text = format!("units: inch\n{}", with_table(&[&C.replace("point: [0, 0, 0]", "point: [0, 0, 2]")]));
    // C alone lies along the tool.
    let text = text.replace("direction: [0, 0, 1], point", "direction: [1, 0, 0], limits: [-90, 90], point");
    let chain = super::chain_of(&text);
    let turned = chain.rotary_axes().next().unwrap();
    assert_eq!((turned.point.z, turned.limits, turned.max_speed), (50.8, Some([-90.0, 90.0]), 1.0));
    assert!((chain.linear_axes().next().unwrap().max_speed - 25.4).abs() < 1e-12);
}

#[test]
fn keys_of_the_machine_go_on_working_beside_axes() {
    let text = "machine: { file: other.yaml, max_feed: 8000 }";
    let setup = Setup::load(&Source::new("shop/setup.yaml", text.as_bytes().to_vec()).unwrap()).unwrap();
    assert!(setup.machine.chain.is_none() && setup.machine.dynamics().is_none());
    let other = format!("{}  max_feed: 500\n  rapid_feed: 9000\n", with_table(&[]).replace("  table:\n", ""));
    let read = |path: &std::path::Path| {
        assert_eq!(path, std::path::Path::new("shop/other.yaml"));
        Ok(Source::new("shop/other.yaml", other.clone().into_bytes())?)
    };
    let machine = setup.read_machine_file(read).unwrap().machine;
    // What is closer to the job has priority, key by key.
    assert_eq!(machine.max_feed.map(|feed| feed.get()), Some(8000.0));
    assert_eq!(machine.rapid_feed.map(|feed| feed.get()), Some(9000.0));
    assert_eq!(machine.chain.unwrap().axes().len(), 3);
}
