//! This module plans which SPINDL prints which speed.
//!
//! A SPINDL takes the speed that the first motion under it needs. Where a later motion needs another speed, a
//! SPINDL in its form is inserted before that motion. So the programmed speed returns after the selected
//! part.

use super::SpindleSpeedChange;
use crate::diagnostic::Failure;
use crate::number;
use crate::parameters::Positive;
use crate::parse;
use crate::program::record::{SpindleDirection, SpindleUnit, speed_number_index};
use crate::program::{Program, Record, Statement, StatementId, fold_text};
use crate::transform::motion_insertion::MotionInsertion;
use crate::transform::statement_numbers::{round_to_decimals, strip_remark};
use crate::transform::unit_slips::choose_milder_factor;
use crate::transform::{SelectedStatements, StepContext};
use crate::write::{ProgramEditor, patch_numbers};
use std::collections::BTreeSet;

/// A scaled speed may be off by this fraction when it is rounded to its own decimals.
const SCALE_TOLERANCE: f64 = 1e-3;

/// The least number of decimals of set speeds and limits. The writer prints so many exactly.
const DECIMALS: usize = 4;

/// The speeds that the SPINDLs of a program print, and those that its motions need.
pub(super) struct SpeedPlan {
    spindles: Vec<ProgrammedSpindle>,
    motions: Vec<MotionSpeed>,
}

/// A SPINDL of the program.
struct ProgrammedSpindle {
    statement: StatementId,
    on: bool,
    direction: Option<SpindleDirection>,
    speed: Option<PrintedSpeed>,
}

/// The speed that a SPINDL prints.
#[derive(Debug, Clone, Copy)]
struct PrintedSpeed {
    /// The index of the number in the statement.
    number: usize,
    programmed: f64,
    /// The speed after the step, where the step means it. It is the same if the step cannot change it.
    changed: f64,
    is_changeable: bool,
    is_meant: bool,
}

/// The speed of a motion with a running spindle.
#[derive(Debug, Clone, Copy)]
pub(super) struct MotionSpeed {
    /// The index of the motion.
    motion: usize,
    /// The statement before which a SPINDL for the motion is inserted.
    first: StatementId,
    /// The motion's last statement.
    last: StatementId,
    /// The SPINDL that prints the speed.
    governor: StatementId,
    /// The speed in force, in the unit of its SPINDL.
    pub programmed: f64,
    /// The speed that the step wants.
    pub wanted: f64,
    /// Whether the motion taps a thread, so that its feed depends on the speed.
    pub is_tap: bool,
}

impl SpeedPlan {
    /// Returns the factor of the motion whose speed changes least. Returns `None` if no motion's speed changes.
    pub(super) fn find_mildest_factor(&self) -> Option<f64> {
        let factors = self.motions.iter().map(|speed| speed.wanted / speed.programmed);
        let factors = factors.filter(|factor| factor.is_finite() && *factor > 0.0);
        factors.fold(None, choose_milder_factor)
    }

    /// Collects the speeds of all SPINDLs and motions of a program, and reports those that are meant but
    /// cannot be changed.
    pub(super) fn new(
        change: SpindleSpeedChange,
        program: &Program,
        selected: &SelectedStatements,
        context: &mut StepContext<'_>,
    ) -> Self {
        let spindles = find_spindles(change, program, selected);
        let taps = find_cycle_starts(program);
        let mut insertion = MotionInsertion::new(program);
        let mut motions = Vec::new();
        let mut kept: BTreeSet<StatementId> =
            spindles.iter().filter(|found| found.is_kept()).map(|found| found.statement).collect();
        let mut without = None;
        for (number, motion) in program.motions().enumerate() {
            let place = insertion.find_statements(&motion);
            let end = motion.last_statement();
            let is_meant = selected.contains(end);
            let speed = motion.spindle.as_ref().and_then(|spindle| spindle.speed);
            if speed.is_none() && is_meant && !motion.rapid {
                without = without.or(Some(end));
            }
            if !motion.spindle.as_ref().is_some_and(|spindle| spindle.on) {
                continue;
            }
            let before =
                spindles.get(..spindles.partition_point(|found| found.statement < end)).unwrap_or_default();
            let governor = before.iter().rev().find_map(|found| Some((found.statement, found.speed?)));
            let Some((governor, speed)) = governor else { continue };
            if is_meant && !speed.is_changeable {
                kept.insert(governor);
            }
            let tap = taps.get(taps.partition_point(|(cycle, _)| *cycle < end).saturating_sub(1));
            motions.push(MotionSpeed {
                motion: number,
                first: place.first(),
                last: place.last(),
                governor,
                programmed: speed.programmed,
                wanted: if is_meant { speed.changed } else { speed.programmed },
                is_tap: motion.hole.is_some() && tap.is_some_and(|(_, is_tap)| *is_tap),
            });
        }
        report_kept_speeds(program, &kept, without, context);
        Self { spindles, motions }
    }

