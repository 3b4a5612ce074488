//! Forces inside motions and over a revolution, materials, and coefficients from measured means, as people ask for them.

use super::{clsmith, example};
use clsmith::setup::WorkMaterial;
use clsmith::source::Source;

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The columns of a table and its rows.
fn table(text: &str) -> (Vec<&str>, Vec<Vec<&str>>) {
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    (lines.next().unwrap(), lines.collect())
}

fn column(table: &(Vec<&str>, Vec<Vec<&str>>), name: &str) -> Vec<f64> {
    let index = table.0.iter().position(|column| *column == name).unwrap_or_else(|| panic!("{:?}", table.0));
    table.1.iter().map(|row| row[index].parse().unwrap_or(f64::NAN)).collect()
}

#[test]
fn one_revolution_is_a_table_and_a_drawing() {
    let folder = example("dynamometer");
    let args = ["simulate", "slots.cls", "--setup", "shop.yaml", "--chips", "columns", "-q"];
    let turn = ["--tooth-period", "31", "--csv", "turn.csv", "--plot", "turn.svg"];
    clsmith(folder.path()).args(args).args(turn).assert().success();
    let turn = std::fs::read_to_string(folder.path().join("turn.csv")).unwrap();
    let turn = table(&turn);
    assert_eq!(turn.0, ["angle_deg", "fx_n", "fy_n", "fz_n", "torque_nm"]);
    assert_eq!(turn.1.len(), 360);
    let svg = std::fs::read_to_string(folder.path().join("turn.svg")).unwrap();
    assert!(svg.contains("Fx, N") && svg.contains("torque, N m"));
    // Its mean is that of the motion.
    let done = clsmith(folder.path()).args(args).args(["--csv", "all.csv"]).assert().success();
    drop(done);
    let all = std::fs::read_to_string(folder.path().join("all.csv")).unwrap();
    let all = table(&all);
    let row = column(&all, "line").iter().position(|line| *line == 31.0).unwrap();
    for (turned, whole) in [("fx_n", "fx_mean_n"), ("fy_n", "fy_mean_n"), ("torque_nm", "torque_mean_nm")] {
        let mean = column(&turn, turned).iter().sum::<f64>() / 360.0;
        let whole = column(&all, whole)[row];
        assert!((mean / whole - 1.0).abs() < 0.01, "{turned}: {mean} and {whole}");
    }
    let said = clsmith(folder.path()).args(args).args(["--tooth-period", "2"]).assert().code(1);
    assert!(text(&said.get_output().stderr).contains("CL0801"));
}

#[test]
fn forces_inside_a_motion_grow_where_it_enters() {
    let folder = example("dynamometer");
    let args = ["simulate", "slots.cls", "--setup", "shop.yaml", "--chips", "columns", "-q"];
    clsmith(folder.path())
        .args(args)
        .args(["--forces-along", "0.5mm", "--csv", "along.csv"])
        .assert()
        .success();
    let along = std::fs::read_to_string(folder.path().join("along.csv")).unwrap();
    let along = table(&along);
    let entry: Vec<usize> = column(&along, "line")
        .iter()
        .enumerate()
        .filter(|(_, line)| **line == 12.0)
        .map(|(row, _)| row)
        .collect();
    assert_eq!(entry.len(), 60, "30 mm");
    let power = column(&along, "power_mean_kw");
    let [first, last] = [entry[0], entry[59]].map(|row| power[row]);
    assert!(first == 0.0 && last > 0.3, "{first} {last}");
    for wrong in ["0", "x", "0.5km"] {
        clsmith(folder.path()).args(args).args(["--forces-along", wrong]).assert().code(2);
    }
}

#[test]
fn the_example_calibrates() {
    let folder = example("dynamometer");
    let args = ["calibrate", "measured.csv", "slots.cls", "--setup", "shop.yaml", "--date", "2026-11-02"];
    let outputs = ["-o", "my-steel.yaml", "--plot", "residuals.svg", "--json=fit.json"];
    let done = clsmith(folder.path()).args(args).args(outputs).assert().success();
    assert!(text(&done.get_output().stdout).contains("rank 6 of 6"));
    let said = text(&done.get_output().stderr);
    assert!(said.contains("CL0806") && said.contains("line 49"), "{said}");
    let file = std::fs::read(folder.path().join("my-steel.yaml")).unwrap();
    let material = WorkMaterial::load(&Source::new("my-steel.yaml", file).unwrap()).unwrap();
    assert_eq!(material.origin.date.as_deref(), Some("2026-11-02"));
    let json = std::fs::read(folder.path().join("fit.json")).unwrap();
    let json: serde_json::Value = serde_json::from_slice(&json).unwrap();
    let k_tc = json["coefficients"]["k_tc"]["value"].as_f64().unwrap();
    assert!((k_tc / 1750.0 - 1.0).abs() < 0.06, "{k_tc}");
    assert!(json["findings"]["diagnostics"].as_array().is_some_and(|findings| !findings.is_empty()));
    // A cut far outside the measured ones warns.
    let shop = std::fs::read_to_string(folder.path().join("shop.yaml"))
        .unwrap()
        .replace("steel-c45", "my-steel.yaml");
    std::fs::write(folder.path().join("shop.yaml"), shop).unwrap();
    let part =
        std::fs::read_to_string(folder.path().join("slots.cls")).unwrap().replace("384.0000", "4384.0000");
    std::fs::write(folder.path().join("slots.cls"), part).unwrap();
    let args = ["simulate", "slots.cls", "--setup", "shop.yaml", "--chips", "columns", "-q"];
    let done = clsmith(folder.path()).args(args).assert().success();
    assert!(text(&done.get_output().stderr).contains("CL0802"));
}

