//! The upper envelope of pieces of straight lines in a plane, by halves.

/// Ends nearer than this are one, mm.
const SAME: f64 = 1e-9;

/// A piece of a straight line from left to right; mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SectionSegment {
    from: [f64; 2],
    to: [f64; 2],
}

impl SectionSegment {
    /// Between two points; none when it is upright, for then its neighbours have its upper end.
    pub(super) fn new(a: [f64; 2], b: [f64; 2]) -> Option<Self> {
        let (from, to) = if a[0] <= b[0] { (a, b) } else { (b, a) };
        (to[0] > from[0]).then_some(Self { from, to })
    }

    fn height_at(&self, u: f64) -> f64 {
        // Exact at both ends, so that pieces go on meeting.
        if u <= self.from[0] {
            return self.from[1];
        }
        if u >= self.to[0] {
            return self.to[1];
        }
        self.from[1] + (self.to[1] - self.from[1]) * ((u - self.from[0]) / (self.to[0] - self.from[0]))
    }

    fn sub_segment(&self, from: f64, to: f64) -> Option<Self> {
        (to > from).then(|| Self { from: [from, self.height_at(from)], to: [to, self.height_at(to)] })
    }
}

/// What is seen of the pieces from above, from left to right and beside each other.
pub(super) fn find_upper_envelope(pieces: &[SectionSegment]) -> Vec<SectionSegment> {
    match pieces {
        [] | [_] => pieces.to_vec(),
        _ => {
            let (left, right) = pieces.split_at(pieces.len() / 2);
            merge_upper(&find_upper_envelope(left), &find_upper_envelope(right))
        }
    }
}

/// The upper of two envelopes.
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
        // Stops lie between neighbours' ends, so a piece that has begun goes on to the next stop.
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

/// The upper of two pieces between two places.
fn push_higher(a: &SectionSegment, b: &SectionSegment, from: f64, to: f64, merged: &mut Vec<SectionSegment>) {
    let [start, end] = [from, to].map(|u| a.height_at(u) - b.height_at(u));
    if start >= 0.0 && end >= 0.0 {
        push_segment(merged, a, from, to);
    } else if start <= 0.0 && end <= 0.0 {
        push_segment(merged, b, from, to);
    } else {
        let cross = (from + (to - from) * (start / (start - end))).clamp(from, to);
        let (first, second) = if start > 0.0 { (a, b) } else { (b, a) };
        push_segment(merged, first, from, cross);
        push_segment(merged, second, cross, to);
    }
}

/// Adds a part of a piece, and joins it to the part before where that is the same line.
fn push_segment(merged: &mut Vec<SectionSegment>, piece: &SectionSegment, from: f64, to: f64) {
    let Some(part) = piece.sub_segment(from, to) else { return };
    if let Some(last) = merged.last_mut().filter(|last| last.to == part.from) {
        let whole = SectionSegment { from: last.from, to: part.to };
        // What was cut only at the other envelope's stops; the sum of joined roundings stays far below any use.
        if (whole.height_at(part.from[0]) - part.from[1]).abs() <= 1e-12 {
            *last = whole;
            return;
        }
    }
    merged.push(part);
}

/// Pieces as chains, parted where nothing is between them; a step is two points over each other.
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
