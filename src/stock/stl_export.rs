//! This module writes remaining stock as a surface. The surface consists of the columns' own faces, so it has
//! the columns' volume.
//!
//! The surface is blocky but exact: every interval has a top and a bottom face, and there is a wall wherever
//! two neighbours differ. Faces that continue along a row are merged. So long faces meet several short ones
//! along their edges, which are all parallel to an axis; [`crate::stock::Mesh`] accepts that.

use crate::stock::{DexelSpan, Dexels, dexel_spans};
use rayon::prelude::*;
use std::io::{self, Write};
use stl_io::{Normal, Triangle, Vertex};

/// Writes remaining stock as a binary STL file in mm.
///
/// Coordinates are rounded to `f32`, as STL requires. The faces are made row by row, so the surface needs no
/// memory.
///
/// # Errors
/// Returns the errors of `out`, and an error if there are more triangles than an STL file can count (2^32).
pub fn write_stl(dexels: &Dexels, out: &mut dyn Write) -> io::Result<()> {
    let rows = dexels.grid().rows;
    let count: usize = (0..=rows).into_par_iter().map(|row| find_row_faces(dexels, row).len() * 2).sum();
    if u32::try_from(count).is_err() {
        return Err(io::Error::other(format!("{count} triangles are more than an STL file can hold")));
    }
    let mut out = out;
    stl_io::write_stl(&mut out, StockTriangles { dexels, row: 0, ready: Vec::new().into_iter(), left: count })
}

/// An iterator over the triangles, which makes the faces of one row at a time.
struct StockTriangles<'a> {
    dexels: &'a Dexels,
    row: usize,
    ready: std::vec::IntoIter<Triangle>,
    left: usize,
}

impl Iterator for StockTriangles<'_> {
    type Item = Triangle;

    fn next(&mut self) -> Option<Triangle> {
        // A row without faces must not end the iteration.
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

/// A face that may continue along x. Two faces in neighbouring columns are merged if these values are equal.
#[derive(Clone, Copy, PartialEq)]
enum FaceStrip {
    /// The upper or the lower end of an interval.
    Cap { height: f32, up: bool },
    /// A wall along x at the row's lower boundary; `up` says that it faces to larger y.
    Wall { low: f32, top: f32, up: bool },
}

/// A rectangle, given by two opposite corners. `axis` is the axis across which it stands, and `up` says that
/// it faces to larger values on that axis.
struct DexelFace {
    from: [f32; 3],
    to: [f32; 3],
    axis: FaceNormalAxis,
    up: bool,
}

/// The axis that a face's normal is parallel to.
#[derive(Clone, Copy)]
enum FaceNormalAxis {
    X,
    Y,
    Z,
}

impl DexelFace {
    /// Splits the rectangle into two triangles with an outward normal.
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

/// Finds the faces of a row: its caps, the walls to the row before, and the walls between its columns. The
/// row after the last one only has walls to the row before.
fn find_row_faces(dexels: &Dexels, row: usize) -> Vec<DexelFace> {
    let layout = dexels.grid();
    let border =
        |axis_origin: f64, index: usize| (axis_origin + (index as f64 - 0.5) * layout.cell_mm) as f32;
    let [x0, y0] = layout.origin_mm;
    let (x, y) = (|index| border(x0, index), |index| border(y0, index));
    let z = |height: f32| (layout.base_mm + f64::from(height)) as f32;
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
        // Each column adds its caps and its walls to the row before; a strip that does not continue becomes
        // one face.
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

/// Lists the strips of one column: the ends of its intervals, and its walls to the same column in the row
/// before.
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
