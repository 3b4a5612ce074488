//! A ball of 200,000 triangles as stock: read, made columns, written, grown: `cargo bench --bench meshes`.

// A benchmark that cannot make its mesh has nothing to measure.
#![allow(clippy::expect_used)]

use clsmith::stock::stl_export::write_stl;
use clsmith::stock::{DexelGrid, Mesh, SolidBody, Stock};
use std::f64::consts::PI;
use std::time::Instant;

/// Half-circles from pole to pole, and twice as many around.
const FINENESS: u32 = 224;
const RADIUS: f64 = 50.0;
const CELL: f64 = 0.1;

/// Corners of the triangles of a ball about the origin.
fn ball() -> Vec<[[f64; 3]; 3]> {
    let share = |part: u32| PI * f64::from(part) / f64::from(FINENESS);
    let point = |around: u32, up: u32| {
        // Both ends of a circle are one point to the last digit, and so are all points of a pole.
        let (turn, tilt) = (share(around % (2 * FINENESS)), share(up));
        let ring = if up == 0 || up == FINENESS { 0.0 } else { RADIUS * tilt.sin() };
        [ring * turn.cos(), ring * turn.sin(), -RADIUS * tilt.cos()]
    };
    let quads = (0..2 * FINENESS).flat_map(|i| (0..FINENESS).map(move |j| (i, j)));
    let halves = quads.flat_map(|(i, j)| {
        let [a, b, c, d] = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
        // At a pole one of the two has no area.
        [(j > 0).then_some([a, b, c]), (j + 1 < FINENESS).then_some([a, c, d])]
    });
    halves.flatten().collect()
}

/// The bytes of a binary STL: 80 of a name, the count, and a normal, three corners and a zero for each triangle.
fn stl(triangles: &[[[f64; 3]; 3]]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for corners in triangles {
        bytes.extend([0; 12]);
        bytes.extend(corners.iter().flatten().flat_map(|value| (*value as f32).to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn timed<T>(what: &str, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let done = work();
    println!("{what:<32}{:>10.2?}", start.elapsed());
    done
}

fn main() {
    let bytes = stl(&ball());
    let ball = timed("read and checked", || Mesh::from_stl(&bytes).expect("a closed ball"));
    let (from, to) = ball.bounds();
    let dexels =
        timed("columns", || ball.to_dexels(DexelGrid::covering_box(from, to, CELL)).expect("memory"));
    let mut surface = Vec::new();
    timed("surface as STL", || write_stl(&dexels, &mut surface).expect("a vector grows"));
    let triangles = (surface.len() - 84) / 50;
    let columns = dexels.grid().column_count();
    let grown = Stock::new(vec![SolidBody::Remains(dexels.into())], 10.0 * CELL).expect("a stock");
    timed("grown by ten cells", || grown.to_dexels(CELL, usize::MAX).expect("columns"));
    println!("{} triangles read, {columns} columns, {triangles} triangles written", ball.triangle_count());
}
