//! This module bounds loads from all that may be engaged ([`ContactGrid`]): no rotation and no moment of a block has
//! more. Every load is at most a constant plus a part that grows with the feed, so the feed at a limit is closed form.
//!
//! What may be engaged is more than what is, and forces of opposite teeth may cancel. So a force is bounded in each
//! direction by the parts of edges that push that way; the largest of 24 directions, divided by the cosine of half
//! their distance, bounds them all.
//!
//! A law that is not linear in the chip is bounded by several linear ones ([`CuttingLaw::upper_linear_laws`]): each is an
//! upper bound, so the least of them is one.

use super::cutting_coefficients::CuttingCoefficients;
use super::cutting_force::{CuttingLoads, LoadModel};
use super::edge_elements::lag_rad_per_mm;
use crate::certified_engagement::{CONTACT_DIRECTIONS, ContactGrid, ContactRow, RowContact};
use crate::cutter::Meridian;
use std::f64::consts::{PI, TAU};

/// The width of a direction, radians.
const WIDTH: f64 = TAU / CONTACT_DIRECTIONS as f64;
/// The directions in which forces are bounded.
const FORCE_DIRECTIONS: usize = 24;

/// A load that is at most `per_advance` times the advance per revolution plus `still`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct AffineLoad {
    per_advance: f64,
    still: f64,
}

impl AffineLoad {
    fn at(self, advance: f64) -> f64 {
        self.per_advance * advance + self.still
    }

    fn add(&mut self, other: Self) {
        self.per_advance += other.per_advance;
        self.still += other.still;
    }

    fn scaled(self, by: f64) -> Self {
        Self { per_advance: self.per_advance * by, still: self.still * by }
    }

    /// Returns the advance at which a limit is reached; 0 where it always is.
    fn advance_at(self, limit: f64) -> f64 {
        if self.still >= limit { 0.0 } else { (limit - self.still) / self.per_advance.max(f64::MIN_POSITIVE) }
    }
}

/// Bounds of the loads of a block, for any feed.
#[derive(Debug, Clone, Default)]
pub struct LoadBound {
    /// Bounds by linear laws; none if nothing is engaged.
    by_law: Vec<LinearLoadBound>,
}

/// Bounds of the loads by one linear law.
#[derive(Debug, Clone, Default)]
struct LinearLoadBound {
    /// Torque in N mm at rotations.
    torques: Vec<AffineLoad>,
    /// Force in N across and along the axis, at rotations and in directions.
    forces: Vec<[AffineLoad; 2]>,
    /// Mean torque over a revolution in N mm, at parts of the time.
    means: Vec<AffineLoad>,
}

/// Returns the largest volume in mm3 that may be removed per mm of path.
pub fn bound_swept_area_mm2(grids: &[ContactGrid]) -> f64 {
    let of_grid = |grid: &ContactGrid| {
        let contacts = grid.rows.iter().flat_map(|row| &row.contacts);
        contacts.map(|contact| contact.swept_mm2).sum::<f64>() * WIDTH
    };
    grids.iter().map(of_grid).fold(0.0, f64::max)
}

/// Returns by how much an edge lags behind the tip per mm of height, radians.
pub(crate) fn edge_lag_rad_per_mm(profile: &Meridian, helix_rad: f64) -> f64 {
    lag_rad_per_mm(profile, helix_rad)
}

impl LoadBound {
    /// Bounds the loads of a cutter whose contacts are in these grids.
    pub fn from_contacts(model: &LoadModel, grids: &[ContactGrid]) -> Self {
        let laws = model.law.upper_linear_laws();
        Self { by_law: laws.iter().map(|law| LinearLoadBound::from_contacts(model, law, grids)).collect() }
    }

    /// Returns the loads at a feed in mm/min and a spindle speed in rev/min.
    pub fn loads_at(&self, feed_mm_min: f64, rpm: f64) -> CuttingLoads {
        let none = CuttingLoads { force_n: 0.0, torque_nm: 0.0, power_kw: 0.0 };
        let of_laws = self.by_law.iter().map(|bound| bound.loads_at(feed_mm_min, rpm));
        let least = of_laws.reduce(|a, b| CuttingLoads {
            force_n: a.force_n.min(b.force_n),
            torque_nm: a.torque_nm.min(b.torque_nm),
            power_kw: a.power_kw.min(b.power_kw),
        });
        least.unwrap_or(none)
    }

