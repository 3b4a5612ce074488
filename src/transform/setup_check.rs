//! What a setup knows against a program: ramps that its cutters do not survive, feeds above its machine, motions that
//! its machine cannot make, tools that it describes quite otherwise than the program.

use super::correct_ramp::check_ramps;
use super::find_feeds_above_machine;
use crate::diagnostic::{Diagnostic, codes};
use crate::machine::find_machine_findings;
use crate::program::motion::ActiveTool;
use crate::program::{LengthUnit, Program};
use crate::setup::Setup;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Finds everything that a setup knows against a program as it stands. Every command that gets a program and a setup
/// tells these findings. `unit` is the unit of the program's lengths.
pub fn check_with_setup(program: &Program, setup: &Setup, unit: LengthUnit) -> Vec<Diagnostic> {
    let mut found = check_ramps(program, setup, unit);
    found.extend(find_feeds_above_machine(program, setup, unit));
    found.extend(find_unlike_diameters(program, setup, unit));
    if let Some(search) = setup.machine.fault_search() {
        found.extend(find_machine_findings(program, &search, unit));
    }
    found
}

/// Finds what a setup knows against a corrected program and its steps have not told. A ramp that a step has judged is
/// not judged again.
pub(crate) fn check_result_with_setup(
    program: &Program,
    setup: &Setup,
    unit: LengthUnit,
    told: &[Diagnostic],
) -> Vec<Diagnostic> {
    let ramp_start = |found: &Diagnostic| {
        let is_ramp =
            [codes::RAMP_OUT_OF_LIMITS, codes::RAMP_KEPT, codes::RAMP_IMPOSSIBLE].contains(&found.code);
        found.labels.first().filter(|_| is_ramp).map(|label| label.span.start)
    };
    let judged: BTreeSet<u32> = told.iter().filter_map(ramp_start).collect();
    let mut found = check_with_setup(program, setup, unit);
    found.retain(|finding| ramp_start(finding).is_none_or(|start| !judged.contains(&start)));
    found
}

/// Finds tools to which the setup gives a diameter that is far from the program's, one finding for each.
fn find_unlike_diameters(program: &Program, setup: &Setup, unit: LengthUnit) -> Vec<Diagnostic> {
    if setup.tools.iter().all(|entry| entry.diameter_mm.is_none()) {
        return Vec::new();
    }
    let mut found = Vec::new();
    let mut judged = BTreeSet::new();
    let mut last: Option<Arc<ActiveTool>> = None;
    for motion in program.motions() {
        let Some(tool) = motion.tool.as_ref() else { continue };
        // A tool mostly stays for many motions.
        if last.as_ref().is_some_and(|last| Arc::ptr_eq(last, tool)) {
            continue;
        }
        let span = program.statement(motion.last_statement()).origin();
        let unlike = setup.report_unlike_diameter(tool, unit, program.source(), span);
        found.extend(unlike.filter(|finding| judged.insert(finding.message.clone())));
        last = Some(Arc::clone(tool));
    }
    found
}
