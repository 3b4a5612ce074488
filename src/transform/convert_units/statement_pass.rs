//! This module converts statements one by one, each number by its role.

use super::unit_conversion::UnitConversion;
use super::unit_words;
use crate::diagnostic::Failure;
use crate::parse;
use crate::program::record::{SpindleUnit, StatedPitch, Threading, has_unknown_tool_numbers};
use crate::program::{FeedUnit, LengthUnit, NumberRole, Record, StatementId};
use crate::transform::StepContext;
use crate::transform::statement_numbers::{self, MatrixRowCounter, major_word, set_matrix_row};
use crate::write::{self, ProgramEditor};

/// Known words whose numbers may be lengths that only their post understands. A zero is the same in every
/// unit.
const LENGTHS_OF_POSTS: &[&str] = &[
    "CHECK", "COUPLE", "CUTCOM", "FACEMILL", "GOCLER", "LEADER", "MCHTOL", "PIVOTZ", "PLUNGE", "PSIS", "SET",
    "SHIFT", "SLOWDN", "SMOOTH", "TRACUT", "TURRET", "WCORN",
];

/// Converts every statement.
///
/// Returns an error if a statement does not read back.
pub(super) fn convert_statements(
    editor: &mut ProgramEditor,
    conversion: UnitConversion,
    context: &mut StepContext<'_>,
) -> Result<(), Failure> {
    let mut rows = MatrixRowCounter::default();
    let mut multi_axis = false;
    let mut unit_in_force = None;
    let mut reported = Vec::new();
    for id in editor.program().statement_ids() {
        let statement = editor.program().statement(id);
        if !statement.is_live() {
            continue;
        }
        let record = statement.record();
        let row = rows.observe_record(record);
        match record {
            Record::Goto(goto) => {
                // Most statements are points, so they are converted here, without the search for roles and
                // words that others need.
                let point = goto.point.coords.map(|value| conversion.convert_length(value));
                editor.set_numbers(id, &[(0, point.x), (1, point.y), (2, point.z)])?;
                continue;
            }
            Record::Comment | Record::Blank | Record::Rapid | Record::Text | Record::Marked(_) => continue,
            Record::Units(_) => {
                unit_words::swap_units(editor, id, conversion.to)?;
                continue;
            }
            Record::MatrixRow(numbers) => {
                let [_, _, _, shift] = **numbers;
                if row.is_some() {
                    let shift = conversion.convert_length(shift);
                    set_matrix_row(editor, id, &[(3, shift)])?;
                }
                continue;
            }
            Record::MultiAxis(on) => multi_axis = *on,
            Record::Feed(feed) => unit_in_force = feed.unit.or(unit_in_force),
            _ => {}
        }
        report_unconverted(editor, id, conversion, context, &mut reported);
        let edits = compute_edits(editor, id, conversion, multi_axis, unit_in_force);
        let statement = editor.program().statement(id);
        match statement.record() {
            Record::Feed(_) | Record::Cycle(_) => unit_words::swap_feed_words(editor, id, conversion)?,
            Record::Spindle(_) if !edits.is_empty() => {
                unit_words::swap_speed_word(editor, id, conversion.to)?;
            }
            _ => {}
        }
        if !edits.is_empty() {
            editor.set_numbers(id, &edits)?;
        }
    }
    Ok(())
}

/// Returns the new values of a statement's numbers.
fn compute_edits(
    editor: &ProgramEditor,
    id: StatementId,
    conversion: UnitConversion,
    multi_axis: bool,
    unit_in_force: Option<FeedUnit>,
) -> Vec<(usize, f64)> {
    let program = editor.program();
    let statement = program.statement(id);
    let (record, text) = (statement.record(), program.statement_text(statement));
    let roles = statement_numbers::number_roles(record, text, multi_axis);
    if roles.iter().all(|role| *role == NumberRole::Plain) {
        return Vec::new();
    }
    let feeds = match record {
        Record::Feed(_) | Record::Cycle(_) => unit_words::find_feeds(&write::statement_syntax(program, id)),
        _ => Vec::new(),
    };
    let metric_speed =
        matches!(record, Record::Spindle(spindle) if spindle.unit == SpindleUnit::SurfaceMetres);
    // Metres per minute belong to millimetres, and feet per minute to inches. A speed that is in the new
    // system already stays as it is.
    let speed_changes = metric_speed == (conversion.from == LengthUnit::Mm);
    let mut edits = Vec::new();
    for (number, ((_, value), role)) in parse::statement_numbers(text).into_iter().zip(roles).enumerate() {
        let new = match role {
            NumberRole::Point(_) | NumberRole::Step(_) | NumberRole::FrameOrigin(_) | NumberRole::Length => {
                conversion.convert_length(value)
            }
            NumberRole::Feed => {
                let unit = feeds.get(number).and_then(|(_, unit)| *unit).or(unit_in_force);
                if !conversion.convert_feed_unit(unit).1 {
                    continue;
                }
                conversion.convert_length(value)
            }
            NumberRole::SurfaceSpeed if speed_changes => conversion.convert_surface_speed(value),
            NumberRole::SurfaceSpeed
            | NumberRole::Direction(_)
            | NumberRole::ArcAxis(_)
            | NumberRole::FrameAxis(..)
            | NumberRole::Plain => {
                continue;
            }
        };
        edits.push((number, new));
    }
    edits
}

