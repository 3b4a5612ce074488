//! Forces against an independent integration: `../shared/cases/forces`, with the tolerances and conventions said there.

use crate::support::{self, require_shared_folder};
use clsmith::program::LengthUnit;
use clsmith::report::simulation::SimulationReport;
use clsmith::setup::Setup;
use clsmith::simulation_run::{Machining, MotionForces, SilentWatcher, SimulationRunOptions};
use clsmith::source::Source;
use std::path::Path;

/// What means may be off: a part of the value, and for forces a part of the mean resultant.
const MEAN: [f64; 2] = [0.005, 0.003];
/// The same of peaks, and the part of the largest resultant.
const PEAK: [f64; 2] = [0.015, 0.01];

/// The value of a column.
fn value_of(forces: &MotionForces, column: &str) -> Option<f64> {
    let axis = |name: &str| ["x", "y", "z"].iter().position(|axis| name == *axis);
    if let Some(name) = column.strip_prefix('f').and_then(|rest| rest.strip_suffix("_mean")).and_then(axis) {
        return Some(forces.mean_n[name]);
    }
    if let Some(name) = column.strip_prefix('f').and_then(|rest| rest.strip_suffix("_min")).and_then(axis) {
        return Some(forces.least_n[name]);
    }
    if let Some(name) = column.strip_prefix('f').and_then(|rest| rest.strip_suffix("_max")).and_then(axis) {
        return Some(forces.largest_n[name]);
    }
    match column {
        "f_feed_mean" => forces.has_heading.then_some(forces.tool_mean_n[0]),
        "f_normal_mean" => forces.has_heading.then_some(forces.tool_mean_n[1]),
        "f_resultant_mean" => Some(forces.resultant_mean_n()),
        "f_resultant_peak" => Some(forces.resultant_peak_n),
        "bending_mean" => Some(forces.bending_mean_n()),
        "bending_peak" => Some(forces.bending_peak_n),
        "torque_mean" => Some(forces.torque_mean_nm),
        "torque_peak" => Some(forces.torque_peak_nm),
        "power_mean" => Some(forces.power_mean_kw),
        other => panic!("no column {other}"),
    }
}

fn simulate(folder: &Path, name: &str) -> SimulationReport {
    let read = |ending: &str| std::fs::read(folder.join(format!("{name}.{ending}"))).unwrap();
    let program = support::program(String::from_utf8(read("cls")).unwrap());
    let place = folder.join(format!("{name}.yaml"));
    let setup = Setup::load(&Source::new(place.to_string_lossy(), read("yaml")).unwrap()).unwrap();
    let machining = Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new()).unwrap();
    let options = SimulationRunOptions::default().with_cell_mm(0.5);
    SimulationReport::simulate_program(&machining, &options, &SilentWatcher).unwrap()
}

#[test]
fn forces_of_steady_cuts_are_those_of_an_independent_integration() {
    let Some(folder) = require_shared_folder("cases/forces") else { return };
    let text = std::fs::read_to_string(folder.join("expected.csv")).unwrap();
    let mut lines = text.lines();
    let columns: Vec<&str> = lines.next().unwrap().split(',').collect();
    let mut wrong = Vec::new();
    let mut count = 0;
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |column: &str| -> Option<f64> {
            cells[columns.iter().position(|name| *name == column).unwrap()].parse().ok()
        };
        let name = cells[0].trim_end_matches(".cls");
        let report = simulate(&folder, name);
        let at = number("line").unwrap() as usize;
        let row = report.motions.rows.iter().find(|row| row.line == Some(at)).unwrap();
        let forces = row.forces.expect("forces are known");
        for column in &columns[2..] {
            let (wanted, found) = (number(column), value_of(&forces, column));
            let (Some(wanted), Some(found)) = (wanted, found) else {
                assert_eq!(wanted.is_some(), found.is_some(), "{name} line {at}: {column}");
                continue;
            };
            let is_mean = column.ends_with("_mean");
            let ([part, of_resultant], resultant) = match is_mean {
                true => (MEAN, number("f_resultant_mean")),
                false => (PEAK, number("f_resultant_peak")),
            };
            let is_force = column.starts_with('f') || column.starts_with("bending");
            let floor = if is_force { of_resultant * resultant.unwrap() } else { 0.0 };
            let allowed = (part * wanted.abs()).max(floor) + 1e-9;
            count += 1;
            if (found - wanted).abs() > allowed {
                wrong.push(format!("{name} line {at}: {column} {found:.4} instead of {wanted:.4}"));
            }
        }
    }
    assert!(count > 300, "{count} values");
    assert!(wrong.is_empty(), "{} of {count} values:\n{}", wrong.len(), wrong.join("\n"));
}
