//! `inverse_time` writes feeds as the time of their motions.

use super::motion_insertion::MotionInsertion;
use super::statement_numbers::strip_remark;
use super::{MotionSelection, StepContext, Transform};
use crate::diagnostic::Failure;
use crate::machine::{ProgramPose, solve_program_poses};
use crate::parse;
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::{
    FeedUnit, FieldKind, LengthUnit, Program, Record, RecordKind, StatementId, StatementRange,
};
use crate::recipe::MotionFilter;
use crate::write::ProgramEditor;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

/// The number of digits that a time keeps: a motion then takes its time to a millionth.
const DIGITS: i32 = 7;

/// The angle in radians above which the tool axis turns on a motion.
const SAME_AXIS: f64 = 1e-7;

/// Writes feeds as inverse time: how many such motions fit into a minute, so that a motion takes the time that its length
/// has at the programmed feed.
///
/// Controls without control of the tip need it where rotary axes turn: a speed says nothing about a motion of several
/// axes, of which some turn. A FEDRAT with the word for inverse time stands before each such motion, in the form of the
/// file's own FEDRATs, and the programmed feed returns after them. A motion on which the tip stands and the tool turns has
/// no time by its feed; it gets the one that the axes of the setup's machine need, and is left and reported without them.
///
/// Plain APT and Creo write `INVERS`. The records of other CAM systems have no word for it, and mostly the post decides; for a post
/// that reads one, `word` says which. A file that has such feeds already shows its word itself.
///
/// Holes and threads keep their feeds, and so does a GOTO of several points, whose motions would need one record each. A
/// FEDRAT that names no unit would be read as inverse time behind one that does, so the step refuses files with such.
/// Put it last: a step that divides or moves motions after it changes their speed. The step is idempotent.
///
/// ```yaml
/// version: 1
/// steps:
///   - inverse_time: { word: INVERS }
/// ```
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InverseTime {
    /// The word of the post.
    #[schemars(extend("x-default" = "that of the file or of its dialect"))]
    pub word: Option<InverseTimeWord>,
    /// Whether all motions at feed are meant, also those on which the tool does not turn.
    #[serde(default)]
    pub all: bool,
    /// Which motions are meant; all of them when it is left out.
    #[serde(default)]
    #[schemars(extend("x-default" = "the whole program"))]
    pub r#where: MotionFilter,
}

/// A word for inverse time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "UPPERCASE")]
pub enum InverseTimeWord {
    /// `FEDRAT/INVERS,12.5`.
    Invers,
    /// `FEDRAT/INVERSE,12.5`.
    Inverse,
    /// `FEDRAT/INVTIM,12.5`.
    Invtim,
}

impl InverseTimeWord {
    fn word(self) -> &'static str {
        match self {
            Self::Invers => "INVERS",
            Self::Inverse => "INVERSE",
            Self::Invtim => "INVTIM",
        }
    }
}

impl Transform for InverseTime {
    fn apply(&self, program: Program, context: &mut StepContext<'_>) -> Result<Program, Failure> {
        let word = self.find_word(&program, context)?;
        let timed = self.list_timed_motions(&program, context);
        if timed.iter().all(|motion| motion.per_minute.is_none()) {
            return Ok(program);
        }
        refuse_feeds_without_unit(&program, context)?;
        let mut editor = ProgramEditor::new(program, context.step);
        // The FEDRAT whose feed was replaced for the motion before, and has to return.
        let mut replaced: Option<StatementId> = None;
        for motion in timed {
            let template =
                strip_remark(editor.program().statement_text(editor.program().statement(motion.governor)));
            match motion.per_minute {
                Some(per_minute) => {
                    let text = render_inverse_time(&template, per_minute, &word);
                    editor.insert_before(motion.first, &text)?;
                    replaced = Some(motion.governor);
                }
                None => {
                    if replaced.take() == Some(motion.governor) {
                        editor.insert_before(motion.first, &template)?;
                    }
                }
            }
        }
        editor.finish()
    }
}

/// A motion at feed that a FEDRAT governs.
struct TimedMotion {
    first: StatementId,
    governor: StatementId,
    /// How many such motions fit into a minute; `None` if it keeps its feed.
    per_minute: Option<f64>,
}

impl InverseTime {
    /// Returns the word for inverse time: the recipe's, that of a FEDRAT of the file, or that of the dialect.
    fn find_word(&self, program: &Program, context: &StepContext<'_>) -> Result<String, Failure> {
        if let Some(word) = self.word {
            return Ok(word.word().to_owned());
        }
        let known = program.live_statements_of(&[RecordKind::Feed]).find_map(|(_, statement)| {
            let text = program.statement_text(statement);
            let syntax = parse::syntax(text);
            let words = (0..syntax.fields.len()).filter_map(|field| syntax.word_at(field));
            words
                .into_iter()
                .find(|word| FeedUnit::from_word(word) == Some(FeedUnit::InverseTime))
                .map(|word| word.into_owned())
        });
        let dialect = program.dialect();
        known.or_else(|| dialect.inverse_time_word().map(str::to_owned)).ok_or_else(|| {
            let message = format!(
                "{} has no word for inverse time of its own; add the one that your post reads: `word: INVERS`",
                dialect.display_name()
            );
            context.step_failure(message, &[])
        })
    }

