//! This module writes chips and workpieces as solids in the workpiece frame: every piece of a layer becomes a prism.
//!
//! Layers touch each other with whole faces, so the surface is closed prism by prism. Walls stand on the
//! edges that only one triangle of a face has, so rounding cannot open a seam.

use super::chip::Chip;
use super::{LayerFrame, LayerStack, Polygon};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use std::io::{self, Write};
use stl_io::{Normal, Triangle, Vertex};

/// The vertices of a triangle in x, y, z, mm, counter-clockwise seen from outside.
type TriangleVertices = [[f64; 3]; 3];

/// Writes a chip, whose layers lie in `frame`, as a binary STL file in mm.
///
/// # Errors
/// Returns the errors of `out`, and an error if the boundary of a piece crosses another one or there are more
/// triangles than an STL file can count.
pub fn write_chip_stl(chip: &Chip, frame: &LayerFrame, out: &mut dyn Write) -> io::Result<()> {
    let mut all = Vec::new();
    for layer in &chip.layers {
        add_prisms(&layer.pieces, layer.z_mm - layer.thickness_mm / 2.0, layer.thickness_mm, &mut all)?;
    }
    write_triangles(all, frame, out)
}

/// Writes the rest of a workpiece, whose layers lie in `frame`, as a binary STL file in mm.
///
/// # Errors
/// Returns the errors of [`write_chip_stl`].
pub fn write_stack_stl(stack: &LayerStack, frame: &LayerFrame, out: &mut dyn Write) -> io::Result<()> {
    let mut all = Vec::new();
    for layer in stack.layers() {
        add_prisms(&layer.remaining_polygons(), layer.bottom_mm(), layer.thickness_mm(), &mut all)?;
    }
    write_triangles(all, frame, out)
}

fn write_triangles(all: Vec<TriangleVertices>, frame: &LayerFrame, out: &mut dyn Write) -> io::Result<()> {
    let place = |corner: [f64; 3]| <[f64; 3]>::from(frame.to_workpiece(&corner.into()).coords);
    let triangles = all.into_iter().filter_map(|corners| stl_triangle(corners.map(place)));
    let triangles: Vec<Triangle> = triangles.collect();
    if u32::try_from(triangles.len()).is_err() {
        let count = triangles.len();
        return Err(io::Error::other(format!("{count} triangles are more than an STL file can hold")));
    }
    let mut out = out;
    stl_io::write_stl(&mut out, triangles.iter())
}

/// Converts a triangle to the numbers of STL. A triangle of which two vertices become equal is left out,
/// because its neighbours then meet.
fn stl_triangle(corners: TriangleVertices) -> Option<Triangle> {
    let [a, b, c] = corners.map(|corner| corner.map(|at| at as f32 + 0.0));
    if a == b || b == c || c == a {
        return None;
    }
    let [p, q, r] = [a, b, c].map(|corner| nalgebra::Vector3::from(corner.map(f64::from)));
    let across = (q - p).cross(&(r - p));
    let normal = across.try_normalize(0.0).unwrap_or_default();
    let normal = Normal::new([normal.x as f32, normal.y as f32, normal.z as f32]);
    Some(Triangle { normal, vertices: [a, b, c].map(Vertex::new) })
}

/// Adds the prisms over some polygons.
fn add_prisms(
    pieces: &[Polygon],
    bottom: f64,
    thickness: f64,
    all: &mut Vec<TriangleVertices>,
) -> io::Result<()> {
    let top = bottom + thickness;
    let [low, high] = [bottom, top].map(|z| move |[x, y]: [f64; 2]| [x, y, z]);
    for piece in pieces {
        let TriangulatedPolygon { triangles, edges } = triangulate_polygon(piece)?;
        for [a, b, c] in triangles {
            all.push([a, b, c].map(high));
            all.push([c, b, a].map(low));
        }
        for [from, to] in edges {
            all.push([low(from), low(to), high(to)]);
            all.push([low(from), high(to), high(from)]);
        }
    }
    Ok(())
}

/// A polygon as triangles, counter-clockwise, and the edges around it with the polygon to their left.
#[derive(Default)]
struct TriangulatedPolygon {
    triangles: Vec<[[f64; 2]; 3]>,
    edges: Vec<[[f64; 2]; 2]>,
}

/// Triangulates a polygon; fails if its boundaries cross.
fn triangulate_polygon(polygon: &Polygon) -> io::Result<TriangulatedPolygon> {
    let (mut places, mut borders) = (Vec::new(), Vec::new());
    for border in std::iter::once(&polygon.outer).chain(&polygon.holes) {
        let start = places.len();
        places.extend(border.iter().map(|[x, y]| Point2::new(*x, *y)));
        let end = places.len();
        borders.extend((start..end).map(|at| [at, if at + 1 < end { at + 1 } else { start }]));
    }
    let mut crossing = false;
    let net = ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(places, borders, |_| {
        crossing = true;
    });
    let net = net.map_err(io::Error::other)?;
    if crossing {
        return Err(io::Error::other("a border of a piece crosses another one"));
    }
    // Go from the outside inwards: every boundary edge that is crossed changes between outside and inside.
    let mut inside: Vec<Option<bool>> = vec![None; net.num_all_faces()];
    let mut open: Vec<_> = net.convex_hull().map(|edge| (edge.rev(), edge.is_constraint_edge())).collect();
    let mut found = TriangulatedPolygon::default();
    while let Some((edge, within)) = open.pop() {
        let Some(face) = edge.face().as_inner() else { continue };
        let Some(known @ None) = inside.get_mut(face.index()) else { continue };
        *known = Some(within);
        if within {
            found.triangles.push(face.vertices().map(|corner| point_coordinates(corner.position())));
        }
        for edge in face.adjacent_edges() {
            if within && edge.is_constraint_edge() {
                found.edges.push([edge.from(), edge.to()].map(|corner| point_coordinates(corner.position())));
            }
            open.push((edge.rev(), within != edge.is_constraint_edge()));
        }
    }
    Ok(found)
}

fn point_coordinates(point: Point2<f64>) -> [f64; 2] {
    [point.x, point.y]
}