    /// Returns the speed of a motion by its index. Returns `None` if the spindle does not turn, or if its
    /// speed is not known.
    pub(super) fn find_motion(&self, number: usize) -> Option<&MotionSpeed> {
        let found = self.motions.binary_search_by_key(&number, |speed| speed.motion).ok()?;
        self.motions.get(found)
    }

    /// Writes the speeds. Returns how many SPINDLs were changed and how many were inserted.
    ///
    /// # Errors
    /// Returns an error if a speed cannot be printed as a record that reads back.
    pub(super) fn write_speeds(&self, editor: &mut ProgramEditor) -> Result<(usize, usize), Failure> {
        let mut writer = SpeedWriter { editor, in_force: None, direction: None, changed: 0, added: 0 };
        let mut motions = self.motions.iter().peekable();
        for spindle in &self.spindles {
            while let Some(motion) = motions.next_if(|motion| motion.last < spindle.statement) {
                writer.reach_speed(motion, motion.first)?;
            }
            writer.direction = spindle.direction.or(writer.direction);
            let next = motions.peek();
            match spindle.speed {
                Some(speed) => {
                    let governed = next.filter(|motion| motion.governor == spindle.statement);
                    let alone = if speed.is_meant { speed.changed } else { speed.programmed };
                    writer.set_speed(
                        spindle.statement,
                        speed,
                        governed.map_or(alone, |motion| motion.wanted),
                    )?;
                }
                // SPINDL/ON would start the spindle at a speed that the next motions do not need.
                None if spindle.on => {
                    if let Some(motion) = next {
                        writer.reach_speed(motion, spindle.statement)?;
                    }
                }
                None => {}
            }
        }
        motions.try_for_each(|motion| writer.reach_speed(motion, motion.first))?;
        Ok((writer.changed, writer.added))
    }
}

impl ProgrammedSpindle {
    /// Returns whether the step means its speed but cannot change it.
    fn is_kept(&self) -> bool {
        self.speed.is_some_and(|speed| speed.is_meant && !speed.is_changeable)
    }
}

fn find_spindles(
    change: SpindleSpeedChange,
    program: &Program,
    selected: &SelectedStatements,
) -> Vec<ProgrammedSpindle> {
    let mut spindles = Vec::new();
    for (id, statement) in program.live_statements() {
        let Record::Spindle(spindle) = statement.record() else { continue };
        let text = program.statement_text(statement);
        let numbers = parse::statement_numbers(text);
        let printed = spindle.speed.and_then(|_| speed_number_index(&parse::syntax(text)));
        let speed = printed.and_then(|number| {
            let (at, programmed) = numbers.get(number).cloned()?;
            let decimals = text.get(at).map_or(0, number::count_decimals);
            let changed = change.change_speed(programmed, spindle.unit, decimals);
            Some(PrintedSpeed {
                number,
                programmed,
                changed: changed.unwrap_or(programmed),
                is_changeable: changed.is_some(),
                is_meant: selected.contains(id),
            })
        });
        let (on, direction) = (spindle.on, spindle.direction);
        spindles.push(ProgrammedSpindle { statement: id, on, direction, speed });
    }
    spindles
}

/// Returns the CYCLEs that do more than modify the one in force, and whether their feed is pitch times speed.
fn find_cycle_starts(program: &Program) -> Vec<(StatementId, bool)> {
    let start = |(id, found): (StatementId, &Statement)| match found.record() {
        Record::Cycle(cycle) if !cycle.changes => Some((id, cycle.cuts_thread)),
        _ => None,
    };
    program.live_statements().filter_map(start).collect()
}

