//! Parts whose tip path is known in closed form.

use super::{of_class, options, over};
use crate::surface::solids::{Triangles, cube, mesh, sphere};
use clsmith::program::MotionClass;
use clsmith::surface_milling::{PassHeights, PassPlanes, SurfaceMillingOptions};

/// From z = 0 up to a roof: a prism along y (60 mm in x, 20 mm in y), turned about z.
fn roof(points: &[[f64; 2]], degrees: f64) -> Triangles {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let at = |[x, z]: [f64; 2], y: f64| [x * cos - y * sin, x * sin + y * cos, z];
    let low = |[x, _]: [f64; 2]| [x, 0.0];
    let quad = |[a, b, c, d]: [[f64; 3]; 4]| [[a, b, c], [a, c, d]];
    let mut all = Vec::new();
    for pair in points.windows(2) {
        let (p, q) = (pair[0], pair[1]);
        all.extend(quad([at(p, 0.0), at(q, 0.0), at(q, 20.0), at(p, 20.0)]));
        all.extend(quad([at(low(p), 0.0), at(low(p), 20.0), at(low(q), 20.0), at(low(q), 0.0)]));
        all.extend(quad([at(low(p), 0.0), at(low(q), 0.0), at(q, 0.0), at(p, 0.0)]));
        all.extend(quad([at(p, 20.0), at(q, 20.0), at(low(q), 20.0), at(low(p), 20.0)]));
    }
    for (end, other) in [(points[0], 0.0), (points[points.len() - 1], 20.0)] {
        let back = 20.0 - other;
        all.extend(quad([at(low(end), other), at(end, other), at(end, back), at(low(end), back)]));
    }
    // What has no height at the ends has no area there.
    all.retain(|[a, b, c]| a != b && b != c && c != a);
    all
}

/// Half a cylinder of radius 15 about a level axis along y, in chords of a degree.
fn half_cylinder(degrees: f64) -> Triangles {
    let points: Vec<[f64; 2]> = (0..=180)
        .map(|i| {
            let (sin, cos) = (180.0 - f64::from(i)).to_radians().sin_cos();
            [15.0 * cos, if i % 180 == 0 { 0.0 } else { 15.0 * sin }]
        })
        .collect();
    roof(&points, degrees)
}

/// The sagitta of a chord of a degree on radius 15, mm.
const FACET: f64 = 15.0 * 3.8e-5;

#[test]
fn a_flat_block_is_one_line_a_plane() {
    let block = mesh(&cube([0.0, 0.0, 0.0], [60.0, 20.0, 10.0]));
    for (planes, passes, length) in [(PassPlanes::ZX, 11, 60.0), (PassPlanes::YZ, 31, 20.0)] {
        for against in [PassHeights::Mesh, PassHeights::Profile] {
            let surfaced = over(&block, &SurfaceMillingOptions { planes, against, ..options() });
            assert_eq!(
                (surfaced.planes, surfaced.passes, surfaced.cutting_motion_count()),
                (passes, passes, passes)
            );
            assert!((surfaced.cutting_length_mm() - length * passes as f64).abs() < 1e-6);
            for (from, to) in of_class(&surfaced, MotionClass::Cut) {
                assert_eq!((from.to.z, to.to.z), (10.0, 10.0));
            }
            assert!(
                surfaced.proof.gap_mm <= surfaced.proof.bound_mm && surfaced.proof.gouge_mm < 1e-9,
                "{:?}",
                surfaced.proof
            );
        }
    }
}

