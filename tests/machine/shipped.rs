//! The machines in `configs/machines`.

use clsmith::machine::KinematicChain;
use clsmith::setup::Setup;
use nalgebra::{Point3, Vector3};
use std::path::Path;
use std::sync::Arc;

fn shipped(name: &str) -> Arc<KinematicChain> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/machines").join(name);
    let source = crate::support::source(&path);
    let setup =
        Setup::load(&source).unwrap_or_else(|failure| panic!("{name}: {:?}", failure.into_findings()));
    setup.machine.chain.unwrap()
}

#[test]
fn all_of_them_are_machines() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("configs/machines");
    let mut kinds = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let chain = shipped(&name);
        kinds.push((name, chain.rotary_axes().count()));
        // The tip comes to where it shall be with the tool as it stands at zero.
        let (tip, tool) = (Point3::new(10.0, -5.0, 3.0), chain.tool_axis());
        let solution = chain.solve_rotaries(&tool)[0];
        assert!(chain.solve_linears(solution.values, &tip).is_some());
    }
    kinds.sort();
    let names: Vec<&str> = kinds.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(
        names,
        [
            "cradle.yaml",
            "head-head-ca.yaml",
            "head-table-bc.yaml",
            "mill-turn-cy.yaml",
            "nutating-45.yaml",
            "table-table-ac.yaml",
            "vmc-3axis.yaml"
        ]
    );
    let counts: Vec<usize> = kinds.iter().map(|(_, count)| *count).collect();
    assert_eq!(counts, [2, 2, 2, 1, 2, 2, 0]);
}

#[test]
fn the_cradle_turns_about_a_line_77_5_above_the_workpiece() {
    let cradle = shipped("cradle.yaml");
    // B alone, by hand: the zero of the workpiece turns about (0, 0, 77.5).
    let b = -40f64.to_radians();
    let axis = Vector3::new(-b.sin(), 0.0, b.cos());
    let solutions = cradle.solve_rotaries(&axis);
    let solution = solutions.iter().find(|solution| solution.values[0].abs() < 1e-9).unwrap();
    assert!((solution.values[1] - 40.0).abs() < 1e-9 || (solution.values[1] + 40.0).abs() < 1e-9);
    let linears = cradle.solve_linears(solution.values, &Point3::origin()).unwrap();
    let turn = solution.values[1].to_radians();
    let wanted = Vector3::new(-77.5 * turn.sin(), 0.0, 77.5 - 77.5 * turn.cos());
    assert!((Vector3::from(linears) - wanted).norm() < 1e-12);
}

#[test]
fn the_schema_knows_axes() {
    let schema = serde_json::to_string(&Setup::schema()).unwrap();
    for key in ["corner_constant", "tool_axis", "acceleration", "tip_tolerance", "rotary"] {
        assert!(schema.contains(key), "{key}");
    }
}
