//! What is said about broken setups, and what is underlined.

use super::{load, seen};
use clsmith::diagnostic::Diagnostic;

#[track_caller]
fn faults(name: &str, setups: &[&str]) {
    let found: Vec<Diagnostic> = setups
        .iter()
        .flat_map(|text| load(text).err().unwrap_or_else(|| panic!("no fault in {text}")))
        .collect();
    seen(name, &found);
}

#[test]
fn stock() {
    faults(
        "stock_faults",
        &[
            "stock: {}",
            "stock: { allowance: 1 }",
            "stock: { block: { from: [0, 0, 0], to: [1, 1, 1] }, stl: a.stl }",
            "stock: { file: a.clstock, bodies: [ { stl: a.stl } ] }",
            "stock: { bodies: [] }",
            "stock: { bodies: { stl: a.stl } }",
            "stock:\n  bodies:\n    - block: { from: [0, 0, 0], to: [1, 1, 1] }\n      stl: a.stl\n",
            "stock: { bodies: [ { sphere: 3 } ] }",
            "stock: { blok: { from: [0, 0, 0], to: [1, 1, 1] } }",
            "stock: { stl: \"\" }",
            "stock: { stl: 5 }",
            "stock: { stl: a.stl, allowance: -1 }",
        ],
    );
}

#[test]
fn bodies() {
    faults(
        "body_faults",
        &[
            "stock: { block: { from: [0, 0, 0], to: [10, 10, 0] } }",
            "stock: { block: { from: [1, 2, 3], to: [1, 2, 3] } }",
            "stock: { block: { from: [0, 0], to: [10, 10, 5] } }",
            "stock: { block: { from: [0, 0, 0] } }",
            "stock: { block: 5 }",
            "stock: { block: { from: [0, 0, 0], to: [1e300, 1, 1] } }",
            "stock: { cylinder: { diameter: 60, from: [0, 0, 5], to: [0, 0, 5] } }",
            "stock: { cylinder: { diameter: 0, from: [0, 0, 0], to: [0, 0, 5] } }",
            "stock: { cylinder: { diameter: 1e-9, from: [0, 0, 0], to: [0, 0, 5] } }",
            "stock: { bodies: [ { stl: a.stl }, { cylinder: { diameter: 1, from: [0, 0, 0], to: [0, 0, 0] } } ] }",
        ],
    );
}

#[test]
fn tools() {
    faults(
        "tool_faults",
        &[
            "tools: { match: {} }",
            "tools: [ { diameter: 5 } ]",
            "tools: [ { match: 3 } ]",
            "tools: [ { match: { numbr: 3 } } ]",
            "tools: [ { match: { number: -3 } } ]",
            "tools: [ { match: { name: 3 } } ]",
            "tools: [ { match: {}, diametr: 5 } ]",
            "tools: [ { match: {}, diameter: 0 } ]",
            "tools: [ { match: {}, diameter: 5 mm } ]",
            "tools: [ { match: {}, taper: 90 } ]",
            "tools: [ { match: {}, tip: -1 } ]",
            "tools: [ { match: {}, point: 200 } ]",
            "tools: [ { match: {}, tip: 31, point: 118 } ]",
            "tools: [ { match: {}, diameter: 10, corner_radius: 6 } ]",
            "tools: [ { match: {}, flute_length: 30, shank: { diameter: 10, length: 20 } } ]",
            "tools: [ { match: {}, shank: { diameter: 10 } } ]",
            "tools: [ { match: {}, diameter: 10, insert: { height: 5, radius: 6 } } ]",
            "units: inch\ntools: [ { match: {}, diameter: 1e5 } ]",
        ],
    );
}

#[test]
fn teeth() {
    faults(
        "teeth_faults",
        &[
            "tools: [ { match: {}, teeth: 0 } ]",
            "tools: [ { match: {}, teeth: 2.5 } ]",
            "tools: [ { match: {}, teeth: 4000 } ]",
            "tools: [ { match: {}, pitch: [90, 90, 90] } ]",
            "tools: [ { match: {}, pitch: [180, 200, -20] } ]",
            "tools: [ { match: {}, pitch: [] } ]",
            "tools: [ { match: {}, pitch: 90 } ]",
            "tools: [ { match: {}, teeth: 4, pitch: [120, 120, 120] } ]",
            "tools: [ { match: {}, teeth: 4, runout: [0, 0.01] } ]",
            "tools: [ { match: {}, pitch: [180, 180], runout: [0, 0.01, 0] } ]",
            "tools: [ { match: {}, teeth: 4, runout: -0.01 } ]",
            "tools: [ { match: {}, teeth: 4, runout: [] } ]",
            "tools: [ { match: {}, teeth: 4, runout: much } ]",
            "tools: [ { match: {}, helix: 90 } ]",
            "tools: [ { match: {}, diameter: 10, flute_length: 3, upper_corner_radius: 4 } ]",
            "tools: [ { match: {}, diameter: 10, flute_length: 20, dovetail_angle: 45 } ]",
        ],
    );
}

#[test]
fn materials() {
    faults(
        "material_faults",
        &[
            "material: {}",
            "material: steel",
            "material: { name: C45 }",
            "material: { file: c45.yaml, k_te: 20 }",
            "material: { k_tc: 0 }",
            "material: { k_tc: 1900, k_te: -1 }",
            "material: { ktc: 1900 }",
        ],
    );
}

#[test]
fn a_long_list_of_faults_is_cut_and_in_order() {
    let entries = "  - { match: {}, tip: 1, point: 100 }\n".repeat(5000);
    let found = load(format!("stock: {{}}\ntools:\n{entries}")).unwrap_err();
    assert_eq!(found.len(), 20);
    assert!(found.is_sorted_by_key(|found| found.labels[0].span));
}
