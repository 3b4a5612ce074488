//! This module holds the parameters of the step in millimetres, with the cutter that the passes are for.

use super::findings::MotionFindings;
use super::parameters::{ArcOutput, CompensateZ, CompensationReference, InputPointKind, OutputPointKind};
use crate::diagnostic::Failure;
use crate::parameters::Positive;
use crate::program::motion::{ActiveTool, Motion};
use crate::program::{LengthUnit, Program};
use crate::transform::StepContext;
use std::sync::Arc;

/// The allowed gouge and gap when the recipe gives none, in mm.
pub(super) const TOLERANCE_MM: f64 = 0.005;

/// The parameters in millimetres.
pub(super) struct CompensateZJob {
    /// Half of the cutter's diameter.
    pub radius: f64,
    /// The cutter's corner radius.
    pub corner: f64,
    /// The radius of the ball that the path was made for.
    pub was: Option<f64>,
    pub was_centre: bool,
    pub centre: bool,
    pub tolerance: f64,
    pub arcs: bool,
    pub file: LengthUnit,
    needs_ball: bool,
    told: bool,
}

impl CompensateZJob {
    pub(super) fn new(
        step: &CompensateZ,
        file: LengthUnit,
        context: &StepContext<'_>,
    ) -> Result<Self, Failure> {
        let recipe = context.units.mm_per_unit();
        let mm = |value: Option<Positive>| value.map(|value| value.get() * recipe);
        let was = mm(step.was_radius);
        match (step.input, was) {
            (InputPointKind::Contact, Some(_)) => {
                let message =
                    "`was_radius` needs a path that was made for a ball: add `input: tip` or `input: centre`";
                return Err(context.step_failure(message, &["was_radius"]));
            }
            (InputPointKind::Tip | InputPointKind::Centre, None) => {
                let message = "the path was made for a ball of unknown radius; add `was_radius: 5` (the radius of that ball)";
                return Err(context.step_failure(message, &["input"]));
            }
            _ => {}
        }
        let needs_ball =
            !matches!(step.against, CompensationReference::Mesh(_)) || step.output == OutputPointKind::Centre;
        let radius = mm(step.radius);
        Ok(Self {
            radius: radius.unwrap_or(0.0),
            corner: radius.unwrap_or(0.0),
            was,
            was_centre: step.input == InputPointKind::Centre,
            centre: step.output == OutputPointKind::Centre,
            tolerance: mm(step.tolerance).unwrap_or(TOLERANCE_MM),
            arcs: step.arcs == ArcOutput::Keep,
            file,
            needs_ball,
            told: radius.is_some(),
        })
    }

    /// Returns how much higher everything around the passes has to be, in mm. When tips become centres, it
    /// rises by the radius.
    pub(super) fn lift_mm(&self) -> f64 {
        let was = if self.was_centre { self.was.unwrap_or(0.0) } else { 0.0 };
        if self.centre { (self.radius - was).max(0.0) } else { 0.0 }
    }

    /// Takes the cutter from the tool of the motions, unless the step gives the radius. The motions must have
    /// a single tool.
    pub(super) fn take_tool_cutter(
        &mut self,
        program: &Program,
        motions: &[Motion],
        meant: &[bool],
        first: usize,
        context: &StepContext<'_>,
    ) -> Result<(), Failure> {
        if self.told {
            return Ok(());
        }
        let place = MotionFindings { program, motions };
        let tool = motions.get(first).and_then(|motion| motion.tool.clone());
        let other = motions
            .iter()
            .zip(meant)
            .position(|(motion, meant)| *meant && !is_same_tool(&motion.tool, &tool));
        if let Some(other) = other {
            let message = "the step means passes of several tools; add `radius` to the step, or select one tool by `where: { tools: [5] }`";
            return Err(place.build_failure(message.to_owned(), other, "another tool", context));
        }
        let none = ActiveTool::default();
        let used = tool.as_deref().unwrap_or(&none);
        let entry = context.setup.find_tool_entry(used);
        let data = used.data.as_ref();
        let scale = self.file.mm_per_unit();
        let known =
            |of_setup: Option<f64>, of_file: Option<f64>| of_setup.or(of_file.map(|value| value * scale));
        let diameter = known(entry.and_then(|entry| entry.diameter_mm), data.and_then(|data| data.diameter));
        let corner =
            known(entry.and_then(|entry| entry.corner_radius_mm), data.and_then(|data| data.corner_radius));
        let called = used.display_name();
        let Some(diameter) = diameter.filter(|diameter| *diameter > 0.0) else {
            let message = format!(
                "the radius of {called} is not known: neither the step, nor the setup, nor the CL file gives it. \
                 Add `radius: 5` to the step, or `diameter: 10` to the tool under `setup: {{ tools: }}`"
            );
            return Err(place.build_failure(message, first, "its first cut", context));
        };
        let (radius, corner) = (diameter / 2.0, corner.unwrap_or(0.0));
        // Files print four decimals, so the corner radius of a ball may differ from half its diameter by
        // that.
        let ball = (corner - radius).abs() <= 1e-4 * scale;
        if self.needs_ball && !ball {
            let message = format!(
                "{called} is no ball: its diameter is {diameter} mm and its corner radius {corner} mm. If it is one \
                 all the same, add `radius: {radius}` to the step"
            );
            return Err(place.build_failure(message, first, "its first cut", context));
        }
        (self.radius, self.corner) = (radius, if ball { radius } else { corner });
        Ok(())
    }
}

fn is_same_tool(one: &Option<Arc<ActiveTool>>, other: &Option<Arc<ActiveTool>>) -> bool {
    one == other
}
