//! This module computes the upper envelope of line segments in a plane by divide and conquer.

/// Ends that are nearer to each other than this are the same point, mm.
const SAME: f64 = 1e-9;

/// A line segment from left to right; coordinates are in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SectionSegment {
    from: [f64; 2],
    to: [f64; 2],
}

impl SectionSegment {
    /// Makes the segment between two points, or `None` if it is vertical, since its neighbours then contain
    /// its upper end.
    pub(super) fn new(a: [f64; 2], b: [f64; 2]) -> Option<Self> {
        let (from, to) = if a[0] <= b[0] { (a, b) } else { (b, a) };
        (to[0] > from[0]).then_some(Self { from, to })
    }

    fn height_at(&self, u: f64) -> f64 {
        // The values at both ends are exact, so that neighbouring segments keep meeting.
        if u <= self.from[0] {
            return self.from[1];
        }
        if u >= self.to[0] {
            return self.to[1];
        }
        self.from[1] + (self.to[1] - self.from[1]) * ((u - self.from[0]) / (self.to[0] - self.from[0]))
    }

    /// Returns the part between two values of u, or `None` if it has no length.
    fn sub_segment(&self, from: f64, to: f64) -> Option<Self> {
        (to > from).then(|| Self { from: [from, self.height_at(from)], to: [to, self.height_at(to)] })
    }
}

/// Returns the upper envelope of the segments: parts that do not overlap, from left to right.
pub(super) fn find_upper_envelope(pieces: &[SectionSegment]) -> Vec<SectionSegment> {
    match pieces {
        [] | [_] => pieces.to_vec(),
        _ => {
            let (left, right) = pieces.split_at(pieces.len() / 2);
            merge_upper(&find_upper_envelope(left), &find_upper_envelope(right))
        }
    }
}

/// Returns the upper envelope of two envelopes.
fn merge_upper(one: &[SectionSegment], other: &[SectionSegment]) -> Vec<SectionSegment> {
    let mut merged: Vec<SectionSegment> = Vec::with_capacity(one.len() + other.len());
    let mut stops: Vec<f64> =
        one.iter().chain(other).flat_map(|piece| [piece.from[0], piece.to[0]]).collect();
    stops.sort_unstable_by(f64::total_cmp);
    stops.dedup();
    let (mut ones, mut others) = (one.iter().peekable(), other.iter().peekable());
    for pair in stops.windows(2) {
        let [from, to] = pair else { continue };
        while ones.next_if(|piece| piece.to[0] <= *from).is_some() {}
        while others.next_if(|piece| piece.to[0] <= *from).is_some() {}
        // `stops` contains the ends of all segments, so a segment that has begun continues at least to the
        // next stop.
        let a = ones.peek().filter(|piece| piece.from[0] <= *from).copied();
        let b = others.peek().filter(|piece| piece.from[0] <= *from).copied();
        match (a, b) {
            (Some(a), Some(b)) => push_higher(a, b, *from, *to, &mut merged),
            (Some(piece), None) | (None, Some(piece)) => push_segment(&mut merged, piece, *from, *to),
            (None, None) => {}
        }
    }
    merged
}

/// Adds the higher of two segments between two values of u.
fn push_higher(a: &SectionSegment, b: &SectionSegment, from: f64, to: f64, merged: &mut Vec<SectionSegment>) {
    let [start, end] = [from, to].map(|u| a.height_at(u) - b.height_at(u));
    if start >= 0.0 && end >= 0.0 {
        push_segment(merged, a, from, to);
    } else if start <= 0.0 && end <= 0.0 {
        push_segment(merged, b, from, to);
    } else {
        // The difference is linear, so its zero is found by linear interpolation.
        let cross = (from + (to - from) * (start / (start - end))).clamp(from, to);
        let (first, second) = if start > 0.0 { (a, b) } else { (b, a) };
        push_segment(merged, first, from, cross);
        push_segment(merged, second, cross, to);
    }
}

/// Adds a part of a segment, or extends the part before if both are on the same line.
fn push_segment(merged: &mut Vec<SectionSegment>, piece: &SectionSegment, from: f64, to: f64) {
    let Some(part) = piece.sub_segment(from, to) else { return };
    if let Some(last) = merged.last_mut().filter(|last| last.to == part.from) {
        let whole = SectionSegment { from: last.from, to: part.to };
        // Parts that were only divided at the other envelope's ends are joined again. The rounding of many
        // joins stays far below any use.
        if (whole.height_at(part.from[0]) - part.from[1]).abs() <= 1e-12 {
            *last = whole;
            return;
        }
    }
    merged.push(part);
}

/// Joins segments to chains, which end where there is a gap. A step becomes two points above each other.
pub(super) fn chain_segments(pieces: Vec<SectionSegment>) -> Vec<Vec<[f64; 2]>> {
    let mut chains: Vec<Vec<[f64; 2]>> = Vec::new();
    for piece in pieces {
        match chains.last_mut() {
            Some(chain) if chain.last().is_some_and(|[u, _]| piece.from[0] - u <= SAME) => {
                if chain.last().is_some_and(|[_, z]| (z - piece.from[1]).abs() > SAME) {
                    chain.push(piece.from);
                }
                chain.push(piece.to);
            }
            _ => chains.push(vec![piece.from, piece.to]),
        }
    }
    chains
}
