//! The workpiece in layers.

use super::area::{circle, square, star, turned};
use super::brute;
use crate::stock::shapes::{cube, mesh, sphere};
use clsmith::internals::layered_chips::swept_area::LayerSweptArea;
use clsmith::layered_chips::{LayerRemoval, LayerStack, LayerStackError, Polygon};
use clsmith::stock::{DexelGrid, Dexels, Mesh, SolidBody, Stock};
use proptest::prelude::*;
use std::f64::consts::PI;
use std::sync::Arc;

fn block(from: [f64; 3], to: [f64; 3]) -> SolidBody {
    SolidBody::Block { from, to }
}

pub fn stack_of(
    bodies: Vec<SolidBody>,
    allowance: f64,
    thickness: f64,
) -> Result<LayerStack, LayerStackError> {
    LayerStack::new(&Stock::new(bodies, allowance).unwrap(), thickness)
}

fn plate(size: f64, corners: usize) -> LayerStack {
    let stock = Stock::new(vec![block([0.0; 3], [size, size, 1.0])], 0.0).unwrap();
    LayerStack::with_max_vertices(&stock, 1.0, corners).unwrap()
}

/// A step of an upright cutter: from one place to another, with a half circle in front.
fn step(from: [f64; 2], to: [f64; 2], radius: f64, corners: usize) -> LayerSweptArea {
    let heading = f64::atan2(to[1] - from[1], to[0] - from[0]);
    let half = |[x, y]: [f64; 2]| {
        (0..=corners / 2).map(move |index| {
            let (sin, cos) = (heading + PI * (2.0 * index as f64 / corners as f64 - 0.5)).sin_cos();
            [x + radius * cos, y + radius * sin]
        })
    };
    let advancing = half(to).chain(turned(half(from).collect())).collect();
    LayerSweptArea {
        first: circle(from, radius, corners),
        last: circle(to, radius, corners),
        advancing: vec![advancing],
        ..LayerSweptArea::default()
    }
}

#[test]
fn layers_fill_the_stock_and_the_last_is_thin() {
    let stack = stack_of(vec![block([1.0, 2.0, -3.0], [11.0, 22.0, -1.75])], 0.0, 0.5).unwrap();
    let layers: Vec<(usize, f64, f64)> = stack
        .layers()
        .iter()
        .map(|layer| (layer.number(), layer.middle_z_mm(), layer.thickness_mm()))
        .collect();
    assert_eq!(layers, [(0, -2.75, 0.5), (1, -2.25, 0.5), (2, -1.875, 0.25)]);
    assert_eq!(stack.bounds(), ([1.0, 2.0, -3.0], [11.0, 22.0, -1.75]));
    assert_eq!(stack.volume_mm3(), 250.0);
    let polygons = stack.layers()[2].remaining_polygons();
    assert_eq!((polygons.len(), polygons[0].outer.len(), polygons[0].area_mm2()), (1, 4, 200.0));
    // 0.3 / 0.1 is a little less than 3, and 0.7 / 0.1 a little less than 7.
    for (height, count) in [(0.3, 3), (0.7, 7), (0.95, 10)] {
        let block = block([0.0; 3], [1.0, 1.0, height]);
        assert_eq!(stack_of(vec![block], 0.0, 0.1).unwrap().layers().len(), count);
    }
}

