//! `unwind` lets rotary axes go back in the air where they would have to in a cut.

mod air_path;
mod rewind_places;
mod rewind_proof;

use super::{MotionSelection, StepContext, Transform, TransformReport, to_json_value};
use crate::diagnostic::{Failure, codes};
use crate::parameters::Positive;
use crate::presentation::display_units::DisplayUnits;
use crate::presentation::text_format::format_counted;
use crate::program::{Program, StatementId};
use crate::recipe::MotionFilter;
use crate::write::ProgramEditor;
use air_path::{AirPath, find_templates, write_air_path};
use rewind_places::{RewindPlace, list_rewinds};
use rewind_proof::prove_rewinds;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// How often rewinds are looked for: one that is put in may leave another one behind it.
const MOST_ROUNDS: usize = 4;

/// Lets rotary axes go back in the air where they would have to go back in a cut.
///
/// A cut that winds further than the limits of a rotary axis allow makes this axis go back by a turn, between two points of the
/// cut (CL0706 of `check`). The step puts a way through the air before such a motion: from its start along the tool axis by
/// `retract` at rapid, then around by the whole turn, and back to the start at the feed in force. The turn is written
/// as points at most 15 degrees apart, so that every control goes that way: for an axis that carries the workpiece, the tool stands
/// in the machine and the part turns below it; for an axis that carries the tool, the tip stands.
///
/// The result is simulated in the stock of the setup. Where the tool would touch anything on such a way, or cut at rapid, the step
/// fails and says where; a larger `retract` may mend it. So the setup must have the machine with its axes, the stock, and
/// the shapes of the tools.
///
/// Axes that go back in a rapid are left alone. A rewind stays and is reported where the points are so far apart that both sides of
/// it have no value in common between the limits, and where no plain GOTO with a tool axis can be copied. Idempotent: a
/// second run finds no rewind in a cut.
///
/// ```yaml
/// version: 1
/// units: mm
/// setup:
///   stock: { cylinder: { diameter: 60, from: [0, 0, -30], to: [0, 0, 0] } }
///   tools: [ { match: {}, diameter: 10, corner_radius: 5, flute_length: 40 } ]
///   machine:
///     table:
///       - { name: C, kind: rotary, direction: [0, 0, 1], point: [0, 0, 0], limits: [-270, 270], max_speed: 1800, rapid: 9000, acceleration: 800 }
///       - { name: B, kind: rotary, direction: [0, 1, 0], point: [0, 0, 77.5], max_speed: 3600, rapid: 9000, acceleration: 400 }
///     head:
///       - { name: X, kind: linear, direction: [1, 0, 0], max_speed: 20000, rapid: 26000, acceleration: 4000 }
///       - { name: Y, kind: linear, direction: [0, 1, 0], max_speed: 20000, rapid: 26000, acceleration: 4000 }
///       - { name: Z, kind: linear, direction: [0, 0, 1], max_speed: 17000, rapid: 20000, acceleration: 3500 }
/// steps:
///   - unwind: { retract: 60 }
/// ```
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Unwind {
    /// How far the tool goes back along its axis before the rotary axis turns, in the recipe's unit.
    #[schemars(extend("x-unit" = "the recipe's unit"))]
    pub retract: Positive,
    /// Which motions are meant; all of them when it is left out.
    #[serde(default)]
    #[schemars(extend("x-default" = "the whole program"))]
    pub r#where: MotionFilter,
}

impl Unwind {
    /// Makes a step for the whole program.
    pub fn new(retract: Positive) -> Self {
        Self { retract, r#where: MotionFilter::default() }
    }
}

/// What the step put in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[non_exhaustive]
pub struct UnwindReport {
    /// The number of rewinds that were put into the air.
    pub rewinds: usize,
    /// The number of points that this took.
    pub points_added: usize,
    /// The number of rewinds that stay in a cut.
    pub left: usize,
}

impl TransformReport for UnwindReport {
    fn step_name(&self) -> &'static str {
        "unwind"
    }

    fn to_text(&self, _units: DisplayUnits) -> String {
        format!(
            "\nunwind: {} put into the air with {}, simulated in the stock; {} left in a cut\n",
            format_counted(self.rewinds, "rewind", "rewinds"),
            format_counted(self.points_added, "point", "points"),
            self.left
        )
    }

    fn to_json(&self) -> serde_json::Value {
        to_json_value(self)
    }
}

impl Transform for Unwind {
    fn measures(&self) -> bool {
        true
    }

    fn apply(&self, program: Program, context: &mut StepContext<'_>) -> Result<Program, Failure> {
        let setup = context.setup;
        let Some(chain) = setup.machine.chain.as_deref() else {
            let message = "rotary axes go back for the limits of a machine, and the setup has none; add its axes under `machine:`, \
                           or name a file: `machine: { file: table.yaml }`";
            return Err(context.step_finding(codes::MACHINE_WITHOUT_AXES, message, &[], "this step").into());
        };
        let file = context.file_length_unit(&program);
        let (mut program, mut report) = (program, UnwindReport::default());
        let mut left: BTreeSet<(StatementId, &'static str)> = BTreeSet::new();
        for round in 0..=MOST_ROUNDS {
            let mut selection = MotionSelection::new(&self.r#where, &program, context);
            let places = list_rewinds(&program, chain, file, |motion| selection.contains(motion, context));
            if round == 0 {
                selection.report_if_empty(&program, context);
            }
            left.clear();
            let templates = find_templates(&program, &places);
            let mut writable: Vec<(&RewindPlace, AirPath)> = Vec::new();
            for place in &places {
                let retract_mm = self.retract.get() * context.units.mm_per_unit();
                let way = match &place.turn {
                    Ok(turn) if templates.contains_key(&place.before.number) => {
                        AirPath::from_turn(chain, turn, retract_mm).ok_or(UNSOLVED)
                    }
                    Ok(_) => Err("no plain GOTO with a tool axis stands here that could be copied"),
                    Err(reason) => Err(*reason),
                };
                match way {
                    Ok(way) if round < MOST_ROUNDS => writable.push((place, way)),
                    Ok(_) => {
                        _ = left.insert((
                            place.statement,
                            "the axis goes back in the cut again behind each rewind",
                        ))
                    }
                    Err(reason) => _ = left.insert((place.statement, reason)),
                }
            }
            if writable.is_empty() {
                break;
            }
            let mut editor = ProgramEditor::new(program.clone(), context.step);
            for (place, way) in writable {
                let Some(template) = templates.get(&place.before.number) else { continue };
                report.points_added += write_air_path(&mut editor, place, *template, &way, file)?;
                report.rewinds += 1;
            }
            program = editor.finish()?;
        }
        for (statement, reason) in &left {
            let message = format!("a rotary axis goes back in this cut: {reason}");
            context.report_unchanged(message, &program, *statement);
        }
        if report.rewinds > 0 {
            prove_rewinds(&program, file, context)?;
            report.left = left.len();
            context.add_report(report);
        }
        Ok(program)
    }
}

/// The reason for a place where the machine has no values.
const UNSOLVED: &str = "the machine cannot reach the way through the air";
