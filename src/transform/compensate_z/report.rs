//! What `compensate_z` did, in numbers.

use serde::Serialize;

/// What the step did.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// What the cutter was compensated against: `profile`, `normals` or `mesh`.
    pub against: &'static str,
    /// Radius of the ball, mm; of another cutter half its diameter.
    pub radius_mm: f64,
    /// Corner radius of the cutter, mm: the same for a ball.
    pub corner_radius_mm: f64,
    /// Allowed gouge and gap, mm.
    pub tolerance_mm: f64,
    /// The passes, in the order of the program.
    pub passes: Vec<PassReport>,
    /// Passes that were left as they are, for they lie beside the model.
    pub beside: usize,
}

/// One pass; with normals, one operation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PassReport {
    /// Name of its operation; may be empty.
    pub operation: String,
    /// Line of its first statement.
    pub line: u64,
    /// Motions before.
    pub motions_before: usize,
    /// Motions after.
    pub motions_after: usize,
    /// Deepest gouge, measured in what was written, mm.
    pub gouge_mm: f64,
    /// Largest gap, mm; `None` where it is not measured (normals).
    pub gap_mm: Option<f64>,
    /// What the ball cannot reach: the most that is left, mm.
    pub left_mm: f64,
    /// The part's profile in the plane of the pass.
    #[serde(skip)]
    pub profile: Vec<(f64, f64)>,
    /// The path as it was written, in the plane of the pass.
    #[serde(skip)]
    pub path: Vec<(f64, f64)>,
    /// What moving each point by its own normal would have made of it.
    #[serde(skip)]
    pub naive: Vec<(f64, f64)>,
}
