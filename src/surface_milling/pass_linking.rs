//! This module links passes to one path. From pass to pass the tool goes over the surface if that is near and
//! safe, otherwise up, across and down again.

use super::pass_track::{PassTrack, ProgramRounding};
use crate::program::MotionClass;
use crate::write::new_program::{DraftMove, DraftMoveKind};
use nalgebra::Point3;

/// The pattern in which passes follow each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PassPattern {
    /// Every other plane is milled in the opposite direction.
    #[default]
    ZigZag,
    /// Every pass has the same direction, with a retract after each.
    OneWay,
}

/// The options for the path between passes, all in the program's unit.
#[derive(Debug, Clone, Copy)]
pub(super) struct PassLinking {
    pub pattern: PassPattern,
    /// The height of the tip at which nothing is in the way.
    pub clear: f64,
    /// The height above a pass from which the tool goes down at the plunge feed.
    pub approach: f64,
    pub feed: f64,
    pub plunge: f64,
    /// The feed between passes above the part; rapid if not given.
    pub air: Option<f64>,
}

/// Returns the motions through all tracks, which are sorted plane by plane in the order and direction in
/// which they are cut.
///
/// `link` returns the points from the end of one track to the start of the next over which the tool may go at
/// feed. `top` returns the highest z of the part beside a point; a rapid must end above it.
pub(super) fn link_tracks(
    planes: &[Vec<PassTrack>],
    between: &PassLinking,
    print: ProgramRounding,
    link: impl Fn(Point3<f64>, Point3<f64>) -> Option<Vec<Point3<f64>>>,
    top: impl Fn(Point3<f64>) -> f64,
) -> Vec<DraftMove> {
    let mut path = LinkedPath { moves: Vec::new(), between: *between, print };
    let mut at: Option<Point3<f64>> = None;
    for tracks in planes {
        for (index, track) in tracks.iter().enumerate() {
            // Between two parts of one plane there is something that must not be cut.
            let near = index == 0 && between.pattern == PassPattern::ZigZag;
            match at.and_then(|at| link(at, track.start).filter(|_| near)) {
                Some(points) => path.step_over(points),
                None => path.retract_and_plunge(at, track.start, top(track.start)),
            }
            path.follow_track(track);
            at = Some(track.end_point());
        }
    }
    if let Some(at) = at {
        path.retract_from(at);
    }
    path.moves
}

/// The path that grows from pass to pass.
struct LinkedPath {
    moves: Vec<DraftMove>,
    between: PassLinking,
    print: ProgramRounding,
}

impl LinkedPath {
    /// Moves through the air, by rapid or at the air feed.
    fn move_through_air(&mut self, to: Point3<f64>, class: MotionClass) {
        // A motion to the current point would move nothing.
        if self.moves.last().is_some_and(|last| last.to == to) {
            return;
        }
        let way = match self.between.air {
            // Nobody knows where the tool starts, so no feed would be right for the first motion.
            Some(feed) if !self.moves.is_empty() => DraftMoveKind::Line { feed },
            _ => DraftMoveKind::Rapid,
        };
        self.moves.push(DraftMove { to, way, class });
    }

    /// Moves straight up to the clearance height.
    fn retract_from(&mut self, at: Point3<f64>) {
        self.move_through_air(Point3::new(at.x, at.y, self.between.clear), MotionClass::Retract);
    }

    /// Moves up from a point, across, and down to another one. The last part at the plunge feed begins above
    /// everything beside it, because stock may stand on a wall.
    fn retract_and_plunge(&mut self, at: Option<Point3<f64>>, start: Point3<f64>, top: f64) {
        let first = at.is_none();
        if let Some(at) = at {
            self.retract_from(at);
        }
        let class = if first { MotionClass::Approach } else { MotionClass::Rapid };
        self.move_through_air(Point3::new(start.x, start.y, self.between.clear), class);
        let above = crate::write::new_program::round_coordinate(
            start.z.max(top) + self.between.approach,
            self.print.dialect,
        );
        if above < self.between.clear {
            self.move_through_air(Point3::new(start.x, start.y, above), MotionClass::Rapid);
        }
        let way = DraftMoveKind::Line { feed: self.between.plunge };
        self.moves.push(DraftMove { to: start, way, class: MotionClass::Engage });
    }

    /// Moves over the surface to the next pass.
    fn step_over(&mut self, points: Vec<Point3<f64>>) {
        let way = DraftMoveKind::Line { feed: self.between.feed };
        for to in points {
            if self.moves.last().is_none_or(|last| last.to != to) {
                self.moves.push(DraftMove { to, way, class: MotionClass::StepOver });
            }
        }
    }

    /// Cuts along a track.
    fn follow_track(&mut self, track: &PassTrack) {
        let feed = self.between.feed;
        self.moves.extend(track.steps.iter().map(|step| {
            let way = match step.arc {
                Some((centre, axis)) => DraftMoveKind::Arc { centre, axis, feed },
                None => DraftMoveKind::Line { feed },
            };
            DraftMove { to: step.to, way, class: MotionClass::Cut }
        }));
    }
}
