//! This module makes the way through the air on which a rotary axis goes back, and writes it.

use super::rewind_places::{RewindPlace, RewindTurn};
use crate::diagnostic::Failure;
use crate::engagement::PathLinearizer;
use crate::machine::{AxisKind, AxisMount, JointValues, KinematicChain};
use crate::program::geometry::Pose;
use crate::program::motion::Motion;
use crate::program::{LengthUnit, Program, Record, RecordKind, StatementId};
use crate::transform::statement_numbers::{copy_statement, pair_with_indices, strip_remark};
use crate::write::ProgramEditor;
use nalgebra::{Matrix3, Point3, Vector3};
use std::collections::BTreeMap;

/// The largest step of the axis between two points, in degrees.
const LARGEST_STEP_DEG: f64 = 15.0;

/// A way through the air: poses in the workpiece frame in mm.
pub(super) struct AirPath {
    /// At rapid: up, and around.
    rapid: Vec<Pose>,
    /// At feed: back to the cut.
    back: Pose,
}

impl AirPath {
    /// Makes the way. `None` where the machine cannot reach it.
    pub(super) fn from_turn(chain: &KinematicChain, turn: &RewindTurn, retract_mm: f64) -> Option<Self> {
        let axis = chain.locate_tool(&turn.joints).1;
        let up = turn.tip + axis * retract_mm;
        let linears = chain.solve_linears(turn.joints.rotaries, &up)?;
        let carrier = chain.axes().iter().filter(|axis| axis.kind == AxisKind::Rotary).nth(turn.rotary)?;
        let steps = (turn.by.abs() / LARGEST_STEP_DEG).ceil().max(1.0);
        let mut rapid = vec![Pose { point: up, axis }];
        for step in 1..=steps as usize {
            let mut joints = JointValues { linears, ..turn.joints };
            *joints.rotaries.get_mut(turn.rotary)? += turn.by * step as f64 / steps;
            let (tip, axis) = chain.locate_tool(&joints);
            // An axis of the head would swing the tip far around; so the tip stands, and the linear axes follow.
            let point = if carrier.mount == AxisMount::Table { tip } else { up };
            rapid.push(Pose { point, axis });
        }
        Some(Self { rapid, back: Pose { point: turn.tip, axis } })
    }
}

/// Returns for each place the GOTO on which its points are modelled: a plain one with a tool axis that ends the motion of the
/// place or the one before. Places without one are missing.
pub(super) fn find_templates(program: &Program, places: &[RewindPlace]) -> BTreeMap<usize, StatementId> {
    let mut wanted: BTreeMap<usize, StatementId> = BTreeMap::new();
    let is_plain =
        |id: StatementId| matches!(program.statement(id).record(), Record::Goto(goto) if goto.axis.is_some());
    let mut before: Option<StatementId> = None;
    for (number, motion) in program.motions().enumerate() {
        let own = motion.last_statement();
        if places.iter().any(|place| place.before.number == number) {
            let found = [Some(own), before].into_iter().flatten().find(|id| is_plain(*id));
            wanted.extend(found.map(|id| (number, id)));
        }
        before = Some(own);
    }
    wanted
}

/// Writes the way before the motion of a place. Returns how many points it has.
pub(super) fn write_air_path(
    editor: &mut ProgramEditor,
    place: &RewindPlace,
    template: StatementId,
    way: &AirPath,
    file: LengthUnit,
) -> Result<usize, Failure> {
    let frame = FrameOfMotion::new(editor.program(), &place.before.motion, file);
    let before = place.before.motion.statements.first();
    let rapid = rapid_text(editor.program());
    let goto = |editor: &ProgramEditor, pose: &Pose| {
        let Pose { point, axis } = frame.to_file(pose);
        let numbers = [point.x, point.y, point.z, axis.x, axis.y, axis.z];
        copy_statement(editor, template, &pair_with_indices(0, numbers))
    };
    for pose in &way.rapid {
        editor.insert_before(before, &rapid)?;
        let text = goto(editor, pose);
        editor.insert_before(before, &text)?;
    }
    let text = goto(editor, &way.back);
    editor.insert_before(before, &text)?;
    Ok(way.rapid.len() + 1)
}

/// Returns a RAPID in the form of the file.
fn rapid_text(program: &Program) -> Vec<u8> {
    let own = program.live_statements_of(&[RecordKind::Rapid]).find_map(|(_, statement)| {
        matches!(statement.record(), Record::Rapid).then(|| strip_remark(program.statement_text(statement)))
    });
    own.unwrap_or_else(|| b"RAPID".to_vec())
}

/// The frame in which a motion is programmed, as seen from the workpiece.
struct FrameOfMotion {
    turn: Matrix3<f64>,
    origin: Point3<f64>,
    mm_per_unit: f64,
}

impl FrameOfMotion {
    fn new(program: &Program, motion: &Motion, file: LengthUnit) -> Self {
        let mut frames = PathLinearizer::new(file.mm_per_unit(), 1.0, f64::INFINITY);
        if let Some(first) = program.motions().next() {
            frames.adopt_workpiece_frame(&first);
        }
        let place = |axis: Vector3<f64>| frames.place_pose(motion, Pose { point: Point3::origin(), axis });
        let columns = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| place(axis).axis);
        Self {
            turn: Matrix3::from_columns(&columns),
            origin: place(Vector3::z()).point,
            mm_per_unit: file.mm_per_unit(),
        }
    }

    fn to_file(&self, pose: &Pose) -> Pose {
        // Frames are turned and not scaled, so the transpose is the inverse.
        let back = self.turn.transpose();
        Pose { point: (back * (pose.point - self.origin) / self.mm_per_unit).into(), axis: back * pose.axis }
    }
}
