//! This module holds what is known about the inserts of a tool: their own measures, or what a catalogue says of the
//! cutter.

use crate::cutter::DeadMiddle;

/// The inserts of an indexable cutter, as the setup says them. Lengths are in mm, angles in radians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InsertData {
    /// What says how wide the middle is that does not cut.
    pub width: InsertWidth,
    /// What says how high material may stand there.
    pub clearance: InsertClearance,
}

/// What says how wide the middle of a cutter is that does not cut.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum InsertWidth {
    /// The radius r of an insert's bottom circle: the middle is D - 2r wide.
    RadiusMm(f64),
    /// The least bore that the cutter mills by helical interpolation. Its helix is as wide as the middle, so the middle is
    /// that bore less D wide.
    LeastBoreMm(f64),
}

/// What says how high material may stand in the middle of a cutter.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum InsertClearance {
    /// The cutting height h of an insert, which is also the largest depth of a plunge.
    HeightMm(f64),
    /// The largest ramp angle: over the width of the middle it descends by h.
    RampAngleRad(f64),
}

/// The inserts of an indexable cutter, which limit its ramps: the cutter does not cut within the diameter
/// `diameter - 2 radius`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutterInsert {
    /// The cutting height of an insert in mm.
    pub height_mm: f64,
    /// The radius of the insert's bottom circle in mm.
    pub radius_mm: f64,
}

impl InsertData {
    /// Returns the measures of the inserts on a cutter of a diameter in mm.
    ///
    /// ```
    /// use clsmith::setup::{InsertClearance, InsertData, InsertWidth};
    ///
    /// // A catalogue: 50 mm, bores from 88 mm on, ramps up to 6 degrees.
    /// let told = InsertData {
    ///     width: InsertWidth::LeastBoreMm(88.0),
    ///     clearance: InsertClearance::RampAngleRad(6f64.to_radians()),
    /// };
    /// let insert = told.of_cutter(50.0);
    /// assert!((insert.radius_mm - 6.0).abs() < 1e-12);
    /// assert!((insert.height_mm - 38.0 * 6f64.to_radians().tan()).abs() < 1e-12);
    /// ```
    pub fn of_cutter(&self, diameter_mm: f64) -> CutterInsert {
        let radius_mm = match self.width {
            InsertWidth::RadiusMm(radius) => radius,
            InsertWidth::LeastBoreMm(bore) => (2.0 * diameter_mm - bore) / 2.0,
        };
        let height_mm = match self.clearance {
            InsertClearance::HeightMm(height) => height,
            InsertClearance::RampAngleRad(angle) => (diameter_mm - 2.0 * radius_mm).max(0.0) * angle.tan(),
        };
        CutterInsert { height_mm, radius_mm }
    }

    /// Returns the middle of a cutter of a diameter in mm.
    pub(super) fn dead_middle_of(&self, diameter_mm: f64) -> DeadMiddle {
        let insert = self.of_cutter(diameter_mm);
        DeadMiddle { radius_mm: diameter_mm / 2.0 - insert.radius_mm, clearance_mm: insert.height_mm }
    }
}
