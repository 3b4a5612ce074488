//! This module holds the places of the corrected file that differ, each with the old bytes.

use crate::program::{Program, Statement, StatementChange, StepId};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::de::{self, Deserialize, Deserializer};
use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};
use std::ops::Range;

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
    /// The steps of the recipe that made it, counted from 1, in their order. Without comments in the program
    /// (`provenance: comments`) only the last one is known. Comments have the number after the last step.
    /// It is empty in reports of earlier versions.
    pub steps: Vec<u16>,
}

/// All places that differ, in order. Adjacent places of the same steps are joined.
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
                let steps = list_steps(program, statement);
                places.extend(open.take_if(|place| place.steps != steps));
                let place = open.get_or_insert_with(|| UndoEdit { at, length: 0, was: Vec::new(), steps });
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

    /// Returns the numbers of the steps that changed something in a range of the corrected file, in their order. A
    /// record that was taken out counts to what stands there now.
    pub fn steps_in(&self, range: Range<usize>) -> Vec<u16> {
        let first = self.0.partition_point(|place| place.at + place.length < range.start);
        let near = self.0.get(first..).unwrap_or_default().iter();
        let mut found: Vec<u16> = near
            .take_while(|place| place.at < range.end.max(range.start + 1))
            .filter(|place| place.length == 0 || place.at + place.length > range.start)
            .flat_map(|place| place.steps.iter().copied())
            .collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Returns how many places differ; edits of several steps side by side are one place.
    pub fn count_places(&self) -> usize {
        let joined = self.0.windows(2).filter(|pair| match pair {
            [first, second] => first.at + first.length == second.at,
            _ => false,
        });
        self.0.len() - joined.count()
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

/// Returns the numbers of the steps that changed a statement.
fn list_steps(program: &Program, statement: &Statement) -> Vec<u16> {
    let edits = program.edits_of_statement(statement);
    let mut steps: Vec<StepId> = edits.iter().map(|edit| edit.by).chain(statement.edited_by()).collect();
    steps.dedup();
    steps.iter().map(|step| step.0.saturating_add(1)).collect()
}

impl Serialize for UndoEdit {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut out = serializer.serialize_struct("Place", 4)?;
        out.serialize_field("at", &self.at)?;
        out.serialize_field("length", &self.length)?;
        match std::str::from_utf8(&self.was) {
            Ok(text) => out.serialize_field("was", text)?,
            Err(_) => out.serialize_field("was_base64", &STANDARD.encode(&self.was))?,
        }
        out.serialize_field("steps", &self.steps)?;
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
    #[serde(default)]
    steps: Vec<u16>,
}

impl<'de> Deserialize<'de> for UndoEdit {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let UndoEditText { at, length, was, was_base64, steps } = UndoEditText::deserialize(deserializer)?;
        let was = match (was, was_base64) {
            (Some(text), None) => text.into_bytes(),
            (None, Some(text)) => STANDARD.decode(text).map_err(de::Error::custom)?,
            _ => return Err(de::Error::custom("a place has either `was` or `was_base64`")),
        };
        Ok(Self { at, length, was, steps })
    }
}
