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
use super::cutting_force::{BendingLoads, CuttingLoads, LoadModel};
use super::edge_elements::lag_rad_per_mm;
use super::row_windows::{
    AffineLoad, FORCE_DIRECTIONS, Push, RowWindows, WIDTH, bound_pushes, prune_dominated,
};
use crate::certified_engagement::{CONTACT_DIRECTIONS, ContactGrid};
use crate::cutter::Meridian;
use std::f64::consts::TAU;

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
    /// Deflection of the tip in mm, at rotations and in directions; none for a tool that is no beam.
    deflections: Vec<AffineLoad>,
    /// Bending stress in MPa, at rotations, in directions and at steps of the shank.
    stresses: Vec<AffineLoad>,
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

impl LoadBound {
    /// Returns how far the tool bends at most at a feed in mm/min and a spindle speed in rev/min, and its largest stress; all
    /// 0 for a tool that is no beam.
    pub fn bending_at(&self, feed_mm_min: f64, rpm: f64) -> BendingLoads {
        let advance = feed_mm_min / rpm;
        let largest = |loads: &[AffineLoad]| loads.iter().map(|load| load.at(advance)).fold(0.0, f64::max);
        let of_laws = self.by_law.iter().map(|bound| BendingLoads {
            deflection_mm: largest(&bound.deflections),
            stress_mpa: largest(&bound.stresses),
        });
        let least = of_laws.reduce(|a, b| BendingLoads {
            deflection_mm: a.deflection_mm.min(b.deflection_mm),
            stress_mpa: a.stress_mpa.min(b.stress_mpa),
        });
        least.unwrap_or_default()
    }

    /// Returns the largest feed in mm/min at which neither deflection nor stress is above its limit.
    pub fn feed_within_bending_mm_min(&self, rpm: f64, limits: BendingLoads) -> f64 {
        let within = |loads: &[AffineLoad], limit: f64| {
            let advances = loads.iter().map(|load| load.advance_at(limit));
            advances.fold(f64::INFINITY, f64::min) * rpm
        };
        // One law that keeps a limit is enough; both limits have to be kept.
        let of_laws = |which: fn(&LinearLoadBound) -> &[AffineLoad], limit: f64| {
            let feeds = self.by_law.iter().map(|bound| within(which(bound), limit));
            if limit.is_finite() { feeds.reduce(f64::max).unwrap_or(f64::INFINITY) } else { f64::INFINITY }
        };
        of_laws(|bound| &bound.deflections, limits.deflection_mm)
            .min(of_laws(|bound| &bound.stresses, limits.stress_mpa))
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
            self.forces
                .extend((0..FORCE_DIRECTIONS).map(|toward| [bound_pushes(&pushes, toward, |_| 1.0), along]));
            self.add_bending(model, &pushes);
        }
        prune_dominated(&mut self.torques);
        prune_dominated(&mut self.deflections);
        prune_dominated(&mut self.stresses);
    }
}

impl LinearLoadBound {
    /// Adds deflection and stress at a rotation: each part of an edge counts as if it were at its lower end, where it bends the
    /// tool most and has the longest lever.
    fn add_bending(&mut self, model: &LoadModel, pushes: &[Push]) {
        let Some(beam) = &model.beam else { return };
        for toward in 0..FORCE_DIRECTIONS {
            let gives = |push: &Push| beam.deflection_mm_per_n(0.0, push.lowest_mm.max(0.0));
            self.deflections.push(bound_pushes(pushes, toward, gives));
            for [height, modulus] in beam.stress_places() {
                let lever = |push: &Push| (height - push.lowest_mm).max(0.0) / modulus;
                self.stresses.push(bound_pushes(pushes, toward, lever));
            }
        }
    }
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
