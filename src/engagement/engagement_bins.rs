//! This module holds the engagement of a piece of the path: where on the cutter material was removed, and how
//! the surface advances there.
//!
//! An engagement does not depend on feed, spindle or teeth. For each direction around the cutter it holds the
//! advance ratio, which is the speed of the surface along its normal divided by the feed, and the thickness
//! of the material. Chips, forces and the feeds that keep them within limits follow in closed form, so a
//! program is simulated once and not once for every feed.
//!
//! The uncertainty of the grid is on the safe side. The boundary of material is known to half a cell; the
//! estimate `advance_ratio` allows for that half cell, and the bound `advance_ratio_bound` allows for a whole one. A sliver
//! beside the flank that no column hits may be there wherever material is within a cell of the flank; `graze`
//! holds its advance ratio. Feeds are made from the bounds, and reports show the estimates and the
//! differences.

use crate::engagement::{PathPiece, PillarContact, RemovalProfile};
use std::f64::consts::{PI, TAU};

/// The number of angular bins around the cutter; each is 3 degrees wide.
pub const BINS: usize = 120;

/// The engagement of one angular bin of the cutter.
///
/// Contacts are on the cutter's meridian. `low..=high` covers all engaged lengths along it, measured from the
/// tip ([`crate::cutter::Meridian::point_at_arc_length`]).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EngagementBin {
    /// The lowest engaged length along the meridian, mm.
    pub low: f32,
    /// The highest engaged length along the meridian, mm.
    pub high: f32,
    /// The largest advance ratio `v.n / |v|` of the contacts: the surface's speed along its normal, divided
    /// by the feed.
    pub advance_ratio: f32,
    /// An upper bound of the true advance ratio, with everything that the grid may have missed.
    pub advance_ratio_bound: f32,
    /// The radial part of the normal (1 on the flank, 0 on the bottom) at the contact of `advance_ratio`.
    pub radial: f32,
    /// The largest thickness of the removed material along the normal, mm. A chip is never thicker.
    pub thickness: f32,
}

impl EngagementBin {
    /// A bin without contact.
    pub const EMPTY: Self = Self {
        low: f32::INFINITY,
        high: f32::NEG_INFINITY,
        advance_ratio: 0.0,
        advance_ratio_bound: 0.0,
        radial: 1.0,
        thickness: 0.0,
    };

    /// Merges the engagement of another piece, or of another column, in the same direction.
    pub(crate) fn merge_bin(&mut self, other: &Self) {
        self.low = self.low.min(other.low);
        self.high = self.high.max(other.high);
        self.thickness = self.thickness.max(other.thickness);
        self.advance_ratio_bound = self.advance_ratio_bound.max(other.advance_ratio_bound);
        if other.advance_ratio > self.advance_ratio {
            self.advance_ratio = other.advance_ratio;
            self.radial = other.radial;
        }
    }

    /// Returns whether anything was engaged.
    pub fn is_engaged(&self) -> bool {
        self.low <= self.high
    }
}

/// The engagement of a piece of the path.
///
/// Angles are around the tool axis, from the feed's direction in the plane across the axis: 0 is straight
/// ahead, and angles are positive to the left as seen from the holder down to the work, that is
/// counter-clockwise. Bin `i` covers `-180 + 3 i ..= -180 + 3 (i + 1)` degrees. A motion straight along the
/// axis has no such direction; its angles count from the frame's x axis, or from y if the tool axis is along
/// x.
#[derive(Debug, Clone, PartialEq)]
pub struct Engagement {
    /// The removed volume, mm3.
    pub removed_mm3: f64,
    /// The component of the unit direction of travel across the tool axis, from 0 to 1.
    pub across: f64,
    /// The component of the unit direction of travel along the tool axis, from -1 (plunge) to 1.
    pub along: f64,
    /// The length of the tip's path, mm. If the tip stands still and the axis turns, it is the length of the
    /// path of the flutes' outermost point; advance ratios then refer to that point's speed, and angles to
    /// the direction into which the axis tilts.
    pub length_mm: f64,
    /// The length of the shortest piece that was added to this engagement, mm. A tooth that advances further
    /// in a revolution meets material that earlier pieces have thinned, so [`EngagementBin::thickness`] is
    /// not valid for it.
    pub shortest_mm: f64,
    /// Where on its way a single piece removes the volume, if the simulation was asked for it
    /// ([`crate::engagement::Simulation::with_removal_window_mm`]). Joined pieces do not tell.
    pub removal: RemovalProfile,
    /// The lateral extent of the removed material in mm, positive to the left of the path: the least and the
    /// greatest value.
    pub lateral_mm: [f64; 2],
    /// The heights on the cutter at which material was removed, mm above the tip along the axis: the least
    /// and the greatest.
    pub height_mm: [f64; 2],
    /// The bins; empty if nothing was removed. A simulation without detail only keeps the contacts with the
    /// largest advance ratios, which is enough for chip thickness; forces need a simulation with detail,
    /// which fills every direction.
    pub bins: Vec<EngagementBin>,
    /// The largest advance ratio that a sliver may have that is thinner than a cell, so that the grid cannot
    /// see it. It is not 0 where the flank passes material at less than a cell.
    pub graze: f64,
    /// The deepest collision of a shank or holder: its index in the cutter's list, and its depth in mm.
    /// `None` if there is none.
    pub contact: Option<(usize, f64)>,
    /// The highest material that the middle of an indexable cutter runs into. `None` if there is none.
    pub pillar: Option<PillarContact>,
}

