//! `set_spindle` scales, sets or limits spindle speeds, and changes the feeds that depend on them.

mod speed_plan;

use super::feed_plan::{FeedPlan, set_feed};
use super::step_report::{TransformReport, to_json_value};
use super::thread_pitches::list_feeds_in_threads;
use super::unit_slips::{check_factor, check_mildest_factor, check_speed};
use super::{SelectedStatements, StepContext, Transform};
use crate::diagnostic::Failure;
use crate::parameters::{Factor, Positive};
use crate::presentation::display_units::DisplayUnits;
use crate::presentation::text_format::{format_count, format_counted};
use crate::program::{FeedUnit, Program, Record, RecordKind, StatementId};
use crate::recipe::StatementFilter;
use crate::write::{ProgramEditor, statement_syntax};
use schemars::JsonSchema;
use serde::de::{Deserializer, Error as _};
use serde::{Deserialize, Serialize};
use speed_plan::SpeedPlan;
use std::collections::BTreeSet;

/// Scales, sets or limits programmed spindle speeds.
///
/// Speeds are in rev/min. A surface speed (SFM, SMM) can be scaled. Where it would have to be set or limited,
/// it stays and is reported. SPINDL/OFF stays, and SPINDL/ON continues with the new speed. Where a selected
/// part begins or ends without a SPINDL of its own, one in the file's form is inserted before the first
/// motion, so the programmed speed returns after the part.
///
/// A feed per revolution keeps its number, so its rate changes with the speed. A feed per minute keeps its
/// number with `feeds: keep`, so the feed per tooth changes. With `feeds: follow`, it changes by the same
/// ratio as the speed, and the feed per tooth stays. In taps (`CYCLE/TAP`, `RTAP`, `THREAD`), a feed per
/// minute always follows, because it is pitch times speed; so does a FEDRAT inside the cycle that repeats it.
///
/// A limit holds as printed. The step is idempotent with `set` and `clamp`: a second run changes nothing.
/// With `scale`, a second run multiplies again.
///
/// ```yaml
/// version: 1
/// steps:
///   # Four fifths of the speed, with the same feed per tooth.
///   - set_spindle: { speed: { scale: 0.8 }, feeds: follow }
/// ```
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SetSpindle {
    /// The change of the speed: `scale: 0.8`, `set: 6000` or `clamp: { min: 500, max: 8000 }`.
    pub speed: SpindleSpeedChange,
    /// What happens to feeds per minute.
    pub feeds: SpindleFeedHandling,
    /// Which statements and motions are meant; all of them when it is left out.
    #[serde(default)]
    #[schemars(extend("x-default" = "the whole program"))]
    pub r#where: StatementFilter,
}

/// The change of a spindle speed.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SpindleSpeedChange {
    /// The speed is multiplied by a factor. The result has the decimals of the programmed speed, and more
    /// only where a thousandth of it would be lost.
    #[schemars(extend("x-unit" = "none (times the programmed speed)"))]
    Scale(Factor),
    /// The speed becomes this, in rev/min.
    #[schemars(extend("x-unit" = "rev/min"))]
    Set(Positive),
    /// The speed is kept within limits, in rev/min.
    Clamp(#[serde(deserialize_with = "read_speed_range")] SpindleSpeedRange),
}

/// The lowest and the highest spindle speed, in rev/min. At least one of them is needed.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpindleSpeedRange {
    /// The lowest speed, in rev/min.
    #[schemars(extend("x-unit" = "rev/min", "x-default" = "no lowest speed"))]
    pub min: Option<Positive>,
    /// The highest speed, in rev/min.
    #[schemars(extend("x-unit" = "rev/min", "x-default" = "no highest speed"))]
    pub max: Option<Positive>,
}

/// What happens to feeds per minute when the spindle speed changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SpindleFeedHandling {
    /// They keep their numbers.
    Keep,
    /// They change by the same ratio, so that the feed per tooth stays.
    Follow,
}

