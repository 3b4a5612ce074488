//! This module computes the chip that each piece of path removes from the layers.

mod engaged_arcs;

use super::Polygon;
use super::boundary_diagram::BoundaryDiagram;
use super::mill_step::{FlatMill, MillStep, MillStepError};
use super::section_family::SectionFamily;
use super::stack::{Layer, LayerStack};
use super::swept_area::{LayerSweptArea, RimDirections};
use crate::engagement::PathPiece;
use rayon::prelude::*;

/// The chip of a piece of path on one layer.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerChip {
    /// The number of the layer, counted from below.
    pub layer: usize,
    /// The height of the layer's middle, mm.
    pub z_mm: f64,
    /// The thickness of the layer, mm.
    pub thickness_mm: f64,
    /// The area of the chip, mm2.
    pub area_mm2: f64,
    /// The area of material that was inside the cutter before the piece began, mm2. It is removed but does
    /// not belong to the chip.
    pub inside_mm2: f64,
    /// The pieces of the chip.
    pub pieces: Vec<Polygon>,
    /// The arcs on which the last edge touches the chip. An arc has the angles `[in, out]` of a tooth around
    /// the tool axis in degrees, with `in < out` and `-180 <= in < 180`. They count counter-clockwise seen
    /// from above, from the direction in which the section's centre moves, or from x if it does not move. The
    /// arcs are sorted.
    pub arcs_deg: Vec<[f64; 2]>,
    /// The largest advance of the engaged edge along the normal of the cutter's surface in space, in mm for
    /// the whole piece at the speed at its end. It is the thickness of the chip if the piece is the advance
    /// of one tooth. It covers the flutes and, if the layer meets it, the bottom disc.
    pub advance_mm: f64,
}

/// The chip of a piece of path.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Chip {
    /// The layers from below that have a chip or material inside the cutter.
    pub layers: Vec<LayerChip>,
}

impl Chip {
    /// Returns the volume, mm3: the sum of area times thickness.
    pub fn volume_mm3(&self) -> f64 {
        self.layers.iter().map(|layer| layer.area_mm2 * layer.thickness_mm).sum()
    }
}

/// Removes pieces of path from the workpiece one after another. Returns a chip for each piece, or the reason
/// why the piece was left out and removed nothing. `PathPiece::cutter` is an index in `mills`. Sections are
/// polygons whose chords are within `tolerance_mm`.
///
/// Layers do not depend on each other and are processed in parallel; the result is the same for any number of
/// threads.
///
/// ```
/// use clsmith::engagement::PathPiece;
/// use clsmith::layered_chips::{FlatMill, LayerStack, cut_chips};
/// use clsmith::program::geometry::Pose;
/// use clsmith::stock::{SolidBody, Stock};
/// use nalgebra::{Point3, Vector3};
///
/// let block = SolidBody::Block { from: [0.0, -20.0, -10.0], to: [60.0, 20.0, 0.0] };
/// let mut stack = LayerStack::new(&Stock::new(vec![block], 0.0)?, 0.5)?;
/// let mill = FlatMill { radius_mm: 5.0, flute_length_mm: 20.0 };
/// let at = |x: f64| Pose { point: Point3::new(x, 0.0, -2.0), axis: Vector3::z() };
/// // The cutter makes its way to the middle; then it advances by 0.1 mm.
/// let pieces = [
///     PathPiece { from: at(-6.0), to: at(30.0), cutter: 0 },
///     PathPiece { from: at(30.0), to: at(30.1), cutter: 0 },
/// ];
/// let chips = cut_chips(&mut stack, &[mill], &pieces, 1e-4);
/// let chip = chips[1].as_ref().expect("an upright mill that moves");
/// // The crescent's area is diameter times advance; it is 2 mm thick.
/// assert!((chip.volume_mm3() - 10.0 * 0.1 * 2.0).abs() < 1e-2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn cut_chips(
    stack: &mut LayerStack,
    mills: &[FlatMill],
    pieces: &[PathPiece],
    tolerance_mm: f64,
) -> Vec<Result<Chip, MillStepError>> {
    cut_chips_until(stack, mills, pieces, tolerance_mm, &|| false)
}

/// Does the same as [`cut_chips`], but leaves the rest of the work as soon as `is_stopped` says so. Then stack and chips
/// are of no use any more.
pub(crate) fn cut_chips_until(
    stack: &mut LayerStack,
    mills: &[FlatMill],
    pieces: &[PathPiece],
    tolerance_mm: f64,
    is_stopped: &(dyn Fn() -> bool + Sync),
) -> Vec<Result<Chip, MillStepError>> {
    let steps: Vec<Result<(MillStep, RimDirections), MillStepError>> = pieces
        .iter()
        .map(|piece| {
            let mill = mills.get(piece.cutter).ok_or(MillStepError::NoCutter)?;
            let step = MillStep::new(*mill, piece)?;
            let rim = RimDirections::new(&step, tolerance_mm);
            Ok((step, rim))
        })
        .collect();
    let layer = |layer: &mut Layer| -> Vec<(usize, LayerChip)> {
        let going_on = steps.iter().enumerate().take_while(|_| !is_stopped());
        let chips = going_on.filter_map(|(index, step)| {
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

/// The greatest width, in mm, of a ring along a section that counts as the error of chords.
const COARSEST: f64 = 0.005;

/// Removes one step from a layer. Returns `None` if nothing is removed.
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
    // Where chords of two steps' sections meet, a ring that is thinner than the tolerance may be left.
    let rounding = rim.tolerance_mm().min(COARSEST) * std::f64::consts::TAU * step.mill().radius_mm;
    let inside_mm2 = if removed.inside_mm2 > rounding { removed.inside_mm2 } else { 0.0 };
    if removed.area_mm2 <= 0.0 && inside_mm2 <= 0.0 {
        return None;
    }
    let (arcs_deg, advance_mm) = engaged_arcs::find_engaged_arcs(&diagram, rim, &removed.pieces);
    Some(LayerChip {
        layer: layer.number(),
        z_mm: z,
        thickness_mm: layer.thickness_mm(),
        area_mm2: removed.area_mm2,
        inside_mm2,
        pieces: removed.pieces,
        arcs_deg,
        advance_mm,
    })
}
