//! This module finds the tools of a program and their cutters.

use crate::cutter::{CutterModel, Meridian, Teeth, ToolBeam};
use crate::diagnostic::{Diagnostic, codes};
use crate::engagement::{CuttingLaw, EdgeForceModel, LoadModel};
use crate::program::motion::{ActiveTool, Motion};
use crate::program::record::SpindleDirection;
use crate::program::{LengthUnit, Program, StatementId};
use crate::setup::Setup;
use crate::source::Span;
use std::sync::Arc;

/// The distinct tools of a program in the order of their use, each with its cutter.
#[derive(Debug, Clone, Default)]
pub struct Tooling {
    tools: Vec<UsedTool>,
    cutters: Vec<CutterModel>,
    /// The cutters as beams, as far as the setup says what that needs.
    beams: Vec<Option<Arc<ToolBeam>>>,
}

/// Says which tools a run needs data of.
pub type NeededTools<'a> = &'a dyn Fn(&ActiveTool) -> bool;

/// A tool that the program uses.
#[derive(Debug, Clone)]
struct UsedTool {
    tool: Arc<ActiveTool>,
    /// The index of the first statement that moves the tool.
    statement: StatementId,
}

impl Tooling {
    /// Finds the tools of a program and resolves their cutters. Adds assumptions to `findings`, and missing
    /// shapes of tools that are `needed` to `errors`.
    pub(super) fn from_program(
        program: &Program,
        setup: &Setup,
        units: LengthUnit,
        needed: NeededTools<'_>,
        findings: &mut Vec<Diagnostic>,
        errors: &mut Vec<Diagnostic>,
    ) -> Self {
        let mut found = Self::default();
        let mut gaps: Vec<Arc<ActiveTool>> = Vec::new();
        let none = Arc::new(ActiveTool::default());
        for motion in program.motions() {
            // A tool that only moves in rapids does not cut, but may collide. It is simulated if its shape is
            // known.
            let tool = motion.tool.as_ref().unwrap_or(&none);
            if found.find_tool(tool).is_some() || gaps.iter().any(|gap| is_same_tool(gap, tool)) {
                continue;
            }
            let statement = motion.last_statement();
            let span = statement_span(program, statement);
            match setup.resolve_cutter(tool, units) {
                Ok(resolved) => {
                    findings.extend(resolved.note_assumptions(tool, program.source(), span));
                    found.tools.push(UsedTool { tool: Arc::clone(tool), statement });
                    found.cutters.push(resolved.cutter);
                    found.beams.push(resolved.beam.map(Arc::new));
                }
                // Only a tool that cuts needs a shape. It is reported once, at its first motion at feed.
                Err(gap) if !motion.rapid => {
                    gaps.push(Arc::clone(tool));
                    match needed(tool) {
                        true => errors.push(gap.diagnostic(program.source(), span)),
                        false => findings.push(note_left_material(tool, program, span)),
                    }
                }
                Err(_) => {}
            }
        }
        found
    }

    fn find_tool(&self, tool: &Arc<ActiveTool>) -> Option<usize> {
        // The active tool is nearly always one of the last.
        self.tools.iter().rposition(|used| is_same_tool(&used.tool, tool))
    }

    /// Returns the index of the cutter of a motion's tool.
    pub fn cutter_index(&self, motion: &Motion) -> Option<usize> {
        match &motion.tool {
            Some(tool) => self.find_tool(tool),
            None => self.tools.iter().position(|used| *used.tool == ActiveTool::default()),
        }
    }

    /// Returns the cutters.
    pub fn cutters(&self) -> &[CutterModel] {
        &self.cutters
    }

    /// Returns the tool of a cutter.
    pub fn tool_of_cutter(&self, cutter: usize) -> Option<&Arc<ActiveTool>> {
        self.tools.get(cutter).map(|used| &used.tool)
    }

    /// Returns a finding for each needed tool whose teeth are not known.
    pub fn find_missing_teeth(
        &self,
        program: &Program,
        setup: &Setup,
        needed: NeededTools<'_>,
    ) -> Vec<Diagnostic> {
        let used = self.tools.iter().zip(&self.cutters).filter(|(used, _)| needed(&used.tool));
        let without = used.filter(|(_, cutter)| cutter.teeth.is_none());
        let gap = |(used, _): (&UsedTool, &CutterModel)| {
            setup.report_missing_teeth(&used.tool, program.source(), statement_span(program, used.statement))
        };
        without.map(gap).collect()
    }

