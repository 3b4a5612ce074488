//! Carrying out what the rules say, statement by statement, through the gate.

use super::charset::Charset;
use super::expression::Trouble;
use super::look::{Look, same_statement};
use super::reshape::reshaped;
use super::search::{Active, Hit};
use super::subject::Subject;
use super::template::{Filling, Template};
use crate::diagnostic::{Diagnostic, codes};
use crate::program::{Change, OwnComment, Program, Record, Statement};
use crate::transform::Context;
use crate::write::Editor;

/// The hits of a step, and all that is needed to act on them.
pub(super) struct Work<'w> {
    rules: &'w [Active<'w>],
    hits: &'w [Hit],
    charset: Charset,
    context: &'w Context<'w>,
}

/// What is to be put beside one statement.
struct Insertion {
    hit: Hit,
    before: Vec<Vec<u8>>,
    after: Vec<Vec<u8>>,
}

impl<'w> Work<'w> {
    pub fn new(rules: &'w [Active<'w>], hits: &'w [Hit], charset: Charset, context: &'w Context<'_>) -> Self {
        Self { rules, hits, charset, context }
    }

    /// The program with all of it done.
    ///
    /// # Errors
    /// When an expression has no value, or what a rule writes is no statement.
    pub fn done(&self, program: Program) -> Result<Program, Box<Diagnostic>> {
        let mut editor = Editor::new(program, self.context.step);
        let mut look = Look::of(editor.program(), editor.style().line_end);
        let mut insertions = Vec::new();
        for &hit in self.hits {
            insertions.extend(self.change(hit, &mut editor, &mut look)?);
        }
        // Only now is it known what stands beside each statement after this step.
        for insertion in insertions {
            self.insert(insertion, &mut editor)?;
        }
        editor.finish()
    }

    /// Replaces or deletes, and gives what is to be inserted.
    fn change(
        &self,
        hit: Hit,
        editor: &mut Editor,
        look: &mut Look,
    ) -> Result<Option<Insertion>, Box<Diagnostic>> {
        let program = editor.program();
        let (Some(active), Some(statement)) = (self.rules.get(hit.rule), program.statement(hit.statement))
        else {
            return Ok(None);
        };
        let rule = active.rule;
        let text = program.text(statement);
        let subject = Subject::of(text);
        let Some(bindings) = active.bindings(&subject) else { return Ok(None) };
        let (style, charset) = (editor.style(), self.charset);
        let filling = Filling { bindings: &bindings, text, record: statement.record(), style, charset };
        let filled = |template: &Template, key: &str| {
            template.fill(&filling).map_err(|trouble| stuck(&trouble, hit, key, program, self.context))
        };
        let mut all = |templates: &[Template], key: &str| -> Result<Vec<Vec<u8>>, Box<Diagnostic>> {
            templates.iter().map(|template| Ok(look.written(&filled(template, key)?, program))).collect()
        };
        let before = all(&rule.insert_before, "insert_before")?;
        let after = all(&rule.insert_after, "insert_after")?;
        let new = rule.replace.as_ref().map(|template| filled(template, "replace")).transpose()?;
        if let Some(new) = new {
            let text = reshaped(program, statement, &new, style, look);
            editor.set_text(hit.statement, &text).map_err(|error| self.at_rule(*error, hit, &["replace"]))?;
        }
        if rule.delete {
            editor.delete(hit.statement);
        }
        Ok(Some(Insertion { hit, before, after }))
    }

    /// Inserts what does not stand there yet.
    fn insert(&self, insertion: Insertion, editor: &mut Editor) -> Result<(), Box<Diagnostic>> {
        let Insertion { hit, before, after } = insertion;
        if !stands(&before, editor.program(), hit.statement, true) {
            self.put(&before, hit.statement, hit, "insert_before", editor)?;
        }
        let inserts = !stands(&after, editor.program(), hit.statement, false);
        if inserts {
            self.put(&after, hit.statement + 1, hit, "insert_after", editor)?;
        }
        self.check_points(hit, editor.program(), inserts)
    }

    fn put(
        &self,
        texts: &[Vec<u8>],
        before: usize,
        hit: Hit,
        key: &str,
        editor: &mut Editor,
    ) -> Result<(), Box<Diagnostic>> {
        for (number, text) in texts.iter().enumerate() {
            if let Err(mut error) = editor.insert_before(before, text) {
                // The editor knows what it was to insert before, not for which statement.
                error.labels.clear();
                let program = editor.program();
                let span = program.statement(hit.statement).map(Statement::origin).unwrap_or_default();
                let error = error.label(program.source(), span, "beside this statement");
                return Err(self.at_rule(error, hit, &[key, &number.to_string()]));
            }
        }
        Ok(())
    }

    /// Lines of bare numbers go on with the GOTO before them and mean nothing without it.
    fn check_points(&self, hit: Hit, program: &Program, inserts: bool) -> Result<(), Box<Diagnostic>> {
        let is_points = |record: &Record| matches!(record, Record::Goto(_) | Record::Points(_));
        let kept = program.statement(hit.statement).filter(|kept| kept.is_live());
        if !inserts && kept.is_some_and(|kept| is_points(kept.record())) {
            return Ok(());
        }
        let mut behind = program.statements().iter().enumerate().skip(hit.statement + 1);
        let Some((index, next)) = behind.find(|(_, next)| next.is_live()) else { return Ok(()) };
        let first = program.text(next).trim_ascii_start().first();
        let is_bare = first.is_some_and(|byte| byte.is_ascii_digit() || b"+-.".contains(byte));
        if !is_points(next.record()) || !is_bare {
            return Ok(());
        }
        let message = "the rule would part a GOTO from the lines of numbers that go on with it";
        let error = self.context.fail_at(message, program, index, "these numbers would stand alone");
        Err(self.at_rule(*error, hit, &[]))
    }

    fn at_rule(&self, error: Diagnostic, hit: Hit, keys: &[&str]) -> Box<Diagnostic> {
        at_rule(error, hit, keys, "by this rule", self.context)
    }
}