    /// Returns the largest feed in mm/min at which no load is above its limit; infinite where none can be.
    pub fn feed_within_mm_min(&self, rpm: f64, limits: CuttingLoads) -> f64 {
        let free = CuttingLoads { force_n: f64::INFINITY, torque_nm: f64::INFINITY, power_kw: f64::INFINITY };
        let alone = [
            CuttingLoads { force_n: limits.force_n, ..free },
            CuttingLoads { torque_nm: limits.torque_nm, ..free },
            CuttingLoads { power_kw: limits.power_kw, ..free },
        ];
        // One law that keeps a limit is enough; all limits have to be kept.
        let of_limit = |limit: CuttingLoads| {
            let feeds = self.by_law.iter().map(|bound| bound.feed_within_mm_min(rpm, limit));
            feeds.reduce(f64::max).unwrap_or(f64::INFINITY)
        };
        alone.map(of_limit).into_iter().fold(f64::INFINITY, f64::min)
    }
}

impl LinearLoadBound {
    fn from_contacts(model: &LoadModel, law: &CuttingCoefficients, grids: &[ContactGrid]) -> Self {
        let mut bound = Self::default();
        for grid in grids {
            bound.means.push(bound_mean_torque((model, law), grid));
            bound.add_rotations((model, law), grid);
        }
        bound
    }

    fn loads_at(&self, feed_mm_min: f64, rpm: f64) -> CuttingLoads {
        let advance = feed_mm_min / rpm;
        let largest = |loads: &[AffineLoad]| loads.iter().map(|load| load.at(advance)).fold(0.0, f64::max);
        let force = self.forces.iter().map(|[across, along]| across.at(advance).hypot(along.at(advance)));
        CuttingLoads {
            force_n: force.fold(0.0, f64::max),
            torque_nm: largest(&self.torques) * 1e-3,
            power_kw: largest(&self.means) * TAU * rpm / 60.0 * 1e-6,
        }
    }

    fn feed_within_mm_min(&self, rpm: f64, limits: CuttingLoads) -> f64 {
        let least = |loads: &[AffineLoad], limit: f64| {
            loads.iter().map(|load| load.advance_at(limit)).fold(f64::INFINITY, f64::min)
        };
        let mut advance = f64::INFINITY;
        if limits.torque_nm.is_finite() {
            advance = advance.min(least(&self.torques, limits.torque_nm * 1e3));
        }
        if limits.power_kw.is_finite() {
            advance = advance.min(least(&self.means, limits.power_kw * 1e6 * 60.0 / (TAU * rpm)));
        }
        if limits.force_n.is_finite() {
            let of_force = |force: &[AffineLoad; 2]| advance_at_resultant(force, limits.force_n);
            advance = self.forces.iter().map(of_force).fold(advance, f64::min);
        }
        advance * rpm
    }

    /// Adds the torque and the force at all rotations.
    fn add_rotations(&mut self, (model, law): (&LoadModel, &CuttingCoefficients), grid: &ContactGrid) {
        let rows: Vec<RowWindows> = grid.rows.iter().map(|row| RowWindows::new(model, row)).collect();
        let trail = model.teeth.trail_angles_rad();
        let chips: Vec<[f64; 2]> = (0..trail.len()).map(|edge| model.teeth.chip_bound_parts(edge)).collect();
        let round = if model.teeth.is_even() { TAU / trail.len() as f64 } else { TAU };
        let mut pushes: Vec<Push> = Vec::new();
        for number in 0..(round / WIDTH).ceil() as usize {
            let mut torque = AffineLoad::default();
            let mut axial = [AffineLoad::default(); 2];
            pushes.clear();
            for (trail, chip) in trail.iter().zip(&chips) {
                let tip = number as f64 * WIDTH + model.left * trail;
                for row in &rows {
                    let (contact, angle) = row.look_at(tip);
                    if contact.length_mm <= 0.0 {
                        continue;
                    }
                    row.add_torque(law, &contact, *chip, &mut torque);
                    row.add_force((model.left, law), &contact, *chip, angle, (&mut pushes, &mut axial));
                }
            }
            if pushes.is_empty() {
                continue;
            }
            self.torques.push(torque);
            let [up, down] = axial;
            let along = AffineLoad {
                per_advance: up.per_advance.max(down.per_advance),
                still: up.still.max(down.still),
            };
            self.forces.extend((0..FORCE_DIRECTIONS).map(|toward| [bound_pushes(&pushes, toward), along]));
        }
        prune_dominated(&mut self.torques);
    }
}

