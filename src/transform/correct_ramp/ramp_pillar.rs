//! This module cuts a ramp out of a block, with a cutter whose middle does not cut, and looks at the pillars that stay.

use super::ramp::Ramp;
use super::ramp_limits::IndexableCutter;
use super::ramp_proof::to_drawing_points;
use crate::cutter::{CutterModel, DeadMiddle, Meridian};
use crate::engagement::{PathPiece, PillarContact, Simulation};
use crate::program::geometry::Pose;
use crate::stock::{DexelGrid, Dexels};
use nalgebra::{Point3, Vector3};

/// The columns of the block along the diameter of the cutter, and at most along the sides of the block.
const COLUMNS_ACROSS: f64 = 80.0;
const MOST_COLUMNS: f64 = 2000.0;

/// The block reaches this much below the ramp, mm.
const FLOOR_MM: f64 = 1.0;

/// How certain the absence of pillars is to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PillarSearch {
    /// Columns are looked at as they are.
    AtColumns,
    /// A pillar between columns counts, too: one that is lower by what the ramp descends over three columns.
    BetweenColumns,
}

/// Returns the highest pillar that the body of a cutter runs into when it goes down a ramp through a block. The block reaches
/// as high as the ramp begins. Returns `None` if there is none, and for a cutter that cuts up to its axis.
pub fn find_pillar(ramp: &Ramp, cutter: &IndexableCutter, search: PillarSearch) -> Option<PillarContact> {
    let IndexableCutter { diameter, insert_radius, insert_height } = *cutter;
    let points: Vec<Point3<f64>> = to_drawing_points(ramp).into_iter().map(Point3::from).collect();
    let (mut low, mut high) = (ramp.start, ramp.start);
    for point in &points {
        (low, high) = (low.inf(point), high.sup(point));
    }
    let reach = Vector3::new(diameter, diameter, 0.0) / 2.0;
    let (low, high) = (low - reach - Vector3::z() * FLOOR_MM, high + reach);
    let cell_mm = (diameter / COLUMNS_ACROSS).max((high - low).xy().amax() / MOST_COLUMNS);
    let between = match search {
        PillarSearch::AtColumns => 0.0,
        PillarSearch::BetweenColumns => 3.0 * cell_mm * ramp.steepest_slope(),
    };
    let middle = DeadMiddle {
        radius_mm: diameter / 2.0 - insert_radius,
        // A ramp that goes straight down descends over no columns; its pillar is a column as high as the ramp.
        clearance_mm: if between.is_finite() { (insert_height - between).max(0.0) } else { insert_height },
    };
    let flutes = high.z - low.z + diameter;
    let profile = Meridian::new(diameter, 0.0, 0.0, 0.0, flutes).ok()?.with_dead_middle(middle);
    let cutter = CutterModel { profile, collars: Vec::new(), teeth: None };
    let mut simulation = Simulation::new(build_block(low, high, cell_mm), false);
    let pose = |point: Point3<f64>| Pose { point, axis: Vector3::z() };
    let pieces: Vec<PathPiece> = points
        .windows(2)
        .filter_map(|pair| match pair {
            [from, to] => Some(PathPiece { from: pose(*from), to: pose(*to), cutter: 0 }),
            _ => None,
        })
        .collect();
    let engaged = simulation.sweep_pieces(&pieces, &[cutter]);
    let found = engaged.iter().fold(None, |all, one| PillarContact::merge_pieces(all, one.pillar))?;
    Some(PillarContact { clearance_mm: insert_height, ..found })
}

/// Builds a block of columns between two corners.
fn build_block(low: Point3<f64>, high: Point3<f64>, cell_mm: f64) -> Dexels {
    let layout = DexelGrid::covering_box(low.into(), high.into(), cell_mm);
    let mut block = Dexels::with_empty_columns(layout);
    let top = (high.z - low.z) as f32;
    for row in 0..layout.rows {
        for column in 0..layout.columns {
            block.set_column(column, row, &[[0.0, top]]);
        }
    }
    block
}