/// Whether what is to be inserted before or behind a statement already stands there, or is the statement itself.
fn stands(wanted: &[Vec<u8>], program: &Program, statement: usize, before: bool) -> bool {
    let with_own = wanted.iter().any(|text| OwnComment::of(text).is_some());
    let wanted: Vec<Subject<'_>> = wanted.iter().map(|text| Subject::of(text)).collect();
    if wanted.is_empty() {
        return true;
    }
    let own =
        program.statement(statement).filter(|own| own.is_live()).map(|own| Subject::of(program.text(own)));
    if own.is_some_and(|own| wanted.iter().any(|wanted| same_statement(wanted, &own))) {
        return true;
    }
    let mut found = neighbours(program, statement, before, wanted.len(), with_own);
    if before {
        found.reverse();
    }
    wanted.len() == found.len()
        && wanted.iter().zip(&found).all(|(wanted, found)| same_statement(wanted, found))
}

/// Up to `count` statements before or behind one, the nearest first. Comments of clsmith's own runs are passed over: they stand
/// between a statement and what an earlier run put beside it. `with_own` is for rules that write such a comment themselves.
fn neighbours(
    program: &Program,
    statement: usize,
    before: bool,
    count: usize,
    with_own: bool,
) -> Vec<Subject<'_>> {
    let (head, tail) = program.statements().split_at_checked(statement).unwrap_or_default();
    let subject = |statement: &Statement| Subject::of(program.text(statement));
    let is_own = |other: &Statement| OwnComment::of(program.text(other)).is_some();
    let counts = |other: &&Statement| other.is_live() && (with_own || !is_own(other));
    match before {
        true => head.iter().rev().filter(counts).take(count).map(subject).collect(),
        false => tail.iter().skip(1).filter(counts).take(count).map(subject).collect(),
    }
}

fn at_rule(
    error: Diagnostic,
    hit: Hit,
    keys: &[&str],
    label: &str,
    context: &Context<'_>,
) -> Box<Diagnostic> {
    let rule = hit.rule.to_string();
    let path = [&["rules", rule.as_str()], keys].concat();
    let place = context.recipe.step_value_place(usize::from(context.step.0), &path);
    Box::new(error.label(&context.recipe.source, place, label))
}

/// Why a rule cannot be applied to a statement: at the text of the rule, and at the argument.
pub(super) fn stuck(
    trouble: &Trouble,
    hit: Hit,
    key: &str,
    program: &Program,
    context: &Context<'_>,
) -> Box<Diagnostic> {
    let mut span = program.statement(hit.statement).map(Statement::origin).unwrap_or_default();
    let untouched =
        program.statement(hit.statement).is_some_and(|statement| statement.change() == Change::Untouched);
    if let (Some(at), true) = (&trouble.at, untouched) {
        span = span.part(at.start, at.end);
    }
    let message = format!("rule {} of this `rewrite` cannot be applied: {}", hit.rule + 1, trouble.message);
    let error = Diagnostic::new(codes::STEP_FAILED, message).label(program.source(), span, "on this");
    at_rule(error, hit, &[key], "asked for here", context)
}