/// A part of an edge that pushes across the axis.
#[derive(Debug, Clone, Copy)]
struct Push {
    /// The unit vector of its force.
    toward: [f64; 2],
    /// The cosine and the sine of the angle by which the force may be turned from that.
    spread: [f64; 2],
    /// How strong it is.
    force: AffineLoad,
}

/// Returns what parts of edges push in a direction, raised so that it holds up to the next directions.
fn bound_pushes(pushes: &[Push], number: usize) -> AffineLoad {
    let step = TAU / FORCE_DIRECTIONS as f64;
    let (sin, cos) = (number as f64 * step).sin_cos();
    let mut sum = AffineLoad::default();
    for Push { toward, spread, force } in pushes {
        let part = toward[0] * cos + toward[1] * sin;
        // The cosine of the least angle between the direction and a force that may be turned by the spread.
        let most = if part >= spread[0] {
            1.0
        } else {
            part * spread[0] + (1.0 - part * part).max(0.0).sqrt() * spread[1]
        };
        if most > 0.0 {
            sum.add(force.scaled(most));
        }
    }
    sum.scaled(1.0 / (step / 2.0).cos())
}

/// Returns the advance at which a resultant of two parts reaches a limit.
fn advance_at_resultant([across, along]: &[AffineLoad; 2], limit: f64) -> f64 {
    let [a, b] = [across, along].map(|load| load.per_advance);
    let (c, d) = (across.still, along.still);
    let rest = c * c + d * d - limit * limit;
    if rest >= 0.0 {
        return 0.0;
    }
    let (square, half) = (a * a + b * b, a * c + b * d);
    // The larger root, in the form that does not subtract like numbers.
    let root = (half * half - square * rest).max(0.0).sqrt();
    let divisor = half + root;
    if divisor > 0.0 { -rest / divisor } else { f64::INFINITY }
}

/// Keeps the loads that are the largest at some advance, or nearly so.
fn prune_dominated(loads: &mut Vec<AffineLoad>) {
    loads.sort_by(|a, b| b.per_advance.total_cmp(&a.per_advance));
    let mut most = f64::NEG_INFINITY;
    loads.retain(|load| {
        let is_kept = load.still > most;
        most = most.max(load.still);
        is_kept
    });
}

/// Bounds the mean torque over a revolution: every tooth passes every direction once.
fn bound_mean_torque(
    (model, material): (&LoadModel, &CuttingCoefficients),
    grid: &ContactGrid,
) -> AffineLoad {
    let mut sum = AffineLoad::default();
    let chips = (0..model.teeth.count()).map(|edge| model.teeth.chip_bound_parts(edge));
    let [advances, offsets] = chips.fold([0.0; 2], |[a, o], [part, offset]| [a + part, o + offset]);
    let teeth = model.teeth.count() as f64;
    for contact in grid.rows.iter().flat_map(|row| &row.contacts) {
        sum.per_advance += material.k_tc * advances * contact.swept_mm2;
        sum.still += (material.k_tc * offsets + material.k_te * teeth) * contact.moment_mm2;
    }
    sum.scaled(1.0 / CONTACT_DIRECTIONS as f64)
}

/// A row with the largest contacts in the directions that its edge may be in while the cutter turns by one.
struct RowWindows {
    windows: Vec<RowContact>,
    /// How far its lowest or highest end lags behind the tip, whichever comes first in the turn, radians.
    first_lag: f64,
    /// By how much the edge is spread, radians: the turn and the lag of its ends.
    spread: f64,
    normal: [f64; 2],
    /// The largest angle between a normal of the row and the one of its middle.
    tilt: f64,
}

impl RowWindows {
    fn new(model: &LoadModel, row: &ContactRow) -> Self {
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
        }
    }

    /// Returns the largest contact of an edge whose tip is at an angle and turns on by one direction, and the middle of
    /// its angles.
    fn look_at(&self, tip: f64) -> (RowContact, f64) {
        let from = tip + self.first_lag;
        let place = ((from + PI).rem_euclid(TAU) / WIDTH) as usize;
        let contact = self.windows.get(place % CONTACT_DIRECTIONS).copied().unwrap_or_default();
        (contact, from + self.spread / 2.0)
    }

    fn add_torque(
        &self,
        material: &CuttingCoefficients,
        contact: &RowContact,
        [part, offset]: [f64; 2],
        sum: &mut AffineLoad,
    ) {
        sum.per_advance += material.k_tc * part * contact.swept_mm2;
        sum.still += (material.k_tc * offset + material.k_te) * contact.moment_mm2;
    }

    fn add_force(
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
