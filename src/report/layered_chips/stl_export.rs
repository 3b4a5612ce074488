//! This module writes chips as solids in an STL file.

use super::{ChipLayerRow, ChipReport};
use crate::layered_chips::chip::{Chip, LayerChip};
use crate::layered_chips::stl_export::write_chip_stl;
use std::io::{self, Write};

/// Writes the chips of all requested motions as a binary STL in mm, if boundaries were kept. Each chip is a
/// stack of its layers, where it was cut.
///
/// # Errors
/// Returns the errors of [`write_chip_stl`].
pub fn write_stl(report: &ChipReport, out: &mut dyn Write) -> io::Result<()> {
    let layers = report.rows.iter().flat_map(|row| &row.layers).map(to_layer_chip);
    write_chip_stl(&Chip { layers: layers.collect() }, &report.frame, out)
}

fn to_layer_chip(row: &ChipLayerRow) -> LayerChip {
    LayerChip {
        layer: row.number,
        z_mm: row.z_mm,
        thickness_mm: row.thickness_mm,
        area_mm2: row.area_mm2,
        inside_mm2: row.inside_mm2,
        pieces: row.polygons.clone(),
        arcs_deg: Vec::new(),
        advance_mm: 0.0,
    }
}
