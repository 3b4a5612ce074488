//! This module sweeps pieces on which the tool axis is not along z: fixed and tilted (3+2), or turning.
//!
//! The piece is divided into legs on which the axis turns little ([`leg`]). Over a column, the sweep of a leg
//! goes from the lowest point of the cutter's lower surface to the highest point of its upper one. Each of
//! the two is the minimum of a convex function of time ([`leg_extremum`]). The intervals of all legs are then
//! merged.
//!
//! **Error bound.** While the axis does not turn, the only error is that of the search. Its tolerance along z
//! is a quarter of `e = min(0.02 cell, 0.002 mm)`. A turning axis adds concave parts to the surface over a
//! column. For a rigid motion `f'' |n_z| = u.H u - n.(2 w x u + w x (w x r))`, where u is the velocity of the
//! column's point relative to the cutter, w the turn, H the surface's curvature (not negative, since the
//! cutter is convex) and r the vector from the tip. So a leg of length l, angle a and reach r hides at most
//! `a l + 1.5 r a^2` along the normal. On a ball-end mill only the travel along the axis counts as l. There
//! are so many legs that this is below e/2. So the material that is wrongly left is thinner than e along the
//! normal, and apart from the rounding of heights nothing is removed that the cutter did not reach.
//!
//! **Advance ratios** refer to the tip's speed, as feeds do, so they exceed 1 where a turn moves the surface
//! faster than the tip. If the tip stands still, they refer to the fastest point of the flutes
//! ([`PathPiece::reference_length_mm`]).

mod column_glance;
mod column_line;
mod leg;
mod leg_extremum;
mod leg_footprint;
mod near_passes;
mod revolved_solid;
mod tilted_contact;

use super::band_engagement::BandEngagement;
use super::straight::SweepContext;
use crate::cutter::CutterModel;
use crate::engagement::RemovalProfile;
use crate::engagement::path_piece::{PathPiece, STILL};
use crate::stock::dexel::{DexelBand, DexelGrid};
use crate::stock::merge_span;
use column_glance::ColumnGlance;
use leg::{GridPose, SolidSpanEnd, SweepLeg, TurningMotion};
use leg_extremum::{KnownStart, LegExtremumQuery, PassingTime, find_leg_extremum};
use leg_footprint::LegFootprint;
use nalgebra::Vector3;
use near_passes::{FlankSilhouette, NonCuttingSolid, lowest_height_on_leg};
use revolved_solid::RevolvedSolid;
use std::ops::Range;
use tilted_contact::TiltedContactFinder;

/// The most legs of a piece.
const MOST: f64 = 4096.0;

/// A leg with the values that every column needs.
#[derive(Debug, Clone)]
struct PreparedLeg {
    passing: Option<PassingTime>,
    ground: LegFootprint,
    lowest: f64,
}

/// A piece with a tilted axis that is prepared for any band of columns.
#[derive(Debug, Clone)]
pub(in crate::engagement) struct TiltedSweep {
    legs: Vec<(SweepLeg, RevolvedSolid)>,
    parts: Vec<PreparedLeg>,
    glance: ColumnGlance,
    touches: TiltedContactFinder,
    beside: FlankSilhouette,
    guards: Vec<NonCuttingSolid>,
    tolerance: f64,
    /// The empty profile of where the piece removes material.
    removal: RemovalProfile,
    rows: Range<usize>,
    layout: DexelGrid,
}

