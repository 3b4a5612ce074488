//! The comments before changed records.

use super::form::{self, WIDTH};
use super::place::Places;
use super::{Line, feeds, words};
use crate::program::{Change, Edit, OwnComment, Program, Record, Statement, StepId};
use crate::transform::Recipe;

/// What is to be put in, and what goes for it.
#[derive(Default)]
pub(super) struct Found {
    pub(super) lines: Vec<Line>,
    /// Comments of earlier runs that go along with their record, because something was put in between.
    pub(super) moved: Vec<usize>,
}

/// A line for each step that changed a record, one for records that a step put in or took out in a row.
pub(super) fn lines(program: &Program, places: &Places, recipe: &Recipe) -> Found {
    let mut writer = Writer {
        program,
        places,
        recipe,
        feeds: feeds::Feeds::new(recipe.steps.len()),
        run: None,
        earlier: Vec::new(),
        parted: false,
        found: Found::default(),
    };
    for (index, statement) in program.statements().iter().enumerate() {
        writer.see(index, statement);
    }
    writer.end_run();
    writer.found
}

/// Records in a row that one step put in, or took out.
struct Run {
    by: StepId,
    put_in: bool,
    first: usize,
    count: usize,
    /// What is said of a single one, from the longest to the shortest.
    single: Vec<String>,
    note: Option<String>,
}

struct Writer<'p> {
    program: &'p Program,
    places: &'p Places,
    recipe: &'p Recipe,
    feeds: feeds::Feeds,
    run: Option<Run>,
    /// Comments of earlier runs that no record has followed yet.
    earlier: Vec<usize>,
    /// Whether something was put in after them.
    parted: bool,
    found: Found,
}

