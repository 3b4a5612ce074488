//! This module computes the path of the centre of a ball that rolls over the upper envelope of a profile.
//!
//! Over every point q of the envelope the centre must not be below the arc `q_z + sqrt(R^2 - (u - q_u)^2)`.
//! The path is the upper envelope of these arcs. Of two such arcs, the one whose point is further right is
//! higher from some u on, and stays higher: the difference never falls, since the slope of a half circle
//! falls with u. The same holds for a whole piece against everything to its left. So if pieces are taken from
//! left to right, each one only cuts off the end of the path so far: a stack, O(n).

use super::chain_piece::Point;
use super::graph_segment::{GraphSegment, HeightGraph, PiecePart, UPRIGHT};
use super::upper_envelope::UpperEnvelope;

/// Segments narrower than this (mm) are left out, and their neighbours are joined.
const THIN: f64 = 1e-12;

/// The path, growing to the right.
pub(super) struct RollingBall {
    pub stretches: Vec<GraphSegment>,
    radius: f64,
    /// Heights that are closer than this are equal; it is a few roundings of the largest number.
    tie: f64,
    /// The point that was added last.
    last: Option<Point>,
}

/// Returns the path of the centre of a ball of `radius` over the upper envelope of a profile, with u
/// ascending. Where two segments do not meet, the ball goes straight up or down. `scale` is the largest
/// coordinate.
pub(super) fn roll_ball(skyline: &UpperEnvelope, radius: f64, scale: f64) -> Vec<GraphSegment> {
    let mut roll = RollingBall {
        stretches: Vec::with_capacity(2 * skyline.stretches.len() + 2),
        radius,
        tie: 16.0 * f64::EPSILON * scale.max(radius),
        last: None,
    };
    let mut tops = skyline.tops.iter().copied().peekable();
    for stretch in &skyline.stretches {
        while let Some((top, piece)) = tops.next_if(|(top, _)| top.u <= stretch.left.u) {
            roll.roll_over_point(top, piece);
        }
        let mut rest = *stretch;
        while let Some((top, piece)) = tops.next_if(|(top, _)| top.u < stretch.right.u) {
            // A top within a segment only counts if it is above the segment.
            if top.z > stretch.height_at(top.u) {
                roll.roll_over_segment(&rest.sub_segment(rest.left.u, top.u));
                roll.roll_over_point(top, piece);
                rest = rest.sub_segment(top.u, rest.right.u);
            }
        }
        roll.roll_over_segment(&rest);
    }
    for (top, piece) in tops {
        roll.roll_over_point(top, piece);
    }
    roll.stretches
}

/// Returns the height at which the tail of the path and the new segment meet, if they meet up to rounding. It
/// is the height of the flatter one, because the height of a steep one is not exact.
fn meeting_height(
    tail: (f64, f64, HeightGraph),
    new: (f64, HeightGraph),
    radius: f64,
    tie: f64,
) -> Option<f64> {
    let (steep_tail, steep_new) = (tail.2.steepness_at(tail.0), new.1.steepness_at(tail.0));
    // Where a circle is vertical, a rounding in u becomes its square root in height.
    let noise = (4.0 * tie * (1.0 + steep_tail + steep_new)).min(4.0 * (radius * tie).sqrt());
    let meets = (tail.1 - new.0).abs() <= noise;
    meets.then_some(if steep_tail < 0.5 * steep_new { tail.1 } else { new.0 })
}

impl RollingBall {
    /// Returns the half circle of the ball's centre over one point.
    fn ball_cap(&self, at: Point, piece: usize) -> GraphSegment {
        let graph = HeightGraph::Round { centre: at, radius: self.radius, upper: true };
        let (left, right) = (Point::new(at.u - self.radius, at.z), Point::new(at.u + self.radius, at.z));
        GraphSegment { left, right, graph, piece, part: PiecePart::Vertex }
    }

    /// Rolls the ball over one point.
    fn roll_over_point(&mut self, at: Point, piece: usize) {
        if self
            .last
            .is_some_and(|last| (last.u - at.u).abs() <= self.tie && (last.z - at.z).abs() <= self.tie)
        {
            return;
        }
        self.last = Some(at);
        self.lay_over_envelope(None, self.ball_cap(at, piece));
    }