#[test]
fn what_has_no_layers_is_refused_with_the_reason() {
    let unit = || block([0.0; 3], [1.0; 3]);
    let refused = |bodies, allowance, thickness| stack_of(bodies, allowance, thickness).unwrap_err();
    for thickness in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = refused(vec![unit()], 0.0, thickness);
        assert!(matches!(error, LayerStackError::Thickness { .. }), "{error}");
    }
    assert!(matches!(refused(vec![unit()], 0.0, 1e-9), LayerStackError::TooMany { layers: 1e9, .. }));
    let long = block([0.0; 3], [2e5, 1.0, 1.0]);
    assert_eq!(refused(vec![long], 0.0, 1.0), LayerStackError::TooLarge { size: 2e5 });
    let part = SolidBody::Mesh(Arc::new(mesh(&cube([0.0; 3], [1.0; 3]))));
    assert_eq!(refused(vec![unit(), part.clone()], 0.5, 1.0), LayerStackError::Allowance { allowance: 0.5 });
    assert!(stack_of(vec![part], 0.0, 1.0).is_ok());
    let mut dexels = Dexels::with_empty_columns(DexelGrid {
        origin_mm: [0.0; 2],
        base_mm: 0.0,
        cell_mm: 1.0,
        columns: 1,
        rows: 1,
    });
    dexels.set_column(0, 0, &[[0.0, 1.0]]);
    let remains = SolidBody::Remains(Arc::new(dexels));
    assert_eq!(refused(vec![remains], 0.0, 1.0), LayerStackError::Remains);
    assert!(LayerStackError::Remains.to_string().contains(".clstock"));
}

#[test]
fn allowance_grows_blocks_and_cylinders() {
    let grown = stack_of(vec![block([0.0; 3], [10.0; 3])], 1.5, 0.5).unwrap();
    assert_eq!(grown.volume_mm3(), 13.0 * 13.0 * 13.0);
    let upright = SolidBody::Cylinder { diameter: 20.0, from: [5.0, 5.0, 0.0], to: [5.0, 5.0, 10.0] };
    let grown = stack_of(vec![upright], 1.0, 0.5).unwrap();
    assert!((grown.volume_mm3() - PI * 121.0 * 12.0).abs() < 1e-2, "{}", grown.volume_mm3());
}

/// Area of a cylinder's section by counting places.
fn counted(from: [f64; 3], to: [f64; 3], radius: f64, z: f64) -> f64 {
    let axis = nalgebra::Vector3::from(to) - nalgebra::Vector3::from(from);
    let (length, axis) = (axis.norm(), axis.normalize());
    let cell = 0.1;
    let inside = |x: f64, y: f64| {
        let at = nalgebra::Vector3::new(x, y, z) - nalgebra::Vector3::from(from);
        let along = at.dot(&axis);
        (0.0..=length).contains(&along) && (at - axis * along).norm() <= radius
    };
    let places = |low: f64| (0..600).map(move |index| low + (index as f64 + 0.5) * cell);
    let count =
        places(-30.0).flat_map(|x| places(-30.0).map(move |y| (x, y))).filter(|(x, y)| inside(*x, *y));
    count.count() as f64 * cell * cell
}

#[test]
fn cylinders_have_their_sections_however_they_lie() {
    let far = |to: [f64; 3]| ([0.0, 0.0, 0.0], to);
    let ends = [
        far([0.0, 0.0, 20.0]),
        far([20.0, 0.0, 0.0]),
        far([12.0, -16.0, 0.0]),
        far([14.0, 0.0, 14.0]),
        far([-5.0, 9.0, -18.0]),
        far([15.0, 15.0, 0.01]),
        far([0.001, 0.0, 15.0]),
        far([1e-9, 0.0, 15.0]),
        far([15.0, 0.0, 1e-9]),
        far([6.0, 2.0, -1.0]),
    ];
    for (from, to) in ends {
        let stack = stack_of(vec![SolidBody::Cylinder { diameter: 14.0, from, to }], 0.0, 1.7).unwrap();
        for layer in stack.layers().iter().step_by(4) {
            let (found, expected) = (layer.area_mm2(), counted(from, to, 7.0, layer.middle_z_mm()));
            assert!(
                (found - expected).abs() < 0.1 * 22.0,
                "{to:?} {} {found} {expected}",
                layer.middle_z_mm()
            );
        }
        let fine = stack_of(vec![SolidBody::Cylinder { diameter: 14.0, from, to }], 0.0, 0.02).unwrap();
        let length = (0..3).map(|i| (to[i] - from[i]).powi(2)).sum::<f64>().sqrt();
        let volume = PI * 49.0 * length;
        assert!((fine.volume_mm3() / volume - 1.0).abs() < 1e-3, "{to:?} {} {volume}", fine.volume_mm3());
    }
}

