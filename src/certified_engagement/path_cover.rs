//! This module tells when points on lines or arcs are inside the sweep of a step: exactly for flat arcs and
//! level motions about one axis, by halving for others.

use super::cutter_contour::CutterContour;
use super::cutter_pose::{CoverQuery, CoverSide, PathRef, PathSlice, PointArc};
use super::flat_arc::{ArcPart, FlatArc, times_near_segment};
use super::plane_path::PlanePath;
use super::swept_step::{LEVEL, SweptStep};
use super::time_spans::{MovingGap, TimeSpans};

/// The parts of an arc's surroundings that hulls are tested for, one after the other.
const HULL_PARTS: [ArcPart; 3] = [ArcPart::Side, ArcPart::End(0), ArcPart::End(1)];

impl SweptStep {
    /// Returns the span from the first to the last time at which one point is in the sweep.
    #[inline]
    pub(super) fn hull_of_point(
        &self,
        contour: &CutterContour,
        path: PathRef<'_>,
        query: &CoverQuery,
    ) -> Option<[f64; 2]> {
        match (&self.flat, path) {
            (None, PathRef::Line(line)) => self.times_covered(contour, line, query),
            _ => self.spans_of_point(contour, path, query).hull(),
        }
    }

    /// Returns the times at which one point is in the sweep.
    pub(super) fn spans_of_point(
        &self,
        contour: &CutterContour,
        path: PathRef<'_>,
        query: &CoverQuery,
    ) -> TimeSpans {
        let widens = query.side == CoverSide::Outer;
        match (&self.flat, path) {
            (None, PathRef::Line(line)) => self
                .times_covered(contour, line, query)
                .map_or(TimeSpans::none(widens), |span| TimeSpans::one(span, widens)),
            (Some(flat), _) => self.spans_in_arc(contour, flat, ArcPart::Whole, path, query, 0.0),
            (None, PathRef::Arc(arc)) => self.spans_on_arc(contour, arc, query),
        }
    }

    /// Returns the times at which the hull of some points is in the sweep: for the inner side.
    pub(super) fn spans_of_hull(
        &self,
        contour: &CutterContour,
        paths: PathSlice<'_>,
        query: &CoverQuery,
        tests: &mut u64,
    ) -> TimeSpans {
        let Some(flat) = &self.flat else {
            return common_spans(paths, query, &mut |path, query| {
                *tests += 1;
                self.spans_of_point(contour, path, query)
            });
        };
        let excess = self.arc_excess(contour, flat, paths, query);
        let mut found = TimeSpans::none(false);
        for part in HULL_PARTS {
            // A circle around an end is convex.
            let excess = if part == ArcPart::Side { excess } else { 0.0 };
            let spans = common_spans(paths, query, &mut |path, query| {
                *tests += 1;
                self.spans_in_arc(contour, flat, part, path, query, excess)
            });
            let length = |list: &TimeSpans| list.spans().iter().map(|[from, to]| to - from).sum::<f64>();
            if length(&spans) > length(&found) {
                found = spans;
            }
            if part == ArcPart::Side && !found.is_empty() {
                break;
            }
        }
        found
    }

    /// Returns by how much a hull's points may be further from this step's arc than its corners.
    fn arc_excess(
        &self,
        contour: &CutterContour,
        flat: &FlatArc,
        paths: PathSlice<'_>,
        query: &CoverQuery,
    ) -> f64 {
        let (shrink, aside) = self.widening(query);
        let reach_of = |z: f64| contour.radius_at(z, query.bound - shrink).map_or(0.0, |reach| reach - aside);
        let mut reach = [f64::INFINITY, 0.0_f64];
        let mut known_low = f64::INFINITY;
        each_path(paths, &mut |path| {
            let (height, plane) = self.seen(path);
            let reaches = match height {
                Some(z) => [reach_of(z); 2],
                None => [0.0, contour.radius_mm()],
            };
            reach = [reach[0].min(reaches[0]), reach[1].max(reaches[1])];
            if let Some(plane) = plane {
                // Corners are at most the spread from the middle, and so is every other point.
                known_low = known_low.min(flat.low_of(&plane, query.need, 2.0 * query.spread));
            } else {
                known_low = 0.0;
            }
        });
        flat.excess(reach, query.spread, known_low.max(0.0))
    }

    /// Returns by how much bounds shrink in all directions and across the axis.
    fn widening(&self, query: &CoverQuery) -> (f64, f64) {
        let is_alike = self.turn == 0.0 && self.axes[0] == query.axis;
        if is_alike { (0.0, query.aside) } else { (query.skew, 0.0) }
    }

