//! This module lowers the cutter onto a model along a pass, as seen from above.

use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::surface::drop_cutter::DropCutter;
use std::ops::Range;

/// Returns each motion of a pass as seen from above, in mm: its ends, and points between them where it
/// curves.
pub(super) fn project_from_above(
    motions: &[Motion],
    pass: &Range<usize>,
    mm_per_unit: f64,
    tolerance: f64,
) -> Vec<(usize, Vec<[f64; 2]>)> {
    let flat = |point: nalgebra::Point3<f64>| [point.x * mm_per_unit, point.y * mm_per_unit];
    let one = |index: usize| {
        let motion = motions.get(index)?;
        let points = match &motion.path {
            MotionPath::Line | MotionPath::Start => vec![motion.from.point, motion.to.point],
            MotionPath::Arc(arc) => {
                // A chord of sweep a is R (1 - cos(a / 2)), about R a^2 / 8, off its arc, so a = 2 sqrt(2 t /
                // R).
                let least = (tolerance / (arc.radius * mm_per_unit)).clamp(1e-12, 0.5);
                let count = (arc.sweep / (2.0 * (2.0 * least).sqrt())).ceil().clamp(1.0, 1e6) as usize;
                (0..=count).map(|part| arc.point_at(part as f64 / count as f64)).collect()
            }
            MotionPath::Spline(spline) => {
                let count = 64 * spline.controls.len();
                (0..=count).map(|part| spline.point_at(part as f64 / count as f64)).collect()
            }
        };
        Some((index, points.into_iter().map(flat).collect()))
    };
    pass.clone().filter_map(one).collect()
}

/// Returns the path of the tip over a model along lines seen from above, one path for each line. Where
/// nothing lies under the cutter, the path goes straight to the next point that has the model under it.
/// Returns `None` if nothing lies under the whole pass.
pub(super) fn lower_cutter(
    cutter: &DropCutter,
    lines: &[Vec<[f64; 2]>],
    tolerance: f64,
) -> Option<Vec<Vec<[f64; 3]>>> {
    let mut found: Vec<Vec<[f64; 3]>> = Vec::with_capacity(lines.len());
    for line in lines {
        found.push(cutter.follow_line(line, tolerance).into_iter().flatten().collect());
    }
    let first = found.iter().flatten().next().copied()?;
    // A motion with nothing of the model under its end keeps the height that the path has reached.
    let mut height = first[2];
    for (line, path) in lines.iter().zip(&mut found) {
        let Some([x, y]) = line.last().copied() else { continue };
        let ends = path.last().is_some_and(|[a, b, _]| (a - x).hypot(b - y) <= 1e-9);
        height = path.last().map_or(height, |last| last[2]);
        if !ends {
            path.push([x, y, height]);
        }
    }
    if let (Some(line), Some(path)) = (lines.first(), found.first_mut())
        && let Some([x, y]) = line.first().copied()
        && path.first().is_none_or(|[a, b, _]| (a - x).hypot(b - y) > 1e-9)
    {
        path.insert(0, [x, y, first[2]]);
    }
    Some(found)
}
