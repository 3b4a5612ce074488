//! This module merges the chips of a motion's pieces, layer by layer.

use super::ChipLayerRow;
use crate::layered_chips::Polygon;
use crate::layered_chips::area::{AreaGrid, Clipper, GridArea, signed_area_mm2};
use crate::layered_chips::chip::LayerChip;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Merges the chips of consecutive pieces of path. `chips` gives each layer of each piece with the thickest
/// chip of a tooth there, in mm, if it is known. `grid` is the grid on which the workpiece was cut. `borders`
/// tells whether to keep boundaries.
///
/// Areas add up, because one piece does not find what the previous one has removed. Where chips of several
/// pieces touch, their boundaries are merged.
pub(super) fn merge_piece_chips<'a>(
    chips: impl Iterator<Item = (&'a LayerChip, Option<f64>)>,
    grid: &AreaGrid,
    borders: bool,
) -> Vec<ChipLayerRow> {
    let mut layers: BTreeMap<usize, (ChipLayerRow, Vec<&[Polygon]>)> = BTreeMap::new();
    for (chip, thickness) in chips {
        let (row, parts) = layers.entry(chip.layer).or_insert_with(|| {
            let row = ChipLayerRow {
                number: chip.layer,
                z_mm: chip.z_mm,
                thickness_mm: chip.thickness_mm,
                ..ChipLayerRow::default()
            };
            (row, Vec::new())
        });
        row.area_mm2 += chip.area_mm2;
        row.inside_mm2 += chip.inside_mm2;
        row.arcs_deg.extend(&chip.arcs_deg);
        // A thickness that is not known does not hide a known one.
        row.chip_thickness_mm = [row.chip_thickness_mm, thickness].into_iter().flatten().reduce(f64::max);
        if !chip.pieces.is_empty() {
            parts.push(&chip.pieces);
        }
    }
    let whole = |(mut row, parts): (ChipLayerRow, Vec<&[Polygon]>)| {
        row.arcs_deg = merge_arcs(&row.arcs_deg);
        let polygons = match parts.as_slice() {
            [] => Cow::Borrowed([].as_slice()),
            [only] => Cow::Borrowed(*only),
            several => Cow::Owned(merge_polygons(several, grid)),
        };
        row.count = polygons.len();
        if borders {
            row.polygons = polygons.into_owned();
        }
        row
    };
    layers.into_values().map(whole).collect()
}

/// Holes that are thinner than this, in mm, are left out. They come from the chords that approximate the
/// boundaries of consecutive pieces.
const THINNEST: f64 = 0.005;

/// Returns whether a boundary encloses something thicker than [`THINNEST`].
fn is_thick_boundary(border: &[[f64; 2]]) -> bool {
    let next = border.iter().cycle().skip(1);
    let around: f64 = border.iter().zip(next).map(|([ax, ay], [bx, by])| (bx - ax).hypot(by - ay)).sum();
    // A long strip has the area of its width times half its perimeter.
    signed_area_mm2(border).abs() > THINNEST * around / 2.0
}

/// Merges adjacent polygons.
fn merge_polygons(parts: &[&[Polygon]], grid: &AreaGrid) -> Vec<Polygon> {
    let polygons = parts.iter().flat_map(|part| part.iter());
    let borders = polygons.flat_map(|polygon| std::iter::once(&polygon.outer).chain(&polygon.holes));
    let mut whole =
        Clipper::default().extract_polygons(&GridArea::new(grid, borders.map(Vec::as_slice)), grid).0;
    whole.iter_mut().for_each(|polygon| polygon.holes.retain(|hole| is_thick_boundary(hole)));
    whole
}

/// Merges arcs of a circle in degrees. The result does not overlap, is in order, and each arc begins in
/// -180..180.
fn merge_arcs(arcs: &[[f64; 2]]) -> Vec<[f64; 2]> {
    const TURN: f64 = 360.0;
    let mut flat: Vec<[f64; 2]> = Vec::new();
    for [from, to] in arcs {
        if to - from >= TURN {
            return vec![[-180.0, 180.0]];
        }
        let start = (from + 180.0).rem_euclid(TURN) - 180.0;
        let end = start + (to - from);
        flat.push([start, end.min(180.0)]);
        if end > 180.0 {
            flat.push([-180.0, end - TURN]);
        }
    }
    flat.sort_by(|[a, _], [b, _]| a.total_cmp(b));
    let mut joined: Vec<[f64; 2]> = Vec::new();
    for [from, to] in flat {
        match joined.last_mut() {
            Some([_, end]) if from <= *end => *end = end.max(to),
            _ => joined.push([from, to]),
        }
    }
    // An arc that was split at +-180 degrees is joined again.
    if let ([[first, end], .., [_, last]], 2..) = (joined.as_slice(), joined.len())
        && *first <= -180.0
        && *last >= 180.0
    {
        let end = *end + TURN;
        joined.remove(0);
        if let Some([_, last]) = joined.last_mut() {
            *last = end;
        }
    }
    joined
}
