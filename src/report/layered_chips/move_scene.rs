//! This module holds moves with the workpiece around them, from which pictures are made.

use super::ChipLayerRow;
use crate::engagement::PathPiece;
use crate::layered_chips::{FlatMill, Polygon};
use crate::simulation_run::Machining;
use crate::simulation_run::layer_run::{MotionChips, to_flat_mill};

/// A move and the workpiece around it, for pictures.
#[derive(Debug, Clone, PartialEq)]
pub struct MoveScene {
    /// Line of the motion.
    pub line: usize,
    /// Its mill.
    pub mill: FlatMill,
    /// Its pieces in order.
    pub pieces: Vec<PathPiece>,
    /// The layers that it cuts, from below.
    pub layers: Vec<MoveSceneLayer>,
}

/// A layer of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct MoveSceneLayer {
    /// Height of its middle, mm.
    pub z_mm: f64,
    /// Its thickness, mm.
    pub thickness_mm: f64,
    /// The workpiece after the move.
    pub workpiece: Vec<Polygon>,
    /// The chip.
    pub chip: Vec<Polygon>,
}

impl MoveSceneLayer {
    /// Returns whether a height is in the layer.
    pub(crate) fn contains_height(&self, z_mm: f64) -> bool {
        (z_mm - self.z_mm).abs() <= self.thickness_mm / 2.0
    }
}

/// Makes the scene of a motion that was just cut.
pub(super) fn build_scene(
    cut: &MotionChips<'_>,
    rows: &[ChipLayerRow],
    machining: &Machining<'_>,
) -> Option<MoveScene> {
    let cutter = machining.tooling().cutters().get(cut.cutter?)?;
    let layer = |row: &ChipLayerRow| {
        let stands = cut.stack.layers().iter().find(|layer| layer.number() == row.number);
        MoveSceneLayer {
            z_mm: row.z_mm,
            thickness_mm: row.thickness_mm,
            workpiece: stands.map(|layer| layer.remaining_polygons()).unwrap_or_default(),
            chip: row.polygons.clone(),
        }
    };
    Some(MoveScene {
        line: cut.line,
        mill: to_flat_mill(cutter).ok()?,
        pieces: cut.pieces.iter().map(|(step, _)| step.piece).collect(),
        layers: rows.iter().filter(|row| row.area_mm2 > 0.0).map(layer).collect(),
    })
}
