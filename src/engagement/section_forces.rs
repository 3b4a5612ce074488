//! This module computes cutting forces from what cuts at one moment: means over a revolution as integrals over the engaged
//! arcs, and extremes over the rotation of the teeth, edge by edge.
//!
//! An element of the edge at an angle psi from ahead, whose normal is k from straight down, meets the forces of the
//! [`CuttingLaw`] against its motion (t), along the normal into the tool (r) and along the meridian towards the tip (a):
//! Engin and Altintas, Int. J. Machine Tools and Manufacture 41 (2001), 2195-2212, and Lee and Altintas, 36 (1996),
//! 1059-1072. Here stands the opposite, the force on the workpiece: ahead `t sin psi + (r sin k + a cos k) cos psi`, to the
//! left `-t cos psi + (r sin k + a cos k) sin psi`, up `a sin k - r cos k`; t changes its sign for a spindle that turns
//! counter-clockwise. Edge terms act only where there is a chip.

use crate::certified_engagement::ContactSection;
use crate::cutter::{BeamForces, Meridian, Teeth, ToolBeam};
use crate::engagement::CuttingLaw;
use crate::engagement::edge_elements::lag_rad_per_mm;
use crate::engagement::section_nodes::{
    ARC_NODES, EdgeNode, list_mean_nodes, list_turning_nodes, split_arcs,
};
use crate::engagement::tool_bending::{ToolBending, weigh_nodes};
use crate::program::record::SpindleDirection;
use nalgebra::Vector3;
use std::f64::consts::TAU;
use std::sync::Arc;

/// The largest step from one rotation to the next, radians.
const TURN_RAD: f64 = 0.06;
/// How far beside a jump both of its sides are looked at, radians.
const BESIDE_RAD: f64 = 1e-6;
/// Rotations that differ by less are the same, radians.
const SAME_RAD: f64 = 2e-3;
/// The most rotations at which ends of edges meet ends of arcs. Where there are more, no single one makes a peak.
const MOST_MEETINGS: usize = 240;

/// A cutter in a material, for forces edge by edge. It is made once for each cutter.
#[derive(Debug, Clone)]
pub struct EdgeForceModel {
    teeth: Teeth,
    law: CuttingLaw,
    /// 1 for a spindle that turns clockwise, else -1.
    sense: f64,
    lag_rad_per_mm: f64,
    beam: Option<Arc<ToolBeam>>,
}

/// The forces at one place of a path, N and N m. Forces are on the workpiece.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SectionForces {
    /// The mean over a revolution ahead, to the left and along the axis away from the tip.
    pub tool_mean_n: [f64; 3],
    /// The mean over a revolution in the axes of the workpiece frame.
    pub mean_n: [f64; 3],
    /// The least values over a revolution in these axes.
    pub least_n: [f64; 3],
    /// The largest values over a revolution in these axes.
    pub largest_n: [f64; 3],
    /// The largest resultant over a revolution.
    pub resultant_peak_n: f64,
    /// The largest part across the tool axis over a revolution.
    pub bending_peak_n: f64,
    /// The mean torque over a revolution, positive against the rotation.
    pub torque_mean_nm: f64,
    /// The largest torque over a revolution.
    pub torque_peak_nm: f64,
    /// The removed volume per mm of path, mm2, as the chips of the teeth make it.
    pub swept_mm2: f64,
    /// How the tool bends; `None` if it is not known as a beam.
    pub bending: Option<ToolBending>,
}

/// Forces ahead, to the left and up, the torque in N mm, and the removed volume per mm of path.
#[derive(Debug, Clone, Copy, Default)]
struct ForceSums {
    force: [f64; 3],
    torque: f64,
    swept: f64,
    /// The forces across the axis as the beam needs them.
    beam: BeamForces,
}