#[test]
fn a_wedge_of_thirty_degrees_is_shifted_by_its_normal() {
    let rise = 30f64.to_radians().tan();
    // A foot at the lower end, so that the part has a height there.
    let wedge = mesh(&roof(&[[0.0, 10.0], [60.0, 10.0 + 60.0 * rise]], 0.0));
    let surfaced = over(&wedge, &options());
    for (from, to) in of_class(&surfaced, MotionClass::Cut) {
        for at in [from.to, to.to] {
            // tip = contact + R (n - z): up by R (1 / cos - 1) above the slope, everywhere.
            let above = 10.0 + at.x * rise + 5.0 * (1.0 / 30f64.to_radians().cos() - 1.0);
            assert!((at.z - above).abs() < 0.01 / 30f64.to_radians().cos(), "{at}: {above}");
        }
    }
    let starts: Vec<f64> = of_class(&surfaced, MotionClass::Cut).iter().map(|(from, _)| from.to.x).collect();
    let lowest = starts.iter().copied().fold(f64::INFINITY, f64::min);
    assert!((lowest - -2.5).abs() < 0.01, "the ball stands on the lower edge: u - R sin 30, not {lowest}");
}

#[test]
fn half_a_cylinder_along_any_direction_is_a_larger_one_lowered() {
    let across = [
        (PassPlanes::ZX, 0.0),
        (PassPlanes::YZ, 90.0),
        (PassPlanes::from_degrees(30.0), 30.0),
        (PassPlanes::from_degrees(75.0), 30.0),
    ];
    for (planes, degrees) in across {
        let part = mesh(&half_cylinder(degrees));
        let (sin, cos) = f64::to_radians(degrees).sin_cos();
        for arcs in [false, true] {
            let surfaced = over(&part, &SurfaceMillingOptions { planes, arcs, step_mm: 5.0, ..options() });
            assert!(surfaced.passes >= 3);
            for (from, to) in of_class(&surfaced, MotionClass::Cut) {
                for at in [from.to, to.to] {
                    // Only where the ball is on the cylinder, not on the edge of its ends.
                    let y = at.y * cos - at.x * sin;
                    let off = (at.x * cos + at.y * sin).hypot(at.z + 5.0) - 20.0;
                    if (5.0..=15.0).contains(&y) {
                        assert!(off.abs() < 0.01 + FACET, "{at}: {off}");
                    }
                    assert!(off < 0.01 && at.z > -1e-9, "{at}: {off}");
                }
            }
        }
    }
}

#[test]
fn a_ball_goes_round_a_sphere_on_a_larger_one_lowered() {
    let part = mesh(&sphere(12.0, 40));
    let surfaced = over(&part, &SurfaceMillingOptions { floor_mm: Some(0.0), step_mm: 3.0, ..options() });
    let off_facets = 12.0 * (1.0 - (std::f64::consts::PI / 80.0).cos()) * 2.0;
    for (from, to) in of_class(&surfaced, MotionClass::Cut) {
        for at in [from.to, to.to] {
            let off = (at - nalgebra::Point3::new(0.0, 0.0, -5.0)).norm() - 17.0;
            assert!(off < 0.01 && off > -0.01 - off_facets, "{at}: {off}");
            assert!(at.z >= -1e-6, "{at}: not below the floor");
        }
    }
    assert_eq!(surfaced.planes, 7, "where the plane only touches, and where the floor is, nothing is cut");
}

#[test]
fn the_profile_in_the_plane_alone_gouges_beside_it() {
    let slope: Triangles = roof(&[[0.0, 5.0], [60.0, 40.0]], 90.0);
    let part = clsmith::surface_milling::SurfacePart::Mesh(mesh(&slope));
    // Planes across the slope: level lines, and the ball is in the hill beside.
    let options = SurfaceMillingOptions { against: PassHeights::Profile, ..options() };
    let surfaced = clsmith::surface_milling::make_surface_program(&part, &options).unwrap();
    let secant = (1.0 + (35.0f64 / 60.0).powi(2)).sqrt();
    // On the level line the centre is R above the slope's line, so R / secant from the slope itself.
    assert!((surfaced.proof.gouge_mm - (5.0 - 5.0 / secant)).abs() < 0.001, "{:?}", surfaced.proof);
    assert!(!surfaced.proof.is_within(options.tolerance_mm));
    assert!(
        over(&mesh(&slope), &SurfaceMillingOptions { against: PassHeights::Mesh, ..options }).proof.gouge_mm
            < 0.01
    );
}