    fn list_timed_motions(&self, program: &Program, context: &mut StepContext<'_>) -> Vec<TimedMotion> {
        let file = context.file_length_unit(program);
        let standing = find_standing_times(program, file, context);
        let mut selection = MotionSelection::new(&self.r#where, program, context);
        let mut insertion = MotionInsertion::new(program);
        let motions: Vec<(usize, Motion, StatementRange)> = program
            .motions()
            .enumerate()
            .map(|(number, motion)| {
                let place = insertion.find_statements(&motion);
                (number, motion, place)
            })
            .collect();
        // Points of one statement cannot have a feed each.
        let shared = |at: usize, place: &StatementRange| {
            [at.wrapping_sub(1), at + 1]
                .iter()
                .any(|beside| motions.get(*beside).is_some_and(|(.., other)| other.last() == place.last()))
        };
        let mut timed = Vec::new();
        for (at, (number, motion, place)) in motions.iter().enumerate() {
            let Some(governor) = motion.feed_from.filter(|_| !motion.rapid) else { continue };
            if !matches!(program.statement(governor).record(), Record::Feed(_)) {
                continue;
            }
            let mut own = TimedMotion { first: place.first(), governor, per_minute: None };
            let is_inverse = motion.feed.is_some_and(|feed| feed.unit_or_default() == FeedUnit::InverseTime);
            let turns = motion.from.axis.angle(&motion.to.axis) > SAME_AXIS;
            let is_meant = selection.contains(motion, context)
                && (self.all || turns)
                && !is_inverse
                && motion.path != MotionPath::Start
                && motion.hole.is_none()
                && !motion.cuts_thread;
            if is_meant && shared(at, place) {
                let message = "the points of this GOTO would need a time each, so they keep their feed";
                context.report_unchanged(message, program, motion.last_statement());
            } else if is_meant {
                own.per_minute = find_inverse_time(motion, file, standing.get(number).copied());
                if own.per_minute.is_none() {
                    let message = "the time of this motion is not known, so it keeps its feed: the feed or the spindle \
                                   speed is not known, or the tip stands and the axes of the machine are not known";
                    context.report_unchanged(message, program, motion.last_statement());
                }
            }
            timed.push(own);
        }
        selection.report_if_empty(program, context);
        timed
    }
}

/// Returns how often a motion fits into a minute. `standing_s` is the time that axes need where the tip stands.
fn find_inverse_time(motion: &Motion, file: LengthUnit, standing_s: Option<f64>) -> Option<f64> {
    let length_mm = motion.length() * file.mm_per_unit();
    if length_mm <= 0.0 {
        return standing_s.map(|seconds| 60.0 / seconds);
    }
    let rpm = motion.spindle_rpm().filter(|rpm| *rpm > 0.0);
    let feed = motion.feed?.mm_per_minute(file, rpm, None).filter(|feed| *feed > 0.0)?;
    Some(feed / length_mm)
}

/// Returns the least times in s of motions on which the tip stands and axes turn, by their numbers, if the machine is
/// known.
fn find_standing_times(
    program: &Program,
    file: LengthUnit,
    context: &StepContext<'_>,
) -> BTreeMap<usize, f64> {
    let mut times = BTreeMap::new();
    let machine = &context.setup.machine;
    let Some(chain) = &machine.chain else { return times };
    let poses = solve_program_poses(program, chain, file);
    let mut before: Option<&ProgramPose> = None;
    for (number, (motion, pose)) in program.motions().zip(&poses).enumerate() {
        let joints =
            before.filter(|_| motion.length() <= 0.0).and_then(|before| pose.motion_from(before, chain));
        before = Some(pose);
        let seconds = joints.map(|joints| joints.axis_demand(machine.interpolation()).least_s);
        times.extend(seconds.filter(|seconds| *seconds > 0.0).map(|seconds| (number, seconds)));
    }
    times
}

/// Refuses a program in which a FEDRAT takes the unit of the one before it.
fn refuse_feeds_without_unit(program: &Program, context: &StepContext<'_>) -> Result<(), Failure> {
    let without = program
        .live_statements_of(&[RecordKind::Feed])
        .find(|(_, statement)| matches!(statement.record(), Record::Feed(feed) if feed.unit.is_none()));
    match without {
        None => Ok(()),
        Some((id, _)) => {
            let message = "this FEDRAT names no unit, and would be read as inverse time behind one that does; write the unit of \
                           every FEDRAT first";
            Err(context.statement_failure(message, program, id, "without a unit"))
        }
    }
}

/// Returns a FEDRAT with another number, and with the word for inverse time in place of its unit.
fn render_inverse_time(template: &[u8], per_minute: f64, word: &str) -> Vec<u8> {
    let syntax = parse::syntax(template);
    let mut parts: Vec<(std::ops::Range<usize>, String)> = Vec::new();
    for (index, field) in syntax.fields.iter().enumerate() {
        let is_unit = syntax.word_at(index).is_some_and(|word| FeedUnit::from_word(&word).is_some());
        match &field.kind {
            FieldKind::Number(_) if parts.iter().all(|(_, text)| text == word) => {
                parts.push((field.at.clone(), print_time(per_minute)));
            }
            FieldKind::Text if is_unit => parts.push((field.at.clone(), word.to_owned())),
            _ => {}
        }
    }
    let mut text = template.to_vec();
    for (at, part) in parts.into_iter().rev() {
        text.splice(at, part.into_bytes());
    }
    text
}

/// Prints a time with so many digits that it is kept to a millionth.
fn print_time(per_minute: f64) -> String {
    let decimals = (DIGITS - 1 - per_minute.log10().floor() as i32).clamp(1, 12);
    format!("{per_minute:.*}", decimals as usize)
}
