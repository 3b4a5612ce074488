//! This module bounds what a row of a cutter's surface may press, wherever its edge is within one direction.

use super::cutting_coefficients::CuttingCoefficients;
use super::cutting_force::LoadModel;
use crate::certified_engagement::{CONTACT_DIRECTIONS, ContactRow, RowContact};
use std::f64::consts::{PI, TAU};

/// The width of a direction, radians.
pub(super) const WIDTH: f64 = TAU / CONTACT_DIRECTIONS as f64;
/// The directions in which forces are bounded.
pub(super) const FORCE_DIRECTIONS: usize = 24;

/// A load that is at most `per_advance` times the advance per revolution plus `still`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct AffineLoad {
    pub per_advance: f64,
    pub still: f64,
}

impl AffineLoad {
    pub(super) fn at(self, advance: f64) -> f64 {
        self.per_advance * advance + self.still
    }

    pub(super) fn add(&mut self, other: Self) {
        self.per_advance += other.per_advance;
        self.still += other.still;
    }

    pub(super) fn scaled(self, by: f64) -> Self {
        Self { per_advance: self.per_advance * by, still: self.still * by }
    }

    /// Returns the advance at which a limit is reached; 0 where it always is.
    pub(super) fn advance_at(self, limit: f64) -> f64 {
        if self.still >= limit { 0.0 } else { (limit - self.still) / self.per_advance.max(f64::MIN_POSITIVE) }
    }
}

/// A part of an edge that pushes across the axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Push {
    /// The unit vector of its force.
    pub toward: [f64; 2],
    /// The cosine and the sine of the angle by which the force may be turned from that.
    pub spread: [f64; 2],
    /// How strong it is.
    pub force: AffineLoad,
    /// The lowest height above the tip at which it may be, mm.
    pub lowest_mm: f64,
}

/// Returns what parts of edges push in a direction, each times its weight (0 or more), raised so that it holds up to the next directions.
pub(super) fn bound_pushes(pushes: &[Push], number: usize, weigh: impl Fn(&Push) -> f64) -> AffineLoad {
    let step = TAU / FORCE_DIRECTIONS as f64;
    let (sin, cos) = (number as f64 * step).sin_cos();
    let mut sum = AffineLoad::default();
    for push in pushes {
        let Push { toward, spread, force, .. } = push;
        let part = toward[0] * cos + toward[1] * sin;
        // The cosine of the least angle between the direction and a force that may be turned by the spread.
        let most = if part >= spread[0] {
            1.0
        } else {
            part * spread[0] + (1.0 - part * part).max(0.0).sqrt() * spread[1]
        };
        if most > 0.0 {
            sum.add(force.scaled(most * weigh(push)));
        }
    }
    sum.scaled(1.0 / (step / 2.0).cos())
}

/// Keeps the loads that are the largest at some advance, or nearly so.
pub(super) fn prune_dominated(loads: &mut Vec<AffineLoad>) {
    loads.sort_by(|a, b| b.per_advance.total_cmp(&a.per_advance));
    let mut most = f64::NEG_INFINITY;
    loads.retain(|load| {
        let is_kept = load.still > most;
        most = most.max(load.still);
        is_kept
    });
}

/// A row with the largest contacts in the directions that its edge may be in while the cutter turns by one.
pub(super) struct RowWindows {
    windows: Vec<RowContact>,
    /// How far its lowest or highest end lags behind the tip, whichever comes first in the turn, radians.
    first_lag: f64,
    /// By how much the edge is spread, radians: the turn and the lag of its ends.
    spread: f64,
    normal: [f64; 2],
    /// The largest angle between a normal of the row and the one of its middle.
    tilt: f64,
    /// The height of its lower end above the tip, mm.
    lowest_mm: f64,
}

