//! Meshes: read, checked, made columns.

use super::shapes::{Triangles, cube, mesh, sphere, stl, torus};
use clsmith::stock::{DexelGrid, Dexels, Mesh, MeshError};
use proptest::prelude::*;
use std::f64::consts::PI;

fn columns(mesh: &Mesh, cell: f64) -> Dexels {
    let (from, to) = mesh.bounds();
    mesh.to_dexels(DexelGrid::covering_box(from, to, cell)).unwrap()
}

fn near(found: f64, expected: f64, share: f64) {
    assert!((found - expected).abs() <= share * expected, "{found} is not {expected}");
}

#[test]
fn round_bodies_have_their_volume() {
    let ball = mesh(&sphere([3.0, -2.0, 7.0], 10.0, 64));
    near(ball.volume_mm3(), 4.0 / 3.0 * PI * 1000.0, 2e-3);
    near(columns(&ball, 0.2).volume_mm3(), ball.volume_mm3(), 1e-3);
    let ring = mesh(&torus(10.0, 3.0, 64));
    near(ring.volume_mm3(), 2.0 * PI * PI * 90.0, 3e-3);
    near(columns(&ring, 0.2).volume_mm3(), ring.volume_mm3(), 1e-3);
}

#[test]
fn columns_of_a_ball_end_on_it() {
    let dexels = columns(&mesh(&sphere([0.0; 3], 10.0, 64)), 0.5);
    for index in 0..dexels.grid().column_count() {
        let (column, row) = (index % dexels.grid().columns, index / dexels.grid().columns);
        let [x, y] = dexels.grid().column_center(column, row);
        let found = dexels.column_spans(column, row);
        let half = (100.0 - x * x - y * y).max(0.0).sqrt();
        // The faces lie up to 10 (1 - cos(pi / 64)) = 0.012 mm inside; the wall is steep at the rim.
        if half > 2.0 {
            assert_eq!(found.len(), 1, "{x} {y}");
            assert!((f64::from(found[0][1] - found[0][0]) - 2.0 * half).abs() < 0.15, "{x} {y}");
        }
    }
}

