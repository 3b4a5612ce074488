//! This module writes the comments before changed records.

use super::comment_format::{self, WIDTH};
use super::comment_places::CommentPlaces;
use super::{CommentLine, change_wording, feeds_before_steps};
use crate::program::{
    InsertionPoint, Program, ProvenanceComment, Record, Statement, StatementChange, StatementEdit,
    StatementId, StepId,
};
use crate::transform::Recipe;

/// The comments that are inserted, and those that are replaced.
#[derive(Default)]
pub(super) struct ChangeComments {
    pub(super) lines: Vec<CommentLine>,
    /// Comments of earlier runs that move with their record, because something was inserted between them.
    pub(super) moved: Vec<StatementId>,
}

/// Writes a line for each step that changed a record, and one for consecutive records that a step inserted or
/// deleted.
pub(super) fn write_change_comments(
    program: &Program,
    places: &CommentPlaces,
    recipe: &Recipe,
) -> ChangeComments {
    let mut writer = ChangeCommentWriter {
        program,
        places,
        recipe,
        feeds: feeds_before_steps::FeedsBeforeSteps::new(recipe.steps.len()),
        run: None,
        earlier: Vec::new(),
        separated: false,
        found: ChangeComments::default(),
    };
    for (id, statement) in program.numbered_statements() {
        writer.visit_statement(id, statement);
    }
    writer.end_run();
    writer.found
}

/// Consecutive records that one step inserted or deleted.
struct RecordRun {
    by: StepId,
    put_in: bool,
    first: StatementId,
    count: usize,
    /// The texts for a single record, from the longest to the shortest.
    single: Vec<String>,
    note: Option<String>,
}

struct ChangeCommentWriter<'p> {
    program: &'p Program,
    places: &'p CommentPlaces,
    recipe: &'p Recipe,
    feeds: feeds_before_steps::FeedsBeforeSteps,
    run: Option<RecordRun>,
    /// Comments of earlier runs after which no record has come yet.
    earlier: Vec<StatementId>,
    /// Whether something was inserted after them.
    separated: bool,
    found: ChangeComments,
}

