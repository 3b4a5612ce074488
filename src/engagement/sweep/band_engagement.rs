//! This module collects the contribution of one band of columns to the engagement of one piece.

use crate::engagement::engagement_bins::{BINS, EngagementBin, bin_index_at, interval_hull};
use crate::engagement::{Engagement, PillarContact, RemovalProfile};

/// A contact of the cutter with removed material.
#[derive(Debug, Clone, Copy)]
pub(in crate::engagement) struct BinContact {
    /// The angle around the axis from the feed's direction, radians, positive to the left.
    pub angle: f32,
    /// The length along the meridian from the tip, mm.
    pub length: f32,
    /// The advance ratio `v.n / |v|`: the best estimate, and an upper bound with all that the grid may hide.
    pub advance_ratio: f32,
    pub advance_ratio_bound: f32,
    /// The radial part of the normal.
    pub radial: f32,
    /// The thickness of the removed material along the normal, mm.
    pub thickness: f32,
}

/// The sums and extremes over the columns of a band.
#[derive(Debug, Clone)]
pub(in crate::engagement) struct BandEngagement {
    /// The sum of the removed heights, mm.
    pub removed: f64,
    /// Where on the piece heights were removed, mm.
    pub removal: RemovalProfile,
    pub lateral: [f32; 2],
    pub height: [f32; 2],
    pub graze: f32,
    pub contact: Option<(usize, f64)>,
    /// What the middle of an indexable cutter runs into. Its volume is a sum of heights until the area of a column is known.
    pub pillar: Option<PillarContact>,
    bins: Option<Box<[EngagementBin; BINS]>>,
    known: [RememberedContact; KNOWN],
    next_known: usize,
}

/// The number of contacts that are kept for comparison.
const KNOWN: usize = 4;

/// Contacts whose lateral positions differ by at most this (mm) are merged.
const ASIDE: f64 = 0.06;

/// The position of a column's contacts across the path: the least and the greatest height measured square to
/// the path, and the lateral distance from the path, mm.
#[derive(Debug, Clone, Copy)]
pub(in crate::engagement) struct CrossPathPosition {
    pub least: f64,
    pub greatest: f64,
    pub side: f64,
}

/// A contact that was examined and is kept for comparison.
#[derive(Debug, Clone, Copy)]
struct RememberedContact {
    place: CrossPathPosition,
    /// The ratio of the thickness along the normal to the depth along the column.
    steepness: f64,
    bin: usize,
}

impl RememberedContact {
    const NONE: Self = Self {
        place: CrossPathPosition { least: f64::INFINITY, greatest: f64::NEG_INFINITY, side: f64::INFINITY },
        steepness: 0.0,
        bin: 0,
    };
}

impl BandEngagement {
    /// Makes the contribution of a band in which nothing was found. `removal` is the piece's empty profile.
    pub(crate) fn new(removal: RemovalProfile) -> Self {
        Self {
            removed: 0.0,
            removal,
            lateral: [f32::INFINITY, f32::NEG_INFINITY],
            height: [f32::INFINITY, f32::NEG_INFINITY],
            graze: 0.0,
            contact: None,
            pillar: None,
            bins: None,
            known: [RememberedContact::NONE; KNOWN],
            next_known: 0,
        }
    }

    /// Returns whether a known contact dominates a column's contacts, that is, has at least their advance
    /// ratio. The thickness of the column's material then counts in the bin of that known contact.
    #[inline]
    pub(crate) fn is_dominated(&mut self, place: &CrossPathPosition, climbs: bool, depth: f64) -> bool {
        let dominates = |known: &&RememberedContact| {
            known.place.greatest >= place.greatest
                && known.place.side <= place.side
                && (climbs || known.place.least <= place.least)
        };
        let Some(known) = self.known.iter().find(dominates) else { return false };
        let bin = self.bins.as_mut().and_then(|bins| bins.get_mut(known.bin));
        if let Some(bin) = bin {
            bin.thickness = bin.thickness.max((depth * known.steepness) as f32);
        }
        true
    }

