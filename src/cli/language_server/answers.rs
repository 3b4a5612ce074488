//! This module answers requests about one document from what was found in it at the last pause of typing. Lines that were
//! edited since are answered from the line in front of them, or not at all.

use super::analysis::finding_to_json;
use super::documents::{Document, ReadState};
use super::places::{
    moved_span, path_to_uri, position, position_to_json, range_to_json, span_to_json, touches,
};
use clsmith::editor::{
    OutlineEntry, OutlineKind, ProgramView, RecipeWords, TextPosition, YamlFileKind, complete_words,
    find_file_names, find_position, find_quick_fix, list_step_words, refuse_operation_name,
};
use clsmith::source::Span;
use lsp_types::{Position, Range};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

/// A document to answer about.
pub(super) struct Answers<'d> {
    pub(super) uri: &'d str,
    pub(super) document: &'d Document,
}

impl<'d> Answers<'d> {
    fn read(&self) -> &'d ReadState {
        &self.document.read
    }

    fn view(&self) -> Option<&'d ProgramView> {
        self.read().view.as_deref()
    }

    /// Returns the range of a span in the text as it is now.
    fn range_now(&self, view: &ProgramView, span: Span) -> Option<Value> {
        moved_span(view.program().source(), span, &self.read().edited)
    }

    fn location(&self, view: &ProgramView, span: Option<Span>) -> Value {
        let range = span.and_then(|span| self.range_now(view, span));
        range.map_or(Value::Null, |range| json!({ "uri": self.uri, "range": range }))
    }

    /// Returns the line of the program for a line of the text; an edited one is that in front of the edits.
    fn line_of_program(&self, line: u32) -> Option<u32> {
        let edited = &self.read().edited;
        edited.line_before(line).or_else(|| edited.line_in_front())
    }

    pub(super) fn hover(&self, at: Position) -> Option<Value> {
        let view = self.view()?;
        let edited = self.read().edited.line_before(at.line).is_none();
        let line = self.line_of_program(at.line)?;
        let mut state = view.line_state(line)?;
        state.thickest_chip_mm = self.read().chips.get(&line).copied().filter(|_| !edited);
        let mut text = String::new();
        if edited {
            text.push_str("before this edited line:\n\n");
        }
        text.push_str(&state.to_markdown());
        let source = view.program().source();
        for found in view.findings().iter().filter(|_| !edited) {
            let here = found
                .labels
                .first()
                .is_some_and(|label| find_position(source, label.span.start).line == line);
            if here {
                let _ = write!(text, "\n**{}**: {}\n", found.code.id(), found.code.meaning());
                let _ = writeln!(text, "\n{}", found.code.explanation());
            }
        }
        Some(json!({ "contents": { "kind": "markdown", "value": text } }))
    }

    pub(super) fn outline(&self) -> Value {
        let Some(view) = self.view() else { return json!([]) };
        let told = view.outline().iter().filter_map(|entry| self.outline_entry(view, entry)).collect();
        Value::Array(told)
    }

    fn outline_entry(&self, view: &ProgramView, entry: &OutlineEntry) -> Option<Value> {
        let children = entry.children.iter().filter_map(|child| self.outline_entry(view, child));
        let children: Vec<Value> = children.collect();
        // Kinds of the protocol: a function, and an object.
        let kind = match entry.kind {
            OutlineKind::Operation => 12,
            OutlineKind::Tool => 19,
        };
        let head = self.range_now(view, entry.head)?;
        let whole = self.range_now(view, entry.whole).unwrap_or_else(|| head.clone());
        Some(json!({
            "name": entry.name, "detail": entry.detail, "kind": kind,
            "range": whole, "selectionRange": head, "children": children,
        }))
    }

    pub(super) fn foldings(&self) -> Value {
        let Some(view) = self.view() else { return json!([]) };
        let edited = &self.read().edited;
        let lines = view.foldings().into_iter();
        let moved = lines.filter_map(|(first, last)| Some((edited.line_now(first)?, edited.line_now(last)?)));
        moved.map(|(first, last)| json!({ "startLine": first, "endLine": last, "kind": "region" })).collect()
    }

    pub(super) fn tool_load(&self, at: Position) -> Option<Value> {
        let view = self.view()?;
        Some(self.location(view, view.tool_load(self.line_of_program(at.line)?)))
    }

    pub(super) fn next_feed(&self, at: Position) -> Option<Value> {
        let view = self.view()?;
        Some(self.location(view, view.next_feed(self.line_of_program(at.line)?)))
    }

    pub(super) fn last_feed(&self, at: Position) -> Option<Value> {
        let view = self.view()?;
        Some(self.location(view, view.last_feed(self.line_of_program(at.line)?)))
    }

    pub(super) fn hints(&self, range: Range) -> Value {
        let Some(view) = self.view() else { return json!([]) };
        let edited = &self.read().edited;
        let (Some(first), Some(last)) = (
            self.line_of_program(range.start.line),
            self.line_of_program(range.end.line.min(self.document.text.line_count())),
        ) else {
            return json!([]);
        };
        let hints = view.line_hints(first..last.saturating_add(1)).into_iter();
        let told = hints.filter_map(|hint| {
            let line = edited.line_now(hint.line)?;
            let end = self.document.text.line_start(line) + self.document.text.line(line).len();
            let at = position_to_json(self.document.text.position(end));
            Some(json!({ "position": at, "label": hint.text, "paddingLeft": true }))
        });
        told.collect()
    }

    /// Completes a word; `programs` are the open programs, whose names recipes may use.
    pub(super) fn complete(&self, at: Position, programs: &[Arc<ProgramView>]) -> Value {
        let text = &self.document.text;
        let start = text.line_start(at.line);
        let before = text.bytes().get(start..text.offset(position(at))).unwrap_or_default();
        let before = String::from_utf8_lossy(before);
        if !self.document.is_yaml {
            let words = complete_words(&before).into_iter();
            return words
                .map(|one| json!({ "label": one.word, "detail": one.meaning, "kind": 14 }))
                .collect();
        }
        if self.document.yaml_kind() != Some(YamlFileKind::Recipe) {
            return json!([]);
        }
        match RecipeWords::wanted(&before) {
            Some(RecipeWords::Steps) => {
                let steps = list_step_words().into_iter();
                steps.map(|(name, text)| json!({ "label": name, "detail": text, "kind": 3 })).collect()
            }
            Some(RecipeWords::Operations) => names_to_json(programs, OutlineKind::Operation),
            Some(RecipeWords::Tools) => names_to_json(programs, OutlineKind::Tool),
            Some(_) | None => json!([]),
        }
    }

    /// Returns the repairs of findings on the lines of a range.
    pub(super) fn repairs(&self, range: Range, documentation: Option<&str>) -> Value {
        let edited = &self.read().edited;
        let mut told = Vec::new();
        for found in self.document.findings() {
            let (Some(label), Some(fix)) = (found.labels.first(), find_quick_fix(found)) else { continue };
            let (from, to) = (
                find_position(&label.source, label.span.start),
                find_position(&label.source, label.span.end),
            );
            let (Some(first), Some(last)) = (edited.line_now(from.line), edited.line_now(to.line)) else {
                continue;
            };
            let (from, to) = (TextPosition::new(first, from.column), TextPosition::new(last, to.column));
            let Some(place) =
                moved_span(&label.source, fix.span, edited).filter(|_| touches(range, from, to))
            else {
                continue;
            };
            told.push(json!({
                "title": fix.title, "kind": "quickfix", "isPreferred": fix.is_certain,
                "diagnostics": [finding_to_json(found, &label.source, documentation)],
                "edit": { "changes": { self.uri: [{ "range": place, "newText": fix.text }] } },
            }));
        }
        Value::Array(told)
    }

    pub(super) fn prepare_rename(&self, at: Position) -> Option<Value> {
        let view = self.view()?;
        let (span, name) = view.operation_name_place(self.read().edited.line_before(at.line)?)?;
        Some(json!({ "range": self.range_now(view, span)?, "placeholder": name }))
    }

    /// Renames an operation.
    ///
    /// # Errors
    /// Returns why it cannot have that name, or that no operation begins here.
    pub(super) fn rename(&self, at: Position, name: &str) -> Result<Value, String> {
        if let Some(reason) = refuse_operation_name(name) {
            return Err(reason.to_owned());
        }
        let line = self.read().edited.line_before(at.line);
        let (Some(view), Some(line)) = (self.view(), line) else {
            return Err("the line was edited a moment ago, and is read again now".to_owned());
        };
        let places = view.operation_name_places(line);
        if places.is_empty() {
            return Err("no operation begins on this line".to_owned());
        }
        let ranges: Option<Vec<Value>> = places.iter().map(|span| self.range_now(view, *span)).collect();
        let ranges = ranges.ok_or("another operation of this name was edited a moment ago")?;
        let edits: Vec<Value> =
            ranges.into_iter().map(|range| json!({ "range": range, "newText": name })).collect();
        Ok(json!({ "changes": { self.uri: edits } }))
    }

    /// Returns the files that a YAML file names.
    pub(super) fn links(&self) -> Value {
        let (true, Some(path)) = (self.document.is_yaml, &self.document.path) else { return json!([]) };
        if self.document.yaml_kind().is_none() {
            return json!([]);
        }
        let source = self.document.text.source();
        let folder = path.parent().unwrap_or(Path::new(""));
        let there = find_file_names(source).into_iter().filter_map(|(span, name)| {
            let file = folder.join(name);
            let told = json!({ "range": span_to_json(source, span), "target": path_to_uri(&file) });
            file.is_file().then_some(told)
        });
        there.collect()
    }

    /// Returns an offer to preview a recipe for each open program, at its steps.
    pub(super) fn lenses(&self, programs: &[String]) -> Value {
        if self.document.yaml_kind() != Some(YamlFileKind::Recipe) {
            return json!([]);
        }
        let text = &self.document.text;
        let line = (0..text.line_count()).find(|line| text.line(*line).starts_with(b"steps:")).unwrap_or(0);
        let range = range_to_json(TextPosition::new(line, 0), TextPosition::new(line, 6));
        let offer = |program: &String| {
            let name = program.rsplit('/').next().unwrap_or(program);
            json!({ "range": range, "command": {
                "title": format!("preview this recipe on {name}"),
                "command": super::commands::PREVIEW,
                "arguments": [self.uri, program],
            } })
        };
        programs.iter().map(offer).collect()
    }
}

fn names_to_json(programs: &[Arc<ProgramView>], kind: OutlineKind) -> Value {
    let mut names = Vec::new();
    for view in programs {
        let mut open = view.outline();
        while let Some(entry) = open.pop() {
            if entry.kind == kind {
                // A recipe names tools by number.
                names.push(entry.name.strip_prefix("tool ").unwrap_or(&entry.name).to_owned());
            }
            open.extend(entry.children);
        }
    }
    names.sort();
    names.dedup();
    let quote = |name: &String| match kind {
        OutlineKind::Operation => json!(name).to_string(),
        OutlineKind::Tool => name.clone(),
    };
    names.iter().map(|name| json!({ "label": name, "insertText": quote(name), "kind": 12 })).collect()
}