    /// Returns a cutter as a beam; `None` if the setup does not say what that needs.
    pub fn beam_of_cutter(&self, cutter: usize) -> Option<&Arc<ToolBeam>> {
        self.beams.get(cutter)?.as_ref()
    }

    /// Returns a finding for each needed tool that is not known as a beam.
    pub fn find_missing_stiffness(
        &self,
        program: &Program,
        setup: &Setup,
        needed: NeededTools<'_>,
    ) -> Vec<Diagnostic> {
        let used = self.tools.iter().zip(&self.beams).filter(|(used, _)| needed(&used.tool));
        let without = used.filter(|(_, beam)| beam.is_none());
        let gap = |(used, _): (&UsedTool, &Option<Arc<ToolBeam>>)| {
            let span = statement_span(program, used.statement);
            setup.report_missing_stiffness(&used.tool, program.source(), span)
        };
        without.map(gap).collect()
    }

    /// Makes the load models of all cutters for both directions of the spindle; `None` for a cutter without
    /// teeth.
    pub fn build_load_models(&self, law: &CuttingLaw) -> Vec<Option<[LoadModel; 2]>> {
        self.make_for_both_directions(law, |profile, teeth, law, spindle, _| {
            LoadModel::new(profile, teeth, law, spindle)
        })
    }

    /// Makes load models that tell how their tools bend as well, as [`Tooling::build_load_models`] does.
    pub fn build_bending_models(&self, law: &CuttingLaw) -> Vec<Option<[LoadModel; 2]>> {
        self.make_for_both_directions(law, |profile, teeth, law, spindle, beam| {
            LoadModel::new(profile, teeth, law, spindle).with_beam(beam)
        })
    }

    /// Makes the models of forces edge by edge, as [`Tooling::build_load_models`] does.
    pub fn build_edge_models(&self, law: &CuttingLaw) -> Vec<Option<[EdgeForceModel; 2]>> {
        self.make_for_both_directions(law, |profile, teeth, law, spindle, beam| {
            EdgeForceModel::new(profile, teeth, law, spindle).with_beam(beam)
        })
    }

    /// Makes something of every cutter with teeth, for a spindle that turns clockwise and counter-clockwise. The wear of an
    /// edge multiplies its forces.
    fn make_for_both_directions<T>(
        &self,
        law: &CuttingLaw,
        make: impl Fn(&Meridian, &Teeth, CuttingLaw, SpindleDirection, Option<Arc<ToolBeam>>) -> T,
    ) -> Vec<Option<[T; 2]>> {
        let both = [SpindleDirection::Clockwise, SpindleDirection::CounterClockwise];
        let models = |(cutter, beam): (&CutterModel, &Option<Arc<ToolBeam>>)| {
            let teeth = cutter.teeth.as_ref()?;
            let law = law.scaled(teeth.wear_factor());
            Some(both.map(|direction| make(&cutter.profile, teeth, law, direction, beam.clone())))
        };
        self.cutters.iter().zip(&self.beams).map(models).collect()
    }
}

/// Returns whether two tools are the same: mostly the same allocation, else equal in every field.
fn is_same_tool(a: &Arc<ActiveTool>, b: &Arc<ActiveTool>) -> bool {
    Arc::ptr_eq(a, b) || a == b
}

/// Returns where a statement is in the source, or an empty span if there is no such statement.
pub(super) fn statement_span(program: &Program, statement: StatementId) -> Span {
    program.statement(statement).origin()
}

/// Notes that the cuts of a tool without a shape are left out. More material is the worse case for all other tools.
fn note_left_material(tool: &ActiveTool, program: &Program, span: Span) -> Diagnostic {
    let message = format!(
        "the shape of {} is not known, and nothing asks for its cuts: what it removes is taken to stay, which is the worse case for the other tools",
        tool.display_name()
    );
    Diagnostic::new(codes::ASSUMPTION, message).with_label(program.source(), span, "cuts from here")
}