    /// Keeps a contact for comparison. It is merged with one whose heights it continues; otherwise it
    /// replaces one that it dominates, or the oldest.
    pub(crate) fn remember_contact(
        &mut self,
        place: CrossPathPosition,
        climbs: bool,
        steepness: f64,
        angle: f32,
    ) {
        let touches = |known: &&mut RememberedContact| {
            climbs || (known.place.least <= place.greatest && known.place.greatest >= place.least)
        };
        let near = |known: &&mut RememberedContact| (known.place.side - place.side).abs() <= ASIDE;
        if let Some(known) = self.known.iter_mut().filter(near).find(touches) {
            known.place.least = known.place.least.min(place.least);
            known.place.greatest = known.place.greatest.max(place.greatest);
            known.place.side = known.place.side.max(place.side);
            known.steepness = known.steepness.max(steepness);
            return;
        }
        let worse = |known: &RememberedContact| {
            place.greatest >= known.place.greatest
                && place.side <= known.place.side
                && (climbs || place.least <= known.place.least)
        };
        let index = self.known.iter().position(worse).unwrap_or(self.next_known);
        if let Some(known) = self.known.get_mut(index) {
            *known = RememberedContact { place, steepness, bin: bin_index_at(f64::from(angle)) };
        }
        self.next_known = (index + 1) % KNOWN;
    }

    /// Adds to the volume and the lateral extent only.
    #[inline]
    pub(crate) fn add_volume(&mut self, removed: f32, left: f32) {
        self.removed += f64::from(removed);
        self.lateral = interval_hull(self.lateral, [left, left]);
    }

    /// Returns whether nothing was found.
    pub(crate) fn is_empty(&self) -> bool {
        self.removed <= 0.0 && self.graze <= 0.0 && self.contact.is_none() && self.pillar.is_none()
    }

    /// Adds a column's removed height, lateral position and range of heights on the cutter.
    pub(crate) fn add_column(&mut self, removed: f32, left: f32, height: [f32; 2]) {
        self.add_volume(removed, left);
        self.height = interval_hull(self.height, height);
    }

    /// Adds a contact to its bin.
    pub(crate) fn add_contact(&mut self, contact: &BinContact) {
        let bins = self.bins.get_or_insert_with(|| Box::new([EngagementBin::EMPTY; BINS]));
        let Some(bin) = bins.get_mut(bin_index_at(f64::from(contact.angle))) else { return };
        bin.merge_bin(&EngagementBin {
            low: contact.length,
            high: contact.length,
            advance_ratio: contact.advance_ratio,
            advance_ratio_bound: contact.advance_ratio_bound,
            radial: contact.radial,
            thickness: contact.thickness,
        });
    }

    /// Records that a shank or holder is `depth` mm deep in material; the deepest one is kept.
    pub(crate) fn record_collision(&mut self, collar: usize, depth: f64) {
        if self.contact.is_none_or(|(_, known)| depth > known) {
            self.contact = Some((collar, depth));
        }
    }

    /// Adds everything to an engagement. `area` is the area of a column in mm2, and `half` is half a cell in
    /// mm.
    pub(crate) fn add_to_engagement(&self, engagement: &mut Engagement, area: f64, half: f64) {
        engagement.removed_mm3 += self.removed * area;
        engagement.removal.merge_columns(&self.removal, area);
        if self.removed > 0.0 {
            let [least, greatest] = self.lateral.map(f64::from);
            engagement.lateral_mm = interval_hull(engagement.lateral_mm, [least - half, greatest + half]);
            engagement.height_mm = interval_hull(engagement.height_mm, self.height.map(f64::from));
        }
        engagement.graze = engagement.graze.max(f64::from(self.graze));
        if let Some((_, depth)) = self.contact
            && engagement.contact.is_none_or(|(_, known)| depth > known)
        {
            engagement.contact = self.contact;
        }
        let pillar =
            self.pillar.map(|pillar| PillarContact { volume_mm3: pillar.volume_mm3 * area, ..pillar });
        engagement.pillar = PillarContact::merge_places(engagement.pillar, pillar);
        let Some(mine) = &self.bins else { return };
        if engagement.bins.is_empty() {
            engagement.bins = mine.to_vec();
            return;
        }
        for (bin, mine) in engagement.bins.iter_mut().zip(mine.iter()) {
            bin.merge_bin(mine);
        }
    }
}
