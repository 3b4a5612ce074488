//! This module holds the places of the corrected file that differ, each with the old bytes.

use crate::program::{Program, StatementChange};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::de::{self, Deserialize, Deserializer};
use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};

/// A place in the corrected file, and the bytes of the original there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UndoEdit {
    /// The first byte in the corrected file, counted from 0.
    pub at: usize,
    /// The number of bytes of the corrected file that are removed.
    pub length: usize,
    /// The bytes of the original that replace them. In JSON they are `was`, or `was_base64` if they are not
    /// UTF-8.
    pub was: Vec<u8>,
}

/// All places that differ, in order. Adjacent places are joined.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::program::StepId;
/// use clsmith::source::Source;
/// use clsmith::undo::UndoPatch;
/// use clsmith::write::ProgramEditor;
///
/// let source = Source::new("part.cls", b"FEDRAT/MMPM,1200.\nGOTO/0,0,0\n".to_vec())?;
/// let program = parse(&source, None).program;
/// let feed = program.statement_ids().next().expect("there are statements");
/// let mut editor = ProgramEditor::new(program, StepId(0));
/// editor.set_numbers(feed, &[(0, 600.0)])?;
/// let corrected = editor.finish()?;
/// let patch = UndoPatch::from_program(&corrected);
/// assert_eq!(patch.restore_bytes(&corrected.to_bytes()).as_deref(), Some(source.bytes()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, serde::Deserialize)]
#[serde(transparent)]
pub struct UndoPatch(pub Vec<UndoEdit>);

impl UndoPatch {
    /// Computes the patch from a program in its current state back to the file from which it was read.
    pub fn from_program(program: &Program) -> Self {
        let mut places = Vec::new();
        let mut open: Option<UndoEdit> = None;
        let mut at = 0;
        for statement in program.statements() {
            let length = if statement.is_live() { program.statement_text(statement).len() } else { 0 };
            if statement.change() == StatementChange::Untouched {
                places.extend(open.take());
            } else {
                let place = open.get_or_insert_with(|| UndoEdit { at, length: 0, was: Vec::new() });
                place.length += length;
                place.was.extend_from_slice(program.source().slice(statement.origin()));
            }
            at += length;
        }
        places.extend(open);
        // A statement that one step inserted and another one deleted leaves no difference.
        places.retain(|place| place.length > 0 || !place.was.is_empty());
        Self(places)
    }

    /// Restores the original. Returns `None` if the places are not in the file in order.
    pub fn restore_bytes(&self, corrected: &[u8]) -> Option<Vec<u8>> {
        let mut out = Vec::with_capacity(corrected.len());
        let mut copied = 0;
        for place in &self.0 {
            out.extend_from_slice(corrected.get(copied..place.at)?);
            out.extend_from_slice(&place.was);
            copied = place.at.checked_add(place.length)?;
        }
        out.extend_from_slice(corrected.get(copied..)?);
        Some(out)
    }
}

impl Serialize for UndoEdit {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut out = serializer.serialize_struct("Place", 3)?;
        out.serialize_field("at", &self.at)?;
        out.serialize_field("length", &self.length)?;
        match std::str::from_utf8(&self.was) {
            Ok(text) => out.serialize_field("was", text)?,
            Err(_) => out.serialize_field("was_base64", &STANDARD.encode(&self.was))?,
        }
        out.end()
    }
}

/// A place as it is written in JSON.
#[derive(serde::Deserialize)]
struct UndoEditText {
    at: usize,
    length: usize,
    was: Option<String>,
    was_base64: Option<String>,
}

impl<'de> Deserialize<'de> for UndoEdit {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let UndoEditText { at, length, was, was_base64 } = UndoEditText::deserialize(deserializer)?;
        let was = match (was, was_base64) {
            (Some(text), None) => text.into_bytes(),
            (None, Some(text)) => STANDARD.decode(text).map_err(de::Error::custom)?,
            _ => return Err(de::Error::custom("a place has either `was` or `was_base64`")),
        };
        Ok(Self { at, length, was })
    }
}
