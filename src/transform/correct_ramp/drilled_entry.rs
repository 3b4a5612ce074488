//! This module finds holes that a program drills before a ramp, over which an indexable cutter can go straight down.
//!
//! A hole that is as wide as the middle of the cutter, which does not cut, leaves nothing under it. The inserts then
//! plunge around the hole, and the tool mills its way to the ramp's end at the floor.

use super::ramp::{Ramp, RampStep};
use super::ramp_limits::IndexableCutter;
use super::ramp_search::{FoundRamp, to_tool_frame_mm};
use super::tool_region::ToolRegion;
use crate::program::motion::Motion;
use crate::setup::Setup;
use nalgebra::{Point2, Point3, Vector3};
use std::sync::Arc;

/// The point of a drill whose angle nobody tells is that of a twist drill of 118 degrees: its tip is 31 degrees.
const TIP_RAD: f64 = 31.0 * std::f64::consts::PI / 180.0;

/// Axes whose components differ by less than this are the same axis.
const SAME_AXIS: f64 = 1e-6;

/// Returns the indices of the motions that drill.
pub(super) fn find_drilling_motions(motions: &[Motion]) -> Arc<[usize]> {
    let all = motions.iter().enumerate();
    all.filter(|(_, motion)| motion.hole.is_some() && !motion.rapid).map(|(index, _)| index).collect()
}

/// Entries nearer to a point than this (mm) are at the point.
const SAME_PLACE_MM: f64 = 1e-3;

/// A hole that is ready for a ramp's cutter, in the tool's frame, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
struct ReadyHole {
    centre: Point2<f64>,
    diameter_mm: f64,
}

/// What says which holes are ready for a ramp.
#[derive(Debug, Clone)]
pub(super) struct HoleSearch<'a> {
    pub motions: &'a [Motion],
    /// The indices of the motions that drill, in their order.
    pub drilled: Arc<[usize]>,
    pub setup: &'a Setup,
    pub mm_per_unit: f64,
}

impl HoleSearch<'_> {
    /// Returns the holes that the program has drilled before a ramp and that are as wide as the middle of its cutter, and deep
    /// enough.
    fn find_ready_holes(&self, found: &FoundRamp, cutter: &IndexableCutter) -> Vec<ReadyHole> {
        let middle = cutter.diameter / 2.0 - cutter.insert_radius;
        let axis = found.frame.inverse() * Vector3::z();
        let floor = found.ramp.end_point().z;
        let mut holes = Vec::new();
        let earlier = self.drilled.iter().take_while(|index| **index < found.motions.start);
        for motion in earlier.filter_map(|index| self.motions.get(*index)) {
            let Some(tool) = motion.tool.as_deref() else { continue };
            let entry = self.setup.find_tool_entry(tool);
            let told = tool.data.as_ref().and_then(|data| data.diameter);
            let told = told.map(|diameter| diameter * self.mm_per_unit);
            let Some(diameter_mm) = entry.and_then(|entry| entry.diameter_mm).or(told) else { continue };
            let tip = entry.and_then(|entry| entry.tip_rad).unwrap_or(TIP_RAD);
            let bottom = to_tool_frame_mm(motion.to, &found.frame, self.mm_per_unit);
            // What the point of the drill leaves may be as high under the middle as the inserts clear.
            let is_deep = bottom.z + middle * tip.tan() <= floor + cutter.insert_height;
            if diameter_mm >= 2.0 * middle && is_deep && (motion.to.axis - axis).amax() <= SAME_AXIS {
                holes.push(ReadyHole { centre: bottom.xy(), diameter_mm });
            }
        }
        holes
    }

    /// Returns whether a plunge goes down with the middle of its cutter over a hole.
    pub(super) fn is_plunge_over_hole(&self, found: &FoundRamp, cutter: &IndexableCutter) -> bool {
        let middle = cutter.diameter - 2.0 * cutter.insert_radius;
        let start = found.ramp.start.xy();
        self.find_ready_holes(found, cutter)
            .iter()
            .any(|hole| (hole.centre - start).norm() <= (hole.diameter_mm - middle) / 2.0 + SAME_PLACE_MM)
    }

    /// Returns the entry over the hole that is the shortest way off the ramp: level to the hole, straight down, level to the
    /// ramp's end. Returns `None` if there is none, or all ways leave the region.
    pub(super) fn find_drilled_entry(
        &self,
        found: &FoundRamp,
        cutter: &IndexableCutter,
        region: &ToolRegion,
    ) -> Option<Ramp> {
        let (start, end) = (found.ramp.start, found.ramp.end_point());
        let detour = |hole: &ReadyHole| (hole.centre - start.xy()).norm() + (hole.centre - end.xy()).norm();
        let mut holes = self.find_ready_holes(found, cutter);
        holes.sort_by(|one, other| detour(one).total_cmp(&detour(other)));
        let entries = holes.iter().map(|hole| {
            let at = |z: f64| Point3::new(hole.centre.x, hole.centre.y, z);
            let mut points = vec![start];
            for point in [at(start.z), at(end.z)] {
                // A hole at the start needs no way to it, nor one at the end from it.
                let apart = |other: &Point3<f64>| (point - other).norm() > SAME_PLACE_MM;
                if points.last().is_some_and(apart) && apart(&end) {
                    points.push(point);
                }
            }
            points.push(end);
            Ramp { start, steps: points.into_iter().skip(1).map(RampStep::straight_to).collect() }
        });
        entries.into_iter().find(|entry| region.contains_path(&entry.path_across()))
    }
}
