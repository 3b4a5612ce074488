//! Moves with the workpiece around them: what pictures are made of.

use super::LayerRow;
use crate::chips::{FlatMill, Polygon};
use crate::machining::Machining;
use crate::machining::chips::{ChipCut, flat};
use crate::sim::Piece;

/// A move and the workpiece around it, for pictures.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Line of the motion.
    pub line: usize,
    /// Its mill.
    pub mill: FlatMill,
    /// Its pieces in order.
    pub pieces: Vec<Piece>,
    /// The layers that it cuts, from below.
    pub layers: Vec<SceneLayer>,
}

/// A layer of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneLayer {
    /// Height of its middle, mm.
    pub z: f64,
    /// Its thickness, mm.
    pub thickness_mm: f64,
    /// The workpiece after the move.
    pub workpiece: Vec<Polygon>,
    /// The chip.
    pub chip: Vec<Polygon>,
}

impl SceneLayer {
    /// Whether a height is in the layer.
    pub fn holds(&self, z: f64) -> bool {
        (z - self.z).abs() <= self.thickness_mm / 2.0
    }
}

/// The picture of a motion that was cut just now.
pub(super) fn scene(cut: &ChipCut<'_>, rows: &[LayerRow], machining: &Machining<'_>) -> Option<Scene> {
    let cutter = machining.tooling().cutters().get(cut.cutter?)?;
    let layer = |row: &LayerRow| {
        let stands = cut.stack.layers().iter().find(|layer| layer.number() == row.number);
        SceneLayer {
            z: row.z,
            thickness_mm: row.thickness_mm,
            workpiece: stands.map(|layer| layer.polygons()).unwrap_or_default(),
            chip: row.polygons.clone(),
        }
    };
    Some(Scene {
        line: cut.line,
        mill: flat(cutter).ok()?,
        pieces: cut.pieces.iter().map(|(step, _)| step.piece).collect(),
        layers: rows.iter().filter(|row| row.area_mm2 > 0.0).map(layer).collect(),
    })
}