#[test]
fn faces_and_corners_on_the_centres_count_once() {
    let solid = mesh(&cube([0.0; 3], [4.0, 3.0, 2.0]));
    let layout = DexelGrid { origin_mm: [-1.0, -1.0], base_mm: 0.0, cell_mm: 0.5, columns: 14, rows: 12 };
    let dexels = solid.to_dexels(layout).unwrap();
    assert_eq!(dexels.volume_mm3(), 24.0);
    assert_eq!(dexels.column_spans(2, 2), [[0.0, 2.0]], "the lower corner is in");
    assert!(
        dexels.column_spans(10, 2).is_empty() && dexels.column_spans(2, 8).is_empty(),
        "the upper one is not"
    );
    // An octahedron with its tips, edges and diagonals over centres.
    let tips = [[3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [-3.0, 0.0, 0.0], [0.0, -3.0, 0.0]];
    let mut faces = Triangles::new();
    for (i, a) in tips.into_iter().enumerate() {
        let b = tips[(i + 1) % 4];
        faces.extend([[a, b, [0.0, 0.0, 3.0]], [b, a, [0.0, 0.0, -3.0]]]);
    }
    let layout = DexelGrid { origin_mm: [-4.0, -4.0], base_mm: -3.0, cell_mm: 1.0, columns: 9, rows: 9 };
    let dexels = mesh(&faces).to_dexels(layout).unwrap();
    for index in 0..81 {
        let [x, y] = layout.column_center(index % 9, index / 9);
        let half = (3.0 - x.abs() - y.abs()) as f32;
        let expected = if half > 0.0 { vec![[3.0 - half, 3.0 + half]] } else { vec![] };
        assert_eq!(dexels.column_spans(index % 9, index / 9), expected, "{x} {y}");
    }
}

#[test]
fn shells_wind() {
    let outer = cube([0.0; 3], [8.0; 3]);
    let with = |other: Triangles| [outer.clone(), other].concat();
    let turned = |mut faces: Triangles| {
        faces.iter_mut().for_each(|corners| corners.reverse());
        faces
    };
    let volume = |faces: &Triangles| columns(&mesh(faces), 1.0).volume_mm3();
    assert_eq!(volume(&outer), 512.0);
    assert_eq!(volume(&with(cube([2.0; 3], [6.0; 3]))), 512.0, "nested");
    assert_eq!(volume(&with(cube([4.0; 3], [10.0; 3]))), 512.0 + 216.0 - 64.0, "overlapping");
    assert_eq!(volume(&with(turned(cube([2.0; 3], [6.0; 3])))), 512.0 - 64.0, "hollow");
    assert_eq!(volume(&with(cube([0.0, 0.0, 8.0], [8.0, 8.0, 9.0]))), 576.0, "stacked, touching");
    assert_eq!(volume(&with(cube([8.0, 8.0, 0.0], [9.0, 9.0, 8.0]))), 520.0, "touching along an edge");
    assert_eq!(volume(&turned(outer.clone())), 512.0, "inside out");
    let stacked = columns(&mesh(&with(cube([0.0, 0.0, 8.0], [8.0, 8.0, 9.0]))), 1.0);
    assert_eq!(stacked.column_spans(3, 3), [[0.0, 9.0]], "one interval");
}

#[test]
fn what_is_beside_the_grid_is_left_out() {
    let layout = DexelGrid { origin_mm: [2.5, 2.5], base_mm: 0.0, cell_mm: 1.0, columns: 2, rows: 40 };
    assert_eq!(mesh(&cube([0.0; 3], [8.0; 3])).to_dexels(layout).unwrap().volume_mm3(), 2.0 * 6.0 * 8.0);
    let none = DexelGrid { columns: 0, ..layout };
    assert_eq!(mesh(&cube([0.0; 3], [8.0; 3])).to_dexels(none).unwrap().highest_z_mm(), None);
}

#[test]
fn text_and_heads_of_all_kinds_are_read() {
    let mut faces = cube([0.0; 3], [1.0; 3]);
    faces.extend(cube([2.0; 3], [3.0; 3]));
    let expected = mesh(&faces);
    let text = |name: &str, faces: &[[[f64; 3]; 3]]| {
        let mut text = format!("solid{name}\r\n");
        for corners in faces {
            text += "  FACET NORMAL 0 0 0\n    outer loop\n";
            for [x, y, z] in corners {
                text += &format!("      vertex {x:.6e} {y} {z}\n");
            }
            text += "    endloop\n  endfacet\n\n";
        }
        text + "endsolid" + name + "\n"
    };
    for name in ["", " part", " solid \u{e4}"] {
        assert_eq!(Mesh::from_stl(text(name, &faces).as_bytes()).unwrap(), expected);
        let two = text(name, &faces[..12]) + &text(name, &faces[12..]);
        assert_eq!(Mesh::from_stl(two.as_bytes()).unwrap(), expected, "two solids in a file");
    }
    let mut latin = text(" ", &faces).into_bytes();
    latin[6] = 0xe4;
    assert_eq!(Mesh::from_stl(&latin).unwrap(), expected, "a name in another code page");
    let mut binary = stl(&faces);
    binary[..11].copy_from_slice(b"solid made ");
    assert_eq!(Mesh::from_stl(&binary).unwrap(), expected, "a binary file that says solid");
}

#[test]
fn what_is_no_solid_is_refused() {
    let faces = cube([0.0; 3], [2.0; 3]);
    let read = |faces: &Triangles| Mesh::from_stl(&stl(faces)).unwrap_err();
    assert_eq!(read(&vec![]), MeshError::Empty);
    assert_eq!(read(&vec![[[1.0; 3]; 3]]), MeshError::Empty);
    let mut open = faces.clone();
    open.remove(0);
    assert!(matches!(read(&open), MeshError::Open { edges: 3, .. }), "{}", read(&open));
    let mut turned = faces.clone();
    turned[0].reverse();
    assert!(matches!(read(&turned), MeshError::Turned { edges: 3, .. }), "{}", read(&turned));
    let mut nan = faces.clone();
    nan[4][1][2] = f64::NAN;
    assert_eq!(read(&nan), MeshError::NotFinite { triangle: 5 });
    nan[4][1][2] = 1e10;
    assert_eq!(read(&nan), MeshError::NotFinite { triangle: 5 });
    let bytes = stl(&faces);
    let (found, expected) = (bytes.len() as u64 - 1, bytes.len() as u64);
    let cut = Mesh::from_stl(&bytes[..bytes.len() - 1]);
    assert_eq!(cut, Err(MeshError::Length { triangles: 12, expected, found }));
    for text in
        ["", "solid", "solid a\nfacet\nendsolid a\n", "ISO-10303-21;", "solid a\nsolid b\nendsolid b\n"]
    {
        assert!(matches!(Mesh::from_stl(text.as_bytes()), Err(MeshError::Stl { .. })), "{text}");
    }
    assert_eq!(Mesh::from_stl(b"solid a\nendsolid a\n"), Err(MeshError::Empty));
    assert_eq!(Mesh::new(vec![], vec![[0, 1, 2]]), Err(MeshError::Vertex { triangle: 1 }));
    assert!(mesh(&faces).scaled(0.0).is_err() && mesh(&faces).scaled(f64::MAX).is_err());
    assert_eq!(mesh(&faces).scaled(25.4).unwrap().bounds(), ([0.0; 3], [50.8; 3]));
}

/// The hull of points in general position, by brute force: the triangles that leave all others on one side, and their planes.
fn hull(points: &[[f64; 3]]) -> Triangles {
    let minus = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let mut faces = Triangles::new();
    for (i, a) in points.iter().enumerate() {
        for (j, b) in points.iter().enumerate() {
            for (k, c) in points.iter().enumerate() {
                // Each triangle once, beginning with its smallest index, in both senses.
                if i >= j || i >= k || j == k {
                    continue;
                }
                let (u, v) = (minus(*b, *a), minus(*c, *a));
                let n = normal(u, v);
                let outside =
                    points.iter().filter(|p| dot(n, minus(**p, *a)) > 0.0 && **p != *b && **p != *c).count();
                if outside == 0 {
                    faces.push([*a, *b, *c]);
                }
            }
        }
    }
    faces
}

fn normal(u: [f64; 3], v: [f64; 3]) -> [f64; 3] {
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Whether four of the points lie in one plane, nearly.
fn flat(points: &[[f64; 3]]) -> bool {
    let n = points.len();
    (0..n).any(|i| {
        (i + 1..n).any(|j| {
            (j + 1..n).any(|k| {
                (k + 1..n).any(|l| {
                    let from = |at: usize| [0, 1, 2].map(|axis| points[at][axis] - points[i][axis]);
                    dot(normal(from(j), from(k)), from(l)).abs() < 1e-3
                })
            })
        })
    })
}

proptest! {
    #![proptest_config(crate::support::property(256))]

    #[test]
    fn a_convex_body_is_its_half_spaces(points in proptest::collection::vec([-5.0..5.0f32, -5.0..5.0f32, -5.0..5.0f32], 4..9)) {
        let points: Vec<[f64; 3]> = points.iter().map(|point| point.map(f64::from)).collect();
        prop_assume!(!flat(&points));
        let faces = hull(&points);
        let solid = mesh(&faces);
        let layout = DexelGrid { origin_mm: [-5.0, -5.0], base_mm: -5.0, cell_mm: 0.5, columns: 21, rows: 21 };
        let dexels = solid.to_dexels(layout).unwrap();
        for index in 0..layout.column_count() {
            let [x, y] = layout.column_center(index % 21, index / 21);
            let (mut low, mut high) = (-1e9f64, 1e9f64);
            for [a, b, c] in &faces {
                let minus = |p: &[f64; 3]| [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
                let n = normal(minus(b), minus(c));
                // n . (p - a) <= 0
                let z = a[2] - (n[0] * (x - a[0]) + n[1] * (y - a[1])) / n[2];
                if n[2] > 0.0 { high = high.min(z) } else if n[2] < 0.0 { low = low.max(z) }
            }
            let found = dexels.column_spans(index % 21, index / 21);
            if high - low > 1e-3 {
                prop_assert_eq!(found.len(), 1, "{} {}: {} {}", x, y, low, high);
                let [a, b] = found[0].map(|height| f64::from(height) - 5.0);
                prop_assert!((a - low).abs() < 1e-4 && (b - high).abs() < 1e-4, "{} {}: {} {}", x, y, low, high);
            } else if high - low < -1e-3 {
                prop_assert!(found.is_empty(), "{} {}: {} {}", x, y, low, high);
            }
        }
    }

    #[test]
    fn any_bytes_are_a_mesh_or_refused(bytes in proptest::collection::vec(any::<u8>(), 0..300), head in 0..3u8) {
        let mut bytes = bytes;
        match head {
            0 => bytes.splice(0..0, *b"solid x\nfacet normal 0 0 0\nouter loop\n").for_each(drop),
            1 if bytes.len() > 134 => {
                bytes.truncate(134);
                bytes[80..84].copy_from_slice(&1u32.to_le_bytes());
            }
            _ => {}
        }
        prop_assert!(Mesh::from_stl(&bytes).is_err());
    }
}
