//! This module checks whether a surface is closed: its triangles must pass each piece of an edge equally
//! often in both directions.
//!
//! This rule lets bodies touch along an edge, where four triangles meet. Along a line parallel to an axis it
//! also lets one long edge meet several short ones, as blocky surfaces have them (the STL files of remaining
//! stock, [`crate::stock::stl_export`]). The conversion to columns counts both cases correctly.

use super::{Mesh, MeshError};
use crate::stock::memory;

/// The faults of a surface's edges: how many edges are open or have turned neighbours, and the middle of the
/// first one.
#[derive(Default)]
struct EdgeFaults {
    open: usize,
    turned: usize,
    open_at: Option<[f64; 3]>,
    turned_at: Option<[f64; 3]>,
}

impl EdgeFaults {
    /// Counts an edge that is passed more often in one direction than in the other; `rest` is the difference.
    /// An odd difference means that one side has no triangle, an even one that neighbours face opposite
    /// sides.
    fn count_edge(&mut self, rest: i64, a: [f64; 3], b: [f64; 3]) {
        let [[x, y, z], [u, v, w]] = [a, b];
        let middle = [f64::midpoint(x, u), f64::midpoint(y, v), f64::midpoint(z, w)];
        let (count, at) = match rest % 2 {
            0 => (&mut self.turned, &mut self.turned_at),
            _ => (&mut self.open, &mut self.open_at),
        };
        *count += 1;
        at.get_or_insert(middle);
    }
}

/// A line parallel to an axis: the axis' index, and the bits of the two coordinates that stay constant on it.
type AxisLine = (u8, [u64; 2]);

/// Checks that a surface is closed and consistently oriented.
///
/// # Errors
/// Returns [`MeshError::Open`] or [`MeshError::Turned`] with the first place in the order of the vertices.
pub(super) fn check_closed(mesh: &Mesh) -> Result<(), MeshError> {
    let mut passes: Vec<([u32; 2], bool)> =
        memory::reserve_values(mesh.triangles.len().saturating_mul(3), "the edges of a mesh")?;
    for [a, b, c] in mesh.triangles.iter().copied() {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            passes.push(([from.min(to), from.max(to)], from < to));
        }
    }
    // After sorting, all passes of one edge stand together, so one scan adds their directions.
    passes.sort_unstable();
    let mut found = EdgeFaults::default();
    let mut on_lines: Vec<(AxisLine, f64, i64)> = Vec::new();
    for same in passes.chunk_by(|(a, _), (b, _)| a == b) {
        let rest: i64 = same.iter().map(|(_, forth)| if *forth { 1 } else { -1 }).sum();
        let Some(([from, to], _)) = same.first().filter(|_| rest != 0) else { continue };
        let [a, b, _] = mesh.vertices_of([*from, *to, *to]);
        match find_axis_line(a, b) {
            Some((line, [from, to])) => on_lines.extend([(line, from, rest), (line, to, -rest)]),
            None => found.count_edge(rest, a, b),
        }
    }
    // On a line parallel to an axis, edges of different lengths may cancel. So their ends are sorted along
    // the line, and the sum of passes must be zero between any two neighbouring ends.
    on_lines.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    for line in on_lines.chunk_by(|a, b| a.0 == b.0) {
        let mut rest = 0;
        for pair in line.windows(2) {
            let [(line, from, passes), (_, to, _)] = pair else { continue };
            rest += passes;
            if rest != 0 && from < to {
                found.count_edge(rest, point_on_axis_line(*line, *from), point_on_axis_line(*line, *to));
            }
        }
    }
    match found {
        EdgeFaults { open, open_at: Some(at), .. } => Err(MeshError::Open { edges: open, at }),
        EdgeFaults { turned, turned_at: Some(at), .. } => Err(MeshError::Turned { edges: turned, at }),
        _ => Ok(()),
    }
}

/// Returns the line parallel to an axis on which two points lie, and the points' coordinates along it; `None`
/// if there is no such line.
fn find_axis_line([x, y, z]: [f64; 3], [u, v, w]: [f64; 3]) -> Option<(AxisLine, [f64; 2])> {
    match [x == u, y == v, z == w] {
        [false, true, true] => Some(((0, [y.to_bits(), z.to_bits()]), [x, u])),
        [true, false, true] => Some(((1, [x.to_bits(), z.to_bits()]), [y, v])),
        [true, true, false] => Some(((2, [x.to_bits(), y.to_bits()]), [z, w])),
        _ => None,
    }
}

/// Returns the point at a coordinate along a line parallel to an axis.
fn point_on_axis_line((axis, rest): AxisLine, at: f64) -> [f64; 3] {
    let [a, b] = rest.map(f64::from_bits);
    match axis {
        0 => [at, a, b],
        1 => [a, at, b],
        _ => [a, b, at],
    }
}