#[test]
fn an_upright_cylinders_layer_has_its_exact_area() {
    let upright = SolidBody::Cylinder { diameter: 80.0, from: [300.0, 5.0, 10.0], to: [300.0, 5.0, 0.0] };
    let stack = stack_of(vec![upright], 0.0, 10.0).unwrap();
    assert!((stack.volume_mm3() / (PI * 16000.0) - 1.0).abs() < 1e-8, "{}", stack.volume_mm3());
}

#[test]
fn bodies_are_one_workpiece() {
    let one = block([0.0; 3], [10.0, 10.0, 4.0]);
    let other = block([5.0, 0.0, 2.0], [15.0, 10.0, 6.0]);
    let ball = SolidBody::Mesh(Arc::new(mesh(&cube([20.0, 0.0, 0.0], [22.0, 2.0, 6.0]))));
    let stack = stack_of(vec![one, other, ball], 0.0, 1.0).unwrap();
    let areas: Vec<f64> = stack.layers().iter().map(|layer| layer.area_mm2()).collect();
    assert_eq!(areas, [104.0, 104.0, 154.0, 154.0, 104.0, 104.0]);
    assert_eq!(stack.layers()[2].remaining_polygons().len(), 2);
}

#[test]
fn a_mesh_is_cut_level_also_through_its_corners() {
    // A corner, an edge and a face exactly in the middle of layers.
    let mut solid = cube([0.0, 0.0, 0.0], [10.0, 10.0, 1.5]);
    solid.extend(cube([2.0, 2.0, 1.5], [6.0, 6.0, 4.0]));
    let found = stack_of(vec![SolidBody::Mesh(Arc::new(mesh(&solid)))], 0.0, 1.0).unwrap();
    let areas: Vec<f64> = found.layers().iter().map(|layer| layer.area_mm2()).collect();
    // The lower cube's face at 1.5 counts as above the plane: the plane is in the lower one still.
    assert_eq!(areas, [100.0, 100.0, 16.0, 16.0]);
    let tip = [[0.0, 0.0, -0.5], [2.0, 0.0, 0.5], [0.0, 2.0, 0.5], [0.0, 0.0, 1.5]];
    let [a, b, c, d] = tip;
    let solid = mesh(&vec![[a, c, b], [d, b, c], [a, b, d], [a, d, c]]);
    let found = stack_of(vec![SolidBody::Mesh(Arc::new(solid))], 0.0, 2.0).unwrap();
    assert_eq!(found.layers().len(), 1);
    assert!((found.volume_mm3() - 4.0).abs() < 1e-9);
}

#[test]
fn shells_in_shells_are_hollow_or_one() {
    let around = cube([0.0; 3], [10.0; 3]);
    let within = cube([2.0; 3], [8.0; 3]);
    let hollow: Vec<_> = within.iter().map(|[a, b, c]| [*c, *b, *a]).collect();
    let both = |inner: &[[[f64; 3]; 3]]| mesh(&around.iter().chain(inner).copied().collect());
    let area = |mesh: Mesh| {
        stack_of(vec![SolidBody::Mesh(Arc::new(mesh))], 0.0, 2.0).unwrap().layers()[2].area_mm2()
    };
    assert_eq!(area(both(&within)), 100.0);
    assert_eq!(area(both(&hollow)), 64.0);
    // A hollow does not take away from another body.
    let filled = vec![SolidBody::Mesh(Arc::new(both(&hollow))), block([3.0; 3], [7.0; 3])];
    assert_eq!(stack_of(filled, 0.0, 2.0).unwrap().layers()[2].area_mm2(), 80.0);
}

#[test]
fn a_spheres_layers_hold_its_volume() {
    let ball = mesh(&sphere([3.0, 4.0, 5.0], 10.0, 60));
    let volume = ball.volume_mm3();
    let [coarse, fine] = [2.0, 0.1].map(|thickness| {
        let found =
            stack_of(vec![SolidBody::Mesh(Arc::new(ball.clone()))], 0.0, thickness).unwrap().volume_mm3();
        (found / volume - 1.0).abs()
    });
    assert!(fine < 1e-4 && fine < coarse / 10.0 && coarse < 0.02, "{coarse} {fine}");
}

