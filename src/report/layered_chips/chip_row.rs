//! One motion and its layers.

use crate::layered_chips::Polygon;
use crate::report::rounding::{round_to_micro, serialize_rounded, serialize_rounded_option};
use serde::{Serialize, Serializer};

/// A motion and its chip.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
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
    #[serde(serialize_with = "serialize_rounded")]
    pub length_mm: f64,
    /// Feed of the tool's tip, mm/min; of a rapid, the machine's.
    #[serde(serialize_with = "serialize_rounded_option")]
    pub feed_mm_min: Option<f64>,
    /// Volume of the chip, mm3.
    #[serde(serialize_with = "serialize_rounded")]
    pub volume_mm3: f64,
    /// Material that stood inside the cutter where the motion began and is part of no chip, mm3.
    #[serde(serialize_with = "serialize_rounded")]
    pub inside_mm3: f64,
    /// The thickest chip of a tooth, mm; 0 in air.
    #[serde(serialize_with = "serialize_rounded_option")]
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
    pub z: f64,
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
}

/// A border as the JSON has it.
struct BoundaryJson<'a>(&'a [[f64; 2]]);

impl Serialize for BoundaryJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.iter().map(|point| point.map(round_to_micro)))
    }
}

/// A layer as the JSON has it: `pieces` are outer borders, `holes` are holes, and `hole_of` says for each of these the number of
/// the piece that it is in, from 0.
#[derive(Serialize)]
struct ChipLayerJson<'a> {
    #[serde(serialize_with = "serialize_rounded")]
    z: f64,
    #[serde(serialize_with = "serialize_rounded")]
    thickness_mm: f64,
    #[serde(serialize_with = "serialize_rounded")]
    area_mm2: f64,
    #[serde(serialize_with = "serialize_rounded")]
    inside_mm2: f64,
    #[serde(serialize_with = "serialize_rounded_option")]
    chip_thickness_mm: Option<f64>,
    arcs_deg: Vec<[f64; 2]>,
    pieces: Vec<BoundaryJson<'a>>,
    holes: Vec<BoundaryJson<'a>>,
    hole_of: Vec<usize>,
}

impl Serialize for ChipLayerRow {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let holes = || {
            let pieces = self.polygons.iter().enumerate();
            pieces.flat_map(|(index, polygon)| polygon.holes.iter().map(move |hole| (index, hole)))
        };
        let layer = ChipLayerJson {
            z: self.z,
            thickness_mm: self.thickness_mm,
            area_mm2: self.area_mm2,
            inside_mm2: self.inside_mm2,
            chip_thickness_mm: self.chip_thickness_mm,
            arcs_deg: self.arcs_deg.iter().map(|arc| arc.map(round_to_micro)).collect(),
            pieces: self.polygons.iter().map(|polygon| BoundaryJson(&polygon.outer)).collect(),
            holes: holes().map(|(_, hole)| BoundaryJson(hole)).collect(),
            hole_of: holes().map(|(index, _)| index).collect(),
        };
        layer.serialize(serializer)
    }
}
