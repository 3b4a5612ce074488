//! Coefficients from rows with known truth: `../shared/cases/forces`, and measured slots in `../shared/measured`.

use crate::support::{self, require_shared_folder};
use clsmith::certified_engagement::{ContactSection, ContourElement, SectionRow};
use clsmith::cutter::{Meridian, Teeth};
use clsmith::diagnostic::Diagnostic;
use clsmith::engagement::{CuttingCoefficients, EdgeForceModel};
use clsmith::program::LengthUnit;
use clsmith::program::record::SpindleDirection;
use clsmith::report::calibration::{Calibration, CoefficientOrigin, EdgeTerms, read_measured_forces};
use clsmith::setup::{Setup, WorkMaterial};
use clsmith::simulation_run::{Machining, SilentWatcher};
use clsmith::source::Source;
use nalgebra::Vector3;
use std::f64::consts::FRAC_PI_2;
use std::path::Path;

struct Fitted {
    calibration: Calibration,
    findings: Vec<Diagnostic>,
}

fn fit_text(program: &str, setup: &str, table: &str, edge: EdgeTerms) -> Result<Fitted, Vec<Diagnostic>> {
    let program = support::program(program);
    let setup = Setup::load(&Source::new("shop.yaml", setup.as_bytes().to_vec()).unwrap()).unwrap();
    let table = Source::new("measured.csv", table.as_bytes().to_vec()).unwrap();
    let failed = clsmith::diagnostic::Failure::into_findings;
    let rows = read_measured_forces(&table).map_err(failed)?;
    let machining = Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new()).map_err(failed)?;
    let mut findings = Vec::new();
    let calibration = Calibration::fit_rows(&machining, (&table, rows), edge, &SilentWatcher, &mut findings)
        .map_err(failed)?;
    Ok(Fitted { calibration, findings })
}

fn fit(folder: &Path, rows: &str, program: &str, edge: EdgeTerms) -> Fitted {
    let read = |name: String| std::fs::read_to_string(folder.join(name)).unwrap();
    let (table, program_text, setup) =
        (read(format!("{rows}.csv")), read(format!("{program}.cls")), read(format!("{program}.yaml")));
    fit_text(&program_text, &setup, &table, edge).unwrap_or_else(|found| panic!("{found:?}"))
}

/// The value of a quantity of `calibration.csv`.
fn quantity(fitted: &Fitted, name: &str) -> Option<f64> {
    let coefficients = fitted.calibration.coefficients;
    let line = |row: &clsmith::report::calibration::CalibrationRow| row.measured.lines.unwrap()[0] as f64;
    let only = |rows: Vec<f64>| (rows.len() == 1).then(|| rows[0]);
    let rows = &fitted.calibration.rows;
    match name {
        "k_tc" => Some(coefficients.k_tc),
        "k_rc" => Some(coefficients.k_rc),
        "k_ac" => Some(coefficients.k_ac),
        "k_te" => Some(coefficients.k_te),
        "k_re" => Some(coefficients.k_re),
        "k_ae" => Some(coefficients.k_ae),
        "rank" => Some(fitted.calibration.rank as f64),
        "outlier_line" => only(rows.iter().filter(|row| row.is_outlier).map(line).collect()),
        "vibration_line" => only(rows.iter().filter(|row| row.is_likely_vibration).map(line).collect()),
        other => panic!("no quantity {other}"),
    }
}

