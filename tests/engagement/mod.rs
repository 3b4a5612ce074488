//! Engagement: a cutter along a path over a block, and the chips and forces that follow.

mod chips;
mod cuts;
mod edge_thickness;
mod force_cases;
mod force_frames;
mod section_forces;
mod tilted;
mod tilted_engagement;
mod tool_bending;

use clsmith::cutter::{CutterModel, Meridian};
use clsmith::engagement::{Engagement, PathPiece, Simulation};
use clsmith::program::geometry::Pose;
use clsmith::stock::{DexelGrid, Dexels};
use nalgebra::{Point3, Vector3};

/// A block of stock.
pub fn block(from: [f64; 3], to: [f64; 3], cell: f64) -> Dexels {
    let layout = DexelGrid::covering_box(from, to, cell);
    let mut dexels = Dexels::with_empty_columns(layout);
    for row in 0..layout.rows {
        for column in 0..layout.columns {
            dexels.set_column(column, row, &[[0.0, (to[2] - from[2]) as f32]]);
        }
    }
    dexels
}

/// A cutter without teeth or collars, with 50 mm of flutes; angles in degrees.
pub fn cutter(diameter: f64, corner: f64, taper: f64, tip: f64) -> CutterModel {
    let profile = Meridian::new(diameter, corner, taper.to_radians(), tip.to_radians(), 50.0).unwrap();
    CutterModel { profile, collars: Vec::new(), teeth: None }
}

/// A tip with the axis along z.
pub fn at(x: f64, y: f64, z: f64) -> Pose {
    Pose { point: Point3::new(x, y, z), axis: Vector3::z() }
}

/// Straight pieces through points.
pub fn path(points: &[[f64; 3]]) -> Vec<PathPiece> {
    points
        .windows(2)
        .map(|pair| PathPiece {
            from: at(pair[0][0], pair[0][1], pair[0][2]),
            to: at(pair[1][0], pair[1][1], pair[1][2]),
            cutter: 0,
        })
        .collect()
}

/// Runs a path over a stock.
pub fn run(stock: Dexels, cutter: &CutterModel, points: &[[f64; 3]]) -> (Dexels, Vec<Engagement>) {
    let mut simulation = Simulation::new(stock, true);
    let found = simulation.sweep_pieces(&path(points), std::slice::from_ref(cutter));
    (simulation.into_stock(), found)
}