impl TiltedSweep {
    /// Prepares a piece between two poses.
    pub(crate) fn new(
        piece: &PathPiece,
        cutter: &CutterModel,
        layout: &DexelGrid,
        around: SweepContext,
    ) -> Self {
        let base = Vector3::new(0.0, 0.0, layout.base_mm);
        let [from, to] = [piece.from, piece.to].map(|place| GridPose {
            tip: place.point.coords - base,
            axis: place.axis.try_normalize(1e-12).unwrap_or_else(Vector3::z),
        });
        let turn = TurningMotion::new(from, to);
        let travel = to.tip - from.tip;
        let highest = around.highest - layout.base_mm;
        let tolerance = (0.02 * layout.cell_mm).min(0.002);
        let solid = RevolvedSolid::from_meridian(
            &cutter.profile,
            reachable_height_mm(&from, &to, cutter.radius_mm(), highest),
        );
        // A sphere looks the same after a turn, so on a ball only the travel along the axis adds to what is
        // hidden.
        let way = if solid.is_ball() {
            travel.dot(&from.axis).abs().max(travel.dot(&to.axis).abs())
        } else {
            travel.norm()
        };
        let far = solid.top_mm().hypot(solid.radius_mm());
        // The hidden thickness falls with the square of the number of legs.
        let hidden = turn.angle * way + 1.5 * far * turn.angle * turn.angle;
        let count = (hidden / (0.5 * tolerance)).sqrt().ceil().clamp(1.0, MOST);
        let legs = turn.split_legs(count as usize);
        let parts: Vec<PreparedLeg> = legs
            .iter()
            .map(|leg| PreparedLeg {
                passing: PassingTime::new(leg, &solid),
                ground: LegFootprint::new(leg, solid.radius_mm(), [0.0, solid.top_mm()]),
                lowest: lowest_height_on_leg(leg, &solid),
            })
            .collect();
        let low = |solid: &RevolvedSolid| {
            legs.iter().map(|leg| lowest_height_on_leg(leg, solid)).fold(f64::INFINITY, f64::min)
        };
        let guards: Vec<NonCuttingSolid> = cutter
            .collars
            .iter()
            .enumerate()
            .map(|(index, collar)| NonCuttingSolid { index, solid: RevolvedSolid::from_non_cutting(collar) })
            .filter(|guard| low(&guard.solid) < highest)
            .collect();
        let cuts = parts.iter().any(|part| part.lowest < highest);
        let mut rows = Range { start: usize::MAX, end: 0 };
        let mut widen = |ground: &LegFootprint, margin: usize| {
            let more = ground.row_range(layout);
            rows.start = rows.start.min(more.start.saturating_sub(margin));
            rows.end = rows.end.max((more.end + margin).min(layout.rows));
        };
        if cuts {
            // Slivers beside the flank may be one row further out.
            parts.iter().for_each(|part| widen(&part.ground, 2));
        }
        guards.iter().for_each(|guard| legs.iter().for_each(|leg| widen(&guard.leg_footprint(leg), 0)));
        let length = travel.norm();
        let direction = (length > STILL).then(|| travel / length);
        let along = direction.map_or(0.0, |direction| direction.dot(&from.axis));
        let [flank, start] = cutter.profile.flank_start();
        Self {
            touches: TiltedContactFinder {
                profile: cutter.profile.clone(),
                pace: (piece.reference_length_mm([cutter.radius_mm(), cutter.flute_length_mm()]) / count)
                    .max(1e-12),
                direction,
                cell: layout.cell_mm,
                detail: around.detail,
                continues: around.continues,
            },
            beside: FlankSilhouette {
                radius: flank.max(1e-9),
                slope: cutter.profile.taper_rad().tan(),
                heights: [start, if cuts { solid.top_mm() } else { start }],
                across: (1.0 - along * along).max(0.0).sqrt(),
                direction,
            },
            legs: legs.into_iter().map(|leg| (leg, solid.clone())).collect(),
            parts,
            glance: ColumnGlance::new(&turn),
            guards,
            tolerance,
            removal: RemovalProfile::empty_for_piece(length, around.removal_window_mm),
            rows: if rows.start < rows.end { rows } else { 0..0 },
            layout: *layout,
        }
    }

    /// Returns the rows that the piece can change.
    pub(crate) fn row_range(&self) -> Range<usize> {
        self.rows.clone()
    }

