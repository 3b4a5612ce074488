//! This module collects what an operation cuts at the level of a ramp.

use super::level_paths::LevelPaths;
use super::milled_area::{CoveredAreas, MilledArea};
use super::ramp_search::{FoundRamp, LEVEL, is_level, to_tool_frame_mm};
use super::tool_region::ToolRegion;
use crate::program::motion::Motion;
use nalgebra::{Point2, Rotation3};
use std::collections::HashMap;
use std::sync::Arc;

/// An operation and a tool axis, rounded to six decimals.
type LevelKey = (usize, [i64; 3]);

/// The level motions of operations, which are searched once for each operation and tool axis.
pub(super) struct LevelMotions<'m> {
    motions: &'m [Motion],
    mm_per_unit: f64,
    known: HashMap<LevelKey, Vec<(f64, usize)>>,
    /// The paths of levels at which ramps end, which several ramps mostly share, by the bits of their height.
    levels: HashMap<(LevelKey, u64), Arc<LevelPaths>>,
    /// What a tool covers at these levels, by the bits of its radius too.
    covered: HashMap<(LevelKey, u64, u64), CoveredAreas>,
}

impl<'m> LevelMotions<'m> {
    pub(super) fn new(motions: &'m [Motion], mm_per_unit: f64) -> Self {
        Self { motions, mm_per_unit, known: HashMap::new(), levels: HashMap::new(), covered: HashMap::new() }
    }

    /// Returns the convex hull of the ramp and of everything that its operation cuts at the level of its end.
    pub(super) fn level_hull(&mut self, found: &FoundRamp) -> ToolRegion {
        let level = self.level_paths(found);
        ToolRegion::from_hull(level.hull().iter().copied().chain(found.ramp.path_across()))
    }

    /// Returns the region in which a tool of a radius (mm) covers only what the operation cuts at the level
    /// of the ramp's end, or what the ramp itself covers. It is computed within `reach` (mm) of the ramp.
    pub(super) fn milled_region(&mut self, found: &FoundRamp, radius: f64, reach: f64) -> ToolRegion {
        let level = self.level_paths(found);
        let key = (level_key(found), found.ramp.end_point().z.to_bits(), radius.to_bits());
        let known = self.covered.entry(key).or_default();
        ToolRegion::Milled(MilledArea::new((&level, known), radius, &found.ramp.path_across(), reach))
    }

    /// Returns the paths of everything that is cut at the level of a ramp's end. Consecutive motions are joined.
    fn level_paths(&mut self, found: &FoundRamp) -> Arc<LevelPaths> {
        let end = found.ramp.end_point().z;
        let key = (level_key(found), end.to_bits());
        if let Some(known) = self.levels.get(&key) {
            return Arc::clone(known);
        }
        let (motions, mm, frame) = (self.motions, self.mm_per_unit, found.frame);
        let heights = self.level_heights(found);
        let start = heights.partition_point(|(z, _)| *z < end - LEVEL);
        let level = heights.iter().skip(start).take_while(|(z, _)| *z <= end + LEVEL);
        let mut level: Vec<usize> = level.map(|(_, index)| *index).collect();
        level.sort_unstable();
        let mut paths: Vec<Vec<Point2<f64>>> = Vec::new();
        let mut last = None;
        for index in level {
            let Some(motion) = motions.get(index) else { continue };
            let samples = motion.path.sample_points(motion.from.point, motion.to.point);
            let points = samples.into_iter().map(|point| (frame * (point * mm)).xy());
            match paths.last_mut().filter(|_| last.is_some_and(|last| last + 1 == index)) {
                Some(path) => path.extend(points.skip(1)),
                None => paths.push(points.collect()),
            }
            last = Some(index);
        }
        let found = Arc::new(LevelPaths::new(&paths));
        self.levels.insert(key, Arc::clone(&found));
        found
    }

    /// Returns the heights of the operation's level motions at feed in ascending order, with their indices.
    fn level_heights(&mut self, found: &FoundRamp) -> &[(f64, usize)] {
        let key = level_key(found);
        let (motions, mm, frame) = (self.motions, self.mm_per_unit, &found.frame);
        self.known.entry(key).or_insert_with(|| find_level_heights(motions, found.operation, frame, mm))
    }
}

fn level_key(found: &FoundRamp) -> LevelKey {
    let axis = (found.frame.inverse() * nalgebra::Vector3::z()).map(|part| (part * 1e6).round() as i64);
    (found.operation, axis.into())
}

fn find_level_heights(
    motions: &[Motion],
    operation: usize,
    frame: &Rotation3<f64>,
    mm_per_unit: f64,
) -> Vec<(f64, usize)> {
    let all = motions.iter().enumerate().filter(|(_, motion)| motion.operation == operation);
    let upright = |motion: &Motion| (frame * motion.from.axis).xy().amax() <= 1e-6;
    let level = all.filter(|(_, motion)| {
        !motion.rapid
            && motion.hole.is_none()
            && upright(motion)
            && motion.length() > 0.0
            && is_level(motion, mm_per_unit)
    });
    let mut found: Vec<(f64, usize)> =
        level.map(|(index, motion)| (to_tool_frame_mm(motion.to, frame, mm_per_unit).z, index)).collect();
    found.sort_by(|one, other| one.0.total_cmp(&other.0));
    found
}
