//! This module finds the largest advance of a cutter's surface into a piece of a chip.
//!
//! It is the largest advance ratio of all samples ([`contact_samples`](super::contact_samples)). Most of the time of samples
//! goes into the time of each contact, and into the thickness of the material around it, which only tells films that
//! chords left from material. So samples are asked in the falling order of what they can be at most, until no other one can
//! be larger.

use super::chip_outline::{ChipOutline, subdivide_boundary};
use super::contact_samples::{JUMP, SPACING, count_bins_between, normalize_angle};
use super::layer_slab::LayerSlab;
use super::moving_cylinder::{CylinderContact, MovingCylinder};
use crate::layered_chips::Polygon;
use nalgebra::Vector3;

/// Returns the largest advance ratio of the samples of a piece of a chip; `None` for a film that chords left.
pub(super) fn find_largest_advance(
    motion: &MovingCylinder,
    slab: &LayerSlab,
    polygon: &Polygon,
) -> Option<f64> {
    let outline = ChipOutline::new(polygon);
    let mut largest = None;
    for border in outline.borders() {
        let mut samples = BoundarySamples::new(motion, slab, &outline, border);
        largest = samples.raise_largest(largest);
    }
    // A chip whose boundaries nothing in material touches is a film.
    let mut most = largest?;
    for place in outline.places_in_box().0 {
        let at = Vector3::new(place[0], place[1], slab.z);
        let is_larger = motion.bound_first_advance(&at).is_some_and(|bound| bound > most);
        if is_larger
            && outline.contains(place)
            && let Some(contact) = motion.find_first_contact(&at)
            && contact.advance_ratio > most
            && is_material(motion, &outline, place, &contact)
        {
            most = contact.advance_ratio;
        }
    }
    Some(most)
}

/// Returns whether the chip at a contact is thicker than what chords leave.
fn is_material(
    motion: &MovingCylinder,
    outline: &ChipOutline<'_>,
    place: [f64; 2],
    contact: &CylinderContact,
) -> bool {
    outline.measure_thickness_mm(place, &contact.normal) > motion.chord_error_mm()
}

/// The samples around one boundary, whose contacts are found when they are asked for.
struct BoundarySamples<'s> {
    motion: &'s MovingCylinder,
    outline: &'s ChipOutline<'s>,
    places: Vec<Vector3<f64>>,
    /// What each contact's advance ratio is at most; `None` for a place that no advancing surface reaches.
    bounds: Vec<Option<f64>>,
    contacts: Vec<Option<Option<CylinderContact>>>,
}

impl<'s> BoundarySamples<'s> {
    fn new(
        motion: &'s MovingCylinder,
        slab: &LayerSlab,
        outline: &'s ChipOutline<'s>,
        border: &[[f64; 2]],
    ) -> Self {
        let places = subdivide_boundary(border, SPACING * motion.radius_mm());
        let places: Vec<Vector3<f64>> = places.into_iter().map(|[x, y]| Vector3::new(x, y, slab.z)).collect();
        let bounds = places.iter().map(|place| motion.bound_first_advance(place)).collect();
        Self { motion, outline, bounds, contacts: vec![None; places.len()], places }
    }

    /// Returns the largest of an advance ratio and those of the samples in material.
    fn raise_largest(&mut self, mut largest: Option<f64>) -> Option<f64> {
        let count = self.places.len();
        let bound = |index: usize| self.bounds.get(index % count).copied().flatten();
        // The bins up to the next sample take parts of both.
        let up_to_next = |index: usize| {
            let here = bound(index)?;
            Some((index, bound(index + 1).map_or(here, |next| here.max(next))))
        };
        let mut falling: Vec<(usize, f64)> = (0..count).filter_map(up_to_next).collect();
        falling.sort_by(|(_, one), (_, other)| other.total_cmp(one));
        for (index, bound) in falling {
            if largest.is_some_and(|most| bound <= most) {
                break;
            }
            if let Some(advance) = self.advance_up_to_next(index)
                && largest.is_none_or(|most| advance > most)
                && self.is_thick(index)
            {
                largest = Some(advance);
            }
        }
        largest
    }

    /// Returns the contact of a sample; indices go around.
    fn contact_at(&mut self, index: usize) -> Option<CylinderContact> {
        let index = index % self.places.len().max(1);
        let known = self.contacts.get(index).copied().flatten();
        let contact = known.unwrap_or_else(|| self.motion.find_first_contact(self.places.get(index)?));
        if let Some(kept) = self.contacts.get_mut(index) {
            *kept = Some(contact);
        }
        contact
    }

    /// Returns whether there is material at a sample or at one of its neighbours: at a vertex of a chip the thickness is
    /// zero as well.
    fn is_thick(&mut self, index: usize) -> bool {
        [index, index + 1, index + self.places.len() - 1].into_iter().any(|index| {
            let Some(contact) = self.contact_at(index) else { return false };
            let place = self.places.get(index % self.places.len());
            place.is_some_and(|place| is_material(self.motion, self.outline, [place.x, place.y], &contact))
        })
    }

    /// Returns the largest advance ratio from a sample up to the next one, where the bins between them take parts of both.
    fn advance_up_to_next(&mut self, index: usize) -> Option<f64> {
        let contact = self.contact_at(index)?;
        let Some(next) = self.contact_at(index + 1).filter(|next| next.face == contact.face) else {
            return Some(contact.advance_ratio);
        };
        let turn = normalize_angle(next.angle - contact.angle);
        let parts = count_bins_between(turn);
        if turn.abs() >= JUMP || parts < 2 {
            return Some(contact.advance_ratio);
        }
        let part = (parts - 1) as f64 / parts as f64;
        let last = contact.advance_ratio + (next.advance_ratio - contact.advance_ratio) * part;
        Some(contact.advance_ratio.max(last))
    }
}