fn report_kept_speeds(
    program: &Program,
    kept: &BTreeSet<StatementId>,
    without: Option<StatementId>,
    context: &mut StepContext<'_>,
) {
    if let Some(first) = kept.first() {
        let message = match kept.len() {
            1 => "a surface speed cannot be compared with rev/min; it is not changed".to_owned(),
            count => format!("{count} surface speeds cannot be compared with rev/min; they are not changed"),
        };
        context.report_unchanged(message, program, *first);
    }
    if let Some(motion) = without {
        let message = "no SPINDL before this motion states a speed, so there is none to change";
        context.report_unchanged(message, program, motion);
    }
}

impl SpindleSpeedChange {
    /// Returns the new value of a speed, rounded to what is printed exactly. Returns `None` for a surface
    /// speed that cannot be compared.
    fn change_speed(self, speed: f64, unit: SpindleUnit, decimals: usize) -> Option<f64> {
        if speed <= 0.0 {
            return Some(speed);
        }
        let exact = decimals.max(DECIMALS);
        let is_surface = unit != SpindleUnit::RevolutionsPerMinute;
        match self {
            Self::Scale(factor) => {
                let wanted = speed * factor.get();
                let rounded = (decimals..=exact).map(|decimals| round_to_decimals(wanted, decimals));
                let near =
                    rounded.into_iter().find(|value| (value - wanted).abs() <= wanted * SCALE_TOLERANCE);
                Some(near.unwrap_or(wanted))
            }
            _ if is_surface => None,
            Self::Set(wanted) => Some(round_to_decimals(wanted.get(), exact)),
            Self::Clamp(range) => {
                let power = 10f64.powi(exact as i32);
                let max = range.max.map_or(f64::INFINITY, Positive::get);
                let min = range.min.map_or(0.0, Positive::get);
                // A limit is rounded to the allowed side. If both limits cannot be kept, the highest counts.
                let highest =
                    if max.is_finite() { (max * power * (1.0 + 1e-12)).floor() / power } else { max };
                let lowest = ((min * power * (1.0 - 1e-12)).ceil() / power).min(highest);
                Some(speed.max(lowest).min(highest)).filter(|speed| *speed > 0.0).or(Some(speed))
            }
        }
    }
}

/// Writes speeds in the order of the program.
struct SpeedWriter<'e> {
    editor: &'e mut ProgramEditor,
    /// The SPINDL whose speed is in force, the index of its number, and the speed as it was last written.
    in_force: Option<(StatementId, usize, f64)>,
    /// The sense of rotation of the spindle, once it was stated.
    direction: Option<SpindleDirection>,
    changed: usize,
    added: usize,
}

impl SpeedWriter<'_> {
    /// Gives a SPINDL of the program its speed.
    fn set_speed(&mut self, statement: StatementId, speed: PrintedSpeed, wanted: f64) -> Result<(), Failure> {
        if wanted != speed.programmed {
            self.editor.set_numbers(statement, &[(speed.number, wanted)])?;
            self.changed += 1;
        }
        self.in_force = Some((statement, speed.number, wanted));
        Ok(())
    }

    /// Inserts a SPINDL before a statement if the speed in force is not the one that a motion needs.
    fn reach_speed(&mut self, motion: &MotionSpeed, before: StatementId) -> Result<(), Failure> {
        let Some((governor, number, speed)) = self.in_force else { return Ok(()) };
        if governor != motion.governor || speed == motion.wanted {
            return Ok(());
        }
        let text = self.render_spindle(governor, number, motion.wanted);
        self.editor.insert_before(before, &text)?;
        self.added += 1;
        self.in_force = Some((governor, number, motion.wanted));
        Ok(())
    }

    /// Returns the text of a SPINDL with another speed, and with the sense of rotation in force.
    fn render_spindle(&self, governor: StatementId, number: usize, speed: f64) -> Vec<u8> {
        let program = self.editor.program();
        let found = program.statement(governor);
        let text = strip_remark(program.statement_text(found));
        let mut text =
            patch_numbers(&text, found.record(), &[(number, speed)], self.editor.style()).unwrap_or(text);
        let sense = match self.direction {
            Some(SpindleDirection::Clockwise) => "CLW",
            Some(SpindleDirection::CounterClockwise) => "CCLW",
            None => return text,
        };
        let syntax = parse::syntax(&text);
        let senses = syntax.fields.iter().map(|field| field.at.clone());
        let mut other = senses.filter(|at| matches!(fold_text(syntax.bytes_at(at)).as_ref(), "CLW" | "CCLW"));
        if let Some(at) = other.next_back().filter(|at| fold_text(syntax.bytes_at(at)) != sense) {
            text.splice(at, sense.bytes());
        }
        text
    }
}