/// Reports statements with lengths in a form that is not understood, once for each word.
fn report_unconverted(
    editor: &ProgramEditor,
    id: StatementId,
    conversion: UnitConversion,
    context: &mut StepContext<'_>,
    reported: &mut Vec<String>,
) {
    let program = editor.program();
    let statement = program.statement(id);
    let text = program.statement_text(statement);
    let message = match statement.record() {
        Record::ToolCall(call) if !call.loads && parse::statement_numbers(text).len() > 2 => {
            "this TOOLNO mixes lengths, angles, feeds and speeds in an order of its own: none of them is converted"
        }
        Record::ToolCall(call) if call.loads && is_shops_tool_change(text) => {
            "only the first number of this tool change is understood, the tool's: none of the others is converted"
        }
        Record::ToolCall(call) if call.loads && bare_numbers(text) > 2 && bare_numbers(text) != 4 => {
            "only the first number of this tool change is understood, the tool's: none of the others is converted"
        }
        Record::CutterCompensation(_) if has_plain_number(statement.record(), text) => {
            "the numbers of this CUTCOM may be registers or lengths: they are not converted"
        }
        Record::ToolData(data) if has_unknown_tool_numbers(data, &parse::syntax(text)) => {
            "the numbers of this kind of tool are not understood: none of them is converted"
        }
        Record::Spindle(spindle)
            if spindle.unit == SpindleUnit::SurfaceFeet && conversion.from == LengthUnit::Mm =>
        {
            "SFM in a program in millimetres may mean feet or metres of surface per minute: it is left as it is"
        }
        Record::Feed(_) if parse::statement_numbers(text).is_empty() => {
            "the number of this feed stands behind a letter: it is not converted"
        }
        Record::Feed(_) if has_plain_number(statement.record(), text) => {
            "only the first number of this feed is understood: none of the others is converted"
        }
        Record::Threading(Threading::On(Some(StatedPitch::Unknown)))
            if has_plain_number(statement.record(), text) =>
        {
            "the number of this THREAD may be its pitch: it is not converted"
        }
        Record::Known if major_word(text) == "FEDRAT" && !parse::statement_numbers(text).is_empty() => {
            "the unit of this feed is not understood: it is not converted"
        }
        Record::Known
            if LENGTHS_OF_POSTS.contains(&major_word(text).as_ref())
                && has_plain_number(statement.record(), text) =>
        {
            "only the post understands the numbers of this word, and they may be lengths: they are not converted"
        }
        _ => return,
    };
    let mut word = major_word(text).into_owned();
    if let Record::ToolData(_) = statement.record() {
        // Each kind of tool has numbers of its own.
        word.extend(parse::syntax(text).word_at(0).as_deref());
    }
    if !reported.contains(&word) {
        context.report_unchanged(message, program, id);
        reported.push(word);
    }
}

/// Whether a statement has a number, not zero, that no role makes a length.
fn has_plain_number(record: &Record, text: &[u8]) -> bool {
    let roles = parse::number_roles(record, text);
    let mut numbers = parse::statement_numbers(text).into_iter().zip(roles);
    numbers.any(|((_, value), role)| value != 0.0 && role == NumberRole::Plain)
}

/// Returns whether a statement is a shop's own word for a tool change, with numbers beside the tool's.
fn is_shops_tool_change(text: &[u8]) -> bool {
    let of_standard = matches!(major_word(text).as_ref(), "LOAD" | "LOADTL" | "TURRET");
    let word = parse::syntax(text).word.end;
    let behind = text.get(word..).unwrap_or_default();
    let is_number = |part: &&[u8]| part.iter().any(|byte| byte.is_ascii_digit()) && *part != b"0";
    !of_standard && behind.split(|byte| !byte.is_ascii_digit() && *byte != b'.').filter(is_number).count() > 1
}

/// How many numbers a statement starts with before its first word: `LOADTL/2, 2, 60.0, 2`.
fn bare_numbers(text: &[u8]) -> usize {
    parse::syntax(text).fields.iter().take_while(|field| field.number_value().is_some()).count()
}