impl EdgeForceModel {
    /// Makes the model of a cutter with these teeth in a material, for one direction of the spindle. The helix has a
    /// constant lead: the edge lags by `z tan(helix) / R` on corners, balls and tapers as well, where R is the largest
    /// radius.
    pub fn new(
        profile: &Meridian,
        teeth: &Teeth,
        law: impl Into<CuttingLaw>,
        spindle: SpindleDirection,
    ) -> Self {
        let lag_rad_per_mm = lag_rad_per_mm(profile, teeth.helix_rad);
        Self { teeth: teeth.clone(), law: law.into(), sense: spindle.sense(), lag_rad_per_mm, beam: None }
    }

    /// Lets the model tell how the tool bends.
    #[must_use]
    pub fn with_beam(mut self, beam: Option<Arc<ToolBeam>>) -> Self {
        self.beam = beam;
        self
    }

    /// Returns whether it tells how the tool bends.
    pub fn is_beam(&self) -> bool {
        self.beam.is_some()
    }

    /// Returns the angles by which teeth trail the first one, radians; of even teeth one stands for all.
    pub(super) fn list_passing_teeth(&self) -> Vec<f64> {
        let mut trail = self.teeth.trail_angles_rad();
        trail.truncate(if self.teeth.is_even() { 1 } else { trail.len() });
        trail
    }

    /// Returns the force on the workpiece to the left at one rotation, times what the nodes give, mm.
    pub(super) fn bend_at_rotation(
        &self,
        section: &ContactSection,
        nodes: &[EdgeNode],
        turned: f64,
        advance: f64,
    ) -> f64 {
        let trail = self.teeth.trail_angles_rad();
        self.sum_at_rotation(section, nodes, &trail, turned, advance).beam.deflection_mm[1]
    }

    /// Returns the teeth.
    pub fn teeth(&self) -> &Teeth {
        &self.teeth
    }

    /// Returns by how much an edge lags behind its tip, radians per mm of height.
    pub(super) fn lag_rad_per_mm(&self) -> f64 {
        self.lag_rad_per_mm
    }

    /// Returns 1 for a spindle that turns clockwise, else -1.
    pub(super) fn sense(&self) -> f64 {
        self.sense
    }

    /// Returns the forces of what cuts at a moment, at a feed in mm/min and a spindle speed in rev/min (above 0).
    pub fn forces_of_section(&self, section: &ContactSection, feed_mm_min: f64, rpm: f64) -> SectionForces {
        let bending = self.beam.as_ref().map(|_| ToolBending::default());
        let mut found = SectionForces { bending, ..SectionForces::default() };
        if section.is_empty() {
            return found;
        }
        let advance = feed_mm_min / rpm;
        let mean = self.sum_means(section, advance);
        found.tool_mean_n = mean.force;
        found.mean_n = to_program_axes(&section.frame, mean.force);
        found.torque_mean_nm = mean.torque * 1e-3;
        found.swept_mm2 = mean.swept;
        if let Some(bending) = &mut found.bending {
            // The force on the tool is the opposite of that on the workpiece.
            bending.deflection_mean_mm = mean.beam.deflection_mm.map(|part| -part);
        }
        self.add_extremes(section, advance, &mut found);
        found
    }

    /// Returns the forces at evenly spaced rotations of one revolution from a tooth straight ahead: for each the angle in
    /// radians, the force on the workpiece in the axes of the workpiece frame in N, and the torque in N m.
    pub fn forces_over_revolution(
        &self,
        section: &ContactSection,
        feed_mm_min: f64,
        rpm: f64,
        count: usize,
    ) -> Vec<(f64, [f64; 3], f64)> {
        let nodes = list_turning_nodes(section, self.lag_rad_per_mm, self.teeth.has_smooth_chips());
        let trail = self.teeth.trail_angles_rad();
        let at = |number: usize| {
            let turned = TAU * number as f64 / count.max(1) as f64;
            let sums = self.sum_at_rotation(section, &nodes, &trail, turned, feed_mm_min / rpm);
            (turned, to_program_axes(&section.frame, sums.force), sums.torque * 1e-3)
        };
        (0..count).map(at).collect()
    }

