//! What pieces of path remove.

mod engaged_arcs;

use super::Polygon;
use super::boundary_diagram::BoundaryDiagram;
use super::mill_step::{FlatMill, MillStep, MillStepError};
use super::section_family::SectionFamily;
use super::stack::{Layer, LayerStack};
use super::swept_area::{LayerSweptArea, RimDirections};
use crate::sim::PathPiece;
use rayon::prelude::*;

/// The chip of a piece of path on one layer.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerChip {
    /// Number of the layer, from below.
    pub layer: usize,
    /// Height of the layer's middle, mm.
    pub z: f64,
    /// Thickness of the layer, mm.
    pub thickness: f64,
    /// Area of the chip, mm2.
    pub area_mm2: f64,
    /// Material that stood inside the cutter before the piece began, mm2; it is gone afterwards and no part of the chip.
    pub inside_mm2: f64,
    /// Its pieces.
    pub pieces: Vec<Polygon>,
    /// Where the last edge borders on the chip: angles in degrees of a tooth about the tool axis, from the direction in which the
    /// section's centre moves (from x where it stands), counter-clockwise seen from above; each `[in, out]` with `in < out` and
    /// `-180 <= in < 180`, in order.
    pub arcs_deg: Vec<[f64; 2]>,
    /// How far the engaged edge advances along the normal of the cutter's surface in space at most, in mm for the whole piece at the speed that
    /// it has at the end: the largest thickness of the chip were the piece one tooth's advance. On the flutes and, where the layer
    /// meets it, on the bottom disc.
    pub advance_mm: f64,
}

/// The chip of a piece of path.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Chip {
    /// Its layers from below, those with a chip or with material inside the cutter only.
    pub layers: Vec<LayerChip>,
}

impl Chip {
    /// Volume, mm3: areas times thicknesses.
    pub fn volume_mm3(&self) -> f64 {
        self.layers.iter().map(|layer| layer.area_mm2 * layer.thickness).sum()
    }
}

/// Takes pieces of path out of the workpiece one after another: a chip for each, or why it was left out and nothing removed.
/// `PathPiece::cutter` counts `mills`. Sections are polygons with chords within `tolerance` (mm).
///
/// Layers do not know of each other and are worked on in parallel; the result is the same for any number of threads.
pub fn cut_chips(
    stack: &mut LayerStack,
    mills: &[FlatMill],
    pieces: &[PathPiece],
    tolerance: f64,
) -> Vec<Result<Chip, MillStepError>> {
    let steps: Vec<Result<(MillStep, RimDirections), MillStepError>> = pieces
        .iter()
        .map(|piece| {
            let mill = mills.get(piece.cutter).ok_or(MillStepError::NoCutter)?;
            let step = MillStep::new(*mill, piece)?;
            let rim = RimDirections::new(&step, tolerance);
            Ok((step, rim))
        })
        .collect();
    let layer = |layer: &mut Layer| -> Vec<(usize, LayerChip)> {
        let chips = steps.iter().enumerate().filter_map(|(index, step)| {
            let (step, rim) = step.as_ref().ok()?;
            Some((index, cut_layer_chip(layer, step, rim)?))
        });
        chips.collect()
    };
    let found: Vec<Vec<(usize, LayerChip)>> = stack.layers_mut().par_iter_mut().map(layer).collect();
    let mut chips: Vec<Result<Chip, MillStepError>> =
        steps.iter().map(|step| step.as_ref().map(|_| Chip::default()).map_err(|refusal| *refusal)).collect();
    for (index, chip) in found.into_iter().flatten() {
        if let Some(Ok(whole)) = chips.get_mut(index) {
            whole.layers.push(chip);
        }
    }
    chips
}

/// Widest ring along a section, mm, that counts as what chords leave.
const COARSEST: f64 = 0.005;

/// Takes one step out of a layer; `None` when nothing is removed.
fn cut_layer_chip(layer: &mut Layer, step: &MillStep, rim: &RimDirections) -> Option<LayerChip> {
    let z = layer.middle_z_mm();
    let [low, high] = step.height_range_mm();
    if z < low || z > high {
        return None;
    }
    let family = SectionFamily::new(step, z);
    let diagram = BoundaryDiagram::new(&family);
    let cover = LayerSweptArea::new(&diagram, rim);
    if cover.first.is_empty() && cover.is_empty() {
        return None;
    }
    let removed = layer.remove_swept_area(&cover);
    // Where chords of two steps' sections meet, less than their tolerance is left.
    let rounding = rim.tolerance_mm().min(COARSEST) * std::f64::consts::TAU * step.mill().radius;
    let inside_mm2 = if removed.inside_mm2 > rounding { removed.inside_mm2 } else { 0.0 };
    if removed.area_mm2 <= 0.0 && inside_mm2 <= 0.0 {
        return None;
    }
    let (arcs_deg, advance_mm) = engaged_arcs::find_engaged_arcs(&diagram, rim, &removed.pieces);
    Some(LayerChip {
        layer: layer.number(),
        z,
        thickness: layer.thickness_mm(),
        area_mm2: removed.area_mm2,
        inside_mm2,
        pieces: removed.pieces,
        arcs_deg,
        advance_mm,
    })
}