    /// Returns the height of a path in this step's frame, if that stays, and the path across the axis, if it
    /// is a line or a circle there.
    fn seen(&self, path: PathRef<'_>) -> (Option<f64>, Option<PlanePath>) {
        match path {
            PathRef::Line(line) => {
                let start = self.to_body_vector(&(line.start - self.tips[0]));
                let travel = self.to_body_vector(&line.travel);
                let plane = PlanePath::Line { start: start.xy(), travel: travel.xy() };
                ((travel.z.abs() < LEVEL).then_some(start.z), Some(plane))
            }
            PathRef::Arc(arc) => {
                let center = self.to_body_vector(&(arc.center - self.tips[0]));
                let (first, second) = (self.to_body_vector(&arc.first), self.to_body_vector(&arc.second));
                let is_level = first.z.abs() < LEVEL && second.z.abs() < LEVEL;
                let plane = PlanePath::Arc {
                    center: center.xy(),
                    first: first.xy(),
                    second: second.xy(),
                    angle: arc.angle,
                };
                (is_level.then_some(center.z + first.z), is_level.then_some(plane))
            }
        }
    }

    /// Returns the times at which a point is in a part of this flat arc's sweep. `excess` is by how much the
    /// point must be nearer to the arc.
    fn spans_in_arc(
        &self,
        contour: &CutterContour,
        flat: &FlatArc,
        part: ArcPart,
        path: PathRef<'_>,
        query: &CoverQuery,
        excess: f64,
    ) -> TimeSpans {
        let widens = query.side == CoverSide::Outer;
        let sign = if widens { 1.0 } else { -1.0 };
        let (shrink, aside) = self.widening(query);
        let (bound, aside) = (query.bound + sign * shrink, aside + excess);
        if let (Some(height), Some(plane)) = self.seen(path) {
            let Some(reach) = contour.radius_at(height, bound) else { return TimeSpans::none(widens) };
            return flat.times_within(part, &plane, query.need, reach + sign * aside, widens);
        }
        let path_of = |time: f64| self.to_body_vector(&(path.at(time) - self.tips[0])).xy();
        let own_bend = match path {
            PathRef::Line(_) => 0.0,
            PathRef::Arc(arc) => arc.first.norm() * arc.angle * arc.angle / 8.0,
        };
        let gap = |time: f64| {
            let place = self.to_body_vector(&(path.at(time) - self.tips[0]));
            let apart = flat.distance_near(part, &place.xy()) - sign * aside;
            let gap = contour.gap(&nalgebra::Vector3::new(apart.max(0.0), 0.0, place.z)).0 - bound;
            if part == ArcPart::Side { gap.max(-flat.side_of(&place.xy())) } else { gap }
        };
        let bend = |times: [f64; 2]| {
            let part = times[1] - times[0];
            flat.bend_of(&path_of(times[0]), &path_of(times[1])) + own_bend * part * part
        };
        let small = small_bend(query);
        let moving = MovingGap { gap: &gap, speed: path.speed(), bend: &bend, small };
        moving.times_within(query.need, 0.0, fair_precision(query), widens)
    }

    /// Returns the times at which a point on an arc is in this step's sweep, which is no flat arc's.
    fn spans_on_arc(&self, contour: &CutterContour, arc: &PointArc, query: &CoverQuery) -> TimeSpans {
        let widens = query.side == CoverSide::Outer;
        let sign = if widens { 1.0 } else { -1.0 };
        let (shrink, aside) = self.widening(query);
        let path = PathRef::Arc(arc);
        if self.is_level()
            && let (Some(height), Some(plane)) = self.seen(path)
        {
            let bound = query.bound + sign * (self.path_deviation + shrink);
            let Some(reach) = contour.radius_at(height, bound) else { return TimeSpans::none(widens) };
            let reach = reach + sign * (self.side_deviation + aside);
            return times_near_segment(&self.segment.to(), &plane, query.need, reach, widens);
        }
        let mut need = query.need;
        if let (Some(height), Some(plane)) = self.seen(path) {
            match self.spans_on_slope(contour, height, &plane, query) {
                SlopeTimes::Known(found) => return found,
                SlopeTimes::Left(left) => need = left,
            }
        }
        // A gap is told from below, so what is uncertain of it counts double for the inner side.
        let place = path.at((need[0] + need[1]) / 2.0);
        let uncertain = if widens { 0.0 } else { 2.0 * self.gap_uncertainty(&place, arc.length()) + 1e-10 };
        let bend = self.turn * query.diameter + uncertain;
        let bound = query.bound + sign * (bend + shrink);
        let gap = |time: f64| self.gap_aside_of(contour, &path.at(time), -sign * aside);
        // Told gaps change a little faster than true ones, as what is uncertain grows with the distance.
        let speed = arc.length() * 1.001;
        let sagitta = arc.first.norm() * arc.angle * arc.angle / 8.0;
        let bend = |[from, to]: [f64; 2]| sagitta * (to - from) * (to - from) + 1e-10;
        let moving = MovingGap { gap: &gap, speed, bend: &bend, small: small_bend(query) };
        moving.times_within(need, bound, fair_precision(query), widens)
    }