#[test]
fn a_step_in_full_material_is_two_circles_hull_less_the_first() {
    let mut stack = plate(60.0, 256);
    let layer = &mut stack.layers_mut()[0];
    let disc = brute::area(&brute::dense_union(&[circle([30.0, 30.0], 5.0, 200)]));
    let removed = layer.remove_swept_area(&step([30.0, 30.0], [30.5, 30.0], 5.0, 200));
    assert!((removed.inside_mm2 - disc).abs() < 1e-4);
    assert!((removed.area_mm2 - 5.0).abs() < 1e-3, "{}", removed.area_mm2);
    assert_eq!(removed.pieces.len(), 1);
    assert!((removed.pieces[0].area_mm2() - removed.area_mm2).abs() < 1e-9);
    // The next goes on where it ended.
    let next = layer.remove_swept_area(&step([30.5, 30.0], [31.0, 30.0], 5.0, 200));
    assert!((next.area_mm2 - 5.0).abs() < 1e-3 && next.inside_mm2 == 0.0);
    assert!((layer.area_mm2() - (3600.0 - disc - 10.0)).abs() < 2e-3);
    let hole = layer.remaining_polygons();
    assert_eq!((hole.len(), hole[0].holes.len()), (1, 1));
}

#[test]
fn one_step_may_leave_two_pieces() {
    let walls = vec![block([0.0; 3], [2.0, 40.0, 1.0]), block([8.0, 0.0, 0.0], [10.0, 40.0, 1.0])];
    let mut stack = stack_of(walls, 0.0, 1.0).unwrap();
    let removed = stack.layers_mut()[0].remove_swept_area(&step([5.0, 20.0], [5.0, 21.0], 4.0, 120));
    assert_eq!(removed.pieces.len(), 2);
    let areas: Vec<f64> = removed.pieces.iter().map(Polygon::area_mm2).collect();
    assert!((areas[0] - areas[1]).abs() < 1e-6 && areas[0] > 0.5);
}

#[test]
fn a_step_in_air_takes_nothing_and_leaves_all_as_it_is() {
    let mut stack = plate(20.0, 256);
    let layer = &mut stack.layers_mut()[0];
    for at in [[-30.0, 5.0], [1e4, 1e4], [-5.001, 10.0]] {
        let taken = layer.remove_swept_area(&step(at, [at[0], at[1] + 0.5], 5.0, 100));
        assert_eq!(taken, LayerRemoval::default());
    }
    assert_eq!(layer.remove_swept_area(&LayerSweptArea::default()), LayerRemoval::default());
    assert_eq!(layer.area_mm2(), 400.0);
}

/// Zigzag steps over a plate with holes.
fn path() -> Vec<LayerSweptArea> {
    let mut covers = Vec::new();
    for (pass, y) in [8.0, 12.5, 17.0, 21.5].into_iter().enumerate() {
        let x =
            |index: usize| if pass % 2 == 0 { index as f64 * 1.1 - 8.0 } else { 42.0 - index as f64 * 1.1 };
        covers.extend((0..45).map(|index| step([x(index), y], [x(index + 1), y + 0.3], 3.0, 90)));
    }
    covers
}

/// Areas, material inside and pieces of each step, and what is left.
fn run(corners: usize) -> (Vec<(f64, f64, usize)>, f64, Vec<Polygon>) {
    let mut stack = plate(40.0, corners);
    let layer = &mut stack.layers_mut()[0];
    let drill =
        |x: f64, y: f64| LayerSweptArea { first: circle([x, y], 0.8, 12), ..LayerSweptArea::default() };
    for index in 0..100 {
        let removed = layer
            .remove_swept_area(&drill(2.0 + 4.0 * f64::from(index / 10), 2.0 + 4.0 * f64::from(index % 10)));
        assert!((removed.inside_mm2 - 0.64 * 3.0).abs() < 1e-4 && removed.pieces.is_empty());
    }
    let steps = path().into_iter().map(|cover| layer.remove_swept_area(&cover)).map(|removed| {
        let pieces: f64 = removed.pieces.iter().map(Polygon::area_mm2).sum();
        assert!((pieces - removed.area_mm2).abs() < 1e-9);
        (removed.area_mm2, removed.inside_mm2, removed.pieces.len())
    });
    let steps: Vec<_> = steps.collect();
    (steps, layer.area_mm2(), layer.remaining_polygons())
}

