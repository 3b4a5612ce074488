//! This module holds the middle of a cutter with inserts, which does not cut.

use super::meridian::Meridian;

/// The middle of an indexable cutter: a recess in its bottom, between the inserts. Nothing cuts there, and material that
/// stands higher than the recess is run into.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DeadMiddle {
    /// The radius of the recess, D/2 - r for a cutter of the diameter D whose inserts have a bottom circle of the
    /// radius r, mm.
    pub radius_mm: f64,
    /// How far the body lies above the bottom of the inserts there: the cutting height h of an insert, mm.
    pub clearance_mm: f64,
}

impl Meridian {
    /// Returns the cutter with a middle that does not cut. It cuts everywhere if the recess has no width.
    ///
    /// ```
    /// use clsmith::cutter::{DeadMiddle, Meridian};
    ///
    /// // A face mill of 50 mm with round inserts of 6 mm that cut 4 mm high.
    /// let middle = DeadMiddle { radius_mm: 19.0, clearance_mm: 4.0 };
    /// let face_mill = Meridian::new(50.0, 6.0, 0.0, 0.0, 40.0)?.with_dead_middle(middle);
    /// assert_eq!(face_mill.dead_middle(), Some(middle));
    /// # Ok::<(), clsmith::cutter::MeridianError>(())
    /// ```
    #[must_use]
    pub fn with_dead_middle(mut self, middle: DeadMiddle) -> Self {
        let has_width = middle.radius_mm > 1e-9 && middle.radius_mm < self.radius_mm();
        self.dead_middle = has_width.then_some(middle);
        self
    }

    /// Returns the middle that does not cut; `None` for a cutter that cuts up to its axis.
    pub fn dead_middle(&self) -> Option<DeadMiddle> {
        self.dead_middle
    }
}
