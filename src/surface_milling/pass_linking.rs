//! Passes joined to one path: from pass to pass over the surface where that is near and safe, else up, across and down again.

use super::pass_track::{PassTrack, ProgramRounding};
use crate::program::MotionClass;
use crate::write::new_program::{DraftMove, DraftMoveKind};
use nalgebra::Point3;

/// How passes follow each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PassPattern {
    /// Forth and back: every other plane the other way.
    #[default]
    ZigZag,
    /// Every pass the same way, with a retract after each.
    OneWay,
}

/// How the tool goes between passes. All in the program's unit.
#[derive(Debug, Clone, Copy)]
pub(super) struct PassLinking {
    pub pattern: PassPattern,
    /// Height of the tip at which nothing is in the way.
    pub clear: f64,
    /// From here above a pass it goes down at the plunge feed.
    pub approach: f64,
    pub feed: f64,
    pub plunge: f64,
    /// Feed between passes above the part; rapid when there is none.
    pub air: Option<f64>,
}

/// The motions through all tracks, which stand plane by plane in the order and direction in which they are cut.
///
/// `link` gives points from the end of one track to the start of the next over which the tool may go at feed; `top` the highest z of
/// the part beside a place, above which a rapid has to end.
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
            // Parts of one plane have something between them that is not to be cut.
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

struct LinkedPath {
    moves: Vec<DraftMove>,
    between: PassLinking,
    print: ProgramRounding,
}

impl LinkedPath {
    fn move_through_air(&mut self, to: Point3<f64>, class: MotionClass) {
        // Where it already is, nothing moves.
        if self.moves.last().is_some_and(|last| last.to == to) {
            return;
        }
        let way = match self.between.air {
            // Where the tool comes from at first, nobody knows; no feed would be right.
            Some(feed) if !self.moves.is_empty() => DraftMoveKind::Line { feed },
            _ => DraftMoveKind::Rapid,
        };
        self.moves.push(DraftMove { to, way, class });
    }

    fn retract_from(&mut self, at: Point3<f64>) {
        self.move_through_air(Point3::new(at.x, at.y, self.between.clear), MotionClass::Retract);
    }

    /// Up from a place, across, and down to another, the last bit at the plunge feed: from above everything beside it, since stock may stand
    /// on a wall.
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

    fn step_over(&mut self, points: Vec<Point3<f64>>) {
        let way = DraftMoveKind::Line { feed: self.between.feed };
        for to in points {
            if self.moves.last().is_none_or(|last| last.to != to) {
                self.moves.push(DraftMove { to, way, class: MotionClass::StepOver });
            }
        }
    }

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
