//! This module holds the hull that stands for a patch: the lines or arcs of its middle and corners.

use super::contour_element::ContourElement;
use super::cutter_pose::{PathRef, PathSlice, PointArc, PointLine, PointPath};
use super::surface_patch::{SurfacePatch, largest_radius, surface_point};
use super::swept_step::SweptStep;
use nalgebra::Vector3;

/// The most lines of a hull: the middle and eight corners.
const MOST_LINES: usize = 9;

/// The paths of a hull.
#[derive(Debug, Clone)]
#[expect(clippy::large_enum_variant, reason = "most hulls are of lines, and a box for each would cost more")]
enum HullPaths {
    Lines([PointLine; MOST_LINES]),
    /// Rarer, and larger.
    Arcs(Box<[PointArc; MOST_LINES]>),
}

/// The lines or arcs of a patch's middle and corners.
#[derive(Debug, Clone)]
pub(super) struct PatchHull {
    paths: HullPaths,
    count: usize,
    /// The largest distance of a corner from the middle, mm.
    pub spread: f64,
    /// The distance of the patch's points from the hull of the corners, at the most, mm, besides `aside` or
    /// `skew`.
    pub sag: f64,
    /// The part of that distance if it is measured in any direction.
    pub skew: f64,
    /// The same part if it is measured across the axis only.
    pub aside: f64,
    /// The part of both that comes from the bend of the points' ways.
    pub bend: f64,
    /// The distance of the patch's points from the middle, at the most, mm.
    pub radius: f64,
}

impl PatchHull {
    /// Makes the hull of the patch's points whose depths are in a range.
    pub(super) fn new(
        step: &SweptStep,
        element: &ContourElement,
        patch: &SurfacePatch,
        depths: [f64; 2],
    ) -> Self {
        let around = patch.angles[1] - patch.angles[0];
        let radius = largest_radius(element, patch.range).max(depths[1]);
        let part = patch.need[1] - patch.need[0];
        let side_bend = step.side_deviation * part * part;
        let aside = around * around * radius / 8.0 + side_bend;
        let (mut sag, mut skew) = (0.0, aside);
        let mut aside = aside;
        if let ContourElement::Arc { radius, .. } = element {
            // An arc bulges from its chord by this much. At the height of a point, the chord is as far
            // across the axis as the bulge divided by the sine of the chord's normal.
            let along = patch.range[1] - patch.range[0];
            let bulge = along * along * radius.max(depths[1]) / 8.0;
            let across = ((patch.range[0] + patch.range[1]) / 2.0).sin();
            skew += bulge;
            aside += bulge / across.max(1e-9);
        }
        let thickness = depths[1] - depths[0];
        let middle_depth = (depths[0] + depths[1]) / 2.0;
        // A thin range of depths widens the sag; a thick one has corners of its own.
        let is_thin = thickness <= skew * 0.5 || thickness <= 1e-8;
        let (first, last) = if is_thin { (middle_depth, middle_depth) } else { (depths[0], depths[1]) };
        if is_thin {
            sag += thickness / 2.0;
        }
        let [m, angle, _] = patch.middle();
        let middle = surface_point(element, m, angle, middle_depth);
        let paths = match step.path_of(&middle, patch.need) {
            PointPath::Line(line) => HullPaths::Lines([line; MOST_LINES]),
            PointPath::Arc(arc) => HullPaths::Arcs(Box::new([arc; MOST_LINES])),
        };
        let mut hull = Self { paths, count: 1, spread: 0.0, sag: 0.0, aside, skew, bend: 0.0, radius: 0.0 };
        let sines = patch.angles.map(f64::sin_cos);
        let mut farthest: f64 = 0.0;
        for depth in
            if is_thin { [Some(first), None] } else { [Some(first), Some(last)] }.into_iter().flatten()
        {
            for m in patch.range {
                let ([r, z], [across, up]) = (element.point(m), element.normal(m));
                let (r, z) = (r - depth * across, z - depth * up);
                farthest = farthest.max(r.hypot(z));
                for (sin, cos) in sines {
                    hull.push(step.path_of(&Vector3::new(r * cos, r * sin, z), patch.need));
                }
            }
        }
        let bend = step.line_deviation(farthest + sag + skew, part);
        sag += bend;
        let spread = hull.spread_at(patch.need[0]).max(hull.spread_at(patch.need[1]));
        let bend = bend + side_bend;
        Self { sag, bend, spread, radius: spread + sag + skew, ..hull }
    }