impl Engagement {
    /// Makes an engagement in which nothing is engaged.
    pub fn empty_along(across: f64, along: f64, length_mm: f64) -> Self {
        Self {
            removed_mm3: 0.0,
            removal: RemovalProfile::default(),
            across,
            along,
            length_mm,
            shortest_mm: length_mm,
            lateral_mm: [f64::INFINITY, f64::NEG_INFINITY],
            height_mm: [f64::INFINITY, f64::NEG_INFINITY],
            bins: Vec::new(),
            graze: 0.0,
            contact: None,
            pillar: None,
        }
    }

    /// Makes an engagement in which nothing is engaged, for a piece of path and a cutter with a radius and a
    /// flute length (mm).
    pub(crate) fn empty_for_piece(piece: &PathPiece, size: [f64; 2]) -> Self {
        let travel = piece.to.point - piece.from.point;
        let length = travel.norm();
        let along = if length > 0.0 { travel.dot(&piece.from.axis) / length } else { 0.0 };
        Self::empty_along((1.0 - along * along).max(0.0).sqrt(), along, piece.reference_length_mm(size))
    }

    /// Adds a contact at an angle in radians from the feed's direction, positive to the left.
    pub(crate) fn add_contact(&mut self, angle_rad: f64, contact: &EngagementBin) {
        if self.bins.is_empty() {
            self.bins = vec![EngagementBin::EMPTY; BINS];
        }
        if let Some(bin) = self.bins.get_mut(bin_index_at(angle_rad)) {
            bin.merge_bin(contact);
        }
    }

    /// Adds the engagement of a following piece of the same motion.
    pub(crate) fn append_piece(&mut self, other: &Self) {
        // The directions of travel are averaged, weighted by length.
        let whole = self.length_mm + other.length_mm;
        if whole > 0.0 {
            let share = other.length_mm / whole;
            self.across += (other.across - self.across) * share;
            self.along += (other.along - self.along) * share;
        }
        self.length_mm = whole;
        self.shortest_mm = self.shortest_mm.min(other.shortest_mm);
        self.removed_mm3 += other.removed_mm3;
        self.removal = RemovalProfile::default();
        self.lateral_mm = interval_hull(self.lateral_mm, other.lateral_mm);
        self.height_mm = interval_hull(self.height_mm, other.height_mm);
        self.graze = self.graze.max(other.graze);
        if let Some((_, depth)) = other.contact
            && self.contact.is_none_or(|(_, known)| depth > known)
        {
            self.contact = other.contact;
        }
        self.pillar = PillarContact::merge_pieces(self.pillar, other.pillar);
        if self.bins.is_empty() {
            self.bins.clone_from(&other.bins);
        } else {
            for (bin, other) in self.bins.iter_mut().zip(&other.bins) {
                bin.merge_bin(other);
            }
        }
    }

    /// Refers the engagement of a piece to the speed of the motion as it is programmed. `pace` is the speed of the tip on
    /// the piece by that one.
    #[must_use]
    pub fn at_pace(mut self, pace: f64) -> Self {
        if pace == 1.0 || pace <= 0.0 {
            return self;
        }
        self.length_mm /= pace;
        self.shortest_mm /= pace;
        self.graze *= pace;
        for bin in &mut self.bins {
            bin.advance_ratio *= pace as f32;
            bin.advance_ratio_bound *= pace as f32;
        }
        self
    }

    /// Returns the bins that are engaged.
    pub fn engaged_bins(&self) -> impl Iterator<Item = &EngagementBin> {
        self.bins.iter().filter(|bin| bin.is_engaged())
    }

    /// Returns whether material was removed.
    pub fn has_removed_material(&self) -> bool {
        self.removed_mm3 > 0.0
    }

    /// Returns the largest advance ratio `v.n / |v|` over all contacts, where the v in the denominator is the
    /// tip's velocity. It is above 1 where a turning axis moves the surface faster than the tip.
    pub fn max_advance_ratio(&self) -> f64 {
        self.bins.iter().map(|bin| f64::from(bin.advance_ratio)).fold(0.0, f64::max)
    }
}

/// Returns the bin of an angle in radians.
pub(super) fn bin_index_at(angle: f64) -> usize {
    let turn = (angle + PI) / TAU * BINS as f64;
    (turn.max(0.0) as usize).min(BINS - 1)
}

/// Returns the smallest interval that contains both.
pub(super) fn interval_hull<T: PartialOrd + Copy>([a, b]: [T; 2], [c, d]: [T; 2]) -> [T; 2] {
    [if c < a { c } else { a }, if d > b { d } else { b }]
}
