//! This module runs the step: it finds passes, compensates them, writes them and measures what was written.

use super::compensation_job::CompensateZJob;
use super::parameters::{CompensateZ, CompensationReference};
use super::vertical_passes::is_cutting;
use super::{by_mesh, by_normals, by_profile};
use crate::diagnostic::Failure;
use crate::parameters::FilePath;
use crate::program::Program;
use crate::program::motion::Motion;
use crate::transform::{MotionSelection, StepContext, Transform};

/// This pass stands on the part itself; the step lifts a ball of 10 mm onto it.
///
/// ```
/// use clsmith::parameters::Positive;
/// use clsmith::parse::parse;
/// use clsmith::program::LengthUnit;
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
/// use clsmith::transform::compensate_z::CompensateZReport;
/// use clsmith::transform::{CompensateZ, run_steps};
///
/// // A pass along a slope that goes on level, programmed on the part itself.
/// let part = b"TOOL PATH/FINISH,TOOL,B10\nRAPID\nGOTO/0.0000,0.0000,30.0000\n\
///     FEDRAT/MMPM,500.0000\nPAINT/COLOR,31\nGOTO/0.0000,0.0000,10.0000\n\
///     GOTO/10.0000,0.0000,0.0000\nGOTO/30.0000,0.0000,0.0000\nEND-OF-PATH\n";
/// let program = parse(&Source::new("part.cls", part.to_vec())?, None).program;
/// let step = CompensateZ { radius: Positive::new(5.0), ..CompensateZ::default() };
/// let outcome = run_steps(&[&step], LengthUnit::Mm, &Setup::default(), program)?;
/// let report = outcome.reports[0].downcast_ref::<CompensateZReport>().expect("the step reports its passes");
/// assert!(report.passes.iter().all(|pass| pass.gouge_mm < 0.005));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl Transform for CompensateZ {
    fn measures(&self) -> bool {
        true
    }

    fn reads(&self) -> Vec<&FilePath> {
        match &self.against {
            CompensationReference::Mesh(path) => vec![path],
            CompensationReference::Profile | CompensationReference::Normals => Vec::new(),
        }
    }

    fn apply(&self, program: Program, context: &mut StepContext<'_>) -> Result<Program, Failure> {
        let file = context.file_length_unit(&program);
        let motions: Vec<Motion> = program.motions().collect();
        let mut selection = MotionSelection::new(&self.r#where, &program, context);
        let meant: Vec<bool> =
            motions.iter().map(|motion| selection.contains(motion, context) && is_cutting(motion)).collect();
        selection.report_if_empty(&program, context);
        let Some(first) = meant.iter().position(|meant| *meant) else { return Ok(program) };
        let mut job = CompensateZJob::new(self, file, context)?;
        job.take_tool_cutter(&program, &motions, &meant, first, context)?;
        let (program, report) = match &self.against {
            CompensationReference::Profile => {
                by_profile::compensate_by_profile(&job, program, &motions, &meant, context)?
            }
            CompensationReference::Normals => {
                by_normals::compensate_by_normals(&job, program, &motions, &meant, context)?
            }
            CompensationReference::Mesh(path) => {
                by_mesh::compensate_by_mesh(&job, path, program, &motions, &meant, context)?
            }
        };
        context.add_report(report);
        Ok(program)
    }
}