    /// Returns the means over a revolution: each tooth passes each engaged angle once.
    fn sum_means(&self, section: &ContactSection, advance: f64) -> ForceSums {
        let is_smooth = self.law.is_linear() && self.teeth.has_smooth_chips();
        let (teeth, times) =
            if self.teeth.is_even() { (1, self.teeth.count() as f64) } else { (self.teeth.count(), 1.0) };
        let mut sums = ForceSums::default();
        for (row, mut nodes) in list_mean_nodes(section) {
            weigh_nodes(&mut nodes, self.beam.as_deref(), 0.0);
            for [from, to] in split_arcs(row, is_smooth) {
                let (middle, half) = ((from + to) / 2.0, (to - from) / 2.0);
                for (at, weight) in ARC_NODES {
                    let (sin, cos) = (middle + half * at).sin_cos();
                    for node in &nodes {
                        for tooth in 0..teeth {
                            let share = weight * half * times / TAU;
                            self.add_edge_force(node, tooth, [sin, cos], (share, advance), &mut sums);
                        }
                    }
                }
            }
        }
        if advance > 0.0 {
            // What the teeth of a revolution take is what the cutter removes on the advance of one.
            sums.swept *= TAU / advance;
        }
        sums
    }

    /// Adds the force of a part of an edge at an angle from ahead; `part` is how much of its length counts.
    #[inline]
    fn add_edge_force(
        &self,
        node: &EdgeNode,
        tooth: usize,
        [sin, cos]: [f64; 2],
        (part, advance): (f64, f64),
        sums: &mut ForceSums,
    ) {
        let [still, ahead, left] = node.share;
        let share = still + ahead * cos + left * sin;
        if share <= 0.0 {
            return;
        }
        let chip = self.teeth.edge_chip_thickness_mm(tooth, advance * share, node.sin);
        if chip <= 0.0 {
            return;
        }
        let length = node.length_mm * part;
        let [tangential, radial, axial] = self.law.edge_forces_n_mm(chip).map(|force| force * length);
        let outwards = radial * node.sin + axial * node.cos;
        let against = tangential * self.sense;
        let across = [against * sin + outwards * cos, outwards * sin - against * cos];
        sums.force[0] += across[0];
        sums.force[1] += across[1];
        sums.beam.add_force(across, node.height_mm, node.give_mm_per_n);
        sums.force[2] += axial * node.sin - radial * node.cos;
        sums.torque += tangential * node.radius_mm;
        sums.swept += chip * node.radius_mm * length;
    }

    /// Returns the sums at one rotation.
    fn sum_at_rotation(
        &self,
        section: &ContactSection,
        nodes: &[EdgeNode],
        trail: &[f64],
        turned: f64,
        advance: f64,
    ) -> ForceSums {
        let mut sums = ForceSums::default();
        for (tooth, trail) in trail.iter().enumerate() {
            for node in nodes {
                let Some(row) = section.rows.get(node.row) else { continue };
                let middle = self.sense * (trail - turned + node.lag_rad);
                for arc in &row.arcs {
                    for (angle, part) in overlaps(*arc, middle, node.half_lag_rad) {
                        self.add_edge_force(node, tooth, angle.sin_cos().into(), (part, advance), &mut sums);
                    }
                }
            }
        }
        sums
    }

    /// Finds the least and largest values over the rotation of the teeth.
    fn add_extremes(&self, section: &ContactSection, advance: f64, found: &mut SectionForces) {
        let mut nodes = list_turning_nodes(section, self.lag_rad_per_mm, self.teeth.has_smooth_chips());
        weigh_nodes(&mut nodes, self.beam.as_deref(), 0.0);
        let highest_mm = nodes.iter().map(|node| node.height_mm).fold(0.0, f64::max);
        let trail = self.teeth.trail_angles_rad();
        let [mut least, mut largest] = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for turned in self.list_rotations(section, &nodes, &trail) {
            let sums = self.sum_at_rotation(section, &nodes, &trail, turned, advance);
            let [ahead, left, up] = sums.force;
            let across = ahead.hypot(left);
            found.bending_peak_n = found.bending_peak_n.max(across);
            found.resultant_peak_n = found.resultant_peak_n.max(across.hypot(up));
            found.torque_peak_nm = found.torque_peak_nm.max(sums.torque * 1e-3);
            if let Some((bending, beam)) = found.bending.as_mut().zip(self.beam.as_deref()) {
                let [ahead, left] = sums.beam.deflection_mm;
                bending.deflection_peak_mm = bending.deflection_peak_mm.max(ahead.hypot(left));
                let stress = beam.largest_stress_mpa(&sums.beam, highest_mm);
                bending.stress_peak_mpa = bending.stress_peak_mpa.max(stress);
            }
            let force = to_program_axes(&section.frame, sums.force);
            for ((force, least), largest) in force.iter().zip(&mut least).zip(&mut largest) {
                *least = least.min(*force);
                *largest = largest.max(*force);
            }
        }
        (found.least_n, found.largest_n) = (least, largest);
        if let Some((bending, beam)) = found.bending.as_mut().zip(self.beam.as_deref()) {
            bending.wall_error_mm = self.find_wall_errors(section, &nodes, beam, advance);
        }
    }

