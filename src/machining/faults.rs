//! What goes wrong in a run, as findings: a few of each kind with their places, the rest as a number.

use super::tooling::place;
use crate::diagnostic::{Code, Diagnostic, codes};
use crate::program::Program;
use crate::program::motion::Motion;
use crate::sim::{CollarKind, Cutter, Engagement};
use std::collections::BTreeMap;

/// Findings of one kind that are told one by one.
const TOLD: usize = 10;

/// Collects faults.
#[derive(Debug, Default)]
pub(super) struct Faults {
    told: Vec<Diagnostic>,
    counts: BTreeMap<&'static str, (usize, Code)>,
}

impl Faults {
    /// Looks at what a motion engaged. `cell` is the distance of columns, mm.
    pub fn look(
        &mut self,
        program: &Program,
        motion: &Motion,
        found: &Engagement,
        cutter: &Cutter,
        cell: f64,
    ) {
        let statement = motion.last_statement();
        let mut tell = |code: Code, message: String, label: &str| {
            let (count, _) = self.counts.entry(code.id()).or_insert((0, code));
            *count += 1;
            if *count <= TOLD {
                let found = Diagnostic::new(code, message);
                self.told.push(found.label(program.source(), place(program, statement), label));
            }
        };
        if let Some((index, depth)) = found.contact {
            let what = match cutter.collars.get(index).map(|collar| collar.kind) {
                Some(CollarKind::Holder) => "holder",
                _ => "shank",
            };
            tell(
                codes::COLLISION,
                format!("the {what} stands {depth:.2} mm deep in material"),
                "on this motion",
            );
        }
        // A speck below a cell's cube is what rounding leaves where a rapid grazes the stock.
        if !found.cuts() || found.removed_mm3 < cell.powi(3) {
            return;
        }
        if motion.rapid {
            let message =
                format!("a rapid goes through material and takes {:.3} mm3 of it", found.removed_mm3);
            tell(codes::RAPID_THROUGH_STOCK, message, "at rapid");
        } else if motion.spindle.as_deref().is_none_or(|spindle| !spindle.on) {
            tell(codes::SPINDLE_STANDS, "the tool cuts while the spindle stands".to_owned(), "cuts");
        }
    }

    /// All findings.
    pub fn end(mut self, program: &Program) -> Vec<Diagnostic> {
        for (count, code) in self.counts.values().filter(|(count, _)| *count > TOLD) {
            let message = format!("{} more motions have this: {}", count - TOLD, code.meaning());
            let first =
                self.told.iter().find(|found| found.code == *code).and_then(|found| found.labels.first());
            let span = first.map(|label| label.span).unwrap_or_default();
            self.told.push(Diagnostic::new(*code, message).label(
                program.source(),
                span,
                "the first of them",
            ));
        }
        self.told
    }
}
