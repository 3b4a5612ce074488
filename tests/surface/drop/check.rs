//! The independent look at paths, where the answer is known.

use super::super::solids::{cube, mesh, sphere};
use super::cutters;
use clsmith::internals::surface::drop_cutter::{DropCutterShape, measure_deviation};

#[test]
fn depth_and_height_over_a_plane() {
    let block = mesh(&cube([-50.0, -50.0, -30.0], [50.0, 50.0, 0.0]));
    for cutter in cutters() {
        let path = [[-10.0, 0.0, 0.2], [0.0, 0.0, -0.3], [10.0, 0.0, 1.0]];
        let found = measure_deviation(&block, cutter, &path, 0.01).unwrap();
        assert!((found.gouge_mm - 0.3).abs() <= 0.01, "{found:?}");
        assert_eq!(found.gouge_at_mm, [0.0, 0.0, -0.3]);
        assert!((found.gap_mm - 1.0).abs() <= 0.01, "{found:?}");
        assert_eq!(found.gap_at_mm, [10.0, 0.0, 1.0]);
        let far = measure_deviation(&block, cutter, &[[0.0, 0.0, 20.0]], 0.01).unwrap();
        assert_eq!((far.gouge_mm, far.gap_mm), (0.0, 5.0), "a gap is told up to the radius");
    }
    let ball = DropCutterShape::ball(1.0).unwrap();
    assert_eq!(measure_deviation(&block, ball, &[], 0.01), None);
    assert_eq!(measure_deviation(&block, ball, &[[0.0, f64::NAN, 0.0]], 0.01), None);
}

#[test]
fn a_wall_is_cut_from_the_side() {
    let block = mesh(&cube([0.0, -50.0, -30.0], [50.0, 50.0, 30.0]));
    for cutter in cutters() {
        let found = measure_deviation(&block, cutter, &[[-4.6, 0.0, 0.0], [-4.6, 9.0, 0.0]], 0.01).unwrap();
        assert!((found.gouge_mm - 0.4).abs() <= 0.01, "{found:?}");
        let found = measure_deviation(&block, cutter, &[[-5.6, 0.0, 0.0], [-5.3, 9.0, 0.0]], 0.01).unwrap();
        assert!(found.gouge_mm == 0.0 && (found.gap_mm - 0.6).abs() <= 0.01, "{found:?}");
    }
}

#[test]
fn a_ball_beside_a_ball() {
    let ball = mesh(&sphere(10.0, 80));
    let sagitta = 10.0 * (1.0 - (std::f64::consts::PI / 80.0).cos());
    let cutter = DropCutterShape::ball(6.0).unwrap();
    for (at, distance) in [([8.0, 0.0, 7.0], f64::hypot(8.0, 10.0) - 13.0), ([3.0, 4.0, 9.0], 13.0 - 13.0)] {
        let found = measure_deviation(&ball, cutter, &[at], 1e-3).unwrap();
        assert!((found.gap_mm - found.gouge_mm - distance).abs() <= sagitta + 1e-3, "{found:?} {distance}");
    }
}
