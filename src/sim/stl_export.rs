//! Remaining stock as a surface: the columns' own faces, so the volume is theirs.
//!
//! Blocky but exact: a top and a bottom face for every interval, walls where neighbours differ. Faces that continue along a row
//! are one. Long faces meet several short ones along their edges, which are all parallel to an axis; [`super::Mesh`] reads that.

use super::{DexelSpan, Dexels, dexel_spans};
use rayon::prelude::*;
use std::io::{self, Write};
use stl_io::{Normal, Triangle, Vertex};

/// Writes remaining stock as a binary STL in mm.
///
/// Coordinates are rounded to `f32` as STL asks. Row by row, so it takes no memory for the surface.
///
/// # Errors
/// What `out` returns, or that there are more triangles than an STL file counts (2^32).
pub fn write_stl(dexels: &Dexels, out: &mut dyn Write) -> io::Result<()> {
    let rows = dexels.grid().rows;
    let count: usize = (0..=rows).into_par_iter().map(|row| find_row_faces(dexels, row).len() * 2).sum();
    if u32::try_from(count).is_err() {
        return Err(io::Error::other(format!("{count} triangles are more than an STL file can hold")));
    }
    let mut out = out;
    stl_io::write_stl(&mut out, StockTriangles { dexels, row: 0, ready: Vec::new().into_iter(), left: count })
}

/// The triangles, a row at a time.
struct StockTriangles<'a> {
    dexels: &'a Dexels,
    row: usize,
    ready: std::vec::IntoIter<Triangle>,
    left: usize,
}

impl Iterator for StockTriangles<'_> {
    type Item = Triangle;

    fn next(&mut self) -> Option<Triangle> {
        while self.ready.len() == 0 && self.row <= self.dexels.grid().rows {
            let faces = find_row_faces(self.dexels, self.row);
            self.ready = faces.iter().flat_map(DexelFace::split_triangles).collect::<Vec<_>>().into_iter();
            self.row += 1;
        }
        self.left = self.left.saturating_sub(1);
        self.ready.next()
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.left, Some(self.left))
    }
}

impl ExactSizeIterator for StockTriangles<'_> {}

/// What a face is and, where it continues along x, must have in common with the next one.
#[derive(Clone, Copy, PartialEq)]
enum FaceStrip {
    /// Upper or lower end of intervals.
    Cap { height: f32, up: bool },
    /// A wall along x on the row's lower border; `up`: it faces to larger y.
    Wall { low: f32, top: f32, up: bool },
}

/// A rectangle: two opposite corners; `axis` is what it stands across, `up` that it faces the larger values there.
struct DexelFace {
    from: [f32; 3],
    to: [f32; 3],
    axis: FaceNormalAxis,
    up: bool,
}

#[derive(Clone, Copy)]
enum FaceNormalAxis {
    X,
    Y,
    Z,
}

impl DexelFace {
    fn split_triangles(&self) -> [Triangle; 2] {
        let ([x, y, z], [u, v, w]) = (self.from, self.to);
        // Counter-clockwise seen from the larger values.
        let (mut corners, mut normal) = match self.axis {
            FaceNormalAxis::X => ([[x, y, z], [x, v, z], [x, v, w], [x, y, w]], [1.0, 0.0, 0.0]),
            FaceNormalAxis::Y => ([[x, y, z], [x, y, w], [u, y, w], [u, y, z]], [0.0, 1.0, 0.0]),
            FaceNormalAxis::Z => ([[x, y, z], [u, y, z], [u, v, z], [x, v, z]], [0.0, 0.0, 1.0]),
        };
        if !self.up {
            corners.reverse();
            normal = normal.map(|part: f32| -part + 0.0);
        }
        let [a, b, c, d] = corners.map(Vertex::new);
        [[a, b, c], [a, c, d]].map(|vertices| Triangle { normal: Normal::new(normal), vertices })
    }
}

/// The faces of a row: caps, walls to the row before and walls within it. The row after the last one has walls only.
fn find_row_faces(dexels: &Dexels, row: usize) -> Vec<DexelFace> {
    let layout = dexels.grid();
    let border = |axis_origin: f64, index: usize| (axis_origin + (index as f64 - 0.5) * layout.cell) as f32;
    let [x0, y0] = layout.origin;
    let (x, y) = (|index| border(x0, index), |index| border(y0, index));
    let z = |height: f32| (layout.base + f64::from(height)) as f32;
    let (south, north) = (y(row), y(row + 1));

    let mut found = Vec::new();
    let mut running: Vec<(FaceStrip, usize)> = Vec::new();
    let mut left: Vec<DexelSpan> = Vec::new();
    for column in 0..=layout.columns {
        let own = dexels.column_spans(column, row);
        dexel_spans::find_span_differences(&left, &own, |[low, top], up| {
            let (from, to) = ([x(column), south, z(low)], [x(column), north, z(top)]);
            found.push(DexelFace { from, to, axis: FaceNormalAxis::X, up });
        });
        let strips = list_column_strips(&own, row.checked_sub(1).map(|row| dexels.column_spans(column, row)));
        running.retain(|(strip, first)| {
            let goes_on = strips.contains(strip);
            if !goes_on {
                let (west, east) = (x(*first), x(column));
                found.push(match *strip {
                    FaceStrip::Cap { height, up } => {
                        let (from, to) = ([west, south, z(height)], [east, north, z(height)]);
                        DexelFace { from, to, axis: FaceNormalAxis::Z, up }
                    }
                    FaceStrip::Wall { low, top, up } => DexelFace {
                        from: [west, south, z(low)],
                        to: [east, south, z(top)],
                        axis: FaceNormalAxis::Y,
                        up,
                    },
                });
            }
            goes_on
        });
        for strip in strips {
            if !running.iter().any(|(other, _)| *other == strip) {
                running.push((strip, column));
            }
        }
        left = own;
    }
    found
}

fn list_column_strips(own: &[DexelSpan], before: Option<Vec<DexelSpan>>) -> Vec<FaceStrip> {
    let caps = |[low, top]: &DexelSpan| {
        [FaceStrip::Cap { height: *top, up: true }, FaceStrip::Cap { height: *low, up: false }]
    };
    let mut strips: Vec<FaceStrip> = own.iter().flat_map(caps).collect();
    dexel_spans::find_span_differences(&before.unwrap_or_default(), own, |[low, top], up| {
        strips.push(FaceStrip::Wall { low, top, up });
    });
    strips
}
