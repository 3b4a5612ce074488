//! The area that the cutter covers on a layer between two places.

/// What a cutter covers on one layer between two places. Closed borders of x, y in mm; none repeats its first point.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Cover {
    /// The section at the first place: convex, counter-clockwise; empty where the cutter does not reach the layer.
    pub first: Vec<[f64; 2]>,
    /// The section at the last place, likewise.
    pub last: Vec<[f64; 2]>,
    /// Borders of everything that the edge enters on its way; an area is covered where they wind around it at all (their
    /// winding numbers are nowhere negative). Parts of `first` may be covered again.
    pub advancing: Vec<Vec<[f64; 2]>>,
}
