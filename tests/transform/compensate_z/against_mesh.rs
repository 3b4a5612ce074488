//! Cutters lowered onto a model.

use super::{compensate_beside, in_plane, operation};
use clsmith::stock::Mesh;
use std::fmt::Write;
use std::path::PathBuf;

/// A block from (0, 0, -10) to (60, 40, 0) with a roof along y: its ridge at x 30, z `top`.
fn roof(name: &str, top: f64) -> (tempfile::TempDir, PathBuf) {
    let corner = [[0.0, 0.0], [30.0, 0.0], [60.0, 0.0], [0.0, 40.0], [30.0, 40.0], [60.0, 40.0]];
    let z = |index: usize| if index % 3 == 1 { top } else { 0.0 };
    let upper: Vec<[f64; 3]> = corner.iter().enumerate().map(|(index, [x, y])| [*x, *y, z(index)]).collect();
    let lower: Vec<[f64; 3]> = corner.iter().map(|[x, y]| [*x, *y, -10.0]).collect();
    let mut text = String::from("solid roof\n");
    let mut facet = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
        let _ = write!(text, "facet normal 0 0 0\nouter loop\n");
        for p in [a, b, c] {
            let _ = writeln!(text, "vertex {} {} {}", p[0], p[1], p[2]);
        }
        text.push_str("endloop\nendfacet\n");
    };
    for (a, b, c, d) in [(0, 1, 4, 3), (1, 2, 5, 4)] {
        facet(upper[a], upper[b], upper[c]);
        facet(upper[a], upper[c], upper[d]);
        facet(lower[a], lower[c], lower[b]);
        facet(lower[a], lower[d], lower[c]);
    }
    for (a, b) in [(0, 1), (1, 2), (2, 5), (5, 4), (4, 3), (3, 0)] {
        facet(lower[a], lower[b], upper[b]);
        facet(lower[a], upper[b], upper[a]);
    }
    text.push_str("endsolid roof\n");
    Mesh::from_stl(text.as_bytes()).unwrap();
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), text).unwrap();
    let recipe = folder.path().join("recipe.yaml");
    (folder, recipe)
}

#[test]
fn heights_are_right_across_the_pass_too() {
    let (_folder, recipe) = roof("roof.stl", 12.0);
    // Passes along y at the foot of the roof: a profile in their plane would be flat.
    let passes: Vec<Vec<[f64; 3]>> =
        [10.0, 20.0, 30.0].iter().map(|x| in_plane(&[(2.0, 0.0), (38.0, 0.0)], [*x, 0.0], 90.0)).collect();
    let done = compensate_beside(
        recipe.to_str().unwrap(),
        "radius: 5, against: { mesh: roof.stl }, tolerance: 0.005",
        &operation(&passes),
    )
    .unwrap();
    assert!(done.gouge() <= 0.0052, "{}", done.gouge());
    let slope = (12.0f64 / 30.0).atan();
    for (pass, x) in done.passes().iter().zip([10.0, 20.0, 30.0]) {
        // On the slope the tip is R (1/cos - 1) above it; on the ridge it stands on it.
        let expected = if x == 30.0 { 12.0 } else { x * 0.4 + 5.0 * (1.0 / slope.cos() - 1.0) };
        for at in pass {
            assert!((at.z - expected).abs() < 6e-3, "x {x}: {} {expected}", at.z);
        }
    }
}

#[test]
fn a_pass_over_the_ridge_and_a_flat_cutter() {
    let (_folder, recipe) = roof("roof.stl", 12.0);
    let pass = in_plane(&[(5.0, 2.0), (30.0, 12.0), (55.0, 2.0)], [0.0, 20.0], 0.0);
    let path = recipe.to_str().unwrap();
    let ball = compensate_beside(
        path,
        "radius: 5, against: { mesh: roof.stl }",
        &operation(std::slice::from_ref(&pass)),
    )
    .unwrap();
    assert!(ball.gouge() <= 0.0052 && ball.report.passes[0].motions_after > 4);
    // Shorter, since what no ball cuts is looked at place by place.
    let pass = in_plane(&[(22.0, 8.0), (30.0, 12.0), (38.0, 8.0)], [0.0, 20.0], 0.0);
    let flat_tool = operation(&[pass]).replace("TLDATA/MILL,10.0000,5.0000", "TLDATA/MILL,10.0000,0.0000");
    let flat = compensate_beside(path, "against: { mesh: roof.stl }", &flat_tool).unwrap();
    let top =
        flat.passes()[0].iter().filter(|at| (25.0..=35.0).contains(&at.x)).map(|at| at.z).fold(0.0, f64::max);
    assert!((top - 12.0).abs() < 6e-3, "the flat end stands on the ridge: {top}");
}

