//! Whether a surface is closed: every piece of an edge is passed as often one way as the other.
//!
//! This lets bodies touch along an edge (four triangles), and along lines parallel to an axis it lets one long edge meet several
//! short ones, as blocky surfaces have them (our own remaining stock): the scan counts both right.

use super::{Mesh, MeshError};

/// What is wrong with edges of a surface.
#[derive(Default)]
struct EdgeFaults {
    open: usize,
    turned: usize,
    open_at: Option<[f64; 3]>,
    turned_at: Option<[f64; 3]>,
}

impl EdgeFaults {
    /// An edge with more passes one way than the other; an odd rest has a side without triangle.
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

/// A line parallel to an axis: the axis, and the bits of the two coordinates that stay.
type AxisLine = (u8, [u64; 2]);

/// # Errors
/// [`MeshError::Open`] or [`MeshError::Turned`], with the first place in the order of vertices.
pub(super) fn check_closed(mesh: &Mesh) -> Result<(), MeshError> {
    let mut passes: Vec<([u32; 2], bool)> = Vec::with_capacity(mesh.triangles.len() * 3);
    for [a, b, c] in mesh.triangles.iter().copied() {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            passes.push(([from.min(to), from.max(to)], from < to));
        }
    }
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

/// The line parallel to an axis that two points are on, and where.
fn find_axis_line([x, y, z]: [f64; 3], [u, v, w]: [f64; 3]) -> Option<(AxisLine, [f64; 2])> {
    match [x == u, y == v, z == w] {
        [false, true, true] => Some(((0, [y.to_bits(), z.to_bits()]), [x, u])),
        [true, false, true] => Some(((1, [x.to_bits(), z.to_bits()]), [y, v])),
        [true, true, false] => Some(((2, [x.to_bits(), y.to_bits()]), [z, w])),
        _ => None,
    }
}

fn point_on_axis_line((axis, rest): AxisLine, at: f64) -> [f64; 3] {
    let [a, b] = rest.map(f64::from_bits);
    match axis {
        0 => [at, a, b],
        1 => [a, at, b],
        _ => [a, b, at],
    }
}