#[test]
fn known_coefficients_are_found_again() {
    let Some(folder) = require_shared_folder("cases/forces") else { return };
    let table = std::fs::read_to_string(folder.join("calibration.csv")).unwrap();
    let mut wrong = Vec::new();
    let mut count = 0;
    for rows in ["cal-exact", "cal-three", "cal-outlier", "cal-power", "cal-one"] {
        let program = if rows == "cal-one" { "cal-one" } else { "cal-three" };
        let kept = fit(&folder, rows, program, EdgeTerms::Keep);
        let one = (rows == "cal-one").then(|| fit(&folder, rows, program, EdgeTerms::OneNumber));
        for line in table.lines().filter(|line| line.starts_with(&format!("{rows}.csv"))) {
            let cells: Vec<&str> = line.splitn(6, ',').collect();
            let [low, high] = [cells[3], cells[4]].map(|cell| cell.parse::<f64>().unwrap());
            let found = match (cells[1].strip_suffix("_one_number"), cells[1].strip_suffix("_edge_fixed")) {
                (Some(name), _) => quantity(one.as_ref().unwrap(), &format!("{name}c")),
                (_, Some(name)) => quantity(&kept, name),
                _ => quantity(&kept, cells[1]),
            };
            count += 1;
            if !found.is_some_and(|found| (low..=high).contains(&found)) {
                wrong.push(format!("{rows}: {} is {found:?}, not in {low}..{high}", cells[1]));
            }
        }
        if matches!(rows, "cal-exact" | "cal-three") {
            assert!(
                kept.calibration.rows.iter().all(|row| !row.is_outlier && !row.is_likely_vibration),
                "{rows}"
            );
            assert!(kept.findings.is_empty(), "{rows}: {:?}", kept.findings);
        }
        if rows == "cal-exact" {
            assert!(kept.calibration.rows.iter().all(|row| row.residual_part < 0.005));
        }
        if rows == "cal-power" {
            let sound = kept.calibration.rows.iter().filter(|row| !row.is_likely_vibration);
            assert!(
                sound.into_iter().all(|row| row.power_ratio.is_some_and(|ratio| (ratio - 1.0).abs() < 0.1))
            );
        }
        if let Some(one) = one {
            assert!(matches!(kept.calibration.origins[1], CoefficientOrigin::Kept));
            assert!(matches!(one.calibration.origins[1], CoefficientOrigin::InOtherNumber));
            assert!(kept.findings.iter().any(|found| found.code.id() == "CL0804"));
        }
    }
    assert!(count >= 30, "{count} quantities");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_written_file_is_a_material_and_warns_outside_its_range() {
    let Some(folder) = require_shared_folder("cases/forces") else { return };
    let fitted = fit(&folder, "cal-three", "cal-three", EdgeTerms::Keep);
    let text = fitted.calibration.to_material_file("own slots", "2026-11-02");
    let file = Source::new("own.yaml", text.clone().into_bytes()).unwrap();
    let material = WorkMaterial::load(&file).unwrap_or_else(|fault| panic!("{fault:?}\n{text}"));
    assert_eq!(material.origin.source_of("k_tc"), Some("own slots"));
    assert!(material.origin.error_of("k_tc").is_some_and(|error| error > 1.0), "{text}");
    let [low, high] = material.origin.chip_range_mm.unwrap();
    assert!((low - 0.03).abs() < 2e-3 && (high - 0.1).abs() < 5e-3, "{low} {high}");
    // A slot of twice the feed is outside.
    let shop = format!(
        "stock: {{ block: {{ from: [0, -20, -10], to: [60, 20, 0] }} }}\n\
         tools: [ {{ match: {{}}, diameter: 10, corner_radius: 0, taper: 0, tip: 0, flute_length: 20, teeth: 4, helix: 30 }} ]\n\
         material:\n{}",
        text.lines()
            .filter(|line| !line.starts_with('#'))
            .map(|line| format!("  {line}\n"))
            .collect::<String>()
    );
    let part = "LOAD/TOOL,3\nSPINDL/RPM,3000,CLW\nRAPID\nGOTO/-10,0,-2\nFEDRAT/MMPM,2400.\nGOTO/30,0,-2\n";
    let setup = Setup::load(&Source::new("shop.yaml", shop.into_bytes()).unwrap()).unwrap();
    let program = support::program(part);
    let machining = Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new()).unwrap();
    let options = clsmith::simulation_run::SimulationRunOptions::default();
    let report =
        clsmith::report::simulation::SimulationReport::simulate_program(&machining, &options, &SilentWatcher);
    let found = report.unwrap().findings;
    assert!(found.iter().any(|found| found.code.id() == "CL0802"), "{found:?}");
}

