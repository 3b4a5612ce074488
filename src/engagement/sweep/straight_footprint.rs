//! This module finds the columns of a row that a straight piece can change.

/// The ground that a disc covers on a straight piece, in coordinates from the start of the piece, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct StraightFootprint {
    /// The horizontal unit direction; zero for a piece straight along the axis.
    pub direction: [f64; 2],
    /// The horizontal length.
    pub length: f64,
    /// The radius of the disc.
    pub radius: f64,
    /// The distance along the path before which the piece before has cleared the ground; negative infinity if
    /// it has not.
    pub cleared_before: f64,
    /// The radius of the disc around the start that is already cleared; 0 if there is none.
    pub cleared_disc: f64,
}

impl StraightFootprint {
    /// Returns the least and the greatest y.
    pub(super) fn y_range(&self) -> [f64; 2] {
        let end = self.direction[1] * self.length;
        [end.min(0.0) - self.radius, end.max(0.0) + self.radius]
    }

    /// Returns at most two ranges of x in the row at `y`. An empty range has its ends in the wrong order.
    pub(super) fn x_ranges(&self, y: f64) -> [[f64; 2]; 2] {
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        let Some(mut whole) = self.covered_x_range(y) else { return [none; 2] };
        let [ux, uy] = self.direction;
        if self.cleared_before > f64::NEG_INFINITY {
            whole = clip_to_half_plane(whole, ux, self.cleared_before - y * uy);
        }
        let half = (self.cleared_disc * self.cleared_disc - y * y).max(0.0).sqrt();
        if self.cleared_disc > y.abs() && half > 0.0 {
            return [[whole[0], whole[1].min(-half)], [whole[0].max(half), whole[1]]];
        }
        [whole, none]
    }

    /// Returns the range of x that the disc covers on its path in the row at `y`. Its ends are ends of the
    /// chords at the start and the end of the piece, or points where the row crosses the two lines between
    /// them.
    fn covered_x_range(&self, y: f64) -> Option<[f64; 2]> {
        let [ux, uy] = self.direction;
        let mut found = [f64::INFINITY, f64::NEG_INFINITY];
        let mut add = |a: f64, b: f64| found = [found[0].min(a), found[1].max(b)];
        for at in [0.0, self.length] {
            let (cx, dy) = (ux * at, y - uy * at);
            if dy.abs() <= self.radius {
                let half = (self.radius * self.radius - dy * dy).sqrt();
                add(cx - half, cx + half);
            }
        }
        if uy != 0.0 {
            for side in [-self.radius, self.radius] {
                // The side lines are at lateral distance +-R from the path: y ux - x uy = side, solved for x.
                let x = (ux * y - side) / uy;
                if (0.0..=self.length).contains(&(x * ux + y * uy)) {
                    add(x, x);
                }
            }
        }
        (found[0] <= found[1]).then_some(found)
    }

    /// Returns the ranges of x in a ring around the end of the path, `width` wide, of which only the part
    /// ahead of the end counts.
    pub(super) fn x_ranges_ahead(&self, y: f64, width: f64) -> [[f64; 2]; 2] {
        let [ux, uy] = self.direction;
        let (x, dy) = (ux * self.length, y - uy * self.length);
        let half = |radius: f64| (radius * radius - dy * dy).max(0.0).sqrt();
        let (outer, inner) = (half(self.radius + width), half(self.radius));
        if outer <= 0.0 {
            return [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        }
        let ahead = |stretch| clip_to_half_plane(stretch, ux, self.length - y * uy);
        [ahead([x - outer, x - inner]), ahead([x + inner, x + outer])]
    }

    /// Returns the range of x beside the path, between two lateral distances and between the ends of the
    /// path.
    pub(super) fn x_range_beside(&self, y: f64, lateral: [f64; 2]) -> [f64; 2] {
        let [ux, uy] = self.direction;
        let all = [f64::NEG_INFINITY, f64::INFINITY];
        let stretch = clip_to_half_plane(all, ux, -y * uy);
        let stretch = clip_to_half_plane(stretch, -ux, y * uy - self.length);
        let stretch = clip_to_half_plane(stretch, -uy, lateral[0] - y * ux);
        clip_to_half_plane(stretch, uy, y * ux - lateral[1])
    }
}

/// Returns the part of a range where `slope * x >= least`.
fn clip_to_half_plane([from, to]: [f64; 2], slope: f64, least: f64) -> [f64; 2] {
    if slope > 1e-12 {
        [from.max(least / slope), to]
    } else if slope < -1e-12 {
        [from, to.min(least / slope)]
    } else if least <= 1e-9 {
        [from, to]
    } else {
        [f64::INFINITY, f64::NEG_INFINITY]
    }
}