impl RowWindows {
    pub(super) fn new(model: &LoadModel, row: &ContactRow) -> Self {
        let lags = row.heights_mm.map(|z| model.left * z * model.lag_rad_per_mm);
        let first_lag = lags[0].min(lags[1]);
        let spread = (lags[1] - lags[0]).abs() + WIDTH;
        let count = (spread / WIDTH).ceil() as usize + 1;
        let window = |from: usize| {
            let within = (from..from + count).filter_map(|at| row.contacts.get(at % CONTACT_DIRECTIONS));
            within.fold(RowContact::default(), |a, b| RowContact {
                share: a.share.max(b.share),
                length_mm: a.length_mm.max(b.length_mm),
                moment_mm2: a.moment_mm2.max(b.moment_mm2),
                swept_mm2: a.swept_mm2.max(b.swept_mm2),
            })
        };
        Self {
            windows: (0..CONTACT_DIRECTIONS).map(window).collect(),
            first_lag,
            spread,
            normal: row.normal_rad.sin_cos().into(),
            tilt: row.half_turn_rad,
            lowest_mm: row.heights_mm[0].min(row.heights_mm[1]),
        }
    }

    /// Returns the largest contact of an edge whose tip is at an angle and turns on by one direction, and the middle of
    /// its angles.
    pub(super) fn look_at(&self, tip: f64) -> (RowContact, f64) {
        let from = tip + self.first_lag;
        let place = ((from + PI).rem_euclid(TAU) / WIDTH) as usize;
        let contact = self.windows.get(place % CONTACT_DIRECTIONS).copied().unwrap_or_default();
        (contact, from + self.spread / 2.0)
    }

    pub(super) fn add_torque(
        &self,
        material: &CuttingCoefficients,
        contact: &RowContact,
        [part, offset]: [f64; 2],
        sum: &mut AffineLoad,
    ) {
        sum.per_advance += material.k_tc * part * contact.swept_mm2;
        sum.still += (material.k_tc * offset + material.k_te) * contact.moment_mm2;
    }

    pub(super) fn add_force(
        &self,
        (left, material): (f64, &CuttingCoefficients),
        contact: &RowContact,
        [part, offset]: [f64; 2],
        angle: f64,
        (pushes, axial): (&mut Vec<Push>, &mut [AffineLoad; 2]),
    ) {
        let length = contact.length_mm;
        let of_chip = self.edge_force(material.k_tc, material.k_rc, material.k_ac);
        let of_edge = self.edge_force(material.k_te, material.k_re, material.k_ae);
        // A runout makes a chip that does not grow with the feed.
        let chip = AffineLoad { per_advance: part * contact.share, still: offset };
        let edge = AffineLoad { per_advance: 0.0, still: 1.0 };
        for ([outwards, against, up], force) in [(of_chip, chip), (of_edge, edge)] {
            // A row is curved, so its forces turn between across and along the axis.
            let across = outwards.hypot(against) + self.tilt * up.abs();
            let along = up.abs() + self.tilt * outwards.abs();
            let toward = (left * against).atan2(outwards);
            let lean = if across > 0.0 { self.tilt * up.abs() / across } else { 0.0 };
            let force = force.scaled(length);
            let (sin, cos) = (angle + toward).sin_cos();
            let (sin_spread, cos_spread) = (self.spread / 2.0 + lean.min(1.0).asin()).sin_cos();
            pushes.push(Push {
                toward: [cos, sin],
                spread: [cos_spread, sin_spread],
                force: force.scaled(across),
                lowest_mm: self.lowest_mm,
            });
            let [ups, downs] = axial;
            if up + self.tilt * outwards.abs() > 0.0 {
                ups.add(force.scaled(along));
            }
            if up - self.tilt * outwards.abs() < 0.0 {
                downs.add(force.scaled(along));
            }
        }
    }

    /// Returns the force of one mm of edge outwards, against its way, and up, in N; the model is that of
    /// [`LoadModel`].
    fn edge_force(&self, tangential: f64, radial: f64, axial: f64) -> [f64; 3] {
        let [sin, cos] = self.normal;
        [-axial * cos - radial * sin, tangential, radial * cos - axial * sin]
    }
}
