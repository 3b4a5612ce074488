//! This module holds where on its way a piece of path removes how much.
//!
//! A piece that is longer than half of the window over which the largest removal rate is a mean is divided into
//! equal parts. What a column loses counts in the parts in which the cutter's surface takes it; the sweeps compute
//! when that is. A shorter piece is one part, which costs nothing.

/// The window is so many cells long, and no shorter than [`SHORTEST_MM`].
const CELLS: f64 = 8.0;

/// The shortest window, mm.
const SHORTEST_MM: f64 = 0.5;

/// More parts than this make no better peak of a long piece.
const MOST_PARTS: f64 = 65_536.0;

/// Returns the length of path over which the largest removal rate is a mean, for columns that are `cell_mm` apart,
/// mm. Eight columns are as few as keep the raster's share in it at some per cent.
pub(crate) fn removal_window_mm(cell_mm: f64) -> f64 {
    (CELLS * cell_mm).max(SHORTEST_MM)
}

/// The volumes that are removed on equal parts of a piece, in its order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RemovalProfile {
    /// The volume on each part, mm3; empty if nothing is removed, or if the piece is one part.
    volumes: Vec<f32>,
    /// The number of parts.
    count: usize,
    /// The volume that stood in the cutter before it moved, mm3. It is removed nowhere on the way.
    at_start: f32,
}

impl RemovalProfile {
    /// Makes a profile of a piece in which nothing is removed, with parts that are no longer than half a window.
    /// Without a window the piece is one part.
    pub(super) fn empty_for_piece(length_mm: f64, window_mm: Option<f64>) -> Self {
        let parts = window_mm.map_or(1.0, |window| (length_mm / (window / 2.0) - 1e-6).ceil());
        Self { volumes: Vec::new(), count: parts.clamp(1.0, MOST_PARTS) as usize, at_start: 0.0 }
    }

    /// Returns whether the piece has parts to tell apart.
    #[inline]
    pub(super) fn is_divided(&self) -> bool {
        self.count > 1
    }

    /// Adds a volume that stood in the cutter before it moved.
    pub(super) fn add_at_start(&mut self, volume: f32) {
        self.at_start += volume;
    }

    /// Adds a volume that is removed evenly between two positions, as fractions of the piece. Beyond an end of the
    /// piece it counts at that end.
    #[inline]
    pub(super) fn add_volume(&mut self, volume: f32, between: [f64; 2]) {
        if self.volumes.is_empty() {
            self.volumes.resize(self.count, 0.0);
        }
        let count = self.count as f64;
        let last = self.count - 1;
        let [from, to] = between.map(|at| at.clamp(0.0, 1.0) * count);
        let [first, end] = [from, to].map(|at| (at as usize).min(last));
        if first >= end {
            if let Some(only) = self.volumes.get_mut(first) {
                *only += volume;
            }
            return;
        }
        let density = f64::from(volume) / (to - from);
        for (index, part) in self.volumes.iter_mut().enumerate().take(end + 1).skip(first) {
            let share = to.min((index + 1) as f64) - from.max(index as f64);
            *part += (density * share) as f32;
        }
    }

    /// Adds the profile of the same piece in other columns, whose volumes count `factor` times.
    pub(super) fn merge_columns(&mut self, other: &Self, factor: f64) {
        self.at_start += other.at_start * factor as f32;
        if other.volumes.is_empty() {
            return;
        }
        if self.volumes.is_empty() {
            self.count = other.count;
            self.volumes.resize(self.count, 0.0);
        }
        debug_assert_eq!(self.count, other.count, "both are of one piece");
        for (mine, more) in self.volumes.iter_mut().zip(&other.volumes) {
            *mine += *more * factor as f32;
        }
    }

    /// Returns the volumes of the parts in mm3; none if nothing is removed, or if the piece is one part.
    pub fn volumes_mm3(&self) -> &[f32] {
        &self.volumes
    }

    /// Returns the volume that stood in the cutter before it moved, mm3.
    pub fn at_start_mm3(&self) -> f64 {
        f64::from(self.at_start)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_volume_is_where_it_was_removed() {
        let mut profile = RemovalProfile::empty_for_piece(10.0, Some(2.0));
        assert!(profile.volumes_mm3().is_empty() && profile.is_divided());
        profile.add_volume(1.0, [0.25, 0.25]);
        profile.add_volume(1.0, [0.45, 0.55]);
        assert_eq!(profile.volumes_mm3()[2..6], [1.0, 0.0, 0.5, 0.5]);
        // Over all of the way, each part gets its share; nothing is lost beyond the ends.
        let mut even = RemovalProfile::empty_for_piece(10.0, Some(2.0));
        even.add_volume(10.0, [0.0, 1.0]);
        assert!(even.volumes_mm3().iter().all(|volume| (volume - 1.0).abs() < 1e-6), "{even:?}");
        even.add_volume(1.0, [-3.0, -2.0]);
        even.add_volume(1.0, [1.0, 1.2]);
        assert!((even.volumes_mm3().iter().sum::<f32>() - 12.0).abs() < 1e-5);
    }

    #[test]
    fn a_short_piece_is_one_part() {
        assert!(!RemovalProfile::empty_for_piece(0.5, Some(1.0)).is_divided());
        assert!(RemovalProfile::empty_for_piece(0.51, Some(1.0)).is_divided());
        assert!(!RemovalProfile::empty_for_piece(500.0, None).is_divided());
        assert_eq!(removal_window_mm(0.25), 2.0);
    }
}