    /// Returns the times at which a point on an arc is in the sweep of a step that also moves along the arc's
    /// axis, where the closed form of a level step is near enough; and otherwise the times that are left to
    /// look at.
    ///
    /// A place is seen from the tip at some range of heights. The cutter is widest at the upper end of it, and
    /// nowhere narrower than at the lower one. A plunge brings the widest part to every place.
    fn spans_on_slope(
        &self,
        contour: &CutterContour,
        height: f64,
        plane: &PlanePath,
        query: &CoverQuery,
    ) -> SlopeTimes {
        if self.turn > 0.0 || !contour.widens_upwards() {
            return SlopeTimes::Left(query.need);
        }
        let widens = query.side == CoverSide::Outer;
        let sign = if widens { 1.0 } else { -1.0 };
        let (shrink, aside) = self.widening(query);
        let bound = query.bound + sign * (self.path_deviation + shrink);
        let aside = sign * (self.side_deviation + aside);
        let rise = self.rise();
        let [low, high] = [height.min(height - rise), height.max(height - rise)];
        let top = contour.height_mm() + bound;
        let widest = if low > top { None } else { contour.radius_at(high.min(top), bound) };
        let Some(widest) = widest else { return SlopeTimes::Known(TimeSpans::none(widens)) };
        let near =
            |reach: f64| times_near_segment(&self.segment.to(), plane, query.need, reach + aside, widens);
        if self.plunge_rise().is_some() {
            return SlopeTimes::Known(near(widest));
        }
        let narrow = if high > top { None } else { contour.radius_at(low, bound) };
        if narrow.is_some_and(|narrow| widest - narrow <= small_bend(query)) {
            return SlopeTimes::Known(near(if widens { widest } else { narrow.unwrap_or(widest) }));
        }
        let possible = near(widest);
        if !widens && let Some(narrow) = narrow {
            let sure = near(narrow);
            if sure == possible || sure.spans().first() == Some(&query.need) {
                return SlopeTimes::Known(sure);
            }
        }
        possible.hull().map_or(SlopeTimes::Known(possible), SlopeTimes::Left)
    }
}

/// What the closed form leaves of the times in a sloped sweep.
enum SlopeTimes {
    /// Nothing.
    Known(TimeSpans),
    /// All is within these times.
    Left([f64; 2]),
}

/// Returns the bend that is small beside what is uncertain anyhow.
fn small_bend(query: &CoverQuery) -> f64 {
    (query.aside.min(query.skew) * 0.25).max(1e-8)
}

/// Calls a function for every path.
fn each_path(paths: PathSlice<'_>, visit: &mut dyn FnMut(PathRef<'_>)) {
    match paths {
        PathSlice::Lines(lines) => lines.iter().for_each(|line| visit(PathRef::Line(line))),
        PathSlice::Arcs(arcs) => arcs.iter().for_each(|arc| visit(PathRef::Arc(arc))),
    }
}

/// Returns the times that are in the spans of all paths.
fn common_spans(
    paths: PathSlice<'_>,
    query: &CoverQuery,
    spans: &mut dyn FnMut(PathRef<'_>, &CoverQuery) -> TimeSpans,
) -> TimeSpans {
    let mut both = TimeSpans::one(query.need, false);
    each_path(paths, &mut |path| {
        if let Some(need) = both.hull() {
            both = both.common(&spans(path, &CoverQuery { need, ..*query }));
        }
    });
    both
}

/// Returns the precision that is worth its time: what is near a large patch needs not be known better than a
/// part of the patch.
fn fair_precision(query: &CoverQuery) -> f64 {
    if query.side == CoverSide::Outer { query.precision.max(query.bound * 0.2) } else { query.precision }
}