    /// Lists the rotations that are looked at: evenly spaced ones, and those at which the end of an edge meets the end of
    /// an arc, on both sides where a force jumps there.
    fn list_rotations(&self, section: &ContactSection, nodes: &[EdgeNode], trail: &[f64]) -> Vec<f64> {
        let period = if self.teeth.is_even() { TAU / trail.len().max(1) as f64 } else { TAU };
        let trail = if self.teeth.is_even() { trail.get(..1).unwrap_or_default() } else { trail };
        let count = (period / TURN_RAD).ceil();
        let mut rotations: Vec<f64> =
            (0..count as usize).map(|step| (step as f64 + 0.5) * period / count).collect();
        let mut meetings = Vec::new();
        for node in nodes {
            let arcs = section.rows.get(node.row).map_or(&[] as &[[f64; 2]], |row| &row.arcs);
            let is_jump = node.half_lag_rad == 0.0;
            for end in arcs.iter().flatten() {
                for lag in [node.lag_rad - node.half_lag_rad, node.lag_rad + node.half_lag_rad] {
                    let meeting = lag - self.sense * end;
                    let beside = if is_jump { BESIDE_RAD } else { 0.0 };
                    meetings.extend([meeting - beside, meeting + beside].map(|at| at.rem_euclid(TAU)));
                }
            }
        }
        meetings.sort_by(f64::total_cmp);
        let same = if nodes.iter().all(|node| node.half_lag_rad == 0.0) { BESIDE_RAD } else { SAME_RAD };
        meetings.dedup_by(|next, kept| *next - *kept < same);
        if meetings.len() * trail.len() <= MOST_MEETINGS {
            let of_teeth = trail.iter().flat_map(|trail| meetings.iter().map(move |at| at + trail));
            rotations.extend(of_teeth.map(|at| at.rem_euclid(period)));
            rotations.sort_by(f64::total_cmp);
            rotations.dedup_by(|next, kept| *next - *kept < BESIDE_RAD);
        }
        rotations
    }
}

/// Returns where a part of an edge that is spread over angles lies in an arc: the middle of the common angles, and the part
/// of the edge.
fn overlaps([from, to]: [f64; 2], middle: f64, half: f64) -> impl Iterator<Item = (f64, f64)> {
    let first = from + (middle - from).rem_euclid(TAU);
    // Seen from the arc, the edge is at `first` and at one turn less.
    [first, first - TAU].into_iter().filter_map(move |at| {
        if half <= 0.0 {
            // Where one tooth leaves as another enters, only one of them cuts.
            return (at >= from && at < to).then_some((at, 1.0));
        }
        let (low, high) = ((at - half).max(from), (at + half).min(to));
        (high > low).then(|| ((low + high) / 2.0, (high - low) / (2.0 * half)))
    })
}

/// Returns a force ahead, to the left and up in the axes of the workpiece frame.
fn to_program_axes(frame: &[Vector3<f64>; 3], force: [f64; 3]) -> [f64; 3] {
    let sum = frame.iter().zip(force).fold(Vector3::zeros(), |sum, (axis, force)| sum + axis * force);
    sum.into()
}