/// A program of measured slots: each in a block of its own beside the others, and its table.
fn measured_program(rows: &[&str]) -> (String, String) {
    let mut program =
        "TLDATA/MILL,10.,0.,60.,0.,0.\nLOAD/TOOL,1\nSPINDL/RPM,3200,CLW\nFEDRAT/MMPM,576.\n".to_owned();
    let mut table = "line,fx_mean_N,fy_mean_N\n".to_owned();
    for (number, row) in rows.iter().enumerate() {
        let cells: Vec<&str> = row.split(',').collect();
        let number_at = |index: usize| cells[index].parse::<f64>().unwrap();
        let (depth, direction, y) = (number_at(1), number_at(4).to_radians(), 100.0 * number as f64);
        // Through the middle of its block, from a fifth of it to four fifths.
        let at = |along: f64| (along * direction.cos(), y + along * direction.sin());
        let (start, from, to) = (at(-60.0), at(-20.0), at(20.0));
        for (word, (x, y), z) in [
            ("RAPID\n", start, 20.0),
            ("RAPID\n", start, -depth),
            ("FEDRAT/MMPM,576.\n", from, -depth),
            ("", to, -depth),
        ] {
            program.push_str(&format!("{word}GOTO/{x:.4},{y:.4},{z:.4},0.,0.,1.\n"));
        }
        let line = program.lines().count();
        table.push_str(&format!("{line},{},{}\n", cells[6], cells[7]));
        program.push_str(&format!("RAPID\nGOTO/{:.4},{:.4},20.,0.,0.,1.\n", to.0, to.1));
    }
    (program, table)
}

fn measured_shop(count: usize) -> String {
    let bodies: Vec<String> = (0..count)
        .map(|number| {
            let y = 100.0 * number as f64;
            format!("    - block: {{ from: [-40, {}, -20], to: [40, {}, 0] }}\n", y - 40.0, y + 40.0)
        })
        .collect();
    format!(
        "stock:\n  bodies:\n{}tools: [ {{ match: {{}}, flute_length: 30, teeth: 4, helix: 30 }} ]\n\
         material: {{ k_tc: 1500, k_rc: 500, k_te: 0, k_re: 0 }}\n",
        bodies.concat()
    )
}

#[test]
fn measured_slots_give_two_numbers_that_explain_them() {
    let Some(folder) = require_shared_folder("measured") else { return };
    let text = std::fs::read_to_string(folder.join("steel_slots.csv")).unwrap();
    let slots = |run: &str| -> Vec<String> {
        let rows = text.lines().filter(|line| line.starts_with(&format!("{run},")));
        rows.filter(|line| line.split(',').nth(5) == Some("180")).map(str::to_owned).collect()
    };
    for (run, resultant, feed) in [("A", 0.06, 0.13), ("B", 0.08, 0.13)] {
        let rows = slots(run);
        let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
        let (program, table) = measured_program(&rows);
        let shop = measured_shop(rows.len());
        let fitted = fit_text(&program, &shop, &table, EdgeTerms::OneNumber)
            .unwrap_or_else(|found| panic!("{found:?}"));
        assert_eq!(fitted.calibration.rank, 2, "run {run}");
        for (row, text) in fitted.calibration.rows.iter().zip(&rows) {
            let [x, y] = [0, 1].map(|axis| row.measured.force_n[axis].unwrap());
            let [a, b] = [row.fitted_n[0], row.fitted_n[1]];
            assert!((x.hypot(y) / a.hypot(b) - 1.0).abs() < resultant, "run {run}: {row:?}");
            let direction = text.split(',').nth(4).unwrap().parse::<f64>().unwrap().to_radians();
            let along = |x: f64, y: f64| x * direction.cos() + y * direction.sin();
            assert!((along(x, y) / along(a, b) - 1.0).abs() < feed, "run {run}: {row:?}");
        }
    }
}

/// The mean forces ahead and to the left of a cut from the left up to an angle, by coefficients.
fn mean_of_partial_cut(coefficients: CuttingCoefficients, depth: f64, exit_deg: f64) -> [f64; 2] {
    let element = ContourElement::Line { from: [5.0, 0.0], to: [5.0, depth], normal: [1.0, 0.0] };
    let arcs = vec![[FRAC_PI_2 - exit_deg.to_radians(), FRAC_PI_2]];
    let section = ContactSection {
        rows: vec![SectionRow { element, range: [0.0, 1.0], arcs }],
        frame: [Vector3::x(), Vector3::y(), Vector3::z()],
        has_heading: true,
        tip_speed: [1.0, 0.0],
        spin: [0.0; 2],
    };
    let profile = Meridian::new(10.0, 0.0, 0.0, 0.0, 30.0).unwrap();
    let teeth = Teeth::evenly_spaced(4, 0.5).unwrap();
    let model = EdgeForceModel::new(&profile, &teeth, coefficients, SpindleDirection::Clockwise);
    let [ahead, left, _] = model.forces_of_section(&section, 576.0, 3200.0).tool_mean_n;
    [ahead, left]
}

