//! This module defines the row of a motion with its layers.

use super::ChipMoment;
use crate::layered_chips::Polygon;

/// A motion and its chip.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ChipRow {
    /// The line of the statement that ends the motion, counted from 1.
    pub line: usize,
    /// Its operation. It is empty if the file has none.
    pub operation: String,
    /// Its tool: the number if it is known, else the name.
    pub tool: String,
    /// Whether it is a rapid.
    pub rapid: bool,
    /// Length of the path, mm.
    pub length_mm: f64,
    /// The feed of the tool's tip in mm/min. For a rapid it is the machine's rapid feed.
    pub feed_mm_min: Option<f64>,
    /// Volume of the chip, mm3.
    pub volume_mm3: f64,
    /// The material that was inside the cutter where the motion began and is part of no chip, mm3.
    pub inside_mm3: f64,
    /// The thickest chip of a tooth, mm; 0 in air.
    pub chip_thickness_mm: Option<f64>,
    /// Its layers from below. Layers without a chip and without material inside the cutter are left out.
    pub layers: Vec<ChipLayerRow>,
    /// The index of the motion in the program.
    pub motion: usize,
    /// The chips of equal parts of the motion, if they were asked for.
    pub moments: Vec<ChipMoment>,
}

/// The chip of a motion on one layer.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ChipLayerRow {
    /// Number of the layer, from below.
    pub number: usize,
    /// Height of the layer's middle, mm.
    pub z_mm: f64,
    /// Its thickness, mm.
    pub thickness_mm: f64,
    /// Area of the chip, mm2.
    pub area_mm2: f64,
    /// The material that was inside the cutter where the motion began and is part of no chip, mm2.
    pub inside_mm2: f64,
    /// The thickest chip of a tooth anywhere along the path, mm.
    pub chip_thickness_mm: Option<f64>,
    /// The arcs in which the edge was engaged at the end
    /// ([`crate::layered_chips::chip::LayerChip::arcs_deg`]). For several pieces of path, they are the union
    /// of all.
    pub arcs_deg: Vec<[f64; 2]>,
    /// The number of separate pieces of the chip.
    pub count: usize,
    /// These pieces, if boundaries are kept.
    pub polygons: Vec<Polygon>,
}

impl ChipLayerRow {
    /// Returns the sum of the arcs of engagement, in degrees.
    pub fn engaged_deg(&self) -> f64 {
        self.arcs_deg.iter().map(|[from, to]| to - from).sum()
    }

    /// Returns the sum of the arcs of engagement in degrees, if it is known. The arcs are those at the end of
    /// the motion. If the tool has left the chip by then, there are none, and the engagement before is not
    /// known.
    pub(super) fn known_engagement_deg(&self) -> Option<f64> {
        (self.area_mm2 <= 0.0 || !self.arcs_deg.is_empty()).then(|| self.engaged_deg())
    }
}
