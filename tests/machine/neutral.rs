//! Converts machines in the neutral form of `../shared/cases/machine` to setups.

use serde_json::Value;
use std::fmt::Write as _;
use std::path::Path;

/// Reads a JSON file.
pub fn read_json(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// A machine as a setup file. The keys of an axis are the same; JSON is YAML.
pub fn to_setup(machine: &Value, more: &str) -> String {
    let mut text = format!("units: mm\nmachine:\n{more}");
    for list in ["table", "head"] {
        let axes = machine[list].as_array().unwrap();
        let _ = writeln!(text, "  {list}:{}", if axes.is_empty() { " []" } else { "" });
        axes.iter().for_each(|axis| {
            let _ = writeln!(text, "    - {axis}");
        });
    }
    text
}
