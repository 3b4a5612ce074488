//! This module collects the faults of a run as findings. The first ones of each kind have their places; the
//! others are counted.

use super::tooling::statement_span;
use crate::cutter::{CutterModel, NonCuttingKind};
use crate::diagnostic::{Diagnostic, DiagnosticCode, codes};
use crate::engagement::Engagement;
use crate::program::Program;
use crate::program::motion::Motion;
use std::collections::BTreeMap;

/// The number of findings of one kind that are reported one by one.
const TOLD: usize = 10;

/// Collects the faults of a run.
#[derive(Debug, Default)]
pub(super) struct FaultCollector {
    told: Vec<Diagnostic>,
    counts: BTreeMap<&'static str, (usize, DiagnosticCode)>,
}

impl FaultCollector {
    /// Checks the engagement of a motion. `cell_mm` is the distance of columns, mm.
    pub fn check_engagement(
        &mut self,
        program: &Program,
        motion: &Motion,
        found: &Engagement,
        cutter: &CutterModel,
        cell_mm: f64,
    ) {
        if let Some((index, depth)) = found.contact {
            let what = match cutter.collars.get(index).map(|collar| collar.kind) {
                Some(NonCuttingKind::Holder) => "holder",
                _ => "shank",
            };
            let message = format!("the {what} stands {depth:.2} mm deep in material");
            self.add_finding(program, motion, codes::COLLISION, message, "on this motion");
        }
        // A volume below a cell's cube is rounding, where a rapid touches the stock.
        if found.has_removed_material() && found.removed_mm3 >= cell_mm.powi(3) {
            self.check_removal(program, motion, found.removed_mm3);
        }
    }

    /// Checks a motion that removed a volume in mm3. No rapid may remove material, and no tool whose spindle
    /// does not turn.
    pub fn check_removal(&mut self, program: &Program, motion: &Motion, removed_mm3: f64) {
        if motion.rapid {
            let message = format!("a rapid goes through material and takes {removed_mm3:.3} mm3 of it");
            self.add_finding(program, motion, codes::RAPID_THROUGH_STOCK, message, "at rapid");
        } else if motion.spindle.as_deref().is_none_or(|spindle| !spindle.on) {
            let message = "the tool cuts while the spindle stands".to_owned();
            self.add_finding(program, motion, codes::SPINDLE_STANDS, message, "cuts");
        }
    }

    /// Adds a finding for a motion, or counts it if there are enough of its kind.
    pub fn add_finding(
        &mut self,
        program: &Program,
        motion: &Motion,
        code: DiagnosticCode,
        message: String,
        label: &str,
    ) {
        let (count, _) = self.counts.entry(code.id()).or_insert((0, code));
        *count += 1;
        if *count <= TOLD {
            let at = statement_span(program, motion.last_statement());
            self.told.push(Diagnostic::new(code, message).with_label(program.source(), at, label));
        }
    }

    /// Returns all findings, with one more for each kind that was only counted from some number on.
    pub fn collect_findings(mut self, program: &Program) -> Vec<Diagnostic> {
        for (count, code) in self.counts.values().filter(|(count, _)| *count > TOLD) {
            let message = format!("{} more motions have this: {}", count - TOLD, code.meaning());
            // The summary shows the place of the first finding of its kind.
            let first =
                self.told.iter().find(|found| found.code == *code).and_then(|found| found.labels.first());
            let span = first.map(|label| label.span).unwrap_or_default();
            self.told.push(Diagnostic::new(*code, message).with_label(
                program.source(),
                span,
                "the first of them",
            ));
        }
        self.told
    }
}
