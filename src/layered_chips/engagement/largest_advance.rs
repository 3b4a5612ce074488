//! This module finds the largest advance of a cutter's surface into a piece of a chip.
//!
//! It is the largest advance ratio of all samples ([`contact_samples`](super::contact_samples)). Most of the time of
//! samples goes into the thickness of the material around each one, which only tells films that chords left from
//! material. So samples are asked in falling order here, and the first one in material is the answer.

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
    let touch = |place: [f64; 2]| motion.find_first_contact(&Vector3::new(place[0], place[1], slab.z));
    let is_material = |place: [f64; 2], contact: &CylinderContact| {
        outline.measure_thickness_mm(place, &contact.normal) > motion.chord_error_mm()
    };
    let mut largest: Option<f64> = None;
    for border in outline.borders() {
        let around: Vec<([f64; 2], Option<CylinderContact>)> =
            subdivide_boundary(border, SPACING * motion.radius_mm())
                .into_iter()
                .map(|place| (place, touch(place)))
                .collect();
        let mut falling: Vec<(usize, f64)> = (0..around.len())
            .filter_map(|index| Some((index, advance_up_to_next(&around, index)?)))
            .collect();
        falling.sort_by(|(_, one), (_, other)| other.total_cmp(one));
        // At a vertex of a chip the thickness is zero as well, so neighbours count.
        let is_thick = |index: usize| {
            let near = [index + around.len() - 1, index, index + 1];
            let near = near.map(|index| around.get(index % around.len()));
            near.into_iter()
                .flatten()
                .any(|(place, contact)| contact.as_ref().is_some_and(|contact| is_material(*place, contact)))
        };
        let candidates = falling.iter().take_while(|(_, advance)| largest.is_none_or(|most| *advance > most));
        let first = candidates.into_iter().find(|(index, _)| is_thick(*index)).map(|(_, advance)| *advance);
        largest = first.or(largest);
    }
    // A chip whose boundaries nothing in material touches is a film.
    let mut most = largest?;
    for place in outline.places_inside().0 {
        if let Some(contact) = touch(place)
            && contact.advance_ratio > most
            && is_material(place, &contact)
        {
            most = contact.advance_ratio;
        }
    }
    Some(most)
}

/// Returns the largest advance ratio from a sample up to the next one, where the bins between them take parts of both.
fn advance_up_to_next(around: &[([f64; 2], Option<CylinderContact>)], index: usize) -> Option<f64> {
    let at = |index: usize| around.get(index % around.len()).and_then(|(_, contact)| *contact);
    let contact = at(index)?;
    let Some(next) = at(index + 1).filter(|next| next.face == contact.face) else {
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