impl Writer<'_> {
    fn see(&mut self, index: usize, statement: &Statement) {
        if OwnComment::of(self.program.text(statement)) == Some(OwnComment::Change) {
            if statement.is_live() {
                self.earlier.push(index);
            }
            return;
        }
        match statement.change() {
            Change::Untouched => self.end_run(),
            Change::Edited(by) => {
                self.end_run();
                self.edited(index, statement, by);
            }
            Change::Inserted(by) => self.inserted(index, statement, by),
            // One step put it in, this one took it out: the file never had it.
            Change::Deleted(_) if statement.origin().is_empty() => return,
            Change::Deleted(by) => self.deleted(index, statement, by),
        }
        if statement.is_live() {
            self.keep_with_record(index, statement);
        }
        self.feeds.pass(self.program, statement);
    }

    fn edited(&mut self, index: usize, statement: &Statement, by: StepId) {
        let mut edits = self.program.edits_of(statement);
        if edits.is_empty() {
            let before = Some(self.program.source().slice(statement.origin()));
            edits.push(Edit { by, before, after: self.program.text(statement), note: None });
        }
        edits.iter().for_each(|edit| self.edit(index, statement, edit));
    }

    fn edit(&mut self, index: usize, statement: &Statement, edit: &Edit<'_>) {
        let before = edit.before.unwrap_or_default();
        let name = self.name(index, statement);
        let room = self.room(edit.by);
        let with_note = |note: String| {
            let left = room.saturating_sub(name.len() + note.len());
            let difference = words::difference(statement.record(), before, edit.after, left);
            format!("{name}{difference}{note}")
        };
        let texts = form::notes(edit.note).into_iter().map(with_note).collect();
        self.line(index, edit.by, &form::fitting(texts, room));
    }

    fn inserted(&mut self, index: usize, statement: &Statement, by: StepId) {
        let edits = self.program.edits_of(statement);
        let (first, later) =
            edits.split_first().map_or((None, &[][..]), |(first, later)| (Some(first), later));
        let by = first.map_or(by, |first| first.by);
        let is_feed = matches!(statement.record(), Record::Feed(_));
        let alone = is_feed || !later.is_empty();
        if !self.earlier.is_empty() {
            self.parted = true;
        }
        match &mut self.run {
            Some(run) if run.put_in && run.by == by && !alone => run.count += 1,
            _ => {
                self.end_run();
                let name = self.name(index, statement);
                let text = first.map_or(self.program.text(statement), |first| first.after);
                let single = match self.feed_put_in(statement.record(), text, by).filter(|_| is_feed) {
                    Some(feed) => feed.into_iter().map(|feed| format!("{name}{feed}")).collect(),
                    None => vec![format!("{name}put in")],
                };
                let note = first.and_then(|first| first.note).map(str::to_owned);
                self.run = Some(Run { by, put_in: true, first: index, count: 1, single, note });
            }
        }
        if alone {
            self.end_run();
            later.iter().for_each(|edit| self.edit(index, statement, edit));
        }
    }

    /// What a FEDRAT that was put in changes: in full, and without `put in` for where room is scant.
    fn feed_put_in(&self, record: &Record, text: &[u8], by: StepId) -> Option<[String; 2]> {
        let new = feeds::number(record, text)?;
        let old = self.feeds.before(by)?;
        Some(match old == new {
            true => [format!("put in, {new} comes back"), format!("{new} comes back")],
            false => [format!("{old} -> {new}, put in"), format!("{old} -> {new}")],
        })
    }

    fn deleted(&mut self, index: usize, statement: &Statement, by: StepId) {
        match &mut self.run {
            Some(run) if !run.put_in && run.by == by => run.count += 1,
            _ => {
                self.end_run();
                let text = words::one_line(self.program.source().slice(statement.origin()));
                let room = self.room(by).saturating_sub("taken out: ".len());
                let single = vec![format!("taken out: {}", form::shortened(&text, room))];
                self.run = Some(Run { by, put_in: false, first: index, count: 1, single, note: None });
            }
        }
    }

    fn end_run(&mut self) {
        let Some(run) = self.run.take() else { return };
        let done = if run.put_in { "put in" } else { "taken out" };
        let what = if run.count == 1 { run.single } else { vec![format!("{} records {done}", run.count)] };
        let notes = form::notes(run.note.as_deref());
        // `put in` goes before any of the note does.
        let texts = notes.iter().flat_map(|note| what.iter().map(move |what| format!("{what}{note}")));
        let text = form::fitting(texts.collect(), self.room(run.by));
        self.line(run.first, run.by, &text);
    }

    /// Comments of an earlier run stay with the record that they are about, where one was put in between.
    fn keep_with_record(&mut self, index: usize, statement: &Statement) {
        if matches!(statement.change(), Change::Inserted(_)) {
            return;
        }
        let earlier = std::mem::take(&mut self.earlier);
        let to = self.places.before(index);
        let parted = std::mem::take(&mut self.parted);
        let first = earlier.first().copied();
        if !parted || first.is_none_or(|first| to <= first || !self.stands_between(first, to)) {
            return;
        }
        // Lines about this record itself, which were added just now, come after them.
        let own = self.found.lines.iter().rposition(|line| line.before < to).map_or(0, |last| last + 1);
        let text = |index: &usize| {
            let statement = self.program.statement(*index)?;
            Some(Line { before: to, text: self.program.text(statement).to_vec() })
        };
        let lines: Vec<Line> = earlier.iter().filter_map(text).collect();
        self.found.lines.splice(own..own, lines);
        self.found.moved.extend(earlier);
    }

    /// Whether a live record that was put in stands between two statements.
    fn stands_between(&self, from: usize, to: usize) -> bool {
        let between = self.program.statements().get(from..to).unwrap_or_default();
        between.iter().any(|statement| matches!(statement.change(), Change::Inserted(_)))
    }

    /// The record's name with a blank, where its comments do not stand directly before it.
    fn name(&self, index: usize, statement: &Statement) -> String {
        if self.places.before(index) == index {
            return String::new();
        }
        format!("{} ", words::name(statement.record(), self.program.text(statement)))
    }

    fn step(&self, by: StepId) -> &'static str {
        self.recipe.steps.get(usize::from(by.0)).map_or("step", |step| step.name())
    }

    fn room(&self, by: StepId) -> usize {
        WIDTH.saturating_sub(form::prefix(self.program.dialect()).len() + self.step(by).len() + 2)
    }

    fn line(&mut self, index: usize, by: StepId, text: &str) {
        let text = form::line(self.program.dialect(), &format!("{}: {text}", self.step(by)));
        self.found.lines.push(Line { before: self.places.before(index), text });
    }
}
