//! What an operation cuts at a ramp's level.

use super::find::{Found, LEVEL, is_level, placed};
use super::milled::Milled;
use super::region::Region;
use crate::program::motion::Motion;
use nalgebra::{Point2, Rotation3};
use std::collections::HashMap;

/// An operation and a tool axis, to six decimals.
type Key = (usize, [i64; 3]);

/// The level motions of operations, found once for each operation and tool axis.
pub(super) struct Levels<'m> {
    motions: &'m [Motion],
    mm: f64,
    known: HashMap<Key, Vec<(f64, usize)>>,
}

impl<'m> Levels<'m> {
    pub fn new(motions: &'m [Motion], mm: f64) -> Self {
        Self { motions, mm, known: HashMap::new() }
    }

    /// The hull of what a ramp's operation cuts at the level of its end, and of the ramp itself.
    pub fn hull(&mut self, found: &Found) -> Region {
        Region::hull(self.paths(found).into_iter().flatten())
    }

    /// Where a tool of a radius (mm) covers nothing but what the operation cuts at the level of the ramp's end, or the ramp itself; looked at
    /// within `reach` (mm) of the ramp.
    pub fn milled(&mut self, found: &Found, radius: f64, reach: f64) -> Region {
        Region::Milled(Milled::new(&self.paths(found), radius, &found.ramp.path(), reach))
    }

    /// The paths of what is cut at the level of a ramp's end, motions that go on from each other joined, and the ramp's own.
    fn paths(&mut self, found: &Found) -> Vec<Vec<Point2<f64>>> {
        let end = found.ramp.end().z;
        let (motions, mm, frame) = (self.motions, self.mm, found.frame);
        let heights = self.heights(found);
        let start = heights.partition_point(|(z, _)| *z < end - LEVEL);
        let level = heights.iter().skip(start).take_while(|(z, _)| *z <= end + LEVEL);
        let mut level: Vec<usize> = level.map(|(_, index)| *index).collect();
        level.sort_unstable();
        let mut paths: Vec<Vec<Point2<f64>>> = Vec::new();
        let mut last = None;
        for index in level {
            let Some(motion) = motions.get(index) else { continue };
            let samples = motion.path.samples(motion.from.point, motion.to.point);
            let points = samples.into_iter().map(|point| (frame * (point * mm)).xy());
            match paths.last_mut().filter(|_| last.is_some_and(|last| last + 1 == index)) {
                Some(path) => path.extend(points.skip(1)),
                None => paths.push(points.collect()),
            }
            last = Some(index);
        }
        paths.push(found.ramp.path());
        paths
    }

    /// Heights of the operation's level motions at feed, ascending, with their indices.
    fn heights(&mut self, found: &Found) -> &[(f64, usize)] {
        let axis = (found.frame.inverse() * nalgebra::Vector3::z()).map(|part| (part * 1e6).round() as i64);
        let key = (found.operation, axis.into());
        let (motions, mm, frame) = (self.motions, self.mm, &found.frame);
        self.known.entry(key).or_insert_with(|| heights(motions, found.operation, frame, mm))
    }
}

fn heights(motions: &[Motion], operation: usize, frame: &Rotation3<f64>, mm: f64) -> Vec<(f64, usize)> {
    let all = motions.iter().enumerate().filter(|(_, motion)| motion.operation == operation);
    let upright = |motion: &Motion| (frame * motion.from.axis).xy().amax() <= 1e-6;
    let level = all.filter(|(_, motion)| {
        !motion.rapid
            && motion.hole.is_none()
            && upright(motion)
            && motion.length() > 0.0
            && is_level(motion, mm)
    });
    let mut found: Vec<(f64, usize)> =
        level.map(|(index, motion)| (placed(motion.to, frame, mm).z, index)).collect();
    found.sort_by(|one, other| one.0.total_cmp(&other.0));
    found
}
