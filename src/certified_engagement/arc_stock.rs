//! This module tells when points that move on arcs are outside the stock.

use super::cutter_pose::{PointArc, PointLine};
use super::plane_path::{Crossings, cross_wave};
use super::stock_gap::HullMargin;
use super::time_spans::TimeSpans;
use nalgebra::Vector3;

/// The most chords of one question.
const MOST_CHORDS: f64 = 64.0;

/// Adds the times at which all arcs are at least `margin` beyond a plane.
pub(super) fn add_arc_times_beyond(
    arcs: &[PointArc],
    normal: &Vector3<f64>,
    offset: f64,
    need: [f64; 2],
    margin: HullMargin,
    out: &mut Vec<[f64; 2]>,
) {
    let least = offset + margin.towards(normal);
    let mut both = TimeSpans::one(need, false);
    for arc in arcs {
        let (base, a, b) = (normal.dot(&arc.center), normal.dot(&arc.first), normal.dot(&arc.second));
        let height = a.hypot(b);
        if base + height < least {
            return;
        }
        if base - height >= least {
            continue;
        }
        let mut crossings = Crossings::new(need);
        cross_wave(a, b, least - base, arc.angle, &mut crossings);
        both = both.common(&crossings.spans(false, &|time| normal.dot(&arc.at(time)) >= least));
        if both.is_empty() {
            return;
        }
    }
    out.extend_from_slice(both.spans());
}

/// What tells when lines are outside a body.
pub(super) type OutsideTimes<'a> = &'a mut dyn FnMut(&[PointLine], [f64; 2], HullMargin, &mut Vec<[f64; 2]>);

/// Adds the times at which arcs are outside a body, from chords whose sagitta is added to the margin.
pub(super) fn add_chord_times(
    arcs: &[PointArc],
    need: [f64; 2],
    margin: HullMargin,
    of_chord: OutsideTimes<'_>,
    out: &mut Vec<[f64; 2]>,
) {
    let largest = arcs.iter().map(|arc| arc.first.norm()).fold(0.0, f64::max);
    let Some(angle) = arcs.first().map(|arc| arc.angle.abs() * (need[1] - need[0])) else { return };
    let wanted = (margin.all + margin.skew).max(0.0) * 0.25 + 1e-5;
    let count = (angle / (8.0 * wanted / largest.max(1e-9)).sqrt()).ceil().clamp(1.0, MOST_CHORDS);
    let part = angle / count;
    let sagitta = largest * part * part / 8.0;
    let margin = HullMargin { all: margin.all + sagitta, ..margin };
    let mut lines = Vec::with_capacity(arcs.len());
    let mut found = Vec::new();
    for number in 0..count as u32 {
        let at = |number: u32| need[0] + (need[1] - need[0]) * f64::from(number) / count;
        let span = [at(number), if f64::from(number + 1) < count { at(number + 1) } else { need[1] }];
        lines.clear();
        lines.extend(arcs.iter().map(|arc| arc.chord(span)));
        found.clear();
        of_chord(&lines, span, margin, &mut found);
        let clipped = found.iter().map(|[from, to]| [from.max(span[0]), to.min(span[1])]);
        out.extend(clipped.filter(|[from, to]| from <= to));
    }
}
