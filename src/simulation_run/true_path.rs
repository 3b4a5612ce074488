//! This module takes a run along the path that the machine of the setup makes, and says where that is not the programmed one.

use super::Machining;
use super::tooling::statement_span;
use crate::diagnostic::{Diagnostic, codes};
use crate::engagement::{MachinePath, PathLinearizer};
use crate::machine::{AxisInterpolation, ProgramPath};
use crate::number::format_significant_number;
use crate::program::{LengthUnit, Program};
use crate::setup::Setup;
use std::sync::Arc;

impl Machining<'_> {
    /// Begins to divide the path that the machine makes: chords are at most `sagitta_mm` from it, and pieces no longer than
    /// `longest_piece_mm`.
    pub(super) fn start_path(&self, sagitta_mm: f64, longest_piece_mm: f64) -> PathLinearizer {
        PathLinearizer::new(self.units.mm_per_unit(), sagitta_mm, longest_piece_mm)
            .with_machine_path(self.machine_path.path.clone())
    }

    /// Returns what is said of the path that the machine makes, in sentences without their full stops.
    pub(crate) fn told_machine_path(&self) -> &[String] {
        &self.machine_path.told
    }

    /// Returns whether the machine makes a motion in another way than it is programmed.
    pub(crate) fn leaves_programmed_path(&self, number: usize) -> bool {
        self.machine_path.path.as_ref().is_some_and(|path| path.even_parts(number).is_some())
    }
}

/// Returns the path that the machine of a setup makes of a program; `None` where it is the programmed one, or the axes of the
/// machine are not known.
pub(crate) fn find_machine_path(
    program: &Program,
    setup: &Setup,
    units: LengthUnit,
) -> Option<Arc<dyn MachinePath>> {
    let path = find_program_path(program, setup, units)?;
    (path.count_motions() > 0).then(|| Arc::new(path) as Arc<dyn MachinePath>)
}

fn find_program_path(program: &Program, setup: &Setup, units: LengthUnit) -> Option<ProgramPath> {
    let chain = setup.machine.chain.as_ref()?;
    Some(ProgramPath::from_program(program, chain, setup.machine.interpolation(), units))
}

/// Returns the path of the machine for a run, and adds a note where it is not the programmed one.
pub(super) fn tell_machine_path(
    program: &Program,
    setup: &Setup,
    units: LengthUnit,
    findings: &mut Vec<Diagnostic>,
) -> Option<ToldMachinePath> {
    let path = find_program_path(program, setup, units)?;
    let notes = [note_machine_path(program, &path), note_unknown_path(&path)];
    let notes: Vec<Diagnostic> = notes.into_iter().flatten().collect();
    let told = notes.iter().map(|note| note.message.clone()).collect();
    findings.extend(notes);
    let path = (path.count_motions() > 0).then(|| Arc::new(path) as Arc<dyn MachinePath>);
    Some(ToldMachinePath { path, told })
}

/// The path of a machine, and what is said of it.
#[derive(Debug, Default)]
pub(super) struct ToldMachinePath {
    /// The path, where it is not the programmed one.
    pub path: Option<Arc<dyn MachinePath>>,
    /// Sentences without their full stops.
    pub told: Vec<String>,
}

fn note_machine_path(program: &Program, path: &ProgramPath) -> Option<Diagnostic> {
    let furthest = path.furthest()?;
    let motions = match path.count_motions() {
        1 => "one motion is".to_owned(),
        more => format!("{more} motions are"),
    };
    let length = |value: f64| format_significant_number(value, 3, 6);
    let at = statement_span(program, furthest.statement);
    let (line, _) = program.source().line_column(at.start);
    let message = match path.interpolation() {
        AxisInterpolation::JointLinear => format!(
            "{motions} simulated on the path of the machine, which has no control of the tip: the tip leaves its line by up to {} mm, on line {line}",
            length(furthest.sag_mm)
        ),
        AxisInterpolation::TipControlled => format!(
            "{motions} simulated with the tool axis as the rotary axes turn it: 20 mm above the tip it is up to {} mm beside the shortest turn, on line {line}",
            length(furthest.distance_mm)
        ),
    };
    Some(Diagnostic::new(codes::TRUE_PATH, message).with_label(program.source(), at, "most on this motion"))
}

fn note_unknown_path(path: &ProgramPath) -> Option<Diagnostic> {
    let [curves, unreached] = path.count_unknown();
    let told = [
        (curves, "arcs or splines on which rotary axes turn"),
        (unreached, "motions that the machine cannot reach"),
    ];
    let told: Vec<String> =
        told.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}")).collect();
    if told.is_empty() {
        return None;
    }
    let message = format!(
        "simulated as programmed, since the path of the machine is not known there: {}",
        told.join(", ")
    );
    Some(Diagnostic::new(codes::TRUE_PATH, message))
}
