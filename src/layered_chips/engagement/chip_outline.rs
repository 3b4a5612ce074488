//! This module holds the boundaries of a piece of a chip, and measures the material between them.

use crate::layered_chips::Polygon;
use nalgebra::Vector3;

/// The most samples of one straight edge.
const MOST: f64 = 512.0;

/// The number of places of the interior in each direction.
const INSIDE: usize = 8;

/// The least component of the normal in the layer. Below it, a width in the layer says nothing about the
/// thickness along the normal.
const LEVEL: f64 = 0.05;

/// Points closer to a boundary than this (mm) are on it.
const ON: f64 = 1e-6;

/// The boundaries of one piece of a chip in its layer.
pub(super) struct ChipOutline<'p> {
    polygon: &'p Polygon,
    /// The straight edges of all boundaries.
    edges: Vec<[[f64; 2]; 2]>,
}

impl<'p> ChipOutline<'p> {
    pub(super) fn new(polygon: &'p Polygon) -> Self {
        let mut edges = Vec::with_capacity(polygon.vertex_count());
        for border in std::iter::once(&polygon.outer).chain(&polygon.holes) {
            edges.extend(boundary_edges(border));
        }
        Self { polygon, edges }
    }

    /// Returns the boundaries, the outer one first.
    pub(super) fn borders(&self) -> impl Iterator<Item = &'p [[f64; 2]]> {
        let polygon = self.polygon;
        std::iter::once(&polygon.outer).chain(&polygon.holes).map(Vec::as_slice)
    }

    /// Returns the thickness along the normal of the material around a point, mm; infinite if the width in the
    /// layer does not determine it.
    pub(super) fn measure_thickness_mm(&self, place: [f64; 2], normal: &Vector3<f64>) -> f64 {
        let level = normal.x.hypot(normal.y);
        if level < LEVEL {
            return f64::INFINITY;
        }
        // Beyond the point, an odd number of crossings is left if the point is inside.
        let [mut ahead, mut behind] = [(false, f64::INFINITY); 2];
        for at in self.find_crossings(place, [normal.x / level, normal.y / level]) {
            if at > ON {
                ahead = (!ahead.0, ahead.1.min(at));
            } else if -at > ON {
                behind = (!behind.0, behind.1.min(-at));
            }
        }
        let width = |(inside, nearest): (bool, f64)| if inside { nearest } else { 0.0 };
        // The width in the layer times the cosine of the normal's lean is the thickness along the normal.
        (width(ahead) + width(behind)) * level
    }

    /// Returns places of the interior on a grid over the box around it, and their distance, mm.
    pub(super) fn places_inside(&self) -> (impl Iterator<Item = [f64; 2]>, f64) {
        let (places, spacing) = self.places_in_box();
        (places.filter(|place| self.contains(*place)), spacing)
    }

    /// Returns places on a grid over the box around the boundaries, and their distance, mm.
    pub(super) fn places_in_box(&self) -> (impl Iterator<Item = [f64; 2]> + use<>, f64) {
        let mut window = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        for [place, _] in &self.edges {
            for ([low, high], at) in window.iter_mut().zip(place) {
                (*low, *high) = (low.min(*at), high.max(*at));
            }
        }
        let [[x0, x1], [y0, y1]] = window;
        let [across, along] = [(x1 - x0) / INSIDE as f64, (y1 - y0) / INSIDE as f64];
        let all = (0..INSIDE).flat_map(|column| (0..INSIDE).map(move |row| (column, row)));
        let places = all
            .map(move |(column, row)| [x0 + across * (column as f64 + 0.5), y0 + along * (row as f64 + 0.5)]);
        (places, across.max(along))
    }

    /// Returns whether a point is inside: a ray from it crosses the boundaries an odd number of times.
    pub(super) fn contains(&self, place: [f64; 2]) -> bool {
        self.find_crossings(place, [1.0, 0.0]).filter(|at| *at > 0.0).count() % 2 == 1
    }

    /// Returns where a line through a point crosses the boundaries, in mm along the line.
    fn find_crossings(&self, [x, y]: [f64; 2], [ux, uy]: [f64; 2]) -> impl Iterator<Item = f64> {
        let seen = move |[px, py]: [f64; 2]| {
            let (dx, dy) = (px - x, py - y);
            [dx * ux + dy * uy, dy * ux - dx * uy]
        };
        self.edges.iter().filter_map(move |[a, b]| {
            let ([a, above], [b, below]) = (seen(*a), seen(*b));
            ((above > 0.0) != (below > 0.0)).then(|| a + (b - a) * above / (above - below))
        })
    }
}

/// Returns the edges of a closed boundary.
fn boundary_edges(border: &[[f64; 2]]) -> impl Iterator<Item = [[f64; 2]; 2]> {
    border.iter().zip(border.iter().cycle().skip(1)).map(|(from, to)| [*from, *to])
}

/// Returns the vertices of a boundary, with points added so that no two are further apart than a distance.
pub(super) fn subdivide_boundary(border: &[[f64; 2]], apart: f64) -> Vec<[f64; 2]> {
    let mut places = Vec::with_capacity(2 * border.len());
    for [[ax, ay], [bx, by]] in boundary_edges(border) {
        let parts = ((bx - ax).hypot(by - ay) / apart).ceil().clamp(1.0, MOST);
        let between = (0..parts as usize).map(|part| part as f64 / parts);
        places.extend(between.map(|part| [ax + (bx - ax) * part, ay + (by - ay) * part]));
    }
    places
}
