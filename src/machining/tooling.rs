//! The tools of a program and their cutters.

use crate::diagnostic::Diagnostic;
use crate::program::motion::{Motion, Tool};
use crate::program::record::SpindleDirection;
use crate::program::{LengthUnit, Program, Statement};
use crate::setup::Setup;
use crate::sim::{Cutter, LoadModel, Material};
use crate::source::Span;
use std::sync::Arc;

/// The distinct tools of a program in the order of their use, each with its cutter.
#[derive(Debug, Clone, Default)]
pub struct Tooling {
    tools: Vec<Used>,
    cutters: Vec<Cutter>,
}

#[derive(Debug, Clone)]
struct Used {
    tool: Arc<Tool>,
    /// The first statement that moves it.
    statement: usize,
}

impl Tooling {
    pub(super) fn of(
        program: &Program,
        setup: &Setup,
        units: LengthUnit,
        findings: &mut Vec<Diagnostic>,
        errors: &mut Vec<Diagnostic>,
    ) -> Self {
        let mut found = Self::default();
        let mut gaps: Vec<Arc<Tool>> = Vec::new();
        let none = Arc::new(Tool::default());
        for motion in program.motions() {
            // A tool that only ever moves in rapids cuts nothing, but may crash: it is simulated when its shape is known.
            let tool = motion.tool.as_ref().unwrap_or(&none);
            if found.place(tool).is_some() || gaps.iter().any(|gap| same(gap, tool)) {
                continue;
            }
            let statement = motion.last_statement();
            let span = place(program, statement);
            match setup.cutter(tool, units) {
                Ok(resolved) => {
                    findings.extend(resolved.note(tool, program.source(), span));
                    found.tools.push(Used { tool: Arc::clone(tool), statement });
                    found.cutters.push(resolved.cutter);
                }
                Err(gap) if !motion.rapid => {
                    gaps.push(Arc::clone(tool));
                    errors.push(gap.diagnostic(program.source(), span));
                }
                Err(_) => {}
            }
        }
        found
    }

    fn place(&self, tool: &Arc<Tool>) -> Option<usize> {
        // The tool in force is nearly always one of the last.
        self.tools.iter().rposition(|used| same(&used.tool, tool))
    }

    /// Index of the cutter of a motion's tool.
    pub fn cutter_of(&self, motion: &Motion) -> Option<usize> {
        match &motion.tool {
            Some(tool) => self.place(tool),
            None => self.tools.iter().position(|used| *used.tool == Tool::default()),
        }
    }

    /// The cutters.
    pub fn cutters(&self) -> &[Cutter] {
        &self.cutters
    }

    /// The tool of a cutter.
    pub fn tool(&self, cutter: usize) -> Option<&Arc<Tool>> {
        self.tools.get(cutter).map(|used| &used.tool)
    }

    /// What says that the teeth of tools are not known; one finding for each such tool.
    pub fn teeth_gaps(&self, program: &Program, setup: &Setup) -> Vec<Diagnostic> {
        let without = self.tools.iter().zip(&self.cutters).filter(|(_, cutter)| cutter.teeth.is_none());
        let gap = |(used, _): (&Used, &Cutter)| {
            setup.teeth_gap(&used.tool, program.source(), place(program, used.statement))
        };
        without.map(gap).collect()
    }

    /// The force models of all cutters for both senses of the spindle; `None` for a cutter without teeth.
    pub fn load_models(&self, material: Material) -> Vec<Option<[LoadModel; 2]>> {
        let both = [SpindleDirection::Clockwise, SpindleDirection::CounterClockwise];
        let models = |cutter: &Cutter| {
            let teeth = cutter.teeth.as_ref()?;
            Some(both.map(|direction| LoadModel::new(&cutter.profile, teeth, material, direction)))
        };
        self.cutters.iter().map(models).collect()
    }
}

/// Whether two tools are one: the same allocation, mostly, else the same in every field.
fn same(a: &Arc<Tool>, b: &Arc<Tool>) -> bool {
    Arc::ptr_eq(a, b) || a == b
}

pub(super) fn place(program: &Program, statement: usize) -> Span {
    program.statement(statement).map(Statement::origin).unwrap_or_default()
}
