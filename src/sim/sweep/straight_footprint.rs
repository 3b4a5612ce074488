//! Which columns of a row a straight piece can change.

/// The ground that a disc of some radius covers on a straight piece, seen from the start of the piece.
#[derive(Debug, Clone, Copy)]
pub(super) struct StraightFootprint {
    /// Unit direction across, zero for a piece straight along the axis.
    pub direction: [f64; 2],
    /// Horizontal length.
    pub length: f64,
    /// Radius of the disc.
    pub radius: f64,
    /// Ground before this distance along the path was cleared by the piece before; negative infinity if it was not.
    pub cleared_before: f64,
    /// Radius of the disc at the start that was cleared already, 0 for none.
    pub cleared_disc: f64,
}

impl StraightFootprint {
    /// Least and greatest y.
    pub fn y_range(&self) -> [f64; 2] {
        let end = self.direction[1] * self.length;
        [end.min(0.0) - self.radius, end.max(0.0) + self.radius]
    }

    /// At most two stretches of x in a row at `y`; an empty one has its ends in the wrong order.
    pub fn x_ranges(&self, y: f64) -> [[f64; 2]; 2] {
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

    /// The stretch of a row that the disc covers on its way: the start's and end's chords, and where the row crosses the borders
    /// between them.
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
                let x = (ux * y - side) / uy;
                if (0.0..=self.length).contains(&(x * ux + y * uy)) {
                    add(x, x);
                }
            }
        }
        (found[0] <= found[1]).then_some(found)
    }

    /// The stretches of a row in the ring around the end of the path that lies ahead of it, `width` wide.
    pub fn x_ranges_ahead(&self, y: f64, width: f64) -> [[f64; 2]; 2] {
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

    /// The stretch of a row beside the path, between two lateral distances on one side and the ends of the path.
    pub fn x_range_beside(&self, y: f64, lateral: [f64; 2]) -> [f64; 2] {
        let [ux, uy] = self.direction;
        let all = [f64::NEG_INFINITY, f64::INFINITY];
        let stretch = clip_to_half_plane(all, ux, -y * uy);
        let stretch = clip_to_half_plane(stretch, -ux, y * uy - self.length);
        let stretch = clip_to_half_plane(stretch, -uy, lateral[0] - y * ux);
        clip_to_half_plane(stretch, uy, y * ux - lateral[1])
    }
}

/// The part of a stretch where `slope * x >= least`.
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
