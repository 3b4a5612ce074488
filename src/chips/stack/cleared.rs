//! Where the cutter stands, and nothing is left.

/// The cutter's section at the end of a cut: convex, counter-clockwise.
#[derive(Debug, Clone, Default)]
pub(super) struct Cleared {
    border: Vec<[f64; 2]>,
    /// About twice the largest distance between a chord of the border and the curve that it stands for, mm.
    slack: f64,
}

/// Sections closer than this are one, whatever their chords, mm.
const SAME: f64 = 1e-6;

impl Cleared {
    pub(super) fn set(&mut self, border: &[[f64; 2]]) {
        self.border.clear();
        self.border.extend_from_slice(border);
        // A chord of length l that turns by d stands for an arc with a rise of l d / 8; at corners chords turn by half of both arcs. Turns
        // into a long chord that is none of a curve are large at one end only.
        let slack = corners(border).fold(0.0, |most: f64, [a, b, c, d]| {
            let (before, chord, behind) = (minus(b, a), minus(c, b), minus(d, c));
            let turn = |one, other| cross(one, other) / length(one) / length(other);
            let rise = length(chord) * turn(before, chord).min(turn(chord, behind)) / 4.0;
            most.max(rise)
        });
        self.slack = SAME + slack;
    }

    /// Whether a section is this very one.
    pub(super) fn is(&self, section: &[[f64; 2]]) -> bool {
        self.border == section
    }

    /// Whether a section has the same border, but for where its corners are: each of them is next to a chord. Both being convex, it
    /// reaches no farther out than that.
    pub(super) fn is_along(&self, section: &[[f64; 2]]) -> bool {
        let Some(&first) = section.first() else { return self.border.is_empty() };
        let chords = || self.border.iter().zip(self.border.iter().skip(1).chain(self.border.first()));
        let near = |place: [f64; 2], a: [f64; 2], b: [f64; 2]| {
            let (along, to) = (minus(b, a), minus(place, a));
            let (length, on) = (length(along), dot(along, to));
            cross(along, to).abs() <= self.slack * length
                && on >= -self.slack * length
                && on <= (length + self.slack) * length
        };
        let Some(start) = chords().position(|(a, b)| near(first, *a, *b)) else { return false };
        // Corners and chords follow each other in the same order.
        let mut ahead = chords().cycle().skip(start).take(2 * self.border.len()).peekable();
        section.iter().all(|place| {
            while ahead.next_if(|(a, b)| !near(*place, **a, **b)).is_some() {}
            ahead.peek().is_some()
        })
    }
}

/// Every chord with the corners before and behind it.
fn corners(border: &[[f64; 2]]) -> impl Iterator<Item = [[f64; 2]; 4]> + '_ {
    let from = |skip: usize| border.iter().copied().cycle().skip(skip);
    let four = from(0).zip(from(1)).zip(from(2)).zip(from(3));
    four.take(border.len()).map(|(((a, b), c), d)| [a, b, c, d])
}

fn minus([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> [f64; 2] {
    [ax - bx, ay - by]
}

fn dot([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    ax * bx + ay * by
}

fn cross([ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    ax * by - ay * bx
}

fn length(of: [f64; 2]) -> f64 {
    dot(of, of).sqrt()
}
