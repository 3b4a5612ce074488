//! The step: find passes, compensate, write, measure what was written.

use super::compensation_job::CompensateZJob;
use super::parameters::{CompensateZ, CompensationReference};
use super::vertical_passes::is_cutting;
use super::{by_mesh, by_normals, by_profile};
use crate::diagnostic::Failure;
use crate::parameters::FilePath;
use crate::program::Program;
use crate::program::motion::Motion;
use crate::transform::{MotionSelection, StepContext, Transform};

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
        selection.report_if_empty(context);
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
