//! This module moves cutters along pieces of path through the stock.
//!
//! Columns do not depend on each other. So bands of 32 rows ([`crate::stock::dexel::BAND_ROWS`]) are
//! processed in parallel, each by all pieces of a batch in their order, and the results of the bands are
//! added up in the order of the bands. The result is therefore the same for any number of threads.

use crate::cutter::CutterModel;
use crate::engagement::engagement_bins::Engagement;
use crate::engagement::path_piece::PathPiece;
use crate::engagement::sweep::{BandEngagement, PieceSweep, StraightSweep, SweepContext, TiltedSweep};
use crate::program::geometry::Pose;
use crate::stock::AirClip;
use crate::stock::dexel::Dexels;
use nalgebra::Vector3;
use rayon::prelude::*;

/// The stock, and the state that carries over from one piece of path to the next.
///
/// ```
/// use clsmith::cutter::{CutterModel, Meridian, Teeth};
/// use clsmith::engagement::{PathPiece, Simulation};
/// use clsmith::program::geometry::Pose;
/// use clsmith::stock::{SolidBody, Stock};
/// use nalgebra::{Point3, Vector3};
///
/// let block = SolidBody::Block { from: [0.0, -20.0, -10.0], to: [60.0, 20.0, 0.0] };
/// let stock = Stock::new(vec![block], 0.0)?.to_dexels(0.5, 1_000_000)?;
/// let teeth = Teeth::evenly_spaced(4, 0.0).expect("four teeth");
/// let mill = CutterModel {
///     profile: Meridian::new(10.0, 0.0, 0.0, 0.0, 20.0)?,
///     collars: Vec::new(),
///     teeth: Some(teeth.clone()),
/// };
/// let at = |x: f64| Pose { point: Point3::new(x, 0.0, -2.0), axis: Vector3::z() };
/// let slot = PathPiece { from: at(-6.0), to: at(30.0), cutter: 0 };
///
/// let mut simulation = Simulation::new(stock, false);
/// let engagement = &simulation.sweep_pieces(&[slot], &[mill])[0];
/// assert!((engagement.axial_depth_mm() - 2.0).abs() < 1e-3);
/// // A full slot at 1000 mm/min and 5000 rev/min: 0.2 mm a turn for four teeth.
/// assert!((engagement.chip_thickness_mm(&teeth, 1000.0, 5000.0) - 0.05).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Simulation {
    stock: Dexels,
    highest: f64,
    last: Option<(Pose, usize)>,
    detail: bool,
    removal_window_mm: Option<f64>,
}

impl Simulation {
    /// Starts a simulation with this stock. `detail` fills the engagement finely enough for forces, which
    /// takes several times as long.
    pub fn new(stock: Dexels, detail: bool) -> Self {
        let highest = stock.highest_z_mm().unwrap_or(f64::NEG_INFINITY);
        Self { stock, highest, last: None, detail, removal_window_mm: None }
    }

    /// Lets pieces that are longer than half of this window tell where on their way they remove how much
    /// ([`Engagement::removal`]).
    #[must_use]
    pub fn with_removal_window_mm(self, window_mm: Option<f64>) -> Self {
        Self { removal_window_mm: window_mm, ..self }
    }

    /// Returns the stock that is left.
    pub fn stock(&self) -> &Dexels {
        &self.stock
    }

    /// Ends the simulation and returns the stock that is left.
    pub fn into_stock(self) -> Dexels {
        self.stock
    }