impl ChangeCommentWriter<'_> {
    fn visit_statement(&mut self, id: StatementId, statement: &Statement) {
        if ProvenanceComment::from_text(self.program.statement_text(statement))
            == Some(ProvenanceComment::Change)
        {
            if statement.is_live() {
                self.earlier.push(id);
            }
            return;
        }
        match statement.change() {
            StatementChange::Untouched => self.end_run(),
            StatementChange::Edited(by) => {
                self.end_run();
                self.write_edits(id, statement, by);
            }
            StatementChange::Inserted(by) => self.visit_inserted(id, statement, by),
            // A statement that one step inserted and this one deleted was never in the file.
            StatementChange::Deleted(_) if statement.origin().is_empty() => return,
            StatementChange::Deleted(by) => self.visit_deleted(id, statement, by),
        }
        if statement.is_live() {
            self.keep_earlier_comments(id, statement);
        }
        self.feeds.pass_statement(self.program, statement);
    }

    fn write_edits(&mut self, id: StatementId, statement: &Statement, by: StepId) {
        let mut edits = self.program.edits_of_statement(statement);
        if edits.is_empty() {
            let before = Some(self.program.source().slice(statement.origin()));
            edits.push(StatementEdit {
                by,
                before,
                after: self.program.statement_text(statement),
                note: None,
            });
        }
        edits.iter().for_each(|edit| self.write_edit(id, statement, edit));
    }

    fn write_edit(&mut self, id: StatementId, statement: &Statement, edit: &StatementEdit<'_>) {
        let before = edit.before.unwrap_or_default();
        let name = self.record_name(id, statement);
        let width = self.columns_left(edit.by);
        let with_note = |note: String| {
            let left = width.saturating_sub(name.len() + note.len());
            let difference =
                change_wording::describe_difference(statement.record(), before, edit.after, left);
            format!("{name}{difference}{note}")
        };
        let texts = comment_format::note_variants(edit.note).into_iter().map(with_note).collect();
        self.push_line(id, edit.by, &comment_format::first_fitting(texts, width));
    }

    fn visit_inserted(&mut self, id: StatementId, statement: &Statement, by: StepId) {
        let edits = self.program.edits_of_statement(statement);
        let (first, later) =
            edits.split_first().map_or((None, &[][..]), |(first, later)| (Some(first), later));
        let by = first.map_or(by, |first| first.by);
        let is_feed = matches!(statement.record(), Record::Feed(_));
        let alone = is_feed || !later.is_empty();
        if !self.earlier.is_empty() {
            self.separated = true;
        }
        match &mut self.run {
            Some(run) if run.put_in && run.by == by && !alone => run.count += 1,
            _ => {
                self.end_run();
                let name = self.record_name(id, statement);
                let text = first.map_or(self.program.statement_text(statement), |first| first.after);
                let single =
                    match self.describe_inserted_feed(statement.record(), text, by).filter(|_| is_feed) {
                        Some(feed) => feed.into_iter().map(|feed| format!("{name}{feed}")).collect(),
                        None => vec![format!("{name}put in")],
                    };
                let note = first.and_then(|first| first.note).map(str::to_owned);
                self.run = Some(RecordRun { by, put_in: true, first: id, count: 1, single, note });
            }
        }
        if alone {
            self.end_run();
            later.iter().for_each(|edit| self.write_edit(id, statement, edit));
        }
    }

    /// Describes what an inserted FEDRAT changes: in full, and without `put in` where few columns are left.
    fn describe_inserted_feed(&self, record: &Record, text: &[u8], by: StepId) -> Option<[String; 2]> {
        let new = feeds_before_steps::printed_feed(record, text)?;
        let old = self.feeds.feed_before_step(by)?;
        Some(match old == new {
            true => [format!("put in, {new} comes back"), format!("{new} comes back")],
            false => [format!("{old} -> {new}, put in"), format!("{old} -> {new}")],
        })
    }

    fn visit_deleted(&mut self, id: StatementId, statement: &Statement, by: StepId) {
        match &mut self.run {
            Some(run) if !run.put_in && run.by == by => run.count += 1,
            _ => {
                self.end_run();
                let text = change_wording::to_one_line(self.program.source().slice(statement.origin()));
                let width = self.columns_left(by).saturating_sub("taken out: ".len());
                let single = vec![format!("taken out: {}", comment_format::shorten_middle(&text, width))];
                self.run = Some(RecordRun { by, put_in: false, first: id, count: 1, single, note: None });
            }
        }
    }

    fn end_run(&mut self) {
        let Some(run) = self.run.take() else { return };
        let done = if run.put_in { "put in" } else { "taken out" };
        let what = if run.count == 1 { run.single } else { vec![format!("{} records {done}", run.count)] };
        let notes = comment_format::note_variants(run.note.as_deref());
        // The note is only shortened after `put in` was left out.
        let texts = notes.iter().flat_map(|note| what.iter().map(move |what| format!("{what}{note}")));
        let text = comment_format::first_fitting(texts.collect(), self.columns_left(run.by));
        self.push_line(run.first, run.by, &text);
    }

    /// Keeps comments of an earlier run with their record, if one was inserted between them.
    fn keep_earlier_comments(&mut self, id: StatementId, statement: &Statement) {
        if matches!(statement.change(), StatementChange::Inserted(_)) {
            return;
        }
        let earlier = std::mem::take(&mut self.earlier);
        let to = self.places.comment_position(id);
        let separated = std::mem::take(&mut self.separated);
        let first = earlier.first().copied();
        if !separated
            || first.is_none_or(|first| to <= first.before() || !self.has_inserted_between(first, to))
        {
            return;
        }
        // Lines about this record itself, which were added just now, come after them.
        let own = self.found.lines.iter().rposition(|line| line.at < to).map_or(0, |last| last + 1);
        let text = |id: &StatementId| self.program.statement_text(self.program.statement(*id)).to_vec();
        let lines: Vec<CommentLine> =
            earlier.iter().map(|id| CommentLine { at: to, text: text(id) }).collect();
        self.found.lines.splice(own..own, lines);
        self.found.moved.extend(earlier);
    }

    /// Returns whether a live inserted record lies between two statements.
    fn has_inserted_between(&self, from: StatementId, to: InsertionPoint) -> bool {
        let between = self.program.statements_between(from.before(), to);
        between.iter().any(|statement| matches!(statement.change(), StatementChange::Inserted(_)))
    }

    /// Returns the record's name and a blank, if its comments are not directly before it.
    fn record_name(&self, id: StatementId, statement: &Statement) -> String {
        if self.places.comment_position(id) == id.before() {
            return String::new();
        }
        format!(
            "{} ",
            change_wording::record_name(statement.record(), self.program.statement_text(statement))
        )
    }

    fn step_name(&self, by: StepId) -> &'static str {
        self.recipe.steps.get(usize::from(by.0)).map_or("step", |step| step.name())
    }

    fn columns_left(&self, by: StepId) -> usize {
        WIDTH.saturating_sub(
            comment_format::comment_prefix(self.program.dialect()).len() + self.step_name(by).len() + 2,
        )
    }

    fn push_line(&mut self, id: StatementId, by: StepId, text: &str) {
        let text =
            comment_format::comment_line(self.program.dialect(), &format!("{}: {text}", self.step_name(by)));
        self.found.lines.push(CommentLine { at: self.places.comment_position(id), text });
    }
}
