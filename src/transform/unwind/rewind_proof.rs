//! This module proves by the stock that rewinds are made in the air.

use crate::diagnostic::Failure;
use crate::program::{LengthUnit, Program, StatementChange, StatementId};
use crate::simulation_run::{Machining, SimulationRunOptions};
use crate::transform::StepContext;

/// What a way through the air met.
struct MetMaterial {
    statement: StatementId,
    removed_mm3: f64,
    /// How deep shank or holder are in it, mm.
    depth_mm: Option<f64>,
}

/// Simulates a program, and fails if a motion that the step put in meets anything.
pub(super) fn prove_rewinds(
    program: &Program,
    file: LengthUnit,
    context: &mut StepContext<'_>,
) -> Result<(), Failure> {
    let mut notes = Vec::new();
    let machining = Machining::new(program, context.setup, file, &mut notes)
        .map_err(|failure| failure.map_findings(|found| label_if_nowhere(found, context)))?;
    let options = SimulationRunOptions::default().within_limits(context.watch);
    let mut met: Option<MetMaterial> = None;
    let step = context.step;
    let run = machining.simulate_program(&options, context.watch, &mut |engaged| {
        let statement = engaged.motion.last_statement();
        let is_own = program.statement(statement).change() == StatementChange::Inserted(step);
        let Some(whole) = engaged.whole_engagement().filter(|_| is_own) else { return };
        let is_worse = whole.removed_mm3 > met.as_ref().map_or(0.0, |met| met.removed_mm3);
        if is_worse || (whole.contact.is_some() && met.is_none()) {
            let depth_mm = whole.contact.map(|(_, depth)| depth);
            met = Some(MetMaterial { statement, removed_mm3: whole.removed_mm3, depth_mm });
        }
    })?;
    // What rounding takes off is no more than the size of a column.
    let speck = run.cell_mm.powi(3);
    match met.filter(|met| met.removed_mm3 > speck || met.depth_mm.is_some()) {
        None => Ok(()),
        Some(met) => {
            let what = match met.depth_mm {
                Some(depth) => format!("shank or holder would be {depth:.3} mm in the material"),
                None => format!("the tool would remove {:.3} mm3", met.removed_mm3),
            };
            let message = format!(
                "on its way back in the air {what}; give more `retract`, or let the axis go back elsewhere"
            );
            Err(context.statement_failure(message, program, met.statement, "on the way put in here"))
        }
    }
}

fn label_if_nowhere(
    found: crate::diagnostic::Diagnostic,
    context: &StepContext<'_>,
) -> crate::diagnostic::Diagnostic {
    if found.labels.is_empty() { context.label_step(found, "rewinds are proved by the stock") } else { found }
}
