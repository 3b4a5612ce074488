//! This module holds the figures of what `compensate_z` did.

use crate::program::motion::Motion;
use crate::program::{Program, operation};
use serde::Serialize;
use std::ops::Range;

/// The figures of one run of the step.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CompensateZReport {
    /// What the cutter was compensated against: `profile`, `normals` or `mesh`.
    pub against: &'static str,
    /// The radius of the ball, in mm. For another cutter it is half of the diameter.
    pub radius_mm: f64,
    /// The corner radius of the cutter, in mm. For a ball it equals the radius.
    pub corner_radius_mm: f64,
    /// The allowed gouge and gap, in mm.
    pub tolerance_mm: f64,
    /// The passes, in the order of the program.
    pub passes: Vec<PassReport>,
    /// The number of passes that were left unchanged, because they lie beside the model.
    pub beside: usize,
}

impl CompensateZReport {
    /// Makes a report without passes.
    pub(super) fn new(
        against: &'static str,
        (radius_mm, corner_radius_mm): (f64, f64),
        tolerance_mm: f64,
    ) -> Self {
        Self { against, radius_mm, corner_radius_mm, tolerance_mm, passes: Vec::new(), beside: 0 }
    }
}

/// The figures of one pass, or of one operation when compensating by normals.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[non_exhaustive]
pub struct PassReport {
    /// The name of its operation, which may be empty.
    pub operation: String,
    /// The line of its first statement.
    pub line: u64,
    /// The number of motions before the step.
    pub motions_before: usize,
    /// The number of motions after the step.
    pub motions_after: usize,
    /// The deepest gouge in mm, measured in what was written.
    pub gouge_mm: f64,
    /// The largest gap in mm. It is `None` where it is not measured (normals).
    pub gap_mm: Option<f64>,
    /// The largest thickness of material that the ball leaves because it cannot reach it, in mm.
    pub left_mm: f64,
    /// The profile of the part in the plane of the pass.
    #[serde(skip)]
    pub profile: Vec<(f64, f64)>,
    /// The path as it was written, in the plane of the pass.
    #[serde(skip)]
    pub path: Vec<(f64, f64)>,
    /// The path that moving each point along its own normal would give.
    #[serde(skip)]
    pub naive: Vec<(f64, f64)>,
}

/// Names the operations of a program in the reports of its passes.
pub(super) struct PassReporter<'a> {
    program: &'a Program,
    motions: &'a [Motion],
    operations: Vec<String>,
}

impl<'a> PassReporter<'a> {
    pub(super) fn new(program: &'a Program, motions: &'a [Motion]) -> Self {
        let operations =
            operation::find_operations(program).into_iter().map(|operation| operation.name).collect();
        Self { program, motions, operations }
    }

    /// Makes the report of a pass, before anything is measured.
    pub(super) fn start_report(&self, motions: &Range<usize>, after: usize) -> PassReport {
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
