//! The step: find passes, compensate, write, measure what was written.

use super::parameters::{Against, Arcs, CompensateZ, CutterPoint, PathPoint};
use super::passes::cuts;
use super::words::Place;
use super::{by_mesh, by_normals, by_profile};
use crate::diagnostic::Diagnostic;
use crate::program::motion::{Motion, Tool};
use crate::program::{LengthUnit, Program};
use crate::transform::{Context, Selection, StepReport, Transform};
use crate::values::Positive;
use std::sync::Arc;

/// Allowed gouge and gap where the recipe says none, mm.
const TOLERANCE: f64 = 0.005;

impl Transform for CompensateZ {
    fn apply(&self, program: Program, context: &mut Context<'_>) -> Result<Program, Box<Diagnostic>> {
        let file = context.file_units(&program);
        let motions: Vec<Motion> = program.motions().collect();
        let mut selection = Selection::new(&self.r#where, &program, context);
        let meant: Vec<bool> =
            motions.iter().map(|motion| selection.contains(motion, context) && cuts(motion)).collect();
        selection.report(context);
        let Some(first) = meant.iter().position(|meant| *meant) else { return Ok(program) };
        let mut job = Job::new(self, file, context)?;
        job.cutter_at(&program, &motions, &meant, first, context)?;
        let (program, report) = match &self.against {
            Against::Profile => by_profile::run(&job, program, &motions, &meant, context)?,
            Against::Normals => by_normals::run(&job, program, &motions, &meant, context)?,
            Against::Mesh(path) => by_mesh::run(&job, path, program, &motions, &meant, context)?,
        };
        context.reports.push(StepReport::CompensateZ(report));
        Ok(program)
    }
}

/// The parameters in millimetres.
pub(super) struct Job {
    /// Half the cutter's diameter.
    pub radius: f64,
    /// Its corner radius.
    pub corner: f64,
    /// Radius of the ball that the path was made for.
    pub was: Option<f64>,
    pub was_centre: bool,
    pub centre: bool,
    pub tolerance: f64,
    pub arcs: bool,
    pub file: LengthUnit,
    needs_ball: bool,
    told: bool,
}

impl Job {
    fn new(step: &CompensateZ, file: LengthUnit, context: &Context<'_>) -> Result<Self, Box<Diagnostic>> {
        let recipe = context.recipe.units.in_mm();
        let mm = |value: Option<Positive>| value.map(|value| value.get() * recipe);
        let was = mm(step.was_radius);
        match (step.input, was) {
            (PathPoint::Contact, Some(_)) => {
                let message =
                    "`was_radius` belongs to a path made for a ball: `input: tip` or `input: centre`";
                return Err(context.fail(message, &["was_radius"]));
            }
            (PathPoint::Tip | PathPoint::Centre, None) => {
                let message = "the path was made for a ball, and `was_radius` does not say for which";
                return Err(context.fail(message, &["input"]));
            }
            _ => {}
        }
        let needs_ball = !matches!(step.against, Against::Mesh(_)) || step.output == CutterPoint::Centre;
        let radius = mm(step.radius);
        Ok(Self {
            radius: radius.unwrap_or(0.0),
            corner: radius.unwrap_or(0.0),
            was,
            was_centre: step.input == PathPoint::Centre,
            centre: step.output == CutterPoint::Centre,
            tolerance: mm(step.tolerance).unwrap_or(TOLERANCE),
            arcs: step.arcs == Arcs::Keep,
            file,
            needs_ball,
            told: radius.is_some(),
        })
    }

    /// How much higher what lies around passes goes, mm: tips that become centres rise by the radius.
    pub fn lift(&self) -> f64 {
        let was = if self.was_centre { self.was.unwrap_or(0.0) } else { 0.0 };
        if self.centre { (self.radius - was).max(0.0) } else { 0.0 }
    }

    /// Takes the cutter from the tool of the motions, which must be one, unless the step says the radius.
    fn cutter_at(
        &mut self,
        program: &Program,
        motions: &[Motion],
        meant: &[bool],
        first: usize,
        context: &Context<'_>,
    ) -> Result<(), Box<Diagnostic>> {
        if self.told {
            return Ok(());
        }
        let place = Place { program, motions };
        let tool = motions.get(first).and_then(|motion| motion.tool.clone());
        let other =
            motions.iter().zip(meant).position(|(motion, meant)| *meant && !same(&motion.tool, &tool));
        if let Some(other) = other {
            let message = "the step means passes of several tools; say `radius`, or name one tool by `where`";
            return Err(place.fail(message.to_owned(), other, "another tool", context));
        }
        let none = Tool::default();
        let used = tool.as_deref().unwrap_or(&none);
        let entry = context.setup.tool_entry(used);
        let data = used.data.as_ref();
        let scale = self.file.in_mm();
        let told =
            |of_setup: Option<f64>, of_file: Option<f64>| of_setup.or(of_file.map(|value| value * scale));
        let diameter = told(entry.and_then(|entry| entry.diameter), data.and_then(|data| data.diameter));
        let corner =
            told(entry.and_then(|entry| entry.corner_radius), data.and_then(|data| data.corner_radius));
        let called = used.called();
        let Some(diameter) = diameter.filter(|diameter| *diameter > 0.0) else {
            let message = format!(
                "the radius is not known: neither the step nor the setup nor the CL file says that of {called}"
            );
            return Err(place.fail(message, first, "its first cut", context));
        };
        let (radius, corner) = (diameter / 2.0, corner.unwrap_or(0.0));
        // Files print four decimals, so a ball's corner may miss half its diameter by that.
        let ball = (corner - radius).abs() <= 1e-4 * scale;
        if self.needs_ball && !ball {
            let message = format!(
                "{called} is no ball: its diameter is {diameter} mm and its corner radius {corner} mm; say `radius` if it is one"
            );
            return Err(place.fail(message, first, "its first cut", context));
        }
        (self.radius, self.corner) = (radius, if ball { radius } else { corner });
        Ok(())
    }
}

fn same(one: &Option<Arc<Tool>>, other: &Option<Arc<Tool>>) -> bool {
    one == other
}