    /// Removes what the piece sweeps from a band.
    pub(crate) fn sweep_band(&self, band: &mut DexelBand) -> BandEngagement {
        let mut partial = BandEngagement::new(self.removal.clone());
        let (first, end) =
            (self.rows.start.max(band.first_row), self.rows.end.min(band.first_row + band.row_count()));
        let mut ranges: Vec<Range<usize>> = Vec::with_capacity(self.parts.len());
        let mut spans = Vec::new();
        for row in first..end {
            for guard in &self.guards {
                for (leg, _) in &self.legs {
                    let depth = guard.collision_depth_mm(leg, band, &self.layout, row, self.tolerance);
                    if depth > self.layout.cell_mm.min(0.05) {
                        partial.record_collision(guard.index, depth);
                    }
                }
            }
            ranges.clear();
            ranges.extend(self.parts.iter().map(|part| part.ground.column_range(row, &self.layout)));
            let from = ranges.iter().map(|range| range.start).min().unwrap_or(0);
            let to =
                ranges.iter().filter(|range| !range.is_empty()).map(|range| range.end).max().unwrap_or(0);
            for column in from..to {
                self.cut_column(band, [column, row], &ranges, &mut spans, &mut partial);
            }
        }
        for (leg, _) in &self.legs {
            let share = self.beside.hidden_sliver_ratio(leg, band, &self.layout, f64::from(partial.graze));
            partial.graze = partial.graze.max(share as f32);
        }
        partial
    }

    /// Cuts one column.
    fn cut_column(
        &self,
        band: &mut DexelBand,
        [column, row]: [usize; 2],
        ranges: &[Range<usize>],
        spans: &mut Vec<[f64; 2]>,
        partial: &mut BandEngagement,
    ) {
        let index = (row - band.first_row) * band.columns + column;
        let Some((top, low)) = band.top.get(index).zip(band.low.get(index)) else { return };
        if *top == f32::NEG_INFINITY {
            return;
        }
        let top = f64::from(*top);
        let floor = if band.has_lower_spans(index) {
            band.column_spans(index).last().map_or(0.0, |[low, _]| f64::from(low))
        } else {
            f64::from(*low)
        };
        let place = self.layout.column_center(column, row);
        if let Some((_, solid)) = self.legs.first()
            && self.glance.surely_misses(solid, Vector3::new(place[0], place[1], top), self.tolerance / 4.0)
        {
            return;
        }
        spans.clear();
        let mut start: KnownStart = None;
        for (((leg, solid), part), range) in self.legs.iter().zip(&self.parts).zip(ranges) {
            if part.lowest >= top || !range.contains(&column) {
                start = None;
                continue;
            }
            if let Some(span) = self.leg_span(leg, solid, part, (place, [floor, top]), &mut start) {
                merge_span(spans, span);
            }
        }
        for [from, to] in spans.iter() {
            band.cut_column(index, *from as f32, *to as f32, |low, top| {
                let taken = [f64::from(low), f64::from(top)];
                if taken[1] - taken[0] < self.tolerance / 4.0 {
                    // A film that rounding left is not a contact.
                    partial.removed += taken[1] - taken[0];
                } else {
                    self.touches.add_column_contacts(place, taken, &self.legs, partial);
                }
            });
        }
    }

    /// Returns the interval that a leg removes from a column whose material is between two heights.
    fn leg_span(
        &self,
        leg: &SweepLeg,
        solid: &RevolvedSolid,
        part: &PreparedLeg,
        (place, [floor, top]): ([f64; 2], [f64; 2]),
        start: &mut KnownStart,
    ) -> Option<[f64; 2]> {
        let tolerance = self.tolerance / 4.0;
        let passing = part.passing.as_ref();
        let lower = LegExtremumQuery {
            side: SolidSpanEnd::Lower,
            enough: floor,
            useless: top - tolerance,
            tolerance,
        };
        let found = find_leg_extremum(leg, solid, passing, place, lower, start)?;
        // The usual cut is open upwards, so the search for the upper surface can be skipped.
        if found.other >= top {
            return Some([found.value, f64::INFINITY]);
        }
        let upper = LegExtremumQuery {
            side: SolidSpanEnd::Upper,
            enough: -top,
            useless: -floor - tolerance,
            tolerance,
        };
        let other = find_leg_extremum(leg, solid, passing, place, upper, &mut None)?;
        Some([found.value.min(other.other), -other.value])
    }
}

/// Returns the height above the tip up to which the cutter can meet material that ends at the height
/// `highest`.
fn reachable_height_mm(from: &GridPose, to: &GridPose, radius: f64, highest: f64) -> f64 {
    let rise = from.axis.z.min(to.axis.z);
    // Between two axes that point upwards, every axis points upwards at least as steeply as one of them.
    if rise < 0.05 {
        return f64::INFINITY;
    }
    ((highest - from.tip.z.min(to.tip.z) + radius) / rise).max(0.0)
}
