//! What a piece of the path engages: where on the cutter material was removed, and how the surface advances there.
//!
//! It does not depend on feed, spindle or teeth; chip thickness, removal rate and forces are computed from it for any of
//! them.

use super::PathPiece;
use super::sweep::reference_length_mm;
use std::f64::consts::{PI, TAU};

/// Angular bins around the cutter; 3 degrees each.
pub const BINS: usize = 120;

/// What one angular bin of the cutter engaged.
///
/// Contacts lie on the cutter's meridian; `low..=high` is the hull of the engaged lengths along it, measured from the tip
/// ([`super::Meridian::point_at_arc_length`]).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EngagementBin {
    /// Lowest engaged length along the meridian, mm.
    pub low: f32,
    /// Highest engaged length along the meridian, mm.
    pub high: f32,
    /// Largest `v.n / |v|` of the contacts: the share of the feed with which the surface advances along its normal.
    pub share: f32,
    /// As `share`, with everything that the grid may have missed: never below the true share.
    pub share_bound: f32,
    /// Radial part of the normal (1 on the flank, 0 on the bottom) where `share` is.
    pub radial: f32,
    /// Largest thickness of the removed material along the normal, mm; a chip is never thicker.
    pub thickness: f32,
}

impl EngagementBin {
    /// A bin without contact.
    pub const EMPTY: Self = Self {
        low: f32::INFINITY,
        high: f32::NEG_INFINITY,
        share: 0.0,
        share_bound: 0.0,
        radial: 1.0,
        thickness: 0.0,
    };

    /// Adds what another piece, or another part of the ground, engaged in the same direction.
    pub fn merge_bin(&mut self, other: &Self) {
        self.low = self.low.min(other.low);
        self.high = self.high.max(other.high);
        self.thickness = self.thickness.max(other.thickness);
        self.share_bound = self.share_bound.max(other.share_bound);
        if other.share > self.share {
            self.share = other.share;
            self.radial = other.radial;
        }
    }

    /// Whether anything was engaged.
    pub fn is_engaged(&self) -> bool {
        self.low <= self.high
    }
}

/// What a piece of the path engaged.
///
/// Angles are about the tool axis from the feed's direction in the plane across the axis (0 is ahead, positive to the left
/// seen from the holder down on the work, so counter-clockwise); bin `i` covers `-180 + 3 i ..= -180 + 3 (i + 1)` degrees. A motion
/// straight along the axis has no such direction; its angles count from the frame's x axis, or y where the axis is along x.
#[derive(Debug, Clone, PartialEq)]
pub struct Engagement {
    /// Volume removed in mm3.
    pub removed_mm3: f64,
    /// Part of the direction of travel across the tool axis, 0..=1.
    pub across: f64,
    /// Part of the direction of travel along the tool axis, -1 (plunge) ..= 1.
    pub along: f64,
    /// Length of the tip's path in mm; where the tip stands still and the axis turns, of the path of the flutes' outermost
    /// point, and shares are then of that point's speed and angles from where the axis tips to.
    pub length_mm: f64,
    /// Length of the shortest piece that this was put together from, mm. A tooth that goes further in a revolution meets
    /// material that earlier pieces have thinned, so that [`EngagementBin::thickness`] tells nothing.
    pub shortest_mm: f64,
    /// Lateral extent of the removed ground, mm to the left (positive) of the path: least and greatest.
    pub lateral: [f64; 2],
    /// Height on the cutter at which material was removed, mm above the tip along the axis: least and greatest.
    pub height: [f64; 2],
    /// The bins; empty when nothing was removed. Of a simulation without detail they hold the contacts with the largest shares, for
    /// chip thickness; forces need a simulation with detail, which fills every direction.
    pub bins: Vec<EngagementBin>,
    /// Largest share that a sliver thinner than a cell, which the grid cannot see, may have had beside the removed ground: where
    /// the flank passes by material closer than a cell. 0 where it does not.
    pub graze: f64,
    /// Largest depth to which a collar (index into the cutter's list) stood in material; `None` when free.
    pub contact: Option<(usize, f64)>,
}

impl Engagement {
    /// Nothing engaged.
    pub fn empty_along(across: f64, along: f64, length_mm: f64) -> Self {
        Self {
            removed_mm3: 0.0,
            across,
            along,
            length_mm,
            shortest_mm: length_mm,
            lateral: [f64::INFINITY, f64::NEG_INFINITY],
            height: [f64::INFINITY, f64::NEG_INFINITY],
            bins: Vec::new(),
            graze: 0.0,
            contact: None,
        }
    }

    /// Nothing engaged on a piece of path, by a cutter of a radius and a length of flutes (mm).
    pub fn empty_for_piece(piece: &PathPiece, size: [f64; 2]) -> Self {
        let travel = piece.to.point - piece.from.point;
        let length = travel.norm();
        let along = if length > 0.0 { travel.dot(&piece.from.axis) / length } else { 0.0 };
        Self::empty_along((1.0 - along * along).max(0.0).sqrt(), along, reference_length_mm(piece, size))
    }

    /// Adds what is engaged at an angle, radians from the feed's direction, left positive.
    pub fn add_contact(&mut self, angle: f64, contact: &EngagementBin) {
        if self.bins.is_empty() {
            self.bins = vec![EngagementBin::EMPTY; BINS];
        }
        if let Some(bin) = self.bins.get_mut(bin_index_at(angle)) {
            bin.merge_bin(contact);
        }
    }

    /// Adds what a following piece of the same motion engaged.
    pub fn append_piece(&mut self, other: &Self) {
        let whole = self.length_mm + other.length_mm;
        if whole > 0.0 {
            let share = other.length_mm / whole;
            self.across += (other.across - self.across) * share;
            self.along += (other.along - self.along) * share;
        }
        self.length_mm = whole;
        self.shortest_mm = self.shortest_mm.min(other.shortest_mm);
        self.removed_mm3 += other.removed_mm3;
        self.lateral = interval_hull(self.lateral, other.lateral);
        self.height = interval_hull(self.height, other.height);
        self.graze = self.graze.max(other.graze);
        if let Some((_, depth)) = other.contact
            && self.contact.is_none_or(|(_, known)| depth > known)
        {
            self.contact = other.contact;
        }
        if self.bins.is_empty() {
            self.bins.clone_from(&other.bins);
        } else {
            for (bin, other) in self.bins.iter_mut().zip(&other.bins) {
                bin.merge_bin(other);
            }
        }
    }

    /// The bins that are engaged.
    pub fn engaged_bins(&self) -> impl Iterator<Item = &EngagementBin> {
        self.bins.iter().filter(|bin| bin.is_engaged())
    }

    /// Whether material was removed.
    pub fn has_removed_material(&self) -> bool {
        self.removed_mm3 > 0.0
    }

    /// Largest share `v.n / |v|` over all contacts, v in the denominator being the tip's velocity: above 1 where a turning axis
    /// moves the surface faster than the tip.
    pub fn max_advance_ratio(&self) -> f64 {
        self.bins.iter().map(|bin| f64::from(bin.share)).fold(0.0, f64::max)
    }
}

/// The bin of an angle in radians.
pub(super) fn bin_index_at(angle: f64) -> usize {
    let turn = (angle + PI) / TAU * BINS as f64;
    (turn.max(0.0) as usize).min(BINS - 1)
}

/// The smallest interval that holds both.
pub(super) fn interval_hull<T: PartialOrd + Copy>([a, b]: [T; 2], [c, d]: [T; 2]) -> [T; 2] {
    [if c < a { c } else { a }, if d > b { d } else { b }]
}
