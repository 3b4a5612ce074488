//! Chips and workpieces as solids.

use super::area::{circle, square, star, turned};
use super::stack::stack_of;
use clsmith::internals::layered_chips::area::{AreaGrid, Clipper, GridArea};
use clsmith::internals::layered_chips::chip::{Chip, LayerChip};
use clsmith::internals::layered_chips::stl_export;
use clsmith::layered_chips::{LayerFrame, Polygon};
use clsmith::stock::{Mesh, SolidBody};
use proptest::prelude::*;

fn chip(layers: Vec<(f64, f64, Vec<Polygon>)>) -> Chip {
    let layer = |(number, (z, thickness, pieces)): (usize, (f64, f64, Vec<Polygon>))| LayerChip {
        layer: number,
        z_mm: z,
        thickness_mm: thickness,
        area_mm2: pieces.iter().map(Polygon::area_mm2).sum(),
        inside_mm2: 0.0,
        pieces,
        arcs_deg: Vec::new(),
        advance_mm: 0.0,
    };
    Chip { layers: layers.into_iter().enumerate().map(layer).collect() }
}

fn stl(chip: &Chip) -> Vec<u8> {
    let mut bytes = Vec::new();
    stl_export::write_chip_stl(chip, &LayerFrame::WORKPIECE, &mut bytes).unwrap();
    bytes
}

#[test]
fn a_prism_on_a_square_with_a_hole() {
    let ring = Polygon { outer: square([0.0; 2], 4.0), holes: vec![turned(square([1.0; 2], 1.0))] };
    let bytes = stl(&chip(vec![(1.0, 0.5, vec![ring])]));
    let mesh = Mesh::from_stl(&bytes).unwrap();
    assert_eq!(mesh.bounds(), ([0.0, 0.0, 0.75], [4.0, 4.0, 1.25]));
    assert!((mesh.volume_mm3() - 7.5).abs() < 1e-9);
    // Two faces of 8 triangles, 8 walls of two.
    assert_eq!(mesh.triangle_count(), 32);
}

#[test]
fn normals_point_out() {
    let bytes =
        stl(&chip(vec![(0.0, 1.0, vec![Polygon { outer: circle([3.0, 4.0], 2.0, 12), holes: Vec::new() }])]));
    let mut cursor = std::io::Cursor::new(&bytes);
    for triangle in stl_io::create_stl_reader(&mut cursor).unwrap() {
        let triangle = triangle.unwrap();
        let [a, b, c] = triangle.vertices.map(|vertex| vertex.0);
        let normal = triangle.normal.0;
        let middle = [0, 1, 2].map(|i| (a[i] + b[i] + c[i]) / 3.0);
        let out = (0..3).map(|i| normal[i] * (middle[i] - [3.0, 4.0, 0.0][i])).sum::<f32>();
        let length = normal.iter().map(|part| part * part).sum::<f32>();
        assert!(out > 0.4 && (length - 1.0).abs() < 1e-5);
    }
}

#[test]
fn nothing_is_an_empty_file() {
    assert_eq!(stl(&Chip::default()).len(), 84);
}

#[test]
fn borders_that_cross_are_refused() {
    let bow = Polygon { outer: vec![[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 3.0]], holes: Vec::new() };
    let refused = stl_export::write_chip_stl(
        &chip(vec![(0.0, 1.0, vec![bow])]),
        &LayerFrame::WORKPIECE,
        &mut Vec::new(),
    )
    .unwrap_err();
    assert!(refused.to_string().contains("crosses"), "{refused}");
}

#[test]
fn a_workpiece_is_as_large_as_its_layers() {
    let bar = SolidBody::Cylinder { diameter: 20.0, from: [0.0, 0.0, 0.0], to: [30.0, 10.0, 15.0] };
    let foot = SolidBody::Block { from: [-5.0, -30.0, -12.0], to: [8.0, 20.0, 3.0] };
    let stack = stack_of(vec![bar, foot], 0.0, 0.9).unwrap();
    let mut bytes = Vec::new();
    stl_export::write_stack_stl(&stack, &LayerFrame::WORKPIECE, &mut bytes).unwrap();
    let mesh = Mesh::from_stl(&bytes).unwrap();
    assert!((mesh.volume_mm3() / stack.volume_mm3() - 1.0).abs() < 1e-6);
}

proptest! {
    #![proptest_config(crate::support::property(256))]

    #[test]
    fn solids_are_closed_and_hold_the_volume(
        layers in prop::collection::vec(prop::collection::vec(star(), 1..6), 1..4),
        thickness in 0.01..2.0f64,
    ) {
        let grid = AreaGrid::around_box([-50.0; 2], [50.0; 2]).unwrap();
        let layers = layers.into_iter().enumerate().map(|(number, stars)| {
            let pieces = Clipper::default().extract_polygons(&GridArea::new(&grid, stars.iter().map(Vec::as_slice)), &grid).0;
            (number as f64 * thickness, thickness, pieces)
        });
        let chip = chip(layers.collect());
        let mesh = Mesh::from_stl(&stl(&chip)).unwrap();
        prop_assert!((mesh.volume_mm3() / chip.volume_mm3() - 1.0).abs() < 1e-5);
    }
}
