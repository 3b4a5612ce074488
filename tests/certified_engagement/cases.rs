//! The rows of the shared cases are inside their intervals.

use super::mills::mill;
use crate::support::require_shared_folder;
use clsmith::certified_engagement::*;
use nalgebra::Vector3;
use std::collections::HashMap;

fn bracketed(text: &str, key: &str) -> Vec<f64> {
    let rest = text.split_once(key).unwrap().1;
    let inner = rest.split_once('[').unwrap().1.split_once(']').unwrap().0;
    inner.split(',').map(|part| part.trim().parse().unwrap()).collect()
}

pub fn keyed(text: &str, key: &str) -> f64 {
    let rest = text.split_once(key).unwrap().1;
    let end = rest.find([',', '}']).unwrap();
    rest[..end].trim().parse().unwrap()
}

/// Splits a row at commas that are not in quotes.
pub fn split_row(row: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut is_quoted = false;
    for letter in row.chars() {
        match letter {
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => fields.push(String::new()),
            _ => fields.last_mut().unwrap().push(letter),
        }
    }
    fields
}

#[test]
fn rows_of_the_shared_cases_are_inside() {
    let Some(folder) = require_shared_folder("cases/engagement") else { return };
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    let table = read("values.csv");
    let mut programs: HashMap<String, (super::cases_reader::Case, CertifiedProgram, f64)> = HashMap::new();
    let mut failures = Vec::new();
    for row in table.lines().skip(1) {
        let fields = split_row(row);
        let (file, line) = (fields[0].clone(), fields[1].parse::<usize>().unwrap());
        let (share, chip) = (fields[3].parse::<f64>().unwrap(), fields[4].parse::<f64>().unwrap());
        let (case, program, teeth) = programs.entry(file.clone()).or_insert_with(|| {
            let text = read(&file);
            let setup = read(&file.replace(".cls", ".yaml"));
            let case = super::cases_reader::read_program(&text);
            let (low, high) = (bracketed(&setup, "from:"), bracketed(&setup, "to:"));
            let stock = BoxGap::new(Vector3::from_column_slice(&low), Vector3::from_column_slice(&high));
            let contour =
                mill(keyed(&setup, "diameter:"), keyed(&setup, "corner_radius:"), 0.0, 0.0, case.tldata[2]);
            let program = super::cases_reader::build(&case, vec![Box::new(stock)], contour);
            (case, program, keyed(&setup, "teeth:"))
        });
        let index = case.motions.iter().position(|motion| motion.line == line).unwrap();
        let fz = case.motions[index].feed / case.rpm / *teeth;
        for (name, criterion, value) in [
            ("share", EngagementCriterion::Share, share),
            ("chip", EngagementCriterion::Chip { feed_per_tooth_mm: fz }, chip),
        ] {
            let options = EngagementOptions::default();
            let found = program.certify_block(index, criterion, &options, &mut WarmStart::default());
            let is_true = found.upper >= value * 0.999 && found.lower <= value * 1.01 + 1e-9;
            let is_tight = found.upper <= found.lower * 1.02 + 1e-12;
            if !is_true || !is_tight {
                failures.push(format!("{file}:{line} {name}: {value} {found:?}"));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
