//! Paths over meshes.

use super::super::solids::{Triangles, cube, mesh, needle, terrain};
use super::{cutters, over, tip};
use clsmith::internals::surface::drop_cutter::{
    CutterClearanceField, DropCutter, DropCutterShape, measure_deviation,
};

fn waves() -> Triangles {
    terrain(30.0, 60, |x, y| 2.0 * (x / 4.0).sin() * (y / 5.0).cos())
}

/// The highest and lowest that a path is over the true height, looked at every 0.01 mm.
fn off(drop: &DropCutter, path: &[[f64; 3]]) -> [f64; 2] {
    let mut found = [0.0_f64; 2];
    for pair in path.windows(2) {
        let ([x0, y0, z0], [x1, y1, z1]) = (pair[0], pair[1]);
        let count = (f64::hypot(x1 - x0, y1 - y0) / 0.01).ceil() as u32;
        for i in 0..=count {
            let t = f64::from(i) / f64::from(count.max(1));
            let over = z0 + (z1 - z0) * t - tip(drop, x0 + (x1 - x0) * t, y0 + (y1 - y0) * t);
            found = [found[0].max(over), found[1].min(over)];
        }
    }
    found
}

#[test]
fn chords_over_waves_are_long_and_near() {
    let solid = waves();
    for cutter in cutters() {
        let drop = over(&solid, cutter);
        let mut counts = Vec::new();
        for tolerance in [0.1, 0.01] {
            let line = [[-25.0, -7.0], [20.0, 3.0], [20.0, 5.0]];
            let paths = drop.follow_line(&line, tolerance);
            assert_eq!(paths.len(), 1);
            let path = &paths[0];
            assert_eq!(path[0][..2], line[0]);
            assert!(path.iter().any(|point| point[..2] == line[1]), "corners stay");
            assert_eq!(path[path.len() - 1][..2], line[2]);
            let [above, below] = off(&drop, path);
            assert!(above <= tolerance && below >= -tolerance, "{cutter:?} {above} {below}");
            counts.push(path.len());
        }
        assert!(counts[0] < 60 && counts[1] < 260, "{counts:?}");
        assert!(counts[0] < counts[1]);
    }
}

#[test]
fn a_plane_takes_two_points() {
    for cutter in cutters() {
        let drop = over(&terrain(30.0, 9, |x, y| 0.4 * x - 0.1 * y), cutter);
        let paths = drop.follow_line(&[[-12.0, -3.0], [11.0, 14.0]], 0.01);
        assert_eq!(paths.iter().map(Vec::len).collect::<Vec<_>>(), [2]);
    }
}

#[test]
fn needles_between_samples_are_found() {
    // A bed of needles just high enough to be cut into, at places that no step meets.
    let mut solid = terrain(30.0, 1, |_, _| 0.0);
    for i in 0..60 {
        let [x, y] = [0.61803, 0.41421].map(|step| 50.0 * (f64::from(i) * step).fract() - 25.0);
        solid.extend(needle([x, y / 5.0, 1.0 + f64::from(i % 7)]));
    }
    let mesh = mesh(&solid);
    for cutter in cutters() {
        let drop = DropCutter::new(&mesh, cutter);
        let paths = drop.follow_line(&[[-24.0, 0.3], [24.0, 0.7]], 0.02);
        let looked = measure_deviation(&mesh, cutter, &paths[0], 0.005).unwrap();
        assert!(looked.gouge_mm <= 0.02, "{looked:?}");
        assert!(looked.gap_mm <= 0.05, "{looked:?}");
    }
}

#[test]
fn steps_go_up_beside_the_wall() {
    let mut solid = cube([-20.0, -20.0, -9.0], [20.0, 20.0, 0.0]);
    solid.extend(cube([3.0, -5.0, -1.0], [7.0, 5.0, 4.0]));
    let flat = DropCutterShape::flat(6.0).unwrap();
    let drop = over(&solid, flat);
    let path = drop.follow_line(&[[-10.0, 0.0], [15.0, 0.0]], 0.01).remove(0);
    let heights: Vec<f64> = path.iter().map(|point| point[2]).collect();
    assert_eq!(heights, [0.0, 0.0, 4.0, 4.0, 0.0, 0.0], "{path:?}");
    assert!((path[1][0] - 0.0).abs() <= 0.01 && path[1][0] == path[2][0], "{path:?}");
    assert!((path[3][0] - 10.0).abs() <= 0.01 && path[3][0] == path[4][0], "{path:?}");
    let looked = measure_deviation(&mesh(&solid), flat, &path, 0.002).unwrap();
    assert!(looked.gouge_mm <= 0.002, "{looked:?}");
}

#[test]
fn stretches_without_material_part_the_path() {
    let mut solid = cube([-20.0, -5.0, -1.0], [-10.0, 5.0, 0.0]);
    solid.extend(cube([10.0, -5.0, -1.0], [20.0, 5.0, 2.0]));
    for cutter in cutters() {
        let paths =
            over(&solid, cutter).follow_line(&[[-40.0, 0.0], [0.0, 0.0], [0.0, 0.0], [40.0, 0.0]], 0.01);
        let ends: Vec<[f64; 2]> = paths.iter().map(|path| [path[0][0], path[path.len() - 1][0]]).collect();
        assert_eq!(ends.len(), 2);
        for (found, expected) in ends.iter().flatten().zip([-25.0, -5.0, 5.0, 25.0]) {
            assert!((found - expected).abs() <= 0.01, "{ends:?}");
        }
    }
    let drop = over(&solid, cutters()[0]);
    assert!(drop.follow_line(&[[0.0, 0.0], [f64::INFINITY, 0.0]], 0.01).is_empty());
    assert!(drop.follow_line(&[[0.0, 0.0]], 0.01).is_empty());
    assert!(drop.follow_line(&[], 0.01).is_empty());
    assert_eq!(drop.follow_line(&[[-15.0, 0.0], [-14.0, 0.0]], f64::NAN)[0].len(), 2);
}

#[test]
fn wide_steps_find_what_fine_ones_find() {
    let solid = waves();
    for cutter in cutters() {
        let drop = over(&solid, cutter);
        let field = CutterClearanceField::new(&mesh(&solid), cutter);
        let path = &drop.follow_line(&[[-25.0, -7.0], [20.0, 3.0]], 0.02)[0];
        // Into the waves by a known depth, too.
        for lowered in [0.0, 0.05] {
            let path: Vec<[f64; 3]> = path.iter().map(|[x, y, z]| [*x, *y, z - lowered]).collect();
            let fine = field.measure_path(&path, 0.005, 0.002).unwrap();
            let wide = field.measure_path(&path, field.widest_step_mm(0.001), 0.002).unwrap();
            assert!((fine.gouge_mm - wide.gouge_mm).abs() <= 0.004, "{cutter:?} {fine:?} {wide:?}");
            assert!(wide.gap_mm <= fine.gap_mm + 0.004, "{cutter:?} {fine:?} {wide:?}");
        }
    }
}
