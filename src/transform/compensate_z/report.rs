//! What `compensate_z` did, in numbers.

use crate::program::motion::Motion;
use crate::program::{Program, operation};
use serde::Serialize;
use std::ops::Range;

/// What the step did.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CompensateZReport {
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

impl CompensateZReport {
    /// A report without passes yet.
    pub(super) fn new(
        against: &'static str,
        (radius_mm, corner_radius_mm): (f64, f64),
        tolerance_mm: f64,
    ) -> Self {
        Self { against, radius_mm, corner_radius_mm, tolerance_mm, passes: Vec::new(), beside: 0 }
    }
}

/// One pass; with normals, one operation.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[non_exhaustive]
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

/// Names the operations of a program for the reports of its passes.
pub(super) struct PassReporter<'a> {
    program: &'a Program,
    motions: &'a [Motion],
    operations: Vec<String>,
}

impl<'a> PassReporter<'a> {
    pub fn new(program: &'a Program, motions: &'a [Motion]) -> Self {
        let operations =
            operation::find_operations(program).into_iter().map(|operation| operation.name).collect();
        Self { program, motions, operations }
    }

    /// The report of a pass before anything was measured.
    pub fn start_report(&self, motions: &Range<usize>, after: usize) -> PassReport {
        let first = self.motions.get(motions.start);
        debug_assert!(first.is_some(), "a pass has motions");
        let line = |motion: &Motion| {
            let origin = self.program.statement(motion.statements.first()).origin();
            self.program.source().line_column(origin.start).0 as u64
        };
        PassReport {
            operation: first
                .and_then(|motion| self.operations.get(motion.operation))
                .cloned()
                .unwrap_or_default(),
            line: first.map_or(0, line),
            motions_before: motions.len(),
            motions_after: after,
            ..PassReport::default()
        }
    }
}
