//! One motion and its layers.

use crate::layered_chips::Polygon;

/// A motion and its chip.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ChipRow {
    /// 1-based line of the statement that ends the motion.
    pub line: usize,
    /// Its operation; empty where the file has none.
    pub operation: String,
    /// Its tool: the number where it is known, else the name.
    pub tool: String,
    /// Whether it is a rapid.
    pub rapid: bool,
    /// Length of the path, mm.
    pub length_mm: f64,
    /// Feed of the tool's tip, mm/min; of a rapid, the machine's.
    pub feed_mm_min: Option<f64>,
    /// Volume of the chip, mm3.
    pub volume_mm3: f64,
    /// Material that stood inside the cutter where the motion began and is part of no chip, mm3.
    pub inside_mm3: f64,
    /// The thickest chip of a tooth, mm; 0 in air.
    pub chip_thickness_mm: Option<f64>,
    /// Its layers from below, those with a chip or with material inside the cutter.
    pub layers: Vec<ChipLayerRow>,
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
    /// Material that stood inside the cutter where the motion began and is part of no chip, mm2.
    pub inside_mm2: f64,
    /// The thickest chip of a tooth anywhere on the way, mm.
    pub chip_thickness_mm: Option<f64>,
    /// Where the edge was engaged at the end ([`crate::layered_chips::chip::LayerChip::arcs_deg`]); of several pieces of path, all that any of them was.
    pub arcs_deg: Vec<[f64; 2]>,
    /// How many separate pieces the chip is in.
    pub count: usize,
    /// These pieces, where borders are kept.
    pub polygons: Vec<Polygon>,
}

impl ChipLayerRow {
    /// Sum of the arcs of engagement, degrees.
    pub fn engaged_deg(&self) -> f64 {
        self.arcs_deg.iter().map(|[from, to]| to - from).sum()
    }

    /// The same where it is known: what has left the chip at the motion's end is engaged no longer, and how
    /// it was before is not known.
    pub(super) fn known_engagement_deg(&self) -> Option<f64> {
        (self.area_mm2 <= 0.0 || !self.arcs_deg.is_empty()).then(|| self.engaged_deg())
    }
}