#[test]
fn partial_cuts_agree_with_the_full_slots_of_their_edge() {
    let Some(folder) = require_shared_folder("measured") else { return };
    let text = std::fs::read_to_string(folder.join("steel_slots.csv")).unwrap();
    for run in ["A", "B"] {
        let rows: Vec<&str> = text.lines().filter(|line| line.starts_with(&format!("{run},"))).collect();
        let is_full = |row: &&&str| row.split(',').nth(5) == Some("180");
        let full: Vec<&str> = rows.iter().filter(is_full).copied().collect();
        let (program, table) = measured_program(&full);
        let fitted = fit_text(&program, &measured_shop(full.len()), &table, EdgeTerms::OneNumber);
        let coefficients = fitted.unwrap_or_else(|found| panic!("{found:?}")).calibration.coefficients;
        let partial: Vec<&&str> = rows.iter().filter(|row| !is_full(row)).collect();
        assert!(partial.len() >= 2, "run {run}");
        for row in partial {
            let number = |index: usize| row.split(',').nth(index).unwrap().parse::<f64>().unwrap();
            let found = mean_of_partial_cut(coefficients, number(1), number(5));
            let [x, y] = [number(6), number(7)];
            assert!((x.hypot(y) / found[0].hypot(found[1]) - 1.0).abs() < 0.08, "{row}: {found:?}");
        }
    }
}

#[test]
fn tables_that_cannot_be_used() {
    let Some(folder) = require_shared_folder("cases/forces") else { return };
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    let (program, setup) = (read("cal-one.cls"), read("cal-one.yaml"));
    for (table, wanted) in [
        ("", "has no measured rows"),
        ("fx_mean_N\n1\n", "which motions"),
        ("line\n12\n", "what was measured"),
        ("line,fx_mean\n12,100\n", "the unit of `fx_mean` is missing"),
        ("line,feed\n12,100\n", "no column of measured forces"),
        ("line,fx_mean_N\n12,much\n", "no number"),
        ("line,fx_mean_N\n0,100\n", "no line"),
        ("line,fx_mean_N\n4,100\n", "no motion at feed that cuts is at line 4"),
        ("line,spindle_current_A\n12,3\n", "idle_current_A"),
        ("line,fx_mean_N,fy_mean_N\n12,100,-200,5\n", "4 cells"),
    ] {
        let found = fit_text(&program, &setup, table, EdgeTerms::Keep).err().unwrap_or_default();
        assert!(
            found.iter().any(|found| found.code.id() == "CL0803" && found.message.contains(wanted)),
            "{table:?}: {found:?}"
        );
    }
}

#[test]
fn cuts_of_several_tools_are_told() {
    let slot = |tool: u32, diameter: f64, y: f64| {
        format!(
            "TLDATA/MILL,{diameter},0,50,0,0\nLOAD/TOOL,{tool}\nSPINDL/RPM,4000,CLW\nRAPID\nGOTO/-10,{y},-2\n\
             FEDRAT/MMPM,800\nGOTO/20,{y},-2\nGOTO/40,{y},-2\nFEDRAT/MMPM,400\nGOTO/60,{y},-2\n"
        )
    };
    let program = slot(1, 10.0, 0.0) + &slot(2, 8.0, 30.0);
    let setup = "stock: { block: { from: [0, -10, -10], to: [80, 40, 0] } }\n\
                 tools: [ { match: {}, teeth: 4, flute_length: 20 } ]\nmaterial: { k_tc: 1800 }\n";
    let head = "line,fx_mean_N,fy_mean_N,fz_mean_N\n8,54,-180,46\n";
    let told = |row: &str| {
        let found = fit_text(&program, setup, &format!("{head}{row}"), EdgeTerms::OneNumber);
        let found = found.map(|fitted| fitted.findings).unwrap_or_else(|found| panic!("{found:?}"));
        found.into_iter().filter(|found| found.code.id() == "CL0809").map(|found| found.message).next()
    };
    assert_eq!(told("10,27,-90,23\n"), None);
    let message = told("18,54,-180,46\n").unwrap_or_default();
    assert!(message.contains("D10.000") && message.contains("D8.000"), "{message}");
}