    /// Moves cutters along pieces of path, removes what they sweep, and returns one engagement for each
    /// piece. A piece whose cutter is not in the list engages nothing.
    pub fn sweep_pieces(&mut self, pieces: &[PathPiece], cutters: &[CutterModel]) -> Vec<Engagement> {
        let sweeps: Vec<Option<PieceSweep>> = pieces
            .iter()
            .enumerate()
            .map(|(index, piece)| {
                let goes_on = pieces.get(index + 1).is_some_and(|next| is_continued_by(piece, next));
                self.prepare_sweep(piece, cutters, !goes_on)
            })
            .collect();
        // The pieces of one band run in program order, since each meets what the pieces before it left.
        let found: Vec<Vec<(usize, BandEngagement)>> = self
            .stock
            .bands_mut()
            .par_iter_mut()
            .map(|band| {
                let mut scratch = Vec::new();
                let mut found = Vec::new();
                let rows = band.first_row..band.first_row + band.row_count();
                for (index, sweep) in sweeps.iter().enumerate() {
                    let Some(sweep) = sweep else { continue };
                    let reach = sweep.row_range();
                    if reach.start < rows.end && rows.start < reach.end {
                        let partial = sweep.sweep_band(band, &mut scratch);
                        if !partial.is_empty() {
                            found.push((index, partial));
                        }
                    }
                }
                found
            })
            .collect();
        let mut engagements: Vec<Engagement> =
            pieces.iter().map(|piece| empty_engagement(piece, cutters)).collect();
        let cell = self.stock.grid().cell_mm;
        for (index, partial) in found.iter().flatten() {
            if let Some(engagement) = engagements.get_mut(*index) {
                partial.add_to_engagement(engagement, cell * cell, cell / 2.0);
            }
        }
        // Forces need every direction, but columns leave gaps between directions; see `bin_filling`.
        if self.detail {
            for (engagement, piece) in
                engagements.iter_mut().zip(pieces).filter(|(found, _)| found.has_removed_material())
            {
                let profile = cutters.get(piece.cutter).map(|cutter| &cutter.profile);
                let radius =
                    profile.map_or(0.0, |profile| profile.radius_at_height_mm(engagement.height_mm[1]));
                engagement.fill_empty_bins(radius, cell);
            }
        }
        engagements
    }

    /// Returns the box from which a tool that reaches so far can touch the stock.
    fn surroundings_of_stock(&self, reach_mm: f64) -> AirClip {
        let layout = self.stock.grid();
        let [x, y] = layout.column_center(layout.columns, layout.rows);
        let [x0, y0] = layout.origin_mm;
        AirClip::around(([x0, y0, layout.base_mm], [x, y, self.highest]), reach_mm + layout.cell_mm)
    }

    /// Prepares the sweep of one piece. `ends` says that the next piece does not continue it.
    fn prepare_sweep(
        &mut self,
        piece: &PathPiece,
        cutters: &[CutterModel],
        ends: bool,
    ) -> Option<PieceSweep> {
        let cutter = cutters.get(piece.cutter)?;
        let continues = self.last == Some((piece.from, piece.cutter));
        self.last = Some((piece.to, piece.cutter));
        let around = SweepContext {
            continues,
            ends,
            highest: self.highest,
            detail: self.detail,
            removal_window_mm: self.removal_window_mm,
        };
        let layout = self.stock.grid();
        let [from, to] = [piece.from.point, piece.to.point].map(|point| [point.x, point.y, point.z]);
        if self.surroundings_of_stock(cutter.reach_mm()).is_far_air(from, to) {
            return None;
        }
        // Only a vertical axis has the closed form; see `sweep`.
        if !is_vertical(&piece.from.axis) || !is_vertical(&piece.to.axis) {
            return Some(PieceSweep::Tilted(Box::new(TiltedSweep::new(piece, cutter, layout, around))));
        }
        Some(PieceSweep::Straight(Box::new(StraightSweep::new(from, to, cutter, layout, around))))
    }
}

/// Returns whether an axis is along z. The tolerance moves a point 100 mm up the axis by 0.00001 mm, which is
/// less than any machine can hold.
fn is_vertical(axis: &Vector3<f64>) -> bool {
    axis.z > 0.0 && axis.x.hypot(axis.y) <= 1e-7
}

/// Returns the engagement of a piece that meets no material.
fn empty_engagement(piece: &PathPiece, cutters: &[CutterModel]) -> Engagement {
    let size =
        cutters.get(piece.cutter).map_or([0.0; 2], |cutter| [cutter.radius_mm(), cutter.flute_length_mm()]);
    Engagement::empty_for_piece(piece, size)
}

/// Returns whether the next piece has the same cutter, starts where this one ends, and turns off by less than
/// 30 degrees (the cosine 0.866).
fn is_continued_by(piece: &PathPiece, next: &PathPiece) -> bool {
    let (this, that) = (piece.to.point - piece.from.point, next.to.point - next.from.point);
    let ahead = this.dot(&that) > 0.866 * this.norm() * that.norm();
    ahead && piece.cutter == next.cutter && piece.to.point == next.from.point
}
