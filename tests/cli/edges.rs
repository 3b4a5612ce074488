//! Chips along edges, as people ask for them.

use super::{clsmith, example};

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

const ARGS: [&str; 7] = ["simulate", "slots.cls", "--setup", "shop.yaml", "--chips", "columns", "-q"];

/// The rows of a table with a head, as numbers.
fn rows(text: &str) -> Vec<Vec<f64>> {
    text.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect()
}

#[test]
fn a_slot_as_a_table_a_drawing_and_json() {
    let folder = example("dynamometer");
    let edges = [
        "--edges",
        "31",
        "--csv",
        "edges.csv",
        "--plot",
        "edges.svg",
        "--json",
        "edges.json",
        "--cell",
        "0.5",
    ];
    clsmith(folder.path()).args(ARGS).args(edges).assert().success();
    let csv = std::fs::read_to_string(folder.path().join("edges.csv")).unwrap();
    assert_eq!(
        csv.lines().next().unwrap(),
        "line,tooth,rotation_deg,along_mm,height_mm,radius_mm,chip_thickness_mm"
    );
    let cells = rows(&csv);
    assert_eq!(cells.len(), 360 * 64, "four teeth alike");
    // 1024 mm/min at 3200 rev/min and four teeth; the edge lags by z tan(38 deg) / 5.
    for cell in &cells {
        let angle = cell[4] * 38_f64.to_radians().tan() / 5.0 - cell[2].to_radians();
        let wanted = 0.08 * angle.cos().max(0.0);
        assert!((cell[6] - wanted).abs() < 2e-6, "{cell:?}: {wanted}");
    }
    let svg = std::fs::read_to_string(folder.path().join("edges.svg")).unwrap();
    assert!(svg.contains("chip thickness on the edge, line 31, each tooth alike"));
    assert!(svg.contains("along the edge from the tip, mm") && svg.contains("0.0800"));
    // The stock is in the picture.
    assert!(svg.matches("<polygon").count() > 1000, "{}", svg.matches("<polygon").count());
    let json = std::fs::read_to_string(folder.path().join("edges.json")).unwrap();
    let told: serde_json::Value = serde_json::from_str(&json).unwrap();
    let map = &told["edges"][0];
    assert_eq!((&map["line"], &map["tooth"]), (&31.into(), &1.into()));
    let thickest =
        map["chip_thickness_mm"].as_array().unwrap().iter().flat_map(|row| row.as_array().unwrap());
    let thickest = thickest.map(|chip| chip.as_f64().unwrap()).fold(0.0, f64::max);
    assert!((thickest - 0.08).abs() < 1e-4, "{thickest}");
}

#[test]
fn inches_are_shown_where_they_are_asked_for() {
    let folder = example("dynamometer");
    let edges = ["--edges", "12..13", "--display-units", "inch", "--csv", "edges.csv", "--cell", "0.5"];
    clsmith(folder.path()).args(ARGS).args(edges).assert().success();
    let csv = std::fs::read_to_string(folder.path().join("edges.csv")).unwrap();
    let head: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
    assert_eq!(head[3..], ["along_in", "height_in", "radius_in", "chip_thickness_in"]);
    let cells = rows(&csv);
    let radius = cells.iter().map(|cell| cell[5]).fold(0.0, f64::max);
    assert!((radius * 25.4 - 5.0).abs() < 1e-3, "{radius}");
    let lines: std::collections::BTreeSet<u64> = cells.iter().map(|cell| cell[0] as u64).collect();
    assert_eq!(lines.into_iter().collect::<Vec<_>>(), [12, 13]);
}

#[test]
fn what_has_no_edges_is_told() {
    let folder = example("dynamometer");
    let said = clsmith(folder.path()).args(ARGS).args(["--edges", "2"]).assert().code(1);
    assert!(text(&said.get_output().stderr).contains("CL0801"));
    for wrong in ["0", "x", "7..3"] {
        clsmith(folder.path()).args(ARGS).args(["--edges", wrong]).assert().code(2);
    }
    clsmith(folder.path()).args(ARGS).args(["--edges", "31", "--tooth-period", "31"]).assert().code(2);
}
