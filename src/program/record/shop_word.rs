//! This module reads statements that begin with a word of the shop's own.

use super::structure::{OperationNames, read_channel};
use super::tool::ToolCall;
use super::{BadRecord, FrameRecord, FrameWord, Record, bad_record, feed, wrong_count};
use crate::program::shop_vocabulary::{ShopVocabulary, ShopWordMeaning};
use crate::program::syntax::{StatementKind, StatementSyntax};
use std::ops::Range;

impl Record {
    /// Reads the meaning that a shop gives to a statement; `None` if it begins with none of its words.
    ///
    /// # Errors
    /// Returns a [`BadRecord`] for a word whose arguments do not fit its meaning.
    pub(crate) fn read_shop_word(
        vocabulary: &ShopVocabulary,
        syntax: &StatementSyntax<'_>,
    ) -> Option<Result<Self, BadRecord>> {
        if matches!(syntax.form, StatementKind::Blank | StatementKind::Numbers | StatementKind::Refused) {
            return None;
        }
        let (meaning, end) = vocabulary.find_word(syntax.text)?;
        Some(match meaning {
            ShopWordMeaning::Operation => {
                let name = Box::new(find_name(syntax.text, end));
                Ok(Self::OperationStart(OperationNames { name, tool: None }))
            }
            ShopWordMeaning::OperationEnd => Ok(Self::OperationEnd),
            ShopWordMeaning::ToolChange => read_tool_number(syntax, end),
            ShopWordMeaning::Frame => read_frame(syntax),
            ShopWordMeaning::Channel => match read_channel(syntax) {
                channel @ Self::Channel(_) => Ok(channel),
                _ => Err(bad_record(0..end, "a channel takes its number, a whole one")),
            },
            ShopWordMeaning::Spindle if is_lettered(syntax) => {
                Err(bad_record(0..end, "a spindle speed is a number, and no letter stands before it"))
            }
            ShopWordMeaning::Spindle => read_standard("SPINDL", syntax, feed::read_record),
            ShopWordMeaning::Feed if is_lettered(syntax) => feed::read_lettered_feed(syntax)
                .ok_or_else(|| bad_record(0..end, "a feed cannot be negative")),
            ShopWordMeaning::Feed => read_standard("FEDRAT", syntax, feed::read_record),
            ShopWordMeaning::Text => Ok(Self::Text),
        })
    }

    /// Returns whether a shop may give the statement another meaning. What moves the tool keeps its own.
    pub(crate) fn may_be_shop_word(&self) -> bool {
        matches!(
            self,
            Self::Comment
                | Self::Text
                | Self::Known
                | Self::Other
                | Self::ToolCall(_)
                | Self::Frame(_)
                | Self::OperationStart(_)
                | Self::OperationEnd
                | Self::Marked(_)
        )
    }
}

/// Returns the place of the name behind a word: the rest of the line without separators around it.
fn find_name(text: &[u8], from: usize) -> Range<usize> {
    let rest = text.get(from..).unwrap_or_default();
    let length = memchr::memmem::find(rest, b"$$").unwrap_or(rest.len());
    let line = rest.get(..length).unwrap_or_default();
    let is_around =
        |byte: &u8| byte.is_ascii_whitespace() || matches!(byte, b'/' | b',' | b':' | b'=' | b'\'');
    let Some(first) = line.iter().position(|byte| !is_around(byte)) else { return from..from };
    let last = line.iter().rposition(|byte| !is_around(byte)).unwrap_or(first);
    from + first..from + last + 1
}

/// Reads the number of a tool: the first number among the fields, or in the text behind the word.
fn read_tool_number(syntax: &StatementSyntax<'_>, end: usize) -> Result<Record, BadRecord> {
    let in_fields = syntax.fields.iter().find_map(|field| field.number_value());
    let number = in_fields.or_else(|| {
        let rest = syntax.text.get(end..).unwrap_or_default();
        let digits = rest.iter().skip_while(|byte| !byte.is_ascii_digit());
        let digits: String =
            digits.take_while(|byte| byte.is_ascii_digit()).map(|&b| char::from(b)).collect();
        digits.parse().ok()
    });
    match number {
        Some(number) if number.fract() == 0.0 && (0.0..1e9).contains(&number) => {
            Ok(Record::ToolCall(ToolCall { number: number as u32, loads: true, channel: None }))
        }
        _ => Err(bad_record(0..end, "a tool change takes the tool's number, a whole one")),
    }
}

/// Returns whether the only number of a statement stands behind a letter: `F_CUT/F300`.
fn is_lettered(syntax: &StatementSyntax<'_>) -> bool {
    syntax.count_numbers() == 0 && feed::find_lettered_number(syntax).is_some()
}

/// Reads a frame, whose form its count of numbers tells. Names may stand among its fields: `WCS_DEF/G54,...`.
fn read_frame(syntax: &StatementSyntax<'_>) -> Result<Record, BadRecord> {
    let numbers: Vec<f64> = syntax.fields.iter().filter_map(|field| field.number_value()).collect();
    let word = match numbers.len() {
        3 => FrameWord::Origin,
        9 => FrameWord::Msys,
        12 => FrameWord::Csys,
        other => {
            let major = syntax.major_word();
            return Err(wrong_count(&major, syntax, "3, 9 or 12 numbers as a frame", other));
        }
    };
    Ok(Record::Frame(Box::new(FrameRecord { word, numbers })))
}

/// Reads a statement as if it began with a word of the standard, which the reader must know.
fn read_standard(
    word: &str,
    syntax: &StatementSyntax<'_>,
    read: fn(&str, &StatementSyntax<'_>) -> super::RecordReading,
) -> Result<Record, BadRecord> {
    let record = read(word, syntax);
    debug_assert!(record.is_some(), "{word} belongs to this family");
    record.unwrap_or(Ok(Record::Known))
}