#[test]
fn built_in_materials_tell_their_sources() {
    let folder = tempfile::tempdir().unwrap();
    let done = clsmith(folder.path()).arg("materials").assert().success();
    let said = text(&done.get_output().stdout);
    for key in ["steel-c45", "titanium-6al4v", "10.1186/s10033-021-00536-9", "not measured"] {
        assert!(said.contains(key), "{key}: {said}");
    }
    assert!(!said.contains("not told"), "{said}");
    let done = clsmith(folder.path()).args(["materials", "--json"]).assert().success();
    let json: serde_json::Value = serde_json::from_slice(&done.get_output().stdout).unwrap();
    assert_eq!(json["materials"].as_array().map(Vec::len), Some(5));
}

#[test]
fn columns_tell_how_the_tool_bends_in_the_unit_that_is_shown() {
    let folder = example("dynamometer");
    let args = ["simulate", "slots.cls", "--setup", "shop.yaml", "--chips", "columns", "-q"];
    let done = clsmith(folder.path()).args(args).args(["--csv", "mm.csv"]).assert().success();
    drop(done);
    let inch = ["--csv", "inch.csv", "--display-units", "inch"];
    let done = clsmith(folder.path()).args(args).args(inch).assert().success();
    drop(done);
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let (mm, inch) = (read("mm.csv"), read("inch.csv"));
    let (mm, inch) = (table(&mm), table(&inch));
    let row = column(&mm, "line").iter().position(|line| *line == 13.0).unwrap();
    let at = |table: &(Vec<&str>, Vec<Vec<&str>>), name: &str| column(table, name)[row];
    let peak = at(&mm, "deflection_peak_mm");
    assert!(at(&mm, "deflection_mean_mm") < peak && peak > 0.001 && peak < 0.1, "{peak}");
    assert!((at(&inch, "deflection_peak_in") * 25.4 / peak - 1.0).abs() < 1e-3);
    // The beam of books: 22 mm of 8 mm and 23 mm of 10 mm, the force in the middle of the depth.
    let inertia = |diameter: f64| std::f64::consts::PI * diameter.powi(4) / 64.0;
    let part = |from: f64, to: f64| (to.powi(3) - from.powi(3)) / 3.0 - (to * to - from * from) / 2.0;
    let give = (part(1.0, 22.0) / inertia(8.0) + part(22.0, 45.0) / inertia(10.0)) / 580e3;
    let force = at(&mm, "bending_peak_n");
    assert!((peak / (force * give) - 1.0).abs() < 0.01, "{peak} and {}", force * give);
    let stress = at(&mm, "bending_stress_peak_mpa");
    let known = force * 44.0 * 32.0 / (std::f64::consts::PI * 1000.0);
    assert!((stress / known - 1.0).abs() < 0.01, "{stress} and {known}");
    // A slot has two walls: one where material stays, one where too much is cut.
    let walls = ["surface_error_left_peak_mm", "surface_error_right_peak_mm"].map(|name| at(&mm, name));
    assert!(walls[0] * walls[1] < 0.0 && walls.iter().all(|wall| wall.abs() < peak * 1.01), "{walls:?}");
    // Without stiffness the columns are there, and empty.
    let bare = read("shop.yaml").replace("stick_out: 45", "wear: 1");
    std::fs::write(folder.path().join("bare.yaml"), bare).unwrap();
    let done = clsmith(folder.path())
        .args([
            "simulate",
            "slots.cls",
            "--setup",
            "bare.yaml",
            "--chips",
            "columns",
            "-q",
            "--csv",
            "bare.csv",
        ])
        .assert()
        .success();
    drop(done);
    let bare = read("bare.csv");
    assert!(at(&table(&bare), "deflection_peak_mm").is_nan());
}

#[test]
fn reports_and_comparisons_tell_deflection_beside_forces() {
    let folder = example("dynamometer");
    let recipe = "version: 1\nsetup_file: shop.yaml\nsteps:\n  - scale_feed: { factor: 0.5 }\n";
    std::fs::write(folder.path().join("recipe.yaml"), recipe).unwrap();
    let done = clsmith(folder.path())
        .args([
            "apply",
            "recipe.yaml",
            "slots.cls",
            "-o",
            "out.cls",
            "--report",
            "out.html",
            "--summary",
            "out.md",
        ])
        .assert()
        .success();
    drop(done);
    for name in ["out.html", "out.md"] {
        let page = std::fs::read_to_string(folder.path().join(name)).unwrap();
        for words in
            ["largest deflection of a tool", "largest bending stress", "largest force across the tool"]
        {
            assert!(page.contains(words), "{name}: {words}");
        }
    }
    let done = clsmith(folder.path())
        .args(["simulate", "slots.cls", "--setup", "shop.yaml", "--chips", "columns"])
        .assert()
        .success();
    let said = text(&done.get_output().stdout);
    assert!(
        said.contains("largest deflection of a tool") && said.contains("largest error of a wall"),
        "{said}"
    );
    let plot = ["plot", "slots.cls", "--setup", "shop.yaml", "--of", "deflection,stress", "-o", "bent.svg"];
    clsmith(folder.path()).args(plot).assert().success();
    let svg = std::fs::read_to_string(folder.path().join("bent.svg")).unwrap();
    assert!(svg.contains("largest deflection, mm") && svg.contains("largest bending stress, MPa"));
}
