//! What goes wrong in a run, as findings: a few of each kind with their places, the rest as a number.

use super::tooling::statement_span;
use crate::diagnostic::{Diagnostic, DiagnosticCode, codes};
use crate::program::Program;
use crate::program::motion::Motion;
use crate::sim::{CutterModel, Engagement, NonCuttingKind};
use std::collections::BTreeMap;

/// Findings of one kind that are told one by one.
const TOLD: usize = 10;

/// Collects faults.
#[derive(Debug, Default)]
pub(super) struct FaultCollector {
    told: Vec<Diagnostic>,
    counts: BTreeMap<&'static str, (usize, DiagnosticCode)>,
}

impl FaultCollector {
    /// Looks at what a motion engaged. `cell` is the distance of columns, mm.
    pub fn check_engagement(
        &mut self,
        program: &Program,
        motion: &Motion,
        found: &Engagement,
        cutter: &CutterModel,
        cell: f64,
    ) {
        if let Some((index, depth)) = found.contact {
            let what = match cutter.collars.get(index).map(|collar| collar.kind) {
                Some(NonCuttingKind::Holder) => "holder",
                _ => "shank",
            };
            let message = format!("the {what} stands {depth:.2} mm deep in material");
            self.add_finding(program, motion, codes::COLLISION, message, "on this motion");
        }
        // A speck below a cell's cube is what rounding leaves where a rapid grazes the stock.
        if found.has_removed_material() && found.removed_mm3 >= cell.powi(3) {
            self.check_removal(program, motion, found.removed_mm3);
        }
    }

    /// Looks at a motion that removed so much, in mm3: no rapid should, and no tool that does not turn.
    pub fn check_removal(&mut self, program: &Program, motion: &Motion, mm3: f64) {
        if motion.rapid {
            let message = format!("a rapid goes through material and takes {mm3:.3} mm3 of it");
            self.add_finding(program, motion, codes::RAPID_THROUGH_STOCK, message, "at rapid");
        } else if motion.spindle.as_deref().is_none_or(|spindle| !spindle.on) {
            let message = "the tool cuts while the spindle stands".to_owned();
            self.add_finding(program, motion, codes::SPINDLE_STANDS, message, "cuts");
        }
    }

    /// Tells of a motion, or counts it once enough of its kind were told.
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

    /// All findings.
    pub fn collect_findings(mut self, program: &Program) -> Vec<Diagnostic> {
        for (count, code) in self.counts.values().filter(|(count, _)| *count > TOLD) {
            let message = format!("{} more motions have this: {}", count - TOLD, code.meaning());
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
