//! Meshes and columns that the tests are about.

use clsmith::stock::{DexelGrid, DexelSpan, Dexels, Mesh};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};
use stl_io::{Normal, Triangle, Vertex};

pub type Triangles = Vec<[[f64; 3]; 3]>;

/// The bytes of a binary STL.
pub fn stl(triangles: &Triangles) -> Vec<u8> {
    let corner = |at: [f64; 3]| Vertex::new(at.map(|value| value as f32));
    let triangle =
        |corners: &[[f64; 3]; 3]| Triangle { normal: Normal::new([0.0; 3]), vertices: corners.map(corner) };
    let all: Vec<Triangle> = triangles.iter().map(triangle).collect();
    let mut bytes = Vec::new();
    stl_io::write_stl(&mut bytes, all.iter()).unwrap();
    bytes
}

pub fn mesh(triangles: &Triangles) -> Mesh {
    Mesh::from_stl(&stl(triangles)).unwrap()
}

/// A box along the axes.
pub fn cube(from: [f64; 3], to: [f64; 3]) -> Triangles {
    let at = |i: usize| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { from[axis] } else { to[axis] });
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
        .map(|q| q.map(at));
    quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect()
}

/// A surface over two angles, closed in both; `v` may also run from pole to pole.
pub fn lathe(around: usize, along: usize, at: impl Fn(f64, f64) -> [f64; 3]) -> Triangles {
    let point = |i: usize, j: usize| {
        at((i % around) as f64 * TAU / around as f64, j as f64 / along as f64)
            .map(|value| f64::from(value as f32))
    };
    let mut all = Vec::new();
    for i in 0..around {
        for j in 0..along {
            let [a, b, c, d] = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
            all.extend([[a, b, c], [a, c, d]]);
        }
    }
    all.retain(|[a, b, c]| a != b && b != c && c != a);
    all
}

pub fn sphere([x, y, z]: [f64; 3], radius: f64, fineness: usize) -> Triangles {
    lathe(2 * fineness, fineness, |u, v| {
        let (r, up) = match v {
            0.0 => (0.0, -radius),
            1.0 => (0.0, radius),
            _ => (radius * (PI * v).sin(), -radius * (PI * v).cos()),
        };
        [x + r * u.cos(), y + r * u.sin(), z + up]
    })
}

pub fn torus(large: f64, small: f64, fineness: usize) -> Triangles {
    lathe(2 * fineness, fineness, |u, v| {
        let v = if v == 1.0 { 0.0 } else { v * TAU };
        let r = large + small * v.cos();
        [r * u.cos(), r * u.sin(), small * v.sin()]
    })
}

/// Any columns: up to three intervals each, at heights that no `f32` rounds.
pub fn columns() -> impl Strategy<Value = Dexels> {
    (1..6usize, 1..70usize, -4..4i32).prop_flat_map(|(columns, rows, shift)| {
        let column = proptest::collection::btree_set(0..40u8, 0..6);
        proptest::collection::vec(column, columns * rows).prop_map(move |all| {
            let shift = f64::from(shift);
            let layout = DexelGrid {
                origin_mm: [shift, 2.0 * shift],
                base_mm: shift / 2.0,
                cell_mm: 0.25,
                columns,
                rows,
            };
            let mut dexels = Dexels::with_empty_columns(layout);
            for (index, heights) in all.iter().enumerate() {
                let heights: Vec<f32> = heights.iter().rev().map(|height| f32::from(*height) / 8.0).collect();
                let intervals: Vec<DexelSpan> =
                    heights.chunks_exact(2).map(|pair| [pair[1], pair[0]]).collect();
                dexels.set_column(index % columns, index / columns, &intervals);
            }
            dexels
        })
    })
}
