//! What one piece of path removes.

use super::Polygon;

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
    /// Where the last edge is engaged: angles in degrees about the tool axis from the direction in which the section moves,
    /// counter-clockwise seen from +z; each `[in, out]` with `in < out`, -180..=180 for `in`.
    pub arcs_deg: Vec<[f64; 2]>,
    /// Largest share of the tip's way with which the engaged edge advances along its own normal in space, times the length of the piece:
    /// the largest thickness of the chip were the piece one tooth's advance, mm.
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

/// stand-in
pub fn cut(
    stack: &mut super::stack::Stack,
    mills: &[super::FlatMill],
    pieces: &[crate::sim::Piece],
    tolerance: f64,
) -> Vec<Result<Chip, super::Refusal>> {
    use rayon::prelude::*;
    let steps: Vec<Result<super::Step, super::Refusal>> = pieces
        .iter()
        .map(|piece| super::Step::new(mills.get(piece.cutter).copied().ok_or(super::Refusal::NoCutter)?, piece))
        .collect();
    let found: Vec<Vec<(usize, LayerChip)>> = stack
        .layers_mut()
        .par_iter_mut()
        .map(|layer| {
            let mut out = Vec::new();
            for (index, step) in steps.iter().enumerate() {
                let Ok(step) = step else { continue };
                let [low, high] = step.reach();
                if layer.z() < low || layer.z() > high {
                    continue;
                }
                let family = super::family::Family::new(step, layer.z());
                let diagram = super::diagram::Diagram::new(&family);
                let rim = super::cover::Rim::new(step, tolerance);
                let cover = super::cover::Cover::new(&diagram, &rim);
                let removed = layer.remove(&cover);
                if removed.area_mm2 > 0.0 || removed.inside_mm2 > 0.0 {
                    out.push((
                        index,
                        LayerChip {
                            layer: layer.number(),
                            z: layer.z(),
                            thickness: layer.thickness(),
                            area_mm2: removed.area_mm2,
                            inside_mm2: removed.inside_mm2,
                            pieces: removed.pieces,
                            arcs_deg: vec![[-90.0, 90.0]],
                            advance_mm: step.length_mm(),
                        },
                    ));
                }
            }
            out
        })
        .collect();
    let mut chips: Vec<Result<Chip, super::Refusal>> =
        steps.iter().map(|step| step.as_ref().map(|_| Chip::default()).map_err(|r| *r)).collect();
    for (index, layer) in found.into_iter().flatten() {
        if let Some(Ok(chip)) = chips.get_mut(index) {
            chip.layers.push(layer);
        }
    }
    chips
}
