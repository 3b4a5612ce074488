//! This module makes lines and bands of curves. Where a curve has more segments than the drawing has pixels, it is shown
//! by its least and its largest value in each of equal intervals.

use super::curve_drawing::PlotSegment;

/// The largest number of segments that are drawn one by one. A longer curve is divided into as many
/// intervals.
const MOST_SEGMENTS: usize = 2000;

/// The largest jump between neighbouring intervals that is drawn, as a fraction of the axis: values that go up and down
/// all the time would else hide what lies under them.
const SMALL_JUMP: f64 = 0.1;

/// A line through points.
pub(super) type CurveLine = Vec<(f64, f64)>;

/// A curve as it is drawn.
#[derive(Default)]
pub(super) struct CurveOutline {
    /// Its lines: the curve itself, or its least and its largest values.
    pub lines: Vec<CurveLine>,
    /// The areas between least and largest values; none for a curve that is drawn itself.
    pub bands: Vec<CurveLine>,
}

/// Returns the outline of a curve. `end` is the end of the horizontal axis, and `height` the extent of the vertical one.
pub(super) fn outline_curve(segments: &[PlotSegment], end: f64, height: f64) -> CurveOutline {
    if segments.len() <= MOST_SEGMENTS {
        let mut lines = PolylineBuilder::default();
        for segment in segments {
            lines.extend_or_break(
                segment.values.map(|[first, last]| [(segment.from, first), (segment.to, last)]),
            );
        }
        return CurveOutline { lines: lines.into_polylines(), bands: Vec::new() };
    }
    outline_spans(&find_spans(segments, end), end / MOST_SEGMENTS as f64, height)
}

/// Returns the least and the largest value of each interval; `None` where no value is known.
fn find_spans(segments: &[PlotSegment], end: f64) -> Vec<Option<[f64; 2]>> {
    let width = end / MOST_SEGMENTS as f64;
    let mut spans: Vec<Option<[f64; 2]>> = vec![None; MOST_SEGMENTS];
    for segment in segments {
        let Some([start, stop]) = segment.values else { continue };
        let first = (segment.from / width) as usize;
        let last = ((segment.to / width) as usize).min(MOST_SEGMENTS - 1);
        // A long segment is straight between its ends.
        let at = |place: f64| {
            let share = (place - segment.from) / (segment.to - segment.from);
            start + (stop - start) * if share.is_finite() { share.clamp(0.0, 1.0) } else { 1.0 }
        };
        for (index, span) in spans.iter_mut().enumerate().take(last + 1).skip(first) {
            for value in [at(index as f64 * width), at((index + 1) as f64 * width)] {
                let [least, most] = span.unwrap_or([value; 2]);
                *span = Some([least.min(value), most.max(value)]);
            }
        }
    }
    spans
}

fn outline_spans(spans: &[Option<[f64; 2]>], width: f64, height: f64) -> CurveOutline {
    let mut outline = CurveOutline::default();
    let mut first = 0;
    for run in spans.split(Option::is_none) {
        let spans: Vec<(f64, [f64; 2])> =
            run.iter().flatten().zip(first..).map(|(span, index)| (index as f64 * width, *span)).collect();
        // The empty interval that ended the run is passed over, too.
        first += run.len() + 1;
        if spans.is_empty() {
            continue;
        }
        let side = |pick: fn(&[f64; 2]) -> f64| {
            let mut points = CurveLine::new();
            for (at, span) in &spans {
                let value = pick(span);
                // A value that stays is one step, however many intervals it takes.
                match points.last_mut().filter(|last| last.1 == value) {
                    Some(last) => last.0 = at + width,
                    None => points.extend([(*at, value), (at + width, value)]),
                }
            }
            points
        };
        let (least, most) = (side(|[least, _]| *least), side(|[_, most]| *most));
        for line in [&most, &least] {
            outline.lines.extend(split_at_jumps(line, height * SMALL_JUMP));
        }
        outline.bands.push(most.iter().chain(least.iter().rev()).copied().collect());
    }
    outline
}

/// Splits a line of steps where it jumps further than `most`.
fn split_at_jumps(line: &[(f64, f64)], most: f64) -> Vec<CurveLine> {
    let mut lines = PolylineBuilder::default();
    let mut before: Option<f64> = None;
    for step in line.chunks_exact(2) {
        let [from, to] = step else { continue };
        if before.is_some_and(|before| (from.1 - before).abs() > most) {
            lines.extend_or_break(None);
        }
        lines.extend_or_break(Some([*from, *to]));
        before = Some(to.1);
    }
    lines.into_polylines()
}

/// Lines while they are built.
#[derive(Default)]
struct PolylineBuilder {
    done: Vec<CurveLine>,
    open: CurveLine,
}

impl PolylineBuilder {
    fn extend_or_break(&mut self, points: Option<[(f64, f64); 2]>) {
        match points {
            Some(points) => self.open.extend(points),
            None if !self.open.is_empty() => self.done.push(std::mem::take(&mut self.open)),
            None => {}
        }
    }

    fn into_polylines(mut self) -> Vec<CurveLine> {
        self.extend_or_break(None);
        self.done
    }
}
