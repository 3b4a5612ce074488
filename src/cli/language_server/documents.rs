//! This module holds the open documents: their text as it is typed, and what was found in it at the last pause.

use super::places;
use super::settings::ServerSettings;
use clsmith::diagnostic::Diagnostic;
use clsmith::editor::{EditedLines, EditedText, ProgramView, TextPosition, YamlFileKind};
use clsmith::source::{Source, SourceTooLarge};
use lsp_types::TextDocumentContentChangeEvent;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// What is shared by the threads of the server.
#[derive(Debug, Default)]
pub(super) struct SharedState {
    state: Mutex<ServerState>,
}

/// Settings and documents.
#[derive(Debug, Default)]
pub(super) struct ServerState {
    pub(super) settings: ServerSettings,
    /// The open documents by their addresses.
    pub(super) documents: BTreeMap<String, Document>,
}

impl SharedState {
    pub(super) fn lock(&self) -> MutexGuard<'_, ServerState> {
        // A thread that failed has left whole documents: each change of them is one assignment.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// An open document.
#[derive(Debug)]
pub(super) struct Document {
    /// Its file, if its address is that of one.
    pub(super) path: Option<PathBuf>,
    /// Whether the editor or the name calls it YAML.
    pub(super) is_yaml: bool,
    pub(super) version: i32,
    pub(super) text: EditedText,
    /// What was found in the text at the last pause.
    pub(super) read: ReadState,
    /// The lines that were edited since the text was taken that is being read.
    edited_since_taken: EditedLines,
}

/// What was found in a text.
#[derive(Debug, Clone, Default)]
pub(super) struct ReadState {
    /// Whether a text was read at all since the document was opened.
    pub(super) is_read: bool,
    /// The version of the text that was read.
    pub(super) version: i32,
    /// The program, if it is one.
    pub(super) view: Option<Arc<ProgramView>>,
    /// The findings of YAML files; those of programs are in the view.
    pub(super) findings: Arc<Vec<Diagnostic>>,
    /// The thickest chip of the motion on each line, mm; lines are counted from 0.
    pub(super) chips: Arc<BTreeMap<u32, f64>>,
    /// The lines that were edited since.
    pub(super) edited: EditedLines,
}

impl Document {
    /// Opens a document. A text that is too large is not held.
    pub(super) fn open(
        uri: &str,
        language: &str,
        version: i32,
        text: String,
    ) -> Result<Self, SourceTooLarge> {
        let path = places::uri_to_path(uri);
        let named = [".yaml", ".yml"].iter().any(|end| uri.to_ascii_lowercase().ends_with(end));
        let name = path.as_ref().map_or_else(|| uri.to_owned(), |path| path.to_string_lossy().into_owned());
        Ok(Self {
            path,
            is_yaml: named || language == "yaml",
            version,
            text: EditedText::new(name, text)?,
            read: ReadState::default(),
            edited_since_taken: EditedLines::default(),
        })
    }

    /// Applies changes as the editor tells them. A change without a range is the whole text.
    pub(super) fn change(&mut self, version: i32, changes: Vec<TextDocumentContentChangeEvent>) {
        for change in changes {
            let range = match change.range {
                Some(range) => places::position(range.start)..places::position(range.end),
                None => TextPosition::default()..TextPosition::new(u32::MAX, 0),
            };
            // A text that would be too large stays as it was, and so does its version.
            let Ok(edit) = self.text.replace(range, &change.text) else { return };
            self.read.edited.add(edit);
            self.edited_since_taken.add(edit);
        }
        self.version = version;
    }

    /// Takes the text as it is now, to be read without holding the document.
    pub(super) fn take_text(&mut self) -> Arc<Source> {
        self.edited_since_taken = EditedLines::default();
        Arc::clone(self.text.source())
    }

    /// Puts in what was found in the text that was taken.
    pub(super) fn put_found(
        &mut self,
        version: i32,
        view: Option<Arc<ProgramView>>,
        findings: Vec<Diagnostic>,
    ) {
        let edited = self.edited_since_taken;
        self.read = ReadState {
            is_read: true,
            version,
            view,
            findings: Arc::new(findings),
            chips: Arc::default(),
            edited,
        };
    }

    /// Returns what kind of YAML it is, if it is one that clsmith knows.
    pub(super) fn yaml_kind(&self) -> Option<YamlFileKind> {
        if self.is_yaml { YamlFileKind::from_text(self.text.bytes()) } else { None }
    }

    /// Returns the findings of the last pause.
    pub(super) fn findings(&self) -> &[Diagnostic] {
        self.read.view.as_ref().map_or(&self.read.findings, |view| view.findings())
    }
}
