//! The chips of a motion's pieces as one, layer by layer.

use super::LayerRow;
use crate::chips::chip::LayerChip;
use std::collections::BTreeMap;

/// Joins the chips of pieces of path that follow each other. `thickness` is the thickest chip of a tooth on a layer of a piece.
///
/// Areas add up, for what one piece removed the next one does not find. Where several pieces meet on a layer their borders stay
/// as they are, side by side.
pub(super) fn fuse<'a>(
    chips: impl Iterator<Item = (&'a LayerChip, Option<f64>)>,
    borders: bool,
) -> Vec<LayerRow> {
    let mut layers: BTreeMap<usize, LayerRow> = BTreeMap::new();
    for (chip, thickness) in chips {
        let row = layers.entry(chip.layer).or_insert_with(|| LayerRow {
            z: chip.z,
            thickness_mm: chip.thickness,
            chip_thickness_mm: Some(0.0),
            ..LayerRow::default()
        });
        row.area_mm2 += chip.area_mm2;
        row.inside_mm2 += chip.inside_mm2;
        row.count += chip.pieces.len();
        row.arcs_deg.extend(&chip.arcs_deg);
        // One piece whose thickness is not known, and nobody knows the thickest.
        row.chip_thickness_mm = row.chip_thickness_mm.zip(thickness).map(|(a, b)| a.max(b));
        if borders {
            row.polygons.extend(chip.pieces.iter().cloned());
        }
    }
    let mut rows: Vec<LayerRow> = layers.into_values().collect();
    for row in &mut rows {
        row.arcs_deg = joined(&row.arcs_deg);
    }
    rows
}

/// Arcs of a circle in degrees as few that do not overlap, in order, each beginning in -180..180.
fn joined(arcs: &[[f64; 2]]) -> Vec<[f64; 2]> {
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
    // What was cut at +-180 is one arc again.
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