#[test]
fn pieces_of_a_layer_change_nothing() {
    let (steps, left, polygons) = run(1_000_000);
    let taken: f64 = steps.iter().map(|(area, inside, _)| area + inside).sum();
    assert!((1600.0 - 192.0 - taken - left).abs() < 1e-2, "{taken} {left}");
    assert!(steps.iter().filter(|(_, _, pieces)| *pieces > 1).count() > 20, "holes part chips");
    for corners in [16, 60, 256] {
        let (other, other_left, other_polygons) = run(corners);
        assert!((other_left - left).abs() < 1e-3, "{corners}: {other_left} {left}");
        assert_eq!(other_polygons.len(), polygons.len(), "{corners}");
        for (index, (one, other)) in steps.iter().zip(&other).enumerate() {
            assert!(
                (one.0 - other.0).abs() < 1e-4 && (one.1 - other.1).abs() < 1e-4,
                "{corners} {index}: {one:?} {other:?}"
            );
            assert_eq!(one.2, other.2, "{corners} {index}: {one:?} {other:?}");
        }
    }
}

#[test]
fn the_same_again_takes_nothing() {
    let mut stack = plate(40.0, 64);
    let layer = &mut stack.layers_mut()[0];
    for cover in path() {
        layer.remove_swept_area(&cover);
    }
    let left = layer.area_mm2();
    for cover in path() {
        let removed = layer.remove_swept_area(&cover);
        assert!(removed.area_mm2 < 1e-4 && removed.inside_mm2 < 1e-4, "{removed:?}");
    }
    assert!((layer.area_mm2() - left).abs() < 1e-3);
}

proptest! {
    #![proptest_config(crate::support::property(256))]

    #[test]
    fn nothing_is_lost_and_nothing_comes_back(
        start in prop::collection::vec(star(), 1..4),
        cuts in prop::collection::vec((star(), prop::collection::vec(star(), 0..3)), 1..8),
        corners in 8usize..200,
    ) {
        let stock = Stock::new(vec![block([-40.0, -40.0, 0.0], [40.0, 40.0, 1.0])], 0.0).unwrap();
        let mut stack = LayerStack::with_max_vertices(&stock, 1.0, corners).unwrap();
        let layer = &mut stack.layers_mut()[0];
        let opening = LayerSweptArea { advancing: start.clone(), ..LayerSweptArea::default() };
        layer.remove_swept_area(&opening);
        let mut gone = start;
        for (first, advancing) in cuts {
            let before = layer.area_mm2();
            let cover = LayerSweptArea { first, advancing, ..LayerSweptArea::default() };
            let removed = layer.remove_swept_area(&cover);
            let after = layer.area_mm2();
            prop_assert!((before - after - removed.area_mm2 - removed.inside_mm2).abs() < 1e-3);
            prop_assert!(removed.area_mm2 >= 0.0 && removed.inside_mm2 >= 0.0 && after >= 0.0);
            prop_assert!(removed.pieces.iter().all(|piece| piece.area_mm2() > 0.0));
            gone.extend(cover.advancing.iter().chain([&cover.first]).cloned());
            let again = layer.remove_swept_area(&cover);
            prop_assert!(again.area_mm2 < 1e-3 && again.inside_mm2 < 1e-3, "{:?}", again);
        }
        let plate = brute::dense_union(&[square([-40.0; 2], 80.0)]);
        let left = brute::area(&brute::difference(&plate, &brute::dense_union(&gone)));
        prop_assert!((layer.area_mm2() - left).abs() < 1e-2, "{} {}", layer.area_mm2(), left);
    }
}