    fn push(&mut self, path: PointPath) {
        match (&mut self.paths, path) {
            (HullPaths::Lines(lines), PointPath::Line(line)) => {
                if let Some(place) = lines.get_mut(self.count) {
                    *place = line;
                    self.count += 1;
                }
            }
            (HullPaths::Arcs(arcs), PointPath::Arc(arc)) => {
                if let Some(place) = arcs.get_mut(self.count) {
                    *place = arc;
                    self.count += 1;
                }
            }
            // All points of a step move alike.
            _ => debug_assert!(false, "a hull of lines and arcs"),
        }
    }

    /// Returns the largest distance of a corner from the middle at a time. On lines it is convex in time, on
    /// arcs it stays.
    fn spread_at(&self, time: f64) -> f64 {
        let middle = self.middle().at(time);
        let apart = |place: Vector3<f64>| (place - middle).norm();
        match self.corners() {
            PathSlice::Lines(lines) => lines.iter().map(|line| apart(line.at(time))).fold(0.0, f64::max),
            PathSlice::Arcs(arcs) => arcs.iter().map(|arc| apart(arc.at(time))).fold(0.0, f64::max),
        }
    }

    /// Returns the path of the middle.
    pub(super) fn middle(&self) -> PathRef<'_> {
        match &self.paths {
            HullPaths::Lines([middle, ..]) => PathRef::Line(middle),
            HullPaths::Arcs(arcs) => {
                let [middle, ..] = arcs.as_ref();
                PathRef::Arc(middle)
            }
        }
    }

    fn part(&self, from: usize) -> PathSlice<'_> {
        match &self.paths {
            HullPaths::Lines(lines) => PathSlice::Lines(lines.get(from..self.count).unwrap_or_default()),
            HullPaths::Arcs(arcs) => PathSlice::Arcs(arcs.get(from..self.count).unwrap_or_default()),
        }
    }

    /// Returns the paths of the corners.
    pub(super) fn corners(&self) -> PathSlice<'_> {
        self.part(1)
    }

    /// Returns the paths of the middle and of the corners.
    pub(super) fn paths(&self) -> PathSlice<'_> {
        self.part(0)
    }

    /// Returns the box around all places of the patch at some times.
    pub(super) fn bounds(&self, need: [f64; 2]) -> [Vector3<f64>; 2] {
        let mut low = Vector3::repeat(f64::INFINITY);
        let mut high = Vector3::repeat(f64::NEG_INFINITY);
        match self.corners() {
            PathSlice::Lines(lines) => {
                for line in lines {
                    let (start, end) = (line.at(need[0]), line.at(need[1]));
                    low = low.inf(&start).inf(&end);
                    high = high.sup(&start).sup(&end);
                }
            }
            PathSlice::Arcs(arcs) => {
                for arc in arcs {
                    let middle = arc.at((need[0] + need[1]) / 2.0);
                    // Along its axis an arc stays.
                    let half = arc.length() * (need[1] - need[0]) / 2.0;
                    let axis = arc.first.cross(&arc.second);
                    let squared = axis.norm_squared().max(1e-300);
                    let across = axis.map(|part| half * (1.0 - part * part / squared).max(0.0).sqrt());
                    low = low.inf(&(middle - across));
                    high = high.sup(&(middle + across));
                }
            }
        }
        let margin = Vector3::repeat(self.sag + self.skew + 1e-6);
        [low - margin, high + margin]
    }
}