#[test]
fn rapids_below_the_model_are_errors_and_leads_are_lifted() {
    let (_folder, recipe) = roof("roof.stl", 12.0);
    let pass = in_plane(&[(2.0, 0.0), (38.0, 0.0)], [10.0, 0.0], 90.0);
    let low = operation(&[pass])
        .replace("60.0000", "5.0000")
        .replace("END-OF-PATH", "RAPID\nGOTO/50.0000,38.0000,5.0000\nEND-OF-PATH");
    let done =
        compensate_beside(recipe.to_str().unwrap(), "radius: 5, against: { mesh: roof.stl }", &low).unwrap();
    let found = done
        .findings
        .iter()
        .find(|found| found.code.id() == "CL0331")
        .expect("the rapid goes through the ridge");
    assert!(found.is_error() && found.message.contains("into the model"));
}

#[test]
fn a_model_that_cannot_be_used_is_told_at_the_recipe() {
    let (folder, recipe) = roof("roof.stl", 12.0);
    let text = operation(&[in_plane(&[(2.0, 0.0), (38.0, 0.0)], [10.0, 0.0], 90.0)]);
    let whole = std::fs::read_to_string(folder.path().join("roof.stl")).unwrap();
    let (_, rest) = whole.split_once("endfacet\n").unwrap();
    std::fs::write(folder.path().join("open.stl"), format!("solid roof\n{rest}")).unwrap();
    std::fs::write(folder.path().join("empty.stl"), "solid x\nendsolid x\n").unwrap();
    for (name, says) in
        [("nowhere.stl", "cannot be used"), ("open.stl", "not closed"), ("empty.stl", "no triangle")]
    {
        let parameters = format!("radius: 5, against: {{ mesh: {name} }}");
        let found = compensate_beside(recipe.to_str().unwrap(), &parameters, &text).err().unwrap();
        let last = found.last().unwrap();
        assert!(last.code.id() == "CL0302" && last.message.contains(says), "{name}: {}", last.message);
        let label = &last.labels[0];
        assert!(String::from_utf8_lossy(label.source.slice(label.span)).contains(name));
    }
    let away = operation(&[in_plane(&[(2.0, 0.0), (38.0, 0.0)], [500.0, 0.0], 90.0)]);
    let found = compensate_beside(recipe.to_str().unwrap(), "radius: 5, against: { mesh: roof.stl }", &away)
        .err()
        .unwrap();
    assert!(found.last().unwrap().message.contains("nothing of the model"));
}

#[test]
fn an_unmarked_link_above_the_model_is_no_cut() {
    let (_folder, recipe) = roof("roof.stl", 12.0);
    let text = "TOOL PATH/A,TOOL,B\nTLDATA/MILL,10.0000,5.0000,60.0000,0.0000,0.0000\nRAPID\nGOTO/5.0000,10.0000,40.0000,0.0000000,0.0000000,1.0000000\nFEDRAT/MMPM,300.0000\n\
        GOTO/5.0000,10.0000,2.0000\nFEDRAT/MMPM,900.0000\nGOTO/30.0000,10.0000,12.0000\nGOTO/55.0000,10.0000,2.0000\nFEDRAT/MMPM,5000.0000\nGOTO/55.0000,10.0000,40.0000\n\
        GOTO/5.0000,20.0000,40.0000\nFEDRAT/MMPM,300.0000\nGOTO/5.0000,20.0000,2.0000\nFEDRAT/MMPM,900.0000\nGOTO/30.0000,20.0000,12.0000\nGOTO/55.0000,20.0000,2.0000\nRAPID\nGOTO/55.0000,20.0000,40.0000\nEND-OF-PATH\n";
    let done =
        compensate_beside(recipe.to_str().unwrap(), "radius: 5, against: { mesh: roof.stl }", text).unwrap();
    assert_eq!(done.report.passes.len(), 2);
    assert!(
        done.text.contains("GOTO/55.0000,10.0000,40.0000\nGOTO/5.0000,20.0000,40.0000\n"),
        "{}",
        done.text
    );
    let fast = done.program.motions().filter(|motion| motion.feed.is_some_and(|feed| feed.value == 5000.0));
    assert!(fast.filter(|motion| !motion.rapid).all(|motion| motion.to.point.z >= 40.0));
}
