//! This module converts a chip to the engagement that feeds are made from.
//!
//! Every point of a chip was reached by the cutter's surface at one time and in one direction around the
//! axis. At each time the engaged directions form arcs whose ends are on the chip's boundary. So the boundary
//! is sampled, and the interior in addition. For each sample the time at which the moving cylinder reaches it
//! is solved for, and at that time the advance ratio of the surface is exact.
//!
//! **Bounds.** [`EngagementBin::advance_ratio_bound`] includes what is between samples, what chords may hide (twice
//! the tolerance), and what is between the middle of a layer and its upper and lower side if the axis is
//! tilted or turns. It does not include material that reaches the middle of no layer, so is lower than a
//! layer, or stock whose own walls lean within a layer. Material that is thinner than twice the tolerance was
//! left by chords of an earlier pass and is not a contact.

mod chip_outline;
mod contact_samples;
mod largest_advance;
mod layer_slab;
mod moving_cylinder;

use super::chip::{Chip, LayerChip};
use super::mill_step::FlatMill;
use crate::engagement::{Engagement, EngagementBin, PathPiece};
use contact_samples::ContactSample;
use largest_advance::find_largest_advance;
use layer_slab::LayerSlab;
use moving_cylinder::MovingCylinder;

/// Returns the engagement of a piece of path with its chip, which was cut with this mill and with chords
/// within `tolerance_mm`.
///
/// Lengths along the meridian are radii on the bottom, and the radius plus the height above the tip on the
/// flank. Shanks and holders are not examined.
pub fn measure_engagement(chip: &Chip, mill: &FlatMill, piece: &PathPiece, tolerance_mm: f64) -> Engagement {
    let mut found = Engagement::empty_for_piece(piece, [mill.radius_mm, mill.flute_length_mm]);
    if chip.layers.is_empty() {
        return found;
    }
    let motion = MovingCylinder::new(mill, piece, found.length_mm, 2.0 * tolerance_mm + 1e-5);
    for layer in &chip.layers {
        let slab = LayerSlab { z: layer.z_mm, thickness: layer.thickness_mm };
        if layer.inside_mm2 > 0.0 {
            // How this material was reached is not known, so it gets the largest advance ratio there can be.
            found.removed_mm3 += layer.inside_mm2 * layer.thickness_mm;
            let span = motion.meridian_range_at_start(&slab);
            add_bin(
                &mut found,
                &motion,
                0.0,
                span,
                EngagementBin { advance_ratio: 1.0, advance_ratio_bound: 1.0, ..EngagementBin::EMPTY },
            );
        }
        for polygon in &layer.pieces {
            let samples = contact_samples::sample_polygon(&motion, &slab, polygon);
            if samples.is_empty() {
                continue;
            }
            found.removed_mm3 += polygon.area_mm2() * layer.thickness_mm;
            samples.iter().for_each(|sample| add_sample(&mut found, &motion, sample));
        }
    }
    found
}

/// Returns the largest advance ratio of the cutter's surface into the chip on one layer, anywhere on the
/// piece. Returns `None` if no sample of the chip is reached by an advancing surface, as in a film that
/// chords left.
///
/// The thickest chip of a tooth is this ratio times the feed per tooth. Samples are a fiftieth of the radius
/// apart, and between them the ratio may be larger by the square of that.
pub fn largest_feed_fraction(
    layer: &LayerChip,
    mill: &FlatMill,
    piece: &PathPiece,
    tolerance_mm: f64,
) -> Option<f64> {
    let length = Engagement::empty_for_piece(piece, [mill.radius_mm, mill.flute_length_mm]).length_mm;
    let motion = MovingCylinder::new(mill, piece, length, 2.0 * tolerance_mm + 1e-5);
    let slab = LayerSlab { z: layer.z_mm, thickness: layer.thickness_mm };
    let pieces = layer.pieces.iter();
    pieces.filter_map(|polygon| find_largest_advance(&motion, &slab, polygon)).reduce(f64::max)
}

/// Adds a sample to the engagement.
fn add_sample(found: &mut Engagement, motion: &MovingCylinder, sample: &ContactSample) {
    let bin = EngagementBin {
        advance_ratio: sample.advance_ratio as f32,
        advance_ratio_bound: sample.bound.max(sample.advance_ratio) as f32,
        radial: if sample.flank { 1.0 } else { 0.0 },
        thickness: sample.thickness as f32,
        ..EngagementBin::EMPTY
    };
    add_bin(found, motion, sample.angle, sample.along, bin);
}

/// Adds a bin that is engaged between two lengths along the meridian.
fn add_bin(
    found: &mut Engagement,
    motion: &MovingCylinder,
    angle: f64,
    [low, high]: [f64; 2],
    bin: EngagementBin,
) {
    let radius = motion.radius_mm();
    found.add_contact(angle, &EngagementBin { low: low as f32, high: high as f32, ..bin });
    let left = angle.sin() * high.min(radius);
    found.lateral_mm = [found.lateral_mm[0].min(left), found.lateral_mm[1].max(left)];
    let heights = [low, high].map(|along| (along - radius).max(0.0));
    found.height_mm = [found.height_mm[0].min(heights[0]), found.height_mm[1].max(heights[1])];
}
