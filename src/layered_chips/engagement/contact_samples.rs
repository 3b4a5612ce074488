//! This module samples a piece of a chip: its boundary closely, its interior coarsely.

use super::chip_outline::{ChipOutline, subdivide_boundary};
use super::layer_slab::LayerSlab;
use super::moving_cylinder::{CylinderContact, CylinderFace, MovingCylinder};
use crate::layered_chips::Polygon;
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

/// The distance of samples on a boundary as a fraction of the radius. It is 0.4 of a bin.
pub(super) const SPACING: f64 = 0.02;

/// Neighbouring samples on a boundary whose angles differ by more than this (radians) are not joined, because
/// the contact jumped.
pub(super) const JUMP: f64 = 0.5;

/// A contact as a bin needs it.
#[derive(Debug, Clone, Copy)]
pub(super) struct ContactSample {
    pub flank: bool,
    pub angle: f64,
    /// The lowest and highest engaged length along the meridian, mm.
    pub along: [f64; 2],
    pub advance_ratio: f64,
    pub bound: f64,
    pub thickness: f64,
}

/// Returns the samples of a piece of a chip. A film that chords left gets none.
pub(super) fn sample_polygon(
    motion: &MovingCylinder,
    slab: &LayerSlab,
    polygon: &Polygon,
) -> Vec<ContactSample> {
    let outline = ChipOutline::new(polygon);
    let mut found = Vec::new();
    for border in outline.borders() {
        let around: Vec<Option<(CylinderContact, f64)>> =
            subdivide_boundary(border, SPACING * motion.radius_mm())
                .into_iter()
                .map(|place| {
                    let contact = motion.find_first_contact(&Vector3::new(place[0], place[1], slab.z))?;
                    Some((contact, outline.measure_thickness_mm(place, &contact.normal)))
                })
                .collect();
        sample_boundary(motion, slab, &around, &mut found);
    }
    if found.is_empty() {
        return found;
    }
    let spacing = sample_interior(motion, slab, &outline, &mut found);
    // Between two samples of the interior, the engagement of the bottom may reach further inwards, by up to
    // their distance.
    let innermost = |sample: &ContactSample| if sample.flank { f64::INFINITY } else { sample.along[0] };
    let innermost = found.iter().map(innermost).fold(f64::INFINITY, f64::min) - spacing;
    found.iter_mut().filter(|sample| !sample.flank).for_each(|sample| sample.along[0] = innermost.max(0.0));
    found
}

/// Samples a boundary and adds samples between neighbours that are more than a bin apart. A sample where the
/// material is as thin as the error of chords is skipped, unless a neighbour is thicker: at a vertex of a
/// chip the thickness is zero as well.
fn sample_boundary(
    motion: &MovingCylinder,
    slab: &LayerSlab,
    around: &[Option<(CylinderContact, f64)>],
    found: &mut Vec<ContactSample>,
) {
    let count = around.len();
    let at = |index: usize| around.get(index % count.max(1)).copied().flatten();
    let thickness = |index: usize| {
        let near =
            [index + count - 1, index, index + 1].map(|index| at(index).map_or(0.0, |(_, width)| width));
        near.into_iter().fold(0.0, f64::max)
    };
    for index in 0..count {
        let Some((contact, _)) = at(index) else { continue };
        let thickness = thickness(index);
        if thickness <= motion.chord_error_mm() {
            continue;
        }
        let gap = |other: usize| {
            let other = at(other).filter(|(other, _)| other.face == contact.face)?;
            let turn = normalize_angle(other.0.angle - contact.angle);
            (turn.abs() < JUMP).then_some(turn)
        };
        let (before, after) = (gap(index + count - 1), gap(index + 1));
        let apart = before.map_or(0.0, f64::abs).max(after.map_or(0.0, f64::abs));
        let sample = sample_contact(motion, slab, &contact, apart / 2.0, thickness);
        found.push(sample);
        if let (Some(turn), Some((next, _))) = (after, at(index + 1)) {
            let parts = count_bins_between(turn);
            found.extend((1..parts).map(|part| {
                let part = part as f64 / parts as f64;
                let advance_ratio =
                    contact.advance_ratio + (next.advance_ratio - contact.advance_ratio) * part;
                ContactSample { angle: contact.angle + turn * part, advance_ratio, ..sample }
            }));
        }
    }
}

/// Adds samples of the interior; returns their distance, mm.
fn sample_interior(
    motion: &MovingCylinder,
    slab: &LayerSlab,
    outline: &ChipOutline<'_>,
    found: &mut Vec<ContactSample>,
) -> f64 {
    let (places, spacing) = outline.places_inside();
    for place in places {
        let Some(contact) = motion.find_first_contact(&Vector3::new(place[0], place[1], slab.z)) else {
            continue;
        };
        let width = outline.measure_thickness_mm(place, &contact.normal);
        if width > motion.chord_error_mm() {
            found.push(sample_contact(motion, slab, &contact, SPACING, width));
        }
    }
    spacing
}

/// Converts a contact to a sample, with a bound for what is between the samples and within the layer's
/// thickness.
fn sample_contact(
    motion: &MovingCylinder,
    slab: &LayerSlab,
    contact: &CylinderContact,
    apart: f64,
    thickness: f64,
) -> ContactSample {
    let upright = contact.upright.max(1e-3);
    // The layer's half thickness, measured along the tilted axis.
    let half = slab.thickness / 2.0 / upright;
    let lean = (1.0 - upright * upright).max(0.0).sqrt();
    let flank = contact.face == CylinderFace::Flank;
    let radius = motion.radius_mm();
    let along = match contact.face {
        CylinderFace::Flank => {
            [contact.height - half, contact.height + half].map(|height| radius + height.max(0.0))
        }
        CylinderFace::Bottom => [contact.rho; 2],
        CylinderFace::Top => [radius + contact.height; 2],
    };
    let turned = motion.turn_per_mm() * (half + radius * apart);
    let bound = if flank && contact.most > 0.0 {
        // The bound is the ratio at an angle nearer to straight ahead: by the distance to the next sample,
        // and to the side by what chords and the lean of half a layer may hide.
        let angle = (contact.advance_ratio / contact.most).clamp(-1.0, 1.0).acos();
        let aside = (motion.chord_error_mm() + half * lean) / radius;
        let side = ((angle - apart).max(0.0).sin() - aside).max(0.0);
        contact.most * (1.0 - side * side).max(0.0).sqrt()
    } else {
        contact.advance_ratio
    };
    ContactSample {
        flank,
        angle: contact.angle,
        along,
        advance_ratio: contact.advance_ratio,
        bound: bound + turned,
        thickness,
    }
}

/// Returns in how many parts the turn from one sample to the next is divided, so that none is more than a bin from its
/// neighbour.
pub(super) fn count_bins_between(turn: f64) -> usize {
    (turn.abs() / (TAU / 240.0)).ceil() as usize
}

/// Brings an angle to the range from -pi to pi.
pub(super) fn normalize_angle(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}