/// The figures of what `set_spindle` did.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct SetSpindleReport {
    /// The number of SPINDLs that got another speed.
    pub speeds_changed: usize,
    /// The number of SPINDLs that were inserted.
    pub speeds_added: usize,
    /// The number of FEDRATs and CYCLEs whose feed per minute follows the speed.
    pub feeds_followed: usize,
    /// The number of these that feed taps.
    pub tap_feeds: usize,
}

fn read_speed_range<'de, D: Deserializer<'de>>(deserializer: D) -> Result<SpindleSpeedRange, D::Error> {
    let range = SpindleSpeedRange::deserialize(deserializer)?;
    match (range.min.map(Positive::get), range.max.map(Positive::get)) {
        (None, None) => Err(D::Error::custom("neither `min` nor `max` is given\nGive one of them, or both.")),
        (Some(min), Some(max)) if min > max => Err(D::Error::custom(format!(
            "`min` ({min}) is above `max` ({max})\nSet `min` to {max} or less."
        ))),
        _ => Ok(range),
    }
}

impl SetSpindle {
    /// Makes the step for the whole program.
    pub fn new(speed: SpindleSpeedChange, feeds: SpindleFeedHandling) -> Self {
        Self { speed, feeds, r#where: StatementFilter::default() }
    }

    /// Reports values that look like slips.
    fn check_slips(&self, context: &mut StepContext<'_>) {
        match self.speed {
            SpindleSpeedChange::Scale(factor) => check_factor(factor.get(), &["speed", "scale"], context),
            SpindleSpeedChange::Set(speed) => check_speed(speed.get(), &["speed", "set"], context),
            // A highest speed above all machines changes nothing, so only a lowest one can be wrong.
            SpindleSpeedChange::Clamp(range) => {
                let lowest = range.min.map_or(0.0, Positive::get);
                check_speed(lowest, &["speed", "clamp", "min"], context);
            }
        }
    }
}

/// This step takes four fifths of the speed and keeps the feed per tooth.
///
/// ```
/// use clsmith::parameters::Factor;
/// use clsmith::parse::parse;
/// use clsmith::program::LengthUnit;
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
/// use clsmith::transform::set_spindle::{SpindleFeedHandling, SpindleSpeedChange};
/// use clsmith::transform::{SetSpindle, run_steps};
///
/// let part = b"SPINDL/RPM,5000,CLW\nFEDRAT/MMPM,1000.\nGOTO/0,0,0\n";
/// let program = parse(&Source::new("part.cls", part.to_vec())?, None).program;
/// let slower = SpindleSpeedChange::Scale(Factor::new(0.8).expect("0.8 is above 0"));
/// let step = SetSpindle::new(slower, SpindleFeedHandling::Follow);
/// let outcome = run_steps(&[&step], LengthUnit::Mm, &Setup::default(), program)?;
/// assert_eq!(outcome.program.to_bytes(), b"SPINDL/RPM,4000,CLW\nFEDRAT/MMPM,800.\nGOTO/0,0,0\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl Transform for SetSpindle {
    fn apply(&self, program: Program, context: &mut StepContext<'_>) -> Result<Program, Failure> {
        self.check_slips(context);
        let selected = SelectedStatements::select(&self.r#where, &program, "statement", context);
        report_speeds_of_cycles(&program, &selected, context);
        let plan = SpeedPlan::new(self.speed, &program, &selected, context);
        if !matches!(self.speed, SpindleSpeedChange::Scale(_)) {
            check_mildest_factor(plan.find_mildest_factor(), "speed", &["speed"], context);
        }
        let (mut followed, mut taps, mut tap_ratios) = (BTreeSet::new(), BTreeSet::new(), Vec::new());
        let feeds = FeedPlan::for_motions_and_threads(&program, |number, motion| {
            let speed = plan.find_motion(number).filter(|speed| speed.wanted != speed.programmed)?;
            if speed.is_tap {
                tap_ratios.push((motion.last_statement(), speed.wanted / speed.programmed));
            }
            let feed = motion.feed.filter(|feed| !feed.unit_or_default().is_per_revolution())?;
            if self.feeds == SpindleFeedHandling::Keep && !speed.is_tap {
                return None;
            }
            followed.extend(motion.feed_from);
            taps.extend(motion.feed_from.filter(|_| speed.is_tap));
            Some(feed.value * speed.wanted / speed.programmed)
        });
        let repeated = find_repeated_tap_feeds(&program, &feeds.governing_statements(), &tap_ratios);
        let mut editor = ProgramEditor::new(program, context.step);
        let (speeds_changed, speeds_added) = plan.write_speeds(&mut editor)?;
        if !followed.is_empty() {
            feeds.write_feeds(&mut editor, &mut context.findings)?;
        }
        for (statement, feed) in &repeated {
            set_feed(&mut editor, *statement, *feed)?;
        }
        let (feeds_followed, tap_feeds) = (followed.len() + repeated.len(), taps.len() + repeated.len());
        context.add_report(SetSpindleReport { speeds_changed, speeds_added, feeds_followed, tap_feeds });
        editor.finish()
    }
}

/// Returns the FEDRATs inside the cycles of taps that govern no motion, with the feeds that follow the speed of the holes
/// after them. They repeat the feed of the cycle, and machines take either of the two.
fn find_repeated_tap_feeds(
    program: &Program,
    governing: &BTreeSet<StatementId>,
    tap_ratios: &[(StatementId, f64)],
) -> Vec<(StatementId, f64)> {
    if tap_ratios.is_empty() {
        return Vec::new();
    }
    let in_threads = list_feeds_in_threads(program);
    let mut unit = None;
    let mut found = Vec::new();
    for (id, statement) in program.live_statements_of(&[RecordKind::Feed]) {
        let Record::Feed(feed) = statement.record() else { continue };
        unit = feed.unit.or(unit);
        let per_revolution = unit.is_some_and(FeedUnit::is_per_revolution);
        if per_revolution || governing.contains(&id) || !in_threads.contains(&id) {
            continue;
        }
        let next = tap_ratios.get(tap_ratios.partition_point(|(hole, _)| *hole < id));
        found.extend(next.map(|(_, ratio)| (id, feed.value * ratio)));
    }
    found
}

/// Reports cycles that print a speed of their own, which stays.
fn report_speeds_of_cycles(program: &Program, selected: &SelectedStatements, context: &mut StepContext<'_>) {
    let has_speed = |cycle: StatementId| {
        let syntax = statement_syntax(program, cycle);
        (0..syntax.fields.len())
            .any(|field| matches!(syntax.word_at(field).as_deref(), Some("RPM" | "SPINDL")))
    };
    let cycles = program.live_statements().filter(|(_, found)| matches!(found.record(), Record::Cycle(_)));
    let mut found =
        cycles.map(|(cycle, _)| cycle).filter(|cycle| selected.contains(*cycle) && has_speed(*cycle));
    if let Some(first) = found.next() {
        let message = match found.count() {
            0 => "this CYCLE has a spindle speed of its own, which is not changed".to_owned(),
            more => format!("{} CYCLEs have a spindle speed of their own, which is not changed", more + 1),
        };
        context.report_unchanged(message, program, first);
    }
}

impl TransformReport for SetSpindleReport {
    fn step_name(&self) -> &'static str {
        "set_spindle"
    }

    fn to_text(&self, _units: DisplayUnits) -> String {
        let feeds = |count| format_counted(count, "feed per minute follows", "feeds per minute follow");
        let taps = match self.tap_feeds {
            0 => String::new(),
            count => format!(", {} of taps (pitch times speed)", format_count(count as u64)),
        };
        format!(
            "\nset_spindle: {} changed, {} put in; {}{taps}\n",
            format_counted(self.speeds_changed, "speed", "speeds"),
            format_count(self.speeds_added as u64),
            feeds(self.feeds_followed),
        )
    }

    fn to_json(&self) -> serde_json::Value {
        to_json_value(self)
    }
}
