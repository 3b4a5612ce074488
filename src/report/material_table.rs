//! This module tells materials: their numbers, and where each comes from.

use crate::engagement::{CuttingCoefficients, CuttingLaw};
use crate::presentation::to_safe_line;
use crate::report::to_json_text;
use crate::setup::WorkMaterial;
use serde_json::json;
use std::fmt::Write as _;

/// Returns the numbers of a law, with their names and units.
fn list_numbers(law: &CuttingLaw) -> Vec<(&'static str, f64, &'static str)> {
    match law {
        CuttingLaw::Linear(CuttingCoefficients { k_tc, k_te, k_rc, k_re, k_ac, k_ae }) => vec![
            ("k_tc", *k_tc, "N/mm2"),
            ("k_te", *k_te, "N/mm"),
            ("k_rc", *k_rc, "N/mm2"),
            ("k_re", *k_re, "N/mm"),
            ("k_ac", *k_ac, "N/mm2"),
            ("k_ae", *k_ae, "N/mm"),
        ],
        CuttingLaw::Kienzle { tangential, radial, axial } => vec![
            ("tangential k11", tangential.k11, "N/mm2"),
            ("tangential m", tangential.m, ""),
            ("radial k11", radial.k11, "N/mm2"),
            ("radial m", radial.m, ""),
            ("axial k11", axial.k11, "N/mm2"),
            ("axial m", axial.m, ""),
        ],
    }
}

fn source_of<'m>(material: &'m WorkMaterial, name: &str) -> &'m str {
    let key = if material.law.is_linear() { name } else { "kienzle" };
    material.origin.source_of(key).unwrap_or("not told")
}

/// Returns materials with their names for setups, as text for people.
pub fn describe_materials(materials: &[(&str, WorkMaterial)]) -> String {
    let mut out = String::new();
    for (key, material) in materials {
        let name = to_safe_line(material.name.as_deref().unwrap_or("a material without a name"));
        let _ = writeln!(out, "{key}: {name}");
        for (number, value, unit) in list_numbers(&material.law) {
            let source = to_safe_line(source_of(material, number));
            let _ = writeln!(out, "  {number:<5} {value:>8} {unit:<5}  {source}");
        }
        let range = |words: &str, range: Option<[f64; 2]>, unit: &str| {
            range.map(|[from, to]| format!("{words} {from} to {to} {unit}"))
        };
        let origin = &material.origin;
        let ranges = [
            range("chips", origin.chip_range_mm, "mm"),
            range("speeds", origin.speed_range_m_min, "m/min"),
            range("depths", origin.depth_range_mm, "mm"),
        ];
        let ranges: Vec<String> = ranges.into_iter().flatten().collect();
        let told = if ranges.is_empty() { "no range is known".to_owned() } else { ranges.join(", ") };
        let _ = writeln!(out, "  holds for: {told}\n");
    }
    out
}

/// Returns materials as a JSON document.
pub fn materials_to_json(materials: &[(&str, WorkMaterial)]) -> String {
    let told: Vec<serde_json::Value> = materials
        .iter()
        .map(|(key, material)| {
            let numbers: Vec<serde_json::Value> = list_numbers(&material.law)
                .into_iter()
                .map(|(name, value, unit)| {
                    json!({ "name": name, "value": value, "unit": unit, "source": source_of(material, name) })
                })
                .collect();
            let origin = &material.origin;
            json!({
                "key": key,
                "name": material.name,
                "numbers": numbers,
                "chip_mm": origin.chip_range_mm,
                "cutting_speed_m_min": origin.speed_range_m_min,
                "axial_depth_mm": origin.depth_range_mm,
            })
        })
        .collect();
    to_json_text(&json!({ "version": 1, "materials": told }))
}
