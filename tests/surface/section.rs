//! Vertical sections of meshes.

use super::solids::{Triangles, cube, mesh, sphere, terrain, tetrahedron};
use clsmith::internals::surface::mesh_section::{VerticalMeshSections, section_mesh};
use proptest::prelude::*;
use std::f64::consts::FRAC_PI_2;

/// The height of chains at u.
fn at(chains: &[Vec<[f64; 2]>], u: f64) -> Option<f64> {
    let pairs = chains.iter().flat_map(|chain| chain.windows(2));
    pairs
        .filter(|pair| pair[0][0] <= u && u <= pair[1][0] && pair[0][0] < pair[1][0])
        .map(|pair| pair[0][1] + (pair[1][1] - pair[0][1]) * (u - pair[0][0]) / (pair[1][0] - pair[0][0]))
        .reduce(f64::max)
}

#[test]
fn a_box_and_the_planes_of_its_walls() {
    let solid = mesh(&cube([1.0, 2.0, -3.0], [5.0, 9.0, 4.0]));
    for y in [2.0, 2.5, 9.0] {
        assert_eq!(section_mesh(&solid, 0.0, y), [[[1.0, 4.0], [5.0, 4.0]]], "{y}");
    }
    for x in [1.0, 3.0, 5.0] {
        let found = section_mesh(&solid, FRAC_PI_2, -x);
        assert_eq!(found.len(), 1, "{x}");
        for (found, expected) in found[0].iter().flatten().zip([2.0, 4.0, 9.0, 4.0]) {
            assert!((found - expected).abs() < 1e-12, "{x}");
        }
    }
    for y in [1.9, 9.1, f64::NAN, f64::INFINITY, -1e300] {
        assert!(section_mesh(&solid, 0.0, y).is_empty());
    }
}

#[test]
fn a_step_is_upright_and_a_hole_parts() {
    let mut solid = cube([0.0, 0.0, 0.0], [10.0, 4.0, 1.0]);
    solid.extend(cube([4.0, 0.0, 1.0], [6.0, 4.0, 3.0]));
    solid.extend(cube([15.0, 0.0, 0.0], [16.0, 4.0, 2.0]));
    for y in [0.0, 1.0, 2.0, 4.0] {
        let found = section_mesh(&mesh(&solid), 0.0, y);
        let first = [[0.0, 1.0], [4.0, 1.0], [4.0, 3.0], [6.0, 3.0], [6.0, 1.0], [10.0, 1.0]];
        assert_eq!(found, [first.to_vec(), vec![[15.0, 2.0], [16.0, 2.0]]], "{y}");
    }
}

#[test]
fn a_ball_is_a_circle_above() {
    let solid = mesh(&sphere(10.0, 60));
    let sections = VerticalMeshSections::new(&solid, 0.7);
    let (low, high) = sections.offset_range();
    assert!((-10.0..-9.98).contains(&low) && high <= 10.0 && high > 9.98);
    for i in -19..20 {
        let offset = f64::from(i) / 2.0;
        let chains = sections.section_at(offset);
        assert_eq!(chains.len(), 1);
        let radius = f64::sqrt(100.0 - offset * offset);
        for u in (-9..=9).map(|j| f64::from(j) / 10.0 * radius) {
            let exact = (radius * radius - u * u).sqrt();
            let found = at(&chains, u).unwrap();
            assert!(found <= exact + 1e-9 && found >= exact - 0.02 * 10.0 / exact.max(0.1), "{offset} {u}");
        }
        let [x, y, z] = sections.point_at(offset, chains[0][1]);
        assert!(x.hypot(y).hypot(z) <= 10.0 + 1e-9);
    }
}

#[test]
fn planes_through_vertices_and_along_edges() {
    let tip = mesh(&tetrahedron([[-6.0, -3.0, 0.0], [6.0, -3.0, 0.0], [0.0, 6.0, 0.0], [0.0, 0.0, 5.0]]));
    // Through the tip: up one side and down the other.
    let found = section_mesh(&tip, 0.0, 0.0);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].len(), 3);
    for (found, expected) in found[0].iter().flatten().zip([-4.0, 0.0, 0.0, 5.0, 4.0, 0.0]) {
        assert!((found - expected).abs() < 1e-12);
    }
    // Along the edge from the tip to the far corner.
    let found = section_mesh(&tip, FRAC_PI_2, 0.0);
    for (u, z) in [(-3.0, 0.0), (-1.5, 2.5), (0.0, 5.0), (3.0, 2.5), (6.0, 0.0)] {
        assert!((at(&found, u).unwrap() - z).abs() < 1e-9, "{found:?}");
    }
    // A terrain on the lines of its own grid.
    let hills = mesh(&terrain(8.0, 16, |x, y| (x - y).sin() + x.cos()));
    let sections = VerticalMeshSections::new(&hills, 0.0);
    for y in -8..=8 {
        let chains = sections.section_at(f64::from(y));
        assert_eq!(chains.len(), 1);
        for x in -8..=8 {
            let (x, y) = (f64::from(x), f64::from(y));
            assert!((at(&chains, x).unwrap() - ((x - y).sin() + x.cos())).abs() < 1e-12);
        }
    }
}

/// The highest place of a solid over a point, by looking at every triangle.
fn highest(solid: &Triangles, x: f64, y: f64) -> Option<f64> {
    let over = |[a, b, c]: &[[f64; 3]; 3]| {
        let cross = |p: [f64; 3], q: [f64; 3], x: f64, y: f64| {
            (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])
        };
        let area = cross(*a, *b, c[0], c[1]);
        let [u, v, w] = [cross(*b, *c, x, y) / area, cross(*c, *a, x, y) / area, cross(*a, *b, x, y) / area];
        (u >= 0.0 && v >= 0.0 && w >= 0.0).then(|| u * a[2] + v * b[2] + w * c[2])
    };
    solid.iter().filter_map(over).reduce(f64::max)
}

proptest! {
    #![proptest_config(crate::support::property(300))]

    #[test]
    fn tetrahedra_through_each_other(
        corners in proptest::collection::vec([[-8.0..8.0_f64, -8.0..8.0, -8.0..8.0], [-8.0..8.0, -8.0..8.0, -8.0..8.0],
            [-8.0..8.0, -8.0..8.0, -8.0..8.0], [-8.0..8.0, -8.0..8.0, -8.0..8.0]], 1..6),
        angle in -4.0..4.0_f64, offset in -5.0..5.0_f64,
    ) {
        let solid: Triangles = corners.into_iter().flat_map(tetrahedron).collect();
        let sections = VerticalMeshSections::new(&mesh(&solid), angle);
        let chains = sections.section_at(offset);
        for chain in &chains {
            prop_assert!(chain.len() >= 2);
            prop_assert!(chain.windows(2).all(|pair| pair[0][0] <= pair[1][0]));
        }
        prop_assert!(chains.windows(2).all(|pair| pair[0][pair[0].len() - 1][0] < pair[1][0][0]));
        for i in 0..60 {
            let u = -11.9 + 0.4 * f64::from(i);
            let [x, y, _] = sections.point_at(offset, [u, 0.0]);
            match (at(&chains, u), highest(&solid, x, y)) {
                (Some(found), Some(expected)) => prop_assert!((found - expected).abs() < 1e-6, "{found} {expected}"),
                (None, None) => {}
                (found, expected) => prop_assert!(false, "{u}: {found:?} {expected:?}"),
            }
        }
    }
}
