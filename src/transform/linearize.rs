//! `linearize` puts in points until the tip stays near its line on a machine without control of the tip.

use super::optimize_feed::write::{SplitProgram, split_motions};
use super::{MotionSelection, StepContext, Transform};
use crate::diagnostic::{Failure, codes};
use crate::machine::{KinematicChain, ProgramPose, solve_program_poses};
use crate::parameters::Positive;
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::{FeedUnit, LengthUnit, Program, StatementId};
use crate::recipe::MotionFilter;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeSet;

/// The largest number of parts that a motion is divided into at once.
const MOST_PARTS: usize = 1000;

/// How often points are put in. The distance of the tip falls with the square of the number of parts, so two rounds are
/// usual; what is left after so many cannot be mended by points.
const MOST_ROUNDS: usize = 6;

/// Puts in points until the tip stays near its line on a machine without control of the tip.
///
/// Between two points all axes of such a machine run evenly, and where rotary axes turn, the tip leaves the straight line:
/// by about `r a2 / 8` for a step of the angle `a` about an axis at the distance `r`. Points are put on the line, with the tool
/// axis turning evenly, until the distance is at most `tolerance`. The feed of the tip stays what it is. The machine
/// of the setup must have its axes; whether it has `tcp` makes no difference here.
///
/// Only straight motions at feed are divided. One with an inverse-time feed, whose time holds for the whole motion, is left
/// and reported, and so is one whose distance stays however many points it gets: where a rotary axis goes back, or
/// the tool goes through the pole. Idempotent: a second run finds no motion above the tolerance.
///
/// ```yaml
/// version: 1
/// units: mm
/// setup:
///   machine:
///     table:
///       - { name: C, kind: rotary, direction: [0, 0, 1], point: [0, 0, 0], max_speed: 1800, rapid: 9000, acceleration: 800 }
///       - { name: B, kind: rotary, direction: [0, 1, 0], point: [0, 0, 77.5], max_speed: 3600, rapid: 9000, acceleration: 400 }
///     head:
///       - { name: X, kind: linear, direction: [1, 0, 0], max_speed: 20000, rapid: 26000, acceleration: 4000 }
///       - { name: Y, kind: linear, direction: [0, 1, 0], max_speed: 20000, rapid: 26000, acceleration: 4000 }
///       - { name: Z, kind: linear, direction: [0, 0, 1], max_speed: 17000, rapid: 20000, acceleration: 3500 }
/// steps:
///   - linearize: { tolerance: 0.01 }
/// ```
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Linearize {
    /// How far the tip may be from its line, in the recipe's unit.
    #[schemars(extend("x-unit" = "the recipe's unit"))]
    pub tolerance: Positive,
    /// Which motions are meant; all of them when it is left out.
    #[serde(default)]
    #[schemars(extend("x-default" = "the whole program"))]
    pub r#where: MotionFilter,
}

impl Linearize {
    /// Makes a step for the whole program.
    pub fn new(tolerance: Positive) -> Self {
        Self { tolerance, r#where: MotionFilter::default() }
    }

    /// Lists the motions above the tolerance, with the number of parts that they need and their statements.
    fn list_long_motions(
        &self,
        program: &Program,
        chain: &KinematicChain,
        file: LengthUnit,
        context: &mut StepContext<'_>,
    ) -> Vec<LongMotion> {
        let tolerance = self.tolerance.get() * context.units.mm_per_unit();
        let poses = solve_program_poses(program, chain, file);
        let mut selection = MotionSelection::new(&self.r#where, program, context);
        let mut before: Option<&ProgramPose> = None;
        let mut found = Vec::new();
        for (number, (motion, pose)) in program.motions().zip(&poses).enumerate() {
            let is_meant =
                selection.contains(&motion, context) && !motion.rapid && motion.path == MotionPath::Line;
            let joints = before.filter(|_| is_meant).and_then(|before| pose.motion_from(before, chain));
            before = Some(pose);
            let Some(joints) = joints else { continue };
            let sag = joints.tip_sag_mm();
            if sag > tolerance {
                let parts = (sag / tolerance).sqrt().ceil().clamp(2.0, MOST_PARTS as f64) as usize;
                found.push(LongMotion {
                    number,
                    parts,
                    sag,
                    statement: motion.last_statement(),
                    has_own_time: has_own_time(&motion),
                });
            }
        }
        selection.report_if_empty(program, context);
        found
    }
}

/// A motion whose tip leaves its line too far.
struct LongMotion {
    number: usize,
    parts: usize,
    sag: f64,
    statement: StatementId,
    has_own_time: bool,
}

/// Returns whether the feed of a motion is the time of the whole motion.
fn has_own_time(motion: &Motion) -> bool {
    motion.feed.is_some_and(|feed| feed.unit_or_default() == FeedUnit::InverseTime)
}

impl Transform for Linearize {
    fn measures(&self) -> bool {
        true
    }

    fn apply(&self, program: Program, context: &mut StepContext<'_>) -> Result<Program, Failure> {
        let setup = context.setup;
        let Some(chain) = &setup.machine.chain else {
            let message = "points are put in for the axes of a machine, and the setup has none; add them under `machine:`, \
                           or name a file: `machine: { file: cradle.yaml }`";
            return Err(context.step_finding(codes::MACHINE_WITHOUT_AXES, message, &[], "this step").into());
        };
        let file = context.file_length_unit(&program);
        let mut program = program;
        // Motions that stay as they are, by their numbers.
        let mut kept: BTreeSet<usize> = BTreeSet::new();
        for round in 0.. {
            let findings_before = context.findings.len();
            let mut long = self.list_long_motions(&program, chain, file, context);
            if round > 0 {
                // What was said of an empty selection is said once.
                context.findings.truncate(findings_before);
            }
            long.retain(|motion| !kept.contains(&motion.number));
            let (own_time, long): (Vec<_>, Vec<_>) = long.into_iter().partition(|motion| motion.has_own_time);
            for motion in own_time {
                let message = "the tip leaves its line here, but the feed is the time of the whole motion, so no points were put in";
                context.report_unchanged(message, &program, motion.statement);
                kept.insert(motion.number);
            }
            if long.is_empty() {
                return Ok(program);
            }
            if round == MOST_ROUNDS {
                for motion in long {
                    let message = format!(
                        "the tip leaves its line by {:.4} mm here, however many points are put in: a rotary axis goes back, or the tool goes through the pole",
                        motion.sag
                    );
                    context.report_unchanged(message, &program, motion.statement);
                }
                return Ok(program);
            }
            let wanted: Vec<(usize, Vec<f64>)> = long
                .iter()
                .map(|motion| {
                    let parts = motion.parts as f64;
                    (motion.number, (1..motion.parts).map(|part| part as f64 / parts).collect())
                })
                .collect();
            let split = split_motions(program, context.step, &wanted, &mut context.findings)?;
            let SplitProgram { program: written, kept: whole, parts } = split;
            kept.extend(whole.iter().map(|(number, _)| *number));
            kept = kept.iter().filter_map(|number| Some(parts.get(*number)?.start)).collect();
            program = written;
        }
        Ok(program)
    }
}