    /// Rolls the ball over a segment: around its left end, along it, and around its right end.
    fn roll_over_segment(&mut self, stretch: &GraphSegment) {
        if stretch.left.u >= stretch.right.u {
            return;
        }
        self.roll_over_point(stretch.left, stretch.piece);
        let right = stretch.right;
        self.last = Some(right);
        self.lay_over_envelope(self.offset_segment(stretch), self.ball_cap(right, stretch.piece));
    }

    /// Returns the offset of a segment by the ball's radius, or `None` if the ball does not fit in.
    fn offset_segment(&self, stretch: &GraphSegment) -> Option<GraphSegment> {
        let (graph, left, right) = match stretch.graph {
            HeightGraph::Line { left, right } => {
                let share = self.radius / left.distance(right);
                let (du, dz) = ((left.z - right.z) * share, (right.u - left.u) * share);
                let moved = |point: Point| Point::new(point.u + du, point.z + dz);
                let graph = HeightGraph::Line { left: moved(left), right: moved(right) };
                (graph, moved(stretch.left), moved(stretch.right))
            }
            HeightGraph::Round { centre, radius, upper } => {
                let offset = if upper { radius + self.radius } else { radius - self.radius };
                // In a hollow that is no wider than the ball, the ball touches both ends at once or nearly
                // so.
                if offset <= UPRIGHT {
                    return None;
                }
                let moved = |point: Point| centre.lerp(point, offset / radius);
                let graph = HeightGraph::Round { centre, radius: offset, upper };
                (graph, moved(stretch.left), moved(stretch.right))
            }
        };
        Some(GraphSegment { left, right, graph, piece: stretch.piece, part: PiecePart::Body })
    }

    /// Lays `body` (if there is one) and then `cap` over the path. They are higher than the path from some u
    /// on.
    fn lay_over_envelope(&mut self, body: Option<GraphSegment>, cap: GraphSegment) {
        let bound = body.map_or(cap.left.u, |body| body.right.u);
        let start = body.map_or(cap.left.u, |body| body.left.u);
        let height = |u: f64| match body {
            Some(body) if u <= bound => body.height_at(u),
            _ => cap.height_at(u),
        };
        // Remove segments that are below the new ones from their start on; the first one that is not is cut
        // where they cross.
        let mut from = start;
        let mut meet = None;
        while let Some(tail) = self.stretches.last_mut() {
            if tail.left.u >= start && height(tail.left.u) >= tail.height_at(tail.left.u) - self.tie {
                self.stretches.pop();
                continue;
            }
            if tail.right.u <= start {
                break;
            }
            let lo = tail.left.u.max(start);
            let hi = tail.right.u;
            let bend = bound.clamp(lo, hi);
            let along = body.map_or([None; 2], |body| body.graph.find_crossings(&tail.graph, lo, bend));
            let about = cap.graph.find_crossings(&tail.graph, bend, hi);
            let mut left = lo;
            from = hi;
            // Between two crossings one of both is higher everywhere, so testing the middle is enough.
            for right in
                along.into_iter().flatten().chain([bend]).chain(about.into_iter().flatten()).chain([hi])
            {
                let middle = 0.5 * (left + right);
                if right > left && height(middle) >= tail.height_at(middle) - self.tie {
                    from = left;
                    break;
                }
                left = left.max(right);
            }
            let graph = body.filter(|_| from < bound).map_or(cap.graph, |body| body.graph);
            meet = self::meeting_height(
                (from, tail.height_at(from), tail.graph),
                (height(from), graph),
                self.radius,
                self.tie,
            );
            tail.right = Point::new(from, meet.unwrap_or_else(|| tail.height_at(from)));
            if tail.right.u - tail.left.u <= THIN {
                self.stretches.pop();
            }
            break;
        }
        if let Some(body) = body {
            let lo = body.left.u.max(from);
            if body.right.u - lo > THIN {
                let left = Point::new(lo, meet.filter(|_| lo == from).unwrap_or_else(|| body.height_at(lo)));
                self.stretches.push(GraphSegment { left, ..body });
            }
        }
        let lo = bound.max(from);
        if cap.right.u - lo > THIN {
            let left = match body {
                // The cap continues where the body ends.
                Some(body) if lo == body.right.u => body.right,
                _ => Point::new(lo, meet.filter(|_| lo == from).unwrap_or_else(|| cap.height_at(lo))),
            };
            self.stretches.push(GraphSegment { left, ..cap });
        }
    }
}
